//! What does a fit say of postures that it has not seen? A third of each joint's range is predicted by the rest of the rows.

use nalgebra::Vector3;

use super::fit::{Fitted, Rows};

/// rad: a joint that moves by less has no thirds.
const LEAST_RANGE: f64 = 0.02;
/// So many rows must be left to fit.
const LEAST_ROWS: usize = 4;

/// Root mean square of the distances of what is left out, m; `None` where no third can be.
///
/// The fit without some rows is one step from the fit with all: `H' = H - J'WJ` of those rows. The step is exact but for the second order of
/// errors of some mrad, which is some um.
pub(super) fn left_out(rows: &Rows, fitted: &Fitted) -> Option<f64> {
    let given = (fitted.prior.as_slice(), fitted.noise);
    let (mut squares, mut count) = (0.0, 0_usize);
    for joint in 0..6 {
        let angles: Vec<f64> = rows.sights.iter().map(|sight| sight.q[joint]).collect();
        let [low, high] = [
            angles.iter().copied().fold(f64::INFINITY, f64::min),
            angles.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ];
        if high - low < LEAST_RANGE {
            continue;
        }
        for third in 0..3 {
            let is_out = |i: usize| (((angles[i] - low) / (high - low) * 3.0) as usize).min(2) == third;
            let out: Vec<usize> = (0..angles.len()).filter(|&i| is_out(i)).collect();
            let rest: Vec<usize> = (0..angles.len()).filter(|&i| !is_out(i)).collect();
            let sees_all = |of: &dyn Fn(usize) -> bool| (0..angles.len()).any(|i| !is_out(i) && of(i));
            let has_stands = (0..rows.stands).all(|stand| sees_all(&|i| rows.sights[i].stand == stand));
            let has_points = (0..rows.points).all(|j| sees_all(&|i| rows.sights[i].points[j].is_some()));
            if out.is_empty() || rest.len() < LEAST_ROWS || !has_stands || !has_points {
                continue;
            }
            let (h, g) = rows.normal(rest.iter().map(|&i| &fitted.rows[i]), &fitted.state, given);
            let Some(root) = h.cholesky() else { continue };
            let step = root.solve(&g);
            for row in out.iter().map(|&i| &fitted.rows[i]) {
                let off = &row.residual - &row.jacobian * &step;
                for block in row.of.iter().enumerate().filter(|(_, point)| point.is_some()).map(|(block, _)| block) {
                    let off: Vector3<f64> = off.fixed_rows::<3>(3 * block).into();
                    squares += off.norm_squared();
                    count += 1;
                }
            }
        }
    }
    (0 < count).then(|| (squares / count as f64).sqrt())
}
