//! Several robots on a toolpath, and the bars that draw them.

use stiffarm::drive::Architecture;
use stiffarm::robot::Status;

use crate::answer::{MillAnswer, PathRankAnswer, Unit, Verdict, stiffnesses, styles, words};
use crate::ask::reports::Inputs;
use crate::figures::FigureSize;
use crate::figures::bars::{BarRow, BarsFigure};
use crate::request::Request;

/// More bars are not distinguished on one page.
const MOST_BARS: usize = 60;

pub(crate) struct PathRankOutput<'a> {
    pub(crate) answer: PathRankAnswer,
    pub(crate) asked: &'a Request,
    pub(crate) inputs: Inputs,
    pub(crate) figure_size: FigureSize,
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
                verdicts: vec![
                    row.milled.as_ref().ok().and_then(|milled| {
                        milled.overload_sentence().or_else(|| milled.verdict().map(Verdict::in_words))
                    }),
                ],
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
