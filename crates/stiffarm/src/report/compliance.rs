//! How is the compliance of postures told?

use nalgebra::Vector3;
use serde_json::{Value, json};

use crate::batch::{RowError, Units, matrices_of_rows, worst_of_rows};
use crate::compliance::Posture;
use crate::robot::Robot;
use crate::spatial::{Pose, Wrench};

/// In which many postures are told: joint angles in degrees, compliances in um/N.
const TOLD: Units = Units { angle: std::f64::consts::PI / 180.0, compliance: 1e-6 };

/// One posture, given by the joint angles that the robot reports, deg; with a force, N, the deflection under it.
pub fn posture(robot: &Robot, joints_deg: &[f64; 6], posture: &Posture, force: Option<&Vector3<f64>>) -> Value {
    let rows = |size: usize, at: &dyn Fn(usize, usize) -> f64| -> Value {
        (0..size).map(|i| (0..size).map(|j| at(i, j)).collect::<Value>()).collect()
    };
    let (translation, whole) = (posture.compliance.translation(), posture.compliance.0);
    let (_, worst) = posture.compliance.worst();
    let mut answer = json!({
        "robot": robot.name,
        "model": "spatial",
        "joints_deg": joints_deg,
        "tcp_m": posture.tool.translation.vector.as_slice(),
        "compliance_um_per_n": rows(3, &|i, j| translation[(i, j)] * 1e6),
        "compliance_6x6_si": rows(6, &|i, j| whole[(i, j)]),
        "principal_um_per_n": posture.compliance.principal().map(|(value, _)| value * 1e6),
        "worst_direction": worst.as_slice(),
        "worst_shares": posture.shares(&worst),
    });
    if let Some(force) = force {
        let (moved, turned) = posture.compliance.deflection(&Wrench::force(*force));
        answer["force_n"] = json!(force.as_slice());
        answer["deflection_mm"] = json!((moved * 1e3).as_slice());
        answer["rotation_mrad"] = json!((turned * 1e3).as_slice());
    }
    answer
}

/// The largest translation per force in any direction, um/N, at many postures, given by the joint angles that the robot
/// reports, deg; see [`worst_of_rows`].
///
/// # Errors
/// The first posture that cannot be evaluated. Joint limits are not checked here.
///
/// # Panics
/// Where there are not as many answers as postures.
pub fn worst_um_per_n(
    robot: &Robot,
    flange_from_tool: &Pose,
    joints_deg: &[[f64; 6]],
    found: &mut [f64],
) -> Result<(), RowError> {
    worst_of_rows(robot, flange_from_tool, joints_deg, TOLD, found)
}

/// The block from force to translation, um/N, base axes, at many postures; see [`matrices_of_rows`].
///
/// # Errors
/// As [`worst_um_per_n`].
///
/// # Panics
/// As [`worst_um_per_n`].
pub fn matrices_um_per_n(
    robot: &Robot,
    flange_from_tool: &Pose,
    joints_deg: &[[f64; 6]],
    found: &mut [[f64; 9]],
) -> Result<(), RowError> {
    matrices_of_rows(robot, flange_from_tool, joints_deg, TOLD, found)
}
