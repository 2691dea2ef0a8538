//! Where must a part stand, so that the largest error along its path is least?
//!
//! Searched: where, and how far the part is turned about the vertical. Where nothing says where about the joint-1 axis the part may stand,
//! it is placed straight ahead; in a cell it is placed in the cell (`ground`). First over all of these on some samples (those that lie outermost, those under the largest forces,
//! some in between), then step by step from the best, then along the whole path, whose worst sample joins the others. Proved: a
//! lower bound by branch and bound over the places, on the same samples, each at its own best roll.

mod ground;
mod proof;

use std::f64::consts::TAU;

pub use ground::PathGround;
use ground::{Coarse, Place, Site};
use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};

use super::fault::{Blocked, MillError};
use super::follow::Stand;
use super::ladder::Ladder;
use super::solve::{self, MillOptions, Question, RollMode};
use super::stations::{Station, check_normals};
use super::{Followed, Milled, arm_with_margins, is_pinned};
use crate::batch::{RollGrid, SpatialArm};
use crate::clearance::Surroundings;
use crate::enclose::ArmEnclosure;
use crate::inverse::Configuration;
use crate::parallel;
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::watch::Watch;

/// Rolls of the coarse search and of the steps.
const ROLLS: [usize; 2] = [24, 60];
/// Places from which steps are taken.
const STARTS: usize = 6;
/// Where none of these leads to a place at which the path is followed, so many further ones are looked at, and steps are taken from so many of them at
/// which it is.
const FURTHER: usize = 200;
const DESCENTS: usize = 2;
/// Where the best place touches something, so many others are looked at for one that does not.
const CLEAR_TRIED: usize = 12;
/// Steps are halved so often: from a tenth of the range to a millimetre or so.
const HALVINGS: usize = 8;
/// How often the worst sample of the whole path joins the others.
const ROUNDS: usize = 4;
/// Samples in between that are looked at.
const BETWEEN: usize = 6;

/// Where the origin of a path stands: m in the axes of the cell, which are those of the base where there is none, and the turn about the
/// vertical, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartPlacement {
    /// Ahead, to the left, up.
    pub at: [f64; 3],
    /// From the cell's x axis to that of the part, counter-clockwise seen from above.
    pub yaw: f64,
    /// The cell in the base frame.
    pub base_from_cell: Pose,
}

impl PartPlacement {
    /// As seen from a base that stands alone.
    pub fn from_base(at: [f64; 3], yaw: f64) -> Self {
        Self { at, yaw, base_from_cell: Pose::identity() }
    }

    /// The part in the base frame.
    pub fn base_from_part(&self) -> Pose {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.yaw);
        self.base_from_cell * Pose::from_parts(Translation3::from(Vector3::from(self.at)), turn)
    }
}

/// The best place of a path that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPlaced {
    /// Where.
    pub placement: PartPlacement,
    /// What happens there.
    pub milled: Milled,
    /// No place that is allowed has a smaller largest error, m; 0 where nothing is proved.
    pub lower_bound: f64,
    /// How fine the search was.
    pub resolution: PathResolution,
}

/// How finely a place was looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathResolution {
    /// Places of the coarse search in every window: along x (or away from the joint-1 axis), along y (or about it), up, and turned about the vertical.
    pub coarse: [usize; 4],
    /// The last step, m.
    pub step: f64,
    /// Samples that stood for the path.
    pub samples: usize,
    /// Nodes of the proof.
    pub nodes: usize,
}

/// What stays the same from place to place.
struct Search<'a> {
    arm: SpatialArm,
    enclosure: ArmEnclosure,
    stations: &'a [Station],
    options: &'a MillOptions,
    flange_from_tool: Pose,
    site: Site,
    /// What stands about the robot, and the bodies of the work, in the frame of the part.
    about: Option<Surroundings>,
    /// The middle of the path, part frame, m.
    middle: Vector3<f64>,
    /// Stations that stand for the path.
    keys: Vec<usize>,
    /// Of every station, how often the arm may have been arranged anew before it.
    runs: Vec<usize>,
}

/// A place from which steps are taken, with its largest error and the steps of the search that found it.
#[derive(Clone, Copy)]
struct Start {
    value: f64,
    place: Place,
    apart: Place,
    by: Rolls,
}

