//! What does a request ask of a plan of measurements?

use nalgebra::Vector3;

use super::kind::Value;
use super::{Refusal, Request, Verb};
use stiffarm::measure::{Cone, Criterion, Instrument, Options};

impl Request {
    /// What is asked of a plan; the postures of the work are left out.
    ///
    /// # Panics
    /// Of a verb that plans nothing.
    pub fn measurement_plan(&self) -> Options {
        let number = |name: &str| self.number(name).expect("the row has a default");
        let points = self.points();
        let load_at = Vector3::from(points.load.unwrap_or_default());
        let markers: Vec<Vector3<f64>> = points.markers.iter().map(|marker| marker.at.into()).collect();
        let window = self.one("window", |value| if let Value::Block(block) = value { Some(block) } else { None });
        Options {
            criterion: match self.word("criterion") {
                Some("a") => Criterion::A,
                Some("d") => Criterion::D,
                _ => Criterion::Prediction,
            },
            // Nothing is loaded where an arm is calibrated.
            ways: if self.plans_geometry() {
                Vec::new()
            } else {
                self.all("loads", |value| if let Value::Way(way) = value { Some(way) } else { None })
            },
            newtons: number("force-n"),
            load_at,
            markers: if markers.is_empty() { vec![load_at] } else { markers },
            sigma: number("sigma-mm") / 1e3,
            posture_sigma: number("posture-sigma-mm") / 1e3,
            runs: self.count("runs"),
            repeats: self.count("repeats"),
            candidates: self.count("candidates"),
            window: window.map(|block| [block.x, block.y, block.z]),
            instrument: self.instrument(),
            work: Vec::new(),
            tool: self.held().tool().translation.vector,
        }
    }

    /// Postures to calibrate an arm are asked for, and no loads.
    pub fn plans_geometry(&self) -> bool {
        self.verb == Verb::Measure && self.is_wished("geometry")
    }

    /// What says nothing where an arm is calibrated.
    fn check_geometry(&self) -> Result<(), Refusal> {
        /// Readings of more are not read.
        const MOST_MARKERS: usize = 4;
        /// More would take a gigabyte.
        const MOST_CANDIDATES: usize = 20_000;
        const LOADS: [&str; 9] = [
            "loads",
            "force-n",
            "load-mm",
            "criterion",
            "repeats",
            "compare",
            "stiffness",
            "drive-urad-per-nm",
            "stiffness-nm-per-rad",
        ];
        if let Some(name) = LOADS.into_iter().find(|name| self.is_given(name)) {
            let why = "says nothing beside geometry: nothing is loaded, and no posture is measured twice";
            return Err(self.refused(name, why.into()));
        }
        if let Some(name) = ["tool-mm", "tool"].into_iter().find(|name| !self.is_given("task") && self.is_given(name)) {
            let why = "says nothing beside geometry without a task: the points sit in the flange frame";
            return Err(self.refused(name, why.into()));
        }
        let (markers, candidates) = (self.points().markers.len(), self.count("candidates"));
        if MOST_MARKERS < markers {
            return Err(self.refused("marker-mm", format!("of {markers} points; expected at most {MOST_MARKERS}")));
        }
        if MOST_CANDIDATES < candidates {
            return Err(
                self.refused("candidates", format!("{candidates}; expected at most {MOST_CANDIDATES} beside geometry"))
            );
        }
        Ok(())
    }

    /// More runs than there are candidates would only repeat some; work is looked at by one criterion alone.
    pub(super) fn check_runs(&self) -> Result<(), Refusal> {
        if self.verb != Verb::Measure {
            return Ok(());
        }
        if self.plans_geometry() {
            self.check_geometry()?;
        }
        let (runs, candidates) = (self.count("runs"), self.count("candidates"));
        if candidates < runs {
            return Err(
                self.refused("runs", format!("of {runs} among {candidates} candidates; expected at most as many"))
            );
        }
        let is_of_work = !matches!(self.word("criterion"), Some("a" | "d"));
        match ["task", "tool-mm"].into_iter().find(|name| !is_of_work && self.is_given(name)) {
            Some(name) => {
                let why = "says nothing where the drives themselves are judged; expected the criterion prediction";
                Err(self.refused(name, why.into()))
            }
            None => Ok(()),
        }
    }

    /// Where it stands, and from where markers are seen.
    fn instrument(&self) -> Option<Instrument> {
        let &[x, y, z] = self.all("instrument", super::wishes::number).as_slice() else { return None };
        let faces = self.one("marker-faces", |value| if let Value::Point(unit) = value { Some(unit) } else { None });
        let acceptance = self.number("acceptance-deg").expect("the row has a default").to_radians();
        let cone = faces.map(|faces| Cone { faces: faces.into(), acceptance });
        Some(Instrument { at: Vector3::new(x, y, z), cone })
    }

    /// A table of one's own; what a study compares is none.
    pub fn compared(&self) -> Option<String> {
        if self.verb == Verb::Measure { self.texts("compare").pop() } else { None }
    }
}
