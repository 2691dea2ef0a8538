//! No place of a part is better: branch and bound over boxes of places, each sample at its own best roll.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::ground::{Place, Region};
use super::{ROLLS, Search};
use crate::batch::RollGrid;
use crate::cell::Block;
use crate::enclose::{Affine, ToolFrameEnclosure, Vector, sin_cos, sum};
use crate::frontier::{self, Frontier};
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::mill::bound::{Cell, Tip};
use crate::mill::fault::MillError;
use crate::mill::ladder::Ladder;
use crate::mill::solve::RollMode;
use crate::parallel;
use crate::spatial::Pose;
use crate::tolerances::BOUND;
use crate::watch::Watch;

/// Nodes of the proof, how many are bounded at a time, and the width of the finest roll that is enclosed, rad.
const MOST_NODES: usize = 4000;
const AT_A_TIME: usize = 32;
const FINEST_ROLL: f64 = TAU / 96.0;
/// A bound this near to the value, as a part of it, is good enough.
const ENOUGH: f64 = 0.01;

/// The tool at intervals of the roll.
type Frames = Vec<(Interval, ToolFrameEnclosure<5>)>;

/// Places that are bounded together.
struct Node {
    lower: f64,
    /// x, y, z, yaw.
    ranges: [Interval; 4],
    /// In which every tip must lie, in the same axes.
    block: Option<Block>,
}

/// Where nodes lie.
struct Axes {
    base_from_here: Pose,
    is_base: bool,
    /// Of every tip: x and z from the base, and the distance from the joint-1 axis.
    of_tips: [Interval; 3],
}

impl frontier::Node for Node {
    fn key(&self) -> [f64; 2] {
        [self.lower, 0.0]
    }
}

