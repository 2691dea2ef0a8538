//! Branch and bound over the places of a zone: the best one, and a proof.
//!
//! A place is written in the zone's own axes: the centre `(u, v)` and the `turn` that carries these axes into the arm
//! plane. The nearest and farthest distance then depend on `(u, v)` alone, and a turn only shifts the two absolute
//! angles. Where nothing else ties the turn down it needs no search: the limits leave an interval of turns, or none.

use std::collections::VecDeque;
use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::boxes::{
    BOX_SLACK, Node, Spot, Worst, core, corners, cosine_over, hull, least_half_extents, least_span, meets, product,
    split,
};
use super::directed::Effort;
use super::objective::{Distances, Objective};
use super::{Orientation, PlaceError, Question, Solution, Within, exact, turned};
use crate::frontier::Frontier;
use crate::interval::Interval;
use crate::plane::{ElbowSide, PlanarArm, SLACK, Shape};
use crate::task::Zone;
use crate::watch::{Parts, Stopped};

/// Boxes after which a search gives up.
const MOST_BOXES: usize = 1_000_000;
/// The same under a known force, where each box costs more; the answer then tells the bound that was reached.
const MOST_BOXES_DIRECTED: usize = 50_000;
/// The same where only the largest scale is searched for: so near to what fits a proof costs most and matters least.
const MOST_BOXES_FOR_SCALE: usize = 50_000;
/// Relative allowance for the rounding of a bound.
const ROUNDING: f64 = 1e-12;
/// Places along each side of a box that are tried before a search under a known force.
const GRID: usize = 15;
/// Steps from a place towards one that keeps the limits.
const MOST_STEPS: usize = 5;
/// Worst points of the last best places that are kept for comparing others.
const MOST_WORST: usize = 12;
/// Sides below which a box is a point.
const POINT: f64 = 1e-15;

/// One place, judged.
#[derive(Clone, Copy, Debug)]
struct Found {
    compliance: f64,
    worst: Vector2<f64>,
    spot: Spot,
}

impl Found {
    /// Stiffer, or, of places that are equal but for rounding, nearer to straight ahead.
    fn beats(&self, other: &Self) -> bool {
        let same = (self.compliance - other.compliance).abs() <= ROUNDING * other.compliance;
        if same { self.bearing() < other.bearing() } else { self.compliance < other.compliance }
    }

    /// How far the centre lies from straight ahead, rad.
    fn bearing(&self) -> f64 {
        let centre = turned(self.spot.centre, self.spot.turn);
        centre.y.atan2(centre.x).abs()
    }
}

/// What stays the same while zones are tried on one arm.
pub(super) struct Search<'a> {
    arm: &'a PlanarArm,
    sides: &'a [ElbowSide],
    options: &'a Question,
    objective: Objective,
    parts: &'a Parts<'a>,
}

impl<'a> Search<'a> {
    pub(super) fn new(arm: &'a PlanarArm, sides: &'a [ElbowSide], options: &'a Question, parts: &'a Parts<'a>) -> Self {
        let objective = Objective::new(arm, options.sector);
        Self { arm, sides, options, objective, parts }
    }

    /// The best place to the gap asked for; `None` is a proof that there is no place.
    pub(super) fn best(&self, zone: Zone) -> Result<Option<Solution>, PlaceError> {
        Ok(self.run(zone, self.options.gap)?.map(|(found, lower)| self.report(zone, found, lower)))
    }

    /// Is there any place? `None` where so many boxes were looked at that the answer stays open.
    ///
    /// The largest boxes come first: where there is room, its middle is soon met.
    pub(super) fn has_place(&self, zone: Zone) -> Result<Option<bool>, Stopped> {
        let (found, queue) = self.seeds(zone);
        if found.is_some() {
            return Ok(Some(true));
        }
        let mut queue: VecDeque<Node> = queue.into_nodes().collect();
        for _ in 0..MOST_BOXES_FOR_SCALE {
            self.parts.one_more()?;
            let Some(node) = queue.pop_front() else { return Ok(Some(false)) };
            if self.near_middle(zone, &node).is_some() {
                return Ok(Some(true));
            }
            if POINT <= node.u.width().max(node.v.width()) {
                queue.extend(
                    split(node).into_iter().filter(|half| self.bound(zone, half, f64::INFINITY, &[]).is_some()),
                );
            }
        }
        Ok(None)
    }

