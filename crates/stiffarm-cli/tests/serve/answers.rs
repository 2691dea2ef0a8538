//! Does the server answer what the command line writes?

use std::fs;
use std::thread;

use assert_cmd::Command;
use serde_json::{Value, json};
use tempfile::TempDir;

use super::TWO_LINKS;
use super::served::Served;

/// What the command line writes.
fn typed(folder: &TempDir, arguments: &[&str]) -> Vec<u8> {
    let output = Command::cargo_bin("stiffarm")
        .expect("built")
        .current_dir(folder.path())
        .args(arguments)
        .output()
        .expect("runs");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

const ENDMILL: &str = include_str!("../../../../docs/examples/endmill.toml");
const PATH: &str = "G21 G90\nG1 F600 X0 Y0 Z0\nG1 X100\nG1 Y50\nG1 X0\nM30\n";

#[test]
fn every_verb_answers_what_the_command_line_writes_to_the_last_byte() {
    let (served, folder) = (Served::start(&[]), TempDir::new().unwrap());
    let sheet =
        typed(&folder, &["measure", "KR 210 R2700 extra", "--runs", "8", "--candidates", "200", "--format", "csv"]);
    let measured = include_str!("../../../../docs/examples/fanuc_r2000ic.csv");
    for (name, text) in [("mine.toml", TWO_LINKS), ("process.toml", ENDMILL), ("part.nc", PATH), ("data.csv", measured)]
    {
        fs::write(folder.path().join(name), text).unwrap();
    }
    fs::write(folder.path().join("a.toml"), "verb = \"place\"\nrobot = \"mine.toml\"\n").unwrap();
    fs::write(folder.path().join("own.csv"), &sheet).unwrap();
    let cases: Vec<(&str, &[&str], Value)> = vec![
        (
            "rank",
            &["--task", "A:0.5,rect:0.4x0.2", "--tolerance-mm", "2"],
            json!({ "task": ["A:0.5", "rect:0.4x0.2"], "tolerance-mm": 2 }),
        ),
        ("place", &["mine.toml", "--task", "circle:0.3"], json!({ "robot": "mine.toml", "task": "circle:0.3" })),
        (
            "place",
            &["BT200L", "--task", "circle:0.2", "--at", "1.6,0.8"],
            json!({ "robot": "BT200L", "task": "circle:0.2", "at": [1.6, 0.8] }),
        ),
        (
            "map",
            &["BT200L", "--size", "30", "--zone", "B:0.5"],
            json!({ "robot": "BT200L", "size": 30, "zone": "B:0.5" }),
        ),
        (
            "compliance",
            &["BT200L", "--joints-deg", "0,1,2,0,45,0", "--force-n", "0,1000,0"],
            json!({ "robot": "BT200L", "joints-deg": [0, 1, 2, 0, 45, 0], "force-n": [0, 1000, 0] }),
        ),
        ("study", &["--tasks", "A", "--sizes", "0.1,0.5"], json!({ "tasks": "A", "sizes": [0.1, 0.5] })),
        (
            "compare",
            &["a.toml", "BT200L", "--task", "circle:0.3"],
            json!({ "a": "a.toml", "b": "BT200L", "task": "circle:0.3" }),
        ),
        ("force", &["process.toml"], json!({ "process": "process.toml" })),
        ("mill", &["part.nc", "--dry"], json!({ "path": "part.nc", "dry": true })),
        (
            "mill",
            &["part.nc", "--robot", "BT200L", "--process", "process.toml", "--at", "1.6,0,0.8", "--step-mm", "20"],
            json!({ "path": "part.nc", "robot": "BT200L", "process": "process.toml", "at": [1.6, 0, 0.8], "step-mm": 20 }),
        ),
        (
            "measure",
            &["KR 210 R2700 extra", "--runs", "8", "--candidates", "200", "--compare", "own.csv"],
            json!({ "robot": "KR 210 R2700 extra", "runs": 8, "candidates": 200, "compare": "own.csv" }),
        ),
        (
            "identify",
            &["data.csv", "--robot", "R-2000iC/165F"],
            json!({ "data": "data.csv", "robot": "R-2000iC/165F" }),
        ),
    ];
    let texts: Value = ["mine.toml", "process.toml", "part.nc", "a.toml", "own.csv", "data.csv"]
        .into_iter()
        .map(|name| (name.to_owned(), Value::from(fs::read_to_string(folder.path().join(name)).unwrap())))
        .collect();
    for (verb, arguments, options) in cases {
        for format in ["json", "csv"] {
            let expected = typed(&folder, &[&[verb], arguments, &["--format", format]].concat());
            let reply = served.ask(&format!("/api/{verb}?as={format}"), &json!({ "options": options, "files": texts }));
            assert_eq!(reply.status, 200, "{verb}: {}", reply.text());
            assert!(expected == reply.body, "{verb} as {format}: {}", reply.text());
        }
    }
    assert_eq!(
        served.get("/api/robots?text=kuka&payload-kg=300..").body,
        typed(&folder, &["robots", "list", "kuka", "--payload-kg", "300..", "--format", "json"])
    );
    assert_eq!(
        served.get("/api/robots/IRB%206640-235%2F2.55").body,
        typed(&folder, &["robots", "show", "IRB 6640-235/2.55", "--format", "json"])
    );
}

#[test]
fn files_pictures_and_programs_come_as_the_command_line_writes_them() {
    let (served, folder) = (Served::start(&[]), TempDir::new().unwrap());
    let place = json!({ "options": { "robot": "BT200L", "task": "circle:0.3" } });
    for (form, file, kind) in [
        ("svg", "place.svg", "image/svg+xml"),
        ("png", "place.png", "image/png"),
        ("pdf", "place.pdf", "application/pdf"),
        ("view", "place.view.html", "text/html; charset=utf-8"),
        ("report", "place.html", "text/html; charset=utf-8"),
        ("report-pdf", "place.report.pdf", "application/pdf"),
        ("txt", "place.txt", "text/plain; charset=utf-8"),
        ("md", "place.md", "text/markdown; charset=utf-8"),
    ] {
        typed(&folder, &["place", "BT200L", "--task", "circle:0.3", "-o", file, "--quiet"]);
        let reply = served.ask(&format!("/api/place?as={form}"), &place);
        assert_eq!((reply.status, reply.header("content-type")), (200, Some(kind)), "{form}: {}", reply.head);
        assert!(reply.body == fs::read(folder.path().join(file)).unwrap(), "{form}");
        assert_eq!(reply.header("content-disposition"), Some(format!("attachment; filename=\"{file}\"").as_str()));
    }
    let commands = served.ask("/api/place?as=command", &place).json();
    assert_eq!(commands["command"], "stiffarm place BT200L --task circle:0.3");
    assert_eq!(commands["python"], "stiffarm.place(\"BT200L\", task=\"circle:0.3\")");
    assert_eq!(served.ask("/api/place?as=job", &place).text(), commands["job"]);
    fs::write(folder.path().join("job.toml"), commands["job"].as_str().unwrap()).unwrap();
    assert_eq!(typed(&folder, &["place", "job.toml", "--format", "json"]), served.ask("/api/place", &place).body);
    let map = served.ask("/api/map?as=svg", &json!({ "options": { "robot": "BT200L", "size": 40 } })).text();
    assert!(["data-x0-px", "data-z0-m", "data-px-per-m"].iter().all(|key| map.lines().next().unwrap().contains(key)));
    for form in ["xyz", "../x", "", "toml"] {
        let refused = served.ask(&format!("/api/place?as={form}"), &place);
        assert_eq!(refused.status, 400, "{form}: {}", refused.text());
    }
}

/// Every form is what it is alone, figures that are not there are said, and what people read has the words of the table.
#[test]
fn several_forms_come_of_one_answer() {
    let served = Served::start(&[]);
    let place = json!({ "options": { "robot": "BT200L", "task": "circle:0.3", "tolerance-mm": 2 } });
    let several = served.ask("/api/place?as=json,tables,svg,shop,md", &place);
    assert_eq!((several.status, several.header("content-type")), (200, Some("application/json")), "{}", several.text());
    let together = several.json();
    let alone = |form: &str| served.ask(&format!("/api/place?as={form}"), &place);
    assert_eq!(together["json"], alone("json").json());
    assert_eq!(together["tables"], alone("tables").json());
    for form in ["svg", "shop", "md"] {
        assert_eq!(together[form], alone(form).text(), "{form}");
    }
    assert_eq!(together["refused"], json!({}));

    let sheet = &together["tables"]["tables"][0];
    let (rows, lead) = (sheet["rows"].as_array().unwrap(), &sheet["lead"]);
    let says = |name: &str| rows.iter().find(|row| row[0] == name).map(|row| row[1].clone()).unwrap();
    assert_eq!(lead["value"], says("worst deflection in the zone"));
    assert_eq!(lead["rests_on"], says("stiffness"));
    let repeated = lead["rows"].as_array().unwrap().iter().map(|row| rows[row.as_u64().unwrap() as usize][0].as_str());
    let repeated: Vec<&str> = repeated.map(Option::unwrap).collect();
    assert_eq!(
        repeated,
        [
            "robot",
            "stiffness",
            "worst deflection in the zone",
            "centre from the base",
            "smallest margin",
            "worst point"
        ]
    );
    // The row of the clearance says more than a distance.
    assert!(says("clearance").as_str().is_some_and(|clearance| clearance.contains("are not known to this model")));
    let markdown = together["md"].as_str().unwrap();
    assert!(rows.iter().all(|row| markdown.contains(row[1].as_str().unwrap())), "{markdown}");

    let nowhere = json!({ "options": { "robot": "BT200L", "task": "circle:3" } });
    let none = served.ask("/api/place?as=json,tables,svg", &nowhere).json();
    assert_eq!((&none["json"]["feasible"], &none["svg"]), (&json!(false), &Value::Null));
    assert_eq!(none["refused"]["svg"], served.ask("/api/place?as=svg", &nowhere).json());
    assert_eq!(none["tables"]["tables"][0]["lead"]["means"], "why there is no place");

    for (wrong, why) in [
        ("json,png", "png is asked alone"),
        ("json,command", "command is asked alone"),
        ("svg,json,svg", "has svg twice"),
        ("json,", "as= is no form"),
    ] {
        let refused = served.ask(&format!("/api/place?as={wrong}"), &place);
        assert!(refused.status == 400 && refused.text().contains(why), "{wrong}: {}", refused.text());
    }
    // What a verb never makes is refused as what it cannot make this time; alone before anything is computed.
    let map = json!({ "options": { "robot": "BT200L", "size": 10 } });
    let several = served.ask("/api/map?as=tables,shop,toml,report", &map).json();
    for (form, why) in [
        ("shop", "map makes no shop drawing"),
        ("toml", "map has no form toml; expected one of svg, png,"),
        ("report", "map makes no report"),
    ] {
        let alone = served.ask(&format!("/api/map?as={form}"), &map);
        assert_eq!((alone.status, &several[form]), (400, &Value::Null));
        assert_eq!(several["refused"][form], alone.json());
        assert!(alone.text().contains(why), "{}", alone.text());
    }
}

/// Every view of the page shows a number that decides.
#[test]
fn a_table_that_decides_says_which_line_does() {
    let served = Served::start(&[]);
    let measured = include_str!("../../../../docs/examples/fanuc_r2000ic.csv");
    let measure = json!({ "robot": "KR 210 R2700 extra", "runs": 8, "candidates": 200 });
    let geometry = json!({ "robot": "KR 210 R2700 extra", "geometry": true, "runs": 10, "candidates": 100 });
    let mill = json!({ "path": "line:0.2", "robot": "BT200L", "force-n": 300, "at": [1.6, 0, 0.8], "step-mm": 20 });
    let far = json!({ "path": "line:0.2", "robot": "BT200L", "force-n": 300, "at": [9, 0, 0.8], "step-mm": 20 });
    for (verb, options, name, means) in [
        ("mill", mill, "largest error", "largest error of the tool along the path"),
        ("mill", far, "not followed", "why the path is not followed"),
        ("measure", measure, "precision of the prediction", "precision that 8 measurements give"),
        ("measure", geometry, "error at the work, calibrated", "error at the work that 10 measured postures leave"),
        (
            "identify",
            json!({ "data": "data.csv", "robot": "R-2000iC/165F" }),
            "not explained",
            "not explained by the drives as found",
        ),
    ] {
        let question = json!({ "options": options, "files": { "data.csv": measured } });
        let reply = served.ask(&format!("/api/{verb}?as=tables"), &question);
        assert_eq!(reply.status, 200, "{verb}: {}", reply.text());
        let sheet = &reply.json()["tables"][0];
        let row = sheet["rows"].as_array().unwrap().iter().find(|row| row[0] == name);
        assert_eq!(row.map(|row| &row[1]), Some(&sheet["lead"]["value"]), "{sheet:#}");
        assert_eq!(sheet["lead"]["means"], means);
        assert_ne!(sheet["lead"]["rests_on"], "", "{verb}");
    }
}

/// The first tool errs less than the second: no table of one tool decides of the path.
#[test]
fn of_several_tools_the_one_that_errs_most_decides() {
    let served = Served::start(&[]);
    let process = |newtons: u32| format!("[constant]\nfeed_n = {newtons}\nacross_n = -20\naxial_n = 50\n");
    let cuts = "G0 X0 Y0 Z5\nG1 Z0 F500\nG1 X100\nG0 Z5\n";
    let path = format!("G21 G90 G94\nT1 M6\n{cuts}T2 M6\n{cuts}M2\n");
    let ask = |at: [f64; 3]| {
        let question = json!({
            "options": {
                "path": "two.nc", "robot": "KR 210 R2700 extra", "at": at, "step-mm": 50, "tool-mm": "200,0,150,0,60,0",
                "process": ["T1=one.toml", "T2=two.toml"], "tool-lengths-mm": ["T1=30", "T2=95"],
            },
            "files": { "two.nc": path, "one.toml": process(40), "two.toml": process(300) },
        });
        let reply = served.ask("/api/mill?as=json,tables", &question);
        assert_eq!(reply.status, 200, "{}", reply.text());
        reply.json()
    };
    let leads = |answer: &Value| -> Vec<Value> {
        let tables = answer["tables"]["tables"].as_array().unwrap();
        tables.iter().map(|table| table["lead"].clone()).filter(|lead| !lead.is_null()).collect()
    };
    let answer = ask([1.6, 0.0, 0.8]);
    let [lead] = leads(&answer).try_into().unwrap();
    let of_tool = |i: usize| answer["json"]["by_tool"][i]["worst_mm"].as_f64().unwrap();
    assert!(of_tool(0) < of_tool(1), "{of_tool:?}", of_tool = [of_tool(0), of_tool(1)]);
    assert_eq!(lead["value"], format!("{:.4} mm, by T2", of_tool(1)));
    let far = ask([9.0, 0.0, 0.8]);
    let [lead] = leads(&far).try_into().unwrap();
    assert_eq!((&lead["means"], &lead["value"]), (&json!("not followed"), &far["json"]["reason"]));
}

#[test]
fn what_the_program_says_beside_an_answer_comes_along() {
    let served = Served::start(&[]);
    let question = json!({ "options": { "robot": "BT200L", "joints-deg": [0, 1, 2, 0, 1, 0] } });
    let notes: Vec<String> =
        serde_json::from_str(served.ask("/api/compliance", &question).header("stiffarm-notes").unwrap()).unwrap();
    assert!(notes[0].contains("beyond 6.3 deg"), "{notes:?}");
    let lines = served.post("/api/compliance", "Accept: application/x-ndjson\r\n", &question.to_string()).text();
    assert!(lines.lines().last().unwrap().contains("beyond 6.3 deg"), "{lines}");
}

#[test]
fn a_view_has_a_page_and_a_policy_of_its_own() {
    let served = Served::start(&[]);
    let form = "question=%7B%22options%22%3A%7B%22robot%22%3A%22BT200L%22%2C%22task%22%3A%22circle%3A0.3%22%7D%7D";
    let page = served.post("/view/place", "Content-Type: application/x-www-form-urlencoded\r\n", form);
    assert_eq!((page.status, page.header("content-type")), (200, Some("text/html; charset=utf-8")), "{}", page.text());
    let policy = page.header("content-security-policy").unwrap();
    assert!(policy.contains("sandbox allow-scripts") && policy.contains("connect-src 'none'"), "{policy}");
    let unlike = served.post("/view/place", "Content-Type: application/x-www-form-urlencoded\r\n", "q=1");
    assert_eq!(unlike.status, 400, "{}", unlike.text());
    let read = served.get(&format!("/view/place?{form}"));
    assert_eq!((read.status, read.header("allow")), (405, Some("post")), "a picture of any page could ask for it");
    assert_eq!(
        served
            .post(
                "/view/place",
                "Content-Type: application/x-www-form-urlencoded\r\nOrigin: http://evil.example\r\n",
                form
            )
            .status,
        403
    );
}

#[test]
fn many_at_once_are_all_answered_and_with_the_same_bytes() {
    let served = Served::start(&["--threads", "2"]);
    let question = json!({ "options": { "robot": "BT200L", "task": "rect:0.6x0.4" } });
    let expected = served.ask("/api/place", &question).body;
    thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                for _ in 0..10 {
                    let reply = served.ask("/api/place", &question);
                    assert_eq!(reply.status, 200, "{}", reply.text());
                    assert!(reply.body == expected);
                }
            });
        }
    });
}
