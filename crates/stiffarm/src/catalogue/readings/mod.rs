//! Where does the arm stand at which joint angles, as a pendant shows it or a tracker measures it? Tables (CSV) to SI.
//!
//! | column | is |
//! |---|---|
//! | `joint_1_deg` .. `joint_6_deg`, or `q1_deg` .. | the joint angles as the robot reports them |
//! | `x_mm, y_mm, z_mm` | the controller's own position of its tool point |
//! | `x1_mm, y1_mm, z1_mm` .. `x4_mm, ..` | up to four points on the flange, as measured; empty where one was not seen |
//! | `a_deg, b_deg, c_deg`, or another [`Notation`] | optional: the orientation beside the position |
//!
//! Lines that begin with `#` are remarks. Every other column is passed over, which is reported.

mod columns;
mod orientation;

use std::collections::HashMap;

use nalgebra::{UnitQuaternion, Vector3};

use self::columns::{Columns, Row};
use super::reader::shown;
use super::{Fault, Faults};
pub use orientation::Notation;

/// A table of postures, each with what was seen of the flange.
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    /// In the order of the file; at least one.
    pub rows: Vec<Reading>,
    /// How many points of the flange are looked at, 1 to 4.
    pub points: usize,
    /// Points were measured by an instrument; else the controller computed them, to the last digit that it shows.
    pub is_measured: bool,
    /// How the orientation is written, where there is one.
    pub notation: Option<Notation>,
    /// The names of the stands of the instrument, in the order in which they come; one without a name where no column tells them apart.
    pub stands: Vec<String>,
    /// What is no fault but odd, each a sentence.
    pub remarks: Vec<String>,
}

/// One posture: a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its line in the file, from 1.
    pub line: usize,
    /// Joint angles as the robot reports them, rad.
    pub q: [f64; 6],
    /// Where each point was seen, m; at least one was.
    pub points: Vec<Option<Vector3<f64>>>,
    /// How the tool stood there.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// From which of [`Readings::stands`] it was seen.
    pub stand: usize,
}

/// How a table is read.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// What a column is called here, and what it is called in the table.
    pub columns: Vec<(String, String)>,
    /// The column that tells the stands of the instrument apart.
    pub frame_by: Option<String>,
    /// Who made the robot: makers write RX, RY, RZ in two ways.
    pub vendor: String,
}

/// Joint angles that all lie within one radian of each other, and far from what degrees would be, are radians.
const TURN_IN_RADIANS: f64 = 6.5;
/// No robot that is measured is so small that all positions lie within this, mm.
const SMALLEST_MM: f64 = 20.0;

/// Reads a table of readings; `file` is named in errors. Rows that repeat another in every number are left out, which is reported.
///
/// # Errors
/// All faults at once, each with its line, row and column.
pub fn read(text: &str, file: &str, options: &ReadOptions) -> Result<Readings, Faults> {
    let mut faults = Vec::new();
    if let Some((columns, rows)) = columns::table(text, options, &mut faults) {
        let found = Reader { columns: &columns, faults: &mut faults }.readings(&rows);
        if faults.is_empty() {
            check(&found, &mut faults);
        }
        if faults.is_empty() {
            return Ok(found);
        }
    }
    faults.sort_by_key(|fault: &Fault| fault.line);
    Err(Faults { file: file.into(), faults })
}

struct Reader<'a> {
    columns: &'a Columns,
    faults: &'a mut Vec<Fault>,
}

