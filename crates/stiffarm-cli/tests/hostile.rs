//! Does the program end soon, without a panic and with advice, whatever it is given to read and wherever it must write?
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Output;
use std::time::Duration;

use assert_cmd::Command;
use tempfile::TempDir;

const SMALLEST: &str =
    "name = \"two links\"\narchitecture = \"serial\"\nstatus = \"derived\"\n\n[planar]\nl2_mm = 1000\nl3_mm = 800\n";

/// What a shell makes of a script; `$S` is the program. It must end within a time that no honest answer here needs.
fn shell(folder: &Path, script: &str) -> Output {
    let mut command = Command::new("bash");
    command.args(["-c", script]).env("S", assert_cmd::cargo::cargo_bin("stiffarm")).current_dir(folder);
    let output = command.timeout(Duration::from_mins(10)).output().expect("bash runs");
    assert!(output.status.code().is_some(), "{script}: killed or too slow: {output:?}");
    assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"), "{script}: {output:?}");
    output
}

/// Exit code, standard output and standard error.
fn outcome(folder: &Path, script: &str) -> (i32, String, String) {
    let Output { status, stdout, stderr } = shell(folder, script);
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (status.code().expect("it ended"), text(stdout), text(stderr))
}

/// Each script must fail with its code, name what is expected, and give advice.
fn refused(folder: &Path, cases: &[(&str, i32, &str, &str)]) {
    for (script, code, says, advises) in cases {
        let (found, _, errors) = outcome(folder, script);
        assert_eq!(found, *code, "{script}: {errors}");
        assert!(errors.contains(says), "{script}: {errors}");
        assert!(errors.contains(advises) && errors.contains("hint: "), "{script}: {errors}");
    }
}

fn folder() -> TempDir {
    TempDir::new().expect("a folder")
}

#[test]
fn only_regular_files_are_read_and_no_more_of_them_than_a_robot_needs() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    shell(folder.path(), "mkfifo pipe.toml && mkdir devices pipes empty deep && mkfifo pipes/a.toml");
    for link in ["zero.toml", "zero.urdf", "zero.json", "devices/a.toml"] {
        symlink("/dev/zero", at(link)).expect("a link");
    }
    symlink("b.toml", at("a.toml")).expect("a link");
    symlink("a.toml", at("b.toml")).expect("a link");
    fs::write(at("long.toml"), vec![b'#'; 5 << 20]).expect("written");
    let wide: Vec<u8> = [0xFEFF].into_iter().chain(SMALLEST.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    fs::write(at("wide.toml"), wide).expect("written");
    fs::write(at("bytes.toml"), b"name = 1\nvendor = \"\xC3\x28\"").expect("written");
    fs::write(at("marked.toml"), format!("\u{feff}{SMALLEST}")).expect("written");
    let irregular = "it is a pipe, a device or a socket; expected a regular file";
    let save = "save what it gives to a file";
    refused(
        folder.path(),
        &[
            ("$S place zero.toml --task A:0.1", 1, irregular, save),
            ("$S place zero.json --task A:0.1", 1, irregular, save),
            ("$S place pipe.toml --task A:0.1", 1, irregular, save),
            ("$S place /dev/zero --task A:0.1", 1, irregular, save),
            ("$S map zero.urdf", 1, irregular, save),
            ("$S robots import /dev/zero", 1, irregular, save),
            ("$S robots import pipe.toml", 1, irregular, save),
            ("$S rank --robots devices", 1, irregular, save),
            ("$S rank --robots pipes", 1, irregular, save),
            ("$S rank --robots empty", 1, "no file in this folder ends in .toml", "name a folder of robot files"),
            ("$S place long.toml --task A:0.1", 1, "larger than 4 MiB", "a robot file has some kilobytes"),
            ("$S place wide.toml --task A:0.1", 1, "written in UTF-16; expected UTF-8", "save it as UTF-8"),
            ("$S place bytes.toml --task A:0.1", 1, "line 2 is no UTF-8 text", "is it the right file"),
            ("$S place a.toml --task A:0.1", 1, "its links lead in a circle", "name the file itself"),
            ("$S place empty --task A:0.1", 1, "it is a folder; expected a file", "name a file in it"),
            ("$S place marked.toml/x.toml --task A:0.1", 1, "Not a directory", "is a file, not a folder"),
            ("$S robots show nothing.toml", 1, "No such file", "is the path right"),
        ],
    );
    for file in ["/dev/zero", "devices", "zero.toml", "pipe.toml", "pipes", "/dev/stdin < /dev/zero"] {
        let (code, _, errors) = outcome(folder.path(), &format!("$S robots check {file}"));
        assert!(code == 1 && errors.contains(irregular), "{file}: {errors}");
    }
    let (code, out, errors) = outcome(folder.path(), "$S robots check marked.toml");
    assert!(code == 0 && out.contains("two links can be used"), "{errors}");
}

