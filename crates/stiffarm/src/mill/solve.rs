//! The best rolls along a path, for a part that stands somewhere.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::climb::{Goal, Node};
use super::contact::{Bodies, ClearOf, Guard};
use super::fault::{Blocked, MillError, Why};
use super::follow::{Arrangement, Pushed, Stand, follow};
use super::ladder::Ladder;
use super::smooth::smoothed;
use super::stations::{ErrorPart, Station};
use super::{is_pinned, worst};
use crate::batch::{RollGrid, SpatialArm};
use crate::inverse::Configuration;
use crate::mass::ToolWeight;
use crate::robot::Robot;
use crate::watch::Watch;

/// Rolls of the grid: steps of 2 deg, and of half a deg where these leave a doubt.
pub(super) const ROLLS: [usize; 2] = [180, 720];
/// By how much of its largest error a path may be worse for the sake of smoother joints.
const SPARE: f64 = 0.01;
/// How often a path is searched for at a slower pace where joints turn too fast between its rungs, and by how much more than that asks for.
const PACES: usize = 5;
const SLOWER: f64 = 0.98;
/// Constant and linear rolls that are followed at most before it is said that none is.
const MOST_TRIED: usize = 400;

/// How the tool may be turned about its axis along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RollMode {
    /// As is best, from sample to sample.
    #[default]
    Free,
    /// By one angle all along, the best.
    Constant,
    /// By an angle that changes evenly along the path, the best.
    Linear,
    /// By this angle, rad.
    Fixed(f64),
}

impl RollMode {
    /// As it is asked for; the angle of a fixed roll stands for itself.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Constant => "constant",
            Self::Linear => "linear",
            Self::Fixed(_) => "fixed",
        }
    }
}

/// What is asked of a path that is milled, besides where the part stands.
#[derive(Clone, Debug, PartialEq)]
pub struct MillOptions {
    /// Of the tool about its axis.
    pub roll: RollMode,
    /// What of the displacement counts.
    pub part: ErrorPart,
    /// What every joint keeps from its limits, rad.
    pub limit_margin: f64,
    /// What wrist and arm keep from straight, rad.
    pub singular_margin: f64,
    /// Of the joints' speeds what is used while cutting, at most.
    pub share_of_speed: f64,
    /// Weight of the tool, where it is known: it is compared with the robot's payload, and changes no posture.
    pub tool_weight: Option<ToolWeight>,
    /// What the arm keeps clear of; nothing is looked at where `None`.
    pub clear_of: Option<ClearOf>,
}

/// The robot at every station, or where and why there is no way.
pub(super) type Outcome = Result<Vec<Pushed>, Blocked>;

/// What is asked, made ready.
#[derive(Clone, Copy, Debug)]
pub(super) struct Question<'a> {
    pub(super) robot: &'a Robot,
    /// With margins taken from its limits.
    pub(super) arm: &'a SpatialArm,
    pub(super) stations: &'a [Station],
    pub(super) options: &'a MillOptions,
}

impl<'a> Question<'a> {
    /// The bodies of the arm before a part that stands somewhere; `None` where nobody asked what they touch, or it has no such bodies.
    pub(super) fn guard(&self, stand: &Stand, bodies: Bodies) -> Option<Guard<'a>> {
        let clear_of = self.options.clear_of.as_ref()?;
        Guard::of((self.robot, self.arm), self.stations, stand, (clear_of, bodies))
    }
}

