//! How much of the tool is in the work along a three-axis path, from what is left of the stock. And what is left there for an arm to touch.
//!
//! The stock is a field of heights: one number for each cell of a grid, above which there is nothing. A flat mill whose axis is z
//! lowers the cells it passes over. What its front lowers on the last short way to a sample is the engagement there: arcs of the rim, each
//! with its axial depth. Air carries no force, corners carry more, and walls that stand beside the tool or before it are not cut. Angles count
//! as in [`cutting`](crate::cutting): from the left of the feed, clockwise from above.
//!
//! A wall beside the axis of a tool of radius R is off by up to a cell, an angle by `cell / (R sin(phi))`; along the way the
//! engagement is the mean over four cells.

mod front;
mod remains;

use nalgebra::{Vector2, Vector3};

use crate::cutting::{CutArc, Engagement};
use crate::toolpath::{Move, MoveKind, Sample, Steps, samples};
use crate::watch::{Stopped, Watch};
use front::Front;
pub use remains::Remains;
pub(crate) use remains::Square;
use remains::{Squares, StockCells};

/// More cells need more than 400 MB.
const MOST_CELLS: f64 = 5e7;

/// Over so many cells of the way the front of the mill is looked at.
const WINDOW: f64 = 4.0;

/// What is cut between two samples and at neither counts from this share of what the tool passes over.
const BETWEEN: f64 = 0.01;

/// A way that goes across by no more than this share of it goes straight down.
const STRAIGHT_DOWN: f64 = 1e-6;

/// What is left of a block, part frame.
#[derive(Clone, Debug)]
pub struct Stock {
    low: Vector2<f64>,
    bottom: f64,
    cell: f64,
    counts: [usize; 2],
    heights: Vec<f64>,
    /// How high the block was, m.
    first: f64,
    /// So many ways were cut into it.
    ways: usize,
    squares: Squares,
}

/// A stock, or a path through it, of which nothing can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StockError {
    /// A block without a volume.
    #[error("a block from {low:?} to {high:?} m; expected three ranges of more than 0 and finite ends")]
    Block {
        /// One corner, m.
        low: [f64; 3],
        /// The other one, m.
        high: [f64; 3],
    },
    /// A cell that is none, or that makes too many.
    #[error("cells of {0} m; expected more than 0, and at most 5e7 of them")]
    Cell(f64),
    /// A tool that no cell can tell.
    #[error("a tool of radius {radius} m in cells of {cell} m; expected at least four cells in the radius")]
    Tool {
        /// m.
        radius: f64,
        /// m.
        cell: f64,
    },
    /// The tool is not upright somewhere.
    #[error("line {0}: the tool axis is not z; the height-field stock supports three-axis paths only")]
    Axis(usize),
    /// It is no longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// What of the rim is in the work.
#[derive(Clone, Debug, PartialEq)]
pub struct Engaged {
    /// By their angles, which count from the left of the feed, clockwise from above; at least one.
    pub arcs: Vec<CutArc>,
}

impl Engaged {
    fn of(front: &Front) -> Option<Self> {
        Some(Self { arcs: front.arcs() }).filter(|engaged| !engaged.arcs.is_empty())
    }

    /// The same for a law of forces, whose angles count in the sense of the rotation.
    pub fn engagement(&self, feed_per_tooth: f64, is_clockwise: bool) -> Engagement {
        let engagement = Engagement { arcs: self.arcs.clone(), feed_per_tooth };
        if is_clockwise { engagement } else { engagement.mirrored() }
    }
}

/// What is to be said of a path through a stock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Through {
    /// The line of the first rapid move that cuts.
    pub rapid: Option<usize>,
    /// How often something is cut between two samples and at neither of them.
    pub between: usize,
}

/// Cells side by side.
#[derive(Clone, Copy)]
struct Grid {
    low: Vector2<f64>,
    cell: f64,
    counts: [usize; 2],
}

/// A cell that a mill passes over.
struct Passed {
    /// Which; `None` beside the block.
    at: Option<usize>,
    /// The lowest that the tip comes there, m.
    lowest: f64,
    /// How far to the left of the way the front comes upon it, and how high the tip is then, m; `None` where it is passed over from the beginning.
    met: Option<[f64; 2]>,
}

