//! Which cells of a row does the arm reach? Exactly, and once per stretch instead of once per cell.

use std::ops::Range as Span;

use nalgebra::Vector2;

use super::Axis;
use crate::plane::ElbowSide;

/// The reached stretches of rows of a grid.
///
/// What a side reaches is bounded by circles. Along a row the answer can only change where the row crosses one of them,
/// so between two crossings one question settles every cell.
pub(super) struct RowSpans<'a> {
    x: Axis,
    /// The square of every column's x.
    pub(super) squares: Vec<f64>,
    sides: Vec<(&'a ElbowSide, Vec<(Vector2<f64>, f64)>)>,
}

impl<'a> RowSpans<'a> {
    pub(super) fn new(sides: &'a [ElbowSide], x: Axis) -> Self {
        Self {
            x,
            squares: x.points().iter().map(|x| x * x).collect(),
            sides: sides.iter().map(|side| (side, side.boundary_circles())).collect(),
        }
    }

    /// Columns of the row at height `z` that some side reaches: disjoint, in order.
    pub(super) fn reached(&self, z: f64) -> Vec<Span<usize>> {
        let mut spans: Vec<Span<usize>> = (0..self.sides.len()).flat_map(|i| self.reached_by(i, z)).collect();
        spans.sort_by_key(|span| span.start);
        let mut merged: Vec<Span<usize>> = Vec::with_capacity(spans.len());
        for span in spans {
            match merged.last_mut() {
                Some(last) if span.start <= last.end => last.end = last.end.max(span.end),
                _ => merged.push(span),
            }
        }
        merged
    }

    /// Columns of the row at height `z` that side `i` reaches: disjoint, in order.
    pub(super) fn reached_by(&self, i: usize, z: f64) -> Vec<Span<usize>> {
        let (side, circles) = &self.sides[i];
        let half_row = |radius: f64, height: f64| {
            let square = radius * radius - height * height;
            (0.0 <= square).then(|| square.sqrt())
        };
        let Some(far) = half_row(side.ring.max(), z) else { return Vec::new() };
        let mut crossings: Vec<f64> = Vec::with_capacity(2 * circles.len());
        for (centre, radius) in circles {
            if let Some(half) = half_row(*radius, z - centre.y) {
                crossings.extend([centre.x - half, centre.x + half].into_iter().filter(|x| x.abs() <= far));
            }
        }
        crossings.sort_by(f64::total_cmp);
        let mut spans: Vec<Span<usize>> = Vec::new();
        for pair in crossings.windows(2) {
            let span = self.columns(pair[0], pair[1]);
            if span.is_empty() || !side.reaches(Vector2::new(f64::midpoint(pair[0], pair[1]), z)) {
                continue;
            }
            match spans.last_mut() {
                Some(last) if last.end == span.start => last.end = span.end,
                _ => spans.push(span),
            }
        }
        spans
    }

    /// Columns in the half-open stretch `from <= x < to`.
    fn columns(&self, from: f64, to: f64) -> Span<usize> {
        let first = |x: f64| (((x - self.x.start) / self.x.step).ceil().max(0.0) as usize).min(self.x.count);
        first(from)..first(to)
    }
}
