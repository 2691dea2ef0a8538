//! Does the program tell how an arm swings, and refuse what it cannot tell?

use assert_cmd::Command;
use serde_json::Value;

const ASKED: &[&str] = &["modes", "KR 210 R2700-2", "--joints-deg", "0,-90,90,0,45,0", "--tool-mm", "0,0,200"];
const HELD: &[&str] = &["--tool-mass-kg", "60", "--tool-com-mm", "0,0,200"];

fn output(arguments: &[&[&str]]) -> (bool, String, String) {
    let output = Command::cargo_bin("stiffarm").expect("built").args(arguments.concat()).output().expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (output.status.success(), text(output.stdout), text(output.stderr))
}

#[test]
fn the_published_masses_of_a_kr_210_and_six_springs_give_the_modes_worked_out_apart() {
    let springs: &[&str] = &["--drive-urad-per-nm", "0.477,0.296,0.358,2.52,3.01,2.1", "--format", "json"];
    let (ok, out, err) = output(&[ASKED, HELD, springs]);
    assert!(ok, "{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let modes = answer["modes"].as_array().expect("a list");
    assert_eq!(modes.len(), 6);
    for (mode, expected) in modes.iter().zip([9.4584, 10.3533, 19.1985, 44.727, 57.146]) {
        let found = mode["frequency_hz"].as_f64().expect("a number");
        assert!((found - expected).abs() < 1e-3, "{found} is not {expected} Hz");
        assert!(mode["frequency_hz_p05"].is_null() && mode["frequency_motors_free_hz"].is_null(), "{mode}");
        assert_eq!(mode["tip_shape"].as_array().map(Vec::len), Some(3));
    }
    assert_eq!((answer["damping_source"].as_str(), answer["tool_mass_kg"].as_f64()), (Some("assumed"), Some(60.0)));
}

#[test]
fn as_many_modes_are_reported_as_are_asked_for_each_with_its_interval_by_the_prior() {
    let (ok, out, err) = output(&[ASKED, HELD, &["--count", "2", "--format", "csv"]]);
    assert!(ok, "{err}");
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines.len(), 3, "{out}");
    assert!(lines[0].starts_with("mode,frequency_hz,frequency_hz_p05,frequency_hz_p95,"), "{out}");
    let numbers: Vec<f64> = lines[1].split(',').take(4).map(|cell| cell.parse().expect("a number")).collect();
    assert!(numbers[2] < numbers[1] && numbers[1] < numbers[3], "{numbers:?}");
}

#[test]
fn a_tool_without_a_mass_and_what_is_assumed_are_reported() {
    let (ok, out, _) = output(&[ASKED]);
    assert!(ok && out.contains("tool: weighs nothing") && out.contains("damping: assumed 0.03"), "{out}");
}

/// 500 kg at a robot for 210.
#[test]
fn a_tool_that_may_not_be_carried_is_told_with_the_frequencies_and_what_does_not_swing_is_named() {
    let asked = ["modes", "KR 210 R2700-2", "--joints-deg=0,-90,90,0,45,0", "--tool-com-mm", "0,0,200"];
    let (_, heavy, _) = output(&[&asked, &["--tool-mass-kg", "500"]]);
    assert!(heavy.contains("may not carry this: payload 210 kg: EXCEEDED; tool of 500 kg"), "{heavy}");
    let (_, long, _) = output(&[&[
        "modes",
        "KR 210 R2700-2",
        "--joints-deg=0,-90,90,0,45,0",
        "--tool-com-mm",
        "0,0,2000",
        "--tool-mass-kg",
        "100",
    ]]);
    assert!(long.contains("EXCEEDED about axis 5, of the tool's weight;"), "{long}");
    let (_, light, _) = output(&[&asked, &["--tool-mass-kg", "50"]]);
    assert!(!light.contains("EXCEEDED") && !light.contains("nothing swings"), "{light}");
    let (_, calm, _) = output(&[&asked, &["--tool-mass-kg", "50", "--damping-ratio", "1", "--count", "2"]]);
    assert!(calm.contains("nothing swings (mode 1, 2)"), "{calm}");
}

