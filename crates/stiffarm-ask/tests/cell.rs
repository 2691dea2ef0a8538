//! Does a place in a cell keep windows, boxes and clearance, and is it what the same place without a cell is?

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Point3, Vector3};
use stiffarm::catalogue::find;
use stiffarm::cell::{Block, Cell, Mount, Window};
use stiffarm::clearance::Obstacle;
use stiffarm::compliance::compliance;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{Misfit, PlaceOptions, Placed, Placement, Within, place};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;
use stiffarm_ask::request::{Pair, Request, Spelling, Verb, block};

const CIRCLE: Zone = Zone::Circle { diameter: 0.3 };

fn robot() -> Robot {
    find("KR 210 R2700 extra").unwrap().robot()
}

fn model() -> Model {
    Model::spatial(&robot(), &Pose::translation(0.0, 0.0, 0.25)).unwrap()
}

/// What is asked as it is typed.
fn asked(given: &[(&str, &str)]) -> PlaceOptions {
    request(given).place_options(None).unwrap()
}

fn request(given: &[(&str, &str)]) -> Request {
    let usual = [("model", "spatial"), ("task", "circle:0.3")];
    let usual = usual.into_iter().filter(|(name, _)| given.iter().all(|(other, _)| other != name));
    let typed = usual.chain(given.iter().copied());
    let pair = |(name, text): (&str, &str)| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
    let pairs: Vec<Pair> = typed.map(pair).collect();
    Request::read(Verb::Place, &pairs, Spelling::Typed).unwrap()
}

fn best(zone: Zone, options: &PlaceOptions) -> Placement {
    let placed = place(&model(), &zone.into(), options, Watch::nobody()).unwrap();
    placed.feasible().unwrap_or_else(|| panic!("{placed:?}")).clone()
}

fn in_window(window: Block) -> PlaceOptions {
    let mut cell = Cell::of(Mount::pedestal(0.0));
    cell.windows[0] = Some(Window::Block(window));
    PlaceOptions { cell: Some(cell), ..PlaceOptions::under(Load::PAPER) }
}

/// The points of the arm at the worst point, in the axes of the cell: shoulder, elbow, wrist centre, flange.
fn arm_in_cell(placement: &Placement, cell: &Cell) -> Vec<Point3<f64>> {
    let points = model().points(&placement.posture()).unwrap();
    points.into_iter().map(|point| cell.mount.cell_from_base * Point3::from(point)).collect()
}

/// Where joint 1 turns to one side only, the best places of a window lie at its limit: they are found, and a wider window has none that is worse. (The
/// widest had no place at all, though 1.4, -0.8, 0.5 m, which a program of its own finds held at every roll, lies in each of them.)
#[test]
fn a_window_beside_the_range_of_joint_1_has_its_best_place_at_that_limit() {
    let mut robot = robot();
    let Arm::SixAxis { limits, .. } = &mut robot.arm else { panic!("six axes") };
    limits.joints[0] = Interval::spanning(10_f64.to_radians(), 120_f64.to_radians());
    let model = Model::spatial(&robot, &Pose::translation(0.0, 0.0, 0.2)).unwrap();
    let zone = Zone::Rectangle { width: 0.6, height: 0.4 };
    let of = |y: &str| {
        let within = format!("1.2..1.8,{y},0.5..1");
        let options = asked(&[("task", "rect:0.6x0.4"), ("within", &within)]);
        let placed = place(&model, &zone.into(), &options, Watch::nobody()).unwrap();
        placed.feasible().unwrap_or_else(|| panic!("{y}: {placed:?}")).clone()
    };
    let narrow = of("-2..-0.5");
    for wider in ["-3..0", "-3..3", "-2.2..-0.3"] {
        let found = of(wider);
        assert!(found.deflection < narrow.deflection * (1.0 + 1e-9), "{wider}: {}", found.deflection);
        let (least, _) = found.smallest_margin().expect("a margin");
        assert!(5_f64.to_radians() - 1e-9 < least, "{wider}: {least}");
    }
}

