//! Are robots ranked on a toolpath as each of them mills it alone, and is the path a task of `rank` and `place`?

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// A short line in a small window: few places are searched.
const ASKED: [&str; 8] =
    ["--force-n", "300,-120,80", "--tool", "spindle:250@90", "--within", "1.6..1.8,0.7..0.9", "--step-mm", "25"];

fn stiffarm(words: &[&str]) -> Output {
    Command::cargo_bin("stiffarm").unwrap().current_dir(Path::new(ROOT)).args(words).args(ASKED).output().unwrap()
}

fn json(words: &[&str]) -> Value {
    let output = stiffarm(&[words, &["--format", "json"]].concat());
    assert!(output.status.success(), "{words:?}: {output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn refused(words: &[&str]) -> String {
    let output = stiffarm(words);
    assert_eq!(output.status.code(), Some(2), "{words:?}: {output:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn every_robot_of_a_ranking_mills_as_it_does_alone_and_the_best_is_first() {
    let robots = ["KR 210 R2700 extra", "IRB 6650S-200", "BT200L"];
    let ranked = json(&["rank", "--task", "line:0.05", "--robots", &robots.join(","), "--tolerance-mm", "0.5"]);
    let rows = ranked["rows"].as_array().unwrap();
    assert_eq!(rows.len(), robots.len());
    let mut last = 0.0;
    for row in rows {
        let alone = json(&["place", row["robot"].as_str().unwrap(), "--task", "line:0.05", "--tolerance-mm", "0.5"]);
        for key in ["worst_mm", "worst_mm_p05", "worst_mm_p95", "lower_bound_mm", "rms_mm", "at_m", "feasible", "pass"]
        {
            assert_eq!(row[key], alone[key], "{}: {key}", row["robot"]);
        }
        let Some(worst) = row["worst_mm"].as_f64() else { continue };
        assert!(last <= worst, "{rows:?}");
        last = worst;
        // By hand: one more than those whose error lies below its bound.
        let bound = row["lower_bound_mm"].as_f64().unwrap();
        let better = rows.iter().filter(|other| other["worst_mm"].as_f64().is_some_and(|other| other < bound));
        assert_eq!(row["rank"], 1 + better.count());
    }
    assert!(0.0 < last);
    let wins = rows.iter().filter_map(|row| row["win_probability"][0].as_f64());
    assert!((wins.sum::<f64>() - 1.0).abs() < 1e-9, "{rows:?}");
}

/// By hand: 400 kg on robots that are sold for 210 and 200 kg.
#[test]
fn a_robot_that_may_not_carry_the_tool_is_not_advised() {
    let asked = ["rank", "--task", "line:0.05", "--robots", "KR 210 R2700 extra,BT200L", "--tolerance-mm", "2"];
    let light = json(&asked);
    assert_eq!(light["rows"][0]["overloaded"], false);
    let heavy = [&asked[..], &["--tool-mass-kg", "400"]].concat();
    let ranked = json(&heavy);
    for row in ranked["rows"].as_array().unwrap() {
        assert_eq!((&row["overloaded"], &row["tool_mass_kg"]), (&true.into(), &400.0.into()), "{row}");
    }
    let summary = ranked["summary"].to_string();
    assert!(
        summary.contains("No robot") && summary.contains("may not carry this: payload 210 kg: EXCEEDED"),
        "{summary}"
    );
    assert!(!summary.contains("is held by"), "{summary}");
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("report.html");
    let table = String::from_utf8(stiffarm(&[&heavy[..], &["-o", report.to_str().unwrap()]].concat()).stdout).unwrap();
    let page = std::fs::read_to_string(&report).unwrap();
    assert!(page.contains("<strong class=\"word\">load exceeded</strong>"));
    assert!(table.contains("LOAD EXCEEDED") && !table.contains(" pass"), "{table}");
    assert_eq!(stiffarm(&[&heavy[..], &["--check"]].concat()).status.code(), Some(3));
    assert_eq!(stiffarm(&[&asked[..], &["--check"]].concat()).status.code(), Some(0));
    // By hand: 170 kg and 332.9 N, which weigh as much as 33.9 kg, are more than 200 kg and less than 210.
    let some = json(&[&asked[..], &["--tool-mass-kg", "170"]].concat());
    for row in some["rows"].as_array().unwrap() {
        assert_eq!(row["overloaded"], row["robot"] == "BT200L", "{row}");
    }
    let summary = some["summary"].to_string();
    assert!(summary.contains("is that of KUKA KR 210 R2700 extra") && summary.contains("BT200L may not carry this"));
    assert!(!summary.contains("held by BT200L"), "{summary}");
}

/// A path of 50 mm in windows of 40 mm and 10 m, and among what is kept free.
#[test]
fn why_a_path_stands_nowhere_is_named() {
    let of = |more: &[&str]| {
        let asked = ["mill", "line:0.05", "--robot", "KR 210 R2700 extra", "--force-n", "300", "--format", "json"];
        let output = Command::cargo_bin("stiffarm").unwrap().args(asked).args(more).output().unwrap();
        let answer: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        answer["reason"].as_str().unwrap_or_default().to_owned()
    };
    let small = of(&["--within", "1.6..1.62,-0.02..0.02,0.8..0.9"]);
    assert!(small.contains("larger than what is allowed for it, 50.0 mm long and 0.0 mm wide"), "{small}");
    let far = of(&["--within", "9..19,0.8..0.9"]);
    assert!(far.contains("the window, the margins or the reach"), "{far}");
    let full = of(&["--within", "1.2..1.8,-0.5..0.5,0.5..1", "--keep-out", "1..2,-1..1,0..1.5"]);
    assert!(full.contains("the keep-outs, the margins"), "{full}");
}

#[test]
fn a_table_names_every_robot_and_says_what_the_order_rests_on() {
    let output = stiffarm(&["mill", "line:0.05", "--robots", "KR 210 R2700 extra,BT200L"]);
    let table = String::from_utf8(output.stdout).unwrap();
    for words in ["KUKA KR 210 R2700 extra", "BT200L", "at least", "draws of the drives", "is that of", "as published"]
    {
        assert!(table.contains(words), "{words}: {table}");
    }
}

#[test]
fn what_does_not_go_with_a_path_is_refused_with_the_option() {
    for (words, expected) in [
        (&["rank", "--task", "line:0.05,circle:0.3"][..], "--task has a toolpath beside other tasks"),
        (&["rank", "--task", "line:0.05", "--model", "planar"], "--model does not go with a toolpath"),
        (
            &["rank", "--task", "line:0.05", "--tool-direction", "forward"],
            "--tool-direction is asked of zones and parts; it does not go with a toolpath",
        ),
        (&["rank", "--task", "line:0.05", "--angle", "free"], "--angle"),
        (&["mill", "line:0.05", "--robots", "paper", "--robot", "BT200L"], "exclude each other"),
        (&["mill", "line:0.05", "--robot", "BT200L", "--vendor", "KUKA"], "exclude each other"),
        (&["mill", "line:0.05", "--robots", "paper", "--compensate"], "exclude each other"),
    ] {
        let why = refused(words);
        assert!(why.contains(expected), "{words:?}: {why}");
    }
}

/// The verdict, every robot with its own part, and the words that ask the same again; in both forms.
#[test]
fn a_ranking_on_a_path_is_handed_on_as_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let [html, pdf] = ["report.html", "report.pdf"].map(|name| folder.path().join(name).display().to_string());
    let robots = "KR 210 R2700 extra,IRB 6650S-200,BT200L";
    let words = ["rank", "--task", "line:0.05", "--robots", robots, "--tolerance-mm", "0.3", "-o", &html, "-o", &pdf];
    let output = stiffarm(&words);
    assert!(output.status.success(), "{output:?}");
    let page = scraper::Html::parse_document(&std::fs::read_to_string(&html).unwrap());
    let text = |what: &str| -> Vec<String> {
        let selector = scraper::Selector::parse(what).unwrap();
        page.select(&selector).map(|one| one.text().collect::<String>()).collect()
    };
    // Their stiffness overlaps, whichever has the least error.
    assert_eq!(text(".verdict .word"), ["tie"]);
    for robot in robots.split(',') {
        assert!(text("h2").iter().any(|title| title.contains(robot)), "{robot}: {:?}", text("h2"));
    }
    assert!(
        text("code, pre").iter().any(|code| code.contains("stiffarm mill line:0.05 --robots")),
        "{:?}",
        text("pre")
    );
    // The value of the best, as its sentence has it, stands in the table, too.
    let printed = String::from_utf8(output.stdout).unwrap();
    let value = printed.split(" is that of ").nth(1).and_then(|rest| rest.split(": ").nth(1)).unwrap();
    let value = value.split(" mm").next().unwrap();
    assert!(text("td").iter().any(|cell| cell.contains(value)), "{value}");
    assert!(3 < lopdf::Document::load(&pdf).unwrap().get_pages().len());
}

/// What a manager reads first: which word, for one robot that nobody rivals.
#[test]
fn the_verdict_is_that_of_the_best_robot() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("report.html").display().to_string();
    for (tolerance, expected) in [(None, "advised"), (Some("9"), "pass"), (Some("0.01"), "fail")] {
        let mut words = vec!["mill", "line:0.05", "--robots", "KR 210 R2700 extra", "-o", &html];
        words.extend(tolerance.iter().flat_map(|mm| ["--tolerance-mm", mm]));
        assert!(stiffarm(&words).status.success());
        let page = scraper::Html::parse_document(&std::fs::read_to_string(&html).unwrap());
        let selector = scraper::Selector::parse(".verdict .word").unwrap();
        let word: String = page.select(&selector).flat_map(|one| one.text()).collect();
        assert_eq!(word, expected, "{tolerance:?}");
    }
}

