//! Whoever waits for a verb learns how far it is; what is stopped, wherever it is, has no answer.

use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use stiffarm::batch::{RowsError, Units, matrices_of_rows, worst_of_rows};
use stiffarm::catalogue::{find, paper_robots};
use stiffarm::load::Load;
use stiffarm::map::{Extent, MapError, MapOptions, Spacing, map_watched};
use stiffarm::model::{Model, ModelKind};
use stiffarm::place::{self, PlaceError, PlaceOptions};
use stiffarm::rank::{curves, rank};
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::study::{StudyError, StudyOptions, study_watched};
use stiffarm::task::Task;
use stiffarm::watch::{Waiting, Watch};
use stiffarm_ask::request::{Pair, Request, Spelling, Verb};

/// Wants so many parts and no more; counts them, and the most that there were said to be.
struct Wants {
    most: usize,
    counted: AtomicUsize,
    total: AtomicUsize,
}

impl Wants {
    fn parts(most: usize) -> Self {
        Self { most, counted: AtomicUsize::new(0), total: AtomicUsize::new(0) }
    }
}

impl Waiting for Wants {
    fn is_wanted(&self) -> bool {
        self.counted.load(Ordering::SeqCst) < self.most
    }

    fn progress(&self, done: usize, total: Option<usize>) {
        assert!(0 < done && total.is_none_or(|total| done <= total), "{done} of {total:?}");
        self.counted.fetch_add(1, Ordering::SeqCst);
        self.total.store(total.unwrap_or(0), Ordering::SeqCst);
    }
}

/// Stops a work at its first part, and after a quarter, a half and all but the last of them: none has an answer. `ask` says what the answer
/// is, or that it was stopped.
fn stopped_anywhere<T: PartialEq + std::fmt::Debug>(what: &str, is_counted: bool, ask: impl Fn(Watch) -> Option<T>) {
    let all = Wants::parts(usize::MAX);
    let answer = ask(Watch::of(&all)).unwrap_or_else(|| panic!("{what}: stopped by nobody"));
    assert_eq!(ask(Watch::nobody()).as_ref(), Some(&answer), "{what}: the answer depends on who waits");
    let (counted, total) = (all.counted.into_inner(), all.total.into_inner());
    assert_eq!(total, if is_counted { counted } else { 0 }, "{what}");
    assert!(1 < counted, "{what}: {counted} parts");
    for most in [0, counted / 4, counted / 2, counted - 1] {
        let waiting = Wants::parts(most);
        assert_eq!(ask(Watch::of(&waiting)), None, "{what}: an answer after {most} of {counted} parts");
        // Those that were at work end theirs.
        assert!(waiting.counted.into_inner() <= most + rayon::current_num_threads(), "{what}");
    }
}

fn kuka() -> Robot {
    find("KR 210 R2700 extra").expect("in the catalogue").robot()
}

/// A question as it is typed, about a zone or a part.
fn place(what: &str, typed: &[(&str, &str)]) {
    let typed = typed.iter().chain(&[("robot", "KR 210 R2700 extra")]);
    let pairs: Vec<Pair> =
        typed.map(|(name, text)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed }).collect();
    let asked = Request::read(Verb::Place, &pairs, Spelling::Typed).unwrap();
    let (model, task) = (asked.model().of(&kuka()).unwrap(), asked.task().unwrap());
    let options = asked.place_options(task.work.zone()).unwrap();
    stopped_anywhere(what, false, |watch| match place::place(&model, &task.work, &options, watch) {
        Err(PlaceError::Stopped(_)) => None,
        placed => Some(placed.unwrap()),
    });
}

#[test]
fn a_place_in_the_plane_is_stopped_anywhere() {
    let free = ("angle", "free");
    place("a zone", &[("task", "rect:0.8x0.5"), free, ("within", "0.9..1.9,0..0.8")]);
    place("a zone that does not fit", &[("task", "rect:0.8x0.6"), free, ("within", "1.0..1.5,0..1")]);
}

