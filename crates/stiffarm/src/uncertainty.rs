//! How sure is a deflection, and how sure is the order of robots, as far as the drives may be stiffer or softer than is taken?
//!
//! Factors on the compliances are drawn (`prior`), and the largest deflection is computed again over the points of the place that may then be the
//! worst, of a part on all of its faces: places are not searched again. Of forces that are known in part the worst is taken in every draw. What is wrong for all robots alike is the same in a draw of each, so it widens the interval of a deflection and
//! leaves the order as it is. Of a robot that was measured, what its identification did not explain is added to every draw.

use nalgebra::Matrix2;

use crate::compliance::{Posture, most_of, moved_in_all};
use crate::load::{Component, Direction, Load, NotInPlane};
use crate::place::{Hold, Placement, SpaceHold};
use crate::prior::{Moved, Unexplained, factors};
use crate::rank::{Ranking, Row};
use crate::robot::{Robot, Status};

/// How many draws: probabilities are exact to a hundredth.
pub const DRAWS: usize = 2000;
/// Two robots tie where either is better in more than this share of the draws.
const TIE: f64 = 0.05;

/// Where a deflection lies with 90 %, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// 5th percentile.
    pub p05: f64,
    /// Half of them are less: mostly more than the value at the nominal stiffness, as a soft drive adds more than a stiff one takes away.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
}

impl Spread {
    /// Of draws, at least one.
    pub fn of(mut draws: Vec<f64>) -> Self {
        draws.sort_by(f64::total_cmp);
        Self { p05: quantile(&draws, 0.05), median: quantile(&draws, 0.5), p95: quantile(&draws, 0.95) }
    }
}

/// The value below which a share of some lies, ascending, at least one.
pub(crate) fn quantile(values: &[f64], share: f64) -> f64 {
    values[below(values.len(), share)]
}

/// The same of some in any order, which it changes: quicker than to sort them where one share is wanted.
pub(crate) fn quantile_of(values: &mut [f64], share: f64) -> f64 {
    *values.select_nth_unstable_by(below(values.len(), share), f64::total_cmp).1
}

/// Which of so many, ascending.
fn below(count: usize, share: f64) -> usize {
    ((count - 1) as f64 * share).round() as usize
}

/// Deflections at a place that was found, m, draw by draw; `None` where the drive stiffness has no stated uncertainty, or the arm plane does not
/// know the force.
fn draws(robot: &Robot, load: Load, placed: &Placement) -> Option<Vec<f64>> {
    let factors = factors(robot, DRAWS)?;
    let each = |value: &dyn Fn(&[f64; 6]) -> f64| {
        let whole = value(&[1.0; 6]);
        (0.0 < whole).then(|| factors.iter().map(|factor| placed.deflection * (value(factor) / whole)).collect())
    };
    match &placed.hold {
        Hold::Plane { by_drive, .. } => {
            let most = |factor: &[f64; 6], most_at: &dyn Fn(&Matrix2<f64>) -> f64| {
                let drawn = by_drive.iter().map(|[second, third]| second * factor[1] + third * factor[2]);
                largest(drawn.map(|drawn| most_at(&drawn)))
            };
            match load.sector() {
                Ok(None) => each(&|factor| most(factor, &|drawn| drawn.symmetric_eigenvalues().max())),
                Ok(Some(sector)) => each(&|factor| most(factor, &|drawn| sector.largest(drawn).value)),
                Err(NotInPlane::Across(_) | NotInPlane::Tool | NotInPlane::Normal) => None,
            }
        }
        // Of a part every face, each in a posture of its own.
        Hold::Space(hold) if placed.faces.is_empty() => each(&|factor| most_held(hold, factor)),
        Hold::Space(_) => each(&|factor| largest(placed.faces.iter().map(|face| most_held(&face.hold, factor)))),
    }
}

