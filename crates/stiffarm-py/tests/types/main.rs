//! `stiffarm/types.py` says what the tables of the library say: which options each verb takes, and which keys its answers have, all of what
//! type.
//!
//! `STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types` writes it anew.

mod answers;
mod samples;

use std::fmt::Write;
use std::path::Path;

use answers::{Fields, class};
use serde_json::Value;

use stiffarm_ask::request::{Absent, Kind, Setting, Verb};

/// What is an argument of its own in Python.
const NOT_KEYWORDS: [&str; 5] = ["robot", "robots", "joints-deg", "data", "path"];
const NONE: &[&str] = &[];
const HEAD: &str = r#""""What goes in and what comes out, for type checkers: the options of every verb, and the keys of every answer.

Written by ``STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types`` from the tables of the library; not to be edited.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, TypedDict

import numpy.typing as npt

from ._given import RangeLike
"#;

#[test]
fn the_types_are_those_of_the_tables() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/stiffarm/types.py");
    let expected = written();
    if std::env::var_os("STIFFARM_WRITE").is_some() {
        std::fs::write(&path, &expected).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "the tables have changed: STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types");
}

fn written() -> String {
    let mut text = HEAD.to_owned();
    let classes = [
        ("Robots", "robots", Verb::List, NONE),
        ("Compliance", "compliance", Verb::Compliance, NONE),
        ("Place", "place", Verb::Place, &["task"]),
        ("Rank", "rank", Verb::Rank, &["task"]),
        ("Map", "map", Verb::Map, NONE),
        ("Study", "study", Verb::Study, NONE),
        ("Compare", "compare", Verb::Compare, &["a", "b"]),
        ("Identify", "identify", Verb::Identify, NONE),
        ("Measure", "measure", Verb::Measure, &["geometry"]),
        ("Calibrate", "calibrate", Verb::Calibrate, NONE),
        ("Verify", "verify", Verb::Verify, NONE),
        ("Modes", "modes", Verb::Modes, NONE),
        ("Chatter", "chatter", Verb::Chatter, &["process", "feed"]),
        ("Mill", "mill", Verb::Mill, NONE),
        // A sweep takes several forces.
        ("Sweep", "cluster.sweep", Verb::Place, &["task", "force-n"]),
    ];
    for (name, function, verb, own) in classes {
        writeln!(text, "\n\nclass {name}Options(TypedDict, total=False):").unwrap();
        writeln!(text, "    \"\"\"Keywords of `stiffarm.{function}`.\"\"\"").unwrap();
        let is_keyword = |name: &str| !NOT_KEYWORDS.contains(&name) && !own.contains(&name);
        for setting in verb.settings().filter(|setting| is_keyword(setting.name) && !setting.is_of_figures()) {
            writeln!(text, "\n    {}: {}", setting.keyword(), python_type(setting)).unwrap();
            writeln!(text, "    \"\"\"{}\"\"\"", wrapped(&format!("{}.", setting.described()))).unwrap();
        }
    }
    write_answers(&mut text);
    text
}

