//! Reads a robot file (TOML): checks every value, reports every fault with its line, turns mm and degrees into SI.

use std::collections::BTreeMap;

use nalgebra::Matrix6;
use toml::de::DeTable;

use super::bodies::bodies;
use super::reader::{Log, Quantity, Table};
use super::{Fault, Faults};
use crate::calibration::{Calibration, ControllerModel, Errors, JOINT_AXES, own_turns};
use crate::drive::{Architecture, Drives, GravityCompensator, Identified, JointCompliance, Transmission};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, PENDANT_SOURCE, Pendant, ThirdAxis, Verified};
use crate::mass::{Carrier, Mass, missing_for_weight};
use crate::plain::on_one_line;
use crate::plane::PlanarArm;
use crate::robot::{Arm, Robot, Status};

const LINK: Quantity = Quantity { unit: "mm", min: 20.0, max: 10_000.0, suspect: Some((20.0, 1e3, "m")) };
/// A true offset may be short, but not so short that it moves nothing that matters.
const LENGTH: Quantity = Quantity { unit: "mm", min: -10_000.0, max: 10_000.0, suspect: Some((0.5, 1e3, "m")) };
/// Where no length of a group reaches this, mm, all of them are in metres: no arm is so small.
const LARGEST_IN_METRES: f64 = 20.0;
const ANGLE: Quantity = Quantity { unit: "deg", min: -1080.0, max: 1080.0, suspect: None };
const SIGN: Quantity = Quantity { unit: "(+1 or -1)", min: -1.0, max: 1.0, suspect: None };
const ENCLOSED: Quantity = Quantity { unit: "deg", min: 0.0, max: 360.0, suspect: None };
/// Zero is a rigid drive.
const COMPLIANCE: Quantity =
    Quantity { unit: "urad/(N m)", min: 0.0, max: 1e4, suspect: Some((1e-3, 1e6, "rad/(N m)")) };
const COVARIANCE: Quantity = Quantity { unit: "(urad/(N m))^2", min: -1e8, max: 1e8, suspect: None };
const POSTURES: Quantity = Quantity { unit: "(postures)", min: 2.0, max: 1e6, suspect: None };
const RESIDUAL: Quantity = Quantity { unit: "mm", min: 0.0, max: 100.0, suspect: None };
/// Rows that were read from a pendant.
const READ: Quantity = Quantity { unit: "(rows)", min: 3.0, max: 1e6, suspect: None };
/// How far they may be off and still agree.
const OFF: Quantity = Quantity { unit: "mm", min: 0.0, max: 0.05, suspect: None };
/// Zeros of joints that were not mastered.
const ZERO: Quantity = Quantity { unit: "deg", min: -5.0, max: 5.0, suspect: None };
/// Of a frame; beyond it the lengths are another robot's.
const ERROR: Quantity = Quantity { unit: "mm or mrad", min: -50.0, max: 50.0, suspect: None };
const MOVED: Quantity = Quantity { unit: "mm", min: 1e-6, max: 1000.0, suspect: None };
const COUPLING: Quantity = Quantity { unit: "(ratio)", min: -1000.0, max: 1000.0, suspect: None };
const SPRING: Quantity = Quantity { unit: "N/mm", min: 1e-3, max: 1e6, suspect: None };
const SPRING_LENGTH: Quantity = Quantity { unit: "mm", min: 0.0, max: 10_000.0, suspect: None };
const SPEED: Quantity = Quantity { unit: "deg/s", min: 1.0, max: 10_000.0, suspect: None };
const MASS: Quantity = Quantity { unit: "kg", min: 1.0, max: 100_000.0, suspect: None };
const REPEATABILITY: Quantity = Quantity { unit: "mm", min: 1e-4, max: 10.0, suspect: None };
const PAYLOAD: Quantity = Quantity { unit: "kg", min: 0.1, max: 10_000.0, suspect: None };
const REACH: Quantity = Quantity { unit: "m", min: 0.1, max: 20.0, suspect: None };
/// Longer texts are no robot files.
const MOST_BYTES: usize = 1 << 20;