impl Grid {
    /// Cells over which a mill of a radius, m, passes on a straight way, row by row; those beside the block, too, where they are asked for.
    fn pass(&self, [from, to]: [&Vector3<f64>; 2], radius: f64, has_outside: bool, mut each: impl FnMut(Passed)) {
        let ranges = [0, 1].map(|axis| {
            let index = |value: f64| (value - self.low[axis]) / self.cell - 0.5;
            let first = index(from[axis].min(to[axis]) - radius).ceil() as i64;
            let end = index(from[axis].max(to[axis]) + radius).floor() as i64 + 1;
            let count = self.counts[axis] as i64;
            if has_outside { first..end } else { first.clamp(0, count)..end.clamp(0, count) }
        });
        let way = (to - from).xy();
        let left = Vector2::new(-way.y, way.x) / way.norm().max(f64::MIN_POSITIVE);
        let [columns, rows] = ranges;
        for j in rows {
            for i in columns.clone() {
                let centre = self.low + self.cell * Vector2::new(i as f64 + 0.5, j as f64 + 0.5) - from.xy();
                let Some([t0, t1]) = covered(centre, way, radius) else { continue };
                // Along a straight way the lowest tip over a cell is at one end of the time it is there.
                let z = |t: f64| from.z + t * (to.z - from.z);
                let is_met = radius * radius < centre.norm_squared();
                each(Passed {
                    at: self.index(i, j),
                    lowest: z(t0).min(z(t1)),
                    met: is_met.then(|| [centre.dot(&left), z(t0)]),
                });
            }
        }
    }

    fn index(&self, i: i64, j: i64) -> Option<usize> {
        let at = |index: i64, count: usize| usize::try_from(index).ok().filter(|index| *index < count);
        Some(at(j, self.counts[1])? * self.counts[0] + at(i, self.counts[0])?)
    }
}

impl Stock {
    /// A block between two corners, m, in cells of a size, m.
    ///
    /// # Errors
    /// A block without a volume, too many cells.
    pub fn block(low: [f64; 3], high: [f64; 3], cell: f64) -> Result<Self, StockError> {
        if !(0..3).all(|axis| low[axis] < high[axis] && low[axis].is_finite() && high[axis].is_finite()) {
            return Err(StockError::Block { low, high });
        }
        let counts = [0, 1].map(|axis| ((high[axis] - low[axis]) / cell).round().max(1.0));
        if !(0.0 < cell && counts[0] * counts[1] <= MOST_CELLS) {
            return Err(StockError::Cell(cell));
        }
        let counts = counts.map(|count| count as usize);
        let heights = vec![high[2]; counts[0] * counts[1]];
        let (low, bottom) = (Vector2::new(low[0], low[1]), low[2]);
        Ok(Self { low, bottom, cell, counts, heights, first: high[2], ways: 0, squares: Squares::over(counts) })
    }

    /// How high the stock is at a point, m; `None` beside it.
    pub fn height(&self, x: f64, y: f64) -> Option<f64> {
        let at = |value: f64, low: f64, count: usize| {
            let index = ((value - low) / self.cell).floor();
            (0.0 <= index && index < count as f64).then_some(index as usize)
        };
        let (i, j) = (at(x, self.low.x, self.counts[0])?, at(y, self.low.y, self.counts[1])?);
        Some(self.heights[j * self.counts[0] + i]).filter(|height| self.bottom < *height)
    }

    /// What is left, m3.
    pub fn volume(&self) -> f64 {
        self.heights.iter().map(|height| height - self.bottom).sum::<f64>() * self.cell * self.cell
    }

    fn grid(&self) -> Grid {
        Grid { low: self.low, cell: self.cell, counts: self.counts }
    }

    /// Takes away what a flat mill of a radius, m, passes over on a straight way between two tips; tells whether that was anything.
    pub fn cut(&mut self, from: &Vector3<f64>, to: &Vector3<f64>, radius: f64) -> bool {
        let removed = self.take_away([from, to], radius, None);
        self.ways += 1;
        0 < removed
    }

