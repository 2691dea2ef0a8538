//! What does a request ask of a plan of measurements?

use nalgebra::Vector3;

use super::{Refusal, Request, Verb, opt};
use stiffarm::measure::{Cone, Criterion, Instrument, Options};

impl Request {
    /// What is asked of a plan; the postures of the work are left out.
    ///
    /// # Panics
    /// Of a verb that plans nothing.
    pub fn measurement_plan(&self) -> Options {
        let points = self.points();
        let load_at = Vector3::from(points.load.unwrap_or_default());
        let markers: Vec<Vector3<f64>> = points.markers.iter().map(|marker| marker.at.into()).collect();
        let window = self.get(opt::WINDOW);
        Options {
            criterion: self.value(opt::CRITERION),
            // Nothing is loaded where an arm is calibrated.
            ways: if self.plans_geometry() { Vec::new() } else { self.all(opt::LOADS) },
            newtons: self.value(opt::LOAD_FORCE_N),
            load_at,
            markers: if markers.is_empty() { vec![load_at] } else { markers },
            sigma: self.value(opt::SIGMA_MM) / 1e3,
            posture_sigma: self.value(opt::POSTURE_SIGMA_MM) / 1e3,
            runs: self.value(opt::RUNS),
            repeats: self.value(opt::REPEATS),
            candidates: self.value(opt::CANDIDATES),
            window: window.map(|block| [block.x, block.y, block.z]),
            instrument: self.instrument(),
            work: Vec::new(),
            tool: self.tool_pose().tool().translation.vector,
        }
    }

    /// Postures to calibrate an arm are asked for, and no loads.
    pub fn plans_geometry(&self) -> bool {
        self.verb == Verb::Measure && self.is_set(opt::GEOMETRY)
    }

    /// What says nothing where an arm is calibrated.
    fn check_geometry(&self) -> Result<(), Refusal> {
        /// Readings of more are not read.
        const MOST_MARKERS: usize = 4;
        /// More would take a gigabyte.
        const MOST_CANDIDATES: usize = 20_000;
        const LOADS: [&str; 9] = [
            opt::LOADS.name,
            opt::LOAD_FORCE_N.name,
            opt::LOAD_MM.name,
            opt::CRITERION.name,
            opt::REPEATS.name,
            opt::OWN_TABLE.name,
            opt::STIFFNESS.name,
            opt::DRIVE_URAD_PER_NM.name,
            opt::STIFFNESS_NM_PER_RAD.name,
        ];
        if let Some(name) = LOADS.into_iter().find(|name| self.is_given(name)) {
            let why = "says nothing beside geometry: nothing is loaded, and no posture is measured twice";
            return Err(self.refused(name, why.into()));
        }
        if let Some(name) = [opt::TOOL_MM.name, opt::TOOL.name]
            .into_iter()
            .find(|name| !self.is_given(opt::FLAT_TASK) && self.is_given(name))
        {
            let why = "says nothing beside geometry without a task: the points sit in the flange frame";
            return Err(self.refused(name, why.into()));
        }
        let (markers, candidates) = (self.points().markers.len(), self.value(opt::CANDIDATES));
        if MOST_MARKERS < markers {
            return Err(self.refused(opt::MARKER_MM, format!("of {markers} points; expected at most {MOST_MARKERS}")));
        }
        if MOST_CANDIDATES < candidates {
            return Err(self.refused(
                opt::CANDIDATES,
                format!("{candidates}; expected at most {MOST_CANDIDATES} beside geometry"),
            ));
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
        let (runs, candidates) = (self.value(opt::RUNS), self.value(opt::CANDIDATES));
        let repeats = if self.plans_geometry() { 1 } else { self.value(opt::REPEATS) };
        let most = candidates.saturating_mul(repeats);
        if most < runs {
            let each = if repeats == 1 { String::new() } else { format!(", each at most {repeats} times") };
            let why = format!("of {runs} among {candidates} candidates{each}; expected at most {most}");
            return Err(self.refused(opt::RUNS, why));
        }
        let is_of_work = self.value(opt::CRITERION) == Criterion::Prediction;
        match [opt::FLAT_TASK.name, opt::TOOL_MM.name].into_iter().find(|name| !is_of_work && self.is_given(name)) {
            Some(name) => {
                let why = "says nothing where the drives themselves are judged; expected the criterion prediction";
                Err(self.refused(name, why.into()))
            }
            None => Ok(()),
        }
    }

    /// Where it stands, and from where markers are seen.
    fn instrument(&self) -> Option<Instrument> {
        let &[x, y, z] = self.all(opt::INSTRUMENT).as_slice() else { return None };
        let faces = self.get(opt::MARKER_FACES);
        let acceptance = self.value(opt::ACCEPTANCE_DEG).to_radians();
        let cone = faces.map(|faces| Cone { faces: faces.into(), acceptance });
        Some(Instrument { at: Vector3::new(x, y, z), cone })
    }

    /// A table of one's own; what a study compares is none.
    pub fn compared(&self) -> Option<String> {
        self.get(opt::OWN_TABLE)
    }
}
