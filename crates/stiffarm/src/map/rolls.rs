//! Which rolls of the tool hold a point best, where every roll is another posture?
//!
//! A scan of all rolls, 5 degrees apart, gives for every posture its compliance (whatever its limits) and how much room its
//! limits leave (negative where they forbid it). Both are smooth, so their second differences say how far they can get
//! between two rolls; not near singular postures, which show in joint 1 or joint 4 turning fast. Where a better value cannot be
//! ruled out, the gap is divided by five, and so on.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use crate::batch::{AtRoll, RolledTool, SpatialArm};
use crate::inverse::Configuration;

/// Rolls of the scan.
const SCAN: usize = 72;
/// Parts into which a gap is divided; with its neighbours they fill the widest register.
const PARTS: usize = 5;
/// How often: down to some thousandths of a degree.
const DEPTH: usize = 5;
/// Cosine of what joints 1 and 4 may turn in a gap, 25 degrees, before nothing is smooth there.
const SMOOTH: f64 = 0.9;
/// A better value by less than this, relative, is not looked for. With what second differences miss, and with [`ROOM`], the value reported
/// is the least of all rolls to `ROLL_TOLERANCE`.
const WORTH: f64 = 3e-4;
/// So much more than the least, relative, is taken for as much room to the limits as there can be, and less for less: where nearly all
/// rolls are equally good, the one reported would else be a matter of rounding, and neighbours would report others.
const ROOM: f64 = 4e-4;
/// Values that agree so well, relative, are equal: where two eigenvalues nearly agree, no more digits are known.
const EQUAL: f64 = 1e-7;
/// Most ways to hold a point that are distinguished: mirrored postures are two.
const MOST: usize = 4;

/// One way to hold a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hold {
    /// What counts of the translation per force, m/N.
    pub(super) worst: f64,
    pub(super) configuration: Configuration,
    /// Of the tool about its axis, rad.
    pub(super) roll: f64,
}

/// Looks for the best rolls of one tool, point after point.
pub(super) struct Rolls<'a> {
    arm: &'a SpatialArm,
    rolled_tool: RolledTool,
    /// Those that may be taken.
    configurations: Vec<Configuration>,
    scan: Vec<f64>,
}

impl<'a> Rolls<'a> {
    pub(super) fn new(arm: &'a SpatialArm, rolled_tool: &RolledTool, configurations: Vec<Configuration>) -> Self {
        let scan = (0..SCAN).map(|i| TAU * i as f64 / SCAN as f64).collect();
        Self { arm, rolled_tool: *rolled_tool, configurations, scan }
    }

    /// The best ways to hold a point, all equally good; none where no roll reaches it within the limits.
    pub(super) fn best(&self, point: &Vector3<f64>) -> Vec<Hold> {
        let mut search = Search { rolls: self, point, best: f64::INFINITY, holds: Vec::new() };
        let mut around = Vec::with_capacity(SCAN + 3);
        self.arm.at_rolls(&self.rolled_tool, point, &self.scan, &mut around);
        search.keep(&around);
        // Once round: the gap before the first roll comes after the last.
        around.insert(0, around[SCAN - 1]);
        around.push(around[1]);
        around.push(around[2]);
        search.divide(&around, 1);
        search.descended()
    }
}

struct Search<'a> {
    rolls: &'a Rolls<'a>,
    point: &'a Vector3<f64>,
    best: f64,
    /// Allowed ones that were nearly as good as the best when they were found, and what they cost.
    holds: Vec<(Hold, f64)>,
}

