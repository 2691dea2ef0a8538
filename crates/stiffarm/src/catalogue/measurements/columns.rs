//! Which columns does a table of measurements have, and in which units?

use std::collections::HashSet;

use super::super::Fault;
use super::super::cells::{cells, headings, line_of, miscounted};
use super::super::reader::shown;

/// Columns of tables to be filled in that say nothing of what was measured.
pub(crate) const PASSED_OVER: [&str; 5] = ["run", "load", "expected_mm", "remark", "time"];
/// Quantities that may be left out, each with the one unit in which they are read.
const IN_ONE_UNIT: [(&str, &str); 10] = [
    ("sigma", "mm"),
    ("load_x", "mm"),
    ("load_y", "mm"),
    ("load_z", "mm"),
    ("marker_x", "mm"),
    ("marker_y", "mm"),
    ("marker_z", "mm"),
    ("mx", "nm"),
    ("my", "nm"),
    ("mz", "nm"),
];
/// Longer tables are no measurements of a robot.
const MOST_ROWS: usize = 200_000;

/// The unit of the joint angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Angles {
    Degrees,
    Radians,
}

/// Three columns that stand together.
pub(super) type Three = [usize; 3];

/// Where each quantity stands, by its column.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    pub q: [usize; 6],
    pub angles: Angles,
    pub force: Three,
    pub moment: Option<Three>,
    /// `None` of a table that is to be filled in.
    pub moved: Option<Three>,
    /// The ending of their names, and m per unit.
    pub length: (&'static str, f64),
    pub posture: Option<usize>,
    pub marker: Option<usize>,
    pub load_at: Option<Three>,
    pub marker_at: Option<Three>,
    pub sigma: Option<usize>,
}

/// The cells of a table, under columns that are known.
pub(super) struct Table {
    pub names: Vec<String>,
    pub columns: Columns,
    pub rows: Vec<Row>,
    /// Columns of which nothing is known.
    pub unknown: Vec<String>,
}

/// A row with its line in the file, from 1.
pub(super) struct Row {
    pub line: usize,
    pub cells: Vec<String>,
}

/// Finds the columns; `None` where there is none of some that are needed, which is a fault.
pub(super) fn table(text: &str, is_planned: bool, faults: &mut Vec<Fault>) -> Option<Table> {
    let mut reader = cells(text);
    let (line, found) = headings(text, &mut reader).map_err(|fault| faults.push(fault)).ok()?;
    let names: Vec<String> = found.iter().map(str::to_ascii_lowercase).collect();
    let columns = Finder { names: &names, line, is_planned, faults }.columns()?;
    let (mut rows, mut count) = (Vec::new(), 0);
    for record in reader.records() {
        let fault = |line: usize, message: String| Fault { line, key: String::new(), message };
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                faults.push(fault(line_of(text, error.position()), error.to_string()));
                return None;
            }
        };
        let line = line_of(text, record.position());
        if record.iter().all(str::is_empty) {
            continue;
        }
        count += 1;
        if record.len() != names.len() {
            faults.push(fault(line, miscounted(count, record.len(), names.len())));
            continue;
        }
        rows.push(Row { line, cells: record.iter().map(str::to_owned).collect() });
        if MOST_ROWS < rows.len() {
            faults.push(fault(line, format!("more than {MOST_ROWS} rows; is it the right file?")));
            return None;
        }
    }
    let unknown = unknown(&names, &columns);
    Some(Table { names, columns, rows, unknown })
}

struct Finder<'a> {
    names: &'a [String],
    line: usize,
    /// Displacements are still to be measured.
    is_planned: bool,
    faults: &'a mut Vec<Fault>,
}

