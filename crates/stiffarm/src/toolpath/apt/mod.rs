//! APT, and the CLS files that CAM programs write: `GOTO` with tool axes that hold on, one-shot `RAPID`, `CIRCLE` in the sense of the
//! program that wrote it (found from its head, checked against the tangent before it), cycles that say their levels.

mod circle;
mod frames;
mod inert;
pub(super) mod rewrite;
mod speeds;
mod statement;

use nalgebra::{Isometry3, Vector3};

use super::Ending;
use super::fault::{Wrong, shown};
use super::moves::{Course, Given, Move, MoveKind, ToolPose};
use super::notes::Notes;
use super::options::{ArcSense, CutterCompensation, FARTHEST, LengthUnit, ReadOptions};
use circle::Circle;
use frames::Setup;
use inert::{Inert, meaning_of};
use speeds::Feed;
use statement::Statement;

/// Who wrote a file, as far as its statements say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dialect {
    /// Siemens NX.
    Nx,
    /// SOLIDWORKS CAM.
    Solidworks,
}

/// What a cycle does at each point, m along the tool axis from it.
#[derive(Clone, Copy, Debug)]
struct Cycle {
    above: f64,
    bottom: f64,
    retract: f64,
    feed: Option<Feed>,
    /// It comes out at the feed rate, too.
    feeds_out: bool,
}

/// The part of a line that says something, and whether the statement goes on in the next one.
fn without_remark(line: &str) -> (&str, bool) {
    let text = line.split("$$").next().unwrap_or_default().trim();
    text.strip_suffix('$').map_or((text, false), |text| (text, true))
}

/// What is in force, statement after statement.
#[expect(clippy::struct_excessive_bools, reason = "each is what one statement leaves in force")]
pub(super) struct Reader<'a> {
    options: &'a ReadOptions,
    sink: &'a mut dyn FnMut(&Move),
    notes: Notes,
    /// A statement that goes on in the next line, and where it began.
    begun: Option<(String, usize)>,
    dialect: Option<Dialect>,
    unit: LengthUnit,
    unit_is_said: bool,
    /// Where the tool is; nobody knows before the first point.
    tip: Option<Vector3<f64>>,
    axis: Vector3<f64>,
    /// That of the next point, where TLAXIS has said it.
    axis_to: Option<Vector3<f64>>,
    /// Along the end of the last feed move.
    tangent: Option<Vector3<f64>>,
    is_rapid: bool,
    feed: Option<Feed>,
    /// Turns a minute.
    spindle: Option<f64>,
    /// Which way it turns, once that is said.
    is_clockwise: Option<bool>,
    circle: Option<Circle>,
    cycle: Option<Cycle>,
    /// A cycle has begun in this line, and what it does was not said yet.
    cycle_begun: Option<usize>,
    first_frame: Option<Isometry3<f64>>,
    part_from_coordinates: Isometry3<f64>,
    setup: Setup,
    has_moved: bool,
    /// The number of the tool in the spindle.
    tool: Option<u32>,
    apart: usize,
    arc_miss: f64,
    has_ended: bool,
    /// The first line behind the end that says something, and how many do.
    after_end: (usize, usize),
}

impl<'a> Reader<'a> {
    pub(super) fn new(options: &'a ReadOptions, sink: &'a mut dyn FnMut(&Move)) -> Self {
        Self {
            options,
            sink,
            notes: Notes::default(),
            begun: None,
            dialect: None,
            unit: options.unit.unwrap_or(LengthUnit::Millimetre),
            unit_is_said: false,
            tip: None,
            axis: Vector3::z(),
            axis_to: None,
            tangent: None,
            is_rapid: false,
            feed: None,
            spindle: None,
            is_clockwise: None,
            circle: None,
            cycle: None,
            cycle_begun: None,
            first_frame: None,
            part_from_coordinates: Isometry3::identity(),
            setup: Setup::default(),
            has_moved: false,
            tool: None,
            apart: 0,
            arc_miss: 0.0,
            has_ended: false,
            after_end: (0, 0),
        }
    }