#[test]
fn a_full_or_closed_terminal_is_no_panic() {
    let folder = folder();
    fs::write(folder.path().join("two.toml"), SMALLEST).expect("written");
    fs::write(folder.path().join("bad.toml"), "name = 1").expect("written");
    // Talk that cannot be written is lost; what the answer is does not depend on it.
    for talk in ["2>/dev/full", "2>&-", "2>/dev/full </dev/null"] {
        for (command, code) in [
            ("$S place two.toml --task A:9", 0),
            ("$S compliance BT200L --joints-deg 0,1,0,0,0,0", 0),
            ("$S robots check two.toml bad.toml", 1),
            ("$S robots import two.toml", 1),
            ("$S place nobody --task A:0.1", 1),
            ("$S place BT200L --task x", 2),
            ("$S --nonsense", 2),
            ("$S rank --robots two.toml --task A:0.1 -o rank.csv", 0),
        ] {
            assert_eq!(outcome(folder.path(), &format!("{command} {talk}")).0, code, "{command} {talk}");
        }
    }
    // An answer that cannot be printed is a failure, and says so where it still can.
    for command in ["place two.toml --task A:0.1", "robots list", "map two.toml --format csv", "robots check two.toml"]
    {
        let (code, _, errors) = outcome(folder.path(), &format!("$S {command} >/dev/full"));
        assert!(code == 1 && errors.contains("cannot write to standard output: No space left"), "{command}: {errors}");
        assert!(errors.contains("hint: -o FILE writes the answer to a file"), "{errors}");
        assert_eq!(outcome(folder.path(), &format!("$S {command} >/dev/full 2>/dev/full")).0, 1, "{command}");
    }
    assert_eq!(outcome(folder.path(), "$S --help >/dev/full").0, 1);
    assert_eq!(outcome(folder.path(), "$S --help | head -n 1; exit ${PIPESTATUS[0]}").0, 0);
    assert_eq!(outcome(folder.path(), "$S robots list >&-").0, 0, "nothing was to be printed");
}

/// Each thread wants 8 MiB of addresses for its stack. With the least room, in steps of 2 MB, in which the program has an answer, there are less than
/// that left, so that no thread is made. (With room for some of many, it is luck whether anything is left for the answer.)
#[test]
fn without_threads_the_answer_is_the_same_on_the_callers() {
    let folder = folder();
    let question = "$S rank --robots BT200L,ZX200U --task A:0.3 --format json";
    let (_, expected, _) = outcome(folder.path(), question);
    let in_least_room = |asked: &str| {
        let limited = format!("(ulimit -v $room; exec {asked}) >answer 2>errors && break");
        let rooms = format!("for room in $(seq 20000 2000 400000); do {limited}; done 2>/dev/null");
        outcome(folder.path(), &format!("{rooms}; cat answer; cat errors >&2"))
    };
    let (code, out, errors) = in_least_room(&format!("{question} --threads 500"));
    assert_eq!((code, &out), (0, &expected), "{errors}");
    assert!(errors.contains("computing on one thread"), "{errors}");
    assert_eq!(in_least_room(&format!("{question} --threads 500 -q")), (0, expected, String::new()));
}

