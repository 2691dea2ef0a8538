//! `stiffarm place`: the best place of one zone.

use std::io::{self, Write};
use std::path::Path;

use stiffarm::place::{Outside, PlaceError, PlaceOptions, Placed, Placement, place_robot};
use stiffarm::report;
use stiffarm::request::Request;
use stiffarm::robot::Robot;
use stiffarm::task::Task;

use super::map::{MapAnswer, placement_map};
use super::{spatial, waiting};
use crate::args::Common;
use crate::failure::Failure;
use crate::figures::view3d::View;
use crate::output::{Answer, Outputs, pretty};
use crate::selection;
use crate::table::{Table, fixed, full};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let (name, task) = (asked.robot()?, asked.task()?);
    let robot = selection::robot(&name, common)?;
    if asked.is_spatial() {
        return spatial::place::run(robot, asked, common);
    }
    let outputs = Outputs::open::<PlaceAnswer>(common, &[Path::new(&name)])?;
    let options = asked.wanted().planar(task.zone);
    let placed = waiting("searching places", common, || place_robot(&robot, task.zone, &options))
        .map_err(|error| Failure::Place { robot: robot.name.clone(), error })?;
    outputs.deliver(&PlaceAnswer { robot, task, options, placed, tolerance_mm: asked.tolerance_mm() })
}

struct PlaceAnswer {
    robot: Robot,
    task: Task,
    options: PlaceOptions,
    placed: Placed,
    tolerance_mm: Option<f64>,
}

impl PlaceAnswer {
    /// The robot's map with the zone in it.
    fn mapped(&self) -> Result<MapAnswer, Failure> {
        placement_map(&self.robot, &self.task, &self.options, self.placed.feasible())
    }
}

impl Answer for PlaceAnswer {
    const COMMAND: &'static str = "place";
    const FURTHER: &'static [&'static str] = &["svg", "png", "html"];

    fn text(&self, markdown: bool) -> String {
        let Self { robot, task, options, .. } = self;
        let mut table = Table::new(["", ""]);
        table.row(["robot".into(), format!("{} ({}, {})", robot.full_name(), robot.architecture, robot.status)]);
        table.row(["task".into(), format!("{} ({})", task.label, task.zone.describe())]);
        table.row(["force".into(), format!("{} N in its worst direction, planar model", options.force)]);
        match &self.placed {
            Placed::Feasible(best) => {
                let [x, z] = best.centre;
                let gap = 1.0 - best.lower_bound / best.deflection;
                table.row(["worst deflection in the zone".into(), format!("{:.4} mm", best.deflection * 1e3)]);
                table.row([
                    "no place has less than".into(),
                    format!("{:.4} mm ({})", best.lower_bound * 1e3, proof(gap)),
                ]);
                table.row(["centre from the joint-2 axis".into(), format!("x {x:.4} m, z {z:.4} m")]);
                let [ax, az] = robot.axis_2();
                if [ax, az] != [0.0; 2] {
                    table.row(["centre from the base".into(), format!("x {:.4} m, z {:.4} m", x + ax, z + az)]);
                }
                if let Some(note) = outside(robot, task, best) {
                    table.row(["note".into(), note]);
                }
                table.row(["angle of the first side".into(), format!("{:.1} deg", best.angle.to_degrees() + 0.0)]);
                table.row(["elbow".into(), best.elbow.name().to_owned()]);
                let [wx, wz] = best.worst_point;
                table.row(["worst point".into(), format!("x {wx:.4} m, z {wz:.4} m from the joint-2 axis")]);
                if let Some(tolerance) = self.tolerance_mm {
                    let margin = tolerance - best.deflection * 1e3;
                    let verdict = if 0.0 <= margin { "pass" } else { "fail" };
                    table.row([
                        format!("tolerance {tolerance} mm"),
                        format!("{verdict}, margin {} mm", fixed(margin, 4)),
                    ]);
                }
            }
            Placed::Infeasible { reason, largest_scale } => {
                table.row(["no place".into(), reason.to_string()]);
                table.row(["largest zone of this shape".into(), largest(task, *largest_scale)]);
            }
        }
        table.text(markdown)
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        let cell = report::place::cell(&self.robot, &self.task, &self.options, &self.placed, self.tolerance_mm);
        pretty(out, &cell)
    }

    fn csv(&self) -> Table<'_> {
        let mut table = Table::new(CELL_COLUMNS);
        table.row(cell_row(&self.robot, &self.task, &self.options, Ok(&self.placed), self.tolerance_mm));
        table
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(self.mapped().and_then(|map| map.figure()))
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        Some(self.mapped().map(|map| map.in_space()))
    }
}

