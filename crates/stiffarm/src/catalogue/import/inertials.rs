//! What do the bodies of a description weigh, and how hard do its motors pull?
//!
//! Masses are taken all or none: a robot that swings with half of its bodies is none. What is a placeholder, or lies where no body is, is
//! refused by the name of its link.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::chain::Chain;
use super::described::Described;
use super::ranges::round;
use crate::catalogue::masses::{ASIDE, TORQUE, aside};
use crate::catalogue::reader::shown;
use crate::geometry::Geometry;
use crate::limits::ThirdAxis;
use crate::mass::{Carrier, LEAST_KG, Mass, RigidBody};

/// A mass centre may lie this far outside the box about the meshes of its link, m; published ones lie within 0.02.
const OUTSIDE: f64 = 0.03;
/// Places are written in so many steps of a millimetre.
const STEPS: f64 = 1e3;
/// And masses and inertias in so many of a unit: the digits that are published.
const DIGITS: f64 = 1e9;

/// The box about the meshes of each link at model zero, base axes, from the base: its least and its largest corner, m.
pub(super) type Boxes = [Option<[Vector3<f64>; 2]>; 7];

impl Described<'_> {
    /// The bodies of the arm, at model zero; `Ok(None)` where the description has none.
    ///
    /// # Errors
    /// Why none is taken.
    pub(super) fn masses(&self, geometry: &Geometry, boxes: Option<&Boxes>) -> Result<Option<Vec<Mass>>, String> {
        let (carried, _) = self.carried(&geometry.reported(&[0.0; 6], ThirdAxis::Elbow));
        let mut found: BTreeMap<usize, (RigidBody, &str)> = BTreeMap::new();
        let mut own = Vec::new();
        for link in &self.urdf.links {
            let (Some(body), Some((number, pose))) = (&link.inertial, carried.get(link.name.as_str())) else {
                continue;
            };
            if body.mass < LEAST_KG {
                return Err(format!("link '{}' weighs {} kg, a placeholder", shown(&link.name), body.mass));
            }
            if let Some(fault) = body.inertia_fault() {
                return Err(format!("link '{}': {fault}", shown(&link.name)));
            }
            own.push(*body);
            let seen = body.seen_from(pose);
            found.entry(*number).and_modify(|(sum, _)| *sum = sum.with(&seen)).or_insert((seen, &link.name));
        }
        if found.is_empty() {
            return Ok(None);
        }
        let are_alike = own.iter().all(|body| (body.mass, body.inertia) == (own[0].mass, own[0].inertia));
        if are_alike && 1 < own.len() {
            return Err(format!("all links weigh {} kg and are as hard to turn, placeholders", own[0].mass));
        }
        if let Some(missing) = (1..=6).find(|number| !found.contains_key(number)) {
            let joint = &self.chain.joints[missing - 1];
            return Err(format!("link '{}', which {} turns, has no mass", shown(&joint.child), joint.key()));
        }
        let most = ASIDE * (geometry.a1 + geometry.c2 + geometry.l3());
        let masses = found.into_iter().map(|(number, (body, link))| {
            let carrier = if number == 0 { Carrier::Base } else { Carrier::Link(number) };
            let off = aside(geometry, carrier, &body.centre);
            if most < off {
                return Err(format!(
                    "the mass centre of link '{}' lies {:.0} mm off the line of the {carrier}",
                    shown(link),
                    off * 1e3
                ));
            }
            let outside = boxes.and_then(|boxes| boxes[number]).map_or(0.0, |corners| outside(corners, &body.centre));
            if OUTSIDE < outside {
                return Err(format!(
                    "the mass centre of link '{}' lies {:.0} mm outside the box about its meshes",
                    shown(link),
                    outside * 1e3
                ));
            }
            Ok(Mass { carrier, body: rounded(&body) })
        });
        masses.collect::<Result<Vec<_>, _>>().map(Some)
    }
}

/// How far a point lies outside a box, m.
fn outside([least, largest]: [Vector3<f64>; 2], point: &Vector3<f64>) -> f64 {
    (least - point).sup(&(point - largest)).map(|off| off.max(0.0)).norm()
}

fn rounded(body: &RigidBody) -> RigidBody {
    let centre = body.centre.map(|m| round(m * 1e3, STEPS) / 1e3);
    RigidBody::new(round(body.mass, DIGITS), centre, body.elements().map(|element| round(element, DIGITS)))
}

/// The torque limits of the six joints, N m; `Ok(None)` where there are none.
///
/// # Errors
/// Why none is taken.
pub(super) fn torques(chain: &Chain) -> Result<Option<[f64; 6]>, String> {
    let efforts = chain.joints.each_ref().map(|joint| joint.limit.effort.unwrap_or(0.0));
    if efforts == [0.0; 6] {
        return Ok(None);
    }
    if efforts == [efforts[0]; 6] {
        return Err(format!("all joints have {} N m, a placeholder", efforts[0]));
    }
    match chain.joints.iter().zip(efforts).find(|(_, effort)| !(TORQUE.min..=TORQUE.max).contains(effort)) {
        Some((joint, effort)) => Err(format!("{} has {effort} N m", joint.key())),
        None => Ok(Some(efforts)),
    }
}
