//! What went wrong, and what to do about it.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use stiffarm::catalogue::files::{LoadError, Unreadable, shown};
use stiffarm::catalogue::import::ImportError;
use stiffarm::cutting::CuttingError;
use stiffarm::map::MapError;
use stiffarm::model::ModelError;
use stiffarm::place::PlaceError;
use stiffarm::rank::RankError;
use stiffarm::robot::NoArmPlane;
use stiffarm::toolpath::{PathFault, ToolpathError};
use stiffarm::watch::Stopped;
use stiffarm_ask::answer::MillAnswerError;
use stiffarm_ask::request::{Refusal, SetupError};

/// Every way in which a command ends without an answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
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
    /// A file or folder is not read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// A text that did not come with the question.
    #[error("no text of the name '{0}' came along")]
    NotSent(String),
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
        expected: Vec<String>,
    },
    /// A file would be written over what is read.
    #[error("cannot write {}: the command reads this file", shown(.0))]
    OntoInput(PathBuf),
    /// A file would be read as a robot the next time.
    #[error("cannot write {}: every .toml file of this folder is read as a robot", shown(.0))]
    AmongRobots(PathBuf),
    /// One file is to hold two things.
    #[error("cannot write {} twice: another output is the same file", shown(.0))]
    Twice(PathBuf),
    /// No robot of this name.
    #[error("robot '{name}' is not known")]
    UnknownRobot {
        /// What was asked for.
        name: String,
        /// Names that are close.
        suggestions: Vec<String>,
    },
    /// A pattern that is none.
    #[error("'{pattern}' is not a pattern: {error}")]
    Pattern {
        /// As it was typed.
        pattern: String,
        /// Why.
        error: &'static str,
    },
    /// A pattern without a robot.
    #[error("'{0}' matches no robot")]
    NoRobot(String),
    /// No robot has all that is asked for.
    #[error("none of {of} robots matches {asked}")]
    NothingLeft {
        /// The filters as they were written.
        asked: String,
        /// How many robots there were to choose from.
        of: usize,
        /// What would match.
        hint: String,
    },
    /// A robot file with faults.
    #[error("{0}")]
    RobotFile(#[from] stiffarm::catalogue::Faults),
    /// A description of a robot that makes no robot file.
    #[error("{error}")]
    Import {
        /// Why.
        error: ImportError,
        /// Whether the user has said at which links the arm begins and ends.
        ends_are_given: bool,
    },
    /// A table of readings with faults.
    #[error("{0}")]
    Readings(stiffarm::catalogue::Faults),
    /// Readings that tell nothing.
    #[error("{data}: {error}")]
    Verify {
        /// Which table.
        data: String,
        /// Why.
        error: stiffarm::verify::VerifyError,
    },
    /// Measured points that tell nothing.
    #[error("{data}: {error}")]
    Calibrate {
        /// Which table.
        data: String,
        /// Why.
        error: stiffarm::calibrate::CalibrateError,
    },
    /// The answer is told: the file is not verified.
    #[error("{0} is not verified")]
    NotVerified(String),
    /// Nobody waits any longer.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// A toolpath that is not read.
    #[error(transparent)]
    Path(#[from] PathFault),
    /// A path that has no answer.
    #[error(transparent)]
    Mill(MillAnswerError),
    /// A process file with faults.
    #[error("{0}")]
    ProcessFile(stiffarm::catalogue::Faults),
    /// A process of which no force is told.
    #[error("{file}: {error}")]
    Process {
        /// Which.
        file: String,
        /// Why.
        error: CuttingError,
    },
    /// Wrong usage that clap cannot see.
    #[error("{0}")]
    Usage(String),
    /// What is asked makes no sense.
    #[error(transparent)]
    Request(#[from] Refusal),
    /// A robot that cannot be judged.
    #[error(transparent)]
    Rank(#[from] RankError),
    /// A zone that cannot be placed.
    #[error("{robot}: {error}")]
    Place {
        /// Which robot.
        robot: String,
        /// Why.
        error: PlaceError,
    },
    /// A map that cannot be made.
    #[error("{robot}: {error}")]
    Map {
        /// Which robot.
        robot: String,
        /// Why.
        error: MapError,
    },
    /// A posture that cannot be judged.
    #[error("{robot}: {error}")]
    Posture {
        /// Which robot.
        robot: String,
        /// Why.
        error: stiffarm::compliance::PostureError,
    },
    /// How an arm swings cannot be told.
    #[error(transparent)]
    Modes(stiffarm::modes::ModesError),
    /// Whether a cut swings cannot be told.
    #[error("{file}: {error}")]
    Chatter {
        /// The process file.
        file: String,
        /// Why.
        error: stiffarm::chatter::ChatterError,
    },
    /// Measurements that tell nothing.
    #[error("{data}: {error}")]
    Identify {
        /// Which table.
        data: String,
        /// Why.
        error: stiffarm::identify::IdentifyError,
    },
    /// Nothing to be measured.
    #[error("{robot}: {error}")]
    Measure {
        /// Which robot.
        robot: String,
        /// Why.
        error: stiffarm::measure::MeasureError,
    },
    /// A table of measurements with faults.
    #[error("{0}")]
    Measurements(stiffarm::catalogue::Faults),
    /// A study that makes no sense.
    #[error(transparent)]
    Study(#[from] stiffarm::study::StudyError),
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
    /// With `--check`: the answer is told, and is no.
    #[error("{0}")]
    NotHeld(String),
    /// A figure that cannot be drawn.
    #[error("cannot draw the figure: {0}")]
    Figure(String),
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Unreadable(error) => error.into(),
            LoadError::RobotFile(error) => error.into(),
            LoadError::Import(error) => Self::Import { error, ends_are_given: false },
        }
    }
}

impl From<ToolpathError> for Failure {
    fn from(error: ToolpathError) -> Self {
        match error {
            ToolpathError::File(error) => error.into(),
            ToolpathError::Path(error) => error.into(),
        }
    }
}

impl From<MillAnswerError> for Failure {
    fn from(error: MillAnswerError) -> Self {
        match error {
            MillAnswerError::Request(refusal) => refusal.into(),
            error => Self::Mill(error),
        }
    }
}

impl From<SetupError> for Failure {
    fn from(error: SetupError) -> Self {
        match error {
            SetupError::Unreadable(error) => error.into(),
            SetupError::Refusal(refusal) => refusal.into(),
        }
    }
}

impl Failure {
    /// 2 for wrong usage, 3 for an answer that --check does not accept, 1 for everything else.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_)
            | Self::Request(_)
            | Self::Pattern { .. }
            | Self::Dash
            | Self::Ending { .. }
            | Self::OntoInput(_)
            | Self::AmongRobots(_)
            | Self::Twice(_) => 2,
            Self::NotHeld(_) => 3,
            _ => 1,
        }
    }

    /// What the user can do.
    pub(crate) fn hint(&self) -> String {
        match self {
            Self::UnknownRobot { suggestions, .. } if !suggestions.is_empty() => {
                return format!("did you mean {}?", suggestions.join(", "));
            }
            Self::Write { path, error } => return write_hint(path, error),
            Self::NothingLeft { hint, .. } | Self::BadFiles { hint, .. } => return hint.clone(),
            Self::Place { error: PlaceError::Model(ModelError::NoArmPlane(error)), .. }
            | Self::Map { error: MapError::Model(ModelError::NoArmPlane(error)), .. }
            | Self::Rank(RankError { error: PlaceError::Model(ModelError::NoArmPlane(error)), .. })
                if *error != NoArmPlane::Limits =>
            {
                "--model spatial asks the model with all six drives"
            }
            Self::Place { robot, .. } => {
                return format!("`stiffarm robots show \"{robot}\"` tells lengths and limits; --within, --angle and --gap bound the search");
            }
            Self::Posture { robot, .. } => {
                return format!("`stiffarm robots show \"{robot}\"` tells what is known of its joints and drives");
            }
            Self::Chatter { error, .. } if !matches!(error, stiffarm::chatter::ChatterError::Modes(_)) => {
                "docs/examples/endmill.toml is a process that is covered: a flat end mill with material, engagement and spindle"
            }
            Self::Modes(_) | Self::Chatter { .. } => "`stiffarm robots show ROBOT --format json` tells what is known of a robot's masses and drives",
            Self::UnknownRobot { .. } | Self::NoRobot(_) => {
                "`stiffarm robots list` names the robots; a path to a robot file or a folder of them works too"
            }
            Self::Pattern { .. } => {
                "* stands for any letters, ? for one, [abc] for one of these; a * or [ itself is written [*] and [[]"
            }
            Self::ClosedPipe | Self::Stopped(_) => "nothing is left to do",
            Self::NotHeld(_) => "the answer stands above; without --check it is no failure",
            Self::Stdout(_) => "-o FILE writes the answer to a file instead",
            Self::Listen { .. } => "--port 0 takes a free port; --host takes an address of this machine, usually 127.0.0.1",
            Self::NotSent(_) => "\"files\" holds the texts that are named, each under its name; no file of the server is read",
            Self::Dash => {
                "without -o the answer goes to standard output; --format json, csv or md chooses its form there"
            }
            Self::Ending { .. } => "the ending of the name chooses what is written",
            Self::OntoInput(_) => "choose another name: what is read is not written over",
            Self::AmongRobots(_) => "write it into another folder",
            Self::Twice(_) => "give each output a name of its own",
            Self::Unreadable(unreadable) => unreadable.advice(),
            Self::RobotFile(_) => "`stiffarm robots show BT200L -o example.toml` writes a complete robot file to compare with",
            Self::Import { error, ends_are_given } => import_hint(error, *ends_are_given),
            Self::Path(_) => "`stiffarm mill --help` lists what can be said of a path whose file is silent; a CAM program can write what is refused as plain moves",
            Self::Mill(_) => "`stiffarm mill --help` tells what a path, a process and a stock may be",
            Self::ProcessFile(_) | Self::Process { .. } => "docs/examples/endmill.toml is a complete process file to compare with",
            Self::Usage(_) | Self::Request(_) => "--help behind the command tells its options",
            Self::Readings(_) => "every fault is named with its row and column; --columns NAME=HEADING says what a table calls its columns",
            Self::Verify { .. } => "read three to ten postures that move every joint; docs/verify.md tells how",
            Self::Calibrate { .. } => "forty postures that move every joint through its range, three points each, tell most; docs/verify.md tells what to look at",
            Self::NotVerified(_) => "the answer above says what fits and what is missing; programs of a robot that is not verified say so",
            Self::Measurements(_) => "every fault is named with its row and column; `stiffarm identify --help` lists the columns",
            Self::Measure { .. } => "--help behind the command tells its options: --loads, --window, --load-mm, --marker-mm",
            Self::Identify { .. } => "`stiffarm measure ROBOT` tells which postures and loads to measure",
            Self::Map { error: MapError::Size { .. }, .. } => "try --size 1000",
            Self::Map { .. } | Self::Figure(_) => "--format csv or json gives the numbers; `stiffarm robots show` what is reached",
            Self::Rank(_) | Self::Study(_) => "--help behind the command tells what each option takes",
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
fn either(words: &[String]) -> String {
    match words {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        words => words.concat(),
    }
}

/// What makes a description usable; nothing that was done already.
fn import_hint(error: &ImportError, ends_are_given: bool) -> &'static str {
    match error {
        ImportError::Xacro { .. } => {
            "expand it first: xacro FILE > robot.urdf (the ROS package xacro, or `pip install xacro`); a file of macros alone \
             needs a file that calls them"
        }
        ImportError::NoLimits { .. } => {
            "give them: stiffarm robots import FILE --limits-deg=-185..185,-140..-5,-120..155,-350..350,-125..125,-350..350"
        }
        ImportError::NoLinks { .. } => "--base and --tip say where in a URDF the arm begins and ends",
        ImportError::Which(_) if !ends_are_given => {
            "stiffarm robots import FILE --base LINK --tip LINK says where the arm begins and ends"
        }
        ImportError::Class(_) if !ends_are_given => {
            "stiffarm knows arms with six turning axes: 1 upright, 2 and 3 parallel, 4, 5 and 6 through one point; --base LINK \
             and --tip LINK choose another part of the file"
        }
        ImportError::Which(_) | ImportError::Class(_) => {
            "stiffarm knows arms with six turning axes: 1 upright, 2 and 3 parallel, 4, 5 and 6 through one point; between these \
             links there is another"
        }
        ImportError::Faults(_) => {
            "mend the lines that are named; docs/guide/own_robot.md and docs/robot_file.md show what is read"
        }
        ImportError::Inexact { .. } => {
            "the description bends or shifts an axis by more than is allowed: correct its origins"
        }
    }
}