#[test]
fn robots_without_masses_and_tools_that_cannot_be_are_refused_with_what_to_do() {
    let refused = |arguments: &[&[&str]], words: &str| {
        let (ok, _, err) = output(arguments);
        assert!(!ok && err.contains(words) && !err.contains("panicked"), "{err}");
    };
    let bare: &[&str] = &["modes", "KR 210 R2700 extra", "--joints-deg", "0,-90,90,0,45,0"];
    refused(&[bare], "no masses in the robot file");
    refused(&[ASKED, &["--tool-mass-kg", "60"]], "--tool-com-mm");
    refused(&[ASKED, &["--tool-com-mm", "0,0,200"]], "--tool-mass-kg");
    refused(&[ASKED, &["--tool-mass-kg", "-60", "--tool-com-mm", "0,0,200"]], "-60");
    refused(&[ASKED, HELD, &["--tool-inertia-kg-m2", "1,0,0,1,0,3"]], "at most the sum of the other two");
    refused(&[ASKED, &["--damping-ratio", "1.5"]], "1.5");
    refused(&[ASKED, &["--count", "0"]], "from 1 to 6");
}

const OVER: &[&str] = &[
    "modes",
    "KR 210 R2700-2",
    "--task",
    "rect:0.4x0.6",
    "--at",
    "1.5,0.8",
    "--tool-mm",
    "0,0,200",
    "--roll-deg",
    "0",
];

/// The numbers at the least are those that `modes` tells of that posture, which `place` knows nothing of.
#[test]
fn over_a_zone_the_least_is_reported_with_its_interval_and_a_proved_first_frequency_below_it() {
    let (ok, out, err) = output(&[OVER, HELD, &["--format", "json"]]);
    assert!(ok, "{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("no number: {answer}"));
    let modes = answer["modes"].as_array().expect("a list");
    assert_eq!(modes.len(), 6);
    let first = &modes[0];
    let (least, proved) = (number(&first["least_frequency_hz"]), number(&answer["first_at_least_hz"]));
    assert!(proved <= least && 0.985 * least < proved, "{proved} {least}");
    assert!(number(&first["frequency_hz_p05"]) < least && least < number(&first["frequency_hz_p95"]), "{first}");
    assert!(number(&answer["first_at_least_hz_p05"]) < proved);
    for mode in modes {
        assert!(number(&mode["least_frequency_hz"]) < number(&mode["largest_frequency_hz"]), "{mode}");
        let [x, y, z] = [0, 1, 2].map(|i| number(&mode["least_at_m"][i]));
        assert!((x - 1.5).abs() <= 0.2 + 1e-6 && y.abs() <= 0.3 + 1e-6 && (z - 0.8).abs() < 1e-6, "{mode}");
    }
    assert_eq!(number(&answer["roll_deg"]), 0.0);
}

#[test]
fn over_a_zone_the_table_says_what_is_proved_and_what_is_sampled() {
    let (ok, out, err) = output(&[OVER, HELD, &["--count", "2"]]);
    assert!(ok, "{err}");
    for words in
        ["proved to be at least", "5th percentile over draws", "points, at most", "not proved", "tool rolled by 0"]
    {
        assert!(out.contains(words), "{words}: {out}");
    }
    let (ok, out, err) = output(&[OVER, HELD, &["--count", "2", "--format", "csv"]]);
    assert!(ok, "{err}");
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines.len(), 3, "{out}");
    assert!(lines[0].starts_with("mode,least_frequency_hz,frequency_hz_p05,frequency_hz_p95,least_x_m,"), "{out}");
}

#[test]
fn a_zone_without_a_place_and_what_is_of_one_posture_are_refused() {
    let refused = |arguments: &[&[&str]], words: &str| {
        let (ok, _, err) = output(arguments);
        assert!(!ok && err.contains(words) && !err.contains("panicked"), "{words}: {err}");
    };
    let bare: &[&str] = &["modes", "KR 210 R2700-2"];
    refused(&[bare], "--joints-deg");
    refused(&[bare, &["--task", "rect:0.4x0.6"]], "--at");
    refused(&[bare, &["--at", "1.5,0.8"]], "--at needs --task");
    refused(&[ASKED, &["--roll-deg", "0"]], "--roll-deg needs --task");
    refused(&[ASKED, &["--task", "rect:0.4x0.6", "--at", "1.5,0.8"]], "--joints-deg");
    refused(&[OVER, &["--damping-ratio", "0.05"]], "--damping-ratio");
    refused(&[bare, &["--task", "rect:0.4x0.6", "--at", "9,0.8"]], "no place for rect:0.4x0.6");
    refused(&[bare, &["--task", "box:0.4x0.3x0.2", "--at", "1.5,0.8"]], "expected one flat zone");
    refused(
        &[&["modes", "KR 210 R2700 extra", "--task", "rect:0.4x0.6", "--at", "1.5,0.8"]],
        "no masses in the robot file",
    );
}

