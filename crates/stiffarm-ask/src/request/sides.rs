//! What is asked of each of two setups that are compared: its job file first, then what is asked of both.

use std::path::Path;

use super::job::{self, Job};
use super::{Pair, Refusal, Request, Spelling, Verb, opt};
use stiffarm::catalogue::files::{self, Unreadable};

/// A setup of which nothing can be asked.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// Its file is not read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// What is asked makes no sense of it.
    #[error(transparent)]
    Refusal(#[from] Refusal),
}

impl Request {
    /// The two setups that are compared: names of robots, or paths of robot files or job files.
    ///
    /// # Errors
    /// Where one is missing.
    pub fn setups(&self) -> Result<[String; 2], Refusal> {
        Ok([self.required(opt::A)?, self.required(opt::B)?])
    }

    /// What is asked of a setup, as of [`Verb::Place`]: by its job file where it is one, else of the robot of this name or file.
    ///
    /// # Errors
    /// Where its file is not read, or what is asked makes no sense of it.
    pub fn of_setup(&self, setup: &str) -> Result<Self, SetupError> {
        let path = Path::new(setup.trim());
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            let text = files::text(path)?;
            if job::is_job(&text) {
                let reader = Spelling::Key { file: files::shown(path), line: None };
                return Ok(self.of_job(job::read(&text, path)?, reader)?);
            }
        }
        Ok(self.of_robot(setup)?)
    }

    /// What is asked of a setup that is a robot, as of [`Verb::Place`].
    ///
    /// # Errors
    /// Where it makes no sense of this setup.
    pub fn of_robot(&self, robot: &str) -> Result<Self, Refusal> {
        let mut pairs = vec![Pair { name: "robot".into(), text: robot.into(), at: self.reader.clone() }];
        pairs.extend(self.common(|_| true));
        Self::read(Verb::Place, &pairs, self.reader.clone())
    }

    /// The same of a setup that is a job, which overrules what is asked of both.
    ///
    /// # Errors
    /// Where it is a job for another verb, or makes no sense together with what is asked of both.
    pub fn of_job(&self, job: Job, reader: Spelling) -> Result<Self, Refusal> {
        if job.verb != Verb::Place {
            let why = format!("a job for {}; compare takes jobs for place", job.verb.name());
            return Err(Refusal::Job { at: reader, why });
        }
        let says = |pair: &Pair, name: &str| {
            pair.name == name || Verb::Place.setting(&pair.name).is_some_and(|row| row.excludes.contains(&name))
        };
        let mut pairs = self.common(|name| !job.pairs.iter().any(|pair| says(pair, name)));
        pairs.extend(job.pairs);
        Self::read(Verb::Place, &pairs, reader)
    }

    /// What is asked of both under some names.
    fn common(&self, is_meant: impl Fn(&str) -> bool) -> Vec<Pair> {
        let of_both = self.given.iter().filter(|given| !given.setting.is_positional && is_meant(given.setting.name));
        let pairs = of_both.flat_map(|given| {
            let name = if given.at == Spelling::Keyword { given.setting.keyword() } else { given.setting.name.into() };
            given.texts.iter().map(move |text| Pair { name: name.clone(), text: text.clone(), at: given.at.clone() })
        });
        pairs.collect()
    }
}
