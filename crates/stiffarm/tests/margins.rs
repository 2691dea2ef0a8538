//! Does a margin mean what it says? Each is held against the same question asked without it, of an arm or a window that is narrower.

use std::f64::consts::PI;

use stiffarm::catalogue::paper_robots;
use stiffarm::clearance::Obstacle;
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{
    Column, Margins, Misfit, PlaceError, PlaceOptions, Placed, Placement, Within, column_radius, place,
};
use stiffarm::plane::PlanarArm;
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

use crate::links;

fn asked(margins: Margins) -> PlaceOptions {
    PlaceOptions { margins, ..PlaceOptions::under(Load::PAPER) }
}

fn random_arm(rng: &mut fastrand::Rng) -> PlanarArm {
    let mut range = |middle: f64, half: f64| {
        let (middle, half) = (middle + rng.f64() - 0.5, half * (0.5 + rng.f64()));
        Interval::spanning(middle - half, middle + half)
    };
    let (shoulder, elbow, forearm) = (range(1.2, 1.0), range(-1.3, 1.3), range(0.0, 1.5));
    let architecture = rng.choice(Architecture::ALL).unwrap();
    let (l2, l3) = (0.6 + rng.f64(), 0.6 + rng.f64());
    PlanarArm { l2, l3, k2: 1e-6, k3: 1e-6 * (0.5 + rng.f64()), architecture, shoulder, elbow, forearm }
}

fn random_zone(rng: &mut fastrand::Rng) -> Zone {
    // Some of them too large for the narrower arm.
    let (width, height) = (0.05 + 1.2 * rng.f64(), 0.05 + 1.2 * rng.f64());
    if rng.bool() { Zone::Circle { diameter: width } } else { Zone::Rectangle { width, height } }
}

/// The value and its bound; where there is no place, the reason.
fn value_or_reason(placed: &Placed) -> Result<[f64; 2], &Misfit> {
    match placed {
        Placed::Feasible(best) => Ok([best.deflection, best.lower_bound]),
        Placed::Infeasible { reason, .. } => Err(reason),
    }
}

/// Whether two answers are the same but for the gap of their proofs.
fn agree(margined: &Placed, narrowed: &Placed, case: &str) -> bool {
    match (value_or_reason(margined), value_or_reason(narrowed)) {
        (Ok([value, lower]), Ok([other, other_lower])) => {
            assert!(lower <= other * (1.0 + 1e-9) && other_lower <= value * (1.0 + 1e-9), "{case}");
            assert!((value - other).abs() <= 1e-4 * value, "{case}: {value} {other}");
            true
        }
        (Err(_), Err(_)) => false,
        (first, second) => panic!("{case}: {first:?} {second:?}"),
    }
}

#[test]
fn a_margin_from_limits_is_an_arm_with_narrower_limits() {
    let (mut placed, mut none) = (0, 0);
    for seed in 0..200 {
        let mut rng = fastrand::Rng::with_seed(seed);
        let (arm, zone, by) = (random_arm(&mut rng), random_zone(&mut rng), 0.4 * rng.f64());
        let narrower = |range: Interval| Interval::new(range.min() + by, range.max() - by);
        let narrowed = narrower(arm.shoulder).zip(narrower(arm.elbow)).zip(narrower(arm.forearm));
        let Some(((shoulder, elbow), forearm)) = narrowed else { continue };
        let narrowed = PlanarArm { shoulder, elbow, forearm, ..arm.clone() };
        let Ok(margined) = links::place(&arm, zone, &asked(Margins { limit: by, ..Margins::NONE })) else { continue };
        let case = format!("seed {seed}: {arm:?} {zone:?} {by}");
        match links::place(&narrowed, zone, &asked(Margins::NONE)) {
            Ok(other) if agree(&margined, &other, &case) => placed += 1,
            Ok(_) => none += 1,
            // Nothing is reachable within the narrower limits.
            Err(_) => assert!(margined.feasible().is_none(), "{case}"),
        }
    }
    assert!(60 <= placed && 20 <= none, "{placed} {none}");
}

#[test]
fn a_margin_from_straight_postures_is_an_elbow_that_neither_stretches_nor_folds() {
    let (mut placed, mut none) = (0, 0);
    for seed in 0..200 {
        let mut rng = fastrand::Rng::with_seed(seed);
        let (arm, zone, by) = (random_arm(&mut rng), random_zone(&mut rng), 0.1 + 0.6 * rng.f64());
        let Ok(margined) = links::place(&arm, zone, &asked(Margins { singular: by, ..Margins::NONE })) else {
            continue;
        };
        let case = format!("seed {seed}: {arm:?} {zone:?} {by}");
        // Bent one way, and the other.
        let sides = [-1.0, 1.0].map(|side| Interval::spanning(side * by, side * (PI - by)));
        let bent =
            sides.into_iter().filter_map(|side| Some(PlanarArm { elbow: arm.elbow.intersect(side)?, ..arm.clone() }));
        let answers: Vec<Placed> =
            bent.filter_map(|bent| links::place(&bent, zone, &asked(Margins::NONE)).ok()).collect();
        let value = |placed: &&Placed| value_or_reason(placed).map_or(f64::INFINITY, |[value, _]| value);
        match answers.iter().min_by(|a, b| value(a).total_cmp(&value(b))) {
            Some(best) if agree(&margined, best, &case) => placed += 1,
            _ if margined.feasible().is_none() => none += 1,
            _ => panic!("{case}: {margined:?} {answers:?}"),
        }
    }
    assert!(60 <= placed && 20 <= none, "{placed} {none}");
}

