//! `stiffarm robots`: list, show and check robots.

use serde_json::{Map, Value, json};
use stiffarm::catalogue::paper_robots;
use stiffarm::limits::{Range, ThirdAxis};
use stiffarm::plane::PlanarArm;
use stiffarm::robot::{Arm, Robot};

use crate::args::{Common, RobotsAction, RobotsArgs};
use crate::failure::Failure;
use crate::output::{Answer, deliver, print};
use crate::selection;
use crate::table::{Table, fixed, fixed_or_dash, full};

pub(crate) fn run(args: &RobotsArgs, common: &Common) -> Result<(), Failure> {
    match &args.action {
        None | Some(RobotsAction::List) => deliver(&List(paper_robots()), common),
        Some(RobotsAction::Show { robot }) => deliver(&Sheet(selection::robot(robot)?), common),
        Some(RobotsAction::Check { files }) => check(files),
        Some(RobotsAction::Import(args)) => super::import::run(args, common),
    }
}

/// Reads every file, and reports the faults of all of them.
fn check(files: &[std::path::PathBuf]) -> Result<(), Failure> {
    let mut bad = 0;
    let mut all = Vec::new();
    for path in files {
        if path.is_dir() {
            all.extend(selection::files_in(path)?);
        } else {
            all.push(path.clone());
        }
    }
    for file in &all {
        match selection::read_file(file) {
            Ok(robot) => print(&format!("{}: {} can be used\n", file.display(), robot.full_name()))?,
            Err(failure) => {
                bad += 1;
                eprintln!("{failure}");
            }
        }
    }
    if bad == 0 { Ok(()) } else { Err(Failure::BadFiles(bad)) }
}

/// The stiffest posture's deflection, um/N.
fn floor(arm: &PlanarArm) -> f64 {
    arm.radial().floor() * 1e6
}

struct List(Vec<Robot>);

impl Answer for List {
    const COMMAND: &'static str = "robots list";

    fn text(&self, markdown: bool) -> String {
        let mut table = Table::new([
            "vendor",
            "robot",
            "architecture",
            "status",
            "payload kg",
            "reach m",
            "l2 m",
            "l3 m",
            "l3/l2",
            "bound um/N",
        ]);
        for robot in &self.0 {
            let Ok(plane) = robot.arm_plane() else { continue };
            let arm = plane.arm;
            table.row([
                robot.vendor.clone(),
                robot.name.clone(),
                robot.architecture.to_string(),
                robot.status.to_string(),
                fixed_or_dash(robot.payload_kg, 0),
                fixed_or_dash(robot.reach, 3),
                fixed(arm.l2, 3),
                fixed(arm.l3, 3),
                fixed(arm.l3 / arm.l2, 3),
                fixed(floor(&arm), 3),
            ]);
        }
        table.text(markdown)
            + "bound: compliance at the stiffest posture of the links, with the joint compliances of the robot file\n"
    }

    fn json(&self) -> Value {
        self.0.iter().map(sheet_json).collect()
    }

    fn csv(&self) -> Table {
        let mut table = Table::new([
            "vendor",
            "robot",
            "architecture",
            "status",
            "payload_kg",
            "reach_m",
            "l2_m",
            "l3_m",
            "bound_um_per_n",
        ]);
        for robot in &self.0 {
            let Ok(plane) = robot.arm_plane() else { continue };
            table.row([
                robot.vendor.clone(),
                robot.name.clone(),
                robot.architecture.to_string(),
                robot.status.to_string(),
                full(robot.payload_kg),
                full(robot.reach),
                plane.arm.l2.to_string(),
                plane.arm.l3.to_string(),
                floor(&plane.arm).to_string(),
            ]);
        }
        table
    }
}

struct Sheet(Robot);

/// `-40.0 to 160.0`, in degrees.
fn degrees(range: Range) -> String {
    if range.is_all() {
        "no limit".into()
    } else {
        format!("{:.1} to {:.1} deg", range.min().to_degrees(), range.max().to_degrees())
    }
}

