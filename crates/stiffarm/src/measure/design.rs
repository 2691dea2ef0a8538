//! How often should each candidate be measured? Shares with a certificate, and whole runs.

use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix, Matrix6};

use crate::parallel;
use crate::watch::{Parts, Stopped};

/// The shares are good enough when certified to this.
const GOOD: f64 = 0.999;
/// And are left where they are after so many steps.
const MOST_STEPS: usize = 2000;
/// A share that is so much smaller than an even one plays no part, until its candidate is looked at again.
const IDLE: f64 = 1e-4;
/// Every so many steps all candidates are looked at.
const LOOK: usize = 10;
/// Among so many of the best candidates runs are exchanged.
const EXCHANGED: usize = 400;
/// Random choices that are compared.
const RANDOM: usize = 101;
/// One thread takes the gains of so many at a time.
const TOGETHER: usize = 512;
/// A drive of which no candidate tells more than this of what they tell of the best is not shown.
const NOTHING: f64 = 1e-16;

/// Symmetric matrices of the drives that are shown, packed: products of two are sums of 21 terms.
type Packed = [f64; 21];

/// What is to be small: convex functions of the information, of degree -1, so that one certificate serves all.
#[derive(Clone, Debug)]
pub(super) enum Aim {
    /// `tr(W M^-1)`, by `W` of all drives.
    Trace(Matrix6<f64>),
    /// `det(K M K)^(-1/p)` of the p drives that are shown, with `K` of all drives on the diagonal: `d_i = phi tr(M^-1 M_i) / p`, and what is
    /// certified is Kiefer and Wolfowitz's bound, `p / max tr(M^-1 M_i)`.
    Determinant([f64; 6]),
}

impl Aim {
    /// Of `d_i / phi`, by which a share grows: what never makes it worse.
    const fn power(&self) -> f64 {
        match self {
            Self::Trace(_) => 0.5,
            Self::Determinant(_) => 1.0,
        }
    }
}

/// The drives that are shown, and the criterion on them.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    /// From 0, ascending.
    pub drives: Vec<usize>,
    aim: Aim,
}

/// Shares of candidates.
#[derive(Clone, Debug)]
pub(super) struct Shares {
    /// Adding up to 1.
    pub weights: Vec<f64>,
    /// `phi` of one run so shared.
    pub value: f64,
    /// No shares have less.
    pub bound: f64,
}

/// Whole runs.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    /// Indices of candidates, as often as they are run.
    pub runs: Vec<usize>,
    /// `phi` of all runs together.
    pub value: f64,
    /// Their information.
    pub matrix: Matrix6<f64>,
}

/// How often a posture may be run, and how much less it tells when it is.
///
/// What the model misses in a posture it misses in every run of it: with `sigma` of a reading and `tau` of a posture n runs of one posture tell
/// `sum M_i / (sigma^2 + n tau^2)`, exactly so under the same load.
#[derive(Clone, Copy, Debug)]
pub(super) struct Repeats {
    /// So many candidates in a row are one posture.
    pub ways: usize,
    /// A posture is run so often at most.
    pub most: usize,
    /// `tau^2 / (sigma^2 + tau^2)`.
    pub share: f64,
}

impl Repeats {
    /// What a run tells where its posture is run so often, over what it tells alone.
    pub(super) fn shrunk(&self, runs: usize) -> f64 {
        1.0 / (1.0 + (runs.max(1) - 1) as f64 * self.share)
    }

    fn posture(&self, candidate: usize) -> usize {
        candidate / self.ways
    }
}

/// What runs tell, posture by posture.
#[derive(Clone, Debug)]
struct Information {
    repeats: Repeats,
    /// Of every posture the sum over its runs as if each were alone, and how many there are.
    postures: BTreeMap<usize, (Matrix6<f64>, usize)>,
    matrix: Matrix6<f64>,
}

