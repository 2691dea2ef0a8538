//! How is a placement told?

use serde_json::Value;

use super::advice;
use super::cell as told_cell;
use super::payload;
use super::stiffness::{self, stiffness};
use super::uncertainty::{self, Known};
use super::verdict::{self, HOLDS, Verdict};
use super::words::{COLUMN, degrees, direction, fixed, percentages, tool, tool_mm};
use super::{Datum, Line, Record, Rows, Table, field, force, line, margins, with_schema, words};
use stiffarm::advice::Advice;
use stiffarm::cell::{Cell, Window};
use stiffarm::clearance::Clearance;
use stiffarm::interval::Interval;
use stiffarm::limits::Pendant;
use stiffarm::map::{HeldPosture, MapOptions, Spacing};
use stiffarm::model::{Model, ModelKind};
use stiffarm::place::{
    FacePlacement, Outside, PlaceError, PlaceOptions, Placed, Placement, Resolution, SpaceHold, Within,
};
use stiffarm::robot::Robot;
use stiffarm::task::Task;

const NO_PLACE: &str = "no place";
const SMALLEST_MARGIN: &str = "smallest margin";
const WORST_POINT: &str = "worst point";

/// The answer of `place`, with what was asked.
#[derive(Clone, Debug)]
pub struct PlaceAnswer {
    /// Which robot.
    pub robot: Robot,
    /// Under which model.
    pub model: ModelKind,
    /// Which zone.
    pub task: Task,
    /// What else was asked.
    pub options: PlaceOptions,
    /// What was found.
    pub placed: Placed,
    /// The largest deflection that is acceptable, mm.
    pub tolerance_mm: Option<f64>,
    /// What that says of force, stiffness and size, where it was sought.
    pub advice: Option<Advice>,
}

