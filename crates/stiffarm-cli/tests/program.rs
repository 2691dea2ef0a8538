//! Does the program answer as users and scripts rely on, and refuse what makes no sense?

use std::fs;
use std::path::Path;
use std::process::Command as Process;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

const SMALLEST: &str =
    "name = \"two links\"\narchitecture = \"serial\"\nstatus = \"derived\"\n\n[planar]\nl2_mm = 1000\nl3_mm = 800\n";

fn program() -> Command {
    Command::cargo_bin("stiffarm").expect("built by cargo")
}

/// Standard output of a run that succeeds.
fn run(arguments: &[&str]) -> String {
    let output = program().args(arguments).output().expect("runs");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).expect("text")
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&run(&[arguments, &["--format", "json"]].concat())).expect("JSON")
}

/// Exit code and standard error of a run that fails without a panic.
fn refused(arguments: &[&str]) -> (i32, String) {
    let output = program().args(arguments).output().expect("runs");
    let errors = String::from_utf8(output.stderr).expect("text");
    assert!(!output.status.success(), "{arguments:?} succeeded");
    assert!(!errors.contains("panicked"), "{errors}");
    (output.status.code().expect("an exit code"), errors)
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().expect("a plain path").into()
}

const COMPLIANCE: &[&str] = &["compliance", "BT200L", "--joints-deg", "0,90,0,0,0,0"];
const SPATIAL: &[&str] = &["place", "BT200L", "--task", "A:0.1", "--model", "spatial"];

#[test]
fn without_arguments_the_papers_robots_are_ranked_on_its_tasks() {
    let text = run(&["rank"]);
    for robot in ["ES200RD II", "HP350D-200", "IRB 6650S-200", "KR 210 R2700 extra", "TX340 SH", "BT200L", "ZX200U"] {
        assert!(text.contains(robot), "{robot} is missing:\n{text}");
    }
    assert!(text.contains("estimated: lengths or limits partly assumed"));
    assert!(
        text.contains("zones upright in the arm plane: take ABB IRB 6650S-200 (payload 200 kg) for A:0.1"),
        "{text}"
    );
    let ranking = json(&["rank"]);
    assert_eq!(ranking["tasks"], serde_json::json!(["A:0.1", "A:1.0", "B:0.1", "B:0.5", "C:0.05", "C:0.15"]));
    assert_eq!(ranking["rows"].as_array().map(Vec::len), Some(10));
    for row in ranking["rows"].as_array().unwrap() {
        for cell in row["cells"].as_array().unwrap() {
            let (value, bound) = (cell["deflection_mm"].as_f64().unwrap(), cell["lower_bound_mm"].as_f64().unwrap());
            assert!(bound <= value && value - bound <= 1e-4 * value);
            assert!(row["bound_mm"].as_f64().unwrap() <= bound * (1.0 + 1e-9));
        }
    }
}

#[test]
fn an_estimated_robot_never_wins_silently() {
    let ranking = json(&["rank", "--task", "A:1.0"]);
    let winner = &ranking["winners"][0];
    assert_eq!(winner["best"], "KR 210 R2700 extra");
    assert_eq!(winner["best_with_estimated"], "IRB 6400 2.4-200");
    let text = run(&["rank", "--task", "A:1.0"]);
    assert!(
        text.contains("ABB IRB 6400 2.4-200 ~") && text.contains("find its data sheet before you decide"),
        "{text}"
    );
    for model in ["planar", "spatial"] {
        let csv = run(&["rank", "--task", "A:1.0", "--model", model, "--format", "csv"]);
        let first: Vec<&str> = csv.lines().nth(1).expect("a row").split(',').collect();
        assert!(first[0].is_empty() && first.contains(&"IRB 6400 2.4-200"), "{csv}");
        assert!(csv.lines().any(|line| line.starts_with("1,") && line.contains("data-sheet")), "{csv}");
    }
}

