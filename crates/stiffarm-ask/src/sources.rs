//! From where does what is named come: from files of this machine, or from what came with the question?
//!
//! Whoever asks from elsewhere names robots of the catalogue, and texts that came along: no name that was sent leads to a disk. Whoever asks
//! here reads no file that is to be written: every file that is opened is an input, and is not lost to its own answer.

pub mod target;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use stiffarm::catalogue;
use stiffarm::catalogue::files::{self, Loaded, shown};
use stiffarm::robot::Robot;
use stiffarm::toolpath::{self, Builtin, Format, Move, ReadOptions, Understood, read_toolpath};
use stiffarm::watch::Stopped;

use self::target::{is_same, target};
use crate::error::AskError;
use crate::request::{Request, Spelling, job};

/// What holds the robots and texts that are named: first what came along, then the disks of this machine where they may be read.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    /// Under the names by which they are meant.
    robots: BTreeMap<String, Robot>,
    texts: BTreeMap<String, String>,
    disk: Option<Disk>,
}

/// The disks of this machine, but for what is written.
#[derive(Clone, Debug)]
struct Disk {
    /// Names under which the command writes.
    written: Vec<PathBuf>,
}

impl Sources {
    /// The disks of this machine, of which nothing is read that is written under these names.
    pub fn disk(written: Vec<PathBuf>) -> Self {
        Self { disk: Some(Disk { written }), ..Self::default() }
    }

    /// Texts that came along, under their names, and no disk.
    pub fn sent(texts: BTreeMap<String, String>) -> Self {
        Self { texts, ..Self::default() }
    }

    /// The same with a robot that is at hand, meant by this name whatever it is called.
    #[must_use]
    pub fn with_robot(mut self, name: &str, robot: Robot) -> Self {
        self.robots.insert(name.into(), robot);
        self
    }

    /// The same with a text that is at hand.
    #[must_use]
    pub fn with_text(mut self, name: &str, text: String) -> Self {
        self.texts.insert(name.into(), text);
        self
    }

    /// The robot at hand that this name means.
    pub fn robot_named(&self, name: &str) -> Option<&Robot> {
        self.robots.get(name)
    }

    /// Names of which a command line knows nothing: robots and texts that came along where there is a disk, too.
    pub fn nowhere_else(&self) -> Vec<&str> {
        if self.disk.is_none() {
            return Vec::new();
        }
        let is_own =
            |(name, robot): &(&String, &Robot)| catalogue::find(name).is_none_or(|entry| entry.robot() != **robot);
        let robots = self.robots.iter().filter(is_own).map(|(name, _)| name.as_str());
        robots.chain(self.texts.keys().map(String::as_str)).collect()
    }

    /// Refuses what is written, under whatever name.
    ///
    /// # Errors
    /// Where the file is one of those.
    pub fn check_unwritten(&self, read: &Path) -> Result<(), AskError> {
        let Some(Disk { written }) = &self.disk else { return Ok(()) };
        // What has no target cannot be written, and is refused where it is opened for that.
        let lost = written.iter().find(|path| target(path).is_ok_and(|target| is_same(read, &target)));
        lost.map_or(Ok(()), |path| Err(AskError::OntoInput(path.clone())))
    }

    /// Refuses what would be read as a robot with the others of this folder.
    fn check_apart(&self, folder: &Path) -> Result<(), AskError> {
        let Some(Disk { written }) = &self.disk else { return Ok(()) };
        let is_inside = |path: &PathBuf| {
            files::is_robot_file(path)
                && target(path).is_ok_and(|target| target.parent().is_some_and(|parent| is_same(folder, parent)))
        };
        let inside = written.iter().find(|path| is_inside(path));
        inside.map_or(Ok(()), |path| Err(AskError::AmongRobots(path.clone())))
    }

