//! Is refused what must be, with a word, and does the server stay up whatever is sent to it?

use std::io::{BufRead, BufReader, Write};

use serde_json::json;

use super::TWO_LINKS;
use super::served::{Served, heard};

#[test]
fn no_name_that_is_sent_leads_to_a_file_of_the_server() {
    let served = Served::start(&[]);
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/../stiffarm/robots/paper/kawasaki_bt200l.toml");
    let at_hand = "Cargo.toml";
    for name in [
        here,
        at_hand,
        "/etc/passwd",
        "../../../../etc/passwd",
        "..",
        "/",
        ".",
        "src",
        "file:///etc/passwd",
        "\\\\host\\share\\a.toml",
    ] {
        let robot = served.ask("/api/place", &json!({ "options": { "robot": name, "task": "circle:0.3" } }));
        assert_eq!(robot.status, 422, "{name}: {}", robot.text());
        assert!(robot.json()["error"].as_str().unwrap().ends_with("is not known"), "{}", robot.text());
        let robots = served.ask("/api/rank", &json!({ "options": { "robots": name, "task": "circle:0.3" } }));
        assert!(robots.json()["error"].as_str().unwrap().contains("is not known"), "{}", robots.text());
        let questions = [
            ("force", json!({ "process": name })),
            ("mill", json!({ "path": name, "dry": true, "read-as": "gcode" })),
            ("identify", json!({ "data": name, "robot": "BT200L" })),
            ("measure", json!({ "robot": "BT200L", "compare": name })),
        ];
        for (verb, options) in questions {
            let refused =
                served.ask(&format!("/api/{verb}"), &json!({ "options": options, "files": { "other": "text" } }));
            assert_eq!(refused.status, 422, "{verb} {name}: {}", refused.text());
            assert!(refused.json()["error"].as_str().unwrap().contains("came along"), "{verb}: {}", refused.text());
        }
        // A file that came along may name another one.
        let names_it = format!("[measured]\nfile = {}\non = \"tool\"\n", json!(name));
        let question = json!({ "options": { "process": "p.toml" }, "files": { "p.toml": names_it } });
        let refused = served.ask("/api/force", &question);
        assert_eq!(refused.status, 422, "{name}: {}", refused.text());
        assert!(refused.json()["error"].as_str().unwrap().contains("came along"), "{}", refused.text());
        let compared =
            served.ask("/api/compare", &json!({ "options": { "a": name, "b": "BT200L", "task": "circle:0.3" } }));
        assert!(compared.json()["error"].as_str().unwrap().contains("is not known"), "{}", compared.text());
    }
    for path in [
        "/assets/../Cargo.toml",
        "/assets/%2e%2e/Cargo.toml",
        "/assets//etc/passwd",
        "/../../etc/passwd",
        "/api/robots/..%2f..%2fetc%2fpasswd",
    ] {
        assert!(matches!(served.get(path).status, 404 | 422), "{path}");
    }
}

/// Of two forces of one name nobody knows which was meant.
#[test]
fn a_key_that_is_sent_twice_is_refused() {
    let served = Served::start(&[]);
    let once = r#"{"options": {"robot": "BT200L", "task": "circle:0.3", "force-n": 100}}"#;
    assert_eq!(served.post("/api/place", "", once).status, 200);
    for twice in [
        r#"{"options": {"robot": "BT200L", "task": "circle:0.3", "force-n": 100, "force-n": 900}}"#,
        r#"{"options": {"robot": "BT200L", "task": "circle:0.3"}, "options": {"robot": "BT200L", "task": "circle:0.9"}}"#,
        r#"{"options": {"robot": "BT200L", "task": "circle:0.3", "cell": {"mount": "floor", "mount": "wall:1"}}}"#,
    ] {
        let refused = served.post("/api/place", "", twice);
        assert_eq!(refused.status, 400, "{twice}: {}", refused.text());
        assert!(
            refused.json()["error"].as_str().unwrap().contains("is there twice; expected it once"),
            "{}",
            refused.text()
        );
    }
}

