//! Which displacements were measured under which loads? Tables of measurements (CSV), in the units that their columns name, to SI.
//!
//! | column | is |
//! |---|---|
//! | `q1_deg` .. `q6_deg`, or `q1_rad` .. | the joint angles as the robot reports them |
//! | `fx_n`, `fy_n`, `fz_n`, optionally `mx_nm`, `my_nm`, `mz_nm` | the load on the load point |
//! | `dx_mm`, `dy_mm`, `dz_mm`, or `_um`, or `_m` | the displacement of the marker |
//! | `posture` | optional: rows of one name are of one posture; without it those of the same angles |
//! | `marker` | optional: which marker was looked at |
//! | `load_x_mm`, .., `marker_x_mm`, .. | optional: where in the flange frame the load acts and the marker sits |
//! | `sigma_mm` | optional: standard deviation of the noise of a coordinate |
//!
//! Lines that begin with `#` are remarks. Columns of `stiffarm measure` that are not measured are passed over, others are reported.

mod checks;
mod columns;
mod rows;

use nalgebra::Vector3;

use super::{Fault, Faults};
use crate::spatial::Wrench;

/// Displacements that were measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// In the order of the file; at least one.
    pub readings: Vec<Reading>,
    /// What is no fault but odd, each a sentence.
    pub remarks: Vec<String>,
}

/// One displacement of one marker under one load: a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its number among the rows of the table, from 1, headings and remarks left out.
    pub row: usize,
    /// Which posture: rows with the same number were measured in one; from 0 in the order in which they come.
    pub posture: usize,
    /// Joint angles as the robot reports them, rad.
    pub q: [f64; 6],
    /// On the load point.
    pub load: Wrench,
    /// The load point in the flange frame, m.
    pub load_at: Vector3<f64>,
    /// The marker in the flange frame, m.
    pub marker_at: Vector3<f64>,
    /// Its displacement, m.
    pub moved: Vector3<f64>,
    /// Standard deviation of the noise of a coordinate, m.
    pub sigma: Option<f64>,
}

/// Where in the flange frame loads act and markers sit, as far as the table does not say it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// The load point, m; the flange centre where `None`.
    pub load: Option<[f64; 3]>,
    /// Markers, with their names where they have one, m; the load point where there are none.
    pub markers: Vec<Marker>,
}

/// A point that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// As the column `marker` calls it.
    pub name: Option<String>,
    /// In the flange frame, m.
    pub at: [f64; 3],
}

/// Reads a table of measurements; `file` is named in errors.
///
/// # Errors
/// All faults at once, each with its line, row and column: what is missing or no number, what has the wrong unit by all appearance,
/// what was copied, and what nothing can be concluded from.
pub fn read(text: &str, file: &str, points: &Points) -> Result<Measurements, Faults> {
    let (found, mut faults) = rows_of(text, false, points);
    if let Some(found) = found.filter(|_| faults.is_empty()) {
        checks::check(&found.measurements, &found.units, &mut faults);
        if faults.is_empty() {
            return Ok(found.measurements);
        }
    }
    Err(Faults { file: file.into(), faults })
}

/// Reads a table that is still to be filled in: postures and loads; its displacements are zero, whatever stands there.
///
/// # Errors
/// As [`read`], of each row alone.
pub fn read_planned(text: &str, file: &str, points: &Points) -> Result<Measurements, Faults> {
    let (found, faults) = rows_of(text, true, points);
    match found {
        Some(found) if faults.is_empty() && !found.measurements.readings.is_empty() => Ok(found.measurements),
        Some(_) if faults.is_empty() => {
            let fault = Fault { line: 1, key: String::new(), message: "no row holds a posture".into() };
            Err(Faults { file: file.into(), faults: vec![fault] })
        }
        _ => Err(Faults { file: file.into(), faults }),
    }
}

fn rows_of(text: &str, is_planned: bool, points: &Points) -> (Option<rows::Found>, Vec<Fault>) {
    let mut faults = Vec::new();
    let found = columns::table(text, is_planned, &mut faults).map(|table| rows::read(&table, points, &mut faults));
    faults.sort_by_key(|fault| fault.line);
    (found, faults)
}
