//! Does the chain of frames of a calibrated arm stand where differences, its inverse and another program say?

use nalgebra::{Matrix3, Matrix6, Vector3};
use stiffarm::calibration::Errors;
use stiffarm::catalogue::{names, paper_robots};
use stiffarm::chain::TrueArm;
use stiffarm::compliance::compliance;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::{Compliance, Pose};

use crate::made::calibrated;

/// Errors as large as those of arms that nobody has calibrated, which err by some millimetre: up to 0.5 mm and 0.5 mrad a frame, 0.5 mrad of weight,
/// 0.1 mrad of gears.
fn errors(rng: &mut fastrand::Rng) -> Errors {
    let mut errors = Errors::NONE;
    let mut up_to = |most: f64| most * (2.0 * rng.f64() - 1.0);
    errors.frames.iter_mut().flatten().for_each(|x| *x = up_to(0.5e-3));
    errors.weight.iter_mut().for_each(|x| *x = up_to(0.5e-3));
    errors.gears.iter_mut().flatten().for_each(|x| *x = up_to(0.1e-3));
    errors
}

/// Joint angles over a turn, those of a singular posture left out: there a pose says nothing of some joints.
fn posture(robot: &Robot, rng: &mut fastrand::Rng) -> [f64; 6] {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
    loop {
        let theta: [f64; 6] = std::array::from_fn(|_| std::f64::consts::PI * (2.0 * rng.f64() - 1.0));
        let [_, _, _, wrist, _] = geometry.points(&theta);
        let ahead = (wrist[0].hypot(wrist[1]).powi(2) - geometry.b * geometry.b).max(0.0).sqrt();
        if CLEAR < geometry.singular_margin(&theta) && CLEAR * geometry.c2 < ahead {
            return geometry.reported(&theta, limits.third_axis);
        }
    }
}

/// rad, and of the upper arm, from singular postures, somewhat more than paths keep. An arm of 2.5 m that is bent by so much has 3 mm left to its rim; where
/// errors take more than that, a posture may be beyond the rim of the arm as drawn, from which the search begins.
const CLEAR: f64 = 0.1;

fn apart(one: &[f64; 6], other: &[f64; 6]) -> f64 {
    one.iter().zip(other).map(|(a, b)| 2.0 * ((a - b) / 2.0).sin().abs()).fold(0.0, f64::max)
}

#[test]
fn the_joints_of_a_pose_are_those_that_put_the_flange_there() {
    let mut rng = fastrand::Rng::with_seed(4);
    for _ in 0..1000 {
        for robot in paper_robots() {
            let arm = TrueArm::with(&robot, &errors(&mut rng)).unwrap();
            let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
            let q = posture(&robot, &mut rng);
            let flange = arm.flange(&q);
            let found = arm.postures(&flange).found;
            for (configuration, theta) in &found {
                let there = arm.flange(&geometry.reported(theta, limits.third_axis));
                let off = (there.translation.vector - flange.translation.vector).norm();
                // 1e-12 by what is promised, and the rounding of angles that are counted anew.
                assert!(off < 3e-12, "{}: {configuration} {q:?} {off:e}", robot.name);
                assert!(there.rotation.angle_to(&flange.rotation) < 1e-7, "an angle near zero is a root of rounding");
            }
            let back = found.iter().map(|(_, theta)| apart(&geometry.reported(theta, limits.third_axis), &q));
            let nearest = back.fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-10, "{}: {q:?} {nearest:e} {:?}", robot.name, arm.postures(&flange));
        }
    }
}

#[test]
fn the_links_move_the_tip_as_differences_say() {
    let mut rng = fastrand::Rng::with_seed(5);
    for robot in paper_robots() {
        // Without weight and gears a joint turns its link by what it turns itself.
        let errors = Errors { frames: errors(&mut rng).frames, ..Errors::NONE };
        let arm = TrueArm::with(&robot, &errors).unwrap();
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
        let theta = geometry.model_angles(&posture(&robot, &mut rng), limits.third_axis);
        let at = |theta: &[f64; 6]| arm.flange(&geometry.reported(theta, limits.third_axis));
        let tool = Pose::translation(0.1, -0.05, 0.2);
        let tip = (at(&theta) * tool).translation.vector;
        let jacobian = arm.jacobian(&geometry.reported(&theta, limits.third_axis), &tip);
        for i in 0..6 {
            let h = 1e-6;
            let moved = |step: f64| {
                let mut theta = theta;
                theta[i] += step;
                at(&theta) * tool
            };
            let (ahead, behind) = (moved(h), moved(-h));
            let along = (ahead.translation.vector - behind.translation.vector) / (2.0 * h);
            let about = (ahead.rotation * behind.rotation.inverse()).scaled_axis() / (2.0 * h);
            // Rounding 1e-15 m over 2e-6, and the third derivative times h^2.
            assert!((jacobian.fixed_view::<3, 1>(0, i) - along).norm() < 1e-8, "{}: {i}", robot.name);
            assert!((jacobian.fixed_view::<3, 1>(3, i) - about).norm() < 1e-8, "{}: {i}", robot.name);
        }
    }
}

