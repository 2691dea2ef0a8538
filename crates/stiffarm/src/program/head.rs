//! What must a person know before a program runs? The head of each file says it, in ASCII.

use super::angles::{Zyx, fixed, mm};
use super::steps::Program;
use super::{Flange, ProgramFault};
use crate::limits::Pendant;
use crate::plain::on_one_line;
use crate::spatial::Pose;

/// What a language adds to the head.
pub(super) struct Dialect<'a> {
    /// How it names the turns about z, y and x.
    pub(super) angles: [&'a str; 3],
    /// In which frame the part stands, and what it is called.
    pub(super) frame: (&'a str, Pose),
    /// The same of each tool.
    pub(super) tools: Vec<(String, Pose)>,
    /// In whose flange frame they are.
    pub(super) flange: Flange,
}

/// Every tool with the words before its frame.
pub(super) fn tools(program: &Program, flange: Flange, what: &str) -> Vec<(String, Pose)> {
    let named = |tool: &super::Tool| (format!("{}, {what}", tool.name()), program.setup.tool_in(flange, tool));
    program.setup.tools.iter().map(named).collect()
}

/// The sentences of the head.
pub(super) fn sentences(program: &Program, dialect: &Dialect) -> Vec<String> {
    let setup = program.setup;
    let frame = |what: &str, pose: &Pose| format!("{what}: {}", pose_in_words(pose, dialect.angles));
    let first = setup.controller.of_calibration().iter().chain(of_joints(setup.pendant));
    let mut head: Vec<String> = first.map(|sentence| (*sentence).to_owned()).collect();
    head.push(if setup.tools.len() < 2 {
        "This program moves the arm and nothing else: spindle, coolant and tool changes are not in it.".to_owned()
    } else {
        let first = program.steps.first().map_or_else(String::new, |first| setup.tools[first.tool].name());
        format!("This program moves the arm and nothing else: spindle and coolant are not in it. It stops where a tool is changed by hand, and begins with {first}.")
    });
    head.extend(setup.remarks.iter().map(|remark| ascii(remark)));
    head.extend([format!("Robot: {}", ascii(setup.robot)), frame(dialect.frame.0, &dialect.frame.1)]);
    head.extend(dialect.tools.iter().map(|(what, pose)| frame(what, pose)));
    head.extend([format!(
        "Flange frame: z out along axis 6; with the forearm level, the wrist straight and joints 4 and 6 at 0, x points {}.",
        dialect.flange.x(setup.geometry)
    )]);
    head.push(match setup.stiffness {
        Some(source) => format!("The deflection under the cutting force is taken out. Stiffness: {}", ascii(source)),
        None => "The deflection under the cutting force is not taken out.".into(),
    });
    head.push(setup.controller.corrections().into());
    head.push("Mass of tool and load: not from here, set them on the controller.".into());
    let at_gimbal = program.steps.iter().filter(|step| step.angles.is_at_gimbal).count();
    let [_, y, x] = dialect.angles;
    head.push(match at_gimbal {
        0 => format!("No pose has {y} at 90 or -90 deg, where the angles are not unique."),
        count => format!("{count} poses have {y} at 90 or -90 deg, where the angles are not unique: {x} is set to 0."),
    });
    head
}

/// The sentences of a file that tells joints, and turns as quaternions, which have no gimbal.
///
/// # Errors
/// Where it is not known what the pendant shows: no joint may be written then.
pub(super) fn of_joints_alone(program: &Program) -> Result<Vec<String>, ProgramFault> {
    let setup = program.setup;
    if !setup.knows_joints() {
        return Err(ProgramFault::Pendant { robot: on_one_line(setup.robot).into_owned() });
    }
    let dialect = Dialect {
        angles: ["Rz", "Ry", "Rx"],
        frame: ("Part, in the robot's base", setup.base_from_part),
        tools: tools(program, Flange::OfFile, "in the flange frame"),
        flange: Flange::OfFile,
    };
    let mut lines = sentences(program, &dialect);
    lines.pop(); // that of the gimbal
    Ok(lines)
}

/// What is to be known of joint angles before anything else.
fn of_joints(pendant: &Pendant) -> &'static [&'static str] {
    match pendant {
        Pendant::AsFile | Pendant::Verified(_) => &[],
        Pendant::Unknown => &[
            "WARNING: it is not known whether the pendant shows the joints as the robot file counts them (zeros, signs, joint 3).",
            "So no move in joints is here: first jog the robot near the first pose, in the posture that is wanted.",
        ],
        Pendant::Given => &[
            "WARNING: it is not known whether the pendant shows the joints as the robot file counts them (zeros, signs, joint 3), only said by whoever wrote this program (pendant-as-file).",
            "Compare the joints of the first move with the pendant before it runs.",
        ],
    }
}

/// A pose in words.
pub(super) fn pose_in_words(pose: &Pose, names: [&str; 3]) -> String {
    let t = pose.translation;
    let angles = Zyx::of(&pose.rotation).degrees();
    let turned: Vec<String> =
        names.iter().zip(angles).map(|(name, angle)| format!("{name} {}", fixed(angle, 5))).collect();
    format!("X {} Y {} Z {} mm {} deg", mm(t.x), mm(t.y), mm(t.z), turned.join(" "))
}

/// A text as every controller reads it, on one line.
pub(super) fn ascii(text: &str) -> String {
    on_one_line(text).chars().map(|sign| if sign.is_ascii() { sign } else { '?' }).collect()
}

/// A file as it grows, line by line.
#[derive(Default)]
pub(super) struct Text(pub(super) String);

impl Text {
    pub(super) fn line(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    /// Lines with something before each.
    pub(super) fn lines(&mut self, before: &str, lines: &[String]) {
        for line in lines {
            self.0.push_str(before);
            self.line(line);
        }
    }
}
