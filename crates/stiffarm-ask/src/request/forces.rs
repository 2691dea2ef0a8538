//! What force does a request mean? Its size, its axes, its cone and the feed, checked against each other.

use super::notation::Force;
use super::words::ForceAxes;
use super::{Refusal, Request, Verb, opt};
use stiffarm::cutting::{Law, Process};
use stiffarm::load::{Component, Load};

/// An option that does not go with the others, and why; the name begins the sentence.
type Odd = (&'static str, String);

impl Request {
    /// The force of a posture, where one is given.
    ///
    /// # Panics
    /// Never: a request is read with a force that makes sense, or refused.
    pub fn posture_load(&self) -> Option<Load> {
        self.asked_load().expect("checked when it was read")
    }

    /// The cutting force.
    ///
    /// # Panics
    /// Of a verb that has no such option.
    pub(super) fn load(&self) -> Load {
        self.posture_load().expect("the row has a default")
    }

    /// The same request of a zone under the mean force of a process, or of one whose force may point anywhere under that.
    ///
    /// # Errors
    /// A process whose force is measured along a path, has no mean, or does not go with what else is said of the force.
    pub fn under(&self, process: &Process) -> Result<Self, Refusal> {
        if let Law::Measured(_) = process.law {
            return Err(self.refused(opt::PROCESS, "is measured along a path; a zone has one force".into()));
        }
        let found = process.force().map_err(|error| self.refused(opt::PROCESS, error.to_string()))?;
        let force = found.mean.map_or(Force::Size(found.largest), Force::Along);
        let size = match force {
            Force::Size(newtons) => Load::worst(newtons),
            Force::Along(force) => Load::along_tool(force, None),
        };
        size.map_err(|error| self.refused(opt::PROCESS, format!("gives {error}")))?;
        let under = Self { process_force: Some(force), ..self.clone() };
        under.check_force()?;
        Ok(under)
    }

    /// Checks that the file of a process was read, where one was given.
    pub(super) fn check_process(&self) -> Result<(), Refusal> {
        if self.is_given(opt::PROCESS) && self.process_force.is_none() {
            return Err(self.refused(opt::PROCESS, "was not read: nobody who asks this knows its force".into()));
        }
        Ok(())
    }

    /// Checks that what is said of the force goes together.
    pub(super) fn check_force(&self) -> Result<(), Refusal> {
        self.asked_load().map(|_| ()).map_err(|(name, why)| self.refused(name, why))
    }

    fn asked_load(&self) -> Result<Option<Load>, Odd> {
        let Some(force) = self.process_force.or_else(|| self.get(opt::FORCE_N)) else { return Ok(None) };
        if self.is_given(opt::PROCESS) && self.is_along_base() {
            return Err((
                opt::FORCE_AXES.name,
                "are those of the base; the force of a process points along the axes of the tool".into(),
            ));
        }
        let load = self.directed(force)?;
        let component = self.get(opt::COMPONENT).unwrap_or(Component::Total);
        if component == Component::Normal && self.is_of_the_plane() {
            let why = "normal to the face needs the spatial model: a zone in the arm plane has no face";
            return Err((opt::COMPONENT.name, why.into()));
        }
        let cone = self.get(opt::FORCE_CONE_DEG).unwrap_or(0.0);
        let load = load.with_cone(cone.to_radians()).expect("the row's range is that of a cone");
        Ok(Some(load.counting(component)))
    }

    /// The force with its direction.
    fn directed(&self, force: Force) -> Result<Load, Odd> {
        let direction = self.get(opt::DIRECTION_DEG);
        let load = match (force, direction) {
            (Force::Size(newtons), Some(degrees)) => Load::in_plane(newtons, degrees.to_radians(), Component::Total),
            // Until the file is read nobody knows whether its force has a direction.
            (Force::Size(newtons), None) if self.is_given(opt::PROCESS) && self.process_force.is_none() => {
                Load::worst(newtons)
            }
            (Force::Size(newtons), None) => {
                let three = "a force of one number points in its worst direction; give three";
                for (name, says) in [
                    (opt::FORCE_AXES.name, "says along which axes a force points"),
                    (opt::FEED_DEG.name, "says where the feed goes along which a force points"),
                    (opt::FORCE_CONE_DEG.name, "is the doubt about where a force points"),
                ] {
                    if self.is_given(name) {
                        return Err((name, format!("{says}; {three}")));
                    }
                }
                Load::worst(newtons)
            }
            (Force::Along(_), Some(_)) => {
                return Err((
                    opt::DIRECTION_DEG.name,
                    "is the direction of a force that is given by its size; three numbers have one".into(),
                ));
            }
            (Force::Along([_, y, _]), None) if self.is_of_the_plane() && y != 0.0 => {
                let why = format!(
                    "pushes with {y} N across the arm plane, of which the planar model knows nothing; it takes ahead,0,up, the spatial model any"
                );
                return Err((opt::FORCE_N.name, why));
            }
            (Force::Along(force), None) if self.is_along_base() => {
                if self.is_given(opt::FEED_DEG) {
                    return Err((
                        opt::FEED_DEG.name,
                        "turns nothing: the force is given along the axes of the base".into(),
                    ));
                }
                Load::along_base(force)
            }
            (Force::Along(force), None) => Load::along_tool(force, self.get(opt::FEED_DEG).map(f64::to_radians)),
        };
        Ok(load.expect("the notation takes what a load takes"))
    }

    /// The paper's model, which knows the arm plane alone.
    fn is_of_the_plane(&self) -> bool {
        self.verb.setting(opt::MODEL).is_some() && !self.is_spatial()
    }

    /// Three numbers count along the axes of the base.
    fn is_along_base(&self) -> bool {
        let is_usual = self.is_of_the_plane() || self.verb == Verb::Compliance;
        self.get(opt::FORCE_AXES).map_or(is_usual, |axes| axes == ForceAxes::Base)
    }
}
