//! How much better could any other roll be? Lower bounds on the error along a path, by enclosures of the error over intervals of the roll.
//!
//! No path of rolls is better than any of its samples at that sample's best roll: a few samples, those that bound, are enough. Within a
//! run one configuration is kept. Joints between samples are left aside, so the bound holds for every path of rolls, and may lie
//! below the best of them.

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::{Point3, Vector3};

use super::fault::MillError;
use super::follow::{Stand, part_from_tool};
use super::ladder::Ladder;
use super::solve::{Question, RollMode};
use super::stations::{ErrorPart, Station, cutting_axes};
use crate::batch::Pushing;
use crate::enclose::{Affine, ArmEnclosure, NodeBounds, PushEnclosure, ToolFrameEnclosure, Vector, sin_cos};
use crate::frontier::{self, Frontier};
use crate::interval::Interval;
use crate::inverse::{ArmBranch, Configuration, Wrist};
use crate::tolerances::BOUND;

/// Intervals of the roll that are enclosed first.
const FIRST: usize = 24;
/// Intervals that are enclosed of one sample at most.
const MOST_CELLS: usize = 600;
/// The bound of a sample is good enough this near to the error that is known, as a part of it.
const ENOUGH: f64 = 1e-3;
/// Samples of a run whose bounds are searched for.
const SAMPLES: usize = 3;
/// Runs of which bounds are searched for: those with the largest errors.
const RUNS: usize = 3;
/// By how much an error of the ladder may be too large by rounding, as a part of it.
const ROUNDING: f64 = 1e-6;
/// Samples that bound a constant roll, and its intervals.
const BINDING: usize = 24;
const MOST_CONSTANT: usize = 4000;

/// Lower bounds for a part that stands somewhere.
pub(super) struct Floor<'a> {
    question: &'a Question<'a>,
    stand: Stand,
    enclosure: ArmEnclosure,
    wrists_are_alike: bool,
}

/// The least error of some rungs, m, and which they are.
type Rungs = Vec<(f32, usize)>;

/// An interval of the roll with its bound.
pub(super) struct Cell {
    pub(super) lower: f64,
    pub(super) roll: Interval,
}

impl frontier::Node for Cell {
    fn key(&self) -> [f64; 2] {
        [self.lower, 0.0]
    }
}

impl<'a> Floor<'a> {
    pub(super) fn new(question: &'a Question<'a>, stand: &Stand) -> Self {
        let enclosure = ArmEnclosure::new(question.arm, [false; 6]);
        Self { question, stand: *stand, enclosure, wrists_are_alike: question.arm.wrists_are_alike() }
    }

    /// No rolls of the mode that is asked for have a smaller largest error than this, m, which is at most `known`.
    pub(super) fn lower_bound(&self, ladder: &Ladder, known: f64) -> Result<f64, MillError> {
        match self.question.options.roll {
            RollMode::Fixed(_) => Ok(Self::of_one_roll(ladder).min(known)),
            // A constant roll is one of all.
            RollMode::Constant => Ok(self.of_constant(ladder, known)?.max(self.of_free(ladder, known)?)),
            RollMode::Free | RollMode::Linear => self.of_free(ladder, known),
        }
    }

    /// Every run in its best configuration: nothing is left to enclose but the rounding of the ladder's errors.
    fn of_one_roll(ladder: &Ladder) -> f64 {
        let of = |run: &Range<usize>, c: usize| run.clone().map(|k| ladder.rungs[k].errors[c][0]).fold(0.0, f32::max);
        let least = |run: Range<usize>| (0..Configuration::COUNT).map(|c| of(&run, c)).fold(f32::INFINITY, f32::min);
        f64::from(ladder.runs().into_iter().map(least).fold(0.0, f32::max)) * (1.0 - ROUNDING)
    }

    /// The largest of the bounds of some runs; of each the least over configurations of the largest over its samples.
    fn of_free(&self, ladder: &Ladder, known: f64) -> Result<f64, MillError> {
        let mut runs: Vec<(f64, [Rungs; Configuration::COUNT])> = Vec::new();
        for run in ladder.runs() {
            // The best roll of every rung, the worst rungs first.
            let rungs = |c: usize| {
                let of = |k: usize| (ladder.rungs[k].errors[c].iter().copied().fold(f32::INFINITY, f32::min), k);
                let mut all: Rungs = run.clone().map(of).collect();
                all.sort_by(|a, b| b.0.total_cmp(&a.0));
                all.truncate(SAMPLES);
                all
            };
            let worst: [Rungs; Configuration::COUNT] = std::array::from_fn(rungs);
            let least = worst.iter().map(|all| all[0].0).fold(f32::INFINITY, f32::min);
            runs.push((f64::from(least), worst));
        }
        runs.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut lower = 0.0_f64;
        for (_, worst) in runs.iter().take(RUNS) {
            let mut of_run = f64::INFINITY;
            for (c, rungs) in worst.iter().enumerate() {
                let mut of_configuration = 0.0_f64;
                for (least, k) in rungs {
                    if ladder.rungs[*k].pinned.is_some() {
                        of_configuration = of_configuration.max(f64::from(*least) * (1.0 - ROUNDING));
                        continue;
                    }
                    let i = worst_station(ladder, *k, c)?;
                    of_configuration = of_configuration.max(self.of_sample(&ladder.stations[i], c, known)?);
                    if known <= of_configuration {
                        break;
                    }
                }
                of_run = of_run.min(of_configuration);
            }
            lower = lower.max(of_run);
        }
        Ok(lower.min(known))
    }

