//! KUKA: `R = Rz(A) Ry(B) Rx(C)`, mm, deg, m/s.

use super::angles::{OF_ANGLE, OF_JOINT, Zyx, fixed, mm};
use super::head::{Dialect, Text, sentences, tools};
use super::steps::{Program, Step};
use super::{Flange, Language, ProgramFile};
use crate::spatial::Pose;

/// What a controller goes by that is at hand before the start, percent.
const START_PERCENT: u32 = 10;

pub(super) fn files(program: &Program) -> Vec<ProgramFile> {
    let file =
        |name: &str, text: Text| ProgramFile { name: format!("{name}.{}", Language::Krl.ending()), text: text.0 };
    let mut files = Vec::new();
    if 1 < program.parts.len() {
        let name = program.name_of(None);
        let mut text = begun(program, &name);
        for (part, _) in program.named_parts() {
            text.line(&format!("{part}()"));
        }
        text.line("END");
        files.push(file(&name, text));
    }
    files.extend(program.named_parts().map(|(name, steps)| file(&name, part(program, &name, steps))));
    files
}

fn begun(program: &Program, name: &str) -> Text {
    let setup = program.setup;
    let dialect = Dialect {
        angles: ["A", "B", "C"],
        frame: ("Work object, $BASE in the robot's base (ROBROOT)", setup.base_from_part),
        tools: tools(program, Flange::Down, "$TOOL in the flange frame"),
        flange: Flange::Down,
    };
    let mut text = Text::default();
    text.line(&format!("DEF {name}()"));
    text.lines("; ", &sentences(program, &dialect));
    text
}

fn part(program: &Program, name: &str, steps: &[Step]) -> Text {
    let (setup, style) = (program.setup, program.style);
    let mut text = begun(program, name);
    let blend = if style.blend == 0.0 { "" } else { " C_DIS" };
    text.line("BAS(#INITMOV,0)");
    text.line(&format!("BAS(#VEL_PTP,{START_PERCENT})"));
    text.line(&format!("$BASE={{{}}}", frame(&setup.base_from_part)));
    text.line(&format!("$APO.CDIS={}", mm(style.blend)));
    begin(program, &steps[0], &mut text);
    let mut speed = None;
    for (i, step) in steps.iter().enumerate().skip(1) {
        if Program::change_at(steps, i) {
            text.lines("; ", &program.change_to(step));
            text.line("HALT");
            begin(program, step, &mut text);
            continue;
        }
        if speed.replace(step.speed) != Some(step.speed) {
            text.line(&format!("$VEL.CP={}", fixed(step.speed, 6)));
        }
        // A last place is gone to exactly: no corner follows.
        let blend = if Program::ends_at(steps, i) { "" } else { blend };
        text.line(&format!("LIN {{{}}}{blend}", frame(&step.part_from_tool)));
    }
    text.line("END");
    text
}

/// Takes the tool of a step, and goes there in joints, where they are known.
fn begin(program: &Program, step: &Step, text: &mut Text) {
    let setup = program.setup;
    text.line(&format!("$TOOL={{{}}}", frame(&setup.tool_in(Flange::Down, &setup.tools[step.tool]))));
    let start = if setup.knows_joints() {
        let joint = |(i, q): (usize, f64)| format!("A{i} {}", fixed(q.to_degrees(), OF_JOINT));
        (1..).zip(step.joints).map(joint).collect::<Vec<_>>().join(",")
    } else {
        // Without S and T the axes stay in the quarter turns in which they are.
        frame(&step.part_from_tool)
    };
    text.line(&format!("PTP {{{start}}}"));
}

fn frame(pose: &Pose) -> String {
    let t = pose.translation;
    let [a, b, c] = Zyx::of(&pose.rotation).degrees().map(|angle| fixed(angle, OF_ANGLE));
    format!("X {},Y {},Z {},A {a},B {b},C {c}", mm(t.x), mm(t.y), mm(t.z))
}
