//! Is a zone that is asked for at one place evaluated there, and nowhere else?

use stiffarm::catalogue::{find, paper_robots};
use stiffarm::compliance::compliance;
use stiffarm::inverse::reached;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{Misfit, Placed, Placement, place};
use stiffarm::robot::{Arm, Robot};
use stiffarm::watch::Watch;
use stiffarm_ask::request::{Pair, Refusal, Request, Spelling, Verb};

fn asked(given: &[(&str, &str)]) -> Result<Request, Refusal> {
    let pair = |(name, text): &(&str, &str)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed };
    Request::read(Verb::Place, &given.iter().map(pair).collect::<Vec<_>>(), Spelling::Typed)
}

fn robot() -> Robot {
    paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("one of the paper's")
}

fn placed(given: &[(&str, &str)]) -> Placed {
    let request = asked(given).unwrap();
    let robot = request.robot().map_or_else(|_| robot(), |name| find(&name).expect("in the catalogue").robot());
    let (robot, work) = (request.equipped(robot).unwrap(), request.task().unwrap().work);
    let model: Model = request.model().of(&robot).unwrap();
    place(&model, &work, &request.place_options(work.zone()).unwrap(), Watch::nobody()).unwrap()
}

fn feasible(given: &[(&str, &str)]) -> Placement {
    match placed(given) {
        Placed::Feasible(best) => best,
        Placed::Infeasible { reason, .. } => panic!("{reason:?}"),
    }
}

/// The worst of many points of a disc, each by the paper's formula: sigma of the two links' drives, at the elbow of the answer.
#[test]
fn in_the_plane_the_value_is_the_worst_of_the_disc_at_that_place() {
    let best = feasible(&[("task", "circle:0.3"), ("at", "1.6,1.1")]);
    assert!((best.centre[0] - 1.6).abs() < 1e-8 && (best.centre[1] - 1.1).abs() < 1e-8, "{:?}", best.centre);
    let arm = robot().arm_plane().unwrap().arm;
    let axis = robot().axis_2();
    let mut worst = 0.0_f64;
    for i in 0..=100 {
        for j in 0..=360 {
            let (radius, angle) = (0.15 * f64::from(i) / 100.0, f64::from(j).to_radians());
            let point = [1.6 + radius * angle.cos() - axis[0], 1.1 + radius * angle.sin() - axis[1]];
            // Both drives push the wrist across the line from their axis: a singular value of the 2 x 2 Jacobian with its springs.
            let r = point[0].hypot(point[1]);
            let bend = ((r * r - arm.l2 * arm.l2 - arm.l3 * arm.l3) / (2.0 * arm.l2 * arm.l3)).acos();
            // Seen along the first link: the second drive turns all of it, the third the forearm.
            let tip = nalgebra::Vector2::new(arm.l2 + arm.l3 * bend.cos(), arm.l3 * bend.sin());
            let elbow = nalgebra::Vector2::new(arm.l2, 0.0);
            let across = |arm: nalgebra::Vector2<f64>| nalgebra::Vector2::new(-arm.y, arm.x);
            let (second, third) = (across(tip), across(tip - elbow));
            let compliance = second * second.transpose() * arm.k2 + third * third.transpose() * arm.k3;
            worst = worst.max(1000.0 * compliance.symmetric_eigenvalues().max());
        }
    }
    assert!((best.deflection / worst - 1.0).abs() < 1e-4, "{} {worst}", best.deflection);
    assert!(0.99 * best.deflection < best.lower_bound && best.lower_bound <= best.deflection);
}

/// Points of the zone through inverse kinematics and compliance alone, in the configuration and at the roll of the answer.
#[test]
fn in_space_the_value_is_the_worst_of_the_zone_at_that_place() {
    for direction in ["down", "forward"] {
        let given = [
            ("task", "rect:0.3x0.2"),
            ("at", "1.5,1.0"),
            ("angle", "30"),
            ("model", "spatial"),
            ("tool", "spindle:250@90"),
            ("tool-direction", direction),
        ];
        let best = feasible(&given);
        let hold = best.space().unwrap();
        assert!((best.centre[0] - 1.5).abs() < 1e-6 && (best.centre[1] - 1.0).abs() < 1e-6, "{:?}", best.centre);
        assert!((best.angle - 30_f64.to_radians()).abs() < 1e-9 && hold.yaw.abs() < 1e-9, "{best:?}");
        let request = asked(&given).unwrap();
        let (robot, tool) = (request.equipped(robot()).unwrap(), request.tool_pose().tool());
        let Arm::SixAxis { .. } = &robot.arm else { unreachable!() };
        // The tool axis, and what its x axis is at no roll: ahead on a table, upright on a wall.
        let (axis, up) = if direction == "down" {
            (-nalgebra::Vector3::z(), nalgebra::Vector3::x())
        } else {
            (nalgebra::Vector3::x(), nalgebra::Vector3::z())
        };
        let (sr, cr) = hold.roll.sin_cos();
        let y = axis.cross(&up);
        let rotation = nalgebra::Matrix3::from_columns(&[up * cr + y * sr, y * cr - up * sr, axis]);
        let rotation =
            nalgebra::UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(rotation));
        let left = nalgebra::Vector3::y();
        let (sa, ca) = 30_f64.to_radians().sin_cos();
        let (first, second) = (up * ca + left * sa, left * ca - up * sa);
        let mut worst = 0.0_f64;
        for i in -10..=10 {
            for j in -10..=10 {
                let at = nalgebra::Vector3::new(1.5, 0.0, 1.0)
                    + first * (0.15 * f64::from(i) / 10.0)
                    + second * (0.1 * f64::from(j) / 10.0);
                let flange = nalgebra::Isometry3::from_parts(at.into(), rotation) * tool.inverse();
                let found = reached(&robot, &flange);
                let (_, q) = found.into_iter().find(|(known, _)| *known == hold.configuration).expect("held");
                let posture = compliance(&robot, &q, &tool).unwrap();
                worst = worst.max(posture.under(Load::PAPER).value * 1000.0);
            }
        }
        assert!((best.deflection / worst - 1.0).abs() < 1e-3, "{direction}: {} {worst}", best.deflection);
    }
}

