//! Does every command that the README shows still print what the README says?

use assert_cmd::Command;

const README: &str = include_str!("../../../README.md");

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

#[test]
fn the_readme_shows_what_the_program_prints() {
    let mut shown = 0;
    for block in README.split("```text\n").skip(1) {
        let block = block.split("\n```").next().expect("a closed block");
        let Some((command, expected)) = block.split_once('\n') else { continue };
        let arguments = command.strip_prefix("$ stiffarm ").expect("a command of the program");
        let mut program = Command::cargo_bin("stiffarm").unwrap();
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
        let output = program.current_dir(root).args(words(arguments)).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let printed: Vec<&str> = printed.trim_end().lines().map(str::trim_end).collect();
        let expected: Vec<&str> = expected.trim_end().lines().map(str::trim_end).collect();
        assert_eq!(printed, expected, "`{command}` prints something else than the README shows");
        shown += 1;
    }
    assert!(5 <= shown, "the README lost its tour");
}
