//! Does a cut swing with the arm along a path, and where is it least deep that does?
//!
//! At every sample that cuts [`by_mean`] has the critical depth: at the posture that was found there, the engagement and the feed as there. The
//! full answer, with intervals, lobes and a verdict, is that of the sample at which the critical depth is least in proportion to that of its cut.

mod roll;

use super::Milled;
use super::fault::MillError;
use super::follow::{Pushed, Stand};
use super::solve::{MillOptions, RollMode};
use super::stations::{Acting, Station, StationCut};
use crate::chatter::{Asked, ByMean, Chatter, ChatterError, Cut, HeldBy, MeasuredTip, axes, by_mean, chatter};
use crate::cutting::{Law, Milling, Process};
use crate::mass::RigidBody;
use crate::modes::{Damping, HeldTool, check_masses};
use crate::parallel;
use crate::robot::Robot;
use crate::watch::Watch;

pub use roll::{AllAlong, DeepestRoll};

/// What swings with the arm, and how it dies away.
#[derive(Clone, Debug, PartialEq)]
pub struct MillHeld {
    /// Tool and spindle, in flange axes, from the flange; nothing that weighs where `None`.
    pub body: Option<RigidBody>,
    /// As [`chatter`] takes it.
    pub damping: Option<Damping>,
    /// What was measured of spindle, holder and cutter held by something rigid: with the robot it was measured at one posture, and tells nothing of a path.
    pub measured: Option<MeasuredTip>,
}

/// Why nothing is reported of a sample at which the tool feeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Uncovered {
    /// The feed is within 60 deg of the tool axis: plunges, drilling cycles.
    Plunge,
    /// The tool turns without going anywhere.
    Turn,
    /// The path gives a force, and no cut.
    Force,
    /// Nothing is cut there.
    Air,
}

impl Uncovered {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Plunge, Self::Turn, Self::Force, Self::Air];

    /// In a word or two.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plunge => "plunge",
            Self::Turn => "turn in place",
            Self::Force => "force of the path",
            Self::Air => "air",
        }
    }
}

/// What is reported of one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judged {
    /// The tool is led rapidly.
    Rapid,
    /// Nothing, and why.
    Uncovered(Uncovered),
    /// From which depth it swings.
    Cut {
        /// At the speed of the spindle.
        critical: ByMean,
        /// Of the cut there, m.
        depth: f64,
    },
}

/// A path of whose cuts it is known whether they swing.
#[derive(Clone, Debug)]
pub struct PathChatter {
    /// At every station.
    pub samples: Vec<Judged>,
    /// The station at which the critical depth is least in proportion to that of its cut, with all that is reported of it; `None`
    /// where no sample is covered.
    pub worst: Option<(usize, Chatter)>,
    /// The roll with which its cut would go deepest.
    pub deepest: Option<DeepestRoll>,
}

impl Judged {
    /// The critical depth in proportion to that of the cut; `None` where nothing is reported.
    fn reserve(&self) -> Option<f64> {
        let Self::Cut { critical, depth } = self else { return None };
        Some(critical.edge.map_or(f64::INFINITY, |edge| edge.depth / depth))
    }
}

impl Station {
    /// The cut, where it is one that is covered; `None` of rapid moves.
    fn covered(&self) -> Option<Result<&StationCut, Uncovered>> {
        let sample = &self.sample;
        if !sample.is_cutting {
            return None;
        }
        let Some(way) = sample.direction else { return Some(Err(Uncovered::Turn)) };
        // Before what is cut: of a stock that the tool goes straight down into no cut is known.
        if axes(way.into(), &sample.pose.axis) == Err(ChatterError::Plunge) {
            return Some(Err(Uncovered::Plunge));
        }
        Some(match (&self.cut, self.acting) {
            (Some(cut), _) => Ok(cut),
            (None, None | Some(Acting::Known { force: [0.0, 0.0, 0.0], .. })) => Err(Uncovered::Air),
            (None, Some(_)) => Err(Uncovered::Force),
        })
    }
}

