//! From which origin do the words of a place count: work offsets, G52, G92?

use super::super::fault::Wrong;
use super::Reader;
use super::codes::{Meaning, named};
use super::machine::AXES;
use super::words::Block;

/// The origin in force where a file names none.
const FIRST: u16 = 540;

/// A work offset, and the line that names it; 0 where none does.
#[derive(Clone, Copy, Debug)]
pub(super) struct System {
    /// In tenths, or of those with a number behind P 1000 and 2000 more than that.
    number: u16,
    pub(super) line: usize,
}

impl System {
    /// What a code and its block mean.
    ///
    /// # Errors
    /// Where P is no number of an offset.
    fn of(code: u16, block: &Block, line: usize) -> Result<Self, Wrong> {
        let named_by_p = |from: u16| match block.get(b'P') {
            Some(p) if p.fract() == 0.0 && (1.0..=999.0).contains(&p) => Ok(from + p as u16),
            _ => Err(Wrong::new(named('G', code), "which offset is not said; expected a whole number behind P")),
        };
        let number = match code {
            541 => named_by_p(1000)?,
            1540 => named_by_p(2000)?,
            FIRST if block.has(b'P') => named_by_p(1000)?,
            code => code,
        };
        Ok(Self { number, line })
    }

    pub(super) fn name(self) -> String {
        match self.number {
            number @ ..1000 => named('G', number),
            number @ 1000..2000 => format!("G54.1 P{}", number - 1000),
            number => format!("G154 P{}", number - 2000),
        }
    }
}

impl Reader<'_> {
    /// From the program's coordinates to the part's, m.
    pub(super) fn origin(&self) -> [f64; 3] {
        std::array::from_fn(|axis| self.shifts[0][axis] + self.shifts[1][axis])
    }

    /// G54 and its like. The part frame is that of the first one under which the tool moves: where the others lie is not in the file.
    pub(super) fn take_system(&mut self, code: u16, block: &Block, line: usize) -> Result<(), Wrong> {
        let asked = System::of(code, block, line)?;
        let known = self.system.or(self.machine.is_anywhere().then_some(System { number: FIRST, line: 0 }));
        match known {
            Some(known) if known.number == asked.number => self.elsewhere = None,
            Some(known) if self.machine.has_moved => {
                self.system = Some(known);
                self.elsewhere = Some(asked);
                return Ok(());
            }
            // What was said before it counts from elsewhere.
            Some(_) => self.machine.leaves_all(line),
            None => {}
        }
        self.system = Some(self.system.filter(|known| known.number == asked.number).unwrap_or(asked));
        Ok(())
    }

    /// Why a move under another origin than the part's is refused.
    pub(super) fn refused_elsewhere(&self, elsewhere: System) -> Wrong {
        let known = self.system.unwrap_or(System { number: FIRST, line: 0 });
        let since = if known.line == 0 { String::new() } else { format!(" in line {}", known.line) };
        let why = format!(
            "another origin than that of {}{since}; where it lies is not in the file: expected rapid moves only, or one origin",
            known.name()
        );
        Wrong::new(elsewhere.name(), why)
    }

    /// G52 and G92: the program's coordinates are shifted.
    ///
    /// # Errors
    /// Where makers differ in what becomes of one of them under the other.
    pub(super) fn take_shift(
        &mut self,
        (code, meaning): (u16, Meaning),
        block: &Block,
        line: usize,
    ) -> Result<(), Wrong> {
        if let Some(elsewhere) = self.elsewhere {
            return Err(self.refused_elsewhere(elsewhere));
        }
        let name = named('G', code);
        let words = self.words(block);
        match meaning {
            Meaning::SetPosition => {
                self.refuse_both(&words, 1, &name)?;
                for axis in 0..3 {
                    let Some(at) = words[axis] else { continue };
                    if self.machine.is_known(axis) {
                        self.shifts[0][axis] = self.machine.tip[axis] - at;
                    } else if self.machine.has_moved {
                        let why = format!("where {} of the machine lies in the part is not in the file", AXES[axis]);
                        return Err(Wrong::new(name, why));
                    } else {
                        // Nothing was said in other coordinates yet: these are the part's.
                        let place = at + self.origin()[axis];
                        self.machine.is_at(axis, place);
                        let what = format!("the tool is where {name} says along {}", AXES[axis]);
                        self.machine.notes.assume(line, &what);
                    }
                }
            }
            Meaning::ClearPosition(for_good) => {
                if words.iter().flatten().any(|word| *word != 0.0) {
                    return Err(Wrong::new(name, "its words name axes and are 0; expected such as X0 Y0, or none"));
                }
                self.suspended = if for_good { [[0.0; 3]; 2] } else { self.shifts };
                let is_named = words.iter().any(Option::is_some);
                for axis in (0..3).filter(|axis| words[*axis].is_some() || !is_named) {
                    for shift in &mut self.shifts {
                        shift[axis] = 0.0;
                    }
                }
            }
            Meaning::RestorePosition => self.shifts = self.suspended,
            _ => {
                self.refuse_both(&words, 0, &name)?;
                for (shift, word) in self.shifts[1].iter_mut().zip(words) {
                    *shift = word.unwrap_or(*shift);
                }
            }
        }
        Ok(())
    }

    /// A shift along an axis that the other one has shifted already: whether it adds to it or takes its place differs between makers.
    fn refuse_both(&self, words: &[Option<f64>; 3], other: usize, name: &str) -> Result<(), Wrong> {
        match (0..3).find(|axis| words[*axis].is_some() && self.shifts[other][*axis] != 0.0) {
            None => Ok(()),
            Some(axis) => {
                let (axis, other) = (AXES[axis], if other == 0 { "G92" } else { "G52" });
                let why = format!(
                    "{axis} is shifted by {other} already, and makers differ in what both make; expected G92.1 before it"
                );
                Err(Wrong::new(name, why))
            }
        }
    }
}
