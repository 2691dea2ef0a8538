//! A block whose words are changed where they stand.

use super::super::emitted::Line;
use super::super::fault::Wrong;
use super::words::{Placed, placed};

/// What becomes of a word.
pub(super) enum Fate {
    Kept,
    Number(String),
    Dropped,
}

/// A block that is edited: its words, and what becomes of each.
pub(super) struct Edit<'a> {
    text: &'a [u8],
    pub(super) words: Vec<(Placed, Fate)>,
    /// Words that were not there.
    pub(super) new: Vec<String>,
}

impl<'l> Edit<'l> {
    pub(super) fn of(line: &Line<'l>) -> Result<Self, Wrong> {
        let words = placed(line.text)?.into_iter().map(|word| (word, Fate::Kept)).collect();
        Ok(Self { text: line.text, words, new: Vec::new() })
    }

    /// Gives a letter another number, where it stands or as a new word.
    pub(super) fn set(&mut self, letter: u8, number: String) {
        match self.words.iter_mut().find(|(word, _)| word.letter == letter) {
            Some((_, fate)) => *fate = Fate::Number(number),
            None => self.new.push(format!("{}{number}", char::from(letter))),
        }
    }

    /// The block with its words as they are now. New ones stand behind the last word of a place, else where the first one was that is
    /// dropped, else behind the last code.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let last = |letters: &[u8]| self.words.iter().rposition(|(word, _)| letters.contains(&word.letter));
        let dropped = self.words.iter().position(|(_, fate)| matches!(fate, Fate::Dropped));
        let behind = last(b"XYZ").or(dropped).or(last(b"G")).or(last(b"N"));
        let is_spaced =
            self.words.windows(2).any(|pair| pair[0].0.span.end < pair[1].0.span.start) || self.words.len() < 2;
        let gap: &[u8] = if is_spaced { b" " } else { b"" };
        let mut bytes = Vec::new();
        let add = |bytes: &mut Vec<u8>| {
            for word in &self.new {
                if bytes.last().is_some_and(|byte| !byte.is_ascii_whitespace()) {
                    bytes.extend_from_slice(gap);
                }
                bytes.extend_from_slice(word.as_bytes());
            }
        };
        let mut at = 0;
        for (i, (word, fate)) in self.words.iter().enumerate() {
            let before = &self.text[at..word.span.start];
            let is_blank = before.iter().all(u8::is_ascii_whitespace);
            if !(is_blank && matches!(fate, Fate::Dropped)) {
                bytes.extend_from_slice(before);
            }
            match fate {
                Fate::Kept => bytes.extend_from_slice(&self.text[word.span.clone()]),
                Fate::Number(number) => {
                    bytes.push(self.text[word.span.start]);
                    bytes.extend_from_slice(number.as_bytes());
                }
                Fate::Dropped => {}
            }
            if behind == Some(i) {
                add(&mut bytes);
            }
            at = word.span.end;
        }
        bytes.extend_from_slice(&self.text[at..]);
        bytes.truncate(bytes.trim_ascii_end().len());
        bytes
    }
}
