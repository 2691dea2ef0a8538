//! The edge of stability of a cut whose teeth feel their mean over a revolution: one curve over the frequency gives all lobes.
//!
//! `x = G A0 a (1 - e^(-i w T)) x` has a solution where `1/mu = a (1 - e^(-i w T))` for an eigenvalue `mu` of `A0 G(w)`. As
//! `Re 1/(1 - e^(-i t)) = 1/2`, it is `a = 1 / (2 Re mu)` and `w T = pi + 2 arg mu + 2 pi k`. \[Altintas\] with the receptance of the tip in full:
//! two of the three eigenvalues are not zero, those of the first two rows of `G A0`.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use nalgebra::{Complex, DMatrix, Matrix2, Matrix2xX, Matrix3x2, MatrixXx2};

use super::cut::LONGEST;
use super::measured::Samples;
use crate::modes::Motion;
use crate::root::{minimum, root};

/// From node to node an eigenvalue moves by at most this share of it.
const STEP: f64 = 0.05;
/// By how much a chord misses an arc, as a share, with room: `STEP^2 / 8`.
const CHORD: f64 = 1e-3;
/// Eigenvalues that are less are edges beyond [`LONGEST`].
const LEAST: f64 = 0.5 / LONGEST;
/// More nodes than any six modes need: some hundred each.
const MOST_NODES: usize = 50_000;

/// s^2, of what no mode of an arm reaches.
const UNBOUNDED: f64 = 1e30;

type Pair = [Complex<f64>; 2];

/// Where a cut begins to swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Axial depth, m.
    pub depth: f64,
    /// With which it then swings, Hz.
    pub frequency: f64,
}

/// Both eigenvalues of `A0 G` over the frequency.
#[derive(Clone, Debug)]
pub struct Curve {
    motion: Motion,
    /// `S` along feed and left, and `S^T A0`.
    left: Matrix2xX<f64>,
    right: MatrixXx2<f64>,
    mean: Matrix3x2<f64>,
    samples: Option<Arc<Samples>>,
    is_coupled: bool,
    nodes: Vec<Node>,
    /// By their least depth.
    stretches: Vec<Stretch>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    w: f64,
    mu: Pair,
    /// Of `mu`, without jumps along the curve.
    arg: [f64; 2],
}

/// An eigenvalue from a node to the next, where it may be an edge up to [`LONGEST`].
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// No more than the depth of any of its edges.
    at_least: f64,
    node: usize,
    branch: usize,
}

impl Curve {
    /// Of an arm whose every mode is damped, in the axes of the cut, with `A0`, N/m^2.
    pub fn of(motion: &Motion, mean: &Matrix3x2<f64>) -> Self {
        Self::with(motion, None, mean)
    }

    /// The same with what was measured of its tip beside it, in the axes of the cut; what was measured instead of it tells between its own ends alone.
    pub fn with(motion: &Motion, samples: Option<Arc<Samples>>, mean: &Matrix3x2<f64>) -> Self {
        let mut curve = Self {
            left: motion.tip.fixed_rows::<2>(0).into_owned(),
            right: motion.tip.transpose() * mean,
            mean: *mean,
            is_coupled: motion.is_coupled(),
            motion: motion.clone(),
            samples,
            nodes: Vec::new(),
            stretches: Vec::new(),
        };
        let [start, end] = curve.samples.as_ref().map_or([0.0, f64::INFINITY], |samples| samples.ends());
        let mu = curve.pair(start);
        curve.nodes.push(Node { w: start, mu, arg: mu.map(Complex::arg) });
        let seeds = curve.seeds();
        seeds.into_iter().filter(|w| start < *w && *w <= end).for_each(|w| curve.follow_to(w));
        if end == f64::INFINITY {
            curve.follow_to_the_end();
        }
        curve.stretches = stretches(&curve.nodes);
        curve
    }

    /// The first two rows of `G(w) A0`, 1/m.
    fn loop_gain(&self, w: f64) -> Matrix2<Complex<f64>> {
        let complex = |x: f64| Complex::new(x, 0.0);
        let mut sum = match &self.samples {
            Some(samples) => samples.at(w).fixed_rows::<2>(0) * self.mean.map(complex),
            None => Matrix2::zeros(),
        };
        if self.is_coupled {
            let n = self.motion.own.len();
            // Damped modes leave no frequency without an inverse; where nothing damps, an arm answers without bound.
            let dynamic = self.motion.dynamic(w).unwrap_or_else(|| DMatrix::identity(n, n) * complex(UNBOUNDED));
            return sum + self.left.map(complex) * dynamic * self.right.map(complex);
        }
        for (i, own) in self.motion.own.iter().enumerate() {
            let answer = Complex::new(own * own - w * w, w * self.motion.friction[(i, i)]).inv();
            sum += (self.left.column(i) * self.right.row(i)).map(|x| answer * x);
        }
        sum
    }

    fn pair(&self, w: f64) -> Pair {
        let gain = self.loop_gain(w);
        let half = gain.trace() * 0.5;
        let root = (half * half - gain.determinant()).sqrt();
        [half + root, half - root]
    }

