//! The report of `rank`: which robot, and a part for each of the best.

use crate::answer::{PlaceAnswer, RankAnswer, StudyAnswer, Table};
use crate::request::Request;
use stiffarm::model::ModelKind;
use stiffarm::place::Placed;
use stiffarm::rank::{Ranking, Row};
use stiffarm::study::{StudyOptions, study};
use stiffarm::task::{Task, Zone};

use super::place;
use super::said::{figure_size, meaning, repeated};
use crate::ask::outputs::place::PlaceOutput;
use crate::ask::outputs::rank::{RankOutput, shapes};
use crate::ask::study::StudyOutput;
use crate::error::AskError;
use crate::report::robots::provenance;
use crate::report::{Block, Listing, Report, Section};

/// So many robots have a part of their own.
const MOST_PARTS: usize = 10;
/// Points along the longer side of their maps: ten of them must fit a letter.
const MAP_POINTS: usize = 200;

/// The document.
///
/// # Errors
/// Where a figure cannot be made.
pub(crate) fn of(found: &RankOutput, asked: &Request) -> Result<Report, AskError> {
    let answer = &found.answer;
    let Ranking { tasks, rows, model, .. } = &answer.ranking;
    let labels: Vec<&str> = tasks.iter().map(|task| task.label.as_str()).collect();
    let (mut sections, inputs) = (vec![deciding(found)?], found.inputs());
    sections.extend(meaning(asked));
    sections.extend(inputs.process()?);
    let parts = with_parts(answer);
    for &at in &parts {
        sections.push(robot(found, (at, &rows[at]), asked)?);
    }
    let left = rows.len() - parts.len();
    if 0 < left {
        let mut others = Section::new("The others");
        others.text(format!(
            "{left} more robots have no part of their own here; they stand in the ranking above, and -o ranking.csv writes all that is known of them."
        ));
        sections.push(others);
    }
    sections.extend(boundary(answer, found)?);
    let (detailed, others): (Vec<usize>, Vec<usize>) = (0..rows.len()).partition(|at| parts.contains(at));
    let robots = |of: Vec<usize>| of.into_iter().map(|at| &rows[at].robot).collect::<Vec<_>>();
    sections.extend([provenance(&robots(detailed), &robots(others)), repeated(asked, &inputs)?]);
    let how = if *model == ModelKind::Planar { "planar model" } else { "spatial model, all six drives" };
    Ok(Report {
        title: match rows.as_slice() {
            [row] => format!("{} for {}", row.robot.full_name(), labels.join(", ")),
            rows => format!("Which of {} robots for {}?", rows.len(), labels.join(", ")),
        },
        asked: format!("Ranking by the worst deflection at the best place of each task, {how}"),
        headline: answer.headline(),
        sections,
    })
}

/// Which robots have a part of their own: who is best at some task, then the first, in their order.
fn with_parts(answer: &RankAnswer) -> Vec<usize> {
    let ranking = &answer.ranking;
    let is_best = |row: &Row| {
        (0..ranking.tasks.len()).any(|task| answer.best_published(task).is_some_and(|best| best.robot == row.robot))
    };
    let (best, others): (Vec<usize>, Vec<usize>) = (0..ranking.rows.len()).partition(|&at| is_best(&ranking.rows[at]));
    let mut parts: Vec<usize> = best.into_iter().chain(others).take(MOST_PARTS).collect();
    parts.sort_unstable();
    parts
}

/// The ranking without the columns that tell places, where there are several: these stand in each robot's part.
fn without_places(answer: &RankAnswer) -> Table {
    let mut table = answer.table();
    let places = answer.place_headings();
    for at in (0..table.headings.len()).rev().filter(|_| 1 < places.len()) {
        if places.contains(&table.headings[at]) {
            table.headings.remove(at);
            table.rows.iter_mut().for_each(|row| drop(row.remove(at)));
        }
    }
    table
}

