//! What makes one place better than another: the worst compliance inside the zone.

use nalgebra::Vector2;

use super::boxes::{Node, Spot, Worst};
use super::directed::{self, Directed, Effort};
use crate::load::Sector;
use crate::plane::{Elbow, PlanarArm, RadialCompliance};
use crate::task::Zone;

/// Relative allowance for the rounding of a bound.
const ROUNDING: f64 = 1e-12;

/// From where to where the nearest and the farthest point of a zone lie over a box of places, m from the joint-2 axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distances {
    pub(super) near: [f64; 2],
    pub(super) far: [f64; 2],
}

/// What the compliance at a point depends on.
pub(super) enum Objective {
    /// Its distance from the joint-2 axis: the worst of all directions.
    Radial(RadialCompliance),
    /// Its bearing, too.
    Directed(Directed),
}

impl Objective {
    /// Under forces of a sector, or the worst.
    pub(super) fn new(arm: &PlanarArm, sector: Option<Sector>) -> Self {
        sector.map_or_else(|| Self::Radial(arm.radial()), |sector| Self::Directed(Directed::new(arm, sector)))
    }

    /// Places at one distance are alike, whatever their bearing.
    pub(super) fn is_radial(&self) -> bool {
        matches!(self, Self::Radial(_))
    }

    /// The compliance at a point from the joint-2 axis, m/N.
    pub(super) fn at(&self, elbow: Elbow, point: Vector2<f64>) -> f64 {
        match self {
            Self::Radial(sigma) => sigma.at(point.norm()),
            Self::Directed(directed) => directed.at(elbow, point),
        }
    }

    /// The worst of a zone at a place where it is reached throughout, or one point that is not below `upper`, m/N.
    pub(super) fn worst(
        &self,
        elbow: Elbow,
        zone: Zone,
        spot: &Spot,
        upper: f64,
        effort: Effort,
    ) -> Result<Worst, Worst> {
        let worst = match self {
            Self::Radial(sigma) => {
                let shape = zone.shape(spot.centre);
                let of = |point: Vector2<f64>| Worst { compliance: sigma.at(point.norm()), point };
                let (near, far) = (of(shape.nearest()), of(shape.farthest()));
                if near.compliance <= far.compliance { far } else { near }
            }
            Self::Directed(directed) => directed.worst(elbow, zone, spot, upper, effort)?,
        };
        if worst.compliance < upper { Ok(worst) } else { Err(worst) }
    }

    /// Points of a zone, from its centre, at which the places of a box are compared.
    pub(super) fn samples(&self, zone: Zone) -> Vec<Vector2<f64>> {
        match self {
            Self::Radial(_) => Vec::new(),
            Self::Directed(_) => directed::points(zone),
        }
    }

    /// A lower bound on the worst of every place in a box by what is known of the distances alone, m/N.
    pub(super) fn least_by_distance(&self, Distances { near, far }: &Distances) -> f64 {
        match self {
            Self::Radial(sigma) => sigma.least(near[0], near[1]).max(sigma.least(far[0], far[1])) * (1.0 - ROUNDING),
            Self::Directed(_) => 0.0,
        }
    }

    /// The same with what else is known.
    pub(super) fn least(&self, by_distance: f64, elbow: Elbow, node: &Node, samples: &[Vector2<f64>]) -> f64 {
        match self {
            Self::Radial(_) => by_distance,
            Self::Directed(directed) => directed.least(elbow, node, samples),
        }
    }
}
