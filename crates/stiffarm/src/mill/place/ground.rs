//! Where may a path stand? Which places are tried, what of them is allowed, and over which places a bound is searched for.

use std::f64::consts::PI;

use nalgebra::{Point3, Vector3};

use super::PartPlacement;
use crate::batch::SpatialArm;
use crate::cell::{Block, Cell, Window};
use crate::interval::Interval;
use crate::place::{Margins, Within};
use crate::robot::Robot;
use crate::spatial::Pose;

/// Places of the coarse search along x, y and z and turns about the vertical: straight ahead, and in a cell.
const AHEAD: [usize; 4] = [18, 1, 14, 24];
const IN_CELL: [usize; 4] = [10, 10, 8, 16];
/// How exactly tips keep their window, m.
const SLACK: f64 = 1e-9;

/// Where a path may stand: the same as where [`place`](crate::place::place) may put a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathGround {
    /// What it keeps of the column and the floor, and whether it stands in front; margins of joints are those of the path's own options.
    pub margins: Margins,
    /// How far ahead of the joint-1 axis and how high above the base; its cell says so where `None`.
    pub within: Option<Within>,
    /// How the robot stands, and what else stands there. Its windows replace `within`.
    pub cell: Option<Cell>,
}

/// The middle of a path: x, y, z and the turn about the vertical, in the axes of a site.
pub(super) type Place = [f64; 4];

/// A site with its axes: z up, and straight ahead along x where the robot may be turned as one likes, else those of the cell.
pub(super) struct Site {
    cell_from_base: Pose,
    /// From the axes of the site.
    to_base: Pose,
    /// In base axes; none of it where windows say it.
    within: Within,
    windows: Vec<Window>,
    keep_out: Vec<Block>,
    /// What every tip keeps from the joint-1 axis, m.
    column: f64,
    reach: [Interval; 2],
    /// Some tip is this near to the middle of the path, seen from above, m.
    nearest: f64,
}

/// Places that are tried together, and how far they are apart.
pub(super) struct Coarse {
    pub(super) places: Vec<Place>,
    pub(super) apart: Place,
    /// How many along each.
    pub(super) counts: [usize; 4],
}

/// Places that are bounded together, and what holds of every tip there.
pub(super) struct Region {
    pub(super) ranges: [Interval; 4],
    /// Of its tips in the axes of the site.
    pub(super) block: Option<Block>,
}

impl Site {
    /// `None` where the margins leave nothing of the window.
    pub(super) fn new(robot: &Robot, arm: &SpatialArm, ground: &PathGround, nearest: f64) -> Option<Self> {
        let within = ground.margins.part_of(ground.within.unwrap_or(Within::ANYWHERE), robot)?;
        let cell = ground.cell.filter(Cell::decides_the_search);
        let cell_from_base = ground.cell.map_or_else(Pose::identity, |cell| cell.mount.cell_from_base);
        let hangs = ground.cell.is_some_and(|cell| cell.mount.uprightness() < 0.0);
        let upright = if hangs { Pose::rotation(Vector3::x() * PI) } else { Pose::identity() };
        let mut windows: Vec<Window> = cell.iter().flat_map(Cell::windows).collect();
        if cell.is_some() && windows.is_empty() {
            windows.push(Window::Block(Block { x: Interval::ALL, y: Interval::ALL, z: Interval::POSITIVE }));
        }
        Some(Self {
            cell_from_base,
            to_base: if cell.is_some() { cell_from_base.inverse() } else { upright },
            within,
            windows,
            keep_out: cell.iter().flat_map(Cell::keep_out).collect(),
            column: ground.margins.radius(robot),
            reach: arm.reach(),
            nearest,
        })
    }

    /// Places are counted about the joint-1 axis: any of them stands for all that are turned about it.
    fn is_turned_freely(&self) -> bool {
        self.windows.is_empty()
    }

    fn is_vertical(&self) -> bool {
        1.0 - (self.cell_from_base.rotation * Vector3::z()).z.abs() < 1e-12
    }

    /// The path with its middle at a place, as the cell counts it.
    pub(super) fn placement(&self, [x, y, z, yaw]: &Place, middle: &Vector3<f64>) -> PartPlacement {
        let site_from_part = Pose::translation(*x, *y, *z) * Pose::rotation(Vector3::z() * *yaw) * Pose::from(-*middle);
        if !self.is_turned_freely() {
            return PartPlacement { at: site_from_part.translation.into(), yaw: *yaw, base_from_cell: self.to_base };
        }
        // Upright, so that a turn about the vertical stays one.
        let cell_from_site = self.cell_from_base * self.to_base;
        let ahead = cell_from_site.rotation * Vector3::x();
        let at = (cell_from_site * site_from_part).translation.into();
        PartPlacement { at, yaw: yaw + ahead.y.atan2(ahead.x), base_from_cell: self.cell_from_base.inverse() }
    }

