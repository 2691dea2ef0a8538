//! The parts of a report, one below the other.

use resvg::usvg::Tree;
use stiffarm_ask::answer::{Headline, Tone};

use super::face::Cut;
use super::page::{
    BAD, Colour, FAINT, GOOD, GREY, HEIGHT, INK, LEFT, Mark, OPEN, PLAIN, PROSE, Page, RIGHT, SHADE, Style, WIDTH,
};
use super::table;
use stiffarm_ask::report::{Block, Report, Section};

const TITLE: Style = Style::new(Cut::Bold, 19.0, INK);
const SECTION: Style = Style::new(Cut::Bold, 13.5, INK);
const HEADING: Style = Style::new(Cut::Bold, 10.0, INK);
const TEXT: Style = Style::new(Cut::Plain, 9.2, PROSE);
const NOTE: Style = Style::new(Cut::Plain, 7.8, GREY);
const CODE: Style = Style::new(Cut::Mono, 7.8, INK);

/// Points of a page per px of a figure: its smallest text is 8 pt high.
const PER_PX: f32 = 8.0 / 12.0;
/// A figure is not shrunk to less than this to fit what is left of a page.
const LEAST_SCALE: f32 = 0.62;
/// No figure is higher, points.
const HIGHEST: f32 = 0.86 * HEIGHT;
/// Around what stands in a box, points.
const PAD: f32 = 9.0;

/// Fills pages with a report.
pub(super) fn draw(page: &mut Page, report: &Report, figures: &[Tree]) {
    page.paragraph(LEFT, &report.title, TITLE);
    page.skip(2.0);
    page.paragraph(LEFT, &report.asked, Style { colour: GREY, ..TEXT });
    page.skip(12.0);
    verdict(page, &report.headline);
    heading(page, "What this rests on", 40.0);
    notes(page, &report.headline.rests_on, TEXT);
    let mut drawn = 0;
    for one in &report.sections {
        section(page, one, figures, &mut drawn);
    }
    sign(page);
}

/// The answer in a frame of its colour.
fn verdict(page: &mut Page, headline: &Headline) {
    let colour: Colour = match headline.outcome.tone() {
        Tone::Good => GOOD,
        Tone::Bad => BAD,
        Tone::Open => OPEN,
        Tone::Plain => PLAIN,
    };
    let (x, room) = (LEFT + PAD + 6.0, WIDTH - 2.0 * PAD - 6.0);
    let word = Style::new(Cut::Bold, 13.0, colour);
    let mut lines = vec![(headline.outcome.word().to_uppercase(), word)];
    for (i, sentence) in headline.sentences.iter().enumerate() {
        let style = if i == 0 { Style::new(Cut::Bold, 10.4, colour) } else { Style { colour, ..TEXT } };
        lines.extend(page.broken(sentence, style, room).into_iter().map(|line| (line, style)));
    }
    // What is longer than a page goes on without a frame.
    let height = lines.iter().map(|(_, style)| style.leading()).sum::<f32>() + 2.0 * PAD;
    page.reserve(height.min(HEIGHT));
    let top = page.y;
    let framed = height.min(page.left());
    for (at, size) in [
        ([LEFT, top], [5.0, framed]),
        ([LEFT, top], [WIDTH, 0.7]),
        ([LEFT, top + framed - 0.7], [WIDTH, 0.7]),
        ([RIGHT - 0.7, top], [0.7, framed]),
    ] {
        page.draw(Mark::Box { at, size, colour });
    }
    page.y += PAD;
    for (line, style) in lines {
        page.reserve(style.leading());
        page.line(x, &line, style);
    }
    page.y += PAD;
    page.skip(12.0);
}

fn section(page: &mut Page, section: &Section, figures: &[Tree], drawn: &mut usize) {
    if section.on_new_page {
        page.new_page();
    }
    page.skip(16.0);
    page.reserve((40.0 + kept(page, &section.blocks, &figures[*drawn..])).min(HEIGHT));
    if !page.is_fresh() {
        page.rule([LEFT, RIGHT], page.y, 1.2, FAINT);
        page.y += 8.0;
    }
    page.headings.push((section.title.clone(), page.pages.len() - 1, page.y));
    page.paragraph(LEFT, &section.title, SECTION);
    page.skip(4.0);
    for (i, block) in section.blocks.iter().enumerate() {
        match block {
            Block::Text(text) => {
                page.paragraph(LEFT, text, TEXT);
                page.skip(5.0);
            }
            Block::Heading(text) => {
                let follows = kept(page, &section.blocks[i + 1..], &figures[*drawn..]);
                heading(page, text, follows);
            }
            Block::Notes(lines) => notes(page, lines, NOTE),
            Block::Table(listing) => table::draw(page, &listing.table),
            Block::Code(text) => code(page, text),
            Block::Figure(one) => {
                if let Some(tree) = figures.get(*drawn) {
                    figure(page, tree, *drawn, &one.caption);
                }
                *drawn += 1;
            }
        }
    }
}

