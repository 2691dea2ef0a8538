//! Which statements hold for every arm, whatever its numbers? Scaling, symmetry, identities, bounds, monotony.

use std::f64::consts::PI;

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use stiffarm::catalogue::paper_robots;
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::load::{Component, Direction, Load};
use stiffarm::map::{Axis, Grid, MapOptions};
use stiffarm::model::ModelKind;
use stiffarm::place::{Orientation, PlaceOptions, Placed, Placement, Within};
use stiffarm::plane::{Elbow, PlanarArm};
use stiffarm::rank::rank;
use stiffarm::task::{Task, Zone};
use stiffarm::watch::Watch;

use crate::links::{map, over, place};

const FORCE: f64 = 1000.0;
/// Two answers to one question written in two ways may each lie this far, relatively, above the true optimum.
const GAP: f64 = 1e-3;
/// A sum of some ten products rounds to about 1e-15; this leaves room for cancellation by two digits more.
const ROUNDING: f64 = 1e-12;

fn fixed(cases: u32, seed: u64) -> Config {
    Config { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(seed), ..Config::default() }
}

fn limit(centre: f64) -> impl Strategy<Value = Interval> {
    let some = (-1.0..1.0, 0.2..1.8)
        .prop_map(move |(shift, half)| Interval::spanning(centre + shift - half, centre + shift + half));
    prop_oneof![2 => Just(Interval::ALL), 3 => some]
}

fn free_arms() -> impl Strategy<Value = PlanarArm> {
    let architecture = prop::sample::select(Architecture::ALL.to_vec());
    (0.4..1.6, 0.4..1.6, 0.2e-6..3e-6, 0.2e-6..3e-6, architecture)
        .prop_map(|(l2, l3, k2, k3, architecture)| PlanarArm::free(l2, l3, k2, k3, architecture))
}

fn arms() -> impl Strategy<Value = PlanarArm> {
    (free_arms(), limit(1.2), limit(-1.4), limit(-0.2))
        .prop_map(|(arm, shoulder, elbow, forearm)| PlanarArm { shoulder, elbow, forearm, ..arm })
        .prop_filter("limits that leave something", |arm| arm.sides().is_ok())
}

/// A zone in proportion to an arm of 2 m, a quarter of them circles.
fn zones() -> impl Strategy<Value = Zone> {
    prop_oneof![
        1 => (0.02..1.2).prop_map(|diameter| Zone::Circle { diameter }),
        3 => (0.02..0.6, 0.02..1.0).prop_map(|(width, height)| Zone::Rectangle { width, height }),
    ]
}

fn withins() -> impl Strategy<Value = Within> {
    let some = (-1.0..1.0, 0.5..2.0, -1.5..0.5, 0.5..2.0)
        .prop_map(|(x, dx, z, dz)| Within { x: Interval::spanning(x, x + dx), z: Interval::spanning(z, z + dz) });
    prop_oneof![2 => Just(Within::ANYWHERE), 1 => some]
}

fn asked(within: Within) -> PlaceOptions {
    let load = Load::worst(FORCE).unwrap();
    PlaceOptions { orientation: Orientation::Axes, within: Some(within), gap: Some(GAP), ..PlaceOptions::under(load) }
}

fn answer(arm: &PlanarArm, zone: Zone, within: Within) -> Option<Placement> {
    let placed = place(arm, zone, &asked(within)).unwrap();
    if let Placed::Infeasible { largest_scale, .. } = placed {
        assert!((0.0..=1.0).contains(&largest_scale.unwrap()));
    }
    placed.feasible().cloned()
}

fn scaled(range: Interval, scale: f64) -> Interval {
    range.affine(scale, 0.0)
}

