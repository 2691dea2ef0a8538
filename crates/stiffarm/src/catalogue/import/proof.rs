//! Does the robot file move as the description does?

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::SAMPLES;
use crate::geometry::Geometry;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;

/// The largest differences that were seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Errors {
    /// Of the flange centre, m.
    pub(super) distance: f64,
    /// Of the flange's rotation, rad.
    pub(super) angle: f64,
}

impl Errors {
    pub(super) fn within(&self, other: &Self) -> bool {
        self.distance <= other.distance && self.angle <= other.angle
    }

    /// Twice these, and no less than rounding makes.
    pub(super) fn doubled(&self) -> Self {
        Self { distance: 2.0 * self.distance + 1e-12, angle: 2.0 * self.angle + 1e-12 }
    }
}

/// Compares the flange of a robot with where a description has it: at both ends and the middle of every joint's range in
/// all combinations, at seeded postures in between, and uphill from the worst of them.
pub(super) fn compare(robot: &Robot, described: &impl Fn(&[f64; 6]) -> Pose) -> Errors {
    const UNKNOWN: Errors = Errors { distance: f64::INFINITY, angle: f64::INFINITY };
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return UNKNOWN };
    // In shares of each range.
    let at = |shares: &[f64; 6]| {
        let q = std::array::from_fn(|i| limits.joints[i].min() + shares[i] * limits.joints[i].width());
        let written = geometry.forward(&geometry.model_angles(&q, limits.third_axis));
        let expected = described(&q);
        let distance = (written.translation.vector - expected.translation.vector).norm();
        let turn = written.rotation.inverse() * expected.rotation;
        // The arc cosine of a number near 1, which `angle` takes, has half the digits.
        Errors { distance, angle: 2.0 * turn.imag().norm().atan2(turn.w.abs()) }
    };
    let mut rng = fastrand::Rng::with_seed(1);
    let postures: Vec<[f64; 6]> = (0..SAMPLES)
        .map(|n| match n.checked_sub(3_usize.pow(6)) {
            None => std::array::from_fn(|joint| (n / 3_usize.pow(joint as u32) % 3) as f64 / 2.0),
            Some(_) => std::array::from_fn(|_| rng.f64()),
        })
        .collect();
    let errors: Vec<Errors> = postures.iter().map(&at).collect();
    if !errors.iter().all(|error| (error.distance + error.angle).is_finite()) {
        return UNKNOWN;
    }
    let largest = |value: fn(&Errors) -> f64| {
        let worst = (0..SAMPLES).max_by(|&a, &b| value(&errors[a]).total_cmp(&value(&errors[b])));
        worst.map_or(0.0, |worst| uphill(postures[worst], |shares| value(&at(shares))))
    };
    Errors { distance: largest(|error| error.distance), angle: largest(|error| error.angle) }
}

/// The largest value that steps along single joints lead to, each share in 0 to 1; steps are halved where none helps.
fn uphill(mut shares: [f64; 6], value: impl Fn(&[f64; 6]) -> f64) -> f64 {
    let mut best = value(&shares);
    let mut step = 0.25;
    while 1e-4 < step {
        let before = best;
        for joint in 0..6 {
            for way in [-step, step] {
                let mut next = shares;
                next[joint] = (next[joint] + way).clamp(0.0, 1.0);
                let found = value(&next);
                if best < found {
                    (shares, best) = (next, found);
                }
            }
        }
        if best <= before {
            step /= 2.0;
        }
    }
    best
}

/// The flange by the closed form of \[OPW\], at the joint angles `q` as reported.
///
/// `c_x1 = c2 sin t2 + k sin(t2 + t3 + psi3) + a1`, `c_y1 = b`, `c_z1 = c2 cos t2 + k cos(t2 + t3 + psi3)` with
/// `psi3 = atan(a2/c3)`, `k = hypot(a2, c3)`; turned by `t1`, raised by `c1`; `u = c + c4 R z`, `R = R_c0 R_ec`.
pub(super) fn closed_form(geometry: &Geometry, q: &[f64; 6]) -> Pose {
    let Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign } = geometry;
    let t: [f64; 6] = std::array::from_fn(|i| sign[i] * q[i] - offset[i]);
    let (psi3, k) = (a2.atan2(*c3), a2.hypot(*c3));
    let reach = c2 * t[1].sin() + k * (t[1] + t[2] + psi3).sin() + a1;
    let height = c2 * t[1].cos() + k * (t[1] + t[2] + psi3).cos();
    let (s1, k1) = t[0].sin_cos();
    let wrist = Vector3::new(reach * k1 - b * s1, reach * s1 + b * k1, height + c1);
    let (s23, k23) = (t[1] + t[2]).sin_cos();
    let ((s4, k4), (s5, k5), (s6, k6)) = (t[3].sin_cos(), t[4].sin_cos(), t[5].sin_cos());
    let forearm = Matrix3::new(k1 * k23, -s1, k1 * s23, s1 * k23, k1, s1 * s23, -s23, 0.0, k23);
    #[rustfmt::skip]
    let hand = Matrix3::new(
        k4 * k5 * k6 - s4 * s6, -k4 * k5 * s6 - s4 * k6, k4 * s5,
        s4 * k5 * k6 + k4 * s6, -s4 * k5 * s6 + k4 * k6, s4 * s5,
        -s5 * k6, s5 * s6, k5,
    );
    let turned = forearm * hand;
    let centre = wrist + turned * Vector3::z() * *c4;
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turned));
    Pose::from_parts(centre.into(), rotation)
}
