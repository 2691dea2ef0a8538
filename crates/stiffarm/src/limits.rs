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

/// Does the robot's pendant show the joint angles as its robot file counts them: zeros, signs, and what joint 3 counts from?
#[derive(Clone, Debug, PartialEq)]
pub enum Pendant {
    /// Nobody says it.
    Unknown,
    /// It is published; the robot's `source` says where, under [`PENDANT_SOURCE`].
    AsFile,
    /// Readings of the very robot agree with its file.
    Verified(Verified),
    /// Whoever asks says that it does.
    Given,
}

/// Under which key of a robot's `source` it stands how its pendant counts, or why that is not known.
pub const PENDANT_SOURCE: &str = "pendant";

/// How joints and positions that were read from a pendant agree with the robot file.
#[derive(Clone, Debug, PartialEq)]
pub struct Verified {
    /// How many postures were read.
    pub rows: usize,
    /// When, as year-month-day.
    pub date: String,
    /// The largest distance between a position as read and as the file has it, m.
    pub largest: f64,
}

impl Pendant {
    /// The name that robot files and answers use.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::AsFile => "as-file",
            Self::Verified(_) => "verified",
            Self::Given => "given",
        }
    }
}

/// The ranges a maker states, in the coordinates in which they are stated; radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// On the joint angles as the robot reports them.
    pub joints: [Interval; 6],
    /// What joint 3 reports.
    pub third_axis: ThirdAxis,
    /// Whether that is what the robot's pendant shows.
    pub pendant: Pendant,
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