/// At roll 0 and angle 0 the tool's x axis lies along the first side, and that is where the joints of the answer put it, however the robot stands. Under a
/// ceiling it points back to the robot.
#[test]
fn the_first_side_points_where_the_joints_put_it() {
    let robot = robot();
    for (mount, at, within, expected) in [
        ("pedestal:1", "1.4,1.6", None, Some([1.0, 0.0, 0.0])),
        ("pedestal:1@45", "1.4,1.6", None, Some([FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0])),
        ("ceiling:3", "1.4,1.0", None, Some([-1.0, 0.0, 0.0])),
        ("wall:2", "", Some("0.9..2,-1..1,0.4..1.6"), None),
        ("pose:1,2,0.5,0,20,45", "", Some("1.5..3,2.5..4,0.5..1.5"), None),
    ] {
        let mut given = vec![("task", "rect:0.3x0.2"), ("mount", mount), ("angle", "0"), ("roll-deg", "0")];
        given.push(within.map_or(("at", at), |within| ("within", within)));
        let zone = Zone::Rectangle { width: 0.3, height: 0.2 };
        let options = request(&given).place_options(Some(zone)).unwrap();
        let (cell, elevation) = (options.cell.unwrap(), options.tool_orientation().elevation);
        let found = best(zone, &options);
        let side = Vector3::from(found.first_side(elevation, Some(&cell)).unwrap());
        let hold = found.space().unwrap();
        let tool = compliance(&robot, &hold.joints, &Pose::translation(0.0, 0.0, 0.25)).unwrap().tool;
        let x = cell.mount.cell_from_base.rotation * (tool.rotation * Vector3::x());
        // Angle and roll turn both sides and tool from the same direction about the tool axis; here by what the search added to the angle.
        let turned = x * found.angle.cos()
            - (cell.mount.cell_from_base.rotation * (tool.rotation * Vector3::y())) * found.angle.sin();
        assert!((turned - side).norm() < 1e-9, "{mount}: {turned} {side} at {}", found.angle);
        if let Some(expected) = expected {
            assert!((side - Vector3::from(expected)).norm() < 1e-9, "{mount}: {side}");
        }
    }
}

/// A force that is fixed to the base keeps the zone straight ahead, and the best place may lie at the limit of joint 1 there, too: it lay 5 % above its
/// bound, as places at that limit were dropped.
#[test]
fn under_a_force_fixed_to_the_base_the_best_place_may_lie_at_a_limit_of_joint_1() {
    let asked = request(&[("task", "circle:0.2"), ("force-n", "300,100,50"), ("force-axes", "base")]);
    let mut robot = asked.equipped(robot()).unwrap();
    let Arm::SixAxis { limits, .. } = &mut robot.arm else { panic!("six axes") };
    limits.joints[0] = Interval::spanning(25_f64.to_radians(), 120_f64.to_radians());
    let tool = Pose::new(Vector3::new(0.0, 0.5, 0.1), Vector3::y() * 40_f64.to_radians());
    let model = Model::spatial(&robot, &tool).unwrap();
    let zone = Zone::Circle { diameter: 0.2 };
    let placed = place(&model, &zone.into(), &asked.place_options(None).unwrap(), Watch::nobody()).unwrap();
    let best = placed.feasible().unwrap_or_else(|| panic!("{placed:?}"));
    assert!(best.gap() < 0.02, "{} {}", best.gap(), best.deflection);
}

