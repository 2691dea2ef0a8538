//! Every published number beside the computed one, and the list of those that disagree, with reasons.

use std::collections::BTreeMap;

use crate::catalogue::{names, paper_robots};
use crate::drive::Architecture;
use crate::load::Load;
use crate::model::{Model, ModelError};
use crate::place::{PlaceError, PlaceOptions, best_without_limits, largest_scale_without_limits, place};
use crate::plane::PlanarArm;
use crate::robot::{Arm, Robot};
use crate::study::{Contender, Study, StudyOptions, study};
use crate::task::{Task, TaskError, Zone};
use crate::watch::Watch;

/// What the ledger reads, as CSV texts: what is printed, and which cells are known to disagree.
#[derive(Clone, Copy, Debug)]
pub struct Printed<'a> {
    /// `item,cell,printed`.
    pub text: &'a str,
    /// `task,mu,d,architecture,accuracy`.
    pub table_1: &'a str,
    /// `robot,l2_over_l3,working_radius_m`.
    pub table_2: &'a str,
    /// `robot`, then one column per task.
    pub table_3: &'a str,
    /// `source,item,cell,reason`.
    pub disagreements: &'a str,
    /// `reason,explanation`.
    pub reasons: &'a str,
}

impl Printed<'static> {
    /// The ledger of this repository, `printed/` beside the sources.
    pub const PAPER: Self = Self {
        text: include_str!("../printed/text.csv"),
        table_1: include_str!("../printed/table1.csv"),
        table_2: include_str!("../printed/table2.csv"),
        table_3: include_str!("../printed/table3.csv"),
        disagreements: include_str!("../printed/disagreements.csv"),
        reasons: include_str!("../printed/reasons.csv"),
    };
}

/// One published number.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Where it is printed.
    pub source: &'static str,
    /// Row.
    pub item: String,
    /// Column.
    pub cell: String,
    /// The digits as printed; `-` where nothing fits.
    pub printed: String,
    /// What it computes to, in the unit of the print; absent where nothing fits.
    pub computed: Option<f64>,
    /// It rounds to the printed digits.
    pub agrees: bool,
    /// Why it is known to disagree, where it is listed.
    pub note: Option<String>,
}

impl Entry {
    /// Agrees and is not listed, or disagrees and is.
    pub fn is_settled(&self) -> bool {
        self.agrees != self.note.is_some()
    }
}

/// A ledger that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum LedgerError {
    /// Not CSV, or not of the expected columns.
    #[error("{file}: {message}")]
    Csv {
        /// Which.
        file: &'static str,
        /// What is wrong.
        message: String,
    },
    /// The paper's study cannot be made.
    #[error(transparent)]
    Study(#[from] crate::study::StudyError),
    /// A robot of the paper cannot be judged.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// A column names no task.
    #[error(transparent)]
    Task(#[from] TaskError),
    /// A row names what the ledger cannot compute.
    #[error("{file}: '{item}', '{cell}' is not known")]
    Unknown {
        /// Which.
        file: &'static str,
        /// Row.
        item: String,
        /// Column.
        cell: String,
    },
}

type Key = (String, String, String);

/// Computes every published number and compares it with the print.
///
/// ```
/// use stiffarm::ledger::{Printed, validate};
///
/// let entries = validate(&Printed::PAPER)?;
/// assert!(entries.iter().all(|entry| entry.is_settled()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Where a text is not a table of the expected columns, or lists a disagreement that is not printed anywhere.
pub fn validate(printed: &Printed) -> Result<Vec<Entry>, LedgerError> {
    let robots = paper_robots();
    let study = study(&StudyOptions::paper())?;
    let mut listed = listed(printed)?;
    let mut entries = Vec::new();
    let mut add = |source: &'static str, item: &str, cell: &str, printed: &str, computed: Option<f64>| {
        let note = listed.remove(&(source.to_owned(), item.to_owned(), cell.to_owned()));
        let agrees = agrees(printed, computed);
        entries.push(Entry {
            source,
            item: item.into(),
            cell: cell.into(),
            printed: printed.into(),
            computed,
            agrees,
            note,
        });
    };
    for [item, cell, figure] in rows("text.csv", printed.text)? {
        let computed = text_figure(&robots, &study, &item, &cell)?;
        add("text", &item, &cell, &figure, computed);
    }
    for [task, mu, d, architecture, figure] in rows("table1.csv", printed.table_1)? {
        let cell = format!("mu {mu}, d {d}, {architecture}");
        let computed = table_1(&study, &task, &mu, &d, &architecture).ok_or_else(|| LedgerError::Unknown {
            file: "table1.csv",
            item: task.clone(),
            cell: cell.clone(),
        })?;
        add("Table I", &format!("Task {task}"), &cell, &figure, computed);
    }
    for [robot, ratio, radius] in rows("table2.csv", printed.table_2)? {
        let links = links(&robots, &robot).ok_or_else(|| LedgerError::Unknown {
            file: "table2.csv",
            item: robot.clone(),
            cell: String::new(),
        })?;
        add("Table II", &robot, "l2/l3", &ratio, Some(links.l2 / links.l3));
        add("Table II", &robot, "working radius, m", &radius, Some(links.a1 + links.l2 + links.l3));
    }
    let tasks = ["A_0.1", "A_1.0", "B_0.1", "B_0.5", "C_0.05", "C_0.15"];
    for row in rows::<7>("table3.csv", printed.table_3)? {
        for (column, figure) in tasks.iter().zip(&row[1..]) {
            let label = column.replace('_', ":");
            let robot = find(&robots, &row[0]).ok_or_else(|| LedgerError::Unknown {
                file: "table3.csv",
                item: row[0].clone(),
                cell: label.clone(),
            })?;
            add("Table III", &row[0], &label, figure, deflection_mm(robot, &label)?);
        }
    }
    match listed.into_keys().next() {
        None => Ok(entries),
        Some((_, item, cell)) => Err(LedgerError::Unknown { file: "disagreements.csv", item, cell }),
    }
}