/// A class for every kind of object that an answer has.
fn write_answers(text: &mut String) {
    let (placements, rankings, maps) = (samples::placements(), samples::rankings(), samples::maps());
    let (studies, compliances, comparisons) = (samples::studies(), samples::compliances(), samples::comparisons());
    let schemas = Fields::of(placements.iter().chain(&rankings).chain(&maps).map(|answer| &answer["schema"]));
    class(text, ("Schema", "TypedDict"), "What a program must know to read an answer.", &schemas, &[]);

    // One placement has the same keys wherever it stands.
    let rows = rankings.iter().flat_map(|ranking| ranking["rows"].as_array().unwrap());
    let cells: Vec<Value> = rows.clone().flat_map(|row| row["cells"].as_array().unwrap().clone()).collect();
    let zones: Vec<Value> = maps.iter().map(|map| map["zone"].clone()).filter(Value::is_object).collect();
    let sides: Vec<Value> = comparisons.iter().flat_map(|found| [found["a"].clone(), found["b"].clone()]).collect();
    let bare = |answer: &Value| {
        let mut fields = answer.as_object().unwrap().clone();
        fields.shift_remove("schema");
        Value::Object(fields)
    };
    let placed: Vec<Value> = placements.iter().chain(&cells).chain(&zones).chain(&sides).map(bare).collect();
    let placed = Fields::of(&placed);
    let within = [("cell", "CellDict"), ("resolution", "Resolution"), ("faces", "FaceDict"), ("advice", "AdviceDict")];
    class(text, ("CellDict", "TypedDict"), "A cell as it was asked for.", placed.under("cell"), &[]);
    class(text, ("Resolution", "TypedDict"), "How finely a place was looked for.", placed.under("resolution"), &[]);
    class(text, ("FaceDict", "TypedDict"), "One face of a part.", placed.under("faces"), &[]);
    let about = "What a tolerance says of force, stiffness and size.";
    class(
        text,
        ("LargestZone", "TypedDict"),
        "The largest zone that passes.",
        placed.under("advice").under("largest_zone"),
        &[],
    );
    class(text, ("AdviceDict", "TypedDict"), about, placed.under("advice"), &[("largest_zone", "LargestZone")]);
    text.push_str("\n\n_Pass = TypedDict(\"_Pass\", {\"pass\": \"bool | None\"})\n");
    let about = "One placement, of rankings and maps; `pass` says whether the tolerance is kept.";
    class(text, ("Placed", "_Pass"), about, &placed, &within);
    let with_schema = [("schema", "Schema")];
    writeln!(
        text,
        "\n\nclass PlacementDict(Placed):\n    \"\"\"`stiffarm.Placement.to_dict`.\"\"\"\n\n    schema: Schema"
    )
    .unwrap();

    let ranking = Fields::of(&rankings);
    class(text, ("RankingRow", "TypedDict"), "One robot of a ranking.", ranking.under("rows"), &[("cells", "Placed")]);
    class(text, ("Winner", "TypedDict"), "Who is best at a task.", ranking.under("winners"), &[]);
    let within = [("rows", "RankingRow"), ("winners", "Winner"), with_schema[0]];
    class(text, ("RankingDict", "TypedDict"), "`stiffarm.Ranking.to_dict`.", &ranking, &within);

    let within = [("a", "Placed"), ("b", "Placed"), with_schema[0]];
    class(text, ("ComparisonDict", "TypedDict"), "`stiffarm.Comparison.to_dict`.", &Fields::of(&comparisons), &within);

    let study = Fields::of(&studies);
    class(text, ("StudyRow", "TypedDict"), "One contender at one size.", study.under("rows"), &[]);
    class(text, ("Boundary", "TypedDict"), "A size at which the better one changes.", study.under("boundaries"), &[]);
    class(text, ("StudyMark", "TypedDict"), "A robot with its task among what was studied.", study.under("mark"), &[]);
    let within = [("rows", "StudyRow"), ("boundaries", "Boundary"), ("mark", "StudyMark"), with_schema[0]];
    class(text, ("StudyDict", "TypedDict"), "`stiffarm.Study.to_dict`.", &study, &within);

    let within = [("zone", "Placed"), with_schema[0]];
    class(text, ("MapDict", "TypedDict"), "`stiffarm.Map.to_dict`.", &Fields::of(&maps), &within);
    let identification = Fields::of(&samples::identifications());
    class(text, ("IdentifiedDrive", "TypedDict"), "What is found of a drive.", identification.under("drives"), &[]);
    let about = "What is found of what springs besides the drives.";
    class(text, ("FurtherSpring", "TypedDict"), about, identification.under("springs"), &[]);
    class(text, ("TriedModel", "TypedDict"), "A model that was tried.", identification.under("models"), &[]);
    let about = "What remains of a row of the measurements.";
    class(text, ("ReadingRemainder", "TypedDict"), about, identification.under("residuals"), &[]);
    let about = "What is found of a gravity compensator.";
    class(text, ("FoundCompensator", "TypedDict"), about, identification.under("compensator"), &[]);
    let about = "What measurements make of the prior of a drive.";
    class(text, ("UpdatedDrive", "TypedDict"), about, identification.under("posterior"), &[]);
    let within = [
        ("drives", "IdentifiedDrive"),
        ("springs", "FurtherSpring"),
        ("compensator", "FoundCompensator"),
        ("posterior", "UpdatedDrive"),
        ("models", "TriedModel"),
        ("residuals", "ReadingRemainder"),
        with_schema[0],
    ];
    let about = "`stiffarm.Identification.to_dict`.";
    class(text, ("IdentificationDict", "TypedDict"), about, &identification, &within);

    write_plans(text);
    write_readings(text);
    write_paths(text);
    write_swings(text);
    let cuts = Fields::of(&samples::cuts());
    class(
        text,
        ("Lobe", "TypedDict"),
        "From which depth a cut swings at a speed of the spindle.",
        cuts.under("lobes"),
        &[],
    );
    let within = [("lobes", "Lobe"), with_schema[0]];
    class(text, ("ChatterDict", "TypedDict"), "`stiffarm.Chatter.to_dict`.", &cuts, &within);
    let compliance = Fields::of(&compliances);
    class(text, ("ComplianceDict", "TypedDict"), "`stiffarm.Compliance.to_dict`.", &compliance, &with_schema);
}

