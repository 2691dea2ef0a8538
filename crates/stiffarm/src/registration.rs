//! How does an arm stand before whoever sees it? The base in the frame of the instrument, the points that are looked at on the
//! flange, and what is unknown of the arm itself: nonlinear least squares with a normal prior.
//!
//! Of row `k` the point `j` is expected at `B F_k(x) t_j` and the tool stands as `R_B R_F R_T`, with the base `B` of the row's stand, the
//! flange `F_k` in the base, the points `t_j` and the turn `R_T` of the tool in the flange, and parameters `x` of the arm with the prior
//! precisions `lambda`. Least is
//!
//! `sum w |p - B F t|^2 + sum w h^2 |log(R_T' R_F' R_B' R)|^2 + sum lambda x^2`
//!
//! with the lever `h` that makes a turn a length. Points of one posture may err together, as the arm stands a little beside where it says:
//! with the variance `c` of that in parts of the variance of a reading, the inverse of their covariance is `W - k W 1 1' W`, `k = c/(1 + c sum w)`.

use nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};

use crate::chain::Chain;
use crate::parallel;
use crate::spatial::Pose;

/// Rows whose squares are summed together.
const TOGETHER: usize = 32;
/// Rows that a thread takes at a time: fewer are done before another thread is awake. A multiple of [`TOGETHER`].
const AT_A_TIME: usize = 128;
const _: () = assert!(AT_A_TIME.is_multiple_of(TOGETHER), "sums would be others");

/// What was seen at one posture.
#[derive(Clone, Debug)]
pub(crate) struct Sight {
    pub q: [f64; 6],
    /// Each point, m, with its weight.
    pub points: Vec<Option<(Vector3<f64>, f64)>>,
    pub orientation: Option<UnitQuaternion<f64>>,
    pub stand: usize,
}

/// What is unknown, and what it rests on.
pub(crate) struct Problem<'a> {
    pub sights: &'a [Sight],
    pub stands: usize,
    pub points: usize,
    /// m: so far a radian of the tool's turn counts.
    pub lever: f64,
    /// The base in the frame of the readings, where it is given.
    pub base: Option<Pose>,
    /// The tool in the flange, where it is given.
    pub tool: Option<Pose>,
    /// Of each parameter, in parts of the squared residual; infinite holds it at zero.
    pub precision: Vec<f64>,
    /// The variance that all points of a posture share, in parts of that of a reading.
    pub common: f64,
    pub chain: &'a (dyn Fn(&[f64], &[f64; 6]) -> Chain + Sync),
}

/// What was found of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    pub bases: Vec<Pose>,
    pub points: Vec<Vector3<f64>>,
    pub turn: UnitQuaternion<f64>,
    pub parameters: Vec<f64>,
}

/// A row in the neighbourhood of a state: residuals, `seen - expected`, and how the unknowns move what is expected.
pub(crate) struct Linear {
    pub jacobian: DMatrix<f64>,
    pub residual: DVector<f64>,
    pub weight: DVector<f64>,
    /// Which point three residuals are of; `None` of the orientation.
    pub of: Vec<Option<usize>>,
}

impl Linear {
    /// Which points were seen, each with where its three residuals begin.
    pub(crate) fn points(&self) -> impl Iterator<Item = (usize, usize)> {
        self.of.iter().enumerate().filter_map(|(block, point)| Some((3 * block, (*point)?)))
    }

    /// The sum of the weights of the points.
    pub(crate) fn point_weight(&self) -> f64 {
        self.points().map(|(at, _)| self.weight[at]).sum()
    }

    /// What the inverse covariance has less where points share so much variance: `k`.
    pub(crate) fn shared(&self, common: f64) -> f64 {
        common / (1.0 + common * self.point_weight())
    }