    /// A text of this name.
    ///
    /// # Errors
    /// Where there is none, or the file is not read.
    pub fn text(&self, name: &str) -> Result<Cow<'_, str>, AskError> {
        if let Some(text) = self.at_hand(name) {
            return Ok(text.into());
        }
        self.check_disk(name)?;
        Ok(files::text(Path::new(name))?.into())
    }

    /// The bytes of this name: one more than `most` of them where there are more. Bytes that are no text come along as `data:;base64,...`.
    ///
    /// # Errors
    /// As [`Sources::text`]; base64 that is none.
    pub fn bytes(&self, name: &str, most: usize) -> Result<Cow<'_, [u8]>, AskError> {
        if let Some(text) = self.at_hand(name) {
            let packed = text.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,"));
            let Some((_, packed)) = packed else { return Ok(text.as_bytes().into()) };
            let broken = |error| AskError::Usage(format!("{}: broken base64: {error}", shown(Path::new(name))));
            return Ok(STANDARD.decode(packed.trim()).map_err(broken)?.into());
        }
        self.check_disk(name)?;
        Ok(files::bytes(Path::new(name), most)?.into())
    }

    /// A text that came along.
    fn at_hand(&self, name: &str) -> Option<&str> {
        let text = self.texts.get(name.trim())?;
        // The mark that some editors put before UTF-8, as of files.
        Some(text.strip_prefix('\u{feff}').unwrap_or(text))
    }

    /// May this be read from a disk?
    fn check_disk(&self, name: &str) -> Result<(), AskError> {
        if self.disk.is_none() {
            return Err(AskError::NotSent(shown(Path::new(name))));
        }
        self.check_unwritten(Path::new(name))
    }

    /// Is there a text or a folder of this name?
    pub fn holds(&self, name: &str) -> bool {
        self.texts.contains_key(name.trim()) || self.disk.is_some() && Path::new(name).exists()
    }

    /// Must this be a robot's file, whether it is there or not?
    pub fn is_file_name(&self, name: &str) -> bool {
        self.disk.is_some() && files::is_robot_file(Path::new(name))
    }

    /// The robot files of a folder; nothing where this is none.
    pub fn folder(&self, name: &str) -> Option<Result<Vec<PathBuf>, AskError>> {
        let path = Path::new(name);
        let is_folder = self.disk.is_some() && path.is_dir();
        is_folder.then(|| self.check_apart(path).and_then(|()| Ok(files::robot_files(path)?)))
    }

    /// The robot in a file.
    ///
    /// # Errors
    /// Where there is no such file, or it has faults.
    pub fn robot(&self, name: &Path) -> Result<Loaded, AskError> {
        let path = name.to_string_lossy();
        if let Some(text) = self.at_hand(&path) {
            return Ok(files::load_text(text, name)?);
        }
        self.check_disk(&path)?;
        Ok(files::load(name)?)
    }

    /// What is asked of one of two setups, which may be a job file.
    ///
    /// # Errors
    /// Where the job file is not read, or asks what cannot be asked of a setup.
    pub fn setup(&self, name: &str, asked: &Request) -> Result<Request, AskError> {
        match self.texts.get(name.trim()) {
            Some(text) if job::is_job(text) => {
                let reader = Spelling::Key { file: shown(Path::new(name)), line: None };
                Ok(asked.of_job(job::read_sent(text, name)?, reader)?)
            }
            None if self.disk.is_some() && self.robot_named(name).is_none() => {
                self.check_unwritten(Path::new(name.trim()))?;
                Ok(asked.of_setup(name)?)
            }
            _ => Ok(asked.of_robot(name)?),
        }
    }

    /// A toolpath, to be read bit by bit.
    ///
    /// # Errors
    /// Where there is none.
    pub fn open(&self, name: &str) -> Result<Box<dyn BufRead + '_>, AskError> {
        if let Some(text) = self.at_hand(name) {
            return Ok(Box::new(text.as_bytes()));
        }
        self.check_disk(name)?;
        Ok(Box::new(BufReader::new(files::open(Path::new(name))?)))
    }

    /// Hands over the moves of a toolpath, as [`read_toolpath`].
    ///
    /// # Errors
    /// Where there is none, or it is not understood.
    pub fn moves(
        &self,
        (name, format): (&str, Format),
        options: &ReadOptions,
        each: &mut dyn FnMut(&Move),
        far: &mut dyn FnMut(u64, u64) -> Result<(), Stopped>,
    ) -> Result<Option<Understood>, AskError> {
        let Some(text) = self.at_hand(name).filter(|_| !Builtin::is_meant(name)) else {
            if !Builtin::is_meant(name) {
                self.check_disk(name)?;
            }
            return Ok(read_toolpath(name, format, options, each, far)?);
        };
        let mut far = |read: toolpath::Progress| far(read.bytes, text.len() as u64);
        Ok(Some(toolpath::read(&mut text.as_bytes(), &shown(Path::new(name)), format, options, each, &mut far)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_sent_is_nowhere_wherever_it_is_on_disk() {
        let sources = Sources::sent(BTreeMap::from([("mine.toml".into(), "\u{feff}name".into())]));
        assert_eq!(sources.text(" mine.toml ").unwrap(), "name");
        for name in
            ["Cargo.toml", "/etc/passwd", "../stiffarm/robots/paper/kawasaki_bt200l.toml", ".", "/", "", "./mine.toml"]
        {
            assert!(matches!(sources.text(name), Err(AskError::NotSent(_))), "{name}");
            assert!(sources.open(name).is_err() && sources.robot(Path::new(name)).is_err(), "{name}");
            assert!(!sources.holds(name) && !sources.is_file_name(name) && sources.folder(name).is_none(), "{name}");
        }
        let here = Sources::disk(Vec::new());
        assert!(here.holds("Cargo.toml") && here.folder("src").is_some(), "they are there");
    }

    #[test]
    fn what_a_command_line_does_not_know_is_named() {
        let usual = catalogue::find("BT200L").unwrap().robot();
        let softer = catalogue::with_compliance(&usual, [2.0; 6]).unwrap();
        let sources = Sources::disk(Vec::new()).with_robot("BT200L", usual).with_robot("BT200L (2)", softer.clone());
        assert_eq!(sources.nowhere_else(), ["BT200L (2)"]);
        let sources = sources.with_robot("BT200L", softer).with_text("the data frame", String::new());
        assert_eq!(sources.nowhere_else(), ["BT200L", "BT200L (2)", "the data frame"]);
    }

    #[test]
    fn bytes_that_are_no_text_come_along_in_base64() {
        let texts = [("a.stl", "data:model/stl;base64,AP+A"), ("b.stl", "solid"), ("c.stl", "data:;base64,!")];
        let sources = Sources::sent(texts.map(|(name, text)| (name.into(), text.into())).into());
        assert_eq!(*sources.bytes("a.stl", 9).unwrap(), [0, 255, 128]);
        assert_eq!(*sources.bytes("b.stl", 9).unwrap(), *b"solid");
        assert!(sources.bytes("c.stl", 9).unwrap_err().to_string().starts_with("c.stl: broken base64"));
    }

    #[test]
    fn what_came_along_goes_before_what_is_on_disk() {
        let sources = Sources::disk(Vec::new()).with_text("Cargo.toml", "mine".into());
        assert_eq!(sources.text("Cargo.toml").unwrap(), "mine");
    }
}
