//! How do the drives yield under the arm's own weight, where its masses are known?

use nalgebra::{Matrix6, Vector6};

use crate::drive::{Architecture, GravityCompensator};
use crate::geometry::Geometry;
use crate::mass::{Carrier, Mass, gravity_torques, links_without};
use crate::robot::{Arm, Robot};

/// What weighs, and how compliant the drives are that hold it.
#[derive(Clone, Debug)]
pub(crate) struct Weighing {
    masses: Vec<Mass>,
    compensator: Option<GravityCompensator>,
    /// Of each drive, rad/(N m).
    pub(crate) compliance: [f64; 6],
}

impl Weighing {
    /// Of a robot whose drives are so compliant, rad/(N m); `None` where a link has no mass, or a parallelogram no rod or counterweight.
    pub(crate) fn of(robot: &Robot, compliance: [f64; 6]) -> Option<Self> {
        let Arm::SixAxis { drives, .. } = &robot.arm else { return None };
        let has = |of: fn(&Carrier) -> bool| robot.masses.iter().any(|mass| of(&mass.carrier));
        let is_whole = robot.architecture == Architecture::Serial
            || has(|carrier| matches!(carrier, Carrier::Rod { .. }))
                && has(|carrier| *carrier == Carrier::Counterweight);
        let weighs = is_whole && links_without(&robot.masses).is_empty();
        weighs.then(|| Self { masses: robot.masses.clone(), compensator: drives.compensator, compliance })
    }

    /// How far weight turns each drive where its base stands upright, rad, at model angles: `k (A^T tau)`, of the arm as drawn.
    pub(super) fn yields(&self, geometry: &Geometry, transmission: &Matrix6<f64>, theta: &[f64; 6]) -> Vector6<f64> {
        let mut torques = transmission.transpose() * gravity_torques(geometry, theta, &self.masses);
        torques[1] += self.compensator.map_or(0.0, |spring| spring.torque(theta[1]));
        torques.component_mul(&Vector6::from(self.compliance))
    }
}
