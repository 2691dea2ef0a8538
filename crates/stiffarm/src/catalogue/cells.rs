//! How are tables from outside cut into cells? Which sign parts them is seen from their first line; `#` begins a remark.

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

/// A row with another number of cells than there are headings.
pub(crate) fn miscounted(row: usize, found: usize, expected: usize) -> String {
    format!("row {row}: {found} cells; expected {expected}, as many as headings")
}
