//! How is a cell reported?

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::words::{fixed, window};
use super::{Line, Record, field, line, shape};
use nalgebra::Vector3;
use stiffarm::cell::{Block, Cell, Mount, MountKind, Window};
use stiffarm::clearance;
use stiffarm::interval::Interval;
use stiffarm::place::{PlaceOptions, Within};
use stiffarm::robot::Robot;
use stiffarm::spatial::Zyx;

/// The tool axis above the horizontal of the cell, rad, as it was asked.
pub(super) fn elevation(options: &PlaceOptions) -> f64 {
    let elevation = options.tool_orientation().elevation;
    let Some(cell) = options.cell else { return elevation };
    let ((se, ce), (sa, ca)) = (elevation.sin_cos(), cell.azimuth.unwrap_or(0.0).sin_cos());
    let axis = cell.mount.cell_from_base.rotation * Vector3::new(ce * ca, ce * sa, se);
    axis.z.atan2(axis.xy().norm())
}

/// What a line is called that says where the work may stand.
pub(super) const WINDOW: &str = "allowed place";

/// The mount, where the work may stand and what is kept free.
pub(super) fn lines(cell: &Cell, within: &Within) -> Vec<Line> {
    let mut lines = vec![line("mount", mount(&cell.mount))];
    let windows: Vec<Window> = cell.windows().collect();
    if windows.is_empty() && cell.azimuth.is_none() {
        lines.push(line(WINDOW, window(within, "the base")));
    } else if windows.is_empty() {
        lines.push(line(WINDOW, "anywhere above the cell's floor"));
    }
    lines.extend(windows.iter().map(|window| line(WINDOW, window_in_words(window))));
    let kept = cell.keep_out().enumerate();
    lines.extend(kept.map(|(i, block)| line(format!("keep-out {}", i + 1), block_in_words(&block))));
    lines.extend(cell.clearance.map(|asked| line("clearance asked", format!("{} mm", fixed(asked * 1e3, 0)))));
    lines
}

/// What stands about robots, as far as it is known, a line.
pub(super) fn known_about<'a>(robots: impl Iterator<Item = &'a Robot>, cell: Option<&Cell>) -> String {
    if cell.is_none_or(|cell| cell.keep_out().next().is_none()) {
        return "nothing is known of tables and fixtures\n".into();
    }
    format!("of tables and fixtures only the keep-outs are known\n{}", carrying(robots, cell))
}

/// What carries robots, as far as it is a keep-out, each a line.
pub(super) fn carrying<'a>(robots: impl Iterator<Item = &'a Robot>, cell: Option<&Cell>) -> String {
    let Some(cell) = cell else { return String::new() };
    let found: BTreeSet<usize> = robots.flat_map(|robot| clearance::carrying(robot, cell)).collect();
    let notes = found.into_iter().map(|number| {
        format!("a base stands in or on keep-out {number}, which is taken as what carries it: what joints move keeps out of it\n")
    });
    notes.collect()
}

/// Of which places the lower bound holds, where the cell takes some away.
pub(super) fn proof(cell: &Cell) -> Option<Line> {
    cell.decides_the_search().then(|| {
        line(
            "proof",
            "of all places about the robot as far and as high as these; keep-outs and clearance only take places away",
        )
    })
}

fn mount(mount: &Mount) -> String {
    let height = fixed(mount.cell_from_base.translation.z, 3);
    // Upright and hanging robots look along their x axis, those on a wall stand across their y axis.
    let [x, y] = [Vector3::x(), Vector3::y()].map(|axis| mount.cell_from_base.rotation * axis);
    let turn = if mount.kind == MountKind::Wall { (-y.x).atan2(y.y) } else { x.y.atan2(x.x) }.to_degrees();
    let turned = if turn.abs() < 1e-9 { String::new() } else { format!(", turned {} deg", fixed(turn, 1)) };
    match mount.kind {
        MountKind::Pedestal => format!("base {height} m above the cell's floor{turned}"),
        MountKind::Wall => format!("on a wall, joint-1 axis {height} m above the cell's floor{turned}"),
        MountKind::Ceiling => format!("hanging, base {height} m above the cell's floor{turned}"),
        MountKind::Pose => format!("as posed, base {height} m above the cell's floor"),
    }
}