#[test]
fn the_best_place_asked_for_again_has_the_same_value_and_no_other_has_less() {
    for model in ["planar", "spatial"] {
        let with = |at: Option<&str>| {
            let mut given = vec![("task", "rect:0.4x0.2"), ("angle", "0"), ("model", model)];
            given.extend(at.map(|at| ("at", at)));
            placed(&given)
        };
        let Placed::Feasible(best) = with(None) else { panic!("there is a place") };
        let Placed::Feasible(again) = with(Some(&format!("{},{}", best.centre[0], best.centre[1]))) else {
            panic!("{model}: the best place is one")
        };
        assert!(
            (again.deflection / best.deflection - 1.0).abs() < 1e-3,
            "{model}: {} {}",
            again.deflection,
            best.deflection
        );
        for at in ["1.3,0.9", "1.5,0.6", "1.8,1.2"] {
            if let Placed::Feasible(other) = with(Some(at)) {
                assert!(best.lower_bound <= other.deflection, "{model} {at}");
            }
        }
        assert!(matches!(with(Some("9,9")), Placed::Infeasible { .. }));
    }
}

/// The same place with a little less clearance asked for than it has, and with a little more: nothing about a
/// place that was found is taken on trust.
#[test]
fn a_place_that_is_found_keeps_the_clearance_that_is_asked_for() {
    let there = [("task", "circle:0.1"), ("model", "spatial"), ("tool-mm", "0,0,250"), ("at", "1.5,0.6")];
    let has = feasible(&there).clearance_in_space.expect("it is known where the base stands").distance * 1e3;
    let with = |by: f64| placed(&[&there[..], &[("clearance-mm", &format!("{}", has + by))]].concat());
    assert!(0.0 < has && matches!(with(-1.0), Placed::Feasible(_)), "{has}");
    let Placed::Infeasible { reason: Misfit::Clearance { asked, otherwise }, .. } = with(1.0) else { panic!("{has}") };
    assert_eq!((asked * 1e3, otherwise.map(|kept| kept.distance * 1e3)), (has + 1.0, Some(has)));
}

/// In a cell, too, one place is one place: a box that stands there forbids it, and nothing turns the work about the joint-1 axis to where there
/// is room. (It was turned by 120 deg, and passed.)
#[test]
fn one_place_stays_where_it_is_in_a_cell() {
    let there = [
        ("task", "rect:0.3x0.2"),
        ("model", "spatial"),
        ("tool", "spindle:250@90"),
        ("force-n", "300"),
        ("at", "1.2,0.9"),
    ];
    let with = |more: &[(&str, &str)]| placed(&[&there[..], more].concat());
    let free = feasible(&there);
    let aside = ("keep-out", "1..2,1..3,..1.2");
    for more in [&[("clearance-mm", "10")][..], &[aside], &[("mount", "floor@30"), ("clearance-mm", "10")]] {
        let found = with(more);
        let Placed::Feasible(found) = &found else { panic!("{more:?}: {found:?}") };
        assert_eq!(found.space().unwrap().bearing, 0.0, "{more:?}: {found:?}");
        assert!((found.centre[0] - 1.2).abs() < 1e-6 && (found.centre[1] - 0.9).abs() < 1e-6, "{:?}", found.centre);
        assert!((found.deflection / free.deflection - 1.0).abs() < 1e-2, "{more:?}: {found:?} {free:?}");
    }
    assert!(matches!(with(&[("keep-out", "1..2,-3..3,..1.2")]), Placed::Infeasible { .. }));
}

