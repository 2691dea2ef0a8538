//! Which roll, and which configuration, at every place of a path? A shortest path over a ladder of rolls.
//!
//! A rung holds some samples in a row: so many that the wrist could turn by a few steps of the grid meanwhile, or no roll would ever
//! change. A node is a configuration and a roll of a rung, and costs the largest error of its samples. An edge joins nodes of
//! one configuration whose joints lie near enough to one another for the machine's speeds, and for the line between to be followed.
//! Where whole turns of joints 1, 4 and 6 matter, each is a node of its own.

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::{Point3, Vector3};

use super::contact::{Contact, Touching};
use super::fault::MillError;
use super::follow::{Arrangement, Stand};
use super::stations::{ErrorPart, Station};
use crate::batch::{Pushing, RollGrid, RolledTool, SpatialArm};
use crate::inverse::{Configuration, postures, within_limits};
use crate::parallel;
use crate::watch::Watch;

/// The roll may turn by so many steps of the grid from rung to rung, where speeds are known.
const STEPS_A_RUNG: f64 = 3.0;
/// Of one rung, m.
const LONGEST_RUNG: f64 = 0.02;
/// More rungs need more memory than a machine has to spare: what is longer gets longer rungs.
const MOST_RUNGS: usize = 10_000;
/// The joints that may turn by more than a turn, from 0.
pub(super) const WINDING: [usize; 3] = [0, 3, 5];

/// Some samples in a row.
#[derive(Clone, Debug)]
pub(super) struct Rung {
    /// Which.
    pub(super) samples: Range<usize>,
    /// The one that stands for them.
    pub(super) at: usize,
    /// How long the way from the rung before takes, s, where that is known.
    pub(super) time: Option<f64>,
    /// The arm may be arranged anew before it.
    pub(super) is_fresh: bool,
    /// A rung of one sample whose roll is pinned: this roll, rad, stands at its line of the grid, and no other is held.
    pub(super) pinned: Option<f64>,
    /// The largest error of the samples, m, by configuration and roll; infinite where one of them is not held.
    pub(super) errors: [Vec<f32>; Configuration::COUNT],
}

/// The rungs of a path, for a part that stands somewhere.
#[derive(Clone, Debug)]
pub(super) struct Ladder<'a> {
    pub(super) arm: &'a SpatialArm,
    pub(super) stations: &'a [Station],
    pub(super) stand: Stand,
    pub(super) part: ErrorPart,
    pub(super) grid: RollGrid,
    pub(super) rungs: Vec<Rung>,
    /// Largest speed of each joint that is used, rad/s, where the robot says one.
    pub(super) speeds: Option<[f64; 6]>,
    /// From rung to rung joints keep to this part of these speeds, since between the rungs they may turn faster.
    pub(super) pace: f64,
    /// What was found to touch something.
    pub(super) touching: Touching,
    /// What no path over it keeps clear of, where that is known.
    pub(super) unavoidable: Option<Contact>,
}

/// The joints of a rung's nodes, rad, as the robot reports them, each turned down to the least that its range allows.
pub(super) type Joints = Vec<Option<[f64; 6]>>;

impl<'a> Ladder<'a> {
    /// Evaluates every node.
    pub(super) fn new(
        arm: &'a SpatialArm,
        stations: &'a [Station],
        stand: Stand,
        (part, grid): (ErrorPart, RollGrid),
        share_of_speed: f64,
        watch: Watch,
    ) -> Result<Self, MillError> {
        let speeds = arm.limits.speeds.map(|speeds| speeds.map(|speed| share_of_speed * speed));
        let mut ladder = Self {
            arm,
            stations,
            stand,
            part,
            grid,
            rungs: Vec::new(),
            speeds,
            pace: 1.0,
            touching: Touching::default(),
            unavoidable: None,
        };
        ladder.rungs = ladder.rungs_of_stations();
        let parts = watch.parts(Some(ladder.rungs.len()));
        let errors = parallel::try_each(&ladder.rungs, |rung| {
            parts.one_more()?;
            ladder.errors(rung, &ladder.grid)
        })?;
        for (rung, errors) in ladder.rungs.iter_mut().zip(errors) {
            rung.errors = errors;
        }
        Ok(ladder)
    }

