//! What does each body of an arm weigh, where, and how hard is it to turn?
//!
//! Bodies are stated as a robot file states them: at model zero (all model angles zero: upper arm and forearm upright), in the base's
//! axes, from the base. From there [`Geometry::links`] carries them.

mod gravity;
mod matrix;

use nalgebra::{Matrix3, Point3, Vector3};

use crate::geometry::Geometry;
use crate::spatial::Pose;

pub use gravity::{GRAVITY, gravity_torques};
pub use matrix::mass_matrix;
pub(crate) use matrix::{LinkDirections, inertia_of};

/// The least that a body weighs, kg: descriptions have less where they know nothing.
pub const LEAST_KG: f64 = 1e-3;
/// Rounding of what is published: the triangle inequality may be missed by this share of the largest principal moment.
const SLACK: f64 = 1e-3;
/// No body of a kilogram or more has a radius of gyration as small as this, m: a ball of 1 kg of steel has 0.02.
const SMALLEST: f64 = 0.005;
/// And no part of an arm one as large as this, m: a rod of 3 m has 0.9.
const LARGEST: f64 = 2.0;

/// Mass, its centre and the inertia about that centre, in the axes of some frame, which whoever holds it names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody {
    /// kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub centre: Vector3<f64>,
    /// About the centre, kg m^2; matrix elements (`ixy` is minus the product of inertia), as URDF has them.
    pub inertia: Matrix3<f64>,
}

/// What a body moves with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// It stands with the base and does not move.
    Base,
    /// The link that this joint, from 1 to 6, turns.
    Link(usize),
    /// The rod of a parallelogram, which stays parallel to the upper arm.
    Rod {
        /// From the joint-2 axis to the end of the rod on the crank, forwards and up at model zero, m.
        crank: [f64; 2],
    },
    /// The crank that drive 3 turns about the joint-2 axis, with what is fixed to it: it turns as the forearm does.
    Counterweight,
}

impl std::fmt::Display for Carrier {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Base => f.pad("base"),
            Self::Link(link) => f.pad(&format!("link {link}")),
            Self::Rod { .. } => f.pad("rod"),
            Self::Counterweight => f.pad("counterweight"),
        }
    }
}

/// A body of an arm, at model zero, base axes, from the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// What it moves with.
    pub carrier: Carrier,
    /// What it weighs.
    pub body: RigidBody,
}

/// What is known of the weight of what the arm holds, where it is held against what the robot may carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolWeight {
    /// kg.
    pub mass: f64,
    /// Its centre in the flange frame, m, where that is given.
    pub centre: Option<Vector3<f64>>,
}

/// Which links, from 1 to 6, have no mass.
pub fn links_without(masses: &[Mass]) -> Vec<usize> {
    let has = |link: &usize| masses.iter().any(|mass| mass.carrier == Carrier::Link(*link));
    (1..=6).filter(|link| !has(link)).collect()
}

/// Of what an arm has no mass, so that nobody knows its weight: links, and of a parallelogram rod and counterweight; `None` where all is there.
pub fn missing_for_weight(is_parallelogram: bool, masses: &[Mass]) -> Option<String> {
    let has = |of: fn(&Carrier) -> bool| masses.iter().any(|mass| of(&mass.carrier));
    let links = links_without(masses).into_iter().map(|link| format!("link {link}"));
    let mut missing: Vec<String> = links.collect();
    if is_parallelogram {
        missing.extend((!has(|carrier| matches!(carrier, Carrier::Rod { .. }))).then(|| "the rod".into()));
        missing.extend((!has(|carrier| *carrier == Carrier::Counterweight)).then(|| "the counterweight".into()));
    }
    (!missing.is_empty()).then(|| missing.join(", "))
}

impl Mass {
    /// What is held at the flange: a body in the axes of the flange, from its centre.
    pub fn held(geometry: &Geometry, body: &RigidBody) -> Self {
        Self { carrier: Carrier::Link(6), body: body.seen_from(&geometry.forward(&[0.0; 6])) }
    }
}

impl RigidBody {
    /// From the six elements `ixx, ixy, ixz, iyy, iyz, izz`, kg m^2.
    pub fn new(mass: f64, centre: Vector3<f64>, [xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Self {
        Self { mass, centre, inertia: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) }
    }

    /// A mass without extent.
    pub fn point(mass: f64, centre: Vector3<f64>) -> Self {
        Self { mass, centre, inertia: Matrix3::zeros() }
    }

    /// The six elements `ixx, ixy, ixz, iyy, iyz, izz`, kg m^2.
    pub fn elements(&self) -> [f64; 6] {
        let i = &self.inertia;
        [i[(0, 0)], i[(0, 1)], i[(0, 2)], i[(1, 1)], i[(1, 2)], i[(2, 2)]]
    }

    /// The same body in the axes of another frame, in which its own frame is `pose`.
    #[must_use]
    pub fn seen_from(&self, pose: &Pose) -> Self {
        let turn = pose.rotation.to_rotation_matrix();
        Self {
            mass: self.mass,
            centre: (pose * Point3::from(self.centre)).coords,
            inertia: turn.matrix() * self.inertia * turn.matrix().transpose(),
        }
    }

    /// Two bodies as one, in the same axes: the inertia of each about the common centre by Steiner's theorem.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        let centre = (self.centre * self.mass + other.centre * other.mass) / mass;
        let about = |body: &Self| {
            let d = body.centre - centre;
            body.inertia + body.mass * (Matrix3::identity() * d.norm_squared() - d * d.transpose())
        };
        Self { mass, centre, inertia: about(self) + about(other) }
    }

    /// Why no body has this inertia: a principal moment is no larger than the sum of the other two, and none is negative.
    ///
    /// `I1 + I2 - I3 = 2 int r3^2 dm >= 0` for the coordinates `r` along the principal axes.
    pub fn inertia_fault(&self) -> Option<String> {
        let mut moments: [f64; 3] = self.inertia.symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        let [least, middle, largest] = moments;
        let slack = SLACK * largest;
        // Written so that a moment that is no number fails.
        if -slack <= least && largest <= least + middle + slack {
            return None;
        }
        Some(format!(
            "no body has this inertia: its principal moments are {least:.4}, {middle:.4} and {largest:.4} kg m^2; expected none negative, and each at most the sum of the other two"
        ))
    }

    /// Why no part of an arm has this inertia beside its mass, by its radius of gyration.
    pub fn size_fault(&self) -> Option<String> {
        let largest = self.inertia.symmetric_eigenvalues().max();
        let gyration = (largest / self.mass).sqrt();
        let is_sized = gyration <= LARGEST && (self.mass < 1.0 || SMALLEST <= gyration);
        (!is_sized).then(|| {
            format!(
                "{largest} kg m2 at most beside {} kg is a radius of gyration of {gyration:.4} m; expected {SMALLEST} to {LARGEST} m",
                self.mass
            )
        })
    }
}

#[cfg(test)]
mod tests;
