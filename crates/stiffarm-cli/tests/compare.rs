//! Two setups side by side: what is asked of each, what is reported of both, and what is drawn.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

/// Exit code, standard output and standard error.
fn ran(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let output = program.current_dir(folder).env("COLUMNS", "100").args(arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let (code, out, error) = ran(folder, &[arguments, &["--format", "json"]].concat());
    assert_eq!(code, 0, "{error}");
    serde_json::from_str(&out).unwrap()
}

fn without_schema(mut answer: Value) -> Value {
    answer.as_object_mut().unwrap().remove("schema");
    answer
}

#[test]
fn both_are_what_place_tells_of_each_and_their_ratio() {
    let folder = tempfile::tempdir().unwrap();
    let asked = ["--task", "B:0.3", "--tolerance-mm", "1.9"];
    let both = json(folder.path(), &[&["compare", "KR 210 R2700 extra", "BT200L"], &asked[..]].concat());
    for (key, robot) in [("a", "KR 210 R2700 extra"), ("b", "BT200L")] {
        let alone = json(folder.path(), &[&["place", robot], &asked[..]].concat());
        assert_eq!(both[key], without_schema(alone), "{robot}");
        assert!(both[key]["advice"]["force_factor"].as_f64().unwrap() != 1.0);
    }
    let value = |key: &str| both[key]["deflection_mm"].as_f64().unwrap();
    assert!((both["ratio"].as_f64().unwrap() - value("b") / value("a")).abs() < 1e-12);
    let bound = both["b"]["lower_bound_mm"].as_f64().unwrap();
    assert!(value("a") < bound, "the values are distinguished");
    assert_eq!((&both["told_apart"], &both["better"]), (&true.into(), &"a".into()));
    assert_eq!(both["differ_in"], serde_json::json!(["robot"]));
    let (_, table, _) = ran(folder.path(), &[&["compare", "KR 210 R2700 extra", "BT200L"], &asked[..]].concat());
    let line = |name: &str| table.lines().find(|line| line.trim_start().starts_with(name)).unwrap_or(name).to_owned();
    assert!(line("worst deflection [mm]").contains(&format!("{:.4}", value("a"))), "{table}");
    assert!(line("worst deflection [mm]").contains(&format!("{:.4}", value("b"))), "{table}");
    assert!(line("proved (nominal stiffness)").contains("better"), "{table}");
    // Of drives that are assumed nobody knows how they may be off; of these the intervals overlap, and the one who is ahead is no sure choice.
    assert_eq!(both["win_probability"], Value::Null);
    assert!(
        both["summary"][0]
            .as_str()
            .unwrap()
            .starts_with("At the nominal stiffness A (KUKA KR 210 R2700 extra) is better")
    );
    let scattered = [&["compare", "KR 210 R2700 extra", "BT200L", "--stiffness", "prior"], &asked[..]].concat();
    let scattered = json(folder.path(), &scattered);
    let shares = [0, 1].map(|side| scattered["win_probability"][side].as_f64().unwrap());
    assert!((shares[0] + shares[1] - 1.0).abs() < 1e-9 && (0.05..0.95).contains(&shares[0]), "{shares:?}");
    let sentence = scattered["summary"][0].as_str().unwrap();
    assert!(sentence.contains("they tie") && scattered["told_apart"] == true, "{sentence}");
    // The shares are those in which a ranking of the two has each win.
    let ranked = ["rank", "--robots", "KR 210 R2700 extra,BT200L", "--stiffness", "prior", "--task", "B:0.3"];
    for row in json(folder.path(), &[&ranked[..], &["--within", "0..,0.."]].concat())["rows"].as_array().unwrap() {
        let side = usize::from(row["robot"] == "BT200L");
        assert_eq!(row["win_probability"][0], shares[side], "{row}");
    }
    assert!(line("largest force").contains(" N"), "{table}");
    assert!(table.lines().all(|line| line.chars().count() <= 100), "{table}");
    let (_, csv, _) =
        ran(folder.path(), &[&["compare", "KR 210 R2700 extra", "BT200L", "--format", "csv"], &asked[..]].concat());
    let rows: Vec<&str> = csv.lines().collect();
    assert!(
        rows.len() == 3 && rows[0].starts_with("setup,robot") && rows[1].starts_with("a,") && rows[2].starts_with("b,")
    );
}

#[test]
fn a_robot_and_itself_cannot_be_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let both = json(folder.path(), &["compare", "BT200L", "BT200L", "--task", "A:0.3"]);
    assert_eq!((&both["told_apart"], &both["better"]), (&false.into(), &Value::Null));
    assert_eq!((&both["ratio"], &both["differ_in"]), (&1.0.into(), &serde_json::json!([])));
    assert!(both["summary"][0].as_str().unwrap().contains("cannot be distinguished"));
    assert_eq!(both["a"]["advice"], Value::Null, "no tolerance was given");
}

