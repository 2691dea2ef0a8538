//! Least squares with compliances that are not negative, and how well they are known: QR, then small matrices alone.

use nalgebra::{Cholesky, DMatrix, DVector};

/// A column that is so much smaller than the largest is not seen at all: rounding alone.
const NOTHING: f64 = 1e-9;
/// The same of a combination of columns that are scaled to the same length.
const NO_COMBINATION: f64 = 1e-8;

/// `y = A x`, row by row in blocks of three, the coordinates of a displacement.
#[derive(Clone, Debug)]
pub(super) struct System {
    /// 3 readings x springs.
    pub a: DMatrix<f64>,
    /// 3 readings.
    pub y: DVector<f64>,
}

impl System {
    /// The same with every block of three rows times a weight.
    pub(super) fn weighted(mut self, weights: &[f64]) -> Self {
        if weights.iter().all(|weight| *weight == 1.0) {
            return self;
        }
        for mut column in self.a.column_iter_mut() {
            column.iter_mut().enumerate().for_each(|(i, x)| *x *= weights[i / 3]);
        }
        for (i, y) in self.y.iter_mut().enumerate() {
            *y *= weights[i / 3];
        }
        self
    }

    /// What remains where some columns have fixed values.
    pub(super) fn holding(self, held: &[Option<f64>]) -> Self {
        if held.iter().all(Option::is_none) {
            return self;
        }
        let fixed = DVector::from_iterator(held.len(), held.iter().map(|value| value.unwrap_or(0.0)));
        let free: Vec<usize> = (0..held.len()).filter(|&i| held[i].is_none()).collect();
        Self { a: self.a.select_columns(&free), y: &self.y - &self.a * fixed }
    }

    /// R of `A = Q R`, and `Q^T y`; with rows of zeros where there are less rows than columns. Rows are taken in blocks that stay in the
    /// cache, each below the triangle of those before.
    pub(super) fn reduced(&self) -> (DMatrix<f64>, DVector<f64>) {
        const BLOCK: usize = 192;
        let (rows, count) = self.a.shape();
        let mut r = DMatrix::zeros(0, count + 1);
        for first in (0..rows).step_by(BLOCK) {
            let (above, more) = (r.nrows(), BLOCK.min(rows - first));
            let mut stacked = DMatrix::zeros(above + more, count + 1);
            stacked.rows_mut(0, above).copy_from(&r);
            stacked.view_mut((above, 0), (more, count)).copy_from(&self.a.rows(first, more));
            stacked.view_mut((above, count), (more, 1)).copy_from(&self.y.rows(first, more));
            r = stacked.qr().r();
        }
        let r = r.resize(count, count + 1, 0.0);
        (r.columns(0, count).into_owned(), r.column(count).into_owned())
    }
}

/// Columns that the rows do not show: each alone, or together with others of which only a sum is shown.
pub(super) fn unseen(system: &System) -> Vec<Vec<usize>> {
    let (r, _) = system.reduced();
    let norms: Vec<f64> = r.column_iter().map(|column| column.norm()).collect();
    let largest = norms.iter().copied().fold(0.0, f64::max);
    let is_seen = |i: &usize| NOTHING * largest < norms[*i];
    let seen: Vec<usize> = (0..norms.len()).filter(is_seen).collect();
    let mut groups: Vec<Vec<usize>> = (0..norms.len()).filter(|i| !is_seen(i)).map(|i| vec![i]).collect();
    if seen.is_empty() {
        return groups;
    }
    let mut scaled = r.select_columns(&seen);
    for (mut column, &i) in scaled.column_iter_mut().zip(&seen) {
        column /= norms[i];
    }
    let svd = scaled.svd(false, true);
    let Some(vectors) = svd.v_t else { return groups };
    let largest = svd.singular_values.max();
    let mut combined = Vec::new();
    for (vector, value) in vectors.row_iter().zip(svd.singular_values.iter()) {
        if *value <= NO_COMBINATION * largest {
            combined.extend(seen.iter().zip(vector.iter()).filter(|(_, part)| 1e-4 < part.abs()).map(|(&i, _)| i));
        }
    }
    combined.sort_unstable();
    combined.dedup();
    if !combined.is_empty() {
        groups.push(combined);
    }
    groups
}

