//! Verb 4: which robot holds the force best, for several tasks?

mod standing;

pub use standing::may_be_as_good;
use standing::ranks;
pub use standing::{Contestant, Rank, Standing, order};

use crate::load::Load;
use crate::model::{Model, ModelKind};
use crate::parallel;
use crate::place::{PlaceError, PlaceOptions, Placed, Placement, find, place};
use crate::robot::{Robot, Status};
use crate::task::{Task, Zone};
use crate::watch::Watch;

/// What a ranking knows of one robot and one task: an error where the search did not end ([`PlaceError::Unfinished`]), or the
/// planar model does not hold for the robot ([`PlaceError::is_not_of_the_plane`]).
pub type Cell = Result<Placed, PlaceError>;

/// One robot in a ranking.
#[derive(Clone, Debug)]
pub struct Row {
    /// Which.
    pub robot: Robot,
    /// Over all tasks, as far as the values are proved; `None` for an estimated robot, which stands where its values put it, and for one
    /// that has a place for no task.
    pub rank: Option<Rank>,
    /// One answer per task.
    pub cells: Vec<Cell>,
    /// How much worse than the best robot of each task, as a geometric mean over the tasks it can do; 1 is the best. `None` where
    /// it can do none.
    pub mean_ratio: Option<f64>,
    /// The same of the proved lower bounds: what [`Self::mean_ratio`] is at least, whatever a search has not seen.
    pub mean_ratio_bound: Option<f64>,
    /// Deflection, m, at the stiffest posture the links allow: no placement of any task can have less. `None` where the model knows
    /// no such bound, or does not hold.
    pub floor: Option<f64>,
}

impl Row {
    /// The best place of a task, where there is one.
    pub fn placement(&self, task: usize) -> Option<&Placement> {
        self.cells[task].as_ref().ok()?.feasible()
    }

    /// Deflection of a task at its best place, m; `None` where there is no place, or it is not known.
    pub fn deflection(&self, task: usize) -> Option<f64> {
        self.placement(task).map(|placement| placement.deflection)
    }

    /// What the deflection of a task may be by what is proved, m: the lower bound and the value.
    fn proved(&self, task: usize) -> Option<[f64; 2]> {
        self.placement(task).map(|placement| [placement.lower_bound, placement.deflection])
    }

    /// It takes a rank where it has a place: no number of it is assumed.
    fn is_ranked(&self) -> bool {
        self.robot.status != Status::Estimated
    }

    /// The model has an answer for it, be it that there is no place.
    pub fn is_judged(&self) -> bool {
        self.cells.iter().any(Result::is_ok)
    }

    /// Why the planar model has no answer for this robot, where it has none.
    pub fn why_not_of_the_plane(&self) -> Option<&PlaceError> {
        self.cells.iter().find_map(|cell| cell.as_ref().err().filter(|error| error.is_not_of_the_plane()))
    }
}

/// Robots in order: those that can do more of the tasks first, then by [`Row::mean_ratio`].
#[derive(Clone, Debug)]
pub struct Ranking {
    /// What was asked.
    pub tasks: Vec<Task>,
    /// The cutting force.
    pub load: Load,
    /// The model behind the values.
    pub model: ModelKind,
    /// The best first.
    pub rows: Vec<Row>,
    /// Beside a ranking in space: that of the paper, the same robots and tasks, zones anywhere in the arm plane. None of the robots
    /// need be of the plane.
    pub in_plane: Option<Box<Ranking>>,
}

