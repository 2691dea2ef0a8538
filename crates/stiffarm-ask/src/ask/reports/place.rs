//! The report of `place`: one robot, one zone.

use crate::answer::{Layout, Table};
use crate::request::Request;
use stiffarm::model::ModelKind;

use super::said::{figure_size, meaning, repeated};
use crate::ask::outputs::place::PlaceOutput;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::shop::ShopFigure;
use crate::report::robots::provenance_of;
use crate::report::{Report, Section};

/// The document.
///
/// # Errors
/// Where a figure cannot be made.
pub(crate) fn of(found: &PlaceOutput, asked: &Request) -> Result<Report, AskError> {
    let answer = &found.answer;
    let mut decided = Section::new("What decides");
    match answer.best() {
        Some(_) => picture(found, &mut decided)?,
        None => reached(found, &mut decided),
    }
    decided.table(answer.table());
    let mut sections = vec![decided];
    sections.extend(meaning(asked));
    sections.extend(found.inputs().process()?);
    sections.extend(site(found).map(Section::on_new_page));
    sections.extend([provenance_of(&answer.robot), repeated(asked, found.inputs())?]);
    let which = if answer.is_at_one_place() { "A given place" } else { "Best place" };
    let how = if answer.model == ModelKind::Planar { "planar model" } else { "spatial model, all six drives" };
    Ok(Report {
        title: format!("{} for {}", answer.robot.full_name(), answer.task.label),
        asked: format!("{which} of {} ({}), {how}", answer.task.label, answer.task.work.describe()),
        headline: answer.headline(),
        sections,
    })
}

/// The map with the zone at its place.
pub(crate) fn picture(found: &PlaceOutput, section: &mut Section) -> Result<(), AskError> {
    let answer = &found.answer;
    if answer.best().is_none_or(|best| !best.faces.is_empty()) {
        return Ok(()); // no section shows a part: its shop drawing follows
    }
    let svg = found.figure(figure_size(found.figure_size))?;
    section.figure(
        svg,
        format!(
            "{}: {} {}, on the map of the deflection.",
            answer.robot.full_name(),
            answer.task.label,
            answer.where_it_stands()
        ),
    );
    Ok(())
}

/// The map without a zone, where there is no place; why there is none where nothing is reached.
fn reached(found: &PlaceOutput, section: &mut Section) {
    let name = found.answer.robot.full_name();
    match found.map_alone(figure_size(found.figure_size)) {
        Ok(svg) => section.figure(svg, format!("{name}: the map of the deflection; no place was found on it.")),
        Err(why) => section.text(format!("There is no map: {why}.")),
    }
}

/// Where the work must stand, as a shop drawing has it; nothing where it stands nowhere, or the base is not known.
pub(crate) fn site(found: &PlaceOutput) -> Option<Section> {
    let answer = &found.answer;
    let layout = answer.layout()?;
    Some(standing(&layout, &format!("{} for {}", answer.robot.full_name(), answer.task.label)))
}

/// The drawing, and what is measured in it.
pub(crate) fn standing(layout: &Layout, what: &str) -> Section {
    let mut section = Section::new("Where the work must stand");
    let figure = ShopFigure { layout, figure_size: figure_size(FigureSize::default()) };
    section.figure(
        figure.svg(),
        format!("{what}, from the side and from above; lengths in mm from {}.", layout.base.origin()),
    );
    section.table(Table::of_lines(layout.measured()));
    section
}
