//! Toolpaths and processes.

use std::path::Path;

use pyo3::prelude::*;
use stiffarm::answer::{CuttingAnswer, MillAnswer, MillAnswerError, PathAnswer, PathRankAnswer};
use stiffarm::catalogue::{ProcessFile, files, read_process_beside};
use stiffarm::request::{Request, Verb};
use stiffarm::robot::Robot as Arms;
use stiffarm::toolpath::{Move, Survey, read_toolpath};
use stiffarm::watch::Watch;

use crate::asked::Asked;
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::robot::{Robot, kept, robot as named};
use crate::verbs::{WithColumns, columns};
use crate::waiting::Progress;

/// What a process file says, and what the files say that it names beside itself.
fn process_of(path: &Path, shown: &str) -> PyResult<ProcessFile> {
    let mut beside = |other: &str| files::text(&files::beside(path, other)).map_err(|error| error.to_string());
    read_process_beside(&files::text(path).map_err(refused)?, shown, &mut beside).map_err(refused)
}

/// What is asked of a zone, under the force of its process where one is given.
pub(crate) fn under_process(asked: Request) -> PyResult<Request> {
    let Some(file) = asked.given_process() else { return Ok(asked) };
    let path = Path::new(&file);
    asked.under(&process_of(path, &files::shown(path))?.process).map_err(refused)
}

/// The force of a process.
#[pyfunction]
pub(crate) fn force<'py>(py: Python<'py>, process: &str) -> WithColumns<'py> {
    let path = Path::new(process);
    let file = files::shown(path);
    let process = process_of(path, &file)?;
    let force = process.process.force().map_err(|error| refused(format!("{file}: {error}")))?;
    let answer = CuttingAnswer { file, process, force };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// A toolpath: what is understood of it, the error along it, or the order of several robots on it.
#[pyfunction]
#[pyo3(signature = (path, asked, robot = None, robots = None, progress = None))]
pub(crate) fn mill<'py>(
    py: Python<'py>,
    path: &str,
    asked: Asked,
    robot: Option<&Robot>,
    robots: Option<Vec<PyRef<'py, Robot>>>,
    progress: Progress,
) -> WithColumns<'py> {
    let robots: Option<Vec<Arms>> = robots.map(|robots| robots.iter().map(|robot| robot.0.clone()).collect());
    let names = robots.iter().flatten().map(|robot| ("robots", robot.name.as_str()));
    let given = [("path", path)].into_iter().chain(robot.map(|robot| ("robot", robot.0.name.as_str()))).chain(names);
    let asked = asked.with(Verb::Mill, &given.collect::<Vec<_>>())?;
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
    let milling = match (robot, robots) {
        (_, Some(robots)) => Milling::Several(kept(robots, &asked, Vec::new())?),
        (Some(robot), None) => Milling::One(robot.0.clone()),
        (None, None) if asked.ranks_on_path() => {
            return Err(refused("robots is missing; expected those among which is chosen, such as robots=\"all\""));
        }
        (None, None) => Milling::One(named(&asked.robot().map_err(refused)?)?.0),
    };
    let process = asked.given_process().map(|file| {
        let named = files::shown(Path::new(&file));
        let process = process_of(Path::new(&file), &named)?;
        Ok::<_, PyErr>((named, process))
    });
    let process = process.transpose()?;
    let told = detached(py, &progress, |watch| {
        let mut moves = Vec::new();
        let each = &mut |one: &Move| moves.push(*one);
        let understood = read_toolpath(path, format, &options, each, &mut |_, _| watch.go_on());
        let assumed = understood.map_err(|error| error.to_string())?.into_iter().flat_map(|told| told.assumed);
        let told = milling.told(&asked, (path, &moves), process, (assumed.collect(), watch));
        told.map_err(|error| error.to_string())
    })?;
    match told.map_err(refused)? {
        Told::One(answer) => Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?)),
        Told::Several(answer) => Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?)),
    }
}

/// Who mills.
enum Milling {
    One(Arms),
    Several(Vec<Arms>),
}

/// What comes of it.
enum Told {
    One(MillAnswer),
    Several(PathRankAnswer),
}

impl Milling {
    /// The answer, with what was assumed of the path among the remarks.
    fn told(
        self,
        asked: &Request,
        (path, moves): (&str, &[Move]),
        process: Option<(String, ProcessFile)>,
        (assumed, watch): (Vec<String>, Watch),
    ) -> Result<Told, MillAnswerError> {
        let path = (path.to_owned(), moves);
        Ok(match self {
            Self::One(robot) => {
                let mut answer = MillAnswer::of(asked, &robot, path, process, watch)?;
                answer.remarks.extend(assumed);
                Told::One(answer)
            }
            Self::Several(robots) => {
                let mut answer = PathRankAnswer::of(asked, robots, path, process.as_ref(), watch)?;
                answer.remarks.extend(assumed);
                Told::Several(answer)
            }
        })
    }
}
