//! Does a path keep clear of the part that an STL file holds, and do messages name what is wrong with a file?

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples");

/// Exit code, standard output, standard error; never a panic.
fn run(folder: &Path, more: &[&str]) -> (i32, String, String) {
    let usual = ["mill", "rib.nc", "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--at", "1.7,0,0.8"];
    let force: &[&str] = if more.contains(&"--process") { &[] } else { &["--force-n", "300,100,50"] };
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let output = program.current_dir(folder).args(usual).args(force).args(more).output().expect("runs");
    let [out, errors] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("text"));
    assert!(!errors.contains("panicked"), "{errors}");
    (output.status.code().expect("an exit code"), out, errors)
}

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    for name in ["rib.nc", "rib.stl", "clamps.stl", "endmill.toml"] {
        fs::copy(Path::new(EXAMPLES).join(name), folder.path().join(name)).unwrap();
    }
    folder
}

fn json(folder: &Path, more: &[&str]) -> Value {
    let (code, out, errors) = run(folder, &[more, &["--format", "json"]].concat());
    assert_eq!(code, 0, "{errors}");
    serde_json::from_str(&out).expect("JSON")
}

/// By hand: the spindle is thicker than the 60 mm from the groove to the rib, and begins 80 mm above the tip, 45 mm below the rib's top (5 mm deep groove).
#[test]
fn a_spindle_beside_a_rib_touches_it_unless_the_cutter_is_long_enough() {
    let folder = folder();
    let folder = folder.path();
    let alone = json(folder, &[]);
    assert_eq!(alone["contacts"], serde_json::json!([]));
    let short = json(folder, &["--part", "rib.stl", "--stick-out-mm", "80"]);
    // The rib 10 mm nearer to the groove: so much deeper.
    let whole = fs::read_to_string(folder.join("rib.stl")).unwrap();
    fs::write(folder.join("nearer.stl"), whole.replace(" 60 ", " 50 ")).unwrap();
    let nearer = json(folder, &["--part", "nearer.stl", "--stick-out-mm", "80"]);
    let [depth, deeper] = [&short, &nearer].map(|answer| {
        let contacts = answer["contacts"].as_array().unwrap().iter();
        let of_tool = contacts.filter(|contact| contact["bodies"] == "tool to part");
        of_tool.filter_map(|contact| contact["depth_mm"].as_f64()).fold(0.0, f64::max)
    });
    assert!(0.0 < depth && (deeper - depth - 10.0).abs() < 0.01, "{depth} {deeper}");
    assert!(
        short["clearance_by"].as_array().unwrap().contains(&"mesh".into())
            && short["clearance_mm"].as_f64() <= Some(0.0),
        "{short}"
    );
    // Above the rib's top at every sample, by 140 - 5 - 120 mm where the tool stands upright.
    let long = json(folder, &["--part", "rib.stl", "--stick-out-mm", "140"]);
    assert_eq!((&long["contacts"], &long["clearance_of"]), (&serde_json::json!([]), &"tool to part".into()), "{long}");
    let apart = long["clearance_mm"].as_f64().unwrap();
    assert!((apart - 15.0).abs() < 0.01, "{apart}");
    // The arm is led around the rib, and that costs something.
    assert!(alone["worst_mm"].as_f64() < long["worst_mm"].as_f64(), "{long}");
    // The length of the tool says the same, from a spindle that ends so much before the tip.
    let (code, out, _) = run(folder, &["--part", "rib.stl"]);
    assert!(code == 0 && out.contains("stick-out-mm") && !out.contains("COLLISION"), "{out}");
}

