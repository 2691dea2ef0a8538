//! Where must a part stand, so that the largest error along its path is least?
//!
//! Searched: how far ahead, how high, and how far the part is turned about the vertical; about the joint-1 axis it may stand anywhere, so
//! it is placed straight ahead. First over all of these on some samples (those that lie outermost, those under the largest forces,
//! some in between), then step by step from the best, then along the whole path, whose worst sample joins the others. Proved: a
//! lower bound by branch and bound over the places, on the same samples, each at its own best roll.

mod proof;

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};
use rayon::prelude::*;

use super::fault::{Blocked, MillError};
use super::follow::Stand;
use super::ladder::Ladder;
use super::solve::{self, MillOptions, Question, RollMode};
use super::stations::{Station, check_normals};
use super::{Followed, Milled, arm_with_margins, is_pinned};
use crate::batch::{RollGrid, SpatialArm};
use crate::enclose::ArmEnclosure;
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::place::{Margins, Within};
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::watch::Watch;

/// Places along each of the two lengths, and turns, of the coarse search.
const COARSE: [usize; 3] = [18, 14, 24];
/// Rolls of the coarse search and of the steps.
const ROLLS: [usize; 2] = [24, 60];
/// Places from which steps are taken.
const STARTS: usize = 6;
/// Steps are halved so often: from a tenth of the range to a millimetre or so.
const HALVINGS: usize = 8;
/// How often the worst sample of the whole path joins the others.
const ROUNDS: usize = 4;
/// Samples in between that are looked at.
const BETWEEN: usize = 6;

/// Where the origin of a path stands: m from the base, and the turn about the vertical, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartPlacement {
    /// Ahead, to the left, up.
    pub at: [f64; 3],
    /// From straight ahead to the part's x axis.
    pub yaw: f64,
}

impl PartPlacement {
    /// The part in the base frame.
    pub fn base_from_part(&self) -> Pose {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.yaw);
        Pose::from_parts(Translation3::from(Vector3::from(self.at)), turn)
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
    /// How finely was sought.
    pub resolution: PathResolution,
}

/// How finely a place was looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathResolution {
    /// Places of the coarse search: ahead, up, and turned about the vertical.
    pub coarse: [usize; 3],
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
    within: Within,
    /// What the path keeps from the joint-1 axis, m.
    column: f64,
    /// The middle of the path, part frame, m.
    middle: Vector3<f64>,
    /// Stations that stand for the path.
    keys: Vec<usize>,
    /// Of every station, how often the arm may have been arranged anew before it.
    runs: Vec<usize>,
}

/// Ahead, up, yaw; the middle of the path stands straight ahead.
type Place = [f64; 3];

