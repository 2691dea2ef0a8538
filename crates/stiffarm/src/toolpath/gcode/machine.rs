//! Where the tool stands, and the moves it makes.

use nalgebra::Vector3;

use super::super::fault::Wrong;
use super::super::moves::{Course, Given, Move, MoveKind, ToolPose};
use super::super::notes::Notes;
use super::super::options::FARTHEST;

/// How well a coordinate of the tool is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Known {
    /// The program has not said it yet.
    Not,
    Yes,
    /// At the machine's home, or at coordinates of the machine, since this line.
    AtMachine(usize),
}

/// Names of the axes.
pub(super) const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// The tool in the part frame, and who takes its moves.
pub(super) struct Machine<'a> {
    /// The tip, m.
    pub(super) tip: Vector3<f64>,
    known: [Known; 3],
    /// The tool axis at the end of the last move.
    pub(super) axis: Vector3<f64>,
    /// That at the end of the next one.
    pub(super) axis_to: Vector3<f64>,
    pub(super) notes: Notes,
    /// Moves that are no part of the path: from where the file does not tell, or by coordinates of the machine.
    pub(super) apart: usize,
    /// Something has moved.
    pub(super) has_moved: bool,
    /// The number of the tool in the spindle.
    pub(super) tool: Option<u32>,
    /// The number of the tool that has moved at a feed rate last.
    pub(super) cut_with: Option<u32>,
    /// Turns of the spindle a minute, more than 0.
    pub(super) spindle: Option<f64>,
    /// Which way it turns, once that is said.
    pub(super) is_clockwise: Option<bool>,
    sink: &'a mut dyn FnMut(&Move),
}

impl<'a> Machine<'a> {
    pub(super) fn new(sink: &'a mut dyn FnMut(&Move)) -> Self {
        Self {
            tip: Vector3::zeros(),
            known: [Known::Not; 3],
            axis: Vector3::z(),
            axis_to: Vector3::z(),
            notes: Notes::default(),
            apart: 0,
            has_moved: false,
            tool: None,
            cut_with: None,
            spindle: None,
            is_clockwise: None,
            sink,
        }
    }

    /// Where the program says that the tool is, without a move.
    pub(super) fn is_at(&mut self, axis: usize, at: f64) {
        self.tip[axis] = at;
        self.known[axis] = Known::Yes;
    }

    pub(super) fn is_known(&self, axis: usize) -> bool {
        self.known[axis] == Known::Yes
    }

    /// Has the program said any coordinate of the tool?
    pub(super) fn is_anywhere(&self) -> bool {
        self.known.contains(&Known::Yes)
    }

    /// All coordinates that were said are the machine's, no longer the part's.
    pub(super) fn leaves_all(&mut self, line: usize) {
        for axis in (0..3).filter(|axis| self.is_known(*axis)).collect::<Vec<_>>() {
            self.leaves(axis, line);
        }
    }

    /// It goes to the machine's home along all axes.
    pub(super) fn leaves_home(&mut self, line: usize) {
        for axis in 0..3 {
            self.leaves(axis, line);
        }
        self.apart += 1;
    }

    /// Is it known where a move through these coordinates, of the axes that are named, leads?
    pub(super) fn is_known_at(&self, words: &[Option<f64>; 3], is_incremental: bool) -> bool {
        (0..3).all(|axis| self.known[axis] == Known::Yes || (words[axis].is_some() && !is_incremental))
    }

    /// The coordinate is the machine's, no longer the part's.
    pub(super) fn leaves(&mut self, axis: usize, line: usize) {
        self.known[axis] = Known::AtMachine(line);
    }

    /// A coordinate that something counts from: where nothing has said it, 0.
    ///
    /// # Errors
    /// Where it is the machine's.
    pub(super) fn counted_from(&mut self, axis: usize, line: usize, word: &str) -> Result<f64, Wrong> {
        match self.known[axis] {
            Known::Yes => {}
            Known::Not => {
                self.notes.assume(line, "the tool starts at 0 along axes that the file has not given");
                self.known[axis] = Known::Yes;
            }
            Known::AtMachine(since) => {
                let axis = AXES[axis];
                let why = format!(
                    "{axis} is where the machine has it since line {since}; expected a rapid move that says {axis} before it"
                );
                return Err(Wrong::new(word, why));
            }
        }
        Ok(self.tip[axis])
    }

    /// A straight move to `to`, where `said` tells which coordinates the program names; from where the tool is not known, a rapid
    /// move is no part of the path, and neither is one at a feed rate at the machine's own height.
    ///
    /// # Errors
    /// Where a feed move begins at the machine's home, or the tip leaves all measure.
    pub(super) fn go(
        &mut self,
        line: usize,
        (kind, word): (MoveKind, &str),
        to: Vector3<f64>,
        said: [bool; 3],
        feed: Option<f64>,
    ) -> Result<(), Wrong> {
        let is_in_the_air = kind == MoveKind::Feed
            && matches!(self.known[2], Known::AtMachine(_))
            && !said[2]
            && (said[0] || said[1])
            && self.axis_to == Vector3::z();
        if is_in_the_air {
            self.notes
                .assume(line, "feed moves along X and Y while Z is the machine's are in the air, no part of the path");
        }
        if (kind == MoveKind::Rapid && self.known != [Known::Yes; 3]) || is_in_the_air {
            check(&to, word)?;
            for axis in (0..3).filter(|axis| said[*axis]) {
                self.is_at(axis, to[axis]);
            }
            self.axis = self.axis_to;
            self.apart += 1;
            return Ok(());
        }
        for axis in 0..3 {
            self.counted_from(axis, line, word)?;
        }
        self.make(line, (kind, word), ToolPose { tip: to, axis: self.axis_to }, Course::Line, feed)
    }

    /// Any move.
    ///
    /// # Errors
    /// Where the tip leaves all measure, or the axis turns right over.
    pub(super) fn make(
        &mut self,
        line: usize,
        (kind, word): (MoveKind, &str),
        to: ToolPose,
        course: Course,
        feed: Option<f64>,
    ) -> Result<(), Wrong> {
        check(&to.tip, word)?;
        let from = ToolPose { tip: self.tip, axis: self.axis };
        if course == Course::Line && from == to {
            return Ok(());
        }
        if from.axis.dot(&to.axis) < -1.0 + 1e-9 {
            return Err(Wrong::new(word, "the tool axis turns right over: no one knows which way round"));
        }
        (self.sink)(&Move {
            line,
            kind,
            from,
            to,
            course,
            feed,
            normals: None,
            given: Given::under(self.tool, self.spindle, self.is_clockwise),
        });
        self.tip = to.tip;
        self.axis = to.axis;
        self.has_moved = true;
        if kind == MoveKind::Feed {
            self.cut_with = self.tool;
        }
        Ok(())
    }
}

/// Of a tip, m.
fn check(tip: &Vector3<f64>, word: &str) -> Result<(), Wrong> {
    match (0..3).find(|axis| !(tip[*axis].abs() <= FARTHEST)) {
        None => Ok(()),
        Some(axis) => {
            let why =
                format!("{} of {} mm; expected at most {} m from the origin", AXES[axis], tip[axis] * 1e3, FARTHEST);
            Err(Wrong::new(word, why))
        }
    }
}
