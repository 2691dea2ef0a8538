//! Where must a zone stand? A coarse search over every place, yaw, angle and roll, then local descent from the best.

use super::bound::BranchAndBound;
use super::descent::{Score, descend, others};
use super::{Misfit, Placed, Question, Resolution, Solution};
use crate::angle::wrapped;
use crate::batch::{SameBranch, SpatialArm};
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::parallel;
use crate::place::{Orientation, Within};
use crate::robot::Robot;
use crate::task::Zone;
use crate::tolerances;
use crate::watch::Stopped;
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// Places along the longer side of what is searched.
pub(super) const PLACES: usize = 60;
/// Places that are refined; the second where the bound lies farther below the value than [`LOOSE`].
pub(super) const STARTS: [usize; 2] = [24, 160];
/// Relative distance of value and bound beyond which more places are refined.
pub(super) const LOOSE: f64 = 0.02;
/// Places that are refined once more with the samples of the answer.
pub(super) const FINALISTS: usize = 5;
/// Zones that are evaluated before the best value so far is compared again.
const BLOCK: usize = 256;
/// Halving the distance between samples must change less than this.
pub(super) const HALVING: f64 = 1e-3;
/// Cells along the shorter side of a zone: coarse search, refinement, the answer, and the finest it may need.
pub(super) const CELLS: [usize; 4] = [2, 6, 16, 64];
/// Steps of the roll, deg, at one place, and where none of them is held: of the best place a tenth of a degree may be all that is left.
pub(super) const ROLL_AT_ONE_PLACE: f64 = 1.0;
const FINE_ROLL: f64 = 0.02;
/// About one that is nearly held, so many finer ones on either side.
const FINER: i32 = 40;
/// Of these so many are evaluated.
pub(super) const MOST_ROLLS: usize = 200;
/// Steps of the refinement, m, with which turns become finer where there is no other place.
pub(super) const STEP_AT_ONE_PLACE: f64 = 0.05;
/// How often the placement that stands in the way of a better bound is refined.
const RESTARTS: usize = 3;

/// Finds the best place that a coarse search and its refinement see, and proves how much better another could be.
pub(super) fn search(robot: &Robot, arm: &SpatialArm, zone: Zone, options: &Question) -> Result<Placed, Stopped> {
    let search = Search::new(robot, arm, zone, options);
    let mut found = search.find(STARTS[0])?;
    let branch_and_bound =
        BranchAndBound::new(arm, zone, options, search.region, [search.turns_about_axis_1(), search.roll_is_free]);
    let value = |found: &Result<Solution, Misfit>| {
        found.as_ref().map_or(f64::INFINITY, |placement| placement.deflection / options.force)
    };
    let mut proof = branch_and_bound.prove(value(&found))?;
    if proof.lower < value(&found) * (1.0 - LOOSE)
        && let Ok(better) = search.find(STARTS[1])?
        && better.deflection / options.force < value(&found) * (1.0 - HALVING)
    {
        found = Ok(better);
        proof = branch_and_bound.prove(value(&found))?;
    }
    for _ in 0..RESTARTS {
        let near = parallel::try_each(&proof.unfathomed, |work| search.find_near(*work))?;
        let by_deflection = |a: &Solution, b: &Solution| a.deflection.total_cmp(&b.deflection);
        let Some(better) = near.into_iter().flatten().min_by(by_deflection) else { break };
        if value(&found) * (1.0 - HALVING) <= better.deflection / options.force {
            break;
        }
        // What the coarse search saw stays what it is.
        let coarse = found.map_or(None, |placement| placement.resolution.coarse);
        found = Ok(Solution { resolution: Resolution { coarse, ..better.resolution }, ..better });
        proof = branch_and_bound.prove(value(&found))?;
    }
    Ok(match found {
        Ok(placement) => Placed::Feasible(
            Solution {
                lower_bound: proof.lower * options.force,
                resolution: Resolution { boxes: proof.boxes, ..placement.resolution },
                ..placement
            }
            .into(),
        ),
        // Between the turns that are tried another may be narrower: only the proof knows of all.
        Err(reason) => {
            let reason = if search.window_is_too_narrow() { Misfit::WindowTooNarrow } else { reason };
            Placed::Infeasible { reason, is_proved: proof.unfathomed.is_empty(), largest_scale: None }
        }
    })
}

