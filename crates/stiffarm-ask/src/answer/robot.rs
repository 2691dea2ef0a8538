//! How is a robot reported?

use serde_json::{Value, json};

use super::{Object, Record, Rows, Table, field, shape, stiffness, stiffnesses, words};
use stiffarm::catalogue::microradians;
use stiffarm::drive::Motors;
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::limits::{Limits, Pendant, ThirdAxis, Verified};
use stiffarm::mass::Mass;
use stiffarm::plane::PlanarArm;
use stiffarm::robot::{Arm, Robot};

/// Everything that is known of one robot.
pub fn data_sheet(robot: &Robot) -> Value {
    let mut sheet = Object::new();
    let mut put = |key: &str, value: Value| drop(sheet.insert(key.into(), value));
    put("robot", json!(robot.name));
    put("vendor", json!(robot.vendor));
    put("architecture", json!(robot.architecture.name()));
    put("status", json!(robot.status.name()));
    put("architecture_assumed", json!(robot.architecture_is_assumed));
    put("stiffness_source", json!(robot.stiffness_source().name()));
    put("drive_urad_per_nm", json!(robot.drive_compliance().map(|k| k.map(microradians))));
    put("payload_kg", json!(robot.payload_kg));
    put("reach_m", json!(robot.reach));
    put("mass_kg", json!(robot.mass_kg));
    put("repeatability_mm", json!(robot.repeatability.map(|m| rounded(m * 1e3))));
    if let Arm::SixAxis { geometry, limits, drives } = &robot.arm {
        let (body, is_estimated) = robot.thickness();
        put(
            "body",
            json!({
                "radius_mm": <[f64; 4]>::from(body).map(|m| rounded(m * 1e3)),
                "estimated": is_estimated,
                "enclosing": robot.enclosing.as_ref().map(|enclosing| enclosing.links.each_ref().map(Vec::len)),
            }),
        );
        put("geometry", geometry_json(geometry));
        put("limits", limits_json(limits));
        put("masses", json!(robot.masses.iter().map(mass_json).collect::<Vec<_>>()));
        let Motors { torque, wrist_moment, rotor, damping } = drives.motors;
        put(
            "drives",
            json!({ "torque_nm": torque, "wrist_moment_nm": wrist_moment, "rotor_kg_m2": rotor, "damping_nms_per_rad": damping }),
        );
    }
    // The reader of robot files refuses limits that contradict each other, the only ones without links in a plane.
    if let Ok(plane) = robot.two_links() {
        let arm = &plane.arm;
        put(
            "arm_plane",
            json!({
                "l2_m": arm.l2, "l3_m": arm.l3, "k2_urad_per_nm": arm.k2 * 1e6, "k3_urad_per_nm": arm.k3 * 1e6,
                "shoulder_deg": range(arm.shoulder), "elbow_deg": range(arm.elbow), "forearm_deg": range(arm.forearm),
                "axis_from_base_m": matches!(robot.arm, Arm::SixAxis { .. }).then_some(plane.axis_from_base), "bound_um_per_n": floor(robot),
            }),
        );
    }
    if let Some(Pendant::Verified(Verified { rows, date, largest })) = robot.pendant() {
        put("verified", json!({ "rows": rows, "date": date, "largest_mm": rounded(largest * 1e3) }));
    }
    put("source", json!(robot.source));
    Value::Object(sheet)
}

/// By the keys of a robot file.
fn mass_json(Mass { carrier, body }: &Mass) -> Value {
    json!({
        "link": carrier.to_string(), "mass_kg": body.mass, "com_mm": <[f64; 3]>::from(body.centre).map(|m| rounded(m * 1e3)),
        "inertia_kg_m2": body.elements(),
    })
}

/// What is listed of a robot.
fn entry(robot: &Robot) -> Record {
    // The reader of robot files refuses limits that contradict each other, the only ones without links in a plane.
    let arm = robot.two_links().ok().map(|plane| plane.arm);
    let mut record = Record::of(&shape::LISTED_ROBOT);
    record
        .put(field::VENDOR, &robot.vendor)
        .put(field::ROBOT, &robot.name)
        .put(field::ARCHITECTURE, robot.architecture.name())
        .put(field::STATUS, robot.status.name())
        .put(field::PAYLOAD, robot.payload_kg)
        .put(field::REACH, robot.reach)
        .put(field::L2, arm.as_ref().map(|arm| arm.l2))
        .put(field::L3, arm.as_ref().map(|arm| arm.l3))
        .put(field::FLOOR, robot.arm_plane().ok().map(|plane| plane.arm.radial().floor()))
        .put(field::ARCHITECTURE_ASSUMED, robot.architecture_is_assumed)
        .put(field::MASS, robot.mass_kg)
        .put(field::REPEATABILITY, robot.repeatability);
    stiffness::put(&mut record, robot);
    record
}

