//! The six-axis kernels, one thread; the peers are in `peers/` and `rs-opw-kinematics`.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use stiffarm::catalogue::paper_robots;
use stiffarm::robot::{Arm, Robot};
use stiffarm::space::SpatialArm;
use stiffarm::spatial::Pose;

const COUNT: usize = 100_000;

fn kuka() -> Robot {
    paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").expect("a robot of the paper")
}

/// Joint angles within the limits, as the robot reports them.
fn joints(robot: &Robot) -> [Vec<f64>; 6] {
    let Arm::SixAxis { limits, .. } = &robot.arm else { unreachable!("six axes") };
    let mut rng = fastrand::Rng::with_seed(1);
    limits.joints.map(|range| (0..COUNT).map(|_| range.min() + range.width() * rng.f64()).collect())
}

fn postures(c: &mut Criterion) {
    let robot = kuka();
    let q = joints(&robot);
    let slices = std::array::from_fn(|i| q[i].as_slice());
    let mut worst = vec![0.0; COUNT];
    let mut group = c.benchmark_group("postures_100k");
    group.throughput(Throughput::Elements(COUNT as u64));
    for (name, tool) in [("flange", Pose::identity()), ("tool_aside", Pose::translation(0.1, 0.0, 0.2))] {
        let arm = SpatialArm::new(&robot, &tool).expect("a six-axis robot");
        group.bench_function(name, |b| b.iter(|| arm.worst(black_box(slices), &mut worst)));
    }
    group.finish();
}

fn poses(c: &mut Criterion) {
    let robot = kuka();
    let q = joints(&robot);
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("six axes") };
    let poses: Vec<Pose> = (0..COUNT)
        .map(|n| geometry.forward(&geometry.model_angles(&std::array::from_fn(|i| q[i][n]), limits.third_axis)))
        .collect();
    let arm = SpatialArm::new(&robot, &Pose::identity()).expect("a six-axis robot");
    let mut group = c.benchmark_group("poses_100k");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function("all_postures_limits_and_compliance", |b| b.iter(|| arm.best(black_box(&poses))));
    group.finish();
}

fn one_thread() -> Criterion {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is built once");
    Criterion::default()
}

criterion_group! { name = spatial; config = one_thread(); targets = postures, poses }
criterion_main!(spatial);
