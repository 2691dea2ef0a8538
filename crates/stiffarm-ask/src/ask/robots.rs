//! Robots of the catalogue, as they are listed.

use serde_json::Value;
use stiffarm::catalogue;
use stiffarm::robot::Robot;

use super::context::Context;
use super::selection;
use crate::answer::Rows;
use crate::answer::robot::{data_sheet, list, notes, table};
use crate::error::AskError;
use crate::forms::{Answer, Forms, Piece};
use crate::request::Request;

/// Those of the catalogue that have these words in their names and what is asked.
///
/// # Errors
/// Where none has.
pub fn answer(words: &[String], asked: &Request) -> Result<List, AskError> {
    Ok(List(selection::keep(catalogue::robots(), asked, words)?))
}

/// Those of the catalogue that have what is asked.
pub(super) fn all(asked: &Request, _: Context) -> Result<List, AskError> {
    answer(&[], asked)
}

/// Robots, as they are listed.
pub struct List(Vec<Robot>);

/// In which forms it is shown.
pub(super) const FORMS: Forms = Forms::of("robots list");

impl Answer for List {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(table(&self.0)), Piece::Break, Piece::Lines(notes(&self.0))]
    }

    fn value(&self) -> Value {
        self.0.iter().map(data_sheet).collect()
    }

    fn rows(&self) -> Rows<'_> {
        list(&self.0)
    }
}
