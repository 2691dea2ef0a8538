//! `stiffarm map`: the deflection over everything a robot reaches.

use std::io::{self, Write};
use std::path::Path;

use stiffarm::answer::words::{class, direction, mapped, origin, tool, window};
use stiffarm::answer::{MapAnswer, PlaceAnswer, Rows, Unit, stiffness};
use stiffarm::map::{MapError, map};
use stiffarm::model::{ArmPosture, Model, ModelKind};
use stiffarm::place::{Placement, place};
use stiffarm::request::{Layer, Request};

use super::drawing::{arm, scene};
use super::waiting;
use crate::args::Common;
use crate::failure::Failure;
use crate::figures::face::FaceFigure;
use crate::figures::map::MapFigure;
use crate::figures::scene::{ZoneMark, rim};
use crate::figures::view3d::{Cell, Sheet, View, Zone};
use crate::look::Look;
use crate::output::{Answer, Outputs, figure, pretty, say};
use crate::selection;
use crate::table::{prose, shown};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let (name, kind, options) = (asked.robot()?, asked.model(), asked.map_options());
    let robot = asked.equipped(selection::robot(&name, common)?)?;
    let outputs = Outputs::open::<MapOutput>(common, &[Path::new(&name)])?;
    let failure = |error| Failure::Map { robot: robot.name.clone(), error };
    let model = kind.of(&robot).map_err(|error| failure(error.into()))?;
    let map = waiting("mapping", common, || map(&model, &options)).map_err(|error| match error {
        MapError::NothingReached => {
            let towards = direction(asked.held().elevation());
            Failure::Usage(format!("{}: no point is reached with the {towards}", robot.name))
        }
        error => failure(error),
    })?;
    let zone = match asked.zone() {
        None => None,
        Some(task) => {
            let options = asked.place_options(Some(task.zone))?;
            let placed = waiting("searching places", common, || place(&model, task.zone, &options))
                .map_err(|error| Failure::Place { robot: robot.name.clone(), error })?;
            if placed.feasible().is_none() && !common.quiet {
                say(&format!("note: {} has no place for {}; `stiffarm place` says why", robot.name, task.label));
            }
            let robot = robot.clone();
            Some(PlaceAnswer { robot, model: kind, task, options, placed, tolerance_mm: None })
        }
    };
    outputs.deliver(&MapOutput { layer: asked.layer(), answer: MapAnswer { model, options, map, zone } })
}

struct MapOutput {
    answer: MapAnswer,
    /// What the figure shows.
    layer: Layer,
}

/// A map as it is drawn.
pub(super) struct Drawn<'a> {
    pub(super) answer: &'a MapAnswer,
    pub(super) layer: Layer,
    pub(super) subtitle: String,
    /// The arm that is drawn.
    pub(super) posture: Option<ArmPosture>,
    pub(super) mark: Option<ZoneMark>,
    pub(super) face: Option<FaceFigure>,
}

impl<'a> Drawn<'a> {
    /// The deflection, the arm at the worst point of the zone, or at the stiffest point where there is none.
    pub(super) fn of_zone(answer: &'a MapAnswer) -> Self {
        let best = answer.zone.as_ref().and_then(|zone| zone.placed.feasible());
        let posture = answer.posture();
        let mark = answer.zone.as_ref().zip(best).map(|(zone, best)| mark(zone, best));
        Self { answer, layer: Layer::Deflection, subtitle: subtitle(answer), posture, mark, face: None }
    }

    pub(super) fn colour_label(&self) -> String {
        match self.layer {
            Layer::Deflection => format!("{} [mm]", mapped(self.answer.options.load)),
            Layer::LimitMargin => "nearest joint limit [deg]".into(),
            Layer::SingularMargin => "nearest singular posture [deg]".into(),
        }
    }

