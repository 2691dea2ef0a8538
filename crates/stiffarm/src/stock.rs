//! How much of the tool is in the work: entry and exit angle along a three-axis path, from what is left of the stock. And what is left there for
//! an arm to touch.
//!
//! The stock is a field of heights: one number for each cell of a grid, above which there is nothing. A flat mill whose axis is z
//! lowers the cells it passes over. What the front half of its rim finds above the tip is the engagement: air carries no force,
//! and corners carry more. Angles count as in [`cutting`](crate::cutting): from the left of the feed, clockwise from above.
//!
//! The rim is looked at 0.75 of a cell outside, so that cells which the last step cut in part do not count for it: at a wall
//! `w` beside the axis of a tool of radius R an angle is off by up to `1.5 cell w / (R^2 sin(phi))`. Widths of less than 1.5 cells at
//! either side are not seen: a wall that the tool only touches looks like one.

mod remains;

use std::f64::consts::PI;

use nalgebra::{Vector2, Vector3};

use crate::cutting::Engagement;
use crate::toolpath::{Move, MoveKind, Sample, Steps, samples};
use crate::watch::{Stopped, Watch};
pub use remains::Remains;
pub(crate) use remains::Square;
use remains::{Squares, StockCells};

/// More cells need more than 400 MB.
const MOST_CELLS: f64 = 5e7;

/// Directions in which the front of the rim is looked at.
const RIM: usize = 360;

/// Radial widths below so many cells are taken for a wall that is only touched.
const TOUCHED: f64 = 1.5;

/// How far outside of the rim the stock is looked at, in cells: more than half a diagonal.
const OUTSIDE: f64 = 0.75;

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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Engaged {
    /// Where the first tooth angle in the work begins, and the last one ends, rad.
    pub entry: f64,
    /// rad.
    pub exit: f64,
    /// Axial depth, m: the mean over the angles in the work.
    pub depth: f64,
    /// Pieces of which the angles in the work are; one in most cuts.
    pub pieces: usize,
}

