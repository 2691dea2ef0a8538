//! Where must a zone stand in a cell? Sought in the axes of the cell; the arm that meets a place is the robot turned there.
//!
//! Turning about the joint-1 axis changes no deflection. It changes what limits joint 1 leaves, which windows hold the zone and
//! what the arm comes near to. The lower bound leaves these aside: it holds for every place about the robot that is as far from its
//! joint-1 axis and as high as some point of a window, and so for the fewer that the cell allows.

use std::f64::consts::PI;

use nalgebra::{Point3, Rotation3, Vector3};

use super::bound::BranchAndBound;
use super::descent::{FINE, Score, descend};
use super::search::{CELLS, Candidate, HALVING, LOOSE, MOST_ROLLS, Search, finer_rolls};
use super::site::{Ground, Site};
use super::{Misfit, Placed, Question, Resolution, Solution};
use crate::angle::wrapped;
use crate::batch::SpatialArm;
use crate::cell::Cell;
use crate::clearance::{Near, Surroundings, ThickArm};
use crate::interval::Interval;
use crate::inverse::{Configuration, posture_of};
use crate::parallel;
use crate::place::Orientation;
use crate::robot::Robot;
use crate::task::Zone;
use crate::tolerances;
use crate::watch::{Parts, Stopped};
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// How much is looked at.
const USUAL: Effort = Effort { places: 40_000.0, starts: 24, finalists: 6 };
/// The same where the bound lies farther below the value than [`LOOSE`].
const LARGE: Effort = Effort { places: 80_000.0, starts: 72, finalists: 12 };
/// The same where nothing is found and nothing is proved.
const LARGEST: Effort = Effort { places: 320_000.0, starts: 120, finalists: 40 };

/// Sites whose clearance is looked at before it is asked whether they are enough.
const BLOCK: usize = 256;
/// How often a place is searched again with more clearance than was asked for.
const TOUCHES: usize = 3;
/// A mount that is turned leaves so much, rad, in what is straight ahead: rounding.
const AHEAD: f64 = 1e-12;
/// Steps, rad, in which a place is turned back towards straight ahead.
const ASIDE: f64 = PI / 24.0;
/// So far, m, a place may move until every limit is kept between its samples.
const NEAR: f64 = 0.05;

/// How much a search looks at.
#[derive(Clone, Copy, Debug)]
struct Effort {
    /// Places that are evaluated in the coarse search, about.
    places: f64,
    /// Places that are refined.
    starts: usize,
    /// Places that are refined once more with the samples of the answer.
    finalists: usize,
}

/// A site with its score.
#[derive(Clone, Copy, Debug)]
struct Scored {
    site: Site,
    score: Score,
}

/// Finds the best place that a coarse search of the cell and its refinement see, with a lower bound that holds about the robot.
pub(super) fn search(
    robot: &Robot,
    arm: &SpatialArm,
    zone: Zone,
    options: &Question,
    cell: &Cell,
) -> Result<Placed, Stopped> {
    let search = CellSearch::new(robot, arm, zone, Ground::new(arm, zone, options, cell));
    // No search is needed; but bodies are coarse, and what is taken for a link may be larger than it is.
    if let Some(near) = search.blocked() {
        return Ok(Placed::Infeasible { reason: Misfit::Blocked { near }, is_proved: false, largest_scale: None });
    }
    let mut found = search.best(USUAL)?;
    let (relaxed, region) = search.ground.relaxed();
    let bound = BranchAndBound::new(arm, zone, &relaxed, region, [true, search.roll_is_free]);
    let value = |found: &Result<Solution, _>| {
        found.as_ref().map_or(f64::INFINITY, |solution| solution.deflection / options.force)
    };
    let mut proof = bound.prove(value(&found))?;
    if found.is_err() && !proof.unfathomed.is_empty() {
        found = search.best(LARGEST)?;
        if found.is_ok() {
            proof = bound.prove(value(&found))?;
        }
    }
    if found.is_ok()
        && proof.lower < value(&found) * (1.0 - LOOSE)
        && let Ok(better) = search.best(LARGE)?
        && better.deflection / options.force < value(&found) * (1.0 - HALVING)
    {
        found = Ok(better);
        proof = bound.prove(value(&found))?;
    }
    Ok(match found {
        Ok(solution) => Placed::Feasible(
            Solution {
                lower_bound: proof.lower * options.force,
                resolution: Resolution { boxes: proof.boxes, ..solution.resolution },
                ..solution
            }
            .into(),
        ),
        Err(reason) => {
            // With every angle that is asked for; what turns with its bearing is not sure of its extent.
            let is_narrow = reason == Misfit::WindowTooNarrow && options.orientation != Orientation::Free;
            Placed::Infeasible { reason, is_proved: is_narrow || proof.unfathomed.is_empty(), largest_scale: None }
        }
    })
}

