//! What is asked of how an arm swings.

use stiffarm::chatter::{Asked, HeldBy, MeasuredTip, Method};
use stiffarm::mass::{RigidBody, ToolWeight};
use stiffarm::mill::MillHeld;
use stiffarm::modes::{Damping, HeldTool};
use stiffarm::place::PlaceOptions;
use stiffarm::task::Task;

use super::wishes::number;
use super::{Refusal, Request, Verb};

impl Request {
    /// What the arm holds: the tool frame, and a body where the tool's mass is told.
    ///
    /// # Errors
    /// A mass without its centre, or an inertia without a mass.
    pub fn held_tool(&self) -> Result<HeldTool, Refusal> {
        let mut tool = HeldTool { flange_from_tool: self.held().tool(), body: None };
        let Some(ToolWeight { mass, centre }) = self.tool_weight() else {
            let is_lone = self.is_given("tool-inertia-kg-m2");
            return if is_lone { Err(self.missing("tool-mass-kg")) } else { Ok(tool) };
        };
        let centre = centre.ok_or_else(|| self.missing("tool-com-mm"))?;
        let inertia: Vec<f64> = self.all("tool-inertia-kg-m2", number);
        let body = inertia
            .try_into()
            .map_or_else(|_| RigidBody::point(mass, centre), |inertia: [f64; 6]| RigidBody::new(mass, centre, inertia));
        tool.body = Some(body);
        Ok(tool)
    }

    /// Damping of every mode, where it is given.
    pub fn damping(&self) -> Option<Damping> {
        self.number("damping-ratio").map(Damping::Ratio)
    }

    /// Is it asked how the arm swings over a zone, rather than at one posture?
    pub fn swings_over_zone(&self) -> bool {
        self.verb == Verb::Modes && self.is_given("task")
    }

    /// The zone over which it is asked how the arm swings, and how it is placed.
    ///
    /// # Errors
    /// Where zone or place are missing, or together have no answer.
    pub fn swinging_zone(&self) -> Result<(Task, PlaceOptions), Refusal> {
        let task = self.task()?;
        if !self.is_given("at") {
            return Err(self.missing("at"));
        }
        let options = self.place_options(Some(task.zone))?;
        Ok((task, options))
    }

    /// The table of what was measured at a tip, and what held it.
    pub fn frf(&self) -> Option<(String, HeldBy)> {
        let held_by = if self.word("frf-on")? == "robot" { HeldBy::Robot } else { HeldBy::Rigid };
        Some((self.texts("frf").pop()?, held_by))
    }

    /// What is asked of a cut that may swing, with what was measured at its tip.
    ///
    /// # Errors
    /// Where the feed is missing.
    pub fn chatter<'a>(&self, measured: Option<&'a MeasuredTip>) -> Result<Asked<'a>, Refusal> {
        let feed: [f64; 3] = self.all("feed", number).try_into().map_err(|_| self.missing("feed"))?;
        let method = self.word("method").map(|word| if word == "teeth" { Method::Teeth } else { Method::Mean });
        Ok(Asked { feed, damping: self.damping(), method, measured })
    }

    /// What swings along a path, where it is asked whether its cuts do, with what was measured at the tip.
    ///
    /// # Errors
    /// A mass without its centre.
    pub fn path_chatter(&self, measured: Option<&MeasuredTip>) -> Result<Option<MillHeld>, Refusal> {
        if !self.is_wished("chatter") {
            return Ok(None);
        }
        Ok(Some(MillHeld { body: self.held_tool()?.body, damping: self.damping(), measured: measured.cloned() }))
    }

    /// How many modes are told.
    pub fn mode_count(&self) -> usize {
        self.count("count")
    }
}
