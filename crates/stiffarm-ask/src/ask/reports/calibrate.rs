//! The report of `calibrate`: by how much the arm errs, before and after.

use super::Inputs;
use super::said::{figure_size, repeated};
use crate::answer::CalibrateAnswer;
use crate::error::AskError;
use crate::figures::{FigureSize, calibrate as figure};
use crate::report::robots::drawing_of;
use crate::report::{Block, Report, Section};
use crate::request::Request;

/// The document.
///
/// # Errors
/// Where a file is no longer there.
pub(crate) fn of(
    answer: &CalibrateAnswer,
    look: FigureSize,
    (asked, inputs): (&Request, &Inputs),
) -> Result<Report, AskError> {
    let mut decided = Section::new("What decides");
    decided.figure(figure::svg(answer, &figure_size(look)), "The largest error of every row, as drawn and calibrated.");
    decided.heading("The error that remains");
    decided.table(answer.summary());
    decided.heading("What each level leaves");
    decided.table(answer.table());
    if let Some(drives) = answer.drives() {
        decided.heading("Drives, by the arm's own weight");
        decided.table(drives);
    }
    let mut wrong = Section::new("What does not fit");
    match answer.wrong_table() {
        Some(rows) => wrong.table(rows),
        None => wrong.text("No point stands out."),
    }
    let mut file = Section::new("Robot file with the calibration").on_new_page();
    file.blocks.push(Block::Code(answer.robot_file()));
    let mut provenance = drawing_of(&answer.robot);
    provenance.text("The calibration takes these lengths as the drawing from which the arm differs.");
    Ok(Report {
        title: format!("Calibration of {}", answer.robot.full_name()),
        asked: match asked.date() {
            Some(date) => format!("Calibrated from {}, measured {date}", answer.data),
            None => format!("Calibrated from {}; when it was measured is not said (--date)", answer.data),
        },
        headline: answer.headline(),
        sections: vec![decided, wrong, file, provenance, repeated(asked, inputs)?],
    })
}