/// Why no place was taken.
enum Untaken {
    Misfit(Misfit),
    /// By so much, m, the least touching of some places missed the clearance that was asked for.
    TooNear(f64),
}

/// What the arm keeps from everything, m.
#[derive(Clone, Copy, Debug)]
struct Keep {
    /// What is asked for.
    asked: f64,
    /// What is kept besides: the search looks at few poses of a zone, the answer at many.
    reserve: f64,
}

struct CellSearch<'a> {
    robot: &'a Robot,
    arm: &'a SpatialArm,
    zone: Zone,
    roll_is_free: bool,
    ground: Ground<'a>,
    /// The arm as it must keep clear; `None` where no body of it is known.
    thick: Option<ThickArm<'a>>,
}

impl<'a> CellSearch<'a> {
    fn new(robot: &'a Robot, arm: &'a SpatialArm, zone: Zone, ground: Ground<'a>) -> Self {
        let thick = ThickArm::new(robot, &arm.flange_from_tool, None);
        Self { robot, arm, zone, roll_is_free: ground.roll_is_free, ground, thick }
    }

    /// What of the arm keeps less from a box than is asked for, wherever its joints stand.
    fn blocked(&self) -> Option<Near> {
        let asked = self.ground.cell.clearance?;
        self.thick.as_ref()?.always_nearer(&Surroundings::of(Some(self.ground.cell), None), asked)
    }

    /// The best place that keeps the clearance that is asked for, or why none was found.
    fn best(&self, effort: Effort) -> Result<Result<Solution, Misfit>, Stopped> {
        let (sites, step) = self.ground.sites(effort.places);
        if sites.is_empty() {
            return Ok(Err(if self.ground.has_room() { Misfit::NothingReached } else { Misfit::WindowTooNarrow }));
        }
        let free = self.coarse(&sites)?;
        if free.is_empty() {
            return Ok(Err(if self.ground.all_lie_in_kept_free(&sites) { Misfit::KeptFree } else { Misfit::Within }));
        }
        let best = match self.find((&free, step), effort, None)? {
            Ok(best) => best,
            Err(Untaken::Misfit(misfit)) => return Ok(Err(misfit)),
            Err(Untaken::TooNear(_)) => unreachable!("nothing is too near where no clearance is asked for"),
        };
        // Where the best of all places keeps it, no other is better.
        if self.keeps_clear(&best) {
            return Ok(Ok(self.foremost(best)?));
        }
        let Some(asked) = self.ground.cell.clearance else { return Ok(Ok(best)) };
        let mut keep = Keep { asked, reserve: 0.0 };
        for _ in 0..=TOUCHES {
            match self.find((&free, step), effort, Some(keep))? {
                Ok(found) => return Ok(Ok(self.foremost(found)?)),
                Err(Untaken::TooNear(short)) => keep.reserve += short + FINE.0,
                Err(Untaken::Misfit(_)) => break,
            }
        }
        Ok(Err(Misfit::Clearance { asked, otherwise: best.clearance }))
    }

    /// Nothing is nearer than was asked.
    fn keeps_clear(&self, found: &Solution) -> bool {
        let keeps = |asked| found.clearance.is_some_and(|kept| asked <= kept.distance);
        self.ground.cell.clearance.is_none_or(keeps)
    }

    /// The same place turned about the joint-1 axis as far towards straight ahead as it may stand there: it is as good anywhere about the robot.
    fn foremost(&self, found: Solution) -> Result<Solution, Stopped> {
        if !self.ground.is_alike_all_about() {
            return Ok(found);
        }
        let aside = (0..).map(|i| ASIDE * f64::from(i)).take_while(|aside| *aside < found.bearing.abs());
        for bearing in aside.flat_map(|aside| [aside, -aside]) {
            let site = self.ground.site(bearing, &found);
            if !self.ground.allows(&site) {
                continue;
            }
            let turned = self.evaluated(&Scored { site, score: Score::NONE }, Score::NONE, 0.0)?;
            let is_as_good = |turned: &Solution| {
                self.keeps_clear(turned) && turned.deflection <= found.deflection * (1.0 + tolerances::BOUND)
            };
            if let Some(turned) = turned.filter(is_as_good) {
                return Ok(Solution { resolution: found.resolution, ..turned });
            }
        }
        Ok(found)
    }

