//! A report on paper: A4 pages with headings, tables and figures that are never cut, as PDF.
//!
//! Laid out here and drawn with krilla, which the figures are drawn with, too: no browser is needed, and no second engine comes into the program.

mod blocks;
mod face;
mod page;
mod table;

use krilla::color::rgb;
use krilla::destination::XyzDestination;
use krilla::geom::{PathBuilder, Point, Rect, Size, Transform};
use krilla::metadata::Metadata;
use krilla::outline::{Outline, OutlineNode};
use krilla::page::PageSettings;
use krilla::paint::Fill;
use krilla::surface::Surface;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::usvg::Tree;

use stiffarm_ask::report::Report;

use crate::raster::{RasterError, tree};
use face::{Cut, Faces};
use page::{Colour, FAINT, GREY, LEFT, Mark, PAGE, Page, RIGHT, Style};

/// A report as a PDF file, its texts as texts.
///
/// # Errors
/// Where a figure is no SVG, or cannot be drawn.
pub(crate) fn of(report: &Report) -> Result<Vec<u8>, RasterError> {
    let odd = |what: &str| RasterError::Pdf(what.to_owned());
    let faces = Faces::new().ok_or_else(|| odd("a font is missing"))?;
    let figures: Vec<Tree> = report.figures().map(|one| tree(&one.svg)).collect::<Result<_, _>>()?;
    let mut page = Page::new(&faces);
    blocks::draw(&mut page, report, &figures);
    footers(&mut page, &report.title);
    let mut document = krilla::Document::new();
    let made_by = concat!("stiffarm ", env!("CARGO_PKG_VERSION"));
    document.set_metadata(Metadata::new().title(report.title.clone()).language("en".into()).creator(made_by.into()));
    let settings = || Size::from_wh(PAGE[0], PAGE[1]).map(PageSettings::new).ok_or_else(|| odd("a page has no size"));
    for marks in &page.pages {
        let mut page = document.start_page_with(settings()?);
        let mut surface = page.surface();
        for mark in marks {
            draw(&mut surface, mark, &faces, &figures).ok_or_else(|| odd("a part of it cannot be drawn"))?;
        }
        surface.finish();
        page.finish();
    }
    document.set_outline(outline(&page));
    document.finish().map_err(|error| RasterError::Pdf(format!("{error:?}")))
}

/// Title and number of every page.
fn footers(page: &mut Page, title: &str) {
    let style = Style::new(Cut::Plain, 7.5, GREY);
    let (count, y) = (page.pages.len(), PAGE[1] - 30.0);
    let face = page.faces.of(style.cut);
    let title = page::one_line(face, title, style.size, 0.8 * (RIGHT - LEFT));
    for (i, page) in page.pages.iter_mut().enumerate() {
        let number = format!("{} / {count}", i + 1);
        let x = RIGHT - face.width(&number, style.size);
        page.push(Mark::Box { at: [LEFT, y - 11.0], size: [RIGHT - LEFT, 0.4], colour: FAINT });
        page.push(Mark::Text { at: [LEFT, y], text: title.clone(), style });
        page.push(Mark::Text { at: [x, y], text: number, style });
    }
}

/// Headings for the reader's list of contents.
fn outline(page: &Page) -> Outline {
    let mut outline = Outline::new();
    for (text, page, y) in &page.headings {
        outline.push_child(OutlineNode::new(text.clone(), XyzDestination::new(*page, Point::from_xy(LEFT, *y))));
    }
    outline
}

fn fill([red, green, blue]: Colour) -> Fill {
    Fill { paint: rgb::Color::new(red, green, blue).into(), ..Fill::default() }
}