/// What is to be measured.
fn write_plans(text: &mut String) {
    let with_schema = ("schema", "Schema");
    let plan = Fields::of(&samples::measurement_plans());
    class(text, ("ExpectedDrive", "TypedDict"), "How well a drive will be known.", plan.under("drives"), &[]);
    class(text, ("MeasurementRun", "TypedDict"), "A posture and a load.", plan.under("runs"), &[]);
    let about = "What a table of one's own is worth.";
    class(text, ("ComparedTable", "TypedDict"), about, plan.under("compared"), &[]);
    let within = [("drives", "ExpectedDrive"), ("runs", "MeasurementRun"), ("compared", "ComparedTable"), with_schema];
    class(text, ("MeasurementPlanDict", "TypedDict"), "`stiffarm.MeasurementPlan.to_dict`.", &plan, &within);

    let plan = Fields::of(&samples::calibration_plans());
    class(text, ("PlannedPosture", "TypedDict"), "A posture in which points are measured.", plan.under("runs"), &[]);
    class(text, ("CalibrationLeaves", "TypedDict"), "What so many postures leave.", plan.under("by_count"), &[]);
    let about = "The error that a calibration leaves at the work.";
    class(text, ("PlannedAtWork", "TypedDict"), about, plan.under("at_work"), &[]);
    let within =
        [("runs", "PlannedPosture"), ("by_count", "CalibrationLeaves"), ("at_work", "PlannedAtWork"), with_schema];
    class(text, ("CalibrationPlanDict", "TypedDict"), "`stiffarm.CalibrationPlan.to_dict`.", &plan, &within);
}

