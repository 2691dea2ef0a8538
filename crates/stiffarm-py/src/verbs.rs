//! The verbs, with the options of the command line.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use stiffarm::advice::{advise, advise_best};
use stiffarm::catalogue::{files, measurements, paper_robots};
use stiffarm::compliance::compliance;
use stiffarm::identify::identify as identified;
use stiffarm::ledger::{self, Printed};
use stiffarm::map::map_watched;
use stiffarm::model::ModelKind;
use stiffarm::place::{PlaceError, PlaceOptions, place_task_watched};
use stiffarm::rank::{Contestant, RankError, Standing};
use stiffarm::robot::Robot as Arms;
use stiffarm::study::study_watched;
use stiffarm::task::{Task, Zone};
use stiffarm::watch::Watch;
use stiffarm_ask::answer::{
    Cell, ColumnKind, CompareAnswer, ComplianceAnswer, IdentifyAnswer, LedgerAnswer, MapAnswer, MeasureAnswer,
    ModesAnswer, PlaceAnswer, RankAnswer, Rows, StudyAnswer, stiffness, words,
};
use stiffarm_ask::request::{self, Request, Verb};

use crate::asked::{Asked, task};
use crate::json::to_python;
use crate::paths::under_process;
use crate::pool::detached;
use crate::refused;
use crate::robot::{Robot, kept, robot as named};
use crate::waiting::Progress;

type Answer<'py> = PyResult<Bound<'py, PyAny>>;
/// An answer, and its rows as columns for data frames.
pub(crate) type WithColumns<'py> = PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)>;

/// A robot's place among those given, its rank and whether that is tied, and its mean ratio.
type Stood = (usize, Option<usize>, Option<bool>, Option<f64>);

/// Names the robot before what is wrong.
pub(crate) fn of<E: ToString>(robot: &Arms) -> impl Fn(E) -> PyErr {
    move |error| refused(format!("{}: {}", robot.name, error.to_string()))
}

/// Rows as columns: numbers as arrays in which NaN stands for what is absent, everything else as lists in which None does.
pub(crate) fn columns<'py>(py: Python<'py>, rows: &Rows) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    for (i, column) in rows.columns().iter().enumerate() {
        let cells = rows.iter().map(|row| row[i].clone());
        match column.kind {
            ColumnKind::Number => {
                let numbers = cells.map(|cell| if let Cell::Number(number) = cell { number } else { f64::NAN });
                columns.set_item(&column.name, PyArray1::from_iter(py, numbers))?;
            }
            ColumnKind::Text | ColumnKind::Truth | ColumnKind::Count => {
                let told: Value = cells.map(|cell| json_of(&cell)).collect();
                columns.set_item(&column.name, to_python(py, &told)?)?;
            }
        }
    }
    Ok(columns)
}

fn json_of(cell: &Cell) -> Value {
    match cell {
        Cell::Absent => Value::Null,
        Cell::Text(text) => json!(text),
        Cell::Truth(truth) => json!(truth),
        Cell::Count(count) => json!(count),
        Cell::Number(number) => json!(number),
    }
}

/// One posture.
#[pyfunction]
pub(crate) fn posture<'py>(py: Python<'py>, robot: &Robot, joints_deg: [f64; 6], asked: Asked) -> Answer<'py> {
    let asked = asked.of(Verb::Compliance)?;
    let robot = &asked.equipped(robot.0.clone()).map_err(refused)?;
    let posture = compliance(robot, &joints_deg.map(f64::to_radians), &asked.held().tool()).map_err(of(robot))?;
    let answer = ComplianceAnswer { robot: robot.clone(), joints_deg, posture, load: asked.posture_load() };
    to_python(py, &answer.json())
}

/// How an arm swings at one posture: the answer, and a row a mode.
#[pyfunction]
pub(crate) fn modes<'py>(py: Python<'py>, robot: &Robot, joints_deg: [f64; 6], asked: Asked) -> WithColumns<'py> {
    let asked = asked.of(Verb::Modes)?;
    let robot = &asked.equipped(robot.0.clone()).map_err(refused)?;
    let (tool, damping) = (asked.held_tool().map_err(refused)?, asked.damping());
    let swing = stiffarm::modes::modes(robot, &joints_deg.map(f64::to_radians), &tool, damping).map_err(of(robot))?;
    let answer = ModesAnswer { robot: robot.clone(), joints_deg, tool, damping, count: asked.mode_count(), swing };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// The best place of one zone, with what its tolerance says of force, stiffness and size where that is wanted.
