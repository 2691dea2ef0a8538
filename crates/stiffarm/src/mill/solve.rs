//! The best rolls along a path, for a part that stands somewhere.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::climb::{Climb, Node, Sought};
use super::fault::{Blocked, MillError, Why};
use super::follow::{Arrangement, Pushed, Stand, follow};
use super::is_pinned;
use super::ladder::Ladder;
use super::smooth::smoothed;
use super::stations::{ErrorPart, Station};
use crate::batch::{RollGrid, SpatialArm};
use crate::inverse::Configuration;
use crate::robot::Robot;
use crate::watch::Watch;

/// Rolls of the grid: steps of 2 deg.
const ROLLS: usize = 180;
/// By how much of its largest error a path may be worse for the sake of smoother joints.
const SPARE: f64 = 0.01;
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
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Mass of the tool, kg, where it is known: it is told against the robot's payload, and changes no posture.
    pub tool_mass: Option<f64>,
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

impl Question<'_> {
    /// The best rolls for a part that stands somewhere; inner: where and why there are none.
    pub(super) fn solve(&self, stand: &Stand, watch: Watch) -> Result<(Ladder<'_>, Outcome), MillError> {
        let MillOptions { roll, part, share_of_speed, .. } = *self.options;
        let grid = if let RollMode::Fixed(roll) = roll { RollGrid::at([roll]) } else { RollGrid::turn(ROLLS) };
        let ladder = Ladder::new(self.arm, self.stations, *stand, (part, grid), share_of_speed, watch)?;
        let found = match roll {
            RollMode::Fixed(_) => self.best_of(&ladder, &ladder.constant_rolls(), stand),
            RollMode::Constant => self.best_of(&ladder, &ladder.fine_constant_rolls()?, stand),
            RollMode::Linear => self.best_of(&ladder, &ladder.linear_rolls(), stand),
            RollMode::Free => self.free(&ladder, stand, watch),
        };
        Ok((ladder, found?))
    }

    pub(super) fn follow(
        &self,
        stand: &Stand,
        arrangement: impl Fn(usize) -> Arrangement,
    ) -> Result<Outcome, MillError> {
        follow((self.robot, self.arm), stand, self.stations, self.options.part, arrangement)
    }

    /// The first of some courses, the best first, that is followed.
    fn best_of(&self, ladder: &Ladder, courses: &[Course], stand: &Stand) -> Result<Outcome, MillError> {
        let mut first = None;
        for course in courses.iter().take(MOST_TRIED) {
            match self.follow(stand, |i| course.at(self.stations, i))? {
                Ok(found) => match ladder.too_fast(&found, 1.0) {
                    None => return Ok(Ok(found)),
                    Some(i) => first = first.or(Some(ladder.blocked_at(i, Why::Fast))),
                },
                Err(blocked) => first = first.or(Some(blocked)),
            }
        }
        Ok(Err(first.map_or_else(|| ladder.never_held(), Ok)?))
    }

    /// The path whose largest error is least, and of those nearly as good the smoothest.
    fn free(&self, ladder: &Ladder, stand: &Stand, watch: Watch) -> Result<Outcome, MillError> {
        // No error needs to be larger than that of the best constant roll.
        let constant =
            if is_pinned(self.stations) { None } else { self.best_of(ladder, &ladder.constant_rolls(), stand)?.ok() };
        let most = constant.as_ref().map_or(f32::MAX, |found| (worst(found) * (1.0 + 1e-6)) as f32);
        for is_wound in [false, true] {
            let (path, most) = match ladder.smoothest(most, is_wound, watch)? {
                Ok(found) => found,
                Err(rung) => match constant {
                    Some(found) => return Ok(Ok(found)),
                    None => return Ok(Err(ladder.why_blocked(rung, watch)?)),
                },
            };
            let rough = ladder.arrangements(&path);
            let fine = smoothed(ladder, rough.clone(), f64::from(most), watch)?;
            let followed = |rungs: &[Arrangement]| {
                let all = ladder.of_stations(rungs);
                self.follow(stand, |i| all[i])
            };
            // Between the rungs joints may turn faster than from rung to rung: never faster than the machine can.
            let full_speed = 1.0 / self.options.share_of_speed;
            let keeps_speeds = |found: &Vec<Pushed>| ladder.too_fast(found, full_speed).is_none();
            let found: Vec<Vec<Pushed>> =
                [followed(&fine)?, followed(&rough)?].into_iter().flatten().filter(keeps_speeds).collect();
            if found.is_empty() && !is_wound {
                continue;
            }
            let best = found.into_iter().chain(constant.clone()).min_by(|a, b| {
                // Errors that hardly differ are alike: then the first, which is the smoothest.
                if (worst(a) / worst(b) - 1.0).abs() <= SPARE {
                    std::cmp::Ordering::Equal
                } else {
                    worst(a).total_cmp(&worst(b))
                }
            });
            if let Some(best) = best {
                return Ok(Ok(best));
            }
        }
        Ok(Err(ladder.blocked_at(0, Why::Jump)))
    }
}

/// The largest error of a path, m.
pub(super) fn worst(found: &[Pushed]) -> f64 {
    found.iter().map(|pushed| pushed.error).fold(0.0, f64::max)
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

impl Course {
    fn configuration_at(&self, i: usize) -> Configuration {
        let run = self.configurations.partition_point(|(from, _)| *from <= i).saturating_sub(1);
        self.configurations[run].1
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

    /// The same with the best one sought between the lines of the grid, too.
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
        &self,
        most: f32,
        is_wound: bool,
        watch: Watch,
    ) -> Result<Result<(Vec<Node>, f32), usize>, MillError> {
        let sought = |sought: Sought, most: f32| Climb::new(self, sought, most, is_wound).path(watch);
        // What is spared of the least error is no less than `most` where that is near what no path goes below.
        if f64::from(most) <= (1.0 + SPARE) * f64::from(self.floor())
            && let Ok((path, _)) = sought(Sought::LeastMotion, most)?
        {
            return Ok(Ok((path, most)));
        }
        let (path, least) = match sought(Sought::LeastError, most)? {
            Ok(found) => found,
            Err(rung) => return Ok(Err(rung)),
        };
        let most = ((least * (1.0 + SPARE)) as f32).min(most);
        let smooth = sought(Sought::LeastMotion, most)?;
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
    pub(super) fn of_stations(&self, rungs: &[Arrangement]) -> Vec<Arrangement> {
        let mut found = Vec::with_capacity(self.stations.len());
        for (k, rung) in self.rungs.iter().enumerate() {
            for i in rung.samples.clone() {
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
                let roll = rungs[k].roll + share * other.map_or(0.0, |other| rungs[other].roll - rungs[k].roll);
                found.push(Arrangement { roll, ..rungs[k] });
            }
        }
        found
    }
}
