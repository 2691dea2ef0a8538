//! Along a path: what is reported of every sample is what is reported of its posture, feed and engagement alone;
//! reflected in the arm plane it is the same.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;
use stiffarm::chatter::{Asked, Chatter, Curve, Method, by_mean, chatter};
use stiffarm::cutting::{Edge, Law, Milling, Process};
use stiffarm::inverse::reached;
use stiffarm::mass::RigidBody;
use stiffarm::mill::{
    Forcing, Judged, MillHeld, MillOptions, Milled, PartPlacement, PathChatter, Pushed, RollMode, Stand, Station,
    Uncovered, chatter_along, forced, mill, part_from_tool,
};
use stiffarm::modes::{HeldTool, modes};
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::stock::Stock;
use stiffarm::toolpath::{Builtin, Course, Given, Move, MoveKind, Steps, ToolPose};
use stiffarm::watch::Watch;

use crate::chatter::{close, mill as end_mill};
use crate::modes::kr210;

const CHIP: [f64; 3] = [767e6, 169e6, 222e6];

fn process(engagement: [f64; 2]) -> Process {
    let law = Law::Milling(end_mill(4, 0.016, engagement, CHIP));
    Process { spindle: Some(3000.0 * TAU / 60.0), is_clockwise: true, law }
}

fn held(tool: &HeldTool) -> MillHeld {
    MillHeld { body: tool.body, damping: None, measured: None }
}

/// A place beside the arm plane, turned: no axis of the part is one of the base.
fn stand(tool: &HeldTool) -> Stand {
    let placement = PartPlacement { at: [1.6, 0.4, 0.8], yaw: 0.5, base_from_cell: Pose::identity() };
    Stand { base_from_part: placement.base_from_part(), flange_from_tool: tool.flange_from_tool }
}

struct Path {
    robot: Robot,
    tool: HeldTool,
    stations: Vec<Station>,
    samples: Vec<Pushed>,
}

/// Moves as the KR 210 follows them.
fn followed(moves: &[Move], process: &Process, stock: Option<&mut Stock>) -> Path {
    followed_with(kr210().1, (moves, process, stock))
}

/// The same with another tool.
fn followed_with(tool: HeldTool, (moves, process, stock): (&[Move], &Process, Option<&mut Stock>)) -> Path {
    let (robot, ..) = kr210();
    let forcing = Forcing::Process(process.clone());
    let stations = forced(moves, &Steps { longest: 0.05, ..Steps::USUAL }, &forcing, stock, Watch::nobody());
    let (stations, options) = (stations.unwrap().stations, MillOptions::usual());
    let found = mill(&robot, &stand(&tool), &stations, &options, Watch::nobody()).unwrap();
    let Milled::Followed(found) = found else { panic!("{found:?}") };
    Path { robot, tool, stations, samples: found.samples }
}

impl Path {
    fn chatter(&self, process: &Process) -> PathChatter {
        let path = (&self.stations[..], &self.samples[..]);
        let (held, options) = (held(&self.tool), MillOptions::usual());
        chatter_along(&self.robot, &stand(&self.tool), path, (process, &held, &options), Watch::nobody()).unwrap()
    }
}

fn depth(judged: &Judged) -> f64 {
    let Judged::Cut { critical, .. } = judged else { panic!("{judged:?}") };
    critical.edge.unwrap().depth
}

fn rectangle() -> Vec<Move> {
    "rect:0.1x0.1".parse::<Builtin>().unwrap().moves(Some(0.02))
}

