//! What went wrong, and what to do about it.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use stiffarm::catalogue::files::{LoadError, Unreadable, shown};
use stiffarm::watch::Stopped;
use stiffarm_ask::ask::AskError;
use stiffarm_ask::figures::FigureError;
use stiffarm_ask::request::Refusal;

use crate::raster::RasterError;

/// Every way in which a command ends without an answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// There is no answer.
    #[error(transparent)]
    Ask(#[from] AskError),
    /// The reader of stdout has gone.
    #[error("the reader has gone")]
    ClosedPipe,
    /// Nothing can be served there.
    #[error("cannot listen at {address}: {error}")]
    Listen {
        /// Where.
        address: String,
        /// Why.
        error: io::Error,
    },
    /// Stdout cannot be written.
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
    /// A file cannot be written; nothing is left of it.
    #[error("cannot write {}: {error}", shown(path))]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// A single minus is no file.
    #[error("-o - is no file; expected a file's name")]
    Dash,
    /// An output of this kind does not exist for this command.
    #[error("{command} cannot write {}: expected a name that ends in {}", shown(path), either(expected))]
    Ending {
        /// Which command.
        command: &'static str,
        /// The file asked for.
        path: PathBuf,
        /// The endings there are, with their dots.
        expected: Vec<&'static str>,
    },
    /// One file is to hold two things.
    #[error("cannot write {} twice: another output is the same file", shown(.0))]
    Twice(PathBuf),
    /// A ledger that cannot be read.
    #[error(transparent)]
    Ledger(#[from] stiffarm::ledger::LedgerError),
    /// A published number disagrees and is not listed, or is listed and agrees.
    #[error("{0} published numbers are neither reproduced nor listed with a reason")]
    Unsettled(usize),
    /// Some robot files have faults.
    #[error("{count} of the files cannot be used")]
    BadFiles {
        /// How many.
        count: usize,
        /// What to do about the first.
        hint: String,
    },
    /// With `--check`: the answer is given, and is no.
    #[error("{0}")]
    NotHeld(String),
}

/// What the questions of the program's own commands end with, too.
macro_rules! of_questions {
    ($($error:ty),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::Ask(error.into())
            }
        })*
    };
}

impl From<RasterError> for Failure {
    fn from(error: RasterError) -> Self {
        Self::Ask(AskError::Figure(error.to_string()))
    }
}

of_questions!(Unreadable, LoadError, Stopped, Refusal, FigureError);

impl Failure {
    /// Wrong usage that clap cannot see.
    pub(crate) fn usage(why: impl Into<String>) -> Self {
        Self::Ask(AskError::Usage(why.into()))
    }

    /// 2 for wrong usage, 3 for an answer that --check does not accept, 1 for everything else.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Dash | Self::Ending { .. } | Self::Twice(_) => 2,
            Self::Ask(error) if error.is_usage() => 2,
            Self::NotHeld(_) => 3,
            _ => 1,
        }
    }

    /// What the user can do.
    pub(crate) fn hint(&self) -> String {
        match self {
            Self::Ask(error) => return error.hint(),
            Self::Write { path, error } => return write_hint(path, error),
            Self::BadFiles { hint, .. } => return hint.clone(),
            Self::ClosedPipe => "nothing is left to do",
            Self::NotHeld(_) => "the answer stands above; without --check it is no failure",
            Self::Stdout(_) => "-o FILE writes the answer to a file instead",
            Self::Listen { .. } => "--port 0 takes a free port; --host takes an address of this machine, usually 127.0.0.1",
            Self::Dash => {
                "without -o the answer goes to standard output; --format json, csv or md chooses its form there"
            }
            Self::Ending { command: "mill", expected, .. } if !expected.contains(&".svg") && expected.contains(&".src") => {
                "of several tools at once there are tables and programs of robots; --only-tool asks for one of them, with figure, report and view"
            }
            Self::Ending { .. } => "the ending of the name chooses what is written",
            Self::Twice(_) => "give each output a name of its own",
            Self::Ledger(_) => "the tables are compiled in: this is a fault of the program, please report it",
            Self::Unsettled(_) => "the rows that say DISAGREES or LISTED; crates/stiffarm/printed/ holds what is printed and why it differs",
        }
        .into()
    }
}

/// What lets a file be written.
fn write_hint(path: &Path, error: &io::Error) -> String {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match error.kind() {
        ErrorKind::NotFound => format!("there is no folder {}; make it first", shown(folder)),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            format!("it, or the folder {}, is closed to you for writing; choose another place", shown(folder))
        }
        ErrorKind::NotADirectory => format!("{} is a file, not a folder; choose another place", shown(folder)),
        ErrorKind::IsADirectory => "there is a folder of this name; choose another name, or a name in it".into(),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "there is no room for it; the answer stands on standard output, so that it is not lost".into()
        }
        ErrorKind::InvalidFilename => "the name is longer than the system takes; choose a shorter one".into(),
        _ if path.is_symlink() => "it is a link: `ls -l` shows where it leads; name the file itself".into(),
        _ => "choose another place; where the answer was computed, it stands on standard output".into(),
    }
}

/// `.json, .csv or .txt`.
fn either(words: &[&str]) -> String {
    match words {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        words => words.concat(),
    }
}
