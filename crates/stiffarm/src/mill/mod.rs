//! Verb: how far is the tool pushed off along a path that a robot mills, at the best roll of the tool about its axis?
//!
//! The tool is round: how far it is turned about its axis is free (functional redundancy). What is searched for is the smoothest path of rolls of
//! those whose largest error is nearly the least (`climb`, over the nodes of `ladder`), smoothed (`smooth`), with a lower bound that no path of
//! rolls beats (`bound`); where that lies far below, rolls are looked at once more in finer steps. Every number that is
//! reported is that of `follow`: one posture after the other, as [`crate::compliance`] has it.

mod arm_error;
mod blocked;
mod bound;
mod chatter;
mod climb;
mod compensate;
mod contact;
mod fault;
mod fed_back;
mod follow;
mod forces;
mod ladder;
mod map;
mod on_true_arm;
mod place;
mod smooth;
mod solve;
mod stations;

use std::cmp::Ordering;

use nalgebra::Point3;

pub use arm_error::{DrawnError, arm_error};
use bound::Floor;
pub use chatter::{AllAlong, DeepestRoll, Judged, MillHeld, PathChatter, Uncovered, chatter_along, check_chatter};
pub use compensate::{Compensated, Remaining, compensate, drawn_errors, remaining};
use contact::Bodies;
pub use contact::{ClearOf, Contact, PathClearance};
pub use fault::{Blocked, MillError, Why};
pub use fed_back::{FedBack, fed_back};
pub use follow::{Arrangement, Pushed, Stand, part_from_tool};
pub use forces::{Forced, ForcedError, Forcing, forced};
use ladder::Ladder;
pub use map::{RollCell, RollMap, roll_map};
pub use on_true_arm::{ArmErrors, OnTrueArm, TrueOptions, WorkFrame, on_true_arm};
pub use place::{PartPlacement, PathGround, PathPlaced, PathResolution, place_path};
pub use solve::{MillOptions, RollMode};
use solve::{Question, ROLLS};
use stations::check_normals;
pub use stations::{Acting, ErrorPart, Station, StationCut, cutting_axes, pin, stations};

use crate::batch::SpatialArm;
use crate::compliance::check_held;
use crate::robot::Robot;
use crate::tolerances::{CLEARANCE, LIMIT};
use crate::toolpath::ToolPose;
use crate::watch::Watch;

/// Where the bound lies so far below the error, as a part of it, rolls are looked at more finely; those found are reported where they are
/// better by more than the second part.
const DOUBTFUL: f64 = 0.2;
const WORTH: f64 = 1e-3;
/// Of longer paths the finer rolls would need more memory and time than a doubt is worth.
const MOST_FINER: usize = 1000;
/// Places at which the way down to a path is looked at.
const APPROACHED: usize = 6;

/// What was found of a path for a part that stands somewhere.
#[derive(Clone, Debug, PartialEq)]
pub enum Milled {
    /// It is followed.
    Followed(Followed),
    /// It is not: where and why.
    Blocked(Blocked),
}

/// A path that is followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// The robot at every station.
    pub samples: Vec<Pushed>,
    /// The largest error, m, and the station at which it is.
    pub worst: (f64, usize),
    /// No path of rolls of the mode that was asked for has a smaller largest error, m.
    pub lower_bound: f64,
    /// The root of the mean square of the error over the way that feeds, m.
    pub rms: f64,
    /// How near the arm comes to anything; `None` where nobody asked.
    pub clearance: Option<PathClearance>,
}

impl Followed {
    /// Somewhere the arm is nearer to something than was asked.
    pub fn touches(&self) -> bool {
        self.clearance.as_ref().is_some_and(|found| !found.contacts.is_empty())
    }

    /// It is nearer to something than was asked, and it touches something.
    fn contact(&self) -> (bool, bool) {
        let nearest = self.clearance.as_ref().and_then(|found| found.nearest);
        (self.touches(), nearest.is_some_and(|nearest| nearest.distance < 0.0))
    }

    /// A path that keeps what was asked is better than one that does not, one that touches nothing than one that does, else that with the smaller
    /// error, by more than a part of it.
    fn is_better_than(&self, other: &Self, part: f64) -> bool {
        match self.contact().cmp(&other.contact()) {
            Ordering::Equal => self.worst.0 < other.worst.0 * (1.0 - part),
            order => order.is_lt(),
        }
    }
}

