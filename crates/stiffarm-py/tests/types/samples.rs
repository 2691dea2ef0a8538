//! Answers of every kind, so different from one another that every key has been seen with whatever may stand under it.

use std::path::Path;

use serde_json::Value;
use stiffarm::advice::{advise, advise_best};
use stiffarm::calibrate::calibrate;
use stiffarm::catalogue::measurements::{self, Measurements};
use stiffarm::catalogue::readings::{self, ReadOptions};
use stiffarm::catalogue::{find, read, read_process};
use stiffarm::chatter::{HeldBy, MeasuredMode, MeasuredTip, Response, chatter, read_response};
use stiffarm::compliance::compliance;
use stiffarm::drive::Architecture;
use stiffarm::identify::{Identification, IdentifyError, identify};
use stiffarm::ledger::{Printed, validate};
use stiffarm::map::map;
use stiffarm::measure::{geometry_plan, plan};
use stiffarm::modes::{first_frequencies, modes, modes_over};
use stiffarm::place::{Hold, PlaceError, Placed, place};
use stiffarm::rank::rank;
use stiffarm::robot::Robot;
use stiffarm::study::study;
use stiffarm::toolpath::{self, Builtin, Format, Move, MoveKind, Survey, ToolPose};
use stiffarm::verify::{VerifyOptions, rank as verify_rank, verify};
use stiffarm::watch::Watch;
use stiffarm_ask::answer::{
    Beside, CalibrateAnswer, ChatterAnswer, CompareAnswer, ComplianceAnswer, CuttingAnswer, GeometryAnswer,
    IdentifyAnswer, LedgerAnswer, MapAnswer, MeasureAnswer, MillAnswer, ModesAnswer, ModesOverAnswer, PathAnswer,
    PathRankAnswer, PlaceAnswer, RankAnswer, StudyAnswer, TipFile, VerifyAnswer, VerifyRankAnswer,
};
use stiffarm_ask::request::{Pair, Request, Spelling, Verb};

type Typed<'a> = &'a [(&'a str, &'a str)];

const TWO_LINKS: &str = "name = \"two links\"\nvendor = \"nobody\"\narchitecture = \"serial\"\nstatus = \"derived\"\n
[planar]\nl2_mm = 1000\nl3_mm = 800\n\n[source]\ngeometry = \"none\"\nlimits = \"none\"\n";

fn asked(verb: Verb, typed: Typed) -> Request {
    let pair = |(name, text): &(&str, &str)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed };
    let robot = [("robot", "KR 210 R2700 extra")];
    let pairs: Vec<Pair> = match verb {
        Verb::Study | Verb::Rank | Verb::Identify | Verb::Mill => typed.iter().map(pair).collect(),
        _ => typed.iter().chain(&robot).map(pair).collect(),
    };
    Request::read(verb, &pairs, Spelling::Typed).unwrap()
}

fn kuka() -> Robot {
    find("KR 210 R2700 extra").expect("in the catalogue").robot()
}

fn two_links() -> Robot {
    read(TWO_LINKS, "two links").unwrap()
}

fn placed(robot: &Robot, typed: Typed) -> PlaceAnswer {
    let asked = asked(Verb::Place, typed);
    let (task, kind) = (asked.task().unwrap(), asked.model());
    let options = asked.place_options(task.work.zone()).unwrap();
    let robot = &asked.equipped(robot.clone()).unwrap();
    let (model, tolerance_mm) = (kind.of(robot).unwrap(), asked.tolerance_mm());
    let placed = place(&model, &task.work, &options, Watch::nobody()).unwrap();
    let advised = |mm: f64| advise(&model, &task.work, &options, &placed, mm / 1e3, Watch::nobody()).unwrap();
    let advice = tolerance_mm.map(advised);
    PlaceAnswer { robot: robot.clone(), model: kind, task, options, placed, tolerance_mm, advice }
}

