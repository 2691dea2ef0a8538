//! A table with its feed points led elsewhere: cells are changed where they stand, rows are added.

use std::cell::RefCell;

use super::super::corrections::{Corrections, Place, Sink, between};
use super::super::emitted::{Emitted, Lengths, Line, OF_AXIS, number, refused_as_written, remark};
use super::super::fault::Wrong;
use super::super::moves::{Move, MoveKind, ToolPose};
use super::super::options::ReadOptions;
use super::{Column, Reader, bare};

/// A tool axis that is off by less, rad, is the one that is meant.
const SAME_AXIS: f64 = 1e-8;

/// The table as it is, and as it is written.
pub(in super::super) struct Rewriter<'a> {
    pub(in super::super) original: Reader<'a>,
    /// Reads what is written.
    written: Reader<'a>,
    head: Vec<String>,
    /// The first point, and lines behind it that say nothing: where it is led, the move from it tells.
    first: Option<(Owned, Vec<Owned>)>,
}

/// A line that waits.
struct Owned {
    number: usize,
    parts: [Vec<u8>; 3],
}

impl Owned {
    fn of(line: &Line) -> Self {
        Self { number: line.number, parts: [line.mark, line.text, line.ending].map(<[u8]>::to_vec) }
    }

    fn line(&self) -> Line<'_> {
        let [mark, text, ending] = &self.parts;
        Line { number: self.number, mark, text, ending }
    }
}

impl<'a> Rewriter<'a> {
    pub(in super::super) fn new(
        options: &'a ReadOptions,
        head: Vec<String>,
        (sink, unheard): (Sink<'a>, Sink<'a>),
    ) -> Self {
        let (original, written) = (Reader::new(options, sink), Reader::new(options, unheard));
        Self { original, written, head, first: None }
    }

    /// Reads a line, and writes what becomes of it.
    ///
    /// # Errors
    /// A row that is refused.
    pub(in super::super) fn line(
        &mut self,
        line: &Line,
        emitted: &mut Emitted,
        moves: &RefCell<Vec<Move>>,
        path: &mut Corrections,
    ) -> Result<(), Wrong> {
        let had_begun = self.original.at.is_some();
        self.original.line(line.text, line.number)?;
        for text in self.head.drain(..) {
            emitted.add(format!("# {}", remark(&text)).as_bytes());
        }
        let is_row = self.original.at.is_some() && !line.text.is_empty() && !line.text.trim_ascii().starts_with(b"#");
        if is_row && !had_begun {
            self.first = Some((Owned::of(line), Vec::new()));
            return Ok(());
        }
        let moves = moves.take();
        match (&mut self.first, moves[..].first()) {
            // The same point again, or no row.
            (Some((_, behind)), None) => {
                behind.push(Owned::of(line));
                return Ok(());
            }
            (Some(_), Some(one)) if one.kind != MoveKind::Feed => self.release(emitted)?,
            _ => {}
        }
        match moves[..] {
            [one] if one.kind == MoveKind::Feed => self.led(line, &one, emitted, path),
            [] if is_row && !self.is_rapid(line.text) && self.written.at != self.original.at => {
                let Some(pose) = self.written.at else { return Ok(()) };
                let row = self.row(line, &Place { pose, share: 1.0 })?;
                emitted.replace(line, &[row]);
                Ok(())
            }
            _ => {
                for one in &moves {
                    path.skip(one);
                }
                self.kept(line, emitted)?;
                if let (Some(a), Some(b), false) = (self.written.at, self.original.at, moves.is_empty()) {
                    path.aside = path.aside.max((a.tip - b.tip).norm());
                }
                Ok(())
            }
        }
    }

    /// The first point and what waits behind it, as they are.
    ///
    /// # Errors
    /// What is refused as it is written.
    pub(in super::super) fn release(&mut self, emitted: &mut Emitted) -> Result<(), Wrong> {
        let Some((first, behind)) = self.first.take() else { return Ok(()) };
        for line in std::iter::once(&first).chain(&behind) {
            self.kept(&line.line(), emitted)?;
        }
        Ok(())
    }