/// How much of what follows a heading stands on its page: texts, and the first table or figure behind them.
fn kept(page: &Page, blocks: &[Block], figures: &[Tree]) -> f32 {
    let mut height = 0.0;
    for block in blocks {
        height += match block {
            Block::Text(text) => page.broken(text, TEXT, WIDTH).len() as f32 * TEXT.leading() + 5.0,
            Block::Notes(lines) => lines.len() as f32 * NOTE.leading() + 7.0,
            Block::Heading(_) => HEADING.leading() + 8.0,
            Block::Table(listing) => return height + table::least(page, &listing.table),
            Block::Figure(_) => return height + figures.first().map_or(0.0, |tree| LEAST_SCALE * placed(tree) + 40.0),
            Block::Code(_) => return height + 5.0 * CODE.leading(),
        };
    }
    height
}

fn heading(page: &mut Page, text: &str, follows: f32) {
    page.skip(6.0);
    page.reserve((HEADING.leading() + 4.0 + follows).min(HEIGHT));
    page.paragraph(LEFT, text, HEADING);
    page.skip(2.0);
}

fn notes(page: &mut Page, lines: &[String], style: Style) {
    for line in lines {
        let broken = page.broken(line, style, WIDTH - 10.0);
        page.reserve(style.leading() * broken.len().min(3) as f32);
        let bullet = page.y + style.size;
        page.text_at([LEFT, bullet], "\u{2022}", style);
        for line in broken {
            page.reserve(style.leading());
            page.line(LEFT + 10.0, &line, style);
        }
    }
    page.skip(7.0);
}

/// How high a figure stands at its own size, points.
fn placed(tree: &Tree) -> f32 {
    tree.size().height() * own_scale(tree)
}

/// As it is laid out, where that fits the page.
fn own_scale(tree: &Tree) -> f32 {
    PER_PX.min(WIDTH / tree.size().width()).min(HIGHEST / tree.size().height())
}

/// A picture, shrunk a little where that keeps it on the page.
fn figure(page: &mut Page, tree: &Tree, number: usize, caption: &str) {
    let caption = page.broken(&format!("Figure {}. {caption}", number + 1), NOTE, WIDTH);
    let below = caption.len() as f32 * NOTE.leading() + 12.0;
    let own = own_scale(tree);
    let left = (page.left() - below) / (tree.size().height() * own);
    if left < LEAST_SCALE {
        page.new_page();
    }
    let fits = ((page.left() - below) / (tree.size().height() * own)).min(1.0);
    let scale = own * fits;
    let x = LEFT + (WIDTH - tree.size().width() * scale) / 2.0;
    page.draw(Mark::Figure { at: [x, page.y], number, scale });
    page.y += tree.size().height() * scale + 3.0;
    for line in caption {
        page.line(LEFT, &line, NOTE);
    }
    page.y += 7.0;
}

/// Letter by letter; lines that are too long go on below.
fn code(page: &mut Page, text: &str) {
    let room = WIDTH - 2.0 * PAD;
    let face = page.faces.of(CODE.cut);
    let mut lines: Vec<String> = Vec::new();
    for line in text.trim_end().lines() {
        let mut rest = line;
        loop {
            let end = face.fitting(rest, CODE.size, room);
            lines.push(rest[..end].to_owned());
            rest = &rest[end..];
            if rest.is_empty() {
                break;
            }
        }
    }
    let height = CODE.leading();
    if (lines.len() as f32) < 12.0 {
        page.reserve(height * lines.len() as f32 + PAD);
    }
    for line in lines {
        page.reserve(height);
        page.draw(Mark::Box { at: [LEFT, page.y - 1.0], size: [WIDTH, height + 0.4], colour: SHADE });
        page.line(LEFT + PAD, &line, CODE);
    }
    page.y += 9.0;
}

/// Who answers for it.
fn sign(page: &mut Page) {
    page.reserve(60.0);
    page.y += 40.0;
    let (gap, count) = (24.0, 3.0);
    let width = (WIDTH - (count - 1.0) * gap) / count;
    for (i, what) in ["date", "computed by", "checked by"].into_iter().enumerate() {
        let x = LEFT + i as f32 * (width + gap);
        page.rule([x, x + width], page.y, 0.6, INK);
        page.text_at([x, page.y + 11.0], what, NOTE);
    }
    page.y += 14.0;
}