/// A solution, in which some values may stand at zero, their bound.
#[derive(Clone, Debug)]
pub(super) struct Solution {
    /// Not negative.
    pub values: Vec<f64>,
    /// Those that do not stand at zero.
    pub free: Vec<usize>,
    /// What remains of every row.
    pub residual: DVector<f64>,
    /// R of the free columns.
    pub r: DMatrix<f64>,
    /// Their orthonormal basis, `A = Z R`; transposed, so that a row is one piece of memory.
    pub z: DMatrix<f64>,
}

/// Least squares with values that are not negative (Lawson and Hanson's active set), all columns seen. `None` where there is no solution
/// in numbers.
pub(super) fn solve(system: &System) -> Option<Solution> {
    let columns = system.a.ncols();
    if system.a.nrows() < columns {
        return None;
    }
    let (mut r, right) = system.reduced();
    // A column of nothing keeps its zero.
    let scale = |norm: f64| if 0.0 < norm { norm.recip() } else { 1.0 };
    let scale: Vec<f64> = r.column_iter().map(|column| scale(column.norm())).collect();
    let mut scaled = r.clone();
    for (mut column, scale) in scaled.column_iter_mut().zip(&scale) {
        column *= *scale;
    }
    let x = not_negative(&scaled, &right)?;
    let free: Vec<usize> = (0..columns).filter(|&i| 0.0 < x[i]).collect();
    let values: Vec<f64> = x.iter().zip(&scale).map(|(x, scale)| x * scale).collect();
    let residual = &system.y - &system.a * DVector::from_column_slice(&values);
    if free.len() < columns {
        r = r.select_columns(&free).qr().r();
    }
    let z = basis(&system.a, &free, &r)?;
    Some(Solution { values, free, residual, r, z })
}

/// `Z^T` of some columns `A = Z R`, row by row of A; `None` where R is singular.
pub(super) fn basis(a: &DMatrix<f64>, free: &[usize], r: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let (rows, count) = (a.nrows(), free.len());
    let mut z = DMatrix::zeros(count, rows);
    if r.diagonal().iter().any(|x| *x == 0.0) {
        return None;
    }
    // Where nothing is free, there is no piece to fill.
    for (row, z) in z.as_mut_slice().chunks_exact_mut(count.max(1)).enumerate() {
        for (j, &column) in free.iter().enumerate() {
            let before: f64 = (0..j).map(|i| z[i] * r[(i, j)]).sum();
            z[j] = (a[(row, column)] - before) / r[(j, j)];
        }
    }
    Some(z)
}

/// The least `|R x - d|` with `x >= 0`, of a small matrix.
pub(super) fn not_negative(r: &DMatrix<f64>, d: &DVector<f64>) -> Option<DVector<f64>> {
    let count = r.ncols();
    // The best of all, where that is allowed: then nothing need be searched.
    if let Some(best) = triangular(r, d).filter(|best| best.iter().all(|value| 0.0 < *value)) {
        return Some(best);
    }
    let mut x = DVector::zeros(count);
    let mut passive = vec![false; count];
    let slack = 1e-12 * d.norm().max(f64::MIN_POSITIVE);
    for _ in 0..30 * count.max(1) {
        let slope = r.tr_mul(&(d - r * &x));
        let steepest =
            (0..count).filter(|&i| !passive[i] && slack < slope[i]).max_by(|&i, &j| slope[i].total_cmp(&slope[j]));
        let Some(steepest) = steepest else { return Some(x) };
        passive[steepest] = true;
        loop {
            let set: Vec<usize> = (0..count).filter(|&i| passive[i]).collect();
            let own = r.select_columns(&set);
            let best = own.svd(true, true).solve(d, 1e-14).ok()?;
            if best.iter().all(|value| 0.0 < *value) {
                x.fill(0.0);
                set.iter().zip(best.iter()).for_each(|(&i, value)| x[i] = *value);
                break;
            }
            // As far towards it as none becomes negative.
            let step = set.iter().zip(best.iter()).filter(|(_, value)| **value <= 0.0);
            let share = step.map(|(&i, value)| x[i] / (x[i] - value)).fold(1.0, f64::min);
            for (&i, value) in set.iter().zip(best.iter()) {
                x[i] += share * (value - x[i]);
                if x[i] <= 1e-14 * x.amax() {
                    (x[i], passive[i]) = (0.0, false);
                }
            }
            if passive.iter().all(|passive| !passive) {
                break;
            }
        }
    }
    Some(x)
}

