//! Does the program keep the habits that scripts and terminals rely on: exit codes, widths, colours, completions, what help says?

use assert_cmd::Command;
use tempfile::TempDir;

struct Ran {
    code: i32,
    out: String,
    err: String,
}

fn ran(variables: &[(&str, &str)], arguments: &[&str]) -> Ran {
    let mut program = Command::cargo_bin("stiffarm").expect("built");
    for name in ["COLUMNS", "NO_COLOR", "CLICOLOR_FORCE"] {
        program.env_remove(name);
    }
    let output = program.envs(variables.iter().copied()).args(arguments).output().expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    let code = output.status.code().expect("an exit code");
    Ran { code, out: text(output.stdout), err: text(output.stderr) }
}

/// A place that must not be chosen is no answer to start a job on, whatever its deflection is.
#[test]
fn check_refuses_an_arm_that_collides_or_carries_too_much() {
    let check = |question: &[&str], code: i32, why: &str| {
        let Ran { code: found, err, .. } = ran(&[], &[question, &["--tolerance-mm", "5", "--check"]].concat());
        assert!(found == code && err.contains(why), "{question:?}: {found}, {err}");
    };
    let space = ["--model", "spatial", "--task", "rect:0.6x0.4", "--tool-mm", "0,0,200"];
    check(&[&["place", "M-900iA/200P"], &space[..]].concat(), 3, "COLLISION, forearm (estimated radius) to column");
    // 1000 N weigh as much as 102 kg: 202 kg are held by a robot for 210 kg, and 252 are not.
    let weighs = |kg| ["--task", "A:0.3", "--tool-mass-kg", kg];
    check(&[&["place", "KR 210 R2700 extra"], &weighs("100")[..]].concat(), 0, "");
    check(&[&["place", "KR 210 R2700 extra"], &weighs("150")[..]].concat(), 3, "payload 210 kg: EXCEEDED");
    check(&[&["rank", "--robots", "KR 210 R2700 extra"], &weighs("150")[..]].concat(), 3, "carries tool and force");
    check(&[&["rank", "--robots", "KR 210 R2700 extra,KR 300 R2700-2"], &weighs("150")[..]].concat(), 0, "");
}

/// What is not known of any robot is a question that makes no sense, whatever robot is asked.
#[test]
fn a_part_in_a_cell_is_wrong_usage_and_says_what_to_do() {
    let part = ["--model", "spatial", "--task", "box:0.3x0.2x0.1", "--faces", "top,front", "--tool", "spindle:250@90"];
    for robots in [&["place", "BT200L"][..], &["rank", "--robots", "BT200L"]] {
        let Ran { code, err, .. } = ran(&[], &[robots, &part, &["--keep-out", "2..3,-3..3,0..1"]].concat());
        assert!(
            code == 2 && err.contains("known of one flat zone") && err.contains("one face at a time"),
            "{code} {err}"
        );
    }
}

/// Headline and exit code judge the same error: of a path that is compensated what is left, and where nobody knows that what is there without.
#[test]
fn a_compensated_path_is_judged_by_what_is_left() {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("mill.csv");
    let arm = ["mill", "line:0.1", "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--at", "1.6,0,0.8,0"];
    let asked = ["--force-n", "300,-120,80", "--tolerance-mm", "0.3", "--drive-urad-per-nm", "1", "--check", "-o"];
    let mill = [&arm[..], &asked, &[file.to_str().expect("a plain path")]].concat();
    let Ran { code, err, .. } = ran(&[], &mill);
    assert!(code == 3 && err.starts_with("fail: "), "{err}");
    let Ran { code, err, .. } = ran(&[], &[&mill[..], &["--compensate"]].concat());
    assert!(code == 3 && err.starts_with("fail: ") && err.contains("what it leaves is not known"), "{err}");
    let known = ["--compensate", "--stiffness-uncertainty", "0.1"];
    let Ran { code, err, .. } = ran(&[], &[&mill[..], &known].concat());
    assert!(code == 0 && err.starts_with("pass: ") && err.contains("without compensation"), "{err}");
}

