//! What of an arm may differ from its drawing?

use crate::calibration::{JOINT_AXES, WEIGHT};
use crate::chain::{ALL, FRAMES};

/// How much is looked for; each level has all of those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The zeros of the joints.
    Zeros,
    /// All of the joints' frames.
    Geometry,
    /// How drives yield under the arm's own weight.
    Weight,
    /// Gears that err once per turn.
    Gears,
}

/// rad: how far a drive yields under the arm's own weight, one standard deviation.
pub const WEIGHT_PRIOR: f64 = 0.5e-3;
/// rad: how far a gear errs once per turn, one standard deviation.
pub const GEARS_PRIOR: f64 = 0.1e-3;

impl Level {
    /// All, the least first.
    pub const ALL: [Self; 4] = [Self::Zeros, Self::Geometry, Self::Weight, Self::Gears];

    /// The name that options and answers use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zeros => "zeros",
            Self::Geometry => "geometry",
            Self::Weight => "weight",
            Self::Gears => "gears",
        }
    }

    /// Standard deviation of the prior of each parameter, m and rad, where frames are off by `scale`; zero holds it. Where masses are known, of the
    /// logarithm of each drive's compliance instead of the terms of weight.
    pub(super) fn prior(self, scale: f64, drives: Option<&[f64; 6]>) -> Vec<f64> {
        let frame = |i: usize| if Self::Geometry <= self || i % 6 == 3 + JOINT_AXES[i / 6] { scale } else { 0.0 };
        let of = |i: usize| {
            if i < FRAMES {
                return frame(i);
            }
            let of_weight = || drives.map_or(WEIGHT_PRIOR, |drives| drives.get(i - FRAMES).copied().unwrap_or(0.0));
            let (level, prior) =
                if i < FRAMES + WEIGHT { (Self::Weight, of_weight()) } else { (Self::Gears, GEARS_PRIOR) };
            if level <= self { prior } else { 0.0 }
        };
        (0..ALL).map(of).collect()
    }
}
