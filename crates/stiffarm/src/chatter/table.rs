//! Reads a table (CSV) of how a tip answered where it was tapped: frequency by frequency, or its modes; checks every cell.

use std::f64::consts::TAU;

use nalgebra::{Complex, Matrix3, Vector3};

use super::measured::{HeldBy, MeasuredMode, Response, Samples};
use crate::catalogue::cells::{cells, line_of, miscounted};
use crate::catalogue::{Fault, Faults, shown};

/// Longer tables are refused: an analyser tells some thousand lines.
const MOST_ROWS: usize = 20_000;
const FEWEST_ROWS: usize = 8;
const MOST_MODES: usize = 50;
/// A larger share of frequencies with a negative damping is no noise.
const NOISY: f64 = 0.1;
/// A shorter vector is no direction.
const SHORTEST: f64 = 1e-6;
/// kg: no robot swings with more.
const MOST_MASS: f64 = 20_000.0;
/// A direction whose length is further from one may be a shape with a scale of its own.
const OFF_ONE: f64 = 0.1;
/// The answer at one place to a force at another is that the other way round: a larger difference, in parts of the largest answer, is no noise.
const NOT_RECIPROCAL: f64 = 0.2;
const MODES: [&str; 6] = ["freq_hz", "damping_ratio", "stiffness_n_per_m", "ux", "uy", "uz"];
const AXES: [char; 3] = ['x', 'y', 'z'];
const EXPECTED: &str = "freq_hz and gxx_re, gxx_im, gyy_re, gyy_im .. gzz_im (m/N, tool axes), or a table of modes: freq_hz, damping_ratio, \
                        stiffness_n_per_m, ux, uy, uz";

/// What a table tells of a tip.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFile {
    /// How it answers.
    pub response: Response,
    /// How it was understood: what is not in the table, what is not sampled finely enough, where the damping is negative.
    pub remarks: Vec<String>,
}

impl HeldBy {
    /// The largest answer, m/N, and the least stiffness, N/m, that a tip has: what lies beyond is of another unit.
    const fn bounds(self) -> [f64; 2] {
        match self {
            Self::Rigid => [2e-5, 1e5],
            Self::Robot => [1e-3, 1e4],
        }
    }
}

/// Reads the response of a tip, in tool axes, held by something of which its size is known.
///
/// # Errors
/// Every fault of the table, with line, column, value and what was expected.
pub fn read_response(text: &str, file: &str, held_by: HeldBy) -> Result<ResponseFile, Faults> {
    Reader::read(text, held_by).map_err(|fault| Faults { file: file.into(), faults: vec![fault] })
}

struct Reader<'a> {
    text: &'a str,
    names: Vec<String>,
    held_by: HeldBy,
}

fn fault(line: usize, key: &str, message: String) -> Fault {
    Fault { line, key: key.into(), message }
}

fn of_csv(text: &str, error: &csv::Error) -> Fault {
    fault(line_of(text, error.position()), "", error.to_string())
}

