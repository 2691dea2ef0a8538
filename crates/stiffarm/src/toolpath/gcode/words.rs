//! A line of G-code to its words: letters with numbers, comments and blanks left out.

use std::ops::Range;

use super::super::fault::Wrong;

/// No block needs more of one kind.
const MOST_CODES: usize = 12;

/// A line of words, each letter at most once but for G and M.
#[derive(Clone, Debug)]
pub(super) struct Block {
    given: u32,
    values: [f64; 26],
    /// G codes in tenths: 431 is G43.1.
    pub(super) g: Codes,
    /// M codes in tenths.
    pub(super) m: Codes,
    /// It begins with `/`.
    pub(super) may_be_skipped: bool,
    /// A word of a position has no decimal point and is no zero: some machines read it as thousandths.
    pub(super) has_number_without_point: bool,
    /// The most decimals of a word of a position.
    pub(super) decimals: u8,
    pub(super) percent: Percent,
}

/// What `%` at the beginning of a line means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Percent {
    /// There is none.
    No,
    /// It stands alone: the program begins or ends.
    Alone,
    /// With the number of the program behind it.
    Numbered,
}

/// A few codes in the order in which they stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Codes {
    codes: [u16; MOST_CODES],
    count: usize,
}

impl Codes {
    pub(super) fn all(&self) -> &[u16] {
        &self.codes[..self.count]
    }
}

impl Block {
    pub(super) const fn new() -> Self {
        let none = Codes { codes: [0; MOST_CODES], count: 0 };
        Self {
            given: 0,
            values: [0.0; 26],
            g: none,
            m: none,
            may_be_skipped: false,
            has_number_without_point: false,
            decimals: 0,
            percent: Percent::No,
        }
    }

    /// The number behind a letter.
    pub(super) fn get(&self, letter: u8) -> Option<f64> {
        let at = usize::from(letter - b'A');
        (self.given & (1 << at) != 0).then(|| self.values[at])
    }

    pub(super) fn has(&self, letter: u8) -> bool {
        self.given & (1 << (letter - b'A')) != 0
    }

    pub(super) fn has_any(&self, letters: &[u8]) -> bool {
        letters.iter().any(|letter| self.has(*letter))
    }

    /// The letters there are besides G and M.
    pub(super) fn letters(&self) -> impl Iterator<Item = u8> {
        (b'A'..=b'Z').filter(|letter| self.has(*letter))
    }

    /// Neither a word nor a code.
    pub(super) fn is_empty(&self) -> bool {
        self.given == 0 && self.g.count == 0 && self.m.count == 0
    }

    /// Reads a line in place of what was there.
    ///
    /// # Errors
    /// What is no word of a letter and a number.
    pub(super) fn read(&mut self, line: &[u8]) -> Result<(), Wrong> {
        self.given = 0;
        (self.g.count, self.m.count) = (0, 0);
        (self.may_be_skipped, self.has_number_without_point) = (false, false);
        (self.decimals, self.percent) = (0, Percent::No);
        let mut at = 0;
        while at < line.len() {
            let byte = line[at].to_ascii_uppercase();
            match byte {
                b' ' | b'\t' | b'\r' => at += 1,
                b'A'..=b'Z' => at = self.word(byte, line, at)?,
                b'(' => at += comment(&line[at..])?,
                b';' => break,
                b'/' if self.is_empty() => {
                    self.may_be_skipped = true;
                    at += 1;
                    // Machines with several switches number them.
                    if line.get(at).is_some_and(u8::is_ascii_digit) {
                        at += 1;
                    }
                }
                b'%' if self.is_empty() && !self.may_be_skipped => {
                    self.percent = percent(&line[at..])?;
                    break;
                }
                b':' if self.is_empty() => at = self.word(b'O', line, at)?,
                b'#' | b'[' | b'=' | b'<' => {
                    let rest = String::from_utf8_lossy(&line[at..]);
                    return Err(Wrong::new(
                        rest,
                        "variables, expressions and macros are not computed; expected numbers",
                    ));
                }
                _ => {
                    let rest = String::from_utf8_lossy(&line[at..]);
                    return Err(Wrong::new(rest, "it is no word; expected a letter and a number, such as X1.5"));
                }
            }
        }
        Ok(())
    }

