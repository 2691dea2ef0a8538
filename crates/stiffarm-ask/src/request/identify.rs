//! What does a request ask of an identification?

use super::kind::Value;
use super::{Refusal, Request, Verb};
use stiffarm::catalogue::measurements::{Marker, Points};
use stiffarm::identify::{Axes, Estimator, Options, Springs};

impl Request {
    /// The table of measurements.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn data(&self) -> Result<String, Refusal> {
        self.texts("data").pop().ok_or_else(|| self.missing("data"))
    }

    /// Where in the flange frame loads act and markers sit.
    pub fn points(&self) -> Points {
        let point = |value| if let Value::Point(point) = value { Some(point) } else { None };
        Points { load: self.one("load-mm", point), markers: self.markers() }
    }

    fn markers(&self) -> Vec<Marker> {
        self.all("marker-mm", |value| if let Value::Marker(marker) = value { Some(marker) } else { None })
    }

    /// How is identified.
    pub fn identification(&self) -> Options {
        let axes = |name: &str| if self.word(name) == Some("flange") { Axes::Flange } else { Axes::Base };
        let estimator = if self.word("fit") == Some("huber") { Estimator::Huber } else { Estimator::LeastSquares };
        Options {
            load_axes: axes("force-axes"),
            moved_axes: axes("displacement-axes"),
            estimator,
            model: match self.word("model") {
                Some("base") => Springs::Base,
                Some("tool") => Springs::Tool,
                Some("base-and-tool") => Springs::All,
                Some("compensator") => Springs::Compensator,
                Some("compensator-and-preload") => Springs::Preload,
                Some("regions") => Springs::Regions,
                Some("auto") => Springs::Auto,
                _ => Springs::Drives,
            },
            regions: self.count("regions"),
            with_prior: self.is_wished("prior"),
            date: self.date(),
        }
    }

    /// Regions are a matter of one model, and of the choice among all.
    pub(super) fn check_regions(&self) -> Result<(), Refusal> {
        let has_regions = matches!(self.word("model"), Some("regions" | "auto"));
        if self.verb != Verb::Identify || !self.is_given("regions") || has_regions {
            return Ok(());
        }
        Err(self.refused("regions", "says nothing of this model; expected the model regions, or auto".into()))
    }

    /// Several markers are told apart by names.
    pub(super) fn check_markers(&self) -> Result<(), Refusal> {
        if !matches!(self.verb, Verb::Identify | Verb::Measure) {
            return Ok(());
        }
        let markers = self.markers();
        if 1 < markers.len() && markers.iter().any(|marker| marker.name.is_none()) {
            return Err(
                self.refused("marker-mm", "is given several times; expected each with a name, name=x,y,z".into())
            );
        }
        let twice =
            markers.iter().enumerate().find(|(i, marker)| markers[..*i].iter().any(|other| other.name == marker.name));
        let name = twice.and_then(|(_, marker)| marker.name.clone());
        name.map_or(Ok(()), |name| Err(self.refused("marker-mm", format!("names the marker {name} twice"))))
    }
}
