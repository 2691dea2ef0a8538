//! How does a robot description of others become a robot file?
//!
//! [`import`] takes the text of a URDF or of an OPW parameter file (YAML), recovers lengths, offsets, signs and limits,
//! writes the robot file, reads it back and compares it with the description as it stands, at [`SAMPLES`] postures and uphill
//! from the worst of them.

mod axes;
mod chain;
mod cover;
mod described;
mod flange;
mod inertials;
mod joint_axis;
mod meshes;
mod opw_yaml;
mod packages;
mod proof;
mod ranges;
mod urdf;
mod xacro;
mod yaml;

use std::collections::BTreeMap;
use std::rc::Rc;

use super::reader::{Log, shown, unfit_name};
use super::{Fault, Faults, read, write};
use crate::drive::{Architecture, Drives, JointCompliance};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, Pendant, ThirdAxis};
use crate::robot::{Arm, Robot, Status};
use crate::spatial::Pose;
use chain::{Between, NoChain};
use described::Described;
use meshes::Enclosed;
pub use meshes::Meshes;
pub use packages::Packages;
use proof::{Errors, compare};
use ranges::{hundredths, joint_limits, round};

/// No longer text is taken: robot files have some kilobytes, the URDFs of whole cells less than this.
pub const MOST_BYTES: usize = 4 << 20;
/// The axes 4, 5, 6 may miss their common point by this much, m; shorter offsets are none.
pub const MEETS_M: f64 = 0.5e-3;
/// Axes may lean by this much from parallel and from right angles, deg; 3.1416 for pi leans by 0.0004 deg.
pub const STRAIGHT_DEG: f64 = 0.05;
/// A robot file may differ from the description by this much at the flange, m.
pub const LARGEST_ERROR_M: f64 = 0.5e-3;
/// And by this angle, deg.
pub const LARGEST_TURN_DEG: f64 = 0.05;
/// Postures at which file and description are compared before the worst of them are made worse.
pub const SAMPLES: usize = 1000;
/// What a robot file cannot say of a description is reported from here on, m.
const REPORTED_M: f64 = 1e-6;
/// And from this angle, deg; 3.1416 for pi is less.
const REPORTED_DEG: f64 = 1e-3;

/// What the description does not say, or says otherwise.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// In place of the description's name.
    pub name: Option<String>,
    /// The maker.
    pub vendor: Option<String>,
    /// Nominal payload, kg.
    pub payload_kg: Option<f64>,
    /// Reach by the data sheet, m.
    pub reach: Option<f64>,
    /// Serial, marked as assumed, where nothing is said.
    pub architecture: Option<Architecture>,
    /// Ranges of the joints as reported, rad, in place of the description's.
    pub limits: Option<[Interval; 6]>,
    /// The link whose frame is the base.
    pub base: Option<String>,
    /// The link whose frame is the flange.
    pub tip: Option<String>,
}

/// A robot that was recovered and proved.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// As [`read`] makes it from the text.
    pub robot: Robot,
    /// The robot file.
    pub text: String,
    /// What was chosen, left out or found odd.
    pub notes: Vec<String>,
    /// What the file was compared with.
    pub compared_with: &'static str,
    /// Largest distance of the flange from where the description has it, m.
    pub largest_error: f64,
    /// Largest angle between the flange and what the description has, rad.
    pub largest_turn: f64,
}

/// Why a description is not imported.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// The file is wrong in itself.
    #[error("{0}")]
    Faults(Faults),
    /// The file does not say which joints are the arm.
    #[error("{0}")]
    Which(Faults),
    /// It is no arm with six axes and a spherical wrist.
    #[error("{0}")]
    Class(Faults),
    /// A macro file of which more than the simple form is asked.
    #[error(
        "{file}: a xacro macro file, {why}; expected the URDF that it expands to, or one macro with ${{prefix}}, constants (xacro:property), numbers, pi, + - * /, radians() and degrees()"
    )]
    Xacro {
        /// As the user named it.
        file: String,
        /// What is not read, with its line.
        why: String,
    },
    /// OPW parameters know no links.
    #[error("{file}: OPW parameters name no links, of which one could be the {end}; expected it left out")]
    NoLinks {
        /// As the user named it.
        file: String,
        /// Which end of the arm was given.
        end: &'static str,
    },
    /// OPW parameters say nothing of limits.
    #[error("{file}: OPW parameters have no joint limits; expected six ranges beside the file")]
    NoLimits {
        /// As the user named it.
        file: String,
    },
    /// The bodies of a link cannot be read.
    #[error("{file}: link {link}: {why}")]
    Bodies {
        /// As the user named it.
        file: String,
        /// Which link.
        link: String,
        /// Why.
        why: String,
    },
    /// The robot file would move otherwise than the description.
    #[error(
        "{file}: the recovered arm differs from the description by {:.3} mm and {turn_deg:.4} deg; expected at most {} mm and {} deg{}",
        error_m * 1e3,
        LARGEST_ERROR_M * 1e3,
        LARGEST_TURN_DEG,
        because(causes)
    )]
    Inexact {
        /// As the user named it.
        file: String,
        /// Largest distance, m.
        error_m: f64,
        /// Largest angle, deg.
        turn_deg: f64,
        /// What the description has and a robot file cannot say.
        causes: Vec<String>,
    },
}