    /// Whether tips, m from the base, keep their window, the robot's column and what must be kept free; `ahead` is the way to their middle.
    pub(super) fn allows(&self, tips: impl Iterator<Item = Vector3<f64>>, middle: &Vector3<f64>) -> bool {
        let from_axis = middle.xy().norm();
        let ahead = if from_axis < SLACK { Vector3::x() } else { Vector3::new(middle.x, middle.y, 0.0) / from_axis };
        let mut holds = vec![true; self.windows.len()];
        let mut before: Option<Vector3<f64>> = None;
        for tip in tips {
            if tip.xy().norm() < self.column - SLACK {
                return false;
            }
            if self.is_turned_freely() {
                if !self.within.x.contains(tip.x, SLACK) || !self.within.z.contains(tip.z, SLACK) {
                    return false;
                }
                continue;
            }
            let at = self.to_base.inverse_transform_point(&tip.into()).coords;
            for (holds, window) in holds.iter_mut().zip(&self.windows) {
                *holds &= match window {
                    Window::Block(block) => block.holds(&at, &Vector3::zeros(), SLACK),
                    Window::Ring { ahead: range, z } => {
                        range.contains(tip.dot(&ahead), SLACK) && z.contains(at.z, SLACK)
                    }
                };
            }
            let from = before.replace(at).unwrap_or(at);
            if !holds.contains(&true) || self.keep_out.iter().any(|block| is_crossed(block, &from, &at)) {
                return false;
            }
        }
        true
    }

    /// Straight ahead: how far and how high the middle may stand. The bound looks nearer to the joint-1 axis than the search: about a middle
    /// there tips may keep clear of it.
    fn ahead(&self, nearest: f64) -> Option<[Interval; 4]> {
        let [ahead, up] = &self.reach;
        let x = self.within.x.intersect(Interval::spanning(nearest.min(ahead.max()), ahead.max()))?;
        let upwards = (self.to_base.rotation * Vector3::z()).z;
        let z = self.within.z.intersect(*up)?.affine(upwards, 0.0);
        Some([x, Interval::point(0.0), z, Interval::spanning(-PI, PI)])
    }

    /// The part of a block that an arm may reach, in the axes of the cell.
    fn reached(&self, block: &Block) -> Option<[Interval; 4]> {
        let [ahead, up] = &self.reach;
        let far = ahead.max().hypot(up.max().abs().max(up.min().abs()));
        let base = self.cell_from_base.translation.vector;
        let side = |i: usize| block.sides()[i].intersect(Interval::spanning(base[i] - far, base[i] + far));
        Some([side(0)?, side(1)?, side(2)?, Interval::spanning(-PI, PI)])
    }

    /// Places all over every window.
    pub(super) fn coarse(&self) -> Vec<Coarse> {
        if self.is_turned_freely() {
            return self.ahead(self.column).map(|ranges| grid(ranges, AHEAD)).into_iter().collect();
        }
        let of_window = |window: &Window| match window {
            Window::Block(block) => Some(grid(self.reached(block)?, IN_CELL)),
            Window::Ring { ahead, z } => self.ring(*ahead, *z),
        };
        self.windows.iter().filter_map(of_window).collect()
    }

    /// Places about the joint-1 axis of a base that stands or hangs.
    fn ring(&self, ahead: Interval, z: Interval) -> Option<Coarse> {
        let base = self.cell_from_base.translation.vector;
        let nearest = self.column.min(self.reach[0].max());
        let away = ahead.intersect(Interval::spanning(nearest, self.reach[0].max()))?;
        let up = (self.cell_from_base.rotation * Vector3::z()).z;
        let height = z.intersect(self.reach[1].affine(up, base.z))?;
        // Away, about, up and turned.
        let mut coarse = grid([away, Interval::spanning(-PI, PI), height, Interval::spanning(-PI, PI)], IN_CELL);
        for [x, y, ..] in &mut coarse.places {
            let (s, c) = y.sin_cos();
            [*x, *y] = [base.x + *x * c, base.y + *x * s];
        }
        coarse.apart[1] = coarse.apart[0];
        Some(coarse)
    }