/// By which rolls a place is judged before the path is followed there.
#[derive(Clone, Copy)]
enum Rolls {
    /// The best at each sample: no more than the error, and less where no way leads from one to the next.
    BestOfEach,
    /// The best that all samples share: where the roll may change, no less than the error.
    OneForAll,
}

impl Rolls {
    /// Those that show where a path is followed best; where the roll may change, neither of the two alone does.
    const fn of(mode: RollMode) -> &'static [Self] {
        match mode {
            RollMode::Free | RollMode::Linear => &[Self::BestOfEach, Self::OneForAll],
            RollMode::Constant => &[Self::OneForAll],
            RollMode::Fixed(_) => &[Self::BestOfEach],
        }
    }
}

/// Places from which steps are taken, for each way of judging them.
type ByRolls = Vec<(Rolls, Vec<Start>)>;

/// The best place so far at which the path was followed, with its error, and where it is not followed what came farthest.
struct Sought {
    best: Option<(f64, Place, Followed)>,
    nearest: Option<Blocked>,
}

/// Finds the best place of a path.
///
/// # Errors
/// As [`super::mill`]; a window of which the margins leave nothing is an answer like any place that is not held.
pub fn place_path(
    robot: &Robot,
    flange_from_tool: &Pose,
    stations: &[Station],
    (options, ground): (&MillOptions, &PathGround),
    watch: Watch,
) -> Result<Result<PathPlaced, Option<Blocked>>, MillError> {
    if is_pinned(stations) {
        return Err(MillError::PinnedElse);
    }
    check_normals(stations, options.part)?;
    let search = Search::new(robot, flange_from_tool, stations, (options, ground))?;
    let Some(mut search) = search else { return Ok(Err(None)) };
    let arm = search.arm.clone();
    let question = Question { robot, arm: &arm, stations, options };
    let mut sought = Sought { best: None, nearest: None };
    let (by_rolls, coarse) = search.coarse(watch)?;
    let (mut others, mut step): (Vec<Start>, f64) = (Vec::new(), 0.0);
    for (by, mut starts) in by_rolls {
        let further = starts.split_off(STARTS.min(starts.len()));
        (starts, step) = search.refined(&question, (by, starts), &mut sought, watch)?;
        others.extend(starts.into_iter().chain(further));
    }
    let Sought { mut best, nearest } = sought;
    if best.as_ref().is_none_or(|best| best.2.touches()) {
        let tried = if best.is_some() { CLEAR_TRIED } else { usize::MAX };
        let others = others.iter().take(tried);
        best = search.followed(&question, (others, best.is_some()), watch)?.or(best);
    }
    let samples = search.keys.len();
    let Some((_, place, followed)) = best else { return Ok(Err(nearest)) };
    let stand = search.stand(&place);
    let Milled::Followed(followed) = question.without_doubt(Milled::Followed(followed), &stand, watch)? else {
        unreachable!("what is followed stays so")
    };
    search.put_binding_first(&place)?;
    let (lower_bound, nodes) = search.lower_bound(followed.worst.0, watch)?;
    let milled = question.clear_by_wide_bodies(followed, (&stand, None), watch)?;
    let placement = search.placement(&place);
    let resolution = PathResolution { coarse, step, samples, nodes };
    Ok(Ok(PathPlaced { placement, milled, lower_bound, resolution }))
}

/// Of every station, how often the arm may have been arranged anew before it.
fn runs(stations: &[Station]) -> Vec<usize> {
    let count = |run: &mut usize, station: &Station| {
        *run += usize::from(station.is_fresh);
        Some(*run)
    };
    stations.iter().scan(0, count).collect()
}

/// The middle of the box about all that feeds.
fn middle(stations: &[Station]) -> Vector3<f64> {
    let cutting = stations.iter().filter(|station| station.sample.is_cutting).map(|station| station.sample.pose.tip);
    let (low, high) = cutting
        .fold((Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)), |(low, high), tip| {
            (low.inf(&tip), high.sup(&tip))
        });
    (low + high) / 2.0
}