fn because(causes: &[String]) -> String {
    if causes.is_empty() { String::new() } else { format!(": {}", causes.join("; ")) }
}

/// A description as it was understood, before it is written.
struct Understood {
    name: String,
    geometry: Geometry,
    limits: Limits,
    notes: Vec<String>,
    /// What the description has and a robot file has not.
    left: Vec<String>,
    compared_with: &'static str,
    source: [String; 2],
}

/// Makes a robot file from the text of a URDF or of an OPW parameter file; `file` is named in errors and as the source.
///
/// ```
/// use stiffarm::catalogue::import::{ImportOptions, import};
///
/// let urdf = include_str!("../../../../../docs/examples/example_150.urdf");
/// let imported = import(urdf, "example_150.urdf", &ImportOptions::default())?;
/// assert!(imported.text.contains("c2_mm = 1000"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Where the text is faulty (all faults at once), no arm of this class, or where the file would not be exact.
pub fn import(text: &str, file: &str, options: &ImportOptions) -> Result<Imported, ImportError> {
    import_with(text, file, options, None)
}

/// The same with the collision meshes of a URDF, of which capsules are made that enclose the links (`[[body.link]]`).
///
/// # Errors
/// The same, and where a mesh cannot be read.
pub fn import_enclosed(
    text: &str,
    file: &str,
    options: &ImportOptions,
    meshes: Meshes,
) -> Result<Imported, ImportError> {
    import_with(text, file, options, Some(meshes))
}

fn import_with(
    text: &str,
    file: &str,
    options: &ImportOptions,
    meshes: Option<Meshes>,
) -> Result<Imported, ImportError> {
    let text = text.trim_start_matches('\u{feff}');
    let log = Log::of(text);
    if MOST_BYTES < text.len() {
        log.add(0, "", format!("{} bytes; expected a URDF or OPW parameters of at most {MOST_BYTES}", text.len()));
        return Err(ImportError::Faults(faults(log, file)));
    }
    if text.trim_start().starts_with('<') {
        from_urdf(text, file, options, (&log, meshes))
    } else if meshes.is_some() {
        Err(ImportError::NoLinks { file: file.into(), end: "body" })
    } else {
        from_opw(text, file, options, &log)
    }
}

fn faults(log: Rc<Log>, file: &str) -> Faults {
    Faults { file: file.into(), faults: log.into_faults() }
}

/// The last part of a path.
fn base_name(file: &str) -> &str {
    file.rsplit(['/', '\\']).next().unwrap_or(file)
}

fn from_urdf(
    text: &str,
    file: &str,
    options: &ImportOptions,
    (log, meshes): (&Rc<Log>, Option<Meshes>),
) -> Result<Imported, ImportError> {
    let expanded = xacro::expand(text).map_err(|why| ImportError::Xacro { file: file.into(), why })?;
    // Lines stay where they are, places in them do not.
    let (text, macro_name, log) = match &expanded {
        Some(expanded) => (expanded.text.as_str(), expanded.name.as_deref(), &Log::of(&expanded.text)),
        None => (text, None, log),
    };
    let wrong = || ImportError::Faults(faults(log.clone(), file));
    let urdf = urdf::parse(text, log).ok_or_else(wrong)?;
    let own = if urdf.name.is_empty() { macro_name.unwrap_or_default() } else { &urdf.name };
    let name = options.name.clone().unwrap_or_else(|| own.into());
    if name.trim().is_empty() {
        log.add(0, "robot name", "missing; expected a name in the file or beside it");
    } else if let Some(fault) = unfit_name(&name) {
        log.add(0, "robot name", fault);
    }
    if log.has_faults() {
        return Err(wrong());
    }
    let between = Between { base: options.base.as_deref(), tip: options.tip.as_deref() };
    let chain = chain::find(&urdf, between, log).map_err(|reason| match reason {
        NoChain::Tree => wrong(),
        NoChain::Class => ImportError::Class(faults(log.clone(), file)),
        NoChain::Which => ImportError::Which(faults(log.clone(), file)),
    })?;
    let mut notes = Vec::new();
    let limits = joint_limits(&chain, options, log, &mut notes);
    let recovered = axes::recover(&chain, between.tip, log);
    let recovered = recovered.ok_or_else(|| ImportError::Class(faults(log.clone(), file)))?;
    let limits = limits.ok_or_else(wrong)?;
    let mut remarks = vec![format!("base: the frame of link '{}'", shown(&chain.base)), recovered.flange.note.clone()];
    remarks.extend(recovered.notes);
    remarks.extend(chain.notes.iter().cloned());
    // Who has said what it is needs no advice.
    if let (Some(joint), None) = (&chain.elbow_followed, options.architecture) {
        remarks
            .push(format!("links follow joint {joint}: it may be a parallelogram arm; then import it as quasi-serial"));
    }
    remarks.extend(notes);
    let said = if options.limits.is_some() {
        "given at the import".into()
    } else {
        format!("joint limits of {}", base_name(file))
    };
    let understood = Understood {
        name,
        geometry: recovered.geometry,
        limits,
        notes: remarks,
        left: recovered.left,
        compared_with: "the joint frames of the URDF",
        source: [format!("recovered from the joint axes of {}", base_name(file)), said],
    };
    let base_from_root = Pose::from_parts((-recovered.moved).into(), nalgebra::UnitQuaternion::identity());
    let flange_in_link = recovered.flange.in_link;
    let imported = settle(understood, file, options, |q| base_from_root * chain.forward(q) * flange_in_link)?;
    complete(imported, &Described { text, file, urdf: &urdf, chain: &chain, moved: recovered.moved }, meshes)
}