/// The same robot with two tools; what a job file says comes before what is asked of both.
#[test]
fn job_files_say_what_is_not_the_same_of_both() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("short.toml", "verb = 'place'\nrobot = 'BT200L'\ntool-mm = [0, 0, 150]\n");
    write("long.toml", "verb = 'place'\nrobot = 'BT200L'\ntool = 'spindle:300@90'\nforce-n = 500\n");
    let asked = ["--model", "spatial", "--task", "A:0.2", "--tool-mm", "0,0,99", "--force-n", "400"];
    let both = json(folder.path(), &[&["compare", "short.toml", "long.toml"], &asked[..]].concat());
    assert_eq!(both["a"]["tool_mm"], serde_json::json!([0.0, 0.0, 150.0, 0.0, 0.0, 0.0]));
    assert!((both["b"]["tool_mm"][0].as_f64().unwrap() - 300.0).abs() < 1e-9, "{}", both["b"]["tool_mm"]);
    assert_eq!((&both["a"]["force_n"], &both["b"]["force_n"]), (&400.0.into(), &500.0.into()));
    assert_eq!(both["differ_in"], serde_json::json!(["tool", "force"]));
    assert!(both["summary"].to_string().contains("They are asked different things"), "{}", both["summary"]);
    // The comparison itself is a job, with paths that count from its folder.
    let (code, _, error) =
        ran(folder.path(), &[&["compare", "short.toml", "long.toml", "--save-job", "both.toml"], &asked[..]].concat());
    assert_eq!(code, 0, "{error}");
    assert_eq!(json(Path::new("/"), &["compare", &folder.path().join("both.toml").to_string_lossy()]), both);
}

/// What differs is called by its name; who is estimated or not to be taken has no chance, and equal setups have equal ones.
#[test]
fn what_differs_is_named_and_chances_are_of_those_that_may_be_taken() {
    let folder = tempfile::tempdir().unwrap();
    let heavy = |name: &str, kg: u32| {
        let text = format!("verb = 'place'\nrobot = 'KR 210 R2700 extra'\ntool-mass-kg = {kg}\n");
        fs::write(folder.path().join(name), text).unwrap();
    };
    heavy("light.toml", 20);
    heavy("heavy.toml", 50);
    heavy("beyond.toml", 400);
    let asked = ["--task", "A:0.3", "--force-n", "200", "--stiffness", "prior"];
    let compared =
        |a: &str, b: &str, more: &[&str]| json(folder.path(), &[&["compare", a, b], &asked[..], more].concat());
    let both = compared("light.toml", "heavy.toml", &[]);
    assert_eq!(both["differ_in"], serde_json::json!(["tool mass"]));
    assert_eq!(both["win_probability"], serde_json::json!([0.5, 0.5]));
    assert_eq!(compared("light.toml", "beyond.toml", &[])["win_probability"], Value::Null);
    let estimated = compared("ZX200U", "BT200L", &[]);
    assert_eq!(estimated["win_probability"], Value::Null);
    assert!(estimated["summary"].to_string().contains("numbers of A (Kawasaki ZX200U) are estimated"), "{estimated}");
    fs::write(folder.path().join("normal.toml"), "verb = 'place'\nrobot = 'BT200L'\ncomponent = 'normal'\n").unwrap();
    let space = ["--model", "spatial", "--tool-mm", "0,0,200", "--at", "1.5,0.8"];
    let normal = compared("normal.toml", "BT200L", &space);
    assert_eq!(normal["differ_in"], serde_json::json!(["component"]));
    assert!(normal["summary"].to_string().contains("They are asked different things (component)"), "{normal}");
    let too_large = ["compare", "BT200L", "BT200L", "--task", "A:9"];
    let none = json(folder.path(), &too_large);
    assert!(none["ratio"] == Value::Null && !none["summary"].to_string().contains("the ratio compares"), "{none}");
}

