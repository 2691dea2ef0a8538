//! What does a request ask of an identification?

use super::{Refusal, Request, Verb, opt};
use stiffarm::catalogue::measurements::{Marker, Points};
use stiffarm::identify::{Options, Springs};

impl Request {
    /// The table of measurements.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn data(&self) -> Result<String, Refusal> {
        self.required(opt::DATA)
    }

    /// Where in the flange frame loads act and markers sit.
    pub fn points(&self) -> Points {
        Points { load: self.get(opt::LOAD_MM), markers: self.markers() }
    }

    fn markers(&self) -> Vec<Marker> {
        self.all(opt::MARKER_MM)
    }

    /// How is identified.
    pub fn identification(&self) -> Options {
        Options {
            load_axes: self.value(opt::LOAD_AXES),
            moved_axes: self.value(opt::DISPLACEMENT_AXES),
            estimator: self.value(opt::FIT),
            model: self.value(opt::SPRINGS),
            regions: self.value(opt::REGIONS),
            with_prior: self.is_set(opt::PRIOR),
            date: self.date(),
        }
    }

    /// Regions are a matter of one model, and of the choice among all.
    pub(super) fn check_regions(&self) -> Result<(), Refusal> {
        if self.verb != Verb::Identify || !self.is_given(opt::REGIONS) {
            return Ok(());
        }
        if matches!(self.value(opt::SPRINGS), Springs::Regions | Springs::Auto) {
            return Ok(());
        }
        Err(self.refused(opt::REGIONS, "says nothing of this model; expected the model regions, or auto".into()))
    }

    /// Several markers are distinguished by names.
    pub(super) fn check_markers(&self) -> Result<(), Refusal> {
        if !matches!(self.verb, Verb::Identify | Verb::Measure) {
            return Ok(());
        }
        let markers = self.markers();
        if 1 < markers.len() && markers.iter().any(|marker| marker.name.is_none()) {
            return Err(
                self.refused(opt::MARKER_MM, "is given several times; expected each with a name, name=x,y,z".into())
            );
        }
        let twice =
            markers.iter().enumerate().find(|(i, marker)| markers[..*i].iter().any(|other| other.name == marker.name));
        let name = twice.and_then(|(_, marker)| marker.name.clone());
        name.map_or(Ok(()), |name| Err(self.refused(opt::MARKER_MM, format!("names the marker {name} twice"))))
    }
}
