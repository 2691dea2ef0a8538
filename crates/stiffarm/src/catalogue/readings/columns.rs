//! Which columns does a table of readings have?

use super::super::Fault;
use super::super::cells::{cells, headings, line_of, miscounted};
use super::super::reader::shown;
use super::{Notation, ReadOptions};

/// Longer tables are no readings of a robot.
const MOST_ROWS: usize = 100_000;
/// So many points of the flange are looked at, at most.
const MOST_POINTS: usize = 4;

/// Where each quantity stands, by its column.
pub(super) struct Columns {
    pub names: Vec<String>,
    pub q: [usize; 6],
    pub points: Vec<[usize; 3]>,
    /// Measured points, not what the controller shows.
    pub is_measured: bool,
    pub notation: Option<(Notation, Vec<usize>)>,
    pub stand: Option<usize>,
}

/// The cells of a row with its line in the file, from 1.
pub(super) struct Row {
    pub line: usize,
    pub cells: Vec<String>,
}

impl Columns {
    /// A sentence for each column of which nothing is known.
    pub(super) fn passed_over(&self) -> Vec<String> {
        let oriented = self.notation.iter().flat_map(|(_, at)| at.iter().copied());
        let points = self.points.iter().flatten().copied();
        let known: Vec<usize> = self.q.into_iter().chain(points).chain(oriented).chain(self.stand).collect();
        let others = self.names.iter().enumerate().filter(|(i, _)| !known.contains(i));
        others.map(|(_, name)| format!("the column {} is not known, and passed over", shown(name))).collect()
    }
}

/// Finds columns and rows; `None` where there is a fault.
pub(super) fn table(text: &str, options: &ReadOptions, faults: &mut Vec<Fault>) -> Option<(Columns, Vec<Row>)> {
    let mut reader = cells(text);
    let (line, found) = headings(text, &mut reader).map_err(|fault| faults.push(fault)).ok()?;
    let names: Vec<String> = found.iter().map(str::to_ascii_lowercase).collect();
    let columns = Finder { names, line, options, faults }.columns()?;
    let (mut rows, mut count) = (Vec::new(), 0);
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                let line = line_of(text, error.position());
                faults.push(Fault { line, key: String::new(), message: error.to_string() });
                return None;
            }
        };
        let line = line_of(text, record.position());
        if record.iter().all(str::is_empty) {
            continue;
        }
        count += 1;
        if record.len() != columns.names.len() {
            let message = miscounted(count, record.len(), columns.names.len());
            faults.push(Fault { line, key: String::new(), message });
            continue;
        }
        rows.push(Row { line, cells: record.iter().map(str::to_owned).collect() });
        if MOST_ROWS < rows.len() {
            let message = format!("more than {MOST_ROWS} rows; is it the right file?");
            faults.push(Fault { line, key: String::new(), message });
            return None;
        }
    }
    Some((columns, rows))
}

struct Finder<'a> {
    names: Vec<String>,
    line: usize,
    options: &'a ReadOptions,
    faults: &'a mut Vec<Fault>,
}