/// Says where a place lies partly below the base or behind the joint-1 axis: reached, but rarely meant.
fn outside(robot: &Robot, task: &Task, best: &Placement) -> Option<String> {
    let Outside { below, behind } = Outside::of(robot, task.zone, best);
    let place = match (below, behind) {
        (false, false) => return None,
        (true, false) => "below the base",
        (false, true) => "behind the joint-1 axis",
        (true, true) => "below the base and behind the joint-1 axis",
    };
    Some(format!("part of it lies {place}; --within 0..,0.. keeps it in front of and above the base"))
}

/// What a gap means.
fn proof(gap: f64) -> String {
    if gap < 1e-11 { "exact".into() } else { format!("gap {gap:.1e}") }
}

/// How large a zone of the shape would fit.
fn largest(task: &Task, scale: f64) -> String {
    if scale == 0.0 {
        "none: no zone of this shape fits, however small".into()
    } else {
        format!("{scale:.4} of the size asked for ({})", task.zone.scaled(scale).describe())
    }
}

/// The columns of a placement in a spreadsheet.
pub(crate) const CELL_COLUMNS: [&str; 18] = [
    "robot",
    "vendor",
    "architecture",
    "status",
    "task",
    "force_n",
    "feasible",
    "deflection_mm",
    "lower_bound_mm",
    "x_m",
    "z_m",
    "angle_deg",
    "elbow",
    "largest_feasible_scale",
    "below_base",
    "tolerance_mm",
    "pass",
    "reason",
];

pub(crate) fn cell_row(
    robot: &Robot,
    task: &Task,
    options: &PlaceOptions,
    placed: Result<&Placed, &PlaceError>,
    tolerance_mm: Option<f64>,
) -> Vec<String> {
    let best = placed.ok().and_then(Placed::feasible);
    let scale = match placed {
        Ok(Placed::Infeasible { largest_scale, .. }) => Some(*largest_scale),
        Ok(Placed::Feasible(_)) | Err(_) => None,
    };
    // Blank where it is not known.
    let or_blank = |text: String| if placed.is_ok() { text } else { String::new() };
    vec![
        robot.name.clone(),
        robot.vendor.clone(),
        robot.architecture.to_string(),
        robot.status.to_string(),
        task.label.clone(),
        options.force.to_string(),
        or_blank(best.is_some().to_string()),
        full(best.map(|best| best.deflection * 1e3)),
        full(best.map(|best| best.lower_bound * 1e3)),
        full(best.map(|best| best.centre[0])),
        full(best.map(|best| best.centre[1])),
        full(best.map(|best| best.angle.to_degrees())),
        best.map_or_else(String::new, |best| best.elbow.name().into()),
        full(scale),
        best.map_or_else(String::new, |best| Outside::of(robot, task.zone, best).below.to_string()),
        full(tolerance_mm),
        tolerance_mm.map_or_else(String::new, |tolerance| {
            or_blank(best.is_some_and(|best| best.deflection * 1e3 <= tolerance).to_string())
        }),
        match placed {
            Ok(Placed::Feasible(_)) => String::new(),
            Ok(Placed::Infeasible { reason, .. }) => reason.to_string(),
            Err(error) => error.to_string(),
        },
    ]
}
