//! The verbs with `--model spatial`: all six drives, the tool where it is.

mod drawing;
pub(crate) mod map;
pub(crate) mod place;
pub(crate) mod rank;

use stiffarm::interval::Interval;
use stiffarm::place::{SpatiallyPlaced, Within};
pub(crate) use stiffarm::report::spatial::cell as cell_json;
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::task::Task;

use crate::table::full;

/// A zone that is nearer to the joint-1 axis, m, stands where most robots have their own base.
pub(crate) const COLUMN: f64 = 0.3;

/// The columns of a placement in a spreadsheet.
pub(crate) const CELL_COLUMNS: [&str; 32] = [
    "robot",
    "vendor",
    "architecture",
    "status",
    "task",
    "force_n",
    "feasible",
    "deflection_mm",
    "lower_bound_mm",
    "x_m",
    "z_m",
    "bearing_deg",
    "yaw_deg",
    "angle_deg",
    "roll_deg",
    "shoulder",
    "elbow",
    "wrist",
    "worst_x_m",
    "worst_y_m",
    "worst_z_m",
    "from_axis_1_m",
    "q1_deg",
    "q2_deg",
    "q3_deg",
    "q4_deg",
    "q5_deg",
    "q6_deg",
    "limit_margin_deg",
    "singular_margin_deg",
    "tolerance_mm",
    "pass",
];

/// One placement for a spreadsheet; the joints are those at the worst point.
pub(crate) fn cell_row(
    robot: &Robot,
    task: &Task,
    force: f64,
    placed: &SpatiallyPlaced,
    tolerance_mm: Option<f64>,
) -> Vec<String> {
    let best = placed.feasible();
    let degrees = |angle: Option<f64>| full(angle.map(|angle| angle.to_degrees() + 0.0));
    let word = |words: Option<&str>| words.unwrap_or_default().to_owned();
    let mut row = vec![
        robot.name.clone(),
        robot.vendor.clone(),
        robot.architecture.to_string(),
        robot.status.to_string(),
        task.label.clone(),
        force.to_string(),
        best.is_some().to_string(),
        full(best.map(|best| best.deflection * 1e3)),
        full(best.map(|best| best.lower_bound * 1e3)),
        full(best.map(|best| best.centre[0])),
        full(best.map(|best| best.centre[1])),
        degrees(best.map(|best| best.bearing)),
        degrees(best.map(|best| best.yaw)),
        degrees(best.map(|best| best.angle)),
        degrees(best.map(|best| best.roll)),
        word(best.map(|best| best.configuration.shoulder.name())),
        word(best.map(|best| best.configuration.elbow.name())),
        word(best.map(|best| best.configuration.wrist.name())),
    ];
    row.extend((0..3).map(|axis| full(best.map(|best| best.worst_point[axis]))));
    row.push(full(best.map(|best| best.from_axis_1)));
    row.extend((0..6).map(|joint| degrees(best.map(|best| best.worst_joints[joint]))));
    row.push(degrees(best.map(|best| best.limit_margin.0)));
    row.push(degrees(best.map(|best| best.singular_margin)));
    row.push(full(tolerance_mm));
    row.push(
        tolerance_mm.map_or_else(String::new, |tolerance| {
            best.is_some_and(|best| best.deflection * 1e3 <= tolerance).to_string()
        }),
    );
    row
}

/// The tool axis in words.
pub(crate) fn direction(elevation: f64) -> String {
    let degrees = elevation.to_degrees();
    if (degrees + 90.0).abs() < 1e-9 {
        "tool down".into()
    } else if degrees.abs() < 1e-9 {
        "tool forward".into()
    } else if (degrees - 90.0).abs() < 1e-9 {
        "tool up".into()
    } else {
        let side = if degrees < 0.0 { "below" } else { "above" };
        // As it was typed, not as it came out of radians.
        format!("tool {} deg {side} the horizontal", (degrees.abs() * 1e9).round() / 1e9)
    }
}

/// The tool in words.
pub(crate) fn tool(tool: &Pose) -> String {
    if *tool == Pose::identity() {
        return "the flange".into();
    }
    let v = tool.translation.vector * 1e3;
    let (rx, ry, rz) = tool.rotation.euler_angles();
    let point = format!("{:.1}, {:.1}, {:.1} mm from the flange", v.x + 0.0, v.y + 0.0, v.z + 0.0);
    if tool.rotation.angle() < 1e-12 {
        point
    } else {
        let turned = [rx, ry, rz].map(|angle| format!("{:.2}", angle.to_degrees() + 0.0));
        format!("{point}, turned {} deg", turned.join(", "))
    }
}

/// Where a zone may stand, in words.
pub(crate) fn window(within: &Within) -> String {
    let range = |range: Interval| {
        let end = |x: f64| if x.is_finite() { x.to_string() } else { String::new() };
        format!("{}..{}", end(range.min()), end(range.max()))
    };
    format!("x {} m, z {} m from the base", range(within.x), range(within.z))
}
