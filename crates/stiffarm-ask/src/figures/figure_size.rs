//! How wide is a figure on paper, and from where to where do its colours go?

use crate::request::{Refusal, Request, opt};
use stiffarm::interval::Interval;

/// The width of a figure that is to be seen on a screen, px. Smallest text: 12 px.
const WIDTH: f64 = 1000.0;
/// On paper: the smallest text is 8 pt high, mm per px.
const MM_PER_PX: f64 = 8.0 / 12.0 * 25.4 / 72.0;
/// Below this nothing would find room beside its texts; they get smaller then, px.
const NARROWEST: f64 = 560.0;
/// Dots of a picture on paper per inch, and those that an SVG counts.
const DPI: [f32; 2] = [300.0, 96.0];

/// What was asked of the figure alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct FigureSize {
    /// Its width on paper; without it, it is made for a screen.
    pub width_mm: Option<f64>,
    /// From where to where its colours, bars or curves go, in the unit of what is drawn; what is found without it.
    pub scale: Option<Interval>,
}

impl FigureSize {
    /// As it was asked for.
    ///
    /// # Errors
    /// Where the range is none.
    pub fn of(asked: &Request) -> Result<Self, Refusal> {
        let scale = if asked.verb.setting(opt::SCALE).is_some() { asked.scale()? } else { None };
        Ok(Self { width_mm: asked.width_mm(), scale })
    }

    /// So many px of a wide sheet are laid out; texts keep their size.
    pub fn width(&self) -> f64 {
        self.width_mm.map_or(WIDTH, |mm| (mm / MM_PER_PX).clamp(NARROWEST, WIDTH))
    }

    /// Pixels of a picture per px of its SVG.
    pub fn pixels(&self) -> f32 {
        if self.width_mm.is_some() { DPI[0] / DPI[1] } else { 2.0 }
    }

    /// The range of the scale, where one was asked for.
    pub fn ends(&self) -> Option<[f64; 2]> {
        self.scale.map(|scale| [scale.min(), scale.max()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_text_has_eight_points_on_paper_where_there_is_room() {
        let figure_size = |width_mm| FigureSize { width_mm: Some(width_mm), scale: None };
        // 12 px of a sheet, in points on paper.
        let points = |mm: f64| 12.0 * mm / figure_size(mm).width() / 25.4 * 72.0;
        assert!((points(170.0) - 8.0).abs() < 1e-9 && (points(140.0) - 8.0).abs() < 1e-9);
        assert!(5.0 < points(85.0) && points(85.0) < 8.0, "a column: {}", points(85.0));
        assert_eq!((FigureSize::default().width(), FigureSize::default().pixels()), (1000.0, 2.0));
    }
}
