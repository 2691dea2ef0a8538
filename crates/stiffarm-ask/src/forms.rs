//! The forms of an answer: what each of them is called, and which of them a file's name asks for. Decided here and nowhere else.
//!
//! The ending chooses. Two endings stand for two things each: `.html` is a report where the verb makes one, and the view that can be turned
//! elsewhere; `view.html` and `*.view.html` are that view wherever there is one. `.pdf` is the figure; `report.pdf`, `*.report.pdf` and `*-report.pdf`
//! are the report on paper. `shop.svg` and `*.shop.svg`, and the same as `.png` and `.pdf`, are the drawing of where the work must stand; `lobes.svg` is
//! from which depth a cut swings.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};
use stiffarm::plain::on_one_line;

use crate::answer::{Lead, Rows, Table};
use crate::error::AskError;
use crate::exports;
use crate::figures::Plate;
use crate::figures::view3d::View;
use crate::report::Report;

/// Endings of the files that every answer can be written to.
const TABLES: [&str; 5] = ["json", "csv", "parquet", "md", "txt"];

/// In which forms answers of one kind are shown, besides tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Forms {
    /// The command's name, for errors.
    pub command: &'static str,
    /// Endings of the files it can be written to besides those of tables: svg, png and pdf, html, toml.
    pub further: &'static [&'static str],
    /// It makes a report.
    pub is_reported: bool,
    /// It draws where the work must stand.
    pub is_sited: bool,
    /// It draws from which depth a cut swings, beside its figure.
    pub has_lobes: bool,
}

/// A piece of an answer as people read it.
#[derive(Clone, Debug)]
pub enum Piece {
    /// A table.
    Table(Table),
    /// Lines of text.
    Lines(String),
    /// A file's text, letter by letter.
    Verbatim(String),
    /// The end of a line, or a line without letters.
    Break,
}

/// An answer in every form it can take. Each is made only when asked for.
pub trait Answer {
    /// In which forms it is shown besides tables.
    fn forms(&self) -> Forms;

    /// For people, one piece behind the other.
    fn text(&self) -> Vec<Piece>;

    /// The same as Markdown, where that is something else.
    fn markdown(&self) -> Vec<Piece> {
        self.text()
    }

    /// Its keys and values; of a map without the cells, which are its columns.
    fn value(&self) -> Value;

    /// For programs, as people can read it, too.
    ///
    /// # Errors
    /// Where `out` takes no more.
    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.value())
    }

    /// For spreadsheets, and as typed columns for data frames.
    fn rows(&self) -> Rows<'_>;

    /// What was asked to hold and does not: why.
    fn shortfall(&self) -> Option<String> {
        None
    }

    /// What was asked is answered with no, whatever was asked to hold: how the program ends.
    fn refusal(&self) -> Option<AskError> {
        None
    }

    /// A robot file, where there is one.
    fn robot_file(&self) -> Option<Result<String, AskError>> {
        None
    }

    /// What a machine reads, by the ending of its file, where there is such a program.
    fn program(&self, _ending: &str) -> Option<Result<Vec<u8>, AskError>> {
        None
    }

    /// A figure as SVG, where there is one.
    fn svg(&self) -> Option<Result<String, AskError>> {
        None
    }

    /// Where the work must stand, as SVG, where there is such a drawing.
    fn shop(&self) -> Option<Result<String, AskError>> {
        None
    }

    /// From which depth a cut swings, as SVG, where there is such a figure beside the other.
    fn lobes(&self) -> Option<Result<String, AskError>> {
        None
    }

    /// What is handed on, where there is a report.
    fn report(&self) -> Option<Result<Report, AskError>> {
        None
    }

    /// A picture as SVG, where there is one.
    fn drawn(&self, what: Drawn) -> Option<Result<String, AskError>> {
        match what {
            Drawn::Figure => self.svg(),
            Drawn::Shop => self.shop(),
            Drawn::Lobes => self.lobes(),
        }
    }

    /// A map for programs that show fields in space, where there is one.
    fn image(&self) -> Option<String> {
        None
    }

    /// What was asked of the figure alone.
    fn plate(&self) -> Plate {
        Plate::default()
    }

    /// What can be turned in space, where there is such a view.
    fn view(&self) -> Option<Result<View, AskError>> {
        None
    }

    /// What a figure shows that someone else draws, with so many points along the longer side of a map that is made for it.
    fn sketch(&self, _points: usize) -> Option<Result<Sketch, AskError>> {
        None
    }
}

