//! What a figure of a placement shows besides the answer: the section, the arm and the zone's rim, the zone straight ahead.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use serde_json::json;
use stiffarm::map::{Spacing, map_watched};
use stiffarm::model::{ArmPosture, Model};
use stiffarm::place::{Placement, deflection_field, place_task_watched};
use stiffarm_ask::answer::{MapAnswer, PlaceAnswer, stiffness, words};
use stiffarm_ask::request::Verb;

use crate::asked::Asked;
use crate::json::to_python;
use crate::paths::under_process;
use crate::pool::detached;
use crate::refused;
use crate::robot::Robot;
use crate::verbs::of;

/// Points along each side of the square that is stretched onto the zone.
const RIM: usize = 48;

/// The section as it is held at the best place of a zone, and its cells; the search is done once more.
#[pyfunction]
pub(crate) fn drawn_place<'py>(
    py: Python<'py>,
    robot: &Robot,
    wanted_task: &str,
    asked: Asked,
    size: usize,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyArray2<f64>>)> {
    let asked = asked.with(Verb::Place, &[("task", wanted_task)])?;
    let robot = &asked.equipped(robot.0.clone()).map_err(refused)?;
    let (task, kind) = (asked.task().map_err(refused)?, asked.model());
    let options = under_process(asked)?.place_options(Some(task.zone)).map_err(refused)?;
    let (shown, drawn) = detached(py, &None, |watch| {
        let model = kind.of(robot).map_err(of(robot))?;
        let placed = place_task_watched(&model, &task.zone.into(), &options, watch).map_err(of(robot))?;
        let own = robot.clone();
        let answer = PlaceAnswer { robot: own, model: kind, task, options, placed, tolerance_mm: None, advice: None };
        let best = answer.placed.feasible().cloned().ok_or_else(|| refused("no place to draw"))?;
        let options = answer.map_options(&model, Spacing::Points(size.clamp(2, 2000)));
        let map = map_watched(&model, &options, watch).map_err(of(robot))?;
        let rim = deflection_field(&model, &answer.options, &best, rim(&answer)).map_err(of(robot))?;
        let (bearing, posture) = straight_ahead(&model, &best);
        let ((s, c), [x, y, z]) = (bearing.sin_cos(), best.worst_point);
        let points = model.points(&posture).unwrap_or_default();
        let drawn = MapAnswer { model, options, map, zone: None };
        let shown = json!({
            "title": robot.full_name(),
            "subtitle": format!("{}; {}, {} model", words::class(robot), stiffness(robot), drawn.model.kind().name()),
            "arm_m": points.into_iter().map(|[x, _, z]| [x, z]).collect::<Vec<_>>(),
            "knows_base": drawn.model.knows_base(),
            "rim_m": rim.iter().map(|point| [point.at[0], point.at[2]]).collect::<Vec<_>>(),
            "worst_m": [c * x + s * y, z],
            "x_m": drawn.map.deflection.x.points(),
            "z_m": drawn.map.deflection.z.points(),
        });
        Ok::<_, PyErr>((shown, drawn))
    })??;
    let grid = &drawn.map.deflection;
    let cells = drawn.layers()[0].cells();
    Ok((to_python(py, &shown)?, PyArray1::from_vec(py, cells).reshape([grid.z.count, grid.x.count])?))
}

/// Around the zone, m from its centre along its sides.
fn rim(answer: &PlaceAnswer) -> Vec<[f64; 2]> {
    let along = |i: usize| 2.0 * i as f64 / RIM as f64 - 1.0;
    let sides: [fn(f64) -> [f64; 2]; 4] = [|t| [t, -1.0], |t| [1.0, t], |t| [-t, 1.0], |t| [-1.0, -t]];
    let nodes = sides.iter().flat_map(|side| (0..RIM).map(move |i| side(along(i))));
    nodes.chain([[-1.0, -1.0]]).map(|node| answer.task.zone.at(node)).collect()
}

/// The bearing at which the zone stands, rad, and the posture at its worst point as it is without.
fn straight_ahead(model: &Model, best: &Placement) -> (f64, ArmPosture) {
    match (model, best.space()) {
        (Model::Spatial(model), Some(hold)) => {
            let mut q = hold.joints;
            q[0] -= model.joint_1_sign() * hold.bearing;
            (hold.bearing, ArmPosture::Joints(q))
        }
        _ => (0.0, best.posture()),
    }
}
