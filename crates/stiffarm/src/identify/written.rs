//! What of an identification does a robot file have?

use nalgebra::Matrix6;

use super::springs::Spring;
use super::{Estimate, Options};
use crate::drive::{GravityCompensator, Identified, JointCompliance};
use crate::robot::{Arm, COMPLIANCE_SOURCE, Robot, StiffnessSource};

/// The robot with what was identified in so many postures, and what that leaves of a coordinate, m.
pub(super) fn robot_with(
    known: &Robot,
    estimates: &[Estimate],
    covariance: &Matrix6<f64>,
    options: &Options,
    (postures, residual): (usize, f64),
) -> Robot {
    let mut robot = known.clone();
    let Arm::SixAxis { drives, .. } = &mut robot.arm else { return robot };
    let mut seen = [false; 6];
    let mut k = drives.compliance.0;
    for estimate in estimates {
        if let Spring::Drive(drive) = estimate.spring {
            (seen[drive], k[drive]) = (estimate.unknown.is_none(), estimate.used);
        }
    }
    if seen == [false; 6] {
        return robot;
    }
    drives.compensator = drives.compensator.map(|known| compensator(known, estimates));
    drives.compliance = JointCompliance(k.map(|k| rounded(k, 1e6)));
    drives.scatter = None;
    drives.identified = Some(Identified {
        drives: seen,
        covariance: as_written(covariance),
        postures,
        date: options.date.clone(),
        residual: rounded(residual, 1e3),
    });
    robot.stiffness_is_assumed = false;
    let drives: Vec<String> = (1..=6).filter(|&drive| seen[drive - 1]).map(|drive| drive.to_string()).collect();
    let others = match (drives.len(), known.stiffness_source()) {
        (6, _) => "",
        (_, StiffnessSource::Prior | StiffnessSource::Published) => "; the others by the prior",
        _ => "; the others as they were before",
    };
    let source = format!(
        "drives {} identified in {postures} postures by {}{others}",
        drives.join(", "),
        options.estimator.name()
    );
    robot.source.insert(COMPLIANCE_SOURCE.into(), source);
    robot
}

/// A compensator with what was found of its spring.
fn compensator(known: GravityCompensator, estimates: &[Estimate]) -> GravityCompensator {
    let found = |spring: Spring| estimates.iter().find(|one| one.spring == spring && one.unknown.is_none());
    let used = |spring: Spring| found(spring).map(|one| one.used);
    let stiffness = used(Spring::Compensator).unwrap_or(known.stiffness);
    let preload = used(Spring::Preload).unwrap_or(known.stiffness * known.free_length);
    let is_sought = estimates.iter().any(|one| one.spring == Spring::Preload);
    let free_length = if is_sought { rounded(preload / stiffness, 1e3) } else { known.free_length };
    GravityCompensator { stiffness: rounded(stiffness, 1e-3), free_length, ..known }
}

/// To ten digits of a number that is so many times as large in a robot file, so that what is written is what is read.
pub(super) fn rounded(x: f64, per: f64) -> f64 {
    let digits = format!("{:.9e}", x * per);
    digits.parse::<f64>().expect("a number that was printed") / per
}

/// A covariance of compliances, (rad/(N m))^2, to ten digits.
pub(super) fn as_written(covariance: &Matrix6<f64>) -> Matrix6<f64> {
    covariance
        .map(|variance| format!("{:.9e}", variance * 1e12).parse::<f64>().expect("a number that was printed") * 1e-12)
}
