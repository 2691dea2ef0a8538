//! The report of robots on a path: which one, and a part for each of the first.

use crate::answer::MillAnswer;
use crate::request::Request;

use super::mill;
use super::said::{figure_size, meaning, repeated};
use crate::ask::outputs::path_ranking::PathRankOutput;
use crate::error::AskError;
use crate::report::robots::provenance;
use crate::report::{Block, Listing, Report, Section};

/// So many robots have a part of their own.
const MOST_PARTS: usize = 10;

/// The document.
///
/// # Errors
/// Where the rolls beside a path cannot be computed.
pub(crate) fn of(found: &PathRankOutput, asked: &Request) -> Result<Report, AskError> {
    let answer = &found.answer;
    let mut decided = Section::new("What decides");
    decided.figure(
        found.figure(figure_size(found.figure_size)),
        "Largest error along the path of each robot at its best place and rolls, with what is proved.",
    );
    decided.heading("Ranking");
    decided.notes(answer.heading().lines());
    decided.blocks.push(Block::Table(Listing { table: answer.table(), is_sortable: true }));
    decided.notes(answer.notes().lines().filter(|line| !line.is_empty()));
    let mut sections = vec![decided];
    sections.extend(meaning(asked));
    sections.extend(found.inputs.process()?);
    let milled = answer.rows.iter().filter_map(|row| Some((row, row.milled.as_ref().ok()?)));
    for (row, milled) in milled.take(MOST_PARTS) {
        let rank = row.standing.rank.map_or_else(String::new, |rank| format!("{rank}  "));
        let mut section = Section::new(format!("{rank}{}", row.robot.full_name())).on_new_page();
        mill::picture(milled, found.figure_size, &mut section)?;
        section.table(milled.table());
        worst(milled, &mut section);
        if let Some(site) = mill::site(milled) {
            section.heading("Where the work must stand");
            section.blocks.extend(site.blocks);
        }
        sections.push(section);
    }
    let robots: Vec<_> = answer.rows.iter().map(|row| &row.robot).collect();
    let (detailed, others) = robots.split_at(MOST_PARTS.min(robots.len()));
    sections.extend([provenance(detailed, others), repeated(asked, &found.inputs)?]);
    Ok(Report {
        title: format!("Which of {} robots for {}?", robots.len(), answer.path),
        asked: format!("Ranking by the largest error along the path; {}", answer.force()),
        headline: answer.headline(),
        sections,
    })
}

/// Where the error of a robot is largest.
fn worst(milled: &MillAnswer, section: &mut Section) {
    if let Some(table) = milled.worst_lines() {
        section.heading("Where the error is largest");
        section.table(table);
    }
}
