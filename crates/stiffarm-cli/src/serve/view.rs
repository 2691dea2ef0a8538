//! A view in space as a page of its own, for a frame: its script draws with code that it makes, so it runs under a policy of its own, in an
//! origin of its own, and may reach nothing.

use std::sync::Arc;

use hyper::StatusCode;
use hyper::header::{CONTENT_SECURITY_POLICY, HeaderValue};
use stiffarm_ask::forms::Form;
use stiffarm_ask::request::Verb;

use super::Server;
use super::answer::answered;
use super::form::Wanted;
use super::question::{Question, query};
use super::reply::{Refused, Reply, reply};
use super::work::{Patience, aside};
use crate::client::Client;

const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; img-src data: blob:; \
                      connect-src 'none'; sandbox allow-scripts; frame-ancestors 'self'";
/// Under which name the question stands.
const QUESTION: &str = "question";

/// A form that is posted: `question=` and the JSON that [`Question`] reads.
pub(super) async fn posted(server: &Arc<Server>, verb: Verb, body: Vec<u8>) -> Result<Reply, Refused> {
    let question = aside(move || read(verb, &body)).await?;
    let place = server.workshop.line_up(Patience::Long)?;
    let client = Arc::new(Client::waiting());
    // As long as somebody waits: a frame is no stream, and whoever leaves it hangs up.
    let bytes = server.workshop.work(place, client, move |client| answered(&question, client)).await?;
    let mut page = reply(bytes, Form::View.row().media_type);
    page.headers_mut().insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    Ok(page)
}

fn read(verb: Verb, body: &[u8]) -> Result<Question, Refused> {
    let text = std::str::from_utf8(body).map_err(|_| unlike())?;
    let asked = query(Some(text))?;
    let [(name, text)] = asked.as_slice() else { return Err(unlike()) };
    if name != QUESTION {
        return Err(unlike());
    }
    Question::read(verb, Wanted::One(Form::View), text.as_bytes())
}

fn unlike() -> Refused {
    let why = "a view is asked with one field, 'question', and the JSON of a question in it";
    Refused::new(StatusCode::BAD_REQUEST, why, "POST /view/place as a form sends it: question=%7B%22options%22...%7D")
}
