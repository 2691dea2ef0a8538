//! How far is a tool pushed off at every sample of a path that a robot follows at given rolls? Exactly, one posture after the other.
//!
//! At every sample the tool stands at the tip with its z axis into the work, turned about it by the roll; joints, compliance and
//! deflection follow from the pose. Nothing is sampled in between: steps are chosen when a path is cut.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3, Vector6};

use super::fault::{Blocked, MillError, Why};
use super::stations::{Acting, ErrorPart, Station, cutting_axes};
use crate::batch::SpatialArm;
use crate::compliance::{Posture, PostureError, compliance};
use crate::geometry::Geometry;
use crate::inverse::{Configuration, posture_of, within_limits};
use crate::limits::Limits;
use crate::robot::{Arm, Robot};
use crate::spatial::{Pose, Wrench};
use crate::tolerances::LIMIT;
use crate::toolpath::{Sample, ToolPose};
use crate::watch::Watch;

/// Between two samples no joint turns farther, rad: a path cut more coarsely is not followed.
pub(super) const LARGEST_TURN: f64 = 0.5;

/// Where the part stands, and how the tool is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// The part in the robot's base frame.
    pub base_from_part: Pose,
    /// The tool in the flange frame.
    pub flange_from_tool: Pose,
}

impl Stand {
    /// Feed, across and axial as columns, base axes.
    pub(super) fn cutting_axes(&self, sample: &Sample) -> Matrix3<f64> {
        self.base_from_part.rotation.to_rotation_matrix().matrix() * cutting_axes(sample)
    }

    /// The tool in the base frame at a sample and a roll, rad.
    pub(super) fn base_from_tool(&self, sample: &Sample, roll: f64) -> Result<Pose, MillError> {
        let pose = part_from_tool(&sample.pose, roll).ok_or(MillError::Roll { line: sample.line })?;
        Ok(self.base_from_part * pose)
    }
}

/// How the robot stands at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrangement {
    /// Which branch.
    pub configuration: Configuration,
    /// Of the tool about its axis, rad: of its x axis from the part's, seen along the tool's z axis.
    pub roll: f64,
}

/// The robot at one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pushed {
    /// How it stands.
    pub arrangement: Arrangement,
    /// Joint angles as the robot reports them, rad; turns go on from sample to sample.
    pub joints: [f64; 6],
    /// By how much the tip is moved, m, base axes: in the softest direction where the force may point anywhere; `None` where no force
    /// acts.
    pub moved: Option<Vector3<f64>>,
    /// What of it counts, m; 0 where no force acts.
    pub error: f64,
    /// What each drive gives of the displacement; sums to one.
    pub shares: Option<[f64; 6]>,
    /// The smallest distance of a joint from an end of its range, rad.
    pub limit_margin: f64,
    /// The smallest angle of wrist and arm from straight, rad.
    pub singular_margin: f64,
}

impl Pushed {
    /// Where nothing pushes, of margins that are not known yet.
    fn untouched(arrangement: Arrangement, joints: [f64; 6]) -> Self {
        Self { arrangement, joints, moved: None, error: 0.0, shares: None, limit_margin: 0.0, singular_margin: 0.0 }
    }

    /// By how much the tip is moved along the feed, across it and axial, m.
    pub fn parts(&self, stand: &Stand, sample: &Sample) -> Option<[f64; 3]> {
        self.moved.map(|moved| (stand.cutting_axes(sample).transpose() * moved).into())
    }

    /// The same along the outward normal of the surface, m, where the path says one: material left where it is positive.
    pub fn normal(&self, stand: &Stand, sample: &Sample) -> Option<f64> {
        let normal = ErrorPart::Normal.direction(&stand.cutting_axes(sample), sample);
        self.moved.zip(normal).map(|(moved, normal)| normal.dot(&moved))
    }
}

/// The tool's pose in the part: z into the work, x turned by a roll from the part's x axis; `None` where the axis lies along that.
pub fn part_from_tool(pose: &ToolPose, roll: f64) -> Option<Pose> {
    let z = -pose.axis;
    let x = (Vector3::x() - z.x * z).try_normalize(1e-6)?;
    let y = z.cross(&x);
    let (s, c) = roll.sin_cos();
    let axes = Matrix3::from_columns(&[x * c + y * s, y * c - x * s, z]);
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    Some(Pose::from_parts(Translation3::from(pose.tip), rotation))
}

/// Follows stations with an arm whose limits are narrowed by its margins.
///
/// # Errors
/// What no number can answer; inner: the first sample that is not reached, forbidden, or too near to a singular posture; a joint whose
/// range the path leaves.
pub(super) fn follow(
    (robot, arm): (&Robot, &SpatialArm),
    stand: &Stand,
    stations: &[Station],
    part: ErrorPart,
    arrangements: impl Iterator<Item = Arrangement>,
    watch: Watch,
) -> Result<Result<Vec<Pushed>, Blocked>, MillError> {
    // Joints first, which are turned into their ranges all together; then what happens there, in the same memory.
    let mut found: Vec<Pushed> = Vec::with_capacity(stations.len());
    for (station, arrangement) in stations.iter().zip(arrangements) {
        watch.go_on()?;
        let mut q = match held(arm, stand, &station.sample, arrangement)? {
            Ok(q) => q,
            Err(why) => return Ok(Err(stand.blocked(&station.sample, why))),
        };
        if let Some(before) = found.last().filter(|_| !station.is_fresh) {
            for (angle, before) in q.iter_mut().zip(before.joints) {
                *angle += TAU * ((before - *angle) / TAU).round();
                if !((*angle - before).abs() <= LARGEST_TURN) {
                    return Ok(Err(stand.blocked(&station.sample, Why::Jump)));
                }
            }
        }
        found.push(Pushed::untouched(arrangement, q));
    }
    let mut from = 0;
    while from < stations.len() {
        let to = (from + 1..stations.len()).find(|i| stations[*i].is_fresh).unwrap_or(stations.len());
        if let Err(at) = turn_into_range(&mut found[from..to], arm) {
            return Ok(Err(stand.blocked(&stations[from + at].sample, Why::Jump)));
        }
        from = to;
    }
    for (station, one) in stations.iter().zip(&mut found) {
        watch.go_on()?;
        *one = pushed(robot, stand, station, part, (one.arrangement, &one.joints))?;
    }
    Ok(Ok(found))
}