    /// Without rungs: for single stations.
    pub(super) fn bare(arm: &'a SpatialArm, stations: &'a [Station], stand: Stand, part: ErrorPart) -> Self {
        let (grid, rungs, touching) = (RollGrid::turn(1), Vec::new(), Touching::default());
        Self { arm, stations, stand, part, grid, rungs, speeds: None, pace: 1.0, touching, unavoidable: None }
    }

    /// Groups samples: until the wrist could turn by some steps of the grid, or as far as a rung may reach.
    fn rungs_of_stations(&self) -> Vec<Rung> {
        let slowest = self.speeds.map(|speeds| speeds[3..].iter().copied().fold(f64::INFINITY, f64::min));
        let wanted = slowest.map_or(0.0, |speed| STEPS_A_RUNG * self.grid.step() / speed);
        let least = self.stations.len().div_ceil(MOST_RUNGS);
        let mut rungs: Vec<Rung> = Vec::new();
        let (mut from, mut time, mut length) = (0, 0.0, 0.0);
        for i in 1..=self.stations.len() {
            let Some(station) = self.stations.get(i) else {
                rungs.push(self.rung(from..i, rungs.last()));
                break;
            };
            time += station.time.unwrap_or(f64::INFINITY);
            length += station.sample.way - self.stations[i - 1].sample.way;
            let is_full = wanted <= time && least <= i - from;
            // A station that is pinned is a rung of its own.
            let is_pinned = station.pinned.is_some() || self.stations[i - 1].pinned.is_some();
            if station.is_fresh || is_pinned || is_full || LONGEST_RUNG < length && least <= i - from {
                rungs.push(self.rung(from..i, rungs.last()));
                (from, time, length) = (i, 0.0, 0.0);
            }
        }
        rungs
    }

    fn rung(&self, samples: Range<usize>, before: Option<&Rung>) -> Rung {
        let at = usize::midpoint(samples.start, samples.end - 1);
        let times = before.map(|before| self.stations[before.at + 1..=at].iter().map(|station| station.time));
        let time = times.and_then(Iterator::sum::<Option<f64>>);
        let is_fresh = self.stations[samples.start].is_fresh;
        let pinned = self.stations[at].pinned;
        Rung { samples, at, time, is_fresh, pinned, errors: std::array::from_fn(|_| Vec::new()) }
    }

    /// No path over the ladder has a smaller error, m: the largest of the least errors of the rungs.
    pub(super) fn floor(&self) -> f32 {
        let least = |rung: &Rung| rung.errors.iter().flatten().copied().fold(f32::INFINITY, f32::min);
        self.rungs.iter().map(least).fold(0.0, f32::max)
    }

    /// The largest error of a rung's samples at every node.
    fn errors(&self, rung: &Rung, grid: &RollGrid) -> Result<[Vec<f32>; Configuration::COUNT], MillError> {
        let mut found: [Vec<f32>; Configuration::COUNT] = std::array::from_fn(|_| vec![0.0; grid.len()]);
        let mut one: [Vec<f32>; Configuration::COUNT] = std::array::from_fn(|_| Vec::new());
        if let Some(roll) = rung.pinned {
            self.errors_at(rung.at, &RollGrid::at([roll]), &mut one)?;
            for (found, one) in found.iter_mut().zip(&one) {
                found.fill(f32::INFINITY);
                found[grid.nearest(roll)] = one[0];
            }
            return Ok(found);
        }
        for i in rung.samples.clone() {
            self.errors_at(i, grid, &mut one)?;
            for (found, one) in found.iter_mut().zip(&one) {
                found.iter_mut().zip(one).for_each(|(most, error)| *most = most.max(*error));
            }
        }
        Ok(found)
    }

    /// The error of one station at every configuration and these rolls, m.
    pub(super) fn errors_at(
        &self,
        i: usize,
        grid: &RollGrid,
        found: &mut [Vec<f32>; Configuration::COUNT],
    ) -> Result<(), MillError> {
        let Station { sample, acting, .. } = &self.stations[i];
        let (rolled_tool, point) = self.rolled(i)?;
        let axes = self.stand.cutting_axes(sample);
        let pushing = acting.map_or(Pushing::Nothing, |acting| acting.pushing(&axes, sample, self.part));
        self.arm.errors_at_rolls(&rolled_tool, &point, &pushing, grid, found);
        Ok(())
    }

