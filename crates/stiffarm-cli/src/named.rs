//! Which form of an answer does a file's name ask for? Decided here and nowhere else.
//!
//! The ending chooses. Two endings stand for two things each: `.html` is a report where the verb makes one, and the view that can be turned
//! elsewhere; `view.html` and `*.view.html` are that view wherever there is one. `.pdf` is the figure; `report.pdf`, `*.report.pdf` and `*-report.pdf`
//! are the report on paper. `shop.svg` and `*.shop.svg`, and the same as `.png` and `.pdf`, are the drawing of where the work must stand.

use std::ffi::OsStr;
use std::path::Path;

use crate::output::Answer;

/// Endings of the files that every answer can be written to.
const TABLES: [&str; 5] = ["json", "csv", "parquet", "md", "txt"];

/// In which form an answer is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Form {
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
    /// What is handed on, to be read on a screen or printed.
    Report,
    /// The same as pages.
    PrintedReport,
    /// What a machine reads, by its ending.
    Program(String),
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drawn {
    /// The figure of the answer.
    Figure,
    /// Where the work must stand, as a shop drawing has it.
    Shop,
}

impl Form {
    /// It is looked at, so that the table is printed beside it.
    pub(crate) fn is_picture(&self) -> bool {
        matches!(self, Self::Svg(_) | Self::Png(_) | Self::Pdf(_) | Self::View | Self::Report | Self::PrintedReport)
    }
}

/// The form that a name asks for; nothing where the verb cannot make it.
pub(crate) fn form<A: Answer>(path: &Path) -> Option<Form> {
    let stem = path.file_stem().and_then(OsStr::to_str).unwrap_or_default().to_ascii_lowercase();
    let ending = path.extension().and_then(OsStr::to_str).unwrap_or_default().to_ascii_lowercase();
    let is_named = |what: &str| stem == what || stem.ends_with(&format!(".{what}"));
    let is_known = |ending: &str| A::FURTHER.contains(&ending);
    let drawn = if A::IS_SITED && is_named("shop") { Drawn::Shop } else { Drawn::Figure };
    Some(match ending.as_str() {
        "json" => Form::Json,
        "csv" => Form::Csv,
        "parquet" => Form::Parquet,
        "md" => Form::Md,
        "txt" => Form::Txt,
        "html" if A::IS_REPORTED && !is_named("view") => Form::Report,
        "pdf" if A::IS_REPORTED && (is_named("report") || stem.ends_with("-report")) => Form::PrintedReport,
        ending if !is_known(ending) => return None,
        "html" => Form::View,
        "toml" => Form::RobotFile,
        "svg" => Form::Svg(drawn),
        "png" => Form::Png(drawn),
        "pdf" => Form::Pdf(drawn),
        ending => Form::Program(ending.into()),
    })
}

/// What names may end in, for whoever typed another.
pub(crate) fn endings<A: Answer>() -> Vec<String> {
    let mut endings: Vec<String> = Vec::new();
    for ending in A::FURTHER {
        let is_view = A::IS_REPORTED && *ending == "html";
        endings.push(if is_view { ".view.html".into() } else { format!(".{ending}") });
    }
    if A::IS_REPORTED {
        endings.extend([".html".to_owned(), "report.pdf".into()]);
    }
    if A::IS_SITED {
        endings.push("shop.svg".into());
    }
    endings.extend(TABLES.map(|ending| format!(".{ending}")));
    endings
}
