//! Does the program tell what it understands of toolpaths and processes, and refuse the rest with advice?

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn stiffarm(folder: &Path, words: &[&str]) -> Output {
    Command::cargo_bin("stiffarm").unwrap().current_dir(folder).args(words).output().unwrap()
}

fn json(folder: &Path, words: &[&str]) -> Value {
    let output = stiffarm(folder, &[words, &["--format", "json"]].concat());
    assert!(output.status.success(), "{words:?}: {output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// One answer as JSON and as people read it: a place that is sought is sought once.
fn both(folder: &Path, words: &[&str]) -> (Value, String) {
    let output = stiffarm(folder, &[words, &["-q", "-o", "answer.json", "-o", "answer.txt"]].concat());
    assert!(output.status.success(), "{words:?}: {output:?}");
    let read = |name| fs::read_to_string(folder.join(name)).unwrap();
    (serde_json::from_str(&read("answer.json")).expect("JSON"), read("answer.txt"))
}

fn close(found: &Value, expected: f64, within: f64) {
    let found = found.as_f64().expect("a number");
    assert!((found - expected).abs() <= within, "{found} is not {expected}");
}

#[test]
fn a_path_is_reported_under_the_names_that_scripts_rely_on() {
    let path = "crates/stiffarm/tests/paths/contour_ij.nc";
    let answer = json(Path::new(ROOT), &["mill", path, "--dry"]);
    assert_eq!((&answer["format"], &answer["feed_moves"], &answer["arcs"]), (&"gcode".into(), &13.into(), &4.into()));
    close(&answer["feed_length_m"], 0.448_504, 6e-7);
    close(&answer["rapid_length_m"], 0.111, 1e-12);
    close(&answer["box_m"][0][0], -0.055_123, 1e-12);
    close(&answer["box_m"][1][2], 0.002, 1e-12);
    assert!(answer["ignored"].as_array().unwrap().iter().any(|word| word == "M6 (line 5)"));
    let assumed = answer["assumed"].as_array().unwrap();
    assert!(
        assumed.iter().any(|one| one.as_str().unwrap().starts_with("the part frame is that of G54")),
        "{assumed:?}"
    );
    let table = stiffarm(Path::new(ROOT), &["mill", path, "--dry"]);
    let table = String::from_utf8(table.stdout).unwrap();
    assert!(table.contains("4 (0 full circles), 97.810 mm") && table.contains("M6 (line 5)"), "{table}");
    let built_in = json(Path::new(ROOT), &["mill", "rect:0.4x0.2", "--feed-mm-per-min", "600", "--dry"]);
    close(&built_in["time_s"], 120.0, 1e-9);
}

#[test]
fn a_job_file_asks_the_same_as_what_is_typed() {
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    fs::write(folder.path().join("parts/a.txt"), "G90\nG1 X1. Y0 Z0 F10\nX2.\n").unwrap();
    let typed = ["mill", "parts/a.txt", "--read-as", "gcode", "--unit", "inch", "--dry"];
    let answer = json(folder.path(), &typed);
    close(&answer["feed_length_m"], 0.0508, 1e-12);
    let saved = stiffarm(folder.path(), &[&typed[..], &["--save-job", "parts/job.toml"]].concat());
    assert!(saved.status.success(), "{saved:?}");
    let job = fs::read_to_string(folder.path().join("parts/job.toml")).unwrap();
    assert!(job.contains("path = \"a.txt\"") && job.contains("dry = true"), "{job}");
    let again = json(folder.path(), &["mill", "parts/job.toml"]);
    assert_eq!(again["feed_length_m"], answer["feed_length_m"]);
}

#[test]
fn what_is_refused_names_line_and_word_and_gives_advice() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    write("a.nc", b"G21\nG1 X1\n");
    write("b.nc", b"G21\nG65 P1\n");
    write("c.xyz", b"1 2 3\n");
    write("d.nc", &[0x7f, b'E', b'L', b'F', 0, 0, 1]);
    write("e.nc", b"");
    write("g.csv", b"x_mm,y_mm,z_mm\n0,0,0\n9,0,0\n");
    write("p.toml", b"[tool]\ndiameter_mm = 16\nteeth = 4\n[material]\npreset = 'al7075'\n");
    for (words, code, says) in [
        (&["mill", "a.nc", "--dry"][..], 1, "error: a.nc:2: G1: no feed rate"),
        (&["mill", "a.nc"], 2, "--robot"),
        (&["mill", "line:0.2", "--robot", "KR 210 R2700 extra"], 2, "--force-n"),
        (&["mill", "line:0.2", "--robot", "KR 210 R2700 extra", "--dry"], 2, "--dry"),
        (&["mill", "line:0.2", "--robot", "KR 210 R2700 extra", "--force-n", "1e7"], 2, "--force-n"),
        (
            &["mill", "line:0.2", "--robot", "KR 210 R2700 extra", "--force-n", "9", "--roll", "around"],
            2,
            "free, constant, linear",
        ),
        (
            &[
                "mill",
                "line:0.2",
                "--robot",
                "KR 210 R2700 extra",
                "--force-n",
                "9",
                "--at",
                "1.8,0,0.8",
                "--compensate",
            ],
            1,
            "a force that may point anywhere cannot be compensated",
        ),
        (&["mill", "b.nc", "--dry"], 1, "error: b.nc:2: G65: macros are not run"),
        (&["mill", "c.xyz", "--dry"], 2, "does not say by its ending how it is written; expected .nc"),
        (&["mill", "d.nc", "--dry"], 1, "error: d.nc:1: the line: it holds a zero byte"),
        (&["mill", "e.nc", "--dry"], 1, "error: e.nc: nothing in it moves the tool"),
        (&["mill", "f.nc", "--dry"], 1, "error: cannot read f.nc"),
        (&["mill", ".", "--read-as", "gcode", "--dry"], 1, "it is a folder"),
        (&["mill", "line:-1", "--dry"], 2, "error: path 'line:-1' is not understood"),
        (&["mill", "--dry"], 2, "<PATH> is missing"),
        // What is said where a file is silent, of files that are not silent of it.
        (&["mill", "line:0.2", "--dry", "--columns", "x_mm"], 2, "--columns says nothing of a path built in"),
        (&["mill", "line:0.2", "--dry", "--read-as", "apt"], 2, "--read-as says nothing of a path built in"),
        (&["mill", "a.nc", "--dry", "--columns", "x_mm,y_mm,z_mm"], 2, "--columns says nothing of G-code"),
        (&["mill", "a.nc", "--dry", "--arc-sense", "left"], 2, "--arc-sense says nothing of G-code"),
        (&["mill", "g.csv", "--dry", "--rotary", "head-ac"], 2, "--rotary says nothing of a table"),
        (&["mill", "line:0.2", "--dry", "--check"], 2, "check does not go with dry"),
        (
            &["mill", "g.csv", "--robot", "BT200L", "--force-n", "9", "--error", "normal", "--at", "1.8,0,0.8"],
            1,
            "BT200L along g.csv: line 3: no outward normal",
        ),
        (
            &["mill", "raster:rect:50x50@0.0005", "--robot", "BT200L", "--force-n", "9"],
            2,
            "--step-mm of 10 mm, with chords within 0.01 mm, cuts the path into more than 10000000 samples",
        ),
        (&["force", "p.toml"], 1, "engagement: missing; expected a table with ap_mm"),
        (
            &["force", "p.toml"],
            1,
            "p.toml:5: material.preset: no material of this name is known; did you mean al7075-t6?",
        ),
        (&["force", "a.nc"], 1, "error: a.nc:1: "),
        (&["force"], 2, "<PROCESS> is missing"),
    ] {
        let output = stiffarm(folder.path(), words);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{words:?}: {errors}");
        assert!(errors.contains(says) && errors.contains("hint: "), "{words:?}: {errors}");
        assert!(output.stdout.is_empty(), "{words:?}");
    }
}

/// Half a million lines, of which nothing is kept; no answer may need their memory.
#[test]
fn a_long_path_is_read_in_little_memory() {
    let folder = TempDir::new().unwrap();
    let lines: String = (0..500_000).map(|i| format!("G1 X{}.{:03} Y0.5\n", i % 100, i % 997)).collect();
    fs::write(folder.path().join("long.nc"), format!("G21 G90 F1000\n{lines}")).unwrap();
    let script = format!(
        "ulimit -v 300000; {} mill long.nc --dry --threads 1 --format json",
        assert_cmd::cargo::cargo_bin("stiffarm").display()
    );
    let output = Command::new("bash").current_dir(folder.path()).args(["-c", &script]).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(answer["lines"], 500_001);
}

#[test]
fn a_process_is_reported_with_its_figure() {
    let folder = TempDir::new().unwrap();
    let slot = "spindle_rpm = 12000\n[tool]\ndiameter_mm = 16\nteeth = 4\n[material]\npreset = \"AL 7075 T6\"\n[engagement]\nap_mm = 2\nside = \"slot\"\nfeed_per_tooth_mm = 0.1\n";
    fs::write(folder.path().join("slot.toml"), slot).unwrap();
    let answer = json(folder.path(), &["force", "slot.toml"]);
    // By hand: -N a K_rc c / 4 - N a K_re / pi, and so on.
    let pi = std::f64::consts::PI;
    close(&answer["mean_n"][0], -8.0 * 16.88 / 4.0 - 8.0 * 26.6 / pi, 1e-9);
    close(&answer["mean_n"][1], 8.0 * 76.701 / 4.0 + 8.0 * 27.7 / pi, 1e-9);
    close(&answer["mean_n"][2], -8.0 * 22.2 / pi - 8.0 * 0.7 / 2.0, 1e-9);
    close(&answer["exit_deg"], 180.0, 1e-9);
    close(&answer["power_w"], answer["moment_nm"].as_f64().unwrap() * 400.0 * pi, 1e-9);
    assert_eq!(answer["material_status"], "published");
    assert_eq!(answer["assumed"][0], "straight teeth: the helix is not given");
    for name in ["slot.svg", "slot.png", "slot.pdf", "slot.csv"] {
        let made = stiffarm(folder.path(), &["force", "slot.toml", "-q", "-o", name]);
        assert!(made.status.success() && folder.path().join(name).is_file(), "{made:?}");
    }
    let rows = fs::read_to_string(folder.path().join("slot.csv")).unwrap();
    assert!(rows.starts_with("angle_deg,feed_n,across_n,axial_n\n") && rows.lines().count() == 721);
    let example = json(Path::new(ROOT), &["force", "docs/examples/endmill.toml"]);
    assert_eq!(example["material"], "al7075-t6");
}

const KUKA: &str = "KR 210 R2700 extra";

/// One sample after the other: the joints of the table put a spindle of known length where the path says, and the error is the length of the
/// displacement that is reported.
#[test]
fn a_path_is_milled_and_every_sample_is_reported() {
    let folder = TempDir::new().unwrap();
    let asked = [
        "mill",
        "circle:0.2",
        "--robot",
        KUKA,
        "--tool",
        "spindle:250@90",
        "--force-n",
        "300,-120,80",
        "--at",
        "1.7,0,0.8,20",
    ];
    let further = [
        "--feed-mm-per-min",
        "1200",
        "--tolerance-mm",
        "0.3",
        "-o",
        "samples.csv",
        "-o",
        "figure.svg",
        "-o",
        "path.src",
    ];
    let answer = json(folder.path(), &[&asked[..], &further[..]].concat());
    assert_eq!((&answer["feasible"], &answer["pass"]), (&true.into(), &false.into()));
    let (worst, lower) = (answer["worst_mm"].as_f64().unwrap(), answer["lower_bound_mm"].as_f64().unwrap());
    assert!(0.97 * worst < lower && lower <= worst, "{lower} {worst}");
    close(&answer["part"]["time_s"], 0.2 * std::f64::consts::PI / 0.02, 1e-3);
    let text = fs::read_to_string(folder.path().join("samples.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let at = |name: &str| names.iter().position(|known| known == name).unwrap();
    let mut most = 0.0_f64;
    for row in reader.records() {
        let row = row.unwrap();
        let number = |name: &str| row[at(name)].parse::<f64>().unwrap();
        let size = number("dx_mm").hypot(number("dy_mm")).hypot(number("dz_mm"));
        assert!((size - number("error_mm")).abs() < 1e-12);
        assert!((number("x_mm").hypot(number("y_mm")) - 100.0).abs() < 1e-9);
        most = most.max(size);
    }
    close(&answer["worst_mm"], most, 1e-12);
    let figure = fs::read_to_string(folder.path().join("figure.svg")).unwrap();
    assert!(figure.contains("every roll of the tool") && figure.contains("tolerance"));
    let program = fs::read_to_string(folder.path().join("path.src")).unwrap();
    assert!(program.contains("DEF") && program.contains("LIN {X"));
}

/// The compensated file is read back: every place of it lies as far from the first as is reported, and nothing else has changed.
#[test]
fn a_compensated_path_is_written_back_into_its_file() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.nc"), "(keep me)\nG21 G90\nG0 X0 Y0 Z5\nG1 Z0 F600\nX80\nY40\nM5\nG0 Z5\n")
        .unwrap();
    let asked =
        ["mill", "a.nc", "--robot", KUKA, "--tool", "spindle:250@90", "--force-n", "300,-120,80", "--at", "1.7,0,0.8"];
    let further = ["--compensate", "--stiffness-uncertainty", "0.2", "--roll", "constant", "-o", "b.nc"];
    let answer = json(folder.path(), &[&asked[..], &further[..]].concat());
    let number = |key: &str| answer["compensation"][key].as_f64().unwrap();
    let worst = answer["worst_mm"].as_f64().unwrap();
    assert!(number("left_by_joints_mm") < 1e-6 && number("left_by_tips_mm") < 0.05 * worst, "{answer}");
    // A fifth of the compliance, more or less, is a fifth of the error.
    assert!(0.05 * worst < number("left_median_mm") && number("left_median_mm") < 0.3 * worst, "{answer}");
    assert!(number("left_median_mm") < number("left_p95_mm"));
    let written = fs::read_to_string(folder.path().join("b.nc")).unwrap();
    assert!(
        written.contains("(keep me)") && written.contains("M5") && written.contains("compensated by stiffarm"),
        "{written}"
    );
    let (before, after) =
        (json(folder.path(), &["mill", "a.nc", "--dry"]), json(folder.path(), &["mill", "b.nc", "--dry"]));
    for corner in 0..2 {
        for axis in 0..3 {
            let (a, b) =
                (before["box_m"][corner][axis].as_f64().unwrap(), after["box_m"][corner][axis].as_f64().unwrap());
            assert!((a - b).abs() * 1e3 <= number("largest_correction_mm") + 1e-3, "{a} {b}");
        }
    }
    assert_ne!(before["box_m"], after["box_m"]);
}

/// Without a place the best one is sought: no worse than one by hand, and no better than what is proved.
#[test]
fn a_path_without_a_place_gets_the_best_one() {
    let folder = TempDir::new().unwrap();
    let asked =
        ["mill", "line:0.2", "--robot", KUKA, "--tool", "spindle:250@90", "--force-n", "400", "--step-mm", "40"];
    let (placed, text) = both(folder.path(), &asked);
    let by_hand = json(folder.path(), &[&asked[..], &["--at", "1.7,0,0.8,20"]].concat());
    let number = |answer: &Value, key: &str| answer[key].as_f64().unwrap();
    assert!(number(&placed, "worst_mm") < number(&by_hand, "worst_mm"));
    assert!(0.8 * number(&placed, "worst_mm") < number(&placed, "lower_bound_mm"));
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let bound = format!("proved lower bound {:.4} mm (gap", number(&placed, "lower_bound_mm"));
    for words in [bound.as_str(), "18 x 14 x 24 places ahead, up and turned, the best refined to"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    // A force of one direction may not move the tip at all where nobody has looked closely enough.
    let (placed, text) = both(folder.path(), &asked.map(|word| if word == "400" { "300,-120,80" } else { word }));
    assert_eq!(placed["lower_bound_mm"], 0.0);
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("proved lower bound not proved: "), "{text}");
    let nowhere = json(folder.path(), &[&asked[..], &["--within", "6..7,0..1"]].concat());
    assert_eq!(nowhere["feasible"], false);
    assert!(nowhere["worst_mm"].is_null() && nowhere["reason"].as_str().unwrap().contains("no place"));
}

/// A line of 200 mm along the part's x axis, which points to the left.
#[test]
fn where_a_part_must_stand_is_drawn_with_its_lengths() {
    let folder = TempDir::new().unwrap();
    let robot = ["mill", "line:0.2", "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--force-n", "400"];
    let place = ["--at", "1.7,0.3,0.8,90", "-o", "shop.svg", "-o", "part.shop.pdf", "-o", "part.svg"];
    let output = stiffarm(folder.path(), &[&robot[..], &place].concat());
    assert!(output.status.success(), "{output:?}");
    let shop = fs::read_to_string(folder.path().join("shop.svg")).unwrap();
    for length in ["1700.0", "300.0", "800.0", "200.0"] {
        assert!(shop.contains(&format!(">{length}<")), "{length}: {shop}");
    }
    assert!(shop.contains("data-work=") && fs::read(folder.path().join("part.shop.pdf")).unwrap().starts_with(b"%PDF"));
    assert!(!fs::read_to_string(folder.path().join("part.svg")).unwrap().contains("data-work="));
    let nowhere = stiffarm(folder.path(), &[&robot[..], &["--within", "9..,0..", "-o", "shop.svg"]].concat());
    assert!(String::from_utf8_lossy(&nowhere.stderr).contains("nothing to draw: the path has no place"), "{nowhere:?}");
}

/// What is pinned is kept, reported, and drawn; the table has it at its sample.
#[test]
fn a_roll_is_pinned_where_it_is_asked_for() {
    let folder = TempDir::new().unwrap();
    let robot = ["mill", "line:0.2", "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--force-n", "400"];
    let asked = [&robot[..], &["--at", "1.7,0,0.8", "--pin", "0@120,100@150"]].concat();
    let answer = json(folder.path(), &asked);
    assert_eq!(answer["roll"]["pins"].as_array().unwrap().len(), 2);
    let csv = stiffarm(folder.path(), &[&asked[..], &["--format", "csv"]].concat());
    let csv = String::from_utf8(csv.stdout).unwrap();
    let head: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let column = |name: &str| head.iter().position(|known| *known == name).unwrap();
    let row = |way: f64| {
        let rows = csv.lines().skip(1).map(|row| row.split(',').collect::<Vec<_>>());
        rows.into_iter().find(|row| (row[column("s_m")].parse::<f64>().unwrap() - way).abs() < 1e-9).unwrap()
    };
    for (way, roll) in [(0.0, 120.0), (0.1, 150.0)] {
        assert!((row(way)[column("roll_deg")].parse::<f64>().unwrap() - roll).abs() < 1e-9);
    }
    for (words, expected) in [
        (&["--pin", "0@120"][..], "--pin needs --at"),
        (&["--at", "1.7,0,0.8", "--pin", "0@120", "--roll", "constant"], "--roll and --pin exclude each other"),
        (&["--at", "1.7,0,0.8", "--pin", "300@120"], "300.000 mm along a path of 200.000 mm"),
        (&["--at", "1.7,0,0.8", "--pin", "0@120,1@130"], "two rolls pinned to the sample that is nearest to 1.000 mm"),
        (&["--at", "1.7,0,0.8", "--pin", "120"], "expected MM@DEG"),
    ] {
        let output = stiffarm(folder.path(), &[&robot[..], words].concat());
        let why = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && why.contains(expected), "{words:?}: {why}");
    }
}

/// The table lies beside the process file, from wherever that is named; where it ends too soon the path is refused with its place.
#[test]
fn a_force_that_was_measured_acts_along_the_path() {
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("cell")).unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join("cell").join(name), text).unwrap();
    put("forces.csv", "s_m,f_feed_n,f_across_n,f_axial_n\n0,100,0,0\n0.2,300,0,-50\n");
    put("process.toml", "[measured]\nfile = \"forces.csv\"\non = \"tool\"\n");
    let force = json(folder.path(), &["force", "cell/process.toml"]);
    assert_eq!((&force["mean_n"], &force["max_n"][0]), (&serde_json::json!([200.0, 0.0, -25.0]), &300.0.into()));
    let milled = |path: &str| {
        let asked = ["mill", path, "--robot", "KR 210 R2700 extra", "--process", "cell/process.toml"];
        stiffarm(folder.path(), &[&asked[..], &["--at", "1.7,0,0.8", "--format", "csv", "--step-mm", "50"]].concat())
    };
    let table = milled("line:0.2");
    assert!(table.status.success(), "{table:?}");
    let mut rows = csv::Reader::from_reader(table.stdout.as_slice());
    let place = |name: &str| rows.headers().unwrap().iter().position(|known| known == name).unwrap();
    let [way, feed, axial] = ["s_m", "f_feed_n", "f_axial_n"].map(place);
    for row in rows.records() {
        let row = row.unwrap();
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        assert!((number(feed) - 100.0 - 1000.0 * number(way)).abs() < 1e-6, "{row:?}");
        assert!((number(axial) + 250.0 * number(way)).abs() < 1e-6, "{row:?}");
    }
    let refused = String::from_utf8(milled("line:0.3").stderr).unwrap();
    assert!(refused.contains("measured from 0.000000 to 0.200000 m, and the tool is at"), "{refused}");
    put("forces.csv", "s_m,f_feed_n,f_across_n,f_axial_n\n0,100,0,0\n0.2,inf,0,-50\n");
    let refused = String::from_utf8(milled("line:0.2").stderr).unwrap();
    assert!(refused.contains("forces.csv:3: f_feed_n: inf; expected a number of at most 100000"), "{refused}");
}

