//! How much better could another place be? A lower bound by branch and bound over nodes, each held in one arm branch.

use std::f64::consts::TAU;

use super::Question;
use crate::batch::SpatialArm;
use crate::enclose::{
    Affine, ArmEnclosure, Line, Node, NodeBounds, ToolFrameEnclosure, TurnExtent, least_largest, remaining, variables,
};
use crate::frontier::{self, Frontier};
use crate::interval::Interval;
use crate::inverse::ArmBranch;
use crate::place::{Orientation, Within};
use crate::task::Zone;
use crate::tolerances;
use crate::watch::Stopped;
use crate::work::{Grid, WorkPlacement};

/// Relative distance between value and bound at which the proof is good enough: less than 1 % is stated.
const GAP: f64 = 0.0099;
/// Poses that are enclosed before the proof stops with the bound it has: about a second.
const MOST_POSES: usize = 400_000;
/// The same where no place is known: most zones that fit nowhere are soon proved not to, the others hardly ever.
const MOST_POSES_FOR_NONE: usize = 50_000;
/// Of nodes larger than this part of the upper arm only the extreme poses of the zone are enclosed.
const COARSE: f64 = 0.15;
/// Nodes among which those are chosen from which a place is searched once more, and how many are.
const MOST_UNFATHOMED: usize = 2000;
const RESTARTED: usize = 8;
/// Nodes of this size, m, are not split: a place is found no finer.
const SMALLEST: f64 = 2e-5;

/// What is proved.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Proof {
    /// No place has a smaller largest compliance, m/N; the value to be reached where there is no better place.
    pub(super) lower: f64,
    /// Nodes that were bounded.
    pub(super) boxes: usize,
    /// The middles of nodes that stand in the way of a better bound, the lowest first, apart from one another; none where every node was
    /// fathomed.
    pub(super) unfathomed: Vec<WorkPlacement>,
}

/// A node whose poses are held in one arm branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct HeldNode {
    lower: f64,
    pub(super) node: Node,
    pub(super) branch: ArmBranch,
    /// Which wrists are possible: not flipped, flipped.
    pub(super) wrists: [bool; 2],
    /// Bounded once more since it was last cut.
    is_whole: bool,
}

impl frontier::Node for HeldNode {
    fn key(&self) -> [f64; 2] {
        [self.lower, 0.0]
    }
}

/// What was proved of the places of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bound {
    /// There are none.
    None,
    /// No better than was asked: the node needs no splitting.
    Fathomed,
    /// No better than this, where they were not cut off.
    Unfathomed(f64),
}

/// What stays the same from node to node.
pub(super) struct BranchAndBound<'a> {
    pub(super) options: &'a Question<'a>,
    pub(super) enclosure: ArmEnclosure,
    /// Without limits: tells which poses are soft.
    pub(super) bare: SpatialArm,
    pub(super) freed: SpatialArm,
    wrists_are_alike: bool,
    /// Of nodes larger than that, m, only the extreme poses of the zone are enclosed.
    coarse: f64,
    /// Points of the zone, m from its centre, at which its poses are enclosed.
    pub(super) samples: Vec<[f64; 2]>,
    /// By how much each interval of a node moves the wrist centre at most: 1 for lengths, m/rad for turns.
    lever: [f64; 5],
    roots: Vec<Node>,
}

impl<'a> BranchAndBound<'a> {
    /// For the places that `region` and the options allow, at any bearing about the joint-1 axis or straight ahead alone, and at any roll of the tool
    /// or those that are asked for.
    pub(super) fn new(
        arm: &SpatialArm,
        zone: Zone,
        options: &'a Question<'a>,
        region: [Interval; 2],
        [turned, roll_is_free]: [bool; 2],
    ) -> Self {
        let [first, second] = zone.sides();
        let half = first.hypot(second) / 2.0;
        let tool = arm.flange_from_tool.translation.vector;
        let long = tool.z.abs() + arm.geometry.c4.abs() + tool.xy().norm();
        let enclosure = ArmEnclosure::new(arm, [turned, false, false, false, false, roll_is_free]).under(options.load);
        let lever = [1.0, 1.0, half + long, half, enclosure.beside_the_tool_axis() + 0.1];
        Self {
            options,
            enclosure,
            bare: arm.without_limits(),
            freed: arm.without_limit_on(0, turned).without_limit_on(5, roll_is_free),
            wrists_are_alike: arm.wrists_are_alike(),
            coarse: COARSE * arm.geometry.c2,
            samples: Grid::of(zone, if zone.is_round() { 8 } else { 4 }).points,
            lever,
            roots: roots(options, region, roll_is_free),
        }
    }