/// 10^10 samples of a question of a hundred letters, and of a program of one line that drills a million holes.
#[test]
fn a_path_of_more_samples_than_memory_has_room_for_is_refused_before_they_are_made() {
    let served = Served::start(&[]);
    let drilled = "G21 G90 G0 X0 Y0 Z5\nF100 G98 G83 X1 Y1 Z-10 R1 Q.01\n".to_owned() + &"X.001 L9\n".repeat(400_000);
    for options in [json!({ "path": "raster:rect:50x50@0.0005" }), json!({ "path": "a.nc" })] {
        for who in [json!({ "robot": "BT200L", "at": [1, 0, 0.5] }), json!({ "robots": "all" })] {
            let mut asked = options.clone();
            asked.as_object_mut().unwrap().extend(who.as_object().unwrap().clone());
            asked["force-n"] = json!(100);
            let reply = served.ask("/api/mill", &json!({ "options": asked, "files": { "a.nc": drilled } }));
            assert_eq!(reply.status, 400, "{asked}: {}", reply.text());
            assert!(reply.text().contains("step-mm of"), "{asked}: {}", reply.text());
        }
    }
}

/// Each of these took the square of its length, some of them on the threads that speak HTTP: minutes to hours.
#[test]
fn what_is_sent_is_read_in_a_time_that_goes_with_its_length() {
    let served = Served::start(&["--threads", "1"]);
    let many = |count: usize, one: &dyn Fn(usize) -> String| (0..count).map(one).collect::<String>();
    let name = "n".repeat(3 << 20);
    let job = "verb = 'place'\n".to_owned() + &many(200_000, &|i| format!("key{i} = {i}\n"));
    let listed = "verb = 'place'\nwithin = [".to_owned() + &"'1..2,1..2',\n".repeat(200_000) + "]\n";
    let links =
        many(40_000, &|i| format!("<link name='l{i}'/><joint name='j{i}' type='fixed'><parent link='l{i}'/></joint>"));
    let columns = many(500_000, &|i| format!("c{i},"));
    let options = |options: serde_json::Value| json!({ "options": options });
    let with =
        |options: serde_json::Value, name: &str, text: &str| json!({ "options": options, "files": { name: text } });
    for (path, question, status) in [
        ("/api/job", json!({ "name": "job.toml", "text": job }), 400),
        ("/api/job", json!({ "name": "job.toml", "text": listed }), 200),
        ("/api/job", json!({ "name": name, "text": "verb = 'place'" }), 400),
        ("/api/robots/check", json!({ "name": name, "text": "" }), 400),
        ("/api/robots/check", json!({ "name": "a.toml", "text": job }), 200),
        ("/api/robots/check", json!({ "name": "a.urdf", "text": format!("<robot name='r'>{links}</robot>") }), 200),
        ("/api/place", options(json!({ "robot": name, "task": "circle:0.3" })), 422),
        ("/api/place", options(json!({ "robot": "BT200L", "task": name })), 400),
        ("/api/place", options(json!({ "robot": "BT200L", "task": "circle:0.3", (name.clone()): 1 })), 400),
        ("/api/rank", options(json!({ "robots": format!("*{name}"), "task": "circle:0.3" })), 422),
        ("/api/rank", options(json!({ "robots": vec!["*"; 1000], "task": "circle:9" })), 200),
        ("/api/force", with(json!({ "process": &name[..1 << 20] }), &name[..1 << 20], ""), 400),
        ("/api/identify", with(json!({ "robot": "KR 210 R2700 extra", "data": "a.csv" }), "a.csv", &columns), 422),
        (
            "/api/force",
            with(json!({ "process": "p.toml" }), "p.toml", &format!("[material]\npreset = '{name}'\n")),
            422,
        ),
        ("/api/mill", with(json!({ "path": "a.csv", "dry": true }), "a.csv", &columns), 422),
    ] {
        // By somebody who waits as long as a slow machine takes.
        let reply = served.post(path, "Prefer: wait=600\r\n", &question.to_string());
        let said = reply.text();
        let start: String = said.chars().take(300).collect();
        assert_eq!(reply.status, status, "{path}: {start}");
        assert_eq!(served.get("/api/options").status, 200);
    }
}

