//! Can a user find, choose, look at and check robots?

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// Standard output and standard error of a run, and whether it succeeded.
fn outcome(arguments: &[&str]) -> (String, String, bool) {
    let output = Command::cargo_bin("stiffarm").expect("built by cargo").args(arguments).output().expect("runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (text(output.stdout), text(output.stderr), output.status.success())
}

fn run(arguments: &[&str]) -> String {
    let (printed, errors, succeeded) = outcome(arguments);
    assert!(succeeded, "{arguments:?}: {errors}");
    printed
}

fn refused(arguments: &[&str]) -> String {
    let (_, errors, succeeded) = outcome(arguments);
    assert!(!succeeded && !errors.contains("panicked"), "{arguments:?}: {errors}");
    errors
}

fn json(arguments: &[&str]) -> Vec<Value> {
    serde_json::from_str(&run(&[arguments, &["--format", "json"]].concat())).expect("a list in JSON")
}

fn names(arguments: &[&str]) -> Vec<String> {
    json(arguments).iter().map(|robot| robot["robot"].as_str().unwrap().into()).collect()
}

#[test]
fn the_list_ends_with_a_count_and_explains_its_marks() {
    let text = run(&["robots", "list"]);
    let listed = names(&["robots", "list"]).len();
    assert!(220 < listed);
    assert!(
        text.contains(&format!("\n{listed} robots of 10 makers\n")),
        "{}",
        text.lines().rev().take(6).collect::<String>()
    );
    assert_eq!(text, run(&["robots"]));
    assert!(text.contains("serial?: no parallelogram is reported"));
    let known = run(&["robots", "list", "kuka", "210", "R2700 extra"]);
    assert!(known.contains("\n1 robot of 1 maker\n") && !known.contains("serial?"), "{known}");
}

#[test]
fn every_filter_of_the_list_holds_for_every_robot_it_leaves() {
    let filters = [
        "--vendor",
        "abb,KUKA",
        "--payload-kg",
        "100..250",
        "--reach-m",
        "..3",
        "--architecture",
        "serial",
        "--status",
        "data-sheet",
    ];
    let found = json(&[&["robots", "list"], &filters[..]].concat());
    assert!(5 < found.len(), "{}", found.len());
    for robot in &found {
        let number = |key: &str| robot[key].as_f64().unwrap();
        assert!(["ABB", "KUKA"].contains(&robot["vendor"].as_str().unwrap()), "{robot}");
        assert!((100.0..=250.0).contains(&number("payload_kg")) && number("reach_m") <= 3.0, "{robot}");
        assert!(robot["architecture"] == "serial" && robot["status"] == "data-sheet", "{robot}");
    }
    let all = json(&["robots", "list"]);
    let by_hand = all.iter().filter(|robot| {
        let number = |key: &str| robot[key].as_f64().unwrap_or(f64::NAN);
        (robot["vendor"] == "ABB" || robot["vendor"] == "KUKA")
            && 100.0 <= number("payload_kg")
            && number("payload_kg") <= 250.0
            && number("reach_m") <= 3.0
            && robot["architecture"] == "serial"
            && robot["status"] == "data-sheet"
    });
    assert_eq!(by_hand.count(), found.len());
    assert_eq!(names(&["robots", "list", "irb 8700"]), ["IRB 8700-550/4.2 SW6", "IRB 8700-800/3.5"]);
}

#[test]
fn a_ranking_takes_sets_patterns_and_filters() {
    let rows = |arguments: &[&str]| -> Vec<Value> {
        let ranking: Value =
            serde_json::from_str(&run(&[arguments, &["--task", "A:0.3", "--format", "json"]].concat())).unwrap();
        ranking["rows"].as_array().unwrap().clone()
    };
    let heavy = rows(&["rank", "--robots", "all", "--payload-kg", "100..", "--reach-m", "2.5..", "--vendor", "fanuc"]);
    let listed = names(&["robots", "list", "--payload-kg", "100..", "--reach-m", "2.5..", "--vendor", "fanuc"]);
    assert!(10 < heavy.len());
    assert_eq!(heavy.len(), listed.len());
    assert!(heavy.iter().all(|row| listed.iter().any(|name| row["robot"] == **name)));
    assert_eq!(rows(&["rank", "--robots", "R-2000iC/165?,IRB 8700*", "--architecture", "quasi-serial"]).len(), 2);
    assert_eq!(rows(&["rank", "--robots", "paper", "--vendor", "ABB"]).len(), 2);
    assert_eq!(rows(&["rank", "--robots", "paper,BT200L,kawasaki bt*"]).len(), 10, "each robot once");
}

#[test]
fn a_ranking_says_when_the_force_is_more_than_robots_are_sold_for() {
    let light = run(&["rank", "--robots", "KR 6 R900 sixx,BT200L", "--task", "A:0.1"]);
    assert!(light.contains("1 of 2 robots are sold for less than this force (102 kg)"), "{light}");
    assert!(
        !run(&["rank", "--robots", "KR 6 R900 sixx", "--task", "A:0.1", "--force-n", "50"]).contains("sold for less")
    );
}

#[test]
fn a_figure_of_many_robots_draws_the_first_of_them_and_says_so() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("heavy.svg");
    let file = file.to_str().unwrap();
    run(&["rank", "--robots", "all", "--payload-kg", "200..", "--task", "A:0.3", "-q", "-o", file]);
    let ranked = names(&["robots", "list", "--payload-kg", "200.."]).len();
    let drawn = fs::read_to_string(file).unwrap();
    assert!(24 < ranked && drawn.contains(&format!("; the first 24 of {ranked} robots")), "{ranked}");
    run(&["rank", "--task", "A:0.3", "-q", "-o", file]);
    assert!(!fs::read_to_string(file).unwrap().contains("the first"));
}

