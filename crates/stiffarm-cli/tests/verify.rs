//! Do `stiffarm robots verify` and `stiffarm calibrate` tell, write and refuse as their help says?

use std::fmt::Write;
use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// Exit code, standard output, standard error; never a panic.
fn run(folder: &TempDir, arguments: &[&str]) -> (i32, String, String) {
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let output = program.current_dir(folder.path()).args(arguments).output().expect("runs");
    let [out, errors] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("text"));
    assert!(!errors.contains("panicked"), "{errors}");
    (output.status.code().expect("an exit code"), out, errors)
}

/// What a KUKA KR 210 R2700 extra shows: worked out by an arm of two links in its plane, and turned about joint 1.
///
/// Upper arm at `A2` from the vertical by `A2 + 90`, forearm by `A3` more; the wrist is bent by `A5`, joint 4 and 6 stand at zero. The tool is the flange.
fn planar(a1: f64, a2: f64, a3: f64, a5: f64) -> [f64; 3] {
    let (upper, fore) = ((a2 + 90.0).to_radians(), (a2 + 90.0 + a3).to_radians());
    let hand = fore + a5.to_radians();
    let ahead = 350.0 + 1150.0 * upper.sin() + 1200.0 * fore.sin() + (-41.0) * -fore.cos() + 215.0 * hand.sin();
    let up = 675.0 + 1150.0 * upper.cos() + 1200.0 * fore.cos() + (-41.0) * fore.sin() + 215.0 * hand.cos();
    // A1 turns clockwise.
    let turn = -a1.to_radians();
    [ahead * turn.cos(), ahead * turn.sin(), up]
}

fn table(sign_of_1: f64) -> String {
    let mut text =
        String::from("joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,joint_6_deg,x_mm,y_mm,z_mm\n");
    for [a1, a2, a3, a5] in [
        [0.0, -90.0, 90.0, 45.0],
        [30.0, -70.0, 80.0, -60.0],
        [-40.0, -110.0, 100.0, 30.0],
        [15.0, -60.0, 60.0, -50.0],
        [-20.0, -80.0, 110.0, 70.0],
        [60.0, -100.0, 70.0, -20.0],
        [-75.0, -65.0, 95.0, 55.0],
    ] {
        let [x, y, z] = planar(sign_of_1 * a1, a2, a3, a5);
        writeln!(text, "{a1},{a2},{a3},0,{a5},0,{x:.3},{y:.3},{z:.3}").unwrap();
    }
    text
}

const KUKA: &str = "KR 210 R2700 extra";

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn postures_of_a_plane_agree_and_do_not_verify_joints_that_never_moved() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("pendant.csv"), table(1.0)).unwrap();
    let (code, out, errors) = run(&folder, &["robots", "verify", KUKA, "pendant.csv", "--format", "json"]);
    let answer = json(&out);
    assert_eq!((code, &answer["verified"]), (1, &Value::from(false)), "{errors}");
    assert!(answer["largest_mm"].as_f64().unwrap() < 0.002 && answer["rows"] == 7, "{answer}");
    let alike = answer["alike"].to_string();
    assert!(alike.contains("the sign of joint 4") && alike.contains("the sign of joint 6"), "{alike}");
    assert!(!alike.contains("joint 2") && !alike.contains("whether joint 3"), "{alike}");
    assert!((1..=3).contains(&answer["postures_deg"].as_array().unwrap().len()));
    assert!(errors.contains("is not verified") && errors.contains("hint: "));
}

#[test]
fn a_sign_that_differs_is_reported_written_and_then_agrees() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("pendant.csv"), table(-1.0)).unwrap();
    let asked = ["robots", "verify", KUKA, "pendant.csv", "--date", "2026-05-31", "-o", "mine.toml", "-o", "fits.json"];
    let (code, _, errors) = run(&folder, &asked);
    assert_eq!(code, 1, "{errors}");
    let answer = json(&fs::read_to_string(folder.path().join("fits.json")).unwrap());
    let best = &answer["fits"][0];
    assert_eq!(best["sign"], serde_json::json!([1.0, 1.0, 1.0, -1.0, 1.0, -1.0]), "{answer}");
    assert!(best["rms_mm"].as_f64().unwrap() < 0.002 && best["third_axis"] == "elbow");
    assert_eq!(best["differences"], serde_json::json!(["joint 1 counts the other way"]));
    let (code, out, _) = run(&folder, &["robots", "verify", "mine.toml", "pendant.csv", "--format", "json"]);
    assert!(code == 1 && json(&out)["largest_mm"].as_f64().unwrap() < 0.002, "{out}");
}

