//! Fields with their values: what every printer of an answer reads.

use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

use super::field::{Field, Kind};
use super::rows::{Cell, Column, ColumnKind, Rows};

/// A value, in SI where its field has a unit.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// Not known, or does not apply.
    Absent,
    /// Words.
    Text(String),
    /// Yes or no.
    Truth(bool),
    /// How many, or which one.
    Count(usize),
    /// A number.
    Number(f64),
    /// Several; absent where one is open.
    Numbers(Vec<Option<f64>>),
    /// Fields of its own, or a list.
    Nested(Value),
}

/// Fields in the order in which they are told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record(Vec<(Field, Datum)>);

macro_rules! datum_from {
    ($($kind:ty, $value:ident => $datum:expr;)*) => {
        $(impl From<$kind> for Datum {
            fn from($value: $kind) -> Self {
                $datum
            }
        })*
    };
}

datum_from! {
    bool, truth => Self::Truth(truth);
    usize, count => Self::Count(count);
    f64, number => Self::Number(number);
    String, text => Self::Text(text);
    &String, text => Self::Text(text.clone());
    &str, text => Self::Text(text.to_owned());
    Value, value => Self::Nested(value);
    Record, record => Self::Nested(record.json());
    &[f64], numbers => Self::Numbers(numbers.iter().copied().map(Some).collect());
}

impl<const N: usize> From<[f64; N]> for Datum {
    fn from(numbers: [f64; N]) -> Self {
        numbers.as_slice().into()
    }
}

impl<T: Into<Self>> From<Option<T>> for Datum {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Absent, Into::into)
    }
}

impl Record {
    /// Nothing yet.
    pub const fn new() -> Self {
        Self(Vec::new())
    }

    /// Adds a field at the end.
    ///
    /// # Panics
    /// Where the value is not of the field's kind: a fault of this library.
    pub fn put(&mut self, field: Field, value: impl Into<Datum>) -> &mut Self {
        let value = value.into();
        let fits = matches!(
            (field.kind, &value),
            (_, Datum::Absent)
                | (Kind::Text, Datum::Text(_))
                | (Kind::Truth, Datum::Truth(_))
                | (Kind::Count, Datum::Count(_))
                | (Kind::Number(_), Datum::Number(_))
                | (Kind::Numbers { .. }, Datum::Numbers(_))
                | (Kind::Nested, Datum::Nested(_))
        );
        assert!(fits, "{field:?} is no {value:?}");
        self.0.push((field, value));
        self
    }

    /// Adds all fields of another.
    pub fn extend(&mut self, other: Self) -> &mut Self {
        self.0.extend(other.0);
        self
    }

    /// As JSON: every key, null where nothing is known.
    pub fn json(&self) -> Value {
        Value::Object(self.0.iter().map(|(field, datum)| (field.key.to_owned(), value_of(field, datum))).collect())
    }

    /// The headings of a table of such records.
    pub fn columns(&self) -> Vec<Column> {
        self.0.iter().flat_map(|(field, _)| columns_of(field)).collect()
    }

    /// The same record as a row of that table.
    pub fn cells(&self) -> Vec<Cell> {
        self.0.iter().flat_map(|(field, datum)| cells_of(field, datum)).collect()
    }
}

impl Rows<'_> {
    /// A row a record, under the headings of the first: those of one table have the same fields.
    pub fn of(records: &[Record]) -> Self {
        let columns = records.first().map(Record::columns).unwrap_or_default();
        Self::new(columns, records.iter().map(Record::cells).collect())
    }
}

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(Some(self.0.len()))?;
        for (field, datum) in &self.0 {
            object.serialize_entry(field.key, &value_of(field, datum))?;
        }
        object.end()
    }
}