    /// The best place and a lower bound, `gap` apart at most; under a known force as near as so many boxes prove.
    fn run(&self, zone: Zone, gap: f64) -> Result<Option<(Found, f64)>, PlaceError> {
        let (mut best, mut queue) = self.seeds(zone);
        // Points at which places are compared: some of the zone, the worst of the places that were the best so far, and one of each box.
        let mut samples = self.objective.samples(zone);
        let evenly = samples.len();
        let mut boxes = 0;
        while let Some(node) = queue.pop() {
            let upper = best.map_or(f64::INFINITY, |found| found.compliance);
            if upper * (1.0 - gap) <= node.lower {
                let lower = node.lower.min(upper);
                return Ok(best.map(|found| (found, lower)));
            }
            boxes += 1;
            self.parts.one_more()?;
            if let Some(found) = best
                && !self.objective.is_radial()
                && MOST_BOXES_DIRECTED < boxes
            {
                return Ok(Some((found, node.lower)));
            }
            if MOST_BOXES < boxes {
                let force = self.options.force;
                return Err(PlaceError::Unfinished { nodes: boxes, lower: node.lower * force, upper: upper * force });
            }
            // Once a place is known, sets of turns have too many boxes for more than a look at the middle.
            let spot = if best.is_none() || node.turn.width() == 0.0 {
                self.near_middle(zone, &node)
            } else {
                self.stands(zone, node.side, Vector2::new(node.u.middle(), node.v.middle()), node.turn)
            };
            if let Some(found) = spot.and_then(|spot| self.judge(zone, spot, upper)) {
                let found = self.polish(zone, found, node);
                samples.push(found.worst - found.spot.centre);
                if evenly + MOST_WORST < samples.len() {
                    samples.remove(evenly);
                }
                best = Some(found);
            }
            let upper = best.map_or(f64::INFINITY, |found| found.compliance);
            if node.u.width().max(node.v.width()) < POINT {
                continue;
            }
            let evenly_and_worst = samples.len();
            if !self.objective.is_radial() {
                let centre = Vector2::new(node.u.middle(), node.v.middle());
                let (Ok(bad) | Err(bad)) = self.worst(
                    zone,
                    &Spot { side: node.side, centre, turn: node.turn.middle() },
                    upper,
                    Effort::SEARCH,
                );
                samples.push(bad.point - centre);
            }
            for half in split(node) {
                if let Some(lower) = self.bound(zone, &half, upper, &samples) {
                    queue.push(Node { lower: lower.max(node.lower), ..half });
                }
            }
            samples.truncate(evenly_and_worst);
        }
        Ok(best.map(|found| (found, found.compliance)))
    }

    /// The whole search space, and the best of the places that would be exact if only the ring limited the zone.
    fn seeds(&self, zone: Zone) -> (Option<Found>, Frontier<Node>) {
        let mut best: Option<Found> = None;
        let mut queue = Frontier::new();
        let sigma = self.arm.radial();
        for (i, side) in self.sides.iter().enumerate() {
            let symmetric_places = exact::symmetric_places(&sigma, side.ring, zone);
            let Some(first) = symmetric_places.first() else {
                continue;
            };
            let lower = if self.objective.is_radial() { first.compliance * (1.0 - ROUNDING) } else { 0.0 };
            for node in self.roots(zone, i, lower) {
                for place in &symmetric_places {
                    let unit = if place.across { Vector2::y() } else { Vector2::x() };
                    for sign in [1.0, -1.0] {
                        let spot = self.stands(zone, i, sign * place.distance * unit, node.turn);
                        let found = spot.and_then(|spot| self.judge(zone, spot, f64::INFINITY));
                        if let Some(found) = found
                            && best.is_none_or(|best| found.beats(&best))
                        {
                            best = Some(found);
                        }
                    }
                }
                if let Some(found) = self.best_of_grid(zone, &node)
                    && best.is_none_or(|best| found.beats(&best))
                {
                    best = Some(found);
                }
                queue.push(node);
            }
        }
        (best, queue)
    }

