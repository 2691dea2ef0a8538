//! Several robots on a toolpath, as text, table, JSON and bars.

use crate::answer::{Headline, MillAnswer, PathRankAnswer, Rows, Unit, Verdict, stiffnesses, styles, words};
use crate::request::Request;
use serde_json::Value;
use stiffarm::drive::Architecture;
use stiffarm::robot::Status;
use stiffarm::toolpath::Understood;
use stiffarm::watch::Watch;

use super::context::Context;
use super::path::{all_moves, read_beside};
use super::reports::{self, Inputs};
use super::selection;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::bars::{BarRow, BarsFigure};
use crate::forms::{Answer, Forms, Makes, Picture, Piece};
use crate::report::Report;

/// More bars are not distinguished on one page.
const MOST_BARS: usize = 60;

pub(crate) struct PathRankOutput<'a> {
    pub(crate) answer: PathRankAnswer,
    pub(crate) asked: &'a Request,
    pub(crate) inputs: Inputs,
    pub(crate) figure_size: FigureSize,
}

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

impl PathRankOutput<'_> {
    /// A bar per robot, with what is proved.
    pub(crate) fn figure(&self, figure_size: FigureSize) -> String {
        let PathRankAnswer { path, rows, tolerance_mm, .. } = &self.answer;
        let left_out = rows.len().saturating_sub(MOST_BARS);
        let first = if left_out == 0 { String::new() } else { format!("; the first {MOST_BARS} of {}", rows.len()) };
        let named: Vec<(&str, Architecture)> =
            rows.iter().map(|row| (row.robot.name.as_str(), row.robot.architecture)).collect();
        let drawn =
            rows.iter().zip(styles(&named)).take(MOST_BARS).map(|(row, style)| BarRow {
                robot: words::marked(&row.robot),
                serial: row.robot.architecture == Architecture::Serial,
                estimated: row.robot.status == Status::Estimated,
                style,
                intervals: vec![row.milled.as_ref().ok().and_then(MillAnswer::spread).map(|spread| {
                    [spread.p05, spread.median, spread.p95].map(|metres| Unit::Millimetre.of_si(metres))
                })],
                verdicts: vec![row.milled.as_ref().ok().and_then(MillAnswer::verdict).map(Verdict::in_words)],
                collides: vec![row.milled.as_ref().ok().and_then(MillAnswer::deepest).is_some()],
                values: vec![
                    row.proved()
                        .map(|[bound, value]| [value, bound].map(|metres| Unit::Millimetre.of_si(metres)).into()),
                ],
            });
        let figure = BarsFigure {
            title: format!("Largest error along {path}, each robot at its best place and rolls{first}"),
            subtitle: format!("{}; {}", self.answer.force(), stiffnesses(rows.iter().map(|row| &row.robot))),
            tasks: vec![path.clone()],
            rows: drawn.collect(),
            tolerance_mm: *tolerance_mm,
            figure_size,
        };
        figure.svg()
    }
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