/// By hand: the KR 210 R2700 extra has a1 = 0.350 m, c2 = 1.150 m, a2 = 0.041 m, c3 = 1.200 m.
#[test]
fn the_column_is_the_one_its_formula_gives() {
    let robots = paper_robots();
    let robot = robots.iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("a robot of the paper");
    let l3 = 0.041_f64.hypot(1.2);
    assert!((column_radius(robot).unwrap() - (0.35 + 0.15 * (1.15 + l3))).abs() < 1e-12);
    // Where the file says how thick the column is: a1 and that.
    let measured = Robot { body: Some([0.25, 0.1, 0.1, 0.1].into()), ..robot.clone() };
    assert!((column_radius(&measured).unwrap() - 0.6).abs() < 1e-12);
    // Of two links alone nobody knows where the base stands.
    let links = Robot::of_links(PlanarArm::free(1.0, 1.0, 1e-6, 1e-6, Architecture::Serial));
    assert_eq!((column_radius(&links), Margins::usual().radius(&links)), (None, 0.0));
}

#[test]
fn floor_column_and_front_are_a_window() {
    let margins = Margins { column: Column::Radius(0.9), front: true, floor: Some(0.35), ..Margins::NONE };
    let (above, before) = (Interval::spanning(0.35, f64::INFINITY), Interval::spanning(0.9, f64::INFINITY));
    let behind = before.affine(-1.0, 0.0);
    let window = |x: Interval| PlaceOptions { within: Some(Within { x, z: above }), ..asked(Margins::NONE) };
    for robot in paper_robots() {
        let model = Model::planar(&robot).unwrap();
        for zone in [Zone::Circle { diameter: 0.4 }, Zone::Rectangle { width: 0.3, height: 0.6 }] {
            let case = format!("{} {zone:?}", robot.name);
            let place = |options: &PlaceOptions| place(&model, &zone.into(), options, Watch::nobody()).unwrap();
            assert!(agree(&place(&asked(margins)), &place(&window(before)), &case), "{case}: no place");
            // Either side of the column where the front is not asked for.
            let around = place(&asked(Margins { front: false, ..margins }));
            let sides = [before, behind].map(|x| place(&window(x)));
            let best = |of: fn(&Placement) -> f64| {
                sides.iter().filter_map(Placed::feasible).map(of).fold(f64::INFINITY, f64::min)
            };
            let found = around.feasible().expect("a place");
            assert!((found.deflection - best(|best| best.deflection)).abs() <= 1e-4 * found.deflection, "{case}");
            assert!(found.lower_bound <= best(|best| best.deflection), "{case}");
        }
    }
}

#[test]
fn what_a_careful_engineer_asks_is_kept_in_both_models() {
    let spindle = Pose::translation(0.0, 0.0, 0.25);
    let five = 5.0_f64.to_radians();
    for robot in paper_robots().iter().take(4) {
        let column = column_radius(robot).unwrap();
        for model in [Model::planar(robot).unwrap(), Model::spatial(robot, &spindle).unwrap()] {
            let zone = Zone::Circle { diameter: 0.3 };
            let place = |options: PlaceOptions| place(&model, &zone.into(), &options, Watch::nobody()).unwrap();
            let case = format!("{} {}", robot.name, model.kind().name());
            let careful = place(PlaceOptions::careful(Load::PAPER));
            let found = careful.feasible().unwrap_or_else(|| panic!("{case}: {careful:?}"));
            assert!(column <= found.from_axis_1.unwrap() + 1e-9, "{case}: {found:?}");
            assert!(found.outside.is_some_and(|outside| !outside.below && !outside.behind), "{case}");
            if let Some(hold) = found.space() {
                assert!(five <= hold.limit_margin.0 + 1e-9 && five <= hold.singular_margin + 1e-9, "{case}: {hold:?}");
            }
            // Nobody gains by a constraint.
            let free = place(PlaceOptions { within: Some(Within::ANYWHERE), ..PlaceOptions::under(Load::PAPER) });
            assert!(free.feasible().unwrap().lower_bound <= found.deflection, "{case}");
        }
    }
}