/// Reads a robot from the text of its file; `file` is named in errors.
///
/// # Errors
/// All faults of the file at once, each with its line and key.
pub fn read(text: &str, file: &str) -> Result<Robot, Faults> {
    let log = Log::of(text);
    let robot = if text.len() <= MOST_BYTES {
        match DeTable::parse(text) {
            Ok(root) => robot(Table::root(root.get_ref(), log.clone())),
            Err(error) => {
                log.add(error.span().map_or(0, |span| span.start), "", on_one_line(error.message()));
                None
            }
        }
    } else {
        log.add(0, "", format!("{} bytes; a robot file has at most {MOST_BYTES}", text.len()));
        None
    };
    let faults = log.into_faults();
    match robot {
        Some(robot) if faults.is_empty() => reachable(robot, text, file),
        _ => Err(Faults { file: file.into(), faults }),
    }
}

/// Refuses limits that leave nothing, drives that all are rigid, and a compensator that no drive can hold.
fn reachable(robot: Robot, text: &str, file: &str) -> Result<Robot, Faults> {
    let fault = |key: &str, message: String| {
        let line =
            text.lines().position(|line| line.trim_start().starts_with(&format!("[{key}"))).map_or(1, |line| line + 1);
        let fault = Fault { line, key: key.into(), message };
        Err(Faults { file: file.into(), faults: vec![fault] })
    };
    let key = if matches!(robot.arm, Arm::Planar(_)) { "planar" } else { "limits" };
    let plane = match robot.two_links() {
        Ok(plane) => plane,
        Err(error) => return fault(key, error.to_string()),
    };
    let mut arm = plane.arm;
    if let Arm::SixAxis { drives, .. } = &robot.arm {
        if drives.compliance.0.iter().all(|&k| k == 0.0) {
            return fault(
                "compliance",
                "every drive is rigid: nothing gives way, so there is nothing to compute".into(),
            );
        }
        // Drives 2 and 3 may both be rigid: only the planar model has no answer then.
        [arm.k2, arm.k3] = [JointCompliance::PAPER.0[1], JointCompliance::PAPER.0[2]];
    }
    if let Err(error) = arm.sides() {
        return fault(key, error.to_string());
    }
    match robot.check_compensator() {
        Ok(()) => Ok(robot),
        Err(unheld) => fault("compensator", unheld.to_string()),
    }
}

fn robot(mut root: Table) -> Option<Robot> {
    let name = root.text("name", true);
    let vendor = root.text("vendor", false);
    let architecture = root.choice("architecture", &Architecture::ALL.map(|x| (x.name(), x)), None);
    let status = root.choice("status", &Status::ALL.map(|x| (x.name(), x)), None);
    let architecture_is_assumed = root.flag("architecture_assumed");
    let payload_kg = root.optional_number("payload_kg", PAYLOAD);
    let mass_kg = root.optional_number("mass_kg", MASS);
    let repeatability = root.optional_number("repeatability_mm", REPEATABILITY).map(|mm| mm / 1e3);
    let reach = root.optional_number("reach_m", REACH);
    let source: BTreeMap<String, String> = root.table("source").texts();
    let mut masses = Some(Vec::new());
    let arm = if root.has("planar") {
        for key in
            ["geometry", "limits", "compliance", "compensator", "body", "verified", "mass", "drives", "calibration"]
        {
            if root.has(key) {
                root.fault(key, "does not go with [planar]; a robot has either [planar] or [geometry] and [limits]");
            }
        }
        planar(root.table("planar"), architecture)
    } else if root.has("geometry") {
        let moving = six_axis(&mut root, architecture, &source);
        let geometry = moving
            .as_ref()
            .and_then(|(arm, _)| if let Arm::SixAxis { geometry, .. } = arm { Some(geometry) } else { None });
        masses = super::masses::masses(&mut root, geometry);
        if let (Some(masses), Some(architecture)) = (&masses, architecture) {
            check_carriers(&root, masses, architecture);
        }
        moving
    } else {
        root.fault("", "neither [geometry] with [limits] nor [planar]; a robot needs one of them");
        None
    };
    let calibration = match &arm {
        Some((Arm::SixAxis { geometry, limits, .. }, _)) if root.has("calibration") => {
            calibration(root.table("calibration"), geometry, limits.third_axis).map(Some)
        }
        _ => Some(None),
    };
    if let (Some(Some(calibration)), Some(masses), Some(architecture)) = (&calibration, &masses, architecture) {
        check_weight(&root, calibration, missing_for_weight(architecture == Architecture::QuasiSerial, masses));
    }
    let bodies = match &arm {
        Some((Arm::SixAxis { geometry, .. }, _)) if root.has("body") => bodies(root.table("body"), Some(geometry)),
        _ if root.has("body") => bodies(root.table("body"), None),
        _ => Some((None, None)),
    };
    root.finish(&[
        "geometry",
        "limits",
        "compliance",
        "compensator",
        "body",
        "planar",
        "verified",
        "mass",
        "drives",
        "calibration",
    ]);
    let vendor = vendor.unwrap_or_default();
    let (arm, stiffness_is_assumed) = arm?;
    let (body, enclosing) = bodies?;
    Some(Robot {
        name: name?,
        vendor,
        architecture: architecture?,
        architecture_is_assumed: architecture_is_assumed?,
        stiffness_is_assumed,
        status: status?,
        payload_kg,
        reach,
        mass_kg,
        repeatability,
        body,
        enclosing,
        masses: masses?,
        calibration: calibration?.map(Box::new),
        arm,
        source,
    })
}

