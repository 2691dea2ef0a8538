//! Many postures at once: arrays in, arrays out.

use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use stiffarm_ask::answer::compliance::{doubts, matrices_um_per_n, worst_um_per_n};
use stiffarm_ask::request::Verb;

use crate::asked::Asked;
use crate::hearing::said;
use crate::pool::detached;
use crate::refused;
use crate::robot::Robot;
use crate::waiting::Progress;

/// Rows of six of an array that lies in one piece: nothing is copied.
fn rows<'a>(joints_deg: &'a PyReadonlyArray2<'_, f64>) -> PyResult<&'a [[f64; 6]]> {
    match (joints_deg.shape(), joints_deg.as_slice()) {
        ([_, 6], Ok(numbers)) => Ok(numbers.as_chunks().0),
        (shape, _) => Err(refused(format!("joint angles of shape {shape:?}; expected rows of six in one piece"))),
    }
}

/// The worst compliance at every posture, um/N.
#[pyfunction]
#[pyo3(signature = (robot, joints_deg, asked, progress=None))]
pub(crate) fn worst<'py>(
    py: Python<'py>,
    robot: &Robot,
    joints_deg: PyReadonlyArray2<'py, f64>,
    asked: Asked,
    progress: Progress,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let asked = asked.of(Verb::Compliance)?;
    let (robot, tool) = (&asked.equipped(robot.0.clone()).map_err(refused)?, asked.tool_pose().tool());
    let joints_deg = rows(&joints_deg)?;
    let mut found = vec![0.0; joints_deg.len()];
    detached(py, &progress, |watch| worst_um_per_n(robot, &tool, joints_deg, &mut found, watch))?
        .map_err(|error| refused(format!("{}: {error}", robot.name)))?;
    said(py, &doubts(robot, joints_deg))?;
    Ok(PyArray1::from_vec(py, found))
}

/// The 3 x 3 compliance at every posture, um/N.
#[pyfunction]
#[pyo3(signature = (robot, joints_deg, asked, progress=None))]
pub(crate) fn matrices<'py>(
    py: Python<'py>,
    robot: &Robot,
    joints_deg: PyReadonlyArray2<'py, f64>,
    asked: Asked,
    progress: Progress,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let asked = asked.of(Verb::Compliance)?;
    let (robot, tool) = (&asked.equipped(robot.0.clone()).map_err(refused)?, asked.tool_pose().tool());
    let joints_deg = rows(&joints_deg)?;
    let mut found = vec![[0.0; 9]; joints_deg.len()];
    detached(py, &progress, |watch| matrices_um_per_n(robot, &tool, joints_deg, &mut found, watch))?
        .map_err(|error| refused(format!("{}: {error}", robot.name)))?;
    PyArray1::from_vec(py, found.into_flattened()).reshape([joints_deg.len(), 3, 3])
}
