//! G-code with its feed moves led elsewhere: words are changed where they stand, blocks are added where one move becomes several.

use std::cell::RefCell;

use nalgebra::Vector3;

use super::super::corrections::{Corrections, Place, Sink, between};
use super::super::emitted::{Emitted, Lengths, Line, OF_AXIS, number, refused_as_written, remark};
use super::super::fault::Wrong;
use super::super::moves::{Course, Move, MoveKind, ToolPose};
use super::super::options::{ReadOptions, Rotary};
use super::Reader;
use super::codes::{FeedMode, Meaning, Motion, of_g};
use super::edit::{Edit, Fate};
use super::words::Percent;

/// M codes that act when the block's motion is over: stops, ends, and what machines switch off then.
const AFTER_THE_MOTION: [f64; 7] = [0.0, 1.0, 2.0, 5.0, 9.0, 30.0, 60.0];

/// Decimals of A, B and C in deg: a tenth of a urad.
const OF_ANGLE: usize = 5;

/// Decimals of F under G93, moves a minute.
const OF_INVERSE: usize = 6;

/// A tool axis that is off by less, rad, is the one that is meant.
const SAME_AXIS: f64 = 1e-8;

/// Two places no farther apart, m, are one.
const SAME_PLACE: f64 = 1e-7;

/// The file as it is, and as it is written.
pub(in super::super) struct Rewriter<'a> {
    pub(in super::super) original: Reader<'a>,
    /// Reads what is written: where the machine will stand.
    written: Reader<'a>,
    /// What is still to be said at the head.
    head: Vec<String>,
    /// Straight moves have said a tool axis by I J K.
    has_vectors: bool,
    /// Where the tool stood before the block, as the file is.
    before: Vector3<f64>,
}

impl<'a> Rewriter<'a> {
    pub(in super::super) fn new(
        options: &'a ReadOptions,
        head: Vec<String>,
        (sink, unheard): (Sink<'a>, Sink<'a>),
    ) -> Self {
        let (original, written) = (Reader::new(options, sink), Reader::new(options, unheard));
        Self { original, written, head, has_vectors: false, before: Vector3::zeros() }
    }

    /// Reads a line, and writes what becomes of it.
    ///
    /// # Errors
    /// A word that is refused, or a block that cannot be led elsewhere.
    pub(in super::super) fn line(
        &mut self,
        line: &Line,
        emitted: &mut Emitted,
        moves: &RefCell<Vec<Move>>,
        path: &mut Corrections,
    ) -> Result<(), Wrong> {
        let is_over = self.original.ended.is_some();
        self.before = self.original.machine.tip;
        let apart = self.original.machine.apart;
        self.original.line(line.text, line.number)?;
        if self.original.calls.is_used {
            let why = "a line of a subprogram may stand for several moves, which are not corrected alike; let the CAM write every move, or write a robot program";
            return Err(Wrong::new("M98", why));
        }
        if is_over {
            emitted.keep(line);
            return Ok(());
        }
        let opens = line.text.is_empty() || self.original.block.percent != Percent::No || self.original.block.has(b'O');
        if !opens {
            for text in self.head.drain(..) {
                emitted.add(format!("({})", remark(&text)).as_bytes());
            }
        }
        let moves = moves.take();
        let blocks = match moves[..] {
            [one] if one.kind == MoveKind::Feed && self.is_motion() => Some(self.led(line, &one, path)?),
            [] if self.is_motion() && self.stays() && apart == self.original.machine.apart => Some(self.held(line)?),
            // Words that a rapid move or a cycle leaves out would keep what was corrected before.
            [one] if one.kind == MoveKind::Rapid && self.is_across() => {
                path.skip(&one);
                Some(vec![self.restored(line, &[0, 1, 2])?])
            }
            [_, ..] if self.is_hole() => {
                for one in &moves {
                    path.skip(one);
                }
                Some(vec![self.restored(line, &[0, 1])?])
            }
            _ => None,
        };
        if let Some(blocks) = blocks {
            emitted.replace(line, &blocks);
        } else {
            self.kept(line, &moves, path)?;
            emitted.keep(line);
        }
        Ok(())
    }

    /// The block asks for a straight move or an arc at a feed rate.
    fn is_motion(&self) -> bool {
        matches!(self.original.motion, Motion::Line | Motion::Clockwise | Motion::CounterClockwise) && self.is_plain()
    }

