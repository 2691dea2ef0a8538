//! Did the instrument move while the arm was measured? A second frame from some row on, against the fit with one.

use nalgebra::{DMatrix, Matrix6, Vector6};

use super::fit::{Fitted, Rows};

/// Rows before it, and from it on.
const LEAST_ROWS: usize = 5;
/// Of the squares that are left: of a smaller part the arm may be the reason.
const EXPLAINED: f64 = 0.5;
/// Of chi squared with six degrees of freedom at whichever row: by chance once in 10^10 tables.
const SURE: f64 = 60.0;

/// The row from which on the points stand elsewhere, and how far, m, root mean square.
///
/// A frame of its own of the rows from `k` on is six unknowns more: from the fit without them, their step is `(Z'WZ - Z'WJ H^-1 J'WZ)^-1 Z'Wr`, with
/// their columns `Z`, and the squares become less by the product of step and `Z'Wr`.
pub(super) fn moved(rows: &Rows, fitted: &Fitted) -> Option<(usize, f64)> {
    let count = fitted.rows.len();
    if rows.stands != 1 || count < 2 * LEAST_ROWS {
        return None;
    }
    let (h, _) = rows.normal(fitted.rows.iter(), &fitted.state, fitted.given());
    let mut crossed = DMatrix::zeros(h.nrows(), 6);
    let (mut own, mut slope) = (Matrix6::zeros(), Vector6::zeros());
    let (root, mut best, mut squares) = (h.cholesky()?, None, 0.0);
    for (i, row) in fitted.rows.iter().enumerate().rev() {
        let base = row.jacobian.columns(0, 6);
        let mut weighted = base.clone_owned();
        weighted.column_iter_mut().for_each(|mut column| column.component_mul_assign(&row.weight));
        crossed += row.jacobian.tr_mul(&weighted);
        own += base.tr_mul(&weighted);
        slope += weighted.tr_mul(&row.residual);
        squares += row.residual.component_mul(&row.residual).dot(&row.weight);
        if i < LEAST_ROWS || count - i < LEAST_ROWS {
            continue;
        }
        let Some(alone) = (own - crossed.tr_mul(&root.solve(&crossed))).cholesky() else { continue };
        let step = alone.solve(&slope);
        let gain = step.dot(&slope);
        if best.is_none_or(|(_, _, most)| most < gain) {
            best = Some((i, step, gain));
        }
    }
    let (from, step, gain) = best?;
    if gain < EXPLAINED * squares || gain < SURE * fitted.noise.powi(2) {
        return None;
    }
    let later = fitted.rows[from..]
        .iter()
        .flat_map(|row| row.points().map(move |(at, _)| (row.jacobian.view((at, 0), (3, 6)) * step).norm_squared()));
    let far: Vec<f64> = later.collect();
    Some((from, (far.iter().sum::<f64>() / far.len() as f64).sqrt()))
}
