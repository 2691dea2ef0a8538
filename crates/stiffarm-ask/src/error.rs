//! Why a question has no answer, and what to do about it.

use std::fmt::Display;
use std::path::PathBuf;

use stiffarm::catalogue::files::{LoadError, Unreadable, shown};
use stiffarm::catalogue::import::ImportError;
use stiffarm::catalogue::stl::StlFault;
use stiffarm::chatter::ChatterError;
use stiffarm::map::MapError;
use stiffarm::model::ModelError;
use stiffarm::place::PlaceError;
use stiffarm::rank::RankError;
use stiffarm::robot::NoArmPlane;
use stiffarm::toolpath::{PathFault, ToolpathError};
use stiffarm::watch::Stopped;

use crate::answer::MillAnswerError;
use crate::figures::FigureError;
use crate::request::{Refusal, SetupError};

/// Every way in which a question has no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AskError {
    /// A file or folder is not read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// A text that did not come with the question.
    #[error("no text of the name '{0}' came along")]
    NotSent(String),
    /// A file would be written over what is read.
    #[error("cannot write {}: the command reads this file", shown(.0))]
    OntoInput(PathBuf),
    /// A file would be read as a robot the next time.
    #[error("cannot write {}: every .toml file of this folder is read as a robot", shown(.0))]
    AmongRobots(PathBuf),
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
    /// What a verb is asked has no answer: why, and what to do about it.
    #[error("{why}")]
    Unanswered {
        /// Why.
        why: String,
        /// What the user can do.
        hint: &'static str,
    },
    /// Nobody waits any longer.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// A toolpath that is not read.
    #[error(transparent)]
    Path(#[from] PathFault),
    /// A path that has no answer.
    #[error(transparent)]
    Mill(MillAnswerError),
    /// An STL file that is not read.
    #[error(transparent)]
    Stl(#[from] StlFault),
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
    /// A zone without a place, where more is asked of it than the place.
    #[error("{robot}: no place for {task}: {reason}")]
    NoPlace {
        /// Which robot.
        robot: String,
        /// Which zone.
        task: String,
        /// Why.
        reason: Box<stiffarm::place::Misfit>,
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
    /// How an arm swings cannot be computed.
    #[error(transparent)]
    Modes(stiffarm::modes::ModesError),
    /// Whether a cut swings cannot be computed.
    #[error("{}{error}", of_process(file, error))]
    Chatter {
        /// The process file.
        file: String,
        /// Why.
        error: ChatterError,
    },
    /// A robot file of which no drive was identified.
    #[error("no robot file: no drive of {0} is identified")]
    NotIdentified(String),
    /// The answer is given: the file is not verified.
    #[error("{0} is not verified")]
    NotVerified(String),
    /// A study that makes no sense.
    #[error(transparent)]
    Study(#[from] stiffarm::study::StudyError),
    /// A figure that cannot be drawn.
    #[error("cannot draw the figure: {0}")]
    Figure(String),
}

impl From<LoadError> for AskError {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Unreadable(error) => error.into(),
            LoadError::RobotFile(error) => error.into(),
            LoadError::Import(error) => Self::Import { error, ends_are_given: false },
        }
    }
}

impl From<ToolpathError> for AskError {
    fn from(error: ToolpathError) -> Self {
        match error {
            ToolpathError::File(error) => error.into(),
            ToolpathError::Path(error) => error.into(),
        }
    }
}

impl From<MillAnswerError> for AskError {
    fn from(error: MillAnswerError) -> Self {
        match error {
            MillAnswerError::Request(refusal) => refusal.into(),
            MillAnswerError::Chatter { process, error } => Self::Chatter { file: process, error },
            error => Self::Mill(error),
        }
    }
}

impl From<SetupError> for AskError {
    fn from(error: SetupError) -> Self {
        match error {
            SetupError::Unreadable(error) => error.into(),
            SetupError::Refusal(refusal) => refusal.into(),
        }
    }
}

impl From<FigureError> for AskError {
    fn from(error: FigureError) -> Self {
        Self::Figure(error.to_string())
    }
}

impl AskError {
    /// Of a robot or a file that a verb makes nothing of.
    pub(crate) fn unanswered(of: &str, error: impl Display, hint: &'static str) -> Self {
        Self::Unanswered { why: format!("{of}: {error}"), hint }
    }

    /// The question itself is wrong, whatever there is.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Usage(_) | Self::Request(_) | Self::Pattern { .. } | Self::OntoInput(_) | Self::AmongRobots(_) => {
                true
            }
            // A path built in is part of the question.
            Self::Path(error) | Self::Mill(MillAnswerError::Path(error)) => matches!(error, PathFault::Notation { .. }),
            Self::Place { error, .. } | Self::Rank(RankError { error, .. }) => error.is_of_the_question(),
            _ => false,
        }
    }

    /// What the user can do.
    pub fn hint(&self) -> String {
        match self {
            Self::UnknownRobot { suggestions, .. } if !suggestions.is_empty() => {
                return format!("did you mean {}?", suggestions.join(", "));
            }
            Self::NothingLeft { hint, .. } => return hint.clone(),
            Self::Place { error: PlaceError::Model(ModelError::NoArmPlane(error)), .. }
            | Self::Map { error: MapError::Model(ModelError::NoArmPlane(error)), .. }
            | Self::Rank(RankError { error: PlaceError::Model(ModelError::NoArmPlane(error)), .. })
                if *error != NoArmPlane::Limits =>
            {
                "--model spatial asks the model with all six drives"
            }
            Self::Place { error: PlaceError::PartInCell, .. } | Self::Rank(RankError { error: PlaceError::PartInCell, .. }) => {
                "one face at a time stands in such a cell: --task rect:.. with its --tool-direction"
            }
            Self::Place { robot, .. } => {
                return format!("`stiffarm robots show \"{robot}\"` tells lengths and limits; --within, --angle and --gap bound the search");
            }
            Self::NoPlace { .. } => "--at says where the zone stands; `stiffarm place` finds where it may, and what margins it keeps",
            Self::Posture { robot, .. } => {
                return format!("`stiffarm robots show \"{robot}\"` tells what is known of its joints and drives");
            }
            Self::Chatter { error: ChatterError::NoModes, .. } => {
                "--method mean counts teeth by their mean; a modal fit of the analyser makes a table of modes"
            }
            Self::Chatter { error, .. } if !matches!(error, ChatterError::Modes(_)) => {
                "docs/examples/endmill.toml is a process that is covered: a flat end mill with material, engagement and spindle"
            }
            Self::Modes(_) | Self::Chatter { .. } => "`stiffarm robots show ROBOT --format json` tells what is known of a robot's masses and drives",
            Self::UnknownRobot { .. } | Self::NoRobot(_) => {
                "`stiffarm robots list` names the robots; a path to a robot file or a folder of them works too"
            }
            Self::Pattern { .. } => {
                "* stands for any letters, ? for one, [abc] for one of these; a * or [ itself is written [*] and [[]"
            }
            Self::Unanswered { hint, .. } => hint,
            Self::Stopped(_) => "nothing is left to do",
            Self::NotSent(_) => "\"files\" holds the texts that are named, each under its name; no file of the server is read",
            Self::OntoInput(_) => "choose another name: what is read is not written over",
            Self::AmongRobots(_) => "write it into another folder",
            Self::Unreadable(unreadable) => unreadable.advice(),
            Self::RobotFile(_) => "`stiffarm robots show BT200L -o example.toml` writes a complete robot file to compare with",
            Self::Import { error, ends_are_given } => import_hint(error, *ends_are_given),
            Self::Path(_) => "`stiffarm mill --help` lists what can be said of a path whose file is silent; a CAM program can write what is refused as plain moves",
            Self::Mill(_) => "`stiffarm mill --help` tells what a path, a process and a stock may be",
            Self::Stl(_) => "export the finished part from CAD as STL, in the frame of the path, its unit given by part-unit",
            Self::Usage(_) | Self::Request(_) => "--help behind the command tells its options",
            Self::NotVerified(_) => "the answer above says what fits and what is missing; programs of a robot that is not verified say so",
            Self::NotIdentified(_) => "`stiffarm measure ROBOT` tells which postures and loads to measure",
            Self::Map { error: MapError::Size { .. }, .. } => "try --size 1000",
            Self::Map { .. } | Self::Figure(_) => "--format csv or json gives the numbers; `stiffarm robots show` what is reached",
            Self::Rank(_) | Self::Study(_) => "--help behind the command tells what each option takes",
        }
        .into()
    }
}

/// What makes a description usable; nothing that was done already.
/// The file that is at fault, where that is the process rather than what is known of the robot.
fn of_process(file: &str, error: &ChatterError) -> String {
    if matches!(error, ChatterError::Modes(_)) { String::new() } else { format!("{file}: ") }
}

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
        ImportError::Bodies { .. } => {
            "meshes are STL in metres (or with the scale that the URDF gives); without --meshes the links are estimated"
        }
        ImportError::Faults(_) => {
            "mend the lines that are named; docs/guide/own_robot.md and docs/robot_file.md show what is read"
        }
        ImportError::Inexact { .. } => {
            "the description bends or shifts an axis by more than is allowed: correct its origins"
        }
    }
}
