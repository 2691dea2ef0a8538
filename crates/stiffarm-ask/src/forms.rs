//! The forms of an answer: what each of them is called, and which of them a file's name asks for. Decided here and nowhere else.
//!
//! A row of [`FORMS`] each. The ending chooses, the longest that the verb has: `.html` is a report where the verb makes one, and `view.html` and
//! `*.view.html` the view that can be turned; `.pdf` is the figure, and `report.pdf`, `*.report.pdf` and `*-report.pdf` the report on paper;
//! `shop.svg` and `*.shop.svg` are the drawing of where the work must stand, `lobes.svg` from which depth a cut swings.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};
use stiffarm::plain::on_one_line;

use crate::answer::{Headline, Lead, Rows, Table};
use crate::error::AskError;
use crate::exports;
use crate::figures::FigureSize;
use crate::figures::view3d::View;
use crate::report::Report;

/// What an answer makes besides tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makes {
    /// A picture, in pixels and on paper, too.
    Picture(Picture),
    /// What can be turned in space.
    View,
    /// A map for programs that show fields in space.
    Image,
    /// A robot file.
    RobotFile,
    /// What is handed on.
    Report,
    /// What machines read, by the endings of their files.
    Programs(&'static [&'static str]),
}

/// In which forms answers of one kind are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Forms {
    /// The command's name, for errors.
    pub command: &'static str,
    /// What there is besides tables.
    pub makes: &'static [Makes],
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

    /// In a word and a few sentences, where a report begins with it.
    fn headline(&self) -> Option<Headline> {
        None
    }

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
    fn drawn(&self, what: Picture) -> Option<Result<String, AskError>> {
        match what {
            Picture::Figure => self.svg(),
            Picture::Shop => self.shop(),
            Picture::Lobes => self.lobes(),
        }
    }

    /// A map for programs that show fields in space, where there is one.
    fn image(&self) -> Option<String> {
        None
    }

    /// What was asked of the figure alone.
    fn figure_size(&self) -> FigureSize {
        FigureSize::default()
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
pub fn tables_and_notes(tables: impl IntoIterator<Item = Table>, notes: String) -> Vec<Piece> {
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// What people read, for programs: [`read_by_people`].
    Tables,
    /// A robot file.
    RobotFile,
    /// A picture.
    Svg(Picture),
    /// The same in pixels.
    Png(Picture),
    /// The same on a page of its size.
    Pdf(Picture),
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
    Program(&'static str),
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// The figure of the answer.
    Figure,
    /// Where the work must stand, as a shop drawing has it.
    Shop,
    /// From which depth a cut swings.
    Lobes,
}

/// How a form is asked for, how its files are called, and what browsers know it as.
#[derive(Clone, Copy, Debug)]
pub struct FormRow {
    /// Which.
    pub form: Form,
    /// The word that asks for it.
    pub word: &'static str,
    /// What the names of its files end in, with a dot where anything may stand before it; else such a name stands alone or behind a dot.
    pub endings: &'static [&'static str],
    /// Its media type.
    pub media_type: &'static str,
}

const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";
const HTML: &str = "text/html; charset=utf-8";
const SVG: &str = "image/svg+xml";
const PNG: &str = "image/png";
const PDF: &str = "application/pdf";

const fn row(form: Form, word: &'static str, endings: &'static [&'static str], media_type: &'static str) -> FormRow {
    FormRow { form, word, endings, media_type }
}

/// Every form. Of two with the same ending the later one is meant where the verb has both.
pub static FORMS: &[FormRow] = &[
    row(Form::Svg(Picture::Figure), "svg", &[".svg"], SVG),
    row(Form::Png(Picture::Figure), "png", &[".png"], PNG),
    row(Form::Pdf(Picture::Figure), "pdf", &[".pdf"], PDF),
    row(Form::View, "view", &["view.html", ".html"], HTML),
    row(Form::Lines, "vtp", &[".vtp"], TEXT),
    row(Form::Image, "vti", &[".vti"], TEXT),
    row(Form::RobotFile, "toml", &[".toml"], "application/toml"),
    row(Form::Program("src"), "src", &[".src"], TEXT),
    row(Form::Program("mod"), "mod", &[".mod"], TEXT),
    row(Form::Program("ls"), "ls", &[".ls"], TEXT),
    row(Form::Program("py"), "py", &[".py"], TEXT),
    row(Form::Program("yaml"), "yaml", &[".yaml"], TEXT),
    row(Form::Program("nc"), "nc", &[".nc"], TEXT),
    row(Form::Program("gcode"), "gcode", &[".gcode"], TEXT),
    row(Form::Program("ngc"), "ngc", &[".ngc"], TEXT),
    row(Form::Program("tap"), "tap", &[".tap"], TEXT),
    row(Form::Program("apt"), "apt", &[".apt"], TEXT),
    row(Form::Program("cls"), "cls", &[".cls"], TEXT),
    row(Form::Report, "report", &[".html"], HTML),
    row(Form::PrintedReport, "report-pdf", &["report.pdf", "-report.pdf"], PDF),
    row(Form::Svg(Picture::Shop), "shop", &["shop.svg"], SVG),
    row(Form::Png(Picture::Shop), "shop.png", &["shop.png"], PNG),
    row(Form::Pdf(Picture::Shop), "shop.pdf", &["shop.pdf"], PDF),
    row(Form::Svg(Picture::Lobes), "lobes", &["lobes.svg"], SVG),
    row(Form::Png(Picture::Lobes), "lobes.png", &["lobes.png"], PNG),
    row(Form::Pdf(Picture::Lobes), "lobes.pdf", &["lobes.pdf"], PDF),
    row(Form::Json, "json", &[".json"], JSON),
    row(Form::Csv, "csv", &[".csv"], "text/csv; charset=utf-8"),
    row(Form::Parquet, "parquet", &[".parquet"], "application/vnd.apache.parquet"),
    row(Form::Md, "md", &[".md"], "text/markdown; charset=utf-8"),
    row(Form::Txt, "txt", &[".txt"], TEXT),
    row(Form::Tables, "tables", &["tables.json"], JSON),
];

impl Form {
    /// The text of an answer in this form; nothing of tables, pixels and pages, which need more than the answer.
    ///
    /// # Errors
    /// Where there is nothing to draw or to write, and why.
    ///
    /// # Panics
    /// Never: memory takes every byte of the JSON.
    pub fn text(self, answer: &dyn Answer) -> Result<Option<Vec<u8>>, AskError> {
        let nothing = || AskError::Figure("there is nothing to draw".into());
        let made = |text: Option<Result<String, AskError>>| text.ok_or_else(nothing)?.map(String::into_bytes);
        Ok(Some(match self {
            Self::Json => {
                let mut text = Vec::new();
                answer.json(&mut text).expect("memory takes every byte");
                text
            }
            Self::Tables => format!("{:#}\n", read_by_people(answer)).into_bytes(),
            Self::RobotFile => made(answer.robot_file())?,
            Self::Svg(what) => made(answer.drawn(what))?,
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

    /// Its row.
    ///
    /// # Panics
    /// Never: a test finds the row of every form there is.
    pub fn row(self) -> &'static FormRow {
        FORMS.iter().find(|row| row.form == self).expect("every form has a row")
    }

    /// The form of a word, or of the whole ending of a file: `shop`, `shop.svg`.
    pub fn of_word(word: &str) -> Option<Self> {
        let is_whole = !word.starts_with(['.', '-']);
        FORMS.iter().find(|row| row.word == word || is_whole && row.endings.contains(&word)).map(|row| row.form)
    }

    /// How its file is called that begins like this.
    pub fn file(self, stem: &str) -> String {
        format!("{stem}.{}", self.row().endings[0].trim_start_matches('.'))
    }

    /// It is made of the answer alone.
    pub fn is_of_answer(self) -> bool {
        !self.is_bytes() && !matches!(self, Self::Csv | Self::Md | Self::Txt)
    }

    /// It is no text.
    pub fn is_bytes(self) -> bool {
        matches!(self, Self::Parquet | Self::Png(_) | Self::Pdf(_) | Self::PrintedReport)
    }

    /// It is JSON, and no file that is kept.
    pub fn is_json(self) -> bool {
        matches!(self, Self::Json | Self::Tables)
    }

    /// It has the rows or the table of the answer, so that neither is printed beside it.
    pub fn holds_the_answer(self) -> bool {
        matches!(self, Self::Json | Self::Tables | Self::Csv | Self::Parquet | Self::Md | Self::Txt)
    }

    /// It is looked at.
    pub fn is_picture(self) -> bool {
        matches!(self, Self::Svg(_) | Self::Png(_) | Self::Pdf(_) | Self::View | Self::Report | Self::PrintedReport)
    }
}

impl Forms {
    /// Of a command whose answers are tables.
    pub const fn of(command: &'static str) -> Self {
        Self { command, makes: &[] }
    }

    /// It makes this.
    pub fn makes(&self, what: Makes) -> bool {
        self.makes.contains(&what)
    }

    /// It has this form.
    pub fn has(&self, form: Form) -> bool {
        match form {
            Form::Json | Form::Csv | Form::Parquet | Form::Md | Form::Txt | Form::Tables => true,
            Form::Svg(what) | Form::Png(what) | Form::Pdf(what) => self.makes(Makes::Picture(what)),
            Form::View | Form::Lines => self.makes(Makes::View),
            Form::Image => self.makes(Makes::Image),
            Form::RobotFile => self.makes(Makes::RobotFile),
            Form::Report | Form::PrintedReport => self.makes(Makes::Report),
            Form::Program(ending) => {
                self.makes.iter().any(|made| matches!(made, Makes::Programs(endings) if endings.contains(&ending)))
            }
        }
    }

    /// The form that a name asks for; nothing where there is none of it.
    pub fn form(&self, path: &Path) -> Option<Form> {
        let name = path.file_name().map(|name| name.to_string_lossy().to_ascii_lowercase())?;
        let is_said = |ending: &&str| match name.strip_suffix(*ending) {
            None => false,
            Some(before) if ending.starts_with(['.', '-']) => !before.is_empty(),
            Some(before) => before.is_empty() || before.ends_with('.'),
        };
        let longest =
            |row: &FormRow| row.endings.iter().filter(|ending| is_said(ending)).map(|ending| ending.len()).max();
        // What people read is a file of that name from nowhere but a server, and a view or a report that there is not is no other one.
        let is_own = |form: Form| matches!(form, Form::View | Form::PrintedReport) || self.has(form);
        let is_meant = |row: &&FormRow| row.form != Form::Tables && is_own(row.form);
        let said = FORMS.iter().filter(is_meant).filter_map(|row| Some((longest(row)?, row.form)));
        let (_, form) = said.max_by_key(|(length, _)| *length)?;
        self.has(form).then_some(form)
    }

    /// What names may end in, for whoever typed another.
    pub fn endings(&self) -> Vec<&'static str> {
        let rows = FORMS.iter().filter(|row| row.form != Form::Tables && self.has(row.form));
        let ending = |row: &FormRow| {
            let means_it = |ending: &&&str| {
                self.form(Path::new(&format!("a.{}", ending.trim_start_matches('.')))) == Some(row.form)
            };
            row.endings.iter().filter(means_it).min_by_key(|ending| !ending.starts_with('.')).copied()
        };
        rows.filter_map(ending).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Forms = Forms {
        command: "all",
        makes: &[
            Makes::Picture(Picture::Figure),
            Makes::View,
            Makes::Image,
            Makes::RobotFile,
            Makes::Programs(&["src", "nc"]),
            Makes::Report,
            Makes::Picture(Picture::Shop),
            Makes::Picture(Picture::Lobes),
        ],
    };

    #[test]
    fn a_name_asks_for_the_form_of_its_longest_ending() {
        let form = |forms: Forms, name: &str| forms.form(Path::new(name));
        for (name, meant) in [
            ("a.svg", Form::Svg(Picture::Figure)),
            ("out/A.SVG", Form::Svg(Picture::Figure)),
            ("shop.svg", Form::Svg(Picture::Shop)),
            ("a.shop.pdf", Form::Pdf(Picture::Shop)),
            ("workshop.svg", Form::Svg(Picture::Figure)),
            ("lobes.png", Form::Png(Picture::Lobes)),
            ("a.html", Form::Report),
            ("view.html", Form::View),
            ("a.view.html", Form::View),
            ("review.html", Form::Report),
            ("a.pdf", Form::Pdf(Picture::Figure)),
            ("report.pdf", Form::PrintedReport),
            ("a-report.pdf", Form::PrintedReport),
            ("areport.pdf", Form::Pdf(Picture::Figure)),
            ("a.tables.json", Form::Json),
            ("a.b.csv", Form::Csv),
            ("a.src", Form::Program("src")),
        ] {
            assert_eq!(form(ALL, name), Some(meant), "{name}");
        }
        for name in ["a", "svg", ".svg", "a.svgz", "a.svg.", "a.mod", ""] {
            assert_eq!(form(ALL, name), None, "{name}");
        }
        let few = Forms { command: "few", makes: &[Makes::Picture(Picture::Figure), Makes::Report] };
        assert_eq!(form(few, "shop.svg"), Some(Form::Svg(Picture::Figure)));
        assert_eq!((form(few, "a.html"), form(few, "a.view.html")), (Some(Form::Report), None));
        let view = Forms { command: "view", makes: &[Makes::View] };
        assert_eq!(
            (Form::of_word("shop"), Form::of_word("shop.svg")),
            (Some(Form::Svg(Picture::Shop)), Form::of_word("shop"))
        );
        assert_eq!((Form::of_word("html"), Form::of_word(".svg")), (None, None));
        assert_eq!((form(view, "a.html"), form(view, "report.pdf")), (Some(Form::View), None));
        let figure = Forms { command: "figure", makes: &[Makes::Picture(Picture::Figure)] };
        assert_eq!((form(figure, "a.pdf"), form(figure, "a.report.pdf")), (Some(Form::Pdf(Picture::Figure)), None));
    }

    #[test]
    fn every_form_has_a_row_and_every_file_the_name_that_asks_for_it() {
        for (i, row) in FORMS.iter().enumerate() {
            assert!(FORMS[..i].iter().all(|other| other.form != row.form && other.word != row.word), "{row:?}");
            assert_eq!(Form::of_word(row.word), Some(row.form));
            let is_made = !matches!(row.form, Form::Program(ending) if !["src", "nc"].contains(&ending));
            assert_eq!(ALL.has(row.form), is_made, "{row:?}");
            if is_made && row.form != Form::Tables {
                assert_eq!(ALL.form(Path::new(&row.form.file("place"))), Some(row.form), "{row:?}");
            }
        }
        for ending in ALL.endings() {
            assert!(ALL.form(Path::new(&format!("a.{}", ending.trim_start_matches('.')))).is_some(), "{ending}");
        }
        assert!(ALL.endings().starts_with(&[".svg", ".png", ".pdf", "view.html", ".vtp"]), "{:?}", ALL.endings());
        assert!(
            ALL.endings().contains(&".html")
                && Forms::of("few").endings() == [".json", ".csv", ".parquet", ".md", ".txt"]
        );
    }
}
