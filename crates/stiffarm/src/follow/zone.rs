//! How far do the joints turn within a zone? Enclosed, so that nothing between two samples is missed.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::batch::SpatialArm;
use crate::enclose::{Affine, Angles, ArmEnclosure, sin_cos};
use crate::frontier::{self, Frontier};
use crate::interval::Interval;
use crate::inverse::{Configuration, posture_of};
use crate::spatial::Pose;
use crate::task::Zone;
use crate::tolerances;
use crate::work::{WorkPlacement, WorkPlane};

/// Parts of a zone that are enclosed before the search for a least value stops with the bound it has.
const MOST_PARTS: usize = 5000;

/// A zone at its place, held in one configuration.
pub(super) struct HeldZone<'a> {
    arm: &'a SpatialArm,
    enclosure: ArmEnclosure,
    tool_from_flange: Pose,
    plane: WorkPlane,
    work: WorkPlacement,
    zone: Zone,
    configuration: Configuration,
    /// The model angles at its centre, theta 1 to 6 and `theta 2 + theta 3`.
    centre: [f64; 7],
}

/// A part of a zone (sides of a rectangle, or radius and angle on a disc), and a lower bound on the least value in it.
struct Part {
    sides: [Interval; 2],
    least: f64,
}

impl frontier::Node for Part {
    fn key(&self) -> [f64; 2] {
        [self.least, 0.0]
    }
}

impl<'a> HeldZone<'a> {
    /// From the model angles with which the configuration holds the centre of the zone.
    pub(super) fn new(
        arm: &'a SpatialArm,
        elevation: f64,
        work: &WorkPlacement,
        zone: Zone,
        configuration: Configuration,
        centre: &[f64; 6],
    ) -> Self {
        let [t1, t2, t3, t4, t5, t6] = *centre;
        Self {
            arm,
            enclosure: ArmEnclosure::new(&arm.without_limits(), [false; 6]),
            tool_from_flange: arm.flange_from_tool.inverse(),
            plane: WorkPlane::of(elevation, work),
            work: *work,
            zone,
            configuration,
            centre: [t1, t2, t3, t4, t5, t6, t2 + t3],
        }
    }

    /// A lower bound on the least `value` of the model angles in the zone; minus infinity where none is known.
    ///
    /// It is too low by at most [`tolerances::FOLLOWED`] or the part [`tolerances::FOLLOWED_PART`] of it, unless it is at least
    /// `enough`. `value` takes the angles less than half a turn from those at the centre.
    pub(super) fn least(&self, enough: f64, value: impl Fn(&Angles) -> f64) -> f64 {
        let mut queue = Frontier::new();
        let mut found = f64::INFINITY;
        let whole = match self.zone {
            Zone::Circle { diameter } => [Interval::spanning(0.0, diameter / 2.0), Interval::spanning(-PI, PI)],
            Zone::Rectangle { width, height } => {
                [width, height].map(|side| Interval::spanning(-side / 2.0, side / 2.0))
            }
        };
        queue.push(Part { sides: whole, least: f64::NEG_INFINITY });
        let mut parts = 0;
        while let Some(Part { sides, least }) = queue.pop() {
            let tolerance = tolerances::FOLLOWED.max(tolerances::FOLLOWED_PART * found.abs());
            if enough <= least || found - tolerance <= least || MOST_PARTS < parts {
                return least.min(found);
            }
            for sides in self.halves(sides) {
                parts += 1;
                let angles = self.enclosure.angles(&self.plane, &self.work, self.part(sides), self.configuration);
                let least_here = angles.map_or(f64::NEG_INFINITY, |angles| value(&self.followed(angles)));
                queue.push(Part { sides, least: least.max(least_here) });
                if found <= least_here {
                    continue;
                }
                for at in self.corners(sides) {
                    let Some(angles) = self.angles_at(at) else { return f64::NEG_INFINITY };
                    found = found.min(value(&angles.map(Interval::point)));
                }
            }
        }
        found
    }

    /// The two halves of a part across its longer side; an angle counts as the length of its arc on the rim.
    fn halves(&self, sides: [Interval; 2]) -> [[Interval; 2]; 2] {
        let lever = match self.zone {
            Zone::Circle { .. } => sides[0].max(),
            Zone::Rectangle { .. } => 1.0,
        };
        let longer = usize::from(sides[0].width() < lever * sides[1].width());
        sides[longer].halves().map(|half| {
            let mut part = sides;
            part[longer] = half;
            part
        })
    }

    /// All points of a part, m from the centre of the zone.
    fn part(&self, sides: [Interval; 2]) -> [Affine<2>; 2] {
        let length = |i: usize| {
            let mut length = Affine::point(sides[i].middle());
            length.deviations[i] = sides[i].width() / 2.0;
            length
        };
        match self.zone {
            Zone::Rectangle { .. } => [length(0), length(1)],
            Zone::Circle { .. } => {
                let (sine, cosine) = sin_cos::<2>(sides[1], 1);
                [length(0) * cosine, length(0) * sine]
            }
        }
    }

