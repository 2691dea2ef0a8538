//! How near does the arm come to what stands about it, over the poses of an answer?

use nalgebra::{Rotation3, Vector3};

use super::search::Search;
use crate::clearance::{Clearance, Looked, Solid, Surroundings, ThickArm};
use crate::follow::Followed;
use crate::work::{WorkPlacement, WorkPlane};

impl Search<'_> {
    /// The nearest over all poses of a zone that is followed.
    pub(super) fn clearance(&self, work: &WorkPlacement, followed: &Followed) -> Option<Clearance> {
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let model_angles = |q| geometry.model_angles(q, limits.third_axis);
        let postures: Vec<[f64; 6]> = followed.joints.iter().map(model_angles).collect();
        let thick = ThickArm::new(self.robot, &self.arm.flange_from_tool, None)?;
        thick.clearance(&postures, &self.surroundings(work, followed.bearing))
    }

    /// The smallest distance of the arm over postures by their model angles from what stands about a zone straight ahead, and from itself, m, by
    /// the bodies that it is taken for; `None` where there is nothing to meet.
    pub(super) fn least_distance(&self, thick: &ThickArm, work: &WorkPlacement, postures: &[[f64; 6]]) -> Option<f64> {
        let about = self.surroundings(work, 0.0);
        let nearer = |least: Option<f64>, theta: &[f64; 6]| {
            let looked = Looked { within: least.unwrap_or(f64::INFINITY), ..Looked::ALL };
            thick.nearest(theta, (&about, 0), looked).map(|near| near.distance).or(least)
        };
        postures.iter().fold(None, nearer)
    }

    /// What stands about the arm, the zone among it, turned by a bearing.
    fn surroundings(&self, work: &WorkPlacement, bearing: f64) -> Surroundings {
        let plane = WorkPlane::of(self.options.elevation, work);
        let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), bearing);
        let [centre, first, along_tool] =
            [plane.point(work, [0.0; 2]), plane.first, plane.tool().column(2).into()].map(|vector| turned * vector);
        Surroundings {
            work: Some(Solid::sheet(self.zone, centre, first, along_tool)),
            ..Surroundings::of(self.options.cell.as_ref(), self.options.margins.floor)
        }
    }
}