/// What is written for machines hides nothing from whoever waits for it.
#[test]
fn a_data_file_alone_comes_with_the_answer_in_a_word() {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("place.csv");
    let file = file.to_str().expect("a plain path");
    let place = ["place", "BT200L", "--task", "A:0.3", "--tolerance-mm", "0.01", "-o", file];
    let Ran { code, out, err } = ran(&[], &place);
    assert!(code == 0 && out.is_empty(), "{out}");
    assert!(err.contains("fail: Kawasaki BT200L does not hold 0.01 mm") && err.contains("wrote "), "{err}");
    let Ran { err, .. } = ran(&[], &[&place[..], &["--quiet"]].concat());
    assert!(err.is_empty(), "{err}");
}

/// 0 answer, 1 failure, 2 usage, 3 tolerance not held or no place: as help and the reference say.
#[test]
fn exit_codes_are_as_help_says() {
    let cases: &[(&[&str], i32)] = &[
        (&["place", "BT200L", "--task", "A:0.1"], 0),
        (&["place", "BT200L", "--task", "A:0.1", "--tolerance-mm", "1", "--force-n", "100", "--check"], 0),
        (&["place", "BT200L", "--task", "A:0.1", "--tolerance-mm", "0.01"], 0),
        (&["place", "BT200L", "--task", "A:0.1", "--tolerance-mm", "0.01", "--check"], 3),
        (&["place", "IRB 6400 2.4-200", "--task", "C:0.3"], 0),
        (&["place", "IRB 6400 2.4-200", "--task", "C:0.3", "--check"], 3),
        (&["rank", "--task", "A:0.1", "--tolerance-mm", "2", "--check"], 0),
        (&["rank", "--task", "A:0.1", "--tolerance-mm", "0.1", "--check"], 3),
        // Only the estimated ones hold that, and they cannot win.
        (
            &[
                "rank",
                "--robots",
                "paper",
                "--status",
                "estimated",
                "--task",
                "A:0.1",
                "--tolerance-mm",
                "5",
                "--check",
            ],
            3,
        ),
        (&["place", "nobody", "--task", "A:0.1", "--check"], 1),
        (&["place", "BT200L", "--check"], 2),
        (&["map", "BT200L", "--check"], 2),
        (&["mill", "line:0.1", "--dry", "--check"], 2),
    ];
    for (arguments, code) in cases {
        let ran = ran(&[], arguments);
        assert_eq!(ran.code, *code, "{arguments:?}: {}", ran.err);
        // With 3, the answer is printed all the same.
        assert!(*code == 1 || *code == 2 || !ran.out.is_empty(), "{arguments:?}");
    }
    let help = ran(&[], &["--help"]).out;
    for line in ["0  the answer is given", "1  no answer", "2  wrong usage", "3  with --check"] {
        assert!(help.contains(line), "{help}");
    }
    let page = include_str!("../../../docs/guide/reference/scripts.md");
    assert!((0..=3).all(|code| page.contains(&format!("\n| {code} |"))), "the reference has every exit code");
}

#[test]
fn a_job_may_ask_to_be_checked() {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("job.toml");
    let job = file.to_str().expect("a plain path");
    let asked = ["place", "BT200L", "--task", "A:0.1", "--tolerance-mm", "0.01", "--check", "--save-job", job, "-q"];
    assert_eq!(ran(&[], &asked).code, 3);
    assert_eq!(ran(&[], &["place", job]).code, 3);
    let text = std::fs::read_to_string(&file).expect("written").replace("\"place\"", "\"map\"");
    std::fs::write(&file, text.replace("task", "zone").replace("tolerance-mm = 0.01\n", "")).expect("written");
    let refused = ran(&[], &["map", job]);
    assert!(refused.code == 2 && refused.err.contains("check does not go with map"), "{}", refused.err);
}

