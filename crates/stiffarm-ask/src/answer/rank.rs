//! How is a ranking reported?

mod collisions;
mod notes;
mod robots;
mod sentences;
mod table;

use std::sync::OnceLock;

use serde_json::{Value, json};

use super::payload::{Carried, FlangeLoad};
use super::place::{put_advice, put_placement, verdict_at};
use super::uncertainty::{self, Known};
use super::verdict::Verdict;
use super::words;
use super::{Datum, Record, Rows, field, force, margins, shape, stiffness, stiffnesses, with_schema};
use stiffarm::advice::Advice;
use stiffarm::clearance::Clearance;
use stiffarm::drive::Architecture;
use stiffarm::model::ModelKind;
use stiffarm::place::{Margins, PlaceOptions};
use stiffarm::rank::{Rank, Ranking, Row};
use stiffarm::robot::{Robot, Status};
use stiffarm::uncertainty::{Chances, Spread, chances_of, drawn_in};

/// The answer of `rank`, with what was asked.
#[derive(Clone, Debug)]
pub struct RankAnswer {
    /// What was found.
    pub ranking: Ranking,
    /// What was asked of every placement.
    pub options: PlaceOptions,
    /// The largest deflection that is acceptable, mm.
    pub tolerance_mm: Option<f64>,
    /// What that says of force, stiffness and size, for each row and task for which advice was asked; empty where it was not.
    pub advice: Vec<Vec<Option<Advice>>>,
    /// How every row stands at every task, over draws of the stiffness of its drives.
    pub(super) chances: Vec<Vec<Option<Chances>>>,
    /// Where the deflection of every row at every task lies, and how likely it keeps the tolerance.
    known: Vec<Vec<Option<Known>>>,
    /// How near the arm of every row comes to anything at its place for every task.
    clearances: OnceLock<Vec<Vec<Option<Clearance>>>>,
}

impl RankAnswer {
    /// Of a ranking, with what was asked, the acceptable deflection, mm, and the advice on it.
    pub fn of(
        ranking: Ranking,
        options: PlaceOptions,
        tolerance_mm: Option<f64>,
        advice: Vec<Vec<Option<Advice>>>,
    ) -> Self {
        let drawn = drawn_in(&ranking);
        let known = |of_task: Option<Vec<f64>>| of_task.map(|draws| Known::of(draws, tolerance_mm));
        let judged = drawn.iter().map(|of_row| of_row.iter().cloned().map(known).collect()).collect();
        let clearances = OnceLock::new();
        let mut answer =
            Self { ranking, options, tolerance_mm, advice, chances: Vec::new(), known: judged, clearances };
        // Who is not to be taken wins nothing, and ties with nobody.
        let may_win = |(row, of_row): (&Row, Vec<_>)| {
            if answer.is_barred(row) { vec![None; of_row.len()] } else { of_row }
        };
        let drawn: Vec<Vec<_>> = answer.ranking.rows.iter().zip(drawn).map(may_win).collect();
        answer.chances = chances_of(&answer.ranking, &drawn);
        answer
    }

    /// The stiffest robot for a task among those that may be taken and that `filter` lets pass; where none of them has a place, among the
    /// others.
    pub(super) fn best(&self, task: usize, filter: impl Fn(&Robot) -> bool) -> Option<&Row> {
        let of = |may_be_barred| {
            self.ranking.best(task, |row| filter(&row.robot) && (may_be_barred || !self.is_barred(row)))
        };
        of(false).or_else(|| of(true))
    }

    /// The same among robots of which no number is assumed.
    pub fn best_published(&self, task: usize) -> Option<&Row> {
        self.best(task, |robot| robot.status != Status::Estimated)
    }

    /// Those that may be as good as the best at a task, and may be taken.
    pub(super) fn rivals(&self, task: usize) -> Vec<&Row> {
        let rivals = self.best_published(task).map_or_else(Vec::new, |best| self.ranking.rivals_of(best, task));
        rivals.into_iter().filter(|row| !self.is_barred(row)).collect()
    }