impl Search<'_> {
    fn keep(&mut self, found: &[AtRoll]) {
        for at in found {
            for &configuration in &self.rolls.configurations {
                let index = configuration.index();
                if 0.0 <= at.slack[index] && at.worst[index] <= self.best * (1.0 + 2.0 * WORTH) {
                    self.best = self.best.min(at.worst[index]);
                    let hold = Hold { worst: at.worst[index], configuration, roll: at.roll };
                    self.holds.push((hold, cost(at, index)));
                }
            }
        }
    }

    /// Divides the gaps of evenly spaced rolls, apart from the first and the last, where they may hide something better.
    fn divide(&mut self, at: &[AtRoll], depth: usize) {
        let mut gaps: Vec<(f64, usize)> = (1..at.len() - 2).map(|i| (self.least(&at[i - 1..i + 3]), i)).collect();
        gaps.sort_by(|one, other| one.0.total_cmp(&other.0));
        for (least, i) in gaps {
            if self.best * (1.0 - WORTH) <= least || least == f64::INFINITY {
                break;
            }
            let step = (at[i + 1].roll - at[i].roll).rem_euclid(TAU) / PARTS as f64;
            // One more on both sides, for their second differences.
            let rolls: [f64; PARTS + 3] = std::array::from_fn(|n| at[i].roll + (n as f64 - 1.0) * step);
            let mut inner = Vec::with_capacity(PARTS + 3);
            self.rolls.arm.at_rolls(&self.rolls.rolled_tool, self.point, &rolls, &mut inner);
            self.keep(&inner);
            if depth < DEPTH {
                self.divide(&inner, depth + 1);
            }
        }
    }

    /// What the middle gap of four rolls cannot be better than, as far as second differences tell; infinite where no
    /// configuration has room.
    fn least(&self, at: &[AtRoll]) -> f64 {
        let arm_is_smooth = smooth(at[1].wrist, at[2].wrist);
        let of_configuration = |configuration: &Configuration| {
            let index = configuration.index();
            let bend = |part: fn(&AtRoll) -> &[f64; Configuration::COUNT]| {
                let [a, b, c, d] = [0, 1, 2, 3].map(|i| part(&at[i])[index]);
                (a - 2.0 * b + c).abs().max((b - 2.0 * c + d).abs())
            };
            // A parabola gets an eighth of its second difference beyond both ends; twice as much is allowed, and for the
            // room, which is the least of several, all of it: two of them may cross.
            let room = |part: fn(&AtRoll) -> &[f64; Configuration::COUNT]| {
                part(&at[1])[index].max(part(&at[2])[index]) + bend(part)
            };
            if room(|at| &at.links) < 0.0 {
                return f64::INFINITY;
            }
            if !(arm_is_smooth && smooth(at[1].bent[index], at[2].bent[index])) {
                return 0.0;
            }
            if room(|at| &at.slack) < 0.0 {
                return f64::INFINITY;
            }
            let least = at[1].worst[index].min(at[2].worst[index]) - 0.25 * bend(|at| &at.worst);
            // Of postures in which nothing holds joint 2 nothing is known.
            if at.iter().any(|at| at.worst[index].is_nan()) { 0.0 } else { least }
        };
        self.rolls.configurations.iter().map(of_configuration).fold(f64::INFINITY, f64::min)
    }

    /// The equally good ones, after local descent from each valley over the rolls.
    fn descended(mut self) -> Vec<Hold> {
        self.holds.retain(|(hold, _)| hold.worst <= self.best * (1.0 + 2.0 * WORTH));
        self.holds.sort_by(|one, other| one.1.total_cmp(&other.1));
        let mut valleys: Vec<Hold> = Vec::new();
        for (hold, _) in &self.holds {
            let apart = |other: &Hold| ((one_turn(hold.roll - other.roll)).abs() * SCAN as f64) / TAU;
            if valleys.len() < MOST && valleys.iter().all(|known| 1.5 < apart(known)) {
                valleys.push(*hold);
            }
        }
        let ends: Vec<AtRoll> = valleys.into_iter().map(|hold| self.bottom(hold)).collect();
        self.keep(&ends);
        let mut holds: Vec<(Hold, f64)> = Vec::new();
        for at in &ends {
            let allowed = self.rolls.configurations.iter().filter(|it| 0.0 <= at.slack[it.index()]);
            let hold = |&configuration: &Configuration| Hold {
                worst: at.worst[configuration.index()],
                configuration,
                roll: one_turn(at.roll),
            };
            holds.extend(allowed.map(|it| (hold(it), cost(at, it.index()))));
        }
        holds.retain(|(hold, _)| hold.worst <= self.best * (1.0 + ROOM + EQUAL));
        let least = holds.iter().map(|(_, cost)| *cost).fold(f64::INFINITY, f64::min);
        holds.retain(|(_, cost)| *cost <= least * (1.0 + EQUAL));
        holds.into_iter().map(|(hold, _)| hold).collect()
    }

    /// The best allowed roll in the valley of a hold, to 1e-4 rad.
    fn bottom(&self, hold: Hold) -> AtRoll {
        const ROLLS: usize = PARTS + 2;
        let mut half = TAU / (SCAN * PARTS) as f64;
        let mut near = Vec::with_capacity(ROLLS);
        let (index, mut middle) = (hold.configuration.index(), hold.roll);
        // A flat valley may be wide; once round is the end.
        for _ in 0..2 * SCAN * PARTS {
            near.clear();
            let rolls: [f64; ROLLS] =
                std::array::from_fn(|n| middle + half * (n as f64 * 2.0 / (ROLLS - 1) as f64 - 1.0));
            self.rolls.arm.at_rolls(&self.rolls.rolled_tool, self.point, &rolls, &mut near);
            let cost = |n: usize| cost(&near[n], index);
            let least = (0..ROLLS).min_by(|a, b| cost(*a).total_cmp(&cost(*b))).expect("seven rolls");
            // On level ground nothing is gained by walking.
            let best = if cost(least) < cost(ROLLS / 2) * (1.0 - 1e-12) { least } else { ROLLS / 2 };
            if half < 1e-4 {
                return near[best];
            }
            middle = near[best].roll;
            if 0 < best && best < ROLLS - 1 {
                half *= 2.0 / (ROLLS - 1) as f64;
            }
        }
        near[ROLLS / 2]
    }
}

