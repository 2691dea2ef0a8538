//! What does help tell of a command besides its options? Examples, and which files `-o` writes.

use clap::{Args, Command};

use stiffarm_ask::request::{Help, Verb};

use crate::common::Common;

/// What stands at the end of the program's own help.
pub(crate) const EXIT_CODES: &str = "\
Exit codes:
  0  the answer is given
  1  no answer: a file, a robot, a search
  2  wrong usage
  3  with --check (rank, place, mill): the tolerance is not held, there is no place, the arm collides or carries more than it may, or with --chatter a cut surely swings";

const TABLES: &str = "the table as .csv, .parquet, .json, .md or .txt";

/// Of the program's own commands.
const OWN: [(&str, Help); 8] = [
    (
        "robots",
        Help {
            files: TABLES,
            is_long: false,
            examples: &[("stiffarm robots", "all of them; `list` chooses, `show` tells one")],
        },
    ),
    (
        "robots show",
        Help {
            files: "what is known as .csv, .parquet, .json, .md or .txt, the robot file as .toml, what it reaches as .svg, .pdf or .png",
            is_long: false,
            examples: &[
                ("stiffarm robots show BT200L", "lengths, limits, stiffness and sources"),
                ("stiffarm robots show BT200L -o mine.toml", "its robot file, to be changed"),
            ],
        },
    ),
    (
        "robots check",
        Help {
            files: "the faults as .csv, .parquet, .json, .md or .txt",
            is_long: false,
            examples: &[("stiffarm robots check mine.toml robots/", "a file, and all of a folder")],
        },
    ),
    (
        "robots import",
        Help {
            files: "the robot file as .toml, what was understood as .csv, .parquet, .json, .md or .txt",
            is_long: false,
            examples: &[("stiffarm robots import arm.urdf --payload-kg 210 -o arm.toml", "a robot file from a URDF")],
        },
    ),
    (
        "paper",
        Help {
            files: "a folder, which is made, with a file for every table and figure, and an index.md",
            is_long: true,
            examples: &[
                ("stiffarm paper -o paper", "every table and figure of the paper, with the command of each"),
                ("stiffarm paper -o paper --pictures pdf --width-mm 170", "for print, texts 8 pt high"),
            ],
        },
    ),
    (
        "serve",
        Help {
            files: "",
            is_long: true,
            examples: &[
                ("stiffarm serve --open", "the page, on this machine alone, on a free port"),
                (
                    "stiffarm serve --port 8080 --threads 8",
                    "a port that is known, and eight questions at once; GET /openapi.json describes what can be asked",
                ),
            ],
        },
    ),
    (
        "validate",
        Help {
            files: "the ledger as .csv, .parquet, .json, .md or .txt",
            is_long: false,
            examples: &[("stiffarm validate -o ledger.csv", "every published number beside the computed one")],
        },
    ),
    (
        "completions",
        Help {
            files: "",
            is_long: false,
            examples: &[
                ("stiffarm completions bash > ~/.local/share/bash-completion/completions/stiffarm", "bash"),
                ("stiffarm completions zsh > ~/.zfunc/_stiffarm", "zsh, where ~/.zfunc stands in fpath"),
                ("stiffarm completions fish > ~/.config/fish/completions/stiffarm.fish", "fish"),
            ],
        },
    ),
];

/// The command with what help tells besides; `name` is what is typed behind `stiffarm`.
pub(crate) fn with_help(command: Command, name: &str) -> Command {
    let of_verb = Verb::ALL.into_iter().find(|verb| verb.name() == name).map(Verb::help);
    let of_own = OWN.iter().find(|(own, _)| *own == name).map(|(_, help)| *help);
    let Some(about) = of_verb.or(of_own) else { return command };
    let command = command.after_help(examples(&about));
    if about.files.is_empty() {
        return without_common(command);
    }
    let command = Common::augment_args(command);
    let files = format!("Write to a file, as often as wanted; its ending chooses what: {}", about.files);
    command.mut_arg("output", |arg| arg.help(files)).mut_arg("threads", |arg| arg.hide(!about.is_long))
}

/// A command that writes one text and does nothing else.
pub(crate) fn without_common(command: Command) -> Command {
    let hidden = ["format", "output", "threads", "quiet"];
    hidden.into_iter().fold(Common::augment_args(command), |command, name| command.mut_arg(name, |arg| arg.hide(true)))
}

fn examples(about: &Help) -> String {
    let each = about.examples.iter().map(|(line, says)| format!("  {line}\n      {says}"));
    format!("Examples:\n{}", each.collect::<Vec<_>>().join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{command, read};

    /// Words of a command line as a shell would have them: quotes keep blanks, what is redirected is no argument.
    fn words(line: &str) -> Vec<String> {
        let line = line.split(" > ").next().unwrap_or(line);
        let of = |(i, piece): (usize, &str)| -> Vec<String> {
            if i % 2 == 1 { vec![piece.into()] } else { piece.split_whitespace().map(Into::into).collect() }
        };
        line.split('"').enumerate().flat_map(of).collect()
    }

    #[test]
    fn every_example_can_be_typed() {
        let of_verbs = Verb::ALL.map(|verb| (verb.name(), verb.help()));
        for (name, Help { examples, .. }) in of_verbs.iter().chain(&OWN) {
            assert!(!examples.is_empty(), "{name}");
            for (line, _) in *examples {
                let words = words(line);
                assert_eq!(words[..=name.split(' ').count()].join(" "), format!("stiffarm {name}"));
                let matches = command().try_get_matches_from(&words).unwrap_or_else(|why| panic!("{line}: {why}"));
                read(&matches).unwrap_or_else(|why| panic!("{line}: {why}"));
            }
        }
    }

    #[test]
    fn help_shows_what_applies_and_nothing_else() {
        let help = |words: &[&str]| {
            let all = [&["stiffarm"], words, &["--help"]].concat();
            command().try_get_matches_from(all).unwrap_err().to_string()
        };
        assert!(help(&["rank"]).contains("--threads") && help(&["rank"]).contains("--check"));
        assert!(!help(&["compliance"]).contains("--threads") && !help(&["compliance"]).contains("--within"));
        assert!(help(&["compliance"]).contains(".html") && !help(&["compliance"]).contains(".svg"));
        assert!(!help(&["completions"]).contains("--format"));
        assert!(help(&[]).contains("Exit codes:"));
    }
}
