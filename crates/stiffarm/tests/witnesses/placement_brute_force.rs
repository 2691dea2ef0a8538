//! Does any placement, found by brute force with kinematics written anew, beat the answer or its certificate?
//!
//! The witness shares no formula with the library: it solves the triangle by the law of cosines at sampled points of the
//! zone, follows the bearing around the zone, tries every combination of whole turns against the limits, and takes the
//! largest eigenvalue of a compliance that it sets up in joint coordinates.

use std::f64::consts::{FRAC_PI_2, PI};

use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::load::{Component, Direction, Load};
use stiffarm::place::{Orientation, PlaceOptions, Placed, Within};
use stiffarm::plane::{InvalidArm, PlanarArm};
use stiffarm::task::Zone;

use crate::cases;
use crate::links::place;

const FORCE: f64 = 1000.0;
/// Points along each edge, or a quarter of a circle.
const SAMPLES: usize = 24;
/// A zone grown by twice the spacing of the samples: where all samples pass, the zone itself fits.
const GROWN: f64 = 1.0 + PI / SAMPLES as f64;

#[derive(Clone, Copy, Debug)]
struct Trial {
    centre: [f64; 2],
    angle: f64,
}

/// The outline of a zone, in order, and the points nearest to and farthest from the axis.
fn outline(zone: Zone, trial: Trial, grown: f64) -> Vec<[f64; 2]> {
    let (s, c) = trial.angle.sin_cos();
    let place = |x: f64, z: f64| [trial.centre[0] + c * x - s * z, trial.centre[1] + s * x + c * z];
    let mut points = Vec::new();
    match zone {
        Zone::Circle { diameter } => {
            let radius = grown * diameter / 2.0;
            let away = trial.centre[1].atan2(trial.centre[0]);
            for i in 0..4 * SAMPLES {
                let angle = away + 2.0 * PI * i as f64 / (4 * SAMPLES) as f64;
                points.push([trial.centre[0] + radius * angle.cos(), trial.centre[1] + radius * angle.sin()]);
            }
        }
        Zone::Rectangle { width, height } => {
            let (a, b) = (grown * width / 2.0, grown * height / 2.0);
            let corners = [(a, b), (-a, b), (-a, -b), (a, -b), (a, b)];
            let axis = [-(c * trial.centre[0] + s * trial.centre[1]), -(-s * trial.centre[0] + c * trial.centre[1])];
            for pair in corners.windows(2) {
                let ((x0, z0), (x1, z1)) = (pair[0], pair[1]);
                let length = (x1 - x0).hypot(z1 - z0);
                let foot = ((axis[0] - x0) * (x1 - x0) + (axis[1] - z0) * (z1 - z0)) / (length * length);
                let mut steps: Vec<f64> = (0..SAMPLES).map(|i| i as f64 / SAMPLES as f64).collect();
                steps.push(foot.clamp(0.0, 1.0));
                steps.sort_by(f64::total_cmp);
                points.extend(steps.into_iter().map(|t| place(x0 + t * (x1 - x0), z0 + t * (z1 - z0))));
            }
        }
    }
    points
}

/// The compliance at a posture, from joint coordinates: ahead, up, and mixed.
fn compliance(arm: &PlanarArm, shoulder: f64, elbow: f64) -> [f64; 3] {
    let forearm = shoulder + elbow;
    // d p / d shoulder, d p / d elbow
    let jx = [-arm.l2 * shoulder.sin() - arm.l3 * forearm.sin(), -arm.l3 * forearm.sin()];
    let jz = [arm.l2 * shoulder.cos() + arm.l3 * forearm.cos(), arm.l3 * forearm.cos()];
    // A k A^T, written out
    let k = match arm.architecture {
        Architecture::Serial => [[arm.k2, 0.0], [0.0, arm.k3]],
        Architecture::QuasiSerial => [[arm.k2, -arm.k2], [-arm.k2, arm.k2 + arm.k3]],
    };
    let form =
        |a: [f64; 2], b: [f64; 2]| (0..2).map(|i| (0..2).map(|j| a[i] * k[i][j] * b[j]).sum::<f64>()).sum::<f64>();
    [form(jx, jx), form(jz, jz), form(jx, jz)]
}

