//! A placement, and what draws it: the map with the zone, the zone itself, a view in space.

use serde_json::json;
use stiffarm::advice::advise;
use stiffarm::map::{Spacing, map};
use stiffarm::model::{ArmPosture, Model, ModelError, ModelKind};
use stiffarm::place::{Placed, Placement, SpaceHold, ZonePoint, deflection_field, place};
use stiffarm::robot::Robot;
use stiffarm::task::{Work, Zone};
use stiffarm::watch::Watch;

use crate::answer::words::{class, direction, tool};
use crate::answer::{MapAnswer, PlaceAnswer, Unit, stiffness};
use crate::ask::context::{Context, under_process};
use crate::ask::drawing;
use crate::ask::map::Drawn;
use crate::ask::reports::Inputs;
use crate::ask::sketch::{from_the_side, sketched};
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::face::FaceFigure;
use crate::figures::scene::{ZoneMark, rim};
use crate::figures::view3d::{self, Cell, Point, Surface, View};
use crate::forms::Sketch;
use crate::request::Request;

/// Points along the longer side of the map that is drawn, in the arm plane and in space.
const FIGURE_SIZE: [usize; 2] = [400, 300];
/// Points along the longer side of a map that someone else draws, at most.
const MOST_SKETCHED: usize = 2000;
/// Points along each side of the zone that are drawn.
const FACE_SIZE: usize = 33;

/// A placement, and what is needed to draw it.
pub(crate) struct PlaceOutput {
    model: Model,
    pub(crate) answer: PlaceAnswer,
    pub(crate) figure_size: FigureSize,
    pub(crate) asked: Request,
    inputs: Inputs,
    /// Points along the longer side of the map.
    points: usize,
}

impl PlaceOutput {
    /// Places what is asked for, and seeks what its tolerance says of force, stiffness and size.
    pub(crate) fn of(asked: &Request, robot: Robot, context: Context) -> Result<Self, AskError> {
        let (task, kind, robot) = (asked.task()?, asked.model(), asked.equipped(robot)?);
        let options = under_process(asked, context)?.place_options(task.work.zone())?;
        let figure_size = FigureSize::of(asked)?;
        let failure = |error| AskError::Place { robot: robot.name.clone(), error };
        let model = kind.of(&robot).map_err(|error| failure(error.into()))?;
        let search = |watch: Watch| place(&model, &task.work, &options, watch);
        let placed = context.watched("searching places", search).map_err(failure)?;
        let tolerance_mm = asked.tolerance_mm();
        let advised = |mm: f64| {
            let advised = |watch: Watch| advise(&model, &task.work, &options, &placed, mm / 1e3, watch);
            context.watched("placing smaller zones", advised)
        };
        let advice = tolerance_mm.filter(|_| context.advises).map(advised).transpose().map_err(failure)?;
        let answer = PlaceAnswer { robot: robot.clone(), model: kind, task, options, placed, tolerance_mm, advice };
        let points = if kind == ModelKind::Planar { FIGURE_SIZE[0] } else { FIGURE_SIZE[1] };
        Ok(Self { model, answer, figure_size, asked: asked.clone(), inputs: Inputs::of(asked, context), points })
    }

    /// What it rests on that was read.
    pub(crate) fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// An answer that is there, with a map of so many points.
    pub(crate) fn of_answer(
        answer: PlaceAnswer,
        (asked, inputs): (&Request, Inputs),
        (figure_size, points): (FigureSize, usize),
    ) -> Result<Self, AskError> {
        let failure = |error: ModelError| AskError::Place { robot: answer.robot.name.clone(), error: error.into() };
        let model = answer.model.of(&answer.robot).map_err(failure)?;
        Ok(Self { model, answer, figure_size, asked: asked.clone(), inputs, points })
    }

    fn elevation(&self) -> f64 {
        self.answer.options.tool_orientation().elevation
    }

    /// What is drawn, where there is something.
    fn feasible(&self) -> Result<(Zone, &Placement), AskError> {
        let PlaceAnswer { robot, task, placed, .. } = &self.answer;
        match (&task.work, placed) {
            (Work::Part(_), Placed::Feasible(_)) => {
                let why = format!(
                    "{}: the map shows one flat zone, and {} is a part: `place` has its shop drawing (shop.svg) and its report; or take json, csv or md",
                    robot.name, task.label
                );
                Err(AskError::Usage(why))
            }
            (Work::Zone(zone), Placed::Feasible(best)) => Ok((*zone, best)),
            (_, Placed::Infeasible { reason, is_proved, .. }) => {
                let proof = if *is_proved { "; it is proved that there is none" } else { "" };
                let why = format!("{}: no place for {} to draw: {reason}{proof}", robot.name, task.label);
                Err(AskError::Figure(why))
            }
        }
    }

