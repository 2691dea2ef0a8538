//! What is advised where a tolerance is not kept: placed again as advised it just holds, and a little more does not.

use stiffarm::advice::{ADVISED, Advice, AtPlace, COMPENSATED, LargestZone, SMALLEST, advise, advise_best};
use stiffarm::catalogue::{find, with_compliance};
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::{Model, ModelKind};
use stiffarm::place::{Hold, PlaceOptions, Placed, Placement, Within, place};
use stiffarm::plane::PlanarArm;
use stiffarm::rank::rank;
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Work};
use stiffarm::watch::Watch;

fn robot(name: &str) -> Robot {
    find(name).expect("in the catalogue").robot()
}

fn task(text: &str) -> Task {
    text.parse().unwrap()
}

/// A question, its answer, and the advice on a tolerance, m.
struct Case {
    model: Model,
    task: Task,
    options: PlaceOptions,
    placed: Placed,
    tolerance: f64,
    advice: Advice,
}

impl Case {
    fn of(model: Model, task: Task, options: &PlaceOptions, tolerance: f64) -> Self {
        let placed = place(&model, &task.work, options, Watch::nobody()).unwrap();
        let advice = advise(&model, &task.work, options, &placed, tolerance, Watch::nobody()).unwrap();
        Self { model, task, options: *options, placed, tolerance, advice }
    }

    fn planar(name: &str, task: &str, tolerance: f64) -> Self {
        let options = PlaceOptions::careful(Load::PAPER);
        Self::of(Model::planar(&robot(name)).unwrap(), self::task(task), &options, tolerance)
    }

    /// A tool of 0.2 m that points down on a table.
    fn spatial(name: &str, task: &str, load: Load, tolerance: f64) -> Self {
        let model = Model::spatial(&robot(name), &Pose::translation(0.0, 0.0, 0.2)).unwrap();
        Self::of(model, self::task(task), &PlaceOptions::careful(load), tolerance)
    }

    fn best(&self) -> &Placement {
        self.placed.feasible().expect("it has a place")
    }

    fn at(&self) -> &AtPlace {
        self.advice.at_place.as_ref().expect("it has a place")
    }

    fn zone(&self) -> &LargestZone {
        self.advice.zone.as_ref().expect("it does not pass")
    }

    /// Placed anew.
    fn again(&self, work: &Work, options: &PlaceOptions) -> Placement {
        place(&self.model, work, options, Watch::nobody()).unwrap().feasible().expect("it has a place").clone()
    }

    /// Values of searches that see the same places agree to the gap of the planar proof, and in space to their refinement.
    fn agreement(&self) -> f64 {
        if self.model.kind() == ModelKind::Planar { 1e-4 } else { 5e-3 }
    }

    fn check_force(&self, with_force: impl Fn(f64) -> Load) {
        let factor = self.at().force_factor.unwrap();
        assert!((factor * self.best().deflection / self.tolerance - 1.0).abs() < 1e-12);
        let under =
            |factor: f64| self.again(&self.task.work, &PlaceOptions { load: with_force(factor), ..self.options });
        let held = under(factor);
        assert!((held.deflection / self.tolerance - 1.0).abs() < self.agreement(), "{held:?}");
        let bound = self.at().force_factor_bound.unwrap();
        assert!(factor <= bound && self.tolerance < under(1.01 * bound).lower_bound * (1.0 + self.agreement()));
        assert!(self.tolerance < under(1.01 * factor).deflection);
    }

    fn check_zone(&self) {
        let LargestZone { holds, fails_at, .. } = *self.zone();
        let (scale, deflection) = holds.expect("some zone passes");
        let resolution = match (&self.model, &self.task.work) {
            (Model::Planar(_), _) => 1e-3,
            (Model::Spatial(_), Work::Zone(_)) => 1e-2,
            (Model::Spatial(_), Work::Part(_)) => 3e-2,
        };
        assert!(scale < fails_at && fails_at - scale <= resolution * fails_at, "{:?}", self.zone());
        let held = self.again(&self.task.work.scaled(scale), &self.options);
        assert!(held.deflection <= self.tolerance && (held.deflection / deflection - 1.0).abs() < 1e-12);
        let beyond = self.again(&self.task.work.scaled(fails_at), &self.options);
        assert!(self.tolerance < beyond.deflection, "{} m at {fails_at}", beyond.deflection);
        assert_eq!(self.zone().is_proved, self.tolerance < beyond.lower_bound);
    }
}

