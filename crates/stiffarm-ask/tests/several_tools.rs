//! Does each tool of a path mill with its own process and length, and does one program stop where they are changed?

use stiffarm::catalogue::{ProcessFile, paper_robots, read_process};
use stiffarm::program::Language;
use stiffarm::robot::Robot;
use stiffarm::toolpath::{Format, Move, Original, ReadOptions, Steps, read};
use stiffarm::watch::Watch;
use stiffarm_ask::answer::{Bodies, ByToolAnswer, MillAnswer, MillAnswerError};
use stiffarm_ask::request::{Pair, Refusal, Request, Spelling, Verb};

fn robot() -> Robot {
    paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("a robot of the paper")
}

fn request(path: &str, options: &[(&str, &str)]) -> Result<Request, Refusal> {
    let usual = [("path", path), ("robot", "it"), ("tool-mm", "200,0,150,0,60,0"), ("step-mm", "50")];
    let pair = |(name, text): &(&str, &str)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed };
    let is_usual = |(name, _): &&(&str, &str)| options.iter().all(|(other, _)| other != name);
    let pairs = usual.iter().filter(is_usual).chain(options).flat_map(|(name, text)| {
        // As the program cuts lists.
        let parts = if ["process", "tool-lengths-mm"].contains(name) { text.split(',').collect() } else { vec![*text] };
        parts.into_iter().map(|part| pair(&(name, part))).collect::<Vec<_>>()
    });
    Request::read(Verb::Mill, &pairs.collect::<Vec<_>>(), Spelling::Typed)
}

/// The largest error, m.
fn worst(answer: &MillAnswer) -> f64 {
    answer.followed().unwrap_or_else(|| panic!("{:?}", answer.reason())).worst.0
}

/// A path of three sections with two tools, a process of each, and what else is asked of it.
fn by_tool(text: &str, options: &[(&str, &str)]) -> Result<ByToolAnswer, MillAnswerError> {
    let processes = [(1, constant("one.toml", 300.0)), (2, constant("two.toml", 40.0))];
    let processes = processes.map(|(tool, (name, process))| (tool, name, process));
    let asked = request("two.nc", options)?;
    ByToolAnswer::of(
        &asked,
        &robot(),
        ("two.nc", &moves_of(text, Format::GCode)),
        (&processes, &Bodies::default()),
        Watch::nobody(),
    )
}

fn constant(name: &str, newtons: f64) -> (String, ProcessFile) {
    let text = format!("[constant]\nfeed_n = {newtons}\nacross_n = -20\naxial_n = 50\n");
    (name.into(), read_process(&text, name).expect("a process"))
}

fn moves_of(text: &str, format: Format) -> Vec<Move> {
    let mut moves: Vec<Move> = Vec::new();
    let (options, mut each) = (ReadOptions::default(), |one: &Move| moves.push(*one));
    read(&mut text.as_bytes(), "path", format, &options, &mut each, &mut |_| Ok(())).expect("read");
    moves
}

const HEAD: &str = "G21 G90 G94\n";
const ONE: &str = "G0 X0 Y0 Z5\nG1 Z0 F500\nG1 X100\nG0 Z5\n";
const OTHER: &str = "G0 X0 Y50 Z5\nG1 Z0 F500\nG1 X50\nG0 Z5\n";
const BY_TOOL: [(&str, &str); 3] =
    [("at", "1.6,0,0.8"), ("process", "T1=one.toml,T2=two.toml"), ("tool-lengths-mm", "T1=30,T2=95")];

