//! Does a path keep what a zone keeps: column, floor, mount, windows and what must be kept free?

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use stiffarm::catalogue::paper_robots;
use stiffarm::cell::Mount;
use stiffarm::mill::{Milled, Stand, mill};
use stiffarm::place::column_radius;
use stiffarm::program::Language;
use stiffarm::robot::Robot;
use stiffarm::toolpath::Builtin;
use stiffarm::watch::Watch;
use stiffarm_ask::answer::{MillAnswer, MillAnswerError};
use stiffarm_ask::request::{Pair, Refusal, Request, Spelling, Verb};

fn robot() -> Robot {
    paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("a robot of the paper")
}

fn request(path: &str, options: &[(&str, &str)]) -> Result<Request, Refusal> {
    let usual = [
        ("path", path),
        ("robot", "it"),
        ("force-n", "300,-120,80"),
        ("tool-mm", "200,0,150,0,60,0"),
        ("step-mm", "50"),
    ];
    let pair = |(name, text): &(&str, &str)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed };
    let is_usual = |(name, _): &&(&str, &str)| options.iter().all(|(other, _)| other != name);
    Request::read(
        Verb::Mill,
        &usual.iter().filter(is_usual).chain(options).map(pair).collect::<Vec<_>>(),
        Spelling::Typed,
    )
}

fn asked(path: &str, options: &[(&str, &str)]) -> Result<MillAnswer, MillAnswerError> {
    let moves = path.parse::<Builtin>().expect("built in").moves(Some(0.01));
    MillAnswer::of(&request(path, options)?, &robot(), (path.into(), &moves), None, Watch::nobody())
}

fn answered(path: &str, options: &[(&str, &str)]) -> MillAnswer {
    asked(path, options).expect("an answer")
}

/// At a place that is sought, the part turned as one likes, the tool not.
fn placed(path: &str, options: &[(&str, &str)]) -> MillAnswer {
    answered(path, &[&[("roll", "0")], options].concat())
}

/// The largest error, m.
fn worst(answer: &MillAnswer) -> f64 {
    answer.followed().unwrap_or_else(|| panic!("{:?}", answer.reason())).worst.0
}

/// Every tip, m, in the axes of the cell, by hand.
fn tips(answer: &MillAnswer, at: [f64; 3], yaw: f64) -> Vec<[f64; 3]> {
    let (s, c) = yaw.sin_cos();
    let tip = |p: Vector3<f64>| [at[0] + c * p.x - s * p.y, at[1] + s * p.x + c * p.y, at[2] + p.z];
    answer.stations.iter().map(|station| tip(station.sample.pose.tip)).collect()
}

/// A side of 1.2 m that lies across the way to the robot comes nearest in its middle, where none of the outermost samples is.
#[test]
fn every_tip_of_a_path_keeps_the_column_the_front_and_the_floor() {
    let own = column_radius(&robot()).expect("its lengths are known");
    let close = [("within", "0.3..1.8,0.0..1.4"), ("tool-mm", "0,0,200")];
    let answer = placed("rect:1.2x0.2", &close);
    let placement = answer.placement.expect("a place");
    let nearest = |answer: &MillAnswer| {
        let placement = answer.placement.expect("a place");
        let away = tips(answer, placement.at, placement.yaw).into_iter().map(|[x, y, _]| x.hypot(y));
        away.fold(f64::INFINITY, f64::min)
    };
    assert!(own - 1e-6 < nearest(&answer) && nearest(&answer) < own + 0.4, "{} {own} {placement:?}", nearest(&answer));
    let farther = placed("rect:1.2x0.2", &[close[0], close[1], ("clear-of-base-m", "0.95")]);
    assert!(0.95 - 1e-6 < nearest(&farther) && worst(&answer) <= worst(&farther) * 1.01);
    for [x, _, z] in tips(&answer, placement.at, placement.yaw) {
        assert!((0.3 - 1e-6..1.8 + 1e-6).contains(&x) && (-1e-6..1.4 + 1e-6).contains(&z), "{x} {z}");
    }
    let usual = placed("rect:0.3x0.2", &[("floor", "0.9")]);
    let placement = usual.placement.expect("a place");
    assert!(tips(&usual, placement.at, placement.yaw).iter().all(|[x, _, z]| -1e-6 < *x && 0.9 - 1e-6 < *z));
}

