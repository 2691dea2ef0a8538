//! Reads YAML into scalars, lists and maps with the place of each.

use saphyr_parser::{Event, Parser};

use crate::catalogue::reader::{Log, shown};

/// Deeper nesting is no parameter file.
const DEEPEST: usize = 32;

/// A part of a YAML text.
#[derive(Debug)]
pub(super) struct Node {
    /// Where it begins, in bytes.
    pub(super) place: usize,
    pub(super) value: Value,
}

#[derive(Debug)]
pub(super) enum Value {
    /// As written, with its tag, such as `degrees` of `!degrees 90`.
    Scalar {
        text: String,
        tag: String,
    },
    List(Vec<Node>),
    /// In the order of the file.
    Map(Vec<(String, Node)>),
}

/// What is being read: a list, or a map with the key that waits for its value.
enum Open {
    List(Vec<Node>),
    Map(Vec<(String, Node)>, Option<String>),
}

/// The first document; faults go to the log. Anchors and aliases are not followed: they make small files large.
pub(super) fn parse(text: &str, log: &Log) -> Option<Node> {
    let starts: Vec<usize> = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
    let line = |line: usize| starts.get(line.saturating_sub(1)).copied().unwrap_or(text.len());
    let mut open: Vec<(usize, Open)> = Vec::new();
    for event in Parser::new_from_str(text) {
        let (event, span) = match event {
            Ok(event) => event,
            Err(error) => {
                log.add(line(error.marker().line()), "", format!("no YAML: {}", shown(error.info())));
                return None;
            }
        };
        let place = line(span.start.line());
        let done = match event {
            Event::Alias(_) => {
                log.add(place, "", "an alias (*); expected plain values");
                return None;
            }
            Event::SequenceStart(..) | Event::MappingStart(..) if open.len() == DEEPEST => {
                log.add(place, "", "nested too deeply; expected OPW parameters");
                return None;
            }
            Event::SequenceStart(..) => {
                open.push((place, Open::List(Vec::new())));
                continue;
            }
            Event::MappingStart(..) => {
                open.push((place, Open::Map(Vec::new(), None)));
                continue;
            }
            Event::Scalar(text, _, _, tag) => {
                let tag = tag.map(|tag| tag.suffix.clone()).unwrap_or_default();
                Node { place, value: Value::Scalar { text: text.into_owned(), tag } }
            }
            Event::SequenceEnd | Event::MappingEnd => match open.pop()? {
                (place, Open::List(nodes)) => Node { place, value: Value::List(nodes) },
                (place, Open::Map(entries, _)) => Node { place, value: Value::Map(entries) },
            },
            _ => continue,
        };
        match open.last_mut() {
            None => return Some(done),
            Some((_, Open::List(nodes))) => nodes.push(done),
            Some((_, Open::Map(entries, key))) => match key.take() {
                Some(key) if entries.iter().any(|(other, _)| *other == key) => {
                    log.add(done.place, &shown(&key), "stands here twice");
                    return None;
                }
                Some(key) => entries.push((key, done)),
                None => *key = Some(if let Value::Scalar { text, .. } = done.value { text } else { String::new() }),
            },
        }
    }
    log.add(0, "", "empty; expected a URDF or OPW parameters");
    None
}