    /// The weighted sum of three coordinates over the points: of residuals, or of what moves them.
    pub(crate) fn summed(&self, of: &DMatrix<f64>) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(3, of.ncols());
        self.points().for_each(|(at, _)| sum += of.rows(at, 3) * self.weight[at]);
        sum
    }

    /// The squared residuals in parts of their covariance.
    pub(crate) fn squares(&self, common: f64) -> f64 {
        let alone = self.residual.component_mul(&self.residual).dot(&self.weight);
        if common == 0.0 {
            return alone;
        }
        let sum: Vector3<f64> = self.points().map(|(at, _)| self.residual.fixed_rows::<3>(at) * self.weight[at]).sum();
        alone - self.shared(common) * sum.norm_squared()
    }
}

impl Problem<'_> {
    pub(crate) fn unknowns(&self) -> usize {
        self.first_parameter() + self.precision.len()
    }

    /// Behind six of each base.
    pub(crate) fn first_point(&self) -> usize {
        6 * self.stands
    }

    /// Six of each base, three of each point, three of the turn, then the parameters.
    pub(crate) fn first_parameter(&self) -> usize {
        6 * self.stands + 3 * self.points + 3
    }

    fn is_oriented(&self) -> bool {
        self.sights.iter().any(|sight| sight.orientation.is_some())
    }

    /// Which unknowns are not looked for.
    fn is_held(&self, i: usize) -> bool {
        let points = 6 * self.stands;
        if i < points {
            return self.base.is_some();
        }
        if i < self.first_parameter() {
            return self.tool.is_some() || (points + 3 * self.points <= i && !self.is_oriented());
        }
        self.precision[i - self.first_parameter()].is_infinite()
    }

    /// The rows about a state.
    pub(crate) fn linear(&self, state: &State) -> Vec<Linear> {
        let rows = |_, some: &[Sight]| some.iter().map(|sight| self.row(sight, state)).collect::<Vec<_>>();
        parallel::take_each(self.sights.chunks(AT_A_TIME), rows).into_iter().flatten().collect()
    }

    fn row(&self, sight: &Sight, state: &State) -> Linear {
        let Chain { flange, twists } = (self.chain)(&state.parameters, &sight.q);
        let base = &state.bases[sight.stand];
        let turn = base.rotation * flange.rotation;
        let seen: Vec<(usize, Vector3<f64>, f64)> =
            sight.points.iter().enumerate().filter_map(|(i, at)| at.map(|(at, weight)| (i, at, weight))).collect();
        let blocks = seen.len() + usize::from(sight.orientation.is_some());
        let mut jacobian = DMatrix::zeros(3 * blocks, self.unknowns());
        let (mut residual, mut weight) = (DVector::zeros(3 * blocks), DVector::zeros(3 * blocks));
        let (to_base, to_points, to_turn) = (6 * sight.stand, 6 * self.stands, 6 * self.stands + 3 * self.points);
        let first = self.first_parameter();
        let mut of = Vec::with_capacity(blocks);
        for (block, (i, at, w)) in seen.into_iter().enumerate() {
            let in_base = flange * nalgebra::Point3::from(state.points[i]);
            let arm = base.rotation * in_base.coords;
            let rows = 3 * block;
            residual.fixed_rows_mut::<3>(rows).copy_from(&(at - (base.translation.vector + arm)));
            weight.fixed_rows_mut::<3>(rows).fill(w);
            jacobian.fixed_view_mut::<3, 3>(rows, to_base).copy_from(&Matrix3::identity());
            jacobian.fixed_view_mut::<3, 3>(rows, to_base + 3).copy_from(&-arm.cross_matrix());
            jacobian.fixed_view_mut::<3, 3>(rows, to_points + 3 * i).copy_from(turn.to_rotation_matrix().matrix());
            for (column, [v, w]) in twists.iter().enumerate() {
                let moved = base.rotation * (v + w.cross(&in_base.coords));
                jacobian.fixed_view_mut::<3, 1>(rows, first + column).copy_from(&moved);
            }
            of.push(Some(i));
        }
        if let Some(orientation) = sight.orientation {
            let rows = 3 * of.len();
            let expected = turn * state.turn;
            residual
                .fixed_rows_mut::<3>(rows)
                .copy_from(&(self.lever * (orientation * expected.inverse()).scaled_axis()));
            let least = sight.points.iter().flatten().map(|(_, weight)| *weight).fold(f64::INFINITY, f64::min);
            weight.fixed_rows_mut::<3>(rows).fill(least);
            jacobian.fixed_view_mut::<3, 3>(rows, to_base + 3).copy_from(&(self.lever * Matrix3::identity()));
            jacobian
                .fixed_view_mut::<3, 3>(rows, to_turn)
                .copy_from(&(self.lever * turn.to_rotation_matrix().matrix()));
            for (column, [_, w]) in twists.iter().enumerate() {
                jacobian.fixed_view_mut::<3, 1>(rows, first + column).copy_from(&(self.lever * (base.rotation * w)));
            }
            of.push(None);
        }
        for held in (0..self.unknowns()).filter(|&i| self.is_held(i)) {
            jacobian.column_mut(held).fill(0.0);
        }
        Linear { jacobian, residual, weight, of }
    }

    /// What is to be least.
    pub(crate) fn cost(&self, rows: &[Linear], state: &State) -> f64 {
        let seen: f64 = rows.iter().map(|row| row.squares(self.common)).sum();
        let prior = state.parameters.iter().zip(&self.precision).filter(|(_, precision)| precision.is_finite());
        seen + prior.map(|(x, precision)| precision * x * x).sum::<f64>()
    }

    /// `H = J' C^-1 J + lambda` and `J' C^-1 r - lambda x`; what is held has 1 on the diagonal and nothing else.
    pub(crate) fn normal<'r>(
        &self,
        rows: impl Iterator<Item = &'r Linear>,
        state: &State,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.unknowns();
        let rows: Vec<&Linear> = rows.collect();
        // What is held moves nothing, and is not multiplied.
        let free: Vec<usize> = (0..n).filter(|&i| !self.is_held(i)).collect();
        let sums = |_, some: &[&Linear]| {
            some.chunks(TOGETHER).map(|some| summed(some, &free, self.common)).collect::<Vec<_>>()
        };
        let parts = parallel::take_each(rows.chunks(AT_A_TIME), sums);
        // In the order of the rows, whoever has finished first.
        let nothing = (DMatrix::zeros(free.len(), free.len()), DVector::zeros(free.len()));
        let (of_free, slope) =
            parts.into_iter().flatten().fold(nothing, |(h, g), (more_h, more_g)| (h + more_h, g + more_g));
        let (mut h, mut g) = (DMatrix::identity(n, n), DVector::zeros(n));
        for (j, &column) in free.iter().enumerate() {
            for (i, &row) in free.iter().enumerate() {
                h[(row, column)] = of_free[(i, j)];
            }
            g[column] = slope[j];
            if let Some(parameter) = column.checked_sub(self.first_parameter()) {
                h[(column, column)] += self.precision[parameter];
                g[column] -= self.precision[parameter] * state.parameters[parameter];
            }
        }
        (h, g)
    }

    /// The state that a step leads to.
    pub(crate) fn moved(&self, state: &State, step: &DVector<f64>) -> State {
        let three = |at: usize| -> Vector3<f64> { step.fixed_rows::<3>(at).into() };
        let bases = state.bases.iter().enumerate().map(|(i, base)| {
            let turn = UnitQuaternion::new(three(6 * i + 3)) * base.rotation;
            Isometry3::from_parts(Translation3::from(base.translation.vector + three(6 * i)), turn)
        });
        let points = state.points.iter().enumerate().map(|(i, point)| point + three(6 * self.stands + 3 * i));
        let parameters = state.parameters.iter().enumerate().map(|(i, x)| x + step[self.first_parameter() + i]);
        State {
            bases: bases.collect(),
            points: points.collect(),
            turn: UnitQuaternion::new(three(6 * self.stands + 3 * self.points)) * state.turn,
            parameters: parameters.collect(),
        }
    }

    /// The least from a start, by Levenberg's and Marquardt's steps, with its rows.
    pub(crate) fn solved(&self, state: State) -> (State, Vec<Linear>) {
        /// Of steps.
        const MOST: usize = 60;
        self.nearer(state, MOST)
    }

    /// The same by so many steps at most.
    pub(crate) fn nearer(&self, mut state: State, steps: usize) -> (State, Vec<Linear>) {
        /// Of the cost: what is gained by less is rounding.
        const GAIN: f64 = 1e-13;
        /// m and rad: a step below this moves nothing that is seen.
        const STEP: f64 = 1e-13;
        let mut rows = self.linear(&state);
        let mut cost = self.cost(&rows, &state);
        let mut damping = 1e-6;
        for _ in 0..steps {
            let (h, g) = self.normal(rows.iter(), &state);
            let Some(step) = damped(&h, &g, damping) else {
                damping = (damping * 10.0_f64).max(1e-9);
                continue;
            };
            let next = self.moved(&state, &step);
            let next_rows = self.linear(&next);
            let next_cost = self.cost(&next_rows, &next);
            if next_cost <= cost {
                let ended = cost - next_cost <= GAIN * cost && damping < 1e-3 || step.amax() < STEP;
                (state, rows, cost) = (next, next_rows, next_cost);
                damping = (damping / 20.0).max(1e-14);
                if ended {
                    break;
                }
            } else if step.amax() < STEP || 1e8 < damping {
                break;
            } else {
                damping *= 10.0;
            }
        }
        (state, rows)
    }

    /// A state to start from: the base by the flange's places alone, then the points and the turn of the tool by their means.
    pub(crate) fn start(&self, parameters: Vec<f64>, point: Vector3<f64>) -> State {
        let flanges: Vec<Pose> = self.sights.iter().map(|sight| (self.chain)(&parameters, &sight.q).flange).collect();
        let centre = |sight: &Sight| {
            let seen: Vec<Vector3<f64>> = sight.points.iter().flatten().map(|(at, _)| *at).collect();
            seen.iter().sum::<Vector3<f64>>() / seen.len() as f64
        };
        let bases: Vec<Pose> = (0..self.stands)
            .map(|stand| {
                self.base.unwrap_or_else(|| {
                    let rows = self.sights.iter().zip(&flanges).filter(|(sight, _)| sight.stand == stand);
                    let pairs = rows.map(|(sight, flange)| (flange * nalgebra::Point3::from(point), centre(sight)));
                    onto(&pairs.map(|(from, to)| (from.coords, to)).collect::<Vec<_>>())
                })
            })
            .collect();
        let frames = |i: usize| bases[self.sights[i].stand] * flanges[i];
        let points = (0..self.points).map(|j| {
            let seen = self.sights.iter().enumerate().filter_map(|(i, sight)| {
                sight.points[j].map(|(at, _)| frames(i).inverse_transform_point(&at.into()).coords)
            });
            let seen: Vec<Vector3<f64>> = seen.collect();
            seen.iter().sum::<Vector3<f64>>() / seen.len().max(1) as f64
        });
        let turns = self
            .sights
            .iter()
            .enumerate()
            .filter_map(|(i, sight)| Some(frames(i).rotation.inverse() * sight.orientation?));
        let sum = turns.fold(Matrix3::zeros(), |sum, turn| sum + turn.to_rotation_matrix().matrix());
        let (points, turn) = match &self.tool {
            Some(tool) => (vec![tool.translation.vector; self.points], tool.rotation),
            None => (points.collect(), nearest(&sum)),
        };
        State { bases, points, turn, parameters }
    }
}

