//! Which angles may a joint take?

use std::f64::consts::PI;

use crate::interval::Interval;

/// What the number means that a controller reports as joint 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThirdAxis {
    /// The angle of the forearm relative to the upper arm: `theta3 = sign3 q3 - offset3`.
    Elbow,
    /// The absolute angle of the forearm: `theta2 + theta3 = sign3 q3 - offset3`.
    Forearm,
}

/// The ranges a maker states, in the coordinates in which they are stated; radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// On the joint angles as the robot reports them.
    pub joints: [Interval; 6],
    /// What joint 3 reports.
    pub third_axis: ThirdAxis,
    /// On the angle enclosed by upper arm and forearm axis, `pi - theta3`: pi is straight, smaller is folded forwards.
    pub elbow: Interval,
    /// Largest speed of each joint, rad/s; not a limit on postures.
    pub speeds: Option<[f64; 6]>,
}

impl Limits {
    /// Other limits leave joint 3 no choice between angles that are whole turns apart.
    pub(crate) fn third_is_wound(&self) -> bool {
        let one_turn = |range: Interval| range.width() < 2.0 * PI;
        one_turn(self.elbow) && (self.third_axis == ThirdAxis::Elbow || one_turn(self.joints[1]))
    }
}
