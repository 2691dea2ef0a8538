//! What do measurements make of what is known of drives of robots of this size?
//!
//! `x = ln kappa` is normal before, with the factor that all drives of a robot share; the measurements weigh in by their noise:
//!
//! ```text
//! least |y - f(e^x)|^2 / sigma^2 + (x - m)^T S^-1 (x - m)
//! ```
//!
//! by Gauss and Newton's steps, each solved by QR; the inverse of their matrix there is the covariance (Laplace). `sigma` is what remains,
//! `|y - f|^2 / (n - p)` with `p` the number of drives that the measurements decide, or the noise that the table tells where that is larger.

use nalgebra::{DMatrix, DVector, Matrix6};

use super::regression::{Spread, System};
use super::work::{Fitted, Work};
use super::written::{Fitness, rounded};
use super::{Identification, IdentifyError, MOST_RELATIVE_ERROR, Options, rms};
use crate::drive::JointCompliance;
use crate::prior::by_size;
use crate::robot::{Arm, COMPLIANCE_SOURCE, Robot};

/// Standard deviations that 95 % of a normal law stay within.
const NINETY_FIVE: f64 = 1.96;
/// Of a step of `ln kappa`: farther the slopes say nothing.
const LONGEST_STEP: f64 = 1.0;
/// Found when no `ln kappa` and no `ln sigma` changes by more.
const SETTLED: f64 = 1e-10;

/// Nobody reads a coordinate finer than this, m.
const FINEST: f64 = 1e-12;

/// What measurements make of the prior.
#[derive(Clone, Debug, PartialEq)]
pub struct Posterior {
    /// Of each drive.
    pub drives: [Updated; 6],
    /// Of `ln kappa`.
    pub covariance: Matrix6<f64>,
    /// Standard deviation that a coordinate was taken to have, m.
    pub sigma: f64,
    /// By how much more the postures scatter than their rows: part of `sigma`.
    pub clustering: f64,
}

/// A drive before and after; compliances, rad/(N m), are medians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Updated {
    /// Before.
    pub prior: f64,
    /// Standard deviation of its logarithm.
    pub prior_sd: f64,
    /// After.
    pub posterior: f64,
    /// Standard deviation of its logarithm.
    pub sd: f64,
}

impl Updated {
    /// How far the measurements moved it, in standard deviations of the prior.
    pub fn moved(&self) -> f64 {
        (self.posterior / self.prior).ln() / self.prior_sd
    }

    /// What part of the variance of the prior they took away: 0 where they tell nothing of it.
    pub fn learned(&self) -> f64 {
        1.0 - (self.sd / self.prior_sd).powi(2)
    }

    /// Where it lies with 95 % after.
    pub fn interval(&self) -> [f64; 2] {
        [-1.0, 1.0].map(|side| self.posterior * (side * NINETY_FIVE * self.sd).exp())
    }

    /// The measurements tell more of it than the prior, and it is known to half of itself.
    pub fn is_shown(&self) -> bool {
        0.5 <= self.learned() && self.sd <= MOST_RELATIVE_ERROR
    }
}

/// A normal law of `ln kappa`.
struct Gaussian {
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
}

/// What is known of the noise of a coordinate.
#[derive(Clone, Copy)]
struct Noise {
    /// By the table, m.
    given: Option<f64>,
    /// Where a search for it starts, m.
    start: f64,
    /// Times which what remains counts.
    clustering: f64,
}

