//! What is reported of a cut: verdicts only where the interval gives them, the way of counting teeth, and what is refused.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;
use stiffarm::catalogue::{find, with_compliance};
use stiffarm::chatter::{Asked, Chatter, ChatterError, Method, Verdict, chatter};
use stiffarm::cutting::{Law, Milling, Process};
use stiffarm::modes::{Damping, HeldTool, modes};
use stiffarm::prior::with_prior;
use stiffarm::robot::Robot;

use crate::chatter::{close, mill};
use crate::modes::kr210;

fn process(milling: &Milling, rpm: f64) -> Process {
    Process { spindle: Some(rpm * TAU / 60.0), is_clockwise: true, law: Law::Milling(milling.clone()) }
}

const ALONG_X: Asked = Asked { feed: [1.0, 0.0, 0.0], damping: None, method: None, measured: None };

/// The KR 210 as its size tells it.
fn by_prior() -> (Robot, HeldTool, [f64; 6]) {
    let (robot, tool, q) = kr210();
    (with_prior(&robot).unwrap(), tool, [q[0], q[1], q[2], 0.0, 90_f64.to_radians(), 0.0])
}

fn of_depth(depth: f64) -> Chatter {
    let (robot, tool, q) = by_prior();
    let mut milling = mill(4, 0.02, [0.0, FRAC_PI_2], [1930e6, 1160e6, 200e6]);
    milling.engagement.arcs[0].depth = depth;
    chatter(&robot, &q, &tool, &process(&milling, 900.0), &ALONG_X).unwrap()
}

#[test]
fn a_verdict_is_given_only_where_the_interval_gives_it() {
    let found = of_depth(1e-3);
    let (p05, p95) = (found.spread.p05.unwrap(), found.spread.p95.unwrap());
    let edge = found.at_speed.unwrap();
    assert!(p05 < edge.depth && edge.depth < p95 && 2.0 * p05 < p95);
    assert_eq!(of_depth(0.99 * p05).verdict(), Verdict::Calm);
    assert_eq!(of_depth(1.01 * p05).verdict(), Verdict::NotDecided);
    assert_eq!(of_depth(0.99 * p95).verdict(), Verdict::NotDecided);
    assert_eq!(of_depth(1.01 * p95).verdict(), Verdict::Limits(edge.depth));
    let any = (found.any_speed.unwrap().depth, found.any_speed_spread.p05.unwrap());
    assert!(any.0 <= edge.depth && any.1 <= p05, "{any:?}");
    close(found.tooth_phase().unwrap(), TAU * edge.frequency / 60.0, 1e-12);
    assert_eq!((found.method, found.damping_is_drawn, found.drives_are_drawn), (Method::Mean, true, true));
    // The chart holds the speed of the cut.
    let at = found.lobes.iter().find(|lobe| (lobe.spindle / found.cut.spindle - 1.0).abs() < 1e-12).unwrap();
    assert_eq!((at.edge, at.spread), (found.at_speed, Some(found.spread)));
    assert_eq!(found.lobes.len(), 191);
}

/// Where two modes nearly meet, the nominal stiffness may swing sooner than all but a few draws, which have them apart.
#[test]
fn a_cut_that_swings_at_the_nominal_stiffness_is_never_calm_and_one_that_does_not_is_never_limited() {
    // What swings does not depend on how deep is cut.
    let all = of_depth(1e-3);
    let (p05, p95) = (all.spread.p05.unwrap(), all.spread.p95.unwrap());
    let where_nominal = |depth: f64, nominal: f64| {
        let mut found = all.clone();
        found.cut.milling.engagement.arcs[0].depth = depth;
        for edge in found.at_speed.iter_mut().chain(found.lobes.iter_mut().filter_map(|lobe| lobe.edge.as_mut())) {
            edge.depth = nominal;
        }
        found
    };
    let before = where_nominal(0.99 * p05, 0.98 * p05);
    assert_eq!((before.verdict(), before.calm_speeds()), (Verdict::NotDecided, Some(Vec::new())));
    assert_eq!(where_nominal(0.99 * p05, 1.01 * p05).verdict(), Verdict::Calm);
    assert_eq!(where_nominal(1.01 * p95, 1.02 * p95).verdict(), Verdict::NotDecided);
    assert_eq!(where_nominal(1.03 * p95, 1.02 * p95).verdict(), Verdict::Limits(1.02 * p95));
}

