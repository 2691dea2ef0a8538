//! Which model angles do the limits allow? As intervals of a circle, for registers.

use pulp::Simd;

use super::angular_interval::AngularInterval;
use super::lanes::Lanes;
use crate::geometry::Geometry;
use crate::limits::{Limits, ThirdAxis};

/// The limits of an arm as intervals of model angles, whole turns left aside.
#[derive(Clone, Debug)]
pub(crate) struct AngularLimits {
    /// Of theta 1, 2, 4, 5, 6; entry 2 limits what joint 3 reports, theta 3 or `theta2 + theta3`.
    pub(crate) joints: [AngularInterval; 6],
    /// Replaces entry 2 where whole turns of what joint 3 reports count.
    pub(crate) multi_turn: Option<MultiTurnLimit>,
    /// Joint 3 reports `theta2 + theta3`.
    pub(crate) third_is_forearm: bool,
    /// Of theta 3, from the angle between the links.
    pub(crate) elbow: AngularInterval,
    /// Where joints 4 and 6 turn about one line, some split of their sum is allowed for certain.
    pub(super) any_wrist_split: bool,
}

impl AngularLimits {
    /// From the limits as a robot states them.
    pub(super) fn new(geometry: &Geometry, limits: &Limits) -> Self {
        let joints = std::array::from_fn(|i| AngularInterval::of(geometry.theta(i, limits.joints[i])));
        let elbow = AngularInterval::of(limits.elbow.affine(-1.0, std::f64::consts::PI));
        let any_wrist_split = std::f64::consts::TAU <= limits.joints[3].width() + limits.joints[5].width();
        let third_is_forearm = limits.third_axis == ThirdAxis::Forearm;
        let multi_turn = limits.third_is_wound().then(|| MultiTurnLimit::new(geometry, limits));
        Self { joints, multi_turn, third_is_forearm, elbow, any_wrist_split }
    }
}

/// The limit of joint 3 where whole turns count: theta 2 (zero where joint 3 reports the elbow) plus theta 3.
///
/// Each of the two angles is counted from the middle of its range, so half their sum stays within half a turn: an interval of
/// half the sum tells apart what an interval of the sum, known up to whole turns, does not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MultiTurnLimit {
    /// Cosine and sine of the middle of theta 2; of zero where joint 3 reports the elbow.
    second: [f64; 2],
    /// Cosine and sine of the middle of theta 3.
    third: [f64; 2],
    /// Of half the sum, counted from the middles.
    half: AngularInterval,
}

impl MultiTurnLimit {
    fn new(geometry: &Geometry, limits: &Limits) -> Self {
        let forearm = limits.third_axis == ThirdAxis::Forearm;
        let second = if forearm { geometry.theta(1, limits.joints[1]).middle() } else { 0.0 };
        let third = std::f64::consts::PI - limits.elbow.middle();
        let sum = geometry.theta(2, limits.joints[2]);
        Self {
            second: [second.cos(), second.sin()],
            third: [third.cos(), third.sin()],
            half: AngularInterval::of(sum.affine(0.5, -0.5 * (second + third))),
        }
    }

    /// Negative where the limit is overstepped. Takes sine and cosine of theta 2 (of zero where joint 3 reports the elbow) and of
    /// theta 3, both within their ranges.
    #[inline(always)]
    pub(super) fn slack<S: Simd>(&self, [s2, c2]: [Lanes<S>; 2], [s3, c3]: [Lanes<S>; 2]) -> Lanes<S> {
        // The angle from the middle has cosine c' and sine s'; the vector (1 + c', s') points along half of it.
        let halved = |s: Lanes<S>, c: Lanes<S>, [cos, sin]: [f64; 2]| [c * cos + s * sin + 1.0, s * cos - c * sin];
        let ([x2, y2], [x3, y3]) = (halved(s2, c2, self.second), halved(s3, c3, self.third));
        let (x, y) = (x2 * x3 - y2 * y3, x2 * y3 + y2 * x3);
        self.half.slack(x, y, (x * x + y * y).sqrt())
    }
}
