//! What is wrong with a robot file, and where?

use std::fmt;

/// One fault of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Line, from 1.
    pub line: usize,
    /// The key with its table, e.g. `geometry.c2_mm`; empty where the file as a whole is meant.
    pub key: String,
    /// What is wrong and what was expected.
    pub message: String,
}

/// A message tells no more faults than this; who has mended them sees the next.
const MOST_SHOWN: usize = 20;

/// Every fault of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults {
    /// The file as the user named it.
    pub file: String,
    /// At least one, in the order of the lines.
    pub faults: Vec<Fault>,
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, Fault { line, key, message }) in self.faults.iter().take(MOST_SHOWN).enumerate() {
            let end = if i == 0 { "" } else { "\n" };
            let colon = if key.is_empty() { "" } else { ": " };
            write!(f, "{end}{}:{line}: {key}{colon}{message}", self.file)?;
        }
        match self.faults.len().saturating_sub(MOST_SHOWN) {
            0 => Ok(()),
            more => write!(f, "\n{}: and {more} faults more", self.file),
        }
    }
}

impl std::error::Error for Faults {}
