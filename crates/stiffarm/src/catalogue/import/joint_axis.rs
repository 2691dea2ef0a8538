//! Where does a joint axis lie, and how far is a point from it?

use nalgebra::{Point3, Vector3};

/// A joint axis at joint zero, base frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) through: Point3<f64>,
    pub(super) along: Vector3<f64>,
}

impl Axis {
    /// The vector from the axis to a point, at right angles to the axis.
    pub(super) fn aside(&self, point: &Point3<f64>) -> Vector3<f64> {
        let from = point - self.through;
        from - self.along * self.along.dot(&from)
    }

    /// The point of the axis that is nearest to `point`.
    pub(super) fn nearest(&self, point: &Point3<f64>) -> Point3<f64> {
        point - self.aside(point)
    }
}