/// A path may say what acts: then nothing else is told to act, and what it says of a cut is looked at or said not to be.
#[test]
fn forces_and_cuts_that_a_path_says_are_those_that_are_told() {
    let folder = TempDir::new().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let mill = |path: &str, more: &[&str]| {
        let asked = ["mill", path, "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--at", "1.7,0,0.8"];
        let found = stiffarm(folder.path(), &[&asked[..], more].concat());
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
        (found.status.code().unwrap(), text(found.stdout) + &text(found.stderr))
    };
    put("forces.csv", "x_mm,y_mm,z_mm,fx_n,fy_n,fz_n\n0,0,0,100,10,5\n0,10,0,100,10,5\n");
    let (code, own) = mill("forces.csv", &[]);
    assert!(code == 0 && own.contains("force on the tool as the path gives it (fx_n, fy_n, fz_n)"), "{own}");
    let (code, refused) = mill("forces.csv", &["--force-n", "1,2,3"]);
    assert!(code == 2 && refused.contains("acts nowhere: every feed move of the path has its own force"), "{refused}");
    // The same by hand: fed along y, x is to the right.
    put("plain.csv", "x_mm,y_mm,z_mm\n0,0,0\n0,10,0\n");
    let error = |text: &str| text.split_once("largest error ").unwrap().1.split_once(" mm").unwrap().0.to_owned();
    assert_eq!(error(&own), error(&mill("plain.csv", &["--force-n", "10,-100,5"]).1));
    let tool = "spindle_rpm = 12000\n[tool]\ndiameter_mm = 16\nteeth = 4\nflute_mm = 20\nshank_mm = 15\n[material]\npreset = \"al7075-t6\"\n\
        [engagement]\nap_mm = 2\nae_mm = 4\nside = \"up\"\nfeed_per_tooth_mm = 0.1\n";
    put("mill.toml", tool);
    put("cuts.csv", "x_mm,y_mm,z_mm,ap_mm,ae_mm\n0,0,0,3,4\n10,0,0,3,40\n");
    let (code, wide) = mill("cuts.csv", &["--process", "mill.toml"]);
    assert!(code == 1 && wide.contains("cuts.csv: line 3: ae_mm of 40; expected no more than the diameter"), "{wide}");
    let (_, given) = mill("cuts.csv", &["--force-n", "1,2,3"]);
    assert!(given.contains("ap_mm and ae_mm of the path are not looked at: the force is given as such"), "{given}");
    // The chip is that of the path's own speed: 2400 mm/min at 6000 rpm are 0.1 mm a tooth, 1200 at 500 rpm 0.6 mm.
    let fed = |words: &str| format!("G21 G90 G94\nT1 M6\n{words}\nG0 X-30.0 Y0.0 Z20.0\nG0 Z-3.0\nG1 X30.\nM30\n");
    put("as_meant.nc", &fed("S6000 M3 F2400"));
    put("gentler.nc", &fed("S500 M3 F1200"));
    let (_, meant) = mill("as_meant.nc", &["--process", "mill.toml"]);
    assert!(!meant.contains("mm a tooth where") && meant.contains("turns the spindle at 6000 rpm"), "{meant}");
    let (_, more) = mill("gentler.nc", &["--process", "mill.toml"]);
    assert!(more.contains("the path feeds 0.6 mm a tooth where the process means 0.1"), "{more}");
    // A plunge is fed otherwise; of a path that is fed so in part it is told where.
    let plunged = "G21 G90 G94\nT1 M6\nS12000 M3\nG0 X-30.0 Y0.0 Z2.0\nG1 Z-3.0 F300\nG1 X0. F4800\nM30\n";
    put("plunged.nc", plunged);
    put("in_part.nc", &plunged.replace("M30", "G1 X30. F2400\nM30"));
    let [(_, plunged), (_, in_part)] = ["plunged.nc", "in_part.nc"].map(|path| mill(path, &["--process", "mill.toml"]));
    assert!(!plunged.contains("mm a tooth"), "{plunged}");
    let (_, says) = in_part.split_once("the path feeds 0.05 mm a tooth on ").expect("half as much");
    assert!(says.contains("samples, first at line 7 where the process means 0.1"), "{in_part}");
    // Deeper than the flutes, and what another tool has cut.
    let two = "G21 G90 G94\nT1 M6\nS12000 M3\nG0 X-30. Y0. Z20.\nG0 Z-30.\nG1 X60. F4800\nG0 Z20.\nT2 M6\nG0 X-30. Y0.\nG0 Z-30.\nG1 X60. F1800\nM30\n";
    put("two.nc", two);
    let stock = ["--process", "mill.toml", "--stock-mm=0..40,-30..30,-80..0", "--only-tool", "2"];
    let (code, deep) = mill("two.nc", &stock);
    assert!(code == 0 && deep.contains("DEEPER THAN THE FLUTES") && deep.contains("up to 30.0 mm deep"), "{deep}");
    assert!(
        deep.contains("MORE MATERIAL: what the other tools of the path cut before is still in the block"),
        "{deep}"
    );
    let (code, first) = mill("two.nc", &[&stock[..4], &["1"]].concat());
    assert!(code == 0 && !first.contains("MORE MATERIAL"), "{first}");
}

