//! How far is a link from a box, a disc or another link? `parry` and its types are used here, in `mesh` and in `stock` alone.

use nalgebra::{UnitQuaternion, Vector3};
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query::{contact, details::distance_segment_segment, intersection_test};
use parry3d_f64::shape::{Cuboid, Cylinder, Segment, Shape};

use crate::body::Capsule;
use crate::spatial::Pose;
use crate::task::Zone;
use crate::tolerances;

/// The work is a sheet of this thickness, m, behind its surface.
const SHEET: f64 = 1e-3;
/// Solids farther apart than this, m, are reported to be so far apart.
const FAR: f64 = 1e3;
/// How far something is drawn back is known to this, m.
const DRAWN: f64 = 1e-5;
/// A link shorter than this, m, is a ball: a segment needs two ends.
const SHORT: f64 = 1e-9;

/// What stands about a robot; the pose is that of its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Solid {
    /// By half its sides, m.
    Box { pose: Pose, half: [f64; 3] },
    /// A disc as thick as it stands along z.
    Disc { pose: Pose, radius: f64, half_thickness: f64 },
}

/// A ball about something.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    centre: Vector3<f64>,
    radius: f64,
}

impl Ball {
    pub(super) fn new(centre: Vector3<f64>, radius: f64) -> Self {
        Self { centre, radius }
    }

    /// Another one is not farther, m.
    pub(super) fn is_within(&self, farthest: f64, other: &Self) -> bool {
        let most = farthest + self.radius + other.radius;
        0.0 <= most && (self.centre - other.centre).norm_squared() <= most * most
    }
}

impl Capsule {
    /// About all of it.
    pub(super) fn ball(&self) -> Ball {
        let [from, to] = self.ends;
        Ball { centre: (from + to) / 2.0, radius: (to - from).norm() / 2.0 + self.radius }
    }

    /// To a ball, m; negative where they overlap.
    pub(super) fn apart_from_ball(&self, Ball { centre, radius }: &Ball) -> f64 {
        let [from, to] = self.ends;
        let along = to - from;
        // Of a line without length any point is the nearest.
        let part = (centre - from).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
        (centre - from - along * part.clamp(0.0, 1.0)).norm() - radius - self.radius
    }

    /// The same without the last `length`, m, before its second end; `None` where nothing remains.
    pub(crate) fn cut_back(self, length: f64) -> Option<Self> {
        let [from, to] = self.ends;
        let whole = (to - from).norm();
        (length < whole).then(|| Self { ends: [from, to - (to - from) * (length / whole)], ..self })
    }

    /// The part behind so large a share of it from its first end on; `None` where nothing is left.
    pub(crate) fn behind(self, share: f64) -> Option<Self> {
        let [from, to] = self.ends;
        (share < 1.0).then(|| Self { ends: [from + (to - from) * share, to], ..self })
    }

    /// Its lowest height over a plane through a point, m, with the unit normal `up`.
    pub(crate) fn above(&self, through: &Vector3<f64>, up: &Vector3<f64>) -> f64 {
        self.ends.map(|end| (end - through).dot(up)).into_iter().fold(f64::INFINITY, f64::min) - self.radius
    }

    /// To another one, m; negative where they overlap: their lines come so much nearer than the radii allow.
    pub(crate) fn apart_from(&self, other: &Self) -> f64 {
        let apart = distance_segment_segment(&ParryPose::identity(), &self.segment(), &other.segment());
        apart - self.radius - other.radius
    }

    /// No solid is nearer, m: by the box about both in the axes of the solid; nothing is known of boxes that overlap.
    pub(super) fn at_least_from(&self, solid: &Solid) -> f64 {
        let (pose, half) = solid.bounds();
        let [from, to] = self.ends.map(|end| pose.inverse_transform_point(&end.into()).coords);
        let gap = (from.inf(&to) - half).sup(&(-from.sup(&to) - half)).add_scalar(-self.radius).sup(&Vector3::zeros());
        let gap = gap.norm();
        if 0.0 < gap { gap } else { f64::NEG_INFINITY }
    }

