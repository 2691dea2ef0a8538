//! What holds at all placements of the work in a box at once?
//!
//! Affine forms ([`Affine`]) carry through the kinematics how every quantity depends on the placement, and how far it can be
//! from that. A node of the branch and bound gets lower bounds on the compliance and conditions under which its poses are
//! held ([`ArmEnclosure::add_constraints`]); `dual_bound` combines them into one bound. The same enclosures tell how far
//! joints turn within a zone ([`ArmEnclosure::angles`]).

mod affine;
mod arm;
mod bounds;
mod compliance;
mod continuity;
mod dual_bound;
mod links;
mod node;
mod over_zone;
mod prepared;

pub(crate) use affine::{Affine, Vector, sin_cos, sum};
pub(crate) use arm::Angles;
pub(crate) use bounds::NodeBounds;
pub(crate) use compliance::add_squares;
pub(crate) use continuity::TurnExtent;
pub(crate) use dual_bound::{Line, least_largest, remaining};
pub(crate) use node::{Node, middle, variables};
pub(crate) use over_zone::least_over;
pub(crate) use prepared::{ArmEnclosure, PushEnclosure, ToolFrameEnclosure};
