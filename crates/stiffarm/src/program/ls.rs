//! Fanuc: `R = Rz(R) Ry(P) Rx(W)`, mm, deg, mm/s; positions behind the program, the first in joints where the pendant counts them as we do.

use std::f64::consts::PI;

use nalgebra::{Translation3, Vector3};

use super::angles::{OF_ANGLE, OF_JOINT, fixed, mm};
use super::head::{Dialect, Text, sentences};
use super::steps::{Program, Step};
use super::{Flange, Language, ProgramFile, Setup, Tool};
use crate::spatial::Pose;

/// The user frame of the program, which the controller holds under this number; its tools have the numbers from 1.
const FRAME: u32 = 1;

/// Remarks are no longer.
const REMARK: usize = 32;

pub(super) fn files(program: &Program) -> Vec<ProgramFile> {
    let file = |name: &str, text| ProgramFile { name: format!("{name}.{}", Language::Ls.ending()), text };
    let mut files = Vec::new();
    if 1 < program.parts.len() {
        let name = program.name_of(None);
        let mut lines = head(program);
        lines.extend(program.named_parts().map(|(part, _)| format!("CALL {}", part.to_ascii_uppercase())));
        files.push(file(&name, whole(&name, &lines, "")));
    }
    files.extend(program.named_parts().map(|(name, steps)| {
        let mut lines = head(program);
        lines.extend(moves(program, steps));
        file(&name, whole(&name, &lines, &positions(program, steps)))
    }));
    files
}

/// Lines and positions as a file.
fn whole(name: &str, lines: &[String], positions: &str) -> String {
    let mut text = Text::default();
    text.line(&format!("/PROG  {}", name.to_ascii_uppercase()));
    text.line("/ATTR");
    text.line("OWNER\t\t= MNEDITOR;");
    text.line("COMMENT\t\t= \"\";");
    text.line(&format!("LINE_COUNT\t= {};", lines.len()));
    text.line("PROTECT\t\t= READ_WRITE;");
    text.line("DEFAULT_GROUP\t= 1,*,*,*,*;");
    text.line("CONTROL_CODE\t= 00000000 00000000;");
    text.line("/MN");
    for (number, line) in (1..).zip(lines) {
        text.line(&format!("{number:4}:{line} ;"));
    }
    text.line("/POS");
    text.0.push_str(positions);
    text.line("/END");
    text.0
}

fn head(program: &Program) -> Vec<String> {
    let setup = program.setup;
    let of_frame = |(i, tool): (usize, &Tool)| {
        let name = tool.number.map_or_else(String::new, |number| format!(" for T{number}"));
        (format!("Set UTOOL {}{name}, in the flange frame, to", i + 1), setup.tool_in(Flange::Up, tool))
    };
    let dialect = Dialect {
        angles: ["R", "P", "W"],
        frame: ("Set UFRAME 1, in WORLD at the height of joint 2, to", world_from_part(setup)),
        tools: setup.tools.iter().enumerate().map(of_frame).collect(),
        flange: Flange::Up,
    };
    let mut sentences = sentences(program, &dialect);
    sentences.push("Speeds are rounded to 0.1 mm/s.".into());
    if 0.0 < program.style.blend {
        sentences.push("CNT100 rounds corners as speed has it, not by a length.".into());
    }
    sentences.push(
        "CONFIG: N is taken for a wrist that bends down with joint 4 at 0. If the pendant shows other letters at P[1], they go into all."
            .into(),
    );
    sentences.iter().flat_map(|sentence| wrapped(sentence)).map(|line| format!("  !{line}")).collect()
}

/// From WORLD, whose origin is where axis 1 passes joint 2's height.
fn world_from_part(setup: &Setup) -> Pose {
    Pose::translation(0.0, 0.0, -setup.geometry.c1) * setup.base_from_part
}

