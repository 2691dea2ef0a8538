//! A table on paper: columns as wide as they need or as there is room, rows whole, headings on every page.

use stiffarm_ask::answer::{Table, Tone, tone_of};

use super::face::Cut;
use super::page::{BAD, Colour, FAINT, GOOD, GREY, LEFT, OPEN, PROSE, Page, RIGHT, Style, WIDTH};
use stiffarm_ask::answer::looks_like_a_number;

/// Sizes of the letters, points: the first with which no word is broken.
const SIZES: [f32; 5] = [8.0, 7.4, 6.8, 6.2, 5.6];
/// Between columns, in parts of the size.
const BETWEEN: f32 = 1.1;
/// Above and below what stands in a row, in parts of the size.
const WITHIN: f32 = 0.34;
/// A cell has no more lines, so that a row fits a page; what is longer is cut.
const MOST_LINES: usize = 60;
/// A table of which so many rows stand alone is kept whole where it can be.
const FEW: usize = 22;

/// A table that is laid out.
struct Laid {
    size: f32,
    /// Left ends and widths.
    columns: Vec<[f32; 2]>,
    is_number: Vec<bool>,
    /// It names on the left what stands on the right.
    names_lines: bool,
}

/// Draws a table.
pub(super) fn draw(page: &mut Page, table: &Table) {
    if table.rows.is_empty() || table.headings.is_empty() {
        return;
    }
    let laid = laid(page, table);
    let rows: Vec<Vec<Vec<String>>> = table.rows.iter().map(|row| laid.broken(page, row, Cut::Plain)).collect();
    let head = (!laid.names_lines).then(|| laid.broken(page, &table.headings, Cut::Bold));
    let of_head = head.as_ref().map_or(0.0, |head| laid.height(head));
    let whole = of_head + rows.iter().map(|row| laid.height(row)).sum::<f32>();
    if laid.stays_whole(rows.len(), whole) {
        page.reserve(whole);
    }
    // No heading stands alone at the foot of a page.
    page.reserve(of_head + rows.iter().take(2).map(|row| laid.height(row)).sum::<f32>());
    laid.head(page, head.as_deref());
    for row in &rows {
        if page.left() < laid.height(row) {
            page.new_page();
            laid.head(page, head.as_deref());
        }
        laid.row(page, row, Style::new(Cut::Plain, laid.size, PROSE));
        page.rule([LEFT, laid.right()], page.y, 0.4, FAINT);
    }
    page.y += 9.0;
}

/// How much room a table needs to begin on a page: all of it where it is short.
pub(super) fn least(page: &Page, table: &Table) -> f32 {
    if table.rows.is_empty() || table.headings.is_empty() {
        return 0.0;
    }
    let laid = laid(page, table);
    let rows = || table.rows.iter().map(|row| laid.height(&laid.broken(page, row, Cut::Plain)));
    let of_head = laid.height(&laid.broken(page, &table.headings, Cut::Bold));
    let whole = of_head + rows().sum::<f32>();
    if laid.stays_whole(table.rows.len(), whole) { whole } else { of_head + rows().take(2).sum::<f32>() }
}

/// Widths and size: what every column needs where there is room, else the room is shared by how much more than its longest word each needs.
fn laid(page: &Page, table: &Table) -> Laid {
    let count = table.headings.len();
    let names_lines = count == 2 && table.headings.iter().all(String::is_empty);
    let is_number =
        (0..count).map(|i| !names_lines && table.rows.iter().all(|row| looks_like_a_number(&row[i]))).collect();
    let needs = |size: f32| -> Vec<[f32; 2]> { (0..count).map(|i| needed(page, table, i, size)).collect() };
    let room = |size: f32| WIDTH - BETWEEN * size * (count - 1) as f32;
    let fits = |size: &f32| needs(*size).iter().map(|need| need[0]).sum::<f32>() <= room(*size);
    // Whole lines are worth smaller letters, down to those that are still read with ease.
    let fits_whole =
        |size: &&f32| SIZES[2] <= **size && needs(**size).iter().map(|need| need[1]).sum::<f32>() <= room(**size);
    let whole = SIZES.iter().find(fits_whole).copied().filter(|_| !names_lines);
    let size = whole.or_else(|| SIZES.into_iter().find(fits)).unwrap_or(SIZES[SIZES.len() - 1]);
    let (needs, room) = (needs(size), room(size));
    let sum = |k: usize| needs.iter().map(|need| need[k]).sum::<f32>();
    let width = |need: &[f32; 2]| match () {
        () if sum(1) <= room => need[1],
        () if sum(0) <= room => need[0] + (room - sum(0)) * (need[1] - need[0]) / (sum(1) - sum(0)).max(1e-3),
        () => need[0] * room / sum(0),
    };
    let mut x = LEFT;
    let columns = needs.iter().map(|need| {
        let column = [x, width(need)];
        x += column[1] + BETWEEN * size;
        column
    });
    Laid { size, columns: columns.collect(), is_number, names_lines }
}