/// The joints with which the arm holds a sample.
pub(super) fn held(
    arm: &SpatialArm,
    stand: &Stand,
    sample: &Sample,
    arrangement: Arrangement,
) -> Result<Result<[f64; 6], Why>, MillError> {
    let flange = stand.base_from_tool(sample, arrangement.roll)? * stand.flange_from_tool.inverse();
    let theta = posture_of(&arm.geometry, &flange, arrangement.configuration);
    let Some(theta) = theta else { return Ok(Err(Why::Reach { beyond: 0.0 })) };
    if !(arm.clearance - LIMIT <= arm.geometry.singular_margin(&theta)) {
        return Ok(Err(Why::Narrow));
    }
    Ok(within_limits(&arm.geometry, &arm.limits, &theta).ok_or(Why::Narrow))
}

/// What happens at one sample.
pub(super) fn pushed(
    robot: &Robot,
    stand: &Stand,
    station: &Station,
    part: ErrorPart,
    (arrangement, joints): (Arrangement, &[f64; 6]),
) -> Result<Pushed, MillError> {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let posture = compliance(robot, joints, &stand.flange_from_tool)?;
    let (limit_margin, singular_margin) = margins(geometry, limits, joints);
    let mut found = Pushed { limit_margin, singular_margin, ..Pushed::untouched(arrangement, *joints) };
    let Some(acting) = station.acting else { return Ok(found) };
    let axes = stand.cutting_axes(&station.sample);
    let counted = part.direction(&axes, &station.sample);
    let wrench = wrench_of(acting, &posture, &axes, counted.as_ref());
    let (moved, _) = posture.compliance.deflection(&wrench);
    let along = counted.unwrap_or_else(|| moved.try_normalize(0.0).unwrap_or_else(Vector3::z));
    let by_drive = posture.by_drive.map(|drive| drive.deflection(&wrench).0.dot(&along));
    let sum: f64 = by_drive.iter().sum();
    found.moved = Some(moved);
    found.error = along.dot(&moved).abs();
    found.shares = (sum != 0.0).then(|| by_drive.map(|drive| drive / sum));
    Ok(found)
}

/// What acts at a posture, base axes; of a force that may point anywhere that which moves most of what counts.
fn wrench_of(acting: Acting, posture: &Posture, axes: &Matrix3<f64>, counted: Option<&Vector3<f64>>) -> Wrench {
    match acting {
        Acting::Known { force, moment } => wrench(axes, force, moment),
        Acting::Any(newtons) => {
            let c = posture.compliance.translation();
            let softest = counted.map_or_else(|| posture.compliance.worst().1, |counted| (c * counted).normalize());
            Wrench::force(softest * newtons)
        }
    }
}

/// A force and a moment along the axes of the cut, in the axes in which those are given.
pub(super) fn wrench(axes: &Matrix3<f64>, force: [f64; 3], moment: f64) -> Wrench {
    let (force, moment) = (axes * Vector3::from(force), moment * axes.column(2));
    Wrench(Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z))
}

/// The smallest distance of a joint from an end of its range, and of wrist and arm from straight, rad.
fn margins(geometry: &Geometry, limits: &Limits, joints: &[f64; 6]) -> (f64, f64) {
    let theta = geometry.model_angles(joints, limits.third_axis);
    let room = limits.joints.iter().zip(joints).map(|(range, q)| range.room(*q));
    let enclosed = std::f64::consts::PI - theta[2];
    let between = limits.elbow.room(limits.elbow.turn_to(enclosed, LIMIT).unwrap_or(enclosed));
    (room.fold(between, f64::min), geometry.singular_margin(&theta))
}

impl Stand {
    pub(super) fn blocked(&self, sample: &Sample, why: Why) -> Blocked {
        let tip = (self.base_from_part * Point3::from(sample.pose.tip)).coords.into();
        Blocked { line: sample.line, way: sample.way, tip, why, samples: 0 }
    }
}

/// Turns each joint by whole turns, the same all along, so that it keeps its range; the first place that leaves it where none do.
fn turn_into_range(found: &mut [Pushed], arm: &SpatialArm) -> Result<(), usize> {
    for joint in 0..6 {
        let range = arm.limits.joints[joint];
        // Other limits than its own leave joint 3 no choice.
        if !range.is_bounded() || joint == 2 && arm.limits.third_is_wound() {
            continue;
        }
        let all = found.iter().map(|one| one.joints[joint]);
        let (from, to) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| (low.min(q), high.max(q)));
        // The turns that leave the most room at the nearer end.
        let turns = TAU * ((range.middle() - f64::midpoint(from, to)) / TAU).round();
        for (i, q) in found.iter_mut().map(|one| &mut one.joints).enumerate() {
            q[joint] += turns;
            if !range.contains(q[joint], LIMIT) {
                return Err(i);
            }
        }
    }
    Ok(())
}
