//! No place is better than this: branch and bound over boxes of stands, each held in one way.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::SpatialOptions;
use super::mix::least_largest;
use crate::limits::Range;
use crate::place::{Orientation, Within};
use crate::space::{
    Affine, Aim, CLASSES, Enclosing, Grid, Known, Near, Patch, SpatialArm, Stand, StandBox, Way, middle, variables,
};
use crate::task::Zone;

/// Relative distance between value and bound at which the proof is good enough.
const GAP: f64 = 0.01;
/// Poses of boxes that are enclosed before the proof stops as far as it is: about a second.
const MOST_POSES: usize = 200_000;
/// The same where no place is known: most zones that fit nowhere are soon proved not to, the others hardly ever.
const MOST_POSES_FOR_NONE: usize = 50_000;
/// Poses of a box at which it gives way most in the middle, and which are enclosed.
const SOFTEST: usize = 4;
/// Poses of a box that a limit forbids in the middle, and which are enclosed.
const FORBIDDEN: usize = 3;
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

/// What stays the same from box to box.
pub(super) struct Prover<'a> {
    options: &'a SpatialOptions,
    enclosing: Enclosing,
    /// Without limits, to see which poses are soft.
    bare: SpatialArm,
    freed: SpatialArm,
    wrists_are_alike: bool,
    /// Poses at which every place is judged: the rim and the centre of the zone.
    samples: Vec<[f64; 2]>,
    /// Of every turn, how far it moves the wrist centre in the zone, m/rad; 1 for lengths.
    lever: [f64; 5],
    roots: Vec<StandBox>,
}