#[test]
fn the_robot_of_a_table_is_found_among_all() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("pendant.csv"), table(1.0)).unwrap();
    let (code, out, errors) = run(&folder, &["robots", "verify", "pendant.csv", "--any", "--format", "json"]);
    let answer = json(&out);
    assert_eq!(code, 0, "{errors}");
    let fits = answer["fits"].as_array().unwrap();
    let of = |i: usize| fits[i]["rms_mm"].as_f64().unwrap();
    // Sister types may have the same lengths.
    let same =
        (0..fits.len()).take_while(|&i| of(i) < 0.01).map(|i| fits[i]["robot"].as_str().unwrap()).collect::<Vec<_>>();
    assert!(same.contains(&KUKA) && 1.0 < of(same.len()), "{answer}");
}

/// Of the first move in joints of a KRL program, deg.
fn first_joint_2(program: &str) -> f64 {
    let (_, after) = program.split_once("A2 ").unwrap_or_else(|| panic!("{program}"));
    after.split([',', '}']).next().unwrap().trim().parse().unwrap()
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("pendant.csv"), table(1.0)).unwrap();
    fs::write(folder.path().join("bad.csv"), table(1.0).replace("x_mm", "x")).unwrap();
    for (arguments, code, says) in [
        (&["robots", "verify", "pendant.csv"][..], 2, "ROBOT"),
        (&["robots", "verify", KUKA, "none.csv"], 1, "none.csv"),
        (&["robots", "verify", KUKA, "bad.csv"], 1, "bad.csv:1: x_mm: the column is missing"),
        (&["robots", "verify", KUKA, "pendant.csv", "--date", "2026-13-01"], 2, "2026-05-31"),
        (&["robots", "verify", KUKA, "pendant.csv", "-o", "pendant.csv"], 2, "reads this file"),
        (&["robots", "verify", "pendant.csv", "--any", "-o", "x.toml"], 2, "expected a name that ends in"),
        (&["calibrate", KUKA, "pendant.csv", "--level", "all"], 2, "zeros, geometry, weight or gears"),
        (&["calibrate", KUKA, "pendant.csv"], 1, "a controller computes"),
        (&["calibrate", KUKA], 2, "expected a name that ends in .toml, or ROBOT POINTS.csv"),
        (&["calibrate", KUKA, "pendant.csv", "--columns", "x1_mm"], 2, "NAME=HEADING"),
        (&["calibrate", KUKA, "pendant.csv", "--at", "1,2"], 2, "x,y,z in m"),
        (&["calibrate", KUKA, "bad.csv"], 1, "bad.csv:1: x_mm"),
        (&["calibrate", KUKA, "pendant.csv", "--frame-by", "station"], 1, "--frame-by names the column"),
    ] {
        let (found, _, errors) = run(&folder, arguments);
        assert!(found == code && errors.contains(says), "{arguments:?} {found}: {errors}");
    }
}

