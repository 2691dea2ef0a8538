//! Where does the work lie, and how does the tool stand on it?

use nalgebra::{Matrix2, Matrix3, Rotation3, Vector2, Vector3};

use crate::load::{Forces, Load};
use crate::root::root;
use crate::spatial::Pose;
use crate::task::Zone;

/// Where the work lies and how the tool is turned; lengths in m from the base, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkPlacement {
    /// Of the zone's centre, straight ahead.
    pub x: f64,
    /// Of the zone's centre, to the left; zero but for the faces of a part.
    pub y: f64,
    /// Of the zone's centre, upwards.
    pub z: f64,
    /// Of the work plane about the vertical.
    pub yaw: f64,
    /// Of the zone's first side in the plane.
    pub angle: f64,
    /// Of the tool about its axis.
    pub roll: f64,
}

/// The plane of a zone, which the tool axis meets at a right angle; base axes.
#[derive(Clone, Copy, Debug)]
pub struct WorkPlane {
    /// Along the zone's first side, length one.
    pub first: Vector3<f64>,
    /// Along its second side.
    pub second: Vector3<f64>,
    /// The tool's axes, as columns.
    tool: Matrix3<f64>,
}

impl WorkPlane {
    /// With a tool axis that rises by `elevation`, rad, above the horizontal.
    ///
    /// Angle, roll and feed count from what points most upwards in the plane: straight ahead where the tool points down, straight back where it
    /// points up, between them without a jump.
    pub fn of(elevation: f64, work: &WorkPlacement) -> Self {
        let (se, ce) = elevation.sin_cos();
        let (sy, cy) = work.yaw.sin_cos();
        let about = |ahead: f64, left: f64, up: f64| Vector3::new(cy * ahead - sy * left, sy * ahead + cy * left, up);
        let (upwards, left, axis) = (about(-se, 0.0, ce), about(0.0, 1.0, 0.0), about(ce, 0.0, se));
        let (sa, ca) = work.angle.sin_cos();
        let (sr, cr) = work.roll.sin_cos();
        // The tool's x axis at roll zero points as `upwards`; its y completes the frame.
        let (x, y) = (upwards, axis.cross(&upwards));
        Self {
            first: upwards * ca + left * sa,
            second: left * ca - upwards * sa,
            tool: Matrix3::from_columns(&[x * cr + y * sr, y * cr - x * sr, axis]),
        }
    }

    /// The tool's axes in those of the base.
    pub fn tool(&self) -> &Matrix3<f64> {
        &self.tool
    }

    /// Which way the first side points, base axes.
    pub fn first_side(&self) -> &Vector3<f64> {
        &self.first
    }

    /// The forces that may act at its points, base axes; any where `None`.
    pub(crate) fn forces(&self, load: Load) -> Option<Forces> {
        self.forces_at(load, 0.0)
    }

    /// The same, where it is turned about the joint-1 axis by a bearing, rad.
    pub(crate) fn forces_at(&self, load: Load, bearing: f64) -> Option<Forces> {
        let away = -self.tool.column(2);
        let turned = *Rotation3::from_axis_angle(&Vector3::z_axis(), bearing).matrix();
        (!load.is_worst()).then(|| load.forces(&(turned * Matrix3::from_columns(&[self.first, self.second, away]))))
    }

    /// A point of the plane, m from the zone's centre along its sides; base axes.
    pub fn point(&self, work: &WorkPlacement, [u, v]: [f64; 2]) -> Vector3<f64> {
        Vector3::new(work.x, work.y, work.z) + self.first * u + self.second * v
    }

    /// How far the zone extends from its centre along the base axes, m.
    pub fn half_extents(&self, zone: Zone) -> [f64; 3] {
        let [first, second] = zone.sides().map(|side| side / 2.0);
        std::array::from_fn(|axis| {
            let (a, b) = (first * self.first[axis], second * self.second[axis]);
            match zone {
                Zone::Circle { .. } => a.hypot(b),
                Zone::Rectangle { .. } => a.abs() + b.abs(),
            }
        })
    }

    /// Distance of the zone's nearest point from the joint-1 axis, m; zero where the axis passes through it.
    pub fn distance_from_axis_1(&self, work: &WorkPlacement, zone: Zone) -> f64 {
        let centre = Vector2::new(work.x, work.y);
        let [first, second] = zone.sides().map(|side| side / 2.0);
        let sides = Matrix2::from_columns(&[self.first.xy() * first, self.second.xy() * second]);
        match zone {
            Zone::Circle { .. } => nearest_of_ellipse(centre, &sides),
            Zone::Rectangle { .. } => nearest_of_parallelogram(centre, &sides),
        }
    }

    /// The pose of the tool at that point.
    pub fn pose(&self, work: &WorkPlacement, at: [f64; 2]) -> Pose {
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(self.tool);
        Pose::from_parts(self.point(work, at).into(), rotation.into())
    }
}