#[test]
fn what_cannot_be_compared_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("rank.toml"), "verb = 'rank'\n").unwrap();
    fs::write(folder.path().join("odd.toml"), "verb = 'place'\nrobot = 'BT200L'\ntask = 'A:0.3'\nforce-n = -3\n")
        .unwrap();
    for (arguments, code, expected) in [
        (&["compare"][..], 2, "<A> is missing"),
        (&["compare", "BT200L"], 2, "'BT200L' is no job file; expected a name that ends in .toml, or two setups"),
        (&["compare", "BT200L", "BT200L"], 2, "--task"),
        (&["compare", "BT200L", "nobody", "--task", "A:0.3"], 1, "robot 'nobody' is not known"),
        (
            &["compare", "rank.toml", "BT200L", "--task", "A:0.3"],
            2,
            "rank.toml: a job for rank; compare takes jobs for place",
        ),
        (&["compare", "odd.toml", "BT200L", "--task", "A:0.3"], 2, "odd.toml:4: invalid value '-3' for 'force-n'"),
        (&["compare", "none.toml", "BT200L", "--task", "A:0.3"], 1, "none.toml"),
        (
            &["compare", "BT200L", "ZX200U", "--task", "A:0.3", "--tool-mm", "0,0,9"],
            2,
            "--tool-mm needs --model spatial",
        ),
        (&["compare", "BT200L", "ZX200U", "BT200L", "--task", "A:0.3"], 2, "unexpected"),
        (&["compare", "BT200L", "ZX200U", "--task", "A:0.3", "-o", "x.html"], 2, "compare cannot write x.html"),
        (&["compare", "odd.toml", "ZX200U", "--task", "A:0.3", "-o", "odd.toml"], 2, "odd.toml"),
    ] {
        let (found, out, error) = ran(folder.path(), arguments);
        assert!(found == code && error.contains(expected) && out.is_empty(), "{arguments:?}: {found} {error}");
    }
}

/// Two panels, each with the zone of its setup, and one colour bar and one legend for both.
#[test]
fn both_are_drawn_on_one_scale() {
    let folder = tempfile::tempdir().unwrap();
    let asked = ["compare", "KR 210 R2700 extra", "BT200L", "--task", "B:0.5", "--tolerance-mm", "2", "-q"];
    let (code, _, error) =
        ran(folder.path(), &[&asked[..], &["-o", "both.svg", "-o", "both.png", "-o", "both.pdf"]].concat());
    assert_eq!(code, 0, "{error}");
    let svg = fs::read_to_string(folder.path().join("both.svg")).unwrap();
    let count = |text: &str| svg.matches(text).count();
    for (text, times) in [
        ("A: KUKA KR 210 R2700 extra", 1),
        ("B: Kawasaki BT200L", 1),
        ("x from the base [m]", 2),
        ("worst deflection under 1000 N [mm]", 1),
        (">the zone at its best place<", 1),
        (">worst point of the zone<", 1),
        (">tolerance 2 mm<", 1),
        (">stiff<", 1),
        ("at worst; fail", 2),
    ] {
        assert_eq!(count(text), times, "{text}");
    }
    // A scale that is asked for holds for both.
    let (_, _, error) = ran(folder.path(), &[&asked[..], &["--scale", "0..4", "-o", "scaled.svg"]].concat());
    let scaled = fs::read_to_string(folder.path().join("scaled.svg")).unwrap_or(error);
    assert!(scaled.contains(">4.0<") && !scaled.contains(">5.0<"), "a bar that ends at 4");
    let part = ["compare", "BT200L", "ZX200U", "--model", "spatial", "--task", "box:0.2x0.2x0.1", "--faces", "top"];
    let (code, out, error) = ran(folder.path(), &[&part[..], &["-o", "part.svg"]].concat());
    assert!(code == 2 && error.contains("the map shows one flat zone"), "{code} {error}");
    assert!(out.contains("worst deflection"), "what cannot be drawn is printed: {out}");
}
