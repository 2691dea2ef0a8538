//! The edge of stability tooth by tooth: semi-discretisation (Insperger, Stepan), where the mean over a revolution misleads.
//!
//! Over a step the delayed displacement stands still at the mean of the ends of the step one tooth earlier, and the directional factors at their
//! mean; between steps the motion is exact, `exp` of a matrix. What carries over from one tooth to the next is the motion and where the
//! tool was while the tooth cut: out of the cut nothing depends on the past. It swings where an eigenvalue of that map is larger than 1.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, DMatrix, Matrix3x2};

use super::curve::Edge;
use super::cut::{Cut, LONGEST};
use crate::modes::Motion;

/// Steps over a period of the fastest mode that matters: the depth is then good to 1 %.
const PER_PERIOD: f64 = 30.0;
/// Steps over a cut.
const FEWEST: usize = 16;
const MOST: usize = 120;
/// A mode that gives a smaller share of the compliance across the tool does not matter.
const COUNTS: f64 = 0.01;
/// Where teeth pass so many times as fast as the fastest mode that matters, they press.
const FAST: f64 = 4.0;

/// The modes of an arm that matter across the tool, in the axes of a cut.
#[derive(Clone, Debug)]
pub struct Teeth<'a> {
    motion: Motion,
    cut: &'a Cut,
}

/// What one tooth does, by its steps.
struct Passage {
    /// Mean directional factors of each step, N/m^2.
    factors: Vec<Matrix3x2<f64>>,
    /// Of a step, and from the last step to the next tooth, s.
    step: f64,
    free: f64,
}

impl<'a> Teeth<'a> {
    /// Of an arm in a cut: modes that give less than a hundredth of the compliance across the tool are left out.
    pub fn of(motion: &Motion, cut: &'a Cut) -> Self {
        let of_mode = |i: usize| motion.tip.fixed_view::<2, 1>(0, i).norm_squared() / motion.own[i].powi(2);
        let parts: Vec<f64> = (0..motion.own.len()).map(of_mode).collect();
        let whole: f64 = parts.iter().sum();
        let kept: Vec<usize> = (0..parts.len()).filter(|&i| COUNTS * whole <= parts[i]).collect();
        let motion = Motion {
            own: kept.iter().map(|&i| motion.own[i]).collect(),
            friction: motion.friction.select_rows(&kept).select_columns(&kept),
            tip: motion.tip.select_columns(&kept),
        };
        Self { motion, cut }
    }

    /// The fastest mode that matters, rad/s.
    fn fastest(&self) -> f64 {
        self.motion.own.iter().copied().fold(0.0, f64::max)
    }

    /// Does the mean over a revolution mislead here? Where a tooth cuts for half of the time or less, and teeth do not pass far above all modes that matter.
    pub fn are_needed(&self) -> bool {
        let passing = TAU / self.cut.period_at(self.cut.spindle);
        self.cut.is_short() && passing < FAST * self.fastest()
    }

    /// How many steps a cut needs at a speed of the spindle, rad/s; `None` where they are too many to be taken.
    pub fn steps(&self, spindle: f64) -> Option<usize> {
        let cutting = self.cut.period_at(spindle) * self.cut.duty().min(1.0);
        let steps = (PER_PERIOD * cutting * self.fastest() / TAU).ceil();
        (steps <= MOST as f64).then(|| (steps as usize).max(FEWEST))
    }

    fn passage(&self, spindle: f64, steps: usize) -> Passage {
        let (period, duty) = (self.cut.period_at(spindle), self.cut.duty().min(1.0));
        let pitch = TAU / self.cut.milling.teeth as f64;
        let angle = |i: usize| self.cut.milling.engagement.entry + pitch * duty * i as f64 / steps as f64;
        Passage {
            factors: (0..steps).map(|i| self.cut.milling.step_directional(angle(i), angle(i + 1))).collect(),
            step: period * duty / steps as f64,
            free: period * (1.0 - duty),
        }
    }

    /// `exp` over `time` of the motion under `a A`, and what a displacement that stands still a tooth earlier adds.
    fn step(&self, factors: &Matrix3x2<f64>, depth: f64, time: f64) -> (DMatrix<f64>, DMatrix<f64>) {
        let n = self.motion.own.len();
        let push = self.motion.tip.transpose() * factors * depth;
        let mut rate = DMatrix::zeros(2 * n + 2, 2 * n + 2);
        rate.view_mut((0, n), (n, n)).fill_with_identity();
        let mut held = &push * self.motion.tip.rows(0, 2);
        (0..n).for_each(|i| held[(i, i)] -= self.motion.own[i].powi(2));
        rate.view_mut((n, 0), (n, n)).copy_from(&held);
        rate.view_mut((n, n), (n, n)).copy_from(&-&self.motion.friction);
        rate.view_mut((n, 2 * n), (n, 2)).copy_from(&-push);
        let whole = (rate * time).exp();
        (whole.view((0, 0), (2 * n, 2 * n)).into_owned(), whole.view((0, 2 * n), (2 * n, 2)).into_owned())
    }

    /// From one tooth to the next: motion, and where the tool was at the ends of the steps.
    fn map(&self, passage: &Passage, depth: f64) -> DMatrix<f64> {
        let (n, steps) = (self.motion.own.len(), passage.factors.len());
        let (kept, size) = (2 * n, 2 * n + 2 * (steps + 1));
        let at = self.motion.tip.rows(0, 2);
        let mut map = DMatrix::zeros(size, size);
        let mut now = DMatrix::identity(kept, size);
        map.view_mut((kept, 0), (2, size)).copy_from(&(at * now.rows(0, n)));
        for (i, factors) in passage.factors.iter().enumerate() {
            let (own, past) = self.step(factors, depth, passage.step);
            now = own * now;
            for earlier in [kept + 2 * i, kept + 2 * i + 2] {
                let mut columns = now.view_mut((0, earlier), (kept, 2));
                columns += &past * 0.5;
            }
            map.view_mut((kept + 2 * (i + 1), 0), (2, size)).copy_from(&(at * now.rows(0, n)));
        }
        let (free, _) = self.step(&Matrix3x2::zeros(), 0.0, passage.free);
        map.view_mut((0, 0), (kept, size)).copy_from(&(free * now));
        map
    }

    /// The eigenvalue of the largest size.
    fn multiplier(&self, passage: &Passage, depth: f64) -> Complex<f64> {
        let all = self.map(passage, depth).complex_eigenvalues();
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
