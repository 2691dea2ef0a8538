//! Verb 2 in space: a section through everything the tool reaches, straight ahead of the robot.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;

use super::rolls::{Hold, Rolls};
use super::{Axis, Grid, HeldPosture, MOST_CELLS_IN_SPACE, Map, MapError, Margins, check_grid};
use crate::batch::{SameBranch, SpatialArm};
use crate::interval::Interval;
use crate::inverse::{Configuration, postures, within_limits};
use crate::limits::Limits;
use crate::load::{Forces, Load};
use crate::model::SpatialModel;
use crate::parallel;
use crate::tolerances;
use crate::watch::{Parts, Stopped, Watch};
use crate::work::{WorkPlacement, WorkPlane};

/// Where any roll will do and they differ, the deflection reported is at most so much, relative, above that of the best roll.
pub const ROLL_TOLERANCE: f64 = 1e-3;
/// Values that agree so well, relative, are equal, and the posture with more room to its limits is reported.
const EQUAL: f64 = 1e-12;

/// Room to limits that agrees so well, rad, is equal: of mirrored ways always the same one is reported, not now one and now the
/// other by rounding.
const MIRRORED: f64 = 1e-4;

/// What is mapped: tool poses in the plane through the joint-1 axis that points straight ahead.
#[derive(Clone, Copy, Debug)]
struct SectionOptions<'a> {
    x: Axis,
    z: Axis,
    load: Load,
    held: &'a HeldPosture,
}

/// Joint angles as reported, rad, at a point held in a configuration and at a roll.
pub(super) fn joints(
    model: &SpatialModel,
    (load, held): (Load, &HeldPosture),
    (configuration, roll): (Configuration, f64),
    [x, z]: [f64; 2],
) -> Option<[f64; 6]> {
    let arm = model.arm();
    let work = WorkPlacement { x, y: 0.0, z, yaw: held.yaw, angle: 0.0, roll };
    let theta = of_configuration(&at_centre(arm, &WorkPlane::of(held.elevation, &work), &work), configuration)?;
    let q = roomiest(&freed(arm, load, held), &theta);
    Some(q.unwrap_or_else(|| arm.geometry.reported(&theta, arm.limits.third_axis)))
}

/// The joint angles a robot reports for model angles, each turned to where its range leaves it most room; `None` where a limit forbids it.
fn roomiest(arm: &SpatialArm, theta: &[f64; 6]) -> Option<[f64; 6]> {
    let Limits { joints, .. } = &arm.limits;
    let mut q = within_limits(&arm.geometry, &arm.limits, theta)?;
    for (joint, (q, range)) in q.iter_mut().zip(joints).enumerate() {
        let turned = *q + TAU * ((range.middle() - *q) / TAU).round();
        // What else the limits say leaves joint 3 no choice, or all.
        if range.is_bounded() && range.room(*q) < range.room(turned) && !(joint == 2 && arm.limits.third_is_wound()) {
            *q = turned;
        }
    }
    Some(q)
}

/// The deflection over a section, all six drives compliant, at the best configuration and roll of every point.
pub(super) fn section(
    arm: &SpatialArm,
    [x, z]: [Axis; 2],
    (load, held): (Load, &HeldPosture),
    watch: Watch,
) -> Result<Map, Stopped> {
    let options = SectionOptions { x, z, load, held };
    let freed = freed(arm, load, held);
    let scan = Scan::new(&freed, &options);
    let parts = watch.parts(Some(z.count));
    let row = |j: usize| {
        let row = scan.row(j, &parts)?;
        parts.one_more().map(|()| row)
    };
    let cells = parallel::try_each_of(z.count, row)?.concat();
    let layer = |value: fn(&Cell) -> f64| Grid { x, z, cells: cells.iter().map(value).collect() };
    let margins = Margins {
        limits: layer(|cell| cell.limit_margin),
        singular: layer(|cell| cell.singular_margin),
        held: cells.iter().map(|cell| cell.posture).collect(),
    };
    Ok(Map { deflection: layer(|cell| cell.worst), space: Some(margins), from_axis_2: [x, z] })
}

/// Which way one point after another is held.
pub(super) struct Points {
    freed: SpatialArm,
    load: Load,
    held: HeldPosture,
}