    /// Proves a lower bound up to `upper`, the best value that is known, m/N.
    pub(super) fn prove(&self, upper: f64) -> Result<Proof, Stopped> {
        match self.roots.iter().map(variables).max() {
            Some(2) => self.run::<2>(upper),
            Some(3) => self.run::<3>(upper),
            Some(4) => self.run::<4>(upper),
            _ => self.run::<5>(upper),
        }
    }

    fn run<const N: usize>(&self, upper: f64) -> Result<Proof, Stopped> {
        let enough = upper * (1.0 - GAP);
        let most = if upper.is_finite() { MOST_POSES } else { MOST_POSES_FOR_NONE };
        let (mut queue, mut boxes, mut poses) = (Frontier::new(), 0, 0);
        for node in &self.roots {
            for branch in ArmBranch::ALL {
                let wrists: &[[bool; 2]] =
                    if self.wrists_are_alike { &[[true; 2]] } else { &[[true, false], [false, true]] };
                queue.extend(wrists.iter().map(|&wrists| HeldNode {
                    lower: 0.0,
                    node: *node,
                    branch,
                    wrists,
                    is_whole: false,
                }));
            }
        }
        // The least bound of the fathomed nodes.
        let mut lower = upper;
        let mut unfathomed = Vec::new();
        while let Some(held) = queue.pop() {
            let is_small = self.size(&held) < SMALLEST;
            if most < poses || is_small && held.is_whole {
                lower = lower.min(held.lower);
                unfathomed = self.apart(held, queue);
                break;
            }
            let parts = if is_small { vec![held] } else { self.split(&held).to_vec() };
            for mut part in parts {
                self.options.parts.one_more()?;
                boxes += 1;
                match self.bound::<N>(&mut part, enough, &mut poses) {
                    Bound::None => {}
                    Bound::Fathomed => lower = lower.min(enough * (1.0 - tolerances::BOUND)),
                    Bound::Unfathomed(bound) => {
                        part.lower = held.lower.max(bound * (1.0 - tolerances::BOUND));
                        part.is_whole = is_small;
                        queue.push(part);
                    }
                }
            }
        }
        Ok(Proof { lower, boxes, unfathomed })
    }

    /// The middles of the lowest nodes that lie apart from one another.
    fn apart(&self, first: HeldNode, mut queue: Frontier<HeldNode>) -> Vec<WorkPlacement> {
        let mut chosen: Vec<[f64; 5]> = Vec::new();
        let mut next = Some(first);
        for _ in 0..MOST_UNFATHOMED {
            let Some(held) = next else { break };
            let at = held.node.map(Interval::middle);
            let moves = |other: &[f64; 5]| (0..5).map(|i| (at[i] - other[i]).abs() * self.lever[i]).fold(0.0, f64::max);
            if chosen.iter().all(|other| self.coarse < moves(other)) {
                chosen.push(at);
            }
            if chosen.len() == RESTARTED {
                break;
            }
            next = queue.pop();
        }
        chosen.into_iter().map(|[x, z, yaw, angle, roll]| WorkPlacement { x, y: 0.0, z, yaw, angle, roll }).collect()
    }

    /// How far the arm moves at most along one interval of a node, m.
    fn size(&self, held: &HeldNode) -> f64 {
        held.node.iter().zip(self.lever).map(|(range, lever)| range.width() * lever).fold(0.0, f64::max)
    }

    /// The two halves of a node across the interval that moves the arm most.
    fn split(&self, held: &HeldNode) -> [HeldNode; 2] {
        let moves = |i: &usize| held.node[*i].width() * self.lever[*i];
        let longest = (0..5).max_by(|a, b| moves(a).total_cmp(&moves(b))).expect("five sides");
        held.node[longest].halves().map(|half| {
            let mut part = *held;
            part.node[longest] = half;
            part
        })
    }

