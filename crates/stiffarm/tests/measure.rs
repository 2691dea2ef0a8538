//! Is a plan of measurements what it says: certified, shown, and good for an identification?

use nalgebra::Vector3;
use stiffarm::catalogue::find;
use stiffarm::catalogue::measurements::{Measurements, Reading};
use stiffarm::compliance::{beyond_limits, compliance};
use stiffarm::identify::{Options as IdentifyOptions, identify};
use stiffarm::interval::Interval;
use stiffarm::measure::{Cone, Criterion, Instrument, LoadWay, MeasureError, Options, compare, over, plan};
use stiffarm::prior::with_prior;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::{Pose, Wrench};
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

fn kuka() -> Robot {
    with_prior(&find("KR 210 R2700 extra").unwrap().robot()).unwrap()
}

fn way(name: &str, along: [f64; 3]) -> LoadWay {
    LoadWay { name: name.into(), along: along.into() }
}

fn usual() -> Options {
    let at = Vector3::new(0.0, 0.1, 0.25);
    Options {
        criterion: Criterion::Prediction,
        ways: vec![way("down", [0.0, 0.0, -1.0]), way("left", [0.0, 1.0, 0.0]), way("ahead", [1.0, 0.0, 0.0])],
        newtons: 1000.0,
        load_at: at,
        markers: vec![at],
        sigma: 2e-5,
        posture_sigma: 0.0,
        repeats: 12,
        runs: 12,
        candidates: 900,
        window: None,
        instrument: None,
        work: Vec::new(),
        tool: at,
    }
}

#[test]
fn a_plan_is_certified_and_far_better_than_chance() {
    let robot = kuka();
    let found = plan(&robot, &usual(), Watch::nobody()).unwrap();
    assert_eq!((found.runs.len(), found.unseen.len(), found.candidates), (12, 0, 900));
    assert!(0.9 < found.efficiency() && found.efficiency() <= 1.0 + 1e-12, "{}", found.efficiency());
    assert!(0.99 < found.shares_efficiency, "{}", found.shares_efficiency);
    assert!(found.lower_bound / found.random < 0.8, "random choices are as good: {}", found.lower_bound / found.random);
    for run in &found.runs {
        assert!(beyond_limits(&robot, &run.q).is_empty());
        // What is expected is what the compliance of the posture says.
        let posed = compliance(&robot, &run.q, &Pose::translation(0.0, 0.1, 0.25)).unwrap();
        let (moved, _) = posed.compliance.deflection(&run.load);
        assert!((moved - run.expected[0]).norm() < 1e-12 && 0.0 <= posed.tool.translation.z);
    }
    assert_eq!(found, plan(&robot, &usual(), Watch::nobody()).unwrap(), "the same again");
    // Its own runs, judged as a table of somebody.
    let own: Vec<_> = found.runs.iter().map(|run| (run.q, run.load)).collect();
    let (value, efficiency) = compare(&robot, &usual(), &own, Watch::nobody()).unwrap();
    assert!((value / found.value - 1.0).abs() < 1e-9 && (efficiency / found.efficiency() - 1.0).abs() < 1e-9);
}

/// Under weights alone nothing turns drive 1, whatever the posture.
#[test]
fn drives_that_the_loads_do_not_show_are_named_and_the_others_planned() {
    let options = Options { ways: vec![way("down", [0.0, 0.0, -1.0])], ..usual() };
    let found = plan(&kuka(), &options, Watch::nobody()).unwrap();
    let [one] = found.unseen.as_slice() else { panic!("{:?}", found.unseen) };
    assert_eq!((one.drive, one.shown_by, found.errors[0]), (0, Some("left"), None));
    assert!(found.errors[1..].iter().all(Option::is_some) && 0.9 < found.efficiency());
}