    /// The best of places at even steps through a box, under a known force, of which boxes tell little while they are large.
    fn best_of_grid(&self, zone: Zone, node: &Node) -> Option<Found> {
        let steps = |range: Interval| {
            let count = if range.width() == 0.0 { 1 } else { GRID };
            (0..count).map(move |i| range.min() + range.width() * (i as f64 + 0.5) / count as f64)
        };
        if self.objective.is_radial() {
            return None;
        }
        let mut best: Option<Found> = None;
        for turn in steps(node.turn) {
            for u in steps(node.u) {
                for v in steps(node.v) {
                    let upper = best.map_or(f64::INFINITY, |found| found.compliance);
                    let spot = self.stands(zone, node.side, Vector2::new(u, v), Interval::point(turn));
                    best = spot.and_then(|spot| self.judge(zone, spot, upper)).or(best);
                }
            }
        }
        let step = Interval::spanning(0.0, node.u.width() / GRID as f64);
        best.map(|found| self.polish(zone, found, Node { u: step, ..*node }))
    }

    /// Boxes that hold every place worth looking at on one side.
    fn roots(&self, zone: Zone, side: usize, lower: f64) -> Vec<Node> {
        let far = self.sides[side].ring.max();
        let across = Interval::spanning(-far, far);
        let half = Interval::spanning(0.0, far);
        // A known force tells one bearing from another.
        let free = self.options.within == Within::ANYWHERE && self.objective.is_radial();
        let turns = |first: f64, last: f64| Interval::spanning(first, last);
        let boxes: Vec<(Interval, Interval, Interval)> = match (zone, self.options.orientation) {
            (Zone::Circle { .. }, _) if free => {
                vec![(half, Interval::point(0.0), turns(0.0, 2.0 * PI))]
            }
            (Zone::Circle { .. }, _) => vec![(across, across, turns(0.0, 0.0))],
            (Zone::Rectangle { .. }, Orientation::Free) if free => {
                vec![(half, across, turns(0.0, 2.0 * PI))]
            }
            (Zone::Rectangle { .. }, Orientation::Free) => vec![(across, across, turns(0.0, PI))],
            (Zone::Rectangle { .. }, Orientation::Fixed(angle)) => {
                vec![(across, across, turns(angle, angle))]
            }
            (Zone::Rectangle { width, height }, Orientation::Axes) => {
                let count = if width == height { 1 } else { 2 };
                let both = [(across, across, turns(0.0, 0.0)), (across, across, turns(FRAC_PI_2, FRAC_PI_2))];
                both[..count].to_vec()
            }
        };
        boxes
            .into_iter()
            .filter_map(|(u, v, turn)| {
                let (u, v) = self.allowed_centres(zone, u, v, turn)?;
                Some(Node { lower, side, u, v, turn })
            })
            .collect()
    }

    /// The part of a box of centres that `within` allows, where the zone's axes are those of the arm plane.
    fn allowed_centres(&self, zone: Zone, u: Interval, v: Interval, turn: Interval) -> Option<(Interval, Interval)> {
        let Within { x, z } = self.options.within;
        let inset = |range: Interval, half: f64| Interval::new(range.min() + half, range.max() - half);
        let half = zone.half_extents(turn.min());
        if turn == Interval::point(0.0) {
            Some((u.intersect(inset(x, half.x)?)?, v.intersect(inset(z, half.y)?)?))
        } else if turn == Interval::point(FRAC_PI_2) {
            let x = inset(x, half.x)?.affine(-1.0, 0.0);
            Some((u.intersect(inset(z, half.y)?)?, v.intersect(x)?))
        } else {
            Some((u, v))
        }
    }

    /// A place with the best of the turns it may take; `None` where the zone does not fit there.
    fn stands(&self, zone: Zone, side: usize, centre: Vector2<f64>, turns: Interval) -> Option<Spot> {
        let shape = zone.shape(centre);
        let side_limits = &self.sides[side];
        if !self.fits_ring(side_limits, &shape) {
            return None;
        }
        let allowed = if side_limits.is_whole_ring() {
            Interval::ALL
        } else {
            let (shoulder, forearm) = side_limits.angles_over(&shape);
            side_limits.turns(shoulder, forearm, SLACK)?
        };
        let turn = if turns.width() < PI {
            // A known turn, or a narrow set of them of which the middle is tried.
            allowed.turn_to(turns.middle(), SLACK)?
        } else {
            // Any turn: the zone stands as nearly straight ahead as the limits allow.
            straight_ahead(allowed, -centre.y.atan2(centre.x))
        };
        self.stands_within(zone, centre, turn).then_some(Spot { side, centre, turn })
    }

