//! How does what is asked of a cell become options of the solver: heights and directions as the robot sees them?

use super::Unsupported;
use nalgebra::Vector3;
use stiffarm::cell::{Block, Cell, MOST_BLOCKS, Mount, Window};
use stiffarm::interval::Interval;
use stiffarm::place::{Margins, PlaceOptions, ToolOrientation, Within};

/// What is asked of a cell.
pub(super) struct CellOptions {
    pub(super) mount: Option<Mount>,
    pub(super) windows: Vec<Window>,
    pub(super) keep_out: Vec<Block>,
    /// m.
    pub(super) clearance: Option<f64>,
    /// Another floor is asked for.
    pub(super) has_floor: bool,
    /// One place is asked for: straight ahead, wherever else about the joint-1 axis there would be room.
    pub(super) is_at: bool,
}

impl CellOptions {
    /// Nothing but a window ahead of the robot, or not even that.
    fn is_usual(&self) -> bool {
        let usual_windows = matches!(self.windows.as_slice(), [] | [Window::Ring { .. }]);
        usual_windows && self.mount.is_none() && self.keep_out.is_empty() && self.clearance.is_none()
    }

    /// Adds the cell to what is asked of a placement.
    pub(super) fn of(self, options: &PlaceOptions, is_spatial: bool) -> Result<PlaceOptions, Unsupported> {
        if self.is_usual() {
            return Ok(*options);
        }
        if !is_spatial {
            return Err(Unsupported::CellInPlane);
        }
        if self.has_floor {
            return Err(Unsupported::Floor);
        }
        let mount = self.mount.unwrap_or_else(|| Mount::pedestal(0.0));
        if self.keep_out.iter().any(|block| [block.x, block.y, block.z].iter().all(|side| *side == Interval::ALL)) {
            return Err(Unsupported::Everything);
        }
        let is_ring = matches!(self.windows.as_slice(), [Window::Ring { .. }]);
        if self.is_at && is_ring && !mount.is_vertical() {
            return Err(Unsupported::Beside);
        }
        let mut cell = Cell { clearance: self.clearance, ..Cell::of(mount) };
        let tool_orientation = tool_orientation(&mut cell, options.tool_orientation())?;
        // The windows say where the work stands; where nothing is said, ahead and above the floor of the cell.
        let margins = Margins { front: false, floor: None, ..options.margins };
        let options = PlaceOptions { tool_orientation: Some(tool_orientation), margins, ..*options };
        Ok(self.placed(&options, cell))
    }

    /// With its windows: one that lies ahead of an upright or hanging robot needs no search of the cell.
    fn placed(self, options: &PlaceOptions, mut cell: Cell) -> PlaceOptions {
        let mount = cell.mount;
        let turns_freely = mount.is_vertical();
        let as_block = |window: Window| match window {
            Window::Ring { ahead, z } if !turns_freely => Window::Block(Block { x: ahead, y: Interval::ALL, z }),
            window => window,
        };
        let mut windows: Vec<Window> = self.windows.into_iter().map(as_block).collect();
        if windows.is_empty() && turns_freely {
            windows.push(Window::Ring { ahead: Interval::POSITIVE, z: Interval::POSITIVE });
        }
        for (place, block) in cell.keep_out.iter_mut().zip(self.keep_out) {
            *place = Some(block);
        }
        // Where nothing stands about the robot, one bearing is as good as another, and the work stands in front.
        let is_alike =
            cell.keep_out().next().is_none() && windows.iter().all(|window| matches!(window, Window::Ring { .. }));
        cell.is_ahead = turns_freely && (self.is_at || is_alike);
        if let ([Window::Ring { ahead, z }], false) = (windows.as_slice(), cell.decides_the_search()) {
            let within = Within { x: *ahead, z: mount.heights_from_base(*z) };
            return PlaceOptions { within: Some(within), cell: Some(cell), ..*options };
        }
        debug_assert!(windows.len() <= MOST_BLOCKS, "the row counts");
        for (place, window) in cell.windows.iter_mut().zip(windows) {
            *place = Some(window);
        }
        PlaceOptions { within: None, cell: Some(cell), ..*options }
    }
}

/// How the tool is held, as the robot sees it.
fn tool_orientation(cell: &mut Cell, asked: ToolOrientation) -> Result<ToolOrientation, Unsupported> {
    let mount = cell.mount;
    if mount.is_vertical() {
        let up = mount.uprightness().signum();
        return Ok(ToolOrientation { elevation: up * asked.elevation, yaw: asked.yaw.affine(up, 0.0), ..asked });
    }
    if !asked.is_vertical() {
        return Err(Unsupported::Leaning);
    }
    let axis = mount.cell_from_base.rotation.inverse() * (Vector3::z() * asked.elevation.signum());
    cell.azimuth = Some(axis.y.atan2(axis.x));
    Ok(ToolOrientation { roll: asked.roll, ..ToolOrientation::tool_at(axis.z.clamp(-1.0, 1.0).asin()) })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use stiffarm::load::Load;

    fn asked(mount: Mount, tool_orientation: ToolOrientation) -> Result<PlaceOptions, Unsupported> {
        let wish = CellOptions {
            mount: Some(mount),
            windows: Vec::new(),
            keep_out: Vec::new(),
            clearance: None,
            has_floor: false,
            is_at: false,
        };
        wish.of(&PlaceOptions { tool_orientation: Some(tool_orientation), ..PlaceOptions::under(Load::PAPER) }, true)
    }

    #[test]
    fn a_tool_that_points_down_points_where_the_mount_has_down() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}");
        let hanging = asked(Mount::ceiling(3.0), ToolOrientation::tool_down()).unwrap();
        close(hanging.tool_orientation().elevation, FRAC_PI_2);
        // From the ceiling down to the floor are heights of 0 to 3 m.
        close(hanging.within.unwrap().z.max(), 3.0);
        let raised = asked(Mount::pedestal(0.5), ToolOrientation::tool_down()).unwrap();
        close(raised.within.unwrap().z.min(), -0.5);
        // On a wall the robot's x axis points down.
        let wall = asked(Mount::wall(2.0), ToolOrientation::tool_down()).unwrap();
        close(wall.tool_orientation().elevation, 0.0);
        close(wall.cell.unwrap().azimuth.unwrap(), 0.0);
        assert_eq!(asked(Mount::wall(2.0), ToolOrientation::tool_at(0.0)), Err(Unsupported::Leaning));
    }
}
