//! What is said to be clear, against every node, every edge and many places between two samples, looked at one by one.

use std::sync::Arc;

use super::*;
use crate::catalogue::stl::Surface;
use crate::cell::{Block, Cell, Mount};
use crate::clearance::{Cutter, Link, Mesh, Obstacle, Surroundings, ThickArm};
use crate::cutting::Shank;
use crate::inverse::postures;
use crate::mill::contact::{Between, Bodies, LEAST, Posed, Way};
use crate::stock::{Remains, Stock};
use crate::toolpath::{Course, Given, MoveKind};

/// Places that are looked at between two samples.
const FINE: usize = 24;

fn block(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> Block {
    let side = |[low, high]: [f64; 2]| Interval::spanning(low, high);
    Block { x: side(x), y: side(y), z: side(z) }
}

fn clear_of(boxes: &[Block], clearance: f64) -> ClearOf {
    let mut cell = Cell::of(Mount::pedestal(0.0));
    cell.keep_out.iter_mut().zip(boxes).for_each(|(place, block)| *place = Some(*block));
    ClearOf { clearance, cell: Some(cell), floor: None, part: None, stock: None, fixture: None, cutter: None }
}

/// The first box that is kept free as the triangles of a part.
fn mesh_of(clear_of: &ClearOf, stand: &Stand) -> Mesh {
    let block = clear_of.cell.unwrap().keep_out[0].unwrap();
    let ends = [block.x, block.y, block.z].map(|side| [side.min(), side.max()]);
    box_mesh(ends, |at| stand.base_from_part.inverse_transform_point(&at))
}

/// The triangles of a box from end to end along every axis, its corners moved.
fn box_mesh(ends: [[f64; 2]; 3], moved: impl Fn(Point3<f64>) -> Point3<f64>) -> Mesh {
    let corner = |i: usize| moved(std::array::from_fn(|k| ends[k][i >> k & 1]).into()).into();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh::of(&Surface { corners: (0..8).map(corner).collect(), triangles, is_closed: true, notes: Vec::new() })
}

/// The distance of single postures, by another way through the library than paths take.
struct Witness<'a> {
    thick: ThickArm<'a>,
    about: Surroundings,
    stand: Stand,
    robot: &'a Robot,
}

impl<'a> Witness<'a> {
    fn new(robot: &'a Robot, stand: &Stand, clear_of: &ClearOf) -> Self {
        let thick = ThickArm::new(robot, &stand.flange_from_tool, None).unwrap();
        Self { thick, about: Surroundings::of(clear_of.cell.as_ref(), clear_of.floor), stand: *stand, robot }
    }

    /// `None` where it is not reached.
    fn distance(&self, pose: &ToolPose, at: Arrangement) -> Option<f64> {
        Some(self.thick.clearance(&[self.theta(pose, at)?], &self.about).unwrap().distance)
    }

    /// `None` where it is not reached.
    fn theta(&self, pose: &ToolPose, at: Arrangement) -> Option<[f64; 6]> {
        let crate::robot::Arm::SixAxis { geometry, .. } = &self.robot.arm else { unreachable!() };
        let tool = self.stand.base_from_part * part_from_tool(pose, at.roll).unwrap();
        let found = postures(geometry, &(tool * self.stand.flange_from_tool.inverse())).found;
        found.into_iter().find_map(|(known, theta)| (known == at.configuration).then_some(theta))
    }

    /// The same of wide bodies, by model angles.
    fn wide(&self, theta: &[f64; 6]) -> f64 {
        self.thick.clearance(&[*theta], &self.about).unwrap().wide.unwrap().distance
    }

    /// The least over a step.
    fn least(&self, ends: [(&ToolPose, Arrangement); 2]) -> Option<f64> {
        least_of(ends, |pose, at| self.distance(pose, at))
    }

    /// The same of wide bodies.
    fn least_wide(&self, ends: [(&ToolPose, Arrangement); 2]) -> Option<f64> {
        least_of(ends, |pose, at| Some(self.wide(&self.theta(pose, at)?)))
    }
}

/// The least of a distance over a step, its ends and all between; `None` where something of it is not reached.
fn least_of(
    ends: [(&ToolPose, Arrangement); 2],
    distance: impl Fn(&ToolPose, Arrangement) -> Option<f64>,
) -> Option<f64> {
    let [(from, first), (to, last)] = ends;
    let at = |i: usize| {
        let part = i as f64 / FINE as f64;
        let axis = (from.axis * (1.0 - part) + to.axis * part).normalize();
        let roll = first.roll + part * (last.roll - first.roll);
        let pose = ToolPose { tip: from.tip * (1.0 - part) + to.tip * part, axis };
        distance(&pose, Arrangement { roll, ..first })
    };
    (0..=FINE).map(at).try_fold(f64::INFINITY, |least, distance| Some(distance?.min(least)))
}

/// Boxes beside a line along which the rolls differ in what they touch.
fn worlds() -> Vec<ClearOf> {
    let beside = |y: f64| block([1.2, 2.6], [y, y + 0.4], [0.0, 3.0]);
    let post = |x: f64, y: f64| block([x, x + 0.01], [y, y + 0.01], [0.6, 1.1]);
    vec![
        clear_of(&[], 0.0),
        clear_of(&[beside(0.75)], 0.0),
        clear_of(&[beside(-0.7)], 0.05),
        clear_of(&[block([1.65, 1.7], [-3.0, 3.0], [1.05, 1.1])], 0.0),
        clear_of(&[post(1.5, 0.3), post(1.75, -0.15), post(1.65, 0.35)], 0.0),
        clear_of(&[post(1.35, 0.2), post(1.6, -0.1), post(1.85, 0.1)], 0.02),
    ]
}

