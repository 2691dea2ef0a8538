//! Which readings do not fit the others?

use nalgebra::{DMatrix, Matrix3, Vector3};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::regression::{Solution, System, solve};
use super::robust::Robust;

/// Where no reading is wrong, one table in so many has an outlier.
const ONE_TABLE_IN: f64 = 20.0;
/// Of the displacements: what remains is at least so much, by rounding.
const ROUNDING: f64 = 1e-12;

/// Whether each reading is an outlier.
///
/// Those that count less in Huber's estimate are held against least squares of all others, by the test of Fisher for a shift of one reading,
/// and the ones that pass are taken back, until none does. Where one alone shows a value, nothing is known of it. Where one axis is noisier than
/// the others, as the depth is that a camera sees, each is judged by its own.
pub(super) fn outlying(system: &System, robust: &Robust) -> Vec<bool> {
    let mut is_out: Vec<bool> = robust.weights.iter().map(|weight| *weight < 1.0).collect();
    let least = ROUNDING * system.y.norm_squared().sqrt() / (system.y.len() as f64).sqrt();
    while is_out.contains(&true) {
        let rows: Vec<usize> = (0..system.y.len()).filter(|row| !is_out[row / 3]).collect();
        let others = System { a: system.a.select_rows(&rows), y: system.y.select_rows(&rows) };
        let Some(fit) = solve(&others).filter(|fit| fit.free.len() < rows.len()) else {
            return vec![false; is_out.len()];
        };
        let freedom = (rows.len() - fit.free.len()) as f64;
        let variance = (fit.residual.norm_squared() / freedom).max(least * least);
        let (parts, freedom) = of_axes(&fit, freedom).map_or((Vector3::repeat(1.0), freedom), |of| (of, freedom / 3.0));
        let limit = bound(is_out.len(), freedom) * variance;
        let unshown = unshown(system, &others);
        let mut is_changed = false;
        for i in (0..is_out.len()).filter(|&i| is_out[i]).collect::<Vec<_>>() {
            let is_judged = unshown.iter().all(|&column| system.a.fixed_view::<3, 1>(3 * i, column).amax() == 0.0);
            let fits = !is_judged || shift(system, (&fit, &parts), i).is_none_or(|square| square <= limit);
            is_out[i] = !fits;
            is_changed |= fits;
        }
        if !is_changed {
            break;
        }
    }
    is_out
}

/// Columns of which some rows show nothing.
fn unshown(all: &System, some: &System) -> Vec<usize> {
    const NOTHING: f64 = 1e-9;
    (0..all.a.ncols()).filter(|&i| some.a.column(i).norm() <= NOTHING * all.a.column(i).norm()).collect()
}

/// The variance of each axis in parts of that of all, where one is plainly noisier than another: as much as equal ones differ in one table of two.
/// (Each is then judged by fewer coordinates, so that nothing is lost where they are equal after all.)
fn of_axes(fit: &Solution, freedom: f64) -> Option<Vector3<f64>> {
    const ONE_TABLE_IN: f64 = 2.0;
    let mut squares = Vector3::zeros();
    fit.residual.as_slice().chunks_exact(3).for_each(|of| squares += Vector3::from_column_slice(of).map(|x| x * x));
    // Of the three ratios the largest.
    let law = FisherSnedecor::new(freedom / 3.0, freedom / 3.0).ok()?;
    let limit = law.inverse_cdf(1.0 - 1.0 / (3.0 * 2.0 * ONE_TABLE_IN));
    (limit * squares.min() < squares.max()).then(|| squares / squares.mean())
}

/// The square of what a reading misses of a fit without it, over its variance in parts of that of a coordinate:
/// `e^T (D + G G^T)^-1 e` with `G = A R^-1` and the parts `D` of the axes.
fn shift(system: &System, (fit, parts): (&Solution, &Vector3<f64>), reading: usize) -> Option<f64> {
    let values = nalgebra::DVector::from_column_slice(&fit.values);
    let rows = system.a.rows(3 * reading, 3);
    let missed: Vector3<f64> = (system.y.fixed_rows::<3>(3 * reading) - rows * values).fixed_rows::<3>(0).into();
    let columns: DMatrix<f64> = rows.select_columns(&fit.free);
    let reached = fit.r.transpose().solve_lower_triangular(&columns.transpose())?;
    let known = reached.tr_mul(&reached);
    let variance = Matrix3::from_diagonal(parts) + known.fixed_view::<3, 3>(0, 0);
    Some(missed.dot(&variance.cholesky()?.solve(&missed)))
}

