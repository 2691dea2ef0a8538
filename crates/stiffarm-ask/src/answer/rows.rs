//! Tables for programs: columns whose type is known before any value is.

use std::borrow::Cow;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// Words.
    Text,
    /// Yes or no.
    Truth,
    /// Whole numbers.
    Count,
    /// Numbers.
    Number,
}

/// A heading and what stands below it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The heading; its ending is the unit.
    pub name: String,
    /// What it holds.
    pub kind: ColumnKind,
}

impl Column {
    /// A column.
    pub fn new(name: impl Into<String>, kind: ColumnKind) -> Self {
        Self { name: name.into(), kind }
    }
}

/// One value in the unit of its column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Not known, or does not apply.
    Absent,
    /// Words.
    Text(String),
    /// Yes or no.
    Truth(bool),
    /// A whole number.
    Count(i64),
    /// A number.
    Number(f64),
}

impl std::fmt::Display for Cell {
    /// Numbers to the last bit; nothing where nothing is known.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Absent => Ok(()),
            Self::Text(text) => f.write_str(text),
            Self::Truth(truth) => truth.fmt(f),
            Self::Count(count) => count.fmt(f),
            Self::Number(number) => number.fmt(f),
        }
    }
}

/// Rows under typed columns.
pub struct Rows<'a> {
    remark: Option<String>,
    columns: Vec<Column>,
    kept: Kept<'a>,
}

/// Rows that are kept, or so many that each is made when it is written: a map has a hundred million.
enum Kept<'a> {
    All(Vec<Vec<Cell>>),
    Made(usize, Box<dyn Fn(usize) -> Vec<Cell> + 'a>),
}

impl<'a> Rows<'a> {
    /// A table of rows that are there.
    pub fn new(columns: Vec<Column>, rows: Vec<Vec<Cell>>) -> Self {
        Self { remark: None, columns, kept: Kept::All(rows) }
    }

    /// A table of `count` rows, of which each is made anew when it is needed.
    pub fn made(columns: Vec<Column>, count: usize, row: impl Fn(usize) -> Vec<Cell> + 'a) -> Self {
        Self { remark: None, columns, kept: Kept::Made(count, Box::new(row)) }
    }

    /// The same under a remark that whoever uses the table must have read.
    #[must_use]
    pub fn under(self, remark: Option<String>) -> Self {
        Self { remark, ..self }
    }

    /// What stands above the headings, on one line.
    pub fn remark(&self) -> Option<&str> {
        self.remark.as_deref()
    }

    /// The headings.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// How many rows.
    pub fn len(&self) -> usize {
        match &self.kept {
            Kept::All(rows) => rows.len(),
            Kept::Made(count, _) => *count,
        }
    }

    /// There is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The row at `i`.
    pub fn at(&self, i: usize) -> Cow<'_, [Cell]> {
        match &self.kept {
            Kept::All(rows) => Cow::Borrowed(&rows[i]),
            Kept::Made(_, row) => Cow::Owned(row(i)),
        }
    }

    /// All rows.
    pub fn iter(&self) -> impl Iterator<Item = Cow<'_, [Cell]>> {
        (0..self.len()).map(|i| self.at(i))
    }
}
