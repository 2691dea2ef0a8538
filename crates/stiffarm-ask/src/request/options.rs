//! How do the parsed of a request become options of the solvers, with the usual answer where nothing is said?

use super::notation::Angle;
use super::opt;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::ModelKind;
use stiffarm::place::{Margins, Orientation, PlaceOptions, ToolOrientation, Within};
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Zone};

/// What is asked of a placement, whatever the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceRequest {
    /// Cutting force.
    pub load: Load,
    /// Where the zone may stand, m from the robot's base.
    pub within: Option<Within>,
    /// What every place keeps.
    pub margins: Margins,
    /// Of a rectangle.
    pub angle: Angle,
    /// Largest relative distance between a value and its proof; that of the paper's options where `None`.
    pub gap: Option<f64>,
}

/// How the tool is held, in space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolPose {
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
pub enum Unsupported {
    /// On a table no side is the upper one.
    #[error(
        "horizontal and vertical mean the long side on a wall; on a table give degrees, 0 has the first side ahead"
    )]
    LongSide,
    /// Of a circle every angle is alike.
    #[error("turns no circle; the feed of a force counts from straight ahead there")]
    Round,
    /// A vertical tool has no yaw.
    #[error("turns nothing where the tool points straight down or up; the angle of the zone does")]
    Yaw,
    /// A cell has three dimensions.
    #[error("with a y range, or more than one window, needs the spatial model")]
    CellInPlane,
    /// A cell has a floor.
    #[error(
        "counts from the base; with --mount, windows with y, --keep-out or --clearance-mm the floor is that of the cell"
    )]
    Floor,
    /// On a wall only the vertical has one direction.
    #[error("on a mount that leans the tool points down or up")]
    Leaning,
    /// Two numbers say nothing of the third direction.
    #[error(
        "gives x and z alone, and a base that neither stands upright nor hangs may have the work at any y; --within x0..x1,y0..y1,z0..z1 as wide as the task names one place"
    )]
    Beside,
    /// A box without an end.
    #[error("keeps all the world free; expected a box of which one end at least is given, such as 1.0..2.0,..,..")]
    Everything,
    /// Only a flat zone has a middle that means something.
    #[error("is the middle of one flat zone; expected one task that is no part")]
    Middle,
    /// Of a place that is given nothing is searched.
    #[error("free is searched; at one place give degrees, 0 has the first side ahead")]
    FreeAtOnePlace,
    /// The same of a wall.
    #[error("a range is searched; at one place give one angle, such as 0")]
    YawAtOnePlace,
    /// A figure needs a range with a width.
    #[error("both ends are the same; expected such as 0..5")]
    Scale,
}

impl Unsupported {
    /// The option that says it.
    pub(super) const fn setting(self) -> &'static str {
        match self {
            Self::LongSide | Self::Round | Self::FreeAtOnePlace => opt::ANGLE.name,
            Self::Middle | Self::Beside => opt::AT.name,
            Self::Yaw | Self::YawAtOnePlace => opt::YAW_DEG.name,
            Self::CellInPlane => opt::WITHIN.name,
            Self::Everything => opt::KEEP_OUT.name,
            Self::Leaning => opt::TOOL_DIRECTION.name,
            Self::Floor => opt::FLOOR.name,
            Self::Scale => opt::SCALE.name,
        }
    }
}

impl PlaceRequest {
    /// The options of a model for one zone, or for zones of any shape where there is none.
    ///
    /// # Errors
    /// Where the spatial model has no answer.
    pub fn options(&self, model: &ModelKind, tool: &ToolPose, zone: Option<Zone>) -> Result<PlaceOptions, Unsupported> {
        let asked = PlaceOptions {
            within: self.within,
            gap: self.gap,
            margins: self.margins,
            ..PlaceOptions::under(self.load)
        };
        match model {
            ModelKind::Planar => {
                let zone = zone.unwrap_or(Zone::Circle { diameter: 1.0 }); // which side is long matters of one zone only
                Ok(PlaceOptions { orientation: self.angle.orientation(zone), ..asked })
            }
            ModelKind::Spatial(_) => {
                let (tool_orientation, orientation) = (tool.tool_orientation()?, self.on_a_plane(tool, zone)?);
                Ok(PlaceOptions { orientation, tool_orientation: Some(tool_orientation), ..asked })
            }
        }
    }

    /// Of a rectangle on a table or a wall.
    fn on_a_plane(&self, tool: &ToolPose, zone: Option<Zone>) -> Result<Orientation, Unsupported> {
        let is_wall = !ToolOrientation::tool_at(tool.elevation()).is_vertical();
        // On a wall 0 has the first side upright.
        let long_side_at = |upright: f64, lying: f64| {
            zone.map_or(Orientation::Axes, |zone| {
                let [first, second] = zone.sides();
                Orientation::Fixed(if second <= first { upright } else { lying }.to_radians())
            })
        };
        match self.angle {
            Angle::Axes => Ok(Orientation::Axes),
            Angle::Free => Ok(Orientation::Free),
            Angle::Degrees(angle) => Ok(Orientation::Fixed(angle.to_radians())),
            Angle::Horizontal | Angle::Vertical if !is_wall => Err(Unsupported::LongSide),
            Angle::Vertical => Ok(long_side_at(0.0, 90.0)),
            Angle::Horizontal => Ok(long_side_at(90.0, 0.0)),
        }
    }
}

impl ToolPose {
    fn tool_orientation(&self) -> Result<ToolOrientation, Unsupported> {
        let usual = ToolOrientation::tool_at(self.elevation());
        if self.yaw.is_some() && usual.is_vertical() {
            return Err(Unsupported::Yaw);
        }
        Ok(ToolOrientation { yaw: self.yaw.unwrap_or(usual.yaw), roll: self.roll(), ..usual })
    }

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
        if !kept.iter().any(|known| known.work.is_same(&task.work)) {
            kept.push(task.clone());
        }
    }
    kept
}
