//! From measurements to a robot file to an answer, on the command line.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const ASKED: [&str; 6] = [
    "identify",
    "docs/examples/fanuc_r2000ic.csv",
    "--robot",
    "docs/examples/fanuc_r2000ic.toml",
    "--load-mm",
    "6.9,245.3,319.3",
];

fn program(words: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("stiffarm").unwrap().current_dir(ROOT).args(words).assert()
}

fn json(words: &[&str]) -> Value {
    serde_json::from_slice(&program(&[words, &["--format", "json"]].concat()).success().get_output().stdout).unwrap()
}

/// The same readings with forces in kgf: every drive gives way 9.81 times as much.
#[test]
fn forces_in_another_unit_are_remarked_on() {
    let text = fs::read_to_string(Path::new(ROOT).join("docs/examples/fanuc_r2000ic.csv")).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next().unwrap();
    let is_load: Vec<bool> = header
        .split(',')
        .map(|name| ["fx", "fy", "fz", "mx", "my", "mz"].iter().any(|load| name.starts_with(load)))
        .collect();
    assert!(is_load.contains(&true), "{header}");
    let row = |line: &str| {
        let cells = line.split(',').zip(&is_load).map(|(cell, is_load)| match cell.parse::<f64>() {
            Ok(newtons) if *is_load => (newtons / 9.80665).to_string(),
            _ => cell.to_owned(),
        });
        cells.collect::<Vec<_>>().join(",")
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("kgf.csv");
    fs::write(&file, [header.to_owned()].into_iter().chain(lines.map(row)).collect::<Vec<_>>().join("\n")).unwrap();
    let mut asked = ASKED;
    let name = file.to_string_lossy().into_owned();
    asked[1] = &name;
    let [right, wrong] = [&ASKED, &asked].map(|asked| json(asked)["remarks"].to_string());
    assert!(wrong.contains("1 kgf is 9.81 N") && !right.contains("kgf"), "{wrong} {right}");
}

#[test]
fn the_answer_says_what_is_not_known_and_becomes_a_robot_file_that_other_verbs_read() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (robot, figure, pdf, table, job) =
        (file("f.toml"), file("f.svg"), file("f.pdf"), file("f.csv"), file("job.toml"));
    let outputs = ["-o", &robot, "-o", &figure, "-o", &pdf, "-o", &table, "--date", "2026-05-31", "--save-job", &job];
    program(&[&ASKED[..], &outputs].concat()).success();
    let found = json(&ASKED);
    let identified: Vec<bool> =
        found["drives"].as_array().unwrap().iter().map(|drive| drive["identified"] == true).collect();
    assert_eq!(identified, [true, true, true, true, true, false]);
    assert_eq!(found["outliers"], serde_json::json!([17, 11]));
    assert_eq!((&found["postures"], &found["schema"]["verb"]), (&43.into(), &"identify".into()));
    for key in ["rms_before_mm", "rms_after_mm", "explained", "explained_left_out", "condition"] {
        assert!(found[key].is_number(), "{key}");
    }
    assert_eq!(found["singular_values"].as_array().unwrap().len(), 6);
    let svg = fs::read_to_string(figure).unwrap();
    assert!(svg.contains("43 rows in 43 postures") && svg.contains("correlation of the drives"), "{svg}");
    assert!(fs::read(pdf).unwrap().starts_with(b"%PDF"));
    assert_eq!(fs::read_to_string(table).unwrap().lines().count(), 7);
    // A job asks the same, from any folder.
    let again = Command::cargo_bin("stiffarm")
        .unwrap()
        .current_dir(folder.path())
        .args(["identify", "job.toml", "--format", "json"])
        .assert();
    let mut again: Value = serde_json::from_slice(&again.success().get_output().stdout).unwrap();
    assert_eq!(again["date"], "2026-05-31");
    again["date"] = Value::Null;
    assert_eq!(again, found);
    let posture = json(&["compliance", &robot, "--joints-deg", "0,0,0,0,45,0"]);
    assert_eq!(posture["stiffness_source"], "identified");
    let (filed, used) = (&posture["drive_urad_per_nm"][5], &found["drives"][5]["used_urad_per_nm"]);
    // A robot file has ten digits.
    assert!((filed.as_f64().unwrap() / used.as_f64().unwrap() - 1.0).abs() < 1e-9);
    let printed = String::from_utf8(
        program(&["compliance", &robot, "--joints-deg", "0,0,0,0,45,0"]).success().get_output().stdout.clone(),
    )
    .unwrap();
    let printed = printed.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        printed.contains("identified in 43 postures, 2026-05-31, residual 23 % of a displacement; not identified: 6"),
        "{printed}"
    );
}

/// Displacements of other rows, along other axes, with other signs: no drive is shown, and no file says that one is.
#[test]
fn data_that_show_no_drive_make_no_robot_file() {
    let text = fs::read_to_string(Path::new(ROOT).join(ASKED[1])).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next().unwrap();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let first = header.split(',').position(|name| name == "dx_m").unwrap();
    let mixed = rows.iter().enumerate().map(|(k, row)| {
        let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
        let other = &rows[(17 * k + 5) % rows.len()];
        let moved = (0..3).map(|i| (sign * other[first + (i + 1) % 3].parse::<f64>().unwrap()).to_string());
        row[..first].iter().map(|cell| (*cell).to_owned()).chain(moved).collect::<Vec<_>>().join(",")
    });
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (data, robot, report) = (file("mixed.csv"), file("robot.toml"), file("report.html"));
    fs::write(&data, [header.to_owned()].into_iter().chain(mixed).collect::<Vec<_>>().join("\n")).unwrap();
    let mut asked = ASKED;
    asked[1] = &data;
    let found = json(&asked);
    assert!(found["drives"].as_array().unwrap().iter().all(|drive| drive["identified"] == false), "{found}");
    let refused = program(&[&asked[..], &["-o", &robot]].concat()).failure().code(1);
    let errors = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(errors.contains("no robot file: no drive of R-2000iC, measured is identified"), "{errors}");
    assert!(!Path::new(&robot).exists());
    program(&[&asked[..], &["-o", &report]].concat()).success();
    assert!(fs::read_to_string(report).unwrap().contains("No drive is identified, so that there is none."));
}

#[test]
fn what_is_wrong_is_named_with_its_place_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong.csv");
    let text = fs::read_to_string(Path::new(ROOT).join(ASKED[1]))
        .unwrap()
        .replace("dx_m,", "dx_mm,")
        .replace("dy_m,dz_m", "dy_mm,dz_mm");
    fs::write(&path, text).unwrap();
    let robot = folder.path().join("robot.toml");
    let (path, out) = (path.to_string_lossy().into_owned(), robot.to_string_lossy().into_owned());
    let refused = program(&["identify", &path, "--robot", ASKED[3], "-o", &out]).failure().code(1);
    let errors = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
    assert!(
        errors.contains("wrong.csv:3: half of the rows move less than")
            && errors.contains("hint: every fault is named"),
        "{errors}"
    );
    assert!(!robot.exists());
    let refused = program(&["identify", &path]).failure().code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("--robot <ROBOT> is missing"));
    let refused =
        program(&["identify", "x.csv", "--robot", "BT200L", "--marker-mm", "10,20,30;40,50,60"]).failure().code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("expected each with a name"));
}
