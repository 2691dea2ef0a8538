//! Is what a plan promises what calibrations by it leave, and is its bound one?

use nalgebra::DVector;

use super::*;
use crate::calibrate::{CalibrateOptions, Level, calibrate};
use crate::catalogue::find;
use crate::catalogue::readings::{Reading, Readings};
use crate::measure::Criterion;
use crate::prior::normal;

fn options(runs: usize, candidates: usize) -> Options {
    Options {
        criterion: Criterion::Prediction,
        ways: Vec::new(),
        newtons: 0.0,
        load_at: Vector3::zeros(),
        markers: vec![Vector3::new(0.1, 0.05, 0.15)],
        sigma: 0.03e-3,
        posture_sigma: 0.0,
        runs,
        repeats: 1,
        candidates,
        window: None,
        instrument: None,
        work: Vec::new(),
        tool: Vector3::zeros(),
    }
}

fn robot() -> Robot {
    find("KR 210 R2700 extra").unwrap().robot()
}

/// Rows of a few unknowns.
fn choice(rng: &mut fastrand::Rng, count: usize) -> Choice {
    let sensitivities = DMatrix::from_fn(4, 2 * count, |_, _| 3.0 * (rng.f64() - 0.5));
    let half = DMatrix::from_fn(3, 4, |_, _| rng.f64());
    Choice { sensitivities, each: 2, weight: half.transpose() * half }
}

/// Every three of eight candidates.
#[test]
fn no_choice_goes_below_the_bound_and_exchange_finds_the_best_or_nearly() {
    let (mut rng, parts) = (fastrand::Rng::with_seed(3), Watch::nobody().parts(None));
    let mut best_ones = 0;
    for _ in 0..20 {
        let choice = choice(&mut rng, 8);
        let all = (0..8).flat_map(|a| (0..a).flat_map(move |b| (0..b).map(move |c| [a, b, c])));
        let best = all.map(|three| choice.value(&three)).fold(f64::INFINITY, f64::min);
        let (bound, shares) = choice.bound(3, &parts).unwrap();
        let (promising, numbers) = choice.promising(&shares, 3);
        assert!(shares[numbers[7]] <= shares[numbers[0]] && numbers.len() == 8);
        let greedy = promising.greedy(3, &parts).unwrap();
        let found = promising.best(&greedy, &parts).unwrap();
        let found = choice.value(&found.iter().map(|&i| numbers[i]).collect::<Vec<_>>());
        assert!(bound <= best * (1.0 + 1e-9), "{bound} is no bound of {best}");
        assert!(0.6 * best < bound, "{bound} is far below {best}");
        assert!(best <= found * (1.0 + 1e-9) && found < 1.2 * best, "{found} was found, {best} is there");
        best_ones += usize::from(found < best * (1.0 + 1e-9));
    }
    assert!(14 <= best_ones, "{best_ones} of 20");
}

/// What one more candidate tells, against the same choice put together anew: of more candidates than are looked at together.
#[test]
fn gains_are_the_differences_of_the_value() {
    let mut rng = fastrand::Rng::with_seed(4);
    let choice = choice(&mut rng, 400);
    let covariance = choice.covariance(&[0, 1]);
    for (i, gain) in choice.gains(&covariance).into_iter().enumerate().skip(2) {
        let expected = choice.value(&[0, 1]) - choice.value(&[0, 1, i]);
        assert!((gain - expected).abs() < 1e-12, "{i}: {gain} {expected}");
        let more = choice.covariance(&[0, 1, i]);
        assert!((choice.without(&more, i).unwrap() - &covariance).norm() < 1e-12);
    }
}

