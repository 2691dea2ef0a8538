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
        // The same line where it is still there, else the first that is marked alike.
        let first = |line: &str| {
            let at = |is_it: &dyn Fn(&str) -> bool| (from..printed.len()).find(|&at| is_it(printed[at]));
            at(&|new| new == line).or_else(|| at(&|new| mark(new) == mark(line)))
        };
        // Of those that are marked like the last line of a part the one that keeps its length best.
        let last = |line: &str, begin: usize| {
            let alike = (begin..printed.len()).filter(|&at| mark(printed[at]) == mark(line));
            alike.min_by_key(|at| at.abs_diff(begin + part.len() - 1))
        };
        let (begin, end) = match part.as_slice() {
            [] if i == 0 => (0, 0),
            [] => (printed.len(), printed.len()),
            [head, .., foot] | [head @ foot] => {
                let begin = if i == 0 { Some(0) } else { first(head) };
                let end = begin.and_then(|begin| if is_last { Some(printed.len() - 1) } else { last(foot, begin) });
                let (Some(begin), Some(end)) = (begin, end) else { return printed.join("\n") };
                (begin, end + 1)
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
    let rows = ["title", " A  1", " A  2", " A  3", "a note"];
    assert_eq!(cut_again(&["title", " A  7", " A  8", ".."], &rows), "title\n A  1\n A  2\n..", "rows of one name");
    assert_eq!(cut_again(&shown, &printed), "title\n..\n least   1.5\n middle  1.7\n most    2.5\n..");
    assert_eq!(cut_again(&["title", "..", " gone    1.0", ".."], &printed), printed.join("\n"), "nobody knows where");
    assert_eq!(cut_again(&["all of it"], &printed), printed.join("\n"));
}
