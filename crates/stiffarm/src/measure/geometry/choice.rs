//! Which rows of unknowns are chosen? Whole postures, none twice, by exchange; and a bound that no choice goes below.

use nalgebra::{DMatrix, DMatrixView, DVector};

use crate::parallel;
use crate::watch::{Parts, Stopped};

/// Steps towards the best shares.
const MOST_STEPS: usize = 100;
/// The bound is good enough where it is this part of what shares reach.
const GOOD: f64 = 0.999;
/// Among so many candidates, those with the largest shares, whole ones are chosen.
const PROMISING: usize = 400;
/// Random choices that are compared.
const RANDOM: usize = 101;
/// An exchange that is better by less is none.
const BETTER: f64 = 1e-6;
/// Rows that are summed together: the same sums on every machine, however many threads there are.
const TOGETHER: usize = 192;

/// Candidates to choose from.
pub(super) struct Choice {
    /// `each` columns a candidate, in parts of the noise, over unknowns in parts of what is known of them.
    pub sensitivities: DMatrix<f64>,
    pub each: usize,
    /// `W` over the same unknowns.
    pub weight: DMatrix<f64>,
}

/// `sum w_i c_i c_i^T` over columns.
pub(super) fn squares(columns: &DMatrix<f64>, share: impl Fn(usize) -> f64 + Sync) -> DMatrix<f64> {
    let count = columns.nrows();
    let all: Vec<usize> = (0..columns.ncols()).collect();
    let sum_of = |_, some: &[usize]| {
        let mut sum = DMatrix::zeros(count, count);
        for &i in some {
            sum.ger(share(i), &columns.column(i), &columns.column(i), 1.0);
        }
        sum
    };
    let sums = parallel::take_each(all.chunks(TOGETHER), sum_of);
    sums.into_iter().fold(DMatrix::zeros(count, count), |sum, part| sum + part)
}

impl Choice {
    fn count(&self) -> usize {
        self.sensitivities.ncols() / self.each
    }

    /// The columns of a candidate.
    fn of(&self, i: usize) -> DMatrix<f64> {
        self.sensitivities.columns(self.each * i, self.each).into_owned()
    }

    /// Those with the largest shares, and their numbers.
    pub(super) fn promising(&self, shares: &[f64], least: usize) -> (Self, Vec<usize>) {
        let mut order: Vec<usize> = (0..self.count()).collect();
        order.sort_by(|&i, &j| shares[j].total_cmp(&shares[i]).then(i.cmp(&j)));
        order.truncate(PROMISING.max(least));
        let columns: Vec<_> = order.iter().flat_map(|&i| (0..self.each).map(move |j| self.each * i + j)).collect();
        (
            Self {
                sensitivities: self.sensitivities.select_columns(&columns),
                each: self.each,
                weight: self.weight.clone(),
            },
            order,
        )
    }

    /// `(1 + sum M_i)^-1`.
    pub(super) fn covariance(&self, chosen: &[usize]) -> DMatrix<f64> {
        let columns: Vec<usize> = chosen.iter().flat_map(|&i| self.each * i..self.each * (i + 1)).collect();
        inverse(squares(&self.sensitivities.select_columns(&columns), |_| 1.0))
    }

    /// `phi`, m^2.
    pub(super) fn value(&self, chosen: &[usize]) -> f64 {
        self.weight.dot(&self.covariance(chosen))
    }

    /// By how much `phi` falls with one more of every candidate.
    pub(super) fn gains(&self, covariance: &DMatrix<f64>) -> Vec<f64> {
        self.of_each(covariance, |rows, moved, seen| {
            let inner = DMatrix::identity(self.each, self.each) + rows.tr_mul(&moved);
            let solved = inner.cholesky().map(|root| root.solve(&moved.tr_mul(&seen)).trace());
            solved.unwrap_or(f64::NEG_INFINITY)
        })
    }

    /// What `value` is of every candidate: of its columns `c`, of `C c` and of `W C c`. Products of many columns take a fraction of the time of many products.
    fn of_each(
        &self,
        covariance: &DMatrix<f64>,
        value: impl Fn(DMatrixView<f64>, DMatrixView<f64>, DMatrixView<f64>) -> f64 + Sync,
    ) -> Vec<f64> {
        let all: Vec<usize> = (0..self.count()).collect();
        let of_some = |_, some: &[usize]| {
            let rows = self.sensitivities.columns(self.each * some[0], self.each * some.len());
            let moved = covariance * rows;
            let seen = &self.weight * &moved;
            let of = |i: usize| {
                let (first, each) = (self.each * i, self.each);
                value(rows.columns(first, each), moved.columns(first, each), seen.columns(first, each))
            };
            (0..some.len()).map(of).collect::<Vec<f64>>()
        };
        parallel::take_each(all.chunks(TOGETHER), of_some).into_iter().flatten().collect()
    }

    /// With one less of those chosen.
    pub(super) fn without(&self, covariance: &DMatrix<f64>, i: usize) -> Option<DMatrix<f64>> {
        let rows = self.of(i);
        let moved = times(covariance, &rows);
        let inner = DMatrix::identity(self.each, self.each) - rows.tr_mul(&moved);
        let solved = inner.cholesky()?.solve(&moved.transpose());
        let mut found = covariance.clone();
        for (j, column) in moved.column_iter().enumerate() {
            found.ger(1.0, &column, &solved.row(j).transpose(), 1.0);
        }
        Some(found)
    }

