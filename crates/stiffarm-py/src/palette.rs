//! The colours of the library, for figures that are drawn in Python.

use pyo3::prelude::*;
use stiffarm::palette;

type Named<T> = Vec<(&'static str, T)>;

/// Every colour by its name; and by theirs the colours that follow one another, of which `scale` is drawn straight between
/// its colours, from small to large values.
#[pyfunction]
#[pyo3(name = "palette")]
pub(crate) fn colours() -> (Named<&'static str>, Named<Vec<String>>) {
    let owned = |colours: [&str; 6]| colours.map(str::to_owned).to_vec();
    let series = vec![
        ("scale", palette::scale()),
        ("serial_curves", owned(palette::SERIAL_CURVES)),
        ("quasi_serial_curves", owned(palette::QUASI_SERIAL_CURVES)),
        ("ratios", owned(palette::RATIOS)),
    ];
    (palette::NAMED.to_vec(), series)
}