/// A table with loads to the left tells of drive 1, which weights do not: judged by the other drives alone it would be worth far too little.
#[test]
fn a_table_that_shows_more_than_the_plan_is_not_judged_by_less() {
    let robot = kuka();
    let down = Options { ways: vec![way("down", [0.0, 0.0, -1.0])], ..usual() };
    let both = Options { ways: vec![way("down", [0.0, 0.0, -1.0]), way("left", [0.0, 1.0, 0.0])], ..usual() };
    let found = plan(&robot, &both, Watch::nobody()).unwrap();
    let own: Vec<_> = found.runs.iter().map(|run| (run.q, run.load)).collect();
    let judged = compare(&robot, &down, &own, Watch::nobody());
    assert_eq!(judged, Err(MeasureError::Beyond { drive: 1, by: Some("left") }));
    assert!(judged.unwrap_err().to_string().contains("(left)"));
    // Weights that hang a little askew are weights.
    let askew = |(q, load): (_, Wrench)| (q, Wrench(load.0 + Wrench::force(Vector3::new(0.0, 0.05, 0.0)).0));
    let weights = plan(&robot, &down, Watch::nobody()).unwrap();
    let own: Vec<_> = weights.runs.iter().map(|run| askew((run.q, run.load))).collect();
    assert!(compare(&robot, &down, &own, Watch::nobody()).is_ok());
}

/// Ten markers at one place err together by what the model misses: they are one marker that is read ten times as often.
#[test]
fn markers_of_a_posture_share_what_the_model_misses() {
    let robot = kuka();
    let at = Vector3::new(0.0, 0.1, 0.25);
    let of = |markers: usize, sigma: f64| {
        let options = Options { markers: vec![at; markers], sigma, posture_sigma: 1e-4, ..usual() };
        plan(&robot, &options, Watch::nobody()).unwrap().value
    };
    let [ten, one] = [of(10, 2e-5), of(1, 2e-5 / 10_f64.sqrt())];
    assert!((ten / one - 1.0).abs() < 1e-9, "{ten:e} {one:e}");
}

/// Drive 1 under weights: by hand its column moves the tool by `r` times the lever of the force, both the distance from the joint-1 axis, so that a
/// force across gives `k r^2` and none along the axis or the radius does: `W_11 = mean of r^4 / 3`. With a standard deviation s of ln k
/// factors are off from 1 by `e^(2 s^2) - 2 e^(s^2 / 2) + 1` in the mean square. With a load that shows the drive
/// the promise is a small part of that.
#[test]
fn a_drive_that_no_load_shows_enters_the_precision_with_its_prior() {
    let robot = kuka();
    let at = Vector3::new(0.0, 0.0, 0.2);
    let work =
        over(&robot, &Pose::translation(0.0, 0.0, 0.2), Zone::Circle { diameter: 0.3 }, Watch::nobody()).unwrap();
    let down = Options { ways: vec![way("down", [0.0, 0.0, -1.0])], work: work.clone(), tool: at, ..usual() };
    let found = plan(&robot, &down, Watch::nobody()).unwrap();
    let fourth = |q: &[f64; 6]| {
        let tip = compliance(&robot, q, &Pose::translation(0.0, 0.0, 0.2)).unwrap().tool.translation.vector;
        tip.xy().norm().powi(4) / 3.0
    };
    let weight = work.iter().map(fourth).sum::<f64>() / work.len() as f64;
    let s = robot.scatter().unwrap().total()[0];
    let doubt = (2.0 * s * s).exp() - 2.0 * (s * s / 2.0).exp() + 1.0;
    let k = robot.drive_compliance()[0].unwrap();
    let by_hand = weight * k * k * doubt;
    assert!((found.unseen_value / by_hand - 1.0).abs() < 1e-9, "{:e} {by_hand:e}", found.unseen_value);
    assert!(found.is_decided_by_unseen() && (found.unseen[0].share - 1.0).abs() < 1e-12, "{found:?}");
    let shown = Options { ways: usual().ways, ..down };
    let better = plan(&robot, &shown, Watch::nobody()).unwrap();
    assert!(better.unseen.is_empty() && better.unseen_value == 0.0 && !better.is_decided_by_unseen());
    assert!(better.value < 0.01 * found.value, "{:e} and {:e}", better.value, found.value);
}