#[test]
fn in_the_plane_the_force_and_the_zone_that_are_advised_just_hold() {
    for (name, task, tolerance) in
        [("KR 210 R2700 extra", "B:0.5", 1.7e-3), ("BT200L", "A:0.8", 2.0e-3), ("ZX200U", "rect:0.9x0.3", 1.68e-3)]
    {
        let case = Case::planar(name, task, tolerance);
        assert!(tolerance < case.best().deflection, "{name} fails: {}", case.best().deflection);
        case.check_force(|factor| Load::worst(1000.0 * factor).unwrap());
        case.check_zone();
        assert!(case.zone().is_proved && case.zone().tried <= 30, "{:?}", case.zone());
        // One per cent more of the size is proved to fail.
        let more = case.again(&case.task.work.scaled(1.01 * case.zone().holds.unwrap().0), &case.options);
        assert!(tolerance < more.lower_bound);
    }
}

#[test]
fn in_space_the_force_and_the_zone_that_are_advised_just_hold() {
    let worst = Case::spatial("KR 210 R2700 extra", "rect:0.6x0.4", Load::PAPER, 1.8e-3);
    worst.check_force(|factor| Load::worst(1000.0 * factor).unwrap());
    worst.check_zone();
    assert!(worst.zone().tried <= 8, "{:?}", worst.zone());
    let milling = |factor: f64| Load::along_tool([300.0 * factor, 100.0 * factor, 50.0 * factor], None).unwrap();
    let directed = Case::spatial("BT200L", "circle:0.4", milling(1.0), 0.5e-3);
    assert!(directed.tolerance < directed.best().deflection, "{}", directed.best().deflection);
    directed.check_force(milling);
    directed.check_zone();
}

#[test]
fn a_part_shrinks_as_a_whole() {
    let spindle = Pose::new([0.0, 0.0, 0.25].into(), [0.0, std::f64::consts::FRAC_PI_2, 0.0].into());
    let model = Model::spatial(&robot("KR 210 R2700 extra"), &spindle).unwrap();
    let part = task("box:0.4x0.3x0.1").work.part().unwrap().with_faces(&["top".into()]).unwrap();
    // Where it stands is asked for, so that there is little to search.
    let within = Within { x: Interval::spanning(1.2, 1.7), z: Interval::spanning(0.6, 0.9) };
    let options = PlaceOptions { within: Some(within), ..PlaceOptions::careful(Load::worst(400.0).unwrap()) };
    let task = Task::from(part);
    let value = |scale: f64| {
        place(&model, &task.work.scaled(scale), &options, Watch::nobody())
            .unwrap()
            .feasible()
            .expect("it has a place")
            .deflection
    };
    let tolerance = f64::midpoint(value(1.0), value(0.3));
    let case = Case::of(model.clone(), task.clone(), &options, tolerance);
    assert!(case.tolerance < case.best().deflection, "{}", case.best().deflection);
    case.check_zone();
    let sum: f64 = case.at().shares.iter().flatten().sum();
    assert!((sum - 1.0).abs() < 1e-12);
}

/// Springs of the advised stiffness leave the tolerance exactly: deflection is linear in the compliance of all drives.
#[test]
fn the_advised_stiffness_just_holds() {
    for name in ["KR 210 R2700 extra", "ZX200U"] {
        let case = Case::planar(name, "B:0.5", 1.2e-3);
        let factor = case.at().stiffness_factor;
        assert!(1.0 < factor);
        // The usual 1 urad/(N m), in urad/(N m) and N m/rad.
        for (needed, expected) in case.at().needed.iter().zip([factor * 1e6; 6]) {
            assert!((needed.unwrap() / expected - 1.0).abs() < 1e-12);
        }
        let stiffer = with_compliance(&robot(name), [1.0 / factor; 6]).unwrap();
        let again = Case::of(Model::planar(&stiffer).unwrap(), case.task.clone(), &case.options, case.tolerance);
        assert!((again.best().deflection / case.tolerance - 1.0).abs() < 1e-4, "{}", again.best().deflection);
        assert!((again.at().stiffness_factor - 1.0).abs() < 1e-4);
    }
}