    fn origin(&self) -> &'static str {
        origin(self.answer.model.robot())
    }

    pub(super) fn svg(self) -> Result<String, Failure> {
        let MapAnswer { model, map, .. } = self.answer;
        let (grid, unit, ends) = match (self.layer, &map.space) {
            (Layer::LimitMargin, Some(margins)) => (&margins.limits, Unit::Degree, ["near", "far"]),
            (Layer::SingularMargin, Some(margins)) => (&margins.singular, Unit::Degree, ["near", "far"]),
            _ => (&map.deflection, Unit::Millimetre, ["stiff", "soft"]),
        };
        let edge = match model {
            Model::Planar(model) => Some((model.arm(), model.axis_from_base())),
            Model::Spatial(_) => None,
        };
        let drawn = MapFigure {
            title: model.robot().full_name(),
            map: grid,
            unit,
            ends,
            edge,
            colour_label: self.colour_label(),
            origin: self.origin(),
            scene: scene(model, self.posture, self.mark),
            subtitle: self.subtitle,
            face: self.face,
        };
        drawn.svg().map_err(figure)
    }

    /// The map, the arm and the zone in their plane, which stands beside the joint-1 axis where the arm does.
    pub(super) fn view(self) -> View {
        let MapAnswer { model, map, zone, .. } = self.answer;
        let (y, note) = match model {
            Model::Planar(model) => (model.aside(), format!("section in the arm plane, m from {}", self.origin())),
            Model::Spatial(_) => (0.0, "the section stands for every direction about the joint-1 axis".to_owned()),
        };
        let best = zone.as_ref().and_then(|zone| zone.placed.feasible());
        let colour_label = self.colour_label();
        let zone = best.zip(self.mark).map(|(best, mark)| Zone {
            rim: mark.rim.iter().map(|&[x, z]| [x, y, z]).collect(),
            worst: Some(Cell { at: best.worst_point, mm: Some(Unit::Millimetre.told(best.deflection)) }),
            label: mark.label,
            sheet: None,
        });
        View {
            title: model.robot().full_name(),
            notes: vec![self.subtitle, note],
            arm: arm(model, self.posture, None),
            zone,
            section: Some(Sheet::of_map(&map.deflection, y)),
            colour_label,
            floor: model.knows_base(),
            ..View::default()
        }
    }
}

fn subtitle(answer: &MapAnswer) -> String {
    let MapAnswer { model, options, zone, .. } = answer;
    let start = format!("{}; {}", class(model.robot()), stiffness(model.robot()));
    match model.kind() {
        ModelKind::Planar => {
            let within = zone.as_ref().and_then(|zone| zone.placed.feasible().and(zone.options.within));
            let within = within
                .map_or_else(String::new, |within| format!("; zone within {}", window(&within, origin(model.robot()))));
            format!("{start}; {}, planar model{within}", mapped(options.load))
        }
        ModelKind::Spatial(flange_from_tool) => {
            let towards = direction(options.held().elevation);
            let tool = tool(&flange_from_tool);
            format!("{start}; all six drives, {towards}, tool: {tool}; drawn at the stiffest point")
        }
    }
}

/// A zone in the plane of its map.
fn mark(zone: &PlaceAnswer, best: &Placement) -> ZoneMark {
    let [x, _, z] = best.worst_point;
    ZoneMark {
        zone: zone.task.zone,
        rim: rim(zone.task.zone, best.centre, best.angle),
        worst_point: [x, z],
        label: format!("{}: {:.3} mm at worst", zone.task.label, Unit::Millimetre.told(best.deflection)),
    }
}

impl Answer for MapOutput {
    const COMMAND: &'static str = "map";
    const FURTHER: &'static [&'static str] = &["svg", "png", "html"];

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&self.answer.table(), look), prose(&self.answer.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer)
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(Drawn { layer: self.layer, ..Drawn::of_zone(&self.answer) }.svg())
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        Some(Ok(Drawn::of_zone(&self.answer).view()))
    }
}
