//! Measurements that were made up: of a robot whose compliances are known.
#![allow(dead_code, reason = "each test uses a part")]

pub(crate) mod other_day;

use std::fmt::Write;

use nalgebra::Vector3;
use stiffarm::calibration::{Calibration, ControllerModel, Errors};
use stiffarm::catalogue::measurements::{Measurements, Reading};
use stiffarm::compliance::compliance;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::{Pose, Wrench};

/// A robot that was calibrated, with these errors.
pub(crate) fn calibrated(robot: &Robot, errors: &Errors, controller: Option<ControllerModel>) -> Robot {
    let found = Calibration {
        errors: errors.clone(),
        residual: 0.1e-3,
        left_out: 0.1e-3,
        controller,
        rows: 40,
        date: "2026-05-31".into(),
        source: "made up".into(),
    };
    Robot { calibration: Some(Box::new(found)), ..robot.clone() }
}

/// A marker.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) name: &'static str,
    /// In the flange frame, m.
    pub(crate) at: Vector3<f64>,
}

impl Spot {
    pub(crate) fn one() -> Vec<Self> {
        vec![Self { name: "top", at: Vector3::new(0.05, 0.1, 0.3) }]
    }

    pub(crate) fn three() -> Vec<Self> {
        let more = [("left", Vector3::new(-0.2, 0.15, 0.1)), ("right", Vector3::new(0.2, -0.1, 0.15))];
        more.into_iter().map(|(name, at)| Self { name, at }).chain(Self::one()).collect()
    }
}

/// How measurements are made.
#[derive(Clone, Debug)]
#[allow(clippy::struct_excessive_bools, reason = "each is asked for by one test")]
pub(crate) struct Made {
    pub(crate) seed: u64,
    pub(crate) postures: usize,
    pub(crate) spots: Vec<Spot>,
    pub(crate) load_at: Vector3<f64>,
    /// Standard deviation of a coordinate, m.
    pub(crate) noise: f64,
    /// The noise stands in the table.
    pub(crate) noise_in_table: bool,
    pub(crate) in_flange_axes: bool,
    pub(crate) only_down: bool,
    pub(crate) only_joint_1: bool,
}

impl Made {
    pub(crate) fn usual(seed: u64) -> Self {
        Self {
            seed,
            postures: 25,
            spots: Spot::three(),
            load_at: Vector3::new(0.0, 0.1, 0.25),
            noise: 20e-6,
            noise_in_table: false,
            in_flange_axes: false,
            only_down: false,
            only_joint_1: false,
        }
    }

    pub(crate) fn measured(&self, robot: &Robot) -> Measurements {
        let Arm::SixAxis { limits, .. } = &robot.arm else { unreachable!("six axes") };
        let mut rng = fastrand::Rng::with_seed(self.seed);
        let mut readings = Vec::new();
        let first: [f64; 6] = std::array::from_fn(|i| within(limits.joints[i], rng.f64()));
        for posture in 0..self.postures {
            let mut q: [f64; 6] = std::array::from_fn(|i| within(limits.joints[i], rng.f64()));
            if self.only_joint_1 {
                q = [q[0], first[1], first[2], first[3], first[4], first[5]];
            }
            let mut force = Vector3::new(rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.5).normalize()
                * (300.0 + 700.0 * rng.f64());
            if self.only_down {
                force = Vector3::new(0.0, 0.0, -force.norm());
            }
            if self.only_joint_1 {
                let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("six axes") };
                let (s, c) = geometry.model_angles(&q, limits.third_axis)[0].sin_cos();
                force = 500.0 * Vector3::new(0.6 * c - 0.3 * s, 0.6 * s + 0.3 * c, 0.5);
            }
            let mut load = Wrench::force(force);
            if !self.only_joint_1 && !self.only_down {
                // A moment beside it.
                (load.0[3], load.0[4], load.0[5]) = (40.0 * rng.f64(), -30.0 * rng.f64(), 20.0 * rng.f64());
            }
            for spot in &self.spots {
                let row = readings.len() + 1;
                let sigma = self.noise_in_table.then_some(self.noise);
                let nothing = Vector3::zeros();
                let mut reading =
                    Reading { row, posture, q, load, load_at: self.load_at, marker_at: spot.at, moved: nothing, sigma };
                reading.moved = moved(robot, &reading) + self.noise * Vector3::from_fn(|_, _| normal(&mut rng));
                if self.in_flange_axes {
                    let turn = flange(robot, &q).rotation.inverse();
                    let (force, moment) =
                        (Vector3::from(load.0.fixed_rows::<3>(0)), Vector3::from(load.0.fixed_rows::<3>(3)));
                    reading.load.0.fixed_rows_mut::<3>(0).copy_from(&(turn * force));
                    reading.load.0.fixed_rows_mut::<3>(3).copy_from(&(turn * moment));
                    reading.moved = turn * reading.moved;
                }
                readings.push(reading);
            }
        }
        Measurements { readings, remarks: Vec::new() }
    }

    /// The same as a table.
    pub(crate) fn table(&self, robot: &Robot) -> String {
        let mut text = String::from(
            "posture,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm,marker,dx_um,dy_um,dz_um\n",
        );
        for (reading, spot) in self.measured(robot).readings.iter().zip(self.spots.iter().cycle()) {
            let list = |numbers: &[f64]| numbers.iter().map(|x| format!("{x:.10}")).collect::<Vec<_>>().join(",");
            let (q, moved) = (reading.q.map(f64::to_degrees), reading.moved * 1e6);
            let (load, moved) = (list(reading.load.0.as_slice()), list(moved.as_slice()));
            writeln!(text, "p{},{},{load},{},{moved}", reading.posture, list(&q), spot.name).unwrap();
        }
        text
    }
}

/// How far a marker moves: by the six-by-six compliance at the load point, and the rotation there.
pub(crate) fn moved(robot: &Robot, reading: &Reading) -> Vector3<f64> {
    let at = reading.load_at;
    let posture = compliance(robot, &reading.q, &Pose::translation(at.x, at.y, at.z)).unwrap();
    let (translation, rotation) = posture.compliance.deflection(&reading.load);
    translation + rotation.cross(&(posture.tool.rotation * (reading.marker_at - at)))
}

pub(crate) fn flange(robot: &Robot, q: &[f64; 6]) -> Pose {
    compliance(robot, q, &Pose::identity()).unwrap().tool
}

fn within(range: stiffarm::interval::Interval, share: f64) -> f64 {
    range.min().max(-3.0) + share * (range.max().min(3.0) - range.min().max(-3.0))
}

/// Box and Muller's.
pub(crate) fn normal(rng: &mut fastrand::Rng) -> f64 {
    (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (std::f64::consts::TAU * rng.f64()).cos()
}
