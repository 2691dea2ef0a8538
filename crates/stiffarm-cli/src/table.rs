//! Tables as people read them (plain or Markdown) and as spreadsheets do.

use std::borrow::Cow;
use std::io::{self, Write};

use comfy_table::presets::{ASCII_MARKDOWN, NOTHING};
use comfy_table::{CellAlignment, ContentArrangement};
use stiffarm::plain::on_one_line;
use stiffarm_ask::answer::{Cell, Rows, Table, looks_like_a_number};
use stiffarm_ask::forms::Piece;

use crate::look::Look;

/// Two blanks, as they stand between columns.
const BETWEEN: usize = 2;

/// Aligned text; columns that hold numbers stand to the right. Where there is no room for all columns, those that can be spared are
/// left out, which is said; what is still too wide is stacked.
pub(crate) fn shown(table: &Table, look: Look) -> String {
    let whole = Look { width: None, ..look };
    let text = |cell: &String| prose(&on_one_line(&cell.replace(['\n', '\r'], " ")), whole).into_owned();
    let cells = Cells {
        headings: table.headings.iter().map(text).collect(),
        rows: table.rows.iter().map(|row| row.iter().map(text).collect()).collect(),
    };
    let Some(width) = look.width.filter(|_| !look.markdown) else {
        let all: Vec<usize> = (0..table.headings.len()).collect();
        return cells.drawn(&all, look);
    };
    if cells.names_lines() || table.is_broken {
        let all: Vec<usize> = (0..table.headings.len()).collect();
        let fits = cells.width(&all) <= width;
        return if fits { cells } else { cells.with_lines_broken(width) }.drawn(&all, look);
    }
    let (kept, left_out) = cells.kept(table, width);
    let blocks = cells.stacked(&kept, table.keys, width);
    let drawn: Vec<String> = blocks.iter().map(|columns| cells.drawn(columns, look)).collect();
    let note = match left_out.as_slice() {
        [] => String::new(),
        names => {
            format!("\nleft out where a line has {width} letters: {}; -o answer.csv has everything\n", names.join(", "))
        }
    };
    drawn.join("\n") + &look.wrapped(&note)
}

/// Words as they are shown.
struct Cells {
    headings: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Cells {
    /// Names on the left, what they say on the right.
    fn names_lines(&self) -> bool {
        self.headings.len() == 2 && self.headings.iter().all(String::is_empty)
    }

    /// What is said behind the first column, in as many lines as it takes; the columns share the room, and what narrow ones leave is the
    /// others'.
    fn with_lines_broken(mut self, width: usize) -> Self {
        let mut widths: Vec<usize> = (1..self.headings.len()).map(|column| self.width_of(column) + BETWEEN).collect();
        widths.sort_unstable();
        let mut left = width.saturating_sub(1 + self.width_of(0));
        let mut share = left;
        for (i, wanted) in widths.iter().enumerate() {
            share = left / (widths.len() - i);
            if share < *wanted {
                break;
            }
            left -= wanted;
        }
        let room = share.saturating_sub(BETWEEN).max(12);
        for cell in self.rows.iter_mut().flat_map(|row| row.iter_mut().skip(1)) {
            let lines = textwrap::wrap(cell, textwrap::Options::new(room).break_words(false));
            *cell = lines.join("\n");
        }
        self
    }

    fn width_of(&self, column: usize) -> usize {
        let cells = self.rows.iter().map(|row| &row[column]).chain([&self.headings[column]]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    }

    fn width(&self, columns: &[usize]) -> usize {
        1 + columns.iter().map(|&column| self.width_of(column) + BETWEEN).sum::<usize>().saturating_sub(BETWEEN)
    }

    /// The columns for which there is room, and the names of those that are spared for it.
    fn kept(&self, table: &Table, width: usize) -> (Vec<usize>, Vec<String>) {
        let mut kept: Vec<usize> = (0..self.headings.len()).collect();
        let mut left_out = Vec::new();
        for name in &table.spare {
            if self.width(&kept) <= width {
                break;
            }
            if let Some(at) = kept.iter().position(|&column| table.headings[column] == *name) {
                kept.remove(at);
                left_out.push(name.clone());
            }
        }
        (kept, left_out)
    }

    /// Blocks of columns, each behind those that say of what a row is.
    fn stacked(&self, columns: &[usize], keys: usize, width: usize) -> Vec<Vec<usize>> {
        let (keys, others) = columns.split_at(keys.min(columns.len()));
        let in_blocks =
            |size: usize| -> Vec<Vec<usize>> { others.chunks(size).map(|block| [keys, block].concat()).collect() };
        let fits = |size: &usize| in_blocks(*size).iter().all(|block| self.width(block) <= width);
        let most = (1..=others.len()).rev().find(fits).unwrap_or(1);
        // As many in the last block as in the first.
        let count = others.len().div_ceil(most).max(1);
        in_blocks(others.len().div_ceil(count).max(1))
    }

    fn drawn(&self, columns: &[usize], look: Look) -> String {
        let of = |cells: &[String]| -> Vec<String> { columns.iter().map(|&column| cells[column].clone()).collect() };
        let mut text = comfy_table::Table::new();
        text.load_style(if look.markdown { ASCII_MARKDOWN } else { NOTHING });
        text.set_content_arrangement(ContentArrangement::Disabled);
        text.set_header(of(&self.headings));
        for row in &self.rows {
            text.add_row(of(row));
        }
        for (column, &of) in text.column_iter_mut().zip(columns) {
            if self.rows.iter().all(|row| looks_like_a_number(&row[of])) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        text.trim_fmt() + "\n"
    }
}

/// Comma-separated values with a line of headings.
pub(crate) fn write_csv(rows: &Rows, out: &mut dyn Write) -> io::Result<()> {
    if let Some(remark) = rows.remark() {
        writeln!(out, "# {}", on_one_line(remark))?;
    }
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(rows.columns().iter().map(|column| &column.name)).map_err(of_system)?;
    for row in rows.iter() {
        for cell in row.iter() {
            let field = match cell {
                Cell::Text(text) => in_spreadsheet(text).into_owned(),
                other => other.to_string(),
            };
            writer.write_field(field.as_bytes()).map_err(of_system)?;
        }
        writer.write_record(None::<&[u8]>).map_err(of_system)?;
    }
    writer.flush()
}

/// What the system has against writing, as it said it: a closed pipe must be known as one.
fn of_system(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// A cell as a spreadsheet may read it: on one line, and no text that it would take for a formula.
fn in_spreadsheet(cell: &str) -> Cow<'_, str> {
    let is_formula = cell.starts_with(['=', '+', '-', '@', '\t', '\r']);
    match on_one_line(cell) {
        clean if is_formula && cell.parse::<f64>().is_err() && cell != "-" => format!("'{clean}").into(),
        clean => clean,
    }
}

/// An answer as people read it.
pub(crate) fn text(pieces: &[Piece], look: Look) -> String {
    let shown = |piece: &Piece| match piece {
        Piece::Table(table) => shown(table, look),
        Piece::Lines(text) => prose(text, look).into_owned(),
        Piece::Verbatim(text) => text.clone(),
        Piece::Break => "\n".into(),
    };
    pieces.iter().map(shown).collect()
}

/// Text of an answer: Markdown shows every letter as it is, a terminal lines that fit it.
pub(crate) fn prose(text: &str, look: Look) -> Cow<'_, str> {
    if !look.markdown {
        return look.wrapped(text);
    }
    if !text.contains(['&', '<', '>', '|', '`', '\\', '[']) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match c {
            '&' => shown.push_str("&amp;"),
            '<' => shown.push_str("&lt;"),
            '>' => shown.push_str("&gt;"),
            '|' | '`' | '\\' | '[' => shown.extend(['\\', c]),
            c => shown.push(c),
        }
    }
    shown.into()
}

#[cfg(test)]
mod tests {
    use stiffarm_ask::answer::{Column, ColumnKind};

