//! The line in the middle of a capsule, and how far points are from it.

use super::{Vec3, corners};
use crate::body::Capsule;

/// A line from end to end, ready for many points.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    start: Vec3,
    along: Vec3,
    /// `along` over the square of its length: with it, a product tells which part of the line lies before a point.
    per_length: Vec3,
}

/// How a point is seen from a line.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    /// The part of the line before its point that is nearest.
    pub(super) part: f64,
    /// From there.
    pub(super) away: Vec3,
    /// Of that distance.
    pub(super) square: f64,
}

impl Axis {
    pub(super) fn of(capsule: &Capsule) -> Self {
        let [start, end] = capsule.ends;
        let along = end - start;
        let square = along.norm_squared();
        Self { start, along, per_length: if 0.0 < square { along / square } else { Vec3::zeros() } }
    }

    fn seen(&self, point: &Vec3) -> Seen {
        let from = point - self.start;
        let part = from.dot(&self.per_length).clamp(0.0, 1.0);
        let away = from - self.along * part;
        Seen { part, away, square: away.norm_squared() }
    }

    /// How the points are seen, and the largest of their distances.
    pub(super) fn see(&self, points: &[Vec3], seen: &mut Vec<Seen>) -> f64 {
        seen.clear();
        seen.extend(points.iter().map(|point| self.seen(point)));
        seen.iter().map(|point| point.square).fold(0.0, f64::max).sqrt()
    }

    /// From the nearest point of the line.
    pub(super) fn away(&self, point: &Vec3) -> Vec3 {
        self.seen(point).away
    }

    /// The largest distance of a point from the line.
    pub(super) fn reach(&self, points: &[Vec3]) -> f64 {
        points.iter().map(|point| self.seen(point).square).fold(0.0, f64::max).sqrt()
    }

    /// Along a row of points parallel to x, so far apart: how deep they lie within a radius, where that is deeper.
    pub(super) fn deepen(&self, first: &Vec3, apart: f64, radius: f64, deepest: &mut [f64]) {
        let from = first - self.start;
        let (part, step) = (from.dot(&self.per_length), apart * self.per_length.x);
        for (i, deepest) in deepest.iter_mut().enumerate() {
            let i = i as f64;
            let part = (part + i * step).clamp(0.0, 1.0);
            let [x, y, z] =
                [from.x + i * apart - part * self.along.x, from.y - part * self.along.y, from.z - part * self.along.z];
            *deepest = deepest.max(radius - (x * x + y * y + z * z).sqrt());
        }
    }
}

impl Capsule {
    pub(super) fn about(ends: [Vec3; 2], points: &[Vec3]) -> Self {
        let line = Self { ends, radius: 0.0 };
        Self { radius: Axis::of(&line).reach(points), ..line }
    }

    /// Through the middle of the points along an axis, half as long as they are.
    pub(super) fn along(axis: &Vec3, points: &[Vec3]) -> Self {
        let (low, high) = corners(points);
        let span = points.iter().map(|point| (point - (low + high) / 2.0).dot(axis).abs()).fold(0.0, f64::max);
        Self::about([-0.5, 0.5].map(|part| (low + high) / 2.0 + axis * (part * span)), points)
    }
}
