//! How may a controller count the joints of an arm? Zeros, signs, what joint 3 is measured from, and joints that others carry along.

use nalgebra::Matrix6;

use crate::chain::Chain;
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, ThirdAxis};
use crate::robot::{Arm, Robot};

/// Which joints of the wrist are carried along by others: parts of theta 4 in 5, of 4 in 6, and of 5 in 6.
pub type Carried = [f64; 3];

/// `theta = D (sign q - offset)`, with `D` the unit matrix but for the joints that others carry along; rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Convention {
    /// What joint 3 is measured from.
    pub third_axis: ThirdAxis,
    /// +1 or -1 of each joint.
    pub sign: [f64; 6],
    /// The zero offsets of a robot file, rad.
    pub offset: [f64; 6],
    /// Of the wrist; a robot file cannot say it where it is not zero.
    pub carried: Carried,
}

impl Convention {
    /// As a robot file counts.
    pub fn of(geometry: &Geometry, limits: &Limits) -> Self {
        let Geometry { offset, sign, .. } = *geometry;
        Self { third_axis: limits.third_axis, sign, offset, carried: [0.0; 3] }
    }

    /// `D`.
    fn mixed(&self) -> Matrix6<f64> {
        let mut mixed = Matrix6::identity();
        if self.third_axis == ThirdAxis::Forearm {
            mixed[(2, 1)] = -1.0;
        }
        [mixed[(4, 3)], mixed[(5, 3)], mixed[(5, 4)]] = self.carried;
        mixed
    }

    /// The flange at reported angles, and how it moves with an added angle at each of the joints `free`.
    pub(super) fn chain(&self, geometry: &Geometry, free: &[usize], added: &[f64], q: &[f64; 6]) -> Chain {
        let mut counted: [f64; 6] = std::array::from_fn(|i| self.sign[i] * q[i] - self.offset[i]);
        for (joint, angle) in free.iter().zip(added) {
            counted[*joint] += angle;
        }
        let mixed = self.mixed();
        let theta: [f64; 6] = (mixed * nalgebra::Vector6::from(counted)).into();
        let turned = geometry.jacobian(&theta, &nalgebra::Vector3::zeros()) * mixed;
        let twists = free.iter().map(|&joint| {
            let column = turned.column(joint);
            [column.fixed_rows::<3>(0).into(), column.fixed_rows::<3>(3).into()]
        });
        Chain { flange: geometry.forward(&theta), twists: twists.collect() }
    }

    /// The same with added angles taken into the zero offsets.
    pub(super) fn added(&self, free: &[usize], added: &[f64]) -> Self {
        let mut changed = self.clone();
        for (joint, angle) in free.iter().zip(added) {
            changed.offset[*joint] -= angle;
        }
        changed
    }

    /// The other sign of a joint, about an angle as reported at which both are the same.
    pub(super) fn flipped(&self, joint: usize, about: f64) -> Self {
        let mut changed = self.clone();
        changed.sign[joint] = -self.sign[joint];
        changed.offset[joint] -= 2.0 * self.sign[joint] * about;
        changed
    }

    /// Joint 3 from the other line; the same angle where the upper arm stands at `theta_2`.
    pub(super) fn with_third(&self, theta_2: f64) -> Self {
        let mut changed = self.clone();
        (changed.third_axis, changed.offset[2]) = match self.third_axis {
            ThirdAxis::Elbow => (ThirdAxis::Forearm, self.offset[2] - theta_2),
            ThirdAxis::Forearm => (ThirdAxis::Elbow, self.offset[2] + theta_2),
        };
        changed
    }

    /// In how much it differs from another, in words; nothing where it does not.
    pub fn differences(&self, other: &Self) -> Vec<String> {
        /// rad: zeros that are no more apart are the same, as they are shown.
        const SAME: f64 = 0.0005 * std::f64::consts::PI / 180.0;
        let mut found = Vec::new();
        if self.third_axis != other.third_axis {
            found.push(match self.third_axis {
                ThirdAxis::Elbow => "joint 3 counts from the upper arm".to_owned(),
                ThirdAxis::Forearm => "joint 3 counts from the horizontal".to_owned(),
            });
        }
        for i in 0..6 {
            if self.sign[i] != other.sign[i] {
                found.push(format!("joint {} counts the other way", i + 1));
            }
            // The zero is reported as the joint angle at which the arm stands as at model zero.
            let away = crate::angle::wrapped(self.offset[i] - other.offset[i]);
            if SAME < away.abs() {
                found.push(format!("zero of joint {} is {:+.3} deg off", i + 1, away.to_degrees()));
            }
        }
        for (part, what) in self.carried.iter().zip(["4 turns joint 5", "4 turns joint 6", "5 turns joint 6"]) {
            if *part != 0.0 {
                found.push(format!("joint {what} along ({part:+})"));
            }
        }
        found
    }

    /// The robot that counts so, its ranges where they were in space; and what must be looked at in them.
    pub(super) fn written(&self, robot: &Robot) -> (Robot, Vec<String>) {
        let mut changed = robot.clone();
        let mut remarks = Vec::new();
        let Arm::SixAxis { geometry, limits, .. } = &mut changed.arm else { return (changed, remarks) };
        let old = Self::of(geometry, limits);
        let stood: [Interval; 6] = std::array::from_fn(|i| geometry.theta(i, limits.joints[i]));
        for (i, stood) in stood.iter().enumerate() {
            let changes = self.sign[i] != old.sign[i] || self.offset[i] != old.offset[i];
            if changes && (i != 2 || self.third_axis == old.third_axis) {
                limits.joints[i] = stood.affine(self.sign[i], self.sign[i] * self.offset[i]);
                remarks.push(format!(
                    "the range of joint {} is where it was in space: compare it with the pendant's",
                    i + 1
                ));
            }
        }
        if self.third_axis != old.third_axis {
            let other = match self.third_axis {
                ThirdAxis::Forearm => stood[1].plus(stood[2]),
                ThirdAxis::Elbow => stood[2].plus(stood[1].affine(-1.0, 0.0)),
            };
            limits.joints[2] = other.affine(self.sign[2], self.sign[2] * self.offset[2]);
            if self.third_axis == ThirdAxis::Forearm && limits.elbow.is_all() && stood[2].is_bounded() {
                // theta 3 was limited: as the angle that the links enclose it still is.
                let enclosed = stood[2].affine(-1.0, std::f64::consts::PI);
                let all = Interval::spanning(0.0, 2.0 * std::f64::consts::PI);
                limits.elbow = enclosed.intersect(all).unwrap_or(limits.elbow);
            }
            remarks.push("joint 3 counts from another line: its range is as wide as the old ranges allow; write the pendant's own into joint_deg".into());
        }
        (geometry.sign, geometry.offset, limits.third_axis) = (self.sign, self.offset, self.third_axis);
        (changed, remarks)
    }
}
