//! Which files hold robots, and what stands in them?
//!
//! Every file from outside is read here, whoever asks: regular files only, so that no pipe is waited for and no device
//! read without end, and of those no more than [`MOST_BYTES`].

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

pub use super::import::MOST_BYTES;
use super::import::{ImportError, ImportOptions, import};
use super::{Faults, read};
use crate::plain::on_one_line;
use crate::robot::Robot;

/// A file or folder that is not read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read {}: {why}", shown(path))]
pub struct Unreadable {
    /// Which.
    pub path: PathBuf,
    /// Why.
    pub why: Why,
}

/// Why a file or folder is not read.
#[derive(Debug, thiserror::Error)]
pub enum Why {
    /// The system refuses.
    #[error("{0}")]
    System(io::Error),
    /// Links that lead to themselves.
    #[error("its links lead in a circle")]
    Circle,
    /// A folder where a file was expected.
    #[error("it is a folder; expected a file")]
    Folder,
    /// A pipe, a device or a socket: it may have no end, and may never begin.
    #[error("it is a pipe, a device or a socket; expected a regular file")]
    Irregular,
    /// More than [`MOST_BYTES`].
    #[error("it is larger than {} MiB; expected a smaller file", MOST_BYTES >> 20)]
    Large,
    /// Two bytes a letter.
    #[error("it is written in UTF-16; expected UTF-8")]
    Utf16,
    /// No text.
    #[error("line {line} is no UTF-8 text; expected text in UTF-8")]
    NoText {
        /// The first line that is not, from 1.
        line: usize,
    },
    /// A folder without a robot file.
    #[error("no file in this folder ends in .toml")]
    Empty,
}

/// Where a file lies that another one names: counted from the folder of that one.
pub fn beside(file: &Path, other: &str) -> PathBuf {
    file.parent().map_or_else(|| other.into(), |folder| folder.join(other))
}

impl Unreadable {
    /// What to do about it.
    pub fn advice(&self) -> &'static str {
        match &self.why {
            Why::System(error) => match error.kind() {
                ErrorKind::NotFound => {
                    "is the path right? it counts from the folder in which the command is given, in a job file from that of the job"
                }
                ErrorKind::PermissionDenied => "ask its owner for the right to read it and every folder above it",
                ErrorKind::NotADirectory => "a part of the path before the last is a file, not a folder",
                ErrorKind::InvalidFilename => "the path is longer than the system takes; was a text given for a file?",
                _ => "can other programs read it? a copy on a local disk may help",
            },
            Why::Circle => "name the file itself; `ls -l` shows where each link leads",
            Why::Folder => "name a file in it",
            Why::Irregular => "save what it gives to a file, and name that",
            Why::Large => {
                "is it the right file? a robot file has some kilobytes, a table of ten thousand rows less than a megabyte"
            }
            Why::Utf16 => "save it as UTF-8: in most editors under `save as`, encoding",
            Why::NoText { .. } => "is it the right file? if it is, save it as UTF-8",
            Why::Empty => "name a folder of robot files, or a robot file",
        }
    }
}

/// A robot that is not read from its file.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// A robot file with faults.
    #[error(transparent)]
    RobotFile(#[from] Faults),
    /// A description of a robot that makes no robot file.
    #[error(transparent)]
    Import(#[from] ImportError),
}

/// A robot from a file, and what was chosen in reading it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The robot.
    pub robot: Robot,
    /// Of a robot file by what its calibration is used; of a URDF what [`import`] chose, left out or found odd.
    pub notes: Vec<String>,
}

/// Said of every robot that was calibrated.
pub const CALIBRATION_USE: &str = "its [calibration] is used by compliance, mill with its programs, measure and identify: all else is computed with the arm as drawn";

/// Reads a robot file, or a URDF as it stands.
///
/// # Errors
/// Where the file cannot be read, or holds no robot: all faults at once.
pub fn load(path: &Path) -> Result<Loaded, LoadError> {
    load_text(&text(path)?, path)
}

