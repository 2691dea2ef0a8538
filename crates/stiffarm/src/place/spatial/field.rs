//! The deflection field of a zone at its place.

use nalgebra::Point2;

use crate::compliance::{PostureError, compliance};
use crate::inverse::posture_of;
use crate::model::{ModelError, SpatialModel};
use crate::place::{PlaceError, PlaceOptions, Placement, SpaceHold};
use crate::work::WorkPlane;

/// A point of a zone at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZonePoint {
    /// Ahead, left, up, m from the base; at bearing zero.
    pub at: [f64; 3],
    /// Under the load, m; absent where the posture of the zone does not lead there.
    pub deflection: Option<f64>,
}

/// As [`deflection_field`](crate::place::deflection_field), held with six drives.
pub(in crate::place) fn deflection_field(
    model: &SpatialModel,
    options: &PlaceOptions,
    placement: &Placement,
    hold: &SpaceHold,
    points: impl IntoIterator<Item = [f64; 2]>,
) -> Result<Vec<ZonePoint>, PlaceError> {
    let (robot, arm) = (model.robot(), model.arm());
    let work = hold.work(placement);
    let plane = WorkPlane::of(options.tool_orientation().elevation, &work);
    let forces = plane.forces(options.load);
    let tool_from_flange = arm.flange_from_tool.inverse();
    let evaluated = |at: Point2<f64>| {
        let pose = plane.pose(&work, at.into());
        let held = posture_of(&arm.geometry, &(pose * tool_from_flange), hold.configuration);
        let deflection = held.map(|theta| {
            let q = arm.geometry.reported(&theta, arm.limits.third_axis);
            let posture = compliance(robot, &q, &arm.flange_from_tool)?;
            Ok::<_, PostureError>(posture.most(forces.as_ref()).value * options.load.newtons())
        });
        let deflection = deflection.transpose().map_err(ModelError::from)?;
        Ok(ZonePoint { at: pose.translation.vector.into(), deflection })
    };
    points.into_iter().map(|at| evaluated(at.into())).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;
    use crate::catalogue::paper_robots;
    use crate::interval::Interval;
    use crate::load::Load;
    use crate::model::Model;
    use crate::place::ToolOrientation;
    use crate::place::{Orientation, deflection_field, place};
    use crate::spatial::Pose;
    use crate::task::Zone;
    use crate::watch::Watch;

    #[test]
    fn the_largest_deflection_across_a_zone_is_that_of_its_placement() {
        let zone = Zone::Rectangle { width: 0.3, height: 0.2 };
        let turned = Interval::spanning(-0.5, 0.5);
        let asked = [
            (-std::f64::consts::FRAC_PI_2, turned, Orientation::Free),
            (0.0, turned, Orientation::Axes),
            (-0.6, Interval::point(0.2), Orientation::Free),
        ];
        for (robot, (elevation, yaw, orientation)) in paper_robots().iter().zip(asked) {
            let model = Model::spatial(robot, &Pose::translation(0.0, 0.05, 0.2)).unwrap();
            let tool_orientation = ToolOrientation { elevation, yaw, roll: None };
            let options = PlaceOptions {
                tool_orientation: Some(tool_orientation),
                orientation,
                ..PlaceOptions::under(Load::PAPER)
            };
            let placed = place(&model, &zone.into(), &options, Watch::nobody()).unwrap();
            let found = placed.feasible().unwrap_or_else(|| panic!("{}: no place", robot.name));
            let side = |i: i32| f64::from(i) / 20.0 - 1.0;
            let points = (0..=40).flat_map(|j| (0..=40).map(move |i| zone.at([side(i), side(j)])));
            let across = deflection_field(&model, &options, found, points).unwrap();
            assert_eq!(across.len(), 41 * 41);
            let centre = across[20 * 41 + 20].at;
            let expected = [found.centre[0], 0.0, found.centre[1]];
            assert!(centre.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{centre:?}");
            let worst = across.iter().map(|point| point.deflection.unwrap()).fold(0.0, f64::max);
            assert!((worst - found.deflection).abs() <= 2e-3 * worst, "{}: {worst} {found:?}", robot.name);
            let turned = Vector3::from(found.worst_point);
            let worst_point = Rotation3::from_axis_angle(&Vector3::z_axis(), -found.space().unwrap().bearing) * turned;
            let near = |point: &&ZonePoint| {
                point.at.iter().zip(&worst_point).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() < 0.01
            };
            let there = across.iter().filter(near).filter_map(|point| point.deflection).fold(0.0, f64::max);
            assert!((there - found.deflection).abs() <= 1e-2 * worst, "{}: {there} {found:?}", robot.name);
        }
    }
}