    /// So many, each the one that helps most after those before.
    pub(super) fn greedy(&self, count: usize, parts: &Parts) -> Result<Vec<usize>, Stopped> {
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < count {
            parts.one_more()?;
            let gains = self.gains(&self.covariance(&chosen));
            let free = (0..self.count()).filter(|i| !chosen.contains(i));
            chosen.extend(free.max_by(|&i, &j| gains[i].total_cmp(&gains[j]).then(j.cmp(&i))));
        }
        Ok(chosen)
    }

    /// Each in its turn for another that is better, until none is.
    fn exchanged(&self, mut chosen: Vec<usize>, parts: &Parts) -> Result<Vec<usize>, Stopped> {
        let mut value = self.value(&chosen);
        loop {
            let before = value;
            for place in 0..chosen.len() {
                parts.one_more()?;
                let Some(without) = self.without(&self.covariance(&chosen), chosen[place]) else { continue };
                let gains = self.gains(&without);
                let free = (0..self.count()).filter(|i| !chosen.contains(i));
                let Some(best) = free.max_by(|&i, &j| gains[i].total_cmp(&gains[j]).then(j.cmp(&i))) else { continue };
                let known = std::mem::replace(&mut chosen[place], best);
                let changed = self.value(&chosen);
                if changed < value * (1.0 - BETTER) {
                    value = changed;
                } else {
                    chosen[place] = known;
                }
            }
            if before * (1.0 - BETTER) <= value {
                return Ok(chosen);
            }
        }
    }

    /// What no choice of so many goes below, m^2, and shares of the candidates that come near it.
    ///
    /// `phi` is convex in the shares `w`, so that `phi(w*) >= phi(w) + sum (w_i - w*_i) d_i` with `d_i = tr(C W C M_i)`; and `sum w*_i d_i` is no more than the
    /// sum of the largest `d_i`, as many as are chosen. The shares grow by the root of `d_i` over a common measure, none beyond 1.
    pub(super) fn bound(&self, chosen: usize, parts: &Parts) -> Result<(f64, Vec<f64>), Stopped> {
        let mut shares = vec![chosen as f64 / self.count() as f64; self.count()];
        let mut best = 0.0_f64;
        for _ in 0..MOST_STEPS {
            parts.one_more()?;
            let covariance = inverse(squares(&self.sensitivities, |column| shares[column / self.each]));
            let value = self.weight.dot(&covariance);
            let slopes = self.of_each(&covariance, |_, moved, seen| moved.dot(&seen));
            let mut sorted = slopes.clone();
            sorted.sort_by(|a, b| b.total_cmp(a));
            let now: f64 = shares.iter().zip(&slopes).map(|(share, slope)| share * slope).sum();
            best = best.max(value + now - sorted[..chosen].iter().sum::<f64>());
            if GOOD * value <= best {
                break;
            }
            grow(&mut shares, &slopes, chosen as f64);
        }
        Ok((best, shares))
    }

    /// As good as exchange makes a greedy choice and the first of all: of those that are promising they have the largest shares.
    pub(super) fn best(&self, greedy: &[usize], parts: &Parts) -> Result<Vec<usize>, Stopped> {
        let first = self.exchanged((0..greedy.len()).collect(), parts)?;
        let greedy = self.exchanged(greedy.to_vec(), parts)?;
        Ok(if self.value(&first) < self.value(&greedy) { first } else { greedy })
    }

    /// The median `phi` of random choices, m^2.
    pub(super) fn random(&self, chosen: usize) -> f64 {
        let mut rng = fastrand::Rng::with_seed(1);
        let choices: Vec<Vec<usize>> = (0..RANDOM).map(|_| rng.choose_multiple(0..self.count(), chosen)).collect();
        let mut values: Vec<f64> = parallel::each(&choices, |choice| self.value(choice));
        values.sort_by(f64::total_cmp);
        values[RANDOM / 2]
    }
}

/// A square matrix on every column: few columns are served faster one by one.
fn times(matrix: &DMatrix<f64>, columns: &DMatrix<f64>) -> DMatrix<f64> {
    let mut found = DMatrix::zeros(columns.nrows(), columns.ncols());
    for (mut to, from) in found.column_iter_mut().zip(columns.column_iter()) {
        to.gemv(1.0, matrix, &from, 0.0);
    }
    found
}

/// `(1 + M)^-1` of a positive `M`.
fn inverse(information: DMatrix<f64>) -> DMatrix<f64> {
    let count = information.nrows();
    let all = information + DMatrix::identity(count, count);
    all.cholesky().expect("1 and squares are positive").inverse()
}

/// Shares by the root of their slopes, none beyond 1, adding up to as much as before.
fn grow(shares: &mut [f64], slopes: &[f64], sum: f64) {
    const HALVINGS: usize = 60;
    let grown: DVector<f64> = DVector::from_iterator(
        shares.len(),
        shares.iter().zip(slopes).map(|(share, slope)| share * slope.max(0.0).sqrt()),
    );
    let total = |measure: f64| grown.iter().map(|share| (share / measure).min(1.0)).sum::<f64>();
    let (mut low, mut high) = (0.0, grown.sum() / sum);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if total(middle) < sum { high = middle } else { low = middle }
    }
    for (share, grown) in shares.iter_mut().zip(&grown) {
        *share = (grown / high).min(1.0);
    }
}