    /// Reads a line.
    ///
    /// # Errors
    /// The first statement that is refused.
    pub(super) fn line(&mut self, text: &[u8], line: usize) -> Result<(), Wrong> {
        // Names and remarks may be in any script; what moves the tool is ASCII.
        let text = String::from_utf8_lossy(text);
        let (text, goes_on) = without_remark(&text);
        if self.has_ended {
            if !text.is_empty() {
                let (first, count) = self.after_end;
                self.after_end = (if count == 0 { line } else { first }, count + 1);
            }
            return Ok(());
        }
        if text.is_empty() && !goes_on {
            return Ok(());
        }
        let (mut whole, first) = self.begun.take().unwrap_or((String::new(), line));
        whole.push_str(text);
        if goes_on {
            if 1 << 16 < whole.len() {
                return Err(Wrong::new("$", "a statement goes on without end"));
            }
            self.begun = Some((whole, first));
            return Ok(());
        }
        self.statement(&Statement::of(&whole)?, line)
    }

    /// What is to be said of the file.
    ///
    /// # Errors
    /// Where it ends in the middle of something.
    pub(super) fn finish(mut self, line: usize) -> Result<Ending, Wrong> {
        if self.begun.is_some() {
            return Err(Wrong::new("$", "the file ends where a statement goes on"));
        }
        if self.circle.is_some() {
            return Err(Wrong::new("CIRCLE", "the file ends before the GOTO to the end of the arc"));
        }
        if !self.has_ended && self.dialect != Some(Dialect::Nx) {
            self.notes.assume(line, "the path ends with the file, without FINI");
        }
        if self.dialect == Some(Dialect::Nx) && self.tip.is_some() {
            self.notes.assume(line, "the path ends with the file, without END-OF-PATH");
        }
        if let (first, 1..) = self.after_end {
            self.notes.ignore_all(first, self.after_end.1, "lines behind FINI");
        }
        Ok(Ending { notes: self.notes, apart: self.apart, arc_miss: self.arc_miss })
    }

    fn statement(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let name = statement.name.as_str();
        match name {
            "TOOL PATH" | "TLDATA" | "MSYS" | "PAINT" | "END-OF-PATH" => {
                self.dialect = self.dialect.or(Some(Dialect::Nx));
            }
            "CSYS" | "TRNTYP" | "INSERT" => self.dialect = self.dialect.or(Some(Dialect::Solidworks)),
            _ => {}
        }
        if self.circle.is_some()
            && matches!(name, "CIRCLE" | "MOVARC" | "RAPID" | "FROM" | "GODLTA" | "GOHOME" | "CYCLE" | "MSYS" | "FINI")
        {
            return Err(Wrong::new(name, "expected the GOTO to the end of the arc"));
        }
        match name {
            "GOTO" => self.goto(statement, line),
            "GODLTA" => {
                let d = statement.numbers(&[3])?;
                let from =
                    self.tip.ok_or_else(|| Wrong::new(name, "it counts from a place that the file has not given"))?;
                let d = self.part_from_coordinates.rotation * Vector3::new(d[0], d[1], d[2]) * self.unit.metres();
                self.go_to(from + d, line, name)
            }
            "FROM" => {
                let (tip, axis) = self.point(statement)?;
                (self.tip, self.tangent) = (Some(tip), None);
                self.axis = axis;
                Ok(())
            }
            "RAPID" => {
                self.is_rapid = true;
                Ok(())
            }
            "FEDRAT" => self.take_feed(statement),
            "CIRCLE" | "MOVARC" => self.take_circle(statement, line),
            "CYCLE" => self.take_cycle(statement, line),
            "UNIT" | "UNITS" => self.take_unit(statement, line),
            "SPINDL" => {
                self.take_spindle(statement);
                self.notes.ignore(line, name);
                Ok(())
            }
            "TLAXIS" => {
                let n = statement.numbers(&[3])?;
                self.axis_to = Some(self.direction(&n, name)?);
                Ok(())
            }
            "GOHOME" => {
                (self.tip, self.tangent) = (None, None);
                self.apart += 1;
                self.notes.assume(line, "GOHOME leads the tool to the machine's home");
                Ok(())
            }
            "MSYS" => self.take_frame(statement),
            "CSYS" => self.take_setup(statement, line),
            "TRNTYP" => self.take_points(statement, line),
            "CUTCOM" => self.take_compensation(statement, line),
            "END-OF-PATH" => {
                (self.tip, self.tangent, self.cycle) = (None, None, None);
                (self.axis, self.is_rapid) = (Vector3::z(), false);
                Ok(())
            }
            "FINI" => {
                self.has_ended = true;
                Ok(())
            }
            name => match meaning_of(name) {
                Inert::Known(known) => {
                    if matches!(name, "LOAD" | "LOADTL") {
                        self.tool = statement.first_number().map(|number| number as u32);
                    }
                    self.notes.ignore(line, known);
                    Ok(())
                }
                // Of coordinates that were never shifted.
                Inert::Shifts if statement.words().eq(["NOMORE"]) => {
                    self.notes.ignore(line, name);
                    Ok(())
                }
                Inert::Shifts => {
                    let why = "it shifts or turns the path as only the post knows; let the CAM write true coordinates";
                    Err(Wrong::new(name, why))
                }
                Inert::Unknown => Err(Wrong::new(name, "it is not known whether this statement moves the tool")),
            },
        }
    }

