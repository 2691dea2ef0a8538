//! Where does a gridded field with gaps cross a level, and which area lies above it?

use std::collections::HashMap;

use super::line::{Line, Node};
use super::stairs::without_stairs;

/// A field over columns and rows; `None` where it has no value.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub columns: usize,
    pub rows: usize,
    cells: Vec<Option<f64>>,
}

impl Grid {
    /// Row by row from `value(column, row)`; what is not finite is absent.
    pub(crate) fn new(columns: usize, rows: usize, value: impl Fn(usize, usize) -> Option<f64>) -> Self {
        let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        Self { columns, rows, cells: cells.map(|(i, j)| value(i, j).filter(|value| value.is_finite())).collect() }
    }

    /// The value at a node; `None` also beyond the grid.
    pub(crate) fn get(&self, i: i64, j: i64) -> Option<f64> {
        let inside = (0..self.columns as i64).contains(&i) && (0..self.rows as i64).contains(&j);
        inside.then(|| self.cells[j as usize * self.columns + i as usize]).flatten()
    }

    /// The smallest and the largest value.
    pub(crate) fn extremes(&self) -> Option<[f64; 2]> {
        let wider = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        self.cells.iter().flatten().fold(None, |range, &value| Some(wider(range.unwrap_or([value; 2]), value)))
    }

    /// Iso-lines; none where one of the four values around is absent.
    pub(crate) fn iso_lines(&self, level: f64) -> Vec<Line> {
        let whole = |i, j| corners(i, j).iter().all(|&[i, j]| self.get(i, j).is_some());
        self.trace_level(level, 0, whole)
    }

    /// The area at or above a level as closed lines, holes included; it ends halfway to an absent value.
    pub(crate) fn area_above(&self, level: f64) -> Vec<Line> {
        self.trace_level(level, 1, |_, _| true)
    }

    /// The area that has values as closed lines; `share` says where between a node with and one without it ends, 0 to 1.
    pub(crate) fn outline(&self, share: impl Fn([i64; 2], [i64; 2]) -> f64) -> Vec<Line> {
        let inside = |i, j| self.get(i, j).is_some();
        self.trace(1, inside, |_, _| false, |_, _| true, share)
    }

    /// The area that has values, its edge guessed between the nodes and freed of the stairs of the grid.
    pub(crate) fn smooth_outline(&self) -> Vec<Line> {
        self.outline(|_, _| 0.5).iter().map(|line| without_stairs(line)).collect()
    }

    /// The field carried on into its gaps by `layers` cells, so that nothing is missing up to the true edge.
    pub(crate) fn extended(&self, layers: usize) -> Self {
        let mut grid = self.clone();
        for _ in 0..layers {
            let last = grid.clone();
            grid.cells = (0..self.rows as i64)
                .flat_map(|j| (0..self.columns as i64).map(move |i| (i, j)))
                .map(|(i, j)| last.get(i, j).or_else(|| last.carried_to(i, j)))
                .collect();
        }
        grid
    }

