//! What went wrong, and what to do about it.

use std::io;
use std::path::PathBuf;

use stiffarm::catalogue::import::ImportError;
use stiffarm::map::MapError;
use stiffarm::place::{PlaceError, SpatialPlaceError};
use stiffarm::rank::RankError;
use stiffarm::robot::NoArmPlane;

/// Every way in which a command ends without an answer.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The reader of stdout has gone.
    #[error("the reader has gone")]
    ClosedPipe,
    /// Stdout cannot be written.
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
    /// A file cannot be written; nothing is left of it.
    #[error("cannot write {}: {error}", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {error}", path.display())]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// A single minus is no file.
    #[error("-o - is no file; expected a file's name")]
    Dash,
    /// An output of this kind does not exist for this command.
    #[error("{command} cannot write {}: expected a name that ends in {expected}", path.display())]
    Ending {
        /// Which command.
        command: &'static str,
        /// The file asked for.
        path: PathBuf,
        /// The endings there are.
        expected: String,
    },
    /// No robot of this name.
    #[error("robot '{name}' is not known")]
    UnknownRobot {
        /// What was asked for.
        name: String,
        /// Names that are close.
        suggestions: Vec<String>,
    },
    /// A folder or pattern without a robot.
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
    #[error("{0}")]
    Import(#[from] ImportError),
    /// Wrong usage that clap cannot see.
    #[error("{0}")]
    Usage(String),
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
    /// A zone that cannot be placed in space.
    #[error("{robot}: {error}")]
    PlaceInSpace {
        /// Which robot.
        robot: String,
        /// Why.
        error: SpatialPlaceError,
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
    #[error("{0} of the files cannot be used")]
    BadFiles(usize),
    /// A figure that cannot be drawn.
    #[error("cannot draw the figure: {0}")]
    Figure(String),
}

impl Failure {
    /// 2 for wrong usage, 1 for everything else.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) | Self::Dash | Self::Ending { .. } => 2,
            _ => 1,
        }
    }

    /// What the user can do, where that is known.
    pub(crate) fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownRobot { suggestions, .. } if !suggestions.is_empty() => {
                Some(format!("did you mean {}?", suggestions.join(", ")))
            }
            Self::UnknownRobot { .. } | Self::NoRobot(_) => Some(
                "`stiffarm robots list` names the robots; a path to a robot file or a folder of them works too".into(),
            ),
            Self::Dash => Some(
                "without -o the answer goes to standard output; --format json, csv or md chooses its form there".into(),
            ),
            Self::Write { path, error } if error.kind() == io::ErrorKind::NotFound => {
                path.parent().map(|folder| format!("there is no folder {}; make it first", folder.display()))
            }
            Self::NothingLeft { hint, .. } => Some(hint.clone()),
            Self::RobotFile(_) | Self::BadFiles(_) => Some("the README shows a complete robot file".into()),
            Self::Import(error) => import_hint(error),
            Self::Map { error: MapError::Size { .. }, .. } => Some("try --size 1000".into()),
            Self::Place { error: PlaceError::NoArmPlane(error), .. }
            | Self::Map { error: MapError::Arm(PlaceError::NoArmPlane(error)), .. }
            | Self::Rank(RankError { error: SpatialPlaceError::Place(PlaceError::NoArmPlane(error)), .. })
                if *error != NoArmPlane::Limits =>
            {
                Some("--model spatial asks the model with all six drives".into())
            }
            _ => None,
        }
    }
}

/// What makes a description usable, where that is known.
fn import_hint(error: &ImportError) -> Option<String> {
    let hint = match error {
        ImportError::Xacro { .. } => {
            "expand it first: xacro FILE > robot.urdf (the ROS package xacro, or `pip install xacro`); a file of macros alone \
             needs a file that calls them"
        }
        ImportError::NoLimits { .. } => {
            "give them: stiffarm robots import FILE --limits-deg=-185..185,-140..-5,-120..155,-350..350,-125..125,-350..350"
        }
        ImportError::Which(_) => {
            "stiffarm robots import FILE --base LINK --tip LINK says where the arm begins and ends"
        }
        ImportError::Class(_) => {
            "stiffarm knows arms with six turning axes: 1 upright, 2 and 3 parallel, 4, 5 and 6 through one point; --base LINK \
             and --tip LINK choose another part of the file"
        }
        ImportError::Faults(_) | ImportError::Inexact { .. } => return None,
    };
    Some(hint.into())
}