#[pyfunction]
#[pyo3(signature = (robot, wanted_task, asked, advice, progress=None))]
pub(crate) fn place<'py>(
    py: Python<'py>,
    robot: &Robot,
    wanted_task: &str,
    asked: Asked,
    advice: bool,
    progress: Progress,
) -> WithColumns<'py> {
    let asked = asked.with(Verb::Place, &[("task", wanted_task)])?;
    let question = Question::of(&asked, robot.0.clone())?;
    let answer = detached(py, &progress, |watch| question.answer(advice, watch))?.map_err(of(&question.robot))?;
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// What is asked of one placement.
struct Question {
    robot: Arms,
    task: Task,
    kind: ModelKind,
    options: PlaceOptions,
    tolerance_mm: Option<f64>,
}

impl Question {
    fn of(asked: &Request, robot: Arms) -> PyResult<Self> {
        let (robot, task) = (asked.equipped(robot).map_err(refused)?, asked.task().map_err(refused)?);
        let options = under_process(asked.clone())?.place_options(Some(task.zone)).map_err(refused)?;
        Ok(Self { robot, task, kind: asked.model(), options, tolerance_mm: asked.tolerance_mm() })
    }

    /// The placement, with what its tolerance says of force, stiffness and size where that is wanted.
    fn answer(&self, with_advice: bool, watch: Watch) -> Result<PlaceAnswer, PlaceError> {
        let Self { robot, task, kind, options, tolerance_mm } = self;
        let model = kind.of(robot)?;
        let placed = place_task_watched(&model, task, options, watch)?;
        let sought = tolerance_mm.filter(|_| with_advice);
        let advice = sought.map(|mm| advise(&model, task, options, &placed, mm / 1e3, watch)).transpose()?;
        Ok(PlaceAnswer {
            robot: robot.clone(),
            model: *kind,
            task: task.clone(),
            options: *options,
            placed,
            tolerance_mm: *tolerance_mm,
            advice,
        })
    }
}

/// One of two that are compared.
#[derive(FromPyObject)]
pub(crate) enum Setup<'py> {
    Robot(PyRef<'py, Robot>),
    /// A name, or the path of a robot file or of a job file.
    Named(String),
}

impl Setup<'_> {
    fn name(&self) -> &str {
        match self {
            Self::Robot(robot) => &robot.0.name,
            Self::Named(name) => name,
        }
    }

    fn question(&self, both: &Request) -> PyResult<Question> {
        match self {
            Self::Robot(robot) => Question::of(&both.of_robot(&robot.0.name).map_err(refused)?, robot.0.clone()),
            Self::Named(name) => {
                let asked = both.of_setup(name).map_err(refused)?;
                let robot = named(&asked.robot().map_err(refused)?)?;
                Question::of(&asked, robot.0)
            }
        }
    }
}

/// Two setups side by side.
#[pyfunction]
#[pyo3(signature = (a, b, asked, progress=None))]
pub(crate) fn compare<'py>(
    py: Python<'py>,
    a: Setup<'py>,
    b: Setup<'py>,
    asked: Asked,
    progress: Progress,
) -> WithColumns<'py> {
    let both = asked.with(Verb::Compare, &[("a", a.name()), ("b", b.name())])?;
    let (first, second) = (a.question(&both)?, b.question(&both)?);
    let (one, other) = detached(py, &progress, |watch| (first.answer(true, watch), second.answer(true, watch)))?;
    let sides = [one.map_err(of(&first.robot))?, other.map_err(of(&second.robot))?];
    let answer = CompareAnswer { sides };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// The tasks of which no other before them has the zone.
#[pyfunction]
pub(crate) fn distinct(tasks: Vec<String>) -> PyResult<Vec<String>> {
    let tasks: Vec<Task> = tasks.iter().map(|text| task(text)).collect::<PyResult<_>>()?;
    Ok(request::distinct(&tasks).into_iter().map(|task| task.label).collect())
}

