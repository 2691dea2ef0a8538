//! A report on paper: A4 pages with headings, tables and figures that are never cut, as PDF.
//!
//! Laid out here and drawn with krilla, which the figures are drawn with, too: no browser is needed, and no second engine comes into the program.

mod blocks;
mod face;
mod sheet;
mod table;

use krilla::color::rgb;
use krilla::geom::{PathBuilder, Point, Rect, Size, Transform};
use krilla::destination::XyzDestination;
use krilla::metadata::Metadata;
use krilla::outline::{Outline, OutlineNode};
use krilla::page::PageSettings;
use krilla::paint::Fill;
use krilla::surface::Surface;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::usvg::Tree;

use super::Report;
use crate::failure::Failure;
use crate::figures::{FigureError, tree};
use crate::output::figure;
use face::{Cut, Faces};
use sheet::{Colour, FAINT, GREY, LEFT, Mark, PAGE, RIGHT, Sheet, Style};

impl Report {
    /// The report as a PDF file, its texts as texts.
    ///
    /// # Errors
    /// Where a figure is no SVG, or cannot be drawn.
    pub(crate) fn pdf(&self) -> Result<Vec<u8>, Failure> {
        self.printed().map_err(figure)
    }

    fn printed(&self) -> Result<Vec<u8>, FigureError> {
        let odd = |what: &str| FigureError::Pdf(what.to_owned());
        let faces = Faces::new().ok_or_else(|| odd("a font is missing"))?;
        let figures: Vec<Tree> = self.figures().map(|one| tree(&one.svg)).collect::<Result<_, _>>()?;
        let mut sheet = Sheet::new(&faces);
        blocks::draw(&mut sheet, self, &figures);
        self.footers(&mut sheet);
        let mut document = krilla::Document::new();
        let made_by = concat!("stiffarm ", env!("CARGO_PKG_VERSION"));
        document.set_metadata(Metadata::new().title(self.title.clone()).language("en".into()).creator(made_by.into()));
        let settings = || Size::from_wh(PAGE[0], PAGE[1]).map(PageSettings::new).ok_or_else(|| odd("a page has no size"));
        for marks in &sheet.pages {
            let mut page = document.start_page_with(settings()?);
            let mut surface = page.surface();
            for mark in marks {
                draw(&mut surface, mark, &faces, &figures).ok_or_else(|| odd("a part of it cannot be drawn"))?;
            }
            surface.finish();
            page.finish();
        }
        document.set_outline(outline(&sheet));
        document.finish().map_err(|error| FigureError::Pdf(format!("{error:?}")))
    }

    /// Title and number of every page.
    fn footers(&self, sheet: &mut Sheet) {
        let style = Style::new(Cut::Plain, 7.5, GREY);
        let (count, y) = (sheet.pages.len(), PAGE[1] - 30.0);
        let face = sheet.faces.of(style.cut);
        let title = sheet::one_line(face, &self.title, style.size, 0.8 * (RIGHT - LEFT));
        for (i, page) in sheet.pages.iter_mut().enumerate() {
            let number = format!("{} / {count}", i + 1);
            let x = RIGHT - face.width(&number, style.size);
            page.push(Mark::Box { at: [LEFT, y - 11.0], size: [RIGHT - LEFT, 0.4], colour: FAINT });
            page.push(Mark::Text { at: [LEFT, y], text: title.clone(), style });
            page.push(Mark::Text { at: [x, y], text: number, style });
        }
    }
}

/// Headings for the reader's list of contents.
fn outline(sheet: &Sheet) -> Outline {
    let mut outline = Outline::new();
    for (text, page, y) in &sheet.headings {
        outline.push_child(OutlineNode::new(text.clone(), XyzDestination::new(*page, Point::from_xy(LEFT, *y))));
    }
    outline
}

fn fill([red, green, blue]: Colour) -> Option<Fill> {
    Some(Fill { paint: rgb::Color::new(red, green, blue).into(), ..Fill::default() })
}

/// Draws one mark; `None` where it cannot be drawn.
fn draw(surface: &mut Surface, mark: &Mark, faces: &Faces, figures: &[Tree]) -> Option<()> {
    match mark {
        Mark::Text { at: [x, y], text, style } => {
            let face = faces.of(style.cut);
            surface.set_fill(fill(style.colour));
            surface.draw_glyphs(Point::from_xy(*x, *y), &face.glyphs(text), face.font.clone(), text, style.size, false);
        }
        Mark::Box { at: [x, y], size: [width, height], colour } => {
            let mut path = PathBuilder::new();
            path.push_rect(Rect::from_xywh(*x, *y, *width, *height)?);
            surface.set_fill(fill(*colour));
            surface.draw_path(&path.finish()?);
        }
        Mark::Figure { at: [x, y], number, scale } => {
            let tree = figures.get(*number)?;
            let size = Size::from_wh(tree.size().width() * scale, tree.size().height() * scale)?;
            surface.push_transform(&Transform::from_translate(*x, *y));
            surface.draw_svg(tree, size, SvgSettings::default())?;
            surface.pop();
        }
    }
    Some(())
}
