//! Reads a robot file (TOML): checks every value, reports every fault with its line, turns mm and degrees into SI.

use std::collections::BTreeMap;

use toml::de::DeTable;

use super::reader::{Log, Quantity, Table};
use super::{Fault, Faults};
use crate::drive::{Architecture, JointCompliance};
use crate::geometry::Geometry;
use crate::limits::{Limits, Range, ThirdAxis};
use crate::plane::PlanarArm;
use crate::robot::{Arm, Robot, Status};

const METRES: Option<(f64, f64, &str)> = Some((5.0, 1e3, "m"));
const LINK: Quantity = Quantity { unit: "mm", min: 20.0, max: 10_000.0, suspect: Some((20.0, 1e3, "m")) };
const LENGTH: Quantity = Quantity { unit: "mm", min: -10_000.0, max: 10_000.0, suspect: METRES };
const ANGLE: Quantity = Quantity { unit: "deg", min: -1080.0, max: 1080.0, suspect: None };
const SIGN: Quantity = Quantity { unit: "(+1 or -1)", min: -1.0, max: 1.0, suspect: None };
const ENCLOSED: Quantity = Quantity { unit: "deg", min: 0.0, max: 360.0, suspect: None };
const COMPLIANCE: Quantity =
    Quantity { unit: "urad/(N m)", min: 1e-3, max: 1e4, suspect: Some((1e-3, 1e6, "rad/(N m)")) };
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
                log.add(error.span().map_or(0, |span| span.start), "", error.message());
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

/// Refuses limits that leave nothing.
fn reachable(robot: Robot, text: &str, file: &str) -> Result<Robot, Faults> {
    let nothing = match robot.arm_plane().map(|plane| plane.arm.sides()) {
        Some(Ok(_)) => return Ok(robot),
        Some(Err(error)) => error.to_string(),
        None => "joint 3 and elbow_deg share no angle: the limits leave nothing reachable".into(),
    };
    let key = if matches!(robot.arm, Arm::Planar(_)) { "planar" } else { "limits" };
    let line =
        text.lines().position(|line| line.trim_start().starts_with(&format!("[{key}"))).map_or(1, |line| line + 1);
    let fault = Fault { line, key: key.into(), message: nothing };
    Err(Faults { file: file.into(), faults: vec![fault] })
}

fn robot(mut root: Table) -> Option<Robot> {
    let name = root.text("name", true);
    let vendor = root.text("vendor", false);
    let architecture = root.choice("architecture", &Architecture::ALL.map(|x| (x.name(), x)), None);
    let status = root.choice("status", &Status::ALL.map(|x| (x.name(), x)), None);
    let payload_kg = root.optional_number("payload_kg", PAYLOAD);
    let reach = root.optional_number("reach_m", REACH);
    let source: BTreeMap<String, String> = root.table("source").texts();
    let arm = if root.has("planar") {
        for key in ["geometry", "limits", "compliance"] {
            if root.has(key) {
                root.fault(key, "does not go with [planar]; a robot has either [planar] or [geometry] and [limits]");
            }
        }
        planar(root.table("planar"), architecture).map(Arm::Planar)
    } else if root.has("geometry") {
        six_axis(&mut root)
    } else {
        root.fault("", "neither [geometry] with [limits] nor [planar]; a robot needs one of them");
        None
    };
    root.finish(&["geometry", "limits", "compliance", "planar"]);
    let vendor = vendor.unwrap_or_default();
    Some(Robot {
        name: name?,
        vendor,
        architecture: architecture?,
        status: status?,
        payload_kg,
        reach,
        arm: arm?,
        source,
    })
}

fn planar(mut table: Table, architecture: Option<Architecture>) -> Option<PlanarArm> {
    let l2 = table.number("l2_mm", LINK);
    let l3 = table.number("l3_mm", LINK);
    let k2 = table.compliance("k2_urad_per_nm");
    let k3 = table.compliance("k3_urad_per_nm");
    let shoulder = table.angles("shoulder_deg", ANGLE);
    let elbow = table.angles("elbow_deg", ANGLE);
    let forearm = table.angles("forearm_deg", ANGLE);
    table.finish(&[]);
    Some(PlanarArm {
        l2: l2? / 1e3,
        l3: l3? / 1e3,
        k2,
        k3,
        architecture: architecture?,
        shoulder: shoulder?,
        elbow: elbow?,
        forearm: forearm?,
    })
}

fn six_axis(root: &mut Table) -> Option<Arm> {
    let geometry = geometry(root.table("geometry"));
    if !root.has("limits") {
        root.fault("limits", "missing; expected a table with joint_deg, six times [min, max] in deg");
    }
    let limits = limits(root.table("limits"));
    let mut table = root.table("compliance");
    let compliance = if root.has("compliance") {
        table.numbers("drive_urad_per_nm", COMPLIANCE).map(|k| JointCompliance(k.map(|k: f64| k / 1e6)))
    } else {
        Some(JointCompliance::PAPER)
    };
    table.finish(&[]);
    Some(Arm::SixAxis { geometry: geometry?, limits: limits?, compliance: compliance? })
}

fn geometry(mut table: Table) -> Option<Geometry> {
    let mut length = |key, quantity| table.number(key, quantity).map(|mm| mm / 1e3);
    let (a1, a2, b) = (length("a1_mm", LENGTH), length("a2_mm", LENGTH), length("b_mm", LENGTH));
    let (c1, c2) = (length("c1_mm", LENGTH), length("c2_mm", LINK));
    let (c3, c4) = (length("c3_mm", LINK), length("c4_mm", LENGTH));
    let offset = table.numbers("offset_deg", ANGLE).map(|x| x.map(f64::to_radians));
    let sign: Option<[f64; 6]> = table.numbers("sign", SIGN);
    if sign.is_some_and(|sign| sign.iter().any(|x| x.abs() != 1.0)) {
        table.fault("sign", "expected six times 1 or -1");
    }
    table.finish(&[]);
    Some(Geometry { a1: a1?, a2: a2?, b: b?, c1: c1?, c2: c2?, c3: c3?, c4: c4?, offset: offset?, sign: sign? })
}

fn limits(mut table: Table) -> Option<Limits> {
    let joints: Option<[(f64, f64); 6]> = table.ranges("joint_deg", ANGLE);
    if joints.is_some_and(|joints| joints.iter().all(|(min, max)| max - min < 7.0)) {
        table.fault("joint_deg", "every range is narrower than 7 deg; if these are radians, convert them to degrees");
    }
    let third_axis = table.choice(
        "third_axis",
        &[("elbow", ThirdAxis::Elbow), ("forearm", ThirdAxis::Forearm)],
        Some(ThirdAxis::Elbow),
    );
    let elbow = table.angles("elbow_deg", ENCLOSED);
    table.finish(&[]);
    Some(Limits { joints: joints?.map(radians), third_axis: third_axis?, elbow: elbow? })
}

/// From a pair in degrees that the reader has put in order.
fn radians((min, max): (f64, f64)) -> Range {
    Range::spanning(min.to_radians(), max.to_radians())
}

impl Table<'_, '_> {
    /// `[min, max]` in degrees; no limit where the key is absent.
    fn angles(&mut self, key: &'static str, quantity: Quantity) -> Option<Range> {
        Some(self.range(key, quantity)?.map_or(Range::ALL, radians))
    }

    /// rad/(N m); the paper's value where the key is absent.
    fn compliance(&mut self, key: &'static str) -> f64 {
        self.optional_number(key, COMPLIANCE).map_or(JointCompliance::PAPER.0[1], |k| k / 1e6)
    }
}