/// An identification of the six drives with the prior updated, and a robot that has that.
pub(super) fn updated(work: &Work, fitted: Fitted, options: &Options) -> Result<Identification, IdentifyError> {
    let Fitted { found, spread, weights } = fitted;
    let (median, scatter) = by_size(work.robot)?;
    let prior = Gaussian {
        mean: DVector::from_iterator(6, median.iter().map(|k| k.ln())),
        covariance: DMatrix::from_column_slice(6, 6, scatter.covariance().as_slice()),
    };
    let clustering = clustering(&spread);
    let noise = Noise { given: work.noise, start: spread.sigma, clustering };
    let about = |k: &[f64]| {
        work.watch.go_on()?;
        Ok(work.about(k)?.weighted(&weights))
    };
    let (after, sigma) = update(&prior, noise, about)?;
    let total = scatter.total();
    let drives = std::array::from_fn(|i| Updated {
        prior: median[i],
        prior_sd: total[i],
        posterior: after.mean[i].exp(),
        sd: after.covariance[(i, i)].sqrt(),
    });
    let covariance = Matrix6::from_fn(|i, j| after.covariance[(i.min(j), i.max(j))]);
    let posterior = Posterior { drives, covariance, sigma, clustering };
    let k = drives.map(|drive| drive.posterior);
    let after_used = rms(&work.residual(&k));
    let fitness =
        Fitness { postures: found.postures, moved: found.before, residual: after_used, left_out: found.left_out };
    let robot = written(work.robot, &posterior, options, fitness);
    let mut estimates = found.estimates;
    estimates.iter_mut().zip(k).for_each(|(one, k)| one.used = k);
    Ok(Identification { robot, estimates, after_used, posterior: Some(posterior), ..found })
}

/// By how much more the compliances scatter when postures are left out than the remainders of rows say: rows of one posture share what
/// the model misses there.
fn clustering(spread: &Spread) -> f64 {
    let pairs = spread.by_posture.iter().zip(&spread.classical).filter(|(by_posture, _)| by_posture.is_finite());
    let ratios: Vec<f64> = pairs.map(|(by_posture, classical)| by_posture / classical).collect();
    // Without remainders both are nothing.
    rms(&ratios.into_iter().filter(|ratio| ratio.is_finite()).collect::<Vec<_>>()).max(1.0)
}

/// The law after measurements whose weighted rows are `about(kappa)`, linear about it, and what their noise was taken to be.
fn update(
    prior: &Gaussian,
    noise: Noise,
    about: impl Fn(&[f64]) -> Result<System, IdentifyError>,
) -> Result<(Gaussian, f64), IdentifyError> {
    const STEPS: usize = 200;
    let root = prior.covariance.clone().cholesky().ok_or(IdentifyError::NotFound)?.l();
    let whitened = |x: &DVector<f64>| root.solve_lower_triangular(&(x - &prior.mean)).ok_or(IdentifyError::NotFound);
    let count = prior.mean.len();
    let inverse_root = root.solve_lower_triangular(&DMatrix::identity(count, count)).ok_or(IdentifyError::NotFound)?;
    let mut x = prior.mean.clone();
    let mut sigma = noise.given.unwrap_or(0.0).max(noise.start * noise.clustering);
    for _ in 0..STEPS {
        let k = x.map(f64::exp);
        let System { a, y } = about(k.as_slice())?;
        let missed = &y - &a * &k;
        let mut slopes = a;
        slopes.column_iter_mut().zip(k.iter()).for_each(|(mut column, k)| column *= *k);
        // Two small triangles, one below the other.
        let rows = missed.len();
        let qr = slopes.qr();
        let mut right = missed.clone();
        qr.q_tr_mul(&mut right);
        let r = qr.r();
        let least = sigma.max(FINEST);
        let mut stacked = DMatrix::zeros(r.nrows() + count, count);
        stacked.rows_mut(0, r.nrows()).copy_from(&(&r / least));
        stacked.rows_mut(r.nrows(), count).copy_from(&inverse_root);
        let mut wanted = DVector::zeros(r.nrows() + count);
        wanted.rows_mut(0, r.nrows()).copy_from(&(right.rows(0, r.nrows()) / least));
        wanted.rows_mut(r.nrows(), count).copy_from(&-whitened(&x)?);
        let whole = stacked.qr();
        whole.q_tr_mul(&mut wanted);
        let triangle = whole.r();
        let step = triangle.solve_upper_triangular(&wanted.rows(0, count)).ok_or(IdentifyError::NotFound)?;
        let inverse =
            triangle.solve_upper_triangular(&DMatrix::identity(count, count)).ok_or(IdentifyError::NotFound)?;
        let covariance = &inverse * inverse.transpose();
        // As many drives as the measurements decide count as fitted.
        let decided = (r.tr_mul(&r) * &covariance).trace() / (least * least);
        let remains = (missed.norm_squared() / (rows as f64 - decided)).sqrt() * noise.clustering;
        let next = noise.given.unwrap_or(0.0).max(remains);
        let is_settled = step.amax() < SETTLED && (next.max(FINEST) - least).abs() <= SETTLED * least;
        if is_settled {
            return Ok((Gaussian { mean: x, covariance }, sigma));
        }
        x += &step * (LONGEST_STEP / step.amax()).min(1.0);
        sigma = next;
    }
    Err(IdentifyError::NotFound)
}