#[test]
fn every_sample_tells_its_clearance_and_figures_show_where_it_touches() {
    let folder = folder();
    let folder = folder.path();
    let asked = ["--part", "rib.stl", "--stick-out-mm"];
    for (length, touches) in [("80", true), ("140", false)] {
        let one = [&asked[..], &[length]].concat();
        let answer = json(folder, &one);
        for file in ["path.csv", "path.svg", "path.view.html"] {
            assert_eq!(run(folder, &[&one[..], &["-o", file, "-q"]].concat()).0, 0, "{file}");
        }
        let mut table = csv::Reader::from_path(folder.join("path.csv")).unwrap();
        let headings = table.headers().unwrap().clone();
        let column = |name: &str| headings.iter().position(|one| one == name).unwrap();
        let [line, apart, of] = ["line", "clearance_mm", "clearance_of"].map(column);
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        let distance = |row: &csv::StringRecord| row[apart].parse::<f64>().unwrap();
        let nearest = rows.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
        assert!((distance(nearest) - answer["clearance_mm"].as_f64().unwrap()).abs() < 1e-9, "{nearest:?}");
        assert_eq!(nearest[of], *answer["clearance_of"].as_str().unwrap());
        let touching: Vec<&str> = rows.iter().filter(|row| distance(row) < 0.0).map(|row| &row[line]).collect();
        assert_eq!(!touching.is_empty(), touches);
        for contact in answer["contacts"].as_array().unwrap() {
            assert!(touching.contains(&&*contact["line"].to_string()), "{contact}");
        }
        let [figure, view] = ["path.svg", "path.view.html"].map(|file| fs::read_to_string(folder.join(file)).unwrap());
        assert_eq!(figure.contains(">touches<"), touches);
        assert_eq!(view.contains(r#""name":"touches""#), touches);
    }
}

#[test]
fn no_program_is_written_over_the_touch_of_a_part() {
    let folder = folder();
    let folder = folder.path();
    let short = ["--part", "rib.stl", "--stick-out-mm", "80", "-o", "rib.src"];
    let (code, _, errors) = run(folder, &short);
    assert!(
        code == 1 && errors.contains(" to part: they overlap by ") && !folder.join("rib.src").exists(),
        "{code} {errors}"
    );
    let (code, _, errors) = run(folder, &[&short[..], &["--allow-contact", "-o", "rib.view.html"]].concat());
    assert_eq!(code, 0, "{errors}");
    assert!(fs::read_to_string(folder.join("rib.src")).unwrap().contains("WARNING: written although"));
    let view = fs::read_to_string(folder.join("rib.view.html")).unwrap();
    assert!(
        view.contains("\"part\"") && view.contains("where it touches deepest (line 7"),
        "the part, and the arm at the touch"
    );
}

/// By hand: the groove is 5 mm deep, below a block whose top is 10 mm above zero. 12 mm out of the spindle the cutter lets that 3 mm into the
/// block; 80 mm out it runs 65 mm above it.
#[test]
fn a_spindle_that_sinks_into_the_block_is_reported_and_one_above_it_is_not() {
    let folder = folder();
    let folder = folder.path();
    let block = ["--process", "endmill.toml", "--stock-mm=-120..120,-30..100,-20..10"];
    let short = [&block[..], &["--stick-out-mm", "12"]].concat();
    let answer = json(folder, &short);
    let contacts = answer["contacts"].as_array().unwrap();
    assert!(contacts.iter().any(|contact| contact["bodies"] == "tool to stock"), "{answer}");
    let deepest = contacts.iter().filter_map(|contact| contact["depth_mm"].as_f64()).fold(0.0, f64::max);
    assert!((deepest - 3.0).abs() < 0.01, "{contacts:?}");
    assert!(answer["clearance_by"].as_array().unwrap().contains(&"stock".into()), "{answer}");
    let long = json(folder, &[&block[..], &["--stick-out-mm", "80"]].concat());
    assert_eq!((&long["contacts"], &long["clearance_of"]), (&serde_json::json!([]), &"tool to stock".into()), "{long}");
    assert!((long["clearance_mm"].as_f64().unwrap() - 65.0).abs() < 0.01, "{long}");
    // The view shows the block, and a program is refused.
    let (code, _, errors) = run(folder, &[&short[..], &["-o", "rib.view.html", "-o", "rib.src"]].concat());
    assert!(code == 1 && errors.contains("tool to stock: they overlap by 3.0 mm"), "{errors}");
    assert!(fs::read_to_string(folder.join("rib.view.html")).unwrap().contains("stock, before it is cut"));
    assert!(!folder.join("rib.src").exists());
    // Nothing of the tool is compared where it is not known where the spindle ends, and that is said.
    let (code, out, _) = run(folder, &block);
    assert!(
        code == 0 && out.contains("the tool is not compared with the stock") && !out.contains("COLLISION"),
        "{out}"
    );
    let (code, _, errors) = run(folder, &["--stick-out-mm", "80"]);
    assert!(code == 2 && errors.contains("--stick-out-mm needs --part or --stock-mm"), "{errors}");
}

/// By hand: the clamps' edge is 15 mm from the middle of the groove, and the mill has a radius of 8 mm. Their tops lie under the spindle, 140 mm above the tip.
#[test]
fn a_cutter_keeps_clear_of_clamps_that_hold_the_part() {
    let folder = folder();
    let folder = folder.path();
    let asked = ["--process", "endmill.toml", "--stick-out-mm", "140", "--part", "rib.stl"];
    let held = |clamps: &str| json(folder, &[&asked[..], &["--fixture", clamps]].concat());
    let answer = held("clamps.stl");
    assert_eq!(
        (&answer["contacts"], &answer["clearance_of"]),
        (&serde_json::json!([]), &"cutter to fixture".into()),
        "{answer}"
    );
    assert!((answer["clearance_mm"].as_f64().unwrap() - 7.0).abs() < 0.01, "{answer}");
    // The program says what estimated links may touch, and the answer that no spindle is compared where the tool is shorter.
    let kept = ["--fixture", "clamps.stl", "-o", "kept.src"];
    assert_eq!(run(folder, &[&asked[..], &kept].concat()).0, 0);
    let program = fs::read_to_string(folder.join("kept.src")).unwrap();
    assert!(program.contains("WARNING: links are estimated, and wrist to fixture may touch"), "{program}");
    let (_, long, _) = run(folder, &["--part", "rib.stl", "--stick-out-mm", "251"]);
    assert!(long.contains("by 251.0 mm, the tool reaches 250.0 mm from the flange: no spindle is compared"), "{long}");
    // A shank of 20 mm radius that begins 20 mm above the tip would run 5 mm into them, as they are 40 mm high.
    let mill = fs::read_to_string(folder.join("endmill.toml")).unwrap();
    fs::write(folder.join("thick.toml"), mill.replace("teeth = ", "flute_mm = 20\nshank_mm = 40\nteeth = ")).unwrap();
    let thick = json(folder, &[&["--process", "thick.toml", "--fixture", "clamps.stl"], &asked[2..]].concat());
    let unavoidable = &thick["unavoidable"];
    assert!((unavoidable["depth_mm"].as_f64().unwrap() - 5.0).abs() < 0.01, "{thick}");
    assert!(unavoidable["bodies"] == "shank to fixture", "{thick}");
    // 10 mm nearer the mill runs 3 mm into them: no program, and the view shows them.
    let whole = fs::read_to_string(folder.join("clamps.stl")).unwrap();
    fs::write(folder.join("nearer.stl"), whole.replace(" -15 ", " -5 ")).unwrap();
    let answer = held("nearer.stl");
    // No roll avoids that, and the arm is led clear of all else.
    let unavoidable = &answer["unavoidable"];
    assert!((unavoidable["depth_mm"].as_f64().unwrap() - 3.0).abs() < 0.01, "{answer}");
    let mut bodies = answer["contacts"].as_array().unwrap().iter().map(|contact| &contact["bodies"]);
    assert!(bodies.all(|bodies| bodies == "cutter to fixture" && bodies == &unavoidable["bodies"]), "{answer}");
    let more = [&asked[..], &["--fixture", "nearer.stl", "-o", "rib.src", "-o", "rib.view.html"]].concat();
    let (code, _, errors) = run(folder, &more);
    assert!(code == 1 && errors.contains("no program: at every roll line 7, "), "{errors}");
    assert!(errors.contains("cutter to fixture: they overlap by 3.0 mm, at best"), "{errors}");
    assert!(!folder.join("rib.src").exists());
    assert!(fs::read_to_string(folder.join("rib.view.html")).unwrap().contains("\"fixture\""));
    // Without a process the cutter has no radius, and its axis is 5 mm away.
    let (code, out, _) = run(folder, &["--stick-out-mm", "140", "--fixture", "nearer.stl"]);
    assert!(
        code == 0 && out.contains("its axis alone keeps clear of the fixture") && !out.contains("COLLISION"),
        "{out}"
    );
    let far = whole.replace("-15 ", "4985 ").replace("-140 ", "4860 ").replace("-105 ", "4895 ");
    fs::write(folder.join("far.stl"), far).unwrap();
    let (_, out, _) = run(folder, &["--fixture", "far.stl"]);
    assert!(out.contains("the fixture lies farther from the feed moves than it is wide"), "{out}");
}

#[test]
fn wrong_meshes_are_refused_by_what_is_wrong() {
    let folder = folder();
    let folder = folder.path();
    let whole = fs::read_to_string(folder.join("rib.stl")).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("cut.stl", &whole[..whole.len() / 2]);
    write("dae.stl", "<?xml version=\"1.0\"?><COLLADA/>");
    write("lfs.stl", "version https://git-lfs.github.com/spec/v1\n");
    write("empty.stl", "");
    let in_metres = |line: &str| {
        let Some(numbers) = line.trim().strip_prefix("vertex ") else { return format!("{line}\n") };
        let metres: Vec<String> = numbers.split(' ').map(|mm| (mm.parse::<f64>().unwrap() / 1e3).to_string()).collect();
        format!("vertex {}\n", metres.join(" "))
    };
    write("metres.stl", &whole.lines().map(in_metres).collect::<String>());
    for (more, code, says) in [
        (&["--part", "none.stl"][..], 1, "none.stl"),
        (&["--part", "cut.stl"], 1, "cut.stl: it is no STL file"),
        (&["--part", "dae.stl"], 1, "dae.stl: it is XML, such as COLLADA, not STL"),
        (&["--part", "lfs.stl"], 1, "git lfs pull"),
        (&["--part", "empty.stl"], 1, "empty.stl: it is empty"),
        (&["--part", "rib.stl", "--part-unit", "m"], 1, "m wide; expected at most 100 m"),
        (&["--part", "metres.stl"], 2, "part-unit"),
        (&["--fixture", "metres.stl"], 2, "expected 5 mm or more: is its unit another one (part-unit)?"),
        (&["--part-unit", "m"], 2, "--part"),
        (&["--stick-out-mm", "80"], 2, "--part"),
        (&["--part", "rib.stl", "--stick-out-mm", "-1"], 2, "stick-out-mm"),
        (&["--part", "rib.stl", "-o", "rib.stl.csv", "-o", "rib.stl"], 2, "rib.stl"),
    ] {
        let (found, out, errors) = run(folder, more);
        assert!(found == code && errors.contains(says) && out.is_empty(), "{more:?}: {found} {errors}");
    }
}

/// A box as text, mm.
fn boxed(low: [i32; 3], high: [i32; 3]) -> String {
    let corner = |i: usize| [0, 1, 2].map(|axis| [low, high][i >> axis & 1][axis].to_string()).join(" ");
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let facet = |[a, b, c]: [usize; 3]| {
        let corners = [a, b, c].map(|i| format!("vertex {}\n", corner(i))).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let facets = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).map(facet);
    format!("solid box\n{}endsolid box\n", facets.collect::<String>())
}

/// By hand: a fixture of 200 x 200 x 300 mm under the origin of the path, which stands 1.7 m ahead and 0.8 m or 0.2 m high.
#[test]
fn a_fixture_in_a_cabinet_or_below_the_floor_is_a_collision_and_one_beside_them_is_not() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("fixture.stl"), boxed([-100, -100, -300], [100, 100, 0])).unwrap();
    let asked = ["--mount", "floor", "--fixture", "fixture.stl", "--tolerance-mm", "5"];
    let with = |cabinet: &str, more: &[&str]| run(folder, &[&asked[..], &["--keep-out", cabinet], more].concat());
    let (code, out, errors) = with("1.75..2.5,-1..1,0..0.6", &["--check"]);
    let says = "the fixture reaches up to 50 mm into keep-out 1";
    assert!(code == 3 && out.contains(&format!("COLLISION                        {says}")), "{code}: {out}{errors}");
    assert!(errors.contains(says), "{errors}");
    let (code, out, _) = with("1.75..2.5,-1..1,0..0.6", &["--format", "json"]);
    let found: Value = serde_json::from_str(&out).expect("JSON");
    let misplaced = &found["misplaced"];
    assert_eq!((code, misplaced.as_array().map(Vec::len)), (0, Some(1)), "{misplaced}");
    assert_eq!(misplaced[0]["bodies"], "fixture to keep-out 1");
    assert!((misplaced[0]["depth_mm"].as_f64().unwrap() - 50.0).abs() < 1e-6, "{misplaced}");
    // It stands on a table, and beside a cabinet.
    for beside in ["1..2.5,-1..1,0..0.5", "1.8..2.5,-1..1,0..0.6"] {
        let (code, out, errors) = with(beside, &["--check"]);
        assert!(code == 0 && !out.contains("COLLISION"), "{beside}: {out}{errors}");
    }
    let (code, _, errors) = with("1.75..2.5,-1..1,0..0.6", &["--check", "--allow-contact"]);
    assert_eq!(code, 0, "{errors}");
    let low = ["mill", "line:0.1", "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--force-n", "30,10,5"];
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let output = program.current_dir(folder).args(low).args(asked).args(["--at", "1.7,0,0.2"]).output().expect("runs");
    let out = String::from_utf8(output.stdout).expect("text");
    assert!(out.contains("the fixture stands up to 100 mm below the floor"), "{out}");
}

