//! Subprograms of the same file: M98 and M99 with O numbers, `sub` and `call` of `LinuxCNC` without arguments.

use std::collections::HashMap;
use std::rc::Rc;

use super::super::fault::Wrong;
use super::language::{Language, is_o_word};
use super::words::Block;
use super::{Reader, codes::named};

/// No control calls programs deeper.
const DEEPEST: usize = 10;

/// Lines that calls may run, all in all.
const MOST_LINES: usize = 1 << 20;

/// No program is called more often at once.
const MOST_REPEATS: f64 = 9999.0;

/// A line that is kept to be run later, or again.
#[derive(Debug)]
struct Kept {
    text: Box<[u8]>,
    line: usize,
}

impl Kept {
    fn of(text: &[u8], line: usize) -> Self {
        Self { text: text.into(), line }
    }
}

/// Which program is run how often, and in which line that stands.
#[derive(Clone, Copy, Debug)]
struct Call {
    program: u32,
    repeats: usize,
    line: usize,
}

/// The subprograms of a file, and which of them run.
#[derive(Default)]
pub(super) struct Calls {
    /// The first call, whose program may stand in any line behind it, and all of these.
    kept: Option<(Call, Vec<Kept>)>,
    /// Those between `sub` and `endsub`, by name.
    subs: HashMap<String, Rc<[Kept]>>,
    open: Option<(String, Vec<Kept>)>,
    /// What the last block asks for.
    call: Option<Call>,
    returns: bool,
    depth: usize,
    lines: usize,
    /// There are some.
    pub(super) is_used: bool,
}

impl Calls {
    /// M98: the program that runs when the block is done.
    ///
    /// # Errors
    /// Where P names none, or other words say how.
    pub(super) fn ask(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        let wrong = |why: &str| Wrong::new("M98", why);
        if block.has_any(b"HQ") {
            return Err(wrong("H or Q tell where a program begins; expected P alone, and L for repeats"));
        }
        let number = block.get(b'P').filter(|p| p.fract() == 0.0 && (1.0..1e8).contains(p));
        let number = number.ok_or_else(|| wrong("it names no program; expected such as P1000"))? as u32;
        let repeats = block.get(b'L').unwrap_or(1.0);
        if repeats.fract() != 0.0 || !(1.0..=MOST_REPEATS).contains(&repeats) {
            return Err(wrong("expected a whole number of repeats behind L, from 1 to 9999"));
        }
        self.is_used = true;
        self.call = Some(Call { program: number, repeats: repeats as usize, line });
        Ok(())
    }

    /// M99: back to where the program was called.
    ///
    /// # Errors
    /// Where it jumps elsewhere.
    pub(super) fn give_back(&mut self, block: &Block) -> Result<(), Wrong> {
        if block.has(b'P') {
            return Err(Wrong::new("M99", "it jumps to a block; let the CAM write every move"));
        }
        self.returns = true;
        Ok(())
    }

    /// One more line of a subprogram.
    fn count(&mut self) -> Result<(), Wrong> {
        self.lines += 1;
        if MOST_LINES < self.lines {
            return Err(Wrong::new("M98", format!("subprograms of more than {MOST_LINES} lines in all")));
        }
        Ok(())
    }
}

/// Lines behind the first call, and where the programs in them begin.
struct Programs {
    lines: Vec<Kept>,
    begins: HashMap<u32, usize>,
}

impl Programs {
    fn of(lines: Vec<Kept>) -> Self {
        let mut begins = HashMap::new();
        for (at, kept) in lines.iter().enumerate() {
            if let Some(number) = program_number(&kept.text) {
                begins.entry(number).or_insert(at);
            }
        }
        Self { lines, begins }
    }

    /// Where a program begins, and how often it runs: `P30012` may be program 12 three times.
    fn find(&self, call: Call) -> Option<(usize, usize)> {
        if let Some(at) = self.begins.get(&call.program) {
            return Some((*at, call.repeats));
        }
        let (repeats, number) = (call.program / 10_000, call.program % 10_000);
        let at = self.begins.get(&number).filter(|_| 0 < repeats && call.repeats == 1)?;
        Some((*at, repeats as usize))
    }
}

/// The number of a program that begins in a line.
fn program_number(text: &[u8]) -> Option<u32> {
    if is_o_word_of(text) {
        return None;
    }
    let text = text.trim_ascii_start();
    let digits = text.strip_prefix(b"O").or(text.strip_prefix(b"o")).or(text.strip_prefix(b":"))?.trim_ascii_start();
    let count = digits.iter().take_while(|byte| byte.is_ascii_digit()).count();
    std::str::from_utf8(&digits[..count]).ok()?.parse().ok()
}