    /// A vector from the tip to the spindle, part frame.
    fn direction(&self, n: &[f64], name: &str) -> Result<Vector3<f64>, Wrong> {
        let axis = Vector3::new(n[0], n[1], n[2]).try_normalize(1e-6);
        let axis = axis
            .ok_or_else(|| Wrong::new(name, "the tool axis is zero; expected a vector from the tip to the spindle"))?;
        Ok(self.part_from_coordinates.rotation * axis)
    }

    /// A point with the tool axis, which holds on where none is given; part frame.
    fn point(&mut self, statement: &Statement) -> Result<(Vector3<f64>, Vector3<f64>), Wrong> {
        let numbers = statement.numbers(&[3, 6])?;
        let name = &statement.name;
        if !self.unit_is_said {
            let by = if self.options.unit.is_some() { "as was said" } else { "since the file names none" };
            self.notes.assume(0, &format!("lengths in {}, {by}", self.unit.name()));
            self.unit_is_said = true;
        }
        let tip = Vector3::new(numbers[0], numbers[1], numbers[2]) * self.unit.metres();
        let tip = self.part_from_coordinates * nalgebra::Point3::from(tip);
        if let Some(x) = tip.iter().find(|x| !(x.abs() <= FARTHEST)) {
            return Err(Wrong::new(
                name.clone(),
                format!("a coordinate of {} mm; expected at most {FARTHEST} m", x * 1e3),
            ));
        }
        let said = self.axis_to.take();
        let axis = match &numbers[3..] {
            [] => said.unwrap_or(self.axis),
            vector => self.direction(vector, name)?,
        };
        self.setup.check(&axis, name)?;
        Ok((tip.coords, axis))
    }

    fn goto(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let (tip, axis) = self.point(statement)?;
        let before = self.axis;
        self.axis = axis;
        if let Some(begun) = self.cycle_begun {
            let why = format!(
                "the cycle of line {begun} has not said what it does; expected CYCLE/DRILL or its like before it"
            );
            return Err(Wrong::new("GOTO", why));
        }
        let Some(cycle) = self.cycle else {
            self.axis = before;
            return self.go_with(tip, axis, line, "GOTO");
        };
        if self.circle.is_some() {
            return Err(Wrong::new("CIRCLE", "an arc within a cycle"));
        }
        self.axis = before;
        let feed = self.feed;
        self.is_rapid = true;
        self.go_with(tip + cycle.above * axis, axis, line, "CYCLE")?;
        self.feed = cycle.feed.or(feed);
        self.go_with(tip + cycle.bottom * axis, axis, line, "CYCLE")?;
        self.is_rapid = !cycle.feeds_out;
        self.go_with(tip + cycle.retract * axis, axis, line, "CYCLE")?;
        self.feed = feed;
        Ok(())
    }

