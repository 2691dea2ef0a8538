//! What is handed on: an answer as a document that a manager understands and an engineer can sign, as HTML and as PDF.
//!
//! [`Report`] is the document, `html` prints it, and `ask` makes it of an answer. Nothing is computed here: every
//! sentence and every number is what `answer` tells, every picture one of `figures`.

pub(crate) mod html;
pub(crate) mod robots;

use crate::answer::{Headline, Table};

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