impl MillOptions {
    /// The best roll from sample to sample; 5 deg from limits and from straight postures; the whole displacement counts; no more than 80 % of
    /// the joints' speeds.
    pub fn usual() -> Self {
        let margin = 5.0_f64.to_radians();
        Self {
            roll: RollMode::Free,
            part: ErrorPart::Total,
            limit_margin: margin,
            singular_margin: margin,
            share_of_speed: 0.8,
            tool_weight: None,
            clear_of: None,
        }
    }

    fn check(&self) -> Result<(), MillError> {
        let roll = if let RollMode::Fixed(roll) = self.roll { roll } else { 0.0 };
        for (what, value, least, most, expected) in [
            ("a roll, rad", roll, -1e3, 1e3, "a finite angle"),
            ("a distance from joint limits, rad", self.limit_margin, 0.0, 1.6, "0 to 1.6 rad"),
            ("a distance from straight postures, rad", self.singular_margin, 0.0, 1.0, "0 to 1 rad"),
            ("a share of the joints' speeds", self.share_of_speed, 1e-3, 1.0, "0.001 to 1"),
        ] {
            if !(least <= value && value <= most) {
                return Err(MillError::Value { what, value, expected });
            }
        }
        self.clear_of.as_ref().map_or(Ok(()), ClearOf::check)
    }
}

/// The arm with margins taken from its limits.
fn arm_with_margins(robot: &Robot, stand: &Stand, options: &MillOptions) -> Result<SpatialArm, MillError> {
    options.check()?;
    check_held(robot)?;
    let arm = SpatialArm::new(robot, &stand.flange_from_tool)?;
    let limit = options.limit_margin;
    arm.with_margins(limit, options.singular_margin.max(CLEARANCE)).ok_or(MillError::Margins { limit })
}

/// Follows a path with the best rolls, the part standing somewhere.
///
/// # Errors
/// Numbers that make no sense, a path that feeds nowhere; what was stopped. A path that cannot be followed is an answer.
pub fn mill(
    robot: &Robot,
    stand: &Stand,
    stations: &[Station],
    options: &MillOptions,
    watch: Watch,
) -> Result<Milled, MillError> {
    let arm = &arm_with_margins(robot, stand, options)?;
    if !stations.iter().any(|station| station.sample.is_cutting) {
        return Err(MillError::NothingFeeds);
    }
    check_normals(stations, options.part)?;
    if options.roll != RollMode::Free && is_pinned(stations) {
        return Err(MillError::PinnedElse);
    }
    let question = Question { robot, arm, stations, options };
    let (ladder, found) = question.milled(stand, ROLLS[0], watch)?;
    match question.without_doubt(found, stand, watch)? {
        Milled::Followed(found) => question.clear_by_wide_bodies(found, (stand, Some(ladder)), watch),
        blocked @ Milled::Blocked(_) => Ok(blocked),
    }
}

impl Question<'_> {
    /// The best of so many rolls, with what is proved of all, and over what the search went.
    fn milled(&self, stand: &Stand, rolls: usize, watch: Watch) -> Result<(Ladder<'_>, Milled), MillError> {
        let mut ladder = self.ladder(stand, rolls, watch)?;
        let samples = match self.solve(&mut ladder, stand, watch)? {
            Ok(samples) => samples,
            Err(blocked) => return Ok((ladder, Milled::Blocked(blocked))),
        };
        let lower_bound = Floor::new(self, stand).lower_bound(&ladder, worst(&samples).0)?;
        let Some(guard) = self.guard(stand, Bodies::Known) else {
            return Ok((ladder, Milled::Followed(self.followed(samples, lower_bound, None))));
        };
        let found = match guard.along(&samples, watch)? {
            Err(at) => Milled::Blocked(ladder.blocked_at(at, Why::Jump)),
            Ok(found) => {
                let of_arm = ladder.unavoidable.filter(|_| !found.contacts.is_empty());
                let unavoidable = contact::deeper(found.unavoidable, of_arm);
                let clearance = Some(PathClearance { unavoidable, ..found });
                Milled::Followed(self.followed(samples, lower_bound, clearance))
            }
        };
        Ok((ladder, found))
    }

    fn followed(&self, samples: Vec<Pushed>, lower_bound: f64, clearance: Option<PathClearance>) -> Followed {
        let (worst, rms) = (worst(&samples), rms(self.stations, &samples));
        Followed { samples, worst, lower_bound, rms, clearance }
    }

    /// What was found, or what finer rolls give where that leaves a doubt: the bound lies far below, something is touched, or nothing was found.
    fn without_doubt(&self, found: Milled, stand: &Stand, watch: Watch) -> Result<Milled, MillError> {
        let is_doubtful = match &found {
            Milled::Followed(found) => found.touches() || found.lower_bound < found.worst.0 * (1.0 - DOUBTFUL),
            Milled::Blocked(blocked) => !matches!(blocked.why, Why::Reach { .. }),
        };
        if self.options.roll != RollMode::Free || !is_doubtful || MOST_FINER < self.stations.len() {
            return Ok(found);
        }
        Ok(match (found, self.milled(stand, ROLLS[1], watch)?.1) {
            (Milled::Followed(found), Milled::Followed(fine)) => {
                // Both bounds hold for every path.
                let lower_bound = found.lower_bound.max(fine.lower_bound);
                let better = if fine.is_better_than(&found, WORTH) { fine } else { found };
                Milled::Followed(Followed { lower_bound: lower_bound.min(better.worst.0), ..better })
            }
            (Milled::Blocked(_), fine) => fine,
            (found, Milled::Blocked(_)) => found,
        })
    }
}

