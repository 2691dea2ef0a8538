//! What is missing where a tolerance is not kept, and what is left where it is: force, stiffness, size, and which drive.
//!
//! Force and stiffness follow from one placement, for every deflection grows with the force, and shrinks with the stiffness of all
//! drives, in proportion: the best place stays the best. The largest zone is searched for by placing smaller ones.

use crate::load::Load;
use crate::model::Model;
use crate::parallel;
use crate::place::{Hold, NOTHING, PlaceError, PlaceOptions, Placed, Placement, find, place};
use crate::rank::{RankError, Ranking, Row};
use crate::robot::{Arm, Robot};
use crate::task::Work;
use crate::watch::Watch;

/// What a compensation of the program is taken to take out of the deflection: a part that is assumed, not known.
pub const COMPENSATED: f64 = 0.8;
/// Of a ranking so many robots get advice: the best of those that take a rank.
pub const ADVISED: usize = 3;
/// No zone is tried that is smaller than this part of the size that was asked for.
pub const SMALLEST: f64 = 0.02;

/// What a placement says against a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// The largest deflection that is acceptable, m.
    pub tolerance: f64,
    /// What the best place says; `None` where there is none.
    pub at_place: Option<AtPlace>,
    /// The largest zone of the shape that passes; `None` where the zone that was asked for does.
    pub zone: Option<LargestZone>,
}

/// What the best place of a zone says against a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct AtPlace {
    /// So many times the force keeps the tolerance there, exactly: below 1 what is missing, above 1 the reserve. `None` where nothing gives
    /// way.
    pub force_factor: Option<f64>,
    /// No place keeps it under more, by the lower bound; `None` where nothing is proved.
    pub force_factor_bound: Option<f64>,
    /// So many times as stiff must all drives be (one beside a gravity compensator together with that).
    pub stiffness_factor: f64,
    /// The stiffness of each drive that this asks for, N m/rad; `None` of rigid drives, and of drive 2 beside a gravity compensator.
    pub needed: [Option<f64>; 6],
    /// What each drive gives of the deflection at the worst point along its direction, adding up to 1; `None` of those that the model does
    /// not know.
    pub shares: [Option<f64>; 6],
    /// What is left of the deflection, m, if [`COMPENSATED`] of it is taken out.
    pub compensated: f64,
}

/// The largest zone of a shape that keeps a tolerance, as far as that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestZone {
    /// Its size as a part of the size that was asked for, and its deflection, m: it has a place that was found. `None` where the smallest that
    /// was tried, [`SMALLEST`] of that size, has none.
    pub holds: Option<(f64, f64)>,
    /// The smallest part of that size that was tried and does not keep the tolerance.
    pub fails_at: f64,
    /// That is proved, of all places; else no place was found that does.
    pub is_proved: bool,
    /// How many zones were placed for it.
    pub tried: usize,
}

impl AtPlace {
    fn of(model: &Model, best: &Placement, load: Load, tolerance: f64) -> Result<Self, PlaceError> {
        let factor = |deflection: f64| (NOTHING < deflection).then(|| tolerance / deflection);
        let stiffness_factor = best.deflection / tolerance;
        Ok(Self {
            force_factor: factor(best.deflection),
            force_factor_bound: factor(best.lower_bound),
            stiffness_factor,
            needed: needed(model.robot(), stiffness_factor),
            shares: shares(model, best, load)?,
            compensated: (1.0 - COMPENSATED) * best.deflection,
        })
    }

    /// The drive, from 1, that gives most at the worst point, and its share; `None` where nothing gives way.
    pub fn softest(&self) -> Option<(usize, f64)> {
        let known = self.shares.iter().enumerate().filter_map(|(drive, share)| Some((drive + 1, (*share)?)));
        known.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, share)| 0.0 < *share)
    }
}

