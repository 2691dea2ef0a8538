//! Within which depths does a cut begin to swing, as far as drives and damping may be off?

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Matrix3x2};
use rayon::prelude::*;

use super::curve::{Curve, Edge};
use super::cut::{ChatterError, Cut};
use super::teeth::Teeth;
use crate::modes::{Motion, Swing};
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
    /// Five of a hundred are less.
    pub p05: Option<f64>,
    /// Five of a hundred are more.
    pub p95: Option<f64>,
}

impl DepthSpread {
    /// Of draws, at least one.
    pub fn of(draws: impl Iterator<Item = Option<Edge>>) -> Self {
        let depth = |edge: Option<Edge>| edge.map_or(f64::INFINITY, |edge| edge.depth);
        let spread = crate::uncertainty::Spread::of(draws.map(depth).collect());
        let told = |depth: f64| depth.is_finite().then_some(depth);
        Self { p05: told(spread.p05), p95: told(spread.p95) }
    }
}

/// The arm as it may be, in the axes of the cut, draw by draw.
#[derive(Clone, Debug)]
pub(super) struct Draws(Vec<Motion>);

impl Draws {
    /// Drives by what is told of the robot, at their value where nothing is; damping by what is measured of such arms, unless it is given.
    pub(super) fn of(robot: &Robot, swing: &Swing, axes: &Matrix3<f64>, damping_is_given: bool, count: usize) -> Self {
        let drives = factors(robot, count).unwrap_or_else(|| vec![[1.0; 6]; count]);
        let mut rng = fastrand::Rng::with_seed(SEED);
        let [least, most] = RATIOS;
        let drawn = drives.iter().map(|factors| {
            let ratios: [f64; 6] = std::array::from_fn(|_| least * (most / least).powf(rng.f64()));
            swing.motion(factors, (!damping_is_given).then_some(&ratios)).seen_along(axes)
        });
        Self(drawn.collect())
    }

    /// The curve of each.
    pub(super) fn curves(&self, mean: &Matrix3x2<f64>) -> Vec<Curve> {
        self.0.par_iter().map(|motion| Curve::of(motion, mean)).collect()
    }

    /// Tooth by tooth, at the speed of the cut.
    pub(super) fn by_tooth(&self, cut: &Cut, curves: &[Curve], steps: usize) -> DepthSpread {
        let edges = self.0.par_iter().zip(curves).map(|(motion, curve)| {
            let from = curve.any_speed().map_or(super::cut::LONGEST, |edge| edge.depth);
            Teeth::of(motion, cut).edge_at(cut.spindle, steps, from / 2.0)
        });
        DepthSpread::of(edges.collect::<Vec<_>>().into_iter())
    }
}

/// Every mode of an arm has some damping.
///
/// # Errors
/// The first that has none.
pub(super) fn check_damped(motion: &Motion) -> Result<(), ChatterError> {
    let undamped = (0..motion.own.len()).find(|&i| !(0.0 < motion.friction[(i, i)]));
    undamped.map_or(Ok(()), |i| Err(ChatterError::Undamped(motion.own[i] / TAU)))
}
