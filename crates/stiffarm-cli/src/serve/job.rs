//! What does a job file ask that was opened in the page? Its verb, and every option as it is typed.

use serde_json::{Map, Value, json};
use stiffarm_ask::request::check_names;
use stiffarm_ask::request::job::read_sent;

use super::question::{check_name, object, unlike};
use super::reply::{Refused, Reply, json_reply};
use crate::failure::Failure;

/// Of `{"name": .., "text": ..}`: `{"verb": .., "options": {..}}`, a list where an option is given several times.
pub(super) fn understood(body: &[u8]) -> Result<Reply, Refused> {
    let sent = object(body)?;
    let field = |key: &str| sent.get(key).and_then(Value::as_str);
    let (Some(name), Some(text), 2) = (field("name"), field("text"), sent.len()) else {
        return Err(unlike("expected {\"name\": \"job.toml\", \"text\": \"...\"}, and nothing else"));
    };
    check_name(name)?;
    let job = read_sent(text, name).map_err(Failure::from)?;
    // A form has no field for what is no option, and would leave it out.
    check_names(job.verb, &job.pairs).map_err(Failure::from)?;
    let mut options: Map<String, Value> = Map::new();
    for pair in job.pairs {
        match options.get_mut(&pair.name) {
            None => drop(options.insert(pair.name, pair.text.into())),
            Some(Value::Array(texts)) => texts.push(pair.text.into()),
            Some(one) => *one = json!([one.take(), pair.text]),
        }
    }
    Ok(json_reply(&json!({ "verb": job.verb.name(), "options": options })))
}
