//! How compliant is the paper's planar two-link arm, and what does it reach?

mod ahead;
mod radial;
mod shape;
mod side;
mod support;

use nalgebra::{Matrix2, SymmetricEigen, Vector2};

pub use radial::RadialCompliance;
pub(crate) use shape::Shape;
pub(crate) use side::Rooms;
pub use side::{Elbow, ElbowSide};
pub(crate) use support::support;

use crate::drive::Architecture;
use crate::interval::Interval;

/// Slack on angles (rad) and, per metre of arm, on lengths within which a posture at a limit still counts as reachable.
pub(crate) const SLACK: f64 = 1e-9;

/// No joint is limited farther from zero than this, rad: some thirty turns.
const MOST_TURNED: f64 = 200.0;

/// Two links, two springs: drives 2 and 3 compliant, all else rigid, the tool point at the wrist centre.
///
/// Frame: the joint-2 axis is the origin, x forward, z up; angles counter-clockwise seen with x to the right.
/// `p = l2 e(shoulder) + l3 e(shoulder + elbow)`. Any limits may be combined; all hold at once.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarArm {
    /// Upper arm, m.
    pub l2: f64,
    /// Elbow to wrist centre, m.
    pub l3: f64,
    /// Compliance of drive 2, rad/(N m); 0 where it is rigid, which not both are.
    pub k2: f64,
    /// Compliance of drive 3, rad/(N m); 0 where it is rigid.
    pub k3: f64,
    /// Where drive 3 acts.
    pub architecture: Architecture,
    /// Absolute angle of the upper arm, rad.
    pub shoulder: Interval,
    /// Angle of the forearm relative to the upper arm, rad.
    pub elbow: Interval,
    /// Absolute angle of the forearm, `shoulder + elbow`, rad.
    pub forearm: Interval,
}

/// A planar arm with which nothing can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InvalidArm {
    /// A length or a compliance outside the range in which the model is meant; a compliance may be zero, too.
    #[error("{quantity} is {value:e} {unit}; expected a number from {min:e} to {max:e} {unit}{}", or_rigid(unit))]
    Quantity {
        /// Which one.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// Smallest accepted.
        min: f64,
        /// Largest accepted.
        max: f64,
    },
    /// Nothing gives way in the arm plane.
    #[error(
        "k2 and k3 are both 0, so nothing gives way in the arm plane; give drive 2 or 3 a compliance, or use the spatial model"
    )]
    Rigid,
    /// An end of a limit that is no angle of an arm.
    #[error("the {joint} limit ends at {value:e} rad; expected at most {MOST_TURNED} rad either way, or none")]
    Limit {
        /// Which limit.
        joint: &'static str,
        /// Its end.
        value: f64,
    },
    /// The limits contradict each other.
    #[error("the joint limits leave nothing reachable (shoulder, elbow and forearm ranges share no posture)")]
    NothingReachable,
}

fn or_rigid(unit: &str) -> &'static str {
    if unit == "m" { "" } else { ", or 0 for a rigid drive" }
}

impl PlanarArm {
    /// An arm without limits.
    pub fn free(l2: f64, l3: f64, k2: f64, k3: f64, architecture: Architecture) -> Self {
        Self { l2, l3, k2, k3, architecture, shoulder: Interval::ALL, elbow: Interval::ALL, forearm: Interval::ALL }
    }

    /// The elbow sides that the limits leave.
    ///
    /// # Errors
    /// Where a length or compliance is not a sensible number, or the limits leave nothing.
    pub fn sides(&self) -> Result<Vec<ElbowSide>, InvalidArm> {
        self.check()?;
        let sides = ElbowSide::of(self, 0.0);
        if sides.is_empty() { Err(InvalidArm::NothingReachable) } else { Ok(sides) }
    }

    /// The elbow sides that are left where every limit is narrowed by `limit` at either end and the arm keeps `singular` from stretched and
    /// folded, rad; maybe none.
    pub(crate) fn sides_clear(&self, limit: f64, singular: f64) -> Vec<ElbowSide> {
        let narrowed = || {
            let [shoulder, elbow, forearm] =
                [self.shoulder, self.elbow, self.forearm].map(|range| range.narrowed(limit));
            Some(Self { shoulder: shoulder?, elbow: elbow?, forearm: forearm?, ..self.clone() })
        };
        narrowed().map_or_else(Vec::new, |arm| ElbowSide::of(&arm, singular))
    }

