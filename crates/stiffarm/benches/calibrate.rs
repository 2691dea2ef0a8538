//! How long does a calibration take (1000 postures of three points: 9000 numbers), and how many poses a second does the inverse of a
//! calibrated arm solve, beside that of the arm as drawn? One thread for the inverse.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use stiffarm::calibrate::{CalibrateOptions, calibrate};
use stiffarm::calibration::Errors;
use stiffarm::catalogue::find;
use stiffarm::catalogue::readings::{Reading, Readings};
use stiffarm::chain::TrueArm;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::watch::Watch;

const POINTS: [[f64; 3]; 3] = [[0.02, 0.1, 0.15], [-0.12, -0.03, 0.16], [0.09, -0.08, 0.12]];
/// m: of a coordinate.
const NOISE: f64 = 0.03e-3;

/// From -1 to 1.
fn even(rng: &mut fastrand::Rng) -> f64 {
    2.0 * rng.f64() - 1.0
}

/// As an arm may leave the factory: half a millimetre, half a milliradian.
fn errors(rng: &mut fastrand::Rng) -> Errors {
    let mut errors = Errors::NONE;
    errors.frames.iter_mut().flatten().for_each(|x| *x = 0.5e-3 * even(rng));
    errors.weight.iter_mut().for_each(|x| *x = 0.3e-3 * even(rng));
    errors
}

fn posture(robot: &Robot, rng: &mut fastrand::Rng) -> [f64; 6] {
    let Arm::SixAxis { limits, .. } = &robot.arm else { unreachable!("six axes") };
    limits.joints.map(|range| range.middle() + 0.4 * range.width().min(6.0) * even(rng))
}

fn measured(robot: &Robot, count: usize) -> Readings {
    let mut rng = fastrand::Rng::with_seed(1);
    let errors = errors(&mut rng);
    let tracker = Isometry3::from_parts(Translation3::new(3.0, -1.5, 0.6), UnitQuaternion::new(Vector3::z()));
    let row = |line| {
        let q = posture(robot, &mut rng);
        let flange = tracker * errors.flange(robot, &q).expect("six axes");
        let seen =
            |at: [f64; 3]| Some((flange * Point3::from(at)).coords + NOISE * Vector3::from_fn(|_, _| even(&mut rng)));
        Reading { line, q, points: POINTS.map(seen).into(), orientation: None, stand: 0 }
    };
    Readings {
        rows: (2..count + 2).map(row).collect(),
        points: POINTS.len(),
        stands: vec![String::new()],
        is_measured: true,
        notation: None,
        remarks: Vec::new(),
    }
}

fn calibrated(criterion: &mut Criterion) {
    let robot = find("KR 210 R2700 extra").expect("in the catalogue").robot();
    for rows in [40, 1000] {
        let readings = measured(&robot, rows);
        criterion.bench_function(&format!("calibrate {rows} postures x 3 points, all levels"), |bencher| {
            bencher.iter(|| calibrate(&robot, black_box(&readings), &CalibrateOptions::default(), Watch::nobody()));
        });
    }
}

/// The poses are those of the arm as drawn, so that the true joints are some milliradians away.
fn inverted(criterion: &mut Criterion) {
    const POSES: usize = 1000;
    let mut rng = fastrand::Rng::with_seed(2);
    let errors = errors(&mut rng);
    let rigid = Errors { weight: Errors::NONE.weight, ..errors.clone() };
    let weighed = Errors { drives: Some([1e-6; 6]), ..rigid.clone() };
    for (name, model, errors) in [
        ("rigid", "KR 210 R2700 extra", rigid),
        ("own weight by terms", "KR 210 R2700 extra", errors),
        ("own weight by masses", "KR 210 R2700-2", weighed),
    ] {
        let robot = find(model).expect("in the catalogue").robot();
        let [arm, drawn] = [&errors, &Errors::NONE].map(|errors| TrueArm::with(&robot, errors).expect("six axes"));
        let postures = std::iter::repeat_with(|| posture(&robot, &mut rng)).take(POSES);
        let asked: Vec<([f64; 6], Pose)> = postures.map(|q| (q, drawn.flange(&q))).collect();
        let mut group = criterion.benchmark_group(format!("inverse of a calibrated arm, {name}"));
        group.throughput(Throughput::Elements(POSES as u64));
        group.bench_function("one posture near the arm as drawn", |bencher| {
            bencher.iter(|| asked.iter().filter(|(q, flange)| arm.joints_near(black_box(flange), q).is_some()).count());
        });
        group.bench_function("all postures", |bencher| {
            bencher.iter(|| asked.iter().map(|(_, flange)| arm.postures(black_box(flange)).found.len()).sum::<usize>());
        });
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = calibrated, inverted
}
criterion_main!(benches);
