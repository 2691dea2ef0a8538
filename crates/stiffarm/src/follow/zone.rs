//! How far do the joints turn within a zone? Enclosed, so that nothing between two samples is missed.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::batch::SpatialArm;
use crate::enclose::{Affine, Angles, ArmEnclosure, least_over};
use crate::interval::Interval;
use crate::inverse::{Configuration, posture_of};
use crate::spatial::Pose;
use crate::task::Zone;
use crate::tolerances;
use crate::work::{WorkPlacement, WorkPlane};

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
        let is_enough = |least: f64, found: f64| {
            let tolerance = tolerances::FOLLOWED.max(tolerances::FOLLOWED_PART * found.abs());
            enough <= least || found - tolerance <= least
        };
        let bound = |part: [Affine<2>; 2]| {
            let angles = self.enclosure.angles(&self.plane, &self.work, part, self.configuration);
            angles.map_or(f64::NEG_INFINITY, |angles| value(&self.followed(angles)))
        };
        let at =
            |at: [f64; 2]| self.angles_at(at).map_or(f64::NEG_INFINITY, |angles| value(&angles.map(Interval::point)));
        least_over(self.zone, is_enough, bound, at).bound
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
