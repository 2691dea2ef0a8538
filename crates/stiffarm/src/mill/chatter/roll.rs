//! Which roll lets a cut go deepest at one sample, what error does it cost, and what becomes of the whole path so rolled?

use std::f64::consts::TAU;

use super::super::arm_with_margins;
use super::super::contact::Bodies;
use super::super::fault::MillError;
use super::super::follow::{Arrangement, Stand, held, pushed};
use super::super::solve::{MillOptions, Question};
use super::super::stations::Station;
use crate::chatter::{Asked, Cut, Edge, by_mean};
use crate::inverse::Configuration;
use crate::modes::HeldTool;
use crate::parallel;
use crate::robot::Robot;
use crate::watch::Watch;

/// Rolls that are looked at: steps of 5 deg.
const ROLLS: usize = 72;

/// The roll with which the cut of one sample goes deepest, in the configuration in which the path is followed there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeepestRoll {
    /// rad.
    pub roll: f64,
    /// From which depth it swings, by the mean of the teeth over a revolution; `None` where no edge does.
    pub edge: Option<Edge>,
    /// The error there, m.
    pub error: f64,
    /// Every sample held so; `None` where the path is not followed with this roll all along.
    pub all_along: Option<AllAlong>,
}

/// A path that is followed with one roll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllAlong {
    /// The sample at which the critical depth is then least in proportion to that of its cut.
    pub sample: usize,
    /// That proportion; infinite where no edge swings.
    pub reserve: f64,
    /// The largest error along the path, m.
    pub error: f64,
}

impl DeepestRoll {
    fn depth(&self) -> f64 {
        self.edge.map_or(f64::INFINITY, |edge| edge.depth)
    }
}

/// Of every roll in steps of 5 deg that keeps the margins and touches nothing; `None` where none does.
pub(super) fn deepest(
    (robot, tool): (&Robot, &HeldTool),
    stand: &Stand,
    (stations, at, configuration): (&[Station], usize, Configuration),
    (cut, asked): (&Cut, &Asked),
    options: &MillOptions,
    watch: Watch,
) -> Result<Option<DeepestRoll>, MillError> {
    let arm = arm_with_margins(robot, stand, options)?;
    let station = &stations[at];
    let guard = Question { robot, arm: &arm, stations, options }.guard(stand, Bodies::Known);
    let looked = |i: usize| {
        watch.go_on()?;
        let roll = TAU * i as f64 / ROLLS as f64;
        let arrangement = Arrangement { configuration, roll };
        let Ok(q) = held(&arm, stand, &station.sample, arrangement)? else { return Ok(None) };
        if let Some(guard) = &guard {
            let theta = guard.theta(station.sample.line, &station.sample.pose, arrangement)?;
            if theta.is_none_or(|theta| guard.touches(&guard.posed(theta, at))) {
                return Ok(None);
            }
        }
        let of_line = |error| MillError::Chatter { line: station.sample.line, error };
        let edge = by_mean(robot, &q, tool, cut, asked).map_err(of_line)?.edge;
        let error = pushed(robot, stand, station, options.part, (arrangement, &q))?.error;
        Ok::<_, MillError>(Some(DeepestRoll { roll, edge, error, all_along: None }))
    };
    let all = parallel::try_each_of(ROLLS, looked)?;
    // Of those that go equally deep the one that errs least.
    let by = |a: &DeepestRoll, b: &DeepestRoll| a.depth().total_cmp(&b.depth()).then(b.error.total_cmp(&a.error));
    Ok(all.into_iter().flatten().max_by(by))
}