pub(crate) fn placements() -> Vec<Value> {
    let space = [("model", "spatial"), ("tool-mm", "100,0,200"), ("roll-deg", "0")];
    let of = |typed: Typed| placed(&kuka(), typed).json();
    let in_space = |typed: Typed| of(&[typed, &space].concat());
    let mut unseen = placed(&kuka(), &[&[("task", "circle:0.4")][..], &space].concat());
    let Placed::Feasible(best) = &mut unseen.placed else { panic!("it fits") };
    let Hold::Space(hold) = &mut best.hold else { panic!("in space") };
    // As in a cell whose coarse search has seen no whole zone.
    hold.resolution.coarse = None;
    let held = [("task", "circle:0.2"), ("tool-mass-kg", "60"), ("tool-com-mm", "0,0,200")];
    // The wrist of this one has limits.
    let limited = placed(&find("KR 210 R2700-2").unwrap().robot(), &[&held[..], &space].concat());
    vec![
        unseen.json(),
        limited.json(),
        of(&[("task", "B:0.3"), ("tolerance-mm", "2"), ("within", "0.5..,0..2")]),
        of(&[("task", "A:9"), ("floor", "none")]),
        of(&[("task", "B:0.3"), ("tolerance-mm", "0.1")]),
        of(&[("task", "B:0.3"), ("stiffness", "prior")]),
        of(&[("task", "B:0.3"), ("tolerance-mm", "0.001")]),
        placed(&two_links(), &[("task", "A:0.3")]).json(),
        in_space(&[("task", "circle:0.4"), ("tolerance-mm", "2"), ("within", "0.5..,0..2")]),
        in_space(&[("task", "circle:3")]),
        in_space(&[("task", "rect:0.3x0.2"), ("force-n", "300,100,50"), ("force-cone-deg", "5"), ("feed-deg", "10")]),
        in_space(&[
            ("task", "circle:0.3"),
            ("mount", "pedestal:0.5"),
            ("keep-out", "3..4,..,0..1;-0.4..0.4,-0.4..0.4,0..0.4"),
            ("clearance-mm", "10"),
        ]),
        in_space(&[("task", "circle:0.3"), ("within", "1..2,-1..1,0..1;1..2,1..2,0..1")]),
        of(&[("task", "box:0.3x0.2x0.1"), ("faces", "top"), ("angle", "0"), ("model", "spatial")]),
    ]
}

pub(crate) fn rankings() -> Vec<Value> {
    let ranked = |robots: &[Robot], typed: Typed| {
        let asked = asked(Verb::Rank, typed);
        let (tasks, kind, options) = (asked.tasks(), asked.model(), asked.place_options(None).unwrap());
        let robots: Vec<Robot> = robots.iter().map(|robot| asked.equipped(robot.clone()).unwrap()).collect();
        let ranking = rank(&robots, &tasks, &kind, &options, Watch::nobody()).unwrap();
        let tolerance_mm = asked.tolerance_mm();
        let advised = |mm: f64| advise_best(&ranking, &options, mm / 1e3, Watch::nobody()).unwrap();
        let advice = tolerance_mm.map_or_else(Vec::new, advised);
        RankAnswer::of(ranking, options, tolerance_mm, advice)
    };
    let estimated = find("Staubli TX340 SH").expect("in the catalogue").robot();
    let plane = ranked(&[kuka(), estimated, two_links()], &[("task", "A:0.3,A:9"), ("tolerance-mm", "2")]);
    let twin = Robot { name: "its twin".into(), ..kuka() };
    let alike = ranked(&[kuka(), twin], &[("task", "A:0.3")]);
    let mut unknown = ranked(&[kuka()], &[("task", "A:0.3")]);
    let row = &mut unknown.ranking.rows[0];
    row.cells[0] = Err(PlaceError::Unfinished { nodes: 1, lower: 1e-3, upper: 2e-3 });
    (row.rank, row.mean_ratio, row.floor) = (None, None, None);
    let space = ranked(&[kuka()], &[("task", "circle:0.4"), ("model", "spatial"), ("roll-deg", "0")]);
    let directed = [
        ("task", "circle:0.4"),
        ("model", "spatial"),
        ("roll-deg", "0"),
        ("force-n", "300,100,50"),
        ("feed-deg", "10"),
    ];
    let other = find("KR 210 R2700-2").expect("in the catalogue").robot();
    let known = [("task", "A:0.3,A:9"), ("stiffness", "prior"), ("tolerance-mm", "2"), ("tool-mass-kg", "25")];
    let scattered = ranked(&[kuka(), other], &known);
    [plane, alike, unknown, space, ranked(&[kuka()], &directed), scattered].iter().map(RankAnswer::json).collect()
}