/// How some unknowns move what is expected of some rows, one row below the other.
pub(crate) fn stacked(rows: &[&Linear], unknowns: &[usize]) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(rows.iter().map(|row| row.residual.len()).sum(), unknowns.len());
    let mut first = 0;
    for row in rows {
        let count = row.residual.len();
        for (column, &unknown) in unknowns.iter().enumerate() {
            all.view_mut((first, column), (count, 1)).copy_from(&row.jacobian.column(unknown));
        }
        first += count;
    }
    all
}

/// How far unknowns with a covariance leave some quantities open, of which each has so many rows of `moved` one below the other: the sums of the
/// variances. As one product of large matrices, which is many times faster than one for each.
pub(crate) fn open(moved: &DMatrix<f64>, counts: impl Iterator<Item = usize>, covariance: &DMatrix<f64>) -> Vec<f64> {
    let spread = moved * covariance;
    let mut first = 0;
    let of = |count: usize| {
        let open = spread.rows(first, count).dot(&moved.rows(first, count));
        first += count;
        open
    };
    counts.map(of).collect()
}

/// `J' C^-1 J` and `J' C^-1 r` of some rows by some unknowns: as one product of large matrices, too.
fn summed(rows: &[&Linear], unknowns: &[usize], common: f64) -> (DMatrix<f64>, DVector<f64>) {
    let mut jacobian = stacked(rows, unknowns);
    let all = |of: fn(&Linear) -> &DVector<f64>| {
        DVector::from_iterator(jacobian.nrows(), rows.iter().flat_map(|row| of(row).iter().copied()))
    };
    let (residual, weight) = (all(|row| &row.residual), all(|row| &row.weight));
    let moved = jacobian.transpose();
    jacobian.column_iter_mut().for_each(|mut column| column.component_mul_assign(&weight));
    let mut first = 0;
    for row in rows.iter().filter(|_| 0.0 < common) {
        let mut together = DMatrix::zeros(3, unknowns.len());
        row.points().for_each(|(at, _)| together += jacobian.rows(first + at, 3));
        together *= row.shared(common);
        for (at, _) in row.points() {
            let mut of_point = jacobian.rows_mut(first + at, 3);
            of_point -= &together * row.weight[at];
        }
        first += row.residual.len();
    }
    (&moved * &jacobian, jacobian.tr_mul(&residual))
}

