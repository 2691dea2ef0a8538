//! The verbs, with the options of the command line.

use nalgebra::Vector3;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use stiffarm::answer::{Cell, ColumnKind, ComplianceAnswer, MapAnswer, PlaceAnswer, RankAnswer, Rows, StudyAnswer};
use stiffarm::compliance::compliance;
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::load::{Component, Load};
use stiffarm::map::{Extent, Held, MapOptions, Posture, Spacing};
use stiffarm::model::{Model, ModelKind};
use stiffarm::place::Hold;
use stiffarm::question::{self, Angle, degrees, number, shape};
use stiffarm::robot::Robot as Arms;
use stiffarm::study::{Contender, StudyOptions, study as studied};
use stiffarm::task::{Task, Zone};

use crate::asked::{Asked, task};
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::robot::Robot;

type Answer<'py> = PyResult<Bound<'py, PyAny>>;
/// An answer, and its rows as columns for data frames.
type WithColumns<'py> = PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)>;

/// Names the robot before what is wrong.
fn of<E: ToString>(robot: &Arms) -> impl Fn(E) -> PyErr {
    move |error| refused(format!("{}: {}", robot.name, error.to_string()))
}

/// Rows as columns: numbers as arrays in which NaN stands for what is absent, everything else as lists in which None does.
fn columns<'py>(py: Python<'py>, rows: &Rows) -> PyResult<Bound<'py, PyDict>> {
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
pub(crate) fn posture<'py>(
    py: Python<'py>,
    robot: &Robot,
    joints_deg: [f64; 6],
    force_n: Option<[f64; 3]>,
    asked: Asked,
) -> Answer<'py> {
    let robot = &robot.0;
    let force = force_n.map(Vector3::from);
    if force.is_some_and(|force| !force.iter().all(|part| part.abs() <= 1e6)) {
        return Err(refused("force_n takes x, y, z in N, each at most 1e6"));
    }
    let posture = compliance(robot, &joints_deg.map(f64::to_radians), &asked.held()?.tool()).map_err(of(robot))?;
    let answer = ComplianceAnswer { robot: robot.clone(), joints_deg, posture, force };
    to_python(py, &answer.json())
}

/// The best place of one zone.
#[pyfunction]
pub(crate) fn place<'py>(py: Python<'py>, robot: &Robot, wanted_task: &str, asked: Asked) -> WithColumns<'py> {
    let (robot, task) = (&robot.0, task(wanted_task)?);
    let (kind, tolerance_mm) = (asked.kind()?, asked.tolerance_mm()?);
    let options = asked.wanted()?.options(&kind, &asked.held()?, Some(task.zone)).map_err(refused)?;
    let placed = detached(py, || stiffarm::place::place(&kind.of(robot)?, task.zone, &options))?.map_err(of(robot))?;
    let answer = PlaceAnswer { robot: robot.clone(), model: kind, task, options, placed, tolerance_mm };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// The tasks of which no other before them has the zone.
#[pyfunction]
pub(crate) fn distinct(tasks: Vec<String>) -> PyResult<Vec<String>> {
    let tasks: Vec<Task> = tasks.iter().map(|text| task(text)).collect::<PyResult<_>>()?;
    Ok(question::distinct(&tasks).into_iter().map(|task| task.label).collect())
}

/// Robots in order.
#[pyfunction]
pub(crate) fn rank<'py>(
    py: Python<'py>,
    robots: Vec<PyRef<'py, Robot>>,
    tasks: Vec<String>,
    asked: Asked,
) -> WithColumns<'py> {
    let asked_for: Vec<Task> = tasks.iter().map(|text| task(text)).collect::<PyResult<_>>()?;
    let robots: Vec<Arms> = robots.iter().map(|robot| robot.0.clone()).collect();
    let (wanted, tolerance_mm) = (asked.wanted()?, asked.tolerance_mm()?);
    if matches!(wanted.angle, Angle::Horizontal | Angle::Vertical) && 1 < asked_for.len() {
        return Err(refused("angle horizontal or vertical means the long side of one task; give one task with it"));
    }
    if asked_for.is_empty() {
        return Err(refused("no task to rank for; give tasks"));
    }
    let tasks = question::distinct(&asked_for);
    let kind = asked.kind()?;
    let only = if let [task] = tasks.as_slice() { Some(task.zone) } else { None };
    let options = wanted.options(&kind, &asked.held()?, only).map_err(refused)?;
    let ranking = detached(py, || stiffarm::rank::rank(&robots, &tasks, &kind, &options, || ()))?;
    let answer = RankAnswer { ranking: ranking.map_err(refused)?, options, tolerance_mm };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// A map: its head, its layers by key, and what a figure shows besides.
