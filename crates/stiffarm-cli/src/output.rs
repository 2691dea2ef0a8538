//! Where answers go: standard output, or files that are open before anything is computed and appear whole or not at all.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf, is_separator};

use atomic_write_file::AtomicWriteFile;
use stiffarm::plain::on_its_lines;
use stiffarm_ask::answer::Rows;
use stiffarm_ask::ask::AskError;
use stiffarm_ask::forms::{Answer, Form, Forms, Piece};
use stiffarm_ask::sources::target::target;

use crate::columns::write_parquet;
use crate::common::{Common, Format};
use crate::failure::Failure;
use crate::look::{Look, say};
use crate::pdf;
use crate::progress::watched;
use crate::raster;
use crate::signals;
use crate::table::{text, write_csv};

/// The files that were asked for. Without them no answer is delivered, so none is computed that could not be written.
pub(crate) struct Outputs<'a> {
    common: &'a Common,
    files: Vec<(&'a Path, Form, Sink)>,
    /// The job file, with its text.
    job: Option<(&'a Path, &'a str, Sink)>,
}

/// Where the bytes of a file go.
enum Sink {
    /// Into a file without a name, which takes its place when it is whole; a signal leaves nothing of it.
    Atomic(AtomicWriteFile),
    /// Into a pipe or device that is there.
    Straight,
}

impl<'a> Outputs<'a> {
    /// Opens every file that was asked for; none of them is read, [`Sources`](stiffarm_ask::sources::Sources) sees to that.
    ///
    /// # Errors
    /// Where an ending is not known, a folder is missing or closed to us, or two of them are one file.
    pub(crate) fn open(common: &'a Common, forms: Forms) -> Result<Self, Failure> {
        let (mut files, mut targets) = (Vec::new(), Vec::new());
        let mut sink = |path: &Path| {
            let (target, sink) = sink(path)?;
            let is_twice = matches!(sink, Sink::Atomic(_)) && targets.contains(&target);
            targets.push(target);
            if is_twice { Err(Failure::Twice(path.into())) } else { Ok(sink) }
        };
        for path in &common.output {
            if path.as_os_str() == "-" {
                return Err(Failure::Dash);
            }
            files.push((path.as_path(), known(forms, path)?, sink(path)?));
        }
        let job = match &common.saved {
            Some((path, text)) => Some((path.as_path(), text.as_str(), sink(path)?)),
            None => None,
        };
        Ok(Self { common, files, job })
    }

    /// What is written to them.
    pub(crate) fn forms(&self) -> impl Iterator<Item = Form> {
        self.files.iter().map(|(_, form, _)| *form)
    }

    /// Prints an answer and writes it to every file; what cannot be written is printed, so that it is not lost. What was asked is written once it is
    /// answered.
    pub(crate) fn deliver(self, answer: &dyn Answer) -> Result<(), Failure> {
        let Self { common, files, job } = self;
        // What is asked for by its format is printed, whatever else is written.
        let is_in_a_file = common.quiet && !files.is_empty() || files.iter().any(|(_, form, _)| holds(answer, *form));
        let is_printed = common.format != Format::Table || !is_in_a_file;
        let mut written = Vec::new();
        let mut failed: Vec<(Form, Failure)> = Vec::new();
        for (path, form, sink) in files {
            match watched("writing", common, |_| write(answer, (path, form), sink)) {
                Ok(()) => written.push(path),
                Err(failure) => failed.push((form, failure)),
            }
        }
        let printed = match failed.first() {
            Some((form, _)) => print(&Body::printable(answer, *form, common.format)),
            None if is_printed => print(&Body::of_stdout(answer, common.format)),
            None => Ok(()),
        };
        let mut failures: Vec<Failure> = failed.into_iter().map(|(_, failure)| failure).collect();
        if let Some((path, text, sink)) = job {
            match put(text, path, sink) {
                Ok(()) => written.push(path),
                Err(failure) => failures.push(failure),
            }
        }
        if !common.quiet {
            // A file that machines read is no reason not to know what the answer is.
            if let (false, true, Some(headline)) = (is_printed, failures.is_empty(), answer.headline()) {
                say(&format!("{}: {}", headline.outcome.word(), headline.sentences.join(" ")));
            }
            for path in written {
                say(&format!("wrote {}", path.display()));
            }
        }
        let mut failures = failures.into_iter();
        let Some(first) = failures.next() else { return printed };
        for further in failures {
            say(&format!("error: {further}"));
        }
        Err(first)
    }
}