impl PlaceAnswer {
    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, model, task, options, placed, tolerance_mm, advice } = self;
        let mut record = cell(robot, task, (model, options), Ok(placed), (*tolerance_mm, self.known()));
        put_advice(&mut record, advice.as_ref(), (task, options.load));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("place", words::origin(&self.robot), &self.record())
    }

    /// One row for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        let record = self.record();
        Rows::new(record.columns(), vec![record.cells()])
    }

    /// For people.
    pub fn table(&self) -> Table {
        let Self { robot, model, task, options, placed, .. } = self;
        let mut lines = vec![line("robot", words::robot(robot)), line(stiffness::LINE, stiffness(robot))];
        let zone = format!("{} ({})", task.label, task.work.describe());
        match model {
            ModelKind::Spatial(flange_from_tool) if task.work.part().is_some() => {
                lines.push(line("task", zone));
                lines.push(line("tool", tool(flange_from_tool)));
            }
            ModelKind::Planar => lines.push(line("task", format!("{zone}, {}", words::UPRIGHT))),
            ModelKind::Spatial(flange_from_tool) => {
                lines.push(line("task", format!("{zone}, {}", direction(told_cell::elevation(&self.options)))));
                lines.push(line("tool", tool(flange_from_tool)));
            }
        }
        lines.push(line("force", words::load(options.load, model)));
        lines.extend(self.carried().lines());
        if !words::component(options.load).is_empty() {
            lines.push(line("what counts", format!("the deflection {}", words::component(options.load))));
        }
        if *model != ModelKind::Planar && options.load.breaks_symmetry() {
            lines.push(line("fixed to the base", "its centre straight ahead, and nowhere else about the joint-1 axis"));
        }
        lines.extend(self.allowed_lines());
        lines.extend(margins::column(&options.margins, robot).map(|kept| line("", kept)));
        lines.push(line("margins", margins::angles(&options.margins)));
        match placed {
            Placed::Feasible(best) => lines.extend(self.lines(best)),
            Placed::Infeasible { reason, is_proved, largest_scale } => {
                let proof =
                    if *is_proved && largest_scale.is_none() { "; it is proved that there is none" } else { "" };
                lines.push(line(NO_PLACE, format!("{reason}{proof}")));
                let scale = largest_scale.filter(|_| self.advice.is_none());
                lines.extend(scale.map(|scale| line("largest zone of this shape", largest(task, scale))));
            }
        }
        lines.extend(self.advice.iter().flat_map(|found| advice::lines(found, (task, options.load))));
        let best = placed.feasible();
        let (decides, means) = best
            .map_or((NO_PLACE, "why there is no place"), |best| (worst_label(best), "worst deflection at the place"));
        let clearance = self.clearance().map(|clearance| words::clearance(&clearance)[0].clone());
        let centre = best.map(|best| self.centre_label(best));
        let repeated = ["robot", SMALLEST_MARGIN, WORST_POINT].into_iter();
        let repeated: Vec<&str> = repeated.chain(clearance.as_deref()).chain(centre.as_deref()).collect();
        Table::of_lines(lines).led_by([decides, stiffness::LINE], means, &repeated)
    }

    /// Where the deflection at the best place lies, and how likely it keeps the tolerance; `None` where nothing says how far the drives may be off.
    pub(super) fn known(&self) -> Option<Known> {
        Known::at(&self.robot, self.options.load, self.best(), self.tolerance_mm)
    }

    /// Whether the tolerance is kept at the best place; `None` where there is none of the two.
    pub fn verdict(&self) -> Option<Verdict> {
        let (tolerance, best) = self.tolerance_mm.zip(self.best())?;
        Some(Verdict::of(best.deflection, tolerance).with(self.known().and_then(|known| known.holds)))
    }

    /// The best place, where there is one.
    pub fn best(&self) -> Option<&Placement> {
        self.placed.feasible()
    }

    /// How near the arm comes to anything at the best place.
    pub(super) fn clearance(&self) -> Option<Clearance> {
        clearance(&self.robot, (&self.model, &self.options), &self.task, self.best()?)
    }

    /// Where the zone may stand.
    fn allowed_lines(&self) -> Vec<Line> {
        let Self { robot, model, options, .. } = self;
        match options.cell {
            None => {
                let allowed = words::window(&margins::window(options, model, robot), words::origin(robot));
                vec![line("allowed place", allowed)]
            }
            Some(cell) => {
                let lines = told_cell::lines(&cell, &options.within(model)).into_iter();
                lines.chain(told_cell::proof(&cell)).collect()
            }
        }
    }

    /// The same in one line.
    pub(super) fn allowed(&self) -> String {
        let lines = self.allowed_lines();
        let told = lines
            .iter()
            .map(|[name, says]| if name == "allowed place" { says.clone() } else { format!("{name}: {says}") });
        told.collect::<Vec<_>>().join("; ")
    }

    /// Why the answer is no, where it is: there is no place, the arm collides there, it carries more than it may, or the tolerance is not held.
    pub fn shortfall(&self) -> Option<String> {
        let Self { robot, task, placed, tolerance_mm, .. } = self;
        let best = match placed {
            Placed::Infeasible { reason, .. } => {
                return Some(format!("{}: no place for {}: {reason}", robot.name, task.label));
            }
            Placed::Feasible(best) => best,
        };
        if let Some(clearance) = self.clearance().filter(|_| best.collides_in_space()) {
            let [name, says] = words::clearance(&clearance);
            return Some(format!("{}: {name}, {says}", robot.name));
        }
        if let Some(exceeded) = self.carried().exceeded() {
            return Some(format!("{}: {exceeded}", robot.name));
        }
        let tolerance = (*tolerance_mm)?;
        let fails = !Verdict::of(best.deflection, tolerance).passes;
        let told = fixed(best.deflection * 1e3, 4);
        fails.then(|| format!("{}: {told} mm on {}, tolerance {tolerance} mm", robot.name, task.label))
    }

    /// What the robot must hold.
    pub(super) fn carried(&self) -> payload::Carried {
        payload::FlangeLoad::of(self.options.tool_weight, &self.model, self.options.load.newtons()).by(&self.robot)
    }

    /// Where a picture of the plane straight ahead of the answer shows that the zone may stand, m from the base.
    pub fn windows(&self) -> Vec<Within> {
        let Some(cell) = self.options.cell else { return margins::windows(&self.options, &self.model, &self.robot) };
        let crossed = |window: Window| match window {
            Window::Block(block) => cell.crossing(&block, self.bearing()),
            Window::Ring { ahead, z } => Some([ahead, cell.mount.heights_from_base(z)]),
        };
        cell.windows().filter_map(crossed).map(|[x, z]| Within { x, z }).collect()
    }

    /// What must be kept free in that plane.
    pub fn keep_outs(&self) -> Vec<Within> {
        let Some(cell) = self.options.cell else { return Vec::new() };
        cell.keep_out()
            .filter_map(|block| cell.crossing(&block, self.bearing()))
            .map(|[x, z]| Within { x, z })
            .collect()
    }

    /// In which direction from the joint-1 axis the zone lies, rad; straight ahead where there is none.
    fn bearing(&self) -> f64 {
        self.best().and_then(Placement::space).map_or(0.0, |hold| hold.bearing)
    }

    /// A map of what is reached, held as the zone is.
    pub fn map_options(&self, model: &Model, spacing: Spacing) -> MapOptions {
        let stance = self.options.stance();
        let held = match (model, self.placed.feasible().and_then(Placement::space)) {
            (Model::Planar(_), _) => None,
            (Model::Spatial(_), None) => Some(HeldPosture { elevation: stance.elevation, ..HeldPosture::TOOL_DOWN }),
            (Model::Spatial(spatial), Some(hold)) => {
                let any_roll = stance.roll.is_none() && spatial.arm().tool_turns_about_axis_6();
                Some(HeldPosture {
                    elevation: stance.elevation,
                    yaw: hold.yaw,
                    roll: (!any_roll).then_some(hold.roll),
                    configuration: Some(hold.configuration),
                })
            }
        };
        MapOptions { held, ..MapOptions::over(spacing, self.options.load) }
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let notes = match self.model {
            ModelKind::Planar => String::new(),
            ModelKind::Spatial(_) => format!(
                "all six drives compliant, everything else rigid\nclearance: {}, at the poses of the answer; ",
                words::links_are(&self.robot)
            ),
        };
        let around = match self.model {
            ModelKind::Planar => String::new(),
            ModelKind::Spatial(_) => told_cell::known_about([&self.robot].into_iter(), self.options.cell.as_ref()),
        };
        // The plane has no joint angles to tell.
        let pendant = match self.model {
            ModelKind::Planar => String::new(),
            ModelKind::Spatial(_) => words::pendant_note(&self.robot),
        };
        let holds = self.tolerance_mm.map_or_else(String::new, |_| format!("{HOLDS}\n"));
        let (assumed, status) = (words::assumed_architecture([&self.robot]), words::statuses([&self.robot]));
        format!("{assumed}{status}{pendant}{notes}{around}{holds}")
    }

    fn lines(&self, best: &Placement) -> Vec<Line> {
        let [x, z] = best.centre;
        let mut lines = vec![
            line(worst_label(best), format!("{:.4} mm", best.deflection * 1e3)),
            line(self.bound_label(), proof(best, &self.options)),
        ];
        lines.extend(uncertainty::told(&self.robot, self.known().map(|known| known.spread)));
        lines.push(line(self.centre_label(best), format!("x {x:.4} m, z {z:.4} m")));
        match self.options.cell {
            None => lines.extend(outside(best).map(|note| line("note", note))),
            Some(cell) => {
                let [x, y, z] = best.in_cell(&cell).map(|part| fixed(part, 4));
                lines.push(line(format!("{} in the cell", centre(best)), format!("x {x} m, y {y} m, z {z} m")));
            }
        }
        match best.space() {
            None => {
                lines.push(line("angle of the first side", degrees(best.angle)));
                lines.push(line("elbow", best.elbow.name()));
                let kept = |(least, of)| line(SMALLEST_MARGIN, format!("{} ({})", degrees(least), margins::of(of)));
                lines.extend(best.smallest_margin().map(kept));
            }
            Some(_) if !best.faces.is_empty() => {
                lines.push(line("turned about the vertical", degrees(best.angle)));
                lines.extend(best.faces.iter().map(face_line));
            }
            Some(hold) => lines.extend(self.stance_lines(best, hold)),
        }
        lines.extend(self.stand_of_path().map(|stand| self.path_line(stand)));
        let [wx, wy, wz] = best.worst_point.map(|part| fixed(part, 4));
        let [near, far] = [format!("x {wx} m"), format!("z {wz} m")];
        let worst = if best.space().is_some() { format!("{near}, y {wy} m, {far}") } else { format!("{near}, {far}") };
        lines.push(line(WORST_POINT, worst));
        lines.extend(self.clearance().map(|clearance| words::clearance(&clearance)));
        lines.extend(best.space().into_iter().flat_map(hold_lines));
        if let Some((tolerance, verdict)) = self.tolerance_mm.zip(self.verdict()) {
            let says = format!("{}, margin {} mm", verdict.told(), fixed(verdict.margin_mm, 4));
            lines.push(line(format!("tolerance {tolerance} mm"), says));
        }
        lines
    }

    /// Where a path over the work stands, as it is typed.
    fn path_line(&self, [x, y, z, yaw]: [f64; 4]) -> Line {
        let [x, y, z] = [x, y, z].map(|metres| fixed(metres, 4));
        let middle = if self.task.work.part().is_some() { "its underside" } else { "the zone" };
        let yaw = fixed(yaw.to_degrees(), 2);
        line(
            "for mill --at",
            format!("{x},{y},{z},{yaw} (origin of the path in the middle of {middle}, x along its first side)"),
        )
    }

    /// What the line is called that says where it stands.
    fn centre_label(&self, best: &Placement) -> String {
        format!("{} from {}", centre(best), words::origin(&self.robot))
    }

    /// What the lower bound is called, by what it is of.
    fn bound_label(&self) -> &'static str {
        if self.is_at_one_place() { "proved lower bound there" } else { "proved lower bound" }
    }

    fn stance_lines(&self, best: &Placement, hold: &SpaceHold) -> Vec<Line> {
        let mut lines = Vec::new();
        if hold.bearing != 0.0 {
            let turned =
                format!("{} about the joint-1 axis, where limits and cell allow the zone", degrees(hold.bearing));
            lines.push(line("turned", turned));
        }
        if !self.options.stance().is_vertical() {
            lines.push(line("yaw of the zone's plane", degrees(hold.yaw)));
        }
        lines.push(line("angle of the first side", degrees(best.angle)));
        lines.push(line("roll of the tool", degrees(hold.roll)));
        lines.push(line("configuration", hold.configuration.to_string()));
        let is_free = self.options.margins.radius(&self.robot) == 0.0;
        if let Some(near) = best.from_axis_1.filter(|near| is_free && *near < COLUMN) {
            let near = format!("{near:.2} m; the robot's own base stands there, --clear-of-base-m keeps away");
            lines.push(line("nearest to the joint-1 axis", near));
        }
        lines
    }
}

