//! Where along a path is the error largest, and which drive gives it?

use std::collections::BTreeMap;

use super::super::verdict::Verdict;
use super::super::{Table, fixed};
use super::MillAnswer;
use stiffarm::mill::{Acting, Pushed, Station};

/// So many lines are shown; every sample stands in the rows.
const MOST_LINES: usize = 15;
/// A path that has no lines is shown in so many parts.
const PARTS: usize = 12;

impl MillAnswer {
    /// The worst sample of the lines on which the error is largest, the worst first; of a path without lines, of its twelve parts. `None` where the path is
    /// not followed.
    pub fn worst_lines(&self) -> Option<Table> {
        let found = self.followed()?;
        let cutting = || self.stations.iter().zip(&found.samples).filter(|(station, _)| station.sample.is_cutting);
        let has_lines = self.stations.iter().any(|station| station.sample.line != self.stations[0].sample.line);
        let whole = self.stations.last().map_or(0.0, |station| station.sample.way);
        let part = |station: &Station| {
            let part = ((station.sample.way / whole * PARTS as f64) as usize).min(PARTS - 1);
            if has_lines { station.sample.line } else { part }
        };
        let mut worst: BTreeMap<usize, (&Station, &Pushed)> = BTreeMap::new();
        for (station, pushed) in cutting() {
            let known = worst.entry(part(station)).or_insert((station, pushed));
            if known.1.error < pushed.error {
                *known = (station, pushed);
            }
        }
        let mut worst: Vec<(usize, (&Station, &Pushed))> = worst.into_iter().collect();
        worst.sort_by(|a, b| b.1.1.error.total_cmp(&a.1.1.error));
        let mut headings = vec![
            if has_lines { "line" } else { "part of the way" },
            "way [mm]",
            "x [mm]",
            "y [mm]",
            "z [mm]",
            "error [mm]",
        ];
        headings.extend(self.tolerance_mm.map(|_| "below the tolerance [mm]"));
        headings.extend(["force [N]", "roll [deg]", "to a limit [deg]", "to straight [deg]"]);
        let mut table = Table::new(headings);
        for (line, (station, pushed)) in worst.into_iter().take(MOST_LINES) {
            let name = if has_lines { line.to_string() } else { format!("{} of {PARTS}", line + 1) };
            table.row(self.worst_row(name, station, pushed));
        }
        Some(table)
    }

    fn worst_row(&self, name: String, station: &Station, pushed: &Pushed) -> Vec<String> {
        let mm = |metres: f64, digits: usize| fixed(metres * 1e3, digits);
        let mut cells = vec![name, mm(station.sample.way, 1)];
        cells.extend(station.sample.pose.tip.iter().map(|part| mm(*part, 2)));
        cells.push(mm(pushed.error, 4));
        cells.extend(self.tolerance_mm.map(|tolerance| fixed(Verdict::of(pushed.error, tolerance).margin_mm, 4)));
        cells.push(match &station.acting {
            None => "-".into(),
            Some(Acting::Any(newtons)) => fixed(*newtons, 1),
            Some(Acting::Known { force: [feed, across, axial], .. }) => {
                format!("{}, {}, {}", fixed(*feed, 1), fixed(*across, 1), fixed(*axial, 1))
            }
        });
        let angles = [pushed.arrangement.roll, pushed.limit_margin, pushed.singular_margin];
        cells.extend(angles.map(|angle| fixed(angle.to_degrees(), 1)));
        cells
    }

    /// What every drive gives of the displacement: at the worst sample, and from where to where along the path. `None` where the path is not followed, or
    /// nothing pushes.
    pub fn drives_table(&self) -> Option<Table> {
        let found = self.followed()?;
        let at_worst = found.samples[found.worst.1].shares?;
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 1));
        let mut table = Table::new(["drive", "at the largest error", "least along the path", "most along the path"]);
        for (drive, share) in at_worst.iter().enumerate() {
            let along = || found.samples.iter().filter_map(|pushed| Some(pushed.shares?[drive]));
            let ends = [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)];
            table.row([(drive + 1).to_string(), percent(*share), percent(ends[0]), percent(ends[1])]);
        }
        Some(table)
    }
}
