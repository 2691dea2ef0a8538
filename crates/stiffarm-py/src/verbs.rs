//! The verbs, with the options of the command line.

use nalgebra::Vector3;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use stiffarm::compliance::compliance;
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::map::{
    Axis, Component, Direction, Map, MapError, MapOptions, Section, SectionOptions, Spacing, reached_box,
    reached_section, section, stiffest_posture,
};
use stiffarm::place::{find_robot, place_in_space, place_robot};
use stiffarm::plane::Elbow;
use stiffarm::question::{self, Angle, degrees, number, shape};
use stiffarm::rank::{rank as rank_for, rank_in_plane, rank_in_space};
use stiffarm::report;
use stiffarm::report::map::MapReport;
use stiffarm::robot::{Arm, Robot as Arms};
use stiffarm::study::{Contender, StudyOptions, study as studied};
use stiffarm::task::{Task, Zone};

use crate::asked::{Asked, task};
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::robot::Robot;

type Answer<'py> = PyResult<Bound<'py, PyAny>>;

/// Names the robot before what is wrong.
fn of<E: ToString>(robot: &Arms) -> impl Fn(E) -> PyErr {
    move |error| refused(format!("{}: {}", robot.name, error.to_string()))
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
    to_python(py, &report::compliance::posture(robot, &joints_deg, &posture, force.as_ref()))
}

/// The best place of one zone.
#[pyfunction]
pub(crate) fn place<'py>(py: Python<'py>, robot: &Robot, wanted_task: &str, asked: Asked) -> Answer<'py> {
    let (robot, task) = (&robot.0, task(wanted_task)?);
    let (wanted, tolerance_mm) = (asked.wanted()?, asked.tolerance_mm()?);
    let cell = if asked.is_spatial()? {
        let options = wanted.spatial_for(&asked.held()?, task.zone).map_err(refused)?;
        let placed = detached(py, || place_in_space(robot, task.zone, &options))?.map_err(of(robot))?;
        report::spatial::cell(robot, &task, &options, &placed, tolerance_mm)
    } else {
        let options = wanted.planar(task.zone);
        let placed = detached(py, || place_robot(robot, task.zone, &options))?.map_err(of(robot))?;
        report::place::cell(robot, &task, &options, &placed, tolerance_mm)
    };
    to_python(py, &Value::Object(cell))
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
) -> Answer<'py> {
    let asked_for: Vec<Task> = tasks.iter().map(|text| task(text)).collect::<PyResult<_>>()?;
    let robots: Vec<Arms> = robots.iter().map(|robot| robot.0.clone()).collect();
    let (wanted, tolerance_mm) = (asked.wanted()?, asked.tolerance_mm()?);
    if matches!(wanted.angle, Angle::Horizontal | Angle::Vertical) && 1 < asked_for.len() {
        return Err(refused("angle horizontal or vertical means the long side of one task; give one task with it"));
    }
    let first = asked_for.first().ok_or_else(|| refused("no task to rank for; give tasks"))?;
    let tasks = question::distinct(&asked_for);
    let answer = if asked.is_spatial()? {
        let held = asked.held()?;
        let options = match tasks.as_slice() {
            [task] => wanted.spatial_for(&held, task.zone),
            _ => wanted.spatial(&held),
        };
        let options = options.map_err(refused)?;
        detached(py, || {
            let ranking = rank_in_space(&robots, &tasks, &options, || ())?;
            let planar = rank_in_plane(&robots, &tasks, options.force)?;
            Ok(report::spatial::ranking(&ranking, &planar, &options, tolerance_mm))
        })?
    } else {
        let options = wanted.planar(first.zone);
        detached(py, || {
            let ranking = rank_for(&robots, &tasks, &options, || ())?;
            Ok(report::rank::ranking(&ranking, &options, tolerance_mm))
        })?
    };
    to_python(py, &answer.map_err(|error: stiffarm::rank::RankError| refused(error))?)
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
    if asked.is_spatial()? {
        let why = "does not go with a map in space";
        asked.refuse(&["direction_deg", "component", "elbow", "zone", "yaw_deg", "within_m", "angle", "gap"], why)?;
        return spatial_map(py, robot, spacing, &asked);
    }
    let zone = asked.read("zone", |text| text.parse::<Task>().map_err(|error| error.to_string()))?;
    if zone.is_none() {
        asked.refuse(&["within_m", "angle", "gap"], "places a zone: give zone with it")?;
    }
    let wanted = asked.wanted()?;
    let options = planar_options(&asked, wanted.force)?;
    let (plane, map, placement) = detached(py, || {
        let plane = robot.arm_plane().map_err(|error| of(robot)(MapError::Arm(error.into())))?;
        let [x, z] = spacing.cover(reached_box(&plane.arm).map_err(of(robot))?);
        let options = MapOptions { x, z, ..options };
        let map = stiffarm::map::map(&plane.arm, &options).map_err(of(robot))?;
        let found = zone.as_ref().map(|task| find_robot(robot, task.zone, &wanted.planar(task.zone)));
        Ok::<_, PyErr>((plane, map, found.transpose().map_err(of(robot))?.flatten()))
    })??;
    let options = MapOptions { x: map.x, z: map.z, ..options };
    let posture = match &placement {
        Some(placement) => Some(placement.worst_posture.into()),
        None => stiffest_posture(&plane.arm, &map, options.elbow),
    };
    let sides = zone.as_ref().map(|task| (task.zone.sides(), matches!(task.zone, Zone::Circle { .. })));
    let shown = json!({
        "title": robot.full_name(),
        "subtitle": format!("{}, {}", robot.architecture, robot.status),
        "arm_m": posture.map(|(shoulder, elbow)| plane.arm.points(shoulder, elbow)),
        "axis_from_base_m": plane.axis_from_base,
        "zone_sides_m": sides.map(|(sides, _)| sides),
        "zone_is_circle": sides.map(|(_, is_circle)| is_circle),
    });
    let placed = zone.as_ref().zip(placement.as_ref());
    handed_over(py, &report::map::planar(robot, &options, &map, placed), &map, &shown)
}