#[test]
fn tables_fit_the_width_that_is_asked_for_and_pipes_get_whole_lines() {
    let commands: &[&[&str]] = &[
        &["rank"],
        &["rank", "--task", "A:0.1,B:0.5,C:0.15", "--tolerance-mm", "2"],
        &["place", "IRB 6400 2.4-200", "--task", "C:0.3"],
        &["map", "BT200L", "--size", "50"],
        &["study", "--tasks", "A"],
        &["robots", "list", "kuka", "--payload-kg", "200..300"],
        &["robots", "show", "KR 210 R2700 extra"],
    ];
    for arguments in commands {
        for width in ["80", "100"] {
            let shown = ran(&[("COLUMNS", width)], arguments).out;
            let longest = shown.lines().max_by_key(|line| line.chars().count()).expect("lines");
            assert!(longest.chars().count() <= width.parse().expect("a number"), "{arguments:?} at {width}: {longest}");
        }
    }
    let narrow = ran(&[("COLUMNS", "80")], &["rank"]).out;
    assert!(narrow.contains("left out where a line has 80 letters: bound, mean ratio"), "{narrow}");
    let whole = ran(&[], &["rank"]).out;
    assert!(!whole.contains("left out") && whole.lines().any(|line| line.ends_with("mean ratio")), "{whole}");
}

#[test]
fn verdicts_are_coloured_only_where_that_is_allowed() {
    let asked = ["place", "BT200L", "--task", "A:0.1", "--tolerance-mm", "0.01"];
    let force = ("CLICOLOR_FORCE", "1");
    assert!(!ran(&[], &asked).out.contains('\u{1b}'), "a pipe is no terminal");
    assert!(ran(&[force], &asked).out.contains("\u{1b}[31mfail\u{1b}[0m"));
    assert!(!ran(&[force], &[&asked[..], &["--format", "json"]].concat()).out.contains('\u{1b}'));
    assert!(!ran(&[("NO_COLOR", "1")], &asked).out.contains('\u{1b}'));
}

#[test]
fn a_stiffness_that_is_given_is_named_and_scales_the_answer() {
    let asked = ["place", "BT200L", "--task", "A:0.1", "--format", "json"];
    let answer = |more: &[&str]| -> serde_json::Value {
        serde_json::from_str(&ran(&[], &[&asked[..], more].concat()).out).expect("JSON")
    };
    let (usual, softer) = (answer(&[]), answer(&["--drive-urad-per-nm", "2"]));
    assert_eq!((&usual["stiffness_source"], &softer["stiffness_source"]), (&"assumed".into(), &"given".into()));
    assert_eq!(softer["drive_urad_per_nm"], serde_json::json!(vec![2.0; 6]));
    // Deflections are linear in the compliance.
    let ratio =
        softer["deflection_mm"].as_f64().expect("a number") / usual["deflection_mm"].as_f64().expect("a number");
    assert!((ratio - 2.0).abs() < 1e-6, "{ratio}");
    for verb in
        [&["place", "BT200L", "--task", "A:0.1"][..], &["map", "BT200L", "--size", "20"], &["rank", "--task", "A:0.1"]]
    {
        let heading = ran(&[], &[verb, &["--stiffness-nm-per-rad", "2e6"]].concat()).out;
        assert!(heading.contains("given: 0.5 urad/(N m) on every drive, 2 MN m/rad"), "{heading}");
        assert!(ran(&[], verb).out.contains("1 urad/(N m) assumed on every drive"), "{verb:?}");
    }
}

#[test]
fn filters_alone_look_at_the_whole_catalogue() {
    let rows = |arguments: &[&str]| ran(&[], &[arguments, &["--format", "csv"]].concat()).out.lines().count() - 1;
    let asked = ["rank", "--task", "A:0.1", "--payload-kg", "300..500"];
    assert_eq!(rows(&asked), rows(&[&asked[..], &["--robots", "all"]].concat()));
    assert!(10 < rows(&asked), "{}", rows(&asked));
    assert_eq!(rows(&["rank", "--task", "A:0.1"]), 10);
    assert_eq!(rows(&["rank", "--task", "A:0.1", "--robots", "paper", "--vendor", "KUKA"]), 1);
}

