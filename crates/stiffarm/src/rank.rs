//! Verb 4: which robot holds the force best, for several tasks?

use rayon::prelude::*;

use crate::place::{
    NOTHING, PlaceError, PlaceOptions, Placed, Placement, SpatialOptions, SpatialPlaceError, SpatiallyPlaced,
    find_robot, place_in_space, place_robot,
};
use crate::robot::{Robot, Status};
use crate::task::Task;

/// What a ranking knows of one robot and one task.
pub trait Cell {
    /// Deflection at the best place, m; `None` where there is no place, or it is not known.
    fn deflection(&self) -> Option<f64>;

    /// It is known whether there is a place.
    fn is_judged(&self) -> bool {
        true
    }
}

/// In the planar model: an error where the search did not end ([`PlaceError::Unfinished`]), or the model does not hold for
/// the robot ([`is_not_of_the_plane`]).
pub type PlanarCell = Result<Placed, PlaceError>;

impl Cell for PlanarCell {
    fn deflection(&self) -> Option<f64> {
        self.as_ref().ok()?.feasible().map(|placement| placement.deflection)
    }

    fn is_judged(&self) -> bool {
        self.is_ok()
    }
}

/// The robot is sound, but the planar model has no answer for it: a compensator, an unusual coupling, or rigid drives 2
/// and 3.
pub fn is_not_of_the_plane(error: &PlaceError) -> bool {
    matches!(error, PlaceError::NoArmPlane(_))
}

impl Cell for SpatiallyPlaced {
    fn deflection(&self) -> Option<f64> {
        self.feasible().map(|placement| placement.deflection)
    }
}

/// One robot in a ranking.
#[derive(Clone, Debug)]
pub struct Row<C = PlanarCell> {
    /// Which.
    pub robot: Robot,
    /// One answer per task.
    pub cells: Vec<C>,
    /// How much worse than the best robot of each task, as a geometric mean over the tasks it can do; 1 is the best.
    pub score: f64,
}

impl<C: Cell> Row<C> {
    /// How many tasks have no place, or none that is known.
    pub fn misfits(&self) -> usize {
        self.cells.iter().filter(|cell| cell.deflection().is_none()).count()
    }

    /// Deflection of a task, m.
    pub fn deflection(&self, task: usize) -> Option<f64> {
        self.cells[task].deflection()
    }
}

impl Row {
    /// Deflection, m, under a force, N, at the stiffest posture the links allow: no placement of any task can have less.
    /// `None` where the planar model has no answer.
    pub fn floor(&self, force: f64) -> Option<f64> {
        self.robot.arm_plane().ok().map(|plane| plane.arm.radial().floor() * force)
    }

    /// Why the planar model has no answer for this robot, where it has none.
    pub fn why_not_of_the_plane(&self) -> Option<&PlaceError> {
        self.cells.iter().find_map(|cell| cell.as_ref().err().filter(|error| is_not_of_the_plane(error)))
    }

    /// The best place of a task, where there is one.
    pub fn placement(&self, task: usize) -> Option<&Placement> {
        self.cells[task].as_ref().ok()?.feasible()
    }
}

/// Robots in order: those that can do more of the tasks first, then by [`Row::score`].
#[derive(Clone, Debug)]
pub struct Ranking<C = PlanarCell> {
    /// What was asked.
    pub tasks: Vec<Task>,
    /// Cutting force, N.
    pub force: f64,
    /// The best first.
    pub rows: Vec<Row<C>>,
}

impl<C: Cell> Ranking<C> {
    /// The stiffest robot for a task among those that `filter` lets pass; of equals the one that ranks higher.
    pub fn best(&self, task: usize, filter: impl Fn(&Robot) -> bool) -> Option<&Row<C>> {
        self.rows
            .iter()
            .filter(|row| filter(&row.robot))
            .filter_map(|row| Some((row.deflection(task)?, row)))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, row)| row)
    }

    /// The same among robots of which no number is assumed.
    pub fn best_published(&self, task: usize) -> Option<&Row<C>> {
        self.best(task, |robot| robot.status != Status::Estimated)
    }
}

