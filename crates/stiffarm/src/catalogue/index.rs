//! Which robots come with the program, and which of them is meant by what people type?
//!
//! Finding a robot must not cost reading all of them: a file that is compiled in opens with its name and its maker, and
//! those two lines are all that is looked at. A test holds every file to that.

use std::cmp::Ordering;

use include_dir::{Dir, File, include_dir};

use super::read;
use crate::robot::Robot;

static ROBOTS: Dir = include_dir!("$CARGO_MANIFEST_DIR/robots");

/// A robot that comes with the program, by name; its file is not read yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The maker's name for it.
    pub name: &'static str,
    /// The maker.
    pub vendor: &'static str,
    path: &'static str,
    text: &'static str,
}

impl Entry {
    /// `None` for what is no robot file.
    fn of(file: &'static File<'static>) -> Option<Self> {
        let path = file.path().to_str().filter(|_| file.path().extension().is_some_and(|ending| ending == "toml"))?;
        let text = file.contents_utf8()?;
        let value = |line: &'static str, key: &str| line.strip_prefix(key)?.trim().strip_prefix('"')?.strip_suffix('"');
        let mut lines = text.lines();
        let name = value(lines.next()?, "name =")?;
        let vendor = value(lines.next()?, "vendor =")?;
        Some(Self { name, vendor, path, text })
    }

    /// The robot in the file `path`, from the folder of all robots.
    pub(super) fn at(path: &str) -> Option<Self> {
        Self::of(ROBOTS.get_file(path)?)
    }

    /// Reads the file.
    ///
    /// # Panics
    /// Never: a test reads every file that is compiled in.
    pub fn robot(&self) -> Robot {
        read(self.text, self.path).expect("a test reads every robot that is compiled in")
    }

    /// Maker and name.
    pub fn full_name(&self) -> String {
        format!("{} {}", self.vendor, self.name)
    }

    fn is_named(&self, typed: &str) -> bool {
        typed == key(self.name) || typed == key(&self.full_name())
    }
}

/// Every robot that comes with the program, by maker and name; numbers in names count as numbers.
pub fn entries() -> Vec<Entry> {
    let mut found: Vec<Entry> = ROBOTS.dirs().flat_map(Dir::files).filter_map(Entry::of).collect();
    found.sort_by(|a, b| a.vendor.to_lowercase().cmp(&b.vendor.to_lowercase()).then_with(|| by_name(a.name, b.name)));
    found
}

/// The robot that comes with the program under this name; case, blanks and punctuation do not matter.
pub fn find(typed: &str) -> Option<Entry> {
    let typed = key(typed);
    ROBOTS.dirs().flat_map(Dir::files).filter_map(Entry::of).find(|entry| entry.is_named(&typed))
}

/// The robots whose names, with or without the maker, fit a pattern with `*`, `?` and `[abc]`; case does not matter.
///
/// # Errors
/// What is wrong with the pattern.
pub fn matching(pattern: &str) -> Result<Vec<Entry>, glob::PatternError> {
    let pattern = glob::Pattern::new(&pattern.to_lowercase())?;
    let fits = |name: &str| pattern.matches(&name.to_lowercase());
    Ok(entries().into_iter().filter(|entry| fits(entry.name) || fits(&entry.full_name())).collect())
}

/// Does `typed` name this robot, with or without its maker?
pub fn names(robot: &Robot, typed: &str) -> bool {
    let typed = key(typed);
    typed == key(&robot.name) || typed == key(&robot.full_name())
}

/// The names closest to what was typed, the most similar first, at most five.
///
/// Names that hold what was typed come before those that are merely spelt alike.
pub fn suggestions(typed: &str) -> Vec<&'static str> {
    let typed = key(typed);
    // Of a text so long no name can be spelt alike.
    let is_too_long_for = |name: &str| 3 * name.len() < typed.len();
    let similar = |name: &str| {
        if is_too_long_for(name) {
            return 0.0;
        }
        let within = if 3 <= typed.len() && name.contains(&typed) { 1.0 } else { 0.0 };
        within + strsim::normalized_damerau_levenshtein(&typed, name)
    };
    let mut scored: Vec<(f64, &str)> = entries()
        .iter()
        .map(|entry| (similar(&key(entry.name)).max(similar(&key(&entry.full_name()))), entry.name))
        .filter(|(score, _)| 0.6 < *score)
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.into_iter().map(|(_, name)| name).take(5).collect()
}

