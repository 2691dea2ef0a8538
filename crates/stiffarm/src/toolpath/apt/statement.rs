//! A statement of APT: what stands before the stroke, and the words and numbers behind it.

use super::super::fault::Wrong;

/// No statement has more parts.
const MOST_PARTS: usize = 200;

/// One part behind the stroke.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    Number(f64),
    /// In capital letters.
    Word(String),
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Statement {
    /// In capital letters, such as `GOTO`.
    pub(super) name: String,
    pub(super) parts: Vec<Part>,
}

impl Statement {
    /// Reads one statement without its comment.
    ///
    /// # Errors
    /// More parts than any has.
    pub(super) fn of(text: &str) -> Result<Self, Wrong> {
        let (name, rest) = text.split_once('/').unwrap_or((text, ""));
        let name = name.trim().to_ascii_uppercase();
        let parts: Vec<Part> = if rest.trim().is_empty() {
            Vec::new()
        } else {
            rest.split(',').take(MOST_PARTS + 1).map(|part| part_of(part.trim())).collect()
        };
        if MOST_PARTS < parts.len() {
            return Err(Wrong::new(name, format!("more than {MOST_PARTS} parts")));
        }
        Ok(Self { name, parts })
    }

    /// All parts as numbers.
    ///
    /// # Errors
    /// A part that is none, or as many numbers as are not expected.
    pub(super) fn numbers(&self, counts: &[usize]) -> Result<Vec<f64>, Wrong> {
        let numbers: Result<Vec<f64>, Wrong> = self.parts.iter().map(|part| self.number(part)).collect();
        let numbers = numbers?;
        if counts.contains(&numbers.len()) {
            return Ok(numbers);
        }
        let expected: Vec<String> = counts.iter().map(ToString::to_string).collect();
        let why = format!("{} numbers; expected {}", numbers.len(), expected.join(" or "));
        Err(Wrong::new(self.name.clone(), why))
    }

    fn number(&self, part: &Part) -> Result<f64, Wrong> {
        match part {
            Part::Number(number) if number.abs() <= 1e9 => Ok(*number),
            Part::Number(number) => {
                Err(Wrong::new(self.name.clone(), format!("a number of {number}; expected at most 1e9")))
            }
            Part::Word(word) => Err(Wrong::new(self.name.clone(), format!("'{word}' is no number"))),
        }
    }

    /// The words among its parts.
    pub(super) fn words(&self) -> impl Iterator<Item = &str> {
        self.parts.iter().filter_map(|part| if let Part::Word(word) = part { Some(word.as_str()) } else { None })
    }

    /// The first number.
    pub(super) fn first_number(&self) -> Option<f64> {
        self.parts.iter().find_map(|part| if let Part::Number(number) = part { Some(*number) } else { None })
    }
}

/// A number, or a word.
fn part_of(text: &str) -> Part {
    let looks_like_one = text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    match text.parse() {
        Ok(number) if looks_like_one => Part::Number(number),
        _ => Part::Word(text.to_ascii_uppercase()),
    }
}
