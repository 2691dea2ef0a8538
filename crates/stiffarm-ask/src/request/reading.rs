//! What does a request ask of readings of an arm?

use super::{Request, Verb, opt};
use stiffarm::calibrate::{CalibrateOptions, Work};
use stiffarm::catalogue::readings::ReadOptions;
use stiffarm::verify::VerifyOptions;

impl Request {
    /// How a table of readings is read, of a robot of this maker.
    pub fn reading(&self, vendor: &str) -> ReadOptions {
        let columns = self.all(opt::HEADINGS);
        ReadOptions { columns, frame_by: self.get(opt::FRAME_BY), vendor: vendor.into() }
    }

    /// How an arm is calibrated.
    pub fn calibration(&self) -> CalibrateOptions {
        let at = self.all(opt::AT);
        let work = if let &[x, y, z] = at.as_slice() { Work::Near([x, y, z]) } else { Work::Anywhere };
        CalibrateOptions { level: self.value(opt::LEVEL), work, controller: self.get(opt::CONTROLLER_MODEL) }
    }

    /// What is known of the frames of readings.
    pub fn verification(&self) -> VerifyOptions {
        VerifyOptions { base: self.get(opt::BASE_MM), tool: self.get(opt::TOOL_MM) }
    }

    /// All robots of the catalogue are tried.
    pub fn tries_all(&self) -> bool {
        self.is_set(opt::ANY)
    }

    /// Readings of a robot that nobody has named.
    pub fn is_of_any_robot(&self) -> bool {
        self.verb == Verb::Verify && self.tries_all() && !self.is_given(opt::ROBOT)
    }

    /// When was measured, where that was said.
    pub fn date(&self) -> Option<String> {
        self.get(opt::DATE)
    }
}
