//! Which feed rates and drilling cycles do statements of APT leave in force?

use super::super::fault::{Wrong, shown};
use super::super::options::LengthUnit;
use super::statement::{Part, Statement};
use super::{Cycle, Reader};

impl Reader<'_> {
    pub(super) fn take_feed(&mut self, statement: &Statement) -> Result<(), Wrong> {
        let name = &statement.name;
        if statement.words().any(|word| word == "RAPID") {
            self.is_rapid = true;
            return Ok(());
        }
        let number = statement.first_number().filter(|number| 0.0 < *number && *number <= 1e9);
        let number =
            number.ok_or_else(|| Wrong::new(name, "expected a feed rate of more than 0, such as FEDRAT/MMPM,1000"))?;
        self.feed = Some(number * self.per_second(statement)?);
        Ok(())
    }

    /// What one of the unit named in a statement is in m/s.
    fn per_second(&self, statement: &Statement) -> Result<f64, Wrong> {
        let (mm, inch) = (LengthUnit::Millimetre.metres(), LengthUnit::Inch.metres());
        let mut factor = self.unit.metres() / 60.0;
        for word in statement.words() {
            let per_turn = || {
                let speed = self.spindle.filter(|speed| 0.0 < *speed);
                speed.ok_or_else(|| Wrong::new(&statement.name, "a feed rate per turn; expected SPINDL before it"))
            };
            factor = match word {
                "MMPM" => mm / 60.0,
                "IPM" => inch / 60.0,
                "PERMIN" => self.unit.metres() / 60.0,
                "MMPR" => mm * per_turn()? / 60.0,
                "IPR" => inch * per_turn()? / 60.0,
                "PERREV" => self.unit.metres() * per_turn()? / 60.0,
                "DRILL" | "BORE" | "TAP" | "RAPTO" | "FEDTO" | "RTRCTO" => factor,
                other => {
                    let why =
                        format!("'{}' is no unit of feed that is known; expected MMPM, IPM, MMPR or IPR", shown(other));
                    return Err(Wrong::new(&statement.name, why));
                }
            };
        }
        Ok(factor)
    }

    pub(super) fn take_cycle(&mut self, statement: &Statement) -> Result<(), Wrong> {
        let name = &statement.name;
        let mut parts = statement.parts.iter();
        let kind = match parts.next() {
            Some(Part::Word(word)) => word.as_str(),
            _ => return Err(Wrong::new(name, "expected its kind, such as CYCLE/DRILL or CYCLE/OFF")),
        };
        if kind == "OFF" {
            self.cycle = None;
            return Ok(());
        }
        if !matches!(kind, "DRILL" | "BORE" | "TAP") {
            let why = format!("cycle {} is not known; expected DRILL, BORE, TAP or OFF, or moves", shown(kind));
            return Err(Wrong::new(name, why));
        }
        let (mut above, mut bottom, mut retract, mut feed) = (None, None, None, None);
        while let Some(part) = parts.next() {
            let number = if let Some(Part::Number(number)) = parts.next() { Some(*number) } else { None };
            let (Part::Word(word), Some(number)) = (part, number) else {
                return Err(Wrong::new(name, "expected RAPTO, FEDTO and RTRCTO, each with a number behind it"));
            };
            match word.as_str() {
                "RAPTO" => above = Some(number),
                "FEDTO" => bottom = Some(number),
                "RTRCTO" => retract = Some(number),
                "MMPM" | "IPM" | "MMPR" | "IPR" if 0.0 < number => feed = Some(number * self.per_second(statement)?),
                other => return Err(Wrong::new(name, format!("what {} does is not known", shown(other)))),
            }
        }
        let (Some(above), Some(bottom)) = (above, bottom) else {
            return Err(Wrong::new(name, "it does not say how deep; expected RAPTO and FEDTO"));
        };
        if !(bottom < 0.0 && bottom < above) {
            return Err(Wrong::new(
                name,
                format!("FEDTO of {bottom}: makers differ in its sign; expected less than 0, below the point"),
            ));
        }
        let unit = self.unit.metres();
        let retract = retract.unwrap_or(above) * unit;
        self.cycle =
            Some(Cycle { above: above * unit, bottom: bottom * unit, retract, feed, feeds_out: kind != "DRILL" });
        Ok(())
    }
}
