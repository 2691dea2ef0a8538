//! How is a placement in the arm plane told?

use serde_json::{Value, json};

use super::Object;
use crate::place::{Outside, PlaceOptions, Placed};
use crate::robot::Robot;
use crate::task::Task;

/// One zone of one robot; positions from the joint-2 axis.
pub fn cell(robot: &Robot, task: &Task, options: &PlaceOptions, placed: &Placed, tolerance_mm: Option<f64>) -> Object {
    let mut cell = Object::new();
    let mut put = |key: &str, value: Value| drop(cell.insert(key.into(), value));
    put("robot", json!(robot.name));
    put("task", json!(task.label));
    put("model", json!("planar"));
    put("force_n", json!(options.force));
    match placed {
        Placed::Feasible(best) => {
            put("feasible", json!(true));
            put("deflection_mm", json!(best.deflection * 1e3));
            put("lower_bound_mm", json!(best.lower_bound * 1e3));
            put("x_m", json!(best.centre[0]));
            put("z_m", json!(best.centre[1]));
            put("angle_deg", json!(best.angle.to_degrees()));
            put("elbow", json!(best.elbow.name()));
            put("worst_point_m", json!(best.worst_point));
            let outside = Outside::of(robot, task.zone, best);
            put("below_base", json!(outside.below));
            put("behind_axis_1", json!(outside.behind));
            if let Some(tolerance) = tolerance_mm {
                put("tolerance_mm", json!(tolerance));
                put("pass", json!(best.deflection * 1e3 <= tolerance));
                put("margin_mm", json!(tolerance - best.deflection * 1e3));
            }
        }
        Placed::Infeasible { reason, largest_scale } => {
            put("feasible", json!(false));
            put("reason", json!(reason.to_string()));
            put("largest_feasible_scale", json!(largest_scale));
            if let Some(tolerance) = tolerance_mm {
                put("tolerance_mm", json!(tolerance));
                put("pass", json!(false));
            }
        }
    }
    cell
}
