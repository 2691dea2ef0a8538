//! What is a robot, and what is its arm plane?

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use crate::body::{Body, Enclosing};
use crate::calibration::Calibration;
use crate::drive::{Architecture, Drives, Identified, JointCompliance, Knowledge, Scatter};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, Pendant, ThirdAxis};
use crate::mass::Mass;
use crate::plane::{InvalidArm, PlanarArm};

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

/// Where the compliance of the drives is from; reported wherever a deflection is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffnessSource {
    /// Nobody has said it: the paper's 1 urad/(N m).
    Assumed,
    /// The robot file.
    File,
    /// The robot file, which has them from measurements.
    Identified,
    /// Publications on this robot.
    Published,
    /// Robots of the same size.
    Prior,
    /// Whoever asks.
    Given,
}

impl StiffnessSource {
    /// All, the least known first.
    pub const ALL: [Self; 6] = [Self::Assumed, Self::Prior, Self::Published, Self::File, Self::Identified, Self::Given];

    /// The name that answers use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Assumed => "assumed",
            Self::File => "robot file",
            Self::Identified => "identified",
            Self::Published => "published",
            Self::Prior => "prior",
            Self::Given => "given",
        }
    }
}

/// Under which key of [`Robot::source`] it stands where the compliance of the drives is from.
pub const COMPLIANCE_SOURCE: &str = "compliance";
/// What stands there where whoever asks has given it.
pub const GIVEN: &str = "given";

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
    /// Nothing says how stiff some of its drives are: those have the paper's compliance.
    pub stiffness_is_assumed: bool,
    /// How well the geometry and the limits are known.
    pub status: Status,
    /// Nominal payload, kg.
    pub payload_kg: Option<f64>,
    /// Reach by the data sheet, m (from the joint 1 axis, as makers state it).
    pub reach: Option<f64>,
    /// Mass of the arm, kg.
    pub mass_kg: Option<f64>,
    /// Repeatability by the data sheet, m.
    pub repeatability: Option<f64>,
    /// How thick its links are; estimated where `None`, see [`Self::thickness`].
    pub body: Option<Body>,
    /// Capsules that enclose its links, where they are known.
    pub enclosing: Option<Enclosing>,
    /// What its bodies weigh; empty where nobody says it.
    pub masses: Vec<Mass>,
    /// What moves.
    pub arm: Arm,
    /// How this very arm differs from its drawing, where it was measured.
    pub calibration: Option<Box<Calibration>>,
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
    /// The paper's arm: two links of which nothing else is known.
    pub fn of_links(arm: PlanarArm) -> Self {
        Self {
            name: "two links".into(),
            vendor: String::new(),
            architecture: arm.architecture,
            architecture_is_assumed: false,
            stiffness_is_assumed: false,
            status: Status::Estimated,
            payload_kg: None,
            reach: None,
            mass_kg: None,
            repeatability: None,
            body: None,
            enclosing: None,
            masses: Vec::new(),
            calibration: None,
            arm: Arm::Planar(arm),
            source: BTreeMap::new(),
        }
    }

    /// Maker and name, or the name alone where no maker is known.
    pub fn full_name(&self) -> String {
        format!("{} {}", self.vendor, self.name).trim().into()
    }

    /// Whether its pendant shows the joints as they are counted here; `None` of two links, which have no joints to be shown.
    pub fn pendant(&self) -> Option<&Pendant> {
        match &self.arm {
            Arm::SixAxis { limits, .. } => Some(&limits.pendant),
            Arm::Planar(_) => None,
        }
    }

    /// The same robot whose pendant shows the joints as they are counted here, by the word of whoever asks where nobody else says it.
    #[must_use]
    pub fn with_pendant_given(mut self) -> Self {
        if let Arm::SixAxis { limits: Limits { pendant: pendant @ Pendant::Unknown, .. }, .. } = &mut self.arm {
            *pendant = Pendant::Given;
        }
        self
    }

    /// How thick its links are, and whether that is an estimate.
    pub fn thickness(&self) -> (Body, bool) {
        match self.body {
            Some(body) => (body, false),
            None => (Body::estimated(self.payload_kg, self.far()), true),
        }
    }

    /// What its links are taken to be where nobody says it.
    pub(crate) fn estimated_bodies(&self, geometry: &Geometry) -> Enclosing {
        Enclosing::estimated(geometry, self.payload_kg, self.far())
    }

    /// Its reach, by its lengths where it is not known, m.
    fn far(&self) -> f64 {
        self.reach.unwrap_or_else(|| self.stretch())
    }

    /// Where the compliance of its drives is from.
    pub fn stiffness_source(&self) -> StiffnessSource {
        if let Some(scatter) = self.scatter() {
            return match scatter.knowledge {
                Knowledge::Prior => StiffnessSource::Prior,
                Knowledge::Published { .. } => StiffnessSource::Published,
            };
        }
        let given = self.source.get(COMPLIANCE_SOURCE).is_some_and(|source| source == GIVEN);
        match (self.stiffness_is_assumed, given) {
            (true, _) => StiffnessSource::Assumed,
            (false, true) => StiffnessSource::Given,
            (false, false) if self.identified().is_some() => StiffnessSource::Identified,
            (false, false) => StiffnessSource::File,
        }
    }

    /// How far the compliances of its drives may be off, where they were taken from others.
    pub fn scatter(&self) -> Option<&Scatter> {
        match &self.arm {
            Arm::SixAxis { drives, .. } => drives.scatter.as_ref(),
            Arm::Planar(_) => None,
        }
    }

    /// How well the compliances of its drives are known, where they were measured.
    pub fn identified(&self) -> Option<&Identified> {
        match &self.arm {
            Arm::SixAxis { drives, .. } => drives.identified.as_ref(),
            Arm::Planar(_) => None,
        }
    }

    /// The compliance of each drive, rad/(N m); of two links those of the drives 2 and 3 alone.
    pub fn drive_compliance(&self) -> [Option<f64>; 6] {
        match &self.arm {
            Arm::SixAxis { drives, .. } => drives.compliance.0.map(Some),
            Arm::Planar(arm) => [None, Some(arm.k2), Some(arm.k3), None, None, None],
        }
    }

    /// It is known where the base stands, and with it the floor and the joint-1 axis.
    pub fn knows_base(&self) -> bool {
        matches!(self.arm, Arm::SixAxis { .. })
    }

    /// Joint 1 axis to wrist centre with both links straight ahead, m: `a1 + l2 + l3`.
    pub fn stretch(&self) -> f64 {
        match &self.arm {
            Arm::SixAxis { geometry, .. } => geometry.a1 + geometry.c2 + geometry.l3(),
            Arm::Planar(arm) => arm.l2 + arm.l3,
        }
    }

    /// How far from the joint-1 axis the wrist centre comes ahead within the limits, m: what makers call the reach.
    ///
    /// # Errors
    /// Where the limits leave nothing, or a length makes no sense.
    pub fn reach_ahead(&self) -> Result<f64, InvalidArm> {
        let plane = self.two_links().map_err(|_| InvalidArm::NothingReachable)?;
        let ArmPlane { arm, axis_from_base: [a1, _] } = plane;
        let sideways = if let Arm::SixAxis { geometry, .. } = &self.arm { geometry.b } else { 0.0 };
        // Rigid drives move as others do.
        let arm = PlanarArm { k2: JointCompliance::PAPER.0[1], ..arm };
        Ok((a1 + arm.farthest_ahead()?).hypot(sideways))
    }

    /// The planar model of this robot: links 2 and 3, drives 2 and 3, the tool point at the wrist centre.
    ///
    /// Left out: the other drives, and the sideways offset `b` of the plane.
    ///
    /// # Errors
    /// Where the planar model does not hold for the robot.
    pub fn arm_plane(&self) -> Result<ArmPlane, NoArmPlane> {
        if let Arm::SixAxis { drives, .. } = &self.arm {
            if drives.compensator.is_some() {
                return Err(NoArmPlane::Compensator);
            }
            if !drives.transmission.keeps_the_arm(self.architecture) {
                return Err(NoArmPlane::Transmission(self.architecture));
            }
            if drives.compliance.0[1..3] == [0.0; 2] {
                return Err(NoArmPlane::Rigid);
            }
        }
        self.two_links()
    }

    /// What moves in the arm plane, whatever springs: links 2 and 3, with the compliances of drives 2 and 3 as they are
    /// stated. What they reach is this robot's reach even where [`Self::arm_plane`] does not hold.
    ///
    /// Limits, offsets, signs and the meaning of joint 3 are carried into angles of the arm plane, counter-clockwise
    /// seen with x to the right and z up.
    ///
    /// # Errors
    /// Where the limits contradict each other.
    pub fn two_links(&self) -> Result<ArmPlane, NoArmPlane> {
        let (geometry, limits, drives) = match &self.arm {
            Arm::Planar(arm) => {
                return Ok(ArmPlane { arm: arm.clone(), axis_from_base: self.axis_2() });
            }
            Arm::SixAxis { geometry, limits, drives } => (geometry, limits, drives),
        };
        let enclosed = geometry.elbow(limits.elbow);
        let third = geometry.third(limits.joints[2], limits.third_axis);
        let shoulder = geometry.shoulder(limits.joints[1]);
        // Where a robot counts its zeros from may differ by whole turns from joint to joint.
        let (elbow, forearm) = match limits.third_axis {
            ThirdAxis::Elbow => {
                let elbow = third.turned_towards(enclosed).intersect(enclosed);
                (elbow.ok_or(NoArmPlane::Limits)?, Interval::ALL)
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
        Ok(ArmPlane { arm, axis_from_base: self.axis_2() })
    }

    /// The joint-2 axis from the base, forwards and up, m; zero for a robot of which only the plane is known.
    pub fn axis_2(&self) -> [f64; 2] {
        match &self.arm {
            Arm::SixAxis { geometry, .. } => [geometry.a1, geometry.c1],
            Arm::Planar(_) => [0.0; 2],
        }
    }

    /// Checks that drive 2 holds the gravity compensator, where there is one, wherever joint 2 may turn.
    ///
    /// Looked at every tenth of a degree.
    ///
    /// # Errors
    /// Where it does not, and what happens there.
    pub fn check_compensator(&self) -> Result<(), Unheld> {
        const STEPS: u32 = 3600;
        let Arm::SixAxis { geometry, limits, drives } = &self.arm else { return Ok(()) };
        let Some(compensator) = drives.compensator else { return Ok(()) };
        let lean = geometry.shoulder(limits.joints[1]).affine(-1.0, FRAC_PI_2).or_one_turn();
        for i in 0..=STEPS {
            let theta_2 = lean.min() + lean.width() * f64::from(i) / f64::from(STEPS);
            if compensator.length(theta_2) < 1e-3 {
                return Err(Unheld { what: "its two ends meet", theta_2 });
            }
            if drives.compliance_at(theta_2).is_none() {
                return Err(Unheld { what: "it pushes harder than drive 2 holds", theta_2 });
            }
        }
        Ok(())
    }
}

/// A gravity compensator that no arm has.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("gravity compensator: {what} where the upper arm leans {:.1} deg forwards", theta_2.to_degrees())]
pub struct Unheld {
    /// What is wrong.
    pub what: &'static str,
    /// The model angle of joint 2 at which it is, rad.
    pub theta_2: f64,
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
    /// With a spring beside drive 2 the deflection is no function of the distance alone.
    #[error(
        "its gravity compensator makes drive 2 as stiff as the upper arm leans: the planar model does not hold; use the spatial one"
    )]
    Compensator,
    /// Nothing gives way in the arm plane.
    #[error("its drives 2 and 3 are rigid: in the planar model nothing gives way; use the spatial one")]
    Rigid,
}