/// The robot with the posterior.
fn written(robot: &Robot, posterior: &Posterior, options: &Options, fitness: Fitness) -> Robot {
    let mut robot = robot.clone();
    let Arm::SixAxis { drives, .. } = &mut robot.arm else { return robot };
    let k = posterior.drives.map(|drive| rounded(drive.posterior, 1e6));
    let covariance = posterior.covariance.map_with_location(|i, j, of_ln| of_ln * (k[i.min(j)] * k[i.max(j)]));
    drives.compliance = JointCompliance(k);
    drives.scatter = None;
    let shown = posterior.drives.map(|drive| drive.is_shown());
    drives.identified = Some(fitness.identified(shown, &covariance, options.date.as_ref()));
    robot.stiffness_is_assumed = false;
    let source = format!(
        "prior by payload and reach, updated by measurements in {} postures ({})",
        fitness.postures,
        options.estimator.name()
    );
    robot.source.insert(COMPLIANCE_SOURCE.into(), source);
    robot
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(rng: &mut fastrand::Rng, rows: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, 2, |_, _| rng.f64() - 0.5)
    }

    /// Mode, mean and covariance of `ln kappa` of two drives by the density on a grid of steps of 0.005.
    fn by_quadrature(prior: &Gaussian, system: &System, sigma: f64) -> (DVector<f64>, DVector<f64>, DMatrix<f64>) {
        const EACH: usize = 801;
        let inverse = prior.covariance.clone().try_inverse().unwrap();
        let at = |i: usize| -2.0 + 4.0 * i as f64 / (EACH - 1) as f64;
        let points = (0..EACH * EACH).map(|n| &prior.mean + DVector::from_vec(vec![at(n % EACH), at(n / EACH)]));
        let points: Vec<DVector<f64>> = points.collect();
        let log = |x: &DVector<f64>| {
            let (missed, off) = (&system.y - &system.a * x.map(f64::exp), x - &prior.mean);
            -0.5 * (missed.norm_squared() / sigma.powi(2) + off.dot(&(&inverse * &off)))
        };
        let logs: Vec<f64> = points.iter().map(log).collect();
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights: Vec<f64> = logs.iter().map(|log| (log - most).exp()).collect();
        let whole: f64 = weights.iter().sum();
        let mean = points.iter().zip(&weights).fold(DVector::zeros(2), |sum, (x, w)| sum + x * (w / whole));
        let covariance = points
            .iter()
            .zip(&weights)
            .fold(DMatrix::zeros(2, 2), |sum, (x, w)| sum + (x - &mean) * (x - &mean).transpose() * (w / whole));
        let mode = points.iter().zip(&logs).max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0.clone();
        (mode, mean, covariance)
    }

    /// Laplace's law is that of the mode. Of one drive `|y - a e^x|^2 / 2 sigma^2` has the derivatives `1 / sd^2` and `3 / sd^2` there, so that the
    /// mean lies `3 / 2 sd^2` below it; of two that are identified together somewhat more.
    #[test]
    fn two_drives_have_the_law_that_quadrature_has() {
        let mut rng = fastrand::Rng::with_seed(3);
        let prior = Gaussian {
            mean: DVector::from_vec(vec![0.0, -0.3]),
            covariance: DMatrix::from_row_slice(2, 2, &[0.36, 0.12, 0.12, 0.25]),
        };
        for _ in 0..20 {
            let a = random(&mut rng, 12);
            // Nearly distinguished, so that prior and rows both count.
            let truth = DVector::from_vec(vec![1.4, 0.6]);
            let y = &a * &truth + DVector::from_fn(12, |_, _| 0.3 * (rng.f64() - 0.5));
            let system = System { a, y };
            let noise = Noise { given: Some(0.15), start: 0.0, clustering: 1.0 };
            let (found, sigma) = update(&prior, noise, |_| Ok(system.clone())).unwrap();
            let (mode, mean, covariance) = by_quadrature(&prior, &system, sigma);
            for i in 0..2 {
                let sd = covariance[(i, i)].sqrt();
                assert!((found.mean[i] - mode[i]).abs() < 0.006, "{} and {}", found.mean[i], mode[i]);
                assert!((found.mean[i] - mean[i]).abs() < 3.0 * sd * sd, "{} and {} +- {sd}", found.mean[i], mean[i]);
                let own = found.covariance[(i, i)].sqrt();
                assert!((own / sd - 1.0).abs() < 0.2 && own < 0.8 * prior.covariance[(i, i)].sqrt(), "{own} and {sd}");
            }
        }
    }

    #[test]
    fn rows_that_tell_nothing_leave_the_prior_and_rows_that_tell_all_leave_least_squares() {
        let mut rng = fastrand::Rng::with_seed(8);
        let prior = Gaussian {
            mean: DVector::from_vec(vec![0.4, 0.2]),
            covariance: DMatrix::from_row_slice(2, 2, &[0.36, 0.12, 0.12, 0.25]),
        };
        let a = random(&mut rng, 3000);
        let y = &a * DVector::from_vec(vec![0.5, 3.0]) + DVector::from_fn(3000, |_, _| 0.02 * (rng.f64() - 0.5));
        let system = System { a, y };
        let deaf = Noise { given: Some(1e9), start: 0.0, clustering: 1.0 };
        let (found, _) = update(&prior, deaf, |_| Ok(system.clone())).unwrap();
        assert!((&found.mean - &prior.mean).amax() < 1e-9 && (&found.covariance - &prior.covariance).amax() < 1e-9);
        let (found, sigma) = update(&prior, Noise { given: None, ..deaf }, |_| Ok(system.clone())).unwrap();
        let least = system.a.clone().svd(true, true).solve(&system.y, 1e-14).unwrap();
        // A part of the prior's pull: its precision over that of the rows, some 1e-6.
        assert!((found.mean.map(f64::exp) - &least).amax() < 1e-4, "{:?} {least:?}", found.mean);
        let normal = (system.a.tr_mul(&system.a)).try_inverse().unwrap();
        for i in 0..2 {
            let error = sigma * normal[(i, i)].sqrt() / least[i];
            assert!((found.covariance[(i, i)].sqrt() / error - 1.0).abs() < 1e-3);
        }
        // Uniform noise of width 0.02.
        assert!((sigma / (0.02 / 12.0_f64.sqrt()) - 1.0).abs() < 0.05, "{sigma}");
    }

    /// No row shows the second drive: what moves it is the factor that it shares with the first, by the regression of one on the other.
    #[test]
    fn a_drive_that_no_row_shows_moves_with_the_common_factor_alone() {
        let prior =
            Gaussian { mean: DVector::zeros(2), covariance: DMatrix::from_row_slice(2, 2, &[0.36, 0.12, 0.12, 0.25]) };
        let system = System {
            a: DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 1.0, 0.0, 1.0, 0.0]),
            y: DVector::from_element(3, 2.0),
        };
        let noise = Noise { given: Some(1e-4), start: 0.0, clustering: 1.0 };
        let (found, _) = update(&prior, noise, |_| Ok(system.clone())).unwrap();
        // By hand: ln 2 for the first, 0.12 / 0.36 of that for the second, whose variance is 0.25 - 0.12^2 / 0.36 = 0.21.
        assert!((found.mean[0] - 2.0_f64.ln()).abs() < 1e-6 && (found.mean[1] - 2.0_f64.ln() / 3.0).abs() < 1e-6);
        assert!((found.covariance[(1, 1)] - 0.21).abs() < 1e-6);
    }
}
