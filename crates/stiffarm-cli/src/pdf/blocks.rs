//! The parts of a report, one below the other.

use resvg::usvg::Tree;
use stiffarm_ask::answer::{Headline, Tone};

use super::face::Cut;
use super::sheet::{
    BAD, Colour, FAINT, GOOD, GREY, HEIGHT, INK, LEFT, Mark, OPEN, PLAIN, PROSE, RIGHT, SHADE, Sheet, Style, WIDTH,
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
pub(super) fn draw(sheet: &mut Sheet, report: &Report, figures: &[Tree]) {
    sheet.paragraph(LEFT, &report.title, TITLE);
    sheet.skip(2.0);
    sheet.paragraph(LEFT, &report.asked, Style { colour: GREY, ..TEXT });
    sheet.skip(12.0);
    verdict(sheet, &report.headline);
    heading(sheet, "What this rests on", 40.0);
    notes(sheet, &report.headline.rests_on, TEXT);
    let mut drawn = 0;
    for one in &report.sections {
        section(sheet, one, figures, &mut drawn);
    }
    sign(sheet);
}

/// The answer in a frame of its colour.
fn verdict(sheet: &mut Sheet, headline: &Headline) {
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
        lines.extend(sheet.broken(sentence, style, room).into_iter().map(|line| (line, style)));
    }
    // What is longer than a page goes on without a frame.
    let height = lines.iter().map(|(_, style)| style.leading()).sum::<f32>() + 2.0 * PAD;
    sheet.reserve(height.min(HEIGHT));
    let top = sheet.y;
    let framed = height.min(sheet.left());
    for (at, size) in [
        ([LEFT, top], [5.0, framed]),
        ([LEFT, top], [WIDTH, 0.7]),
        ([LEFT, top + framed - 0.7], [WIDTH, 0.7]),
        ([RIGHT - 0.7, top], [0.7, framed]),
    ] {
        sheet.draw(Mark::Box { at, size, colour });
    }
    sheet.y += PAD;
    for (line, style) in lines {
        sheet.reserve(style.leading());
        sheet.line(x, &line, style);
    }
    sheet.y += PAD;
    sheet.skip(12.0);
}

fn section(sheet: &mut Sheet, section: &Section, figures: &[Tree], drawn: &mut usize) {
    if section.on_new_page {
        sheet.new_page();
    }
    sheet.skip(16.0);
    sheet.reserve((40.0 + kept(sheet, &section.blocks, &figures[*drawn..])).min(HEIGHT));
    if !sheet.is_fresh() {
        sheet.rule([LEFT, RIGHT], sheet.y, 1.2, FAINT);
        sheet.y += 8.0;
    }
    sheet.headings.push((section.title.clone(), sheet.pages.len() - 1, sheet.y));
    sheet.paragraph(LEFT, &section.title, SECTION);
    sheet.skip(4.0);
    for (i, block) in section.blocks.iter().enumerate() {
        match block {
            Block::Text(text) => {
                sheet.paragraph(LEFT, text, TEXT);
                sheet.skip(5.0);
            }
            Block::Heading(text) => {
                let follows = kept(sheet, &section.blocks[i + 1..], &figures[*drawn..]);
                heading(sheet, text, follows);
            }
            Block::Notes(lines) => notes(sheet, lines, NOTE),
            Block::Table(listing) => table::draw(sheet, &listing.table),
            Block::Code(text) => code(sheet, text),
            Block::Figure(one) => {
                if let Some(tree) = figures.get(*drawn) {
                    figure(sheet, tree, *drawn, &one.caption);
                }
                *drawn += 1;
            }
        }
    }
}

/// How much of what follows a heading stands on its page: texts, and the first table or figure behind them.
fn kept(sheet: &Sheet, blocks: &[Block], figures: &[Tree]) -> f32 {
    let mut height = 0.0;
    for block in blocks {
        height += match block {
            Block::Text(text) => sheet.broken(text, TEXT, WIDTH).len() as f32 * TEXT.leading() + 5.0,
            Block::Notes(lines) => lines.len() as f32 * NOTE.leading() + 7.0,
            Block::Heading(_) => HEADING.leading() + 8.0,
            Block::Table(listing) => return height + table::least(sheet, &listing.table),
            Block::Figure(_) => return height + figures.first().map_or(0.0, |tree| LEAST_SCALE * placed(tree) + 40.0),
            Block::Code(_) => return height + 5.0 * CODE.leading(),
        };
    }
    height
}

fn heading(sheet: &mut Sheet, text: &str, follows: f32) {
    sheet.skip(6.0);
    sheet.reserve((HEADING.leading() + 4.0 + follows).min(HEIGHT));
    sheet.paragraph(LEFT, text, HEADING);
    sheet.skip(2.0);
}

fn notes(sheet: &mut Sheet, lines: &[String], style: Style) {
    for line in lines {
        let broken = sheet.broken(line, style, WIDTH - 10.0);
        sheet.reserve(style.leading() * broken.len().min(3) as f32);
        let bullet = sheet.y + style.size;
        sheet.text_at([LEFT, bullet], "\u{2022}", style);
        for line in broken {
            sheet.reserve(style.leading());
            sheet.line(LEFT + 10.0, &line, style);
        }
    }
    sheet.skip(7.0);
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
fn figure(sheet: &mut Sheet, tree: &Tree, number: usize, caption: &str) {
    let caption = sheet.broken(&format!("Figure {}. {caption}", number + 1), NOTE, WIDTH);
    let below = caption.len() as f32 * NOTE.leading() + 12.0;
    let own = own_scale(tree);
    let left = (sheet.left() - below) / (tree.size().height() * own);
    if left < LEAST_SCALE {
        sheet.new_page();
    }
    let fits = ((sheet.left() - below) / (tree.size().height() * own)).min(1.0);
    let scale = own * fits;
    let x = LEFT + (WIDTH - tree.size().width() * scale) / 2.0;
    sheet.draw(Mark::Figure { at: [x, sheet.y], number, scale });
    sheet.y += tree.size().height() * scale + 3.0;
    for line in caption {
        sheet.line(LEFT, &line, NOTE);
    }
    sheet.y += 7.0;
}

/// Letter by letter; lines that are too long go on below.
fn code(sheet: &mut Sheet, text: &str) {
    let room = WIDTH - 2.0 * PAD;
    let face = sheet.faces.of(CODE.cut);
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
        sheet.reserve(height * lines.len() as f32 + PAD);
    }
    for line in lines {
        sheet.reserve(height);
        sheet.draw(Mark::Box { at: [LEFT, sheet.y - 1.0], size: [WIDTH, height + 0.4], colour: SHADE });
        sheet.line(LEFT + PAD, &line, CODE);
    }
    sheet.y += 9.0;
}

/// Who answers for it.
fn sign(sheet: &mut Sheet) {
    sheet.reserve(60.0);
    sheet.y += 40.0;
    let (gap, count) = (24.0, 3.0);
    let width = (WIDTH - (count - 1.0) * gap) / count;
    for (i, what) in ["date", "computed by", "checked by"].into_iter().enumerate() {
        let x = LEFT + i as f32 * (width + gap);
        sheet.rule([x, x + width], sheet.y, 0.6, INK);
        sheet.text_at([x, sheet.y + 11.0], what, NOTE);
    }
    sheet.y += 14.0;
}
