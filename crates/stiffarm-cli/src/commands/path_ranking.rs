//! Several robots on a toolpath, as text, table, JSON and bars.

use std::io::{self, Write};

use stiffarm::drive::Architecture;
use stiffarm::robot::Status;
use stiffarm_ask::answer::{MillAnswer, PathRankAnswer, Rows, Unit, Verdict, looks, stiffnesses, words};
use stiffarm_ask::request::Request;

use crate::failure::Failure;
use crate::figures::Plate;
use crate::figures::bars::{BarRow, BarsFigure};
use crate::look::Look;
use crate::output::{Answer, pretty};
use crate::report::{self, Inputs, Report};
use crate::table::{prose, shown};

/// More bars are not told apart on one page.
const MOST_BARS: usize = 60;

pub(crate) struct PathRankOutput<'a> {
    pub(crate) answer: PathRankAnswer,
    pub(super) asked: &'a Request,
    pub(crate) inputs: Inputs,
    pub(crate) plate: Plate,
}

impl PathRankOutput<'_> {
    /// A bar per robot, with what is proved.
    pub(crate) fn figure(&self, plate: Plate) -> String {
        let PathRankAnswer { path, rows, tolerance_mm, .. } = &self.answer;
        let left_out = rows.len().saturating_sub(MOST_BARS);
        let first = if left_out == 0 { String::new() } else { format!("; the first {MOST_BARS} of {}", rows.len()) };
        let named: Vec<(&str, Architecture)> =
            rows.iter().map(|row| (row.robot.name.as_str(), row.robot.architecture)).collect();
        let drawn = rows.iter().zip(looks(&named)).take(MOST_BARS).map(|(row, look)| BarRow {
            robot: words::marked(&row.robot),
            serial: row.robot.architecture == Architecture::Serial,
            estimated: row.robot.status == Status::Estimated,
            look,
            intervals: vec![
                row.milled
                    .as_ref()
                    .ok()
                    .and_then(MillAnswer::spread)
                    .map(|spread| [spread.p05, spread.p95].map(|metres| Unit::Millimetre.told(metres))),
            ],
            verdicts: vec![row.milled.as_ref().ok().and_then(MillAnswer::verdict).map(Verdict::told)],
            values: vec![
                row.proved().map(|[bound, value]| [value, bound].map(|metres| Unit::Millimetre.told(metres)).into()),
            ],
        });
        let figure = BarsFigure {
            title: format!("Largest error along {path}, each robot at its best place and rolls{first}"),
            subtitle: format!("{}; {}", self.answer.force(), stiffnesses(rows.iter().map(|row| &row.robot))),
            tasks: vec![path.clone()],
            rows: drawn.collect(),
            tolerance_mm: *tolerance_mm,
            plate,
        };
        figure.svg()
    }
}

impl Answer for PathRankOutput<'_> {
    const COMMAND: &'static str = "mill";
    const IS_REPORTED: bool = true;
    const FURTHER: &'static [&'static str] = &["svg", "png", "pdf"];

    fn text(&self, look: Look) -> String {
        let Self { answer, .. } = self;
        format!(
            "{}\n{}\n{}",
            prose(&answer.heading(), look),
            shown(&answer.table(), look),
            prose(&answer.notes(), look)
        )
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(Ok(self.figure(self.plate)))
    }

    fn report(&self) -> Option<Result<Report, Failure>> {
        Some(report::path_ranking::of(self, self.asked))
    }

    fn plate(&self) -> Plate {
        self.plate
    }
}
