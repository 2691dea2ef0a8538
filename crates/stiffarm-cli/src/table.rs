//! Tables as people read them (plain or Markdown) and as spreadsheets do.

pub(crate) use stiffarm::report::fixed;

use comfy_table::presets::{ASCII_MARKDOWN, NOTHING};
use comfy_table::{CellAlignment, ContentArrangement};

/// Headings and rows of text; numbers keep the digits they were given.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    headings: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new<S: Into<String>>(headings: impl IntoIterator<Item = S>) -> Self {
        Self { headings: headings.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    pub(crate) fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    pub(crate) fn headings(&self) -> &[String] {
        &self.headings
    }

    /// The cells of one column.
    pub(crate) fn column(&self, i: usize) -> Vec<&str> {
        self.rows.iter().map(|row| row.get(i).map_or("", String::as_str)).collect()
    }

    /// Aligned text; columns that hold numbers stand to the right.
    pub(crate) fn text(&self, markdown: bool) -> String {
        let mut table = comfy_table::Table::new();
        table.load_style(if markdown { ASCII_MARKDOWN } else { NOTHING });
        table.set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(&self.headings);
        let shown = |cell: &String| {
            let line = cell.replace(['\n', '\r'], " ");
            if markdown { line.replace('|', "\\|") } else { line }
        };
        for row in &self.rows {
            table.add_row(row.iter().map(shown).collect::<Vec<_>>());
        }
        for (i, column) in table.column_iter_mut().enumerate() {
            if self.rows.iter().all(|row| row.get(i).is_none_or(|cell| is_number(cell))) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        table.trim_fmt() + "\n"
    }

    /// Comma-separated values with a line of headings.
    pub(crate) fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let lines = std::iter::once(&self.headings).chain(&self.rows);
        for line in lines {
            writer.write_record(line).expect("memory takes everything");
        }
        String::from_utf8(writer.into_inner().expect("memory takes everything")).expect("made of text")
    }
}

/// A number with what a table may add to it (marks, verdicts), or a blank.
fn is_number(cell: &str) -> bool {
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