fn moves(program: &Program, steps: &[Step]) -> Vec<String> {
    let ending = if program.style.blend == 0.0 { "CNT0" } else { "CNT100" };
    let mut lines = vec![format!("  UFRAME_NUM={FRAME}")];
    let begin = |i: usize| [format!("  UTOOL_NUM={}", steps[i].tool + 1), format!("J P[{}] 10% FINE", i + 1)];
    lines.extend(begin(0));
    for (i, step) in steps.iter().enumerate().skip(1) {
        if Program::change_at(steps, i) {
            let sentences = program.change_to(step);
            lines.extend(sentences.iter().flat_map(|sentence| wrapped(sentence)).map(|line| format!("  !{line}")));
            lines.push("  PAUSE".into());
            lines.extend(begin(i));
            continue;
        }
        let ending = if Program::ends_at(steps, i) { "FINE" } else { ending };
        let i = i + 1;
        lines.push(format!("L P[{i}] {}mm/sec {ending}", fixed(step.speed * 1e3, 1)));
    }
    lines
}

fn positions(program: &Program, steps: &[Step]) -> String {
    let mut text = Text::default();
    for (i, step) in (1..).zip(steps) {
        let begins = i == 1 || Program::change_at(steps, i - 1);
        let body = if begins && program.setup.knows_joints() { in_joints(step) } else { in_space(program, step) };
        text.line(&format!("P[{i}]{{\n   GP1:\n\tUF : {FRAME}, UT : {},{body}\n}};", step.tool + 1));
    }
    text.0
}

fn in_joints(step: &Step) -> String {
    let [a, b, c, d, e, f] = step.joints.map(|q| fixed(q.to_degrees(), OF_JOINT));
    format!("\n\tJ1= {a} deg,\tJ2= {b} deg,\tJ3= {c} deg,\n\tJ4= {d} deg,\tJ5= {e} deg,\tJ6= {f} deg")
}

fn in_space(program: &Program, step: &Step) -> String {
    let Translation3 { vector: t } = step.part_from_tool.translation;
    let [r, p, w] = step.angles.degrees().map(|angle| fixed(angle, OF_ANGLE));
    format!(
        "\t\tCONFIG : '{}',\n\tX = {} mm,\tY = {} mm,\tZ = {} mm,\n\tW = {w} deg,\tP = {p} deg,\tR = {r} deg",
        configuration(program, &step.joints),
        mm(t.x),
        mm(t.y),
        mm(t.z)
    )
}

/// Wrist, elbow, front, then the whole turns of joints 1, 4 and 6 from +-180 deg.
fn configuration(program: &Program, joints: &[f64; 6]) -> String {
    let setup = program.setup;
    let theta = setup.geometry.model_angles(joints, setup.third_axis);
    let letters = program.style.fanuc_letters.clone().unwrap_or_else(|| {
        let [_, shoulder, elbow, wrist, _] = setup.geometry.points(&theta).map(Vector3::from);
        let (s, c) = theta[0].sin_cos();
        let (ahead, across) = (Vector3::new(c, s, 0.0), Vector3::new(-s, c, 0.0));
        let is_front = 0.0 <= wrist.dot(&ahead);
        // The elbow stands over the line from joint 2 to the wrist centre, seen along the way forwards.
        let over = across.dot(&(wrist - shoulder).cross(&(elbow - shoulder)));
        let is_up = (over < 0.0) == is_front;
        let letter = |yes: bool, a: char, b: char| if yes { a } else { b };
        format!(
            "{} {} {}",
            letter(0.0 <= theta[4].sin(), 'N', 'F'),
            letter(is_up, 'U', 'D'),
            letter(is_front, 'T', 'B')
        )
    });
    let turns = |joint: usize| fixed((joints[joint] / (2.0 * PI)).round(), 0);
    format!("{letters}, {}, {}, {}", turns(0), turns(3), turns(5))
}

/// A sentence in remarks that are short enough.
fn wrapped(sentence: &str) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in sentence.replace(';', ",").split(' ') {
        let mut word = word;
        loop {
            let last = lines.len() - 1;
            let line = &mut lines[last];
            let gap = usize::from(!line.is_empty());
            if line.len() + gap + word.len() <= REMARK {
                line.push_str(&" "[..gap]);
                line.push_str(word);
                break;
            }
            if line.is_empty() {
                // One word longer than a remark: it is ASCII, and may be cut anywhere.
                line.push_str(&word[..REMARK]);
                word = &word[REMARK..];
            }
            lines.push(String::new());
        }
    }
    lines
}