/// Only a parallelogram has a rod and a counterweight that turns with its crank.
fn check_carriers(root: &Table, masses: &[Mass], architecture: Architecture) {
    let of_parallelogram = |mass: &&Mass| matches!(mass.carrier, Carrier::Rod { .. } | Carrier::Counterweight);
    if let (Some(mass), Architecture::Serial) = (masses.iter().find(of_parallelogram), architecture) {
        let message =
            format!("{} of a serial arm; expected links from 0 to 6, or architecture = \"quasi-serial\"", mass.carrier);
        root.fault("mass", message);
    }
}

/// Drives yield under masses that are there.
fn check_weight(root: &Table, calibration: &Calibration, missing: Option<String>) {
    if let (Some(missing), true) = (missing, calibration.errors.drives.is_some()) {
        root.fault(
            "calibration",
            format!("weight_urad_per_nm needs a [[mass]] of all that weighs; missing: {missing}"),
        );
    }
}

/// What moves, and whether the stiffness of any drive is left to be assumed.
type Moving = (Arm, bool);

fn planar(mut table: Table, architecture: Option<Architecture>) -> Option<Moving> {
    let stiffness_is_assumed = !(table.has("k2_urad_per_nm") && table.has("k3_urad_per_nm"));
    let l2 = table.number("l2_mm", LINK);
    let l3 = table.number("l3_mm", LINK);
    let k2 = table.compliance("k2_urad_per_nm");
    let k3 = table.compliance("k3_urad_per_nm");
    let shoulder = table.angles("shoulder_deg", ANGLE);
    let elbow = table.angles("elbow_deg", ANGLE);
    let forearm = table.angles("forearm_deg", ANGLE);
    table.finish(&[]);
    let arm = PlanarArm {
        l2: l2? / 1e3,
        l3: l3? / 1e3,
        k2,
        k3,
        architecture: architecture?,
        shoulder: shoulder?,
        elbow: elbow?,
        forearm: forearm?,
    };
    Some((Arm::Planar(arm), stiffness_is_assumed))
}

fn six_axis(root: &mut Table, architecture: Option<Architecture>, source: &BTreeMap<String, String>) -> Option<Moving> {
    let geometry = geometry(root.table("geometry"));
    if !root.has("limits") {
        root.fault("limits", "missing; expected a table with joint_deg, six times [min, max] in deg");
    }
    let verified = if root.has("verified") { verified(root.table("verified")).map(Some) } else { Some(None) };
    let limits = limits(root.table("limits"), verified, source.contains_key(PENDANT_SOURCE));
    let (drives, stiffness_is_assumed) = drives(root, architecture)?;
    Some((Arm::SixAxis { geometry: geometry?, limits: limits?, drives }, stiffness_is_assumed))
}

