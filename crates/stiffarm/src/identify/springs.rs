//! How does each spring move a marker under a load? The columns of the regression.

use nalgebra::{Matrix6, Point3, Vector3, Vector6};

use super::IdentifyError;
use crate::catalogue::measurements::Reading;
use crate::chain::TrueArm;
use crate::geometry::Geometry;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;

/// A spring of which the compliance is unknown, rad/(N m), or that of a gravity compensator, of which the stiffness is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spring {
    /// A drive, counted from 0.
    Drive(usize),
    /// Drive 2 while joint 2 is in one of several ranges, counted from 0.
    Region(usize),
    /// The base tilts about the two horizontal axes through its origin, alike about both.
    Base,
    /// The tool bends about the two axes across the flange's, alike about both, at the flange centre.
    Tool,
    /// The spring of the gravity compensator, N/m.
    Compensator,
    /// Its stiffness times its free length, N: how much less it pulls than a spring without.
    Preload,
}

impl Spring {
    /// The six drives.
    pub const DRIVES: [Self; 6] =
        [Self::Drive(0), Self::Drive(1), Self::Drive(2), Self::Drive(3), Self::Drive(4), Self::Drive(5)];

    /// As people call it.
    pub fn name(self) -> String {
        match self {
            Self::Drive(drive) => format!("drive {}", drive + 1),
            Self::Region(region) => format!("drive 2, region {}", region + 1),
            Self::Base => "base".into(),
            Self::Tool => "tool".into(),
            Self::Compensator => "compensator".into(),
            Self::Preload => "compensator's preload".into(),
        }
    }

    /// The unknown of it is a compliance, rad/(N m).
    pub const fn is_compliance(self) -> bool {
        !matches!(self, Self::Compensator | Self::Preload)
    }
}

/// An arm at the posture of a reading, and the axes about which its springs turn.
pub(super) struct Bent {
    flange: Pose,
    /// Lines about which a unit of each drive turns the flange, as a six-vector at the base origin: `(moment of the line, direction)`.
    drives: Matrix6<f64>,
    /// Model angle of joint 2, rad.
    pub theta_2: f64,
}

impl Bent {
    /// The arm of a robot at the angles it reports, rad: as it was calibrated, where it was.
    pub(super) fn at(robot: &Robot, q: &[f64; 6]) -> Result<Self, IdentifyError> {
        let Arm::SixAxis { geometry, limits, drives } = &robot.arm else {
            return Err(IdentifyError::Planar(robot.name.clone()));
        };
        let geometry: &Geometry = geometry;
        let theta = geometry.model_angles(q, limits.third_axis);
        let (flange, jacobian) = match TrueArm::of(robot) {
            // The velocity of the point of the body that is at the base origin.
            None => (geometry.forward(&theta), geometry.jacobian(&theta, &Vector3::zeros())),
            Some(arm) => (arm.flange(q), arm.jacobian(q, &Vector3::zeros())),
        };
        Ok(Self { flange, drives: jacobian * drives.transmission.0, theta_2: theta[1] })
    }

    /// A point of the flange frame in the base frame, m.
    pub(super) fn point(&self, at: &Vector3<f64>) -> Vector3<f64> {
        (self.flange * Point3::from(*at)).coords
    }

    /// The base frame from the flange frame, turned alone.
    pub(super) fn turned(&self, vector: Vector3<f64>) -> Vector3<f64> {
        self.flange.rotation * vector
    }

