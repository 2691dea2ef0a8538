//! From where does what is named come: from files of this machine, or from texts that came with the question?
//!
//! Whoever asks from elsewhere names robots of the catalogue, and texts that came along. No name that was sent leads to a disk. Whoever asks here
//! reads no file that is to be written: every file that is opened is an input, and is not lost to its own answer.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::BufRead;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use stiffarm::catalogue::files::{self, Loaded, shown};
use stiffarm::toolpath::{self, Builtin, Format, Move, ReadOptions, Understood, read_toolpath};
use stiffarm::watch::Stopped;
use stiffarm_ask::request::{Request, Spelling, job};

use crate::failure::Failure;
use crate::target::{is_same, target};

/// What holds the texts that are named.
#[derive(Clone, Debug)]
pub(crate) enum Shelf {
    /// The disks of this machine, but for what is written.
    Disk {
        /// Names under which the command writes.
        written: Vec<PathBuf>,
    },
    /// What came along, under its names.
    Sent(BTreeMap<String, String>),
}

impl Default for Shelf {
    fn default() -> Self {
        Self::Disk { written: Vec::new() }
    }
}

impl Shelf {
    /// Refuses what is written, under whatever name.
    pub(crate) fn check_unwritten(&self, read: &Path) -> Result<(), Failure> {
        let Self::Disk { written } = self else { return Ok(()) };
        // What has no target cannot be written, and is refused where it is opened for that.
        let lost = written.iter().find(|path| target(path).is_ok_and(|target| is_same(read, &target)));
        lost.map_or(Ok(()), |path| Err(Failure::OntoInput(path.clone())))
    }

    /// Refuses what would be read as a robot with the others of this folder.
    fn check_apart(&self, folder: &Path) -> Result<(), Failure> {
        let Self::Disk { written } = self else { return Ok(()) };
        let is_inside = |path: &PathBuf| {
            files::is_robot_file(path)
                && target(path).is_ok_and(|target| target.parent().is_some_and(|parent| is_same(folder, parent)))
        };
        let inside = written.iter().find(|path| is_inside(path));
        inside.map_or(Ok(()), |path| Err(Failure::AmongRobots(path.clone())))
    }

    /// A text of this name.
    pub(crate) fn text(&self, name: &str) -> Result<Cow<'_, str>, Failure> {
        self.check_unwritten(Path::new(name))?;
        match self {
            Self::Disk { .. } => Ok(files::text(Path::new(name))?.into()),
            Self::Sent(_) => Ok(self.sent(name)?.into()),
        }
    }

    fn sent(&self, name: &str) -> Result<&str, Failure> {
        let missing = || Failure::NotSent(shown(Path::new(name)));
        let Self::Sent(texts) = self else { return Err(missing()) };
        let text = texts.get(name.trim()).ok_or_else(missing)?;
        // The mark that some editors put before UTF-8, as of files.
        Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
    }

    /// Is there a text or a folder of this name?
    pub(crate) fn holds(&self, name: &str) -> bool {
        match self {
            Self::Disk { .. } => Path::new(name).exists(),
            Self::Sent(texts) => texts.contains_key(name.trim()),
        }
    }

    /// Must this be a robot's file, whether it is there or not?
    pub(crate) fn is_file_name(&self, name: &str) -> bool {
        matches!(self, Self::Disk { .. }) && files::is_robot_file(Path::new(name))
    }

    /// The robot files of a folder; nothing where this is none.
    pub(crate) fn folder(&self, name: &str) -> Option<Result<Vec<PathBuf>, Failure>> {
        let path = Path::new(name);
        let is_folder = matches!(self, Self::Disk { .. }) && path.is_dir();
        is_folder.then(|| self.check_apart(path).and_then(|()| Ok(files::robot_files(path)?)))
    }

    /// The robot in a file.
    pub(crate) fn robot(&self, name: &Path) -> Result<Loaded, Failure> {
        self.check_unwritten(name)?;
        match self {
            Self::Disk { .. } => Ok(files::load(name)?),
            Self::Sent(_) => Ok(files::load_text(self.sent(&name.to_string_lossy())?, Path::new(name))?),
        }
    }

    /// What is asked of one of two setups, which may be a job file.
    pub(crate) fn setup(&self, name: &str, asked: &Request) -> Result<Request, Failure> {
        let Self::Sent(texts) = self else {
            self.check_unwritten(Path::new(name.trim()))?;
            return Ok(asked.of_setup(name)?);
        };
        match texts.get(name.trim()) {
            Some(text) if job::is_job(text) => {
                let reader = Spelling::Key { file: shown(Path::new(name)), line: None };
                Ok(asked.of_job(job::read_sent(text, name)?, reader)?)
            }
            _ => Ok(asked.of_robot(name)?),
        }
    }

    /// A toolpath, to be read bit by bit.
    pub(crate) fn open(&self, name: &str) -> Result<Box<dyn BufRead + '_>, Failure> {
        self.check_unwritten(Path::new(name))?;
        match self {
            Self::Disk { .. } => Ok(Box::new(BufReader::new(files::open(Path::new(name))?))),
            Self::Sent(_) => Ok(Box::new(self.sent(name)?.as_bytes())),
        }
    }

    /// Hands over the moves of a toolpath, as [`read_toolpath`].
    pub(crate) fn moves(
        &self,
        (name, format): (&str, Format),
        options: &ReadOptions,
        each: &mut dyn FnMut(&Move),
        told: &mut dyn FnMut(u64, u64) -> Result<(), Stopped>,
    ) -> Result<Option<Understood>, Failure> {
        if matches!(self, Self::Disk { .. }) || Builtin::is_meant(name) {
            self.check_unwritten(Path::new(name))?;
            return Ok(read_toolpath(name, format, options, each, told)?);
        }
        let text = self.sent(name)?;
        let mut told = |far: toolpath::Progress| told(far.bytes, text.len() as u64);
        Ok(Some(toolpath::read(&mut text.as_bytes(), &shown(Path::new(name)), format, options, each, &mut told)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_sent_is_on_no_shelf_wherever_it_is_on_disk() {
        let shelf = Shelf::Sent(BTreeMap::from([("mine.toml".into(), "\u{feff}name".into())]));
        assert_eq!(shelf.text(" mine.toml ").unwrap(), "name");
        for name in
            ["Cargo.toml", "/etc/passwd", "../stiffarm/robots/paper/kawasaki_bt200l.toml", ".", "/", "", "./mine.toml"]
        {
            assert!(matches!(shelf.text(name), Err(Failure::NotSent(_))), "{name}");
            assert!(shelf.open(name).is_err() && shelf.robot(Path::new(name)).is_err(), "{name}");
            assert!(!shelf.holds(name) && !shelf.is_file_name(name) && shelf.folder(name).is_none(), "{name}");
        }
        assert!(Shelf::default().holds("Cargo.toml") && Shelf::default().folder("src").is_some(), "they are there");
    }
}
