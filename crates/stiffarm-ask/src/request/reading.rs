//! What does a request ask of readings of an arm?

use super::kind::Value;
use super::{Request, Verb};
use stiffarm::calibrate::{CalibrateOptions, Level, Work};
use stiffarm::calibration::ControllerModel;
use stiffarm::catalogue::readings::ReadOptions;
use stiffarm::verify::VerifyOptions;

impl Request {
    /// How a table of readings is read, of a robot of this maker.
    pub fn reading(&self, vendor: &str) -> ReadOptions {
        let columns = self
            .all("columns", |value| if let Value::Heading(ours, theirs) = value { Some((ours, theirs)) } else { None });
        ReadOptions { columns, frame_by: self.texts("frame-by").pop(), vendor: vendor.into() }
    }

    /// How an arm is calibrated.
    pub fn calibration(&self) -> CalibrateOptions {
        let level = Level::ALL.into_iter().find(|level| self.word("level") == Some(level.name()));
        let model = ControllerModel::ALL.into_iter().find(|model| self.word("controller-model") == Some(model.name()));
        let at = self.all("at", super::wishes::number);
        let work = if let &[x, y, z] = at.as_slice() { Work::Near([x, y, z]) } else { Work::Anywhere };
        CalibrateOptions { level, work, controller: model }
    }

    /// What is known of the frames of readings.
    pub fn verification(&self) -> VerifyOptions {
        let frame = |name| self.one(name, |value| if let Value::Tool(pose) = value { Some(pose) } else { None });
        VerifyOptions { base: frame("base-mm"), tool: frame("tool-mm") }
    }

    /// All robots of the catalogue are tried.
    pub fn tries_all(&self) -> bool {
        self.is_wished("any")
    }

    /// Readings of a robot that nobody has named.
    pub fn is_of_any_robot(&self) -> bool {
        self.verb == Verb::Verify && self.tries_all() && !self.is_given("robot")
    }

    /// When was measured, where that was said.
    pub fn date(&self) -> Option<String> {
        self.texts("date").pop()
    }
}
