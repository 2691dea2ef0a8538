//! How near does the arm come to the floor, to what stands about it, to the work and to itself? Links are capsules: those that enclose them, where
//! the robot file has such, else those along the lines of the arm with the radii that it states. Where it states none these are slim: what they touch
//! counts as touched. Beside them stand wide ones, inside of which nine known arms in ten lie: what those keep clear of, nine arms in ten do.

mod links;
mod mesh;
mod misplaced;
mod nearest;
mod solid;
mod stock;
mod thick;

use std::fmt;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::cell::{Cell, MountKind};
use crate::cutting::Shank;
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::stock::Remains;
pub use mesh::Mesh;
pub use misplaced::Misplaced;
pub(crate) use nearest::Looked;
pub(crate) use solid::Solid;
pub(crate) use thick::ThickArm;

/// A part of the arm that may touch something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// About the joint-1 axis, and out to the joint-2 axis.
    Column,
    /// Joint-2 axis to elbow.
    UpperArm,
    /// Elbow to wrist centre.
    Forearm,
    /// Wrist centre to flange.
    Wrist,
    /// Flange to tool point.
    Tool,
    /// What of the tool stands out of its spindle.
    Cutter,
    /// What of that holds the teeth.
    Shank,
}

/// What a link may touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The floor.
    Floor,
    /// The wall or ceiling on which the robot is mounted.
    Mounting,
    /// What is machined.
    Work,
    /// The part as its mesh has it.
    Part,
    /// What is left of the block from which the part is cut.
    Stock,
    /// What holds the part.
    Fixture,
    /// A box that was asked to be kept free, by its number from 1.
    KeepOut(usize),
    /// Another link.
    Link(Link),
}

/// The nearest that any link comes to anything in one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// How far, m; less than 0 where they overlap, by so much.
    pub distance: f64,
    /// Which link.
    pub link: Link,
    /// To what.
    pub to: Obstacle,
}

/// By what it is known where the links are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinksBy {
    /// Capsules of the robot file enclose them.
    Enclosing,
    /// The robot file states how thick they are.
    Stated,
    /// Nobody says it.
    Estimated,
}

/// The nearest that any link comes to anything, over all poses that were looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// m; negative where they overlap.
    pub distance: f64,
    /// Which link.
    pub link: Link,
    /// To what.
    pub to: Obstacle,
    /// A radius in it is estimated.
    pub is_estimated: bool,
    /// How its links are known; the tool is another matter.
    pub links: LinksBy,
    /// By how much the links in it may stand out of their estimates, m, as those of nine arms in ten do at most; 0 where nothing of the arm in it
    /// is estimated.
    pub outside: f64,
    /// The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm; `None` where the bodies are known.
    pub wide: Option<Near>,
    /// The tool is among the links.
    pub knows_tool: bool,
    /// How many poses were looked at.
    pub poses: usize,
}

impl Clearance {
    /// They overlap by more than rounding.
    pub fn overlaps(&self) -> bool {
        /// m.
        const ROUNDING: f64 = 1e-9;
        self.distance < -ROUNDING
    }

    /// They overlap, and the whole arm is known: in the arm plane the forearm ends where wrist and tool would begin.
    pub fn is_collision(&self) -> bool {
        self.knows_tool && self.overlaps()
    }

    /// They overlap in a model that has neither wrist nor tool: with these the arm may stand clear.
    pub fn may_collide(&self) -> bool {
        !self.knows_tool && self.overlaps()
    }
}

/// What stands about a robot, in the axes of its base.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surroundings {
    /// A point of the floor and the unit normal that leads away from it; `None` where there is none.
    pub(crate) floor: Option<[Vector3<f64>; 2]>,
    /// The same of the wall or ceiling that carries the base.
    pub(crate) mounting: Option<[Vector3<f64>; 2]>,
    /// So far the column reaches down below the base, m.
    pub(crate) pedestal: f64,
    /// What is machined.
    pub(crate) work: Option<Solid>,
    /// Boxes that must be kept free.
    pub(crate) keep_out: Vec<Solid>,
    /// What is machined, where its body is known.
    pub(crate) machined: Option<Machined>,
}

