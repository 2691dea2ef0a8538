//! ROS 2: the message `trajectory_msgs/msg/JointTrajectory` as YAML, joints in rad and times in s.

use super::angles::fixed;
use super::head::{Text, of_joints_alone};
use super::steps::{Program, Step};
use super::{Language, ProgramFault, ProgramFile};

/// Decimals of angles, rad.
const DECIMALS: usize = 9;

/// Between two points, s.
const SHORTEST: f64 = 1e-6;

/// No joint turns faster, rad/s: 30 deg/s. A tool that hardly moves while it turns has no other limit.
const FASTEST_JOINT: f64 = std::f64::consts::PI / 6.0;

pub(super) fn files(program: &Program) -> Result<Vec<ProgramFile>, ProgramFault> {
    if 1 < program.setup.tools.len() {
        return Err(ProgramFault::Tools);
    }
    let lines = of_joints_alone(program)?;
    let mut text = Text::default();
    text.line("# trajectory_msgs/msg/JointTrajectory: positions in rad, times from the first point, where the robot must stand already.");
    text.line("# Joints as the pendant shows them. A description (URDF) may count them otherwise: compare one posture before it runs.");
    text.line("# The names are those of ROS-Industrial: put in those of the controller.");
    text.line("# Between points the tool moves at the feed rate of the path, through the air at the program's own speed; slower where a joint would turn faster");
    text.line("# than 30 deg/s. Accelerations of the joints are not limited here.");
    text.lines("# ", &lines);
    text.line("joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]");
    text.line("points:");
    // A place that is said twice is one point.
    let mut steps: Vec<&Step> = program.steps.iter().collect();
    steps.dedup_by(|step, before| turned(before, step) < 10_f64.powi(-(DECIMALS as i32)));
    let mut time = 0.0;
    for (i, step) in steps.iter().enumerate() {
        if 0 < i {
            time += duration(steps[i - 1], step);
        }
        let positions = step.joints.map(|q| fixed(q, DECIMALS)).join(", ");
        let nanoseconds = (time * 1e9).round() as u64;
        let (whole, rest) = (nanoseconds / 1_000_000_000, nanoseconds % 1_000_000_000);
        text.line(&format!("  - {{positions: [{positions}], time_from_start: {{sec: {whole}, nanosec: {rest}}}}}"));
    }
    Ok(vec![ProgramFile { name: format!("{}.{}", program.name_of(None), Language::Ros2.ending()), text: text.0 }])
}

/// By how much the joint that turns most turns, rad.
fn turned(from: &Step, to: &Step) -> f64 {
    from.joints.iter().zip(to.joints).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max)
}

/// How long the way from a step to the next takes, s; two points never have one time.
fn duration(from: &Step, to: &Step) -> f64 {
    let length = (to.part_from_tool.translation.vector - from.part_from_tool.translation.vector).norm();
    (length / to.speed).max(turned(from, to) / FASTEST_JOINT).max(SHORTEST)
}