/// A file of this form has what would be printed: the answer, or its rows, or a robot file that is the answer.
fn holds(answer: &dyn Answer, form: Form) -> bool {
    let is_verbatim = || answer.text().iter().all(|piece| matches!(piece, Piece::Verbatim(_)));
    form.holds_the_answer() || form == Form::RobotFile && is_verbatim()
}

/// What an answer says of what was asked, also where its reader has seen enough and gone.
pub(crate) fn verdict(delivered: Result<(), Failure>, holds: Result<(), Failure>) -> Result<(), Failure> {
    match delivered {
        Ok(()) | Err(Failure::ClosedPipe) => holds,
        failed => failed,
    }
}

/// The form that a name asks for, where the command makes it.
///
/// # Errors
/// Where it does not, with the endings of those that it makes.
pub(crate) fn known(forms: Forms, path: &Path) -> Result<Form, Failure> {
    let unknown = || Failure::Ending { command: forms.command, path: path.into(), expected: forms.endings() };
    forms.form(path).ok_or_else(unknown)
}

/// Writes a form that the answer has.
///
/// # Errors
/// Where there is nothing to draw, or `out` takes no more.
pub(crate) fn write_as(answer: &dyn Answer, form: Form, mut out: &mut (dyn Write + Send)) -> Result<(), Failure> {
    let failure = |error| Failure::Write { path: form.file(answer.forms().command).into(), error };
    Body::of_file(answer, form)?.write(&mut out).map_err(failure)
}

/// Opens one file, whatever it points to, and says which one that is.
fn sink(path: &Path) -> Result<(PathBuf, Sink), Failure> {
    let failure = |error| Failure::Write { path: path.into(), error };
    // A name with a separator behind it is that of a folder, whatever its ending.
    let last = path.as_os_str().to_string_lossy();
    if last.trim_end_matches('.').ends_with(is_separator) {
        return Err(failure(io::ErrorKind::IsADirectory.into()));
    }
    let target = target(path).map_err(failure)?;
    let sink = match fs::metadata(&target) {
        Ok(found) if found.is_dir() => Err(failure(io::ErrorKind::IsADirectory.into())),
        Ok(found) if !found.is_file() => Ok(Sink::Straight),
        Ok(found) if found.permissions().readonly() => Err(failure(io::ErrorKind::PermissionDenied.into())),
        _ => AtomicWriteFile::open(&target).map(Sink::Atomic).map_err(failure),
    };
    sink.map(|sink| (target, sink))
}

/// Writes a text to a file, whole or not at all.
///
/// # Errors
/// Where the file cannot be written.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let (_, sink) = sink(path)?;
    put(text, path, sink)
}

/// The same to a file that is open.
fn put(text: &str, path: &Path, sink: Sink) -> Result<(), Failure> {
    let written = match sink {
        Sink::Straight => {
            fs::OpenOptions::new().write(true).open(path).and_then(|mut file| file.write_all(text.as_bytes()))
        }
        Sink::Atomic(mut file) => file.write_all(text.as_bytes()).and_then(|()| signals::waiting(|| file.commit())),
    };
    written.map_err(|error| Failure::Write { path: path.into(), error })
}

fn write(answer: &dyn Answer, (path, form): (&Path, Form), sink: Sink) -> Result<(), Failure> {
    let body = Body::of_file(answer, form)?;
    let write = || match sink {
        Sink::Straight => body.write(&mut fs::OpenOptions::new().write(true).open(path)?),
        Sink::Atomic(mut file) => {
            body.write(file.as_file_mut())?;
            signals::waiting(|| file.commit())
        }
    };
    write().map_err(|error| Failure::Write { path: path.into(), error })
}