/// Is there any place that the coarse search and its refinement see?
pub(super) fn has_place(robot: &Robot, arm: &SpatialArm, zone: Zone, options: &Question) -> Result<bool, Stopped> {
    Ok(Search::new(robot, arm, zone, options).find(STARTS[0])?.is_ok())
}

/// Where centres may lie by the lengths of the arm, ahead of the joint-1 axis and behind it, and up.
pub(super) fn region(arm: &SpatialArm, within: Within) -> [Interval; 2] {
    let [_, up] = arm.reach();
    // Where both share nothing, one place far away says so.
    [within.x.intersect(ahead_and_behind(arm)), within.z.intersect(up)]
        .map(|range| range.unwrap_or(Interval::point(1e9)))
}

/// The same, but of a window that is as wide as the zone at every turn that is asked for, but for rounding, the one place that is meant.
fn of_centres(region: [Interval; 2], zone: Zone, options: &Question) -> [Interval; 2] {
    if options.orientation == Orientation::Free || 0.0 < options.yaw.width() && !options.is_vertical() {
        return region;
    }
    let yaw = if options.is_vertical() { 0.0 } else { options.yaw.min() };
    let extents = options.angles().into_iter().map(|angle| {
        let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw, angle, roll: 0.0 };
        WorkPlane::of(options.elevation, &work).half_extents(zone)
    });
    let least = extents.fold([f64::INFINITY; 2], |least, [ahead, _, up]| [least[0].min(ahead), least[1].min(up)]);
    [0, 1].map(|i| {
        let room = region[i].room_for(least[i], tolerances::ONE_PLACE);
        room.filter(|room| room.width() == 0.0).unwrap_or(region[i])
    })
}

/// Distance between the places of a coarse search over a region, m.
pub(super) fn step_in(region: &[Interval; 2]) -> f64 {
    let longest = region[0].width().max(region[1].width());
    if longest == 0.0 { STEP_AT_ONE_PLACE } else { (longest / PLACES as f64).max(1e-3) }
}

/// No place is left to choose.
fn is_point(region: &[Interval; 2]) -> bool {
    region.iter().all(|range| range.width() == 0.0)
}

/// A whole turn in fine steps, rad.
pub(super) fn fine_rolls() -> impl Iterator<Item = f64> {
    (0..(360.0 / FINE_ROLL) as usize).map(|i| (i as f64 * FINE_ROLL).to_radians())
}

/// Those about one of them, more finely.
pub(super) fn finer_rolls(roll: f64) -> impl Iterator<Item = f64> {
    (-FINER..=FINER).map(move |i| roll + (FINE_ROLL * f64::from(i) / f64::from(FINER)).to_radians())
}

/// How far ahead of the joint-1 axis and behind it the tool point can be by the lengths alone, m.
pub(super) fn ahead_and_behind(arm: &SpatialArm) -> Interval {
    let [ahead, _] = arm.reach();
    Interval::spanning(-ahead.max(), ahead.max())
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) work: WorkPlacement,
    pub(super) score: Score,
    /// The configuration with that score.
    pub(super) configuration: Configuration,
}

#[derive(Clone)]
pub(super) struct Search<'a> {
    pub(super) robot: &'a Robot,
    /// As asked, and without the limits that turning the zone or the tool meets.
    pub(super) arm: &'a SpatialArm,
    pub(super) freed: SpatialArm,
    pub(super) zone: Zone,
    pub(super) options: &'a Question<'a>,
    /// Rolling the tool moves nothing, and any roll will do.
    pub(super) roll_is_free: bool,
    /// Where centres are looked for: ahead, up.
    pub(super) region: [Interval; 2],
    pub(super) step: f64,
}

impl<'a> Search<'a> {
    pub(super) fn new(robot: &'a Robot, arm: &'a SpatialArm, zone: Zone, options: &'a Question<'a>) -> Self {
        let roll_is_free = options.roll.is_none() && arm.tool_turns_about_axis_6();
        let region = of_centres(region(arm, options.within), zone, options);
        let turns = !options.load.breaks_symmetry() && !is_point(&region);
        Self {
            robot,
            arm,
            freed: if turns { arm.without_limit_on(0, true) } else { arm.clone().with_joint_1_clear() }
                .without_limit_on(5, roll_is_free),
            zone,
            options,
            roll_is_free,
            step: step_in(&region),
            region,
        }
    }

    /// No place is left to choose.
    pub(super) fn is_one_place(&self) -> bool {
        is_point(&self.region)
    }

