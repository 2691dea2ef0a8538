//! `stiffarm serve`: the verbs over HTTP, and the page that asks them.
//!
//! One more reader of `request` and `answer`: it computes nothing, keeps nothing between two questions, and answers what the command line
//! writes, to the last byte. What it is asked is bounded in size, time and number; no name that is sent leads to a disk.

mod admission;
mod answer;
mod bounds;
mod form;
mod job;
mod listen;
mod once;
mod openapi;
mod options;
mod page;
mod question;
mod reply;
mod robots;
mod route;
mod stream;
mod view;
mod work;

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::runtime::{Builder, Runtime};

use crate::STACK;
use crate::args::ServeArgs;
use crate::common::Common;
use crate::failure::Failure;
use crate::look::say;
use crate::output::print_text;
use work::Workshop;

/// What all connections share.
#[derive(Debug)]
struct Server {
    /// The name under which it was asked to listen; a request may call it by that.
    host: String,
    workshop: Arc<Workshop>,
    /// Of an answer that comes at once.
    time_limit: Duration,
}

/// Serves until it is asked to end.
pub(crate) fn run(args: &ServeArgs, common: &Common) -> Result<(), Failure> {
    let server = Server {
        host: args.host.clone(),
        workshop: Arc::new(Workshop::new(common.threads)),
        time_limit: Duration::from_secs(args.time_limit_s),
    };
    let failure = |error| Failure::Listen { address: format!("{}:{}", args.host, args.port), error };
    let runtime = runtime().map_err(failure)?;
    let listening = runtime.block_on(async {
        let listener = TcpListener::bind((args.host.as_str(), args.port)).await?;
        io::Result::Ok((listener.local_addr()?, listener))
    });
    let (address, listener) = listening.map_err(failure)?;
    let address = shown(address);
    print_text(format!("{address}\n").as_bytes())?;
    if !common.quiet {
        say("note: it listens until it is stopped with ctrl-C");
    }
    if args.open
        && let Err(error) = open::that_detached(&address)
    {
        say(&format!("warning: no browser can be opened ({error}); open {address} in one"));
    }
    runtime.block_on(listen::listen(listener, Arc::new(server)));
    // What is still computed is for nobody.
    runtime.shutdown_background();
    Ok(())
}

/// The address as it is typed into a browser.
fn shown(address: SocketAddr) -> String {
    match address {
        every if every.ip().is_unspecified() => format!("http://localhost:{}/", every.port()),
        one => format!("http://{one}/"),
    }
}

/// Two threads speak HTTP; what is computed has its own.
fn runtime() -> io::Result<Runtime> {
    Builder::new_multi_thread().worker_threads(2).thread_stack_size(STACK).enable_all().build()
}