/// Turned by 30 deg on a pedestal of half a metre the robot meets the same window half a metre higher; by hand.
#[test]
fn a_pedestal_raises_what_is_asked_and_turns_what_is_reported() {
    let alone = placed("rect:0.3x0.2", &[("within", "1.0..2.0,0.4..1.0")]);
    let raised = placed("rect:0.3x0.2", &[("within", "1.0..2.0,0.9..1.5"), ("mount", "pedestal:0.5@30")]);
    let [one, other] = [&alone, &raised].map(|answer| answer.placement.expect("a place"));
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{one:?} {other:?}");
    near(worst(&alone) * 1e3, worst(&raised) * 1e3);
    let (s, c) = 30_f64.to_radians().sin_cos();
    let [x, y, z] = one.at;
    [c * x - s * y, s * x + c * y, z + 0.5].into_iter().zip(other.at).for_each(|(a, b)| near(a, b));
    near(other.yaw - one.yaw, 30_f64.to_radians());
    (0..3).for_each(|i| near(other.at_from_base()[i], one.at[i]));
    near(other.yaw_from_ahead().expect("it is upright"), one.yaw);
}

/// Places by chance in cells of every kind, their tips and the pose before the base by hand: none that is allowed is better than what is
/// proved, none by more than the last step leaves than what is found; and the place that is found is allowed, and asked for
/// again has the same error.
#[test]
fn no_allowed_place_by_chance_is_better_than_what_is_proved_in_a_cell() {
    type Ranges = [[f64; 2]; 3];
    let cases: [(&str, Mount, Ranges, Option<Ranges>); 3] = [
        (
            "pedestal:0.4@20",
            Mount::pedestal(0.4).turned(20_f64.to_radians()),
            [[0.2, 2.2], [-1.6, 1.6], [0.6, 1.8]],
            Some([[0.9, 2.0], [-0.6, 0.7], [0.0, 1.5]]),
        ),
        ("ceiling:3", Mount::ceiling(3.0), [[0.2, 2.0], [-1.0, 1.5], [0.8, 2.2]], None),
        (
            "wall:1.8",
            Mount::wall(1.8),
            [[0.4, 2.0], [-1.2, 1.2], [0.2, 1.4]],
            Some([[0.9, 1.5], [-0.4, 0.4], [0.0, 0.8]]),
        ),
    ];
    let mut rng = fastrand::Rng::with_seed(4);
    for (mount, pose, window, kept) in cases {
        let in_words = |ranges: Ranges| ranges.map(|[a, b]| format!("{a}..{b}")).join(",");
        let (within, free) = (in_words(window), kept.map(in_words));
        let mut options = vec![("mount", mount), ("within", within.as_str())];
        options.extend(free.as_ref().map(|free| ("keep-out", free.as_str())));
        let answer = placed("rect:0.2x0.1", &options);
        let column = column_radius(&answer.robot).expect("its lengths are known");
        let is_allowed = |tips: &[[f64; 3]]| {
            let holds = |ranges: &Ranges, tip: &[f64; 3], by: f64| {
                (0..3).all(|i| ranges[i][0] - by <= tip[i] && tip[i] <= ranges[i][1] + by)
            };
            let from_axis = |tip: &[f64; 3]| (pose.cell_from_base.inverse() * Point3::from(*tip)).coords.xy().norm();
            tips.iter().all(|tip| {
                holds(&window, tip, 1e-6)
                    && column - 1e-6 < from_axis(tip)
                    && !kept.is_some_and(|kept| holds(&kept, tip, -1e-6))
            })
        };
        let placement = answer.placement.expect("a place");
        assert!(is_allowed(&tips(&answer, placement.at, placement.yaw)), "{mount}: {placement:?}");
        let [x, y, z] = placement.at;
        let at = format!("{x},{y},{z},{}", placement.yaw.to_degrees());
        let again = placed("rect:0.2x0.1", &[("mount", mount), ("at", &at)]);
        assert!((worst(&again) / worst(&answer) - 1.0).abs() < 1e-6, "{mount}: {} {}", worst(&again), worst(&answer));
        let bound = answer.lower_bound().expect("a place");
        // Of a base that leans no turn about its axis saves a dimension, and the boxes may not be enough.
        assert!(
            (0.0 < bound || mount.starts_with("wall")) && bound <= worst(&answer),
            "{mount}: {bound} {}",
            worst(&answer)
        );
        let (mut followed, mut least) = (0, f64::INFINITY);
        for _ in 0..400 {
            let at: [f64; 3] = std::array::from_fn(|i| window[i][0] + (window[i][1] - window[i][0]) * rng.f64());
            let yaw = std::f64::consts::TAU * rng.f64();
            if !is_allowed(&tips(&answer, at, yaw)) {
                continue;
            }
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
            let cell_from_part = Isometry3::from_parts(Translation3::from(Vector3::from(at)), turn);
            let base_from_part = pose.cell_from_base.inverse() * cell_from_part;
            let stand = Stand { base_from_part, flange_from_tool: answer.flange_from_tool };
            let milled =
                mill(&answer.robot, &stand, &answer.stations, &answer.options, Watch::nobody()).expect("an answer");
            if let Milled::Followed(other) = milled {
                assert!(bound <= other.worst.0, "{mount} {at:?} {yaw}: {bound} {}", other.worst.0);
                (followed, least) = (followed + 1, least.min(other.worst.0));
            }
        }
        assert!(10 < followed && worst(&answer) <= least * 1.001, "{mount}: {followed}, {} {least}", worst(&answer));
    }
}

