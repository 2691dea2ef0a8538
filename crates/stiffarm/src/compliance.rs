//! Verb 1: how compliant is the arm at one posture, all six drives, at the tool point?

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use crate::chain::TrueArm;
use crate::load::{Forces, Largest, Load};
use crate::robot::{Arm, Robot, Unheld};
use crate::spatial::{Compliance, Pose, eigenvalues};

/// An arm at one posture.
#[derive(Clone, Debug)]
pub struct Posture {
    /// The tool frame in the base frame; of a robot that was calibrated where it truly stands.
    pub tool: Pose,
    /// 6 x 6 compliance at the tool point, base axes.
    pub compliance: Compliance,
    /// The part of each drive (a gravity compensator counts with drive 2); they add up to `compliance`.
    pub by_drive: [Compliance; 6],
}

impl Posture {
    /// What a load does at most, and the force of those that it may be that does it, base axes.
    ///
    /// The feed counts from the x axis of the tool, counter-clockwise seen from the spindle: where a zone is placed, its first side lies
    /// there at roll and angle zero.
    pub fn under(&self, load: Load) -> Largest {
        self.forces(load).largest(&self.compliance.translation())
    }

    /// The forces that a load may be, as [`Self::under`] has them, base axes.
    pub(crate) fn forces(&self, load: Load) -> Forces {
        let tool = self.tool.rotation.to_rotation_matrix();
        let [x, y, z] = [0, 1, 2].map(|i| Vector3::from(tool.matrix().column(i)));
        load.forces(&Matrix3::from_columns(&[x, -y, -z]))
    }

    /// What some forces do at most; any where `None`.
    pub(crate) fn most(&self, forces: Option<&Forces>) -> Largest {
        if let Some(forces) = forces {
            return forces.largest(&self.compliance.translation());
        }
        let (value, direction) = self.compliance.worst();
        Largest { value, force: direction, counted: direction }
    }

    /// What each drive gives of the compliance of the translation, m/N.
    pub(crate) fn translations(&self) -> [Matrix3<f64>; 6] {
        self.by_drive.each_ref().map(Compliance::translation)
    }

    /// How much of what counts comes from each drive; adds up to 1, and a drive that works against the others has less than nothing.
    ///
    /// All zero where nothing gives way.
    pub fn shares_of(&self, most: &Largest) -> [f64; 6] {
        let counted = |compliance: &Compliance| most.counted.dot(&(compliance.translation() * most.force));
        let whole = counted(&self.compliance);
        self.by_drive.map(|part| if 0.0 < whole { counted(&part) / whole } else { 0.0 })
    }

    /// How much of the translation per force along `direction` comes from each drive; adds up to 1.
    ///
    /// All zero where nothing gives way in that direction.
    pub fn shares(&self, direction: &Vector3<f64>) -> [f64; 6] {
        self.shares_of(&Largest { value: 0.0, force: *direction, counted: *direction })
    }
}

/// What some forces do at most, any where `None`, m/N, where every drive gives so many times its part of the compliance of the translation.
pub(crate) fn most_of(by_drive: &[Matrix3<f64>; 6], factors: &[f64; 6], forces: Option<&Forces>) -> f64 {
    let drawn: Matrix3<f64> = by_drive.iter().zip(factors).map(|(part, factor)| part * *factor).sum();
    forces.map_or_else(|| eigenvalues(&drawn)[0], |forces| forces.largest(&drawn).value)
}

/// How far the force that does most of what counts moves the tool in all, m/N: no less than what counts of it.
pub(crate) fn moved_in_all(by_drive: &[Matrix3<f64>; 6], forces: Option<&Forces>) -> f64 {
    let whole: Matrix3<f64> = by_drive.iter().sum();
    forces.map_or_else(|| eigenvalues(&whole)[0], |forces| (whole * forces.largest(&whole).force).norm())
}

/// A posture that cannot be judged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PostureError {
    /// Only two links of this robot are known.
    #[error("{0} is a planar robot: it has no six joints; a robot file with [geometry] is needed")]
    Planar(String),
    /// A joint angle that is no sensible number.
    #[error("joint {joint}: {value} deg; expected a number from -1080 to 1080")]
    Joint {
        /// From 1.
        joint: usize,
        /// Its value in degrees, as people give it.
        value: f64,
    },
    /// Nothing holds joint 2.
    #[error("{0}: at this posture the gravity compensator pushes harder than drive 2 holds; its numbers must be wrong")]
    Unstable(String),
    /// The same, wherever joint 2 may turn.
    #[error("{robot}: {unheld}")]
    Unheld {
        /// Which robot.
        robot: String,
        /// What happens where.
        unheld: Unheld,
    },
    /// A tool that no arm carries.
    #[error("a tool point {0} m from the flange; expected at most 10 m")]
    Tool(f64),
}