/// What the line is called that says how far the tool is pushed off.
fn worst_label(best: &Placement) -> &'static str {
    if best.faces.is_empty() { "worst deflection in the zone" } else { "worst deflection on the part" }
}

/// What of it stands there.
fn centre(best: &Placement) -> &'static str {
    if best.faces.is_empty() { "centre" } else { "middle of its underside" }
}

/// One face of a part.
fn face_line(found: &FacePlacement) -> Line {
    let FacePlacement { face, deflection, hold, .. } = found;
    let says = format!(
        "{:.4} mm; {}, tool rolled by {}; {} from a joint limit, {} from a straight posture",
        deflection * 1e3,
        hold.configuration,
        degrees(hold.roll),
        degrees(hold.limit_margin.0),
        degrees(hold.singular_margin),
    );
    line(face.name.clone(), says)
}

/// The same for machines.
fn face_record(found: &FacePlacement) -> Record {
    let FacePlacement { face, centre, deflection, lower_bound, worst_point, hold } = found;
    let mut record = Record::new();
    record
        .put(field::FACE, &face.name)
        .put(field::FACE_CENTRE, *centre)
        .put(field::TOOL_DIRECTION, words::asked_degrees(face.elevation))
        .put(field::YAW, hold.yaw)
        .put(field::ROLL, hold.roll)
        .put(field::DEFLECTION, *deflection)
        .put(field::LOWER_BOUND, *lower_bound)
        .put(field::SHOULDER, hold.configuration.shoulder.name())
        .put(field::ELBOW, hold.configuration.elbow.name())
        .put(field::WRIST, hold.configuration.wrist.name())
        .put(field::WORST_POINT, *worst_point)
        .put(field::WORST_JOINTS, hold.joints)
        .put(field::WORST_SHARES, hold.shares)
        .put(field::LIMIT_MARGIN, hold.limit_margin.0)
        .put(field::LIMIT_MARGIN_JOINT, hold.limit_margin.1)
        .put(field::SINGULAR_MARGIN, hold.singular_margin);
    record
}

