//! The lines of a file one after the other, in bounded memory, whatever stands in it.

use std::io::BufRead;
use std::ops::Range;

use super::fault::{PathFault, Wrong};

/// No machine reads longer lines, bytes.
const LONGEST: usize = 1 << 16;

/// Reads lines; tells how far it is.
pub(super) struct Lines<'a> {
    input: &'a mut dyn BufRead,
    file: &'a str,
    buffer: Vec<u8>,
    /// Where in the buffer the line stands without its end.
    text: Range<usize>,
    /// Of the line read last, from 1.
    pub(super) number: usize,
    /// Read so far.
    pub(super) bytes: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn of(input: &'a mut dyn BufRead, file: &'a str) -> Self {
        Self { input, file, buffer: Vec::new(), text: 0..0, number: 0, bytes: 0 }
    }

    /// The next line without its end (CR, LF or CR LF), and its number from 1; `None` after the last one.
    ///
    /// # Errors
    /// A line that is too long or holds a zero byte: no text. What the system refuses.
    pub(super) fn next(&mut self) -> Result<Option<(usize, &[u8])>, PathFault> {
        self.buffer.clear();
        self.number += 1;
        loop {
            let found = self.input.fill_buf().map_err(|error| PathFault::Input {
                file: self.file.into(),
                line: self.number,
                error,
            })?;
            // A line feed behind a carriage return may come with the next bytes.
            let (taken, is_whole) = if self.buffer.last() == Some(&b'\r') {
                (usize::from(found.first() == Some(&b'\n')), true)
            } else {
                match found.iter().position(|byte| matches!(byte, b'\n' | b'\r')) {
                    Some(at) => (at + 1, found[at] == b'\n'),
                    None => (found.len(), found.is_empty()),
                }
            };
            if LONGEST < self.buffer.len() + taken {
                return Err(self.wrong(format!("it is longer than {LONGEST} bytes; expected a toolpath as text")));
            }
            self.buffer.extend_from_slice(&found[..taken]);
            self.input.consume(taken);
            self.bytes += taken as u64;
            if is_whole {
                break;
            }
        }
        if self.buffer.is_empty() {
            self.number -= 1;
            return Ok(None);
        }
        if self.buffer.contains(&0) {
            return Err(self.wrong("it holds a zero byte; expected a toolpath as text (UTF-8 or ASCII)".into()));
        }
        let start = if self.number == 1 && self.buffer.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        self.text = start..start + self.buffer[start..].trim_ascii_end().len();
        Ok(Some((self.number, &self.buffer[self.text.clone()])))
    }

    /// The line read last, as it stands in the file: what stands before its text, the text, its end.
    pub(super) fn last(&self) -> [&[u8]; 3] {
        let (rest, ending) = self.buffer.split_at(self.text.end);
        let (mark, text) = rest.split_at(self.text.start);
        [mark, text, ending]
    }

    fn wrong(&self, why: String) -> PathFault {
        Wrong::new("the line", why).at(self.file, self.number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever part of a file comes at once.
    #[test]
    fn cr_lf_and_cr_lf_each_end_one_line() {
        let text = b"a \r\nb\rc\n\rd\r\r\n\n";
        let expected = [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, "d"), (6, ""), (7, "")];
        for capacity in 1..=text.len() {
            let mut input = std::io::BufReader::with_capacity(capacity, &text[..]);
            let (mut lines, mut whole) = (Lines::of(&mut input, "x"), Vec::new());
            for (number, line) in expected {
                assert_eq!(lines.next().unwrap().unwrap(), (number, line.as_bytes()), "{capacity}");
                whole.extend(lines.last().concat());
            }
            assert!(lines.next().unwrap().is_none());
            assert_eq!((lines.bytes, &whole[..]), (text.len() as u64, &text[..]), "{capacity}");
        }
    }

    #[test]
    fn lines_come_without_their_ends_and_too_long_ones_are_refused() {
        let mut text: &[u8] = b"\xef\xbb\xbfa \r\n\nb";
        let mut lines = Lines::of(&mut text, "x");
        for expected in [(1, &b"a"[..]), (2, b""), (3, b"b")] {
            assert_eq!(lines.next().unwrap().unwrap(), expected);
        }
        assert!(lines.next().unwrap().is_none());
        assert_eq!((lines.number, lines.bytes), (3, 9));
        let long = vec![b'x'; LONGEST + 2];
        let mut long = long.as_slice();
        assert!(Lines::of(&mut long, "x").next().unwrap_err().to_string().starts_with("x:1: the line: it is longer"));
        let mut zero: &[u8] = b"a\0b";
        assert!(Lines::of(&mut zero, "x").next().unwrap_err().to_string().contains("zero byte"));
    }
}
