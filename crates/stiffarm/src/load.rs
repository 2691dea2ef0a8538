//! What pushes on the tool?

/// A cutting force at the tool point: how large, and which way.
///
/// Checked when it is made, so that what takes a load need not check it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    newtons: f64,
    direction: Direction,
}

/// Which way a force pushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// At every point the way in which the tool gives way most.
    Worst,
    /// One angle in the arm plane, rad, counter-clockwise from straight ahead, and the part of the displacement that counts.
    InPlane(f64, Component),
}

/// What part of a displacement counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The whole displacement, `|C n| F`: the paper's eq. (1) for one direction.
    Total,
    /// Its part along the force, `n^T C n F`.
    Along,
}

/// A force with which nothing can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// Outside `0 < force <= 1e6`.
    #[error("a force of {0} N; expected more than 0 and at most 1e6 N")]
    Force(f64),
    /// A direction that is not finite.
    #[error("a direction of {0} rad; expected a finite number")]
    Direction(f64),
}

impl Load {
    /// The cutting force of the paper, 1 kN, in its worst direction.
    pub const PAPER: Self = Self { newtons: 1000.0, direction: Direction::Worst };

    /// One newton in its worst direction: deflections under it are compliances.
    pub const UNIT: Self = Self { newtons: 1.0, direction: Direction::Worst };

    /// A force, N, in its worst direction.
    ///
    /// # Errors
    /// Where it is not positive, or above 1 MN.
    pub fn worst(newtons: f64) -> Result<Self, LoadError> {
        Self::new(newtons, Direction::Worst)
    }

    /// A force, N, at an angle in the arm plane, rad, counter-clockwise from straight ahead.
    ///
    /// # Errors
    /// Where the force is not positive or above 1 MN, or the angle is not finite.
    pub fn in_plane(newtons: f64, angle: f64, component: Component) -> Result<Self, LoadError> {
        Self::new(newtons, Direction::InPlane(angle, component))
    }

    fn new(newtons: f64, direction: Direction) -> Result<Self, LoadError> {
        match direction {
            _ if !(0.0 < newtons && newtons <= 1e6) => Err(LoadError::Force(newtons)),
            Direction::InPlane(angle, _) if !angle.is_finite() => Err(LoadError::Direction(angle)),
            _ => Ok(Self { newtons, direction }),
        }
    }

    /// Its size, N.
    pub const fn newtons(self) -> f64 {
        self.newtons
    }

    /// Which way it pushes.
    pub const fn direction(self) -> Direction {
        self.direction
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_that_is_none_makes_no_load() {
        for nonsense in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.1e6] {
            assert!(matches!(Load::worst(nonsense), Err(LoadError::Force(_))), "{nonsense}");
        }
        assert!(matches!(Load::in_plane(1.0, f64::NAN, Component::Total), Err(LoadError::Direction(_))));
        assert_eq!(Load::worst(1000.0), Ok(Load::PAPER));
    }
}
