//! How far is a tool pushed off along a path that a robot follows in one configuration, the part standing somewhere?
//!
//! At every sample the tool stands at the tip with its z axis into the work, turned about it by one roll; joints, compliance and
//! deflection follow from the pose. Nothing is sampled in between: steps are chosen when a path is cut.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3, Vector6};

use crate::compliance::{PostureError, compliance};
use crate::inverse::{Configuration, postures, within_limits};
use crate::robot::{Arm, Robot};
use crate::spatial::{Pose, Wrench};
use crate::toolpath::{Sample, ToolPose};

/// Between two samples no joint turns farther, rad: a path cut more coarsely is not followed.
const LARGEST_TURN: f64 = 0.5;

/// Where the part stands, and how the tool is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// The part in the robot's base frame.
    pub base_from_part: Pose,
    /// The tool in the flange frame.
    pub flange_from_tool: Pose,
    /// Of the tool about its axis, rad: of its x axis from the part's, seen along the tool's z axis.
    pub roll: f64,
    /// What every joint keeps from its limits, rad.
    pub limit_margin: f64,
    /// What wrist and arm keep from straight, rad.
    pub singular_margin: f64,
}

/// A force on the tool, in the axes of the cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acting {
    /// N along the feed, across it (to its left) and axial (away from the work).
    pub force: [f64; 3],
    /// N m about the axis away from the work.
    pub moment: f64,
}

/// The robot at one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pushed {
    /// Joint angles as the robot reports them, rad; turns go on from sample to sample.
    pub joints: [f64; 6],
    /// By how much the tip is moved, m, base axes; `None` where no force acts.
    pub moved: Option<Vector3<f64>>,
    /// The same along the feed, across it and axial, m.
    pub parts: Option<[f64; 3]>,
    /// The smallest distance of a joint from an end of its range, rad.
    pub limit_margin: f64,
    /// The smallest angle of wrist and arm from straight, rad.
    pub singular_margin: f64,
}

/// A path that is not followed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MillError {
    /// Six joints are needed.
    #[error(transparent)]
    Posture(#[from] PostureError),
    /// The configuration does not reach a pose.
    #[error("line {line}, {way:.4} m along the path: {configuration} does not reach it")]
    Reach {
        /// Of the file.
        line: usize,
        /// From the beginning of the path, m.
        way: f64,
        /// Which.
        configuration: Configuration,
    },
    /// A limit forbids a pose, whatever turns are made.
    #[error("line {line}, {way:.4} m along the path: a joint limit forbids {configuration}")]
    Limit {
        /// Of the file.
        line: usize,
        /// From the beginning of the path, m.
        way: f64,
        /// Which.
        configuration: Configuration,
    },
    /// Wrist or arm are too straight.
    #[error("line {line}, {way:.4} m along the path: {:.2} deg from a singular posture", angle.to_degrees())]
    Singular {
        /// Of the file.
        line: usize,
        /// From the beginning of the path, m.
        way: f64,
        /// rad.
        angle: f64,
    },
    /// No number of whole turns keeps a joint within its range all along.
    #[error("joint {joint} turns from {:.1} to {:.1} deg along the path, more than its range with its margin", from.to_degrees(), to.to_degrees())]
    Range {
        /// From 1.
        joint: usize,
        /// rad.
        from: f64,
        /// rad.
        to: f64,
    },
    /// Between two samples a joint turns too far.
    #[error("line {line}, {way:.4} m along the path: joint {joint} turns by {:.1} deg from one sample to the next; expected finer steps, or another roll", turn.to_degrees())]
    Jump {
        /// Of the file.
        line: usize,
        /// From the beginning of the path, m.
        way: f64,
        /// From 1.
        joint: usize,
        /// rad.
        turn: f64,
    },
    /// The tool axis lies along the part's x axis, from which the roll counts.
    #[error("line {line}: the tool axis lies along the part's x axis, from which the roll counts")]
    Roll {
        /// Of the file.
        line: usize,
    },
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

/// Feed, across and axial as columns, part frame. Where the tool goes along its axis, or only turns, any direction across it stands
/// for the feed: the part's x axis, laid across.
pub fn cutting_axes(sample: &Sample) -> Matrix3<f64> {
    let a = sample.pose.axis;
    let across = |v: Vector3<f64>| (v - v.dot(&a) * a).try_normalize(1e-6);
    let feed = sample.direction.and_then(across).or_else(|| across(Vector3::x()));
    let feed = feed.unwrap_or_else(|| across(Vector3::y()).unwrap_or_else(Vector3::zeros));
    Matrix3::from_columns(&[feed, a.cross(&feed), a])
}

/// Follows samples in one configuration; `acting` says what pushes on the tool at each, nothing in air.
///
/// # Errors
/// The first sample that is not reached, forbidden, or too near to a singular posture; a joint whose range the path leaves.
pub fn follow(
    robot: &Robot,
    stand: &Stand,
    configuration: Configuration,
    samples: &[Sample],
    acting: impl Fn(usize, &Sample) -> Option<Acting>,
) -> Result<Vec<Pushed>, MillError> {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let tool_from_flange = stand.flange_from_tool.inverse();
    let mut joints: Vec<[f64; 6]> = Vec::with_capacity(samples.len());
    let mut margins = Vec::with_capacity(samples.len());
    for sample in samples {
        let (line, way) = (sample.line, sample.way);
        let pose = part_from_tool(&sample.pose, stand.roll).ok_or(MillError::Roll { line })?;
        let flange = stand.base_from_part * pose * tool_from_flange;
        let found = postures(geometry, &flange).found;
        let theta = found.into_iter().find(|(known, _)| *known == configuration).map(|(_, theta)| theta);
        let theta = theta.ok_or(MillError::Reach { line, way, configuration })?;
        let angle = geometry.singular_margin(&theta);
        if !(stand.singular_margin <= angle) {
            return Err(MillError::Singular { line, way, angle });
        }
        let mut q = within_limits(geometry, limits, &theta).ok_or(MillError::Limit { line, way, configuration })?;
        if let Some(before) = joints.last() {
            for (joint, angle) in q.iter_mut().enumerate() {
                *angle += TAU * ((before[joint] - *angle) / TAU).round();
                let turn = *angle - before[joint];
                if !(turn.abs() <= LARGEST_TURN) {
                    return Err(MillError::Jump { line, way, joint: joint + 1, turn });
                }
            }
        }
        joints.push(q);
        margins.push(angle);
    }
    let room = turned_into_range(&mut joints, |joint| limits.joints[joint], stand.limit_margin)?;
    let mut found = Vec::with_capacity(samples.len());
    for (i, sample) in samples.iter().enumerate() {
        let mut pushed =
            Pushed { joints: joints[i], moved: None, parts: None, limit_margin: room[i], singular_margin: margins[i] };
        if let Some(Acting { force, moment }) = acting(i, sample) {
            let axes = stand.base_from_part.rotation.to_rotation_matrix().matrix() * cutting_axes(sample);
            let (force, moment) = (axes * Vector3::from(force), moment * axes.column(2));
            let wrench = Wrench(Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z));
            let posture = compliance(robot, &joints[i], &stand.flange_from_tool)?;
            let (moved, _) = posture.compliance.deflection(&wrench);
            pushed.moved = Some(moved);
            pushed.parts = Some((axes.transpose() * moved).into());
        }
        found.push(pushed);
    }
    Ok(found)
}

