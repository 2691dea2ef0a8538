//! ABB: quaternions, mm, deg, mm/s; configurations by quarter turns.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;

use super::angles::{OF_JOINT, OF_QUATERNION, fixed, mm, quaternion};
use super::head::{Dialect, Text, sentences, tools};
use super::steps::{Program, Step};
use super::{Flange, Language, ProgramFile, Setup};
use crate::spatial::Pose;

/// No further axes.
const EXTERNAL: &str = "[9E9,9E9,9E9,9E9,9E9,9E9]";

/// How fast the tool turns at most, deg/s, and further axes, mm/s and deg/s: those of ABB's own speeds.
const OTHER_SPEEDS: &str = "500,5000,1000";

pub(super) fn files(program: &Program) -> Vec<ProgramFile> {
    let name = program.name_of(None);
    let is_one = program.parts.len() == 1;
    let mut main = begun(program, &name);
    data(program, &mut main);
    if is_one {
        procedure(program, &name, &program.steps, &mut main);
        return vec![ended(&name, main)];
    }
    main.line(&format!("  PROC {name}()"));
    for (part, _) in program.named_parts() {
        main.line(&format!("    {part};"));
    }
    main.line("  ENDPROC");
    let mut files = vec![ended(&name, main)];
    for (part, steps) in program.named_parts() {
        let mut text = begun(program, &part);
        procedure(program, &part, steps, &mut text);
        files.push(ended(&part, text));
    }
    files
}

fn begun(program: &Program, name: &str) -> Text {
    let setup = program.setup;
    let dialect = Dialect {
        angles: ["Rz", "Ry", "Rx"],
        frame: ("Work object, in the robot's base", setup.base_from_part),
        tools: tools(program, Flange::Down, "in the flange frame (tool0)"),
        flange: Flange::Down,
    };
    let mut head = sentences(program, &dialect);
    // Quaternions have no gimbal.
    head.pop();
    let mut text = Text::default();
    text.line(&format!("MODULE {name}_module"));
    text.lines("  ! ", &head);
    text
}

fn ended(name: &str, mut text: Text) -> ProgramFile {
    text.line("ENDMODULE");
    ProgramFile { name: format!("{name}.{}", Language::Rapid.ending()), text: text.0 }
}

/// Tool and work object, under names of the program.
fn data(program: &Program, text: &mut Text) {
    let (setup, name) = (program.setup, &program.style.name);
    let part = frame(&setup.base_from_part);
    text.line("  ! The load [1,[0,0,1],...] only stands in for the one that is to be identified.");
    for (i, tool) in setup.tools.iter().enumerate() {
        let (name, tool) = (tool_name(program, i), frame(&setup.tool_in(Flange::Down, tool)));
        text.line(&format!("  PERS tooldata {name}:=[TRUE,[{tool}],[1,[0,0,1],[1,0,0,0],0,0,0]];"));
    }
    text.line(&format!("  PERS wobjdata {name}_wobj:=[FALSE,TRUE,\"\",[{part}],[[0,0,0],[1,0,0,0]]];"));
}

fn procedure(program: &Program, name: &str, steps: &[Step], text: &mut Text) {
    let (setup, style) = (program.setup, program.style);
    text.line(&format!("  PROC {name}()"));
    if !setup.knows_joints() {
        // The configuration is that in which the robot stands.
        text.line("    ConfJ\\Off;");
    }
    text.line(if setup.knows_joints() { "    ConfL\\On;" } else { "    ConfL\\Off;" });
    begin(program, &steps[0], text);
    let zone = if style.blend == 0.0 {
        "fine".to_owned()
    } else {
        // The orientation may be rounded 1.5 times as far, as in ABB's own zones.
        let (near, far) = (mm(style.blend), mm(1.5 * style.blend));
        format!("[FALSE,{near},{far},{far},1,{far},1]")
    };
    for (i, step) in steps.iter().enumerate().skip(1) {
        if Program::change_at(steps, i) {
            text.lines("    ! ", &program.change_to(step));
            text.line("    Stop;");
            begin(program, step, text);
            continue;
        }
        let (with, zone) = (with(program, step), if Program::ends_at(steps, i) { "fine" } else { &zone });
        let (target, speed) = (target(setup, step), fixed(step.speed * 1e3, 3));
        text.line(&format!("    MoveL {target},[{speed},{OTHER_SPEEDS}],{zone},{with};"));
    }
    text.line("  ENDPROC");
}

/// Goes to the place of a step in joints, where they are known.
fn begin(program: &Program, step: &Step, text: &mut Text) {
    let (setup, with) = (program.setup, with(program, step));
    if setup.knows_joints() {
        let joints = step.joints.map(|q| fixed(q.to_degrees(), OF_JOINT)).join(",");
        text.line(&format!("    MoveAbsJ [[{joints}],{EXTERNAL}],v100,fine,{with};"));
    } else {
        text.line(&format!("    MoveJ {},v100,fine,{with};", target(setup, step)));
    }
}

/// What moves in which work object.
fn with(program: &Program, step: &Step) -> String {
    format!("{}\\WObj:={}_wobj", tool_name(program, step.tool), program.style.name)
}

/// The name of a tool in a program: short, so that several stay below 32 signs.
fn tool_name(program: &Program, tool: usize) -> String {
    let number = program.setup.tools[tool].number.map_or_else(String::new, |number| number.to_string());
    format!("{}_tool{number}", program.style.name)
}

/// A place as a robtarget.
fn target(setup: &Setup, step: &Step) -> String {
    format!("[{},[{}],{EXTERNAL}]", frame(&step.part_from_tool), configuration(setup, &step.joints))
}

fn frame(pose: &Pose) -> String {
    let t = pose.translation;
    let q = quaternion(&pose.rotation).map(|part| fixed(part, OF_QUATERNION)).join(",");
    format!("[{},{},{}],[{q}]", mm(t.x), mm(t.y), mm(t.z))
}

/// cf1, cf4, cf6: in which quarter turn these joints stand. cfx: 4 with the wrist centre behind axis 1, 2 with it behind the upper
/// arm, 1 with joint 5 below 0, as the confdata of serial robots has it. Zeros, which are then not looked at, where it is not known how
/// the controller counts.
fn configuration(setup: &Setup, joints: &[f64; 6]) -> String {
    if !setup.knows_joints() {
        return "0,0,0,0".into();
    }
    let quarter = |joint: usize| (joints[joint] / FRAC_PI_2).floor();
    let theta = setup.geometry.model_angles(joints, setup.third_axis);
    let [_, shoulder, elbow, wrist, _] = setup.geometry.points(&theta).map(Vector3::from);
    let (s, c) = theta[0].sin_cos();
    let ahead = Vector3::new(c, s, 0.0);
    let across = Vector3::new(-s, c, 0.0);
    let is_behind = wrist.dot(&ahead) < 0.0;
    // Across the upper arm, to the side to which the arm leans forwards.
    let is_behind_arm = (wrist - shoulder).dot(&across.cross(&(elbow - shoulder))) < 0.0;
    let cfx = 4 * u8::from(is_behind) + 2 * u8::from(is_behind_arm) + u8::from(joints[4] < 0.0);
    format!("{},{},{},{cfx}", fixed(quarter(0), 0), fixed(quarter(3), 0), fixed(quarter(5), 0))
}
