//! Tables of points: columns whose names say what they hold and in which unit.

pub(super) mod rewrite;

use nalgebra::Vector3;

use super::Ending;
use super::fault::{Wrong, shown};
use super::moves::{Course, Given, Move, MoveKind, ToolPose};
use super::notes::Notes;
use super::options::{FARTHEST, LengthUnit, ReadOptions};

/// What a header may say, for messages.
const EXPECTED: &str = "x_mm,y_mm,z_mm (or _m, _inch), and besides i,j,k (tool axis from the tip) or nx,ny,nz (outward normal), \
                        feed_mm_per_min, rapid, ap_mm, ae_mm, fx_n,fy_n,fz_n; `-` for what moves nothing";

/// No table of points has more columns.
const MOST_COLUMNS: usize = 100;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    /// A coordinate, and what one of its unit is in m.
    Tip(usize, f64),
    Axis(usize),
    Normal(usize),
    /// With what one of its unit is in m/s.
    Feed(f64),
    Rapid,
    AxialDepth,
    RadialWidth,
    Force(usize),
    Inert,
}

/// The table, row after row.
pub(super) struct Reader<'a> {
    options: &'a ReadOptions,
    sink: &'a mut dyn FnMut(&Move),
    notes: Notes,
    columns: Vec<Column>,
    separator: char,
    at: Option<ToolPose>,
    /// The outward normal there.
    normal: Option<Vector3<f64>>,
}

/// One row.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    tip: Vector3<f64>,
    axis: Option<Vector3<f64>>,
    normal: Option<Vector3<f64>>,
    feed: Option<f64>,
    is_rapid: bool,
    given: Given,
}

impl<'a> Reader<'a> {
    pub(super) fn new(options: &'a ReadOptions, sink: &'a mut dyn FnMut(&Move)) -> Self {
        Self { options, sink, notes: Notes::default(), columns: Vec::new(), separator: ',', at: None, normal: None }
    }

    /// Reads a line.
    ///
    /// # Errors
    /// A header that is not understood, a row with more or fewer cells, a cell that is no number.
    pub(super) fn line(&mut self, text: &[u8], line: usize) -> Result<(), Wrong> {
        let text = std::str::from_utf8(text).map_err(|_| Wrong::new("the line", "it is no UTF-8 text"))?.trim();
        if text.is_empty() || text.starts_with('#') {
            return Ok(());
        }
        if !self.columns.is_empty() {
            return self.row(text, line);
        }
        self.separator = [';', '\t', ','].into_iter().find(|sign| text.contains(*sign)).unwrap_or(',');
        let cells: Vec<&str> = text.split(self.separator).map(bare).collect();
        if self.options.columns.is_empty() {
            return self.header(&cells, line);
        }
        let named: Vec<&str> = self.options.columns.iter().map(|name| name.trim()).collect();
        if named.len() == cells.len()
            && named.iter().zip(&cells).all(|(name, cell)| *name == "-" || cell.parse::<f64>().is_ok())
        {
            self.header(&named, line)?;
            return self.row(text, line);
        }
        if cells.iter().any(|cell| cell.parse::<f64>().is_ok()) {
            let why = format!(
                "{} cells, of which {} are named by columns, or a cell that is no number",
                cells.len(),
                named.len()
            );
            return Err(Wrong::new("the line", why));
        }
        self.notes.ignore(line, "lines before the first numbers");
        Ok(())
    }