    /// A lower bound on every place of the node, no further than `enough`; cuts off the node what is no better than that.
    fn bound<const N: usize>(&self, held: &mut HeldNode, enough: f64, poses: &mut usize) -> Bound {
        let mut bounds = NodeBounds::default();
        let Some(best) = self.add_constraints::<N>(held, enough, &mut bounds, poses) else { return Bound::None };
        if enough <= best {
            return Bound::Fathomed;
        }
        let values: Vec<Line<N>> = bounds.values.iter().filter_map(Line::below).collect();
        let limits: Vec<Line<N>> = bounds.limits.iter().filter_map(Line::allowing).collect();
        let Some(part) = remaining(&values, &limits, enough) else { return Bound::Fathomed };
        cut(&mut held.node, &part);
        let within = |lines: Vec<Line<N>>| lines.into_iter().map(|line| line.within(&part)).collect::<Vec<_>>();
        let bound = best.max(least_largest(&within(values), &within(limits)));
        if enough <= bound { Bound::Fathomed } else { Bound::Unfathomed(bound) }
    }

    /// Adds the constraints of poses of the zone until the bound of one is `enough`, and gives the largest; `None` where no
    /// place of the node holds them.
    fn add_constraints<const N: usize>(
        &self,
        held: &mut HeldNode,
        enough: f64,
        bounds: &mut NodeBounds<N>,
        poses: &mut usize,
    ) -> Option<f64> {
        let tool_frame = self.enclosure.tool_frame::<N>(self.options.elevation, &held.node);
        self.add_window(&tool_frame, bounds)?;
        let branch = held.branch;
        let mut best = 0.0_f64;
        let centre = self.enclosure.add_constraints(&tool_frame, [0.0; 2], branch, None, &mut held.wrists, bounds)?;
        *poses += 1;
        let mut extent = TurnExtent::default();
        let order = if self.coarse < self.size(held) {
            self.extreme_poses(held).to_vec()
        } else {
            self.poses_worth_enclosing(held)
        };
        for at in order {
            *poses += 1;
            let from = bounds.values.len();
            let centre = centre.as_ref().map(|centre| (centre, &mut extent));
            self.enclosure.add_constraints(&tool_frame, self.samples[at], branch, centre, &mut held.wrists, bounds)?;
            best = bounds.values[from..].iter().map(Affine::min).fold(best, f64::max);
            if enough <= best {
                break;
            }
        }
        Some(best)
    }

    /// Adds that all of the zone lies in its window and clear of the robot's column; `None` where it does not for certain.
    fn add_window<const N: usize>(&self, tool_frame: &ToolFrameEnclosure<N>, bounds: &mut NodeBounds<N>) -> Option<()> {
        let Question { within: Within { x, z }, column, .. } = *self.options;
        for &at in &self.samples {
            let [px, py, pz] = tool_frame.plane.point(at);
            if 0.0 < column {
                let room = px.square() + py.square() + (2.0 * tolerances::PROOF * column - column * column);
                if room.min() < 0.0 {
                    bounds.require(room)?;
                }
            }
            for (part, range) in [(px, x), (pz, z)] {
                for room in [part + (tolerances::PROOF - range.min()), -part + (range.max() + tolerances::PROOF)] {
                    if room.min() < 0.0 {
                        bounds.require(room)?;
                    }
                }
            }
        }
        Some(())
    }
}

/// Leaves of a node the part in these ranges of its variables, each from -1 to 1.
fn cut<const N: usize>(node: &mut Node, part: &[Interval; N]) {
    let mut next = 2;
    for (i, range) in node.iter_mut().enumerate() {
        let variable = if i < 2 { i } else { next };
        if 2 <= i && range.width() == 0.0 {
            continue;
        }
        next += usize::from(2 <= i);
        let (middle, half, kept) = (range.middle(), range.width() / 2.0, part[variable]);
        *range = Interval::spanning(middle + half * kept.min(), middle + half * kept.max());
    }
}