    /// The largest compliance inside a zone that stands somewhere; `None` where it is not below `upper`.
    fn judge(&self, zone: Zone, spot: Spot, upper: f64) -> Option<Found> {
        let Worst { compliance, point } = self.worst(zone, &spot, upper, Effort::SEARCH).ok()?;
        Some(Found { compliance, worst: point, spot })
    }

    fn worst(&self, zone: Zone, spot: &Spot, upper: f64, effort: Effort) -> Result<Worst, Worst> {
        self.objective.worst(self.sides[spot.side].elbow, zone, spot, upper, effort)
    }

    /// The place in the middle of a box, or, where that misses a limit, one near it that keeps all of them.
    ///
    /// Limits that leave a sliver are rarely met by chance.
    fn near_middle(&self, zone: Zone, node: &Node) -> Option<Spot> {
        let middle = Vector2::new(node.u.middle(), node.v.middle());
        let mut centre = middle;
        for _ in 0..MOST_STEPS {
            let spot = self.stands(zone, node.side, centre, node.turn);
            // Of many turns the limits choose the best themselves; farther away another box has its middle.
            if spot.is_some() || PI <= node.turn.width() {
                return spot;
            }
            centre = self.towards_limits(zone, node, centre)?;
            if 2.0 * node.u.width().max(node.v.width()) < (centre - middle).norm() {
                return None;
            }
        }
        None
    }

    /// A step from a centre to where, to first order, its zone keeps one limit after the other; `None` where it spans
    /// more than a limit leaves.
    fn towards_limits(&self, zone: Zone, node: &Node, mut centre: Vector2<f64>) -> Option<Vector2<f64>> {
        let (side, turn) = (&self.sides[node.side], node.turn.middle());
        let Within { x, z } = self.options.within;
        let (away, half) = (turned(centre, turn), zone.half_extents(turn));
        let into = |range: Interval, c: f64, h: f64| shift_into(range, Interval::spanning(c - h, c + h));
        centre += turned(Vector2::new(into(x, away.x, half.x)?, into(z, away.y, half.y)?), -turn);
        let shape = zone.shape(centre);
        let distances = Interval::new(shape.nearest().norm(), shape.farthest().norm())?;
        // A window may lie so far away that no distance to it is a number.
        if distances.min() <= BOX_SLACK * self.arm.l2 || !distances.is_bounded() {
            return None;
        }
        centre += shift_into(side.ring, distances)? * centre.normalize();
        let (shoulder, forearm) = side.angles_over(&zone.shape(centre));
        let missing =
            |limit: Interval, taken: Interval| shift_into(limit, taken.affine(1.0, turn).turned_towards(limit));
        let (missing_shoulder, missing_forearm) = (missing(side.shoulder, shoulder)?, missing(side.forearm, forearm)?);
        // dp = l2 e'(shoulder) d shoulder + l3 e'(forearm) d forearm
        let (shoulder, elbow) = side.posture_near(centre);
        let across = |angle: f64| Vector2::new(-angle.sin(), angle.cos());
        centre += self.arm.l2 * missing_shoulder * across(shoulder);
        Some(centre + self.arm.l3 * missing_forearm * across(shoulder + elbow))
    }

    /// The figure lies in the ring of the side and leaves the axis outside.
    fn fits_ring(&self, side: &ElbowSide, shape: &Shape) -> bool {
        let (near, far) = (shape.nearest().norm(), shape.farthest().norm());
        let slack = SLACK * self.arm.l2;
        side.ring.min() - slack <= near && far <= side.ring.max() + slack && !shape.covers_origin(slack)
    }

    fn stands_within(&self, zone: Zone, centre: Vector2<f64>, turn: f64) -> bool {
        let Within { x, z } = self.options.within;
        let slack = SLACK * self.arm.l2;
        let (centre, half) = (turned(centre, turn), zone.half_extents(turn));
        let inside = |range: Interval, c: f64, h: f64| range.min() - slack <= c - h && c + h <= range.max() + slack;
        inside(x, centre.x, half.x) && inside(z, centre.y, half.y)
    }

