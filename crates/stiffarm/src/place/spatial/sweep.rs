//! Can the tool sweep a zone in one go?

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Question, wrapped};
use crate::interval::Interval;
use crate::inverse::{CLEARANCE, Configuration, SLACK, postures, third_within_limits};
use crate::limits::ThirdAxis;
use crate::robot::{Arm, Robot};
use crate::space::{Angles, Follower, Grid, Patch, SpatialArm, Stand};
use crate::task::Zone;

/// A zone swept in one posture.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    /// How far the zone is turned about the joint-1 axis, rad.
    pub(super) bearing: f64,
    /// What the roll must be, rad, where it was free and moved nothing.
    pub(super) roll: f64,
    /// Joint angles as reported, rad, by grid point.
    pub(super) joints: Vec<[f64; 6]>,
    /// Smallest distance to a limit anywhere in the zone, rad, and its joint from 1; 0 is the angle between the links.
    pub(super) limit_margin: (f64, usize),
    /// Smallest distance to a straight wrist or arm anywhere in the zone, rad.
    pub(super) singular_margin: f64,
}

/// Why a zone is not swept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unswept {
    /// A pose is out of reach, a joint turns too far, or passes a singular posture.
    Impossible,
    /// All samples keep the limits; between them one is overstepped, rad, or a singular posture lies too near.
    Oversteps(f64),
}

/// Follows a class over a grid, and proves that every limit is kept everywhere in the zone.
///
/// No joint may turn by a quarter turn or more from its angle at the centre: around a singular posture of the wrist joints
/// 4 and 6 turn by a whole one (and by half a turn straight across it), around the joint-1 axis joint 1 does, so that no
/// such pose lies within. With that, angles are followed without doubt, and every joint's whole interval must fit its
/// range: joint 1 after the zone is turned about its axis, joint 6 after the tool is rolled where that moves nothing.
pub(super) fn sweep(
    robot: &Robot,
    arm: &SpatialArm,
    asked: &Question,
    zone: Zone,
    stand: &Stand,
    grid: &Grid,
    class: Configuration,
) -> Result<Sweep, Unswept> {
    let impossible = Unswept::Impossible;
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return Err(impossible) };
    let roll_is_free = asked.roll.is_none() && arm.tool_turns_about_axis_6();
    let patch = Patch::of(asked.elevation, stand);
    let flange_from_tool = arm.flange_from_tool.inverse();
    let mut thetas = Vec::with_capacity(grid.points.len());
    for &at in &grid.points {
        let found = postures(geometry, &(patch.pose(stand, at) * flange_from_tool)).found;
        thetas.push(found.into_iter().find(|(found, _)| *found == class).ok_or(impossible)?.1);
    }
    // An odd number of rows and columns: the middle one is the centre.
    let centre = thetas[thetas.len() / 2];
    for theta in &mut thetas {
        for (angle, centre) in theta.iter_mut().zip(centre) {
            *angle = centre + wrapped(*angle - centre);
            if FRAC_PI_2 <= (*angle - centre).abs() {
                return Err(impossible);
            }
        }
    }
    let follower = Follower::new(arm, asked.elevation, stand, zone, class, &centre);
    let reported = |angles: &Angles| -> [Interval; 6] {
        std::array::from_fn(|i| {
            let forearm = i == 2 && limits.third_axis == ThirdAxis::Forearm;
            let model = angles[if forearm { 6 } else { i }];
            model.affine(geometry.sign[i], geometry.sign[i] * geometry.offset[i])
        })
    };
    let mut joints: Vec<[f64; 6]> = thetas.iter().map(|theta| geometry.reported(theta, limits.third_axis)).collect();
    let mut least = (f64::INFINITY, 1);
    let (mut bearing, mut roll, mut shifts) = (0.0, stand.roll, [0.0; 6]);
    for joint in 0..6 {
        let range = limits.joints[joint];
        let low = joints.iter().map(|q| q[joint]).fold(f64::INFINITY, f64::min);
        let high = joints.iter().map(|q| q[joint]).fold(f64::NEG_INFINITY, f64::max);
        let shift = match joint {
            2 if limits.third_is_wound() => {
                let third = third_within_limits(geometry, limits, &centre).ok_or(impossible)?;
                let shift = third - joints[joints.len() / 2][2];
                (range.contains(low + shift, SLACK) && range.contains(high + shift, SLACK)).then_some(shift)
            }
            5 if roll_is_free && range.is_bounded() => {
                (high - low <= range.width() + SLACK).then(|| range.middle() - f64::midpoint(low, high))
            }
            _ => shift_into(range.min(), range.max(), low, high, joint == 0),
        };
        let shift = shift.ok_or(impossible)?;
        for q in &mut joints {
            q[joint] += shift;
        }
        shifts[joint] = shift;
        let turned = wrapped(shift * geometry.sign[joint]);
        match joint {
            0 => bearing = turned,
            5 if roll_is_free => roll = wrapped(roll + turned),
            _ => {}
        }
        let margin = (low + shift - range.min()).min(range.max() - high - shift);
        if margin < least.0 {
            least = (margin, joint + 1);
        }
    }
    for theta in &thetas {
        let enclosed = limits.elbow.turn_to(PI - theta[2], SLACK).ok_or(impossible)?;
        let margin = limits.elbow.room(enclosed);
        if margin < least.0 {
            least = (margin, 0);
        }
    }
    let straight = |angles: &Angles| to_a_line(angles[4]).min(to_a_line(angles[2].affine(1.0, geometry.lean())));
    let singular_margin = follower.least(f64::INFINITY, straight);
    if !(CLEARANCE - SLACK <= singular_margin && follower.turns_less_than_a_quarter()) {
        return Err(Unswept::Oversteps(CLEARANCE));
    }
    let elbow_turns = limits.elbow.turn_to(PI - centre[2], SLACK).ok_or(impossible)? - (PI - centre[2]);
    let room = |angles: &Angles| {
        let elbow = inside(limits.elbow, angles[2].affine(-1.0, PI + elbow_turns));
        let joints = reported(angles).into_iter().zip(shifts).zip(limits.joints);
        joints.map(|((q, shift), range)| inside(range, q.affine(1.0, shift))).fold(elbow, f64::min)
    };
    let margin = follower.least(f64::INFINITY, room);
    if margin < -SLACK {
        return Err(Unswept::Oversteps((-margin).min(CLEARANCE)));
    }
    Ok(Sweep { bearing, roll, joints, limit_margin: (margin.max(0.0), least.1), singular_margin })
}

/// How far a range keeps from the ends of another.
fn inside(range: Interval, part: Interval) -> f64 {
    (part.min() - range.min()).min(range.max() - part.max())
}

/// The smallest of the angles between a range of angles and half turns.
fn to_a_line(angles: Interval) -> f64 {
    let turned = angles.affine(1.0, -(angles.middle() / PI).floor() * PI);
    turned.min().min(PI - turned.max())
}

/// What to add to the interval `low..high` so that it lies in `min..max`: whole turns, or, where the angle is `free`, as
/// little as possible. Of several turns the one that leaves most room.
fn shift_into(min: f64, max: f64, low: f64, high: f64, free: bool) -> Option<f64> {
    // Where nothing else decides, the angle keeps clear of its limits by more than it turns between two samples.
    let slack = if free { -CLEARANCE } else { SLACK };
    let (least, most) = (min - slack - low, max + slack - high);
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
