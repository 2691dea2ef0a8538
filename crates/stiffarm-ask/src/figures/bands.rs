//! A field in bands of colour: their limits, the colour bar, the filled area and its iso-lines.

use stiffarm::palette::{GREY, INK, OVER, PAPER, TOLERANCE, UNDER, on_margin_scale, on_scale};

use super::axes::{label, nice_step};
use super::canvas::{Canvas, Font, Px, path};
use super::contour::Grid;
use super::labels::{Labelled, Occupied};
use super::line::{Line, Node};

/// What a bar shows stands beside it in so many lines.
const MOST_LINES: usize = 3;

/// What the colours of a field stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// Light is stiff.
    #[default]
    Deflections,
    /// Dark is near.
    Margins,
    /// Dark is slow.
    Frequencies,
}

impl Colours {
    fn on(self, share: f64) -> String {
        match self {
            Self::Deflections => on_scale(share),
            Self::Margins | Self::Frequencies => on_margin_scale(share),
        }
    }

    /// Below and above the range that was asked for.
    fn beyond(self) -> [&'static str; 2] {
        match self {
            Self::Deflections => [UNDER, OVER],
            Self::Margins | Self::Frequencies => [OVER, UNDER],
        }
    }

    /// What the smallest and the largest values are called.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Deflections => ["stiff", "soft"],
            Self::Margins => ["near", "far"],
            Self::Frequencies => ["slow", "fast"],
        }
    }
}

/// Bands of equal width between round limits; the first and the last are narrower where a range was asked for whose ends are not round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bands {
    pub step: f64,
    first: f64,
    pub count: usize,
    ends: [f64; 2],
    /// Values lie below and above.
    beyond: [bool; 2],
    colours: Colours,
}

impl Bands {
    /// Bands that hold all values from `low` to `high`: about seven to fifteen, one where all values are the same.
    pub(crate) fn of([low, high]: [f64; 2], colours: Colours) -> Self {
        let span = high - low;
        let step = if span <= 1e-9 * high.abs() { nice_step(high.abs(), 5.0) } else { nice_step(span, 14.0) };
        let first = (low / step + 1e-6).floor();
        let count = ((high / step - 1e-6).ceil() - first).clamp(1.0, 40.0) as usize;
        let ends = [first * step, (first + count as f64) * step];
        Self { step, first, count, ends, beyond: [false; 2], colours }
    }

    /// Bands over the range that was asked for, of a field with values from `low` to `high`; those of [`Bands::of`] without one.
    pub(crate) fn within(asked: Option<[f64; 2]>, [low, high]: [f64; 2], colours: Colours) -> Self {
        let Some(ends) = asked else { return Self::of([low, high], colours) };
        let step = nice_step(ends[1] - ends[0], 14.0);
        let first = (ends[0] / step + 1e-6).floor();
        let count = ((ends[1] / step - 1e-6).ceil() - first).clamp(1.0, 40.0) as usize;
        let slack = 1e-9 * (ends[1] - ends[0]);
        Self { step, first, count, ends, beyond: [low < ends[0] - slack, ends[1] + slack < high], colours }
    }

    /// The `i`-th limit, from 0 to `count`.
    pub(crate) fn limit(&self, i: usize) -> f64 {
        match i {
            0 => self.ends[0],
            i if i == self.count => self.ends[1],
            i => (self.first + i as f64) * self.step,
        }
    }

    /// The limit as text.
    pub(crate) fn text(&self, i: usize) -> String {
        let value = self.limit(i);
        let parts = value / self.step;
        if (parts - parts.round()).abs() < 1e-6 { label(value, self.step) } else { value.to_string() }
    }

    /// From where to where the band above the `i`-th limit goes.
    fn between(&self, i: usize) -> String {
        format!("{} to {}", self.text(i), self.text(i + 1))
    }

    /// The colour of the band above the `i`-th limit.
    fn colour(&self, i: usize) -> String {
        self.colours.on(self.share(f64::midpoint(self.limit(i), self.limit(i + 1))))
    }

    /// The colour of the band that holds a value.
    pub(crate) fn of_value(&self, value: f64) -> String {
        let [under, over] = self.colours.beyond();
        if value < self.ends[0] && self.beyond[0] {
            return under.into();
        }
        if self.ends[1] < value && self.beyond[1] {
            return over.into();
        }
        let i = (0..self.count).rev().find(|i| self.limit(*i) <= value).unwrap_or(0);
        self.colour(i)
    }

