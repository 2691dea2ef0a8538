//! How far is the calibrated arm still off where the work is? From the posterior of all unknowns, with the noise that left-out
//! thirds show and what no level explains.

use nalgebra::{DVector, Vector3};

use super::fit::{Fitted, Given, Rows};
use super::left_out::LeftOut;
use super::{CalibrateError, Work};
use crate::chain::{ALL, FRAMES};
use crate::limits::Limits;
use crate::prior::normal;
use crate::registration::{Problem, Sight, stacked};

/// Draws of the unknowns: the ends of 95 % of so many are known to one per cent of a normal's spread.
const DRAWS: usize = 400;
/// Postures over which is asked.
const POSTURES: usize = 200;

/// The error that remains, as the same instrument would measure it there, with the noise of its readings: expected and with its 95 % interval, m.
#[derive(Clone, Debug, PartialEq)]
pub struct AtWork {
    /// Root mean square over the postures, expected.
    pub expected: f64,
    /// Where that root mean square lies with 95 %.
    pub interval: [f64; 2],
    /// 95th percentile.
    pub p95: f64,
    /// Over how many postures it was asked.
    pub postures: usize,
}

/// Postures within limits, near the work where a point is given.
fn postures(rows: &Rows, limits: &Limits, near: Option<Vector3<f64>>) -> Vec<[f64; 6]> {
    /// m.
    const RADIUS: f64 = 0.25;
    /// Of which those near a point are taken.
    const TRIED: usize = 100_000;
    let mut rng = fastrand::Rng::with_seed(95);
    let mut found = Vec::new();
    for _ in 0..TRIED {
        let q: [f64; 6] = std::array::from_fn(|i| {
            let range = limits.joints[i].or_one_turn();
            range.min() + rng.f64() * range.width()
        });
        let is_near = near.is_none_or(|at| (rows.arm.drawn(&q).translation.vector - at).norm() <= RADIUS);
        if is_near {
            found.push(q);
        }
        if found.len() == POSTURES {
            break;
        }
    }
    found
}