#[test]
fn files_are_checked_before_anything_is_computed() {
    let folder = folder();
    let root = folder.path();
    fs::write(root.join("r.json"), SMALLEST).expect("written");
    fs::write(root.join("r.toml"), SMALLEST).expect("written");
    shell(root, "mkdir folder.csv && ln -s r.json link.json && ln -s b.csv a.csv && ln -s a.csv b.csv && mkdir sub");
    shell(root, "touch locked.csv && chmod 444 locked.csv");
    // What would take minutes: a refusal that comes at once has computed nothing.
    let long = "$S map BT200L --size 10000";
    let name = "x".repeat(300);
    refused(
        root,
        &[
            (&format!("{long} -o m.xlsx"), 2, "map cannot write m.xlsx: expected a name that ends in .svg", "ending"),
            (&format!("{long} -o m.csv -o m"), 2, "map cannot write m: expected", "ending"),
            (&format!("{long} -o no/m.csv"), 1, "cannot write no/m.csv", "there is no folder no; make it first"),
            (&format!("{long} -o r.toml/m.csv"), 1, "Not a directory", "r.toml is a file, not a folder"),
            (&format!("{long} -o folder.csv"), 1, "cannot write folder.csv", "there is a folder of this name"),
            (&format!("{long} -o a.csv"), 1, "cannot write a.csv", "`ls -l` shows where it leads"),
            (&format!("{long} -o /proc/m.csv"), 1, "cannot write /proc/m.csv", "hint: "),
            (&format!("{long} -o locked.csv"), 1, "cannot write locked.csv", "is closed to you for writing"),
            (&format!("{long} -o {name}.csv"), 1, "cannot write xxx", "the name is longer than the system takes"),
            ("$S place r.json --task A:0.1 -o r.json", 2, "the command reads this file", "choose another name"),
            ("$S place r.json --task A:0.1 -o ./sub/../link.json", 2, "the command reads this file", "choose"),
            ("$S rank --robots BT200L,link.json -o r.json", 2, "the command reads this file", "choose another name"),
            ("$S robots import r.toml -o r.toml", 2, "the command reads this file", "choose another name"),
            ("$S robots show r.json -o r.json", 2, "the command reads this file", "choose another name"),
            ("$S robots check r.json -o r.json", 2, "the command reads this file", "choose another name"),
            ("$S compliance r.json --joints-deg 0,0,0,0,0,0 -o r.json", 2, "reads this file", "choose another name"),
            ("$S map r.json -o r.json", 2, "the command reads this file", "choose another name"),
        ],
    );
    for file in ["r.json", "r.toml"] {
        assert_eq!(fs::read_to_string(root.join(file)).expect("still there"), SMALLEST);
    }
    assert!(!root.join("m.csv").exists() && leftovers(root).is_empty(), "{:?}", leftovers(root));
}

/// Files that no test made under this name.
fn leftovers(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    names.filter_map(|name| name.into_string().ok()).filter(|name| name.starts_with('.')).collect()
}

#[test]
fn what_cannot_be_written_is_printed_so_that_it_is_not_lost() {
    let folder = folder();
    let root = folder.path();
    for ending in ["csv", "json", "md", "txt", "parquet", "svg"] {
        symlink("/dev/full", root.join(format!("full.{ending}"))).expect("a link");
    }
    let place = "$S place BT200L --task A:0.3";
    for (ending, format) in
        [("csv", "csv"), ("parquet", "csv"), ("json", "json"), ("md", "md"), ("txt", "table"), ("svg", "table")]
    {
        let (_, expected, _) = outcome(root, &format!("{place} --format {format}"));
        let (code, out, errors) = outcome(root, &format!("{place} -q -o full.{ending}"));
        assert!(code == 1 && errors.contains("No space left on device"), "{ending}: {errors}");
        assert!(errors.contains("hint: there is no room for it; the answer stands on standard output"), "{errors}");
        assert_eq!(out, expected, "{ending}");
    }
    // One file that fails does not keep the others from being written.
    let (code, _, errors) = outcome(root, &format!("{place} -o full.csv -o good.json -o full.md"));
    assert!(code == 1 && errors.contains("wrote good.json") && errors.contains("full.md"), "{errors}");
    assert!(fs::read_to_string(root.join("good.json")).expect("written").contains("deflection_mm"));
    // A file that may not grow: the old one stays, and nothing is left of the new one.
    fs::write(root.join("old.csv"), "old").expect("written");
    let (code, out, errors) = outcome(
        root,
        "trap '' XFSZ; ulimit -f 8; $S map BT200L --size 300 -o old.csv -o new.csv | cat; exit ${PIPESTATUS[0]}",
    );
    assert!(code == 1 && errors.contains("File too large"), "{errors}");
    assert!(out.starts_with("x_m,z_m,deflection_mm\n") && 10_000 < out.lines().count());
    assert_eq!(fs::read_to_string(root.join("old.csv")).expect("still there"), "old");
    assert!(!root.join("new.csv").exists() && leftovers(root).is_empty(), "{:?}", leftovers(root));
}