/// What a column needs: its longest word, and its longest cell.
fn needed(page: &Page, table: &Table, i: usize, size: f32) -> [f32; 2] {
    let (plain, bold) = (page.faces.of(Cut::Plain), page.faces.of(Cut::Bold));
    let cells = table.rows.iter().map(|row| (plain, row[i].as_str()));
    let all = cells.chain([(bold, table.headings[i].as_str())]);
    all.fold([0.0_f32; 2], |[word, whole], (face, text)| {
        // A word that takes more than a fifth of the page may be broken.
        let words = text.split_whitespace().map(|word| face.width(word, size).min(0.2 * WIDTH));
        // Slack for the sums of rounded widths.
        [words.fold(word, f32::max), whole.max(face.width(text, size) + 0.1)]
    })
}

impl Laid {
    /// It is not broken over pages: it is short, and its rows are compared. Names with what is said of them are read one by one.
    fn stays_whole(&self, rows: usize, height: f32) -> bool {
        !self.names_lines && rows <= FEW && height <= super::page::HEIGHT
    }

    /// Cells in lines.
    fn broken(&self, page: &Page, cells: &[String], cut: Cut) -> Vec<Vec<String>> {
        let of = |(cell, [_, width]): (&String, &[f32; 2])| {
            let mut lines = page.faces.of(cut).lines(cell, self.size, width + 0.2);
            if MOST_LINES < lines.len() {
                lines.truncate(MOST_LINES);
                lines.extend(["...".to_owned()]);
            }
            lines
        };
        cells.iter().zip(&self.columns).map(of).collect()
    }

    fn height(&self, row: &[Vec<String>]) -> f32 {
        let lines = row.iter().map(Vec::len).max().unwrap_or(0).max(1);
        lines as f32 * super::page::LEADING * self.size + 2.0 * WITHIN * self.size
    }

    fn right(&self) -> f32 {
        if self.names_lines { RIGHT } else { self.columns.last().map_or(RIGHT, |[x, width]| x + width) }
    }

    fn head(&self, page: &mut Page, head: Option<&[Vec<String>]>) {
        if let Some(head) = head {
            self.row(page, head, Style::new(Cut::Bold, self.size, GREY));
            page.rule([LEFT, self.right()], page.y, 0.9, FAINT);
        } else {
            page.rule([LEFT, self.right()], page.y, 0.4, FAINT);
        }
    }

    fn row(&self, page: &mut Page, row: &[Vec<String>], style: Style) {
        let top = page.y + WITHIN * self.size;
        for (i, (lines, [x, width])) in row.iter().zip(&self.columns).enumerate() {
            let colour = if style.cut == Cut::Bold { style.colour } else { self.colour(i, &lines.join(" ")) };
            let style = Style { colour, ..style };
            for (k, line) in lines.iter().enumerate() {
                let own = page.faces.of(style.cut).width(line, style.size);
                let x = if self.is_number[i] { x + width - own } else { *x };
                page.text_at([x, top + style.size + k as f32 * style.leading()], line, style);
            }
        }
        page.y += self.height(row);
    }

    /// Names are grey, verdicts have their colour.
    fn colour(&self, column: usize, text: &str) -> Colour {
        match tone_of(text) {
            _ if self.names_lines && column == 0 => GREY,
            Some(Tone::Bad) => BAD,
            Some(Tone::Good) => GOOD,
            Some(Tone::Open) => OPEN,
            Some(Tone::Plain) | None => PROSE,
        }
    }
}