impl Information {
    fn of(information: &[Matrix6<f64>], runs: impl IntoIterator<Item = usize>, repeats: Repeats) -> Self {
        let mut postures: BTreeMap<usize, (Matrix6<f64>, usize)> = BTreeMap::new();
        for run in runs {
            let (sum, count) = postures.entry(repeats.posture(run)).or_insert((Matrix6::zeros(), 0));
            *sum += information[run];
            *count += 1;
        }
        let matrix = postures.values().map(|(sum, count)| sum * repeats.shrunk(*count)).sum();
        Self { repeats, postures, matrix }
    }

    /// With one more run; `None` where its posture is run as often as it may be.
    fn with(&self, run: usize, information: &[Matrix6<f64>]) -> Option<Matrix6<f64>> {
        let nothing = (Matrix6::zeros(), 0);
        let (sum, count) = self.postures.get(&self.repeats.posture(run)).unwrap_or(&nothing);
        let again = |sum: Matrix6<f64>, count: usize| sum * self.repeats.shrunk(count);
        (*count < self.repeats.most)
            .then(|| self.matrix - again(*sum, *count) + again(sum + information[run], count + 1))
    }
}

impl Kept {
    /// Of what candidates tell; `None` where that is nothing.
    pub(super) fn of(information: &[Matrix6<f64>]) -> Option<Self> {
        let sum: Matrix6<f64> = information.iter().sum();
        let most = sum.diagonal().max();
        let drives: Vec<usize> = (0..6).filter(|&drive| NOTHING * most < sum[(drive, drive)]).collect();
        (0.0 < most && !drives.is_empty()).then_some(Self { drives, aim: Aim::Trace(Matrix6::identity()) })
    }

    /// With a criterion.
    pub(super) fn aiming(self, aim: &Aim) -> Self {
        Self { aim: aim.clone(), ..self }
    }

    fn of_drives(&self, matrix: &Matrix6<f64>) -> DMatrix<f64> {
        let count = self.drives.len();
        DMatrix::from_fn(count, count, |i, j| matrix[(self.drives[i], self.drives[j])])
    }

    /// `phi`, and minus its slope among all drives (`M^-1 W M^-1` of a trace), zero where one is not shown; `None` where some combination is not
    /// shown.
    fn judged(&self, matrix: &Matrix6<f64>) -> Option<(f64, Matrix6<f64>)> {
        let own = self.of_drives(matrix);
        // Scaled, so that drives of different sizes count alike in what is singular.
        let scale: Vec<f64> = own.diagonal().iter().map(|x| x.sqrt().recip()).collect();
        let scaled = DMatrix::from_fn(own.nrows(), own.ncols(), |i, j| own[(i, j)] * scale[i] * scale[j]);
        let factor = Cholesky::new(scaled).filter(|found| found.l_dirty().diagonal().iter().all(|x| 1e-6 < *x))?;
        let inverse = factor.inverse();
        let inverse = DMatrix::from_fn(own.nrows(), own.ncols(), |i, j| inverse[(i, j)] * scale[i] * scale[j]);
        let (value, slope) = match &self.aim {
            Aim::Trace(weight) => {
                let half = &inverse * self.of_drives(weight);
                (half.trace(), &half * &inverse)
            }
            Aim::Determinant(sizes) => {
                let roots = factor.l_dirty().diagonal();
                let parts = roots.iter().zip(&scale).zip(&self.drives);
                let half_ln: f64 = parts.map(|((root, scale), &drive)| (root / scale * sizes[drive]).ln()).sum();
                let count = self.drives.len() as f64;
                let value = (-2.0 * half_ln / count).exp();
                (value, &inverse * (value / count))
            }
        };
        let mut whole = Matrix6::zeros();
        for (a, &i) in self.drives.iter().enumerate() {
            for (b, &j) in self.drives.iter().enumerate() {
                whole[(i, j)] = slope[(a, b)];
            }
        }
        Some((value, whole))
    }

    /// `phi`; `None` where some combination of drives is not shown.
    pub(super) fn value(&self, matrix: &Matrix6<f64>) -> Option<f64> {
        self.judged(matrix).map(|(value, _)| value)
    }

