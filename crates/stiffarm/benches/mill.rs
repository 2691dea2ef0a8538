//! A path of 10 000 samples, 180 rolls and 8 configurations, on one thread: every error, both sweeps, smoothing and the exact path; beside the
//! inverse kinematics alone of the same poses by rs-opw-kinematics. And its forces, in a stock, too, and whether its cuts swing.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use stiffarm::catalogue::find;
use stiffarm::cell::{Block, Cell, Mount};
use stiffarm::chatter::{Asked, chatter};
use stiffarm::cutting::{Edge, Engagement, Law, Milling, Process};
use stiffarm::interval::Interval;
use stiffarm::mass::RigidBody;
use stiffarm::mill::{
    Acting, ClearOf, Forcing, MillHeld, MillOptions, Milled, PartPlacement, Stand, Station, chatter_along, forced,
    mill, part_from_tool, stations,
};
use stiffarm::modes::HeldTool;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::stock::Stock;
use stiffarm::toolpath::{Builtin, Move, Steps};
use stiffarm::watch::Watch;

/// Rolls of the grid that is searched.
const ROLLS: usize = 180;

fn moves() -> (Vec<Move>, Steps) {
    let moves = "raster:rect:0.4x0.25@0.0252".parse::<Builtin>().expect("a path").moves(Some(0.05));
    let length: f64 = moves.iter().map(Move::length).sum();
    (moves, Steps { longest: length / 10_000.0, ..Steps::USUAL })
}

fn path() -> (Vec<Station>, Stand) {
    let (moves, steps) = moves();
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
    // A tenth of the poses, spread over all, and named as what it is.
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

/// The same path kept clear of a floor, of posts about the wrist, and of posts that no path passes, beside the path that looks at nothing; the links
/// enclosed, and estimated.
fn kept_clear(c: &mut Criterion) {
    let known = find("KR 210 R2700-2").expect("in the catalogue").robot();
    let estimated = Robot { enclosing: None, body: None, ..known.clone() };
    let (stations, stand) = path();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let followed = |robot: &Robot, clear_of: Option<ClearOf>| {
        let options = MillOptions { clear_of, ..MillOptions::usual() };
        let found = one.install(|| mill(robot, &stand, &stations, &options, Watch::nobody()));
        let Ok(Milled::Followed(found)) = found else { panic!("it is followed") };
        found
    };
    let cell = |posts: &[Block]| {
        let mut cell = Cell::of(Mount::pedestal(0.0));
        cell.keep_out.iter_mut().zip(posts).for_each(|(place, post)| *place = Some(*post));
        Some(ClearOf {
            clearance: 0.0,
            cell: Some(cell),
            floor: None,
            part: None,
            stock: None,
            fixture: None,
            cutter: None,
        })
    };
    let Arm::SixAxis { geometry, limits, .. } = &known.arm else { unreachable!("six axes") };
    let free = followed(&known, None);
    let post = |part: usize, aside: [f64; 3]| {
        let joints = &free.samples[free.samples.len() * part / 8].joints;
        let flange = geometry.forward(&geometry.model_angles(joints, limits.third_axis)).translation.vector;
        let side = |i: usize| Interval::spanning(flange[i] - 0.02 + aside[i], flange[i] + 0.02 + aside[i]);
        Block { x: side(0), y: side(1), z: side(2) }
    };
    let posts = |aside: [f64; 3]| cell(&[1, 4, 7].map(|part| post(part, aside)));
    let mut group = c.benchmark_group("kept_clear");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    for (robot, links) in [(&known, "enclosed"), (&estimated, "estimated")] {
        let worlds = [
            ("of_nothing", None),
            ("of_a_floor", cell(&[])),
            ("of_posts", posts([0.3, 0.3, 0.0])),
            ("of_posts_that_all_paths_touch", posts([0.0, 0.2, 0.0])),
        ];
        for (about, clear_of) in worlds {
            group.bench_function(format!("{links}_{about}"), |b| b.iter(|| followed(robot, clear_of.clone()).worst.0));
        }
    }
    group.finish();
}

/// A flat end mill, 3 mm deep, that cuts from 0.2 to 1.9 rad of its way around.
fn end_mill() -> Process {
    let edge = Edge::Linear { chip: [767e6, 169e6, 222e6], rubbing: [0.0; 3] };
    let engagement = Engagement::at_depth(3e-3, [0.2, 1.9], 1e-4);
    let milling = Milling { diameter: 0.016, teeth: 4, helix: 0.0, engagement, edge };
    Process { spindle: Some(1256.0), is_clockwise: true, law: Law::Milling(milling) }
}

/// The forces of the same path from its cut, and from what of a block the mill meets, in cells of a thirty-second of its diameter.
fn forces(c: &mut Criterion) {
    let (moves, steps) = moves();
    let forcing = Forcing::Process(end_mill());
    let of = |stock: Option<&mut Stock>| forced(&moves, &steps, &forcing, stock, Watch::nobody()).expect("forces");
    let count = of(None).stations.len();
    let block = || Stock::block([-0.3, -0.3, -0.03], [0.3, 0.3, 0.003], 5e-4).expect("a block");
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut group = c.benchmark_group("forces");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    group.throughput(Throughput::Elements(count as u64));
    group.bench_function(format!("of_the_process_{count}_samples"), |b| {
        b.iter(|| black_box(one.install(|| of(None).stations.len())));
    });
    group.bench_function(format!("in_a_stock_{count}_samples"), |b| {
        let cut = |mut stock: Stock| one.install(|| of(Some(&mut stock)).stations.len());
        b.iter_batched(block, |stock| black_box(cut(stock)), BatchSize::LargeInput);
    });
    group.finish();
}

/// Whether the cuts of the same path swing, beside following it; and one cut, whole: 200 draws at 191 speeds.
fn chatter_of_cuts(c: &mut Criterion) {
    let robot = find("KR 210 R2700-2").expect("in the catalogue").robot();
    let ((moves, steps), (_, stand)) = (moves(), path());
    let process = end_mill();
    let forcing = Forcing::Process(process.clone());
    let stations = forced(&moves, &steps, &forcing, None, Watch::nobody()).expect("forces").stations;
    let body = RigidBody::point(60.0, nalgebra::Vector3::new(0.0, 0.0, 0.2));
    let held = MillHeld { body: Some(body), damping: None, measured: None };
    let options = MillOptions::usual();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let found = one.install(|| mill(&robot, &stand, &stations, &options, Watch::nobody()));
    let Ok(Milled::Followed(found)) = found else { panic!("it is followed") };
    let mut group = c.benchmark_group("chatter");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    group.throughput(Throughput::Elements(stations.len() as u64));
    group.bench_function(format!("along_{}_samples", stations.len()), |b| {
        let path = (&stations[..], &found.samples[..]);
        let along = || chatter_along(&robot, &stand, path, (&process, &held, &options), Watch::nobody());
        b.iter(|| black_box(one.install(along)).expect("an answer").samples.len());
    });
    group.throughput(Throughput::Elements(1));
    group.bench_function("one_cut_with_its_chart", |b| {
        let tool = HeldTool { flange_from_tool: stand.flange_from_tool, body: Some(body) };
        let asked = Asked { feed: [0.0, 1.0, 0.0], damping: None, method: None, measured: None };
        let judged = || chatter(&robot, &found.samples[0].joints, &tool, &process, &asked);
        b.iter(|| black_box(one.install(judged)).expect("an answer").lobes.len());
    });
    group.finish();
}

criterion_group!(benches, along_a_path, forces, kept_clear, chatter_of_cuts);
criterion_main!(benches);