/// Straight ahead joint 1 comes too near to its limits in the posture that gives way least: 0.2860 mm, at 3.4 deg about the joint-1 axis, is of another
/// place. By a program of its own, over all postures and rolls in steps of a degree, 0.2905 mm is the least straight ahead.
#[test]
fn one_place_is_straight_ahead_and_not_turned_into_the_range_of_joint_1() {
    let asked = [
        ("robot", "KR 210 R2700 extra"),
        ("task", "rect:0.5x0.3"),
        ("model", "spatial"),
        ("tool", "spindle:250@90"),
        ("force-n", "300,100,50"),
        ("feed-deg", "30"),
        ("angle", "90"),
    ];
    let ahead = feasible(&[&asked[..], &[("at", "1.3,0.9")]].concat());
    assert_eq!(ahead.space().unwrap().bearing, 0.0, "{ahead:?}");
    assert!((ahead.deflection * 1e3 - 0.2905).abs() < 2e-4, "{}", ahead.deflection);
    assert!(ahead.gap() < 0.011, "{}", ahead.gap());
    let turned = feasible(&[&asked[..], &[("within", "1.1..1.5,0.89..0.91")]].concat());
    assert!(turned.deflection < ahead.deflection);
}

/// A clearance that the best place keeps anyway costs nothing: where nothing stands about the robot, the work stands in front of it as it does
/// where no clearance is asked for.
#[test]
fn a_clearance_that_is_kept_anyway_changes_no_place() {
    let asked =
        [("task", "rect:0.3x0.2"), ("model", "spatial"), ("tool", "spindle:250@90"), ("within", "0.8..,0.5..1.2")];
    let (free, clear) = (feasible(&asked), feasible(&[&asked[..], &[("clearance-mm", "0")]].concat()));
    assert!(
        !free.clearance_in_space.is_some_and(|near| near.is_collision()) && clear.space().unwrap().bearing.abs() < 1e-9,
        "{free:?} {clear:?}"
    );
    assert!((clear.deflection / free.deflection - 1.0).abs() < 2e-2, "{} {}", clear.deflection, free.deflection);
}

#[test]
fn what_one_place_cannot_have_is_refused() {
    let refused = |given: &[(&str, &str)]| match asked(given) {
        Err(refusal) => refusal.to_string(),
        Ok(request) => {
            let work = request.task().unwrap().work;
            request.place_options(work.zone()).unwrap_err().to_string()
        }
    };
    let flat = ("task", "rect:0.3x0.2");
    for (given, words) in [
        (vec![flat, ("at", "1.5,0.8"), ("within", "1..2,0..1")], "--at"),
        (vec![flat, ("at", "1.5")], "x,z in m"),
        (vec![flat, ("at", "1.5,nan")], "--at"),
        (vec![flat, ("at", "1500,800")], "--at"),
        (vec![flat, ("at", "1.5,0.8"), ("angle", "free")], "--angle"),
        (vec![("task", "box:0.3x0.2x0.1"), ("model", "spatial"), ("at", "1.5,0.8")], "one flat zone"),
        (
            vec![flat, ("at", "1.5,0.8"), ("model", "spatial"), ("tool-direction", "forward"), ("yaw-deg", "-10..10")],
            "--yaw-deg",
        ),
    ] {
        let why = refused(&given);
        assert!(why.contains(words), "{given:?}: {why}");
    }
}

/// A zone that fits at a place lets every smaller one fit there, which gives way no more; and it stands where it was asked for. (Sizes whose window
/// was no whole number of steps wide had no place.)
#[test]
fn every_size_up_to_one_that_fits_has_the_place_that_is_asked_for() {
    for more in [&[][..], &[("mount", "pedestal:0")], &[("clearance-mm", "0")]] {
        let mut least = 0.0;
        for diameter in ["0.0001", "0.002", "0.01", "0.05", "0.1", "0.2", "0.3", "0.4"] {
            let task = format!("circle:{diameter}");
            let asked = [("task", &*task), ("model", "spatial"), ("tool-mm", "0,0,200"), ("at", "1.2,0.9")];
            let found = feasible(&[&asked[..], more].concat());
            assert_eq!(found.centre.map(|x| (x * 1e12).round() / 1e12), [1.2, 0.9], "{task} {more:?}");
            assert!(least <= found.deflection * (1.0 + 1e-3), "{task} {more:?}: {} after {least}", found.deflection);
            least = found.deflection;
        }
    }
}

/// The best place leaves the roll little freedom: at that place, asked for alone, the same roll is found again.
#[test]
fn the_roll_of_the_best_place_is_found_again_there() {
    for (robot, more) in [
        ("KR 210 R2700 extra", [("task", "rect:0.6x0.4"), ("force-n", "300,100,50")]),
        ("BT200L", [("task", "circle:0.5"), ("force-n", "1000")]),
    ] {
        let asked = [&[("robot", robot), ("model", "spatial"), ("tool", "spindle:250@90")][..], &more].concat();
        let best = feasible(&asked);
        let at = format!("{},{}", best.centre[0], best.centre[1]);
        let angle = format!("{}", best.angle.to_degrees());
        let mut there = [&asked[..], &[("at", &*at)]].concat();
        if more[0].1.starts_with("rect") {
            there.push(("angle", &*angle));
        }
        let again = feasible(&there);
        assert!(
            (again.deflection / best.deflection - 1.0).abs() < 2e-3,
            "{robot}: {} {}",
            again.deflection,
            best.deflection
        );
    }
}