/// Compliance of a robot at the joint angles `q` it reports (rad), for a tool frame given in the flange frame.
///
/// `C = (J A) k (J A)^T` with the 6 x 6 geometric Jacobian at the tool point and the transmission `A` (\[theory\], section
/// 1); nothing is inverted, so singular postures have one too. Left out: links, bearings, base, the robot's own weight. Of a robot that was
/// calibrated the tool stands where it truly does, on a base that stands on a floor; the compliance is that of the arm as drawn, which
/// differs by less than 0.5 % where frames err by up to 0.5 mm and 0.5 mrad.
///
/// ```
/// use stiffarm::catalogue::find;
/// use stiffarm::compliance::compliance;
/// use stiffarm::spatial::Pose;
///
/// let robot = find("KR 210 R2700 extra").ok_or("in the catalogue")?.robot();
/// let joints = [0.0_f64, -90.0, 90.0, 0.0, 45.0, 0.0].map(f64::to_radians);
/// let posture = compliance(&robot, &joints, &Pose::translation(0.0, 0.0, 0.15))?;
/// let (worst, direction) = posture.compliance.worst();
/// assert!((worst - 4.470e-6).abs() < 1e-9); // m/N
/// assert!((posture.shares(&direction)[1] - 0.572).abs() < 1e-3); // drive 2 gives most of it
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Where the robot is planar, or a number makes no sense. Joint limits are not checked here.
pub fn compliance(robot: &Robot, q: &[f64; 6], flange_from_tool: &Pose) -> Result<Posture, PostureError> {
    let Arm::SixAxis { geometry, limits, drives } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()));
    };
    q.iter().enumerate().try_for_each(|(joint, angle)| check_joint(joint, *angle))?;
    check_tool(flange_from_tool)?;
    let theta = geometry.model_angles(q, limits.third_axis);
    let tool = geometry.forward(&theta) * flange_from_tool;
    let k = drives.compliance_at(theta[1]).ok_or_else(|| PostureError::Unstable(robot.name.clone()))?;
    let jacobian: Matrix6<f64> = geometry.jacobian(&theta, &tool.translation.vector) * drives.transmission.0;
    let by_drive = std::array::from_fn(|i| {
        let column: Vector6<f64> = jacobian.column(i).into();
        Compliance(column * column.transpose() * k[i])
    });
    let sum = by_drive.iter().fold(Matrix6::zeros(), |sum, part| sum + part.0);
    let tool = TrueArm::of(robot).map_or(tool, |arm| arm.flange(q) * flange_from_tool);
    Ok(Posture { tool, compliance: Compliance(sum), by_drive })
}

/// Checks the angle, rad, of a joint counted from 0.
pub(crate) fn check_joint(joint: usize, angle: f64) -> Result<(), PostureError> {
    let value = angle.to_degrees();
    if value.abs() <= 1080.0 { Ok(()) } else { Err(PostureError::Joint { joint: joint + 1, value }) }
}

/// Checks that drive 2 holds the gravity compensator at every posture within the limits.
pub(crate) fn check_held(robot: &Robot) -> Result<(), PostureError> {
    robot.check_compensator().map_err(|unheld| PostureError::Unheld { robot: robot.name.clone(), unheld })
}

/// Checks that a tool point lies where an arm can carry it.
pub(crate) fn check_tool(flange_from_tool: &Pose) -> Result<(), PostureError> {
    let distance = flange_from_tool.translation.vector.norm();
    if distance <= 10.0 { Ok(()) } else { Err(PostureError::Tool(distance)) }
}

/// The joints (from 1) that a robot's limits do not allow at the angles `q` it reports, rad; 0 stands for the angle between
/// the links.
pub fn beyond_limits(robot: &Robot, q: &[f64; 6]) -> Vec<usize> {
    const SLACK: f64 = 1e-9;
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return Vec::new() };
    let theta_3 = geometry.model_angles(q, limits.third_axis)[2];
    let enclosed = std::f64::consts::PI - theta_3;
    let between = (!limits.elbow.contains(enclosed, SLACK)).then_some(0);
    let joints = (0..6).filter(|&i| !limits.joints[i].contains(q[i], SLACK)).map(|i| i + 1);
    between.into_iter().chain(joints).collect()
}
