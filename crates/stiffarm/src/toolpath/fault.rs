//! Why is a toolpath refused, and where?

use std::io;

use crate::plain::on_one_line;
use crate::watch::Stopped;

/// A file of which no path is made: the line, the word, and what was expected.
#[derive(Debug, thiserror::Error)]
pub enum PathFault {
    /// A word that cannot be modelled, or makes no sense.
    #[error("{file}:{line}: {word}: {why}")]
    Refused {
        /// The file as the user named it.
        file: String,
        /// From 1.
        line: usize,
        /// The word or statement.
        word: String,
        /// What is wrong and what was expected.
        why: String,
    },
    /// A file with nothing in it that moves the tool.
    #[error("{file}: {why}")]
    Empty {
        /// The file as the user named it.
        file: String,
        /// What was expected.
        why: String,
    },
    /// It cannot be read to its end.
    #[error("{file}:{line}: cannot read on: {error}")]
    Input {
        /// The file as the user named it.
        file: String,
        /// The line that could not be read.
        line: usize,
        /// Why.
        error: io::Error,
    },
    /// What is made of it cannot be written.
    #[error("{file}:{line}: what is made of it cannot be written: {error}")]
    Output {
        /// The file as the user named it.
        file: String,
        /// The line that was to be written.
        line: usize,
        /// Why.
        error: io::Error,
    },
    /// It is no longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// A built-in path that cannot be understood.
    #[error("path '{text}' is not understood: {why}")]
    Notation {
        /// What was given.
        text: String,
        /// What was expected.
        why: String,
    },
}

/// A word and what is wrong with it; file and line are known to who reads lines.
#[derive(Debug)]
pub(super) struct Wrong {
    pub(super) word: String,
    pub(super) why: String,
    /// Where it stands, if not in the line that is read.
    pub(super) line: Option<usize>,
}

impl Wrong {
    pub(super) fn new(word: impl Into<String>, why: impl Into<String>) -> Self {
        Self { word: word.into(), why: why.into(), line: None }
    }

    /// Of a line that was kept, and runs later; the innermost one is reported.
    pub(super) fn in_line(self, line: usize) -> Self {
        Self { line: self.line.or(Some(line)), ..self }
    }

    pub(super) fn at(self, file: &str, line: usize) -> PathFault {
        let line = self.line.unwrap_or(line);
        PathFault::Refused { file: file.into(), line, word: shown(&self.word), why: self.why }
    }
}

/// Of the file, before what is wrong there; nothing of a path built in.
pub(crate) fn of_line(line: usize) -> String {
    if line == 0 { String::new() } else { format!("line {line}: ") }
}

/// A text from a file as it may stand in a message: short and on one line.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 60;
    let short: String = text.chars().take(MOST).collect();
    let more = if text.chars().nth(MOST).is_some() { "..." } else { "" };
    format!("{}{more}", on_one_line(&short))
}