fn range(range: Interval) -> String {
    // A place that is given leaves the slack of a nanometre about it.
    let rounded = |x: f64| ((x * 1e6).round() / 1e6 + 0.0).to_string();
    let end = |x: f64| if x.is_finite() { rounded(x) } else { String::new() };
    format!("{}..{}", end(range.min()), end(range.max()))
}

fn block_in_words(block: &Block) -> String {
    format!("x {} m, y {} m, z {} m in the cell", range(block.x), range(block.y), range(block.z))
}

fn window_in_words(window: &Window) -> String {
    match window {
        Window::Block(block) => block_in_words(block),
        Window::Ring { ahead, z } => {
            format!("{} m from the joint-1 axis, z {} m in the cell", range(*ahead), range(*z))
        }
    }
}

/// As it was asked for; null where a range is open.
pub(super) fn record(cell: &Cell, robot: &Robot) -> Record {
    let ends = |range: Interval| json!([range.min(), range.max()].map(|end| end.is_finite().then_some(end)));
    let block = |block: Block| json!([ends(block.x), ends(block.y), ends(block.z)]);
    let window = |window: Window| match window {
        Window::Block(found) => block(found),
        Window::Ring { ahead, z } => json!([ends(ahead), ends(z)]),
    };
    let pose = cell.mount.cell_from_base;
    let turned = Zyx::of(&pose.rotation);
    let mount = match cell.mount.kind {
        MountKind::Pedestal => "pedestal",
        MountKind::Wall => "wall",
        MountKind::Ceiling => "ceiling",
        MountKind::Pose => "pose",
    };
    let mut record = Record::of(&shape::CELL);
    record
        .put(field::MOUNT, mount)
        .put(field::BASE_IN_CELL, <[f64; 3]>::from(pose.translation.vector))
        .put(field::BASE_TURNED, [turned.x, turned.y, turned.z])
        .put(field::WINDOWS, cell.windows().map(window).collect::<Value>())
        .put(field::KEPT_FREE, cell.keep_out().map(block).collect::<Value>())
        .put(field::CARRIES_BASE, json!(clearance::carrying(robot, cell)))
        .put(field::CLEARANCE_KEPT, cell.clearance);
    record
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;

    #[test]
    fn a_mount_is_reported_as_turned_as_it_is() {
        for kind in [Mount::pedestal(0.5), Mount::ceiling(3.0), Mount::wall(2.0)] {
            assert!(!mount(&kind).contains("turned"), "{}", mount(&kind));
            for turn in [40.0_f64, -130.0] {
                let text = mount(&kind.turned(turn.to_radians()));
                assert!(text.ends_with(&format!(", turned {turn:.1} deg")), "{text}");
            }
        }
    }
    /// A wall turns the base by a quarter about y, where the turns about x and z are one: what is reported is the turn that it has.
    #[test]
    fn the_angles_of_a_mount_are_those_of_its_rotation() {
        let robot = stiffarm::catalogue::paper_robots().swap_remove(4);
        for turn in [0.0_f64, 20.0, -45.0, 90.0] {
            for mount in [Mount::wall(1.5), Mount::ceiling(2.0), Mount::pedestal(0.3)] {
                let mount = mount.turned(turn.to_radians());
                let json = record(&Cell::of(mount), &robot).json();
                let [x, y, z] = [0, 1, 2].map(|i| json["base_deg"][i].as_f64().unwrap().to_radians());
                let off = UnitQuaternion::from_euler_angles(x, y, z).angle_to(&mount.cell_from_base.rotation);
                assert!(off < 1e-7, "{mount:?}: {off}");
            }
        }
    }
}
