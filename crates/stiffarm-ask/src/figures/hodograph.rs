//! The force across the tool axis over a revolution, as the line that its arrow draws: feed to the right, across upwards.

use std::f64::consts::TAU;

use stiffarm::palette::{DEFLECTION, FAINT, FORCE, GREY, INK};

use super::FigureSize;
use super::axes::{Axis, heading, label};
use super::canvas::{Canvas, Font, Px};
use super::legend::{Entry, Legend};

/// Length of the head of an arrow, px.
const HEAD: f64 = 11.0;

/// A force that turns, in N along the feed and across it.
pub(crate) struct Hodograph {
    /// First line.
    pub title: String,
    /// Second line, in grey.
    pub subtitle: String,
    /// Evenly over a revolution.
    pub revolution: Vec<[f64; 2]>,
    /// Over a revolution.
    pub mean: [f64; 2],
    /// What was asked of the figure.
    pub figure_size: FigureSize,
}

impl Hodograph {
    /// The figure as SVG text.
    pub(crate) fn svg(&self) -> String {
        let mut canvas = Canvas::of(&self.figure_size);
        let top = heading(&mut canvas, &self.title, &self.subtitle) + 20.0;
        let radius = 0.36 * canvas.width;
        let centre = [canvas.width / 2.0, top + radius + 20.0];
        let all = || self.revolution.iter().chain([&self.mean]);
        let most = all().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max).max(1e-6);
        let axis = Axis::new(0.0, most, [0.0, radius]);
        let (ticks, step) = axis.ticks(70.0);
        let small = Font::new(12.0).colour(GREY);
        for tick in ticks.into_iter().filter(|tick| 0.0 < *tick) {
            canvas.circle(centre, axis.at(tick), &format!(r#"fill="none" stroke="{FAINT}" stroke-width="0.8""#));
            let at = (TAU / 8.0).sin_cos();
            let place = [centre[0] + axis.at(tick) * at.1, centre[1] - axis.at(tick) * at.0];
            canvas.text(place, &format!("{} N", label(tick, step)), small);
        }
        let thin = format!(r#"stroke="{GREY}" stroke-width="0.8""#);
        canvas.line([centre[0] - radius, centre[1]], [centre[0] + radius + 14.0, centre[1]], &thin);
        canvas.line([centre[0], centre[1] + radius], [centre[0], centre[1] - radius - 14.0], &thin);
        canvas.text([centre[0] + radius + 20.0, centre[1]], "feed", Font::new(12.5));
        canvas.text([centre[0], centre[1] - radius - 22.0], "across, left of the feed", Font::new(12.5).middle());
        let at = |[x, y]: [f64; 2]| [centre[0] + axis.at(x), centre[1] - axis.at(y)];
        let turning = format!(r#"fill="none" stroke="{DEFLECTION}" stroke-width="1.6" stroke-linejoin="round""#);
        if 1 < self.revolution.len() {
            let mut points: Vec<Px> = self.revolution.iter().copied().map(at).collect();
            points.extend(self.revolution.first().copied().map(at));
            canvas.polyline(&points, &turning);
        }
        let look = format!(r#"stroke="{FORCE}" stroke-width="2.6""#);
        arrow(&mut canvas, centre, at(self.mean), &look);
        canvas.circle(centre, 3.0, &format!(r#"fill="{INK}""#));
        let mut entries = vec![Entry::line("mean: what a robot follows", look)];
        if 1 < self.revolution.len() {
            entries.push(Entry::line("tip of the force over a revolution", turning));
        }
        let legend = Legend::new(entries, canvas.width - 80.0, 2);
        let bottom = centre[1] + radius + 24.0;
        legend.draw(&mut canvas, [40.0, bottom]);
        canvas.height = bottom + legend.height() + 18.0;
        canvas.finish()
    }
}

/// An arrow; nothing where it has no length.
pub(crate) fn arrow(canvas: &mut Canvas, from: Px, to: Px, look: &str) {
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    let length = x.hypot(y);
    if length < 1e-9 {
        return;
    }
    canvas.line(from, to, look);
    for side in [-0.4, 0.4] {
        let (s, c) = f64::sin_cos(side);
        let back = [(c * x - s * y) / length, (s * x + c * y) / length];
        canvas.line(to, [to[0] - HEAD * back[0], to[1] - HEAD * back[1]], look);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_are_labelled_in_newtons_and_the_mean_is_drawn() {
        let revolution =
            (0..360).map(|i| (TAU * f64::from(i) / 360.0).sin_cos()).map(|(s, c)| [80.0 * c, 60.0 * s]).collect();
        let figure = Hodograph {
            title: "a".into(),
            subtitle: "b".into(),
            revolution,
            mean: [10.0, 20.0],
            figure_size: FigureSize::default(),
        };
        let svg = figure.svg();
        assert!(
            svg.contains("80 N")
                && svg.contains("mean: what a robot follows")
                && svg.contains(&format!(r#"stroke="{DEFLECTION}""#))
        );
    }
}