pub(crate) fn maps() -> Vec<Value> {
    let mapped = |robot: &Robot, typed: Typed, zone: Option<PlaceAnswer>| {
        let asked = asked(Verb::Map, &[typed, &[("size", "6")]].concat());
        let (model, options) = (asked.model().of(robot).unwrap(), asked.map_options());
        let map = map(&model, &options).unwrap();
        let frequency = asked.maps_frequency().then(|| {
            let tool = asked.held_tool().unwrap();
            (first_frequencies(&model, &map, &options, &tool).unwrap(), tool)
        });
        serde_json::to_value(MapAnswer { model, options, map, zone, frequency }).unwrap()
    };
    vec![
        mapped(&two_links(), &[], None),
        mapped(&kuka(), &[], Some(placed(&kuka(), &[("task", "B:0.3")]))),
        mapped(&kuka(), &[("direction-deg", "20")], None),
        mapped(&kuka(), &[("model", "spatial"), ("tool-mm", "100,0,200")], None),
        mapped(
            &kuka(),
            &[("model", "spatial"), ("force-n", "300,100,50"), ("force-cone-deg", "5"), ("feed-deg", "10")],
            None,
        ),
        mapped(&weighed(), &[("model", "spatial"), ("quantity", "first-frequency")], None),
    ]
}

pub(crate) fn comparisons() -> Vec<Value> {
    let of = |first: Typed, second: Typed| CompareAnswer { sides: [placed(&kuka(), first), placed(&kuka(), second)] };
    let (fits, too_large) = ([("task", "B:0.3")], [("task", "A:9")]);
    let scattered = [("task", "B:0.3"), ("stiffness", "prior")];
    vec![
        of(&fits, &fits).json(),
        of(&fits, &too_large).json(),
        of(&fits, &[("task", "B:0.6")]).json(),
        of(&scattered, &scattered).json(),
    ]
}

pub(crate) fn studies() -> Vec<Value> {
    let of =
        |typed: Typed| StudyAnswer(study(&asked(Verb::Study, typed).study(Some(&kuka())).unwrap()).unwrap()).json();
    // The second one does not fit anywhere.
    let marked = ["0.6x0.4", "9x9"].map(|sides| of(&[("robot", "KR 210"), ("task", &format!("rect:{sides}"))]));
    [of(&[]), of(&[("sizes", "0.1,3")])].into_iter().chain(marked).collect()
}

pub(crate) fn compliances() -> Vec<Value> {
    let of = |typed: Typed| {
        let asked = asked(Verb::Compliance, &[typed, &[("joints-deg", "0,-90,90,10,20,30")]].concat());
        let (joints_deg, tool) = (asked.joints_deg().unwrap(), asked.tool_pose().tool());
        let robot = asked.equipped(kuka()).unwrap();
        let posture = compliance(&robot, &joints_deg.map(f64::to_radians), &tool).unwrap();
        ComplianceAnswer { robot, joints_deg, posture, load: asked.posture_load() }.json()
    };
    vec![
        of(&[]),
        of(&[("force-n", "100,50,20")]),
        of(&[("force-n", "100,50,20"), ("force-axes", "tool"), ("feed-deg", "5")]),
        of(&[("force-n", "100,50,20"), ("stiffness", "paper")]),
    ]
}

pub(crate) fn swings() -> Vec<Value> {
    let of = |stiffness: &str, typed: Typed| {
        let asked =
            asked(Verb::Modes, &[typed, &[("joints-deg", "0,-90,90,0,45,0"), ("stiffness", stiffness)]].concat());
        let (joints_deg, tool, damping) = (asked.joints_deg().unwrap(), asked.held_tool().unwrap(), asked.damping());
        let robot = asked.equipped(find("KR 210 R2700-2").unwrap().robot()).unwrap();
        let swing = modes(&robot, &joints_deg.map(f64::to_radians), &tool, damping).unwrap();
        ModesAnswer { robot, joints_deg, tool, damping, count: 6, swing }
    };
    let tool = [("tool-mass-kg", "60"), ("tool-com-mm", "0,0,200"), ("tool-inertia-kg-m2", "1,0,0,1,0,1")];
    // Rotors are known of no arm of the catalogue.
    let mut free = of("prior", &tool);
    free.swing.modes.iter_mut().for_each(|mode| mode.motors_free = Some(10.0));
    // Of a parallelogram whose rod nobody has weighed.
    let mut without_rod = of("paper", &[("damping-ratio", "0.05")]);
    without_rod.robot.architecture = Architecture::QuasiSerial;
    vec![of("prior", &[]).json(), without_rod.json(), free.json()]
}

