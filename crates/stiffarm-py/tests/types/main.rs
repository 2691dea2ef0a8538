//! `stiffarm/types.py` says what the tables of the library say: which options each verb takes, and which keys its answers have, all of what
//! type; so do the attributes of the answers.
//!
//! `STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types` writes it anew.

mod attributes;

use std::fmt::Write;
use std::path::Path;

use stiffarm_ask::answer::field::{Field, Kind as Holds};
use stiffarm_ask::answer::shape::{self, Shape, Slot};
use stiffarm_ask::request::{Absent, Kind, Setting, Verb};

/// What is an argument of its own in Python.
const NOT_KEYWORDS: [&str; 5] = ["robot", "robots", "joints-deg", "data", "path"];
const HEAD: &str = r#""""What goes in and what comes out, for type checkers: the options of every verb, and the keys of every answer.

Written by ``STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types`` from the tables of the library; not to be edited.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, TypedDict

import numpy.typing as npt

from ._given import RangeLike
"#;

#[test]
fn the_types_are_those_of_the_tables() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/stiffarm/types.py");
    let expected = written();
    if is_written() {
        std::fs::write(&path, &expected).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "the tables have changed: {WRITE}");
}

const WRITE: &str = "STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types";

/// Files are written anew.
fn is_written() -> bool {
    std::env::var_os("STIFFARM_WRITE").is_some()
}

/// What verbs answer, and the check of the paper's numbers.
fn answers() -> impl Iterator<Item = &'static Shape> {
    Verb::ALL.into_iter().flat_map(shape::answers).chain([&shape::LEDGER])
}

/// What calls it.
fn function(verb: Verb) -> &'static str {
    if verb == Verb::List { "robots" } else { verb.function() }
}

/// Options that are arguments of a function by themselves.
fn arguments(verb: Verb) -> &'static [&'static str] {
    match verb {
        Verb::Place | Verb::Rank => &["task"],
        Verb::Compare => &["a", "b"],
        Verb::Measure => &["geometry"],
        Verb::Chatter => &["process", "feed"],
        _ => &[],
    }
}

fn written() -> String {
    let mut text = HEAD.to_owned();
    let verbs = Verb::ALL.into_iter().filter(|verb| *verb != Verb::Force);
    let of_verbs = verbs.map(|verb| (function(verb), verb, arguments(verb)));
    // A sweep takes several forces.
    for (function, verb, own) in of_verbs.chain([("cluster.sweep", Verb::Place, &["task", "force-n"] as _)]) {
        let last = function.rsplit('.').next().expect("a name");
        let name = format!("{}{}", last[..1].to_uppercase(), &last[1..]);
        writeln!(text, "\n\nclass {name}Options(TypedDict, total=False):").unwrap();
        writeln!(text, "    \"\"\"Keywords of `stiffarm.{function}`.\"\"\"").unwrap();
        let is_keyword = |name: &str| !NOT_KEYWORDS.contains(&name) && !own.contains(&name);
        for setting in verb.settings().filter(|setting| is_keyword(setting.name) && !setting.is_of_figures()) {
            writeln!(text, "\n    {}: {}", setting.keyword(), python_type(setting)).unwrap();
            writeln!(text, "    \"\"\"{}\"\"\"", wrapped(&format!("{}.", setting.described()))).unwrap();
        }
    }
    write_answers(&mut text);
    text
}

/// A class for every kind of object that an answer has.
fn write_answers(text: &mut String) {
    let answers: Vec<&Shape> = answers().collect();
    text.push_str("\n\n_Pass = TypedDict(\"_Pass\", {\"pass\": \"bool | None\"})\n");
    for shape in shape::all() {
        // A placement stands in other answers, too.
        let is_placement = shape == &shape::PLACEMENT;
        write_class(text, shape, answers.contains(&shape) && !is_placement);
        if is_placement {
            write_of_ranking(text);
            text.push_str("\n\nclass PlacementDict(Placed, _OfRanking):\n");
            text.push_str("    \"\"\"What `place` answers.\"\"\"\n\n    schema: Schema\n");
        }
    }
}

/// What a placement has besides where it comes from a ranking.
fn write_of_ranking(text: &mut String) {
    text.push_str("\n\nclass _OfRanking(TypedDict, total=False):\n");
    text.push_str("    \"\"\"What a placement of a ranking has besides.\"\"\"\n");
    let is_known = |slot: &Slot| shape::PLACEMENT.slots().any(|known| known == slot);
    for slot in shape::PLACEMENT_IN_RANKING.slots().filter(|slot| !is_known(slot)) {
        write_slot(text, slot);
    }
}

