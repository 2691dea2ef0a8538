//! How stiff are the drives, and who says so? In the same words wherever a deflection is reported.

use super::numbers::{digits, fixed};
use super::{Record, field, uncertainty};
use stiffarm::catalogue::microradians;
use stiffarm::drive::{JointCompliance, Knowledge, Scatter};
use stiffarm::prior::against_size;
use stiffarm::robot::{Arm, Robot, StiffnessSource};

/// The name of the line that tells it.
pub(super) const LINE: &str = "stiffness";
/// So many robots of one stiffness are named; more are counted.
const MOST_NAMED: usize = 3;
/// So many stiffnesses stand in a heading; more are counted.
const MOST_STIFFNESSES: usize = 4;

/// Of one robot: `1 urad/(N m) assumed on every drive`.
pub fn stiffness(robot: &Robot) -> String {
    let urad: Vec<f64> = robot.drive_compliance().into_iter().flatten().map(microradians).collect();
    let is_planar = matches!(robot.arm, Arm::Planar(_));
    let is_uniform = urad.iter().all(|k| *k == urad[0]);
    let is_measured = robot.identified().is_some() || robot.scatter().is_some();
    let shown: Vec<f64> = urad.iter().map(|k| if is_measured { digits(*k, 3) } else { digits(*k, 6) }).collect();
    let values = if is_uniform { shown[0].to_string() } else { listed(&shown) };
    let drives = match (is_uniform, is_planar) {
        (_, true) => "the drives 2 and 3",
        (true, false) => "every drive",
        (false, false) => "the drives 1-6",
    };
    let is_papers = is_uniform && urad[0] == microradians(JointCompliance::PAPER.0[0]);
    let text = match robot.stiffness_source() {
        StiffnessSource::Assumed if is_papers => format!("{values} urad/(N m) assumed on {drives}"),
        StiffnessSource::Assumed => format!("{values} urad/(N m) on {drives}, partly assumed"),
        StiffnessSource::File => format!("{values} urad/(N m) on {drives}, from the robot file"),
        StiffnessSource::Identified => format!("{values} urad/(N m) on {drives}, {}", measured(robot)),
        StiffnessSource::Prior => {
            format!("{values} urad/(N m) on {drives}, the prior by payload and reach, {}", within(robot))
        }
        StiffnessSource::Published => {
            let differ = uncertainty::disagreement(robot).map_or_else(String::new, |sentence| format!("; {sentence}"));
            format!("{values} urad/(N m) on {drives}, as published{}, {}{differ}", by_the_prior(robot), within(robot))
        }
        StiffnessSource::Given if is_uniform && 0.0 < urad[0] => {
            format!("given: {values} urad/(N m) on {drives}, {} MN m/rad", rounded(1.0 / urad[0]))
        }
        StiffnessSource::Given => format!("given: {values} urad/(N m) on {drives}"),
    };
    let text = format!("{text}{}", doubt(robot).unwrap_or_default());
    let compensated = matches!(&robot.arm, Arm::SixAxis { drives, .. } if drives.compensator.is_some());
    if compensated { format!("{text}; drive 2 with its gravity compensator") } else { text }
}

/// That a stiffness which somebody has written is that of no robot as large, where it is so.
fn doubt(robot: &Robot) -> Option<String> {
    /// Measured robots of one size lie within a factor of ten of each other; a unit is a thousand times another.
    const UNLIKE: f64 = 100.0;
    let is_written = matches!(
        robot.stiffness_source(),
        StiffnessSource::Given | StiffnessSource::File | StiffnessSource::Identified
    );
    let ratio = against_size(robot).filter(|_| is_written)?;
    let (times, how) = if ratio < 1.0 { (1.0 / ratio, "stiff") } else { (ratio, "compliant") };
    (UNLIKE < times).then(|| {
        let times = digits(times, 2);
        format!("; DOUBTFUL: {times} times as {how} as drives of robots of this payload and reach; is that the unit?")
    })
}

/// Which drives of a robot, from 1, no publication shows, where some show others.
fn unpublished(robot: &Robot) -> Vec<String> {
    let Some(Knowledge::Published { drives, .. }) = robot.scatter().map(|scatter| &scatter.knowledge) else {
        return Vec::new();
    };
    (1..=6).filter(|drive| !drives[drive - 1]).map(|drive| drive.to_string()).collect()
}