/// A box about the pedestal keeps what moves out, and no longer every place.
#[test]
fn a_box_about_the_pedestal_takes_no_place_that_the_arm_keeps_out_of() {
    let tool = ("tool", "spindle:250@90");
    let free = best(CIRCLE, &asked(&[tool, ("mount", "pedestal:0.5"), ("clearance-mm", "0")]));
    let plinth = asked(&[tool, ("mount", "pedestal:0.5"), ("keep-out", "-0.5..0.5,-0.5..0.5,0..0.5")]);
    let found = best(CIRCLE, &plinth);
    assert!(
        found.space().unwrap().bearing.abs() < 1e-9
            && !found.clearance_in_space.is_some_and(|near| near.is_collision())
            && (found.deflection / free.deflection - 1.0).abs() < 2e-2,
        "{found:?} {free:?}"
    );
    assert_eq!(stiffarm::clearance::carrying(&robot(), &plinth.cell.unwrap()), [1]);
    // Up to the joint-2 axis there is no posture that keeps out, which needs no search.
    let tower = asked(&[tool, ("mount", "pedestal:0.5"), ("keep-out", "-0.5..0.5,-0.5..0.5,0..1.4")]);
    let placed = place(&model(), &CIRCLE.into(), &tower, Watch::nobody()).unwrap();
    assert!(
        matches!(placed, Placed::Infeasible { reason: Misfit::Blocked { .. }, is_proved: false, .. }),
        "{placed:?}"
    );
}

#[test]
fn the_best_place_in_a_window_is_no_worse_than_many_others_in_it_and_bounded() {
    let options = in_window(block("1.3..2.1,0.2..1.2,0.7..0.9", "m", false).unwrap());
    let found = best(CIRCLE, &options);
    let [x, y, z] = found.in_cell(&options.cell.unwrap());
    // Half a diameter from every side, up to what a window grants for rounding.
    let within = |range: std::ops::RangeInclusive<f64>, at: f64| range.start() - 1e-8 <= at && at <= range.end() + 1e-8;
    assert!(within(1.45..=1.95, x) && within(0.35..=1.05, y) && within(0.7..=0.9, z), "{x} {y} {z}");
    assert!(found.lower_bound <= found.deflection);
    let bearing = found.space().unwrap().bearing;
    assert!((bearing - y.atan2(x)).abs() < 1e-9);
    let (mut least, mut compared) = (f64::INFINITY, 0);
    for x in [1.45, 1.6, 1.95] {
        for y in [0.35, 0.7] {
            for z in [0.7, 0.9] {
                // The same place straight ahead, without a cell.
                let (ahead, height) = (f64::hypot(x, y), Interval::point(z));
                let within = Within { x: Interval::spanning(ahead - 0.15, ahead + 0.15), z: height };
                let there = PlaceOptions { within: Some(within), ..PlaceOptions::under(Load::PAPER) };
                // Some are out of reach.
                let placed = place(&model(), &CIRCLE.into(), &there, Watch::nobody()).unwrap();
                let Some(there) = placed.feasible().map(|placement| placement.deflection) else { continue };
                assert!(found.lower_bound <= there, "{x} {y} {z}");
                least = least.min(there);
                compared += 1;
            }
        }
    }
    assert!(2 <= compared, "{compared} places compared");
    assert!(found.deflection <= least * 1.001, "{} is worse than {least}", found.deflection);
}

#[test]
fn a_window_and_a_robot_that_are_turned_alike_have_the_same_answer() {
    let zone = Zone::Rectangle { width: 0.5, height: 0.3 };
    let ahead = best(zone, &asked(&[("within", "1.2..2.0,-0.4..0.4,0.8..0.9")]));
    let turned = best(zone, &asked(&[("within", "-0.4..0.4,1.2..2.0,0.8..0.9"), ("mount", "floor@90")]));
    assert!((ahead.deflection / turned.deflection - 1.0).abs() < 1e-3, "{} {}", ahead.deflection, turned.deflection);
    // Without turning the robot, joint 1 turns there.
    let aside = best(zone, &asked(&[("within", "-0.4..0.4,1.2..2.0,0.8..0.9")]));
    assert!((ahead.deflection / aside.deflection - 1.0).abs() < 1e-3, "{} {}", ahead.deflection, aside.deflection);
    assert!((aside.space().unwrap().bearing.to_degrees() - 90.0).abs() < 30.0);
}

