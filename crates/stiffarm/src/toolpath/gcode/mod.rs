//! G-code (RS-274): blocks of words, what they leave in force, and the moves they mean.
//!
//! Every word is modelled, kept as inert and reported, or refused with its line. Words without blanks, in either case; `( )` and `;`
//! comments; `%`, O and N; modal codes; arcs in three planes by centre (whose reading is found by which one closes) or radius, full
//! circles and helices; G90 and G91; drilling cycles; subprograms of the same file; G28, G30, G53 and rapids under another origin as
//! moves of the machine; tool axes by I J K or by A B C under a convention that the user names. Other languages are refused by name.

mod arcs;
mod calls;
mod codes;
mod cycles;
mod edit;
pub(super) mod language;
mod machine;
mod modal;
mod motion;
mod origins;
pub(super) mod rewrite;
mod sender;
mod words;

use nalgebra::Vector3;

use super::Ending;
use super::closing::Closing;
use super::fault::Wrong;
use super::moves::Move;
use super::options::{ArcCentres, LengthUnit, ReadOptions};
use arcs::{Plane, Reading};
use calls::Calls;
use codes::{Auxiliary, FeedMode, Meaning, Motion, named, of_m};
use cycles::Cycle;
use language::Language;
use machine::Machine;
use origins::System;
use words::{Block, Percent};

/// What is in force, block after block.
#[expect(clippy::struct_excessive_bools, reason = "each is what one code leaves in force")]
pub(super) struct Reader<'a> {
    options: &'a ReadOptions,
    machine: Machine<'a>,
    block: Block,
    unit: LengthUnit,
    unit_is_said: bool,
    unit_is_noted: bool,
    /// The most decimals of lengths so far, in this unit.
    decimals: u8,
    plane: Plane,
    is_incremental: bool,
    reading: Reading,
    motion: Motion,
    /// G0 to G3 as it stood before a cycle, and whether G80 has brought it back.
    lasting: Motion,
    is_resumed: bool,
    feed_mode: FeedMode,
    /// F in the unit in force where it stands, m a minute or a turn, and its line.
    feed: Option<f64>,
    feed_line: usize,
    /// From the program's coordinates to the part's, m: by G92 and by G52.
    shifts: [[f64; 3]; 2],
    suspended: [[f64; 3]; 2],
    /// The origin of the part, where the file names one, and another one that is in force.
    system: Option<System>,
    elsewhere: Option<System>,
    returns_to_r: bool,
    cycle: Option<Cycle>,
    /// The tool axis of all moves but cycles.
    axis: Vector3<f64>,
    has_vectors: bool,
    has_tip_control: bool,
    /// The tip was controlled before, and is no longer.
    has_ended_tip_control: bool,
    angles: [f64; 3],
    letters: [Seen; 26],
    codes: [Vec<Seen>; 2],
    calls: Calls,
    has_words: bool,
    /// The number of the tool that comes next.
    selected: Option<u32>,
    /// Tools are changed by M6.
    changes_by_code: bool,
    /// Nothing is read any more, since this line.
    pub(super) ended: Option<usize>,
    after_end: Seen,
}

/// How often something inert stood in the file, and where first.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    first: usize,
    count: usize,
}

impl Seen {
    fn at(&mut self, line: usize) {
        if self.count == 0 {
            self.first = line;
        }
        self.count += 1;
    }
}

/// What a block asks besides its motion.
#[expect(clippy::struct_excessive_bools, reason = "each is what one code of the block asks")]
#[derive(Clone, Copy, Debug, Default)]
struct Once {
    /// The code that takes the axis words in place of the motion.
    takes: Option<(u16, Meaning)>,
    is_machine: bool,
    /// The words of a place are data: offsets or limits.
    is_data: bool,
    /// It waits, for as long as the number behind this letter says.
    is_dwell: bool,
    time: Option<u8>,
    /// It calls a program.
    is_call: bool,
    has_motion: bool,
}

impl<'a> Reader<'a> {
    pub(super) fn new(options: &'a ReadOptions, sink: &'a mut dyn FnMut(&Move)) -> Self {
        Self {
            options,
            machine: Machine::new(sink),
            block: Block::new(),
            unit: options.unit.unwrap_or(LengthUnit::Millimetre),
            unit_is_said: false,
            unit_is_noted: false,
            decimals: 0,
            plane: Plane::Xy,
            is_incremental: false,
            reading: Reading { said: options.arc_centres, ..Reading::default() },
            motion: Motion::None,
            lasting: Motion::None,
            is_resumed: false,
            feed_mode: FeedMode::PerMinute,
            feed: None,
            feed_line: 0,
            shifts: [[0.0; 3]; 2],
            suspended: [[0.0; 3]; 2],
            system: None,
            elsewhere: None,
            returns_to_r: false,
            cycle: None,
            axis: Vector3::z(),
            has_vectors: false,
            has_tip_control: false,
            has_ended_tip_control: false,
            angles: [0.0; 3],
            letters: [Seen::default(); 26],
            codes: [Vec::new(), Vec::new()],
            calls: Calls::default(),
            has_words: false,
            selected: None,
            changes_by_code: false,
            ended: None,
            after_end: Seen::default(),
        }
    }

