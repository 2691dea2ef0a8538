//! The verbs: a question and the robots and texts that it names go in, its answer comes out, in every form that is asked for.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde_json::{Value, json};
use stiffarm::ledger::{self, Printed};
use stiffarm::rank::{Contestant, Standing};
use stiffarm::task::Task;
use stiffarm::toolpath::MOST_SAMPLES;
use stiffarm::watch::Watch;
use stiffarm_ask::answer::{Cell, ColumnKind, LedgerAnswer, Rows};
use stiffarm_ask::ask::{self, Context};
use stiffarm_ask::forms::{Forms, Sketch};
use stiffarm_ask::paper::{self as folder, Item};
use stiffarm_ask::request::{Request, distinct as apart};
use stiffarm_ask::sources::Sources;

use crate::asked::{read, task, verb};
use crate::hearing::{Heard, said};
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::robot::Robot;
use crate::waiting::Progress;

/// A robot's place among those given, its rank and whether that is tied, and its mean ratio.
type Stood = (usize, Option<usize>, Option<bool>, Option<f64>);

/// What is asked: the verb, its options by their keywords, and the robots and texts that they name.
#[derive(FromPyObject)]
pub(crate) struct Question {
    #[pyo3(attribute)]
    verb: String,
    #[pyo3(attribute)]
    given: Vec<(String, String)>,
    #[pyo3(attribute)]
    robots: Vec<(String, Robot)>,
    #[pyo3(attribute)]
    texts: BTreeMap<String, String>,
}

/// What is wanted of an answer besides its keys and columns.
#[derive(FromPyObject)]
pub(crate) struct Wanted {
    /// Names whose endings say in which further forms it is wanted.
    #[pyo3(attribute)]
    forms: Vec<PathBuf>,
    /// Files that will be written: none of them is read.
    #[pyo3(attribute)]
    written: Vec<PathBuf>,
    /// What would keep a tolerance.
    #[pyo3(attribute)]
    advice: bool,
    /// What a figure shows, with so many points along the longer side of its map.
    #[pyo3(attribute)]
    points: Option<usize>,
}

/// An answer as it leaves the threads on which it was computed.
struct Reply {
    value: Value,
    columns: Vec<(String, Column)>,
    robot_file: Option<String>,
    files: Vec<Vec<u8>>,
    sketch: Option<Sketch>,
}

/// A column: numbers in which NaN stands for what is absent, or everything else, in which null does.
enum Column {
    Numbers(Vec<f64>),
    Values(Value),
}

/// The answer to a question: its `answer`, its `columns`, its `robot_file`, the `files` that were wanted, and for a figure what is `shown` and its
/// `layers`.
#[pyfunction]
#[pyo3(signature = (question, wanted, progress=None))]
pub(crate) fn answered(
    py: Python<'_>,
    question: Question,
    wanted: Wanted,
    progress: Progress,
) -> PyResult<Bound<'_, PyDict>> {
    let asked = read(verb(&question.verb)?, question.given)?;
    let forms = ask::forms(&asked);
    wanted.forms.iter().try_for_each(|name| check(&asked, forms, name))?;
    let mut sources = Sources::disk(wanted.written.clone());
    for (name, robot) in question.robots {
        sources = sources.with_robot(&name, robot.0);
    }
    for (name, text) in question.texts {
        sources = sources.with_text(&name, text);
    }
    let (replied, remarks) = detached(py, &progress, |watch| {
        let heard = Heard::by(watch);
        let replied = reply(&asked, &sources, &heard, &wanted);
        (replied, heard.remarks())
    })?;
    said(py, &remarks)?;
    replied.map_err(crate::hearing::refused)?.into_python(py)
}

/// Is there a form of this name, and is it made here?
fn check(asked: &Request, forms: Forms, name: &Path) -> PyResult<()> {
    match forms.form(name) {
        Some(form) if form.is_of_answer() => ask::check_form(asked, form).map_err(crate::hearing::refused),
        Some(_) => Err(refused(format!(
            "{} is not made here: stiffarm.plot draws with matplotlib, to_pandas() has the rows, and the program `stiffarm` writes both",
            name.display()
        ))),
        None => Err(refused(format!(
            "{} cannot write {}; expected a name that ends in {}",
            forms.command,
            name.display(),
            forms.endings().join(", ")
        ))),
    }
}

fn reply(asked: &Request, sources: &Sources, heard: &Heard, wanted: &Wanted) -> Result<Reply, ask::AskError> {
    let context = Context { sources, listener: heard, most_samples: MOST_SAMPLES, advises: wanted.advice };
    let found = ask::ask(asked, context)?;
    let forms = found.forms();
    let text = |name: &PathBuf| {
        let form = forms.form(name).expect("checked before");
        Ok(form.text(&*found)?.expect("checked before"))
    };
    Ok(Reply {
        value: found.value(),
        columns: columns(&found.rows()),
        robot_file: match found.robot_file() {
            // Nothing fits, or shows a drive: the answer says so itself.
            Some(Err(ask::AskError::NotVerified(_) | ask::AskError::NotIdentified(_))) | None => None,
            Some(text) => Some(text?),
        },
        files: wanted.forms.iter().map(text).collect::<Result<_, ask::AskError>>()?,
        sketch: wanted.points.and_then(|points| found.sketch(points)).transpose()?,
    })
}