/// The largest eigenvalue grows with the compliance of a drive as that drive's share says, to first order.
#[test]
fn the_shares_of_drives_are_what_softer_drives_change() {
    for name in ["KR 210 R2700 extra", "ZX200U", "BT200L"] {
        let case = Case::planar(name, "B:0.5", 1e-3);
        let Model::Planar(model) = &case.model else { panic!("planar") };
        let Hold::Plane { posture: [shoulder, elbow], .. } = case.best().hold else { panic!("planar") };
        let arm = model.arm();
        let worst = |arm: &PlanarArm| arm.worst_direction(shoulder, elbow).0;
        let step = 1e-4;
        let slope =
            |softer: PlanarArm, stiffer: PlanarArm| (worst(&softer) - worst(&stiffer)) / (2.0 * step * worst(arm));
        let with = |k2: f64, k3: f64| PlanarArm { k2: arm.k2 * k2, k3: arm.k3 * k3, ..arm.clone() };
        let expected =
            [slope(with(1.0 + step, 1.0), with(1.0 - step, 1.0)), slope(with(1.0, 1.0 + step), with(1.0, 1.0 - step))];
        let [None, Some(second), Some(third), None, None, None] = case.at().shares else { panic!("drives 2 and 3") };
        assert!((second + third - 1.0).abs() < 1e-12);
        // Central differences: truncation of step^2.
        assert!(
            (second - expected[0]).abs() < 1e-6 && (third - expected[1]).abs() < 1e-6,
            "{name}: {second} {expected:?}"
        );
        let (drive, share) = case.at().softest().unwrap();
        assert_eq!((drive, share), if third < second { (2, second) } else { (3, third) });
    }
}

#[test]
fn where_it_holds_the_reserve_is_reported_and_no_zone_is_sought() {
    let case = Case::planar("KR 210 R2700 extra", "B:0.5", 3e-3);
    assert!(case.advice.zone.is_none());
    let factor = case.at().force_factor.unwrap();
    assert!(1.0 < factor && case.at().stiffness_factor < 1.0);
    case.check_force(|factor| Load::worst(1000.0 * factor).unwrap());
    assert!((case.at().compensated - (1.0 - COMPENSATED) * case.best().deflection).abs() < 1e-18);
}

#[test]
fn without_a_place_the_largest_zone_that_passes_is_reported_or_that_none_does() {
    let large = Case::planar("KR 210 R2700 extra", "A:4", 3e-3);
    assert!(large.placed.feasible().is_none() && large.advice.at_place.is_none());
    large.check_zone();
    // The stiffest posture of the links gives way by 1.44 mm.
    let never = Case::planar("KR 210 R2700 extra", "B:0.5", 1e-3);
    assert_eq!(never.zone(), &LargestZone { holds: None, fails_at: SMALLEST, is_proved: true, tried: 1 });
}

#[test]
fn of_a_ranking_the_best_that_take_a_rank_are_advised() {
    let robots: Vec<Robot> = stiffarm::catalogue::paper_robots();
    let (tasks, options) = ([task("B:0.5"), task("A:0.3")], PlaceOptions::careful(Load::PAPER));
    let ranking = rank(&robots, &tasks, &ModelKind::Planar, &options, Watch::nobody()).unwrap();
    let answers = advise_best(&ranking, &options, 1.9e-3, Watch::nobody()).unwrap();
    let advised: Vec<bool> = answers.iter().map(|row| row.iter().all(Option::is_some)).collect();
    let mut left = ADVISED;
    for (row, is_advised) in ranking.rows.iter().zip(advised) {
        let expected = row.rank.is_some() && 0 < left;
        left -= usize::from(expected);
        assert_eq!(is_advised, expected, "{}", row.robot.name);
    }
    let at = ranking.rows.iter().position(|row| row.rank.is_some()).unwrap();
    let alone = Case::of(Model::planar(&ranking.rows[at].robot).unwrap(), tasks[1].clone(), &options, 1.9e-3);
    assert_eq!(answers[at][1], Some(alone.advice));
}