/// What a placement of work says against a tolerance, m.
///
/// Where it is not kept, smaller zones of the shape are placed: a flat zone contains every smaller one, so that what is proved not to hold
/// proves it of all larger zones, too. (Faces of a part move together when it shrinks; of a part that is only known of the sizes that were
/// tried.) At most some 30 are placed in the plane, to 0.1 % of the size, and 8 in space, to 1 %; 6 of a part, to 3 %.
///
/// # Errors
/// As [`place`]. A search that does not end ends the search for the largest zone, and is none.
pub fn advise(
    model: &Model,
    work: &Work,
    options: &PlaceOptions,
    placed: &Placed,
    tolerance: f64,
    watch: Watch,
) -> Result<Advice, PlaceError> {
    let best = placed.feasible();
    let passes = best.is_some_and(|best| best.deflection <= tolerance);
    let zone = if passes {
        None
    } else {
        Some(ZoneSearch { model, work, options, tolerance, watch: watch.of_part() }.largest(placed)?)
    };
    let at_place = best.map(|best| AtPlace::of(model, best, options.load, tolerance)).transpose()?;
    Ok(Advice { tolerance, at_place, zone })
}

/// The same for the best robots of a ranking, [`ADVISED`] of those that take a rank: a row for each of its rows, a column for each task.
///
/// # Errors
/// As [`rank`](crate::rank::rank).
pub fn advise_best(
    ranking: &Ranking,
    options: &PlaceOptions,
    tolerance: f64,
    watch: Watch,
) -> Result<Vec<Vec<Option<Advice>>>, RankError> {
    let ranked = ranking.rows.iter().enumerate().filter(|(_, row)| row.rank.is_some());
    let chosen: Vec<(usize, &Row)> = ranked.take(ADVISED).collect();
    let pairs: Vec<(usize, &Row, usize)> =
        chosen.iter().flat_map(|&(at, row)| (0..ranking.tasks.len()).map(move |task| (at, row, task))).collect();
    let parts = watch.parts(Some(pairs.len()));
    let one = |&(at, row, task): &(usize, &Row, usize)| {
        let asked = &ranking.tasks[task];
        let failed = |error| RankError { robot: row.robot.name.clone(), task: asked.label.clone(), error };
        // Of a search that did not end there is nothing to say.
        let Ok(placed) = &row.cells[task] else { return Ok((at, task, None)) };
        let model = ranking.model.of(&row.robot).map_err(|error| failed(error.into()))?;
        let advice = advise(&model, &asked.work, options, placed, tolerance, watch.of_part()).map_err(failed)?;
        parts.one_more().map_err(|error| failed(error.into()))?;
        Ok((at, task, Some(advice)))
    };
    let found = parallel::try_each(&pairs, one)?;
    let mut advised = vec![vec![None; ranking.tasks.len()]; ranking.rows.len()];
    for (at, task, advice) in found {
        advised[at][task] = advice;
    }
    Ok(advised)
}

/// The stiffness of each drive, N m/rad, so many times what it has.
fn needed(robot: &Robot, factor: f64) -> [Option<f64>; 6] {
    let compensated = matches!(&robot.arm, Arm::SixAxis { drives, .. } if drives.compensator.is_some());
    let mut needed = robot.drive_compliance().map(|k| k.filter(|k| 0.0 < *k).map(|k| factor / k));
    if compensated {
        needed[1] = None;
    }
    needed
}

/// What each drive gives at the worst point.
fn shares(model: &Model, best: &Placement, load: Load) -> Result<[Option<f64>; 6], PlaceError> {
    Ok(match (model, &best.hold) {
        (_, Hold::Space(hold)) => hold.shares.map(Some),
        (Model::Planar(model), Hold::Plane { posture: [shoulder, elbow], by_drive, .. }) => {
            let arm = model.arm();
            let (force, counted) = match load.sector()? {
                None => {
                    let (_, worst) = arm.worst_direction(*shoulder, *elbow);
                    (worst, worst)
                }
                Some(sector) => {
                    let most = sector.largest(&arm.compliance(*shoulder, *elbow));
                    (most.force, most.counted)
                }
            };
            let [second, third] = by_drive[0].map(|part| counted.dot(&(part * force)));
            let whole = second + third;
            let share = |part: f64| Some(if 0.0 < whole { part / whole } else { 0.0 });
            [None, share(second), share(third), None, None, None]
        }
        (Model::Spatial(_), Hold::Plane { .. }) => [None; 6],
    })
}

