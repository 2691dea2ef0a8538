//! How does the command line read the library's table of options? Each row as an argument, and what was typed as names and texts.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use stiffarm_ask::request::{Absent, Kind, Pair, SETTINGS, Setting, Spelling, Verb};

/// The id of the argument that takes a job file, or what the verb has without a name: a robot, a table, a path.
const POSITIONAL: &str = "positional";
/// The id of `--save-job`.
pub(crate) const SAVE_JOB: &str = "save-job";
/// The id of `--check`.
pub(crate) const CHECK: &str = "check";
/// The verbs whose answers hold or do not.
pub(crate) const CHECKED: [Verb; 3] = [Verb::Rank, Verb::Place, Verb::Mill];

/// The subcommand of a verb with its options; `with_hidden` those of other verbs, too, which help does not tell: the library refuses
/// them, in the words that every reader has.
pub(crate) fn subcommand(verb: Verb, with_hidden: bool) -> Command {
    let mut command = Command::new(verb.function()).about(verb.about()).override_usage(usage(verb));
    for setting in verb.settings().filter(|setting| !setting.is_positional) {
        command = command.arg(argument(verb, setting));
    }
    let mut hidden: Vec<&str> = Vec::new();
    // What stands without its name here may be an option of others, and may be typed as such.
    let is_option = |name: &str| verb.setting(name).is_some_and(|setting| !setting.is_positional);
    let is_of_others = |setting: &&Setting| !setting.is_positional && !is_option(setting.name);
    for setting in SETTINGS.iter().filter(|setting| with_hidden && is_of_others(setting)) {
        if !hidden.contains(&setting.name) {
            hidden.push(setting.name);
            command = command.arg(takes(setting, Arg::new(setting.name).long(setting.name)).hide(true));
        }
    }
    if verb == Verb::List {
        return command;
    }
    if CHECKED.contains(&verb) {
        let help = "Exit code 3 where the tolerance is not held, there is no place, the arm collides or carries more than it may, or with --chatter a cut surely swings";
        command = command.arg(Arg::new(CHECK).long(CHECK).action(ArgAction::SetTrue).help(help).display_order(890));
    }
    let save = Arg::new(SAVE_JOB)
        .long(SAVE_JOB)
        .value_name("JOB.toml")
        .help("Write what is asked to a job file, which asks the same when it is given in place of the options");
    command.arg(save).arg(positional(verb))
}

fn positional(verb: Verb) -> Arg {
    let rows: Vec<&Setting> = positional_rows(verb).collect();
    let names: Vec<&str> = rows.iter().map(|row| row.value).collect();
    let (name, help) = match rows.as_slice() {
        [] => ("JOB.toml".into(), "A job file with all that is asked".into()),
        [row] => (names[0].to_owned(), format!("{}; or a job file with all that is asked", row.described())),
        rows => {
            let each: Vec<String> = rows.iter().map(|row| format!("{}: {}", row.value, row.described())).collect();
            (names.join(" "), format!("{}; or one job file with all that is asked", each.join(". ")))
        }
    };
    Arg::new(POSITIONAL).value_name(name).help(help).num_args(0..=rows.len().max(1))
}

/// The rows that stand without their names.
pub(crate) fn positional_rows(verb: Verb) -> impl Iterator<Item = &'static Setting> {
    verb.settings().filter(|setting| setting.is_positional)
}

/// What must be typed, and that a job file says the same.
fn usage(verb: Verb) -> String {
    let name = verb.name();
    let is_required = |setting: &&Setting| setting.absent == Absent::Required && !setting.is_positional;
    let required: String =
        verb.settings().filter(is_required).map(|row| format!(" --{} <{}>", row.name, row.value)).collect();
    let about: String = positional_rows(verb)
        .map(
            |row| {
                if row.absent == Absent::Required { format!(" <{}>", row.value) } else { format!(" [{}]", row.value) }
            },
        )
        .collect();
    if verb == Verb::List {
        format!("stiffarm {name} [OPTIONS] [TEXT]...")
    } else {
        format!("stiffarm {name} [OPTIONS]{required}{about}\n       stiffarm {name} [OPTIONS] JOB.toml")
    }
}

/// A row as an argument.
fn argument(verb: Verb, setting: &'static Setting) -> Arg {
    let needed: Vec<String> = setting.needed_by(verb).map(|other| format!("--{other}")).collect();
    let needs = if needed.is_empty() { String::new() } else { format!(" [needs {}]", needed.join(" or ")) };
    let help = format!("{}{needs}", setting.described());
    let mut arg = takes(setting, Arg::new(setting.name).long(setting.name)).help(help);
    if !setting.heading.is_empty() {
        arg = arg.help_heading(setting.heading);
    }
    if !setting.kind.words().is_empty() && !setting.is_list() && setting.heading != "Which robots" {
        arg = arg.value_parser(Words(setting.kind.words()));
    }
    match setting.absent {
        Absent::Default(text) if setting.kind != Kind::Flag => arg.default_value(text),
        _ => arg,
    }
}

/// What an option takes, and how often: the library counts.
fn takes(setting: &Setting, arg: Arg) -> Arg {
    let arg = arg.value_name(setting.value).action(ArgAction::Append);
    if setting.kind == Kind::Flag {
        return arg.num_args(0).default_missing_value("true");
    }
    arg.allow_hyphen_values(setting.kind.may_be_negative())
}

/// Tells the words there are in help; the library checks them.
#[derive(Clone)]
struct Words(&'static [(&'static str, &'static str)]);

impl TypedValueParser for Words {
    type Value = String;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<String, clap::Error> {
        clap::builder::StringValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let value = |(word, help): &(&'static str, &'static str)| match *help {
            "" => PossibleValue::new(*word),
            help => PossibleValue::new(*word).help(help),
        };
        Some(Box::new(self.0.iter().map(value)))
    }
}

/// What was typed, in the order of the table; defaults are the library's matter.
pub(crate) fn typed(matches: &ArgMatches) -> Vec<Pair> {
    let mut names: Vec<&str> = Vec::new();
    for setting in SETTINGS.iter().filter(|setting| !setting.is_positional) {
        if !names.contains(&setting.name) {
            names.push(setting.name);
        }
    }
    let given = |name: &&str| {
        matches.try_contains_id(name).is_ok() && matches.value_source(name) == Some(ValueSource::CommandLine)
    };
    let pair = |name: &str, text: &String| Pair { name: name.into(), text: text.clone(), at: Spelling::Typed };
    let texts =
        |name: &'_ str| matches.get_many::<String>(name).into_iter().flatten().map(|text| pair(name, text)).collect();
    names.into_iter().filter(given).flat_map(|name| -> Vec<Pair> { texts(name) }).collect()
}

/// What stands without names: the robot, the table, the path, two setups, or a job file.
pub(crate) fn positionals_of(matches: &ArgMatches) -> Vec<&String> {
    matches.get_many::<String>(POSITIONAL).into_iter().flatten().collect()
}

/// The same as pairs, under the names of their rows; where they are too few for all rows, of those that must be given.
pub(crate) fn positional_pairs(verb: Verb, texts: &[&String]) -> Vec<Pair> {
    let pair =
        |(row, text): (&Setting, &&String)| Pair { name: row.name.into(), text: (*text).clone(), at: Spelling::Typed };
    let are_few = texts.len() < positional_rows(verb).count();
    let rows = positional_rows(verb).filter(|row| !are_few || row.absent == Absent::Required);
    rows.zip(texts).map(pair).collect()
}
