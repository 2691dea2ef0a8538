//! What does a robot's controller read, so that it follows these joints? KUKA KRL, ABB RAPID, Fanuc LS; a script for
//! RoboDK, a trajectory for ROS 2, and a table of joints.
//!
//! The pose that is written of a place is the forward kinematics of the joints that are commanded there, by the arm with which the controller
//! computes. A program begins with a
//! move in joints, so that its configuration is settled, and goes on with straight moves of the tool in the frame of the part. Where it is
//! not known whether the pendant counts the joints as the robot file does, no joint angle is written: the program says so in its first
//! lines, and begins with a move to the first pose in the posture in which it finds the robot.
//! A controller that corrects elastic or other errors on its own would do so twice: the head of each file says that it must not.
//!
//! Frames: the base is that of the robot's geometry, z up, x forward, on the floor. In every flange frame z points out along axis 6;
//! where the forearm is level, the wrist straight and joints 4 and 6 are at 0, x points down in KUKA's and ABB's, and up in Fanuc's, whose
//! world frame stands on axis 1 at the height of joint 2. Programs speak in those; where x of the robot file points there, its zeros of the
//! joints 4 and 6 say.
//!
//! SI inside; with the other borders the only module that knows mm and degrees.

mod angles;
mod fault;
mod head;
mod joints;
mod krl;
mod ls;
mod rapid;
mod robodk;
mod ros2;
mod steps;

pub use fault::ProgramFault;

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::angle::wrapped;
use crate::chain::TrueArm;
use crate::geometry::Geometry;
use crate::limits::{Pendant, ThirdAxis};
use crate::spatial::Pose;
use steps::Program;

/// The robot at one place of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// The line of the path that asks for it; for messages.
    pub line: usize,
    /// Joint angles that are commanded, as the robot reports them, rad.
    pub joints: [f64; 6],
    /// Of the way to it from the station before, m/s; `None` where nobody says it.
    pub feed: Option<f64>,
    /// The way to it is at a feed rate, rather than as fast as may be.
    pub is_cutting: bool,
    /// Which of the tools of [`Setup`] is held. Where another one is than before, the program stops, and goes on in joints.
    pub tool: usize,
}

/// A tool that a program moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Its number; `None` where the path has one tool.
    pub number: Option<u32>,
    /// In the flange frame.
    pub flange_from_tool: Pose,
}

impl Tool {
    /// As heads and stops name it.
    fn name(&self) -> String {
        self.number.map_or_else(|| "Tool".into(), |number| format!("Tool T{number}"))
    }
}

/// Whose flange frame is meant: where its x points with the forearm level, the wrist straight and joints 4 and 6 at 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flange {
    /// That of the robot file, with which it was said where the tool is.
    OfFile,
    /// A maker's, x down.
    Down,
    /// A maker's, x up.
    Up,
}

impl Flange {
    /// From one whose x points down there to this one about z, rad.
    fn turn(self, geometry: &Geometry) -> f64 {
        match self {
            Self::OfFile => -(geometry.offset[3] + geometry.offset[5]),
            Self::Down => 0.0,
            Self::Up => PI,
        }
    }

    /// Where its x points there.
    fn x(self, geometry: &Geometry) -> String {
        let turn = wrapped(self.turn(geometry)).to_degrees();
        let quarters = ["down", "left", "up", "right"];
        let quarter = (turn / 90.0).round();
        if (turn - 90.0 * quarter).abs() < 1e-6 {
            quarters[quarter.rem_euclid(4.0) as usize].into()
        } else {
            format!("down, turned by {turn:.3} deg about z")
        }
    }
}

/// With which arm a controller goes from poses to joints.
#[derive(Clone, Copy, Debug)]
pub enum Controller<'a> {
    /// That of the drawing; the robot was not calibrated.
    Drawn,
    /// That of the drawing, of a robot that was calibrated: a pose is that of the drawing at the joints of the true arm.
    Mirrored,
    /// With a calibration of its own: a pose is where the true arm stands.
    Calibrated(&'a TrueArm),
}

impl Controller<'_> {
    /// For which controller a calibrated arm is corrected; nothing of another one.
    pub const fn of_calibration(&self) -> &'static [&'static str] {
        match self {
            Self::Drawn => &[],
            Self::Mirrored => &[
                "This arm was calibrated: joints and poses are corrected for a controller that computes with the arm as drawn (controller_model = nominal).",
                "WARNING: a controller with an absolute-accuracy calibration of its own would correct twice.",
            ],
            Self::Calibrated(_) => &[
                "This arm was calibrated: poses are written for a controller with an absolute-accuracy calibration of its own (controller_model = calibrated).",
                "WARNING: where that is off, poses are not corrected at all.",
            ],
        }
    }

    /// What it must not correct itself, and what it must.
    pub const fn corrections(&self) -> &'static str {
        match self {
            Self::Drawn | Self::Mirrored => {
                "Elastic and absolute-accuracy correction of the controller must be off: the poses are those of the joints without it."
            }
            Self::Calibrated(_) => {
                "Elastic correction of the controller must be off; its absolute-accuracy calibration must be on, as while the arm was measured."
            }
        }
    }
}

