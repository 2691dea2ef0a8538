//! What is asked of how an arm swings.

use stiffarm::chatter::{Asked, HeldBy, MeasuredTip};
use stiffarm::mass::{RigidBody, ToolWeight};
use stiffarm::mill::MillHeld;
use stiffarm::modes::{Damping, HeldTool};
use stiffarm::place::PlaceOptions;
use stiffarm::task::{Task, Zone};

use super::{Refusal, Request, Verb, opt};

impl Request {
    /// What the arm holds: the tool frame, and a body where the tool's mass is given.
    ///
    /// # Errors
    /// A mass without its centre, or an inertia without a mass.
    pub fn held_tool(&self) -> Result<HeldTool, Refusal> {
        let mut tool = HeldTool { flange_from_tool: self.tool_pose().tool(), body: None };
        let Some(ToolWeight { mass, centre }) = self.tool_weight() else {
            let is_lone = self.is_given(opt::TOOL_INERTIA_KG_M2);
            return if is_lone { Err(self.missing(opt::TOOL_MASS_KG)) } else { Ok(tool) };
        };
        let centre = centre.ok_or_else(|| self.missing(opt::TOOL_COM_MM))?;
        let inertia: Vec<f64> = self.all(opt::TOOL_INERTIA_KG_M2);
        let body = inertia
            .try_into()
            .map_or_else(|_| RigidBody::point(mass, centre), |inertia: [f64; 6]| RigidBody::new(mass, centre, inertia));
        tool.body = Some(body);
        Ok(tool)
    }

    /// Damping of every mode, where it is given.
    pub fn damping(&self) -> Option<Damping> {
        self.get(opt::DAMPING_RATIO).map(Damping::Ratio)
    }

    /// Is it asked how the arm swings over a zone, rather than at one posture?
    pub fn swings_over_zone(&self) -> bool {
        self.verb == Verb::Modes && self.is_given(opt::FLAT_TASK)
    }

    /// The zone over which it is asked how the arm swings, and how it is placed.
    ///
    /// # Errors
    /// Where zone or place are missing, or together have no answer.
    pub fn swinging_zone(&self) -> Result<(Task<Zone>, PlaceOptions), Refusal> {
        let task = self.flat_task()?;
        if !self.is_given(opt::AT) {
            return Err(self.missing(opt::AT));
        }
        let options = self.place_options(Some(task.work))?;
        Ok((task, options))
    }

    /// The table of what was measured at a tip, and what held it.
    pub fn frf(&self) -> Option<(String, HeldBy)> {
        Some((self.get(opt::FRF)?, self.get(opt::FRF_ON)?))
    }

    /// What is asked of a cut that may swing, with what was measured at its tip.
    ///
    /// # Errors
    /// Where the feed is missing, or none.
    pub fn chatter<'a>(&self, measured: Option<&'a MeasuredTip>) -> Result<Asked<'a>, Refusal> {
        let feed: [f64; 3] = self.all(opt::FEED).try_into().map_err(|_| self.missing(opt::FEED))?;
        if feed == [0.0; 3] {
            return Err(self.refused(opt::FEED, "is 0,0,0; expected a direction, such as 1,0,0".into()));
        }
        Ok(Asked { feed, damping: self.damping(), method: self.get(opt::METHOD), measured })
    }

    /// It is asked whether the cuts of a path swing.
    pub fn asks_chatter(&self) -> bool {
        self.is_set(opt::CHATTER)
    }

    /// What swings along a path, where it is asked whether its cuts do, with what was measured at the tip.
    ///
    /// # Errors
    /// A mass without its centre.
    pub fn path_chatter(&self, measured: Option<&MeasuredTip>) -> Result<Option<MillHeld>, Refusal> {
        if !self.asks_chatter() {
            return Ok(None);
        }
        Ok(Some(MillHeld { body: self.held_tool()?.body, damping: self.damping(), measured: measured.cloned() }))
    }

    /// How many modes are reported.
    pub fn mode_count(&self) -> usize {
        self.value(opt::COUNT)
    }
}