/// Stations that stand for a path: the outermost in many directions, rapid ways and all; those under the largest forces; some in between.
fn keys(stations: &[Station], middle: &Vector3<f64>) -> Vec<usize> {
    let mut keys: Vec<usize> = Vec::new();
    let mut add = |key: Option<usize>| keys.extend(key.filter(|key| !keys.contains(key)));
    let farthest = |of: &dyn Fn(&Station) -> f64| {
        (0..stations.len()).max_by(|a, b| of(&stations[*a]).total_cmp(&of(&stations[*b])))
    };
    for i in 0..8 {
        let (s, c) = (TAU * f64::from(i) / 8.0).sin_cos();
        let cutting = |station: &Station| if station.acting.is_some() { 0.0 } else { -1e3 };
        add(farthest(&|station| (station.sample.pose.tip - middle).dot(&Vector3::new(c, s, 0.0)) + cutting(station)));
    }
    for direction in [Vector3::z(), -Vector3::z()] {
        add(farthest(&|station| (station.sample.pose.tip - middle).dot(&direction)));
    }
    for direction in [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y()] {
        add(farthest(&|station| station.sample.pose.axis.dot(&direction)));
    }
    let size = |station: &Station| match station.acting {
        None => 0.0,
        Some(super::Acting::Any(newtons)) => newtons,
        Some(super::Acting::Known { force, .. }) => Vector3::from(force).norm(),
    };
    add(farthest(&size));
    let cutting: Vec<usize> = (0..stations.len()).filter(|i| stations[*i].acting.is_some()).collect();
    for i in 0..BETWEEN {
        add(cutting.get(cutting.len() * (2 * i + 1) / (2 * BETWEEN)).copied());
    }
    keys
}

impl<'a> Search<'a> {
    /// `None` where the margins leave nothing of the window.
    fn new(
        robot: &Robot,
        flange_from_tool: &Pose,
        stations: &'a [Station],
        (options, ground): (&'a MillOptions, &PathGround),
    ) -> Result<Option<Self>, MillError> {
        let stand = Stand { base_from_part: Pose::identity(), flange_from_tool: *flange_from_tool };
        let arm = arm_with_margins(robot, &stand, options)?;
        if !stations.iter().any(|station| station.sample.is_cutting) {
            return Err(MillError::NothingFeeds);
        }
        let middle = middle(stations);
        let aside = stations.iter().map(|station| (station.sample.pose.tip - middle).xy().norm());
        let Some(site) = Site::new(robot, &arm, ground, aside.fold(f64::INFINITY, f64::min)) else { return Ok(None) };
        let enclosure = ArmEnclosure::new(&arm, [true, false, false, false, false, false]);
        Ok(Some(Self {
            arm,
            enclosure,
            stations,
            options,
            flange_from_tool: *flange_from_tool,
            about: options.clear_of.as_ref().map(|clear_of| clear_of.surroundings(Pose::identity())),
            site,
            middle,
            keys: keys(stations, &middle),
            runs: runs(stations),
        }))
    }
}

impl Search<'_> {
    fn placement(&self, place: &Place) -> PartPlacement {
        self.site.placement(place, &self.middle)
    }

    fn stand(&self, place: &Place) -> Stand {
        let base_from_part = self.placement(place).base_from_part();
        Stand { base_from_part, flange_from_tool: self.flange_from_tool }
    }

    /// Whether the whole path may stand so: first what lies outermost is looked at.
    fn is_allowed(&self, base_from_part: &Pose) -> bool {
        let tip = |station: &Station| (base_from_part * Point3::from(station.sample.pose.tip)).coords;
        let middle = (base_from_part * Point3::from(self.middle)).coords;
        self.keys.iter().all(|i| self.site.allows([tip(&self.stations[*i])].into_iter(), &middle))
            && self.site.allows(self.stations.iter().map(tip), &middle)
            && self.about.as_ref().is_none_or(|about| about.misplaced(base_from_part).is_empty())
    }

    /// The largest error of the samples that stand for the path, m, with so many rolls; infinite where some is not held.
    fn value(&self, place: &Place, rolls: usize, by: Rolls) -> Result<f64, MillError> {
        let [each, one] = self.values(place, rolls)?;
        Ok(match by {
            Rolls::BestOfEach => each,
            Rolls::OneForAll => one,
        })
    }