/// What the forces of a zone do at most anywhere on it, m/N, where every drive gives so many times its part.
fn most_held(hold: &SpaceHold, factors: &[f64; 6]) -> f64 {
    largest(hold.by_drive.iter().map(|parts| most_of(parts, factors, hold.forces.as_ref())))
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// Deflections at a place that was found, m, draw by draw, with what an identification did not explain; `None` where nothing says how far
/// the drives may be off, or the arm plane does not know the force.
pub fn drawn(robot: &Robot, load: Load, placed: &Placement) -> Option<Vec<f64>> {
    let (posture, moved) = worst_of(load, placed);
    Some(with_residual(robot, posture, draws(robot, load, placed)?, &moved))
}

/// The posture at the worst point of a place, rad, and the displacement there.
fn worst_of(load: Load, placed: &Placement) -> (&[f64], Moved) {
    let worst_face = placed.faces.iter().max_by(|a, b| a.deflection.total_cmp(&b.deflection));
    match &placed.hold {
        Hold::Plane { by_drive, posture, .. } => {
            let [second, third] = by_drive[0];
            let whole = second + third;
            let length = match load.sector() {
                Ok(Some(sector)) => (whole * sector.largest(&whole).force).norm(),
                Ok(None) | Err(NotInPlane::Across(_) | NotInPlane::Tool | NotInPlane::Normal) => {
                    whole.symmetric_eigenvalues().max()
                }
            };
            (posture, moved(load, length, 2))
        }
        Hold::Space(hold) => {
            let hold = worst_face.map_or(hold.as_ref(), |face| &face.hold);
            (&hold.joints, moved(load, moved_in_all(&hold.by_drive[0], hold.forces.as_ref()), 3))
        }
    }
}

/// A displacement of so many coordinates, m/N in all. Of a force that may point anywhere a part along a direction is a length of as many: that of
/// the compliance along it.
fn moved(load: Load, length: f64, coordinates: usize) -> Moved {
    let is_one = load.component() != Component::Total && load.direction() != Direction::Worst;
    Moved { length: load.newtons() * length, coordinates, counted: if is_one { 1 } else { coordinates } }
}

/// Draws of what counts of a displacement, m, with what the identification of a robot did not explain.
fn with_residual(robot: &Robot, posture: &[f64], mut draws: Vec<f64>, moved: &Moved) -> Vec<f64> {
    if let Some(unexplained) = Unexplained::at(robot, draws.len(), posture) {
        for (draw, value) in draws.iter_mut().enumerate() {
            *value = unexplained.added(draw, *value, moved);
        }
    }
    draws
}

/// Which share of draws, at least one, is no more than a bound.
pub fn share_within(draws: &[f64], bound: f64) -> f64 {
    draws.iter().filter(|value| **value <= bound).count() as f64 / draws.len() as f64
}

/// Where the deflection at a place lies with 90 %; `None` where the drive stiffness has no stated uncertainty.
pub fn spread(robot: &Robot, load: Load, placed: &Placement) -> Option<Spread> {
    drawn(robot, load, placed).map(Spread::of)
}

/// Where what counts of the displacement of a posture under a load lies with 90 %, m; `None` where the drive stiffness has no stated uncertainty.
pub fn of_posture(robot: &Robot, posture: &Posture, load: Load) -> Option<Spread> {
    let (parts, forces) = (posture.translations(), posture.forces(load));
    let counted = |factor: &[f64; 6]| load.newtons() * most_of(&parts, factor, Some(&forces));
    let found = factors(robot, DRAWS)?.iter().map(counted).collect();
    let moved = moved(load, moved_in_all(&parts, Some(&forces)), 3);
    Some(Spread::of(with_residual(robot, &[], found, &moved)))
}

/// How a robot stands at a task, over all draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chances {
    /// In so many of them it has the least deflection.
    pub win: f64,
    /// How much more it has than the best of each, on average, m.
    pub regret: f64,
    /// No robot is better in nineteen draws of twenty: it ties with the best.
    pub ties: bool,
}

/// Of every row and task; `None` where a robot has no place, is estimated (it cannot win), or the stiffness of its drives has no stated uncertainty.
pub fn chances(ranking: &Ranking) -> Vec<Vec<Option<Chances>>> {
    chances_of(ranking, &drawn_in(ranking))
}

/// The draws of every row and task, as [`drawn`] has them.
pub fn drawn_in(ranking: &Ranking) -> Vec<Vec<Option<Vec<f64>>>> {
    let of_row = |row: &Row| {
        (0..ranking.tasks.len()).map(|task| drawn(&row.robot, ranking.load, row.placement(task)?)).collect()
    };
    ranking.rows.iter().map(of_row).collect()
}

/// As [`chances`], by draws that are known.
pub fn chances_of(ranking: &Ranking, drawn: &[Vec<Option<Vec<f64>>>]) -> Vec<Vec<Option<Chances>>> {
    let rows = || ranking.rows.iter().zip(drawn);
    let of_task = |task: usize| {
        let may_win = |(row, drawn): (&Row, &Vec<Option<Vec<f64>>>)| {
            drawn[task].clone().filter(|_| row.robot.status != Status::Estimated)
        };
        of_task(&rows().map(may_win).collect::<Vec<_>>())
    };
    let of_tasks: Vec<Vec<Option<Chances>>> = (0..ranking.tasks.len()).map(of_task).collect();
    (0..ranking.rows.len()).map(|row| of_tasks.iter().map(|of_task| of_task[row]).collect()).collect()
}