impl Sheet {
    fn rows(&self) -> Vec<(String, String)> {
        let robot = &self.0;
        let mut rows: Vec<(String, String)> = vec![
            ("robot".into(), robot.full_name()),
            ("architecture".into(), robot.architecture.to_string()),
            ("status".into(), robot.status.to_string()),
            ("payload".into(), robot.payload_kg.map_or_else(|| "-".into(), |kg| format!("{kg} kg"))),
            ("reach".into(), robot.reach.map_or_else(|| "-".into(), |reach| format!("{reach:.3} m"))),
        ];
        if let Arm::SixAxis { geometry, limits, drives } = &robot.arm {
            let lengths = [
                ("a1", geometry.a1),
                ("a2", geometry.a2),
                ("b", geometry.b),
                ("c1", geometry.c1),
                ("c2", geometry.c2),
                ("c3", geometry.c3),
                ("c4", geometry.c4),
            ];
            let lengths: Vec<String> = lengths.iter().map(|(name, m)| format!("{name} {:.0}", m * 1e3)).collect();
            rows.push(("lengths".into(), format!("{} mm", lengths.join(", "))));
            for (i, range) in limits.joints.iter().enumerate() {
                let forearm = i == 2 && limits.third_axis == ThirdAxis::Forearm;
                let remark = if forearm { " (absolute angle of the forearm)" } else { "" };
                rows.push((format!("joint {} as reported", i + 1), degrees(*range) + remark));
            }
            if !limits.elbow.is_all() {
                rows.push(("angle between the links".into(), degrees(limits.elbow)));
            }
            let drives: Vec<String> =
                drives.compliance.0.iter().map(|k| format!("{}", (k * 1e12).round() / 1e6)).collect();
            rows.push(("drive compliance".into(), format!("{} urad/(N m)", drives.join(", "))));
        }
        if let Ok(plane) = robot.arm_plane() {
            let arm = plane.arm;
            rows.push((
                "arm plane".into(),
                format!("l2 {:.4} m, l3 {:.4} m, l3/l2 {:.4}", arm.l2, arm.l3, arm.l3 / arm.l2),
            ));
            rows.push(("  shoulder".into(), degrees(arm.shoulder)));
            rows.push(("  elbow".into(), degrees(arm.elbow)));
            rows.push(("  forearm".into(), degrees(arm.forearm)));
            rows.push((
                "stiffest posture".into(),
                format!("{:.4} um/N at {:.3} m from the joint-2 axis", floor(&arm), arm.radial().valley()),
            ));
        }
        rows.extend(robot.source.iter().map(|(key, text)| (format!("source: {key}"), text.clone())));
        rows
    }
}

impl Answer for Sheet {
    const COMMAND: &'static str = "robots show";

    fn text(&self, markdown: bool) -> String {
        let mut table = Table::new(["", ""]);
        for (key, value) in self.rows() {
            table.row([key, value]);
        }
        table.text(markdown)
            + "angles of the arm plane: counter-clockwise, 0 straight ahead; negative elbow: bent forwards and down\n"
    }

    fn json(&self) -> Value {
        sheet_json(&self.0)
    }

    fn csv(&self) -> Table {
        let mut table = Table::new(["key", "value"]);
        for (key, value) in self.rows() {
            table.row([key.trim().to_owned(), value]);
        }
        table
    }
}

fn sheet_json(robot: &Robot) -> Value {
    let mut sheet = Map::new();
    let mut put = |key: &str, value: Value| drop(sheet.insert(key.into(), value));
    put("robot", json!(robot.name));
    put("vendor", json!(robot.vendor));
    put("architecture", json!(robot.architecture.name()));
    put("status", json!(robot.status.name()));
    put("payload_kg", json!(robot.payload_kg));
    put("reach_m", json!(robot.reach));
    if let Ok(plane) = robot.arm_plane() {
        let arm = &plane.arm;
        let range = |range: Range| {
            let end = |x: f64| if x.is_finite() { json!(x.to_degrees()) } else { Value::Null };
            json!([end(range.min()), end(range.max())])
        };
        put(
            "arm_plane",
            json!({
                "l2_m": arm.l2, "l3_m": arm.l3, "k2_urad_per_nm": arm.k2 * 1e6, "k3_urad_per_nm": arm.k3 * 1e6,
                "shoulder_deg": range(arm.shoulder), "elbow_deg": range(arm.elbow), "forearm_deg": range(arm.forearm),
                "axis_from_base_m": plane.axis_from_base, "bound_um_per_n": floor(arm),
            }),
        );
    }
    put("source", json!(robot.source));
    Value::Object(sheet)
}