impl Reader<'_> {
    fn readings(&mut self, rows: &[Row]) -> Readings {
        let columns = self.columns;
        let (mut found, mut stands, mut remarks) = (Vec::<Reading>::new(), Vec::<String>::new(), columns.passed_over());
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        for (i, row) in rows.iter().enumerate() {
            let name = columns.stand.map_or_else(String::new, |column| row.cells[column].clone());
            let stand = stands.iter().position(|stand| *stand == name).unwrap_or_else(|| {
                stands.push(name);
                stands.len() - 1
            });
            let Some(reading) = self.reading(i + 1, row, stand) else { continue };
            if let Some(first) = known.insert(bits(&reading), row.line) {
                remarks.push(format!("line {} repeats line {first} in every number, and is left out", row.line));
            } else {
                found.push(reading);
            }
        }
        let points = columns.points.len();
        Readings {
            rows: found,
            points,
            is_measured: columns.is_measured,
            notation: columns.notation.as_ref().map(|(notation, _)| *notation),
            stands,
            remarks,
        }
    }

    fn reading(&mut self, number: usize, row: &Row, stand: usize) -> Option<Reading> {
        /// No joint turns further, deg.
        const MOST_DEG: f64 = 1080.0;
        /// No instrument sees further, mm.
        const MOST_MM: f64 = 1e5;
        let columns = self.columns;
        let before = self.faults.len();
        let q = columns.q.map(|column| self.number(number, row, (column, MOST_DEG)).to_radians());
        let mut points = Vec::new();
        for three in &columns.points {
            let is_empty = columns.is_measured && three.iter().all(|&column| row.cells[column].is_empty());
            points.push(
                (!is_empty)
                    .then(|| Vector3::from(three.map(|column| self.number(number, row, (column, MOST_MM)))) / 1e3),
            );
        }
        if points.iter().all(Option::is_none) {
            self.fault(
                number,
                row,
                columns.points[0][0],
                "no point was seen; expected x, y and z of at least one".into(),
            );
        }
        let orientation = columns.notation.as_ref().and_then(|(notation, at)| {
            let numbers: Vec<f64> = at.iter().map(|&column| self.number(number, row, (column, MOST_DEG))).collect();
            let rotation = notation.rotation(&numbers);
            if rotation.is_none() {
                self.fault(
                    number,
                    row,
                    at[0],
                    "the four numbers are no unit quaternion; expected one, its scalar part first".into(),
                );
            }
            rotation
        });
        (self.faults.len() == before).then_some(Reading { line: row.line, q, points, orientation, stand })
    }

    /// A number of at most this size; zero where it is a fault.
    fn number(&mut self, number: usize, row: &Row, (column, most): (usize, f64)) -> f64 {
        let text = &row.cells[column];
        let why = match text.parse::<f64>() {
            Ok(value) if value.abs() <= most => return value,
            Ok(value) if value.is_finite() => format!("{value}; expected a number from -{most} to {most}"),
            Ok(_) => format!("{} is no number that can be read", shown(text)),
            Err(_) if text.is_empty() => "the cell is empty; expected a number".into(),
            Err(_) if text.contains(',') => {
                format!("'{}' is not a number; decimals are written with a point", shown(text))
            }
            Err(_) => format!("'{}' is not a number", shown(text)),
        };
        self.fault(number, row, column, why);
        0.0
    }

    fn fault(&mut self, number: usize, row: &Row, column: usize, message: String) {
        let key = format!("row {number}, {}", shown(&self.columns.names[column]));
        self.faults.push(Fault { line: row.line, key, message });
    }
}

/// Every number of a row.
fn bits(reading: &Reading) -> Vec<u64> {
    let points = reading.points.iter().flatten().flat_map(|point| point.iter().copied().collect::<Vec<_>>());
    let seen = reading.points.iter().map(|point| if point.is_some() { 1.0 } else { 0.0 });
    reading.q.into_iter().chain(points).chain(seen).chain([reading.stand as f64]).map(f64::to_bits).collect()
}

/// What is wrong with the table as a whole.
fn check(found: &Readings, faults: &mut Vec<Fault>) {
    let Some(first) = found.rows.first() else {
        faults.push(Fault { line: 1, key: String::new(), message: "no row holds a posture".into() });
        return;
    };
    let mut whole = |message: String| faults.push(Fault { line: first.line, key: String::new(), message });
    let largest = |of: &dyn Fn(&Reading) -> f64| found.rows.iter().map(of).fold(0.0, f64::max);
    let angle = largest(&|row| row.q.iter().map(|q| q.to_degrees().abs()).fold(0.0, f64::max));
    if angle < TURN_IN_RADIANS {
        whole(format!("no joint angle exceeds {angle:.2} deg; if these are radians, convert them to degrees"));
    }
    let length = 1e3 * largest(&|row| row.points.iter().flatten().map(Vector3::amax).fold(0.0, f64::max));
    if length < SMALLEST_MM {
        whole(format!("no position exceeds {length:.2} mm; if these are metres, convert them to millimetres"));
    }
}
