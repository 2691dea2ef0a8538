//! Does `mill --chatter` tell of a path what `chatter` tells of its postures, name what it does not cover, and refuse what it cannot tell?

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

const PROCESS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/endmill.toml");
const ROBOT: [&str; 2] = ["--robot", "KR 210 R2700-2"];
const HELD: [&str; 4] = ["--tool-mass-kg", "60", "--tool-com-mm", "0,0,200"];
const TOOL: [&str; 2] = ["--tool-mm", "0,0,200"];

/// Down, along, along with a plunge in between, and away.
const PART: &str = "G21 G90 F1200\nG0 X0 Y0 Z50\nG0 Z20\nG1 Z0\nG1 X60\nG1 Y40\nG1 Z-3\nG1 X0\nG0 Z50\nM2\n";
const DRILL: &str = "spindle_rpm = 1000\n[drilling]\nthrust_n = 500\ntorque_nm = 2\n";

fn folder() -> TempDir {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("part.nc"), PART).expect("written");
    fs::write(folder.path().join("drill.toml"), DRILL).expect("written");
    fs::copy(PROCESS, folder.path().join("endmill.toml")).expect("copied");
    folder
}

fn run(folder: &Path, arguments: &[&[&str]]) -> (Option<i32>, String, String) {
    let mut command = Command::cargo_bin("stiffarm").expect("built");
    let output = command.current_dir(folder).args(arguments.concat()).output().expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn printed(folder: &Path, arguments: &[&[&str]]) -> String {
    let (code, out, err) = run(folder, arguments);
    assert_eq!(code, Some(0), "{err}");
    out
}

fn json(folder: &Path, arguments: &[&[&str]]) -> Value {
    serde_json::from_str(&printed(folder, &[arguments, &[&["--format", "json"]]].concat())).expect("JSON")
}

const MILL: [&str; 6] = ["mill", "part.nc", "--process", "endmill.toml", "--at", "1.7,0.2,0.8,30"];

/// The rows of a table, each by its headings.
fn rows(text: &str) -> Vec<Vec<(String, String)>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headings = reader.headers().expect("headings").clone();
    let named = |row: csv::StringRecord| headings.iter().zip(&row).map(|(a, b)| (a.into(), b.into())).collect();
    reader.records().map(|row| named(row.expect("a row"))).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    &row.iter().find(|(heading, _)| heading == name).unwrap_or_else(|| panic!("{name}")).1
}

/// Another route to each number: the joints of the row, and a feed that is turned by the yaw by hand.
#[test]
fn every_sample_has_the_depth_that_chatter_has_of_its_posture() {
    let folder = folder();
    let csv = printed(folder.path(), &[&MILL, &ROBOT, &TOOL, &HELD, &["--chatter", "--format", "csv"]]);
    let (s, c) = 30_f64.to_radians().sin_cos();
    let mut compared = 0;
    let mut before = None;
    for row in rows(&csv) {
        let line = cell(&row, "line").to_owned();
        // By line of the file: where it feeds.
        let feed = match line.as_str() {
            "5" => [c, s],
            "6" => [-s, c],
            "8" => [-c, -s],
            _ => continue,
        };
        if before.replace(line.clone()) == Some(line) {
            continue;
        }
        let joints: Vec<&str> =
            ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"].map(|name| cell(&row, name)).into();
        let feed = format!("{},{},0", feed[0], feed[1]);
        let at_posture =
            ["chatter", "endmill.toml", "--joints-deg", &joints.join(","), "--feed", &feed, "--method", "mean"];
        let alone = json(folder.path(), &[&at_posture, &ROBOT, &TOOL, &HELD]);
        for key in ["critical_depth_mm", "chatter_hz"] {
            let (here, there) = (cell(&row, key).parse::<f64>().expect("a number"), alone[key].as_f64().expect(key));
            assert!((here / there - 1.0).abs() < 1e-6, "{key}: {here} along the path, {there} alone");
        }
        assert_eq!(cell(&row, "chatter_covered"), "true");
        compared += 1;
    }
    assert_eq!(compared, 3);
}

