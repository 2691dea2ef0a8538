//! What would every other roll have done? A map over the path and the roll, with what forbids the rolls that are none.

use std::f64::consts::TAU;

use super::fault::{MillError, Why};
use super::follow::{Arrangement, Stand, held, pushed};
use super::solve::MillOptions;
use super::stations::Station;
use super::{Followed, arm_with_margins};
use crate::inverse::posture_of;
use crate::parallel;
use crate::robot::Robot;

/// Rolls of a map: steps of 2 deg.
const ROLLS: usize = 180;

/// Every roll at some places of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct RollMap {
    /// Which stations.
    pub stations: Vec<usize>,
    /// rad, from zero in equal steps over a turn.
    pub rolls: Vec<f64>,
    /// By place, then roll.
    pub cells: Vec<Vec<RollCell>>,
}

/// One roll at one place, in the configuration in which the path is followed there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RollCell {
    /// The error, m.
    Error(f64),
    /// Held, and nothing pushes.
    Air,
    /// Out of reach.
    Reach,
    /// A limit with its margin forbids it.
    Limit,
    /// Too near to a straight wrist or arm.
    Singular,
}

/// Every roll at so many places along a path that is followed, one posture after the other.
///
/// # Errors
/// As [`super::mill`].
pub fn roll_map(
    robot: &Robot,
    stand: &Stand,
    stations: &[Station],
    options: &MillOptions,
    (followed, places): (&Followed, usize),
) -> Result<RollMap, MillError> {
    let arm = arm_with_margins(robot, stand, options)?;
    let places = places.clamp(1, stations.len());
    // Evenly along the way, so that a place stands for as much of the path as any other.
    let (first, last) = (stations[0].sample.way, stations[stations.len() - 1].sample.way);
    let at = |n: usize| {
        let way = first + (last - first) * (n as f64 + 0.5) / places as f64;
        stations.partition_point(|station| station.sample.way < way).min(stations.len() - 1)
    };
    let chosen: Vec<usize> = (0..places).map(at).collect();
    let rolls: Vec<f64> = (0..ROLLS).map(|i| TAU * i as f64 / ROLLS as f64).collect();
    let cell = |i: usize, roll: f64| {
        let arrangement = Arrangement { roll, ..followed.samples[i].arrangement };
        Ok(match held(&arm, stand, &stations[i].sample, arrangement)? {
            Ok(_) if stations[i].acting.is_none() => RollCell::Air,
            Ok(q) => RollCell::Error(pushed(robot, stand, &stations[i], options.part, (arrangement, &q))?.error),
            Err(Why::Reach { .. }) => RollCell::Reach,
            Err(_) => {
                let flange = stand.base_from_tool(&stations[i].sample, roll)? * stand.flange_from_tool.inverse();
                let theta = posture_of(&arm.geometry, &flange, arrangement.configuration);
                let is_clear = theta.is_some_and(|theta| arm.clearance <= arm.geometry.singular_margin(&theta));
                if is_clear { RollCell::Limit } else { RollCell::Singular }
            }
        })
    };
    let column = |i: &usize| rolls.iter().map(|roll| cell(*i, *roll)).collect::<Result<Vec<_>, MillError>>();
    let cells = parallel::try_each(&chosen, column)?;
    Ok(RollMap { stations: chosen, rolls, cells })
}