    /// It asks for a rapid move across, from where something was corrected. One that only rises stays: it would be led aside in the work.
    fn is_across(&self) -> bool {
        self.original.motion == Motion::Rapid
            && self.is_plain()
            && self.original.block.has_any(b"XY")
            && self.is_aside(&[0, 1, 2])
    }

    /// It asks for a hole, beside which the tool would stand.
    fn is_hole(&self) -> bool {
        matches!(self.original.motion, Motion::Cycle(_))
            && !self.original.is_incremental
            && self.is_plain()
            && self.is_aside(&[0, 1])
    }

    /// Some axis that the block leaves out, or counts from where the tool stands, would end beside its place.
    fn is_aside(&self, axes: &[usize]) -> bool {
        let lengths = Lengths::of(self.original.unit);
        let (place, original) = (&self.written.machine.tip, &self.original.machine.tip);
        axes.iter().any(|&axis| {
            let is_said = self.original.block.has(b'X' + axis as u8) && !self.original.is_incremental;
            let before = if self.original.is_incremental { self.before[axis] } else { original[axis] };
            !is_said && !lengths.are_alike(place[axis], before)
        })
    }

    /// The block with all of these axes named, so that it ends where it did.
    fn restored(&mut self, line: &Line, axes: &[usize]) -> Result<Vec<u8>, Wrong> {
        let mut edit = Edit::of(line)?;
        let lengths = Lengths::of(self.original.unit);
        let pose = ToolPose { tip: self.original.machine.tip, axis: self.original.machine.axis };
        let place = Place { pose, share: 1.0 };
        for &axis in axes {
            let letter = b'X' + axis as u8;
            let wanted = self.counted(&place, axis);
            let stands = self.original.block.get(letter).map(|number| number * lengths.unit);
            let is_said = match stands {
                Some(stands) => lengths.are_alike(stands, wanted),
                None => lengths.are_alike(self.written.machine.tip[axis], pose.tip[axis]),
            };
            if !is_said {
                edit.set(letter, lengths.written(wanted));
            }
        }
        self.write(edit.bytes(), line)
    }

    /// It says nothing that takes words of its own.
    fn is_plain(&self) -> bool {
        let block = &self.original.block;
        let takes_words = |code: &u16| {
            matches!(
                of_g(*code),
                Meaning::Home
                    | Meaning::SetPosition
                    | Meaning::ClearPosition(_)
                    | Meaning::RestorePosition
                    | Meaning::Shift
                    | Meaning::Machine
                    | Meaning::Data
                    | Meaning::OwnWords
                    | Meaning::LookAhead
                    | Meaning::Dwell
            )
        };
        !block.g.all().iter().any(takes_words)
    }

    /// It names the place at which the tool stands already: where that was corrected, the words must be, too.
    fn stays(&self) -> bool {
        !self.original.is_incremental
            && self.original.block.has_any(b"XYZ")
            && self.original.machine.tip != self.written.machine.tip
    }

    fn standing(&self) -> ToolPose {
        ToolPose { tip: self.written.machine.tip, axis: self.written.machine.axis }
    }

    /// A line that stays as it is.
    fn kept(&mut self, line: &Line, moves: &[Move], path: &mut Corrections) -> Result<(), Wrong> {
        if let (Some(first), Motion::Cycle(_), true) =
            (moves.first(), self.original.motion, self.original.is_incremental)
        {
            let aside = (self.written.machine.tip - first.from.tip).norm();
            if SAME_PLACE < aside {
                let why = format!(
                    "a drilling cycle under G91 counts from a place that was corrected by {:.4} mm; expected G90, or a rapid move under G90 before it",
                    aside * 1e3
                );
                return Err(Wrong::new("G91", why));
            }
        }
        for one in moves {
            path.skip(one);
        }
        self.written.line(line.text, line.number).map_err(refused_as_written)?;
        if !moves.is_empty() {
            path.aside = path.aside.max((self.written.machine.tip - self.original.machine.tip).norm());
        }
        Ok(())
    }

    fn held(&mut self, line: &Line) -> Result<Vec<Vec<u8>>, Wrong> {
        let place = Place { pose: self.standing(), share: 1.0 };
        Ok(vec![self.block(line, &place, None)?])
    }

