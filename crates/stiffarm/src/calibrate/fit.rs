//! One level against rows with known weights: posterior mode, scale of the prior and of the noise by their evidence.

use nalgebra::{DMatrix, DVector};

use super::level::Level;
use crate::chain::{ALL, Chain, FRAMES, Frames};
use crate::registration::{self, Linear, Problem, Sight, State};

/// m and rad: within which the scale of the frames' errors is looked for.
pub(super) const SCALES: [f64; 2] = [0.1e-3, 2e-3];
/// m: no instrument is better.
const LEAST_NOISE: f64 = 1e-7;

/// Rows to which an arm is fitted.
pub(super) struct Rows<'a> {
    pub(super) arm: &'a Frames,
    /// How far the compliance of each drive may be off, standard deviation of its logarithm, where the arm's masses are known.
    pub(super) drives: Option<[f64; 6]>,
    pub(super) sights: Vec<Sight>,
    pub(super) stands: usize,
    pub(super) points: usize,
    /// m: so far a radian of the orientation counts.
    pub(super) lever: f64,
    /// Points of a posture may err together.
    pub(super) together: bool,
}

/// What is known before rows are fitted.
#[derive(Clone, Copy)]
pub(super) struct Given<'a> {
    /// Standard deviation of each parameter; zero holds it.
    pub(super) prior: &'a [f64],
    /// Standard deviation of a coordinate of a reading, m.
    pub(super) noise: f64,
    /// The variance that all points of a posture share, in parts of that of a reading: the arm does not stand twice in one place.
    pub(super) common: f64,
}

impl Given<'_> {
    /// Standard deviation of a coordinate of a point, m.
    pub(super) fn coordinate(self) -> f64 {
        self.noise * (1.0 + self.common).sqrt()
    }

    /// `sigma^2 / tau^2` of each parameter, infinite where it is held, beside what points share.
    fn scaled(self) -> (Vec<f64>, f64) {
        let precision = |tau: &f64| if *tau == 0.0 { f64::INFINITY } else { (self.noise / tau).powi(2) };
        (self.prior.iter().map(precision).collect(), self.common)
    }
}

/// A level as it was fitted.
pub(super) struct Fitted {
    /// `None` as drawn: only frames and points are fitted.
    pub(super) level: Option<Level>,
    pub(super) state: State,
    pub(super) rows: Vec<Linear>,
    /// Standard deviation of a coordinate of a reading, m.
    pub(super) noise: f64,
    /// The variance that all points of a posture share, in parts of that of a reading.
    pub(super) common: f64,
    /// By how many coordinates more than what was fitted it is known.
    pub(super) spare: f64,
    /// By how many errors of frames, of those that the data show, the scale of their prior is known.
    pub(super) seen: f64,
    /// Of each parameter; zero holds it.
    pub(super) prior: Vec<f64>,
    /// Logarithm of the marginal likelihood, up to what all levels share.
    pub(super) evidence: f64,
    /// How many parameters the data show: the trace of one less posterior over prior.
    pub(super) shown: f64,
    /// What the data show of each parameter, 0 to 1.
    pub(super) share: Vec<f64>,
}

impl Fitted {
    /// What the rows were fitted with.
    pub(super) fn given(&self) -> Given<'_> {
        Given { prior: &self.prior, noise: self.noise, common: self.common }
    }
}

