//! Which joints must be commanded, so that the loaded robot stands where the path has it, and how much is left?
//!
//! For compliant drives and a known force `w` exactly
//!
//! ```text
//! q_cmd = q_t - A kappa A^T J(q_t)^T w
//! ```
//!
//! at the joints `q_t` of the target: loaded there, the springs give way by what was taken off. A file that holds only positions loses the
//! rotation of the commanded pose: what that leaves is found from the loaded posture itself. How well the drives are known decides the
//! residual that is to be expected: `(C_true - C_model) w`, and of a robot that was measured what its identification did not explain, which is
//! drawn once for a path: its postures are alike, and miss alike.

use nalgebra::{Matrix3, Matrix3x6, Point3, Vector3, Vector6};

use super::fault::MillError;
use super::follow::{Pushed, Stand, wrench};
use super::stations::{Acting, ErrorPart, Station};
use crate::compliance::{PostureError, compliance};
use crate::inverse::posture_of;
use crate::mass::{GRAVITY, ToolWeight};
use crate::parallel;
use crate::prior::{Drawn, Moved, Unexplained};
use crate::robot::{Arm, Robot};
use crate::spatial::{Pose, Wrench};
use crate::tolerances::LIMIT;
use crate::toolpath::ToolPose;
use crate::uncertainty::{quantile, quantile_of};
use crate::watch::Watch;

/// Rounds in which the loaded posture is found, and the joints' change that ends them, rad.
const ROUNDS: usize = 40;
const SETTLED: f64 = 1e-12;
/// Relative allowance for rounding.
const ROUNDING: f64 = 1e-12;

/// A path whose deflection is taken out.
#[derive(Clone, Debug, PartialEq)]
pub struct Compensated {
    /// Joints to be commanded at every station, as the robot reports them, rad.
    pub joints: Vec<[f64; 6]>,
    /// The tool in the part at these joints.
    pub poses: Vec<ToolPose>,
    /// The largest way by which a tip is led aside, m.
    pub largest: f64,
    /// The largest error that is left where the joints are commanded, m: rounding, since they are exact.
    pub by_joints: f64,
    /// The error that is left at every station where only tips are commanded, each with the tool turned as in the path, m; infinite where
    /// one is not reached.
    pub left_by_tips: Vec<f64>,
    /// Stations at which a commanded joint lies beyond its range.
    pub beyond: Vec<usize>,
}

impl Compensated {
    /// The largest error that is left where only tips are commanded, m.
    pub fn by_tips(&self) -> f64 {
        self.left_by_tips.iter().copied().fold(0.0, f64::max)
    }
}

/// What is left where drives are not as the model has them, m: of the largest error along the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Remaining {
    /// Half of the draws leave less.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Of every draw, in their order: draw by draw the same drives along every path of a robot.
    pub all: Vec<f64>,
    /// 95th percentile over the draws of what is left at each station by itself, m.
    pub along: Vec<f64>,
    /// What half of the draws do, m.
    pub median_along: Vec<f64>,
    /// The same where nothing is compensated, m.
    pub without: Vec<f64>,
}

/// What is commanded at one station, and what that leaves, m.
struct Commanded {
    joints: [f64; 6],
    pose: ToolPose,
    by_joints: f64,
    by_tips: f64,
}

