//! `stiffarm map`: the deflection over everything a robot reaches.

use std::io::{self, Write};

use crate::answer::words::{class, direction, mapped, origin, tool, window};
use crate::answer::{MapAnswer, PlaceAnswer, Rows, Unit, stiffness};
use crate::request::{Layer, Request};
use serde_json::Value;
use stiffarm::map::{Grid, MapError, PointsBetween, map_watched};
use stiffarm::model::{ArmPosture, Model, ModelKind};
use stiffarm::modes::first_frequencies;
use stiffarm::palette::FORCE;
use stiffarm::place::{Placement, Within, place};
use stiffarm::watch::Watch;

use super::context::Context;
use super::drawing::{arm, force, scene};
use crate::error::AskError;
use crate::exports;
use crate::figures::FigureSize;
use crate::figures::bands::Colours;
use crate::figures::face::FaceFigure;
use crate::figures::map::MapFigure;
use crate::figures::scene::{ZoneMark, rim};
use crate::figures::sheets::Ways;
use crate::figures::view3d::{Arrow, Cell, Surface, View, Zone};
use crate::forms::{Answer, Forms, Makes, Picture, Piece, Sketch, pretty};

pub(crate) fn answer(asked: &Request, context: Context) -> Result<MapOutput, AskError> {
    let (kind, options) = (asked.model(), asked.map_options());
    let (figure_size, tolerance_mm) = (FigureSize::of(asked)?, asked.tolerance_mm());
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let failure = |error| AskError::Map { robot: robot.name.clone(), error };
    let model = kind.of(&robot).map_err(|error| failure(error.into()))?;
    let map =
        context.watched("mapping", |watch| map_watched(&model, &options, watch)).map_err(|error| match error {
            MapError::NothingReached => {
                let towards = direction(asked.tool_pose().elevation());
                AskError::Usage(format!("{}: no point is reached with the {towards}", robot.name))
            }
            error => failure(error),
        })?;
    let frequency = if asked.maps_frequency() {
        let tool = asked.held_tool()?;
        Some((first_frequencies(&model, &map, &options, &tool).map_err(AskError::Modes)?, tool))
    } else {
        None
    };
    let zone = match asked.zone() {
        None => None,
        Some(task) => {
            let options = asked.place_options(Some(task.work))?;
            let search = |watch: Watch| place(&model, &task.work.into(), &options, watch);
            let placed = context
                .watched("searching places", search)
                .map_err(|error| AskError::Place { robot: robot.name.clone(), error })?;
            if placed.feasible().is_none() {
                context.listener.remark(&format!(
                    "note: {} has no place for {}; `stiffarm place` says why",
                    robot.name, task.label
                ));
            }
            let robot = robot.clone();
            Some(PlaceAnswer { robot, model: kind, task: task.into(), options, placed, tolerance_mm, advice: None })
        }
    };
    Ok(MapOutput {
        layer: asked.layer(),
        answer: MapAnswer { model, options, map, zone, frequency },
        figure_size,
        tolerance_mm,
    })
}

/// How long a force is drawn in space, m.
const FORCE_DRAWN: f64 = 0.4;

pub(crate) struct MapOutput {
    answer: MapAnswer,
    /// What the figure shows.
    layer: Layer,
    figure_size: FigureSize,
    tolerance_mm: Option<f64>,
}

impl MapOutput {
    fn drawn(&self) -> Drawn<'_> {
        let Self { layer, figure_size, tolerance_mm, .. } = *self;
        Drawn { layer, figure_size, tolerance_mm, ..Drawn::of_zone(&self.answer) }
    }
}

/// A map as it is drawn.
pub(crate) struct Drawn<'a> {
    pub(crate) answer: &'a MapAnswer,
    pub(crate) layer: Layer,
    pub(crate) subtitle: String,
    /// The arm that is drawn.
    pub(crate) posture: Option<ArmPosture>,
    pub(crate) mark: Option<ZoneMark>,
    pub(crate) face: Option<FaceFigure>,
    /// What was asked of the figure.
    pub(crate) figure_size: FigureSize,
    /// What the work allows.
    pub(crate) tolerance_mm: Option<f64>,
}

