//! How compliant is an arm at many postures, or at many poses of its tool? All at once, in wide registers and on all cores.
//!
//! [`SpatialArm`] is a robot with its tool, prepared once. `joints` evaluates postures given by joint angles, `rows` the same as
//! rows of six, `poses` poses of the tool, each held in every configuration. The formulas are those of
//! [`crate::compliance`] and [`crate::inverse`], arranged for registers of several numbers (`lanes`): they carry sines
//! and cosines instead of angles, and compare an angle with its limits by one scalar product.

#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "what is not inlined, or hides in an iterator's closure, is compiled without the wide instructions"
)]

mod angular_interval;
mod angular_limits;
mod branches;
mod counted;
mod joints;
mod lanes;
mod on_path;
mod orientation;
mod poses;
mod posture;
mod rows;
mod same_branch;
mod vectors;

use nalgebra::{Matrix6, Vector3};

use crate::compliance::{PostureError, check_tool};
use crate::drive::{Architecture, GravityCompensator, Transmission};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::Limits;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use crate::tolerances::{CLEARANCE, FOLLOWED, PROOF_CLEARANCE};

pub(crate) use angular_interval::AngularInterval;
use angular_limits::AngularLimits;
pub(crate) use on_path::{Pushing, RollGrid};
pub(crate) use orientation::RolledTool;
pub(crate) use poses::AtRoll;
pub use poses::Best;
pub(crate) use posture::arm_columns;
pub use rows::{RowError, RowsError, Units, matrices_of_rows, worst_of_rows};
pub(crate) use same_branch::SameBranch;

/// A six-axis robot with a tool, ready to be evaluated in bulk.
#[derive(Clone, Debug)]
pub struct SpatialArm {
    pub(crate) geometry: Geometry,
    pub(crate) limits: Limits,
    pub(crate) flange_from_tool: Pose,
    pub(crate) coupling: Coupling,
    /// Compliance of each drive, rad/(N m), without the compensator.
    pub(crate) k: [f64; 6],
    pub(crate) compensator: Option<GravityCompensator>,
    pub(crate) angular_limits: AngularLimits,
    /// How far places keep from a straight wrist or arm, rad.
    pub(crate) clearance: f64,
    /// Added to that distance where samples alone are looked at, rad.
    reserve: f64,
}

/// How the columns of the Jacobian combine into those of the drives.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Coupling {
    /// Every drive turns its joint.
    Serial,
    /// Drive 3 holds the absolute angle of the forearm.
    QuasiSerial,
    /// The transmission matrix.
    Any(Box<Matrix6<f64>>),
}

impl SpatialArm {
    /// Makes a robot ready, with a tool frame given in the flange frame.
    ///
    /// # Errors
    /// Where the robot is planar, or the tool makes no sense.
    pub fn new(robot: &Robot, flange_from_tool: &Pose) -> Result<Self, PostureError> {
        let Arm::SixAxis { geometry, limits, drives } = &robot.arm else {
            return Err(PostureError::Planar(robot.name.clone()));
        };
        check_tool(flange_from_tool)?;
        let usual = |architecture| drives.transmission == Transmission::of(architecture);
        let coupling = if usual(Architecture::Serial) {
            Coupling::Serial
        } else if usual(Architecture::QuasiSerial) {
            Coupling::QuasiSerial
        } else {
            Coupling::Any(Box::new(drives.transmission.0))
        };
        Ok(Self {
            angular_limits: AngularLimits::new(geometry, limits),
            geometry: geometry.clone(),
            limits: limits.clone(),
            flange_from_tool: *flange_from_tool,
            coupling,
            k: drives.compliance.0,
            compensator: drives.compensator,
            clearance: CLEARANCE,
            reserve: 0.0,
        })
    }

    /// The tool point lies on the axis of joint 6: turning the tool about it moves nothing.
    pub fn tool_is_on_axis_6(&self) -> bool {
        let tool = self.flange_from_tool.translation.vector;
        tool.x == 0.0 && tool.y == 0.0
    }

