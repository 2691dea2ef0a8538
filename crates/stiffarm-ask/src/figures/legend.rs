//! A legend below a diagram, where it covers nothing.

use super::canvas::{Canvas, Font, Px};
use super::marks::left_out;

/// Width of a sample, height of a row, px.
const SAMPLE: f64 = 36.0;
const ROW: f64 = 22.0;

/// Draws a sample about a point.
type Sample = Box<dyn Fn(&mut Canvas, Px)>;

/// What is explained.
pub(crate) struct Entry {
    pub text: String,
    pub sample: Sample,
}

impl Entry {
    pub(crate) fn new(text: impl Into<String>, sample: impl Fn(&mut Canvas, Px) + 'static) -> Self {
        Self { text: text.into(), sample: Box::new(sample) }
    }

    /// A piece of a bar as the sample.
    pub(crate) fn bar(text: impl Into<String>, colour: &'static str) -> Self {
        let look = format!(r#"fill="{colour}""#);
        Self::new(text, move |canvas, [x, y]| {
            canvas.rect([x - SAMPLE / 3.0, y - 5.0], [x + SAMPLE / 3.0, y + 5.0], &look);
        })
    }

    /// The cross of what is left out as the sample.
    pub(crate) fn crossed(text: impl Into<String>) -> Self {
        Self::new(text, left_out)
    }

    /// A piece of a line as the sample.
    pub(crate) fn line(text: impl Into<String>, look: String) -> Self {
        Self::new(text, move |canvas, [x, y]| canvas.line([x - SAMPLE / 2.0, y], [x + SAMPLE / 2.0, y], &look))
    }
}

/// Entries in rows across the sheet, as many columns as fit.
pub(crate) struct Legend {
    entries: Vec<Entry>,
    columns: usize,
    column: f64,
}

const FONT: Font = Font::new(12.5);

impl Legend {
    /// A legend `room` px wide of at most `most` columns.
    pub(crate) fn new(entries: Vec<Entry>, room: f64, most: usize) -> Self {
        let widest = entries.iter().map(|entry| FONT.width(&entry.text)).fold(0.0, f64::max) + SAMPLE + 30.0;
        let columns = ((room / widest) as usize).clamp(1, most.clamp(1, entries.len().max(1)));
        Self { entries, columns, column: room / columns as f64 }
    }

    /// Its height, px.
    pub(crate) fn height(&self) -> f64 {
        self.entries.len().div_ceil(self.columns) as f64 * ROW
    }

    /// Draws it with its left upper corner at a point, column by column.
    pub(crate) fn draw(&self, canvas: &mut Canvas, [left, top]: Px) {
        let rows = self.entries.len().div_ceil(self.columns).max(1);
        for (i, entry) in self.entries.iter().enumerate() {
            let (column, row) = (i / rows, i % rows);
            let (x, y) = (left + column as f64 * self.column, top + (row as f64 + 0.5) * ROW);
            (entry.sample)(canvas, [x + SAMPLE / 2.0, y]);
            canvas.text([x + SAMPLE + 8.0, y], &FONT.cut(&entry.text, self.column - SAMPLE - 16.0), FONT);
        }
    }
}