#[test]
fn work_keeps_out_of_boxes_and_the_arm_keeps_its_distance_where_it_is_asked() {
    let window = ("within", "1.2..2.2,-0.6..0.6,0.8..0.8");
    let free = best(CIRCLE, &asked(&[window]));
    // A post where the best place is, as high as the work.
    let [x, y, _] = free.in_cell(&Cell::of(Mount::pedestal(0.0)));
    let post = format!("{}..{},{}..{},0..0.85", x - 0.05, x + 0.05, y - 0.05, y + 0.05);
    let beside = best(CIRCLE, &asked(&[window, ("keep-out", &post)]));
    let [bx, by, _] = beside.in_cell(&Cell::of(Mount::pedestal(0.0)));
    let off = Vector3::new((bx - x).abs() - 0.05, (by - y).abs() - 0.05, 0.0).map(|gap| gap.max(0.0));
    assert!(0.15 - 1e-6 <= off.norm(), "{off}");
    assert!(free.deflection <= beside.deflection * 1.001 && beside.lower_bound <= beside.deflection);
    let distance = beside.clearance_in_space.unwrap().distance;
    let asked_for = distance.max(0.0) + 0.02;
    let mm = format!("{}", asked_for * 1e3);
    let options = asked(&[window, ("keep-out", &post), ("clearance-mm", &mm)]);
    let farther = best(CIRCLE, &options);
    assert!(asked_for <= farther.clearance_in_space.unwrap().distance, "{:?}", farther.clearance_in_space);
    assert!(beside.deflection <= farther.deflection * 1.001);
    let never = place(&model(), &CIRCLE.into(), &asked(&[window, ("clearance-mm", "3000")]), Watch::nobody()).unwrap();
    assert!(matches!(never, Placed::Infeasible { is_proved: false, .. }), "{never:?}");
    let narrow =
        place(&model(), &CIRCLE.into(), &asked(&[("within", "1.2..1.4,0..1,0.8..0.9")]), Watch::nobody()).unwrap();
    assert!(
        matches!(narrow, Placed::Infeasible { reason: Misfit::WindowTooNarrow, is_proved: true, .. }),
        "{narrow:?}"
    );
    let far = place(&model(), &CIRCLE.into(), &asked(&[("within", "11..14,0..1,0.8..0.9")]), Watch::nobody()).unwrap();
    assert!(matches!(far, Placed::Infeasible { reason: Misfit::NothingReached, is_proved: true, .. }), "{far:?}");
}

/// Who names what must be kept free means the arm, too: a place at which it reaches through a post is not taken, unless that is said.
#[test]
fn a_box_that_is_kept_free_is_free_of_the_arm_too() {
    let window = ("within", "1.7..2.3,-0.3..0.3,0.8..0.8");
    let post = ("keep-out", "0.9..1.2,-2.0..2.0,..1.6");
    let free = asked(&[window, post, ("allow-contact", "true")]);
    let through = best(CIRCLE, &free);
    let touched = through.clearance_in_space.unwrap();
    assert!(
        through.clearance_in_space.is_some_and(|near| near.is_collision())
            && matches!(touched.to, Obstacle::KeepOut(1)),
        "{touched:?}"
    );
    let placed = place(&model(), &CIRCLE.into(), &asked(&[window, post]), Watch::nobody()).unwrap();
    let Placed::Infeasible { reason: Misfit::Clearance { asked: least, otherwise }, is_proved: false, .. } = placed
    else {
        panic!("{placed:?}")
    };
    assert_eq!((least, otherwise), (0.0, Some(touched)));
    // A lower post is passed, and where the best place of all keeps clear it is the answer.
    let low = ("keep-out", "0.9..1.2,-2.0..2.0,..0.4");
    let over = best(CIRCLE, &asked(&[window, low]));
    assert!(
        !over.clearance_in_space.is_some_and(|near| near.is_collision()) && through.deflection <= over.deflection,
        "{over:?}"
    );
    let far = ("keep-out", "5.0..6.0,-2.0..2.0,..0.4");
    assert_eq!(best(CIRCLE, &asked(&[window, far])), best(CIRCLE, &asked(&[window, far, ("allow-contact", "true")])));
    let refused = |given: &[(&str, &str)]| {
        let usual = [("robot", "KR 210 R2700 extra"), ("model", "spatial"), ("task", "circle:0.3")];
        let pair = |(name, text): (&str, &str)| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
        let pairs: Vec<Pair> = usual.into_iter().chain(given.iter().copied()).map(pair).collect();
        Request::read(Verb::Place, &pairs, Spelling::Typed).unwrap_err().to_string()
    };
    // It stands for nothing alone, and beside a clearance that is asked for it would say two things.
    assert!(refused(&[("allow-contact", "true")]).contains("--keep-out"));
    let both = refused(&[post, ("allow-contact", "true"), ("clearance-mm", "20")]);
    assert!(both.contains("--allow-contact") && both.contains("--clearance-mm"), "{both}");
}

