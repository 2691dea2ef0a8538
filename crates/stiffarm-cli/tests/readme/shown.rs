//! Does every command that README and guide show still print what they say?
//!
//! `BLESS=1 cargo test -p stiffarm-cli --test all readme::` writes what the program prints into them; a line `..` cuts it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

use assert_cmd::Command;
use rayon::prelude::*;
use serde_json::json;

use super::cut::{cut_again, is_shown};
use super::{Document, ROOT, documents};
use crate::serve::served::Served;

/// Letters in a line of the terminal that is shown.
const COLUMNS: usize = 104;
const OPEN: &str = "```text\n$ stiffarm ";

/// Words of a command line; double quotes keep blanks.
pub(crate) fn words(line: &str) -> Vec<String> {
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
fn printed(arguments: &str) -> String {
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let program = program.current_dir(ROOT).env("COLUMNS", COLUMNS.to_string()).env_remove("CLICOLOR_FORCE");
    let output = program.args(words(arguments)).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = printed.trim_end().lines().map(str::trim_end).collect();
    lines.join("\n")
}

/// A command of a page and what it shows of its output.
pub(crate) struct Block<'a> {
    pub(crate) arguments: &'a str,
    pub(crate) shown: Vec<&'a str>,
    after: &'a str,
}

/// What stands before the first block, and the blocks.
pub(crate) fn blocks(document: &Document) -> (&str, Vec<Block<'_>>) {
    let mut pieces = document.text.split(OPEN);
    let before = pieces.next().unwrap_or_default();
    let block = |piece| {
        let (block, after): (&str, &str) = str::split_once(piece, "\n```").expect("a closed block");
        let (arguments, shown) = block.split_once('\n').unwrap_or((block, ""));
        Block { arguments, shown: shown.trim_end().lines().map(str::trim_end).collect(), after }
    };
    (before, pieces.map(block).collect())
}

#[test]
fn readme_and_guide_show_what_the_program_prints() {
    let documents = documents();
    let commands: Vec<&str> =
        documents.iter().flat_map(|document| blocks(document).1).map(|block| block.arguments).collect();
    assert!(20 <= commands.len(), "the guide lost its commands");
    let mut distinct: Vec<&str> = commands.clone();
    distinct.sort_unstable();
    distinct.dedup();
    let all: BTreeMap<&str, String> = distinct.par_iter().map(|arguments| (*arguments, printed(arguments))).collect();
    let mut others = Vec::new();
    for document in &documents {
        let (before, blocks) = blocks(document);
        let mut blessed = before.to_owned();
        for Block { arguments, shown, after } in blocks {
            let printed = &all[arguments];
            let lines: Vec<&str> = printed.lines().collect();
            for line in &lines {
                assert!(line.chars().count() <= COLUMNS, "`{arguments}` prints more than {COLUMNS} letters: {line}");
            }
            if !is_shown(&shown, &lines) {
                others.push(format!("{}: `stiffarm {arguments}` prints something else:\n{printed}", document.name));
            }
            let _ = write!(blessed, "{OPEN}{arguments}\n{}\n```{after}", cut_again(&shown, &lines));
        }
        if std::env::var_os("BLESS").is_some() && blessed != document.text {
            fs::write(format!("{ROOT}/{}", document.name), blessed).unwrap();
        }
    }
    if std::env::var_os("BLESS").is_none() {
        assert!(others.is_empty(), "{}", others.join("\n\n"));
    }
}

/// The files that a page shows: blocks of language `toml`.
fn files(document: &Document) -> impl Iterator<Item = &str> {
    document.text.split("```toml\n").skip(1).filter_map(|rest| rest.split("\n```").next())
}

#[test]
fn robots_jobs_and_processes_that_the_guide_shows_are_read() {
    let server = Served::start(&[]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shown.toml");
    let mut counts = [0; 3];
    for document in documents().iter().filter(|page| page.name.starts_with("docs/guide")) {
        for text in files(document) {
            fs::write(&path, text).unwrap();
            let run = |words: &[&str]| {
                Command::cargo_bin("stiffarm").unwrap().args(words).arg(&path).assert().success();
            };
            if text.contains("architecture =") {
                counts[0] += 1;
                run(&["robots", "check"]);
            } else if text.starts_with("verb =") {
                counts[1] += 1;
                let reply = server.ask("/api/job", &json!({ "name": "job.toml", "text": text }));
                assert_eq!(reply.status, 200, "{}: {}\n{text}", document.name, reply.text());
            } else {
                counts[2] += 1;
                run(&["force"]);
            }
        }
    }
    assert!(counts.iter().all(|&count| 1 <= count), "the guide shows a robot, a job and a process: {counts:?}");
}