/// The joints so far above the beginning of a path, m along the tool axis, in the arrangement in which it begins; `None` where these are not held,
/// lead on to it by no straight way, or touch something on it.
///
/// # Errors
/// As [`mill`].
pub fn approach(
    robot: &Robot,
    stand: &Stand,
    (station, first): (&Station, &Pushed),
    options: &MillOptions,
    height: f64,
) -> Result<Option<[f64; 6]>, MillError> {
    let arm = arm_with_margins(robot, stand, options)?;
    let mut stations: [Station; APPROACHED] = std::array::from_fn(|_| station.clone());
    for (i, above) in stations.iter_mut().enumerate() {
        let ToolPose { tip, axis } = station.sample.pose;
        above.sample.pose.tip = tip + axis * height * (1.0 - i as f64 / (APPROACHED - 1) as f64);
        above.is_fresh = i == 0;
    }
    let followed = follow::follow(
        (robot, &arm),
        stand,
        &stations,
        options.part,
        std::iter::repeat(first.arrangement),
        Watch::nobody(),
    )?;
    let Ok(samples) = followed else { return Ok(None) };
    let question = Question { robot, arm: &arm, stations: &stations, options };
    if let Some(guard) = question.guard(stand, Bodies::Known)
        && !guard.along(&samples, Watch::nobody())?.is_ok_and(|found| found.contacts.is_empty())
    {
        return Ok(None);
    }
    // The path may begin whole turns away.
    let ([above, ..], Some(last)) = (samples.as_slice(), samples.last()) else { return Ok(None) };
    let joints = std::array::from_fn(|i| above.joints[i] + first.joints[i] - last.joints[i]);
    let is_held = arm.limits.joints.iter().zip(&joints).all(|(range, q)| range.contains(*q, LIMIT));
    Ok(is_held.then_some(joints))
}

/// Some roll is pinned.
fn is_pinned(stations: &[Station]) -> bool {
    stations.iter().any(|station| station.pinned.is_some())
}

/// The largest error of a path, m, and the station at which it is.
fn worst(samples: &[Pushed]) -> (f64, usize) {
    let errors = samples.iter().map(|sample| sample.error).enumerate();
    errors.fold((0.0, 0), |worst, (i, error)| if worst.0 < error { (error, i) } else { worst })
}

/// The root of the mean square of the error over the way that feeds, m: each piece counts by its length and the mean of its ends.
fn rms(stations: &[Station], samples: &[Pushed]) -> f64 {
    let (mut sum, mut length) = (0.0, 0.0);
    for i in 1..stations.len() {
        if !stations[i].sample.is_cutting || !stations[i - 1].sample.is_cutting {
            continue;
        }
        let piece = stations[i].sample.way - stations[i - 1].sample.way;
        sum += piece * (samples[i - 1].error.powi(2) + samples[i].error.powi(2)) / 2.0;
        length += piece;
    }
    if 0.0 < length { (sum / length).sqrt() } else { 0.0 }
}

impl Stand {
    /// A point so far above the tip of a station along the tool axis, m from the base.
    pub fn above(&self, station: &Station, height: f64) -> [f64; 3] {
        let ToolPose { tip, axis } = station.sample.pose;
        (self.base_from_part * Point3::from(tip + axis * height)).coords.into()
    }
}

#[cfg(test)]
mod tests;
