//! What was asked on the command line, in a job file, or in both: requests of the library, and what is a matter of the program.
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units and defaults in brackets")]

mod own;

use std::path::{Path, PathBuf};

use clap::{ArgMatches, Args, Command, FromArgMatches, Subcommand};
use clap_complete::Shell;
use stiffarm::catalogue::files;
use stiffarm_ask::request::{Absent, Kind, Pair, Request, Spelling, Verb, job};

use crate::common::Common;
use crate::failure::Failure;
use crate::help::{EXIT_CODES, with_help, without_common};
use crate::options::{CHECK, CHECKED, SAVE_JOB, positional_pairs, positional_rows, positionals_of, subcommand, typed};
pub(crate) use own::{ImportArgs, PaperArgs, RobotsAction, ServeArgs};

/// What the program does.
const ABOUT: &str =
    "Which robot is stiff enough for machining, where must the work stand, and how far is the tool pushed off?";

/// What `paper` does.
const PAPER: &str = "Make every table and figure of the paper under its number, in the folder given with -o";

/// What `serve` does.
const SERVE: &str =
    "Serve a page in the browser, and all verbs over HTTP as JSON; it reads no files but those that are sent to it";

/// The whole command line.
pub(crate) fn command() -> Command {
    command_with(true)
}

/// The same without options that are only there to be refused: for shells and manuals.
pub(crate) fn command_without_hidden() -> Command {
    command_with(false)
}

fn command_with(hidden: bool) -> Command {
    let program = Common::augment_args(Command::new("stiffarm").version(env!("CARGO_PKG_VERSION")).about(ABOUT))
        .after_help(EXIT_CODES)
        .propagate_version(true)
        .subcommand_required(true)
        .arg_required_else_help(true);
    let list = subcommand(Verb::List, hidden).arg(
        clap::Arg::new("text")
            .value_name("TEXT")
            .num_args(0..)
            .help("Words that must stand in the maker's or the robot's name"),
    );
    let (of_robots, verbs): (Vec<_>, Vec<_>) = Verb::jobs()
        .map(|verb| (verb.name(), with_help(subcommand(verb, hidden), verb.name())))
        .partition(|(name, _)| name.starts_with("robots "));
    let robots = Command::new("robots").about("List, show and check robots").subcommand(with_help(list, "robots list"));
    let robots = with_help(RobotsAction::augment_subcommands(robots), "robots");
    let robots = robots.subcommands(of_robots.into_iter().map(|(_, command)| command));
    let robots = ["show", "check", "import"].into_iter().fold(robots, |robots, name| {
        robots.mut_subcommand(name, |command| with_help(command, &format!("robots {name}")))
    });
    let validate = Command::new("validate").about("Print every published number beside the computed one");
    let completions = Command::new("completions").about("Print what lets a shell complete commands and options").arg(
        clap::Arg::new("shell")
            .value_name("SHELL")
            .required(true)
            .value_parser(clap::builder::EnumValueParser::<Shell>::new()),
    );
    let man = Command::new("man").about("Print the program's manual page, or write those of all commands").arg(
        clap::Arg::new("folder")
            .value_name("FOLDER")
            .value_parser(clap::value_parser!(PathBuf))
            .help("Write a page for every command into this folder"),
    );
    let serve = ServeArgs::augment_args(Command::new("serve").about(SERVE));
    program
        .subcommands(verbs.into_iter().map(|(_, command)| command))
        .subcommand(robots)
        .subcommand(with_help(PaperArgs::augment_args(Command::new("paper").about(PAPER)), "paper"))
        .subcommand(shown(with_help(serve, "serve")))
        .subcommand(with_help(validate, "validate"))
        .subcommand(with_help(completions, "completions"))
        .subcommand(without_common(man))
}

/// The server has threads, and may be quiet.
fn shown(command: Command) -> Command {
    let help = "How many questions are computed at once [default: as many as there are cores]";
    command.mut_arg("threads", |arg| arg.hide(false).help(help)).mut_arg("quiet", |arg| arg.hide(false))
}

/// What is to be done.
#[derive(Debug)]
pub(crate) enum Task {
    /// A verb of the library.
    Ask(Request),
    /// Those of the catalogue that have some words in their names and what is asked.
    List(Vec<String>, Request),
    /// Something with files of robots.
    Robots(RobotsAction),
    /// The published numbers.
    Validate,
    /// What a shell knows of the program.
    Completions(Shell),
    /// Manual pages, to a folder where one is named.
    Man(Option<PathBuf>),
    /// The published tables and figures.
    Paper(PaperArgs),
    /// Everything above over HTTP.
    Serve(ServeArgs),
}