impl Rows<'_> {
    fn problem<'p>(
        &'p self,
        (precision, common): (Vec<f64>, f64),
        chain: &'p (dyn Fn(&[f64], &[f64; 6]) -> Chain + Sync),
    ) -> Problem<'p> {
        Problem {
            sights: &self.sights,
            stands: self.stands,
            points: self.points,
            lever: self.lever,
            base: None,
            tool: None,
            precision,
            common,
            chain,
        }
    }

    /// From a state.
    pub(super) fn solved(&self, state: State, given: Given) -> (State, Vec<Linear>) {
        let chain = |parameters: &[f64], q: &[f64; 6]| self.arm.chain(parameters, q);
        self.problem(given.scaled(), &chain).solved(state)
    }

    /// The same by one step: from a state near it that is as good as the least.
    fn nearer(&self, state: State, given: Given) -> (State, Vec<Linear>) {
        let chain = |parameters: &[f64], q: &[f64; 6]| self.arm.chain(parameters, q);
        self.problem(given.scaled(), &chain).nearer(state, 1)
    }

    /// A state to start from, as drawn, by rows of which none need be right.
    pub(super) fn start(&self) -> State {
        let chain = |_: &[f64], q: &[f64; 6]| Chain { flange: self.arm.drawn(q), twists: Vec::new() };
        let problem = self.problem((Vec::new(), 0.0), &chain);
        let (state, _) = problem.solved(problem.start(Vec::new(), nalgebra::Vector3::zeros()));
        State { parameters: vec![0.0; ALL], ..state }
    }

    /// How far each row is off as drawn, about a state.
    pub(super) fn drawn(&self, state: &State) -> Vec<Linear> {
        let chain = |_: &[f64], q: &[f64; 6]| Chain { flange: self.arm.drawn(q), twists: Vec::new() };
        self.problem((Vec::new(), 0.0), &chain).linear(&State { parameters: Vec::new(), ..state.clone() })
    }

    /// The rows about a state.
    pub(super) fn linear(&self, state: &State) -> Vec<Linear> {
        let chain = |parameters: &[f64], q: &[f64; 6]| self.arm.chain(parameters, q);
        self.problem((vec![f64::INFINITY; ALL], 0.0), &chain).linear(state)
    }

    /// `H` and `g` of some of the rows, in parts of the noise.
    pub(super) fn normal<'r>(
        &self,
        rows: impl Iterator<Item = &'r Linear>,
        state: &State,
        given: Given,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let chain = |parameters: &[f64], q: &[f64; 6]| self.arm.chain(parameters, q);
        self.problem(given.scaled(), &chain).normal(rows, state)
    }

    /// How many coordinates more there are than what was fitted, where so many parameters are shown.
    fn spare(&self, rows: &[Linear], shown: f64) -> f64 {
        let is_oriented = self.sights.iter().any(|sight| sight.orientation.is_some());
        let flat = 6 * self.stands + 3 * self.points + if is_oriented { 3 } else { 0 };
        (coordinates(rows) as f64 - flat as f64 - shown).max(1.0)
    }

    /// What of the variance of the points is left over by the fit, about a state.
    pub(super) fn left(&self, rows: &[Linear], state: &State, given: Given) -> Option<f64> {
        let (h, _) = self.normal(rows.iter(), state, given);
        let covariance = h.cholesky()?.inverse();
        if given.common == 0.0 {
            let shown: f64 = shares(&covariance, given).iter().sum();
            return Some(self.spare(rows, shown) / coordinates(rows) as f64);
        }
        let count = 3 * rows.iter().map(|row| row.points().count()).sum::<usize>();
        let taken: f64 = points_open(rows.iter(), &covariance).iter().sum();
        Some((1.0 - taken / (count as f64 * (1.0 + given.common))).max(1.0 / count as f64))
    }

    /// The posterior of a level, from a state near it; scale, noise and what points of a posture share by the fixed point of their evidence.
    pub(super) fn fitted(&self, level: Option<Level>, start: &State, noise: f64) -> Option<Fitted> {
        const ROUNDS: usize = 40;
        /// Of scale, noise and shared variance, relative: below it nothing that is reported changes.
        const SETTLED: f64 = 1e-3;
        let (mut scale, mut noise) = (0.5e-3, noise.max(LEAST_NOISE));
        let mut common = if self.together { 1.0 } else { 0.0 };
        let mut state = State { parameters: vec![0.0; ALL], ..start.clone() };
        let prior_of =
            |scale: f64| level.map_or_else(|| vec![0.0; ALL], |level| level.prior(scale, self.drives.as_ref()));
        let (mut round, mut was_settled) = (0, false);
        loop {
            let prior = prior_of(scale);
            let given = Given { prior: &prior, noise, common };
            // From round to round one step is enough: the first and the last have the least.
            let whole = round == 0 || was_settled || round + 1 == ROUNDS;
            let (next, rows) = if whole { self.solved(state, given) } else { self.nearer(state, given) };
            state = next;
            let (h, _) = self.normal(rows.iter(), &state, given);
            let inverse = h.clone().cholesky()?.inverse();
            let share = shares(&inverse, given);
            let shown: f64 = share.iter().sum();
            let spare = self.spare(&rows, shown);
            let (next_noise, next_common) = Shared::of(&rows, &inverse).settled(spare, given);
            let frames: f64 = state.parameters[..FRAMES].iter().map(|x| x * x).sum();
            let seen: f64 = share[..FRAMES].iter().sum();
            let next_scale = if seen < 1e-3 { scale } else { (frames / seen).sqrt().clamp(SCALES[0], SCALES[1]) };
            round += 1;
            let is_settled = (next_noise / noise - 1.0).abs() < SETTLED
                && (next_scale / scale - 1.0).abs() < SETTLED
                && (next_common - common).abs() < SETTLED * (1.0 + common);
            if is_settled && whole || round == ROUNDS {
                let evidence = evidence(&h, (&state, given), &rows);
                return Some(Fitted { level, state, rows, noise, common, spare, seen, prior, evidence, shown, share });
            }
            (noise, scale, common, was_settled) = (next_noise, next_scale, next_common, is_settled);
        }
    }
}

