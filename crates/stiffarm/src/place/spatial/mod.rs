//! Verb 3 in space: all six drives, the tool where it is, a flat zone anywhere about the robot.

mod bound;
mod evaluate;
mod field;
mod order;
mod search;

use std::f64::consts::FRAC_PI_2;

pub use field::{ZonePoint, across_zone};

use super::{NOTHING, Orientation, PlaceError, Within, check_force, check_zone};
use crate::batch::SpatialArm;
use crate::compliance::{PostureError, check_held};
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::task::Zone;

/// What is asked besides robot and zone.
///
/// The zone is a flat patch that the tool axis meets at a right angle. Its centre lies in the plane through the joint-1
/// axis that points straight ahead, before the robot or behind it; by symmetry this is any place about the robot, and joint 1 turns there as far as its
/// range is wide enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialOptions {
    /// Cutting force, N, in its worst direction at every point.
    pub force: f64,
    /// The tool frame in the flange frame; z is the tool axis.
    pub flange_from_tool: Pose,
    /// Angle of the tool axis above the horizontal, rad: `-pi/2` down, `0` ahead, `pi/2` up.
    pub elevation: f64,
    /// Angles of the zone's plane about the vertical that are tried, rad: at 0 it faces the robot, beyond a quarter turn
    /// the tool points back at it. A tool that points straight down or up has none.
    pub yaw: Interval,
    /// Which angles of a rectangle in its plane are tried: 0 has the first side ahead (on a wall: upright), a quarter turn to
    /// the left.
    pub orientation: Orientation,
    /// Rotation about the tool axis, rad, the same for the whole zone: 0 has the tool's x axis ahead (on a wall: upright;
    /// overhead: back); the best where `None`.
    pub roll: Option<f64>,
    /// Where the zone may stand: x from the joint-1 axis straight ahead, negative behind it, z from the base, all of the zone
    /// inside.
    pub within: Within,
}

impl SpatialOptions {
    /// Tool down, the flange itself as the tool, any roll, anywhere in front of the base and above its floor.
    pub fn tool_down(force: f64) -> Self {
        Self {
            force,
            flange_from_tool: Pose::identity(),
            elevation: -FRAC_PI_2,
            yaw: Interval::spanning(-FRAC_PI_2, FRAC_PI_2),
            orientation: Orientation::Axes,
            roll: None,
            within: Within { x: Interval::POSITIVE, z: Interval::POSITIVE },
        }
    }

    /// The tool axis is vertical: the zone's yaw and its angle are the same thing.
    pub(crate) fn is_vertical(&self) -> bool {
        FRAC_PI_2 - self.elevation.abs() < 1e-9
    }

    fn check(&self, zone: Zone) -> Result<(), PlaceError> {
        check_force(self.force)?;
        check_zone(zone)?;
        let mut angles = vec![self.elevation];
        angles.extend([self.yaw.min(), self.yaw.max()]);
        angles.extend(self.roll);
        if let Orientation::Fixed(angle) = self.orientation {
            angles.push(angle);
        }
        if let Some(angle) = angles.iter().find(|angle| !(angle.abs() <= 1e3)) {
            return Err(PlaceError::Angle(*angle));
        }
        if FRAC_PI_2 + 1e-9 < self.elevation.abs() {
            return Err(PlaceError::Elevation(self.elevation));
        }
        Ok(())
    }
}

/// How finely a place was looked for, and what that leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Distance between the places of the coarse search, m.
    pub coarse_step: f64,
    /// The best value of the coarse search, m.
    pub coarse: f64,
    /// The last step of the refinement, m.
    pub fine_step: f64,
    /// The last step of the refinement, rad.
    pub fine_turn: f64,
    /// Distance between the poses in the zone at which the value was found, m.
    pub sample_step: f64,
    /// How many they are.
    pub samples: usize,
    /// By how much the value grew, relatively, when that distance was halved last.
    pub halving: f64,
    /// Boxes of places behind the lower bound.
    pub boxes: usize,
}

