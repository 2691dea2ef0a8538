//! Does a source name a colour in numbers or in the words of a format? Only the palette may.

use std::fs;
use std::path::{Path, PathBuf};

/// How formats and plotting libraries write colours, besides `#` and hexadecimal digits.
const WORDS: [&str; 10] =
    ["rgb(", "rgba(", "hsl(", "\"white", "\"black", "\"red\"", "\"tab:", "viridis", "color=\"0.", "colors=\"0."];

/// Every colour that a text names, as it stands there.
fn colours(text: &str) -> Vec<&str> {
    let hash = |(at, _): (usize, &str)| {
        let digits = text[at + 1..].find(|sign: char| !sign.is_ascii_hexdigit()).unwrap_or(text.len() - at - 1);
        let (hash, after) = text[at..].split_at(1 + digits);
        let goes_on = after.starts_with(|sign: char| sign.is_alphanumeric() || sign == '_');
        // Three or six digits, and two with opacity.
        ([3, 4, 6, 8].contains(&digits) && !goes_on).then_some(hash)
    };
    let mut found: Vec<&str> = text.match_indices('#').filter_map(hash).collect();
    found.extend(WORDS.into_iter().filter(|word| text.contains(word)));
    found
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() && name != "robots" && name != "tests" {
            sources(&path, found);
        } else if path
            .extension()
            .is_some_and(|ending| ["rs", "py", "pyi", "html", "css", "js"].iter().any(|of| ending == *of))
        {
            found.push(path);
        }
    }
}

/// A stylesheet without what it declares under a name: `--ink: ...;`.
fn without_named(style: &str) -> String {
    let is_named = |part: &str| part.rsplit('{').next().is_some_and(|last| last.trim_start().starts_with("--"));
    style.split(';').filter(|part| !is_named(part)).collect::<Vec<_>>().join(";")
}

#[test]
fn no_colour_stands_outside_the_palette() {
    let mut files = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."), &mut files);
    let is_palette = |file: &&PathBuf| file.ends_with("stiffarm/src/palette.rs");
    assert_eq!(files.iter().filter(is_palette).count(), 1);
    let fault_of = |file: &PathBuf| {
        let text = fs::read_to_string(file).unwrap();
        // A stylesheet, which knows light and dark, names each of its own colours once.
        let is_style = file.extension().is_some_and(|ending| ending == "css");
        let text = if is_style { without_named(&text) } else { text };
        let found: Vec<String> = colours(&text).into_iter().map(str::to_owned).collect();
        (!found.is_empty()).then(|| format!("{}: {}", file.display(), found.join(", ")))
    };
    let found: Vec<String> = files.iter().filter(|file| !is_palette(file)).filter_map(fault_of).collect();
    assert!(found.is_empty(), "colours belong into crates/stiffarm/src/palette.rs:\n{}", found.join("\n"));
}

#[test]
fn only_what_a_stylesheet_names_is_left_out() {
    let style = ":root {\n  --ink: #112233;\n  --line: #445566;\n}\np { color: #778899; margin: 0; }";
    assert_eq!(colours(&without_named(style)), ["#778899"]);
}

#[test]
fn colours_are_found_however_they_are_written() {
    for text in
        ["fill=\"#1A2b3c\"", "#abc;", "rgb(1, 2, 3)", "x = \"#11223344\"", "color=\"0.6\"", "\"tab:red\"", "\"white\""]
    {
        assert_eq!(colours(text).len(), 1, "{text}");
    }
    for text in ["#[cfg(test)]", "r#\"<svg>\"#", "# headline", "#added", "issue #12", "#abcdefgh", "on white"] {
        assert!(colours(text).is_empty(), "{text}");
    }
}
