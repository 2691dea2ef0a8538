//! What is handed on: an answer as a document that a manager understands and an engineer can sign, as HTML and as PDF.
//!
//! [`Report`] is the document, [`html`] prints it, and a file a verb makes it of its answer. Nothing is computed here: every
//! sentence and every number is what `answer` tells, every picture one of `figures`.

pub(crate) mod html;
pub(crate) mod identify;
mod inputs;
pub(crate) mod mill;
pub(crate) mod path_ranking;
pub(crate) mod place;
pub(crate) mod rank;
mod robots;

use std::path::Path;

use crate::answer::{HOLDS, Headline, ON_TOP, Table};
use crate::request::{Request, job};
pub(crate) use inputs::Inputs;

use crate::ask::AskError;
use crate::date::today;
use crate::figures::Plate;

/// How wide figures are laid out: within the margins of A4, mm.
const WIDTH_MM: f64 = 174.0;

/// So many letters of a command stand side by side on a page.
const CODE_LETTERS: usize = 92;

/// A document.
pub struct Report {
    /// First line.
    pub title: String,
    /// What was asked, below it.
    pub asked: String,
    /// The answer in a word and a few sentences.
    pub headline: Headline,
    /// What follows, in its order.
    pub sections: Vec<Section>,
}

/// A part of a document under a heading.
pub struct Section {
    /// The heading.
    pub title: String,
    /// Begins on a page of its own.
    pub on_new_page: bool,
    /// What it has, in its order.
    pub blocks: Vec<Block>,
}

/// What a document is made of. Every text may hold any character.
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Remarks, each on a line of its own.
    Notes(Vec<String>),
    /// A heading within a section.
    Heading(String),
    /// A table.
    Table(Listing),
    /// A picture as SVG, with what it shows.
    Figure(Figure),
    /// What is typed or kept in a file, letter by letter.
    Code(String),
}

/// A table in a document.
pub struct Listing {
    /// What it says.
    pub table: Table,
    /// A reader may choose by which column it is sorted.
    pub is_sortable: bool,
}

/// A picture in a document.
pub struct Figure {
    /// SVG text, made by `figures`.
    pub svg: String,
    /// What it shows.
    pub caption: String,
}

impl Section {
    /// A section without contents.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), on_new_page: false, blocks: Vec::new() }
    }

    /// The same at the top of a page.
    #[must_use]
    pub fn on_new_page(self) -> Self {
        Self { on_new_page: true, ..self }
    }

    /// A paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// A heading within it.
    pub fn heading(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Heading(text.into()));
    }

    /// Remarks; nothing where there are none.
    pub fn notes<S: Into<String>>(&mut self, lines: impl IntoIterator<Item = S>) {
        let lines: Vec<String> = lines.into_iter().map(Into::into).collect();
        if !lines.is_empty() {
            self.blocks.push(Block::Notes(lines));
        }
    }

    /// A table.
    pub fn table(&mut self, table: Table) {
        self.blocks.push(Block::Table(Listing { table, is_sortable: false }));
    }

    /// A picture as SVG, with what it shows.
    pub fn figure(&mut self, svg: String, caption: impl Into<String>) {
        self.blocks.push(Block::Figure(Figure { svg, caption: caption.into() }));
    }
}

impl Report {
    /// Its pictures, in their order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        let blocks = self.sections.iter().flat_map(|section| &section.blocks);
        blocks.filter_map(|block| if let Block::Figure(one) = block { Some(one) } else { None })
    }
}

/// How figures of a report are laid out; the range of the colours is that which was asked for.
pub fn plate(asked: Plate) -> Plate {
    Plate { width_mm: Some(WIDTH_MM), ..asked }
}

/// What a verdict is about, and how large what it is not about usually is; nothing where there is no tolerance.
fn meaning(asked: &Request) -> Option<Section> {
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
fn repeated(asked: &Request, inputs: &Inputs) -> Result<Section, AskError> {
    let mut section = Section::new("To ask the same again");
    section.text(format!("Computed on {} (UTC) by stiffarm {}.", today(), env!("CARGO_PKG_VERSION")));
    if let Some(files) = inputs.files()? {
        section
            .text("Files that it rests on, with their digests; what was not read from a file comes with the program:");
        section.table(files);
    }
    section.text("The same numbers come from this command, in the folder in which it was asked:");
    section.blocks.push(Block::Code(asked.command_in_lines(CODE_LETTERS)));
    section.text("or from this job file, job.toml, in that folder:");
    section.blocks.push(Block::Code(job::write(asked, &[], Path::new("job.toml"))));
    Ok(section)
}
