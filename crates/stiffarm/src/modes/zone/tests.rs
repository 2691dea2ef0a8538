use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::catalogue::{find, with_compliance};
use crate::drive::{Architecture, GravityCompensator, Transmission};
use crate::inverse::postures;
use crate::load::Load;
use crate::mass::{Carrier, Mass, RigidBody};
use crate::model::Model;
use crate::place::{Hold, Orientation, PlaceOptions, Placed, place};
use crate::robot::{Arm, Robot};
use crate::watch::Watch;

/// A KR 210 with masses; every other one a parallelogram with rod, counterweight and compensator.
fn robot(case: usize) -> Robot {
    let robot = find("KR 210 R2700-2").unwrap().robot();
    let mut robot = with_compliance(&robot, [0.477, 0.296, 0.358, 2.52, 3.01, 2.1]).unwrap();
    if case % 2 == 1 {
        robot.architecture = Architecture::QuasiSerial;
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { panic!("six axes") };
        drives.transmission = Transmission::of(Architecture::QuasiSerial);
        let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 4e6, free_length: 0.3 });
        let body = RigidBody::new(60.0, Vector3::new(-0.1, 0.1, 1.2), [3.0, 0.1, 0.2, 3.0, 0.0, 0.5]);
        robot.masses.push(Mass { carrier: Carrier::Rod { crank: [-0.3, -0.1] }, body });
        let body = RigidBody::point(200.0, Vector3::new(-0.3, 0.0, 0.6));
        robot.masses.push(Mass { carrier: Carrier::Counterweight, body });
    }
    robot
}

fn tool() -> HeldTool {
    let centre = Vector3::new(0.05, -0.02, 0.2);
    let body = RigidBody::new(60.0, centre, [1.3, 0.02, 0.05, 1.6, 0.0, 0.5]);
    HeldTool { flange_from_tool: Pose::translation(0.1, 0.05, 0.3), body: Some(body) }
}

/// Zones held by some configuration of such arms, and whether any was.
fn each_zone(mut check: impl FnMut(&HeldSwing, &mut fastrand::Rng)) {
    let mut rng = fastrand::Rng::with_seed(71);
    let mut held = 0;
    for case in 0..12 {
        let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
        let robot = robot(case);
        let model = Model::spatial(&robot, &tool().flange_from_tool).unwrap();
        let Model::Spatial(model) = &model else { panic!("in space") };
        let arm = SwingingArm::new(&robot, &tool()).unwrap();
        let zone = match case % 3 {
            0 => Zone::Circle { diameter: part(0.2, 0.5) },
            _ => Zone::Rectangle { width: part(0.1, 0.4), height: part(0.2, 0.6) },
        };
        let elevation = [-FRAC_PI_2, 0.0, -0.7][case % 3];
        let (x, z) = (part(1.2, 1.7), part(0.7, 1.4));
        let work = WorkPlacement { x, y: 0.0, z, yaw: part(-0.3, 0.3), angle: part(0.0, 3.0), roll: part(0.0, 6.0) };
        let flange = WorkPlane::of(elevation, &work).pose(&work, [0.0; 2]) * model.flange_from_tool().inverse();
        for (configuration, _) in postures(arm.geometry(), &flange).found {
            let held_zone = HeldSwing {
                arm: &arm,
                enclosure: ArmEnclosure::new(&model.arm().without_limits(), [false; 6]),
                tool_from_flange: model.flange_from_tool().inverse(),
                plane: WorkPlane::of(elevation, &work),
                work,
                zone,
                configuration,
                bearing: 0.0,
            };
            // All of it, and nowhere singular.
            if held_zone.first_at_least().0.is_some() {
                held += 1;
                check(&held_zone, &mut rng);
            }
        }
    }
    assert!(20 < held, "{held}");
}

/// Each frequency by `modes`, without the formulas of the bound.
#[test]
fn no_point_of_a_zone_swings_slower_than_is_proved_and_some_hardly_faster() {
    let mut tightest = 0.0_f64;
    each_zone(|held, rng| {
        let (first, parts) = held.first_at_least();
        let first = first.unwrap();
        let mut least = f64::INFINITY;
        for _ in 0..400 {
            let at = held.zone.at([2.0 * rng.f64() - 1.0, 2.0 * rng.f64() - 1.0]);
            least = least.min(held.frequencies(at).unwrap()[0]);
        }
        for i in 0..=40 {
            let side = f64::from(i) / 20.0 - 1.0;
            for at in [[side, 1.0], [side, -1.0], [1.0, side], [-1.0, side]] {
                least = least.min(held.frequencies(held.zone.at(at)).unwrap()[0]);
            }
        }
        assert!(first <= least, "{first} {least} after {parts}");
        tightest = tightest.max(first / least);
        // Samples lie apart, and the proof allows itself 1 %.
        assert!(least * 0.985 < first, "{first} {least} after {parts}");
    });
    assert!(tightest < 1.0);
}

