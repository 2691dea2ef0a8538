//! How does a question become bytes? As the command line writes them to a file, up to a size.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use hyper::StatusCode;
use serde_json::{Map, Value, json};
use stiffarm_ask::ask::{ask, check_form, forms};
use stiffarm_ask::forms::{Answer, FORMS, Form, Forms, Picture};
use stiffarm_ask::request::{Request, job};

use super::form::Wanted;
use super::question::Question;
use super::reply::Refused;
use crate::client::Client;
use crate::failure::Failure;
use crate::output::write_as;

/// An answer of more bytes is refused.
const MOST_BYTES: usize = 64 << 20;

/// Computes the answer, and writes it.
pub(super) fn answered(question: &Question, client: Arc<Client>) -> Result<Vec<u8>, Refused> {
    let asked = &question.asked;
    match &question.wanted {
        Wanted::One(form) => {
            check(asked, *form)?;
            let common = question.common(client);
            written(&*ask(asked, common.context())?, *form)
        }
        Wanted::Several(forms) => {
            let common = question.common(client);
            together(&*ask(asked, common.context())?, forms, asked)
        }
        Wanted::Job => Ok(job::write(asked, &[], Path::new("job.toml")).into_bytes()),
        Wanted::Command => {
            let job = job::write(asked, &[], Path::new("job.toml"));
            let texts = json!({ "command": asked.command(), "python": asked.python(), "job": job });
            Ok(format!("{texts:#}\n").into_bytes())
        }
    }
}

/// That such an answer has the form, before anything is computed.
fn check(asked: &Request, form: Form) -> Result<(), Refused> {
    let (forms, verb) = (forms(asked), asked.verb.name());
    if forms.has(form) {
        return check_form(asked, form).map_err(|error| Failure::from(error).into());
    }
    let what = match form {
        Form::Report | Form::PrintedReport => "report; rank, place, mill, modes, identify and calibrate do",
        Form::Svg(Picture::Shop) => "shop drawing; place and mill do",
        Form::Svg(Picture::Lobes) => "figure of lobes beside its own; mill does",
        _ => return Err(without(verb, forms, form)),
    };
    Err(Failure::usage(format!("{verb} makes no {what}")).into())
}

/// An answer has no such form, but others.
pub(super) fn without(verb: &str, forms: Forms, form: Form) -> Refused {
    let words: Vec<&str> = FORMS.iter().filter(|row| forms.has(row.form)).map(|row| row.word).collect();
    let why = format!("{verb} has no form {}; expected one of {}", form.row().word, words.join(", "));
    Failure::usage(why).into()
}

/// Every form under its word, null where it is refused, and why in `refused`: a path that is not followed has its table and no figure.
fn together(answer: &dyn Answer, forms: &[Form], asked: &Request) -> Result<Vec<u8>, Refused> {
    let (mut parts, mut refused, mut length) = (Vec::new(), Map::new(), 0);
    for &form in forms {
        let text = match check(asked, form).and_then(|()| written(answer, form)) {
            Ok(bytes) if form.is_json() => on_one_line_of_json(&bytes),
            Ok(bytes) => json!(String::from_utf8_lossy(&bytes)).to_string(),
            Err(why) => {
                refused.insert(form.row().word.into(), why.json());
                "null".into()
            }
        };
        length += text.len();
        if MOST_BYTES <= length {
            return Err(too_large());
        }
        parts.push(format!("{}:{text}", json!(form.row().word)));
    }
    parts.push(format!("\"refused\":{}", Value::Object(refused)));
    Ok(format!("{{{}}}\n", parts.join(",")).into_bytes())
}

/// JSON without line breaks and what stands before a line, which are no part of a value: the digits stay as they were written.
pub(super) fn on_one_line_of_json(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).lines().map(str::trim_start).collect()
}

fn too_large() -> Refused {
    let why = format!("the answer has more than {} MiB", MOST_BYTES >> 20);
    Refused::new(StatusCode::UNPROCESSABLE_ENTITY, why, "ask for fewer points, or the command line")
}

/// A form that the answer has.
pub(super) fn written(answer: &dyn Answer, form: Form) -> Result<Vec<u8>, Refused> {
    let mut out = Bounded(Vec::new());
    let written = write_as(answer, form, &mut out);
    if MOST_BYTES <= out.0.len() {
        return Err(too_large());
    }
    written?;
    Ok(out.0)
}

/// Takes no more than [`MOST_BYTES`].
struct Bounded(Vec<u8>);

impl Write for Bounded {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let room = MOST_BYTES - self.0.len();
        if room == 0 {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        let taken = &bytes[..bytes.len().min(room)];
        self.0.extend_from_slice(taken);
        Ok(taken.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
