//! How near does the arm come to what stands about it, over the poses of an answer?

use nalgebra::{Rotation3, Vector3};

use super::search::Search;
use crate::clearance::{Clearance, Solid, Surroundings, ThickArm};
use crate::follow::Followed;
use crate::work::{WorkPlacement, WorkPlane};

impl Search<'_> {
    /// The nearest over all poses of a zone that is followed.
    pub(super) fn clearance(&self, work: &WorkPlacement, followed: &Followed) -> Option<Clearance> {
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let model_angles = |q| geometry.model_angles(q, limits.third_axis);
        let postures: Vec<[f64; 6]> = followed.joints.iter().map(model_angles).collect();
        self.clearance_over(work, followed.bearing, &postures)
    }

    /// The same over postures by their model angles, the zone turned by a bearing.
    pub(super) fn clearance_over(
        &self,
        work: &WorkPlacement,
        bearing: f64,
        postures: &[[f64; 6]],
    ) -> Option<Clearance> {
        let thick = ThickArm::new(self.robot, &self.arm.flange_from_tool, None)?;
        let plane = WorkPlane::of(self.options.elevation, work);
        let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), bearing);
        let [centre, first, along_tool] =
            [plane.point(work, [0.0; 2]), plane.first, plane.tool().column(2).into()].map(|vector| turned * vector);
        let about = Surroundings {
            work: Some(Solid::sheet(self.zone, centre, first, along_tool)),
            ..Surroundings::of(self.options.cell.as_ref(), self.options.margins.floor)
        };
        thick.clearance(postures, &about)
    }
}
