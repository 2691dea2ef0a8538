//! Where do the axis words of a block lead the tool?

use nalgebra::Vector3;

use super::super::fault::Wrong;
use super::super::moves::{Course, MoveKind, ToolPose};
use super::arcs::Asked;
use super::codes::{FeedMode, Meaning, Motion, named};
use super::cycles::Hole;
use super::modal::TIP;
use super::origins::System;
use super::words::Block;
use super::{Once, Reader};

/// How many turns a helix of one block may have.
const MOST_TURNS: f64 = 10_000.0;

/// The letters that say where to.
const POSITION: [u8; 3] = [b'X', b'Y', b'Z'];

impl Reader<'_> {
    fn lengths(&self, block: &Block, letters: [u8; 3]) -> [Option<f64>; 3] {
        let unit = self.unit.metres();
        letters.map(|letter| block.get(letter).map(|number| number * unit))
    }

    /// X, Y and Z of a block, m.
    pub(super) fn words(&mut self, block: &Block) -> [Option<f64>; 3] {
        let words = self.lengths(block, POSITION);
        if !self.unit_is_said && !self.unit_is_noted && words.iter().flatten().any(|word| *word != 0.0) {
            let by = if self.options.unit.is_some() { "as was said" } else { "since the file names none" };
            self.machine.notes.assume(0, &format!("lengths in {}, {by}", self.unit.name()));
            self.unit_is_noted = true;
        }
        words
    }

    /// Where the axis words of a block lead, and which there are.
    fn target(&mut self, block: &Block, line: usize, word: &str) -> Result<(Vector3<f64>, [bool; 3]), Wrong> {
        let (words, origin) = (self.words(block), self.origin());
        let mut to = self.machine.tip;
        for axis in 0..3 {
            let Some(length) = words[axis] else { continue };
            to[axis] = if self.is_incremental {
                self.machine.counted_from(axis, line, word)? + length
            } else {
                length + origin[axis]
            };
        }
        Ok((to, words.map(|word| word.is_some())))
    }

    /// The motion in force, where a block has words for it.
    pub(super) fn take_motion(&mut self, block: &Block, once: &Once, line: usize) -> Result<(), Wrong> {
        let turns = block.has_any(b"ABC") && self.axis != self.machine.axis;
        let has_position = block.has_any(b"XYZ");
        let has_offsets = block.has_any(b"IJK");
        if !has_position && !has_offsets && !turns && !(block.has(b'R') && matches!(self.motion, Motion::Cycle(_))) {
            return if block.has(b'R') { Err(Wrong::new("R", "it belongs to no arc and no cycle")) } else { Ok(()) };
        }
        if has_position && self.axis != Vector3::z() && self.has_ended_tip_control && !self.has_tip_control {
            self.machine.notes.assume(line, TIP);
        }
        if let Some(elsewhere) = self.elsewhere {
            return self.move_elsewhere(block, elsewhere, line);
        }
        if std::mem::take(&mut self.is_resumed) {
            let goes_on = match self.motion {
                Motion::None | Motion::Cycle(_) => "",
                Motion::Rapid => "G0",
                Motion::Line => "G1",
                Motion::Clockwise => "G2",
                Motion::CounterClockwise => "G3",
            };
            if !goes_on.is_empty() {
                self.machine.notes.assume(line, &format!("behind G80 the motion before it goes on, {goes_on}"));
            }
        }
        match self.motion {
            Motion::None => {
                let letter = block.letters().find(|letter| b"XYZIJKABC".contains(letter)).unwrap_or(b'X');
                let why = "no motion is in force; expected one of G0 to G3 or a cycle before it";
                Err(Wrong::new(char::from(letter), why))
            }
            Motion::Rapid => self.straight(block, (MoveKind::Rapid, "G0"), line),
            Motion::Line => self.straight(block, (MoveKind::Feed, "G1"), line),
            Motion::Clockwise | Motion::CounterClockwise => self.arc(block, line),
            Motion::Cycle(_) => self.drill(block, once, line),
        }
    }

    /// A move under another origin than the part's: the machine's, where it is a rapid one.
    fn move_elsewhere(&mut self, block: &Block, elsewhere: System, line: usize) -> Result<(), Wrong> {
        if self.motion != Motion::Rapid || block.has_any(b"IJKR") {
            return Err(self.refused_elsewhere(elsewhere));
        }
        for (axis, letter) in POSITION.into_iter().enumerate() {
            if block.has(letter) {
                self.machine.leaves(axis, line);
            }
        }
        self.machine.axis = self.axis;
        self.machine.apart += 1;
        let what = format!(
            "rapid moves under {} are the machine's: where its origin lies is not in the file",
            elsewhere.name()
        );
        self.machine.notes.assume(line, &what);
        Ok(())
    }

    fn straight(&mut self, block: &Block, (kind, word): (MoveKind, &'static str), line: usize) -> Result<(), Wrong> {
        if block.get(b'R').is_some_and(|number| number != 0.0) {
            return Err(Wrong::new("R", format!("what it means to {word} differs between makers")));
        }
        if block.has_any(b"IJK") {
            self.take_vector(block, line)?;
        }
        let (to, said) = self.target(block, line, word)?;
        if self.axis != self.machine.axis && !said.contains(&true) {
            self.machine.notes.assume(line, "turns of the tool axis alone take no time");
        }
        self.machine.axis_to = self.axis;
        let feed = match kind {
            MoveKind::Rapid => None,
            MoveKind::Feed => {
                let length = (to - self.machine.tip).norm();
                self.speed(length, word, block)?
            }
        };
        self.machine.go(line, (kind, word), to, said, feed)
    }

    /// The tool axis by I, J and K of a straight move.
    fn take_vector(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        let vector = Vector3::from([b'I', b'J', b'K'].map(|letter| block.get(letter).unwrap_or(0.0)));
        let length = vector.norm();
        if !self.has_vectors {
            if 1e-2 < (length - 1.0).abs() {
                let why = format!(
                    "I J K of a straight move are read as the tool axis, and this one has the length {length:.4}; expected 1"
                );
                return Err(Wrong::new("I J K", why));
            }
            self.machine.notes.assume(line, "I J K of straight moves are the tool axis, X Y Z the tip");
        }
        if !(1e-6 < length) {
            return Err(Wrong::new("I J K", "the tool axis is zero; expected a vector from the tip to the spindle"));
        }
        self.axis = vector / length;
        Ok(())
    }

    /// The feed rate of a move of some length, m/s.
    fn speed(&self, length: f64, word: &str, block: &Block) -> Result<Option<f64>, Wrong> {
        let missing = |what: &str| Wrong::new(word, format!("no feed rate: expected {what}"));
        let positive = |feed: f64| {
            if 0.0 < feed {
                Ok(Some(feed))
            } else {
                Err(Wrong::new(word, "a feed rate of 0: the tool would never arrive; expected F of more than 0"))
            }
        };
        match self.feed_mode {
            FeedMode::PerMinute => match (self.feed, self.options.feed) {
                (Some(feed), _) => positive(feed / 60.0),
                (None, Some(given)) => Ok(Some(given)),
                (None, None) => Err(missing("F in this or an earlier block, or feed-mm-per-min for the file")),
            },
            FeedMode::Inverse => {
                let feed = block.get(b'F').ok_or_else(|| missing("F in every block under G93"))?;
                if length == 0.0 { Ok(None) } else { positive(feed * length / 60.0) }
            }
            FeedMode::PerTurn => {
                let feed = self.feed.ok_or_else(|| missing("F in this or an earlier block"))?;
                let speed = self.machine.spindle.ok_or_else(|| missing("S, since F is per turn under G95"))?;
                positive(feed * speed / 60.0)
            }
        }
    }

    fn arc(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        let is_clockwise = self.motion == Motion::Clockwise;
        let word = if is_clockwise { "G2" } else { "G3" };
        if self.axis != self.machine.axis && block.has_any(b"ABC") {
            return Err(Wrong::new(word, "the tool axis turns during an arc; expected straight moves"));
        }
        for axis in 0..3 {
            self.machine.counted_from(axis, line, word)?;
        }
        let (to, _) = self.target(block, line, word)?;
        let turns = block.get(b'P').unwrap_or(1.0);
        if turns.fract() != 0.0 || !(1.0..=MOST_TURNS).contains(&turns) {
            return Err(Wrong::new(
                format!("P{turns}"),
                format!("expected a whole number of turns from 1 to {MOST_TURNS}"),
            ));
        }
        let asked = Asked {
            from: self.machine.tip,
            to,
            plane: self.plane,
            is_clockwise,
            offsets: self.lengths(block, [b'I', b'J', b'K']),
            radius: block.get(b'R').map(|radius| radius * self.unit.metres()),
            turns,
            origin: self.origin(),
            closing: self.closing(),
        };
        let arc = asked.arc(&mut self.reading, line)?;
        let [a, b, n] = self.plane.axes();
        let around = (to[a] - arc.centre[a]).hypot(to[b] - arc.centre[b]) * arc.angle;
        let feed = self.speed(around.hypot(to[n] - self.machine.tip[n]), word, block)?;
        let pose = ToolPose { tip: to, axis: self.axis };
        self.machine.make(line, (MoveKind::Feed, word), pose, Course::Arc(arc), feed)
    }

    fn drill(&mut self, block: &Block, once: &Once, line: usize) -> Result<(), Wrong> {
        let unit = self.unit.metres();
        let feed = match (self.feed_mode, once.has_motion) {
            (FeedMode::Inverse, _) => {
                return Err(Wrong::new("G93", "inverse time says nothing of a cycle; expected G94"));
            }
            _ if self.feed.is_none() && self.options.feed.is_none() => None,
            _ => self.speed(1.0, "F", block)?,
        };
        let [_, _, n] = self.plane.axes();
        let offsets = self.lengths(block, [b'I', b'J', b'K']);
        let is_boring = self.motion == Motion::Cycle(870);
        // K counts repeats on some machines, where L does on others.
        let repeats = block.get(b'L').or_else(|| block.get(b'K').filter(|_| !is_boring && n == 2));
        if !is_boring && block.has_any(if n == 2 { b"IJ" } else { b"IJK" }) {
            return Err(Wrong::new("I J K", "what they mean to this cycle differs between makers"));
        }
        let hole = Hole {
            plane: self.plane,
            words: self.words(block),
            r: block.get(b'R').map(|r| r * unit),
            q: block.get(b'Q').map(|q| q * unit),
            offsets,
            repeats,
            is_incremental: self.is_incremental,
            returns_to_r: self.returns_to_r,
            origin: self.origin(),
            feed,
            how: self.options.incremental_cycles,
        };
        let Some(mut cycle) = self.cycle else { return Err(Wrong::new("G80", "no cycle is in force")) };
        let outcome = cycle.drill(&hole, &mut self.machine, line);
        self.cycle = Some(cycle);
        outcome
    }

    /// G53: a move by coordinates of the machine, which are not the part's.
    pub(super) fn machine_move(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        if !matches!(self.motion, Motion::Rapid | Motion::Line) {
            return Err(Wrong::new("G53", "expected it with G0 or G1"));
        }
        for (axis, letter) in POSITION.into_iter().enumerate() {
            if block.has(letter) {
                self.machine.leaves(axis, line);
            }
        }
        self.machine.apart += 1;
        Ok(())
    }

    /// A code that takes the axis words in place of the motion.
    pub(super) fn take_axes(&mut self, code: u16, meaning: Meaning, block: &Block, line: usize) -> Result<(), Wrong> {
        let name = named('G', code);
        let words = self.words(block);
        match meaning {
            Meaning::Home => {
                // Through the point that is named, then to the machine's home along the axes that are named, or along all.
                if self.elsewhere.is_none() && self.machine.is_known_at(&words, self.is_incremental) {
                    let (through, said) = self.target(block, line, &name)?;
                    self.machine.axis_to = self.axis;
                    self.machine.go(line, (MoveKind::Rapid, &name), through, said, None)?;
                }
                let is_named = words.iter().any(Option::is_some) || block.has_any(b"ABC");
                for axis in (0..3).filter(|axis| words[*axis].is_some() || !is_named) {
                    self.machine.leaves(axis, line);
                }
                self.machine.apart += 1;
            }
            _ => return self.take_shift((code, meaning), block, line),
        }
        Ok(())
    }
}
