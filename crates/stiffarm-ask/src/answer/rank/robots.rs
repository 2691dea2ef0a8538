//! One robot of a ranking, task by task.

use super::super::words::{self, fixed};
use super::super::{Table, margins};
use super::RankAnswer;
use stiffarm::place::{Placed, Placement};
use stiffarm::uncertainty::Spread;

impl RankAnswer {
    /// A row per task: what a robot of the ranking does there.
    ///
    /// # Panics
    /// Where there is no such row.
    pub fn table_of(&self, at: usize) -> Table {
        let row = &self.ranking.rows[at];
        let leading: Vec<_> = (0..self.ranking.tasks.len()).map(|task| self.leading(task)).collect();
        let spreads: Vec<Option<Spread>> = (0..row.cells.len()).map(|task| self.spread(at, task)).collect();
        let is_scattered = spreads.iter().any(Option::is_some);
        let mut headings = vec!["task", "worst deflection [mm]", "proved lower bound [mm]"];
        headings.extend(is_scattered.then_some("90 % interval [mm]"));
        let mut headings: Vec<String> = headings.into_iter().map(Into::into).collect();
        headings.extend(self.axes().iter().map(|axis| format!("{axis} [m]")));
        headings.extend(["smallest margin", "clearance [mm]"].map(Into::into));
        let mut table = Table::new(headings);
        for (task, asked) in self.ranking.tasks.iter().enumerate() {
            let best = row.placement(task);
            let mut cells = vec![asked.label.clone(), self.cell(at, task, &leading[task])];
            cells.push(or_dash(best, |best| Some(fixed(best.lower_bound * 1e3, 3))));
            if is_scattered {
                let interval =
                    |spread: Spread| format!("{} .. {}", fixed(spread.p05 * 1e3, 3), fixed(spread.p95 * 1e3, 3));
                cells.push(spreads[task].map_or_else(|| "-".into(), interval));
            }
            let nowhere = || vec!["-".to_owned(); self.axes().len()];
            cells.extend(best.map_or_else(nowhere, |best| self.centre(best)));
            cells.push(or_dash(best, |best| {
                best.smallest_margin().map(|(least, of)| format!("{} ({})", words::degrees(least), margins::of(of)))
            }));
            cells.push(self.clearance(at, task).map_or_else(
                || "-".into(),
                |found| {
                    let distance = fixed(found.distance * 1e3, 0);
                    let loud = words::collision(&found).map_or_else(String::new, |loud| format!("{loud} "));
                    format!("{loud}{distance}")
                },
            ));
            table.row(cells);
        }
        table
    }

    /// Why a robot of the ranking has no place, task by task, where it has none.
    ///
    /// # Panics
    /// Where there is no such row.
    pub fn why_not(&self, at: usize) -> Vec<String> {
        let row = &self.ranking.rows[at];
        let why = |(cell, task): (&stiffarm::rank::Cell, &stiffarm::task::Task)| match cell {
            Ok(Placed::Feasible(_)) => None,
            Ok(Placed::Infeasible { reason, is_proved, .. }) => {
                let proof = words::proved_none(*is_proved, None);
                Some(format!("no place for {}: {reason}{proof}", task.label))
            }
            Err(error) => Some(format!("{}: {error}", task.label)),
        };
        row.cells.iter().zip(&self.ranking.tasks).filter_map(why).collect()
    }
}

fn or_dash(best: Option<&Placement>, text: impl Fn(&Placement) -> Option<String>) -> String {
    best.and_then(text).unwrap_or_else(|| "-".into())
}