    /// The map of what is reached, held as the zone is.
    pub(crate) fn mapped(&self) -> Result<MapAnswer, AskError> {
        self.mapped_with(self.points)
    }

    fn mapped_with(&self, points: usize) -> Result<MapAnswer, AskError> {
        let Self { model, answer, .. } = self;
        let options = answer.map_options(model, Spacing::Points(points));
        let map = map(model, &options).map_err(|error| AskError::Map { robot: answer.robot.name.clone(), error })?;
        Ok(MapAnswer { model: model.clone(), options, map, zone: Some(answer.clone()), frequency: None })
    }

    fn subtitle(&self) -> String {
        let PlaceAnswer { robot, model, placed, .. } = &self.answer;
        let start = format!("{}; {}", class(robot), stiffness(robot));
        match (model, placed.feasible().and_then(Placement::space)) {
            (ModelKind::Spatial(flange_from_tool), Some(hold)) => {
                let (towards, tool) = (direction(self.elevation()), tool(flange_from_tool));
                format!("{start}; all six drives, {towards}, tool: {tool}; {}", hold.configuration)
            }
            _ => start,
        }
    }

    /// Points of the zone, given along its sides, with their deflections.
    fn field(&self, points: impl IntoIterator<Item = [f64; 2]>) -> Result<Vec<ZonePoint>, AskError> {
        let (_, best) = self.feasible()?;
        deflection_field(&self.model, &self.answer.options, best, points)
            .map_err(|error| AskError::Place { robot: self.answer.robot.name.clone(), error })
    }

    /// The zone row by row.
    fn face(&self) -> Result<Vec<ZonePoint>, AskError> {
        let side = |i: usize| 2.0 * i as f64 / (FACE_SIZE - 1) as f64 - 1.0;
        let nodes = (0..FACE_SIZE).flat_map(|j| (0..FACE_SIZE).map(move |i| [side(i), side(j)]));
        let (zone, _) = self.feasible()?;
        self.field(nodes.map(|node| zone.at(node)))
    }

    /// The rim of the zone, straight ahead.
    fn rim(&self) -> Result<Vec<Point>, AskError> {
        let (zone, _) = self.feasible()?;
        Ok(self.field(rim(zone, [0.0; 2], 0.0))?.iter().map(|point| point.at).collect())
    }

