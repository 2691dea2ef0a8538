//! What does an answer rest on that was read: which files, byte by byte, and which process?

use std::fmt::Write as _;
use std::io::{self, Read};
use std::path::Path;

use crate::answer::{CuttingAnswer, Table};
use crate::request::Request;
use sha2::{Digest, Sha256};
use stiffarm::catalogue::files::{Unreadable, Why};
use stiffarm::catalogue::{ProcessFile, files, find, read_process_beside};

use crate::ask::context::{Context, PROCESS_FILE, faulty};
use crate::error::AskError;
use crate::report::Section;
use crate::sources::Sources;

/// Files that were named with a question, and where they are.
#[derive(Clone)]
pub(crate) struct Inputs {
    names: Vec<String>,
    process: Option<String>,
    sources: Sources,
}

impl Inputs {
    /// Those of a question.
    pub(crate) fn of(asked: &Request, context: Context) -> Self {
        Self { names: asked.files(), process: asked.given_process(), sources: context.sources.clone() }
    }

    /// What a command line must be given as files first.
    pub(crate) fn nowhere_else(&self) -> Vec<&str> {
        self.sources.nowhere_else()
    }

    /// The process with the force that it gives, and the names of the files that its own file names.
    fn read_process(&self) -> Result<Option<(CuttingAnswer, Vec<String>)>, AskError> {
        let Some(name) = &self.process else { return Ok(None) };
        let (path, mut further) = (Path::new(name), Vec::new());
        let mut beside = |other: &str| {
            further.push(files::beside(path, other).to_string_lossy().into_owned());
            let text = self.sources.text(&further[further.len() - 1]);
            text.map(std::borrow::Cow::into_owned).map_err(|failure| failure.to_string())
        };
        let file = files::shown(path);
        let read: Result<ProcessFile, _> = read_process_beside(&self.sources.text(name)?, &file, &mut beside);
        let process = read.map_err(|faults| faulty(&faults, PROCESS_FILE))?;
        let force = process.process.force().map_err(|error| AskError::unanswered(&file, error, PROCESS_FILE))?;
        Ok(Some((CuttingAnswer { file, process, force }, further)))
    }

    /// Tool, depths, feed, spindle, newtons and who says so; nothing where no process was given.
    pub(crate) fn process(&self) -> Result<Option<Section>, AskError> {
        let Some((answer, _)) = self.read_process()? else { return Ok(None) };
        let mut section = Section::new("The process");
        section.table(answer.table());
        section.notes(answer.notes().lines());
        Ok(Some(section))
    }

    /// Every file that was read and its digest; nothing where none was.
    pub(crate) fn files(&self) -> Result<Option<Table>, AskError> {
        let mut names: Vec<String> = Vec::new();
        for name in &self.names {
            let name = name.trim();
            if find(name).is_some() {
                continue; // of the catalogue, whatever lies beside
            }
            match self.sources.folder(name) {
                Some(inside) => names.extend(inside?.iter().map(|path| path.to_string_lossy().into_owned())),
                None if self.sources.holds(name) => names.push(name.into()),
                None => {} // robots of a pattern or a set, or a path built in
            }
        }
        names.extend(self.read_process()?.into_iter().flat_map(|(_, further)| further));
        if names.is_empty() {
            return Ok(None);
        }
        let mut table = Table::new(["file", "SHA-256"]);
        for name in names {
            let digest = digest(&mut self.sources.open(&name)?);
            let failed = |error: io::Error| Unreadable { path: name.clone().into(), why: Why::System(error) };
            table.row([files::shown(Path::new(&name)), digest.map_err(failed)?]);
        }
        Ok(Some(table))
    }
}

/// In hexadecimal.
fn digest(bytes: &mut dyn Read) -> io::Result<String> {
    let (mut hash, mut block) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        match bytes.read(&mut block)? {
            0 => break,
            count => hash.update(&block[..count]),
        }
    }
    Ok(hash.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first example of FIPS 180-2.
    #[test]
    fn a_digest_is_that_of_the_standard() {
        let hex = digest(&mut &b"abc"[..]).unwrap();
        assert_eq!(hex, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
