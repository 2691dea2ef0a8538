//! A table of joints as the robot reports them, and of the poses they make: the reference for programs.

use super::angles::{fixed, quaternion};
use super::head::{Text, of_joints_alone};
use super::steps::Program;
use super::{Language, ProgramFault, ProgramFile};

/// Decimals of every number: 1e-8 deg, 0.01 nm. A table is read in double precision.
const DECIMALS: usize = 8;

/// The header.
const COLUMNS: &str =
    "line,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,qw,qx,qy,qz,feed_mm_per_min,cutting";

pub(super) fn files(program: &Program) -> Result<Vec<ProgramFile>, ProgramFault> {
    if 1 < program.setup.tools.len() {
        return Err(ProgramFault::Tools);
    }
    let mut lines = of_joints_alone(program)?;
    lines.push("x_mm to qz: the tool in the part, at these joints; qw qx qy qz a quaternion.".into());
    let mut text = Text::default();
    text.lines("# ", &lines);
    text.line(COLUMNS);
    for step in &program.steps {
        let t = step.part_from_tool.translation;
        let joints = step.joints.map(f64::to_degrees);
        let place = [t.x, t.y, t.z].map(|x| x * 1e3);
        let numbers: Vec<String> = joints
            .into_iter()
            .chain(place)
            .chain(quaternion(&step.part_from_tool.rotation))
            .map(|number| fixed(number, DECIMALS))
            .collect();
        let feed = fixed(step.speed * 60e3, 4);
        text.line(&format!("{},{},{feed},{}", step.line, numbers.join(","), u8::from(step.is_cutting)));
    }
    Ok(vec![ProgramFile { name: format!("{}.{}", program.name_of(None), Language::JointsCsv.ending()), text: text.0 }])
}