/// A box where the best place is: no tip of the path lies in it, nor does any straight way between two of them cross it.
#[test]
fn a_path_keeps_out_of_a_box_where_it_would_stand_best() {
    let base = [("mount", "pedestal:0"), ("within", "1.2..2.0,-0.4..0.4,0.7..0.9")];
    let free = placed("line:0.1", &base);
    let at = free.placement.expect("a place");
    let held = tips(&free, at.at, at.yaw);
    let middle: [f64; 3] = std::array::from_fn(|i| held.iter().map(|tip| tip[i]).sum::<f64>() / held.len() as f64);
    let half = [0.06, 0.06, 0.5];
    let kept =
        (0..3).map(|i| format!("{}..{}", middle[i] - half[i], middle[i] + half[i])).collect::<Vec<_>>().join(",");
    let beside = placed("line:0.1", &[&base[..], &[("keep-out", kept.as_str())]].concat());
    let at = beside.placement.expect("a place");
    for tip in tips(&beside, at.at, at.yaw) {
        assert!((0..3).any(|i| half[i] - 1e-6 <= (tip[i] - middle[i]).abs()), "{tip:?} {middle:?}");
    }
    assert!(worst(&free) <= worst(&beside) * 1.001);
}

/// Wherever the samples that stand for this path lead to, some joint would have to jump between two of them. A window that holds less of these places, and
/// one that holds more, have a place at which the path is followed; so has this one.
#[test]
fn a_place_is_found_where_the_samples_that_stand_for_a_path_lead_to_jumps() {
    let at = |within| placed("rect:1.2x0.2", &[("within", within), ("tool-mm", "0,0,200")]);
    let (wide, narrow) = (at("0.3..1.8,0.0..1.4"), at("0.3..1.8,0.3..1.4"));
    // What stands in the wide window at 0.88 m stands in the narrow one, too.
    assert!(wide.placement.expect("a place").at[2] > 0.3);
    assert!(worst(&narrow) <= worst(&wide), "{} {}", worst(&narrow), worst(&wide));
}