/// The same behind their values: ` (4, 5: the prior by payload and reach)`.
fn by_the_prior(robot: &Robot) -> String {
    match unpublished(robot) {
        others if others.is_empty() => String::new(),
        others => format!(" ({}: the prior by payload and reach)", others.join(", ")),
    }
}

/// Who says how stiff the drives of some robots are, each once.
pub(super) fn sources<'a>(robots: impl Iterator<Item = &'a Robot>) -> String {
    let mut stated: Vec<String> = Vec::new();
    for robot in robots {
        let says = match robot.stiffness_source() {
            StiffnessSource::Assumed => stiffness(robot),
            StiffnessSource::File => "drive stiffness from the robot file".into(),
            StiffnessSource::Identified => "drive stiffness identified".into(),
            StiffnessSource::Prior => "drive stiffness by the prior for payload and reach".into(),
            StiffnessSource::Published => "drive stiffness as published".into(),
            StiffnessSource::Given => "drive stiffness as given".into(),
        };
        if !stated.contains(&says) {
            stated.push(says);
        }
    }
    stated.join(" or ")
}

/// By which factors 90 % of drives differ from that.
fn within(robot: &Robot) -> String {
    let [least, most] = factors(robot);
    format!("90 % within a factor of {} to {}", digits(least, 2), digits(most, 2))
}

/// The same for the drive of which most is known, and of which least is.
fn factors(robot: &Robot) -> [f64; 2] {
    /// Five of a hundred are beyond so many standard deviations.
    const NINETY: f64 = 1.645;
    let factors = robot.scatter().map_or([1.0; 6], Scatter::total).map(|sd| (NINETY * sd).exp());
    [factors.into_iter().fold(f64::INFINITY, f64::min), factors.into_iter().fold(1.0, f64::max)]
}

/// In how many postures, when, and what was not seen there.
fn measured(robot: &Robot) -> String {
    let Some(identified) = robot.identified() else { return "from the robot file".into() };
    let date = identified.date.as_ref().map_or_else(String::new, |date| format!(", {date}"));
    let others: Vec<String> =
        (1..=6).filter(|&drive| !identified.drives[drive - 1]).map(|drive| drive.to_string()).collect();
    let others = if others.is_empty() { String::new() } else { format!("; not identified: {}", others.join(", ")) };
    let residual = match identified.residual_share() {
        Some(share) => format!("residual {} % of a displacement", fixed(100.0 * share, 0)),
        None => format!("residual {} mm", fixed(identified.unexplained(0.0, 1) * 1e3, 3)),
    };
    format!("identified in {} postures{date}, {residual}{others}", identified.postures)
}

/// Of some robots, in the order in which they are met.
pub fn stiffnesses<'a>(robots: impl IntoIterator<Item = &'a Robot>) -> String {
    let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
    let robots: Vec<&Robot> = robots.into_iter().collect();
    let are_several = robots.iter().any(|robot| robot.drive_compliance() != robots[0].drive_compliance());
    let scattered: Vec<[f64; 2]> =
        robots.iter().filter(|robot| are_several && robot.scatter().is_some()).map(|robot| factors(robot)).collect();
    for robot in robots {
        // Numbers of one robot are of use; of many, who says so.
        let text = match robot.stiffness_source() {
            StiffnessSource::Published if are_several => match unpublished(robot) {
                others if others.is_empty() => "drives as published".to_owned(),
                others => format!("drives as published, {} by the prior for payload and reach", others.join(" and ")),
            },
            StiffnessSource::Prior if are_several => "drives by the prior for payload and reach".into(),
            _ => stiffness(robot),
        };
        match groups.iter_mut().find(|(known, _)| *known == text) {
            Some((_, names)) => names.push(&robot.name),
            None => groups.push((text, vec![&robot.name])),
        }
    }
    if let [(text, _)] = groups.as_slice()
        && scattered.is_empty()
    {
        return text.clone();
    }
    let more: usize = groups.iter().skip(MOST_STIFFNESSES).map(|(_, names)| names.len()).sum();
    let mut parts: Vec<String> =
        groups.iter().take(MOST_STIFFNESSES).map(|(text, names)| format!("{text} ({})", of(names))).collect();
    if 0 < more {
        parts.push(format!("others on {more} more (`stiffarm robots show NAME`)"));
    }
    let named = parts.join("; ");
    if scattered.is_empty() {
        return named;
    }
    let (least, most) = scattered.iter().fold((f64::INFINITY, 1.0_f64), |(a, b), [c, d]| (a.min(*c), b.max(*d)));
    format!("{named}; 90 % of drives within a factor of {} to {} of that", digits(least, 2), digits(most, 2))
}

