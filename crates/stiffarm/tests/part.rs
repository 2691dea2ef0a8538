//! Is a part held as it is said to be, and does any other stand, found by brute force, beat it?
//!
//! The witness sets each face up from words, and asks [`reached`] for the postures of one pose at a time.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Rotation3, Vector3};
use stiffarm::catalogue::paper_robots;
use stiffarm::cell::{Block, Cell, Mount};
use stiffarm::compliance::compliance;
use stiffarm::interval::Interval;
use stiffarm::inverse::{Configuration, reached};
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::part::{Face, Part};
use stiffarm::place::{
    Hold, Margins, Misfit, Orientation, PlaceError, PlaceOptions, Placed, Placement, ToolOrientation, Within, place,
};
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

/// A spindle that points away from the flange at a right angle.
fn spindle() -> Pose {
    Pose::new(Vector3::new(0.25, 0.0, 0.1), Vector3::y() * FRAC_PI_2)
}

fn asked(orientation: Orientation) -> PlaceOptions {
    PlaceOptions { orientation, ..PlaceOptions::under(Load::UNIT) }
}

/// A part somewhere: ahead and up, of the middle of its underside, and its turn about the vertical.
#[derive(Clone, Copy, Debug)]
struct Stand {
    x: f64,
    z: f64,
    turn: f64,
}

impl Stand {
    fn of(placement: &Placement) -> Self {
        Self { x: placement.centre[0], z: placement.centre[1], turn: placement.angle }
    }

    /// The tool at a point of a face, m from its centre along its sides: its z axis as the face says, its x axis at roll zero upwards, for a
    /// tool that hangs down along the part's x axis turned by the face's azimuth.
    fn pose(&self, face: &Face, [u, v]: [f64; 2], roll: f64) -> Pose {
        let upright = Rotation3::from_axis_angle(&Vector3::z_axis(), self.turn + face.azimuth);
        let (s, c) = face.elevation.sin_cos();
        let axis = upright * Vector3::new(c, 0.0, s);
        let first = upright * Vector3::new(-s, 0.0, c);
        let second = upright * Vector3::y();
        let part = Rotation3::from_axis_angle(&Vector3::z_axis(), self.turn);
        let centre = Vector3::new(self.x, 0.0, self.z) + part * Vector3::from(face.centre);
        let tool = Rotation3::from_basis_unchecked(&[first, axis.cross(&first), axis])
            * Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
        Pose::from_parts((centre + first * u + second * v).into(), tool.into())
    }
}

/// The largest compliance of a face in one configuration at one roll; `None` where a point of it is not reached so.
fn held(robot: &Robot, stand: &Stand, face: &Face, roll: f64, configuration: Configuration) -> Option<f64> {
    let side = |i: i32| f64::from(i) / 4.0 - 1.0;
    let mut worst = 0.0_f64;
    for at in (0..=8).flat_map(|i| (0..=8).map(move |j| face.zone.at([side(i), side(j)]))) {
        let flange = stand.pose(face, at, roll) * spindle().inverse();
        let (_, q) = reached(robot, &flange).into_iter().find(|(found, _)| *found == configuration)?;
        worst = worst.max(compliance(robot, &q, &spindle()).unwrap().compliance.worst().0);
    }
    Some(worst)
}

/// The largest compliance of a part where every face is held at the best of many rolls, unless it reaches `limit`.
fn held_below(robot: &Robot, stand: &Stand, part: &Part, limit: f64) -> Option<f64> {
    let face = |face: &Face| {
        let rolls = (0..36).map(|i| TAU * f64::from(i) / 36.0);
        // No face is stiffer than its centre.
        let below = |roll: f64| {
            let flange = stand.pose(face, [0.0; 2], roll) * spindle().inverse();
            let worst = |q: &[f64; 6]| compliance(robot, q, &spindle()).unwrap().compliance.worst().0;
            reached(robot, &flange)
                .into_iter()
                .filter(move |(_, q)| worst(q) < limit)
                .map(move |(found, _)| (roll, found))
        };
        let values = rolls.flat_map(below).filter_map(|(roll, found)| held(robot, stand, face, roll, found));
        values.min_by(f64::total_cmp).filter(|value| *value < limit)
    };
    part.faces.iter().map(face).try_fold(0.0, |worst: f64, value| Some(worst.max(value?)))
}

