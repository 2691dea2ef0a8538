//! Huber's estimate: readings that fit badly count less.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::regression::{Solution, System, not_negative};

/// Weights of readings in Huber's estimate: 1, or less where what remains of a displacement is beyond `bound` standard deviations; and
/// those remainders over the standard deviation, which is that of the middle one.
#[derive(Clone, Debug)]
pub(super) struct Robust {
    pub values: Vec<f64>,
    pub weights: Vec<f64>,
    /// Of every reading: length of what remains, in standard deviations of a coordinate.
    pub ratios: Vec<f64>,
}

/// Median of the length of a vector of three independent normal coordinates of standard deviation 1.
const MEDIAN_LENGTH: f64 = 1.538_172;

/// What each reading adds to the normal equations of the basis: the lower triangle, row by row, then the right side.
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

/// Iterated until no value changes by more than 1e-9 of itself; starts from a solution of the same system.
pub(super) fn robust(system: &System, start: &Solution, bound: f64) -> Option<Robust> {
    let Solution { free, z, r, .. } = start;
    let (readings, count) = (system.y.len() / 3, free.len());
    let (z, y) = (z.as_slice(), system.y.as_slice());
    let added = added(z, y, count);
    let mut weights = vec![1.0; readings];
    let mut found = DVector::from_iterator(count, free.iter().map(|&i| start.values[i]));
    let mut ratios = vec![0.0; readings];
    for _ in 0..200 {
        let along = r * &found;
        let missed = |z: &[f64], y: f64| y - z.iter().zip(along.iter()).map(|(z, along)| z * along).sum::<f64>();
        let length = |(z, y): (&[f64], &[f64])| {
            let rows = z.chunks_exact(count).zip(y);
            rows.map(|(z, y)| missed(z, *y).powi(2)).sum::<f64>().sqrt()
        };
        let lengths: Vec<f64> = z.chunks_exact(3 * count).zip(y.chunks_exact(3)).map(length).collect();
        let mut sorted = lengths.clone();
        let middle = sorted.len() / 2;
        let scale = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1 / MEDIAN_LENGTH;
        ratios = lengths.iter().map(|length| if 0.0 < scale { length / scale } else { 0.0 }).collect();
        weights = ratios.iter().map(|ratio| (bound / ratio).min(1.0)).collect();
        // In the orthonormal basis the weighted normal equations are as well conditioned as the weights.
        let mut sums = vec![0.0; count * (count + 3) / 2];
        for (weight, added) in weights.iter().zip(added.chunks_exact(sums.len())) {
            sums.iter_mut().zip(added).for_each(|(sum, added)| *sum += weight * added);
        }
        let (triangle, right) = sums.split_at(count * (count + 1) / 2);
        let normal = DMatrix::from_fn(count, count, |a, b| if b <= a { triangle[a * (a + 1) / 2 + b] } else { 0.0 });
        // Cholesky's factor is of the lower triangle.
        let lower = Cholesky::new(normal)?.l();
        let right = lower.solve_lower_triangular(&DVector::from_column_slice(right))?;
        let next = not_negative(&(lower.transpose() * r), &right)?;
        let change = next.iter().zip(found.iter()).map(|(a, b)| (a - b).abs() / b.abs().max(f64::MIN_POSITIVE));
        let is_done = change.fold(0.0, f64::max) < 1e-9 || (&next - &found).amax() == 0.0;
        found = next;
        if is_done {
            break;
        }
    }
    let mut values = vec![0.0; system.a.ncols()];
    free.iter().zip(found.iter()).for_each(|(&i, value)| values[i] = *value);
    Some(Robust { values, weights, ratios })
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
        let found = robust(&system, &solve(&system).unwrap(), BOUND).unwrap();
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
}
