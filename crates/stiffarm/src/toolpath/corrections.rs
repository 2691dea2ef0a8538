//! Where the tool is to go in place of a move, in as few straight moves as keep to it.

use super::moves::{Course, Given, Move, MoveKind, ToolPose};
use super::samples::{Sample, Steps, samples};

/// By how much the tool axis may be off between two places that are written, rad: 1 um at 100 mm.
const TURN: f64 = 1e-5;

/// Who takes the moves of a reader.
pub(super) type Sink<'a> = &'a mut dyn FnMut(&Move);

/// A place in place of a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) pose: ToolPose,
    /// How much of the move lies behind it.
    pub(super) share: f64,
}

/// Asks for every sample of a path, move after move.
pub(super) struct Corrections<'a> {
    steps: &'a Steps,
    straight: f64,
    corrected: &'a mut dyn FnMut(&Sample) -> ToolPose,
    way: f64,
    /// By how much the tool axis is off where the file cannot say it, rad, at most.
    pub(super) turn_lost: f64,
    /// How far from its place in the original a move that is kept ends, m, at most.
    pub(super) aside: f64,
    /// Arcs that became straight moves.
    pub(super) arcs: usize,
    /// Feed moves that are kept as they are, since a cycle makes them.
    pub(super) of_cycles: usize,
}

impl<'a> Corrections<'a> {
    pub(super) fn new(steps: &'a Steps, straight: f64, corrected: &'a mut dyn FnMut(&Sample) -> ToolPose) -> Self {
        Self { steps, straight, corrected, way: 0.0, turn_lost: 0.0, aside: 0.0, arcs: 0, of_cycles: 0 }
    }

    /// All places of a move, that of its beginning first. Where the file cannot say the tool axis (`tilts` is false), it stays.
    fn places(&mut self, one: &Move, tilts: bool) -> Vec<Place> {
        let pieces = self.steps.pieces(one) as f64;
        let mut places = Vec::new();
        for (i, sample) in samples(one, self.steps, self.way).enumerate() {
            let mut pose = (self.corrected)(&sample);
            if !tilts {
                self.turn_lost = self.turn_lost.max(between(&pose, &sample.pose));
                pose.axis = sample.pose.axis;
            }
            places.push(Place { pose, share: i as f64 / pieces });
        }
        self.way += one.length();
        places
    }

    /// The places that are written of a move, the tool standing at `start`; and where it was to begin.
    pub(super) fn through(&mut self, one: &Move, start: impl FnOnce(&ToolPose) -> ToolPose, tilts: bool) -> Vec<Place> {
        self.arcs += usize::from(one.course != Course::Line);
        let mut places = self.places(one, tilts);
        if let Some(first) = places.first_mut() {
            let stands = start(&first.pose);
            // Where the force jumps from one feed move to the next, or begins after a rapid one, the correction does: that is a way of its own.
            if self.straight < (first.pose.tip - stands.tip).norm() {
                let stands = Place { pose: stands, share: 0.0 };
                places.insert(0, stands);
            } else {
                first.pose = stands;
            }
        }
        thinned(&places, self.straight)
    }

    /// A move that is kept.
    pub(super) fn skip(&mut self, one: &Move) {
        self.of_cycles += usize::from(one.kind == MoveKind::Feed);
        // It is asked for all the same: who answers by counting goes on.
        for sample in samples(one, self.steps, self.way) {
            (self.corrected)(&sample);
        }
        self.way += one.length();
    }
}

/// The angle between two tool axes, rad.
pub(super) fn between(a: &ToolPose, b: &ToolPose) -> f64 {
    a.axis.cross(&b.axis).norm().atan2(a.axis.dot(&b.axis))
}

/// The places without the first that must be gone to, so that straight moves leave out none by more than `straight`: halves are
/// parted at the place that is off the farthest, as Douglas and Peucker do.
fn thinned(places: &[Place], straight: f64) -> Vec<Place> {
    let mut kept = Vec::new();
    let mut open = vec![(0, places.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let off = |at: usize| off(&places[first], &places[last], &places[at], straight);
        let worst = (first + 1..last).map(|at| (off(at), at)).max_by(|a, b| a.0.total_cmp(&b.0));
        match worst {
            Some((off, at)) if 1.0 < off => open.extend([(at, last), (first, at)]),
            _ => kept.push(places[last]),
        }
    }
    kept
}

/// How far a place is off the straight move between two others, as a share of what is allowed.
fn off(first: &Place, last: &Place, at: &Place, straight: f64) -> f64 {
    let (from, to) = (first.pose, last.pose);
    let along = to.tip - from.tip;
    let length = along.norm_squared();
    let by_share = (at.share - first.share) / (last.share - first.share);
    let t = if 0.0 < length { ((at.pose.tip - from.tip).dot(&along) / length).clamp(0.0, 1.0) } else { by_share };
    let line = Move {
        line: 0,
        kind: MoveKind::Feed,
        from,
        to,
        course: Course::Line,
        feed: None,
        normals: None,
        given: Given::default(),
    };
    let there = ToolPose { tip: line.tip(t), axis: line.axis(t) };
    ((at.pose.tip - there.tip).norm() / straight).max(between(&at.pose, &there) / TURN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    fn place(x: f64, y: f64, share: f64) -> Place {
        Place { pose: ToolPose { tip: Vector3::new(x, y, 0.0), axis: Vector3::z() }, share }
    }

    #[test]
    fn a_straight_row_needs_its_end_and_a_corner_both_sides() {
        let row: Vec<Place> = (0..=10).map(|i| place(f64::from(i), 0.0, 0.1 * f64::from(i))).collect();
        assert_eq!(thinned(&row, 1e-6).iter().map(|one| one.pose.tip.x).collect::<Vec<_>>(), [10.0]);
        let mut corner = row.clone();
        corner[4].pose.tip.y = 2e-6;
        assert_eq!(thinned(&corner, 1e-6).iter().map(|one| one.pose.tip.x).collect::<Vec<_>>(), [3.0, 4.0, 5.0, 10.0]);
        assert_eq!(thinned(&corner, 3e-6).len(), 1);
    }

    /// To and fro on one line: the place farthest out is no end, and may not be left out.
    #[test]
    fn a_way_back_is_not_left_out() {
        let places = [place(0.0, 0.0, 0.0), place(2.0, 0.0, 0.5), place(1.0, 0.0, 1.0)];
        assert_eq!(thinned(&places, 1e-6).len(), 2);
    }
}
