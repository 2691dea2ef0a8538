//! Plans of measurements as they are drawn, held against the arm's own lengths.

use nalgebra::Vector3;
use stiffarm::catalogue::find;
use stiffarm::compliance::compliance;
use stiffarm::measure::{Criterion, LoadWay, Options, plan};
use stiffarm::prior::with_prior;
use stiffarm::spatial::Pose;
use stiffarm::watch::Watch;
use stiffarm_ask::answer::MeasureAnswer;

/// From the side of the arm both links have their whole length, and the joint-2 axis stands where the maker puts it.
#[test]
fn a_posture_is_drawn_with_its_links_at_full_length() {
    let robot = with_prior(&find("KR 210 R2700 extra").unwrap().robot()).unwrap();
    let at = Vector3::new(0.0, 0.1, 0.25);
    let down = LoadWay { name: "down".into(), along: Vector3::new(0.0, 0.0, -1.0) };
    let options = Options {
        criterion: Criterion::Prediction,
        ways: vec![down],
        newtons: 1000.0,
        load_at: at,
        markers: vec![at],
        sigma: 2e-5,
        posture_sigma: 0.0,
        repeats: 12,
        runs: 12,
        candidates: 300,
        window: None,
        instrument: None,
        work: Vec::new(),
        tool: at,
    };
    let found = plan(&robot, &options, Watch::nobody()).unwrap();
    let heights: Vec<f64> = (found.runs.iter())
        .map(|run| compliance(&robot, &run.q, &Pose::translation(0.0, 0.1, 0.25)).unwrap().tool.translation.z)
        .collect();
    let answer = MeasureAnswer { robot, options, work: String::new(), plan: found, compared: None };
    let drawn = answer.postures();
    assert_eq!((drawn[0].runs[0], drawn[drawn.len() - 1].runs[1]), (1, answer.plan.runs.len()));
    assert!(drawn.windows(2).all(|pair| pair[0].runs[1] + 1 == pair[1].runs[0]));
    for one in drawn {
        let apart = |i: usize| (one.points[i][0] - one.points[i - 1][0]).hypot(one.points[i][1] - one.points[i - 1][1]);
        // The maker's lengths, m.
        assert!((one.points[0][0] - 0.35).abs() < 1e-12 && (one.points[0][1] - 0.675).abs() < 1e-12);
        assert!((apart(1) - 1.15).abs() < 1e-12 && (apart(2) - 1.2_f64.hypot(0.041)).abs() < 1e-12);
        assert!(apart(3) < 0.215 + 1e-12 && (one.markers[0][1] - heights[one.runs[0] - 1]).abs() < 1e-12);
    }
}