/// Of every robot at one task, by its draws (as many as [`DRAWS`]); `None` where it has none, and where no two robots have.
pub fn of_task(of_rows: &[Option<Vec<f64>>]) -> Vec<Option<Chances>> {
    let mut found = vec![None; of_rows.len()];
    let known: Vec<usize> = (0..of_rows.len()).filter(|&row| of_rows[row].is_some()).collect();
    if known.len() < 2 {
        return found;
    }
    let value = |row: usize, draw: usize| of_rows[row].as_ref().map_or(f64::INFINITY, |draws| draws[draw]);
    let mut won = vec![0; of_rows.len()];
    let mut regret = vec![0.0; of_rows.len()];
    for draw in 0..DRAWS {
        let Some(&best) = known.iter().min_by(|a, b| value(**a, draw).total_cmp(&value(**b, draw))) else { continue };
        won[best] += 1;
        for &row in &known {
            regret[row] += (value(row, draw) - value(best, draw)) / DRAWS as f64;
        }
    }
    let is_beaten = |row: usize, by: usize| {
        let worse = (0..DRAWS).filter(|&draw| value(by, draw) < value(row, draw)).count();
        1.0 - TIE < worse as f64 / DRAWS as f64
    };
    for &row in &known {
        let ties = !known.iter().any(|&other| other != row && is_beaten(row, other));
        found[row] = Some(Chances { win: f64::from(won[row]) / DRAWS as f64, regret: regret[row], ties });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{find, with_compliance};
    use crate::compliance::compliance;
    use crate::interval::Interval;
    use crate::load::Component;
    use crate::model::{Model, ModelKind};
    use crate::part::Part;
    use crate::place::{FacePlacement, PlaceOptions, Within, deflection_field, place};
    use crate::prior::with_prior;
    use crate::rank::rank;
    use crate::spatial::Pose;
    use crate::task::{Task, Zone};
    use crate::watch::Watch;

    fn robot(name: &str) -> Robot {
        with_prior(&find(name).unwrap_or_else(|| panic!("{name} is in the catalogue")).robot())
            .expect("its size is known")
    }

    #[test]
    fn a_share_of_some_in_any_order_is_that_of_the_same_in_order() {
        let mut rng = fastrand::Rng::with_seed(8);
        for count in [1_u32, 2, 19, 20, 21, 200] {
            let mut mixed: Vec<f64> = (0..count).map(|_| rng.f64()).collect();
            let mut sorted = mixed.clone();
            sorted.sort_by(f64::total_cmp);
            for share in [0.0, 0.05, 0.5, 0.95, 1.0] {
                let found = quantile_of(&mut mixed, share);
                let beyond = sorted.iter().filter(|value| found < **value).count() as f64;
                assert_eq!(found, quantile(&sorted, share));
                assert!((beyond - (1.0 - share) * (f64::from(count) - 1.0)).abs() <= 0.5, "{count} {share}: {beyond}");
            }
        }
    }

    /// The draws of one robot as robots of their own: other code than scaled parts.
    #[test]
    fn a_draw_is_what_a_robot_with_such_drives_has_at_that_place() {
        let robot = robot("KR 210 R2700-2");
        let task: Task = "A:0.3".parse().unwrap();
        let options = PlaceOptions::under(Load::PAPER);
        let placed =
            crate::place::place(&ModelKind::Planar.of(&robot).unwrap(), &task.work, &options, Watch::nobody()).unwrap();
        let placed = placed.feasible().unwrap();
        let (Hold::Plane { posture: [shoulder, elbow], .. }, Some(found)) =
            (&placed.hold, draws(&robot, Load::PAPER, placed))
        else {
            panic!("in the plane")
        };
        let k = robot.drive_compliance().map(|k| k.unwrap());
        for (factor, found) in factors(&robot, 5).unwrap().iter().zip(&found) {
            let drawn = with_compliance(&robot, std::array::from_fn(|i| k[i] * factor[i] * 1e6)).unwrap();
            let (sigma, _) = drawn.arm_plane().unwrap().arm.worst_direction(*shoulder, *elbow);
            assert!((sigma * 1000.0 / found - 1.0).abs() < 1e-6, "{sigma} and {found}");
        }
        let Spread { p05, median, p95 } = spread(&robot, Load::PAPER, placed).unwrap();
        let less = found.iter().filter(|value| **value < median).count();
        assert!((999..=1001).contains(&less) && p05 < median && median < p95, "{less}");
        let inside = found.iter().filter(|value| p05 <= **value && **value <= p95).count();
        assert!((1795..=1805).contains(&inside) && p05 < placed.deflection && placed.deflection < p95, "{inside}");
    }

    /// The same in space under forces that are known, in part and whole: the worst of the band in every draw. A sum of shares would be off by
    /// some ten per cent.
    #[test]
    fn a_draw_under_a_known_force_is_what_a_robot_with_such_drives_has_there() {
        let robot = robot("KR 210 R2700-2");
        let tool = Pose::translation(0.0, 0.0, 0.2);
        let force = Load::along_base([200.0, 150.0, -300.0]).unwrap();
        let loads = [force, force.with_cone(0.4).unwrap(), force.counting(Component::Along)];
        let zone = Zone::Circle { diameter: 0.2 };
        let ahead = Within { x: Interval::spanning(1.3, 1.7), z: Interval::spanning(0.6, 0.8) };
        let mut off = 0.0_f64;
        for load in loads {
            let options = PlaceOptions { within: Some(ahead), ..PlaceOptions::under(load) };
            let placed =
                place(&Model::spatial(&robot, &tool).unwrap(), &zone.into(), &options, Watch::nobody()).unwrap();
            let placed = placed.feasible().unwrap();
            let (hold, found) = (placed.space().unwrap(), draws(&robot, load, &at_worst(placed)).unwrap());
            let k = robot.drive_compliance().map(|k| k.unwrap());
            for (factor, found) in factors(&robot, 200).unwrap().iter().zip(&found) {
                let drawn = with_compliance(&robot, std::array::from_fn(|i| k[i] * factor[i] * 1e6)).unwrap();
                let posture = compliance(&drawn, &hold.joints, &tool).unwrap();
                let expected = posture.under(load).value * load.newtons();
                assert!((found / expected - 1.0).abs() < 1e-6, "{load:?}: {found} and {expected}");
                let shares = hold.shares.iter().zip(factor).map(|(share, factor)| share * factor).sum::<f64>();
                off = off.max((placed.deflection * shares / expected - 1.0).abs());
            }
        }
        assert!(0.05 < off, "{off}");
    }

    /// The same placement as if nothing but its worst point were known.
    fn at_worst(placed: &Placement) -> Placement {
        let mut placed = placed.clone();
        match &mut placed.hold {
            Hold::Plane { by_drive, .. } => by_drive.truncate(1),
            Hold::Space(hold) => hold.by_drive.truncate(1),
        }
        placed
    }

    /// By a field over the whole zone of a robot with such drives: other code than scaled parts at a few points.
    #[test]
    fn a_draw_is_the_largest_on_the_whole_zone() {
        const ALONG: u32 = 12;
        let robot = robot("KR 210 R2700-2");
        let zone = Zone::Rectangle { width: 0.8, height: 0.5 };
        let points: Vec<[f64; 2]> = (0..=ALONG)
            .flat_map(|i| (0..=ALONG).map(move |j| [i, j].map(|i| 2.0 * f64::from(i) / f64::from(ALONG) - 1.0)))
            .map(|at| zone.at(at))
            .collect();
        let tool = Pose::translation(0.0, 0.0, 0.25);
        let model = |robot: &Robot, is_plane: bool| {
            if is_plane { Model::planar(robot) } else { Model::spatial(robot, &tool) }.unwrap()
        };
        let along = Load::along_base([-300.0, 0.0, -800.0]).unwrap();
        let cases = [(true, Load::PAPER, 1e-9), (true, along, 1e-6), (false, Load::PAPER, 1e-2), (false, along, 1e-2)];
        for (is_plane, load, tolerance) in cases {
            let options = PlaceOptions::under(load);
            let placed = place(&model(&robot, is_plane), &zone.into(), &options, Watch::nobody()).unwrap();
            let placed = placed.feasible().unwrap();
            let [found, at_worst] = [placed, &at_worst(placed)].map(|placed| draws(&robot, load, placed).unwrap());
            let k = robot.drive_compliance().map(|k| k.unwrap());
            let mut missed = 0.0_f64;
            for (i, factor) in factors(&robot, 60).unwrap().iter().enumerate() {
                let drawn = with_compliance(&robot, std::array::from_fn(|i| k[i] * factor[i] * 1e6)).unwrap();
                let field =
                    deflection_field(&model(&drawn, is_plane), &options, placed, points.iter().copied()).unwrap();
                let expected = largest(field.iter().map(|point| point.deflection.unwrap()));
                assert!((found[i] / expected - 1.0).abs() < tolerance, "{load:?} {i}: {} {expected}", found[i]);
                missed = missed.max(1.0 - at_worst[i] / expected);
            }
            // Under a force that is known the best place balances its worst points: at one of them alone a draw would be a third and more too low.
            assert!(if load.is_worst() { missed < tolerance } else { 0.3 < missed }, "{load:?}: {missed}");
        }
    }

    #[test]
    fn a_draw_of_a_part_is_the_largest_of_its_faces() {
        let robot = robot("KR 210 R2700-2");
        let spindle = Pose::new([0.0, 0.0, 0.25].into(), [0.0, std::f64::consts::FRAC_PI_2, 0.0].into());
        let part = Part::of_box([0.4, 0.3, 0.1]).with_faces(&["top".into(), "front".into()]).unwrap();
        let options = PlaceOptions::careful(Load::worst(400.0).unwrap());
        let placed =
            place(&Model::spatial(&robot, &spindle).unwrap(), &part.into(), &options, Watch::nobody()).unwrap();
        let placed = placed.feasible().unwrap();
        let of_face = |face: &FacePlacement| {
            let hold = Hold::Space(Box::new(face.hold.clone()));
            let alone = Placement { hold, faces: Vec::new(), deflection: face.deflection, ..placed.clone() };
            draws(&robot, options.load, &alone).unwrap()
        };
        let [top, front] = [0, 1].map(|i| of_face(&placed.faces[i]));
        let found = draws(&robot, options.load, placed).unwrap();
        assert!(found.iter().zip(top.iter().zip(&front)).all(|(of, (a, b))| (of / a.max(*b) - 1.0).abs() < 1e-9));
        let by_front = top.iter().zip(&front).filter(|(top, front)| top < front).count();
        assert!(0 < by_front && by_front < DRAWS, "{by_front}");
    }

    /// Drives that are known to the last digit, by an identification that missed such a share of what moved.
    fn measured(share: f64) -> Robot {
        let mut robot = find("KR 210 R2700-2").unwrap().robot();
        let crate::robot::Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        drives.identified = Some(crate::drive::Identified {
            drives: [true; 6],
            covariance: nalgebra::Matrix6::zeros(),
            postures: 20,
            date: None,
            residual: share * 1e-3,
            left_out: None,
            moved: Some(1e-3),
        });
        robot
    }

    /// Drives that are known to the last digit, and an identification that missed a tenth of what moved: in the plane two coordinates of
    /// `d / 10 sqrt 2` each about a deflection d, in which the one along it decides: 1.645 standard deviations either way, to the half of the
    /// square of what lies across, `d (1 / 10 sqrt 2)^2 / 2`.
    #[test]
    fn a_deflection_of_a_measured_robot_is_as_uncertain_as_its_residual() {
        let robot = measured(0.1);
        let (task, options): (Task, _) = ("A:0.3".parse().unwrap(), PlaceOptions::under(Load::PAPER));
        let placed =
            crate::place::place(&ModelKind::Planar.of(&robot).unwrap(), &task.work, &options, Watch::nobody()).unwrap();
        let placed = placed.feasible().unwrap();
        let sd = 0.1 / 2.0_f64.sqrt();
        let Spread { p05, p95, .. } = spread(&robot, Load::PAPER, placed).unwrap();
        for (found, side) in [(p05, -1.0), (p95, 1.0)] {
            let by_hand = 1.0 + side * 1.645 * sd + sd * sd / 2.0;
            assert!((found / placed.deflection - by_hand).abs() < 0.01, "{found:e} {by_hand}");
        }
        let draws = drawn(&robot, Load::PAPER, placed).unwrap();
        // Half of them are more, and as many again as lie between the deflection and the shift by what lies across.
        assert!((share_within(&draws, placed.deflection) - 0.5).abs() < 0.04);
        assert!(share_within(&draws, p95) - 0.95 < 1e-3 && share_within(&draws, 0.0) == 0.0);
        // In another posture it misses something else: of 2000 draws half, within four standard deviations, are larger there.
        let elsewhere =
            PlaceOptions { within: Some(Within { x: Interval::spanning(2.0, 2.6), z: Interval::POSITIVE }), ..options };
        let other =
            crate::place::place(&ModelKind::Planar.of(&robot).unwrap(), &task.work, &elsewhere, Watch::nobody())
                .unwrap();
        let other = other.feasible().unwrap();
        let others = drawn(&robot, Load::PAPER, other).unwrap();
        let pairs = draws.iter().zip(&others);
        let larger = pairs.filter(|(a, b)| *a / placed.deflection < *b / other.deflection).count() as f64;
        assert!((larger / DRAWS as f64 - 0.5).abs() < 0.045, "{larger}");
        assert_eq!(draws, drawn(&robot, Load::PAPER, placed).unwrap());
    }

    /// What was not explained points any way, whatever counts of a displacement: against draws of the vector itself.
    #[test]
    fn what_counts_of_a_displacement_of_a_measured_robot_errs_as_all_of_it_does() {
        const DRAWN: usize = 40_000;
        let share = 0.2;
        let robot = measured(share);
        let tool = Pose::translation(0.1, 0.05, 0.25);
        let posture = compliance(&robot, &[0.2, -1.1, 1.6, 0.3, 0.7, 0.1], &tool).unwrap();
        let force = nalgebra::Vector3::new(40.0, 300.0, 100.0);
        let moved = posture.compliance.translation() * force;
        let away: nalgebra::Vector3<f64> = posture.tool.rotation * nalgebra::Vector3::z();
        let cases =
            [(Component::Total, None), (Component::Along, Some(force.normalize())), (Component::Normal, Some(away))];
        let mut most = [0.0; 3];
        for (i, (component, counted)) in cases.into_iter().enumerate() {
            let load = Load::along_base(force.into()).unwrap().counting(component);
            let found = of_posture(&robot, &posture, load).unwrap();
            let mut rng = fastrand::Rng::with_seed(91);
            let draws = (0..DRAWN).map(|_| {
                let error = nalgebra::Vector3::from_fn(|_, _| crate::prior::normal(&mut rng));
                let drawn = moved + error * (share * moved.norm() / 3_f64.sqrt());
                counted.map_or_else(|| drawn.norm(), |counted| counted.dot(&drawn).abs())
            });
            let expected = Spread::of(draws.collect());
            // Of two thousand draws percentiles are known to some per cent of what the middle nine tenths span.
            let within = 0.05 * (expected.p95 - expected.p05);
            for (a, b) in [(found.p05, expected.p05), (found.median, expected.median), (found.p95, expected.p95)] {
                assert!((a - b).abs() < within, "{component:?}: {found:?} {expected:?}");
            }
            most[i] = found.p95;
        }
        let [total, along, normal] = most;
        // No part of a displacement is longer than all of it.
        assert!(along < total && normal < along, "{most:?}");
    }

    #[test]
    fn chances_add_up_and_robots_that_are_alike_tie() {
        let one = robot("KR 210 R2700-2");
        let other = Robot { name: "the same again".into(), ..one.clone() };
        // Four times as soft: beyond what any draw is likely to turn round.
        let mut soft = Robot { name: "soft".into(), ..one.clone() };
        let crate::robot::Arm::SixAxis { drives, .. } = &mut soft.arm else { unreachable!("six axes") };
        drives.compliance.0 = drives.compliance.0.map(|k| 40.0 * k);
        let nothing = find("KR 210 R2700 extra").unwrap().robot();
        let task: Task = "A:0.3".parse().unwrap();
        let options = PlaceOptions::under(Load::PAPER);
        let ranking =
            rank(&[one, other, soft, nothing], &[task], &ModelKind::Planar, &options, crate::watch::Watch::nobody())
                .unwrap();
        let found: Vec<(String, Option<Chances>)> =
            ranking.rows.iter().zip(chances(&ranking)).map(|(row, of)| (row.robot.name.clone(), of[0])).collect();
        let of = |name: &str| found.iter().find(|(known, _)| known == name).unwrap().1;
        let [a, b, c] = ["KR 210 R2700-2", "the same again", "soft"].map(|name| of(name).unwrap());
        assert!((a.win + b.win + c.win - 1.0).abs() < 1e-12);
        // Half of 2000 draws, within four standard deviations.
        assert!((a.win - 0.5).abs() < 0.045 && a.ties && b.ties && !c.ties && c.win < 0.01, "{found:?}");
        assert!(c.regret > 10.0 * a.regret && 0.0 < a.regret);
        assert_eq!(of("KR 210 R2700 extra"), None);
    }
}
