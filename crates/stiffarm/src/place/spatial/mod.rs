//! The best place of a flat zone in space: coarse over all places, refined from the best, with a proved lower bound.

mod bound;
mod clearance;
mod descent;
mod evaluate;
mod field;
mod in_cell;
mod order;
mod part;
mod score;
mod search;
mod site;

use std::f64::consts::FRAC_PI_2;

use nalgebra::Matrix3;

pub use field::ZonePoint;
pub(super) use field::deflection_field;
pub(super) use part::place as place_part;

use super::{
    Hold, Margins, Misfit, Orientation, Outside, PlaceError, PlaceOptions, Placed, Placement, SpaceHold,
    ToolOrientation, Within,
};
use crate::cell::Cell;
use crate::clearance::Clearance;
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::load::{Forces, Load};
use crate::model::{ModelKind, SpatialModel};
use crate::task::Zone;
use crate::watch::{Parts, Watch};

/// What is asked, with nothing left open.
#[derive(Clone, Copy, Debug)]
struct Question<'a> {
    /// Who waits for the answer.
    parts: &'a Parts<'a>,
    /// N.
    force: f64,
    /// The same with its direction.
    load: Load,
    /// As [`ToolOrientation::elevation`].
    elevation: f64,
    /// As [`ToolOrientation::yaw`].
    yaw: Interval,
    orientation: Orientation,
    /// As [`ToolOrientation::roll`].
    roll: Option<f64>,
    /// With the floor.
    within: Within,
    /// Radius about the joint-1 axis that the zone keeps free, m.
    column: f64,
    margins: Margins,
    /// What is known of the place where the robot works.
    cell: Option<Cell>,
}

impl<'a> Question<'a> {
    /// `None` where the floor leaves nothing of the window.
    fn of(model: &SpatialModel, options: &PlaceOptions, parts: &'a Parts<'a>) -> Result<Option<Self>, PlaceError> {
        if options.gap.is_some() {
            return Err(PlaceError::Inapplicable { what: "a gap", model: "planar" });
        }
        let ToolOrientation { elevation, yaw, roll } = options.tool_orientation();
        let angles = [elevation, yaw.min(), yaw.max(), roll.unwrap_or(0.0)];
        if let Some(angle) = angles.into_iter().find(|angle| !(angle.abs() <= 1e3)) {
            return Err(PlaceError::Angle(angle));
        }
        if FRAC_PI_2 + 1e-9 < elevation.abs() {
            return Err(PlaceError::Elevation(elevation));
        }
        let margins = options.margins;
        let within = options.within(&ModelKind::Spatial(*model.flange_from_tool()));
        Ok(margins.part_of(within, model.robot()).map(|within| Self {
            parts,
            force: options.load.newtons(),
            load: options.load,
            elevation,
            yaw,
            orientation: options.orientation,
            roll,
            within,
            column: margins.radius(model.robot()),
            margins,
            cell: options.cell,
        }))
    }

    /// Angles of the first side that a coarse search tries, rad: of those that may be any, every 15 deg up to where the zone gives way as at
    /// the first.
    fn angles(&self) -> Vec<f64> {
        let period = self.load.period_of_turns();
        let every = |step_deg: f64| {
            let count = (period.to_degrees() / step_deg).round() as usize;
            (0..count).map(|i| (i as f64 * step_deg).to_radians()).collect()
        };
        match self.orientation {
            Orientation::Axes => every(90.0),
            Orientation::Fixed(angle) => vec![angle],
            Orientation::Free => every(15.0),
        }
    }

    /// The tool axis is vertical: the zone's yaw and its angle are the same thing.
    fn is_vertical(&self) -> bool {
        ToolOrientation { elevation: self.elevation, yaw: self.yaw, roll: self.roll }.is_vertical()
    }
}

/// How finely a place was looked for, and what that leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Distance between the places of the coarse search, m; zero at one place.
    pub coarse_step: f64,
    /// The best value of the coarse search, m; `None` where it saw no whole zone.
    pub coarse: Option<f64>,
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

/// The best place that was found, as [`Placement`] and [`SpaceHold`] have it.
#[derive(Clone, Debug)]
struct Solution {
    deflection: f64,
    lower_bound: f64,
    centre: [f64; 2],
    bearing: f64,
    yaw: f64,
    angle: f64,
    roll: f64,
    configuration: Configuration,
    worst_point: [f64; 3],
    from_axis_1: f64,
    outside: Outside,
    worst_joints: [f64; 6],
    worst_shares: [f64; 6],
    by_drive: Vec<[Matrix3<f64>; 6]>,
    worst_forces: Option<Forces>,
    limit_margin: (f64, usize),
    singular_margin: f64,
    clearance: Option<Clearance>,
    resolution: Resolution,
}

impl From<Solution> for Placement {
    fn from(found: Solution) -> Self {
        Self {
            deflection: found.deflection,
            lower_bound: found.lower_bound,
            centre: found.centre,
            angle: found.angle,
            elbow: found.configuration.elbow,
            worst_point: found.worst_point,
            from_axis_1: Some(found.from_axis_1),
            outside: Some(found.outside),
            clearance_in_space: found.clearance,
            hold: Hold::Space(Box::new(found.hold())),
            faces: Vec::new(),
        }
    }
}

impl Solution {
    fn hold(&self) -> SpaceHold {
        SpaceHold {
            bearing: self.bearing,
            yaw: self.yaw,
            roll: self.roll,
            configuration: self.configuration,
            joints: self.worst_joints,
            shares: self.worst_shares,
            by_drive: self.by_drive.clone(),
            forces: self.worst_forces,
            limit_margin: self.limit_margin,
            singular_margin: self.singular_margin,
            resolution: self.resolution,
        }
    }
}

/// The best place with what could be proved of it, or why none was found.
pub(super) fn place(
    model: &SpatialModel,
    zone: Zone,
    options: &PlaceOptions,
    watch: Watch,
) -> Result<Placed, PlaceError> {
    let parts = watch.parts(None);
    // A circle has no sides to turn: from straight ahead its feed counts.
    let orientation = if zone.is_round() { Orientation::Fixed(0.0) } else { options.orientation };
    let options = &PlaceOptions { orientation, ..*options };
    let nothing_left = || Placed::Infeasible { reason: Misfit::Margins, is_proved: true, largest_scale: None };
    let Some(question) = Question::of(model, options, &parts)? else { return Ok(nothing_left()) };
    let Margins { limit, singular, .. } = question.margins;
    let Some(arm) = model.arm.with_margins(limit, singular) else { return Ok(nothing_left()) };
    if let Some(cell) = question.cell.filter(Cell::decides_the_search) {
        return Ok(in_cell::search(model.robot(), &arm, zone, &question, &cell)?);
    }
    let placed = search::search(model.robot(), &arm, zone, &question)?;
    let bare = PlaceOptions { margins: Margins::NONE, ..*options };
    match (placed, Question::of(model, &bare, &parts)?) {
        (Placed::Infeasible { is_proved, largest_scale, .. }, Some(bare))
            if options.margins != Margins::NONE && search::has_place(model.robot(), &model.arm, zone, &bare)? =>
        {
            Ok(Placed::Infeasible { reason: Misfit::Margins, is_proved, largest_scale })
        }
        (placed, _) => Ok(placed),
    }
}
