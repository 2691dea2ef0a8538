//! How far may the drives of a robot be off? The draws behind every interval.

use numpy::PyArray2;
use pyo3::prelude::*;
use stiffarm::prior::factors;
use stiffarm_ask::request::Verb;

use crate::asked::Asked;
use crate::refused;
use crate::robot::Robot;

/// A zone that any question may have: only the drives are read of it.
const ANY_TASK: &str = "circle:50";

/// The robot with the drives that a question asks for, and factors on their compliances, draw by draw; None where nothing says how far
/// they may be off.
#[pyfunction]
pub(crate) fn draws<'py>(
    py: Python<'py>,
    robot: &Robot,
    asked: Asked,
    count: usize,
) -> PyResult<(Robot, Option<Bound<'py, PyArray2<f64>>>)> {
    let asked = asked.with(Verb::Place, &[("task", ANY_TASK)])?;
    let robot = asked.equipped(robot.0.clone()).map_err(refused)?;
    let rows: Option<Vec<Vec<f64>>> =
        factors(&robot, count).map(|drawn| drawn.iter().map(|factors| factors.to_vec()).collect());
    let drawn = rows.map(|rows| PyArray2::from_vec2(py, &rows)).transpose().map_err(refused)?;
    Ok((Robot(robot), drawn))
}