#[test]
fn a_posture_that_only_the_drawing_has_is_said_to_vanish() {
    let robot = paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").unwrap();
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
    // Nearly stretched: a forearm that is 1 mm shorter does not reach there.
    let theta = [0.2, 0.9, -geometry.a2.atan2(geometry.c3) + 0.01, 0.3, 0.7, -0.4];
    let flange = geometry.forward(&theta);
    let mut errors = Errors::NONE;
    errors.frames[3][2] = -1e-3;
    let found = TrueArm::with(&robot, &errors).unwrap().postures(&flange);
    let drawn = stiffarm::inverse::postures(geometry, &flange).found;
    assert_eq!(found.found.len() + found.vanished.len(), drawn.len());
    assert!(
        !found.vanished.is_empty() && found.vanished.iter().all(|gone| drawn.iter().any(|(known, _)| known == gone))
    );
    let q = geometry.reported(&theta, limits.third_axis);
    assert_eq!(TrueArm::with(&robot, &errors).unwrap().joints_near(&flange, &q), None);
    let longer = Errors { frames: errors.frames.map(|frame| frame.map(|x| -x)), ..Errors::NONE };
    assert!(TrueArm::with(&robot, &longer).unwrap().postures(&flange).vanished.is_empty());
}

#[test]
fn the_tool_point_of_a_calibrated_robot_is_the_true_one_and_its_compliance_nearly_that_of_the_drawing() {
    let mut rng = fastrand::Rng::with_seed(6);
    let tool = Pose::translation(0.05, 0.02, 0.25);
    let mut largest: f64 = 0.0;
    for robot in paper_robots() {
        for _ in 0..200 {
            let errors = errors(&mut rng);
            let q = posture(&robot, &mut rng);
            let arm = TrueArm::with(&robot, &errors).unwrap();
            let (drawn, corrected) =
                [&robot, &calibrated(&robot, &errors, None)].map(|robot| compliance(robot, &q, &tool).unwrap()).into();
            assert_eq!(corrected.tool, arm.flange(&q) * tool);
            assert_eq!(corrected.compliance.0, drawn.compliance.0);
            let Arm::SixAxis { drives, .. } = &robot.arm else { panic!("six axes") };
            let jacobian: Matrix6<f64> = arm.jacobian(&q, &corrected.tool.translation.vector) * drives.transmission.0;
            let truth =
                Compliance(jacobian * Matrix6::from_diagonal(&drives.compliance.0.into()) * jacobian.transpose());
            largest = largest.max((truth.worst().0 / drawn.compliance.worst().0 - 1.0).abs());
        }
    }
    assert!(largest < 5e-3, "{largest}");
}

/// Numbers of a cell, apart by blanks.
fn numbers<const N: usize>(cell: &str) -> [f64; N] {
    let all: Vec<f64> = cell.split(' ').map(|x| x.parse().unwrap()).collect();
    all.try_into().unwrap()
}

#[test]
fn pinocchio_with_shifted_joint_placements_puts_the_flange_at_the_same_place() {
    let text = include_str!("../../../validation/true_chain.csv");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let mut cases = 0;
    for record in reader.records().map(Result::unwrap) {
        let [robot, joints, frames, weight, gears, at, rotation, jacobian] = std::array::from_fn(|i| &record[i]);
        let robot = paper_robots().into_iter().find(|known| names(known, robot)).unwrap();
        let (frames, gears) = (numbers::<36>(frames), numbers::<12>(gears));
        let errors = Errors {
            frames: std::array::from_fn(|i| std::array::from_fn(|j| 1e-3 * frames[6 * i + j])),
            weight: numbers::<8>(weight).map(|x| 1e-3 * x),
            gears: std::array::from_fn(|i| [0, 1].map(|j| 1e-3 * gears[2 * i + j])),
            drives: None,
        };
        let arm = TrueArm::with(&robot, &errors).unwrap();
        let q = numbers::<6>(joints).map(f64::to_radians);
        let flange = arm.flange(&q);
        let (at, rotation) = (Vector3::from(numbers::<3>(at)), Matrix3::from_row_slice(&numbers::<9>(rotation)));
        // Some ten rotations and lengths of both programs: 1e-15 of some metres each.
        assert!((flange.translation.vector - at).norm() < 1e-13, "{}: {:?}", robot.name, &record[1]);
        assert!((flange.rotation.to_rotation_matrix().matrix() - rotation).norm() < 1e-13, "{}", robot.name);
        let recorded = Matrix6::from_row_slice(&numbers::<36>(jacobian));
        assert!((arm.jacobian(&q, &at) - recorded).norm() < 1e-12, "{}", robot.name);
        cases += 1;
    }
    assert_eq!(cases, 30);
}
