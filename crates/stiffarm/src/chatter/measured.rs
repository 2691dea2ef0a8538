//! What was measured at a tip: how it answers a force that swings, given mode by mode or frequency by frequency.

use std::f64::consts::TAU;

use nalgebra::{Complex, Matrix3, Rotation3, Vector3};

use crate::modes::Motion;

/// Im G of a driving point may be more than zero by this share of |G|, and be noise.
const NOISE: f64 = 0.05;
/// From row to row a response that is sampled finely enough moves by less than this share of its largest.
const FINE: f64 = 0.25;

/// What held the tip while it was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldBy {
    /// Something rigid: spindle, holder and cutter alone are in it, and come on top of what the robot does.
    Rigid,
    /// The robot, at the posture of the cut: everything is in it, and it takes the place of the model.
    Robot,
}

/// How a tip answers a force that swings, along the axes of the tool frame.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredTip {
    /// What held it.
    pub held_by: HeldBy,
    /// How it answers.
    pub response: Response,
}

/// A receptance, m/N.
#[derive(Clone, Debug, PartialEq)]
pub enum Response {
    /// The sum of its modes.
    Modes(Motion),
    /// At some frequencies, linear between them.
    Samples(Samples),
}

/// One mode as a tap test tells it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredMode {
    /// Undamped, Hz.
    pub frequency: f64,
    /// Share of critical damping.
    pub ratio: f64,
    /// Force over displacement of the tip along the direction, N/m.
    pub stiffness: f64,
    /// In which the tip moves, any length, tool axes.
    pub direction: [f64; 3],
}

impl Response {
    /// Of modes, in any order.
    pub fn of_modes(modes: &[MeasuredMode]) -> Self {
        let mut modes = modes.to_vec();
        modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        let mode_of = |mode: &MeasuredMode| {
            let own = TAU * mode.frequency;
            // S S^T / own^2 is the compliance 1/k along the direction.
            let shape = Vector3::from(mode.direction).normalize() * (own / mode.stiffness.sqrt());
            (own, mode.ratio, shape.into())
        };
        Self::Modes(Motion::uncoupled(&modes.iter().map(mode_of).collect::<Vec<_>>()))
    }
}

/// A receptance at some frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// Rad/s, ascending.
    own: Vec<f64>,
    /// m/N; a row is along which the tip moves, a column along which it is pushed.
    receptance: Vec<Matrix3<Complex<f64>>>,
    goes_on: bool,
}

impl Samples {
    /// At frequencies in Hz, ascending, at least two; `None` where they are not.
    pub fn new(rows: Vec<(f64, Matrix3<Complex<f64>>)>) -> Option<Self> {
        let rises = rows.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let is_sound = 2 <= rows.len() && 0.0 <= rows[0].0 && rises;
        let (own, receptance) = rows.into_iter().map(|(hertz, receptance)| (TAU * hertz, receptance)).unzip();
        is_sound.then_some(Self { own, receptance, goes_on: false })
    }

    /// The same of what stands beside a robot, whose modes go on: below its first frequency what it is there without the part that lags, a spring,
    /// and above its last one a mass, whose answer falls with the square of the frequency.
    #[must_use]
    pub(super) fn beside_robot(mut self) -> Self {
        self.goes_on = true;
        self
    }

    /// The same in axes whose columns are given in the axes that it has.
    #[must_use]
    pub fn seen_along(mut self, axes: &Matrix3<f64>) -> Self {
        let axes = axes.map(|x| Complex::new(x, 0.0));
        self.receptance.iter_mut().for_each(|one| *one = axes.transpose() * *one * axes);
        self
    }

    /// Between which frequencies it tells something, rad/s.
    pub(super) fn ends(&self) -> [f64; 2] {
        if self.goes_on { [0.0, f64::INFINITY] } else { [self.own[0], self.own[self.own.len() - 1]] }
    }

    /// Rad/s.
    pub(super) fn frequencies(&self) -> &[f64] {
        &self.own
    }

