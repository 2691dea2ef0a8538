//! Compensators, unusual couplings and rigid drives: is what `docs/robot_file.md` says true, and does every verb say what it cannot answer?

use nalgebra::Matrix6;
use stiffarm::catalogue::{paper_robots, read};
use stiffarm::compliance::compliance;
use stiffarm::load::Load;
use stiffarm::model::{Model, ModelError, ModelKind};
use stiffarm::place::{PlaceOptions, place};
use stiffarm::rank::rank;
use stiffarm::robot::{Arm, NoArmPlane, Robot};
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Zone};
use stiffarm::watch::Watch;

const DOCS: &str = include_str!("../../../docs/robot_file.md");

/// The whole robot file of the text.
fn documented() -> &'static str {
    let blocks = DOCS.split("```toml\n").skip(1).map(|block| block.split("```").next().unwrap());
    blocks.filter(|block| block.starts_with("name")).last().unwrap()
}

fn of(text: &str) -> Robot {
    read(text, "documented.toml").unwrap()
}

/// The numbers of the rows of a table, by how its heading begins.
fn table(heading: &str) -> Vec<Vec<f64>> {
    let rows = DOCS.lines().skip_while(|line| !line.starts_with(heading)).skip(2);
    let numbers = |row: &str| row.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
    rows.take_while(|line| line.starts_with('|')).map(numbers).collect()
}

#[test]
fn the_compensators_worked_numbers_are_those_of_its_energy() {
    let robot = of(documented());
    let Arm::SixAxis { drives, .. } = &robot.arm else { panic!("six axes") };
    let spring = drives.compensator.unwrap();
    // From the file by hand: the end on the arm turns about the joint-2 axis, energy is half the stiffness times the square of the stretch.
    let length = |theta: f64| (0.25 * theta.sin() + 0.6).hypot(0.25 * theta.cos() - 0.1);
    let energy = |theta: f64| 0.5 * 200e3 * (length(theta) - 0.4).powi(2);
    let step = 1e-4;
    let rows = table("| theta2 deg");
    assert_eq!(rows.len(), 4);
    for row in rows {
        let [degrees, mm, moment, added, softened] = row[..] else { panic!("{row:?}") };
        let theta = degrees.to_radians();
        let (before, here, after) = (energy(theta - step), energy(theta), energy(theta + step));
        let slope = (after - before) / (2.0 * step);
        let bend = (after - 2.0 * here + before) / (step * step);
        // Half a unit of the last printed digit, and what finite differences leave.
        assert!((1e3 * length(theta) - mm).abs() <= 0.051, "{row:?}");
        assert!((-slope - moment).abs() <= 0.6, "{row:?}: {}", -slope);
        assert!((bend - added).abs() <= 0.7, "{row:?}: {bend}");
        assert!((1e6 / (1e6 + bend) - softened).abs() <= 0.51e-4, "{row:?}");
        assert!((spring.stiffness(theta) - bend).abs() <= 0.1, "{row:?}: {} {bend}", spring.stiffness(theta));
        assert!((spring.torque(theta) + slope).abs() <= 0.1, "{row:?}");
    }
}

#[test]
fn the_transmissions_worked_numbers_are_those_of_the_wrist_and_of_the_parallelogram() {
    let robot = of(documented());
    let Arm::SixAxis { drives, .. } = &robot.arm else { panic!("six axes") };
    let joints: Matrix6<f64> = drives.transmission.0 * drives.transmission.0.transpose();
    let printed: Vec<f64> = table("| | urad/(N m) |").concat();
    for ((i, j), printed) in [(3, 3), (4, 3), (4, 4)].into_iter().zip(printed) {
        assert!((joints[(i, j)] - printed).abs() < 5e-3, "{i} {j}: {printed}");
    }
    let parallelogram = DOCS.split("```toml\n").find(|block| block.starts_with("transmission")).unwrap();
    let parallelogram = parallelogram.split("```").next().unwrap();
    let usual = documented().replace("\"serial\"", "\"quasi-serial\"");
    let start = usual.find("transmission").unwrap();
    let end = usual[start..].find("\n]\n").unwrap() + start + 3;
    let written = format!("{}{parallelogram}{}", &usual[..start], &usual[end..]);
    let left_out = format!("{}{}", &usual[..start], &usual[end..]);
    assert_eq!(of(&written), of(&left_out));
}

/// A quarter of a radian more in the elbow with the same radius: the compliance of the plane follows the lean as well.
#[test]
fn with_a_compensator_the_compliance_is_no_function_of_the_distance() {
    let robot = of(documented());
    let at = |lean: f64| {
        let posture = compliance(&robot, &[0.0, lean, 1.2, 0.0, 0.4, 0.0], &Pose::identity()).unwrap();
        posture.compliance.worst().0
    };
    let without = of(documented().split("[compensator]").next().unwrap());
    let upright = |lean: f64| {
        let posture = compliance(&without, &[0.0, lean, 1.2, 0.0, 0.4, 0.0], &Pose::identity()).unwrap();
        posture.compliance.0[(0, 0)] + posture.compliance.0[(2, 2)] // of the plane, whichever way it is turned
    };
    assert!((upright(0.0) - upright(0.6)).abs() < 1e-12 * upright(0.0));
    assert!(1e-3 * at(0.0) < (at(0.0) - at(0.6)).abs(), "{} {}", at(0.0), at(0.6));
}