/// Draws one mark; `None` where it cannot be drawn.
fn draw(surface: &mut Surface, mark: &Mark, faces: &Faces, figures: &[Tree]) -> Option<()> {
    match mark {
        Mark::Text { at: [x, y], text, style } => {
            let face = faces.of(style.cut);
            surface.set_fill(Some(fill(style.colour)));
            surface.draw_glyphs(Point::from_xy(*x, *y), &face.glyphs(text), face.font.clone(), text, style.size, false);
        }
        Mark::Box { at: [x, y], size: [width, height], colour } => {
            let mut path = PathBuilder::new();
            path.push_rect(Rect::from_xywh(*x, *y, *width, *height)?);
            surface.set_fill(Some(fill(*colour)));
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

#[cfg(test)]
mod tests {
    use stiffarm_ask::answer::{Headline, Outcome, Table};

    use super::page::{BOTTOM, TOP};
    use super::*;
    use stiffarm_ask::report::{Block, Listing, Section};

    /// A report with everything that could be cut: long tables, cells without blanks, figures of every height, texts over pages.
    fn report() -> Report {
        let svg = |height: f64| {
            format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="700" height="{height}"><rect width="9" height="9"/></svg>"#
            )
        };
        let mut section = Section::new("A section ".repeat(20));
        for count in [3, 20, 23, 200] {
            let mut table = Table::new(["number", "a name", "words"]);
            for i in 0..count {
                let long = if i % 7 == 3 { "long ".repeat(40) } else { "x".repeat(i) };
                table.row([i.to_string(), format!("row_{i}"), long]);
            }
            section.heading(format!("Of {count} rows"));
            section.blocks.push(Block::Table(Listing { table, is_sortable: true }));
            section.figure(svg(300.0 * count as f64), "A figure");
        }
        section.text("word ".repeat(3000));
        section.notes(["note ".repeat(900)]);
        section.blocks.push(Block::Code("key = \"value\"\n".repeat(120) + &"w".repeat(500)));
        let sentences = vec!["It holds. ".repeat(300)];
        Report {
            title: "<&> ".repeat(60),
            asked: String::new(),
            headline: Headline { outcome: Outcome::Fails, sentences, rests_on: vec!["Nothing.".into()] },
            sections: vec![section, Section::new("Empty").on_new_page()],
        }
    }

    #[test]
    fn nothing_leaves_its_page_and_no_row_and_no_figure_is_cut() {
        let (report, faces) = (report(), Faces::new().unwrap());
        let figures: Vec<Tree> = report.figures().map(|one| tree(&one.svg).unwrap()).collect();
        let mut page = Page::new(&faces);
        blocks::draw(&mut page, &report, &figures);
        assert!(8 < page.pages.len());
        let mut drawn = 0;
        for mark in page.pages.iter().flatten() {
            let ([left, top], [right, bottom]) = match mark {
                Mark::Text { at: [x, y], text, style } => {
                    ([*x, y - style.size], [x + faces.of(style.cut).width(text, style.size), *y])
                }
                Mark::Box { at: [x, y], size: [width, height], .. } => ([*x, *y], [x + width, y + height]),
                Mark::Figure { at: [x, y], number, scale } => {
                    drawn += 1;
                    let size = figures[*number].size();
                    ([*x, *y], [x + scale * size.width(), y + scale * size.height()])
                }
            };
            let slack = 1.5;
            assert!(LEFT - slack <= left && right <= RIGHT + slack, "{mark:?}");
            assert!(TOP - slack <= top && bottom <= BOTTOM + slack, "{mark:?}");
        }
        assert_eq!(drawn, 4);
        // A row's number and its name stand on one page.
        let page_of = |wanted: &str| {
            page.pages
                .iter()
                .position(|page| page.iter().any(|mark| matches!(mark, Mark::Text { text, .. } if text == wanted)))
        };
        assert!((0..200).all(|i| page_of(&format!("row_{i}")).is_some()));
        // Headings of the long table stand on every page that it has.
        let heads = page
            .pages
            .iter()
            .filter(|page| page.iter().any(|mark| matches!(mark, Mark::Text { text, .. } if text == "a name")));
        assert!(4 < heads.count());
    }

    #[test]
    fn a_figure_that_is_none_is_refused() {
        let mut odd = report();
        odd.sections[1].figure("no svg".into(), "");
        assert!(matches!(of(&odd), Err(RasterError::Svg(_))));
        assert!(of(&report()).unwrap().starts_with(b"%PDF-"));
    }
}