#[test]
fn filters_that_leave_nothing_say_what_would_match() {
    let cases: &[(&[&str], &str)] = &[
        (
            &["robots", "list", "--vendor", "KUKA", "--payload-kg", "5000.."],
            "without --payload-kg 5000.. 70 would match",
        ),
        (&["robots", "list", "--vendor", "nobody"], "there are robots of ABB, Adept, Comau"),
        (&["robots", "list", "zzz"], "none of 304 robots matches 'zzz'"),
        (&["rank", "--robots", "paper", "--payload-kg", "..5"], "--robots all takes every robot"),
    ];
    for (arguments, expected) in cases {
        let errors = refused(arguments);
        let listed = names(&["robots", "list"]).len();
        let kuka = names(&["robots", "list", "--vendor", "KUKA"]).len();
        let expected = expected.replace("304", &listed.to_string()).replace(" 70 ", &format!(" {kuka} "));
        assert!(errors.contains(&expected), "{arguments:?}: {errors}");
    }
    for (arguments, expected) in [
        (["--payload-kg", "2..1"], "the lower end first"),
        (["--status", "guessed"], "expected identified, data-sheet, derived or estimated"),
        (["--architecture", "parallel"], "expected serial or quasi-serial"),
    ] {
        assert!(refused(&[&["robots", "list"], &arguments[..]].concat()).contains(expected));
    }
    assert!(refused(&["place", "IRB 6640", "--task", "A:0.1"]).contains("did you mean IRB 6640-"));
}

#[test]
fn a_robot_is_shown_with_all_that_its_file_says() {
    let text = run(&["robots", "show", "IRB 2400-10/1.55"]);
    for expected in [
        "quasi-serial",
        "estimated",
        "a2 -135",
        "joint 3 as reported      -60.0 to 65.0 deg, 150 deg/s (absolute angle of the forearm)",
        "angle between the links  20.0 to 160.0 deg",
        "source: elbow_deg",
        "stiffest posture",
    ] {
        assert!(text.contains(expected), "{expected}:\n{text}");
    }
    let text = run(&["robots", "show", "R-2000iC/165F"]);
    for expected in ["serial?: no parallelogram is reported", "mass ", "repeatability", " + + - - - -"] {
        assert!(text.contains(expected), "{expected}:\n{text}");
    }
    let sheet: Value = serde_json::from_str(&run(&["robots", "show", "R-2000iC/165F", "--format", "json"])).unwrap();
    assert_eq!(sheet["geometry"]["c3_mm"], 1280.0);
    assert_eq!(sheet["limits"]["joint_deg"][2], serde_json::json!([-132.0, 180.0]));
    assert_eq!(sheet["architecture_assumed"], true);
}

