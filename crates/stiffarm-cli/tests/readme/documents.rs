//! Are README and guide of the size that people read, do their links lead somewhere, and is nothing missing in them?

use std::path::Path;

use assert_cmd::Command;
use stiffarm_ask::request::{SETTINGS, Verb};

use super::reference::{FOLDER, page_of};
use super::shown::blocks;
use super::{ROOT, document, documents, pages_in};

/// Lines of README at most.
const README_LINES: usize = 150;
/// Lines of output under a command of README at most.
const README_OUTPUT: usize = 12;
/// Lines of a chapter at most.
const CHAPTER_LINES: usize = 250;

#[test]
fn readme_and_chapters_are_short() {
    let readme = document("README.md");
    assert!(readme.text.lines().count() <= README_LINES, "README.md has {} lines", readme.text.lines().count());
    for block in blocks(&readme).1 {
        let lines = block.shown.len();
        assert!(lines <= README_OUTPUT, "README.md shows {lines} lines of `stiffarm {}`", block.arguments);
    }
    for chapter in pages_in("docs/guide").iter().map(|name| document(name)) {
        let lines = chapter.text.lines().count();
        assert!(lines <= CHAPTER_LINES, "{} has {lines} lines", chapter.name);
    }
}

/// Where the links and pictures of a text lead, outside blocks of code.
fn links(text: &str) -> Vec<&str> {
    let prose = text.split("```").step_by(2);
    let links = prose.flat_map(|part| part.split("](").skip(1)).filter_map(|rest| rest.split(')').next());
    links.filter(|link| !link.starts_with("http")).collect()
}

/// The anchor of a heading, as GitHub and mdBook make it.
fn anchor(heading: &str) -> String {
    let letters = heading.chars().filter(|letter| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_'));
    letters.map(|letter| if letter == ' ' { '-' } else { letter.to_ascii_lowercase() }).collect()
}

#[test]
fn every_link_between_files_leads_somewhere() {
    let mut all = documents();
    let others = ["ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "crates/stiffarm-py/README.md"];
    all.extend(others.map(document));
    for page in &all {
        for link in links(&page.text) {
            let (file, part) = link.split_once('#').unwrap_or((link, ""));
            let here = Path::new(&page.name).parent().unwrap_or(Path::new(""));
            let target = if file.is_empty() { Path::new(&page.name).to_owned() } else { here.join(file) };
            let path = Path::new(ROOT).join(&target);
            assert!(path.exists(), "{}: {link} leads nowhere", page.name);
            if !part.is_empty() {
                let text = std::fs::read_to_string(&path).unwrap();
                let headings = text.lines().filter_map(|line| line.strip_prefix('#'));
                let is_there =
                    headings.map(|line| anchor(line.trim_start_matches('#').trim())).any(|name| name == part);
                assert!(is_there, "{}: {link}: no such heading", page.name);
            }
        }
    }
}

#[test]
fn the_contents_name_every_chapter() {
    let contents = document("docs/SUMMARY.md").text;
    for name in pages_in("docs/guide") {
        let name = name.trim_start_matches("docs/");
        assert!(contents.contains(&format!("]({name})")), "docs/SUMMARY.md: no {name}");
    }
}

#[test]
fn every_verb_is_named_wherever_verbs_are_listed() {
    let help = Command::cargo_bin("stiffarm").unwrap().arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let library = document("crates/stiffarm/src/lib.rs").text;
    let python = document("crates/stiffarm-py/README.md").text;
    let guide: String = documents()
        .into_iter()
        .filter(|page| !page.name.starts_with(FOLDER) && page.name != "docs/SUMMARY.md")
        .map(|page| page.text)
        .collect();
    for verb in Verb::ALL {
        let word = verb.name().split(' ').next().unwrap_or_default();
        assert!(help.lines().any(|line| line.trim_start().starts_with(&format!("{word} "))), "--help: {word}");
        assert!(library.contains(&format!("//! | {word} |")), "the table of lib.rs: {word}");
        assert!(python.contains(&format!("| `{word}` |")), "the Python package's README: {word}");
        assert!(guide.contains(&format!("$ stiffarm {}", verb.name())), "README or guide: {}", verb.name());
    }
}

#[test]
fn every_option_is_named_in_the_reference_of_its_verbs() {
    for setting in SETTINGS.iter().filter(|setting| !setting.is_positional) {
        for verb in setting.verbs {
            let page = document(&format!("{FOLDER}/{}", page_of(*verb)));
            assert!(page.text.contains(&format!("| `--{}` |", setting.name)), "{}: --{}", page.name, setting.name);
        }
    }
}

/// A line of a page that says how many there are.
fn says(page: &str, what: &str) {
    assert!(page.contains(what), "docs/guide/evidence.md does not say: {what}");
}

#[test]
fn the_evidence_counts_what_is_recorded() {
    let evidence = document("docs/guide/evidence.md").text;
    let rows = |name: &str| {
        let text = document(&format!("validation/{name}")).text;
        text.lines().filter(|line| !line.starts_with('#')).count() - 1
    };
    says(&evidence, &format!("| {} postures of ten robots", rows("spatial_cases.csv")));
    says(&evidence, &format!("| {} postures of calibrated arms", rows("true_chain.csv")));
    says(&evidence, &format!("| {} links of 115 arms", rows("link_boxes.csv")));
    says(&evidence, &format!("| {} numbers |", rows("identification.csv")));
    let programs = document("validation/rs274_cases.txt").text;
    let begin = |words: &[&str]| {
        programs.lines().filter(|line| words.iter().any(|word| line.split(' ').next() == Some(*word))).count()
    };
    let (moves, arcs, refused) = (begin(&["rapid", "feed", "arc"]), begin(&["arc"]), begin(&["refused"]));
    let all = begin(&["=="]);
    says(&evidence, &format!("{all} programs: {moves} moves, {arcs} of them arcs, {refused} refusals"));
    let ledger = Command::cargo_bin("stiffarm").unwrap().arg("validate").output().unwrap();
    let ledger = String::from_utf8(ledger.stdout).unwrap();
    let sum = ledger.lines().find(|line| line.contains("published numbers:")).expect("a sum");
    says(&evidence, sum.split(", 0 unsettled").next().unwrap_or_default());
    let kept = |folder: &str| -> usize {
        let folders = std::fs::read_dir(Path::new(ROOT).join(folder)).unwrap();
        folders.map(|one| std::fs::read_dir(one.unwrap().path()).unwrap().count()).sum()
    };
    says(&evidence, &format!("{} seeds and 25 neighbours", kept("fuzz/seeds")));
}
