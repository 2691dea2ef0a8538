//! What does a round tool touch of what stands about the arm? It stands on its own axis: at a sample, and on the straight way to one, the path alone
//! says where it is. That is looked at once, and not for every roll and configuration.

use super::step::{MOST_HALVINGS, part_way};
use super::{Contact, Guard, PLACES, deeper, nearer};
use crate::clearance::{Looked, Near};
use crate::mill::fault::MillError;
use crate::mill::stations::Station;
use crate::parallel;
use crate::toolpath::ToolPose;
use crate::watch::Watch;

/// What is farther by less than this, m, than was asked is as if it touched.
const GRAZED: f64 = 5e-5;
/// What a tool comes near to along a path.
pub(super) struct ToolAlong {
    /// The nearest at every station.
    at: Vec<Option<Near>>,
    /// What is touched on the straight way to every station; nothing where it is touched at one end of it.
    on_way: Vec<Option<Near>>,
}

/// A tool pose, and the distance to what is nearest there, m.
#[derive(Clone, Copy)]
struct Placed {
    pose: ToolPose,
    distance: f64,
}

impl ToolAlong {
    /// The nearest at a station, or on the way to it where the tool goes straight, and whether it touches.
    pub(super) fn near(&self, station: usize, goes_straight: bool, asked: f64) -> (Option<Near>, bool) {
        let on_way = self.on_way[station].filter(|_| goes_straight);
        let near = nearer(on_way, self.at[station]);
        (near, on_way.is_some() || touches(near.as_ref(), asked))
    }

    /// The deepest of what is touched at a station, or on the way to one to which every path goes straight.
    pub(super) fn deepest(&self, guard: &Guard) -> Option<Contact> {
        let of = |(i, station): (usize, &Station)| {
            let (near, touches) = self.near(i, !station.is_fresh, guard.clearance);
            near.filter(|_| touches).map(|near| guard.contact(i, &near))
        };
        guard.stations.iter().enumerate().map(of).fold(None, deeper)
    }
}

impl Guard<'_> {
    /// `None` of a tool that is looked at with the arm.
    pub(super) fn tool_along(&self, watch: Watch) -> Result<Option<ToolAlong>, MillError> {
        if !self.is_tool_round {
            return Ok(None);
        }
        watch.go_on()?;
        let count = self.stations.len();
        let of_station = |i: usize| self.tool_near(&self.stations[i].sample.pose, i, Looked::ALL);
        let at: Vec<Option<Near>> = parallel::each_of(count, of_station);
        watch.go_on()?;
        let on_way = |i: usize| {
            let ends = [i.checked_sub(1)?, i];
            if ends.iter().any(|end| touches(at[*end].as_ref(), self.clearance)) {
                return None;
            }
            let [from, to] = ends.map(|end| Placed {
                pose: self.stations[end].sample.pose,
                distance: at[end].map_or(f64::INFINITY, |near| near.distance),
            });
            let touched = self.tool_between(i, [from, to], MOST_HALVINGS)?;
            let places = (1..PLACES).map(|place| part_way(&from.pose, &to.pose, place as f64 / PLACES as f64));
            places.chain([touched]).map(|pose| self.tool_near(&pose, i, Looked::ALL)).fold(None, nearer)
        };
        let on_way = parallel::each_of(count, on_way);
        Ok(Some(ToolAlong { at, on_way }))
    }

    /// The place of a straight way on which the tool touches something, as [`super::step`] decides it of the arm.
    ///
    /// No point of a tool of the length `l` and the radius `r` moves farther than its tip, and by `hypot(l, r)` times what its axis turns; both
    /// add up along the way.
    fn tool_between(&self, station: usize, ends: [Placed; 2], halvings: usize) -> Option<ToolPose> {
        let [from, to] = &ends;
        let pose = part_way(&from.pose, &to.pose, 0.5);
        let moved = self.tool_moved(&from.pose, &pose) + self.tool_moved(&pose, &to.pose);
        if moved + 2.0 * self.clearance < from.distance + to.distance {
            return None;
        }
        let looked = Looked { enough: self.clearance + GRAZED, within: self.clearance + moved, is_tool_apart: false };
        let distance = self.tool_near(&pose, station, looked).map_or(looked.within, |near| near.distance);
        if distance < looked.enough || halvings == 0 {
            return Some(pose);
        }
        let middle = Placed { pose, distance };
        let halves = [[*from, middle], [middle, *to]];
        halves.into_iter().find_map(|half| self.tool_between(station, half, halvings - 1))
    }

    fn tool_near(&self, ToolPose { tip, axis }: &ToolPose, station: usize, looked: Looked) -> Option<Near> {
        // The tool's z leads into the work.
        let flange = self.stand.flange_from_tool.inverse().translation.vector.z;
        let ends =
            [tip - axis * flange, *tip].map(|end| (self.stand.base_from_part * nalgebra::Point3::from(end)).coords);
        self.thick.nearest_of_tool(ends, (&self.about, station), looked)
    }

    fn tool_moved(&self, from: &ToolPose, to: &ToolPose) -> f64 {
        (to.tip - from.tip).norm() + from.axis.angle(&to.axis) * self.farthest_of_tool
    }
}

fn touches(near: Option<&Near>, asked: f64) -> bool {
    near.is_some_and(|near| near.distance < asked)
}