/// Finds the best place of a path.
///
/// # Errors
/// As [`mill`]; a window of which the margins leave nothing is an answer like any place that is not held.
pub fn place_path(
    robot: &Robot,
    flange_from_tool: &Pose,
    stations: &[Station],
    (options, margins, within): (&MillOptions, &Margins, Within),
    watch: Watch,
) -> Result<Result<PathPlaced, Option<Blocked>>, MillError> {
    if is_pinned(stations) {
        return Err(MillError::PinnedElse);
    }
    check_normals(stations, options.part)?;
    let sought = Search::new(robot, flange_from_tool, stations, (options, margins, within))?;
    let Some(mut search) = sought else { return Ok(Err(None)) };
    let arm = search.arm.clone();
    let question = Question { robot, arm: &arm, stations, options };
    let (mut best, mut nearest): (Option<(f64, Place, Followed)>, Option<Blocked>) = (None, None);
    let mut starts = search.coarse(watch)?;
    let mut step = 0.0;
    for _ in 0..ROUNDS {
        let mut steps: Vec<(f64, Place)> = Vec::new();
        for (_, place) in &starts {
            watch.go_on()?;
            let (found, last) = search.descended(*place)?;
            steps.push(found);
            step = last;
        }
        steps.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut has_joined = false;
        for (value, place) in steps.iter().take(2).filter(|(value, _)| value.is_finite()) {
            if best.as_ref().is_some_and(|best| best.0 <= *value) {
                break;
            }
            let key = match question.milled(&search.stand(place), solve::ROLLS[0], watch)? {
                Milled::Followed(found) => {
                    let key = found.worst.1;
                    if best.as_ref().is_none_or(|best| found.worst.0 < best.0) {
                        best = Some((found.worst.0, *place, found));
                    }
                    key
                }
                Milled::Blocked(blocked) => {
                    nearest = nearest.filter(|other| blocked.way <= other.way).or(Some(blocked));
                    stations.partition_point(|station| station.sample.way < blocked.way).min(stations.len() - 1)
                }
            };
            if !search.keys.contains(&key) {
                search.keys.push(key);
                has_joined = true;
            }
        }
        if !has_joined {
            break;
        }
        steps.truncate(STARTS);
        starts = steps;
    }
    let samples = search.keys.len();
    let Some((_, place, followed)) = best else { return Ok(Err(nearest)) };
    let followed = match question.without_doubt(Milled::Followed(followed), &search.stand(&place), watch)? {
        Milled::Followed(followed) => followed,
        Milled::Blocked(_) => unreachable!("what is followed stays so"),
    };
    let value = followed.worst.0;
    search.put_binding_first(&place)?;
    let (lower_bound, nodes) = search.lower_bound(value, watch)?;
    let placement = search.placement(&place);
    let resolution = PathResolution { coarse: COARSE, step, samples, nodes };
    Ok(Ok(PathPlaced { placement, milled: Milled::Followed(followed), lower_bound, resolution }))
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
        (options, margins, within): (&'a MillOptions, &Margins, Within),
    ) -> Result<Option<Self>, MillError> {
        let stand = Stand { base_from_part: Pose::identity(), flange_from_tool: *flange_from_tool };
        let arm = arm_with_margins(robot, &stand, options)?;
        if !stations.iter().any(|station| station.sample.is_cutting) {
            return Err(MillError::NothingFeeds);
        }
        let Some(within) = margins.part_of(within, robot) else { return Ok(None) };
        let enclosure = ArmEnclosure::new(&arm, [true, false, false, false, false, false]);
        let middle = middle(stations);
        Ok(Some(Self {
            arm,
            enclosure,
            stations,
            options,
            flange_from_tool: *flange_from_tool,
            within,
            column: margins.radius(robot),
            middle,
            keys: keys(stations, &middle),
            runs: runs(stations),
        }))
    }
}