impl<'a> Reader<'a> {
    fn read(text: &'a str, held_by: HeldBy) -> Result<ResponseFile, Fault> {
        let mut reader = cells(text);
        let names: Vec<String> =
            reader.headers().map_err(|error| of_csv(text, &error))?.iter().map(str::to_ascii_lowercase).collect();
        if names.iter().all(String::is_empty) {
            return Err(fault(1, "", format!("no headings; expected {EXPECTED}")));
        }
        let twice = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name));
        if let Some((_, name)) = twice {
            return Err(fault(1, "", format!("the column {} is there twice; expected it once", shown(name))));
        }
        let reader = Self { text, names, held_by };
        if reader.place("damping_ratio").is_some() { reader.modes() } else { reader.samples() }
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    fn columns(&self) -> Fault {
        fault(1, "", format!("the columns are {}; expected {EXPECTED}", shown(&self.names.join(", "))))
    }

    /// Hands out every row: its line, and its cells by their column.
    fn rows(
        &self,
        most: usize,
        mut row: impl FnMut(usize, &dyn Fn(usize, [f64; 2], &str) -> Result<f64, Fault>) -> Result<(), Fault>,
    ) -> Result<usize, Fault> {
        let mut count = 0;
        for record in cells(self.text).records() {
            let record = record.map_err(|error| of_csv(self.text, &error))?;
            let line = line_of(self.text, record.position());
            count += 1;
            if most < count {
                return Err(fault(line, "", format!("more than {most} rows; expected fewer")));
            }
            if record.len() != self.names.len() {
                return Err(fault(line, "", miscounted(count, record.len(), self.names.len())));
            }
            let number = |column: usize, [least, most]: [f64; 2], expected: &str| {
                let cell = &record[column];
                let value = cell.parse::<f64>().ok().filter(|value| (least..=most).contains(value));
                value.ok_or_else(|| fault(line, &self.names[column], format!("{}; expected {expected}", shown(cell))))
            };
            row(line, &number)?;
        }
        Ok(count)
    }

    fn ignored(&self, known: impl Fn(&str) -> bool) -> Vec<String> {
        let unknown = self.names.iter().filter(|name| !known(name));
        unknown.map(|name| format!("column {} is ignored", shown(name))).collect()
    }

    fn modes(&self) -> Result<ResponseFile, Fault> {
        let [frequency, ratio, stiffness, x, y, z] = MODES.map(|name| self.place(name));
        let (Some(frequency), Some(ratio), Some(stiffness), Some(x), Some(y), Some(z)) =
            (frequency, ratio, stiffness, x, y, z)
        else {
            return Err(self.columns());
        };
        let [_, softest] = self.held_by.bounds();
        let (mut modes, mut scaled) = (Vec::new(), None::<(usize, f64)>);
        let count = self.rows(MOST_MODES, |line, number| {
            let along = |column| number(column, [-1e6, 1e6], "a number from -1e6 to 1e6");
            let mode = MeasuredMode {
                frequency: number(frequency, [0.1, 1e5], "a frequency from 0.1 to 100000 Hz")?,
                ratio: number(
                    ratio,
                    [f64::MIN_POSITIVE, 1.0],
                    "a share of critical damping of more than 0 and at most 1; a negative damping would swing by itself",
                )?,
                stiffness: number(stiffness, [softest, 1e12], &format!("a stiffness from {softest} to 1e12 N/m"))?,
                direction: [along(x)?, along(y)?, along(z)?],
            };
            let length = Vector3::from(mode.direction).norm();
            if !(SHORTEST <= length) {
                let [x, y, z] = mode.direction;
                let message = format!("{x:?}, {y:?}, {z:?}; expected the direction in which the tip moves, of length one or so");
                return Err(fault(line, "ux", message));
            }
            let mass = mode.stiffness / (TAU * mode.frequency).powi(2);
            if MOST_MASS < mass {
                let message = format!(
                    "{} Hz with {:e} N/m is a mass of {mass:.0} kg that swings; expected at most {MOST_MASS} kg: is the frequency in Hz, and the stiffness in N/m?",
                    mode.frequency, mode.stiffness
                );
                return Err(fault(line, "freq_hz", message));
            }
            if OFF_ONE < (length - 1.0).abs() {
                scaled = scaled.or(Some((line, length)));
            }
            modes.push(mode);
            Ok(())
        })?;
        if count == 0 {
            return Err(fault(1, "", "no rows; expected a mode a row".into()));
        }
        let mut remarks = self.ignored(|name| MODES.contains(&name));
        remarks.extend(scaled.map(|(line, length)| {
            format!(
                "line {line}: ux, uy, uz are {length:.3} long and taken as a direction alone, of length one, along which the stiffness is; of a shape that is scaled otherwise give the stiffness of the tip along it"
            )
        }));
        Ok(ResponseFile { response: Response::of_modes(&modes), remarks })
    }

    /// The columns of one part of the response, real and imaginary; the other of two that are alike where it is absent.
    fn part(&self, row: usize, column: usize) -> Result<Option<[usize; 2]>, Fault> {
        let of = |a: usize, b: usize| {
            let name = |end: &str| format!("g{}{}_{end}", AXES[a], AXES[b]);
            match (self.place(&name("re")), self.place(&name("im"))) {
                (Some(re), Some(im)) => Ok(Some([re, im])),
                (None, None) => Ok(None),
                (Some(_), None) => Err(fault(1, "", format!("{} without {}; expected both", name("re"), name("im")))),
                (None, Some(_)) => Err(fault(1, "", format!("{} without {}; expected both", name("im"), name("re")))),
            }
        };
        Ok(of(row, column)?.or(of(column, row)?))
    }

    fn samples(&self) -> Result<ResponseFile, Fault> {
        let mut parts = [[None; 3]; 3];
        for (row, parts) in parts.iter_mut().enumerate() {
            for (column, part) in parts.iter_mut().enumerate() {
                *part = self.part(row, column)?;
            }
        }
        let (Some(frequency), Some(_), Some(_)) = (self.place("freq_hz"), parts[0][0], parts[1][1]) else {
            return Err(self.columns());
        };
        let [most, _] = self.held_by.bounds();
        let expected = format!("a number of at most {most} in size, m/N; mm/N and um/N are other units");
        let mut rows: Vec<(f64, Matrix3<Complex<f64>>)> = Vec::new();
        let (mut largest, mut apart) = (0.0_f64, 0.0_f64);
        let count = self.rows(MOST_ROWS, |line, number| {
            let hertz = number(frequency, [0.0, 1e5], "a frequency from 0 to 100000 Hz")?;
            if rows.last().is_some_and(|(before, _)| !(*before < hertz)) {
                let message = format!("{hertz} Hz does not lie above the row before; expected rising frequencies");
                return Err(fault(line, "freq_hz", message));
            }
            let mut receptance = Matrix3::zeros();
            for (row, parts) in parts.iter().enumerate() {
                for (column, part) in parts.iter().enumerate() {
                    let Some([re, im]) = *part else { continue };
                    let part = |at| number(at, [-most, most], &expected);
                    receptance[(row, column)] = Complex::new(part(re)?, part(im)?);
                }
            }
            largest = largest.max(receptance.camax());
            apart = apart.max((receptance - receptance.transpose()).camax());
            rows.push((hertz, receptance));
            Ok(())
        })?;
        let few = || fault(1, "", format!("{count} rows; expected at least {FEWEST_ROWS} frequencies"));
        let samples = Samples::new(rows).filter(|_| FEWEST_ROWS <= count).ok_or_else(few)?;
        if let Some(axis) = samples.gives_energy().first() {
            let name = format!("g{0}{0}_im", AXES[*axis]);
            let message =
                "more than 0 at the largest answer: a tip that gives energy; expected less than 0, as e^(i w t) has it"
                    .into();
            return Err(fault(1, &name, message));
        }
        check(&samples)?;
        let mut remarks = self.remarks(&samples, &parts);
        if NOT_RECIPROCAL * largest < apart {
            remarks.push(format!(
                "gxy and gyx, or another such pair, differ by {:.0} % of the largest answer: both are the same of one tip; a sign or an axis of the table may be wrong",
                100.0 * apart / largest
            ));
        }
        Ok(ResponseFile { remarks, response: Response::Samples(samples) })
    }

    fn remarks(&self, samples: &Samples, parts: &[[Option<[usize; 2]>; 3]; 3]) -> Vec<String> {
        let known = |name: &str| {
            let place = self.place(name);
            name == "freq_hz" || parts.iter().flatten().flatten().flatten().any(|part| Some(*part) == place)
        };
        let mut remarks = self.ignored(known);
        let absent = (0..9).map(|i| (i / 3, i % 3)).filter(|(a, b)| a <= b && parts[*a][*b].is_none());
        let absent: Vec<String> = absent.map(|(a, b)| format!("g{}{}", AXES[a], AXES[b])).collect();
        if !absent.is_empty() {
            remarks.push(format!("{} are not in the table and taken as 0", absent.join(", ")));
        }
        let (negative, count) = (samples.negative_damping(), samples.count());
        if 0 < negative {
            remarks.push(format!("at {negative} of {count} frequencies the damping is negative: noise, or not causal"));
        }
        if let Some(([low, high], share)) = samples.coarsest() {
            remarks.push(format!(
                "from {low:.2} to {high:.2} Hz the response moves by {:.0} % of its largest: depths near there are not sure; expected more frequencies",
                100.0 * share
            ));
        }
        remarks
    }
}

