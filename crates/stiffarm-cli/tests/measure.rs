//! From a plan to a table that is filled in to an identification, on the command line.

use std::fmt::Write;
use std::fs;

use assert_cmd::Command;
use serde_json::Value;

fn program(words: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("stiffarm").unwrap().args(words).assert()
}

const ASKED: [&str; 10] = [
    "measure",
    "KR 210 R2700 extra",
    "--loads",
    "down,left",
    "--runs",
    "10",
    "--candidates",
    "600",
    "--load-mm",
    "0,100,250",
];

#[test]
fn a_plan_is_filled_in_and_identified_and_one_of_ones_own_is_judged_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (table, filled, robot) = (file("plan.csv"), file("filled.csv"), file("found.toml"));
    program(&[&ASKED[..], &["-o", &table]].concat()).success();
    let answer: Value = serde_json::from_slice(
        &program(&[&ASKED[..], &["--format", "json", "--compare", &table]].concat()).success().get_output().stdout,
    )
    .unwrap();
    assert_eq!(answer["runs"].as_array().unwrap().len(), 10);
    assert!(0.8 < answer["efficiency"].as_f64().unwrap());
    let same = answer["compared"]["value"].as_f64().unwrap() / answer["value"].as_f64().unwrap();
    assert!((same - 1.0).abs() < 1e-9, "{same}");
    // As it is it was not measured.
    let refused = program(&["identify", &table, "--robot", "KR 210 R2700 extra"]).failure().code(1);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("row 1, dx_mm: the cell is empty"));
    // The displacements that the program itself tells of each posture.
    let text = fs::read_to_string(&table).unwrap();
    let mut lines = text.lines();
    let headings: Vec<&str> = lines.next().unwrap().split(',').collect();
    let at = |name: &str| headings.iter().position(|heading| *heading == name).unwrap();
    let mut made = headings.join(",") + "\n";
    for (number, line) in lines.enumerate() {
        let mut cells: Vec<String> = line.split(',').map(Into::into).collect();
        let joints = format!("--joints-deg={}", cells[at("q1_deg")..=at("q6_deg")].join(","));
        let force = format!("--force-n={}", cells[at("fx_n")..=at("fz_n")].join(","));
        let asked = ["compliance", "KR 210 R2700 extra", &joints, &force, "--tool-mm", "0,100,250", "--format", "json"];
        let posture: Value = serde_json::from_slice(&program(&asked).success().get_output().stdout).unwrap();
        for (i, name) in ["dx_mm", "dy_mm", "dz_mm"].into_iter().enumerate() {
            // A run that is made twice is not read twice alike.
            let read = posture["deflection_mm"][i].as_f64().unwrap() + 1e-6 * number as f64;
            cells[at(name)] = format!("{read:.6}");
        }
        writeln!(made, "{}", cells.join(",")).unwrap();
    }
    fs::write(&filled, made).unwrap();
    program(&["identify", &filled, "--robot", "KR 210 R2700 extra", "-o", &robot]).success();
    let found: Value = serde_json::from_slice(
        &program(&["identify", &filled, "--robot", "KR 210 R2700 extra", "--format", "json"])
            .success()
            .get_output()
            .stdout,
    )
    .unwrap();
    assert_eq!(found["remarks"], serde_json::json!([]), "every column is known");
    let truth: Value = serde_json::from_slice(
        &program(&["compliance", "KR 210 R2700 extra", "--joints-deg", "0,-90,90,0,45,0", "--format", "json"])
            .success()
            .get_output()
            .stdout,
    )
    .unwrap();
    for drive in 0..6 {
        let (k, expected) = (&found["drives"][drive]["compliance_urad_per_nm"], &truth["drive_urad_per_nm"][drive]);
        // Nanometres were written.
        assert!(
            (k.as_f64().unwrap() / expected.as_f64().unwrap() - 1.0).abs() < 1e-3,
            "drive {}: {k}, {expected}",
            drive + 1
        );
    }
}

