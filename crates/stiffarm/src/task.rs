//! What must be machined: a flat zone, or a part with several faces, under the name by which it is reported.

use std::str::FromStr;

pub use crate::part::{Face, Part, PartError};
pub use crate::zone::{Zone, ZoneError};

/// What is machined.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// One flat zone.
    Zone(Zone),
    /// A part with several faces.
    Part(Part),
}

/// Work and the name under which it is reported; of a verb that knows flat zones alone, a `Task<Zone>`.
#[derive(Clone, Debug, PartialEq)]
pub struct Task<W = Work> {
    /// As the user wrote it, e.g. `B:0.5`.
    pub label: String,
    /// What it stands for.
    pub work: W,
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

impl Work {
    /// The zone, where the work is one.
    pub fn zone(&self) -> Option<Zone> {
        match self {
            Self::Zone(zone) => Some(*zone),
            Self::Part(_) => None,
        }
    }

    /// The part, where the work is one.
    pub fn part(&self) -> Option<&Part> {
        match self {
            Self::Zone(_) => None,
            Self::Part(part) => Some(part),
        }
    }

    /// In words, with its lengths in mm.
    pub fn describe(&self) -> String {
        match self {
            Self::Zone(zone) => zone.describe(),
            Self::Part(part) => part.describe(),
        }
    }

    /// Grown or shrunk.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        match self {
            Self::Zone(zone) => Self::Zone(zone.scaled(scale)),
            Self::Part(part) => Self::Part(part.scaled(scale)),
        }
    }

    /// The same, whatever it is called.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Zone(zone), Self::Zone(other)) => zone == other,
            (Self::Part(part), Self::Part(other)) => part.faces == other.faces,
            _ => false,
        }
    }
}

impl From<Zone> for Work {
    fn from(zone: Zone) -> Self {
        Self::Zone(zone)
    }
}

impl From<Part> for Work {
    fn from(part: Part) -> Self {
        Self::Part(part)
    }
}

impl Task {
    /// One flat zone under the same name, where the work is one.
    pub fn flat(&self) -> Option<Task<Zone>> {
        Some(Task { label: self.label.clone(), work: self.work.zone()? })
    }
}

impl<W: From<Zone>> From<Zone> for Task<W> {
    fn from(zone: Zone) -> Self {
        Self { label: zone.to_string(), work: zone.into() }
    }
}

impl From<Part> for Task {
    fn from(part: Part) -> Self {
        Self { label: part.label.clone(), work: part.into() }
    }
}

impl FromStr for Task {
    type Err = TaskError;

    /// A [`Zone`], or a [`Part`]: `box:AxBxC` or `part:...`.
    fn from_str(text: &str) -> Result<Self, TaskError> {
        if text.starts_with("box:") || text.starts_with("part:") {
            return Ok(text.parse::<Part>()?.into());
        }
        Ok(text.parse::<Task<Zone>>()?.into())
    }
}

impl FromStr for Task<Zone> {
    type Err = ZoneError;

    fn from_str(text: &str) -> Result<Self, ZoneError> {
        Ok(Self { label: text.trim().into(), work: text.parse()? })
    }
}

impl From<Task<Zone>> for Task {
    fn from(Task { label, work }: Task<Zone>) -> Self {
        Self { label, work: work.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_keeps_the_name_it_was_given() {
        let task: Task = " B:0.5".parse().unwrap();
        assert_eq!(
            (task.label.as_str(), task.work.zone()),
            ("B:0.5", Some(Zone::Rectangle { width: 0.5, height: 1.0 }))
        );
        let part: Task = "box:0.8x0.5x0.1".parse().unwrap();
        assert_eq!(
            (part.label.as_str(), part.work.describe().as_str()),
            ("box:0.8x0.5x0.1", "800 x 500 x 100 mm, 5 faces")
        );
        let again: Task = "box:0.80x0.50x0.10".parse().unwrap();
        assert!(part.work.is_same(&again.work) && !part.work.is_same(&task.work));
    }
}
