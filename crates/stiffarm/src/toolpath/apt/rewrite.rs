//! APT with its feed moves led elsewhere: points are changed where they stand, arcs become remarks, points are added.

use std::cell::RefCell;

use nalgebra::{Point3, Vector3};

use super::super::corrections::{Corrections, Place, Sink, between};
use super::super::emitted::{Emitted, Lengths, Line, OF_AXIS, number, refused_as_written, remark};
use super::super::fault::Wrong;
use super::super::moves::{Move, MoveKind, ToolPose};
use super::super::options::ReadOptions;
use super::{Reader, without_remark};

/// A tool axis that is off by less, rad, is the one that is meant.
const SAME_AXIS: f64 = 1e-8;

/// The file as it is, and as it is written.
pub(in super::super) struct Rewriter<'a> {
    pub(in super::super) original: Reader<'a>,
    /// Reads what is written: where the tool will stand.
    written: Reader<'a>,
    head: Vec<String>,
    /// Lines of a statement that goes on, each with its end, and what the statement says so far.
    begun: (Vec<Vec<u8>>, String),
    /// Points have said a tool axis.
    has_vectors: bool,
}

/// A point as a statement says it.
struct Point<'t> {
    name: &'t str,
    /// Numbers as they stand.
    numbers: Vec<&'t str>,
    remark: &'t str,
}

impl<'a> Rewriter<'a> {
    pub(in super::super) fn new(
        options: &'a ReadOptions,
        head: Vec<String>,
        (sink, unheard): (Sink<'a>, Sink<'a>),
    ) -> Self {
        let (original, written) = (Reader::new(options, sink), Reader::new(options, unheard));
        Self { original, written, head, begun: (Vec::new(), String::new()), has_vectors: false }
    }

    /// Reads a line, and writes what becomes of it.
    ///
    /// # Errors
    /// A statement that is refused.
    pub(in super::super) fn line(
        &mut self,
        line: &Line,
        emitted: &mut Emitted,
        moves: &RefCell<Vec<Move>>,
        path: &mut Corrections,
    ) -> Result<(), Wrong> {
        let is_over = self.original.has_ended;
        let was_rapid = self.original.is_rapid;
        self.original.line(line.text, line.number)?;
        if is_over {
            emitted.keep(line);
            return Ok(());
        }
        let text = String::from_utf8_lossy(line.text).into_owned();
        let (says, goes_on) = without_remark(&text);
        self.begun.1.push_str(says);
        if goes_on {
            self.begun.0.push([line.mark, line.text, line.ending].concat());
            return Ok(());
        }
        let (before, statement) = std::mem::take(&mut self.begun);
        let moves = moves.take();
        let name = statement.split('/').next().unwrap_or_default().trim().to_ascii_uppercase();
        let is_point = matches!(name.as_str(), "GOTO" | "GODLTA") && self.original.cycle.is_none();
        let comment = text.split_once("$$").map_or("", |(_, comment)| comment);
        let point = || Point::of(&statement, comment);
        let statements = match moves[..] {
            [one] if is_point && one.kind == MoveKind::Feed => Some(self.led(&point(), &one, path)?),
            [] if is_point && !was_rapid && self.written.tip.is_some() && self.written.tip != self.original.tip => {
                Some(self.held(&point())?)
            }
            _ => None,
        };
        match statements {
            Some(statements) => self.replace(line, &before, &statements, emitted)?,
            None if matches!(name.as_str(), "CIRCLE" | "MOVARC") => {
                for one in &before {
                    emitted.bytes.extend_from_slice(b"$$ ");
                    emitted.bytes.extend_from_slice(one);
                }
                let remark = [&b"$$ "[..], line.text].concat();
                emitted.changed += before.len();
                emitted.replace(line, &[remark]);
            }
            None => self.kept(line, &before, &moves, emitted, path)?,
        }
        // Before the first statement nothing may stand that a program does not expect there.
        if !statement.is_empty() {
            for text in self.head.drain(..) {
                emitted.add(format!("$$ {}", remark(&text)).as_bytes());
            }
        }
        Ok(())
    }

    /// A statement that stays as it is.
    fn kept(
        &mut self,
        line: &Line,
        before: &[Vec<u8>],
        moves: &[Move],
        emitted: &mut Emitted,
        path: &mut Corrections,
    ) -> Result<(), Wrong> {
        for one in moves {
            path.skip(one);
        }
        for one in before {
            self.written.line(text_of(one), line.number).map_err(refused_as_written)?;
            emitted.bytes.extend_from_slice(one);
        }
        self.written.line(line.text, line.number).map_err(refused_as_written)?;
        emitted.keep(line);
        if let (Some(a), Some(b), false) = (self.written.tip, self.original.tip, moves.is_empty()) {
            path.aside = path.aside.max((a - b).norm());
        }
        Ok(())
    }