pub(crate) fn swings_over_zones() -> Vec<Value> {
    let of = |stiffness: &str, typed: Typed| {
        let zone = [("task", "circle:0.1"), ("at", "1.5,1.0"), ("stiffness", stiffness)];
        let asked = asked(Verb::Modes, &[typed, &zone].concat());
        let ((task, options), tool) = (asked.swinging_zone().unwrap(), asked.held_tool().unwrap());
        let robot = asked.equipped(find("KR 210 R2700-2").unwrap().robot()).unwrap();
        let model = asked.model().of(&robot).unwrap();
        let placed = place(&model, &task.work.into(), &options, Watch::nobody()).unwrap();
        let best = placed.feasible().expect("a place").clone();
        let over = modes_over(&model, task.work, &options, &best, &tool).unwrap();
        ModesOverAnswer { robot, task, options, best, tool, count: 6, over }
    };
    let tool = [("tool-mass-kg", "60"), ("tool-com-mm", "0,0,200"), ("tool-inertia-kg-m2", "1,0,0,1,0,1")];
    let mut unproved = of("paper", &[]);
    unproved.over.first_at_least = None;
    // Of a parallelogram whose rod nobody has weighed.
    unproved.robot.architecture = Architecture::QuasiSerial;
    vec![of("prior", &tool).json(), unproved.json()]
}

pub(crate) fn cuts() -> Vec<Value> {
    let text = include_str!("../../../../docs/examples/endmill.toml");
    let mode = MeasuredMode { frequency: 610.0, ratio: 0.03, stiffness: 2.2e7, direction: [1.0, 0.0, 0.0] };
    let of_modes = Response::of_modes(&[mode]);
    let by_hertz =
        read_response(include_str!("../../../../docs/examples/tip.csv"), "tip.csv", HeldBy::Rigid).unwrap().response;
    let of = |typed: Typed, measured: Option<&Response>| {
        let given = [("process", "endmill.toml"), ("joints-deg", "0,-90,90,0,90,0"), ("feed", "1,0,0")];
        let measured = measured.map(|response| TipFile {
            tip: MeasuredTip { held_by: HeldBy::Rigid, response: response.clone() },
            file: "tip.csv".into(),
            remarks: Vec::new(),
        });
        let asked = asked(Verb::Chatter, &[typed, &given].concat());
        let (joints_deg, tool, wanted) = (
            asked.joints_deg().unwrap(),
            asked.held_tool().unwrap(),
            asked.chatter(measured.as_ref().map(|measured| &measured.tip)).unwrap(),
        );
        let robot = asked.equipped(weighed()).unwrap();
        let mut process = read_process(text, "endmill.toml").unwrap();
        process.assumed.push("straight teeth".into());
        let chatter = chatter(&robot, &joints_deg.map(f64::to_radians), &tool, &process.process, &wanted).unwrap();
        ChatterAnswer { robot, joints_deg, tool, file: "endmill.toml".into(), process, measured, chatter }
    };
    let tool = [("tool-mass-kg", "60"), ("tool-com-mm", "0,0,200"), ("tool-inertia-kg-m2", "1,0,0,1,0,1")];
    // As of an arm that no cut swings.
    let mut calm = of(&tool, None);
    let chatter = &mut calm.chatter;
    (chatter.at_speed, chatter.any_speed) = (None, None);
    (chatter.other_way, chatter.without_delay) = (None, None);
    let unbounded = stiffarm::chatter::DepthSpread { p05: None, p95: None };
    (chatter.spread, chatter.any_speed_spread) = (unbounded, unbounded);
    chatter.lobes.iter_mut().for_each(|lobe| (lobe.edge, lobe.spread) = (None, None));
    vec![of(&[], Some(&by_hertz)).json(), calm.json(), of(&tool, Some(&of_modes)).json()]
}

