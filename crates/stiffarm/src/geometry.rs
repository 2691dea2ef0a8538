//! Where do the joints and the tool stand?

use std::f64::consts::FRAC_PI_2;

use crate::limits::{Range, ThirdAxis};

/// An arm with a spherical wrist: the seven lengths, zero offsets and signs of [OPW].
///
/// `theta_i = sign_i q_i - offset_i`, and the flange stands at
/// `T = Rz(t1) Tr(a1,b,c1) Ry(t2) Tr(0,0,c2) Ry(t3) Tr(a2,0,c3) Rz(t4) Ry(t5) Rz(t6) Tr(0,0,c4)`.
/// At model zero, upper arm and forearm stand upright. Lengths in m, angles in rad, base frame z up, x forward.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Joint 1 axis to joint 2 axis, forwards.
    pub a1: f64,
    /// Elbow to forearm axis, forwards at model zero (negative on most arms: the forearm lies above the elbow).
    pub a2: f64,
    /// Sideways offset of the arm plane from the joint 1 axis.
    pub b: f64,
    /// Floor to joint 2 axis.
    pub c1: f64,
    /// Upper arm, the paper's `l2`.
    pub c2: f64,
    /// Elbow to wrist centre along the forearm.
    pub c3: f64,
    /// Wrist centre to flange.
    pub c4: f64,
    /// Zero offsets of the six joints.
    pub offset: [f64; 6],
    /// +1 or -1 for each joint.
    pub sign: [f64; 6],
}

impl Geometry {
    /// The paper's `l3 = hypot(a3, d4)`: elbow to wrist centre in a straight line.
    pub fn l3(&self) -> f64 {
        self.a2.hypot(self.c3)
    }

    /// How far the line elbow - wrist centre leans forwards of the forearm axis: `delta = atan2(a2, c3)`.
    fn lean(&self) -> f64 {
        self.a2.atan2(self.c3)
    }

    /// The range of a model angle `theta_i` (rad) from the range of joint `i` (0 to 5) as reported.
    fn theta(&self, i: usize, reported: Range) -> Range {
        reported.affine(self.sign[i], -self.offset[i])
    }

    /// The shoulder angle of the arm plane, `pi/2 - theta2`: of the upper arm, counter-clockwise from straight ahead.
    pub fn shoulder(&self, joint_2: Range) -> Range {
        self.theta(1, joint_2).affine(-1.0, FRAC_PI_2)
    }

    /// What joint 3 limits in the arm plane, counter-clockwise: the elbow `-delta - theta3` (relative), or the forearm
    /// `pi/2 - delta - (theta2 + theta3)` (absolute), as `third_axis` says.
    pub fn third(&self, joint_3: Range, third_axis: ThirdAxis) -> Range {
        let upright = match third_axis {
            ThirdAxis::Elbow => 0.0,
            ThirdAxis::Forearm => FRAC_PI_2,
        };
        self.theta(2, joint_3).affine(-1.0, upright - self.lean())
    }

    /// The elbow angle of the arm plane from the enclosed angle `phi = pi - theta3`: `-delta - pi + phi`.
    pub fn elbow(&self, enclosed: Range) -> Range {
        enclosed.affine(1.0, -self.lean() - std::f64::consts::PI)
    }

    /// Wrist centre in the base frame for the six reported joint angles, rad.
    pub fn wrist_centre(&self, q: [f64; 6], third_axis: ThirdAxis) -> [f64; 3] {
        let theta = |i: usize| self.sign[i] * q[i] - self.offset[i];
        let t2 = theta(1);
        let t23 = match third_axis {
            ThirdAxis::Elbow => t2 + theta(2),
            ThirdAxis::Forearm => theta(2),
        };
        let x = self.a1 + self.c2 * t2.sin() + self.a2 * t23.cos() + self.c3 * t23.sin();
        let z = self.c1 + self.c2 * t2.cos() - self.a2 * t23.sin() + self.c3 * t23.cos();
        let (s1, c1) = theta(0).sin_cos();
        [c1 * x - s1 * self.b, s1 * x + c1 * self.b, z]
    }
}