impl Search<'_> {
    /// The samples that bind at a place are enclosed first: they are those that bind elsewhere, too.
    pub(super) fn put_binding_first(&mut self, place: &Place) -> Result<(), MillError> {
        let ladder = Ladder::bare(&self.arm, self.stations, self.stand(place), self.options.part);
        let (grid, mut errors) = (RollGrid::turn(ROLLS[1]), std::array::from_fn(|_| Vec::new()));
        let mut keys: Vec<(f32, usize)> = Vec::with_capacity(self.keys.len());
        for &i in &self.keys {
            ladder.errors_at(i, &grid, &mut errors)?;
            keys.push((errors.iter().flatten().copied().fold(f32::INFINITY, f32::min), i));
        }
        // Those of one run stay together.
        keys.sort_by(|a, b| self.runs[a.1].cmp(&self.runs[b.1]).then(b.0.total_cmp(&a.0)));
        self.keys = keys.into_iter().map(|(_, i)| i).collect();
        Ok(())
    }

    fn axes(&self, base_from_here: Pose) -> Axes {
        Axes { base_from_here, is_base: base_from_here == Pose::identity(), of_tips: self.site.of_tips() }
    }

    /// No place has a smaller largest error than this, m, which is at most `known`; and how many nodes that took.
    pub(super) fn lower_bound(&self, known: f64, watch: Watch) -> Result<(f64, usize), MillError> {
        let (base_from_here, regions) = self.site.regions();
        if regions.is_empty() {
            return Ok((0.0, 0));
        }
        let axes = self.axes(base_from_here);
        let enough = known * (1.0 - ENOUGH);
        let parts = watch.parts(None);
        let whole = regions.into_iter().map(|Region { ranges, block }| Node { lower: 0.0, ranges, block });
        let mut queue: Frontier<Node> = whole.collect();
        let (mut nodes, mut fathomed) = (0, f64::INFINITY);
        while let Some(first) = queue.pop() {
            if MOST_NODES < nodes {
                let lower = first.lower.min(fathomed);
                return Ok((lower.min(known) * (1.0 - BOUND), nodes));
            }
            let more = (1..AT_A_TIME).map_while(|_| queue.pop());
            let halves: Vec<Node> = [first].into_iter().chain(more).flat_map(|node| self.halves(&node)).collect();
            nodes += halves.len();
            let bounded = |node: &Node| {
                parts.one_more()?;
                self.bounded(node, &axes, enough)
            };
            let bounds: Vec<Option<f64>> = parallel::try_each(&halves, bounded)?;
            for (node, bound) in halves.into_iter().zip(bounds) {
                match bound {
                    None => {}
                    Some(lower) if enough <= lower => fathomed = fathomed.min(lower),
                    Some(lower) => queue.push(Node { lower: lower.max(node.lower), ..node }),
                }
            }
        }
        Ok((fathomed.min(known) * (1.0 - BOUND), nodes))
    }

    /// Across what moves the path most.
    fn halves(&self, node: &Node) -> [Node; 2] {
        let size =
            self.keys.iter().map(|i| (self.stations[*i].sample.pose.tip - self.middle).norm()).fold(0.05, f64::max);
        let moves = |i: usize| {
            node.ranges[i].width() * if i == 3 { size + self.flange_from_tool.translation.vector.norm() } else { 1.0 }
        };
        let longest = (0..4).max_by(|a, b| moves(*a).total_cmp(&moves(*b))).unwrap_or(0);
        node.ranges[longest].halves().map(|half| {
            let mut ranges = node.ranges;
            ranges[longest] = half;
            Node { lower: node.lower, ranges, block: node.block }
        })
    }

    /// A lower bound over the places of a node, no further than `enough`; `None` where none of them holds the path.
    fn bounded(&self, node: &Node, axes: &Axes, enough: f64) -> Result<Option<f64>, MillError> {
        let turn = sin_cos::<5>(node.ranges[3], 3);
        let length = |i: usize| {
            let mut length = Affine::point(node.ranges[i].middle());
            length.deviations[i] = node.ranges[i].width() / 2.0;
            length
        };
        let centre: Vector<5> = [length(0), length(1), length(2)];
        let aside = |v: Vector3<f64>| -> Vector<5> {
            let (s, c) = turn;
            [c * v.x - s * v.y, s * v.x + c * v.y, Affine::point(v.z)]
        };
        let here = |p: Vector3<f64>| sum(&centre, &aside(p - self.middle));
        let turned = |v: Vector3<f64>| axes.turned(aside(v));
        let moved = |p: Vector3<f64>| axes.moved(here(p));
        for i in &self.keys {
            let tip = self.stations[*i].sample.pose.tip;
            let [x, y, z] = moved(tip);
            let away = x.square() + y.square();
            let [of_x, of_z, of_away] = axes.of_tips;
            let is_aside = node.block.is_some_and(|block| (0..3).any(|i| out(&here(tip)[i], block.sides()[i])));
            if out(&x, of_x) || out(&z, of_z) || out(&away, squared(of_away)) || is_aside {
                return Ok(None);
            }
        }
        // Every sample at its own roll, every run in one configuration: between runs the arm may be arranged anew.
        let mut lower = 0.0_f64;
        for run in self.keys.chunk_by(|a, b| self.runs[*a] == self.runs[*b]) {
            let tip = |i: &usize| Tip::new(&self.stations[*i], self.options.part, moved, turned);
            let tips = run.iter().map(tip).collect::<Result<Vec<_>, _>>()?;
            let Some(of_run) = self.over_run(&tips, enough) else { return Ok(None) };
            lower = lower.max(of_run);
            if enough <= lower {
                break;
            }
        }
        Ok(Some(lower))
    }

    /// A lower bound on the largest error of samples that one configuration holds, the best of all; `None` where none does.
    fn over_run(&self, tips: &[Tip<5>], enough: f64) -> Option<f64> {
        let rolls: Vec<Interval> = match self.options.roll {
            RollMode::Fixed(roll) => vec![Interval::point(roll)],
            _ => (0..6).map(|i| Interval::spanning(TAU * f64::from(i) / 6.0, TAU * f64::from(i + 1) / 6.0)).collect(),
        };
        // The same for all configurations, where it comes to them.
        let frames: Vec<OnceCell<Frames>> = vec![OnceCell::new(); tips.len()];
        let mut best: Option<f64> = None;
        let alike = self.arm.wrists_are_alike();
        for configuration in Configuration::ALL.into_iter().step_by(if alike { 2 } else { 1 }) {
            // A configuration that is no better than the best so far tells nothing more.
            let enough = best.map_or(enough, |best| best.min(enough));
            let mut worst = Some(0.0_f64);
            for (tip, frames) in tips.iter().zip(&frames) {
                let Some(known) = worst.filter(|worst| *worst < enough) else { break };
                let turned = |roll: &Interval| (*roll, self.turned(tip, *roll));
                let frames = frames.get_or_init(|| rolls.iter().map(turned).collect());
                worst = self.over_rolls(tip, frames, configuration, enough).map(|lower| lower.max(known));
            }
            best = best.into_iter().chain(worst).reduce(f64::min);
        }
        best
    }

    fn turned(&self, tip: &Tip<5>, roll: Interval) -> ToolFrameEnclosure<5> {
        tip.turned(&self.enclosure, sin_cos(roll, 4))
    }

    /// The least bound of a sample over all rolls, no further than `enough`; `None` where it is held at none.
    fn over_rolls(&self, tip: &Tip<5>, frames: &Frames, configuration: Configuration, enough: f64) -> Option<f64> {
        let mut open = Frontier::new();
        let mut least: Option<f64> = None;
        let mut look = |roll: Interval, frame: &ToolFrameEnclosure<5>, parent: f64, open: &mut Frontier<Cell>| {
            // Both wrists stand for one another where they are alike.
            let bound = tip.either_wrist((&self.enclosure, self.arm.wrists_are_alike()), frame, configuration);
            match bound.map(|lower| lower.max(parent)) {
                None => {}
                Some(lower) if enough <= lower => least = least.into_iter().chain([lower]).reduce(f64::min),
                Some(lower) => open.push(Cell { lower, roll }),
            }
        };
        for (roll, frame) in frames {
            look(*roll, frame, 0.0, &mut open);
        }
        while let Some(Cell { lower, roll }) = open.pop() {
            // Every other roll has at least as much.
            if roll.width() < FINEST_ROLL {
                return Some(lower);
            }
            for half in roll.halves() {
                look(half, &self.turned(tip, half), lower, &mut open);
            }
        }
        least
    }
}