    /// A zone that fits where it is turned about the joint-1 axis is as good: it may stand at any bearing. One place is straight ahead, and a force
    /// that is fixed to the base does not turn.
    pub(super) fn turns_about_axis_1(&self) -> bool {
        !self.options.load.breaks_symmetry() && !self.is_one_place()
    }

    /// The best place that the coarse search and its refinement see.
    fn find(&self, starts: usize) -> Result<Result<Solution, Misfit>, Stopped> {
        let seen = match self.coarse(starts)? {
            Ok(seen) => seen,
            Err(misfit) => return Ok(Err(misfit)),
        };
        let mut rough = self.refined(&seen, CELLS[1], self.step / 2.0)?;
        rough.truncate(FINALISTS);
        let refined = self.refined(&rough, CELLS[2], self.step / 8.0)?;
        let coarse = seen.iter().map(|candidate| candidate.score).min_by(Score::total_cmp).expect("a start");
        if let Some(found) = self.first_followed(&refined, coarse)? {
            return Ok(Ok(found));
        }
        let fine = self.at_fine_rolls()?;
        if let Some(found) = self.first_followed(&fine, coarse)? {
            return Ok(Ok(found));
        }
        if refined.is_empty() && fine.is_empty() {
            let step = if self.is_one_place() { 0.0 } else { self.step };
            return Ok(Err(Misfit::NowhereWhole { step }));
        }
        Ok(Err(Misfit::Turning))
    }

    /// The best place that a refinement from one placement sees.
    fn find_near(&self, work: WorkPlacement) -> Result<Option<Solution>, Stopped> {
        let start = self.candidate(work, &Grid::of(self.zone, CELLS[1]));
        let rough = self.refined(&[start], CELLS[1], self.step / 8.0)?;
        self.first_followed(&self.refined(&rough, CELLS[2], self.step / 8.0)?, Score::NONE)
    }