fn hold_lines(hold: &SpaceHold) -> Vec<Line> {
    let joints = hold.joints.map(|angle| fixed(angle.to_degrees(), 1));
    let (margin, joint) = hold.limit_margin;
    let which = if joint == 0 { "the angle between the links".into() } else { format!("joint {joint}") };
    let found = &hold.resolution;
    let coarse = found.coarse.map_or_else(|| "no whole zone there".into(), |best| format!("best {:.4} mm", best * 1e3));
    vec![
        line("joints there, as reported", format!("{} deg", joints.join(", "))),
        line("share of drives 1-6", percentages(&hold.shares)),
        line("nearest limit", format!("{which}, {} away", degrees(margin))),
        line("nearest singular posture", format!("{} away", degrees(hold.singular_margin))),
        line(
            "search",
            format!(
                "grid of {:.0} mm ({coarse}), refined to {:.2} mm and {:.3} deg",
                found.coarse_step * 1e3,
                found.fine_step * 1e3,
                found.fine_turn.to_degrees()
            ),
        ),
        line(
            "poses in the zone",
            format!(
                "{}, at most {:.1} mm apart; halving that changed the value by {:.2} %",
                found.samples,
                found.sample_step * 1e3,
                found.halving * 100.0
            ),
        ),
    ]
}

