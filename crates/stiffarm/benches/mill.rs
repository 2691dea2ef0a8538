//! A path of 10 000 samples, 180 rolls and 8 configurations, on one thread: every error, both sweeps, smoothing and the exact path; beside the
//! inverse kinematics alone of the same poses by rs-opw-kinematics.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use stiffarm::catalogue::find;
use stiffarm::mill::{Acting, MillOptions, Milled, PartPlacement, Stand, Station, mill, part_from_tool, stations};
use stiffarm::robot::Arm;
use stiffarm::spatial::Pose;
use stiffarm::toolpath::{Builtin, Steps};
use stiffarm::watch::Watch;

/// Rolls of the grid that is searched.
const ROLLS: usize = 180;

fn path() -> (Vec<Station>, Stand) {
    let moves = "raster:rect:0.4x0.25@0.0252".parse::<Builtin>().expect("a path").moves(Some(0.05));
    let length: f64 = moves.iter().map(stiffarm::toolpath::Move::length).sum();
    let steps = Steps { longest: length / 10_000.0, ..Steps::USUAL };
    let acting = Acting::Known { force: [300.0, -120.0, 80.0], moment: 4.0 };
    let tool = Pose::new(nalgebra::Vector3::new(0.25, 0.0, 0.0), nalgebra::Vector3::y() * TAU / 4.0);
    let placement = PartPlacement::from_base([1.7, 0.0, 0.8], 0.3);
    let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: tool };
    (stations(&moves, &steps, |_| Some(acting)), stand)
}

fn along_a_path(c: &mut Criterion) {
    let robot = find("KR 210 R2700 extra").expect("in the catalogue").robot();
    let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("six axes") };
    let (stations, stand) = path();
    let count = stations.len();
    let mut group = c.benchmark_group("mill");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    group.throughput(Throughput::Elements((count * ROLLS * 8) as u64));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    group.bench_function(format!("free_{count}_samples"), |b| {
        b.iter(|| {
            let found = one.install(|| mill(&robot, &stand, &stations, &MillOptions::usual(), Watch::nobody()));
            let Ok(Milled::Followed(found)) = black_box(found) else { panic!("it is followed") };
            found.worst.0
        });
    });
    let parameters = Parameters {
        a1: geometry.a1,
        a2: geometry.a2,
        b: geometry.b,
        c1: geometry.c1,
        c2: geometry.c2,
        c3: geometry.c3,
        c4: geometry.c4,
        ..Parameters::new()
    };
    let opw = OPWKinematics::new(parameters);
    let flange_of = |station: &Station, roll: usize| {
        let pose = part_from_tool(&station.sample.pose, TAU * roll as f64 / ROLLS as f64).expect("no axis along x");
        let flange = stand.base_from_part * pose * stand.flange_from_tool.inverse();
        let (at, turn) = (flange.translation.vector, flange.rotation.coords);
        OpwPose::from_parts(DVec3::new(at.x, at.y, at.z), DQuat::from_xyzw(turn.x, turn.y, turn.z, turn.w))
    };
    // A tenth of the poses, spread over all, and told as what it is.
    let poses: Vec<OpwPose> = stations
        .iter()
        .step_by(10)
        .flat_map(|station| (0..ROLLS).map(move |roll| (station, roll)))
        .map(|(station, roll)| flange_of(station, roll))
        .collect();
    group.throughput(Throughput::Elements((poses.len() * 8) as u64));
    group.bench_function("rs_opw_kinematics_inverse_of_a_tenth", |b| {
        b.iter(|| black_box(&poses).iter().map(|pose| opw.inverse(pose).len()).sum::<usize>());
    });
    group.finish();
}

criterion_group!(benches, along_a_path);
criterion_main!(benches);
