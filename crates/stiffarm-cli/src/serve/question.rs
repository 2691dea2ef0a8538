//! What is asked? A verb from the address, options and texts from the body, and the form of the answer.

use std::collections::BTreeMap;
use std::sync::Arc;

use hyper::StatusCode;
use percent_encoding::percent_decode_str;
use serde_json::{Map, Value};
use stiffarm::plain::on_one_line;
use stiffarm_ask::forms::{FORMS, Form};
use stiffarm_ask::request::{Request, Spelling, Verb, sent};

use super::bounds;
use super::form::Wanted;
use super::once::Once;
use super::reply::Refused;
use crate::client::Client;
use crate::common::Common;
use crate::failure::Failure;
use stiffarm_ask::sources::Sources;

/// A question that was understood.
#[derive(Debug)]
pub(super) struct Question {
    pub(super) asked: Request,
    pub(super) files: BTreeMap<String, String>,
    pub(super) wanted: Wanted,
}

impl Question {
    /// Reads a body.
    pub(super) fn read(verb: Verb, wanted: Wanted, body: &[u8]) -> Result<Self, Refused> {
        let mut fields = object(body)?;
        let (options, files) = (fields.remove("options"), fields.remove("files"));
        if let Some(other) = fields.keys().next() {
            return Err(unlike(&format!("'{}' is nothing that is asked", on_one_line(other))));
        }
        let options = match options {
            None => Map::new(),
            Some(Value::Object(options)) => options,
            Some(_) => return Err(unlike("'options' is no object")),
        };
        let files = match files {
            None => BTreeMap::new(),
            Some(Value::Object(files)) => texts(files)?,
            Some(_) => return Err(unlike("'files' is no object")),
        };
        let refused = |refusal| Refused::from(Failure::from(refusal));
        let pairs = sent(verb, &options).map_err(refused)?;
        let asked = Request::of_task(verb, &pairs, Spelling::Sent).map_err(refused)?;
        asked.check_complete().map_err(refused)?;
        let question = Self { asked, files, wanted };
        bounds::check(&question.asked)?;
        Ok(question)
    }

    /// What the commands need besides what is asked.
    pub(super) fn common(&self, client: Arc<Client>) -> Common {
        let (sources, client) = (Sources::sent(self.files.clone()), Some(client));
        Common { sources, client, most_samples: bounds::MOST_SAMPLES, ..Common::usual() }
    }
}

/// A body as JSON.
pub(super) fn object(body: &[u8]) -> Result<Map<String, Value>, Refused> {
    match serde_json::from_slice(body) {
        Ok(Once(Value::Object(fields))) => Ok(fields),
        Ok(_) => Err(unlike("it is no object")),
        Err(error) => Err(unlike(&error.to_string())),
    }
}

/// No system has longer names of files.
const LONGEST_NAME: usize = 255;

/// That what is said to be the name of a file can be one.
pub(super) fn check_name(name: &str) -> Result<(), Refused> {
    if name.len() <= LONGEST_NAME {
        return Ok(());
    }
    Err(unlike(&format!("a file's name has {} bytes; expected at most {LONGEST_NAME}", name.len())))
}

pub(super) fn texts(files: Map<String, Value>) -> Result<BTreeMap<String, String>, Refused> {
    files.keys().try_for_each(|name| check_name(name))?;
    let text = |(name, value): (String, Value)| match value {
        Value::String(text) => Ok((name.trim().to_owned(), text)),
        _ => Err(unlike(&format!("'{}' in 'files' is no text", on_one_line(&name)))),
    };
    files.into_iter().map(text).collect()
}

/// A body that is no question.
pub(super) fn unlike(why: &str) -> Refused {
    let hint = "expected such as {\"options\": {\"robot\": \"BT200L\", \"task\": \"circle:0.3\"}, \"files\": {\"mine.toml\": \"its text\"}}";
    Refused::new(StatusCode::BAD_REQUEST, format!("the question is not understood: {why}"), hint)
}

/// Names and texts behind the question mark of an address.
pub(super) fn query(text: Option<&str>) -> Result<Vec<(String, String)>, Refused> {
    let parts = text.unwrap_or_default().split('&').filter(|part| !part.is_empty());
    parts
        .map(|part| {
            let (name, value) = part.split_once('=').unwrap_or((part, ""));
            Ok((decoded(&name.replace('+', " "))?, decoded(&value.replace('+', " "))?))
        })
        .collect()
}

/// A part of an address as a text.
pub(super) fn decoded(text: &str) -> Result<String, Refused> {
    let text = percent_decode_str(text).decode_utf8().map(std::borrow::Cow::into_owned);
    let wrong = |_| {
        Refused::new(
            StatusCode::BAD_REQUEST,
            "the address is no UTF-8 text",
            "write other letters as %XX of their UTF-8",
        )
    };
    text.map_err(wrong)
}

/// The forms that an address asks for, and nothing besides.
pub(super) fn wanted_of(text: Option<&str>) -> Result<Wanted, Refused> {
    let words: Vec<&str> = FORMS.iter().map(|row| row.word).collect();
    let hint = format!("?as={}, job or command; several texts of one answer: ?as=json,tables,svg", words.join(", "));
    let wrong = |why: String| Refused::new(StatusCode::BAD_REQUEST, why, &hint);
    let mut wanted = None;
    for (name, value) in query(text)? {
        if name != "as" {
            return Err(wrong(format!("'{}' is nothing that an address asks here", on_one_line(&name))));
        }
        if wanted.is_some() {
            return Err(wrong("'as' is given twice".into()));
        }
        wanted = Some(Wanted::of(&value).map_err(wrong)?);
    }
    Ok(wanted.unwrap_or(Wanted::One(Form::Json)))
}

/// The one form that an address asks for.
pub(super) fn form_of(text: Option<&str>) -> Result<Form, Refused> {
    match wanted_of(text)? {
        Wanted::One(form) => Ok(form),
        Wanted::Several(_) => Err(Failure::usage("robots come in one form at a time").into()),
        Wanted::Job | Wanted::Command => Err(Failure::usage("robots have no such form").into()),
    }
}
