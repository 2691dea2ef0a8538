//! How high is a stock in some square of it, before each sample of a path that cuts it?

use super::Stock;

/// Squares along the longer side.
const MOST_SQUARES: usize = 256;
/// A square that falls by less, m, is taken to be as high as before.
const LEAST_FALL: f64 = 1e-4;

/// From which sample on something is so high at most, m; it falls from one to the next.
type Falls = Vec<(usize, f64)>;

/// Of one fineness, the highest of the stock in every square of a grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Squares {
    /// Cells along a side of one of them.
    cells: usize,
    counts: [usize; 2],
    /// Since before the first sample each is as high as the block was.
    falls: Vec<Falls>,
    /// The first sample to which the way cuts a square of the finest grid in it; of these themselves their falls tell it.
    first_cut: Vec<usize>,
}

/// What was left of a block before every sample of a path that was followed through it, part frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Remains {
    low: [f64; 2],
    /// Of the block that was there first, m.
    heights: [f64; 2],
    /// m.
    cell: f64,
    cells: [usize; 2],
    /// Each has a quarter of the squares of the one before; the last one has one.
    levels: Vec<Squares>,
}

impl Squares {
    pub(super) fn over(cells: [usize; 2]) -> Self {
        let side = cells[0].max(cells[1]).div_ceil(MOST_SQUARES);
        let counts = cells.map(|count| count.div_ceil(side));
        Self { cells: side, counts, falls: vec![Vec::new(); counts[0] * counts[1]], first_cut: Vec::new() }
    }

    /// Takes notice that cells of some columns and rows may have fallen when a sample was reached.
    pub(super) fn fall(&mut self, sample: usize, [columns, rows]: [std::ops::Range<usize>; 2], stock: &StockCells) {
        let squares = |cells: &std::ops::Range<usize>| cells.start / self.cells..cells.end.div_ceil(self.cells);
        for (i, j) in squares(&rows).flat_map(|j| squares(&columns).map(move |i| (i, j))) {
            let most = stock.highest([i, j].map(|at| at * self.cells..(at + 1) * self.cells));
            let falls = &mut self.falls[j * self.counts[0] + i];
            let before = falls.last().map_or(stock.first, |(_, height)| *height);
            let is_gone = most <= stock.bottom && stock.bottom < before;
            if most < before - LEAST_FALL || is_gone {
                falls.push((sample, most));
            }
        }
    }

    /// Four in one.
    fn coarser(&self, first: f64) -> Self {
        let counts = self.counts.map(|count| count.div_ceil(2));
        let of = |i: usize, j: usize| {
            let parts: Vec<&Falls> = children([i, j], self.counts).map(|at| self.at(at)).collect();
            let mut samples: Vec<usize> = parts.iter().flat_map(|falls| falls.iter().map(|(at, _)| *at)).collect();
            samples.sort_unstable();
            samples.dedup();
            let mut found = Falls::new();
            for sample in samples {
                let most = parts.iter().map(|falls| before(falls, sample + 1, first)).fold(f64::NEG_INFINITY, f64::max);
                if most < found.last().map_or(first, |(_, height)| *height) {
                    found.push((sample, most));
                }
            }
            found
        };
        let first_cut = |at: [usize; 2]| children(at, self.counts).map(|part| self.first_cut(part)).min();
        let all = || (0..counts[0] * counts[1]).map(|k| [k % counts[0], k / counts[0]]);
        Self {
            cells: 2 * self.cells,
            counts,
            falls: all().map(|[i, j]| of(i, j)).collect(),
            first_cut: all().map(|at| first_cut(at).unwrap_or(usize::MAX)).collect(),
        }
    }

    fn first_cut(&self, [i, j]: [usize; 2]) -> usize {
        let of_falls = || self.at([i, j]).first().map_or(usize::MAX, |(sample, _)| *sample);
        self.first_cut.get(j * self.counts[0] + i).copied().unwrap_or_else(of_falls)
    }

    fn at(&self, [i, j]: [usize; 2]) -> &Falls {
        &self.falls[j * self.counts[0] + i]
    }
}

/// How high it is before a sample is reached, m.
fn before(falls: &Falls, sample: usize, first: f64) -> f64 {
    falls[..falls.partition_point(|(at, _)| *at < sample)].last().map_or(first, |(_, height)| *height)
}

/// The four squares of the level below that make one.
fn children([i, j]: [usize; 2], counts: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    let all = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[a, b]| [2 * i + a, 2 * j + b]);
    all.into_iter().filter(move |[i, j]| *i < counts[0] && *j < counts[1])
}

/// The cells of a stock, as squares look at them.
pub(super) struct StockCells<'a> {
    pub(super) heights: &'a [f64],
    pub(super) counts: [usize; 2],
    pub(super) bottom: f64,
    /// As high as the block was, m.
    pub(super) first: f64,
}

impl StockCells<'_> {
    fn highest(&self, [columns, rows]: [std::ops::Range<usize>; 2]) -> f64 {
        let columns = columns.start..columns.end.min(self.counts[0]);
        let of_row = |j: usize| &self.heights[j * self.counts[0] + columns.start..j * self.counts[0] + columns.end];
        (rows.start..rows.end.min(self.counts[1])).flat_map(of_row).copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

/// A square of some level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Square {
    level: usize,
    at: [usize; 2],
}

