//! `stiffarm rank --model spatial`: robots in order, all six drives, with their place in the planar ranking beside it.

use std::fmt::Write as _;
use std::io::{self, Write};

use stiffarm::drive::Architecture;
use stiffarm::place::{SpatialOptions, SpatialPlacement, SpatiallyPlaced};
use stiffarm::rank::{Ranking, Row, rank_in_plane, rank_in_space};
use stiffarm::report;
use stiffarm::request::Request;
use stiffarm::robot::{Robot, Status};
use stiffarm::task::Task;

use super::{CELL_COLUMNS, COLUMN, cell_row, direction, tool, window};
use crate::args::Common;
use crate::commands::rank::inputs;
use crate::commands::sheet::{ASSUMED_ARCHITECTURE, architecture};
use crate::commands::{progress, waiting};
use crate::failure::Failure;
use crate::figures::bars::{BarRow, BarsFigure};
use crate::output::{Answer, Outputs, pretty};
use crate::table::{Table, fixed, prose};

/// More bars are not told apart on one page.
const MOST_DRAWN: usize = 60;

pub(crate) fn run(robots: &[Robot], tasks: &[Task], asked: &Request, common: &Common) -> Result<(), Failure> {
    let names = asked.robots();
    let outputs = Outputs::open::<RankAnswer>(common, &inputs(&names))?;
    let options = match tasks {
        [task] => asked.spatial_for(task.zone)?,
        _ => asked.spatial()?,
    };
    let bar = progress(robots.len() * tasks.len(), "placing zones in space", common);
    let ranking = rank_in_space(robots, tasks, &options, || bar.inc(1))?;
    bar.finish_and_clear();
    let planar = waiting("placing zones in the plane", common, || rank_in_plane(robots, tasks, options.force))?;
    outputs.deliver(&RankAnswer { ranking, planar, options, tolerance_mm: asked.tolerance_mm() })
}

struct RankAnswer {
    ranking: Ranking<SpatiallyPlaced>,
    planar: Ranking,
    options: SpatialOptions,
    tolerance_mm: Option<f64>,
}

impl RankAnswer {
    fn cell(&self, row: &Row<SpatiallyPlaced>, task: usize) -> String {
        let Some(deflection) = row.deflection(task) else { return "-".into() };
        let is_best = self.ranking.best_published(task).is_some_and(|best| best.robot == row.robot);
        let millimetres = deflection * 1e3;
        let verdict = self.tolerance_mm.map_or_else(String::new, |tolerance| {
            let margin = tolerance - millimetres;
            format!(" {} {margin:+.3}", if 0.0 <= margin { "pass" } else { "fail" })
        });
        format!("{}{}{verdict}", fixed(millimetres, 3), if is_best { "*" } else { "" })
    }

    fn figure(&self) -> String {
        let Ranking { tasks, force, rows } = &self.ranking;
        let left_out = rows.len().saturating_sub(MOST_DRAWN);
        let first = if left_out == 0 { String::new() } else { format!("; the first {MOST_DRAWN} of {}", rows.len()) };
        let drawn = rows.iter().take(MOST_DRAWN).map(|row| BarRow {
            robot: format!("{}{}", row.robot.name, if row.robot.status == Status::Estimated { " ~" } else { "" }),
            serial: row.robot.architecture == Architecture::Serial,
            estimated: row.robot.status == Status::Estimated,
            values: row
                .cells
                .iter()
                .map(|cell| cell.feasible().map(|best| (best.deflection * 1e3, best.lower_bound * 1e3)))
                .collect(),
        });
        BarsFigure {
            title: format!("Worst deflection inside each flat zone at its best place, {force} N{first}"),
            subtitle: format!(
                "all six drives, {}, tool: {}; zones within {}",
                direction(self.options.elevation),
                tool(&self.options.flange_from_tool),
                window(&self.options.within)
            ),
            tasks: tasks.iter().map(|task| task.label.clone()).collect(),
            rows: drawn.collect(),
            tolerance_mm: self.tolerance_mm,
        }
        .svg()
    }

    /// How far the values are from being proved best.
    fn proof(&self) -> String {
        let cells =
            || self.ranking.rows.iter().flat_map(|row| row.cells.iter().map(move |cell| (cell.feasible(), row)));
        let gap = |best: &SpatialPlacement| 100.0 * best.gap();
        let placed = || cells().filter_map(|(best, row)| Some((gap(best?), row)));
        let count = placed().count();
        let near = placed().filter(|(gap, _)| *gap <= 1.0).count();
        let widest = placed().max_by(|a, b| a.0.total_cmp(&b.0));
        let widest = widest
            .map_or_else(String::new, |(gap, row)| format!("; the largest gap is {gap:.1} % ({})", row.robot.name));
        format!("coarse search, then refined; {near} of {count} values proved best to 1 %{widest}\n")
    }