impl<'a> Drawn<'a> {
    /// The deflection, the arm at the worst point of the zone, or at the stiffest point where there is none.
    pub(crate) fn of_zone(answer: &'a MapAnswer) -> Self {
        let best = answer.zone.as_ref().and_then(|zone| zone.placed.feasible());
        let posture = answer.posture();
        let tolerance_mm = answer.zone.as_ref().and_then(|zone| zone.tolerance_mm);
        let mark = answer.zone.as_ref().zip(best).and_then(|(placed, best)| mark(placed, best));
        Self {
            answer,
            layer: Layer::Deflection,
            subtitle: subtitle(answer),
            posture,
            mark,
            face: None,
            figure_size: FigureSize::default(),
            tolerance_mm,
        }
    }

    pub(crate) fn colour_label(&self) -> String {
        match self.layer {
            Layer::Deflection => format!("{} [mm]", mapped(self.answer.options.load)),
            Layer::LimitMargin => "nearest joint limit [deg]".into(),
            Layer::SingularMargin => "nearest singular posture [deg]".into(),
            Layer::FirstFrequency => "first frequency of the arm, motors held still [Hz]".into(),
        }
    }

    fn origin(&self) -> &'static str {
        origin(self.answer.model.robot())
    }

    /// The numbers that are shown, their unit, and what their colours stand for.
    fn shown(&self) -> (&'a Grid, Unit, Colours) {
        let map = &self.answer.map;
        if let (Layer::FirstFrequency, Some((frequency, _))) = (self.layer, &self.answer.frequency) {
            return (&frequency.hertz, Unit::Given("hz"), Colours::Frequencies);
        }
        match (self.layer, &map.space) {
            (Layer::LimitMargin, Some(margins)) => (&margins.limits, Unit::Degree, Colours::Margins),
            (Layer::SingularMargin, Some(margins)) => (&margins.singular, Unit::Degree, Colours::Margins),
            _ => (&map.deflection, Unit::Millimetre, Colours::Deflections),
        }
    }

    pub(crate) fn svg(self) -> Result<String, AskError> {
        Ok(self.figure().svg()?)
    }

    /// What is drawn.
    pub(crate) fn figure(self) -> MapFigure<'a> {
        let model = &self.answer.model;
        let (grid, unit, colours) = self.shown();
        let placed = self.answer.zone.as_ref();
        let (colour_label, origin) = (self.colour_label(), self.origin());
        let mut scene = scene(model, self.posture, self.mark);
        scene.windows.extend(placed.iter().flat_map(|zone| zone.windows()).map(|within| [within.x, within.z]));
        scene.keep_outs.extend(placed.iter().flat_map(|zone| zone.keep_outs()).map(|block| [block.x, block.z]));
        scene.raised = placed.and_then(|zone| zone.options.cell?.mount.raised()).unwrap_or(0.0);
        scene.force = force(self.answer.options.load);
        let edge = match model {
            Model::Planar(model) => Some((model.arm(), model.axis_from_base())),
            Model::Spatial(_) => None,
        };
        let ways = match (model, &self.answer.map.space) {
            (Model::Spatial(model), Some(margins)) => Some(Ways {
                at: Box::new(|i, j| margins.at(i, j)),
                between: PointsBetween::of(model, &self.answer.options),
            }),
            _ => None,
        };
        MapFigure {
            title: model.robot().full_name(),
            map: grid,
            unit,
            colours,
            tolerance: self.tolerance_mm.filter(|_| colours == Colours::Deflections),
            figure_size: self.figure_size,
            edge,
            ways,
            colour_label,
            origin,
            scene,
            subtitle: self.subtitle,
            face: self.face,
        }
    }

    /// The map, the arm and the zone in their plane, which stands beside the joint-1 axis where the arm does.
    pub(crate) fn view(self) -> View {
        let MapAnswer { model, zone, .. } = self.answer;
        let (grid, unit, colours) = self.shown();
        let (y, note) = match model {
            Model::Planar(model) => (model.aside(), format!("section in the arm plane, m from {}", self.origin())),
            Model::Spatial(_) => (0.0, "the section stands for every direction about the joint-1 axis".to_owned()),
        };
        let cell = zone.as_ref().and_then(|zone| zone.options.cell);
        let best = zone.as_ref().and_then(|zone| zone.placed.feasible());
        let colour_label = self.colour_label();
        let zone = best.zip(self.mark).map(|(best, mark)| Zone {
            rim: mark.rim.iter().map(|&[x, z]| [x, y, z]).collect(),
            worst: Some(Cell { at: best.worst_point, mm: Some(Unit::Millimetre.of_si(best.deflection)) }),
            label: mark.label,
            surface: None,
        });
        let arm = arm(model, self.posture, None);
        let at = arm.as_ref().and_then(|arm| arm.points.last()).map(|(at, _)| *at);
        let arrows = force(self.answer.options.load).zip(at).map(|(force, at)| {
            let [x, z] = force.towards.map(|part| FORCE_DRAWN * part);
            Arrow { label: force.label, at, along: [x, 0.0, z], colour: FORCE }
        });
        View {
            title: model.robot().full_name(),
            notes: vec![self.subtitle, note],
            arm,
            zone,
            section: Some(Surface::of_map(grid, unit, y)),
            colour_label,
            colours,
            scale: self.figure_size.ends(),
            arrows: arrows.into_iter().collect(),
            floor: model.knows_base(),
            cell,
            ..View::default()
        }
    }
}