    /// A lower bound on the compliance of every place in a box, under a known force by comparing places at some points of the zone; `None`
    /// where none of them is allowed or beats `upper`.
    fn bound(&self, zone: Zone, node: &Node, upper: f64, samples: &[Vector2<f64>]) -> Option<f64> {
        let side = &self.sides[node.side];
        let slack = BOX_SLACK * self.arm.l2;
        // Nearest and farthest distance grow with |u| and |v|.
        let (innermost, outermost) = corners(node.u, node.v);
        let (first, last) = (zone.shape(innermost), zone.shape(outermost));
        let (near_min, near_max) = (first.nearest().norm(), last.nearest().norm());
        let (far_min, far_max) = (first.farthest().norm(), last.farthest().norm());
        if near_max < side.ring.min() - slack || side.ring.max() + slack < far_min || last.covers_origin(slack) {
            return None;
        }
        let distances =
            Distances { near: [near_min.max(side.ring.min()), near_max], far: [far_min, far_max.min(side.ring.max())] };
        let by_distance = self.objective.least_by_distance(&distances);
        if upper <= by_distance
            || !self.may_stand_within(zone, node)
            || !self.may_turn(zone, node, side)
            || !self.may_be_so_wide(zone, node, side)
        {
            return None;
        }
        let lower = self.objective.least(by_distance, side.elbow, node, samples);
        (lower < upper).then_some(lower)
    }

    /// Can the absolute angles stay within their limits for any place in the box?
    fn may_turn(&self, zone: Zone, node: &Node, side: &ElbowSide) -> bool {
        if side.is_whole_ring() {
            return true;
        }
        let (mut core, shared) = core(zone, node.u, node.v);
        let slack = BOX_SLACK * self.arm.l2;
        if core.nearest().norm() <= slack {
            // Around the axis a bearing means nothing. What all places cover is judged a hair farther in: where the axis
            // is still not outside, every place covers it.
            if !shared {
                return true;
            }
            core = core.shrunk(4.0 * slack);
            if core.nearest().norm() <= slack {
                return false;
            }
        }
        let allowed = if shared {
            if core.nearest().norm() < side.ring.min() - slack || side.ring.max() + slack < core.farthest().norm() {
                return false;
            }
            let (shoulder, forearm) = side.angles_over(&core);
            side.turns(shoulder, forearm, BOX_SLACK)
        } else {
            let (shoulder, forearm) = side.angles_around(&core);
            side.turns_touching(shoulder, forearm, BOX_SLACK)
        };
        allowed.is_some_and(|allowed| 2.0 * PI <= node.turn.width() || meets(allowed, node.turn))
    }

    /// Do distance, shoulder and forearm angle change so little over the zone, wherever in the box, that they can keep
    /// their limits?
    ///
    /// Their gradients `e(bearing)`, `e(forearm)/(l2 sin elbow)`, `e(shoulder)/(l3 sin elbow)` hardly change over a
    /// box, however much larger than the zone, and than a sliver, it is.
    fn may_be_so_wide(&self, zone: Zone, node: &Node, side: &ElbowSide) -> bool {
        let hull = hull(zone, node.u, node.v);
        let slack = BOX_SLACK * self.arm.l2;
        let nearest = hull.nearest().norm();
        let distances = Interval::new(nearest, hull.farthest().norm()).and_then(|range| range.intersect(side.ring));
        let Some(distances) = distances.filter(|_| slack < nearest) else { return true };
        let (shoulder, forearm) = side.angles_around(&hull);
        let sine = side.largest_sine(distances);
        let fits =
            |limit: Interval, span: f64, scale: f64| span * (1.0 - ROUNDING) <= (limit.width() + 2.0 * SLACK) * scale;
        fits(side.ring, least_span(zone, hull.bearings()), 1.0)
            && fits(side.shoulder, least_span(zone, forearm), self.arm.l2 * sine)
            && fits(side.forearm, least_span(zone, shoulder), self.arm.l3 * sine)
    }