    /// How far a value lies from the first limit to the last.
    fn share(&self, value: f64) -> f64 {
        (value - self.ends[0]) / (self.ends[1] - self.ends[0])
    }

    /// The bands as a scale from 0 to 1, each colour from where it begins to where it ends.
    pub(crate) fn scale(&self) -> Vec<(f64, String)> {
        let at = |i: usize| self.share(self.limit(i));
        (0..self.count).flat_map(|i| [i, i + 1].map(|end| (at(end), self.colour(i)))).collect()
    }

    /// The colour bar between two corners, its limits on the right, what it shows beside them, read upwards.
    pub(crate) fn bar(&self, canvas: &mut Canvas, [left, bottom]: Px, [right, top]: Px, title: &str) {
        let y = |i: usize| bottom - self.share(self.limit(i)) * (bottom - top);
        let (font, thin) = (Font::new(12.0), format!(r#"stroke="{INK}" stroke-width="0.8""#));
        let mut widest: f64 = 0.0;
        for i in 0..self.count {
            canvas.rect([left, y(i)], [right, y(i + 1)], &format!(r#"fill="{}""#, self.colour(i)));
        }
        canvas.rect([left, bottom], [right, top], &format!(r#"fill="none" stroke="{INK}" stroke-width="1""#));
        let middle = f64::midpoint(left, right);
        let tips = [[bottom, 13.0], [top, -13.0]];
        for ((beyond, colour), [end, length]) in self.beyond.into_iter().zip(self.colours.beyond()).zip(tips) {
            if beyond {
                let tip = path(&[[left, end], [right, end], [middle, end + length]], true);
                canvas.path(&tip, &format!(r#"fill="{colour}" stroke="{INK}" stroke-width="1""#));
            }
        }
        let every = (14.0 * self.count as f64 / (bottom - top)).ceil().max(1.0) as usize;
        for i in (0..=self.count).filter(|i| i % every == 0 || *i == self.count) {
            canvas.line([left, y(i)], [right + 4.0, y(i)], &thin);
            let is_crowded = i != self.count && (y(i) - y(self.count)).abs() < 11.0;
            if !is_crowded {
                let text = self.text(i);
                widest = widest.max(font.width(&text));
                canvas.text([right + 7.0, y(i)], &text, font);
            }
        }
        let (word, [small, large]) = (font.middle().colour(GREY), self.colours.words());
        let further = self.beyond.map(|beyond| if beyond { 13.0 } else { 0.0 });
        canvas.text([middle, bottom + 12.0 + further[0]], small, word);
        canvas.text([middle, top - 11.0 - further[1]], large, word);
        let font = Font::new(13.0).middle();
        // The unit stands at its end, and is never cut.
        let (name, unit) =
            title.rsplit_once(" [").map_or((title, String::new()), |(name, unit)| (name, format!(" [{unit}")));
        let room = bottom - top + 30.0;
        let mut lines = font.wrapped(title, room, MOST_LINES + 1);
        if MOST_LINES < lines.len() {
            lines = font.wrapped(name, room, MOST_LINES);
            if let Some(last) = lines.last_mut() {
                *last = font.cut(last, room - font.width(&unit)) + &unit;
            }
        }
        for (i, line) in lines.iter().enumerate() {
            canvas.text(
                [right + 20.0 + widest + 15.0 * i as f64, f64::midpoint(bottom, top)],
                line,
                font.turned(-90.0),
            );
        }
    }
}

/// How the line of what the work allows is drawn.
pub(crate) const TOLERANCE_LINE: &str = r#"fill="none" stroke-width="1.4" stroke-dasharray="10 3 2 3""#;

/// A field on the sheet.
pub(crate) struct Field<'a> {
    pub grid: &'a Grid,
    /// The area in which the field is known.
    pub region: &'a [Line],
    pub bands: Bands,
    /// What the work allows: a line of its own.
    pub tolerance: Option<f64>,
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

    /// The bands, their iso-lines, the edge, and as many labels as find room beside what `occupied` holds already.
    pub(crate) fn draw(&self, canvas: &mut Canvas, font: Font, occupied: &mut Occupied) {
        let lines = self.fill(canvas);
        self.label(canvas, &lines, font, occupied);
    }

    /// The edge, and labels on iso-lines.
    pub(crate) fn label(&self, canvas: &mut Canvas, lines: &[Labelled], font: Font, occupied: &mut Occupied) {
        let region = self.area(self.region);
        canvas.path(&region, &format!(r#"fill="none" stroke="{INK}" stroke-width="1.2" stroke-linejoin="round""#));
        occupied.label(canvas, lines, font, &self.placed(self.region));
    }

    /// The bands and their iso-lines, which may be labelled.
    pub(crate) fn fill(&self, canvas: &mut Canvas) -> Vec<Labelled> {
        // Beyond the known area the field is carried on, so that every band reaches its edge, and then cut off there.
        let full = self.grid.extended(3);
        let region = self.area(self.region);
        let bands = &self.bands;
        let [under, over] = bands.colours.beyond();
        let mut lines = Vec::new();
        canvas.clipped(&region, |canvas| {
            let ground = if bands.beyond[0] { under.into() } else { bands.colour(0) };
            canvas.with_tooltip(&bands.between(0), |canvas| canvas.path(&region, &format!(r#"fill="{ground}""#)));
            for i in usize::from(!bands.beyond[0])..bands.count {
                let area = self.area(&full.area_above(bands.limit(i)));
                canvas.with_tooltip(&bands.between(i), |canvas| {
                    canvas.path(&area, &format!(r#"fill="{}""#, bands.colour(i)));
                });
            }
            if bands.beyond[1] {
                canvas.path(&self.area(&full.area_above(bands.limit(bands.count))), &format!(r#"fill="{over}""#));
            }
            let drawn = usize::from(!bands.beyond[0])..bands.count + usize::from(bands.beyond[1]);
            for i in drawn {
                let at_limit = self.placed(&full.iso_lines(bands.limit(i)));
                let d: String = at_limit.iter().map(|line| path(line, false)).collect();
                canvas.path(&d, &format!(r#"fill="none" stroke="{INK}" stroke-opacity="0.6" stroke-width="0.8""#));
                lines.extend(at_limit.into_iter().map(|points| Labelled { points, text: bands.text(i) }));
            }
            if let Some(tolerance) = self.tolerance {
                let at_limit = self.placed(&full.iso_lines(tolerance));
                let d: String = at_limit.iter().map(|line| path(line, false)).collect();
                canvas.path(&d, &format!(r#"fill="none" stroke="{PAPER}" stroke-opacity="0.85" stroke-width="4.5""#));
                canvas.path(&d, &format!(r#"{TOLERANCE_LINE} stroke="{TOLERANCE}""#));
            }
        });
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_round_few_and_hold_every_value() {
        for (low, high) in [(0.64, 3.83), (0.0, 1.62), (1.0, 1.64), (1e-6, 2e-6), (0.3, 1234.0), (-1.0, 2.0)] {
            let bands = Bands::of([low, high], Colours::Deflections);
            assert!((7..=16).contains(&bands.count), "{low} {high}: {bands:?}");
            assert!(bands.limit(0) <= low + 1e-5 * bands.step && high - 1e-5 * bands.step <= bands.limit(bands.count));
        }
        assert_eq!(Bands::of([1.0, 1.0], Colours::Deflections).count, 1);
        assert_eq!(Bands::of([0.0, 0.0], Colours::Deflections).count, 1);
    }

    #[test]
    fn a_range_that_was_asked_for_ends_where_it_was_asked_and_tells_what_lies_beyond() {
        let bands = |ends, found| Bands::within(Some(ends), found, Colours::Deflections);
        let exact = bands([0.0, 5.0], [0.64, 3.88]);
        assert_eq!((exact.limit(0), exact.limit(exact.count), exact.beyond), (0.0, 5.0, [false; 2]));
        let narrow = bands([0.7, 3.13], [0.64, 3.88]);
        assert_eq!((narrow.limit(0), narrow.limit(narrow.count), narrow.beyond), (0.7, 3.13, [true; 2]));
        let limits: Vec<f64> = (0..=narrow.count).map(|i| narrow.limit(i)).collect();
        assert!(limits.windows(2).all(|pair| pair[0] < pair[1]), "{limits:?}");
        // The same colour for the same value, whatever else is found.
        assert_eq!(bands([0.0, 5.0], [4.0, 9.0]).scale(), exact.scale());
    }
}