impl Finder<'_> {
    fn columns(mut self) -> Option<Columns> {
        self.rename()?;
        if let Some(twice) = self.names.iter().enumerate().find(|(i, name)| self.names[..*i].contains(name)) {
            let name = shown(twice.1);
            self.fault(name, "stands twice; expected each column once".into());
            return None;
        }
        let short = ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"];
        let long = ["joint_1_deg", "joint_2_deg", "joint_3_deg", "joint_4_deg", "joint_5_deg", "joint_6_deg"];
        let q = if self.has(&short) { self.all(short) } else { self.all(long) };
        let points = self.points();
        let notation = self.notation();
        let stand = match &self.options.frame_by {
            None => Some(None),
            Some(name) => self.position(&name.to_ascii_lowercase()).map(Some).or_else(|| {
                self.fault(
                    shown(name),
                    "no column is called so; --frame-by names the column that tells stands of the tracker apart".into(),
                );
                None
            }),
        };
        let (points, is_measured) = points?;
        Some(Columns { q: q?, points, is_measured, notation: notation?, stand: stand?, names: self.names })
    }

    /// Gives columns the names that they have here.
    fn rename(&mut self) -> Option<()> {
        for (ours, theirs) in &self.options.columns {
            let Some(at) = self.position(&theirs.to_ascii_lowercase()) else {
                let there = self.names.iter().map(|name| shown(name)).collect::<Vec<_>>().join(", ");
                self.fault(shown(theirs), format!("no column is called so, as columns says; there are {there}"));
                return None;
            };
            self.names[at] = ours.to_ascii_lowercase();
        }
        Some(())
    }

    fn points(&mut self) -> Option<(Vec<[usize; 3]>, bool)> {
        let numbered = |i: usize| ["x", "y", "z"].map(|axis| format!("{axis}{i}_mm"));
        let is_there = |names: &[String; 3]| names.iter().any(|name| self.position(name).is_some());
        let measured: Vec<usize> = (1..=MOST_POINTS).filter(|&i| is_there(&numbered(i))).collect();
        if measured.is_empty() {
            return Some((vec![self.all(["x_mm", "y_mm", "z_mm"])?], false));
        }
        if self.position("x_mm").is_some() {
            self.fault(
                "x_mm".into(),
                "beside x1_mm: expected either what the controller shows or measured points".into(),
            );
            return None;
        }
        let mut points = Vec::new();
        for i in measured {
            let names = numbered(i);
            points.push(self.all([&*names[0], &*names[1], &*names[2]])?);
        }
        Some((points, true))
    }

    /// The outer `None` is a fault.
    fn notation(&mut self) -> Option<Option<(Notation, Vec<usize>)>> {
        let rx =
            if self.options.vendor.eq_ignore_ascii_case("staubli") { Notation::TurnedXyz } else { Notation::FixedXyz };
        let abb = ["q1", "q2", "q3", "q4"];
        if self.has(&abb) {
            return self.all(abb).map(|at| Some((Notation::Quaternion, at.to_vec())));
        }
        // Kawasaki's A stands between O and T.
        let marks = [
            (Notation::Oat, "o_deg"),
            (Notation::Abc, "b_deg"),
            (Notation::Wpr, "w_deg"),
            (Notation::Quaternion, "qw"),
            (rx, "rx_deg"),
        ];
        let found: Vec<Notation> =
            marks.into_iter().filter(|(_, mark)| self.position(mark).is_some()).map(|(notation, _)| notation).collect();
        match found.as_slice() {
            [] => Some(None),
            [one] => match *one.columns() {
                [a, b, c] => Some(Some((*one, self.all([a, b, c])?.to_vec()))),
                _ => Some(Some((*one, self.all(["qw", "qx", "qy", "qz"])?.to_vec()))),
            },
            [first, second, ..] => {
                let [first, second] = [first, second].map(|notation| notation.columns().join(", "));
                self.fault(first, format!("beside {second}: expected the orientation once"));
                None
            }
        }
    }

    fn position(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Some of these are there.
    fn has(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.position(name).is_some())
    }

    /// All of these; those that are missing are faults.
    fn all<const N: usize>(&mut self, names: [&str; N]) -> Option<[usize; N]> {
        let missing: Vec<&str> = names.into_iter().filter(|name| self.position(name).is_none()).collect();
        for name in &missing {
            let message = format!(
                "the column is missing; expected {}; columns NAME=HEADING says what a table calls them",
                names.join(", ")
            );
            self.fault((*name).into(), message);
        }
        missing.is_empty().then(|| names.map(|name| self.position(name).expect("none is missing")))
    }

    fn fault(&mut self, key: String, message: String) {
        self.faults.push(Fault { line: self.line, key, message });
    }
}
