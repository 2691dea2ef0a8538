//! How are placements and rankings in space told?

use serde_json::{Value, json};

use super::Object;
use crate::interval::Interval;
use crate::place::{SpatialOptions, SpatiallyPlaced};
use crate::rank::{Ranking, Row};
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::task::Task;

/// One zone of one robot; positions from the base.
pub fn cell(
    robot: &Robot,
    task: &Task,
    options: &SpatialOptions,
    placed: &SpatiallyPlaced,
    tolerance_mm: Option<f64>,
) -> Object {
    let mut cell = Object::new();
    let mut put = |key: &str, value: Value| drop(cell.insert(key.into(), value));
    put("robot", json!(robot.name));
    put("task", json!(task.label));
    put("model", json!("spatial"));
    put("force_n", json!(options.force));
    put("tool_mm", json!(tool_mm(&options.flange_from_tool)));
    put("tool_direction_deg", json!(options.elevation.to_degrees()));
    put("within_m", json!([options.within.x, options.within.z].map(ends)));
    match placed {
        SpatiallyPlaced::Feasible(best) => {
            put("feasible", json!(true));
            put("deflection_mm", json!(best.deflection * 1e3));
            put("lower_bound_mm", json!(best.lower_bound * 1e3));
            put("x_m", json!(best.centre[0]));
            put("z_m", json!(best.centre[1]));
            put("bearing_deg", json!(best.bearing.to_degrees()));
            put("yaw_deg", json!(best.yaw.to_degrees()));
            put("angle_deg", json!(best.angle.to_degrees()));
            put("roll_deg", json!(best.roll.to_degrees()));
            put("shoulder", json!(best.configuration.shoulder.name()));
            put("elbow", json!(best.configuration.elbow.name()));
            put("wrist", json!(best.configuration.wrist.name()));
            put("worst_point_m", json!(best.worst_point));
            put("from_axis_1_m", json!(best.from_axis_1));
            put("worst_joints_deg", json!(best.worst_joints.map(f64::to_degrees)));
            put("worst_shares", json!(best.worst_shares));
            put("limit_margin_deg", json!(best.limit_margin.0.to_degrees()));
            put("limit_margin_joint", json!(best.limit_margin.1));
            put("singular_margin_deg", json!(best.singular_margin.to_degrees()));
            let found = &best.resolution;
            put(
                "resolution",
                json!({
                    "coarse_step_m": found.coarse_step, "coarse_mm": (found.coarse.is_finite()).then_some(found.coarse * 1e3),
                    "fine_step_m": found.fine_step, "fine_turn_deg": found.fine_turn.to_degrees(),
                    "sample_step_m": found.sample_step, "samples": found.samples, "halving": found.halving, "boxes": found.boxes,
                }),
            );
        }
        SpatiallyPlaced::Infeasible { reason, is_proved } => {
            put("feasible", json!(false));
            put("reason", json!(reason.to_string()));
            put("proved", json!(is_proved));
        }
    }
    if let Some(tolerance) = tolerance_mm {
        let best = placed.feasible().map(|best| best.deflection * 1e3);
        put("tolerance_mm", json!(tolerance));
        put("pass", json!(best.is_some_and(|best| best <= tolerance)));
        if let Some(best) = best {
            put("margin_mm", json!(tolerance - best));
        }
    }
    cell
}

/// As `--tool-mm` takes it: x, y, z, mm, and the turns about fixed axes, deg.
pub(super) fn tool_mm(tool: &Pose) -> [f64; 6] {
    let (rx, ry, rz) = tool.rotation.euler_angles();
    let [x, y, z] = tool.translation.vector.map(|metres| metres * 1e3).into();
    [x, y, z, rx.to_degrees(), ry.to_degrees(), rz.to_degrees()].map(|part| part + 0.0)
}

/// Both ends of a range; none where it is open.
fn ends(range: Interval) -> [Option<f64>; 2] {
    [range.min(), range.max()].map(|end| end.is_finite().then_some(end))
}

/// Robots in order, with their place in the planar ranking of the same robots and tasks.
pub fn ranking(
    ranking: &Ranking<SpatiallyPlaced>,
    planar: &Ranking,
    options: &SpatialOptions,
    tolerance_mm: Option<f64>,
) -> Value {
    let Ranking { tasks, force, rows } = ranking;
    let rows = rows.iter().zip(ranking.places()).map(|(row, place)| {
        let robot = &row.robot;
        let cells = tasks
            .iter()
            .zip(&row.cells)
            .map(|(task, placed)| Value::Object(cell(robot, task, options, placed, tolerance_mm)));
        json!({
            "robot": robot.name,
            "vendor": robot.vendor,
            "architecture": robot.architecture.name(),
            "architecture_assumed": robot.architecture_is_assumed,
            "status": robot.status.name(),
            "place": place,
            "planar_place": planar.place_of(robot),
            "mean_ratio": row.score.is_finite().then_some(row.score),
            "cells": cells.collect::<Value>(),
        })
    });
    json!({
        "tasks": tasks.iter().map(|task| task.label.clone()).collect::<Vec<_>>(),
        "force_n": force,
        "model": "spatial",
        "rows": rows.collect::<Value>(),
        "summary": sentences(ranking, planar, tolerance_mm),
    })
}

/// What a manager would read.
pub fn sentences(ranking: &Ranking<SpatiallyPlaced>, planar: &Ranking, tolerance_mm: Option<f64>) -> Vec<String> {
    let Ranking { tasks, force, .. } = ranking;
    let name = |robot: Option<&Robot>| {
        robot.map_or_else(|| "no robot (none without assumed numbers holds it)".to_owned(), Robot::full_name)
    };
    let mut sentences = Vec::new();
    for (i, task) in tasks.iter().enumerate() {
        let best = ranking.best_published(i);
        let spatial = best.map(|row| &row.robot);
        let planar = planar.best_published(i).map(|row| &row.robot);
        let value =
            best.and_then(|row| row.deflection(i)).map_or_else(String::new, |d| format!(" ({:.2} mm)", d * 1e3));
        let other = if spatial == planar {
            String::new()
        } else {
            format!("; the planar model alone would take {}", name(planar))
        };
        sentences.push(format!("{} under {force} N: take {}{value}{other}.", task.label, name(spatial)));
    }
    if let Some(tolerance) = tolerance_mm {
        let all = |row: &&Row<SpatiallyPlaced>| {
            (0..tasks.len()).all(|task| row.deflection(task).is_some_and(|d| d * 1e3 <= tolerance))
        };
        let passing: Vec<String> = ranking.rows.iter().filter(all).map(|row| row.robot.name.clone()).collect();
        sentences.push(if passing.is_empty() {
            format!("No robot keeps {tolerance} mm on every task.")
        } else {
            format!("{tolerance} mm on every task: {}.", passing.join(", "))
        });
    }
    sentences
}
