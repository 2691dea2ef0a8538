//! Does the tool reach all of a zone in one configuration, no joint passing a limit or a singular posture on the way?

mod zone;

use std::f64::consts::{FRAC_PI_2, PI};

use crate::angle::wrapped;
use crate::batch::SpatialArm;
use crate::enclose::Angles;
use crate::interval::Interval;
use crate::inverse::{Configuration, posture_of, third_within_limits};
use crate::limits::ThirdAxis;
use crate::task::Zone;
use crate::tolerances::{CLEARANCE, LIMIT};
use crate::work::{Grid, WorkPlacement, WorkPlane};
use zone::HeldZone;

/// A zone at its place, to be followed in one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedZone<'a> {
    /// With all its limits.
    pub(crate) arm: &'a SpatialArm,
    /// Angle of the tool axis above the horizontal, rad.
    pub(crate) elevation: f64,
    pub(crate) zone: Zone,
    pub(crate) work: WorkPlacement,
    pub(crate) configuration: Configuration,
    /// Any roll will do, and rolling the tool turns joint 6 and nothing else.
    pub(crate) roll_is_free: bool,
}

/// A zone followed in one configuration.
#[derive(Clone, Debug)]
pub(crate) struct Followed {
    /// By how much the zone is turned about the joint-1 axis, rad.
    pub(crate) bearing: f64,
    /// The roll, rad: another than that of the placement only where it is free.
    pub(crate) roll: f64,
    /// Joint angles as reported, rad, by grid point.
    pub(crate) joints: Vec<[f64; 6]>,
    /// Smallest distance to a limit anywhere in the zone, rad, and its joint from 1; 0 is the angle between the links.
    pub(crate) limit_margin: (f64, usize),
    /// Smallest distance to a straight wrist or arm anywhere in the zone, rad.
    pub(crate) singular_margin: f64,
}

/// Why a zone is not followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NotFollowed {
    /// A pose is out of reach, a joint turns too far, or passes a singular posture.
    Impossible,
    /// All samples keep the limits; between them one is overstepped by this much, rad, or a singular posture lies too near.
    Oversteps(f64),
}

/// The samples of a zone, each joint turned into its limits.
struct Shifted {
    /// Joint angles as reported, rad, by grid point.
    joints: Vec<[f64; 6]>,
    /// What was added to each joint.
    shifts: [f64; 6],
    bearing: f64,
    roll: f64,
    /// The joint, from 1, that a sample brings nearest to its limit; 0 is the angle between the links.
    nearest: usize,
}