    fn notes(&self) -> String {
        let rows = &self.ranking.rows;
        let mut notes = String::from(
            "* best of the robots of which no number is assumed; - no place was found (`stiffarm place --model spatial` says why)\n",
        );
        notes +=
            "planar #: place in the planar ranking of the same robots and tasks (zones in the arm plane, anywhere)\n";
        for row in &self.planar.rows {
            if let Some(error) = row.why_not_of_the_plane() {
                let _ = writeln!(notes, "n/a {}: {error}", row.robot.name);
            }
        }
        if rows.iter().any(|row| row.robot.status == Status::Estimated) {
            notes += "~ estimated: lengths or limits partly assumed; such a robot takes no place\n";
        }
        if rows.iter().any(|row| row.robot.architecture_is_assumed) {
            notes += ASSUMED_ARCHITECTURE;
        }
        let inside = |row: &&Row<SpatiallyPlaced>| {
            row.cells.iter().filter_map(SpatiallyPlaced::feasible).any(|best| best.from_axis_1 < COLUMN)
        };
        let names: Vec<&str> = rows.iter().filter(inside).map(|row| row.robot.name.as_str()).collect();
        if !names.is_empty() {
            let names = names.join(", ");
            let _ = writeln!(
                notes,
                "zones within {COLUMN} m of the joint-1 axis, where the robot's own base stands (--within keeps away): {names}"
            );
        }
        notes += &self.proof();
        notes += "collisions are not checked\n";
        notes
    }
}

impl Answer for RankAnswer {
    const COMMAND: &'static str = "rank";
    const FURTHER: &'static [&'static str] = &["svg", "png"];

    fn text(&self, markdown: bool) -> String {
        let Ranking { tasks, force, rows } = &self.ranking;
        let mut headings: Vec<String> = ["#", "robot", "architecture", "status"].map(Into::into).into();
        headings.extend(tasks.iter().map(|task| format!("{} mm", task.label)));
        headings.extend(["mean ratio".into(), "planar #".into()]);
        let mut table = Table::new(headings);
        for (row, place) in rows.iter().zip(self.ranking.places()) {
            let robot = &row.robot;
            let none = if robot.status == Status::Estimated { "~" } else { "-" };
            let or_estimated = |place: Option<usize>| place.map_or_else(|| none.to_owned(), |place| place.to_string());
            let mut cells = vec![or_estimated(place), robot.full_name(), architecture(robot), robot.status.to_string()];
            cells.extend((0..tasks.len()).map(|task| self.cell(row, task)));
            cells.push(if row.score.is_finite() { fixed(row.score, 3) } else { "-".into() });
            let planar = self.planar.place_of(robot).map(|place| place.to_string());
            cells.push(planar.unwrap_or_else(|| if none == "~" { "~".into() } else { "n/a".into() }));
            table.row(cells);
        }
        format!(
            "Worst deflection inside each flat zone at its best place, {force} N in the worst direction, spatial model\n\
             {}, tool {}; zones within {}\n\n{}\n{}\n{}\n",
            direction(self.options.elevation),
            tool(&self.options.flange_from_tool),
            window(&self.options.within),
            table.text(markdown),
            prose(&self.notes(), markdown),
            prose(&report::spatial::sentences(&self.ranking, &self.planar, self.tolerance_mm).join("\n"), markdown)
        )
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &report::spatial::ranking(&self.ranking, &self.planar, &self.options, self.tolerance_mm))
    }

    fn csv(&self) -> Table<'_> {
        let mut table = Table::new(["rank", "planar_rank"].into_iter().chain(CELL_COLUMNS));
        let number = |place: Option<usize>| place.map_or_else(String::new, |place| place.to_string());
        for (row, place) in self.ranking.rows.iter().zip(self.ranking.places()) {
            let planar = self.planar.place_of(&row.robot);
            for (task, placed) in self.ranking.tasks.iter().zip(&row.cells) {
                let mut cells = vec![number(place), number(planar)];
                cells.extend(cell_row(&row.robot, task, self.options.force, placed, self.tolerance_mm));
                table.row(cells);
            }
        }
        table
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(Ok(self.figure()))
    }
}
