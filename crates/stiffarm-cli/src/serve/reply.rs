//! How is an answer sent, and a refusal? With headers that let a browser do nothing else with it.

use std::convert::Infallible;

use http_body_util::combinators::UnsyncBoxBody;
use http_body_util::{BodyExt, Full};
use hyper::body::Bytes;
use hyper::header::{
    ALLOW, CACHE_CONTROL, CONTENT_DISPOSITION, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName, HeaderValue,
    REFERRER_POLICY, RETRY_AFTER, X_CONTENT_TYPE_OPTIONS,
};
use hyper::{Response, StatusCode};
use serde_json::{Value, json};

use stiffarm_ask::ask::AskError;

use crate::failure::Failure;

/// What is sent.
pub(super) type Reply = Response<UnsyncBoxBody<Bytes, Infallible>>;

/// Of what is data: it may do nothing where a browser shows it.
const DATA_POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox; frame-ancestors 'none'";
/// What was said beside an answer: a JSON list of texts.
const NOTES: HeaderName = HeaderName::from_static("stiffarm-notes");
const RESOURCE_POLICY: HeaderName = HeaderName::from_static("cross-origin-resource-policy");
/// Notes are sent up to this length; the stream has all of them.
const MOST_NOTES: usize = 4096;

/// A question without an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Refused {
    pub(super) status: StatusCode,
    error: String,
    hint: String,
    exit_code: Option<u8>,
    allow: &'static str,
}

impl Refused {
    pub(super) fn new(status: StatusCode, error: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { status, error: error.into(), hint: hint.into(), exit_code: None, allow: "" }
    }

    /// Nothing is here.
    pub(super) fn nowhere() -> Self {
        Self::new(StatusCode::NOT_FOUND, "there is nothing of this name", "GET /openapi.json tells what can be asked")
    }

    /// It is asked in another way.
    pub(super) fn method(allow: &'static str) -> Self {
        let why = format!("this is asked with {allow}");
        Self { allow, ..Self::new(StatusCode::METHOD_NOT_ALLOWED, why, "GET /openapi.json tells what can be asked") }
    }

    pub(super) fn json(&self) -> Value {
        let mut body = json!({ "error": self.error, "hint": self.hint });
        if let Some(code) = self.exit_code {
            body["exit_code"] = code.into();
        }
        body
    }

    pub(super) fn reply(&self) -> Reply {
        let mut reply = json_reply(&self.json());
        *reply.status_mut() = self.status;
        if self.status == StatusCode::SERVICE_UNAVAILABLE {
            reply.headers_mut().insert(RETRY_AFTER, HeaderValue::from_static("1"));
        }
        if !self.allow.is_empty() {
            reply.headers_mut().insert(ALLOW, HeaderValue::from_static(self.allow));
        }
        reply
    }
}

/// In the words of the command line; 400 for what was asked wrongly, 422 for what was asked well and has no answer.
impl From<Failure> for Refused {
    fn from(failure: Failure) -> Self {
        let status = if failure.exit_code() == 2 { StatusCode::BAD_REQUEST } else { StatusCode::UNPROCESSABLE_ENTITY };
        let hint = match &failure {
            Failure::Ask(AskError::UnknownRobot { suggestions, .. }) if suggestions.is_empty() => {
                "GET /api/robots names the robots; a robot file of your own comes along under \"files\"".into()
            }
            Failure::Ask(AskError::NoRobot(_)) => {
                "GET /api/robots names the robots; a robot file of your own comes along under \"files\"".into()
            }
            Failure::Ask(AskError::Usage(_) | AskError::Request(_)) => {
                "GET /api/options tells what every option takes".into()
            }
            Failure::Ask(AskError::Place { robot, .. } | AskError::Posture { robot, .. }) => {
                format!("GET /api/robots/NAME tells what is known of {robot}; within, angle and gap bound a search")
            }
            Failure::Ask(AskError::Path(_) | AskError::Mill(_)) => {
                "GET /api/options tells what can be said of a path, a process and a stock".into()
            }
            _ => failure.hint(),
        };
        let [error, hint] = [failure.to_string(), hint].map(|text| as_sent(&text));
        Self { exit_code: Some(failure.exit_code()), ..Self::new(status, error, hint) }
    }
}