/// Whatever is gained by repeating, no posture is run more often than it may be, and a run in a posture that is known is worth less.
#[test]
fn no_posture_is_run_more_often_than_it_may_be() {
    let robot = kuka();
    let most = |found: &stiffarm::measure::Plan| {
        let same = |run: &stiffarm::measure::Run| found.runs.iter().filter(|other| other.q == run.q).count();
        found.runs.iter().map(same).max().unwrap()
    };
    let many = || Options { runs: 40, repeats: 40, ..usual() };
    let free = plan(&robot, &many(), Watch::nobody()).unwrap();
    assert!(2 < most(&free), "it would have been so by itself");
    let options = Options { repeats: 2, posture_sigma: 1e-4, ..many() };
    let found = plan(&robot, &options, Watch::nobody()).unwrap();
    assert!(most(&found) <= 2 && 0.5 < found.efficiency(), "{} {}", most(&found), found.efficiency());
    // Every run alone has (2e-5^2 + 1e-4^2) / 2e-5^2 = 26 times the variance of a reading.
    assert!(26.0 * free.lower_bound * 0.999 <= found.value, "{:e} {:e}", free.lower_bound, found.value);
    let own: Vec<_> = found.runs.iter().map(|run| (run.q, run.load)).collect();
    let (value, _) = compare(&robot, &options, &own, Watch::nobody()).unwrap();
    assert!((value / found.value - 1.0).abs() < 1e-9, "{value:e} {:e}", found.value);
    // The same again: what is read is known better, what the model misses is not. By hand 2 (s^2 + t^2) / (s^2 + 2 t^2) of the information.
    let single = Options { repeats: 1, ..options.clone() };
    let once = plan(&robot, &single, Watch::nobody()).unwrap();
    let own: Vec<_> = once.runs.iter().map(|run| (run.q, run.load)).collect();
    let value = |runs: &[_]| compare(&robot, &single, runs, Watch::nobody()).unwrap().0;
    let gain = value(&own) / value(&[own.clone(), own.clone()].concat());
    assert!((gain / (2.0 * 26.0 / 51.0) - 1.0).abs() < 1e-9, "{gain}");
    let few = Options { candidates: 12, repeats: 1, ..usual() };
    assert!(matches!(
        plan(&robot, &few, Watch::nobody()),
        Err(MeasureError::TooFewPostures { runs: 12, repeats: 1, postures: 4 })
    ));
}

/// Measured as planned, each drive is as far off as was expected: of 40 tables the rms of six errors, over what is expected, has a
/// standard deviation of 1/sqrt(2 40) = 11 %; four of these.
#[test]
fn errors_are_as_large_as_expected_when_measured_as_planned() {
    let robot = kuka();
    let found = plan(&robot, &usual(), Watch::nobody()).unwrap();
    let truth = robot.drive_compliance().map(|k| k.unwrap());
    let mut rng = fastrand::Rng::with_seed(8);
    let mut normal = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (std::f64::consts::TAU * rng.f64()).cos();
    let mut squares = [0.0; 6];
    for _ in 0..40 {
        let readings = found.runs.iter().enumerate().map(|(i, run)| {
            let noise = 2e-5 * Vector3::from_fn(|_, _| normal());
            let at = usual().load_at;
            Reading {
                row: i + 1,
                posture: i,
                q: run.q,
                load: run.load,
                load_at: at,
                marker_at: at,
                moved: run.expected[0] + noise,
                sigma: None,
            }
        });
        let measured = Measurements { readings: readings.collect(), remarks: Vec::new() };
        let identified = identify(&robot, &measured, &IdentifyOptions::default(), Watch::nobody()).unwrap();
        for (i, one) in identified.estimates.iter().enumerate() {
            squares[i] += ((one.compliance.unwrap() - truth[i]) / found.errors[i].unwrap()).powi(2) / 40.0;
        }
    }
    for square in squares {
        assert!((square.sqrt() - 1.0).abs() < 0.45, "{squares:?}");
    }
}