/// The same robot with what the description says besides: capsules that enclose its links, masses, and torques.
fn complete(mut imported: Imported, described: &Described, meshes: Option<Meshes>) -> Result<Imported, ImportError> {
    let Imported { robot, notes, .. } = &mut imported;
    let Arm::SixAxis { geometry, limits, drives } = &mut robot.arm else { return Ok(imported) };
    let file = base_name(described.file);
    let mut boxes = None;
    if let Some(meshes) = meshes {
        let enclosed: Enclosed = described.enclosed((geometry, limits), meshes)?;
        robot.enclosing = Some(enclosed.enclosing);
        robot.source.insert("body".into(), format!("capsules that enclose the collision meshes of {file}"));
        notes.extend(enclosed.notes);
        boxes = Some(enclosed.boxes);
    }
    match described.masses(geometry, boxes.as_ref()) {
        Ok(None) => {}
        Ok(Some((masses, said))) => {
            notes.extend(said);
            robot.masses = masses;
            robot.source.insert("masses".into(), format!("inertials of {file}"));
        }
        Err(why) => notes.push(format!("masses: none is taken: {why}")),
    }
    match inertials::torques(described.chain) {
        Ok(None) => {}
        Ok(Some(torques)) => {
            drives.motors.torque = Some(torques);
            notes.push("torques: limits of the six drives, from the efforts".into());
            robot.source.insert("drives".into(), format!("torques: joint limits (effort) of {file}"));
        }
        Err(why) => notes.push(format!("torques: none is taken: {why}")),
    }
    imported.text = write(&imported.robot);
    imported.robot = read(&imported.text, described.file).map_err(ImportError::Faults)?;
    Ok(imported)
}

fn from_opw(text: &str, file: &str, options: &ImportOptions, log: &Rc<Log>) -> Result<Imported, ImportError> {
    let Some(geometry) = opw_yaml::parse(text, log) else {
        return Err(ImportError::Faults(faults(log.clone(), file)));
    };
    let end = [("base", &options.base), ("tip", &options.tip)].into_iter().find(|(_, link)| link.is_some());
    if let Some((end, _)) = end {
        return Err(ImportError::NoLinks { file: file.into(), end });
    }
    let joints = options.limits.ok_or_else(|| ImportError::NoLimits { file: file.into() })?;
    let mut notes = vec!["base and flange: as the parameters have them".into()];
    let name = options.name.clone().unwrap_or_else(|| {
        let stem = base_name(file).split('.').next().unwrap_or_default();
        let name = stem.trim_start_matches("opw_parameters_").trim_start_matches("opw_kinematics_").to_owned();
        notes.push(format!("named '{}' after the file", shown(&name)));
        name
    });
    if let Some(fault) = unfit_name(&name) {
        log.add(0, "robot name", fault);
        return Err(ImportError::Faults(faults(log.clone(), file)));
    }
    let understood = Understood {
        name,
        geometry: geometry.clone(),
        limits: Limits {
            joints: joints.map(hundredths),
            third_axis: ThirdAxis::Elbow,
            pendant: Pendant::Unknown,
            elbow: Interval::ALL,
            speeds: None,
        },
        notes,
        left: Vec::new(),
        compared_with: "the closed-form wrist and flange of [OPW]",
        source: [format!("OPW parameters of {}", base_name(file)), "given at the import".into()],
    };
    settle(understood, file, options, |q| proof::closed_form(&geometry, q))
}

