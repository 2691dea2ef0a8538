//! In which postures do measured points tell most of how an arm differs from its drawing?
//!
//! Unknown are the errors `x` of the arm, with the prior of arms that nobody has calibrated, the frame of the instrument and the points. A posture
//! tells `M_i = J_i^T J_i / s^2` of them, a plan `M = P + sum M_i`. It is as good as it lets the place of the first point be predicted over the work:
//! `phi = tr(W M^-1)`, with `W` the mean of `J^T J` over the work, which is the mean square of the error that remains there. What no error of the arm
//! explains of a posture (`posture_sigma`) remains whatever is measured.

mod choice;

use nalgebra::{DMatrix, Vector3};

use super::candidates::postures;
use super::{MeasureError, Options, route};
use crate::calibrate::{prior_of_errors, scale_of_errors};
use crate::chain::{ALL, Frames};
use crate::compliance::{PostureError, check_tool};
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use crate::watch::Watch;

use choice::{Choice, squares};

/// m and rad: what is known of the instrument's frame, and of where the points sit.
const ROUGHLY: f64 = 1.0;
/// Of so many postures each, at most, a plan is reported besides.
const COUNTS: [usize; 5] = [10, 20, 40, 70, 100];
/// Fewer rows are not calibrated by.
const LEAST: usize = crate::calibrate::LEAST_ROWS;

/// Postures in which points of the flange are to be measured, and what they are worth.
#[derive(Clone, Debug, PartialEq)]
pub struct GeometryPlan {
    /// As the robot reports them, rad, in an order in which the joints travel little.
    pub postures: Vec<[f64; 6]>,
    /// What remains of the error of the first point over the work, root mean square, m.
    pub expected: f64,
    /// No choice of as many of the candidates leaves less, m.
    pub lower_bound: f64,
    /// The median of random choices of as many, m.
    pub random: f64,
    /// As drawn, where the instrument's frame is fitted to the first point over the work, m.
    pub as_drawn: f64,
    /// What no error of the arm explains remains whatever is measured: its part of all of these, m.
    pub unexplained: f64,
    /// So many postures, and what they leave, m, chosen one after the other.
    pub by_count: Vec<(usize, f64)>,
    /// How far the joints' frames of an arm that nobody has calibrated are taken to be off, one standard deviation, m and rad.
    pub scale: f64,
    /// How many candidates there were.
    pub candidates: usize,
    /// How many postures the work had.
    pub work: usize,
}

impl GeometryPlan {
    /// How near it is to the best in the mean square of what a plan decides, at least: 1 is the best.
    pub fn efficiency(&self) -> f64 {
        self.efficiency_of(self.expected)
    }

    /// The same of random choices.
    pub fn random_efficiency(&self) -> f64 {
        self.efficiency_of(self.random)
    }

    fn efficiency_of(&self, expected: f64) -> f64 {
        let decided = |m: f64| m.powi(2) - self.unexplained.powi(2);
        (decided(self.lower_bound) / decided(expected)).max(0.0)
    }
}

