//! At which points of a zone are poses evaluated?

use crate::task::Zone;

/// From so many cells on, the rim, where deflections and angles have most of their extremes, is covered four times as densely.
const WITH_RIM: usize = 16;

/// Points that cover a zone; the middle one is its centre.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub(crate) points: Vec<[f64; 2]>,
    /// The largest distance between neighbours, m.
    pub(crate) step: f64,
}

impl Grid {
    /// `cells`, an even number, along the shorter side (or the diameter), as many more along the longer one as keep the cells square, up
    /// to eight times as many.
    pub(crate) fn of(zone: Zone, cells: usize) -> Self {
        let [first, second] = zone.sides();
        let short = first.min(second);
        let along = |side: f64| cells * ((side / short).round() as usize).clamp(1, 8);
        let (columns, rows) = (along(first) + 1, along(second) + 1);
        let spread = |i: usize, count: usize| 2.0 * i as f64 / (count - 1) as f64 - 1.0;
        let mut points = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            for column in 0..columns {
                points.push(zone.at([spread(column, columns), spread(row, rows)]));
            }
        }
        if WITH_RIM <= cells {
            // Half before and half after, so that the centre stays in the middle.
            let rim = rim(zone, 4 * (columns - 1), 4 * (rows - 1));
            let later = rim.len() / 2;
            points.extend_from_slice(&rim[later..]);
            points.splice(0..0, rim[..later].iter().copied());
        }
        let step = (first / (columns - 1) as f64).max(second / (rows - 1) as f64);
        // On the disc neighbours along the rim lie up to an eighth of a circle per half side apart.
        let step = if zone.is_round() { step * std::f64::consts::FRAC_PI_2 } else { step };
        Self { points, step }
    }

    /// The same points in the order in which a place is soonest known to be worse than another: most are worst far from the centre.
    pub(crate) fn outermost_first(mut self) -> Self {
        self.points.sort_by(|a, b| b[0].hypot(b[1]).total_cmp(&a[0].hypot(a[1])));
        self
    }
}

/// Points on the rim, each distance between them once: `across` along the first side, `along` along the second.
fn rim(zone: Zone, across: usize, along: usize) -> Vec<[f64; 2]> {
    let spread = |i: usize, count: usize| 2.0 * i as f64 / count as f64 - 1.0;
    let level = (0..across).flat_map(|i| [[spread(i, across), -1.0], [-spread(i, across), 1.0]]);
    let upright = (0..along).flat_map(|i| [[1.0, spread(i, along)], [-1.0, -spread(i, along)]]);
    level.chain(upright).map(|at| zone.at(at)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::work::{WorkPlacement, WorkPlane};

    #[test]
    fn the_rim_is_covered_more_densely_and_extents_are_those_of_its_points() {
        let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw: 0.4, angle: 0.7, roll: 0.0 };
        for zone in [Zone::Circle { diameter: 0.6 }, Zone::Rectangle { width: 0.2, height: 0.5 }] {
            let grid = Grid::of(zone, 16);
            assert_eq!(grid.points[grid.points.len() / 2], [0.0; 2]);
            let on_rim = |&[u, v]: &[f64; 2]| match zone {
                Zone::Circle { diameter } => (u.hypot(v) - diameter / 2.0).abs() < 1e-12,
                Zone::Rectangle { width, height } => {
                    (u.abs() - width / 2.0).abs() < 1e-12 || (v.abs() - height / 2.0).abs() < 1e-12
                }
            };
            let rim: Vec<[f64; 2]> = grid.points.iter().copied().filter(on_rim).collect();
            let apart = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).hypot(b - d);
            for &at in &rim {
                let others = rim.iter().map(|&other| apart(at, other)).filter(|distance| 1e-12 < *distance);
                assert!(others.fold(f64::INFINITY, f64::min) <= grid.step / 4.0 + 1e-12, "{zone:?} {at:?}");
            }
            let plane = WorkPlane::of(-0.5, &work);
            let extents = plane.half_extents(zone);
            for axis in 0..3 {
                let far = rim.iter().map(|&at| plane.point(&work, at)[axis]).fold(0.0, f64::max);
                assert!(far <= extents[axis] + 1e-12 && extents[axis] * 0.9995 <= far, "{zone:?}: {far} {extents:?}");
            }
        }
    }

    #[test]
    fn grids_reach_the_rim_keep_their_step_and_have_the_centre_in_the_middle() {
        for zone in [Zone::Circle { diameter: 0.6 }, Zone::Rectangle { width: 0.2, height: 1.0 }] {
            let grid = Grid::of(zone, 8);
            assert_eq!(grid.points[grid.points.len() / 2], [0.0; 2]);
            let apart = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).hypot(b - d);
            let alone = |at: [f64; 2]| {
                grid.points.iter().map(|&other| apart(at, other)).filter(|d| 0.0 < *d).fold(f64::INFINITY, f64::min)
            };
            assert!(grid.points.iter().all(|&at| alone(at) <= grid.step + 1e-12));
            let [first, second] = zone.sides();
            let far = grid.points.iter().map(|[u, _]| *u).fold(0.0, f64::max);
            let high = grid.points.iter().map(|[_, v]| *v).fold(0.0, f64::max);
            assert!((far - first / 2.0).abs() < 1e-12 && (high - second / 2.0).abs() < 1e-12);
        }
    }
}
