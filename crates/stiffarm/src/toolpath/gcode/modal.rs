//! What do the codes and values of a block leave in force?

use nalgebra::{Rotation3, Vector3};

use super::super::fault::Wrong;
use super::super::options::{CutterCompensation, LengthUnit, Rotary};
use super::codes::{Auxiliary, Meaning, Motion, named, of_g, of_m};
use super::cycles::Cycle;
use super::words::Block;
use super::{Once, Reader, Seen};

/// The code that changes tools, in tenths.
const CHANGE: u16 = 60;

impl Reader<'_> {
    /// `M6` puts the tool of the last T into the spindle; of a file without it T does.
    fn take_tool(&mut self, block: &Block) {
        self.selected = block.get(b'T').map(|number| number as u32).or(self.selected);
        self.changes_by_code |= block.m.all().contains(&CHANGE);
        let is_changed = if self.changes_by_code { block.m.all().contains(&CHANGE) } else { block.has(b'T') };
        if is_changed {
            self.machine.tool = self.selected;
        }
    }

    /// The codes of a block, in the order of RS-274: what they leave in force first.
    pub(super) fn take_codes(&mut self, block: &Block, line: usize) -> Result<Once, Wrong> {
        let mut once = Once::default();
        let mut motion = None;
        for &code in block.g.all() {
            let name = || named('G', code);
            let meaning = of_g(code);
            let mut is_modelled = true;
            match meaning {
                Meaning::Motion(found) => {
                    if motion.replace(found).is_some_and(|other| other != found) {
                        return Err(Wrong::new(
                            name(),
                            "two motions in one block; expected one of G0 to G3 and G80 to G89",
                        ));
                    }
                }
                Meaning::Plane(plane) => self.plane = plane,
                Meaning::Unit(unit) => self.take_unit(unit, line, &name())?,
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
                    is_modelled = is_on;
                }
                Meaning::TipControl => self.has_tip_control = true,
                Meaning::Data => {
                    if self.machine.has_moved {
                        return Err(Wrong::new(
                            name(),
                            "offsets are written after moves: where the part then stands is not known",
                        ));
                    }
                    once.is_data = true;
                    is_modelled = false;
                }
                Meaning::Dwell => {
                    once.is_dwell = true;
                    is_modelled = false;
                }
                Meaning::Inert => is_modelled = false,
                Meaning::Refused(why) => return Err(Wrong::new(name(), why)),
            }
            if !is_modelled {
                self.inert(0, code, line);
            }
        }
        for &code in block.m.all() {
            match of_m(code) {
                Auxiliary::End => {}
                Auxiliary::Inert => self.inert(1, code, line),
                Auxiliary::Refused(why) => return Err(Wrong::new(named('M', code), why)),
            }
        }
        self.take_tool(block);
        if let Some(motion) = motion {
            once.has_motion = true;
            self.cycle = match motion {
                Motion::Cycle(code) => {
                    let [_, _, n] = self.plane.axes();
                    let initial = self.machine.counted_from(n, line, &named('G', code))?;
                    Some(Cycle::begun(code, initial, self.cycle))
                }
                _ => None,
            };
            self.motion = motion;
        }
        Ok(once)
    }

    fn inert(&mut self, kind: usize, code: u16, line: usize) {
        let seen = &mut self.codes[kind];
        if seen.len() <= usize::from(code) {
            seen.resize(usize::from(code) + 1, Seen::default());
        }
        seen[usize::from(code)].at(line);
    }

    fn take_unit(&mut self, unit: LengthUnit, line: usize, name: &str) -> Result<(), Wrong> {
        if self.unit != unit && self.machine.has_moved {
            let why = format!("the unit changes to {} after moves in {}", unit.name(), self.unit.name());
            return Err(Wrong::new(name, why));
        }
        if self.unit != unit && self.unit_is_said {
            self.machine.notes.assume(line, "the unit that is said last holds");
        }
        self.unit = unit;
        self.unit_is_said = true;
        Ok(())
    }

    fn take_system(&mut self, code: u16, block: &Block, line: usize) -> Result<(), Wrong> {
        // G54.1 P7.
        let number = if code == 541 { 1000 + block.get(b'P').unwrap_or(0.0) as u16 } else { code };
        match self.system {
            Some((known, first)) if known != number => {
                let (name, known) = (named('G', code), if known < 1000 { named('G', known) } else { "G54.1".into() });
                let why =
                    format!("another origin than that of {known} in line {first}; where it lies is not in the file");
                Err(Wrong::new(name, why))
            }
            Some(_) => Ok(()),
            None => {
                self.system = Some((number, line));
                self.machine.notes.assume(line, &format!("the part frame is that of {}", named('G', code)));
                Ok(())
            }
        }
    }

    /// F, S and the angles.
    pub(super) fn take_values(&mut self, block: &Block, line: usize) -> Result<(), Wrong> {
        for letter in [b'U', b'V', b'W'] {
            if block.get(letter).is_some_and(|number| number != 0.0) {
                return Err(Wrong::new(char::from(letter), "a further axis: which way it moves the tool is not known"));
            }
        }
        if let Some(feed) = block.get(b'F') {
            if !(0.0 <= feed) {
                return Err(Wrong::new(format!("F{feed}"), "expected a feed rate of more than 0"));
            }
            self.feed = Some(feed);
        }
        if let Some(speed) = block.get(b'S') {
            self.spindle = Some(speed);
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
                self.machine.notes.assume(line, "X Y Z are the tip in the part, as under G43.4");
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