/// Does the number round to the printed digits?
fn agrees(printed: &str, computed: Option<f64>) -> bool {
    match (printed.parse::<f64>(), computed) {
        (Ok(figure), Some(computed)) => {
            let digits = printed.split_once('.').map_or(0, |(_, digits)| digits.len());
            let half_unit = 0.5 * 10_f64.powi(-(digits as i32));
            (computed - figure).abs() <= half_unit * (1.0 + 1e-6)
        }
        (Err(_), None) => printed == "-",
        _ => false,
    }
}

fn rows<const N: usize>(file: &'static str, text: &str) -> Result<Vec<[String; N]>, LedgerError> {
    let error = |message: String| LedgerError::Csv { file, message };
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    reader
        .records()
        .map(|record| {
            let record = record.map_err(|e| error(e.to_string()))?;
            let fields: Vec<String> = record.iter().map(|field| field.trim().to_owned()).collect();
            let count = fields.len();
            fields.try_into().map_err(|_| error(format!("a row of {count} columns; expected {N}")))
        })
        .collect()
}

fn listed(printed: &Printed) -> Result<BTreeMap<Key, String>, LedgerError> {
    let reasons: BTreeMap<String, String> =
        rows("reasons.csv", printed.reasons)?.into_iter().map(|[reason, explanation]| (reason, explanation)).collect();
    rows("disagreements.csv", printed.disagreements)?
        .into_iter()
        .map(|[source, item, cell, reason]| match reasons.get(&reason) {
            Some(explanation) => Ok(((source, item, cell), explanation.clone())),
            None => Err(LedgerError::Unknown { file: "disagreements.csv", item, cell: format!("reason {reason}") }),
        })
        .collect()
}

fn find<'a>(robots: &'a [Robot], name: &str) -> Option<&'a Robot> {
    robots.iter().find(|robot| names(robot, name))
}

fn architecture(name: &str) -> Option<Architecture> {
    Architecture::ALL.into_iter().find(|architecture| architecture.name() == name)
}

struct Links {
    a1: f64,
    l2: f64,
    l3: f64,
}

fn links(robots: &[Robot], name: &str) -> Option<Links> {
    match &find(robots, name)?.arm {
        Arm::SixAxis { geometry, .. } => Some(Links { a1: geometry.a1, l2: geometry.c2, l3: geometry.l3() }),
        Arm::Planar(arm) => Some(Links { a1: 0.0, l2: arm.l2, l3: arm.l3 }),
    }
}