/// What is least at the roll that is reported: the deflection, and a little for what is missing of the most room; infinite where the
/// limits forbid it.
fn cost(at: &AtRoll, index: usize) -> f64 {
    // Room is given as differences of cosines, at most 2.
    let room = 0.5 * at.slack[index].min(2.0);
    if 0.0 <= room { at.worst[index] * (1.0 + ROOM * (1.0 - room)) } else { f64::INFINITY }
}

/// The same angle between a half turn back and a half turn on.
fn one_turn(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// Two vectors between which the direction does not turn far.
fn smooth([a, b]: [f64; 2], [c, d]: [f64; 2]) -> bool {
    SMOOTH * a.hypot(b) * c.hypot(d) <= a * c + b * d
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use crate::catalogue::{find, paper_robots};
    use crate::compliance::compliance;
    use crate::inverse::reached;
    use crate::load::Load;
    use crate::map::{Axis, Extent, HeldPosture, Map, MapOptions, ROLL_TOLERANCE, map};
    use crate::model::Model;
    use crate::robot::Robot;
    use crate::spatial::Pose;
    use nalgebra::{Matrix3, Rotation3, Vector3};

    /// The least deflection, m, over evenly spread rolls: every posture of each by the scalar verbs.
    fn by_brute_force(robot: &Robot, tool: &Pose, elevation: f64, [x, z]: [f64; 2], rolls: u32) -> f64 {
        let (s, c) = elevation.sin_cos();
        let (axis, up) = (Vector3::new(c, 0.0, s), Vector3::new(-s, 0.0, c));
        let unrolled = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[up, axis.cross(&up), axis]));
        let mut least = f64::INFINITY;
        for n in 0..rolls {
            let roll =
                Rotation3::from_axis_angle(&Vector3::z_axis(), f64::from(n) / f64::from(rolls) * std::f64::consts::TAU);
            let pose = Pose::from_parts(Vector3::new(x, 0.0, z).into(), (unrolled * roll).into());
            for (_, q) in reached(robot, &(pose * tool.inverse())) {
                let at = compliance(robot, &q, tool).unwrap();
                least = least.min(at.compliance.worst().0 * 1000.0);
            }
        }
        least
    }

    /// Everything of a map under 1 kN.
    struct Mapped {
        model: Model,
        options: MapOptions,
        map: Map,
    }

    impl Mapped {
        fn of(robot: &Robot, [x, z]: [Axis; 2], tool: &Pose, elevation: f64) -> Self {
            let model = Model::spatial(robot, tool).unwrap();
            let held = Some(HeldPosture { elevation, ..HeldPosture::TOOL_DOWN });
            let options = MapOptions { extent: Extent::Grid { x, z }, load: Load::PAPER, elbow: None, held };
            let map = map(&model, &options).unwrap();
            Self { model, options, map }
        }

        fn joints(&self, i: usize, j: usize) -> Option<[f64; 6]> {
            let held = self.options.held.unwrap();
            let Model::Spatial(model) = &self.model else { unreachable!("asked for") };
            let grid = &self.map.deflection;
            let way = self.map.space.as_ref().unwrap().at(i, j)?;
            crate::map::section::joints(model, (self.options.load, &held), way, [grid.x.at(i), grid.z.at(j)])
        }
    }

    #[test]
    fn a_roll_that_is_best_within_a_degree_only_where_joint_1_turns_fast_is_found() {
        let robot = find("TX2-160L").unwrap().robot();
        let tool = Pose::translation(0.08, -0.12, 0.2584);
        let (x, z) = (Axis { start: 0.3687, step: 0.01, count: 2 }, Axis { start: 0.2363, step: 0.01, count: 2 });
        let found = Mapped::of(&robot, [x, z], &tool, 0.0).map.deflection.get(0, 0).unwrap();
        assert!(found <= 0.4861e-3, "{found}");
        let least = by_brute_force(&robot, &tool, 0.0, [0.3687, 0.2363], 7200);
        assert!(found <= least * (1.0 + ROLL_TOLERANCE), "{found} {least}");
    }

    #[test]
    fn no_roll_is_better_than_the_best_and_its_posture_has_its_value() {
        let tools = [[0.08, -0.12, 0.2584], [0.3, 0.0, 0.1], [0.0, 0.05, 0.4], [-0.2, 0.2, 0.0]];
        let mut reached_by_some = 0;
        for (n, robot) in paper_robots().iter().enumerate().step_by(2) {
            let [x, y, z] = tools[n / 2 % 4];
            let tool = Pose::translation(x, y, z) * Pose::rotation(Vector3::new(0.0, 0.2 * n as f64, 0.0));
            let (x, z) = (Axis::between(0.5, 2.7, 4), Axis::between(0.1, 2.3, 4));
            let elevation = [-FRAC_PI_2, 0.0, -0.7][n / 2 % 3];
            let found = Mapped::of(robot, [x, z], &tool, elevation);
            for (i, j) in (0..16).map(|cell| (cell % 4, cell / 4)) {
                let least = by_brute_force(robot, &tool, elevation, [x.at(i), z.at(j)], 720);
                let worst = found.map.deflection.get(i, j).unwrap_or(f64::INFINITY);
                assert!(worst <= least * (1.0 + ROLL_TOLERANCE), "{} {i} {j}: {worst} {least}", robot.name);
                if let Some(q) = found.joints(i, j) {
                    reached_by_some += 1;
                    let expected = compliance(robot, &q, &tool).unwrap().compliance.worst().0 * 1000.0;
                    assert!((expected - worst).abs() <= 1e-6 * worst, "{} {i} {j}: {worst} {expected}", robot.name);
                }
            }
        }
        assert!(40 < reached_by_some, "{reached_by_some}");
    }

    #[test]
    fn neighbours_tell_margins_that_change_as_little_as_their_places() {
        let robot = find("TX2-160L").unwrap().robot();
        let (x, z) = (Axis { start: 0.7, step: 1e-4, count: 60 }, Axis { start: 0.6, step: 1e-4, count: 2 });
        let found = Mapped::of(&robot, [x, z], &Pose::translation(0.1, 0.0, 0.2), 0.0).map.space.unwrap();
        for map in [&found.limits, &found.singular] {
            let margins: Vec<f64> = map.row(0).map(Option::unwrap).collect();
            // Seven radians a metre and less: the posture of a point 0.1 mm away.
            assert!(margins.windows(2).all(|pair| (pair[0] - pair[1]).abs() < 7e-4), "{margins:?}");
        }
    }
}