#[test]
fn a_spindle_is_the_tool_that_it_stands_for() {
    let asked = ["compliance", "KR 210 R2700 extra", "--joints-deg", "0,-90,90,0,45,0"];
    let with = |tool: [&str; 2]| ran(&[], &[&asked[..], &tool, &["--format", "json"]].concat()).out;
    assert_eq!(with(["--tool", "spindle:250@90+30"]), with(["--tool-mm", "250,0,30,0,90,0"]));
    let text =
        ran(&[], &["place", "BT200L", "--task", "A:0.1", "--model", "spatial", "--tool", "spindle:250@90+30"]).out;
    let words = "spindle of 250.0 mm at 90 deg to the flange axis, 30.0 mm before the flange: 250.0, 0.0, 30.0 mm from the flange";
    assert!(text.contains(words), "{text}");
    let both = ran(&[], &[&asked[..], &["--tool", "spindle:250", "--tool-mm", "0,0,250"]].concat());
    assert!(both.code == 2 && both.err.contains("exclude each other"), "{}", both.err);
    let metres = ran(&[], &[&asked[..], &["--tool-mm", "0,0,0.25"]].concat());
    assert!(metres.code == 2 && metres.err.contains("0.25 m would be 250"), "{}", metres.err);
}

#[test]
fn a_robot_that_is_shown_as_a_file_is_read_back_as_it_was() {
    let folder = TempDir::new().expect("a folder");
    for name in ["KR 210 R2700 extra", "IRB 6700-200/2.6", "M-900iA/200P"] {
        let file = folder.path().join("robot.toml");
        let path = file.to_str().expect("a plain path");
        assert_eq!(ran(&[], &["robots", "show", name, "-o", path]).code, 0);
        let sheet = |name: &str| ran(&[], &["robots", "show", name, "--format", "json"]).out;
        assert_eq!(sheet(path), sheet(name));
    }
    let shown = ran(&[], &["robots", "show", "IRB 6700-200/2.6"]).out;
    assert!(shown.contains("serial?") && shown.contains("serial?: no parallelogram is reported"), "{shown}");
}

#[test]
fn shells_and_manuals_know_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = ran(&[], &["completions", shell]);
        assert!(script.code == 0 && script.out.contains("compliance") && script.out.contains("tool-mm"), "{shell}");
    }
    assert!(ran(&[], &["man"]).out.contains(".TH stiffarm 1"));
    let folder = TempDir::new().expect("a folder");
    assert_eq!(ran(&[], &["man", folder.path().to_str().expect("a plain path"), "-q"]).code, 0);
    for page in ["stiffarm.1", "stiffarm-rank.1", "stiffarm-robots-show.1"] {
        let text = std::fs::read_to_string(folder.path().join(page)).expect(page);
        assert!(!text.is_empty(), "{page}");
    }
    let rank = std::fs::read_to_string(folder.path().join("stiffarm-rank.1")).expect("written");
    assert!(rank.contains("Examples") && !rank.contains("joints"), "{rank}");
}

/// In narrow lines, too, what is printed stands beside what is computed.
#[test]
fn a_published_number_stands_beside_the_computed_one_in_lines_of_any_length() {
    for width in ["80", "100", "139", "200"] {
        let text = ran(&[("COLUMNS", width)], &["validate"]).out;
        let heads = text.lines().find(|line| line.contains("source")).expect("headings");
        for heading in ["item", "cell", "printed", "computed", "verdict", "reason"] {
            assert!(heads.contains(heading), "{width}: {heads}");
        }
        let row = text.lines().find(|line| line.contains("3.83")).expect("the first number");
        assert!(row.contains("3.8800") && row.contains("listed"), "{width}: {row}");
        let table = text.lines().take_while(|line| !line.starts_with("[1]"));
        assert!(table.into_iter().all(|line| line.chars().count() <= width.parse().unwrap()), "{width}");
    }
}
