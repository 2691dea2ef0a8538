//! `stiffarm place --model spatial`: the best place of one flat zone about the robot.

use serde_json::Value;
use stiffarm::place::{SpatialOptions, SpatialPlacement, SpatiallyPlaced, place_in_space};
use stiffarm::robot::Robot;
use stiffarm::task::Task;

use super::{CELL_COLUMNS, cell_json, cell_row, direction, tool, window};
use crate::args::{Common, PlaceArgs};
use crate::commands::progress;
use crate::failure::Failure;
use crate::output::{Answer, deliver};
use crate::table::{Table, fixed};

pub(crate) fn run(robot: Robot, args: &PlaceArgs, common: &Common) -> Result<(), Failure> {
    let options = args.space.options_for(&args.placing, args.task.zone)?;
    let bar = progress(1, "searching places", common);
    let placed = place_in_space(&robot, args.task.zone, &options)
        .map_err(|error| Failure::PlaceInSpace { robot: robot.name.clone(), error })?;
    bar.finish_and_clear();
    let answer = PlaceAnswer { robot, task: args.task.clone(), options, placed, tolerance_mm: args.tolerance_mm };
    deliver(&answer, common)
}

struct PlaceAnswer {
    robot: Robot,
    task: Task,
    options: SpatialOptions,
    placed: SpatiallyPlaced,
    tolerance_mm: Option<f64>,
}

impl PlaceAnswer {
    fn rows(&self, best: &SpatialPlacement) -> Vec<(String, String)> {
        let [x, z] = best.centre;
        let degrees = |angle: f64| format!("{:.1} deg", angle.to_degrees() + 0.0);
        let mut rows: Vec<(String, String)> = vec![
            ("worst deflection in the zone".into(), format!("{:.4} mm", best.deflection * 1e3)),
            ("no place has less than".into(), bound(best)),
            ("centre from the base".into(), format!("x {x:.4} m ahead, z {z:.4} m up")),
        ];
        if best.bearing != 0.0 {
            let turned = format!("{} about the joint-1 axis, where its limits allow the zone", degrees(best.bearing));
            rows.push(("turned".into(), turned));
        }
        if !self.options.elevation.to_degrees().abs().eq(&90.0) {
            rows.push(("yaw of the zone's plane".into(), degrees(best.yaw)));
        }
        rows.push(("angle of the first side".into(), degrees(best.angle)));
        rows.push(("roll of the tool".into(), degrees(best.roll)));
        rows.push(("posture".into(), best.class.to_string()));
        let [wx, wy, wz] = best.worst_point.map(|part| part + 0.0);
        rows.push(("worst point".into(), format!("x {wx:.4} m, y {wy:.4} m, z {wz:.4} m")));
        let joints = best.worst_joints.map(|angle| fixed(angle.to_degrees() + 0.0, 1));
        rows.push(("joints there, as reported".into(), format!("{} deg", joints.join(", "))));
        let shares = best.worst_shares.map(|share| format!("{:.1} %", share * 100.0));
        rows.push(("drives 1 to 6 give of it".into(), shares.join(", ")));
        let (margin, joint) = best.limit_margin;
        rows.push(("nearest limit".into(), format!("joint {joint}, {} away", degrees(margin))));
        rows.push(("nearest singular posture".into(), format!("{} away", degrees(best.singular_margin))));
        let found = &best.resolution;
        let coarse =
            if found.coarse.is_finite() { format!("{:.4} mm", found.coarse * 1e3) } else { "no whole zone".to_owned() };
        rows.push((
            "looked for".into(),
            format!(
                "every {:.0} mm ({coarse} there), then down to {:.2} mm and {:.3} deg",
                found.coarse_step * 1e3,
                found.fine_step * 1e3,
                found.fine_turn.to_degrees()
            ),
        ));
        rows.push((
            "poses in the zone".into(),
            format!(
                "{}, at most {:.1} mm apart; halving that changed the value by {:.2} %",
                found.samples,
                found.sample_step * 1e3,
                found.halving * 100.0
            ),
        ));
        rows
    }
}

/// The lower bound and how far it lies from the value.
fn bound(best: &SpatialPlacement) -> String {
    let gap = 100.0 * (1.0 - best.lower_bound / best.deflection);
    format!("{:.4} mm (proved with {} boxes; gap {gap:.1} %)", best.lower_bound * 1e3, best.resolution.boxes)
}

impl Answer for PlaceAnswer {
    const COMMAND: &'static str = "place";

    fn text(&self, markdown: bool) -> String {
        let Self { robot, task, options, .. } = self;
        let mut table = Table::new(["", ""]);
        table.row(["robot".into(), format!("{} ({}, {})", robot.full_name(), robot.architecture, robot.status)]);
        table.row([
            "task".into(),
            format!("{} ({}), {}", task.label, task.zone.describe(), direction(options.elevation)),
        ]);
        table.row(["tool".into(), tool(&options.flange_from_tool)]);
        table.row(["force".into(), format!("{} N in its worst direction, spatial model", options.force)]);
        table.row(["allowed place".into(), window(&options.within)]);
        match &self.placed {
            SpatiallyPlaced::Feasible(best) => {
                for (name, value) in self.rows(best) {
                    table.row([name, value]);
                }
                if let Some(tolerance) = self.tolerance_mm {
                    let margin = tolerance - best.deflection * 1e3;
                    let verdict = if 0.0 <= margin { "pass" } else { "fail" };
                    let verdict = format!("{verdict}, margin {} mm", fixed(margin, 4));
                    table.row([format!("tolerance {tolerance} mm"), verdict]);
                }
            }
            SpatiallyPlaced::Infeasible { reason, is_proved } => {
                let proof = if *is_proved { "; it is proved that there is none" } else { "" };
                table.row(["no place".into(), format!("{reason}{proof}")]);
            }
        }
        table.text(markdown)
            + "\nall six drives compliant, everything else rigid; the robot's own body and the table are not known: collisions are not checked\n"
    }

    fn json(&self) -> Value {
        Value::Object(cell_json(&self.robot, &self.task, &self.options, &self.placed, self.tolerance_mm))
    }

    fn csv(&self) -> Table {
        let mut table = Table::new(CELL_COLUMNS);
        table.row(cell_row(&self.robot, &self.task, self.options.force, &self.placed, self.tolerance_mm));
        table
    }
}
