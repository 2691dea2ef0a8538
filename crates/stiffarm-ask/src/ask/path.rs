//! A toolpath and its process as they are read; what is understood of a path (`mill --dry`).

use std::cell::RefCell;
use std::path::Path;

use stiffarm::catalogue::stl::{MOST_STL_BYTES, read_stl};
use stiffarm::catalogue::{ProcessFile, files};
use stiffarm::clearance::Mesh;
use stiffarm::toolpath::{Move, Survey, Understood};
use stiffarm::watch::Stopped;

use super::context::{Context, process_of, tip_of};
use crate::answer::{Beside, Bodies, MeshFile, PathAnswer, Rows};
use crate::error::AskError;
use crate::forms::{Answer, Forms, Piece};
use crate::request::Request;
use serde_json::Value;

/// What is understood of a path.
pub(crate) fn answer(asked: &Request, context: Context) -> Result<PathOutput, AskError> {
    let (path, mut survey) = (asked.path()?, Survey::new(asked.steps()));
    let understood = read_moves(asked, &path, context, &mut |one| survey.add(one), &|| Ok(()))?;
    Ok(PathOutput(PathAnswer { path, understood, survey }))
}

/// The process that is asked for, with the name of its file.
pub(super) fn read_process_of(asked: &Request, context: Context) -> Result<Option<(String, ProcessFile)>, AskError> {
    let Some(file) = asked.given_process() else { return Ok(None) };
    let named = files::shown(Path::new(&file));
    let read = process_of(&file, &named, context)?;
    Ok(Some((named, read)))
}

/// The meshes of part and fixture, where they are given.
pub(super) fn read_bodies(asked: &Request, context: Context) -> Result<Bodies, AskError> {
    let read = |file: String| {
        let bytes = context.sources.bytes(&file, MOST_STL_BYTES)?;
        let surface = read_stl(&bytes, &files::shown(Path::new(&file)), asked.stl_unit())?;
        Ok::<_, AskError>(MeshFile { mesh: Mesh::of(&surface), notes: surface.notes })
    };
    Ok(Bodies { part: asked.part().map(read).transpose()?, fixture: asked.fixture().map(read).transpose()? })
}

/// Process, part, fixture and what was measured at the tip, where they are given.
pub(super) fn read_beside(asked: &Request, context: Context) -> Result<Beside, AskError> {
    let (process, bodies) = (read_process_of(asked, context)?, read_bodies(asked, context)?);
    Ok(Beside { process, bodies, measured: tip_of(asked, context)? })
}

/// All moves of the path, as long as no more samples come of them, each kept for so many robots, than there may be.
pub(super) fn all_moves(
    asked: &Request,
    path: &str,
    context: Context,
    robots: usize,
) -> Result<(Vec<Move>, Option<Understood>), AskError> {
    let gathered = RefCell::new(asked.gathered(context.most_samples / robots.max(1)));
    let goes_on = || if gathered.borrow().is_over() { Err(Stopped) } else { Ok(()) };
    let understood = read_moves(asked, path, context, &mut |one| gathered.borrow_mut().add(one), &goes_on);
    // Of a path that was left because it is too long that is said.
    let moves = asked.all_moves(gathered.into_inner())?;
    Ok((moves, understood?))
}

/// Reads the path, move by move, as long as it goes on.
fn read_moves(
    asked: &Request,
    path: &str,
    context: Context,
    each: &mut dyn FnMut(&Move),
    goes_on: &dyn Fn() -> Result<(), Stopped>,
) -> Result<Option<Understood>, AskError> {
    let format = asked.path_format(path)?;
    context.watched("reading", |watch| {
        let mut far = |_, _| goes_on().and_then(|()| watch.go_on());
        context.sources.moves((path, format), &asked.read_options(), each, &mut far)
    })
}

pub(crate) struct PathOutput(PathAnswer);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms::of("mill");

impl Answer for PathOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.0.table())]
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}