impl<'a> Prover<'a> {
    /// For the places that `region` and the options allow; `freed` is without the limits that turning zone or tool meets.
    pub(super) fn new(
        freed: &SpatialArm,
        zone: Zone,
        options: &'a SpatialOptions,
        region: [Range; 2],
        roll_is_free: bool,
    ) -> Self {
        let [first, second] = zone.sides();
        let half = first.hypot(second) / 2.0;
        let tool = freed.flange_from_tool.translation.vector;
        let long = tool.z.abs() + freed.geometry.c4.abs() + tool.xy().norm();
        Self {
            options,
            enclosing: Enclosing::new(freed.clone()),
            bare: freed.without_limits(),
            freed: freed.clone(),
            wrists_are_alike: freed.wrists_are_alike(),
            samples: rim(zone),
            lever: [1.0, 1.0, half + long, half, tool.xy().norm() + 0.1],
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
                queue.extend(wrists.iter().map(|&wrists| Node { lower: 0.0, stands: *stands, way, wrists }));
            }
        }
        // The least bound of the boxes that are good enough.
        let mut lower = upper;
        let mut open = None;
        while let Some(node) = queue.pop() {
            if most < poses || self.size(&node) < SMALLEST {
                lower = lower.min(node.lower);
                open = Some(middle(&node.stands));
                break;
            }
            for mut half in self.split(&node) {
                boxes += 1;
                if let Some(bound) = self.bound::<N>(&mut half, enough, &mut poses) {
                    half.lower = node.lower.max(bound * (1.0 - ROUNDING));
                    if half.lower < enough {
                        queue.push(half);
                    } else {
                        lower = lower.min(half.lower);
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
        halves[0].stands[longest] = Range::spanning(range.min(), range.middle());
        halves[1].stands[longest] = Range::spanning(range.middle(), range.max());
        halves
    }

    /// A lower bound on every place of the box, no further than `enough`; `None` where there is none.
    fn bound<const N: usize>(&self, node: &mut Node, enough: f64, poses: &mut usize) -> Option<f64> {
        let elevation = self.options.elevation;
        let aim = self.enclosing.aim::<N>(elevation, &node.stands);
        let mut known = Known::default();
        self.stand_within(&aim, &mut known)?;
        let way = Way::ALL[node.way];
        let mut best = 0.0_f64;
        let wrists = &mut node.wrists;
        let centre = self.enclosing.learn(&aim, [0.0; 2], way, None, wrists, &mut known)?;
        *poses += 1;
        for at in self.order(&node.stands, node.way, *wrists) {
            *poses += 1;
            let from = known.values.len();
            self.enclosing.learn(&aim, self.samples[at], way, centre.as_ref(), wrists, &mut known)?;
            best = known.values[from..].iter().map(Affine::min).fold(best, f64::max);
            if enough <= best {
                return Some(best);
            }
        }
        Some(best.max(least_largest(&known.values, &known.limits)))
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

    /// The poses worth enclosing: the nearest and the farthest, which limits forbid first, then the softest.
    fn order(&self, stands: &StandBox, way: usize, wrists: [bool; 2]) -> Vec<usize> {
        let stand = middle(stands);
        let patch = Patch::of(self.options.elevation, &stand);
        let points: Vec<_> = self.samples.iter().map(|&at| patch.point(&stand, at)).collect();
        let distances: Vec<f64> =
            points.iter().map(|point| self.enclosing.distance(&patch, point, Way::ALL[way])).collect();
        let by_distance = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
        let all = || 0..points.len();
        let mut order = vec![all().min_by(by_distance).expect("poses"), all().max_by(by_distance).expect("poses")];
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
        let allowed = values(&self.freed, &self.freed.near(&patch.pose(&stand, [0.0; 2])));
        let forbidden: Vec<usize> =
            all().filter(|&i| (0..2).all(|w| !wrists[w] || !allowed[w][i].is_finite())).collect();
        for part in 0..FORBIDDEN.min(forbidden.len()) {
            order.push(forbidden[part * forbidden.len() / FORBIDDEN.min(forbidden.len())]);
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

/// The rim of a zone and its centre, at poses that every place is judged at.
fn rim(zone: Zone) -> Vec<[f64; 2]> {
    let is_circle = matches!(zone, Zone::Circle { .. });
    let [first, second] = zone.sides().map(|side| side / 2.0 * (1.0 - 1e-9));
    let mut points = Grid::of(zone, if is_circle { 8 } else { 4 }).points;
    points.retain(|&[u, v]| match zone {
        Zone::Circle { .. } => first <= u.hypot(v) || [u, v] == [0.0; 2],
        Zone::Rectangle { .. } => first <= u.abs() || second <= v.abs() || [u, v] == [0.0; 2],
    });
    points
}

/// Boxes that hold every stand that is asked for.
fn roots(zone: Zone, options: &SpatialOptions, [x, z]: [Range; 2], roll_is_free: bool) -> Vec<StandBox> {
    let is_circle = matches!(zone, Zone::Circle { .. });
    let zero = Range::point(0.0);
    let angles = match options.orientation {
        _ if is_circle => vec![zero],
        Orientation::Axes => vec![zero, Range::point(FRAC_PI_2)],
        Orientation::Fixed(angle) => vec![Range::point(angle)],
        Orientation::Free => vec![Range::spanning(0.0, PI)],
    };
    let yaw = match options.yaw {
        _ if options.is_vertical() => zero,
        yaw if TAU < yaw.width() => Range::spanning(0.0, TAU),
        yaw => yaw,
    };
    let roll = match options.roll {
        Some(roll) => Range::point(roll),
        None if roll_is_free => zero,
        None => Range::spanning(0.0, TAU),
    };
    angles.into_iter().map(|angle| [x, z, yaw, angle, roll]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::place::spatial::search::region;
    use crate::place::{SpatiallyPlaced, place_in_space};
    use crate::spatial::Pose;

    fn typical() -> Vec<(Zone, SpatialOptions)> {
        let down =
            SpatialOptions { flange_from_tool: Pose::translation(0.0, 0.0, 0.2), ..SpatialOptions::tool_down(1.0) };
        let circle = Zone::Circle { diameter: 0.5 };
        vec![
            (circle, down),
            (circle, SpatialOptions { flange_from_tool: Pose::translation(0.1, 0.0, 0.2), ..down }),
            (Zone::Rectangle { width: 0.3, height: 0.6 }, SpatialOptions { orientation: Orientation::Free, ..down }),
            (circle, SpatialOptions { elevation: 0.0, yaw: Range::point(0.0), ..down }),
        ]
    }

    #[test]
    fn the_paper_robots_typical_zones_are_proved_to_a_few_percent() {
        for (case, (zone, options)) in typical().iter().enumerate() {
            for robot in paper_robots() {
                let SpatiallyPlaced::Feasible(best) = place_in_space(&robot, *zone, options).unwrap() else {
                    continue;
                };
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
        for (zone, options) in typical() {
            for robot in paper_robots().iter().step_by(3) {
                let arm = SpatialArm::new(robot, &options.flange_from_tool).unwrap();
                let roll_is_free = arm.tool_turns_about_axis_6();
                let freed = arm.without_limit_on(0, true).without_limit_on(5, roll_is_free);
                let region = region(&arm, options.within);
                let prover = Prover::new(&freed, zone, &options, region, roll_is_free);
                let Some(best) = place_in_space(robot, zone, &options).unwrap().feasible().cloned() else { continue };
                let (worst, _) =
                    compliance(robot, &best.worst_joints, &options.flange_from_tool).unwrap().compliance.worst();
                let proof = prover.prove(1.5 * best.deflection);
                assert!(0.5 * worst < proof.lower && proof.lower <= worst, "{}: {proof:?} {worst}", robot.name);
            }
        }
    }

    #[test]
    fn a_zone_that_is_too_large_is_proved_to_be() {
        let robot = &paper_robots()[0];
        let options = SpatialOptions::tool_down(1.0);
        let placed = place_in_space(robot, Zone::Circle { diameter: 6.0 }, &options).unwrap();
        assert!(matches!(placed, SpatiallyPlaced::Infeasible { is_proved: true, .. }), "{placed:?}");
    }
}