impl Question<'_> {
    /// Over so many rolls.
    pub(super) fn ladder(&self, stand: &Stand, rolls: usize, watch: Watch) -> Result<Ladder<'_>, MillError> {
        let MillOptions { roll, part, share_of_speed, .. } = *self.options;
        let grid = if let RollMode::Fixed(roll) = roll { RollGrid::at([roll]) } else { RollGrid::turn(rolls) };
        Ladder::new(self.arm, self.stations, *stand, (part, grid), share_of_speed, watch)
    }

    /// The best over a ladder for a part that stands somewhere; inner: where and why there is none.
    pub(super) fn solve(&self, ladder: &mut Ladder, stand: &Stand, watch: Watch) -> Result<Outcome, MillError> {
        let guard = self.guard(stand, Bodies::Known);
        let mut found = self.over(ladder, stand, guard.as_ref(), watch)?;
        let Some(guard) = guard.filter(|guard| found.is_err() && guard.forbade()) else { return Ok(found) };
        ladder.unavoidable = ladder.never_clear(&guard)?;
        // Where none is clear, the best that touches nothing although it is nearer than was asked.
        if let Some(guard) = guard.that_only_touches_nothing() {
            ladder.unblock();
            found = self.over(ladder, stand, Some(&guard), watch)?;
        }
        // Where there is none either, the best of all is returned, with what it touches.
        if found.is_err() {
            ladder.unblock();
            found = self.over(ladder, stand, None, watch)?;
        }
        Ok(found)
    }

    /// The best over a ladder of what touches nothing, where that is asked.
    pub(super) fn over(
        &self,
        ladder: &mut Ladder,
        stand: &Stand,
        guard: Option<&Guard>,
        watch: Watch,
    ) -> Result<Outcome, MillError> {
        let courses = match self.options.roll {
            RollMode::Fixed(_) => ladder.constant_rolls(),
            RollMode::Constant => ladder.fine_constant_rolls()?,
            RollMode::Linear => ladder.linear_rolls(),
            RollMode::Free => return self.free(ladder, stand, guard, watch),
        };
        Ok(self.best_of(ladder, &courses, (stand, guard), watch)?.map(|(_, found)| found))
    }

    pub(super) fn follow(
        &self,
        stand: &Stand,
        arrangements: impl Iterator<Item = Arrangement>,
        watch: Watch,
    ) -> Result<Outcome, MillError> {
        follow((self.robot, self.arm), stand, self.stations, self.options.part, arrangements, watch)
    }

    /// The first of some courses, the best first, that is followed and touches nothing, and the robot along it.
    fn best_of(
        &self,
        ladder: &Ladder,
        courses: &[Course],
        (stand, guard): (&Stand, Option<&Guard>),
        watch: Watch,
    ) -> Result<Result<(Course, Vec<Pushed>), Blocked>, MillError> {
        let mut first = None;
        for course in courses.iter().take(MOST_TRIED) {
            if let Some(guard) = guard
                && guard.soon_touches(|i| course.at(self.stations, i))?
            {
                first = first.or(Some(ladder.touches()));
                continue;
            }
            match self.follow(stand, course.all(self.stations), watch)? {
                Ok(found) => match ladder.too_fast(&found) {
                    None if !is_clear(guard, &found, watch)? => first = first.or(Some(ladder.touches())),
                    None => return Ok(Ok((course.clone(), found))),
                    Some((i, _)) => first = first.or(Some(ladder.blocked_at(i, Why::Fast))),
                },
                Err(blocked) => first = first.or(Some(blocked)),
            }
        }
        Ok(Err(first.map_or_else(|| ladder.never_held(), Ok)?))
    }

    /// Of the paths whose largest error is nearly the least the smoothest, or the best constant roll where that is better.
    ///
    /// Of long paths memory holds one answer: of each that is tried its largest error is kept, and the best is followed again.
    fn free(
        &self,
        ladder: &mut Ladder,
        stand: &Stand,
        guard: Option<&Guard>,
        watch: Watch,
    ) -> Result<Outcome, MillError> {
        // No error needs to be larger than that of the best constant roll.
        let constant = if is_pinned(self.stations) {
            None
        } else {
            let found = self.best_of(ladder, &ladder.constant_rolls(), (stand, guard), watch)?.ok();
            found.map(|(course, found)| (worst(&found).0, Way::Course(course)))
        };
        let most = constant.as_ref().map_or(f32::MAX, |(worst, _)| (worst * (1.0 + 1e-6)) as f32);
        let mut blocked = None;
        for is_wound in [false, true] {
            ladder.pace = 1.0;
            match self.at_its_pace(ladder, (stand, guard), (most, is_wound), watch)? {
                Found::Paths(ways) => {
                    let best = best_way(ways.into_iter().chain(constant).collect());
                    return self.follow_way(ladder, stand, &best, watch);
                }
                Found::NotFollowed(why) => blocked = blocked.or(Some(why)),
                Found::Nothing(why) => {
                    blocked = blocked.or(Some(why));
                    break;
                }
            }
        }
        match constant {
            Some((_, way)) => self.follow_way(ladder, stand, &way, watch),
            None => Ok(Err(blocked.unwrap_or_else(|| ladder.blocked_at(0, Why::Jump)))),
        }
    }

    fn follow_way(&self, ladder: &Ladder, stand: &Stand, way: &Way, watch: Watch) -> Result<Outcome, MillError> {
        match way {
            Way::Course(course) => self.follow(stand, course.all(self.stations), watch),
            Way::Rungs(rungs) => self.follow(stand, ladder.of_stations(rungs), watch),
        }
    }

    /// The smoothest of the best paths, as it goes between the lines of the grid and on them; where joints turn too fast between its rungs, that
    /// of a pace that is slower by as much.
    fn at_its_pace(
        &self,
        ladder: &mut Ladder,
        (stand, guard): (&Stand, Option<&Guard>),
        (most, is_wound): (f32, bool),
        watch: Watch,
    ) -> Result<Found, MillError> {
        let mut blocked = None;
        for _ in 0..PACES {
            let (path, most) = match ladder.smoothest(guard, (most, is_wound), watch)? {
                Ok(found) => found,
                Err(_) if guard.is_some_and(Guard::forbade) => return Ok(Found::Nothing(ladder.touches())),
                Err(rung) if blocked.is_none() => return Ok(Found::Nothing(ladder.why_blocked(rung, watch)?)),
                Err(_) => break,
            };
            let rough = ladder.arrangements(&path);
            // Where the smoothest touches something, that which keeps clear at every step.
            let (mut kept, mut least, mut keeps) = (Vec::new(), f64::INFINITY, None);
            let mut ways = vec![rough.clone(), smoothed(ladder, rough.clone(), f64::from(most), None, watch)?];
            while let Some(way) = ways.pop().map(Way::Rungs) {
                match self.follow_way(ladder, stand, &way, watch)? {
                    Err(why) => blocked = blocked.or(Some(why)),
                    Ok(found) => match ladder.too_fast(&found) {
                        None if !is_clear(guard, &found, watch)? => {
                            if keeps.is_none() {
                                keeps = guard;
                                ways.push(smoothed(ladder, rough.clone(), f64::from(most), guard, watch)?);
                            }
                        }
                        None => kept.push((worst(&found).0, way)),
                        Some((i, times)) => {
                            blocked = Some(ladder.blocked_at(i, Why::Fast));
                            least = least.min(times);
                        }
                    },
                }
            }
            if !kept.is_empty() {
                return Ok(Found::Paths(kept));
            }
            if least == f64::INFINITY {
                break;
            }
            ladder.pace *= SLOWER / least;
        }
        Ok(Found::NotFollowed(blocked.unwrap_or_else(|| ladder.blocked_at(0, Why::Jump))))
    }
}