    /// The mean of what the neighbours say: straight on where two in a row are known, else their own value.
    fn carried_to(&self, i: i64, j: i64) -> Option<f64> {
        const AROUND: [[i64; 2]; 8] = [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 1], [-1, 1], [-1, -1], [1, -1]];
        let mean = |values: &mut dyn Iterator<Item = f64>| {
            let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
            (0 < count).then(|| sum / f64::from(count))
        };
        let near = |[di, dj]: [i64; 2]| self.get(i + di, j + dj);
        let straight = |d: [i64; 2]| Some(2.0 * near(d)? - near([2 * d[0], 2 * d[1]])?);
        mean(&mut AROUND.into_iter().filter_map(straight)).or_else(|| mean(&mut AROUND.into_iter().filter_map(near)))
    }

    fn trace_level(&self, level: f64, rim: i64, cell: impl Fn(i64, i64) -> bool) -> Vec<Line> {
        let above = |i, j| self.get(i, j).is_some_and(|value| level <= value);
        let joined = |i, j| {
            let values = corners(i, j).map(|[i, j]| self.get(i, j));
            values.iter().all(Option::is_some) && 4.0 * level <= values.iter().flatten().sum::<f64>()
        };
        let share = |inside: [i64; 2], outside: [i64; 2]| match (
            self.get(inside[0], inside[1]),
            self.get(outside[0], outside[1]),
        ) {
            (Some(high), Some(low)) => (high - level) / (high - low),
            _ => 0.5,
        };
        self.trace(rim, above, joined, cell, share)
    }

    /// Marching squares: the border of the nodes that are `inside`, through the cells that `cell` lets pass.
    ///
    /// With a `rim` of 1 everything beyond the grid is outside, and the border then runs along the outermost nodes, so
    /// every line closes. Where opposite corners are inside, `joined` says whether the cell's middle is.
    fn trace(
        &self,
        rim: i64,
        inside: impl Fn(i64, i64) -> bool,
        joined: impl Fn(i64, i64) -> bool,
        cell: impl Fn(i64, i64) -> bool,
        share: impl Fn([i64; 2], [i64; 2]) -> f64,
    ) -> Vec<Line> {
        let on_grid = |[i, j]: [i64; 2]| (0..self.columns as i64).contains(&i) && (0..self.rows as i64).contains(&j);
        // Every node is asked once, and belongs to four cells.
        let row = |j: i64| -> Vec<bool> { (-rim..self.columns as i64 + rim).map(|i| inside(i, j)).collect() };
        let (mut steps, mut above) = (Vec::new(), row(-rim));
        for j in -rim..self.rows as i64 - 1 + rim {
            let below = std::mem::replace(&mut above, row(j + 1));
            for (i, (low, high)) in (-rim..).zip(below.windows(2).zip(above.windows(2))) {
                let within = [low[0], low[1], high[1], high[0]];
                let around = corners(i, j);
                if within == [true; 4] || within == [false; 4] || !cell(i, j) {
                    continue;
                }
                let leaves = |k: usize| within[k % 4] && !within[(k + 1) % 4];
                let enters = |k: usize| !within[k % 4] && within[(k + 1) % 4];
                for out in (0..4).filter(|&k| leaves(k)) {
                    // The border keeps the inside on its left: from the edge where the corners leave the inside back to
                    // the one before, or, where the middle joins two corners, round the corner outside.
                    let turns = if leaves(out + 2) && joined(i, j) { [1, 2, 3] } else { [3, 2, 1] };
                    let Some(back) = turns.into_iter().map(|turn| out + turn).find(|&k| enters(k)) else { continue };
                    let crossing = |from: usize, to: usize| {
                        let (from, to) = (around[from % 4], around[to % 4]);
                        let share = if on_grid(to) { share(from, to).clamp(0.0, 1.0) } else { 0.0 };
                        [0, 1].map(|axis| from[axis] as f64 + share * (to[axis] - from[axis]) as f64)
                    };
                    steps.push(Step {
                        from: (edge(around[out], around[(out + 1) % 4]), crossing(out, out + 1)),
                        to: (edge(around[back % 4], around[(back + 1) % 4]), crossing(back + 1, back)),
                    });
                }
            }
        }
        linked(&steps)
    }
}

/// The border's way through one cell: the edges it crosses, and where.
struct Step {
    from: (Edge, Node),
    to: (Edge, Node),
}

/// An edge of the grid by its two nodes.
type Edge = [[i64; 2]; 2];

fn edge(a: [i64; 2], b: [i64; 2]) -> Edge {
    [a.min(b), a.max(b)]
}

/// The corners of a cell, counter-clockwise with rows upwards.
fn corners(i: i64, j: i64) -> [[i64; 2]; 4] {
    [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]
}

