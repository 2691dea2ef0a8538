//! Who is distinguished from whom in a ranking, and how near a place comes to limits: against brute force and by hand.

use stiffarm::catalogue::find;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::{Model, ModelKind};
use stiffarm::place::{Hold, MarginOf, PlaceOptions, Placed, Placement, place};
use stiffarm::plane::PlanarArm;
use stiffarm::rank::{Ranking, rank};
use stiffarm::robot::Robot;
use stiffarm::task::{Task, Zone};
use stiffarm::watch::Watch;
use stiffarm_ask::answer::RankAnswer;

fn robots(names: &[&str]) -> Vec<Robot> {
    names.iter().map(|name| find(name).expect("in the catalogue").robot()).collect()
}

fn ranking(names: &[&str], tasks: &[&str]) -> Ranking {
    let tasks: Vec<Task> = tasks.iter().map(|task| task.parse().unwrap()).collect();
    rank(&robots(names), &tasks, &ModelKind::Planar, &PlaceOptions::under(Load::PAPER), Watch::nobody()).unwrap()
}

/// The answer of a ranking whose bounds are moved by hand.
fn answer(ranking: Ranking, tolerance_mm: Option<f64>) -> RankAnswer {
    RankAnswer::of(ranking, PlaceOptions::under(Load::PAPER), tolerance_mm, Vec::new())
}

/// The two have the same lengths and limits.
#[test]
fn equal_robots_share_a_rank() {
    let ranking = ranking(&["IRB 7600-500/2.55", "KR 500 R2800-2", "IRB 7600-400/2.55"], &["B:0.5"]);
    let ranks: Vec<(&str, String)> =
        ranking.rows.iter().map(|row| (row.robot.name.as_str(), row.rank.unwrap().to_string())).collect();
    let expected = [("KR 500 R2800-2", "1"), ("IRB 7600-400/2.55", "2="), ("IRB 7600-500/2.55", "2=")];
    assert_eq!(ranks.iter().map(|(name, rank)| (*name, rank.as_str())).collect::<Vec<_>>(), expected);
    assert_eq!(ranking.ranks(0), ranking.rows.iter().map(|row| row.rank).collect::<Vec<_>>(), "of one task");
    assert!(ranking.rivals(0).is_empty());
    let json = answer(ranking, None).json();
    assert_eq!((&json["rows"][1]["rank"], &json["rows"][1]["rank_tied"]), (&2.into(), &true.into()));
    assert_eq!((&json["rows"][2]["cells"][0]["task_rank"], &json["rows"][0]["rank_tied"]), (&2.into(), &false.into()));
}

/// The lower bound of the second is moved below the value of the first.
#[test]
fn nobody_is_advised_who_is_not_distinguished() {
    let two = ["KR 210 R2700 extra", "BT200L"];
    let sure = answer(ranking(&two, &["B:0.5", "A:0.1"]), None);
    assert!(
        sure.sentences()[0].contains("take KUKA KR 210 R2700 extra (payload 210 kg) for B:0.5"),
        "{:?}",
        sure.sentences()
    );
    let mut open = ranking(&two, &["B:0.5", "A:0.1"]);
    let value = open.rows[0].deflection(0).unwrap();
    let Ok(Placed::Feasible(second)) = &mut open.rows[1].cells[0] else { panic!("it has a place") };
    second.lower_bound = 0.99 * value;
    assert_eq!(open.rivals(0).len(), 1);
    assert_eq!(open.ranks(0).iter().map(|rank| rank.unwrap().to_string()).collect::<Vec<_>>(), ["1=", "1="]);
    let open = answer(open, None);
    let sentence = &open.sentences()[0];
    assert!(sentence.contains("take KUKA KR 210 R2700 extra (payload 210 kg) for A:0.1"), "{sentence}");
    assert!(
        sentence.contains("KR 210 R2700 extra") && sentence.contains("cannot be distinguished on B:0.5"),
        "{sentence}"
    );
    assert!(!sentence.contains("for B:0.5"), "{sentence}");
    assert_eq!(open.json()["winners"][0]["told_apart"], false);
    assert_eq!(open.json()["winners"][0]["rivals"], serde_json::json!(["BT200L"]));
    assert_eq!(open.json()["winners"][1]["told_apart"], true);
    let table = open.table();
    assert_eq!((table.headings[5].as_str(), table.rows[1][5].as_str()), ("B:0.5", "2.298="));
    // Where the tolerance is not kept, that is said first.
    let mut failing = open.clone();
    failing.tolerance_mm = Some(0.1);
    assert!(
        failing.sentences()[0].contains("no robot is advised") && !failing.sentences()[0].contains("distinguished")
    );
}