    /// The same by the best roll of each sample, and by the best of all.
    fn values(&self, place: &Place, rolls: usize) -> Result<[f64; 2], MillError> {
        let stand = self.stand(place);
        if !self.is_allowed(&stand.base_from_part) {
            return Ok([f64::INFINITY; 2]);
        }
        let grid = match self.options.roll {
            RollMode::Fixed(roll) => RollGrid::at([roll]),
            _ => RollGrid::turn(rolls),
        };
        let mut errors = std::array::from_fn(|_| Vec::new());
        // By configuration, and of one roll by that as well.
        let mut each = [0.0_f32; Configuration::COUNT];
        let mut one = vec![0.0_f32; Configuration::COUNT * grid.len()];
        let ladder = Ladder::bare(&self.arm, self.stations, stand, self.options.part);
        for &i in &self.keys {
            ladder.errors_at(i, &grid, &mut errors)?;
            for ((errors, each), one) in errors.iter().zip(&mut each).zip(one.chunks_mut(grid.len())) {
                *each = each.max(errors.iter().copied().fold(f32::INFINITY, f32::min));
                one.iter_mut().zip(errors).for_each(|(one, error)| *one = one.max(*error));
            }
            if each.iter().all(|worst| *worst == f32::INFINITY) {
                break;
            }
        }
        let least = |worst: &[f32]| f64::from(worst.iter().copied().fold(f32::INFINITY, f32::min));
        Ok([least(&each), least(&one)])
    }

    /// The best places of a grid over all, apart from one another, by the rolls that count, and of how many.
    fn coarse(&self, watch: Watch) -> Result<(ByRolls, [usize; 4]), MillError> {
        let grids = self.site.coarse();
        let parts = watch.parts(Some(grids.iter().map(|grid| grid.places.len()).sum()));
        let mut found: Vec<(Place, Place, [f64; 2])> = Vec::new();
        for Coarse { places, apart, .. } in &grids {
            let of = |place: &Place| {
                parts.one_more()?;
                Ok::<_, MillError>((*place, *apart, self.values(place, ROLLS[0])?))
            };
            found.extend(parallel::try_each(places, of)?);
        }
        let by_rolls = Rolls::of(self.options.roll).iter().map(|&by| {
            let start = |&(place, apart, [each, one]): &(Place, Place, [f64; 2])| match by {
                Rolls::BestOfEach => Start { value: each, place, apart, by },
                Rolls::OneForAll => Start { value: one, place, apart, by },
            };
            let mut starts: Vec<Start> = found.iter().map(start).filter(|start| start.value.is_finite()).collect();
            starts.sort_by(|a, b| a.value.total_cmp(&b.value));
            (by, apart(starts))
        });
        Ok((by_rolls.collect(), grids.first().map_or([0; 4], |grid| grid.counts)))
    }

    /// Steps from the best places, and the path followed from the best that these lead to, until no sample joins those that stand for it; the places at
    /// last, and the last step, m.
    fn refined(
        &mut self,
        question: &Question,
        (by, mut starts): (Rolls, Vec<Start>),
        Sought { best, nearest }: &mut Sought,
        watch: Watch,
    ) -> Result<(Vec<Start>, f64), MillError> {
        let mut step = 0.0;
        for _ in 0..ROUNDS {
            let mut steps: Vec<Start> = Vec::new();
            for start in &starts {
                watch.go_on()?;
                let (found, last) = self.descended(start, &|_| Ok(true))?;
                steps.push(found);
                step = last;
            }
            steps.sort_by(|a, b| a.value.total_cmp(&b.value));
            let mut has_joined = false;
            for Start { value, place, .. } in steps.iter().take(2).filter(|start| start.value.is_finite()) {
                // What one roll gives may still be less where it changes.
                let is_least = matches!(by, Rolls::BestOfEach) || matches!(self.options.roll, RollMode::Constant);
                if is_least && best.as_ref().is_some_and(|best| best.0 <= *value && !best.2.touches()) {
                    break;
                }
                let key = match question.milled(&self.stand(place), solve::ROLLS[0], watch)?.1 {
                    Milled::Followed(found) => {
                        let key = found.worst.1;
                        if best.as_ref().is_none_or(|best| found.is_better_than(&best.2, 0.0)) {
                            *best = Some((found.worst.0, *place, found));
                        }
                        key
                    }
                    Milled::Blocked(blocked) => {
                        *nearest = nearest.take().filter(|other| blocked.way <= other.way).or(Some(blocked));
                        let stations = self.stations;
                        stations.partition_point(|station| station.sample.way < blocked.way).min(stations.len() - 1)
                    }
                };
                if !self.keys.contains(&key) {
                    self.keys.push(key);
                    has_joined = true;
                }
            }
            if !has_joined {
                break;
            }
            steps.truncate(STARTS);
            starts = steps;
        }
        Ok((starts, step))
    }

