//! APT, and the CLS files that CAM programs write: `GOTO` with tool axes that hold on, one-shot `RAPID`, `CIRCLE` in the sense of the
//! program that wrote it (found from its head, checked against the tangent before it), cycles that say their levels.

mod circle;
pub(super) mod rewrite;
mod speeds;
mod statement;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::Ending;
use super::fault::{Wrong, shown};
use super::moves::{Course, Given, Move, MoveKind, ToolPose};
use super::notes::Notes;
use super::options::{ArcSense, CutterCompensation, FARTHEST, LengthUnit, ReadOptions};
use circle::Circle;
use statement::{Part, Statement};

/// Statements that move nothing, whoever writes them.
const INERT: [&str; 37] = [
    "TOOL PATH",
    "TLDATA",
    "PAINT",
    "LOAD",
    "LOADTL",
    "SELECT",
    "INSERT",
    "PPRINT",
    "PARTNO",
    "CUTTER",
    "COOLNT",
    "MACHIN",
    "OPSTOP",
    "STOP",
    "SEQNO",
    "AUXFUN",
    "PREFUN",
    "INTOL",
    "OUTTOL",
    "TOLER",
    "TOOLNO",
    "DELAY",
    "MODE",
    "MULTAX",
    "REWIND",
    "END",
    "PPFUN",
    "DISPLY",
    "CATMAT",
    "CHECK",
    "PROTOL",
    "TPRINT",
    "CLPRNT",
    "NOPOST",
    "CLEARP",
    "OPTYPE",
    "SET",
];

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
    feed: Option<f64>,
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
    /// Along the end of the last feed move.
    tangent: Option<Vector3<f64>>,
    is_rapid: bool,
    feed: Option<f64>,
    spindle: Option<f64>,
    circle: Option<Circle>,
    cycle: Option<Cycle>,
    first_frame: Option<Isometry3<f64>>,
    part_from_coordinates: Isometry3<f64>,
    csys: Option<Vec<f64>>,
    has_moved: bool,
    /// The number of the tool in the spindle.
    tool: Option<u32>,
    apart: usize,
    arc_miss: f64,
    has_ended: bool,
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
            tangent: None,
            is_rapid: false,
            feed: None,
            spindle: None,
            circle: None,
            cycle: None,
            first_frame: None,
            part_from_coordinates: Isometry3::identity(),
            csys: None,
            has_moved: false,
            tool: None,
            apart: 0,
            arc_miss: 0.0,
            has_ended: false,
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
        if text.is_empty() && !goes_on || self.has_ended {
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
            && matches!(name, "CIRCLE" | "MOVARC" | "RAPID" | "FROM" | "GODLTA" | "CYCLE" | "MSYS" | "FINI")
        {
            return Err(Wrong::new(name, "expected the GOTO to the end of the arc"));
        }
        match name {
            "GOTO" => self.goto(statement, line),
            "GODLTA" => {
                let d = statement.numbers(&[3])?;
                let from =
                    self.tip.ok_or_else(|| Wrong::new(name, "it counts from a place that the file has not told"))?;
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
            "CYCLE" => self.take_cycle(statement),
            "UNIT" | "UNITS" => self.take_unit(statement),
            "SPINDL" => {
                self.spindle = statement.first_number().or(self.spindle);
                self.notes.ignore(line, name);
                Ok(())
            }
            "MSYS" => self.take_frame(statement),
            "CSYS" => {
                let numbers = statement.numbers(&[12])?;
                match &self.csys {
                    Some(known) if *known != numbers && self.has_moved => Err(Wrong::new(
                        name,
                        "the coordinates change after moves; in which order its numbers stand is not known",
                    )),
                    _ => {
                        self.csys = Some(numbers);
                        self.notes.assume(line, "the part frame is that of the first CSYS");
                        Ok(())
                    }
                }
            }
            "TRNTYP" if statement.parts.iter().any(|part| matches!(part, Part::Number(number) if *number != 0.0)) => {
                Err(Wrong::new(name, "the path is shifted by it; expected WORLD,0,0,0"))
            }
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
            name if INERT.contains(&name) || name == "TRNTYP" => {
                if matches!(name, "LOAD" | "LOADTL") {
                    self.tool = statement.first_number().map(|number| number as u32);
                }
                self.notes.ignore(line, name);
                Ok(())
            }
            _ => Err(Wrong::new(name, "it is not known whether this statement moves the tool")),
        }
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
        let axis = match numbers[3..] {
            [i, j, k] => {
                let axis = Vector3::new(i, j, k).try_normalize(1e-6);
                let axis = axis.ok_or_else(|| {
                    Wrong::new(name.clone(), "the tool axis is zero; expected a vector from the tip to the spindle")
                })?;
                self.part_from_coordinates.rotation * axis
            }
            _ => self.axis,
        };
        Ok((tip.coords, axis))
    }

    fn goto(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let (tip, axis) = self.point(statement)?;
        let before = self.axis;
        self.axis = axis;
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
                return Err(Wrong::new("CIRCLE", "where the arc begins is not told; expected a GOTO before it"));
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
                let (arc, miss, told) =
                    circle.arc(&from.tip, &to.tip, self.tangent, self.options.arc_sense, by_dialect)?;
                self.arc_miss = self.arc_miss.max(miss);
                self.notes.assume(line, told);
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
        let feed = if is_rapid { None } else { self.feed.or(self.options.feed) };
        if !is_rapid && feed.is_none() {
            return Err(Wrong::new(word, "no feed rate: expected FEDRAT before it, or feed-mm-per-min for the file"));
        }
        let one = Move {
            line,
            kind,
            from,
            to,
            course,
            feed,
            normals: None,
            given: Given { tool: self.tool, ..Given::default() },
        };
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

    fn take_unit(&mut self, statement: &Statement) -> Result<(), Wrong> {
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
        (self.unit, self.unit_is_said) = (unit, true);
        Ok(())
    }

    /// `MSYS/`: origin, x and y axis of the coordinates; the first one is the part's.
    fn take_frame(&mut self, statement: &Statement) -> Result<(), Wrong> {
        let n = statement.numbers(&[9])?;
        let (x, y) = (Vector3::new(n[3], n[4], n[5]), Vector3::new(n[6], n[7], n[8]));
        if 1e-3 < (x.norm() - 1.0).abs().max((y.norm() - 1.0).abs()).max(x.dot(&y).abs()) {
            return Err(Wrong::new(&statement.name, "its axes are no unit vectors at a right angle"));
        }
        let x = x.normalize();
        let y = (y - x.dot(&y) * x).normalize();
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        let origin = Vector3::new(n[0], n[1], n[2]) * self.unit.metres();
        let frame = Isometry3::from_parts(Translation3::from(origin), UnitQuaternion::from_rotation_matrix(&rotation));
        let first = *self.first_frame.get_or_insert(frame);
        // A frame that stays the same changes nothing, not even by rounding.
        self.part_from_coordinates = if first == frame { Isometry3::identity() } else { first.inverse() * frame };
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
