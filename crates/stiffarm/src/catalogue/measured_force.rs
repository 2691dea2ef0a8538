//! Reads a table (CSV) of forces that were measured along a path; checks every cell.

use super::Fault;
use super::cells::{cells, line_of, miscounted};
use super::reader::{Quantity, Table, shown};
use crate::cutting::{Along, Law, Measured, MeasuredAxes, MeasuredForce};

const YAW: Quantity = Quantity { unit: "deg", min: -360.0, max: 360.0, suspect: None };

/// Longer tables are refused: means over some milliseconds are what a robot follows.
const MOST_ROWS: usize = 1_000_000;
/// N and N m.
const MOST: f64 = 1e5;
const EXPECTED: &str = "one of s_m, s_mm (the way) and time_s, time_ms (while the tool feeds); fx_n,fy_n,fz_n (axes of the part or the sensor) \
                        or f_feed_n,f_across_n,f_axial_n; and optionally moment_nm";

/// Forces from a table.
pub(super) fn measured_law(
    table: &mut Table,
    assumed: &mut Vec<String>,
    beside: &mut dyn FnMut(&str) -> Result<String, String>,
) -> Option<Law> {
    let name = table.text("file", true);
    let sign = table.choice("on", &[("tool", 1.0), ("work", -1.0)], None);
    let yaw = table.optional_number("sensor_yaw_deg", YAW);
    let (name, sensor) = (name?, Sensor { sign: sign?, yaw: yaw.unwrap_or(0.0).to_radians() });
    let found = beside(&name).and_then(|text| {
        measured(&text, sensor).map_err(|Fault { line, key, message }| {
            let key = if key.is_empty() { key } else { format!("{key}: ") };
            format!("{}:{line}: {key}{message}", shown(&name))
        })
    });
    match found {
        Err(why) => {
            table.fault("file", why);
            None
        }
        Ok((found, ignored)) => {
            if found.axes == MeasuredAxes::Cut && yaw.is_some() {
                table.fault("sensor_yaw_deg", "beside forces along the axes of the cut; expected fx_n,fy_n,fz_n");
                return None;
            }
            assumed.extend(ignored.into_iter().map(|column| format!("column {column} of {} is ignored", shown(&name))));
            Some(Law::Measured(found))
        }
    }
}

/// How the table stands to the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sensor {
    /// -1 where the work was measured, which feels the opposite.
    sign: f64,
    /// From the part's x axis to the sensor's, about z, rad.
    yaw: f64,
}

/// The forces, and columns of which nothing is known.
fn measured(text: &str, sensor: Sensor) -> Result<(Measured, Vec<String>), Fault> {
    let fault = |line: usize, key: &str, message: String| Fault { line, key: key.into(), message };
    let mut reader = cells(text);
    let names = reader.headers().map_err(|error| fault(line_of(text, error.position()), "", error.to_string()))?;
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
        let record = record.map_err(|error| fault(line_of(text, error.position()), "", error.to_string()))?;
        let line = line_of(text, record.position());
        if record.len() != names.len() {
            return Err(fault(line, "", miscounted(rows.len() + 1, record.len(), names.len())));
        }
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

#[cfg(test)]
mod tests {
    use super::super::{read_process, read_process_beside};
    use super::*;

    /// On the work acts the opposite; a sensor turned by a quarter has its x where the part has its y.
    #[test]
    fn measured_forces_are_read_from_the_table_that_is_named() {
        let process = "[measured]\nfile = \"f.csv\"\non = \"work\"\nsensor_yaw_deg = 90\n";
        let table = "s_mm;fx_n;fy_n;fz_n;moment_nm;note\n# a remark\n0;1;2;3;4;a\n50;1;2;3;4;b\n";
        let read = |process: &str, table: &str| {
            let mut beside =
                |name: &str| if name == "f.csv" { Ok(table.to_owned()) } else { Err(format!("no {name}")) };
            read_process_beside(process, "p", &mut beside)
        };
        let found = read(process, table).unwrap();
        let Law::Measured(measured) = &found.process.law else { panic!("measured") };
        let (force, moment) = measured.at(0.025).unwrap();
        assert!((0..3).all(|i| (force[i] - [2.0, -1.0, -3.0][i]).abs() < 1e-12) && moment == -4.0, "{force:?}");
        assert_eq!((measured.ends(), found.assumed.len()), ([0.0, 0.05], 1));
        assert!(found.assumed[0].contains("column note of f.csv is ignored"));
        let cut = table.replace("fx_n;fy_n;fz_n", "f_feed_n;f_across_n;f_axial_n");
        assert!(read(&process.replace("sensor_yaw_deg = 90\n", ""), &cut).is_ok());
        for (process, table, says) in [
            (process.replace("on = \"work\"\n", ""), table.to_owned(), "measured.on: missing"),
            (process.replace("f.csv", "g.csv"), table.to_owned(), "p:2: measured.file: no g.csv"),
            (process.to_owned(), cut, "sensor_yaw_deg: beside forces along the axes of the cut"),
            (process.to_owned(), table.replace("s_mm", "s_inch"), "f.csv:1: the columns are s_inch, fx_n"),
            (process.to_owned(), table.replace("fz_n", "fx_n"), "f.csv:1: the columns are"),
            (
                process.to_owned(),
                table.replace("50;1", "50;nan"),
                "f.csv:4: fx_n: nan; expected a number of at most 100000",
            ),
            (process.to_owned(), table.replace("50;", "0;"), "f.csv:4: s_mm: it does not lie beyond the row before"),
            (process.to_owned(), table.replace("50;1;2;3;4;b\n", ""), "f.csv:1: 1 rows; expected at least 2"),
            (process.to_owned(), table.replace(";b", ""), "f.csv:4: row 2: 5 cells; expected 6, as many as headings"),
        ] {
            let message =
                read(&process, &table).err().unwrap_or_else(|| panic!("{process} {table} is read")).to_string();
            assert!(message.contains(says), "{message}\n{says}");
        }
        let alone = read_process(process, "p").unwrap_err().to_string();
        assert!(alone.contains("there is no file f.csv beside it"), "{alone}");
    }
}