#[test]
fn an_instrument_is_reported_with_what_it_sees_and_half_of_one_is_refused() {
    let sighted =
        [&ASKED[..], &["--instrument", "3.5,-2,1.5", "--marker-faces", "0:0:2", "--acceptance-deg", "40"]].concat();
    let printed = String::from_utf8(program(&sighted).success().get_output().stdout.clone()).unwrap();
    assert!(printed.contains("up to 40.0 deg from 0, 0, 1 of the flange, from (3.5, -2, 1.5) m"), "{printed}");
    assert!(
        printed.contains("looked at were joint limits, window, sight, and the links (as capsules of estimated radii)"),
        "{printed}"
    );
    for (more, why) in [
        (&["--marker-faces", "0:0:1"][..], "--marker-faces needs --instrument"),
        (&["--instrument", "1,2,3", "--acceptance-deg", "9"], "--acceptance-deg needs --marker-faces"),
        (&["--instrument", "1,2"], "--instrument has 2 numbers; expected x,y,z in m from the base"),
        (&["--instrument", "1,2,3", "--marker-faces", "0:0:0"], "expected x:y:z along flange axes, not all 0"),
        (&["--instrument", "0,0,0.3", "--window", "..,..,3.."], "in sight of the instrument"),
    ] {
        let refused = program(&[&ASKED[..], more].concat()).failure();
        let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(said.contains(why), "{said}");
    }
}

/// By the answer itself: the same runs in a row are one picture, its markers are where the table has them moved.
#[test]
fn the_postures_of_a_plan_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plan.svg").to_string_lossy().into_owned();
    program(&[&ASKED[..], &["-o", &file]].concat()).success();
    let drawn = fs::read_to_string(&file).unwrap();
    let answer: Value =
        serde_json::from_slice(&program(&[&ASKED[..], &["--format", "json"]].concat()).success().get_output().stdout)
            .unwrap();
    let runs = answer["runs"].as_array().unwrap();
    let same = |i: usize| ["joints_deg", "load"].iter().all(|key| runs[i][key] == runs[i - 1][key]);
    let pictures = 1 + (1..runs.len()).filter(|i| !same(*i)).count();
    assert_eq!(drawn.matches("mm expected").count(), pictures);
    let joint_1 = runs[0]["joints_deg"][0].as_f64().unwrap();
    assert!(drawn.contains(&format!("joint 1 at {joint_1:.2}°")), "{joint_1}");
}

#[test]
fn a_plan_for_a_robot_whose_pendant_is_not_known_opens_with_that_and_is_read_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("plan.csv").to_string_lossy().into_owned();
    let asked = |robot: &'static str| ["measure", robot, "--runs", "8", "--candidates", "200", "-q", "-o", &table];
    program(&asked("GP200R")).success();
    let text = fs::read_to_string(&table).unwrap();
    let first = text.lines().next().unwrap();
    assert!(first.starts_with("# joints are given as the robot file of GP200R counts them"), "{first}");
    let read = program(&["measure", "GP200R", "--runs", "8", "--candidates", "200", "--compare", &table]).success();
    let printed = String::from_utf8_lossy(&read.get_output().stdout).into_owned();
    assert!(printed.contains("your table") && printed.contains("compare before you type them"), "{printed}");
    // Filled in with a push along the force, which no reading repeats to the last digit.
    let mut lines = text.lines().skip(1);
    let headings: Vec<&str> = lines.next().unwrap().split(',').collect();
    let at = |name: &str| headings.iter().position(|heading| *heading == name).unwrap();
    let mut made = format!("{first}\n{}\n", headings.join(","));
    for (i, line) in lines.enumerate() {
        let mut cells: Vec<String> = line.split(',').map(Into::into).collect();
        for (moved, force) in [("dx_mm", "fx_n"), ("dy_mm", "fy_n"), ("dz_mm", "fz_n")] {
            let noise = 1e-4 * i as f64;
            cells[at(moved)] = (noise + 1e-3 * cells[at(force)].parse::<f64>().unwrap()).to_string();
        }
        writeln!(made, "{}", cells.join(",")).unwrap();
    }
    fs::write(&table, made).unwrap();
    let found = program(&["identify", &table, "--robot", "GP200R"]).success();
    let printed = String::from_utf8_lossy(&found.get_output().stdout).into_owned();
    assert!(printed.contains("compare one posture"), "{printed}");
    program(&asked("KR 210 R2700 extra")).success();
    assert!(fs::read_to_string(&table).unwrap().starts_with("run,posture,q1_deg"));
}

