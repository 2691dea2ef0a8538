//! Which cells of a row does the arm reach? Exactly, and once per stretch instead of once per cell.

use std::f64::consts::PI;
use std::ops::Range as Span;

use nalgebra::Vector2;

use super::Axis;
use crate::interval::Interval;
use crate::plane::{Elbow, ElbowSide};

/// The part of a step within which a column counts as standing on the edge.
const EDGE: f64 = 1e-9;

/// The reached stretches of rows of a grid.
///
/// What a side reaches is bounded by circles. Along a row the answer can only change where the row crosses one of them,
/// so between two crossings one question settles every cell.
pub(super) struct RowSpans<'a> {
    x: Axis,
    /// Every column's x.
    pub(super) points: Vec<f64>,
    /// Their squares.
    pub(super) squares: Vec<f64>,
    gates: Vec<Gate<'a>>,
}

/// Memory that rows share.
#[derive(Default)]
pub(super) struct Scratch {
    crossings: Vec<f64>,
    of_side: Vec<Span<usize>>,
    /// Columns found by the last call: disjoint, in order.
    pub(super) spans: Vec<Span<usize>>,
}

impl<'a> RowSpans<'a> {
    pub(super) fn new(sides: &'a [ElbowSide], x: Axis) -> Self {
        let points = x.points();
        let squares = points.iter().map(|x| x * x).collect();
        Self { x, points, squares, gates: sides.iter().map(Gate::new).collect() }
    }

    /// Finds the columns of the row at height `z` that some side reaches.
    pub(super) fn reached(&self, z: f64, scratch: &mut Scratch) {
        scratch.spans.clear();
        for gate in &self.gates {
            self.append(gate, z, scratch);
            scratch.spans.append(&mut scratch.of_side);
        }
        if 1 < self.gates.len() {
            merge(&mut scratch.spans);
        }
    }

    /// Finds the columns of the row at height `z` that are reached, and whether with the elbow up, with the elbow down.
    pub(super) fn by_elbow(&self, z: f64, scratch: &mut Scratch, pieces: &mut Vec<(Span<usize>, [bool; 2])>) {
        let [up, down] = [Elbow::Up, Elbow::Down].map(|elbow| {
            scratch.spans.clear();
            for gate in self.gates.iter().filter(|gate| gate.side.elbow == elbow) {
                self.append(gate, z, scratch);
                scratch.spans.append(&mut scratch.of_side);
            }
            merge(&mut scratch.spans);
            std::mem::take(&mut scratch.spans)
        });
        pieces.clear();
        let ends = |spans: &[Span<usize>]| spans.iter().flat_map(|span| [span.start, span.end]).collect::<Vec<_>>();
        let mut cuts = [ends(&up), ends(&down)].concat();
        cuts.sort_unstable();
        cuts.dedup();
        let holds = |spans: &[Span<usize>], at: usize| spans.iter().any(|span| span.contains(&at));
        pieces.extend(cuts.windows(2).filter_map(|pair| {
            let by = [holds(&up, pair[0]), holds(&down, pair[0])];
            (by != [false; 2]).then_some((pair[0]..pair[1], by))
        }));
    }

    fn append(&self, gate: &Gate, z: f64, scratch: &mut Scratch) {
        let half_row = |radius: f64, height: f64| {
            let square = radius * radius - height * height;
            (0.0 <= square).then(|| square.sqrt())
        };
        let Some(far) = half_row(gate.side.ring.max(), z) else {
            return;
        };
        let crossings = &mut scratch.crossings;
        crossings.clear();
        for (centre, radius) in &gate.circles {
            if let Some(half) = half_row(*radius, z - centre.y) {
                crossings.extend([centre.x - half, centre.x + half].into_iter().filter(|x| x.abs() <= far));
            }
        }
        crossings.sort_unstable_by(f64::total_cmp);
        for pair in crossings.windows(2) {
            let span = self.columns(pair[0], pair[1]);
            if span.is_empty() || !gate.admits(Vector2::new(f64::midpoint(pair[0], pair[1]), z)) {
                continue;
            }
            match scratch.of_side.last_mut() {
                Some(last) if span.start <= last.end => last.end = last.end.max(span.end),
                _ => scratch.of_side.push(span),
            }
        }
    }

