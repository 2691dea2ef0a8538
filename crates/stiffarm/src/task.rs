//! What must be machined: a flat zone, or a part with several faces, under the name by which it is reported.

use std::str::FromStr;

pub use crate::part::{Face, Part, PartError};
pub use crate::zone::{Zone, ZoneError};

/// Work and the name under which it is reported.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// As the user wrote it, e.g. `B:0.5`.
    pub label: String,
    /// What it stands for; of a part its first face.
    pub zone: Zone,
    /// The part, where the work is more than one flat zone.
    pub part: Option<Part>,
}

/// A task that cannot be understood.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TaskError {
    /// A flat zone.
    #[error(transparent)]
    Zone(#[from] ZoneError),
    /// A part.
    #[error(transparent)]
    Part(#[from] PartError),
}

impl Task {
    /// The work in words, with its lengths in mm.
    pub fn describe(&self) -> String {
        self.part.as_ref().map_or_else(|| self.zone.describe(), Part::describe)
    }

    /// The work grown or shrunk, under its old name.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        let part = self.part.as_ref().map(|part| part.scaled(scale));
        Self { label: self.label.clone(), zone: self.zone.scaled(scale), part }
    }

    /// The same work: whatever it is called.
    pub fn is_same_work(&self, other: &Self) -> bool {
        match (&self.part, &other.part) {
            (None, None) => self.zone == other.zone,
            (Some(part), Some(other)) => part.faces == other.faces,
            (None, Some(_)) | (Some(_), None) => false,
        }
    }
}

impl From<Zone> for Task {
    fn from(zone: Zone) -> Self {
        Self { label: zone.to_string(), zone, part: None }
    }
}

impl From<Part> for Task {
    /// # Panics
    /// Of a part without faces.
    fn from(part: Part) -> Self {
        Self { label: part.label.clone(), zone: part.faces[0].zone, part: Some(part) }
    }
}

impl FromStr for Task {
    type Err = TaskError;

    /// A [`Zone`], or a [`Part`]: `box:AxBxC` or `part:...`.
    fn from_str(text: &str) -> Result<Self, TaskError> {
        if text.starts_with("box:") || text.starts_with("part:") {
            return Ok(text.parse::<Part>()?.into());
        }
        Ok(Self { label: text.trim().into(), ..text.parse::<Zone>()?.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_keeps_the_name_it_was_given() {
        let task: Task = " B:0.5".parse().unwrap();
        assert_eq!((task.label.as_str(), task.part.is_none()), ("B:0.5", true));
        let part: Task = "box:0.8x0.5x0.1".parse().unwrap();
        assert_eq!((part.label.as_str(), part.describe().as_str()), ("box:0.8x0.5x0.1", "800 x 500 x 100 mm, 5 faces"));
        assert!(part.is_same_work(&"box:0.80x0.50x0.10".parse().unwrap()) && !part.is_same_work(&task));
    }
}
