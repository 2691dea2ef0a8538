//! A node of the branch and bound: a box of placements of the work, and the work plane at all of them at once.

use nalgebra::Matrix3;

use super::affine::{Affine, Vector, scaled, sin_cos, sum};
use crate::interval::Interval;
use crate::work::WorkPlacement;

/// A box of placements: intervals of x, z, yaw, angle and roll of a [`WorkPlacement`].
pub(crate) type Node = [Interval; 5];

/// The work plane at every placement of a node. The `N` variables are the intervals of the node that are no points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorkPlaneEnclosure<const N: usize> {
    centre: Vector<N>,
    first: Vector<N>,
    second: Vector<N>,
    /// The tool's axes in those of the base.
    tool: [Vector<N>; 3],
}

/// How many intervals of a node are variables: x and z always, the turns where they are no points.
pub(crate) fn variables(node: &Node) -> usize {
    2 + node[2..].iter().filter(|range| 0.0 < range.width()).count()
}

/// The placement in the middle of a node.
pub(crate) fn middle(node: &Node) -> WorkPlacement {
    let [x, z, yaw, angle, roll] = node.map(Interval::middle);
    WorkPlacement { x, y: 0.0, z, yaw, angle, roll }
}

impl<const N: usize> WorkPlaneEnclosure<N> {
    /// With a tool axis that rises by `elevation`, rad, above the horizontal; `N` must be what [`variables`] says.
    pub(crate) fn of(elevation: f64, node: &Node) -> Self {
        let length = |range: Interval, variable: usize| {
            let mut length = Affine::point(range.middle());
            length.deviations[variable] = range.width() / 2.0;
            length
        };
        let zero = Affine::point(0.0);
        let centre = [length(node[0], 0), zero, length(node[1], 1)];
        let mut next = 2;
        let mut turn = |range: Interval| {
            let turned = sin_cos::<N>(range, next);
            next += usize::from(0.0 < range.width());
            turned
        };
        let [(sy, cy), (sa, ca), (sr, cr)] = [turn(node[2]), turn(node[3]), turn(node[4])];
        let (se, ce) = elevation.sin_cos();
        let upwards = [cy * -se, sy * -se, Affine::point(ce)];
        let left = [-sy, cy, zero];
        let axis = [cy * ce, sy * ce, Affine::point(se)];
        let mixed = |a: &Vector<N>, by: Affine<N>, b: &Vector<N>, with: Affine<N>| -> Vector<N> {
            std::array::from_fn(|i| a[i] * by + b[i] * with)
        };
        // The tool's y axis at roll zero points to the right.
        let tool = [mixed(&upwards, cr, &left, -sr), mixed(&left, -cr, &upwards, -sr), axis];
        Self { centre, first: mixed(&upwards, ca, &left, sa), second: mixed(&left, ca, &upwards, -sa), tool }
    }

    /// One point (or all points of an affine form), with a tool that does not turn.
    pub(crate) fn at(point: Vector<N>, tool: &Matrix3<f64>) -> Self {
        let none = [Affine::point(0.0); 3];
        let axis = |i: usize| std::array::from_fn(|part| Affine::point(tool[(part, i)]));
        Self { centre: point, first: none, second: none, tool: [axis(0), axis(1), axis(2)] }
    }

    /// One point, with a tool along these axes.
    pub(crate) fn of_tool(point: Vector<N>, tool: [Vector<N>; 3]) -> Self {
        let none = [Affine::point(0.0); 3];
        Self { centre: point, first: none, second: none, tool }
    }

    /// A point of the work plane, m from its centre along the sides; base axes.
    pub(crate) fn point(&self, [u, v]: [f64; 2]) -> Vector<N> {
        sum(&self.centre, &sum(&scaled(&self.first, u), &scaled(&self.second, v)))
    }

    /// The axes of the work, base axes: its first side, its second side, and away from it.
    pub(crate) fn work(&self) -> [Vector<N>; 3] {
        [self.first, self.second, self.tool[2].map(|part| -part)]
    }

    /// A vector that the tool carries, base axes.
    pub(crate) fn carried(&self, [x, y, z]: [f64; 3]) -> Vector<N> {
        let across = sum(&scaled(&self.tool[0], x), &scaled(&self.tool[1], y));
        sum(&across, &scaled(&self.tool[2], z))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::work::WorkPlane;

    #[test]
    fn the_patches_of_all_stands_of_a_box_lie_where_it_says() {
        let mut rng = fastrand::Rng::with_seed(32);
        for case in 0..500 {
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let elevation = part(-1.5, 1.5);
            let width = [0.3, 0.01][case % 2];
            let node: Node = std::array::from_fn(|_| {
                let from = part(-1.0, 1.0);
                Interval::spanning(from, from + part(0.1, 1.0) * width)
            });
            let [x, z, yaw, angle, roll] = node.map(|range| part(range.min(), range.max()));
            let work = WorkPlacement { x, y: 0.0, z, yaw, angle, roll };
            let plane = WorkPlane::of(elevation, &work);
            let all = WorkPlaneEnclosure::<5>::of(elevation, &node);
            let (at, carried) = ([part(-1.0, 1.0), part(-1.0, 1.0)], [part(-1.0, 1.0), part(-1.0, 1.0), 0.3]);
            let away = -Vector3::from(plane.tool().column(2));
            let expected =
                [plane.point(&work, at), plane.tool() * Vector3::from(carried), plane.first, plane.second, away];
            let [first, second, third] = all.work();
            for (found, expected) in [all.point(at), all.carried(carried), first, second, third].iter().zip(expected) {
                for (found, expected) in found.iter().zip(&expected) {
                    assert!(found.min() - 1e-12 <= *expected && *expected <= found.max() + 1e-12);
                    assert!(found.remainder < 2.0 * width, "{found:?}");
                }
            }
        }
    }
}
