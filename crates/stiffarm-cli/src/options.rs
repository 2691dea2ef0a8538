//! How does the command line read the library's table of options? Each row as an argument, and what was typed as names and texts.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use stiffarm::request::{Absent, Pair, SETTINGS, Setting, Spelling, Verb};

/// The id of the argument that takes a job file, or what the verb is about.
const POSITIONAL: &str = "positional";
/// The id of `--save-job`.
pub(crate) const SAVE_JOB: &str = "save-job";
/// The id of `--check`.
pub(crate) const CHECK: &str = "check";
/// The verbs whose answers hold or do not.
pub(crate) const CHECKED: [Verb; 2] = [Verb::Rank, Verb::Place];

/// The subcommand of a verb with its options; `with_hidden` those of other verbs, too, which help does not tell: the library refuses
/// them, in the words that every reader has.
pub(crate) fn subcommand(verb: Verb, about: &'static str, with_hidden: bool) -> Command {
    let name = verb.name().rsplit(' ').next().unwrap_or_default();
    let mut command = Command::new(name).about(about).override_usage(usage(verb));
    for setting in verb.settings().filter(|setting| !setting.is_positional) {
        command = command.arg(argument(setting));
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
    if !Verb::JOBS.contains(&verb) {
        return command;
    }
    if CHECKED.contains(&verb) {
        let help = "Exit code 3 where the tolerance is not held, or there is no place";
        command = command.arg(Arg::new(CHECK).long(CHECK).action(ArgAction::SetTrue).help(help).display_order(890));
    }
    let save = Arg::new(SAVE_JOB)
        .long(SAVE_JOB)
        .value_name("JOB.toml")
        .help("Write what is asked to a job file, which asks the same when it is given in place of the options");
    command.arg(save).arg(positional(verb))
}

fn positional(verb: Verb) -> Arg {
    let (name, help) = match positional_row(verb) {
        Some(row) => (row.value, format!("{}; or a job file with all that is asked", row.described())),
        None => ("JOB.toml", "A job file with all that is asked".into()),
    };
    Arg::new(POSITIONAL).value_name(name).help(help)
}

/// The row that stands without its name.
fn positional_row(verb: Verb) -> Option<&'static Setting> {
    verb.settings().find(|setting| setting.is_positional)
}

/// What must be typed, and that a job file says the same.
fn usage(verb: Verb) -> String {
    let name = verb.name();
    let is_required = |setting: &&Setting| setting.absent == Absent::Required && !setting.is_positional;
    let required: String =
        verb.settings().filter(is_required).map(|row| format!(" --{} <{}>", row.name, row.value)).collect();
    let about = positional_row(verb).map_or_else(String::new, |row| format!(" <{}>", row.value));
    if Verb::JOBS.contains(&verb) {
        format!("stiffarm {name} [OPTIONS]{required}{about}\n       stiffarm {name} [OPTIONS] JOB.toml")
    } else {
        format!("stiffarm {name} [OPTIONS] [TEXT]...")
    }
}

/// A row as an argument.
fn argument(setting: &'static Setting) -> Arg {
    let mut arg = takes(setting, Arg::new(setting.name).long(setting.name)).help(setting.described());
    if !setting.heading.is_empty() {
        arg = arg.help_heading(setting.heading);
    }
    if !setting.kind.words().is_empty() && !setting.is_list() && setting.heading != "Which robots" {
        arg = arg.value_parser(Words(setting.kind.words()));
    }
    match setting.absent {
        Absent::Default(text) => arg.default_value(text),
        _ => arg,
    }
}

/// What an option takes, and how often: the library counts.
fn takes(setting: &Setting, arg: Arg) -> Arg {
    arg.value_name(setting.value).action(ArgAction::Append).allow_hyphen_values(setting.kind.may_be_negative())
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

/// The robot, the table or the job file, where the verb takes one.
pub(crate) fn positional_of(matches: &ArgMatches) -> Option<&String> {
    matches.get_one::<String>(POSITIONAL)
}

/// What stands without its name, as a pair.
pub(crate) fn positional_pair(verb: Verb, text: &str) -> Option<Pair> {
    positional_row(verb).map(|row| Pair { name: row.name.into(), text: text.into(), at: Spelling::Typed })
}
