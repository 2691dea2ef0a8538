//! The edge of stability tooth by tooth: semi-discretisation (Insperger, Stepan), where the mean over a revolution misleads.
//!
//! Over a step the delayed displacement stands still at the mean of the ends of the step one tooth earlier, and the directional factors at their
//! mean; between steps the motion is exact, `exp` of a matrix. What carries over from one tooth to the next is the motion and where the
//! tool was while the tooth cut: out of the cut nothing depends on the past. It swings where an eigenvalue of that map is larger than 1.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, DMatrix, DVector, Matrix3x2};

use super::curve::Edge;
use super::cut::{Cut, LONGEST};
use crate::modes::Motion;

/// Steps over a period of the fastest mode that counts, and of the fastest one there is: the depth is then good to 1 %, and to some per cent where
/// modes decide that give less of the compliance.
const PER_PERIOD: f64 = 30.0;
const PER_PERIOD_OF_ANY: f64 = 12.0;
/// Steps over a cut.
const FEWEST: usize = 16;
/// Where more would be needed, the depth is good to some per cent: modes that are followed coarsely rest from tooth to tooth.
const MOST: usize = 240;
/// A mode counts that gives this share of the compliance across the tool, or more. Others may decide where teeth pass far above all that count.
const COUNTS: f64 = 0.01;
/// Where teeth pass so many times as fast as the fastest mode that counts, they press.
const FAST: f64 = 4.0;
/// So many directions in which motion is looked at for the one that grows most: its own memory are two for each mode, the rest dies from tooth to tooth.
const DIRECTIONS: usize = 40;

/// The modes of an arm, in the axes of a cut.
#[derive(Clone, Debug)]
pub struct Teeth<'a> {
    motion: Motion,
    cut: &'a Cut,
    /// The fastest mode that counts, rad/s.
    counts: f64,
}

/// What one tooth does, by its steps.
struct Passage {
    /// Mean directional factors of each step, N/m^2.
    factors: Vec<Matrix3x2<f64>>,
    /// Of a step, and from the last step to the next tooth, s.
    step: f64,
    free: f64,
}

/// What becomes of motion and of the past from one tooth to the next.
struct Turn {
    /// Of each step: of motion, and of a displacement that stands still a tooth earlier.
    steps: Vec<(DMatrix<f64>, DMatrix<f64>)>,
    /// Out of the cut.
    free: DMatrix<f64>,
    /// The tool, by the positions of the modes.
    at: DMatrix<f64>,
}

impl Turn {
    /// Positions and speeds of the modes, then the tool at the ends of the steps.
    fn size(&self) -> usize {
        self.free.nrows() + 2 * (self.steps.len() + 1)
    }

    /// One tooth on.
    fn after(&self, before: &DVector<f64>) -> DVector<f64> {
        let kept = self.free.nrows();
        let mut now = before.rows(0, kept).into_owned();
        let mut after = DVector::zeros(self.size());
        let tool = |now: &DVector<f64>| &self.at * now.rows(0, kept / 2);
        after.rows_mut(kept, 2).copy_from(&tool(&now));
        for (i, (own, past)) in self.steps.iter().enumerate() {
            let held = (before.rows(kept + 2 * i, 2) + before.rows(kept + 2 * i + 2, 2)) * 0.5;
            now = own * now + past * held;
            after.rows_mut(kept + 2 * (i + 1), 2).copy_from(&tool(&now));
        }
        after.rows_mut(0, kept).copy_from(&(&self.free * now));
        after
    }

    /// The map as far as it reaches from one motion in so many teeth (Arnoldi): its largest eigenvalues are those of the map.
    fn projected(&self) -> DMatrix<f64> {
        let most = self.size().min(DIRECTIONS);
        let mut within = DMatrix::zeros(most, most);
        // No direction is left out by chance.
        let first = DVector::from_fn(self.size(), |i, _| 1.0 + (i as f64).sin());
        let mut directions = vec![first.normalize()];
        for column in 0..most {
            let mut next = self.after(&directions[column]);
            // Twice, so that they stay at right angles.
            for _ in 0..2 {
                for (row, direction) in directions.iter().enumerate() {
                    let along = next.dot(direction);
                    within[(row, column)] += along;
                    next.axpy(-along, direction, 1.0);
                }
            }
            let left = next.norm();
            if column + 1 == most || left <= f64::EPSILON * within.column(column).norm() {
                return within.view((0, 0), (column + 1, column + 1)).into_owned();
            }
            within[(column + 1, column)] = left;
            directions.push(next / left);
        }
        within
    }
}

