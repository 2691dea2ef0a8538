//! How is an answer shown? Plain or as Markdown, so wide as there is room, in colour where somebody sees it.

use std::borrow::Cow;
use std::io::{self, IsTerminal, Write};

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use stiffarm::plain::on_its_lines;
use terminal_size::{Width, terminal_size_of};

/// Narrower than this, lines are longer than the room there is.
const NARROWEST: usize = 60;

/// How text is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Look {
    /// Markdown, in which lines are as long as they are.
    pub(crate) markdown: bool,
    /// So many letters fit a line; any number where `None`, as in files and pipes.
    pub(crate) width: Option<usize>,
    /// With escape sequences.
    pub(crate) colour: bool,
}

impl Look {
    /// Of files.
    pub(crate) const PLAIN: Self = Self { markdown: false, width: None, colour: false };
    /// Of files, and of whoever asks for it.
    pub(crate) const MARKDOWN: Self = Self { markdown: true, width: None, colour: false };

    /// Of standard output: `COLUMNS` where it is set, the terminal's width where there is one; `NO_COLOR` is obeyed.
    pub(crate) fn of_stdout() -> Self {
        let stdout = io::stdout();
        let asked = std::env::var("COLUMNS").ok().and_then(|columns| columns.trim().parse().ok());
        let width = asked.or_else(|| terminal_size_of(&stdout).map(|(Width(width), _)| usize::from(width)));
        let colour = AutoStream::choice(&stdout) != ColorChoice::Never;
        Self { markdown: false, width: width.map(|width| width.max(NARROWEST)), colour }
    }

    /// Of standard error, where somebody looks at it.
    pub(crate) fn of_stderr() -> Self {
        let stderr = io::stderr();
        let width = terminal_size_of(&stderr).map(|(Width(width), _)| usize::from(width).max(NARROWEST));
        let colour = stderr.is_terminal() && AutoStream::choice(&stderr) != ColorChoice::Never;
        Self { markdown: false, width, colour }
    }

    /// Each line broken where it is longer than there is room for; what follows the first stands two letters in.
    pub(crate) fn wrapped(self, text: &str) -> Cow<'_, str> {
        let Some(width) = self.width.filter(|width| text.lines().any(|line| *width < line.chars().count())) else {
            return text.into();
        };
        let options = textwrap::Options::new(width).subsequent_indent("  ").break_words(false);
        let lines = text.lines().map(|line| textwrap::wrap(line, &options).join("\n"));
        let end = if text.ends_with('\n') { "\n" } else { "" };
        (lines.collect::<Vec<_>>().join("\n") + end).into()
    }

    /// Verdicts in colour: what passes green, what fails red, and what went wrong.
    pub(crate) fn coloured(self, text: &str) -> Cow<'_, str> {
        if !self.colour {
            return text.into();
        }
        let mut shown = String::with_capacity(text.len() + 64);
        let mut rest = text;
        while let Some((before, word, style, after)) = first_verdict(rest) {
            shown.extend([before, &style.to_string(), word, &format!("{style:#}")]);
            rest = after;
        }
        (shown + rest).into()
    }
}

/// Words that are shown in colour.
const VERDICTS: [(&str, AnsiColor); 7] = [
    ("pass, not sure", AnsiColor::Yellow),
    ("pass", AnsiColor::Green),
    ("fail", AnsiColor::Red),
    ("no place", AnsiColor::Red),
    ("error:", AnsiColor::Red),
    ("warning:", AnsiColor::Yellow),
    ("hint:", AnsiColor::Cyan),
];

/// The first of them that stands alone: what is before it, the word, its style, what is after it.
fn first_verdict(text: &str) -> Option<(&str, &str, Style, &str)> {
    let alone = |at: usize, word: &str| {
        let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '-' || c == '_');
        !is_letter(text[..at].chars().next_back()) && !is_letter(text[at + word.len()..].chars().next())
    };
    let found = VERDICTS.iter().filter_map(|(word, colour)| {
        let (at, _) = text.match_indices(word).find(|(at, _)| alone(*at, word))?;
        Some((at, *word, *colour))
    });
    let (at, word, colour) = found.min_by_key(|(at, ..)| *at)?;
    Some((&text[..at], word, Style::new().fg_color(Some(colour.into())), &text[at + word.len()..]))
}

/// Talks to the user, beside the answer.
pub(crate) fn say(text: &str) {
    let look = Look::of_stderr();
    let lines = look.coloured(&look.wrapped(&on_its_lines(text))).into_owned() + "\n";
    // Where standard error is closed or full, nobody listens, and there is nowhere left to say so.
    let _ = io::stderr().write_all(lines.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_are_coloured_where_they_stand_alone_and_nothing_else_is() {
        let look = Look { colour: true, ..Look::PLAIN };
        let text = "1.2 pass +0.3, fails to pass-through: fail";
        let expected = "1.2 \u{1b}[32mpass\u{1b}[0m +0.3, fails to pass-through: \u{1b}[31mfail\u{1b}[0m";
        assert_eq!(look.coloured(text), expected);
        assert_eq!(Look::PLAIN.coloured(text), text);
    }

    #[test]
    fn lines_are_broken_where_there_is_no_room() {
        let look = Look { width: Some(20), ..Look::PLAIN };
        assert_eq!(look.wrapped("one two three four five six\nseven\n"), "one two three four\n  five six\nseven\n");
        assert_eq!(Look::PLAIN.wrapped("one two three four five six"), "one two three four five six");
    }
}
