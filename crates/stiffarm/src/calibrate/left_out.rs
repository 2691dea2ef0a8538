//! What does a fit say of postures that it has not seen? A third of each joint's range is predicted by the rest of the rows.

use nalgebra::{Cholesky, DVector, Dyn};

use super::fit::{Fitted, Rows, points_open};
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
    /// The root of `H` of the other rows.
    root: Cholesky<f64, Dyn>,
}

/// Distances of what is left out.
pub(super) struct LeftOut {
    /// Root mean square, m.
    pub(super) rms: f64,
    /// The same as it is expected of noise, of what points of a posture share and of what the other rows do not show, m.
    pub(super) expected: f64,
}

impl Third<'_> {
    /// How many points are left out, and the sum of their squared distances.
    fn missed(&self) -> (usize, f64) {
        let of_row = |row: &&Linear| {
            let missed = &row.residual - &row.jacobian * &self.step;
            row.points().map(|(at, _)| missed.rows(at, 3).norm_squared()).collect::<Vec<f64>>()
        };
        let all: Vec<f64> = self.rows.iter().flat_map(of_row).collect();
        (all.len(), all.iter().sum())
    }
}

/// How far what is left out is off, root mean square, m; `None` where no third can be.
///
/// The fit without some rows is one step from the fit with all: `H' = H - J'WJ` of those rows. The step is exact but for the second order of
/// errors of some mrad, which is some um.
pub(super) fn rms(rows: &Rows, fitted: &Fitted) -> Option<f64> {
    let missed = thirds(rows, fitted).map(|third| third.missed());
    let (count, squares) = missed.fold((0, 0.0), |(count, sum), (more, squares)| (count + more, sum + squares));
    (0 < count).then(|| (squares / count as f64).sqrt())
}

/// The same with what is expected of it.
pub(super) fn left_out(rows: &Rows, fitted: &Fitted) -> Option<LeftOut> {
    let (mut count, mut squares, mut expected) = (0, 0.0, 0.0);
    for third in thirds(rows, fitted) {
        let (of_third, missed) = third.missed();
        // Of the unknowns by the other rows, in parts of the variance of a reading.
        let open = points_open(third.rows.iter().copied(), &third.root.inverse());
        expected += open.iter().sum::<f64>() + 3.0 * (1.0 + fitted.common) * of_third as f64;
        (count, squares) = (count + of_third, squares + missed);
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
    Some(Third { rows: out.iter().map(|&i| &fitted.rows[i]).collect(), step: root.solve(&g), root })
}
