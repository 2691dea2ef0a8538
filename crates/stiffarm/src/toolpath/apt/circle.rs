//! Which arc does `CIRCLE/` mean? Its axis does not say it: programs differ in the sense in which it turns.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Isometry3, Point3, Vector3};

use super::super::closing::Closing;
use super::super::fault::Wrong;
use super::super::moves::Arc;
use super::super::options::ArcSense;
use super::statement::{Part, Statement};

/// Beyond this cosine a path goes on, or back.
const SAME_WAY: f64 = 0.9;

/// An arc whose end comes in the next `GOTO`.
#[derive(Clone, Debug)]
pub(super) struct Circle {
    centre: Vector3<f64>,
    axis: Vector3<f64>,
    radius: Option<f64>,
    /// What a statement says by its name.
    sense: Option<ArcSense>,
}

impl Circle {
    /// Reads `CIRCLE/x,y,z,i,j,k[,r,...]`.
    ///
    /// # Errors
    /// What is missing, or an axis of no length; several turns.
    pub(super) fn of(statement: &Statement, part_from_coordinates: &Isometry3<f64>, unit: f64) -> Result<Self, Wrong> {
        let name = &statement.name;
        if statement.words().any(|word| word == "TIMES") {
            return Err(Wrong::new(
                name,
                "TIMES: how many turns it means is not known for certain; let the CAM write lines",
            ));
        }
        let mut numbers = Vec::new();
        for part in &statement.parts {
            match part {
                Part::Number(number) if number.abs() <= 1e9 => numbers.push(*number),
                // MOVARC tells the angle behind this word; the GOTO to its end says the same.
                Part::Word(word) if word == "ANGLE" && name == "MOVARC" => break,
                part => return Err(Wrong::new(name, format!("{part:?} is no number that makes sense"))),
            }
        }
        if numbers.len() < 6 {
            return Err(Wrong::new(name, format!("{} numbers; expected a centre and an axis", numbers.len())));
        }
        let vector = |at: usize| Vector3::new(numbers[at], numbers[at + 1], numbers[at + 2]);
        let axis = vector(3).try_normalize(1e-6).ok_or_else(|| Wrong::new(name, "its axis is zero"))?;
        Ok(Self {
            centre: (part_from_coordinates * Point3::from(vector(0) * unit)).coords,
            axis: part_from_coordinates.rotation * axis,
            radius: numbers.get(6).map(|radius| radius * unit),
            sense: (name == "MOVARC").then_some(ArcSense::RightHand),
        })
    }

    /// The arc between two points, by how much it misses one radius, m, and what was taken for its sense.
    ///
    /// # Errors
    /// Where it does not close, or turns back against the move before it, or nothing says its sense.
    pub(super) fn arc(
        &self,
        from: &Vector3<f64>,
        to: &Vector3<f64>,
        tangent: Option<Vector3<f64>>,
        asked: Option<ArcSense>,
        by_dialect: Option<ArcSense>,
    ) -> Result<(Arc, f64, &'static str), Wrong> {
        let wrong = |why: String| Wrong::new("CIRCLE", why);
        let across = |p: &Vector3<f64>| {
            let r = p - self.centre;
            r - r.dot(&self.axis) * self.axis
        };
        let (start, end) = (across(from), across(to));
        let radii = [start.norm(), end.norm(), self.radius.unwrap_or(start.norm())];
        let miss = radii.iter().fold(0.0_f64, |most, radius| most.max((radius - radii[0]).abs()));
        // Files with fewer decimals than two of a millimetre are rare.
        let closing = Closing::of_decimals(1e-3, 2, 2);
        if !(closing.holds(miss, radii[0].max(radii[1])) && 1e-9 < radii[0]) {
            let [a, b, said] = radii.map(|radius| radius * 1e3);
            let why = format!(
                "the arc does not close: its radius is {a:.4} mm at its beginning and {b:.4} mm at its end, stated as {said:.4} mm"
            );
            return Err(wrong(why));
        }
        let right = self.axis.cross(&start).normalize();
        let goes_on = tangent.map_or(0.0, |tangent| tangent.dot(&right));
        let by_tangent = match goes_on {
            x if SAME_WAY < x => Some(ArcSense::RightHand),
            x if x < -SAME_WAY => Some(ArcSense::LeftHand),
            _ => None,
        };
        let is_full = (end - start).norm() <= 1e-9;
        let sweep = |sense: ArcSense| {
            let normal = if sense == ArcSense::RightHand { self.axis } else { -self.axis };
            let turned = normal.dot(&start.cross(&end)).atan2(start.dot(&end)).rem_euclid(TAU);
            (normal, if is_full { TAU } else { turned })
        };
        // A cutter that cleans a corner turns back in a short arc; the other sense would sweep over most of a turn.
        let cleans_corner = |sense: ArcSense| sweep(sense).1 < FRAC_PI_2;
        let (sense, note) = match (asked, self.sense.or(by_dialect), by_tangent) {
            (Some(asked), _, _) => (
                asked,
                if asked == ArcSense::LeftHand {
                    "arcs turn clockwise about their axis, as was said"
                } else {
                    "arcs turn counter-clockwise about their axis, as was said"
                },
            ),
            (None, Some(known), Some(seen)) if known != seen && !cleans_corner(known) => {
                let why = "turned as the program that wrote the file turns arcs, it goes back against the move before it; say arc-sense left or right";
                return Err(wrong(why.into()));
            }
            (None, Some(ArcSense::LeftHand), _) => {
                (ArcSense::LeftHand, "arcs turn clockwise about their axis, as Siemens NX writes them")
            }
            (None, Some(ArcSense::RightHand), _) => {
                (ArcSense::RightHand, "arcs turn counter-clockwise about their axis, as SOLIDWORKS CAM writes them")
            }
            (None, None, Some(ArcSense::LeftHand)) => {
                (ArcSense::LeftHand, "arcs turn clockwise about their axis: so they go on from the moves before them")
            }
            (None, None, Some(ArcSense::RightHand)) => (
                ArcSense::RightHand,
                "arcs turn counter-clockwise about their axis: so they go on from the moves before them",
            ),
            (None, None, None) => {
                let why = "in which sense it turns is not in the file, which no known program wrote; say arc-sense left or right";
                return Err(wrong(why.into()));
            }
        };
        let (normal, angle) = sweep(sense);
        Ok((Arc { centre: self.centre, normal, angle }, miss, note))
    }
}