impl Reply {
    fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let reply = PyDict::new(py);
        reply.set_item("answer", to_python(py, &self.value)?)?;
        reply.set_item("columns", handed_over(py, self.columns)?)?;
        reply.set_item("robot_file", self.robot_file)?;
        reply.set_item("files", self.files.iter().map(|bytes| PyBytes::new(py, bytes)).collect::<Vec<_>>())?;
        if let Some(Sketch { shown, shape, layers }) = self.sketch {
            let arrays = PyDict::new(py);
            for (key, cells) in layers {
                arrays.set_item(key, PyArray1::from_vec(py, cells).reshape(shape)?)?;
            }
            reply.set_item("shown", to_python(py, &shown)?)?;
            reply.set_item("layers", arrays)?;
        }
        Ok(reply)
    }
}

fn columns(rows: &Rows) -> Vec<(String, Column)> {
    let column = |(i, column): (usize, &stiffarm_ask::answer::Column)| {
        let cells = rows.iter().map(|row| row[i].clone());
        let found = match column.kind {
            ColumnKind::Number => Column::Numbers(
                cells.map(|cell| if let Cell::Number(number) = cell { number } else { f64::NAN }).collect(),
            ),
            ColumnKind::Text | ColumnKind::Truth | ColumnKind::Count => {
                Column::Values(cells.map(|cell| json_of(&cell)).collect())
            }
        };
        (column.name.clone(), found)
    };
    rows.columns().iter().enumerate().map(column).collect()
}

fn json_of(cell: &Cell) -> Value {
    match cell {
        Cell::Absent => Value::Null,
        Cell::Text(text) => json!(text),
        Cell::Truth(truth) => json!(truth),
        Cell::Count(count) => json!(count),
        Cell::Number(number) => json!(number),
    }
}

fn handed_over(py: Python<'_>, columns: Vec<(String, Column)>) -> PyResult<Bound<'_, PyDict>> {
    let handed = PyDict::new(py);
    for (name, column) in columns {
        match column {
            Column::Numbers(numbers) => handed.set_item(name, PyArray1::from_vec(py, numbers))?,
            Column::Values(values) => handed.set_item(name, to_python(py, &values)?)?,
        }
    }
    Ok(handed)
}

/// The published numbers beside the computed ones: the answer and its columns.
#[pyfunction]
#[pyo3(signature = (progress = None))]
pub(crate) fn validate(py: Python<'_>, progress: Progress) -> PyResult<(Bound<'_, PyAny>, Bound<'_, PyDict>)> {
    let found = detached(py, &progress, |_: Watch| ledger::validate(&Printed::PAPER))?;
    let answer = LedgerAnswer(found.map_err(refused)?);
    Ok((to_python(py, &answer.json())?, handed_over(py, columns(&answer.rows()))?))
}

/// A file and its text.
type Text = (String, String);

/// The file of a figure, the verb that makes it, and its keywords.
type Figure = (String, String, Vec<(String, String)>);

/// What makes the paper's figures: robot files that they name, every other text, and each figure's file, verb and keywords.
#[pyfunction]
pub(crate) fn paper() -> PyResult<(Vec<Text>, Vec<Text>, Vec<Figure>)> {
    let (tables, items) = (folder::tables(&ledger::validate(&Printed::PAPER).map_err(refused)?), folder::items("svg"));
    let index = ("index.md".to_owned(), folder::index(&tables, &items));
    let texts = tables.into_iter().flat_map(|table| table.texts).chain([index]).collect();
    let figure = |item: &Item| {
        let (verb, given) = item.keywords();
        (item.file.clone(), verb.name().to_owned(), given)
    };
    Ok((folder::arms().into(), texts, items.iter().map(figure).collect()))
}

/// The tasks of which no other before them has the zone.
#[pyfunction]
pub(crate) fn distinct(tasks: Vec<String>) -> PyResult<Vec<String>> {
    let tasks: Vec<Task> = tasks.iter().map(|text| task(text)).collect::<PyResult<_>>()?;
    Ok(apart(&tasks).into_iter().map(|task| task.label).collect())
}

/// The order of robots by their lower bounds and values: their places among those given, with rank and mean ratio.
#[pyfunction]
pub(crate) fn order(
    robots: Vec<(String, String, bool)>,
    proved_mm: Vec<Vec<Option<[f64; 2]>>>,
) -> PyResult<Vec<Stood>> {
    if robots.len() != proved_mm.len() {
        return Err(refused(format!("{} robots, but values of {}", robots.len(), proved_mm.len())));
    }
    let contestants: Vec<Contestant> = robots
        .iter()
        .zip(proved_mm)
        .map(|((vendor, name, is_estimated), values)| Contestant {
            vendor,
            name,
            is_estimated: *is_estimated,
            proved: values.into_iter().map(|mm| mm.map(|ends| ends.map(|mm| mm / 1e3))).collect(),
        })
        .collect();
    let standings = stiffarm::rank::order(&contestants).into_iter();
    let standing = |Standing { at, rank, mean_ratio, .. }: Standing| {
        (at, rank.map(|rank| rank.place), rank.map(|rank| rank.is_tied), mean_ratio)
    };
    Ok(standings.map(standing).collect())
}
