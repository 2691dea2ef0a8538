//! Which robots are meant: names, patterns, files, folders, the sets `paper` and `all`.

use std::fs;
use std::path::{Path, PathBuf};

use stiffarm::catalogue::import::{ImportOptions, import};
use stiffarm::catalogue::{self, Entry, paper_robots, read, suggestions};
use stiffarm::robot::Robot;

use crate::failure::Failure;

/// Robot files are small; a larger file is something else.
const MOST_BYTES: u64 = 1 << 20;

/// The one robot that a name or path means.
pub(crate) fn robot(name: &str) -> Result<Robot, Failure> {
    if let Some(entry) = catalogue::find(name) {
        return Ok(entry.robot());
    }
    let path = Path::new(name);
    if path.is_file() {
        return read_file(path);
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
pub(crate) fn robots(wanted: &[String]) -> Result<Vec<Robot>, Failure> {
    let mut found: Vec<Robot> = Vec::new();
    for name in wanted {
        for robot in matching(name.trim())? {
            if !found.contains(&robot) {
                found.push(robot);
            }
        }
    }
    Ok(found)
}

fn matching(name: &str) -> Result<Vec<Robot>, Failure> {
    match name {
        "paper" => return Ok(paper_robots()),
        "all" => return Ok(catalogue::robots()),
        _ => {}
    }
    if Path::new(name).is_dir() {
        return folder(Path::new(name));
    }
    if !name.contains(['*', '?', '[']) {
        return Ok(vec![robot(name)?]);
    }
    let found =
        catalogue::matching(name).map_err(|error| Failure::Usage(format!("'{name}' is not a pattern: {error}")))?;
    let found: Vec<Robot> = found.iter().map(Entry::robot).collect();
    if found.is_empty() { Err(Failure::NoRobot(name.into())) } else { Ok(found) }
}

/// Every robot in a folder, in the order of the files' names.
fn folder(path: &Path) -> Result<Vec<Robot>, Failure> {
    files_in(path)?.iter().map(|path| read_file(path)).collect()
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

/// Reads and checks one robot file; a URDF is imported as it stands.
pub(crate) fn read_file(path: &Path) -> Result<Robot, Failure> {
    let (text, name) = (read_text(path)?, path.display().to_string());
    if is_description(path) {
        return Ok(import(&text, &name, &ImportOptions::default())?.robot);
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
