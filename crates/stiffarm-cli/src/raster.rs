//! PNG and PDF of a figure, made from its very SVG.

use std::sync::Arc;

use krilla::geom::{Size, Transform as PdfTransform};
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};
use stiffarm_ask::figures::fonts::{self, FONT};

/// A PNG with more pixels than this is refused before memory is taken (400 MB).
const MOST_PIXELS: f64 = 1e8;

/// A picture that cannot be made of a figure.
#[derive(Debug, thiserror::Error)]
pub(crate) enum RasterError {
    /// The picture has no pixel, or too many.
    #[error(
        "a picture of {width} x {height} pixels; expected at least one and at most {MOST_PIXELS:e}: a smaller width-mm, or .svg or .pdf"
    )]
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
pub(crate) fn tree(svg: &str) -> Result<usvg::Tree, RasterError> {
    let mut known = fontdb::Database::new();
    known.load_font_data(fonts::plain().to_vec());
    known.load_font_data(fonts::bold().to_vec());
    let options = usvg::Options { fontdb: Arc::new(known), font_family: FONT.into(), ..usvg::Options::default() };
    Ok(usvg::Tree::from_str(svg, &options)?)
}

/// Draws an SVG as a PNG, `scale` pixels per SVG pixel, on white.
pub(crate) fn png(svg: &str, scale: f32) -> Result<Vec<u8>, RasterError> {
    let tree = tree(svg)?;
    let [width, height] =
        [tree.size().width(), tree.size().height()].map(|side| (f64::from(side) * f64::from(scale)).ceil());
    let fits = 1.0 <= width && 1.0 <= height && width * height <= MOST_PIXELS;
    let mut pixmap =
        fits.then(|| Pixmap::new(width as u32, height as u32)).flatten().ok_or(RasterError::Size { width, height })?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| RasterError::Png(error.to_string()))
}

/// Draws an SVG as a PDF of one page of its size, its texts as texts.
pub(crate) fn pdf(svg: &str) -> Result<Vec<u8>, RasterError> {
    /// Points of a page per pixel of an SVG.
    const POINTS: f32 = 72.0 / 96.0;
    let tree = tree(svg)?;
    let size = |per_px: f32| Size::from_wh(per_px * tree.size().width(), per_px * tree.size().height());
    let odd = || RasterError::Size { width: tree.size().width().into(), height: tree.size().height().into() };
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
    drawn.ok_or_else(|| RasterError::Pdf("a part of it cannot be drawn".into()))?;
    document.finish().map_err(|error| RasterError::Pdf(format!("{error:?}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30"/>"#;

    #[test]
    fn a_picture_has_the_asked_number_of_pixels() {
        let svg = SVG;
        let bytes = png(svg, 2.0).unwrap();
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        let side = |at: usize| u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        assert_eq!((side(16), side(20)), (80, 60));
    }

    #[test]
    fn a_pdf_has_one_page_of_the_figures_size_on_paper_and_the_texts_as_texts() {
        // 170 mm and 85 mm in pixels of an SVG.
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="642.52" height="321.26"><text x="20" y="20" font-family="DejaVu Sans" font-size="12">1.25 mm</text></svg>"#;
        let bytes = pdf(svg).unwrap();
        assert!(bytes.starts_with(b"%PDF-1."));
        let text = String::from_utf8_lossy(&bytes);
        let page = text.split("/MediaBox").nth(1).unwrap().split(']').next().unwrap();
        let numbers: Vec<f64> = page.replace('[', " ").split_whitespace().filter_map(|n| n.parse().ok()).collect();
        // 170 mm and 85 mm in points.
        for (found, expected) in numbers.iter().zip([0.0, 0.0, 481.89, 240.94]) {
            assert!((found - expected).abs() < 0.02, "{page}");
        }
        assert!(text.contains("/FontFile") && text.contains("DejaVu"), "the font is embedded");
        assert!(matches!(pdf("no svg"), Err(RasterError::Svg(_))));
    }

    #[test]
    fn a_scale_that_makes_no_picture_is_refused() {
        let svg = SVG;
        for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e6] {
            assert!(matches!(png(svg, scale), Err(RasterError::Size { .. })), "{scale}");
        }
        assert!(matches!(png("no svg", 1.0), Err(RasterError::Svg(_))));
    }
}
