//! What do the codes and values of a block leave in force?

use nalgebra::{Rotation3, Vector3};

use super::super::fault::Wrong;
use super::super::options::{CutterCompensation, LengthUnit, Rotary};
use super::codes::{Auxiliary, FeedMode, Meaning, Motion, named, of_g, of_m};
use super::cycles::Cycle;
use super::language::Language;
use super::words::Block;
use super::{Once, Reader, Seen};

/// Letters that say where to, or about what.
const PLACE: &[u8] = b"XYZIJKR";

/// Two codes of one kind in a block: which of them holds differs between machines.
fn refuse_another(block: &Block, code: u16, meaning: Meaning) -> Result<(), Wrong> {
    let is_of_a_kind = matches!(
        meaning,
        Meaning::Plane(_)
            | Meaning::Unit(_)
            | Meaning::Incremental(_)
            | Meaning::Centres(_)
            | Meaning::Feed(_)
            | Meaning::RetractToR(_)
            | Meaning::System
    );
    let is_another = |other: &&u16| {
        let other = of_g(**other);
        other != meaning && std::mem::discriminant(&other) == std::mem::discriminant(&meaning)
    };
    let is_another_system = |other: &&u16| meaning == Meaning::System && of_g(**other) == meaning && **other != code;
    match block.g.all().iter().find(|other| is_another(other) || is_another_system(other)).filter(|_| is_of_a_kind) {
        None => Ok(()),
        Some(other) => {
            let why = format!("{} stands in the same block; expected one of them", named('G', *other));
            Err(Wrong::new(named('G', code), why))
        }
    }
}

/// G5 with P, G5.1 with Q: how far the control looks ahead. With a place they are splines.
fn take_look_ahead(code: u16, block: &Block) -> Result<(), Wrong> {
    let name = || named('G', code);
    // G5.1 Q1 X0 Y0 Z0 names axes.
    let names_axes =
        code == 51 && block.has(b'Q') && b"XYZ".iter().all(|letter| block.get(*letter).unwrap_or(0.0) == 0.0);
    if block.has_any(b"IJKR") || (block.has_any(b"XYZ") && !names_axes) {
        return Err(Wrong::new(name(), "splines are not modelled; let the CAM write lines and arcs"));
    }
    let is_mode = match code {
        50 => block.get(b'P').is_some_and(|p| [0.0, 1.0, 2.0, 3.0, 10_000.0].contains(&p)),
        _ => block.has(b'Q'),
    };
    if !is_mode || block.has(b'L') {
        let why = "it moves as only the machine knows; expected G5 P10000, G5 P0 or G5.1 with Q for looking ahead";
        return Err(Wrong::new(name(), why));
    }
    Ok(())
}
/// What places mean without tip control, where the tool is tilted.
pub(super) const TIP: &str = "X Y Z are the tip in the part, as under G43.4";

/// The code that changes tools, in tenths.
const CHANGE: u16 = 60;

