//! The best path over a ladder of rolls: exact on its nodes, by one sweep from the first rung to the last.

use std::f64::consts::{PI, TAU};

use super::follow::{Arrangement, LARGEST_TURN};
use super::ladder::{Joints, Ladder, Rung, WINDING};
use crate::parallel;
use crate::watch::{Stopped, Watch};

/// Nodes of the rung before that a node is joined to: so many steps of the roll either way.
pub(super) const MOST_STEPS: usize = 8;
/// Rungs whose joints are computed at a time, on all cores.
const CHUNK: usize = 64;
/// To arrange the arm anew costs as much as turning a joint by a whole turn within a second.
const CHANGE: f64 = TAU * TAU;
/// How far beyond a limit a joint may lie by rounding, rad.
const ROUNDING: f64 = 1e-9;

/// A configuration (its index) and a roll of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    pub(super) configuration: usize,
    pub(super) roll: usize,
}

/// Which of all paths over a ladder is the best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// That whose largest error is least, m.
    LeastError,
    /// That whose joints move least: the sum of squared rates times time.
    LeastMotion,
}

/// Paths over a ladder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Climb<'a, 'l> {
    ladder: &'a Ladder<'l>,
    goal: Goal,
    /// Nodes with a larger error are left aside, m.
    most: f32,
    /// Whole turns of joints 1, 4 and 6 count: each number of them is a node of its own.
    is_wound: bool,
    /// How many numbers of turns of each of these joints there are.
    turns: [usize; 3],
    rolls: usize,
}

/// A rung of which the paths to its nodes are known.
#[derive(Debug, Default)]
struct Reached {
    joints: Joints,
    /// What the best path to each node has; infinite where there is none.
    values: Vec<f64>,
    /// The node before on that path.
    before: Vec<u32>,
    /// The node with the least value.
    best: usize,
}

impl<'a, 'l> Climb<'a, 'l> {
    pub(super) fn new(ladder: &'a Ladder<'l>, goal: Goal, most: f32, is_wound: bool) -> Self {
        let turns = WINDING.map(|joint| {
            let range = ladder.arm.limits.joints[joint];
            if is_wound && range.is_bounded() { (range.width() / TAU).floor() as usize + 1 } else { 1 }
        });
        Self { ladder, goal, most, is_wound, turns, rolls: ladder.grid.len() }
    }

    /// The best path, a node a rung, and what it has; the first rung that no path reaches where there is none.
    pub(super) fn path(&self, watch: Watch) -> Result<Result<(Vec<Node>, f64), usize>, Stopped> {
        let rungs = &self.ladder.rungs;
        let mut way: Vec<(Vec<u32>, usize)> = Vec::with_capacity(rungs.len());
        let mut last = Reached::default();
        for chunk in rungs.chunks(CHUNK) {
            watch.go_on()?;
            let joints: Vec<Joints> = parallel::each(chunk, |rung| self.ladder.joints(rung, self.most));
            for (rung, joints) in chunk.iter().zip(joints) {
                let Some(mut next) = self.reached(&last, (way.len(), rung), joints) else { return Ok(Err(way.len())) };
                way.push((std::mem::take(&mut next.before), next.best));
                last = next;
            }
        }
        let Some(mut at) = way.last().map(|(_, best)| *best) else { return Ok(Ok((Vec::new(), 0.0))) };
        let value = last.values[at];
        let mut path = Vec::with_capacity(way.len());
        for (before, _) in way.iter().rev() {
            let held = at / self.turns.iter().product::<usize>();
            path.push(Node { configuration: held / self.rolls, roll: held % self.rolls });
            at = before[at] as usize;
        }
        path.reverse();
        Ok(Ok((path, value)))
    }

    /// Whether the joints follow from one rung to the next, arranged like this.
    pub(super) fn joins(&self, (k, from): (usize, Arrangement), (next, to): (usize, Arrangement)) -> bool {
        let held = |k: usize, arrangement: Arrangement| {
            let found = self.ladder.postures(self.ladder.rungs[k].at, arrangement.roll);
            found.into_iter().find_map(|(known, q)| (known == arrangement.configuration).then_some(q))
        };
        match (held(k, from), held(next, to)) {
            (Some(from), Some(to)) => {
                self.motion(&from, &to, &self.farthest(self.ladder.rungs[next].time), f64::INFINITY).is_some()
            }
            _ => false,
        }
    }

    /// The best paths to the nodes of a rung; `None` where there is none.
    fn reached(&self, last: &Reached, (k, rung): (usize, &Rung), joints: Joints) -> Option<Reached> {
        let turns = self.turns.iter().product::<usize>();
        let mut values = vec![f64::INFINITY; joints.len() * turns];
        let mut before = vec![0; values.len()];
        let farthest = self.farthest(rung.time);
        for (held, q) in joints.iter().enumerate() {
            let Some(q) = q else { continue };
            let error = f64::from(rung.errors[held / self.rolls][held % self.rolls]);
            for turn in 0..turns {
                if let Some(q) = self.turned(q, turn) {
                    (values[held * turns + turn], before[held * turns + turn]) =
                        self.least((last, &farthest), (k, rung), held, &q, error);
                }
            }
        }
        let (best, least) = values.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
        (*least < f64::INFINITY).then_some(Reached { joints, values, before, best })
    }