    fn header(&mut self, cells: &[&str], line: usize) -> Result<(), Wrong> {
        if MOST_COLUMNS < cells.len() {
            return Err(Wrong::new("the header", format!("{} columns; expected at most {MOST_COLUMNS}", cells.len())));
        }
        if cells.iter().all(|cell| cell.is_empty() || cell.parse::<f64>().is_ok()) {
            let why =
                format!("it holds numbers; expected names: {EXPECTED}; or say columns, for a file without a header");
            return Err(Wrong::new("the header", why));
        }
        let mut columns = Vec::new();
        for cell in cells {
            let column = self.column(cell)?;
            if column != Column::Inert && columns.contains(&column) {
                return Err(Wrong::new(*cell, "the column stands twice"));
            }
            if column == Column::Inert && !matches!(*cell, "-" | "") {
                self.notes.ignore(line, &format!("column {}", shown(cell)));
            }
            columns.push(column);
        }
        let has = |wanted: Column| columns.contains(&wanted);
        let units: Vec<f64> = columns
            .iter()
            .filter_map(|column| if let Column::Tip(_, unit) = column { Some(*unit) } else { None })
            .collect();
        if units.len() != 3 || units.iter().any(|unit| *unit != units[0]) {
            let why = format!("it does not name x, y and z once each, in one unit; expected {EXPECTED}");
            return Err(Wrong::new("the header", why));
        }
        if let Some(said) = self.options.unit.filter(|said| said.metres() != units[0]) {
            let why = format!("lengths in the unit of the headings, not in {} as was said", said.name());
            self.notes.assume(line, &why);
        }
        for (what, kind) in [
            ("i,j,k", Column::Axis as fn(usize) -> Column),
            ("nx,ny,nz", Column::Normal),
            ("fx_n,fy_n,fz_n", Column::Force),
        ] {
            let count = (0..3).filter(|axis| has(kind(*axis))).count();
            if count != 0 && count != 3 {
                return Err(Wrong::new("the header", format!("{what}: {count} of 3 are there")));
            }
        }
        if has(Column::Normal(0)) && !has(Column::Axis(0)) {
            self.notes.assume(line, "the tool stands along the outward normal nx,ny,nz");
        } else if !has(Column::Axis(0)) {
            self.notes.assume(line, "the tool axis is z");
        }
        if !columns.iter().any(|column| matches!(column, Column::Feed(_))) && self.options.feed.is_none() {
            self.notes.assume(line, "no feed rate: how long it takes is not known");
        }
        self.columns = columns;
        Ok(())
    }

    /// What a heading says.
    fn column(&self, name: &str) -> Result<Column, Wrong> {
        let lower = name.to_ascii_lowercase();
        let (mm, inch) = (LengthUnit::Millimetre.metres(), LengthUnit::Inch.metres());
        let unit_of = |ending: &str| match (ending, self.options.unit) {
            ("_mm", _) => Some(mm),
            ("_m", _) => Some(1.0),
            ("_in" | "_inch", _) => Some(inch),
            ("", Some(unit)) => Some(unit.metres()),
            _ => None,
        };
        let coordinate = ["x", "y", "z"].iter().position(|axis| lower.starts_with(axis));
        if let Some(axis) = coordinate {
            let unit = unit_of(&lower[1..]).ok_or_else(|| {
                Wrong::new(
                    shown(name),
                    format!("it has no unit that is known; expected {0}_mm, {0}_m or {0}_inch", &lower[..1]),
                )
            })?;
            return Ok(Column::Tip(axis, unit));
        }
        Ok(match lower.as_str() {
            "i" | "j" | "k" => Column::Axis(usize::from(lower.as_bytes()[0] - b'i')),
            "nx" | "ny" | "nz" => Column::Normal(usize::from(lower.as_bytes()[1] - b'x')),
            "fx_n" | "fy_n" | "fz_n" => Column::Force(usize::from(lower.as_bytes()[1] - b'x')),
            "feed_mm_per_min" => Column::Feed(mm / 60.0),
            "feed_m_per_min" => Column::Feed(1.0 / 60.0),
            "feed_inch_per_min" | "feed_in_per_min" => Column::Feed(inch / 60.0),
            "feed_mm_per_s" => Column::Feed(mm),
            "feed_m_per_s" => Column::Feed(1.0),
            "rapid" => Column::Rapid,
            "ap_mm" => Column::AxialDepth,
            "ae_mm" => Column::RadialWidth,
            "a" | "b" | "c" | "a_deg" | "b_deg" | "c_deg" => {
                return Err(Wrong::new(
                    shown(name),
                    "an angle of a machine that is not known; expected the tool axis as i,j,k",
                ));
            }
            "feed" | "f" | "ap" | "ae" | "fx" | "fy" | "fz" => {
                return Err(Wrong::new(shown(name), format!("it has no unit; expected {EXPECTED}")));
            }
            _ => Column::Inert,
        })
    }

    fn row(&mut self, text: &str, line: usize) -> Result<(), Wrong> {
        let mut row = Row::default();
        let mut count = 0;
        for (cell, column) in text.split(self.separator).zip(&self.columns) {
            count += 1;
            take(bare(cell), *column, &mut row)?;
        }
        let found = text.split(self.separator).count();
        if count != self.columns.len() || found != count {
            let why = format!("{found} cells; expected {}, as in the header", self.columns.len());
            return Err(Wrong::new("the line", why));
        }
        if let Some(x) = row.tip.iter().find(|x| !(x.abs() <= FARTHEST)) {
            return Err(Wrong::new(
                "the line",
                format!("a coordinate of {} mm; expected at most {FARTHEST} m", x * 1e3),
            ));
        }
        let normal = row.normal.map(|normal| self.direction(normal, ["the normal", "normals"], line)).transpose()?;
        let axis = row.axis.map(|axis| self.direction(axis, ["the tool axis", "tool axes"], line)).transpose()?;
        let before = std::mem::replace(&mut self.normal, normal);
        let normals = before.zip(normal).map(|(before, normal)| [before, normal]);
        self.go(ToolPose { tip: row.tip, axis: axis.or(normal).unwrap_or_else(Vector3::z) }, &row, normals, line)
    }