    /// Standard errors of the compliances.
    pub(super) fn errors(&self, matrix: &Matrix6<f64>) -> [Option<f64>; 6] {
        let inverse = self.of_drives(matrix).try_inverse();
        std::array::from_fn(|drive| {
            let at = self.drives.iter().position(|&known| known == drive)?;
            inverse.as_ref().map(|inverse| inverse[(at, at)].sqrt())
        })
    }

    /// The best shares, by the multiplicative rule.
    pub(super) fn shares(&self, information: &[Matrix6<f64>], parts: &Parts) -> Result<Shares, Stopped> {
        let count = information.len();
        let packed: Vec<Packed> = information.iter().map(pack).collect();
        let (even, power) = (1.0 / count as f64, self.aim.power());
        let mut weights = vec![even; count];
        let mut active: Vec<usize> = (0..count).collect();
        let mut best = Shares { weights: weights.clone(), value: f64::INFINITY, bound: 0.0 };
        for step in 0..MOST_STEPS {
            parts.one_more()?;
            let sum = active.iter().fold([0.0; 21], |mut sum, &i| {
                sum.iter_mut().zip(&packed[i]).for_each(|(sum, part)| *sum += weights[i] * part);
                sum
            });
            let Some((value, slope)) = self.judged(&unpack(&sum)) else { break };
            let slope = doubled(&slope);
            let gain = |packed: &Packed| packed.iter().zip(&slope).map(|(a, b)| a * b).sum::<f64>();
            let looks = step % LOOK == 0;
            if looks {
                let of_some = |_, some: &[Packed]| some.iter().map(gain).collect::<Vec<f64>>();
                let gains = parallel::take_each(packed.chunks(TOGETHER), of_some).concat();
                let most = gains.iter().copied().fold(0.0, f64::max);
                // Every bound holds for all; the best is kept.
                let bound = best.bound.max(value * value / most);
                best = Shares { weights: weights.clone(), value, bound };
                if GOOD * value <= bound {
                    break;
                }
                weights.iter_mut().zip(&gains).for_each(|(weight, gain)| *weight *= (gain / value).powf(power));
                // What has died down but is better than the average comes back.
                weights
                    .iter_mut()
                    .zip(&gains)
                    .filter(|(_, gain)| value < **gain)
                    .for_each(|(weight, _)| *weight = weight.max(IDLE * even));
                active = (0..count).filter(|&i| IDLE * even <= weights[i]).collect();
                let kept: Vec<f64> = active.iter().map(|&i| weights[i]).collect();
                weights.fill(0.0);
                active.iter().zip(kept).for_each(|(&i, weight)| weights[i] = weight);
            } else {
                for &i in &active {
                    weights[i] *= (gain(&packed[i]) / value).powf(power);
                }
            }
            let sum: f64 = active.iter().map(|&i| weights[i]).sum();
            for &i in &active {
                weights[i] /= sum;
            }
        }
        Ok(best)
    }

    /// So many whole runs: the largest shares, then exchanges as long as one is an improvement.
    pub(super) fn exact(
        &self,
        information: &[Matrix6<f64>],
        shares: &Shares,
        (count, repeats): (usize, Repeats),
        parts: &Parts,
    ) -> Result<Chosen, Stopped> {
        let among = self.promising(information, shares, EXCHANGED.max(count * repeats.ways));
        let mut runs = rounded(&among, &shares.weights, (count, repeats));
        let matrix_of = |runs: &[usize]| Information::of(information, runs.iter().copied(), repeats).matrix;
        let value_of = |matrix: &Matrix6<f64>| self.value(matrix).unwrap_or(f64::INFINITY);
        let mut value = value_of(&matrix_of(&runs));
        loop {
            let mut improved = false;
            for place in 0..runs.len() {
                parts.one_more()?;
                let others = runs.iter().enumerate().filter(|(other, _)| *other != place).map(|(_, run)| *run);
                let without = Information::of(information, others, repeats);
                let tried = parallel::each(&among, |&i| Some((value_of(&without.with(i, information)?), i)));
                let best = tried.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                if let Some((better, i)) = best.filter(|(better, _)| *better < value * (1.0 - 1e-9)) {
                    (runs[place], value, improved) = (i, better, true);
                }
            }
            if !improved {
                let matrix = matrix_of(&runs);
                return Ok(Chosen { runs, value, matrix });
            }
        }
    }

