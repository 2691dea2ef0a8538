//! No place is better than this: branch and bound over boxes of stands, each held in one way.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Question;
use super::mix::{Line, least_largest, remaining};
use crate::interval::Interval;
use crate::place::{Orientation, Within};
use crate::space::{
    Affine, Aim, CLASSES, Enclosing, Grid, Known, Near, Patch, SpatialArm, Spread, Stand, StandBox, Way, middle,
    variables,
};
use crate::task::Zone;

/// Relative distance between value and bound at which the proof is good enough: less than 1 % is told.
const GAP: f64 = 0.0099;
/// Poses of boxes that are enclosed before the proof stops as far as it is: about a second.
const MOST_POSES: usize = 400_000;
/// The same where no place is known: most zones that fit nowhere are soon proved not to, the others hardly ever.
const MOST_POSES_FOR_NONE: usize = 50_000;
/// Poses of a box at which it gives way most in the middle, and which are enclosed.
const SOFTEST: usize = 4;
/// Poses of a box that a limit forbids in the middle, and which are enclosed.
const FORBIDDEN: usize = 3;
/// Boxes larger than this part of the upper arm are not worth the softest poses and those that a limit forbids.
const COARSE: f64 = 0.15;
/// Boxes of this size, m, are not split: a place is found no finer.
const SMALLEST: f64 = 2e-5;
/// Relative allowance for the rounding of a bound.
const ROUNDING: f64 = 1e-9;
/// What a zone may stand outside its window by, m: more than a place is granted.
const OUTSIDE: f64 = 2e-9;

/// What is proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Proof {
    /// No place has a smaller largest compliance, m/N; the value to be reached where there is no better place.
    pub(super) lower: f64,
    /// Boxes that were looked at.
    pub(super) boxes: usize,
    /// The middle of the box that stands in the way of a better proof.
    pub(super) open: Option<Stand>,
}

/// A set of stands, held in one way.
#[derive(Clone, Copy, Debug)]
struct Node {
    lower: f64,
    stands: StandBox,
    way: usize,
    /// Not flipped, flipped.
    wrists: [bool; 2],
    /// Looked at once more since something was cut off it.
    is_whole: bool,
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Node {}
impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Node {
    /// The heap hands out the greatest first: the least lower bound.
    fn cmp(&self, other: &Self) -> Ordering {
        other.lower.total_cmp(&self.lower)
    }
}

/// What is known of the places of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bound {
    /// There are none.
    None,
    /// No better than was asked.
    Enough,
    /// No better than this, where they were not cut off.
    Open(f64),
}

/// What stays the same from box to box.
pub(super) struct Prover<'a> {
    options: &'a Question,
    enclosing: Enclosing,
    /// Without limits, to see which poses are soft.
    bare: SpatialArm,
    freed: SpatialArm,
    wrists_are_alike: bool,
    /// Of boxes larger than that, m, only the extremes of the zone are looked at.
    coarse: f64,
    /// Poses at which every place is judged.
    samples: Vec<[f64; 2]>,
    /// Of every turn, how far it moves the wrist centre in the zone, m/rad; 1 for lengths.
    lever: [f64; 5],
    roots: Vec<StandBox>,
}

impl<'a> Prover<'a> {
    /// For the places that `region` and the options allow.
    pub(super) fn new(
        arm: &SpatialArm,
        zone: Zone,
        options: &'a Question,
        region: [Interval; 2],
        roll_is_free: bool,
    ) -> Self {
        let [first, second] = zone.sides();
        let half = first.hypot(second) / 2.0;
        let tool = arm.flange_from_tool.translation.vector;
        let long = tool.z.abs() + arm.geometry.c4.abs() + tool.xy().norm();
        let enclosing = Enclosing::new(arm, [true, false, false, false, false, roll_is_free]);
        let lever = [1.0, 1.0, half + long, half, enclosing.beside_the_tool_axis() + 0.1];
        Self {
            options,
            enclosing,
            bare: arm.without_limits(),
            freed: arm.without_limit_on(0, true).without_limit_on(5, roll_is_free),
            wrists_are_alike: arm.wrists_are_alike(),
            coarse: COARSE * arm.geometry.c2,
            samples: Grid::of(zone, if matches!(zone, Zone::Circle { .. }) { 8 } else { 4 }).points,
            lever,
            roots: roots(zone, options, region, roll_is_free),
        }
    }

