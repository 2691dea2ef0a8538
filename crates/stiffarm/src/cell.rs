//! Where does the robot stand, where may the work stand, and what must be kept free?

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::interval::Interval;
use crate::spatial::Pose;

/// So many windows, and so many boxes that are kept free, a cell has at most.
pub const MOST_BLOCKS: usize = 8;
/// A direction that rises by less than this part of its length is level.
const LEVEL: f64 = 1e-9;
/// What is open ends here, m: farther than any arm reaches.
const FAR: f64 = 60.0;

/// A box with its sides along the axes of the cell, m; sides may be open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Forwards.
    pub x: Interval,
    /// To the left.
    pub y: Interval,
    /// Upwards from the cell's floor.
    pub z: Interval,
}

/// Where work may stand, m: all of it inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Window {
    /// In the axes of the cell.
    Block(Block),
    /// Anywhere about a robot that stands upright or hangs upright, so far ahead of its joint-1 axis and so high above the cell's floor.
    Ring {
        /// In the direction in which the work lies.
        ahead: Interval,
        /// Upwards from the cell's floor.
        z: Interval,
    },
}

/// How the robot's base is mounted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MountKind {
    /// On the floor, or so high above it.
    Pedestal,
    /// On a wall: the joint-1 axis is level, and the robot's x axis points down.
    Wall,
    /// Hanging: the joint-1 axis points down.
    Ceiling,
    /// As a pose says.
    Pose,
}

/// Where the robot's base stands in the cell: z is up, the floor is z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    /// What it is fixed to.
    pub kind: MountKind,
    /// The base in the axes of the cell.
    pub cell_from_base: Pose,
}

/// What is known of the place where a robot works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// How the robot stands in it.
    pub mount: Mount,
    /// Where work may stand: in any of them; anywhere where there are none.
    pub windows: [Option<Window>; MOST_BLOCKS],
    /// What neither work nor arm may touch.
    pub keep_out: [Option<Block>; MOST_BLOCKS],
    /// The direction of the tool axis about the joint-1 axis, rad in base axes, where the mount decides it.
    pub azimuth: Option<f64>,
    /// The arm keeps this distance, m, from everything, where it is asked.
    pub clearance: Option<f64>,
    /// Work stands straight ahead of the robot, or straight behind it, and nowhere else about its vertical joint-1 axis.
    pub is_ahead: bool,
}

impl Block {
    /// All of an upright box about a centre lies in it, up to `slack`.
    pub(crate) fn holds(&self, centre: &Vector3<f64>, half: &Vector3<f64>, slack: f64) -> bool {
        self.sides()
            .into_iter()
            .enumerate()
            .all(|(i, side)| side.contains(centre[i] - half[i], slack) && side.contains(centre[i] + half[i], slack))
    }

    /// The upright box about a centre reaches into it.
    pub(crate) fn touches(&self, centre: &Vector3<f64>, half: &Vector3<f64>) -> bool {
        self.sides()
            .into_iter()
            .enumerate()
            .all(|(i, side)| side.min() < centre[i] + half[i] && centre[i] - half[i] < side.max())
    }

    /// Forwards, to the left, upwards.
    pub(crate) fn sides(&self) -> [Interval; 3] {
        [self.x, self.y, self.z]
    }

    /// Its middle and half its sides, in the axes of the cell, what is open cut off about a point.
    pub(crate) fn near(&self, about: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let sides = self.sides();
        let end = |i: usize, end: f64| end.clamp(about[i] - FAR, about[i] + FAR);
        let ends = |i: usize| [end(i, sides[i].min()), end(i, sides[i].max())];
        [
            Vector3::from_fn(|i, _| f64::midpoint(ends(i)[0], ends(i)[1])),
            Vector3::from_fn(|i, _| (ends(i)[1] - ends(i)[0]) / 2.0),
        ]
    }
}

impl Mount {
    /// Upright, so high above the floor, m.
    pub fn pedestal(height: f64) -> Self {
        Self { kind: MountKind::Pedestal, cell_from_base: Pose::translation(0.0, 0.0, height) }
    }