/// The path of least error over a ladder, by every node and every edge looked at one by one and finely, and by those
/// alone that a best path takes. What is farther than the asked clearance by less than the least step may count either way, and counts as it is said.
#[test]
fn the_best_clear_path_over_a_ladder_is_that_of_every_node_and_edge() {
    const ROLLS: usize = 36;
    let (robot, one) = (robot(), stand());
    let coarse = Steps { longest: 0.1, ..Steps::USUAL };
    let stations = stations(&moves("line:0.5"), &coarse, |_| Some(KNOWN));
    let options = with(RollMode::Free);
    let arm = arm_with_margins(&robot, &one, &options).unwrap();
    let grid = RollGrid::turn(ROLLS);
    let every = Ladder::new(&arm, &stations, one, (ErrorPart::Total, grid), 0.8, Watch::nobody()).unwrap();
    assert!(every.rungs.iter().all(|rung| rung.samples.len() == 1), "a rung a sample: nodes are single postures");
    let climb = Climb::new(&every, Goal::LeastError, f32::MAX, false);
    let (best, unasked) = climb.path(Watch::nobody()).unwrap().expect("a path");
    // One world with a box in the wrist of the best path.
    let middle = every.rungs.len() / 2;
    let held = every.postures(every.rungs[middle].at, every.grid.roll(best[middle].roll));
    let q = held.into_iter().find(|(known, _)| known.index() == best[middle].configuration).expect("it is held").1;
    let crate::robot::Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!() };
    let flange = geometry.forward(&geometry.model_angles(&q, limits.third_axis)).translation.vector;
    let side = |i: usize, aside: f64| [flange[i] + aside - 0.01, flange[i] + aside + 0.01];
    let beside = |aside: f64| clear_of(&[block(side(0, aside), side(1, -aside), side(2, 0.0))], 0.0);
    let (mut blocked_nodes, mut blocked_edges, mut led_aside) = (0, 0, 0);
    for clear_of in worlds().into_iter().chain([beside(0.08), beside(-0.08)]) {
        let options = MillOptions { clear_of: Some(clear_of.clone()), ..options.clone() };
        let question = Question { robot: &robot, arm: &arm, stations: &stations, options: &options };
        let guard = question.guard(&one, Bodies::Known).unwrap();
        let witness = Witness::new(&robot, &one, &clear_of);
        let mut ladder = every.clone();
        let at = |held: usize| Arrangement {
            configuration: Configuration::ALL[held / ROLLS],
            roll: ladder.grid.roll(held % ROLLS),
        };
        let pose = |k: usize| &stations[ladder.rungs[k].at].sample.pose;
        let agreed = |least: Option<f64>, touches: bool| {
            let least = least.expect("it is reached");
            let asked = clear_of.clearance;
            // No touch is missed, and none is reported of what is farther than is asked by more than the least step.
            assert!(touches || asked - 1e-9 <= least, "{least} of {asked} is missed");
            assert!(!touches || least < asked + LEAST, "{least} of {asked} is no touch");
            !touches
        };
        let held = |k: usize| {
            let errors = &ladder.rungs[k].errors;
            (0..8 * ROLLS).filter(|held| errors[held / ROLLS][held % ROLLS] < f32::INFINITY).collect::<Vec<_>>()
        };
        // The best value of every node, of least error and of least motion, and its joints.
        let mut last: Vec<(usize, f64)> = Vec::new();
        for k in 0..ladder.rungs.len() {
            let mut next = Vec::new();
            for node in held(k) {
                let touches = ladder.touch_within(&guard, k, at(node)).unwrap().is_some();
                if !agreed(witness.distance(pose(k), at(node)), touches) {
                    blocked_nodes += 1;
                    continue;
                }
                let error = f64::from(ladder.rungs[k].errors[node / ROLLS][node % ROLLS]);
                let mut best = if k == 0 { error } else { f64::INFINITY };
                for (from, value) in &last {
                    let apart = (from % ROLLS).abs_diff(node % ROLLS);
                    let is_near = from / ROLLS == node / ROLLS && apart.min(ROLLS - apart) <= 8;
                    if !is_near || !climb.joins((k - 1, at(*from)), (k, at(node))) {
                        continue;
                    }
                    let mut to = at(node);
                    to.roll += std::f64::consts::TAU * ((at(*from).roll - to.roll) / std::f64::consts::TAU).round();
                    let touches = ladder.touch_from(&guard, k, at(*from), at(node)).unwrap().is_some();
                    if agreed(witness.least([(pose(k - 1), at(*from)), (pose(k), to)]), touches) {
                        best = best.min(value.max(error));
                    } else {
                        blocked_edges += 1;
                    }
                }
                if best < f64::INFINITY {
                    next.push((node, best));
                }
            }
            last = next;
        }
        let expected = last.iter().map(|(_, value)| *value).fold(f64::INFINITY, f64::min);
        let found = ladder.clear_path(Some(&guard), (Goal::LeastError, f32::MAX, false), Watch::nobody()).unwrap();
        let Ok((nodes, value)) = found else {
            assert!(expected == f64::INFINITY, "{expected}");
            continue;
        };
        assert!((value / expected - 1.0).abs() < 1e-9, "{value} {expected}");
        led_aside += usize::from(unasked < value * (1.0 - 1e-6));
        // What was blocked is given back, and the path of before found again.
        ladder.unblock();
        let again = ladder.clear_path(None, (Goal::LeastError, f32::MAX, false), Watch::nobody()).unwrap();
        assert_eq!(again.unwrap().1, unasked);
        assert_eq!(nodes.len(), ladder.rungs.len());
    }
    assert!(100 < blocked_nodes && 3 <= blocked_edges && 1 <= led_aside, "{blocked_nodes} {blocked_edges} {led_aside}");
}