impl PlacedZone<'_> {
    /// Follows the configuration over a grid, and proves that every limit is kept everywhere in the zone.
    ///
    /// No joint may turn by a quarter turn or more from its angle at the centre. Near a singular posture of the wrist joints 4
    /// and 6 turn by a whole turn around it and by half a turn straight across it, near the joint-1 axis joint 1 does; so no such
    /// pose lies in the zone, and from the centre every joint is followed without doubt. Its whole interval must then fit its
    /// range: that of joint 1 after the zone is turned about its axis, that of joint 6 after the tool is rolled where the
    /// roll is free.
    pub(crate) fn follow(&self, grid: &Grid) -> Result<Followed, NotFollowed> {
        let impossible = NotFollowed::Impossible;
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let thetas = self.samples(grid)?;
        let centre = thetas[thetas.len() / 2];
        let held_zone = HeldZone::new(self.arm, self.elevation, &self.work, self.zone, self.configuration, &centre);
        let Shifted { joints, shifts, bearing, roll, nearest } = self.shifted(&thetas)?;
        let straight = |angles: &Angles| to_a_line(angles[4]).min(to_a_line(angles[2].affine(1.0, geometry.lean())));
        // Counted from the margin, near which it is enclosed most finely.
        let clear = self.arm.clearance;
        let beyond = held_zone.least(f64::INFINITY, |angles| straight(angles) - clear);
        if !held_zone.turns_less_than_a_quarter() {
            return Err(NotFollowed::Oversteps(CLEARANCE));
        }
        if !(-LIMIT <= beyond) {
            return Err(NotFollowed::Oversteps((-beyond).min(CLEARANCE)));
        }
        let singular_margin = clear + beyond;
        let elbow_turns = limits.elbow.turn_to(PI - centre[2], LIMIT).ok_or(impossible)? - (PI - centre[2]);
        let room = |angles: &Angles| {
            let elbow = inside(limits.elbow, angles[2].affine(-1.0, PI + elbow_turns));
            let joints = self.reported(angles).into_iter().zip(shifts).zip(limits.joints);
            joints.map(|((q, shift), range)| inside(range, q.affine(1.0, shift))).fold(elbow, f64::min)
        };
        let margin = held_zone.least(f64::INFINITY, room);
        if margin < -LIMIT {
            return Err(NotFollowed::Oversteps((-margin).min(CLEARANCE)));
        }
        Ok(Followed { bearing, roll, joints, limit_margin: (margin.max(0.0), nearest), singular_margin })
    }

    /// The model angles at every grid point, followed from the centre.
    fn samples(&self, grid: &Grid) -> Result<Vec<[f64; 6]>, NotFollowed> {
        let impossible = NotFollowed::Impossible;
        let plane = WorkPlane::of(self.elevation, &self.work);
        let tool_from_flange = self.arm.flange_from_tool.inverse();
        let mut thetas = Vec::with_capacity(grid.points.len());
        for &at in &grid.points {
            let flange = plane.pose(&self.work, at) * tool_from_flange;
            thetas.push(posture_of(&self.arm.geometry, &flange, self.configuration).ok_or(impossible)?);
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
        Ok(thetas)
    }

    /// What the robot reports of model angles, whole turns left as they are.
    fn reported(&self, angles: &Angles) -> [Interval; 6] {
        let geometry = &self.arm.geometry;
        std::array::from_fn(|i| {
            let forearm = i == 2 && self.arm.limits.third_axis == ThirdAxis::Forearm;
            let model = angles[if forearm { 6 } else { i }];
            model.affine(geometry.sign[i], geometry.sign[i] * geometry.offset[i])
        })
    }

    /// Turns every joint into its limits, the same for all samples.
    fn shifted(&self, thetas: &[[f64; 6]]) -> Result<Shifted, NotFollowed> {
        let impossible = NotFollowed::Impossible;
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let mut joints: Vec<[f64; 6]> =
            thetas.iter().map(|theta| geometry.reported(theta, limits.third_axis)).collect();
        let mut least = (f64::INFINITY, 1);
        let (mut bearing, mut roll, mut shifts) = (0.0, self.work.roll, [0.0; 6]);
        for joint in 0..6 {
            let range = limits.joints[joint];
            let low = joints.iter().map(|q| q[joint]).fold(f64::INFINITY, f64::min);
            let high = joints.iter().map(|q| q[joint]).fold(f64::NEG_INFINITY, f64::max);
            let centre = (&thetas[thetas.len() / 2], joints[joints.len() / 2][joint]);
            let shift = self.shift(joint, [low, high], centre).ok_or(impossible)?;
            for q in &mut joints {
                q[joint] += shift;
            }
            shifts[joint] = shift;
            let turned = wrapped(shift * geometry.sign[joint]);
            match joint {
                0 => bearing = turned,
                5 if self.roll_is_free => roll = wrapped(roll + turned),
                _ => {}
            }
            let margin = (low + shift - range.min()).min(range.max() - high - shift);
            if margin < least.0 {
                least = (margin, joint + 1);
            }
        }
        for theta in thetas {
            let enclosed = limits.elbow.turn_to(PI - theta[2], LIMIT).ok_or(impossible)?;
            let margin = limits.elbow.room(enclosed);
            if margin < least.0 {
                least = (margin, 0);
            }
        }
        Ok(Shifted { joints, shifts, bearing, roll, nearest: least.1 })
    }

    /// What to add to a joint that runs from `low` to `high` as reported; `None` where its range has no room for that. At the
    /// centre of the zone the model angles are `theta`, and the joint reports `q`.
    fn shift(&self, joint: usize, [low, high]: [f64; 2], (theta, q): (&[f64; 6], f64)) -> Option<f64> {
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let range = limits.joints[joint];
        match joint {
            2 if limits.third_is_wound() => {
                let shift = third_within_limits(geometry, limits, theta)? - q;
                (range.contains(low + shift, LIMIT) && range.contains(high + shift, LIMIT)).then_some(shift)
            }
            5 if self.roll_is_free && range.is_bounded() => {
                (high - low <= range.width() + LIMIT).then(|| range.middle() - f64::midpoint(low, high))
            }
            _ => shift_into(range.min(), range.max(), low, high, joint == 0),
        }
    }
}

/// The smallest distance of a part from the ends of its range, rad; negative where it sticks out.
fn inside(range: Interval, part: Interval) -> f64 {
    (part.min() - range.min()).min(range.max() - part.max())
}

/// The smallest angle, rad, between any of the angles and a whole number of half turns.
fn to_a_line(angles: Interval) -> f64 {
    let turned = angles.affine(1.0, -(angles.middle() / PI).floor() * PI);
    turned.min().min(PI - turned.max())
}

/// What to add to the interval `low..high` so that it lies in `min..max`: whole turns, or, where the angle is `free`, as
/// little as possible. Of several turns the one that leaves most room.
fn shift_into(min: f64, max: f64, low: f64, high: f64, free: bool) -> Option<f64> {
    // Where nothing else decides, the angle keeps clear of its limits by more than it turns between two samples.
    let slack = if free { -CLEARANCE } else { LIMIT };
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
