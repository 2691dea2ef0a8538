//! Huber's estimate: readings that fit badly count less.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::regression::{System, basis, not_negative};

/// Weights of readings in Huber's estimate: 1, or less where what remains of a displacement is beyond `bound` standard deviations; and
/// those remainders over the standard deviation, which is that of the middle one.
#[derive(Clone, Debug)]
pub(super) struct Robust {
    pub values: Vec<f64>,
    pub weights: Vec<f64>,
    /// Of every reading: length of what remains, in standard deviations of a coordinate.
    pub ratios: Vec<f64>,
    /// The search ended within [`ROUNDS`].
    pub is_settled: bool,
}

/// Median of the length of a vector of three independent normal coordinates of standard deviation 1.
const MEDIAN_LENGTH: f64 = 1.538_172;
/// No value changes by more than this share of itself when the search ends.
const SETTLED: f64 = 1e-9;
/// After so many rounds the search ends in any case. Most tables take twenty.
pub(super) const ROUNDS: usize = 1000;

/// Readings in an orthonormal basis `A = Z R` of all columns that are anything.
struct Based<'a> {
    columns: Vec<usize>,
    r: DMatrix<f64>,
    /// Transposed, so that a row is one piece of memory.
    z: DMatrix<f64>,
    y: &'a [f64],
    /// What each reading adds to the normal equations: the lower triangle, row by row, then the right side.
    added: Vec<f64>,
}

impl<'a> Based<'a> {
    fn of(system: &'a System) -> Option<Self> {
        let (mut r, _) = system.reduced();
        let columns: Vec<usize> = (0..r.ncols()).filter(|&i| 0.0 < r.column(i).norm()).collect();
        if columns.is_empty() || system.a.nrows() < columns.len() {
            return None;
        }
        if columns.len() < r.ncols() {
            r = r.select_columns(&columns).qr().r();
        }
        let z = basis(&system.a, &columns, &r)?;
        let y = system.y.as_slice();
        let added = added(z.as_slice(), y, columns.len());
        Some(Self { columns, r, z, y, added })
    }

    /// How much remains of each reading.
    fn lengths(&self, values: &DVector<f64>) -> Vec<f64> {
        let (along, count) = (&self.r * values, self.columns.len());
        let missed = |z: &[f64], y: f64| y - z.iter().zip(along.iter()).map(|(z, along)| z * along).sum::<f64>();
        let length = |(z, y): (&[f64], &[f64])| {
            let rows = z.chunks_exact(count).zip(y);
            rows.map(|(z, y)| missed(z, *y).powi(2)).sum::<f64>().sqrt()
        };
        self.z.as_slice().chunks_exact(3 * count).zip(self.y.chunks_exact(3)).map(length).collect()
    }

    /// The values that are not negative and leave least of the weighted readings.
    fn solved(&self, weights: &[f64]) -> Option<DVector<f64>> {
        let count = self.columns.len();
        // In the orthonormal basis the weighted normal equations are as well conditioned as the weights.
        let mut sums = vec![0.0; count * (count + 3) / 2];
        for (weight, added) in weights.iter().zip(self.added.chunks_exact(sums.len())) {
            sums.iter_mut().zip(added).for_each(|(sum, added)| *sum += weight * added);
        }
        let (triangle, right) = sums.split_at(count * (count + 1) / 2);
        let normal = DMatrix::from_fn(count, count, |a, b| if b <= a { triangle[a * (a + 1) / 2 + b] } else { 0.0 });
        // Cholesky's factor is of the lower triangle.
        let lower = Cholesky::new(normal)?.l();
        let right = lower.solve_lower_triangular(&DVector::from_column_slice(right))?;
        not_negative(&(lower.transpose() * &self.r), &right)
    }

    /// The values of which the lengths of what remains add up to least, nearly: the one reading that is far off pulls no more than any other.
    fn of_least_lengths(&self) -> Option<DVector<f64>> {
        /// Of the middle length of least squares: less counts by its square.
        const NEAR: f64 = 0.01;
        const MOST: usize = 100;
        let mut found = self.solved(&vec![1.0; self.y.len() / 3])?;
        let near = NEAR * middle(&self.lengths(&found));
        for _ in 0..MOST {
            let next = self.solved(&weights(&self.lengths(&found), near))?;
            let is_near = is_settled(&next, &found, 1e-4);
            found = next;
            if is_near {
                break;
            }
        }
        Some(found)
    }
}

/// What each reading adds to the normal equations of the basis.
fn added(z: &[f64], y: &[f64], count: usize) -> Vec<f64> {
    let size = count * (count + 3) / 2;
    let mut all = vec![0.0; size * y.len() / 3];
    for (row, (z, y)) in z.chunks_exact(count).zip(y).enumerate() {
        let (triangle, right) = all[size * (row / 3)..][..size].split_at_mut(count * (count + 1) / 2);
        let products = (0..count).flat_map(|a| z[..=a].iter().map(move |other| z[a] * other));
        triangle.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
        right.iter_mut().zip(z).for_each(|(sum, z)| *sum += z * y);
    }
    all
}