/// The corners of a bar that reaches 0.6 m aside, where the path stands: at the best place without it they would lie in a cabinet.
#[test]
fn the_best_place_of_a_path_leaves_room_for_its_fixture() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("fixture.stl"), boxed([-100, -600, -400], [100, 100, -10])).unwrap();
    let arm =
        ["mill", "line:0.1", "--robot", "KR 210 R2700 extra", "--tool", "spindle:250@90", "--force-n", "100,50,20"];
    let cell = ["--mount", "floor", "--within", "1.2..1.6,-0.2..0.2,0.55..1.3", "--keep-out", "0.9..2.2,0.4..1,0..2"];
    let deepest = |more: &[&str]| {
        let mut program = Command::cargo_bin("stiffarm").unwrap();
        let asked = [&arm[..], &cell, more, &["--format", "json"]].concat();
        let output = program.current_dir(folder).args(asked).output().expect("runs");
        let answer: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert!(answer["feasible"] == true && answer["misplaced"] == serde_json::json!([]), "{answer}");
        let number = |value: &Value| value.as_f64().unwrap();
        let [x, y] = [0, 1].map(|axis| number(&answer["at_m"][axis]));
        let (s, c) = number(&answer["at_yaw_deg"]).to_radians().sin_cos();
        let corners =
            [[-0.1, -0.6], [0.1, -0.6], [0.1, 0.1], [-0.1, 0.1]].map(|[u, v]| [x + c * u - s * v, y + s * u + c * v]);
        let in_cabinet = corners.into_iter().filter(|[x, _]| (0.9..2.2).contains(x)).map(|[_, y]| y - 0.4);
        in_cabinet.fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(0.05 < deepest(&[]));
    // But for the millimetre by which it may touch.
    assert!(deepest(&["--fixture", "fixture.stl"]) < 1.001e-3);
}