/// The error at the work of the first point, seen from the first stand; `None` where the arm does not reach it.
///
/// # Errors
/// Where the rows do not determine the unknowns.
pub(super) fn at_work(
    rows: &Rows,
    fitted: &Fitted,
    left_out: Option<&LeftOut>,
    (limits, work): (&Limits, &Work),
) -> Result<Option<AtWork>, CalibrateError> {
    let postures = match work {
        Work::Anywhere => postures(rows, limits, None),
        Work::Near(at) => postures(rows, limits, Some(Vector3::from(*at))),
        Work::OtherDay(postures) => postures.clone(),
    };
    if postures.is_empty() {
        return Ok(None);
    }
    let kept = fitted.given().coordinate();
    // So many times as far are thirds off that are left out as noise and unknowns have it.
    let noise = kept * left_out.map_or(1.0, |found| (found.rms / found.expected).max(1.0));
    // Of a reading, where a point stands so far off.
    let of_reading = 1.0 / (1.0 + fitted.common).sqrt();
    let given = Given { noise: noise * of_reading, ..fitted.given() };
    let (h, _) = rows.normal(fitted.rows.iter(), &fitted.state, given);
    let sights: Vec<Sight> = (postures.iter())
        .map(|q| Sight {
            q: *q,
            points: (0..rows.points).map(|j| (j == 0).then(|| (Vector3::zeros(), 1.0))).collect(),
            orientation: None,
            stand: 0,
        })
        .collect();
    let chain = |parameters: &[f64], q: &[f64; 6]| rows.arm.chain(parameters, q);
    let precision = fitted.prior.iter().map(|tau| if *tau == 0.0 { f64::INFINITY } else { 0.0 }).collect();
    let problem = Problem {
        sights: &sights,
        stands: rows.stands,
        points: rows.points,
        lever: 1.0,
        base: None,
        tool: None,
        precision,
        common: 0.0,
        chain: &chain,
    };
    let linear = problem.linear(&fitted.state);
    let unknowns: Vec<usize> = (0..problem.unknowns()).collect();
    let moved = stacked(&linear.iter().collect::<Vec<_>>(), &unknowns);
    // Where instrument and point are found anew, least squares take the part of the errors that they explain.
    let anew = matches!(work, Work::OtherDay(_)).then(|| {
        let point = problem.first_point();
        let unknown: Vec<usize> = (0..6).chain(point..point + 3).collect();
        moved.select_columns(&unknown).qr().q()
    });
    let [mut rng, mut shares] = [96, 98].map(fastrand::Rng::with_seed);
    let mut normal = || normal(&mut rng);
    let n = h.nrows();
    let first = n - ALL;
    let precision = |i: usize, noise: f64, scale: f64| {
        let tau = fitted.prior[i] * if i < FRAMES { scale } else { 1.0 };
        (noise / tau).powi(2)
    };
    let (mut means, mut all) = (Vec::new(), Vec::new());
    for _ in 0..DRAWS {
        // Noise and scale are known by what is left over and by what the data show.
        let [of_noise, scale] = [fitted.spare, fitted.seen].map(|freedom| factor(freedom, normal()));
        // Where thirds that are left out err more than is expected, no level explains what is there. How much of that comes again in other
        // postures nobody knows: nothing in every other draw, else any share.
        let again = (2.0 * shares.f64() - 1.0).max(0.0);
        let drawn = of_noise * (kept + again * (noise - kept));
        let mut h = h.clone();
        for i in (0..ALL).filter(|&i| fitted.prior[i] != 0.0) {
            h[(first + i, first + i)] +=
                precision(i, drawn * of_reading, scale) - precision(i, noise * of_reading, 1.0);
        }
        let root = h.cholesky().ok_or(CalibrateError::Undetermined)?;
        let z = DVector::from_fn(n, |_, _| normal());
        // cov = s^2 H^-1 = s^2 L^-T L^-1.
        let mut step = root.l_dirty().tr_solve_lower_triangular(&z).ok_or(CalibrateError::Undetermined)?;
        step *= drawn * of_reading;
        for i in (0..ALL).filter(|&i| fitted.prior[i] == 0.0) {
            step[first + i] = 0.0;
        }
        let mut off = &moved * &step;
        off.apply(|x| *x += drawn * normal());
        if let Some(anew) = &anew {
            off -= anew * anew.tr_mul(&off);
        }
        let squares: Vec<f64> = off.as_slice().chunks_exact(3).map(|off| off.iter().map(|x| x * x).sum()).collect();
        means.push((squares.iter().sum::<f64>() / squares.len() as f64).sqrt());
        all.extend(squares.into_iter().map(f64::sqrt));
    }
    means.sort_by(f64::total_cmp);
    all.sort_by(f64::total_cmp);
    let at = |values: &[f64], share: f64| values[((values.len() as f64 * share) as usize).min(values.len() - 1)];
    let expected = (means.iter().map(|x| x * x).sum::<f64>() / means.len() as f64).sqrt();
    Ok(Some(AtWork {
        expected,
        interval: [at(&means, 0.025), at(&means, 0.975)],
        p95: at(&all, 0.95),
        postures: postures.len(),
    }))
}

/// A draw of what a standard deviation may be in parts of its estimate from so many squares, of a normal draw: the root of `v / chi^2_v` by Wilson's
/// and Hilferty's cube.
fn factor(freedom: f64, normal: f64) -> f64 {
    /// Fewer squares tell nothing that a draw could be made of.
    const LEAST: f64 = 4.0;
    let part = 2.0 / (9.0 * freedom.max(LEAST));
    (1.0 - part + normal * part.sqrt()).max(0.1).powf(-1.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `v / f^2` is distributed as `chi^2_v`: its mean is `v` and its variance `2 v`.
    #[test]
    fn drawn_standard_deviations_are_those_of_as_many_squares() {
        const COUNT: usize = 100_000;
        let mut rng = fastrand::Rng::with_seed(97);
        for freedom in [5.0, 18.0, 235.0] {
            let squares: Vec<f64> = (0..COUNT).map(|_| freedom * factor(freedom, normal(&mut rng)).powi(-2)).collect();
            let mean = squares.iter().sum::<f64>() / COUNT as f64;
            let variance = squares.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / COUNT as f64;
            // The cube is good to some thousandths there, and as many draws to 1 % of a variance.
            assert!((mean / freedom - 1.0).abs() < 0.01, "{freedom}: {mean}");
            assert!((variance / (2.0 * freedom) - 1.0).abs() < 0.05, "{freedom}: {variance}");
        }
    }
}
