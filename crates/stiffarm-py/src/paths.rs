//! Toolpaths and processes.

use std::io::BufReader;
use std::path::Path;

use pyo3::prelude::*;
use stiffarm::answer::{CuttingAnswer, PathAnswer};
use stiffarm::catalogue::{files, read_process};
use stiffarm::request::Verb;
use stiffarm::toolpath::{Builtin, PathFault, Survey, read};

use crate::asked::Asked;
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::verbs::{WithColumns, columns};

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

/// What is understood of a toolpath.
#[pyfunction]
pub(crate) fn mill<'py>(py: Python<'py>, path: &str, asked: Asked) -> WithColumns<'py> {
    let asked = asked.with(Verb::Mill, &[("path", path)])?;
    if !asked.is_dry() {
        return Err(refused(
            "mill computes no error along a path yet: robot, force and roll are missing; dry=True tells what is understood of the path",
        ));
    }
    let (options, mut survey) = (asked.read_options(), Survey::new(asked.steps()));
    let understood = if Builtin::is_meant(path) {
        path.parse::<Builtin>().map_err(refused)?.moves(options.feed).iter().for_each(|one| survey.add(one));
        None
    } else {
        let format = asked.path_format(path).map_err(refused)?;
        let mut input = BufReader::new(files::open(Path::new(path)).map_err(refused)?);
        let shown = files::shown(Path::new(path));
        let mut each = |one: &_| survey.add(one);
        let found: Result<_, PathFault> =
            detached(py, &None, |watch| read(&mut input, &shown, format, &options, &mut each, &mut |_| watch.go_on()))?;
        Some(found.map_err(refused)?)
    };
    let answer = PathAnswer { path: path.into(), understood, survey };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}
