//! `stiffarm/types.py` says what the tables of the library say: which options each verb takes, and of what type.
//!
//! `STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types` writes it anew.

use std::fmt::Write;
use std::path::Path;

use stiffarm::request::{Absent, Kind, Setting, Verb};

/// What is an argument of its own in Python.
const NOT_KEYWORDS: [&str; 4] = ["robot", "robots", "joints-deg", "data"];
const NONE: &[&str] = &[];
const HEAD: &str = r#""""What goes in, for type checkers: the options of every verb.

Written by ``STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types`` from the tables of the library; not to be edited.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Literal, TypedDict

import numpy.typing as npt

from ._given import RangeLike
"#;

#[test]
fn the_types_are_those_of_the_tables() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/stiffarm/types.py");
    let expected = written();
    if std::env::var_os("STIFFARM_WRITE").is_some() {
        std::fs::write(&path, &expected).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "the tables have changed: STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types");
}

fn written() -> String {
    let mut text = HEAD.to_owned();
    let classes = [
        ("Robots", "robots", Verb::List, NONE),
        ("Compliance", "compliance", Verb::Compliance, NONE),
        ("Place", "place", Verb::Place, &["task"]),
        ("Rank", "rank", Verb::Rank, &["task"]),
        ("Map", "map", Verb::Map, NONE),
        ("Study", "study", Verb::Study, NONE),
        ("Identify", "identify", Verb::Identify, NONE),
        ("Measure", "measure", Verb::Measure, NONE),
        // A sweep takes several forces.
        ("Sweep", "cluster.sweep", Verb::Place, &["task", "force-n"]),
    ];
    for (name, function, verb, own) in classes {
        writeln!(text, "\n\nclass {name}Options(TypedDict, total=False):").unwrap();
        writeln!(text, "    \"\"\"Keywords of `stiffarm.{function}`.\"\"\"").unwrap();
        let is_keyword = |name: &str| !NOT_KEYWORDS.contains(&name) && !own.contains(&name);
        for setting in verb.settings().filter(|setting| is_keyword(setting.name) && !setting.is_of_figures()) {
            writeln!(text, "\n    {}: {}", setting.keyword(), python_type(setting)).unwrap();
            writeln!(text, "    \"\"\"{}\"\"\"", wrapped(&format!("{}.", setting.described()))).unwrap();
        }
    }
    text
}

/// Words in lines of the house's width, spelt as Python spells them.
fn wrapped(words: &str) -> String {
    let mut lines = vec![String::new()];
    for word in words.replace("--model spatial", "model=\"spatial\"").split(' ') {
        let line = lines.last_mut().expect("there is one");
        if !line.is_empty() && 105 < line.len() + word.len() {
            lines.push(word.to_owned());
        } else {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        }
    }
    lines.join("\n    ")
}

fn python_type(setting: &Setting) -> String {
    let words = |words: &[(&str, &str)]| {
        let quoted: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        format!("Literal[{}]", quoted.join(", "))
    };
    let usual = match (setting.kind, setting.is_list()) {
        (Kind::Number { .. }, false) => "float".into(),
        (Kind::Whole { .. }, false) => "int".into(),
        (Kind::Word(known), false) => words(known),
        (Kind::Word(known), true) => format!("str | Iterable[{}]", words(known)),
        (
            Kind::Text
            | Kind::Robot
            | Kind::Task
            | Kind::Shape
            | Kind::Posture
            | Kind::Spindle
            | Kind::Mount
            | Kind::File
            | Kind::Date,
            false,
        ) => "str".into(),
        (Kind::Text | Kind::Robot | Kind::Task | Kind::Shape | Kind::Posture | Kind::Marker | Kind::Way, true) => {
            "str | Iterable[str]".into()
        }
        (Kind::Range { .. }, _) => "RangeLike".into(),
        (Kind::Block, _) => "str | Iterable[str | Sequence[RangeLike | None]]".into(),
        (Kind::Within, _) => "str | Sequence[RangeLike | None]".into(),
        (Kind::Force, _) => "float | npt.ArrayLike".into(),
        (Kind::Angle | Kind::Elevation | Kind::Floor | Kind::Yaw, _) => "str | float".into(),
        _ => "npt.ArrayLike".into(),
    };
    if matches!(setting.absent, Absent::Default(_)) { usual } else { format!("{usual} | None") }
}