/// What the pendant of a GP200R shows is not known: its description turns joint 6 otherwise than the maker's other arms.
#[test]
fn no_program_has_joints_of_a_robot_whose_pendant_is_not_known_until_somebody_vouches_for_it() {
    let folder = TempDir::new().unwrap();
    let asked = ["mill", "line:0.2", "--force-n", "300,100,50", "--feed-mm-per-min", "600", "--at", "2.2,0,0.4", "-q"];
    let written = |robot: &str, further: &[&str]| {
        let output = stiffarm(folder.path(), &[&asked[..], &["--robot", robot, "-o", "p.ls"], further].concat());
        assert!(output.status.success(), "{output:?}");
        (fs::read_to_string(folder.path().join("p.ls")).unwrap(), String::from_utf8(output.stdout).unwrap())
    };
    let (program, _) = written("GP200R", &[]);
    let first_lines: Vec<&str> = program.lines().skip_while(|line| *line != "/MN").skip(1).take(2).collect();
    assert!(!program.contains("J1=") && first_lines[0].contains("WARNING: it is not known"), "{program}");
    let (program, _) = written("GP200R", &["--pendant-as-file"]);
    assert!(program.contains("J1=") && program.contains("WARNING"), "{program}");
    let answer = json(folder.path(), &[&asked[..8], &["--robot", "GP200R"]].concat());
    assert_eq!(answer["pendant"], "unknown");
    assert!(
        answer["remarks"].as_array().unwrap().iter().any(|one| one.as_str().unwrap().contains("GP200R")),
        "{answer}"
    );
    let (program, _) = written("R-2000iC/210R", &[]);
    assert!(program.contains("J1=") && !program.contains("WARNING"), "{program}");
}
