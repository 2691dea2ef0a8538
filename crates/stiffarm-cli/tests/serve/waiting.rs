//! Who waits, for how long, and what ends when nobody does?

use std::io::{BufRead, BufReader, Read, Write};
use std::thread;
use std::time::Duration;

use assert_cmd::Command;
use percent_encoding::NON_ALPHANUMERIC;
use serde_json::{Value, json};

use super::served::Served;

/// Work that takes minutes on any machine.
fn long() -> Value {
    let tasks: Vec<String> = (20..60).map(|cm| format!("rect:0.{cm}x0.3")).collect();
    json!({ "options": { "robots": "all", "task": tasks, "model": "spatial" } })
}

/// Reads lines of a stream until one says that work has begun.
fn begun(reader: &mut impl BufRead) -> Value {
    loop {
        let mut line = String::new();
        assert_ne!(reader.read_line(&mut line).expect("it tells"), 0, "it ended before it began");
        let message = serde_json::from_str::<Value>(&line).unwrap_or_default();
        let progress = &message["progress"];
        if progress["doing"].as_str().is_some_and(|doing| doing != "waiting") {
            return progress.clone();
        }
    }
}

#[test]
fn who_hangs_up_frees_the_worker_and_a_full_line_is_reported_at_once() {
    let served = Served::start(&["--threads", "1"]);
    let accept = "Accept: application/x-ndjson\r\n";
    let long_question = served.question("/api/rank", accept, &long().to_string());
    let work = || {
        let mut stream = served.connect();
        stream.write_all(long_question.as_bytes()).unwrap();
        stream
    };
    let mut working = BufReader::new(work());
    assert_eq!(begun(&mut working)["doing"], "placing zones");
    // One works; eight wait.
    let waiting: Vec<_> = (0..8)
        .map(|_| {
            let mut stream = BufReader::new(work());
            let mut line = String::new();
            while !line.contains("waiting") {
                line.clear();
                assert_ne!(stream.read_line(&mut line).unwrap(), 0);
            }
            stream
        })
        .collect();
    let short = json!({ "options": { "robot": "BT200L", "task": "circle:0.3" } });
    let full = served.post("/api/rank", accept, &long().to_string());
    assert_eq!((full.status, full.header("retry-after")), (503, Some("1")), "{}", full.text());
    assert_eq!(served.get("/").status, 200, "what needs no worker is answered");
    assert_eq!(served.ask("/api/place", &short).status, 200, "streams, however many, keep no short question out");
    drop(waiting);
    drop(working);
    // A short one now comes to its turn among the long ones, though nobody has finished these.
    let freed = (0..1200).any(|_| match served.post("/api/place", accept, &short.to_string()).status {
        200 => true,
        503 => {
            thread::sleep(Duration::from_millis(100));
            false
        }
        other => panic!("{other}"),
    });
    assert!(freed, "the worker is not free");
}

#[test]
fn an_answer_that_takes_too_long_is_broken_off_and_the_same_goes_on_in_a_stream() {
    let served = Served::start(&["--threads", "1", "--time-limit-s", "1"]);
    let late = served.ask("/api/rank", &long());
    assert_eq!(late.status, 504, "{}", late.text());
    assert!(late.json()["hint"].as_str().unwrap().contains("application/x-ndjson"));
    let short = json!({ "options": { "task": "A:0.5" } });
    let lines = served.post("/api/rank", "Accept: application/x-ndjson\r\n", &short.to_string());
    assert_eq!((lines.status, lines.header("content-type")), (200, Some("application/x-ndjson")));
    let text = lines.text();
    let last: Value = serde_json::from_str(text.lines().last().unwrap()).unwrap();
    assert_eq!(last["answer"], Served::start(&[]).ask("/api/rank", &short).json());
    let refused = served.post(
        "/api/place",
        "Accept: application/x-ndjson\r\n",
        &json!({ "options": { "robot": "x", "task": "A:0.5" } }).to_string(),
    );
    let last: Value = serde_json::from_str(refused.text().lines().last().unwrap()).unwrap();
    assert!(last["error"].as_str().unwrap().contains("not known") && last["status"] == 422, "{last}");
}

