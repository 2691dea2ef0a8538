//! How long does an identification take (1000 postures with four markers each: 12 000 numbers), and how long a plan of measurements?

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Vector3, Vector6};
use stiffarm::catalogue::find;
use stiffarm::catalogue::measurements::{Measurements, Reading};
use stiffarm::compliance::compliance;
use stiffarm::identify::{Options, identify};
use stiffarm::measure::{Criterion as PlanCriterion, LoadWay, Options as PlanOptions, plan};
use stiffarm::prior::with_prior;
use stiffarm::robot::Robot;
use stiffarm::spatial::{Pose, Wrench};
use stiffarm::watch::Watch;

const MARKERS: [[f64; 3]; 4] = [[0.1, 0.0, 0.1], [0.0, 0.2, 0.1], [-0.2, 0.0, 0.2], [0.0, -0.1, 0.3]];

fn measured(robot: &Robot, postures: usize) -> Measurements {
    let mut rng = fastrand::Rng::with_seed(1);
    let mut readings = Vec::new();
    for posture in 0..postures {
        let q: [f64; 6] = std::array::from_fn(|i| [0.0, -1.5, 1.0, 0.0, 0.5, 0.0][i] + 1.5 * (rng.f64() - 0.5));
        let load = Wrench(Vector6::from_fn(|i, _| if i < 3 { 1e3 * (rng.f64() - 0.5) } else { 0.0 }));
        let posed = compliance(robot, &q, &Pose::identity()).expect("six axes");
        let (translation, rotation) = posed.compliance.deflection(&load);
        for at in MARKERS.map(Vector3::from) {
            let noise = 2e-5 * Vector3::from_fn(|_, _| rng.f64() - 0.5);
            let moved = translation + rotation.cross(&(posed.tool.rotation * at)) + noise;
            let row = readings.len() + 1;
            readings.push(Reading {
                row,
                posture,
                q,
                load,
                load_at: Vector3::zeros(),
                marker_at: at,
                moved,
                sigma: None,
            });
        }
    }
    Measurements { readings, remarks: Vec::new() }
}

fn bench(criterion: &mut Criterion) {
    let robot = find("KR 210 R2700 extra").expect("in the catalogue").robot();
    for postures in [43, 1000] {
        let measured = measured(&robot, postures);
        criterion.bench_function(&format!("identify {postures} postures x 4 markers"), |bencher| {
            bencher.iter(|| identify(black_box(&robot), black_box(&measured), &Options::default(), Watch::nobody()));
        });
    }
}

fn planned(criterion: &mut Criterion) {
    let robot = with_prior(&find("KR 210 R2700 extra").expect("in the catalogue").robot()).expect("its size is known");
    let at = Vector3::new(0.0, 0.1, 0.25);
    let ways = [
        ("down", [0.0, 0.0, -1.0]),
        ("left", [0.0, 1.0, 0.0]),
        ("right", [0.0, -1.0, 0.0]),
        ("ahead", [1.0, 0.0, 0.0]),
        ("up", [0.0, 0.0, 1.0]),
    ];
    let options = |candidates: usize| PlanOptions {
        criterion: PlanCriterion::Prediction,
        ways: ways.map(|(name, along)| LoadWay { name: name.into(), along: along.into() }).into(),
        newtons: 1000.0,
        load_at: at,
        markers: vec![at],
        sigma: 2e-5,
        posture_sigma: 1e-4,
        runs: 20,
        repeats: 2,
        candidates,
        window: None,
        instrument: None,
        work: Vec::new(),
        tool: at,
    };
    let mut group = criterion.benchmark_group("measure");
    group.sample_size(10);
    for candidates in [3000, 100_000] {
        let options = options(candidates);
        group.bench_function(format!("{candidates} candidates, 20 runs"), |bencher| {
            bencher.iter(|| plan(black_box(&robot), black_box(&options), Watch::nobody()));
        });
    }
    group.finish();
}

criterion_group!(benches, bench, planned);
criterion_main!(benches);