/// What is machined, and how far from it the spindle ends.
#[derive(Clone, Debug)]
pub(crate) struct Machined {
    pub(crate) pose: Pose,
    /// As it is when it is done.
    pub(crate) part: Option<Mesh>,
    /// The block from which it is cut.
    pub(crate) stock: Option<Arc<Remains>>,
    /// What holds it: the cutter, too, keeps clear of that.
    pub(crate) fixture: Option<Mesh>,
    /// `None` where that is not known, and the tool is not compared with it.
    pub(crate) cutter: Option<Cutter>,
}

/// What of a tool stands out of the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// Down to the tip, m.
    pub length: f64,
    /// m; 0 where it is not known, and its axis alone is compared.
    pub radius: f64,
    /// What holds the teeth, where that is known. One that is thicker than the cutter touches what the spindle may not.
    pub shank: Option<Shank>,
}

impl Cutter {
    /// The largest, m.
    pub(crate) fn widest(&self) -> f64 {
        self.thick_shank().map_or(self.radius, |shank| shank.diameter / 2.0)
    }

    /// Where it is thicker than the cutter, whose slot it would not pass.
    fn thick_shank(&self) -> Option<Shank> {
        self.shank.filter(|shank| self.radius < shank.diameter / 2.0 && shank.flute < self.length)
    }
}

impl Surroundings {
    /// Nothing but a floor, so high above the base, m; not even that where `None`.
    pub(crate) fn above(floor: Option<f64>) -> Self {
        Self { floor: floor.map(|height| [Vector3::new(0.0, 0.0, height), Vector3::z()]), ..Self::default() }
    }

    /// What a cell says; only a floor, so high above the base, m, where there is no cell.
    pub(crate) fn of(cell: Option<&Cell>, floor: Option<f64>) -> Self {
        let Some(cell) = cell else { return Self::above(floor) };
        let (mount, base_from_cell) = (cell.mount, cell.mount.cell_from_base.inverse());
        let base = mount.cell_from_base.translation.vector;
        let solid = |block: crate::cell::Block| {
            let [middle, half] = block.near(&base);
            Solid::Box { pose: base_from_cell * Pose::translation(middle.x, middle.y, middle.z), half: half.into() }
        };
        let carries = matches!(mount.kind, MountKind::Wall | MountKind::Ceiling);
        Self {
            floor: Some([base_from_cell.translation.vector, base_from_cell.rotation * Vector3::z()]),
            mounting: carries.then(|| [Vector3::zeros(), Vector3::z()]),
            pedestal: if mount.kind == MountKind::Pedestal { base.z.max(0.0) } else { 0.0 },
            work: None,
            machined: None,
            keep_out: cell.keep_out().map(solid).collect(),
        }
    }
}

/// The keep-outs of a cell in or on which the base of a robot stands, by their numbers from 1. No joint moves it: they are taken as what carries the
/// robot, and keep clear of the rest of the arm alone.
pub fn carrying(robot: &Robot, cell: &Cell) -> Vec<usize> {
    let thick = ThickArm::new(robot, &Pose::identity(), None);
    thick.map_or_else(Vec::new, |thick| thick.stands_in(&Surroundings::of(Some(cell), None)))
}

impl Clearance {
    /// Without how well that is known.
    pub(crate) fn near(&self) -> Near {
        Near { distance: self.distance, link: self.link, to: self.to }
    }

    /// The nearer one of two, and of both the nearest that is wide.
    pub(crate) fn and(self, other: Self) -> Self {
        let wide = [self.wide, other.wide].into_iter().flatten().min_by(|a, b| a.distance.total_cmp(&b.distance));
        Self { wide, ..if other.distance < self.distance { other } else { self } }
    }
}

impl Link {
    /// As answers tell it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Column => "column",
            Self::UpperArm => "upper arm",
            Self::Forearm => "forearm",
            Self::Wrist => "wrist",
            Self::Tool => "tool",
            Self::Cutter => "cutter",
            Self::Shank => "shank",
        }
    }
}

/// As answers tell it.
impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Floor => f.write_str("floor"),
            Self::Mounting => f.write_str("wall or ceiling"),
            Self::Work => f.write_str("work"),
            Self::Part => f.write_str("part"),
            Self::Stock => f.write_str("stock"),
            Self::Fixture => f.write_str("fixture"),
            Self::KeepOut(number) => write!(f, "keep-out {number}"),
            Self::Link(link) => f.write_str(link.name()),
        }
    }
}

#[cfg(test)]
mod tests;
