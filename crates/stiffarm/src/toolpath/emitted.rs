//! Lines of a file that is written anew: numbers in its unit, ends of lines as it has them.

use super::fault::Wrong;
use super::options::LengthUnit;

/// A line as it stands in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// From 1.
    pub(super) number: usize,
    /// What stands before the text: a byte order mark, or nothing.
    pub(super) mark: &'a [u8],
    /// Without its end.
    pub(super) text: &'a [u8],
    /// Blanks, and what ends the line; nothing at the end of some files.
    pub(super) ending: &'a [u8],
}

/// What ends a line.
#[derive(Clone, Copy, Debug, Default)]
enum End {
    #[default]
    LineFeed,
    Both,
    Return,
}

/// What is written of a file, and how its lines end.
#[derive(Debug, Default)]
pub(super) struct Emitted {
    pub(super) bytes: Vec<u8>,
    /// What ends the lines that are added.
    end: End,
    /// Lines that are not as they were.
    pub(super) changed: usize,
    /// Lines that were not there.
    pub(super) added: usize,
}

impl Emitted {
    /// A line of the file comes: the next ones end as it does.
    pub(super) fn follows(&mut self, line: &Line) {
        self.end = match line.ending {
            [.., b'\r', b'\n'] => End::Both,
            [.., b'\n'] => End::LineFeed,
            [.., b'\r'] => End::Return,
            _ => self.end,
        };
    }

    fn end(&self) -> &'static [u8] {
        match self.end {
            End::LineFeed => b"\n",
            End::Both => b"\r\n",
            End::Return => b"\r",
        }
    }

    /// A line as it is.
    pub(super) fn keep(&mut self, line: &Line) {
        self.bytes.extend_from_slice(line.mark);
        self.bytes.extend_from_slice(line.text);
        self.bytes.extend_from_slice(line.ending);
    }

    /// Some lines in place of one, of which the last ends as it did.
    pub(super) fn replace(&mut self, line: &Line, by: &[Vec<u8>]) {
        let Some((last, before)) = by.split_last() else { return };
        let is_same = before.is_empty() && last == line.text;
        self.changed += usize::from(!is_same);
        self.added += before.len();
        self.bytes.extend_from_slice(line.mark);
        for one in before {
            self.bytes.extend_from_slice(one);
            self.bytes.extend_from_slice(self.end());
        }
        self.bytes.extend_from_slice(last);
        self.bytes.extend_from_slice(line.ending);
    }

    /// A line that was not there.
    pub(super) fn add(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text);
        self.bytes.extend_from_slice(self.end());
        self.added += 1;
    }
}

/// How lengths are written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    /// One of the file's unit, m.
    pub(super) unit: f64,
    decimals: usize,
}

impl Lengths {
    /// In mm to 0.1 um, in inches to 0.25 um.
    pub(super) fn of(unit: LengthUnit) -> Self {
        let decimals = match unit {
            LengthUnit::Millimetre => 4,
            LengthUnit::Inch => 5,
        };
        Self { unit: unit.metres(), decimals }
    }

    /// Of one of a unit in m: decimals to 0.25 um or finer.
    pub(super) fn of_metres(unit: f64) -> Self {
        Self { unit, decimals: (unit / 2.5e-7).log10().ceil().max(0.0) as usize }
    }

    /// Two lengths that are written alike, m.
    pub(super) fn are_alike(&self, a: f64, b: f64) -> bool {
        (a - b).abs() <= 0.5 * self.unit * 0.1_f64.powi(self.decimals as i32)
    }

    /// A length in m as it is written.
    pub(super) fn written(&self, length: f64) -> String {
        number(length / self.unit, self.decimals)
    }
}

/// Decimals of the parts of a tool axis: 0.01 urad.
pub(super) const OF_AXIS: usize = 8;

/// A number with at most so many decimals and a decimal point: without it, some machines read thousandths.
pub(super) fn number(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0') } else { &text };
    let text = match text.strip_suffix('.') {
        Some(whole) => format!("{whole}.0"),
        None if text.contains('.') => text.to_owned(),
        None => format!("{text}.0"),
    };
    if text == "-0.0" { "0.0".into() } else { text }
}

/// A remark in ASCII without the signs that would end it.
pub(super) fn remark(text: &str) -> String {
    let plain = |sign: char| match sign {
        '(' => '[',
        ')' => ']',
        '$' | ';' => ',',
        ' '..='~' => sign,
        _ => '?',
    };
    text.chars().map(plain).collect()
}

/// What was written is read at once, so that it is what a machine makes of it; a word that it refuses is this program's.
pub(super) fn refused_as_written(wrong: Wrong) -> Wrong {
    Wrong { why: format!("as it would be written with corrections: {}", wrong.why), ..wrong }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_a_point_and_lose_what_says_nothing() {
        let found = [15.0, -0.00001, 1.25, -3.00049, 1e-9].map(|x| number(x, 4));
        assert_eq!(found, ["15.0", "0.0", "1.25", "-3.0005", "0.0"]);
        assert_eq!(number(12.0, 0), "12.0");
        let [mm, inch, m] =
            [Lengths::of(LengthUnit::Millimetre), Lengths::of(LengthUnit::Inch), Lengths::of_metres(1.0)];
        assert_eq!(
            [mm.written(0.012_345_6), inch.written(0.0254), m.written(0.012_345_6)],
            ["12.3456", "1.0", "0.0123456"]
        );
        assert!(mm.are_alike(1.0, 1.000_000_04) && !mm.are_alike(1.0, 1.000_000_06));
    }
}
