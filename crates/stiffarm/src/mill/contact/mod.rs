//! What does the arm touch along a path, at its samples and between them?
//!
//! `step` decides between two samples, `tool` for a round tool, which stands as the path has it whatever the arm does; `ladder` takes the nodes and
//! edges of which the arm touches something out of a ladder, `path` tells of a path that is followed where it touches, and how near it comes
//! elsewhere; `wide` seeks one that is clear of more than is known. Bodies are those of [`crate::clearance`].

mod ladder;
mod path;
mod step;
mod tool;
mod touching;
mod wide;

use step::GRAZED;
#[cfg(test)]
pub(super) use step::{Between, LEAST, Way};
pub(super) use touching::Touching;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::Vector3;

use super::fault::MillError;
use super::follow::{Arrangement, Stand};
use super::stations::Station;
use crate::batch::SpatialArm;
use crate::cell::Cell;
use crate::clearance::{
    Clearance, Cutter, Link, Looked, Machined, Mesh, Misplaced, Near, Obstacle, Surroundings, ThickArm,
};
use crate::cutting::Shank;
use crate::inverse::posture_of;
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::stock::Remains;
use crate::toolpath::ToolPose;

/// The largest clearance that is asked, m.
const MOST: f64 = 5.0;
/// No floor is farther above or below the base, m.
const FARTHEST_FLOOR: f64 = 100.0;
/// Of what is farther than was asked by this, m, nothing more is known where it is asked alone what touches: no step from sample to sample moves the
/// arm so far, but for few.
const NEAR: f64 = 0.2;
/// Places between two stations at which it is looked how deep something is touched there.
const PLACES: usize = 32;
/// A tool whose flange stands no farther from its axis, m, is round.
const ROUND: f64 = 1e-6;

/// What arm and tool keep clear of along a path: of themselves, and of what stands about them.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearOf {
    /// The least distance, m.
    pub clearance: f64,
    /// The floor, walls and what is kept free; only a floor where `None`.
    pub cell: Option<Cell>,
    /// So high above the base, m; counts where there is no cell.
    pub floor: Option<f64>,
    /// The part in its own frame, as it is when it is done. The cutter may touch it.
    pub part: Option<Mesh>,
    /// What is left of the block from which it is cut, in the same frame, before every station. The cutter may touch it.
    pub stock: Option<Arc<Remains>>,
    /// What holds the part, in the same frame. Nothing may touch it, the cutter neither.
    pub fixture: Option<Mesh>,
    /// What stands out of the spindle; where that is not known the tool is not compared with part, stock and fixture.
    pub cutter: Option<Cutter>,
}

/// How near arm and tool come to anything along a path that is followed.
#[derive(Clone, Debug, PartialEq)]
pub struct PathClearance {
    /// What was asked, m.
    pub asked: f64,
    /// The nearest at any sample, or where it touches between two of them; `None` where there is nothing to meet.
    pub nearest: Option<Clearance>,
    /// The nearest at every station, or where it touches on the way to that; `None` where there is nothing to meet.
    pub at: Vec<Option<Near>>,
    /// Where it is nearer than was asked, in the order of the path; none where every sample and all between them is clear.
    pub contacts: Vec<Contact>,
    /// Of a path that is not clear: what is nearer than was asked at some station whatever the roll and the configuration, as the one of them that
    /// is the farthest from it has it. `None` where nothing of that kind is known.
    pub unavoidable: Option<Contact>,
    /// What of the work stands where nothing may: in what is kept free, or below the floor.
    pub misplaced: Vec<Misplaced>,
    /// The largest error, m, of the best path, where that was left because wide bodies, which are estimated, come nearer to something along it than
    /// was asked, and this one is worse; `None` where it is the best.
    pub without_wide: Option<f64>,
}

/// A stretch of the path along which a link is nearer to something than was asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The station at which, or on the way to which, it is nearest.
    pub station: usize,
    /// Which link.
    pub link: Link,
    /// To what.
    pub to: Obstacle,
    /// How much nearer than was asked, m: where nothing was asked, how deep they overlap.
    pub depth: f64,
}

/// A posture by its model angles, rad, with what it comes nearest to; `None` where nothing is nearer than `within`, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Posed {
    theta: [f64; 6],
    near: Option<Near>,
    within: f64,
}