pub(crate) fn identifications() -> Vec<Value> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples");
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let spring =
        "\n[compensator]\nbase_mm = [-400, 0]\narm_mm = [0, 250]\nstiffness_n_per_mm = 100\nfree_length_mm = 300\n";
    let robot = read(&(text("fanuc_r2000ic.toml") + spring), "robot").unwrap();
    let of = |typed: Typed, sigma: Option<f64>, change: fn(&mut Identification)| {
        let typed = [typed, &[("data", "measured"), ("robot", "it"), ("load-mm", "6.9,245.3,319.3")]].concat();
        let asked = asked(Verb::Identify, &typed);
        let Measurements { mut readings, remarks } =
            measurements::read(&text("fanuc_r2000ic.csv"), "measured", &asked.points()).unwrap();
        for reading in &mut readings {
            reading.sigma = sigma;
        }
        let options = asked.identification();
        let measured = Measurements { readings, remarks };
        let mut found = identify(&robot, &measured, &options, Watch::nobody()).unwrap();
        change(&mut found);
        IdentifyAnswer { found, before: robot.clone(), data: "measured".into(), date: options.date }.json()
    };
    let unseen = |found: &mut Identification| {
        for one in &mut found.estimates {
            (one.compliance, one.standard_error, one.interval, one.robust) = (None, None, None, None);
        }
        // As of rows in which a posture alone shows some drive, and another is not seen at all.
        found.residuals.iter_mut().for_each(|one| one.left_out = None);
        found.tried.iter_mut().filter_map(|one| one.fit.as_mut().ok()).for_each(|fit| fit.left_out = None);
        if let Some(last) = found.tried.last_mut() {
            last.fit = Err(IdentifyError::NotFound);
        }
        found.left_out = None;
        *found.singular_values.last_mut().unwrap() = 0.0;
        found.remarks = vec!["odd".into()];
    };
    let all = [("model", "base-and-tool"), ("date", "2026-05-31")];
    vec![
        of(&[], None, |_| ()),
        of(&all, Some(1e-5), |found| found.estimates.last_mut().unwrap().unknown = None),
        of(&all, None, unseen),
        of(&[("model", "auto")], None, |_| ()),
        of(&[("model", "auto")], None, unseen),
        of(&[("model", "regions")], None, |_| ()),
        of(&[("model", "compensator")], None, |_| ()),
        of(&[("model", "compensator")], None, unseen),
        of(&[("prior", "true")], None, |_| ()),
    ]
}

pub(crate) fn measurement_plans() -> Vec<Value> {
    let of = |typed: Typed, compared: Option<(String, usize, f64, f64)>| {
        let asked = asked(Verb::Measure, &[typed, &[("runs", "6"), ("candidates", "200")]].concat());
        let (robot, options) = (asked.equipped(kuka()).unwrap(), asked.measurement_plan());
        let plan = plan(&robot, &options, Watch::nobody()).unwrap();
        MeasureAnswer { robot, options, work: "anywhere".into(), plan, compared }
    };
    // The flange centre as marker: drive 6 does not move it.
    let mut unseen = of(&[], Some(("mine.csv".into(), 6, 1e-12, 0.5)));
    unseen.plan.random = f64::INFINITY;
    vec![unseen.json(), of(&[("load-mm", "0,50,200"), ("loads", "down,left")], None).json()]
}

pub(crate) fn calibration_plans() -> Vec<Value> {
    let asked = asked(Verb::Measure, &[("geometry", "true"), ("runs", "8"), ("candidates", "40")]);
    let (robot, options) = (asked.equipped(kuka()).unwrap(), asked.measurement_plan());
    let plan = geometry_plan(&robot, &options, Watch::nobody()).unwrap();
    vec![GeometryAnswer { robot, options, work: "anywhere".into(), plan }.json()]
}

fn example(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples").join(name)).unwrap()
}

