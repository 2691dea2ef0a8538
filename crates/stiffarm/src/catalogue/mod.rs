//! Robot files and the robots that come with the program; the only module in which millimetres and degrees exist.

mod fault;
pub mod import;
mod reader;
mod robot_file;
mod write;

use include_dir::{Dir, include_dir};

pub use fault::{Fault, Faults};
pub use robot_file::read;
pub use write::write;

use crate::robot::Robot;

static ROBOTS: Dir = include_dir!("$CARGO_MANIFEST_DIR/robots");

/// The ten robots of the paper, in the order of its Table II.
const PAPER: [&str; 10] = [
    "yaskawa_es200rd_ii",
    "yaskawa_hp350d_200",
    "abb_irb_6650s_200_3_0",
    "abb_irb_6400_2_4_200",
    "kuka_kr_210_r2700_extra",
    "staubli_tx340_sh",
    "fanuc_r_2000ic_210r",
    "fanuc_m_900ia_200p",
    "kawasaki_bt200l",
    "kawasaki_zx200u",
];

/// The ten robots of the paper, in its order.
///
/// # Panics
/// Never: the files are compiled in, and a test reads them all.
pub fn paper_robots() -> Vec<Robot> {
    PAPER
        .iter()
        .map(|stem| {
            let path = format!("paper/{stem}.toml");
            let text = ROBOTS.get_file(&path).and_then(include_dir::File::contents_utf8).expect("compiled in");
            read(text, &path).expect("a test reads every robot that is compiled in")
        })
        .collect()
}

/// What people type of a name: case, blanks and punctuation do not matter.
fn key(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Does `typed` name this robot, with or without its maker?
pub fn names(robot: &Robot, typed: &str) -> bool {
    let typed = key(typed);
    typed == key(&robot.name) || typed == key(&format!("{}{}", robot.vendor, robot.name))
}

/// The names closest to what was typed, best first, at most three.
pub fn suggestions<'a>(robots: &'a [Robot], typed: &str) -> Vec<&'a str> {
    let typed = key(typed);
    let mut scored: Vec<(f64, &str)> = robots
        .iter()
        .map(|robot| {
            let (short, long) = (key(&robot.name), key(&format!("{}{}", robot.vendor, robot.name)));
            let part = if 3 <= typed.len() && long.contains(&typed) { 0.95 } else { 0.0 };
            let score = strsim::jaro_winkler(&typed, &short).max(strsim::jaro_winkler(&typed, &long)).max(part);
            (score, robot.name.as_str())
        })
        .filter(|(score, _)| 0.7 < *score)
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.into_iter().map(|(_, name)| name).take(3).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_robot_that_is_compiled_in_can_be_read_and_has_sources() {
        let robots = paper_robots();
        assert_eq!(robots.len(), ROBOTS.get_dir("paper").unwrap().files().count());
        for robot in &robots {
            assert!(robot.source.contains_key("geometry") && robot.source.contains_key("limits"), "{}", robot.name);
            assert!(!robot.arm_plane().unwrap().arm.sides().unwrap().is_empty());
        }
    }

    #[test]
    fn a_near_miss_is_answered_with_the_name_that_was_meant() {
        let robots = paper_robots();
        assert!(names(&robots[4], "kuka kr210-R2700 EXTRA"));
        assert!(names(&robots[2], "irb6650s200"));
        assert_eq!(suggestions(&robots, "KR 120 R2700 extra")[0], "KR 210 R2700 extra");
        assert_eq!(suggestions(&robots, "bt200")[0], "BT200L");
        assert!(suggestions(&robots, "zzzz").is_empty());
    }
}
