//! Does every odd question end with an answer or a refusal, and say so without harm?

use stiffarm::catalogue::read;
use stiffarm::drive::Architecture::{QuasiSerial, Serial};
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::map::Axis;
use stiffarm::model::ModelError;
use stiffarm::place::{
    Orientation, PlaceError, PlaceOptions, Placed, Within, best_without_limits, largest_scale_without_limits,
};
use stiffarm::plane::{InvalidArm, PlanarArm};
use stiffarm::study::{StudyOptions, study};
use stiffarm::task::Zone;

use crate::links::{map, over, place};

fn r(a: f64, b: f64) -> Interval {
    Interval::new(a, b).unwrap()
}

fn free() -> PlanarArm {
    PlanarArm::free(1.1, 1.2, 1e-6, 1e-6, Serial)
}

fn lim() -> PlanarArm {
    PlanarArm { shoulder: r(0.0, 2.0), elbow: r(-2.5, -0.3), ..free() }
}
const RECT: Zone = Zone::Rectangle { width: 0.2, height: 0.4 };
const CIRCLE: Zone = Zone::Circle { diameter: 0.3 };

fn paper() -> PlaceOptions {
    PlaceOptions::under(Load::PAPER)
}

#[test]
fn a_strip_narrower_than_the_zone_is_answered_with_infeasible_when_the_angle_is_free() {
    let o = PlaceOptions {
        orientation: Orientation::Free,
        within: Some(Within { x: r(0.9, 1.05), z: Interval::ALL }),
        ..paper()
    };
    let placed = place(&lim(), RECT, &o);
    assert!(matches!(placed, Ok(Placed::Infeasible { .. })), "{placed:?}");
}
#[test]
fn a_within_of_zero_width_is_infeasible_when_the_angle_is_free() {
    let arm =
        PlanarArm { l2: 1.0, l3: 0.8, shoulder: r(0.2, 2.5), elbow: r(-2.4, -0.3), forearm: r(-1.8, 1.0), ..free() };
    let o = PlaceOptions {
        orientation: Orientation::Free,
        within: Some(Within { x: Interval::point(0.9), z: Interval::ALL }),
        ..paper()
    };
    let placed = place(&arm, RECT, &o);
    assert!(matches!(placed, Ok(Placed::Infeasible { .. })), "{placed:?}");
}
#[test]
fn a_shoulder_that_cannot_move_leaves_nothing() {
    let arm = PlanarArm { shoulder: Interval::point(1.0), ..free() };
    let placed = place(&arm, Zone::Circle { diameter: 1e-4 }, &paper());
    assert_eq!(placed, Err(PlaceError::Model(ModelError::Arm(InvalidArm::NothingReachable))), "a line holds no zone");
}
#[test]
fn an_elbow_range_of_very_many_turns_is_refused() {
    for turned in [1e6, 1e9, 1e300] {
        let placed = place(&PlanarArm { elbow: r(-turned, turned), ..lim() }, CIRCLE, &paper());
        assert!(
            matches!(placed, Err(PlaceError::Model(ModelError::Arm(InvalidArm::Limit { joint: "elbow", .. })))),
            "{placed:?}"
        );
    }
}
#[test]
fn an_infinite_point_is_no_range() {
    assert!(Interval::new(f64::INFINITY, f64::INFINITY).is_none());
}
#[test]
fn a_limit_of_1e47_rad_is_refused() {
    let placed = place(&PlanarArm { shoulder: r(1e47, 1e48), ..lim() }, CIRCLE, &paper());
    assert!(placed.is_err(), "{placed:?}");
}
#[test]
fn a_study_of_a_zone_without_size_is_refused() {
    for d in [f64::NAN, f64::INFINITY, 0.0, -0.5] {
        let s = study(&StudyOptions { tasks: vec![Zone::Circle { diameter: d }.into()], ..StudyOptions::paper() });
        assert!(s.is_err(), "{d}: {:?}", s.unwrap().rows[0]);
    }
}
#[test]
fn without_limits_an_arm_or_zone_without_sense_is_refused_and_a_rigid_drive_is_not() {
    for arm in
        [PlanarArm { k2: f64::NAN, ..free() }, PlanarArm { l2: f64::NAN, ..free() }, PlanarArm { k3: 2.0, ..free() }]
    {
        assert!(matches!(best_without_limits(&arm, CIRCLE), Err(PlaceError::Model(ModelError::Arm(_)))), "{arm:?}");
    }
    assert!(matches!(best_without_limits(&free(), CIRCLE.scaled(1e6)), Err(PlaceError::Side(_))));
    let rigid = PlanarArm { k2: 0.0, k3: 0.0, ..free() };
    assert_eq!(best_without_limits(&rigid, CIRCLE), Err(PlaceError::Model(ModelError::Arm(InvalidArm::Rigid))));
    // With drive 2 rigid and drive 3 in the elbow only the forearm turns: k3 l3^2 wherever the zone stands.
    let arm = PlanarArm { k2: 0.0, ..free() };
    let found = best_without_limits(&arm, CIRCLE).unwrap().unwrap();
    assert!((found - arm.k3 * arm.l3 * arm.l3).abs() <= 1e-12 * found, "{found}");
}
#[test]
fn a_map_shows_the_axis_where_an_arm_of_equal_links_folds() {
    for a in [Serial, QuasiSerial] {
        let arm = PlanarArm::free(1.0, 1.0, 1e-6, 1e-6, a);
        assert!(arm.sides().unwrap()[0].reaches([0.0, 0.0].into()));
        let x = Axis { start: -1.0, step: 0.5, count: 5 };
        let m = map(&arm, &over(x, x, Load::UNIT, None)).unwrap();
        assert!(m.get(2, 2).is_some());
    }
}
#[test]
fn a_map_shows_the_point_where_the_arm_is_stretched_on_either_side() {
    let arm = PlanarArm::free(1.0, 1.0, 1e-6, 1e-6, Serial);
    assert!(arm.sides().unwrap()[0].reaches([2.0, 0.0].into()));
    let x = Axis { start: -2.0, step: 0.5, count: 9 };
    let m = map(&arm, &over(x, x, Load::UNIT, None)).unwrap();
    assert_eq!((m.get(0, 4).is_some(), m.get(8, 4).is_some()), (true, true));
}