/// Ten thousand steps by chance beside boxes by chance, many of them with an asked clearance that their ends keep and what is between does not: where a fine subdivision
/// finds a touch, the rule finds one, and where all is far from one, it finds none.
#[test]
fn no_touch_between_two_samples_is_missed() {
    let (robot, mut one) = (robot(), stand());
    one.base_from_part = Pose::identity();
    let mut rng = fastrand::Rng::with_seed(391);
    let arm = arm_with_margins(&robot, &one, &with(RollMode::Free)).unwrap();
    let (mut steps, mut between, mut clear) = (0, 0, 0);
    let stations = path("line:0.1", KNOWN);
    while steps < 10_000 {
        let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
        let tip = Vector3::new(part(1.0, 2.2), part(-0.8, 0.8), part(0.2, 1.5));
        let centre = tip + Vector3::from_fn(|_, _| part(-0.5, 0.5));
        let half = part(0.002, 0.1);
        let side = |i: usize| [centre[i] - half, centre[i] + half];
        let about = clear_of(&[block(side(0), side(1), side(2))], 0.0);
        let witness = Witness::new(&robot, &one, &about);
        for _ in 0..20 {
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let axis = Vector3::new(part(-0.6, 0.6), part(-0.6, 0.6), 1.0);
            let from = ToolPose { tip: tip + Vector3::from_fn(|_, _| part(-0.1, 0.1)), axis: axis.normalize() };
            let moved = Vector3::from_fn(|_, _| part(-0.05, 0.05));
            let turned = axis + Vector3::new(part(-0.1, 0.1), part(-0.1, 0.1), 0.0);
            let to = ToolPose { tip: from.tip + moved, axis: turned.normalize() };
            let roll = part(-3.0, 3.0);
            let rolls = [roll, roll + part(-0.3, 0.3)];
            let share = part(0.0, 1.0);
            let configuration = Configuration::ALL[rng.usize(0..8)];
            let at = |roll: f64| Arrangement { configuration, roll };
            let ends = [(from, rolls[0]), (to, rolls[1])];
            let Some(least) = witness.least([(&from, at(rolls[0])), (&to, at(rolls[1]))]) else { continue };
            let of_ends = ends.map(|(pose, roll)| witness.distance(&pose, at(roll)).expect("both are reached"));
            let nearer = of_ends[0].min(of_ends[1]);
            // Where it comes nearer in between than at the ends, what is asked lies between these two.
            let clearance = if least < nearer { least + share * (nearer - least) } else { nearer * share };
            if !(0.0 <= clearance) {
                continue;
            }
            let options =
                MillOptions { clear_of: Some(ClearOf { clearance, ..about.clone() }), ..with(RollMode::Free) };
            let question = Question { robot: &robot, arm: &arm, stations: &stations, options: &options };
            let guard = question.guard(&one, Bodies::Known).unwrap();
            let held = ends.map(|(pose, roll)| guard.theta(1, &pose, at(roll)).unwrap().expect("it is reached"));
            // As paths are followed: clear of straight postures, and no joint turns far.
            let is_followed = held.iter().all(|theta| 0.05 < arm.geometry.singular_margin(theta))
                && (0..6).all(|i| crate::angle::wrapped(held[1][i] - held[0][i]).abs() < 0.5);
            let [first, last]: [Posed; 2] = held.map(|theta| guard.posed(theta, 0));
            if !is_followed || guard.touches(&first) || guard.touches(&last) {
                continue;
            }
            steps += 1;
            let way = Way::Straight { line: 1, configuration, ends };
            let found = guard.between((&way, 0), [&first, &last]).unwrap();
            let is_free = matches!(found, Between::Free);
            if least < clearance {
                assert!(!is_free, "{least} of {clearance}: {from:?} {to:?} {rolls:?}");
                between += 1;
            }
            // Between the places of the subdivision it may come nearer by what it moves there: some mm.
            if clearance + 5e-3 < least {
                assert!(is_free, "{least} of {clearance}: {found:?}");
                clear += 1;
            }
        }
    }
    assert!(200 < between && 1000 < clear, "{between} {clear}");
}

/// No point of what a joint moves is farther from its axis than is said, at postures by chance.
#[test]
fn what_hangs_on_a_joint_is_no_farther_from_its_axis_than_is_said() {
    let (robot, one) = (robot(), stand());
    let crate::robot::Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!() };
    let farthest = ThickArm::new(&robot, &one.flange_from_tool, None).unwrap().farthest(0.0);
    let mut rng = fastrand::Rng::with_seed(392);
    let mut most = [0.0_f64; 6];
    for _ in 0..2000 {
        let theta: [f64; 6] = std::array::from_fn(|_| 6.3 * (rng.f64() - 0.5));
        let tip = (geometry.forward(&theta) * one.flange_from_tool).translation.vector;
        let flange = geometry.forward(&theta).translation.vector;
        for (i, (axis, through)) in geometry.axes(&theta).into_iter().enumerate() {
            for point in [tip, flange] {
                most[i] = most[i].max((point - through).cross(&axis).norm());
            }
        }
    }
    for i in 0..6 {
        // The radii of the capsules are some decimetres; links by chance are seldom all stretched out.
        assert!(most[i] < farthest[i] && farthest[i] < 1.3 * most[i] + 0.4, "{i}: {} {}", most[i], farthest[i]);
    }
}

