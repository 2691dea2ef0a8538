//! What of an identification does a robot file have?

use nalgebra::Matrix6;

use super::springs::Spring;
use super::{Estimate, Options};
use crate::drive::{GravityCompensator, Identified, JointCompliance};
use crate::robot::{Arm, COMPLIANCE_SOURCE, Robot, StiffnessSource};

/// How a fit stands to what was measured, root mean squares of a coordinate, m.
#[derive(Clone, Copy)]
pub(super) struct Fitness {
    /// In so many postures.
    pub(super) postures: usize,
    /// How far it moved.
    pub(super) moved: f64,
    /// What the compliances that are used leave.
    pub(super) residual: f64,
    /// What each posture is missed by with those that the others show.
    pub(super) left_out: Option<f64>,
}

impl Fitness {
    /// As a robot file has it.
    pub(super) fn identified(self, drives: [bool; 6], covariance: &Matrix6<f64>, date: Option<&String>) -> Identified {
        Identified {
            drives,
            covariance: as_written(covariance),
            postures: self.postures,
            date: date.cloned(),
            residual: rounded(self.residual, 1e3),
            left_out: self.left_out.map(|left_out| rounded(left_out, 1e3)),
            moved: Some(rounded(self.moved, 1e3)),
        }
    }
}

/// The robot with what was identified.
pub(super) fn robot_with(
    known: &Robot,
    estimates: &[Estimate],
    covariance: &Matrix6<f64>,
    options: &Options,
    fitness: Fitness,
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
    drives.identified = Some(fitness.identified(seen, covariance, options.date.as_ref()));
    robot.stiffness_is_assumed = false;
    let drives: Vec<String> = (1..=6).filter(|&drive| seen[drive - 1]).map(|drive| drive.to_string()).collect();
    let others = match (drives.len(), known.stiffness_source()) {
        (6, _) => "",
        (_, StiffnessSource::Prior | StiffnessSource::Published) => "; the others by the prior",
        _ => "; the others as they were before",
    };
    let source = format!(
        "drives {} identified in {} postures by {}{others}",
        drives.join(", "),
        fitness.postures,
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
    let is_unknown = estimates.iter().any(|one| one.spring == Spring::Preload);
    let free_length = if is_unknown { rounded(preload / stiffness, 1e3) } else { known.free_length };
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