/// The curve of the arm at the joints of each sample, along a feed that is turned into the base by hand.
#[test]
fn depths_along_a_path_are_those_of_its_postures_feeds_and_engagements() {
    let process = process([FRAC_PI_2, PI]);
    let mut moves = rectangle();
    // One side says its own width: 4 of 16 mm, down milling.
    moves[2].given.radial_width = Some(4e-3);
    let path = followed(&moves, &process, None);
    let answer = path.chatter(&process);
    let (s, c) = 0.5_f64.sin_cos();
    let mut turned_round = 0.0_f64;
    for ((station, pushed), judged) in path.stations.iter().zip(&path.samples).zip(&answer.samples) {
        let way = station.sample.direction.unwrap();
        let is_narrow = way == moves[2].direction(0.5).unwrap();
        let entry = if is_narrow { PI - 0.5_f64.acos() } else { FRAC_PI_2 };
        let swing = modes(&path.robot, &pushed.joints, &path.tool, None).unwrap();
        let depth_of = |sign: f64| {
            let x = Vector3::new(c * way.x - s * way.y, s * way.x + c * way.y, 0.0) * sign;
            let axes = nalgebra::Matrix3::from_columns(&[x, Vector3::z().cross(&x), Vector3::z()]);
            let motion = swing.motion(&[1.0; 6], None).seen_along(&axes);
            let milling = end_mill(4, 0.016, [entry, PI], CHIP);
            let period = 60.0 / (4.0 * 3000.0);
            Curve::of(&motion, &milling.mean_directional()).edge_at(period).unwrap().depth
        };
        close(depth(judged), depth_of(1.0), 1e-6);
        turned_round = turned_round.max((depth_of(-1.0) / depth_of(1.0) - 1.0).abs());
    }
    // A feed with the wrong sign would be noticed.
    assert!(1e-2 < turned_round, "{turned_round}");
}

#[test]
fn the_worst_sample_has_the_least_depth_in_proportion_and_the_whole_answer_of_its_posture() {
    let process = process([FRAC_PI_2, PI]);
    let mut moves = rectangle();
    moves[1].given.axial_depth = Some(20e-3);
    let path = followed(&moves, &process, None);
    let answer = path.chatter(&process);
    let (worst, found) = answer.worst.as_ref().unwrap();
    let reserve = |i: usize| depth(&answer.samples[i]) / path.stations[i].cut.as_ref().unwrap().engagement.depth();
    assert!((0..answer.samples.len()).all(|i| reserve(*worst) <= reserve(i)));
    assert_eq!(found.cut.milling.engagement.depth(), 20e-3);
    // The deep side is not where the critical depth is least: proportion counts.
    let least = answer.samples.iter().map(depth).fold(f64::INFINITY, f64::min);
    assert!(least < depth(&answer.samples[*worst]), "{least}");
    let feed = stand(&path.tool).base_from_part.rotation * path.stations[*worst].sample.direction.unwrap();
    let asked = Asked { feed: feed.into(), damping: None, method: Some(Method::Mean), measured: None };
    let Law::Milling(mut deep) = process.law else { unreachable!() };
    deep.engagement.arcs[0].depth = 20e-3;
    let process = Process { law: Law::Milling(deep), ..process };
    let again = chatter(&path.robot, &path.samples[*worst].joints, &path.tool, &process, &asked).unwrap();
    assert_eq!(again.at_speed.unwrap().depth, depth(&answer.samples[*worst]));
    assert_eq!((again.spread, again.verdict()), (found.spread, found.verdict()));
}

/// y to -y turns the spindle round, which is a tangential force the other way.
#[test]
fn reflected_in_the_arm_plane_a_path_has_the_same_depths() {
    let process = process([0.2, 1.9]);
    let path = followed(&rectangle(), &process, None);
    let mirrored_body = |body: &RigidBody| {
        let [ixx, ixy, ixz, iyy, iyz, izz] = body.elements();
        let centre = Vector3::new(body.centre.x, -body.centre.y, body.centre.z);
        RigidBody::new(body.mass, centre, [ixx, -ixy, ixz, iyy, -iyz, izz])
    };
    let mut robot = path.robot.clone();
    robot.masses.iter_mut().for_each(|mass| mass.body = mirrored_body(&mass.body));
    let mut stations = path.stations.clone();
    for station in &mut stations {
        station.sample.pose.tip.y *= -1.0;
        station.sample.direction.as_mut().unwrap().y *= -1.0;
        let cut = std::sync::Arc::make_mut(station.cut.as_mut().unwrap());
        (cut.engagement.arcs[0].entry, cut.engagement.arcs[0].exit) = (PI - 1.9, PI - 0.2);
    }
    let samples: Vec<Pushed> = path
        .samples
        .iter()
        .map(|pushed| {
            let [q1, q2, q3, q4, q5, q6] = pushed.joints;
            Pushed { joints: [-q1, q2, q3, -q4, q5, -q6], ..*pushed }
        })
        .collect();
    let placement = PartPlacement { at: [1.6, -0.4, 0.8], yaw: -0.5, base_from_cell: Pose::identity() };
    let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: path.tool.flange_from_tool };
    let [kt, kr, ka] = CHIP;
    let law = Law::Milling(end_mill(4, 0.016, [PI - 1.9, PI - 0.2], [-kt, kr, ka]));
    let mirrored = Process { law, ..process.clone() };
    let held = MillHeld { body: path.tool.body.as_ref().map(mirrored_body), damping: None, measured: None };
    let asked = (&mirrored, &held, &MillOptions::usual());
    let of = chatter_along(&robot, &stand, (&stations, &samples), asked, Watch::nobody()).unwrap();
    for (here, there) in path.chatter(&process).samples.iter().zip(&of.samples) {
        close(depth(there), depth(here), 1e-6);
    }
}

