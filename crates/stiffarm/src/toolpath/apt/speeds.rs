//! Which feed rates and drilling cycles do statements of APT leave in force?

use super::super::fault::{Wrong, shown};
use super::super::options::LengthUnit;
use super::statement::{Part, Statement};
use super::{Cycle, Dialect, Reader};

/// How fast the tool feeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feed {
    /// m/s.
    Steady(f64),
    /// m a turn of the spindle.
    PerTurn(f64),
}

impl Feed {
    /// So many of this.
    fn times(self, number: f64) -> Self {
        match self {
            Self::Steady(one) => Self::Steady(one * number),
            Self::PerTurn(one) => Self::PerTurn(one * number),
        }
    }
}

/// What a cycle says so far, in the file's unit.
#[derive(Clone, Copy, Debug, Default)]
struct Levels {
    above: Option<f64>,
    bottom: Option<f64>,
    retract: Option<f64>,
    feed: Option<Feed>,
}

impl Reader<'_> {
    /// `SPINDL/`: turns a minute, unless it tells the speed of a surface.
    pub(super) fn take_spindle(&mut self, statement: &Statement) {
        let way = statement.words().find_map(|word| match word {
            "CLW" => Some(true),
            "CCLW" => Some(false),
            _ => None,
        });
        self.is_clockwise = way.or(self.is_clockwise);
        let is_of_surface = statement.words().any(|word| matches!(word, "SFM" | "SMM"));
        let turns = statement.first_number().filter(|_| !is_of_surface);
        self.spindle = if is_of_surface { None } else { turns.or(self.spindle) };
    }

    /// The feed rate in force, m/s.
    ///
    /// # Errors
    /// Where there is none, or it is per turn and no turns are given.
    pub(super) fn speed(&self, word: &str) -> Result<f64, Wrong> {
        match (self.feed, self.options.feed) {
            (Some(Feed::Steady(feed)), _) | (None, Some(feed)) => Ok(feed),
            (Some(Feed::PerTurn(feed)), _) => {
                let turns = self.spindle.filter(|turns| 0.0 < *turns);
                let turns = turns.ok_or_else(|| {
                    Wrong::new(
                        word,
                        "a feed rate per turn, and SPINDL tells no turns a minute; expected SPINDL/RPM before it",
                    )
                })?;
                Ok(feed * turns / 60.0)
            }
            (None, None) => {
                Err(Wrong::new(word, "no feed rate: expected FEDRAT before it, or feed-mm-per-min for the file"))
            }
        }
    }

    pub(super) fn take_feed(&mut self, statement: &Statement) -> Result<(), Wrong> {
        let name = &statement.name;
        if statement.words().any(|word| word == "RAPID") {
            self.is_rapid = true;
            return Ok(());
        }
        let number = statement.first_number().filter(|number| 0.0 < *number && *number <= 1e9);
        let number =
            number.ok_or_else(|| Wrong::new(name, "expected a feed rate of more than 0, such as FEDRAT/MMPM,1000"))?;
        let mut unit = Feed::Steady(self.unit.metres() / 60.0);
        for word in statement.words() {
            unit = match self.unit_of_feed(word) {
                Some(unit) => unit,
                None if matches!(word, "DRILL" | "BORE" | "TAP" | "RAPTO" | "FEDTO" | "RTRCTO") => unit,
                None => {
                    let why =
                        format!("'{}' is no unit of feed that is known; expected MMPM, IPM, MMPR or IPR", shown(word));
                    return Err(Wrong::new(name, why));
                }
            };
        }
        self.feed = Some(unit.times(number));
        Ok(())
    }

    /// What one of a unit of feed is.
    fn unit_of_feed(&self, word: &str) -> Option<Feed> {
        let (mm, inch) = (LengthUnit::Millimetre.metres(), LengthUnit::Inch.metres());
        Some(match word {
            "MMPM" => Feed::Steady(mm / 60.0),
            "IPM" => Feed::Steady(inch / 60.0),
            "PERMIN" => Feed::Steady(self.unit.metres() / 60.0),
            "MMPR" => Feed::PerTurn(mm),
            "IPR" => Feed::PerTurn(inch),
            "PERREV" => Feed::PerTurn(self.unit.metres()),
            _ => return None,
        })
    }

    pub(super) fn take_cycle(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let name = &statement.name;
        let mut parts = statement.parts.iter();
        let kind = match parts.next() {
            Some(Part::Word(word)) => word.as_str(),
            _ => return Err(Wrong::new(name, "expected its kind, such as CYCLE/DRILL or CYCLE/OFF")),
        };
        match kind {
            "OFF" => {
                (self.cycle, self.cycle_begun) = (None, None);
                return Ok(());
            }
            // SOLIDWORKS CAM begins cycles so, and says then what they do.
            "INIT" => {
                (self.cycle, self.cycle_begun) = (None, Some(line));
                return Ok(());
            }
            "DRILL" | "BORE" | "TAP" => {}
            "DEEP" | "DEEP2" | "BRKCHP" => self.leave_out_pecks(line),
            _ => {
                let why = format!(
                    "cycle {} is not known; expected DRILL, DEEP, BRKCHP, BORE, TAP or OFF, or moves",
                    shown(kind)
                );
                return Err(Wrong::new(name, why));
            }
        }
        let levels = self.levels(name, parts.as_slice(), line)?;
        let (Some(above), Some(bottom)) = (levels.above, levels.bottom) else {
            return Err(Wrong::new(name, "it does not say how deep; expected RAPTO and FEDTO"));
        };
        let bottom = if self.dialect == Some(Dialect::Solidworks) && 0.0 < bottom {
            self.notes.assume(line, "FEDTO is the depth below the point, as SOLIDWORKS CAM writes it");
            -bottom
        } else {
            bottom
        };
        if !(bottom < 0.0 && bottom < above) {
            return Err(Wrong::new(
                name,
                format!("FEDTO of {bottom}: makers differ in its sign; expected less than 0, below the point"),
            ));
        }
        let unit = self.unit.metres();
        let retract = levels.retract.unwrap_or(above) * unit;
        let feeds_out = matches!(kind, "BORE" | "TAP");
        self.cycle = Some(Cycle { above: above * unit, bottom: bottom * unit, retract, feed: levels.feed, feeds_out });
        self.cycle_begun = None;
        Ok(())
    }

    fn leave_out_pecks(&mut self, line: usize) {
        self.notes.assume(line, "deep drilling feeds down in one: its retracts between pecks are left out");
    }

    /// What the words behind the kind of a cycle say, each with its numbers behind it.
    fn levels(&mut self, name: &str, parts: &[Part], line: usize) -> Result<Levels, Wrong> {
        let mut levels = Levels::default();
        let mut rest = parts;
        while let [Part::Word(word), behind @ ..] = rest {
            let count = behind.iter().take_while(|part| matches!(part, Part::Number(_))).count();
            let number = if let Some(Part::Number(number)) = behind.first() { Some(*number) } else { None };
            let unit = self.unit_of_feed(word);
            match (word.as_str(), number) {
                ("RAPTO" | "CLEAR", Some(number)) if count == 1 => levels.above = Some(number),
                ("FEDTO" | "DEPTH", Some(number)) if count == 1 => levels.bottom = Some(number),
                ("RTRCTO", Some(number)) if count == 1 => levels.retract = Some(number),
                (_, Some(number)) if unit.is_some() && 0.0 < number && count == 1 => {
                    levels.feed = unit.map(|unit| unit.times(number));
                }
                // RTRCTO,AUTO: back to RAPTO.
                ("RTRCTO" | "AUTO" | "MANUAL", None) => {}
                ("DEEP" | "BRKCHP", None) | ("STEP" | "INCR", Some(_)) => self.leave_out_pecks(line),
                ("DWELL" | "REV" | "CAM" | "OPTION", _) => self.notes.ignore(line, &format!("CYCLE: {word}")),
                ("RAPTO" | "CLEAR" | "FEDTO" | "DEPTH" | "RTRCTO", _) => {
                    return Err(Wrong::new(name, format!("expected one number behind {word}")));
                }
                _ => return Err(Wrong::new(name, format!("what {} does is not known", shown(word)))),
            }
            rest = &behind[count..];
        }
        if rest.is_empty() {
            Ok(levels)
        } else {
            Err(Wrong::new(name, "expected RAPTO, FEDTO and RTRCTO, each with a number behind it"))
        }
    }
}