/// `x` of `R x = d` where R is an upper triangle that is far from singular; `None` where it is not.
fn triangular(r: &DMatrix<f64>, d: &DVector<f64>) -> Option<DVector<f64>> {
    const FAR: f64 = 1e-9;
    let (rows, count) = r.shape();
    let is_triangle = rows == count && (0..count).all(|j| (j + 1..rows).all(|i| r[(i, j)] == 0.0));
    let diagonal = || (0..count).map(|i| r[(i, i)].abs());
    if !is_triangle || !(FAR * diagonal().fold(0.0, f64::max) < diagonal().fold(f64::INFINITY, f64::min)) {
        return None;
    }
    r.solve_upper_triangular(d)
}

/// How well the free values of a solution are known.
#[derive(Clone, Debug)]
pub(super) struct Spread {
    /// Standard error of each free value, from the scatter of all residuals: `s^2 (A^T A)^-1`.
    pub classical: Vec<f64>,
    /// The same from leaving out each posture in turn; infinite where one posture alone shows it.
    pub by_posture: Vec<f64>,
    /// Correlation of the free values.
    pub correlation: DMatrix<f64>,
    /// Standard deviation of a row.
    pub sigma: f64,
    /// What every row misses when its posture is left out; `None` where that posture alone shows some value.
    pub left_out: Vec<Option<f64>>,
}

