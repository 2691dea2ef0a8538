//! What several reports say: how figures are laid out, what a verdict means, and how the same is asked again.

use std::path::Path;

use super::inputs::Inputs;
use crate::answer::{HOLDS, ON_TOP};
use crate::date::today;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::report::{Block, Section};
use crate::request::{Request, job};

/// How wide figures are laid out: within the margins of A4, mm.
const WIDTH_MM: f64 = 174.0;

/// So many letters of a command stand side by side on a page.
const CODE_LETTERS: usize = 92;

/// How figures of a report are laid out; the range of the colours is that which was asked for.
pub(super) fn figure_size(asked: FigureSize) -> FigureSize {
    FigureSize { width_mm: Some(WIDTH_MM), ..asked }
}

/// What a verdict is about, and how large what it is not about usually is; nothing where there is no tolerance.
pub(super) fn meaning(asked: &Request) -> Option<Section> {
    asked.tolerance_mm()?;
    let mut section = Section::new("What \"holds\" means");
    section.text(HOLDS);
    section.notes(ON_TOP);
    Some(section)
}

/// Who says this, when, of which files, and how it is asked again: the last part of every report.
///
/// # Errors
/// Where a file is no longer there.
pub(super) fn repeated(asked: &Request, inputs: &Inputs) -> Result<Section, AskError> {
    let mut section = Section::new("To ask the same again");
    section.text(format!("Computed on {} (UTC) by stiffarm {}.", today(), env!("CARGO_PKG_VERSION")));
    if let Some(files) = inputs.files()? {
        section
            .text("Files that it rests on, with their digests; what was not read from a file comes with the program:");
        section.table(files);
    }
    let missing = inputs.nowhere_else();
    if !missing.is_empty() {
        section.text(format!(
            "Not in any file, but handed over by a program: {}. Write it to a file first and name that below (in Python a robot's to_toml() is its robot file).",
            missing.join(", ")
        ));
    }
    section.text("The same numbers come from this command, in the folder in which it was asked:");
    section.blocks.push(Block::Code(asked.command_in_lines(CODE_LETTERS)));
    section.text("or from this job file, job.toml, in that folder:");
    section.blocks.push(Block::Code(job::write(asked, &[], Path::new("job.toml"))));
    Ok(section)
}
