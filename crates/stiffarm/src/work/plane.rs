//! Where does the work lie, and how does the tool stand on it?

use nalgebra::{Matrix3, Vector3};

use crate::spatial::Pose;
use crate::task::Zone;

/// Where the work lies and how the tool is turned; lengths in m from the base, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WorkPlacement {
    /// Of the zone's centre, straight ahead.
    pub(crate) x: f64,
    /// Of the zone's centre, upwards.
    pub(crate) z: f64,
    /// Of the work plane about the vertical.
    pub(crate) yaw: f64,
    /// Of the zone's first side in the plane.
    pub(crate) angle: f64,
    /// Of the tool about its axis.
    pub(crate) roll: f64,
}

/// The plane of a zone, which the tool axis meets at a right angle; base axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorkPlane {
    /// Along the zone's first side, length one.
    pub(crate) first: Vector3<f64>,
    /// Along its second side.
    pub(crate) second: Vector3<f64>,
    /// The tool's axes, as columns.
    tool: Matrix3<f64>,
}

impl WorkPlane {
    /// With a tool axis that rises by `elevation`, rad, above the horizontal.
    pub(crate) fn of(elevation: f64, work: &WorkPlacement) -> Self {
        let (se, ce) = elevation.sin_cos();
        let (sy, cy) = work.yaw.sin_cos();
        let about = |ahead: f64, left: f64, up: f64| Vector3::new(cy * ahead - sy * left, sy * ahead + cy * left, up);
        let (upwards, left, axis) = (about(-se, 0.0, ce), about(0.0, 1.0, 0.0), about(ce, 0.0, se));
        let (sa, ca) = work.angle.sin_cos();
        let (sr, cr) = work.roll.sin_cos();
        // The tool's x axis at roll zero points as `upwards`; its y completes the frame.
        let (x, y) = (upwards, axis.cross(&upwards));
        Self {
            first: upwards * ca + left * sa,
            second: left * ca - upwards * sa,
            tool: Matrix3::from_columns(&[x * cr + y * sr, y * cr - x * sr, axis]),
        }
    }

    /// The tool's axes in those of the base.
    pub(crate) fn tool(&self) -> &Matrix3<f64> {
        &self.tool
    }

    /// A point of the plane, m from the zone's centre along its sides; base axes.
    pub(crate) fn point(&self, work: &WorkPlacement, [u, v]: [f64; 2]) -> Vector3<f64> {
        Vector3::new(work.x, 0.0, work.z) + self.first * u + self.second * v
    }

    /// How far the zone extends from its centre along the base axes, m.
    pub(crate) fn half_extents(&self, zone: Zone) -> [f64; 3] {
        let [first, second] = zone.sides().map(|side| side / 2.0);
        std::array::from_fn(|axis| {
            let (a, b) = (first * self.first[axis], second * self.second[axis]);
            match zone {
                Zone::Circle { .. } => a.hypot(b),
                Zone::Rectangle { .. } => a.abs() + b.abs(),
            }
        })
    }

    /// The pose of the tool at that point.
    pub(crate) fn pose(&self, work: &WorkPlacement, at: [f64; 2]) -> Pose {
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(self.tool);
        Pose::from_parts(self.point(work, at).into(), rotation.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_table_a_wall_and_the_tool_stand_as_people_draw_them() {
        let work = WorkPlacement { x: 1.5, z: 0.8, yaw: 0.0, angle: 0.0, roll: 0.0 };
        let close = |a: Vector3<f64>, b: [f64; 3]| assert!((a - Vector3::from(b)).norm() < 1e-12, "{a} is not {b:?}");
        let table = WorkPlane::of(-FRAC_PI_2, &work);
        close(table.point(&work, [0.1, 0.2]), [1.6, 0.2, 0.8]);
        close(table.tool().column(2).into(), [0.0, 0.0, -1.0]);
        close(table.tool().column(0).into(), [1.0, 0.0, 0.0]);
        let wall = WorkPlane::of(0.0, &work);
        close(wall.point(&work, [0.1, 0.2]), [1.5, 0.2, 0.9]);
        close(wall.tool().column(2).into(), [1.0, 0.0, 0.0]);
        let aside = WorkPlacement { yaw: FRAC_PI_2, roll: FRAC_PI_2, ..work };
        let wall = WorkPlane::of(0.0, &aside);
        close(wall.point(&aside, [0.0, 0.2]), [1.3, 0.0, 0.8]);
        close(wall.tool().column(2).into(), [0.0, 1.0, 0.0]);
        close(wall.tool().column(0).into(), [1.0, 0.0, 0.0]);
        assert!((wall.tool().determinant() - 1.0).abs() < 1e-12);
    }
}