/// With no floor nothing is near to it; with one high up the arm is in it.
#[test]
fn the_floor_that_is_asked_for_is_the_one_that_the_arm_comes_near_to() {
    let robot = &paper_robots()[0];
    for model in [Model::planar(robot).unwrap(), Model::spatial(robot, &Pose::translation(0.0, 0.0, 0.25)).unwrap()] {
        let nearest = |floor: Option<f64>| {
            let within = Some(Within { x: Interval::spanning(1.0, 2.5), z: Interval::spanning(1.0, 1.4) });
            let options = PlaceOptions { within, ..asked(Margins { floor, ..Margins::NONE }) };
            let zone = Zone::Circle { diameter: 0.2 };
            let found = place(&model, &zone.into(), &options, Watch::nobody()).unwrap();
            found.feasible().unwrap().clearance(&model, &zone.into(), &options.margins).unwrap()
        };
        let [none, low, high] = [None, Some(-2.0), Some(0.999)].map(nearest);
        let case = model.kind().name();
        assert!(none.to != Obstacle::Floor && none.distance == low.distance, "{case}: {none:?} {low:?}");
        assert!(high.distance <= none.distance, "{case}: {high:?} {none:?}");
        assert!(high.to == Obstacle::Floor || none.distance < 0.1, "{case}: {high:?}");
    }
}

/// Where the zone lies below the shoulder the arm is lowest with the wrist centre at the bottom of the zone: over the floor that, less the radius of
/// a forearm at most (its capsule may end before the wrist), is the clearance in the arm plane.
#[test]
fn clearance_in_the_plane_is_that_of_the_lowest_wrist_centre() {
    let mut held = 0;
    for robot in paper_robots().into_iter().filter(Robot::knows_base) {
        let model = Model::planar(&robot).unwrap();
        let zone = Zone::Circle { diameter: 0.2 };
        let radius = |floor: f64| {
            let within = Some(Within { x: Interval::spanning(1.2, 2.5), z: Interval::spanning(-0.3, -0.1) });
            let margins = Margins { floor: Some(floor), ..Margins::NONE };
            let found =
                place(&model, &zone.into(), &PlaceOptions { within, ..asked(margins) }, Watch::nobody()).unwrap();
            let best = found.feasible()?;
            let clearance = best.clearance(&model, &zone.into(), &margins).unwrap();
            assert_eq!(clearance.to, Obstacle::Floor, "{}", robot.name);
            Some(best.centre[1] - 0.1 - floor - clearance.distance)
        };
        let [Some(lower), Some(higher)] = [-0.32, -0.31].map(radius) else { continue };
        held += 1;
        assert!((lower - higher).abs() < 1e-9 && (0.0..0.3).contains(&lower), "{}: {lower} {higher}", robot.name);
    }
    assert!(5 <= held, "{held} robots reach so low");
}

#[test]
fn where_margins_alone_forbid_a_place_that_is_the_reason() {
    let robot = &paper_robots()[0];
    let margins = Margins { column: Column::Radius(2.9), ..Margins::NONE };
    for model in [Model::planar(robot).unwrap(), Model::spatial(robot, &Pose::identity()).unwrap()] {
        let placed = place(&model, &Zone::Circle { diameter: 0.5 }.into(), &asked(margins), Watch::nobody()).unwrap();
        let Placed::Infeasible { reason, .. } = &placed else { panic!("{placed:?}") };
        assert_eq!(*reason, Misfit::Margins, "{}", model.kind().name());
        // Limits that would leave nothing of a range.
        let all = asked(Margins { limit: 1.5, ..Margins::NONE });
        let placed = place(&model, &Zone::Circle { diameter: 0.1 }.into(), &all, Watch::nobody()).unwrap();
        let Placed::Infeasible { reason, .. } = &placed else { panic!("{placed:?}") };
        assert_eq!(*reason, Misfit::Margins, "{}", model.kind().name());
    }
}

#[test]
fn a_margin_that_makes_no_sense_is_refused() {
    let model = Model::planar(&paper_robots()[0]).unwrap();
    let zone = Zone::Circle { diameter: 0.1 };
    for margins in [
        Margins { limit: -0.1, ..Margins::NONE },
        Margins { limit: f64::NAN, ..Margins::NONE },
        Margins { singular: 2.0, ..Margins::NONE },
        Margins { column: Column::Radius(-1.0), ..Margins::NONE },
    ] {
        assert!(
            matches!(place(&model, &zone.into(), &asked(margins), Watch::nobody()), Err(PlaceError::Margin { .. })),
            "{margins:?}"
        );
    }
    let margins = Margins { floor: Some(f64::NAN), ..Margins::NONE };
    assert!(matches!(place(&model, &zone.into(), &asked(margins), Watch::nobody()), Err(PlaceError::Floor(_))));
}