fn write_class(text: &mut String, shape: &Shape, has_schema: bool) {
    // A word of Python's own has no place in a class.
    let has_pass = shape.slots().any(|slot| slot.field.key == "pass");
    let base = if has_pass { "_Pass" } else { "TypedDict" };
    writeln!(text, "\n\nclass {}({base}):\n    \"\"\"{}\"\"\"", shape.name, wrapped(shape.about)).unwrap();
    if has_schema {
        text.push_str("\n    schema: Schema\n");
    }
    for slot in shape.slots().filter(|slot| slot.field.key != "pass") {
        write_slot(text, slot);
    }
}

fn write_slot(text: &mut String, slot: &Slot) {
    let none = if slot.may_be_null { " | None" } else { "" };
    write_field(text, slot.field, &format!("{}{none}", held(slot, "")));
}

/// A key, its type, and what it is.
fn write_field(text: &mut String, field: Field, kind: &str) {
    writeln!(text, "\n    {}: {kind}\n    \"\"\"{}\"\"\"", field.key, wrapped(field.about)).unwrap();
}

/// What stands under a key; a class of another module has that module's name before it.
fn held(slot: &Slot, module: &str) -> String {
    match (slot.field.kind, slot.of) {
        (Holds::Object, Some(of)) => format!("{module}{}", of.name),
        (Holds::Objects, Some(of)) => format!("list[{module}{}]", of.name),
        (kind, _) => plain(kind),
    }
}

fn plain(kind: Holds) -> String {
    match kind {
        Holds::Text => "str".into(),
        Holds::Truth => "bool".into(),
        Holds::Count => "int".into(),
        Holds::Number(_) => "float".into(),
        Holds::Numbers { nested, open, .. } => {
            let number = if open { "float | None" } else { "float" };
            if nested == 0 { format!("list[{number}]") } else { format!("list[list[{number}]]") }
        }
        Holds::List(of) => format!("list[{}]", plain(*of)),
        Holds::Maybe(of) => format!("{} | None", plain(*of)),
        Holds::ByName(of) => format!("dict[str, {}]", plain(*of)),
        Holds::Object | Holds::Objects => unreachable!("a shape says what stands there"),
    }
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
        (Kind::Flag, _) => "bool".into(),
        (Kind::Word(known), false) => words(known),
        (Kind::Word(known), true) => format!("str | Iterable[{}]", words(known)),
        (
            Kind::Text
            | Kind::Robot
            | Kind::Task
            | Kind::Zone
            | Kind::Shape
            | Kind::Posture
            | Kind::Spindle
            | Kind::Mount
            | Kind::Date,
            false,
        ) => "str".into(),
        (Kind::File, false) => "str | os.PathLike[str]".into(),
        (
            Kind::Text
            | Kind::Robot
            | Kind::Task
            | Kind::Zone
            | Kind::Shape
            | Kind::Posture
            | Kind::Marker
            | Kind::Way
            | Kind::Direction
            | Kind::Pin,
            true,
        ) => "str | Iterable[str]".into(),
        (Kind::FileOfTool, true) => {
            "str | os.PathLike[str] | Iterable[str] | Mapping[int, str | os.PathLike[str]]".into()
        }
        (Kind::LengthOfTool, true) => "str | Iterable[str] | Mapping[int, float]".into(),
        (Kind::Heading, _) => "str | Iterable[str] | Mapping[str, str]".into(),
        (Kind::Range { .. }, _) => "RangeLike".into(),
        (Kind::Block { .. }, _) => "str | Iterable[str | Sequence[RangeLike | None]]".into(),
        (Kind::Within, _) => "str | Sequence[RangeLike | None]".into(),
        (Kind::Force, _) => "float | npt.ArrayLike".into(),
        (Kind::Angle | Kind::Elevation | Kind::Floor | Kind::Yaw | Kind::Roll, _) => "str | float".into(),
        // Numbers, one or many. No kind is left out: a new one must decide.
        (
            Kind::Number { .. }
            | Kind::Whole { .. }
            | Kind::Tool
            | Kind::Point
            | Kind::Direction
            | Kind::Marker
            | Kind::Way
            | Kind::FileOfTool
            | Kind::LengthOfTool
            | Kind::Pin
            | Kind::Spindle
            | Kind::Mount
            | Kind::File
            | Kind::Date,
            _,
        ) => "npt.ArrayLike".into(),
    };
    if matches!(setting.absent, Absent::Default(_)) { usual } else { format!("{usual} | None") }
}
