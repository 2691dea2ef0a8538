//! `chatter`: does a cut swing with the arm, and how deep may it go?

use std::path::Path;

use stiffarm::catalogue::files;
use stiffarm::chatter::{ChatterError, chatter};

use super::compliance::remarks;
use super::context::{Context, process_of, tip_of};
use super::selection;
use crate::answer::{ChatterAnswer, Rows, TipFile};
use crate::error::AskError;
use crate::figures::{FigureSize, lobes};
use crate::forms::{Answer, Forms, Makes, Picture, Piece};
use crate::request::Request;
use serde_json::Value;

pub(crate) fn answer(asked: &Request, context: Context) -> Result<ChatterOutput, AskError> {
    let robot = asked.equipped(selection::robot(&asked.robot()?, context)?)?;
    let measured = tip_of(asked, context)?;
    let wanted = asked.chatter(measured.as_ref().map(|measured| &measured.tip))?;
    let (joints_deg, tool) = (asked.joints_deg()?, asked.held_tool()?);
    let name = asked.process()?;
    let file = files::shown(Path::new(&name));
    let process = process_of(&name, &file, context)?;
    let radians = joints_deg.map(f64::to_radians);
    let found = context
        .watched("looking for the depth", |_| chatter(&robot, &radians, &tool, &process.process, &wanted))
        .map_err(|error| refusal(error, &file, measured.as_ref()))?;
    remarks(&robot, &joints_deg, context);
    let answer = ChatterAnswer { robot, joints_deg, tool, file, process, measured, chatter: found };
    Ok(ChatterOutput(answer, FigureSize::of(asked)?))
}

/// Whose fault it is: that of the process, or of what was measured.
fn refusal(error: ChatterError, process: &str, measured: Option<&TipFile>) -> AskError {
    let file = match (&error, measured) {
        (ChatterError::NoModes, Some(measured)) => &measured.file,
        _ => process,
    };
    AskError::Chatter { file: file.to_owned(), error }
}

pub(crate) struct ChatterOutput(ChatterAnswer, FigureSize);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "chatter", makes: &[Makes::Picture(Picture::Figure)] };

impl Answer for ChatterOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.0.table()), Piece::Break, Piece::Lines(self.0.notes())]
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(lobes::svg(&self.0, &self.1)))
    }

    fn figure_size(&self) -> FigureSize {
        self.1
    }
}