    /// The tool at a station at every roll, and its tip, m, base axes.
    fn rolled(&self, i: usize) -> Result<(RolledTool, Vector3<f64>), MillError> {
        let (sample, stand) = (&self.stations[i].sample, &self.stand);
        let turned = |roll: f64| {
            let pose = stand.base_from_tool(sample, roll)?;
            Ok::<_, MillError>(*pose.rotation.to_rotation_matrix().matrix())
        };
        let tools = [turned(0.0)?, turned(TAU / 4.0)?, turned(TAU / 2.0)?];
        let point = (stand.base_from_part * Point3::from(sample.pose.tip)).coords;
        Ok((self.arm.rolled_tool(tools.each_ref()), point))
    }

    /// The largest error of a rung's samples at rolls, rad, of one configuration, m; infinite where one of them is not held.
    pub(super) fn errors_of(&self, k: usize, at: Arrangement, rolls: &[f64]) -> Result<Vec<f64>, MillError> {
        let grid = RollGrid::at(rolls.iter().copied());
        let found = self.errors(&self.rungs[k], &grid)?;
        Ok(found[at.configuration.index()].iter().map(|error| f64::from(*error)).collect())
    }

    /// At which roll a node of a rung stands, rad.
    pub(super) fn roll_of(&self, rung: &Rung, line: usize) -> f64 {
        rung.pinned.unwrap_or_else(|| self.grid.roll(line))
    }

    /// The joints of a rung's nodes whose error is no larger than `most`.
    pub(super) fn joints(&self, rung: &Rung, most: f32) -> Joints {
        let count = self.grid.len();
        let mut found = vec![None; Configuration::COUNT * count];
        let is_wanted: Vec<bool> = (0..count).map(|roll| rung.errors.iter().any(|of| of[roll] <= most)).collect();
        let mut angles = Vec::new();
        match self.rolled(rung.at) {
            Ok((rolled_tool, point)) if rung.pinned.is_none() => {
                self.arm.angles_at_rolls(&rolled_tool, &point, &self.grid, &is_wanted, &mut angles);
            }
            // A roll that is none was refused when the errors were computed.
            _ => angles.resize(found.len(), [f64::NAN; 6]),
        }
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        for roll in (0..count).filter(|roll| is_wanted[*roll]) {
            let mut one_by_one = None;
            for c in (0..Configuration::COUNT).filter(|c| rung.errors[*c][roll] <= most) {
                let theta = &angles[c * count + roll];
                let q = if theta[0].is_nan() {
                    let held = one_by_one.get_or_insert_with(|| self.postures(rung.at, self.roll_of(rung, roll)));
                    held.iter().find_map(|(known, q)| (known.index() == c).then_some(*q))
                } else {
                    within_limits(geometry, limits, theta)
                };
                found[c * count + roll] = q.map(|q| self.turned_down(q));
            }
        }
        found
    }

    /// Every posture that holds a station at a roll within limits and margins.
    pub(super) fn postures(&self, i: usize, roll: f64) -> Vec<(Configuration, [f64; 6])> {
        // A roll that is none was refused when the errors were computed.
        let Ok(tool) = self.stand.base_from_tool(&self.stations[i].sample, roll) else { return Vec::new() };
        let flange = tool * self.arm.flange_from_tool.inverse();
        let (geometry, limits) = (&self.arm.geometry, &self.arm.limits);
        let held = |(configuration, theta): (Configuration, [f64; 6])| {
            Some((configuration, within_limits(geometry, limits, &theta)?))
        };
        postures(geometry, &flange).found.into_iter().filter_map(held).collect()
    }

    fn turned_down(&self, mut q: [f64; 6]) -> [f64; 6] {
        for joint in WINDING {
            let range = self.arm.limits.joints[joint];
            if range.is_bounded() {
                q[joint] += TAU * ((range.min() - q[joint]) / TAU - 1e-12).ceil();
            }
        }
        q
    }
}
