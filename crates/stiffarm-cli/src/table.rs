//! Tables as people read them (plain or Markdown) and as spreadsheets do.

use std::borrow::Cow;
use std::io::{self, Write};

use comfy_table::presets::{ASCII_MARKDOWN, NOTHING};
use comfy_table::{CellAlignment, ContentArrangement};
use stiffarm::answer::{Cell, Rows, Table};
use stiffarm::plain::on_one_line;

/// Aligned text; columns that hold numbers stand to the right.
pub(crate) fn shown(table: &Table, markdown: bool) -> String {
    let mut text = comfy_table::Table::new();
    text.load_style(if markdown { ASCII_MARKDOWN } else { NOTHING });
    text.set_content_arrangement(ContentArrangement::Disabled);
    let shown = |cell: &String| prose(&on_one_line(&cell.replace(['\n', '\r'], " ")), markdown).into_owned();
    text.set_header(table.headings.iter().map(shown));
    let mut is_number = vec![true; table.headings.len()];
    for row in &table.rows {
        for (all, cell) in is_number.iter_mut().zip(row) {
            *all &= looks_like_a_number(cell);
        }
        text.add_row(row.iter().map(shown));
    }
    for (column, is_number) in text.column_iter_mut().zip(is_number) {
        if is_number {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    text.trim_fmt() + "\n"
}

/// Comma-separated values with a line of headings.
pub(crate) fn write_csv(rows: &Rows, out: &mut dyn Write) -> io::Result<()> {
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

#[cfg(test)]
mod tests {
    use stiffarm::answer::{Column, ColumnKind};

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
        let text = shown(&table, true);
        assert!(text.contains(r"&lt;img src=x onerror=y&gt; \| \`a\` &amp; \\\| \[b](c)\\u{7} d"), "{text}");
        assert_eq!(text.lines().count(), 3);
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
