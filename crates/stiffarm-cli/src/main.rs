//! The program `stiffarm`: arguments in, answers out. It computes nothing itself.

mod args;
mod client;
mod columns;
mod commands;
mod common;
mod failure;
mod help;
mod look;
mod options;
mod output;
mod pdf;
mod progress;
mod raster;
mod serve;
mod signals;
mod table;

use std::io::ErrorKind;
use std::process::ExitCode;

use rayon::{ThreadPool, ThreadPoolBuilder};

use args::Task;
use common::Common;
use failure::Failure;
use look::say;

/// Of each thread, bytes: as much as the first one has.
pub(crate) const STACK: usize = 8 << 20;

fn main() -> ExitCode {
    let outcome = match args::command().try_get_matches() {
        Ok(matches) => args::read(&matches).and_then(|(task, common)| match task {
            Task::Serve(args) => serve::run(&args, &common),
            task => pool(&common).install(|| answer(&task, &common)),
        }),
        Err(usage) => return printed(&usage),
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

fn answer(task: &Task, common: &Common) -> Result<(), Failure> {
    match task {
        Task::Ask(asked) => commands::asked(asked, common),
        Task::List(words, asked) => commands::robots::listed(words, asked, common),
        Task::Robots(action) => commands::robots::run(action, common),
        Task::Paper(args) => commands::paper::run(args, common),
        Task::Serve(args) => serve::run(args, common),
        Task::Validate => commands::validate::run(common),
        Task::Completions(shell) => output::print_text(&commands::shell::completions(*shell)),
        Task::Man(folder) => commands::shell::man(folder.as_deref(), common),
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
fn printed(usage: &clap::Error) -> ExitCode {
    // Help goes to standard output: it must arrive. Errors go to standard error, where there is nowhere left to tell.
    match usage.print() {
        Err(error) if !usage.use_stderr() && error.kind() != ErrorKind::BrokenPipe => ExitCode::FAILURE,
        _ => ExitCode::from(u8::try_from(usage.exit_code()).unwrap_or(2)),
    }
}