/// `groups` says of every block of three rows to which posture it belongs, from 0.
pub(super) fn spread(solution: &Solution, groups: &[usize]) -> Option<Spread> {
    let Solution { free, residual, r, z, .. } = solution;
    let (rows, count) = (residual.len(), free.len());
    let sigma = (residual.norm_squared() / (rows.checked_sub(count).filter(|dof| 0 < *dof)?) as f64).sqrt();
    let inverse = r.clone().solve_upper_triangular(&DMatrix::identity(count, count))?;
    let covariance = &inverse * inverse.transpose();
    let classical: Vec<f64> = covariance.diagonal().iter().map(|variance| sigma * variance.sqrt()).collect();
    let correlation =
        DMatrix::from_fn(count, count, |i, j| covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt());
    let postures = groups.iter().max().map_or(0, |last| last + 1);
    let mut of_posture: Vec<Vec<usize>> = vec![Vec::new(); postures];
    groups
        .iter()
        .enumerate()
        .for_each(|(block, &posture)| of_posture[posture].extend([3 * block, 3 * block + 1, 3 * block + 2]));
    let mut left_out = vec![None; rows];
    let mut changed: Vec<DVector<f64>> = Vec::new();
    let mut is_alone = vec![false; count];
    let z = z.as_slice();
    for own in of_posture.iter().filter(|own| !own.is_empty()) {
        // (A^T A without the posture)^-1 = R^-1 (I - Z^T Z)^-1 R^-T; the lower triangle is enough.
        let (mut rest, mut right) = (DMatrix::identity(count, count), DVector::zeros(count));
        for &row in own {
            let z = &z[count * row..][..count];
            for a in 0..count {
                right[a] += z[a] * residual[row];
                (0..=a).for_each(|b| rest[(a, b)] -= z[a] * z[b]);
            }
        }
        let Some(rest) =
            Cholesky::new(rest.clone()).filter(|found| found.l_dirty().diagonal().iter().all(|x| 1e-6 < *x))
        else {
            let eigen = rest.symmetric_eigen();
            for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                if *value < 1e-11 {
                    let lone = &inverse * vector;
                    let share = |i: usize| lone[i].abs() * r.column(i).norm();
                    (0..count).filter(|&i| 1e-6 < share(i)).for_each(|i| is_alone[i] = true);
                }
            }
            continue;
        };
        let step = rest.solve(&right);
        for &row in own {
            let along: f64 = z[count * row..][..count].iter().zip(step.iter()).map(|(z, step)| z * step).sum();
            left_out[row] = Some(residual[row] + along);
        }
        changed.push(-(&inverse * step));
    }
    let number = changed.len() as f64;
    let mean = changed.iter().fold(DVector::zeros(count), |sum, one| sum + one) / number.max(1.0);
    let by_posture = (0..count).map(|i| {
        let sum: f64 = changed.iter().map(|one| (one[i] - mean[i]).powi(2)).sum();
        if is_alone[i] || number < 2.0 { f64::INFINITY } else { (sum * (number - 1.0) / number).sqrt() }
    });
    Some(Spread { classical, by_posture: by_posture.collect(), correlation, sigma, left_out })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(rng: &mut fastrand::Rng, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| rng.f64() - 0.5)
    }

    /// `R^T R = A^T A` and `R^T (Q^T y) = A^T y`, with less rows than columns, with one block and with several.
    #[test]
    fn rows_taken_in_blocks_give_the_normal_equations_of_all_rows() {
        let mut rng = fastrand::Rng::with_seed(6);
        for rows in [2, 5, 192, 193, 1000] {
            let a = random(&mut rng, rows, 5);
            let y = DVector::from_fn(rows, |_, _| rng.f64() - 0.5);
            let (r, right) = System { a: a.clone(), y: y.clone() }.reduced();
            assert_eq!(r, r.upper_triangle());
            assert!((r.tr_mul(&r) - a.tr_mul(&a)).amax() < 1e-13 * rows as f64);
            assert!((r.tr_mul(&right) - a.tr_mul(&y)).amax() < 1e-13 * rows as f64);
        }
    }

    /// Without a bound that holds anything back, the search and the triangle agree.
    #[test]
    fn a_triangle_is_solved_as_the_search_would() {
        let mut rng = fastrand::Rng::with_seed(12);
        for _ in 0..50 {
            let square = random(&mut rng, 5, 5) + DMatrix::identity(5, 5);
            let truth = DVector::from_fn(5, |_, _| 0.1 + rng.f64());
            let triangle = square.clone().qr().r();
            for r in [triangle, square] {
                let found = not_negative(&r, &(&r * &truth)).unwrap();
                assert!((found - &truth).amax() < 1e-9);
            }
        }
        let singular = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1e-12]);
        assert_eq!(triangular(&singular, &DVector::from_vec(vec![1.0, 1.0])), None);
    }

    /// Of all choices of columns that stand at zero the best one that is allowed, found by trying all of them.
    #[test]
    fn no_solution_without_negative_values_is_better() {
        let mut rng = fastrand::Rng::with_seed(4);
        let mut bounded = 0;
        for _ in 0..200 {
            let a = random(&mut rng, 12, 4);
            let y = DVector::from_fn(12, |_, _| rng.f64() - 0.5);
            let found = solve(&System { a: a.clone(), y: y.clone() }).unwrap();
            bounded += usize::from(found.free.len() < 4);
            let mut best = y.norm();
            for set in 1..16_usize {
                let free: Vec<usize> = (0..4).filter(|i| set >> i & 1 == 1).collect();
                let own = a.select_columns(&free);
                let x = own.clone().svd(true, true).solve(&y, 1e-14).unwrap();
                if x.iter().all(|x| 0.0 <= *x) {
                    best = best.min((&y - own * x).norm());
                }
            }
            assert!(found.values.iter().all(|x| 0.0 <= *x));
            assert!((found.residual.norm() - best).abs() < 1e-10, "{} and {best}", found.residual.norm());
        }
        assert!(100 < bounded, "of random systems nearly all stand at a bound: {bounded}");
    }

    #[test]
    fn columns_that_are_nothing_or_sums_of_others_are_unseen_and_others_are_not() {
        let mut rng = fastrand::Rng::with_seed(9);
        let mut a = random(&mut rng, 30, 6);
        let y = DVector::zeros(30);
        assert_eq!(unseen(&System { a: a.clone(), y: y.clone() }), Vec::<Vec<usize>>::new());
        a.column_mut(0).fill(1e-14);
        let sum = a.column(2) * 2.0 + a.column(4);
        a.set_column(5, &sum);
        assert_eq!(unseen(&System { a, y }), [vec![0], vec![2, 4, 5]]);
    }

    #[test]
    fn a_value_that_one_posture_alone_shows_has_no_error() {
        let mut rng = fastrand::Rng::with_seed(2);
        let mut a = random(&mut rng, 30, 2).abs();
        (6..30).for_each(|row| a[(row, 1)] = 0.0);
        let y = &a * DVector::from_vec(vec![1.0, 2.0]) + DVector::from_fn(30, |_, _| 1e-3 * rng.f64());
        let solution = solve(&System { a, y }).unwrap();
        let groups: Vec<usize> = (0..10).map(|block| block / 2).collect();
        let found = spread(&solution, &groups).unwrap();
        assert!(found.by_posture[0].is_finite() && found.by_posture[1].is_infinite(), "{:?}", found.by_posture);
        assert!(found.left_out[..6].iter().all(Option::is_none) && found.left_out[6..].iter().all(Option::is_some));
    }
}
