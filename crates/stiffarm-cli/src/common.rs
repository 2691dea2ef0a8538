//! What is a matter of the program and not of the question: where answers go and in which form, threads, who waits.
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units and defaults in brackets")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, ValueEnum};
use stiffarm::toolpath::MOST_SAMPLES;
use stiffarm_ask::request::{Pair, Refusal, job};
use stiffarm_ask::sources::Sources;

use crate::client::Client;
use crate::failure::Failure;
use crate::options::CHECK;

#[derive(Debug, Args)]
pub(crate) struct Common {
    /// Format of what goes to standard output
    #[arg(long, value_enum, default_value_t = Format::Table, global = true, display_order = 900)]
    pub(crate) format: Format,
    /// Write to a file; its ending chooses the format: .csv, .parquet, .json, .md, .txt, a figure as .svg, .png or .pdf, a
    /// report as .html or report.pdf, or a view in space as view.html. May be given several times
    #[arg(short, long = "output", value_name = "FILE", global = true, display_order = 901)]
    pub(crate) output: Vec<PathBuf>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = threads, global = true, display_order = 902)]
    pub(crate) threads: Option<usize>,
    /// No progress, no remarks
    #[arg(short, long, global = true, display_order = 903)]
    pub(crate) quiet: bool,
    /// What does not hold is a failure.
    #[arg(skip)]
    pub(crate) check: bool,
    /// The job file that is to be written, and what will stand in it.
    #[arg(skip)]
    pub(crate) saved: Option<(PathBuf, String)>,
    /// Where what is named comes from.
    #[arg(skip)]
    pub(crate) sources: Sources,
    /// Into how many samples a path may be cut.
    #[arg(skip = MOST_SAMPLES)]
    pub(crate) most_samples: usize,
    /// Who waits, where it is not the one before this terminal.
    #[arg(skip)]
    pub(crate) client: Option<Arc<Client>>,
}

impl Common {
    /// Nothing of what was asked but the threads.
    pub(crate) fn bare(&self) -> Self {
        Self { threads: self.threads, ..Self::usual() }
    }

    /// As if nothing of it were asked.
    pub(crate) fn usual() -> Self {
        Self {
            format: Format::Table,
            output: Vec::new(),
            threads: None,
            quiet: false,
            check: false,
            saved: None,
            sources: Sources::disk(Vec::new()),
            most_samples: MOST_SAMPLES,
            client: None,
        }
    }

    /// The disks of this machine, of which nothing is read that is written.
    pub(crate) fn disk(&self) -> Sources {
        let saved = self.saved.iter().map(|(path, _)| path);
        Sources::disk(self.output.iter().chain(saved).cloned().collect())
    }

    /// Takes what a job file says of the program, where nothing else was typed.
    pub(crate) fn take(&mut self, pairs: &[Pair], typed: &ArgMatches) -> Result<(), Failure> {
        let is_typed = |name: &str| name != CHECK && typed.value_source(name) == Some(ValueSource::CommandLine);
        for Pair { name, text, at } in pairs.iter().filter(|pair| !is_typed(&pair.name)) {
            let wrong = |expected: String| {
                let why = format!("invalid value '{}' for '{name}': {expected}", stiffarm::plain::on_one_line(text));
                Refusal::Job { at: at.clone(), why }
            };
            match name.as_str() {
                "output" => self.output.push(text.into()),
                "threads" => self.threads = Some(threads(text).map_err(wrong)?),
                "check" => self.check |= text.parse::<bool>().map_err(|_| wrong("expected true or false".into()))?,
                "quiet" => self.quiet = text.parse().map_err(|_| wrong("expected true or false".into()))?,
                _ => {
                    let expected = |_| wrong("expected table, json, csv or md".into());
                    self.format = Format::from_str(text, false).map_err(expected)?;
                }
            }
        }
        Ok(())
    }

    /// What stands in a job file of it.
    pub(crate) fn entries(&self, file: &Path) -> Vec<(&'static str, String)> {
        let mut entries = Vec::new();
        let format = self.format.to_possible_value();
        if let Some(format) = format.filter(|_| self.format != Format::Table) {
            entries.push(("format", format!("\"{}\"", format.get_name())));
        }
        if !self.output.is_empty() {
            let folder = file.parent().unwrap_or(Path::new(""));
            // A path also where it is a bare name.
            let seen = |path: &PathBuf| job::seen_from(folder, &Path::new(".").join(path).to_string_lossy());
            let files: Vec<String> = self.output.iter().map(|path| job::text(&seen(path))).collect();
            entries.push(("output", format!("[{}]", files.join(", "))));
        }
        entries.extend(self.threads.map(|threads| ("threads", threads.to_string())));
        entries.extend(self.quiet.then(|| ("quiet", "true".into())));
        entries.extend(self.check.then(|| ("check", "true".into())));
        entries
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Table,
    Json,
    Csv,
    Md,
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads @ 1..=1024) => Ok(threads),
        _ => Err("expected a whole number from 1 to 1024".into()),
    }
}