    /// The blocks through the places of a feed move.
    fn led(&mut self, line: &Line, one: &Move, path: &mut Corrections) -> Result<Vec<Vec<u8>>, Wrong> {
        let block = &self.original.block;
        let is_straight = one.course == Course::Line;
        self.has_vectors |= is_straight && block.has_any(b"IJK");
        let start = self.standing();
        let mut places = path.through(one, |_| start, self.has_vectors);
        let Some(last) = places.pop() else { return Err(Wrong::new("the line", "a move without an end")) };
        let angles = self.written.angles;
        if places.is_empty() {
            let only = self.block(line, &last, Some(one))?;
            self.tell_turn(&last, path);
            return Ok(vec![only]);
        }
        let mut blocks = Vec::new();
        let first = places[0];
        let (edit, later) = self.first_of_many(line, &first, one, angles)?;
        blocks.push(self.write(edit.bytes(), line)?);
        self.tell_turn(&first, path);
        for place in &places[1..] {
            let words = self.words_to(place, one, angles);
            if !words.is_empty() {
                blocks.push(self.write(self.further(line, &words), line)?);
                self.tell_turn(place, path);
            }
        }
        let mut words = self.words_to(&last, one, angles);
        words.extend(later);
        if !words.is_empty() {
            blocks.push(self.write(self.further(line, &words), line)?);
        }
        self.tell_turn(&last, path);
        Ok(blocks)
    }

    /// The whole block, led to one place.
    fn block(&mut self, line: &Line, place: &Place, one: Option<&Move>) -> Result<Vec<u8>, Wrong> {
        let mut edit = Edit::of(line)?;
        self.make_straight(&mut edit);
        self.lead(&mut edit, place, one);
        self.write(edit.bytes(), line)
    }

