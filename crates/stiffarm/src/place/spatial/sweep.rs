//! Can the tool sweep a zone in one go?

use std::f64::consts::{FRAC_PI_2, PI};

use super::wrapped;
use crate::inverse::{CLEARANCE, Class, SLACK, postures, third_within_limits};
use crate::robot::{Arm, Robot};
use crate::space::{Grid, Patch, SpatialArm, Stand};

/// A zone swept in one posture.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    /// How far the zone is turned about the joint-1 axis, rad.
    pub(super) bearing: f64,
    /// What the roll must be, rad, where it was free and moved nothing.
    pub(super) roll: f64,
    /// Joint angles as reported, rad, by grid point.
    pub(super) joints: Vec<[f64; 6]>,
    /// Smallest distance to a limit, rad, and its joint from 1; 0 is the angle between the links.
    pub(super) limit_margin: (f64, usize),
    /// Smallest distance to a straight wrist or arm, rad.
    pub(super) singular_margin: f64,
}

/// Follows a class over a grid; `None` where a joint turns too far.
///
/// No joint may turn by a quarter turn or more from its angle at the centre: around a singular posture of the wrist joints
/// 4 and 6 turn by a whole one (and by half a turn straight across it), around the joint-1 axis joint 1 does, so that no
/// such pose lies within. With that, angles are followed without doubt, and every joint's whole interval must fit its
/// range: joint 1 after the zone is turned about its axis, joint 6 after the tool is rolled where that moves nothing.
pub(super) fn sweep(
    robot: &Robot,
    arm: &SpatialArm,
    elevation: f64,
    stand: &Stand,
    grid: &Grid,
    class: Class,
    roll_is_free: bool,
) -> Option<Sweep> {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return None };
    let patch = Patch::of(elevation, stand);
    let flange_from_tool = arm.flange_from_tool.inverse();
    let mut thetas = Vec::with_capacity(grid.points.len());
    for &at in &grid.points {
        let found = postures(geometry, &(patch.pose(stand, at) * flange_from_tool));
        thetas.push(found.found.into_iter().find(|(found, _)| *found == class)?.1);
    }
    // An odd number of rows and columns: the middle one is the centre.
    let centre = thetas[thetas.len() / 2];
    for theta in &mut thetas {
        for (angle, centre) in theta.iter_mut().zip(centre) {
            *angle = centre + wrapped(*angle - centre);
            if FRAC_PI_2 <= (*angle - centre).abs() {
                return None;
            }
        }
    }
    let mut joints: Vec<[f64; 6]> = thetas.iter().map(|theta| geometry.reported(theta, limits.third_axis)).collect();
    let mut limit_margin = (f64::INFINITY, 1);
    let (mut bearing, mut roll) = (0.0, stand.roll);
    for joint in 0..6 {
        let range = limits.joints[joint];
        let low = joints.iter().map(|q| q[joint]).fold(f64::INFINITY, f64::min);
        let high = joints.iter().map(|q| q[joint]).fold(f64::NEG_INFINITY, f64::max);
        let shift = match joint {
            2 if limits.third_is_wound() => {
                let shift = third_within_limits(geometry, limits, &centre)? - joints[joints.len() / 2][2];
                (range.contains(low + shift, SLACK) && range.contains(high + shift, SLACK)).then_some(shift)?
            }
            5 if roll_is_free && range.is_bounded() => {
                (high - low <= range.width() + SLACK).then(|| range.middle() - f64::midpoint(low, high))?
            }
            _ => shift_into(range.min(), range.max(), low, high, joint == 0)?,
        };
        for q in &mut joints {
            q[joint] += shift;
        }
        let turned = wrapped(shift * geometry.sign[joint]);
        match joint {
            0 => bearing = turned,
            5 if roll_is_free => roll = wrapped(roll + turned),
            _ => {}
        }
        let margin = (low + shift - range.min()).min(range.max() - high - shift);
        if margin < limit_margin.0 {
            limit_margin = (margin.max(0.0), joint + 1);
        }
    }
    for theta in &thetas {
        let enclosed = limits.elbow.turn_to(PI - theta[2], SLACK)?;
        let margin = limits.elbow.room(enclosed);
        if margin < limit_margin.0 {
            limit_margin = (margin.max(0.0), 0);
        }
    }
    let singular_margin = thetas.iter().map(|theta| geometry.singular_margin(theta)).fold(f64::INFINITY, f64::min);
    if singular_margin < CLEARANCE - SLACK {
        return None;
    }
    Some(Sweep { bearing, roll, joints, limit_margin, singular_margin })
}

/// What to add to the interval `low..high` so that it lies in `min..max`: whole turns, or, where the angle is `free`, as
/// little as possible. Of several turns the one that leaves most room.
fn shift_into(min: f64, max: f64, low: f64, high: f64, free: bool) -> Option<f64> {
    let (least, most) = (min - SLACK - low, max + SLACK - high);
    if most < least {
        return None;
    }
    if free {
        let nearest = |turns: f64| (turns * 2.0 * PI).clamp(least, most);
        return [0.0, 1.0, -1.0]
            .map(nearest)
            .into_iter()
            .min_by(|a, b| wrapped(*a).abs().total_cmp(&wrapped(*b).abs()));
    }
    if !(least.is_finite() && most.is_finite()) {
        let turns = if least.is_finite() { (least / (2.0 * PI)).ceil() } else { (most / (2.0 * PI)).floor() };
        return Some(if turns.is_finite() { turns * 2.0 * PI } else { 0.0 });
    }
    let middle = (f64::midpoint(least, most) / (2.0 * PI)).round();
    [middle, middle - 1.0, middle + 1.0]
        .map(|turns| turns * 2.0 * PI)
        .into_iter()
        .find(|shift| least <= *shift && *shift <= most)
}
