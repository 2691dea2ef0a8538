//! The robot, the zone and the map of an answer, ready to be drawn.

use crate::answer::Unit;
use stiffarm::load::{Direction, Load};
use stiffarm::model::{ArmPosture, Model};
use stiffarm::robot::{Arm, Robot};

use crate::figures::scene::{ForceMark, Scene, ZoneMark};
use crate::figures::view3d::ArmMark;

/// The arm in a posture, seen from its right side, on its base; lengths from the base.
pub(crate) fn scene(model: &Model, posture: Option<ArmPosture>, zone: Option<ZoneMark>) -> Scene {
    let robot = model.robot();
    let mut points = links(model, posture).into_iter();
    Scene {
        axis: points.next().unwrap_or_else(|| robot.axis_2()),
        links: points.collect(),
        link: link(robot),
        base: model.knows_base().then_some([0.0; 2]),
        raised: 0.0,
        zone,
        windows: Vec::new(),
        keep_outs: Vec::new(),
        force: None,
    }
}

/// The force of a map as an arrow, where its direction is known.
pub(crate) fn force(load: Load) -> Option<ForceMark> {
    let (towards, which) = match load.direction() {
        Direction::InPlane(angle) => {
            let (s, c) = angle.sin_cos();
            ([c, s], format!(" at {:.0} deg", Unit::Degree.of_si(angle)))
        }
        // Only what of it lies in the section is seen.
        Direction::Base([x, 0.0, z]) => ([x, z], String::new()),
        Direction::Base(_) | Direction::Worst | Direction::Tool { .. } => return None,
    };
    let length = towards[0].hypot(towards[1]);
    Some(ForceMark {
        towards: towards.map(|part| part / length),
        label: format!("force of {} N{which}", load.newtons()),
    })
}

/// The joint-2 axis and what follows it, forwards and up.
fn links(model: &Model, posture: Option<ArmPosture>) -> Vec<[f64; 2]> {
    match (model, posture) {
        (Model::Planar(model), Some(ArmPosture::Plane(angles))) => model.points(angles).to_vec(),
        (Model::Spatial(_), Some(_)) => {
            let arm = arm(model, posture, None);
            arm.iter().flat_map(|arm| &arm.points).skip(1).map(|([x, _, z], _)| [*x, *z]).collect()
        }
        _ => Vec::new(),
    }
}

/// The arm in space; `shares` is what each drive gives of the deflection.
pub(crate) fn arm(model: &Model, posture: Option<ArmPosture>, shares: Option<&[f64; 6]>) -> Option<ArmMark> {
    match (model, posture?) {
        (Model::Planar(model), ArmPosture::Plane(angles)) => Some(ArmMark::planar(model, angles)),
        (Model::Spatial(model), ArmPosture::Joints(q)) => {
            ArmMark::posed(model.robot(), &q, model.flange_from_tool(), shares)
        }
        (Model::Planar(_), ArmPosture::Joints(_)) | (Model::Spatial(_), ArmPosture::Plane(_)) => None,
    }
}

/// The length of a link, for the size of what is drawn beside it.
fn link(robot: &Robot) -> f64 {
    match &robot.arm {
        Arm::SixAxis { geometry, .. } => f64::midpoint(geometry.c2, geometry.l3()),
        Arm::Planar(arm) => f64::midpoint(arm.l2, arm.l3),
    }
}