/// What a figure shows beside the answer, for whoever draws it with tools of their own.
#[derive(Clone, Debug)]
pub struct Sketch {
    /// Title, arm, and what else stands at one place.
    pub shown: Value,
    /// The rows and columns of a map.
    pub shape: [usize; 2],
    /// Its cells by the key of each layer, row by row; NaN where nothing is reached.
    pub layers: Vec<(&'static str, Vec<f64>)>,
}

/// Tables one below the other, and what stands below them.
pub fn sheet(tables: impl IntoIterator<Item = Table>, notes: String) -> Vec<Piece> {
    let tables = tables.into_iter().flat_map(|table| [Piece::Table(table), Piece::Break]);
    tables.chain([Piece::Lines(notes)]).collect()
}

/// What people read of an answer, as JSON: its `tables`, each with `headings`, `rows` and the `lead` of one that has it, and its `sentences`, a
/// list of them before the first table and one behind each.
pub fn read_by_people(answer: &dyn Answer) -> Value {
    let (mut tables, mut sentences, mut behind) = (Vec::new(), Vec::new(), Vec::new());
    for piece in answer.markdown() {
        match piece {
            Piece::Table(table) => {
                tables.push(table_read(&table));
                sentences.push(std::mem::take(&mut behind));
            }
            Piece::Lines(text) | Piece::Verbatim(text) => {
                let lines = text.lines().map(str::trim).filter(|line| !line.is_empty()).map(on_one_line);
                behind.extend(lines.map(Cow::into_owned));
            }
            Piece::Break => {}
        }
    }
    sentences.push(behind);
    json!({ "tables": tables, "sentences": sentences })
}

fn table_read(table: &Table) -> Value {
    let word = |cell: &String| on_one_line(&cell.replace(['\n', '\r'], " ")).into_owned();
    let words = |cells: &[String]| cells.iter().map(word).collect::<Vec<_>>();
    let lead = |Lead { value, means, rests_on, rows }: &Lead| json!({ "value": word(value), "means": word(means), "rests_on": word(rests_on), "rows": rows });
    json!({
        "headings": words(&table.headings),
        "rows": table.rows.iter().map(|row| words(row)).collect::<Vec<_>>(),
        "lead": table.lead.as_ref().map(lead),
    })
}

/// JSON with line breaks, as people can read it.
///
/// # Errors
/// Where `out` takes no more.
pub fn pretty(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    out.write_all(b"\n")
}

/// In which form an answer is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Form {
    /// For programs.
    Json,
    /// For spreadsheets.
    Csv,
    /// As typed columns.
    Parquet,
    /// For people, as Markdown.
    Md,
    /// For people.
    Txt,
    /// A robot file.
    RobotFile,
    /// A picture.
    Svg(Drawn),
    /// The same in pixels.
    Png(Drawn),
    /// The same on a page of its size.
    Pdf(Drawn),
    /// What can be turned in space.
    View,
    /// The same as lines and faces for programs that show fields in space.
    Lines,
    /// A map as an image for them.
    Image,
    /// What is handed on, to be read on a screen or printed.
    Report,
    /// The same as pages.
    PrintedReport,
    /// What a machine reads, by its ending.
    Program(String),
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// The figure of the answer.
    Figure,
    /// Where the work must stand, as a shop drawing has it.
    Shop,
    /// From which depth a cut swings.
    Lobes,
}

