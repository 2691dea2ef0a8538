//! The report of `modes`: how the arm swings, at a posture or over a zone.

use super::Inputs;
use super::said::{figure_size, repeated};
use crate::answer::{ModesAnswer, ModesOverAnswer};
use crate::error::AskError;
use crate::figures::{FigureSize, swinging};
use crate::report::robots::provenance_of;
use crate::report::{Report, Section};
use crate::request::Request;

/// The document of one posture.
///
/// # Errors
/// Where a file is no longer there.
pub(crate) fn of(
    answer: &ModesAnswer,
    look: FigureSize,
    (asked, inputs): (&Request, &Inputs),
) -> Result<Report, AskError> {
    let mut decided = Section::new("What decides");
    let shapes =
        "How the arm moves in its first modes, seen from the side and from above; lengths of the shapes are at will.";
    decided.figure(swinging::svg(answer, &figure_size(look)), shapes);
    decided.heading("Modes");
    decided.table(answer.table());
    let angles = answer.joints_deg.map(|angle| angle.to_string()).join(", ");
    Ok(Report {
        title: format!("How {} swings", answer.robot.full_name()),
        asked: format!("At the joint angles {angles} deg"),
        headline: answer.headline(),
        sections: vec![decided, provenance_of(&answer.robot), repeated(asked, inputs)?],
    })
}

/// The document of a zone.
///
/// # Errors
/// Where a file is no longer there.
pub(crate) fn over(answer: &ModesOverAnswer, (asked, inputs): (&Request, &Inputs)) -> Result<Report, AskError> {
    let mut decided = Section::new("What decides");
    decided.heading("Modes over the zone");
    decided.table(answer.table());
    Ok(Report {
        title: format!("How {} swings over {}", answer.robot.full_name(), answer.task.label),
        asked: format!("{}, its middle where it was given", answer.task.work.describe()),
        headline: answer.headline(),
        sections: vec![decided, provenance_of(&answer.robot), repeated(asked, inputs)?],
    })
}