/// Robots in order.
#[pyfunction]
#[pyo3(signature = (robots, tasks, asked, progress=None))]
pub(crate) fn rank<'py>(
    py: Python<'py>,
    robots: Vec<PyRef<'py, Robot>>,
    tasks: Vec<String>,
    asked: Asked,
    progress: Progress,
) -> WithColumns<'py> {
    let robots: Vec<Arms> = robots.iter().map(|robot| robot.0.clone()).collect();
    let tasks = tasks.iter().map(|text| ("tasks", text.as_str()));
    // The paper's robots are those that are meant where none are named.
    let others = robots.iter().filter(|_| robots != paper_robots()).map(|robot| ("robots", robot.name.as_str()));
    let asked = asked.with(Verb::Rank, &tasks.chain(others).collect::<Vec<_>>())?;
    let robots = kept(robots, &asked, Vec::new())?;
    let robots: Vec<Arms> =
        robots.into_iter().map(|robot| asked.equipped(robot)).collect::<Result<_, _>>().map_err(refused)?;
    let (kind, tasks, tolerance_mm) = (asked.model(), request::distinct(&asked.tasks()), asked.tolerance_mm());
    if tasks.is_empty() {
        return Err(refused("no task to rank for; give tasks"));
    }
    let only = if let [task] = tasks.as_slice() { Some(task.zone) } else { None };
    let options = under_process(asked.clone())?.place_options(only).map_err(refused)?;
    let found = detached(py, &progress, |watch| {
        let ranking = stiffarm::rank::rank(&robots, &tasks, &kind, &options, watch)?;
        let advice = tolerance_mm.map(|mm| advise_best(&ranking, &options, mm / 1e3, watch)).transpose()?;
        Ok::<_, RankError>((ranking, advice.unwrap_or_default()))
    })?;
    let (ranking, advice) = found.map_err(refused)?;
    let answer = RankAnswer::of(ranking, options, tolerance_mm, advice);
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// The order of robots by their lower bounds and values: their places among those given, with rank and mean ratio.
#[pyfunction]
pub(crate) fn order(
    robots: Vec<(String, String, bool, bool)>,
    proved_mm: Vec<Vec<Option<[f64; 2]>>>,
) -> PyResult<Vec<Stood>> {
    if robots.len() != proved_mm.len() {
        return Err(refused(format!("{} robots, but values of {}", robots.len(), proved_mm.len())));
    }
    let contestants: Vec<Contestant> = robots
        .iter()
        .zip(proved_mm)
        .map(|((vendor, name, is_estimated, is_judged), values)| Contestant {
            vendor,
            name,
            is_estimated: *is_estimated,
            is_judged: *is_judged,
            proved: values.into_iter().map(|mm| mm.map(|ends| ends.map(|mm| mm / 1e3))).collect(),
        })
        .collect();
    let standings = stiffarm::rank::order(&contestants).into_iter();
    let told = |Standing { at, rank, mean_ratio, .. }: Standing| {
        (at, rank.map(|rank| rank.place), rank.map(|rank| rank.is_tied), mean_ratio)
    };
    Ok(standings.map(told).collect())
}

/// A map: its head, its layers by key, and what a figure shows besides.
#[pyfunction]
#[pyo3(signature = (robot, asked, progress=None))]
pub(crate) fn map<'py>(
    py: Python<'py>,
    robot: &Robot,
    asked: Asked,
    progress: Progress,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let asked = asked.of(Verb::Map)?;
    let robot = &asked.equipped(robot.0.clone()).map_err(refused)?;
    let (kind, zone, options) = (asked.model(), asked.zone(), asked.map_options());
    let placing = zone.as_ref().map(|task| asked.place_options(Some(task.zone)).map_err(refused)).transpose()?;
    let answer = detached(py, &progress, |watch| {
        let model = kind.of(robot).map_err(of(robot))?;
        let map = map_watched(&model, &options, watch).map_err(of(robot))?;
        let zone = match zone.zip(placing) {
            None => None,
            Some((task, options)) => {
                let placed = place_task_watched(&model, &task.zone.into(), &options, watch).map_err(of(robot))?;
                let robot = robot.clone();
                Some(PlaceAnswer { robot, model: kind, task, options, placed, tolerance_mm: None, advice: None })
            }
        };
        Ok::<_, PyErr>(MapAnswer { model, options, map, zone })
    })??;
    handed_over(py, &answer)
}

/// The links that are drawn, seen from the side: ahead and up; at the worst point of the zone, or at the stiffest point.
fn links(answer: &MapAnswer) -> Option<Vec<[f64; 2]>> {
    let points = answer.model.points(&answer.posture()?)?;
    Some(points.into_iter().map(|[x, _, z]| [x, z]).collect())
}