    /// So many candidates: by their shares, and of those that have none by how much more runs of them would help.
    fn promising(&self, information: &[Matrix6<f64>], shares: &Shares, count: usize) -> Vec<usize> {
        let sum: Matrix6<f64> = information.iter().zip(&shares.weights).map(|(one, weight)| one * *weight).sum();
        let slope = self.judged(&sum).map_or_else(Matrix6::zeros, |(_, slope)| slope);
        let gains: Vec<f64> = information.iter().map(|one| one.component_mul(&slope).sum()).collect();
        let mut order: Vec<usize> = (0..information.len()).collect();
        order.sort_by(|&i, &j| {
            let by_share = shares.weights[j].total_cmp(&shares.weights[i]);
            by_share.then(gains[j].total_cmp(&gains[i])).then(i.cmp(&j))
        });
        order.truncate(count);
        order
    }

    /// The median of random choices.
    pub(super) fn random(&self, information: &[Matrix6<f64>], (count, repeats): (usize, Repeats)) -> f64 {
        let mut rng = fastrand::Rng::with_seed(1);
        let mut values: Vec<f64> = (0..RANDOM)
            .map(|_| {
                let runs: Vec<usize> = (0..count).map(|_| rng.usize(..information.len())).collect();
                self.value(&Information::of(information, runs, repeats).matrix).unwrap_or(f64::INFINITY)
            })
            .collect();
        values.sort_by(f64::total_cmp);
        values[RANDOM / 2]
    }
}

/// Whole runs near the shares: rounded down, and what is left to the largest remainders; no posture more often than it may be.
fn rounded(among: &[usize], weights: &[f64], (count, repeats): (usize, Repeats)) -> Vec<usize> {
    let wanted = |i: usize| weights[i] * count as f64;
    let mut rest: Vec<usize> = among.to_vec();
    rest.sort_by(|&i, &j| wanted(j).fract().total_cmp(&wanted(i).fract()));
    let first = among.iter().flat_map(|&i| std::iter::repeat_n(i, wanted(i) as usize));
    let then = std::iter::repeat_n(&rest, count).flatten().copied();
    let mut often: BTreeMap<usize, usize> = BTreeMap::new();
    let mut may = |i: usize| {
        let runs = often.entry(repeats.posture(i)).or_insert(0);
        *runs += 1;
        *runs <= repeats.most
    };
    first.chain(then).filter(|&i| may(i)).take(count).collect()
}

fn pack(matrix: &Matrix6<f64>) -> Packed {
    let mut packed = [0.0; 21];
    let pairs = (0..6).flat_map(|i| (0..=i).map(move |j| (i, j)));
    packed.iter_mut().zip(pairs).for_each(|(slot, at)| *slot = matrix[at]);
    packed
}

fn unpack(packed: &Packed) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| {
        let (i, j) = (i.max(j), i.min(j));
        packed[i * (i + 1) / 2 + j]
    })
}