#[test]
fn the_answer_names_the_worst_line_what_is_not_covered_and_what_is_not_known() {
    let folder = folder();
    let arguments: [&[&str]; 5] = [&MILL, &ROBOT, &TOOL, &HELD, &["--chatter"]];
    let answer = json(folder.path(), &arguments);
    let found = &answer["chatter"];
    let verdict = found["chatter_verdict"].as_str().expect("words");
    let line = found["at_line"].as_u64().expect("a line");
    assert!(verdict.contains(&format!("line {line}")) && verdict.ends_with("spindle modes unknown"), "{verdict}");
    assert!(verdict.contains("samples are not covered") && !verdict.contains("stable"), "{verdict}");
    let plunges = &found["not_covered"][0];
    assert_eq!((&plunges["why"], &plunges["lines"]), (&"plunge".into(), &serde_json::json!([4, 7])));
    for key in ["critical_depth_mm", "chatter_hz", "tooth_phase_rad", "any_speed_depth_mm", "other_way_depth_mm"] {
        assert!(found[key].is_number(), "{key}: {}", found[key]);
    }
    assert_eq!(found["modes_looked_at"].as_array().map(Vec::len), Some(6));
    // The worst is the least of the column, as every sample cuts as deep.
    let rows = rows(&printed(folder.path(), &[&arguments[..], &[&["--format", "csv"]]].concat()));
    let depths = rows.iter().filter_map(|row| cell(row, "critical_depth_mm").parse::<f64>().ok());
    let least = depths.fold(f64::INFINITY, f64::min);
    assert_eq!(found["critical_depth_mm"].as_f64(), Some(least));
    let uncovered = rows.iter().filter(|row| cell(row, "chatter_covered") == "false");
    assert_eq!(uncovered.count() as u64, plunges["samples"].as_u64().expect("a count"));
    let table = printed(folder.path(), &arguments);
    for words in ["chatter not covered", "line 4, 7", "calm speeds", "fed the other way", "spindle, tool holder"] {
        assert!(table.contains(words), "{words}\n{table}");
    }
    // In parts of the cut; a cut far deeper than the interval allows is refused by --check alone.
    let (reserve, depth) = (found["depth_reserve"].as_f64(), found["cut_depth_mm"].as_f64().expect("a depth"));
    assert!((reserve.expect("a number") * depth / least - 1.0).abs() < 1e-12);
    let deep = fs::read_to_string(PROCESS).expect("the example").replace("ap_mm = 3", "ap_mm = 150");
    let deep = deep.replace("spindle_rpm = 12000", "spindle_rpm = 3000");
    fs::write(folder.path().join("deep.toml"), deep).expect("written");
    let deep = ["mill", "part.nc", "--process", "deep.toml", "--at", MILL[5], "--chatter", "--check"];
    let (code, _, err) = run(folder.path(), &[&deep, &ROBOT, &TOOL, &HELD]);
    assert!(code == Some(3) && err.contains("a cut of 150.000 mm, line") && err.contains("swings from"), "{err}");
    // What swings passes nothing, whatever is allowed.
    let allowed = [&deep[..6], &["--chatter", "--tolerance-mm", "500"]].concat();
    let judged = json(folder.path(), &[&allowed, &ROBOT, &TOOL, &HELD]);
    assert_eq!((&judged["pass"], &judged["verdict"]), (&true.into(), &"chatter".into()));
    // Without the option nothing is reported of it.
    let without = json(folder.path(), &[&MILL, &ROBOT, &TOOL]);
    assert!(without["chatter"].is_null());
}

#[test]
fn in_a_stock_air_is_not_covered_and_the_depth_is_that_of_the_stock() {
    let folder = folder();
    let stock = ["--stock-mm", "20..200,-40..200,-10..2", "--chatter"];
    let found = &json(folder.path(), &[&MILL, &ROBOT, &TOOL, &HELD, &stock])["chatter"];
    let whys: Vec<&str> =
        found["not_covered"].as_array().expect("a list").iter().filter_map(|one| one["why"].as_str()).collect();
    assert_eq!(whys, ["plunge", "air"], "{found}");
    // 2 mm of the block at line 5 and 6, 5 mm at line 8; not the 3 mm of the process.
    let depth = found["cut_depth_mm"].as_f64().expect("a depth");
    assert!((depth - 2.0).abs() < 1e-6 || (depth - 5.0).abs() < 0.5, "{depth}");
}

#[test]
fn lobes_and_a_report_show_the_worst_sample() {
    let folder = folder();
    let files = ["--chatter", "-o", "part.lobes.svg", "-o", "report.html", "-o", "part.json"];
    printed(folder.path(), &[&MILL, &ROBOT, &TOOL, &HELD, &files]);
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect("written");
    let (lobes, report) = (read("part.lobes.svg"), read("report.html"));
    for words in ["speed of the spindle [rpm]", "axial depth [mm]", "the cut", "spindle modes unknown"] {
        assert!(lobes.contains(words), "{words}");
    }
    for words in ["Whether the cuts swing with the arm", "Chatter: ", "axial depth [mm]", "spindle modes unknown"] {
        assert!(report.contains(words), "{words}");
    }
}

/// A robot that is not there shows that nothing of it was looked for.
#[test]
fn what_cannot_be_made_of_a_path_is_refused_before_it_is_followed() {
    let folder = folder();
    let refused = |asked: &[&str]| {
        let (code, out, err) = run(folder.path(), &[&MILL, &["--robot", "nobody"], asked]);
        assert!(code != Some(0) && out.is_empty(), "{out}{err}");
        err
    };
    for (asked, why) in [
        (&["-o", "part.lobes.svg"][..], "lobes are computed with --chatter"),
        (&["-o", "again.nc"], "written back with --compensate"),
        (&["-o", "again.apt", "--compensate"], "is not written as .apt"),
        (&["-o", "again.nc", "--compensate", "--only-tool", "1"], "is written back where each has its process"),
        (&["-o", "again.nc", "--compensate"], "nobody"),
    ] {
        let said = refused(asked);
        assert!(said.contains(why), "{asked:?}: {said}");
    }
}

