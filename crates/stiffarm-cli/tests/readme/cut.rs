//! Output that a page shows in part: a line `..` stands for lines that are left out.

/// What stands for lines that are left out.
const CUT: &str = "..";

/// The lines between the cuts.
fn parts<'a>(shown: &[&'a str]) -> Vec<Vec<&'a str>> {
    shown.split(|line| *line == CUT).map(<[&str]>::to_vec).collect()
}

/// Is what is shown what was printed, but for its cuts? Each cut leaves out a line or more.
pub(crate) fn is_shown(shown: &[&str], printed: &[&str]) -> bool {
    let parts = parts(shown);
    let [first, inner @ .., last] = parts.as_slice() else { return shown == printed };
    if !printed.starts_with(first) || !printed.ends_with(last) || printed.len() < first.len() + last.len() + 1 {
        return false;
    }
    let end = printed.len() - last.len();
    let mut from = first.len();
    for part in inner {
        // At least one line is left out before it, and one behind it.
        let found = (from + 1..end).find(|at| printed[*at..end].starts_with(part));
        match found {
            Some(at) => from = at + part.len(),
            None => return false,
        }
    }
    from < end
}

/// What tells a line from the others, whatever its numbers: its first cell, or its first two where that is a number.
fn mark(line: &str) -> String {
    let cells: Vec<&str> = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
    match cells.as_slice() {
        [number, name, ..] if !number.contains(char::is_alphabetic) => format!("{number} {name}"),
        [name, _, ..] => (*name).to_owned(),
        [sentence] => sentence.split_whitespace().take(3).collect::<Vec<_>>().join(" "),
        [] => String::new(),
    }
}

/// What is printed now, cut where it was cut; all of it where the lines about a cut are there no more.
pub(crate) fn cut_again(shown: &[&str], printed: &[&str]) -> String {
    let parts = parts(shown);
    if parts.len() == 1 {
        return printed.join("\n");
    }
    let mut kept: Vec<&str> = Vec::new();
    let mut from = 0;
    for (i, part) in parts.iter().enumerate() {
        let is_last = i + 1 == parts.len();
        let find = |line: &str, from: usize| {
            let found = printed[from..].iter().position(|new| mark(new) == mark(line));
            found.map(|at| from + at)
        };
        let (begin, end) = match part.as_slice() {
            [] if i == 0 => (0, 0),
            [] => (printed.len(), printed.len()),
            [begin, .., end] | [begin @ end] => {
                let begin = if i == 0 { Some(0) } else { find(begin, from) };
                let found = begin.and_then(|begin| {
                    let end = if is_last { Some(printed.len() - 1) } else { find(end, begin + part.len().min(2) - 1) };
                    end.map(|end| (begin, end + 1))
                });
                let Some(found) = found else { return printed.join("\n") };
                found
            }
        };
        if from < begin {
            kept.push(CUT);
        }
        kept.extend(&printed[begin..end]);
        from = end;
    }
    kept.join("\n")
}

#[test]
fn a_cut_stands_for_a_line_or_more_and_the_rest_is_as_printed() {
    let printed = ["a", "b", "c", "d"];
    for shown in [&["a", "b", "c", "d"][..], &["a", "..", "d"], &["..", "d"], &["a", ".."], &["..", "c", ".."]] {
        assert!(is_shown(shown, &printed), "{shown:?}");
    }
    for shown in [
        &["a", "..", "c"][..],
        &["a", "b", "..", "c", "d"],
        &["b", ".."],
        &["a", "..", "x", ".."],
        &["a", "..", "b", ".."],
    ] {
        assert!(!is_shown(shown, &printed), "{shown:?}");
    }
}

#[test]
fn what_is_written_anew_is_cut_where_it_was_cut() {
    let shown = ["title", "..", " least   1.0", " most    2.0", ".."];
    let printed = ["title", " robot   A", " least   1.5", " middle  1.7", " most    2.5", "", "a note"];
    assert_eq!(cut_again(&shown, &printed), "title\n..\n least   1.5\n middle  1.7\n most    2.5\n..");
    assert_eq!(cut_again(&["title", "..", " gone    1.0", ".."], &printed), printed.join("\n"), "nobody knows where");
    assert_eq!(cut_again(&["all of it"], &printed), printed.join("\n"));
}