fn subtitle(answer: &MapAnswer) -> String {
    let MapAnswer { model, options, zone, .. } = answer;
    let start = format!("{}; {}", class(model.robot()), stiffness(model.robot()));
    match model.kind() {
        ModelKind::Planar => {
            let in_words = |within: &Within| window(within, origin(model.robot()));
            let windows: Vec<String> =
                zone.iter().flat_map(PlaceAnswer::windows).map(|within| in_words(&within)).collect();
            let within =
                if windows.is_empty() { String::new() } else { format!("; zone within {}", windows.join(" or ")) };
            let side = match options.elbow {
                Some(elbow) => format!("only with the elbow {}", elbow.name()),
                None => "with the stiffer elbow side at each point".into(),
            };
            format!("{start}; {}, planar model, {side}{within}", mapped(options.load))
        }
        ModelKind::Spatial(flange_from_tool) => {
            let held = options.held();
            let (towards, tool) = (direction(held.elevation), tool(&flange_from_tool));
            let posture = match held.configuration {
                Some(configuration) => format!("only {configuration}"),
                None => "in the stiffest posture of each point".into(),
            };
            let roll = held.roll.map_or_else(
                || ", at its best roll".into(),
                |roll| format!(", rolled by {} deg", (Unit::Degree.of_si(roll) * 1e6).round() / 1e6),
            );
            let swings = answer.swings_with().map_or_else(String::new, |tool| format!("; {tool}"));
            format!("{start}; all six drives, {towards}, tool: {tool}; {posture}{roll}{swings}")
        }
    }
}

/// A zone in the plane of its map.
fn mark(placed: &PlaceAnswer, best: &Placement) -> Option<ZoneMark> {
    let (zone, [x, _, z]) = (placed.task.work.zone()?, best.worst_point);
    Some(ZoneMark {
        zone,
        rim: rim(zone, best.centre, best.angle),
        worst_point: [x, z],
        label: format!("{}: {:.3} mm at worst", placed.task.label, Unit::Millimetre.of_si(best.deflection)),
    })
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms =
    Forms { command: "map", makes: &[Makes::Picture(Picture::Figure), Makes::View, Makes::Image] };

impl Answer for MapOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.answer.table()), Piece::Break, Piece::Lines(self.answer.notes())]
    }

    fn value(&self) -> Value {
        self.answer.head_json()
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer)
    }

    fn sketch(&self, _points: usize) -> Option<Result<Sketch, AskError>> {
        Some(Ok(super::sketch::of_map(&self.answer)))
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(self.drawn().svg())
    }

    fn view(&self) -> Option<Result<View, AskError>> {
        Some(Ok(self.drawn().view()))
    }

    fn image(&self) -> Option<String> {
        Some(exports::image(&self.answer))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
