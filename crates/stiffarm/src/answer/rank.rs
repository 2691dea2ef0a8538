//! How is a ranking told?

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::place::{Verdict, cell};
use super::words::{self, COLUMN, fixed};
use super::{Record, Rows, Table, columns_of, field, force, margins, stiffness, stiffnesses, uncertainty, with_schema};
use crate::drive::Architecture;
use crate::model::ModelKind;
use crate::place::{Column, Margins, PlaceError, PlaceOptions, Placement};
use crate::rank::{Cell, Ranking, Row};
use crate::robot::{Robot, Status};
use crate::uncertainty::chances;

/// A remark names no more robots than this.
const MOST_NAMED: usize = 12;

/// The answer of `rank`, with what was asked.
#[derive(Clone, Debug)]
pub struct RankAnswer {
    /// What was found.
    pub ranking: Ranking,
    /// What was asked of every placement.
    pub options: PlaceOptions,
    /// The largest deflection that is acceptable, mm.
    pub tolerance_mm: Option<f64>,
}

impl RankAnswer {
    /// Every field.
    pub fn record(&self) -> Record {
        let Ranking { tasks, load, model, .. } = &self.ranking;
        let mut record = Record::new();
        record.put(field::TASKS, json!(tasks.iter().map(|task| &task.label).collect::<Vec<_>>()));
        force::put(&mut record, *load);
        record
            .put(field::MODEL, model.name())
            .put(field::ROWS, self.rows_json())
            .put(field::WINNERS, self.winners())
            .put(field::SUMMARY, json!(self.sentences()));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("rank", super::ORIGIN, &self.record())
    }

    fn rows_json(&self) -> Value {
        let chances = chances(&self.ranking);
        let told = self.ranking.rows.iter().zip(&chances).map(|(row, chances)| {
            let cells: Value = self.cells(row).map(|cell| cell.json()).collect();
            let mut record = Record::new();
            stiffness::put_robot(&mut record, &row.robot);
            record.extend(self.standing(row));
            uncertainty::put_chances(&mut record, chances);
            record.put(field::CELLS, cells);
            record.json()
        });
        told.collect()
    }

    /// Where a robot stands among the others.
    fn standing(&self, row: &Row) -> Record {
        let planar_rank = self.ranking.in_plane.as_ref().and_then(|planar| planar.rank_of(&row.robot));
        let mut record = Record::new();
        record
            .put(field::RANK, row.rank)
            .put(field::PLANAR_RANK, planar_rank)
            .put(field::BOUND, row.floor)
            .put(field::MEAN_RATIO, row.mean_ratio);
        record
    }

    /// One record per task of a robot.
    fn cells<'a>(&'a self, row: &'a Row) -> impl Iterator<Item = Record> + 'a {
        let Ranking { tasks, model, .. } = &self.ranking;
        tasks.iter().zip(&row.cells).map(move |(task, placed)| {
            cell(&row.robot, task, (model, &self.options), placed.as_ref(), self.tolerance_mm)
        })
    }

    fn winners(&self) -> Value {
        let Ranking { tasks, .. } = &self.ranking;
        let told = tasks.iter().enumerate().map(|(task, asked)| {
            let name = |row: Option<&Row>| row.map(|row| row.robot.name.clone());
            let of = |architecture| name(self.ranking.best(task, |robot| robot.architecture == architecture));
            let mut record = Record::new();
            record
                .put(field::TASK, &asked.label)
                .put(field::BEST, name(self.ranking.best_published(task)))
                .put(field::BEST_WITH_ESTIMATED, name(self.ranking.best(task, |_| true)))
                .put(field::BEST_SERIAL, of(Architecture::Serial))
                .put(field::BEST_QUASI_SERIAL, of(Architecture::QuasiSerial));
            record.json()
        });
        told.collect()
    }