/// Drive 3 turns the forearm against drive 2: no arm plane that the paper knows.
#[test]
fn a_robot_without_an_arm_plane_is_ranked_in_space() {
    let folder = TempDir::new().expect("a folder");
    let file = path(&folder, "coupled.toml");
    let example = include_str!("../../stiffarm/robots/paper/kuka_kr_210_r2700_extra.toml");
    let rows =
        "transmission = [[1,0,0,0,0,0],[0,1,0,0,0,0],[0,-0.5,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]]";
    fs::write(&file, example.replace("[limits]", &format!("[compliance]\n{rows}\n\n[limits]"))).expect("written");
    let ranking = json(&["rank", "--robots", &format!("{file},BT200L"), "--task", "A:0.5", "--model", "spatial"]);
    let rows = ranking["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2);
    assert!(rows.iter().all(|row| row["cells"][0]["feasible"] == true), "{ranking}");
    assert!(rows.iter().any(|row| row["planar_rank"].is_null()), "{ranking}");
}

#[test]
fn a_placement_has_the_keys_that_scripts_rely_on() {
    let cell = json(&["place", "kr210r2700EXTRA", "--task", "B:0.5", "--tolerance-mm", "2.5"]);
    for key in [
        "robot",
        "task",
        "model",
        "force_n",
        "feasible",
        "deflection_mm",
        "lower_bound_mm",
        "x_m",
        "z_m",
        "angle_deg",
        "elbow",
    ] {
        assert!(!cell[key].is_null(), "{key} is missing: {cell}");
    }
    assert_eq!(cell["model"], "planar");
    assert_eq!(cell["pass"], true);
    let none = json(&["place", "IRB 6400 2.4-200", "--task", "C:0.3"]);
    assert_eq!(none["feasible"], false);
    assert!(none["reason"].as_str().unwrap().contains("the joint limits leave no place"), "{none}");
    assert!(none["deflection_mm"].is_null() && none["x_m"].is_null());
    let too_long = json(&["place", "IRB 6400 2.4-200", "--task", "C:0.6"]);
    assert!(too_long["reason"].as_str().unwrap().contains("too long for any orientation"), "{too_long}");
    let nowhere = json(&["place", "BT200L", "--task", "A:0.5", "--within", "3.5..,.."]);
    assert!(nowhere["reason"].as_str().unwrap().contains("does not fit where it may stand"), "{nowhere}");
    let scale = none["largest_feasible_scale"].as_f64().unwrap();
    assert!(0.1 < scale && scale < 1.0);
    let fits = json(&["place", "IRB 6400 2.4-200", "--task", &format!("rect:{}x{}", 0.3 * scale, 3.0 * scale)]);
    assert_eq!(fits["feasible"], true);
}

#[test]
fn a_place_within_bounds_stands_inside_them() {
    let free = json(&["place", "BT200L", "--task", "B:0.5"]);
    let bound = json(&["place", "BT200L", "--task", "B:0.5", "--within", "1.4..,0.2..1.6"]);
    assert!(free["deflection_mm"].as_f64().unwrap() < bound["deflection_mm"].as_f64().unwrap());
    let (x, z) = (bound["x_m"].as_f64().unwrap(), bound["z_m"].as_f64().unwrap());
    let upright = bound["angle_deg"].as_f64().unwrap() < 1.0;
    let (width, height) = if upright { (0.5, 1.0) } else { (1.0, 0.5) };
    assert!(
        1.4 - 1e-6 <= x - width / 2.0 && 0.2 - 1e-6 <= z - height / 2.0 && z + height / 2.0 <= 1.6 + 1e-6,
        "{bound}"
    );
}

#[test]
fn the_smallest_robot_file_reproduces_the_motivating_example() {
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "two_links.toml");
    fs::write(&file, SMALLEST).unwrap();
    let paper = ["--limit-margin-deg", "0", "--singular-margin-deg", "0"];
    let zone = json(&[&["place", &file, "--task", "rect:0.5x2"][..], &paper].concat());
    assert!((zone["deflection_mm"].as_f64().unwrap() - 1.772).abs() < 5e-4, "{zone}");
    let both = json(&[
        "rank",
        "--robots",
        folder.path().to_str().unwrap(),
        "--robots",
        "kuka kr 210 r2700 e*",
        "--task",
        "A:0.2",
    ]);
    assert_eq!(both["rows"].as_array().map(Vec::len), Some(2));
    assert!(run(&["robots", "check", &file]).contains("can be used"));
}