    /// Columns in the stretch `from <= x <= to`: both ends count, as the reached set holds its edge.
    fn columns(&self, from: f64, to: f64) -> Span<usize> {
        let steps = |x: f64| (x - self.x.start) / self.x.step;
        // A column at an end must not be lost to rounding.
        let (from, to) = (steps(from) - EDGE, steps(to) + EDGE);
        let count = |steps: f64| (steps.max(0.0) as usize).min(self.x.count);
        count(from.ceil())..count(to.floor() + 1.0)
    }
}

/// Puts spans in order and joins those that overlap or touch.
fn merge(spans: &mut Vec<Span<usize>>) {
    spans.sort_unstable_by_key(|span| span.start);
    spans.dedup_by(|next, last| {
        let joined = next.start <= last.end;
        if joined {
            last.end = last.end.max(next.end);
        }
        joined
    });
}

/// Decides whether one side reaches a point, without angles where the limits allow it.
struct Gate<'a> {
    side: &'a ElbowSide,
    circles: Vec<(Vector2<f64>, f64)>,
    /// The sectors in which upper arm and forearm must point; `None` where whole turns must be counted.
    sectors: Option<[Sector; 2]>,
}

impl<'a> Gate<'a> {
    fn new(side: &'a ElbowSide) -> Self {
        let sectors = [Sector::new(side.shoulder), Sector::new(side.forearm)];
        let [Some(upper), Some(forearm)] = sectors else {
            return Self { side, circles: side.boundary_circles(), sectors: None };
        };
        // The forearm a whole turn away from an allowed angle must be out of reach for every allowed shoulder angle.
        let both = side.shoulder.is_bounded() && side.forearm.is_bounded();
        let reached = side.shoulder.plus(Interval::spanning(0.0, side.elbow.sign() * PI));
        let alias = |turns: f64| side.forearm.affine(1.0, turns * 2.0 * PI).intersect(reached).is_some();
        let plain = !both || !(alias(1.0) || alias(-1.0) || alias(2.0) || alias(-2.0));
        Self { side, circles: side.boundary_circles(), sectors: plain.then_some([upper, forearm]) }
    }

    fn admits(&self, p: Vector2<f64>) -> bool {
        let Some([upper_sector, forearm_sector]) = &self.sectors else {
            return self.side.reaches(p);
        };
        self.side.ring.contains(p.norm(), 0.0)
            && self.side.upper_arm(p).is_some_and(|upper| upper_sector.holds(upper) && forearm_sector.holds(p - upper))
    }
}

/// The directions of a range of angles.
enum Sector {
    All,
    /// Between two unit vectors, counter-clockwise, at most half a turn.
    Narrow(Vector2<f64>, Vector2<f64>),
    /// The same, more than half a turn.
    Wide(Vector2<f64>, Vector2<f64>),
}

impl Sector {
    /// `None` for a range that is bounded at one end only.
    fn new(range: Interval) -> Option<Self> {
        let unit = |angle: f64| Vector2::new(angle.cos(), angle.sin());
        if range.is_all() || 2.0 * PI <= range.width() && range.is_bounded() {
            Some(Self::All)
        } else if !range.is_bounded() {
            None
        } else if range.width() <= PI {
            Some(Self::Narrow(unit(range.min()), unit(range.max())))
        } else {
            Some(Self::Wide(unit(range.min()), unit(range.max())))
        }
    }

    fn holds(&self, v: Vector2<f64>) -> bool {
        match self {
            Self::All => true,
            Self::Narrow(first, last) => 0.0 <= first.perp(&v) && 0.0 <= v.perp(last),
            Self::Wide(first, last) => 0.0 <= first.perp(&v) || 0.0 <= v.perp(last),
        }
    }
}
