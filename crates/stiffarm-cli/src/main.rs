//! The program `stiffarm`: arguments in, answers out. It computes nothing itself.

mod args;
mod columns;
mod commands;
mod failure;
mod figures;
mod filters;
mod output;
mod selection;
mod table;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use failure::Failure;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if let Some(threads) = arguments.common.threads {
        // The pool is built once, before anything uses it; a second build cannot happen.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    }
    let common = &arguments.common;
    let outcome = output::check(&common.output).and_then(|()| match &arguments.command {
        Command::Rank(args) => commands::rank::run(args, common),
        Command::Place(args) => commands::place::run(args, common),
        Command::Map(args) => commands::map::run(args, common),
        Command::Compliance(args) => commands::compliance::run(args, common),
        Command::Study(args) => commands::study::run(args, common),
        Command::Robots(args) => commands::robots::run(args, common),
        Command::Validate => commands::validate::run(common),
    });
    match outcome {
        // A reader that has seen enough, as in `| head`, is no failure.
        Ok(()) | Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            if let Some(hint) = failure.hint() {
                eprintln!("hint: {hint}");
            }
            ExitCode::from(failure.exit_code())
        }
    }
}
