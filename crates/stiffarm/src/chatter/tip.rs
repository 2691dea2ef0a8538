//! The tip of a tool in the axes of a cut: what the robot's modes do there, and what was measured.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{DMatrix, Matrix3, Matrix3xX, Vector3};

use super::curve::Curve;
use super::cut::{ChatterError, Cut, axes};
use super::measured::{HeldBy, MeasuredTip, Samples};
use crate::modes::{Motion, Swing};
use crate::spatial::Pose;

/// A share of the tip's compliance without mass that is none but for rounding.
const MASSLESS: f64 = 1e-3;

/// What swings at a tip, axes of the cut.
#[derive(Clone, Debug)]
pub(super) struct Tip {
    /// Feed, left and away as columns, base axes.
    pub axes: Matrix3<f64>,
    /// All modes, as they are reported.
    pub motion: Motion,
    /// Those that were measured.
    modes: Option<Motion>,
    /// What was measured frequency by frequency.
    samples: Option<Arc<Samples>>,
}

impl Tip {
    /// Of an arm, where the model has one that counts, with a tool at a pose.
    pub(super) fn of(
        swing: Option<&Swing>,
        base_from_tool: &Pose,
        feed: [f64; 3],
        measured: Option<&MeasuredTip>,
    ) -> Result<Self, ChatterError> {
        if let Some(massless) = swing.map(Swing::massless_share).filter(|massless| MASSLESS < *massless) {
            return Err(ChatterError::Massless((1000.0 * massless).round() / 10.0));
        }
        let axes = axes(feed, &-(base_from_tool.rotation * Vector3::z()))?;
        let tool = base_from_tool.rotation.to_rotation_matrix();
        let (modes, samples) = measured.map_or((None, None), |measured| measured.in_cut(&tool, &axes));
        let arm = swing.map(|swing| swing.motion(&[1.0; 6], None).seen_along(&axes));
        let mut tip = Self { axes, motion: still(), modes, samples: samples.map(Arc::new) };
        tip.motion = tip.with(arm.unwrap_or_else(still));
        check_damped(&tip.motion)?;
        Ok(tip)
    }

    /// An arm, axes of the cut, with the modes that were measured.
    pub(super) fn with(&self, arm: Motion) -> Motion {
        match &self.modes {
            Some(modes) => beside(&arm, modes),
            None => arm,
        }
    }

    /// The same seen along other axes, whose columns are given in those of the cut.
    pub(super) fn seen_along(&self, axes: &Matrix3<f64>) -> Self {
        Self {
            axes: self.axes * axes,
            motion: self.motion.clone().seen_along(axes),
            modes: self.modes.clone().map(|modes| modes.seen_along(axes)),
            samples: self.samples.as_deref().map(|samples| Arc::new(samples.clone().seen_along(axes))),
        }
    }

    /// The curve of one motion of it.
    pub(super) fn curve(&self, motion: &Motion, cut: &Cut) -> Curve {
        Curve::with(motion, self.samples.clone(), &cut.mean())
    }

    /// Is there something of which no modes are known?
    pub(super) fn is_sampled(&self) -> bool {
        self.samples.is_some()
    }
}

/// Does the model of the arm count beside what was measured?
pub(super) fn arm_counts(measured: Option<&MeasuredTip>) -> bool {
    measured.is_none_or(|measured| measured.held_by == HeldBy::Rigid)
}

/// Nothing that moves.
fn still() -> Motion {
    Motion { own: Vec::new(), friction: DMatrix::zeros(0, 0), tip: Matrix3xX::zeros(0) }
}

/// Two that move the tip and not each other.
fn beside(a: &Motion, b: &Motion) -> Motion {
    let (n, all) = (a.own.len(), a.own.len() + b.own.len());
    let mut friction = DMatrix::zeros(all, all);
    friction.view_mut((0, 0), (n, n)).copy_from(&a.friction);
    friction.view_mut((n, n), (all - n, all - n)).copy_from(&b.friction);
    let columns: Vec<Vector3<f64>> =
        a.tip.column_iter().chain(b.tip.column_iter()).map(nalgebra::Matrix::into_owned).collect();
    Motion { own: a.own.iter().chain(&b.own).copied().collect(), friction, tip: Matrix3xX::from_columns(&columns) }
}

/// Every mode has some damping.
///
/// # Errors
/// The first that has none.
fn check_damped(motion: &Motion) -> Result<(), ChatterError> {
    let undamped = (0..motion.own.len()).find(|&i| !(0.0 < motion.friction[(i, i)]));
    undamped.map_or(Ok(()), |i| Err(ChatterError::Undamped(motion.own[i] / TAU)))
}