/// What becomes of paths over a ladder.
enum Found {
    /// Some are followed, the smoothest first, with their largest errors, m.
    Paths(Vec<(f64, Way)>),
    /// There are some, and none is followed from sample to sample.
    NotFollowed(Blocked),
    /// There are none.
    Nothing(Blocked),
}

/// The first of some paths, the smoothest first, whose largest error is nearly the least.
fn best_way(found: Vec<(f64, Way)>) -> Way {
    let least = found.iter().map(|(worst, _)| *worst).fold(f64::INFINITY, f64::min);
    let best = found.into_iter().find(|(worst, _)| *worst <= least * (1.0 + SPARE));
    best.expect("one of them has the least").1
}

/// A path that is followed touches nothing, or nobody asked.
fn is_clear(guard: Option<&Guard>, found: &[Pushed], watch: Watch) -> Result<bool, MillError> {
    guard.map_or(Ok(true), |guard| guard.is_clear(found, watch))
}

/// A configuration for every run of the path, and a roll that changes evenly along the way.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// By station at which a run begins.
    configurations: Vec<(usize, Configuration)>,
    roll: f64,
    /// rad/m.
    change: f64,
}

/// How the robot stands all along a path.
#[derive(Clone, Debug)]
enum Way {
    Course(Course),
    /// At every rung.
    Rungs(Vec<Arrangement>),
}

impl Course {
    fn configuration_at(&self, i: usize) -> Configuration {
        let run = self.configurations.partition_point(|(from, _)| *from <= i).saturating_sub(1);
        self.configurations[run].1
    }