#[test]
fn a_zone_as_work_changes_the_plan_and_a_window_is_kept() {
    let robot = kuka();
    let work =
        over(&robot, &Pose::translation(0.0, 0.0, 0.2), Zone::Rectangle { width: 0.5, height: 0.3 }, Watch::nobody())
            .unwrap();
    assert!(9 <= work.len(), "{}", work.len());
    // All of the zone on one level, the tool down.
    let heights: Vec<f64> = work
        .iter()
        .map(|q| {
            let tool = compliance(&robot, q, &Pose::translation(0.0, 0.0, 0.2)).unwrap().tool;
            assert!((tool.rotation * Vector3::z() + Vector3::z()).norm() < 1e-9);
            tool.translation.z
        })
        .collect();
    assert!(heights.iter().all(|z| (z - heights[0]).abs() < 1e-9));
    let wide = |min: f64, max: f64| Interval::spanning(min, max);
    let window = [wide(0.8, 2.0), wide(-0.7, 0.7), wide(0.4, 1.6)];
    let options = Options { work, window: Some(window), tool: Vector3::new(0.0, 0.0, 0.2), ..usual() };
    let found = plan(&robot, &options, Watch::nobody()).unwrap();
    for run in &found.runs {
        let at = compliance(&robot, &run.q, &Pose::translation(0.0, 0.1, 0.25)).unwrap().tool.translation.vector;
        assert!((0..3).all(|axis| window[axis].contains(at[axis], 1e-12)), "{at}");
    }
    let anywhere = plan(&robot, &Options { work: Vec::new(), ..options.clone() }, Watch::nobody()).unwrap();
    assert_ne!(found.runs, anywhere.runs);
}

/// By forward kinematics alone: the flange looks at the instrument, which lies on no line through the upper arm.
#[test]
fn the_instrument_sees_every_run_and_what_it_cannot_see_is_no_candidate() {
    let robot = kuka();
    let acceptance = 25_f64.to_radians();
    let instrument = Instrument {
        at: Vector3::new(3.5, -2.0, 1.5),
        cone: Some(Cone { faces: Vector3::new(0.6, 0.0, 0.8), acceptance }),
    };
    let options = Options { instrument: Some(instrument), ..usual() };
    let found = plan(&robot, &options, Watch::nobody()).unwrap();
    let off = |q: &[f64; 6]| {
        let marker = compliance(&robot, q, &Pose::translation(0.0, 0.1, 0.25)).unwrap().tool;
        (marker.rotation * Vector3::new(0.6, 0.0, 0.8)).angle(&(instrument.at - marker.translation.vector))
    };
    assert!(found.runs.iter().all(|run| off(&run.q) <= acceptance));
    let anywhere = plan(&robot, &usual(), Watch::nobody()).unwrap();
    assert!(anywhere.runs.iter().any(|run| acceptance < off(&run.q)), "it would have been so by itself");
    // Inside the column it sees nothing.
    let blind = Options { instrument: Some(Instrument { at: Vector3::new(0.0, 0.0, 0.3), cone: None }), ..usual() };
    let seen = plan(&robot, &blind, Watch::nobody());
    assert!(matches!(seen, Err(MeasureError::NoCandidate { looked_at }) if 1000 < looked_at), "{seen:?}");
}

#[test]
fn the_way_is_shorter_than_as_chosen_and_no_piece_of_it_can_be_turned_round() {
    let robot = kuka();
    let Arm::SixAxis { limits, .. } = &robot.arm else { unreachable!("six axes") };
    let speeds = limits.speeds.unwrap_or([1.0; 6]);
    let found = plan(&robot, &usual(), Watch::nobody()).unwrap();
    let time = |a: &[f64; 6], b: &[f64; 6]| (0..6).map(|i| (a[i] - b[i]).abs() / speeds[i]).fold(0.0, f64::max);
    let length = |runs: &[[f64; 6]]| runs.windows(2).map(|two| time(&two[0], &two[1])).sum::<f64>();
    let runs: Vec<[f64; 6]> = found.runs.iter().map(|run| run.q).collect();
    for start in 1..runs.len() {
        for end in start + 1..=runs.len() {
            let mut turned = runs.clone();
            turned[start..end].reverse();
            assert!(length(&runs) <= length(&turned) + 1e-9);
        }
    }
}

