//! Reads a table (CSV) of how a tip answered where it was tapped: frequency by frequency, or its modes; checks every cell.

use nalgebra::{Complex, Matrix3};

use super::measured::{MeasuredMode, Response, Samples};
use crate::catalogue::cells::{cells, miscounted};
use crate::catalogue::{Fault, Faults, shown};

/// Longer tables are refused: an analyser tells some thousand lines.
const MOST_ROWS: usize = 20_000;
const FEWEST_ROWS: usize = 8;
const MOST_MODES: usize = 50;
/// m/N; softer tips are of another unit.
const SOFTEST: f64 = 1e-2;
const MODES: [&str; 6] = ["freq_hz", "damping_ratio", "stiffness_n_per_m", "ux", "uy", "uz"];
const AXES: [char; 3] = ['x', 'y', 'z'];
const EXPECTED: &str = "freq_hz and gxx_re, gxx_im, gyy_re, gyy_im .. gzz_im (m/N, tool axes), or a table of modes: freq_hz, damping_ratio, \
                        stiffness_n_per_m, ux, uy, uz";

/// What a table tells of a tip.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFile {
    /// How it answers.
    pub response: Response,
    /// How it was understood: what is not in the table, what is not told finely enough, where the damping is negative.
    pub remarks: Vec<String>,
}

/// Reads the response of a tip, in tool axes.
///
/// # Errors
/// Every fault of the table, with line, column, value and what was expected.
pub fn read_response(text: &str, file: &str) -> Result<ResponseFile, Faults> {
    Reader::read(text).map_err(|fault| Faults { file: file.into(), faults: vec![fault] })
}

struct Reader<'a> {
    text: &'a str,
    names: Vec<String>,
}

fn fault(line: usize, key: &str, message: String) -> Fault {
    Fault { line, key: key.into(), message }
}

fn of_csv(error: &csv::Error) -> Fault {
    fault(error.position().map_or(1, |at| at.line() as usize), "", error.to_string())
}

impl<'a> Reader<'a> {
    fn read(text: &'a str) -> Result<ResponseFile, Fault> {
        let mut reader = cells(text);
        let names: Vec<String> =
            reader.headers().map_err(|error| of_csv(&error))?.iter().map(str::to_ascii_lowercase).collect();
        let twice = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name));
        if let Some((_, name)) = twice {
            return Err(fault(1, "", format!("the column {} is there twice; expected it once", shown(name))));
        }
        let reader = Self { text, names };
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
            let record = record.map_err(|error| of_csv(&error))?;
            let line = record.position().map_or(0, |position| position.line() as usize);
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
        let mut modes = Vec::new();
        let count = self.rows(MOST_MODES, |line, number| {
            let along = |column| number(column, [-1e6, 1e6], "a number from -1e6 to 1e6");
            let mode = MeasuredMode {
                frequency: number(frequency, [0.1, 1e5], "a frequency from 0.1 to 100000 Hz")?,
                ratio: number(
                    ratio,
                    [f64::MIN_POSITIVE, 1.0],
                    "a share of critical damping of more than 0 and at most 1; a negative damping would swing by itself",
                )?,
                stiffness: number(stiffness, [1e2, 1e12], "a stiffness from 100 to 1e12 N/m")?,
                direction: [along(x)?, along(y)?, along(z)?],
            };
            if mode.direction == [0.0; 3] {
                return Err(fault(line, "ux", "0, 0, 0; expected the direction in which the tip moves".into()));
            }
            modes.push(mode);
            Ok(())
        })?;
        if count == 0 {
            return Err(fault(1, "", "no rows; expected a mode a row".into()));
        }
        let remarks = self.ignored(|name| MODES.contains(&name));
        Ok(ResponseFile { response: Response::of_modes(&modes), remarks })
    }

    /// The columns of one part of the response, real and imaginary; the other of two that are alike where it is absent.
    fn part(&self, row: usize, column: usize) -> Result<Option<[usize; 2]>, Fault> {
        let of = |a: usize, b: usize| {
            let name = |end: &str| format!("g{}{}_{end}", AXES[a], AXES[b]);
            match (self.place(&name("re")), self.place(&name("im"))) {
                (Some(re), Some(im)) => Ok(Some([re, im])),
                (None, None) => Ok(None),
                (Some(_), None) => Err(fault(1, "", format!("{} without {}", name("re"), name("im")))),
                (None, Some(_)) => Err(fault(1, "", format!("{} without {}", name("im"), name("re")))),
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
        let mut rows: Vec<(f64, Matrix3<Complex<f64>>)> = Vec::new();
        let count = self.rows(MOST_ROWS, |line, number| {
            let hertz = number(frequency, [0.0, 1e5], "a frequency from 0 to 100000 Hz")?;
            if rows.last().is_some_and(|(before, _)| !(*before < hertz)) {
                let told = format!("{hertz} Hz does not lie above the row before; expected rising frequencies");
                return Err(fault(line, "freq_hz", told));
            }
            let mut receptance = Matrix3::zeros();
            for (row, parts) in parts.iter().enumerate() {
                for (column, part) in parts.iter().enumerate() {
                    let Some([re, im]) = *part else { continue };
                    let expected = "at most 0.01 m/N in size; mm/N and um/N are other units";
                    let part = |at| number(at, [-SOFTEST, SOFTEST], expected);
                    receptance[(row, column)] = Complex::new(part(re)?, part(im)?);
                }
            }
            rows.push((hertz, receptance));
            Ok(())
        })?;
        let few = || fault(1, "", format!("{count} rows; expected at least {FEWEST_ROWS} frequencies"));
        let samples = Samples::new(rows).filter(|_| FEWEST_ROWS <= count).ok_or_else(few)?;
        if let Some(axis) = samples.gives_energy().first() {
            let name = format!("g{0}{0}_im", AXES[*axis]);
            let told =
                "more than 0 at the largest answer: a tip that gives energy; expected less than 0, as e^(i w t) has it"
                    .into();
            return Err(fault(1, &name, told));
        }
        Ok(ResponseFile { remarks: self.remarks(&samples, &parts), response: Response::Samples(samples) })
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
