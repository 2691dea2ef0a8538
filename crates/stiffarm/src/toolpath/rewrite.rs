//! A file of a toolpath with its feed moves led elsewhere and everything else kept.

use std::cell::RefCell;
use std::io::{BufRead, Write};

use super::corrections::{Corrections, Sink};
use super::emitted::{Emitted, Line};
use super::fault::{PathFault, Wrong};
use super::lines::Lines;
use super::moves::{Move, ToolPose};
use super::options::ReadOptions;
use super::samples::{Sample, Steps};
use super::{Ending, Format, Progress, REPORT, Understood, apt, csv, gcode};
use crate::watch::Stopped;

/// The file that is rewritten.
pub struct Original<'a> {
    /// What stands in it.
    pub input: &'a mut dyn BufRead,
    /// As it is named in messages.
    pub file: &'a str,
    /// How it is written.
    pub format: Format,
    /// What is known besides it.
    pub options: &'a ReadOptions,
}

/// How a file is rewritten.
#[derive(Clone, Copy, Debug)]
pub struct Rewriting<'a> {
    /// How finely moves are sampled; its chord is also how far straight moves may be off an arc, m.
    pub steps: Steps,
    /// How far the straight moves that are written may be off the corrected samples, m, above 0.
    pub straight: f64,
    /// What the head of the file is to say besides; of a table, all that it says.
    pub remarks: &'a [String],
}

/// What was made of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Rewritten {
    /// What was understood of the original.
    pub understood: Understood,
    /// Lines that are not as they were.
    pub changed: usize,
    /// Lines that were not there.
    pub added: usize,
    /// Arcs that became straight moves.
    pub arcs: usize,
    /// Feed moves that stay as they are: those of drilling cycles.
    pub of_cycles: usize,
    /// How far from its place in the original a move that is kept ends, m, at most: a rapid move keeps its words, and what they do
    /// not say stays corrected.
    pub aside: f64,
    /// By how much the tool axis is off where the file cannot say it, rad, at most.
    pub turn_lost: f64,
}

/// Reads a file and writes it line by line with its feed moves through the corrected places: `corrected` is asked for every sample
/// of every move, in the order of [`read`](super::read) and [`samples`](super::samples()); what it answers of rapid moves and of
/// drilling cycles is not written, since these stay as they are. Order, remarks, block numbers, feed rates and ends of lines stay,
/// a move that needs no change stays byte by byte. Arcs become straight moves. From where a rapid move ended, uncorrected, a feed move
/// leads to the corrected beginning of the cut. What is written is read at once, so that moves by
/// differences count from where the machine will really stand.
///
/// # Errors
/// As for reading; where what is needed cannot be said in the file, with its line.
pub fn rewrite(
    original: Original,
    output: &mut dyn Write,
    how: &Rewriting,
    corrected: &mut dyn FnMut(&Sample) -> ToolPose,
    progress: &mut dyn FnMut(Progress) -> Result<(), Stopped>,
) -> Result<Rewritten, PathFault> {
    let Original { input, file, format, options } = original;
    let moves = RefCell::new(Vec::new());
    let mut moved = false;
    let mut sink = |one: &Move| {
        moved = true;
        moves.borrow_mut().push(*one);
    };
    let mut unheard = |_: &Move| {};
    let mut path = Corrections::new(&how.steps, how.straight, corrected);
    let mut emitted = Emitted::default();
    let mut rewriter = Rewriter::new(format, options, how, (&mut sink, &mut unheard));
    let mut lines = Lines::of(input, file);
    while let Some((number, _)) = lines.next()? {
        let [mark, text, ending] = lines.last();
        let line = Line { number, mark, text, ending };
        emitted.follows(&line);
        rewriter.line(&line, &mut emitted, &moves, &mut path).map_err(|wrong| wrong.at(file, number))?;
        send(&mut emitted.bytes, output, file, number)?;
        if number.is_multiple_of(REPORT) {
            progress(Progress { lines: number, bytes: lines.bytes })?;
        }
    }
    let read = lines.number;
    let Ending { notes, apart, arc_miss } =
        rewriter.finish(&mut emitted, read).map_err(|wrong| wrong.at(file, read))?;
    send(&mut emitted.bytes, output, file, read)?;
    output.flush().map_err(|error| PathFault::Output { file: file.into(), line: read, error })?;
    progress(Progress { lines: read, bytes: lines.bytes })?;
    if !moved {
        let why = format!("nothing in it moves the tool; expected a toolpath as {}", format.name());
        return Err(PathFault::Empty { file: file.into(), why });
    }
    let understood =
        Understood { format, lines: read, assumed: notes.assumed(), ignored: notes.ignored(), apart, arc_miss };
    let Emitted { changed, added, .. } = emitted;
    let Corrections { arcs, of_cycles, aside, turn_lost, .. } = path;
    Ok(Rewritten { understood, changed, added, arcs, of_cycles, aside, turn_lost })
}

fn send(bytes: &mut Vec<u8>, output: &mut dyn Write, file: &str, line: usize) -> Result<(), PathFault> {
    output.write_all(bytes).map_err(|error| PathFault::Output { file: file.into(), line, error })?;
    bytes.clear();
    Ok(())
}

/// The rewriter of one format.
enum Rewriter<'a> {
    GCode(Box<gcode::rewrite::Rewriter<'a>>),
    Apt(Box<apt::rewrite::Rewriter<'a>>),
    Csv(Box<csv::rewrite::Rewriter<'a>>),
}

impl<'a> Rewriter<'a> {
    fn new(format: Format, options: &'a ReadOptions, how: &Rewriting, sinks: (Sink<'a>, Sink<'a>)) -> Self {
        let mut head = how.remarks.to_vec();
        let chord = 1e3 * (how.steps.chord + how.straight);
        match format {
            Format::GCode => {
                head.push(format!("Feed moves are corrected. Arcs are straight moves, off by at most {chord:.4} mm"));
                head.push("Rapid moves and drilling cycles are not corrected; from where a rapid move ends a feed move leads to the corrected path".into());
                Self::GCode(Box::new(gcode::rewrite::Rewriter::new(options, head, sinks)))
            }
            Format::Apt => {
                head.push(format!("Feed moves are corrected. Arcs are straight moves, off by at most {chord:.4} mm"));
                head.push("Rapid moves and drilling cycles are not corrected; from where a rapid move ends a feed move leads to the corrected path".into());
                Self::Apt(Box::new(apt::rewrite::Rewriter::new(options, head, sinks)))
            }
            Format::Csv => Self::Csv(Box::new(csv::rewrite::Rewriter::new(options, head, sinks))),
        }
    }

    fn line(
        &mut self,
        line: &Line,
        emitted: &mut Emitted,
        moves: &RefCell<Vec<Move>>,
        path: &mut Corrections,
    ) -> Result<(), Wrong> {
        match self {
            Self::GCode(one) => one.line(line, emitted, moves, path),
            Self::Apt(one) => one.line(line, emitted, moves, path),
            Self::Csv(one) => one.line(line, emitted, moves, path),
        }
    }

    fn finish(self, emitted: &mut Emitted, line: usize) -> Result<Ending, Wrong> {
        match self {
            Self::GCode(one) => one.original.finish(line),
            Self::Apt(one) => one.original.finish(line),
            Self::Csv(mut one) => {
                one.release(emitted)?;
                one.original.finish()
            }
        }
    }
}