impl Reader<'_> {
    /// A line of a file: run, or kept for when all programs are known.
    pub(super) fn run_or_keep(&mut self, text: &[u8], line: usize) -> Result<(), Wrong> {
        if let Some((_, kept)) = &mut self.calls.kept {
            kept.push(Kept::of(text, line));
            return Ok(());
        }
        self.run(text, line)?;
        if let Some(call) = self.calls.call.take() {
            self.calls.kept = Some((call, Vec::new()));
        }
        self.refuse_return()
    }

    /// Runs what was kept.
    ///
    /// # Errors
    /// A program that is not there, or has no end; what is refused in one.
    pub(super) fn run_kept(&mut self) -> Result<(), Wrong> {
        if let Some((name, _)) = &self.calls.open {
            return Err(Wrong::new(format!("O{name}"), "the file ends before its endsub"));
        }
        let Some((call, lines)) = self.calls.kept.take() else { return Ok(()) };
        let programs = Programs::of(lines);
        self.call(call, &programs)?;
        self.follow(&programs, 0, false)
    }

    /// Runs a program as often as it is called.
    fn call(&mut self, call: Call, programs: &Programs) -> Result<(), Wrong> {
        let wrong = |why: &str| Wrong::new(format!("M98 P{}", call.program), why).in_line(call.line);
        let (at, repeats) = programs.find(call).ok_or_else(|| {
            wrong("no program of this number stands behind it in the file; let the CAM write one file with its subprograms, or none")
        })?;
        if self.calls.depth == DEEPEST {
            return Err(wrong("programs call one another more than 10 deep"));
        }
        self.machine.notes.assume(call.line, "subprograms of the file are run where they are called");
        self.calls.depth += 1;
        for _ in 0..repeats {
            self.follow(programs, at + 1, true)?;
        }
        self.calls.depth -= 1;
        Ok(())
    }

    /// Runs lines one after the other: up to M99 in a subprogram, else up to the end of the program.
    fn follow(&mut self, programs: &Programs, from: usize, is_called: bool) -> Result<(), Wrong> {
        for Kept { text, line } in &programs.lines[from..] {
            if self.ended.is_some() {
                return Ok(());
            }
            let here = |wrong: Wrong| wrong.in_line(*line);
            if let Some(number) = program_number(text) {
                let end = if is_called { "M99" } else { "M30" };
                return Err(here(Wrong::new(format!("O{number}"), format!("the program before it has no {end}"))));
            }
            self.calls.count().map_err(here)?;
            self.run(text, *line).map_err(here)?;
            if let Some(call) = self.calls.call.take() {
                self.call(call, programs)?;
            }
            if is_called && std::mem::take(&mut self.calls.returns) {
                return Ok(());
            }
            self.refuse_return().map_err(here)?;
        }
        if is_called && self.ended.is_none() {
            return Err(Wrong::new("M98", "the file ends before the M99 of the program that was called"));
        }
        Ok(())
    }

    /// M99 where nothing was called.
    fn refuse_return(&mut self) -> Result<(), Wrong> {
        if std::mem::take(&mut self.calls.returns) {
            let why = "a jump back makes the program run without end; expected M2 or M30";
            return Err(Wrong::new(named('M', 990), why));
        }
        Ok(())
    }

    /// `O100 sub`, `O100 call` and their like; whether the line was one of them, or stands between `sub` and `endsub`.
    pub(super) fn take_o_word(&mut self, text: &[u8], line: usize) -> Result<bool, Wrong> {
        let is_open = self.calls.open.is_some();
        if !is_open && !matches!(text.trim_ascii_start().first(), Some(b'o' | b'O')) {
            return Ok(false);
        }
        let o_word = is_o_word_of(text).then(|| OWord::of(text));
        let Some((open, lines)) = &mut self.calls.open else {
            return o_word.map_or(Ok(false), |word| self.obey(word, text, line).map(|()| true));
        };
        if o_word.is_some_and(|word| word.what == "ENDSUB" && word.name == *open) {
            let (name, lines) = (std::mem::take(open), std::mem::take(lines));
            self.calls.open = None;
            self.calls.subs.insert(name, lines.into());
        } else {
            lines.push(Kept::of(text, line));
        }
        Ok(true)
    }

    fn obey(&mut self, word: OWord, text: &[u8], line: usize) -> Result<(), Wrong> {
        let whole = String::from_utf8_lossy(text).into_owned();
        self.calls.is_used = true;
        match word.what.as_str() {
            "SUB" => self.calls.open = Some((word.name, Vec::new())),
            "RETURN" if self.calls.depth != 0 => self.calls.returns = true,
            "CALL" => {
                let body = self.calls.subs.get(&word.name).cloned().ok_or_else(|| {
                    Wrong::new(
                        whole.clone(),
                        "this sub does not stand before it in the file; programs of other files are not called",
                    )
                })?;
                if self.calls.depth == DEEPEST {
                    return Err(Wrong::new(whole, "programs call one another more than 10 deep"));
                }
                self.machine.notes.assume(line, "subprograms of the file are run where they are called");
                self.calls.depth += 1;
                for Kept { text, line } in body.iter() {
                    let here = |wrong: Wrong| wrong.in_line(*line);
                    self.calls.count().map_err(here)?;
                    self.run(text, *line).map_err(here)?;
                    if self.calls.call.is_some() {
                        return Err(here(Wrong::new(
                            "M98",
                            "it stands between sub and endsub; expected one kind of calls",
                        )));
                    }
                    if self.ended.is_some() || std::mem::take(&mut self.calls.returns) {
                        break;
                    }
                }
                self.calls.depth -= 1;
            }
            _ => return Err(Wrong::new(whole, Language::LinuxCnc.explained())),
        }
        Ok(())
    }
}

fn is_o_word_of(text: &[u8]) -> bool {
    std::str::from_utf8(text.trim_ascii_start()).is_ok_and(is_o_word)
}

/// `O100 call`: a name, and what is done; with anything behind it, nothing that is known.
struct OWord {
    name: String,
    what: String,
}

impl OWord {
    fn of(text: &[u8]) -> Self {
        let text = String::from_utf8_lossy(text).to_ascii_uppercase();
        let text = text.split([';', '(']).next().unwrap_or_default();
        let text: String = text.chars().filter(|c| !c.is_ascii_whitespace()).collect();
        let behind = text.trim_start_matches('O');
        let ends = if behind.starts_with('<') {
            behind.find('>').map_or(behind.len(), |at| at + 1)
        } else {
            behind.find(|c: char| !c.is_ascii_digit()).unwrap_or(behind.len())
        };
        let (name, what) = behind.split_at(ends);
        Self { name: name.to_owned(), what: what.to_owned() }
    }
}