    use super::*;

    #[test]
    fn a_spreadsheet_gets_no_formula_and_every_number_as_it_is() {
        let cells = [
            ("=1+1", "'=1+1"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("+cmd|' /C calc'!A0", "'+cmd|' /C calc'!A0"),
            ("-1+1", "'-1+1"),
            ("\t=1", "'\\t=1"),
            ("\r=1", "'\\r=1"),
            ("a\n=1\u{1b}[2J", "a\\n=1\\u{1b}[2J"),
            ("-1.5e-3", "-1.5e-3"),
            ("+2", "+2"),
            ("-", "-"),
            ("", ""),
            ("KR 210 = 2", "KR 210 = 2"),
        ];
        for (cell, expected) in cells {
            assert_eq!(in_spreadsheet(cell), expected);
        }
    }

    #[test]
    fn markdown_shows_every_letter_and_runs_none() {
        let mut table = Table::new(["robot"]);
        table.row(["<img src=x onerror=y> | `a` & \\| [b](c)\u{7}\nd"]);
        let text = shown(&table, Look::MARKDOWN);
        assert!(text.contains(r"&lt;img src=x onerror=y&gt; \| \`a\` &amp; \\\| \[b](c)\\u{7} d"), "{text}");
        assert_eq!(text.lines().count(), 3);
    }

    #[test]
    fn what_has_no_room_is_left_out_or_stacked_and_that_is_said() {
        let mut table = Table::new(["#", "robot", "bound", "A:0.1", "A:0.2"]).with_room(2, &["bound"]);
        table.row(["1", "a long name", "1.111", "2.222 pass", "3.333 fail"]);
        let at = |width: usize| shown(&table, Look { width: Some(width), ..Look::PLAIN });
        let [whole, spared, stacked] = [at(80), at(43), at(35)];
        assert_eq!(whole, shown(&table, Look::PLAIN));
        assert_eq!(whole.lines().next(), Some(" #  robot        bound       A:0.1       A:0.2"));
        assert!(!spared.contains("1.111") && spared.contains("43 letters:\n  bound;"), "{spared}");
        let lines: Vec<&str> = stacked.lines().collect();
        assert_eq!(lines[..2], [" #  robot             A:0.1", " 1  a long name  2.222 pass"]);
        assert_eq!(lines[3..5], [" #  robot             A:0.2", " 1  a long name  3.333 fail"]);
        let mut lines = Table::new(["", ""]);
        lines.row(["name", "one two three four five six seven"]);
        let broken = shown(&lines, Look { width: Some(30), ..Look::PLAIN });
        assert_eq!(broken, "\n name  one two three four five\n       six seven\n");
    }

    #[test]
    fn rows_that_are_made_are_written_as_rows_that_are_kept() {
        let columns = || vec![Column::new("n", ColumnKind::Count), Column::new("name", ColumnKind::Text)];
        let row = |i: usize| vec![Cell::Count(i as i64), Cell::Text(format!("=r{i}"))];
        let kept = Rows::new(columns(), (0..50).map(row).collect());
        let made = Rows::made(columns(), 50, row);
        let csv = |rows: &Rows| {
            let mut bytes = Vec::new();
            write_csv(rows, &mut bytes).unwrap();
            String::from_utf8(bytes).unwrap()
        };
        assert_eq!(csv(&made), csv(&kept));
        assert!(csv(&made).starts_with("n,name\n0,'=r0\n"), "{}", csv(&made));
    }
}