    /// To a solid, m; negative where they overlap: so far one would have to move.
    pub(crate) fn apart_from_solid(&self, solid: &Solid) -> f64 {
        let segment = self.segment();
        let apart = solid.with_shape(|pose, shape| contact(&ParryPose::identity(), &segment, pose, shape, FAR));
        // Convex shapes are supported, so nothing within reach means that it is far.
        let apart = apart.ok().flatten().map_or(FAR, |contact| contact.dist);
        apart - self.radius
    }

    /// No point of it is farther from the joint-1 axis, m.
    pub(super) fn farthest_from_axis_1(&self) -> f64 {
        self.ends.iter().map(|end| end.xy().norm()).fold(0.0, f64::max) + self.radius
    }

    /// Turned about the joint-1 axis, rad.
    pub(super) fn about_axis_1(&self, angle: f64) -> Self {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        Self { ends: self.ends.map(|end| turn * end), ..*self }
    }

    /// With flat ends in place of its round ones, and where that stands.
    pub(super) fn cylinder(&self) -> (Pose, Cylinder) {
        let [from, to] = self.ends;
        let along = to - from;
        // A cylinder of parry stands along y.
        let turn = UnitQuaternion::rotation_between(&Vector3::y(), &along);
        let turn = turn.unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        (Pose::from_parts(((from + to) / 2.0).into(), turn), Cylinder::new(along.norm() / 2.0, self.radius))
    }

    /// So far it must move, with flat ends, to leave a box about zero by half its sides that stands at `pose`, m; 0 outside.
    pub(super) fn depth_of_cylinder(&self, pose: &Pose, half: Vector) -> f64 {
        let (at, cylinder) = self.cylinder();
        let met = contact(&parry(&at), &cylinder, &parry(pose), &Cuboid::new(half), 0.0);
        met.expect("parry knows convex shapes").map_or(0.0, |met| -met.dist.min(0.0))
    }

    /// So far it must be drawn back along its line until it is free, m; `most` where that is farther.
    pub(super) fn way_back(&self, most: f64, is_free: impl Fn(&Self) -> bool) -> f64 {
        let [from, to] = self.ends;
        let back = (from - to).normalize();
        let drawn = |way: f64| Self { ends: self.ends.map(|end| end + back * way), ..*self };
        if !is_free(&drawn(most)) {
            return most;
        }
        let (mut held, mut free) = (0.0, most);
        while DRAWN < free - held {
            let middle = f64::midpoint(held, free);
            if is_free(&drawn(middle)) { free = middle } else { held = middle }
        }
        free
    }

    pub(super) fn segment(&self) -> Segment {
        let [from, mut to] = self.ends;
        if (to - from).norm() < SHORT {
            to.z += SHORT;
        }
        let [from, to] = [from, to].map(|end| Vector::from(<[f64; 3]>::from(end)));
        Segment::new(from, to)
    }
}

impl Solid {
    /// About all of it.
    pub(super) fn ball(&self) -> Ball {
        match self {
            Self::Box { pose, half } => Ball { centre: pose.translation.vector, radius: Vector3::from(*half).norm() },
            Self::Disc { pose, radius, half_thickness } => {
                Ball { centre: pose.translation.vector, radius: radius.hypot(*half_thickness) }
            }
        }
    }

    /// The box about it, by half its sides, m.
    pub(super) fn bounds(&self) -> (&Pose, Vector3<f64>) {
        match self {
            Self::Box { pose, half } => (pose, Vector3::from(*half)),
            Self::Disc { pose, radius, half_thickness } => (pose, Vector3::new(*radius, *radius, *half_thickness)),
        }
    }

