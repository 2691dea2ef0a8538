//! Where does the robot of a shop drawing stand, and what do lengths count from?

use nalgebra::Vector3;
use stiffarm::cell::{Cell, MountKind};
use stiffarm::spatial::Pose;

/// Where a robot stands, m, along the axes of its base, or of the cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Base {
    /// Where the joint-1 axis meets the foot of the robot.
    pub foot: [f64; 3],
    /// Where the joint-1 axis points from there, of length one.
    pub axis: [f64; 3],
    /// The joint-1 axis is upright, or hangs: lengths count from it.
    pub is_vertical: bool,
    /// What the robot is fixed to, where that is neither a floor nor a pedestal.
    pub fixed_to: Option<&'static str>,
    /// Where the floor is, where that is known: of a cell.
    pub floor: Option<f64>,
}

impl Base {
    /// In a cell, or by itself.
    pub(super) fn of(cell: Option<&Cell>) -> Self {
        let mount = cell.map(|cell| cell.mount);
        let pose = mount.map_or_else(Pose::identity, |mount| mount.cell_from_base);
        Self {
            foot: pose.translation.vector.into(),
            axis: (pose.rotation * Vector3::z()).into(),
            is_vertical: mount.is_none_or(|mount| mount.is_vertical()),
            fixed_to: mount.filter(|mount| mount.raised().is_none()).map(|mount| match mount.kind {
                MountKind::Wall => "wall",
                MountKind::Ceiling => "ceiling",
                MountKind::Pedestal | MountKind::Pose => "base as posed",
            }),
            floor: mount.map(|_| 0.0),
        }
    }

    /// What lengths ahead and sideways count from.
    pub fn datum(&self) -> &'static str {
        if self.is_vertical { "joint-1 axis" } else { "middle of the foot" }
    }

    /// What lengths count from, and along which axes.
    pub fn origin(&self) -> String {
        match self.floor {
            None => "the base".into(),
            Some(_) => format!("the {} and the floor, along the axes of the cell", self.datum()),
        }
    }
}