    /// The same as a part of a way; tells how many cells fell, and `front` what it came upon.
    fn take_away(&mut self, way: [&Vector3<f64>; 2], radius: f64, mut front: Option<&mut Front>) -> usize {
        let (grid, bottom, heights) = (self.grid(), self.bottom, &mut self.heights);
        let (mut removed, mut hull) = (0, [[usize::MAX, 0]; 2]);
        grid.pass(way, radius, front.is_some(), |Passed { at, lowest, met }| {
            let before = at.map_or(bottom, |at| heights[at]);
            if let (Some(front), Some([left, tip])) = (front.as_deref_mut(), met) {
                front.meet(left, (before - tip.max(bottom)).max(0.0));
            }
            let lowest = lowest.max(bottom);
            if let Some(at) = at.filter(|_| lowest < before) {
                heights[at] = lowest;
                removed += 1;
                for (ends, index) in hull.iter_mut().zip([at % grid.counts[0], at / grid.counts[0]]) {
                    *ends = [ends[0].min(index), ends[1].max(index + 1)];
                }
            }
        });
        if let Some(front) = front {
            front.go((way[1] - way[0]).xy().norm());
        }
        if 0 < removed {
            let Self { heights, counts, bottom, first, ways, squares, .. } = &mut *self;
            let cells = StockCells { heights, counts: *counts, bottom: *bottom, first: *first };
            squares.fall(*ways, hull.map(|[first, end]| first..end), &cells);
        }
        removed
    }

    /// What the front of a mill would come upon from a tip on along a direction.
    fn meet_ahead(&self, tip: &Vector3<f64>, direction: &Vector3<f64>, radius: f64, front: &mut Front) {
        let Some(ahead) = direction.xy().try_normalize(STRAIGHT_DOWN) else { return };
        let length = WINDOW * self.cell;
        let end = tip + length * direction / direction.dot(&Vector3::new(ahead.x, ahead.y, 0.0));
        self.grid().pass([tip, &end], radius, true, |Passed { at, met, .. }| {
            if let Some([left, tip]) = met {
                let height = at.map_or(self.bottom, |at| self.heights[at]);
                front.meet(left, (height - tip.max(self.bottom)).max(0.0));
            }
        });
        front.go(length);
    }

    /// What of a mill is in the work as it goes on from a tip along a direction; `None` in air, and where it goes straight down.
    pub fn engaged(&self, tip: &Vector3<f64>, direction: &Vector3<f64>, radius: f64) -> Option<Engaged> {
        let mut front = Front::new(radius, self.cell);
        self.meet_ahead(tip, direction, radius, &mut front);
        Engaged::of(&front)
    }