/// Robots for a spreadsheet, a row each.
pub fn list(robots: &[Robot]) -> Rows<'static> {
    Rows::of(&shape::LISTED_ROBOT, robots.iter().map(entry))
}

/// Robots for people, a row each.
pub fn table(robots: &[Robot]) -> Table {
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
    ])
    .with_room(2, &["l3/l2", "bound um/N", "l2 m", "l3 m"]);
    let or_dash = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| words::fixed(value, 3));
    for robot in robots {
        let arm = robot.two_links().ok().map(|plane| plane.arm);
        let of_arm = |value: fn(&PlanarArm) -> f64| or_dash(arm.as_ref().map(value));
        table.row([
            robot.vendor.clone(),
            robot.name.clone(),
            words::architecture(robot),
            words::status(robot).into(),
            robot.payload_kg.map_or_else(|| "-".into(), |kg| kg.to_string()),
            or_dash(robot.reach),
            of_arm(|arm| arm.l2),
            of_arm(|arm| arm.l3),
            of_arm(|arm| arm.l3 / arm.l2),
            or_dash(floor(robot)),
        ]);
    }
    table
}

/// What stands below that table.
pub fn notes(robots: &[Robot]) -> String {
    let mut makers: Vec<&str> = robots.iter().map(|robot| robot.vendor.as_str()).collect();
    makers.dedup(); // the list is in their order
    let of = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    format!(
        "{} of {}\n{}{}bound: compliance at the stiffest posture of the links, with the {}\n",
        of(robots.len(), "robot"),
        of(makers.len(), "maker"),
        words::assumed_architecture(robots),
        words::statuses(robots),
        stiffnesses(robots)
    )
}

/// In degrees; null where an end is open.
fn range(range: Interval) -> Value {
    let end = |x: f64| if x.is_finite() { json!(x.to_degrees()) } else { Value::Null };
    json!([end(range.min()), end(range.max())])
}

/// By the keys of a robot file.
fn geometry_json(geometry: &Geometry) -> Value {
    let mut object: Object =
        lengths(geometry).iter().map(|(name, m)| (format!("{name}_mm"), json!(rounded(m * 1e3)))).collect();
    object.insert("offset_deg".into(), json!(geometry.offset.map(|x| rounded(x.to_degrees()))));
    object.insert("sign".into(), json!(geometry.sign));
    Value::Object(object)
}

/// By the keys of a robot file.
fn limits_json(limits: &Limits) -> Value {
    json!({
        "joint_deg": limits.joints.map(|joint| [joint.min(), joint.max()].map(|x| rounded(x.to_degrees()))),
        "third_axis": match limits.third_axis {
            ThirdAxis::Elbow => "elbow",
            ThirdAxis::Forearm => "forearm",
        },
        "pendant": limits.pendant.name(),
        "elbow_deg": range(limits.elbow),
        "speed_deg_per_s": limits.speeds.map(|speeds| speeds.map(|speed| rounded(speed.to_degrees()))),
    })
}

/// The stiffest posture's deflection, um/N; `None` where the planar model does not hold.
pub fn floor(robot: &Robot) -> Option<f64> {
    robot.arm_plane().ok().map(|plane| plane.arm.radial().floor() * 1e6)
}

/// The lengths of a robot file by their letters, m.
pub fn lengths(geometry: &Geometry) -> [(&'static str, f64); 7] {
    let Geometry { a1, a2, b, c1, c2, c3, c4, .. } = *geometry;
    [("a1", a1), ("a2", a2), ("b", b), ("c1", c1), ("c2", c2), ("c3", c3), ("c4", c4)]
}

/// A number to six decimals, which is finer than any file: without the noise of a change of units.
pub fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6 + 0.0
}

/// The compliance of the drives as a robot file says it, urad/(N m): six, or of a planar robot those of the drives 2 and 3.
pub fn drive_urad_per_nm(robot: &Robot) -> Vec<f64> {
    match &robot.arm {
        Arm::SixAxis { drives, .. } => drives.compliance.0.map(microradians).to_vec(),
        Arm::Planar(arm) => [arm.k2, arm.k3].map(microradians).to_vec(),
    }
}