    /// The sites that are reached, whatever the arm touches there, the best first.
    fn coarse(&self, sites: &[Site]) -> Result<Vec<Scored>, Stopped> {
        let grid = Grid::of(self.zone, CELLS[0]);
        let scored = |site: &Site| self.parts().one_more().map(|()| self.scored_below(site, &grid, Score::NONE, None));
        let mut scored = parallel::try_each(sites, scored)?;
        scored.retain(|scored| scored.score.unreached < usize::MAX);
        scored.sort_by(|a, b| a.score.total_cmp(&b.score));
        Ok(scored)
    }

    /// The best place from the best sites; these as they are without a clearance.
    fn find(
        &self,
        (free, step): (&[Scored], f64),
        effort: Effort,
        keep: Option<Keep>,
    ) -> Result<Result<Solution, Untaken>, Stopped> {
        let clear = keep.map(|keep| self.settled((free, step), effort.starts, keep)).transpose()?;
        let seen = clear.as_deref().unwrap_or(free);
        let coarse = seen[0].score;
        let rough = self.refined(&apart(seen, step, effort.starts), CELLS[1], step / 2.0, keep)?;
        let mut short: Option<f64> = None;
        let mut is_nowhere_whole = true;
        // Where a joint must turn too far at the best, others may do.
        for some in rough.chunks(effort.finalists) {
            let refined = self.refined(some, CELLS[2], step / 8.0, keep)?;
            is_nowhere_whole &= refined.is_empty();
            if let Some(found) = self.first_kept(&refined, (coarse, step), keep, &mut short)? {
                return Ok(Ok(found));
            }
            if short.is_some() {
                break;
            }
        }
        let fine = self.at_fine_rolls()?;
        if let Some(found) = self.first_kept(&fine, (coarse, step), keep, &mut short)? {
            return Ok(Ok(found));
        }
        if is_nowhere_whole && fine.is_empty() {
            let step = if self.ground.is_one_place() { 0.0 } else { step };
            return Ok(Err(Untaken::Misfit(Misfit::NowhereWhole { step })));
        }
        Ok(Err(short.map_or(Untaken::Misfit(Misfit::Turning), Untaken::TooNear)))
    }

    /// The answer of the first that is followed as a whole and keeps what is asked for; of others by how much that is missed at least.
    fn first_kept(
        &self,
        refined: &[Scored],
        (coarse, step): (Score, f64),
        keep: Option<Keep>,
        short: &mut Option<f64>,
    ) -> Result<Option<Solution>, Stopped> {
        for found in refined {
            let Some(solution) = self.evaluated(found, coarse, step)? else { continue };
            let Some(Keep { asked, .. }) = keep else { return Ok(Some(solution)) };
            let Some(kept) = solution.clearance else { continue };
            if asked <= kept.distance {
                return Ok(Some(solution));
            }
            *short = Some(short.map_or(asked - kept.distance, |least| least.min(asked - kept.distance)));
        }
        Ok(None)
    }

    /// The one place at the rolls, finely, at which the zone is reached as a whole, the best first; nothing where another is left to choose.
    fn at_fine_rolls(&self) -> Result<Vec<Scored>, Stopped> {
        let Some(sites) = self.ground.at_fine_rolls() else { return Ok(Vec::new()) };
        let held = self.held(&sites)?;
        if !held.is_empty() {
            return Ok(held);
        }
        let mut near = self.coarse(&sites)?;
        near.truncate(MOST_ROLLS);
        let finer = |site: Site| finer_rolls(site.roll).map(move |roll| Site { roll, ..site });
        self.held(&near.into_iter().flat_map(|scored| finer(scored.site)).collect::<Vec<Site>>())
    }