#[test]
fn every_fault_of_a_robot_file_is_named_with_its_line() {
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "bad.toml");
    fs::write(&file, SMALLEST.replace("800", "0.8").replace("serial", "cereal") + "l4_mm = 3\n").unwrap();
    for arguments in [vec!["robots", "check", &file], vec!["place", &file, "--task", "A:0.1"]] {
        let (code, errors) = refused(&arguments);
        assert_eq!(code, 1);
        for expected in
            ["bad.toml:2: architecture", "bad.toml:7: planar.l3_mm: 0.8 mm", "write 800", "bad.toml:8: planar.l4_mm"]
        {
            assert!(errors.contains(expected), "{expected}:\n{errors}");
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused_with_what_to_do() {
    let cases: &[(&[&str], i32, &str)] = &[
        (&["place", "KR 120 R2700 extra", "--task", "A:0.1"], 1, "did you mean KR 210 R2700 extra"),
        (&["place", "xyz", "--task", "A:0.1"], 1, "stiffarm robots list"),
        (&["place", "missing.toml", "--task", "A:0.1"], 1, "cannot read missing.toml"),
        (&["place", "BT200L", "--task", "circle:500"], 2, "500 mm would be 0.5"),
        (&["place", "BT200L", "--task", "A:0"], 2, "expected 0.0001 to 50 m"),
        (&["place", "BT200L", "--task", "A:nan"], 2, "a side of NaN m"),
        (&["place", "BT200L", "--task", "A:-1"], 2, "a side of -1.0 m"),
        (&["place", "BT200L", "--task", "A:1e99"], 2, "expected 0.0001 to 50 m"),
        (&["place", "BT200L", "--task", "A:0.1", "--force-n", "inf"], 2, "expected a number from"),
        (&["place", "BT200L", "--task", "A:0.1", "--within", "2..1,.."], 2, "the lower end first"),
        (&["place", "BT200L", "--task", "A:0.1", "--angle", "sideways"], 2, "expected axes, horizontal"),
        (&["place", "BT200L", "--task", "A:0.1", "--gap", "0"], 2, "expected a number from"),
        (&["rank", "--robots", "nobody*"], 1, "matches no robot"),
        (&["rank", "--threads", "0"], 2, "expected a whole number"),
        (&["map", "BT200L", "--step-m", "0.000003"], 1, "at most 100000000 cells"),
        (&["map", "BT200L", "--size", "20000"], 1, "at most 100000000 cells"),
        (&["map", "BT200L", "--size", "1000000"], 2, "expected a whole number from 2 to 100000"),
        (&["map", "BT200L", "--size", "1"], 2, "expected a whole number from 2"),
        (&["map", "BT200L", "--direction-deg", "nan"], 2, "expected a number from"),
        (&["study", "--sizes", "-1"], 2, "expected a number from 0.0001 to 10"),
        (&["study", "--range", "..2"], 2, "takes both ends"),
        (&["map", "BT200L", "--component", "normal"], 2, "--component normal to the face needs the spatial model"),
        (&["map", "BT200L", "--force-n", "1,2,3"], 2, "--force-n pushes with 2 N across the arm plane"),
        (
            &["place", "BT200L", "--task", "A:0.1", "--force-n", "3,2,4"],
            2,
            "--force-n pushes with 2 N across the arm plane",
        ),
        (&["map", "BT200L", "--within", "1..2,.."], 2, "--within needs --zone"),
        (&["study", "--robot", "BT200L"], 2, "--robot needs --task"),
        (&["study", "--task", "box:0.2x0.2x0.1"], 2, "'--task <TASK>': expected one flat zone"),
        (&["study", "--task", "B:0.5", "--robot", "no such"], 1, "robot 'no such' is not known"),
        (&["study", "--ratios", "nan"], 2, "for '--ratios <RATIOS>': expected a number from 0.05"),
        (&["study", "--compare", "serial"], 2, "--compare has 1 architectures; expected two"),
        (&["rank", "-o", "ranking.xlsx"], 2, "expected a name that ends in .svg"),
        (&["validate", "-o", "ledger.svg"], 2, "expected a name that ends in .json"),
        (&["rank", "-o", "no/such/folder/ranking.csv"], 1, "cannot write no/such/folder/ranking.csv"),
        (&["rank", "-o", "no/such/folder/ranking.csv"], 1, "hint: there is no folder no/such/folder; make it first"),
        (&["rank", "-o", "ranking.json/"], 1, "cannot write ranking.json/: is a directory"),
        (&["rank", "-o", "ranking.json/."], 1, "cannot write ranking.json/.: is a directory"),
        (&["identify", "a.csv", "--robot", "BT200L", "--regions", "3"], 2, "--regions says nothing of this model"),
        (
            &["measure", "BT200L", "--runs", "700", "--candidates", "100", "--repeats", "6"],
            2,
            "--runs of 700 among 100 candidates, each at most 6 times; expected at most 600",
        ),
        (&["measure", "BT200L", "--criterion", "d", "--task", "A:0.5"], 2, "--task says nothing where the drives"),
        (&["rank", "-o", "-"], 2, "hint: without -o the answer goes to standard output; --format json"),
        (&["study", "--k2", "inf"], 2, "'inf' for '--k2 <K>': expected a number from 0.001 to 1000"),
        (&["study", "--k2", "1e-4"], 2, "or 0 for a rigid drive"),
        (&["study", "--k2", "0", "--k3", "0"], 1, "k2 and k3 are both 0"),
        (&["study", "--k3", "x"], 2, "'x' for '--k3 <K>': expected a number from 0.001 to 1000"),
        (&["compliance", "BT200L", "--joints-deg", "0,90,0"], 2, "--joints-deg has 3 angles; expected six"),
        (
            &["compliance", "BT200L", "--joints-deg", "0,x,0,0,0,0"],
            2,
            "'x' for '--joints-deg <Q1,..,Q6>': expected a number",
        ),
        (&["compliance", "BT200L", "--joints-deg", "0,nan,0,0,0,0"], 2, "expected a number from -1080 to 1080 degrees"),
        (&[COMPLIANCE, &["--force-n", "1,2"]].concat(), 2, "'1,2' for '--force-n <X,Y,Z>': expected a number"),
        (&[COMPLIANCE, &["--force-n", "1,2,inf"]].concat(), 2, "'1,2,inf' for '--force-n <X,Y,Z>': expected a number"),
        (&[COMPLIANCE, &["--tool-mm", "100000,0,0"]].concat(), 2, "lengths up to 10000 mm"),
        (
            &[COMPLIANCE, &["--tool-mm", "nan,0,0"]].concat(),
            2,
            "'nan,0,0' for '--tool-mm <X,Y,Z>': expected x,y,z in mm",
        ),
        (&[SPATIAL, &["--tool-direction", "sideways"]].concat(), 2, "expected down, forward, up, or -90 to 90 degrees"),
        (&[SPATIAL, &["--yaw-deg", "nan"]].concat(), 2, "expected any, or an angle from -360 to 360"),
        (&[SPATIAL, &["--roll-deg", "inf"]].concat(), 2, "expected a number from -360 to 360"),
        (
            &["place", "BT200L", "--task", "A:0.1", "--tolerance-mm", "nan"],
            2,
            "'nan' for '--tolerance-mm <MM>': expected",
        ),
        (&["rank", "--robots", ""], 2, "--robots holds an empty name; expected names, patterns"),
        (&["rank", "--robots", "all", "--payload-kg", "500..100"], 2, "'500..100' is not a range; expected such as"),
        (&["rank", "--robots", "all", "--payload-kg", "5000.."], 1, "payload 0.5 to 800 kg"),
        (&["rank", "--robots", "all", "--reach-m", "nan.."], 2, "'nan..' is not a range"),
        (&["rank", "--robots", "all", "--vendor", "Nobody"], 1, "hint: there are robots of ABB"),
    ];
    for (arguments, code, expected) in cases {
        let (found, errors) = refused(arguments);
        assert_eq!(found, *code, "{arguments:?}: {errors}");
        assert!(errors.contains(expected), "{arguments:?}: {errors}");
    }
}

#[test]
fn every_kind_of_file_is_written() {
    let folder = TempDir::new().unwrap();
    let commands: &[(&str, &[&str], &[&str])] = &[
        (
            "rank",
            &["rank", "--task", "B:0.5,A:0.2", "--tolerance-mm", "2"],
            &["svg", "png", "pdf", "json", "csv", "md", "txt"],
        ),
        ("map", &["map", "IRB 6650S-200", "--size", "60", "--zone", "B:0.5"], &["svg", "png", "pdf", "json", "csv"]),
        ("directed", &["map", "ZX200U", "--size", "60", "--direction-deg", "30"], &["svg", "png", "json"]),
        ("place", &["place", "KR 210 R2700 extra", "--task", "C:0.1"], &["svg", "png", "json", "csv", "md"]),
        ("study", &["study", "--tasks", "A", "--sizes", "0.1,0.5"], &["svg", "png", "json", "csv"]),
    ];
    for (name, arguments, endings) in commands {
        let files: Vec<String> = endings.iter().map(|ending| path(&folder, &format!("{name}.{ending}"))).collect();
        let outputs: Vec<&str> = files.iter().flat_map(|file| ["-o", file.as_str()]).collect();
        run(&[*arguments, &outputs].concat());
        for (file, ending) in files.iter().zip(*endings) {
            let bytes = fs::read(file).unwrap();
            match *ending {
                "png" => assert_eq!(&bytes[1..4], b"PNG", "{file}"),
                "pdf" => assert!(bytes.starts_with(b"%PDF-1.") && bytes.trim_ascii_end().ends_with(b"%%EOF"), "{file}"),
                "svg" => assert!(bytes.starts_with(b"<svg") && bytes.ends_with(b"</svg>\n"), "{file}"),
                "json" => drop(serde_json::from_slice::<Value>(&bytes).expect("JSON")),
                _ => assert!(1 < String::from_utf8(bytes).unwrap().lines().count(), "{file}"),
            }
        }
    }
}

#[test]
fn figures_are_as_wide_as_asked_and_of_one_scale() {
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "map.svg");
    let drawn = |more: &[&str]| {
        run(&[&["map", "BT200L", "--size", "60", "-q", "-o", &file][..], more].concat());
        fs::read_to_string(&file).unwrap()
    };
    let narrow = drawn(&["--width-mm", "170", "--scale", "0.7..3.3", "--tolerance-mm", "2", "--direction-deg", "30"]);
    assert!(narrow.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"170.000mm\""), "{}", &narrow[..200]);
    for text in [">0.7</text>", ">3.3</text>", ">tolerance 2 mm</text>", ">force of 1000 N at 30 deg</text>"] {
        assert!(narrow.contains(text), "{text}");
    }
    assert!(drawn(&["--elbow", "down"]).contains("only with the elbow down"));
    let (code, errors) = refused(&["map", "BT200L", "--scale", "3..3"]);
    assert_eq!(code, 2, "{errors}");
    assert!(errors.contains("--scale") && errors.contains("0..5"), "{errors}");
}