/// Which bodies of an arm are looked at, where nobody knows how thick its links are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bodies {
    /// Those that are known, or slim ones.
    Known,
    /// Those inside of which nine known arms in ten lie, towards all but the arm itself.
    Wide,
    /// Both.
    All,
}

/// The bodies of an arm that stands before a part, made ready.
pub(super) struct Guard<'a> {
    thick: ThickArm<'a>,
    bodies: Bodies,
    about: Surroundings,
    arm: &'a SpatialArm,
    stations: &'a [Station],
    stand: Stand,
    clearance: f64,
    /// No point of what a joint moves is farther from its axis, m.
    farthest: [f64; 6],
    /// The tool stands on its own axis: what it touches of what stands about the arm depends on the path alone, and is looked at apart.
    is_tool_round: bool,
    /// No point of it is farther from its tip, m.
    farthest_of_tool: f64,
    /// Some node, edge or path was not taken because it touches.
    forbade: AtomicBool,
}

impl ClearOf {
    pub(super) fn check(&self) -> Result<(), MillError> {
        let cutter = self.cutter.unwrap_or(Cutter { length: 0.0, radius: 0.0, shank: None });
        let [flute, shank] = cutter.shank.map_or([0.0; 2], |Shank { flute, diameter }| [flute, diameter]);
        for (what, value, least, most, expected) in [
            ("a clearance, m", self.clearance, 0.0, MOST, "0 to 5 m"),
            ("what stands out of a spindle, m", cutter.length, 0.0, MOST, "0 to 5 m"),
            ("the radius of a cutter, m", cutter.radius, 0.0, MOST, "0 to 5 m"),
            ("the flutes of a cutter, m", flute, 0.0, MOST, "0 to 5 m"),
            ("the diameter of a shank, m", shank, 0.0, MOST, "0 to 5 m"),
            ("the height of a floor, m", self.floor.unwrap_or(0.0), -FARTHEST_FLOOR, FARTHEST_FLOOR, "-100 to 100 m"),
        ] {
            if !(least <= value && value <= most) {
                return Err(MillError::Value { what, value, expected });
            }
        }
        Ok(())
    }

    /// All of it about a robot, where the part stands at a pose in its base.
    pub(super) fn surroundings(&self, base_from_part: Pose) -> Surroundings {
        let Self { cell, floor, part, stock, fixture, cutter, .. } = self.clone();
        let is_known = part.is_some() || stock.is_some() || fixture.is_some();
        let machined = || Machined { pose: base_from_part, part, stock, fixture, cutter };
        Surroundings { machined: is_known.then(machined), ..Surroundings::of(cell.as_ref(), floor) }
    }
}

impl<'a> Guard<'a> {
    /// `None` of an arm of which two links alone are known, and of one whose bodies are known where wide ones are asked for.
    pub(super) fn of(
        (robot, arm): (&'a Robot, &'a SpatialArm),
        stations: &'a [Station],
        stand: &Stand,
        (clear_of, bodies): (&ClearOf, Bodies),
    ) -> Option<Self> {
        let ClearOf { clearance, cutter, .. } = clear_of;
        let thick = ThickArm::new(robot, &stand.flange_from_tool, None)?;
        let cutter_radius = cutter.as_ref().map_or(0.0, Cutter::widest);
        let farthest = thick.farthest(cutter_radius);
        let farthest = match bodies {
            Bodies::Known => farthest,
            Bodies::Wide => thick.farthest_wide(cutter_radius)?,
            Bodies::All => {
                let wide = thick.farthest_wide(cutter_radius)?;
                std::array::from_fn(|i| farthest[i].max(wide[i]))
            }
        };
        let (point, axis) = (stand.flange_from_tool.translation.vector, stand.flange_from_tool.rotation * Vector3::z());
        let farthest_of_tool = thick.farthest_from_tip(cutter_radius);
        Some(Self {
            is_tool_round: farthest_of_tool.is_some() && point.cross(&axis).norm() < ROUND,
            farthest_of_tool: farthest_of_tool.unwrap_or(0.0),
            farthest,
            bodies,
            forbade: AtomicBool::new(false),
            thick,
            about: clear_of.surroundings(stand.base_from_part),
            arm,
            stations,
            stand: *stand,
            clearance: *clearance,
        })
    }