/// Takes the deflection out of a path that is followed.
///
/// # Errors
/// A force that may point anywhere at some station: nobody knows which way the tool gives; a planar robot; what was stopped.
pub fn compensate(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    part: ErrorPart,
    watch: Watch,
) -> Result<Compensated, MillError> {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let one = |i: usize| {
        let (station, pushed) = (&stations[i], &followed[i]);
        watch.go_on()?;
        let target = geometry.model_angles(&pushed.joints, limits.third_axis);
        let Some(wrench) = known_wrench(stand, station)? else {
            return Ok::<_, MillError>(Commanded {
                joints: pushed.joints,
                pose: station.sample.pose,
                by_joints: 0.0,
                by_tips: 0.0,
            });
        };
        let turned = joint_deflection(robot, &target, stand, &wrench)?;
        let commanded: [f64; 6] = std::array::from_fn(|i| target[i] - turned[i]);
        let (from, to) =
            (geometry.reported(&target, limits.third_axis), geometry.reported(&commanded, limits.third_axis));
        // Whole turns stay as they are.
        let joints = std::array::from_fn(|i| pushed.joints[i] + to[i] - from[i]);
        let tool = stand.base_from_part.inverse() * geometry.forward(&commanded) * stand.flange_from_tool;
        let pose = ToolPose { tip: tool.translation.vector, axis: -(tool.rotation * Vector3::z()) };
        let left = |commanded: &[f64; 6]| error_left(robot, stand, station, (commanded, &wrench), part);
        let by_joints = left(&commanded)?;
        // Only the tip of that pose, with the tool turned as the path has it.
        let asked = stand.base_from_tool(&station.sample, pushed.arrangement.roll)?;
        let tip = (stand.base_from_part * Point3::from(pose.tip)).coords;
        let flange = Pose::from_parts(tip.into(), asked.rotation) * stand.flange_from_tool.inverse();
        let by_tips = match posture_of(geometry, &flange, pushed.arrangement.configuration) {
            Some(theta) => left(&theta)?,
            None => f64::INFINITY,
        };
        Ok(Commanded { joints, pose, by_joints, by_tips })
    };
    let all: Vec<Commanded> = parallel::try_each_of(stations.len(), one)?;
    let most = |of: fn(&Commanded) -> f64| all.iter().map(of).fold(0.0, f64::max);
    let aside = |(one, station): (&Commanded, &Station)| (one.pose.tip - station.sample.pose.tip).norm();
    let is_beyond = |i: &usize| (0..6).any(|joint| !limits.joints[joint].contains(all[*i].joints[joint], LIMIT));
    Ok(Compensated {
        largest: all.iter().zip(stations).map(aside).fold(0.0, f64::max),
        by_joints: most(|one| one.by_joints),
        left_by_tips: all.iter().map(|one| one.by_tips).collect(),
        beyond: (0..all.len()).filter(is_beyond).collect(),
        joints: all.iter().map(|one| one.joints).collect(),
        poses: all.iter().map(|one| one.pose).collect(),
    })
}

/// What is left of the largest error where the robot differs from the model as drawn. A tool that is held is taken out by its weight, too, as of an
/// arm that was calibrated, and what is wrong of that is left with the rest.
///
/// # Errors
/// As [`compensate`].
pub fn remaining(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    (part, drawn, held): (ErrorPart, &Drawn, Option<&ToolWeight>),
    watch: Watch,
) -> Result<Remaining, MillError> {
    let missing = times(drawn, |factor| factor - 1.0)?;
    let (left, whole) = (Times { of_force: &missing, off: &missing }, times(drawn, |factor| factor)?);
    let all_of_it = Times { of_force: &whole, off: &missing };
    let of_station = |given: &Given| {
        let mut remains = given.errors(left, drawn);
        let without = quantile_of(&mut given.errors(all_of_it, drawn), 0.95);
        [quantile_of(&mut remains, 0.95), quantile_of(&mut remains, 0.5), without]
    };
    let mut all = vec![0.0; missing.len()];
    let mut by_station = vec![[0.0; 3]; stations.len()];
    by_drives(robot, stand, (stations, followed), (part, held), &mut |gives| {
        watch.go_on()?;
        raise(&mut all, gives, left, drawn);
        let found: Vec<[f64; 3]> = parallel::each(gives, of_station);
        gives.iter().zip(found).for_each(|(given, found)| by_station[given.station] = found);
        Ok(())
    })?;
    let mut sorted = all.clone();
    sorted.sort_by(f64::total_cmp);
    let of = |which: usize| by_station.iter().map(|found| found[which]).collect();
    let (median, p95) = (quantile(&sorted, 0.5), quantile(&sorted, 0.95));
    Ok(Remaining { median, p95, all, along: of(0), median_along: of(1), without: of(2) })
}

/// The largest error along a path, m, of every draw of the drives; the path stays as it is. Of a force that may point anywhere that which does
/// most in the draw.
///
/// # Errors
/// As [`super::mill`].
pub fn drawn_errors(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    (part, drawn, held): (ErrorPart, &Drawn, Option<&ToolWeight>),
    watch: Watch,
) -> Result<Vec<f64>, MillError> {
    let (whole, missing) = (times(drawn, |factor| factor)?, times(drawn, |factor| factor - 1.0)?);
    let mut largest = vec![0.0; whole.len()];
    by_drives(robot, stand, (stations, followed), (part, held), &mut |gives| {
        watch.go_on()?;
        raise(&mut largest, gives, Times { of_force: &whole, off: &missing }, drawn);
        Ok(())
    })?;
    Ok(largest)
}

/// What each drive gives of the displacement at a station.
struct Given {
    station: usize,
    by_drive: ByDrive,
}

enum ByDrive {
    /// Under a force that is known: m, a column for every drive.
    Known {
        by_drive: Matrix3x6<f64>,
        /// The same under the weight of a tool that is taken out.
        held: Matrix3x6<f64>,
        /// The direction that counts; `None` where all of it does.
        counted: Option<Vector3<f64>>,
        /// How far the tool moves in all, m.
        length: f64,
    },
    /// Under a force that may point anywhere: m along each of three axes where it points along each of them.
    Any(Box<[Matrix3<f64>; 6]>),
}