    fn corners(&self, sides: [Interval; 2]) -> [[f64; 2]; 4] {
        let corner = |a: f64, b: f64| match self.zone {
            Zone::Rectangle { .. } => [a, b],
            Zone::Circle { .. } => [a * b.cos(), a * b.sin()],
        };
        let [first, second] = sides;
        [
            corner(first.min(), second.min()),
            corner(first.min(), second.max()),
            corner(first.max(), second.min()),
            corner(first.max(), second.max()),
        ]
    }

    /// The angles at a point of the zone, m from its centre.
    fn angles_at(&self, at: [f64; 2]) -> Option<[f64; 7]> {
        let flange = self.plane.pose(&self.work, at) * self.tool_from_flange;
        let [t1, t2, t3, t4, t5, t6] = posture_of(&self.arm.geometry, &flange, self.configuration)?;
        let mut angles = [t1, t2, t3, t4, t5, t6, t2 + t3];
        for (angle, centre) in angles.iter_mut().zip(self.centre) {
            *angle -= ((*angle - centre) / TAU).round() * TAU;
        }
        Some(angles)
    }

    /// The same angles with whole turns added, so that the middles lie within half a turn of the centre's angles.
    fn followed(&self, angles: Angles) -> Angles {
        std::array::from_fn(|i| {
            let turns = ((angles[i].middle() - self.centre[i]) / TAU).round();
            angles[i].affine(1.0, -turns * TAU)
        })
    }

    /// No joint turns by a quarter turn or more from the centre: the robot passes through the angles that are followed.
    pub(super) fn turns_less_than_a_quarter(&self) -> bool {
        let room = |angles: &Angles| {
            let least = |i: usize| {
                let turned = angles[i].affine(1.0, -self.centre[i]);
                FRAC_PI_2 - turned.max().max(-turned.min())
            };
            (0..6).map(least).fold(f64::INFINITY, f64::min)
        };
        0.0 < self.least(1e-3, room)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::inverse::postures;

    /// The witness samples the zone densely: the library's least is below every sample, and no more than its tolerance below.
    #[test]
    fn the_least_of_every_angle_is_below_all_samples_and_near_the_lowest() {
        let mut rng = fastrand::Rng::with_seed(36);
        let mut followed = 0;
        for case in 0..20 {
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let robot = paper_robots().swap_remove(case % 10);
            let arm = SpatialArm::new(&robot, &Pose::translation(part(-0.1, 0.1), 0.05, 0.2)).unwrap();
            let zone = match case % 2 {
                0 => Zone::Circle { diameter: part(0.1, 0.5) },
                _ => Zone::Rectangle { width: part(0.1, 0.5), height: part(0.1, 0.5) },
            };
            let elevation = [-FRAC_PI_2, 0.0, -0.7][case % 3];
            let (x, z) = (part(1.0, 1.8), part(0.6, 1.4));
            let work =
                WorkPlacement { x, y: 0.0, z, yaw: part(-0.4, 0.4), angle: part(0.0, 3.0), roll: part(0.0, 6.0) };
            let plane = WorkPlane::of(elevation, &work);
            let at_centre = postures(&arm.geometry, &(plane.pose(&work, [0.0; 2]) * arm.flange_from_tool.inverse()));
            for (held, centre) in at_centre.found {
                let held_zone = HeldZone::new(&arm, elevation, &work, zone, held, &centre);
                if !held_zone.turns_less_than_a_quarter() {
                    continue;
                }
                followed += 1;
                let side = |i: usize| i as f64 / 20.0 - 1.0;
                let points = (0..=40).flat_map(|j| (0..=40).map(move |i| zone.at([side(i), side(j)])));
                let samples: Vec<[f64; 7]> = points.map(|at| held_zone.angles_at(at).expect("reached")).collect();
                for i in 0..7 {
                    for sign in [1.0, -1.0] {
                        let least = held_zone.least(f64::INFINITY, |angles| angles[i].affine(sign, 0.0).min());
                        let lowest = samples.iter().map(|angles| sign * angles[i]).fold(f64::INFINITY, f64::min);
                        let off = lowest - least;
                        // Samples lie a fortieth of the zone apart, on its rim too; the rest is what the library allows itself.
                        let most = tolerances::FOLLOWED.max(tolerances::FOLLOWED_PART * lowest.abs()) + 2e-3;
                        assert!((-1e-12..most).contains(&off), "{case} {held} angle {i}: {least} {lowest}");
                    }
                }
            }
        }
        assert!(30 < followed, "{followed}");
    }
}