    /// Where a row of the ranking stands in it.
    pub(super) fn at(&self, row: &Row) -> usize {
        let is_it = |one: &Row| std::ptr::eq(one, row);
        self.ranking.rows.iter().position(is_it).expect("a row of the ranking")
    }

    /// Whether a row keeps the tolerance at a task; `None` where there is no tolerance, or no place.
    pub fn verdict(&self, at: usize, task: usize) -> Option<Verdict> {
        let row = &self.ranking.rows[at];
        let (best, tolerance) = row.placement(task).zip(self.tolerance_mm)?;
        let clearance = self.clearance(at, task);
        Some(verdict_at(best, tolerance, self.known[at][task], (clearance.as_ref(), self.carried(&row.robot))))
    }

    /// Of some robot something states the uncertainty of its drive stiffness.
    pub(super) fn known_of_any(&self) -> bool {
        self.known.iter().flatten().any(Option::is_some)
    }

    /// The same of a row of the ranking.
    pub(super) fn verdict_of(&self, row: &Row, task: usize) -> Option<Verdict> {
        self.verdict(self.at(row), task)
    }

    /// What a robot must hold.
    pub(super) fn carried(&self, robot: &Robot) -> Carried {
        FlangeLoad::of(self.options.tool_weight, &self.ranking.model, self.ranking.load.newtons()).by(robot)
    }

    /// Where the deflection of a row at a task lies with 90 %, over draws of the stiffness of its drives.
    pub fn spread(&self, at: usize, task: usize) -> Option<Spread> {
        Some(self.known[at][task]?.spread)
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Ranking { tasks, load, model, .. } = &self.ranking;
        let mut record = Record::of(&shape::RANKING);
        record.put(field::TASKS, json!(tasks.iter().map(|task| &task.label).collect::<Vec<_>>()));
        force::put(&mut record, *load);
        record
            .put(field::MODEL, model.name())
            .put(field::ROWS, self.robots())
            .put(field::WINNERS, self.winners())
            .put(field::SUMMARY, json!(self.sentences()));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("rank", super::ORIGIN, &self.record())
    }

    fn robots(&self) -> Datum {
        let ranks = self.ranks();
        let rows = self.ranking.rows.iter().zip(&self.chances).enumerate().map(|(at, (row, chances))| {
            let mut record = Record::of(&shape::RANKING_ROW);
            stiffness::put_robot(&mut record, &row.robot);
            record.extend(self.standing(row));
            uncertainty::put_chances(&mut record, chances);
            record.put(field::CELLS, self.cells(at, &ranks).collect::<Datum>());
            record
        });
        rows.collect()
    }

    /// Of every task: the rank of every row in it alone.
    fn ranks(&self) -> Vec<Vec<Option<Rank>>> {
        (0..self.ranking.tasks.len()).map(|task| self.ranking.ranks(task)).collect()
    }

    /// Where a robot stands among the others.
    fn standing(&self, row: &Row) -> Record {
        let planar_rank = self.ranking.in_plane.as_ref().and_then(|planar| planar.row_of(&row.robot)?.rank);
        let mut record = Record::of(&shape::STANDING);
        record
            .put(field::RANK, row.rank.map(|rank| rank.place))
            .put(field::RANK_TIED, row.rank.map(|rank| rank.is_tied))
            .put(field::PLANAR_RANK, planar_rank.map(|rank| rank.place))
            .put(field::BOUND, row.floor)
            .put(field::MEAN_RATIO, row.mean_ratio)
            .put(field::MEAN_RATIO_BOUND, row.mean_ratio_bound);
        record
    }

