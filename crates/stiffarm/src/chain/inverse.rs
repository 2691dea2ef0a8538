//! Which joints put the flange of a calibrated arm at a pose? Newton's method, from the closed form of the arm as drawn.

use nalgebra::{Rotation3, UnitQuaternion, Vector3, Vector6};

use super::arm::TrueArm;
use super::frames::Placement;
use crate::inverse::{Configuration, postures};
use crate::spatial::Pose;

/// m and rad: so near a pose counts as reached.
const REACHED: f64 = 1e-12;
/// No step turns a joint farther, rad: beyond it the axes are others.
const LARGEST_STEP: f64 = 0.3;
/// rad: from what is reached, no last step of Newton's method is larger, unless the axes there are nearly in line.
const SETTLED: f64 = 1e-9;
/// Rounds of Newton's method.
const ROUNDS: usize = 40;
/// rad: postures that are nearer are one.
const ONE: f64 = 1e-7;

/// All postures of a pose, without regard to limits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TruePostures {
    /// Up to eight, each with its model angles, rad, under the name that it has of the arm as drawn.
    pub found: Vec<(Configuration, [f64; 6])>,
    /// Postures of the arm as drawn that the true arm does not have, or that fall together with another one.
    pub vanished: Vec<Configuration>,
}

impl TrueArm {
    /// Every posture whose flange stands at `flange` within 1e-12 m and rad.
    ///
    /// Empty where the arm as drawn does not reach the pose: within its errors of the rim the true arm may all the same.
    pub fn postures(&self, flange: &Pose) -> TruePostures {
        let mut all = TruePostures::default();
        for (configuration, drawn) in postures(&self.frames.geometry, flange).found {
            let found = self.model_angles_near(flange, &drawn);
            let is_new = |theta: &[f64; 6]| !all.found.iter().any(|(_, other)| is_one(theta, other));
            match found.filter(is_new) {
                Some(theta) => all.found.push((configuration, theta)),
                None => all.vanished.push(configuration),
            }
        }
        all
    }

    /// The joint angles, rad, as the robot reports them, that put the flange at a pose within 1e-12 m and rad, from joint angles near them:
    /// those of the arm as drawn. `None` where there are none.
    pub fn joints_near(&self, flange: &Pose, q: &[f64; 6]) -> Option<[f64; 6]> {
        let (geometry, third_axis) = (&self.frames.geometry, self.frames.third_axis);
        let theta = self.model_angles_near(flange, &geometry.model_angles(q, third_axis))?;
        Some(geometry.reported(&theta, third_axis))
    }

    /// The same in model angles.
    fn model_angles_near(&self, flange: &Pose, theta: &[f64; 6]) -> Option<[f64; 6]> {
        self.model_angles(&self.link_angles_near(flange, &self.link_angles(theta))?)
    }

    /// The same in link angles.
    pub(crate) fn link_angles_near(&self, flange: &Pose, from: &[f64; 6]) -> Option<[f64; 6]> {
        let to = (flange.translation.vector, flange.rotation.to_rotation_matrix().into_inner());
        let mut psi = *from;
        for _ in 0..ROUNDS {
            let placed = self.placed(&psi);
            let off = off(&to, &placed.flange);
            let step = placed.jacobian(&placed.flange.0).lu().solve(&off)?;
            let share = (LARGEST_STEP / step.amax()).min(1.0);
            let next: [f64; 6] = std::array::from_fn(|i| psi[i] + share * step[i]);
            if is_reached(&off) {
                // Once more: where the pose tells little of a joint, all that there is decides it.
                return Some(if step.amax() <= SETTLED { next } else { psi });
            }
            psi = next;
        }
        None
    }
}

/// How far one placement is from another, m and rad, as a shift and a turn in base axes.
fn off((to, turned): &Placement, (at, turn): &Placement) -> Vector6<f64> {
    /// Of the sine of the angle: the quaternion gives what is nearer to half a turn.
    const NEAR: f64 = 0.5;
    let shift = to - at;
    let rest = turned * turn.transpose();
    // The axis times the sine of the angle.
    let sines = Vector3::new(rest.m32 - rest.m23, rest.m13 - rest.m31, rest.m21 - rest.m12) / 2.0;
    let sine = sines.norm();
    let about = if 1.0 < rest.trace() && sine < NEAR {
        sines * if sine == 0.0 { 1.0 } else { sine.asin() / sine }
    } else {
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rest)).scaled_axis()
    };
    Vector6::new(shift.x, shift.y, shift.z, about.x, about.y, about.z)
}

fn is_reached(off: &Vector6<f64>) -> bool {
    off.fixed_rows::<3>(0).norm() <= REACHED && off.fixed_rows::<3>(3).norm() <= REACHED
}

fn is_one(one: &[f64; 6], other: &[f64; 6]) -> bool {
    one.iter().zip(other).all(|(a, b)| ((a - b) / 2.0).sin().abs() <= ONE)
}
