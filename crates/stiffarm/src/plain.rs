//! How may a text from outside stand in a line, a table or a message?

use std::borrow::Cow;

/// Could this character forge a line, steer a terminal, or turn the order in which a line is read?
///
/// These are the control characters (C0, DEL, C1), the separators of lines and paragraphs, and the marks of direction
/// (Unicode property `Bidi_Control`).
pub fn steers(c: char) -> bool {
    let marks_a_direction =
        matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') || marks_a_direction
}

/// The text on one line: each character that [`steers`] is written out, such as `\n` or `\u{1b}`.
pub fn on_one_line(text: &str) -> Cow<'_, str> {
    without(text, steers)
}

/// The same with its line breaks and tabs kept: for messages of several lines of which each part was cleaned before.
pub fn on_its_lines(text: &str) -> Cow<'_, str> {
    without(text, |c| !matches!(c, '\n' | '\t') && steers(c))
}

fn without(text: &str, written_out: impl Fn(char) -> bool) -> Cow<'_, str> {
    // Most texts are plain, and a map has hundreds of millions of them: bytes are looked through faster than letters.
    if text.bytes().all(|byte| matches!(byte, b' '..=b'~')) || !text.contains(&written_out) {
        return text.into();
    }
    let mut clean = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if written_out(c) { clean.extend(c.escape_default()) } else { clean.push(c) }
    }
    clean.into()
}

/// No name that is known has more letters.
const LONGEST_NAME: usize = 200;

/// How alike two names are spelt: 1 of the same, 0 of those that share nothing, and of what is too long to be a name.
pub fn alike(known: &str, typed: &str) -> f64 {
    if LONGEST_NAME < known.len().max(typed.len()) { 0.0 } else { strsim::jaro_winkler(known, typed) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_written_out_and_the_rest_stays() {
        let hostile = "a\u{1b}[2J\u{7}\n\r\tb\u{85}\u{9b}1m\u{202e}c\u{2066}\u{200f}\u{2028}\0\u{7f}";
        let clean = r"a\u{1b}[2J\u{7}\n\r\tb\u{85}\u{9b}1m\u{202e}c\u{2066}\u{200f}\u{2028}\u{0}\u{7f}";
        assert_eq!(on_one_line(hostile), clean);
        assert_eq!(on_its_lines("one\n\ttwo\r"), "one\n\ttwo\\r");
        let honest = "KR 210 \"R2700\" \\ Stäubli 安川 ≤ 3°";
        assert!(matches!(on_one_line(honest), Cow::Borrowed(same) if same == honest));
    }
}