/// Each value proves a bound that the other optimum keeps: two answers to one question, the second `scale` times larger.
fn assert_equivalent(a: Option<&Placement>, b: Option<&Placement>, scale: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.is_some(), b.is_some(), "{:?} {:?}", a, b);
    if let (Some(a), Some(b)) = (a, b) {
        prop_assert!(a.lower_bound * scale <= b.deflection * (1.0 + 1e-9), "{a:?} {b:?}");
        prop_assert!(b.lower_bound <= a.deflection * scale * (1.0 + 1e-9), "{a:?} {b:?}");
        let ratio = b.deflection / (a.deflection * scale);
        prop_assert!((ratio - 1.0).abs() <= 1.01 * GAP, "{a:?} {b:?}");
    }
    Ok(())
}

/// Trace and determinant of the compliance.
fn invariants(arm: &PlanarArm, shoulder: f64, elbow: f64) -> (f64, f64) {
    let c = arm.compliance(shoulder, elbow);
    (c.m11 + c.m22, c.m11 * c.m22 - c.m12 * c.m21)
}

proptest! {
    #![proptest_config(fixed(150, 11))]

    #[test]
    fn springs_that_are_c_times_softer_deflect_c_times_as_far(arm in arms(), zone in zones(), within in withins(), c in 0.1..10.0) {
        let softer = PlanarArm { k2: arm.k2 * c, k3: arm.k3 * c, ..arm.clone() };
        assert_equivalent(answer(&arm, zone, within).as_ref(), answer(&softer, zone, within).as_ref(), c)?;
    }

    #[test]
    fn an_arm_and_a_zone_s_times_as_long_deflect_s_squared_times_as_far(arm in arms(), zone in zones(), within in withins(), s in 0.2..5.0) {
        let longer = PlanarArm { l2: arm.l2 * s, l3: arm.l3 * s, ..arm.clone() };
        let apart = Within { x: scaled(within.x, s), z: scaled(within.z, s) };
        assert_equivalent(answer(&arm, zone, within).as_ref(), answer(&longer, zone.scaled(s), apart).as_ref(), s * s)?;
    }

    // Seen from behind, every angle a becomes pi - a: shoulder and forearm are absolute, the elbow is a difference.
    #[test]
    fn the_mirrored_arm_has_the_same_value_at_the_mirrored_place(arm in arms(), zone in zones(), within in withins()) {
        let mirrored = PlanarArm {
            shoulder: arm.shoulder.affine(-1.0, PI),
            elbow: arm.elbow.affine(-1.0, 0.0),
            forearm: arm.forearm.affine(-1.0, PI),
            ..arm.clone()
        };
        let behind = Within { x: within.x.affine(-1.0, 0.0), z: within.z };
        let (found, found_behind) = (answer(&arm, zone, within), answer(&mirrored, zone, behind));
        assert_equivalent(found.as_ref(), found_behind.as_ref(), 1.0)?;
        // The place itself need not be unique, but a zone that may stand only at the mirror image of the answer does.
        if let Some(found) = found {
            let (x, z) = (-found.centre[0], found.centre[1]);
            let (width, height) = match zone {
                Zone::Circle { diameter } => (diameter, diameter),
                Zone::Rectangle { width, height } if found.angle == 0.0 => (width, height),
                Zone::Rectangle { width, height } => (height, width),
            };
            // A play of 1e-6 m moves the deflection by about as much relatively: far less than the gap.
            let around = |centre: f64, side: f64| Interval::spanning(centre - side / 2.0 - 1e-6, centre + side / 2.0 + 1e-6);
            let there = Within { x: around(x, width), z: around(z, height) };
            let again = answer(&mirrored, zone, there);
            prop_assert!(again.is_some(), "{found:?}");
            prop_assert!((again.unwrap().deflection / found.deflection - 1.0).abs() <= 1.1 * GAP, "{found:?}");
        }
    }

    #[test]
    fn a_tighter_limit_never_lowers_the_deflection(
        arm in arms(), zone in zones(), which in 0..3_usize, cut in prop::array::uniform2(0.0..0.3),
    ) {
        let tighter = |range: Interval, usual: Interval| {
            let from = if range.is_all() { usual } else { range };
            Interval::spanning(from.min() + cut[0] * from.width(), from.max() - cut[1] * from.width())
        };
        let mut tight = arm.clone();
        match which {
            0 => tight.shoulder = tighter(arm.shoulder, Interval::spanning(-0.5, 2.5)),
            1 => tight.elbow = tighter(arm.elbow, Interval::spanning(-PI, PI)),
            _ => tight.forearm = tighter(arm.forearm, Interval::spanning(-2.0, 1.5)),
        }
        if tight.sides().is_ok() {
            let (wide, narrow) = (answer(&arm, zone, Within::ANYWHERE), answer(&tight, zone, Within::ANYWHERE));
            prop_assert!(wide.is_some() || narrow.is_none(), "{narrow:?}");
            if let (Some(wide), Some(narrow)) = (wide, narrow) {
                prop_assert!(wide.lower_bound <= narrow.deflection * (1.0 + 1e-9), "{wide:?} {narrow:?}");
            }
        }
    }

    #[test]
    fn a_larger_zone_never_deflects_less(arm in arms(), zone in zones(), grown in 1.0..1.6) {
        let (small, large) = (answer(&arm, zone, Within::ANYWHERE), answer(&arm, zone.scaled(grown), Within::ANYWHERE));
        prop_assert!(small.is_some() || large.is_none(), "{large:?}");
        if let (Some(small), Some(large)) = (small, large) {
            prop_assert!(small.lower_bound <= large.deflection * (1.0 + 1e-9), "{small:?} {large:?}");
        }
    }

    #[test]
    fn a_place_within_bounds_is_never_better_than_one_anywhere_and_keeps_the_bounds(
        arm in arms(), zone in zones(), x in -1.0..1.0, dx in 0.3..2.0, z in -1.5..0.5, dz in 0.3..2.0,
    ) {
        let within = Within { x: Interval::spanning(x, x + dx), z: Interval::spanning(z, z + dz) };
        let (anywhere, there) = (answer(&arm, zone, Within::ANYWHERE), answer(&arm, zone, within));
        prop_assert!(anywhere.is_some() || there.is_none(), "{there:?}");
        if let (Some(anywhere), Some(there)) = (anywhere, there) {
            prop_assert!(anywhere.lower_bound <= there.deflection * (1.0 + 1e-9), "{anywhere:?} {there:?}");
            let (across, up) = match zone {
                Zone::Circle { diameter } => (diameter, diameter),
                Zone::Rectangle { width, height } if there.angle == 0.0 => (width, height),
                Zone::Rectangle { width, height } => (height, width),
            };
            for (range, centre, side) in [(within.x, there.centre[0], across), (within.z, there.centre[1], up)] {
                // The library grants 1e-9 of the upper arm.
                prop_assert!(range.contains(centre - side / 2.0, 1e-8) && range.contains(centre + side / 2.0, 1e-8), "{there:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(fixed(2000, 12))]

    #[test]
    fn both_architectures_have_the_same_determinant_and_traces_k2_times_r2_minus_l2_squared_apart(
        arm in free_arms(), shoulder in -PI..PI, elbow in -PI..PI,
    ) {
        let [serial, quasi] = Architecture::ALL.map(|architecture| PlanarArm { architecture, ..arm.clone() });
        let [(trace_s, det_s), (trace_q, det_q)] = [&serial, &quasi].map(|arm| invariants(arm, shoulder, elbow));
        // The determinant is a difference of products of the size of the squared trace.
        let scale = trace_s.max(trace_q);
        prop_assert!((det_s - det_q).abs() <= ROUNDING * scale * scale, "{det_s:e} {det_q:e}");
        let sine = elbow.sin();
        let by_hand = arm.k2 * arm.k3 * (arm.l2 * arm.l3 * sine).powi(2);
        prop_assert!((det_s - by_hand).abs() <= ROUNDING * scale * scale, "{det_s:e} {by_hand:e}");
        // The law of cosines, so that no forward kinematics of the library enters.
        let r2 = arm.l2.powi(2) + arm.l3.powi(2) + 2.0 * arm.l2 * arm.l3 * elbow.cos();
        let apart = arm.k2 * (r2 - arm.l2.powi(2));
        prop_assert!((trace_s - trace_q - apart).abs() <= ROUNDING * scale, "{trace_s:e} {trace_q:e} {apart:e}");
        let by_hand = arm.k2 * arm.l2.powi(2) + arm.k3 * arm.l3.powi(2);
        prop_assert!((trace_q - by_hand).abs() <= ROUNDING * scale, "{trace_q:e} {by_hand:e}");
    }

    #[test]
    fn where_the_wrist_is_as_far_as_the_elbow_both_architectures_are_equal(mut arm in free_arms(), k2 in 0.2e-6..3e-6) {
        // r = l2 is within reach where l3 <= 2 l2; it is where both circles of radius l2 meet: cos q3 = -l3/(2 l2).
        arm.k2 = k2;
        prop_assume!(arm.l3 < 2.0 * arm.l2);
        let elbow = (-arm.l3 / (2.0 * arm.l2)).acos();
        let [serial, quasi] = Architecture::ALL.map(|architecture| PlanarArm { architecture, ..arm.clone() });
        let [a, b] = [&serial, &quasi].map(|arm| arm.radial().at(arm.l2));
        prop_assert!((a - b).abs() <= ROUNDING * a, "{a:e} {b:e}");
        let [a, b] = [&serial, &quasi].map(|arm| arm.worst_direction(0.3, elbow).0);
        // Near a double eigenvalue the root of a rounded discriminant keeps half the digits.
        prop_assert!((a - b).abs() <= 1e-7 * a, "{a:e} {b:e}");
        let r = arm.forward(0.3, elbow).norm();
        prop_assert!((r - arm.l2).abs() <= ROUNDING, "{r}");
    }

    #[test]
    fn the_worst_compliance_keeps_the_bounds_of_the_theory(arm in free_arms(), place in 0.0..=1.0, right in -1.0..1.0) {
        let (two, three) = (arm.k2 * arm.l2.powi(2), arm.k3 * arm.l3.powi(2));
        let r = (arm.l2 - arm.l3).abs() + place * (arm.l2 + arm.l3 - (arm.l2 - arm.l3).abs());
        let serial = PlanarArm { architecture: Architecture::Serial, ..arm.clone() }.radial().at(r);
        prop_assert!(three * (1.0 - ROUNDING) <= serial, "{serial:e} {three:e}");
        let quasi_arm = PlanarArm { architecture: Architecture::QuasiSerial, ..arm };
        let quasi = quasi_arm.radial().at(r);
        prop_assert!(two.max(three) * (1.0 - ROUNDING) <= quasi && quasi <= (two + three) * (1.0 + ROUNDING), "{quasi:e}");
        // Both bounds are attained: at a right angle, and stretched.
        let at_right_angle = quasi_arm.worst_direction(right, right.signum() * PI / 2.0).0;
        prop_assert!((at_right_angle - two.max(three)).abs() <= ROUNDING * at_right_angle, "{at_right_angle:e}");
        let stretched = quasi_arm.worst_direction(right, 0.0).0;
        prop_assert!((stretched - two - three).abs() <= ROUNDING * stretched, "{stretched:e}");
    }

    #[test]
    fn the_compliance_is_symmetric_and_never_gives_energy_away(
        arm in free_arms(), shoulder in -7.0..7.0, elbow in -7.0..7.0, direction in 0.0..PI,
    ) {
        let c = arm.compliance(shoulder, elbow);
        let scale = c.m11 + c.m22;
        prop_assert!((c.m12 - c.m21).abs() <= ROUNDING * scale, "{c}");
        let (s, k) = direction.sin_cos();
        let energy = k * k * c.m11 + k * s * (c.m12 + c.m21) + s * s * c.m22;
        prop_assert!(-ROUNDING * scale <= energy, "{energy:e}");
        let (worst, n) = arm.worst_direction(shoulder, elbow);
        prop_assert!(energy <= worst * (1.0 + ROUNDING), "{energy:e} {worst:e}");
        prop_assert!((n.norm() - 1.0).abs() <= ROUNDING && (c * n - n * worst).norm() <= 1e-9 * worst, "{n}");
    }

    // A unit torque on drive i turns that drive by k_i; the motion this gives the tool, and the torque a force at the
    // tool gives the drive (virtual work), are both differences of forward(): C = sum of k_i g_i g_i^T.
    #[test]
    fn the_compliance_is_what_finite_differences_of_the_kinematics_give(arm in free_arms(), shoulder in -PI..PI, elbow in -PI..PI) {
        let step = 1e-5;
        let moved = |drive_2: f64, drive_3: f64| match arm.architecture {
            Architecture::Serial => arm.forward(shoulder + drive_2, elbow + drive_3),
            // Drive 3 holds the forearm against the ground: turning drive 2 alone leaves its attitude.
            Architecture::QuasiSerial => arm.forward(shoulder + drive_2, elbow - drive_2 + drive_3),
        };
        let g2 = (moved(step, 0.0) - moved(-step, 0.0)) / (2.0 * step);
        let g3 = (moved(0.0, step) - moved(0.0, -step)) / (2.0 * step);
        let by_differences = arm.k2 * g2 * g2.transpose() + arm.k3 * g3 * g3.transpose();
        let c = arm.compliance(shoulder, elbow);
        // Central differences: step^2/6 = 2e-11 of truncation, and 2e-16/1e-5 = 2e-11 of rounding.
        prop_assert!((by_differences - c).norm() <= 1e-9 * (c.m11 + c.m22), "{by_differences} {c}");
    }
}

proptest! {
    #![proptest_config(fixed(6, 13))]

    #[test]
    fn the_order_of_the_robots_does_not_change_the_ranking(order in Just((0..10).collect::<Vec<usize>>()).prop_shuffle()) {
        let robots = paper_robots();
        // Two of one kind, so that a tie is among them; the names decide.
        let mut twin = robots[4].clone();
        twin.name = "twin".into();
        let shuffled: Vec<_> = std::iter::once(twin.clone()).chain(order.iter().map(|&i| robots[i].clone())).collect();
        let given: Vec<_> = robots.into_iter().chain([twin]).collect();
        let tasks: Vec<Task> = ["A:0.1", "B:0.5", "C:0.15"].map(|text| text.parse().unwrap()).to_vec();
        let rows = |robots: &[_]| -> Vec<(String, Option<f64>, Vec<Option<f64>>)> {
            let ranking = rank(robots, &tasks, &ModelKind::Planar, &asked(Within::ANYWHERE), Watch::nobody()).unwrap();
            let cells = |row: &stiffarm::rank::Row| (0..tasks.len()).map(|task| row.deflection(task)).collect();
            ranking.rows.iter().map(|row| (row.robot.name.clone(), row.mean_ratio, cells(row))).collect()
        };
        let (a, b) = (rows(&given), rows(&shuffled));
        prop_assert_eq!(&a, &b);
        let place_of = |name: &str| a.iter().position(|row| row.0 == name).unwrap();
        prop_assert_eq!(place_of("KR 210 R2700 extra") + 1, place_of("twin"));
    }
}

/// Law of cosines, every combination of whole turns, largest eigenvalue from joint coordinates (or one force after the other).
/// `sign` is that of the elbow angle; `margin` tightens limits and reach.
fn witness(arm: &PlanarArm, p: [f64; 2], load: Load, elbows: &[f64], margin: f64) -> Option<f64> {
    let r2 = p[0] * p[0] + p[1] * p[1];
    let cosine = (r2 - arm.l2.powi(2) - arm.l3.powi(2)) / (2.0 * arm.l2 * arm.l3);
    if 1.0 - margin < cosine.abs() {
        return None;
    }
    let at_shoulder = ((r2 + arm.l2.powi(2) - arm.l3.powi(2)) / (2.0 * r2.sqrt() * arm.l2)).acos();
    let mut least: Option<f64> = None;
    for &sign in elbows {
        let (shoulder, elbow) = (p[1].atan2(p[0]) - sign * at_shoulder, sign * cosine.acos());
        // The forearm's whole turn is that of shoulder and elbow together.
        let turn = |n: i32| 2.0 * PI * f64::from(n);
        let turns = || -4..=4_i32;
        let allowed = turns().filter(|&i| arm.shoulder.contains(shoulder + turn(i), -margin)).any(|i| {
            turns()
                .filter(|&j| arm.elbow.contains(elbow + turn(j), -margin))
                .any(|j| arm.forearm.contains(shoulder + elbow + turn(i + j), -margin))
        });
        if !allowed {
            continue;
        }
        let forearm = shoulder + elbow;
        let outer = [-arm.l3 * forearm.sin(), arm.l3 * forearm.cos()];
        let both = [outer[0] - arm.l2 * shoulder.sin(), outer[1] + arm.l2 * shoulder.cos()];
        // Serial: turning joint 2 carries both links. Parallelogram: drive 2 carries the upper arm alone.
        let first = match arm.architecture {
            Architecture::Serial => both,
            Architecture::QuasiSerial => [both[0] - outer[0], both[1] - outer[1]],
        };
        let c = |i: usize, j: usize| arm.k2 * first[i] * first[j] + arm.k3 * outer[i] * outer[j];
        let under = |angle: f64| {
            let (s, k) = angle.sin_cos();
            let moved = [c(0, 0) * k + c(0, 1) * s, c(0, 1) * k + c(1, 1) * s];
            match load.component() {
                Component::Along => moved[0] * k + moved[1] * s,
                _ => moved[0].hypot(moved[1]),
            }
        };
        let value = match load.direction() {
            Direction::InPlane(angle) if load.cone() == 0.0 => under(angle),
            Direction::InPlane(angle) => {
                let aside = |i: i32| angle + load.cone() * f64::from(i) / 1000.0;
                (-1000..=1000).map(|i| under(aside(i))).fold(0.0, f64::max)
            }
            _ => f64::midpoint(c(0, 0), c(1, 1)) + ((c(0, 0) - c(1, 1)) / 2.0).hypot(c(0, 1)),
        };
        least = Some(least.map_or(value, |least| least.min(value)));
    }
    least
}

const COLUMNS: usize = 41;
const ROWS: usize = 37;

fn asked_map(arm: &PlanarArm, load: Load, elbow: Option<Elbow>) -> MapOptions {
    let reach = 1.05 * (arm.l2 + arm.l3);
    // No cell on an axis of symmetry, where many limits meet a grid line exactly.
    let x = Axis::between(-reach, 0.98 * reach, COLUMNS);
    over(x, Axis::between(-0.97 * reach, reach, ROWS), load, elbow)
}

fn cells(map: &Grid) -> impl Iterator<Item = ([f64; 2], Option<f64>)> {
    (0..ROWS).flat_map(move |j| (0..COLUMNS).map(move |i| ([map.x.at(i), map.z.at(j)], map.get(i, j))))
}

fn worst() -> Load {
    Load::worst(FORCE).unwrap()
}

fn in_plane(angle: f64, component: Component) -> Load {
    Load::in_plane(FORCE, angle, component).unwrap()
}

fn loads() -> impl Strategy<Value = Load> {
    let given = (-4.0..4.0, prop::bool::ANY, prop_oneof![Just(0.0), 0.0..1.57]).prop_map(|(angle, along, cone)| {
        in_plane(angle, if along { Component::Along } else { Component::Total }).with_cone(cone).unwrap()
    });
    prop_oneof![Just(worst()), given]
}

proptest! {
    #![proptest_config(fixed(400, 14))]

    #[test]
    fn every_cell_of_a_map_is_what_the_witness_finds(arm in arms(), load in loads(), which in 0..3_usize) {
        let (elbow, signs): (_, &[f64]) =
            [(None, &[-1.0, 1.0][..]), (Some(Elbow::Up), &[-1.0][..]), (Some(Elbow::Down), &[1.0][..])][which];
        let Ok(found) = map(&arm, &asked_map(&arm, load, elbow)) else {
            // Refused: then no cell is reached with that elbow.
            prop_assert!(elbow.is_some());
            let reach = arm.l2 + arm.l3;
            let reached = (0..COLUMNS * ROWS)
                .map(|i| [(i % COLUMNS) as f64 / 20.0 - 1.0, (i / COLUMNS) as f64 / 18.0 - 1.0].map(|x| x * reach))
                .any(|p| witness(&arm, p, load, signs, 1e-6).is_some());
            prop_assert!(!reached, "{arm:?}");
            return Ok(());
        };
        for (p, value) in cells(&found) {
            let [strict, lax] = [1e-6, -1e-6].map(|margin| witness(&arm, p, load, signs, margin));
            // Within 1e-6 of a limit (or of the rim) rounding may decide either way.
            if strict != lax {
                continue;
            }
            prop_assert_eq!(value.is_some(), strict.is_some(), "{:?} at {:?}", arm, p);
            if let (Some(value), Some(strict)) = (value, strict) {
                // Near a double eigenvalue, or where the law of cosines is flat (1e-6 from the rim), half the digits; in a cone
                // the witness steps by 1.6e-3 rad and meets the worst to the square of that.
                let known = if load.cone() == 0.0 { 1e-7 } else { 4e-6 };
                prop_assert!((value - strict * FORCE).abs() <= known * value, "{arm:?} at {p:?}: {value:e} {strict:e}");
            }
        }
    }
}

proptest! {
    #![proptest_config(fixed(12, 15))]

    #[test]
    fn no_direction_deflects_more_than_the_worst_and_one_of_360_comes_within_a_thousandth(arm in arms(), elbow in prop::bool::ANY) {
        // With one elbow side, because the stiffer side may differ from direction to direction.
        let elbow = if elbow { Elbow::Up } else { Elbow::Down };
        let Ok(worst) = map(&arm, &asked_map(&arm, worst(), Some(elbow))) else { return Ok(()) };
        for component in [Component::Total, Component::Along] {
            let mut most = vec![0.0_f64; COLUMNS * ROWS];
            for degree in 0..360 {
                let angle = f64::from(degree).to_radians();
                let directed = map(&arm, &asked_map(&arm, in_plane(angle, component), Some(elbow))).unwrap();
                for (i, ((p, bound), (_, value))) in cells(&worst).zip(cells(&directed)).enumerate() {
                    prop_assert_eq!(bound.is_some(), value.is_some(), "{:?}", p);
                    if let (Some(bound), Some(value)) = (bound, value) {
                        // At the rim both come from roots that lose half their digits.
                        prop_assert!(value <= bound * (1.0 + 1e-7), "{p:?}: {value:e} {bound:e}");
                        most[i] = most[i].max(value);
                    }
                }
            }
            for (most, (p, bound)) in most.into_iter().zip(cells(&worst)) {
                // At most half a degree off the worst direction: 1 - cos^2(0.5 deg) = 8e-5.
                prop_assert!(bound.is_none_or(|bound| bound * (1.0 - 1e-3) <= most), "{p:?}: {most:e} {bound:?}");
            }
        }
    }
}

#[test]
fn the_random_arms_exercise_every_limit_and_both_answers() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::new(fixed(1, 16));
    let (mut fits, mut misfits, mut limited) = (0, 0, [0; 3]);
    for _ in 0..150 {
        let (arm, zone) = (arms(), zones()).new_tree(&mut runner).unwrap().current();
        for (count, range) in limited.iter_mut().zip([arm.shoulder, arm.elbow, arm.forearm]) {
            *count += usize::from(!range.is_all());
        }
        if answer(&arm, zone, Within::ANYWHERE).is_some() { fits += 1 } else { misfits += 1 }
    }
    assert!(40 < fits && 10 < misfits && limited.iter().all(|&count| 50 < count), "{fits} {misfits} {limited:?}");
}
