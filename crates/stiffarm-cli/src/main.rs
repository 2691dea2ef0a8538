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

use std::io::ErrorKind;
use std::process::ExitCode;

use clap::Parser;
use rayon::{ThreadPool, ThreadPoolBuilder};

use args::{Arguments, Command, Common};
use failure::Failure;
use output::say;

/// Of each thread, bytes: as much as the first one has.
const STACK: usize = 8 << 20;

fn main() -> ExitCode {
    let outcome = match Arguments::try_parse() {
        Ok(arguments) => pool(&arguments.common).install(|| answer(&arguments)),
        Err(usage) => return told(&usage),
    };
    match outcome {
        // A reader that has seen enough, as in `| head`, is no failure.
        Ok(()) | Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            say(&format!("error: {failure}"));
            say(&format!("hint: {}", failure.hint()));
            ExitCode::from(failure.exit_code())
        }
    }
}

fn answer(arguments: &Arguments) -> Result<(), Failure> {
    let common = &arguments.common;
    match &arguments.command {
        Command::Rank(args) => commands::rank::run(args, common),
        Command::Place(args) => commands::place::run(args, common),
        Command::Map(args) => commands::map::run(args, common),
        Command::Compliance(args) => commands::compliance::run(args, common),
        Command::Study(args) => commands::study::run(args, common),
        Command::Robots(args) => commands::robots::run(args, common),
        Command::Validate => commands::validate::run(common),
    }
}

/// The threads asked for, or the caller's alone where the system gives no others (a container, `ulimit -v`).
fn pool(common: &Common) -> ThreadPool {
    let callers = || {
        let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        pool.expect("no thread is made, and this one has no pool yet")
    };
    if common.threads == Some(1) {
        return callers();
    }
    let all_cores = 0;
    let threads = common.threads.unwrap_or(all_cores);
    ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build().unwrap_or_else(|error| {
        if !common.quiet {
            say(&format!("note: no further threads can be made ({error}); computing on one thread"));
        }
        callers()
    })
}

/// Prints help, or what is wrong with the arguments.
fn told(usage: &clap::Error) -> ExitCode {
    // Help goes to standard output: it must arrive. Errors go to standard error, where there is nowhere left to tell.
    match usage.print() {
        Err(error) if !usage.use_stderr() && error.kind() != ErrorKind::BrokenPipe => ExitCode::FAILURE,
        _ => ExitCode::from(u8::try_from(usage.exit_code()).unwrap_or(2)),
    }
}