    /// One row per robot and task, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        let mut columns =
            [field::RANK, field::PLANAR_RANK, field::BOUND, field::MEAN_RATIO].map(|f| columns_of(&f)).concat();
        let mut rows = Vec::new();
        for row in &self.ranking.rows {
            for record in self.cells(row) {
                if rows.is_empty() {
                    columns.extend(record.columns());
                }
                rows.push([self.standing(row).cells(), record.cells()].concat());
            }
        }
        Rows::new(columns, rows)
    }

    /// For people: one row per robot.
    pub fn table(&self) -> Table {
        let Ranking { tasks, rows, in_plane, .. } = &self.ranking;
        let mut headings: Vec<String> = ["#", "robot", "architecture", "status"].map(Into::into).into();
        if in_plane.is_none() {
            headings.push("bound".into());
        }
        headings.extend(tasks.iter().map(|task| task.label.clone()));
        headings.push("mean ratio".into());
        if in_plane.is_some() {
            headings.push("planar #".into());
        }
        let mut table = Table::new(headings).with_room(2, &["bound", "mean ratio", "status", "architecture"]);
        for row in rows {
            let robot = &row.robot;
            let estimated = robot.status == Status::Estimated;
            let or_none = |rank: Option<usize>| {
                let none = if estimated { "~" } else { "n/a" };
                rank.map_or_else(|| none.to_owned(), |rank| rank.to_string())
            };
            let mut cells = vec![
                or_none(row.rank),
                format!("{}{}", robot.full_name(), if estimated { " ~" } else { "" }),
                words::architecture(robot),
                robot.status.to_string(),
            ];
            if in_plane.is_none() {
                cells.push(row.floor.map_or_else(|| "n/a".to_owned(), |floor| fixed(floor * 1e3, 3)));
            }
            cells.extend((0..tasks.len()).map(|task| self.told(row, task)));
            cells.push(row.mean_ratio.map_or_else(|| "-".into(), |ratio| fixed(ratio, 3)));
            cells.extend(in_plane.as_ref().map(|planar| or_none(planar.rank_of(robot))));
            table.row(cells);
        }
        table
    }

    /// `1.234`, marked when it is the best of its column, with the margin where a tolerance is given.
    fn told(&self, row: &Row, task: usize) -> String {
        let Some(deflection) = row.deflection(task) else {
            return match &row.cells[task] {
                Ok(_) => "-".into(),
                Err(error) if error.is_not_of_the_plane() => "n/a".into(),
                Err(_) => "?".into(),
            };
        };
        let is = |best: Option<&Row>| best.is_some_and(|best| best.robot == row.robot);
        let published = self.ranking.best_published(task);
        let beats =
            row.robot.status == Status::Estimated && is(self.ranking.best(task, |_| true)) && published.is_some();
        let mark = match (is(published), beats) {
            (true, _) => "*",
            (false, true) => "~",
            (false, false) => "",
        };
        let verdict = self.tolerance_mm.map_or_else(String::new, |tolerance| {
            let verdict = Verdict::of(deflection, tolerance);
            format!(" {} {:+.3}", verdict.word(), verdict.margin_mm)
        });
        format!("{}{mark}{verdict}", fixed(deflection * 1e3, 3))
    }

    /// What stands above the table.
    pub fn heading(&self) -> String {
        let acting = words::acting(self.ranking.load);
        let springs = stiffnesses(self.ranking.rows.iter().map(|row| &row.robot));
        match &self.ranking.model {
            ModelKind::Planar => {
                let gap = self.options.gap();
                format!(
                    "Worst deflection [mm] inside each zone at its best place, {acting}\nplanar model; {springs}; proved to {gap}\n{}\n{}\n",
                    self.stance(),
                    self.kept()
                )
            }
            ModelKind::Spatial(_) => format!(
                "Worst deflection [mm] inside each flat zone at its best place, {acting}\nspatial model; {springs}\n{}\n{}\n",
                self.stance(),
                self.kept()
            ),
        }
    }

    /// What every place keeps.
    fn kept(&self) -> String {
        let margins = &self.options.margins;
        if *margins == Margins::NONE && self.ranking.model == ModelKind::Planar {
            // The ranking of which nothing is said, too.
            return format!("the paper's convention: {}", margins::of_all(margins));
        }
        margins::of_all(margins)
    }

    /// How the tool is held, and where zones may stand.
    pub fn stance(&self) -> String {
        let model = &self.ranking.model;
        let asked = self.options.within(model);
        // Of robots of which the base is known; the others have neither a floor nor a column.
        let known = self.ranking.rows.iter().find(|row| row.robot.knows_base());
        let within = known.map_or(asked, |row| margins::window(&self.options, model, &row.robot));
        let within = words::window(&within, "the base");
        match &self.ranking.model {
            ModelKind::Planar => format!("zones {within}"),
            ModelKind::Spatial(tool) => {
                let elevation = super::cell::elevation(&self.options);
                if let Some(cell) = &self.options.cell {
                    let told = super::cell::lines(cell, &self.options.within(&self.ranking.model));
                    let told: Vec<String> = told.iter().map(|[name, says]| format!("{name}: {says}")).collect();
                    return format!("{}, tool {}; {}", words::direction(elevation), words::tool(tool), told.join("; "));
                }
                format!("{}, tool {}; zones within {within}", words::direction(elevation), words::tool(tool))
            }
        }
    }

    /// What stands below the table: what the marks mean, and what is odd.
    pub fn notes(&self) -> String {
        let Ranking { rows, tasks, in_plane, .. } = &self.ranking;
        let mut notes = String::from("* best of the robots whose geometry is published");
        if rows.iter().any(|row| row.robot.status == Status::Estimated) {
            notes += "; ~ estimated robot: it cannot win, even where its value is smaller";
        }
        notes += match in_plane {
            None => "; - the zone does not fit (`stiffarm place` says why)\n",
            Some(_) => "; - no place was found (`stiffarm place --model spatial` says why)\n",
        };
        if in_plane.is_some() {
            let worst = if self.ranking.load.is_worst() { "" } else { ", the force in its worst direction" };
            let _ = writeln!(
                notes,
                "planar #: rank in the planar ranking of the same robots and tasks (zones in the arm plane, anywhere{worst})"
            );
        }
        if in_plane.is_some() && tasks.iter().any(|task| task.part.is_some()) {
            let _ = writeln!(notes, "n/a in the plane: {}", PlaceError::PartInPlane);
        }
        for row in in_plane.as_ref().map_or(rows, |planar| &planar.rows) {
            if let Some(error) = row.why_not_of_the_plane().filter(|error| **error != PlaceError::PartInPlane) {
                let advice = if in_plane.is_none() { " (--model spatial)" } else { "" };
                let _ = writeln!(notes, "n/a {}: {error}{advice}", row.robot.name);
            }
        }
        let unfinished = |cell: &Cell| cell.as_ref().is_err_and(|error| !error.is_not_of_the_plane());
        if rows.iter().any(|row| row.cells.iter().any(unfinished)) {
            notes += "? the search for a place did not end; `stiffarm place` says between which values\n";
        }
        notes += &self.overloaded();
        notes += &self.below_base();
        notes += &self.in_column();
        notes += words::assumed_architecture(rows.iter().map(|row| &row.robot));
        if in_plane.is_none() && self.ranking.load.is_worst() {
            notes += "bound: deflection at the stiffest posture of the links; no placement of any task has less\n";
        }
        notes += &words::statuses(rows.iter().map(|row| &row.robot));
        if in_plane.is_some() {
            notes += &self.proof();
            notes += &self.colliding();
            notes += "clearance (JSON, CSV): links as capsules, coarse, at the poses of each answer; nothing is known of tables and fixtures\n";
        }
        notes
    }

    /// Counts the robots of which the force is more than the weight they are sold to carry.
    fn overloaded(&self) -> String {
        let held = self.ranking.load.newtons() / 9.81;
        let rows = &self.ranking.rows;
        let light = |row: &&Row| row.robot.stiffness_is_assumed && row.robot.payload_kg.is_some_and(|kg| kg < held);
        let count = rows.iter().filter(light).count();
        if count == 0 {
            return String::new();
        }
        let (of, least) = (rows.len(), held.ceil());
        format!(
            "{count} of {of} robots are sold for less than this force ({held:.0} kg), and the 1 urad/(N m) that is assumed on every drive is that of \
             heavy robots: --payload-kg {least}.. leaves them out\n"
        )
    }

    /// Robots with the tasks of which the place is as `odd` says.
    fn named(&self, odd: impl Fn(&Placement) -> bool) -> Option<String> {
        let mut found = Vec::new();
        for row in &self.ranking.rows {
            let tasks: Vec<&str> = (0..row.cells.len())
                .filter(|&task| row.placement(task).is_some_and(&odd))
                .map(|task| self.ranking.tasks[task].label.as_str())
                .collect();
            if !tasks.is_empty() {
                found.push(format!("{} on {}", row.robot.name, tasks.join(", ")));
            }
        }
        let more = found.len().saturating_sub(MOST_NAMED);
        let is_some = !found.is_empty();
        found.truncate(MOST_NAMED);
        let more = if more == 0 { String::new() } else { format!("; and {more} robots more") };
        is_some.then(|| format!("{}{more}", found.join("; ")))
    }

    /// Names the places that lie partly below the base: reached, but rarely meant.
    fn below_base(&self) -> String {
        let named = self.named(|best| best.outside.is_some_and(|outside| outside.below));
        named.map_or_else(String::new, |names| {
            format!("zones partly below the base (--floor 0 keeps them above): {names}\n")
        })
    }

    /// Names the places in space where most robots have their own base.
    fn in_column(&self) -> String {
        if self.options.margins.column != Column::Radius(0.0) {
            return String::new();
        }
        let named = self.named(|best| best.space().is_some() && best.from_axis_1.is_some_and(|near| near < COLUMN));
        named.map_or_else(String::new, |names| {
            format!(
                "zones within {COLUMN} m of the joint-1 axis, where the robot's own base stands (--clear-of-base-m keeps away): {names}\n"
            )
        })
    }

    /// Names the places in space where the arm overlaps with something.
    fn colliding(&self) -> String {
        let named = self.named(|best| best.space().is_some() && best.collides());
        named.map_or_else(String::new, |names| {
            format!("COLLISION at the place (`stiffarm place --model spatial` says of what): {names}\n")
        })
    }

    /// How far the values in space are from being proved best.
    fn proof(&self) -> String {
        let rows = &self.ranking.rows;
        let placed = || {
            let cells = rows.iter().flat_map(|row| (0..row.cells.len()).map(move |task| (row, task)));
            cells.filter_map(|(row, task)| Some((100.0 * row.placement(task)?.gap(), row)))
        };
        let count = placed().count();
        let near = placed().filter(|(gap, _)| *gap <= 1.0).count();
        let widest = placed().max_by(|a, b| a.0.total_cmp(&b.0));
        let widest = widest
            .map_or_else(String::new, |(gap, row)| format!("; the largest gap is {gap:.1} % ({})", row.robot.name));
        format!("coarse search, then refined; {near} of {count} values proved best to 1 %{widest}\n")
    }

    /// What a manager would read.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = vec![self.winning()];
        sentences.extend(self.elsewhere());
        sentences.extend(self.by_architecture());
        sentences.extend(self.estimated_rivals());
        sentences.extend(self.tolerance_mm.map(|tolerance| self.within_tolerance(tolerance)));
        sentences.extend(uncertainty::sentences(&self.ranking));
        sentences
    }

    /// Why the answer is no, where it is: no robot of published geometry has a place for every task and holds the tolerance there.
    pub fn shortfall(&self) -> Option<String> {
        let holds =
            |deflection: f64| self.tolerance_mm.is_none_or(|tolerance| Verdict::of(deflection, tolerance).passes);
        let does =
            |row: &&Row| row.rank.is_some() && (0..row.cells.len()).all(|task| row.deflection(task).is_some_and(holds));
        if self.ranking.rows.iter().any(|row| does(&row)) {
            return None;
        }
        Some(match self.tolerance_mm {
            Some(tolerance) => format!("no robot of published geometry holds {tolerance} mm on every task"),
            None => "no robot of published geometry has a place for every task".into(),
        })
    }

    /// The tasks of each robot that `pick` names for a task, in the order in which robots are named first.
    fn tasks_by_robot<'a>(&self, pick: impl Fn(usize) -> Option<&'a Row>) -> Vec<(&'a Row, Vec<usize>)> {
        let mut found: Vec<(&Row, Vec<usize>)> = Vec::new();
        for task in 0..self.ranking.tasks.len() {
            let Some(picked) = pick(task) else { continue };
            match found.iter_mut().find(|(row, _)| row.robot == picked.robot) {
                Some((_, tasks)) => tasks.push(task),
                None => found.push((picked, vec![task])),
            }
        }
        found
    }

    fn labels(&self, tasks: &[usize]) -> String {
        tasks.iter().map(|&task| self.ranking.tasks[task].label.as_str()).collect::<Vec<_>>().join(", ")
    }

    fn winning(&self) -> String {
        let ranking = &self.ranking;
        let winners = self.tasks_by_robot(|task| ranking.best_published(task));
        if winners.is_empty() {
            return "No robot whose geometry is published can do any of these tasks.".into();
        }
        let won = |(row, tasks): &(&Row, Vec<usize>)| {
            let told = |&task: &usize| format!("{} ({} mm)", ranking.tasks[task].label, millimetres(row, task));
            format!("{} for {}", row.robot.full_name(), tasks.iter().map(told).collect::<Vec<_>>().join(", "))
        };
        let list: Vec<String> = winners.iter().map(won).collect();
        let collides =
            |row: &Row, task: usize| row.placement(task).is_some_and(|best| best.space().is_some() && best.collides());
        if winners.iter().any(|(row, tasks)| tasks.iter().any(|&task| collides(row, task))) {
            return format!(
                "Under {} the least deflection is that of {}; but an arm collides there, so no robot is advised.",
                words::acting(ranking.load),
                list.join("; ")
            );
        }
        let fails = |row: &Row, task: usize| {
            let told = self.tolerance_mm.zip(row.deflection(task));
            told.is_some_and(|(tolerance, deflection)| !Verdict::of(deflection, tolerance).passes)
        };
        if winners.iter().any(|(row, tasks)| tasks.iter().any(|&task| fails(row, task))) {
            return format!(
                "Under {} the least deflection is that of {}; it does not keep the tolerance everywhere, so no robot is advised.",
                words::acting(ranking.load),
                list.join("; ")
            );
        }
        format!("Under {} take {}.", words::acting(ranking.load), list.join("; "))
    }

    /// Where the planar model alone would have chosen another robot.
    fn elsewhere(&self) -> Option<String> {
        let planar = self.ranking.in_plane.as_ref()?;
        let other = |task: usize| {
            let best = planar.best_published(task)?;
            let same = self.ranking.best_published(task).is_some_and(|row| row.robot == best.robot);
            (!same).then_some(best)
        };
        let others: Vec<String> = self
            .tasks_by_robot(other)
            .iter()
            .map(|(row, tasks)| format!("{} for {}", row.robot.full_name(), self.labels(tasks)))
            .collect();
        (!others.is_empty()).then(|| format!("The planar model alone would take {}.", others.join("; ")))
    }

    fn by_architecture(&self) -> Option<String> {
        let ranking = &self.ranking;
        let best = |task, architecture| ranking.best(task, |robot: &Robot| robot.architecture == architecture);
        let compared = |task: usize| {
            let (serial, quasi) = (best(task, Architecture::Serial)?, best(task, Architecture::QuasiSerial)?);
            let show = |row: &Row| {
                let mark = if row.robot.status == Status::Estimated { "~" } else { "" };
                format!("{}{mark}", millimetres(row, task))
            };
            let sign = if serial.deflection(task) <= quasi.deflection(task) { "<" } else { ">" };
            Some(format!("{} {} {sign} {}", ranking.tasks[task].label, show(serial), show(quasi)))
        };
        let cells: Vec<String> = (0..ranking.tasks.len()).filter_map(compared).collect();
        let assumed = |task| best(task, Architecture::Serial).is_some_and(|row| row.robot.architecture_is_assumed);
        let serial = if (0..ranking.tasks.len()).any(assumed) { "serial?" } else { "serial" };
        (!cells.is_empty()).then(|| format!("Best {serial} against best quasi-serial, mm: {}.", cells.join("; ")))
    }

    fn estimated_rivals(&self) -> Option<String> {
        let ranking = &self.ranking;
        let rivals = self.tasks_by_robot(|task| {
            let best = ranking.best(task, |_| true)?;
            let rivals = best.robot.status == Status::Estimated && ranking.best_published(task).is_some();
            rivals.then_some(best)
        });
        let rivals: Vec<String> =
            rivals.iter().map(|(row, tasks)| format!("{} on {}", row.robot.name, self.labels(tasks))).collect();
        (!rivals.is_empty()).then(|| {
            format!(
                "By estimated numbers {} would be stiffer: find its data sheet before you decide.",
                rivals.join("; ")
            )
        })
    }

    fn within_tolerance(&self, tolerance: f64) -> String {
        let keeps = |row: &&Row| {
            (0..row.cells.len())
                .all(|task| row.deflection(task).is_some_and(|deflection| Verdict::of(deflection, tolerance).passes))
        };
        let passing: Vec<String> =
            self.ranking.rows.iter().filter(keeps).map(|row| words::marked(&row.robot)).collect();
        if passing.is_empty() {
            format!("No robot keeps {tolerance} mm on every task.")
        } else {
            format!("{tolerance} mm on every task: {}.", passing.join(", "))
        }
    }
}

/// Of a row that has a place for the task.
fn millimetres(row: &Row, task: usize) -> String {
    row.deflection(task).map_or_else(|| "-".to_owned(), |deflection| fixed(deflection * 1e3, 2))
}