    /// How deep the box about some points, along its own sides, reaches into the box about it, m; negative where they are apart.
    pub(super) fn depth_of(&self, points: &[Vector3<f64>]) -> f64 {
        let (pose, half) = self.bounds();
        let own: Vec<Vector3<f64>> =
            points.iter().map(|point| pose.inverse_transform_point(&(*point).into()).coords).collect();
        let along = |axis: usize| {
            let ends = own.iter().map(|point| point[axis]);
            let (low, high) = (ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max));
            (high + half[axis]).min(half[axis] - low)
        };
        (0..3).map(along).fold(f64::INFINITY, f64::min)
    }

    /// Nothing of it stands higher than the base, in whose axes it is.
    pub(super) fn is_below_base(&self) -> bool {
        let (pose, half) = self.bounds();
        let up = (pose.rotation.inverse() * Vector3::z()).abs();
        pose.translation.vector.z + up.dot(&half) < tolerances::WINDOW
    }

    /// The sheet behind a flat zone, from its middle point, the directions of its sides and the one in which the tool points.
    pub(crate) fn sheet(zone: Zone, centre: Vector3<f64>, first: Vector3<f64>, along_tool: Vector3<f64>) -> Self {
        let axes = nalgebra::Matrix3::from_columns(&[first, along_tool.cross(&first), along_tool]);
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(axes);
        let pose = Pose::from_parts((centre + along_tool * (SHEET / 2.0)).into(), rotation.into());
        match zone {
            Zone::Circle { diameter } => Self::Disc { pose, radius: diameter / 2.0, half_thickness: SHEET / 2.0 },
            Zone::Rectangle { width, height } => Self::Box { pose, half: [width / 2.0, height / 2.0, SHEET / 2.0] },
        }
    }

    /// They share a point.
    pub(crate) fn touches(&self, other: &Self) -> bool {
        let shared = self.with_shape(|pose, shape| {
            other.with_shape(|other_pose, other| intersection_test(pose, shape, other_pose, other))
        });
        // Convex shapes are supported: there is no error.
        shared.is_ok_and(|shared| shared.intersecting)
    }

    pub(super) fn with_shape<R>(&self, ask: impl FnOnce(&ParryPose, &dyn Shape) -> R) -> R {
        match self {
            Self::Box { pose, half } => ask(&parry(pose), &Cuboid::new(Vector::from(*half))),
            Self::Disc { pose, radius, half_thickness } => {
                // A cylinder of parry stands along y.
                let standing = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
                ask(&parry(&(pose * standing)), &Cylinder::new(*half_thickness, *radius))
            }
        }
    }
}