/// Turns each joint by whole turns, the same all along, so that it keeps its range; tells the room that is left at each sample.
fn turned_into_range(
    joints: &mut [[f64; 6]],
    range: impl Fn(usize) -> crate::interval::Interval,
    margin: f64,
) -> Result<Vec<f64>, MillError> {
    let mut room = vec![f64::INFINITY; joints.len()];
    for joint in 0..6 {
        let all = joints.iter().map(|q| q[joint]);
        let (from, to) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| (low.min(q), high.max(q)));
        let range = range(joint);
        // The turns that leave the most room at the nearer end.
        let wanted = if range.is_bounded() { (range.middle() - f64::midpoint(from, to)) / TAU } else { 0.0 };
        let turns = TAU * wanted.round();
        let left = (from + turns - range.min()).min(range.max() - to - turns);
        if !joints.is_empty() && !(margin <= left) {
            return Err(MillError::Range { joint: joint + 1, from: from + turns, to: to + turns });
        }
        for (q, room) in joints.iter_mut().zip(&mut room) {
            q[joint] += turns;
            *room = room.min((q[joint] - range.min()).min(range.max() - q[joint]));
        }
    }
    Ok(room)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::load::Load;
    use crate::toolpath::{Builtin, Steps, samples};

    fn robot() -> Robot {
        paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("a robot of the paper")
    }

    fn stand() -> Stand {
        Stand {
            base_from_part: Pose::new(Vector3::new(1.6, 0.2, 0.6), Vector3::z() * 0.4),
            flange_from_tool: Pose::new(Vector3::new(0.1, 0.0, 0.25), Vector3::y() * 0.5),
            roll: 0.3,
            limit_margin: 0.0,
            singular_margin: 0.05,
        }
    }

    fn path(text: &str) -> Vec<Sample> {
        let (mut all, mut way) = (Vec::new(), 0.0);
        for one in text.parse::<Builtin>().unwrap().moves(Some(0.01)) {
            all.extend(samples(&one, &Steps::USUAL, way));
            way += one.length();
        }
        all
    }

    /// The first configuration that follows the path.
    fn followed(stand: &Stand, samples: &[Sample], acting: Acting) -> (Configuration, Vec<Pushed>) {
        let robot = robot();
        let all = Configuration::ALL.into_iter();
        let mut found =
            all.filter_map(|one| Some((one, follow(&robot, stand, one, samples, |_, _| Some(acting)).ok()?)));
        found.next().expect("some configuration follows it")
    }

    /// The joints put the tool where the path has it, and it is pushed as the compliance at these joints says under the same force,
    /// given by its direction in the tool's own axes.
    #[test]
    fn every_sample_is_reached_and_pushed_as_its_posture_says() {
        let (robot, stand) = (robot(), stand());
        let samples = path("circle:0.3");
        let acting = Acting { force: [300.0, -120.0, 80.0], moment: 0.0 };
        let (_, found) = followed(&stand, &samples, acting);
        for (sample, pushed) in samples.iter().zip(&found) {
            let posture = compliance(&robot, &pushed.joints, &stand.flange_from_tool).unwrap();
            let tip = stand.base_from_part * nalgebra::Point3::from(sample.pose.tip);
            assert!((posture.tool.translation.vector - tip.coords).norm() < 1e-9);
            let z = posture.tool.rotation * Vector3::z();
            assert!((z + stand.base_from_part.rotation * sample.pose.axis).norm() < 1e-9);
            let feed = stand.base_from_part.rotation * sample.direction.unwrap();
            let force = 300.0 * feed - 120.0 * (-z).cross(&feed) - 80.0 * z;
            let load = Load::along_base(force.into()).unwrap();
            let moved = pushed.moved.unwrap();
            assert!((posture.under(load).value * load.newtons() / moved.norm() - 1.0).abs() < 1e-9);
            let [along, across, axial] = pushed.parts.unwrap();
            assert!((along - moved.dot(&feed)).abs() < 1e-12 && (axial + moved.dot(&z)).abs() < 1e-12);
            assert!((along.hypot(across).hypot(axial) / moved.norm() - 1.0).abs() < 1e-12);
        }
        for pair in found.windows(2) {
            assert!((0..6).all(|i| (pair[1].joints[i] - pair[0].joints[i]).abs() < 0.2));
        }
    }

    /// Turned about the joint-1 axis, all is the same; a moment alone pushes by the other block of the compliance.
    #[test]
    fn a_part_turned_about_the_first_axis_is_milled_as_before() {
        let samples = path("rect:0.3x0.2");
        let acting = Acting { force: [200.0, 100.0, 50.0], moment: 3.0 };
        let one = stand();
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -0.5);
        let other =
            Stand { base_from_part: Pose::from_parts(Translation3::identity(), turn) * one.base_from_part, ..one };
        let ((configuration, a), (same, b)) = (followed(&one, &samples, acting), followed(&other, &samples, acting));
        assert_eq!(configuration, same);
        for (a, b) in a.iter().zip(&b) {
            let (a, b) = (a.parts.unwrap(), b.parts.unwrap());
            assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-12), "{a:?} {b:?}");
        }
        let only =
            |force: [f64; 3], moment: f64| followed(&one, &samples, Acting { force, moment }).1[7].moved.unwrap();
        let sum = only([200.0, 100.0, 50.0], 0.0) + only([0.0; 3], 3.0);
        assert!((a[7].moved.unwrap() - sum).norm() < 1e-15 && 1e-9 < only([0.0; 3], 3.0).norm());
    }

    #[test]
    fn what_is_not_followed_says_where_and_why() {
        let (robot, one) = (robot(), stand());
        let samples = path("line:0.4");
        let none = |_: usize, _: &Sample| None;
        let (configuration, found) = followed(&one, &samples, Acting { force: [1.0; 3], moment: 0.0 });
        let air = follow(&robot, &one, configuration, &samples, none).unwrap();
        assert!(air.iter().all(|pushed| pushed.moved.is_none()) && air[0].joints == found[0].joints);
        let at = |stand: Stand| follow(&robot, &stand, configuration, &samples, none).unwrap_err();
        let far = Pose::translation(9.0, 0.0, 0.0);
        assert!(matches!(at(Stand { base_from_part: far, ..one }), MillError::Reach { .. }));
        assert!(matches!(at(Stand { singular_margin: 1.6, ..one }), MillError::Singular { .. }));
        assert!(matches!(at(Stand { limit_margin: 4.0, ..one }), MillError::Range { .. }));
        let mut coarse = samples.clone();
        coarse[1].pose.tip.y += 1.2;
        coarse[1].pose.tip.x -= 0.6;
        assert!(follow(&robot, &one, configuration, &coarse, none).is_err());
        let mut aside = samples;
        aside[3].pose.axis = Vector3::x();
        assert!(matches!(follow(&robot, &one, configuration, &aside, none), Err(MillError::Roll { .. })));
    }
}