#[test]
fn only_who_calls_the_server_by_its_own_name_and_from_its_own_page_is_answered() {
    let served = Served::start(&[]);
    let ask = |host: &str, more: &str| {
        let body = "{\"options\": {\"robot\": \"BT200L\", \"task\": \"circle:0.3\"}}";
        let length = body.len();
        let kind = "Content-Type: application/json; charset=utf-8";
        let head = format!(
            "POST /api/place HTTP/1.1\r\n{host}Connection: close\r\n{kind}\r\nContent-Length: {length}\r\n{more}\r\n"
        );
        served.raw((head + body).as_bytes()).status
    };
    let own = format!("Host: localhost:{}\r\n", served.port);
    assert_eq!(ask(&own, ""), 200);
    assert_eq!(ask(&own, &format!("Origin: http://localhost:{}\r\nSec-Fetch-Site: same-origin\r\n", served.port)), 200);
    for host in ["Host: evil.example\r\n", "Host: localhost.evil.example\r\n", "Host: 127.0.0.1.evil.example:80\r\n"] {
        assert_eq!(ask(host, ""), 403, "{host}");
    }
    assert_eq!(ask("", ""), 400);
    assert_eq!(ask("Host: localhost\r\nHost: localhost\r\n", ""), 400);
    for from in [
        "Origin: http://evil.example",
        "Origin: null",
        "Origin: https://localhost",
        "Sec-Fetch-Site: cross-site",
        "Sec-Fetch-Site: same-site",
    ] {
        assert_eq!(ask(&own, &format!("{from}\r\n")), 403, "{from}");
    }
    assert_eq!(served.post("/api/place", "Content-Type: text/plain\r\n", "{}").status, 415);
    // A picture or a link of any page may lead here: the page may be opened, and nothing be computed.
    for from in ["Sec-Fetch-Site: cross-site", "Sec-Fetch-Site: same-site", "Origin: http://evil.example"] {
        let read = |path: &str| {
            served.raw(format!("GET {path} HTTP/1.1\r\n{own}Connection: close\r\n{from}\r\n\r\n").as_bytes()).status
        };
        assert_eq!(["/", "/assets/page.js"].map(read), [200; 2], "{from}");
        let computed = [
            "/api/robots",
            "/api/robots/BT200L?as=png",
            "/api/options",
            "/openapi.json",
            "/view/place?question=%7B%7D",
        ];
        assert_eq!(computed.map(read), [403; 5], "{from}");
    }
    let page = served.get("/");
    assert_eq!(page.status, 200);
    let policy = page.header("content-security-policy").unwrap();
    assert!(policy.starts_with("default-src 'none'; script-src 'self';") && !policy.contains("eval"), "{policy}");
    for reply in [page, served.get("/api/robots/BT200L"), served.get("/nothing")] {
        assert_eq!(reply.header("x-content-type-options"), Some("nosniff"), "{}", reply.head);
        assert!(reply.header("content-security-policy").unwrap().contains("default-src 'none'"));
    }
}

