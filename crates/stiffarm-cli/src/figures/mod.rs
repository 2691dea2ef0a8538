//! Figures for reports: SVG text, and PNG made from that very text; a view in space as HTML.
//!
//! The SVG is written directly: filled contours need clip paths and rings with holes, lines need dashes, and a layout
//! without overlaps needs the true widths of its texts.

#![allow(clippy::cast_possible_wrap, reason = "grids have some thousand columns and rows at most")]

mod axes;
pub(crate) mod bands;
pub(crate) mod bars;
pub(crate) mod calibrate;
mod canvas;
pub(crate) mod compare;
mod contour;
pub(crate) mod face;
pub(crate) mod hodograph;
pub(crate) mod identify;
mod labels;
mod legend;
pub(crate) mod lobes;
pub(crate) mod map;
mod marks;
pub(crate) mod milled;
mod plate;
pub(crate) mod postures;
pub(crate) mod ranking;
pub(crate) mod reach;
pub(crate) mod scene;
pub(crate) mod sheets;
pub(crate) mod shop;
mod stairs;
pub(crate) mod study;
pub(crate) mod view3d;

pub(crate) use plate::Plate;

use std::sync::Arc;

use krilla::geom::{Size, Transform as PdfTransform};
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};

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
    /// The picture cannot be written.
    #[error("the picture cannot be written as PDF: {0}")]
    Pdf(String),
}

/// Reads an SVG, with the font that comes with the program.
pub(crate) fn tree(svg: &str) -> Result<usvg::Tree, FigureError> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.load_font_data(dejavu::sans::bold().to_vec());
    let options =
        usvg::Options { fontdb: Arc::new(fonts), font_family: canvas::FONT.into(), ..usvg::Options::default() };
    Ok(usvg::Tree::from_str(svg, &options)?)
}

/// Draws an SVG as a PNG, `scale` pixels per SVG pixel, on white.
pub(crate) fn png(svg: &str, scale: f32) -> Result<Vec<u8>, FigureError> {
    let tree = tree(svg)?;
    let [width, height] =
        [tree.size().width(), tree.size().height()].map(|side| (f64::from(side) * f64::from(scale)).ceil());
    let fits = 1.0 <= width && 1.0 <= height && width * height <= MOST_PIXELS;
    let mut pixmap =
        fits.then(|| Pixmap::new(width as u32, height as u32)).flatten().ok_or(FigureError::Size { width, height })?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| FigureError::Png(error.to_string()))
}

/// Draws an SVG as a PDF of one page of its size, its texts as texts.
pub(crate) fn pdf(svg: &str) -> Result<Vec<u8>, FigureError> {
    /// Points of a page per pixel of an SVG.
    const POINTS: f32 = 72.0 / 96.0;
    let tree = tree(svg)?;
    let size = |per_px: f32| Size::from_wh(per_px * tree.size().width(), per_px * tree.size().height());
    let odd = || FigureError::Size { width: tree.size().width().into(), height: tree.size().height().into() };
    let (page_size, own_size) = (size(POINTS).ok_or_else(odd)?, size(1.0).ok_or_else(odd)?);
    let mut document = krilla::Document::new();
    document.set_metadata(Metadata::new().creator(concat!("stiffarm ", env!("CARGO_PKG_VERSION")).into()));
    let mut page = document.start_page_with(PageSettings::new(page_size));
    let mut surface = page.surface();
    surface.push_transform(&PdfTransform::from_scale(POINTS, POINTS));
    let drawn = surface.draw_svg(&tree, own_size, SvgSettings::default());
    surface.pop();
    surface.finish();
    page.finish();
    drawn.ok_or_else(|| FigureError::Pdf("a part of it cannot be drawn".into()))?;
    document.finish().map_err(|error| FigureError::Pdf(format!("{error:?}")))
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
    fn a_pdf_has_one_page_of_the_figures_size_on_paper_and_the_texts_as_texts() {
        let mut canvas = canvas::Canvas::of(&Plate { width_mm: Some(170.0), scale: None });
        canvas.height = canvas.width / 2.0;
        canvas.text([20.0, 20.0], "1.25 mm", canvas::Font::new(12.0));
        let bytes = pdf(&canvas.finish()).unwrap();
        assert!(bytes.starts_with(b"%PDF-1."));
        let text = String::from_utf8_lossy(&bytes);
        let page = text.split("/MediaBox").nth(1).unwrap().split(']').next().unwrap();
        let numbers: Vec<f64> = page.replace('[', " ").split_whitespace().filter_map(|n| n.parse().ok()).collect();
        // 170 mm and 85 mm in points.
        for (found, expected) in numbers.iter().zip([0.0, 0.0, 481.89, 240.94]) {
            assert!((found - expected).abs() < 0.02, "{page}");
        }
        assert!(text.contains("/FontFile") && text.contains("DejaVu"), "the font is embedded");
        assert!(matches!(pdf("no svg"), Err(FigureError::Svg(_))));
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