#[test]
fn the_planar_verbs_refuse_a_compensator_and_a_ranking_goes_on_without_it() {
    let robot = of(documented());
    let task: Task = "A:0.5".parse().unwrap();
    let options = PlaceOptions::under(Load::PAPER);
    assert_eq!(Model::planar(&robot).unwrap_err(), ModelError::NoArmPlane(NoArmPlane::Compensator));
    let kind = ModelKind::Planar;
    let mut robots = paper_robots();
    robots.truncate(2);
    let alone = rank(&robots, std::slice::from_ref(&task), &kind, &options, Watch::nobody()).unwrap();
    robots.push(robot.clone());
    let ranking = rank(&robots, std::slice::from_ref(&task), &kind, &options, Watch::nobody()).unwrap();
    assert_eq!(ranking.rows.len(), 3);
    for (row, other) in ranking.rows.iter().zip(&alone.rows) {
        assert_eq!(
            (&row.robot, row.deflection(0), row.mean_ratio),
            (&other.robot, other.deflection(0), other.mean_ratio)
        );
    }
    let last = &ranking.rows[2];
    assert_eq!((last.robot.name.as_str(), last.deflection(0), last.floor), (robot.name.as_str(), None, None));
    assert!(last.why_not_of_the_plane().unwrap().to_string().contains("gravity compensator"));
    assert_eq!(ranking.row_of(&robot).unwrap().rank, None);
    // Alone there is nothing to rank; beside a ranking in space there need not be.
    let refused =
        rank(std::slice::from_ref(&robot), std::slice::from_ref(&task), &kind, &options, Watch::nobody()).unwrap_err();
    assert!(refused.to_string().contains("gravity compensator"), "{refused}");
    let in_space = rank(&[robot], &[task], &ModelKind::Spatial(Pose::identity()), &options, Watch::nobody()).unwrap();
    assert!(in_space.in_plane.unwrap().rows[0].why_not_of_the_plane().is_some());
}

#[test]
fn rigid_drives_are_taken_and_two_that_do_not_give_way_are_as_good_as_each_other() {
    let rigid = |drives: &str| {
        let text = documented().split("[compensator]").next().unwrap();
        of(&text.replace("drive_urad_per_nm = [1, 1, 1, 1, 1, 1]", &format!("drive_urad_per_nm = {drives}")))
    };
    // Drive 6 alone turns the flange about its own axis: its centre does not move.
    let still = rigid("[0, 0, 0, 0, 0, 1]");
    let twin = Robot { name: "twin".into(), ..still.clone() };
    let task: Task = Zone::Circle { diameter: 0.1 }.into();
    let (kind, options) = (ModelKind::Spatial(Pose::identity()), PlaceOptions::under(Load::PAPER));
    let ranking = rank(&[still.clone(), twin], std::slice::from_ref(&task), &kind, &options, Watch::nobody()).unwrap();
    for row in &ranking.rows {
        // Rounding of sines and cosines, squared.
        assert!(row.deflection(0).unwrap() < 1e-30 && row.mean_ratio == Some(1.0), "{row:?}");
        assert_eq!(row.placement(0).unwrap().gap(), 0.0);
    }
    assert_eq!(still.arm_plane(), Err(NoArmPlane::Rigid));
    // By hand: with drive 2 rigid, a serial arm gives way by k3 l3^2 wherever it stands.
    let elbow = rigid("[1, 0, 1, 1, 1, 1]");
    let placed =
        place(&Model::planar(&elbow).unwrap(), &task.work, &PlaceOptions::under(Load::PAPER), Watch::nobody()).unwrap();
    let expected = 1e-6 * (1.2_f64.powi(2) + 0.05_f64.powi(2)) * 1000.0;
    assert!((placed.feasible().unwrap().deflection - expected).abs() <= 1e-9 * expected);
    let all = documented().replace("nm = [1, 1, 1, 1, 1, 1]", "nm = [0, 0, 0, 0, 0, 0]");
    assert!(read(&all, "x.toml").unwrap_err().to_string().contains("every drive is rigid"));
}

#[test]
fn a_compensator_that_nothing_holds_is_refused_before_a_search_in_space() {
    let mut robot = of(documented());
    let Arm::SixAxis { drives, .. } = &mut robot.arm else { panic!("six axes") };
    drives.compliance.0[1] = 1e-3; // 1000 N m/rad, of which the spring takes 14 800 at the lower limit
    let refused = Model::spatial(&robot, &Pose::identity()).unwrap_err().to_string();
    assert!(refused.contains("pushes harder than drive 2 holds"), "{refused}");
}