/// What is to be done, and how the program behaves meanwhile.
///
/// # Errors
/// Where a job file cannot be read or written, or what is asked makes no sense.
pub(crate) fn read(matches: &ArgMatches) -> Result<(Task, Common), Failure> {
    let (name, inner) = matches.subcommand().unwrap_or(("", matches));
    let common = |inner: &ArgMatches| {
        let asked = Common::from_arg_matches(inner).map_err(|error| Failure::usage(error.to_string()))?;
        Ok::<_, Failure>(Common { sources: asked.disk(), ..asked })
    };
    if let Some(verb) = verb_named(name) {
        return ask(verb, inner, common(inner)?);
    }
    if name == "validate" {
        return Ok((Task::Validate, common(inner)?));
    }
    if name == "completions" {
        let shell = inner.get_one::<Shell>("shell").copied().expect("clap asks for it");
        return Ok((Task::Completions(shell), common(inner)?));
    }
    if name == "man" {
        return Ok((Task::Man(inner.get_one::<PathBuf>("folder").cloned()), common(inner)?));
    }
    if name == "paper" {
        let args = PaperArgs::from_arg_matches(inner).map_err(|error| Failure::usage(error.to_string()))?;
        return Ok((Task::Paper(args), common(inner)?));
    }
    if name == "serve" {
        let args = ServeArgs::from_arg_matches(inner).map_err(|error| Failure::usage(error.to_string()))?;
        return Ok((Task::Serve(args), common(inner)?));
    }
    let below = inner.subcommand().map(|(below, inner)| (format!("{name} {below}"), inner));
    if let Some((verb, inner)) = below.and_then(|(name, inner)| Some((verb_named(&name)?, inner))) {
        return ask(verb, inner, common(inner)?);
    }
    let list = |pairs: &[Pair]| Request::read(Verb::List, pairs, Spelling::Typed);
    match inner.subcommand() {
        None => Ok((Task::List(Vec::new(), list(&[])?), common(inner)?)),
        Some(("list", inner)) => {
            let words = inner.get_many::<String>("text").into_iter().flatten().cloned().collect();
            Ok((Task::List(words, list(&typed(inner))?), common(inner)?))
        }
        Some((_, action)) => {
            let known = RobotsAction::from_arg_matches(inner).map_err(|error| Failure::usage(error.to_string()))?;
            Ok((Task::Robots(known), common(action)?))
        }
    }
}

fn verb_named(name: &str) -> Option<Verb> {
    Verb::jobs().find(|verb| verb.name() == name)
}

/// A verb, from what was typed and the job file that may stand beside it.
fn ask(verb: Verb, matches: &ArgMatches, mut common: Common) -> Result<(Task, Common), Failure> {
    let mut pairs = typed(matches);
    common.check = CHECKED.contains(&verb) && matches.get_flag(CHECK);
    let (mut of, mut reader, mut read) = (verb, Spelling::Typed, None);
    match positionals_of(matches).as_slice() {
        [] => {}
        [one] => {
            if let Some(job) = job_file(verb, one)? {
                of = job.verb;
                reader = Spelling::Key { file: files::shown(Path::new(one)), line: None };
                read = Some(PathBuf::from(one));
                common.take(&job.program, matches)?;
                pairs = job.overruled_by(pairs);
            } else {
                pairs.splice(0..0, positional_pairs(verb, &[one]));
            }
        }
        several => drop(pairs.splice(0..0, positional_pairs(verb, several))),
    }
    if common.check && !CHECKED.contains(&verb) {
        return Err(Failure::usage(format!(
            "check does not go with {}; it goes with rank, place and mill",
            verb.name()
        )));
    }
    let request = Request::of_task(of, &pairs, reader)?;
    if let Some(file) = read.as_ref().filter(|_| of != verb && !request.is_of_path(verb)) {
        return Err(of_another(file, of, verb));
    }
    if common.check && request.verb == Verb::Mill && request.is_dry() {
        let why = "check does not go with dry: of a path that is only read nothing holds or fails";
        return Err(Failure::usage(why));
    }
    if let Some(file) = matches.get_one::<String>(SAVE_JOB) {
        request.check_complete()?;
        common.saved = Some(saved(&request, Path::new(file), &common)?);
    }
    common.sources = common.disk();
    read.map_or(Ok(()), |job| common.sources.check_unwritten(&job))?;
    Ok((Task::Ask(request), common))
}

/// The job in a file, where it is one; nothing where it is a robot's, a process or a path.
fn job_file(verb: Verb, name: &str) -> Result<Option<job::Job>, Failure> {
    let path = Path::new(name);
    // One robot, table, process or path may stand here as well; of two that must be given neither stands alone.
    let takes_another = positional_rows(verb).filter(|row| row.absent == Absent::Required).count() == 1;
    if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        let values: Vec<&str> = positional_rows(verb).map(|row| row.value).collect();
        let others = match verb {
            Verb::Compare => "or two setups".to_owned(),
            _ if values.is_empty() => "robots are named by --robots".into(),
            _ => format!("or {}", values.join(" ")),
        };
        let why = format!("'{name}' is no job file; expected a name that ends in .toml, {others}");
        return if takes_another { Ok(None) } else { Err(Failure::usage(why)) };
    }
    let takes_file = positional_rows(verb).any(|row| row.kind == Kind::File);
    let text = match files::text(path) {
        // A file that the command itself reads, and tells what is wrong with it.
        Err(_) if takes_file => return Ok(None),
        read => read?,
    };
    if takes_another && !job::is_job(&text) {
        return Ok(None);
    }
    let job = job::read(&text, path)?;
    // A ranking or a place on a path is kept as the job for `mill` that it is.
    if job.verb != verb && !(job.verb == Verb::Mill && matches!(verb, Verb::Rank | Verb::Place)) {
        return Err(of_another(path, job.verb, verb));
    }
    Ok(Some(job))
}

fn of_another(file: &Path, found: Verb, asked: Verb) -> Failure {
    Failure::usage(format!("{} is a job for {}; {} was asked", files::shown(file), found.name(), asked.name()))
}

/// The job file that asks the same, to be written with the answer.
fn saved(request: &Request, file: &Path, common: &Common) -> Result<(PathBuf, String), Failure> {
    if !file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        let shown = files::shown(file);
        return Err(Failure::usage(format!("--save-job cannot write {shown}: expected a name that ends in .toml")));
    }
    Ok((file.into(), job::write(request, &common.entries(file), file)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        command().debug_assert();
    }
}