impl From<AskError> for Refused {
    fn from(error: AskError) -> Self {
        Failure::from(error).into()
    }
}

/// Options as a question spells them: where something was sent nothing is typed, but what is to be typed in a shell.
fn as_sent(text: &str) -> String {
    let spans = text.split('`').enumerate();
    let spelt = spans.map(|(i, span)| {
        let is_typed = i % 2 == 1 && span.starts_with("stiffarm ");
        if is_typed { span.to_owned() } else { without_dashes(span) }
    });
    spelt.collect::<Vec<_>>().join("`")
}

fn without_dashes(text: &str) -> String {
    let mut sent = String::with_capacity(text.len());
    for (i, part) in text.split("--").enumerate() {
        let begins_a_name = part.starts_with(|c: char| c.is_ascii_lowercase());
        let ends_a_word = sent.ends_with([' ', '(', '`', '"']) || sent.is_empty();
        if 0 < i && !(begins_a_name && ends_a_word) {
            sent.push_str("--");
        }
        sent.push_str(part);
    }
    sent
}

/// Bytes of some type.
pub(super) fn reply(bytes: impl Into<Bytes>, kind: &'static str) -> Reply {
    let mut reply = Response::new(Full::new(bytes.into()).boxed_unsync());
    reply.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static(kind));
    reply
}

pub(super) fn json_reply(value: &Value) -> Reply {
    let text = serde_json::to_string_pretty(value).unwrap_or_default() + "\n";
    reply(text, "application/json")
}

/// Under which name a browser keeps it.
pub(super) fn keep_as(reply: &mut Reply, name: &str) {
    let disposition = HeaderValue::from_str(&format!("attachment; filename=\"{name}\""));
    if let Ok(disposition) = disposition {
        reply.headers_mut().insert(CONTENT_DISPOSITION, disposition);
    }
}

/// What was said beside the answer.
pub(super) fn note(reply: &mut Reply, notes: &[String]) {
    if notes.is_empty() {
        return;
    }
    let mut sent: Vec<&str> = Vec::new();
    for note in notes {
        let length: usize = sent.iter().map(|note| note.len()).sum();
        if MOST_NOTES < length + note.len() {
            sent.push("there is more to be said; ask with Accept: application/x-ndjson");
            break;
        }
        sent.push(note);
    }
    if let Ok(value) = HeaderValue::from_str(&ascii(&json!(sent).to_string())) {
        reply.headers_mut().insert(NOTES, value);
    }
}

/// JSON in letters that a header may have.
fn ascii(json: &str) -> String {
    let mut escaped = String::with_capacity(json.len());
    for c in json.chars() {
        if c.is_ascii() && !c.is_ascii_control() {
            escaped.push(c);
        } else {
            let mut units = [0; 2];
            escaped.extend(c.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")));
        }
    }
    escaped
}

/// Puts on every reply what keeps a browser from doing anything else with it.
pub(super) fn guarded(mut reply: Reply) -> Reply {
    let headers = reply.headers_mut();
    headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    headers.insert(RESOURCE_POLICY, HeaderValue::from_static("same-origin"));
    headers.entry(CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    headers.entry(CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(DATA_POLICY));
    reply
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_options_are_sent_without_what_is_typed_before_them() {
        for (typed, sent) in [
            ("--model spatial asks; --within, --gap", "model spatial asks; within, gap"),
            ("without --force-n 3..4 one", "without force-n 3..4 one"),
            ("a--b and 3 -- 4 --5 (--x)", "a--b and 3 -- 4 --5 (x)"),
            ("", ""),
        ] {
            assert_eq!(as_sent(typed), sent);
        }
    }

    #[test]
    fn notes_of_any_letters_stand_in_a_header_and_are_read_back() {
        let notes = vec!["note: \u{b5}m \u{1f9be} \"x\"\r\n\u{7f}".to_owned()];
        let mut sent = reply("", "text/plain");
        note(&mut sent, &notes);
        let header = sent.headers()[NOTES].to_str().unwrap();
        assert_eq!(serde_json::from_str::<Vec<String>>(header).unwrap(), notes);
        note(&mut sent, &vec!["n".repeat(3000); 9]);
        assert!(sent.headers()[NOTES].len() < MOST_NOTES + 200);
    }
}
