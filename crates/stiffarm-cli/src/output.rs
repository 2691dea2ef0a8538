//! Where answers go: standard output, or files that appear whole or not at all.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;
use serde_json::Value;

use crate::args::{Common, Format};
use crate::columns::parquet;
use crate::failure::Failure;
use crate::figures::view3d::View;
use crate::table::Table;

/// An answer in every form it can take. Each is made only when asked for.
pub(crate) trait Answer {
    /// The command's name, for errors.
    const COMMAND: &'static str;
    /// For people.
    fn text(&self, markdown: bool) -> String;
    /// For programs.
    fn json(&self) -> Value;
    /// For spreadsheets, and as typed columns for data frames.
    fn csv(&self) -> Table;
    /// A robot file, where the command makes one.
    fn robot_file(&self) -> Option<String> {
        None
    }
    /// A figure as SVG, where the command has one.
    fn svg(&self) -> Option<Result<String, Failure>> {
        None
    }
    /// What can be turned in space, where the command has that.
    fn view(&self) -> Option<Result<View, Failure>> {
        None
    }
}

/// Prints an answer and writes it to every file asked for.
pub(crate) fn deliver<A: Answer>(answer: &A, common: &Common) -> Result<(), Failure> {
    for path in &common.output {
        write_file(path, &contents(answer, path)?)?;
    }
    let only_data_file = common.format == Format::Table && common.output.iter().any(|path| !is_picture(path));
    if !(only_data_file || common.quiet && !common.output.is_empty()) {
        let text = match common.format {
            Format::Table => answer.text(false),
            Format::Md => answer.text(true),
            Format::Json => json_text(&answer.json()),
            Format::Csv => answer.csv().csv(),
        };
        print(&text)?;
    }
    if !common.quiet {
        for path in &common.output {
            eprintln!("wrote {}", path.display());
        }
    }
    Ok(())
}

/// Refuses what cannot be written wherever it comes from, before anything is computed.
pub(crate) fn check(paths: &[PathBuf]) -> Result<(), Failure> {
    for path in paths {
        if path.as_os_str() == "-" {
            return Err(Failure::Dash);
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(error) = folder.and_then(|folder| fs::metadata(folder).err()) {
            return Err(Failure::Write { path: path.clone(), error });
        }
    }
    Ok(())
}

fn is_picture(path: &Path) -> bool {
    matches!(ending(path).as_str(), "svg" | "png" | "html")
}

fn ending(path: &Path) -> String {
    path.extension().and_then(OsStr::to_str).unwrap_or_default().to_ascii_lowercase()
}

fn contents<A: Answer>(answer: &A, path: &Path) -> Result<Vec<u8>, Failure> {
    match ending(path).as_str() {
        "json" => return Ok(json_text(&answer.json()).into_bytes()),
        "csv" => return Ok(answer.csv().csv().into_bytes()),
        "parquet" => return Ok(parquet(&answer.csv(), A::COMMAND)),
        "md" => return Ok(answer.text(true).into_bytes()),
        "txt" => return Ok(answer.text(false).into_bytes()),
        "toml" => {
            if let Some(text) = answer.robot_file() {
                return Ok(text.into_bytes());
            }
        }
        picture @ ("svg" | "png") => {
            if let Some(svg) = answer.svg() {
                let svg = svg?;
                return if picture == "svg" {
                    Ok(svg.into_bytes())
                } else {
                    crate::figures::png(&svg, 2.0).map_err(figure)
                };
            }
        }
        "html" => {
            if let Some(view) = answer.view() {
                return Ok(view?.html().into_bytes());
            }
        }
        _ => {}
    }
    let pictures = if answer.svg().is_some() { ".svg, .png, " } else { "" };
    let robot_file = if answer.robot_file().is_some() { ".toml, " } else { "" };
    let views = if answer.view().is_some() { ".html, " } else { "" };
    let expected = format!("{robot_file}{pictures}{views}.json, .csv, .parquet, .md or .txt");
    Err(Failure::Ending { command: A::COMMAND, path: path.into(), expected })
}

/// A figure's error as a failure.
#[expect(clippy::needless_pass_by_value, reason = "used with map_err")]
pub(crate) fn figure(error: crate::figures::FigureError) -> Failure {
    Failure::Figure(error.to_string())
}

fn json_text(value: &Value) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("a JSON value is always text");
    text.push('\n');
    text
}

/// Writes a file whole or not at all: through a link to what it points to, and straight into a pipe or device.
fn write_file(path: &Path, contents: &[u8]) -> Result<(), Failure> {
    let write = || {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.into());
        if fs::metadata(&target).is_ok_and(|found| !found.is_file()) {
            return fs::write(&target, contents);
        }
        let mut file = AtomicWriteFile::open(target)?;
        file.write_all(contents)?;
        file.commit()
    };
    write().map_err(|error| Failure::Write { path: path.into(), error })
}

/// Writes to standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
        _ => Failure::Stdout(error),
    })
}
