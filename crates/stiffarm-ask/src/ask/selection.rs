//! Which robots are meant: names, patterns, files, folders, the sets `paper` and `all`.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use crate::request::Request;
use stiffarm::catalogue::files::{Loaded, shown};
use stiffarm::catalogue::{self, NothingLeft, paper_robots, suggestions};
use stiffarm::robot::Robot;

use super::context::Context;
use crate::error::AskError;

/// The one robot that a name or path means.
///
/// # Errors
/// Where there is none, or its file has faults.
pub fn robot(name: &str, context: Context) -> Result<Robot, AskError> {
    if let Some(robot) = context.sources.robot_named(name) {
        return Ok(robot.clone());
    }
    if let Some(entry) = catalogue::find(name) {
        return Ok(entry.robot());
    }
    if context.sources.holds(name) || context.sources.is_file_name(name) {
        return read_file(Path::new(name), context);
    }
    let suggestions = suggestions(name).into_iter().map(Into::into).collect();
    Err(AskError::UnknownRobot { name: name.into(), suggestions })
}

/// All robots that some of the names, patterns, files and folders mean, each once, in the order given.
///
/// # Errors
/// Where one of them means nothing, or a file has faults.
pub fn robots(wanted: &[String], context: Context) -> Result<Vec<Robot>, AskError> {
    let (mut found, mut seen): (Vec<Found>, HashSet<&str>) = (Vec::new(), HashSet::new());
    for name in wanted.iter().map(|name| name.trim()).filter(|name| seen.insert(name)) {
        context.listener.go_on()?;
        for one in matching(name, context)? {
            if found.iter().all(|known| known.robot != one.robot) {
                found.push(one);
            }
        }
    }
    Ok(distinguished(found, context))
}

/// Those that have all that is asked for, in their order.
///
/// # Errors
/// Where none has.
pub fn keep(robots: Vec<Robot>, asked: &Request, words: &[String]) -> Result<Vec<Robot>, AskError> {
    let spelt = |key: &str| asked.reader().spelt(key);
    let nothing = |NothingLeft { asked, of, hint }| AskError::NothingLeft { asked, of, hint };
    asked.filter(words.to_vec()).keep(robots, spelt).map_err(nothing)
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
fn distinguished(found: Vec<Found>, context: Context) -> Vec<Robot> {
    let names: Vec<String> = found.iter().map(|one| one.robot.full_name()).collect();
    let mut robots = Vec::new();
    for (Found { mut robot, file }, name) in found.into_iter().zip(&names) {
        let alike = names.iter().filter(|other| *other == name).count();
        if let Some(file) = file.filter(|_| 1 < alike) {
            context.listener.remark(&format!("note: {}: one of {alike} different robots named {name}", shown(&file)));
            robot.name = format!("{} ({})", robot.name, shown(&file));
        }
        robots.push(robot);
    }
    robots
}

fn matching(name: &str, context: Context) -> Result<Vec<Found>, AskError> {
    let with_file = |path: &Path| Ok(Found { robot: read_file(path, context)?, file: Some(path.into()) });
    if let Some(robot) = context.sources.robot_named(name) {
        return Ok(vec![robot.clone().into()]);
    }
    match name {
        "" => {
            let expected = "names, patterns (*), files, folders, paper or all, separated by commas";
            return Err(AskError::Usage(format!("--robots holds an empty name; expected {expected}")));
        }
        "paper" => return Ok(paper_robots().into_iter().map(Found::from).collect()),
        "all" => return Ok(catalogue::robots().into_iter().map(Found::from).collect()),
        _ => {}
    }
    if let Some(files) = context.sources.folder(name) {
        return files?.iter().map(|path| with_file(path)).collect();
    }
    if catalogue::find(name).is_none() && context.sources.holds(name) {
        return Ok(vec![with_file(Path::new(name))?]);
    }
    if !name.contains(['*', '?', '[']) {
        return Ok(vec![robot(name, context)?.into()]);
    }
    let found =
        catalogue::matching(name).map_err(|error| AskError::Pattern { pattern: name.into(), error: error.msg })?;
    let found: Vec<Found> = found.iter().map(|entry| entry.robot().into()).collect();
    if found.is_empty() { Err(AskError::NoRobot(name.into())) } else { Ok(found) }
}

/// Reads and checks one robot file; a URDF is imported as it stands, and what was chosen in that is said, as is what deserves a second look.
///
/// # Errors
/// Where it is not read, or has faults.
pub fn read_file(path: &Path, context: Context) -> Result<Robot, AskError> {
    let Loaded { robot, notes } = context.sources.robot(path)?;
    for note in notes.iter().chain(&catalogue::doubts(&robot)) {
        context.listener.remark(&format!("note: {}: {note}", shown(path)));
    }
    Ok(robot)
}

#[cfg(test)]
mod tests {
    use crate::request::{Pair, Spelling, Verb};

    use super::*;

    fn kept(wishes: &[(&str, &str)], words: &[&str]) -> Result<Vec<String>, AskError> {
        let pair =
            |(name, text): &(&str, &str)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed };
        let pairs: Vec<Pair> = wishes.iter().map(pair).collect();
        let asked = Request::read(Verb::List, &pairs, Spelling::Typed)?;
        let words: Vec<String> = words.iter().map(|&word| word.into()).collect();
        Ok(keep(paper_robots(), &asked, &words)?.into_iter().map(|robot| robot.name).collect())
    }

    #[test]
    fn every_wish_must_be_met_and_the_ends_of_a_range_belong_to_it() {
        let kuka = ("vendor", "kuka,STAUBLI");
        assert_eq!(kept(&[kuka], &[]).unwrap(), ["KR 210 R2700 extra", "TX340 SH"]);
        assert_eq!(kept(&[kuka, ("payload-kg", "210..210")], &[]).unwrap(), ["KR 210 R2700 extra"]);
        assert_eq!(kept(&[kuka, ("reach-m", "3.45..")], &[]).unwrap(), ["TX340 SH"]);
        assert!(kept(&[kuka, ("architecture", "serial"), ("status", "derived")], &[]).is_err());
        assert_eq!(kept(&[], &["fanuc 210"]).unwrap(), ["R-2000iC/210R"]);
        assert_eq!(kept(&[], &["irb-66"]).unwrap(), ["IRB 6650S-200"]);
        assert_eq!(kept(&[], &[]).unwrap().len(), 10);
    }

    #[test]
    fn what_nothing_meets_is_answered_with_what_would_match() {
        let failure = kept(&[("vendor", "KUKA"), ("payload-kg", "211..300")], &[]).unwrap_err();
        assert_eq!(failure.to_string(), "none of 10 robots matches --vendor KUKA --payload-kg 211..300");
        assert_eq!(failure.hint(), "without --payload-kg 211..300 1 would match");
        let hint = kept(&[("vendor", "nobody")], &[]).unwrap_err().hint();
        assert_eq!(
            hint,
            "there are robots of ABB, Fanuc, Kawasaki, KUKA, Staubli, Yaskawa; payload 165 to 210 kg; reach 2.4 to 3.507 m"
        );
    }
}