    /// Proves a lower bound up to `upper`, the best value that is known, m/N.
    pub(super) fn prove(&self, upper: f64) -> Proof {
        match self.roots.iter().map(variables).max() {
            Some(2) => self.run::<2>(upper),
            Some(3) => self.run::<3>(upper),
            Some(4) => self.run::<4>(upper),
            _ => self.run::<5>(upper),
        }
    }

    fn run<const N: usize>(&self, upper: f64) -> Proof {
        let enough = upper * (1.0 - GAP);
        let most = if upper.is_finite() { MOST_POSES } else { MOST_POSES_FOR_NONE };
        let (mut queue, mut boxes, mut poses) = (BinaryHeap::new(), 0, 0);
        for stands in &self.roots {
            for way in 0..Way::ALL.len() {
                let wrists: &[[bool; 2]] =
                    if self.wrists_are_alike { &[[true; 2]] } else { &[[true, false], [false, true]] };
                queue.extend(wrists.iter().map(|&wrists| Node {
                    lower: 0.0,
                    stands: *stands,
                    way,
                    wrists,
                    is_whole: false,
                }));
            }
        }
        // The least bound of the boxes that are good enough.
        let mut lower = upper;
        let mut open = None;
        while let Some(node) = queue.pop() {
            let is_small = self.size(&node) < SMALLEST;
            if most < poses || is_small && node.is_whole {
                lower = lower.min(node.lower);
                open = Some(middle(&node.stands));
                break;
            }
            let parts = if is_small { vec![node] } else { self.split(&node).to_vec() };
            for mut part in parts {
                boxes += 1;
                match self.bound::<N>(&mut part, enough, &mut poses) {
                    Bound::None => {}
                    Bound::Enough => lower = lower.min(enough * (1.0 - ROUNDING)),
                    Bound::Open(bound) => {
                        part.lower = node.lower.max(bound * (1.0 - ROUNDING));
                        part.is_whole = is_small;
                        queue.push(part);
                    }
                }
            }
        }
        Proof { lower, boxes, open }
    }

    /// How far the arm moves at most along one side of a box, m.
    fn size(&self, node: &Node) -> f64 {
        node.stands.iter().zip(self.lever).map(|(range, lever)| range.width() * lever).fold(0.0, f64::max)
    }

    /// The two halves of a box across the side that moves the arm most.
    fn split(&self, node: &Node) -> [Node; 2] {
        let moves = |i: &usize| node.stands[*i].width() * self.lever[*i];
        let longest = (0..5).max_by(|a, b| moves(a).total_cmp(&moves(b))).expect("five sides");
        let range = node.stands[longest];
        let mut halves = [*node; 2];
        halves[0].stands[longest] = Interval::spanning(range.min(), range.middle());
        halves[1].stands[longest] = Interval::spanning(range.middle(), range.max());
        halves
    }

    /// A lower bound on every place of the box, no further than `enough`; what is no better than that is cut off the box.
    fn bound<const N: usize>(&self, node: &mut Node, enough: f64, poses: &mut usize) -> Bound {
        let mut known = Known::default();
        let Some(best) = self.learn::<N>(node, enough, &mut known, poses) else { return Bound::None };
        if enough <= best {
            return Bound::Enough;
        }
        let values: Vec<Line<N>> = known.values.iter().filter_map(Line::below).collect();
        let limits: Vec<Line<N>> = known.limits.iter().filter_map(Line::allowing).collect();
        let Some(part) = remaining(&values, &limits, enough) else { return Bound::Enough };
        cut(&mut node.stands, &part);
        let within = |lines: Vec<Line<N>>| lines.into_iter().map(|line| line.within(&part)).collect::<Vec<_>>();
        let bound = best.max(least_largest(&within(values), &within(limits)));
        if enough <= bound { Bound::Enough } else { Bound::Open(bound) }
    }

