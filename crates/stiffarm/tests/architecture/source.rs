//! What does a Rust source use? Answered from its text: comments, strings and tests apart, paths are recognised by their words.

use std::collections::BTreeMap;

/// The words and signs of a source, without comments, strings and what is compiled for tests only.
pub(crate) fn tokens(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for word in without_comments_and_strings(text).split_whitespace() {
        let mut rest = word;
        while let Some(first) = rest.chars().next() {
            let length = if is_of_a_word(first) {
                rest.find(|sign| !is_of_a_word(sign)).unwrap_or(rest.len())
            } else if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            };
            found.push(rest[..length].to_owned());
            rest = &rest[length..];
        }
    }
    without_tests(&found)
}

fn is_of_a_word(sign: char) -> bool {
    sign.is_alphanumeric() || sign == '_'
}

/// Strings become nothing between quotes, so that no word in them is taken for code.
fn without_comments_and_strings(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(length) = string(rest, code.chars().last()) {
            code.push_str("\"\"");
            length
        } else {
            code.push(first);
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    code
}

/// How long the string or the character is with which the text begins.
fn string(text: &str, before: Option<char>) -> Option<usize> {
    if let Some(raw) = text.strip_prefix('r').filter(|_| !before.is_some_and(is_of_a_word)) {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let end = format!("\"{}", "#".repeat(hashes));
        let inner = raw[hashes..].strip_prefix('"')?;
        return Some(1 + hashes + 1 + inner.find(&end)? + end.len());
    }
    let quote = text.chars().next().filter(|quote| "\"'".contains(*quote))?;
    let mut escaped = false;
    for (at, sign) in text.char_indices().skip(1) {
        if quote == '\'' && !escaped && sign != '\'' && at != 1 {
            // No second quote where a character ends: a lifetime.
            return None;
        }
        if sign == quote && !escaped {
            return Some(at + 1);
        }
        escaped = sign == '\\' && !escaped;
        if quote == '\'' && sign == '\\' {
            return text[2..].char_indices().skip(1).find(|(_, sign)| *sign == '\'').map(|(at, _)| at + 3);
        }
    }
    None
}

/// Leaves out every item that stands behind `#[cfg(test)]`.
fn without_tests(tokens: &[String]) -> Vec<String> {
    const TEST: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at..].iter().zip(TEST).filter(|(token, sign)| token == sign).count() == TEST.len() {
            at = end_of_item(tokens, at + TEST.len());
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    kept
}

fn end_of_item(tokens: &[String], start: usize) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate().skip(start) {
        match token.as_str() {
            "{" => depth += 1,
            "}" if depth == 1 => return at + 1,
            "}" => depth -= 1,
            ";" if depth == 0 => return at + 1,
            _ => {}
        }
    }
    tokens.len()
}

/// What a source says of others.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Uses {
    /// Names that `use` brings in, and their paths; behind a star the name is `*` and the module's path.
    pub names: BTreeMap<String, Vec<String>>,
    /// All paths: those of `use`, and those that stand in the code.
    pub paths: Vec<Vec<String>>,
}

/// Reads every `use`, and every path of two words or more.
pub(crate) fn uses(tokens: &[String]) -> Uses {
    let mut found = Uses::default();
    let mut at = 0;
    while at < tokens.len() {
        // Behind `use <` stand lifetimes that a type takes.
        if tokens[at] == "use" && tokens.get(at + 1).is_some_and(|next| next != "<") {
            at = tree(tokens, at + 1, &[], &mut found);
        } else if tokens[at].chars().all(is_of_a_word) && tokens.get(at + 1).is_some_and(|next| next == "::") {
            let mut path = vec![tokens[at].clone()];
            while tokens.get(at + 1).is_some_and(|next| next == "::")
                && tokens.get(at + 2).is_some_and(|next| next.chars().all(is_of_a_word))
            {
                path.push(tokens[at + 2].clone());
                at += 2;
            }
            found.paths.push(path);
            at += 1;
        } else {
            at += 1;
        }
    }
    found
}

/// Reads one branch of a `use`; tells where the next one begins.
fn tree(tokens: &[String], start: usize, trunk: &[String], found: &mut Uses) -> usize {
    let mut path = trunk.to_vec();
    let mut name = None;
    let mut at = start;
    while at < tokens.len() {
        match tokens[at].as_str() {
            "{" => {
                at += 1;
                while tokens[at] != "}" {
                    at = tree(tokens, at, &path, found);
                    at += usize::from(tokens[at] == ",");
                }
                return at + 1;
            }
            "," | "}" | ";" => break,
            "::" => {}
            "as" => {
                name = Some(tokens[at + 1].clone());
                at += 1;
            }
            "*" => name = Some(format!("* {}", path.join("::"))),
            "self" if !path.is_empty() => {}
            word => path.push(word.to_owned()),
        }
        at += 1;
    }
    if let Some(name) = name.or_else(|| path.last().cloned()) {
        found.names.insert(name, path.clone());
        found.paths.push(path);
    }
    at
}