/// Each section is what the same cuts alone are, under the force of their own tool at the tip that its length gives.
#[test]
fn each_tool_of_a_path_mills_under_its_own_process_with_its_own_length() {
    let file = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{OTHER}T1 M6\n{OTHER}M2\n");
    let answer = by_tool(&file, &BY_TOOL).expect("an answer");
    assert_eq!(answer.sections.iter().map(|section| section.tool).collect::<Vec<_>>(), [1, 2, 1]);
    for (section, (tool, (cuts, length, newtons))) in
        answer.sections.iter().zip([("1", (ONE, 30.0, 300.0)), ("2", (OTHER, 95.0, 40.0)), ("1", (OTHER, 30.0, 300.0))])
    {
        // By another way: one tool at the tip that tool-mm says, its force as such.
        let (s, c) = 60.0_f64.to_radians().sin_cos();
        let (tool_mm, force) =
            (format!("{},0,{},0,60,0", 200.0 + length * s, 150.0 + length * c), format!("{newtons},-20,50"));
        let options = [("at", "1.6,0,0.8"), ("tool-mm", tool_mm.as_str()), ("force-n", force.as_str())];
        let asked = request("two.nc", &options).expect("a question");
        let moves = moves_of(&format!("{HEAD}{cuts}M2\n"), Format::GCode);
        let alone = MillAnswer::of(&asked, &robot(), ("two.nc".into(), moves), None, Watch::nobody()).expect("alone");
        assert!((worst(&section.milled) - worst(&alone)).abs() < 1e-12, "T{tool}: the same cuts");
    }
    let (of, largest) = answer.worst().expect("followed");
    let expected = answer.sections.iter().map(|section| worst(&section.milled)).fold(0.0, f64::max);
    assert!(of.tool == 1 && largest == expected);
    let json = answer.json();
    assert_eq!((json["worst_tool"].as_u64(), json["by_tool"][1]["tool_number"].as_u64()), (Some(1), Some(2)));
    assert!(
        (json["by_tool"][1]["worst_mm"].as_f64().expect("mm") - worst(&answer.sections[1].milled) * 1e3).abs() < 1e-9
    );
    let rows = answer.rows();
    let counts = answer.sections.iter().map(|section| section.milled.stations.len());
    assert_eq!(rows.columns()[0].name, "tool_number");
    let tools = rows.iter().map(|row| row[0].to_string()).collect::<Vec<_>>();
    let expected = ["1", "2", "1"].iter().zip(counts).flat_map(|(tool, count)| std::iter::repeat_n(*tool, count));
    assert!(tools.iter().map(String::as_str).eq(expected), "{tools:?}");
    // One program of all: it stops twice.
    for (language, stop) in [(Language::Krl, "HALT"), (Language::Rapid, "    Stop;"), (Language::Ls, "  PAUSE")] {
        let text = answer.program(language).expect("a program");
        assert_eq!(text.lines().filter(|line| line.contains(stop)).count(), 2, "{text}");
    }
}

/// What is said of a tool bears its number, what is said of all stands once, and the first word is that of all together.
#[test]
fn what_is_said_of_one_tool_is_not_said_of_the_path() {
    let wide = "G0 X-300 Y-300 Z5\nG1 Z0 F500\nG1 X300\nY300\nG0 Z5\n";
    let file = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{wide}M2\n");
    let answer = by_tool(&file, &[&BY_TOOL[..], &[("tolerance-mm", "5")]].concat()).expect("an answer");
    let notes = answer.notes();
    let errs = |tool: &str| {
        let line = notes.lines().find(|line| line.starts_with(&format!("{tool}: Along this path the geometry")));
        line.unwrap_or_else(|| panic!("{tool}: {notes}")).to_owned()
    };
    assert_ne!(errs("T1")[4..], errs("T2")[4..]);
    assert_eq!(notes.matches("all six drives compliant").count(), 1, "{notes}");
    let headline = answer.headline();
    let verdict = answer.verdict().expect("a tolerance").in_words();
    assert!(
        headline.sentences[0].starts_with("The tools of KUKA KR 210 R2700 extra are pushed off by "),
        "{headline:?}"
    );
    assert!(headline.sentences[0].ends_with(&format!("tolerance 5 mm, all tools: {verdict}.")), "{headline:?}");
    assert!(headline.sentences.iter().any(|says| says.starts_with("T2: ")), "{headline:?}");
    // More than it may carry, whatever a tool cuts.
    let heavy = [&BY_TOOL[..], &[("tolerance-mm", "5"), ("tool-mass-kg", "250")]].concat();
    let heavy = by_tool(&file, &heavy).expect("an answer");
    assert_eq!(heavy.json()["verdict"], "load exceeded");
    assert_eq!(heavy.headline().outcome.word(), "load exceeded");
}

/// Where one tool of several is judged, every sentence says so.
#[test]
fn what_one_tool_alone_mills_is_said_of_it_alone() {
    let file = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{OTHER}M2\n");
    let options = [("at", "1.6,0,0.8"), ("force-n", "300,-20,50"), ("only-tool", "1"), ("tolerance-mm", "5")];
    let asked = request("two.nc", &options).expect("a question");
    let moves = moves_of(&file, Format::GCode);
    let answer = MillAnswer::of(&asked, &robot(), ("two.nc".into(), moves), None, Watch::nobody()).expect("alone");
    let says = &answer.headline().sentences[0];
    assert!(says.contains("along two.nc (tool 1 alone)"), "{says}");
    assert_eq!((&answer.json()["path"], &answer.json()["only_tool"]), (&"two.nc".into(), &1.into()));
}

