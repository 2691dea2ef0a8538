//! Which parts of a map in space hang together? Between two ways to hold its points the field may jump, and a line through the jump would
//! follow the stairs of the grid.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use stiffarm::inverse::{Configuration, Shoulder};
use stiffarm::map::PointsBetween;
use stiffarm::plane::Elbow;

use super::contour::Grid;
use super::line::{Line, Node};

/// Between neighbours that hang together the roll turns by less than this, rad.
const TURNS: f64 = 0.3;
/// Fewer points are no part: their edge would be a guess.
const FEWEST: usize = 12;
/// How often the gap between two grid points is halved to find where a part ends.
const HALVES: usize = 6;

/// How a point is held: configuration and roll, rad.
type HeldPosture = (Configuration, f64);

/// How the points of a map are held, and those between them.
pub(crate) struct Ways<'a> {
    /// By column and row of the map.
    pub at: Box<dyn Fn(usize, usize) -> Option<HeldPosture> + 'a>,
    /// By m from the base.
    pub between: PointsBetween,
}

/// A part of a field over which it does not jump.
pub(crate) struct Part {
    pub grid: Grid,
    /// Its edge, as sharp as the arm's own limits.
    pub region: Vec<Line>,
}

/// The parts of a field whose points are held in the ways `held`; `between` tells it of points between, and less than `jump` between
/// neighbours is no jump. The first part is all of the field.
pub(crate) fn parts(
    grid: &Grid,
    jump: f64,
    held: &dyn Fn(usize, usize) -> Option<HeldPosture>,
    between: &dyn Fn(Node) -> Option<HeldPosture>,
) -> Vec<Part> {
    let at = |[i, j]: [i64; 2]| held(i as usize, j as usize);
    let search = |inside: [i64; 2], outside: [i64; 2], belongs: &dyn Fn(Option<HeldPosture>) -> bool| {
        let node = |share: f64| [0, 1].map(|k| inside[k] as f64 + share * (outside[k] - inside[k]) as f64);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVES {
            let middle = f64::midpoint(low, high);
            if belongs(between(node(middle))) { low = middle } else { high = middle }
        }
        low
    };
    let region = grid.outline(|inside, outside| search(inside, outside, &|found| found.is_some()));
    let mut parts = vec![Part { grid: grid.clone(), region }];
    let (numbers, count) = numbered(grid, jump, held);
    if count == 1 {
        return parts;
    }
    let sizes = |number| numbers.iter().filter(|own| **own == Some(number)).count();
    for number in (0..count).filter(|number| FEWEST <= sizes(*number)) {
        let own = |i: usize, j: usize| numbers[j * grid.columns + i] == Some(number);
        let part = Grid::new(grid.columns, grid.rows, |i, j| grid.get(i as i64, j as i64).filter(|_| own(i, j)));
        let region = part.outline(|inside, outside| {
            let Some(own) = at(inside) else { return 0.5 };
            let other = at(outside);
            search(inside, outside, &|found| {
                let nearer = |found| other.is_none_or(|other| apart(own, found) <= apart(other, found));
                found.is_some_and(nearer)
            })
        });
        parts.push(Part { grid: part, region });
    }
    parts
}

/// The number of the part in which each point lies, and how many parts there are.
///
/// Points hang together where the roll turns slowly. Of what is apart then, those are one part again between which the field
/// nowhere jumps.
fn numbered(grid: &Grid, jump: f64, held: &dyn Fn(usize, usize) -> Option<HeldPosture>) -> (Vec<Option<usize>>, usize) {
    let at = |i: usize, j: usize| grid.get(i as i64, j as i64).and_then(|_| held(i, j));
    let ways: Vec<Option<HeldPosture>> =
        (0..grid.columns * grid.rows).map(|k| at(k % grid.columns, k / grid.columns)).collect();
    let (numbers, count) = slowly_turning(grid.columns, &ways);
    let mut groups: Vec<usize> = (0..count).collect();
    let (level, mut apart) = borders(grid, jump, &ways, &numbers);
    for (one, other) in level {
        let (one, other) = (groups[one], groups[other]);
        if one == other || apart.contains(&(one.min(other), one.max(other))) {
            continue;
        }
        let joined = |group: usize| if group == other { one } else { group };
        for group in &mut groups {
            *group = joined(*group);
        }
        apart = apart.into_iter().map(|(a, b)| (joined(a), joined(b))).map(|(a, b)| (a.min(b), a.max(b))).collect();
    }
    let mut kept: Vec<usize> = groups.clone();
    kept.sort_unstable();
    kept.dedup();
    let renumbered = |number: usize| kept.binary_search(&groups[number]).ok();
    (numbers.into_iter().map(|number| number.and_then(renumbered)).collect(), kept.len())
}

/// Parts by their numbers, the smaller one first.
type Pairs = BTreeSet<(usize, usize)>;

/// Points that hang together, neighbour by neighbour, whatever the field.
fn slowly_turning(columns: usize, ways: &[Option<HeldPosture>]) -> (Vec<Option<usize>>, usize) {
    let mut numbers = vec![None; ways.len()];
    let mut count = 0;
    for start in 0..ways.len() {
        if ways[start].is_none() || numbers[start].is_some() {
            continue;
        }
        let mut open = vec![start];
        numbers[start] = Some(count);
        while let Some(from) = open.pop() {
            for to in beside(from, columns, ways.len()) {
                let near = ways[from].zip(ways[to]).is_some_and(|(own, other)| apart(own, other) < TURNS);
                if near && numbers[to].is_none() {
                    numbers[to] = Some(count);
                    open.push(to);
                }
            }
        }
        count += 1;
    }
    (numbers, count)
}

