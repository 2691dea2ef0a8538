//! How are tables from outside cut into cells? Which sign parts them is seen from their first line; `#` begins a remark.

use super::Fault;

/// Reads a table with headings; rows with fewer or more cells than those are handed out.
pub(crate) fn cells(text: &str) -> csv::Reader<&[u8]> {
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    let delimiter = [b';', b'\t'].into_iter().find(|&c| first.contains(char::from(c))).unwrap_or(b',');
    csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes())
}

/// The headings of a table, and their line.
pub(crate) fn headings(text: &str, reader: &mut csv::Reader<&[u8]>) -> Result<(usize, csv::StringRecord), Fault> {
    let fault = |message: String| Fault { line: 1, key: String::new(), message };
    let found = reader.headers().map_err(|error| fault(error.to_string()))?;
    if found.iter().all(str::is_empty) {
        return Err(fault("the table is empty; expected a line of headings, and rows below it".into()));
    }
    Ok((line_of(text, found.position()), found.clone()))
}

/// The line of a row, from 1: the reader's own position is where it began to look for the row, before remarks and empty lines.
pub(crate) fn line_of(text: &str, position: Option<&csv::Position>) -> usize {
    let Some(position) = position else { return 1 };
    let passed = text.get(position.byte() as usize..).unwrap_or_default().lines();
    let is_none = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    position.line() as usize + passed.take_while(is_none).count()
}

/// A row with another number of cells than there are headings.
pub(crate) fn miscounted(row: usize, found: usize, expected: usize) -> String {
    let hint = if expected < found { "; decimal commas go with semicolons between the cells" } else { "" };
    format!("row {row}: {found} cells; expected {expected}, as many as headings{hint}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_the_line_on_which_it_stands() {
        let text = "# of a tip\n\na,b\n# first\n# second\n1,2\n\n3,4\n5,6\n#last\n";
        let mut reader = cells(text);
        assert_eq!(line_of(text, reader.headers().unwrap().clone().position()), 3);
        let lines: Vec<usize> = reader.records().map(|record| line_of(text, record.unwrap().position())).collect();
        assert_eq!(lines, [6, 8, 9]);
        let windows = text.replace('\n', "\r\n");
        let lines: Vec<usize> =
            cells(&windows).records().map(|record| line_of(&windows, record.unwrap().position())).collect();
        assert_eq!(lines, [6, 8, 9]);
    }
}