fn planar_options(asked: &Asked, force: f64) -> PyResult<MapOptions> {
    let component = asked.read("component", |text| match text {
        "total" => Ok(Component::Total),
        "along" => Ok(Component::Along),
        _ => Err("expected total or along".into()),
    })?;
    let elbow = asked.read("elbow", |text| match text {
        "up" => Ok(Elbow::Up),
        "down" => Ok(Elbow::Down),
        _ => Err("expected up or down".into()),
    })?;
    let direction = match (asked.read("direction_deg", degrees)?, component) {
        (Some(angle), part) => Direction::Given(angle.to_radians(), part.unwrap_or(Component::Total)),
        (None, None) => Direction::Worst,
        (None, Some(_)) => return Err(refused("component needs direction_deg")),
    };
    let unknown = Axis { start: 0.0, step: 1.0, count: 2 };
    Ok(MapOptions { x: unknown, z: unknown, force, direction, elbow })
}

fn spatial_map<'py>(
    py: Python<'py>,
    robot: &Arms,
    spacing: Spacing,
    asked: &Asked,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let held = asked.held()?;
    let unknown = Axis { start: 0.0, step: 1.0, count: 2 };
    let options = SectionOptions {
        x: unknown,
        z: unknown,
        force: asked.force()?,
        flange_from_tool: held.tool(),
        elevation: held.elevation(),
        yaw: 0.0,
        roll: held.roll(),
        configuration: None,
    };
    let (options, section) = detached(py, || {
        let reached = reached_section(robot, &options).map_err(of(robot))?;
        let reached = reached.ok_or_else(|| of(robot)("no point is reached with this direction of the tool"))?;
        let [x, z] = spacing.cover(reached);
        let options = SectionOptions { x, z, ..options };
        Ok::<_, PyErr>((options, section(robot, &options).map_err(of(robot))?))
    })??;
    let shown = json!({
        "title": robot.full_name(),
        "subtitle": format!("{}, {}", robot.architecture, robot.status),
        "arm_m": stiffest_links(robot, &options, &section),
    });
    handed_over(py, &report::map::spatial(robot, &options, &section), &section.worst, &shown)
}

/// The links at the stiffest point, seen from the side: ahead and up.
fn stiffest_links(robot: &Arms, options: &SectionOptions, section: &Section) -> Option<[[f64; 2]; 5]> {
    let [(_, i, j), _] = section.worst.extremes()?;
    let joints = section.joints(robot, options, i, j)?;
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return None };
    let points = geometry.points(&geometry.model_angles(&joints, limits.third_axis));
    Some(points.map(|[x, _, z]| [x, z]))
}

fn handed_over<'py>(
    py: Python<'py>,
    report: &MapReport,
    map: &Map,
    shown: &Value,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let layers = PyDict::new(py);
    for layer in &report.layers {
        let cells: Bound<PyArray2<f64>> = PyArray1::from_vec(py, layer.cells()).reshape([map.z.count, map.x.count])?;
        layers.set_item(layer.key, cells)?;
    }
    Ok((to_python(py, &report.head_with_postures())?, layers, to_python(py, shown)?))
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
) -> Answer<'_> {
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
    to_python(py, &report::study::study(&found))
}
