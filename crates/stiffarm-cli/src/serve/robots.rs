//! Robots of the catalogue, and what the checker says of a file that was sent.

use std::path::Path;
use std::sync::Arc;

use hyper::StatusCode;
use serde_json::{Value, json};
use stiffarm::catalogue::files::{LoadError, load_text};
use stiffarm::catalogue::import::{ImportError, ImportOptions, import};
use stiffarm::catalogue::{Fault, Faults, warnings};
use stiffarm::robot::Robot;
use stiffarm_ask::answer::robot::data_sheet;
use stiffarm_ask::forms::{Answer, Form};
use stiffarm_ask::request::{Pair, Request, Spelling, Verb};

use super::Server;
use super::answer::{without, written};
use super::question::{check_name, decoded, form_of, object, query, unlike};
use super::reply::{Refused, Reply, json_reply, keep_as, reply};
use super::work::computed;
use stiffarm_ask::ask::AskError;
use stiffarm_ask::ask::robots::answer;

use crate::commands::robots::data_sheet_of;
use crate::common::Common;
use crate::failure::Failure;
use stiffarm_ask::sources::Sources;

/// As `robots list`: `text` has words of the names, `as` the form, all else is an option.
pub(super) async fn listed(server: &Arc<Server>, asked: Option<&str>) -> Result<Reply, Refused> {
    let (mut words, mut pairs, mut form) = (Vec::new(), Vec::new(), Form::Json);
    for (name, value) in query(asked)? {
        match name.as_str() {
            "text" => words.extend(value.split_whitespace().map(ToOwned::to_owned)),
            "as" => form = form_of(Some(&format!("as={value}")))?,
            _ => pairs.push(Pair { name, text: value, at: Spelling::Sent }),
        }
    }
    let asked = Request::read(Verb::List, &pairs, Spelling::Sent).map_err(Failure::from)?;
    delivered(server, "robots", form, move || written_of(&answer(&words, &asked)?, form)).await
}

/// As `robots show`.
pub(super) async fn shown(server: &Arc<Server>, name: &str, asked: Option<&str>) -> Result<Reply, Refused> {
    let (robot, form) = (decoded(name)?, form_of(asked)?);
    delivered(server, "robot", form, move || {
        let common = Common { sources: Sources::sent(std::collections::BTreeMap::new()), ..Common::usual() };
        let sheet = data_sheet_of(&robot, None, common.context()).map_err(|error| {
            // The address names the robot: one that is not known is nothing that is here.
            let is_unknown = matches!(error, AskError::UnknownRobot { .. });
            let mut refused = Refused::from(Failure::from(error));
            if is_unknown {
                refused.status = StatusCode::NOT_FOUND;
            }
            refused
        })?;
        written_of(&sheet, form)
    })
    .await
}

async fn delivered(
    server: &Arc<Server>,
    stem: &str,
    form: Form,
    write: impl FnOnce() -> Result<Vec<u8>, Refused> + Send + 'static,
) -> Result<Reply, Refused> {
    let (bytes, _) = computed(server, move |_| write()).await?;
    let mut response = reply(bytes, form.row().media_type);
    if !form.is_json() {
        keep_as(&mut response, &form.file(stem));
    }
    Ok(response)
}

/// A form, where the answer has it.
fn written_of(answer: &dyn Answer, form: Form) -> Result<Vec<u8>, Refused> {
    if answer.forms().has(form) {
        written(answer, form)
    } else {
        Err(without(answer.forms().command, answer.forms(), form))
    }
}

/// What the checker says of `{"name": .., "text": ..}`.
pub(super) async fn checked(server: &Arc<Server>, body: Vec<u8>) -> Result<Reply, Refused> {
    let sent = object(&body)?;
    let field = |key: &str| sent.get(key).and_then(Value::as_str).map(ToOwned::to_owned);
    let (Some(name), Some(text), 2) = (field("name"), field("text"), sent.len()) else {
        return Err(unlike("expected {\"name\": \"mine.toml\", \"text\": \"...\"}, and nothing else"));
    };
    check_name(&name)?;
    let (bytes, _) = computed(server, move |_| Ok(verdict(&name, &text).to_string().into_bytes())).await?;
    let value = serde_json::from_slice(&bytes).map_err(|error| unlike(&error.to_string()))?;
    Ok(json_reply(&value))
}

/// The robot, or every fault; a robot file is found by its ending, as by the program.
fn verdict(name: &str, text: &str) -> Value {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let path = Path::new(name);
    let is_yaml =
        path.extension().is_some_and(|ending| ["yaml", "yml"].iter().any(|yaml| ending.eq_ignore_ascii_case(yaml)));
    let found = if is_yaml {
        let imported = import(text, &stiffarm::catalogue::files::shown(path), &ImportOptions::default());
        imported.map(|imported| (imported.robot, imported.notes, Some(imported.text))).map_err(LoadError::from)
    } else {
        load_text(text, path).map(|loaded| (loaded.robot, loaded.notes, None))
    };
    match found {
        Ok((robot, notes, made)) => usable(&robot, &notes, made),
        Err(LoadError::RobotFile(faults) | LoadError::Import(ImportError::Faults(faults))) => unusable(&faults),
        Err(error) => {
            let failure = Failure::from(error);
            json!({
                "robot": null, "notes": [], "doubts": [], "toml": null, "hint": failure.hint(),
                "faults": [{ "line": null, "key": "", "text": failure.to_string() }],
            })
        }
    }
}

fn usable(robot: &Robot, notes: &[String], made: Option<String>) -> Value {
    let toml = made.unwrap_or_else(|| stiffarm::catalogue::write(robot));
    json!({ "robot": data_sheet(robot), "notes": notes, "doubts": warnings(robot), "toml": toml, "hint": null, "faults": [] })
}

fn unusable(faults: &Faults) -> Value {
    let each = faults.faults.iter().map(
        |Fault { line, key, message }| json!({ "line": (0 < *line).then_some(line), "key": key, "text": message }),
    );
    let hint = AskError::RobotFile(faults.clone()).hint();
    json!({ "robot": null, "notes": [], "doubts": [], "toml": null, "hint": hint, "faults": each.collect::<Value>() })
}