/// What is read of an arm.
fn write_readings(text: &mut String) {
    let with_schema = ("schema", "Schema");
    let found = Fields::of(&samples::calibrations());
    class(text, ("LevelFit", "TypedDict"), "What a level leaves.", found.under("levels"), &[]);
    class(text, ("WrongRow", "TypedDict"), "A point that was left out.", found.under("wrong_rows"), &[]);
    let about = "A joint that moved over less than a third of its range.";
    class(text, ("NarrowJoint", "TypedDict"), about, found.under("narrow"), &[]);
    class(text, ("CalibratedAtWork", "TypedDict"), "The error that remains at the work.", found.under("at_work"), &[]);
    let within = [
        ("levels", "LevelFit"),
        ("drives", "UpdatedDrive"),
        ("wrong_rows", "WrongRow"),
        ("narrow", "NarrowJoint"),
        ("at_work", "CalibratedAtWork"),
        with_schema,
    ];
    class(text, ("CalibrationDict", "TypedDict"), "`stiffarm.Calibration.to_dict`.", &found, &within);
    let found = Fields::of(&samples::verifications());
    class(text, ("WayOfCounting", "TypedDict"), "A way of counting the joints.", found.under("fits"), &[]);
    class(text, ("WrongReading", "TypedDict"), "The row that does not agree.", found.under("wrong_row"), &[]);
    let within = [("fits", "WayOfCounting"), ("wrong_row", "WrongReading"), with_schema];
    class(text, ("VerificationDict", "TypedDict"), "`stiffarm.Verification.to_dict`.", &found, &within);
    let found = Fields::of(&samples::fitting_robots());
    let within = [("fits", "WayOfCounting"), with_schema];
    class(text, ("FittingRobotsDict", "TypedDict"), "`stiffarm.FittingRobots.to_dict`.", &found, &within);
}

/// How an arm swings.
fn write_swings(text: &mut String) {
    let with_schema = ("schema", "Schema");
    let swings = Fields::of(&samples::swings());
    class(text, ("SwingMode", "TypedDict"), "One way in which an arm swings.", swings.under("modes"), &[]);
    let within = [("modes", "SwingMode"), with_schema];
    class(text, ("ModesDict", "TypedDict"), "`stiffarm.Modes.to_dict`.", &swings, &within);
    let over = Fields::of(&samples::swings_over_zones());
    let about = "One mode over a zone; modes are counted by their frequencies at each point.";
    class(text, ("ModeOverZone", "TypedDict"), about, over.under("modes"), &[]);
    let within = [("modes", "ModeOverZone"), with_schema];
    class(text, ("ModesOverZoneDict", "TypedDict"), "`stiffarm.ModesOverZone.to_dict`.", &over, &within);
}

/// What is answered of processes and paths.
fn write_paths(text: &mut String) {
    let with_schema = [("schema", "Schema")];
    let forces = Fields::of(&samples::cutting_forces());
    class(text, ("ForceDict", "TypedDict"), "`stiffarm.Force.to_dict`.", &forces, &with_schema);
    let paths = Fields::of(&samples::toolpaths());
    let (milled, ranked) = (Fields::of(&samples::milled()), Fields::of(&samples::path_rankings()));
    class(text, ("PathLength", "TypedDict"), "How long a path is.", milled.under("part"), &[]);
    let about = "A roll that is pinned.";
    class(text, ("PinnedRoll", "TypedDict"), about, milled.under("roll").under("pins"), &[]);
    let (about, within) = ("How the tool is turned about its axis.", [("pins", "PinnedRoll")]);
    class(text, ("RollChoice", "TypedDict"), about, milled.under("roll"), &within);
    class(text, ("PlaceSearch", "TypedDict"), "How finely a place was looked for.", milled.under("search"), &[]);
    let about = "A stretch of a path along which the arm is nearer to something than it was to keep.";
    class(text, ("PathContact", "TypedDict"), about, milled.under("contacts"), &[]);
    let about = "What becomes of an error as the cut changes by it.";
    class(text, ("FedBackDict", "TypedDict"), about, milled.under("fed_back"), &[]);
    let about = "Samples of a path for which chatter is not assessed.";
    class(text, ("UncoveredSamples", "TypedDict"), about, milled.under("chatter").under("not_covered"), &[]);
    let (about, within) = ("Whether the cuts of a path swing with the arm.", [("not_covered", "UncoveredSamples")]);
    class(text, ("PathChatter", "TypedDict"), about, milled.under("chatter"), &within);
    let within = [
        ("part", "PathLength"),
        ("roll", "RollChoice"),
        ("search", "PlaceSearch"),
        ("fed_back", "FedBackDict"),
        ("chatter", "PathChatter"),
        ("contacts", "PathContact"),
        ("unavoidable", "PathContact"),
        with_schema[0],
    ];
    class(text, ("MilledDict", "_Pass"), "`stiffarm.Milled.to_dict`.", &milled, &within);
    let within = [
        ("roll", "RollChoice"),
        ("search", "PlaceSearch"),
        ("contacts", "PathContact"),
        ("unavoidable", "PathContact"),
    ];
    class(text, ("PathRankingRow", "_Pass"), "One robot of a ranking on a path.", ranked.under("rows"), &within);
    let within = [("part", "PathLength"), ("rows", "PathRankingRow"), with_schema[0]];
    class(text, ("PathRankingDict", "TypedDict"), "`stiffarm.PathRanking.to_dict`.", &ranked, &within);
    let ledger = Fields::of(&samples::ledgers());
    class(text, ("PublishedNumber", "TypedDict"), "A published number.", ledger.under("rows"), &[]);
    let within = [("rows", "PublishedNumber"), with_schema[0]];
    class(text, ("LedgerDict", "TypedDict"), "`stiffarm.Ledger.to_dict`.", &ledger, &within);
    class(text, ("ToolpathDict", "TypedDict"), "`stiffarm.Toolpath.to_dict`.", &paths, &with_schema);
}