    /// Learns from the poses of the zone until their values are `enough`, and tells the largest; `None` where no place of the
    /// box holds them.
    fn learn<const N: usize>(
        &self,
        node: &mut Node,
        enough: f64,
        known: &mut Known<N>,
        poses: &mut usize,
    ) -> Option<f64> {
        let aim = self.enclosing.aim::<N>(self.options.elevation, &node.stands);
        self.stand_within(&aim, known)?;
        let way = Way::ALL[node.way];
        let mut best = 0.0_f64;
        let size = self.size(node);
        let wrists = &mut node.wrists;
        let centre = self.enclosing.learn(&aim, [0.0; 2], way, None, wrists, known)?;
        *poses += 1;
        let mut spread = Spread::default();
        let order = if self.coarse < size {
            self.extremes(&node.stands, node.way).to_vec()
        } else {
            self.order(&node.stands, node.way, *wrists)
        };
        for at in order {
            *poses += 1;
            let from = known.values.len();
            let centre = centre.as_ref().map(|centre| (centre, &mut spread));
            self.enclosing.learn(&aim, self.samples[at], way, centre, wrists, known)?;
            best = known.values[from..].iter().map(Affine::min).fold(best, f64::max);
            if enough <= best {
                break;
            }
        }
        Some(best)
    }

    /// All of the zone in its window.
    fn stand_within<const N: usize>(&self, aim: &Aim<N>, known: &mut Known<N>) -> Option<()> {
        let Within { x, z } = self.options.within;
        for &at in &self.samples {
            let [px, _, pz] = aim.stands.point(at);
            for (part, range) in [(px, x), (pz, z)] {
                for room in [part + (OUTSIDE - range.min()), -part + (range.max() + OUTSIDE)] {
                    if room.min() < 0.0 {
                        known.require(room)?;
                    }
                }
            }
        }
        Some(())
    }

    /// The poses of the zone with the wrist centre nearest to the joint-2 axis, and farthest from it.
    fn extremes(&self, stands: &StandBox, way: usize) -> [usize; 2] {
        let stand = middle(stands);
        let patch = Patch::of(self.options.elevation, &stand);
        let distance = |at: &[f64; 2]| self.enclosing.distance(&patch, &patch.point(&stand, *at), Way::ALL[way]);
        let distances: Vec<f64> = self.samples.iter().map(distance).collect();
        let by_distance = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
        let all = || 0..self.samples.len();
        [all().min_by(by_distance).expect("poses"), all().max_by(by_distance).expect("poses")]
    }

    /// The poses worth enclosing: the nearest and the farthest, which limits forbid first, then the softest.
    fn order(&self, stands: &StandBox, way: usize, wrists: [bool; 2]) -> Vec<usize> {
        let stand = middle(stands);
        let patch = Patch::of(self.options.elevation, &stand);
        let points: Vec<_> = self.samples.iter().map(|&at| patch.point(&stand, at)).collect();
        let all = || 0..points.len();
        let mut order = self.extremes(stands, way).to_vec();
        let columns = [0, 1, 2].map(|i| points.iter().map(|point| point[i]).collect::<Vec<f64>>());
        let values = |arm: &SpatialArm, near: &Near| {
            let mut classes = vec![0.0; CLASSES * points.len()];
            let mut rows = classes.chunks_exact_mut(points.len());
            let into = std::array::from_fn(|_| rows.next().expect("one row per class"));
            let columns = columns.each_ref().map(Vec::as_slice);
            arm.classes_at(&arm.orientation(patch.tool()), near, columns, into);
            let mut of_way = classes.chunks_exact(points.len()).skip(2 * way);
            [of_way.next().expect("no flip").to_vec(), of_way.next().expect("flip").to_vec()]
        };
        let allowed = values(&self.freed, &self.freed.near(&patch.pose(&stand, [0.0; 2]))[0]);
        for of_wrist in allowed.iter().zip(wrists).filter_map(|(values, asked)| asked.then_some(values)) {
            let forbidden: Vec<usize> = all().filter(|&i| !of_wrist[i].is_finite()).collect();
            let taken = FORBIDDEN.min(forbidden.len());
            for at in (0..taken).map(|part| forbidden[part * forbidden.len() / taken]) {
                if !order.contains(&at) {
                    order.push(at);
                }
            }
        }
        let [no_flip, flip] = values(&self.bare, &Near::default());
        let row = if wrists[0] { no_flip } else { flip };
        let mut soft: Vec<usize> = all().filter(|&i| row[i].is_finite()).collect();
        soft.sort_by(|&a, &b| row[b].total_cmp(&row[a]));
        for i in soft.into_iter().take(SOFTEST) {
            if !order.contains(&i) {
                order.push(i);
            }
        }
        order
    }
}