impl Ranking {
    /// The stiffest robot for a task among those that `filter` lets pass; of equals the one that ranks higher.
    pub fn best(&self, task: usize, filter: impl Fn(&Row) -> bool) -> Option<&Row> {
        self.rows
            .iter()
            .filter(|row| filter(row))
            .filter_map(|row| Some((row.deflection(task)?, row)))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, row)| row)
    }

    /// The same among robots of which no number is assumed.
    pub fn best_published(&self, task: usize) -> Option<&Row> {
        self.best(task, |row| row.robot.status != Status::Estimated)
    }

    /// Those that may be as good at a task as the best of published geometry, in their order: their proved bounds do not lie above its value.
    /// Nobody where it is distinguished.
    pub fn rivals(&self, task: usize) -> Vec<&Row> {
        self.best_published(task).map_or_else(Vec::new, |best| self.rivals_of(best, task))
    }

    /// The same of another than the best.
    pub fn rivals_of(&self, best: &Row, task: usize) -> Vec<&Row> {
        let Some(value) = best.proved(task) else { return Vec::new() };
        let others = self.rows.iter().filter(|row| row.is_ranked() && row.robot != best.robot);
        others.filter(|row| row.proved(task).is_some_and(|other| may_be_as_good(other, value))).collect()
    }

    /// The rank of every row in one task, as [`Row::rank`] is over all of them.
    pub fn ranks(&self, task: usize) -> Vec<Option<Rank>> {
        let proved = |row: &Row| row.proved(task).filter(|_| row.is_ranked());
        ranks(&self.rows.iter().map(proved).collect::<Vec<_>>())
    }

    /// The row of one robot.
    pub fn row_of(&self, robot: &Robot) -> Option<&Row> {
        self.rows.iter().find(|row| row.robot == *robot)
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
    pub error: PlaceError,
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
    shape: &Task<Zone>,
    scales: &[f64],
    (kind, options): (&ModelKind, &PlaceOptions),
    watch: Watch,
) -> Result<Vec<Curve>, RankError> {
    let parts = watch.parts(Some(robots.len() * scales.len()));
    // The outer `None`: not known; the inner: it does not fit.
    let found = |model: &Model, scale: f64| find(model, shape.work.scaled(scale), options, watch.of_part());
    let deflection = |robot: &Robot, model: &Model, scale: f64| match found(model, scale) {
        Ok(placement) => Ok(Some(placement.map(|placement| placement.deflection))),
        Err(PlaceError::Unfinished { .. }) => Ok(None),
        Err(error) => Err(failed(robot, shape, error)),
    };
    let curve = |robot: &Robot| {
        let mut curve = Curve { points: Vec::new(), is_complete: false };
        let model = match kind.of(robot).map_err(PlaceError::from) {
            Err(error) if error.is_not_of_the_plane() => {
                let counted = scales.iter().try_for_each(|_| parts.one_more());
                return counted.map(|()| curve).map_err(|error| failed(robot, shape, error.into()));
            }
            model => model.map_err(|error| failed(robot, shape, error))?,
        };
        for &scale in scales {
            parts.one_more().map_err(|error| failed(robot, shape, error.into()))?;
            if curve.is_complete {
                continue;
            }
            match deflection(robot, &model, scale)? {
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
                match deflection(robot, &model, scale)? {
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
    parallel::try_each(robots, curve)
}

/// Places every task on every robot (\[paper\], section IV) and puts the robots in order.
///
/// The parts of the work are the cells. The order does not depend on the order of `robots`: ties go by name.
///
/// Robots that are not of the plane are rows without values in a planar ranking, and say why.
///
/// ```
/// use stiffarm::catalogue::paper_robots;
/// use stiffarm::load::Load;
/// use stiffarm::model::ModelKind;
/// use stiffarm::place::PlaceOptions;
/// use stiffarm::rank::rank;
/// use stiffarm::task::Task;
/// use stiffarm::watch::Watch;
///
/// let task: Task = "B:0.5".parse()?;
/// let ranking = rank(&paper_robots(), &[task], &ModelKind::Planar, &PlaceOptions::under(Load::PAPER), Watch::nobody())?;
/// let best = ranking.best_published(0).ok_or("some robot holds it")?;
/// assert_eq!(best.robot.name, "KR 210 R2700 extra");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The first robot (in the order given) that makes no sense, and in space one of which only two links are known; the first one
/// where none is of the plane; [`PlaceError::Stopped`] where the work is no longer wanted.
pub fn rank(
    robots: &[Robot],
    tasks: &[Task],
    kind: &ModelKind,
    options: &PlaceOptions,
    watch: Watch,
) -> Result<Ranking, RankError> {
    let ranking = ranked(robots, tasks, kind, options, watch)?;
    match ranking.rows.first().and_then(Row::why_not_of_the_plane) {
        Some(error) if ranking.rows.iter().all(|row| row.why_not_of_the_plane().is_some()) => {
            return Err(failed(&ranking.rows[0].robot, &tasks[0], error.clone()));
        }
        _ => (),
    }
    let in_plane = match kind {
        ModelKind::Planar => None,
        ModelKind::Spatial(_) => {
            // What points along feed, across and axial has no direction in the arm plane.
            let usual = PlaceOptions::under(options.load.in_worst_direction());
            Some(Box::new(ranked(robots, tasks, &ModelKind::Planar, &usual, watch.of_part())?))
        }
    };
    Ok(Ranking { in_plane, ..ranking })
}

fn failed<W>(robot: &Robot, task: &Task<W>, error: PlaceError) -> RankError {
    RankError { robot: robot.name.clone(), task: task.label.clone(), error }
}

/// Judges every robot for every task, and puts the robots in order.
fn ranked(
    robots: &[Robot],
    tasks: &[Task],
    kind: &ModelKind,
    options: &PlaceOptions,
    watch: Watch,
) -> Result<Ranking, RankError> {
    let models: Vec<Result<Model, PlaceError>> =
        robots.iter().map(|robot| kind.of(robot).map_err(PlaceError::from)).collect();
    let pairs: Vec<(usize, &Task)> =
        (0..robots.len()).flat_map(|robot| tasks.iter().map(move |task| (robot, task))).collect();
    let parts = watch.parts(Some(pairs.len()));
    let judge = |(robot, task): &(usize, &Task)| {
        let model = models[*robot].as_ref().map_err(Clone::clone);
        let placed = model.and_then(|model| place(model, &task.work, options, watch.of_part()));
        parts.one_more().map_err(|error| failed(&robots[*robot], task, error.into()))?;
        match placed {
            Err(error) if !error.is_not_of_the_plane() && !matches!(error, PlaceError::Unfinished { .. }) => {
                Err(failed(&robots[*robot], task, error))
            }
            cell => Ok(cell),
        }
    };
    let cells: Vec<Cell> = parallel::try_each(&pairs, judge)?;
    let mut cells = cells.into_iter();
    let rows: Vec<Row> = robots
        .iter()
        .zip(&models)
        .map(|(robot, model)| Row {
            robot: robot.clone(),
            rank: None,
            cells: cells.by_ref().take(tasks.len()).collect(),
            mean_ratio: None,
            mean_ratio_bound: None,
            floor: model
                .as_ref()
                .ok()
                .and_then(Model::floor)
                .filter(|_| options.load.is_worst())
                .map(|floor| floor * options.load.newtons()),
        })
        .collect();
    let contestants: Vec<Contestant> = rows
        .iter()
        .map(|row| Contestant {
            vendor: &row.robot.vendor,
            name: &row.robot.name,
            is_estimated: row.robot.status == Status::Estimated,
            proved: (0..tasks.len()).map(|task| row.proved(task)).collect(),
        })
        .collect();
    let standings = order(&contestants);
    let placed = |Standing { at, rank, mean_ratio, mean_ratio_bound }| Row {
        rank,
        mean_ratio,
        mean_ratio_bound,
        ..rows[at].clone()
    };
    let rows = standings.into_iter().map(placed).collect();
    Ok(Ranking { tasks: tasks.to_vec(), load: options.load, model: *kind, rows, in_plane: None })
}
