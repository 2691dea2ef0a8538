//! Reads a table (CSV) of forces that were measured along a path; checks every cell.

use super::Fault;
use super::reader::shown;
use crate::cutting::{Along, Measured, MeasuredAxes, MeasuredForce};

/// Longer tables are cut down before.
const MOST_ROWS: usize = 1_000_000;
/// N and N m.
const MOST: f64 = 1e5;
const EXPECTED: &str = "one of s_m, s_mm (the way) and time_s, time_ms (while the tool feeds); fx_n,fy_n,fz_n (axes of the part or the sensor) \
                        or f_feed_n,f_across_n,f_axial_n; and optionally moment_nm";

/// How the table stands to the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sensor {
    /// -1 where the work was measured, which feels the opposite.
    pub(super) sign: f64,
    /// From the part's x axis to the sensor's, about z, rad.
    pub(super) yaw: f64,
}

/// The forces, and columns of which nothing is known.
pub(super) fn measured(text: &str, sensor: Sensor) -> Result<(Measured, Vec<String>), Fault> {
    let fault = |line: usize, key: &str, message: String| Fault { line, key: key.into(), message };
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    let delimiter = [b';', b'\t'].into_iter().find(|&c| first.contains(char::from(c))).unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let line_of = |error: &csv::Error| error.position().map_or(1, |at| at.line() as usize);
    let names = reader.headers().map_err(|error| fault(line_of(&error), "", error.to_string()))?;
    let names: Vec<String> = names.iter().map(str::to_ascii_lowercase).collect();
    let place = |name: &str| names.iter().position(|known| known == name);
    let counted = [
        ("s_m", Along::Way, 1.0),
        ("s_mm", Along::Way, 1e-3),
        ("time_s", Along::Time, 1.0),
        ("time_ms", Along::Time, 1e-3),
    ];
    let counted: Vec<_> =
        counted.into_iter().filter_map(|(name, along, unit)| Some((place(name)?, along, unit))).collect();
    let three = |columns: [&str; 3]| -> Option<[usize; 3]> {
        columns.map(place).into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()
    };
    let forces = [
        (MeasuredAxes::Part, three(["fx_n", "fy_n", "fz_n"])),
        (MeasuredAxes::Cut, three(["f_feed_n", "f_across_n", "f_axial_n"])),
    ];
    let forces: Vec<_> = forces.into_iter().filter_map(|(axes, columns)| Some((axes, columns?))).collect();
    let ([(at, along, unit)], [(axes, columns)]) = (counted.as_slice(), forces.as_slice()) else {
        return Err(fault(1, "", format!("the columns are {}; expected {EXPECTED}", shown(&names.join(", ")))));
    };
    let turning = place("moment_nm");
    let mut rows: Vec<MeasuredForce> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| fault(line_of(&error), "", error.to_string()))?;
        let line = record.position().map_or(0, |position| position.line() as usize);
        let number = |column: usize, most: f64| {
            let cell = &record[column];
            let value = cell.parse::<f64>().ok().filter(|value| value.abs() <= most);
            value.ok_or_else(|| {
                fault(line, &names[column], format!("{}; expected a number of at most {most}", shown(cell)))
            })
        };
        let at = number(*at, 1e9)? * unit;
        if rows.last().is_some_and(|before| !(before.at < at)) {
            return Err(fault(
                line,
                &names[counted[0].0],
                "it does not lie beyond the row before; expected rising rows".into(),
            ));
        }
        let [x, y, z] = [number(columns[0], MOST)?, number(columns[1], MOST)?, number(columns[2], MOST)?]
            .map(|part| part * sensor.sign);
        let (s, c) = if *axes == MeasuredAxes::Part { sensor.yaw.sin_cos() } else { (0.0, 1.0) };
        let moment = turning.map_or(Ok(0.0), |column| number(column, MOST))? * sensor.sign;
        rows.push(MeasuredForce { at, force: [c * x - s * y, s * x + c * y, z], moment });
        if MOST_ROWS < rows.len() {
            return Err(fault(line, "", format!("more than {MOST_ROWS} rows; a robot follows means: expected fewer")));
        }
    }
    let known = |i: &usize| *i == counted[0].0 || columns.contains(i) || Some(*i) == turning;
    let ignored = (0..names.len()).filter(|i| !known(i)).map(|i| shown(&names[i])).collect();
    let count = rows.len();
    let found = Measured::new(*along, *axes, rows);
    found.map(|found| (found, ignored)).ok_or_else(|| fault(1, "", format!("{count} rows; expected at least 2")))
}