/// On file systems without nameless files (they are rare) a leftover may stand; the test's own has them.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_leaves_nothing() {
    let folder = folder();
    // The table goes into a pipe before the file: its first line says that the program writes, and the program cannot end,
    // because nobody reads the rest. Whoever runs the tests may ignore signals, as nohup does: the program must not.
    let script = "mkfifo says.csv; exec 3<>says.csv; for signal in TERM HUP KILL; do
        env --default-signal $S map BT200L --size 400 --threads 1 -q -o says.csv -o m.csv & read -r -u 3 line
        ls -l /proc/$!/fd | grep -c \"$PWD/#.*(deleted)\"; kill -$signal $!; wait $! 2>/dev/null
        while read -r -t 0.1 -u 3 line; do :; done
        done; ls -A";
    let (_, out, errors) = outcome(folder.path(), script);
    assert_eq!(out, "1\n1\n1\nsays.csv\n", "one nameless file is open, and none is left: {errors}");
}

#[test]
fn a_check_is_written_and_formatted_like_every_answer() {
    let folder = folder();
    let root = folder.path();
    fs::write(root.join("good.toml"), SMALLEST).expect("written");
    fs::write(root.join("bad.toml"), SMALLEST.replace("1000", "1").replace("serial", "cereal")).expect("written");
    let (code, out, errors) = outcome(root, "$S robots check . --format json -o check.csv");
    assert!(code == 1 && errors.contains("1 of the files cannot be used"), "{errors}");
    let found: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(
        (&found[0]["file"], &found[0]["usable"], &found[0]["robot"]),
        (&"./bad.toml".into(), &false.into(), &serde_json::Value::Null)
    );
    assert_eq!((&found[0]["faults"][0]["line"], &found[0]["faults"][0]["key"]), (&2.into(), &"architecture".into()));
    assert_eq!((&found[1]["usable"], &found[1]["robot"]), (&true.into(), &"two links".into()));
    assert_eq!(found[1]["doubts"].as_array().map(Vec::len), Some(1), "no payload: {found}");
    let csv = fs::read_to_string(root.join("check.csv")).expect("written");
    assert!(csv.starts_with("file,usable,robot,line,key,message\n./bad.toml,false,,2,architecture,"), "{csv}");
    let (code, _, errors) = outcome(root, "$S robots check good.toml -o check.svg");
    assert!(code == 2 && errors.contains("robots check cannot write check.svg"), "{errors}");
    let (code, out, _) = outcome(root, "$S robots check good.toml --format md");
    assert!(code == 0 && out.contains("| ") && out.contains("good.toml"), "{out}");
}