#[pyfunction]
pub(crate) fn map<'py>(
    py: Python<'py>,
    robot: &Robot,
    asked: Asked,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let robot = &robot.0;
    let spacing = asked.read("step_m", |text| number(text, 1e-6, 10.0, "m"))?.map(Spacing::Step);
    let points = asked.read("size", |text| match text.parse() {
        Ok(points @ 2..=100_000) => Ok(Spacing::Points(points)),
        _ => Err("expected a whole number from 2 to 100000".into()),
    })?;
    let spacing = spacing.or(points).ok_or_else(|| refused("size is missing"))?;
    let kind = asked.kind()?;
    if let ModelKind::Spatial(_) = kind {
        let why = "does not go with a map in space";
        asked.refuse(&["direction_deg", "component", "elbow", "zone", "yaw_deg", "within_m", "angle", "gap"], why)?;
    }
    let zone = asked.read("zone", |text| text.parse::<Task>().map_err(|error| error.to_string()))?;
    if zone.is_none() {
        asked.refuse(&["within_m", "angle", "gap"], "places a zone: give zone with it")?;
    }
    let options = map_options(&asked, spacing, &kind)?;
    let placing =
        zone.as_ref().map(|task| asked.wanted()?.options(&kind, &asked.held()?, Some(task.zone)).map_err(refused));
    let placing = placing.transpose()?;
    let answer = detached(py, || {
        let model = kind.of(robot).map_err(of(robot))?;
        let map = stiffarm::map::map(&model, &options).map_err(of(robot))?;
        let zone = match zone.zip(placing) {
            None => None,
            Some((task, options)) => {
                let placed = stiffarm::place::place(&model, task.zone, &options).map_err(of(robot))?;
                let robot = robot.clone();
                Some(PlaceAnswer { robot, model: kind, task, options, placed, tolerance_mm: None })
            }
        };
        Ok::<_, PyErr>(MapAnswer { model, options, map, zone })
    })??;
    handed_over(py, &answer)
}

fn map_options(asked: &Asked, spacing: Spacing, kind: &ModelKind) -> PyResult<MapOptions> {
    let component = asked.read("component", |text| match text {
        "total" => Ok(Component::Total),
        "along" => Ok(Component::Along),
        _ => Err("expected total or along".into()),
    })?;
    let elbow = asked.read("elbow", |text| match text {
        "up" => Ok(stiffarm::plane::Elbow::Up),
        "down" => Ok(stiffarm::plane::Elbow::Down),
        _ => Err("expected up or down".into()),
    })?;
    let load = asked.load()?;
    let load = match (asked.read("direction_deg", degrees)?, component) {
        (Some(angle), part) => {
            let part = part.unwrap_or(Component::Total);
            Load::in_plane(load.newtons(), angle.to_radians(), part).map_err(refused)?
        }
        (None, None) => load,
        (None, Some(_)) => return Err(refused("component needs direction_deg")),
    };
    let asked_for = asked.held()?;
    let held = match kind {
        ModelKind::Planar => None,
        ModelKind::Spatial(_) => {
            Some(Held { elevation: asked_for.elevation(), yaw: 0.0, roll: asked_for.roll(), configuration: None })
        }
    };
    Ok(MapOptions { extent: Extent::Reached(spacing), load, elbow, held })
}

/// The links that are drawn, seen from the side: ahead and up; at the worst point of the zone, or at the stiffest point.
fn links(answer: &MapAnswer) -> Option<Vec<[f64; 2]>> {
    let MapAnswer { model, options, map, zone } = answer;
    let best = zone.as_ref().and_then(|zone| zone.placed.feasible());
    let posture = match best.map(|best| &best.hold) {
        Some(Hold::Plane { posture }) => Posture::Plane(*posture),
        Some(Hold::Space(hold)) => Posture::Joints(hold.joints),
        None => map.stiffest(model, options)?.2,
    };
    match (model, posture) {
        (Model::Planar(model), Posture::Plane(angles)) => Some(model.points(angles).to_vec()),
        (Model::Spatial(model), Posture::Joints(q)) => Some(model.points(&q).map(|[x, _, z]| [x, z]).to_vec()),
        (Model::Planar(_), Posture::Joints(_)) | (Model::Spatial(_), Posture::Plane(_)) => None,
    }
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
        "subtitle": format!("{}, {}", robot.architecture, robot.status),
        "arm_m": links(answer),
        "knows_base": answer.model.knows_base(),
        "zone_sides_m": sides.map(Zone::sides),
        "zone_is_circle": sides.map(|zone| matches!(zone, Zone::Circle { .. })),
    });
    Ok((to_python(py, &answer.head_json())?, layers, to_python(py, &shown)?))
}

/// Architecture against link ratio and size.
#[pyfunction]
pub(crate) fn study(
    py: Python<'_>,
    tasks: Vec<String>,
    sizes: Vec<f64>,
    ratios: Vec<f64>,
    range: [f64; 2],
    contenders: [(String, f64, f64); 2],
) -> WithColumns<'_> {
    let contender = |(name, k2, k3): &(String, f64, f64)| {
        let known = Architecture::ALL.into_iter().find(|known| known.name() == name);
        let architecture = known.ok_or_else(|| refused(format!("'{name}'; expected serial or quasi-serial")))?;
        Ok::<_, PyErr>(Contender { architecture, k2: *k2, k3: *k3 })
    };
    let [first, second] = contenders;
    let [low, high] = range;
    let range = Interval::new(low, high).filter(|range| range.is_bounded());
    let options = StudyOptions {
        contenders: [contender(&first)?, contender(&second)?],
        tasks: tasks.iter().map(|text| shape(text)).collect::<Result<_, _>>().map_err(refused)?,
        sizes,
        ratios,
        range: range.ok_or_else(|| refused(format!("range={low}..{high}; expected both ends, the lower one first")))?,
    };
    let found = detached(py, || studied(&options))?.map_err(refused)?;
    let answer = StudyAnswer(found);
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}