/// How many steps a cut takes at a speed of the spindle, rad/s, so many over a period of a mode, rad/s.
fn steps_of(cut: &Cut, spindle: f64, mode: f64, per_period: f64) -> f64 {
    (per_period * cut.period_at(spindle) * cut.duty().min(1.0) * mode / TAU).ceil()
}

impl<'a> Teeth<'a> {
    /// Of an arm in a cut: modes that give less than a hundredth of the compliance across the tool are left out where they are too fast for any steps.
    pub fn of(motion: &Motion, cut: &'a Cut) -> Self {
        let of_mode = |i: usize| motion.tip.fixed_view::<2, 1>(0, i).norm_squared() / motion.own[i].powi(2);
        let parts: Vec<f64> = (0..motion.own.len()).map(of_mode).collect();
        let whole: f64 = parts.iter().sum();
        let counts = |i: &usize| COUNTS * whole <= parts[*i];
        let may_be_followed = |i: usize| steps_of(cut, cut.spindle, motion.own[i], PER_PERIOD_OF_ANY) <= MOST as f64;
        let kept: Vec<usize> = (0..parts.len()).filter(|i| counts(i) || may_be_followed(*i)).collect();
        let fastest = (0..parts.len()).filter(counts).map(|i| motion.own[i]).fold(0.0, f64::max);
        let motion = Motion {
            own: kept.iter().map(|&i| motion.own[i]).collect(),
            friction: motion.friction.select_rows(&kept).select_columns(&kept),
            tip: motion.tip.select_columns(&kept),
        };
        Self { motion, cut, counts: fastest }
    }

    /// The fastest mode, rad/s.
    fn fastest(&self) -> f64 {
        self.motion.own.iter().copied().fold(0.0, f64::max)
    }

    /// Does the mean over a revolution mislead here? Where a tooth cuts for half of the time or less, and teeth do not pass far above all modes that count.
    pub fn are_needed(&self) -> bool {
        let passing = TAU / self.cut.period_at(self.cut.spindle);
        self.cut.is_short() && passing < FAST * self.counts
    }

    /// In how many steps a cut is followed at a speed of the spindle, rad/s.
    pub fn steps(&self, spindle: f64) -> usize {
        let of = |mode: f64, per_period: f64| steps_of(self.cut, spindle, mode, per_period) as usize;
        of(self.counts, PER_PERIOD).max(of(self.fastest(), PER_PERIOD_OF_ANY)).clamp(FEWEST, MOST)
    }

    fn passage(&self, spindle: f64, steps: usize) -> Passage {
        let (period, duty) = (self.cut.period_at(spindle), self.cut.duty().min(1.0));
        let pitch = TAU / self.cut.milling.teeth as f64;
        let angle = |i: usize| self.cut.milling.engagement.entry() + pitch * duty * i as f64 / steps as f64;
        Passage {
            factors: (0..steps).map(|i| self.cut.milling.step_directional(angle(i), angle(i + 1))).collect(),
            step: period * duty / steps as f64,
            free: period * (1.0 - duty),
        }
    }

    /// `exp` over `time` of the motion under `a A`, and what a displacement that stands still a tooth earlier adds. Speeds are in parts of the fastest
    /// mode: positions and speeds are of one size then, which takes fewer squarings.
    fn step(&self, factors: &Matrix3x2<f64>, depth: f64, time: f64) -> (DMatrix<f64>, DMatrix<f64>) {
        let n = self.motion.own.len();
        let fastest = self.fastest();
        let push = self.motion.tip.transpose() * factors * (depth / fastest);
        let mut rate = DMatrix::zeros(2 * n + 2, 2 * n + 2);
        rate.view_mut((0, n), (n, n)).fill_diagonal(fastest);
        let mut held = &push * self.motion.tip.rows(0, 2);
        (0..n).for_each(|i| held[(i, i)] -= self.motion.own[i].powi(2) / fastest);
        rate.view_mut((n, 0), (n, n)).copy_from(&held);
        rate.view_mut((n, n), (n, n)).copy_from(&-&self.motion.friction);
        rate.view_mut((n, 2 * n), (n, 2)).copy_from(&-push);
        let whole = (rate * time).exp();
        (whole.view((0, 0), (2 * n, 2 * n)).into_owned(), whole.view((0, 2 * n), (2 * n, 2)).into_owned())
    }

    /// From one tooth to the next at a depth: a map of motion and of where the tool was at the ends of the steps.
    fn turn(&self, passage: &Passage, depth: f64) -> Turn {
        let steps = passage.factors.iter().map(|factors| self.step(factors, depth, passage.step)).collect();
        let (free, _) = self.step(&Matrix3x2::zeros(), 0.0, passage.free);
        Turn { steps, free, at: self.motion.tip.rows(0, 2).into_owned() }
    }