impl Engaged {
    /// The same for a law of forces; from the first angle to the last where it is in pieces.
    pub fn engagement(&self, feed_per_tooth: f64) -> Engagement {
        Engagement { depth: self.depth, entry: self.entry, exit: self.exit, feed_per_tooth }
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

    /// Takes away what a flat mill of a radius, m, passes over on a straight way between two tips; tells whether that was anything.
    pub fn cut(&mut self, from: &Vector3<f64>, to: &Vector3<f64>, radius: f64) -> bool {
        let range = |axis: usize| {
            let (low, cell, count) = (self.low[axis], self.cell, self.counts[axis] as f64);
            let index = |value: f64| ((value - low) / cell - 0.5).clamp(-1.0, count);
            let (first, last) =
                (index(from[axis].min(to[axis]) - radius).ceil(), index(from[axis].max(to[axis]) + radius).floor());
            (first.max(0.0) as usize, (last + 1.0).clamp(0.0, count) as usize)
        };
        let ((i0, i1), (j0, j1)) = (range(0), range(1));
        let way = (to - from).xy();
        let mut has_cut = false;
        for j in j0..j1 {
            for i in i0..i1 {
                let centre = self.low + self.cell * Vector2::new(i as f64 + 0.5, j as f64 + 0.5);
                let Some([t0, t1]) = covered(centre - from.xy(), way, radius) else { continue };
                // Along a straight way the lowest tip over a cell is at one end of the time it is there.
                let z = |t: f64| from.z + t * (to.z - from.z);
                let lowest = z(t0).min(z(t1)).max(self.bottom);
                let height = &mut self.heights[j * self.counts[0] + i];
                if lowest < *height {
                    *height = lowest;
                    has_cut = true;
                }
            }
        }
        if has_cut {
            let Self { heights, counts, bottom, first, ways, squares, .. } = &mut *self;
            let cells = StockCells { heights, counts: *counts, bottom: *bottom, first: *first };
            squares.fall(*ways, [i0..i1, j0..j1], &cells);
        }
        self.ways += 1;
        has_cut
    }

    /// What of the front of a mill is in the work, where its tip stands at a place and goes a way; `None` in air, and where it
    /// goes straight down.
    pub fn engaged(&self, tip: &Vector3<f64>, direction: &Vector3<f64>, radius: f64) -> Option<Engaged> {
        let ahead = direction.xy().try_normalize(1e-6)?;
        let left = Vector2::new(-ahead.y, ahead.x);
        let reach = radius + OUTSIDE * self.cell;
        let depth_at = |k: usize| {
            let (s, c) = (PI * (k as f64 + 0.5) / RIM as f64).sin_cos();
            let at = tip.xy() + reach * (s * ahead + c * left);
            self.height(at.x, at.y).map(|height| height - tip.z.max(self.bottom)).filter(|depth| 1e-9 < *depth)
        };
        let mut depths: Vec<Option<f64>> = (0..RIM).map(depth_at).collect();
        self.leave_touched(&mut depths, radius);
        let first = depths.iter().position(Option::is_some)?;
        let last = depths.iter().rposition(Option::is_some)?;
        let count = depths.iter().flatten().count();
        let begins = |k: &usize| depths[*k].is_some() && (*k == 0 || depths[k - 1].is_none());
        Some(Engaged {
            entry: PI * first as f64 / RIM as f64,
            exit: PI * (last + 1) as f64 / RIM as f64,
            depth: depths.iter().flatten().sum::<f64>() / count as f64,
            pieces: (0..RIM).filter(begins).count(),
        })
    }

    /// Leaves out what is in the work at either side only, so narrow that it is a wall which the tool touches.
    fn leave_touched(&self, depths: &mut [Option<f64>], radius: f64) {
        let angle = (1.0 - TOUCHED * self.cell / radius).clamp(-1.0, 1.0).acos();
        let most = (angle / PI * RIM as f64).ceil() as usize + 1;
        for _ in 0..2 {
            let run = depths.iter().take_while(|depth| depth.is_some()).count();
            if run <= most {
                depths[..run].fill(None);
            }
            depths.reverse();
        }
    }

    /// Follows a path with a flat mill of a radius, m: each sample with what of the tool is in the work there, before it is cut.
    /// Tells the line of the first rapid move that cuts, if any does.
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
    ) -> Result<Option<usize>, StockError> {
        if !(4.0 * self.cell <= radius && radius.is_finite()) {
            return Err(StockError::Tool { radius, cell: self.cell });
        }
        let (mut way, mut hit) = (0.0, None);
        for one in moves {
            if [one.from.axis, one.to.axis].iter().any(|axis| axis.angle(&Vector3::z()) > 1e-6) {
                return Err(StockError::Axis(one.line));
            }
            let mut last = one.from.tip;
            for sample in samples(one, steps, way) {
                watch.go_on()?;
                let found = sample.direction.and_then(|direction| self.engaged(&sample.pose.tip, &direction, radius));
                each(&sample, found);
                let has_cut = self.cut(&last, &sample.pose.tip, radius);
                if has_cut && one.kind == MoveKind::Rapid {
                    hit = hit.or(Some(one.line));
                }
                last = sample.pose.tip;
            }
            way += one.length();
        }
        Ok(hit)
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
    use super::*;

    const R: f64 = 0.008;
    const CELL: f64 = 1e-4;

    fn block() -> Stock {
        Stock::block([0.0, 0.0, -0.01], [0.1, 0.1, 0.0], CELL).unwrap()
    }

    fn close(a: f64, b: f64, within: f64) {
        assert!((a - b).abs() <= within, "{a} is not {b} within {within}");
    }

    /// Two cells in angle at the radius, and one direction of the rim.
    const FINE: f64 = 2.0 * CELL / R + PI / RIM as f64;

    #[test]
    fn a_slot_has_half_a_turn_and_a_side_cut_what_its_width_says() {
        let x = Vector3::x();
        // Wholly in the block, and into it from aside: by hand from asin to pi - asin.
        let found = block().engaged(&Vector3::new(0.05, 0.05, -0.002), &x, R).unwrap();
        assert_eq!((found.entry, found.exit, found.pieces), (0.0, PI, 1));
        close(found.depth, 0.002, 1e-12);
        let found = block().engaged(&Vector3::new(-0.004, 0.05, -0.002), &x, R).unwrap();
        close(found.entry, 0.5_f64.asin(), FINE);
        close(found.exit, PI - 0.5_f64.asin(), FINE);
        // Along the edge y = 0 of the block, which lies left: up milling from 0 to acos(1 - 2 ae / D).
        for ae in [0.001, 0.004, 0.008, 0.012] {
            let found = block().engaged(&Vector3::new(0.05, ae - R, -0.002), &x, R).unwrap();
            let exit = (1.0 - ae / R).acos();
            assert_eq!(found.entry, 0.0);
            close(found.exit, exit, 1.5 * CELL * (R - ae).abs() / (R * R * exit.sin()) + FINE);
            // Going the other way it lies right: down milling.
            let found = block().engaged(&Vector3::new(0.05, ae - R, -0.002), &-x, R).unwrap();
            assert_eq!(found.exit, PI);
            close(found.entry, PI - exit, 1.5 * CELL * (R - ae).abs() / (R * R * exit.sin()) + FINE);
        }
        assert_eq!(block().engaged(&Vector3::new(0.05, -R - 2.0 * CELL, -0.002), &x, R), None);
        assert_eq!(block().engaged(&Vector3::new(0.05, 0.05, 0.001), &x, R), None);
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
            stock.cut(&at(0.05, 0.05), &at(0.05, 0.05 + d - 1e-4), R);
            let found = stock.engaged(&at(0.05, 0.05 + d), &Vector3::y(), R).unwrap();
            let entry = (1.0 - d / R).asin();
            close(found.entry, entry, 2.0 * CELL / (R * entry.cos()) + FINE);
            close(found.exit, PI, FINE);
        }
        // Back through the slot there is air.
        assert_eq!(stock.engaged(&at(0.03, 0.05), &-Vector3::x(), R), None);
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
        let program = "G21 G90\nG0 X-20 Y50 Z-2\nG1 X50 F600\nG0 X90\n";
        let mut moves = Vec::new();
        let mut each = |one: &Move| moves.push(*one);
        let options = crate::toolpath::ReadOptions::default();
        let format = crate::toolpath::Format::GCode;
        crate::toolpath::read(&mut program.as_bytes(), "a", format, &options, &mut each, &mut |_| Ok(())).unwrap();
        let mut found = Vec::new();
        let steps = Steps { longest: 1e-3, ..Steps::USUAL };
        let hit = block()
            .follow(&moves, &steps, R, &mut |sample, engaged| found.push((sample.pose.tip.x, engaged)), Watch::nobody())
            .unwrap();
        assert_eq!(hit, Some(4));
        let air = found.iter().filter(|(x, _)| *x < -R - CELL).all(|(_, engaged)| engaged.is_none());
        let cut = found.iter().filter(|(x, _)| R < *x && *x < 0.05 - 1e-9).all(|(_, engaged)| {
            engaged.is_some_and(|engaged| {
                engaged.entry < FINE && PI - FINE < engaged.exit && (engaged.depth - 0.002).abs() < 1e-9
            })
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