    /// At `w`, rad/s; beyond its ends as at them unless it goes on.
    pub(super) fn at(&self, w: f64) -> Matrix3<Complex<f64>> {
        let above = self.own.partition_point(|own| *own <= w);
        let last = self.own.len() - 1;
        match above {
            0 if self.goes_on => self.receptance[0].map(|g| Complex::new(g.re, 0.0)),
            0 => self.receptance[0],
            _ if last < above && self.goes_on => {
                let share = (self.own[last] / w).powi(2);
                self.receptance[last].map(|g| g * share)
            }
            _ if last < above => self.receptance[last],
            _ => {
                let share = (w - self.own[above - 1]) / (self.own[above] - self.own[above - 1]);
                self.receptance[above - 1].zip_map(&self.receptance[above], |low, high| low + (high - low) * share)
            }
        }
    }

    /// Along which axes the tip would swing by itself where it answers most: the table is of another sign, `e^(-i w t)`, or not causal.
    pub fn gives_energy(&self) -> Vec<usize> {
        let gives = |axis: usize| {
            let largest = (0..self.own.len()).max_by(|a, b| self.size(*a, axis).total_cmp(&self.size(*b, axis)));
            largest.is_some_and(|row| NOISE * self.size(row, axis) < self.receptance[row][(axis, axis)].im)
        };
        (0..3).filter(|axis| gives(*axis)).collect()
    }

    /// At how many frequencies the damping of a driving point is negative by more than noise.
    pub fn negative_damping(&self) -> usize {
        let is_negative =
            |row: &usize| (0..3).any(|axis| NOISE * self.size(*row, axis) < self.receptance[*row][(axis, axis)].im);
        (0..self.own.len()).filter(is_negative).count()
    }

    /// Between which frequencies, Hz, the response moves most from row to row, and by which share of its largest,
    /// where that is too much for the response to be known.
    pub fn coarsest(&self) -> Option<([f64; 2], f64)> {
        let largest = self.receptance.iter().map(Matrix3::norm).fold(0.0, f64::max);
        let step = |row: usize| (self.receptance[row + 1] - self.receptance[row]).norm() / largest;
        let worst = (0..self.own.len() - 1).max_by(|a, b| step(*a).total_cmp(&step(*b)))?;
        let is_coarse = FINE < step(worst);
        is_coarse.then(|| ([self.own[worst] / TAU, self.own[worst + 1] / TAU], step(worst)))
    }

    /// A pair of axes that answer to each other by more than their own answers allow, by so many times: no tip that gives no energy does. `None` where
    /// an axis has no answer of its own.
    ///
    /// `-Im G` of such a tip has no negative eigenvalue, so `(Im G_xy)^2 <= Im G_xx Im G_yy`. Looked at where `Im G_xy` is largest.
    pub fn crosses_too_much(&self) -> Option<([usize; 2], f64)> {
        /// What another hammer or a misaligned sensor may do.
        const AMISS: f64 = 2.0;
        let of_pair = |[a, b]: [usize; 2]| {
            let crossed =
                |row: usize| f64::midpoint(self.receptance[row][(a, b)].im, self.receptance[row][(b, a)].im).abs();
            let row = (0..self.own.len()).max_by(|i, j| crossed(*i).total_cmp(&crossed(*j)))?;
            let own = [a, b].map(|axis| self.receptance[row][(axis, axis)].im.abs());
            let has_own = [a, b].iter().all(|axis| 0.0 < self.largest(*axis));
            let times = crossed(row) / (own[0] * own[1]).sqrt();
            (has_own && AMISS < times).then_some(([a, b], times))
        };
        [[0, 1], [0, 2], [1, 2]].into_iter().filter_map(of_pair).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The largest answer of a driving point along an axis of the tool, m/N.
    pub fn largest(&self, axis: usize) -> f64 {
        (0..self.own.len()).map(|row| self.size(row, axis)).fold(0.0, f64::max)
    }

    /// Along which axes across the tool it does not give way towards a push where the table begins: it begins above a resonance.
    pub fn begins_late(&self) -> Option<usize> {
        (0..2).find(|axis| !(0.0 < self.receptance[0][(*axis, *axis)].re))
    }

    /// Along which axes across the tool it answers at the end of the table no less than half as much as at its beginning: it ends before its modes.
    pub fn ends_early(&self) -> Option<usize> {
        let last = self.own.len() - 1;
        (0..2).find(|axis| self.size(0, *axis) < 2.0 * self.size(last, *axis))
    }

    fn size(&self, row: usize, axis: usize) -> f64 {
        self.receptance[row][(axis, axis)].norm()
    }

    /// How many frequencies there are.
    pub fn count(&self) -> usize {
        self.own.len()
    }
}

/// What of a measured tip was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Looked {
    /// What held it.
    pub held_by: HeldBy,
    /// Its modes, Hz; empty where it is given frequency by frequency.
    pub modes: Vec<f64>,
    /// Between which frequencies it is given, Hz; `None` of modes.
    pub between: Option<[f64; 2]>,
    /// The frequencies of the table lie too far apart to tell its peaks.
    pub is_coarse: bool,
}