    /// How far from the joint-1 axis and how high from the base the tool point can be by the lengths alone, m.
    pub(crate) fn reach(&self) -> [Interval; 2] {
        let tool = self.flange_from_tool.translation.vector;
        let wrist_to_tool = (self.geometry.c4 + tool.z).hypot(tool.x.hypot(tool.y));
        let far = self.geometry.c2 + self.geometry.l3() + wrist_to_tool;
        let ahead = self.geometry.a1.hypot(self.geometry.b) + far;
        [Interval::spanning(0.0, ahead), Interval::spanning(self.geometry.c1 - far, self.geometry.c1 + far)]
    }

    /// Turning the tool about its axis turns joint 6 and nothing else.
    pub fn tool_turns_about_axis_6(&self) -> bool {
        let z = self.flange_from_tool.rotation * Vector3::z();
        self.tool_is_on_axis_6() && z.xy().norm() < 1e-12 && 0.0 < z.z
    }

    /// Both wrists of a posture have the same compliance: every drive turns one of the joints 4 to 6 at most.
    pub(crate) fn wrists_are_alike(&self) -> bool {
        !matches!(self.coupling, Coupling::Any(_))
    }

    /// The same arm without the limits of joint `i` (from 0), where `really`.
    pub(crate) fn without_limit_on(&self, i: usize, really: bool) -> Self {
        let mut arm = self.clone();
        if really {
            arm.limits.joints[i] = Interval::ALL;
            arm.angular_limits = AngularLimits::new(&arm.geometry, &arm.limits);
        }
        arm
    }

    /// The same arm seen from a base that is turned to the left about the joint-1 axis, rad: joint 1 counts from there.
    pub(crate) fn with_base_turned(&self, angle: f64) -> Self {
        let mut arm = self.clone();
        arm.limits.joints[0] = arm.limits.joints[0].affine(1.0, -arm.geometry.sign[0] * angle);
        arm.angular_limits = AngularLimits::new(&arm.geometry, &arm.limits);
        arm
    }

    /// The same arm whose joint 1 keeps as clear of its limits as a zone that is followed keeps it, where it has that much room: a zone that may not be
    /// turned about the joint-1 axis is not followed nearer to them.
    pub(crate) fn with_joint_1_clear(mut self) -> Self {
        if let Some(range) = self.limits.joints[0].narrowed(CLEARANCE + FOLLOWED) {
            self.limits.joints[0] = range;
            self.angular_limits = AngularLimits::new(&self.geometry, &self.limits);
        }
        self
    }

    /// The same arm with every limit narrowed by `by`, rad, at either end, and with the distance from singular postures widened
    /// by it; `None` where nothing of a limit would be left.
    pub(crate) fn narrowed(&self, by: f64) -> Option<Self> {
        Some(Self { reserve: by, ..self.with_margins(by, self.clearance)? })
    }

    /// The same arm with every limit narrowed by `limit`, rad, at either end, that keeps `singular` from a straight wrist or arm, rad, and
    /// no less than [`CLEARANCE`]; `None` where nothing of a limit would be left.
    pub(crate) fn with_margins(&self, limit: f64, singular: f64) -> Option<Self> {
        let mut arm = Self { clearance: singular.max(CLEARANCE), ..self.clone() };
        for range in arm.limits.joints.iter_mut().chain([&mut arm.limits.elbow]) {
            *range = range.narrowed(limit)?;
        }
        arm.angular_limits = AngularLimits::new(&arm.geometry, &arm.limits);
        Some(arm)
    }

    /// How near to a straight wrist or arm a proof still looks, rad: by a hair nearer than places are.
    pub(crate) fn proof_clearance(&self) -> f64 {
        self.clearance * (PROOF_CLEARANCE / CLEARANCE)
    }

    /// The same arm without any limits or margins.
    pub(crate) fn without_limits(&self) -> Self {
        let mut arm = Self { clearance: CLEARANCE, ..self.clone() };
        arm.limits.joints = [Interval::ALL; 6];
        arm.limits.elbow = Interval::ALL;
        arm.angular_limits = AngularLimits::new(&arm.geometry, &arm.limits);
        arm
    }
}
