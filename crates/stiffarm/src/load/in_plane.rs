//! What of a load does the arm plane know?

use nalgebra::{Matrix2, Vector2};

use super::{Component, Direction, Load, NotInPlane};

/// Directions of a force in the arm plane: within an angle of one of them; the load says what counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sector {
    /// The one in the middle, length one: forwards, up.
    pub(crate) middle: Vector2<f64>,
    /// The angle, rad.
    cone: f64,
    /// Cosine and sine of twice the angle.
    pub(crate) twice: [f64; 2],
    /// The displacement's part along the force counts, rather than all of it.
    pub(crate) is_along: bool,
}

/// The force of a sector that does most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LargestInPlane {
    /// What counts of the displacement, m/N.
    pub(crate) value: f64,
    /// The unit direction of the force.
    pub(crate) force: Vector2<f64>,
    /// The unit direction of which the displacement's part is the value.
    pub(crate) counted: Vector2<f64>,
}

impl Sector {
    /// The greatest value of a quadratic form over the sector, by its entries along the middle direction, mixed, and across it.
    ///
    /// In the middle of its eigenvalues plus or minus half their distance times the cosine of twice the angle to the softer one.
    pub(crate) fn most_of(&self, [along, mixed, across]: [f64; 3]) -> f64 {
        let (apart, mixed) = (along - across, 2.0 * mixed.abs());
        let length = apart.hypot(mixed);
        let [c, s] = self.twice;
        let at_edge = apart * c + mixed * s;
        0.5 * ((along + across) + if length * c <= apart { length } else { at_edge })
    }

    /// The force that does most, and what it does.
    ///
    /// What counts, or its square, is a quadratic form of the force: in a plane it grows towards its softest direction, so it is greatest
    /// there or at the end of the sector that is nearer to it.
    pub(crate) fn largest(&self, compliance: &Matrix2<f64>) -> LargestInPlane {
        let form = if self.is_along { *compliance } else { compliance * compliance };
        let across = Vector2::new(-self.middle.y, self.middle.x);
        let seen = |a: &Vector2<f64>, b: &Vector2<f64>| a.dot(&(form * b));
        let softest =
            (2.0 * seen(&self.middle, &across)).atan2(seen(&self.middle, &self.middle) - seen(&across, &across)) / 2.0;
        let (s, c) = softest.clamp(-self.cone, self.cone).sin_cos();
        let force = self.middle * c + across * s;
        let moved = compliance * force;
        if self.is_along {
            return LargestInPlane { value: force.dot(&moved), force, counted: force };
        }
        let value = moved.norm();
        LargestInPlane { value, force, counted: if 0.0 < value { moved / value } else { force } }
    }

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
        Ok(Some(Sector { middle, cone: self.cone, twice: [c, s], is_along: self.component == Component::Along }))
    }
}