    fn go_to(&mut self, tip: Vector3<f64>, line: usize, word: &str) -> Result<(), Wrong> {
        self.go_with(tip, self.axis, line, word)
    }

    /// Makes one move.
    fn go_with(&mut self, tip: Vector3<f64>, axis: Vector3<f64>, line: usize, word: &str) -> Result<(), Wrong> {
        let is_rapid = std::mem::take(&mut self.is_rapid);
        let Some(from) = self.tip else {
            if self.circle.is_some() {
                return Err(Wrong::new("CIRCLE", "where the arc begins is not given; expected a GOTO before it"));
            }
            // From where the tool comes is not in the file.
            self.apart += 1;
            (self.tip, self.axis) = (Some(tip), axis);
            return Ok(());
        };
        let from = ToolPose { tip: from, axis: self.axis };
        let to = ToolPose { tip, axis };
        let course = match self.circle.take() {
            None => Course::Line,
            Some(circle) => {
                let by_dialect = match self.dialect {
                    Some(Dialect::Nx) => Some(ArcSense::LeftHand),
                    Some(Dialect::Solidworks) => Some(ArcSense::RightHand),
                    None => None,
                };
                let (arc, miss, note) =
                    circle.arc(&from.tip, &to.tip, self.tangent, self.options.arc_sense, by_dialect)?;
                self.arc_miss = self.arc_miss.max(miss);
                self.notes.assume(line, note);
                Course::Arc(arc)
            }
        };
        if course == Course::Line && from == to {
            return Ok(());
        }
        if from.axis.dot(&to.axis) < -1.0 + 1e-9 {
            return Err(Wrong::new(word, "the tool axis turns right over: no one knows which way round"));
        }
        let kind = if is_rapid { MoveKind::Rapid } else { MoveKind::Feed };
        let feed = if is_rapid { None } else { Some(self.speed(word)?) };
        let given = Given::under(self.tool, self.spindle.filter(|turns| 0.0 < *turns), self.is_clockwise);
        let one = Move { line, kind, from, to, course, feed, normals: None, given };
        (self.sink)(&one);
        self.tangent = one.direction(1.0).filter(|_| !is_rapid);
        (self.tip, self.axis, self.has_moved) = (Some(tip), axis, true);
        Ok(())
    }

    fn take_circle(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let (frame, unit) = (self.part_from_coordinates, self.unit.metres());
        self.circle = Some(Circle::of(statement, &frame, unit)?);
        if 6 < statement.parts.len() {
            self.notes.ignore(line, "CIRCLE: numbers behind the radius");
        }
        Ok(())
    }

    fn take_unit(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let word = statement.words().next().unwrap_or_default();
        let unit = match word {
            "MM" => LengthUnit::Millimetre,
            "INCH" | "INCHES" | "IN" => LengthUnit::Inch,
            word => {
                return Err(Wrong::new(
                    &statement.name,
                    format!("'{}' is no unit; expected MM or INCHES", shown(word)),
                ));
            }
        };
        if unit != self.unit && (self.has_moved || self.tip.is_some()) {
            return Err(Wrong::new(&statement.name, "the unit changes after points were given"));
        }
        if let Some(instead) = unit.instead_of(self.options.unit) {
            self.notes.assume(line, &instead);
        }
        (self.unit, self.unit_is_said) = (unit, true);
        Ok(())
    }

    fn take_compensation(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let name = &statement.name;
        let is_on = statement.words().any(|word| matches!(word, "LEFT" | "RIGHT" | "ON"));
        if !is_on {
            self.notes.ignore(line, name);
            return Ok(());
        }
        if self.options.cutter_compensation == CutterCompensation::Refuse {
            return Err(Wrong::new(
                name,
                "cutter compensation: the path is not that of the tool's centre; say cutter-compensation centre to read it as if it were",
            ));
        }
        self.notes.assume(line, "CUTCOM is not applied: the path is taken for the tool's centre");
        Ok(())
    }
}