fn planar(line: &str) -> String {
    format!("name = \"x\"\narchitecture = \"serial\"\nstatus = \"derived\"\n[planar]\n{line}\nl3_mm = 800\n")
}
#[test]
fn a_hexadecimal_number_is_quoted_as_written() {
    let e = read(&planar("l2_mm = 0x3E8"), "f").unwrap_err().to_string();
    assert!(e.contains("0x3E8"), "{e}");
    let e = read(&planar("l2_mm = 0x1000"), "f").unwrap_err().to_string();
    assert!(!e.contains(" 1000 is not a number"), "{e}");
}
#[test]

fn limits_that_leave_nothing_are_refused_at_their_line() {
    let e = read(&planar("l2_mm = 1000\nshoulder_deg = [0, 10]\nelbow_deg = [0, 10]\nforearm_deg = [90, 100]"), "f")
        .unwrap_err();
    assert_eq!(e.faults[0].line, 4, "{e}");
}
#[test]
fn control_characters_do_not_reach_the_terminal() {
    let e = read(&planar("l2_mm = 1000\n\"\\u001b[2J\" = 1"), "f").unwrap_err().to_string();
    assert!(!e.contains('\u{1b}'), "{e:?}");
}
#[test]
fn a_line_break_in_a_key_does_not_forge_a_fault() {
    let e = read(&planar("l2_mm = 1000\n\"a\\nf:99: forged\" = 1"), "f").unwrap_err().to_string();
    assert_eq!(e.lines().count(), 1, "{e:?}");
}
#[test]
fn a_message_is_not_as_long_as_the_file() {
    let e = read(&planar(&format!("l2_mm = 1000\n{} = 1", "k".repeat(900_000))), "f").unwrap_err().to_string();
    assert!(e.len() < 10_000, "{}", e.len());
}

#[test]
fn equal_links_with_a_shoulder_limit_place_a_zone_beside_the_axis() {
    let arm = PlanarArm { shoulder: r(0.0, 100_f64.to_radians()), ..PlanarArm::free(1.0, 1.0, 1e-6, 1e-6, Serial) };
    let zone = Zone::Rectangle { width: 0.5, height: 1.0 };
    let placed = place(&arm, zone, &paper()).unwrap();
    let best = placed.feasible().unwrap();
    // A grid of 4 mm finds 1.863 mm; links of 1 m and 0.9999 m have 1.849 mm.
    assert!((best.deflection * 1e3 - 1.8495).abs() < 5e-4, "{best:?}");
    let near = PlanarArm { l3: 0.9999, ..arm };
    let neighbour = place(&near, zone, &paper()).unwrap();
    assert!((neighbour.feasible().unwrap().deflection - best.deflection).abs() < 1e-6);
}

#[test]
fn without_limits_a_zone_fits_up_to_its_largest_scale_and_no_further() {
    for zone in [RECT, CIRCLE, Zone::Rectangle { width: 1.0, height: 0.1 }] {
        let largest = largest_scale_without_limits(&free(), zone);
        assert!(
            best_without_limits(&free(), zone.scaled(largest * (1.0 - 1e-9))).unwrap().is_some(),
            "{zone:?} {largest}"
        );
        assert_eq!(best_without_limits(&free(), zone.scaled(largest * (1.0 + 1e-9))), Ok(None), "{zone:?} {largest}");
    }
}