fn drives(root: &mut Table, architecture: Option<Architecture>) -> Option<(Drives, bool)> {
    let mut table = root.table("compliance");
    // A table that says nothing at all was meant to say something.
    let may_be_absent = !root.has("compliance") || table.has("transmission");
    let is_assumed = !table.has("drive_urad_per_nm");
    let compliance = if may_be_absent {
        table.optional_numbers("drive_urad_per_nm", COMPLIANCE)
    } else {
        table.numbers("drive_urad_per_nm", COMPLIANCE).map(Some)
    };
    let compliance =
        compliance.map(|k| k.map_or(JointCompliance::PAPER, |k: [f64; 6]| JointCompliance(k.map(|k| k / 1e6))));
    let transmission = table.matrix::<6>("transmission", COUPLING);
    let transmission = transmission.map(|rows| rows.map(|rows| Transmission(Matrix6::from_fn(|i, j| rows[i][j]))));
    if transmission.flatten().is_some_and(|transmission| transmission.0.determinant().abs() < 1e-9) {
        table.fault("transmission", "the drives cannot move every joint: the matrix has no inverse");
    }
    let identified = identified(&mut table, is_assumed);
    table.finish(&[]);
    let compensator = if root.has("compensator") { Some(compensator(root.table("compensator"))?) } else { None };
    let motors = super::masses::motors(root);
    let transmission = transmission?.or_else(|| architecture.map(Transmission::of))?;
    if compensator.is_some() && !transmission.joint_2_is_direct() {
        root.fault("compensator", "needs a joint 2 that drive 2 alone moves, one to one; see compliance.transmission");
    }
    Some((
        Drives {
            compliance: compliance?,
            transmission,
            compensator,
            identified: identified?,
            scatter: None,
            motors: motors?,
        },
        is_assumed,
    ))
}

/// What was measured; the outer `None` is a fault.
fn identified(table: &mut Table, is_assumed: bool) -> Option<Option<Identified>> {
    const KEYS: [&str; 7] =
        ["identified", "covariance_urad2_per_n2m2", "postures", "date", "residual_mm", "left_out_mm", "moved_mm"];
    let status = table.choice("status", &[("identified", true)], Some(false));
    if status == Some(false) {
        for key in KEYS.into_iter().filter(|key| table.has(key)) {
            table.fault(key, "needs status = \"identified\" beside it: it is of measured compliances");
        }
        return Some(None);
    }
    if is_assumed {
        table.fault("status", "identified, but drive_urad_per_nm is missing; expected the six compliances");
    }
    let drives = table.flags("identified");
    let covariance = table.matrix::<6>("covariance_urad2_per_n2m2", COVARIANCE);
    let postures = table.number("postures", POSTURES);
    let date = if table.has("date") { table.text("date", true).map(Some) } else { Some(None) };
    let residual = table.number("residual_mm", RESIDUAL);
    let left_out = table.optional_number("left_out_mm", RESIDUAL);
    let moved = table.optional_number("moved_mm", MOVED);
    let Some(rows) = covariance? else {
        table.fault("covariance_urad2_per_n2m2", "missing; expected six rows of six numbers");
        return None;
    };
    let covariance = Matrix6::from_fn(|i, j| rows[i][j]) * 1e-12;
    if !is_covariance(&covariance) {
        table.fault(
            "covariance_urad2_per_n2m2",
            "is no covariance: expected a symmetric matrix without negative variances",
        );
    }
    let date = date?;
    if let Some(date) = date.as_ref().filter(|date| !is_date(date)) {
        table.fault("date", format!("\"{date}\" is no date; expected such as \"2026-05-31\""));
    }
    let postures = postures?;
    if postures.fract() != 0.0 {
        table.fault("postures", format!("{postures} is no whole number"));
    }
    let metres = |mm: Option<f64>| mm.map(|mm| mm / 1e3);
    Some(Some(Identified {
        drives: drives?,
        covariance,
        postures: postures as usize,
        date,
        residual: residual? / 1e3,
        left_out: metres(left_out),
        moved: metres(moved),
    }))
}

/// Symmetric, and no combination has a variance below zero, but for rounding.
fn is_covariance(matrix: &Matrix6<f64>) -> bool {
    let size = matrix.diagonal().max();
    let slack = 1e-9 * size;
    (matrix - matrix.transpose()).abs().max() <= slack
        && 0.0 <= matrix.diagonal().min()
        && matrix.symmetric_eigenvalues().min() >= -slack
}

/// Is this a day as ISO 8601 writes it?
pub fn is_date(text: &str) -> bool {
    let parts: Vec<&str> = text.split('-').collect();
    let digits = |part: &str, count: usize| part.len() == count && part.bytes().all(|c| c.is_ascii_digit());
    let [year, month, day] = *parts.as_slice() else { return false };
    if !(digits(year, 4) && digits(month, 2) && digits(day, 2)) {
        return false;
    }
    let (Ok(year), Ok(month), Ok(day)) = (year.parse::<u32>(), month.parse::<u32>(), day.parse::<u32>()) else {
        return false;
    };
    let is_leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let days = match month {
        2 => 28 + u32::from(is_leap),
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => 0,
    };
    (1..=days).contains(&day)
}