impl Search<'_> {
    fn placement(&self, [x, z, yaw]: &Place) -> PartPlacement {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), *yaw);
        let at = Vector3::new(*x, 0.0, *z) - turn * self.middle;
        PartPlacement { at: at.into(), yaw: *yaw }
    }

    fn stand(&self, place: &Place) -> Stand {
        let base_from_part = self.placement(place).base_from_part();
        Stand { base_from_part, flange_from_tool: self.flange_from_tool }
    }

    /// How far ahead and how high the middle may stand, and all turns.
    fn ranges(&self) -> Option<[Interval; 3]> {
        let [ahead, up] = self.arm.reach();
        let x = self.within.x.intersect(Interval::spanning(self.column.min(ahead.max()), ahead.max()))?;
        Some([x, self.within.z.intersect(up)?, Interval::spanning(-PI, PI)])
    }

    /// Whether a tip keeps its window and the robot's column.
    fn stands_well(&self, tip: &Vector3<f64>) -> bool {
        self.within.x.contains(tip.x, 1e-9)
            && self.within.z.contains(tip.z, 1e-9)
            && self.column - 1e-9 <= tip.xy().norm()
    }

    /// The largest error of the samples that stand for the path, m, with so many rolls; infinite where some is not held.
    fn value(&self, place: &Place, rolls: usize) -> Result<f64, MillError> {
        let stand = self.stand(place);
        let tip = |i: &usize| (stand.base_from_part * Point3::from(self.stations[*i].sample.pose.tip)).coords;
        if !self.keys.iter().all(|i| self.stands_well(&tip(i))) {
            return Ok(f64::INFINITY);
        }
        let grid = match self.options.roll {
            RollMode::Fixed(roll) => RollGrid::at([roll]),
            _ => RollGrid::turn(rolls),
        };
        let is_one = matches!(self.options.roll, RollMode::Constant);
        let mut errors = std::array::from_fn(|_| Vec::new());
        // Of a constant roll by configuration and roll, else by configuration alone.
        let mut worst = vec![0.0_f32; Configuration::COUNT * if is_one { grid.len() } else { 1 }];
        let ladder = Ladder::bare(&self.arm, self.stations, stand, self.options.part);
        for &i in &self.keys {
            ladder.errors_at(i, &grid, &mut errors)?;
            for (c, errors) in errors.iter().enumerate() {
                if is_one {
                    let worst = &mut worst[c * grid.len()..][..grid.len()];
                    worst.iter_mut().zip(errors).for_each(|(worst, error)| *worst = worst.max(*error));
                } else {
                    worst[c] = worst[c].max(errors.iter().copied().fold(f32::INFINITY, f32::min));
                }
            }
            if worst.iter().all(|worst| *worst == f32::INFINITY) {
                break;
            }
        }
        Ok(f64::from(worst.into_iter().fold(f32::INFINITY, f32::min)))
    }

    /// The best places of a grid over all, apart from one another.
    fn coarse(&self, watch: Watch) -> Result<Vec<(f64, Place)>, MillError> {
        let Some(ranges) = self.ranges() else { return Ok(Vec::new()) };
        let at = |i: usize, n: usize| ranges[i].min() + ranges[i].width() * (n as f64 + 0.5) / COARSE[i] as f64;
        let [nx, nz, nyaw] = COARSE;
        let places: Vec<Place> = (0..nx)
            .flat_map(|i| (0..nz).flat_map(move |j| (0..nyaw).map(move |k| [i, j, k])))
            .map(|n| [at(0, n[0]), at(1, n[1]), at(2, n[2])])
            .collect();
        let parts = watch.parts(Some(places.len()));
        let of = |place: &Place| {
            parts.one_more()?;
            Ok((self.value(place, ROLLS[0])?, *place))
        };
        let mut found: Vec<(f64, Place)> = places.par_iter().map(of).collect::<Result<_, MillError>>()?;
        found.retain(|(value, _)| value.is_finite());
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut chosen: Vec<(f64, Place)> = Vec::new();
        for one in found {
            let is_apart = |other: &(f64, Place)| {
                (0..3).any(|i| 2.5 * ranges[i].width() / (COARSE[i] as f64) < (one.1[i] - other.1[i]).abs())
            };
            if chosen.len() < STARTS && chosen.iter().all(is_apart) {
                chosen.push(one);
            }
        }
        Ok(chosen)
    }

    /// The best place that steps along and across the axes lead to, and the last step, m.
    fn descended(&self, from: Place) -> Result<((f64, Place), f64), MillError> {
        let Some(ranges) = self.ranges() else { return Ok(((f64::INFINITY, from), 0.0)) };
        let mut best = (self.value(&from, ROLLS[1])?, from);
        let mut steps: [f64; 3] = std::array::from_fn(|i| ranges[i].width() / COARSE[i] as f64 / 2.0);
        for _ in 0..HALVINGS {
            loop {
                let around = (0..27).filter(|n| *n != 13).map(|n: i32| {
                    let by = [n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1];
                    std::array::from_fn(|i| best.1[i] + f64::from(by[i]) * steps[i])
                });
                let around: Vec<Place> = around.collect();
                let found: Vec<(f64, Place)> = around
                    .par_iter()
                    .map(|place| Ok((self.value(place, ROLLS[1])?, *place)))
                    .collect::<Result<_, MillError>>()?;
                let least = found.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
                match least.filter(|least| least.0 < best.0 * (1.0 - 1e-6)) {
                    Some(least) => best = least,
                    None => break,
                }
            }
            steps = steps.map(|step| step / 2.0);
        }
        Ok((best, steps[0] * 2.0))
    }
}