impl Form {
    /// The text of an answer in this form; nothing of tables, pixels and pages, which need more than the answer.
    ///
    /// # Errors
    /// Where there is nothing to draw or to write, and why.
    ///
    /// # Panics
    /// Never: memory takes every byte of the JSON.
    pub fn text(&self, answer: &dyn Answer) -> Result<Option<Vec<u8>>, AskError> {
        let nothing = || AskError::Figure("there is nothing to draw".into());
        let made = |text: Option<Result<String, AskError>>| text.ok_or_else(nothing)?.map(String::into_bytes);
        Ok(Some(match self {
            Self::Json => {
                let mut text = Vec::new();
                answer.json(&mut text).expect("memory takes every byte");
                text
            }
            Self::RobotFile => made(answer.robot_file())?,
            Self::Svg(what) => made(answer.drawn(*what))?,
            Self::View => made(answer.view().map(|view| view.map(|view| view.html())))?,
            Self::Lines => made(answer.view().map(|view| view.map(|view| exports::lines(&view))))?,
            Self::Image => made(answer.image().map(Ok))?,
            Self::Report => made(answer.report().map(|report| report.map(|report| report.html())))?,
            Self::Program(ending) => answer.program(ending).transpose()?.unwrap_or_default(),
            Self::Csv | Self::Parquet | Self::Md | Self::Txt | Self::Png(_) | Self::Pdf(_) | Self::PrintedReport => {
                return Ok(None);
            }
        }))
    }

    /// It is made of the answer alone.
    pub fn is_text(&self) -> bool {
        match self {
            Self::Json
            | Self::RobotFile
            | Self::Svg(_)
            | Self::View
            | Self::Lines
            | Self::Image
            | Self::Report
            | Self::Program(_) => true,
            Self::Csv | Self::Parquet | Self::Md | Self::Txt | Self::Png(_) | Self::Pdf(_) | Self::PrintedReport => {
                false
            }
        }
    }

    /// It is looked at, so that the table is printed beside it.
    pub fn is_picture(&self) -> bool {
        matches!(self, Self::Svg(_) | Self::Png(_) | Self::Pdf(_) | Self::View | Self::Report | Self::PrintedReport)
    }
}

impl Forms {
    /// Of a command whose answers are tables.
    pub const fn of(command: &'static str) -> Self {
        Self { command, further: &[], is_reported: false, is_sited: false, has_lobes: false }
    }

    /// The form that a name asks for; nothing where there is none of it.
    pub fn form(&self, path: &Path) -> Option<Form> {
        let stem = path.file_stem().and_then(OsStr::to_str).unwrap_or_default().to_ascii_lowercase();
        let ending = path.extension().and_then(OsStr::to_str).unwrap_or_default().to_ascii_lowercase();
        let is_named = |what: &str| stem == what || stem.ends_with(&format!(".{what}"));
        let is_known = |ending: &str| self.further.contains(&ending);
        let drawn = if self.is_sited && is_named("shop") {
            Drawn::Shop
        } else if self.has_lobes && is_named("lobes") {
            Drawn::Lobes
        } else {
            Drawn::Figure
        };
        Some(match ending.as_str() {
            "json" => Form::Json,
            "csv" => Form::Csv,
            "parquet" => Form::Parquet,
            "md" => Form::Md,
            "txt" => Form::Txt,
            "html" if self.is_reported && !is_named("view") => Form::Report,
            "pdf" if self.is_reported && (is_named("report") || stem.ends_with("-report")) => Form::PrintedReport,
            ending if !is_known(ending) => return None,
            "html" => Form::View,
            "vtp" => Form::Lines,
            "vti" => Form::Image,
            "toml" => Form::RobotFile,
            "svg" => Form::Svg(drawn),
            "png" => Form::Png(drawn),
            "pdf" => Form::Pdf(drawn),
            ending => Form::Program(ending.into()),
        })
    }

    /// What names may end in, for whoever typed another.
    pub fn endings(&self) -> Vec<String> {
        let mut endings: Vec<String> = Vec::new();
        for ending in self.further {
            let is_view = self.is_reported && *ending == "html";
            endings.push(if is_view { ".view.html".into() } else { format!(".{ending}") });
        }
        if self.is_reported {
            endings.extend([".html".to_owned(), "report.pdf".into()]);
        }
        if self.is_sited {
            endings.push("shop.svg".into());
        }
        if self.has_lobes {
            endings.push("lobes.svg".into());
        }
        endings.extend(TABLES.map(|ending| format!(".{ending}")));
        endings
    }
}