    /// One record per task of a robot.
    fn cells<'a>(&'a self, at: usize, ranks: &'a [Vec<Option<Rank>>]) -> impl Iterator<Item = Record> + 'a {
        let Ranking { tasks, model, rows, .. } = &self.ranking;
        let Row { robot, cells, .. } = &rows[at];
        tasks.iter().zip(cells).zip(ranks).enumerate().map(move |(column, ((task, placed), ranks))| {
            let known = self.known[at][column];
            let mut record = Record::of(&shape::PLACEMENT_IN_RANKING);
            put_placement(
                &mut record,
                robot,
                task,
                (model, &self.options),
                placed.as_ref(),
                (self.tolerance_mm, known),
            );
            record
                .put(field::TASK_RANK, ranks[at].map(|rank| rank.place))
                .put(field::TASK_RANK_TIED, ranks[at].map(|rank| rank.is_tied));
            put_advice(&mut record, self.advised(at, column), (task, self.options.load));
            record
        })
    }

    /// The advice on a task of a row.
    fn advised(&self, at: usize, task: usize) -> Option<&Advice> {
        self.advice.get(at)?.get(task)?.as_ref()
    }

    fn winners(&self) -> Datum {
        let Ranking { tasks, .. } = &self.ranking;
        let winners = tasks.iter().enumerate().map(|(task, asked)| {
            let name = |row: Option<&Row>| row.map(|row| row.robot.name.clone());
            let of = |architecture| name(self.best(task, |robot| robot.architecture == architecture));
            let best = self.best_published(task);
            let rivals: Vec<&str> = self.rivals(task).iter().map(|row| row.robot.name.as_str()).collect();
            let mut record = Record::of(&shape::WINNER);
            record
                .put(field::TASK, &asked.label)
                .put(field::BEST, name(best))
                .put(field::DISTINGUISHED, best.map(|best| rivals.is_empty() && !self.is_barred(best)))
                .put(field::RIVALS, json!(rivals))
                .put(field::BEST_WITH_ESTIMATED, name(self.best(task, |_| true)))
                .put(field::BEST_SERIAL, of(Architecture::Serial))
                .put(field::BEST_QUASI_SERIAL, of(Architecture::QuasiSerial));
            record
        });
        winners.collect()
    }

    /// One row per robot and task, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        let columns = [shape::STANDING.columns(), shape::PLACEMENT_IN_RANKING.columns()].concat();
        let (mut rows, ranks) = (Vec::new(), self.ranks());
        for (at, row) in self.ranking.rows.iter().enumerate() {
            let standing = self.standing(row).cells();
            rows.extend(self.cells(at, &ranks).map(|record| [standing.clone(), record.cells()].concat()));
        }
        Rows::new(columns, rows)
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
                    self.tool_orientation(),
                    self.kept()
                )
            }
            ModelKind::Spatial(_) => format!(
                "Worst deflection [mm] inside each flat zone at its best place, {acting}\nspatial model; {springs}\n{}\n{}\n",
                self.tool_orientation(),
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
    pub fn tool_orientation(&self) -> String {
        let model = &self.ranking.model;
        let asked = self.options.within(model);
        // Of robots of which the base is known; the others have neither a floor nor a column.
        let known = self.ranking.rows.iter().find(|row| row.robot.knows_base());
        let within = known.map_or(asked, |row| margins::window(&self.options, model, &row.robot));
        let within = words::window(&within, "the base");
        match &self.ranking.model {
            ModelKind::Planar => format!("zones {}, {within}", words::UPRIGHT),
            ModelKind::Spatial(tool) => {
                let elevation = super::cell::elevation(&self.options);
                if let Some(cell) = &self.options.cell {
                    let lines = super::cell::lines(cell, &self.options.within(&self.ranking.model));
                    let parts: Vec<String> = lines.iter().map(|[name, says]| format!("{name}: {says}")).collect();
                    return format!(
                        "{}, tool {}; {}",
                        words::direction(elevation),
                        words::tool(tool),
                        parts.join("; ")
                    );
                }
                format!("{}, tool {}; zones within {within}", words::direction(elevation), words::tool(tool))
            }
        }
    }
}