/// Its numbers are those of the table.
#[test]
fn a_posture_and_a_zone_have_a_report() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let written = |name: &str, arguments: &[&[&str]]| {
        let file = folder.path().join(name).to_str().expect("text").to_owned();
        let (ok, _, err) = output(&[&arguments.concat()[..], &["-o", &file]]);
        assert!(ok, "{err}");
        std::fs::read(file).expect("written")
    };
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    let (_, table, _) = output(&[ASKED, HELD]);
    let first =
        table.lines().nth(1).and_then(|line| line.split_whitespace().nth(1)).expect("the first mode").to_owned();
    assert!(first.parse::<f64>().is_ok_and(|hertz| 5.0 < hertz && hertz < 20.0), "{table}");
    let posture = text(written("report.html", &[ASKED, HELD]));
    for words in [
        &format!("swings first at {first} Hz in this posture"),
        "90 % interval (drive stiffness)",
        "<svg",
        "Motors held still",
        "its README calls them verified",
        "stiffarm modes",
    ] {
        assert!(posture.contains(words), "{words}: {first}");
    }
    let zone = text(written("zone.html", &[OVER, HELD]));
    for words in ["swings first at", "proved to be at least", "not proved", "stiffarm modes"] {
        assert!(zone.contains(words), "{words}");
    }
    assert!(written("report.pdf", &[OVER, HELD]).starts_with(b"%PDF"));
}

#[test]
fn a_map_tells_how_slow_the_arm_swings_first_at_every_point() {
    const MAP: &[&str] = &["map", "KR 210 R2700-2", "--model", "spatial", "--size", "12", "--tool-mm", "0,0,200"];
    const FREQUENCY: &[&str] = &["--quantity", "first-frequency"];
    let json = |arguments: &[&[&str]]| -> Value {
        let (ok, out, err) = output(&[arguments, &[&["--format", "json"]]].concat());
        assert!(ok, "{err}");
        serde_json::from_str(&out).expect("JSON")
    };
    let cells = |answer: &Value| -> Vec<Option<f64>> {
        let rows = answer["first_frequency_hz"].as_array().expect("rows").iter();
        rows.flat_map(|row| row.as_array().expect("cells").iter().map(Value::as_f64)).collect()
    };
    let (light, heavy) = (json(&[MAP, FREQUENCY]), json(&[MAP, FREQUENCY, HELD]));
    let mut count = 0;
    for (light, heavy) in cells(&light).into_iter().zip(cells(&heavy)) {
        let (Some(light), Some(heavy)) = (light, heavy) else {
            assert_eq!(light, heavy);
            continue;
        };
        assert!(1.0 < heavy && heavy < light && light < 60.0, "{light} {heavy}");
        count += 1;
    }
    assert!(20 < count, "{count}");
    // Deflections are the same, and without the option no frequencies are reported.
    let plain = json(&[MAP]);
    assert_eq!((&plain["worst_mm"], &plain["first_frequency_hz"]), (&light["worst_mm"], &Value::Null));
    let (ok, out, err) = output(&[MAP, FREQUENCY, HELD]);
    assert!(
        ok && out.contains("slowest") && out.contains("tool: 60 kg, centre 0, 0, 200 mm") && out.contains("Hz at x"),
        "{out}{err}"
    );
    let (_, table, _) = output(&[MAP, FREQUENCY, &["--format", "csv"]]);
    assert!(table.lines().next().is_some_and(|heading| heading.ends_with(",first_frequency_hz")), "{table}");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("map.svg");
    let file = file.to_str().expect("a path");
    let (ok, _, err) = output(&[MAP, FREQUENCY, &["-o", file]]);
    let svg = std::fs::read_to_string(file).expect("written");
    assert!(ok && svg.contains("first frequency of the arm, motors held still [Hz]"), "{err}");
    for (arguments, words) in [
        ([MAP, HELD], "--tool-com-mm needs --quantity"),
        ([MAP, &["--layer", "first-frequency"]], "expected quantity first-frequency beside it"),
        ([&["map", "IRB 6650S-200", "--model", "spatial", "--size", "12"], FREQUENCY], "no masses in the robot file"),
        ([&["map", "KR 210 R2700-2"], FREQUENCY], "--quantity needs --model spatial"),
    ] {
        let (ok, out, err) = output(&arguments);
        assert!(!ok && out.is_empty() && err.contains(words), "{words}: {err}");
    }
}
