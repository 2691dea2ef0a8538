//! Scales, round ticks and the frame of a diagram.

use stiffarm::palette::{FAINT, GREY, INK};

use super::canvas::{Canvas, Font, Px};

/// Size of tick labels and of axis titles, px.
const TICK: f64 = 12.0;
const TITLE: f64 = 13.0;

/// A linear scale from values to px.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub from: f64,
    pub to: f64,
    pub px: [f64; 2],
}

impl Axis {
    /// A scale that has a width whatever it is given.
    pub(crate) fn new(from: f64, to: f64, px: [f64; 2]) -> Self {
        let (from, to) = if from.is_finite() && to.is_finite() { (from, to) } else { (0.0, 1.0) };
        if from < to && 1e-9 * from.abs().max(to.abs()) < to - from {
            return Self { from, to, px };
        }
        let half = if from == 0.0 { 0.5 } else { 0.1 * from.abs() };
        Self { from: from - half, to: from + half, px }
    }

    pub(crate) fn at(&self, value: f64) -> f64 {
        self.px[0] + (value - self.from) / (self.to - self.from) * (self.px[1] - self.px[0])
    }

    pub(crate) fn contains(&self, value: f64) -> bool {
        self.from <= value && value <= self.to
    }

    /// Round values on the scale, `gap` px or more apart, and their step.
    pub(crate) fn ticks(&self, gap: f64) -> (Vec<f64>, f64) {
        let most = ((self.px[1] - self.px[0]).abs() / gap).clamp(1.0, 50.0);
        let step = nice_step(self.to - self.from, most);
        let slack = 1e-6;
        let (first, last) = ((self.from / step - slack).ceil(), (self.to / step + slack).floor());
        let count = if first <= last { (last - first).min(60.0) as u32 + 1 } else { 0 };
        ((0..count).map(|i| (first + f64::from(i)) * step).collect(), step)
    }
}

/// The smallest of 1, 2, 2.5, 5 x 10^n that divides `span` into at most `most` parts.
pub(crate) fn nice_step(span: f64, most: f64) -> f64 {
    let least = span / most;
    if !(f64::MIN_POSITIVE <= least && least.is_finite()) {
        return 1.0;
    }
    let decade = 10_f64.powf(least.log10().floor());
    let enough = |&factor: &f64| least <= factor * decade * (1.0 + 1e-9);
    [1.0, 2.0, 2.5, 5.0].into_iter().find(enough).unwrap_or(10.0) * decade
}

/// A value with the decimals that a step needs.
pub(crate) fn label(value: f64, step: f64) -> String {
    if !(1e-6..1e7).contains(&step.abs()) {
        return format!("{value:.2e}");
    }
    let whole = |decimals: &i32| {
        let scaled = step * 10_f64.powi(*decimals);
        (scaled - scaled.round()).abs() < 1e-6 * scaled
    };
    let decimals = (0..9).find(whole).unwrap_or(3);
    // What rounds to zero has no sign.
    let value = if value.abs() < step / 2.0 { 0.0 } else { value };
    format!("{:.*}", decimals as usize, value)
}

/// The least distance of ticks, px: at most `most` of them.
fn gap(axis: Axis, least: f64, most: f64) -> f64 {
    least.max((axis.px[1] - axis.px[0]).abs() / most)
}

/// The frame of a diagram: `x` runs from left to right, `y` upwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub x: Axis,
    pub y: Axis,
}

impl Frame {
    pub(crate) fn at(&self, x: f64, y: f64) -> Px {
        [self.x.at(x), self.y.at(y)]
    }

    /// Left bottom and right top, px.
    pub(crate) fn corners(&self) -> [Px; 2] {
        [[self.x.px[0], self.y.px[0]], [self.x.px[1], self.y.px[1]]]
    }

