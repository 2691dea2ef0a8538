//! What was assumed about a file, and which of its words move nothing: each reported once, with the line that came first.

use std::collections::HashMap;

/// More kinds of words than any file has; what comes after is counted together.
const MOST_KINDS: usize = 200;

/// What a reader has to say besides moves.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes {
    assumed: Vec<(String, usize)>,
    ignored: Vec<Inert>,
    places: HashMap<String, usize>,
    further: usize,
}

/// A kind of word that moves nothing.
#[derive(Clone, Debug)]
struct Inert {
    word: String,
    first: usize,
    count: usize,
}

impl Notes {
    /// A choice that the file leaves open; reported once.
    pub(super) fn assume(&mut self, line: usize, what: &str) {
        if !self.assumed.iter().any(|(known, _)| known == what) {
            self.assumed.push((what.to_owned(), line));
        }
    }

    /// A word that moves nothing.
    pub(super) fn ignore(&mut self, line: usize, word: &str) {
        self.ignore_all(line, 1, word);
    }

    /// The same for one that stood there several times.
    pub(super) fn ignore_all(&mut self, first: usize, count: usize, word: &str) {
        if let Some(&at) = self.places.get(word) {
            self.ignored[at].count += count;
        } else if self.ignored.len() < MOST_KINDS {
            self.places.insert(word.to_owned(), self.ignored.len());
            self.ignored.push(Inert { word: word.to_owned(), first, count });
        } else {
            self.further += count;
        }
    }

    pub(super) fn assumed(&self) -> Vec<String> {
        let with_line = |(what, line): &(String, usize)| match line {
            0 => what.clone(),
            line => format!("{what} (line {line})"),
        };
        self.assumed.iter().map(with_line).collect()
    }

    pub(super) fn ignored(&self) -> Vec<String> {
        let with_count = |Inert { word, first, count }: &Inert| match count {
            1 => format!("{word} (line {first})"),
            count => format!("{word} ({count} times, first in line {first})"),
        };
        let mut lines: Vec<String> = self.ignored.iter().map(with_count).collect();
        if 0 < self.further {
            lines.push(format!("{} further words", self.further));
        }
        lines
    }
}