/// A box stands where the spindle would turn: another roll is taken, and nothing is touched. Where it leaves no roll, the path of before is
/// returned with what it touches. By hand: tools that stand upright in a floor that is raised.
#[test]
fn a_path_is_led_clear_where_it_can_be_and_tells_what_it_touches_where_not() {
    let (robot, one) = (robot(), stand());
    let stations = path("line:0.2", KNOWN);
    let before = followed(&one, &stations, &with(RollMode::Free));
    assert_eq!(before.clearance, None);
    let tell = |clear_of: ClearOf, roll: RollMode| {
        let found = followed(&one, &stations, &MillOptions { clear_of: Some(clear_of), ..with(roll) });
        let clearance = found.clearance.clone().expect("it was asked");
        (found, clearance)
    };
    // With nothing about, all stays as it was.
    let (found, clearance) = tell(clear_of(&[], 0.0), RollMode::Free);
    assert_eq!((found.samples, &clearance.contacts), (before.samples.clone(), &Vec::new()));
    // A box that reaches 20 mm into the wrist of the middle sample of the best constant roll, from one side or the other.
    let constant = followed(&one, &stations, &with(RollMode::Constant));
    let crate::robot::Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!() };
    let joints = constant.samples[stations.len() / 2].joints;
    let flange = geometry.forward(&geometry.model_angles(&joints, limits.third_axis)).translation.vector;
    let tip = one.base_from_part * Point3::from(stations[stations.len() / 2].sample.pose.tip);
    let away = Vector3::z().cross(&(flange - tip.coords)).normalize();
    let there = [1.0, -1.0].map(|which| {
        let centre = flange + away * (which * (robot.thickness().0.wrist - 0.02));
        let side = |i: usize| [centre[i] - 0.01, centre[i] + 0.01];
        clear_of(&[block(side(0), side(1), side(2))], 0.01)
    });
    let there = there.into_iter().find(|there| tell(there.clone(), RollMode::Constant).1.contacts.is_empty());
    let there = there.expect("a side from which another roll leads");
    for roll in [RollMode::Free, RollMode::Constant, RollMode::Linear] {
        let (found, clearance) = tell(there.clone(), roll);
        assert!(
            clearance.contacts.is_empty() && 0.01 <= clearance.nearest.unwrap().distance,
            "{roll:?}: {clearance:?}"
        );
        assert!(before.lower_bound * (1.0 - 1e-9) <= found.worst.0 && found.lower_bound <= found.worst.0);
        let witness = Witness::new(&robot, &one, &there);
        for i in 1..stations.len() {
            let end = |i: usize| (&stations[i].sample.pose, found.samples[i].arrangement);
            assert!(0.01 <= witness.least([end(i - 1), end(i)]).unwrap(), "{roll:?}: {i}");
        }
        // Every station tells the distance of its own posture.
        assert_eq!(clearance.at.len(), stations.len());
        for (i, near) in clearance.at.iter().enumerate() {
            let known = witness.distance(&stations[i].sample.pose, found.samples[i].arrangement).unwrap();
            assert!((near.unwrap().distance - known).abs() < 1e-9, "{roll:?}: {i}");
        }
    }
    // The roll of before touches it, and says where.
    let at = constant.samples[0].arrangement.roll;
    let (_, clearance) = tell(there.clone(), RollMode::Fixed(at));
    let deepest =
        |clearance: &PathClearance| *clearance.contacts.iter().max_by(|a, b| a.depth.total_cmp(&b.depth)).unwrap();
    let contact = deepest(&clearance);
    assert_eq!(contact.to, Obstacle::KeepOut(1), "{contact:?}");
    assert!(0.01 < contact.depth, "{contact:?}");
    assert!((clearance.nearest.unwrap().distance - (0.01 - contact.depth)).abs() < 1e-12);
    // The same box as the triangles of a part touches as deep, and the same ways are clear of it.
    let as_part =
        ClearOf { part: Some(mesh_of(&there, &one)), cell: Some(Cell::of(Mount::pedestal(0.0))), ..there.clone() };
    let (_, of_part) = tell(as_part.clone(), RollMode::Fixed(at));
    let of_part = deepest(&of_part);
    assert_eq!((of_part.to, of_part.link, of_part.station), (Obstacle::Part, contact.link, contact.station));
    assert!((of_part.depth - contact.depth).abs() < 1e-6, "{of_part:?} {contact:?}");
    let (_, clearance) = tell(as_part, RollMode::Constant);
    assert!(clearance.contacts.is_empty() && 0.01 <= clearance.nearest.unwrap().distance, "{clearance:?}");
    // A floor above the tip: no roll helps, and all of the path touches.
    let flooded =
        ClearOf { clearance: 0.0, cell: None, floor: Some(0.65), part: None, stock: None, fixture: None, cutter: None };
    let (found, clearance) = tell(flooded, RollMode::Free);
    assert!(found.worst.0 <= before.worst.0 * (1.0 + 1e-9) && found.touches());
    // By hand: the upper arm reaches down from the joint-2 axis by its radius, at every sample.
    let contact = deepest(&clearance);
    assert!(
        clearance.contacts.len() == 1 && contact.to == Obstacle::Floor && contact.link == Link::UpperArm,
        "{clearance:?}"
    );
    let by_hand = 0.65 - (geometry.c1 - robot.thickness().0.upper_arm);
    assert!((contact.depth - by_hand).abs() < 1e-9, "{} {by_hand}", contact.depth);
    assert!((clearance.nearest.unwrap().distance + contact.depth).abs() < 1e-12);
    // One inside of which nine arms in ten lie by its own.
    let wide = clearance.nearest.unwrap().wide.unwrap();
    let t = robot.payload_kg.unwrap().powf(0.125) * robot.reach.unwrap().sqrt();
    let wide_by_hand = geometry.c1 - 0.165 * t - 0.65;
    assert!((wide.distance - wide_by_hand).abs() < 1e-9 && wide.link == Link::UpperArm, "{wide:?} {wide_by_hand}");
    // And so it does at whatever roll; where some path is clear nothing is unavoidable.
    let unavoidable = clearance.unavoidable.unwrap();
    assert!((unavoidable.depth - by_hand).abs() < 1e-9 && unavoidable.to == Obstacle::Floor, "{unavoidable:?}");
    assert!(tell(there, RollMode::Free).1.unavoidable.is_none());
}