/// The lower bound and how far it lies from the value.
fn proof(best: &Placement, options: &PlaceOptions) -> String {
    let (gap, lower) = (best.gap(), best.lower_bound * 1e3);
    let asked = options.gap();
    match best.space().map(|hold| hold.resolution.boxes) {
        None if gap < 1e-11 => format!("{lower:.4} mm (exact)"),
        // So near to the gap that was asked for the digits that are told agree.
        None if asked * 1.05 < gap => {
            format!("{lower:.4} mm (gap {gap:.1e}; {asked:.1e} was asked for and took more boxes than are looked at)")
        }
        None => format!("{lower:.4} mm (gap {gap:.1e})"),
        Some(boxes) if best.lower_bound <= 0.0 && 0.0 < gap => format!("nothing is proved ({boxes} boxes)"),
        Some(boxes) => format!("{lower:.4} mm (proved with {boxes} boxes; gap {:.1} %)", 100.0 * gap),
    }
}

/// Says where a place lies partly below the base or behind the joint-1 axis: reached, but rarely meant.
fn outside(best: &Placement) -> Option<String> {
    let Outside { below, behind } = best.outside?;
    let place = match (below, behind) {
        (false, false) => return None,
        (true, false) => "below the base",
        (false, true) => "behind the joint-1 axis",
        (true, true) => "below the base and behind the joint-1 axis",
    };
    Some(format!("part of it lies {place}; --within and --floor say where it may stand"))
}

