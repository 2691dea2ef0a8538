//! The report of `mill`: whether a path holds its tolerance, and where it does not.

use crate::answer::MillAnswer;
use crate::request::Request;

use super::place;
use super::said::{figure_size, meaning, repeated};
use crate::ask::outputs::mill::{MillOutput, rolls};
use crate::error::AskError;
use crate::figures::milled::MilledFigure;
use crate::figures::{FigureSize, lobes};
use crate::report::robots::provenance_of;
use crate::report::{Report, Section};

/// The document.
///
/// # Errors
/// Where the rolls beside the path cannot be computed.
pub(crate) fn of(found: &MillOutput, asked: &Request) -> Result<Report, AskError> {
    let answer = &found.answer;
    let mut decided = Section::new("What decides");
    picture(answer, found.figure_size, &mut decided)?;
    decided.table(answer.table());
    let (mut sections, inputs) = (vec![decided], found.inputs());
    sections.extend(meaning(asked));
    sections.extend(inputs.process()?);
    sections.extend(site(answer).map(Section::on_new_page));
    sections.extend(answer.worst_lines().map(|table| {
        let mut worst = Section::new("Where the error is largest");
        worst.text("The worst sample of each line of the path, the worst line first.");
        worst.table(table);
        worst
    }));
    sections.extend(answer.drives_table().map(|table| {
        let mut drives = Section::new("Which drive gives way");
        drives.table(table);
        drives
    }));
    sections.extend(swings(answer, found.figure_size));
    sections.extend([provenance_of(&answer.robot), repeated(asked, &inputs)?]);
    Ok(Report {
        title: format!("{} along {}", answer.robot.full_name(), answer.along()),
        asked: format!("How far the tool is pushed off; {}", answer.force),
        headline: answer.headline(),
        sections,
    })
}

/// Whether the cuts swing, where that was asked.
fn swings(answer: &MillAnswer, asked: FigureSize) -> Option<Section> {
    let verdict = answer.chatter_verdict()?;
    let mut section = Section::new("Whether the cuts swing with the arm");
    section.text(format!("{verdict}. A robot that is calm says nothing of spindle, holder, cutter and work."));
    if let Some((_, found)) = answer.chatter.as_ref().and_then(|chatter| chatter.worst.as_ref()) {
        section.figure(
            lobes::svg(found, &figure_size(asked)),
            "From which depth the cut at the worst sample swings, over the speed of the spindle.",
        );
    }
    section.table(answer.chatter_table());
    Some(section)
}

/// Error, rolls and path; nothing where it is not followed.
pub(crate) fn picture(answer: &MillAnswer, asked: FigureSize, section: &mut Section) -> Result<(), AskError> {
    if answer.followed().is_some() {
        let svg = MilledFigure { answer, rolls: &rolls(answer)?, figure_size: figure_size(asked) }.svg();
        section.figure(
            svg,
            "The error along the path, every roll of the tool with what forbids the others, and the path from above.",
        );
    }
    Ok(())
}

/// Where the part must stand; nothing where it stands nowhere, or the base is not known.
pub(crate) fn site(answer: &MillAnswer) -> Option<Section> {
    answer.followed()?;
    let layout = answer.layout()?;
    Some(place::standing(&layout, &format!("{} along {}", answer.robot.full_name(), answer.along())))
}
