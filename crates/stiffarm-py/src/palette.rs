//! The colours of the library, for figures that are drawn in Python.

use pyo3::prelude::*;
use stiffarm::drive::Architecture;
use stiffarm::palette;

type Named<T> = Vec<(&'static str, T)>;

/// Every colour by its name; and by theirs the colours that follow one another, of which `scale` and `margins` are drawn
/// straight between their colours, from small to large values.
#[pyfunction]
#[pyo3(name = "palette")]
pub(crate) fn colours() -> (Named<&'static str>, Named<Vec<String>>) {
    let owned = |colours: [&str; 6]| colours.map(str::to_owned).to_vec();
    let series = vec![
        ("scale", palette::scale()),
        ("margins", palette::margin_scale()),
        ("serial_curves", owned(palette::SERIAL_CURVES)),
        ("quasi_serial_curves", owned(palette::QUASI_SERIAL_CURVES)),
        ("ratios", owned(palette::RATIOS)),
    ];
    (palette::NAMED.to_vec(), series)
}

/// Colour and mark, 0 to 5, of robots given by name and architecture, the most important first; None for those that find no look of
/// their own.
#[pyfunction]
pub(crate) fn looks(robots: Vec<(String, String)>) -> Vec<Option<(&'static str, usize)>> {
    let architecture =
        |name: &str| if name == Architecture::Serial.name() { Architecture::Serial } else { Architecture::QuasiSerial };
    let named: Vec<_> = robots.iter().map(|(name, of)| (name.as_str(), architecture(of))).collect();
    stiffarm_ask::answer::styles(&named)
        .into_iter()
        .map(|style| style.map(|style| (style.colour, style.mark)))
        .collect()
}
