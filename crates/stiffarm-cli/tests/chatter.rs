//! Does the program tell from which depth a cut swings, and refuse what it cannot tell?

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::tempdir;

const PROCESS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/endmill.toml");
const ARM: &[&str] = &["--robot", "KR 210 R2700-2", "--joints-deg", "0,-90,90,0,90,0"];
const FEED: &[&str] = &["--feed", "1,0,0"];
const HELD: &[&str] = &["--tool-mass-kg", "60", "--tool-com-mm", "0,0,200"];

fn output(arguments: &[&[&str]]) -> (bool, String, String) {
    let output = Command::cargo_bin("stiffarm").expect("built").args(arguments.concat()).output().expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (output.status.success(), text(output.stdout), text(output.stderr))
}

fn json(arguments: &[&[&str]]) -> Value {
    let (ok, out, err) = output(&[arguments, &[&["--format", "json"]]].concat());
    assert!(ok, "{err}");
    serde_json::from_str(&out).expect("JSON")
}

#[test]
fn depths_have_their_intervals_and_the_verdict_is_what_these_say() {
    let answer = json(&[&["chatter", PROCESS], ARM, FEED, HELD]);
    let number = |key: &str| answer[key].as_f64().unwrap_or_else(|| panic!("{key}: {}", answer[key]));
    assert!(number("any_speed_depth_mm") <= number("critical_depth_mm"), "{answer}");
    assert!(number("any_speed_depth_mm_p05") < number("any_speed_depth_mm_p95"));
    let phase = std::f64::consts::TAU * number("chatter_hz") * 60.0 / (4.0 * number("spindle_rpm"));
    assert!((number("tooth_phase_rad") / phase - 1.0).abs() < 1e-9);
    assert_eq!((number("cut_depth_mm"), number("spindle_rpm").round()), (3.0, 12_000.0));
    let cut = number("cut_depth_mm");
    let expected = match (answer["critical_depth_mm_p05"].as_f64(), answer["critical_depth_mm_p95"].as_f64()) {
        (None, _) => "calm",
        (Some(low), _) if cut < low => "calm",
        (_, Some(high)) if high < cut => "limit",
        _ => "not decided",
    };
    assert_eq!(answer["robot_modes"], expected);
    let verdict = answer["verdict"].as_str().expect("words");
    assert!(verdict.ends_with("; spindle modes unknown") && !verdict.contains("stable"), "{verdict}");
    assert_eq!(answer["modes_looked_at"].as_array().map(Vec::len), Some(6));
    assert_eq!(answer["drawn"], serde_json::json!(["drives", "damping"]));
    // The chart has the speed of the cut.
    let lobes = answer["lobes"].as_array().expect("a list");
    let at = lobes.iter().find(|lobe| (lobe["spindle_rpm"].as_f64().unwrap_or(0.0) - 12e3).abs() < 1e-6);
    assert_eq!(at.map(|lobe| &lobe["depth_mm"]), Some(&answer["critical_depth_mm"]));
}

#[test]
fn the_table_says_what_is_not_promised_and_a_row_is_a_speed() {
    let (ok, out, err) = output(&[&["chatter", PROCESS], ARM, FEED]);
    assert!(ok, "{err}");
    for words in ["spindle modes unknown", "without the delay (Pan)", "tool: weighs nothing", "are rigid here: above"] {
        assert!(out.contains(words), "{words}\n{out}");
    }
    let (ok, out, err) = output(&[&["chatter", PROCESS], ARM, FEED, &["--method", "mean", "--format", "csv"]]);
    assert!(ok, "{err}");
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines[0], "spindle_rpm,depth_mm,depth_mm_p05,depth_mm_p95,chatter_hz");
    assert_eq!(lines.len(), 192);
}

#[test]
fn a_figure_has_units_the_band_and_the_cut() {
    let folder = tempdir().expect("a folder");
    let file = folder.path().join("lobes.svg");
    let (ok, _, err) = output(&[&["chatter", PROCESS], ARM, FEED, &["-o", file.to_str().expect("a path")]]);
    assert!(ok, "{err}");
    let svg = fs::read_to_string(file).expect("written");
    for words in ["speed of the spindle [rpm]", "axial depth [mm]", "90 % of draws", "the cut", "spindle modes unknown"]
    {
        assert!(svg.contains(words), "{words}");
    }
}

/// Tables of the examples: a response, and the modes that it is made of.
const TAPPED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/tip.csv");
const TAPPED_MODES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/tip_modes.csv");

