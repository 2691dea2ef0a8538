//! What does a fit say of postures that it has not seen? A third of each joint's range is predicted by the rest of the rows.

use nalgebra::{DMatrix, DVector};

use super::fit::{Fitted, Rows};
use crate::registration::{Linear, Sight};

/// rad: a joint that moves by less has no thirds.
const LEAST_RANGE: f64 = 0.02;
/// So many rows must be left to fit.
const LEAST_ROWS: usize = 4;

/// Rows that were left out, and how the fit with the others has them.
struct Third<'r> {
    rows: Vec<&'r Linear>,
    /// From the fit with all rows to that without them.
    step: DVector<f64>,
    /// Of the unknowns by the other rows, in parts of the variance of a reading.
    covariance: DMatrix<f64>,
}

/// Distances of what is left out.
pub(super) struct LeftOut {
    /// Root mean square, m.
    pub(super) rms: f64,
    /// The same as it is expected of noise, of what points of a posture share and of what the other rows do not show, m.
    pub(super) expected: f64,
}

/// How far what is left out is off; `None` where no third can be.
///
/// The fit without some rows is one step from the fit with all: `H' = H - J'WJ` of those rows. The step is exact but for the second order of
/// errors of some mrad, which is some um.
pub(super) fn left_out(rows: &Rows, fitted: &Fitted) -> Option<LeftOut> {
    let (mut squares, mut expected, mut count) = (0.0, 0.0, 0_usize);
    for Third { rows, step, covariance } in thirds(rows, fitted) {
        for row in rows {
            expected += row.open(&covariance);
            for (at, _) in row.points() {
                squares += (row.residual.rows(at, 3) - row.jacobian.rows(at, 3) * &step).norm_squared();
                expected += 3.0 * (1.0 + fitted.common);
                count += 1;
            }
        }
    }
    let root_mean = |sum: f64| (sum / count as f64).sqrt();
    (0 < count).then(|| LeftOut { rms: root_mean(squares), expected: fitted.noise * root_mean(expected) })
}

/// Thirds of each joint's range of which the others show the same stands and points.
fn thirds<'r>(rows: &'r Rows, fitted: &'r Fitted) -> impl Iterator<Item = Third<'r>> {
    let of_joint = move |joint: usize| {
        let angles: Vec<f64> = rows.sights.iter().map(|sight| sight.q[joint]).collect();
        let low = angles.iter().copied().fold(f64::INFINITY, f64::min);
        let high = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let third_of = |angle: f64| (((angle - low) / (high - low) * 3.0) as usize).min(2);
        let has_thirds = LEAST_RANGE <= high - low;
        let found: Vec<usize> = angles.into_iter().map(third_of).collect();
        (0..3).filter(move |_| has_thirds).filter_map(move |third| without(rows, fitted, |i| found[i] == third))
    };
    (0..6).flat_map(of_joint)
}

/// The fit without some rows; `None` where there are none, or the rest shows too little.
fn without<'r>(rows: &Rows, fitted: &'r Fitted, is_out: impl Fn(usize) -> bool) -> Option<Third<'r>> {
    let (out, rest): (Vec<usize>, Vec<usize>) = (0..rows.sights.len()).partition(|&i| is_out(i));
    let sees = |of: &dyn Fn(&Sight) -> bool| rest.iter().any(|&i| of(&rows.sights[i]));
    let has_stands = (0..rows.stands).all(|stand| sees(&|sight| sight.stand == stand));
    let has_points = (0..rows.points).all(|j| sees(&|sight| sight.points[j].is_some()));
    if out.is_empty() || rest.len() < LEAST_ROWS || !has_stands || !has_points {
        return None;
    }
    let (h, g) = rows.normal(rest.iter().map(|&i| &fitted.rows[i]), &fitted.state, fitted.given());
    let root = h.cholesky()?;
    Some(Third {
        rows: out.iter().map(|&i| &fitted.rows[i]).collect(),
        step: root.solve(&g),
        covariance: root.inverse(),
    })
}
