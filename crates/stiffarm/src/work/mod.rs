//! What is machined: the plane in which a flat zone lies, and the points at which it is evaluated.

mod grid;
mod plane;

pub(crate) use grid::Grid;
pub use plane::{WorkPlacement, WorkPlane};