    /// On a wall whose normal is the cell's x axis; the joint-1 axis leaves it so high above the floor, m.
    pub fn wall(height: f64) -> Self {
        let turned = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2);
        let cell_from_base = Pose::from_parts(Vector3::new(0.0, 0.0, height).into(), turned);
        Self { kind: MountKind::Wall, cell_from_base }
    }

    /// Upside down, the base so high above the floor, m; forwards stays forwards.
    pub fn ceiling(height: f64) -> Self {
        let turned = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI);
        let cell_from_base = Pose::from_parts(Vector3::new(0.0, 0.0, height).into(), turned);
        Self { kind: MountKind::Ceiling, cell_from_base }
    }

    /// The same, turned to the left about the vertical, rad.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        Self { cell_from_base: Pose::rotation(Vector3::z() * angle) * self.cell_from_base, ..self }
    }

    /// The cosine between the joint-1 axis and the vertical: 1 upright, -1 hanging.
    pub fn uprightness(&self) -> f64 {
        (self.cell_from_base.rotation * Vector3::z()).z
    }

    /// The joint-1 axis is vertical: turning about it changes nothing but where things stand in the cell.
    pub fn is_vertical(&self) -> bool {
        1.0 - self.uprightness().abs() < 1e-12
    }

    /// The base stands as on a floor, so high above it, m; `None` of walls, ceilings and whatever leans.
    pub fn raised(&self) -> Option<f64> {
        (self.is_vertical() && 0.0 < self.uprightness()).then_some(self.cell_from_base.translation.z)
    }

    /// What is so high above the floor, as heights above a base with a vertical axis.
    pub fn heights_from_base(&self, z: Interval) -> Interval {
        let up = self.uprightness().signum();
        z.affine(up, -up * self.cell_from_base.translation.z)
    }
}

impl Cell {
    /// A robot on the floor, and nothing about it.
    pub fn of(mount: Mount) -> Self {
        Self {
            mount,
            windows: [None; MOST_BLOCKS],
            keep_out: [None; MOST_BLOCKS],
            azimuth: None,
            clearance: None,
            is_ahead: false,
        }
    }

    /// The same seen from a base that is turned to the left about its joint-1 axis, rad.
    #[must_use]
    pub(crate) fn with_base_turned(self, angle: f64) -> Self {
        let cell_from_base = self.mount.cell_from_base * Pose::rotation(Vector3::z() * angle);
        Self {
            mount: Mount { cell_from_base, ..self.mount },
            azimuth: self.azimuth.map(|azimuth| azimuth - angle),
            ..self
        }
    }