/// Small parts, of which many are looked at: a bound that were too low by a part of second order would show.
#[test]
fn no_point_of_a_part_has_a_larger_eigenvalue_than_is_enclosed() {
    let (mut points, mut closest) = (0, f64::INFINITY);
    each_zone(|held, rng| {
        let [first, second] = held.zone.sides();
        for _ in 0..20 {
            let size = 0.02 + 0.2 * rng.f64();
            let middle = held.zone.at([0.7 * (2.0 * rng.f64() - 1.0), 0.7 * (2.0 * rng.f64() - 1.0)]);
            let half = [first, second].map(|side| size * side / 2.0);
            let mut part = middle.map(Affine::point);
            (part[0].deviations[0], part[1].deviations[1]) = (half[0], half[1]);
            let Some(most) = held.most_lambda(part) else { continue };
            for _ in 0..20 {
                let mut at = [0, 1].map(|i| middle[i] + half[i] * (2.0 * rng.f64() - 1.0));
                let corner = rng.usize(0..8);
                if corner < 4 {
                    at = [0, 1].map(|i| middle[i] + half[i] * if corner >> i & 1 == 0 { -1.0 } else { 1.0 });
                }
                let Ok(found) = held.frequencies(at) else { continue };
                points += 1;
                assert!(lambda(found[0]) <= most * (1.0 + 1e-12), "{} {most}", lambda(found[0]));
                closest = closest.min(most / lambda(found[0]) - 1.0);
            }
        }
    });
    assert!(10_000 < points && closest < 1e-3, "{points} points, the closest {closest}");
}

/// What is left over is needed: by the vertices alone some points would overstep.
#[test]
fn the_vertices_alone_do_not_bound_a_part() {
    let (mut overstepped, mut points) = (0, 0);
    each_zone(|held, _| {
        let half = held.zone.sides().map(|side| side * 0.3);
        let mut part = [Affine::point(0.0), Affine::point(0.0)];
        (part[0].deviations[0], part[1].deviations[1]) = (half[0], half[1]);
        let Some([at_vertices, _]) = held.enclosed_lambda(part) else { return };
        let side = |i: i32| f64::from(i) / 4.0 - 1.0;
        for [u, v] in (0..=8).flat_map(|i| (0..=8).map(move |j| [side(i), side(j)])) {
            let found = held.frequencies([u * half[0], v * half[1]]).unwrap();
            points += 1;
            overstepped += usize::from(at_vertices < lambda(found[0]));
        }
    });
    assert!(5 < overstepped, "{overstepped} of {points}");
}

#[test]
fn what_the_enclosure_leaves_over_is_of_second_order() {
    each_zone(|held, _| {
        let over = |half: f64| {
            let mut part = [Affine::point(0.0), Affine::point(0.0)];
            (part[0].deviations[0], part[1].deviations[1]) = (half, half);
            let (directions, _) = held.enclosure.directions(&held.plane, &held.work, part, held.configuration).unwrap();
            let inertia = inertia_of(held.arm.geometry(), &directions, held.arm.bodies());
            inertia.iter().flatten().map(|x| x.remainder).fold(0.0, f64::max)
        };
        let ratio = over(2e-3) / over(1e-3);
        assert!((3.7..4.4).contains(&ratio), "{ratio}");
    });
}

/// Brute force over a fine grid, each posture by `modes`.
#[test]
fn over_a_placed_zone_least_and_largest_are_those_of_a_finer_grid_and_the_bound_lies_below() {
    let robot = robot(0);
    let tool = tool();
    let model = Model::spatial(&robot, &tool.flange_from_tool).unwrap();
    for zone in [Zone::Rectangle { width: 0.4, height: 0.6 }, Zone::Circle { diameter: 0.5 }] {
        let options = PlaceOptions { orientation: Orientation::Fixed(0.4), ..PlaceOptions::under(Load::PAPER) };
        let Placed::Feasible(best) = place(&model, &zone.into(), &options, Watch::nobody()).unwrap() else {
            panic!("a place")
        };
        let over = modes_over(&model, zone, &options, &best, &tool).unwrap();
        let Hold::Space(hold) = &best.hold else { panic!("in space") };
        let (work, arm) = (hold.work(&best), SwingingArm::new(&robot, &tool).unwrap());
        let plane = WorkPlane::of(options.tool_orientation().elevation, &work);
        let mut ranges = [[f64::INFINITY, 0.0]; 6];
        let side = |i: usize| i as f64 / 40.0 - 1.0;
        for at in (0..=80).flat_map(|j| (0..=80).map(move |i| zone.at([side(i), side(j)]))) {
            let flange = plane.pose(&work, at) * tool.flange_from_tool.inverse();
            let theta = posture_of(arm.geometry(), &flange, hold.configuration).unwrap();
            let q = arm.geometry().reported(&theta, crate::limits::ThirdAxis::Elbow);
            let swing = crate::modes::modes(&robot, &q, &tool, None).unwrap();
            for (range, mode) in ranges.iter_mut().zip(&swing.modes) {
                *range = [range[0].min(mode.frequency), range[1].max(mode.frequency)];
            }
        }
        assert_eq!(over.modes.len(), 6);
        for (mode, [least, largest]) in over.modes.iter().zip(ranges) {
            assert!((mode.least / least - 1.0).abs() < 1e-3 && (mode.largest / largest - 1.0).abs() < 1e-3, "{over:?}");
            assert!(mode.spread.is_none());
        }
        let first = over.first_at_least.unwrap();
        assert!(first <= ranges[0][0] && ranges[0][0] * 0.98 < first, "{first} {ranges:?}");
        assert!(over.parts < 500, "{}", over.parts);
    }
}