#[test]
fn what_says_where_a_path_is_sought_does_not_go_with_a_place_that_is_given() {
    for (name, text) in [("clear-of-base-m", "0.5"), ("within", "1..2,0..1")] {
        let refused = request("line:0.1", &[("at", "1.5,0,0.5"), (name, text)]).expect_err("refused").to_string();
        assert!(refused.contains("at") && refused.contains(name), "{refused}");
    }
    let floor = asked("line:0.1", &[("mount", "pedestal:0.5"), ("floor", "0.1")]).expect_err("refused").to_string();
    assert!(floor.contains("the floor is that of the cell"), "{floor}");
    // The arm keeps clear of these wherever the path stands.
    for (name, text) in [("keep-out", "0..1,0..1,0..1"), ("floor", "0.1"), ("clearance-mm", "20")] {
        assert!(request("line:0.1", &[("at", "1.5,0,0.5"), (name, text)]).is_ok(), "{name}");
    }
}

/// An arm that stands in a floor: the path is reported with what is touched, and a program is written where that is allowed alone.
#[test]
fn a_program_is_written_over_a_touch_only_where_that_is_allowed() {
    let answer = |options: &[(&str, &str)]| answered("line:0.1", &[&[("at", "1.5,0,0.8")], options].concat());
    let clear = answer(&[]);
    let json = clear.json();
    assert_eq!((json["contacts"].as_array().map(Vec::len), &json["asked_clearance_mm"]), (Some(0), &0.0.into()));
    assert!(0.0 < json["clearance_mm"].as_f64().expect("a distance"), "{json}");
    assert!(clear.program(Language::Krl).is_ok() && clear.shortfall().is_none());
    let flooded = [("floor", "0.9")];
    let touching = answer(&flooded);
    let json = touching.json();
    let contact = &json["contacts"][0];
    assert!(contact["bodies"].as_str().is_some_and(|bodies| bodies.ends_with("to floor")), "{json}");
    let depth = contact["depth_mm"].as_f64().expect("a depth");
    assert!((depth + json["clearance_mm"].as_f64().expect("a distance")).abs() < 1e-9 && 0.0 < depth, "{json}");
    let refused = touching.program(Language::Krl).expect_err("refused").to_string();
    let named = contact["bodies"].as_str().expect("bodies");
    assert!(refused.contains(named) && refused.contains("allow-contact"), "{refused}");
    assert!(touching.shortfall().is_some_and(|why| why.contains(named)));
    let allowed = answer(&[flooded[0], ("allow-contact", "true")]);
    let program = allowed.program(Language::Krl).expect("it is allowed");
    assert!(program.contains("WARNING: written although"), "{program}");
    assert!(allowed.shortfall().is_none());
    // Of what is asked and not kept the distance is reported.
    let near = answer(&[("clearance-mm", "2000")]);
    let refused = near.program(Language::Krl).expect_err("refused").to_string();
    assert!(refused.contains("mm apart, 2000.0 mm asked"), "{refused}");
}