    /// The windows there are.
    pub fn windows(&self) -> impl Iterator<Item = Window> + '_ {
        self.windows.iter().flatten().copied()
    }

    /// The boxes that must be kept free.
    pub fn keep_out(&self) -> impl Iterator<Item = Block> + '_ {
        self.keep_out.iter().flatten().copied()
    }

    /// Where work lies about the robot matters, or how the arm comes to it: a search must look at both.
    pub fn decides_the_search(&self) -> bool {
        let asked = self.azimuth.is_some() || self.clearance.is_some();
        asked || self.windows().next().is_some() || self.keep_out().next().is_some()
    }

    /// Where the half plane from the joint-1 axis at a bearing, rad in base axes, crosses a block: away from that axis and along it, m from the
    /// base. `None` where it passes it by, or, of a base that leans, where what it cuts out is no upright rectangle.
    pub fn crossing(&self, block: &Block, bearing: f64) -> Option<[Interval; 2]> {
        let Pose { rotation, translation } = self.mount.cell_from_base;
        let away = rotation * Vector3::new(bearing.cos(), bearing.sin(), 0.0);
        let along = rotation * Vector3::z();
        let mut crossed = [Interval::new(0.0, f64::INFINITY)?, Interval::ALL];
        for (i, side) in block.sides().into_iter().enumerate() {
            let at = translation.vector[i];
            match [away[i], along[i]].map(|part| LEVEL < part.abs()) {
                [false, false] if side.contains(at, 0.0) => {}
                [true, true] | [false, false] => return None,
                [moves_away, _] => {
                    let (which, part) = if moves_away { (0, away[i]) } else { (1, along[i]) };
                    crossed[which] = crossed[which].intersect(side.affine(1.0 / part, -at / part))?;
                }
            }
        }
        Some(crossed)
    }

    /// How far from the joint-1 axis (of a ring ahead of it, and negative behind it) and how high above the base, along it, a point of a window
    /// may lie, m: a box about all windows; `None` where there are no windows.
    pub(crate) fn around(&self) -> Option<[Interval; 2]> {
        let parts: Vec<[Interval; 2]> = self.windows().map(|window| self.around_one(&window)).collect();
        let hull = |i: usize| {
            let ends = parts.iter().flat_map(|part| [part[i].min(), part[i].max()]);
            let low = ends.clone().fold(f64::INFINITY, f64::min);
            Interval::new(low, ends.fold(f64::NEG_INFINITY, f64::max))
        };
        Some([hull(0)?, hull(1)?])
    }

    fn around_one(&self, window: &Window) -> [Interval; 2] {
        match window {
            Window::Ring { ahead, z } => [*ahead, self.mount.heights_from_base(*z)],
            Window::Block(block) => {
                let from_base = self.mount.cell_from_base.inverse();
                let [middle, half] = block.near(&self.mount.cell_from_base.translation.vector);
                let corners = (0..8).map(|i| {
                    let side = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
                    from_base * Point3::from(middle + half.component_mul(&Vector3::new(side(0), side(1), side(2))))
                });
                let corners: Vec<Point3<f64>> = corners.collect();
                let range = |i: usize| {
                    let low = corners.iter().map(|corner| corner[i]).fold(f64::INFINITY, f64::min);
                    Interval::spanning(low, corners.iter().map(|corner| corner[i]).fold(f64::NEG_INFINITY, f64::max))
                };
                let far = corners.iter().map(|corner| corner.x.hypot(corner.y)).fold(0.0, f64::max);
                // The upright box about the corners holds the window, so nothing of it is nearer.
                let near = range(0).clamp(0.0).hypot(range(1).clamp(0.0));
                [Interval::spanning(near, far), range(2)]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> Block {
        let side = |[low, high]: [f64; 2]| Interval::spanning(low, high);
        Block { x: side(x), y: side(y), z: side(z) }
    }

    #[test]
    fn mounts_stand_as_people_draw_them() {
        let at = |mount: &Mount, point: [f64; 3]| mount.cell_from_base * Point3::from(point);
        let close = |a: Point3<f64>, b: [f64; 3]| assert!((a - Point3::from(b)).norm() < 1e-12, "{a} is not {b:?}");
        close(at(&Mount::pedestal(0.5), [1.0, 0.2, 0.3]), [1.0, 0.2, 0.8]);
        // On a wall the arm's upwards is away from the wall, and its forwards is down.
        close(at(&Mount::wall(2.0), [0.4, 0.2, 0.3]), [0.3, 0.2, 1.6]);
        close(at(&Mount::ceiling(3.0), [1.0, 0.2, 0.3]), [1.0, -0.2, 2.7]);
        close(at(&Mount::pedestal(0.5).turned(FRAC_PI_2), [1.0, 0.0, 0.0]), [0.0, 1.0, 0.5]);
        assert!(Mount::ceiling(3.0).is_vertical() && !Mount::wall(1.0).is_vertical());
        let heights = Mount::ceiling(3.0).heights_from_base(Interval::spanning(0.5, 1.0));
        assert!((heights.min() - 2.0).abs() < 1e-12 && (heights.max() - 2.5).abs() < 1e-12, "{heights:?}");
    }

    /// By hand: straight ahead, at 45 degrees, and of a wall, whose robot's upwards is the cell's x, and its ahead down.
    #[test]
    fn a_half_plane_from_the_joint_1_axis_crosses_a_block_where_a_drawing_says() {
        let box_ = block([1.0, 3.0], [-1.0, 4.0], [0.8, 1.0]);
        let close = |found: Option<[Interval; 2]>, expected: [f64; 4]| {
            let [r, z] = found.unwrap();
            let found = [r.min(), r.max(), z.min(), z.max()];
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
        };
        let pedestal = Cell::of(Mount::pedestal(0.5));
        close(pedestal.crossing(&box_, 0.0), [1.0, 3.0, 0.3, 0.5]);
        let root = 2_f64.sqrt();
        close(pedestal.crossing(&box_, PI / 4.0), [root, 3.0 * root, 0.3, 0.5]);
        // To the right the y side ends at 1 m, where x is no more than 1 m: at 45 degrees it touches a corner, at 80 it passes by.
        assert_eq!(pedestal.crossing(&box_, -80_f64.to_radians()), None);
        assert_eq!(pedestal.crossing(&box_, PI), None);
        close(Cell::of(Mount::wall(2.0)).crossing(&box_, 0.0), [1.0, 1.2, 1.0, 3.0]);
        let leaning = Mount { kind: MountKind::Pose, cell_from_base: Pose::rotation(Vector3::y() * 0.3) };
        assert_eq!(Cell::of(leaning).crossing(&box_, 0.0), None);
    }

    #[test]
    fn a_window_is_so_far_from_the_joint_1_axis_as_its_nearest_and_farthest_corner() {
        let with = |mount: Mount, window: Block| {
            let mut cell = Cell::of(mount);
            cell.windows[0] = Some(Window::Block(window));
            cell.around().unwrap()
        };
        let [r, z] = with(Mount::pedestal(0.5), block([1.0, 3.0], [-1.0, 4.0], [0.8, 1.0]));
        assert!((r.min() - 1.0).abs() < 1e-12 && (r.max() - 5.0).abs() < 1e-12, "{r:?}");
        assert!((z.min() - 0.3).abs() < 1e-12 && (z.max() - 0.5).abs() < 1e-12, "{z:?}");
        // The joint-1 axis of a wall runs along x at a height of 2 m: 3 m sideways and 4 m of height are 5 m.
        let [r, z] = with(Mount::wall(2.0), block([0.5, 0.7], [0.0, 3.0], [2.0, 6.0]));
        assert!(r.min().abs() < 1e-12 && (r.max() - 5.0).abs() < 1e-12, "{r:?}");
        assert!((z.min() - 0.5).abs() < 1e-12 && (z.max() - 0.7).abs() < 1e-12, "{z:?}");
    }
}