/// The least `|centre + sides u|` for `|u| <= 1`.
///
/// Outside the ellipse the best `u` has length one, and `(S^T S + m) u = -S^T c` with a multiplier `m > 0`, at which the length of `u` falls.
fn nearest_of_ellipse(centre: Vector2<f64>, sides: &Matrix2<f64>) -> f64 {
    let (square, towards) = (sides.transpose() * sides, -(sides.transpose() * centre));
    let at = |multiplier: f64| {
        let shifted = square + Matrix2::identity() * multiplier;
        shifted.try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * towards)
    };
    // At the largest multiplier `u` is shorter than one; at the least, where the axis passes through the ellipse, too.
    let (least, most) = (1e-12 * square.trace(), towards.norm().max(1e-12 * square.trace()));
    let short = |multiplier: f64| 1.0 - at(multiplier).norm();
    let multiplier = if 0.0 <= short(least) { least } else { root(least, most, short) };
    let nearest = (centre + sides * at(multiplier)).norm();
    if multiplier == least && nearest < 1e-9 * centre.norm() { 0.0 } else { nearest }
}

/// The same for `u` in the square `-1..1`.
fn nearest_of_parallelogram(centre: Vector2<f64>, sides: &Matrix2<f64>) -> f64 {
    let inside = sides.try_inverse().map(|inverse| inverse * -centre);
    if inside.is_some_and(|u| u.amax() <= 1.0) {
        return 0.0;
    }
    let corners =
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(u, v)| centre + sides * Vector2::new(u, v));
    let from_edge = |i: usize| {
        let (start, along) = (corners[i], corners[(i + 1) % 4] - corners[i]);
        let part = (-start.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (start + along * part).norm()
    };
    (0..4).map(from_edge).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// Against the nearest of many points, however the plane leans and the zone is turned.
    #[test]
    fn the_nearest_point_of_a_zone_is_the_nearest_of_all_its_points() {
        let mut rng = fastrand::Rng::with_seed(61);
        let (mut through, mut beside) = (0, 0);
        for case in 0..300 {
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let elevation = [-FRAC_PI_2, 0.0, part(-1.5, 1.5)][case % 3];
            let work = WorkPlacement {
                x: part(-0.6, 1.0),
                y: part(-0.3, 0.3),
                z: 0.5,
                yaw: part(-2.0, 2.0),
                angle: part(0.0, 3.0),
                roll: 0.0,
            };
            let (width, height) = (part(0.1, 0.8), part(0.1, 0.8));
            let zone = if case % 2 == 0 { Zone::Circle { diameter: width } } else { Zone::Rectangle { width, height } };
            let plane = WorkPlane::of(elevation, &work);
            let side = |i: i32| f64::from(i) / 60.0 - 1.0;
            let points = (0..=120).flat_map(|i| (0..=120).map(move |j| zone.at([side(i), side(j)])));
            let distance = |at: [f64; 2]| plane.point(&work, at).xy().norm();
            let expected = points.map(distance).fold(f64::INFINITY, f64::min);
            let found = plane.distance_from_axis_1(&work, zone);
            assert!(
                found <= expected + 1e-9 && expected <= found + 0.015,
                "{case}: {found} {expected} {work:?} {zone:?}"
            );
            through += usize::from(found == 0.0);
            beside += usize::from(0.1 < found);
        }
        assert!(20 < through && 100 < beside, "{through} {beside}");
        // By hand: a disc of radius 0.2 on a table, its centre 0.5 m ahead.
        let work = WorkPlacement { x: 0.5, y: 0.0, z: 0.0, yaw: 0.0, angle: 0.0, roll: 0.0 };
        let table = WorkPlane::of(-FRAC_PI_2, &work);
        assert!((table.distance_from_axis_1(&work, Zone::Circle { diameter: 0.4 }) - 0.3).abs() < 1e-9);
        assert!((table.distance_from_axis_1(&work, Zone::Rectangle { width: 0.4, height: 2.0 }) - 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_table_a_wall_and_the_tool_stand_as_people_draw_them() {
        let work = WorkPlacement { x: 1.5, y: 0.0, z: 0.8, yaw: 0.0, angle: 0.0, roll: 0.0 };
        let close = |a: Vector3<f64>, b: [f64; 3]| assert!((a - Vector3::from(b)).norm() < 1e-12, "{a} is not {b:?}");
        let table = WorkPlane::of(-FRAC_PI_2, &work);
        close(table.point(&work, [0.1, 0.2]), [1.6, 0.2, 0.8]);
        close(table.tool().column(2).into(), [0.0, 0.0, -1.0]);
        close(table.tool().column(0).into(), [1.0, 0.0, 0.0]);
        let wall = WorkPlane::of(0.0, &work);
        close(wall.point(&work, [0.1, 0.2]), [1.5, 0.2, 0.9]);
        close(wall.tool().column(2).into(), [1.0, 0.0, 0.0]);
        let aside = WorkPlacement { yaw: FRAC_PI_2, roll: FRAC_PI_2, ..work };
        let wall = WorkPlane::of(0.0, &aside);
        close(wall.point(&aside, [0.0, 0.2]), [1.3, 0.0, 0.8]);
        close(wall.tool().column(2).into(), [0.0, 1.0, 0.0]);
        close(wall.tool().column(0).into(), [1.0, 0.0, 0.0]);
        assert!((wall.tool().determinant() - 1.0).abs() < 1e-12);
    }
}