/// How finely the largest zone is searched for, relative to its size, and how many zones are placed for that.
fn effort(model: &Model, work: &Work) -> (f64, usize) {
    match (model, work) {
        (Model::Planar(_), _) => (1e-3, 30),
        (Model::Spatial(_), Work::Zone(_)) => (1e-2, 8),
        (Model::Spatial(_), Work::Part(_)) => (3e-2, 6),
    }
}

/// What the largest zone is placed with.
struct ZoneSearch<'a> {
    model: &'a Model,
    work: &'a Work,
    options: &'a PlaceOptions,
    tolerance: f64,
    watch: Watch<'a>,
}

/// What is known of one size of a zone.
#[derive(Clone, Copy, Debug)]
enum Tried {
    /// It keeps the tolerance with this deflection, m.
    Holds(f64),
    /// It does not; the deflection of the best place that was found, m, and whether it is proved that no place does.
    Fails(Option<f64>, bool),
}

impl ZoneSearch<'_> {
    /// Between the smallest size and the one that was asked for, which does not hold.
    fn largest(&self, placed: &Placed) -> Result<LargestZone, PlaceError> {
        let (resolution, most) = effort(self.model, self.work);
        let (mut fails_at, mut failed) = (1.0, self.judged(placed));
        let mut tried = 1;
        let mut holds = match self.at(SMALLEST)? {
            Some(Tried::Holds(deflection)) => (SMALLEST, deflection),
            smallest => {
                let (fails_at, failed) = smallest.map_or((fails_at, failed), |smallest| (SMALLEST, smallest));
                let is_proved = matches!(failed, Tried::Fails(_, true));
                return Ok(LargestZone { holds: None, fails_at, is_proved, tried });
            }
        };
        while resolution * fails_at < fails_at - holds.0 && tried < most {
            let scale = self.between(holds, (fails_at, failed), resolution, tried);
            tried += 1;
            match self.at(scale)? {
                Some(Tried::Holds(deflection)) => holds = (scale, deflection),
                Some(found) => (fails_at, failed) = (scale, found),
                None => break,
            }
        }
        let is_proved = matches!(failed, Tried::Fails(_, true));
        Ok(LargestZone { holds: Some(holds), fails_at, is_proved, tried })
    }

    /// The size that is tried next: where a straight line between both deflections meets the tolerance, or, on every third try and where one
    /// is not known, in the middle; so far from the nearer end that the answer is as fine as it need be, whichever way the try ends.
    fn between(&self, (from, low): (f64, f64), (to, failed): (f64, Tried), resolution: f64, tried: usize) -> f64 {
        let guess = match failed {
            Tried::Fails(Some(high), _) if !tried.is_multiple_of(3) && low < high => {
                from + (to - from) * (self.tolerance - low) / (high - low)
            }
            _ => f64::midpoint(from, to),
        };
        let least = (0.9 * resolution * to).min((to - from) / 2.0);
        guess.clamp(from + least, to - least)
    }

    /// A zone of this part of the size; `None` where the search does not end.
    fn at(&self, scale: f64) -> Result<Option<Tried>, PlaceError> {
        let work = self.work.scaled(scale);
        let found = match (self.model, &work) {
            // The place alone: what stands in the way where there is none would cost more.
            (Model::Planar(_), Work::Zone(zone)) => {
                find(self.model, *zone, self.options, self.watch).map(|best| match best {
                    Some(best) => self.judged(&Placed::Feasible(best)),
                    None => Tried::Fails(None, true),
                })
            }
            _ => place(self.model, &work, self.options, self.watch).map(|placed| self.judged(&placed)),
        };
        match found {
            Err(PlaceError::Unfinished { .. }) => Ok(None),
            found => found.map(Some),
        }
    }

    fn judged(&self, placed: &Placed) -> Tried {
        match placed {
            Placed::Feasible(best) if best.deflection <= self.tolerance => Tried::Holds(best.deflection),
            Placed::Feasible(best) => Tried::Fails(Some(best.deflection), self.tolerance < best.lower_bound),
            Placed::Infeasible { is_proved, .. } => Tried::Fails(None, *is_proved),
        }
    }
}