    /// Something was not taken because it touches.
    pub(super) fn has_forbidden(&self) {
        self.forbade.store(true, Ordering::Relaxed);
    }

    /// Whether anything was.
    pub(super) fn forbade(&self) -> bool {
        self.forbade.load(Ordering::Relaxed)
    }

    /// With what it comes nearest to, at a station or on the way to it: what is cut on that way is still there.
    pub(super) fn posed(&self, theta: [f64; 6], station: usize) -> Posed {
        self.posed_as_looked(theta, station, Looked::ALL)
    }

    /// The same but for what a round tool comes near to.
    fn posed_arm(&self, theta: [f64; 6], station: usize) -> Posed {
        self.posed_as_looked(theta, station, Looked { is_tool_apart: self.is_tool_round, ..Looked::ALL })
    }

    /// The same where it is asked alone what touches: of what does something is known, and of the rest no more than that it is far.
    fn posed_to_touch(&self, theta: [f64; 6], station: usize, is_tool_apart: bool) -> Posed {
        let looked = Looked { enough: self.clearance + GRAZED, within: self.clearance + NEAR, is_tool_apart };
        self.posed_as_looked(theta, station, looked)
    }

    fn posed_as_looked(&self, theta: [f64; 6], station: usize, looked: Looked) -> Posed {
        let about = (&self.about, station);
        let known = || self.thick.nearest(&theta, about, looked);
        let wide = |within| self.thick.nearest_wide(&theta, about, Looked { within, ..looked });
        let near = match self.bodies {
            Bodies::Known => known(),
            Bodies::Wide => wide(looked.within),
            Bodies::All => {
                let known = known();
                wide(known.map_or(looked.within, |near| near.distance)).or(known)
            }
        };
        Posed { theta, near, within: looked.within }
    }

    /// The same path where nothing is asked but that nothing touches; `None` where no more was asked.
    pub(super) fn that_only_touches_nothing(self) -> Option<Self> {
        (0.0 < self.clearance).then(|| Self { clearance: 0.0, forbade: AtomicBool::new(false), ..self })
    }

    fn contact(&self, station: usize, Near { distance, link, to }: &Near) -> Contact {
        Contact { station, link: *link, to: *to, depth: self.clearance - distance }
    }

    /// Nearer to something than was asked.
    pub(super) fn touches(&self, posed: &Posed) -> bool {
        posed.distance() < self.clearance
    }

    /// The posture that holds a tool pose, limits left aside; `None` where there is none.
    ///
    /// # Errors
    /// A tool axis from which no roll counts.
    pub(super) fn theta(&self, line: usize, pose: &ToolPose, at: Arrangement) -> Result<Option<[f64; 6]>, MillError> {
        let part_from_tool = super::part_from_tool(pose, at.roll).ok_or(MillError::Roll { line })?;
        let flange = self.stand.base_from_part * part_from_tool * self.stand.flange_from_tool.inverse();
        Ok(posture_of(&self.arm.geometry, &flange, at.configuration))
    }

    /// Of a station.
    fn at(&self, i: usize, at: Arrangement) -> Result<Option<Posed>, MillError> {
        let sample = &self.stations[i].sample;
        let theta = self.theta(sample.line, &sample.pose, at)?;
        Ok(theta.map(|theta| self.posed_to_touch(theta, i, self.is_tool_round)))
    }
}

impl Posed {
    /// To the nearest, m; so far at least where that is not known.
    fn distance(&self) -> f64 {
        self.near.map_or(self.within, |near| near.distance)
    }
}

/// The deeper one of two, where it is nearer than was asked at all.
pub(super) fn deeper(one: Option<Contact>, other: Option<Contact>) -> Option<Contact> {
    [one, other]
        .into_iter()
        .flatten()
        .filter(|contact| 0.0 < contact.depth)
        .reduce(|a, b| if a.depth < b.depth { b } else { a })
}

fn nearer(one: Option<Near>, other: Option<Near>) -> Option<Near> {
    [one, other].into_iter().flatten().min_by(|a, b| a.distance.total_cmp(&b.distance))
}
