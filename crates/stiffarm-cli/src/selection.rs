//! Which robots are meant: names, patterns, files, folders, the sets `paper` and `all`.

use std::fs;
use std::path::{Path, PathBuf};

use stiffarm::catalogue::import::{ImportOptions, import};
use stiffarm::catalogue::{self, paper_robots, read, suggestions};
use stiffarm::robot::Robot;

use crate::args::Common;
use crate::failure::Failure;

/// Robot files are small; a larger file is something else.
const MOST_BYTES: u64 = 1 << 20;

/// The one robot that a name or path means.
pub(crate) fn robot(name: &str, common: &Common) -> Result<Robot, Failure> {
    if let Some(entry) = catalogue::find(name) {
        return Ok(entry.robot());
    }
    let path = Path::new(name);
    if path.is_file() {
        return read_file(path, common);
    }
    let looks_like_a_file = ends_in(path, "toml") || is_description(path);
    if looks_like_a_file || path.is_dir() {
        let error = fs::read(path).err().unwrap_or_else(|| std::io::ErrorKind::InvalidInput.into());
        return Err(Failure::Read { path: path.into(), error });
    }
    let suggestions = suggestions(name).into_iter().map(Into::into).collect();
    Err(Failure::UnknownRobot { name: name.into(), suggestions })
}

/// All robots that some of the names, patterns, files and folders mean, each once, in the order given.
pub(crate) fn robots(wanted: &[String], common: &Common) -> Result<Vec<Robot>, Failure> {
    let mut found: Vec<Found> = Vec::new();
    for name in wanted {
        for one in matching(name.trim(), common)? {
            if found.iter().all(|known| known.robot != one.robot) {
                found.push(one);
            }
        }
    }
    Ok(told_apart(found, common))
}

/// A robot, and the file that it was read from.
struct Found {
    robot: Robot,
    file: Option<PathBuf>,
}

impl From<Robot> for Found {
    fn from(robot: Robot) -> Self {
        Self { robot, file: None }
    }
}

/// Puts the file's path behind the name of every robot that another one is named like.
fn told_apart(found: Vec<Found>, common: &Common) -> Vec<Robot> {
    let names: Vec<String> = found.iter().map(|one| one.robot.full_name()).collect();
    let mut robots = Vec::new();
    for (Found { mut robot, file }, name) in found.into_iter().zip(&names) {
        let alike = names.iter().filter(|other| *other == name).count();
        if let Some(file) = file.filter(|_| 1 < alike) {
            if !common.quiet {
                eprintln!("note: {}: one of {alike} different robots named {name}", file.display());
            }
            robot.name = format!("{} ({})", robot.name, file.display());
        }
        robots.push(robot);
    }
    robots
}

fn matching(name: &str, common: &Common) -> Result<Vec<Found>, Failure> {
    let path = Path::new(name);
    let with_file = |path: &Path| Ok(Found { robot: read_file(path, common)?, file: Some(path.into()) });
    match name {
        "" => {
            let expected = "names, patterns (*), files, folders, paper or all, separated by commas";
            return Err(Failure::Usage(format!("--robots holds an empty name; expected {expected}")));
        }
        "paper" => return Ok(paper_robots().into_iter().map(Found::from).collect()),
        "all" => return Ok(catalogue::robots().into_iter().map(Found::from).collect()),
        _ => {}
    }
    if path.is_dir() {
        return files_in(path)?.iter().map(|path| with_file(path)).collect();
    }
    if catalogue::find(name).is_none() && path.is_file() {
        return Ok(vec![with_file(path)?]);
    }
    if !name.contains(['*', '?', '[']) {
        return Ok(vec![robot(name, common)?.into()]);
    }
    let found =
        catalogue::matching(name).map_err(|error| Failure::Usage(format!("'{name}' is not a pattern: {error}")))?;
    let found: Vec<Found> = found.iter().map(|entry| entry.robot().into()).collect();
    if found.is_empty() { Err(Failure::NoRobot(name.into())) } else { Ok(found) }
}

/// The robot files in a folder, in the order of their names.
pub(crate) fn files_in(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failure = |error| Failure::Read { path: path.into(), error };
    let entries: Result<Vec<_>, _> = fs::read_dir(path).map_err(failure)?.collect();
    let mut paths: Vec<_> = entries.map_err(failure)?.into_iter().map(|entry| entry.path()).collect();
    paths.retain(|path| ends_in(path, "toml"));
    paths.sort();
    if paths.is_empty() { Err(Failure::NoRobot(path.display().to_string())) } else { Ok(paths) }
}

/// Reads and checks one robot file; a URDF is imported as it stands, and what was chosen in that is said on stderr.
pub(crate) fn read_file(path: &Path, common: &Common) -> Result<Robot, Failure> {
    let (text, name) = (read_text(path)?, path.display().to_string());
    if is_description(path) {
        let imported = import(&text, &name, &ImportOptions::default())?;
        if !common.quiet {
            for note in &imported.notes {
                eprintln!("note: {name}: {note}");
            }
        }
        return Ok(imported.robot);
    }
    Ok(read(&text, &name)?)
}

/// The text of a file that is no larger than what describes a robot.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    let failure = |error| Failure::Read { path: path.into(), error };
    if MOST_BYTES < fs::metadata(path).map_err(failure)?.len() {
        return Err(failure(std::io::Error::other("larger than 1 MiB; expected a robot file")));
    }
    fs::read_to_string(path).map_err(failure)
}

/// A description of a robot that others made.
fn is_description(path: &Path) -> bool {
    ends_in(path, "urdf") || ends_in(path, "xacro")
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}
