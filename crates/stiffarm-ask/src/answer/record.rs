//! Fields with their values: what every printer of an answer reads.

use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

use super::field::{Field, Kind};
use super::rows::{Cell, Column, ColumnKind, Rows};
use super::shape::{Shape, Slot};

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
    /// A list of any length, by the kind of its field.
    List(Value),
    /// Fields of its own.
    Object(Record),
    /// Several such.
    Objects(Vec<Record>),
}

/// The fields of a [`Shape`] with their values: every key, null where nothing was put.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    shape: &'static Shape,
    values: Vec<Datum>,
    /// Where the next field is looked for first: fields are mostly put in their order.
    next: usize,
}

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
    Value, value => Self::List(value);
    Record, record => Self::Object(record);
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

impl FromIterator<Record> for Datum {
    fn from_iter<I: IntoIterator<Item = Record>>(records: I) -> Self {
        Self::Objects(records.into_iter().collect())
    }
}

impl Record {
    /// Nothing is known yet.
    pub fn of(shape: &'static Shape) -> Self {
        Self { shape, values: vec![Datum::Absent; shape.slots().count()], next: 0 }
    }

    /// Says what a field holds.
    ///
    /// # Panics
    /// Where the object has no such field, or the value is not of its kind: a fault of this library. Null where something always stands is
    /// one that tests find.
    pub fn put(&mut self, field: Field, value: impl Into<Datum>) -> &mut Self {
        let value = value.into();
        let at = self.position(field);
        let slot = self.shape.slots().nth(at).expect("it was found");
        assert!(fits(slot, &value), "{}: {field:?} is no {value:?}", self.shape.name);
        self.values[at] = value;
        self.next = at + 1;
        self
    }

    fn position(&self, field: Field) -> usize {
        let is_it = |slot: &Slot| slot.field.key == field.key;
        let behind = self.shape.slots().skip(self.next).position(is_it).map(|at| at + self.next);
        let found = behind.or_else(|| self.shape.slots().position(is_it));
        found.unwrap_or_else(|| panic!("{} has no {}", self.shape.name, field.key))
    }

    /// Adds all fields of another.
    pub fn extend(&mut self, other: Self) -> &mut Self {
        for (slot, value) in other.shape.slots().zip(other.values) {
            self.put(slot.field, value);
        }
        self
    }

    fn slots(&self) -> impl Iterator<Item = (&'static Field, &Datum)> {
        self.shape.slots().map(|slot| &slot.field).zip(&self.values)
    }

    /// As JSON: every key, null where nothing is known.
    pub fn json(&self) -> Value {
        Value::Object(self.slots().map(|(field, datum)| (field.key.to_owned(), value_of(field, datum))).collect())
    }

    /// The same record as a row of a table under the [headings](Shape::columns) of its shape.
    pub fn cells(&self) -> Vec<Cell> {
        self.slots().flat_map(|(field, datum)| cells_of(field, datum)).collect()
    }
}

impl Shape {
    /// The headings of a table of such objects.
    pub fn columns(&self) -> Vec<Column> {
        self.slots().flat_map(|slot| columns_of(&slot.field)).collect()
    }
}

impl Rows<'_> {
    /// A row a record.
    pub fn of(shape: &'static Shape, records: impl IntoIterator<Item = Record>) -> Self {
        Self::new(shape.columns(), records.into_iter().map(|record| record.cells()).collect())
    }
}

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(Some(self.values.len()))?;
        for (field, datum) in self.slots() {
            object.serialize_entry(field.key, &value_of(field, datum))?;
        }
        object.end()
    }
}

/// Is it what the field holds there?
fn fits(slot: &Slot, value: &Datum) -> bool {
    match (slot.field.kind, value) {
        (_, Datum::Absent) => slot.may_be_null || !cfg!(debug_assertions),
        (Kind::Text, Datum::Text(_))
        | (Kind::Truth, Datum::Truth(_))
        | (Kind::Count, Datum::Count(_))
        | (Kind::Number(_), Datum::Number(_)) => true,
        (Kind::Numbers { open, .. }, Datum::Numbers(numbers)) => open || numbers.iter().all(Option::is_some),
        // What is in a list is a matter of tests: a number that is none must not end the program.
        (kind @ Kind::List(_), Datum::List(items)) => {
            items.is_array() && (kind.accepts(items) || !cfg!(debug_assertions))
        }
        (Kind::Object, Datum::Object(record)) => slot.of == Some(record.shape),
        (Kind::Objects, Datum::Objects(records)) => records.iter().all(|record| slot.of == Some(record.shape)),
        _ => false,
    }
}