/// What people type of a name: case, blanks and punctuation do not matter.
fn key(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// `KR 6` before `KR 10`.
fn by_name(a: &str, b: &str) -> Ordering {
    pieces(a).cmp(&pieces(b)).then_with(|| a.cmp(b))
}

/// A name in pieces: each number, and the text before it in small letters.
fn pieces(name: &str) -> Vec<(String, u64)> {
    let mut pieces = vec![(String::new(), 0_u64)];
    let mut in_number = false;
    for c in name.chars() {
        let digit = c.to_digit(10);
        if digit.is_none() && in_number {
            pieces.push((String::new(), 0));
        }
        in_number = digit.is_some();
        let (text, number) = pieces.last_mut().expect("never empty");
        match digit {
            Some(digit) => *number = number.saturating_mul(10).saturating_add(digit.into()),
            None => text.extend(c.to_lowercase()),
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::{paper_robots, robots, warnings};
    use super::*;
    use crate::robot::{Arm, Status};

    /// Every file of the catalogue's folders, whatever it is.
    fn files() -> Vec<&'static File<'static>> {
        ROBOTS.dirs().flat_map(Dir::files).collect()
    }

    #[test]
    fn every_file_that_is_compiled_in_is_a_robot_that_opens_with_its_name_and_maker() {
        for file in files() {
            let path = file.path().display();
            let robot =
                read(file.contents_utf8().unwrap(), &path.to_string()).unwrap_or_else(|faults| panic!("{faults}"));
            let entry = Entry::of(file).unwrap_or_else(|| panic!("{path} opens with other lines than name and vendor"));
            assert_eq!((entry.name, entry.vendor), (&*robot.name, &*robot.vendor), "{path}");
            assert_eq!(entry.robot(), robot);
            assert!(!robot.arm_plane().unwrap().arm.sides().unwrap().is_empty(), "{path}");
        }
        assert_eq!(files().len(), entries().len());
        assert!(
            ROBOTS.dirs().all(|folder| folder.dirs().next().is_none()),
            "a folder within a folder is not looked into"
        );
    }

    #[test]
    fn every_group_of_numbers_names_its_source() {
        for robot in robots() {
            let Robot { name, source, .. } = &robot;
            let Arm::SixAxis { limits, .. } = &robot.arm else { panic!("{name} has six axes") };
            let stated = [
                ("geometry", true),
                ("limits", true),
                ("pendant", true),
                ("architecture", robot.architecture_is_assumed),
                ("elbow_deg", !limits.elbow.is_all()),
                ("speed", limits.speeds.is_some()),
                ("reach", robot.reach.is_some()),
                ("mass", robot.mass_kg.is_some()),
                ("repeatability", robot.repeatability.is_some()),
                ("body", robot.body.is_some()),
            ];
            for (group, is_stated) in stated {
                assert!(!is_stated || source.contains_key(group), "{name}: [source] lacks {group}");
            }
            assert!(!robot.vendor.is_empty());
        }
    }

    #[test]
    fn no_two_robots_answer_to_the_same_name() {
        let mut taken = BTreeSet::new();
        for entry in entries() {
            for typed in BTreeSet::from([key(entry.name), key(&entry.full_name())]) {
                assert!(taken.insert(typed), "{} is there twice", entry.full_name());
            }
        }
    }

    #[test]
    fn a_robot_stands_in_the_folder_of_its_maker() {
        for entry in entries() {
            let folder = entry.path.split('/').next().unwrap();
            assert!(folder == "paper" || folder == entry.vendor.to_lowercase(), "{}", entry.path);
        }
    }

    #[test]
    fn the_catalogue_holds_the_papers_robots_and_hundreds_more_in_order() {
        let all = robots();
        assert!(220 < all.len(), "{}", all.len());
        assert_eq!(ROBOTS.get_dir("paper").unwrap().files().count(), paper_robots().len());
        assert!(paper_robots().iter().all(|robot| all.contains(robot)));
        assert!(all.windows(2).all(|pair| pair[0].vendor.to_lowercase() <= pair[1].vendor.to_lowercase()));
        let place = |name: &str| all.iter().position(|robot| robot.name == name).unwrap();
        assert!(
            place("KR 6 R900 sixx") < place("KR 10 R1100 sixx")
                && place("KR 10 R1100 sixx") < place("KR 120 R2500 pro")
        );
    }

    /// What the numbers of a mistaken zero, sign or unit would break on any arm with a spherical wrist.
    #[test]
    fn every_arm_can_stand_upright_reach_forwards_and_bend_its_elbow() {
        for robot in robots() {
            let Robot { name, .. } = &robot;
            let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("{name} has six axes") };
            let lean = geometry.shoulder(limits.joints[1]).affine(-1.0, std::f64::consts::FRAC_PI_2);
            let [back, front] = [lean.min(), lean.max()].map(f64::to_degrees);
            assert!((-140.0..=-25.0).contains(&back) && (45.0..=175.0).contains(&front), "{name}: {back} {front}");
            let (upper, forearm) = (geometry.c2, geometry.l3());
            assert!((0.4..=2.0).contains(&(forearm / upper)), "{name}: {upper} {forearm}");
            assert!(geometry.a2.abs() < 0.5 * geometry.c3 && 0.0 < geometry.c1 && 0.0 <= geometry.a1, "{name}");
            let plane = robot.arm_plane().unwrap().arm;
            let [folded, bent_back] = [plane.elbow.min(), plane.elbow.max()].map(f64::to_degrees);
            let bends = !plane.elbow.is_all() && folded < -90.0 && -30.0 < bent_back;
            assert!(bends && -210.0 < folded && bent_back < 190.0, "{name}: {folded} {bent_back}");
            let ahead = plane.sides().unwrap().iter().any(|side| side.reaches([0.7 * (upper + forearm), 0.0].into()));
            assert!(ahead, "{name} does not reach ahead");
            let listed = include_str!("../../robots/README.md").lines();
            let row = listed.into_iter().find(|line| line.starts_with(&format!("| {} |", robot.full_name())));
            let about_reach = warnings(&robot).into_iter().filter(|warning| warning.starts_with("reach_m")).count();
            match row {
                None => {
                    let found = warnings(&robot);
                    assert!(robot.payload_kg.is_none() || found.is_empty(), "{name}: {found:?}");
                }
                Some(row) => {
                    let numbers = format!("| {:.3} | {:.3} |", robot.reach.unwrap(), robot.reach_ahead().unwrap());
                    assert!(about_reach == 1 && row.contains(&numbers), "{row}: {numbers}");
                }
            }
        }
    }

    #[test]
    fn what_rests_on_an_assumed_limit_is_called_estimated() {
        for robot in robots() {
            let assumed = ["elbow_deg", "limits", "geometry"].iter().any(|group| {
                robot
                    .source
                    .get(*group)
                    .is_some_and(|text| text.starts_with("assumed") || text.starts_with("estimated"))
            });
            assert!(!assumed || robot.status == Status::Estimated, "{}", robot.name);
        }
    }

    #[test]
    fn a_near_miss_is_answered_with_the_name_that_was_meant() {
        let robots = paper_robots();
        assert!(names(&robots[4], "kuka kr210-R2700 EXTRA"));
        assert!(names(&robots[2], "irb6650s200"));
        assert_eq!(find("Yaskawa es200rd ii").unwrap().robot(), robots[0]);
        assert_eq!(find("irb 6640-235 2.55").unwrap().name, "IRB 6640-235/2.55");
        assert!(find("IRB 6640").is_none(), "several are meant");
        assert_eq!(suggestions("KR 120 R2700 extra")[0], "KR 210 R2700 extra");
        assert_eq!(suggestions("bt200")[0], "BT200L");
        assert!(suggestions("IRB 6640").iter().all(|name| name.contains("6640")));
        assert!(suggestions("zzzz").is_empty());
    }

    #[test]
    fn numbers_in_names_are_ordered_as_numbers() {
        assert_eq!(by_name("KR 6 R900", "KR 10 R1100"), Ordering::Less);
        assert_eq!(by_name("KR 6", "KR 6-2"), Ordering::Less);
        assert_eq!(by_name("a 99999999999999999999999", "a 1"), Ordering::Greater);
        assert_eq!(by_name("GP8", "gp8"), "GP8".cmp("gp8"));
    }
}
