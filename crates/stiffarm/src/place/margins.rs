//! How far do places keep from what no engineer would choose: joint limits, straight postures, the robot's own column, the floor?

use std::f64::consts::FRAC_PI_2;

use super::{PlaceError, Within};
use crate::interval::Interval;
use crate::robot::{Arm, Robot};

/// The column of a robot as a part of the length of its links, beside the distance of the joint-2 axis from that of joint 1.
const COLUMN: f64 = 0.15;

/// Distances that every place keeps, all over the zone. They are constraints: the search and its certificate hold them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// From either end of every joint's range, and of the range of the angle between the links, rad.
    pub limit: f64,
    /// From a straight wrist or arm, rad.
    pub singular: f64,
    /// Of the zone from the joint-1 axis.
    pub column: Column,
    /// All of the zone stands in front of the joint-1 axis.
    pub front: bool,
    /// Height of the floor from the robot's base, m; all of the zone stands above it.
    pub floor: Option<f64>,
}

/// The upright cylinder about the joint-1 axis, of any height, that a zone leaves to the robot itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column {
    /// The robot's own, by its file or estimated from its lengths: [`column_radius`].
    Own,
    /// Of this radius, m; zero leaves the zone free to stand anywhere.
    Radius(f64),
}

/// Of what a place keeps the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarginOf {
    /// A limit of this joint, from 1.
    Joint(usize),
    /// A limit of the angle between the links.
    BetweenLinks,
    /// A limit of the forearm's angle in the arm plane.
    Forearm,
    /// A straight wrist or arm, or an arm that is folded up.
    Straight,
}

impl Margins {
    /// None at all: the paper's convention, and that of [`PlaceOptions::under`](super::PlaceOptions::under).
    pub const NONE: Self = Self { limit: 0.0, singular: 0.0, column: Column::Radius(0.0), front: false, floor: None };

    /// What an engineer keeps: 5 deg from limits and straight postures, in front of the robot, clear of its column, above the base.
    pub fn usual() -> Self {
        let margin = 5.0_f64.to_radians();
        Self { limit: margin, singular: margin, column: Column::Own, front: true, floor: Some(0.0) }
    }

    pub(super) fn check(&self) -> Result<(), PlaceError> {
        for (what, value, most) in [
            ("distance from joint limits, rad", self.limit, FRAC_PI_2),
            ("distance from straight postures, rad", self.singular, 1.0),
            ("radius of the column, m", if let Column::Radius(radius) = self.column { radius } else { 0.0 }, 100.0),
        ] {
            if !(0.0 <= value && value <= most) {
                return Err(PlaceError::Margin { what, value, most });
            }
        }
        match self.floor {
            Some(floor) if !(floor.abs() <= 100.0) => Err(PlaceError::Floor(floor)),
            _ => Ok(()),
        }
    }

    /// The radius that a zone keeps from the joint-1 axis of a robot, m; zero where it is not known where that axis stands.
    pub fn radius(&self, robot: &Robot) -> f64 {
        match (column_radius(robot), self.column) {
            (None, _) => 0.0,
            (Some(own), Column::Own) => own,
            (Some(_), Column::Radius(radius)) => radius,
        }
    }

    /// The part of a window in front of a robot and above the floor; all of it where it is not known where the robot's base stands. `None`
    /// where nothing is left.
    pub fn part_of(&self, within: Within, robot: &Robot) -> Option<Within> {
        if !robot.knows_base() {
            return Some(within);
        }
        let x = if self.front { within.x.intersect(Interval::POSITIVE)? } else { within.x };
        let above = self.floor.map_or(Interval::ALL, |floor| Interval::spanning(floor, f64::INFINITY));
        Some(Within { x, z: within.z.intersect(above)? })
    }

    /// The windows that are left of one in an upright plane that passes the joint-1 axis at a distance `aside`, m: before the column, and
    /// behind it; m from the base.
    pub fn windows(&self, within: Within, robot: &Robot, aside: f64) -> Vec<Within> {
        let Some(part) = self.part_of(within, robot) else { return Vec::new() };
        let radius = self.radius(robot);
        let half = (radius * radius - aside * aside).max(0.0).sqrt();
        if half == 0.0 {
            return vec![part];
        }
        let sides = [Interval::spanning(half, f64::INFINITY), Interval::spanning(f64::NEG_INFINITY, -half)];
        sides.into_iter().filter_map(|side| Some(Within { x: part.x.intersect(side)?, ..part })).collect()
    }
}

/// What a robot itself takes up about its joint-1 axis, m: `|a1|` and the radius of its column, where its file says that; else a radius
/// estimated from its lengths, `|a1| + 0.15 (c2 + l3)`. `None` where only two links are known.
///
/// The latter is an estimate, no data-sheet value: the turning column carries joint 2 at `a1`, with a motor, a gear and the lower end of the upper arm about
/// it, whose size grows with the arm.
pub fn column_radius(robot: &Robot) -> Option<f64> {
    match &robot.arm {
        Arm::SixAxis { geometry, .. } => {
            let column = robot.body.map_or(COLUMN * (geometry.c2 + geometry.l3()), |body| body.column);
            Some(geometry.a1.abs() + column)
        }
        Arm::Planar(_) => None,
    }
}
