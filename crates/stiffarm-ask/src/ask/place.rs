//! `stiffarm place`: the best place of one zone.

use crate::answer::{Headline, Rows};
use crate::request::Request;
use serde_json::Value;

use super::context::Context;
use super::outputs::place::PlaceOutput;
use super::reports;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::shop::ShopFigure;
use crate::figures::view3d::View;
use crate::forms::{Answer, Forms, Makes, Picture, Piece, Sketch};
use crate::report::Report;

pub(crate) fn answer(asked: &Request, context: Context) -> Result<PlaceOutput, AskError> {
    let robot = super::selection::robot(&asked.robot()?, context)?;
    PlaceOutput::of(asked, robot, context)
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms {
    command: "place",
    makes: &[Makes::Picture(Picture::Figure), Makes::View, Makes::Report, Makes::Picture(Picture::Shop)],
};

impl Answer for PlaceOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let (table, notes) = (Piece::Table(self.answer.table()), self.answer.notes());
        if notes.is_empty() { vec![table] } else { vec![table, Piece::Break, Piece::Lines(notes)] }
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn sketch(&self, points: usize) -> Option<Result<Sketch, AskError>> {
        Some(self.sketched(points))
    }

    fn shortfall(&self) -> Option<String> {
        self.answer.shortfall()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(self.figure(self.figure_size))
    }

    fn view(&self) -> Option<Result<View, AskError>> {
        Some(self.in_space())
    }

    fn shop(&self) -> Option<Result<String, AskError>> {
        let nothing = || {
            AskError::Figure("nothing to draw: the work has no place, or nothing is known of the robot's base".into())
        };
        let drawn = |layout| ShopFigure { layout: &layout, figure_size: self.figure_size }.svg();
        Some(self.answer.layout().map(drawn).ok_or_else(nothing))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::place::of(self, &self.asked))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
