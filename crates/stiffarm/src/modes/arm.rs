//! An arm with what it holds, whose masses are known: checked once, asked at many postures.

use nalgebra::Matrix6;

use super::{HeldTool, ModesError, frequencies};
use crate::compliance::{PostureError, check_joint, check_tool};
use crate::drive::Drives;
use crate::geometry::Geometry;
use crate::limits::ThirdAxis;
use crate::mass::{Mass, RigidBody, links_without, mass_matrix};
use crate::robot::{Arm, Robot};

/// An arm with what it holds, ready for many postures.
#[derive(Clone, Debug)]
pub struct SwingingArm<'a> {
    robot: &'a Robot,
    geometry: &'a Geometry,
    drives: &'a Drives,
    third_axis: ThirdAxis,
    /// Of the arm and of the tool.
    bodies: Vec<Mass>,
}

impl<'a> SwingingArm<'a> {
    /// Makes a robot ready.
    ///
    /// # Errors
    /// A robot without masses, and a tool that makes no sense.
    pub fn new(robot: &'a Robot, tool: &HeldTool) -> Result<Self, ModesError> {
        let Arm::SixAxis { geometry, limits, drives } = &robot.arm else {
            return Err(PostureError::Planar(robot.name.clone()).into());
        };
        check_tool(&tool.flange_from_tool)?;
        if let Some(fault) = tool.body.as_ref().and_then(tool_fault) {
            return Err(ModesError::Tool(fault));
        }
        check_masses(robot)?;
        let held = tool.body.map(|body| Mass::held(geometry, &body));
        let bodies = robot.masses.iter().copied().chain(held).collect();
        Ok(Self { robot, geometry, drives, third_axis: limits.third_axis, bodies })
    }

    /// Frequencies of the modes at the joint angles `q` that the robot reports, rad, ascending, Hz; motors held still.
    ///
    /// As [`modes`](super::modes) tells them, without shapes and intervals: a few microseconds.
    ///
    /// # Errors
    /// Angles that make no sense, and a posture that nothing holds.
    pub fn frequencies(&self, q: &[f64; 6]) -> Result<Vec<f64>, ModesError> {
        self.frequencies_at(&self.model_angles(q)?)
    }

    /// The same at model angles, rad.
    pub(super) fn frequencies_at(&self, theta: &[f64; 6]) -> Result<Vec<f64>, ModesError> {
        let (k, in_drives) = self.springs_and_inertia(theta)?;
        let root = Matrix6::from_diagonal(&k.map(f64::sqrt).into());
        Ok(frequencies(&(root * in_drives * root)))
    }

    /// Model angles of joint angles as the robot reports them, rad.
    pub(super) fn model_angles(&self, q: &[f64; 6]) -> Result<[f64; 6], ModesError> {
        q.iter().enumerate().try_for_each(|(joint, angle)| check_joint(joint, *angle))?;
        Ok(self.geometry.model_angles(q, self.third_axis))
    }

    /// The compliance of each drive, rad/(N m), and the inertia in coordinates of the drives, kg m^2, at model angles, rad.
    pub(super) fn springs_and_inertia(&self, theta: &[f64; 6]) -> Result<([f64; 6], Matrix6<f64>), ModesError> {
        let unheld = || PostureError::Unstable(self.robot.name.clone());
        let (k, a) = (self.drives.compliance_at(theta[1]).ok_or_else(unheld)?, self.drives.transmission.0);
        Ok((k, a.transpose() * mass_matrix(self.geometry, theta, &self.bodies) * a))
    }

    pub(super) fn robot(&self) -> &'a Robot {
        self.robot
    }

    pub(super) fn geometry(&self) -> &'a Geometry {
        self.geometry
    }

    pub(super) fn drives(&self) -> &'a Drives {
        self.drives
    }

    pub(super) fn bodies(&self) -> &[Mass] {
        &self.bodies
    }
}

/// Every link has a mass.
pub(crate) fn check_masses(robot: &Robot) -> Result<(), ModesError> {
    let links: Vec<String> = links_without(&robot.masses).iter().map(ToString::to_string).collect();
    let missing = match links.len() {
        0 => return Ok(()),
        6 => "no masses".to_owned(),
        _ => format!("no mass of link {}", links.join(", ")),
    };
    Err(ModesError::NoMasses { robot: robot.full_name(), missing })
}

fn tool_fault(body: &RigidBody) -> Option<String> {
    const MOST_KG: f64 = 5000.0;
    if !(0.0 < body.mass && body.mass <= MOST_KG) {
        return Some(format!("a mass of {} kg; expected more than 0 and at most {MOST_KG} kg", body.mass));
    }
    if !(body.centre.norm() <= 10.0) {
        return Some(format!("a mass centre {} m from the flange; expected at most 10 m", body.centre.norm()));
    }
    body.inertia_fault()
}