/// Boxes about the flange of a path that looks at nothing, which wide bodies touch: where a path is reported to be clear of them, many
/// places between its samples are; where not, the path is the one that the slim links alone have.
#[test]
fn a_path_is_sought_that_wide_bodies_keep_clear_of() {
    let (robot, one) = (robot(), stand());
    let stations = path("line:0.3", KNOWN);
    let before = followed(&one, &stations, &with(RollMode::Free));
    let crate::robot::Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!() };
    let theta = |joints: &[f64; 6]| geometry.model_angles(joints, limits.third_axis);
    let flange = geometry.forward(&theta(&before.samples[stations.len() / 2].joints)).translation.vector;
    let asked = 0.01;
    let (mut led_aside, mut given_up) = (0, 0);
    let about_flange = [[0.0, 0.0, 0.35], [0.35, 0.0, 0.0], [0.0, 0.35, 0.0], [-0.3, 0.0, 0.2]];
    let about_flange = about_flange.map(|aside| flange + Vector3::from(aside));
    // Beside the shoulder, whatever the roll.
    let beside_shoulder = Vector3::new(geometry.a1, 0.45, geometry.c1 + 0.2);
    for at in about_flange.into_iter().chain([beside_shoulder]) {
        let side = |i: usize| [at[i] - 0.01, at[i] + 0.01];
        let about = clear_of(&[block(side(0), side(1), side(2))], asked);
        let options = MillOptions { clear_of: Some(about.clone()), ..with(RollMode::Free) };
        let found = followed(&one, &stations, &options);
        let clearance = found.clearance.as_ref().unwrap();
        let wide = clearance.nearest.unwrap().wide.unwrap();
        let witness = Witness::new(&robot, &one, &about);
        let ends = |i: usize| [i - 1, i].map(|i| (&stations[i].sample.pose, found.samples[i].arrangement));
        let least = (1..stations.len()).map(|i| witness.least_wide(ends(i)).unwrap()).fold(f64::INFINITY, f64::min);
        let before_is =
            before.samples.iter().map(|one| witness.wide(&theta(&one.joints))).fold(f64::INFINITY, f64::min);
        assert!(before_is < asked, "{before_is}");
        // Nothing between the samples is nearer than is reported, but for what the rule of steps may deny.
        assert!((wide.distance - least).abs() < LEAST, "{} {least}", wide.distance);
        assert!(found.lower_bound <= found.worst.0 && clearance.contacts.is_empty());
        if asked <= wide.distance {
            assert!(asked - 1e-9 <= least, "{least}");
            led_aside += 1;
        } else {
            let question = Question {
                robot: &robot,
                arm: &arm_with_margins(&robot, &one, &options).unwrap(),
                stations: &stations,
                options: &options,
            };
            let Milled::Followed(slim) = question.milled(&one, ROLLS[0], Watch::nobody()).unwrap().1 else { panic!() };
            assert_eq!(slim.samples, found.samples);
            given_up += 1;
        }
    }
    assert!(0 < led_aside && 0 < given_up, "{led_aside} {given_up}");
}

/// By hand: the spindle ends 40 mm above the tip. 20 mm deep it runs 20 mm above the block; 45 mm deep it would be 5 mm in it, and runs 15 mm
/// above what the way before has left of a block that is narrower than the mill. In a wider one the walls of the slot stand.
#[test]
fn a_block_stands_in_the_way_until_it_is_cut() {
    const R: f64 = 0.025;
    let robot = robot();
    // The spindle on axis 6: straight down at the block.
    let stand = Stand {
        base_from_part: Pose::new(Vector3::new(1.7, 0.0, 0.6), Vector3::zeros()),
        flange_from_tool: Pose::translation(0.0, 0.0, 0.4),
    };
    let shallow = [-0.02, -0.045];
    let tell = |depths: &[f64], width: f64, cutter: Option<f64>| {
        let mut tips = Vec::new();
        for z in depths {
            tips.extend([[-0.15, 0.0, 0.1], [-0.15, 0.0, *z], [0.15, 0.0, *z], [0.15, 0.0, 0.1]]);
        }
        let upright = |tip: [f64; 3]| ToolPose { tip: tip.into(), axis: Vector3::z() };
        let straight = |ends: &[[f64; 3]]| Move {
            line: 0,
            kind: MoveKind::Feed,
            from: upright(ends[0]),
            to: upright(ends[1]),
            course: Course::Line,
            feed: Some(0.02),
            normals: None,
            given: Given::default(),
        };
        let moves: Vec<Move> = tips.windows(2).map(straight).collect();
        let mut stock = Stock::block([-0.1, -width / 2.0, -0.06], [0.1, width / 2.0, 0.0], 1e-3).unwrap();
        stock.follow(&moves, &Steps::USUAL, R, &mut |_, _| (), Watch::nobody()).unwrap();
        let stations = stations(&moves, &Steps::USUAL, |_| None);
        let stock = Some(Arc::new(Remains::of(&stock)));
        let cell = Some(Cell::of(Mount::pedestal(0.0)));
        let cutter = cutter.map(|length| Cutter { length, radius: R, shank: None });
        let about = ClearOf { clearance: 0.0, cell, floor: None, part: None, stock, fixture: None, cutter };
        let options = MillOptions { clear_of: Some(about), ..with(RollMode::Fixed(0.0)) };
        let Milled::Followed(found) = mill(&robot, &stand, &stations, &options, Watch::nobody()).unwrap() else {
            panic!("{depths:?}")
        };
        (found.clearance.unwrap(), stations)
    };
    let (clearance, stations) = tell(&shallow, 0.04, Some(0.04));
    assert!(clearance.contacts.is_empty(), "{:?}", clearance.contacts);
    let nearest = clearance.nearest.unwrap();
    assert_eq!((nearest.link, nearest.to), (Link::Tool, Obstacle::Stock));
    // The first way is 20 mm above it, the second one 15; half a cell's diagonal is no matter of heights.
    assert!((nearest.distance - 0.015).abs() < 1e-6, "{nearest:?}");
    let first = stations.iter().position(|station| 0.01 < station.sample.pose.tip.x && station.sample.pose.tip.z < 0.0);
    assert!((clearance.at[first.unwrap()].unwrap().distance - 0.02).abs() < 1e-6);
    // At once so deep, and in another order, the spindle runs into it.
    for depths in [&[-0.045][..], &[-0.045, -0.02]] {
        let (clearance, stations) = tell(depths, 0.04, Some(0.04));
        let contact = clearance.contacts[0];
        assert_eq!((contact.link, contact.to), (Link::Tool, Obstacle::Stock));
        assert!(stations[contact.station].sample.pose.tip.z < -0.04, "{contact:?}");
        let deepest = clearance.contacts.iter().map(|contact| contact.depth).fold(0.0, f64::max);
        assert!((deepest - 0.005).abs() < 1e-5, "{:?}", clearance.contacts);
    }
    // The walls beside a slot.
    let (clearance, stations) = tell(&shallow, 0.1, Some(0.04));
    let contact = clearance.contacts[0];
    assert!(contact.to == Obstacle::Stock && stations[contact.station].sample.pose.tip.z < -0.04, "{contact:?}");
    // A cutter of which it is not known where it ends touches what it likes.
    assert!(tell(&shallow, 0.1, None).0.contacts.iter().all(|contact| contact.to != Obstacle::Stock));
}