/// The path's own file holds of each tool what the file of its cuts alone holds, and nothing else is changed.
#[test]
fn the_file_of_a_path_is_written_back_with_the_cuts_of_all_tools_led_aside() {
    let steps = Steps { longest: 0.05, ..Steps::USUAL };
    let options = ReadOptions::default();
    let compensated = [&BY_TOOL[..], &[("compensate", "true")]].concat();
    let whole = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{OTHER}T1 M6\n{OTHER}M2\n");
    let written = |text: &str, write: &dyn Fn(Original, &mut Vec<u8>)| {
        let (mut input, mut output) = (text.as_bytes(), Vec::new());
        write(Original { input: &mut input, file: "two.nc", format: Format::GCode, options: &options }, &mut output);
        String::from_utf8(output).expect("text")
    };
    let answer = by_tool(&whole, &compensated).expect("an answer");
    let all = written(&whole, &|original, output| {
        answer.rewritten(original, &steps, output).expect("written");
    });
    let alone = |cuts: &str, tool: &str| {
        let text = format!("{HEAD}{tool} M6\n{cuts}M2\n");
        let asked = request("two.nc", &[&compensated[..], &[("only-tool", &tool[1..])]].concat()).expect("a question");
        let (name, force) = if tool == "T1" { ("one.toml", 300.0) } else { ("two.toml", 40.0) };
        let process = Some(constant(name, force));
        let moves = moves_of(&text, Format::GCode);
        let answer = MillAnswer::of(&asked, &robot(), ("two.nc".into(), moves), process, Watch::nobody());
        let answer = answer.expect("an answer");
        let text = written(&text, &|original, output| {
            answer.rewritten(original, &steps, output).expect("written");
        });
        let (_, behind) = text.split_once("M6\n").expect("a tool change");
        format!("{tool} M6\n{}", behind.strip_suffix("M2\n").expect("the end"))
    };
    let sections = [alone(ONE, "T1"), alone(OTHER, "T2"), alone(OTHER, "T1")].concat();
    assert!(all.ends_with(&format!("{sections}M2\n")), "{all}\n{sections}");
    assert!(sections.lines().count() > 3 * 5 && !all.contains(ONE), "{all}");
    // A path that was not milled by these tools has no such file.
    let other = whole.replace("X100", "X90");
    let (mut input, mut output) = (other.as_bytes(), Vec::new());
    let original = Original { input: &mut input, file: "two.nc", format: Format::GCode, options: &options };
    let refused = answer.rewritten(original, &steps, &mut output).expect_err("another path").to_string();
    assert!(refused.contains("line 5: what was milled is not found in the file"), "{refused}");
    let plain = by_tool(&whole, &BY_TOOL).expect("an answer");
    let mut input = whole.as_bytes();
    let original = Original { input: &mut input, file: "two.nc", format: Format::GCode, options: &options };
    let refused = plain.rewritten(original, &steps, &mut Vec::new()).expect_err("not compensated").to_string();
    assert!(refused.contains("without --compensate"), "{refused}");
}

/// What compensation leaves of all tools together is judged, too: no better than of any of them, and of tools that cut alike as of one.
#[test]
fn the_compensated_path_of_all_tools_has_a_verdict() {
    let options = [&BY_TOOL[..], &[("compensate", "true"), ("tolerance-mm", "0.35")]].concat();
    let file = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{OTHER}T1 M6\n{OTHER}M2\n");
    let answer = by_tool(&file, &options).expect("an answer");
    let all = &answer.json()["compensation"];
    let number = |of: &serde_json::Value, key: &str| of[key].as_f64().unwrap_or_else(|| panic!("{key}: {of}"));
    let sections = answer.json()["by_tool"].as_array().expect("sections").clone();
    let of_sections = |key: &str| sections.iter().map(|one| number(&one["compensation"], key)).collect::<Vec<_>>();
    let largest = |key: &str| of_sections(key).into_iter().fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(number(all, "largest_correction_mm"), largest("largest_correction_mm"));
    for key in ["left_median_mm", "left_p95_mm"] {
        assert!(largest(key) <= number(all, key), "{key}: {all}");
    }
    let least = of_sections("probability").into_iter().fold(1.0, f64::min);
    // Drives that are off are so for all tools: who holds it with the worst, mostly holds it.
    let probability = number(all, "probability");
    assert!(probability <= least && 0.9 * least < probability && least < 1.0, "{probability} {least}");
    assert!(answer.notes().contains("tolerance 0.35 mm, all tools, compensated: "), "{}", answer.notes());
    let one = by_tool(&format!("{HEAD}T1 M6\n{ONE}T2 M6\n{ONE}M2\n"), &options).expect("an answer");
    assert!(one.json()["compensation"]["verdict"].is_string());
    assert!(by_tool(&file, &BY_TOOL).expect("an answer").json()["compensation"].is_null());
}