pub(super) fn parry(pose: &Pose) -> ParryPose {
    let [x, y, z, w] = pose.rotation.coords.into();
    ParryPose::from_parts(
        Vector::from(<[f64; 3]>::from(pose.translation.vector)),
        Rotation::from_xyzw(x, y, z, w).normalize(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    fn capsule(from: [f64; 3], to: [f64; 3], radius: f64) -> Capsule {
        Capsule { ends: [from.into(), to.into()], radius }
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-7, "{a} is not {b}");
    }

    #[test]
    fn distances_are_those_of_a_hand_calculation() {
        let cube = Solid::Box { pose: Pose::translation(2.0, 0.0, 0.0), half: [0.5; 3] };
        // Level along y, 1 m before the near face at x = 1.5.
        close(capsule([0.5, -1.0, 0.0], [0.5, 1.0, 0.0], 0.2).apart_from_solid(&cube), 0.8);
        // Past the edge at (1.5, 0.5): a step of 0.3 and 0.4.
        close(capsule([1.2, 0.9, -5.0], [1.2, 0.9, 5.0], 0.1).apart_from_solid(&cube), 0.4);
        // Beside the corner (1.5, 0.5, 0.5): a step of 0.2, 0.3 and 0.6, the length of which is 0.7.
        close(capsule([1.3, 0.8, 1.1], [0.0, 2.0, 3.0], 0.0).apart_from_solid(&cube), 0.7);
        // 0.1 m under the face, with a radius of 0.2: it must move by 0.3.
        close(capsule([1.6, 0.0, 0.0], [0.0, 0.0, 0.0], 0.2).apart_from_solid(&cube), -0.3);
        let turned = Pose::new(Vector3::new(2.0, 0.0, 0.0), Vector3::z() * FRAC_PI_4);
        // The edge of the turned cube stands half a diagonal before its centre.
        close(
            capsule([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 0.1)
                .apart_from_solid(&Solid::Box { pose: turned, half: [0.5; 3] }),
            2.0 - 0.5_f64.sqrt() - 0.1,
        );
        let disc = Solid::Disc { pose: Pose::translation(0.0, 0.0, 1.0), radius: 0.5, half_thickness: 0.1 };
        close(capsule([0.0, 0.0, 2.0], [0.3, 0.0, 3.0], 0.25).apart_from_solid(&disc), 0.65);
        close(capsule([0.8, 0.0, 1.5], [0.8, 0.0, 3.0], 0.1).apart_from_solid(&disc), 0.4);
        // Crossed lines 0.7 m apart; and two that run into each other.
        let level = capsule([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.2);
        close(level.apart_from(&capsule([0.0, -1.0, 0.7], [0.0, 1.0, 0.7], 0.1)), 0.4);
        close(level.apart_from(&capsule([1.0, 0.1, 0.0], [2.0, 0.1, 0.0], 0.1)), -0.2);
        close(level.above(&Vector3::new(0.0, 0.0, -1.0), &Vector3::z()), 0.8);
        close(capsule([0.0; 3], [0.0; 3], 0.25).apart_from_solid(&cube), 1.25);
    }

    #[test]
    fn of_a_link_its_end_is_left_out_where_work_is_touched() {
        let tool = capsule([0.0, 0.0, 1.0], [0.0, 0.0, 0.0], 0.1);
        assert_eq!(tool.cut_back(0.25).unwrap().ends[1], Vector3::new(0.0, 0.0, 0.25));
        assert_eq!(tool.cut_back(1.0), None);
    }

    /// Along a link.
    const POINTS: usize = 2000;

    /// Distance of a point from a box, by its coordinates: outside by the part that sticks out.
    fn of_point(point: &Vector3<f64>, pose: &Pose, half: [f64; 3]) -> f64 {
        let at = pose.inverse_transform_point(&(*point).into());
        let out = Vector3::from_fn(|i, _| (at[i].abs() - half[i]).max(0.0));
        out.norm()
    }

    #[test]
    fn distances_to_boxes_discs_and_links_are_the_least_over_many_points() {
        let mut rng = fastrand::Rng::with_seed(11);
        let mut number = |size: f64| size * (rng.f64() - 0.5);
        let (mut outside, mut inside) = (0, 0);
        for _ in 0..500 {
            let mut vector = |size: f64| Vector3::from_fn(|_, _| number(size));
            let (link, other) = (
                Capsule { ends: [vector(3.0), vector(3.0)], radius: 0.1 },
                Capsule { ends: [vector(3.0), vector(3.0)], radius: 0.2 },
            );
            let pose = Pose::new(vector(2.0), vector(6.0));
            let half: [f64; 3] = vector(1.0).map(|x| x.abs() + 0.05).into();
            let along = |capsule: &Capsule, i: usize| {
                let part = i as f64 / POINTS as f64;
                capsule.ends[0] * (1.0 - part) + capsule.ends[1] * part
            };
            let points: Vec<Vector3<f64>> = (0..=POINTS).map(|i| along(&link, i)).collect();
            let step = (link.ends[1] - link.ends[0]).norm() / POINTS as f64;
            let least = |of: &dyn Fn(&Vector3<f64>) -> f64| points.iter().map(of).fold(f64::INFINITY, f64::min);
            let sampled = least(&|point| of_point(point, &pose, half));
            let found = link.apart_from_solid(&Solid::Box { pose, half }) + link.radius;
            if 1e-9 < sampled {
                outside += 1;
                assert!((-1e-6..=step).contains(&(sampled - found)), "{found} is not {sampled}");
            } else {
                inside += 1;
                assert!(found <= 1e-6, "{found} where a point lies inside");
            }
            let radius = half[0];
            let disc = Solid::Disc { pose, radius, half_thickness: half[2] };
            let sampled = least(&|point| {
                let at = pose.inverse_transform_point(&(*point).into());
                (at.x.hypot(at.y) - radius).max(0.0).hypot((at.z.abs() - half[2]).max(0.0))
            });
            let found = link.apart_from_solid(&disc) + link.radius;
            if 1e-9 < sampled {
                assert!((-1e-4..=step + 1e-4).contains(&(sampled - found)), "disc: {found} is not {sampled}");
            } else {
                assert!(found <= 1e-4, "disc: {found} where a point lies inside");
            }
            let line = |point: &Vector3<f64>| {
                let [from, to] = other.ends;
                let part = ((point - from).dot(&(to - from)) / (to - from).norm_squared()).clamp(0.0, 1.0);
                (point - from - (to - from) * part).norm()
            };
            let found = link.apart_from(&other) + link.radius + other.radius;
            assert!((-1e-9..=step).contains(&(least(&line) - found)), "{found}");
        }
        assert!(100 < outside && 25 < inside, "{outside} {inside}");
    }
}