/// Its largest eigenvalue.
fn worst(arm: &PlanarArm, shoulder: f64, elbow: f64) -> f64 {
    let [xx, zz, xz] = compliance(arm, shoulder, elbow);
    f64::midpoint(xx, zz) + ((xx - zz) / 2.0).hypot(xz)
}

/// The largest compliance over the outline, where some elbow side and some whole turns keep every point in the limits.
fn brute(arm: &PlanarArm, points: &[[f64; 2]], slack: f64) -> Option<f64> {
    let held = held(arm, points, slack).into_iter().next()?;
    Some(held.into_iter().map(|(shoulder, elbow)| worst(arm, shoulder, elbow)).fold(0.0, f64::max))
}

/// Shoulder and elbow angle at every point of the outline, on each elbow side that reaches all of it within the limits.
fn held(arm: &PlanarArm, points: &[[f64; 2]], slack: f64) -> Vec<Vec<(f64, f64)>> {
    let mut found = Vec::new();
    let free_turns = |range: Interval| if range.is_all() { 0..=0 } else { -3_i32..=3 };
    for side in [-1.0, 1.0] {
        let mut postures = Vec::new();
        let mut bearing = points[0][1].atan2(points[0][0]);
        for p in points {
            let r = p[0].hypot(p[1]);
            let c = (r * r - arm.l2.powi(2) - arm.l3.powi(2)) / (2.0 * arm.l2 * arm.l3);
            if 1.0 + slack < c.abs() || r < 1e-9 {
                postures.clear();
                break;
            }
            let here = p[1].atan2(p[0]);
            bearing += (here - bearing + PI).rem_euclid(2.0 * PI) - PI;
            let inner = ((r * r + arm.l2.powi(2) - arm.l3.powi(2)) / (2.0 * r * arm.l2)).clamp(-1.0, 1.0).acos();
            postures.push((bearing - side * inner, side * c.clamp(-1.0, 1.0).acos()));
        }
        // The outline must come back to its first bearing: else the axis is inside.
        if postures.is_empty()
            || 1e-6 < (bearing - points[0][1].atan2(points[0][0])).abs() && {
                let first = points[0][1].atan2(points[0][0]);
                let last = points[points.len() - 1];
                let closing = (first - last[1].atan2(last[0]) + PI).rem_euclid(2.0 * PI) - PI;
                1e-6 < (bearing + closing - first).abs()
            }
        {
            continue;
        }
        let turn = |n: i32| 2.0 * PI * f64::from(n);
        let turns = |range: Interval| {
            if arm.forearm.is_all() { free_turns(range) } else { -3..=3 }
        };
        let fits = |(i, j): (i32, i32)| {
            postures.iter().all(|&(shoulder, elbow)| {
                arm.shoulder.contains(shoulder + turn(i), slack)
                    && arm.elbow.contains(elbow + turn(j), slack)
                    && arm.forearm.contains(shoulder + elbow + turn(i + j), slack)
            })
        };
        if turns(arm.shoulder).any(|i| turns(arm.elbow).any(|j| fits((i, j)))) {
            found.push(postures);
        }
    }
    found
}

fn random_range(rng: &mut fastrand::Rng, probability: f64, centre: f64, spread: f64) -> Interval {
    if probability < rng.f64() {
        return Interval::ALL;
    }
    let centre = centre + spread * (rng.f64() - 0.5);
    let half = 0.15 + 1.6 * rng.f64();
    Interval::new(centre - half, centre + half).unwrap()
}

fn random_arm(rng: &mut fastrand::Rng) -> PlanarArm {
    let l2 = 0.5 + rng.f64();
    PlanarArm {
        l2,
        // Equal links fold onto the axis, where a bearing means nothing: the hardest case, and a common one.
        l3: if rng.u8(0..5) == 0 { l2 } else { 0.5 + rng.f64() },
        k2: 1e-6 * (0.3 + 2.0 * rng.f64()),
        k3: if rng.bool() { 1e-6 } else { 1e-6 * (0.3 + 2.0 * rng.f64()) },
        architecture: rng.choice(Architecture::ALL).unwrap(),
        shoulder: random_range(rng, 0.6, 1.2, 2.0),
        elbow: random_range(rng, 0.5, -1.2, 3.0),
        forearm: random_range(rng, 0.4, 0.0, 2.0),
    }
}