/// Every posture of its configuration in the robot's limits at every roll, by the inverse kinematics, each asked by itself; and the whole path so.
#[test]
fn no_roll_lets_the_worst_cut_go_deeper_than_the_one_that_is_reported() {
    let process = process([0.2, 1.9]);
    // Across the flange, so that the roll moves the arm.
    let aside = Pose::new(Vector3::new(0.25, 0.0, 0.0), Vector3::y() * FRAC_PI_2);
    let tool = HeldTool { flange_from_tool: aside, ..kr210().1 };
    let path = followed_with(tool, (&rectangle(), &process, None));
    let options = MillOptions { limit_margin: 0.0, singular_margin: 0.0, ..MillOptions::usual() };
    let (stand, held) = (stand(&path.tool), held(&path.tool));
    let asked = (&process, &held, &options);
    let found = chatter_along(&path.robot, &stand, (&path.stations, &path.samples), asked, Watch::nobody()).unwrap();
    let (deepest, (worst, answer)) = (found.deepest.unwrap(), found.worst.unwrap());
    let station = &path.stations[worst];
    let feed = (stand.base_from_part.rotation * station.sample.direction.unwrap()).into();
    let asked = Asked { feed, damping: None, method: None, measured: None };
    let depth = |edge: Option<stiffarm::chatter::Edge>| edge.map_or(f64::INFINITY, |edge| edge.depth);
    let (mut most, mut count, mut met) = (0.0_f64, 0, 0);
    for roll in (0..72).map(|i| f64::from(5 * i).to_radians()) {
        let tool = stand.base_from_part * part_from_tool(&station.sample.pose, roll).unwrap();
        let flange = tool * stand.flange_from_tool.inverse();
        let here = path.samples[worst].arrangement.configuration;
        for (_, q) in reached(&path.robot, &flange).into_iter().filter(|(configuration, _)| *configuration == here) {
            let edge = by_mean(&path.robot, &q, &path.tool, &answer.cut, &asked).unwrap().edge;
            most = most.max(depth(edge));
            count += 1;
            if (roll - deepest.roll).abs() < 1e-9 {
                close(depth(deepest.edge), depth(edge), 1e-9);
                met += 1;
            }
        }
    }
    assert!(met == 1 && 0.0 < deepest.error, "{met}");
    assert!(20 < count && (depth(deepest.edge) == most || (depth(deepest.edge) / most - 1.0).abs() < 1e-9), "{count}");
    assert!(depth(answer.at_speed) < 0.95 * most, "{most} {:?}", answer.at_speed);
    let all = deepest.all_along.expect("it is followed so");
    let fixed = MillOptions { roll: RollMode::Fixed(deepest.roll), ..options.clone() };
    let rolled = mill(&path.robot, &stand, &path.stations, &fixed, Watch::nobody()).unwrap();
    let Milled::Followed(rolled) = rolled else { panic!("{rolled:?}") };
    let asked = (&process, &held, &options);
    let again = chatter_along(&path.robot, &stand, (&path.stations, &rolled.samples), asked, Watch::nobody()).unwrap();
    let (worst, answer) = again.worst.unwrap();
    assert_eq!((all.sample, all.error), (worst, rolled.worst.0));
    close(all.reserve, depth(answer.at_speed) / answer.cut.milling.engagement.depth(), 1e-9);
    // Margins and what stands about take rolls away.
    let usual = path.chatter(&process).deepest.unwrap();
    assert!(depth(usual.edge) <= most * (1.0 + 1e-12), "{usual:?} {most}");
}

