//! A range of angles as a sector of the unit circle.

use std::f64::consts::PI;

use pulp::Simd;

use super::affine::Affine;
use super::lanes::Lanes;
use crate::interval::Interval;

/// Rounding of a cosine of an angle that lies at the limit itself.
const SLACK: f64 = 1e-12;

/// The angles within `half` of a middle, whole turns left aside; everything where the range spans a turn, and by default.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sector {
    cos: f64,
    sin: f64,
    /// The smallest cosine of the angle to the middle; `None` where no angle is excluded.
    least: Option<f64>,
}

impl Sector {
    pub(super) fn of(range: Interval) -> Self {
        let half = range.width() / 2.0;
        if PI <= half || !range.is_bounded() {
            return Self { cos: 1.0, sin: 0.0, least: None };
        }
        let (sin, cos) = range.middle().sin_cos();
        Self { cos, sin, least: Some(half.cos() - SLACK) }
    }

    /// What is negative where the angle of a vector of that length (its cosine and sine times the length) lies outside.
    #[inline(always)]
    pub(super) fn slack<S: Simd>(self, cos: Lanes<S>, sin: Lanes<S>, length: Lanes<S>) -> Lanes<S> {
        match self.least {
            None => length,
            Some(least) => (cos * self.cos + sin * self.sin) - length * least,
        }
    }

    /// What is negative where the angle of a vector of that length lies outside; `None` where no angle is excluded.
    pub(super) fn room<const N: usize>(self, cos: Affine<N>, sin: Affine<N>, length: Affine<N>) -> Option<Affine<N>> {
        self.least.map(|least| cos * self.cos + sin * self.sin - length * least)
    }
}