impl Reader<'_> {
    /// `M6` puts the tool of the last T into the spindle; of a file without it T does.
    fn take_tool(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        if let Some(number) = block.get(b'T') {
            if !(0.0..=f64::from(u32::MAX)).contains(&number) || number.fract() != 0.0 {
                return Err(Wrong::new(format!("T{number}"), "expected a whole number of a tool"));
            }
            self.selected = Some(number as u32);
        }
        let has_change = block.m.all().contains(&CHANGE);
        if let (Some(tool), true, false) = (self.machine.cut_with, has_change, self.changes_by_code) {
            let what = format!("T{tool} alone is taken for a change of tools, as the first M6 comes after it has cut");
            self.machine.notes.assume(line, &what);
        }
        self.changes_by_code |= has_change;
        let is_changed = if self.changes_by_code { has_change } else { block.has(b'T') };
        if is_changed {
            self.machine.tool = self.selected;
        }
        Ok(())
    }

    /// The codes of a block, in the order of RS-274: what they leave in force first.
    pub(super) fn take_codes(&mut self, block: &Block, line: usize) -> Result<Once, Wrong> {
        let mut once = Once::default();
        let (mut motion, mut cancels) = (None, false);
        for &code in block.g.all() {
            let meaning = of_g(code);
            refuse_another(block, code, meaning)?;
            match meaning {
                Meaning::Motion(found) => {
                    if motion.replace(found).is_some_and(|other| other != found) {
                        let why = "two motions in one block; expected one of G0 to G3 and G81 to G89";
                        return Err(Wrong::new(named('G', code), why));
                    }
                }
                Meaning::Cancel => cancels = true,
                _ => self.take_code(code, meaning, block, &mut once, line)?,
            }
        }
        for &code in block.m.all() {
            match of_m(code) {
                Auxiliary::End => {}
                Auxiliary::Call => {
                    self.calls.ask(block, line)?;
                    once.is_call = true;
                }
                Auxiliary::Return => self.calls.give_back(block)?,
                Auxiliary::Turns(is_clockwise) => self.machine.is_clockwise = Some(is_clockwise),
                Auxiliary::Inert => self.inert(1, code, line),
                Auxiliary::Refused(why) => return Err(Wrong::new(named('M', code), why)),
            }
        }
        self.take_cancel(cancels, motion)?;
        self.take_tool(block, line)?;
        if let Some(motion) = motion {
            once.has_motion = true;
            self.begin(motion, line)?;
        }
        self.take_time(block, &mut once, line)?;
        if once.is_data && once.has_motion && block.has_any(PLACE) {
            let why = "the words of this block are offsets or limits, and it asks for a motion, too; expected a block of its own";
            return Err(Wrong::new("X Y Z", why));
        }
        Ok(once)
    }

    /// What one code that is no motion leaves in force.
    fn take_code(
        &mut self,
        code: u16,
        meaning: Meaning,
        block: &Block,
        once: &mut Once,
        line: usize,
    ) -> Result<(), Wrong> {
        let name = || named('G', code);
        let mut is_modelled = true;
        match meaning {
            Meaning::Motion(_) | Meaning::Cancel => {}
            Meaning::Plane(plane) => self.plane = plane,
            Meaning::Unit(unit) => self.take_unit(unit, block, line, &name())?,
            Meaning::Incremental(is_incremental) => self.is_incremental = is_incremental,
            Meaning::Centres(centres) => self.reading.said = Some(centres),
            Meaning::Feed(mode) => {
                if self.feed_mode != mode {
                    self.feed = None;
                }
                self.feed_mode = mode;
            }
            Meaning::RetractToR(to_r) => self.returns_to_r = to_r,
            Meaning::System => self.take_system(code, block, line)?,
            Meaning::Machine => once.is_machine = true,
            Meaning::Home
            | Meaning::SetPosition
            | Meaning::ClearPosition(_)
            | Meaning::RestorePosition
            | Meaning::Shift => {
                if once.takes.replace((code, meaning)).is_some() {
                    return Err(Wrong::new(name(), "two codes of this block take its axis words"));
                }
            }
            Meaning::Compensation => {
                if self.options.cutter_compensation == CutterCompensation::Refuse {
                    return Err(Wrong::new(
                        name(),
                        "cutter compensation: the path is not that of the tool's centre; say cutter-compensation centre to read it as if it were",
                    ));
                }
                let what = format!("{} is not applied: the path is taken for the tool's centre", name());
                self.machine.notes.assume(line, &what);
            }
            Meaning::Vectors(is_on) => {
                self.has_vectors = is_on;
                self.has_tip_control = is_on;
                self.has_ended_tip_control |= !is_on;
                is_modelled = is_on;
            }
            Meaning::TipControl => self.has_tip_control = true,
            Meaning::Data => {
                if self.machine.is_anywhere() {
                    let why = "offsets are written after places were said: where the part then stands is not known";
                    return Err(Wrong::new(name(), why));
                }
                once.is_data = true;
                is_modelled = false;
            }
            Meaning::OwnWords => {
                once.is_data = true;
                is_modelled = false;
            }
            Meaning::LookAhead => {
                take_look_ahead(code, block)?;
                once.is_data = true;
                is_modelled = false;
            }
            Meaning::Dwell => {
                once.is_dwell = true;
                is_modelled = false;
            }
            Meaning::Inert if code == 150 && block.has(b'H') => {
                return Err(Wrong::new("G15 H", Language::Okuma.explained()));
            }
            Meaning::InertAlone(why) if block.has_any(PLACE) => return Err(Wrong::new(name(), why)),
            Meaning::Inert | Meaning::InertAlone(_) => is_modelled = false,
            Meaning::Refused(why) => return Err(Wrong::new(name(), why)),
        }
        if !is_modelled {
            self.inert(0, code, line);
        }
        Ok(())
    }

    /// G80: no cycle any more; what was in force before it goes on, as on controls on which cycles are a group of their own.
    fn take_cancel(&mut self, cancels: bool, motion: Option<Motion>) -> Result<(), Wrong> {
        if !cancels {
            return Ok(());
        }
        if let Some(Motion::Cycle(code)) = motion {
            let why = format!("{} stands in the same block; expected one of them", named('G', code));
            return Err(Wrong::new("G80", why));
        }
        self.cycle = None;
        if self.motion != self.lasting || self.motion == Motion::None {
            self.motion = self.lasting;
            self.is_resumed = true;
        }
        Ok(())
    }

    /// A motion is in force from here on.
    fn begin(&mut self, motion: Motion, line: usize) -> Result<(), Wrong> {
        self.cycle = if let Motion::Cycle(code) = motion {
            let [_, _, n] = self.plane.axes();
            let initial = self.machine.counted_from(n, line, &named('G', code))?;
            Some(Cycle::begun(code, initial, self.cycle))
        } else {
            self.lasting = motion;
            None
        };
        self.motion = motion;
        self.is_resumed = false;
        Ok(())
    }

    /// How long G4 waits: which letter of its block says it.
    fn take_time(&mut self, block: &Block, once: &mut Once, line: usize) -> Result<(), Wrong> {
        if !once.is_dwell {
            return Ok(());
        }
        let has_place = block.has_any(PLACE) || block.has_any(b"ABC");
        if block.has(b'P') {
            once.time = Some(b'P');
            if has_place {
                if !matches!(self.motion, Motion::Rapid | Motion::Line) {
                    let why =
                        "it waits in a block of an arc or a cycle, to which P is no time; expected a block of its own";
                    return Err(Wrong::new("G4", why));
                }
                self.machine.notes.assume(line, "a block with G4 P and a place waits, and then moves");
            }
            return Ok(());
        }
        once.time = [b'X', b'U', b'F', b'S'].into_iter().find(|letter| block.has(*letter));
        let others = if once.time == Some(b'X') { &b"YZIJKRABC"[..] } else { b"XYZIJKRABC" };
        if block.has_any(others) || (once.has_motion && once.time.is_some()) {
            let why =
                "what its words are, a time or a place, differs between machines; expected G4 in a block of its own";
            return Err(Wrong::new("G4", why));
        }
        Ok(())
    }

    fn inert(&mut self, kind: usize, code: u16, line: usize) {
        let seen = &mut self.codes[kind];
        if seen.len() <= usize::from(code) {
            seen.resize(usize::from(code) + 1, Seen::default());
        }
        seen[usize::from(code)].at(line);
    }

    fn take_unit(&mut self, unit: LengthUnit, block: &Block, line: usize, name: &str) -> Result<(), Wrong> {
        if matches!(name, "G70" | "G71") && block.has_any(b"IJLPQ") {
            return Err(Wrong::new(
                name,
                "with these words it is a cycle of holes or of lathes, and no unit; let the CAM write the moves",
            ));
        }
        if let Some(instead) = unit.instead_of(self.options.unit) {
            self.machine.notes.assume(line, &instead);
        }
        if self.unit != unit {
            let (old, new) = (self.unit.name(), unit.name());
            let notes = &mut self.machine.notes;
            if self.machine.has_moved {
                notes.assume(line, &format!("the unit changes from {old} to {new}: places stay where they are"));
            } else if self.unit_is_said {
                notes.assume(line, "the unit that is said last holds");
            }
            if block.has(b'F') && self.feed_mode != FeedMode::Inverse {
                let what = format!("F in one block with {name} is in {new}; to some machines it would be in {old}");
                notes.assume(line, &what);
            } else if self.feed.is_some() {
                notes
                    .assume(self.feed_line, &format!("F before {name} is in {old}, the unit in force where it stands"));
            }
            (self.unit, self.decimals) = (unit, block.decimals);
        }
        self.unit_is_said = true;
        Ok(())
    }

    /// F, S and the angles.
    pub(super) fn take_values(&mut self, block: &Block, once: &Once, line: usize) -> Result<(), Wrong> {
        let is_time = |letter: u8| once.time == Some(letter);
        // To M66 it is how an input is waited for.
        let has_l = self.cycle.is_some() || once.is_data || once.is_call || block.m.all().contains(&660);
        if let Some(number) = block.get(b'L').filter(|_| !has_l) {
            let why = "there is nothing to repeat, it belongs to no arc and no cycle; to Siemens it calls a program: let the CAM write every move";
            return Err(Wrong::new(format!("L{number}"), why));
        }
        for letter in [b'U', b'V', b'W'].into_iter().filter(|letter| !is_time(*letter)) {
            if block.get(letter).is_some_and(|number| number != 0.0) {
                return Err(Wrong::new(char::from(letter), "a further axis: which way it moves the tool is not known"));
            }
        }
        if let Some(feed) = block.get(b'F').filter(|_| !is_time(b'F')) {
            if !(0.0 <= feed) {
                return Err(Wrong::new(format!("F{feed}"), "expected a feed rate of more than 0"));
            }
            (self.feed, self.feed_line) = (Some(feed * self.unit.metres()), line);
        }
        if let Some(speed) = block.get(b'S').filter(|_| !is_time(b'S')) {
            self.machine.spindle = Some(speed).filter(|speed| 0.0 < *speed);
        }
        let mut has_turned = false;
        for (i, letter) in [b'A', b'B', b'C'].into_iter().enumerate() {
            let Some(number) = block.get(letter) else { continue };
            let angle = if self.is_incremental { self.angles[i] + number } else { number };
            let used = match self.options.rotary {
                None => false,
                Some(Rotary::HeadAc | Rotary::TableAc) => letter != b'B',
                Some(Rotary::HeadBc | Rotary::TableBc) => letter != b'A',
            };
            if !used && angle != 0.0 {
                let why = match self.options.rotary {
                    None => "what it turns is not in the file; say rotary head-ac, head-bc, table-ac or table-bc",
                    Some(_) => "the machine that was named has no such axis",
                };
                return Err(Wrong::new(format!("{}{number}", char::from(letter)), why));
            }
            if used {
                self.angles[i] = angle;
                has_turned = true;
            } else {
                self.letters[usize::from(letter - b'A')].at(line);
            }
        }
        if has_turned {
            self.axis = self.turned_axis();
            if !self.has_tip_control && self.angles.iter().any(|angle| *angle != 0.0) {
                self.machine.notes.assume(line, TIP);
            }
        }
        Ok(())
    }

    /// The tool axis of the angles A, B and C.
    fn turned_axis(&self) -> Vector3<f64> {
        let [a, b, c] = self.angles.map(f64::to_radians);
        let about = |axis: Vector3<f64>, angle: f64| Rotation3::from_scaled_axis(axis * angle);
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        match self.options.rotary {
            None => z,
            Some(Rotary::HeadAc) => about(z, c) * about(x, a) * z,
            Some(Rotary::HeadBc) => about(z, c) * about(y, b) * z,
            Some(Rotary::TableAc) => about(z, -c) * about(x, -a) * z,
            Some(Rotary::TableBc) => about(z, -c) * about(y, -b) * z,
        }
    }
}