/// How far each unknown moves a point, against differences of the chain.
#[test]
fn rows_are_the_slopes_of_where_points_stand() {
    let robot = robot();
    let frames = Frames::of(&robot).unwrap();
    let markers = [Vector3::new(0.1, 0.05, 0.15), Vector3::new(0.0, -0.1, 0.02)];
    let sensitivity = Sensitivity { frames: &frames, prior: vec![2.0; ALL], markers: &markers };
    let q = [0.3, -1.2, 1.5, 0.7, -0.9, 2.0];
    let rows = sensitivity.rows(&[q], &markers);
    let step = 1e-6;
    for (j, marker) in markers.iter().enumerate() {
        let at = |errors: &[f64]| (frames.chain(errors, &q).flange * nalgebra::Point3::from(*marker)).coords;
        for k in 0..ALL {
            let moved = |by: f64| at(&(0..ALL).map(|i| if i == k { by } else { 0.0 }).collect::<Vec<_>>());
            let slope = (moved(step) - moved(-step)) / (2.0 * step);
            assert!((rows.fixed_view::<3, 1>(3 * j, k) - slope * 2.0).norm() < 1e-7, "{k}");
        }
        // A turn of the instrument's frame, and a place of the marker, by hand.
        let [here, flange] = [at(&vec![0.0; ALL]), frames.drawn(&q).rotation * Vector3::y()];
        assert!((rows.fixed_view::<3, 1>(3 * j, ALL + 5) - Vector3::new(-here.y, here.x, 0.0)).norm() < 1e-12);
        assert!((rows.fixed_view::<3, 1>(3 * j, ALL + 6 + 3 * j + 1) - flange).norm() < 1e-12);
        assert_eq!(rows.fixed_view::<3, 1>(3 * j, ALL + 6 + 3 * (1 - j) + 1).norm(), 0.0);
    }
}

/// Least squares by QR, a row for the prior of each unknown: no formula of the plan is in it.
#[test]
fn what_least_squares_leave_of_drawn_errors_is_what_is_expected() {
    const DRAWS: usize = 1000;
    let (robot, options) = (robot(), options(40, 300));
    let plan = geometry_plan(&robot, &options, Watch::nobody()).unwrap();
    let known = postures(&robot, &options, 300, &Watch::nobody().parts(None)).unwrap();
    let frames = Frames::of(&robot).unwrap();
    let sensitivity = Sensitivity { frames: &frames, prior: prior_of_errors(plan.scale), markers: &options.markers };
    let measured = sensitivity.rows(&plan.postures, &options.markers) / options.sigma;
    let seen = sensitivity.rows(&known, &options.markers);
    let (rows, unknowns) = measured.shape();
    let mut stacked = DMatrix::zeros(rows + unknowns, unknowns);
    stacked.rows_mut(0, rows).copy_from(&measured);
    stacked.view_mut((rows, 0), (unknowns, unknowns)).fill_with_identity();
    let (q, r) = stacked.qr().unpack();
    let mut rng = fastrand::Rng::with_seed(11);
    let mut left = 0.0;
    for _ in 0..DRAWS {
        let errors = DVector::from_fn(unknowns, |_, _| normal(&mut rng));
        let mut read = DVector::zeros(rows + unknowns);
        read.rows_mut(0, rows).copy_from(&(&measured * &errors).map(|x| x + normal(&mut rng)));
        let found = r.solve_upper_triangular(&q.tr_mul(&read)).unwrap();
        left += (&seen * (found - errors)).norm_squared() / known.len() as f64 / DRAWS as f64;
    }
    // A mean square of some ten unknowns that count, over a thousand draws: to 1.5 %, its root to less.
    assert!((left.sqrt() / plan.expected - 1.0).abs() < 0.03, "{} {}", left.sqrt(), plan.expected);
}

