//! The finished part, of which arm and spindle keep clear: does its mesh lie where the path does?

use super::super::fixed;
use crate::request::{Refusal, Request};
use stiffarm::clearance::Mesh;
use stiffarm::toolpath::Survey;

/// No feed moves reach over so many times the width of their part: its unit is another one.
const TOO_SMALL: f64 = 20.0;
/// A part so many times as wide as its feed moves reach is asked about: it may be a hole in a wing.
const LARGE: f64 = 100.0;

/// A part as it was read.
#[derive(Clone, Debug)]
pub struct PartFile {
    /// In the path's frame, m.
    pub mesh: Mesh,
    /// What was cured in its file, and what is odd.
    pub notes: Vec<String>,
}

impl PartFile {
    /// What is to be said of it.
    ///
    /// # Errors
    /// A part that the path cannot be of by its size.
    pub(super) fn checked(&self, asked: &Request, survey: &Survey) -> Result<Vec<String>, Refusal> {
        let mut notes = self.notes.clone();
        let Some(extent) = survey.extent.map(|corners| corners.map(<[f64; 3]>::from)) else { return Ok(notes) };
        let part = self.mesh.extent();
        let sides = |[low, high]: [[f64; 3]; 2]| [0, 1, 2].map(|i| high[i] - low[i]);
        let widest = |extent| sides(extent).into_iter().fold(0.0, f64::max);
        if TOO_SMALL * widest(part) < widest(extent) {
            let told = |extent| sides(extent).map(|side| fixed(side * 1e3, 3)).join(" x ");
            let why = format!(
                "measures {} mm, and the feed moves reach over {} mm; expected a part of their size: is its unit another one (part-unit)?",
                told(part),
                told(extent)
            );
            return Err(asked.refused("part", why));
        }
        if LARGE * widest(extent) < widest(part) {
            let metres = fixed(widest(part), 3);
            notes.push(format!("the part is {metres} m wide, over {LARGE} times as much as the feed moves reach: is its unit another one (part-unit)?"));
        }
        let is_apart =
            (0..3).any(|i| part[1][i] + widest(part) < extent[0][i] || extent[1][i] + widest(part) < part[0][i]);
        if is_apart {
            notes.push(
                "the part lies farther from the feed moves than it is wide: is its origin that of the path?".into(),
            );
        }
        Ok(notes)
    }
}
