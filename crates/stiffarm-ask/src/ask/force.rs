//! `stiffarm force`: with what force does a process push on its tool?

use std::path::Path;

use crate::answer::{CuttingAnswer, Rows};
use crate::request::Request;
use serde_json::Value;
use stiffarm::catalogue::files;

use super::context::Context;
use super::context::{PROCESS_FILE, process_of};
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::hodograph::Hodograph;
use crate::forms::{Answer, Forms, Makes, Picture, Piece};

pub(crate) fn answer(asked: &Request, context: Context) -> Result<ForceOutput, AskError> {
    let name = asked.process()?;
    let file = files::shown(Path::new(&name));
    let process = process_of(&name, &file, context)?;
    let force = process.process.force().map_err(|error| AskError::unanswered(&file, error, PROCESS_FILE))?;
    Ok(ForceOutput(CuttingAnswer { file, process, force }, FigureSize::of(asked)?))
}

pub(crate) struct ForceOutput(CuttingAnswer, FigureSize);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "force", makes: &[Makes::Picture(Picture::Figure)] };

impl Answer for ForceOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.0.table()), Piece::Break, Piece::Lines(self.0.notes().into())]
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        let CuttingAnswer { file, force, .. } = &self.0;
        // What does not turn with the spindle has no figure.
        let mean = force.mean.filter(|_| !force.revolution.is_empty())?;
        Some(Ok(Hodograph {
            title: format!("Force on the tool over a revolution, {file}"),
            subtitle: self.0.heading(),
            revolution: force.revolution.iter().map(|[feed, across, _]| [*feed, *across]).collect(),
            mean: [mean[0], mean[1]],
            figure_size: self.1,
        }
        .svg()))
    }

    fn figure_size(&self) -> FigureSize {
        self.1
    }
}