#[test]
fn the_papers_figures_go_into_a_folder() {
    let (code, errors) = refused(&["paper"]);
    assert!(code == 2 && errors.contains("-o DIR"), "{errors}");
}

#[test]
fn the_same_question_gives_the_same_bytes() {
    for arguments in [
        &["rank", "--format", "json"][..],
        &["study", "--format", "csv"],
        &["map", "BT200L", "--size", "50", "--format", "csv"],
    ] {
        assert_eq!(run(arguments), run(&[arguments, &["--threads", "1"]].concat()), "{arguments:?}");
    }
    let folder = TempDir::new().unwrap();
    let (first, second) = (path(&folder, "1.svg"), path(&folder, "2.svg"));
    for file in [&first, &second] {
        run(&["map", "BT200L", "--size", "80", "--zone", "A:0.3", "-o", file]);
    }
    assert_eq!(fs::read(first).unwrap(), fs::read(second).unwrap());
}

#[test]
fn a_map_in_json_is_blank_where_the_arm_does_not_reach() {
    let map = json(&["map", "KR 210 R2700 extra", "--size", "40"]);
    let (columns, rows) = (map["x_m"].as_array().unwrap().len(), map["z_m"].as_array().unwrap().len());
    let cells = map["worst_mm"].as_array().unwrap();
    assert_eq!(cells.len(), rows);
    assert!(cells.iter().all(|row| row.as_array().unwrap().len() == columns));
    let flat: Vec<&Value> = cells.iter().flat_map(|row| row.as_array().unwrap()).collect();
    let reached: Vec<f64> = flat.iter().filter_map(|cell| cell.as_f64()).collect();
    assert!(flat.iter().any(|cell| cell.is_null()) && !reached.is_empty());
    assert!(reached.iter().all(|cell| 1.444 < *cell && *cell < 6.97), "between k l3^2 and k ((l2+l3)^2 + l3^2)");
}

