//! Figures as SVG text; a view in space as HTML.
//!
//! The SVG is written directly: filled contours need clip paths and rings with holes, lines need dashes, and a layout
//! without overlaps needs the true widths of its texts.

#![allow(clippy::cast_possible_wrap, reason = "grids have some thousand columns and rows at most")]

mod axes;
pub(crate) mod bands;
pub(crate) mod bars;
pub mod calibrate;
mod canvas;
pub(crate) mod compare;
mod contour;
pub(crate) mod face;
mod figure_size;
pub mod fonts;
pub(crate) mod hodograph;
pub(crate) mod identify;
mod labels;
mod legend;
mod line;
pub(crate) mod lobes;
pub(crate) mod map;
mod marks;
pub(crate) mod milled;
pub(crate) mod postures;
pub(crate) mod ranking;
pub mod reach;
pub(crate) mod scene;
pub(crate) mod sheets;
pub(crate) mod shop;
mod stairs;
pub(crate) mod study;
pub(crate) mod swinging;
pub mod view3d;

pub use bands::Colours;
pub use figure_size::FigureSize;

/// A figure that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
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
}

/// Can it be drawn?
#[cfg(test)]
fn is_svg(text: &str) -> bool {
    resvg::usvg::Tree::from_str(text, &resvg::usvg::Options::default()).is_ok()
}
