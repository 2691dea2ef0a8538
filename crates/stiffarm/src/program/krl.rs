//! KUKA: `R = Rz(A) Ry(B) Rx(C)`, mm, deg, m/s.

use std::fmt::Write;

use super::angles::{OF_ANGLE, OF_JOINT, Zyx, fixed, mm};
use super::head::{Dialect, sentences};
use super::steps::{Program, Step};
use super::{Language, ProgramFile};
use crate::spatial::Pose;

/// What a controller goes by that is at hand before the start, percent.
const START_PERCENT: u32 = 10;

pub(super) fn files(program: &Program) -> Vec<ProgramFile> {
    let file = |name: &str, text| ProgramFile { name: format!("{name}.{}", Language::Krl.ending()), text };
    let mut files = Vec::new();
    if 1 < program.parts.len() {
        let name = program.name_of(None);
        let mut text = begun(program, &name);
        for (part, _) in program.named_parts() {
            text += &format!("{part}()\n");
        }
        text += "END\n";
        files.push(file(&name, text));
    }
    files.extend(program.named_parts().map(|(name, steps)| file(&name, part(program, &name, steps))));
    files
}

fn begun(program: &Program, name: &str) -> String {
    let setup = program.setup;
    let dialect = Dialect {
        angles: ["A", "B", "C"],
        frame: ("Work object, $BASE in the robot's base (ROBROOT)", setup.base_from_part),
        tool: ("Tool, $TOOL in the flange frame", setup.flange_from_tool),
        flange_x: "down",
    };
    let head: String = sentences(program, &dialect).iter().map(|line| format!("; {line}\n")).collect();
    format!("DEF {name}()\n{head}")
}

fn part(program: &Program, name: &str, steps: &[Step]) -> String {
    let (setup, style) = (program.setup, program.style);
    let mut text = begun(program, name);
    let blend = if style.blend == 0.0 { "" } else { " C_DIS" };
    text += "BAS(#INITMOV,0)\n";
    text += &format!("BAS(#VEL_PTP,{START_PERCENT})\n");
    text += &format!("$BASE={{{}}}\n", frame(&setup.base_from_part));
    text += &format!("$TOOL={{{}}}\n", frame(&setup.flange_from_tool));
    text += &format!("$APO.CDIS={}\n", mm(style.blend));
    let joints: Vec<String> =
        (1..).zip(steps[0].joints).map(|(i, q)| format!("A{i} {}", fixed(q.to_degrees(), OF_JOINT))).collect();
    text += &format!("PTP {{{}}}\n", joints.join(","));
    let mut speed = None;
    for (i, step) in steps.iter().enumerate().skip(1) {
        if speed != Some(step.speed) {
            speed = Some(step.speed);
            writeln!(text, "$VEL.CP={}", fixed(step.speed, 6)).expect("a String takes all");
        }
        // The last place is gone to exactly: no corner follows.
        let blend = if i + 1 == steps.len() { "" } else { blend };
        writeln!(text, "LIN {{{}}}{blend}", frame(&step.part_from_tool)).expect("a String takes all");
    }
    text + "END\n"
}

fn frame(pose: &Pose) -> String {
    let t = pose.translation;
    let [a, b, c] = Zyx::of(&pose.rotation).degrees().map(|angle| fixed(angle, OF_ANGLE));
    format!("X {},Y {},Z {},A {a},B {b},C {c}", mm(t.x), mm(t.y), mm(t.z))
}