#[test]
fn what_is_malformed_is_refused_with_a_word_and_harms_nobody() {
    let served = Served::start(&[]);
    for (path, body, status, words) in [
        ("/api/place", "", 400, "not understood"),
        ("/api/place", "{", 400, "not understood"),
        ("/api/place", "[]", 400, "no object"),
        ("/api/place", "{\"options\": 3}", 400, "no object"),
        ("/api/place", "{\"optoins\": {}}", 400, "optoins"),
        ("/api/place", "{\"options\": {}, \"files\": {\"a\": 1}}", 400, "no text"),
        ("/api/place", "{\"options\": {\"robot\": \"BT200L\"}}", 400, "task is missing"),
        ("/api/place", "{\"options\": {\"robot\": \"BT200L\", \"task\": \"circle:-1\"}}", 400, "invalid value"),
        (
            "/api/place",
            "{\"options\": {\"robot\": \"BT200L\", \"task\": \"circle:0.3\", \"toleranc-mm\": 1}}",
            400,
            "did you mean tolerance-mm",
        ),
        ("/api/place", "{\"options\": {\"robot\": \"BT200\", \"task\": \"circle:0.3\"}}", 422, "is not known"),
        (
            "/api/place",
            "{\"options\": {\"robot\": \"m.toml\", \"task\": \"circle:0.3\"}, \"files\": {\"m.toml\": \"x = 1\"}}",
            422,
            "m.toml",
        ),
        ("/api/map", "{\"options\": {\"robot\": \"BT200L\", \"size\": 100000}}", 400, "too much"),
        ("/api/map", "{\"options\": {\"robot\": \"BT200L\", \"step-m\": 0.00001}}", 400, "too much"),
        ("/api/measure", "{\"options\": {\"robot\": \"BT200L\", \"candidates\": 1000000}}", 400, "too much"),
        ("/api/nothing", "{}", 404, "nothing of this name"),
        ("/api/robots/check", "{\"name\": \"a\"}", 400, "expected"),
        ("/api/robots/verify", "{\"options\": {\"robot\": \"BT200L\"}}", 400, "data is missing"),
        ("/api/robots/verify", "{\"options\": {\"data\": \"a\"}}", 400, "robot is missing"),
        ("/api/robots/verify", "{\"options\": {\"data\": \"/etc/passwd\", \"any\": true}}", 422, "came along"),
        ("/api/robots/verify", "{\"options\": {\"data\": \"a\", \"tool\": 1}}", 400, "tool does not go with"),
        ("/api/robots/verify", "{\"options\": {\"data\": \"a\", \"date\": \"today\"}}", 400, "year-month-day"),
        (
            "/api/calibrate",
            "{\"options\": {\"robot\": \"BT200L\", \"data\": \"a\", \"columns\": [\"a\"]}}",
            400,
            "NAME=HEADING",
        ),
    ] {
        let reply = served.post(path, "", body);
        assert_eq!(reply.status, status, "{body}: {}", reply.text());
        let refusal = reply.json();
        assert!(refusal["error"].as_str().unwrap().contains(words), "{body}: {refusal}");
        assert!(!refusal["hint"].as_str().unwrap().is_empty());
    }
    // An address that names no robot leads nowhere.
    for (robot, words) in [("nobody", "is not known"), ("BT200", "is not known")] {
        let reply = served.get(&format!("/api/robots/{robot}"));
        assert_eq!(reply.status, 404, "{}", reply.text());
        assert!(reply.json()["error"].as_str().unwrap().contains(words), "{}", reply.text());
    }
    let nested = format!("{{\"options\": {}", "[".repeat(100_000));
    assert_eq!(served.post("/api/place", "", &nested).status, 400);
    assert_eq!(served.ask("/api/study", &json!({ "options": { "sizes": vec![0.1; 5000] } })).status, 400);
    for bytes in [
        &b"\0\xff\x16\x03\x01\r\n\r\n"[..],
        b"GET\r\n\r\n",
        b"GET / HTTP/9.9\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost: localhost\r\nX: \x01\r\n\r\n",
    ] {
        assert_eq!(served.raw(bytes).status, 400, "{bytes:?}");
    }
    let many = format!("GET / HTTP/1.1\r\nHost: localhost\r\n{}\r\n", "X: y\r\n".repeat(500));
    assert_eq!(served.raw(many.as_bytes()).status, 431);
    assert_eq!(
        served.raw(b"DELETE /api/robots HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n").header("allow"),
        Some("get")
    );
    assert_eq!(served.get("/api/place").header("allow"), Some("post"));
    let check = served.ask("/api/robots/check", &json!({ "name": "a.toml", "text": TWO_LINKS })).json();
    assert!(check["robot"]["robot"] == "two links" && check["faults"] == json!([]), "{check}");
    assert_eq!(served.get("/api/robots/BT200L").status, 200, "it is still there");
}

#[test]
fn a_question_that_is_too_large_or_does_not_come_is_given_up() {
    let served = Served::start(&[]);
    let large = format!("{{\"files\": {{\"a\": \"{}\"}}}}", "x".repeat(5 << 20));
    let refused = served.post("/api/place", "", &large);
    assert_eq!((refused.status, refused.json()["error"].as_str()), (413, Some("the question has more than 4 MiB")));
    let mut half = served.connect();
    half.write_all(
        b"POST /api/place HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 99\r\n\r\n{",
    )
    .unwrap();
    let mut silent = served.connect();
    silent.write_all(b"GET / HTTP/1.1\r\nHo").unwrap();
    assert_eq!(served.get("/").status, 200, "nobody else waits for them");
    assert_eq!(heard(half).status, 408);
    // It hangs up, with or without a word.
    let mut rest = String::new();
    let _ = BufReader::new(silent).read_line(&mut rest);
    assert!(rest.is_empty() || rest.contains("408"), "{rest}");
}
