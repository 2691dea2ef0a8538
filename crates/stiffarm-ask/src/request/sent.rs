//! What is asked by a request that was sent? An object of options, as the keys of a job file, from JSON.

use std::collections::HashSet;

use serde_json::{Map, Value};
use toml::de::{DeTable, DeValue};

use super::job::{described, texts};
use super::{Pair, Refusal, Spelling, Verb};
use stiffarm::catalogue::quoted;
use stiffarm::plain::on_one_line;

/// The options of an object, whose names and values are those of a [job file](super::job), unchecked: [`Request::read`](super::Request::read)
/// does that. What is null is not given. Names stay as they are, and are looked for on no disk.
///
/// # Errors
/// The first value of another type than its option takes, and a name that is there twice.
pub fn sent(verb: Verb, options: &Map<String, Value>) -> Result<Vec<Pair>, Refusal> {
    let mut entries: Vec<(String, &Value)> = Vec::new();
    collect(options, "", &mut entries);
    let (mut pairs, mut seen): (Vec<Pair>, HashSet<String>) = (Vec::new(), HashSet::new());
    for (name, value) in entries {
        let fault = |why: String| Refusal::Job { at: Spelling::Sent, why };
        if !seen.insert(name.clone()) {
            return Err(fault(format!("{} is given twice; expected it once", on_one_line(&name))));
        }
        let text = format!("v={}", literal(value));
        let wrong = || {
            fault(format!(
                "invalid value for '{}'; expected a number, a text, true, false or a list",
                on_one_line(&name)
            ))
        };
        let table = DeTable::parse(&text).map_err(|_| wrong())?;
        let found: &DeValue = table.get_ref().get("v").ok_or_else(wrong)?.get_ref();
        let texts = texts(verb.setting(&name), found)
            .map_err(|expected| fault(format!("{} for '{}': {expected}", described(found), on_one_line(&name))))?;
        pairs.extend(texts.into_iter().map(|text| Pair { name: name.clone(), text, at: Spelling::Sent }));
    }
    Ok(pairs)
}

/// Every value that is there, an object's under its name and its own.
fn collect<'a>(options: &'a Map<String, Value>, before: &str, entries: &mut Vec<(String, &'a Value)>) {
    for (key, value) in options {
        let name = format!("{before}{}", key.replace('_', "-"));
        match value {
            Value::Null => {}
            // As in a job file: what is known of the cell is called the same outside of its table.
            Value::Object(inner) if before.is_empty() && name == "cell" => collect(inner, "", entries),
            Value::Object(inner) if before.is_empty() => collect(inner, &format!("{name}-"), entries),
            value => entries.push((name, value)),
        }
    }
}

/// A value as TOML; of what TOML does not have something that no option takes.
fn literal(value: &Value) -> String {
    match value {
        Value::Bool(flag) => flag.to_string(),
        // A whole number may be sent with a point: JSON knows no difference.
        Value::Number(number) => match number.as_f64() {
            Some(whole) if number.is_f64() && whole.fract() == 0.0 && whole.abs() < 1e15 => format!("{whole:.0}"),
            _ => number.to_string(),
        },
        Value::String(text) => quoted(text),
        Value::Array(items) => format!("[{}]", items.iter().map(literal).collect::<Vec<_>>().join(",")),
        Value::Null | Value::Object(_) => "{}".into(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::super::Request;
    use super::*;

    fn asked(options: &Value) -> Result<Request, Refusal> {
        let pairs = sent(Verb::Place, options.as_object().expect("an object"))?;
        Request::read(Verb::Place, &pairs, Spelling::Sent)
    }

    #[test]
    fn an_object_asks_what_a_job_file_of_the_same_keys_asks() {
        let options = json!({
            "robot": "BT200L", "task": "rect:0.6x0.4", "model": "spatial", "tool_mm": [0, -0.5, 2e2], "tolerance-mm": null,
            "within": ["1.0..", "0.5.."], "tool": {"direction": "down"}, "cell": {"mount": "pedestal:0.5"}, "force-n": 1000,
        });
        let job = "verb = \"place\"\nrobot = \"BT200L\"\ntask = \"rect:0.6x0.4\"\nmodel = \"spatial\"\ntool-mm = [0, -0.5, 2e2]\n\
                   within = [\"1.0..\", \"0.5..\"]\nforce-n = 1000\n[tool]\ndirection = \"down\"\n[cell]\nmount = \"pedestal:0.5\"\n";
        let job = super::super::job::read_sent(job, "job.toml").unwrap();
        let read = Request::read(Verb::Place, &job.pairs, Spelling::Sent).unwrap();
        let sorted = |request: &Request| {
            let mut lines: Vec<String> =
                super::super::job::write(request, &[], "job.toml".as_ref()).lines().map(Into::into).collect();
            lines.sort();
            lines
        };
        assert_eq!(sorted(&asked(&options).unwrap()), sorted(&read));
    }

    #[test]
    fn a_whole_number_may_have_a_point() {
        let options = json!({ "robot": "BT200L", "size": 20.0, "force-n": 1e3 });
        let pairs = sent(Verb::Map, options.as_object().unwrap()).unwrap();
        let texts: Vec<&str> = pairs.iter().map(|pair| pair.text.as_str()).collect();
        assert_eq!(texts, ["BT200L", "20", "1000"]);
        let half = sent(Verb::Map, json!({ "size": 20.5 }).as_object().unwrap()).unwrap();
        assert!(Request::read(Verb::Map, &half, Spelling::Sent).is_err());
    }

    #[test]
    fn what_no_option_takes_is_refused_by_its_name() {
        for (options, words) in [
            (json!({"task": 3}), "invalid value '3' for 'task': expected a text in quotes"),
            (json!({"force-n": "a"}), "invalid value 'a' for 'force-n': expected a number, without quotes"),
            (json!({"tool-mm": [0, null, 1]}), "for 'tool-mm': expected"),
            (json!({"tool-mm": [[0, 1], 2]}), "for 'tool-mm': expected"),
            (json!({"task": {"a": {"b": 1}}}), "task-a is no option of place"),
            (json!({"robots": "BT200L"}), "robots does not go with place"),
            (json!({"tool": {"mm": [0, 0, 1]}, "tool-mm": [0, 0, 1]}), "tool-mm is given twice"),
            (json!({"a\n\u{1b}[31m": 1}), "is no option of place"),
            (json!({"robot": "\"]\nverb = 3"}), "task is missing"),
        ] {
            let refusal = match asked(&options) {
                Err(refusal) => refusal,
                Ok(request) => request.check_complete().unwrap_err(),
            };
            assert!(refusal.to_string().contains(words), "{options}: {refusal}");
        }
    }
}