/// Leaves of a box the part that lies in these ranges of its variables, each from -1 to 1.
fn cut<const N: usize>(stands: &mut StandBox, part: &[Interval; N]) {
    let mut next = 2;
    for (i, range) in stands.iter_mut().enumerate() {
        let variable = if i < 2 { i } else { next };
        if 2 <= i && range.width() == 0.0 {
            continue;
        }
        next += usize::from(2 <= i);
        let (middle, half, kept) = (range.middle(), range.width() / 2.0, part[variable]);
        *range = Interval::spanning(middle + half * kept.min(), middle + half * kept.max());
    }
}

/// Boxes that hold every stand that is asked for.
fn roots(zone: Zone, options: &Question, [x, z]: [Interval; 2], roll_is_free: bool) -> Vec<StandBox> {
    let is_circle = matches!(zone, Zone::Circle { .. });
    let zero = Interval::point(0.0);
    let angles = match options.orientation {
        _ if is_circle => vec![zero],
        Orientation::Axes => vec![zero, Interval::point(FRAC_PI_2)],
        Orientation::Fixed(angle) => vec![Interval::point(angle)],
        Orientation::Free => vec![Interval::spanning(0.0, PI)],
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
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::load::Load;
    use crate::model::Model;
    use crate::place::spatial::search::region;
    use crate::place::{Orientation, PlaceOptions, Placed, Stance, place};
    use crate::spatial::Pose;

    /// Zones, tools and what else is asked.
    fn typical() -> Vec<(Zone, Pose, PlaceOptions)> {
        let down = PlaceOptions { stance: Some(Stance::tool_down()), ..PlaceOptions::under(Load::UNIT) };
        let (tool, aside) = (Pose::translation(0.0, 0.0, 0.2), Pose::translation(0.1, 0.0, 0.2));
        let circle = Zone::Circle { diameter: 0.5 };
        let facing = Stance { yaw: Interval::point(0.0), ..Stance::tool_at(0.0) };
        vec![
            (circle, tool, down),
            (circle, aside, down),
            (
                Zone::Rectangle { width: 0.3, height: 0.6 },
                tool,
                PlaceOptions { orientation: Orientation::Free, ..down },
            ),
            (circle, tool, PlaceOptions { stance: Some(facing), ..down }),
        ]
    }

    #[test]
    fn the_paper_robots_typical_zones_are_proved_to_a_few_percent() {
        for (case, (zone, tool, options)) in typical().iter().enumerate() {
            for robot in paper_robots() {
                let placed = place(&Model::spatial(&robot, tool).unwrap(), *zone, options).unwrap();
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
            let question = Question::of(&options).unwrap();
            for robot in paper_robots().iter().step_by(3) {
                let arm = SpatialArm::new(robot, &tool).unwrap();
                let roll_is_free = arm.tool_turns_about_axis_6();
                let region = region(&arm, question.within);
                let prover = Prover::new(&arm, zone, &question, region, roll_is_free);
                let placed = place(&Model::spatial(robot, &tool).unwrap(), zone, &options).unwrap();
                let Some(hold) = placed.feasible().map(|best| (best.deflection, best.space().unwrap().clone())) else {
                    continue;
                };
                let (worst, _) = compliance(robot, &hold.1.joints, &tool).unwrap().compliance.worst();
                let proof = prover.prove(1.5 * hold.0);
                assert!(0.5 * worst < proof.lower && proof.lower <= worst, "{}: {proof:?} {worst}", robot.name);
            }
        }
    }

    #[test]
    fn a_zone_that_is_too_large_is_proved_to_be() {
        let robot = &paper_robots()[0];
        let model = Model::spatial(robot, &Pose::identity()).unwrap();
        let options = PlaceOptions::under(Load::UNIT);
        let placed = place(&model, Zone::Circle { diameter: 6.0 }, &options).unwrap();
        assert!(matches!(placed, Placed::Infeasible { is_proved: true, .. }), "{placed:?}");
    }
}