/// One process is not that of two tools, and of each tool only its own cuts are milled.
#[test]
fn a_path_with_two_tools_is_milled_tool_by_tool() {
    use stiffarm::toolpath::{Format, Move, ReadOptions, read};
    let moves = |text: &str| {
        let mut moves: Vec<Move> = Vec::new();
        let (options, mut each) = (ReadOptions::default(), |one: &Move| moves.push(*one));
        read(&mut text.as_bytes(), "two.nc", Format::GCode, &options, &mut each, &mut |_| Ok(())).expect("read");
        moves
    };
    let mill = |text: &str, options: &[(&str, &str)]| {
        let options = [&[("at", "1.6,0,0.8")], options].concat();
        MillAnswer::of(&request("two.nc", &options)?, &robot(), ("two.nc".into(), &moves(text)), None, Watch::nobody())
    };
    let head = "G21 G90 G94\n";
    let one = "G0 X0 Y0 Z5\nG1 Z0 F500\nG1 X100\nG0 Z5\n";
    let other = "G0 X0 Y50 Z5\nG1 Z0 F500\nG1 X50\nG0 Z5\n";
    // By M6 the next tool is named while the first cuts; without it T changes.
    for file in [
        format!("{head}T1 M6\nT2\n{one}M6\n{other}M2\n"),
        format!("{head}T1\n{one}T2\n{other}M2\n"),
        format!("{head}M6 T1\n{one}M6 T2\n{other}T1 M6\n{one}M2\n"),
    ] {
        let refused = mill(&file, &[]).expect_err("two tools").to_string();
        assert!(refused.contains("changes its tool (T1 from line") && refused.contains("T2 from line"), "{refused}");
        let absent = mill(&file, &[("only-tool", "3")]).expect_err("no such tool").to_string();
        assert!(absent.contains("3 never feeds; the path has T1"), "{absent}");
        let second = mill(&file, &[("only-tool", "2")]).expect("an answer");
        let alone = mill(&format!("{head}{other}M2\n"), &[]).expect("an answer");
        assert!((worst(&second) - worst(&alone)).abs() < 1e-12, "the same cuts");
        let cut = |answer: &MillAnswer| answer.stations.iter().filter(|station| station.sample.is_cutting).count();
        assert_eq!(cut(&second), cut(&alone));
    }
    let same = format!("{head}T1 M6\n{one}T1 M6\n{other}M2\n");
    assert!(mill(&same, &[]).is_ok(), "the same tool twice is one tool");
}

/// The first straight move of a program leads down to the beginning of the path from above it, and its head says what is not in it.
#[test]
fn a_program_begins_above_the_path_and_says_what_is_not_in_it() {
    let answer = answered("line:0.1", &[("at", "1.6,0,0.8")]);
    let text = answer.program(stiffarm::program::Language::Krl).expect("a program");
    let head: Vec<&str> = text.lines().take(4).collect();
    assert!(head[1].contains("spindle, coolant and tool changes are not in it"), "{head:?}");
    assert!(head[2].contains("50 mm above the path's beginning"), "{head:?}");
    let first = answer.followed().expect("followed").samples[0].joints;
    let stiffarm::robot::Arm::SixAxis { geometry, limits, .. } = &answer.robot.arm else { panic!("six axes") };
    let start = text.lines().find(|line| line.starts_with("PTP {A1")).expect("a start");
    let numbers = start.split(['{', '}', ',']).filter_map(|part| part.split_once(' ')?.1.parse::<f64>().ok());
    let numbers: Vec<f64> = numbers.map(f64::to_radians).collect();
    let tip = |joints: &[f64]| {
        let theta = geometry.model_angles(joints.try_into().expect("six"), limits.third_axis);
        (geometry.forward(&theta) * answer.flange_from_tool).translation.vector
    };
    let up = tip(&numbers) - tip(&first);
    assert!((up - Vector3::new(0.0, 0.0, 0.05)).norm() < 1e-6, "{up}");
    let down = text.lines().find(|line| line.starts_with("LIN")).expect("straight moves");
    let from = answer.stations[0].sample.pose.tip * 1e3;
    assert!(down.contains(&format!("X {:.4}", from.x)), "{down} {from}");
    assert!(text.lines().position(|line| line.starts_with("$VEL.CP=0.01")).is_some(), "down at the feed rate: {text}");
}

/// A roll that may change is no worse than one that may not: what one roll gives is a way for the other as well. (Places were judged by the best
/// roll of each sample alone, between which no way led.)
#[test]
fn at_the_best_place_free_rolls_are_no_worse_than_a_constant_one() {
    let spindle = [("tool-mm", "250,0,0,0,90,0"), ("force-n", "300,100,50"), ("step-mm", "10")];
    let with = |roll: &str| worst(&answered("raster:circle:0.3@0.05", &[&spindle[..], &[("roll", roll)]].concat()));
    let [free, constant] = ["free", "constant"].map(with);
    assert!(free <= constant * (1.0 + 1e-3), "{free} {constant}");
}