    /// The answer of the first that is followed as a whole.
    fn first_followed(&self, refined: &[Candidate], coarse: Score) -> Result<Option<Solution>, Stopped> {
        for candidate in refined {
            if let Some(found) = self.evaluate(candidate, coarse)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// What of a placement may change: ahead, up, yaw, angle, roll.
    fn free(&self) -> [bool; 5] {
        let angle = self.options.orientation == Orientation::Free;
        let yaw = 0.0 < self.options.yaw.width() && !self.options.is_vertical();
        [true, true, yaw, angle, self.options.roll.is_none() && !self.roll_is_free]
    }

    /// A placement moved within what is allowed: by steps, m, and turns, rad.
    fn moved(
        &self,
        from: &WorkPlacement,
        [x, z, yaw, angle, roll]: &[f64; 5],
        [step, turn]: [f64; 2],
    ) -> WorkPlacement {
        let [.., free_yaw, _, _] = self.free();
        WorkPlacement {
            x: self.region[0].clamp(from.x + step * x),
            y: 0.0,
            z: self.region[1].clamp(from.z + step * z),
            yaw: if free_yaw { self.options.yaw.clamp(from.yaw + turn * yaw) } else { from.yaw },
            angle: from.angle + turn * angle,
            roll: from.roll + turn * roll,
        }
    }

    /// Every start refined, the best first.
    pub(super) fn refined(&self, starts: &[Candidate], cells: usize, step: f64) -> Result<Vec<Candidate>, Stopped> {
        let grid = Grid::of(self.zone, cells).outermost_first();
        let mut refined = parallel::try_each(starts, |start| self.descend(start, &grid, step))?;
        refined.sort_by(|a, b| a.score.total_cmp(&b.score));
        refined.retain(|candidate| candidate.score.is_feasible());
        Ok(refined)
    }

    /// The turns that are tried: yaw, angle of the first side, roll.
    fn turns(&self) -> Vec<[f64; 3]> {
        let every = |step_deg: f64, turn_deg: f64| -> Vec<f64> {
            (0..(turn_deg / step_deg) as usize).map(|i| (i as f64 * step_deg).to_radians()).collect()
        };
        let rolls_matter = self.options.roll.is_none() && !self.roll_is_free;
        let step = if rolls_matter && !self.options.is_vertical() { 30.0 } else { 15.0 };
        // Where no place is left to choose a roll may be the only one.
        let roll_step = if self.is_one_place() { ROLL_AT_ONE_PLACE } else { step };
        let yaw = self.options.yaw;
        let yaws = if self.options.is_vertical() {
            vec![0.0]
        } else {
            // A whole turn ends where it begins, which does no harm.
            let count = (yaw.width().to_degrees() / step).ceil().min(360.0 / step) as usize;
            (0..=count).map(|i| yaw.min() + yaw.width() * i as f64 / count.max(1) as f64).collect()
        };
        let rolls = match self.options.roll {
            Some(roll) => vec![roll],
            None if self.roll_is_free => vec![0.0],
            None => every(roll_step, 360.0),
        };
        let mut turns = Vec::new();
        for &yaw in &yaws {
            for angle in self.options.angles() {
                turns.extend(rolls.iter().map(|&roll| [yaw, angle, roll]));
            }
        }
        turns
    }

    /// The best places of a grid over the region and all turns, best first, far enough apart to be different.
    fn coarse(&self, starts: usize) -> Result<Result<Vec<Candidate>, Misfit>, Stopped> {
        let [columns, rows] = self.region.map(|range| (range.width() / self.step).ceil() as usize + 1);
        let at = |range: Interval, i: usize, count: usize| match count {
            1 => range.middle(),
            _ => range.min() + range.width() * i as f64 / (count - 1) as f64,
        };
        let works: Vec<WorkPlacement> = self
            .turns()
            .into_iter()
            .flat_map(|[yaw, angle, roll]| {
                (0..rows * columns).map(move |i| (i % columns, i / columns)).map(move |(i, j)| {
                    let (x, z) = (at(self.region[0], i, columns), at(self.region[1], j, rows));
                    WorkPlacement { x, y: 0.0, z, yaw, angle, roll }
                })
            })
            .collect();
        let mut centres = self.centres(&works, rows * columns)?;
        if !centres.iter().any(|centre| centre.0.is_finite()) {
            return Ok(Err(Misfit::NothingReached));
        }
        centres.retain(|centre| centre.0.is_finite());
        centres.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let grid = Grid::of(self.zone, CELLS[0]);
        let mut seen: Vec<Candidate> = Vec::new();
        let mut best = f64::INFINITY;
        for block in centres.chunks(BLOCK) {
            // A zone is no stiffer than its centre.
            if best < block[0].0 {
                break;
            }
            self.options.parts.one_more()?;
            let evaluated = parallel::each(block, |(_, i)| self.candidate(works[*i], &grid));
            best = evaluated.iter().filter(|c| c.score.is_feasible()).map(|c| c.score.worst).fold(best, f64::min);
            seen.extend(evaluated);
        }
        seen.sort_by(|a, b| a.score.total_cmp(&b.score));
        Ok(Ok(self.apart(&seen, starts)))
    }

    /// The one place at all rolls, finely, where any roll will do: those at which the zone is reached as a whole, the best first.
    fn at_fine_rolls(&self) -> Result<Vec<Candidate>, Stopped> {
        if !self.is_one_place() || self.options.roll.is_some() || self.roll_is_free {
            return Ok(Vec::new());
        }
        self.options.parts.go_on()?;
        let mut turns = self.turns();
        let first = turns[0][2];
        turns.retain(|[.., roll]| *roll == first);
        let [x, z] = self.region.map(Interval::middle);
        let work =
            |[yaw, angle, _]: [f64; 3]| fine_rolls().map(move |roll| WorkPlacement { x, y: 0.0, z, yaw, angle, roll });
        let works: Vec<WorkPlacement> = turns.into_iter().flat_map(work).collect();
        let held = self.held(&works);
        if !held.is_empty() {
            return Ok(held);
        }
        let grid = Grid::of(self.zone, CELLS[0]);
        let mut near = parallel::each(&works, |work| self.candidate(*work, &grid));
        near.sort_by(|a, b| a.score.total_cmp(&b.score));
        near.truncate(MOST_ROLLS);
        let finer = |work: WorkPlacement| finer_rolls(work.roll).map(move |roll| WorkPlacement { roll, ..work });
        let works: Vec<WorkPlacement> = near.into_iter().flat_map(|candidate| finer(candidate.work)).collect();
        Ok(self.held(&works))
    }

    /// Those of some placements at which the zone is reached as a whole, the best first.
    fn held(&self, works: &[WorkPlacement]) -> Vec<Candidate> {
        let grid = Grid::of(self.zone, CELLS[2]).outermost_first();
        // Where one pose is out of reach no other is looked at.
        let mut held = parallel::each(works, |work| self.candidate_below(*work, &grid, Score::ONE_OUT_OF_REACH));
        held.retain(|candidate| candidate.score.is_feasible());
        held.sort_by(|a, b| a.score.total_cmp(&b.score));
        held.truncate(MOST_ROLLS);
        held
    }

    /// The value at the centre of each placement, with its position in the list; infinite where it is not reached.
    fn centres(&self, works: &[WorkPlacement], of_one_turn: usize) -> Result<Vec<(f64, usize)>, Stopped> {
        let one_turn = |turn: usize, works: &[WorkPlacement]| {
            self.options.parts.go_on()?;
            let plane = WorkPlane::of(self.options.elevation, &works[0]);
            let orientation = self.freed.orientation(plane.tool()).under(plane.forces(self.options.load));
            let column = |part: fn(&WorkPlacement) -> f64| works.iter().map(part).collect::<Vec<f64>>();
            let (x, y, z) = (column(|work| work.x), vec![0.0; works.len()], column(|work| work.z));
            let mut configurations = vec![vec![0.0; works.len()]; Configuration::COUNT];
            let mut rows = configurations.iter_mut().map(Vec::as_mut_slice);
            let into = std::array::from_fn(|_| rows.next().expect("one row per configuration"));
            self.freed.configurations_at(&orientation, &SameBranch::default(), [&x, &y, &z], into);
            let best =
                |i: usize| configurations.iter().map(|configuration| configuration[i]).fold(f64::INFINITY, f64::min);
            Ok((0..works.len()).map(|i| (best(i), turn * of_one_turn + i)).collect::<Vec<_>>())
        };
        Ok(parallel::try_take_each(works.chunks(of_one_turn), one_turn)?.concat())
    }

    /// The first of a sorted list that are two steps or another turn apart.
    fn apart(&self, sorted: &[Candidate], most: usize) -> Vec<Candidate> {
        let mut chosen: Vec<Candidate> = Vec::new();
        for candidate in sorted {
            let near = |other: &Candidate| {
                let (a, b) = (&candidate.work, &other.work);
                let turned =
                    wrapped(a.yaw - b.yaw).abs() + wrapped(a.angle - b.angle).abs() + wrapped(a.roll - b.roll).abs();
                (a.x - b.x).hypot(a.z - b.z) < 2.0 * self.step
                    && turned < 0.8
                    && candidate.configuration == other.configuration
            };
            if !chosen.iter().any(near) {
                chosen.push(*candidate);
            }
            if chosen.len() == most {
                break;
            }
        }
        chosen
    }

    /// The window is too narrow for the zone at all turns that are tried.
    fn window_is_too_narrow(&self) -> bool {
        let Within { x, z } = self.options.within;
        self.turns().into_iter().all(|[yaw, angle, roll]| {
            let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw, angle, roll };
            let [ahead, _, up] = WorkPlane::of(self.options.elevation, &work).half_extents(self.zone);
            x.width() + tolerances::WINDOW < 2.0 * ahead || z.width() + tolerances::WINDOW < 2.0 * up
        })
    }

    /// Steps in every direction of what is free, halved where none is better.
    fn descend(&self, start: &Candidate, grid: &Grid, first_step: f64) -> Result<Candidate, Stopped> {
        let directions = directions(self.free());
        let steps = [first_step, 0.3 * first_step / self.step];
        descend(
            (self.candidate(start.work, grid), steps, self.options.parts),
            |candidate| candidate.score,
            |best, steps| {
                let moved = directions.iter().map(|way| self.moved(&best.work, way, steps));
                let each = others(&best.work, moved);
                each.into_iter().map(|work| self.candidate_below(work, grid, best.score)).collect()
            },
        )
    }
}

/// All combinations of steps -1, 0, 1 along what is free, but none at all; and between those of the place alone.
fn directions(free: [bool; 5]) -> Vec<[f64; 5]> {
    let mut directions = vec![[0.0; 5]];
    for (axis, _) in free.iter().enumerate().filter(|(_, free)| **free) {
        directions = directions
            .into_iter()
            .flat_map(|direction| {
                [0.0, 1.0, -1.0].map(|step| {
                    let mut direction = direction;
                    direction[axis] = step;
                    direction
                })
            })
            .collect();
    }
    directions.remove(0);
    for (x, z) in [(1.0, 0.5), (0.5, 1.0)] {
        directions.extend([(x, z), (x, -z), (-x, z), (-x, -z)].map(|(x, z)| [x, z, 0.0, 0.0, 0.0]));
    }
    directions
}