    /// Faint lines at the ticks.
    pub(crate) fn grid(&self, canvas: &mut Canvas) {
        let [[left, bottom], [right, top]] = self.corners();
        let look = format!(r#"fill="none" stroke="{FAINT}" stroke-width="0.8""#);
        for x in self.x.ticks(gap(self.x, 40.0, 10.0)).0 {
            canvas.line([self.x.at(x), bottom], [self.x.at(x), top], &look);
        }
        for y in self.y.ticks(gap(self.y, 34.0, 10.0)).0 {
            canvas.line([left, self.y.at(y)], [right, self.y.at(y)], &look);
        }
    }

    /// The frame, ticks outside of it, and a title for each axis (none where it is empty).
    pub(crate) fn draw(&self, canvas: &mut Canvas, x_title: &str, y_title: &str) {
        let [[left, bottom], [right, top]] = self.corners();
        canvas.rect([left, bottom], [right, top], &format!(r#"fill="none" stroke="{INK}" stroke-width="1""#));
        let tick = format!(r#"fill="none" stroke="{INK}" stroke-width="1""#);
        let (font, title) = (Font::new(TICK), Font::new(TITLE).middle());
        let (values, step) = self.x.ticks(gap(self.x, 40.0, 10.0));
        for value in values {
            let x = self.x.at(value);
            canvas.line([x, bottom], [x, bottom + 5.0], &tick);
            canvas.text([x, bottom + 14.0], &label(value, step), font.middle());
        }
        let (values, step) = self.y.ticks(gap(self.y, 34.0, 10.0));
        let mut widest: f64 = 0.0;
        for value in values {
            let (y, text) = (self.y.at(value), label(value, step));
            widest = widest.max(font.width(&text));
            canvas.line([left - 5.0, y], [left, y], &tick);
            canvas.text([left - 8.0, y], &text, font.end());
        }
        let x_title = title.cut(x_title, right - left);
        canvas.text([f64::midpoint(left, right), bottom + 33.0], &x_title, title);
        let y_title = title.cut(y_title, bottom - top + 60.0);
        canvas.text([left - 20.0 - widest, f64::midpoint(bottom, top)], &y_title, title.turned(-90.0));
    }

    /// A title above the frame.
    pub(crate) fn headline(&self, canvas: &mut Canvas, text: &str) {
        let [[left, _], [right, top]] = self.corners();
        let font = Font::new(TITLE).bold().middle();
        canvas.text([f64::midpoint(left, right), top - 12.0], &font.cut(text, right - left + 20.0), font);
    }
}

/// Lines of a subtitle: what it warns of must not be cut from a narrow figure.
const MOST_LINES: usize = 12;

/// The heading of a figure; returns the height it takes, px.
pub(crate) fn heading(canvas: &mut Canvas, title: &str, subtitle: &str) -> f64 {
    let room = canvas.width - 40.0;
    let mut y = 14.0;
    let (large, small) = (Font::new(19.0).bold(), Font::new(13.0).colour(GREY));
    for (text, font, line, most) in [(title, large, 25.0, 3), (subtitle, small, 19.0, MOST_LINES)] {
        for text in font.wrapped(text, room, most) {
            canvas.text([20.0, y + line / 2.0], &text, font);
            y += line;
        }
    }
    y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_lie_on_the_scale() {
        let axis = Axis::new(-0.31, 2.73, [0.0, 400.0]);
        let (ticks, step) = axis.ticks(50.0);
        assert_eq!(step, 0.5);
        assert_eq!(ticks, [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]);
    }

    #[test]
    fn a_step_is_one_two_two_and_a_half_or_five() {
        for (span, most, step) in
            [(10.0, 10.0, 1.0), (11.0, 10.0, 2.0), (24.0, 10.0, 2.5), (0.3, 10.0, 0.05), (60.0, 10.0, 10.0)]
        {
            assert!((nice_step(span, most) - step).abs() < 1e-12, "{span}/{most}: {}", nice_step(span, most));
        }
        assert_eq!(nice_step(0.0, 10.0), 1.0);
        assert_eq!(nice_step(f64::NAN, 10.0), 1.0);
    }

    #[test]
    fn labels_have_the_decimals_of_their_step() {
        assert_eq!(label(0.75, 0.25), "0.75");
        assert_eq!(label(-0.0, 0.5), "0.0");
        assert_eq!(label(-0.5, 0.5), "-0.5");
        assert_eq!(label(20.0, 10.0), "20");
    }

    #[test]
    fn every_scale_has_a_width() {
        for (from, to) in [(1.0, 1.0), (0.0, 0.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let axis = Axis::new(from, to, [0.0, 100.0]);
            assert!(axis.from < axis.to && axis.at(axis.to) == 100.0, "{axis:?}");
        }
    }
}