const TAPPED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/tip_modes.csv");

#[test]
fn what_was_measured_of_the_spindle_is_looked_at_along_the_path_and_what_was_on_the_robot_is_not() {
    let folder = folder();
    let frf = ["--chatter", "--frf", TAPPED, "--frf-on", "rigid"];
    let answer = json(folder.path(), &[&MILL, &ROBOT, &TOOL, &HELD, &frf]);
    let found = &answer["chatter"];
    let verdict = found["chatter_verdict"].as_str().expect("words");
    assert!(
        verdict.contains("robot and measured modes") && verdict.ends_with("modes of the work unknown"),
        "{verdict}"
    );
    assert_eq!(found["measured_modes"].as_array().map(Vec::len), Some(3));
    // As `chatter` has it of the same posture and feed.
    let numbers = |key: &str| {
        let all = found[key].as_array().expect("a list").iter();
        all.map(ToString::to_string).collect::<Vec<_>>().join(",")
    };
    let (joints, feed) = (numbers("joints_deg"), numbers("feed"));
    let posture = ["chatter", "endmill.toml", "--joints-deg", &joints, "--feed", &feed];
    let alone = json(folder.path(), &[&posture, &ROBOT, &TOOL, &HELD, &frf[1..]]);
    let [here, there] = [found, &alone].map(|chatter| chatter["critical_depth_mm"].as_f64().expect("a depth"));
    assert!((here / there - 1.0).abs() < 1e-6, "{here} {there}");
    let refused = |more: &[&str], words: &str| {
        let (code, out, err) = run(folder.path(), &[&MILL, &ROBOT, &TOOL, more]);
        assert!(code != Some(0) && out.is_empty() && err.contains(words), "{words}: {err}");
    };
    refused(&["--chatter", "--frf", TAPPED, "--frf-on", "robot"], "--frf-on");
    refused(&["--frf", TAPPED, "--frf-on", "rigid"], "--frf-on needs --chatter");
}

#[test]
fn what_cannot_be_answered_is_refused_with_what_to_do() {
    let folder = folder();
    let refused = |arguments: &[&[&str]], words: &str| {
        let (code, out, err) = run(folder.path(), arguments);
        assert!(code != Some(0) && out.is_empty(), "{out}");
        assert!(err.contains(words) && !err.contains("panicked"), "{words}: {err}");
    };
    let chatter: &[&str] = &["--chatter"];
    refused(&[&MILL, &["--robot", "KR 210 R2700 extra"], chatter], "no masses in the robot file");
    let ranked: &[&str] = &["mill", "part.nc", "--process", "endmill.toml", "--robots", "KR 210*"];
    refused(&[ranked, chatter], "--robots and --chatter exclude each other");
    let chosen: &[&str] = &["mill", "part.nc", "--process", "endmill.toml", "--vendor", "kuka"];
    refused(&[chosen, chatter], "--vendor and --chatter exclude each other");
    refused(&[&MILL, &ROBOT, &["--tool-com-mm", "0,0,200"]], "--tool-com-mm needs --tool-mass-kg");
    let inertia = ["--tool-inertia-kg-m2", "1,0,0,1,0,1"];
    refused(&[&MILL, &ROBOT, &HELD, &inertia], "--tool-inertia-kg-m2 needs --chatter");
    refused(&[&MILL, &ROBOT, &inertia, chatter], "is missing; expected mass of the tool");
    refused(&[&MILL, &ROBOT, &["--damping-ratio", "0.05"]], "--damping-ratio needs --chatter");
    refused(&[&MILL, &ROBOT, &["--tool-mass-kg", "60"], chatter], "tool-com-mm");
    let at = ["--at", "1.7,0.2,0.8,30"];
    refused(&[&["mill", "part.nc", "--force-n", "9"], &at, &ROBOT, chatter], "--chatter needs --process");
    let drill = ["mill", "part.nc", "--process", "drill.toml"];
    refused(&[&drill, &at, &ROBOT, chatter], "drill.toml: chatter of drilling is not covered");
    fs::write(folder.path().join("tools.nc"), "G21 G90 F900\nT1 M6\nG1 X0 Y0 Z0\nG1 X50\nT2 M6\nG1 X0\nM2\n")
        .expect("written");
    let tools = ["mill", "tools.nc", "--process", "T1=endmill.toml,T2=drill.toml", "--tool-lengths-mm", "T1=80,T2=90"];
    refused(&[&tools, &at, &ROBOT, chatter], "T2, drill.toml: chatter of drilling is not covered");
}