/// Of a clearance that no arm keeps from itself: what is touched is named, and nobody wins.
#[test]
fn a_robot_that_touches_something_has_no_rank_and_says_what() {
    let robots = "KR 210 R2700 extra,IRB 6650S-200";
    let words = ["mill", "line:0.05", "--robots", robots, "--clearance-mm", "3000", "--tolerance-mm", "9"];
    let ranked = json(&words);
    for row in ranked["rows"].as_array().unwrap() {
        assert_eq!(
            (&row["feasible"], &row["rank"], &row["pass"]),
            (&false.into(), &Value::Null, &Value::Null),
            "{row}"
        );
        assert!(row["reason"].as_str().unwrap().starts_with("TOO NEAR of "), "{row}");
    }
    let printed = String::from_utf8(stiffarm(&words).stdout).unwrap();
    assert!(
        printed.contains("follows line:0.05 and keeps clear") && printed.contains("mm apart, 3000.0 mm asked"),
        "{printed}"
    );
    assert!(!printed.contains("is that of") && !printed.contains("is held by"), "{printed}");
    // With nothing asked both are ranked.
    let usual = json(&[&words[..4], &["--tolerance-mm", "9"]].concat());
    assert!(usual["rows"].as_array().unwrap().iter().all(|row| row["feasible"] == true && row["pass"] == true));
}