pub(crate) fn calibrations() -> Vec<Value> {
    let of = |robot: Robot, typed: Typed, text: &str| {
        let asked = asked(Verb::Calibrate, &[typed, &[("data", "tracker.csv")]].concat());
        let options = asked.calibration();
        let table = readings::read(text, "tracker.csv", &asked.reading(&robot.vendor)).unwrap();
        let found = calibrate(&robot, &table, &options, Watch::nobody()).unwrap();
        let is_chosen = options.level.is_none();
        CalibrateAnswer { found, robot, data: "tracker.csv".into(), date: "2026-05-31".into(), is_chosen }
    };
    let text = example("tracker.csv");
    // One point is mistyped; nothing is reached there; rows of one joint's range.
    let wrong = text.replacen("3014.797", "3044.797", 1);
    let mut narrow = of(kuka(), &[("level", "zeros"), ("at", "9,9,9")], &wrong);
    narrow.found.narrow = vec![(1, 0.2)];
    narrow.found.levels[0].left_out = None;
    let weighed = of(find("KR 210 R2700-2").unwrap().robot(), &[], &example("tracker_weighed.csv"));
    vec![of(kuka(), &[], &text).json(), narrow.json(), weighed.json()]
}

pub(crate) fn verifications() -> Vec<Value> {
    let of = |text: &str| {
        let asked = asked(Verb::Verify, &[("data", "pendant.csv")]);
        let table = readings::read(text, "pendant.csv", &asked.reading("KUKA")).unwrap();
        let found = verify(&kuka(), &table, &asked.verification(), &[], Watch::nobody()).unwrap();
        VerifyAnswer { found, data: "pendant.csv".into(), date: "2026-05-31".into() }.json()
    };
    let text = example("pendant.csv");
    let lines: Vec<&str> = text.lines().collect();
    let few = lines[..5].join("\n");
    let turned: String = lines[1..]
        .iter()
        .enumerate()
        .map(|(i, line)| format!("{line},{}\n", if i == 0 { "a_deg,b_deg,c_deg" } else { "0,90,0" }))
        .collect();
    vec![of(&text), of(&text.replacen("1702.03", "1802.03", 1)), of(&few), of(&turned)]
}

pub(crate) fn fitting_robots() -> Vec<Value> {
    let table = readings::read(&example("pendant.csv"), "pendant.csv", &ReadOptions::default()).unwrap();
    let fits = verify_rank(&table, &VerifyOptions::default(), &[kuka()], Watch::nobody()).unwrap();
    vec![VerifyRankAnswer { fits, rows: table.rows.len(), data: "pendant.csv".into() }.json()]
}

pub(crate) fn cutting_forces() -> Vec<Value> {
    let of = |text: &str| {
        let process = read_process(text, "process.toml").unwrap();
        let force = process.process.force().unwrap();
        CuttingAnswer { file: "process.toml".into(), process, force }.json()
    };
    let milling =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples").join("endmill.toml"));
    let silent = "[tool]\ndiameter_mm = 16\nteeth = 4\n[material]\npreset = \"al7075-t6\"\n
[engagement]\nap_mm = 2\nae_mm = 16\nside = \"slot\"\nfeed_per_tooth_mm = 0.1\n";
    vec![of(&milling.unwrap()), of(silent), of("[worst]\nforce_n = 400\n")]
}

pub(crate) fn toolpaths() -> Vec<Value> {
    let read = |text: &str| {
        let asked = asked(Verb::Mill, &[("path", "part.nc"), ("dry", "true")]);
        let (options, mut survey) = (asked.read_options(), Survey::new(asked.steps()));
        let mut each = |one: &_| survey.add(one);
        let found =
            toolpath::read(&mut text.as_bytes(), "part.nc", Format::GCode, &options, &mut each, &mut |_| Ok(()));
        PathAnswer { path: "part.nc".into(), understood: Some(found.unwrap()), survey }.json()
    };
    let mut survey = Survey::new(asked(Verb::Mill, &[("path", "line:0.3")]).steps());
    "line:0.3".parse::<Builtin>().unwrap().moves(None).iter().for_each(|one| survey.add(one));
    vec![
        read("M8\nG1 X10 F100\n"),
        read("G0 X10 Y0 Z0\nG0 X20\n"),
        PathAnswer { path: "line:0.3".into(), understood: None, survey }.json(),
    ]
}

/// A rapid move from the end of a path to where its last move began.
fn back(moves: &[Move]) -> Option<Move> {
    let last = *moves.last()?;
    Some(Move { kind: MoveKind::Rapid, from: last.to, to: last.from, feed: None, ..last })
}

/// A robot whose masses are known.
fn weighed() -> Robot {
    find("KR 210 R2700-2").expect("in the catalogue").robot()
}

