//! What does an answer hold? Every answer once: its fields, its verdict, its sentences. Every face prints from here.
//!
//! A [`Record`] holds fields with their values; [`Rows`] are typed columns for spreadsheets and data frames; a [`Table`] is
//! what people read. A number is the same to the last bit wherever it is shown, and every position counts from the robot's base:
//! x forward, y left, z up. Beside [`catalogue`](stiffarm::catalogue) and [`request`](crate::request) the only module in which mm and
//! degrees exist.

mod advice;
mod angles;
pub mod calibrate;
mod cell;
pub mod chatter;
pub mod compare;
pub mod compliance;
pub mod cutting;
mod force;
mod headline;
pub mod identify;
pub mod keys;
mod layout;
pub mod ledger;
pub mod map;
mod margins;
pub mod measure;
pub mod mill;
pub mod modes;
pub mod modes_over;
mod numbers;
pub mod path;
mod payload;
pub mod place;
pub mod rank;
mod record;
pub mod robot;
mod rows;
mod stiffness;
pub mod study;
mod styles;
mod tip;
mod uncertainty;
mod updated;
mod verdict;
pub mod verify;
pub mod words;

use serde_json::{Value, json};

pub use calibrate::CalibrateAnswer;
pub use chatter::ChatterAnswer;
pub use compare::CompareAnswer;
pub use compliance::ComplianceAnswer;
pub use cutting::CuttingAnswer;
pub use headline::{Headline, Outcome, Tone, tone_of};
pub use identify::IdentifyAnswer;
pub use keys::field::{Field, Kind, Unit};
pub use keys::shape::Shape;
pub use keys::{field, shape};
pub use layout::{Base, Dimension, Layout};
pub use ledger::LedgerAnswer;
pub use map::MapAnswer;
pub use measure::{DrawnPosture, GeometryAnswer, MeasureAnswer};
pub use mill::{Beside, Bodies, ByToolAnswer, Compensation, MeshFile, MillAnswer, MillAnswerError, PathRankAnswer};
pub use modes::ModesAnswer;
pub use modes_over::ModesOverAnswer;
pub use numbers::fixed;
pub use path::PathAnswer;
pub use place::PlaceAnswer;
pub use rank::RankAnswer;
pub use record::{Datum, Record, columns_of, looks_like_a_number};
pub use rows::{Cell, Column, ColumnKind, Rows};
pub use stiffness::{stiffness, stiffnesses};
pub use study::StudyAnswer;
pub use styles::{RobotStyle, styles};
pub use tip::TipFile;
pub use verdict::{HOLDS, ON_TOP, SURE, Verdict};
pub use verify::{VerifyAnswer, VerifyRankAnswer};

/// Keys in the order in which they are written.
type Object = serde_json::Map<String, Value>;

/// The version of what keys and columns mean. 1 (before 0.2.0): planar positions counted from the joint-2 axis, and keys were
/// left out where nothing was known. 2: every position counts from the robot's base, and every key is written.
pub const SCHEMA: usize = 2;

/// What every position in an answer counts from; of a robot of which only two links are known, from their joint-2 axis.
pub const ORIGIN: &str = "the base";

/// What a program must know to read an answer.
pub fn schema(verb: &str, origin: &str) -> Value {
    schema_of(verb, origin, "x forward, y left, z up")
}

fn schema_of(verb: &str, origin: &str, axes: &str) -> Value {
    json!({ "version": SCHEMA, "verb": verb, "origin": origin, "axes": axes, "units": "the ending of each key" })
}

/// An answer as JSON: its schema, then its fields.
pub fn with_schema(verb: &str, origin: &str, record: &Record) -> Value {
    under(schema(verb, origin), record)
}

/// A record behind its schema.
fn under(schema: Value, record: &Record) -> Value {
    let mut object = Object::new();
    object.insert("schema".into(), schema);
    if let Value::Object(fields) = record.json() {
        object.extend(fields);
    }
    Value::Object(object)
}

/// What people read: headings, and rows of words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// One per column; blank where the first column names what stands beside it.
    pub headings: Vec<String>,
    /// As many words each as there are headings.
    pub rows: Vec<Vec<String>>,
    /// The first so many columns say of what a row is.
    pub keys: usize,
    /// Headings of columns that may be left out where there is no room, the first first.
    pub spare: Vec<String>,
    /// All columns but the first are broken into lines that fit, side by side.
    pub is_broken: bool,
    /// What of it decides, where one line does.
    pub lead: Option<Lead>,
}

/// The line of a table that decides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lead {
    /// What it says.
    pub value: String,
    /// What that is.
    pub means: String,
    /// What it rests on.
    pub rests_on: String,
    /// The rows that say no more than a face which shows these, and the place by its keys.
    pub rows: Vec<usize>,
}

impl Table {
    /// A table without rows.
    pub fn new<S: Into<String>>(headings: impl IntoIterator<Item = S>) -> Self {
        let headings = headings.into_iter().map(Into::into).collect();
        Self { headings, rows: Vec::new(), keys: 1, spare: Vec::new(), is_broken: false, lead: None }
    }

    /// Names on the left, what they say on the right.
    pub fn of_lines(lines: impl IntoIterator<Item = Line>) -> Self {
        Self { rows: lines.into_iter().map(Into::into).collect(), ..Self::new(["", ""]) }
    }

    /// Rows as people read them, to the last digit.
    pub fn of_rows(rows: &Rows) -> Self {
        let words = |row: std::borrow::Cow<'_, [Cell]>| row.iter().map(Cell::to_string).collect();
        let headings = rows.columns().iter().map(|column| column.name.clone());
        Self { rows: rows.iter().map(words).collect(), ..Self::new(headings) }
    }

    /// The first so many columns are repeated where a table is stacked, and those of these headings left out before it is.
    #[must_use]
    pub fn with_room(self, keys: usize, spare: &[&str]) -> Self {
        Self { keys, spare: spare.iter().map(|&name| name.into()).collect(), ..self }
    }

    /// All columns but the first are broken into lines, as many as it takes for them to stand side by side.
    #[must_use]
    pub fn with_broken_lines(self) -> Self {
        Self { is_broken: true, ..self }
    }

    /// Of names on the left and what they say on the right: the line that decides, what its value means, the line on which that rests, and
    /// further ones that need not be repeated beside them. Without the first there is no lead.
    #[must_use]
    pub fn led_by(self, [decides, rests_on]: [&str; 2], means: impl Into<String>, repeated: &[&str]) -> Self {
        let says = |name: &str| self.rows.iter().find(|row| row[0] == name).map(|row| row[1].clone());
        let is_said = |row: &[String]| [decides, rests_on].iter().chain(repeated).any(|name| row[0] == *name);
        let lead = says(decides).map(|value| Lead {
            value,
            means: means.into(),
            rests_on: says(rests_on).unwrap_or_default(),
            rows: (0..self.rows.len()).filter(|&row| is_said(&self.rows[row])).collect(),
        });
        Self { lead, ..self }
    }

    /// Adds a row.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }
}

/// A name and what it says.
pub type Line = [String; 2];

/// A line of both.
pub fn line(name: impl Into<String>, says: impl Into<String>) -> Line {
    [name.into(), says.into()]
}
