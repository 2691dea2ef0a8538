//! A script for RoboDK (Python): the part's frame, the tools, a target for each place, and a program through them, in the station that is open.
//!
//! A station may hold a robot of another size, or one whose base and flange frames lie elsewhere. So the script first compares where that robot
//! has its tool at the joints of every place with where this library has it, and makes nothing where they differ.

use super::angles::{fixed, quaternion};
use super::head::{Text, ascii, of_joints_alone};
use super::steps::{Program, Step};
use super::{Language, ProgramFault, ProgramFile};
use crate::spatial::Pose;

/// Decimals of angles, deg, and of lengths, mm.
const DECIMALS: usize = 6;
/// Of the parts of a quaternion.
const OF_TURN: usize = 10;

/// What is the same in every script, behind its numbers.
const SCRIPT: &str = r#"

def mat(x, y, z, w, i, j, k):
    """A pose of mm and a unit quaternion."""
    return robomath.Mat([
        [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w), x],
        [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w), y],
        [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j), z],
        [0, 0, 0, 1],
    ])


def apart(a, b):
    """How far two poses are apart: mm, and deg."""
    moved = sum((a[i, 3] - b[i, 3]) ** 2 for i in range(3)) ** 0.5
    turned = sum((a[i, j] - b[i, j]) ** 2 for i in range(3) for j in range(3)) ** 0.5
    return moved, math.degrees(2 * math.asin(min(1.0, turned / 8**0.5)))


def main():
    rdk = robolink.Robolink()
    robot = rdk.ItemUserPick("Which robot is the " + ROBOT + "?", robolink.ITEM_TYPE_ROBOT)
    if not robot.Valid():
        raise SystemExit("no robot was chosen")
    part = mat(*PART)
    for line, joints, pose, _, tool in PLACES:
        here = robot.SolveFK(list(joints)) * mat(*TOOLS[tool][1])
        moved, turned = apart(here, part * mat(*pose))
        if not (moved < MOST_MM and turned < MOST_DEG):
            raise SystemExit(
                "line %d of the path: at joints %s deg %s has its tool %.3f mm and %.3f deg beside where %s has it by stiffarm. "
                "Nothing was made: choose the robot of that name, count its joints as the pendant does, and let its base frame stand on axis 1 "
                "at the floor, and its flange frame as the head of this script says." % (line, joints, robot.Name(), moved, turned, ROBOT)
            )
    rdk.Render(False)
    try:
        frame = rdk.AddFrame(NAME + " part", robot.Parent())
        frame.setPose(part)
        tools = [robot.AddTool(mat(*pose), name) for name, pose in TOOLS]
        program = rdk.AddProgram(NAME, robot)
        program.setPoseFrame(frame)
        held = speed = None
        for n, (line, joints, pose, mm_per_s, tool) in enumerate(PLACES):
            begins = tool != held
            if begins:
                if held is not None:
                    program.Pause()
                program.setPoseTool(tools[tool])
                held = tool
            target = rdk.AddTarget("%s %d, line %d" % (NAME, n + 1, line), frame, robot)
            if begins:
                target.setAsJointTarget()
            else:
                target.setAsCartesianTarget()
            target.setPose(mat(*pose))
            target.setJoints(list(joints))
            if begins:
                program.MoveJ(target)
                continue
            if mm_per_s != speed:
                program.setSpeed(mm_per_s)
                speed = mm_per_s
            program.MoveL(target)
        program.ShowInstructions(False)
        program.ShowTargets(False)
    finally:
        rdk.Render(True)
    print("%s: %d targets and a program for %s" % (NAME, len(PLACES), robot.Name()))


if __name__ == "__main__":
    main()
"#;

pub(super) fn files(program: &Program) -> Result<Vec<ProgramFile>, ProgramFault> {
    let setup = program.setup;
    let lines = of_joints_alone(program)?;
    let mut text = Text::default();
    text.line(
        "# A script for RoboDK: run it in a station with this robot. It makes a frame, tools, targets and a program.",
    );
    text.lines("# ", &lines);
    text.line("import math\n\nfrom robodk import robolink, robomath\n");
    text.line(&format!("NAME = {}", quoted(&program.style.name)));
    text.line(&format!("ROBOT = {}", quoted(setup.robot)));
    text.line("# So far may the robot of the station have its tool elsewhere.\nMOST_MM, MOST_DEG = 0.1, 0.01");
    text.line("# Poses: x, y, z in mm and a quaternion w, x, y, z. The part in the robot's base, and each tool in the flange frame.");
    text.line(&format!("PART = {}", pose(&setup.base_from_part)));
    let tools: Vec<String> = setup
        .tools
        .iter()
        .map(|tool| format!("({}, {})", quoted(&tool.name()), pose(&tool.flange_from_tool)))
        .collect();
    text.line(&format!("TOOLS = [{}]", tools.join(", ")));
    text.line("# Of each place: line of the path, joints as the pendant shows them [deg], the tool in the part, speed of the way to it [mm/s], which tool.");
    text.line("PLACES = [");
    program.steps.iter().for_each(|step| text.line(&place(step)));
    text.line("]");
    text.0.push_str(SCRIPT);
    Ok(vec![ProgramFile { name: format!("{}.{}", program.name_of(None), Language::RoboDk.ending()), text: text.0 }])
}

fn place(step: &Step) -> String {
    let joints = step.joints.map(|q| fixed(q.to_degrees(), DECIMALS)).join(", ");
    let speed = fixed(step.speed * 1e3, DECIMALS);
    format!("    ({}, ({joints}), {}, {speed}, {}),", step.line, pose(&step.part_from_tool), step.tool)
}

fn pose(pose: &Pose) -> String {
    let t = pose.translation;
    let lengths = [t.x, t.y, t.z].map(|x| fixed(x * 1e3, DECIMALS));
    let turn = quaternion(&pose.rotation).map(|part| fixed(part, OF_TURN));
    format!("({}, {})", lengths.join(", "), turn.join(", "))
}

/// A text as Python reads it.
fn quoted(text: &str) -> String {
    format!("\"{}\"", ascii(text).replace('\\', "\\\\").replace('"', "\\\""))
}