    /// The axes of a spring, each as a six-vector at the base origin.
    fn axes(&self, spring: Spring) -> [Option<Vector6<f64>>; 2] {
        let about = |axis: Vector3<f64>, through: Vector3<f64>| {
            let moment = through.cross(&axis);
            Some(Vector6::new(moment.x, moment.y, moment.z, axis.x, axis.y, axis.z))
        };
        match spring {
            Spring::Drive(drive) => [Some(self.drives.column(drive).into()), None],
            Spring::Region(_) => [Some(self.drives.column(1).into()), None],
            Spring::Base => [about(Vector3::x(), Vector3::zeros()), about(Vector3::y(), Vector3::zeros())],
            Spring::Tool => {
                let centre = self.flange.translation.vector;
                [Vector3::x(), Vector3::y()].map(|axis| about(self.turned(axis), centre))
            }
            // It turns nothing itself: it changes what drive 2 gives.
            Spring::Compensator | Spring::Preload => [None, None],
        }
    }

    /// Displacement of `marker`, m, under a load on the point `at`, both in the base frame, per compliance of the spring: the sum over
    /// its axes of `g(marker) (g(load) . w)` (theory of identification: linear in the compliances).
    pub(super) fn column(
        &self,
        spring: Spring,
        (load, at): (&Vector6<f64>, &Vector3<f64>),
        marker: &Vector3<f64>,
    ) -> Vector3<f64> {
        let (force, moment) = (Vector3::from(load.fixed_rows::<3>(0)), Vector3::from(load.fixed_rows::<3>(3)));
        let mut moved = Vector3::zeros();
        for axis in self.axes(spring).into_iter().flatten() {
            let (linear, angular) = (Vector3::from(axis.fixed_rows::<3>(0)), Vector3::from(axis.fixed_rows::<3>(3)));
            let torque = (linear + angular.cross(at)).dot(&force) + angular.dot(&moment);
            moved += (linear + angular.cross(marker)) * torque;
        }
        moved
    }
}

/// From where to where joint 2 stands in each of the regions that are among the springs, as reported, rad: ranges with as many angles in each.
pub(super) fn ranges(readings: &[Reading], springs: &[Spring]) -> Result<Vec<[f64; 2]>, IdentifyError> {
    let regions = springs.iter().filter(|spring| matches!(spring, Spring::Region(_))).count();
    if regions == 0 {
        return Ok(Vec::new());
    }
    let mut angles: Vec<f64> = readings.iter().map(|reading| reading.q[1]).collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    let least = 2 * regions;
    if angles.len() < least {
        return Err(IdentifyError::TooFewAngles { angles: angles.len(), least, regions });
    }
    let first = |region: usize| region * angles.len() / regions;
    Ok((0..regions).map(|region| [angles[first(region)], angles[first(region + 1) - 1]]).collect())
}

/// A row of a posture is where the robot may not be: the joints, from 1; 0 is the angle between the links.
pub(super) fn beyond(robot: &Robot, reading: &Reading) -> Vec<usize> {
    crate::compliance::beyond_limits(robot, &reading.q)
}

/// What a unit compliance of each drive moves a marker, m per rad/(N m).
pub(crate) type OfDrives = [Vector3<f64>; 6];

/// What a unit compliance of each drive moves markers at a posture, m per rad/(N m), under a load on a point of the flange frame (N, base axes): six
/// columns of each marker; and how much of its own compliance drive 2 has beside a gravity compensator.
pub(crate) fn columns_at(
    robot: &Robot,
    q: &[f64; 6],
    load: &Vector6<f64>,
    at: &Vector3<f64>,
    markers: &[Vector3<f64>],
) -> Result<(Vec<OfDrives>, f64), IdentifyError> {
    let bent = Bent::at(robot, q)?;
    let at = bent.point(at);
    let of = |marker: &Vector3<f64>| {
        let marker = bent.point(marker);
        Spring::DRIVES.map(|spring| bent.column(spring, (load, &at), &marker))
    };
    let Arm::SixAxis { drives, .. } = &robot.arm else { return Err(IdentifyError::Planar(robot.name.clone())) };
    let k = drives.compliance.0[1];
    let share =
        drives.compliance_at(bent.theta_2).map_or(1.0, |effective| if 0.0 < k { effective[1] / k } else { 1.0 });
    Ok((markers.iter().map(of).collect(), share))
}