    fn drawn<'a>(&self, map: &'a MapAnswer) -> Drawn<'a> {
        Drawn { figure_size: self.figure_size, ..Drawn::of_zone(map) }
    }

    /// The zone on the section that points straight ahead, and what is seen along the tool axis.
    pub(crate) fn figure(&self, figure_size: FigureSize) -> Result<String, AskError> {
        let (zone, best) = self.feasible()?;
        let map = self.mapped()?;
        let Model::Spatial(_) = self.model else { return Drawn { figure_size, ..self.drawn(&map) }.svg() };
        let face = FaceFigure {
            zone,
            angle: best.angle,
            cells: self
                .face()?
                .iter()
                .map(|point| point.deflection.map(|metres| Unit::Millimetre.of_si(metres)))
                .collect(),
            per_side: FACE_SIZE,
            up: match self.answer.options.tool_orientation().is_vertical() {
                false => "upwards in its plane",
                true if self.elevation() < 0.0 => "ahead",
                true => "back",
            },
            colour_label: Drawn::of_zone(&map).colour_label(),
        };
        Drawn { face: Some(face), figure_size, ..self.placed(&map)? }.svg()
    }

    /// The map, where there is no zone to draw.
    pub(crate) fn map_alone(&self, figure_size: FigureSize) -> Result<String, AskError> {
        Drawn { figure_size, ..self.placed(&self.mapped()?)? }.svg()
    }

    /// The map with the zone at its place, in space as it is seen from the side; without it where it has none.
    pub(crate) fn placed<'a>(&self, map: &'a MapAnswer) -> Result<Drawn<'a>, AskError> {
        if let (Model::Planar(_), _) | (_, Placed::Infeasible { .. }) = (&self.model, &self.answer.placed) {
            return Ok(self.drawn(map));
        }
        let (zone, best) = self.feasible()?;
        let hold = best.space();
        let bearing = hold.map_or(0.0, |hold| hold.bearing);
        // Turned back: the section points straight ahead.
        let ((s, c), [wx, wy, wz]) = (bearing.sin_cos(), best.worst_point);
        let mark = ZoneMark {
            zone,
            rim: self.rim()?.into_iter().map(|[x, _, z]| [x, z]).collect(),
            worst_point: [c * wx + s * wy, wz],
            label: self.label(best),
        };
        Ok(Drawn {
            subtitle: self.subtitle(),
            posture: hold.map(|hold| ArmPosture::Joints(self.straight_ahead(hold))),
            mark: Some(mark),
            ..self.drawn(map)
        })
    }

    /// The joints at the worst point, the zone straight ahead.
    fn straight_ahead(&self, hold: &SpaceHold) -> [f64; 6] {
        let mut q = hold.joints;
        if let Model::Spatial(model) = &self.model {
            q[0] -= model.joint_1_sign() * hold.bearing;
        }
        q
    }

    /// The section as the zone is held, arm and rim straight ahead.
    pub(crate) fn sketched(&self, points: usize) -> Result<Sketch, AskError> {
        let (_, best) = self.feasible()?;
        let hold = best.space();
        let map = self.mapped_with(points.clamp(2, MOST_SKETCHED))?;
        let ((s, c), [x, y, z]) = (hold.map_or(0.0, |hold| hold.bearing).sin_cos(), best.worst_point);
        let posture = hold.map_or_else(|| best.posture(), |hold| ArmPosture::Joints(self.straight_ahead(hold)));
        let (robot, grid) = (&self.answer.robot, &map.map.deflection);
        let shown = json!({
            "title": robot.full_name(),
            "subtitle": format!("{}; {}, {} model", class(robot), stiffness(robot), self.answer.model.name()),
            "arm_m": from_the_side(self.model.points(&posture).unwrap_or_default()),
            "knows_base": self.model.knows_base(),
            "rim_m": from_the_side(self.rim()?),
            "worst_m": [c * x + s * y, z],
            "x_m": grid.x.points(),
            "z_m": grid.z.points(),
        });
        Ok(sketched(shown, &map))
    }

    fn label(&self, best: &Placement) -> String {
        format!("{}: {:.3} mm at worst", self.answer.task.label, Unit::Millimetre.of_si(best.deflection))
    }

    pub(crate) fn in_space(&self) -> Result<View, AskError> {
        let (_, best) = self.feasible()?;
        let hold = best.space();
        let map = self.mapped()?;
        let Model::Spatial(_) = self.model else { return Ok(self.drawn(&map).view()) };
        let (s, c) = hold.map_or(0.0, |hold| hold.bearing).sin_cos();
        let turned = |[x, y, z]: Point| [c * x - s * y, s * x + c * y, z];
        let cell = |point: &ZonePoint| Cell {
            at: turned(point.at),
            mm: point.deflection.map(|metres| Unit::Millimetre.of_si(metres)),
        };
        let face: Vec<Cell> = self.face()?.iter().map(cell).collect();
        let zone = view3d::Zone {
            label: self.label(best),
            rim: self.rim()?.into_iter().map(turned).collect(),
            surface: Some(Surface { rows: face.chunks(FACE_SIZE).map(<[Cell]>::to_vec).collect() }),
            worst: Some(Cell { at: best.worst_point, mm: Some(Unit::Millimetre.of_si(best.deflection)) }),
        };
        let mut section = Surface::of_map(&map.map.deflection, Unit::Millimetre, 0.0);
        section.rows.iter_mut().flatten().for_each(|cell| cell.at = turned(cell.at));
        let posture = hold.map(|hold| ArmPosture::Joints(hold.joints));
        Ok(View {
            title: self.answer.robot.full_name(),
            notes: vec![self.subtitle(), "arm at the worst point of the zone; section held as the zone is".into()],
            arm: drawing::arm(&self.model, posture, hold.map(|hold| &hold.shares)),
            zone: Some(zone),
            section: Some(section),
            colour_label: Drawn::of_zone(&map).colour_label(),
            scale: self.figure_size.ends(),
            floor: true,
            cell: self.answer.options.cell,
            ..View::default()
        })
    }
}