    /// Follows a path with a flat mill of a radius, m: each sample with what of the tool is in the work on the short way to it, or where a
    /// move begins from there.
    ///
    /// # Errors
    /// A tool axis other than z, a radius of less than four cells; what was stopped.
    pub fn follow<'m>(
        &mut self,
        moves: impl IntoIterator<Item = &'m Move>,
        steps: &Steps,
        radius: f64,
        each: &mut dyn FnMut(&Sample, Option<Engaged>),
        watch: Watch,
    ) -> Result<Through, StockError> {
        if !(4.0 * self.cell <= radius && radius.is_finite()) {
            return Err(StockError::Tool { radius, cell: self.cell });
        }
        let (mut way, mut through) = (0.0, Through::default());
        let mut fronts = Fronts::new(radius, self.cell);
        for one in moves {
            if [one.from.axis, one.to.axis].iter().any(|axis| axis.angle(&Vector3::z()) > 1e-6) {
                return Err(StockError::Axis(one.line));
            }
            let is_feed = one.kind == MoveKind::Feed;
            let (mut last, mut was_engaged) = (None, false);
            for sample in samples(one, steps, way) {
                watch.go_on()?;
                let tip = sample.pose.tip;
                let direction = sample.direction.filter(|way| is_feed && STRAIGHT_DOWN < way.xy().norm());
                let removed = match (last, direction) {
                    (Some(last), Some(_)) => self.follow_front([&last, &tip], radius, &mut fronts),
                    (last, direction) => {
                        let is_long = fronts.window <= one.length();
                        fronts.begin(direction.is_some() && !is_long);
                        if let Some(direction) = direction.filter(|_| fronts.seen.is_empty()) {
                            self.meet_ahead(&tip, &direction, radius, &mut fronts.seen);
                        }
                        self.take_away([&last.unwrap_or(tip), &tip], radius, None)
                    }
                };
                self.ways += 1;
                if !is_feed && 0 < removed {
                    through.rapid = through.rapid.or(Some(one.line));
                }
                let found = direction.and_then(|_| Engaged::of(&fronts.seen));
                let passed = last.map(|last| 2.0 * radius * (tip - last).xy().norm());
                let fell = removed as f64 * self.cell * self.cell;
                let is_noticed = direction.is_none() || was_engaged || found.is_some();
                through.between += usize::from(!is_noticed && passed.is_some_and(|passed| BETWEEN * passed < fell));
                was_engaged = found.is_some();
                each(&sample, found);
                last = Some(tip);
            }
            way += one.length();
        }
        Ok(through)
    }

    /// Cuts the way to a sample, and looks at the front on its last piece; tells how many cells fell.
    fn follow_front(&mut self, [from, to]: [&Vector3<f64>; 2], radius: f64, fronts: &mut Fronts) -> usize {
        let length = (to - from).xy().norm();
        let (mut removed, mut start) = (0, *from);
        if fronts.window < length {
            start = to + (from - to) * (fronts.window / length);
            removed += self.take_away([from, &start], radius, None);
            fronts.now.clear();
        }
        removed += self.take_away([&start, to], radius, Some(&mut fronts.now));
        fronts.look();
        removed
    }
}

/// What the front came upon on the last whole window of the way, and on what has come of the next one.
struct Fronts {
    /// m.
    window: f64,
    seen: Front,
    now: Front,
}

impl Fronts {
    fn new(radius: f64, cell: f64) -> Self {
        let front = Front::new(radius, cell);
        Self { window: WINDOW * cell, seen: front.clone(), now: front }
    }

    /// A move begins; where it is shorter than a window it goes on with what was seen.
    fn begin(&mut self, goes_on: bool) {
        if !goes_on {
            self.seen.clear();
            self.now.clear();
        }
    }

    fn look(&mut self) {
        if self.now.has_gone(self.window * (1.0 - 1e-9)) {
            std::mem::swap(&mut self.seen, &mut self.now);
            self.now.clear();
        }
    }
}