impl Remains {
    /// What a stock was after each of the ways that were cut into it.
    pub fn of(stock: &Stock) -> Self {
        let Stock { low, bottom, first, cell, counts, squares, .. } = stock;
        let mut levels = vec![squares.clone()];
        while levels.last().is_some_and(|last| 1 < last.counts[0] * last.counts[1]) {
            levels.extend(levels.last().map(|last| last.coarser(*first)));
        }
        Self { low: (*low).into(), heights: [*bottom, *first], cell: *cell, cells: *counts, levels }
    }

    /// The block that was there first: low and high corner, m.
    pub fn block(&self) -> [[f64; 3]; 2] {
        let [bottom, first] = self.heights;
        let high = [0, 1].map(|axis| self.low[axis] + self.cells[axis] as f64 * self.cell);
        [[self.low[0], self.low[1], bottom], [high[0], high[1], first]]
    }

    /// All of it.
    pub(crate) fn whole(&self) -> Square {
        Square { level: self.levels.len() - 1, at: [0; 2] }
    }

    /// The squares that make one; `None` of the finest, and where before a sample nothing of it is cut.
    pub(crate) fn parts(&self, square: Square, sample: usize) -> Option<impl Iterator<Item = Square>> {
        let level = square.level.checked_sub(1).filter(|_| self.levels[square.level].first_cut(square.at) < sample)?;
        Some(children(square.at, self.levels[level].counts).map(move |at| Square { level, at }))
    }

    /// The box that holds what is left in a square before a sample, low and high corner, m; `None` where nothing is.
    ///
    /// A cell counts as cut where its middle is: by half its diagonal more may be left.
    pub(crate) fn left(&self, Square { level, at }: Square, sample: usize) -> Option<[[f64; 3]; 2]> {
        let [bottom, first] = self.heights;
        let squares = &self.levels[level];
        let high = before(squares.at(at), sample, first);
        let more = self.cell * std::f64::consts::FRAC_1_SQRT_2;
        let side = |axis: usize| {
            let ends = [at[axis] * squares.cells, ((at[axis] + 1) * squares.cells).min(self.cells[axis])];
            let [from, to] = ends.map(|cells| self.low[axis] + cells as f64 * self.cell);
            [from - more, to + more]
        };
        let [[x0, x1], [y0, y1]] = [side(0), side(1)];
        (bottom < high).then_some([[x0, y0, bottom], [x1, y1, high]])
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    const CELL: f64 = 1e-3;

    /// Every square tells the highest of its cells before every way, as a stock that is cut only so far has it.
    #[test]
    fn squares_are_as_high_as_their_cells_were() {
        let fresh = || Stock::block([-0.1, 0.0, -0.05], [0.5, 0.3, 0.0], CELL).unwrap();
        let mut rng = fastrand::Rng::with_seed(39);
        let tips: Vec<Vector3<f64>> =
            (0..60).map(|_| Vector3::new(rng.f64() * 0.7 - 0.15, rng.f64() * 0.4 - 0.05, -0.06 * rng.f64())).collect();
        let mut whole = fresh();
        let mut states = vec![fresh()];
        for ends in tips.windows(2) {
            whole.cut(&ends[0], &ends[1], 0.04);
            states.push(whole.clone());
        }
        let remains = Remains::of(&whole);
        assert_eq!(remains.block(), [[-0.1, 0.0, -0.05], [0.5, 0.3, 0.0]]);
        let (mut looked, mut gone, mut fallen, mut whole) = (0, 0, 0, 0);
        for (sample, state) in states.iter().enumerate().step_by(7) {
            let mut queue = vec![remains.whole()];
            while let Some(square) = queue.pop() {
                let parts = remains.parts(square, sample);
                let is_whole = parts.is_none() && 0 < square.level;
                queue.extend(parts.into_iter().flatten());
                let cells = remains.levels[square.level].cells;
                let range =
                    |axis: usize| square.at[axis] * cells..((square.at[axis] + 1) * cells).min(remains.cells[axis]);
                let of = |(i, j): (usize, usize)| state.heights[j * state.counts[0] + i];
                let most =
                    range(1).flat_map(|j| range(0).map(move |i| (i, j))).map(of).fold(f64::NEG_INFINITY, f64::max);
                // What is not taken apart is as high all over, but for cells that make no square fall.
                let highest = |own: &Square| remains.left(*own, sample).map(|[_, high]| high[2]);
                let finest = (range(0).start..range(0).end).flat_map(|i| range(1).map(move |j| [i, j]));
                if is_whole {
                    whole += 1;
                    for at in finest.map(|at| at.map(|cell| cell / remains.levels[0].cells)) {
                        assert_eq!(highest(&Square { level: 0, at }), Some(0.0), "{square:?}");
                    }
                }
                let left = remains.left(square, sample);
                looked += 1;
                gone += usize::from(left.is_none());
                fallen += usize::from(left.is_some_and(|[_, high]| high[2] < 0.0));
                assert_eq!(left.is_none(), most <= -0.05, "{square:?} {sample} {most}");
                let Some([low, high]) = left else { continue };
                assert!((0.0..=LEAST_FALL).contains(&(high[2] - most)) && low[2] == -0.05, "{high:?} {most}");
                let ends = [range(0).start, range(0).end].map(|cells| -0.1 + cells as f64 * CELL);
                assert!((ends[0] - low[0] - 0.707e-3).abs() < 1e-6 && (high[0] - ends[1] - 0.707e-3).abs() < 1e-6);
            }
        }
        assert!(100 < gone && 1000 < fallen && 5000 < looked && 20 < whole, "{gone} {fallen} {looked} {whole}");
    }
}