/// What no tip answers, and what leaves its modes out.
fn check(samples: &Samples) -> Result<(), Fault> {
    let of = |axis: usize, part: &str| format!("g{0}{0}{part}", AXES[axis]);
    let (negative, count) = (samples.negative_damping(), samples.count());
    if let Some(axis) = (0..2).find(|axis| samples.largest(*axis) == 0.0) {
        return Err(fault(1, &of(axis, "_re"), "0 at every frequency; expected how the tip gives way".into()));
    }
    if NOISY * (count as f64) < negative as f64 {
        let message = format!(
            "at {negative} of {count} frequencies the damping is negative; expected displacement over force, which lags, and neither velocity nor acceleration"
        );
        return Err(fault(1, "", message));
    }
    if let Some(([a, b], times)) = samples.crosses_too_much() {
        let name = format!("g{}{}_im", AXES[a], AXES[b]);
        let message = format!(
            "{times:.1} times what g{0}{0} and g{1}{1} allow at its peak: a tip that gives energy; expected every column in the same unit, m/N",
            AXES[a], AXES[b]
        );
        return Err(fault(1, &name, message));
    }
    if let Some(axis) = samples.begins_late() {
        let message = "not more than 0 in the first row: the table begins above a resonance; expected it to begin below the first one";
        return Err(fault(1, &of(axis, "_re"), message.into()));
    }
    if let Some(axis) = samples.ends_early() {
        let message = "in the last row more than half of the answer in the first: the table ends before the modes do; expected it to go on until the answer has fallen";
        return Err(fault(1, &of(axis, "_re"), message.into()));
    }
    Ok(())
}