#[test]
fn a_calibration_is_reported_drawn_written_and_used_in_programs() {
    let folder = TempDir::new().unwrap();
    // Joint 2 stands 0.1 deg beyond what it reports.
    let mut text =
        String::from("joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,joint_6_deg,x1_mm,y1_mm,z1_mm\n");
    for i in 0..40 {
        let part = |k: i32, span: f64| (f64::from(i * k % 41) / 20.0 - 1.0) * span;
        let (a1, a2, a3, a5) = (part(7, 120.0), -70.0 + part(11, 55.0), 40.0 + part(13, 90.0), part(17, 100.0));
        let [x, y, z] = planar(a1, a2 + 0.1, a3, a5);
        writeln!(text, "{a1},{a2},{a3},0,{a5},0,{x:.4},{y:.4},{z:.4}").unwrap();
    }
    fs::write(folder.path().join("points.csv"), text).unwrap();
    let asked = [
        "calibrate",
        KUKA,
        "points.csv",
        "--level",
        "zeros",
        "--date",
        "2026-05-31",
        "-o",
        "mine.toml",
        "-o",
        "c.json",
        "-o",
        "c.svg",
    ];
    let (code, _, errors) = run(&folder, &asked);
    assert_eq!(code, 0, "{errors}");
    let answer = json(&fs::read_to_string(folder.path().join("c.json")).unwrap());
    // The prior pulls it back by a part that the rows do not feel.
    assert!((answer["zero_deg"][1].as_f64().unwrap() - 0.1).abs() < 1e-3, "{answer}");
    let levels = answer["levels"].as_array().unwrap();
    assert!(levels.len() == 5 && levels[0]["level"] == "as drawn" && answer["level"] == "zeros");
    assert!(
        levels[1]["rms_mm"].as_f64().unwrap() < 1e-3 && 1.0 < answer["nominal_rms_mm"].as_f64().unwrap(),
        "{answer}"
    );
    assert!(fs::read_to_string(folder.path().join("c.svg")).unwrap().contains("calibrated"));
    let (code, _, errors) = run(&folder, &["robots", "check", "mine.toml"]);
    assert!(code == 0 && errors.contains("its [calibration] is used by compliance, mill"), "{errors}");
    let path = ["mill", "line:0.1", "--force-n", "100,0,0", "--at", "1.7,0,0.8", "--feed-mm-per-min", "600"];
    let how = ["--work-frame", "measured", "--roll", "0"];
    let milled = |more: &[&str]| run(&folder, &[&path[..], &how, more].concat());
    let (code, _, errors) = milled(&["--robot", "mine.toml", "-o", "a.src"]);
    assert!(code != 0 && errors.contains("does not say controller_model"), "{errors}");
    let mine = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    let said = mine.replace("[calibration]", "[calibration]\ncontroller_model = \"nominal\"");
    fs::write(folder.path().join("mine.toml"), said).unwrap();
    for (robot, program) in [("mine.toml", "a.src"), (KUKA, "b.src")] {
        let (code, _, errors) = milled(&["--robot", robot, "-o", program]);
        assert_eq!(code, 0, "{errors}");
    }
    let [calibrated, drawn] = ["a.src", "b.src"].map(|name| fs::read_to_string(folder.path().join(name)).unwrap());
    let head: Vec<&str> = calibrated.lines().take(8).collect();
    assert!(head.iter().any(|line| line.contains("controller_model = nominal")), "{head:#?}");
    assert!(calibrated.contains("Work frame: measured") && !drawn.contains("controller_model"));
    // Joint 2 stands 0.1 deg beyond what it reports.
    let [sent, other] = [&calibrated, &drawn].map(|program| first_joint_2(program));
    assert!((sent + 0.1 - other).abs() < 2e-3, "{sent} {other}");
    let (_, out, errors) = milled(&["--robot", "mine.toml", "--format", "json"]);
    let answer = json(&out);
    let of = |key: &str| answer["true_arm"][key].as_f64().unwrap_or_else(|| panic!("{key}: {out} {errors}"));
    assert!(1.0 < of("uncorrected_mm") && of("by_both_mm") < 1e-6 && answer["arm_error"].is_null(), "{out}");
    let (_, out, _) = milled(&["--robot", KUKA, "--format", "json"]);
    let other = json(&out);
    assert!(other["true_arm"].is_null() && 0.0 < other["arm_error"]["p95_mm"].as_f64().unwrap(), "{out}");
    // A rewritten path says of both controllers what must be on and what off.
    fs::write(folder.path().join("line.nc"), "G21 G90\nG1 X-50 Y0 Z0 F600\nG1 X50\n").unwrap();
    let nominal = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    for (model, says) in [
        ("nominal", "absolute-accuracy correction of the controller must be off"),
        ("calibrated", "calibration must be on"),
    ] {
        let said = nominal.replace("controller_model = \"nominal\"", &format!("controller_model = \"{model}\""));
        fs::write(folder.path().join("own.toml"), said).unwrap();
        let words = [
            "mill",
            "line.nc",
            "--force-n",
            "100,0,0",
            "--at",
            "1.7,0,0.8",
            "--robot",
            "own.toml",
            "--compensate",
            "-o",
            "out.nc",
        ];
        let (code, _, errors) = run(&folder, &[&words[..], &how].concat());
        let written = fs::read_to_string(folder.path().join("out.nc")).unwrap_or_default();
        assert!(
            code == 0 && written.contains(says) && written.contains(&format!("controller_model = {model}")),
            "{errors} {written}"
        );
        assert!(written.contains("Work frame: measured") == (model == "nominal"), "{written}");
    }
    let mounted = ["--robot", "mine.toml", "--mount", "ceiling:3"];
    let (code, _, errors) = milled(&mounted);
    assert!(code == 0 || !errors.contains("weight_mrad"), "zeros hold however the base stands: {errors}");
    let weighs = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    let weighs = weighs.replace("[calibration]", "[calibration]\nweight_mrad = [0.5, 0, 0, 0, 0, 0, 0, 0]");
    fs::write(folder.path().join("mine.toml"), weighs).unwrap();
    let (code, _, errors) = milled(&mounted);
    assert!(code != 0 && errors.contains("weight_mrad"), "{errors}");
}
