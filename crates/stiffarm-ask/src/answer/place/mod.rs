//! How is a placement reported?

mod record;
mod table;

use serde_json::Value;

use super::uncertainty::Known;
use super::verdict::Verdict;
use super::words::fixed;
use super::{Rows, margins, payload, shape, with_schema, words};
pub(super) use record::{clearance, put_advice, put_placement, verdict_at};
use stiffarm::advice::Advice;
use stiffarm::cell::Window;
use stiffarm::clearance::Clearance;
use stiffarm::map::{HeldPosture, MapOptions, Spacing};
use stiffarm::model::{Model, ModelKind};
use stiffarm::place::{PlaceOptions, Placed, Placement, Within};
use stiffarm::robot::Robot;
use stiffarm::task::Task;

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
    /// What that says of force, stiffness and size, where advice was asked for.
    pub advice: Option<Advice>,
}

impl PlaceAnswer {
    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("place", words::origin(&self.robot), &self.record())
    }

    /// One row for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::PLACEMENT, [self.record()])
    }

    /// Where the deflection at the best place lies, and how likely it keeps the tolerance; `None` where the drive stiffness has no stated uncertainty.
    pub(super) fn known(&self) -> Option<Known> {
        Known::at(&self.robot, self.options.load, self.best(), self.tolerance_mm)
    }

    /// Whether the tolerance is kept at the best place; `None` where there is none of the two.
    pub fn verdict(&self) -> Option<Verdict> {
        let (tolerance, best) = self.tolerance_mm.zip(self.best())?;
        Some(verdict_at(best, tolerance, self.known(), (self.clearance().as_ref(), self.carried())))
    }

    /// The best place, where there is one.
    pub fn best(&self) -> Option<&Placement> {
        self.placed.feasible()
    }

    /// How near the arm comes to anything at the best place.
    pub(super) fn clearance(&self) -> Option<Clearance> {
        clearance(&self.robot, (&self.model, &self.options), &self.task, self.best()?)
    }

    /// The same where they overlap: a place that must not be chosen.
    pub(super) fn collision(&self) -> Option<Clearance> {
        self.clearance().filter(Clearance::is_collision)
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
        if let Some(clearance) = self.collision() {
            let [name, says] = words::clearance(&clearance);
            return Some(format!("{}: {name}, {says}", robot.name));
        }
        if let Some(exceeded) = self.carried().exceeded() {
            return Some(format!("{}: {exceeded}", robot.name));
        }
        let tolerance = (*tolerance_mm)?;
        let fails = !Verdict::of(best.deflection, tolerance).passes;
        let deflection = fixed(best.deflection * 1e3, 4);
        fails.then(|| format!("{}: {deflection} mm on {}, tolerance {tolerance} mm", robot.name, task.label))
    }

    /// What the robot must hold.
    pub(super) fn carried(&self) -> payload::Carried {
        payload::FlangeLoad::of(self.options.tool_weight, &self.model, self.options.load.newtons()).by(&self.robot)
    }

    /// Where a picture of the plane straight ahead of the answer shows that the zone may stand, m from the base.
    pub fn windows(&self) -> Vec<Within> {
        let ahead = || margins::windows(&self.options, &self.model, &self.robot);
        let Some(cell) = self.options.cell else { return ahead() };
        // One of two ranges lies straight ahead of a base that is raised, too.
        if cell.windows().next().is_none() && self.options.within.is_some() {
            return ahead();
        }
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
        let tool_orientation = self.options.tool_orientation();
        let held = match (model, self.placed.feasible().and_then(Placement::space)) {
            (Model::Planar(_), _) => None,
            (Model::Spatial(_), None) => {
                Some(HeldPosture { elevation: tool_orientation.elevation, ..HeldPosture::TOOL_DOWN })
            }
            (Model::Spatial(spatial), Some(hold)) => {
                let any_roll = tool_orientation.roll.is_none() && spatial.arm().tool_turns_about_axis_6();
                Some(HeldPosture {
                    elevation: tool_orientation.elevation,
                    yaw: hold.yaw,
                    roll: (!any_roll).then_some(hold.roll),
                    configuration: Some(hold.configuration),
                })
            }
        };
        MapOptions { held, ..MapOptions::over(spacing, self.options.load) }
    }
}