impl<C: Cell> Ranking<C> {
    /// Places from 1, row by row: an estimated robot stands where its values put it, but takes none, nor does one of which
    /// nothing is known.
    pub fn places(&self) -> Vec<Option<usize>> {
        let mut place = 0;
        let mut next = |row: &Row<C>| {
            let is_known = row.cells.iter().any(Cell::is_judged);
            (is_known && row.robot.status != Status::Estimated).then(|| {
                place += 1;
                place
            })
        };
        self.rows.iter().map(&mut next).collect()
    }

    /// The place of one robot.
    pub fn place_of(&self, robot: &Robot) -> Option<usize> {
        let at = self.rows.iter().position(|row| row.robot == *robot)?;
        self.places()[at]
    }
}

/// A robot or task that could not be judged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{robot}, task {task}: {error}")]
pub struct RankError {
    /// Which robot.
    pub robot: String,
    /// Which task.
    pub task: String,
    /// Why.
    pub error: SpatialPlaceError,
}

/// How the deflection of one robot grows with the size of a zone.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Scale and deflection, m, in order of scale.
    pub points: Vec<(f64, f64)>,
    /// The last point is the largest zone that fits, to 1e-4.
    pub is_complete: bool,
}

/// Deflection of a zone at ascending scales for every robot, in their order; the last point where the zone stops fitting.
/// A scale of which the search does not end has no point, and a robot that is not of the plane has none at all.
///
/// # Errors
/// As [`rank`].
pub fn curves(
    robots: &[Robot],
    shape: &Task,
    scales: &[f64],
    options: &PlaceOptions,
    done: impl Fn() + Sync,
) -> Result<Vec<Curve>, RankError> {
    // The outer `None`: not known; the inner: it does not fit.
    let deflection = |robot: &Robot, scale: f64| match find_robot(robot, shape.zone.scaled(scale), options) {
        Ok(placement) => Ok(Some(placement.map(|placement| placement.deflection))),
        Err(PlaceError::Unfinished { .. }) => Ok(None),
        Err(error) if is_not_of_the_plane(&error) => Ok(None),
        Err(error) => Err(RankError { robot: robot.name.clone(), task: shape.label.clone(), error: error.into() }),
    };
    let curve = |robot: &Robot| {
        let mut curve = Curve { points: Vec::new(), is_complete: false };
        for &scale in scales {
            done();
            if curve.is_complete {
                continue;
            }
            match deflection(robot, scale)? {
                None => continue,
                Some(Some(value)) => {
                    curve.points.push((scale, value));
                    continue;
                }
                Some(None) => curve.is_complete = true,
            }
            let (mut fit, mut misfit) = (curve.points.last().map_or(0.0, |point| point.0), scale);
            while 1e-4 * misfit < misfit - fit {
                let scale = f64::midpoint(fit, misfit);
                match deflection(robot, scale)? {
                    Some(Some(value)) => {
                        curve.points.retain(|point| scales.contains(&point.0));
                        curve.points.push((scale, value));
                        fit = scale;
                    }
                    Some(None) => misfit = scale,
                    None => return Ok(Curve { is_complete: false, ..curve }),
                }
            }
        }
        Ok(curve)
    };
    robots.par_iter().with_max_len(1).map(curve).collect()
}

/// Places every task on every robot (\[paper\], section IV) and puts the robots in order.
///
/// `options.within` counts from each robot's base. `done` is called once per cell, from any thread. The order does not
/// depend on the order of `robots`: ties go by name.
///
/// Robots that are not of the plane are rows without values, and say why.
///
/// # Errors
/// The first robot (in the order given) that makes no sense; the first one where none is of the plane.
pub fn rank(
    robots: &[Robot],
    tasks: &[Task],
    options: &PlaceOptions,
    done: impl Fn() + Sync,
) -> Result<Ranking, RankError> {
    let ranking = ranked_in_plane(robots, tasks, options, done)?;
    match ranking.rows.first().and_then(Row::why_not_of_the_plane) {
        Some(error) if ranking.rows.iter().all(|row| row.why_not_of_the_plane().is_some()) => Err(RankError {
            robot: ranking.rows[0].robot.name.clone(),
            task: tasks[0].label.clone(),
            error: error.clone().into(),
        }),
        _ => Ok(ranking),
    }
}

