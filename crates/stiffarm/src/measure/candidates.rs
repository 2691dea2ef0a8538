//! Which postures and loads could be measured? Postures spread evenly within the limits, each under every load.

use std::f64::consts::PI;

use nalgebra::Matrix6;
use rayon::prelude::*;

use super::{MeasureError, Options, information, stands_free};
use crate::compliance::{PostureError, beyond_limits};
use crate::robot::{Arm, Robot};
use crate::spatial::Wrench;
use crate::watch::Parts;

/// So many postures are looked at for one that is kept, at most.
const MOST_REFUSED: usize = 60;

/// Postures and what each tells under each load.
pub(super) struct Candidates {
    /// As reported, rad.
    pub postures: Vec<[f64; 6]>,
    /// Of every posture under every load, loads first.
    pub information: Vec<Matrix6<f64>>,
}

impl Candidates {
    pub(super) fn of(robot: &Robot, options: &Options, parts: &Parts) -> Result<Self, MeasureError> {
        let Arm::SixAxis { limits, .. } = &robot.arm else {
            return Err(PostureError::Planar(robot.name.clone()).into());
        };
        let wanted = options.candidates.div_ceil(options.ways.len().max(1));
        // Whole turns of the joints 4 and 6 show nothing new.
        let ends = limits.joints.map(|range| [range.min().max(-PI), range.max().min(PI)]);
        let posture = |n: usize| {
            let at = halton(n);
            // To a hundredth of a degree, so that what is told is what is meant.
            let told = |angle: f64| ((angle.to_degrees() * 100.0).round() / 100.0).to_radians();
            std::array::from_fn(|i| told(ends[i][0] + at[i] * (ends[i][1] - ends[i][0])))
        };
        let mut postures = Vec::with_capacity(wanted);
        for start in (0..MOST_REFUSED * wanted).step_by(wanted.max(1)) {
            let block: Vec<usize> = (start..start + wanted).collect();
            let kept: Result<Vec<Option<[f64; 6]>>, MeasureError> = block
                .into_par_iter()
                .map(|n| {
                    parts.go_on()?;
                    let q: [f64; 6] = posture(n);
                    Ok((beyond_limits(robot, &q).is_empty() && stands_free(robot, &q, options)?).then_some(q))
                })
                .collect();
            postures.extend(kept?.into_iter().flatten());
            parts.one_more()?;
            if wanted <= postures.len() {
                break;
            }
        }
        postures.truncate(wanted);
        if postures.is_empty() {
            return Err(MeasureError::NoCandidate);
        }
        let pairs: Vec<(usize, usize)> =
            (0..postures.len()).flat_map(|posture| (0..options.ways.len()).map(move |way| (posture, way))).collect();
        let of = |(posture, way): &(usize, usize)| {
            parts.go_on()?;
            let load = Wrench::force(options.ways[*way].along * options.newtons);
            information(robot, &postures[*posture], &load, options)
        };
        let information = pairs.par_iter().map(of).collect::<Result<_, _>>()?;
        Ok(Self { postures, information })
    }

    /// The posture and the load of a candidate.
    pub(super) fn run(&self, index: usize, ways: usize) -> ([f64; 6], usize) {
        (self.postures[index / ways], index % ways)
    }
}

/// Halton's sequence in six dimensions, 0 to 1; its first points, which are alike in all of them, are left out.
fn halton(n: usize) -> [f64; 6] {
    [2_usize, 3, 5, 7, 11, 13].map(|base| {
        let (mut rest, mut share, mut at) = (n + 50, 1.0, 0.0);
        while 0 < rest {
            share /= base as f64;
            at += share * (rest % base) as f64;
            rest /= base;
        }
        at
    })
}