/// The same of a text, which is read as the ending of its name says; the name leads to no disk.
///
/// # Errors
/// Where it holds no robot: all faults at once.
pub fn load_text(text: &str, name: &Path) -> Result<Loaded, LoadError> {
    let shown = shown(name);
    if is_description(name) {
        let imported = import(text, &shown, &ImportOptions::default())?;
        return Ok(Loaded { robot: imported.robot, notes: imported.notes });
    }
    let robot = read(text, &shown)?;
    let notes = robot.calibration.iter().map(|_| CALIBRATION_USE.to_owned()).collect();
    Ok(Loaded { robot, notes })
}

/// A regular file, to be read bit by bit: a toolpath may be larger than what [`text`] takes.
///
/// # Errors
/// Where it is no regular file, or the system refuses.
pub fn open(path: &Path) -> Result<File, Unreadable> {
    let because = |why| Unreadable { path: path.into(), why };
    // Asked before it is opened: a pipe is not open before somebody writes into it.
    let kind = fs::metadata(path).map_err(|error| because(refused(path, error)))?.file_type();
    if kind.is_dir() {
        return Err(because(Why::Folder));
    }
    if !kind.is_file() {
        return Err(because(Why::Irregular));
    }
    File::open(path).map_err(|error| because(Why::System(error)))
}

/// The bytes of a file: no more than one after `most` of them.
///
/// # Errors
/// Where it is no regular file, or the system refuses.
pub fn bytes(path: &Path, most: usize) -> Result<Vec<u8>, Unreadable> {
    let mut bytes = Vec::new();
    // Not by the length it tells: what the system itself makes up has none.
    let read = open(path)?.take(most as u64 + 1).read_to_end(&mut bytes);
    read.map_err(|error| Unreadable { path: path.into(), why: Why::System(error) })?;
    Ok(bytes)
}

/// The text of a file, without the mark that some editors put before UTF-8.
///
/// # Errors
/// Where it is no regular file, larger than [`MOST_BYTES`], no UTF-8, or the system refuses.
pub fn text(path: &Path) -> Result<String, Unreadable> {
    let because = |why| Unreadable { path: path.into(), why };
    let bytes = bytes(path, MOST_BYTES)?;
    if MOST_BYTES < bytes.len() {
        return Err(because(Why::Large));
    }
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(because(Why::Utf16));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        because(Why::NoText { line: good.split(|byte| *byte == b'\n').count() })
    })?;
    Ok(match text.strip_prefix('\u{feff}') {
        Some(text) => text.into(),
        None => text,
    })
}

/// The robot files in a folder, in the order of their names.
///
/// # Errors
/// Where the folder cannot be read, or holds none.
pub fn robot_files(folder: &Path) -> Result<Vec<PathBuf>, Unreadable> {
    let because = |why| Unreadable { path: folder.into(), why };
    let entries: io::Result<Vec<_>> = fs::read_dir(folder).and_then(Iterator::collect);
    let entries = entries.map_err(|error| because(refused(folder, error)))?;
    let mut files: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).collect();
    files.retain(|file| ends_in(file, "toml"));
    files.sort();
    if files.is_empty() { Err(because(Why::Empty)) } else { Ok(files) }
}

/// Does the ending say that this is a robot file or a description of a robot?
pub fn is_robot_file(path: &Path) -> bool {
    ends_in(path, "toml") || is_description(path)
}

/// A description of a robot that others made.
fn is_description(path: &Path) -> bool {
    ends_in(path, "urdf") || ends_in(path, "xacro")
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// The path as it may stand in a message.
pub fn shown(path: &Path) -> String {
    on_one_line(&path.to_string_lossy()).into_owned()
}

/// What the system has against a path; a link that is there and leads to nothing that is or is not, leads to itself.
fn refused(path: &Path, error: io::Error) -> Why {
    let other = !matches!(error.kind(), ErrorKind::NotFound | ErrorKind::PermissionDenied | ErrorKind::NotADirectory);
    let is_link = || fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink());
    if other && is_link() { Why::Circle } else { Why::System(error) }
}
