//! Is the six-axis compliance what independent reasoning says, and the planar model its special case?

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix6, Vector3, Vector6};
use stiffarm::catalogue::paper_robots;
use stiffarm::compliance::compliance;
use stiffarm::drive::{Architecture, Drives, JointCompliance};
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::limits::{Limits, Pendant, ThirdAxis};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::{Pose, Wrench};

fn random_robot(rng: &mut fastrand::Rng, architecture: Architecture, drives: [f64; 6]) -> Robot {
    let mut length = |low: f64, high: f64| low + (high - low) * rng.f64();
    let geometry = Geometry {
        a1: length(0.0, 0.8),
        a2: length(-0.3, 0.3),
        b: 0.0,
        c1: length(0.3, 1.0),
        c2: length(0.6, 1.5),
        c3: length(0.6, 1.8),
        c4: length(0.1, 0.3),
        offset: std::array::from_fn(|_| 0.0),
        sign: std::array::from_fn(|_| 1.0),
    };
    let limits = Limits {
        joints: [Interval::ALL; 6],
        third_axis: ThirdAxis::Elbow,
        pendant: Pendant::Unknown,
        elbow: Interval::ALL,
        speeds: None,
    };
    let mut robot = paper_robots().swap_remove(0);
    robot.architecture = architecture;
    robot.arm = Arm::SixAxis { geometry, limits, drives: Drives::new(architecture, JointCompliance(drives)) };
    robot
}

fn random_joints(rng: &mut fastrand::Rng) -> [f64; 6] {
    std::array::from_fn(|_| 2.0 * PI * (rng.f64() - 0.5))
}

#[test]
fn with_drives_2_and_3_alone_the_wrist_centre_moves_as_in_the_planar_model() {
    let mut rng = fastrand::Rng::with_seed(11);
    for case in 0..400 {
        let architecture = Architecture::ALL[case % 2];
        let (k2, k3) = (1e-6 * (0.2 + rng.f64()), 1e-6 * (0.2 + rng.f64()));
        let robot = random_robot(&mut rng, architecture, [0.0, k2, k3, 0.0, 0.0, 0.0]);
        let mut q = random_joints(&mut rng);
        q[0] = 0.0;
        let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("made of six axes") };
        let to_wrist = Pose::translation(0.0, 0.0, -geometry.c4);
        let found = compliance(&robot, &q, &to_wrist).unwrap().compliance.translation();
        let plane = robot.arm_plane().unwrap().arm;
        let elbow = -geometry.a2.atan2(geometry.c3) - q[2];
        let expected = plane.compliance(FRAC_PI_2 - q[1], elbow);
        let scale = expected.norm();
        for (i, row) in [0, 2].into_iter().enumerate() {
            for (j, column) in [0, 2].into_iter().enumerate() {
                assert!((found[(row, column)] - expected[(i, j)]).abs() <= 1e-12 * scale, "{found} {expected}");
            }
        }
        assert!(found.row(1).norm() <= 1e-12 * scale && found.column(1).norm() <= 1e-12 * scale, "nothing sideways");
    }
}

#[test]
fn drive_1_alone_gives_the_square_of_the_distance_sideways() {
    let mut rng = fastrand::Rng::with_seed(12);
    for _ in 0..50 {
        let robot = random_robot(&mut rng, Architecture::Serial, [2e-6, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let q = random_joints(&mut rng);
        let posture = compliance(&robot, &q, &Pose::identity()).unwrap();
        let at = posture.tool.translation.vector;
        let distance = at.x.hypot(at.y);
        let sideways = Vector3::new(-at.y, at.x, 0.0) / distance;
        let expected = 2e-6 * distance * distance;
        let (value, direction) = posture.compliance.worst();
        assert!((value - expected).abs() <= 1e-10 * expected, "{value} {expected}");
        assert!((direction.dot(&sideways).abs() - 1.0).abs() < 1e-6);
        assert!((posture.shares(&sideways)[0] - 1.0).abs() < 1e-12);
    }
}

/// The deflection as the drives see it: torque `A^T J^T w`, drive motion `k` times that, tool motion by moving the joints.
#[test]
fn the_deflection_is_that_of_a_model_which_moves_its_joints_by_the_springs() {
    let mut rng = fastrand::Rng::with_seed(13);
    for case in 0..200 {
        let architecture = Architecture::ALL[case % 2];
        let drives: [f64; 6] = std::array::from_fn(|_| 1e-6 * (0.1 + rng.f64()));
        let robot = random_robot(&mut rng, architecture, drives);
        let q = random_joints(&mut rng);
        let tool = Pose::new(Vector3::new(0.1, -0.2, 0.3), Vector3::new(0.3, 0.2, -0.5));
        let posture = compliance(&robot, &q, &tool).unwrap();
        let wrench = Wrench(Vector6::from_fn(|i, _| if i < 3 { 1000.0 } else { 100.0 } * (rng.f64() - 0.5)));
        // Virtual work by finite differences: torque on drive i = d(w . tool motion) / d psi_i.
        let moved = |psi: [f64; 6]| {
            let mut q = q;
            for i in 0..6 {
                q[i] += psi[i];
            }
            if architecture == Architecture::QuasiSerial {
                q[2] -= psi[1]; // drive 2 leaves the forearm's attitude alone
            }
            compliance(&robot, &q, &tool).unwrap().tool
        };
        let h = 1e-6;
        let mut found = Vector6::zeros();
        for (i, k) in drives.into_iter().enumerate() {
            let unit = |step: f64| std::array::from_fn(|j| if i == j { step } else { 0.0 });
            let (ahead, behind) = (moved(unit(h)), moved(unit(-h)));
            let translation = (ahead.translation.vector - behind.translation.vector) / (2.0 * h);
            let rotation = (ahead.rotation * behind.rotation.inverse()).scaled_axis() / (2.0 * h);
            let column = Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z);
            found += column * k * column.dot(&wrench.0);
        }
        let (translation, rotation) = posture.compliance.deflection(&wrench);
        assert!((found.fixed_rows::<3>(0) - translation).norm() <= 1e-7 * translation.norm().max(1e-4));
        assert!((found.fixed_rows::<3>(3) - rotation).norm() <= 1e-7 * rotation.norm().max(1e-4));
    }
}

#[test]
fn the_compliance_is_symmetric_gives_no_energy_away_and_is_the_sum_of_its_drives() {
    let mut rng = fastrand::Rng::with_seed(14);
    for robot in paper_robots() {
        for _ in 0..50 {
            let posture = compliance(&robot, &random_joints(&mut rng), &Pose::translation(0.0, 0.0, 0.2)).unwrap();
            let c = posture.compliance.0;
            assert_eq!(c, c.transpose(), "{}", robot.name);
            let w = Vector6::from_fn(|_, _| rng.f64() - 0.5);
            assert!(-1e-18 <= w.dot(&(c * w)));
            let sum: Matrix6<f64> = posture.by_drive.iter().fold(Matrix6::zeros(), |sum, part| sum + part.0);
            assert!((sum - c).norm() <= 1e-15 * c.norm());
            let (_, worst) = posture.compliance.worst();
            assert!((posture.shares(&worst).iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}