    /// Statements in place of one that stood in one or several lines.
    fn replace(
        &mut self,
        line: &Line,
        before: &[Vec<u8>],
        statements: &[Vec<u8>],
        emitted: &mut Emitted,
    ) -> Result<(), Wrong> {
        let is_same = statements.is_empty();
        for one in before.iter().filter(|_| is_same) {
            emitted.bytes.extend_from_slice(one);
        }
        if is_same {
            // What is kept was not yet read as written.
            for one in before {
                self.written.line(text_of(one), line.number).map_err(refused_as_written)?;
            }
            self.written.line(line.text, line.number).map_err(refused_as_written)?;
            emitted.keep(line);
        } else {
            emitted.changed += before.len();
            emitted.replace(line, statements);
        }
        Ok(())
    }

    fn standing(&self, tip: Vector3<f64>) -> ToolPose {
        ToolPose { tip, axis: self.written.axis }
    }

    fn held(&mut self, point: &Point) -> Result<Vec<Vec<u8>>, Wrong> {
        let Some(tip) = self.written.tip else { return Ok(Vec::new()) };
        let place = Place { pose: self.standing(tip), share: 1.0 };
        self.statements(point, &[place])
    }

    /// The statements through the places of a feed move; none where the one that stands there says it.
    fn led(&mut self, point: &Point, one: &Move, path: &mut Corrections) -> Result<Vec<Vec<u8>>, Wrong> {
        self.has_vectors |= point.numbers.len() == 6;
        let tilts = self.has_vectors && point.name != "GODLTA";
        let start = self.written.tip.map(|tip| self.standing(tip));
        let places = path.through(one, |first| start.unwrap_or(*first), tilts);
        self.statements(point, &places)
    }

    fn statements(&mut self, point: &Point, places: &[Place]) -> Result<Vec<Vec<u8>>, Wrong> {
        let mut statements = Vec::new();
        for (i, place) in places.iter().enumerate() {
            let numbers = self.numbers(point, place);
            let is_same =
                numbers.iter().zip(&point.numbers).all(|(a, b)| a == b) && numbers.len() == point.numbers.len();
            if is_same && places.len() == 1 {
                return Ok(Vec::new());
            }
            let remark =
                if i == 0 && !point.remark.is_empty() { format!(" $${}", point.remark) } else { String::new() };
            let text = format!("{}/{}{remark}", point.name, numbers.join(",")).into_bytes();
            self.written.line(&text, 0).map_err(refused_as_written)?;
            statements.push(text);
        }
        Ok(statements)
    }

    /// The numbers of a place: those that stand there, where they say it.
    fn numbers(&self, point: &Point, place: &Place) -> Vec<String> {
        let frame = self.original.part_from_coordinates.inverse();
        let lengths = Lengths::of(self.original.unit);
        let from = if point.name == "GODLTA" { self.written.tip } else { None };
        let wanted = match from {
            Some(tip) => frame.rotation * (place.pose.tip - tip),
            None => (frame * Point3::from(place.pose.tip)).coords,
        };
        let stands = |at: usize| point.numbers.get(at).and_then(|number| number.parse::<f64>().ok());
        let mut numbers: Vec<String> = (0..3)
            .map(|at| match stands(at) {
                Some(number) if lengths.are_alike(number * lengths.unit, wanted[at]) => point.numbers[at].to_owned(),
                _ => lengths.written(wanted[at]),
            })
            .collect();
        let axis = frame.rotation * place.pose.axis;
        let said = match (stands(3), stands(4), stands(5)) {
            (Some(i), Some(j), Some(k)) => Vector3::new(i, j, k).try_normalize(1e-6),
            _ => None,
        };
        let off = |axis_said: Vector3<f64>| {
            between(&ToolPose { axis: axis_said, ..place.pose }, &ToolPose { axis, ..place.pose })
        };
        match said {
            Some(said) if off(said) <= SAME_AXIS => {
                numbers.extend(point.numbers[3..].iter().map(|&number| number.to_owned()));
            }
            None if off(frame.rotation * self.written.axis) <= SAME_AXIS => {}
            _ => numbers.extend(axis.iter().map(|part| number(*part, OF_AXIS))),
        }
        numbers
    }
}

/// A line without its end and without the mark that begins some files.
fn text_of(line: &[u8]) -> &[u8] {
    line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line).trim_ascii_end()
}

impl<'t> Point<'t> {
    fn of(statement: &'t str, remark: &'t str) -> Self {
        let (name, numbers) = statement.split_once('/').unwrap_or((statement, ""));
        Self { name: name.trim(), numbers: numbers.split(',').map(str::trim).collect(), remark }
    }
}