    /// Regions that hold every place that is allowed, and in which axes they count. Of a base that stands or hangs those about the joint-1 axis,
    /// straight ahead: turned about it a place has the same errors but for the limits of joint 1.
    pub(super) fn regions(&self) -> (Pose, Vec<Region>) {
        if !self.is_vertical() {
            let whole = |window: &Window| match window {
                Window::Block(block) => Some(Region { ranges: self.reached(block)?, block: Some(*block) }),
                // Rings are about axes that are upright.
                Window::Ring { .. } => None,
            };
            return (self.to_base, self.windows.iter().filter_map(whole).collect());
        }
        // Every tip keeps the column, so the middle keeps what the tip that is nearest to it leaves.
        let nearest = (self.column - self.nearest).max(0.0);
        let upwards = if (self.cell_from_base.rotation * Vector3::z()).z < 0.0 { PI } else { 0.0 };
        let upright = Pose::rotation(Vector3::x() * upwards);
        let region = |ranges| Region { ranges, block: None };
        if self.is_turned_freely() {
            return (upright, self.ahead(nearest).map(region).into_iter().collect());
        }
        let [away, height] = self.around();
        let [reach, up] = &self.reach;
        let x = away.intersect(Interval::spanning(nearest.min(reach.max()), reach.max()));
        let z = height.intersect(*up).map(|z| z.affine(upwards.cos(), 0.0));
        let ranges = x.zip(z).map(|(x, z)| [x, Interval::point(0.0), z, Interval::spanning(-PI, PI)]);
        (upright, ranges.map(region).into_iter().collect())
    }

    /// How far from the joint-1 axis the middle may stand, and how high above the base, along that axis, every tip.
    fn around(&self) -> [Interval; 2] {
        let mut cell =
            Cell::of(crate::cell::Mount { kind: crate::cell::MountKind::Pose, cell_from_base: self.cell_from_base });
        cell.windows.iter_mut().zip(&self.windows).for_each(|(place, window)| *place = Some(*window));
        cell.around().unwrap_or([Interval::ALL; 2])
    }

    /// What holds of every tip of a place about the joint-1 axis: x and z from the base, and the distance from that axis.
    pub(super) fn of_tips(&self) -> [Interval; 3] {
        let column = |nearest: f64| Interval::spanning(self.column.max(nearest), f64::INFINITY);
        if self.is_turned_freely() {
            return [self.within.x, self.within.z, column(0.0)];
        }
        if !self.is_vertical() {
            return [Interval::ALL, Interval::ALL, column(0.0)];
        }
        let [away, height] = self.around();
        let blocks = self.windows.iter().filter(|window| matches!(window, Window::Block(_))).count();
        if blocks == 0 {
            // Rings say how far ahead, in the direction of the middle.
            return [away, height, column(0.0)];
        }
        if blocks < self.windows.len() {
            return [Interval::ALL, height, column(0.0)];
        }
        let nearest = self.column.max(away.min()).min(away.max());
        [Interval::ALL, height, Interval::spanning(nearest, away.max())]
    }
}

/// Places in the middles of equal parts of every range.
fn grid(ranges: [Interval; 4], counts: [usize; 4]) -> Coarse {
    let at = |i: usize, n: usize| ranges[i].min() + ranges[i].width() * (n as f64 + 0.5) / counts[i] as f64;
    let [nx, ny, nz, nyaw] = counts;
    let places = (0..nx)
        .flat_map(|a| (0..ny).flat_map(move |b| (0..nz).flat_map(move |c| (0..nyaw).map(move |d| [a, b, c, d]))));
    let places = places.map(|n| std::array::from_fn(|i| at(i, n[i]))).collect();
    Coarse { places, apart: std::array::from_fn(|i| ranges[i].width() / counts[i] as f64), counts }
}

/// Whether a straight way goes through a block, or begins or ends in it.
fn is_crossed(block: &Block, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (i, side) in block.sides().into_iter().enumerate() {
        let way = to[i] - from[i];
        if way == 0.0 {
            if from[i] <= side.min() || side.max() <= from[i] {
                return false;
            }
            continue;
        }
        let [one, other] = [side.min(), side.max()].map(|end| (end - from[i]) / way);
        first = first.max(one.min(other));
        last = last.min(one.max(other));
    }
    first < last
}

impl PartPlacement {
    /// The turn about the vertical from straight ahead of the robot, rad, counter-clockwise seen from above; `None` of a base that leans.
    pub fn yaw_from_ahead(&self) -> Option<f64> {
        let cell_from_base = self.base_from_cell.inverse();
        let ahead = cell_from_base.rotation * Vector3::x();
        let is_level = (cell_from_base.rotation * Vector3::z()).z.abs() > 1.0 - 1e-12;
        is_level.then(|| {
            let yaw = self.yaw - ahead.y.atan2(ahead.x);
            if ahead.y == 0.0 && 0.0 < ahead.x { self.yaw } else { crate::angle::wrapped(yaw) }
        })
    }

    /// Where the path's origin stands, m from the base.
    pub fn at_from_base(&self) -> [f64; 3] {
        (self.base_from_cell * Point3::from(self.at)).coords.into()
    }
}