/// ESC, BEL, C1, marks of direction and line breaks, in every place where a file has a text.
#[test]
fn no_text_from_a_file_steers_a_terminal_or_forges_a_line() {
    let folder = folder();
    let root = folder.path();
    let hostile = "\u{1b}[2J\u{7}\u{9b}31m\u{202e}\u{2066}\\n/x.toml: KUKA can be used\\u001b]0;t\\u0007";
    let raw = |text: &str| text.contains(|c: char| c != '\n' && stiffarm::plain::steers(c));
    let escaped = |text: &str| {
        let escape =
            |c: char| if c.is_ascii() && !c.is_control() { c.to_string() } else { format!("\\u{:04x}", u32::from(c)) };
        text.chars().map(escape).collect::<String>()
    };
    let hostile = escaped(hostile);
    let texts = [
        ("name", SMALLEST.replace("two links", &hostile)),
        ("vendor", format!("vendor = \"{hostile}\"\n{SMALLEST}")),
        ("source", format!("{SMALLEST}\n[source]\nlimits = \"{hostile}\"\n")),
        ("key", format!("\"{hostile}\" = 1\n{SMALLEST}")),
        ("value", SMALLEST.replace("serial", &hostile)),
        ("source key", format!("{SMALLEST}\n[source]\n\"{hostile}\" = \"a\"\n")),
    ];
    for (place, text) in &texts {
        fs::write(root.join("r.toml"), text).expect("written");
        for command in ["robots check", "robots show", "rank --task A:0.1 --robots"] {
            let (code, out, errors) = outcome(root, &format!("$S {command} r.toml"));
            assert!(code == 1 && !raw(&out) && !raw(&errors), "{place}: {out}{errors}");
            assert!(errors.lines().all(|line| !line.starts_with("/x.toml")), "{place}: {errors}");
        }
    }
    let example = include_str!("../../../docs/examples/example_150.urdf");
    for attribute in ["Example 150", "link_3", "joint_3"] {
        let hostile = "&#x9b;31m&#x202e;&#10;/x.toml: KUKA can be used";
        fs::write(root.join("r.urdf"), example.replace(&format!("\"{attribute}\""), &format!("\"{hostile}\"")))
            .expect("written");
        for command in ["robots check r.urdf", "robots import r.urdf", "place r.urdf --task A:0.5"] {
            let (_, out, errors) = outcome(root, &format!("$S {command}"));
            assert!(!raw(&out) && !raw(&errors), "{attribute}: {out}{errors}");
            let forged = |line: &str| line.starts_with("/x.toml");
            assert!(!out.lines().any(forged) && !errors.lines().any(forged), "{attribute}: {errors}");
        }
    }
    // Names of files, too.
    let name = "a\u{1b}[2J\n\u{9b}x.toml: KUKA can be used\u{202e}.toml";
    fs::write(root.join(name), SMALLEST).expect("written");
    fs::write(root.join(format!("b{name}")), SMALLEST.replace("1000", "900")).expect("written");
    for command in [
        "robots check *KUKA*",
        "rank --robots . --task A:0.1",
        "robots check *KUKA* --format csv",
        "robots check *KUKA* --format json",
    ] {
        let (_, out, errors) = outcome(root, &format!("rm -f r.*; $S {command}"));
        assert!(!raw(&out) && !raw(&errors) && out.contains("u{1b}"), "{out}{errors}");
    }
}

#[test]
fn no_spreadsheet_runs_a_name_and_no_page_its_tags() {
    let folder = folder();
    let root = folder.path();
    let name = "=cmd|' /C calc'!A0<img src=x>`[a](b)&amp;";
    fs::write(root.join("r.toml"), SMALLEST.replace("two links", name)).expect("written");
    let (_, csv, _) = outcome(root, "$S rank --robots r.toml --task A:0.1 --format csv");
    assert!(csv.contains(",'=cmd|' /C calc'!A0<img") && !csv.contains(",=cmd"), "{csv}");
    for command in ["rank --task A:0.1 --robots", "robots show", "place --task A:0.1", "map"] {
        let (_, text, _) = outcome(root, &format!("$S {command} r.toml --format md"));
        assert!(text.contains("=cmd\\|") && !text.contains("<img") && text.contains("&lt;img"), "{text}");
    }
    let (_, json, _) = outcome(root, "$S place r.toml --task A:0.1 --format json");
    assert_eq!(
        serde_json::from_str::<serde_json::Value>(&json).expect("JSON")["robot"],
        name,
        "programs get it as it is"
    );
}

