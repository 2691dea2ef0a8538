//! Verb 2 in space: a section through everything the tool reaches, straight ahead of the robot.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;
use rayon::prelude::*;

use super::rolls::{Rolls, Way};
use super::{Axis, Grid, Held, MOST_CELLS_IN_SPACE, Map, MapError, Margins, check_grid};
use crate::interval::Interval;
use crate::inverse::{Configuration, SLACK, postures, within_limits};
use crate::limits::Limits;
use crate::model::SpatialModel;
use crate::space::{CLASSES, Near, Patch, SpatialArm, Stand, class};

/// Where any roll will do and they differ, the deflection told is at most so much, relative, above that of the best roll.
pub const ROLL_TOLERANCE: f64 = 1e-3;
/// Values that agree so well, relative, are equal, and the posture with more room to its limits is told.
const EQUAL: f64 = 1e-12;

/// What is mapped: tool poses in the plane through the joint-1 axis that points straight ahead.
#[derive(Clone, Copy, Debug)]
struct SectionOptions<'a> {
    x: Axis,
    z: Axis,
    force: f64,
    held: &'a Held,
}

/// Joint angles as reported, rad, at a point held in a configuration and at a roll.
pub(super) fn joints(
    model: &SpatialModel,
    held: &Held,
    (configuration, roll): (Configuration, f64),
    [x, z]: [f64; 2],
) -> Option<[f64; 6]> {
    let arm = model.arm();
    let stand = Stand { x, z, yaw: held.yaw, angle: 0.0, roll };
    let theta = of_class(&at_centre(arm, &Patch::of(held.elevation, &stand), &stand), configuration)?;
    let q = within_limits(&arm.geometry, &freed(arm, held).limits, &theta);
    Some(q.unwrap_or_else(|| arm.geometry.reported(&theta, arm.limits.third_axis)))
}

/// The worst deflection over a section, all six drives compliant, at the best configuration and roll of every point.
pub(super) fn section(arm: &SpatialArm, x: Axis, z: Axis, force: f64, held: &Held) -> Map {
    let options = SectionOptions { x, z, force, held };
    let freed = freed(arm, held);
    let scan = Scan::new(&freed, &options);
    let cells: Vec<Cell> = (0..z.count).into_par_iter().flat_map_iter(|j| scan.row(j)).collect();
    let layer = |value: fn(&Cell) -> f64| Grid { x, z, cells: cells.iter().map(value).collect() };
    let margins = Margins {
        limits: layer(|cell| cell.limit_margin),
        singular: layer(|cell| cell.singular_margin),
        held: cells.iter().map(|cell| cell.posture).collect(),
    };
    Map { deflection: layer(|cell| cell.worst), space: Some(margins), from_axis_2: [x, z] }
}

