//! Does the arm touch anything between two postures that do not?
//!
//! No point of the arm moves farther than `s`, the sum over the joints of the way that each turns, rad, times the largest distance of what
//! hangs on it from its axis; two links move no farther towards one another, since what carries both moves both. With the distances `d0`, `d1`
//! at the ends and `c` the asked clearance, at any place between them
//!
//! ```text
//! 2 d >= d0 + d1 - s > 2 c    where    d0 + d1 > s + 2 c
//! ```
//!
//! and the step is free. Else it is halved, and what remains of it at the end counts as a touch.

use super::{Guard, Posed};
use crate::angle::wrapped;
use crate::inverse::Configuration;
use crate::mill::fault::MillError;
use crate::mill::follow::Arrangement;
use crate::toolpath::ToolPose;

/// A step along which nothing moves farther, m, is not halved any more: by no more than half of this a clearance may be denied that is kept.
pub(in crate::mill) const LEAST: f64 = 1e-3;
/// What is farther by less than this, m, than was asked is as if it touched.
pub(super) const GRAZED: f64 = LEAST / 2.0;
/// However fast joints turn, a step is halved no more often.
pub(super) const MOST_HALVINGS: usize = 40;

/// From one posture to the next.
pub(in crate::mill) enum Way {
    /// The tip goes straight, tool axis and roll turn evenly.
    Straight { line: usize, configuration: Configuration, ends: [(ToolPose, f64); 2] },
    /// Every joint turns evenly: model angles, rad.
    Joints { ends: [[f64; 6]; 2], is_tool_apart: bool },
}

/// What is known of a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::mill) enum Between {
    Free,
    /// With a distance that is known at least, m, and the posture at which something is so near.
    Touch(f64, [f64; 6]),
    /// Some place of it is held by no posture.
    Lost,
}

impl Way {
    /// The angles so far along it, 0 to 1, with the turns that lie nearest to others.
    pub(super) fn at(&self, guard: &Guard, part: f64, near: &[f64; 6]) -> Result<Option<[f64; 6]>, MillError> {
        match self {
            Self::Straight { line, configuration, ends: [(from, roll), (to, last)] } => {
                let pose = part_way(from, to, part);
                let roll = roll + part * wrapped(last - roll);
                let theta = guard.theta(*line, &pose, Arrangement { configuration: *configuration, roll })?;
                Ok(theta.map(|theta| beside(&theta, near)))
            }
            Self::Joints { ends: [from, to], .. } => {
                Ok(Some(std::array::from_fn(|i| from[i] + part * (to[i] - from[i]))))
            }
        }
    }
}

impl Guard<'_> {
    /// Whether the arm touches anything between two postures at the ends of a way to a station that do not, the turns of the second beside those of
    /// the first.
    pub(in crate::mill) fn between(
        &self,
        (way, station): (&Way, usize),
        ends: [&Posed; 2],
    ) -> Result<Between, MillError> {
        if ends[0].theta == ends[1].theta {
            return Ok(Between::Free);
        }
        let last = match way {
            Way::Straight { .. } => Posed { theta: beside(&ends[1].theta, &ends[0].theta), ..*ends[1] },
            Way::Joints { .. } => *ends[1],
        };
        self.halved((way, station), [0.0, 1.0], [ends[0], &last], MOST_HALVINGS)
    }

    fn halved(
        &self,
        (way, station): (&Way, usize),
        parts: [f64; 2],
        ends: [&Posed; 2],
        halvings: usize,
    ) -> Result<Between, MillError> {
        let part = f64::midpoint(parts[0], parts[1]);
        let Some(theta) = way.at(self, part, &ends[0].theta)? else { return Ok(Between::Lost) };
        let moved = self.moved([&ends[0].theta, &theta, &ends[1].theta]);
        let twice = ends[0].distance() + ends[1].distance();
        if moved + 2.0 * self.clearance < twice {
            return Ok(Between::Free);
        }
        let middle = self.posed_to_touch(theta, station, self.is_tool_apart(way));
        // What is so near that no longer step than the least could be free counts as touching at once.
        if self.grazes(&middle) {
            return Ok(Between::Touch(middle.distance(), middle.theta));
        }
        if moved <= LEAST || halvings == 0 {
            return Ok(Between::Touch((twice - moved) / 2.0, middle.theta));
        }
        match self.halved((way, station), [parts[0], part], [ends[0], &middle], halvings - 1)? {
            Between::Free => self.halved((way, station), [part, parts[1]], [&middle, ends[1]], halvings - 1),
            found => Ok(found),
        }
    }

    /// Where it is on a way is known without the arm, and looked at apart.
    pub(super) fn is_tool_apart(&self, way: &Way) -> bool {
        match way {
            Way::Straight { .. } => self.is_tool_round,
            Way::Joints { is_tool_apart, .. } => *is_tool_apart,
        }
    }

    /// Nearer to something than was asked, or hardly farther.
    pub(super) fn grazes(&self, posed: &Posed) -> bool {
        posed.distance() < self.clearance + GRAZED
    }

    /// No point moves farther, m, over a step with this middle. A joint turns by the sum of both halves, and by as much more as it may turn back in
    /// one of them: by the difference of the halves, which holds for every angle that changes as a square of the way.
    fn moved(&self, [from, middle, to]: [&[f64; 6]; 3]) -> f64 {
        let turned = |i: usize| {
            let halves = [middle[i] - from[i], to[i] - middle[i]];
            halves[0].abs() + halves[1].abs() + (halves[1] - halves[0]).abs()
        };
        (0..6).map(|i| turned(i) * self.farthest[i]).sum()
    }
}

/// So far, 0 to 1, from one tool pose to another: the tip goes straight, the axis turns evenly.
pub(super) fn part_way(from: &ToolPose, to: &ToolPose, part: f64) -> ToolPose {
    ToolPose { tip: from.tip.lerp(&to.tip, part), axis: from.axis.lerp(&to.axis, part).normalize() }
}

/// The same angles with the whole turns that lie nearest to others.
fn beside(theta: &[f64; 6], near: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|i| near[i] + wrapped(theta[i] - near[i]))
}