fn damped(h: &DMatrix<f64>, g: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
    let mut h = h.clone();
    let floor = 1e-12 * h.diagonal().max();
    for i in 0..h.nrows() {
        h[(i, i)] += damping * h[(i, i)] + 1e-3 * damping.min(1e-6) * floor + f64::MIN_POSITIVE;
    }
    let step = h.cholesky()?.solve(g);
    step.iter().all(|x| x.is_finite()).then_some(step)
}

/// The rotation nearest to a matrix: `U diag(1, 1, det U V') V'`.
pub(crate) fn nearest(matrix: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let svd = matrix.svd(true, true);
    let (Some(u), Some(vt)) = (svd.u, svd.v_t) else { return UnitQuaternion::identity() };
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, (u * vt).determinant().signum()));
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(u * mirror * vt);
    UnitQuaternion::from_rotation_matrix(&rotation)
}

/// The pose that leads points onto others with the least sum of squares (Kabsch).
pub(crate) fn onto(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Pose {
    let n = pairs.len().max(1) as f64;
    let from = pairs.iter().map(|(from, _)| from).sum::<Vector3<f64>>() / n;
    let to = pairs.iter().map(|(_, to)| to).sum::<Vector3<f64>>() / n;
    let turns = pairs.iter().fold(Matrix3::zeros(), |sum, (a, b)| sum + (b - to) * (a - from).transpose());
    let turn = nearest(&turns);
    Isometry3::from_parts(Translation3::from(to - turn * from), turn)
}