/// By hand: a cutter of 25 mm radius passes 5 mm beside a clamp, 40 mm below it ends the spindle, and a clamp that is higher than that touches it.
/// The same triangles as a part may be touched by the cutter.
#[test]
fn the_cutter_keeps_clear_of_a_fixture_and_not_of_the_part() {
    const R: f64 = 0.025;
    let stand = Stand {
        base_from_part: Pose::new(Vector3::new(1.7, 0.0, 0.6), Vector3::zeros()),
        flange_from_tool: Pose::translation(0.0, 0.0, 0.4),
    };
    let stations = path("line:0.3", KNOWN);
    let tell_with = |high: f64, beside: f64, is_part: bool, (radius, shank): (f64, Option<Shank>)| {
        let mesh = Some(box_mesh([[-0.02, 0.02], [R + beside, R + beside + 0.05], [-0.1, high]], |at| at));
        let (part, fixture) = if is_part { (mesh, None) } else { (None, mesh) };
        let cell = Some(Cell::of(Mount::pedestal(0.0)));
        let cutter = Some(Cutter { length: 0.04, radius, shank });
        let about = ClearOf { clearance: 0.0, cell, floor: None, part, stock: None, fixture, cutter };
        let options = MillOptions { clear_of: Some(about), ..with(RollMode::Fixed(0.0)) };
        followed(&stand, &stations, &options).clearance.unwrap()
    };
    let tell = |high: f64, beside: f64, is_part: bool, radius: f64| tell_with(high, beside, is_part, (radius, None));
    // Higher than the tip, lower than the spindle: beside it by 5 mm, and where it is nearer by so much less, 3 mm deep.
    let beside = tell(0.01, 0.005, false, R);
    let nearest = beside.nearest.unwrap();
    assert!(
        beside.contacts.is_empty() && (nearest.link, nearest.to) == (Link::Cutter, Obstacle::Fixture),
        "{nearest:?}"
    );
    assert!((nearest.distance - 0.005).abs() < 1e-6, "{nearest:?}");
    let deep = tell(0.01, -0.003, false, R);
    assert!(deep.contacts.iter().all(|contact| (contact.link, contact.to) == (Link::Cutter, Obstacle::Fixture)));
    assert!((deep.nearest.unwrap().distance + 0.003).abs() < 1e-6, "{:?}", deep.contacts);
    // Its axis alone is 22 mm away, and a part may be touched.
    assert!((tell(0.01, -0.003, false, 0.0).nearest.unwrap().distance - 0.022).abs() < 1e-6);
    assert!((tell(0.01, -0.003, true, R).nearest.unwrap().distance - 0.03).abs() < 1e-6, "the spindle ends above it");
    // The spindle is thicker: it ends 10 mm below the top of this one.
    let high = tell(0.05, 0.005, false, R);
    assert!((high.nearest.unwrap().distance + 0.01).abs() < 1e-5, "{:?}", high.nearest);
    assert!(high.contacts.iter().any(|contact| contact.to == Obstacle::Fixture && contact.link == Link::Tool));
    // A shank 10 mm thicker than the cutter, 20 mm above the tip: 10 mm above what reaches up 10 mm, and 5 mm in what reaches up 30 mm, be it clamp or
    // part.
    let thick = Some(Shank { flute: 0.02, diameter: 2.0 * R + 0.02 });
    let low = tell_with(0.01, 0.005, true, (R, thick));
    assert!((low.nearest.unwrap().distance - 0.01).abs() < 1e-6, "{:?}", low.nearest);
    for is_part in [false, true] {
        let nearest = tell_with(0.03, 0.005, is_part, (R, thick)).nearest.unwrap();
        assert!((nearest.distance + 0.005).abs() < 1e-5 && nearest.link == Link::Shank, "{nearest:?}");
    }
    // One as thick as the cutter passes where that does.
    let slim = Some(Shank { flute: 0.02, diameter: 2.0 * R });
    assert_eq!(tell_with(0.03, 0.005, true, (R, slim)).nearest, tell(0.03, 0.005, true, R).nearest);
}