/// What the data show of each parameter, by the inverse of `H`: one less posterior over prior.
fn shares(inverse: &DMatrix<f64>, Given { prior, noise, .. }: Given) -> Vec<f64> {
    let first = inverse.nrows() - ALL;
    let share = |(i, tau): (usize, &f64)| {
        if 0.0 < *tau { 1.0 - (noise / tau).powi(2) * inverse[(first + i, first + i)] } else { 0.0 }
    };
    prior.iter().enumerate().map(share).collect()
}

/// How far unknowns with a covariance leave the points of each row open: the sum of the variances of their coordinates.
pub(super) fn points_open<'r>(rows: impl Iterator<Item = &'r Linear>, covariance: &DMatrix<f64>) -> Vec<f64> {
    let rows: Vec<&Linear> = rows.collect();
    let counts: Vec<usize> = rows.iter().map(|row| 3 * row.points().count()).collect();
    let mut moved = DMatrix::zeros(counts.iter().sum(), covariance.nrows());
    let of_points = rows.iter().flat_map(|row| row.points().map(|(at, _)| row.jacobian.rows(at, 3)));
    for (i, of_point) in of_points.enumerate() {
        moved.rows_mut(3 * i, 3).copy_from(&of_point);
    }
    registration::open(&moved, counts.into_iter(), covariance)
}

/// What rows tell of noise and of what points of a posture share.
struct Shared {
    /// Of each row: the sum of the weights `S`, the square of `sum w r`, and how far the unknowns leave that open, in parts of the noise's
    /// variance.
    rows: Vec<[f64; 3]>,
    /// `sum w r^2` of all.
    squares: f64,
}

impl Shared {
    /// Of rows about a state, with the inverse of `H`.
    fn of(rows: &[Linear], inverse: &DMatrix<f64>) -> Self {
        let mut moved = DMatrix::zeros(3 * rows.len(), inverse.nrows());
        for (i, row) in rows.iter().enumerate() {
            moved.rows_mut(3 * i, 3).copy_from(&row.summed(&row.jacobian));
        }
        let open = registration::open(&moved, rows.iter().map(|_| 3), inverse);
        let of_row = |(row, open): (&Linear, f64)| {
            let residual = DMatrix::from_column_slice(row.residual.len(), 1, row.residual.as_slice());
            [row.point_weight(), row.summed(&residual).norm_squared(), open]
        };
        Self {
            rows: rows.iter().zip(open).map(of_row).collect(),
            squares: rows.iter().map(|row| row.squares(0.0)).sum(),
        }
    }

    /// Noise and shared variance at the fixed point of their evidence, as far as rows and unknowns stay as they are: of how far each
    /// posture stands beside where it should, `k sum w r`, the squares over how many of these coordinates the rows show.
    fn settled(&self, spare: f64, Given { mut common, .. }: Given) -> (f64, f64) {
        const ROUNDS: usize = 200;
        const SETTLED: f64 = 1e-5;
        /// Beside readings that do not err nothing more is told.
        const MOST: f64 = 1e6;
        let mut noise;
        let mut round = 0;
        loop {
            let shared = |weight: f64| common / (1.0 + common * weight);
            let explained: f64 = self.rows.iter().map(|[weight, square, _]| shared(*weight) * square).sum();
            noise = ((self.squares - explained) / spare).sqrt().max(LEAST_NOISE);
            round += 1;
            if common == 0.0 || round == ROUNDS {
                break;
            }
            let (mut squares, mut shown) = (0.0, 0.0);
            for [weight, square, open] in &self.rows {
                let k = shared(*weight);
                squares += k * k * square / (noise * noise);
                shown += 3.0 - 3.0 / (1.0 + common * weight) - k * k * open / common;
            }
            let next = (squares / shown.max(f64::MIN_POSITIVE)).min(MOST);
            let is_settled = (next - common).abs() < SETTLED * (1.0 + common);
            common = next;
            if is_settled {
                break;
            }
        }
        (noise, common)
    }
}