impl Axes {
    /// A direction along the axes of the base.
    fn turned(&self, v: Vector<5>) -> Vector<5> {
        if self.is_base {
            return v;
        }
        let turn = self.base_from_here.rotation.to_rotation_matrix();
        std::array::from_fn(|i| v[0] * turn[(i, 0)] + v[1] * turn[(i, 1)] + v[2] * turn[(i, 2)])
    }

    /// A point from the base.
    fn moved(&self, p: Vector<5>) -> Vector<5> {
        let turned = self.turned(p);
        std::array::from_fn(|i| turned[i] + self.base_from_here.translation.vector[i])
    }
}

/// All of it lies outside of a range.
fn out(part: &Affine<5>, range: Interval) -> bool {
    part.max() < range.min() - 1e-9 || range.max() + 1e-9 < part.min()
}

/// Of lengths.
fn squared(range: Interval) -> Interval {
    Interval::spanning(range.min() * range.min(), range.max() * range.max())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::mill::place::{PathGround, Rolls};
    use crate::mill::{Acting, MillOptions, stations};
    use crate::place::Margins;
    use crate::toolpath::{Builtin, Steps};

    /// Places by chance inside of boxes by chance: none of them has less than the bound of its box, by the kernel that evaluates single places and
    /// shares no formula with the enclosure; of small boxes the bound is near.
    #[test]
    fn no_place_of_a_box_has_less_than_its_bound() {
        let robot =
            paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("a robot of the paper");
        let tool = Pose::new(Vector3::new(0.2, 0.0, 0.15), Vector3::y() * 1.2);
        let moves = "rect:0.3x0.2".parse::<Builtin>().unwrap().moves(Some(0.02));
        let options = MillOptions::usual();
        let mut rng = fastrand::Rng::with_seed(140);
        let (mut held, mut near, mut closed) = (0, 0, 0);
        for acting in [Acting::Known { force: [300.0, -120.0, 80.0], moment: 90.0 }, Acting::Any(400.0)] {
            let path = stations(&moves, &Steps { longest: 0.05, ..Steps::USUAL }, |_| Some(acting));
            let ground = PathGround { margins: Margins::usual(), within: None, cell: None };
            let search = Search::new(&robot, &tool, &path, (&options, &ground)).unwrap().expect("a window");
            let axes = search.axes(Pose::identity());
            for case in 0..60 {
                let width = [0.3, 0.02, 1e-3][case % 3];
                let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                // Some of them out of reach.
                let [x, z, yaw] = [part(1.0, 4.0), part(0.2, 1.6), part(-3.0, 3.0)]
                    .map(|from| Interval::spanning(from, from + width));
                let ranges = [x, Interval::point(0.0), z, yaw];
                let bound = search.bounded(&Node { lower: 0.0, ranges, block: None }, &axes, f64::INFINITY).unwrap();
                for _ in 0..4 {
                    let place = ranges.map(|range| range.min() + range.width() * rng.f64());
                    let value = search.value(&place, ROLLS[1], Rolls::BestOfEach).unwrap();
                    let Some(bound) = bound else {
                        assert!(value == f64::INFINITY, "{ranges:?}: {value} at {place:?}");
                        closed += 1;
                        continue;
                    };
                    // The kernel tells single precision.
                    assert!(bound <= value * (1.0 + 1e-6), "{ranges:?}: {bound} {value} at {place:?}");
                    held += usize::from(value.is_finite() && width < 0.01);
                    near += usize::from(value.is_finite() && width < 0.01 && 0.9 * value < bound);
                }
            }
        }
        assert!(20 < held && 20 < closed && held < 2 * near, "{held} {near} {closed}");
    }
}