    /// Reads one word from its letter on; tells where the next begins.
    fn word(&mut self, letter: u8, line: &[u8], at: usize) -> Result<usize, Wrong> {
        let Number { value: number, decimals, end } = number(line, at + 1)?;
        let word = || String::from_utf8_lossy(&line[at..end]).into_owned();
        if line.get(end).is_some_and(|byte| matches!(byte, b'E' | b'e')) && is_quantity(letter) {
            let rest = String::from_utf8_lossy(&line[at..]).into_owned();
            let why = "an exponent, or E as a word of its own; expected decimals, and a blank before a word E";
            return Err(Wrong::new(rest, why));
        }
        match letter {
            b'G' | b'M' => {
                let tenths = (number * 10.0).round();
                if !(0.0..10_000.0).contains(&tenths) || 1e-6 < (tenths - number * 10.0).abs() {
                    return Err(Wrong::new(word(), "there is no such code; expected such as G1 or G43.4"));
                }
                let codes = if letter == b'G' { &mut self.g } else { &mut self.m };
                if codes.count == MOST_CODES {
                    return Err(Wrong::new(word(), format!("more than {MOST_CODES} codes in one block")));
                }
                codes.codes[codes.count] = tenths as u16;
                codes.count += 1;
            }
            _ => {
                let index = usize::from(letter - b'A');
                if self.given & (1 << index) != 0 {
                    return Err(Wrong::new(word(), format!("{} is given twice in one block", char::from(letter))));
                }
                if !(number.abs() <= 1e9) {
                    return Err(Wrong::new(word(), "a number beyond all machines; expected at most 1e9"));
                }
                self.given |= 1 << index;
                self.values[index] = number;
                if matches!(letter, b'X'..=b'Z' | b'I'..=b'K' | b'R') {
                    self.has_number_without_point |= decimals.is_none() && number != 0.0;
                    self.decimals = self.decimals.max(decimals.unwrap_or(0));
                }
            }
        }
        Ok(end)
    }
}

/// The length of a comment in parentheses.
fn comment(line: &[u8]) -> Result<usize, Wrong> {
    match line[1..].iter().position(|byte| matches!(byte, b'(' | b')')) {
        Some(at) if line[1 + at] == b')' => Ok(at + 2),
        Some(_) => {
            let why = "a comment within a comment: machines differ in where it ends; expected one ( and one )";
            Err(Wrong::new(String::from_utf8_lossy(line), why))
        }
        None => Err(Wrong::new("(", "the comment has no end; expected )")),
    }
}

/// What `%` and the rest of its line mean.
fn percent(line: &[u8]) -> Result<Percent, Wrong> {
    let mut rest = line[1..].trim_ascii();
    while rest.first() == Some(&b'(') {
        rest = rest[comment(rest)?..].trim_ascii();
    }
    if matches!(rest.first(), None | Some(b';')) {
        return Ok(Percent::Alone);
    }
    let number = rest.strip_prefix(b"O").or(rest.strip_prefix(b"o")).unwrap_or(rest);
    if !number.is_empty() && number.iter().all(u8::is_ascii_digit) {
        return Ok(Percent::Numbered);
    }
    let why = "text behind %: whether the program ends here is not known; expected % alone, and remarks in ( )";
    Err(Wrong::new(String::from_utf8_lossy(line), why))
}

/// Letters whose numbers are lengths, angles and speeds.
const fn is_quantity(letter: u8) -> bool {
    matches!(letter, b'A'..=b'C' | b'F' | b'I'..=b'K' | b'Q' | b'R' | b'U'..=b'Z')
}

/// A word where it stands in its line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placed {
    /// In capitals.
    pub(super) letter: u8,
    pub(super) number: f64,
    pub(super) span: Range<usize>,
}

/// The words of a line that [`Block::read`] has read, in their order.
///
/// # Errors
/// Where that refuses the line.
pub(super) fn placed(line: &[u8]) -> Result<Vec<Placed>, Wrong> {
    let (mut words, mut at) = (Vec::new(), 0);
    while at < line.len() {
        match line[at].to_ascii_uppercase() {
            letter @ b'A'..=b'Z' => {
                let Number { value: number, end, .. } = number(line, at + 1)?;
                words.push(Placed { letter, number, span: at..end });
                at = end;
            }
            b'(' => at += comment(&line[at..])?,
            b';' => break,
            _ => at += 1,
        }
    }
    Ok(words)
}

/// Powers of ten that are exact.
const TENS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// A number as it stands in a line.
struct Number {
    value: f64,
    /// Digits behind the decimal point; `None` without one.
    decimals: Option<u8>,
    end: usize,
}

/// A number with sign and decimal point, blanks before and within it.
///
/// Up to 15 digits make a whole number below 2^53, and that over an exact power of ten is rounded once: the nearest number.
fn number(line: &[u8], start: usize) -> Result<Number, Wrong> {
    let (mut whole, mut digits, mut decimals) = (0_u64, 0_usize, 0_usize);
    let (mut is_negative, mut has_sign, mut has_point) = (false, false, false);
    let (mut at, mut end) = (start, start);
    while let Some(&byte) = line.get(at) {
        at += 1;
        match byte {
            b'0'..=b'9' => {
                if 14 < digits {
                    return long(line, start);
                }
                whole = whole * 10 + u64::from(byte - b'0');
                digits += usize::from(whole != 0);
                decimals += usize::from(has_point);
            }
            b'.' if !has_point => has_point = true,
            b'+' | b'-' if !has_sign && !has_point && decimals == 0 && end == start => {
                has_sign = true;
                is_negative = byte == b'-';
            }
            b' ' | b'\t' => continue,
            _ => break,
        }
        end = at;
    }
    let has_digit = line[start..end].iter().any(u8::is_ascii_digit);
    if !has_digit {
        let word = String::from_utf8_lossy(&line[start - 1..(start + 12).min(line.len())]).into_owned();
        return Err(Wrong::new(word, "no number follows the letter; expected such as X1.5"));
    }
    if 15 < decimals {
        return long(line, start);
    }
    let size = whole as f64 / TENS[decimals];
    let value = if is_negative { -size } else { size };
    Ok(Number { value, decimals: has_point.then_some(decimals as u8), end })
}