    /// The least error of one sample in a configuration at any roll; no further than `known`.
    fn of_sample(&self, station: &Station, c: usize, known: f64) -> Result<f64, MillError> {
        let enough = known * (1.0 - ENOUGH);
        let tip = self.tip(station)?;
        let bound = |roll: Interval| self.over(&tip, Configuration::ALL[c], roll);
        let lower = Self::least(bound, enough, MOST_CELLS);
        Ok(if enough <= lower { known.min(lower) } else { lower })
    }

    /// The least bound over all rolls, by splitting the intervals with the least one.
    fn least(bound: impl Fn(Interval) -> Option<f64>, enough: f64, most: usize) -> f64 {
        let mut queue = Frontier::new();
        let width = TAU / FIRST as f64;
        let mut cells: Vec<Interval> =
            (0..FIRST).map(|i| Interval::spanning(width * i as f64, width * (i + 1) as f64)).collect();
        let (mut count, mut least) = (0, f64::INFINITY);
        loop {
            for roll in cells.drain(..) {
                count += 1;
                match bound(roll) {
                    None => {}
                    Some(lower) if enough <= lower => least = least.min(lower),
                    Some(lower) => queue.push(Cell { lower, roll }),
                }
            }
            let Some(Cell { lower, roll }) = queue.pop() else { return least * (1.0 - BOUND) };
            if most < count {
                return lower.min(least) * (1.0 - BOUND);
            }
            cells.extend(roll.halves());
        }
    }

    /// A constant roll is one for all: of every interval the largest bound of the samples that bound.
    fn of_constant(&self, ladder: &Ladder, known: f64) -> Result<f64, MillError> {
        let runs = ladder.runs();
        // For every roll of the grid and every configuration the rung with the largest error, as long as few are enough.
        let mut binding: Vec<Vec<[usize; Configuration::COUNT]>> = vec![Vec::new(); runs.len()];
        for (run, binding) in runs.iter().zip(&mut binding) {
            for roll in (0..ladder.grid.len()).step_by(3) {
                let worst = |c: usize| {
                    let error = |k: &usize| ladder.rungs[*k].errors[c][roll];
                    run.clone().max_by(|a, b| error(a).total_cmp(&error(b))).unwrap_or(run.start)
                };
                let rungs = std::array::from_fn(worst);
                if binding.len() < BINDING && !binding.contains(&rungs) {
                    binding.push(rungs);
                }
            }
        }
        // Of every run and configuration the tips of those rungs.
        let tips = |binding: &Vec<[usize; Configuration::COUNT]>| {
            (0..Configuration::COUNT)
                .map(|c| {
                    let mut rungs: Vec<usize> = Vec::new();
                    for rung in binding.iter().map(|rungs| rungs[c]) {
                        if !rungs.contains(&rung) {
                            rungs.push(rung);
                        }
                    }
                    rungs.into_iter().map(|k| self.tip(&ladder.stations[worst_station(ladder, k, c)?])).collect()
                })
                .collect()
        };
        let tips = binding.iter().map(tips).collect::<Result<Vec<Vec<Vec<Tip<1>>>>, MillError>>()?;
        let bound = |roll: Interval| {
            let mut of_all = 0.0_f64;
            for of_configurations in &tips {
                let mut of_run: Option<f64> = None;
                for (tips, configuration) in of_configurations.iter().zip(Configuration::ALL) {
                    let mut worst = Some(0.0_f64);
                    for tip in tips {
                        worst = worst.zip(self.over(tip, configuration, roll)).map(|(worst, lower)| worst.max(lower));
                        if worst.is_none_or(|worst| known <= worst) {
                            break;
                        }
                    }
                    of_run = of_run.into_iter().chain(worst).reduce(f64::min);
                }
                of_all = of_all.max(of_run?);
            }
            Some(of_all)
        };
        Ok(Self::least(bound, known * (1.0 - ENOUGH), MOST_CONSTANT).min(known))
    }

    /// The tool at a sample, where the part stands.
    pub(super) fn tip(&self, station: &Station) -> Result<Tip<1>, MillError> {
        let pose = self.stand.base_from_part;
        let turn = pose.rotation.to_rotation_matrix();
        let fixed = |v: Vector3<f64>| -> Vector<1> { <[f64; 3]>::from(turn * v).map(Affine::point) };
        let moved =
            |v: Vector3<f64>| -> Vector<1> { <[f64; 3]>::from((pose * Point3::from(v)).coords).map(Affine::point) };
        Tip::new(station, self.question.options.part, moved, fixed)
    }

