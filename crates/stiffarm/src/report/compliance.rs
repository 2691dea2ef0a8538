//! How is the compliance of postures told?

use nalgebra::Vector3;
use serde_json::{Value, json};

use crate::compliance::Posture;
use crate::robot::Robot;
use crate::spatial::Wrench;

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
