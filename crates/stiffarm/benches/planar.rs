//! The planar verbs, one thread: map (the peer is `peers/map_numpy.py`), one placement of each kind, ranking, Table I.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use stiffarm::catalogue::paper_robots;
use stiffarm::load::{Component, Load};
use stiffarm::map::{Axis, Extent, MapOptions, map, map_into};
use stiffarm::model::{Model, ModelKind, PlanarModel};
use stiffarm::place::{Orientation, PlaceOptions, Within, place};
use stiffarm::plane::PlanarArm;
use stiffarm::rank::rank;
use stiffarm::robot::Robot;
use stiffarm::study::{StudyOptions, study};
use stiffarm::task::Task;
use stiffarm::watch::Watch;

const SIDE: usize = 1000;

fn robot(robots: &[Robot], name: &str) -> Robot {
    robots.iter().find(|robot| robot.name == name).expect("a robot of the paper").clone()
}

fn tasks(labels: &[&str]) -> Vec<Task> {
    labels.iter().map(|label| label.parse().expect("a task")).collect()
}

fn maps(c: &mut Criterion) {
    let robots = paper_robots();
    let arm = robot(&robots, "KR 210 R2700 extra").arm_plane().expect("a plane").arm;
    let unlimited = PlanarArm::free(arm.l2, arm.l3, arm.k2, arm.k3, arm.architecture);
    let axis = Axis::between(-(arm.l2 + arm.l3), arm.l2 + arm.l3, SIDE);
    let extent = Extent::Grid { x: axis, z: axis };
    let options = MapOptions { extent, load: Load::PAPER, elbow: None, held: None };
    let links = |arm: &PlanarArm| PlanarModel::of_links(arm).expect("an arm");
    let (model, arm, unlimited) = (Model::Planar(links(&arm)), links(&arm), links(&unlimited));
    let mut group = c.benchmark_group("map_1000x1000");
    group.throughput(Throughput::Elements((SIDE * SIDE) as u64));
    let mut cells = vec![0.0; SIDE * SIDE];
    group.bench_function("limits_fresh_memory", |b| b.iter(|| map(black_box(&model), &options)));
    group.bench_function("limits", |b| b.iter(|| map_into(black_box(&arm), &options, &mut cells)));
    group.bench_function("no_limits", |b| b.iter(|| map_into(black_box(&unlimited), &options, &mut cells)));
    let directed = MapOptions { load: Load::in_plane(1000.0, 0.3, Component::Total).expect("a load"), ..options };
    group.bench_function("limits_directed", |b| b.iter(|| map_into(black_box(&arm), &directed, &mut cells)));
    group.finish();
}

fn placements(c: &mut Criterion) {
    let robots = paper_robots();
    let zone = tasks(&["B:0.5"])[0].work.clone();
    let anywhere = PlaceOptions::under(Load::PAPER);
    let range = |min, max| stiffarm::interval::Interval::new(min, max).expect("a range");
    let on_a_table = PlaceOptions { within: Some(Within { x: range(1.2, 4.0), z: range(0.3, 1.5) }), ..anywhere };
    let turned = PlaceOptions { orientation: Orientation::Free, ..on_a_table };
    let mut group = c.benchmark_group("place");
    for (name, options) in [("exact", anywhere), ("within", on_a_table), ("within_any_angle", turned)] {
        let robot = robot(&robots, "BT200L");
        group.bench_function(name, |b| {
            b.iter(|| place(&Model::planar(black_box(&robot)).expect("a plane"), &zone, &options, Watch::nobody()));
        });
    }
    group.finish();
}

fn tables(c: &mut Criterion) {
    let robots = paper_robots();
    let tasks = tasks(&["A:0.1", "A:1.0", "B:0.1", "B:0.5", "C:0.05", "C:0.15"]);
    let options = PlaceOptions::under(Load::PAPER);
    c.bench_function("rank_ten_robots_six_tasks", |b| {
        b.iter(|| rank(black_box(&robots), &tasks, &ModelKind::Planar, &options, Watch::nobody()));
    });
    let paper = StudyOptions::paper();
    let mut group = c.benchmark_group("table_1");
    group.sample_size(20);
    group.bench_function("with_boundaries", |b| b.iter(|| study(black_box(&paper))));
    group.finish();
}

fn one_thread() -> Criterion {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is built once");
    Criterion::default()
}

criterion_group! { name = planar; config = one_thread(); targets = maps, placements, tables }
criterion_main!(planar);
