//! Which address answers what?

use std::sync::Arc;
use std::time::Duration;

use http_body_util::{BodyExt, LengthLimitError, Limited};
use hyper::body::{Body, Incoming};
use hyper::header::ACCEPT;
use hyper::{HeaderMap, Method, Request, StatusCode};
use stiffarm_ask::request::Verb;
use tokio::time::timeout;

use super::admission::{admit, is_json};
use super::answer::answered;
use super::form::Wanted;
use super::openapi::address;
use super::question::{Question, unlike, wanted_of};
use super::reply::{Refused, Reply, guarded, keep_as, note, reply};
use super::work::{Patience, aside, within};
use super::{Server, job, openapi, options, page, robots, stream, view};

/// Of a question, bytes: as large as a file may be.
const MOST_BODY: usize = 4 << 20;
/// Of a question that is too large, so much is read and thrown away, so that whoever sends it hears why.
const MOST_THROWN_AWAY: usize = 16 << 20;
/// Until a question is there.
const BODY_TIME: Duration = Duration::from_secs(10);

/// Answers every request, with a refusal where there is nothing else.
pub(super) async fn route(server: &Arc<Server>, request: Request<Incoming>) -> Reply {
    let found = routed(server, request).await;
    guarded(found.unwrap_or_else(|refused| refused.reply()))
}

async fn routed(server: &Arc<Server>, request: Request<Incoming>) -> Result<Reply, Refused> {
    admit(request.method(), request.uri(), request.headers(), &server.host)?;
    let (path, asked) = (request.uri().path().to_owned(), request.uri().query().map(ToOwned::to_owned));
    let is_read = matches!(*request.method(), Method::GET | Method::HEAD);
    let read_only = |found: Result<Reply, Refused>| if is_read { found } else { Err(Refused::method("GET")) };
    if let Some(name) = path.strip_prefix("/api/robots/").filter(|name| !["check", "verify"].contains(name)) {
        return if is_read { robots::shown(server, name, asked.as_deref()).await } else { Err(Refused::method("GET")) };
    }
    match path.as_str() {
        "/openapi.json" => read_only(Ok(openapi::reply())),
        "/api/options" => read_only(Ok(options::reply())),
        "/api/robots" if is_read => robots::listed(server, asked.as_deref()).await,
        "/api/robots" => Err(Refused::method("GET")),
        "/api/job" => {
            let body = posted(request).await?;
            aside(move || job::understood(&body)).await
        }
        "/api/robots/check" => robots::checked(server, posted(request).await?).await,
        path => {
            let verb = |prefix: &str| {
                let name = path.strip_prefix(prefix)?;
                Verb::jobs().find(|verb| address(*verb) == name)
            };
            match (verb("/api/"), verb("/view/")) {
                (Some(verb), _) => answer(server, verb, wanted_of(asked.as_deref())?, request).await,
                // Any page may have a browser read an address, in a picture say: what reads computes little.
                (_, Some(_)) if *request.method() != Method::POST => Err(Refused::method("POST")),
                (_, Some(verb)) => view::posted(server, verb, body(request).await?).await,
                _ => page::part(path, request.headers()).and_then(|part| read_only(Ok(part))),
            }
        }
    }
}

/// The body of a question as JSON.
async fn posted(request: Request<Incoming>) -> Result<Vec<u8>, Refused> {
    if *request.method() != Method::POST {
        return Err(Refused::method("POST"));
    }
    is_json(request.headers())?;
    body(request).await
}

/// A body, all of it in time.
async fn body(request: Request<Incoming>) -> Result<Vec<u8>, Refused> {
    let late = |_| {
        let why = format!("the question was not there after {} s", BODY_TIME.as_secs());
        Refused::new(StatusCode::REQUEST_TIMEOUT, why, "send all of it at once")
    };
    timeout(BODY_TIME, read(request.into_body())).await.map_err(late)?
}

async fn read(body: Incoming) -> Result<Vec<u8>, Refused> {
    let mut body = Limited::new(body, MOST_THROWN_AWAY);
    let is_large = MOST_BODY < body.size_hint().lower() as usize;
    let mut bytes = Vec::new();
    let mut length = 0;
    while let Some(frame) = body.frame().await {
        let frame = match frame {
            Err(error) if error.is::<LengthLimitError>() => return Err(large()),
            Err(error) => return Err(unlike(&error.to_string())),
            Ok(frame) => frame,
        };
        let Ok(data) = frame.into_data() else { continue };
        length += data.len();
        if length <= MOST_BODY && !is_large {
            bytes.extend_from_slice(&data);
        } else {
            bytes = Vec::new();
        }
    }
    if MOST_BODY < length { Err(large()) } else { Ok(bytes) }
}

fn large() -> Refused {
    let why = format!("the question has more than {} MiB", MOST_BODY >> 20);
    Refused::new(StatusCode::PAYLOAD_TOO_LARGE, why, "the command line reads longer paths and files")
}

/// The answer of a verb, at once or line by line.
async fn answer(
    server: &Arc<Server>,
    verb: Verb,
    wanted: Wanted,
    request: Request<Incoming>,
) -> Result<Reply, Refused> {
    let accepts = request.headers().get_all(ACCEPT).iter().filter_map(|kinds| kinds.to_str().ok());
    let is_stream = accepts.flat_map(|kinds| kinds.split(',')).any(|kind| kind.trim().starts_with(stream::KIND));
    let wait = wait_of(request.headers());
    let body = posted(request).await?;
    let question = aside(move || Question::read(verb, wanted, &body)).await?;
    if is_stream {
        if !question.wanted.is_text() {
            let why = "a picture does not come line by line";
            let hint =
                "ask for it without Accept: application/x-ndjson, and with Prefer: wait=SECONDS where it takes long";
            return Err(Refused::new(StatusCode::BAD_REQUEST, why, hint));
        }
        return Ok(stream::stream(Arc::clone(&server.workshop), server.workshop.line_up(Patience::Long)?, question));
    }
    let (kind, is_json) = (question.wanted.media_type(), question.wanted.is_json());
    // Of a task that is a toolpath mill is asked.
    let name = question.wanted.file(question.asked.verb);
    let (bytes, notes) = within(server, wait, move |client| answered(&question, client)).await?;
    let mut response = reply(bytes, kind);
    if !is_json {
        keep_as(&mut response, &name);
    }
    note(&mut response, &notes);
    Ok(response)
}

/// How long somebody says to wait: `Prefer: wait=600` (RFC 7240).
fn wait_of(headers: &HeaderMap) -> Option<Duration> {
    let preferences = headers.get_all("prefer").iter().filter_map(|said| said.to_str().ok());
    let seconds = preferences.flat_map(|said| said.split([',', ';'])).find_map(|one| one.trim().strip_prefix("wait="));
    // What is not understood is ignored, as the standard has it.
    seconds?.trim().parse().ok().map(Duration::from_secs)
}