    /// A vector that says a direction.
    fn direction(&mut self, vector: Vector3<f64>, [one, all]: [&str; 2], line: usize) -> Result<Vector3<f64>, Wrong> {
        if 1e-2 < (vector.norm() - 1.0).abs() {
            self.notes.assume(line, &format!("{all} are taken as directions, whatever their length"));
        }
        vector.try_normalize(1e-6).ok_or_else(|| {
            let expected = "expected a vector away from the part: of the tool to the spindle, of a surface outwards";
            Wrong::new("the line", format!("{one} is zero; {expected}"))
        })
    }

    fn go(&mut self, to: ToolPose, row: &Row, normals: Option<[Vector3<f64>; 2]>, line: usize) -> Result<(), Wrong> {
        let Some(from) = self.at.replace(to) else { return Ok(()) };
        if from == to {
            return Ok(());
        }
        if from.axis.dot(&to.axis) < -1.0 + 1e-9 {
            return Err(Wrong::new("the line", "the tool axis turns right over: no one knows which way round"));
        }
        let (kind, feed) =
            if row.is_rapid { (MoveKind::Rapid, None) } else { (MoveKind::Feed, row.feed.or(self.options.feed)) };
        (self.sink)(&Move { line, kind, from, to, course: Course::Line, feed, normals, given: row.given });
        Ok(())
    }

    /// What is to be said of the file.
    ///
    /// # Errors
    /// A file without a header.
    pub(super) fn finish(self) -> Result<Ending, Wrong> {
        if self.columns.is_empty() {
            return Err(Wrong::new("the file", format!("it has no header; expected {EXPECTED}")));
        }
        Ok(Ending { notes: self.notes, ..Ending::default() })
    }
}

/// A cell without blanks and quotes about it.
fn bare(cell: &str) -> &str {
    let cell = cell.trim();
    cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"')).unwrap_or(cell).trim()
}

/// Puts a cell where it belongs.
fn take(cell: &str, column: Column, row: &mut Row) -> Result<(), Wrong> {
    if column == Column::Inert {
        return Ok(());
    }
    if column == Column::Rapid {
        row.is_rapid = match cell {
            "" | "0" | "false" => false,
            "1" | "true" => true,
            _ => return Err(Wrong::new(shown(cell), "expected 1 for a rapid move to this point, else 0")),
        };
        return Ok(());
    }
    let may_be_empty = !matches!(column, Column::Tip(..) | Column::Axis(_) | Column::Normal(_));
    if cell.is_empty() && may_be_empty {
        return Ok(());
    }
    let number: f64 = cell.parse().map_err(|_| Wrong::new(shown(cell), "it is no number; expected such as -1.5"))?;
    if !(number.abs() <= 1e9) {
        return Err(Wrong::new(shown(cell), "expected a number of at most 1e9"));
    }
    let positive = |what: &str| {
        if 0.0 < number { Ok(number) } else { Err(Wrong::new(shown(cell), format!("expected {what} of more than 0"))) }
    };
    let depth = |what: &str| {
        if 0.0 <= number {
            Ok(number * 1e-3)
        } else {
            Err(Wrong::new(shown(cell), format!("expected {what} of at least 0")))
        }
    };
    match column {
        Column::Tip(axis, unit) => row.tip[axis] = number * unit,
        Column::Axis(axis) => row.axis.get_or_insert_with(Vector3::zeros)[axis] = number,
        Column::Normal(axis) => row.normal.get_or_insert_with(Vector3::zeros)[axis] = number,
        Column::Feed(unit) => row.feed = Some(positive("a feed rate")? * unit),
        Column::AxialDepth => row.given.axial_depth = Some(depth("a depth of cut")?),
        Column::RadialWidth => row.given.radial_width = Some(depth("a width of cut")?),
        Column::Force(axis) => row.given.force.get_or_insert_with(Vector3::zeros)[axis] = number,
        Column::Rapid | Column::Inert => {}
    }
    Ok(())
}
