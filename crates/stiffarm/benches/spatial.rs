//! The six-axis kernels, one thread; the peers are in `peers/` and `rs-opw-kinematics`.

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::{UnitQuaternion, Vector3};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use stiffarm::batch::SpatialArm;
use stiffarm::catalogue::{find, paper_robots};
use stiffarm::geometry::Geometry;
use stiffarm::load::Load;
use stiffarm::mass::RigidBody;
use stiffarm::model::ModelKind;
use stiffarm::modes::{HeldTool, SwingingArm};
use stiffarm::place::{PlaceOptions, ToolOrientation, place};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

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
    // The peer finds the postures alone; a loop over single poses is all that it offers.
    let opw = opw(geometry);
    let opw_poses: Vec<OpwPose> = poses.iter().map(opw_pose).collect();
    group.bench_function("rs_opw_kinematics_inverse", |b| {
        b.iter(|| black_box(&opw_poses).iter().map(|pose| opw.inverse(pose).len()).sum::<usize>());
    });
    group.finish();
}

/// Frequencies of an arm with six springs, posture by posture.
fn modes(c: &mut Criterion) {
    let robot = find("KR 210 R2700-2").expect("in the catalogue").robot();
    let q = joints(&robot);
    let body = RigidBody::point(60.0, Vector3::new(0.0, 0.0, 0.2));
    let tool = HeldTool { flange_from_tool: Pose::translation(0.0, 0.0, 0.2), body: Some(body) };
    let arm = SwingingArm::new(&robot, &tool).expect("an arm with masses");
    let mut group = c.benchmark_group("modes_1k");
    group.throughput(Throughput::Elements(1000));
    let each = |n: usize| arm.frequencies(&std::array::from_fn(|i| q[i][n])).expect("a posture").len();
    group.bench_function("frequencies", |b| b.iter(|| (0..1000).map(each).sum::<usize>()));
    group.finish();
}

/// The best place of a zone: with its proof, and without one as whoever has the kernel alone would look for it, on a grid. Poses on the edge of the
/// zone, each in its stiffest posture, at places 0.1 m and rolls 10 deg apart.
fn places(c: &mut Criterion) {
    let robot = find("BT200L").expect("in the catalogue").robot();
    let tool = Pose::translation(0.0, 0.0, 0.25);
    let [ahead, across] = [0.8, 0.5];
    let zone = Zone::Rectangle { width: ahead, height: across };
    let model = ModelKind::Spatial(tool).of(&robot).expect("a six-axis robot");
    let options =
        PlaceOptions { tool_orientation: Some(ToolOrientation::tool_down()), ..PlaceOptions::under(Load::PAPER) };
    let mut group = c.benchmark_group("place_in_space");
    group.sample_size(10);
    group
        .bench_function("with_proof", |b| b.iter(|| place(&model, &black_box(zone).into(), &options, Watch::nobody())));
    let arm = SpatialArm::new(&robot, &tool).expect("a six-axis robot");
    let edge: Vec<[f64; 2]> = (0..4)
        .flat_map(|n| {
            let t = f64::from(n) / 4.0 - 0.5;
            [
                [t * ahead, -across / 2.0],
                [ahead / 2.0, t * across],
                [-t * ahead, across / 2.0],
                [-ahead / 2.0, -t * across],
            ]
        })
        .collect();
    let worst_at = |x: f64, z: f64, roll: f64| {
        let down = Pose::from_parts(Vector3::new(x, 0.0, z).into(), UnitQuaternion::from_euler_angles(PI, 0.0, roll));
        let poses: Vec<Pose> = edge.iter().map(|&[u, v]| Pose::translation(u, v, 0.0) * down).collect();
        arm.best(&poses).into_iter().map(|best| best.map_or(f64::INFINITY, |best| best.worst)).fold(0.0, f64::max)
    };
    let grid = || {
        let places =
            (5..30).flat_map(|x| (0..25).flat_map(move |z| (-18..18).map(move |roll| [x, z, roll].map(f64::from))));
        places
            .map(|[x, z, roll]| worst_at(x / 10.0, z / 10.0, (10.0 * roll).to_radians()))
            .fold(f64::INFINITY, f64::min)
    };
    group.bench_function("grid_without_proof", |b| b.iter(|| black_box(grid())));
    group.finish();
}

/// The arm in rs-opw-kinematics, which counts joints by the same formula.
fn opw(geometry: &Geometry) -> OPWKinematics {
    let Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign } = geometry.clone();
    let sign_corrections = sign.map(|sign| if sign < 0.0 { -1 } else { 1 });
    OPWKinematics::new(Parameters { a1, a2, b, c1, c2, c3, c4, offsets: offset, sign_corrections, dof: 6 })
}

fn opw_pose(pose: &Pose) -> OpwPose {
    let translation = DVec3::from_array(pose.translation.vector.into());
    OpwPose::from_parts(translation, DQuat::from_array(pose.rotation.coords.into()))
}

fn one_thread() -> Criterion {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is built once");
    Criterion::default()
}

criterion_group! { name = spatial; config = one_thread(); targets = postures, poses, modes, places }
criterion_main!(spatial);