#[test]
fn what_cannot_be_planned_is_refused_with_the_reason() {
    let robot = kuka();
    let far = Interval::spanning(50.0, 60.0);
    let nowhere = Options { window: Some([far; 3]), ..usual() };
    let found = plan(&robot, &nowhere, Watch::nobody()).unwrap_err().to_string();
    assert!(found.starts_with("none of ") && found.contains(" postures that were looked at has"), "{found}");
    // A robot on a pedestal: the window says how deep the floor is.
    let [x, y, z] = [(0.5, 3.0), (-2.0, 2.0), (-1.0, -0.1)].map(|(from, to)| Interval::spanning(from, to));
    let below = plan(&robot, &Options { window: Some([x, y, z]), ..usual() }, Watch::nobody()).unwrap();
    let open = [x, y, Interval::new(f64::NEG_INFINITY, -0.1).expect("in order")];
    assert!(plan(&robot, &Options { window: Some(open), ..usual() }, Watch::nobody()).is_ok());
    let tips = below.runs.iter().map(|run| compliance(&robot, &run.q, &Pose::translation(0.0, 0.1, 0.25)).unwrap());
    assert!(tips.map(|at| at.tool.translation.vector.z).all(|height| (-1.0..=-0.1).contains(&height)));
    assert!(matches!(
        plan(&robot, &Options { runs: 1, ..usual() }, Watch::nobody()),
        Err(MeasureError::TooFew { least: 2, .. })
    ));
    let blind = [([0.0, -1.2, 1.2, 0.0, 0.5, 0.0], Wrench::force(Vector3::new(0.0, 0.0, -1000.0))); 5];
    assert!(matches!(compare(&robot, &usual(), &blind, Watch::nobody()), Err(MeasureError::Blind(1))));
    assert!(matches!(
        over(&robot, &Pose::identity(), Zone::Circle { diameter: 9.0 }, Watch::nobody()),
        Err(MeasureError::NoPlace(_))
    ));
    assert!(plan(&robot, &Options { tool: Vector3::new(50.0, 0.0, 0.0), ..usual() }, Watch::nobody()).is_err());
}

#[test]
fn each_criterion_is_certified_and_its_plan_the_best_by_it() {
    let robot = kuka();
    let k = robot.drive_compliance().map(|k| k.unwrap());
    let criteria = [Criterion::Prediction, Criterion::A, Criterion::D];
    let plans = criteria.map(|criterion| plan(&robot, &Options { criterion, ..usual() }, Watch::nobody()).unwrap());
    // What a plan is worth by a criterion.
    let worth = |found: &stiffarm::measure::Plan, criterion: Criterion| {
        let own: Vec<_> = found.runs.iter().map(|run| (run.q, run.load)).collect();
        compare(&robot, &Options { criterion, ..usual() }, &own, Watch::nobody()).unwrap()
    };
    for (found, criterion) in plans.iter().zip(criteria) {
        assert!(0.85 < found.efficiency() && found.efficiency() <= 1.0 + 1e-9, "{criterion:?}: {}", found.efficiency());
        assert!(0.99 < found.shares_efficiency, "{criterion:?}: {}", found.shares_efficiency);
        let (value, _) = worth(found, criterion);
        assert!((value / found.value - 1.0).abs() < 1e-9, "{criterion:?}");
        for other in &plans {
            assert!(found.lower_bound <= worth(other, criterion).0 * (1.0 + 1e-9), "{criterion:?}");
        }
        // A by the errors of the drives, which come of another inverse; the geometric mean of variances is no more than the arithmetic one.
        let mean = found.errors.iter().zip(k).map(|(error, k)| (error.unwrap() / k).powi(2)).sum::<f64>() / 6.0;
        let (a, d) = (worth(found, Criterion::A).0, worth(found, Criterion::D).0);
        assert!((a / mean - 1.0).abs() < 1e-6 && d <= a, "{criterion:?}: {a}, {mean}, {d}");
    }
}