    /// Those of some sites at which the zone is reached as a whole, the best first.
    fn held(&self, sites: &[Site]) -> Result<Vec<Scored>, Stopped> {
        let grid = Grid::of(self.zone, CELLS[2]).outermost_first();
        // Where one pose is out of reach no other is looked at.
        let scored =
            |site: &Site| self.parts().go_on().map(|()| self.scored_below(site, &grid, Score::ONE_OUT_OF_REACH, None));
        let mut held = parallel::try_each(sites, scored)?;
        held.retain(|scored| scored.score.is_feasible());
        held.sort_by(|a, b| a.score.total_cmp(&b.score));
        held.truncate(MOST_ROLLS);
        Ok(held)
    }

    /// Sites by what they are where the arm keeps clear, the best first: enough for so many starts, or all.
    fn settled(&self, (free, step): (&[Scored], f64), starts: usize, keep: Keep) -> Result<Vec<Scored>, Stopped> {
        let grid = Grid::of(self.zone, CELLS[0]);
        let by_score = |a: &Scored, b: &Scored| a.score.total_cmp(&b.score);
        // To keep clear makes no place better: those that follow are no better than they are without it.
        let mut seen: Vec<Scored> = Vec::new();
        for block in free.chunks(BLOCK) {
            let kept = |free: &Scored| {
                self.parts().go_on().map(|()| self.scored_below(&free.site, &grid, Score::NONE, Some(keep)))
            };
            seen.extend(parallel::try_each(block, kept)?);
            seen.sort_by(by_score);
            let last = block.last().expect("no empty block");
            let settled = seen.partition_point(|scored| by_score(scored, last).is_le());
            if apart(&seen[..settled], step, starts).len() == starts {
                break;
            }
        }
        Ok(seen)
    }

    fn parts(&self) -> &Parts<'_> {
        self.ground.options.parts
    }

    /// Every start refined, the best first.
    fn refined(&self, starts: &[Scored], cells: usize, step: f64, keep: Option<Keep>) -> Result<Vec<Scored>, Stopped> {
        let grid = Grid::of(self.zone, cells).outermost_first();
        let mut refined = parallel::try_each(starts, |start| self.descend(start, &grid, step, keep))?;
        refined.sort_by(|a, b| a.score.total_cmp(&b.score));
        refined.retain(|scored| scored.score.is_feasible());
        Ok(refined)
    }

    /// Steps in every direction of what is free, halved where none is better.
    fn descend(&self, start: &Scored, grid: &Grid, first_step: f64, keep: Option<Keep>) -> Result<Scored, Stopped> {
        let directions = self.ground.directions();
        descend(
            (self.scored_below(&start.site, grid, Score::NONE, keep), [first_step, 0.15], self.parts()),
            |scored| scored.score,
            |best, [step, turn]| {
                let moved = directions.iter().map(|way| self.ground.reined(start_from(&best.site, way, step, turn)));
                moved.map(|site| self.scored_below(&site, grid, best.score, keep)).collect()
            },
        )
    }

    /// The score of the best configuration that keeps clear, where it is less than a bound, else any score that is not; where none keeps clear, how
    /// far it is from that.
    fn scored_below(&self, site: &Site, grid: &Grid, bound: Score, keep: Option<Keep>) -> Scored {
        if !self.ground.allows(site) {
            return Scored { site: *site, score: Score::NONE };
        }
        let score = self.at(site, |search, work| match keep {
            None => search.candidate_below(*work, grid, bound).score,
            Some(keep) => search.score_clear_by(keep, self.thick.as_ref(), work, (grid, bound)),
        });
        Scored { site: *site, score }
    }

    /// The answer at a refined site; `None` where it is not followed there, or where following it leads out of what is allowed.
    fn evaluated(&self, found: &Scored, coarse: Score, step: f64) -> Result<Option<Solution>, Stopped> {
        let (bearing, _) = self.ground.local(&found.site);
        let bearing = if bearing.abs() < AHEAD { 0.0 } else { bearing };
        let solution = self.at(&found.site, |search, work| {
            let grid = Grid::of(self.zone, CELLS[2]);
            let candidate: Candidate = search.candidate(*work, &grid);
            search.evaluate(&candidate, coarse)
        })?;
        let Some(solution) = solution else { return Ok(None) };
        // Joint 1 would have to turn on.
        if 1e-9 < solution.bearing.abs() {
            return Ok(None);
        }
        let site = self.ground.site(bearing, &solution);
        if !self.ground.allows(&site) {
            return Ok(None);
        }
        let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), bearing);
        let axes = turned.matrix();
        let mut worst_joints = solution.worst_joints;
        worst_joints[0] += self.arm.geometry.sign[0] * bearing;
        Ok(Some(Solution {
            bearing: wrapped(bearing),
            worst_point: (turned * Point3::from(solution.worst_point)).into(),
            worst_joints,
            by_drive: solution.by_drive.iter().map(|parts| parts.map(|part| axes * part * axes.transpose())).collect(),
            worst_forces: solution.worst_forces.map(|forces| forces.turned(axes)),
            resolution: Resolution {
                coarse_step: if self.ground.is_one_place() { 0.0 } else { step },
                ..solution.resolution
            },
            ..solution
        }))
    }

    /// Asks the search of the robot turned to a site: straight ahead the zone lies there.
    fn at<R>(&self, site: &Site, ask: impl FnOnce(&Search, &WorkPlacement) -> R) -> R {
        let (bearing, work) = self.ground.local(site);
        let arm = self.arm.with_base_turned(bearing);
        let question = self.ground.seen_from(bearing);
        let search = Search {
            robot: self.robot,
            arm: &arm,
            freed: arm.without_limit_on(5, self.roll_is_free).with_joint_1_clear(),
            zone: self.zone,
            options: &question,
            roll_is_free: self.roll_is_free,
            region: [work.x, work.z].map(|at| Interval::spanning(at - NEAR, at + NEAR)),
            step: 0.1,
        };
        ask(&search, &work)
    }
}

