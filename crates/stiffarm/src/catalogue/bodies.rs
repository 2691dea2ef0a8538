//! What does a robot file say of the bodies of its links: radii (`[body]`), or capsules that enclose them (`[[body.link]]`)?

use nalgebra::Vector3;

use super::masses::aside;
use super::reader::{Quantity, Table};
use crate::body::{Body, Capsule, Enclosing};
use crate::geometry::Geometry;
use crate::mass::Carrier;

/// Of a capsule about a link.
const RADIUS: Quantity = Quantity { unit: "mm", min: 5.0, max: 1500.0, suspect: Some((3.0, 1e3, "m")) };
/// Of one of several that enclose a link: small links have thin ones.
const PIECE: Quantity = Quantity { unit: "mm", min: 0.1, max: 1500.0, suspect: None };
const PLACE: Quantity = Quantity { unit: "mm", min: -10_000.0, max: 10_000.0, suspect: None };
const LINK: Quantity = Quantity { unit: "(a link from 0 to 6)", min: 0.0, max: 6.0, suspect: None };
/// The middle of a link lies this near to the line of its link, in parts of the reach of the stretched links.
const ASIDE: f64 = 0.3;
/// The base, and what the joints turn.
const LINKS: usize = 7;

/// Radii of column, upper arm, forearm and wrist, and what encloses the links; the outer `None` is a fault.
pub(super) fn bodies(mut table: Table, geometry: Option<&Geometry>) -> Option<(Option<Body>, Option<Enclosing>)> {
    let links = table.tables("link");
    let radii = if links.is_empty() {
        table.numbers("radius_mm", RADIUS).map(Some)
    } else {
        table.optional_numbers("radius_mm", RADIUS)
    };
    let radii = radii.map(|mm: Option<[f64; 4]>| mm.map(|mm| Body::from(mm.map(|mm| mm / 1e3))));
    let not_compared = not_compared(&mut table);
    let enclosing = if links.is_empty() { Some(None) } else { enclosing(&table, links, geometry).map(Some) };
    if !table.has("link") && table.has("not_compared") {
        table.fault("not_compared", "is of links that capsules enclose; expected [[body.link]] beside it");
    }
    table.finish(&["link"]);
    let (enclosing, not_compared) = (enclosing?, not_compared?);
    Some((radii?, enclosing.map(|links| Enclosing { links, not_compared })))
}

fn not_compared(table: &mut Table) -> Option<Vec<[usize; 2]>> {
    if !table.has("not_compared") {
        return Some(Vec::new());
    }
    let pairs = table.rows("not_compared", &[LINK; 2])?;
    let is_pair = |[a, b]: &[f64; 2]| a.fract() == 0.0 && b.fract() == 0.0 && a < b;
    if let Some([a, b]) = pairs.iter().find(|pair| !is_pair(pair)) {
        table.fault("not_compared", format!("[{a}, {b}]; expected two links from 0 to 6, the lower one first"));
        return None;
    }
    Some(pairs.iter().map(|pair| pair.map(|link| link as usize)).collect())
}

fn enclosing(table: &Table, links: Vec<Table>, geometry: Option<&Geometry>) -> Option<[Vec<Capsule>; LINKS]> {
    let mut found: [Option<Vec<Capsule>>; LINKS] = Default::default();
    let mut are_sound = true;
    for mut link in links {
        let number = link.number("link", LINK).filter(|number| {
            if number.fract() != 0.0 {
                link.fault("link", format!("{number}; expected a link from 0 (the base) to 6"));
            }
            number.fract() == 0.0
        });
        let capsules = link.rows("capsules_mm", &[PLACE, PLACE, PLACE, PLACE, PLACE, PLACE, PIECE]);
        let (Some(number), Some(capsules)) = (number.map(|number| number as usize), capsules) else {
            are_sound = false;
            link.finish(&[]);
            continue;
        };
        let capsules: Vec<Capsule> = capsules.iter().map(capsule).collect();
        if found[number].is_some() {
            link.fault("link", format!("{number} is there twice; expected all its capsules in one table"));
        }
        if let Some(fault) = geometry.and_then(|geometry| misplaced(geometry, number, &capsules)) {
            link.fault("capsules_mm", fault);
        }
        found[number] = Some(capsules);
        link.finish(&[]);
    }
    let missing: Vec<String> = (0..LINKS).filter(|&i| found[i].is_none()).map(|i| i.to_string()).collect();
    if !missing.is_empty() && are_sound {
        let message = format!(
            "capsules of link {} are missing; expected a table of each link from 0 to 6 (capsules_mm = [] of one without a body)",
            missing.join(", ")
        );
        table.fault("link", message);
    }
    let found: Option<Vec<Vec<Capsule>>> = found.into_iter().collect();
    found?.try_into().ok()
}

fn capsule([x1, y1, z1, x2, y2, z2, radius]: &[f64; 7]) -> Capsule {
    Capsule { ends: [Vector3::new(*x1, *y1, *z1) / 1e3, Vector3::new(*x2, *y2, *z2) / 1e3], radius: radius / 1e3 }
}

/// Why these are no capsules of a link: they lie elsewhere, as where they count from the link's own frame.
fn misplaced(geometry: &Geometry, link: usize, capsules: &[Capsule]) -> Option<String> {
    let ends: Vec<Vector3<f64>> = capsules.iter().flat_map(|capsule| capsule.ends).collect();
    if ends.is_empty() {
        return None;
    }
    let middle = ends.iter().sum::<Vector3<f64>>() / ends.len() as f64;
    let carrier = if link == 0 { Carrier::Base } else { Carrier::Link(link) };
    let most = ASIDE * (geometry.a1 + geometry.c2 + geometry.l3());
    let aside = aside(geometry, carrier, &middle);
    (!(aside <= most)).then(|| {
        let [aside, most] = [aside, most].map(|m| m * 1e3);
        format!(
            "their middle lies {aside:.0} mm off the line of link {link}; expected at most {most:.0} mm, counted from the base at model zero (upper arm and forearm upright)"
        )
    })
}