/// So many variances the square of a shift of three coordinates may have: the largest of so many normal ones stays within that in nineteen
/// tables of twenty, where the variance is known by `freedom` coordinates.
fn bound(readings: usize, freedom: f64) -> f64 {
    /// From here on the variance is as good as known.
    const MANY: f64 = 3000.0;
    let share = 1.0 - 1.0 / (ONE_TABLE_IN * readings.max(1) as f64);
    if MANY < freedom {
        return ChiSquared::new(3.0).map_or(f64::INFINITY, |law| law.inverse_cdf(share));
    }
    3.0 * FisherSnedecor::new(3.0, freedom).map_or(f64::INFINITY, |law| law.inverse_cdf(share))
}

#[cfg(test)]
mod tests {
    use super::super::robust::robust;
    use super::*;

    /// Tables of scipy: `f.ppf(1 - 1/500, 3, 69)`, `f.ppf(1 - 1/1200, 3, 174)`, `chi2.ppf(1 - 1/20000, 3)`.
    #[test]
    fn the_bound_is_that_of_fisher() {
        for (readings, freedom, expected) in
            [(25, 69.0, 3.0 * 5.457_612_454), (60, 174.0, 3.0 * 5.807_586_048), (1000, 1e4, 22.554_749_071)]
        {
            assert!(
                (bound(readings, freedom) / expected - 1.0).abs() < 1e-6,
                "{readings}: {}",
                bound(readings, freedom)
            );
        }
    }

    /// Normal readings, none of them wrong: about one table in twenty has an outlier, whether it is long or short. At 5 % of 300 tables the chance
    /// of less than 5 or more than 28 is below 1 in 500.
    #[test]
    fn one_table_in_twenty_has_an_outlier() {
        for readings in [12, 40] {
            let mut rng = fastrand::Rng::with_seed(77);
            // Exactly normal: what matters are the tails.
            let mut normal = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (std::f64::consts::TAU * rng.f64()).cos();
            let mut count = 0;
            for _ in 0..300 {
                let a = DMatrix::from_fn(3 * readings, 6, |_, _| normal());
                let y = nalgebra::DVector::from_fn(3 * readings, |i, _| a.row(i).sum() * 10.0 + normal());
                let system = System { a, y };
                count += usize::from(outlying(&system, &robust(&system, 2.5).unwrap()).contains(&true));
            }
            assert!((5..=28).contains(&count), "{readings} readings: {count} of 300");
        }
    }

    /// One axis scatters three times as much as the others: clean tables are accused no more often, and a reading that is ten of its own standard
    /// deviations off along a quiet axis is found.
    #[test]
    fn an_axis_that_is_noisier_accuses_nobody_and_hides_little() {
        for readings in [12, 40] {
            let mut rng = fastrand::Rng::with_seed(78);
            let mut normal = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (std::f64::consts::TAU * rng.f64()).cos();
            let (mut accused, mut found) = (0, 0);
            for _ in 0..200 {
                let a = DMatrix::from_fn(3 * readings, 6, |_, _| normal());
                let y = nalgebra::DVector::from_fn(3 * readings, |i, _| {
                    a.row(i).sum() * 10.0 + normal() * if i % 3 == 2 { 3.0 } else { 1.0 }
                });
                let mut system = System { a, y };
                accused += usize::from(outlying(&system, &robust(&system, 2.5).unwrap()).contains(&true));
                system.y[3 * 4] += 15.0;
                found += usize::from(outlying(&system, &robust(&system, 2.5).unwrap())[4]);
            }
            assert!(accused <= 24 && 150 <= found, "{readings} readings: {accused} accused, {found} found of 200");
        }
    }

    /// A reading that alone shows a value cannot be told from that value.
    #[test]
    fn what_one_reading_alone_shows_is_no_outlier() {
        let mut rng = fastrand::Rng::with_seed(5);
        let mut a = DMatrix::from_fn(60, 3, |_, _| rng.f64() - 0.5);
        (0..60).filter(|row| row / 3 != 7).for_each(|row| a[(row, 2)] = 0.0);
        let mut y = &a * nalgebra::DVector::from_vec(vec![1.0, 2.0, 3.0]);
        y.iter_mut().for_each(|y| *y += 0.01 * (rng.f64() - 0.5));
        let system = System { a, y };
        let found = robust(&system, 2.5).unwrap();
        let told = Robust { weights: (0..20).map(|i| if i == 7 { 0.5 } else { 1.0 }).collect(), ..found };
        assert_eq!(outlying(&system, &told), [false; 20]);
    }
}