    fn all(&self, stations: &[Station]) -> impl Iterator<Item = Arrangement> {
        (0..stations.len()).map(|i| self.at(stations, i))
    }

    fn at(&self, stations: &[Station], i: usize) -> Arrangement {
        let way = stations[i].sample.way - stations[0].sample.way;
        Arrangement { configuration: self.configuration_at(i), roll: self.roll + self.change * way }
    }
}

impl Ladder<'_> {
    /// The rungs of every run: from one that is fresh to the next.
    pub(super) fn runs(&self) -> Vec<Range<usize>> {
        let mut starts: Vec<usize> = (0..self.rungs.len()).filter(|k| *k == 0 || self.rungs[*k].is_fresh).collect();
        starts.push(self.rungs.len());
        starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
    }

    /// Every constant roll that some configurations hold, the best first.
    pub(super) fn constant_rolls(&self) -> Vec<Course> {
        self.courses((0..self.grid.len()).map(|roll| (roll, 0.0)))
    }

    /// The same with the best one searched for between the lines of the grid, too.
    fn fine_constant_rolls(&self) -> Result<Vec<Course>, MillError> {
        const FINE: usize = 40;
        let courses = self.constant_rolls();
        let Some(best) = courses.first() else { return Ok(courses) };
        let roll = |i: usize| best.roll + self.grid.step() * (i as f64 / FINE as f64 - 1.0);
        let rolls: Vec<f64> = (0..=2 * FINE).map(roll).collect();
        let mut worst = vec![0.0_f64; rolls.len()];
        for k in 0..self.rungs.len() {
            let configuration = best.configuration_at(self.rungs[k].samples.start);
            let errors = self.errors_of(k, Arrangement { configuration, roll: best.roll }, &rolls)?;
            worst.iter_mut().zip(errors).for_each(|(worst, error)| *worst = worst.max(error));
        }
        let mut fine: Vec<(f64, f64)> = worst.into_iter().zip(rolls).filter(|(error, _)| error.is_finite()).collect();
        fine.sort_by(|a, b| a.0.total_cmp(&b.0));
        let fine = fine.into_iter().map(|(_, roll)| Course { roll, ..best.clone() });
        Ok(fine.chain(courses.iter().skip(1).cloned()).collect())
    }

    /// Rolls that change evenly by up to half a turn either way.
    fn linear_rolls(&self) -> Vec<Course> {
        const CHANGES: i32 = 45;
        let (first, last) = (&self.stations[0].sample, &self.stations[self.stations.len() - 1].sample);
        let length = (last.way - first.way).max(1e-9);
        let change = |i: i32| PI * f64::from(i) / f64::from(CHANGES) / length;
        self.courses((0..self.grid.len()).flat_map(|roll| (-CHANGES..=CHANGES).map(move |i| (roll, change(i)))))
    }

    /// Of rolls (an index of the grid and a change, rad/m) those that are held, the best first: for every run its best configuration, or
    /// one for all where that is nearly as good.
    fn courses(&self, rolls: impl Iterator<Item = (usize, f64)>) -> Vec<Course> {
        let runs = self.runs();
        let start = self.stations[0].sample.way;
        let mut best = f32::INFINITY;
        let mut found: Vec<(f32, Course)> = Vec::new();
        for (roll, change) in rolls {
            let at = |k: usize| {
                let turned = change * (self.stations[self.rungs[k].at].sample.way - start) / self.grid.step();
                (roll as f64 + turned).round().rem_euclid(self.grid.len() as f64) as usize % self.grid.len()
            };
            // The worst of every run by configuration; what is far above the best needs no exact number.
            let enough = best * 1.5;
            let mut by_run = Vec::with_capacity(runs.len());
            for run in &runs {
                let mut worst = [0.0_f32; Configuration::COUNT];
                for k in run.clone() {
                    let roll = at(k);
                    (0..Configuration::COUNT).for_each(|c| worst[c] = worst[c].max(self.rungs[k].errors[c][roll]));
                    if worst.iter().all(|worst| enough < *worst) {
                        break;
                    }
                }
                by_run.push(worst);
            }
            let of_all = |c: usize| by_run.iter().map(|worst| worst[c]).fold(0.0, f32::max);
            let one = (0..Configuration::COUNT).min_by(|a, b| of_all(*a).total_cmp(&of_all(*b))).unwrap_or(0);
            let least = |worst: &[f32; 8]| (0..8).min_by(|a, b| worst[*a].total_cmp(&worst[*b])).unwrap_or(0);
            let several = by_run.iter().map(|worst| worst[least(worst)]).fold(0.0, f32::max);
            let (error, configurations) = if of_all(one) <= several * (1.0 + SPARE as f32) {
                (of_all(one), vec![(0, Configuration::ALL[one])])
            } else {
                let of = |(run, worst): (&Range<usize>, &[f32; 8])| {
                    (self.rungs[run.start].samples.start, Configuration::ALL[least(worst)])
                };
                (several, runs.iter().zip(&by_run).map(of).collect())
            };
            if error < f32::INFINITY {
                best = best.min(error);
                found.push((error, Course { configurations, roll: self.grid.roll(roll), change }));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.into_iter().map(|(_, course)| course).collect()
    }

    /// Of the paths whose largest error is nearly the least, and no more than `most`, that whose joints move least, and what error it
    /// may have, m; the first rung that none reaches where there is none.
    pub(super) fn smoothest(
        &mut self,
        guard: Option<&Guard>,
        (most, is_wound): (f32, bool),
        watch: Watch,
    ) -> Result<Result<(Vec<Node>, f32), usize>, MillError> {
        let floor = self.floor();
        let mut path_to = |goal: Goal, most: f32| self.clear_path(guard, (goal, most, is_wound), watch);
        // What is spared of the least error is no less than `most` where that is near what no path goes below.
        if f64::from(most) <= (1.0 + SPARE) * f64::from(floor)
            && let Ok((path, _)) = path_to(Goal::LeastMotion, most)?
        {
            return Ok(Ok((path, most)));
        }
        let (path, least) = match path_to(Goal::LeastError, most)? {
            Ok(found) => found,
            Err(rung) => return Ok(Err(rung)),
        };
        let most = ((least * (1.0 + SPARE)) as f32).min(most);
        let smooth = path_to(Goal::LeastMotion, most)?;
        Ok(Ok((smooth.map_or(path, |found| found.0), most)))
    }

    /// A path of nodes as configurations and rolls, which go on over whole turns.
    fn arrangements(&self, path: &[Node]) -> Vec<Arrangement> {
        let mut found: Vec<Arrangement> = Vec::with_capacity(path.len());
        for (Node { configuration, roll }, rung) in path.iter().zip(&self.rungs) {
            let mut roll = self.roll_of(rung, *roll);
            if let Some(before) = found.last() {
                roll += TAU * ((before.roll - roll) / TAU).round();
            }
            found.push(Arrangement { configuration: Configuration::ALL[*configuration], roll });
        }
        found
    }

    /// From the arrangement of every rung to that of every station: rolls change evenly along the way, but where the arm is arranged anew.
    fn of_stations(&self, rungs: &[Arrangement]) -> impl Iterator<Item = Arrangement> {
        let each = (0..self.rungs.len()).flat_map(|k| self.rungs[k].samples.clone().map(move |i| (k, i)));
        each.map(|(k, i)| self.of_station(&|k| rungs[k], k, i))
    }

    /// That of a station of a rung, of the arrangements of this rung and those beside it.
    pub(super) fn of_station(&self, rungs: &impl Fn(usize) -> Arrangement, k: usize, i: usize) -> Arrangement {
        let rung = &self.rungs[k];
        let other = if i < rung.at {
            k.checked_sub(1).filter(|_| !rung.is_fresh)
        } else {
            Some(k + 1).filter(|next| self.rungs.get(*next).is_some_and(|next| !next.is_fresh))
        };
        let way = |k: usize| self.stations[self.rungs[k].at].sample.way;
        let share = other.map_or(0.0, |other| {
            let length = way(other) - way(k);
            if length == 0.0 { 0.0 } else { (self.stations[i].sample.way - way(k)) / length }
        });
        let here = rungs(k);
        let roll = here.roll + share * other.map_or(0.0, |other| rungs(other).roll - here.roll);
        Arrangement { roll, ..here }
    }
}