impl Search<'_> {
    /// The score of the best configuration that keeps clear, where it is less than a bound; where none does, how far it is from that.
    fn score_clear_by(
        &self,
        Keep { asked, reserve }: Keep,
        thick: Option<&ThickArm>,
        work: &WorkPlacement,
        (grid, bound): (&Grid, Score),
    ) -> Score {
        let mut scores: Vec<(Score, Configuration)> =
            self.scores_below(work, grid, bound).into_iter().zip(Configuration::ALL).collect();
        scores.sort_by(|a, b| a.0.total_cmp(&b.0));
        let best = scores[0].0;
        if best.total_cmp(&bound).is_ge() || !best.is_feasible() {
            return best;
        }
        let mut short = f64::INFINITY;
        for (score, configuration) in scores.into_iter().filter(|(score, _)| score.is_feasible()) {
            match thick.and_then(|thick| self.rough_clearance(thick, work, configuration)) {
                Some(clearance) if clearance < asked + reserve => short = short.min(asked - clearance),
                _ => return score,
            }
        }
        Score { unreached: 1, worst: short }
    }

    /// The nearest at some poses of one configuration, m.
    fn rough_clearance(&self, thick: &ThickArm, work: &WorkPlacement, configuration: Configuration) -> Option<f64> {
        let plane = WorkPlane::of(self.options.elevation, work);
        let tool_from_flange = self.arm.flange_from_tool.inverse();
        let held = Grid::of(self.zone, 2)
            .points
            .into_iter()
            .filter_map(|at| posture_of(&self.arm.geometry, &(plane.pose(work, at) * tool_from_flange), configuration));
        self.least_distance(thick, work, &held.collect::<Vec<_>>())
    }
}

fn start_from(site: &Site, direction: &[f64; 6], step: f64, turn: f64) -> Site {
    let [x, y, z, yaw, angle, roll] = *direction;
    Site {
        at: site.at + Vector3::new(x, y, z) * step,
        is_behind: site.is_behind,
        yaw: site.yaw + yaw * turn,
        angle: site.angle + angle * turn,
        roll: site.roll + roll * turn,
    }
}

/// The first of a sorted list that are two steps or another turn apart.
fn apart(sorted: &[Scored], step: f64, most: usize) -> Vec<Scored> {
    let mut chosen: Vec<Scored> = Vec::new();
    for scored in sorted {
        let near = |other: &Scored| {
            let (a, b) = (&scored.site, &other.site);
            let turned = [a.yaw - b.yaw, a.angle - b.angle, a.roll - b.roll].map(|turn| wrapped(turn).abs());
            (a.at - b.at).norm() < 2.0 * step && turned.into_iter().sum::<f64>() < PI / 4.0
        };
        if !chosen.iter().any(near) {
            chosen.push(*scored);
        }
        if chosen.len() == most {
            break;
        }
    }
    chosen
}
