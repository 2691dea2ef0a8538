//! What a path is, in a few numbers: lengths, moves by kind, extents, feed rates, tool axes, time.

use nalgebra::Vector3;

use super::moves::{Course, Move, MoveKind, ToolPose};
use super::samples::Steps;
use crate::interval::Interval;

/// Counts and lengths of a path, move by move.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// Of all feed moves, m.
    pub feed_length: f64,
    /// Of all rapid moves, m.
    pub rapid_length: f64,
    /// Moves at a feed rate.
    pub feed_moves: usize,
    /// Rapid moves.
    pub rapid_moves: usize,
    /// Feed moves that are arcs or helices.
    pub arcs: usize,
    /// Of these, those of a whole turn or more.
    pub full_circles: usize,
    /// Of the arcs, m.
    pub arc_length: f64,
    /// The corners of the box about all feed moves, m; `None` where there is none.
    pub extent: Option<[Vector3<f64>; 2]>,
    /// The corners of the box about the ends of all rapid moves, m; `None` where there is none.
    pub rapid_extent: Option<[Vector3<f64>; 2]>,
    /// Of feed rates, m/s; `None` where none is said.
    pub feeds: Option<Interval>,
    /// Of all feed moves, s; `None` where a feed rate is missing.
    pub feed_time: Option<f64>,
    /// How fast the spindle turns while it feeds, rad/s; `None` where that is not said.
    pub spindles: Option<Interval>,
    /// The largest angle between the tool axis and z while it feeds, rad.
    pub tilt: f64,
    /// The largest turn of the tool axis over the path, from where it first feeds, rad.
    pub turn: f64,
    /// Samples of the feed moves as [`Steps`] cuts them.
    pub samples: usize,
    /// By how much the chords between these are off the arcs at most, m.
    pub chord_error: f64,
    /// The tools that feed in the order in which they come, each with the line at which it first does; `None` where none was named before.
    pub tools: Vec<(Option<u32>, usize)>,
    /// Where the path ends.
    pub end: Option<ToolPose>,
    first_axis: Option<Vector3<f64>>,
    steps: Steps,
}

impl Survey {
    /// Of nothing yet; `steps` say how samples are counted.
    pub fn new(steps: Steps) -> Self {
        Self {
            feed_length: 0.0,
            rapid_length: 0.0,
            feed_moves: 0,
            rapid_moves: 0,
            arcs: 0,
            full_circles: 0,
            arc_length: 0.0,
            extent: None,
            rapid_extent: None,
            feeds: None,
            feed_time: Some(0.0),
            spindles: None,
            tilt: 0.0,
            turn: 0.0,
            samples: 0,
            chord_error: 0.0,
            tools: Vec::new(),
            end: None,
            first_axis: None,
            steps,
        }
    }

    /// One more move.
    pub fn add(&mut self, one: &Move) {
        self.end = Some(one.to);
        let length = one.length();
        if one.kind == MoveKind::Rapid {
            self.rapid_length += length;
            self.rapid_moves += 1;
            hold(&mut self.rapid_extent, &one.to.tip);
            return;
        }
        self.feed_length += length;
        self.feed_moves += 1;
        if self.tools.iter().all(|(tool, _)| *tool != one.given.tool) {
            self.tools.push((one.given.tool, one.line));
        }
        hold(&mut self.extent, &one.from.tip);
        hold(&mut self.extent, &one.to.tip);
        if let Course::Arc(arc) = &one.course {
            self.arcs += 1;
            self.full_circles += usize::from(std::f64::consts::TAU - 1e-9 <= arc.angle);
            self.arc_length += length;
            for t in one.extremes() {
                hold(&mut self.extent, &one.tip(t));
            }
        }
        self.take_time(one, length);
        self.take_axes(one);
        let pieces = self.steps.pieces(one);
        self.samples += pieces + 1;
        self.chord_error = self.chord_error.max(one.chord_error(1.0 / pieces as f64));
    }

    fn take_time(&mut self, one: &Move, length: f64) {
        if let Some(spindle) = one.given.spindle {
            self.spindles = Some(widened(self.spindles, spindle));
        }
        if let Some(feed) = one.feed {
            self.feeds = Some(widened(self.feeds, feed));
            self.feed_time = self.feed_time.map(|time| time + length / feed);
        } else if 0.0 < length {
            self.feed_time = None;
        }
    }

    fn take_axes(&mut self, one: &Move) {
        let first = *self.first_axis.get_or_insert(one.from.axis);
        for axis in [one.from.axis, one.to.axis] {
            let angle = |to: Vector3<f64>| axis.cross(&to).norm().atan2(axis.dot(&to));
            if axis != Vector3::z() {
                self.tilt = self.tilt.max(angle(Vector3::z()));
            }
            if axis != first {
                self.turn = self.turn.max(angle(first));
            }
        }
    }
}

/// An interval that holds a number, too.
fn widened(known: Option<Interval>, number: f64) -> Interval {
    known.map_or(Interval::spanning(number, number), |known| {
        Interval::spanning(known.min().min(number), known.max().max(number))
    })
}

/// A box that holds a tip, too.
fn hold(extent: &mut Option<[Vector3<f64>; 2]>, tip: &Vector3<f64>) {
    let [low, high] = extent.get_or_insert([*tip, *tip]);
    *low = low.inf(tip);
    *high = high.sup(tip);
}