#[test]
fn a_picture_shows_what_is_reached() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (svg, png) = (path("reach.svg"), path("reach.png"));
    let text = run(&["robots", "show", "R-2000iC/165F", "-o", &svg, "-o", &png]);
    assert!(!text.contains('<'), "the text holds no picture");
    let drawn = fs::read_to_string(&svg).unwrap();
    for expected in [
        "Fanuc R-2000iC/165F",
        "description",
        "reached with the elbow up",
        "reached with the elbow down",
        "x from the base [m]",
    ] {
        assert!(drawn.contains(expected), "{expected}");
    }
    assert_eq!(&fs::read(png).unwrap()[1..4], b"PNG");
    assert!(!fs::read_to_string(draw("IRB 2400-10/1.55", &path("one.svg"))).unwrap().contains("elbow down"));
    let planar = path("planar.toml");
    fs::write(
        &planar,
        "name = \"p\"\narchitecture = \"serial\"\nstatus = \"derived\"\n[planar]\nl2_mm = 900\nl3_mm = 800\n",
    )
    .unwrap();
    assert!(fs::read_to_string(draw(&planar, &path("planar.svg"))).unwrap().contains("x from the joint-2 axis [m]"));
}

/// Draws what a robot reaches; the file's name.
fn draw<'a>(robot: &str, file: &'a str) -> &'a str {
    run(&["robots", "show", robot, "-q", "-o", file]);
    file
}

#[test]
fn a_check_warns_of_what_is_no_fault_and_faults_every_new_key() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("robot.toml");
    let file = file.to_str().unwrap();
    let good = run(&["robots", "show", "KR 210 R2700 extra", "--format", "json"]);
    assert!(good.contains("2.696"));
    let text = concat!(
        "name = \"r\"\narchitecture = \"serial\"\nstatus = \"derived\"\nreach_m = 2.0\n\n[geometry]\na1_mm = 350\na2_mm = 41\n",
        "b_mm = 0\nc1_mm = 675\nc2_mm = 1150\nc3_mm = 1200\nc4_mm = 215\noffset_deg = [0, -90, 0, 0, 0, 0]\n",
        "sign = [-1, 1, 1, -1, 1, -1]\n\n[limits]\n",
        "joint_deg = [[-185, 185], [-140, -5], [-120, 155], [-350, 350], [-125, 125], [-350, 350]]\n"
    );
    fs::write(file, text).unwrap();
    let (printed, warnings, succeeded) = outcome(&["robots", "check", file]);
    assert!(succeeded && printed.contains("r can be used"), "a warning is no error");
    assert!(
        warnings.contains("reach_m is 2 m, but within the limits the wrist centre comes 2.696 m ahead"),
        "{warnings}"
    );
    assert!(warnings.contains("payload_kg is missing"), "{warnings}");
    fs::write(file, text.replace("reach_m = 2.0", "reach_m = 2.7\npayload_kg = 210")).unwrap();
    assert_eq!(outcome(&["robots", "check", file]).1, "");
    let bad = text.replace("reach_m = 2.0", "mass_kg = -5\nrepeatability_mm = 60\narchitecture_assumed = \"yes\"")
        + "speed_deg_per_s = [100, 100, 100]\n";
    fs::write(file, bad).unwrap();
    let errors = refused(&["robots", "check", file]);
    for key in [":4: mass_kg", ":5: repeatability_mm", ":6: architecture_assumed", ":21: limits.speed_deg_per_s"] {
        assert!(errors.contains(key), "{key}:\n{errors}");
    }
}

#[test]
fn every_file_of_the_catalogue_passes_the_check() {
    let robots = concat!(env!("CARGO_MANIFEST_DIR"), "/../stiffarm/robots");
    let folders: Vec<String> = fs::read_dir(robots)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .map(|path| path.to_str().unwrap().into())
        .collect();
    let arguments: Vec<&str> = ["robots", "check"].into_iter().chain(folders.iter().map(String::as_str)).collect();
    assert_eq!(run(&arguments).lines().count(), names(&["robots", "list"]).len());
}