impl Points {
    pub(super) fn new(arm: &SpatialArm, load: Load, held: &HeldPosture) -> Self {
        Self { freed: freed(arm, load, held), load, held: *held }
    }

    /// As the cell of a map tells it.
    pub(super) fn at(&self, [x, z]: [f64; 2]) -> Option<(Configuration, f64)> {
        let only = |at: f64| Axis { start: at, step: 1.0, count: 1 };
        let options = SectionOptions { x: only(x), z: only(z), load: self.load, held: &self.held };
        let row = Scan::new(&self.freed, &options).row(0, &Watch::nobody().parts(None));
        row.expect("nobody stops it").first().and_then(|cell| cell.posture)
    }
}

/// The upright box, m from the base, outside which the tool reaches nothing in this direction: ahead, upwards.
///
/// Found on a 96 x 192 grid and widened by one step; `None` where nothing is reached.
pub(super) fn reached_box(
    arm: &SpatialArm,
    load: Load,
    held: &HeldPosture,
    watch: Watch,
) -> Result<Option<[Interval; 2]>, MapError> {
    let [ahead, up] = arm.reach();
    let x = Axis::between(0.0, ahead.max(), 96);
    let z = Axis::between(up.min(), up.max(), 192);
    check_grid(x, z, MOST_CELLS_IN_SPACE)?;
    let found = section(arm, [x, z], (load, held), watch)?.deflection;
    let reached = |i: usize, j: usize| found.get(i, j).is_some();
    let columns: Vec<usize> = (0..x.count).filter(|&i| (0..z.count).any(|j| reached(i, j))).collect();
    let rows: Vec<usize> = (0..z.count).filter(|&j| (0..x.count).any(|i| reached(i, j))).collect();
    let span = |axis: Axis, cells: &[usize]| {
        let (first, last) = (*cells.first()?, *cells.last()?);
        Some(Interval::spanning(axis.at(first) - axis.step, axis.at(last) + axis.step))
    };
    let ahead_of_axis = |range: Interval| range.intersect(Interval::POSITIVE);
    Ok(span(x, &columns).and_then(ahead_of_axis).zip(span(z, &rows)).map(|(x, z)| [x, z]))
}

/// One point of a section; NaN where nothing reaches it.
#[derive(Clone, Copy)]
struct Cell {
    worst: f64,
    limit_margin: f64,
    singular_margin: f64,
    posture: Option<(Configuration, f64)>,
}

impl Cell {
    const NONE: Self = Self { worst: f64::NAN, limit_margin: f64::NAN, singular_margin: f64::NAN, posture: None };

    /// Which of two mirrored ways is reported: the roll to the left, then the configuration that counts first.
    fn side(&self) -> (bool, usize) {
        self.posture.map_or((true, usize::MAX), |(configuration, roll)| (roll < 0.0, configuration.index()))
    }
}

/// The arm without the limits that are left aside. Under a force that tells one bearing from another, the section stands for itself
/// alone, and joint 1 keeps its own.
fn freed(arm: &SpatialArm, load: Load, held: &HeldPosture) -> SpatialArm {
    let roll_is_free = held.roll.is_none() && arm.tool_turns_about_axis_6();
    arm.without_limit_on(0, !load.breaks_symmetry()).without_limit_on(5, roll_is_free)
}

/// All postures at the centre of a zone.
fn at_centre(arm: &SpatialArm, plane: &WorkPlane, work: &WorkPlacement) -> Vec<(Configuration, [f64; 6])> {
    let flange = plane.pose(work, [0.0; 2]) * arm.flange_from_tool.inverse();
    postures(&arm.geometry, &flange).found
}

/// Model angles of a configuration among the postures of a pose.
fn of_configuration(found: &[(Configuration, [f64; 6])], configuration: Configuration) -> Option<[f64; 6]> {
    let same_arm =
        |other: &Configuration| other.shoulder == configuration.shoulder && other.elbow == configuration.elbow;
    // At a singular wrist one representative stands for both.
    let hold =
        found.iter().find(|hold| hold.0 == configuration).or_else(|| found.iter().find(|hold| same_arm(&hold.0)));
    hold.map(|(_, theta)| *theta)
}

