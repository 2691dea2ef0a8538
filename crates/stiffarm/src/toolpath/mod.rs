//! Which way does the tool go, and what does a file of a toolpath say of it? G-code, APT and CLS, CSV, and paths built in.
//!
//! Every word of a file is modelled, kept as inert and reported, or refused with its line: nothing is dropped silently. What a file
//! leaves open (the unit, what arc centres count from, in which sense arcs turn) is found from the file where it can be, reported, and
//! overruled by [`ReadOptions`]. Moves come one by one, in the part frame, arcs exact, so that a file of any length needs no memory;
//! [`samples`] cuts them. SI inside: with the catalogue, `request` and `answer` the only module that knows mm and inches.
//!
//! ```
//! use stiffarm::toolpath::{Format, Move, ReadOptions, Steps, Survey, read};
//!
//! let mut survey = Survey::new(Steps::USUAL);
//! let program = "G21 G90\nG0 X0 Y0 Z5\nG1 Z-2 F200\nX40 F1000\nG3 X50 Y10 I0 J10\nM30\n";
//! let mut each = |one: &Move| survey.add(one);
//! let understood = read(&mut program.as_bytes(), "a.nc", Format::GCode, &ReadOptions::default(), &mut each, &mut |_| Ok(()))?;
//! assert_eq!(survey.arcs, 1);
//! assert!((survey.feed_length - (0.007 + 0.040 + 0.005 * std::f64::consts::PI)).abs() < 1e-12);
//! assert!(understood.ignored.is_empty());
//! # Ok::<(), stiffarm::toolpath::PathFault>(())
//! ```

mod apt;
mod builtin;
mod closing;
mod corrections;
mod csv;
mod emitted;
mod fault;
mod file;
mod gathered;
mod gcode;
mod lines;
mod moves;
mod notes;
mod options;
mod rewrite;
mod samples;
mod survey;

use std::cell::Cell;
use std::io::BufRead;

pub use builtin::Builtin;
pub use fault::PathFault;
pub(crate) use fault::of_line;
pub use file::{ToolpathError, read_toolpath};
pub use gathered::{Gathered, MOST_SAMPLES, TooManySamples};
pub use moves::{Arc, Course, Given, Move, MoveKind, ToolPose};
pub use options::{ArcCentres, ArcSense, CutterCompensation, IncrementalCycles, LengthUnit, ReadOptions, Rotary};
pub use rewrite::{Original, Rewriting, Rewritten, rewrite};
pub use samples::{Sample, Steps, samples};
pub use survey::Survey;

use crate::watch::Stopped;
use gcode::language::Language;
use lines::Lines;

/// How a toolpath is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// RS-274.
    GCode,
    /// APT, and the CLS files of CAM programs.
    Apt,
    /// A table with a header.
    Csv,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::GCode, Self::Apt, Self::Csv];

    /// As it is named.
    pub const fn name(self) -> &'static str {
        match self {
            Self::GCode => "gcode",
            Self::Apt => "apt",
            Self::Csv => "csv",
        }
    }

    /// By the ending of a file's name; `None` where that says nothing.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "nc" | "ngc" | "gcode" | "cnc" | "tap" | "ncc" | "mpf" | "spf" | "ptp" | "eia" | "iso" | "gc" | "din"
            | "min" | "g" => Some(Self::GCode),
            "apt" | "cls" | "clsf" | "cl" | "aptsource" | "apt-source" => Some(Self::Apt),
            "csv" | "tsv" => Some(Self::Csv),
            _ => None,
        }
    }

    /// What a file of this name is by its ending, where that is known and no path is read from it.
    pub fn not_read(name: &str) -> Option<&'static str> {
        let (_, ending) = name.rsplit_once('.')?;
        Some(match ending.to_ascii_lowercase().as_str() {
            "h" | "hnc" => Language::HeidenhainConversational.explained(),
            "i" => Language::HeidenhainIso.explained(),
            "sbp" => Language::OpenSbp.explained(),
            "plt" | "hpgl" => Language::Hpgl.explained(),
            "nci" => "the intermediate file of Mastercam; choose a post of G-code in it",
            "txt" => "text, which may be written in any way; say read-as gcode, apt or csv",
            "step" | "stp" | "stl" | "iges" | "igs" | "dxf" => {
                "a shape and no path of a tool; expected what a CAM program has made of it"
            }
            _ => return None,
        })
    }

    /// The endings that are known, for messages.
    pub const ENDINGS: &'static str = ".nc, .ngc, .gcode, .tap, .cnc, .mpf (G-code), .apt, .cls (APT), .csv";
}

