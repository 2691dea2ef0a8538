//! What was the edge of an area of which only the grid points inside are known?

use super::line::{Line, Node};

/// A border through the middles of edges, with the treads of its stairs left out.
///
/// Where the true edge is flatter than the grid's diagonal, the middles of level edges, at the risers, lie nearly on it
/// and those of upright edges do not; where it is steeper, the other way round. A tread is a run of the same kind. Of a
/// tread at a summit or at the rim its middle or its end stays, so that the area is not cut short.
pub(crate) fn without_stairs(line: &[Node]) -> Line {
    let kind = |p: &Node| p.map(|x| x.fract() != 0.0);
    // A run must not be torn where the line happens to begin.
    let open = &line[..line.len().saturating_sub(1)];
    let first = (0..open.len()).find(|&i| kind(&open[i]) != kind(&open[(i + open.len() - 1) % open.len()]));
    let Some(first) = first else { return line.to_vec() };
    let turned: Line = open[first..].iter().chain(&open[..first]).copied().collect();
    let runs: Vec<&[Node]> = turned.chunk_by(|a, b| kind(a) == kind(b)).collect();
    let mut kept = Line::new();
    for (i, run) in runs.iter().enumerate() {
        let (before, after) = (runs[(i + runs.len() - 1) % runs.len()], runs[(i + 1) % runs.len()]);
        let (Some(previous), Some(next)) = (before.last(), after.first()) else { continue };
        let [level, upright] = kind(&run[0]);
        let [at_rim, rim_next] = [previous, next].map(|p| kind(p) == [false, false]);
        let across = usize::from(upright);
        if run.len() == 1 || level == upright {
            kept.extend_from_slice(run);
        } else if at_rim || rim_next {
            kept.extend(if at_rim { run.first() } else { None });
            kept.extend(if rim_next { run.last() } else { None });
        } else if previous[across] == next[across] {
            kept.push(run[run.len() / 2]);
        }
    }
    kept.extend(kept.first().copied());
    kept
}

#[cfg(test)]
mod tests {
    use super::super::contour::Grid;
    use super::*;

    #[test]
    fn a_slanting_edge_has_no_stairs() {
        let height = |x: f64| 15.3 + 0.23 * x;
        let under = Grid::new(61, 41, |i, j| (j as f64 <= height(i as f64)).then_some(1.0));
        let rings = under.smooth_outline();
        assert_eq!(rings.len(), 1);
        // Half a column of doubt at this slope; half a row where the edge meets the rim.
        let off = |p: &Node| (p[1] - height(p[0])).abs();
        let edge = rings[0].iter().filter(|p| 0.0 < p[1] && 0.0 < p[0] && p[0] < 60.0);
        assert!(10 < edge.clone().count() && edge.clone().all(|p| off(p) < 0.13), "{rings:?}");
    }
}