fn ranked_in_plane(
    robots: &[Robot],
    tasks: &[Task],
    options: &PlaceOptions,
    done: impl Fn() + Sync,
) -> Result<Ranking, RankError> {
    ranked(robots, tasks, options.force, done, |robot, task| match place_robot(robot, task.zone, options) {
        Err(error) if !is_not_of_the_plane(&error) && !matches!(error, PlaceError::Unfinished { .. }) => {
            Err(error.into())
        }
        placed => Ok(placed),
    })
}

/// The ranking of the paper, zones anywhere in the arm plane: what stands beside a ranking in space. None of the robots need
/// be of the plane.
///
/// # Errors
/// As [`rank`].
pub fn rank_in_plane(robots: &[Robot], tasks: &[Task], force: f64) -> Result<Ranking, RankError> {
    ranked_in_plane(robots, tasks, &PlaceOptions::paper(force), || ())
}

/// The same in space: all six drives, flat zones about the robot ([`place_in_space`]).
///
/// # Errors
/// As [`rank`]; a planar robot cannot be judged.
pub fn rank_in_space(
    robots: &[Robot],
    tasks: &[Task],
    options: &SpatialOptions,
    done: impl Fn() + Sync,
) -> Result<Ranking<SpatiallyPlaced>, RankError> {
    ranked(robots, tasks, options.force, done, |robot, task| place_in_space(robot, task.zone, options))
}

/// How much worse than the best; 1 for two robots of which neither gives way.
fn ratio(deflection: f64, best: f64) -> f64 {
    deflection.max(NOTHING) / best.max(NOTHING)
}

/// Judges every robot for every task, and puts the robots in order.
fn ranked<C: Cell + Send>(
    robots: &[Robot],
    tasks: &[Task],
    force: f64,
    done: impl Fn() + Sync,
    judge: impl Fn(&Robot, &Task) -> Result<C, SpatialPlaceError> + Sync,
) -> Result<Ranking<C>, RankError> {
    let pairs: Vec<(&Robot, &Task)> =
        robots.iter().flat_map(|robot| tasks.iter().map(move |task| (robot, task))).collect();
    let cells: Vec<C> = pairs
        .par_iter()
        .with_max_len(1)
        .map(|(robot, task)| {
            let judged = judge(robot, task);
            done();
            judged.map_err(|error| RankError { robot: robot.name.clone(), task: task.label.clone(), error })
        })
        .collect::<Result<_, _>>()?;
    let mut cells = cells.into_iter();
    let mut rows: Vec<Row<C>> = robots
        .iter()
        .map(|robot| Row {
            robot: robot.clone(),
            cells: cells.by_ref().take(tasks.len()).collect(),
            score: f64::INFINITY,
        })
        .collect();
    let best: Vec<f64> = (0..tasks.len())
        .map(|task| rows.iter().filter_map(|row| row.deflection(task)).fold(f64::INFINITY, f64::min))
        .collect();
    for row in &mut rows {
        let ratios: Vec<f64> =
            (0..tasks.len()).filter_map(|task| Some(ratio(row.deflection(task)?, best[task]).ln())).collect();
        if !ratios.is_empty() {
            row.score = (ratios.iter().sum::<f64>() / ratios.len() as f64).exp();
        }
    }
    rows.sort_by(|a, b| {
        let names = || (&a.robot.vendor, &a.robot.name).cmp(&(&b.robot.vendor, &b.robot.name));
        a.misfits().cmp(&b.misfits()).then(a.score.total_cmp(&b.score)).then_with(names)
    });
    Ok(Ranking { tasks: tasks.to_vec(), force, rows })
}