/// Nothing keeps a metre from the floor: the path that touches nothing is returned, with what is nearer than was asked.
#[test]
fn where_too_much_is_asked_the_best_that_touches_nothing_is_returned() {
    let (one, stations) = (stand(), path("line:0.3", KNOWN));
    let tell = |clearance: f64| {
        let about = clear_of(&[block([1.3, 1.36], [0.2, 0.26], [1.0, 1.06])], clearance);
        followed(&one, &stations, &MillOptions { clear_of: Some(about), ..with(RollMode::Constant) })
    };
    let (free, asked) = (tell(0.0), tell(1.0));
    assert_eq!(free.samples, asked.samples);
    let [free, asked] = [free, asked].map(|found| found.clearance.unwrap());
    assert!(free.contacts.is_empty(), "{:?}", free.contacts);
    assert!(!asked.contacts.is_empty());
    let least = asked.contacts.iter().map(|contact| asked.asked - contact.depth).fold(f64::INFINITY, f64::min);
    assert!(0.0 <= least && (least - free.nearest.unwrap().distance).abs() < 1e-12, "{least}");
}

/// By hand: the axis of a cutter of 25 mm radius runs through a post of 2 mm between two samples, whatever the roll.
#[test]
fn what_a_round_tool_touches_between_samples_is_touched_at_every_roll() {
    const R: f64 = 0.025;
    let stand = Stand {
        base_from_part: Pose::new(Vector3::new(1.7, 0.0, 0.6), Vector3::zeros()),
        flange_from_tool: Pose::translation(0.0, 0.0, 0.4),
    };
    let steps = Steps { longest: 0.1, ..Steps::USUAL };
    let stations = stations(&moves("line:0.4"), &steps, |_| Some(KNOWN));
    let middle = f64::midpoint(stations[1].sample.pose.tip.x, stations[2].sample.pose.tip.x);
    let ends = [[middle - 0.001, middle + 0.001], [-0.001, 0.001], [-0.01, 0.038]];
    let about = ClearOf {
        fixture: Some(box_mesh(ends, |at| at)),
        cutter: Some(Cutter { length: 0.04, radius: R, shank: None }),
        ..clear_of(&[], 0.0)
    };
    let found = followed(&stand, &stations, &MillOptions { clear_of: Some(about), ..with(RollMode::Free) });
    let clearance = found.clearance.unwrap();
    let unavoidable = clearance.unavoidable.expect("no roll avoids it");
    // Of 32 places between two samples 0.1 m apart one is nearer to the middle than 3.2 mm.
    assert!(unavoidable.station == 2 && unavoidable.link == Link::Cutter, "{unavoidable:?}");
    assert!((R - 0.0033..=R + 1e-6).contains(&unavoidable.depth), "{unavoidable:?}");
    assert!((clearance.nearest.unwrap().distance + unavoidable.depth).abs() < 1e-3, "{:?}", clearance.nearest);
}

/// A spindle across axis 6 that stands on its own axis.
fn round() -> Stand {
    Stand {
        base_from_part: Pose::new(Vector3::new(1.7, 0.0, 0.8), Vector3::z() * 0.3),
        flange_from_tool: Pose::new(Vector3::new(0.25, 0.0, 0.0), Vector3::y() * std::f64::consts::FRAC_PI_2),
    }
}