/// How large a zone of the shape would fit.
fn largest(task: &Task, scale: f64) -> String {
    if scale == 0.0 {
        "none: no zone of this shape fits, however small".into()
    } else {
        format!("{scale:.4} of the size asked for ({})", task.work.scaled(scale).describe())
    }
}

/// One zone of one robot: the same fields whatever the model and whatever was found.
pub(super) fn cell(
    robot: &Robot,
    task: &Task,
    (model, options): (&ModelKind, &PlaceOptions),
    placed: Result<&Placed, &PlaceError>,
    (tolerance_mm, known): (Option<f64>, Option<Known>),
) -> Record {
    let best = placed.ok().and_then(Placed::feasible);
    let mut record = Record::new();
    stiffness::put_robot(&mut record, robot);
    record.put(field::TASK, &task.label).put(field::MODEL, model.name());
    force::put(&mut record, options.load);
    payload::FlangeLoad::of(options.tool_weight, model, options.load.newtons()).by(robot).put(&mut record);
    asked(&mut record, robot, model, options);
    outcome(&mut record, placed);
    record
        .put(field::DEFLECTION, best.map(|best| best.deflection))
        .put(field::LOWER_BOUND, best.map(|best| best.lower_bound))
        .put(field::X, best.map(|best| best.centre[0]))
        .put(field::Z, best.map(|best| best.centre[1]));
    let clearance = best.and_then(|best| clearance(robot, (model, options), task, best));
    held(&mut record, (robot, best, clearance), options.cell.as_ref());
    uncertainty::put(&mut record, known.map(|known| known.spread));
    let held = tolerance_mm.zip(best).map(|(tolerance, best)| Verdict::of(best.deflection, tolerance));
    let held = held.map(|held| held.with(known.and_then(|known| known.holds)));
    verdict::put(&mut record, tolerance_mm, held, best.is_none() && placed.is_ok());
    record
}

/// How near the arm comes to anything at a place.
pub(super) fn clearance(
    robot: &Robot,
    (model, options): (&ModelKind, &PlaceOptions),
    task: &Task,
    best: &Placement,
) -> Option<Clearance> {
    let model = model.of(robot).expect("the model that has found the place");
    best.clearance(&model, &task.work, &options.margins)
}

/// Adds what was sought beside a placement.
pub(super) fn put_advice(record: &mut Record, found: Option<&Advice>, asked: advice::Asked) {
    record.put(field::ADVICE, found.map(|found| advice::record(found, asked)));
}

/// What was asked of a model, with what it takes where nothing was said.
fn asked(record: &mut Record, robot: &Robot, model: &ModelKind, options: &PlaceOptions) {
    let flange_from_tool = match model {
        ModelKind::Planar => None,
        ModelKind::Spatial(flange_from_tool) => Some(flange_from_tool),
    };
    let in_cell = options.cell.is_some_and(|cell| cell.windows().next().is_some());
    let Within { x, z } = margins::window(options, model, robot);
    let ends = |range: Interval| [range.min(), range.max()].map(|end| end.is_finite().then_some(end));
    record
        .put(field::TOOL, flange_from_tool.map(tool_mm))
        .put(field::TOOL_DIRECTION, flange_from_tool.map(|_| words::asked_degrees(told_cell::elevation(options))))
        .put(field::WITHIN, if in_cell { Datum::Absent } else { Datum::Numbers([ends(x), ends(z)].concat()) })
        .put(field::ROBOT_CELL, options.cell.map(|cell| told_cell::record(&cell)));
    margins::put(record, options, robot);
}

/// Whether there is a place, and why not.
fn outcome(record: &mut Record, placed: Result<&Placed, &PlaceError>) {
    let (feasible, reason, proved, scale) = match placed {
        Ok(Placed::Feasible(_)) => (Some(true), None, None, None),
        Ok(Placed::Infeasible { reason, is_proved, largest_scale }) => {
            (Some(false), Some(reason.to_string()), Some(*is_proved), *largest_scale)
        }
        Err(error) => (None, Some(error.to_string()), None, None),
    };
    record
        .put(field::FEASIBLE, feasible)
        .put(field::REASON, reason)
        .put(field::PROVED, proved)
        .put(field::LARGEST_SCALE, scale);
}