    /// The eigenvalue of the largest size.
    fn multiplier(&self, passage: &Passage, depth: f64) -> Complex<f64> {
        let all = self.turn(passage, depth).projected().complex_eigenvalues();
        all.iter().copied().fold(Complex::new(0.0, 0.0), |most, one| if most.norm() < one.norm() { one } else { most })
    }

    /// The least depth that swings at a speed of the spindle, rad/s, searched upwards from `from`, m; `None` where none up to [`LONGEST`] does.
    pub fn edge_at(&self, spindle: f64, steps: usize, from: f64) -> Option<Edge> {
        const RISE: f64 = 1.2;
        const CLOSE: f64 = 2e-4;
        let passage = self.passage(spindle, steps);
        let swings = |depth: f64| 1.0 < self.multiplier(&passage, depth).norm();
        let mut high = from;
        while swings(high) {
            high /= 4.0;
            if high < 1e-3 * from {
                return Some(self.edge(&passage, spindle, high));
            }
        }
        let mut low = high;
        while !swings(high) {
            if LONGEST <= high {
                return None;
            }
            (low, high) = (high, (RISE * high).min(LONGEST));
        }
        while CLOSE * high < high - low {
            let middle = f64::midpoint(low, high);
            if swings(middle) { high = middle } else { low = middle }
        }
        Some(self.edge(&passage, spindle, f64::midpoint(low, high)))
    }

    /// Of all frequencies that look alike once a tooth, the one to which the arm answers most.
    fn edge(&self, passage: &Passage, spindle: f64, depth: f64) -> Edge {
        let (turned, period) = (self.multiplier(passage, depth).arg().abs(), self.cut.period_at(spindle));
        let most = (2.0 * self.fastest() * period / TAU).ceil() as usize + 1;
        let alike = (0..=most).flat_map(|k| [TAU * k as f64 + turned, TAU * k as f64 - turned]);
        let answer = |w: f64| -> f64 {
            let of_mode = |(i, own): (usize, &f64)| {
                let rate = Complex::new(own * own - w * w, w * self.motion.friction[(i, i)]).norm();
                self.motion.tip.fixed_view::<2, 1>(0, i).norm_squared() / rate
            };
            self.motion.own.iter().enumerate().map(of_mode).sum()
        };
        let asked = alike.filter(|phase| 0.0 < *phase).map(|phase| phase / period);
        let found = asked.max_by(|a, b| answer(*a).total_cmp(&answer(*b)));
        Edge { depth, frequency: found.unwrap_or(PI / period) / TAU }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutting::{Edge as Force, Engagement, Milling};

    /// All of the map, column by column, and all of its eigenvalues.
    #[test]
    fn the_largest_eigenvalue_of_a_few_directions_is_that_of_all() {
        let mode = |hertz: f64, ratio: f64, tip: [f64; 3]| (TAU * hertz, ratio, tip);
        let motion = Motion::uncoupled(&[
            mode(16.4, 0.03, [0.09, 0.02, 0.01]),
            mode(41.0, 0.05, [-0.03, 0.08, 0.0]),
            mode(72.0, 0.02, [0.02, 0.03, 0.05]),
            mode(90.0, 0.04, [0.01, -0.02, 0.03]),
            mode(310.0, 0.03, [0.06, 0.01, 0.0]),
            mode(1640.0, 0.03, [0.3, -0.2, 0.1]),
        ]);
        let engagement = Engagement::at_depth(1e-3, [2.0, PI], 1e-4);
        let edge = Force::Linear { chip: [1800e6, 900e6, 0.0], rubbing: [0.0; 3] };
        let milling = Milling { diameter: 0.05, teeth: 2, helix: 0.0, engagement, edge };
        for rpm in [400.0, 1500.0, 4000.0, 12_000.0] {
            let cut = Cut { milling: milling.clone(), spindle: rpm * TAU / 60.0 };
            let teeth = Teeth::of(&motion, &cut);
            let passage = teeth.passage(cut.spindle, 60);
            for depth in [1e-5, 2e-4, 1e-3, 5e-3] {
                let turn = teeth.turn(&passage, depth);
                let size = turn.size();
                let unit = |i: usize| DVector::from_fn(size, |j, _| f64::from(u8::from(i == j)));
                let columns: Vec<_> = (0..size).map(|i| turn.after(&unit(i))).collect();
                let all = DMatrix::from_columns(&columns).complex_eigenvalues();
                let most = all.iter().map(|one| one.norm()).fold(0.0, f64::max);
                let found = teeth.multiplier(&passage, depth).norm();
                assert!((found / most - 1.0).abs() < 1e-6, "{rpm} rpm, {depth} m: {found} {most}");
            }
        }
    }
}
