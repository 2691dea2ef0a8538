//! Does an angle lie in an interval, whole turns left aside? Answered from its cosine and sine.

use std::f64::consts::PI;

use pulp::Simd;

use super::lanes::Lanes;
use crate::interval::Interval;
use crate::real::Real;
use crate::tolerances;

/// The angles within `half` of a middle, whole turns left aside; everything where the range spans a turn, and by default.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct AngularInterval {
    /// Cosine and sine of the middle.
    cos: f64,
    sin: f64,
    /// The smallest cosine of the angle to the middle; `None` where no angle is excluded.
    least: Option<f64>,
}

impl AngularInterval {
    /// The angles of a range, rad.
    pub(crate) fn of(range: Interval) -> Self {
        let half = range.width() / 2.0;
        if PI <= half || !range.is_bounded() {
            return Self { cos: 1.0, sin: 0.0, least: None };
        }
        let (sin, cos) = range.middle().sin_cos();
        Self { cos, sin, least: Some(half.cos() - tolerances::COSINE) }
    }

    /// Negative where the angle of a vector of that length lies outside, from its cosine and sine times the length; `None` where no
    /// angle is excluded.
    #[allow(clippy::manual_map, reason = "a closure is compiled without the wide instructions")]
    #[inline(always)]
    pub(crate) fn room<T: Real>(self, cos: T, sin: T, length: T) -> Option<T> {
        match self.least {
            None => None,
            Some(least) => Some(cos * self.cos + sin * self.sin - length * least),
        }
    }

    /// The same, and the length itself where no angle is excluded.
    #[inline(always)]
    pub(super) fn slack<S: Simd>(self, cos: Lanes<S>, sin: Lanes<S>, length: Lanes<S>) -> Lanes<S> {
        match self.room(cos, sin, length) {
            None => length,
            Some(room) => room,
        }
    }
}