impl Looked {
    /// The highest frequency of which it tells something, Hz.
    pub fn highest(&self) -> f64 {
        self.between.map_or_else(|| self.modes.iter().copied().fold(0.0, f64::max), |[_, to]| to)
    }
}

impl MeasuredTip {
    /// What of it is looked at.
    pub(super) fn looked(&self) -> Looked {
        let hertz = |own: &f64| own / TAU;
        let (modes, between, is_coarse) = match &self.response {
            Response::Modes(motion) => (motion.own.iter().map(hertz).collect(), None, false),
            Response::Samples(samples) => {
                let ends = [samples.own[0] / TAU, samples.own[samples.own.len() - 1] / TAU];
                (Vec::new(), Some(ends), samples.coarsest().is_some())
            }
        };
        Looked { held_by: self.held_by, modes, between, is_coarse }
    }

    /// The same in the axes of a cut, base axes, of a tool turned by `tool`: modes, and samples.
    pub(super) fn in_cut(&self, tool: &Rotation3<f64>, axes: &Matrix3<f64>) -> (Option<Motion>, Option<Samples>) {
        let axes = tool.matrix().transpose() * axes;
        match &self.response {
            Response::Modes(motion) => (Some(motion.clone().seen_along(&axes)), None),
            Response::Samples(samples) => {
                let seen = samples.clone().seen_along(&axes);
                (None, Some(if self.held_by == HeldBy::Rigid { seen.beside_robot() } else { seen }))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear between its lines; beside a robot a spring below and a mass above, alone as at its ends.
    #[test]
    fn a_table_goes_on_as_a_spring_and_as_a_mass() {
        let spring = |re: f64, im: f64| Matrix3::from_diagonal_element(Complex::new(re, im));
        let alone = Samples::new(vec![(10.0, spring(4.0, -1.0)), (20.0, spring(8.0, -3.0))]).unwrap();
        let beside = alone.clone().beside_robot();
        let at = |samples: &Samples, hertz: f64| samples.at(TAU * hertz)[(1, 1)];
        let close = |found: Complex<f64>, re: f64, im: f64| assert!((found - Complex::new(re, im)).norm() < 1e-12);
        for samples in [&alone, &beside] {
            close(at(samples, 12.5), 5.0, -1.5);
            close(at(samples, 20.0), 8.0, -3.0);
        }
        close(at(&beside, 1.0), 4.0, 0.0);
        close(at(&beside, 40.0), 2.0, -0.75);
        close(at(&alone, 1.0), 4.0, -1.0);
        close(at(&alone, 40.0), 8.0, -3.0);
        assert_eq!((alone.ends(), beside.ends()), ([TAU * 10.0, TAU * 20.0], [0.0, f64::INFINITY]));
    }
}
