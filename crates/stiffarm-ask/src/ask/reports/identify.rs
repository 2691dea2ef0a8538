//! The report of `identify`: which drives are known now, and how well.

use super::Inputs;
use super::said::{figure_size, repeated};
use crate::answer::IdentifyAnswer;
use crate::error::AskError;
use crate::figures::{FigureSize, identify as figure};
use crate::report::robots::drawing_of;
use crate::report::{Block, Report, Section};
use crate::request::Request;

/// The document.
///
/// # Errors
/// Where a file is no longer there.
pub(crate) fn of(
    answer: &IdentifyAnswer,
    look: FigureSize,
    (asked, inputs): (&Request, &Inputs),
) -> Result<Report, AskError> {
    let mut decided = Section::new("What decides");
    let svg = figure::svg(answer, &figure_size(look));
    decided.figure(svg, "What was measured, and what the compliances found leave of it.");
    decided.heading("Drives");
    decided.table(answer.table());
    if let Some(updated) = answer.updated() {
        decided.heading("What the measurements make of the prior");
        decided.table(updated);
    }
    decided.heading("How well the measurements are explained");
    decided.table(answer.summary());
    let mut fitting = Section::new("What does not fit");
    match answer.outlier_table() {
        Some(outliers) => fitting.table(outliers),
        None => fitting.text("No reading stands out."),
    }
    let mut file = Section::new("Robot file with what was identified").on_new_page();
    match answer.robot_file() {
        Some(text) => file.blocks.push(Block::Code(text)),
        None => file.text("No drive is identified, so that there is none."),
    }
    let mut provenance = drawing_of(&answer.before);
    provenance.text("The identification takes lengths and limits as they are.");
    let date = answer.date.as_ref().map_or_else(String::new, |date| format!(", measured {date}"));
    Ok(Report {
        title: format!("Stiffness of the drives of {}", answer.before.full_name()),
        asked: format!("Identified from {}{date}", answer.data),
        headline: answer.headline(),
        sections: vec![decided, fitting, file, provenance, repeated(asked, inputs)?],
    })
}