/// What a file says besides its moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Understood {
    /// How it is written.
    pub format: Format,
    /// Lines that were read.
    pub lines: usize,
    /// What the file leaves open and how it was taken, each with the line that came first.
    pub assumed: Vec<String>,
    /// Words that move nothing, each kind once.
    pub ignored: Vec<String>,
    /// Moves that are no part of the path: from where the file does not tell, or by coordinates of the machine.
    pub apart: usize,
    /// By how much the ends of an arc miss one radius at most, m.
    pub arc_miss: f64,
}

impl Understood {
    /// What is to be said of the file beside every answer that rests on it: what was assumed, what was left out and what was ignored.
    pub fn remarks(self) -> Vec<String> {
        let mut remarks = self.assumed;
        if !closing::Closing::default().is_tight(self.arc_miss) {
            remarks.push(format!("the ends of arcs miss one radius by up to {:.4} mm", self.arc_miss * 1e3));
        }
        if 0 < self.apart {
            let what = match self.apart {
                1 => "move to or from where only the machine knows is no part of the path",
                _ => "moves to or from where only the machine knows are no part of the path",
            };
            remarks.push(format!("{} {what}", self.apart));
        }
        if !self.ignored.is_empty() {
            remarks.push(format!("ignored in the file of the path: {}", self.ignored.join(", ")));
        }
        remarks
    }
}

/// How far a file is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Lines so far.
    pub lines: usize,
    /// Bytes so far.
    pub bytes: u64,
}

/// Lines, and moves, between two reports: a line may ask for thousands of moves.
const REPORT: usize = 1 << 14;

/// Reads a toolpath: `each` takes its moves in their order, `progress` is informed now and then how far it is, and may stop it. `file`
/// names it in messages.
///
/// # Errors
/// The first word that is refused, with its line; a file in which nothing moves; [`PathFault::Stopped`] as `progress` says.
pub fn read(
    input: &mut dyn BufRead,
    file: &str,
    format: Format,
    options: &ReadOptions,
    each: &mut dyn FnMut(&Move),
    progress: &mut dyn FnMut(Progress) -> Result<(), Stopped>,
) -> Result<Understood, PathFault> {
    let moves = Cell::new(0_usize);
    let mut sink = |one: &Move| {
        moves.set(moves.get() + 1);
        each(one);
    };
    let mut reported = 0;
    let mut lines = Lines::of(input, file);
    let mut reader = Reader::new(format, options, &mut sink);
    while let Some((number, line)) = lines.next()? {
        reader.line(line, number).map_err(|wrong| wrong.at(file, number))?;
        if number.is_multiple_of(REPORT) || REPORT <= moves.get() - reported {
            reported = moves.get();
            progress(Progress { lines: number, bytes: lines.bytes })?;
        }
    }
    let read = lines.number;
    let Ending { notes, apart, arc_miss } = reader.finish(read).map_err(|wrong| wrong.at(file, read))?;
    progress(Progress { lines: read, bytes: lines.bytes })?;
    if moves.get() == 0 {
        let why = format!("nothing in it moves the tool; expected a toolpath as {}", format.name());
        return Err(PathFault::Empty { file: file.into(), why });
    }
    Ok(Understood { format, lines: read, assumed: notes.assumed(), ignored: notes.ignored(), apart, arc_miss })
}

/// The reader of one format.
enum Reader<'a> {
    GCode(Box<gcode::Reader<'a>>),
    Apt(Box<apt::Reader<'a>>),
    Csv(Box<csv::Reader<'a>>),
}

impl<'a> Reader<'a> {
    fn new(format: Format, options: &'a ReadOptions, sink: &'a mut dyn FnMut(&Move)) -> Self {
        match format {
            Format::GCode => Self::GCode(Box::new(gcode::Reader::new(options, sink))),
            Format::Apt => Self::Apt(Box::new(apt::Reader::new(options, sink))),
            Format::Csv => Self::Csv(Box::new(csv::Reader::new(options, sink))),
        }
    }

    fn line(&mut self, text: &[u8], line: usize) -> Result<(), fault::Wrong> {
        match self {
            Self::GCode(reader) => reader.line(text, line),
            Self::Apt(reader) => reader.line(text, line),
            Self::Csv(reader) => reader.line(text, line),
        }
    }

    fn finish(self, line: usize) -> Result<Ending, fault::Wrong> {
        match self {
            Self::GCode(reader) => reader.finish(line),
            Self::Apt(reader) => reader.finish(line),
            Self::Csv(reader) => reader.finish(),
        }
    }
}

/// What a reader has to say at the end of a file.
#[derive(Debug, Default)]
struct Ending {
    notes: notes::Notes,
    apart: usize,
    arc_miss: f64,
}
