//! `stiffarm place --model spatial`: the best place of one flat zone about the robot.

use std::io::{self, Write};
use std::path::Path;

use stiffarm::map::{Axis, Section, SectionOptions, Spacing, section};
use stiffarm::place::{SpatialOptions, SpatialPlacement, SpatiallyPlaced, ZonePoint, across_zone, place_in_space};
use stiffarm::request::Request;
use stiffarm::robot::{Arm, Robot};
use stiffarm::space::SpatialArm;
use stiffarm::task::Task;

use super::drawing::{over_everything, scene};
use super::{CELL_COLUMNS, COLUMN, cell_json, cell_row, direction, tool, window};
use crate::args::Common;
use crate::commands::waiting;
use crate::failure::Failure;
use crate::figures::face::FaceFigure;
use crate::figures::map::MapFigure;
use crate::figures::scene::{ZoneMark, rim};
use crate::figures::view3d::{ArmMark, Cell, Point, Sheet, View, Zone};
use crate::output::{Answer, Outputs, figure, pretty};
use crate::table::{Table, fixed, percentages};

/// Points along the longer side of the section that is drawn.
const FIGURE_SIZE: usize = 300;
/// Points along each side of the zone that are drawn.
const FACE_SIZE: usize = 33;

pub(crate) fn run(robot: Robot, asked: &Request, common: &Common) -> Result<(), Failure> {
    let (name, task) = (asked.robot()?, asked.task()?);
    let outputs = Outputs::open::<PlaceAnswer>(common, &[Path::new(&name)])?;
    let options = asked.spatial_for(task.zone)?;
    let placed = waiting("searching places", common, || place_in_space(&robot, task.zone, &options))
        .map_err(|error| Failure::PlaceInSpace { robot: robot.name.clone(), error })?;
    outputs.deliver(&PlaceAnswer { robot, task, options, placed, tolerance_mm: asked.tolerance_mm() })
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
        rows.push(("posture".into(), best.configuration.to_string()));
        let [wx, wy, wz] = best.worst_point.map(|part| part + 0.0);
        if best.from_axis_1 < COLUMN {
            let near = format!("{:.2} m; the robot's own base stands there, --within keeps away", best.from_axis_1);
            rows.push(("nearest to the joint-1 axis".into(), near));
        }
        rows.push(("worst point".into(), format!("x {wx:.4} m, y {wy:.4} m, z {wz:.4} m")));
        let joints = best.worst_joints.map(|angle| fixed(angle.to_degrees() + 0.0, 1));
        rows.push(("joints there, as reported".into(), format!("{} deg", joints.join(", "))));
        rows.push(("drives 1 to 6 give of it".into(), percentages(&best.worst_shares)));
        let (margin, joint) = best.limit_margin;
        let which = if joint == 0 { "the angle between the links".into() } else { format!("joint {joint}") };
        rows.push(("nearest limit".into(), format!("{which}, {} away", degrees(margin))));
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

impl PlaceAnswer {
    /// What is drawn, where there is something.
    fn feasible(&self) -> Result<&SpatialPlacement, Failure> {
        match &self.placed {
            SpatiallyPlaced::Feasible(best) => Ok(best),
            SpatiallyPlaced::Infeasible { reason, .. } => {
                Err(Failure::Usage(format!("{}: no place for {} to draw: {reason}", self.robot.name, self.task.label)))
            }
        }
    }

    /// The section through the joint-1 axis, held as the zone is.
    fn section(&self, best: &SpatialPlacement) -> Result<Option<Section>, Failure> {
        let Self { robot, options, .. } = self;
        let unit = Axis { start: 0.0, step: 1.0, count: 2 };
        let arm = SpatialArm::new(robot, &options.flange_from_tool)
            .map_err(|error| Failure::Posture { robot: robot.name.clone(), error })?;
        let any_roll = options.roll.is_none() && arm.tool_turns_about_axis_6();
        let asked = SectionOptions {
            x: unit,
            z: unit,
            force: options.force,
            flange_from_tool: options.flange_from_tool,
            elevation: options.elevation,
            yaw: best.yaw,
            roll: (!any_roll).then_some(best.roll),
            configuration: Some(best.configuration),
        };
        let Some(options) = over_everything(robot, &asked, Spacing::Points(FIGURE_SIZE))? else {
            return Ok(None);
        };
        section(robot, &options).map(Some).map_err(|error| Failure::Map { robot: robot.name.clone(), error })
    }

    /// Points of the zone, given along its sides, with their deflections.
    fn across(
        &self,
        best: &SpatialPlacement,
        points: impl IntoIterator<Item = [f64; 2]>,
    ) -> Result<Vec<ZonePoint>, Failure> {
        across_zone(&self.robot, &self.options, best, points)
            .map_err(|error| Failure::PlaceInSpace { robot: self.robot.name.clone(), error })
    }

    /// The zone row by row.
    fn face(&self, best: &SpatialPlacement) -> Result<Vec<ZonePoint>, Failure> {
        let side = |i: usize| 2.0 * i as f64 / (FACE_SIZE - 1) as f64 - 1.0;
        let nodes = (0..FACE_SIZE).flat_map(|j| (0..FACE_SIZE).map(move |i| [side(i), side(j)]));
        self.across(best, nodes.map(|node| self.task.zone.at(node)))
    }

    /// The rim of the zone, straight ahead.
    fn rim(&self, best: &SpatialPlacement) -> Result<Vec<Point>, Failure> {
        Ok(self.across(best, rim(self.task.zone, [0.0; 2], 0.0))?.iter().map(|point| point.at).collect())
    }

    /// The joints at the worst point, the zone straight ahead.
    fn joints(&self, best: &SpatialPlacement) -> [f64; 6] {
        let mut q = best.worst_joints;
        if let Arm::SixAxis { geometry, .. } = &self.robot.arm {
            q[0] -= geometry.sign[0] * best.bearing;
        }
        q
    }

    fn zone_label(&self, best: &SpatialPlacement) -> String {
        format!("{}: {:.3} mm at worst", self.task.label, best.deflection * 1e3)
    }

    fn subtitle(&self, best: &SpatialPlacement) -> String {
        let Self { robot, options, .. } = self;
        let (architecture, status, towards) = (robot.architecture, robot.status, direction(options.elevation));
        let tool = tool(&options.flange_from_tool);
        format!("{architecture}, {status}; all six drives, {towards}, tool: {tool}; {}", best.configuration)
    }

    fn colour_label(&self) -> String {
        format!("worst deflection under {} N [mm]", self.options.force)
    }

    fn figure(&self, best: &SpatialPlacement) -> Result<String, Failure> {
        let Some(section) = self.section(best)? else {
            return Err(Failure::Usage("the zone stands where no section is reached".into()));
        };
        // Turned back: the section points straight ahead.
        let ((s, c), [wx, wy, wz]) = (best.bearing.sin_cos(), best.worst_point);
        let mark = ZoneMark {
            zone: self.task.zone,
            rim: self.rim(best)?.into_iter().map(|[x, _, z]| [x, z]).collect(),
            worst_point: [c * wx + s * wy, wz],
            label: self.zone_label(best),
        };
        let face = FaceFigure {
            zone: self.task.zone,
            angle: best.angle,
            cells: self.face(best)?.iter().map(|point| point.deflection.map(|metres| metres * 1e3)).collect(),
            per_side: FACE_SIZE,
            up: match self.options.elevation.to_degrees() {
                down if down < -89.9 => "ahead",
                up if 89.9 < up => "back",
                _ => "upwards in its plane",
            },
            colour_label: self.colour_label(),
        };
        let drawn = MapFigure {
            title: self.robot.full_name(),
            subtitle: self.subtitle(best),
            map: &section.worst,
            factor: 1e3,
            ends: ["stiff", "soft"],
            edge: None,
            scene: scene(&self.robot, Some(&self.joints(best)), &self.options.flange_from_tool, Some(mark)),
            colour_label: self.colour_label(),
            origin: "the base",
            face: Some(face),
        };
        drawn.svg().map_err(figure)
    }

    fn in_space(&self, best: &SpatialPlacement) -> Result<View, Failure> {
        let (s, c) = best.bearing.sin_cos();
        let turned = |[x, y, z]: Point| [c * x - s * y, s * x + c * y, z];
        let cell = |point: &ZonePoint| Cell { at: turned(point.at), mm: point.deflection.map(|metres| metres * 1e3) };
        let face: Vec<Cell> = self.face(best)?.iter().map(cell).collect();
        let zone = Zone {
            label: self.zone_label(best),
            rim: self.rim(best)?.into_iter().map(turned).collect(),
            sheet: Some(Sheet { rows: face.chunks(FACE_SIZE).map(<[Cell]>::to_vec).collect() }),
            worst: Some(Cell { at: best.worst_point, mm: Some(best.deflection * 1e3) }),
        };
        let section = self.section(best)?.map(|section| {
            let mut sheet = Sheet::of_map(&section.worst, [0.0; 2], 0.0);
            sheet.rows.iter_mut().flatten().for_each(|cell| cell.at = turned(cell.at));
            sheet
        });
        Ok(View {
            title: self.robot.full_name(),
            notes: vec![self.subtitle(best), "arm at the worst point of the zone; section held as the zone is".into()],
            arm: ArmMark::posed(
                &self.robot,
                &best.worst_joints,
                &self.options.flange_from_tool,
                Some(&best.worst_shares),
            ),
            zone: Some(zone),
            section,
            colour_label: self.colour_label(),
            floor: true,
            ..View::default()
        })
    }
}

/// The lower bound and how far it lies from the value.
fn bound(best: &SpatialPlacement) -> String {
    if best.lower_bound <= 0.0 && 0.0 < best.gap() {
        return format!("nothing is proved ({} boxes)", best.resolution.boxes);
    }
    let gap = 100.0 * best.gap();
    format!("{:.4} mm (proved with {} boxes; gap {gap:.1} %)", best.lower_bound * 1e3, best.resolution.boxes)
}

impl Answer for PlaceAnswer {
    const COMMAND: &'static str = "place";
    const FURTHER: &'static [&'static str] = &["svg", "png", "html"];

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

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &cell_json(&self.robot, &self.task, &self.options, &self.placed, self.tolerance_mm))
    }

    fn csv(&self) -> Table<'_> {
        let mut table = Table::new(CELL_COLUMNS);
        table.row(cell_row(&self.robot, &self.task, self.options.force, &self.placed, self.tolerance_mm));
        table
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(self.feasible().and_then(|best| self.figure(best)))
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        Some(self.feasible().and_then(|best| self.in_space(best)))
    }
}