fn value_of(field: &Field, datum: &Datum) -> Value {
    match (field.kind, datum) {
        (Kind::Number(unit), Datum::Number(number)) => json!(unit.of_si(*number)),
        (Kind::Numbers { unit, nested, .. }, Datum::Numbers(numbers)) => {
            let told: Vec<Option<f64>> = numbers.iter().map(|number| number.map(|si| unit.of_si(si))).collect();
            if nested == 0 { json!(told) } else { told.chunks(nested).map(|part| json!(part)).collect() }
        }
        (_, Datum::Text(text)) => json!(text),
        (_, Datum::Truth(truth)) => json!(truth),
        (_, Datum::Count(count)) => json!(count),
        (_, Datum::Nested(value)) => value.clone(),
        (_, Datum::Absent | Datum::Number(_) | Datum::Numbers(_)) => Value::Null,
    }
}

/// The headings under which a field stands in a table; none where it stands in no table.
pub fn columns_of(field: &Field) -> Vec<Column> {
    let one = |kind: ColumnKind| vec![Column::new(field.key, kind)];
    match field.kind {
        Kind::Text => one(ColumnKind::Text),
        Kind::Truth => one(ColumnKind::Truth),
        Kind::Count => one(ColumnKind::Count),
        Kind::Number(_) => one(ColumnKind::Number),
        Kind::Numbers { columns, .. } => {
            columns.iter().map(|heading| Column::new(*heading, ColumnKind::Number)).collect()
        }
        Kind::Nested => Vec::new(),
    }
}

fn cells_of(field: &Field, datum: &Datum) -> Vec<Cell> {
    match (field.kind, datum) {
        (Kind::Nested, _) => Vec::new(),
        (Kind::Numbers { columns, unit, .. }, Datum::Numbers(numbers)) => {
            let cell = |number: &Option<f64>| number.map_or(Cell::Absent, |si| Cell::Number(unit.of_si(si)));
            numbers.iter().map(cell).take(columns.len()).collect()
        }
        (Kind::Numbers { columns, .. }, _) => vec![Cell::Absent; columns.len()],
        (Kind::Number(unit), Datum::Number(number)) => vec![Cell::Number(unit.of_si(*number))],
        (_, Datum::Text(text)) => vec![Cell::Text(text.clone())],
        (_, Datum::Truth(truth)) => vec![Cell::Truth(*truth)],
        (_, Datum::Count(count)) => vec![Cell::Count(*count as i64)],
        (_, Datum::Absent | Datum::Number(_) | Datum::Numbers(_) | Datum::Nested(_)) => vec![Cell::Absent],
    }
}

/// A number with what a table may add to it (marks, verdicts), or a blank.
pub fn looks_like_a_number(cell: &str) -> bool {
    cell.trim().is_empty()
        || matches!(cell, "-" | "~" | "?")
        || cell.starts_with(|c: char| c.is_ascii_digit() || c == '-')
}

#[cfg(test)]
mod tests {
    use super::super::field;
    use super::*;

    #[test]
    fn every_key_is_told_and_every_column_filled_whatever_is_known() {
        let mut record = Record::new();
        record.put(field::ROBOT, "KR").put(field::DEFLECTION, 0.0025).put(field::X, None::<f64>);
        record.put(field::WITHIN, Datum::Numbers(vec![Some(0.0), None, Some(1.0), Some(2.0)]));
        record.put(field::WORST_POINT, None::<[f64; 3]>).put(field::LIMIT_MARGIN_JOINT, 3);
        let json = json!({
            "robot": "KR", "deflection_mm": 2.5, "x_m": null, "within_m": [[0.0, null], [1.0, 2.0]], "worst_point_m": null,
            "limit_margin_joint": 3,
        });
        assert_eq!(record.json(), json);
        assert_eq!(serde_json::to_value(&record).unwrap(), json);
        assert_eq!(record.columns().len(), record.cells().len());
        assert_eq!(record.cells()[3..7], [Cell::Number(0.0), Cell::Absent, Cell::Number(1.0), Cell::Number(2.0)]);
        assert_eq!(record.cells()[7..], [Cell::Absent, Cell::Absent, Cell::Absent, Cell::Count(3)]);
    }

    #[test]
    #[should_panic(expected = "robot")]
    fn a_value_of_another_kind_is_refused() {
        Record::new().put(field::ROBOT, 1.0);
    }
}
