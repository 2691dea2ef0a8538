//! Tables as people read them (plain or Markdown) and as spreadsheets do.

pub(crate) use stiffarm::report::fixed;

use std::borrow::Cow;
use std::io::{self, Write};

use comfy_table::presets::{ASCII_MARKDOWN, NOTHING};
use comfy_table::{CellAlignment, ContentArrangement};
use stiffarm::plain::on_one_line;

/// Headings and rows of text; numbers keep the digits they were given.
pub(crate) struct Table<'a> {
    headings: Vec<String>,
    rows: Rows<'a>,
}

/// Rows that are kept, or so many that each is made when it is written: a map has a hundred million.
enum Rows<'a> {
    Kept(Vec<Vec<String>>),
    Made(usize, Box<dyn Fn(usize) -> Vec<String> + 'a>),
}

impl<'a> Table<'a> {
    pub(crate) fn new<S: Into<String>>(headings: impl IntoIterator<Item = S>) -> Self {
        Self { headings: headings.into_iter().map(Into::into).collect(), rows: Rows::Kept(Vec::new()) }
    }

    /// A table of `count` rows, of which each is made anew when it is needed.
    pub(crate) fn made<const N: usize>(
        headings: [&str; N],
        count: usize,
        row: impl Fn(usize) -> [String; N] + 'a,
    ) -> Self {
        let rows = Rows::Made(count, Box::new(move |i| row(i).into()));
        Self { headings: headings.map(Into::into).into(), rows }
    }

    /// Adds a row to a table that keeps its rows.
    pub(crate) fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        if let Rows::Kept(rows) = &mut self.rows {
            rows.push(cells.into_iter().map(Into::into).collect());
        }
    }

    pub(crate) fn headings(&self) -> &[String] {
        &self.headings
    }

    /// How many rows.
    pub(crate) fn len(&self) -> usize {
        match &self.rows {
            Rows::Kept(rows) => rows.len(),
            Rows::Made(count, _) => *count,
        }
    }

    /// Are rows made only when they are written? Then no column is looked through before.
    pub(crate) fn is_made(&self) -> bool {
        matches!(self.rows, Rows::Made(..))
    }

    /// The row at `i`.
    pub(crate) fn at(&self, i: usize) -> Cow<'_, [String]> {
        match &self.rows {
            Rows::Kept(rows) => Cow::Borrowed(&rows[i]),
            Rows::Made(_, row) => Cow::Owned(row(i)),
        }
    }

    fn rows(&self) -> impl Iterator<Item = Cow<'_, [String]>> {
        (0..self.len()).map(|i| self.at(i))
    }

    /// Aligned text; columns that hold numbers stand to the right.
    pub(crate) fn text(&self, markdown: bool) -> String {
        let mut table = comfy_table::Table::new();
        table.load_style(if markdown { ASCII_MARKDOWN } else { NOTHING });
        table.set_content_arrangement(ContentArrangement::Disabled);
        let shown = |cell: &String| prose(&on_one_line(&cell.replace(['\n', '\r'], " ")), markdown).into_owned();
        table.set_header(self.headings.iter().map(shown));
        let mut is_number = vec![true; self.headings.len()];
        for row in self.rows() {
            for (all, cell) in is_number.iter_mut().zip(row.iter()) {
                *all &= looks_like_a_number(cell);
            }
            table.add_row(row.iter().map(shown));
        }
        for (column, is_number) in table.column_iter_mut().zip(is_number) {
            if is_number {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        table.trim_fmt() + "\n"
    }

    /// Comma-separated values with a line of headings.
    pub(crate) fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(&self.headings).map_err(of_system)?;
        for row in self.rows() {
            for cell in row.iter() {
                writer.write_field(in_spreadsheet(cell).as_bytes()).map_err(of_system)?;
            }
            writer.write_record(None::<&[u8]>).map_err(of_system)?;
        }
        writer.flush()
    }
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

/// Text of an answer, in which Markdown shows every letter as it is.
pub(crate) fn prose(text: &str, markdown: bool) -> Cow<'_, str> {
    if !markdown || !text.contains(['&', '<', '>', '|', '`', '\\', '[']) {
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

/// A number with what a table may add to it (marks, verdicts), or a blank.
fn looks_like_a_number(cell: &str) -> bool {
    cell.trim().is_empty()
        || matches!(cell, "-" | "~" | "?")
        || cell.starts_with(|c: char| c.is_ascii_digit() || c == '-')
}

/// What each drive gives, in percent.
pub(crate) fn percentages(shares: &[f64; 6]) -> String {
    shares.map(|share| format!("{} %", fixed(share * 100.0, 1))).join(", ")
}

/// Rounded for people, or a dash.
pub(crate) fn fixed_or_dash(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".into(), |value| fixed(value, digits))
}

/// Full precision for programs, or nothing.
pub(crate) fn full(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

#[cfg(test)]
mod tests {
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
        let text = table.text(true);
        assert!(text.contains(r"&lt;img src=x onerror=y&gt; \| \`a\` &amp; \\\| \[b](c)\\u{7} d"), "{text}");
        assert_eq!(text.lines().count(), 3);
    }

    #[test]
    fn rows_that_are_made_are_written_as_rows_that_are_kept() {
        let row = |i: usize| [i.to_string(), format!("r{i}")];
        let mut kept = Table::new(["n", "name"]);
        for i in 0..50 {
            kept.row(row(i));
        }
        let made = Table::made(["n", "name"], 50, row);
        let csv = |table: &Table| {
            let mut bytes = Vec::new();
            table.write_csv(&mut bytes).unwrap();
            bytes
        };
        assert_eq!(csv(&made), csv(&kept));
        assert_eq!(made.text(false), kept.text(false));
    }
}