/// Straight down where a path ends.
fn plunge(moves: &[Move]) -> Option<Move> {
    let last = *moves.last()?;
    let down = ToolPose { tip: last.to.tip - last.to.axis * 0.01, ..last.to };
    Some(Move { line: 7, from: last.to, to: down, ..last })
}

pub(crate) fn milled() -> Vec<Value> {
    let of = |typed: Typed| {
        let usual = [("path", "line:0.2"), ("robot", "it"), ("step-mm", "50")];
        let asked = asked(Verb::Mill, &[typed, &usual].concat());
        let mut moves = "line:0.2".parse::<Builtin>().unwrap().moves(Some(0.01));
        if typed.contains(&("at", "9,0,0")) {
            moves.extend(back(&moves));
        }
        if typed.contains(&("chatter", "true")) {
            moves.extend(plunge(&moves));
        }
        if typed.contains(&("damping-ratio", "0.05")) {
            moves.remove(0);
        }
        let slot = "spindle_rpm = 9000\n[tool]\ndiameter_mm = 16\nteeth = 4\n[material]\npreset = \"al7075-t6\"\n
[engagement]\nap_mm = 0.05\nae_mm = 16\nside = \"slot\"\nfeed_per_tooth_mm = 0.1\n";
        let process = read_process(slot, "process.toml").unwrap();
        let process = asked.acting().unwrap().is_none().then(|| ("process.toml".into(), process));
        let robot = if typed.contains(&("chatter", "true")) { weighed() } else { kuka() };
        let mut answer = MillAnswer::of(&asked, &robot, ("line:0.2".into(), &moves), process, Watch::nobody()).unwrap();
        if !typed.contains(&("force-n", "400")) {
            answer.remarks.push("a remark".into());
        }
        answer.json()
    };
    let tool = ("tool", "spindle:250@90");
    let swinging = [("tool-mm", "0,0,200"), ("at", "1.7,0,0.8"), ("process", "process.toml"), ("chatter", "true")];
    vec![
        of(&[tool, ("force-n", "400"), ("at", "1.8,0,0.8,20"), ("tolerance-mm", "0.5")]),
        of(&[tool, ("force-n", "300,-120,80"), ("at", "9,0,0")]),
        of(&[tool, ("force-n", "400"), ("at", "1.8,0,0.8,20"), ("pin", "0@10")]),
        of(&[tool, ("force-n", "400"), ("at", "1.8,0,0.8,20"), ("clearance-mm", "1500")]),
        of(&[tool, ("roll", "constant"), ("within", "1..,0.5..")]),
        of(&swinging),
        of(&[&swinging[..], &[("damping-ratio", "0.05")]].concat()),
    ]
}

pub(crate) fn ledgers() -> Vec<Value> {
    vec![LedgerAnswer(validate(&Printed::PAPER).unwrap()).json()]
}

pub(crate) fn path_rankings() -> Vec<Value> {
    let of = |robots: &[Robot], typed: Typed| {
        let usual = [("path", "line:0.1"), ("step-mm", "50"), ("force-n", "400")];
        let asked = asked(Verb::Mill, &[typed, &usual].concat());
        let mut moves = "line:0.1".parse::<Builtin>().unwrap().moves(Some(0.01));
        if typed.contains(&("within", "8..9,0..1")) {
            moves.extend(back(&moves));
        }
        let path = ("line:0.1".into(), &moves[..]);
        let mut answer =
            PathRankAnswer::of(&asked, robots.to_vec(), path, &Beside::default(), Watch::nobody()).unwrap();
        answer.remarks.push("a remark".into());
        answer.json()
    };
    let several = ("robots", "paper");
    let estimated = find("Staubli TX340 SH").expect("in the catalogue").robot();
    let robots = [kuka(), Robot { name: "its twin".into(), ..kuka() }, estimated, two_links()];
    vec![
        of(&robots, &[several, ("tool", "spindle:250@90"), ("tolerance-mm", "0.5")]),
        of(&robots, &[several, ("within", "8..9,0..1")]),
        of(&[kuka()], &[several, ("tool", "spindle:250@90"), ("clearance-mm", "3000")]),
        of(&[two_links()], &[several]),
    ]
}