fn random_zone(rng: &mut fastrand::Rng, reach: f64) -> Zone {
    let size = reach * 0.4 * rng.f64().powi(2) + 0.01;
    match rng.u8(0..4) {
        0 => Zone::Circle { diameter: 2.0 * size },
        1 => Zone::Rectangle { width: size, height: 2.0 * size },
        2 => Zone::Rectangle { width: size / 2.0, height: 5.0 * size / 2.0 },
        _ => Zone::Rectangle { width: size, height: size * (0.3 + rng.f64()) },
    }
}

fn options(rng: &mut fastrand::Rng, reach: f64, gap: f64) -> PlaceOptions {
    let orientation = match rng.u8(0..6) {
        0 => Orientation::Free,
        1 => Orientation::Fixed(PI * rng.f64()),
        _ => Orientation::Axes,
    };
    let mut within = Within::ANYWHERE;
    if rng.u8(0..4) == 0 {
        let low = -reach * rng.f64();
        within.x = Interval::new(reach * (rng.f64() - 0.4), reach * 2.0).unwrap();
        within.z = Interval::new(low, low + reach * (0.4 + rng.f64())).unwrap();
    }
    let load = Load::worst(FORCE).unwrap();
    PlaceOptions { orientation, within: Some(within), gap: Some(gap), ..PlaceOptions::under(load) }
}

/// The trial stands, all of it, where it may.
fn stands_within(zone: Zone, trial: Trial, within: Within) -> bool {
    let mut points = outline(zone, trial, 1.0);
    if let Zone::Circle { diameter } = zone {
        let [x, z] = trial.centre;
        points = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
            .map(|(dx, dz)| [x + dx * diameter / 2.0, z + dz * diameter / 2.0])
            .to_vec();
    }
    points.iter().all(|p| within.x.contains(p[0], 1e-9) && within.z.contains(p[1], 1e-9))
}

fn random_trial(rng: &mut fastrand::Rng, reach: f64, orientation: Orientation) -> Trial {
    let centre = [reach * (2.0 * rng.f64() - 1.0), reach * (2.0 * rng.f64() - 1.0)];
    Trial { centre, angle: random_angle(rng, orientation) }
}

fn random_angle(rng: &mut fastrand::Rng, orientation: Orientation) -> f64 {
    match orientation {
        Orientation::Axes => [0.0, FRAC_PI_2][rng.usize(0..2)],
        Orientation::Fixed(angle) => angle,
        Orientation::Free => PI * rng.f64(),
    }
}

/// A place near another.
fn nudged(rng: &mut fastrand::Rng, best: Trial, reach: f64, orientation: Orientation) -> Trial {
    let step = reach * 0.3 * 10_f64.powf(-5.0 * rng.f64());
    let mut nudge = || step * (2.0 * rng.f64() - 1.0);
    let centre = [best.centre[0] + nudge(), best.centre[1] + nudge()];
    let angle = if orientation == Orientation::Free { best.angle + nudge() } else { best.angle };
    Trial { centre, angle }
}

/// A force of known direction, one in two within a cone.
fn random_load(rng: &mut fastrand::Rng) -> Load {
    let component = if rng.bool() { Component::Total } else { Component::Along };
    let cone = if rng.bool() { FRAC_PI_2 * rng.f64().powi(2) } else { 0.0 };
    Load::in_plane(FORCE, 2.0 * PI * rng.f64(), component).unwrap().with_cone(cone).unwrap()
}

/// What counts at a posture under forces at even steps of the cone, m/N.
fn directed(arm: &PlanarArm, load: Load, (shoulder, elbow): (f64, f64)) -> f64 {
    let Direction::InPlane(middle) = load.direction() else { unreachable!("a force in the plane") };
    let [xx, zz, xz] = compliance(arm, shoulder, elbow);
    let steps = if load.cone() == 0.0 { 0 } else { 60 };
    let of = |i: i32| {
        let (s, c) = (middle + load.cone() * f64::from(i) / f64::from(steps.max(1))).sin_cos();
        let moved = [xx * c + xz * s, xz * c + zz * s];
        if load.component() == Component::Along { moved[0] * c + moved[1] * s } else { moved[0].hypot(moved[1]) }
    };
    (-steps..=steps).map(of).fold(0.0, f64::max)
}