fn coordinates(rows: &[Linear]) -> usize {
    rows.iter().map(|row| row.residual.len()).sum()
}

/// `-1/2 [ r' C^-1 r / s^2 + sum x^2 / tau^2 + N ln s^2 + ln det C + sum ln tau^2 + ln det (H / s^2) ]` (Laplace), what is held left out.
fn evidence(h: &DMatrix<f64>, (state, given): (&State, Given), rows: &[Linear]) -> f64 {
    let (count, Given { prior, noise, common }) = (coordinates(rows), given);
    let squares: f64 = rows.iter().map(|row| row.squares(common)).sum();
    let of_row = |row: &Linear| {
        3.0 * (common * row.point_weight()).ln_1p() - row.weight.iter().map(|weight| weight.ln()).sum::<f64>()
    };
    let covariance: f64 = rows.iter().map(of_row).sum();
    let known = prior.iter().zip(&state.parameters).filter(|(tau, _)| 0.0 < **tau);
    let (of_prior, scales) =
        known.fold((0.0, 0.0), |(sum, logs), (tau, x)| (sum + (x / tau).powi(2), logs + 2.0 * tau.ln()));
    let first = h.nrows() - ALL;
    let is_oriented = rows.iter().any(|row| row.of.contains(&None));
    let held = |i: usize| if first <= i { prior[i - first] == 0.0 } else { first - 3 <= i && !is_oriented };
    let Some(root) = h.clone().cholesky() else { return f64::NEG_INFINITY };
    let log_det: f64 = (0..h.nrows()).filter(|&i| !held(i)).map(|i| 2.0 * (root.l_dirty()[(i, i)] / noise).ln()).sum();
    -0.5 * (squares / (noise * noise) + of_prior + 2.0 * count as f64 * noise.ln() + scales + log_det + covariance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::find;
    use crate::catalogue::readings::{ReadOptions, read};

    /// The same problem, prior and noise given, with Pinocchio's flanges and `SciPy`'s differences (`scripts/calibration_fit.py`).
    #[test]
    fn least_squares_of_another_program_finds_the_same_arm() {
        let recorded = include_str!("../../../../validation/calibration_fit.csv").lines().last().unwrap();
        let columns = recorded.split(',').map(|cell| cell.split(' ').map(|x| x.parse().unwrap()).collect());
        let [noise, prior, cost, points, errors]: [Vec<f64>; 5] = columns.collect::<Vec<_>>().try_into().unwrap();
        let table = include_str!("../../../../docs/examples/tracker.csv");
        let readings = read(table, "tracker.csv", &ReadOptions::default()).unwrap();
        let arm = Frames::of(&find("KR 210 R2700 extra").unwrap().robot()).unwrap();
        let sights = super::super::sights(&readings).unwrap();
        let rows = Rows { arm: &arm, drives: None, sights, stands: 1, points: 3, lever: 0.3, together: false };
        let (state, linear) = rows.solved(rows.start(), Given { prior: &prior, noise: noise[0], common: 0.0 });
        let squares: f64 = linear.iter().map(|row| row.residual.norm_squared()).sum::<f64>() / noise[0].powi(2);
        let of_prior: f64 = state.parameters.iter().zip(&prior).map(|(x, tau)| (x / tau).powi(2)).sum();
        assert!(((squares + of_prior) / cost[0] - 1.0).abs() < 1e-10, "{squares} and {of_prior}, not {}", cost[0]);
        // In parts of what each may be, 1e-8 m at most: shifts of the whole arm are held by the prior alone, and SciPy's differences leave
        // the slope there at some 1e-6 of it.
        for (i, ((found, expected), tau)) in state.parameters.iter().zip(&errors).zip(&prior).enumerate() {
            assert!((found - expected).abs() < 3e-5 * tau, "parameter {i}: {found} {expected}");
        }
        let found = state.points.iter().flat_map(|point| point.iter());
        assert!(
            found.zip(&points).all(|(found, expected)| (found - expected).abs() < 1e-8),
            "{:?} {points:?}",
            state.points
        );
    }
}
