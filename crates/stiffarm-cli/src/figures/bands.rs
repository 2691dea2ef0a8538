//! A field in bands of colour: their limits, the colour bar, the filled area and its iso-lines.

use stiffarm::palette::{GREY, INK, on_scale};

use super::axes::{label, nice_step};
use super::canvas::{Canvas, Font, Px, path};
use super::contour::{Grid, Line, Node};
use super::labels::{Labelled, Spots};

/// Bands of equal width between round limits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bands {
    pub step: f64,
    first: f64,
    pub count: usize,
}

impl Bands {
    /// Bands that hold all values from `low` to `high`: about seven to fifteen, one where all values are the same.
    pub(super) fn of([low, high]: [f64; 2]) -> Self {
        let span = high - low;
        let step = if span <= 1e-9 * high.abs() { nice_step(high.abs(), 5.0) } else { nice_step(span, 14.0) };
        let first = (low / step + 1e-6).floor();
        let count = ((high / step - 1e-6).ceil() - first).clamp(1.0, 40.0) as usize;
        Self { step, first, count }
    }

    /// The `i`-th limit, from 0 to `count`.
    pub(super) fn limit(&self, i: usize) -> f64 {
        (self.first + i as f64) * self.step
    }

    /// The limit as text.
    pub(super) fn text(&self, i: usize) -> String {
        label(self.limit(i), self.step)
    }

    /// The colour of the band above the `i`-th limit; light is small.
    fn colour(&self, i: usize) -> String {
        on_scale((i as f64 + 0.5) / self.count as f64)
    }

    /// The bands as a scale from 0 to 1, each colour from where it begins to where it ends.
    pub(super) fn scale(&self) -> Vec<(f64, String)> {
        let at = |i: usize| i as f64 / self.count as f64;
        (0..self.count).flat_map(|i| [i, i + 1].map(|end| (at(end), self.colour(i)))).collect()
    }

    /// The colour bar between two corners, its limits on the right, what it shows beside them, read upwards.
    pub(super) fn bar(
        &self,
        canvas: &mut Canvas,
        [left, bottom]: Px,
        [right, top]: Px,
        title: &str,
        [small, large]: [&str; 2],
    ) {
        let height = (bottom - top) / self.count as f64;
        let y = |i: usize| bottom - i as f64 * height;
        let font = Font::new(12.0);
        let mut widest: f64 = 0.0;
        for i in 0..self.count {
            canvas.rect([left, y(i)], [right, y(i + 1)], &format!(r#"fill="{}""#, self.colour(i)));
        }
        canvas.rect([left, bottom], [right, top], &format!(r#"fill="none" stroke="{INK}" stroke-width="1""#));
        let every = (14.0 / height).ceil().max(1.0) as usize;
        for i in (0..=self.count).step_by(every) {
            let text = self.text(i);
            widest = widest.max(font.width(&text));
            canvas.line([left, y(i)], [right + 4.0, y(i)], &format!(r#"stroke="{INK}" stroke-width="0.8""#));
            canvas.text([right + 7.0, y(i)], &text, font);
        }
        let word = font.middle().colour(GREY);
        let middle = f64::midpoint(left, right);
        canvas.text([middle, bottom + 12.0], small, word);
        canvas.text([middle, top - 11.0], large, word);
        let font = Font::new(13.0).middle();
        let title = font.cut(title, bottom - top + 30.0);
        canvas.text([right + 20.0 + widest, f64::midpoint(bottom, top)], &title, font.turned(-90.0));
    }
}

/// A field on the sheet.
pub(super) struct Field<'a> {
    pub grid: &'a Grid,
    /// The area in which the field is known.
    pub region: &'a [Line],
    pub bands: Bands,
    /// From grid units to the sheet.
    pub at: &'a dyn Fn(Node) -> Px,
}

impl Field<'_> {
    fn placed(&self, lines: &[Line]) -> Vec<Vec<Px>> {
        lines.iter().map(|line| line.iter().map(|&node| (self.at)(node)).collect()).collect()
    }

    fn area(&self, lines: &[Line]) -> String {
        self.placed(lines).iter().map(|ring| path(ring, true)).collect()
    }

    /// The bands, their iso-lines, and as many labels on them as find room beside what `spots` holds already.
    pub(super) fn draw(&self, canvas: &mut Canvas, font: Font, spots: &mut Spots) {
        // Beyond the known area the field is carried on, so that every band reaches its edge, and then cut off there.
        let full = self.grid.extended(3);
        let region = self.area(self.region);
        let limits = 1..self.bands.count;
        let mut lines = Vec::new();
        canvas.clipped(&region, |canvas| {
            canvas.path(&region, &format!(r#"fill="{}""#, self.bands.colour(0)));
            for i in limits.clone() {
                let area = self.area(&full.area_above(self.bands.limit(i)));
                canvas.path(&area, &format!(r#"fill="{}""#, self.bands.colour(i)));
            }
            for i in limits {
                let at_limit = self.placed(&full.iso_lines(self.bands.limit(i)));
                let d: String = at_limit.iter().map(|line| path(line, false)).collect();
                canvas.path(&d, &format!(r#"fill="none" stroke="{INK}" stroke-opacity="0.6" stroke-width="0.8""#));
                lines.extend(at_limit.into_iter().map(|points| Labelled { points, text: self.bands.text(i) }));
            }
        });
        canvas.path(&region, &format!(r#"fill="none" stroke="{INK}" stroke-width="1.2" stroke-linejoin="round""#));
        spots.label(canvas, &lines, font, &self.placed(self.region));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_round_few_and_hold_every_value() {
        for (low, high) in [(0.64, 3.83), (0.0, 1.62), (1.0, 1.64), (1e-6, 2e-6), (0.3, 1234.0), (-1.0, 2.0)] {
            let bands = Bands::of([low, high]);
            assert!((7..=16).contains(&bands.count), "{low} {high}: {bands:?}");
            assert!(bands.limit(0) <= low + 1e-5 * bands.step && high - 1e-5 * bands.step <= bands.limit(bands.count));
        }
        assert_eq!(Bands::of([1.0, 1.0]).count, 1);
        assert_eq!(Bands::of([0.0, 0.0]).count, 1);
    }
}