/// Nodes that together hold every placement that is asked for.
fn roots(options: &Question, [x, z]: [Interval; 2], roll_is_free: bool) -> Vec<Node> {
    let zero = Interval::point(0.0);
    let angles = match options.orientation {
        Orientation::Free => vec![Interval::spanning(0.0, options.load.period_of_turns())],
        Orientation::Axes | Orientation::Fixed(_) => options.angles().into_iter().map(Interval::point).collect(),
    };
    let yaw = match options.yaw {
        _ if options.is_vertical() => zero,
        yaw if TAU < yaw.width() => Interval::spanning(0.0, TAU),
        yaw => yaw,
    };
    let roll = match options.roll {
        Some(roll) => Interval::point(roll),
        None if roll_is_free => zero,
        None => Interval::spanning(0.0, TAU),
    };
    angles.into_iter().map(|angle| [x, z, yaw, angle, roll]).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::inverse::Configuration;
    use crate::load::{Component, Load};
    use crate::model::Model;
    use crate::place::spatial::search::region;
    use crate::place::{Orientation, PlaceOptions, Placed, ToolOrientation, deflection_field, place};
    use crate::spatial::Pose;
    use crate::watch::Watch;
    use crate::work::WorkPlane;

    /// Zones, tools and what else is asked.
    fn typical() -> Vec<(Zone, Pose, PlaceOptions)> {
        let down =
            PlaceOptions { tool_orientation: Some(ToolOrientation::tool_down()), ..PlaceOptions::under(Load::UNIT) };
        let (tool, aside) = (Pose::translation(0.0, 0.0, 0.2), Pose::translation(0.1, 0.0, 0.2));
        let circle = Zone::Circle { diameter: 0.5 };
        let facing = ToolOrientation { yaw: Interval::point(0.0), ..ToolOrientation::tool_at(0.0) };
        vec![
            (circle, tool, down),
            (circle, aside, down),
            (
                Zone::Rectangle { width: 0.3, height: 0.6 },
                tool,
                PlaceOptions { orientation: Orientation::Free, ..down },
            ),
            (circle, tool, PlaceOptions { tool_orientation: Some(facing), ..down }),
        ]
    }

    #[test]
    fn the_paper_robots_typical_zones_are_proved_to_a_few_percent() {
        for (case, (zone, tool, options)) in typical().iter().enumerate() {
            for robot in paper_robots().iter().skip(case % 2).step_by(2) {
                let placed =
                    place(&Model::spatial(robot, tool).unwrap(), &(*zone).into(), options, Watch::nobody()).unwrap();
                let Placed::Feasible(best) = placed else { continue };
                let gap = 1.0 - best.lower_bound / best.deflection;
                // A wall is met by wrists that turn far: of one robot the proof gets no nearer.
                let most = if case < 3 { 0.05 } else { 0.3 };
                assert!((0.0..most).contains(&gap), "{case} {}: {gap}", robot.name);
            }
        }
    }

    /// Without the value that was found to stop at, the bound still keeps below it, and below every other place.
    #[test]
    fn no_place_lies_under_the_bound() {
        for (zone, tool, options) in typical() {
            for robot in paper_robots().iter().step_by(3) {
                let Model::Spatial(model) = Model::spatial(robot, &tool).unwrap() else { unreachable!("spatial") };
                let parts = Watch::nobody().parts(None);
                let question = Question::of(&model, &options, &parts).unwrap().expect("all of the window is left");
                let arm = SpatialArm::new(robot, &tool).unwrap();
                let roll_is_free = arm.tool_turns_about_axis_6();
                let region = region(&arm, question.within);
                let branch_and_bound =
                    BranchAndBound::new(&arm, zone, &question, region, [!options.load.breaks_symmetry(), roll_is_free]);
                let placed =
                    place(&Model::spatial(robot, &tool).unwrap(), &zone.into(), &options, Watch::nobody()).unwrap();
                let Some(best) = placed.feasible() else { continue };
                let hold = best.space().unwrap();
                let (worst, _) = compliance(robot, &hold.joints, &tool).unwrap().compliance.worst();
                let proof = branch_and_bound.prove(1.5 * best.deflection).unwrap();
                assert!(0.5 * worst < proof.lower && proof.lower <= worst, "{}: {proof:?} {worst}", robot.name);
            }
        }
    }

    /// Forces of known direction: what is reported is what the postures there have, and no other place lies under the bound.
    #[test]
    fn places_under_known_forces_are_proved_too() {
        let milling = Load::along_tool([300.0, 100.0, 50.0], None).unwrap();
        let fed = Load::along_tool([300.0, 100.0, 50.0], Some(0.3)).unwrap();
        let loads = [
            (milling, 0.1),
            (milling.counting(Component::Normal).with_cone(0.2).unwrap(), 0.4),
            (fed.with_cone(0.3).unwrap().counting(Component::Along), 0.1),
            (Load::along_base([0.0, 0.0, -500.0]).unwrap(), 0.1),
        ];
        let (zone, tool) = (Zone::Rectangle { width: 0.3, height: 0.2 }, Pose::translation(0.0, 0.0, 0.2));
        for (robot, (load, most)) in paper_robots().iter().step_by(2).zip(loads) {
            let model = Model::spatial(robot, &tool).unwrap();
            let options =
                PlaceOptions { tool_orientation: Some(ToolOrientation::tool_down()), ..PlaceOptions::under(load) };
            let best = place(&model, &zone.into(), &options, Watch::nobody()).unwrap().feasible().cloned().unwrap();
            let hold = best.space().unwrap();
            let gap = 1.0 - best.lower_bound / best.deflection;
            assert!((0.0..most).contains(&gap), "{} under {load:?}: {gap}", robot.name);
            assert!((hold.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{hold:?}");
            let side = |i: usize| i as f64 / 10.0 - 1.0;
            let points = (0..441).map(|i| zone.at([side(i % 21), side(i / 21)]));
            let field = deflection_field(&model, &options, &best, points).unwrap();
            let largest = field.iter().map(|point| point.deflection.unwrap()).fold(0.0, f64::max);
            assert!((largest - best.deflection).abs() <= 2e-3 * largest, "{}: {largest} {best:?}", robot.name);
            // Other places, held as any posture may: never under the bound.
            let mut rng = fastrand::Rng::with_seed(9);
            for _ in 0..300 {
                let (x, z, angle) = (0.6 + 2.0 * rng.f64(), 1.5 * rng.f64(), FRAC_PI_2 * f64::from(rng.u32(..4)));
                let work = WorkPlacement { x, y: 0.0, z, yaw: 0.0, angle, roll: 0.0 };
                let plane = WorkPlane::of(-FRAC_PI_2, &work);
                let forces = plane.forces(load).unwrap();
                let mut by_configuration = [Some(0.0_f64); Configuration::COUNT];
                for at in [[0.0, 0.0], [0.15, 0.1], [0.15, -0.1], [-0.15, 0.1], [-0.15, -0.1]] {
                    let held = crate::inverse::reached(robot, &(plane.pose(&work, at) * tool.inverse()));
                    for configuration in Configuration::ALL {
                        let found = held.iter().find(|(other, _)| *other == configuration).map(|(_, q)| {
                            let posture = compliance(robot, q, &tool).unwrap();
                            forces.largest(&posture.compliance.translation()).value * load.newtons()
                        });
                        let known = &mut by_configuration[configuration.index()];
                        *known = known.zip(found).map(|(known, found)| known.max(found));
                    }
                }
                for value in by_configuration.into_iter().flatten() {
                    assert!(best.lower_bound <= value, "{}: {} at {work:?}", robot.name, value);
                }
            }
        }
    }

    #[test]
    fn a_zone_that_is_too_large_is_proved_to_be() {
        let robot = &paper_robots()[0];
        let model = Model::spatial(robot, &Pose::identity()).unwrap();
        let options = PlaceOptions::under(Load::UNIT);
        let placed = place(&model, &Zone::Circle { diameter: 6.0 }.into(), &options, Watch::nobody()).unwrap();
        assert!(matches!(placed, Placed::Infeasible { is_proved: true, .. }), "{placed:?}");
    }
}
