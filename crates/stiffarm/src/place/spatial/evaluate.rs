//! What is the answer at a placement: which configuration follows the zone, and how far is the tool pushed off?

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::descent::{FINE, Score};
use super::search::{CELLS, Candidate, HALVING, Search};
use super::{Outside, Resolution, Solution};
use crate::angle::wrapped;
use crate::compliance::{Posture, compliance, most_of};
use crate::follow::{Followed, NotFollowed, PlacedZone};
use crate::inverse::Configuration;
use crate::load::Forces;
use crate::prior::normal;
use crate::tolerances;
use crate::watch::Stopped;
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// How often a place is searched again within narrower limits.
const NARROWINGS: usize = 5;
/// Draws of the drives by which it is seen where in a zone the worst may lie.
const TRIALS: usize = 64;
/// Standard deviation of the logarithms of the compliances in them: as drives scatter of which little is known.
const SCATTER: f64 = 0.7;

impl Search<'_> {
    /// The answer at a refined place; where a limit is overstepped between samples, at the place next to it that was refined
    /// within limits so much narrower. `None` where no configuration follows the zone.
    pub(super) fn evaluate(&self, candidate: &Candidate, coarse: Score) -> Result<Option<Solution>, Stopped> {
        let mut narrower = 0.0;
        let mut work = candidate.work;
        for _ in 0..NARROWINGS {
            match self.evaluate_placement(&work, coarse) {
                Ok(placement) => return Ok(Some(placement)),
                Err(NotFollowed::Impossible) => return Ok(None),
                Err(NotFollowed::Oversteps(by)) => narrower = 4.0 * narrower + 1.1 * by + 2.0 * tolerances::FOLLOWED,
            }
            let Some(freed) = self.freed.narrowed(narrower) else { return Ok(None) };
            let within = Self { freed, ..self.clone() };
            let start = within.candidate(work, &Grid::of(self.zone, CELLS[2]));
            // Far enough to leave what the narrower limits take away.
            let step = (self.step / 64.0).max(4.0 * narrower * self.robot.stretch());
            let Some(refined) = within.refined(&[start], CELLS[2], step)?.pop() else { return Ok(None) };
            work = refined.work;
        }
        Ok(None)
    }

    /// The answer at a placement, by the best configuration that follows the zone.
    pub(super) fn evaluate_placement(&self, work: &WorkPlacement, coarse: Score) -> Result<Solution, NotFollowed> {
        let mut order: Vec<(Score, Configuration)> =
            self.scores(work, &Grid::of(self.zone, CELLS[2])).into_iter().zip(Configuration::ALL).collect();
        order.retain(|(score, _)| score.is_feasible());
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut evaluated =
            order.into_iter().map(|(_, configuration)| self.evaluate_configuration(work, configuration, coarse));
        evaluated
            .find(|evaluated| !matches!(evaluated, Err(NotFollowed::Impossible)))
            .unwrap_or(Err(NotFollowed::Impossible))
    }

    /// The answer in one configuration, with samples so fine that halving their distance changes little.
    fn evaluate_configuration(
        &self,
        work: &WorkPlacement,
        configuration: Configuration,
        coarse: Score,
    ) -> Result<Solution, NotFollowed> {
        let score = |grid: &Grid| self.configuration_score(work, grid, configuration).ok_or(NotFollowed::Impossible);
        let mut cells = CELLS[2];
        let mut before = score(&Grid::of(self.zone, cells / 2))?;
        loop {
            let grid = Grid::of(self.zone, cells);
            let found = score(&grid)?;
            // Under a force of known direction a zone may not give way at all.
            let halving = (found - before) / before.max(f64::MIN_POSITIVE);
            if halving.abs() < HALVING || CELLS[3] <= cells {
                let followed = self.placed(work, configuration).follow(&grid)?;
                // Turned about the joint-1 axis, the zone would stand elsewhere, or otherwise to a force that is fixed to the base.
                if !self.turns_about_axis_1() && followed.bearing != 0.0 {
                    return Err(NotFollowed::Impossible);
                }
                let placement = self.placement(work, configuration, &grid, &followed, coarse, halving);
                return placement.ok_or(NotFollowed::Impossible);
            }
            before = found;
            cells *= 2;
        }
    }

    fn placed(&self, work: &WorkPlacement, configuration: Configuration) -> PlacedZone<'_> {
        PlacedZone {
            arm: self.arm,
            elevation: self.options.elevation,
            zone: self.zone,
            work: *work,
            configuration,
            roll_is_free: self.roll_is_free,
        }
    }

    /// The largest compliance of one configuration, where it reaches every pose.
    fn configuration_score(&self, work: &WorkPlacement, grid: &Grid, configuration: Configuration) -> Option<f64> {
        let score = self.scores(work, grid)[configuration.index()];
        score.is_feasible().then_some(score.worst)
    }

    fn placement(
        &self,
        work: &WorkPlacement,
        configuration: Configuration,
        grid: &Grid,
        followed: &Followed,
        coarse: Score,
        halving: f64,
    ) -> Option<Solution> {
        let tool = &self.arm.flange_from_tool;
        let evaluated = followed.joints.iter().map(|q| compliance(self.robot, q, tool).ok());
        let evaluated: Vec<_> = evaluated.collect::<Option<_>>()?;
        let plane = WorkPlane::of(self.options.elevation, work);
        let forces = plane.forces_at(self.options.load, followed.bearing);
        let most = evaluated.iter().map(|posture| posture.most(forces.as_ref()));
        let (at, most) = most.enumerate().max_by(|a, b| a.1.value.total_cmp(&b.1.value))?;
        let points = || grid.points.iter().map(|&at| plane.point(work, at));
        let worst_point =
            Rotation3::from_axis_angle(&Vector3::z_axis(), followed.bearing) * plane.point(work, grid.points[at]);
        let from_axis_1 = points().map(|point| point.xy().norm()).fold(f64::INFINITY, f64::min);
        let reaches = |axis: usize| points().any(|point| point[axis] < -tolerances::OUTSIDE);
        Some(Solution {
            deflection: most.value * self.options.force,
            lower_bound: 0.0,
            centre: [work.x, work.z],
            bearing: followed.bearing,
            yaw: wrapped(work.yaw),
            angle: work.angle.rem_euclid(self.options.load.period_of_turns()),
            roll: wrapped(followed.roll),
            configuration,
            worst_point: worst_point.into(),
            from_axis_1,
            outside: Outside { below: reaches(2), behind: reaches(0) },
            worst_joints: followed.joints[at],
            worst_shares: evaluated[at].shares_of(&most),
            by_drive: deciding(&evaluated, at, forces.as_ref()),
            worst_forces: forces,
            // The arm's limits are narrower by the margin that was asked for.
            limit_margin: (followed.limit_margin.0 + self.options.margins.limit, followed.limit_margin.1),
            singular_margin: followed.singular_margin,
            clearance: self.clearance(work, followed),
            resolution: Resolution {
                coarse_step: if self.is_one_place() { 0.0 } else { self.step },
                coarse: coarse.is_feasible().then_some(coarse.worst * self.options.force),
                fine_step: FINE.0,
                fine_turn: FINE.1,
                sample_step: grid.step,
                samples: grid.points.len(),
                halving,
                boxes: 0,
            },
        })
    }
}

/// What each drive gives at the worst pose of a zone, and at every other that is the worst in some draw of the drives.
fn deciding(evaluated: &[Posture], worst: usize, forces: Option<&Forces>) -> Vec<[Matrix3<f64>; 6]> {
    let parts: Vec<[Matrix3<f64>; 6]> = evaluated.iter().map(Posture::translations).collect();
    let mut rng = fastrand::Rng::with_seed(0);
    let mut chosen = vec![worst];
    for _ in 0..TRIALS {
        let factors = std::array::from_fn(|_| (SCATTER * normal(&mut rng)).exp());
        let values = parts.iter().map(|parts| most_of(parts, &factors, forces)).enumerate();
        let worst = values.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at);
        chosen.extend(worst.filter(|at| !chosen.contains(at)));
    }
    chosen.into_iter().map(|at| parts[at]).collect()
}