/// Of every draw, how many times each drive gives way under the force, and by how many times it is otherwise than it was taken.
#[derive(Clone, Copy)]
struct Times<'a> {
    of_force: &'a [Vector6<f64>],
    off: &'a [Vector6<f64>],
}

impl Given {
    /// The error of a draw, m, where each drive gives so many times that; it adds what an identification did not explain.
    fn error(&self, times: Times, (unexplained, draw): (Option<&Unexplained>, usize)) -> f64 {
        let (times, off) = (&times.of_force[draw], &times.off[draw]);
        match &self.by_drive {
            ByDrive::Known { by_drive, held, counted, length } => {
                let missed = |one: &Unexplained| one.in_space(draw, *length);
                let moved = by_drive * times + held * off + unexplained.map_or_else(Vector3::zeros, missed);
                counted.map_or_else(|| moved.norm(), |counted| counted.dot(&moved).abs())
            }
            ByDrive::Any(by_drive) => {
                let most = |times: &Vector6<f64>| {
                    let sum: Matrix3<f64> = by_drive.iter().zip(times).map(|(part, times)| part * *times).sum();
                    sum.symmetric_eigenvalues().amax()
                };
                let moved = || Moved { length: most(&Vector6::repeat(1.0)), coordinates: 3, counted: 3 };
                unexplained.map_or_else(|| most(times), |one| one.added(draw, most(times), &moved()))
            }
        }
    }

    /// The error of every draw, m.
    fn errors(&self, times: Times, drawn: &Drawn) -> Vec<f64> {
        (0..times.off.len()).map(|draw| self.error(times, (drawn.unexplained.as_ref(), draw))).collect()
    }

    /// No error is larger, m, and this is sooner found: no eigenvalue is larger than the sum of all, of which a drive has none below zero.
    fn most(&self, times: &Vector6<f64>, unexplained: Option<&Unexplained>) -> f64 {
        match (&self.by_drive, unexplained) {
            (ByDrive::Any(by_drive), None) => {
                by_drive.iter().zip(times).map(|(part, times)| part.trace() * times.abs()).sum::<f64>()
                    * (1.0 + ROUNDING)
            }
            (ByDrive::Known { .. }, _) | (_, Some(_)) => f64::INFINITY,
        }
    }
}

/// Stations whose drives are looked at together: enough for all threads, and little memory.
const TOGETHER: usize = 4096;

/// Hands out what the drives give at every station at which something pushes, some stations at a time.
fn by_drives(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    (part, held): (ErrorPart, Option<&ToolWeight>),
    each: &mut dyn FnMut(&[Given]) -> Result<(), MillError>,
) -> Result<(), MillError> {
    let of = |(station, (found, pushed)): (usize, (&Station, &Pushed))| {
        let acting = found.acting?;
        let axes = stand.cutting_axes(&found.sample);
        let counted = part.direction(&axes, &found.sample);
        let posture = compliance(robot, &pushed.joints, &stand.flange_from_tool);
        Some(posture.map(|posture| {
            let moved = |wrench: Wrench| posture.by_drive.each_ref().map(|drive| drive.deflection(&wrench).0);
            let by_drive = match (acting, counted) {
                (Acting::Any(newtons), None) => {
                    let parts = posture.by_drive.each_ref().map(|drive| drive.translation() * newtons);
                    ByDrive::Any(Box::new(parts))
                }
                // Along one direction a force of any does as much as one along it moves in all.
                (Acting::Any(newtons), Some(counted)) => {
                    let by_drive = Matrix3x6::from_columns(&moved(Wrench::force(counted * newtons)));
                    // The force that does most points the way in which one along it moves.
                    let most = by_drive.column_sum().try_normalize(0.0).unwrap_or(counted);
                    let length = newtons * (posture.compliance.translation() * most).norm();
                    ByDrive::Known { by_drive, held: Matrix3x6::zeros(), counted: None, length }
                }
                (Acting::Known { force, moment }, counted) => {
                    let by_drive = Matrix3x6::from_columns(&moved(wrench(&axes, force, moment)));
                    let weight = held.and_then(|tool| weight_of(tool, &posture.tool, &stand.flange_from_tool));
                    let held = weight.map_or_else(Matrix3x6::zeros, |weight| Matrix3x6::from_columns(&moved(weight)));
                    ByDrive::Known { by_drive, held, counted, length: by_drive.column_sum().norm() }
                }
            };
            Given { station, by_drive }
        }))
    };
    let all: Vec<(&[Station], &[Pushed])> = stations.chunks(TOGETHER).zip(followed.chunks(TOGETHER)).collect();
    for (i, (stations, followed)) in all.into_iter().enumerate() {
        let numbered = (i * TOGETHER..).zip(stations.iter().zip(followed));
        let gives: Vec<Given> = numbered.filter_map(of).collect::<Result<_, _>>()?;
        each(&gives)?;
    }
    Ok(())
}

