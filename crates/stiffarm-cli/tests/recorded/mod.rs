//! A hundred questions over all verbs with their answers as they were recorded: what is rebuilt behind them changes none.
//!
//! `STIFFARM_WRITE=1 cargo test -p stiffarm-cli --test all recorded::` records them anew; whoever does reads the difference.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use assert_cmd::Command;
use rayon::prelude::*;
use serde_json::Value;
use stiffarm_ask::answer::shape;
use stiffarm_ask::request::Verb;

use crate::readme::ROOT;
use crate::readme::shown::words;

/// Recorded numbers keep so many digits.
const DIGITS: usize = 12;
/// How far numbers may be off in proportion: sines differ in their last bits from one C library to another, and searches carry it on.
const LAST_BITS: f64 = 1e-9;
/// Numbers below this are differences of what cancels.
const NOTHING: f64 = 1e-9;
/// The same of a calibration: its noise and the scale of its errors lie where the evidence is flat, so that the last bit of a length moves them by
/// its root; and what no row shows is zero to that.
const OF_FLAT: f64 = 1e-5;

/// How far numbers of the answer to a question may be off, in proportion, and below which size they are nothing.
fn slack(question: &str) -> [f64; 2] {
    if question.starts_with("calibrate ") { [OF_FLAT; 2] } else { [LAST_BITS, NOTHING] }
}

fn folder() -> String {
    format!("{}/tests/recorded", env!("CARGO_MANIFEST_DIR"))
}

/// What the program says to a question, as a table and as JSON.
struct Reply {
    exit: i32,
    table: String,
    complaint: String,
    json: Option<Value>,
}

fn run(question: &str, further: &[&str]) -> std::process::Output {
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let program = program.current_dir(ROOT).env("COLUMNS", "160").env_remove("CLICOLOR_FORCE");
    program.args(words(question)).args(further).output().unwrap()
}

impl Reply {
    fn of(question: &str) -> Self {
        let (printed, sent) = (run(question, &[]), run(question, &["--format", "json"]));
        assert_eq!(printed.status.code(), sent.status.code(), "{question}");
        Self {
            exit: printed.status.code().expect("no signal"),
            table: String::from_utf8(printed.stdout).unwrap().trim_end().into(),
            complaint: String::from_utf8(printed.stderr).unwrap().trim_end().into(),
            json: serde_json::from_slice(&sent.stdout).ok(),
        }
    }

    fn recorded(&self, question: &str) -> String {
        let mut text = format!("$ {question}\nexit {}\n", self.exit);
        for (what, block) in [("table", &self.table), ("stderr", &self.complaint)] {
            for line in block.lines() {
                let _ = writeln!(text, "{}", format!("{what}| {line}").trim_end());
            }
        }
        if let Some(json) = &self.json {
            let _ = writeln!(text, "json| {}", rounded(json));
        }
        text
    }
}

/// The same with numbers of twelve digits.
fn rounded(value: &Value) -> Value {
    match value {
        Value::Number(number) if number.is_f64() => {
            let short = format!("{:.*e}", DIGITS - 1, number.as_f64().expect("a float"));
            short.parse::<f64>().expect("a number").into()
        }
        Value::Array(items) => items.iter().map(rounded).collect(),
        Value::Object(fields) => fields.iter().map(|(key, value)| (key.clone(), rounded(value))).collect(),
        other => other.clone(),
    }
}

/// Where two answers differ first, by its keys; nothing where they are the same.
fn difference(at: &str, new: &Value, old: &Value) -> Option<String> {
    match (new, old) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64()?, b.as_f64()?);
            let ([share, nothing], most) = (slack(at), a.abs().max(b.abs()));
            let is_same = (a - b).abs() <= share * most || most < nothing;
            (!is_same).then(|| format!("{at}: {a}, recorded {b}"))
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).enumerate().find_map(|(i, (a, b))| difference(&format!("{at}[{i}]"), a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let keys = |of: &serde_json::Map<String, Value>| of.keys().cloned().collect::<Vec<_>>();
            if keys(a) != keys(b) {
                return Some(format!("{at}: keys {:?}, recorded {:?}", keys(a), keys(b)));
            }
            a.iter().zip(b.values()).find_map(|((key, a), b)| difference(&format!("{at}.{key}"), a, b))
        }
        (a, b) => (a != b).then(|| format!("{at}: {a}, recorded {b}")),
    }
}

/// What was recorded of a question, by its lines.
fn parts(block: &str) -> (String, Option<Value>) {
    let (json, lines): (Vec<&str>, Vec<&str>) = block.lines().partition(|line| line.starts_with("json| "));
    let json = json.first().map(|line| serde_json::from_str(&line["json| ".len()..]).expect("recorded JSON"));
    (lines.join("\n"), json)
}

/// The recorded answers by their questions.
fn answers() -> BTreeMap<String, String> {
    let mut answers = BTreeMap::new();
    for file in fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()) {
        if file.extension().is_none_or(|ending| ending != "answers") {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        for block in text.split("$ ").skip(1).filter(|block| !block.is_empty()) {
            let (question, rest) = block.split_once('\n').expect("a question and its answer");
            answers.insert(question.to_owned(), rest.to_owned());
        }
    }
    answers
}