#[test]
fn drives_that_are_nobodys_decide_nothing_and_a_given_damping_has_no_interval() {
    let (robot, tool, q) = by_prior();
    let paper = stiffarm::prior::as_in_the_paper(&robot);
    let mut milling = mill(4, 0.02, [0.0, FRAC_PI_2], [1930e6, 1160e6, 200e6]);
    milling.engagement.arcs[0].depth = 2e-6;
    let found = chatter(&paper, &q, &tool, &process(&milling, 900.0), &ALONG_X).unwrap();
    assert_eq!((found.verdict(), found.drives_are_drawn), (Verdict::NotDecided, false));
    assert!(2e-6 < found.spread.p05.unwrap());
    let stated = with_compliance(&robot, [0.477, 0.296, 0.358, 2.52, 3.01, 2.1]).unwrap();
    let asked = Asked { damping: Some(Damping::Ratio(0.05)), ..ALONG_X };
    let found = chatter(&stated, &q, &tool, &process(&milling, 900.0), &asked).unwrap();
    let depth = found.at_speed.unwrap().depth;
    assert_eq!((found.spread.p05, found.spread.p95), (Some(depth), Some(depth)));
    assert_eq!(found.verdict(), Verdict::Calm);
}

#[test]
fn a_short_slow_cut_is_counted_tooth_by_tooth_unless_another_way_is_asked() {
    let (robot, tool, q) = by_prior();
    let milling = mill(2, 0.02, [PI - 0.45, PI], [1930e6, 1160e6, 200e6]);
    let of = |rpm: f64, method: Option<Method>| {
        chatter(&robot, &q, &tool, &process(&milling, rpm), &Asked { method, ..ALONG_X }).unwrap()
    };
    let found = of(600.0, None);
    assert_eq!(found.method, Method::Teeth);
    let (p05, edge) = (found.spread.p05.unwrap(), found.at_speed.unwrap());
    assert!(p05 < edge.depth && found.lobes.iter().all(|lobe| lobe.spread.is_none()) && 10 < found.lobes.len());
    assert_eq!(of(600.0, Some(Method::Mean)).method, Method::Mean);
    assert_eq!(of(12_000.0, None).method, Method::Mean);
}

#[test]
fn what_is_not_covered_is_refused_by_its_name() {
    let (robot, tool, q) = by_prior();
    let milling = mill(4, 0.02, [0.0, FRAC_PI_2], [1930e6, 1160e6, 200e6]);
    let good = process(&milling, 900.0);
    let refused = |process: &Process, asked: &Asked| {
        chatter(&robot, &q, &tool, process, asked)
            .err()
            .unwrap_or_else(|| panic!("{process:?} is answered"))
            .to_string()
    };
    for (law, name) in [
        (Law::Drilling { thrust: 500.0, torque: 2.0 }, "chatter of drilling is not covered"),
        (Law::Constant([1.0, 2.0, 3.0]), "chatter of a constant force"),
        (Law::Worst(100.0), "chatter of a force in any direction"),
        (Law::FrictionStir { axial: 1.0, traverse: 1.0, side: 0.0, torque: 0.0 }, "chatter of friction stir welding"),
    ] {
        let message = refused(&Process { law, ..good.clone() }, &ALONG_X);
        assert!(message.contains(name) && message.contains("expected a flat end mill"), "{message}");
    }
    assert!(refused(&Process { is_clockwise: false, ..good.clone() }, &ALONG_X).contains("counter-clockwise"));
    assert!(refused(&Process { spindle: None, ..good.clone() }, &ALONG_X).contains("spindle_rpm is missing"));
    let mut none = milling;
    none.engagement.arcs[0].depth = f64::NAN;
    assert!(refused(&process(&none, 900.0), &ALONG_X).contains("a depth of cut of NaN"));
    // The tool of the posture points down.
    let down = modes(&robot, &q, &tool, None).unwrap().tool.rotation * Vector3::z();
    assert!((down + Vector3::z()).norm() < 1e-9, "{down}");
    assert!(refused(&good, &Asked { feed: [0.1, 0.0, -1.0], ..ALONG_X }).contains("a plunge"));
    for feed in [[0.0; 3], [f64::NAN, 0.0, 0.0], [f64::INFINITY, 0.0, 0.0]] {
        assert!(refused(&good, &Asked { feed, ..ALONG_X }).contains("expected three finite numbers, not all 0"));
    }
    let undamped = Asked { damping: Some(Damping::Ratio(0.0)), ..ALONG_X };
    assert!(refused(&good, &undamped).contains("has no damping"));
    let bare = find("KR 210 R2700 extra").unwrap().robot();
    let found = chatter(&bare, &q, &tool, &good, &ALONG_X);
    assert!(matches!(found, Err(ChatterError::Modes(_))));
}
