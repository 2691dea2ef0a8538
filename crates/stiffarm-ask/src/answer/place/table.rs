//! A placement for people.

use super::super::cell as cell_report;
use super::super::stiffness::{self, stiffness};
use super::super::verdict::HOLDS;
use super::super::words::{COLUMN, degrees, direction, fixed, percentages, tool};
use super::super::{Line, Table, advice, line, margins, uncertainty, words};
use super::PlaceAnswer;
use stiffarm::clearance::Clearance;
use stiffarm::model::ModelKind;
use stiffarm::place::{FacePlacement, Outside, PlaceOptions, Placed, Placement, SpaceHold};
use stiffarm::task::Task;

const NO_PLACE: &str = "no place";
const SMALLEST_MARGIN: &str = "smallest margin";
const WORST_POINT: &str = "worst point";

impl PlaceAnswer {
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
                lines.push(line("task", format!("{zone}, {}", direction(cell_report::elevation(&self.options)))));
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
        // In a cell other lines stand between.
        let kept_by = if options.cell.is_some() { "the work keeps" } else { "" };
        lines.extend(margins::column(&options.margins, robot).map(|kept| line(kept_by, kept)));
        lines.push(line("margins", margins::angles(&options.margins)));
        match placed {
            Placed::Feasible(best) => lines.extend(self.lines(best)),
            Placed::Infeasible { reason, is_proved, largest_scale } => {
                let proof = words::proved_none(*is_proved, *largest_scale);
                lines.push(line(NO_PLACE, format!("{reason}{proof}")));
                let scale = largest_scale.filter(|_| self.advice.is_none());
                lines.extend(scale.map(|scale| line("largest zone of this shape", largest(task, scale))));
            }
        }
        lines.extend(self.advice.iter().flat_map(|found| advice::lines(found, (task, options.load))));
        let best = placed.feasible();
        let (decides, means) = best
            .map_or((NO_PLACE, "why there is no place"), |best| (worst_label(best), "worst deflection at the place"));
        // A row that says more than a distance, such as what may touch, is not what its fields say already.
        let is_distance = |clearance: &Clearance| {
            let between = words::clearance_between(clearance);
            words::collision(clearance).is_none() && clearance.knows_tool && between == words::clearance_of(clearance)
        };
        let clearance = self.clearance().filter(is_distance).map(|clearance| words::clearance(&clearance)[0].clone());
        let centre = best.map(|best| self.centre_label(best));
        let repeated = ["robot", SMALLEST_MARGIN, WORST_POINT].into_iter();
        let repeated: Vec<&str> = repeated.chain(clearance.as_deref()).chain(centre.as_deref()).collect();
        Table::of_lines(lines).led_by([decides, stiffness::LINE], means, &repeated)
    }

    /// Where the zone may stand.
    fn allowed_lines(&self) -> Vec<Line> {
        let Self { robot, model, options, .. } = self;
        match options.cell {
            None => {
                let allowed = words::window(&margins::window(options, model, robot), words::origin(robot));
                let turned = if self.is_turned() { ", at any bearing about the joint-1 axis" } else { "" };
                vec![line("allowed place", format!("{allowed}{turned}"))]
            }
            Some(cell) => {
                let lines = cell_report::lines(&cell, &options.within(model)).into_iter();
                lines.chain(cell_report::proof(&cell).filter(|_| self.placed.feasible().is_some())).collect()
            }
        }
    }

    /// The same in one line.
    pub(in crate::answer) fn allowed(&self) -> String {
        let lines = self.allowed_lines();
        let parts = lines
            .iter()
            .map(|[name, says]| if name == "allowed place" { says.clone() } else { format!("{name}: {says}") });
        parts.collect::<Vec<_>>().join("; ")
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
            ModelKind::Spatial(_) => cell_report::known_about([&self.robot].into_iter(), self.options.cell.as_ref()),
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
        lines.extend(uncertainty::row(&self.robot, self.known().map(|known| known.spread)));
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
            Some(hold) => lines.extend(self.orientation_lines(best, hold)),
        }
        lines.extend(self.stand_of_path().map(|stand| self.path_line(stand)));
        let [wx, wy, wz] = best.worst_point.map(|part| fixed(part, 4));
        let [near, far] = [format!("x {wx} m"), format!("z {wz} m")];
        let worst = if best.space().is_some() { format!("{near}, y {wy} m, {far}") } else { format!("{near}, {far}") };
        lines.push(line(WORST_POINT, worst));
        lines.extend(self.clearance().map(|clearance| words::clearance(&clearance)));
        lines.extend(best.space().into_iter().flat_map(hold_lines));
        if let Some((tolerance, verdict)) = self.tolerance_mm.zip(self.verdict()) {
            let says = format!("{}, margin {} mm", verdict.in_words(), fixed(verdict.margin_mm, 4));
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

    /// The zone stands about the joint-1 axis from where its centre is told.
    fn is_turned(&self) -> bool {
        self.best().and_then(Placement::space).is_some_and(|hold| hold.bearing != 0.0)
    }

    /// Which way the first side points, where that is not what its angle says from straight ahead of the base.
    fn pointing(&self, best: &Placement, hold: &SpaceHold) -> String {
        let (elevation, cell) = (self.options.tool_orientation().elevation, self.options.cell.as_ref());
        let is_plain = cell.is_none() && hold.bearing == 0.0 && elevation < 0.0;
        let Some(side) = best.first_side(elevation, cell).filter(|_| !is_plain) else { return String::new() };
        let [x, y, z] = side.map(|part| fixed(part, 3));
        let axes = if cell.is_some() { "in the cell" } else { "from the base" };
        format!(" (it points to x {x}, y {y}, z {z} {axes})")
    }

    /// What the line is called that says where it stands.
    fn centre_label(&self, best: &Placement) -> String {
        let turned = if self.is_turned() { ", before it is turned" } else { "" };
        format!("{} from {}{turned}", centre(best), words::origin(&self.robot))
    }

    /// What the lower bound is called, by what it is of.
    fn bound_label(&self) -> &'static str {
        if self.is_at_one_place() { "proved lower bound there" } else { "proved lower bound" }
    }

    fn orientation_lines(&self, best: &Placement, hold: &SpaceHold) -> Vec<Line> {
        let mut lines = Vec::new();
        if hold.bearing != 0.0 {
            let turned =
                format!("{} about the joint-1 axis, where limits and cell allow the zone", degrees(hold.bearing));
            lines.push(line("turned", turned));
        }
        if !self.options.tool_orientation().is_vertical() {
            lines.push(line("yaw of the zone's plane", degrees(hold.yaw)));
        }
        lines.push(line("angle of the first side", format!("{}{}", degrees(best.angle), self.pointing(best, hold))));
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
            if found.coarse_step == 0.0 {
                format!("at one place, turns refined to {:.3} deg", found.fine_turn.to_degrees())
            } else {
                format!(
                    "grid of {:.0} mm ({coarse}), refined to {:.2} mm and {:.3} deg",
                    found.coarse_step * 1e3,
                    found.fine_step * 1e3,
                    found.fine_turn.to_degrees()
                )
            },
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
        // So near to the gap that was asked for the digits that are shown agree.
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