fn compensator(mut table: Table) -> Option<GravityCompensator> {
    let length = length_beside(&table, &["base_mm", "arm_mm"]);
    let base = table.numbers("base_mm", length);
    let arm = table.numbers("arm_mm", length);
    let stiffness = table.number("stiffness_n_per_mm", SPRING);
    let free_length = table.number("free_length_mm", SPRING_LENGTH);
    table.finish(&[]);
    let metres = |point: [f64; 2]| point.map(|mm| mm / 1e3);
    Some(GravityCompensator {
        base: metres(base?),
        arm: metres(arm?),
        stiffness: stiffness? * 1e3,
        free_length: free_length? / 1e3,
    })
}

/// What a length may be in a table that has lengths under these keys: all of them say in which unit they are.
fn length_beside(table: &Table, keys: &[&str]) -> Quantity {
    let in_metres = table.largest(keys) < LARGEST_IN_METRES;
    if in_metres { Quantity { suspect: Some((LARGEST_IN_METRES, 1e3, "m")), ..LENGTH } } else { LENGTH }
}

fn geometry(mut table: Table) -> Option<Geometry> {
    let offset = length_beside(&table, &["a1_mm", "a2_mm", "b_mm", "c1_mm", "c2_mm", "c3_mm", "c4_mm"]);
    let mut length = |key, quantity| table.number(key, quantity).map(|mm| mm / 1e3);
    let (a1, a2, b) = (length("a1_mm", offset), length("a2_mm", offset), length("b_mm", offset));
    let (c1, c2) = (length("c1_mm", offset), length("c2_mm", LINK));
    let (c3, c4) = (length("c3_mm", LINK), length("c4_mm", offset));
    let offset = table.numbers("offset_deg", ANGLE).map(|x| x.map(f64::to_radians));
    let sign: Option<[f64; 6]> = table.numbers("sign", SIGN);
    if sign.is_some_and(|sign| sign.iter().any(|x| x.abs() != 1.0)) {
        table.fault("sign", "expected six times 1 or -1");
    }
    table.finish(&[]);
    Some(Geometry { a1: a1?, a2: a2?, b: b?, c1: c1?, c2: c2?, c3: c3?, c4: c4?, offset: offset?, sign: sign? })
}

/// What was read from the pendant of the very robot.
fn verified(mut table: Table) -> Option<Verified> {
    let rows = table.number("rows", READ);
    if rows.is_some_and(|rows| rows.fract() != 0.0) {
        table.fault("rows", "is no whole number");
    }
    let date = table.text("date", true);
    if let Some(date) = date.as_ref().filter(|date| !is_date(date)) {
        table.fault("date", format!("\"{date}\" is no date; expected such as \"2026-05-31\""));
    }
    let largest = table.number("largest_mm", OFF);
    table.finish(&[]);
    Some(Verified { rows: rows? as usize, date: date?, largest: largest? / 1e3 })
}