/// What calibrations of drawn arms leave in other postures, measured in a plan and in postures chosen at random, is what both promise.
#[test]
fn arms_that_are_calibrated_by_a_plan_err_as_much_as_it_says_and_by_random_postures_more() {
    const ARMS: usize = 30;
    let (robot, options) = (robot(), options(40, 300));
    let plan = geometry_plan(&robot, &options, Watch::nobody()).unwrap();
    let parts = Watch::nobody().parts(None);
    let known = postures(&robot, &options, 300, &parts).unwrap();
    let frames = Frames::of(&robot).unwrap();
    let prior = prior_of_errors(scale_of_errors(0.5));
    let mut rng = fastrand::Rng::with_seed(7);
    let mut squares = [0.0; 2];
    let mut drawn = 0.0;
    for _ in 0..ARMS {
        let errors: Vec<f64> = prior.iter().map(|tau| tau * normal(&mut rng)).collect();
        let at = |errors: &[f64], q: &[f64; 6], marker: &Vector3<f64>| {
            (frames.chain(errors, q).flange * nalgebra::Point3::from(*marker)).coords
        };
        let random: Vec<[f64; 6]> = rng.choose_multiple(known.iter().copied(), options.runs);
        for (square, measured) in squares.iter_mut().zip([&plan.postures, &random]) {
            let rows = measured.iter().enumerate().map(|(i, q)| Reading {
                line: i + 2,
                q: *q,
                points: vec![Some(at(&errors, q, &options.markers[0]).map(|x| x + options.sigma * normal(&mut rng)))],
                orientation: None,
                stand: 0,
            });
            let readings = Readings {
                rows: rows.collect(),
                points: 1,
                is_measured: true,
                notation: None,
                stands: vec![String::new()],
                remarks: Vec::new(),
            };
            let asked = CalibrateOptions { level: Some(Level::Gears), ..CalibrateOptions::default() };
            let found = calibrate(&robot, &readings, &asked, Watch::nobody()).unwrap();
            drawn += found.levels[0].rms.powi(2) / (2 * ARMS) as f64;
            let found_errors = found.errors.parameters();
            let tracker = found.tracker_in_base[0];
            let off = |q: &[f64; 6]| {
                let seen = tracker.inverse() * nalgebra::Point3::from(at(&found_errors, q, &found.points[0]));
                (seen.coords - at(&errors, q, &options.markers[0])).norm_squared()
            };
            *square += known.iter().map(off).sum::<f64>() / known.len() as f64 / ARMS as f64;
        }
    }
    // 30 arms tell a mean square of some ten unknowns that count to about a tenth.
    let [planned, random] = squares.map(f64::sqrt);
    assert!((planned / plan.expected - 1.0).abs() < 0.15, "{planned} {}", plan.expected);
    // As drawn of forty postures rather than of all.
    assert!((drawn.sqrt() / plan.as_drawn - 1.0).abs() < 0.2, "{} {}", drawn.sqrt(), plan.as_drawn);
    assert!(1.15 * planned < random && (random / plan.random - 1.0).abs() < 0.3, "{random} {}", plan.random);
}

#[test]
fn what_a_plan_tells_is_of_one_piece() {
    let robot = robot();
    let plan = geometry_plan(&robot, &options(40, 400), Watch::nobody()).unwrap();
    assert_eq!((plan.postures.len(), plan.candidates, plan.work), (40, 400, 400));
    assert!(
        plan.lower_bound <= plan.expected && plan.expected < plan.random && plan.random < plan.as_drawn,
        "{plan:?}"
    );
    assert!(0.7 < plan.efficiency(), "{}", plan.efficiency());
    // More postures leave less; exchange is no worse than one after the other.
    assert!(plan.by_count.windows(2).all(|two| two[1].1 < two[0].1), "{plan:?}");
    assert!(plan.expected <= plan.by_count[2].1 * (1.0 + 1e-12) && plan.by_count[2].0 == 40);
    // What no error explains remains, whatever is measured.
    let missed = Options { posture_sigma: 0.1e-3, ..options(40, 400) };
    let with = geometry_plan(&robot, &missed, Watch::nobody()).unwrap();
    assert!(0.1e-3 * 3_f64.sqrt() < with.lower_bound && plan.expected < with.expected);
    // Postures of the work alone count.
    let near = Options { work: plan.postures[..3].to_vec(), ..options(40, 400) };
    let near = geometry_plan(&robot, &near, Watch::nobody()).unwrap();
    assert!(near.work == 3 && near.expected < plan.expected);
}

#[test]
fn too_few_postures_calibrate_nothing() {
    let robot = robot();
    let few = geometry_plan(&robot, &options(5, 400), Watch::nobody());
    assert_eq!(few, Err(MeasureError::TooFewRows { rows: 5, least: 6 }));
    let more = geometry_plan(&robot, &options(60, 50), Watch::nobody());
    assert_eq!(more, Err(MeasureError::TooFewPostures { runs: 60, repeats: 1, postures: 50 }));
}