/// Pairs of numbers that are neighbours with the arm held alike: those between which the field does not jump at some point, and those between
/// which it does.
fn borders(grid: &Grid, jump: f64, ways: &[Option<HeldPosture>], numbers: &[Option<usize>]) -> (Pairs, Pairs) {
    let value = |cell: usize| grid.get((cell % grid.columns) as i64, (cell / grid.columns) as i64);
    let (mut level, mut cliffs) = (BTreeSet::new(), BTreeSet::new());
    for from in 0..ways.len() {
        for to in beside(from, grid.columns, ways.len()).filter(|to| from < *to) {
            let (Some(one), Some(other)) = (numbers[from], numbers[to]) else { continue };
            let alike = ways[from].zip(ways[to]).is_some_and(|(a, b)| apart(a, b) < TAU);
            if one == other || !alike {
                continue;
            }
            let is_level = value(from).zip(value(to)).is_some_and(|(a, b)| (a - b).abs() < jump);
            let of = if is_level { &mut level } else { &mut cliffs };
            of.insert((one.min(other), one.max(other)));
        }
    }
    (level, cliffs)
}

/// The neighbours of a cell: left, right, below and above.
fn beside(cell: usize, columns: usize, cells: usize) -> impl Iterator<Item = usize> {
    let column = cell % columns;
    let left = (0 < column).then(|| cell - 1);
    let right = (column + 1 < columns).then_some(cell + 1);
    let up = Some(cell + columns).filter(|up| *up < cells);
    [left, right, cell.checked_sub(columns), up].into_iter().flatten()
}

/// How different two ways are: the turn between their rolls, and much more where shoulder or elbow differ. Both wrists put every axis
/// into the same place.
fn apart(one: HeldPosture, other: HeldPosture) -> f64 {
    let arm = |(configuration, _): HeldPosture| -> (Shoulder, Elbow) { (configuration.shoulder, configuration.elbow) };
    let turn = ((one.1 - other.1 + PI).rem_euclid(TAU) - PI).abs();
    if arm(one) == arm(other) { turn } else { TAU + turn }
}

#[cfg(test)]
mod tests {
    use super::super::line::area;
    use super::*;
    use stiffarm::inverse::Wrist;

    #[test]
    fn a_cliff_is_cut_where_it_is_and_not_where_the_grid_is() {
        // The upper arm gives way to the lower one along a slanting line, within a disc.
        let edge = |[x, y]: Node| y - 0.37 * x - 4.2;
        let way = |node: Node| {
            let elbow = if edge(node) < 0.0 { Elbow::Up } else { Elbow::Down };
            let inside = (node[0] - 20.0).hypot(node[1] - 20.0) < 17.3;
            inside.then_some((Configuration { shoulder: Shoulder::Front, elbow, wrist: Wrist::NoFlip }, 0.0))
        };
        let at = |i: usize, j: usize| way([i as f64, j as f64]);
        let value = |i: usize, j: usize| at(i, j).map(|(way, _)| if way.elbow == Elbow::Up { 1.0 } else { 5.0 });
        let grid = Grid::new(41, 41, value);
        let found = parts(&grid, 0.5, &at, &way);
        assert_eq!(found.len(), 3);
        let areas: Vec<f64> = found.iter().map(|part| part.region.iter().map(|ring| area(ring)).sum()).collect();
        assert!((areas[0] - PI * 17.3 * 17.3).abs() < 3.0, "{areas:?}");
        assert!((areas[1] + areas[2] - areas[0]).abs() < 1.0, "{areas:?}");
        for part in &found[1..] {
            let inner = part.region.iter().flatten().filter(|[x, y]| (x - 20.0).hypot(y - 20.0) < 16.0);
            let off: Vec<f64> = inner.map(|node| edge(*node).abs()).collect();
            assert!(10 < off.len() && off.iter().all(|off| *off < 0.02), "{off:?}");
        }
    }

    #[test]
    fn rolls_that_turn_slowly_hang_together_and_wrists_do_not_matter() {
        let way = |i: usize, j: usize| {
            // The upper half is held at another roll.
            let wrist = Wrist::ALL[i % 2];
            let roll = 0.2 * i as f64 + if j < 5 { 0.0 } else { 2.0 };
            Some((Configuration { shoulder: Shoulder::Front, elbow: Elbow::Up, wrist }, roll))
        };
        let grid = Grid::new(60, 10, |_, j| Some(if j < 5 { 1.0 } else { 2.0 }));
        let (numbers, count) = numbered(&grid, 0.5, &way);
        assert_eq!(count, 2);
        assert_eq!(numbered(&grid, 1.5, &way).1, 1, "no jump, no parts");
        assert!(numbers[..300].iter().all(|n| *n == Some(0)) && numbers[300..].iter().all(|n| *n == Some(1)));
    }

    #[test]
    fn a_crack_that_fades_out_is_still_a_crack() {
        // Both halves agree on the left, and differ the more the farther to the right.
        let roll = |j: usize| if j < 5 { 0.0 } else { 2.0 };
        let way = |_: usize, j: usize| {
            Some((Configuration { shoulder: Shoulder::Front, elbow: Elbow::Up, wrist: Wrist::NoFlip }, roll(j)))
        };
        let grid = Grid::new(40, 10, |i, j| Some(if j < 5 { 0.0 } else { 0.1 * i as f64 }));
        assert_eq!(numbered(&grid, 0.5, &way).1, 2);
        assert_eq!(numbered(&grid, 5.0, &way).1, 1);
    }
}
