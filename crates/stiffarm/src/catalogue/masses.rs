//! What does a robot file say of masses (`[[mass]]`) and motors (`[drives]`)?

use nalgebra::Vector3;

use super::reader::{Quantity, Table};
use crate::drive::Motors;
use crate::geometry::Geometry;
use crate::mass::{Carrier, LEAST_KG, Mass, RigidBody};

const MASS: Quantity = Quantity { unit: "kg", min: 0.0, max: 50_000.0, suspect: None };
const CENTRE: Quantity = Quantity { unit: "mm", min: -10_000.0, max: 10_000.0, suspect: None };
const INERTIA: Quantity = Quantity { unit: "kg m2", min: -100_000.0, max: 100_000.0, suspect: None };
pub(super) const TORQUE: Quantity = Quantity { unit: "N m", min: 0.1, max: 1e6, suspect: None };
const DAMPING: Quantity = Quantity { unit: "N m s/rad", min: 0.0, max: 1e6, suspect: None };
/// As the joint feels it: no gear of an arm leaves less.
const ROTOR: Quantity = Quantity { unit: "kg m2", min: 0.01, max: 1e5, suspect: None };
const MOTOR: Quantity = Quantity { unit: "kg m2", min: 1e-7, max: 1.0, suspect: None };
const RATIO: Quantity =
    Quantity { unit: "(turns of the motor a turn of the joint)", min: 1.0, max: 2000.0, suspect: None };
/// A mass centre lies this near to the line of its link, in parts of the reach of the stretched links; of the published arms none is further
/// than 0.12.
const ASIDE: f64 = 0.25;

/// The bodies of an arm; `None` where one of them is faulty.
pub(super) fn masses(root: &mut Table, geometry: Option<&Geometry>) -> Option<Vec<Mass>> {
    let tables = root.tables("mass");
    let found: Vec<Option<Mass>> = tables.into_iter().map(|table| mass(table, geometry)).collect();
    found.into_iter().collect()
}

fn mass(mut table: Table, geometry: Option<&Geometry>) -> Option<Mass> {
    let carrier = carrier(&mut table);
    let mass = table.number("mass_kg", MASS);
    if let Some(mass) = mass.filter(|mass| *mass < LEAST_KG) {
        let message =
            format!("{mass} kg is a placeholder, no mass; expected at least {LEAST_KG} kg, or the body left out");
        table.fault("mass_kg", message);
    }
    let centre = table.numbers("com_mm", CENTRE).map(|mm: [f64; 3]| Vector3::from(mm.map(|mm| mm / 1e3)));
    let inertia = table.numbers("inertia_kg_m2", INERTIA);
    let body = match (mass, centre, inertia) {
        (Some(mass), Some(centre), Some(inertia)) => Some(RigidBody::new(mass, centre, inertia)),
        _ => None,
    };
    // A body may be stated as a point.
    let sized = body.filter(|body| body.elements() != [0.0; 6]);
    let fault = body.and_then(|body| body.inertia_fault());
    if let Some(fault) = fault.or_else(|| sized?.size_fault()) {
        table.fault("inertia_kg_m2", fault);
    }
    if let (Some(geometry), Some(carrier), Some(centre)) = (geometry, carrier, centre) {
        let most = ASIDE * (geometry.a1 + geometry.c2 + geometry.l3());
        let aside = aside(geometry, carrier, &centre);
        if !(aside <= most) {
            let [aside, most] = [aside, most].map(|m| m * 1e3);
            let message = format!(
                "the mass centre lies {aside:.0} mm off the line of the {carrier}; expected at most {most:.0} mm, counted from the base at model zero (upper arm and forearm upright)"
            );
            table.fault("com_mm", message);
        }
    }
    table.finish(&["crank_mm"]);
    Some(Mass { carrier: carrier?, body: body? })
}

fn carrier(table: &mut Table) -> Option<Carrier> {
    let link = table.word_or_whole("link", "a link from 0 (the base) to 6, \"rod\" or \"counterweight\"")?;
    let found = match link.as_str() {
        "0" => Some(Carrier::Base),
        "rod" => {
            let crank = table.numbers("crank_mm", CENTRE);
            return crank.map(|crank: [f64; 2]| Carrier::Rod { crank: crank.map(|mm| mm / 1e3) });
        }
        "counterweight" => Some(Carrier::Counterweight),
        other => other.parse().ok().filter(|link| (1..=6).contains(link)).map(Carrier::Link),
    };
    if found.is_none() {
        table.fault("link", format!("{link}; expected a link from 0 (the base) to 6, \"rod\" or \"counterweight\""));
    }
    if table.has("crank_mm") {
        table.fault("crank_mm", "is of a rod; expected link = \"rod\" beside it");
    }
    found
}

/// How far a point lies from the line along which a body extends at model zero, m.
pub(super) fn aside(geometry: &Geometry, carrier: Carrier, point: &Vector3<f64>) -> f64 {
    let [_, shoulder, elbow, wrist, flange] = geometry.points(&[0.0; 6]).map(Vector3::from);
    let foot = Vector3::zeros();
    let (from, to) = match carrier {
        Carrier::Base | Carrier::Link(1) => (foot, shoulder),
        Carrier::Link(2) | Carrier::Rod { .. } => (shoulder, elbow),
        Carrier::Link(3 | 4) => (elbow, wrist),
        Carrier::Link(_) => (wrist, flange),
        Carrier::Counterweight => (shoulder, shoulder - (wrist - elbow)),
    };
    let along = to - from;
    let share =
        if along.norm() == 0.0 { 0.0 } else { ((point - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0) };
    (point - from - along * share).norm()
}

/// What is known of the motors; `None` where that is faulty.
pub(super) fn motors(root: &mut Table) -> Option<Motors> {
    let is_there = root.has("drives");
    let mut table = root.table("drives");
    let torque = table.optional_numbers("torque_nm", TORQUE);
    let wrist_moment = table.optional_numbers("wrist_moment_nm", TORQUE);
    let damping = table.optional_numbers("damping_nms_per_rad", DAMPING);
    let rotor: Option<Option<[f64; 6]>> = table.optional_numbers("rotor_kg_m2", ROTOR);
    let motor: Option<Option<[f64; 6]>> = table.optional_numbers("motor_kg_m2", MOTOR);
    let ratio: Option<Option<[f64; 6]>> = table.optional_numbers("ratio", RATIO);
    for (key, other) in [("motor_kg_m2", "ratio"), ("ratio", "motor_kg_m2")] {
        if table.has(key) && !table.has(other) {
            let message = format!("needs {other} beside it: the joint feels a rotor by the square of its ratio");
            table.fault(key, message);
        }
    }
    if table.has("rotor_kg_m2") && table.has("motor_kg_m2") {
        table.fault(
            "rotor_kg_m2",
            "stands beside motor_kg_m2; expected one: reflected to the joint, or the motor's own with its ratio",
        );
    }
    if is_there
        && !["torque_nm", "wrist_moment_nm", "damping_nms_per_rad", "rotor_kg_m2", "motor_kg_m2", "ratio"]
            .iter()
            .any(|key| table.has(key))
    {
        table.fault("", "says nothing; expected torque_nm, wrist_moment_nm, rotor_kg_m2 or damping_nms_per_rad");
    }
    table.finish(&[]);
    let reflected = motor?.zip(ratio?).map(|(motor, ratio)| std::array::from_fn(|i| ratio[i] * ratio[i] * motor[i]));
    Some(Motors { torque: torque?, wrist_moment: wrist_moment?, rotor: rotor?.or(reflected), damping: damping? })
}