#[test]
fn an_error_is_no_longer_than_a_page() {
    let folder = folder();
    let root = folder.path();
    let keys: String = (0..8_000).map(|i| format!("unknown_{i} = 1\n")).collect();
    fs::write(root.join("keys.toml"), keys + SMALLEST).expect("written");
    let (code, _, errors) = outcome(root, "$S robots check keys.toml");
    assert!(code == 1 && errors.len() < 8_000, "{} bytes", errors.len());
    assert!(
        errors.contains("keys.toml:20: unknown_19") && errors.contains("keys.toml: and 7980 faults more"),
        "{errors}"
    );
    let digits = "1".repeat(20_000);
    for value in
        [digits.clone(), format!("0x{digits}"), format!("{digits}.5"), format!("\"{digits}\""), format!("[{digits}]")]
    {
        for key in ["architecture = \"serial\"", "l2_mm = 1000"] {
            let (name, _) = key.split_once(" = ").expect("a key");
            fs::write(root.join("long.toml"), SMALLEST.replace(key, &format!("{name} = {value}"))).expect("written");
            let (code, _, errors) = outcome(root, "$S robots check long.toml");
            assert!(code == 1 && errors.len() < 1_000, "{key}: {} bytes", errors.len());
        }
    }
    let long = "x".repeat(201);
    for text in [SMALLEST.replace("two links", &long), format!("vendor = \"{long}\"\n{SMALLEST}")] {
        fs::write(root.join("long.toml"), text).expect("written");
        let (code, _, errors) = outcome(root, "$S place long.toml --task A:0.1");
        assert!(code == 1 && errors.contains("a name of 201 letters; expected at most 200"), "{errors}");
    }
    fs::write(root.join("long.toml"), SMALLEST.replace("two links", &long[1..])).expect("written");
    assert_eq!(outcome(root, "$S place long.toml --task A:0.1 -q -o a.svg").0, 0);
}

#[test]
fn every_refusal_says_what_to_do() {
    let folder = folder();
    refused(
        folder.path(),
        &[
            ("$S rank --robots 'KR[*'", 2, "'KR[*' is not a pattern", "[abc] for one of these"),
            ("$S rank --robots 'a***b'", 2, "is not a pattern", "* stands for any letters"),
            ("$S study --range ..2", 2, "takes both ends", "--help behind the command"),
            ("$S map BT200L --size 30000", 1, "at most 100000000 cells", "try --size 1000"),
            ("$S map BT200L --model spatial --size 9000", 1, "at most 5000000 cells", "try --size 1000"),
        ],
    );
}

#[test]
fn an_import_names_the_axis_it_turned_about_and_advises_nothing_that_was_done() {
    let folder = folder();
    let root = folder.path();
    let example = include_str!("../../../docs/examples/example_150.urdf");
    fs::write(root.join("a.urdf"), example).expect("written");
    fs::write(root.join("back.urdf"), example.replace("rpy=\"0 1.5707963", "rpy=\"0 -1.5707963")).expect("written");
    let lever = "<link name=\"lever\"/><joint name=\"l\" type=\"revolute\"><parent link=\"link_2\"/><child link=\"lever\"/>\
                 <axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\"/><mimic joint=\"joint_3\"/></joint></robot>";
    fs::write(root.join("lever.urdf"), example.replace("</robot>", lever)).expect("written");
    let report = |arguments: &str| outcome(root, &format!("$S robots import {arguments}")).2;
    // Axis 6 is the flange's x: z comes there by a quarter turn about y. Tool0 looks back: half a turn about its own x.
    let flange = report("a.urdf --tip flange");
    assert!(flange.contains("'flange', turned by 90.0 deg about its y axis so that"), "{flange}");
    let back = report("back.urdf --tip tool0");
    assert!(back.contains("'tool0', turned by 180.0 deg about its x axis so that"), "{back}");
    assert!(report("lever.urdf").contains("it may be a parallelogram arm; then import it as quasi-serial"));
    assert!(!report("lever.urdf --architecture quasi-serial").contains("then import it"));
    let link_5 = "--base base_link --tip link_5";
    assert!(report("a.urdf --tip link_5").contains("--base LINK"));
    assert!(!report(&format!("a.urdf {link_5}")).contains("--base LINK"), "{}", report(&format!("a.urdf {link_5}")));
}

/// The bound holds for the worst direction only.
#[test]
fn a_map_tells_no_bound_above_its_least_value() {
    let folder = folder();
    let number = |text: &str, row: &str| -> f64 {
        let line = text.lines().find(|line| line.trim_start().starts_with(row)).expect("a row");
        line.split_whitespace().nth(1).expect("a number").parse().expect("a number")
    };
    let (_, worst, _) = outcome(folder.path(), "$S map BT200L --size 60");
    assert!(number(&worst, "bound") <= number(&worst, "least"), "{worst}");
    for more in ["", " --component along"] {
        let (_, text, _) = outcome(folder.path(), &format!("$S map BT200L --size 60 --direction-deg 0{more}"));
        assert!(!text.contains("bound") && 0.0 <= number(&text, "least"), "{text}");
    }
}
