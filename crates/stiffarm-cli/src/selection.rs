//! Which robots are meant: names, patterns, files, folders, the sets `paper` and `all`.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use stiffarm::catalogue::files::{Loaded, shown};
use stiffarm::catalogue::{self, NothingLeft, paper_robots, suggestions};
use stiffarm::robot::Robot;
use stiffarm_ask::request::Request;

use crate::common::Common;
use crate::failure::Failure;

/// The one robot that a name or path means.
pub(crate) fn robot(name: &str, common: &Common) -> Result<Robot, Failure> {
    if let Some(entry) = catalogue::find(name) {
        return Ok(entry.robot());
    }
    if common.shelf.holds(name) || common.shelf.is_file_name(name) {
        return read_file(Path::new(name), common);
    }
    let suggestions = suggestions(name).into_iter().map(Into::into).collect();
    Err(Failure::UnknownRobot { name: name.into(), suggestions })
}

/// All robots that some of the names, patterns, files and folders mean, each once, in the order given.
pub(crate) fn robots(wanted: &[String], common: &Common) -> Result<Vec<Robot>, Failure> {
    let (mut found, mut seen): (Vec<Found>, HashSet<&str>) = (Vec::new(), HashSet::new());
    for name in wanted.iter().map(|name| name.trim()).filter(|name| seen.insert(name)) {
        common.watch().go_on()?;
        for one in matching(name, common)? {
            if found.iter().all(|known| known.robot != one.robot) {
                found.push(one);
            }
        }
    }
    Ok(told_apart(found, common))
}

/// Those that have all that is asked for, in their order.
pub(crate) fn keep(robots: Vec<Robot>, asked: &Request, words: &[String]) -> Result<Vec<Robot>, Failure> {
    let typed = |key: &str| format!("--{}", key.replace('_', "-"));
    let nothing = |NothingLeft { asked, of, hint }| Failure::NothingLeft { asked, of, hint };
    asked.filter(words.to_vec()).keep(robots, typed).map_err(nothing)
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
            common.remark(&format!("note: {}: one of {alike} different robots named {name}", shown(&file)));
            robot.name = format!("{} ({})", robot.name, shown(&file));
        }
        robots.push(robot);
    }
    robots
}

fn matching(name: &str, common: &Common) -> Result<Vec<Found>, Failure> {
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
    if let Some(files) = common.shelf.folder(name) {
        return files?.iter().map(|path| with_file(path)).collect();
    }
    if catalogue::find(name).is_none() && common.shelf.holds(name) {
        return Ok(vec![with_file(Path::new(name))?]);
    }
    if !name.contains(['*', '?', '[']) {
        return Ok(vec![robot(name, common)?.into()]);
    }
    let found =
        catalogue::matching(name).map_err(|error| Failure::Pattern { pattern: name.into(), error: error.msg })?;
    let found: Vec<Found> = found.iter().map(|entry| entry.robot().into()).collect();
    if found.is_empty() { Err(Failure::NoRobot(name.into())) } else { Ok(found) }
}

/// Reads and checks one robot file; a URDF is imported as it stands, and what was chosen in that is said on stderr.
pub(crate) fn read_file(path: &Path, common: &Common) -> Result<Robot, Failure> {
    let Loaded { robot, notes } = common.shelf.robot(path)?;
    for note in &notes {
        common.remark(&format!("note: {}: {note}", shown(path)));
    }
    Ok(robot)
}

#[cfg(test)]
mod tests {
    use stiffarm_ask::request::{Pair, Spelling, Verb};

    use super::*;

    fn kept(wishes: &[(&str, &str)], words: &[&str]) -> Result<Vec<String>, Failure> {
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