/// The best place that was found for a zone. Lengths in m from the base, x straight ahead, z up.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialPlacement {
    /// The largest deflection in the zone, any direction of the force.
    pub deflection: f64,
    /// No place that was allowed has less: proved, up to a relative 1e-9 for rounding.
    pub lower_bound: f64,
    /// Centre of the zone: ahead and up.
    pub centre: [f64; 2],
    /// Where about the joint-1 axis it stands, rad; zero unless a limit of joint 1 forbids straight ahead.
    pub bearing: f64,
    /// Of the zone's plane about the vertical, rad.
    pub yaw: f64,
    /// Of the first side in the plane, rad; zero for a circle.
    pub angle: f64,
    /// About the tool axis, rad.
    pub roll: f64,
    /// The posture, throughout the zone.
    pub configuration: Configuration,
    /// Where in the zone the deflection is largest: in the axes of the base, the zone at its bearing.
    pub worst_point: [f64; 3],
    /// Distance of the zone's nearest point from the joint-1 axis, m: the robot's own base and column stand there.
    pub from_axis_1: f64,
    /// Joint angles there as the robot reports them, rad.
    pub worst_joints: [f64; 6],
    /// Deflection along the force's worst direction by drive, adding up to 1.
    pub worst_shares: [f64; 6],
    /// The smallest distance of any joint to its limits anywhere in the zone, rad, proved, and that joint from 1; 0 is the angle
    /// between the links.
    pub limit_margin: (f64, usize),
    /// The smallest angle between a singular posture (wrist or arm straight) and one in the zone, rad, proved.
    pub singular_margin: f64,
    /// What stands behind these numbers.
    pub resolution: Resolution,
}

impl SpatialPlacement {
    /// How far the lower bound lies below the value, relative to it; 0 where nothing gives way.
    pub fn gap(&self) -> f64 {
        if self.deflection <= NOTHING { 0.0 } else { 1.0 - self.lower_bound / self.deflection }
    }
}

/// Why no place was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpatialMisfit {
    /// The window is narrower than the zone.
    WindowTooNarrow,
    /// No single point with this direction of the tool.
    NothingReached,
    /// Points are reached, but nowhere the whole zone in one posture.
    ZoneTooLarge {
        /// The coarsest step of the search for one, m.
        step: f64,
    },
    /// The zone is reached, but a joint would have to turn by more than it can on the way through it.
    Turning,
}

impl std::fmt::Display for SpatialMisfit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::WindowTooNarrow => f.write_str("the allowed place is narrower than the zone"),
            Self::NothingReached => f.write_str("no point of the allowed place is reached with this direction of the tool"),
            Self::ZoneTooLarge { step } => write!(
                f,
                "no place was found (places {:.0} mm apart, then refined) where the whole zone is reached in one posture",
                step * 1e3
            ),
            Self::Turning => f.write_str(
                "the zone is reached, but not in one go: within it a joint passes a singular posture or the end of its range",
            ),
        }
    }
}

/// The answer of [`place_in_space`].
#[derive(Clone, Debug, PartialEq)]
pub enum SpatiallyPlaced {
    /// A place was found.
    Feasible(Box<SpatialPlacement>),
    /// None was found.
    Infeasible {
        /// Why.
        reason: SpatialMisfit,
        /// There is none: not between the places that were looked at either.
        is_proved: bool,
    },
}

impl SpatiallyPlaced {
    /// The placement, where there is one.
    pub fn feasible(&self) -> Option<&SpatialPlacement> {
        match self {
            Self::Feasible(placement) => Some(placement),
            Self::Infeasible { .. } => None,
        }
    }
}

/// A question in space that has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpatialPlaceError {
    /// Robot or tool make no sense.
    #[error(transparent)]
    Posture(#[from] PostureError),
    /// Zone, force or angles make no sense.
    #[error(transparent)]
    Place(#[from] PlaceError),
}

/// Finds the place of a flat zone that minimises the worst deflection inside it, all six drives compliant.
///
/// One posture and one roll hold throughout the zone. Every limit is kept everywhere in it, and no joint turns by a quarter turn
/// from where it is at the centre: both are proved by enclosures of the joints over parts of the zone. Places keep
/// 0.001 rad from a straight wrist or arm, and the wrist centre a thousandth of the upper arm from the joint-1 axis. The
/// deflection is the largest of samples. The search is coarse over all places, then refined from the best ones; it is
/// deterministic, and [`Resolution`] says how finely it looked. A branch and bound over all places then proves a lower bound
/// (\[theory\], section 7), within 1 % of the value where a bounded number of boxes is enough for that.
///
/// # Errors
/// Where an argument makes no sense.
pub fn place_in_space(
    robot: &Robot,
    zone: Zone,
    options: &SpatialOptions,
) -> Result<SpatiallyPlaced, SpatialPlaceError> {
    options.check(zone)?;
    let arm = SpatialArm::new(robot, &options.flange_from_tool)?;
    check_held(robot)?;
    Ok(search::search(robot, &arm, zone, options))
}