#[test]
fn every_face_of_a_part_is_held_as_it_is_said_and_no_other_stand_beats_it() {
    let part = Part::of_box([0.4, 0.3, 0.15]).with_faces(&["top".into(), "front".into(), "left".into()]).unwrap();
    for (seed, robot) in paper_robots().iter().enumerate().step_by(5) {
        let model = Model::spatial(robot, &spindle()).unwrap();
        let options = asked([Orientation::Axes, Orientation::Free][seed / 5 % 2]);
        let placed = place(&model, &part.clone().into(), &options, Watch::nobody()).unwrap();
        let best = placed.feasible().unwrap_or_else(|| panic!("{}: {placed:?}", robot.name));
        let case = || format!("{}: {best:#?}", robot.name);
        let stand = Stand::of(best);
        let mut worst = 0.0_f64;
        for found in &best.faces {
            let at = stand.pose(&found.face, [0.0; 2], found.hold.roll);
            assert!((at.translation.vector - Vector3::from(found.centre)).norm() < 1e-9, "{}", case());
            let value = held(robot, &stand, &found.face, found.hold.roll, found.hold.configuration);
            let value = value.unwrap_or_else(|| panic!("{} is not held: {}", found.face.name, case()));
            // The witness has fewer samples.
            assert!(value <= found.deflection * (1.0 + 1e-9) && found.deflection <= value * 1.01, "{value} {}", case());
            assert_eq!(found.hold.bearing, 0.0);
            worst = worst.max(found.deflection);
            let there = compliance(robot, &found.hold.joints, &spindle()).unwrap();
            assert!((there.tool.translation.vector - Vector3::from(found.worst_point)).norm() < 1e-9, "{}", case());
        }
        assert_eq!(worst, best.deflection, "{}", case());
        assert!(0.3 * worst < best.lower_bound && best.lower_bound <= worst, "{}", case());
        let mut rng = fastrand::Rng::with_seed(seed as u64);
        let mut compared = 0;
        for i in 0..160 {
            let mut nudge = || if i % 2 == 0 { 0.1 * (2.0 * rng.f64() - 1.0) } else { 2.0 * rng.f64() - 1.0 };
            let (x, z, turn) = (stand.x + nudge(), (stand.z + nudge()).max(0.0), nudge());
            let turn = if options.orientation == Orientation::Free { stand.turn + turn } else { stand.turn };
            let other = Stand { x, z, turn };
            let reaches = part.faces.iter().all(|face| {
                let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|at| face.zone.at(at));
                corners.iter().all(|&at| {
                    let point = other.pose(face, at, 0.0).translation.vector;
                    0.0 <= point.x && 0.0 <= point.z
                })
            });
            if reaches && let Some(value) = held_below(robot, &other, &part, 0.97 * worst) {
                panic!("{other:?} has {value}: {}", case());
            }
            compared += usize::from(reaches);
        }
        assert!(60 < compared, "{compared} stands compared");
    }
}

/// What stands alone needs no others: a part of one face that lies on the table is a flat zone.
#[test]
fn a_part_of_one_face_is_a_flat_zone() {
    let zone = Zone::Rectangle { width: 0.3, height: 0.5 };
    let face = Face { name: "top".into(), zone, centre: [0.0; 3], elevation: -FRAC_PI_2, azimuth: 0.0 };
    let part = Part { label: "one".into(), faces: vec![face] };
    for robot in paper_robots().iter().step_by(3) {
        let model = Model::spatial(robot, &spindle()).unwrap();
        let options = PlaceOptions { margins: Margins::usual(), ..asked(Orientation::Axes) };
        let (alone, flat) = (
            place(&model, &part.clone().into(), &options, Watch::nobody()).unwrap(),
            place(&model, &zone.into(), &options, Watch::nobody()).unwrap(),
        );
        let (alone, flat) = (alone.feasible().unwrap(), flat.feasible().unwrap());
        let apart = (alone.deflection - flat.deflection).abs() / flat.deflection;
        assert!(apart < 0.01, "{}: {} {}", robot.name, alone.deflection, flat.deflection);
        assert!(alone.lower_bound <= flat.deflection && flat.lower_bound <= alone.deflection, "{}", robot.name);
    }
}