/// The upright box, m from the base, outside which the tool reaches nothing in this direction: ahead, upwards.
///
/// Found on a 96 x 192 grid and widened by one step; `None` where nothing is reached.
pub(super) fn reached_box(arm: &SpatialArm, held: &Held) -> Result<Option<[Interval; 2]>, MapError> {
    let [ahead, up] = arm.reach();
    let x = Axis::between(0.0, ahead.max(), 96);
    let z = Axis::between(up.min(), up.max(), 192);
    check_grid(x, z, MOST_CELLS_IN_SPACE)?;
    let found = section(arm, x, z, 1.0, held).deflection;
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

/// The arm without the limits that are left aside.
fn freed(arm: &SpatialArm, held: &Held) -> SpatialArm {
    let roll_is_free = held.roll.is_none() && arm.tool_turns_about_axis_6();
    arm.without_limit_on(0, true).without_limit_on(5, roll_is_free)
}

/// All postures at the centre of a stand.
fn at_centre(arm: &SpatialArm, patch: &Patch, stand: &Stand) -> Vec<(Configuration, [f64; 6])> {
    let flange = patch.pose(stand, [0.0; 2]) * arm.flange_from_tool.inverse();
    postures(&arm.geometry, &flange).found
}

/// Model angles of a class among the postures of a pose.
fn of_class(found: &[(Configuration, [f64; 6])], class: Configuration) -> Option<[f64; 6]> {
    let same_arm = |other: &Configuration| other.shoulder == class.shoulder && other.elbow == class.elbow;
    // At a singular wrist one representative stands for both.
    let way = found.iter().find(|way| way.0 == class).or_else(|| found.iter().find(|way| same_arm(&way.0)));
    way.map(|(_, theta)| *theta)
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
    /// Places of the classes that are wanted.
    places: Vec<usize>,
}

impl<'a> Scan<'a> {
    fn new(freed: &'a SpatialArm, options: &'a SectionOptions<'a>) -> Self {
        let places: Vec<usize> =
            (0..CLASSES).filter(|&place| options.held.configuration.is_none_or(|only| only == class(place))).collect();
        let roll = match options.held.roll {
            Some(roll) => Roll::One(roll),
            None if freed.tool_turns_about_axis_6() => Roll::One(0.0),
            None => {
                let patches =
                    [0.0, FRAC_PI_2, PI].map(|roll| Self::patch(options, &Self::stand(options, 0.0, 0.0, roll)));
                Roll::Any(Rolls::new(freed, freed.turning(patches.each_ref().map(Patch::tool)), places.clone()))
            }
        };
        Self { options, freed, roll, places }
    }

    fn stand(options: &SectionOptions, x: f64, z: f64, roll: f64) -> Stand {
        Stand { x, z, yaw: options.held.yaw, angle: 0.0, roll }
    }

    fn patch(options: &SectionOptions, stand: &Stand) -> Patch {
        Patch::of(options.held.elevation, stand)
    }

    fn row(&self, j: usize) -> Vec<Cell> {
        let (x, z) = (self.options.x.points(), self.options.z.at(j));
        let ways: Vec<Vec<Way>> = match &self.roll {
            Roll::One(roll) => self.at_one_roll(&x, z, *roll),
            Roll::Any(rolls) => x.iter().map(|x| rolls.best(&Vector3::new(*x, 0.0, z))).collect(),
        };
        x.into_iter().zip(ways).map(|(x, ways)| self.cell(&ways, x, z)).collect()
    }

    /// The best ways to hold every point of a row at one roll.
    fn at_one_roll(&self, x: &[f64], z: f64, roll: f64) -> Vec<Vec<Way>> {
        let (y, z) = (vec![0.0; x.len()], vec![z; x.len()]);
        let mut classes = vec![vec![0.0; x.len()]; CLASSES];
        let mut rows = classes.iter_mut().map(Vec::as_mut_slice);
        let into = std::array::from_fn(|_| rows.next().expect("one row per class"));
        let patch = Self::patch(self.options, &Self::stand(self.options, 0.0, 0.0, roll));
        self.freed.classes_at(&self.freed.orientation(patch.tool()), &Near::default(), [x, &y, &z], into);
        let at = |i: usize| {
            let ways = self.places.iter().map(|&place| Way { worst: classes[place][i], place, roll });
            let least = ways.clone().map(|way| way.worst).fold(f64::INFINITY, f64::min);
            ways.filter(|way| way.worst.is_finite() && way.worst <= least * (1.0 + EQUAL)).collect()
        };
        (0..x.len()).map(at).collect()
    }

    /// Of equally good ways the one with most room to its limits, so that neighbours tell the same posture.
    fn cell(&self, ways: &[Way], x: f64, z: f64) -> Cell {
        let none = Cell { worst: f64::NAN, limit_margin: f64::NAN, singular_margin: f64::NAN, posture: None };
        let of_one_roll = ways.chunk_by(|one, other| one.roll == other.roll);
        let cells = of_one_roll.flat_map(|ways| {
            let stand = Self::stand(self.options, x, z, ways[0].roll);
            let found = at_centre(self.freed, &Self::patch(self.options, &stand), &stand);
            ways.iter().map(move |way| self.told(way, of_class(&found, class(way.place))))
        });
        // A margin of NaN is that of no way at all.
        cells.fold(none, |best, other| if other.limit_margin <= best.limit_margin { best } else { other })
    }

    /// A way with its model angles.
    fn told(&self, way: &Way, theta: Option<[f64; 6]>) -> Cell {
        let limit_margin = theta.and_then(|theta| {
            let q = within_limits(&self.freed.geometry, &self.freed.limits, &theta)?;
            let Limits { joints, elbow, .. } = &self.freed.limits;
            let enclosed = elbow.room(elbow.turn_to(PI - theta[2], SLACK)?);
            let rooms = q.into_iter().zip(joints).map(|(q, range)| range.room(q));
            Some(rooms.fold(enclosed, f64::min).max(0.0))
        });
        Cell {
            worst: way.worst * self.options.force,
            limit_margin: limit_margin.unwrap_or(0.0),
            singular_margin: theta.map_or(0.0, |theta| self.freed.geometry.singular_margin(&theta)),
            posture: Some((class(way.place), way.roll)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::inverse::reached;
    use crate::model::Model;
    use crate::robot::Robot;
    use crate::spatial::Pose;

    fn spatial(robot: &Robot, tool: &Pose) -> SpatialModel {
        let Model::Spatial(model) = Model::spatial(robot, tool).unwrap() else { unreachable!("asked for") };
        model
    }

    #[test]
    fn every_cell_is_what_single_postures_give_and_blank_where_there_are_none() {
        let tools = [Pose::identity(), Pose::translation(0.15, 0.0, 0.1)];
        for (n, robot) in paper_robots().iter().enumerate().take(4) {
            let tool = tools[n % 2];
            let (x, z) = (Axis::between(0.4, 2.6, 8), Axis::between(0.2, 2.2, 7));
            let held = Held { elevation: [-FRAC_PI_2, 0.0][n / 2], yaw: 0.2, roll: Some(0.3), configuration: None };
            let model = spatial(robot, &tool);
            let map = section(model.arm(), x, z, 1000.0, &held);
            let found = map.space.as_ref().unwrap();
            for j in 0..7 {
                for i in 0..8 {
                    let stand = Stand { x: x.at(i), z: z.at(j), yaw: 0.2, angle: 0.0, roll: 0.3 };
                    let pose = Patch::of(held.elevation, &stand).pose(&stand, [0.0; 2]);
                    let ways = reached(robot, &(pose * tool.inverse()));
                    let values = ways.iter().map(|way| compliance(robot, &way.1, &tool).unwrap().compliance.worst().0);
                    match map.deflection.get(i, j) {
                        Some(worst) => {
                            let expected = values.fold(f64::INFINITY, f64::min) * 1000.0;
                            assert!((worst - expected).abs() <= 1e-7 * expected, "{} {stand:?}", robot.name);
                            let (class, roll) = found.at(i, j).unwrap();
                            assert!(ways.iter().any(|way| way.0 == class) && roll == 0.3, "{class}");
                            let q = joints(&model, &held, (class, roll), [stand.x, stand.z]).unwrap();
                            let at = compliance(robot, &q, &tool).unwrap().tool;
                            assert!((at.inverse() * pose).translation.vector.norm() < 1e-9, "{} {q:?}", robot.name);
                        }
                        None => assert!(ways.is_empty(), "{}: {stand:?} is reached by {ways:?}", robot.name),
                    }
                }
            }
        }
    }

    #[test]
    fn the_roll_of_a_flange_changes_nothing_and_the_best_roll_of_a_tool_aside_is_no_worse_than_any() {
        let robot = &paper_robots()[4];
        let (x, z) = (Axis::between(0.8, 2.4, 9), Axis::between(0.3, 2.0, 9));
        let mapped = |tool: Pose, roll: Option<f64>| {
            let held = Held { elevation: 0.0, roll, ..Held::TOOL_DOWN };
            section(spatial(robot, &tool).arm(), x, z, 1.0, &held).deflection
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
