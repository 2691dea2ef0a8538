//! What does each row of a table of measurements say? Numbers in their ranges, in SI.

use nalgebra::{Vector3, Vector6};

use super::super::Fault;
use super::super::reader::shown;
use super::columns::{Angles, Columns, Row, Table, Three};
use super::{Marker, Measurements, Points, Reading};
use crate::spatial::Wrench;

/// What is read, and which units the table has.
pub(super) struct Found {
    pub measurements: Measurements,
    pub units: Units,
}

/// In which units the table is, and where its rows stand: for what is said of them.
pub(super) struct Units {
    pub angles: Angles,
    /// Of the displacements.
    pub length: &'static str,
    /// The lines of the rows.
    pub lines: Vec<usize>,
}

/// Reads every row; what is wrong goes to `faults`, and such rows are left out.
pub(super) fn read(table: &Table, points: &Points, faults: &mut Vec<Fault>) -> Found {
    let reader = Reader { table, points };
    let mut postures = Postures::default();
    let mut readings = Vec::new();
    for (i, row) in table.rows.iter().enumerate() {
        match reader.reading(i, row) {
            Ok(mut reading) => {
                let name = table.columns.posture.map(|column| row.cells[column].clone());
                reading.posture = postures.number(name, &reading.q);
                readings.push(reading);
            }
            Err(more) => faults.extend(more),
        }
    }
    let mut remarks: Vec<String> =
        table.unknown.iter().map(|name| format!("the column {name} is not known, and passed over")).collect();
    if points.load.is_none() && table.columns.load_at.is_none() {
        remarks.push("no load point is given: the flange centre is taken (--load-mm, or columns load_x_mm, ..)".into());
    }
    let units = Units {
        angles: table.columns.angles,
        length: table.columns.length.0,
        lines: table.rows.iter().map(|row| row.line).collect(),
    };
    Found { measurements: Measurements { readings, remarks }, units }
}

/// Numbers postures in the order in which they come.
#[derive(Default)]
struct Postures {
    known: std::collections::HashMap<(Option<String>, [u64; 6]), usize>,
}

impl Postures {
    fn number(&mut self, name: Option<String>, q: &[f64; 6]) -> usize {
        let key = if name.as_ref().is_some_and(|name| !name.is_empty()) {
            (name, [0; 6])
        } else {
            (None, q.map(|angle| (angle + 0.0).to_bits()))
        };
        let next = self.known.len();
        *self.known.entry(key).or_insert(next)
    }
}

struct Reader<'a> {
    table: &'a Table,
    points: &'a Points,
}

/// Of one row: a value, or what is wrong.
struct Cells<'a> {
    reader: &'a Reader<'a>,
    row: &'a Row,
    number: usize,
    faults: Vec<Fault>,
}

impl Reader<'_> {
    fn reading(&self, i: usize, row: &Row) -> Result<Reading, Vec<Fault>> {
        let columns: &Columns = &self.table.columns;
        let mut cells = Cells { reader: self, row, number: i + 1, faults: Vec::new() };
        let q = columns.q.map(|column| cells.angle(column));
        let force = columns.force.map(|column| cells.number(column, 1e6));
        let moment = columns.moment.map_or([0.0; 3], |three| three.map(|column| cells.number(column, 1e6)));
        let (_, metres) = columns.length;
        let moved =
            columns.moved.map_or([0.0; 3], |three| three.map(|column| cells.number(column, 1.0 / metres) * metres));
        let load_at = match (columns.load_at, self.points.load) {
            (Some(three), _) => cells.point(three),
            (None, given) => given.unwrap_or_default().into(),
        };
        let marker_at = match columns.marker_at {
            Some(three) => cells.point(three),
            None => cells.marker(load_at),
        };
        let sigma = columns.sigma.map(|column| cells.number(column, 1e3) / 1e3);
        if let (Some(column), Some(sigma)) = (columns.sigma, sigma)
            && !(0.0 < sigma)
        {
            cells.fault(column, "is not positive; expected the standard deviation of the noise in mm");
        }
        if force == [0.0; 3] && moment == [0.0; 3] {
            cells.fault(
                columns.force[0],
                "no load: fx_n, fy_n and fz_n are all 0; a row needs a load that bends the arm",
            );
        }
        let wrench = Vector6::new(force[0], force[1], force[2], moment[0], moment[1], moment[2]);
        let reading =
            Reading { row: i + 1, posture: 0, q, load: Wrench(wrench), load_at, marker_at, moved: moved.into(), sigma };
        if cells.faults.is_empty() { Ok(reading) } else { Err(cells.faults) }
    }
}

