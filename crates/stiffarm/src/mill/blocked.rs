//! Where and why does no path lead over a ladder?

use super::climb::{Climb, Goal};
use super::fault::{Blocked, MillError, Why};
use super::follow::{Arrangement, Pushed, held};
use super::ladder::Ladder;
use crate::interval::Interval;
use crate::inverse::{Configuration, postures, within_limits};
use crate::watch::Watch;

/// By so much more than its speed allows a joint may turn from sample to sample by rounding, rad.
const ROUNDING: f64 = 1e-6;

impl Ladder<'_> {
    /// The sample to which a joint turns fastest, where that is faster than is allowed, and how many times as fast.
    pub(super) fn too_fast(&self, found: &[Pushed]) -> Option<(usize, f64)> {
        let speeds = self.speeds?;
        let times = |i: usize| {
            let time = self.stations[i].time.filter(|_| !self.stations[i].is_fresh)?;
            let turn = |joint: usize| (found[i].joints[joint] - found[i - 1].joints[joint]).abs() - ROUNDING;
            let times = (0..6).map(|joint| turn(joint).max(0.0) / (speeds[joint] * time).max(f64::MIN_POSITIVE));
            Some((i, times.fold(0.0, f64::max)))
        };
        let fastest = (1..found.len()).filter_map(times).max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(fastest).filter(|(_, times)| 1.0 < *times)
    }

    /// Why no path leads to a rung.
    pub(super) fn why_blocked(&self, k: usize, watch: Watch) -> Result<Blocked, MillError> {
        let rung = &self.rungs[k];
        if rung.errors.iter().flatten().all(|error| *error == f32::INFINITY) {
            if rung.pinned.is_some() && !self.is_never_held(rung.at)? {
                return Ok(self.blocked_at(rung.at, Why::Pinned));
            }
            return Ok(self.worst_blocked()?.unwrap_or_else(|| self.blocked_at(rung.samples.start, Why::Jump)));
        }
        let slow = Ladder { speeds: None, ..self.clone() };
        let climb = Climb::new(&slow, Goal::LeastError, f32::MAX, false);
        let is_fast = self.speeds.is_some() && climb.path(watch)?.is_ok();
        Ok(self.blocked_at(rung.samples.start, if is_fast { Why::Fast } else { Why::Jump }))
    }

    /// The first sample that no posture holds at any roll, and how many they are; `None` where each is held.
    fn worst_blocked(&self) -> Result<Option<Blocked>, MillError> {
        let (mut first, mut count) = (None, 0);
        for i in 0..self.stations.len() {
            if self.is_never_held(i)? {
                count += 1;
                first = first.or(Some(i));
            }
        }
        let Some(first) = first else { return Ok(None) };
        let why = self.why_not_held(first)?;
        Ok(Some(Blocked { samples: count, ..self.blocked_at(first, why) }))
    }

    /// No posture holds a sample at any roll of the grid.
    fn is_never_held(&self, i: usize) -> Result<bool, MillError> {
        let mut errors = std::array::from_fn(|_| Vec::new());
        self.errors_at(i, &self.grid, &mut errors)?;
        Ok(errors.iter().flatten().all(|error| *error == f32::INFINITY))
    }

    /// Why no roll is held all along: a sample that none holds, else the one at which that roll ends which is held the farthest.
    pub(super) fn never_held(&self) -> Result<Blocked, MillError> {
        if let Some(blocked) = self.worst_blocked()? {
            return Ok(blocked);
        }
        let ends = (0..self.grid.len()).filter_map(|roll| Some((self.end_of(roll)?, roll)));
        let Some(((k, configuration), roll)) = ends.max_by_key(|((k, _), _)| *k) else {
            return Ok(self.blocked_at(0, Why::Jump));
        };
        // Another posture holds its sample: the arm would have to jump there.
        let arrangement = Arrangement { configuration, roll: self.grid.roll(roll) };
        for i in self.rungs[k].samples.clone() {
            if held(self.arm, &self.stand, &self.stations[i].sample, arrangement)?.is_err() {
                return Ok(self.blocked_at(i, Why::Jump));
            }
        }
        Ok(self.blocked_at(self.rungs[k].samples.start, Why::Jump))
    }

    /// The first rung that a roll of the grid does not hold in the configuration that holds its run the farthest; `None` where all are held.
    fn end_of(&self, roll: usize) -> Option<(usize, Configuration)> {
        self.runs().into_iter().find_map(|run| {
            let is_held = |k: usize, c: usize| self.rungs[k].errors[c][roll] < f32::INFINITY;
            let end = |c: usize| run.clone().find(|k| !is_held(*k, c)).unwrap_or(run.end);
            let farthest = (0..Configuration::COUNT).max_by_key(|c| end(*c))?;
            (end(farthest) < run.end).then(|| (end(farthest), Configuration::ALL[farthest]))
        })
    }

    /// What is said of a path that touches something, until it is searched again with all that touches.
    pub(super) fn touches(&self) -> Blocked {
        self.blocked_at(0, Why::Jump)
    }

    pub(super) fn blocked_at(&self, i: usize, why: Why) -> Blocked {
        self.stand.blocked(&self.stations[i].sample, why)
    }

    /// What forbids a sample at every roll.
    fn why_not_held(&self, i: usize) -> Result<Why, MillError> {
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let (mut beyond, mut is_reached, mut forbidding) = (f64::INFINITY, false, [0; 6]);
        for roll in 0..self.grid.len() {
            let tool = self.stand.base_from_tool(&self.stations[i].sample, self.grid.roll(roll))?;
            let flange = tool * self.arm.flange_from_tool.inverse();
            let found = postures(geometry, &flange).found;
            is_reached |= !found.is_empty();
            if found.is_empty() {
                beyond = beyond.min(geometry.beyond(&flange));
            }
            for (_, theta) in &found {
                // A joint forbids a posture alone where the others allow it.
                for (joint, count) in forbidding.iter_mut().enumerate() {
                    let mut freed = limits.clone();
                    freed.joints[joint] = Interval::ALL;
                    if within_limits(geometry, limits, theta).is_none()
                        && within_limits(geometry, &freed, theta).is_some()
                    {
                        *count += 1;
                    }
                }
            }
        }
        if !is_reached {
            return Ok(Why::Reach { beyond });
        }
        let most = (0..6).max_by_key(|joint| forbidding[*joint]).filter(|joint| 0 < forbidding[*joint]);
        Ok(most.map_or(Why::Narrow, |joint| Why::Limit { joint: joint + 1 }))
    }
}