#[test]
fn drive_1_gives_the_square_of_the_distance_sideways() {
    let joints = ["compliance", "KR 210 R2700 extra", "--joints-deg", "0,-90,90,0,0,0", "--tool-mm", "0,0,200"];
    let answer = json(&[&joints[..], &["--force-n", "0,1000,0", "--stiffness", "paper"]].concat());
    for key in
        ["tcp_m", "compliance_um_per_n", "compliance_6x6_si", "principal_um_per_n", "worst_direction", "rotation_mrad"]
    {
        assert!(!answer[key].is_null(), "{key} is missing");
    }
    // Upper arm up, forearm level, tool 0.2 m before the flange: x = 0.350 + 1.200 + 0.215 + 0.200 m; k1 = 1 urad/(N m).
    let x = 1.965_f64;
    assert!((answer["tcp_m"][0].as_f64().unwrap() - x).abs() < 1e-9, "{answer}");
    assert!((answer["deflection_mm"][1].as_f64().unwrap() - x * x).abs() < 1e-9, "{answer}");
    let (code, errors) = refused(&["compliance", "BT200L", "--joints-deg", "0,0,0"]);
    assert!(code == 2 && errors.contains("has 3 angles; expected six"), "{errors}");
    let output = program().args(["compliance", "BT200L", "--joints-deg", "0,1.57,0,0,0,0"]).output().unwrap();
    assert!(String::from_utf8_lossy(&output.stderr).contains("if these are radians"));
    let (_, errors) = refused(&["compliance", "BT200L", "--joints-deg", "0,0,0,0,0,0", "--tool-mm", "0,0,100000"]);
    assert!(errors.contains("lengths up to 10000 mm"), "{errors}");
}

#[test]
fn in_space_a_zone_has_a_place_a_posture_and_joint_angles_and_planar_questions_are_refused() {
    let answer =
        json(&["place", "KR 210 R2700 extra", "--task", "A:0.5", "--model", "spatial", "--tool-mm", "0,0,200"]);
    assert_eq!((&answer["model"], &answer["feasible"]), (&serde_json::json!("spatial"), &serde_json::json!(true)));
    // At the worst point, all six drives: the value is that of `compliance` at the joint angles that are reported.
    let joints: Vec<String> = answer["worst_joints_deg"]
        .as_array()
        .unwrap()
        .iter()
        .map(|angle| angle.as_f64().unwrap().to_string())
        .collect();
    let posture =
        json(&["compliance", "KR 210 R2700 extra", "--joints-deg", &joints.join(","), "--tool-mm", "0,0,200"]);
    let (found, alone) =
        (answer["deflection_mm"].as_f64().unwrap(), posture["principal_um_per_n"][2].as_f64().unwrap());
    assert!((found - alone).abs() <= 1e-9 * alone, "{found} mm under 1 kN, {alone} um/N");
    let (code, errors) = refused(&["place", "BT200L", "--task", "A:0.5", "--tool-direction", "forward"]);
    assert!(code == 2 && errors.contains("needs --model spatial"), "{errors}");
    let narrow = ["place", "BT200L", "--task", "rect:0.3x0.2", "--model", "spatial", "--within", "1..1.1,0.5.."];
    let narrow = json(&narrow);
    assert!(narrow["reason"].as_str().unwrap().contains("narrower or lower than the zone"), "{narrow}");
    let (_, errors) = refused(&["place", "BT200L", "--task", "A:0.5", "--model", "spatial", "--yaw-deg", "30"]);
    assert!(errors.contains("--yaw-deg turns nothing"), "{errors}");
}

