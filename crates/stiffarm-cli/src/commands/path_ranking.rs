//! Several robots on a toolpath, as text, table, JSON and bars.

use std::io::{self, Write};

use stiffarm::answer::{PathRankAnswer, Rows, Unit, looks, stiffnesses, words};
use stiffarm::drive::Architecture;
use stiffarm::robot::Status;

use crate::failure::Failure;
use crate::figures::Plate;
use crate::figures::bars::{BarRow, BarsFigure};
use crate::look::Look;
use crate::output::{Answer, pretty};
use crate::table::{prose, shown};

/// More bars are not told apart on one page.
const MOST_BARS: usize = 60;

pub(super) struct PathRankOutput {
    pub(super) answer: PathRankAnswer,
    pub(super) plate: Plate,
}

impl Answer for PathRankOutput {
    const COMMAND: &'static str = "mill";
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

    /// A bar per robot, with what is proved.
    fn svg(&self) -> Option<Result<String, Failure>> {
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
            plate: self.plate,
        };
        Some(Ok(figure.svg()))
    }

    fn plate(&self) -> Plate {
        self.plate
    }
}
