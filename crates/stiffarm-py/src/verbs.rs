//! The verbs, with the options of the command line.

use nalgebra::Vector3;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use stiffarm::compliance::compliance;
use stiffarm::map::{
    Axis, Map, MapError, MapOptions, Section, SectionOptions, Spacing, reached_box, reached_section, section,
    stiffest_posture,
};
use stiffarm::place::{find_robot, place_in_space, place_robot};
use stiffarm::rank::{rank as rank_for, rank_in_plane, rank_in_space};
use stiffarm::report;
use stiffarm::report::map::MapReport;
use stiffarm::request::{self, Request, Verb};
use stiffarm::robot::{Arm, Robot as Arms};
use stiffarm::study::study as studied;
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
pub(crate) fn posture<'py>(py: Python<'py>, robot: &Robot, joints_deg: [f64; 6], asked: Asked) -> Answer<'py> {
    let (robot, asked) = (&robot.0, asked.of(Verb::Compliance)?);
    let force = asked.force_along().map(Vector3::from);
    let posture = compliance(robot, &joints_deg.map(f64::to_radians), &asked.held().tool()).map_err(of(robot))?;
    to_python(py, &report::compliance::posture(robot, &joints_deg, &posture, force.as_ref()))
}

/// The best place of one zone.
#[pyfunction]
pub(crate) fn place<'py>(py: Python<'py>, robot: &Robot, wanted_task: &str, asked: Asked) -> Answer<'py> {
    let (robot, asked) = (&robot.0, asked.with(Verb::Place, &[("task", wanted_task)])?);
    let (task, tolerance_mm) = (asked.task().map_err(refused)?, asked.tolerance_mm());
    let cell = if asked.is_spatial() {
        let options = asked.spatial_for(task.zone).map_err(refused)?;
        let placed = detached(py, || place_in_space(robot, task.zone, &options))?.map_err(of(robot))?;
        report::spatial::cell(robot, &task, &options, &placed, tolerance_mm)
    } else {
        let options = asked.wanted().planar(task.zone);
        let placed = detached(py, || place_robot(robot, task.zone, &options))?.map_err(of(robot))?;
        report::place::cell(robot, &task, &options, &placed, tolerance_mm)
    };
    to_python(py, &Value::Object(cell))
}

/// The tasks of which no other before them has the zone.
#[pyfunction]
pub(crate) fn distinct(tasks: Vec<String>) -> PyResult<Vec<String>> {
    let tasks: Vec<Task> = tasks.iter().map(|text| task(text)).collect::<PyResult<_>>()?;
    Ok(request::distinct(&tasks).into_iter().map(|task| task.label).collect())
}

/// Robots in order.
#[pyfunction]
pub(crate) fn rank<'py>(
    py: Python<'py>,
    robots: Vec<PyRef<'py, Robot>>,
    tasks: Vec<String>,
    asked: Asked,
) -> Answer<'py> {
    let tasks: Vec<(&str, &str)> = tasks.iter().map(|text| ("tasks", text.as_str())).collect();
    let asked = asked.with(Verb::Rank, &tasks)?;
    let robots: Vec<Arms> = robots.iter().map(|robot| robot.0.clone()).collect();
    let (given, tolerance_mm) = (asked.tasks(), asked.tolerance_mm());
    let first = given.first().ok_or_else(|| refused("no task to rank for; give tasks"))?;
    let tasks = request::distinct(&given);
    let answer = if asked.is_spatial() {
        let options = match tasks.as_slice() {
            [task] => asked.spatial_for(task.zone),
            _ => asked.spatial(),
        };
        let options = options.map_err(refused)?;
        detached(py, || {
            let ranking = rank_in_space(&robots, &tasks, &options, || ())?;
            let planar = rank_in_plane(&robots, &tasks, options.force)?;
            Ok(report::spatial::ranking(&ranking, &planar, &options, tolerance_mm))
        })?
    } else {
        let options = asked.wanted().planar(first.zone);
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
    let (robot, asked) = (&robot.0, asked.of(Verb::Map)?);
    let spacing = asked.spacing();
    if asked.is_spatial() {
        return spatial_map(py, robot, spacing, &asked);
    }
    let (zone, wanted) = (asked.zone(), asked.wanted());
    let unknown = Axis { start: 0.0, step: 1.0, count: 2 };
    let (direction, elbow) = (asked.direction(), asked.elbow());
    let options = MapOptions { x: unknown, z: unknown, force: wanted.force, direction, elbow };
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

fn spatial_map<'py>(
    py: Python<'py>,
    robot: &Arms,
    spacing: Spacing,
    asked: &Request,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let held = asked.held();
    let unknown = Axis { start: 0.0, step: 1.0, count: 2 };
    let options = SectionOptions {
        x: unknown,
        z: unknown,
        force: asked.force(),
        flange_from_tool: held.tool(),
        elevation: held.elevation(),
        yaw: 0.0,
        roll: held.roll(),
        configuration: asked.posture(),
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
pub(crate) fn study(py: Python<'_>, asked: Asked) -> Answer<'_> {
    let options = asked.of(Verb::Study)?.study().map_err(refused)?;
    let found = detached(py, || studied(&options))?.map_err(refused)?;
    to_python(py, &report::study::study(&found))
}