const POSTURES: [&str; 9] =
    ["measure", "KR 210 R2700 extra", "--geometry", "--runs", "10", "--candidates", "200", "--marker-mm", "100,0,150"];

/// A plan of postures, filled in with where the program itself says that the point stands, tells an arm that is as drawn.
#[test]
fn a_plan_of_postures_is_filled_in_and_calibrates_the_arm() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (table, filled, figure) = (file("plan.csv"), file("filled.csv"), file("plan.svg"));
    program(&[&POSTURES[..], &["-o", &table, "-o", &figure]].concat()).success();
    let output = program(&[&POSTURES[..], &["--format", "json"]].concat()).success();
    let answer: Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
    let at_work = |key: &str| answer["at_work"][key].as_f64().unwrap();
    let in_order = ["unexplained_mm", "lower_bound_mm", "expected_mm", "random_mm"].map(at_work);
    assert!(in_order.is_sorted() && at_work("expected_mm") < at_work("as_drawn_mm"), "{answer}");
    assert_eq!(answer["runs"].as_array().unwrap().len(), 10);
    assert!(fs::read_to_string(figure).unwrap().contains("run 10"));
    // As it is nothing was seen.
    let refused = program(&["calibrate", "KR 210 R2700 extra", &table]).failure().code(1);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("plan.csv"), "{refused:?}");
    let text = fs::read_to_string(&table).unwrap();
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(lines[0], "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x1_mm,y1_mm,z1_mm");
    let mut made = lines[0].to_owned() + "\n";
    for line in &lines[1..] {
        let joints = line.strip_suffix(",,,").unwrap();
        let given = format!("--joints-deg={joints}");
        let asked = ["compliance", "KR 210 R2700 extra", &given, "--tool-mm", "100,0,150", "--format", "json"];
        let posture: Value = serde_json::from_slice(&program(&asked).success().get_output().stdout).unwrap();
        let point = [0, 1, 2].map(|i| format!("{:.5}", posture["tcp_m"][i].as_f64().unwrap() * 1e3));
        writeln!(made, "{joints},{}", point.join(",")).unwrap();
    }
    fs::write(&filled, made).unwrap();
    let found = program(&["calibrate", "KR 210 R2700 extra", &filled, "--format", "json"]).success();
    let found: Value = serde_json::from_slice(&found.get_output().stdout).unwrap();
    assert!(found["nominal_rms_mm"].as_f64().unwrap() < 1e-3 && found["rows"] == 10, "{found}");
}

#[test]
fn what_says_nothing_of_a_calibration_is_refused() {
    for (words, expected) in [
        (&["--loads", "down"][..], "loads"),
        (&["--force-n", "500"], "force-n"),
        (&["--repeats", "3"], "repeats"),
        (&["--compare", "mine.csv"], "compare"),
        (&["--drive-urad-per-nm", "1"], "drive-urad-per-nm"),
        (&["--stiffness-nm-per-rad", "1e6"], "stiffness-nm-per-rad"),
        (&["--tool", "spindle:250@90"], "without a task"),
        (&["--tool-mm", "0,0,200"], "without a task"),
        (&["--candidates", "30000"], "at most 20000"),
        (&["--marker-mm", "a=0,0,100;b=0,100,0;c=100,0,0;d=100,100,0;e=0,0,200"], "at most 4"),
        (&["--runs", "4"], "at least 6"),
    ] {
        let asked = [&["measure", "KR 210 R2700 extra", "--geometry"], words].concat();
        let refused = program(&asked).failure();
        let errors = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(errors.contains(expected), "{words:?}: {errors}");
    }
}

#[test]
fn points_on_the_axis_of_joint_6_are_said_to_tell_nothing_of_its_zero() {
    for (marker, is_on_axis) in [("0,0,150", true), ("100,0,150", false), ("a=0,0,150;b=0,80,0", false)] {
        let words =
            ["measure", "KR 210 R2700 extra", "--geometry", "--runs", "8", "--candidates", "40", "--marker-mm", marker];
        let output = program(&words).success();
        let printed = String::from_utf8_lossy(&output.get_output().stdout).into_owned();
        assert_eq!(printed.contains("they show nothing of its zero"), is_on_axis, "{marker}: {printed}");
    }
}