/// Words in lines of the house's width, spelt as Python spells them.
fn wrapped(words: &str) -> String {
    let mut lines = vec![String::new()];
    for word in words.replace("--model spatial", "model=\"spatial\"").split(' ') {
        let line = lines.last_mut().expect("there is one");
        if !line.is_empty() && 105 < line.len() + word.len() {
            lines.push(word.to_owned());
        } else {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        }
    }
    lines.join("\n    ")
}

fn python_type(setting: &Setting) -> String {
    let words = |words: &[(&str, &str)]| {
        let quoted: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        format!("Literal[{}]", quoted.join(", "))
    };
    let usual = match (setting.kind, setting.is_list()) {
        (Kind::Number { .. }, false) => "float".into(),
        (Kind::Whole { .. }, false) => "int".into(),
        (Kind::Flag, _) => "bool".into(),
        (Kind::Word(known), false) => words(known),
        (Kind::Word(known), true) => format!("str | Iterable[{}]", words(known)),
        (
            Kind::Text
            | Kind::Robot
            | Kind::Task
            | Kind::Zone
            | Kind::Shape
            | Kind::Posture
            | Kind::Spindle
            | Kind::Mount
            | Kind::File
            | Kind::Date,
            false,
        ) => "str".into(),
        (
            Kind::Text
            | Kind::Robot
            | Kind::Task
            | Kind::Zone
            | Kind::Shape
            | Kind::Posture
            | Kind::Marker
            | Kind::Way
            | Kind::Direction
            | Kind::FileOfTool
            | Kind::LengthOfTool
            | Kind::Pin,
            true,
        ) => "str | Iterable[str]".into(),
        (Kind::Heading, _) => "str | Iterable[str] | Mapping[str, str]".into(),
        (Kind::Range { .. }, _) => "RangeLike".into(),
        (Kind::Block { .. }, _) => "str | Iterable[str | Sequence[RangeLike | None]]".into(),
        (Kind::Within, _) => "str | Sequence[RangeLike | None]".into(),
        (Kind::Force, _) => "float | npt.ArrayLike".into(),
        (Kind::Angle | Kind::Elevation | Kind::Floor | Kind::Yaw | Kind::Roll, _) => "str | float".into(),
        // Numbers, one or many. No kind is left out: a new one must decide.
        (
            Kind::Number { .. }
            | Kind::Whole { .. }
            | Kind::Tool
            | Kind::Point
            | Kind::Direction
            | Kind::Marker
            | Kind::Way
            | Kind::FileOfTool
            | Kind::LengthOfTool
            | Kind::Pin
            | Kind::Spindle
            | Kind::Mount
            | Kind::File
            | Kind::Date,
            _,
        ) => "npt.ArrayLike".into(),
    };
    if matches!(setting.absent, Absent::Default(_)) { usual } else { format!("{usual} | None") }
}