fn of(names: &[&str]) -> String {
    if names.len() <= MOST_NAMED { names.join(", ") } else { format!("{} robots", names.len()) }
}

/// Six digits of a number that came out of a division.
fn rounded(x: f64) -> f64 {
    digits(x, 6)
}

fn listed(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
}

/// Every field that says which robot it is, how well it is known, and how stiff its drives are.
pub(super) fn put_robot(record: &mut Record, robot: &Robot) {
    record
        .put(field::ROBOT, &robot.name)
        .put(field::VENDOR, &robot.vendor)
        .put(field::ARCHITECTURE, robot.architecture.name())
        .put(field::ARCHITECTURE_ASSUMED, robot.architecture_is_assumed)
        .put(field::STATUS, robot.status.name());
    put(record, robot);
}

/// The same as fields.
pub(super) fn put(record: &mut Record, robot: &Robot) {
    record
        .put(field::STIFFNESS_SOURCE, robot.stiffness_source().name())
        .put(field::DRIVE_COMPLIANCE, super::Datum::Numbers(robot.drive_compliance().to_vec()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm::catalogue::{paper_robots, read, with_compliance};

    #[test]
    fn every_stiffness_says_its_value_and_who_says_it() {
        let robot = paper_robots().swap_remove(4);
        assert_eq!(stiffness(&robot), "1 urad/(N m) assumed on every drive");
        let given = with_compliance(&robot, [0.5; 6]).unwrap();
        // By hand: 1 / (0.5e-6 rad/(N m)) = 2e6 N m/rad.
        assert_eq!(stiffness(&given), "given: 0.5 urad/(N m) on every drive, 2 MN m/rad");
        let each = with_compliance(&robot, [0.5, 1.0, 2.0, 3.0, 4.0, 0.0]).unwrap();
        assert_eq!(stiffness(&each), "given: 0.5, 1, 2, 3, 4, 0 urad/(N m) on the drives 1-6");
        // 2000 is what somebody types whose data sheet has kN m/rad.
        let doubtful = stiffness(&with_compliance(&robot, [2000.0; 6]).unwrap());
        assert!(doubtful.contains("; DOUBTFUL: ") && doubtful.contains(" times as compliant as"), "{doubtful}");
        let doubtful = stiffness(&with_compliance(&robot, [0.002; 6]).unwrap());
        assert!(doubtful.contains(" times as stiff as drives of robots of this payload"), "{doubtful}");
        // What is asked of one drive, or stated of a small robot in round numbers, is no other unit.
        let rigid_wrist = stiffness(&with_compliance(&robot, [0.5, 0.5, 0.5, 0.001, 0.001, 0.001]).unwrap());
        let small = stiffarm::catalogue::find("IRB 120-3/0.58").unwrap().robot();
        let round = stiffness(&with_compliance(&small, [1.0; 6]).unwrap());
        assert!(!rigid_wrist.contains("DOUBTFUL") && !round.contains("DOUBTFUL"), "{rigid_wrist} {round}");
        let filed = Robot { stiffness_is_assumed: false, ..robot.clone() };
        assert_eq!(stiffness(&filed), "1 urad/(N m) on every drive, from the robot file");
        let planar = |more: &str| {
            let text = format!(
                "name = 'x'\narchitecture = 'serial'\nstatus = 'derived'\n[planar]\nl2_mm = 1000\nl3_mm = 800\n{more}"
            );
            stiffness(&read(&text, "x.toml").unwrap())
        };
        assert_eq!(planar(""), "1 urad/(N m) assumed on the drives 2 and 3");
        assert_eq!(planar("k2_urad_per_nm = 2"), "2, 1 urad/(N m) on the drives 2 and 3, partly assumed");
        let both = planar("k2_urad_per_nm = 1\nk3_urad_per_nm = 1");
        assert_eq!(both, "1 urad/(N m) on the drives 2 and 3, from the robot file");
        assert_eq!(stiffnesses([&robot, &robot]), stiffness(&robot));
        let names = format!(" ({})", robot.name);
        assert_eq!(
            stiffnesses([&robot, &given]),
            [stiffness(&robot), stiffness(&given)].join(&format!("{names}; ")) + &names
        );
    }
}