/// Why an answer has not the keys that its verb is said to have, with what belongs under each; nothing where it has.
fn misshapen(question: &str, answer: &Value) -> Option<String> {
    let Value::Object(fields) = answer else {
        // The catalogue, by the keys of robot files behind these.
        let keys: Vec<&str> = shape::ROBOT_SHEET.slots().map(|slot| slot.field.key).collect();
        let lacks = |robot: &Value| keys.iter().find(|key| robot.get(key).is_none()).copied();
        let robots = answer.as_array().filter(|_| question.starts_with("robots list"))?;
        return robots.iter().find_map(lacks).map(|key| format!("a robot without {key}"));
    };
    let mut fields = fields.clone();
    let schema = fields.shift_remove("schema").unwrap_or_default();
    if let Err(why) = shape::SCHEMA.check(schema.as_object()?) {
        return Some(why);
    }
    let verb = schema["verb"].as_str().expect("checked");
    let shapes = match Verb::ALL.into_iter().find(|known| known.name() == verb) {
        Some(known) => shape::answers(known),
        None => vec![&shape::LEDGER],
    };
    let faults: Vec<String> = shapes.iter().map_while(|shape| shape.check(&fields).err()).collect();
    (faults.len() == shapes.len()).then(|| faults.join("\n"))
}

#[test]
fn every_recorded_question_has_its_answer() {
    let questions = fs::read_to_string(format!("{}/questions.txt", folder())).unwrap();
    let questions: Vec<&str> = questions.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).collect();
    let replies: Vec<(&str, Reply)> = questions.par_iter().map(|question| (*question, Reply::of(question))).collect();
    if std::env::var_os("STIFFARM_WRITE").is_some() {
        let mut files: BTreeMap<&str, String> = BTreeMap::new();
        for (question, reply) in &replies {
            let verb = question.split(' ').next().expect("a verb");
            files.entry(verb).or_default().push_str(&reply.recorded(question));
        }
        for (verb, text) in files {
            fs::write(Path::new(&folder()).join(format!("{verb}.answers")), text).unwrap();
        }
        return;
    }
    let recorded = answers();
    let mut others = Vec::new();
    for (question, reply) in &replies {
        let Some(old) = recorded.get(*question) else {
            others.push(format!("{question}: not recorded"));
            continue;
        };
        let new = reply.recorded(question);
        let ((words, json), (old_words, old_json)) = (parts(new.split_once('\n').unwrap().1), parts(old));
        if words != old_words {
            others.push(format!("{question}:\n{words}\nrecorded:\n{old_words}"));
        }
        others.extend(
            reply.json.as_ref().and_then(|json| misshapen(question, json)).map(|why| format!("{question}: {why}")),
        );
        match (json, old_json) {
            (Some(new), Some(old)) => others.extend(difference(question, &new, &old)),
            (new, old) if new.is_some() != old.is_some() => others.push(format!("{question}: JSON or none")),
            _ => {}
        }
    }
    assert_eq!(replies.len(), recorded.len(), "questions and recorded answers");
    assert!(others.is_empty(), "{}", others.join("\n\n"));
}

#[test]
fn an_answer_of_another_shape_is_seen() {
    let recorded = answers();
    let (_, answer) = recorded.iter().find(|(question, _)| question.starts_with("study ")).expect("a study");
    let answer = parts(answer).1.expect("as JSON");
    assert_eq!(misshapen("study", &answer), None);
    for (at, wrong) in [("/rows/0/d", Value::Null), ("/schema/version", "2".into()), ("/rows/0/best", 1.into())] {
        let mut answer = answer.clone();
        *answer.pointer_mut(at).expect("it is there") = wrong;
        let key = at.rsplit('/').next().unwrap();
        assert!(misshapen("study", &answer).is_some_and(|why| why.contains(&format!(".{key}: "))), "{at}");
    }
}

#[test]
fn a_difference_is_seen_wherever_it_is() {
    let old: Value = serde_json::json!({ "a": [1.0, { "b": null }], "c": "x" });
    assert_eq!(difference("", &old, &old), None);
    for (new, at) in [
        (serde_json::json!({ "a": [1.000_001, { "b": null }], "c": "x" }), ".a[0]"),
        (serde_json::json!({ "a": [1.0, { "b": 0 }], "c": "x" }), ".a[1].b"),
        (serde_json::json!({ "a": [1.0, { "b": null }], "c": "y" }), ".c"),
        (serde_json::json!({ "a": [1.0], "c": "x" }), ".a"),
        (serde_json::json!({ "c": "x", "a": [1.0, { "b": null }] }), ""),
    ] {
        let found = difference("", &new, &old).expect("a difference");
        assert_eq!(difference("calibrate x", &new, &old).is_some(), at != ".a[0]");
        assert!(found.starts_with(&format!("{at}:")), "{found}");
    }
}
