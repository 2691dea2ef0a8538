//! How do the drives yield under the arm's own weight, where its masses are known?

use nalgebra::{Matrix6, Point3, Vector6};

use crate::drive::{Architecture, Drives, GravityCompensator};
use crate::geometry::Geometry;
use crate::mass::{Carrier, Mass, RigidBody, ToolWeight, gravity_torques, missing_for_weight};
use crate::robot::{Arm, Robot};

/// What weighs, and how compliant the drives are that hold it.
#[derive(Clone, Debug)]
pub(crate) struct Weighing {
    masses: Vec<Mass>,
    compensator: Option<GravityCompensator>,
    /// Of each drive, rad/(N m).
    compliance: [f64; 6],
}

impl Weighing {
    /// Of a robot whose drives are so compliant, rad/(N m); `None` where a link has no mass, or a parallelogram no rod or counterweight.
    pub(crate) fn of(robot: &Robot, compliance: [f64; 6]) -> Option<Self> {
        let Arm::SixAxis { drives, .. } = &robot.arm else { return None };
        let is_whole = missing_for_weight(robot.architecture == Architecture::QuasiSerial, &robot.masses).is_none();
        is_whole.then(|| Self { masses: robot.masses.clone(), compensator: drives.compensator, compliance })
    }

    /// How far weight turns each drive where its base stands upright, rad, at model angles: `k (A^T tau)`, of the arm as drawn.
    pub(super) fn yields(&self, geometry: &Geometry, transmission: &Matrix6<f64>, theta: &[f64; 6]) -> Vector6<f64> {
        let mut torques = transmission.transpose() * gravity_torques(geometry, theta, &self.masses);
        torques[1] += self.compensator.map_or(0.0, |spring| spring.torque(theta[1]));
        torques.component_mul(&Vector6::from(self.compliance))
    }
}

/// A tool that bends the drives by its weight, beside what the arm weighs itself.
#[derive(Clone, Debug)]
pub(super) struct Held {
    mass: [Mass; 1],
    drives: Drives,
}

impl Held {
    /// At the flange of a robot; `None` where nobody knows its centre, and of two links.
    pub(super) fn of(robot: &Robot, tool: &ToolWeight) -> Option<Self> {
        let (Arm::SixAxis { geometry, drives, .. }, Some(centre)) = (&robot.arm, tool.centre) else { return None };
        // As masses are stated: from the base at model zero.
        let centre = (geometry.forward(&[0.0; 6]) * Point3::from(centre)).coords;
        let mass = Mass { carrier: Carrier::Link(6), body: RigidBody::point(tool.mass, centre) };
        Some(Self { mass: [mass], drives: drives.clone() })
    }

    /// How far it turns each joint where the base stands upright, rad, at model angles: `A k (A^T tau)`.
    pub(super) fn yields(&self, geometry: &Geometry, theta: &[f64; 6]) -> Vector6<f64> {
        let transmission = self.drives.transmission.0;
        let torques = transmission.transpose() * gravity_torques(geometry, theta, &self.mass);
        // A posture that a compensator does not hold is refused where it is loaded.
        let compliance = self.drives.compliance_at(theta[1]).unwrap_or(self.drives.compliance.0);
        transmission * torques.component_mul(&Vector6::from(compliance))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::catalogue::find;
    use crate::drive::Transmission;
    use crate::mass::GRAVITY;

    /// By how much the height of a body of the forearm changes with each drive of a parallelogram: the forearm keeps its direction where drive 2 turns.
    #[test]
    fn drives_of_a_parallelogram_yield_as_the_height_of_the_forearm_changes_with_them() {
        let mut robot = find("KR 210 R2700-2").unwrap().robot();
        robot.architecture = Architecture::QuasiSerial;
        let transmission = Transmission::of(Architecture::QuasiSerial).0;
        let dust = |carrier| Mass { carrier, body: RigidBody::point(1e-9, Vector3::zeros()) };
        let links = (1..=6).map(|link| dust(Carrier::Link(link)));
        let parallelogram = [Carrier::Rod { crank: [-0.3, 0.0] }, Carrier::Counterweight].map(dust);
        let (mass, centre) = (300.0, Vector3::new(0.6, 0.1, 2.0));
        let forearm = Mass { carrier: Carrier::Link(3), body: RigidBody::point(mass, centre) };
        robot.masses = links.chain([forearm]).collect();
        assert!(Weighing::of(&robot, [1e-6; 6]).is_none(), "rod and counterweight are missing");
        robot.masses.extend(parallelogram);
        let k = [1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6];
        let weighing = Weighing::of(&robot, k).unwrap();
        let Arm::SixAxis { geometry, .. } = &robot.arm else { panic!("six axes") };
        let theta = [0.3, 0.4, 0.9, 0.1, 0.5, -0.2];
        let found = weighing.yields(geometry, &transmission, &theta);
        for drive in 0..6 {
            let height = |step: f64| {
                let moved: [f64; 6] = std::array::from_fn(|joint| theta[joint] + transmission[(joint, drive)] * step);
                (geometry.links(&moved)[2] * Point3::from(centre)).z
            };
            let torque = -mass * GRAVITY * (height(1e-5) - height(-1e-5)) / 2e-5;
            assert!((found[drive] - k[drive] * torque).abs() < 1e-10, "drive {}: {found}", drive + 1);
        }
        assert!(1e-4 < found[1].abs() && 1e-4 < found[2].abs(), "{found}");
    }
}