fn value_of(field: &Field, datum: &Datum) -> Value {
    match (field.kind, datum) {
        (Kind::Number(unit), Datum::Number(number)) => json!(unit.of_si(*number)),
        (Kind::Numbers { unit, nested, .. }, Datum::Numbers(numbers)) => {
            let in_unit: Vec<Option<f64>> = numbers.iter().map(|number| number.map(|si| unit.of_si(si))).collect();
            if nested == 0 { json!(in_unit) } else { in_unit.chunks(nested).map(|part| json!(part)).collect() }
        }
        (_, Datum::Text(text)) => json!(text),
        (_, Datum::Truth(truth)) => json!(truth),
        (_, Datum::Count(count)) => json!(count),
        (kind, Datum::List(items)) => in_unit(kind, items),
        (_, Datum::Object(record)) => record.json(),
        (_, Datum::Objects(records)) => records.iter().map(Record::json).collect(),
        (_, Datum::Absent | Datum::Number(_) | Datum::Numbers(_)) => Value::Null,
    }
}

/// A list in the unit of its numbers.
fn in_unit(kind: Kind, value: &Value) -> Value {
    match (kind, value) {
        (Kind::List(of), Value::Array(items)) => items.iter().map(|item| in_unit(*of, item)).collect(),
        (Kind::Maybe(of), value) if !value.is_null() => in_unit(*of, value),
        (Kind::Number(unit), Value::Number(number)) => number.as_f64().map_or(Value::Null, |si| json!(unit.of_si(si))),
        (_, value) => value.clone(),
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
        Kind::List(_) | Kind::Maybe(_) | Kind::ByName(_) | Kind::Object | Kind::Objects => Vec::new(),
    }
}

fn cells_of(field: &Field, datum: &Datum) -> Vec<Cell> {
    match (field.kind, datum) {
        (Kind::List(_) | Kind::Maybe(_) | Kind::ByName(_) | Kind::Object | Kind::Objects, _) => Vec::new(),
        (Kind::Numbers { columns, unit, .. }, Datum::Numbers(numbers)) => {
            let cell = |number: &Option<f64>| number.map_or(Cell::Absent, |si| Cell::Number(unit.of_si(si)));
            numbers.iter().map(cell).take(columns.len()).collect()
        }
        (Kind::Numbers { columns, .. }, _) => vec![Cell::Absent; columns.len()],
        (Kind::Number(unit), Datum::Number(number)) => vec![Cell::Number(unit.of_si(*number))],
        (_, Datum::Text(text)) => vec![Cell::Text(text.clone())],
        (_, Datum::Truth(truth)) => vec![Cell::Truth(*truth)],
        (_, Datum::Count(count)) => vec![Cell::Count(*count as i64)],
        (_, _) => vec![Cell::Absent],
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
    use super::super::{field, shape};
    use super::*;

    #[test]
    fn every_key_is_there_and_every_column_filled_whatever_is_known() {
        let mut record = Record::of(&shape::RESOLUTION);
        record.put(field::COARSE_STEP, 0.02).put(field::COARSE, 0.0025).put(field::FINE_TURN, std::f64::consts::PI);
        record.put(field::COARSE, None::<f64>).put(field::SAMPLES, 3);
        let json = json!({
            "coarse_step_m": 0.02, "coarse_mm": null, "fine_step_m": null, "fine_turn_deg": 180.0, "sample_step_m": null, "samples": 3,
            "halving": null, "boxes": null,
        });
        assert_eq!(record.json(), json);
        assert_eq!(serde_json::to_value(&record).unwrap(), json);
        assert_eq!(shape::RESOLUTION.columns().len(), record.cells().len());
        assert_eq!(record.cells()[2..6], [Cell::Absent, Cell::Number(180.0), Cell::Absent, Cell::Count(3)]);
    }

    #[test]
    fn lists_are_in_the_unit_of_their_field() {
        let mut record = Record::of(&shape::CALIBRATION);
        record.put(field::POINTS_SEEN, json!([[0.1, 0.0, -0.25]])).put(field::NARROW, Datum::Objects(Vec::new()));
        assert_eq!(record.json()["points_mm"], json!([[100.0, 0.0, -250.0]]));
        assert_eq!(record.json()["narrow"], json!([]));
        let mut chances = Record::of(&shape::RANKING_ROW);
        chances.put(field::EXPECTED_REGRET, json!([null, 0.001]));
        assert_eq!(chances.json()["expected_regret_mm"], json!([null, 1.0]));
    }

    #[test]
    #[should_panic(expected = "robot")]
    fn a_value_of_another_kind_is_refused() {
        Record::of(&shape::PLACEMENT).put(field::ROBOT, 1.0);
    }

    #[test]
    #[should_panic(expected = "Resolution has no robot")]
    fn a_field_of_another_object_is_refused() {
        Record::of(&shape::RESOLUTION).put(field::ROBOT, "KR");
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "samples")]
    fn null_is_refused_where_something_always_stands() {
        Record::of(&shape::RESOLUTION).put(field::SAMPLES, None::<usize>);
    }
}