/// The picture of all, the ranking, and what its marks mean.
fn deciding(found: &RankOutput) -> Result<Section, AskError> {
    let answer = &found.answer;
    let mut section = Section::new("What decides");
    let caption = match answer.ranking.model {
        ModelKind::Planar => "Worst deflection at the best place against the size of the task.",
        ModelKind::Spatial(_) => "Worst deflection at the best place of each task, with what is proved.",
    };
    section.figure(found.figure(figure_size(found.figure_size))?, caption);
    section.heading("Ranking");
    section.notes(answer.heading().lines());
    section.blocks.push(Block::Table(Listing { table: without_places(answer), is_sortable: true }));
    section.notes(answer.notes().lines());
    Ok(section)
}

/// One robot on every task, and its place for the one that it does worst.
fn robot(found: &RankOutput, (at, row): (usize, &Row), asked: &Request) -> Result<Section, AskError> {
    let answer = &found.answer;
    let rank = row.rank.map_or_else(String::new, |rank| format!("{rank}  "));
    let mut section = Section::new(format!("{rank}{}", row.robot.full_name())).on_new_page();
    section.table(answer.table_of(at));
    let Some(task) = hardest(row) else {
        section.notes(answer.why_not(at));
        return Ok(section);
    };
    if 1 < answer.ranking.tasks.len() {
        section.text(format!(
            "What follows is of {}, the task of those it can do on which it gives way most.",
            answer.ranking.tasks[task].label
        ));
    }
    let output = placed(found, (at, task), asked)?;
    place::picture(&output, &mut section)?;
    section.table(output.answer.table());
    if let Some(site) = place::site(&output) {
        section.heading("Where the work must stand");
        section.blocks.extend(site.blocks);
    }
    Ok(section)
}

/// The task on which a robot gives way most.
fn hardest(row: &Row) -> Option<usize> {
    let deflections = (0..row.cells.len()).filter_map(|task| Some((task, row.deflection(task)?)));
    deflections.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(task, _)| task)
}

/// A cell of the ranking as the answer of `place` that it is.
fn placed(found: &RankOutput, (at, task): (usize, usize), asked: &Request) -> Result<PlaceOutput, AskError> {
    let RankAnswer { ranking: Ranking { tasks, rows, model: kind, .. }, options, tolerance_mm, .. } = &found.answer;
    let row = &rows[at];
    let failure = |error| AskError::Place { robot: row.robot.name.clone(), error };
    let placed: Placed = row.cells[task].clone().map_err(failure)?;
    let answer = PlaceAnswer {
        robot: row.robot.clone(),
        model: *kind,
        task: tasks[task].clone(),
        options: *options,
        placed,
        tolerance_mm: *tolerance_mm,
        advice: found.answer.advice.get(at).and_then(|of_row| of_row.get(task)?.clone()),
    };
    PlaceOutput::of_answer(answer, (asked, found.inputs()), (found.figure_size, MAP_POINTS))
}

/// Which architecture suits which size, where the planar model of the paper says that.
fn boundary(answer: &RankAnswer, found: &RankOutput) -> Result<Option<Section>, AskError> {
    let Ranking { tasks, load, model, .. } = &answer.ranking;
    if *model != ModelKind::Planar || !load.is_worst() {
        return Ok(None);
    }
    let tasks: Vec<Task<Zone>> = shapes(tasks).into_iter().map(|(shape, _)| shape).collect();
    let study = StudyAnswer(study(&StudyOptions { tasks, ..StudyOptions::paper() })?);
    let mut section = Section::new("Serial or quasi-serial?").on_new_page();
    section.text("Which architecture suits which size, for arms without joint limits whose drives are all alike: below each boundary one of them gives way less, above it the other.");
    section.notes(
        study.notes().lines().map(str::to_owned).filter(|line| line.contains("best ratio") || !line.contains("mu =")),
    );
    let drawn = StudyOutput(study, figure_size(found.figure_size)).figure()?;
    section.figure(drawn, "Where the better architecture changes, over the link ratio and the size of the task.");
    Ok(Some(section))
}
