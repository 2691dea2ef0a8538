//! What do the bodies of a description weigh, and how hard do its motors pull?
//!
//! Masses are taken all or none: a robot that swings with half of its bodies is none. What is a placeholder, or lies where no body is, is
//! refused by the name of its link.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::chain::Chain;
use super::described::Described;
use super::ranges::round;
use crate::catalogue::masses::{TORQUE, aside};
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

/// A mass centre lies this near to the line of its link, in parts of the reach of the stretched links; of the published arms none is further
/// than 0.12.
const OFF_LINE: f64 = 0.15;
/// No arm weighs more, kg: the largest ones weigh 5 t.
const HEAVIEST: f64 = 10_000.0;

/// The bodies of an arm, and what is to be said of them.
pub(super) type Bodies = (Vec<Mass>, Vec<String>);

/// The box about the meshes of each link at model zero, base axes, from the base: its least and its largest corner, m.
pub(super) type Boxes = [Option<[Vector3<f64>; 2]>; 7];

impl Described<'_> {
    /// The bodies of the arm, at model zero; `Ok(None)` where the description has none.
    ///
    /// # Errors
    /// Why none is taken.
    pub(super) fn masses(&self, geometry: &Geometry, boxes: Option<&Boxes>) -> Result<Option<Bodies>, String> {
        let (carried, left_out) = self.carried(&geometry.reported(&[0.0; 6], ThirdAxis::Elbow));
        let mut found: BTreeMap<usize, (RigidBody, &str)> = BTreeMap::new();
        let mut hung_on = Vec::new();
        for link in &self.urdf.links {
            // Frames that carry nothing have a mass of zero.
            let Some(body) = link.inertial.filter(|body| body.mass != 0.0) else { continue };
            let name = shown(&link.name);
            if left_out.contains(&link.name.as_str()) {
                return Err(format!(
                    "link '{name}' weighs {} kg and follows a joint; a robot file can say it",
                    body.mass
                ));
            }
            let Some(&(number, pose)) = carried.get(link.name.as_str()) else { continue };
            check(&name, &body)?;
            if 1 <= number && link.name != self.chain.joints[number - 1].child {
                hung_on.push(format!("'{name}' of {} kg with link {number}", body.mass));
            }
            let seen = body.seen_from(&pose);
            found.entry(number).and_modify(|(sum, _)| *sum = sum.with(&seen)).or_insert((seen, &link.name));
        }
        if found.is_empty() {
            return Ok(None);
        }
        self.check_all(&found)?;
        let reach = geometry.a1 + geometry.c2 + geometry.l3();
        let masses = found.into_iter().map(|(number, (body, link))| {
            let carrier = if number == 0 { Carrier::Base } else { Carrier::Link(number) };
            let off = aside(geometry, carrier, &body.centre);
            let far = |mm: f64, from: &str| format!("the mass centre of link '{}' lies {mm:.0} mm {from}", shown(link));
            if OFF_LINE * reach < off {
                return Err(far(off * 1e3, &format!("off the line of the {carrier}")));
            }
            let outside = boxes.and_then(|boxes| boxes[number]).map_or(0.0, |corners| outside(corners, &body.centre));
            if OUTSIDE < outside {
                return Err(far(outside * 1e3, "outside the box about its meshes"));
            }
            Ok(Mass { carrier, body: rounded(&body) })
        });
        let masses = masses.collect::<Result<Vec<_>, _>>()?;
        let compared = if boxes.is_some() { "" } else { ", their centres not compared with the meshes (--meshes)" };
        let mut notes = vec![format!("masses: of {} bodies, from the inertials{compared}", masses.len())];
        if !hung_on.is_empty() {
            notes.push(format!("masses: counted where they hang: {}", hung_on.join(", ")));
        }
        Ok(Some((masses, notes)))
    }

    /// Each link of the arm has a mass, and they are no placeholders.
    fn check_all(&self, found: &BTreeMap<usize, (RigidBody, &str)>) -> Result<(), String> {
        if let Some(missing) = (1..=6).find(|number| !found.contains_key(number)) {
            let joint = &self.chain.joints[missing - 1];
            return Err(format!("link '{}', which {} turns, has no mass", shown(&joint.child), joint.key()));
        }
        let mut moving = found.range(1..).map(|(_, (body, _))| body.mass);
        let first = moving.next().unwrap_or_default();
        if moving.all(|mass| mass == first) {
            return Err(format!("all moving links weigh {first} kg, a placeholder"));
        }
        let all: f64 = found.values().map(|(body, _)| body.mass).sum();
        if HEAVIEST < all {
            return Err(format!("together they weigh {all:.0} kg; expected kg, and at most {HEAVIEST} of them"));
        }
        Ok(())
    }
}

/// The body is one.
fn check(name: &str, body: &RigidBody) -> Result<(), String> {
    if body.mass < LEAST_KG {
        return Err(format!("link '{name}' weighs {} kg, a placeholder", body.mass));
    }
    if let Some(fault) = body.inertia_fault().or_else(|| body.size_fault()) {
        return Err(format!("link '{name}': {fault}"));
    }
    Ok(())
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
    let efforts = chain.joints.each_ref().map(|joint| joint.limit.effort);
    if efforts.iter().all(|effort| effort.is_none_or(|effort| effort == 0.0)) {
        return Ok(None);
    }
    let mut found = [0.0; 6];
    for ((torque, joint), effort) in found.iter_mut().zip(&chain.joints).zip(efforts) {
        *torque = effort.ok_or_else(|| format!("{} has none", joint.key()))?;
        if !(TORQUE.min..=TORQUE.max).contains(torque) {
            let [least, most] = [TORQUE.min, TORQUE.max];
            return Err(format!("{} has {torque:e} N m; expected {least} to {most} N m", joint.key()));
        }
    }
    if found == [found[0]; 6] {
        return Err(format!("all joints have {} N m, a placeholder", found[0]));
    }
    Ok(Some(found))
}
