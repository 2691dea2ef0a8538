//! Several robots on a toolpath, as text, table, JSON and bars.

use crate::answer::{Headline, PathRankAnswer, Rows};
use crate::request::Request;
use serde_json::Value;
use stiffarm::toolpath::Understood;
use stiffarm::watch::Watch;

use super::context::Context;
use super::outputs::path_ranking::PathRankOutput;
use super::path::{all_moves, read_beside};
use super::reports::{self, Inputs};
use super::selection;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::forms::{Answer, Forms, Makes, Picture, Piece};
use crate::report::Report;

/// The order of several robots on a path, each at its best place.
pub(crate) fn answer<'a>(asked: &'a Request, context: Context) -> Result<PathRankOutput<'a>, AskError> {
    let path = asked.path()?;
    let robots = selection::keep(selection::robots(&asked.robots(), context)?, asked, &[])?;
    let beside = read_beside(asked, context)?;
    let (moves, understood) = all_moves(asked, &path, context, robots.len())?;
    let ranked = |watch: Watch| PathRankAnswer::of(asked, robots, (path, &moves), &beside, watch);
    let mut answer = context.watched("milling with every robot", ranked)?;
    answer.remarks.extend(understood.into_iter().flat_map(Understood::remarks));
    Ok(PathRankOutput { answer, asked, inputs: Inputs::of(asked, context), figure_size: FigureSize::of(asked)? })
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "mill", makes: &[Makes::Picture(Picture::Figure), Makes::Report] };

impl Answer for PathRankOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let Self { answer, .. } = self;
        vec![
            Piece::Lines(answer.heading()),
            Piece::Break,
            Piece::Table(answer.table()),
            Piece::Break,
            Piece::Lines(answer.notes()),
        ]
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn shortfall(&self) -> Option<String> {
        self.answer.shortfall()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(self.figure(self.figure_size)))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::path_ranking::of(self, self.asked))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
