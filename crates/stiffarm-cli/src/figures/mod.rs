//! Figures for reports: SVG text, and PNG made from that very text; a view in space as HTML.
//!
//! The SVG is written directly: filled contours need clip paths and rings with holes, lines need dashes, and a layout
//! without overlaps needs the true widths of its texts.

#![allow(clippy::cast_possible_wrap, reason = "grids have some thousand columns and rows at most")]

mod axes;
mod bands;
pub(crate) mod bars;
mod canvas;
mod contour;
pub(crate) mod face;
mod labels;
mod legend;
pub(crate) mod map;
mod marks;
pub(crate) mod ranking;
pub(crate) mod reach;
pub(crate) mod scene;
mod stairs;
pub(crate) mod study;
pub(crate) mod view3d;

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};

/// The width of every figure, px. Smallest text: 12 px.
const WIDTH: f64 = 1000.0;

/// A PNG with more pixels than this is refused before memory is taken (400 MB).
const MOST_PIXELS: f64 = 1e8;

/// A figure that cannot be made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FigureError {
    /// The numbers given do not fit together.
    #[error("a figure of {what}: {found} values; expected {expected}")]
    Shape {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// There is nothing to draw.
    #[error("{0}")]
    Nothing(&'static str),
    /// The picture has no pixel, or too many.
    #[error("a picture of {width} x {height} pixels; expected at least one and at most {MOST_PIXELS:e}")]
    Size {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The text is no SVG.
    #[error("the figure is no valid SVG: {0}")]
    Svg(#[from] usvg::Error),
    /// The picture cannot be packed.
    #[error("the picture cannot be written as PNG: {0}")]
    Png(String),
}

/// Draws an SVG as a PNG, `scale` pixels per SVG pixel, on white, with the font that comes with the program.
pub(crate) fn png(svg: &str, scale: f32) -> Result<Vec<u8>, FigureError> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.load_font_data(dejavu::sans::bold().to_vec());
    let options =
        usvg::Options { fontdb: Arc::new(fonts), font_family: canvas::FONT.into(), ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(svg, &options)?;
    let [width, height] =
        [tree.size().width(), tree.size().height()].map(|side| (f64::from(side) * f64::from(scale)).ceil());
    let fits = 1.0 <= width && 1.0 <= height && width * height <= MOST_PIXELS;
    let mut pixmap =
        fits.then(|| Pixmap::new(width as u32, height as u32)).flatten().ok_or(FigureError::Size { width, height })?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| FigureError::Png(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_the_asked_number_of_pixels() {
        let svg = canvas::Canvas::new(40.0, 30.0).finish();
        let bytes = png(&svg, 2.0).unwrap();
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        let side = |at: usize| u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        assert_eq!((side(16), side(20)), (80, 60));
    }

    #[test]
    fn a_scale_that_makes_no_picture_is_refused() {
        let svg = canvas::Canvas::new(40.0, 30.0).finish();
        for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e6] {
            assert!(matches!(png(&svg, scale), Err(FigureError::Size { .. })), "{scale}");
        }
        assert!(matches!(png("no svg", 1.0), Err(FigureError::Svg(_))));
    }
}