    fn kept(&mut self, line: &Line, emitted: &mut Emitted) -> Result<(), Wrong> {
        self.written.line(line.text, line.number).map_err(refused_as_written)?;
        emitted.keep(line);
        Ok(())
    }

    fn led(&mut self, line: &Line, one: &Move, emitted: &mut Emitted, path: &mut Corrections) -> Result<(), Wrong> {
        let tilts = self.original.columns.iter().any(|column| matches!(column, Column::Axis(_) | Column::Normal(_)));
        let (stands, mut begins) = (self.written.at, None);
        let start = |first: &ToolPose| {
            begins = Some(*first);
            stands.unwrap_or(*first)
        };
        let places = path.through(one, start, tilts);
        if let (Some((first, behind)), Some(pose)) = (self.first.take(), begins) {
            for (i, waits) in std::iter::once(&first).chain(&behind).enumerate() {
                let waits = waits.line();
                let is_point = i == 0 || !waits.text.is_empty() && !waits.text.trim_ascii().starts_with(b"#");
                if is_point {
                    let row = self.row(&waits, &Place { pose, share: 0.0 })?;
                    emitted.replace(&waits, &[row]);
                } else {
                    self.kept(&waits, emitted)?;
                }
            }
        }
        let rows: Result<Vec<Vec<u8>>, Wrong> = places.iter().map(|place| self.row(line, place)).collect();
        emitted.replace(line, &rows?);
        Ok(())
    }

    /// A row led to a place.
    fn row(&mut self, line: &Line, place: &Place) -> Result<Vec<u8>, Wrong> {
        let text = std::str::from_utf8(line.text).map_err(|_| Wrong::new("the line", "it is no UTF-8 text"))?;
        let cells: Vec<&str> = text.split(self.original.separator).collect();
        let has_axis = self.original.columns.contains(&Column::Axis(0));
        let mut said = nalgebra::Vector3::zeros();
        for (cell, column) in cells.iter().zip(&self.original.columns) {
            if let Some(axis) = axis_of(*column, has_axis) {
                said[axis] = parsed(cell)?;
            }
        }
        let keeps_axis = said
            .try_normalize(1e-6)
            .is_some_and(|axis| between(&ToolPose { axis, ..place.pose }, &place.pose) <= SAME_AXIS);
        let mut row = Vec::with_capacity(text.len() + 16);
        for (i, cell) in cells.iter().enumerate() {
            if 0 < i {
                row.push(self.original.separator);
            }
            let column = self.original.columns.get(i).copied().unwrap_or(Column::Inert);
            let new = match (column, axis_of(column, has_axis)) {
                (Column::Tip(axis, unit), _) => {
                    let (lengths, wanted) = (Lengths::of_metres(unit), place.pose.tip[axis]);
                    if lengths.are_alike(parsed(cell)? * unit, wanted) { None } else { Some(lengths.written(wanted)) }
                }
                (_, Some(axis)) if !keeps_axis => Some(number(place.pose.axis[axis], OF_AXIS)),
                _ => None,
            };
            match new {
                None => row.extend(cell.chars()),
                Some(new) => row.extend(cell.replacen(bare(cell), &new, 1).chars()),
            }
        }
        let row = row.into_iter().collect::<String>().into_bytes();
        self.written.line(&row, line.number).map_err(refused_as_written)?;
        Ok(row)
    }

    /// The row says that the way to it is rapid.
    fn is_rapid(&self, text: &[u8]) -> bool {
        let text = String::from_utf8_lossy(text);
        let mut cells = text.split(self.original.separator).zip(&self.original.columns);
        cells.any(|(cell, column)| *column == Column::Rapid && matches!(bare(cell), "1" | "true"))
    }
}

/// Which part of the tool axis a column holds.
fn axis_of(column: Column, has_axis: bool) -> Option<usize> {
    match column {
        Column::Axis(axis) => Some(axis),
        Column::Normal(axis) if !has_axis => Some(axis),
        _ => None,
    }
}

fn parsed(cell: &str) -> Result<f64, Wrong> {
    bare(cell).parse().map_err(|_| Wrong::new(bare(cell), "it is no number; expected such as -1.5"))
}
