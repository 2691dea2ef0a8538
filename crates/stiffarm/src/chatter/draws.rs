//! Within which depths does a cut begin to swing, as far as drives and damping may be off?

use super::curve::{Curve, Edge};
use super::cut::Cut;
use super::teeth::Teeth;
use super::tip::Tip;
use crate::modes::{Motion, Swing};
use crate::parallel;
use crate::prior::factors;
use crate::robot::Robot;

/// How many draws by the mean over a revolution, and how many tooth by tooth.
pub const DRAWS: usize = 200;
/// Tooth by tooth each costs a hundred times as much.
pub const DRAWS_BY_TOOTH: usize = 50;
/// Between which shares of the critical damping modes of such arms were measured.
const RATIOS: [f64; 2] = [0.02, 0.08];
const SEED: u64 = 0x6461_6d70_696e_6721;

/// Where a depth lies with 90 %, m; `None` beyond the longest edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthSpread {
    /// 5th percentile.
    pub p05: Option<f64>,
    /// 95th percentile.
    pub p95: Option<f64>,
}

impl DepthSpread {
    /// Of draws, at least one.
    pub fn of(draws: impl Iterator<Item = Option<Edge>>) -> Self {
        let depth = |edge: Option<Edge>| edge.map_or(f64::INFINITY, |edge| edge.depth);
        let spread = crate::uncertainty::Spread::of(draws.map(depth).collect());
        let finite = |depth: f64| depth.is_finite().then_some(depth);
        Self { p05: finite(spread.p05), p95: finite(spread.p95) }
    }

    /// So deep a cut is calm in 95 of 100 draws, and with drives and damping as they are taken: where modes nearly meet, that may swing sooner than
    /// nearly all draws, which have them apart.
    pub(super) fn allows(&self, depth: f64, taken: Option<Edge>) -> bool {
        self.p05.is_none_or(|p05| depth < p05) && taken.is_none_or(|edge| depth < edge.depth)
    }

    /// Neither end deeper than that of another.
    #[must_use]
    pub(super) fn at_most(self, other: &Self) -> Self {
        let least = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(f64::min);
        Self { p05: least(self.p05, other.p05), p95: least(self.p95, other.p95) }
    }
}

/// The arm as it may be, with what was measured of its tip, in the axes of the cut, draw by draw.
#[derive(Clone, Debug)]
pub(super) struct Draws<'a>(Vec<Motion>, &'a Tip);

impl<'a> Draws<'a> {
    /// Drives by what is known of the robot, at their value where nothing is; damping by what is measured of such arms, unless it is given.
    pub(super) fn of(robot: &Robot, swing: &Swing, tip: &'a Tip, damping_is_given: bool, count: usize) -> Self {
        // Where nothing is drawn all draws are one.
        let count = if damping_is_given && factors(robot, 1).is_none() { 1 } else { count };
        let drives = factors(robot, count).unwrap_or_else(|| vec![[1.0; 6]; count]);
        let mut rng = fastrand::Rng::with_seed(SEED);
        let [least, most] = RATIOS;
        let drawn = drives.iter().map(|factors| {
            let ratios: [f64; 6] = std::array::from_fn(|_| least * (most / least).powf(rng.f64()));
            tip.with(swing.motion(factors, (!damping_is_given).then_some(&ratios)).seen_along(&tip.axes))
        });
        Self(drawn.collect(), tip)
    }

    /// A tip that was measured as it swings with the robot: nothing of it is drawn.
    pub(super) fn one(tip: &'a Tip) -> Self {
        Self(vec![tip.motion.clone()], tip)
    }

    /// The curve of each.
    pub(super) fn curves(&self, cut: &Cut) -> Vec<Curve> {
        parallel::each(&self.0, |motion| self.1.curve(motion, cut))
    }

    /// Tooth by tooth, at the speed of the cut.
    pub(super) fn by_tooth(&self, cut: &Cut, curves: &[Curve], steps: usize) -> DepthSpread {
        let edges = parallel::each_of(curves.len(), |i| {
            let (motion, curve) = (&self.0[i], &curves[i]);
            let from = curve.any_speed().map_or(super::cut::LONGEST, |edge| edge.depth);
            Teeth::of(motion, cut).edge_at(cut.spindle, steps, from / 2.0)
        });
        DepthSpread::of(edges.into_iter())
    }
}
