//! Toolpaths and processes.

use std::path::Path;

use pyo3::prelude::*;
use stiffarm::answer::{CuttingAnswer, MillAnswer, PathAnswer};
use stiffarm::catalogue::{files, read_process};
use stiffarm::request::Verb;
use stiffarm::toolpath::{Move, Survey, read_toolpath};

use crate::asked::Asked;
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::robot::Robot;
use crate::verbs::{WithColumns, columns};
use crate::waiting::Progress;

/// The force of a process.
#[pyfunction]
pub(crate) fn force<'py>(py: Python<'py>, process: &str) -> WithColumns<'py> {
    let path = Path::new(process);
    let file = files::shown(path);
    let process = read_process(&files::text(path).map_err(refused)?, &file).map_err(refused)?;
    let force = process.process.force().map_err(|error| refused(format!("{file}: {error}")))?;
    let answer = CuttingAnswer { file, process, force };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// A toolpath: what is understood of it, or the error along it.
#[pyfunction]
#[pyo3(signature = (path, asked, robot = None, progress = None))]
pub(crate) fn mill<'py>(
    py: Python<'py>,
    path: &str,
    asked: Asked,
    robot: Option<&Robot>,
    progress: Progress,
) -> WithColumns<'py> {
    let asked = asked.with(Verb::Mill, &[("path", path)])?;
    let format = asked.path_format(path).map_err(refused)?;
    let options = asked.read_options();
    if asked.is_dry() {
        let mut survey = Survey::new(asked.steps());
        let understood = detached(py, &progress, |watch| {
            read_toolpath(path, format, &options, &mut |one| survey.add(one), &mut |_, _| watch.go_on())
        })?;
        let answer = PathAnswer { path: path.into(), understood: understood.map_err(refused)?, survey };
        return Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?));
    }
    let robot = robot.ok_or_else(|| refused("robot is missing; expected the robot that mills, or dry=True"))?.0.clone();
    let process = asked.given_process().map(|file| {
        let named = files::shown(Path::new(&file));
        let text = files::text(Path::new(&file)).map_err(refused)?;
        Ok::<_, PyErr>((named.clone(), read_process(&text, &named).map_err(refused)?))
    });
    let process = process.transpose()?;
    let answer = detached(py, &progress, |watch| {
        let mut moves = Vec::new();
        let each = &mut |one: &Move| moves.push(*one);
        let understood = read_toolpath(path, format, &options, each, &mut |_, _| watch.go_on());
        let assumed = understood.map_err(|error| error.to_string())?.into_iter().flat_map(|told| told.assumed);
        let answer = MillAnswer::of(&asked, &robot, (path.into(), &moves), process, watch);
        let mut answer = answer.map_err(|error| error.to_string())?;
        answer.remarks.extend(assumed);
        Ok::<_, String>(answer)
    })?;
    let answer = answer.map_err(refused)?;
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}