fn handed_over<'py>(
    py: Python<'py>,
    answer: &MapAnswer,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let grid = &answer.map.deflection;
    let layers = PyDict::new(py);
    for layer in answer.layers() {
        let cells: Bound<PyArray2<f64>> =
            PyArray1::from_vec(py, layer.cells()).reshape([grid.z.count, grid.x.count])?;
        layers.set_item(layer.field.key, cells)?;
    }
    let robot = answer.model.robot();
    let sides = answer.zone.as_ref().map(|zone| zone.task.zone);
    let shown = json!({
        "title": robot.full_name(),
        "subtitle": format!("{}; {}", words::class(robot), stiffness(robot)),
        "arm_m": links(answer),
        "knows_base": answer.model.knows_base(),
        "zone_sides_m": sides.map(Zone::sides),
        "zone_is_circle": sides.map(|zone| matches!(zone, Zone::Circle { .. })),
    });
    Ok((to_python(py, &answer.head_json())?, layers, to_python(py, &shown)?))
}

/// Architecture against link ratio and size.
#[pyfunction]
#[pyo3(signature = (robot, asked, progress=None))]
pub(crate) fn study<'py>(py: Python<'py>, robot: Option<&Robot>, asked: Asked, progress: Progress) -> WithColumns<'py> {
    let marked: Vec<(&str, &str)> = robot.iter().map(|robot| ("robot", robot.0.name.as_str())).collect();
    let options = asked.with(Verb::Study, &marked)?.study(robot.map(|robot| &robot.0)).map_err(refused)?;
    let answer = StudyAnswer(detached(py, &progress, |watch| study_watched(&options, watch))?.map_err(refused)?);
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// Stiffness from measurements: the answer, its columns, and the robot file. The text is read from the file of that name where there is none.
#[pyfunction]
#[pyo3(signature = (name, text, robot, asked, progress=None))]
pub(crate) fn identify<'py>(
    py: Python<'py>,
    name: String,
    text: Option<String>,
    robot: &Robot,
    asked: Asked,
    progress: Progress,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, String)> {
    let asked = asked.with(Verb::Identify, &[("data", &name), ("robot", &robot.0.name)])?;
    let text = match text {
        Some(text) => text,
        None => files::text(name.as_ref()).map_err(refused)?,
    };
    let name = files::shown(name.as_ref());
    let measured = measurements::read(&text, &name, &asked.points()).map_err(refused)?;
    let options = asked.identification();
    let found = detached(py, &progress, |watch| identified(&robot.0, &measured, &options, watch))?;
    let found = found.map_err(of(&robot.0))?;
    let answer = IdentifyAnswer { found, before: robot.0.clone(), data: name, date: options.date };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?, answer.robot_file()))
}

/// A plan of measurements: the answer, and the table to be filled in.
#[pyfunction]
#[pyo3(signature = (robot, asked, progress=None))]
pub(crate) fn measure<'py>(py: Python<'py>, robot: &Robot, asked: Asked, progress: Progress) -> WithColumns<'py> {
    let asked = asked.with(Verb::Measure, &[("robot", &robot.0.name)])?;
    let robot = &asked.equipped(robot.0.clone()).map_err(refused)?;
    let mut options = asked.measurement_plan();
    let own = asked.compared().map(|name| {
        let text = files::text(name.as_ref()).map_err(refused)?;
        let name = files::shown(name.as_ref());
        let planned = measurements::read_planned(&text, &name, &asked.points()).map_err(refused)?;
        Ok::<_, PyErr>((name, stiffarm::measure::own(&planned)))
    });
    let own = own.transpose()?;
    let task = if asked.is_given("task") { Some(asked.task().map_err(refused)?) } else { None };
    let tool = asked.held().tool();
    let answer = detached(py, &progress, |watch| {
        let mut work = "anywhere within the limits".to_owned();
        if let Some(task) = task {
            work = format!("{} at its best place, tool down", task.label);
            options.work = stiffarm::measure::over(robot, &tool, task.zone, watch).map_err(of(robot))?;
        }
        let plan = stiffarm::measure::plan(robot, &options, watch).map_err(of(robot))?;
        let compared = match own {
            None => None,
            Some((name, runs)) => {
                let found = stiffarm::measure::compare(robot, &options, &runs, watch);
                let (value, efficiency) = found.map_err(of(robot))?;
                Some((name, runs.len(), value, efficiency))
            }
        };
        Ok::<_, PyErr>(MeasureAnswer { robot: robot.clone(), options, work, plan, compared })
    })??;
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// The published numbers beside the computed ones.
#[pyfunction]
#[pyo3(signature = (progress = None))]
pub(crate) fn validate(py: Python, progress: Progress) -> WithColumns {
    let found = detached(py, &progress, |_| ledger::validate(&Printed::PAPER))?;
    let answer = LedgerAnswer(found.map_err(refused)?);
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}
