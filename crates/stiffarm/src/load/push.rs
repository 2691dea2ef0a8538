//! What pushes on the tool at one moment: a force and a moment of which everything is known.

use nalgebra::Vector3;

/// A force and a moment on the tool at its tip, and what of the displacement counts; all vectors in one and the same axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// N.
    pub force: Vector3<f64>,
    /// N m.
    pub moment: Vector3<f64>,
    /// The unit direction along which the displacement counts; all of it where `None`.
    pub counted: Option<Vector3<f64>>,
}

impl Push {
    /// The same, each vector seen from other axes.
    #[must_use]
    pub fn seen(&self, turned: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Self {
        Self { force: turned(&self.force), moment: turned(&self.moment), counted: self.counted.as_ref().map(turned) }
    }

    /// What counts of a displacement, m.
    pub fn of(&self, moved: &Vector3<f64>) -> f64 {
        self.counted.map_or_else(|| moved.norm(), |direction| direction.dot(moved).abs())
    }
}