    /// The pair in the order of another nearby.
    fn pair_near(&self, w: f64, other: &Pair) -> Pair {
        let [a, b] = self.pair(w);
        let apart = |a: Complex<f64>, b: Complex<f64>| (a - other[0]).norm() + (b - other[1]).norm();
        if apart(b, a) < apart(a, b) { [b, a] } else { [a, b] }
    }

    /// Frequencies that are not missed: about each mode by its half width, evenly spread, and those that were measured, rad/s.
    fn seeds(&self) -> Vec<f64> {
        const WIDTHS: [f64; 11] = [-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0, 8.0];
        let own = &self.motion.own;
        let about = own.iter().enumerate().flat_map(|(i, own)| {
            let half = self.motion.friction[(i, i)] / 2.0;
            WIDTHS.map(|width| own + width * half)
        });
        let [first, last] = [own.iter().copied().reduce(f64::min), own.iter().copied().reduce(f64::max)];
        let even = first.zip(last).into_iter().flat_map(|(first, last)| {
            (1..=40).map(move |i| 0.1 * first * (20.0 * last / first).powf(f64::from(i) / 40.0))
        });
        let measured = self.samples.as_ref().map_or(&[][..], |samples| samples.frequencies());
        let mut seeds: Vec<f64> = about.chain(even).chain(measured.iter().copied()).filter(|w| 0.0 < *w).collect();
        seeds.sort_by(f64::total_cmp);
        seeds
    }

    fn follow_to(&mut self, w: f64) {
        let mut ahead = vec![w];
        while let (Some(&next), Some(&last)) = (ahead.last(), self.nodes.last()) {
            let mu = self.pair_near(next, &last.mu);
            let is_far = |i: usize| {
                let size = mu[i].norm().max(last.mu[i].norm()).max(LEAST);
                STEP * size < (mu[i] - last.mu[i]).norm()
            };
            let may_halve = 1e-9 * next < next - last.w && self.nodes.len() + ahead.len() < MOST_NODES;
            if may_halve && (is_far(0) || is_far(1)) {
                ahead.push(f64::midpoint(last.w, next));
                continue;
            }
            let arg = [0, 1].map(|i| last.arg[i] + (mu[i] * last.mu[i].conj()).arg());
            self.nodes.push(Node { w: next, mu, arg });
            ahead.pop();
        }
    }

    /// As far as the longest edge has something to swing with: beyond the last mode eigenvalues fall with the square of the frequency.
    fn follow_to_the_end(&mut self) {
        const MOST_STEPS: usize = 200;
        for _ in 0..MOST_STEPS {
            let Some(last) = self.nodes.last().copied() else { return };
            if last.w == 0.0 || last.mu.iter().all(|mu| mu.norm() < LEAST) {
                return;
            }
            self.follow_to(1.1 * last.w);
        }
    }

    /// How many frequencies the curve has.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// The least depth that swings where teeth are `period` apart, s; `None` where no edge up to [`LONGEST`] does.
    pub fn edge_at(&self, period: f64) -> Option<Edge> {
        let mut best: Option<Edge> = None;
        for stretch in &self.stretches {
            if best.is_some_and(|best| best.depth < stretch.at_least) {
                break;
            }
            for turns in self.turns(stretch, period) {
                let is_less = |found: &Edge| best.map_or(found.depth <= LONGEST, |best| found.depth < best.depth);
                best = self.refined(stretch, turns, period).filter(is_less).or(best);
            }
        }
        best
    }

    /// The whole turns, rad, between the phase of the delay and that of the eigenvalue on a stretch.
    fn turns(&self, stretch: &Stretch, period: f64) -> impl Iterator<Item = f64> {
        let phase = |node: &Node| node.w * period - PI - 2.0 * node.arg[stretch.branch];
        let [from, to] = [stretch.node, stretch.node + 1].map(|i| phase(&self.nodes[i]));
        let (first, last) = ((from.min(to) / TAU).ceil() as i64, (from.max(to) / TAU).floor() as i64);
        (first..=last).map(|turns| TAU * turns as f64)
    }

    fn refined(&self, stretch: &Stretch, turns: f64, period: f64) -> Option<Edge> {
        let [low, high] = [self.nodes[stretch.node], self.nodes[stretch.node + 1]];
        let i = stretch.branch;
        let mu_at = |w: f64| self.between(&low, &high, w)[i];
        let phase = |w: f64| {
            let arg = low.arg[i] + (mu_at(w) * low.mu[i].conj()).arg();
            w * period - PI - 2.0 * arg - turns
        };
        let rises = phase(low.w) <= phase(high.w);
        let w = root(low.w, high.w, |w| if rises { phase(w) } else { -phase(w) });
        let real = mu_at(w).re;
        (0.0 < real).then(|| Edge { depth: 0.5 / real, frequency: w / TAU })
    }

    /// The pair between two nodes.
    fn between(&self, low: &Node, high: &Node, w: f64) -> Pair {
        let share = (w - low.w) / (high.w - low.w);
        self.pair_near(w, &[0, 1].map(|i| low.mu[i] + (high.mu[i] - low.mu[i]) * share))
    }