/// That chatter of a process can be computed for a robot, before its path is followed.
///
/// # Errors
/// A robot without masses, what is no flat mill that turns right.
pub fn check_chatter(robot: &Robot, process: &Process) -> Result<(), ChatterError> {
    check_masses(robot)?;
    Cut::of(process).map(|_| ())
}

/// Do the cuts of a process swing along a path that is followed?
///
/// # Errors
/// As [`check_chatter`]; postures of which [`chatter`] tells nothing; what was stopped.
pub fn chatter_along(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    (process, held, options): (&Process, &MillHeld, &MillOptions),
    watch: Watch,
) -> Result<PathChatter, MillError> {
    let of_line = |line: usize| move |error| MillError::Chatter { line, error };
    let usual = Cut::of(process).map_err(of_line(0))?;
    if held.measured.as_ref().is_some_and(|measured| measured.held_by == HeldBy::Robot) {
        return Err(of_line(0)(ChatterError::OnePosture));
    }
    let tool = HeldTool { flange_from_tool: stand.flange_from_tool, body: held.body };
    let cut =
        |at: &StationCut| Cut { milling: Milling { engagement: at.engagement.clone(), ..usual.milling }, ..usual };
    let asked = |station: &Station| {
        let feed = station.sample.direction.map_or([0.0; 3], |way| (stand.base_from_part.rotation * way).into());
        Asked { feed, damping: held.damping, method: None, measured: held.measured.as_ref() }
    };
    let judged = |station: &Station, pushed: &Pushed| {
        watch.go_on()?;
        let at = match station.covered() {
            None => return Ok(Judged::Rapid),
            Some(Err(why)) => return Ok(Judged::Uncovered(why)),
            Some(Ok(at)) => at,
        };
        let critical = by_mean(robot, &pushed.joints, &tool, &cut(at), &asked(station));
        let critical = critical.map_err(of_line(station.sample.line))?;
        Ok::<_, MillError>(Judged::Cut { critical, depth: at.engagement.depth() })
    };
    let all = |followed: &[Pushed]| parallel::try_each_of(stations.len(), |i| judged(&stations[i], &followed[i]));
    let samples = all(followed)?;
    let worst = least_reserve(&samples);
    let worst = worst.and_then(|(i, _)| Some((i, cut(stations[i].cut.as_ref()?))));
    let full = |(i, cut): (usize, Cut)| {
        let (station, joints) = (&stations[i], &followed[i].joints);
        let there = Process { law: Law::Milling(cut.milling), ..process.clone() };
        let found = chatter(robot, joints, &tool, &there, &asked(station)).map_err(of_line(station.sample.line))?;
        Ok::<_, MillError>((i, found))
    };
    let deepest = worst.as_ref().map(|(i, cut)| {
        let i = *i;
        let (asked, configuration) = (asked(&stations[i]), followed[i].arrangement.configuration);
        roll::deepest((robot, &tool), stand, (stations, i, configuration), (cut, &asked), options, watch)
    });
    let mut deepest = deepest.transpose()?.flatten();
    // Pins would hold rolls of their own.
    if let Some(found) = deepest.as_mut().filter(|_| stations.iter().all(|station| station.pinned.is_none())) {
        let options = MillOptions { roll: RollMode::Fixed(found.roll), ..options.clone() };
        if let Milled::Followed(rolled) = super::mill(robot, stand, stations, &options, watch)? {
            let (sample, reserve) = least_reserve(&all(&rolled.samples)?).unwrap_or((0, f64::INFINITY));
            found.all_along = (!rolled.touches()).then_some(AllAlong { sample, reserve, error: rolled.worst.0 });
        }
    }
    Ok(PathChatter { worst: worst.map(full).transpose()?, samples, deepest })
}

/// The sample with the least reserve, and that.
fn least_reserve(samples: &[Judged]) -> Option<(usize, f64)> {
    let reserves = samples.iter().enumerate().filter_map(|(i, judged)| Some((i, judged.reserve()?)));
    reserves.min_by(|a, b| a.1.total_cmp(&b.1))
}