    /// A lower bound on the error of a sample, m, in a configuration at every roll of an interval; `None` where it is not held there.
    pub(super) fn over(&self, tip: &Tip<1>, configuration: Configuration, roll: Interval) -> Option<f64> {
        let frame = tip.turned(&self.enclosure, sin_cos(roll, 0));
        tip.lower_bound((&self.enclosure, self.wrists_are_alike), &frame, configuration)
    }
}

/// The tool at a sample: what of it is alike at all rolls and in all configurations.
pub(super) struct Tip<const N: usize> {
    at: Vector<N>,
    /// Its axes at roll zero.
    tool: [Vector<N>; 3],
    push: Option<PushEnclosure<N>>,
    /// What a bound is multiplied by, N where it is one per newton.
    factor: f64,
}

impl<const N: usize> Tip<N> {
    /// Where the part stands as `moved` takes its points to the base, and `turned` its directions.
    pub(super) fn new(
        Station { sample, acting, .. }: &Station,
        part: ErrorPart,
        moved: impl Fn(Vector3<f64>) -> Vector<N>,
        turned: impl Fn(Vector3<f64>) -> Vector<N>,
    ) -> Result<Self, MillError> {
        let none = part_from_tool(&sample.pose, 0.0).ok_or(MillError::Roll { line: sample.line })?;
        let tool = [none.rotation * Vector3::x(), none.rotation * Vector3::y(), -sample.pose.axis].map(&turned);
        let pushing = acting.map_or(Pushing::Nothing, |acting| acting.pushing(&cutting_axes(sample), sample, part));
        let (push, factor) = match pushing {
            Pushing::Nothing => (None, 0.0),
            Pushing::Any(newtons) => (None, newtons),
            Pushing::Known(push) => {
                let (force, moment, counted) = (turned(push.force), turned(push.moment), push.counted.map(&turned));
                let sizes = [push.force.norm(), push.moment.norm()];
                (Some(PushEnclosure { force, moment, counted, sizes }), 1.0)
            }
        };
        Ok(Self { at: moved(sample.pose.tip), tool, push, factor })
    }

    /// At the rolls of an interval, by their sine and cosine.
    pub(super) fn turned(&self, enclosure: &ArmEnclosure, (s, c): (Affine<N>, Affine<N>)) -> ToolFrameEnclosure<N> {
        let [x, y, z] = &self.tool;
        let tool = [std::array::from_fn(|i| c * x[i] + s * y[i]), std::array::from_fn(|i| c * y[i] - s * x[i]), *z];
        enclosure.tool_at(self.at, tool, self.push)
    }

    /// A lower bound on the error at these rolls, m; `None` where the sample is not held there.
    pub(super) fn lower_bound(
        &self,
        (enclosure, wrists_are_alike): (&ArmEnclosure, bool),
        frame: &ToolFrameEnclosure<N>,
        configuration: Configuration,
    ) -> Option<f64> {
        let is_flipped = configuration.wrist == Wrist::Flip;
        let wrists = if wrists_are_alike { [true; 2] } else { [!is_flipped, is_flipped] };
        let (lower, wrists) = self.of_wrists(enclosure, frame, configuration.arm(), wrists)?;
        wrists[usize::from(is_flipped)].then_some(lower)
    }

    /// The same of both wrists at once where they are alike.
    pub(super) fn either_wrist(
        &self,
        (enclosure, wrists_are_alike): (&ArmEnclosure, bool),
        frame: &ToolFrameEnclosure<N>,
        configuration: Configuration,
    ) -> Option<f64> {
        if wrists_are_alike {
            return self.of_wrists(enclosure, frame, configuration.arm(), [true; 2]).map(|(lower, _)| lower);
        }
        self.lower_bound((enclosure, false), frame, configuration)
    }

    /// A lower bound, and which of the wrists are possible.
    fn of_wrists(
        &self,
        enclosure: &ArmEnclosure,
        frame: &ToolFrameEnclosure<N>,
        branch: ArmBranch,
        mut wrists: [bool; 2],
    ) -> Option<(f64, [bool; 2])> {
        let mut bounds = NodeBounds::<N>::default();
        enclosure.add_constraints(frame, [0.0; 2], branch, None, &mut wrists, &mut bounds)?;
        Some((bounds.values.iter().map(Affine::min).fold(0.0, f64::max) * self.factor, wrists))
    }
}

/// The station of a rung whose error at its best roll is largest, in a configuration.
fn worst_station(ladder: &Ladder, k: usize, c: usize) -> Result<usize, MillError> {
    let mut errors = std::array::from_fn(|_| Vec::new());
    let mut worst = (f32::NEG_INFINITY, ladder.rungs[k].samples.start);
    if ladder.rungs[k].samples.len() == 1 {
        return Ok(worst.1);
    }
    for i in ladder.rungs[k].samples.clone() {
        ladder.errors_at(i, &ladder.grid, &mut errors)?;
        let least = errors[c].iter().copied().fold(f32::INFINITY, f32::min);
        if worst.0 < least {
            worst = (least, i);
        }
    }
    Ok(worst.1)
}