impl Finder<'_> {
    fn columns(mut self) -> Option<Columns> {
        let mut seen = HashSet::new();
        if let Some(twice) = self.names.iter().find(|name| !seen.insert(name.as_str())) {
            self.fault(twice.clone(), "stands twice; expected each column once".into());
            return None;
        }
        self.check_units();
        let degrees = self.has(&["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"]);
        let radians = self.has(&["q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"]);
        let q = match (degrees, radians) {
            (true, true) => {
                self.fault("q1_rad".into(), "beside q1_deg: expected joint angles in one unit".into());
                None
            }
            (_, false) => self.all(["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"], "or q1_rad to q6_rad"),
            (false, true) => {
                self.all(["q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"], "or q1_deg to q6_deg")
            }
        };
        let angles = if radians { Angles::Radians } else { Angles::Degrees };
        let force = self.all(["fx_n", "fy_n", "fz_n"], "the force on the load point in N");
        let moment = self.optional(["mx_nm", "my_nm", "mz_nm"]);
        let moved = if self.is_planned { Some((None, ("mm", 1e-3))) } else { self.moved() };
        let load_at = self.optional(["load_x_mm", "load_y_mm", "load_z_mm"]);
        let marker_at = self.optional(["marker_x_mm", "marker_y_mm", "marker_z_mm"]);
        let (moved, length) = moved?;
        Some(Columns {
            q: q?,
            angles,
            force: force?,
            moment: moment?,
            moved,
            length,
            posture: self.position("posture"),
            marker: self.position("marker"),
            load_at: load_at?,
            marker_at: marker_at?,
            sigma: self.position("sigma_mm"),
        })
    }

    /// That what may be left out is not there in another unit, in which it would be passed over.
    fn check_units(&mut self) {
        for (stem, unit) in IN_ONE_UNIT {
            let other =
                |name: &str| name.strip_prefix(stem)?.strip_prefix('_').filter(|ending| *ending != unit).map(|_| ());
            if let Some(name) = self.names.iter().find(|name| other(name).is_some()) {
                self.fault(shown(name), format!("in another unit; expected {stem}_{unit}"));
            }
        }
    }

    fn moved(&mut self) -> Option<(Option<Three>, (&'static str, f64))> {
        let units: [([&str; 3], (&'static str, f64)); 3] = [
            (["dx_mm", "dy_mm", "dz_mm"], ("mm", 1e-3)),
            (["dx_um", "dy_um", "dz_um"], ("um", 1e-6)),
            (["dx_m", "dy_m", "dz_m"], ("m", 1.0)),
        ];
        let found: Vec<_> = units.into_iter().filter(|(names, _)| self.has(names)).collect();
        if let [_, (names, _), ..] = found.as_slice() {
            self.fault(names[0].into(), "beside the same in another unit: expected displacements in one".into());
            return None;
        }
        let (names, unit) = found.into_iter().next().unwrap_or(units[0]);
        Some((Some(self.all(names, "the displacement of the marker; or dx_um, or dx_m")?), unit))
    }

    fn position(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Some of these are there.
    fn has(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.position(name).is_some())
    }

    /// All of these; those that are missing are faults.
    fn all<const N: usize>(&mut self, names: [&str; N], expected: &str) -> Option<[usize; N]> {
        let missing: Vec<&str> = names.into_iter().filter(|name| self.position(name).is_none()).collect();
        for name in &missing {
            let near = self.names.iter().map(|known| (crate::plain::alike(known, name), known));
            let near = near.filter(|(_, known)| !names.contains(&known.as_str())).max_by(|a, b| a.0.total_cmp(&b.0));
            let hint = near.filter(|(score, _)| 0.75 < *score);
            let hint = hint.map_or_else(String::new, |(_, known)| format!("; is it the column {}?", shown(known)));
            self.fault(
                (*name).into(),
                format!("the column is missing; expected {}, {expected}{hint}", names.join(", ")),
            );
        }
        missing.is_empty().then(|| names.map(|name| self.position(name).unwrap_or_default()))
    }

    /// All of these or none; the outer `None` is a fault.
    fn optional(&mut self, names: [&str; 3]) -> Option<Option<Three>> {
        if self.has(&names) { self.all(names, "all three").map(Some) } else { Some(None) }
    }

    fn fault(&mut self, key: String, message: String) {
        self.faults.push(Fault { line: self.line, key, message });
    }
}

/// The names of columns that say nothing.
fn unknown(names: &[String], columns: &Columns) -> Vec<String> {
    let three = |three: Option<Three>| three.into_iter().flatten();
    let known: Vec<usize> = (columns.q.into_iter())
        .chain(columns.force)
        .chain(three(columns.moved))
        .chain(three(columns.moment))
        .chain(three(columns.load_at))
        .chain(three(columns.marker_at))
        .chain([columns.posture, columns.marker, columns.sigma].into_iter().flatten())
        .collect();
    let others =
        names.iter().enumerate().filter(|(i, name)| !known.contains(i) && !PASSED_OVER.contains(&name.as_str()));
    others.map(|(_, name)| shown(name)).collect()
}