impl Cells<'_> {
    fn fault(&mut self, column: usize, message: impl Into<String>) {
        let key = format!("row {}, {}", self.number, shown(&self.reader.table.names[column]));
        self.faults.push(Fault { line: self.row.line, key, message: message.into() });
    }

    /// An angle of a joint, rad; zero where it is a fault.
    fn angle(&mut self, column: usize) -> f64 {
        /// No joint turns further, deg.
        const MOST: f64 = 1080.0;
        match self.reader.table.columns.angles {
            Angles::Degrees => self.number(column, MOST).to_radians(),
            Angles::Radians => match self.row.cells[column].parse::<f64>() {
                Ok(angle) if angle.is_finite() && MOST.to_radians() < angle.abs() => {
                    let turns = angle / std::f64::consts::TAU;
                    let ask = "are these degrees? then name the columns q1_deg to q6_deg";
                    self.fault(column, format!("{angle} rad is {turns:.1} turns: {ask}"));
                    0.0
                }
                _ => self.number(column, MOST),
            },
        }
    }

    /// A number that is at most so large; zero where it is a fault.
    fn number(&mut self, column: usize, most: f64) -> f64 {
        let text = &self.row.cells[column];
        if text.is_empty() {
            self.fault(column, "the cell is empty; expected a number");
            return 0.0;
        }
        match text.parse::<f64>() {
            Ok(number) if number.abs() <= most => number,
            Ok(number) if number.is_finite() => {
                self.fault(column, format!("{number}; expected a number from -{most} to {most}"));
                0.0
            }
            Ok(_) => {
                self.fault(column, format!("{} is no number that can be measured", shown(text)));
                0.0
            }
            Err(_) => {
                let comma = if text.contains(',') { "; decimals are written with a point" } else { "" };
                self.fault(column, format!("'{}' is not a number{comma}", shown(text)));
                0.0
            }
        }
    }

    /// A point of the flange frame, m, from mm.
    fn point(&mut self, three: Three) -> Vector3<f64> {
        Vector3::from(three.map(|column| self.number(column, 1e4))) / 1e3
    }

    /// Some other row has another name in a column.
    fn are_several(&self, column: usize) -> bool {
        self.reader.table.rows.iter().any(|row| row.cells[column] != self.row.cells[column])
    }

    /// Where the marker of this row sits.
    fn marker(&mut self, load_at: Vector3<f64>) -> Vector3<f64> {
        let markers = &self.reader.points.markers;
        let column = self.reader.table.columns.marker;
        let name = column.map(|column| self.row.cells[column].clone()).filter(|name| !name.is_empty());
        match (name, column, markers.as_slice()) {
            (_, _, []) => {
                if let Some(column) = column.filter(|column| self.are_several(*column)) {
                    self.fault(column, "several markers are named, and where they sit is not; expected --marker-mm name=x,y,z for each, or columns marker_x_mm, ..");
                }
                load_at
            }
            (None, _, [Marker { at, .. }]) => (*at).into(),
            (Some(name), Some(column), markers) => {
                if let Some(marker) = markers.iter().find(|marker| marker.name.as_ref() == Some(&name)) {
                    return marker.at.into();
                }
                if let [Marker { name: None, at }] = markers {
                    if self.are_several(column) {
                        self.fault(column, "several markers are named, and --marker-mm gives one place without a name; expected --marker-mm name=x,y,z for each");
                    }
                    return (*at).into();
                }
                let known: Vec<&str> = markers.iter().filter_map(|marker| marker.name.as_deref()).collect();
                let known = known.join(", ");
                self.fault(column, format!("no marker is called '{}'; expected {known}", shown(&name)));
                load_at
            }
            _ => {
                let at = column.unwrap_or(self.reader.table.columns.force[0]);
                self.fault(at, "several markers are given; expected a column marker that says which was looked at");
                load_at
            }
        }
    }
}
