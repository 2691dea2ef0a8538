//! What a figure of a map or of a placement shows beside the answer, for whoever draws it with tools of their own.

use serde_json::{Value, json};
use stiffarm::task::Zone;

use crate::answer::{MapAnswer, stiffness, words};
use crate::forms::Sketch;

/// Of a map: the arm seen from the side, and the sides of the zone.
pub(super) fn of_map(answer: &MapAnswer) -> Sketch {
    let robot = answer.model.robot();
    let sides = answer.zone.as_ref().and_then(|placed| placed.task.work.zone());
    let arm = answer.posture().and_then(|posture| answer.model.points(&posture));
    let shown = json!({
        "title": robot.full_name(),
        "subtitle": format!("{}; {}", words::class(robot), stiffness(robot)),
        "arm_m": arm.map(from_the_side),
        "knows_base": answer.model.knows_base(),
        "zone_sides_m": sides.map(Zone::sides),
        "zone_is_circle": sides.map(Zone::is_round),
    });
    sketched(shown, answer)
}

/// Ahead and up, m.
pub(super) fn from_the_side(points: Vec<[f64; 3]>) -> Vec<[f64; 2]> {
    points.into_iter().map(|[x, _, z]| [x, z]).collect()
}

/// The layers of a map, with what else is shown.
pub(super) fn sketched(shown: Value, answer: &MapAnswer) -> Sketch {
    let grid = &answer.map.deflection;
    let layers = answer.layers().iter().map(|layer| (layer.field.key, layer.cells())).collect();
    Sketch { shown, shape: [grid.z.count, grid.x.count], layers }
}