/// At 1 kN, as the paper's Table III; `None` where the task has no place.
fn deflection_mm(robot: &Robot, task: &str) -> Result<Option<f64>, LedgerError> {
    let task: Task = task.parse()?;
    let placed = place(
        &Model::planar(robot).map_err(PlaceError::from)?,
        &task.work,
        &PlaceOptions::under(Load::PAPER),
        Watch::nobody(),
    )?;
    Ok(placed.feasible().map(|placement| placement.deflection * 1e3))
}

/// The outer `None`: no such cell; the inner: nothing fits.
fn table_1(study: &Study, task: &str, mu: &str, d: &str, architecture: &str) -> Option<Option<f64>> {
    let (d, wanted): (f64, Option<f64>) = (d.parse().ok()?, mu.parse().ok());
    if wanted.is_none() && mu != "best" {
        return None;
    }
    let options = &study.options;
    let row = study.rows.iter().find(|row| {
        let ratio_matches = match (wanted, row.ratio) {
            (Some(mu), Some(ratio)) => !ratio.is_best && ratio.mu == mu,
            (None, ratio) => ratio.is_none_or(|ratio| ratio.is_best),
            (Some(_), None) => false,
        };
        options.tasks[row.task].label == task
            && row.size == d
            && options.contenders[row.contender].architecture.name() == architecture
            && ratio_matches
    });
    row.map(|row| row.accuracy)
}

/// A figure of the running text; `None` where nothing fits.
fn text_figure(robots: &[Robot], study: &Study, item: &str, cell: &str) -> Result<Option<f64>, LedgerError> {
    let unknown = || LedgerError::Unknown { file: "text.csv", item: item.into(), cell: cell.into() };
    let architecture = || architecture(cell).ok_or_else(unknown);
    let robot = || find(robots, cell).ok_or_else(unknown);
    let last_number = || cell.rsplit(' ').next().and_then(|word| word.parse::<f64>().ok()).ok_or_else(unknown);
    let example = |architecture| PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, architecture);
    let tasks = &study.options.tasks;
    Ok(match item {
        "section II, largest deflection in the workspace" => {
            let sigma = example(architecture()?).radial();
            Some(sigma.at(sigma.stretched).max(sigma.at(sigma.folded)) * 1e6)
        }
        "section II, smallest worst-direction deflection" => Some(example(architecture()?).radial().floor() * 1e6),
        "section II, zone of 0.5 x 2 m" => {
            let zone = Zone::Rectangle { width: 0.5, height: 2.0 };
            best_without_limits(&example(architecture()?), zone)?.map(|compliance| compliance * 1e6)
        }
        "section III, best link ratio of small tasks" | "section III, best link ratio of large tasks" => {
            let serial = Contender::equal(Architecture::Serial);
            serial.best_ratio(tasks[0].work.scaled(last_number()?), study.options.range)?.map(|(mu, _)| mu)
        }
        "section III, size above which quasi-serial is better" => {
            study.boundaries.iter().find(|b| b.task == 0 && b.mu.is_none()).map(|b| b.size)
        }
        "section III, largest size" => {
            let mu = last_number()?;
            let arm = PlanarArm::free(1.0 / (1.0 + mu), mu / (1.0 + mu), 1.0, 1.0, Architecture::QuasiSerial);
            Some(largest_scale_without_limits(&arm, tasks[1].work))
        }
        "section IV, stiffest point" => {
            let plane = robot()?.arm_plane().map_err(|error| PlaceError::from(ModelError::from(error)))?;
            Some(plane.arm.radial().floor() * 1e6)
        }
        "section IV, zone of 0.5 x 1 m" => deflection_mm(robot()?, "B:0.5")?,
        "section IV, smallest of task C 0.15" => {
            let architecture = architecture()?;
            let mut smallest: Option<f64> = None;
            for robot in robots.iter().filter(|robot| robot.architecture == architecture) {
                if let Some(found) = deflection_mm(robot, "C:0.15")? {
                    smallest = Some(smallest.map_or(found, |smallest| smallest.min(found)));
                }
            }
            smallest
        }
        _ => return Err(unknown()),
    })
}