/// The same for forces of known direction, of which the worst point may lie anywhere in the zone.
#[test]
fn no_placement_beats_the_answer_under_a_known_force() {
    let (mut feasible, mut compared, mut inside, mut loose, mut unproved) = (0, 0, 0, 0, 0);
    let cases = cases(120);
    for seed in 0..cases {
        let mut rng = fastrand::Rng::with_seed(7_000 + seed);
        let arm = random_arm(&mut rng);
        let reach = arm.l2 + arm.l3;
        let zone = random_zone(&mut rng, reach);
        let options = PlaceOptions { load: random_load(&mut rng), ..options(&mut rng, reach, 2e-3) };
        let case = format!("seed {seed}: {arm:?} {zone:?} {options:?}");
        let answer = match place(&arm, zone, &options) {
            Ok(answer) => answer,
            Err(error) => {
                assert_eq!(error.to_string(), InvalidArm::NothingReachable.to_string(), "{case}");
                continue;
            }
        };
        let best = answer.feasible();
        if let Some(best) = best {
            feasible += 1;
            let gap = best.deflection - best.lower_bound;
            assert!(0.0 <= gap, "{case}: {best:?}");
            unproved += u64::from(best.lower_bound <= 0.0);
            loose += u64::from(1e-2 * best.deflection < gap);
            if 2e-3 * best.deflection < gap {
                println!(
                    "LOOSE {seed} {:.4} {:.5} {:?} cone {:.2} {:?} {zone:?} whole {}",
                    gap / best.deflection,
                    best.deflection,
                    options.orientation,
                    options.load.cone(),
                    options.load.component(),
                    arm.shoulder.is_all() && arm.elbow.is_all()
                );
            }
            let trial = Trial { centre: best.centre, angle: best.angle };
            // Rings of the zone from its rim to its middle: none is worse than the answer, and one is nearly as bad.
            let rings = (0..40).map(|i| (1.0 - 1e-6) * f64::from(40 - i) / 40.0);
            let side = if best.elbow.name() == "up" { -1.0 } else { 1.0 };
            let rings: Vec<f64> = rings
                .map(|grown| {
                    let held = held(&arm, &outline(zone, trial, grown), 1e-6);
                    let of_side = |held: &&Vec<(f64, f64)>| held[0].1.sin() * side >= -1e-6;
                    let postures = held.iter().find(of_side).unwrap_or_else(|| panic!("{case}: unreachable: {best:?}"));
                    postures.iter().map(|&posture| directed(&arm, options.load, posture)).fold(0.0, f64::max)
                })
                .collect();
            let most = rings.iter().copied().fold(0.0, f64::max) * FORCE;
            inside += usize::from(rings[0] * FORCE < most * (1.0 - 1e-6));
            assert!(most <= best.deflection * (1.0 + 1e-6), "{case}: {most} {best:?}");
            // Steps of a few degrees around the zone and of a degree across the cone.
            assert!(best.deflection * 0.985 <= most, "{case}: {most} {best:?}");
        }
        let floor = best.map_or(f64::INFINITY, |best| best.lower_bound);
        for i in 0..120 {
            let trial = match best {
                Some(best) if i % 2 == 0 => {
                    nudged(&mut rng, Trial { centre: best.centre, angle: best.angle }, reach, options.orientation)
                }
                _ => random_trial(&mut rng, reach, options.orientation),
            };
            let fits = stands_within(zone, trial, options.within.unwrap())
                && brute(&arm, &outline(zone, trial, GROWN), 0.0).is_some();
            if !fits {
                continue;
            }
            compared += 1;
            for postures in held(&arm, &outline(zone, trial, 1.0), 1e-12) {
                let value = postures.iter().map(|&posture| directed(&arm, options.load, posture)).fold(0.0, f64::max);
                // The witness sees points of the rim and steps of the cone alone, and may miss the worst by that much.
                assert!(floor <= value * FORCE * 1.015, "{case}: {trial:?} has {value}, floor {floor}");
            }
        }
    }
    println!(
        "{feasible} feasible ({loose} with a loose bound), {inside} with their worst point inside, {compared} placements compared"
    );
    assert!(cases / 2 <= feasible && 25 * cases <= 2 * compared, "too few cases: {feasible}, {compared}");
    assert!(1 <= inside, "no worst point lies inside");
    // Arms folded onto their base or stretched, where small steps of the work turn them by much, and small zones at any angle.
    assert!(loose <= feasible / 20, "{loose} of {feasible} are not proved");
    assert!(100 * unproved <= feasible, "of {unproved} of {feasible} nothing is proved");
}

