//! What is a robot, and what is its arm plane?

use std::collections::BTreeMap;

use crate::drive::{Architecture, Drives};
use crate::geometry::Geometry;
use crate::limits::{Limits, Range, ThirdAxis};
use crate::plane::PlanarArm;

/// How well a robot's numbers are known; shown wherever the robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Measured on the machine.
    Identified,
    /// Published for this very model.
    DataSheet,
    /// Partly published, the rest follows from published figures of this or a sister model.
    Derived,
    /// Partly assumed.
    Estimated,
}

impl Status {
    /// All, the best first.
    pub const ALL: [Self; 4] = [Self::Identified, Self::DataSheet, Self::Derived, Self::Estimated];

    /// The name that robot files and reports use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Identified => "identified",
            Self::DataSheet => "data-sheet",
            Self::Derived => "derived",
            Self::Estimated => "estimated",
        }
    }
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// A robot: geometry, drives, limits and pedigree.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The maker's name for it.
    pub name: String,
    /// The maker; empty where none is known.
    pub vendor: String,
    /// Serial or quasi-serial.
    pub architecture: Architecture,
    /// Nothing says that it is: no parallelogram is reported, or one is guessed from the family.
    pub architecture_is_assumed: bool,
    /// How well the numbers are known.
    pub status: Status,
    /// Nominal payload, kg.
    pub payload_kg: Option<f64>,
    /// Reach by the data sheet, m (from the joint 1 axis, as makers state it).
    pub reach: Option<f64>,
    /// Mass of the arm, kg.
    pub mass_kg: Option<f64>,
    /// Repeatability by the data sheet, m.
    pub repeatability: Option<f64>,
    /// What moves.
    pub arm: Arm,
    /// Where each group of numbers comes from.
    pub source: BTreeMap<String, String>,
}

/// What is known of the arm itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Arm {
    /// Six axes with a spherical wrist.
    SixAxis {
        /// Lengths, offsets, signs.
        geometry: Geometry,
        /// Ranges as the maker states them.
        limits: Limits,
        /// What holds the joints.
        drives: Drives,
    },
    /// Only the paper's two links.
    Planar(PlanarArm),
}

/// A robot reduced to the two links of the paper, and where its joint-2 axis stands.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmPlane {
    /// The two links.
    pub arm: PlanarArm,
    /// The joint-2 axis from the base, forwards and up, m; zero for a robot of which only the plane is known.
    pub axis_from_base: [f64; 2],
}

impl Robot {
    /// Maker and name, or the name alone where no maker is known.
    pub fn full_name(&self) -> String {
        format!("{} {}", self.vendor, self.name).trim().into()
    }

    /// Joint 1 axis to wrist centre with both links straight ahead, m: `a1 + l2 + l3`.
    pub fn stretch(&self) -> f64 {
        match &self.arm {
            Arm::SixAxis { geometry, .. } => geometry.a1 + geometry.c2 + geometry.l3(),
            Arm::Planar(arm) => arm.l2 + arm.l3,
        }
    }

    /// The planar model of this robot: links 2 and 3, drives 2 and 3, the tool point at the wrist centre.
    ///
    /// Limits, offsets, signs and the meaning of joint 3 are carried into angles of the arm plane, counter-clockwise
    /// seen with x to the right and z up. Left out: the other drives, and the sideways offset `b` of the plane.
    /// A gravity compensator is left out too: the paper's drives have constant compliance.
    ///
    /// # Errors
    /// Where the planar model does not hold for the robot.
    pub fn arm_plane(&self) -> Result<ArmPlane, NoArmPlane> {
        let (geometry, limits, drives) = match &self.arm {
            Arm::Planar(arm) => {
                return Ok(ArmPlane { arm: arm.clone(), axis_from_base: [0.0; 2] });
            }
            Arm::SixAxis { geometry, limits, drives } => (geometry, limits, drives),
        };
        if !drives.transmission.keeps_the_arm(self.architecture) {
            return Err(NoArmPlane::Transmission(self.architecture));
        }
        let enclosed = geometry.elbow(limits.elbow);
        let third = geometry.third(limits.joints[2], limits.third_axis);
        let shoulder = geometry.shoulder(limits.joints[1]);
        // Where a robot counts its zeros from may differ by whole turns from joint to joint.
        let (elbow, forearm) = match limits.third_axis {
            ThirdAxis::Elbow => {
                let elbow = third.turned_towards(enclosed).intersect(enclosed);
                (elbow.ok_or(NoArmPlane::Limits)?, Range::ALL)
            }
            ThirdAxis::Forearm => (enclosed, third.turned_towards(shoulder.plus(enclosed))),
        };
        let arm = PlanarArm {
            l2: geometry.c2,
            l3: geometry.l3(),
            k2: drives.compliance.0[1],
            k3: drives.compliance.0[2],
            architecture: self.architecture,
            shoulder,
            elbow,
            forearm,
        };
        Ok(ArmPlane { arm, axis_from_base: [geometry.a1, geometry.c1] })
    }
}

/// Why a robot has no planar model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoArmPlane {
    /// A limit on joint 3 and one on the enclosed angle share no posture.
    #[error("joint 3 and elbow_deg share no angle: the limits leave nothing reachable")]
    Limits,
    /// The planar formulas know two couplings of the joints 2 and 3, and this is neither.
    #[error(
        "its transmission couples the joints 2 and 3 in another way than a {0} arm does: the planar model does not hold; use the spatial one"
    )]
    Transmission(Architecture),
}