/// Plans postures in which the markers are measured by an instrument, so that an arm is calibrated; loads and repeats of the options say nothing
/// here.
///
/// # Errors
/// Of a robot of two links, where too few postures can be measured, and where the work is no longer wanted.
pub fn geometry_plan(robot: &Robot, options: &Options, watch: Watch) -> Result<GeometryPlan, MeasureError> {
    let planar = || PostureError::Planar(robot.name.clone());
    let Arm::SixAxis { limits, .. } = &robot.arm else { return Err(planar().into()) };
    let frames = Frames::of(robot).ok_or_else(planar)?;
    for point in &options.markers {
        check_tool(&Pose::translation(point.x, point.y, point.z))?;
    }
    if options.runs < LEAST {
        return Err(MeasureError::TooFewRows { rows: options.runs, least: LEAST });
    }
    let parts = watch.parts(None);
    let candidates = postures(robot, options, options.candidates, &parts)?;
    if candidates.len() < options.runs {
        let (runs, postures) = (options.runs, candidates.len());
        return Err(MeasureError::TooFewPostures { runs, repeats: 1, postures });
    }
    let work: &[[f64; 6]] = if options.work.is_empty() { &candidates } else { &options.work };
    let scale = scale_of_errors(0.5);
    let sensitivity = Sensitivity { frames: &frames, prior: prior_of_errors(scale), markers: &options.markers };
    let seen = sensitivity.rows(work, &options.markers[..1]);
    let weight = squares(&seen.transpose(), |_| 1.0) / work.len() as f64;
    let noise = options.variance().sqrt();
    let sensitivities = sensitivity.rows(&candidates, &options.markers).transpose() / noise;
    let choice = Choice { sensitivities, each: 3 * options.markers.len(), weight };
    let (bound, shares) = choice.bound(options.runs, &parts)?;
    let most = COUNTS[COUNTS.len() - 1].max(options.runs).min(candidates.len());
    let (promising, numbers) = choice.promising(&shares, most);
    let greedy = promising.greedy(most, &parts)?;
    let chosen = promising.best(&greedy[..options.runs], &parts)?;
    let unexplained = options.posture_sigma * 3_f64.sqrt();
    let remaining = |value: f64| value.sqrt().hypot(unexplained);
    let counts = COUNTS.into_iter().filter(|count| *count <= most);
    let mut plan: Vec<[f64; 6]> = chosen.iter().map(|&i| candidates[numbers[i]]).collect();
    route::order(&mut plan, limits.speeds, |q| *q);
    Ok(GeometryPlan {
        postures: plan,
        expected: remaining(promising.value(&chosen)),
        lower_bound: remaining(bound),
        random: remaining(choice.random(options.runs)),
        as_drawn: remaining(as_drawn(&seen)),
        unexplained,
        by_count: counts.map(|count| (count, remaining(promising.value(&greedy[..count])))).collect(),
        scale,
        candidates: candidates.len(),
        work: work.len(),
    })
}

/// The mean square of what errors of an arm leave where a frame and the place of the point are fitted, m^2: the part of their columns that is none of those.
fn as_drawn(seen: &DMatrix<f64>) -> f64 {
    /// Of the largest singular value: what is less moves no point.
    const NONE: f64 = 1e-9;
    let (errors, fitted) = (seen.columns(0, ALL), seen.columns(ALL, 9));
    let found = fitted.svd(true, false);
    let axes = found.u.expect("it was asked for");
    let most = found.singular_values.max();
    let kept: Vec<usize> = (0..axes.ncols()).filter(|&i| NONE * most < found.singular_values[i]).collect();
    let explained: f64 = kept.iter().map(|&i| (errors.transpose() * axes.column(i)).norm_squared()).sum();
    3.0 * (errors.norm_squared() - explained) / seen.nrows() as f64
}

/// How far points move with each unknown, in parts of what is known of it.
struct Sensitivity<'a> {
    frames: &'a Frames,
    /// Standard deviations of the arm's errors.
    prior: Vec<f64>,
    markers: &'a [Vector3<f64>],
}

impl Sensitivity<'_> {
    /// Of every posture three rows a point, m: the errors of the arm, shift and turn of the instrument's frame, and every marker's place.
    fn rows(&self, postures: &[[f64; 6]], points: &[Vector3<f64>]) -> DMatrix<f64> {
        let unknowns = ALL + 6 + 3 * self.markers.len();
        let mut rows = DMatrix::zeros(3 * points.len() * postures.len(), unknowns);
        let drawn = vec![0.0; ALL];
        for (i, q) in postures.iter().enumerate() {
            let chain = self.frames.chain(&drawn, q);
            for (j, point) in points.iter().enumerate() {
                let at = (chain.flange * nalgebra::Point3::from(*point)).coords;
                let mut rows = rows.fixed_rows_mut::<3>(3 * (points.len() * i + j));
                for (k, [shift, turn]) in chain.twists.iter().enumerate() {
                    rows.set_column(k, &((shift + turn.cross(&at)) * self.prior[k]));
                }
                for axis in 0..3 {
                    let unit = Vector3::ith(axis, ROUGHLY);
                    rows.set_column(ALL + axis, &unit);
                    rows.set_column(ALL + 3 + axis, &unit.cross(&at));
                    rows.set_column(ALL + 6 + 3 * j + axis, &(chain.flange.rotation * unit));
                }
            }
        }
        rows
    }
}

#[cfg(test)]
mod tests;