#[test]
fn what_is_not_covered_is_reported_with_its_reason_and_never_as_calm() {
    let pose = |x: f64, z: f64| ToolPose { tip: Vector3::new(x, 0.0, z), axis: Vector3::z() };
    let one = |line, kind, from, to, given| Move {
        line,
        kind,
        from,
        to,
        course: Course::Line,
        feed: Some(0.02),
        normals: None,
        given,
    };
    let (feed, rapid, nothing) = (MoveKind::Feed, MoveKind::Rapid, Given::default());
    let force = Given { force: Some(Vector3::new(1.0, 2.0, 3.0)), ..nothing };
    let flat = Given { axial_depth: Some(0.0), ..nothing };
    let moves = [
        one(1, rapid, pose(0.0, 0.05), pose(0.0, 0.02), nothing),
        one(2, feed, pose(0.0, 0.02), pose(0.0, 0.0), nothing),
        one(3, feed, pose(0.0, 0.0), pose(0.04, 0.0), nothing),
        one(4, feed, pose(0.04, 0.0), pose(0.08, 0.0), force),
        one(5, feed, pose(0.08, 0.0), pose(0.12, 0.0), flat),
    ];
    let process = process([FRAC_PI_2, PI]);
    let path = followed(&moves, &process, None);
    let answer = path.chatter(&process);
    let expected = |line: usize| match line {
        1 => Some(Judged::Rapid),
        2 => Some(Judged::Uncovered(Uncovered::Plunge)),
        4 => Some(Judged::Uncovered(Uncovered::Force)),
        5 => Some(Judged::Uncovered(Uncovered::Air)),
        _ => None,
    };
    for (station, judged) in path.stations.iter().zip(&answer.samples) {
        match expected(station.sample.line) {
            Some(expected) => assert_eq!(*judged, expected, "{station:?}"),
            None => assert!(matches!(judged, Judged::Cut { .. }), "{judged:?}"),
        }
    }
    assert_eq!(path.stations[answer.worst.unwrap().0].sample.line, 3);
    // In a stock a plunge has no cut, and is none of the samples in air.
    let mut stock = Stock::block([-0.02, -0.02, -0.01], [0.02, 0.02, 1e-3], 2e-4).unwrap();
    let path = followed(&moves, &process, Some(&mut stock));
    let answer = path.chatter(&process);
    let on = |line: usize| {
        let there = path.stations.iter().zip(&answer.samples).filter(move |(station, _)| station.sample.line == line);
        there.map(|(_, judged)| *judged)
    };
    assert!(on(2).all(|judged| judged == Judged::Uncovered(Uncovered::Plunge)));
    assert!(on(3).any(|judged| matches!(judged, Judged::Cut { .. })));
    assert!(on(3).any(|judged| judged == Judged::Uncovered(Uncovered::Air)));
    // A path that only plunges has no worst sample.
    let path = followed(&moves[..2], &process, None);
    assert!(path.chatter(&process).worst.is_none());
}

fn at_posture(rpm: f64, engagement: [f64; 2], (feed, depth): ([f64; 3], f64), method: Method) -> Chatter {
    let (robot, tool, q) = kr210();
    let robot = stiffarm::prior::with_prior(&robot).unwrap();
    let q = [q[0], q[1], q[2], 0.3, 1.2, 0.0];
    let mut milling = end_mill(4, 0.016, engagement, CHIP);
    milling.engagement.arcs[0].depth = depth;
    let process = Process { spindle: Some(rpm * TAU / 60.0), is_clockwise: true, law: Law::Milling(milling) };
    chatter(&robot, &q, &tool, &process, &Asked { feed, damping: None, method: Some(method), measured: None }).unwrap()
}

