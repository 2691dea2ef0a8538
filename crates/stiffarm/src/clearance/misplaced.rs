//! Where a work stands: what of part, block and fixture reaches into what is kept free, or below the floor?

use nalgebra::{Point3, Vector3};

use super::{Machined, Mesh, Obstacle, Solid, Surroundings};
use crate::spatial::Pose;

/// What reaches in no farther, m, stands on it: a fixture on a table.
const STANDS: f64 = 1e-3;

/// Something of the work stands where nothing may.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misplaced {
    /// Part, stock or fixture.
    pub what: Obstacle,
    /// A keep-out or the floor.
    pub into: Obstacle,
    /// At most so deep, m: by the boxes about both along the sides of a keep-out.
    pub depth: f64,
}

/// Something of the work.
enum Body<'a> {
    Triangles(&'a Mesh),
    /// Low and high corner.
    Block([[f64; 3]; 2]),
}

impl Body<'_> {
    /// Points inside of whose hull all of it is, where it stands at `pose`.
    fn corners(&self, pose: &Pose) -> Vec<Vector3<f64>> {
        let ends = match self {
            Self::Triangles(mesh) => mesh.extent(),
            Self::Block(ends) => *ends,
        };
        let corner = |i: usize| Point3::from(std::array::from_fn(|axis| ends[i >> axis & 1][axis]));
        (0..8).map(|i| (pose * corner(i)).coords).collect()
    }

    /// The same by every corner of its triangles.
    fn points(&self, pose: &Pose) -> Vec<Vector3<f64>> {
        match self {
            Self::Triangles(mesh) => mesh.placed(pose).0.into_iter().map(Vector3::from).collect(),
            Self::Block(_) => self.corners(pose),
        }
    }

    fn touches(&self, pose: &Pose, solid: &Solid) -> bool {
        match self {
            Self::Triangles(mesh) => mesh.apart_from_solid(pose, solid) <= 0.0,
            Self::Block([low, high]) => {
                let of = |end: fn(f64, f64) -> f64| Vector3::from_fn(|axis, _| end(low[axis], high[axis]));
                let (middle, half) = (of(f64::midpoint), of(|low, high| (high - low) / 2.0));
                let pose = pose * Pose::from(middle);
                Solid::Box { pose, half: half.into() }.touches(solid)
            }
        }
    }
}

impl Machined {
    fn bodies(&self) -> impl Iterator<Item = (Obstacle, Body<'_>)> {
        let part = self.part.iter().map(|part| (Obstacle::Part, Body::Triangles(part)));
        // What is cut from a block lies inside of it.
        let stock = self.stock.iter().map(|stock| (Obstacle::Stock, Body::Block(stock.block())));
        let fixture = self.fixture.iter().map(|fixture| (Obstacle::Fixture, Body::Triangles(fixture)));
        part.chain(stock).chain(fixture)
    }
}

