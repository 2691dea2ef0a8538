//! What is reported of a fit besides its values: what is seen worst, what remains where, and which readings do not fit.

use nalgebra::{DVector, Vector3};

use super::regression::{Solution, Spread, System};
use crate::catalogue::measurements::Reading;

/// Springs by how much each takes part; the squares add up to 1, in the order of the springs.
pub type Combination = Vec<f64>;

/// What remains of one reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// Its row, from 1.
    pub row: usize,
    /// Its posture, from 0.
    pub posture: usize,
    /// The displacement along base axes, m.
    pub moved: Vector3<f64>,
    /// What the compliances found leave of it, m.
    pub after: Vector3<f64>,
    /// What those leave that are found without its posture, m; `None` where that posture alone shows some spring.
    pub left_out: Option<Vector3<f64>>,
    /// What Huber's estimate leaves, in standard deviations of a coordinate.
    pub ratio: f64,
}

/// A reading that does not fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// Its row, from 1.
    pub row: usize,
    /// What Huber's estimate leaves of it, in standard deviations of a coordinate.
    pub ratio: f64,
}

/// Singular values, descending, and the direction of the smallest.
pub(super) fn seen(system: &System) -> (Vec<f64>, Combination) {
    let count = system.a.ncols();
    let svd = system.reduced().0.svd(false, true);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&i, &j| svd.singular_values[j].total_cmp(&svd.singular_values[i]));
    let values: Vec<f64> = order.iter().map(|&i| svd.singular_values[i]).collect();
    // Rounding alone.
    let floor = 1e-12 * values.first().copied().unwrap_or(0.0);
    let values = values.into_iter().map(|value| if value <= floor { 0.0 } else { value }).collect();
    let least =
        svd.v_t.zip(order.last()).map_or_else(Vec::new, |(vectors, &last)| vectors.row(last).iter().copied().collect());
    (values, least)
}

/// Of every reading; `weights` are those of the fit.
pub(super) fn residuals(
    readings: &[Reading],
    moved: &DVector<f64>,
    solution: &Solution,
    (spread, weights): (&Spread, &[f64]),
    ratios: &[f64],
) -> Vec<Residual> {
    let of = |i: usize| {
        let left_out = |c: usize| spread.left_out[3 * i + c].map(|missed| missed / weights[i]);
        let three = left_out(0).zip(left_out(1)).zip(left_out(2));
        Residual {
            row: readings[i].row,
            posture: readings[i].posture,
            moved: moved.fixed_rows::<3>(3 * i).into(),
            after: Vector3::from(solution.residual.fixed_rows::<3>(3 * i)) / weights[i],
            left_out: three.map(|((x, y), z)| Vector3::new(x, y, z)),
            ratio: ratios[i],
        }
    };
    (0..readings.len()).map(of).collect()
}

/// That springs explain so little of what was measured, in rows that are not named for themselves, that something else is the matter.
pub(super) fn little_explained(measured: &[f64], residual: &[f64], is_out: &[bool]) -> Option<String> {
    const LITTLE: f64 = 0.5;
    let of_right = |values: &[f64]| {
        let rows = values.chunks(3).zip(is_out).filter(|(_, is_out)| !**is_out);
        super::rms(&rows.flat_map(|(row, _)| row.iter().copied()).collect::<Vec<_>>())
    };
    let explained = 1.0 - of_right(residual) / of_right(measured);
    (explained < LITTLE).then(|| {
        format!(
            "springs explain {:.0} % of the displacements of the rows that are not named: are axes of displacements and forces the same, and is load point and tool right? Else something that is no drive gives way",
            100.0 * explained.max(0.0)
        )
    })
}

/// Readings that do not fit, the worst first.
pub(super) fn outliers(readings: &[Reading], (ratios, is_out): (&[f64], &[bool])) -> Vec<Outlier> {
    let mut found: Vec<Outlier> = (readings.iter().zip(ratios).zip(is_out))
        .filter(|(_, is_out)| **is_out)
        .map(|((reading, ratio), _)| Outlier { row: reading.row, ratio: *ratio })
        .collect();
    found.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    found
}
