//! How far is a link from a part that is made of triangles?

use std::sync::Arc;

use nalgebra::Vector3;
use parry3d_f64::math::{Pose as ParryPose, Vector};
use parry3d_f64::query::{PointQuery, distance};
use parry3d_f64::shape::{Shape, TriMesh, TriMeshFlags};

use super::solid::{Ball, Solid, parry};
use crate::body::Capsule;
use crate::catalogue::stl::Surface;
use crate::spatial::Pose;

/// A solid of triangles, made ready for distances; copies share it.
#[derive(Clone, Debug)]
pub struct Mesh(Arc<Ready>);

#[derive(Debug)]
struct Ready {
    mesh: TriMesh,
    is_closed: bool,
    centre: Vector3<f64>,
    radius: f64,
}

/// The same one: what was read twice is not compared triangle by triangle.
impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Mesh {
    /// Of a surface that has triangles.
    ///
    /// # Panics
    /// Of a surface without any; none that is read is so.
    pub fn of(surface: &Surface) -> Self {
        let corners: Vec<Vector> = surface.corners.iter().map(|corner| Vector::from(*corner)).collect();
        // Which side is inside is asked of a closed surface alone.
        let flags = if surface.is_closed { TriMeshFlags::ORIENTED } else { TriMeshFlags::empty() };
        let mesh = TriMesh::with_flags(corners, surface.triangles.clone(), flags).expect("a surface has triangles");
        let bounds = mesh.local_aabb();
        let (centre, radius) = (bounds.center(), bounds.half_extents().length());
        let centre = Vector3::new(centre.x, centre.y, centre.z);
        Self(Arc::new(Ready { mesh, is_closed: surface.is_closed, centre, radius }))
    }

    /// The box about it, m: low and high corner, in its own axes.
    pub fn extent(&self) -> [[f64; 3]; 2] {
        let bounds = self.0.mesh.local_aabb();
        [bounds.mins, bounds.maxs].map(|corner| [corner.x, corner.y, corner.z])
    }

    /// Its corners where it stands at `pose`, m, and its triangles by the numbers of these.
    pub fn placed(&self, pose: &Pose) -> (Vec<[f64; 3]>, &[[u32; 3]]) {
        let placed = |at: &Vector| pose.transform_point(&[at.x, at.y, at.z].into()).into();
        (self.0.mesh.vertices().iter().map(placed).collect(), self.0.mesh.indices())
    }

    /// About all of it, where it stands at `pose`.
    pub(super) fn ball(&self, pose: &Pose) -> Ball {
        Ball::new(pose.transform_point(&self.0.centre.into()).coords, self.0.radius)
    }

    /// To a capsule, m; negative where they overlap, then by no more than that.
    pub(super) fn apart_from(&self, pose: &Pose, capsule: &Capsule) -> f64 {
        let segment = capsule.segment();
        self.apart(pose, &Pose::identity(), &segment, &capsule.ends[0]) - capsule.radius
    }

    /// To a cylinder with flat ends about the line of a capsule, m; negative or zero where they overlap: by no more than the capsule does, than the
    /// cylinder and the box about the mesh, and than the way back along its line.
    pub(super) fn apart_from_cylinder(&self, pose: &Pose, capsule: &Capsule) -> f64 {
        let apart_from = |capsule: &Capsule| {
            let (at, cylinder) = capsule.cylinder();
            self.apart(pose, &at, &cylinder, &capsule.ends[0])
        };
        let apart = apart_from(capsule);
        if 0.0 < apart {
            return apart;
        }
        let bounds = self.0.mesh.local_aabb();
        let centre = bounds.center();
        let about = pose * Pose::translation(centre.x, centre.y, centre.z);
        let most =
            self.apart_from(pose, capsule).max(-capsule.depth_of_cylinder(&about, bounds.half_extents())).min(0.0);
        -capsule.way_back(-most, |drawn| 0.0 < apart_from(drawn))
    }

    /// To a solid, m; 0 or less where they overlap.
    pub(super) fn apart_from_solid(&self, pose: &Pose, solid: &Solid) -> f64 {
        let (at, _) = solid.bounds();
        solid.with_shape(|stands, shape| self.apart_from_shape(pose, stands, shape, &at.translation.vector))
    }

    /// To a convex shape one of whose points is known; what lies wholly inside is as far from outside as from the surface.
    fn apart(&self, pose: &Pose, at: &Pose, shape: &dyn Shape, point: &Vector3<f64>) -> f64 {
        self.apart_from_shape(pose, &parry(at), shape, point)
    }

    fn apart_from_shape(&self, pose: &Pose, at: &ParryPose, shape: &dyn Shape, point: &Vector3<f64>) -> f64 {
        let Ready { mesh, is_closed, .. } = &*self.0;
        let apart = distance(at, shape, &parry(pose), mesh).expect("parry knows convex shapes and triangles").distance;
        if 0.0 < apart && *is_closed {
            let local = pose.inverse_transform_point(&(*point).into());
            if mesh.contains_local_point(Vector::from(<[f64; 3]>::from(local.coords))) {
                return -apart;
            }
        }
        apart
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;

    /// The triangles of a box whose corners have the numbers from `first` on.
    fn faces(first: u32) -> impl Iterator<Item = [u32; 3]> {
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        faces.into_iter().flat_map(move |[a, b, c, d]| [[a, b, c], [a, c, d]].map(|face| face.map(|i| i + first)))
    }

    /// A box about zero by half its sides.
    fn block(half: [f64; 3]) -> Mesh {
        let corners =
            (0..8).map(|i| std::array::from_fn(|axis| if i >> axis & 1 == 0 { -half[axis] } else { half[axis] }));
        Mesh::of(&Surface {
            corners: corners.collect(),
            triangles: faces(0).collect(),
            is_closed: true,
            notes: Vec::new(),
        })
    }

    /// The same box as one solid is asked by other routines.
    #[test]
    fn a_mesh_of_a_box_is_as_far_as_the_box() {
        let mut rng = fastrand::Rng::with_seed(39);
        let (mut outside, mut inside) = (0, 0);
        for _ in 0..500 {
            let mut vector = |size: f64| Vector3::from_fn(|_, _| size * (rng.f64() - 0.5));
            let half: [f64; 3] = vector(1.0).map(|x| x.abs() + 0.05).into();
            let pose = Pose::new(vector(2.0), vector(6.0));
            let capsule = Capsule { ends: [vector(2.0), vector(2.0)], radius: 0.1 };
            let (mesh, solid) =
                (block(half).apart_from(&pose, &capsule), capsule.apart_from_solid(&Solid::Box { pose, half }));
            if -0.1 < solid {
                outside += 1;
                assert!((mesh - solid).abs() < 1e-6, "{mesh} {solid}");
            } else {
                inside += 1;
                assert!(mesh <= -0.1 + 1e-9, "{mesh} {solid}");
            }
        }
        assert!(100 < outside && 25 < inside, "{outside} {inside}");
    }

    #[test]
    fn what_lies_wholly_inside_touches() {
        let (pose, mesh) = (Pose::translation(1.0, 0.0, 0.0), block([0.5; 3]));
        let capsule = Capsule { ends: [Vector3::new(0.9, 0.0, 0.0), Vector3::new(1.1, 0.0, 0.0)], radius: 0.05 };
        assert!((mesh.apart_from(&pose, &capsule) + 0.45).abs() < 1e-9);
        let open = Surface { is_closed: false, ..surface(&mesh) };
        assert!((Mesh::of(&open).apart_from(&pose, &capsule) - 0.35).abs() < 1e-9, "without an inside");
    }

    /// A step 0.1 m high about zero, and one of 0.5 m beside it from x = 0.1 m on.
    fn stair() -> Mesh {
        let parts = [([-0.2, 0.1], 0.1), ([0.1, 0.3], 0.5)].map(|(x, high)| {
            let corner = move |i: usize| [x[i & 1], [-0.2, 0.2][i >> 1 & 1], [0.0, high][i >> 2]];
            (0..8).map(corner).collect::<Vec<[f64; 3]>>()
        });
        let triangles = faces(0).chain(faces(8)).collect();
        Mesh::of(&Surface { corners: parts.concat(), triangles, is_closed: true, notes: Vec::new() })
    }

    fn surface(mesh: &Mesh) -> Surface {
        let corners = mesh.0.mesh.vertices().iter().map(|v| [v.x, v.y, v.z]).collect();
        Surface { corners, triangles: mesh.0.mesh.indices().to_vec(), is_closed: true, notes: Vec::new() }
    }

    #[test]
    fn the_flat_end_of_a_spindle_does_not_reach_beyond_it() {
        let mesh = block([0.5; 3]);
        // Straight down on the top, 60 mm above it, and 100 mm thick: a round end would reach into it.
        let spindle = Capsule { ends: [Vector3::new(0.0, 0.0, 0.9), Vector3::new(0.0, 0.0, 0.56)], radius: 0.1 };
        let pose = Pose::identity();
        assert!((mesh.apart_from_cylinder(&pose, &spindle) - 0.06).abs() < 1e-6);
        assert!((mesh.apart_from(&pose, &spindle) + 0.04).abs() < 1e-9);
        // Leaning by 30 deg its rim is 0.1 m * 1/2 lower than its middle.
        let lean = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_6);
        let end = Vector3::new(0.0, 0.0, 0.56);
        let leaning = Capsule { ends: [end + lean * Vector3::z() * 0.3, end], radius: 0.1 };
        assert!((mesh.apart_from_cylinder(&pose, &leaning) - 0.01).abs() < 1e-6);
        // Its line runs down 60 mm beside the box, and it is 100 mm thick.
        let beside = Capsule { ends: [Vector3::new(0.56, 0.0, 0.9), Vector3::new(0.56, 0.0, 0.2)], radius: 0.1 };
        assert!((mesh.apart_from_cylinder(&pose, &beside) + 0.04).abs() < 1e-6, "as deep as its line is near");
        // Only its rim is in the box: it overlaps all the same.
        let rim = Capsule {
            ends: [end + lean * Vector3::z() * 0.3 - Vector3::z() * 0.02, end - Vector3::z() * 0.02],
            radius: 0.1,
        };
        assert!(mesh.apart_from_cylinder(&pose, &rim) < 0.0);
        // Half a millimetre in the lower step of a stair whose upper one is far higher: drawn back by that it is free.
        let stair = stair();
        let sunk = Capsule { ends: [Vector3::new(0.0, 0.0, 0.6), Vector3::new(0.0, 0.0, 0.0995)], radius: 0.05 };
        assert!((stair.apart_from_cylinder(&pose, &sunk) + 0.0005).abs() < 2e-5);
        // Sunk into the top by 20 mm, its line, too: it is 20 mm deep, not as deep as it is thick.
        let sunk = Capsule { ends: [Vector3::new(0.1, 0.0, 0.9), Vector3::new(0.1, 0.0, 0.48)], radius: 0.1 };
        assert!((mesh.apart_from_cylinder(&pose, &sunk) + 0.02).abs() < 1e-6);
        // Upside down, where there is no one turn from up to down.
        let under = Capsule { ends: [Vector3::new(0.0, 0.0, -0.9), Vector3::new(0.0, 0.0, -0.56)], radius: 0.1 };
        assert!((mesh.apart_from_cylinder(&pose, &under) - 0.06).abs() < 1e-6);
        let along_y = Capsule { ends: [Vector3::new(0.0, 0.9, 0.0), Vector3::new(0.0, 0.56, 0.0)], radius: 0.1 };
        assert!((mesh.apart_from_cylinder(&pose, &along_y) - 0.06).abs() < 1e-6);
    }
}