/// The weight of a tool on an upright base as a wrench at the tip; `None` where nobody knows its centre.
fn weight_of(tool: &ToolWeight, base_from_tool: &Pose, flange_from_tool: &Pose) -> Option<Wrench> {
    let centre = (base_from_tool * flange_from_tool.inverse() * Point3::from(tool.centre?)).coords;
    let force = Vector3::new(0.0, 0.0, -tool.mass * GRAVITY);
    let moment = (centre - base_from_tool.translation.vector).cross(&force);
    Some(Wrench(Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)))
}

/// What `part` makes of the factors of every draw.
fn times(drawn: &Drawn, part: impl Fn(f64) -> f64) -> Result<Vec<Vector6<f64>>, MillError> {
    if drawn.factors.is_empty() {
        return Err(MillError::Value { what: "a number of draws", value: 0.0, expected: "at least one" });
    }
    Ok(drawn.factors.iter().map(|factors| Vector6::from_fn(|i, _| part(factors[i]))).collect())
}

/// Raises the largest error of every draw to that of some stations: a sum over the drives, each so many times as it gives.
fn raise(largest: &mut [f64], gives: &[Given], times: Times, drawn: &Drawn) {
    let unexplained = drawn.unexplained.as_ref();
    let of = |draw: usize| {
        let worse = |worst: f64, given: &Given| {
            let is_less = given.most(&times.of_force[draw], unexplained) <= worst;
            if is_less { worst } else { worst.max(given.error(times, (unexplained, draw))) }
        };
        gives.iter().fold(largest[draw], worse)
    };
    let raised = parallel::each_of(largest.len(), of);
    largest.copy_from_slice(&raised);
}

/// The known force on the tool, base axes; `None` in air.
pub(super) fn known_wrench(stand: &Stand, station: &Station) -> Result<Option<Wrench>, MillError> {
    match station.acting {
        None => Ok(None),
        Some(Acting::Any(_)) => Err(MillError::AnyDirection),
        Some(Acting::Known { force, moment }) => Ok(Some(wrench(&stand.cutting_axes(&station.sample), force, moment))),
    }
}

/// By how much the joints (model angles) give way under a wrench, rad: `A kappa A^T J^T w`.
pub(super) fn joint_deflection(
    robot: &Robot,
    theta: &[f64; 6],
    stand: &Stand,
    wrench: &Wrench,
) -> Result<Vector6<f64>, MillError> {
    let Arm::SixAxis { geometry, drives, .. } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let tip = (geometry.forward(theta) * stand.flange_from_tool).translation.vector;
    let kappa = drives.compliance_at(theta[1]).ok_or_else(|| PostureError::Unstable(robot.name.clone()))?;
    let torques = drives.transmission.0.transpose() * geometry.jacobian(theta, &tip).transpose() * wrench.0;
    Ok(drives.transmission.0 * torques.component_mul(&Vector6::from(kappa)))
}

/// What counts of the distance of the loaded tip from its target, m: the posture in which the springs hold the wrench, sought round by round.
fn error_left(
    robot: &Robot,
    stand: &Stand,
    station: &Station,
    (commanded, wrench): (&[f64; 6], &Wrench),
    part: ErrorPart,
) -> Result<f64, MillError> {
    let Arm::SixAxis { geometry, .. } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let mut theta = *commanded;
    for round in 0.. {
        let turned = joint_deflection(robot, &theta, stand, wrench)?;
        let next: [f64; 6] = std::array::from_fn(|i| commanded[i] + turned[i]);
        let change = (0..6).map(|i| (next[i] - theta[i]).abs()).fold(0.0, f64::max);
        theta = next;
        if change <= SETTLED {
            break;
        }
        if ROUNDS <= round {
            return Err(MillError::Unsettled { line: station.sample.line, change });
        }
    }
    let tip = (geometry.forward(&theta) * stand.flange_from_tool).translation.vector;
    let off = tip - (stand.base_from_part * Point3::from(station.sample.pose.tip)).coords;
    Ok(part
        .direction(&stand.cutting_axes(&station.sample), &station.sample)
        .map_or_else(|| off.norm(), |counted| counted.dot(&off).abs()))
}