    /// Checks lengths, compliances and limits.
    pub(crate) fn check(&self) -> Result<(), InvalidArm> {
        let quantities = [
            ("l2", self.l2, "m", 1e-3, 100.0),
            ("l3", self.l3, "m", 1e-3, 100.0),
            ("k2", self.k2, "rad/(N m)", 1e-12, 1.0),
            ("k3", self.k3, "rad/(N m)", 1e-12, 1.0),
        ];
        for (quantity, value, unit, min, max) in quantities {
            let is_rigid = value == 0.0 && unit != "m";
            if !(is_rigid || (min <= value && value <= max)) {
                return Err(InvalidArm::Quantity { quantity, value, unit, min, max });
            }
        }
        if self.k2 == 0.0 && self.k3 == 0.0 {
            return Err(InvalidArm::Rigid);
        }
        for (joint, limit) in [("shoulder", self.shoulder), ("elbow", self.elbow), ("forearm", self.forearm)] {
            let ends = [limit.min(), limit.max()];
            if let Some(value) = ends.into_iter().find(|end| end.is_finite() && MOST_TURNED < end.abs()) {
                return Err(InvalidArm::Limit { joint, value });
            }
        }
        Ok(())
    }

    /// The largest compliance as a function of the distance from the joint-2 axis.
    pub fn radial(&self) -> RadialCompliance {
        RadialCompliance::of(self)
    }

    /// Wrist centre, m, at a shoulder and an elbow angle, rad.
    pub fn forward(&self, shoulder: f64, elbow: f64) -> Vector2<f64> {
        let forearm = shoulder + elbow;
        Vector2::new(
            self.l2 * shoulder.cos() + self.l3 * forearm.cos(),
            self.l2 * shoulder.sin() + self.l3 * forearm.sin(),
        )
    }

    /// Joint-2 axis, elbow and wrist centre, m, at a shoulder and an elbow angle, rad.
    pub fn points(&self, shoulder: f64, elbow: f64) -> [[f64; 2]; 3] {
        [[0.0; 2], [self.l2 * shoulder.cos(), self.l2 * shoulder.sin()], self.forward(shoulder, elbow).into()]
    }

    /// What the drives 2 and 3 give of [`Self::compliance`]: the compliance of two springs is the sum of both alone.
    pub fn by_drive(&self, shoulder: f64, elbow: f64) -> [Matrix2<f64>; 2] {
        [[self.k2, 0.0], [0.0, self.k3]].map(|[k2, k3]| Self { k2, k3, ..self.clone() }.compliance(shoulder, elbow))
    }

    /// Cartesian compliance at the wrist centre, m/N, base axes (x, z): `C = (J A) k (J A)^T`.
    ///
    /// `J = [e x p, e x (p - E)]` with the elbow at `E`; no inverse, so every posture has one.
    pub fn compliance(&self, shoulder: f64, elbow: f64) -> Matrix2<f64> {
        let p = self.forward(shoulder, elbow);
        let upper = self.l2 * Vector2::new(shoulder.cos(), shoulder.sin());
        self.compliance_of_links(upper, p - upper)
    }

    /// The same from the two link vectors, m.
    pub(crate) fn compliance_of_links(&self, upper: Vector2<f64>, forearm: Vector2<f64>) -> Matrix2<f64> {
        let turned = |v: Vector2<f64>| Vector2::new(-v.y, v.x);
        let j = Matrix2::from_columns(&[turned(upper + forearm), turned(forearm)]);
        let ja = j * self.architecture.transmission();
        ja * Matrix2::from_diagonal(&Vector2::new(self.k2, self.k3)) * ja.transpose()
    }

    /// Worst-direction compliance, m/N, and the unit direction in which it acts, at a posture.
    pub fn worst_direction(&self, shoulder: f64, elbow: f64) -> (f64, Vector2<f64>) {
        let eigen = SymmetricEigen::new(self.compliance(shoulder, elbow));
        let i = eigen.eigenvalues.imax();
        (eigen.eigenvalues[i], eigen.eigenvectors.column(i).into())
    }
}