/// Where rolls differ and any will do, they are searched; else one stands for all.
enum Roll<'a> {
    One(f64),
    Any(Rolls<'a>),
}

struct Scan<'a> {
    options: &'a SectionOptions<'a>,
    freed: &'a SpatialArm,
    roll: Roll<'a>,
    /// Those that are asked for.
    configurations: Vec<Configuration>,
    /// That may act, whatever the roll; any where `None`.
    forces: Option<Forces>,
}

impl<'a> Scan<'a> {
    fn new(freed: &'a SpatialArm, options: &'a SectionOptions<'a>) -> Self {
        let configurations: Vec<Configuration> = Configuration::ALL
            .into_iter()
            .filter(|configuration| options.held.configuration.is_none_or(|only| only == *configuration))
            .collect();
        let forces = Self::plane(options, &Self::work(options, 0.0, 0.0, 0.0)).forces(options.load);
        let roll = match options.held.roll {
            Some(roll) => Roll::One(roll),
            None if freed.tool_turns_about_axis_6() => Roll::One(0.0),
            None => {
                let planes =
                    [0.0, FRAC_PI_2, PI].map(|roll| Self::plane(options, &Self::work(options, 0.0, 0.0, roll)));
                Roll::Any(Rolls::new(
                    freed,
                    &freed.rolled_tool(planes.each_ref().map(WorkPlane::tool)).under(forces),
                    configurations.clone(),
                ))
            }
        };
        Self { options, freed, roll, configurations, forces }
    }

    fn work(options: &SectionOptions, x: f64, z: f64, roll: f64) -> WorkPlacement {
        WorkPlacement { x, y: 0.0, z, yaw: options.held.yaw, angle: 0.0, roll }
    }

    fn plane(options: &SectionOptions, work: &WorkPlacement) -> WorkPlane {
        WorkPlane::of(options.held.elevation, work)
    }

    fn row(&self, j: usize, parts: &Parts) -> Result<Vec<Cell>, Stopped> {
        let (x, z) = (self.options.x.points(), self.options.z.at(j));
        let best = |rolls: &Rolls, x: f64| parts.go_on().map(|()| rolls.best(&Vector3::new(x, 0.0, z)));
        let holds: Vec<Vec<Hold>> = match &self.roll {
            Roll::One(roll) => self.at_one_roll(&x, z, *roll),
            Roll::Any(rolls) => x.iter().map(|x| best(rolls, *x)).collect::<Result<_, _>>()?,
        };
        x.into_iter().zip(holds).map(|(x, holds)| parts.go_on().map(|()| self.cell(&holds, x, z))).collect()
    }

    /// The best ways to hold every point of a row at one roll.
    fn at_one_roll(&self, x: &[f64], z: f64, roll: f64) -> Vec<Vec<Hold>> {
        let (y, z) = (vec![0.0; x.len()], vec![z; x.len()]);
        let mut values = vec![vec![0.0; x.len()]; Configuration::COUNT];
        let mut rows = values.iter_mut().map(Vec::as_mut_slice);
        let into = std::array::from_fn(|_| rows.next().expect("one row per configuration"));
        let plane = Self::plane(self.options, &Self::work(self.options, 0.0, 0.0, roll));
        let orientation = self.freed.orientation(plane.tool()).under(self.forces);
        self.freed.configurations_at(&orientation, &SameBranch::default(), [x, &y, &z], into);
        let at = |i: usize| {
            let holds = self.configurations.iter().map(|&configuration| Hold {
                worst: values[configuration.index()][i],
                configuration,
                roll,
            });
            let least = holds.clone().map(|hold| hold.worst).fold(f64::INFINITY, f64::min);
            holds.filter(|hold| hold.worst.is_finite() && hold.worst <= least * (1.0 + EQUAL)).collect()
        };
        (0..x.len()).map(at).collect()
    }