    /// The least value with which a node is reached that stands at joints `q` and has an error, and from which node.
    fn least(
        &self,
        (last, farthest): (&Reached, &[f64; 6]),
        (k, rung): (usize, &Rung),
        held: usize,
        q: &[f64; 6],
        error: f64,
    ) -> (f64, u32) {
        let counts_error = self.goal == Goal::LeastError;
        let first = if counts_error { error } else { 0.0 };
        if last.values.is_empty() {
            return (first, 0);
        }
        let mut best = (f64::INFINITY, 0);
        if rung.is_fresh {
            let value = last.values[last.best];
            best = (if counts_error { value.max(error) } else { value + CHANGE }, last.best as u32);
        }
        // Where no time is known, or none passes, the way itself is kept short.
        let time = rung.time.filter(|time| 0.0 < *time).unwrap_or(1.0);
        let (configuration, roll) = (held / self.rolls, held % self.rolls);
        let turns = self.turns.iter().product::<usize>();
        // Less than the least of the rung before no node has.
        let least = last.values[last.best].max(error);
        for step in 0..=2 * MOST_STEPS {
            if counts_error && best.0 <= least {
                break;
            }
            // From no step outwards: 0, 1, -1, 2, -2 ...
            let aside = step.div_ceil(2);
            let roll = (roll + if step % 2 == 0 { self.rolls - aside } else { aside }) % self.rolls;
            let before = configuration * self.rolls + roll;
            let Some(from) = &last.joints[before] else { continue };
            let Some(turn) = self.turn_before(from, q) else { continue };
            let value = last.values[before * turns + turn];
            let at_least = if counts_error { value.max(error) } else { value };
            if !(at_least < best.0) {
                continue;
            }
            // More motion than this is no use; a hair more for rounding.
            let most = if counts_error { f64::INFINITY } else { (best.0 - value) * time * (1.0 + 1e-9) };
            let motion = if turn == 0 {
                self.motion(from, q, farthest, most)
            } else {
                self.turned(from, turn).and_then(|from| self.motion(&from, q, farthest, most))
            };
            let Some(motion) = motion else { continue };
            let value = if counts_error { at_least } else { value + motion / time };
            if value < best.0 && !self.ladder.touching.blocks((k, before, held)) {
                best = (value, (before * turns + turn) as u32);
            }
        }
        best
    }

    /// The joints with so many turns, counted over all three joints; `None` where that is beyond a limit.
    fn turned(&self, q: &[f64; 6], turn: usize) -> Option<[f64; 6]> {
        let [_, second, third] = self.turns;
        let mut q = *q;
        for (joint, turns) in WINDING.into_iter().zip([turn / third / second, turn / third % second, turn % third]) {
            q[joint] += TAU * turns as f64;
            if 0 < turns && !self.ladder.arm.limits.joints[joint].contains(q[joint], ROUNDING) {
                return None;
            }
        }
        Some(q)
    }

    /// With how many turns the joints `from` lie nearest to `q`.
    fn turn_before(&self, from: &[f64; 6], q: &[f64; 6]) -> Option<usize> {
        if self.turns == [1; 3] {
            return Some(0);
        }
        let mut turn = 0;
        for (joint, count) in WINDING.into_iter().zip(self.turns) {
            let turns = if count == 1 { 0.0 } else { ((q[joint] - from[joint]) / TAU).round() };
            if !(0.0 <= turns && turns < count as f64) {
                return None;
            }
            turn = turn * count + turns as usize;
        }
        Some(turn)
    }

    /// How far each joint may turn from one rung to the next, rad: no farther than a line is followed, or than its speed allows.
    fn farthest(&self, time: Option<f64>) -> [f64; 6] {
        let Ladder { speeds, pace, .. } = self.ladder;
        let by_speed = speeds.zip(time).map(|(speeds, time)| speeds.map(|speed| speed * pace * time + ROUNDING));
        by_speed.map_or([LARGEST_TURN; 6], |by_speed| by_speed.map(|turn| turn.min(LARGEST_TURN)))
    }

    /// The sum of the squared turns of the joints, rad^2; `None` where it is more than `most`, or a joint turns farther than it may.
    fn motion(&self, from: &[f64; 6], to: &[f64; 6], farthest: &[f64; 6], most: f64) -> Option<f64> {
        let mut motion = 0.0;
        for joint in 0..6 {
            let mut turn = to[joint] - from[joint];
            if PI < turn.abs() && (!self.is_wound || !self.ladder.arm.limits.joints[joint].is_bounded()) {
                turn -= TAU * (turn / TAU).round();
            }
            if !(turn.abs() <= farthest[joint]) {
                return None;
            }
            motion += turn * turn;
            if most < motion {
                return None;
            }
        }
        Some(motion)
    }
}