/// A pedestal moves the floor and nothing else: place and deflection are those without it, the cell tells them from its floor. A wall or a box
/// beside it is another matter, which is refused.
#[test]
fn a_part_stands_before_a_robot_on_a_pedestal_as_before_one_without() {
    let part = Part::of_box([0.2, 0.2, 0.1]).with_faces(&["top".into(), "front".into()]).unwrap();
    let robot = &paper_robots()[4];
    let model = Model::spatial(robot, &spindle()).unwrap();
    let within = Within { x: Interval::new(0.8, 2.5).unwrap(), z: Interval::new(-0.2, 2.0).unwrap() };
    let margins = Margins { floor: None, ..Margins::usual() };
    let options = PlaceOptions { margins, within: Some(within), ..asked(Orientation::Axes) };
    let cell = Cell::of(Mount::pedestal(0.6).turned(0.5));
    let raised =
        place(&model, &part.clone().into(), &PlaceOptions { cell: Some(cell), ..options }, Watch::nobody()).unwrap();
    let alone = place(&model, &part.clone().into(), &options, Watch::nobody()).unwrap();
    let (raised, alone) = (raised.feasible().unwrap(), alone.feasible().unwrap());
    assert_eq!((raised.deflection, raised.centre, raised.angle), (alone.deflection, alone.centre, alone.angle));
    let [x, y, z] = raised.in_cell(&cell);
    assert!((y / x - 0.5_f64.tan()).abs() < 1e-12 && (z - 0.6 - raised.centre[1]).abs() < 1e-12, "{x} {y} {z}");
    let block = Block { x: within.x, y: Interval::spanning(0.5, 1.0), z: within.z };
    let kept_free = Cell { keep_out: std::array::from_fn(|i| (i == 0).then_some(block)), ..cell };
    for other in [Cell::of(Mount::wall(2.0)), Cell::of(Mount::ceiling(3.0)), kept_free] {
        let found =
            place(&model, &part.clone().into(), &PlaceOptions { cell: Some(other), ..options }, Watch::nobody());
        assert!(matches!(found, Err(PlaceError::PartInCell)), "{other:?}: {found:?}");
    }
}

/// Of a tool whose roll is given, and that points down, the roll counts from the part, which turns: no turn of it lies under the bound.
#[test]
fn a_roll_that_is_given_turns_with_the_part() {
    let part = Part::of_box([0.3, 0.15, 0.1]).with_faces(&["top".into()]).unwrap();
    let robot = &paper_robots()[2];
    let model = Model::spatial(robot, &spindle()).unwrap();
    for roll in [0.4, 2.0] {
        let tool_orientation = Some(ToolOrientation { roll: Some(roll), ..ToolOrientation::tool_down() });
        let placed = |orientation: Orientation| {
            place(
                &model,
                &part.clone().into(),
                &PlaceOptions { tool_orientation, ..asked(orientation) },
                Watch::nobody(),
            )
            .unwrap()
        };
        let free = placed(Orientation::Free);
        let bound = free.feasible().unwrap().lower_bound;
        let turned = (0..5).map(|i| placed(Orientation::Fixed(TAU * f64::from(i) / 5.0)));
        let found: Vec<f64> = turned.filter_map(|placed| Some(placed.feasible()?.deflection)).collect();
        assert!(1 < found.len(), "{found:?}");
        assert!(found.iter().all(|deflection| bound <= *deflection), "{bound}: {found:?}");
        // The same zone flat on the table, with the roll that this turn of the part gives the tool.
        let Placement { hold: Hold::Space(hold), centre, .. } = free.feasible().unwrap() else { panic!("in space") };
        let at = compliance(robot, &hold.joints, &spindle()).unwrap().tool;
        let x = at.rotation * Vector3::x();
        let seen = x.y.atan2(x.x);
        let turn = free.feasible().unwrap().angle;
        // Seen from above a tool that points down rolls the other way.
        let apart = (seen - (turn - roll) + PI).rem_euclid(TAU) - PI;
        assert!(apart.abs() < 1e-9, "{seen} {turn} {roll} {centre:?}");
    }
}

#[test]
fn a_force_fixed_to_the_base_proves_nothing_of_a_part() {
    let part = Part::of_box([0.3, 0.2, 0.1]).with_faces(&["top".into(), "front".into()]).unwrap();
    let model = Model::spatial(&paper_robots()[2], &spindle()).unwrap();
    let load = Load::along_base([100.0, 50.0, -20.0]).unwrap();
    let placed = place(&model, &part.clone().into(), &PlaceOptions::under(load), Watch::nobody()).unwrap();
    let best = placed.feasible().unwrap();
    assert!(best.lower_bound == 0.0 && 0.0 < best.deflection, "{best:?}");
}

#[test]
fn a_wall_that_faces_the_robot_is_a_part_of_one_side() {
    let zone = Zone::Rectangle { width: 0.2, height: 0.4 };
    let face = Face { name: "front".into(), zone, centre: [0.0, 0.0, 0.1], elevation: 0.0, azimuth: 0.0 };
    let part = Part { label: "wall".into(), faces: vec![face] };
    let robot = &paper_robots()[2];
    let model = Model::spatial(robot, &spindle()).unwrap();
    let options = asked(Orientation::Fixed(0.0));
    let part = place(&model, &part.clone().into(), &options, Watch::nobody()).unwrap();
    let wall = ToolOrientation { yaw: Interval::point(0.0), ..ToolOrientation::tool_at(0.0) };
    let flat = place(&model, &zone.into(), &PlaceOptions { tool_orientation: Some(wall), ..options }, Watch::nobody())
        .unwrap();
    let (part, flat) = (part.feasible().unwrap(), flat.feasible().unwrap());
    assert!((part.deflection - flat.deflection).abs() < 0.01 * flat.deflection, "{part:?} {flat:?}");
    // The part stands on the underside of what it is a wall of.
    assert!((part.centre[1] + 0.1 - flat.centre[1]).abs() < 0.05, "{part:?} {flat:?}");
}