    /// The depth that swings at no speed, `1 / (2 max Re mu)`; `None` beyond [`LONGEST`].
    pub fn any_speed(&self) -> Option<Edge> {
        let most = |pair: Pair| pair[0].re.max(pair[1].re);
        let by = |a: &usize, b: &usize| most(self.nodes[*a].mu).total_cmp(&most(self.nodes[*b].mu));
        let peak = (0..self.nodes.len()).max_by(by)?;
        let [low, high] = [peak.saturating_sub(1), (peak + 1).min(self.nodes.len() - 1)].map(|i| self.nodes[i].w);
        let (w, least) = minimum(low, high, |w| -most(self.pair(w)));
        let depth = -0.5 / least;
        (0.0 < depth && depth <= LONGEST).then_some(Edge { depth, frequency: w / TAU })
    }

    /// Where modes couple by the force alone, without its delay: the least `a` at which `M x'' + D x' + (K - a A0) x = 0` swings or gives way,
    /// `a = 1/mu` where `mu` is real and positive. \[Pan\] `None` beyond [`LONGEST`].
    pub fn without_delay(&self) -> Option<Edge> {
        let edge = |mu: f64, w: f64| (0.0 < mu).then(|| Edge { depth: 1.0 / mu, frequency: w / TAU });
        // Of what was measured at the tip of an arm nothing is known at rest.
        let first = self.nodes.iter().take_while(|node| node.w == 0.0);
        let at_rest = first.flat_map(|node| node.mu).filter(|mu| mu.im == 0.0).filter_map(|mu| edge(mu.re, 0.0));
        let pairs = self.nodes.windows(2).flat_map(|pair| [0, 1].map(|i| (pair[0], pair[1], i)));
        let crossed =
            pairs.filter(|(low, high, i)| low.mu[*i].im * high.mu[*i].im < 0.0).filter_map(|(low, high, i)| {
                let rises = low.mu[i].im < 0.0;
                let at = |w: f64| self.between(&low, &high, w)[i];
                let w = root(low.w, high.w, |w| if rises { at(w).im } else { -at(w).im });
                edge(at(w).re, w)
            });
        at_rest.chain(crossed).min_by(|a, b| a.depth.total_cmp(&b.depth)).filter(|edge| edge.depth <= LONGEST)
    }
}

/// The stretches of a curve by their least depth. Between two nodes the arc departs from its chord by at most [`CHORD`] of its size.
fn stretches(nodes: &[Node]) -> Vec<Stretch> {
    let pairs = nodes.windows(2).enumerate().flat_map(|(node, pair)| [0, 1].map(|branch| (node, branch, pair)));
    let stretches = pairs.filter_map(|(node, branch, pair)| {
        let mu = [pair[0].mu[branch], pair[1].mu[branch]];
        let real = mu[0].re.max(mu[1].re) + CHORD * mu[0].norm().max(mu[1].norm());
        (LEAST <= real).then(|| Stretch { at_least: 0.5 / real, node, branch })
    });
    let mut stretches: Vec<Stretch> = stretches.collect();
    stretches.sort_by(|a, b| a.at_least.total_cmp(&b.at_least));
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against every crossing between any two nodes, each refined.
    #[test]
    fn no_crossing_is_less_deep_than_the_edge_that_is_found() {
        let mode = |hertz: f64, ratio: f64, tip: [f64; 3]| (TAU * hertz, ratio, tip);
        let motion = Motion::uncoupled(&[
            mode(9.0, 0.02, [0.08, 0.03, 0.01]),
            mode(14.0, 0.03, [-0.02, 0.09, 0.02]),
            mode(31.0, 0.015, [0.06, -0.05, 0.04]),
            mode(55.0, 0.04, [0.05, 0.07, -0.03]),
        ]);
        let mean = Matrix3x2::new(-6e8, -3e8, 4e8, -7e8, -1e8, -2e8);
        let curve = Curve::of(&motion, &mean);
        let (mut found, mut not_of_the_first) = (0, 0);
        for i in 0..600 {
            let period = 2e-3 * 1.007_f64.powi(i);
            let all = (0..curve.nodes.len() - 1).flat_map(|node| [0, 1].map(|branch| (node, branch)));
            let crossings = all.flat_map(|(node, branch)| {
                let stretch = Stretch { at_least: 0.0, node, branch };
                let refined = |turns| Some((node, curve.refined(&stretch, turns, period)?));
                curve.turns(&stretch, period).filter_map(refined).collect::<Vec<_>>()
            });
            let within = crossings.filter(|(_, edge)| edge.depth <= LONGEST);
            let least = within.min_by(|a, b| a.1.depth.total_cmp(&b.1.depth));
            assert_eq!(curve.edge_at(period), least.map(|(_, edge)| edge), "{period}");
            found += usize::from(least.is_some());
            let first = curve.stretches.iter().find(|stretch| curve.turns(stretch, period).next().is_some());
            not_of_the_first += usize::from(least.map(|(node, _)| node) != first.map(|stretch| stretch.node));
        }
        assert!(500 < found && 0 < not_of_the_first, "{found} {not_of_the_first}");
    }
}