/// With what stands twice in a symmetric matrix counted twice.
fn doubled(matrix: &Matrix6<f64>) -> Packed {
    let whole = Matrix6::from_fn(|i, j| if i == j { matrix[(i, i)] } else { 2.0 * matrix[(i, j)] });
    pack(&whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector6;

    use crate::watch::Watch;

    fn random(rng: &mut fastrand::Rng, count: usize, drives: usize) -> Vec<Matrix6<f64>> {
        let one = |rng: &mut fastrand::Rng| {
            let v = Vector6::from_fn(|i, _| if i < drives { rng.f64() - 0.5 } else { 0.0 });
            v * v.transpose()
        };
        (0..count).map(|_| one(rng) + one(rng)).collect()
    }

    /// Every choice of four runs of seven candidates, with repetition.
    #[test]
    fn no_choice_of_a_few_candidates_is_better_than_the_bound_and_exchange_finds_the_best_or_nearly() {
        let (mut rng, parts) = (fastrand::Rng::with_seed(6), Watch::nobody().parts(None));
        let mut exact_ones = 0;
        let aims = [Aim::Trace(Matrix6::identity()), Aim::Determinant([1.0, 2.0, 0.5, 1.0, 1.0, 1.0])];
        let repeats = Repeats { ways: 1, most: 4, share: 0.0 };
        for aim in (0..20).flat_map(|_| aims.clone()) {
            let information = random(&mut rng, 7, 3);
            let kept = Kept::of(&information).unwrap().aiming(&aim);
            let shares = kept.shares(&information, &parts).unwrap();
            let chosen = kept.exact(&information, &shares, (4, repeats), &parts).unwrap();
            let mut best = f64::INFINITY;
            for code in 0..7_usize.pow(4) {
                let runs = [code % 7, code / 7 % 7, code / 49 % 7, code / 343];
                let matrix: Matrix6<f64> = runs.iter().map(|&i| information[i]).sum();
                best = best.min(kept.value(&matrix).unwrap_or(f64::INFINITY));
            }
            let bound = shares.bound / 4.0;
            assert!(bound <= best * (1.0 + 1e-9), "{bound} is no bound of {best}");
            assert!(GOOD * shares.value <= shares.bound, "not certified: {} of {}", shares.bound, shares.value);
            assert!(best <= chosen.value * (1.0 + 1e-9) && chosen.value <= 1.05 * best, "{} and {best}", chosen.value);
            exact_ones += usize::from(chosen.value <= best * (1.0 + 1e-9));
        }
        assert!(28 <= exact_ones, "{exact_ones} of 40 are the best");
    }

    /// Every choice of four runs of four postures under two loads each, with repetition, no posture more than twice: what a posture tells is put
    /// together from its error and that of a reading.
    #[test]
    fn no_choice_that_repeats_no_posture_too_often_is_better_than_what_exchange_finds_by_much() {
        let (mut rng, parts) = (fastrand::Rng::with_seed(2), Watch::nobody().parts(None));
        let (sigma, tau) = (1.0_f64, 0.8_f64);
        let alone = sigma * sigma + tau * tau;
        let repeats = Repeats { ways: 2, most: 2, share: tau * tau / alone };
        let mut exact_ones = 0;
        for _ in 0..30 {
            let plain = random(&mut rng, 8, 3);
            let information: Vec<Matrix6<f64>> = plain.iter().map(|one| one / alone).collect();
            let kept = Kept::of(&information).unwrap().aiming(&Aim::Trace(Matrix6::identity()));
            let shares = kept.shares(&information, &parts).unwrap();
            let chosen = kept.exact(&information, &shares, (4, repeats), &parts).unwrap();
            let mut best = f64::INFINITY;
            for code in 0..8_usize.pow(4) {
                let runs = [code % 8, code / 8 % 8, code / 64 % 8, code / 512];
                let of = |posture: usize| runs.iter().filter(move |run| **run / 2 == posture);
                if (0..4).any(|posture| 2 < of(posture).count()) {
                    continue;
                }
                let weight_of = |posture: usize| {
                    let count = of(posture).count() as f64;
                    of(posture).map(|&run| plain[run]).sum::<Matrix6<f64>>() / (sigma * sigma + count * tau * tau)
                };
                best = best.min(kept.value(&(0..4).map(weight_of).sum()).unwrap_or(f64::INFINITY));
            }
            assert!(shares.bound / 4.0 <= best * (1.0 + 1e-9), "{} is no bound of {best}", shares.bound / 4.0);
            assert!(best <= chosen.value * (1.0 + 1e-9) && chosen.value <= 1.05 * best, "{} and {best}", chosen.value);
            assert!((0..4).all(|posture| chosen.runs.iter().filter(|run| **run / 2 == posture).count() <= 2));
            exact_ones += usize::from(chosen.value <= best * (1.0 + 1e-9));
        }
        assert!(20 <= exact_ones, "{exact_ones} of 30 are the best");
    }

    /// By hand: one drive each, `phi = sum W_j / (w_j m_j)` has its least at `w_j ~ sqrt(W_j / m_j)`.
    #[test]
    fn candidates_that_show_one_drive_each_are_shared_as_the_formula_says() {
        let parts = Watch::nobody().parts(None);
        let m = [1.0, 4.0, 9.0];
        let weight = [1.0, 1.0, 4.0];
        let information: Vec<Matrix6<f64>> =
            (0..3).map(|j| Matrix6::from_fn(|a, b| if a == j && b == j { m[j] } else { 0.0 })).collect();
        let w = Matrix6::from_fn(|a, b| if a == b && a < 3 { weight[a] } else { 0.0 });
        let kept = Kept::of(&information).unwrap().aiming(&Aim::Trace(w));
        assert_eq!(kept.drives, [0, 1, 2]);
        let roots: Vec<f64> = (0..3).map(|j| f64::sqrt(weight[j] / m[j])).collect();
        let sum: f64 = roots.iter().sum();
        let shares = kept.shares(&information, &parts).unwrap();
        for (found, root) in shares.weights.iter().zip(&roots) {
            assert!((found - root / sum).abs() < 0.02, "{:?}", shares.weights);
        }
        // The least value is the square of the sum of the roots.
        assert!((shares.value / (sum * sum) - 1.0).abs() < 2e-3 && shares.bound <= sum * sum * (1.0 + 1e-12));
    }

    /// By hand: of candidates that show one drive each the volume of the errors is least where all are run as often, whatever they tell; then
    /// `phi = 3 / (m_1 m_2 m_3 k_1^2 k_2^2 k_3^2)^(1/3)`, and every drive has `tr(M^-1 M_i) = 3`.
    #[test]
    fn the_volume_of_the_errors_is_least_where_every_drive_is_shown_as_often() {
        let parts = Watch::nobody().parts(None);
        let (m, k) = ([1.0, 4.0, 9.0], [1.0, 0.5, 2.0, 1.0, 1.0, 1.0]);
        let information: Vec<Matrix6<f64>> =
            (0..3).map(|j| Matrix6::from_fn(|a, b| if a == j && b == j { m[j] } else { 0.0 })).collect();
        let kept = Kept::of(&information).unwrap().aiming(&Aim::Determinant(k));
        let shares = kept.shares(&information, &parts).unwrap();
        assert!(shares.weights.iter().all(|share| (share - 1.0 / 3.0).abs() < 1e-3), "{:?}", shares.weights);
        let least = 3.0 / 36.0_f64.cbrt();
        assert!((shares.value / least - 1.0).abs() < 1e-3 && shares.bound <= least * (1.0 + 1e-12), "{shares:?}");
    }

    /// Information of two candidates mixed: minus the slope against differences of the value.
    #[test]
    fn the_slope_of_every_aim_is_that_of_its_value() {
        let mut rng = fastrand::Rng::with_seed(1);
        let information = random(&mut rng, 12, 6);
        let sum: Matrix6<f64> = information.iter().sum();
        let sizes = [1.0, 2.0, 0.5, 3.0, 1.0, 0.7];
        for aim in [Aim::Trace(Matrix6::from_diagonal(&sizes.into())), Aim::Determinant(sizes)] {
            let kept = Kept::of(&information).unwrap().aiming(&aim);
            let (value, slope) = kept.judged(&sum).unwrap();
            let step = 1e-6;
            let moved = |by: f64| kept.value(&(sum + information[3] * by)).unwrap();
            let found = (moved(-step) - moved(step)) / (2.0 * step);
            assert!((found / slope.component_mul(&information[3]).sum() - 1.0).abs() < 1e-5);
            // Of degree -1: along the information itself the slope is the value.
            assert!((slope.component_mul(&sum).sum() / value - 1.0).abs() < 1e-9);
        }
    }
}