/// Points of a zone as it stands, in the arm plane from the joint-2 axis.
fn points(zone: Zone, best: &Placement, [ahead, up]: [f64; 2]) -> Vec<[f64; 2]> {
    let (s, c) = best.angle.sin_cos();
    let side = |i: usize| 2.0 * i as f64 / 60.0 - 1.0;
    let nodes = (0..=60).flat_map(|i| (0..=60).map(move |j| zone.at([side(i), side(j)])));
    nodes.map(|[u, v]| [best.centre[0] + c * u - s * v - ahead, best.centre[1] + s * u + c * v - up]).collect()
}

/// By the law of cosines at 3721 points: angles of an arm that holds the zone with the given elbow, to their limits.
fn sampled(arm: &PlanarArm, points: &[[f64; 2]], elbow_sign: f64) -> f64 {
    let mut least = f64::INFINITY;
    for [x, z] in points {
        let (r, bearing) = (x.hypot(*z), z.atan2(*x));
        let inner = ((r * r - arm.l2 * arm.l2 - arm.l3 * arm.l3) / (2.0 * arm.l2 * arm.l3)).clamp(-1.0, 1.0).acos();
        let at_shoulder = (arm.l3 * inner.sin()).atan2(arm.l2 + arm.l3 * inner.cos());
        let shoulder = bearing - elbow_sign * at_shoulder;
        let (elbow, forearm) = (elbow_sign * inner, shoulder + elbow_sign * inner);
        let room = |limit: Interval, angle: f64| {
            let turns = [-1.0, 0.0, 1.0].map(|turn| limit.room(angle + turn * std::f64::consts::TAU));
            turns.into_iter().fold(f64::NEG_INFINITY, f64::max)
        };
        let rooms = [
            room(arm.shoulder, shoulder),
            room(arm.elbow, elbow),
            room(arm.forearm, forearm),
            inner.min(std::f64::consts::PI - inner),
        ];
        least = rooms.into_iter().fold(least, f64::min);
    }
    least
}

#[test]
fn the_smallest_margin_in_the_plane_is_that_of_all_points_of_the_zone() {
    let mut kinds = Vec::new();
    for name in ["KR 210 R2700 extra", "BT200L", "IRB 6400 2.4-200", "ZX200U", "TX340 SH"] {
        for (task, options) in [
            ("B:0.3", PlaceOptions::under(Load::PAPER)),
            ("A:0.5", PlaceOptions::careful(Load::PAPER)),
            (
                "rect:0.4x0.2",
                PlaceOptions {
                    orientation: stiffarm::place::Orientation::Fixed(0.5),
                    ..PlaceOptions::careful(Load::PAPER)
                },
            ),
        ] {
            let robot = find(name).expect("in the catalogue").robot();
            let model = Model::planar(&robot).unwrap();
            let Model::Planar(planar) = &model else { panic!("planar") };
            let zone = task.parse::<Task<Zone>>().unwrap().work;
            let placed = place(&model, &zone.into(), &options, Watch::nobody()).unwrap();
            let Some(best) = placed.feasible() else { continue };
            let (margin, of) = best.smallest_margin().expect("a place has a margin");
            let sign = if best.elbow == stiffarm::plane::Elbow::Up { -1.0 } else { 1.0 };
            let seen = sampled(planar.arm(), &points(zone, best, planar.axis_from_base()), sign);
            // The grid holds the corners; between its points, 1/60 of a side, angles change by less than 1/50 rad, at an extreme much less.
            assert!(
                margin <= seen.max(0.0) + 1e-9 && seen.max(0.0) - margin < 2e-4,
                "{name} {task}: {margin} of {of:?}, {seen}"
            );
            assert!(options.margins.limit - 1e-6 <= margin || of == MarginOf::Straight, "{name} {task}: {margin}");
            assert!(matches!(best.hold, Hold::Plane { margin: Some(_), .. }));
            kinds.push(of);
        }
    }
    assert!(
        12 <= kinds.len() && kinds.contains(&MarginOf::Joint(2)) && kinds.contains(&MarginOf::BetweenLinks),
        "{kinds:?}"
    );
}