    /// The block itself, led to the first of several places, and its words that belong behind the last one.
    fn first_of_many<'l>(
        &self,
        line: &Line<'l>,
        place: &Place,
        one: &Move,
        angles: [f64; 3],
    ) -> Result<(Edit<'l>, Vec<String>), Wrong> {
        let mut edit = Edit::of(line)?;
        self.make_straight(&mut edit);
        let mut later = Vec::new();
        for (word, fate) in &mut edit.words {
            let is_later = match word.letter {
                b'M' => AFTER_THE_MOTION.contains(&word.number),
                // Exact stop in this block.
                b'G' => word.number == 9.0,
                _ => false,
            };
            if is_later {
                later.push(String::from_utf8_lossy(&line.text[word.span.clone()]).into_owned());
                *fate = Fate::Dropped;
            }
        }
        self.lead(&mut edit, place, Some(one));
        for (i, angle) in self.turned(place, angles) {
            edit.set(b'A' + i as u8, angle);
        }
        if self.original.feed_mode == FeedMode::Inverse {
            edit.set(b'F', self.inverse(place, one));
        }
        Ok((edit, later))
    }

    /// G1 in place of an arc, and where what is written leaves another motion in force.
    fn make_straight(&self, edit: &mut Edit) {
        let is_arc = self.original.motion != Motion::Line;
        let mut has_motion = false;
        for (word, fate) in &mut edit.words {
            let tenths = (word.number * 10.0).round() as u16;
            match (word.letter, of_g(tenths)) {
                (b'G', Meaning::Motion(motion)) => {
                    has_motion = true;
                    if motion != Motion::Line {
                        *fate = Fate::Number("1".into());
                    }
                }
                (b'I' | b'J' | b'K' | b'R' | b'P', _) if is_arc => *fate = Fate::Dropped,
                _ => {}
            }
        }
        if !has_motion && self.written.motion != Motion::Line {
            edit.new.push("G1".into());
        }
    }

    /// X, Y, Z, and I, J, K of a place into the block.
    fn lead(&self, edit: &mut Edit, place: &Place, one: Option<&Move>) {
        let lengths = Lengths::of(self.original.unit);
        for (axis, letter) in (b'X'..=b'Z').enumerate() {
            let wanted = self.counted(place, axis);
            let stands = self.original.block.get(letter).map(|number| number * lengths.unit);
            // A word that is not there leaves the tool where it is.
            let is_said = match stands {
                Some(stands) => lengths.are_alike(stands, wanted),
                None => lengths.are_alike(self.written.machine.tip[axis], place.pose.tip[axis]),
            };
            if !is_said {
                edit.set(letter, lengths.written(wanted));
            }
        }
        let is_straight = one.is_some_and(|one| one.course == Course::Line);
        if is_straight && self.has_vectors {
            let block = &self.original.block;
            let of_block = block.has_any(b"IJK");
            let stands = if of_block { self.original.axis } else { self.written.machine.axis };
            if SAME_AXIS < between(&ToolPose { axis: stands, ..place.pose }, &place.pose) {
                for (letter, part) in (b'I'..=b'K').zip(place.pose.axis.iter()) {
                    edit.set(letter, number(*part, OF_AXIS));
                }
            }
        }
    }

    /// A coordinate of a place as the program counts it, m.
    fn counted(&self, place: &Place, axis: usize) -> f64 {
        let from = if self.original.is_incremental {
            self.written.machine.tip[axis]
        } else {
            self.written.shifts[0][axis] + self.written.shifts[1][axis]
        };
        place.pose.tip[axis] - from
    }

    /// The words of a block that leads on to a place.
    fn words_to(&self, place: &Place, one: &Move, angles: [f64; 3]) -> Vec<String> {
        let lengths = Lengths::of(self.original.unit);
        let mut words = Vec::new();
        for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            if !lengths.are_alike(self.written.machine.tip[axis], place.pose.tip[axis]) {
                words.push(format!("{letter}{}", lengths.written(self.counted(place, axis))));
            }
        }
        if self.has_vectors && SAME_AXIS < between(&self.standing(), &place.pose) {
            let parts = ['I', 'J', 'K'].into_iter().zip(place.pose.axis.iter());
            words.extend(parts.map(|(letter, part)| format!("{letter}{}", number(*part, OF_AXIS))));
        }
        let turned = self.turned(place, angles);
        words.extend(turned.into_iter().map(|(i, angle)| format!("{}{angle}", ['A', 'B', 'C'][i])));
        if self.original.feed_mode == FeedMode::Inverse && !words.is_empty() {
            words.push(format!("F{}", self.inverse(place, one)));
        }
        words
    }

    /// A, B and C where the block turns them, at a share of its way; `before` are those at its beginning.
    fn turned(&self, place: &Place, before: [f64; 3]) -> Vec<(usize, String)> {
        let letters: &[usize] = match self.original.options.rotary {
            None => &[],
            Some(Rotary::HeadAc | Rotary::TableAc) => &[0, 2],
            Some(Rotary::HeadBc | Rotary::TableBc) => &[1, 2],
        };
        let asked = letters.iter().filter(|i| self.original.block.has(b'A' + **i as u8));
        asked
            .map(|&i| {
                let angle = before[i] + place.share * (self.original.angles[i] - before[i]);
                let from = if self.original.is_incremental { self.written.angles[i] } else { 0.0 };
                (i, number(angle - from, OF_ANGLE))
            })
            .collect()
    }

    /// F under G93 that keeps the speed of the move on the way to a place.
    fn inverse(&self, place: &Place, one: &Move) -> String {
        let length = (place.pose.tip - self.written.machine.tip).norm();
        // A turn of the axis alone keeps the F of the block.
        let block = self.original.block.get(b'F');
        let rate = one.feed.filter(|_| 0.0 < length).map(|feed| feed * 60.0 / length).or(block);
        rate.map_or_else(String::new, |rate| number(rate, OF_INVERSE))
    }

    /// A block that was not in the file; what may be skipped, may be skipped whole.
    fn further(&self, line: &Line, words: &[String]) -> Vec<u8> {
        let skip = if self.original.block.may_be_skipped {
            let digit = line.text.iter().skip_while(|byte| **byte != b'/').nth(1).filter(|byte| byte.is_ascii_digit());
            digit.map_or_else(|| "/ ".to_owned(), |digit| format!("/{} ", char::from(*digit)))
        } else {
            String::new()
        };
        format!("{skip}{}", words.join(" ")).into_bytes()
    }

    fn write(&mut self, text: Vec<u8>, line: &Line) -> Result<Vec<u8>, Wrong> {
        self.written.line(&text, line.number).map_err(refused_as_written)?;
        Ok(text)
    }

    fn tell_turn(&self, place: &Place, path: &mut Corrections) {
        path.turn_lost = path.turn_lost.max(between(&self.standing(), &place.pose));
    }
}