/// How the very robot differs from its drawing. The zeros count as the joints do; a turn about a joint's own axis is its zero, and may stand in either place.
fn calibration(mut table: Table, geometry: &Geometry, third_axis: ThirdAxis) -> Option<Calibration> {
    let zero = table.numbers("zero_deg", ZERO);
    let frames = table.matrix::<6>("frames_mm_mrad", ERROR);
    if !table.has("frames_mm_mrad") {
        table.fault("frames_mm_mrad", "missing; expected six rows of three shifts in mm and three turns in mrad");
    }
    let weight = table.optional_numbers("weight_mrad", ERROR);
    let drives = table.optional_numbers("weight_urad_per_nm", COMPLIANCE);
    if table.has("weight_urad_per_nm") && table.has("weight_mrad") {
        table.fault(
            "weight_mrad",
            "stands beside weight_urad_per_nm; expected one: terms, or drives under the masses of the arm",
        );
    }
    let gears = table.optional_numbers::<12>("gears_mrad", ERROR);
    let residual = table.number("residual_mm", RESIDUAL);
    let left_out = table.number("left_out_mm", RESIDUAL);
    let rows = table.number("rows", READ);
    if rows.is_some_and(|rows| rows.fract() != 0.0) {
        table.fault("rows", "is no whole number");
    }
    let date = table.text("date", true);
    if let Some(date) = date.as_ref().filter(|date| !is_date(date)) {
        table.fault("date", format!("\"{date}\" is no date; expected such as \"2026-05-31\""));
    }
    let source = table.text("source", true);
    let models = ControllerModel::ALL.map(|model| (model.name(), model));
    let has_controller = table.has("controller_model");
    let controller =
        if has_controller { table.choice("controller_model", &models, None).map(Some) } else { Some(None) };
    table.finish(&[]);
    let own = own_turns(geometry, third_axis, &zero?.map(f64::to_radians));
    let mut frames = frames??.map(|row| row.map(|x| x / 1e3));
    for (i, own) in own.into_iter().enumerate() {
        frames[i][3 + JOINT_AXES[i]] += own;
    }
    let weight = weight?.map_or(Errors::NONE.weight, |mrad| mrad.map(|x| x / 1e3));
    let gears =
        gears?.map_or(Errors::NONE.gears, |mrad| std::array::from_fn(|i| [mrad[2 * i] / 1e3, mrad[2 * i + 1] / 1e3]));
    Some(Calibration {
        errors: Errors { frames, weight, gears, drives: drives?.map(|urad| urad.map(|x| x / 1e6)) },
        residual: residual? / 1e3,
        left_out: left_out? / 1e3,
        controller: controller?,
        rows: rows? as usize,
        date: date?,
        source: source?,
    })
}

/// Readings of the robot count more than what is published, and what is published must have a source.
fn pendant(table: &mut Table, verified: Option<Verified>, is_sourced: bool) -> Option<Pendant> {
    let said = table.choice("pendant", &[("as-file", true), ("unknown", false)], Some(false))?;
    match (verified, said) {
        (Some(_), false) if table.has("pendant") => {
            table.fault("pendant", "unknown, but [verified] says that the pendant shows what the file says");
            None
        }
        (Some(verified), _) => Some(Pendant::Verified(verified)),
        (None, true) if !is_sourced => {
            table.fault("pendant", "as-file, but [source] pendant is missing; expected who says so, or [verified]");
            None
        }
        (None, true) => Some(Pendant::AsFile),
        (None, false) => Some(Pendant::Unknown),
    }
}

/// `verified` is `None` where that table is faulty.
fn limits(mut table: Table, verified: Option<Option<Verified>>, is_sourced: bool) -> Option<Limits> {
    let joints: Option<[(f64, f64); 6]> = table.ranges("joint_deg", ANGLE);
    // A turn is 6.3 rad; joints 4 and 6 may make several.
    if joints.is_some_and(|joints| joints[..3].iter().all(|(min, max)| max - min < 7.0)) {
        table.fault(
            "joint_deg",
            "the joints 1, 2 and 3 turn by less than 7 deg; if these are radians, convert them to degrees",
        );
    }
    let third_axis = table.choice(
        "third_axis",
        &[("elbow", ThirdAxis::Elbow), ("forearm", ThirdAxis::Forearm)],
        Some(ThirdAxis::Elbow),
    );
    let pendant = verified.and_then(|verified| pendant(&mut table, verified, is_sourced));
    let elbow = table.angles("elbow_deg", ENCLOSED);
    let speeds = table.optional_numbers("speed_deg_per_s", SPEED);
    table.finish(&[]);
    Some(Limits {
        joints: joints?.map(radians),
        third_axis: third_axis?,
        pendant: pendant?,
        elbow: elbow?,
        speeds: speeds?.map(|speeds| speeds.map(f64::to_radians)),
    })
}

/// From a pair in degrees that the reader has put in order.
fn radians((min, max): (f64, f64)) -> Interval {
    Interval::spanning(min.to_radians(), max.to_radians())
}

impl Table<'_, '_> {
    /// `[min, max]` in degrees; no limit where the key is absent.
    fn angles(&mut self, key: &'static str, quantity: Quantity) -> Option<Interval> {
        Some(self.range(key, quantity)?.map_or(Interval::ALL, radians))
    }

    /// rad/(N m); the paper's value where the key is absent.
    fn compliance(&mut self, key: &'static str) -> f64 {
        self.optional_number(key, COMPLIANCE).map_or(JointCompliance::PAPER.0[1], |k| k / 1e6)
    }
}
