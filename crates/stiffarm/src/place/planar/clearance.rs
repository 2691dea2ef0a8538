//! How near do the two links come to the floor and the column, over the poses of an answer?

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Vector2, Vector3};

use super::turned;
use crate::clearance::{Clearance, Solid, Surroundings, ThickArm};
use crate::model::PlanarModel;
use crate::place::Placement;
use crate::robot::Arm;
use crate::task::Zone;
use crate::work::Grid;

/// Poses along the shorter side of the zone, but one.
const CELLS: usize = 8;

/// The nearest over poses that cover the zone; what is machined lies in the arm plane and is compared with the column alone.
pub(in crate::place) fn clearance(
    model: &PlanarModel,
    zone: Zone,
    found: &Placement,
    floor: Option<f64>,
) -> Option<Clearance> {
    let thick = ThickArm::to_wrist(model.robot())?;
    let Arm::SixAxis { geometry, .. } = &model.robot().arm else { return None };
    let side = |p: Vector2<f64>| {
        let mut sides = model.sides.iter().filter(|side| side.elbow == found.elbow);
        sides.find_map(|side| side.posture(p))
    };
    let [x, z] = found.centre;
    let [ahead, up] = model.axis_from_base;
    let centre = Vector2::new(x - ahead, z - up);
    let postures = Grid::of(zone, CELLS).points.into_iter().filter_map(|at| {
        let (shoulder, elbow) = side(centre + turned(at.into(), found.angle))?;
        Some([0.0, FRAC_PI_2 - shoulder, -elbow - geometry.lean(), 0.0, 0.0, 0.0])
    });
    let middle = Vector3::new(x, model.aside(), z);
    let first = Vector3::new(found.angle.cos(), 0.0, found.angle.sin());
    let about =
        Surroundings { work: Some(Solid::sheet(zone, middle, first, Vector3::y())), ..Surroundings::above(floor) };
    thick.clearance(&postures.collect::<Vec<_>>(), &about)
}
