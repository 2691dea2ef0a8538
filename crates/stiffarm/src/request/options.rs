//! How do the wishes of a request become options of the solvers, with the usual answer where nothing is said?

use super::notation::Angle;
use crate::interval::Interval;
use crate::place::{Orientation, PlaceOptions, SpatialOptions, Within};
use crate::spatial::Pose;
use crate::task::{Task, Zone};

/// What is asked of a placement, whatever the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Cutting force, N.
    pub force: f64,
    /// Where the zone may stand, m from the robot's base; anywhere, or in space in front of the joint-1 axis and above the
    /// base, where `None`.
    pub within: Option<Within>,
    /// Of a rectangle.
    pub angle: Angle,
    /// Largest relative distance between a value and its proof; that of the paper's options where `None`.
    pub gap: Option<f64>,
}

/// How the tool is held, in space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held {
    /// The tool frame in the flange frame; the flange where `None`.
    pub tool: Option<Pose>,
    /// Angle of the tool axis above the horizontal, deg; down where `None`.
    pub elevation_deg: Option<f64>,
    /// Angles of the zone about the vertical, rad; the best of a half turn where `None`.
    pub yaw: Option<Interval>,
    /// About the tool axis, deg; the best where `None`.
    pub roll_deg: Option<f64>,
}

/// What a model cannot be asked; the first word is the name of the option.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unasked {
    /// A proof in space.
    #[error("gap is of the planar model: the spatial search proves 1 % where it can")]
    Gap,
    /// On a table no side is the upper one.
    #[error(
        "angle horizontal and vertical mean the long side on a wall; on a table give degrees, 0 has the first side ahead"
    )]
    LongSide,
    /// A vertical tool has no yaw.
    #[error("yaw-deg turns nothing where the tool points straight down or up; the angle of the zone does")]
    Yaw,
}

impl Wanted {
    /// In the arm plane.
    pub fn planar(&self, zone: Zone) -> PlaceOptions {
        let usual = PlaceOptions::paper(self.force);
        PlaceOptions {
            orientation: self.angle.orientation(zone),
            within: self.within.unwrap_or(usual.within),
            gap: self.gap.unwrap_or(usual.gap),
            ..usual
        }
    }

    /// In space, for zones of any shape.
    ///
    /// # Errors
    /// Where the spatial model has no answer.
    pub fn spatial(&self, held: &Held) -> Result<SpatialOptions, Unasked> {
        if self.gap.is_some() {
            return Err(Unasked::Gap);
        }
        let usual = SpatialOptions::tool_down(self.force);
        if held.yaw.is_some() && (SpatialOptions { elevation: held.elevation(), ..usual }).is_vertical() {
            return Err(Unasked::Yaw);
        }
        let is_wall = held.elevation().abs() < 1.5;
        let orientation = match self.angle {
            Angle::Axes => Orientation::Axes,
            Angle::Free => Orientation::Free,
            Angle::Degrees(angle) => Orientation::Fixed(angle.to_radians()),
            Angle::Horizontal | Angle::Vertical if is_wall => Orientation::Axes,
            Angle::Horizontal | Angle::Vertical => return Err(Unasked::LongSide),
        };
        Ok(SpatialOptions {
            flange_from_tool: held.tool(),
            elevation: held.elevation(),
            yaw: held.yaw.unwrap_or(usual.yaw),
            orientation,
            roll: held.roll(),
            within: self.within.unwrap_or(usual.within),
            ..usual
        })
    }

    /// The same for one zone, of which it is known which side is the long one.
    ///
    /// # Errors
    /// As [`Self::spatial`].
    pub fn spatial_for(&self, held: &Held, zone: Zone) -> Result<SpatialOptions, Unasked> {
        let options = self.spatial(held)?;
        let [first, second] = zone.sides();
        let upright = if second <= first { 0.0 } else { 90.0_f64 };
        let orientation = match self.angle {
            Angle::Vertical => Orientation::Fixed(upright.to_radians()),
            Angle::Horizontal => Orientation::Fixed((90.0 - upright).to_radians()),
            _ => options.orientation,
        };
        Ok(SpatialOptions { orientation, ..options })
    }
}

impl Held {
    /// Of the tool axis above the horizontal, rad.
    pub fn elevation(&self) -> f64 {
        self.elevation_deg.unwrap_or(-90.0).to_radians()
    }

    /// The tool frame in the flange frame.
    pub fn tool(&self) -> Pose {
        self.tool.unwrap_or_else(Pose::identity)
    }

    /// About the tool axis, rad.
    pub fn roll(&self) -> Option<f64> {
        self.roll_deg.map(f64::to_radians)
    }
}

/// Tasks of which no two have the same zone, in their order.
pub fn distinct(tasks: &[Task]) -> Vec<Task> {
    let mut kept: Vec<Task> = Vec::new();
    for task in tasks {
        if !kept.iter().any(|known| known.zone == task.zone) {
            kept.push(task.clone());
        }
    }
    kept
}