/// Up for down: the answer to the question in which both are turned round by hand.
#[test]
fn the_other_way_is_the_answer_to_the_question_with_feed_and_engagement_turned_round() {
    // Tooth by tooth the depth is sought from another beginning.
    for (rpm, [entry, exit], method, within) in [
        (600.0, [0.0, 1.2], Method::Mean, 1e-9),
        (600.0, [FRAC_PI_2, PI], Method::Mean, 1e-9),
        (12e3, [0.0, 1.2], Method::Teeth, 1e-3),
    ] {
        let here = at_posture(rpm, [entry, exit], ([1.0, 0.5, 0.0], 1e-3), method);
        let there = at_posture(rpm, [PI - exit, PI - entry], ([-1.0, -0.5, 0.0], 1e-3), method);
        let depth = |edge: Option<stiffarm::chatter::Edge>| edge.map_or(f64::INFINITY, |edge| edge.depth);
        let [here_turned, there_turned] = [&here, &there].map(|found| depth(found.other_way));
        let [here, there] = [&here, &there].map(|found| depth(found.at_speed));
        for [turned, alone] in [[here_turned, there], [there_turned, here]] {
            assert!(turned == alone || (turned / alone - 1.0).abs() < within, "{rpm} {method:?}: {turned} {alone}");
        }
        assert!(0.02 < (here_turned / here - 1.0).abs(), "{rpm} {method:?}: {here_turned} {here}");
    }
}

#[test]
fn calm_speeds_are_those_at_which_the_cut_is_less_deep_than_the_interval() {
    let usual = at_posture(600.0, [FRAC_PI_2, PI], ([1.0, 0.0, 0.0], 1e-3), Method::Mean);
    let nearby = |found: &Chatter| {
        let (lobes, spindle) = (found.lobes.clone(), found.cut.spindle);
        lobes.into_iter().filter(move |lobe| (0.4999..1.5001).contains(&(lobe.spindle / spindle)))
    };
    let p05 = |found: &Chatter| -> Vec<f64> {
        nearby(found).map(|lobe| lobe.spread.unwrap().p05.unwrap_or(f64::INFINITY)).collect()
    };
    let all = p05(&usual);
    assert_eq!(all.len(), 101);
    let [least, most] = [all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(0.0, f64::max)];
    let of = |depth: f64| at_posture(600.0, [FRAC_PI_2, PI], ([1.0, 0.0, 0.0], depth), Method::Mean);
    let whole = of(0.99 * least).calm_speeds().unwrap();
    let ends = [0.5, 1.5].map(|share| share * usual.cut.spindle);
    assert!(matches!(whole[..], [[from, to]] if (from - ends[0]).abs() < 1e-6 && (to - ends[1]).abs() < 1e-6));
    assert!(of(1.01 * most).calm_speeds().unwrap().is_empty());
    let depth = (least * most).sqrt();
    let found = of(depth);
    let speeds = found.calm_speeds().unwrap();
    let is_within = |speed: f64| speeds.iter().any(|[from, to]| *from <= speed && speed <= *to);
    for lobe in nearby(&found) {
        let nominal = lobe.edge.is_none_or(|edge| depth < edge.depth);
        let calm = nominal && lobe.spread.unwrap().p05.is_none_or(|p05| depth < p05);
        assert_eq!(is_within(lobe.spindle), calm, "{lobe:?}");
    }
    assert!(!speeds.is_empty() && speeds.windows(2).all(|pair| pair[0][1] < pair[1][0]), "{speeds:?}");
}

#[test]
fn a_cut_that_turns_left_or_has_no_speed_is_refused_before_the_path() {
    let (robot, ..) = kr210();
    let good = process([FRAC_PI_2, PI]);
    let power = Law::Milling(Milling {
        edge: Edge::Power { specific: 700e6, exponent: 0.25, ratios: [0.3, 0.2] },
        ..end_mill(4, 0.016, [FRAC_PI_2, PI], CHIP)
    });
    assert!(stiffarm::mill::check_chatter(&robot, &Process { law: power, ..good.clone() }).is_ok());
    let refused = |process: Process, words: &str| {
        let error = stiffarm::mill::check_chatter(&robot, &process).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(Process { is_clockwise: false, ..good.clone() }, "counter-clockwise");
    refused(Process { spindle: None, ..good.clone() }, "spindle_rpm is missing");
    refused(Process { law: Law::Constant([1.0; 3]), ..good.clone() }, "a constant force is not covered");
    let bare = Robot { masses: Vec::new(), ..robot.clone() };
    let error = stiffarm::mill::check_chatter(&bare, &good).unwrap_err().to_string();
    assert!(error.contains("no masses in the robot file"), "{error}");
}
