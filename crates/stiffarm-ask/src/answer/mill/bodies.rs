//! The finished part and what holds it, of which the arm keeps clear: do their meshes lie where the path does?

use super::super::fixed;
use crate::request::{Refusal, Request, opt};
use stiffarm::clearance::Mesh;
use stiffarm::toolpath::Survey;

/// No feed moves reach over so many times the width of their part: its unit is another one.
const TOO_SMALL: f64 = 20.0;
/// A part so many times as wide as its feed moves reach is asked about: it may be a hole in a wing.
const LARGE: f64 = 100.0;

/// A fixture that is less wide, m, was given in metres.
const LEAST_WIDE: f64 = 5e-3;

/// What stands at the work, where its mesh is given.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// As it is when it is done.
    pub part: Option<MeshFile>,
    /// What holds it.
    pub fixture: Option<MeshFile>,
}

/// A body as it was read.
#[derive(Clone, Debug)]
pub struct MeshFile {
    /// In the path's frame, m.
    pub mesh: Mesh,
    /// What was cured in its file, and what is odd.
    pub notes: Vec<String>,
}

impl Bodies {
    /// What is to be said of them.
    ///
    /// # Errors
    /// A part that the path cannot be of by its size.
    pub(super) fn checked(&self, asked: &Request, survey: &Survey) -> Result<Vec<String>, Refusal> {
        let mut notes = Vec::new();
        if let Some(part) = &self.part {
            notes.extend(part.notes.iter().cloned());
            notes.extend(part.beside_path("part", survey));
            part.check_size(asked, survey)?;
        }
        if let Some(fixture) = &self.fixture {
            notes.extend(fixture.notes.iter().map(|note| format!("fixture: {note}")));
            notes.extend(fixture.beside_path("fixture", survey));
            fixture.check_wide(asked)?;
        }
        Ok(notes)
    }
}

fn sides([low, high]: [[f64; 3]; 2]) -> [f64; 3] {
    [0, 1, 2].map(|i| high[i] - low[i])
}

fn widest(extent: [[f64; 3]; 2]) -> f64 {
    sides(extent).into_iter().fold(0.0, f64::max)
}

impl MeshFile {
    /// What holds a part is not as small as a grain.
    fn check_wide(&self, asked: &Request) -> Result<(), Refusal> {
        let wide = widest(self.mesh.extent());
        if LEAST_WIDE <= wide {
            return Ok(());
        }
        let why = format!(
            "is {} mm wide; expected {} mm or more: is its unit another one (part-unit)?",
            fixed(wide * 1e3, 3),
            fixed(LEAST_WIDE * 1e3, 0)
        );
        Err(asked.refused(opt::FIXTURE, why))
    }

    /// A part is not far smaller than what is fed along it.
    fn check_size(&self, asked: &Request, survey: &Survey) -> Result<(), Refusal> {
        let Some(extent) = survey.extent.map(|corners| corners.map(<[f64; 3]>::from)) else { return Ok(()) };
        let part = self.mesh.extent();
        if widest(extent) <= TOO_SMALL * widest(part) {
            return Ok(());
        }
        let in_mm = |extent| sides(extent).map(|side| fixed(side * 1e3, 3)).join(" x ");
        let why = format!(
            "measures {} mm, and the feed moves reach over {} mm; expected a part of their size: is its unit another one (part-unit)?",
            in_mm(part),
            in_mm(extent)
        );
        Err(asked.refused(opt::PART, why))
    }

    /// What is odd about where it lies and how large it is.
    fn beside_path(&self, name: &str, survey: &Survey) -> Vec<String> {
        let Some(extent) = survey.extent.map(|corners| corners.map(<[f64; 3]>::from)) else { return Vec::new() };
        let own = self.mesh.extent();
        let mut notes = Vec::new();
        if LARGE * widest(extent) < widest(own) {
            let metres = fixed(widest(own), 3);
            notes.push(format!("the {name} is {metres} m wide, over {LARGE} times as much as the feed moves reach: is its unit another one (part-unit)?"));
        }
        let is_apart = (0..3).any(|i| own[1][i] + widest(own) < extent[0][i] || extent[1][i] + widest(own) < own[0][i]);
        if is_apart {
            notes.push(format!(
                "the {name} lies farther from the feed moves than it is wide: is its origin that of the path?"
            ));
        }
        notes
    }
}