#[test]
fn no_placement_beats_the_answer_or_lies_under_its_bound() {
    let (mut feasible, mut infeasible, mut nothing, mut searched, mut compared) = (0, 0, 0, 0, 0);
    let cases = cases(600);
    for seed in 0..cases {
        let mut rng = fastrand::Rng::with_seed(seed);
        let arm = random_arm(&mut rng);
        let reach = arm.l2 + arm.l3;
        let zone = random_zone(&mut rng, reach);
        let options = options(&mut rng, reach, 1e-4);
        let case = format!("seed {seed}: {arm:?} {zone:?} {options:?}");
        let answer = match place(&arm, zone, &options) {
            Ok(answer) => answer,
            Err(error) => {
                assert_eq!(error.to_string(), InvalidArm::NothingReachable.to_string(), "{case}");
                nothing += 1;
                continue;
            }
        };
        let mut try_all = |floor: f64, around: Option<Trial>| {
            for i in 0..160 {
                let trial = match around {
                    Some(best) if i % 2 == 0 => nudged(&mut rng, best, reach, options.orientation),
                    _ => random_trial(&mut rng, reach, options.orientation),
                };
                if !stands_within(zone, trial, options.within.unwrap()) {
                    continue;
                }
                // Small zones are sampled as they are: their outline leaves the limits only at a corner or a sample.
                if brute(&arm, &outline(zone, trial, GROWN), 0.0).is_some() {
                    let value = brute(&arm, &outline(zone, trial, 1.0), 1e-12);
                    compared += 1;
                    let value =
                        value.unwrap_or_else(|| panic!("{case}: the grown zone fits, the zone does not: {trial:?}"));
                    assert!(floor <= value * FORCE * (1.0 + 1e-9), "{case}: {trial:?} has {value}, floor {floor}");
                }
            }
        };
        match &answer {
            Placed::Feasible(best) => {
                feasible += 1;
                assert!(best.lower_bound <= best.deflection, "{case}");
                assert!(best.deflection - best.lower_bound <= 1e-4 * best.deflection, "{case}: {best:?}");
                searched += u64::from(1e-9 * best.deflection < best.deflection - best.lower_bound);
                let trial = Trial { centre: best.centre, angle: best.angle };
                // A millionth smaller, so that a zone that touches the axis of equal links has a bearing everywhere.
                let value = brute(&arm, &outline(zone, trial, 1.0 - 1e-6), 1e-6)
                    .unwrap_or_else(|| panic!("{case}: the witness calls the answer unreachable: {best:?}"));
                // The worst point is among the samples, but for the millionth.
                assert!((value * FORCE - best.deflection).abs() <= 1e-5 * best.deflection, "{case}: {value} {best:?}");
                assert!(stands_within(zone, trial, options.within.unwrap()), "{case}: {best:?}");
                try_all(best.lower_bound, Some(trial));
            }
            Placed::Infeasible { largest_scale, .. } => {
                let largest_scale = &largest_scale.expect("the planar model looks for it");
                infeasible += 1;
                try_all(f64::INFINITY, None);
                if 0.0 < *largest_scale {
                    let smaller = place(&arm, zone.scaled(*largest_scale), &options).unwrap();
                    assert!(smaller.feasible().is_some(), "{case}: scale {largest_scale}");
                    let larger = place(&arm, zone.scaled(largest_scale * 1.001), &options).unwrap();
                    assert!(
                        larger.feasible().is_none() || 1.0 <= largest_scale * 1.001,
                        "{case}: scale {largest_scale}"
                    );
                }
            }
        }
    }
    println!(
        "{feasible} feasible ({searched} searched), {infeasible} infeasible, {nothing} with nothing reachable, {compared} placements compared"
    );
    assert!(cases * 5 / 6 <= feasible + infeasible, "too few cases: {feasible} + {infeasible}");
    assert!(
        cases <= 12 * searched && cases <= 12 * infeasible && 25 * cases <= 3 * compared,
        "the cases do not exercise the search"
    );
}
