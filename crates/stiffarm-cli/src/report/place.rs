//! The report of `place`: one robot, one zone.

use stiffarm::answer::Table;
use stiffarm::model::ModelKind;
use stiffarm::request::Request;

use super::robots::sources;
use super::{Block, Report, Section, plate, repeated};
use crate::commands::place::PlaceOutput;
use crate::failure::Failure;
use crate::figures::Plate;
use crate::figures::shop::ShopFigure;

/// The document.
///
/// # Errors
/// Where a figure cannot be made.
pub(crate) fn of(found: &PlaceOutput, asked: &Request) -> Result<Report, Failure> {
    let answer = &found.answer;
    let mut decided = Section::new("What decides");
    if answer.best().is_some() {
        picture(found, &mut decided)?;
    }
    decided.table(answer.table());
    let mut sections = vec![decided];
    sections.extend(site(found).map(Section::on_new_page));
    let mut provenance = Section::new("Where the numbers come from");
    provenance.blocks.extend(sources(&answer.robot).into_iter().filter(|block| !matches!(block, Block::Heading(_))));
    sections.extend([provenance, repeated(asked)]);
    let how = if answer.model == ModelKind::Planar { "planar model" } else { "spatial model, all six drives" };
    Ok(Report {
        title: format!("{} for {}", answer.robot.full_name(), answer.task.label),
        asked: format!("Best place of {} ({}), {how}", answer.task.label, answer.task.describe()),
        headline: answer.headline(),
        sections,
    })
}

/// The map with the zone at its place.
pub(super) fn picture(found: &PlaceOutput, section: &mut Section) -> Result<(), Failure> {
    let answer = &found.answer;
    if answer.best().is_none_or(|best| !best.faces.is_empty()) {
        return Ok(()); // a part of several faces has no section that shows it
    }
    let svg = found.figure(plate(found.plate))?;
    section.figure(svg, format!("{}: {} at its best place, on the map of the deflection.", answer.robot.full_name(), answer.task.label));
    Ok(())
}

/// Where the work must stand, as a shop drawing has it; nothing where it stands nowhere, or the base is not known.
pub(super) fn site(found: &PlaceOutput) -> Option<Section> {
    let answer = &found.answer;
    let siting = answer.siting()?;
    let mut section = Section::new("Where the work must stand");
    let figure = ShopFigure { title: answer.robot.full_name(), siting: &siting, plate: plate(Plate::default()) };
    section.figure(
        figure.svg(),
        format!("{} for {}, from the side and from above; lengths in mm from {}.", answer.robot.full_name(), answer.task.label, siting.origin),
    );
    section.table(Table::of_lines(siting.lines()));
    Some(section)
}