    /// Reads a line.
    ///
    /// # Errors
    /// The first word that is refused.
    pub(super) fn line(&mut self, text: &[u8], line: usize) -> Result<(), Wrong> {
        if self.ended.is_some() {
            if !text.is_empty() && text != b"%" {
                self.after_end.at(line);
            }
            return Ok(());
        }
        self.run_or_keep(text, line)
    }

    /// Runs a line.
    fn run(&mut self, text: &[u8], line: usize) -> Result<(), Wrong> {
        if self.take_o_word(text, line)? || self.take_sender(text, line)? {
            return Ok(());
        }
        let mut block = std::mem::replace(&mut self.block, Block::new());
        let outcome = match block.read(text) {
            Ok(()) => self.take(&block, line),
            Err(wrong) => Err(Language::of(text)
                .map_or(wrong, |language| Wrong::new(String::from_utf8_lossy(text), language.explained()))),
        };
        self.block = block;
        outcome
    }

    fn take(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        match block.percent {
            Percent::No => {}
            // The first one opens the program, the next one closes it.
            Percent::Alone => {
                self.ended = self.has_words.then_some(line);
                return Ok(());
            }
            Percent::Numbered if self.has_words => {
                let why = "a number behind %: whether the program ends here is not known; expected % alone";
                return Err(Wrong::new("%", why));
            }
            Percent::Numbered => {
                self.machine.notes.ignore(line, "% (program number)");
                return Ok(());
            }
        }
        if block.is_empty() {
            return Ok(());
        }
        self.has_words = true;
        if block.may_be_skipped {
            self.machine.notes.assume(line, "blocks behind / are run");
        }
        if block.has_number_without_point {
            self.machine.notes.assume(line, "numbers without a decimal point are whole units");
        }
        self.decimals = self.decimals.max(block.decimals);
        let once = self.take_codes(block, line)?;
        self.take_values(block, &once, line)?;
        if let Some((code, meaning)) = once.takes {
            self.take_axes(code, meaning, block, line)?;
        } else if once.is_machine {
            self.machine_move(block, line)?;
        } else if !once.is_data && once.time != Some(b'X') {
            self.take_motion(block, &once, line)?;
        }
        self.keep_letters(block, &once, line);
        let ends = block.m.all().iter().any(|code| of_m(*code) == Auxiliary::End);
        if ends {
            self.ended = Some(line);
        }
        Ok(())
    }

    /// Words that are neither modelled nor refused: reported at the end.
    fn keep_letters(&mut self, block: &Block, once: &Once, line: usize) {
        for letter in block.letters() {
            let is_modelled = match letter {
                letter if once.time == Some(letter) => false,
                b'X'..=b'Z' | b'I'..=b'K' | b'R' => !once.is_data,
                b'F' | b'S' | b'A'..=b'C' => true,
                b'L' => self.cycle.is_some() || once.is_call,
                b'Q' => self.cycle.is_some(),
                b'P' => matches!(self.motion, Motion::Clockwise | Motion::CounterClockwise) || once.is_call,
                _ => false,
            };
            if !is_modelled {
                self.letters[usize::from(letter - b'A')].at(line);
            }
        }
    }

    /// By how much the ends of an arc may miss one radius.
    fn closing(&self) -> Closing {
        let least = if self.unit == LengthUnit::Inch { 3 } else { 2 };
        Closing::of_decimals(self.unit.metres(), self.decimals, least)
    }

    /// What is to be said of the file.
    ///
    /// # Errors
    /// What is refused in the programs that it calls.
    pub(super) fn finish(mut self, line: usize) -> Result<Ending, Wrong> {
        self.run_kept()?;
        let notes = &mut self.machine.notes;
        if let Some(system) = self.system.filter(|system| system.line != 0) {
            notes.assume(system.line, &format!("the part frame is that of {}", system.name()));
        }
        if self.ended.is_none() && self.has_words {
            notes.assume(line, "the program ends with the file, without M2, M30 or %");
        }
        match (self.reading.said, self.reading.found, self.reading.doubtful) {
            (None, Some((ArcCentres::Absolute, first)), _) => {
                notes.assume(first, "I J K of arcs count from the origin: read so, the arcs close");
            }
            (None, None, Some(first)) => {
                notes.assume(first, "I J K of arcs count from their beginning; the arcs close either way");
            }
            _ => {}
        }
        for (letter, seen) in ('A'..='Z').zip(self.letters) {
            if 0 < seen.count {
                notes.ignore_all(seen.first, seen.count, &letter_named(letter));
            }
        }
        for (kind, seen) in ['G', 'M'].into_iter().zip(&self.codes) {
            for (code, seen) in seen.iter().enumerate().filter(|(_, seen)| 0 < seen.count) {
                notes.ignore_all(seen.first, seen.count, &named(kind, code as u16));
            }
        }
        if 0 < self.after_end.count {
            notes.ignore_all(self.after_end.first, self.after_end.count, "lines behind the end of the program");
        }
        Ok(Ending { notes: std::mem::take(notes), apart: self.machine.apart, arc_miss: self.reading.worst })
    }
}

/// A letter and what it usually stands for.
fn letter_named(letter: char) -> String {
    let what = match letter {
        'D' => " (radius offset)",
        'H' => " (length offset)",
        'N' => " (block number)",
        'O' => " (program number)",
        'T' => " (tool)",
        _ => "",
    };
    format!("{letter}{what}")
}