/// What of several tools is missing or does not go together is refused by its name.
#[test]
fn several_tools_need_a_process_a_length_and_a_place_each() {
    let with =
        |name: &str, text: &'static str| BY_TOOL.map(|(other, old)| (other, if other == name { text } else { old }));
    let file = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{OTHER}M2\n");
    let three = format!("{HEAD}T1 M6\n{ONE}T2 M6\n{OTHER}T3 M6\n{ONE}M2\n");
    let refused = |file: &str, options: &[(&str, &str)]| by_tool(file, options).expect_err("refused").to_string();
    for (message, says) in [
        (refused(&three, &BY_TOOL), "process has no file for T3, from line 14"),
        (refused(&format!("{HEAD}T1 M6\n{ONE}M2\n"), &BY_TOOL), "process names T2, which never feeds along the path"),
        (refused(&file, &with("tool-lengths-mm", "T1=30")), "tool-lengths-mm has no length of T2"),
        (refused(&file, &with("tool-lengths-mm", "T1=30,T1=40")), "tool-lengths-mm is given twice for T1"),
        (refused(&file, &BY_TOOL[..2]), "tool-lengths-mm is missing"),
        (refused(&file, &BY_TOOL[1..]), "at is missing"),
        (refused(&file, &with("process", "T1=one.toml,two.toml")), "process names one file for all tools"),
        (refused(&file, &with("process", "T1=one.toml,T1=two.toml")), "process is given twice for T1"),
        (refused(&file, &with("process", "one.toml,two.toml")), "process names several files"),
        (refused(&file, &[&BY_TOOL[..], &[("only-tool", "3")]].concat()), "process has no file for T3"),
        (refused(&file, &[&BY_TOOL[..], &[("stock-mm", "0..1,0..1,0..1")]].concat()), "stock-mm follows one tool"),
        (refused(&file, &[&BY_TOOL[..], &[("pin", "0@1")]].concat()), "pin"),
    ] {
        assert!(message.contains(says), "{message}: {says}");
    }
    // One process is that of one tool, whose length it takes.
    let one = request("two.nc", &with("process", "one.toml")).expect("a question");
    assert!(!one.mills_by_tool() && one.given_process().as_deref() == Some("one.toml"));
    let moves = moves_of(&format!("{HEAD}T2 M6\n{ONE}M2\n"), Format::GCode);
    let process = Some(constant("one.toml", 300.0));
    let answer = MillAnswer::of(&one, &robot(), ("two.nc".into(), moves), process, Watch::nobody()).expect("an answer");
    assert!((answer.flange_from_tool.translation.z - (0.150 + 0.095 * 0.5)).abs() < 1e-12);
    // Beside only-tool the process and the length are those of the tool that mills.
    let only = request("two.nc", &[&BY_TOOL[..], &[("only-tool", "2")]].concat()).expect("a question");
    assert_eq!((only.mills_by_tool(), only.given_process().as_deref()), (false, Some("two.toml")));
    let tip = only.tip_of(Some(2)).expect("a tip").translation;
    assert!((tip.z - (0.150 + 0.095 * 0.5)).abs() < 1e-12, "half of the length along the leaning tool: {tip}");
}

/// APT names its tools by LOADTL, LOAD/TOOL and LOAD.
#[test]
fn a_tool_change_of_apt_is_one() {
    let cut =
        |y: &str| format!("RAPID\nGOTO/0,{y},5\nFEDRAT/500,MMPM\nGOTO/0,{y},0\nGOTO/50,{y},0\nRAPID\nGOTO/50,{y},5\n");
    for [first, second] in [["LOADTL/1", "LOADTL/2"], ["LOAD/TOOL,1", "LOAD/TOOL,2"], ["LOADTL/1,1", "LOADTL/2,2"]] {
        let text = format!("UNITS/MM\n{first}\n{}{second}\n{}FINI\n", cut("0"), cut("50"));
        let moves = moves_of(&text, Format::Apt);
        let feeds: Vec<Option<u32>> = moves.iter().filter(|one| one.feed.is_some()).map(|one| one.given.tool).collect();
        assert_eq!(feeds, [Some(1), Some(1), Some(2), Some(2)], "{first}");
        let asked = request("two.apt", &[("at", "1.6,0,0.8"), ("force-n", "100")]).expect("a question");
        let refused = MillAnswer::of(&asked, &robot(), ("two.apt".into(), moves), None, Watch::nobody());
        let refused = refused.expect_err("two tools").to_string();
        assert!(refused.contains("T1 from line 6, T2 from line 14"), "{refused}");
    }
}
