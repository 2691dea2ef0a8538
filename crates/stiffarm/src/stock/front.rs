//! What does the front of a mill cut on a short way? In strips along the way, side by side from the left of the tool to its right: the mean
//! axial depth of what each comes upon, so that the volume that is cut is that of the stock.
//!
//! A strip so far to the left of the axis is cut by the teeth at one angle, `acos(left / R)`: what stands beside the way, or behind its end,
//! is not cut and does not count, however near it is.

use crate::cutting::CutArc;

/// Strips whose depths differ by less, in parts of the largest, are of one arc.
const SAME: f64 = 2e-3;
/// What is less deep, m, is nothing.
const NOTHING: f64 = 1e-9;

/// A strip along the way.
#[derive(Clone, Copy, Debug, Default)]
struct Strip {
    /// Cells that the front came upon, in the stock or beside it.
    cells: usize,
    /// Of the stock in them, m, all together.
    depth: f64,
}

/// What the front of a mill came upon.
#[derive(Clone, Debug)]
pub(super) struct Front {
    radius: f64,
    /// How far it went, m.
    length: f64,
    /// From the left to the right.
    strips: Vec<Strip>,
}

impl Front {
    /// Of a mill of a radius in a stock of cells, both m.
    pub(super) fn new(radius: f64, cell: f64) -> Self {
        let count = (2.0 * radius / cell).round().max(1.0) as usize;
        Self { radius, length: 0.0, strips: vec![Strip::default(); count] }
    }

    /// Has it gone anywhere?
    pub(super) fn is_empty(&self) -> bool {
        self.length == 0.0
    }

    /// Has it gone so far, m?
    pub(super) fn has_gone(&self, length: f64) -> bool {
        length <= self.length
    }

    pub(super) fn clear(&mut self) {
        self.length = 0.0;
        self.strips.fill(Strip::default());
    }

    pub(super) fn go(&mut self, length: f64) {
        self.length += length;
    }

    /// Comes upon a cell so far to the left of the way, in which the stock is so much higher than the tip, m; 0 beside the stock.
    pub(super) fn meet(&mut self, left: f64, depth: f64) {
        let count = self.strips.len();
        let at = (0.5 * (1.0 - left / self.radius) * count as f64).max(0.0) as usize;
        let strip = &mut self.strips[at.min(count - 1)];
        strip.cells += 1;
        strip.depth += depth;
    }

    /// Where the teeth cut, and how deep; nothing in air.
    pub(super) fn arcs(&self) -> Vec<CutArc> {
        let depths = self.depths();
        let largest = depths.iter().copied().fold(0.0, f64::max);
        if largest <= NOTHING {
            return Vec::new();
        }
        let angle = |i: usize| (1.0 - 2.0 * i as f64 / depths.len() as f64).clamp(-1.0, 1.0).acos();
        let (mut found, mut first) = (Vec::new(), 0);
        for i in 1..=depths.len() {
            if depths.get(i).is_none_or(|depth| SAME * largest < (depth - depths[first]).abs()) {
                let depth = depths[first..i].iter().sum::<f64>() / (i - first) as f64;
                if NOTHING < depth {
                    found.push(CutArc { depth, entry: angle(first), exit: angle(i) });
                }
                first = i;
            }
        }
        found
    }

    /// Of every strip; one that came upon no cell is as the one before it, or else the first that did.
    fn depths(&self) -> Vec<f64> {
        let of = |strip: &Strip| (0 < strip.cells).then(|| strip.depth / strip.cells as f64);
        let mut last = self.strips.iter().find_map(of).unwrap_or(0.0);
        let known = |strip: &Strip| {
            last = of(strip).unwrap_or(last);
            last
        };
        self.strips.iter().map(known).collect()
    }
}