#[test]
fn a_hanging_robot_does_upside_down_what_a_standing_one_does() {
    let hanging = best(CIRCLE, &asked(&[("mount", "ceiling:3"), ("within", "1..,1..1.5")]));
    let standing = best(CIRCLE, &asked(&[("tool-direction", "up"), ("within", "1..,1.5..2")]));
    assert_eq!(hanging.deflection, standing.deflection);
    let cell = asked(&[("mount", "ceiling:3")]).cell.unwrap();
    let [_, _, z] = hanging.in_cell(&cell);
    assert!((z - (3.0 - standing.centre[1])).abs() < 1e-9);
    let arm = arm_in_cell(&hanging, &cell);
    assert!(arm[4].z < arm[3].z, "the tool points down");
}

#[test]
fn a_box_without_an_end_keeps_nothing_free_that_is_meant() {
    let of = |block: &str| request(&[("keep-out", block)]).place_options(Some(CIRCLE));
    assert!(of("..,..,..").unwrap_err().to_string().contains("--keep-out keeps all the world free"));
    assert!(of("..,..,..0.4").is_ok());
}

/// x and z of a place before a wall leave y open: it was searched as if nobody had asked for one place.
#[test]
fn one_place_before_a_wall_is_named_by_all_three_ranges() {
    let of = |mount: &str| request(&[("mount", mount), ("at", "1.2,0.8")]).place_options(Some(CIRCLE));
    let why = of("wall:2").unwrap_err().to_string();
    assert!(why.contains("--at gives x and z alone") && why.contains("--within"), "{why}");
    assert!(of("pedestal:0.5@90").is_ok() && of("ceiling:3").is_ok());
}

#[test]
fn a_robot_on_a_wall_holds_its_tool_down_in_the_window() {
    let options = asked(&[("mount", "wall:2"), ("within", "0.8..2.2,-0.8..0.8,0.7..0.9")]);
    let (cell, found) = (options.cell.unwrap(), best(CIRCLE, &options));
    let [x, y, z] = found.in_cell(&cell);
    assert!((0.95..=2.05).contains(&x) && (-0.65..=0.65).contains(&y) && (0.7..=0.9).contains(&z), "{x} {y} {z}");
    let arm = arm_in_cell(&found, &cell);
    let (wrist, flange) = (arm[3], arm[4]);
    let axis = (flange - wrist).normalize();
    assert!((axis + Vector3::z()).norm() < 1e-9, "{axis}");
    let worst = cell.mount.cell_from_base * Point3::from(found.worst_point);
    assert!((flange + axis * 0.25 - worst).norm() < 1e-9, "{worst}");
    assert!((worst.z - z).abs() < 1e-9 && (worst - Point3::new(x, y, z)).norm() <= 0.15 + 1e-9);
    assert!(found.lower_bound <= found.deflection && 0.0 < found.lower_bound);
}