/// Which robot holds which tool, and where the part stands.
#[derive(Clone, Copy, Debug)]
pub struct Setup<'a> {
    /// Its name, for the heads of files.
    pub robot: &'a str,
    /// Of the robot.
    pub geometry: &'a Geometry,
    /// What it reports as joint 3.
    pub third_axis: ThirdAxis,
    /// Whether its pendant shows the joints so.
    pub pendant: &'a Pendant,
    /// With which arm it computes.
    pub controller: Controller<'a>,
    /// The part in the robot's base frame.
    pub base_from_part: Pose,
    /// The tools, each once.
    pub tools: &'a [Tool],
    /// What is to be known of this program besides, in sentences.
    pub remarks: &'a [String],
    /// Whose stiffness the joints take the deflection out with, in words; `None` where they do not.
    pub stiffness: Option<&'a str>,
}

impl Setup<'_> {
    /// Joint angles may be written: the controller counts them as the robot file does.
    pub fn knows_joints(&self) -> bool {
        *self.pendant != Pendant::Unknown
    }

    /// A tool in a flange frame.
    fn tool_in(&self, flange: Flange, tool: &Tool) -> Pose {
        let turn = wrapped(Flange::OfFile.turn(self.geometry) - flange.turn(self.geometry));
        Pose::rotation(Vector3::z() * turn) * tool.flange_from_tool
    }

    /// A tool in the part at joint angles as reported, rad, as the controller has it.
    ///
    /// # Panics
    /// Where there is no such tool.
    pub fn part_from_tool(&self, tool: usize, joints: &[f64; 6]) -> Pose {
        let flange = match self.controller {
            Controller::Drawn | Controller::Mirrored => {
                self.geometry.forward(&self.geometry.model_angles(joints, self.third_axis))
            }
            Controller::Calibrated(arm) => arm.flange(joints),
        };
        self.base_from_part.inverse() * flange * self.tools[tool].flange_from_tool
    }
}

/// How a program is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// Of the program and its files.
    pub name: String,
    /// Of moves through the air, m/s.
    pub rapid: f64,
    /// How far from a place the tool may leave its path to round a corner, m; at 0 it goes through every place exactly.
    pub blend: f64,
    /// The most moves in one file; `None` writes one file. Programs of several files have a main one that calls the others.
    pub moves_per_file: Option<usize>,
    /// The letters of a Fanuc's configuration, such as `N U T`, in place of those that follow from the joints.
    pub fanuc_letters: Option<String>,
}

/// A language of controllers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// KUKA.
    Krl,
    /// ABB.
    Rapid,
    /// Fanuc.
    Ls,
    /// A script that makes frame, tools, targets and program in RoboDK.
    RoboDk,
    /// A trajectory of joints as a message of ROS 2.
    Ros2,
    /// A table of joint angles and poses: the reference for the others.
    JointsCsv,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Krl, Self::Rapid, Self::Ls, Self::RoboDk, Self::Ros2, Self::JointsCsv];

    /// As people call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Krl => "KUKA KRL",
            Self::Rapid => "ABB RAPID",
            Self::Ls => "Fanuc LS",
            Self::RoboDk => "a script for RoboDK",
            Self::Ros2 => "a trajectory for ROS 2",
            Self::JointsCsv => "joints as CSV",
        }
    }

    /// Of its files, without the point.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Krl => "src",
            Self::Rapid => "mod",
            Self::Ls => "ls",
            Self::RoboDk => "py",
            Self::Ros2 => "yaml",
            Self::JointsCsv => "csv",
        }
    }

    /// Whose controllers read it; `None` of what is no controller's.
    pub const fn maker(self) -> Option<&'static str> {
        match self {
            Self::Krl => Some("KUKA"),
            Self::Rapid => Some("ABB"),
            Self::Ls => Some("Fanuc"),
            Self::RoboDk | Self::Ros2 | Self::JointsCsv => None,
        }
    }

    /// The language whose programs have this ending; tables are none.
    pub fn of_program(ending: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .filter(|language| *language != Self::JointsCsv)
            .find(|language| language.ending() == ending)
    }

    /// Long programs are several files, as controllers have little memory.
    const fn is_cut_into_files(self) -> bool {
        matches!(self, Self::Krl | Self::Rapid | Self::Ls)
    }

    /// Feed rates that it can say, m/s: three decimals of mm/s, one for Fanuc.
    const fn feeds(self) -> [f64; 2] {
        match self {
            Self::Krl | Self::Rapid => [1e-5, 3.0],
            Self::Ls => [1e-3, 2.0],
            Self::RoboDk | Self::Ros2 | Self::JointsCsv => [1e-6, 10.0],
        }
    }
}

/// One file of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramFile {
    /// With its ending.
    pub name: String,
    /// What stands in it: ASCII.
    pub text: String,
}

/// A program that follows the stations in their order; the main file first. A station that stands where the one before it stands is
/// written once.
///
/// # Errors
/// What the language cannot say, with the line of the path or the option.
pub fn write(
    language: Language,
    setup: &Setup,
    stations: &[Station],
    style: &Style,
) -> Result<Vec<ProgramFile>, ProgramFault> {
    let program = Program::of(language, setup, stations, style)?;
    Ok(match language {
        Language::Krl => krl::files(&program),
        Language::Rapid => rapid::files(&program),
        Language::Ls => ls::files(&program),
        Language::RoboDk => robodk::files(&program)?,
        Language::Ros2 => ros2::files(&program)?,
        Language::JointsCsv => joints::files(&program)?,
    })
}