    fn may_stand_within(&self, zone: Zone, node: &Node) -> bool {
        if self.options.within == Within::ANYWHERE {
            return true;
        }
        let Within { x, z } = self.options.within;
        let (cos, sin) = (cosine_over(node.turn), cosine_over(node.turn.affine(1.0, -FRAC_PI_2)));
        let slack = BOX_SLACK * self.arm.l2;
        let half = least_half_extents(zone, node.turn);
        let may = |range: Interval, c: Interval, h: f64| {
            range.min() - slack <= c.max() - h
                && c.min() + h <= range.max() + slack
                && 2.0 * (h - slack) <= range.width()
        };
        let centre_x = product(node.u, cos).plus(product(node.v, sin).affine(-1.0, 0.0));
        let centre_z = product(node.u, sin).plus(product(node.v, cos));
        may(x, centre_x, half.x) && may(z, centre_z, half.y)
    }

    /// Walks downhill from a place along the axes and diagonals, and under a known force along what turns are left, with ever shorter steps.
    fn polish(&self, zone: Zone, start: Found, node: Node) -> Found {
        let mut best = start;
        let mut step = node.u.width().max(node.v.width()) / 2.0;
        let may_turn = !self.objective.is_radial() && 0.0 < node.turn.width();
        let turns = if node.turn.width() < PI { Interval::point(node.turn.middle()) } else { node.turn };
        while self.options.gap * 1e-2 * self.arm.l2 < step {
            let before = best.compliance;
            let try_at = |best: &mut Found, centre: Vector2<f64>, turns: Interval| {
                let spot = self.stands(zone, start.spot.side, centre, turns);
                *best = spot.and_then(|spot| self.judge(zone, spot, best.compliance)).unwrap_or(*best);
            };
            for (du, dv) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let moved = best.spot.centre + step * Vector2::new(f64::from(du), f64::from(dv));
                let moved = if node.v == Interval::point(0.0) { Vector2::new(moved.x, 0.0) } else { moved };
                let turns = if may_turn { Interval::point(best.spot.turn) } else { turns };
                try_at(&mut best, moved, turns);
            }
            for by in [step, -step].into_iter().filter(|_| may_turn).map(|step| step / self.arm.l2) {
                // The zone turns about its centre, which in its own axes goes the other way.
                let (centre, turn) = (turned(best.spot.centre, -by), best.spot.turn + by);
                try_at(&mut best, centre, Interval::point(turn));
            }
            if best.compliance == before {
                step /= 2.0;
            }
        }
        best
    }

    fn report(&self, zone: Zone, found: Found, lower: f64) -> Solution {
        let (Ok(found_well) | Err(found_well)) = self.worst(zone, &found.spot, f64::INFINITY, Effort::ANSWER);
        let found = Found { compliance: found_well.compliance, worst: found_well.point, ..found };
        let Spot { side, centre, turn } = found.spot;
        let side = &self.sides[side];
        // A quarter turn leaves a trace of rounding in what is zero.
        let clean = |v: Vector2<f64>| v.map(|x| if x.abs() < 1e-12 { 0.0 } else { x });
        let worst = clean(turned(found.worst, turn));
        let (shoulder, elbow) = side.posture(worst).unwrap_or_else(|| side.posture_near(worst));
        let centre = clean(turned(centre, turn));
        let angle = match zone {
            Zone::Circle { .. } => 0.0,
            Zone::Rectangle { .. } => turn.rem_euclid(PI),
        };
        Solution {
            deflection: found.compliance * self.options.force,
            lower_bound: lower * self.options.force,
            centre: centre.into(),
            angle,
            elbow: side.elbow,
            worst_point: worst.into(),
            worst_posture: [shoulder, elbow],
        }
    }
}

/// The least shift that brings `taken` into `limit`, if it is not too wide.
fn shift_into(limit: Interval, taken: Interval) -> Option<f64> {
    Interval::new(limit.min() - taken.min(), limit.max() - taken.max()).map(|shifts| shifts.clamp(0.0))
}

/// The turn in `allowed` (up to whole turns) that comes nearest to `wished`.
fn straight_ahead(allowed: Interval, wished: f64) -> f64 {
    let away = |x: f64| ((x - wished + PI).rem_euclid(2.0 * PI) - PI).abs();
    allowed
        .turn_to(wished, 0.0)
        .unwrap_or_else(|| if away(allowed.min()) <= away(allowed.max()) { allowed.min() } else { allowed.max() })
}
