//! The robot, the zone and the section of an answer in space, ready to be drawn.

use stiffarm::map::{SectionOptions, Spacing, reached_section};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;

use crate::failure::Failure;
use crate::figures::scene::{Scene, ZoneMark};
use crate::figures::view3d::ArmMark;

/// The section over everything that is reached; `None` where that is nothing.
pub(super) fn over_everything(
    robot: &Robot,
    asked: &SectionOptions,
    spacing: Spacing,
) -> Result<Option<SectionOptions>, Failure> {
    let failure = |error| Failure::Map { robot: robot.name.clone(), error };
    let Some(reached) = reached_section(robot, asked).map_err(failure)? else { return Ok(None) };
    let [x, z] = spacing.cover(reached);
    Ok(Some(SectionOptions { x, z, ..*asked }))
}

/// The arm at joint angles as reported, rad, seen from its right side, on its base.
pub(super) fn scene(robot: &Robot, joints: Option<&[f64; 6]>, tool: &Pose, zone: Option<ZoneMark>) -> Scene {
    let link = match &robot.arm {
        Arm::SixAxis { geometry, .. } => f64::midpoint(geometry.c2, geometry.l3()),
        Arm::Planar(arm) => f64::midpoint(arm.l2, arm.l3),
    };
    let arm = joints.and_then(|q| ArmMark::posed(robot, q, tool, None));
    let mut points = arm.iter().flat_map(|arm| &arm.points).skip(1).map(|([x, _, z], _)| [*x, *z]);
    Scene {
        axis: points.next().unwrap_or_else(|| robot.axis_2()),
        links: points.collect(),
        link,
        base: Some([0.0; 2]),
        zone,
    }
}
