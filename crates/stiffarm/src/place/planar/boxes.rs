//! Places and sets of them: how these are split, and what all places of a set have in common.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use crate::frontier;
use crate::interval::Interval;
use crate::plane::{SLACK, Shape};
use crate::task::Zone;

/// Slack within which a box is given up: less than what a place is granted, so that a box about to become a point
/// either goes or holds a place, and more than rounding, so that no place within its limits is lost.
pub(super) const BOX_SLACK: f64 = SLACK / 2.0;

/// A place on one elbow side, in the zone's own axes from the joint-2 axis, and the turn that carries these axes into the arm plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) side: usize,
    pub(super) centre: Vector2<f64>,
    pub(super) turn: f64,
}

/// The worst of a zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worst {
    /// What counts there, or, where that was asked for, what is proved of all points, m/N.
    pub(super) compliance: f64,
    /// Where, in the zone's own axes from the joint-2 axis.
    pub(super) point: Vector2<f64>,
}

/// A set of places on one elbow side, and a lower bound on their compliance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) lower: f64,
    pub(super) side: usize,
    pub(super) u: Interval,
    pub(super) v: Interval,
    pub(super) turn: Interval,
}

impl frontier::Node for Node {
    /// The least lower bound, of those the smallest box, or the largest where nothing is known.
    fn key(&self) -> [f64; 2] {
        [self.lower, if self.lower == 0.0 { -self.u.width() } else { self.u.width() }]
    }
}

/// The two halves of a box across its longest side; a turn counts as the way it moves a point 1 m out.
pub(super) fn split(node: Node) -> [Node; 2] {
    let (u, v) = (node.u.width(), node.v.width());
    // A set of turns that is wider than half a turn is never searched: the limits choose from it.
    let turn = if node.turn.width() <= PI { node.turn.width() } else { 0.0 };
    if v <= u && turn <= u {
        node.u.halves().map(|u| Node { u, ..node })
    } else if turn <= v {
        node.v.halves().map(|v| Node { v, ..node })
    } else {
        node.turn.halves().map(|turn| Node { turn, ..node })
    }
}

/// The points of a box with the least and the greatest `|u|`, `|v|`.
pub(super) fn corners(u: Interval, v: Interval) -> (Vector2<f64>, Vector2<f64>) {
    let least = |range: Interval| range.clamp(0.0).abs();
    let most = |range: Interval| range.min().abs().max(range.max().abs());
    (Vector2::new(least(u), least(v)), Vector2::new(most(u), most(v)))
}

/// What every zone with its centre in the box covers (`true`), or, where they share nothing, a figure that each touches.
pub(super) fn core(zone: Zone, u: Interval, v: Interval) -> (Shape, bool) {
    let middle = Vector2::new(u.middle(), v.middle());
    match zone {
        Zone::Circle { diameter } => {
            let radius = diameter / 2.0 - u.width().hypot(v.width()) / 2.0;
            (Shape::Disc(middle, radius.abs()), 0.0 <= radius)
        }
        Zone::Rectangle { width, height } => {
            let half = Vector2::new(width - u.width(), height - v.width()) / 2.0;
            if 0.0 <= half.x && 0.0 <= half.y {
                (Shape::Rectangle(middle, half), true)
            } else {
                // Along an axis on which they share a stretch, its middle will do.
                (Shape::Rectangle(middle, half.map(|h| (-h).max(0.0))), false)
            }
        }
    }
}

/// A figure that holds every zone with its centre in the box.
pub(super) fn hull(zone: Zone, u: Interval, v: Interval) -> Shape {
    let middle = Vector2::new(u.middle(), v.middle());
    let half = match zone {
        Zone::Circle { diameter } => Vector2::repeat(diameter),
        Zone::Rectangle { width, height } => Vector2::new(width, height),
    };
    Shape::Rectangle(middle, (half + Vector2::new(u.width(), v.width())) / 2.0)
}

/// The least span of a zone along a direction, of all directions at these angles to its first side.
///
/// One segment in the zone has at least this component along every one of them: what grows along such a direction
/// throughout grows by as much from one end to the other.
pub(super) fn least_span(zone: Zone, angles: Interval) -> f64 {
    match zone {
        // The middle direction's diameter.
        Zone::Circle { diameter } => diameter * (angles.width() / 2.0).min(FRAC_PI_2).cos(),
        Zone::Rectangle { width, height } => {
            let least = |range: Interval| range.clamp(0.0).abs();
            width * least(cosine_over(angles)) + height * least(cosine_over(angles.affine(1.0, -FRAC_PI_2)))
        }
    }
}

/// Do two ranges of angles share one up to whole turns?
pub(super) fn meets(allowed: Interval, turn: Interval) -> bool {
    if !allowed.is_bounded() {
        return true;
    }
    let period = 2.0 * PI;
    let first = ((allowed.min() - BOX_SLACK - turn.max()) / period).ceil() * period;
    turn.min() + first <= allowed.max() + BOX_SLACK
}

/// The range of the cosine over a range of angles.
pub(super) fn cosine_over(angles: Interval) -> Interval {
    if 2.0 * PI <= angles.width() {
        return Interval::spanning(-1.0, 1.0);
    }
    let ends = Interval::spanning(angles.min().cos(), angles.max().cos());
    let passes = |x: f64| angles.turn_to(x, 0.0).is_some();
    Interval::spanning(if passes(PI) { -1.0 } else { ends.min() }, if passes(0.0) { 1.0 } else { ends.max() })
}

pub(super) fn product(a: Interval, b: Interval) -> Interval {
    let ends = [a.min() * b.min(), a.min() * b.max(), a.max() * b.min(), a.max() * b.max()];
    Interval::spanning(
        ends.into_iter().fold(f64::INFINITY, f64::min),
        ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
    )
}

/// Half the width and height that the zone takes at least over a set of turns.
pub(super) fn least_half_extents(zone: Zone, turn: Interval) -> Vector2<f64> {
    if turn.width() == 0.0 {
        return zone.half_extents(turn.min());
    }
    let least = |range: Interval| range.clamp(0.0).abs();
    let (cos, sin) = (least(cosine_over(turn)), least(cosine_over(turn.affine(1.0, -FRAC_PI_2))));
    match zone {
        Zone::Circle { diameter } => Vector2::repeat(diameter / 2.0),
        Zone::Rectangle { width, height } => Vector2::new(width * cos + height * sin, width * sin + height * cos) / 2.0,
    }
}