#[test]
fn a_job_has_its_cell_in_a_table() {
    let job = "verb = \"place\"\nrobot = \"KR 210 R2700 extra\"\ntask = \"circle:0.3\"\nmodel = \"spatial\"\n[cell]\n\
               mount = \"pedestal:0.5\"\nwithin = [\"1..2,0..1,1..1.5\", \"1..2,-1..0,1..1.5\"]\nkeep_out = [\"0..1,2..3,..\"]\nclearance_mm = 20\n";
    let file = std::path::Path::new("cell.toml");
    let job = stiffarm_ask::request::job::read(job, file).unwrap();
    let request = Request::read(job.verb, &job.pairs, Spelling::Typed).unwrap();
    let cell = request.place_options(None).unwrap().cell.unwrap();
    assert_eq!((cell.windows().count(), cell.keep_out().count(), cell.clearance), (2, 1, Some(0.02)));
    assert_eq!(cell.mount, Mount::pedestal(0.5));
    let written = stiffarm_ask::request::job::write(&request, &[], file);
    let again = stiffarm_ask::request::job::read(&written, file).unwrap();
    let again = Request::read(again.verb, &again.pairs, Spelling::Typed).unwrap();
    assert_eq!(again.place_options(None), request.place_options(None));
}

/// A circle under a vertical tool is as stiff behind the robot as before it, and a box far away changes nothing.
#[test]
fn a_window_behind_the_robot_is_searched_in_a_cell_too() {
    let options = |more: &[(&str, &str)]| {
        let given = [&[("within", "-1.7..-1.3,0.8..1.4"), ("task", "circle:0.1")], more].concat();
        asked(&given)
    };
    let zone = Zone::Circle { diameter: 0.1 };
    let [alone, in_cell] = [options(&[]), options(&[("keep-out", "5..6,5..6,5..6")])].map(|asked| best(zone, &asked));
    // To a rounding of the window's edge, at which the centre may stand.
    assert!(in_cell.centre[0] <= -1.35 + 1e-12 && -1.65 - 1e-12 <= in_cell.centre[0], "{in_cell:?}");
    // Both searches end at steps of 0.05 mm.
    assert!((in_cell.deflection / alone.deflection - 1.0).abs() < 1e-3, "{alone:?} {in_cell:?}");
    assert!(in_cell.lower_bound <= alone.deflection && alone.lower_bound <= in_cell.deflection);
    assert!(0.9 * in_cell.deflection < in_cell.lower_bound);
}

/// By forward kinematics: the axis of the tool in the axes of the cell, however the base leans.
#[test]
fn a_tool_that_points_down_points_down_from_a_base_that_leans() {
    let robot = stiffarm::prior::as_in_the_paper(&find("IRB 2400-12/1.55").unwrap().robot());
    let model = Model::spatial(&robot, &Pose::identity()).unwrap();
    let zone = Zone::Rectangle { width: 0.34, height: 0.22 };
    for (mount, within) in [
        ("pose:0.7,0.45,0.88,39,-22,-173", "0.229..1.314,-0.005..0.888,1.841..2.754"),
        ("pose:0,0,1.2,0,70,20", "0.2..1.2,-0.8..0.8,0.2..1.4"),
    ] {
        let options = asked(&[("mount", mount), ("within", within), ("task", "rect:0.34x0.22")]);
        let placed = place(&model, &zone.into(), &options, Watch::nobody()).unwrap();
        let found = placed.feasible().unwrap_or_else(|| panic!("{mount}: {placed:?}"));
        let cell = options.cell.unwrap();
        let there =
            stiffarm::compliance::compliance(&robot, &found.space().unwrap().joints, &Pose::identity()).unwrap();
        let axis = cell.mount.cell_from_base.rotation * there.tool.rotation * Vector3::z();
        assert!((axis + Vector3::z()).norm() < 1e-9, "{mount}: the tool points along {axis}");
        // The worst point lies on a level zone, too.
        let at = cell.mount.cell_from_base * Point3::from(there.tool.translation.vector);
        assert!((at.z - found.in_cell(&cell)[2]).abs() < 1e-9, "{mount}: {at}");
    }
}
