//! How is a ranking told?

use serde_json::{Value, json};

use super::{fixed, place};
use crate::drive::Architecture;
use crate::place::PlaceOptions;
use crate::rank::{Ranking, Row};
use crate::robot::Status;

/// Robots in order, and who wins each task.
pub fn ranking(ranking: &Ranking, options: &PlaceOptions, tolerance_mm: Option<f64>) -> Value {
    let Ranking { tasks, force, rows } = ranking;
    let rows = rows.iter().map(|row| {
        let robot = &row.robot;
        let cells = tasks.iter().zip(&row.cells).map(|(task, cell)| match cell {
            Ok(placed) => Value::Object(place::cell(robot, task, options, placed, tolerance_mm)),
            Err(error) => json!({
                "robot": robot.name,
                "task": task.label,
                "model": "planar",
                "force_n": options.force,
                "feasible": Value::Null,
                "reason": error.to_string(),
            }),
        });
        json!({
            "robot": robot.name,
            "vendor": robot.vendor,
            "architecture": robot.architecture.name(),
            "status": robot.status.name(),
            "bound_mm": row.floor(ranking.force).map(|floor| floor * 1e3),
            "mean_ratio": if row.score.is_finite() { json!(row.score) } else { Value::Null },
            "cells": cells.collect::<Value>(),
        })
    });
    let winners = (0..tasks.len()).map(|task| {
        let name = |row: Option<&Row>| row.map(|row| row.robot.name.clone());
        let of = |architecture| name(ranking.best(task, |robot| robot.architecture == architecture));
        json!({
            "task": tasks[task].label,
            "best": name(ranking.best_published(task)),
            "best_with_estimated": name(ranking.best(task, |_| true)),
            "best_serial": of(Architecture::Serial),
            "best_quasi_serial": of(Architecture::QuasiSerial),
        })
    });
    json!({
        "tasks": tasks.iter().map(|task| task.label.clone()).collect::<Vec<_>>(),
        "force_n": force,
        "model": "planar",
        "rows": rows.collect::<Value>(),
        "winners": winners.collect::<Value>(),
        "summary": sentences(ranking, tolerance_mm),
    })
}

/// What a manager would read.
pub fn sentences(ranking: &Ranking, tolerance_mm: Option<f64>) -> Vec<String> {
    let mut sentences = Vec::new();
    let mut winners: Vec<(&Row, Vec<usize>)> = Vec::new();
    for task in 0..ranking.tasks.len() {
        if let Some(best) = ranking.best_published(task) {
            match winners.iter_mut().find(|(row, _)| row.robot == best.robot) {
                Some((_, tasks)) => tasks.push(task),
                None => winners.push((best, vec![task])),
            }
        }
    }
    let won = |row: &Row, tasks: &[usize]| {
        let tasks: Vec<String> = tasks
            .iter()
            .map(|&task| format!("{} ({} mm)", ranking.tasks[task].label, millimetres(row, task)))
            .collect();
        format!("{} for {}", row.robot.full_name(), tasks.join(", "))
    };
    if winners.is_empty() {
        sentences.push("No robot of which all numbers are known can do any of these tasks.".into());
    } else {
        let list: Vec<String> = winners.iter().map(|(row, tasks)| won(row, tasks)).collect();
        sentences.push(format!("Under {} N in the worst direction take {}.", ranking.force, list.join("; ")));
    }
    sentences.extend(by_architecture(ranking));
    sentences.extend(estimated_rivals(ranking));
    sentences.extend(tolerance_mm.map(|tolerance| tolerance_sentence(ranking, tolerance)));
    sentences
}

/// Of a row that has a place for the task.
fn millimetres(row: &Row, task: usize) -> String {
    row.deflection(task).map_or_else(|| "-".to_owned(), |deflection| fixed(deflection * 1e3, 2))
}

fn by_architecture(ranking: &Ranking) -> Option<String> {
    let compared: Vec<(usize, &Row, &Row)> = (0..ranking.tasks.len())
        .filter_map(|task| {
            let best = |architecture| ranking.best(task, |robot| robot.architecture == architecture);
            Some((task, best(Architecture::Serial)?, best(Architecture::QuasiSerial)?))
        })
        .collect();
    if compared.is_empty() {
        return None;
    }
    let cells: Vec<String> = compared
        .iter()
        .map(|&(task, serial, quasi)| {
            let show = |row: &Row| {
                let mark = if row.robot.status == Status::Estimated { "~" } else { "" };
                format!("{}{mark}", millimetres(row, task))
            };
            let sign = if serial.deflection(task) <= quasi.deflection(task) { "<" } else { ">" };
            format!("{} {} {sign} {}", ranking.tasks[task].label, show(serial), show(quasi))
        })
        .collect();
    Some(format!("Best serial against best quasi-serial, mm: {}.", cells.join("; ")))
}

fn estimated_rivals(ranking: &Ranking) -> Option<String> {
    let mut rivals: Vec<(&str, Vec<&str>)> = Vec::new();
    for task in 0..ranking.tasks.len() {
        let Some(best) = ranking.best(task, |_| true) else { continue };
        if best.robot.status != Status::Estimated || ranking.best_published(task).is_none() {
            continue;
        }
        let label = ranking.tasks[task].label.as_str();
        match rivals.iter_mut().find(|(name, _)| *name == best.robot.name) {
            Some((_, tasks)) => tasks.push(label),
            None => rivals.push((&best.robot.name, vec![label])),
        }
    }
    let rivals: Vec<String> =
        rivals.into_iter().map(|(name, tasks)| format!("{name} on {}", tasks.join(", "))).collect();
    (!rivals.is_empty()).then(|| {
        format!("By estimated numbers {} would be stiffer: find its data sheet before you decide.", rivals.join("; "))
    })
}

fn tolerance_sentence(ranking: &Ranking, tolerance: f64) -> String {
    let passing: Vec<String> = ranking
        .rows
        .iter()
        .filter(|row| (0..row.cells.len()).all(|task| row.deflection(task).is_some_and(|d| d * 1e3 <= tolerance)))
        .map(|row| row.robot.name.clone())
        .collect();
    if passing.is_empty() {
        format!("No robot keeps {tolerance} mm on every task.")
    } else {
        format!("{tolerance} mm on every task: {}.", passing.join(", "))
    }
}
