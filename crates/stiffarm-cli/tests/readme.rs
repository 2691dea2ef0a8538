//! Does every command that the README shows still print what the README says?
//!
//! `BLESS=1 cargo test -p stiffarm-cli --test all readme` writes what the program prints into the README.

use std::fmt::Write as _;
use std::fs;

use assert_cmd::Command;
use rayon::prelude::*;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// Letters in a line of the README's terminal.
const COLUMNS: usize = 104;

/// Words of a command line; double quotes keep blanks.
fn words(line: &str) -> Vec<String> {
    let pieces = line.split('"').enumerate();
    pieces
        .flat_map(|(i, piece)| {
            let quoted = i % 2 == 1;
            let words: Vec<String> =
                if quoted { vec![piece.into()] } else { piece.split_whitespace().map(Into::into).collect() };
            words
        })
        .collect()
}

/// What a command prints on a terminal of that width, without blanks at the end of lines.
fn printed(command: &str) -> String {
    let arguments = command.strip_prefix("$ stiffarm ").expect("a command of the program");
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let program = program.current_dir(ROOT).env("COLUMNS", COLUMNS.to_string()).env_remove("CLICOLOR_FORCE");
    let output = program.args(words(arguments)).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = printed.trim_end().lines().map(str::trim_end).collect();
    lines.join("\n")
}

#[test]
fn the_readme_shows_what_the_program_prints() {
    let file = format!("{ROOT}/README.md");
    let readme = fs::read_to_string(&file).unwrap();
    let mut blocks = readme.split("```text\n");
    let mut blessed = blocks.next().expect("a beginning").to_owned();
    let blocks: Vec<(&str, &str, &str)> = blocks
        .map(|block| {
            let (block, after) = block.split_once("\n```").expect("a closed block");
            let (command, expected) = block.split_once('\n').expect("a command and what it prints");
            (command, expected, after)
        })
        .collect();
    assert!(5 <= blocks.len(), "the README lost its tour");
    let all_printed: Vec<String> = blocks.par_iter().map(|(command, ..)| printed(command)).collect();
    let mut others = Vec::new();
    for ((command, expected, after), printed) in blocks.into_iter().zip(all_printed) {
        for line in printed.lines() {
            assert!(
                line.chars().count() <= COLUMNS,
                "`{command}` prints a line of more than {COLUMNS} letters: {line}"
            );
        }
        let expected: Vec<&str> = expected.trim_end().lines().map(str::trim_end).collect();
        if printed != expected.join("\n") {
            others.push(format!("`{command}` prints something else than the README shows:\n{printed}"));
        }
        let _ = write!(blessed, "```text\n{command}\n{printed}\n```{after}");
    }
    if std::env::var_os("BLESS").is_some() {
        fs::write(&file, blessed).unwrap();
    } else {
        assert!(others.is_empty(), "{}", others.join("\n\n"));
    }
}