/// Joins steps end to end; open lines first, in the order of the steps.
fn linked(steps: &[Step]) -> Vec<Line> {
    let starts: HashMap<Edge, usize> = steps.iter().enumerate().map(|(i, step)| (step.from.0, i)).collect();
    let mut headless = vec![true; steps.len()];
    for step in steps {
        if let Some(&next) = starts.get(&step.to.0) {
            headless[next] = false;
        }
    }
    let mut used = vec![false; steps.len()];
    let heads = (0..steps.len()).filter(|&i| headless[i]).chain(0..steps.len());
    let mut lines = Vec::new();
    for head in heads {
        let mut points = Vec::new();
        let mut at = Some(head).filter(|&i| !used[i]);
        let mut last = head;
        while let Some(i) = at {
            used[i] = true;
            points.push(steps[i].from.1);
            last = i;
            at = starts.get(&steps[i].to.0).copied().filter(|&next| !used[next]);
        }
        if !points.is_empty() {
            points.push(steps[last].to.1);
            lines.push(points);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::line::area;
    use super::*;

    fn cone(present: impl Fn(f64, f64) -> bool) -> Grid {
        Grid::new(41, 41, |i, j| {
            let (x, y) = (i as f64 - 20.0, j as f64 - 20.0);
            present(x, y).then_some(x.hypot(y))
        })
    }

    fn radius(point: &Node) -> f64 {
        (point[0] - 20.0).hypot(point[1] - 20.0)
    }

    #[test]
    fn the_iso_line_of_a_cone_is_a_circle() {
        let lines = cone(|_, _| true).iso_lines(12.5);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        // Linear interpolation over a cell is off by at most 1/(8 r).
        assert!(lines[0].iter().all(|p| (radius(p) - 12.5).abs() < 0.011));
        // The cone is above outside: the inside of the circle lies on the right.
        assert!((area(&lines[0]) + std::f64::consts::PI * 12.5 * 12.5).abs() < 2.0, "{}", area(&lines[0]));
    }

    #[test]
    fn absent_cells_produce_no_line() {
        let half = cone(|x, _| x < 0.0);
        let lines = half.iso_lines(12.5);
        assert_eq!(lines.len(), 1);
        assert_ne!(lines[0].first(), lines[0].last());
        assert!(lines[0].iter().all(|p| p[0] <= 19.0 && (radius(p) - 12.5).abs() < 0.011));
        assert!(cone(|_, _| false).iso_lines(12.5).is_empty());
        assert!(cone(|_, _| false).outline(|_, _| 0.5).is_empty());
        assert!(Grid::new(0, 0, |_, _| None).area_above(1.0).is_empty());
    }

    #[test]
    fn an_area_closes_along_the_rim_of_the_grid_and_has_holes() {
        let rings = cone(|_, _| true).area_above(10.0);
        assert!(rings.iter().all(|ring| ring.first() == ring.last()));
        let total: f64 = rings.iter().map(|ring| area(ring)).sum();
        assert!((total - (1600.0 - std::f64::consts::PI * 100.0)).abs() < 2.0, "{total}");
    }

    #[test]
    fn an_outline_ends_at_the_true_edge() {
        let disc = cone(|x, y| x.hypot(y) <= 15.0);
        let true_edge = |inside: [i64; 2], outside: [i64; 2]| {
            let at = |share: f64| [0, 1].map(|k| inside[k] as f64 + share * (outside[k] - inside[k]) as f64);
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..30 {
                let middle = f64::midpoint(low, high);
                if radius(&at(middle)) <= 15.0 { low = middle } else { high = middle }
            }
            low
        };
        let rings = disc.outline(true_edge);
        assert_eq!(rings.len(), 1);
        assert!(rings[0].iter().all(|p| (radius(p) - 15.0).abs() < 1e-6));
        let smooth = disc.smooth_outline();
        assert!(smooth.iter().flatten().all(|p| (radius(p) - 15.0).abs() < 0.7));
    }

    #[test]
    fn a_saddle_is_split_by_the_mean_of_its_corners() {
        let saddle = |mean: f64| Grid::new(2, 2, move |i, j| Some(if i == j { 1.0 } else { 2.0 * mean - 1.0 }));
        let ways = |mean: f64| saddle(mean).iso_lines(0.5);
        let apart = |ways: &[Vec<Node>]| ways.iter().any(|way| way.iter().all(|p| p[0] + p[1] < 1.0));
        assert!(apart(&ways(0.4)) && !apart(&ways(0.6)), "{:?} {:?}", ways(0.4), ways(0.6));
    }

    #[test]
    fn a_field_is_carried_on_in_a_straight_line() {
        let plane = Grid::new(9, 9, |i, j| (i < 5).then_some(2.0 * i as f64 + j as f64));
        let wider = plane.extended(2);
        assert_eq!(wider.get(6, 4), Some(16.0));
        assert_eq!(wider.get(7, 4), None);
    }
}
