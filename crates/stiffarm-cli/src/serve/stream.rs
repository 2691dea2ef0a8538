//! How does somebody wait for long work? Line by line: how far it is, and at last the answer. Who hangs up stops the work.

use std::convert::Infallible;
use std::pin::{Pin, pin};
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;

use http_body_util::BodyExt;
use hyper::Response;
use hyper::body::{Body, Bytes, Frame};
use hyper::header::{CONTENT_TYPE, HeaderValue};
use serde_json::{Value, json};
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tokio::time::interval;

use super::answer::{answered, on_one_line_of_json};
use super::question::Question;
use super::reply::{Refused, Reply};
use super::work::{Place, Workshop};
use crate::client::{Client, Far};

/// How the stream is called.
pub(super) const KIND: &str = "application/x-ndjson";
/// Between two looks at how far it is.
const PAUSE: Duration = Duration::from_millis(200);
/// Lines that are not taken yet.
const LINES: usize = 8;

/// Lines as they come.
struct Lines(Receiver<Bytes>);

impl Body for Lines {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        self.0.poll_recv(context).map(|line| line.map(|bytes| Ok(Frame::data(bytes))))
    }
}

/// The answer as a stream.
pub(super) fn stream(workshop: Arc<Workshop>, place: Place, question: Question) -> Reply {
    let (lines, taken) = channel(LINES);
    tokio::spawn(follow(workshop, place, question, lines));
    let mut reply = Response::new(Lines(taken).boxed_unsync());
    reply.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static(KIND));
    reply
}

/// Works, and tells how far it is, until there is an answer, or nobody reads.
async fn follow(workshop: Arc<Workshop>, place: Place, question: Question, lines: Sender<Bytes>) {
    let client = Arc::new(Client::waiting());
    let is_json = question.wanted.is_json();
    let mut work = pin!(workshop.work(place, Arc::clone(&client), move |client| answered(&question, client)));
    let mut ticks = interval(PAUSE);
    let mut last: Option<Far> = None;
    loop {
        tokio::select! {
            found = &mut work => {
                let line = last_line(found, is_json, &client.remarks());
                // Where nobody takes it, nobody wants it.
                let _ = lines.send(line).await;
                return;
            }
            _ = ticks.tick() => {
                let far = client.far();
                // Who reads slowly gets fewer lines.
                if last != Some(far) && lines.try_send(progress(far)).is_ok() {
                    last = Some(far);
                }
            }
            // Dropping the work leaves its worker.
            () = lines.closed() => return,
        }
    }
}

fn progress(Far { doing, done, total }: Far) -> Bytes {
    line(&json!({ "progress": { "doing": doing, "done": done, "total": total } }))
}

fn line(value: &Value) -> Bytes {
    format!("{value}\n").into()
}

/// The answer, or why there is none, and what was said beside it.
fn last_line(found: Result<Vec<u8>, Refused>, is_json: bool, notes: &[String]) -> Bytes {
    let bytes = match found {
        Ok(bytes) => bytes,
        Err(refused) => {
            let mut error = refused.json();
            error["status"] = refused.status.as_u16().into();
            error["notes"] = json!(notes);
            return line(&error);
        }
    };
    let notes = json!(notes);
    let answer = if is_json { on_one_line_of_json(&bytes) } else { json!(String::from_utf8_lossy(&bytes)).to_string() };
    format!("{{\"answer\":{answer},\"notes\":{notes}}}\n").into()
}