    /// Of equally good ways to hold a point the one with most room to its limits, so that neighbours tell the same posture.
    fn cell(&self, holds: &[Hold], x: f64, z: f64) -> Cell {
        let none = Cell::NONE;
        let of_one_roll = holds.chunk_by(|one, other| one.roll == other.roll);
        let cells = of_one_roll.flat_map(|holds| {
            let work = Self::work(self.options, x, z, holds[0].roll);
            let found = at_centre(self.freed, &Self::plane(self.options, &work), &work);
            holds.iter().map(move |hold| self.cell_of(hold, of_configuration(&found, hold.configuration)))
        });
        // A margin of NaN is that of no way at all.
        cells.fold(none, |best, other| {
            let is_mirrored = (other.limit_margin - best.limit_margin).abs() <= MIRRORED;
            let is_worse =
                if is_mirrored { best.side() <= other.side() } else { other.limit_margin <= best.limit_margin };
            if is_worse { best } else { other }
        })
    }

    /// The cell that one way to hold a point gives, from its model angles.
    fn cell_of(&self, hold: &Hold, theta: Option<[f64; 6]>) -> Cell {
        let limit_margin = theta.and_then(|theta| {
            let q = roomiest(self.freed, &theta)?;
            let Limits { joints, elbow, .. } = &self.freed.limits;
            let enclosed = elbow.room(elbow.turn_to(PI - theta[2], tolerances::LIMIT)?);
            let rooms = q.into_iter().zip(joints).map(|(q, range)| range.room(q));
            Some(rooms.fold(enclosed, f64::min).max(0.0))
        });
        Cell {
            worst: hold.worst * self.options.load.newtons(),
            limit_margin: limit_margin.unwrap_or(0.0),
            singular_margin: theta.map_or(0.0, |theta| self.freed.geometry.singular_margin(&theta)),
            posture: Some((hold.configuration, hold.roll)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::inverse::reached;
    use crate::load::Component;
    use crate::model::Model;
    use crate::robot::Robot;
    use crate::spatial::Pose;

    fn spatial(robot: &Robot, tool: &Pose) -> SpatialModel {
        let Model::Spatial(model) = Model::spatial(robot, tool).unwrap() else { unreachable!("asked for") };
        model
    }

    fn section(arm: &SpatialArm, x: Axis, z: Axis, load: Load, held: &HeldPosture) -> Map {
        super::section(arm, [x, z], (load, held), Watch::nobody()).unwrap()
    }

    #[test]
    fn every_cell_is_what_single_postures_give_and_blank_where_there_are_none() {
        let tools = [Pose::identity(), Pose::translation(0.15, 0.0, 0.1)];
        for (n, robot) in paper_robots().iter().enumerate().take(4) {
            let tool = tools[n % 2];
            let (x, z) = (Axis::between(0.4, 2.6, 8), Axis::between(0.2, 2.2, 7));
            let held =
                HeldPosture { elevation: [-FRAC_PI_2, 0.0][n / 2], yaw: 0.2, roll: Some(0.3), configuration: None };
            let model = spatial(robot, &tool);
            let map = section(model.arm(), x, z, Load::PAPER, &held);
            let found = map.space.as_ref().unwrap();
            for j in 0..7 {
                for i in 0..8 {
                    let work = WorkPlacement { x: x.at(i), y: 0.0, z: z.at(j), yaw: 0.2, angle: 0.0, roll: 0.3 };
                    let pose = WorkPlane::of(held.elevation, &work).pose(&work, [0.0; 2]);
                    let ways = reached(robot, &(pose * tool.inverse()));
                    let values = ways.iter().map(|way| compliance(robot, &way.1, &tool).unwrap().compliance.worst().0);
                    match map.deflection.get(i, j) {
                        Some(worst) => {
                            let expected = values.fold(f64::INFINITY, f64::min) * 1000.0;
                            assert!((worst - expected).abs() <= 1e-7 * expected, "{} {work:?}", robot.name);
                            let (configuration, roll) = found.at(i, j).unwrap();
                            assert!(ways.iter().any(|way| way.0 == configuration) && roll == 0.3, "{configuration}");
                            let q =
                                joints(&model, (Load::PAPER, &held), (configuration, roll), [work.x, work.z]).unwrap();
                            let at = compliance(robot, &q, &tool).unwrap().tool;
                            assert!((at.inverse() * pose).translation.vector.norm() < 1e-9, "{} {q:?}", robot.name);
                        }
                        None => assert!(ways.is_empty(), "{}: {work:?} is reached by {ways:?}", robot.name),
                    }
                }
            }
        }
    }

    #[test]
    fn under_a_force_of_known_direction_every_cell_is_what_single_postures_give() {
        let feed = Some(0.7);
        let tool_force = Load::along_tool([300.0, -100.0, 50.0], feed).unwrap();
        let any_feed = Load::along_tool([300.0, -100.0, 50.0], None).unwrap();
        let base = Load::along_base([30.0, 40.0, -120.0]).unwrap();
        let loads = [
            tool_force,
            tool_force.with_cone(0.4).unwrap().counting(Component::Normal),
            any_feed,
            any_feed.with_cone(0.3).unwrap().counting(Component::Along),
            base.with_cone(0.2).unwrap(),
            Load::worst(500.0).unwrap().counting(Component::Normal),
        ];
        let (robot, tool) = (&paper_robots()[4], Pose::translation(0.15, 0.0, 0.1));
        let (x, z) = (Axis::between(0.4, 2.6, 7), Axis::between(0.2, 2.2, 6));
        let mut compared = 0;
        for (n, load) in loads.into_iter().enumerate() {
            let held =
                HeldPosture { elevation: -FRAC_PI_2 + 0.4 * n as f64, yaw: 0.2, roll: Some(0.3), configuration: None };
            let map = section(spatial(robot, &tool).arm(), x, z, load, &held).deflection;
            for (i, j) in (0..42).map(|cell| (cell % 7, cell / 7)) {
                let work = WorkPlacement { x: x.at(i), y: 0.0, z: z.at(j), yaw: 0.2, angle: 0.0, roll: 0.3 };
                let plane = WorkPlane::of(held.elevation, &work);
                let flange = plane.pose(&work, [0.0; 2]) * tool.inverse();
                let columns = [plane.first, plane.second, -Vector3::from(plane.tool().column(2))];
                let forces = load.forces(&nalgebra::Matrix3::from_columns(&columns));
                let values = reached(robot, &flange).into_iter().map(|(_, q)| {
                    let posture = compliance(robot, &q, &tool).unwrap();
                    forces.largest(&posture.compliance.translation()).value * load.newtons()
                });
                let expected = values.reduce(f64::min);
                assert_eq!(map.get(i, j).is_some(), expected.is_some(), "{load:?} {work:?}");
                if let (Some(found), Some(expected)) = (map.get(i, j), expected) {
                    compared += 1;
                    assert!((found - expected).abs() <= 1e-6 * expected, "{load:?} {work:?}: {found} {expected}");
                }
            }
        }
        assert!(60 < compared, "{compared}");
    }

    /// Joints 4 and 6 turn by two turns and more: whichever of their angles is reported, no other number of whole turns leaves more room.
    #[test]
    fn the_margin_reported_is_that_of_the_turns_with_most_room() {
        let mut robot = paper_robots().swap_remove(4);
        let crate::robot::Arm::SixAxis { limits, .. } = &mut robot.arm else { unreachable!("six axes") };
        limits.joints[3] = Interval::spanning(-7.0, 6.0);
        let tool = Pose::translation(0.15, 0.05, 0.1);
        let (x, z) = (Axis::between(0.9, 1.9, 6), Axis::between(0.3, 1.3, 6));
        let held = HeldPosture { elevation: -1.2, roll: Some(0.3), ..HeldPosture::TOOL_DOWN };
        // Where one posture is reported, joint 6 has next to no room, and a turn further much.
        let model = spatial(&robot, &tool);
        let way = section(model.arm(), x, z, Load::UNIT, &held).space.unwrap().at(3, 3).unwrap();
        let [.., sixth] = joints(&model, (Load::UNIT, &held), way, [x.at(3), z.at(3)]).unwrap();
        let crate::robot::Arm::SixAxis { limits, .. } = &mut robot.arm else { unreachable!("six axes") };
        limits.joints[5] = Interval::spanning(sixth - 0.02, sixth + TAU + 2.0);
        let limits = limits.clone();
        let model = spatial(&robot, &tool);
        let map = section(model.arm(), x, z, Load::UNIT, &held);
        let margins = map.space.as_ref().unwrap();
        let (mut compared, mut decided) = (0, 0);
        for (i, j) in (0..36).map(|cell| (cell % 6, cell / 6)) {
            let Some(way) = margins.at(i, j) else { continue };
            let q = joints(&model, (Load::UNIT, &held), way, [x.at(i), z.at(j)]).unwrap();
            // Joint 1 is left aside; no other joint has a choice.
            let room = |joint: usize, turns: i32| limits.joints[joint].room(q[joint] + TAU * f64::from(turns));
            let most = |joint: usize| (-3..=3).map(|turns| room(joint, turns)).fold(f64::NEG_INFINITY, f64::max);
            let rooms = [room(1, 0), room(2, 0), most(3), room(4, 0), most(5)];
            let enclosed = PI - model.arm().geometry.model_angles(&q, limits.third_axis)[2];
            let links = limits.elbow.room(limits.elbow.turn_to(enclosed, 1e-9).unwrap());
            let expected = rooms.into_iter().fold(links, f64::min);
            let found = margins.limits.get(i, j).unwrap();
            assert!((found - expected).abs() < 1e-9, "{found} {expected} {q:?}");
            compared += 1;
            decided += usize::from(limits.joints[5].room(limits.joints[5].turn_to(q[5], 0.0).unwrap()) < expected);
        }
        assert!(10 < compared && 0 < decided, "{compared} {decided}");
    }

    #[test]
    fn neighbours_tell_rolls_to_the_same_side() {
        // All limits of this arm are the same on both sides of its plane, so every posture has a mirrored one.
        let mut robot = paper_robots().swap_remove(4);
        let crate::robot::Arm::SixAxis { limits, .. } = &mut robot.arm else { unreachable!("six axes") };
        for joint in [3, 5] {
            limits.joints[joint] = Interval::spanning(-6.0, 6.0);
        }
        let tool = Pose::translation(0.25, 0.0, 0.1);
        let (x, z) = (Axis::between(0.9, 1.9, 21), Axis::between(0.3, 1.3, 21));
        let map = section(spatial(&robot, &tool).arm(), x, z, Load::UNIT, &HeldPosture::TOOL_DOWN);
        let rolls: Vec<f64> = (0..21)
            .flat_map(|j| map.space.as_ref().unwrap().row(j).flatten().collect::<Vec<_>>())
            .map(|held| held.1)
            .collect();
        let left = rolls.iter().filter(|roll| 0.0 <= **roll).count();
        // The best roll may be straight ahead or straight back, reported as -180 degrees.
        let straight = rolls.iter().filter(|roll| **roll < -PI + 1e-3).count();
        assert!(300 < rolls.len() && left + straight == rolls.len(), "{left} + {straight} of {}", rolls.len());
    }

    #[test]
    fn the_roll_of_a_flange_changes_nothing_and_the_best_roll_of_a_tool_aside_is_no_worse_than_any() {
        let robot = &paper_robots()[4];
        let (x, z) = (Axis::between(0.8, 2.4, 9), Axis::between(0.3, 2.0, 9));
        let mapped = |tool: Pose, roll: Option<f64>| {
            let held = HeldPosture { elevation: 0.0, roll, ..HeldPosture::TOOL_DOWN };
            section(spatial(robot, &tool).arm(), x, z, Load::UNIT, &held).deflection
        };
        let (best, rolled) = (mapped(Pose::identity(), None), mapped(Pose::identity(), Some(1.0)));
        let aside = Pose::translation(0.2, 0.0, 0.1);
        let (best_aside, rolled_aside) = (mapped(aside, None), mapped(aside, Some(0.61)));
        for (i, j) in (0..81).map(|cell| (cell % 9, cell / 9)) {
            if let (Some(best), Some(rolled)) = (best.get(i, j), rolled.get(i, j)) {
                assert!((best - rolled).abs() <= 1e-12 * best);
            }
            if let Some(rolled) = rolled_aside.get(i, j) {
                assert!(best_aside.get(i, j).unwrap() <= rolled * (1.0 + ROLL_TOLERANCE));
            }
        }
    }
}