/// From when to when, in shares of a way, a disc that moves along it covers a point, given from where it begins.
fn covered(point: Vector2<f64>, way: Vector2<f64>, radius: f64) -> Option<[f64; 2]> {
    let (a, b) = (way.norm_squared(), point.dot(&way));
    let c = point.norm_squared() - radius * radius;
    if a < 1e-24 {
        return (c <= 0.0).then_some([0.0, 1.0]);
    }
    let root = (b * b - a * c).max(-1.0);
    if root < 0.0 {
        return None;
    }
    let [t0, t1] = [-1.0, 1.0].map(|sign| (b + sign * root.sqrt()) / a);
    (t0 <= 1.0 && 0.0 <= t1).then(|| [t0.max(0.0), t1.min(1.0)])
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::cutting::{Edge, Law, Milling, Process};

    const R: f64 = 0.008;
    const CELL: f64 = 1e-4;

    fn block() -> Stock {
        Stock::block([0.0, 0.0, -0.01], [0.1, 0.1, 0.0], CELL).unwrap()
    }

    fn close(a: f64, b: f64, within: f64) {
        assert!((a - b).abs() <= within, "{a} is not {b} within {within}");
    }

    /// Where the teeth first enter and last leave.
    fn ends(engaged: &Engaged) -> [f64; 2] {
        [engaged.arcs[0].entry, engaged.arcs[engaged.arcs.len() - 1].exit]
    }

    /// By how much an angle is off where its wall is off by two cells.
    fn fine(angle: f64) -> f64 {
        2.0 * CELL / (R * angle.sin())
    }

    /// The mean force of a tool of four teeth in these arcs, clockwise, N.
    fn force(arcs: &[CutArc]) -> [f64; 3] {
        let edge = Edge::Linear { chip: [767.01e6, 168.8e6, 222e6], rubbing: [27.7e3, 26.6e3, 0.7e3] };
        let engagement = Engagement { arcs: arcs.to_vec(), feed_per_tooth: 1e-4 };
        let milling = Milling { diameter: 2.0 * R, teeth: 4, helix: 0.5, engagement, edge };
        let process = Process { spindle: None, is_clockwise: true, law: Law::Milling(milling) };
        process.mean().unwrap().unwrap().0
    }

    fn alike(found: &[CutArc], expected: &[CutArc], within: f64) {
        let [found_force, by_hand] = [found, expected].map(force);
        for (a, b) in found_force.iter().zip(by_hand) {
            assert!((a - b).abs() <= within * by_hand[1].abs(), "{found_force:?} is not {by_hand:?}: {found:?}");
        }
    }

    #[test]
    fn a_slot_has_half_a_turn_and_a_side_cut_what_its_width_says() {
        let x = Vector3::x();
        // Wholly in the block, and into it from aside: by hand from asin to pi - asin.
        let found = block().engaged(&Vector3::new(0.05, 0.05, -0.002), &x, R).unwrap();
        assert_eq!(found.arcs.len(), 1);
        assert_eq!(ends(&found), [0.0, PI]);
        close(found.arcs[0].depth, 0.002, 1e-12);
        let found = block().engaged(&Vector3::new(-0.004, 0.05, -0.002), &x, R).unwrap();
        let into = 0.5_f64.asin();
        close(ends(&found)[0], into, 2.0 * fine(into + FRAC_PI_2));
        close(ends(&found)[1], PI - into, 2.0 * fine(into + FRAC_PI_2));
        // Along the edge y = 0 of the block, which lies left: up milling from 0 to acos(1 - 2 ae / D).
        for ae in [0.001, 0.004, 0.008, 0.012] {
            let exit = (1.0 - ae / R).acos();
            let found = block().engaged(&Vector3::new(0.05, ae - R, -0.002), &x, R).unwrap();
            assert_eq!(ends(&found)[0], 0.0);
            close(ends(&found)[1], exit, fine(exit));
            alike(&found.arcs, &[CutArc { depth: 0.002, entry: 0.0, exit }], 0.015);
            // Going the other way it lies right: down milling.
            let found = block().engaged(&Vector3::new(0.05, ae - R, -0.002), &-x, R).unwrap();
            assert_eq!(ends(&found)[1], PI);
            close(ends(&found)[0], PI - exit, fine(exit));
            alike(&found.arcs, &[CutArc { depth: 0.002, entry: PI - exit, exit: PI }], 0.015);
        }
        assert_eq!(block().engaged(&Vector3::new(0.05, -R - 2.0 * CELL, -0.002), &x, R), None);
        assert_eq!(block().engaged(&Vector3::new(0.05, 0.05, 0.001), &x, R), None);
    }

    /// What turns the other way finds the same material on the other side: the mirror of the force under the mirrored sense.
    #[test]
    fn a_tool_that_turns_left_climbs_where_one_that_turns_right_does_not() {
        let found = block().engaged(&Vector3::new(0.05, 0.004 - R, -0.002), &Vector3::x(), R).unwrap();
        let [right, left] = [true, false].map(|is_clockwise| found.engagement(1e-4, is_clockwise));
        assert_eq!(right.entry(), 0.0);
        assert_eq!(left.exit(), PI);
        close(left.entry(), PI - right.exit(), 1e-15);
    }

    /// Slots of 1 mm, one below the other: each is a slot of 1 mm, whatever stands beside it, and so is its end before a wall.
    #[test]
    fn walls_that_are_not_cut_carry_nothing() {
        let slot = [CutArc { depth: 0.001, entry: 0.0, exit: PI }];
        for (y, cell) in [(0.05, CELL), (0.05, 4e-4), (0.043_21, CELL)] {
            let mut stock = Stock::block([0.0, 0.0, -0.01], [0.1, 0.1, 0.0], cell).unwrap();
            for level in 1..=8 {
                let z = -f64::from(level);
                let program = format!("G21 G90\nG0 X20 Y{} Z5\nG1 Z{z} F600\nX70\nG0 Z5\n", y * 1e3);
                let mut found = Vec::new();
                let mut each = |sample: &Sample, engaged: Option<Engaged>| {
                    if sample.direction.is_some_and(|way| 0.9 < way.x) && sample.is_cutting {
                        found.push(engaged);
                    }
                };
                stock.follow(&moves_of(&program), &Steps::USUAL, R, &mut each, Watch::nobody()).unwrap();
                assert!(4 < found.len());
                for engaged in found {
                    alike(&engaged.expect("it cuts").arcs, &slot, 1e-3);
                }
            }
        }
    }

    /// One half of the tool is 8 mm deep in the work, the other 0.5: each carries its own part.
    #[test]
    fn each_part_of_the_rim_has_its_depth() {
        let mut stock = block();
        let at = |x: f64, y: f64, z: f64| Vector3::new(x, y, z);
        stock.cut(&at(-0.02, 0.05 + R, -0.0075), &at(0.12, 0.05 + R, -0.0075), R);
        let found = stock.engaged(&at(0.05, 0.05, -0.008), &Vector3::x(), R).unwrap();
        let expected = [
            CutArc { depth: 0.0005, entry: 0.0, exit: FRAC_PI_2 },
            CutArc { depth: 0.008, entry: FRAC_PI_2, exit: PI },
        ];
        alike(&found.arcs, &expected, 0.01);
        close(found.engagement(1e-4, true).depth(), 0.008, 1e-9);
        // Two ribs at both sides, and air between: nothing is taken in the middle.
        let mut stock = block();
        stock.cut(&at(-0.02, 0.05, -0.009), &at(0.12, 0.05, -0.009), 0.75 * R);
        let found = stock.engaged(&at(0.05, 0.05, -0.009), &Vector3::x(), R).unwrap();
        let rib = 0.75_f64.acos();
        let expected =
            [CutArc { depth: 0.009, entry: 0.0, exit: rib }, CutArc { depth: 0.009, entry: PI - rib, exit: PI }];
        alike(&found.arcs, &expected, 0.03);
    }

    /// A slot along x, then up along y out of its end: what lies above the slot begins at asin(1 - d / R) on the left; on the right all
    /// is uncut.
    #[test]
    fn a_corner_carries_more_on_the_side_that_was_not_cut() {
        let mut stock = block();
        let at = |x: f64, y: f64| Vector3::new(x, y, -0.002);
        stock.cut(&at(-0.02, 0.05), &at(0.05, 0.05), R);
        for d in [0.002, 0.004, 0.006] {
            let mut stock = stock.clone();
            stock.cut(&at(0.05, 0.05), &at(0.05, 0.05 + d), R);
            let found = stock.engaged(&at(0.05, 0.05 + d), &Vector3::y(), R).unwrap();
            let entry = (1.0 - d / R).asin();
            close(ends(&found)[0], entry, 2.0 * fine(entry + FRAC_PI_2));
            assert_eq!(ends(&found)[1], PI);
        }
        // Back through the slot there is air.
        assert_eq!(stock.engaged(&at(0.03, 0.05), &-Vector3::x(), R), None);
    }

    /// A block of 2 mm, and samples of 10: no one sees it but what falls.
    #[test]
    fn what_is_cut_between_two_samples_is_counted() {
        let mut stock = Stock::block([0.044, 0.0, -0.01], [0.046, 0.1, 0.0], CELL).unwrap();
        let moves = moves_of("G21 G90\nG0 X20 Y50 Z-2\nG1 X70 F600\n");
        let coarse = Steps { longest: 0.05, ..Steps::USUAL };
        let (mut engaged, mut each) = (0, |_: &Sample, found: Option<Engaged>| _ = found);
        let through = stock.clone().follow(&moves, &coarse, R, &mut each, Watch::nobody()).unwrap();
        assert_eq!(through, Through { rapid: None, between: 1 });
        let fine = Steps { longest: 1e-3, ..Steps::USUAL };
        let mut each = |_: &Sample, found: Option<Engaged>| engaged += usize::from(found.is_some());
        assert_eq!(stock.follow(&moves, &fine, R, &mut each, Watch::nobody()).unwrap().between, 0);
        assert!((8..=20).contains(&engaged), "{engaged}");
    }

    fn moves_of(program: &str) -> Vec<Move> {
        let mut moves = Vec::new();
        let mut each = |one: &Move| moves.push(*one);
        let options = crate::toolpath::ReadOptions::default();
        let format = crate::toolpath::Format::GCode;
        crate::toolpath::read(&mut program.as_bytes(), "a", format, &options, &mut each, &mut |_| Ok(())).unwrap();
        moves
    }

    #[test]
    fn what_is_cut_is_the_volume_of_the_slot() {
        let mut stock = block();
        let whole = stock.volume();
        close(whole, 0.1 * 0.1 * 0.01, 1e-12);
        let z = Vector3::new(0.0, 0.0, -0.002);
        assert!(stock.cut(&(z + Vector3::new(0.03, 0.05, 0.0)), &(z + Vector3::new(0.07, 0.05, 0.0)), R));
        let by_hand = (0.04 * 2.0 * R + PI * R * R) * 0.002;
        close((whole - stock.volume()) / by_hand, 1.0, 0.01);
        assert!(!stock.cut(&(z + Vector3::new(0.03, 0.05, 0.0)), &(z + Vector3::new(0.07, 0.05, 0.0)), R));
        // A ramp leaves its floor inclined: under the middle of the way the lowest tip that passed over it.
        let mut stock = block();
        stock.cut(&Vector3::new(0.03, 0.05, 0.0), &Vector3::new(0.07, 0.05, -0.004), R);
        close(stock.height(0.05, 0.05).unwrap(), -0.002 - 0.1 * R, 2e-5);
    }

    #[test]
    fn a_path_is_followed_and_a_rapid_that_cuts_is_reported() {
        let moves = moves_of("G21 G90\nG0 X-20 Y50 Z-2\nG1 X50 F600\nG0 X90\n");
        let mut found = Vec::new();
        let steps = Steps { longest: 1e-3, ..Steps::USUAL };
        let through = block()
            .follow(&moves, &steps, R, &mut |sample, engaged| found.push((sample.pose.tip.x, engaged)), Watch::nobody())
            .unwrap();
        assert_eq!(through.rapid, Some(4));
        let air = found.iter().filter(|(x, _)| *x < -R - CELL).all(|(_, engaged)| engaged.is_none());
        let cut = found.iter().filter(|(x, _)| 2.0 * R < *x && *x < 0.05 - 1e-9).all(|(_, engaged)| {
            engaged
                .as_ref()
                .is_some_and(|engaged| ends(engaged) == [0.0, PI] && (engaged.arcs[0].depth - 0.002).abs() < 1e-9)
        });
        assert!(air && cut);
    }

    #[test]
    fn stock_that_makes_no_sense_is_refused() {
        assert!(matches!(Stock::block([0.0; 3], [1.0, 0.0, 1.0], 0.1), Err(StockError::Block { .. })));
        assert!(matches!(Stock::block([0.0; 3], [1.0, f64::NAN, 1.0], 0.1), Err(StockError::Block { .. })));
        assert!(matches!(Stock::block([0.0; 3], [1.0; 3], 1e-5), Err(StockError::Cell(_))));
        assert!(matches!(Stock::block([0.0; 3], [1.0; 3], f64::NAN), Err(StockError::Cell(_))));
        let tool = block().follow(&[], &Steps::USUAL, 2e-4, &mut |_, _| (), Watch::nobody());
        assert!(matches!(tool, Err(StockError::Tool { .. })));
    }
}