fn middle(lengths: &[f64]) -> f64 {
    let mut sorted = lengths.to_vec();
    let middle = sorted.len() / 2;
    *sorted.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// 1 within a length, beyond it in proportion less.
fn weights(lengths: &[f64], bound: f64) -> Vec<f64> {
    lengths.iter().map(|length| if bound < *length && 0.0 < bound { bound / length } else { 1.0 }).collect()
}

fn is_settled(next: &DVector<f64>, before: &DVector<f64>, share: f64) -> bool {
    next.iter().zip(before.iter()).all(|(a, b)| (a - b).abs() <= share * a.abs().max(b.abs()))
}

/// From the values of least lengths on, over all columns, those that stood at zero before, too: weights and standard deviation by what
/// remains, values by the weights, until no value changes by more than [`SETTLED`].
pub(super) fn robust(system: &System, bound: f64) -> Option<Robust> {
    let based = Based::of(system)?;
    let mut found = based.of_least_lengths()?;
    for round in 1.. {
        let lengths = based.lengths(&found);
        let scale = middle(&lengths) / MEDIAN_LENGTH;
        let weights = weights(&lengths, bound * scale);
        let next = based.solved(&weights)?;
        let is_settled = is_settled(&next, &found, SETTLED);
        found = next;
        if is_settled || round == ROUNDS {
            let ratios = lengths.iter().map(|length| if 0.0 < scale { length / scale } else { 0.0 }).collect();
            let mut values = vec![0.0; system.a.ncols()];
            based.columns.iter().zip(found.iter()).for_each(|(&i, value)| values[i] = *value);
            return Some(Robust { values, weights, ratios, is_settled });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::regression::solve;
    use super::*;

    /// Huber's conditions by hand: the middle length sets the scale, and readings weighed by how far they miss pull the values nowhere.
    #[test]
    fn readings_weighed_by_their_distance_pull_the_values_nowhere() {
        const BOUND: f64 = 2.5;
        let mut rng = fastrand::Rng::with_seed(21);
        let a = DMatrix::from_fn(90, 4, |_, _| rng.f64() - 0.5);
        let truth = DVector::from_vec(vec![1.0, 2.0, 0.5, 3.0]);
        let mut y = &a * &truth + DVector::from_fn(90, |_, _| 0.02 * (rng.f64() - 0.5));
        for row in [3, 4, 30, 61] {
            y[row] += 0.4;
        }
        let system = System { a: a.clone(), y: y.clone() };
        let found = robust(&system, BOUND).unwrap();
        let missed = &y - &a * DVector::from_column_slice(&found.values);
        let lengths: Vec<f64> = (0..30).map(|i| missed.rows(3 * i, 3).norm()).collect();
        let mut sorted = lengths.clone();
        sorted.sort_by(f64::total_cmp);
        let scale = sorted[15] / MEDIAN_LENGTH;
        let weights: Vec<f64> = lengths.iter().map(|length| (BOUND * scale / length).min(1.0)).collect();
        assert!(weights.iter().filter(|weight| **weight < 0.5).count() == 3, "{weights:?}");
        let pulled = |column: usize| (0..90).map(|i| weights[i / 3] * a[(i, column)] * missed[i]).sum::<f64>();
        assert!((0..4).all(|column| pulled(column).abs() < 1e-7 * y.norm()));
        assert!(found.weights.iter().zip(&weights).all(|(weight, expected)| (weight - expected).abs() < 1e-6));
        assert!((DVector::from_column_slice(&found.values) - truth).amax() < 0.03);
    }

    /// One reading has the wrong sign: least squares puts a column at zero for it, and the estimate takes it up again.
    #[test]
    fn a_column_that_a_wrong_reading_held_at_zero_is_found() {
        let mut held = 0;
        for seed in 0..40 {
            let mut rng = fastrand::Rng::with_seed(seed);
            let a = DMatrix::from_fn(60, 3, |_, j| (rng.f64() - 0.5) * [1.0, 1.0, 0.1][j]);
            let truth = DVector::from_vec(vec![1.0, 2.0, 1.0]);
            let mut y = &a * &truth + DVector::from_fn(60, |_, _| 1e-3 * (rng.f64() - 0.5));
            (9..12).for_each(|row| y[row] = -y[row]);
            let system = System { a, y };
            held += usize::from(solve(&system).unwrap().free.len() < 3);
            let found = robust(&system, 2.5).unwrap();
            assert!(found.is_settled);
            for (value, truth) in found.values.iter().zip(truth.iter()) {
                assert!((value - truth).abs() < 0.02, "{seed}: {:?}", found.values);
            }
        }
        assert!(0 < held, "no wrong reading held a column at zero");
    }
}