/// Boxes by chance about a spindle that leans as it goes: what is looked at of it without the arm is what the whole arm has, at every sample and
/// at many places between.
#[test]
fn a_round_tool_is_as_near_as_the_whole_arm_has_it() {
    let (robot, one) = (robot(), round());
    let lean = |x: f64, y: f64| Vector3::new(x, y, 1.0).normalize();
    let tips = [
        ([-0.2, 0.0, 0.0], lean(0.0, 0.0)),
        ([0.1, 0.1, 0.05], lean(0.3, -0.2)),
        ([0.1, 0.1, 0.05], lean(-0.1, 0.0)),
        ([0.2, -0.1, 0.0], lean(0.0, 0.1)),
    ];
    let poses = tips.map(|(tip, axis)| ToolPose { tip: tip.into(), axis });
    let leaning = |ends: &[ToolPose]| Move {
        line: 0,
        kind: MoveKind::Feed,
        from: ends[0],
        to: ends[1],
        course: Course::Line,
        feed: Some(0.02),
        normals: None,
        given: Given::default(),
    };
    let mut moves: Vec<Move> = poses.windows(2).map(leaning).collect();
    // Where it turns in place it takes the time that it needs.
    (moves[1].kind, moves[1].feed) = (MoveKind::Rapid, None);
    let coarse = Steps { longest: 0.1, turn: 0.2, ..Steps::USUAL };
    let stations = stations(&moves, &coarse, |_| Some(KNOWN));
    let mut rng = fastrand::Rng::with_seed(40);
    let (mut clear, mut at_samples, mut between) = (0, 0, 0);
    for _ in 0..120 {
        let i = rng.usize(1..stations.len());
        let [from, to] = [i - 1, i].map(|i| (one.base_from_part * Point3::from(stations[i].sample.pose.tip)).coords);
        let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
        let (mut half, clearance) = (part(0.002, 0.02), part(0.0, 0.01));
        // Beside the middle of a way, where many a tool touches that does not at its ends.
        let [first, last] = [i - 1, i].map(|i| one.base_from_part.rotation * stations[i].sample.pose.axis);
        // Where it turns, beside the plane in which it does.
        let turns = 0.1 < first.angle(&last);
        let aside = if turns { first.cross(&last) } else { (to - from).cross(&Vector3::z()) };
        let Some(aside) = aside.try_normalize(1e-9) else { continue };
        let mut beyond = part(-0.01, 0.03);
        if turns {
            (half, beyond) = (half / 20.0, beyond / 20.0);
        }
        let far = robot.thickness().0.spindle() + half + clearance + beyond;
        let aside = aside * far + (first + last).normalize() * part(0.1, 0.25);
        let centre = (from + to) / 2.0 + aside;
        let side = |i: usize| [centre[i] - half, centre[i] + half];
        let about = clear_of(&[block(side(0), side(1), side(2))], clearance);
        let witness = Witness::new(&robot, &one, &about);
        let options = MillOptions { clear_of: Some(about), ..with(RollMode::Constant) };
        let found = followed(&one, &stations, &options);
        let answer = found.clearance.unwrap();
        let mut touches_between = false;
        for (i, near) in answer.at.iter().enumerate() {
            let end = |i: usize| (&stations[i].sample.pose, found.samples[i].arrangement);
            let near = near.unwrap().distance;
            let known = witness.distance(end(i).0, end(i).1).unwrap();
            let is_on_way = near < known - 1e-9;
            assert!(near < known + 1e-9, "{near} {known}");
            if let Some(before) = i.checked_sub(1) {
                let least = witness.least([end(before), end(i)]).unwrap();
                let nearer = near.min(answer.at[before].unwrap().distance);
                assert!(
                    clearance - 1e-9 <= least || nearer < clearance + 1e-4,
                    "{i}: {least} of {clearance} is missed"
                );
                // Between places of the subdivision it moves by some mm.
                assert!(!is_on_way || (least - near).abs() < 5e-3, "{i}: {least} {near}");
            }
            touches_between |= is_on_way;
        }
        match (answer.contacts.is_empty(), touches_between) {
            (true, _) => clear += 1,
            (_, true) => between += 1,
            _ => at_samples += 1,
        }
        // Of the whole path the roll changes nothing of what the tool touches.
        for contact in answer.contacts.iter().filter(|contact| contact.link == Link::Tool) {
            assert!(contact.depth <= answer.unavoidable.unwrap().depth);
        }
    }
    assert!(10 < clear && 3 < between && 20 < at_samples, "{clear} {between} {at_samples}");
}

/// A tool that runs into a post at every roll hides nothing of the arm: a box in the wrist of the best path is led around all the same.
#[test]
fn the_arm_is_led_aside_where_the_tool_touches_at_every_roll() {
    let (robot, one) = (robot(), round());
    let stations = path("line:0.2", KNOWN);
    let crate::robot::Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!() };
    let before = followed(&one, &stations, &with(RollMode::Free));
    let joints = before.samples[stations.len() / 2].joints;
    let wrist = Vector3::from(geometry.points(&geometry.model_angles(&joints, limits.third_axis))[3]);
    let about = |at: Vector3<f64>| {
        let side = |i: usize| [at[i] - 0.01, at[i] + 0.01];
        block(side(0), side(1), side(2))
    };
    let tip = (one.base_from_part * Point3::from(stations[stations.len() / 2].sample.pose.tip)).coords;
    // In the axis of the spindle, 150 mm above the tip.
    let post = about(tip + Vector3::z() * 0.15);
    let tell = |boxes: &[Block]| {
        let options = MillOptions { clear_of: Some(clear_of(boxes, 0.0)), ..with(RollMode::Free) };
        followed(&one, &stations, &options)
    };
    let clear = tell(&[about(wrist)]);
    assert!(!clear.touches() && clear.samples != before.samples, "{:?}", clear.clearance);
    let touching = tell(&[about(wrist), post]);
    assert_eq!(touching.samples, clear.samples);
    let clearance = touching.clearance.unwrap();
    assert!(!clearance.contacts.is_empty());
    assert!(clearance.contacts.iter().all(|contact| (contact.link, contact.to) == (Link::Tool, Obstacle::KeepOut(2))));
    assert!((clearance.unavoidable.unwrap().depth + clearance.nearest.unwrap().distance).abs() < 1e-12);
}

/// By hand: a cutter passes a tenth of a millimetre beside a clamp all along it. That is no touch, and its distance is reported
/// exactly; three hundredths are one.
#[test]
fn a_gap_of_a_tenth_of_a_millimetre_is_a_gap() {
    const R: f64 = 0.025;
    let stations = path("line:0.3", KNOWN);
    let tell = |gap: f64| {
        let about = ClearOf {
            fixture: Some(box_mesh([[-0.1, 0.1], [R + gap, R + gap + 0.05], [-0.1, 0.01]], |at| at)),
            cutter: Some(Cutter { length: 0.04, radius: R, shank: None }),
            ..clear_of(&[], 0.0)
        };
        let options = MillOptions { clear_of: Some(about), ..with(RollMode::Free) };
        followed(&round(), &stations, &options).clearance.unwrap()
    };
    let clearance = tell(1e-4);
    let nearest = clearance.nearest.unwrap();
    assert!(clearance.contacts.is_empty() && (nearest.distance - 1e-4).abs() < 1e-7, "{clearance:?}");
    let clearance = tell(3e-5);
    assert!(clearance.contacts.iter().all(|contact| contact.link == Link::Cutter) && !clearance.contacts.is_empty());
}