#[test]
fn a_place_in_space_is_stopped_anywhere() {
    let space = [("model", "spatial"), ("tool-mm", "100,0,200")];
    let place = |what: &str, typed: &[(&str, &str)]| place(what, &[typed, &space].concat());
    place("a zone", &[("task", "circle:0.4"), ("roll-deg", "0")]);
    place("a zone that does not fit", &[("task", "circle:3"), ("roll-deg", "0")]);
    place(
        "a zone whose margins are too wide",
        &[("task", "circle:1.2"), ("roll-deg", "0"), ("limit-margin-deg", "57")],
    );
    place("a part", &[("task", "box:0.3x0.2x0.1"), ("faces", "top"), ("angle", "0")]);
    place("a zone in a cell", &[("task", "circle:0.3"), ("roll-deg", "0"), ("mount", "pedestal:0.5")]);
}

#[test]
fn a_map_is_stopped_anywhere() {
    let robot = kuka();
    let ask = |model: &Model, options: &MapOptions, watch: Watch| match map_watched(model, options, watch) {
        Err(MapError::Stopped(_)) => None,
        map => {
            let grid = map.unwrap().deflection;
            Some((0..grid.z.count).flat_map(|j| grid.row(j).collect::<Vec<_>>()).collect::<Vec<_>>())
        }
    };
    let plane = Model::planar(&robot).unwrap();
    let options = MapOptions::over(Spacing::Points(500), Load::PAPER);
    stopped_anywhere("a map", true, |watch| ask(&plane, &options, watch));
    let space = Model::spatial(&robot, &Pose::translation(0.1, 0.0, 0.2)).unwrap();
    let axis = |from, to| stiffarm::map::Axis::between(from, to, 12);
    let extent = Extent::Grid { x: axis(0.8, 2.4), z: axis(0.2, 2.2) };
    let options = MapOptions { extent, ..options };
    stopped_anywhere("a section", true, |watch| ask(&space, &options, watch));
}

#[test]
fn rankings_and_their_curves_are_stopped_anywhere() {
    let (robots, options) = (paper_robots(), PlaceOptions::under(Load::PAPER));
    let tasks: Vec<Task> = ["A:0.1", "B:0.5", "A:9"].map(|task| task.parse().unwrap()).into();
    let refused = |error: PlaceError| match error {
        PlaceError::Stopped(_) => None::<()>,
        error => panic!("{error}"),
    };
    stopped_anywhere("a ranking", true, |watch| match rank(&robots, &tasks, &ModelKind::Planar, &options, watch) {
        Err(error) => refused(error.error).map(|()| Vec::new()),
        Ok(ranking) => Some(ranking.rows.iter().map(|row| (row.robot.name.clone(), row.cells.clone())).collect()),
    });
    let scales: Vec<f64> = (1..9).map(|i| 0.3 * f64::from(i)).collect();
    let shape = "circle:1".parse().unwrap();
    stopped_anywhere("curves", true, |watch| {
        match curves(&robots[..3], &shape, &scales, (&ModelKind::Planar, &options), watch) {
            Err(error) => refused(error.error).map(|()| Vec::new()),
            Ok(curves) => Some(curves),
        }
    });
}

#[test]
fn a_study_is_stopped_anywhere() {
    stopped_anywhere("a study", true, |watch| match study_watched(&StudyOptions::paper(), watch) {
        Err(StudyError::Stopped(_)) => None,
        study => Some(format!("{:?}", study.unwrap())),
    });
}

#[test]
fn many_postures_are_stopped_anywhere() {
    let (robot, tool) = (kuka(), Pose::identity());
    let rows: Vec<[f64; 6]> = (0..20_000).map(|n| [0.0, -90.0, 90.0, 0.1 * f64::from(n % 1000), 30.0, 0.0]).collect();
    let units = Units { angle: PI / 180.0, compliance: 1e-6 };
    let answer = |done: Result<(), RowsError>| match done {
        Err(RowsError::Stopped(_)) => None,
        Err(error) => panic!("{error}"),
        Ok(()) => Some(()),
    };
    stopped_anywhere("worst", true, |watch| {
        let mut found = vec![0.0; rows.len()];
        answer(worst_of_rows(&robot, &tool, &rows, units, &mut found, watch)).map(|()| found)
    });
    stopped_anywhere("matrices", true, |watch| {
        let mut found = vec![[0.0; 9]; rows.len()];
        answer(matrices_of_rows(&robot, &tool, &rows, units, &mut found, watch)).map(|()| found)
    });
}