#[test]
fn what_was_measured_at_the_tip_is_looked_at_and_named_by_its_table() {
    let of = |frf: &str, held: &str| {
        json(&[&["chatter", PROCESS], ARM, FEED, HELD, &["--damping-ratio", "0.04", "--frf", frf, "--frf-on", held]])
    };
    let (by_hertz, of_modes) = (of(TAPPED, "rigid"), of(TAPPED_MODES, "rigid"));
    for answer in [&by_hertz, &of_modes] {
        let verdict = answer["verdict"].as_str().expect("words");
        assert!(verdict.starts_with("robot and measured modes"), "{verdict}");
        assert!(verdict.ends_with("; modes of the work unknown") && !verdict.contains("stable"), "{verdict}");
        assert_eq!((&answer["spindle_modes"], &answer["frf_on"]), (&"measured".into(), &"rigid".into()));
        assert_eq!(answer["modes_looked_at"].as_array().map(Vec::len), Some(6));
    }
    // The drives have an interval, what was tapped has none.
    let (_, text, _) = output(&[&["chatter", PROCESS], ARM, FEED, HELD, &["--frf", TAPPED, "--frf-on", "rigid"]]);
    assert!(text.contains("what was measured at the tip is taken as it is"), "{text}");
    assert!(by_hertz["frf"].as_str().expect("a name").ends_with("tip.csv"));
    assert_eq!(
        (by_hertz["measured_between"].clone(), &by_hertz["measured_modes"]),
        (serde_json::json!([4.0, 2400.0]), &Value::Null)
    );
    assert_eq!(of_modes["measured_modes"], serde_json::json!([612.0, 655.0, 1480.0]));
    // The table is rounded, and given in steps of 4 Hz.
    for key in ["critical_depth_mm", "any_speed_depth_mm", "other_way_depth_mm"] {
        let [a, b] = [&by_hertz, &of_modes].map(|answer| answer[key].as_f64().unwrap_or_else(|| panic!("{key}")));
        assert!((a / b - 1.0).abs() < 0.01, "{key}: {a} {b}");
    }
    // Not decided by its interval, a cut says nothing of a table that goes on far beyond the teeth.
    let folder = tempdir().expect("a folder");
    let deep = folder.path().join("deep.toml");
    fs::write(&deep, fs::read_to_string(PROCESS).expect("the example").replace("ap_mm = 3", "ap_mm = 9"))
        .expect("written");
    let deep = deep.to_str().expect("a path");
    let (ok, out, err) = output(&[&["chatter", deep], ARM, FEED, HELD, &["--frf", TAPPED, "--frf-on", "rigid"]]);
    assert!(ok && out.contains("modes up to 2400 Hz: not decided") && !out.contains("decides nothing"), "{out}{err}");
    // Of a robot that nobody has weighed.
    let bare: &[&str] = &["--robot", "IRB 6650S-200", "--joints-deg", "0,0,0,0,90,0", "--feed", "0,1,0"];
    let alone = json(&[&["chatter", PROCESS], bare, &["--frf", TAPPED_MODES, "--frf-on", "robot"]]);
    assert!(alone["verdict"].as_str().expect("words").starts_with("measured modes"), "{alone}");
    assert_eq!((&alone["modes_looked_at"], &alone["drawn"]), (&serde_json::json!([]), &serde_json::json!([])));
    let (ok, out, err) = output(&[&["chatter", PROCESS], ARM, FEED, &["--frf", TAPPED, "--frf-on", "robot"]]);
    assert!(ok, "{err}");
    for words in [
        "the tip as the robot holds it",
        "the model of the robot does not count",
        "nothing is known below 4.0 and above 2400 Hz",
    ] {
        assert!(out.contains(words), "{words}\n{out}");
    }
}

#[test]
fn a_tip_without_the_word_that_says_what_held_it_is_refused_and_its_faults_are_named() {
    let refused = |arguments: &[&str], words: &str| {
        let (ok, out, err) = output(&[&["chatter", PROCESS], ARM, FEED, arguments]);
        assert!(!ok && out.is_empty() && err.contains(words) && !err.contains("panicked"), "{words}: {err}");
    };
    refused(&["--frf", TAPPED, "--frf-on", "robot", "--damping-ratio", "0.04"], "it is in the table");
    refused(
        &["--frf", TAPPED, "--frf-on", "robot", "--tool-mass-kg", "60", "--tool-com-mm", "0,0,200"],
        "it is in the table",
    );
    refused(&["--frf", TAPPED], "--frf needs --frf-on");
    refused(&["--frf-on", "rigid"], "--frf-on needs --frf");
    refused(&["--frf", TAPPED, "--frf-on", "table"], "--frf-on");
    refused(&["--frf", "nothing.csv", "--frf-on", "rigid"], "nothing.csv");
    refused(&["--frf", PROCESS, "--frf-on", "rigid"], "expected freq_hz and gxx_re");
    refused(
        &["--frf", TAPPED, "--frf-on", "rigid", "--method", "teeth"],
        "tip.csv: a tip that was measured frequency by frequency",
    );
}

#[test]
fn cuts_that_are_not_covered_and_robots_without_masses_are_refused_with_what_to_do() {
    let refused = |arguments: &[&[&str]], words: &str| {
        let (ok, _, err) = output(arguments);
        assert!(!ok && err.contains(words) && !err.contains("panicked"), "{err}");
    };
    let folder = tempdir().expect("a folder");
    let drill = folder.path().join("drill.toml");
    fs::write(&drill, "spindle_rpm = 1000\n[drilling]\nthrust_n = 500\ntorque_nm = 2\n").expect("written");
    let drill = drill.to_str().expect("a path");
    refused(&[&["chatter", drill], ARM, FEED], "drill.toml: chatter of drilling is not covered");
    refused(&[&["chatter", PROCESS], ARM, &["--feed", "0,0,-1"]], "chatter of a plunge is not covered");
    refused(&[&["chatter", PROCESS], ARM, &["--feed", "0,0,0"]], "--feed is 0,0,0; expected a direction");
    refused(&[&["chatter", PROCESS], ARM, FEED, &["--damping-ratio", "0"]], "--damping-ratio");
    refused(&[&["chatter", PROCESS], ARM], "--feed");
    let bare: &[&str] = &["--robot", "KR 210 R2700 extra", "--joints-deg", "0,-90,90,0,90,0"];
    refused(&[&["chatter", PROCESS], bare, FEED], "no masses in the robot file");
}