/// The same for numbers of more digits than fit.
fn long(line: &[u8], start: usize) -> Result<Number, Wrong> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'+' | b'-' | b' ' | b'\t');
    let end = start + line[start..].iter().position(|byte| !is_part(byte)).unwrap_or(line.len() - start);
    let text: String =
        line[start..end].iter().filter(|byte| !byte.is_ascii_whitespace()).map(|b| char::from(*b)).collect();
    let value = text.parse().map_err(|_| Wrong::new(text.clone(), "it is no number; expected such as -1.5"))?;
    let decimals = text.split_once('.').map(|(_, behind)| behind.len().min(usize::from(u8::MAX)) as u8);
    Ok(Number { value, decimals, end })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Block {
        let mut block = Block::new();
        block.read(line.as_bytes()).unwrap_or_else(|wrong| panic!("{line}: {wrong:?}"));
        block
    }

    #[test]
    fn words_are_read_with_and_without_blanks_in_either_case() {
        let block = read("n0010G1x-1.5 Y+.25Z 3 (go x9) f 1 2 0.5 g43.4 M08;X7");
        assert_eq!((block.get(b'X'), block.get(b'Y'), block.get(b'Z')), (Some(-1.5), Some(0.25), Some(3.0)));
        assert_eq!((block.get(b'F'), block.get(b'N')), (Some(120.5), Some(10.0)));
        assert_eq!((block.g.all(), block.m.all()), (&[10, 434][..], &[80][..]));
        assert!(block.has_number_without_point && !read("X1. F3 Y0").has_number_without_point);
        assert!(read("/2 G0 X0").may_be_skipped && read("").is_empty());
        for (line, percent) in [
            ("%", Percent::Alone),
            (" % (a) ; b", Percent::Alone),
            ("%1234", Percent::Numbered),
            ("%O7", Percent::Numbered),
            ("G1", Percent::No),
        ] {
            assert_eq!(read(line).percent, percent, "{line}");
        }
        assert_eq!((read("X1. Y2.50 F1.2345").decimals, read("X1").decimals), (2, 0));
        assert!(read(" ( X1 ) ").is_empty());
        assert_eq!(read(":12").get(b'O'), Some(12.0));
        // E with a blank before it, or behind a letter that takes whole numbers, is a word of its own.
        assert_eq!((read("X1 E5").get(b'E'), read("G187P2E.02").get(b'E')), (Some(5.0), Some(0.02)));
    }

    #[test]
    fn numbers_are_the_nearest_ones() {
        for text in [
            "0",
            "-0.1",
            "123.456",
            "0.000001",
            "99999.99999",
            "1.7976931348",
            "123456789.123456789",
            "0.1234567890123456789",
            "000000000000000000001.5",
            "5.00000000000000000000",
        ] {
            let found = read(&format!("X{text}")).get(b'X').unwrap();
            assert_eq!(found, text.parse::<f64>().unwrap(), "{text}");
        }
    }

    #[test]
    fn what_is_no_word_is_refused_with_its_name() {
        for (line, word, why) in [
            ("X", "X", "no number follows"),
            ("XY1", "XY1", "no number follows"),
            ("X-", "X-", "no number follows"),
            ("X1X2", "X2", "given twice"),
            ("(open", "(", "no end"),
            ("G1 (a (b) c) X1", "(a (b) c) X1", "a comment within a comment"),
            ("% LED ON", "% LED ON", "text behind %"),
            ("X#1", "X#1", "no number"),
            ("#1=2", "#1=2", "variables"),
            ("X[1+2]", "X[1+2]", "no number"),
            ("G1.23", "G1.23", "no such code"),
            ("G-1", "G-1", "no such code"),
            ("X1.5E-5", "X1.5E-5", "an exponent"),
            ("f1e3", "f1e3", "an exponent"),
            ("X99999999999999999999", "X99999999999999999999", "beyond all machines"),
            ("X1-2", "-2", "no word"),
            ("X1.2.3", ".3", "no word"),
            ("\u{fc}", "\u{fc}", "no word"),
        ] {
            let mut block = Block::new();
            let wrong = block.read(line.as_bytes()).expect_err(line);
            assert!(wrong.word.contains(word) && wrong.why.contains(why), "{line}: {wrong:?}");
        }
    }
}