impl Surroundings {
    /// What of the work that is machined stands where nothing may, where its frame stands at `pose` in the base.
    pub(crate) fn misplaced(&self, pose: &Pose) -> Vec<Misplaced> {
        let mut found = Vec::new();
        for (what, body) in self.machined.iter().flat_map(Machined::bodies) {
            let corners = body.corners(pose);
            // What the box about it does not reach it does not reach.
            let deep = |depth: &dyn Fn(&[Vector3<f64>]) -> f64| {
                (STANDS < depth(&corners)).then(|| depth(&body.points(pose))).filter(|depth| STANDS < *depth)
            };
            if let Some([through, up]) = &self.floor {
                let below = |points: &[Vector3<f64>]| {
                    points.iter().map(|point| (through - point).dot(up)).fold(f64::NEG_INFINITY, f64::max)
                };
                found.extend(deep(&below).map(|depth| Misplaced { what, into: Obstacle::Floor, depth }));
            }
            for (number, solid) in (1..).zip(&self.keep_out) {
                let depth = deep(&|points| solid.depth_of(points)).filter(|_| body.touches(pose, solid));
                found.extend(depth.map(|depth| Misplaced { what, into: Obstacle::KeepOut(number), depth }));
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_4;

    use super::*;
    use crate::catalogue::stl::Surface;

    /// The triangles of a box.
    fn boxed(low: [f64; 3], high: [f64; 3]) -> Mesh {
        let corners = (0..8).map(|i| std::array::from_fn(|axis| [low, high][i >> axis & 1][axis])).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Mesh::of(&Surface { corners, triangles, is_closed: true, notes: Vec::new() })
    }

    fn about(fixture: Mesh, keep_out: Vec<Solid>, floor: Option<f64>) -> Surroundings {
        let machined =
            Machined { pose: Pose::identity(), part: None, stock: None, fixture: Some(fixture), cutter: None };
        Surroundings { keep_out, machined: Some(machined), ..Surroundings::above(floor) }
    }

    /// A plate of 0.4 x 0.2 x 0.1 m before a cabinet whose nearer side is 1 m ahead.
    #[test]
    fn a_fixture_in_a_cabinet_is_found_as_deep_as_by_hand_and_one_beside_it_is_not() {
        let plate = boxed([-0.2, -0.1, 0.0], [0.2, 0.1, 0.1]);
        let cabinet = Solid::Box { pose: Pose::translation(1.5, 0.0, 1.0), half: [0.5, 0.5, 1.0] };
        let about = about(plate, vec![cabinet], Some(0.0));
        let at = |x: f64, turn: f64| {
            about.misplaced(&(Pose::translation(x, 0.0, 0.5) * Pose::rotation(Vector3::z() * turn)))
        };
        assert_eq!(at(0.79, 0.0), vec![]);
        assert_eq!(at(0.8005, 0.0), vec![], "it stands beside it but for rounding");
        let found = at(0.83, 0.0);
        assert!(found.len() == 1 && (found[0].depth - 0.03).abs() < 1e-12, "{found:?}");
        assert_eq!((found[0].what, found[0].into), (Obstacle::Fixture, Obstacle::KeepOut(1)));
        // Turned by 45 deg its corner reaches 0.3 cos 45 deg ahead.
        let reach = 0.3 * FRAC_PI_4.cos();
        assert_eq!(at(1.0 - reach - 0.01, FRAC_PI_4), vec![]);
        let found = at(1.0 - reach + 0.02, FRAC_PI_4);
        assert!(found.len() == 1 && (found[0].depth - 0.02).abs() < 1e-12, "{found:?}");
        // All of it inside.
        assert_eq!(at(1.5, 0.0).len(), 1);
    }

    /// The box about an angle reaches where the angle does not.
    #[test]
    fn what_a_box_about_it_reaches_alone_is_not_touched() {
        let post = Solid::Box { pose: Pose::translation(0.1, 0.1, 0.5), half: [0.05, 0.05, 0.5] };
        let [one, other] = [boxed([-0.2, -0.2, 0.0], [0.2, -0.15, 0.1]), boxed([-0.2, -0.2, 0.0], [-0.15, 0.2, 0.1])];
        for alone in [one, other] {
            assert_eq!(about(alone, vec![post], None).misplaced(&Pose::translation(0.0, 0.0, 0.3)), vec![]);
        }
        // An L of both, as one surface.
        let corners: Vec<[f64; 3]> =
            [[-0.2, -0.2], [0.2, -0.2], [0.2, -0.15], [-0.15, -0.15], [-0.15, 0.2], [-0.2, 0.2]]
                .into_iter()
                .flat_map(|[x, y]| [[x, y, 0.0], [x, y, 0.1]])
                .collect();
        let sides = (0..6_u32).flat_map(|i| {
            let j = (i + 1) % 6;
            [[2 * i, 2 * j, 2 * j + 1], [2 * i, 2 * j + 1, 2 * i + 1]]
        });
        let angle = Mesh::of(&Surface { corners, triangles: sides.collect(), is_closed: false, notes: Vec::new() });
        let about = about(angle, vec![post], None);
        assert_eq!(about.misplaced(&Pose::translation(0.0, 0.0, 0.3)), vec![]);
        assert_eq!(about.misplaced(&Pose::translation(0.22, 0.0, 0.3)).len(), 1);
    }

    #[test]
    fn what_is_below_the_floor_is_found_and_what_stands_on_it_is_not() {
        let about = about(boxed([-0.1; 3], [0.1; 3]), Vec::new(), Some(-0.5));
        assert_eq!(about.misplaced(&Pose::translation(1.0, 0.0, -0.4)), vec![]);
        let found = about.misplaced(&Pose::translation(1.0, 0.0, -0.43));
        assert!(found.len() == 1 && found[0].into == Obstacle::Floor, "{found:?}");
        assert!((found[0].depth - 0.03).abs() < 1e-12, "{found:?}");
    }
}