#[test]
fn a_zone_below_the_base_is_pointed_out() {
    let placed = |options: &[&str]| json(&[&["place", "BT200L", "--task", "C:0.15"], options].concat());
    assert_eq!(placed(&["--floor", "none"])["below_base"], true);
    assert_eq!(placed(&["--floor", "-2"])["below_base"], true);
    assert_eq!(placed(&["--within", "..,0.."])["below_base"], false);
    assert_eq!(placed(&[])["below_base"], false);
    let ranked = |options: &[&str]| run(&[&["rank", "--robots", "BT200L", "--task", "C:0.15"], options].concat());
    assert!(ranked(&["--floor", "none"]).contains("zones partly below the base"));
    assert!(!ranked(&[]).contains("below the base"));
}

/// What is asked stands in the answer, and the place keeps it; where nothing is said, the ranking is the paper's.
#[test]
fn margins_are_asked_reported_and_kept() {
    let asked =
        ["--limit-margin-deg", "12", "--singular-margin-deg", "8", "--clear-of-base-m", "1.1", "--floor", "0.4"];
    let place = ["place", "KR 210 R2700 extra", "--task", "A:0.4", "--model", "spatial"];
    let kept = json(&[&place[..], &asked].concat());
    let number = |key: &str| kept[key].as_f64().unwrap_or_else(|| panic!("{key}: {kept}"));
    assert_eq!([number("asked_limit_margin_deg"), number("asked_singular_margin_deg")].map(f64::round), [12.0, 8.0]);
    assert_eq!([number("clear_of_base_m"), number("floor_m")], [1.1, 0.4]);
    assert!(12.0 - 1e-6 <= number("limit_margin_deg") && 8.0 - 1e-6 <= number("singular_margin_deg"), "{kept}");
    assert!(1.1 - 1e-6 <= number("from_axis_1_m") && 0.4 - 1e-6 <= number("z_m"), "{kept}");
    assert!(run(&["rank"]).contains("the paper's convention: no margins"));
    assert!(
        run(&["rank", "--task", "A:0.1"]).contains("kept: 5 deg from joint limits and from a straight wrist or arm")
    );
    for (option, value, expected) in [
        ("--limit-margin-deg", "95", "from 0 to 90"),
        ("--singular-margin-deg", "-1", "from 0 to 45"),
        ("--clear-of-base-m", "much", "expected a number"),
        ("--floor", "low", "or none"),
    ] {
        let (code, errors) = refused(&["place", "BT200L", "--task", "A:0.1", option, value]);
        assert!(code == 2 && errors.contains(option) && errors.contains(expected), "{errors}");
    }
}