/// How the zone stands and what holds it.
fn held(
    record: &mut Record,
    (robot, best, clearance): (&Robot, Option<&Placement>, Option<Clearance>),
    cell: Option<&Cell>,
) {
    let hold = best.and_then(Placement::space);
    let of = |value: fn(&SpaceHold) -> f64| hold.map(value);
    let margin = best.and_then(Placement::smallest_margin);
    let wide = clearance.and_then(|clearance| clearance.wide);
    record
        .put(field::BEARING, of(|hold| hold.bearing))
        .put(field::YAW, of(|hold| hold.yaw))
        .put(field::ANGLE, best.map(|best| best.angle))
        .put(field::ROLL, of(|hold| hold.roll))
        .put(field::SHOULDER, hold.map(|hold| hold.configuration.shoulder.name()))
        .put(field::ELBOW, best.map(|best| best.elbow.name()))
        .put(field::WRIST, hold.map(|hold| hold.configuration.wrist.name()))
        .put(field::WORST_POINT, best.map(|best| best.worst_point))
        .put(field::FROM_AXIS_1, best.and_then(|best| best.from_axis_1))
        .put(field::BELOW_BASE, best.and_then(|best| best.outside).map(|outside| outside.below))
        .put(field::BEHIND_AXIS_1, best.and_then(|best| best.outside).map(|outside| outside.behind))
        .put(field::WORST_JOINTS, hold.map(|hold| hold.joints))
        .put(field::PENDANT, hold.and(robot.pendant()).map(Pendant::name))
        .put(field::WORST_SHARES, hold.map(|hold| hold.shares))
        .put(field::LIMIT_MARGIN, of(|hold| hold.limit_margin.0))
        .put(field::LIMIT_MARGIN_JOINT, hold.map(|hold| hold.limit_margin.1))
        .put(field::SINGULAR_MARGIN, of(|hold| hold.singular_margin))
        .put(field::SMALLEST_MARGIN, margin.map(|(least, _)| least))
        .put(field::SMALLEST_MARGIN_OF, margin.map(|(_, of)| margins::of(of)))
        .put(field::CLEARANCE, clearance.map(|clearance| clearance.distance))
        .put(field::CLEARANCE_OF, clearance.map(|clearance| words::clearance_of(&clearance)))
        .put(field::CLEARANCE_ESTIMATED, clearance.map(|clearance| clearance.is_estimated))
        .put(field::CLEARANCE_OUTSIDE, clearance.map(|clearance| clearance.outside))
        .put(field::CLEARANCE_WIDE, wide.map(|wide| wide.distance))
        .put(field::CLEARANCE_WIDE_OF, wide.map(|wide| words::bodies(wide.link, wide.to)))
        .put(field::CELL_CENTRE, best.zip(cell).map(|(best, cell)| best.in_cell(cell)))
        .put(field::RESOLUTION, hold.map(|hold| resolution(&hold.resolution)))
        .put(field::FACES, faces(best));
}

/// Every face of a part; null of one flat zone.
fn faces(best: Option<&Placement>) -> Datum {
    let faces = best.map(|best| &best.faces).filter(|faces| !faces.is_empty());
    faces.map_or(Datum::Absent, |faces| Datum::Nested(faces.iter().map(|face| face_record(face).json()).collect()))
}

fn resolution(found: &Resolution) -> Record {
    let mut record = Record::new();
    record
        .put(field::COARSE_STEP, found.coarse_step)
        .put(field::COARSE, found.coarse)
        .put(field::FINE_STEP, found.fine_step)
        .put(field::FINE_TURN, found.fine_turn)
        .put(field::SAMPLE_STEP, found.sample_step)
        .put(field::SAMPLES, found.samples)
        .put(field::HALVING, found.halving)
        .put(field::BOXES, found.boxes);
    record
}