/// An answer in one form. Tables and JSON are made while they are written: maps are larger than memory.
enum Body<'a> {
    Bytes(Vec<u8>),
    Json(&'a dyn Answer),
    Csv(Rows<'a>),
    Parquet(Rows<'a>, &'static str),
}

impl<'a> Body<'a> {
    /// As it stands on standard output, which may be a terminal.
    fn of_stdout(answer: &'a dyn Answer, format: Format) -> Self {
        if format != Format::Table {
            return Self::of_format(answer, format);
        }
        let look = Look::of_stdout();
        Self::Bytes(look.coloured(&on_its_lines(&text(&answer.text(), look))).into_owned().into())
    }

    fn of_format(answer: &'a dyn Answer, format: Format) -> Self {
        match format {
            Format::Table => Self::Bytes(on_its_lines(&text(&answer.text(), Look::PLAIN)).into_owned().into()),
            Format::Md => Self::Bytes(on_its_lines(&text(&answer.markdown(), Look::MARKDOWN)).into_owned().into()),
            Format::Json => Self::Json(answer),
            Format::Csv => Self::Csv(answer.rows()),
        }
    }

    /// In the form that the file's name asks for, which was found to be one of this command's.
    fn of_file(answer: &'a dyn Answer, form: Form) -> Result<Self, Failure> {
        Ok(match form {
            Form::Json => Self::of_format(answer, Format::Json),
            Form::Csv => Self::of_format(answer, Format::Csv),
            Form::Md => Self::of_format(answer, Format::Md),
            Form::Txt => Self::of_format(answer, Format::Table),
            Form::Parquet => Self::Parquet(answer.rows(), answer.forms().command),
            Form::Png(what) => Self::Bytes(raster::png(&picture(answer.drawn(what))?, answer.figure_size().pixels())?),
            Form::Pdf(what) => Self::Bytes(raster::pdf(&picture(answer.drawn(what))?)?),
            Form::PrintedReport => Self::Bytes(pdf::of(&picture(answer.report())?)?),
            form => Self::Bytes(form.text(answer)?.unwrap_or_default()),
        })
    }

    /// What stands for a file that could not be written: its own text, the table for its columns, and the usual for a picture.
    fn printable(answer: &'a dyn Answer, form: Form, usual: Format) -> Self {
        match form {
            Form::Json => Self::of_format(answer, Format::Json),
            Form::Csv | Form::Parquet => Self::of_format(answer, Format::Csv),
            Form::Md => Self::of_format(answer, Format::Md),
            Form::RobotFile => match answer.robot_file() {
                Some(Ok(text)) => Self::Bytes(text.into()),
                _ => Self::of_stdout(answer, usual),
            },
            _ => Self::of_stdout(answer, usual),
        }
    }

    fn write(&self, out: &mut (impl Write + Send)) -> io::Result<()> {
        let mut out = BufWriter::new(out);
        match self {
            Self::Bytes(bytes) => out.write_all(bytes)?,
            Self::Json(answer) => answer.json(&mut out)?,
            Self::Csv(rows) => write_csv(rows, &mut out)?,
            Self::Parquet(rows, command) => write_parquet(rows, command, &mut out)?,
        }
        out.flush()
    }
}

/// A picture of a kind that the command has said it can make.
fn picture<T>(made: Option<Result<T, AskError>>) -> Result<T, Failure> {
    Ok(made.unwrap_or_else(|| Err(AskError::Figure("there is nothing to draw".into())))?)
}

/// Writes a text to standard output as it is.
///
/// # Errors
/// Where standard output is closed or full.
pub(crate) fn print_text(text: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout();
    out.write_all(text).and_then(|()| out.flush()).map_err(of_stdout)
}

fn of_stdout(error: io::Error) -> Failure {
    if error.kind() == io::ErrorKind::BrokenPipe { Failure::ClosedPipe } else { Failure::Stdout(error) }
}

/// Writes to standard output.
fn print(body: &Body) -> Result<(), Failure> {
    body.write(&mut io::stdout()).map_err(of_stdout)
}
