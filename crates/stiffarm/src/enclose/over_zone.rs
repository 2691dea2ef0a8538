//! Where in a zone is something least, and how low can it be at most? Branch and bound over parts of the zone.

use std::f64::consts::PI;

use super::affine::{Affine, sin_cos};
use crate::frontier::{self, Frontier};
use crate::interval::Interval;
use crate::task::Zone;

/// Parts of a zone that are enclosed before the search stops with the bound it has.
const MOST_PARTS: usize = 5000;

/// The least of a function over a zone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeastOverZone {
    /// Nowhere in the zone is less; minus infinity where nothing is known.
    pub(crate) bound: f64,
    /// The least that was found.
    pub(crate) found: f64,
    /// Where, m from the centre of the zone along its sides.
    pub(crate) at: [f64; 2],
    /// Into how many parts the zone was cut.
    pub(crate) parts: usize,
}

/// A part of a zone (sides of a rectangle, or radius and angle on a disc), and a lower bound on the least value in it.
struct Part {
    sides: [Interval; 2],
    least: f64,
}

impl frontier::Node for Part {
    fn key(&self) -> [f64; 2] {
        [self.least, 0.0]
    }
}

/// The least of a function, from its `value` at points and lower bounds over all points of a part, minus infinity where none is known.
///
/// Ends as soon as `is_enough` of the bound and the least that was found.
pub(crate) fn least_over(
    zone: Zone,
    is_enough: impl Fn(f64, f64) -> bool,
    bound: impl Fn([Affine<2>; 2]) -> f64,
    value: impl Fn([f64; 2]) -> f64,
) -> LeastOverZone {
    let mut queue = Frontier::new();
    let mut found = LeastOverZone { bound: f64::NEG_INFINITY, found: f64::INFINITY, at: [0.0; 2], parts: 0 };
    let whole = match zone {
        Zone::Circle { diameter } => [Interval::spanning(0.0, diameter / 2.0), Interval::spanning(-PI, PI)],
        Zone::Rectangle { width, height } => [width, height].map(|side| Interval::spanning(-side / 2.0, side / 2.0)),
    };
    queue.push(Part { sides: whole, least: f64::NEG_INFINITY });
    while let Some(Part { sides, least }) = queue.pop() {
        found.bound = least.min(found.found);
        if is_enough(least, found.found) || MOST_PARTS < found.parts {
            return found;
        }
        for sides in halves(zone, sides) {
            found.parts += 1;
            let least_here = bound(points(zone, sides));
            queue.push(Part { sides, least: least.max(least_here) });
            if found.found <= least_here {
                continue;
            }
            for at in corners(zone, sides) {
                let here = value(at);
                if here < found.found {
                    (found.found, found.at) = (here, at);
                }
            }
        }
    }
    found
}

/// The two halves of a part across its longer side; an angle counts as the length of its arc on the rim.
fn halves(zone: Zone, sides: [Interval; 2]) -> [[Interval; 2]; 2] {
    let lever = match zone {
        Zone::Circle { .. } => sides[0].max(),
        Zone::Rectangle { .. } => 1.0,
    };
    let longer = usize::from(sides[0].width() < lever * sides[1].width());
    sides[longer].halves().map(|half| {
        let mut part = sides;
        part[longer] = half;
        part
    })
}

/// All points of a part, m from the centre of the zone.
fn points(zone: Zone, sides: [Interval; 2]) -> [Affine<2>; 2] {
    let length = |i: usize| {
        let mut length = Affine::point(sides[i].middle());
        length.deviations[i] = sides[i].width() / 2.0;
        length
    };
    match zone {
        Zone::Rectangle { .. } => [length(0), length(1)],
        Zone::Circle { .. } => {
            let (sine, cosine) = sin_cos::<2>(sides[1], 1);
            [length(0) * cosine, length(0) * sine]
        }
    }
}

fn corners(zone: Zone, sides: [Interval; 2]) -> [[f64; 2]; 4] {
    let corner = |a: f64, b: f64| match zone {
        Zone::Rectangle { .. } => [a, b],
        Zone::Circle { .. } => [a * b.cos(), a * b.sin()],
    };
    let [first, second] = sides;
    [
        corner(first.min(), second.min()),
        corner(first.min(), second.max()),
        corner(first.max(), second.min()),
        corner(first.max(), second.max()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `(u - 0.1)^2 + v^2`: zero at (0.1, 0), by affine squares.
    #[test]
    fn the_least_of_a_square_is_found_and_bounded_from_below() {
        let near = |bound: f64, found: f64| found - 1e-4 <= bound;
        for zone in [Zone::Circle { diameter: 0.6 }, Zone::Rectangle { width: 0.4, height: 1.0 }] {
            let bound = |[u, v]: [Affine<2>; 2]| ((u + -0.1).square() + v.square()).min();
            let found = least_over(zone, near, bound, |[u, v]| (u - 0.1).powi(2) + v * v);
            assert!(found.bound <= 0.0 && -1e-4 <= found.bound && found.found <= 1e-4, "{zone:?}: {found:?}");
            assert!((found.at[0] - 0.1).abs() < 0.011 && found.at[1].abs() < 0.011, "{zone:?}: {found:?}");
        }
    }

    #[test]
    fn where_nothing_is_known_of_any_part_the_search_ends_without_a_bound() {
        let zone = Zone::Rectangle { width: 1.0, height: 1.0 };
        let found = least_over(zone, |bound, found| found <= bound, |_| f64::NEG_INFINITY, |_| 1.0);
        assert_eq!((found.bound, found.found), (f64::NEG_INFINITY, 1.0));
        assert!(MOST_PARTS < found.parts);
    }
}