    /// The best place of a search among those alone at which all of the path is followed, and clear where that is wanted, where the samples that stand
    /// for it led to none: each of them is held there, but no way leads from one to the next, or something is touched.
    fn followed<'s>(
        &self,
        question: &Question,
        (starts, is_clear): (impl Iterator<Item = &'s Start>, bool),
        watch: Watch,
    ) -> Result<Option<(f64, Place, Followed)>, MillError> {
        let milled = |place: &Place| match question.milled(&self.stand(place), ROLLS[0], watch)?.1 {
            Milled::Followed(found) if is_clear && found.touches() => Ok(None),
            Milled::Followed(found) => Ok::<_, MillError>(Some(found)),
            Milled::Blocked(_) => Ok(None),
        };
        let (mut best, mut descents): (Option<(f64, Place, Followed)>, usize) = (None, 0);
        for start in starts {
            if descents == DESCENTS {
                break;
            }
            if milled(&start.place)?.is_none() {
                continue;
            }
            descents += 1;
            let (Start { place, .. }, _) = self.descended(start, &|place| Ok(milled(place)?.is_some()))?;
            // Where no step led on, that is the start itself.
            if let Some(found) = milled(&place)?.filter(|found| best.as_ref().is_none_or(|best| found.worst.0 < best.0))
            {
                best = Some((found.worst.0, place, found));
            }
        }
        Ok(best)
    }

    /// The best place that steps along and across the axes lead to by places that count, and the last step, m.
    fn descended(
        &self,
        from: &Start,
        counts: &dyn Fn(&Place) -> Result<bool, MillError>,
    ) -> Result<(Start, f64), MillError> {
        let mut best = Start { value: self.value(&from.place, ROLLS[1], from.by)?, ..*from };
        let mut steps = from.apart.map(|apart| apart / 2.0);
        let ways = ways(&steps);
        for _ in 0..HALVINGS {
            loop {
                let place = |way: &Place| std::array::from_fn(|i| best.place[i] + way[i] * steps[i]);
                let around: Vec<Place> = ways.iter().map(place).collect();
                let of = |place: &Place| {
                    Ok::<_, MillError>(Start { value: self.value(place, ROLLS[1], from.by)?, place: *place, ..*from })
                };
                let mut found = parallel::try_each(&around, of)?;
                found.retain(|one| one.value < best.value * (1.0 - 1e-6));
                found.sort_by(|a, b| a.value.total_cmp(&b.value));
                let mut least = None;
                for one in found {
                    if counts(&one.place)? {
                        least = Some(one);
                        break;
                    }
                }
                match least {
                    Some(least) => best = least,
                    None => break,
                }
            }
            steps = steps.map(|step| step / 2.0);
        }
        Ok((best, steps[0] * 2.0))
    }
}

/// The first of a sorted list that lie apart from one another.
fn apart(sorted: Vec<Start>) -> Vec<Start> {
    let mut chosen: Vec<Start> = Vec::new();
    for one in sorted {
        let is_apart = |other: &Start| (0..4).any(|i| 2.5 * one.apart[i] < (one.place[i] - other.place[i]).abs());
        if chosen.len() < FURTHER && chosen.iter().all(is_apart) {
            chosen.push(one);
        }
    }
    chosen
}

/// One step back, none or one forth along everything that may be stepped along.
fn ways(steps: &Place) -> Vec<Place> {
    let mut ways: Vec<Place> = vec![[0.0; 4]];
    for i in (0..4).filter(|i| 0.0 < steps[*i]) {
        let with = |way: &Place, by: f64| {
            let mut way = *way;
            way[i] = by;
            way
        };
        ways = ways.iter().flat_map(|way| [-1.0, 0.0, 1.0].map(|by| with(way, by))).collect();
    }
    ways.retain(|way| *way != [0.0; 4]);
    ways
}
