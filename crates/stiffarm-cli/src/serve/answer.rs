//! How does a question become bytes? As the command line writes them to a file, up to a size.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use hyper::StatusCode;
use serde_json::json;
use stiffarm_ask::ask::ask;
use stiffarm_ask::forms::Answer;
use stiffarm_ask::request::job;

use super::form::Form;
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
    match question.form {
        Form::Job => return Ok(job::write(asked, &[], Path::new("job.toml")).into_bytes()),
        Form::Command => {
            let job = job::write(asked, &[], Path::new("job.toml"));
            let told = json!({ "command": asked.command(), "python": asked.python(), "job": job });
            return Ok(format!("{told:#}\n").into_bytes());
        }
        _ => {}
    }
    let common = question.common(client);
    let told = ask(asked, common.context())?;
    if question.form.is_report() && !told.forms().is_reported {
        let why = format!("{} makes no report; rank, place, mill, identify and calibrate do", asked.verb.name());
        return Err(Failure::usage(why).into());
    }
    written(&*told, &question.form.file(asked.verb))
}

/// What a file of this name would hold.
pub(super) fn written(told: &dyn Answer, name: &str) -> Result<Vec<u8>, Refused> {
    let mut out = Bounded(Vec::new());
    let written = write_as(told, Path::new(name), &mut out);
    if MOST_BYTES <= out.0.len() {
        let why = format!("the answer has more than {} MiB", MOST_BYTES >> 20);
        return Err(Refused::new(StatusCode::UNPROCESSABLE_ENTITY, why, "ask for fewer points, or the command line"));
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
