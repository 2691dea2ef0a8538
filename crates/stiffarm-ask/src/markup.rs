//! How does a text stand in XML and HTML so that it is nothing but text?

/// A text of which no letter is markup, in an element or between double quotes; what no XML may hold is a blank.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\n' => safe.push('\n'),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_letter_is_markup() {
        assert_eq!(escaped("a<b> & \"c\"\n\u{1b}[31m\u{ffff}"), "a&lt;b&gt; &amp; &quot;c&quot;\n [31m ");
    }
}
