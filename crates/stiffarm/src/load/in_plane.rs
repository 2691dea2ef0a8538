//! What of a load does the arm plane know?

use nalgebra::Vector2;

use super::{Component, Direction, Load, NotInPlane};

/// Directions of a force in the arm plane: within an angle of one of them; what counts is told by the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sector {
    /// The one in the middle, length one: forwards, up.
    pub(crate) middle: Vector2<f64>,
    /// Cosine and sine of twice the angle.
    pub(crate) twice: [f64; 2],
    /// The displacement's part along the force counts, rather than all of it.
    pub(crate) is_along: bool,
}

impl Sector {
    /// One direction alone.
    pub(crate) fn is_one(&self) -> bool {
        self.twice[1] == 0.0 && 0.0 < self.twice[0]
    }
}

impl Load {
    /// The directions in the arm plane; `None` for the worst of all.
    ///
    /// Of a cone about a direction in the plane, forces out of it have a smaller part in it.
    ///
    /// # Errors
    /// Where the plane does not know the direction, or what counts.
    pub(crate) fn sector(self) -> Result<Option<Sector>, NotInPlane> {
        if self.component == Component::Normal {
            return Err(NotInPlane::Normal);
        }
        let middle = match self.direction {
            Direction::Worst => return Ok(None),
            Direction::InPlane(angle) => Vector2::new(angle.cos(), angle.sin()),
            Direction::Base([x, 0.0, z]) => Vector2::new(x, z) / self.newtons,
            Direction::Base([_, y, _]) => return Err(NotInPlane::Across(y)),
            Direction::Tool { .. } => return Err(NotInPlane::Tool),
        };
        let (s, c) = (2.0 * self.cone).sin_cos();
        Ok(Some(Sector { middle, twice: [c, s], is_along: self.component == Component::Along }))
    }
}
