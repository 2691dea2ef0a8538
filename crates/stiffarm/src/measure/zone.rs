//! In which postures is a zone machined?

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::MeasureError;
use crate::inverse::reached;
use crate::load::Load;
use crate::model::ModelKind;
use crate::place::{PlaceError, PlaceOptions, place};
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::task::Zone;
use crate::watch::Watch;
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// Postures, as reported, rad, all over a zone at its best place, the tool down, in the configuration in which it is held there.
///
/// # Errors
/// Where it has no place, and [`MeasureError::Stopped`] where the work is no longer wanted.
pub fn over(robot: &Robot, flange_from_tool: &Pose, zone: Zone, watch: Watch) -> Result<Vec<[f64; 6]>, MeasureError> {
    let no_place = |why: String| MeasureError::NoPlace(format!("{}: {why}", robot.name));
    let model = ModelKind::Spatial(*flange_from_tool).of(robot).map_err(|error| no_place(error.to_string()))?;
    let placed = place(&model, &zone.into(), &PlaceOptions::careful(Load::PAPER), watch);
    let placed = placed.map_err(|error| match error {
        PlaceError::Stopped(stopped) => stopped.into(),
        other => no_place(other.to_string()),
    })?;
    let found = placed.feasible().and_then(|best| Some((best, best.space()?)));
    let (best, hold) =
        found.ok_or_else(|| no_place("the zone has no place (`stiffarm place --model spatial` says why)".into()))?;
    let [x, z] = best.centre;
    let work = WorkPlacement { x, y: 0.0, z, yaw: hold.yaw, angle: best.angle, roll: hold.roll };
    let plane = WorkPlane::of(-FRAC_PI_2, &work);
    let bearing = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), hold.bearing);
    let turned = Pose::from_parts(Translation3::identity(), bearing);
    let tool_to_flange = flange_from_tool.inverse();
    let posture = |at: &[f64; 2]| {
        let flange = turned * plane.pose(&work, *at) * tool_to_flange;
        reached(robot, &flange)
            .into_iter()
            .find(|(configuration, _)| *configuration == hold.configuration)
            .map(|(_, q)| q)
    };
    let found: Vec<[f64; 6]> = Grid::of(zone, 4).points.iter().filter_map(posture).collect();
    if found.is_empty() { Err(no_place("the zone is not reached where it was placed".into())) } else { Ok(found) }
}