/// Longer than a question may take that is no stream: everything that the page shows of an answer comes of the one computation, and so do its files
/// and its view, for which somebody says to wait.
#[test]
fn an_answer_that_takes_longer_than_the_limit_arrives_whole() {
    let served = Served::start(&[]);
    let place = json!({ "options": { "robot": "BT200L", "task": "rect:0.3x0.2", "model": "spatial" } });
    let hurried = served.post("/api/place?as=svg", "Prefer: wait=0\r\n", &place.to_string());
    assert_eq!(hurried.status, 504, "{}", hurried.text());
    let lines = served.post("/api/place?as=json,tables,svg", "Accept: application/x-ndjson\r\n", &place.to_string());
    let last: Value = serde_json::from_str(lines.text().lines().last().unwrap()).unwrap();
    let answer = &last["answer"];
    assert!(answer["json"]["feasible"] == true && answer["svg"].as_str().unwrap().starts_with("<svg"), "{last}");
    assert!(answer["tables"]["tables"][0]["lead"]["value"].as_str().unwrap().ends_with(" mm"), "{last}");
    let patient =
        |form: &str| served.post(&format!("/api/place?as={form}"), "Prefer: wait=600\r\n", &place.to_string());
    assert_eq!(patient("png").body[..4], *b"\x89PNG");
    assert_eq!(patient("svg").text(), answer["svg"].as_str().unwrap());
    let form = |place: &Value| {
        format!("question={}", percent_encoding::utf8_percent_encode(&place.to_string(), NON_ALPHANUMERIC))
    };
    let view = served.post("/view/place", "Content-Type: application/x-www-form-urlencoded\r\n", &form(&place));
    assert_eq!((view.status, view.header("content-type")), (200, Some("text/html; charset=utf-8")), "{}", view.head);
}

/// Who waits for a file as long as it takes, and hangs up, frees the worker as who leaves a stream does.
#[test]
fn who_hangs_up_on_a_file_frees_the_worker() {
    let served = Served::start(&["--threads", "1"]);
    let file = served.question("/api/rank?as=svg", "Prefer: wait=86400\r\n", &long().to_string());
    let short = json!({ "options": { "robot": "BT200L", "task": "circle:0.3" } }).to_string();
    let is_full = || served.post("/api/place", "Accept: application/x-ndjson\r\n", &short).status == 503;
    let soon = |holds: &dyn Fn() -> bool| {
        (0..1200).any(|_| {
            thread::sleep(Duration::from_millis(50));
            holds()
        })
    };
    // As many as there are places for long work.
    let send = |_| {
        let mut stream = served.connect();
        stream.write_all(file.as_bytes()).unwrap();
        stream
    };
    let waiting: Vec<_> = (0..9).map(send).collect();
    assert!(soon(&is_full), "there is room for more");
    drop(waiting);
    assert!(soon(&|| !is_full()), "the worker is not free");
}

#[test]
fn it_ends_when_it_is_asked_to_and_says_so_by_its_exit_code() {
    for signal in ["-INT", "-TERM"] {
        let mut served = Served::start(&[]);
        assert_eq!(served.get("/").status, 200);
        let sent = std::process::Command::new("kill").args([signal, &served.child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        let status = served.child.wait().unwrap();
        assert!(status.success(), "{signal}: {status}");
    }
    let served = Served::start(&[]);
    let taken =
        Command::cargo_bin("stiffarm").unwrap().args(["serve", "--port", &served.port.to_string()]).output().unwrap();
    assert!(!taken.status.success() && String::from_utf8_lossy(&taken.stderr).contains("hint: --port 0"));
}

/// Asked to end, it lets out an answer that is nearly there; one that takes minutes is broken off, and it ends all the same.
#[test]
fn an_answer_under_way_goes_out_before_it_ends_and_one_that_takes_minutes_does_not_hold_it() {
    let short = json!({ "options": { "robot": "BT200L", "task": "rect:0.3x0.2", "model": "spatial" } });
    for (verb, question, is_answered) in [("place", short, true), ("rank", long(), false)] {
        let mut served = Served::start(&["--threads", "1"]);
        let mut stream = served.connect();
        let asked = served.question(&format!("/api/{verb}"), "Accept: application/x-ndjson\r\n", &question.to_string());
        stream.write_all(asked.as_bytes()).unwrap();
        let mut stream = BufReader::new(stream);
        if is_answered {
            // It has taken the question; how far it is nobody knows, and a quick one says nothing on the way.
            let mut line = String::new();
            stream.read_line(&mut line).unwrap();
            assert_eq!(line.trim(), "HTTP/1.1 200 OK");
        } else {
            begun(&mut stream);
        }
        let sent = std::process::Command::new("kill").args(["-TERM", &served.child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        let mut rest = Vec::new();
        // Where the answer is broken off the line may be reset.
        let _ = stream.read_to_end(&mut rest);
        assert_eq!(String::from_utf8_lossy(&rest).contains(r#""answer""#), is_answered, "{verb}");
        assert!(served.child.wait().unwrap().success(), "{verb}");
        assert!(std::net::TcpStream::connect(("127.0.0.1", served.port)).is_err(), "it still listens");
    }
}