/// Writes, reads back and compares, with lengths and angles as round as the description allows.
fn settle(
    understood: Understood,
    file: &str,
    options: &ImportOptions,
    described: impl Fn(&[f64; 6]) -> Pose,
) -> Result<Imported, ImportError> {
    // Steps per mm and per deg: hundredths as makers state them, and what leaves errors below 1e-9 m.
    let written = |steps: (f64, f64)| {
        let text = write(&robot(&understood, rounded(&understood.geometry, steps), options));
        let robot = read(&text, file).map_err(|faults| as_recovered(faults, file))?;
        let errors = compare(&robot, &described);
        Ok::<_, ImportError>((text, robot, errors))
    };
    let mut best = written((1e7, 1e9))?;
    for steps in [(1e2, 1e2), (1e3, 1e4)] {
        let rounder = written(steps)?;
        if rounder.2.within(&best.2.doubled()) {
            best = rounder;
            break;
        }
    }
    let (text, robot, Errors { distance, angle }) = best;
    let turn_deg = angle.to_degrees();
    let Understood { mut notes, mut left, compared_with, geometry, .. } = understood;
    left.extend(dropped(&geometry));
    if !(distance <= LARGEST_ERROR_M && turn_deg <= LARGEST_TURN_DEG) {
        return Err(ImportError::Inexact { file: file.into(), error_m: distance, turn_deg, causes: left });
    }
    notes.extend(left.into_iter().map(|left| format!("not in the robot file: {left}")));
    notes.extend(architecture_notes(options));
    Ok(Imported { robot, text, notes, compared_with, largest_error: distance, largest_turn: angle })
}

fn architecture_notes(options: &ImportOptions) -> Option<String> {
    match options.architecture {
        None => Some("architecture: serial is assumed; nothing in the file says it".into()),
        Some(Architecture::QuasiSerial) => Some(
            "joint 3 is the angle between the links, as these files have it, not the forearm's absolute angle".into(),
        ),
        Some(Architecture::Serial) => None,
    }
}

fn robot(understood: &Understood, geometry: Geometry, options: &ImportOptions) -> Robot {
    let architecture = options.architecture.unwrap_or(Architecture::Serial);
    let [geometry_source, limits_source] = understood.source.clone();
    let source = [("geometry".into(), geometry_source), ("limits".into(), limits_source)];
    Robot {
        name: understood.name.trim().into(),
        vendor: options.vendor.clone().unwrap_or_default().trim().into(),
        architecture,
        architecture_is_assumed: options.architecture.is_none(),
        stiffness_is_assumed: true,
        status: Status::Derived,
        payload_kg: options.payload_kg,
        reach: options.reach,
        mass_kg: None,
        repeatability: None,
        body: None,
        enclosing: None,
        masses: Vec::new(),
        calibration: None,
        arm: Arm::SixAxis {
            geometry,
            limits: understood.limits.clone(),
            drives: Drives::new(architecture, JointCompliance::PAPER),
        },
        source: BTreeMap::from(source),
    }
}

/// Offsets too short to be offsets.
fn dropped(geometry: &Geometry) -> impl Iterator<Item = String> {
    let Geometry { a1, a2, b, c1, c4, .. } = *geometry;
    let short = [("a1", a1), ("a2", a2), ("b", b), ("c1", c1), ("c4", c4)].into_iter();
    let short = short.filter(|(_, x)| REPORTED_M < x.abs() && x.abs() <= MEETS_M);
    short.map(|(name, x)| format!("{name} of {:.3} mm, which is taken for none", x * 1e3))
}

/// Offsets too short to be offsets are none; the rest is rounded.
fn rounded(geometry: &Geometry, (per_mm, per_deg): (f64, f64)) -> Geometry {
    let length = |x: f64| if x.abs() <= MEETS_M { 0.0 } else { round(x * 1e3, per_mm) / 1e3 };
    let Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign } = geometry;
    let [a1, a2, b, c1, c2, c3, c4] = [a1, a2, b, c1, c2, c3, c4].map(|x| length(*x));
    let offset = offset.map(|x| round(x.to_degrees(), per_deg).to_radians());
    Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign: *sign }
}

/// Faults of the robot file that was written, as faults of what it was written from.
fn as_recovered(Faults { faults, .. }: Faults, file: &str) -> ImportError {
    let recovered = |fault: Fault| {
        // Advice on units is for people who type numbers.
        let message = fault.message.split("; if this is in").next().unwrap_or_default();
        Fault { line: 1, message: format!("{message}, as it was recovered"), ..fault }
    };
    ImportError::Class(Faults { file: file.into(), faults: faults.into_iter().map(recovered).collect() })
}
