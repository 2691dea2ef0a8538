//! `stiffarm robots verify`: does a robot file count the joints as the pendant does?

use serde_json::Value;
use stiffarm::catalogue;
use stiffarm::robot::Robot;
use stiffarm::verify::{rank, verify};

use super::context::{Context, readings_of};
use crate::answer::{Rows, VerifyAnswer, VerifyRankAnswer};
use crate::date::today;
use crate::error::AskError;
use crate::forms::{Answer, Forms, Makes, Piece, tables_and_notes};
use crate::request::Request;

/// What to do where readings tell nothing.
const READ_MORE: &str = "read three to ten postures that move every joint; docs/verify.md tells how";

/// Of a robot that was named.
pub(crate) fn answer(asked: &Request, context: Context) -> Result<VerifyAnswer, AskError> {
    let robot = super::selection::robot(&asked.robot()?, context)?;
    let (readings, data) = readings_of(&robot.vendor, (asked, context))?;
    let others: Vec<Robot> = (catalogue::entries().iter())
        .filter(|entry| entry.name != robot.name && (asked.tries_all() || entry.vendor == robot.vendor))
        .map(catalogue::Entry::robot)
        .collect();
    let options = asked.verification();
    let found = context.watched("comparing", |watch| verify(&robot, &readings, &options, &others, watch));
    let found = found.map_err(|error| AskError::unanswered(&data, error, READ_MORE))?;
    let answer = VerifyAnswer { found, data, date: asked.date().unwrap_or_else(today) };
    for remark in answer.robot_file().map_or_else(Vec::new, |(_, remarks)| remarks) {
        context.listener.remark(&format!("note: in the robot file: {remark}"));
    }
    Ok(answer)
}

/// Of all robots of the catalogue.
pub(crate) fn of_any(asked: &Request, context: Context) -> Result<VerifyRankAnswer, AskError> {
    let (readings, data) = readings_of("", (asked, context))?;
    let options = asked.verification();
    let fits = context.watched("comparing", |watch| rank(&readings, &options, &catalogue::robots(), watch));
    let fits = fits.map_err(|error| AskError::unanswered(&data, error, READ_MORE))?;
    Ok(VerifyRankAnswer { fits, rows: readings.rows.len(), data })
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "robots verify", makes: &[Makes::RobotFile] };
/// The same where no robot is named: no robot file is written.
pub(crate) const FORMS_OF_ANY: Forms = Forms::of("robots verify --any");

impl Answer for VerifyAnswer {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        tables_and_notes([Some(self.summary()), self.table()].into_iter().flatten(), self.notes())
    }

    fn value(&self) -> Value {
        self.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.rows()
    }

    fn refusal(&self) -> Option<AskError> {
        (!self.found.verified).then(|| AskError::NotVerified(self.found.robot.full_name()))
    }

    fn robot_file(&self) -> Option<Result<String, AskError>> {
        let nothing_fits = || AskError::NotVerified(self.found.robot.full_name());
        Some(self.robot_file().map(|(text, _)| text).ok_or_else(nothing_fits))
    }
}

impl Answer for VerifyRankAnswer {
    fn forms(&self) -> Forms {
        FORMS_OF_ANY
    }

    fn text(&self) -> Vec<Piece> {
        tables_and_notes([self.table()], self.notes())
    }

    fn value(&self) -> Value {
        self.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.rows()
    }
}