/// Wider windows take no place away: down to one that is just as high as the part, and where places of a coarse grid would miss it.
#[test]
fn a_window_that_is_hardly_higher_than_the_part_has_the_place_that_lies_in_it() {
    const HIGH: f64 = 0.18;
    let robot = &paper_robots()[2];
    let model = Model::spatial(robot, &spindle()).unwrap();
    let part = Part::of_box([0.5, 0.4, HIGH]).with_faces(&["top".into(), "left".into()]).unwrap();
    let within = |low: f64, high: f64| {
        let z = Interval::spanning(low, high);
        let options = PlaceOptions {
            within: Some(Within { x: Interval::spanning(0.8, 2.2), z }),
            ..asked(Orientation::Fixed(0.0))
        };
        place(&model, &part.clone().into(), &options, Watch::nobody()).unwrap()
    };
    let high = within(0.4, 0.4 + HIGH);
    let alone = high.feasible().unwrap_or_else(|| panic!("{high:?}"));
    assert!((alone.centre[1] - 0.4).abs() < 1e-6, "{:?}", alone.centre);
    for [below, above] in [[1e-4, 0.0], [0.0, 2e-3], [4e-3, 4e-3], [0.0, 0.013], [0.01, 0.01], [0.03, 0.0]] {
        let placed = within(0.4 - below, 0.4 + HIGH + above);
        let found = placed.feasible().unwrap_or_else(|| panic!("{below} {above}: {placed:?}"));
        // The best place is found to one per cent.
        assert!(found.deflection < 1.01 * alone.deflection, "{below} {above}: {found:?}");
    }
    let low = within(0.4, 0.4 + HIGH - 1e-3);
    assert!(matches!(low, Placed::Infeasible { reason: Misfit::WindowTooNarrow, is_proved: true, .. }), "{low:?}");
}

/// Whichever is named first.
#[test]
fn the_face_that_has_no_place_is_named_and_not_one_that_others_leave_none() {
    let robot = &paper_robots()[2];
    let model = Model::spatial(robot, &spindle()).unwrap();
    let top = Part::of_box([0.3, 0.3, 0.1]).with_faces(&["top".into()]).unwrap().faces.remove(0);
    let zone = Zone::Rectangle { width: 0.2, height: 9.0 };
    let wall = Face { name: "wall".into(), zone, centre: [0.0, 0.0, 0.1], elevation: 0.0, azimuth: 0.0 };
    for faces in [[top.clone(), wall.clone()], [wall, top]] {
        let part = Part { label: "wide".into(), faces: faces.to_vec() };
        let placed = place(&model, &part.into(), &asked(Orientation::Fixed(0.0)), Watch::nobody()).unwrap();
        let Placed::Infeasible { reason, is_proved, .. } = placed else { panic!("{placed:?}") };
        assert_eq!((reason, is_proved), (Misfit::Face("wall".into()), true));
    }
}

#[test]
fn a_part_that_has_no_place_says_which_face_has_none() {
    let robot = &paper_robots()[2];
    let model = Model::spatial(robot, &spindle()).unwrap();
    let part = Part::of_box([0.3, 0.3, 0.1]).with_faces(&["top".into(), "back".into()]).unwrap();
    let far = Within { x: Interval::spanning(9.0, 12.0), z: Interval::POSITIVE };
    let placed = place(
        &model,
        &part.clone().into(),
        &PlaceOptions { within: Some(far), ..asked(Orientation::Axes) },
        Watch::nobody(),
    )
    .unwrap();
    let Placed::Infeasible { reason, is_proved, .. } = placed else { panic!("{placed:?}") };
    assert_eq!((reason, is_proved), (Misfit::Face("top".into()), true));
    let planar = Model::planar(robot).unwrap();
    assert!(matches!(
        place(&planar, &part.clone().into(), &asked(Orientation::Axes), Watch::nobody()),
        Err(PlaceError::PartInPlane)
    ));
    let none = Part { label: "none".into(), faces: Vec::new() };
    assert_eq!(
        place(&model, &none.clone().into(), &asked(Orientation::Axes), Watch::nobody()),
        Err(PlaceError::NoFace)
    );
    assert!((PI - part.faces[1].azimuth).abs() < 1e-12);
}