/// A part has its faces in the answer, and what does not apply to it is refused.
#[test]
fn a_part_is_placed_with_its_faces() {
    let place = ["place", "KR 210 R2700 extra", "--task", "box:0.3x0.2x0.1"];
    let spindle = ["--model", "spatial", "--tool-mm", "250,0,100,0,90,0"];
    let placed = json(&[&place[..], &spindle, &["--faces", "top,front"]].concat());
    let faces = placed["faces"].as_array().unwrap();
    assert_eq!(faces.iter().map(|face| face["face"].as_str().unwrap()).collect::<Vec<_>>(), ["top", "front"]);
    let worst = faces.iter().map(|face| face["deflection_mm"].as_f64().unwrap()).fold(0.0, f64::max);
    assert_eq!(placed["deflection_mm"].as_f64(), Some(worst));
    let flat: &[&str] = &["place", "BT200L", "--task", "A:0.1"];
    for (arguments, expected) in [
        (place.to_vec(), "several faces, which needs --model spatial"),
        ([&place[..], &spindle, &["--faces", "under"]].concat(), "no face 'under'; this part has top, front"),
        ([&place[..], &spindle, &["--tool-direction", "down"]].concat(), "a part says itself how the tool meets"),
        ([flat, &["--model", "spatial", "--faces", "top"]].concat(), "a flat zone is one face"),
        (vec!["map", "BT200L", "--zone", "box:0.3x0.2x0.1"], "expected one flat zone"),
        (vec!["place", "BT200L", "--task", "box:0.3x0.2"], "expected box:AxBxC"),
    ] {
        let (_, errors) = refused(&arguments);
        assert!(errors.contains(expected), "{arguments:?}: {errors}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_is_written_through() {
    let folder = TempDir::new().unwrap();
    let (target, link) = (path(&folder, "target.csv"), path(&folder, "link.csv"));
    fs::write(&target, "old").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    run(&["robots", "list", "-o", &link]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(fs::read_to_string(&target).unwrap().starts_with("vendor,robot"));
}

#[test]
fn published_numbers_are_settled() {
    let ledger = json(&["validate"]);
    let rows = ledger["rows"].as_array().unwrap();
    assert!(rows.iter().all(|row| row["agrees"].as_bool().unwrap() == row["note"].is_null()));
    assert!(run(&["validate"]).contains(" 0 unsettled."));
}

#[cfg(unix)]
fn shell(script: &str, folder: &Path) -> std::process::Output {
    let program = assert_cmd::cargo::cargo_bin("stiffarm");
    Process::new("bash").args(["-c", script]).env("STIFFARM", program).current_dir(folder).output().expect("bash runs")
}

#[cfg(unix)]
#[test]
fn a_reader_that_has_seen_enough_is_no_failure() {
    let folder = TempDir::new().unwrap();
    let script = "\"$STIFFARM\" map BT200L --size 1500 --format csv | head -n 1; exit ${PIPESTATUS[0]}";
    let output = shell(script, folder.path());
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert!(output.status.success());
    assert_eq!(output.stdout, b"x_m,z_m,deflection_mm\n");
}

/// The reader has gone before anything is written: what was asked is no, all the same.
#[cfg(unix)]
#[test]
fn a_verdict_stands_also_where_its_reader_has_gone() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("good.toml"), SMALLEST).unwrap();
    for (asked, code) in [
        ("robots check good.toml", 0),
        ("robots check good.toml none.toml", 1),
        ("place BT200L --task A:0.1", 0),
        ("place BT200L --task A:0.1 --tolerance-mm 0.01 --check", 3),
        ("rank --task A:0.1 --tolerance-mm 0.01 --check", 3),
    ] {
        let script = format!("mkfifo p; (exec 3<p) & exec 4>p; wait; rm p; \"$STIFFARM\" {asked} >&4");
        let output = shell(&script, folder.path());
        assert_eq!(output.status.code(), Some(code), "{asked}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_write_leaves_the_old_file_and_no_half_one() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("map.csv"), "old").unwrap();
    // A file size limit of 8 KiB ends the program in the middle of writing.
    let output = shell("ulimit -f 8; \"$STIFFARM\" map BT200L --size 300 -o map.csv -o new.csv", folder.path());
    assert!(!output.status.success());
    assert_eq!(fs::read_to_string(folder.path().join("map.csv")).unwrap(), "old");
    assert!(!folder.path().join("new.csv").exists());
}

/// The JSON object that a page hands to plotly.js.
fn figure_on(page: &str) -> Value {
    let start = page.find("const figure = ").expect("a figure") + "const figure = ".len();
    let text = page[start..].lines().next().expect("a line");
    serde_json::from_str(text.trim_end_matches(';')).expect("JSON")
}

#[test]
fn answers_in_space_come_as_figures_pages_and_typed_columns() {
    let folder = TempDir::new().expect("a folder");
    let robot = ["KR 210 R2700 extra", "--model", "spatial", "--tool-mm", "0,0,200", "--quiet"];
    for (command, more) in [("map", &["--size", "60"][..]), ("place", &["--task", "rect:0.4x0.2"])] {
        let files =
            ["svg", "png", "view.html", "parquet", "csv", "json"].map(|ending| path(&folder, &format!("a.{ending}")));
        let outputs = files.iter().flat_map(|file| ["-o", file]);
        run(&[&[command], &robot[..], more].concat().into_iter().chain(outputs).collect::<Vec<_>>());
        let [svg, png, html, parquet, csv, json] = files.map(|file| fs::read(file).expect("written"));
        let svg = String::from_utf8(svg).expect("text");
        for text in ["x from the base [m]", "worst deflection under 1000 N [mm]", "KUKA KR 210 R2700 extra"] {
            assert!(svg.contains(text), "{command}: {text}");
        }
        assert_eq!(svg.contains("seen along the tool axis"), command == "place");
        assert!(png.starts_with(b"\x89PNG") && parquet.starts_with(b"PAR1") && parquet.ends_with(b"PAR1"));
        let answer: Value = serde_json::from_slice(&json).expect("JSON");
        assert!(String::from_utf8(csv).expect("text").lines().count() > 1);
        let figure = figure_on(&String::from_utf8(html).expect("text"));
        let traces = figure["data"].as_array().expect("traces");
        let surfaces: Vec<&Value> = traces.iter().filter(|trace| trace["type"] == "surface").collect();
        assert_eq!(surfaces.len(), if command == "place" { 2 } else { 1 });
        if command == "place" {
            // The largest value of the zone's own sheet is the answer, to the fineness of its grid and six digits.
            let cells = surfaces[1]["surfacecolor"].as_array().expect("rows");
            let values = cells.iter().flat_map(|row| row.as_array().expect("a row")).filter_map(Value::as_f64);
            let (largest, found) = (values.fold(0.0, f64::max), answer["deflection_mm"].as_f64().expect("a number"));
            assert!((largest / found - 1.0).abs() < 2e-3, "{largest} {found}");
            let tool = traces.iter().find(|trace| trace["name"] == "tool axis").expect("a tool");
            let at = ["x", "y", "z"].map(|axis| tool[axis][0].as_f64().expect("a number"));
            let (s, c) = answer["bearing_deg"].as_f64().expect("a number").to_radians().sin_cos();
            let worst = [0, 1, 2].map(|k| answer["worst_point_m"][k].as_f64().expect("a number"));
            let worst = [c * worst[0] - s * worst[1], s * worst[0] + c * worst[1], worst[2]];
            assert!(at.iter().zip(worst).all(|(a, b)| (a - b).abs() < 2e-5), "{at:?} {worst:?}");
        }
    }
    // A window of two ranges is drawn before a base that is raised, too.
    let zone = ["--task", "rect:0.4x0.2", "--within", "0.8..2,0.6..1.4"];
    for (name, mount) in [("floor", &[][..]), ("raised", &["--mount", "pedestal:0.3"])] {
        let window = path(&folder, &format!("{name}.svg"));
        run(&[&["place"], &robot[..], &zone, mount, &["-o", &window]].concat());
        assert!(fs::read_to_string(window).expect("written").contains("where the zone may stand"), "{name}");
    }
    let margin = path(&folder, "margin.svg");
    run(&[
        &["map"],
        &robot[..],
        &["--size", "60", "--layer", "limit-margin", "--posture", "front,up,flip", "-o", &margin],
    ]
    .concat());
    assert!(fs::read_to_string(margin).expect("written").contains("nearest joint limit [deg]"));
    assert!(refused(&["map", "BT200L", "--layer", "limit-margin"]).1.contains("needs --model spatial"));
    assert!(refused(&["map", "BT200L", "--model", "spatial", "--posture", "up"]).1.contains("front,up,no-flip"));
    let (code, errors) =
        refused(&["place", "TX40", "--task", "circle:3", "--model", "spatial", "-o", &path(&folder, "none.svg")]);
    assert!(code == 1 && errors.contains("no place"), "{errors}");
    assert!(!Path::new(&path(&folder, "none.svg")).exists());
}

#[test]
fn robots_that_are_named_alike_are_told_apart_by_their_files() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("first.toml"), SMALLEST).unwrap();
    fs::write(folder.path().join("same.toml"), SMALLEST).unwrap();
    fs::write(folder.path().join("second.toml"), SMALLEST.replace("l3_mm = 800", "l3_mm = 900")).unwrap();
    let robots = format!("{},BT200L", folder.path().display());
    let output = program().args(["rank", "--robots", &robots, "--task", "A:0.1"]).output().unwrap();
    let (text, notes) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    for file in ["first.toml", "second.toml"] {
        assert!(text.contains(&format!("{file})")), "{text}");
        let note = format!("{file}: one of 2 different robots named two links");
        assert!(notes.contains(&note), "{notes}");
    }
    assert!(!text.contains("same.toml"), "one robot in two files is one:\n{text}");
    let quiet = program().args(["rank", "--robots", &robots, "--task", "A:0.1", "-q"]).output().unwrap();
    assert!(quiet.stderr.is_empty());
}

#[test]
fn a_robot_with_a_compensator_is_a_row_that_says_why_and_alone_a_refusal_with_advice() {
    let text = include_str!("../../../docs/robot_file.md");
    let is_robot = |block: &&str| block.starts_with("name = ");
    let block = text.split("```toml\n").find(is_robot).unwrap().split("```").next().unwrap();
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "compensator.toml");
    fs::write(&file, block).unwrap();
    let both = ["rank", "--robots", "BT200L", "--robots", &file, "--task", "A:0.5"];
    let table = run(&both);
    assert!(table.lines().any(|line| line.starts_with(" n/a") && line.matches("n/a").count() == 3), "{table}");
    assert!(table.contains("n/a geared wrist and compensator: its gravity compensator"), "{table}");
    let rows = json(&both);
    let last = &rows["rows"][1];
    assert_eq!((&last["bound_mm"], &last["cells"][0]["feasible"]), (&Value::Null, &Value::Null));
    assert!(last["cells"][0]["reason"].as_str().unwrap().contains("gravity compensator"), "{last}");
    let csv = run(&[&both[..], &["--format", "csv"]].concat());
    let line = csv.lines().nth(2).unwrap();
    assert!(line.starts_with(",,,,,,geared wrist") && line.contains("gravity compensator"), "{csv}");
    for alone in [
        &["rank", "--robots", &file, "--task", "A:0.5"][..],
        &["place", &file, "--task", "A:0.5"],
        &["map", &file, "--size", "20"],
    ] {
        let (code, errors) = refused(alone);
        assert!(
            code == 1 && errors.contains("gravity compensator") && errors.contains("hint: --model spatial"),
            "{errors}"
        );
    }
    assert!(run(&["robots", "show", &file]).contains("n/a: its gravity compensator"));
    assert!(run(&["robots", "show", &file, "--format", "csv"]).contains("shoulder"));
    let spatial = run(&["rank", "--robots", &file, "--task", "A:0.1", "--model", "spatial"]);
    assert!(spatial.contains("n/a geared wrist and compensator"), "{spatial}");
}
