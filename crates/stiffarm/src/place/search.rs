//! Branch and bound over the places of a zone: the best one, and a proof.
//!
//! A place is written in the zone's own axes: the centre `(u, v)` and the `turn` that carries these axes into the arm
//! plane. The nearest and farthest distance then depend on `(u, v)` alone, and a turn only shifts the two absolute
//! angles. Where nothing else ties the turn down it needs no search: the limits leave an interval of turns, or none.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::{Orientation, PlaceError, PlaceOptions, Placement, Within, exact, turned};
use crate::limits::Range;
use crate::plane::{ElbowSide, PlanarArm, RadialCompliance, SLACK, Shape};
use crate::task::Zone;

/// Boxes after which a search gives up.
const MOST_BOXES: usize = 4_000_000;
/// Relative allowance for the rounding of a bound.
const ROUNDING: f64 = 1e-12;
/// Slack within which a box is given up: less than what a place is granted, so that a box about to become a point
/// either goes or holds a place, and more than rounding, so that no place within its limits is lost.
const BOX_SLACK: f64 = SLACK / 2.0;
/// Sides below which a box is a point.
const POINT: f64 = 1e-15;

/// A set of places on one elbow side, and a lower bound on their compliance.
#[derive(Clone, Copy, Debug)]
struct Node {
    lower: f64,
    side: usize,
    u: Range,
    v: Range,
    turn: Range,
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
    /// The heap hands out the greatest first: the least lower bound, of those the smallest box.
    fn cmp(&self, other: &Self) -> Ordering {
        other.lower.total_cmp(&self.lower).then(other.u.width().total_cmp(&self.u.width()))
    }
}

/// One place, judged.
#[derive(Clone, Copy, Debug)]
struct Found {
    compliance: f64,
    side: usize,
    centre: Vector2<f64>,
    turn: f64,
}

impl Found {
    /// Stiffer, or, of places that are equal but for rounding, nearer to straight ahead.
    fn beats(&self, other: &Self) -> bool {
        let same = (self.compliance - other.compliance).abs() <= ROUNDING * other.compliance;
        if same { self.bearing() < other.bearing() } else { self.compliance < other.compliance }
    }

    /// How far the centre lies from straight ahead, rad.
    fn bearing(&self) -> f64 {
        let centre = turned(self.centre, self.turn);
        centre.y.atan2(centre.x).abs()
    }
}

/// What stays the same while zones are tried on one arm.
pub(super) struct Search<'a> {
    arm: &'a PlanarArm,
    sides: &'a [ElbowSide],
    options: &'a PlaceOptions,
    sigma: RadialCompliance,
}

impl<'a> Search<'a> {
    pub(super) fn new(arm: &'a PlanarArm, sides: &'a [ElbowSide], options: &'a PlaceOptions) -> Self {
        Self { arm, sides, options, sigma: arm.radial() }
    }

    pub(super) fn sides(&self) -> &'a [ElbowSide] {
        self.sides
    }

    /// The best place to the gap asked for; `None` is a proof that there is no place.
    pub(super) fn best(&self, zone: Zone) -> Result<Option<Placement>, PlaceError> {
        Ok(self.run(zone, self.options.gap)?.map(|(found, lower)| self.report(zone, found, lower)))
    }

    /// Is there any place?
    pub(super) fn has_place(&self, zone: Zone) -> Result<bool, PlaceError> {
        Ok(self.run(zone, 1.0)?.is_some())
    }

    /// The best place and a lower bound, `gap` apart at most.
    fn run(&self, zone: Zone, gap: f64) -> Result<Option<(Found, f64)>, PlaceError> {
        let (mut best, mut queue) = self.seeds(zone);
        let mut boxes = 0;
        while let Some(node) = queue.pop() {
            let upper = best.map_or(f64::INFINITY, |found| found.compliance);
            if upper * (1.0 - gap) <= node.lower {
                let lower = node.lower.min(upper);
                return Ok(best.map(|found| (found, lower)));
            }
            boxes += 1;
            if MOST_BOXES < boxes {
                let force = self.options.force;
                return Err(PlaceError::Unfinished { nodes: boxes, lower: node.lower * force, upper: upper * force });
            }
            let middle = Vector2::new(node.u.middle(), node.v.middle());
            if let Some(found) = self.judge(zone, node.side, middle, node.turn)
                && found.compliance < upper
            {
                best = Some(self.polish(zone, found, node));
            }
            let upper = best.map_or(f64::INFINITY, |found| found.compliance);
            if node.u.width().max(node.v.width()) < POINT {
                continue;
            }
            for half in split(node) {
                if let Some(lower) = self.bound(zone, &half, upper) {
                    queue.push(Node { lower: lower.max(node.lower), ..half });
                }
            }
        }
        Ok(best.map(|found| (found, found.compliance)))
    }

    /// The whole search space, and the best of the places that would be exact if only the ring limited the zone.
    fn seeds(&self, zone: Zone) -> (Option<Found>, BinaryHeap<Node>) {
        let mut best: Option<Found> = None;
        let mut queue = BinaryHeap::new();
        for (i, side) in self.sides.iter().enumerate() {
            let stances = exact::stances(&self.sigma, side.ring, zone);
            let Some(first) = stances.first() else {
                continue;
            };
            for node in self.roots(zone, i, first.compliance * (1.0 - ROUNDING)) {
                for stance in &stances {
                    let unit = if stance.across { Vector2::y() } else { Vector2::x() };
                    for sign in [1.0, -1.0] {
                        if let Some(found) = self.judge(zone, i, sign * stance.distance * unit, node.turn)
                            && best.is_none_or(|best| found.beats(&best))
                        {
                            best = Some(found);
                        }
                    }
                }
                queue.push(node);
            }
        }
        (best, queue)
    }

    /// Boxes that hold every place worth looking at on one side.
    fn roots(&self, zone: Zone, side: usize, lower: f64) -> Vec<Node> {
        let far = self.sides[side].ring.max();
        let across = Range::spanning(-far, far);
        let half = Range::spanning(0.0, far);
        let free = self.options.within == Within::ANYWHERE;
        let turns = |first: f64, last: f64| Range::spanning(first, last);
        let boxes: Vec<(Range, Range, Range)> = match (zone, self.options.orientation) {
            (Zone::Circle { .. }, _) if free => {
                vec![(half, Range::point(0.0), turns(0.0, 2.0 * PI))]
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
    fn allowed_centres(&self, zone: Zone, u: Range, v: Range, turn: Range) -> Option<(Range, Range)> {
        let Within { x, z } = self.options.within;
        let inset = |range: Range, half: f64| Range::new(range.min() + half, range.max() - half);
        let half = zone.half_extents(turn.min());
        if turn == Range::point(0.0) {
            Some((u.intersect(inset(x, half.x)?)?, v.intersect(inset(z, half.y)?)?))
        } else if turn == Range::point(FRAC_PI_2) {
            let x = inset(x, half.x)?.affine(-1.0, 0.0);
            Some((u.intersect(inset(z, half.y)?)?, v.intersect(x)?))
        } else {
            Some((u, v))
        }
    }

    /// Judges one place with the best of the turns it may take; `None` where the zone does not fit there.
    fn judge(&self, zone: Zone, side: usize, centre: Vector2<f64>, turns: Range) -> Option<Found> {
        let shape = zone.shape(centre);
        let compliance = self.fits_ring(side, &shape)?;
        let side_limits = &self.sides[side];
        let allowed = if side_limits.is_whole_ring() {
            Range::ALL
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
        self.stands_within(zone, centre, turn).then_some(Found { compliance, side, centre, turn })
    }

    /// The largest compliance over a figure, where it lies in the ring of the side and leaves the axis outside.
    fn fits_ring(&self, side: usize, shape: &Shape) -> Option<f64> {
        let ring = self.sides[side].ring;
        let (near, far) = (shape.nearest().norm(), shape.farthest().norm());
        let slack = SLACK * self.arm.l2;
        (ring.min() - slack <= near && far <= ring.max() + slack && !shape.covers_origin(slack))
            .then(|| self.sigma.at(near).max(self.sigma.at(far)))
    }

    fn stands_within(&self, zone: Zone, centre: Vector2<f64>, turn: f64) -> bool {
        let Within { x, z } = self.options.within;
        let slack = SLACK * self.arm.l2;
        let (centre, half) = (turned(centre, turn), zone.half_extents(turn));
        let inside = |range: Range, c: f64, h: f64| range.min() - slack <= c - h && c + h <= range.max() + slack;
        inside(x, centre.x, half.x) && inside(z, centre.y, half.y)
    }

    /// A lower bound on the compliance of every place in a box; `None` where none of them is allowed or beats `upper`.
    fn bound(&self, zone: Zone, node: &Node, upper: f64) -> Option<f64> {
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
        let near = self.sigma.least(near_min.max(side.ring.min()), near_max);
        let far = self.sigma.least(far_min, far_max.min(side.ring.max()));
        let lower = near.max(far) * (1.0 - ROUNDING);
        if upper <= lower || !self.may_stand_within(zone, node) || !self.may_turn(zone, node, side) {
            return None;
        }
        Some(lower)
    }

    /// Can the absolute angles stay within their limits for any place in the box?
    fn may_turn(&self, zone: Zone, node: &Node, side: &ElbowSide) -> bool {
        if side.is_whole_ring() {
            return true;
        }
        let (core, shared) = core(zone, node.u, node.v);
        let slack = BOX_SLACK * self.arm.l2;
        if core.nearest().norm() <= slack {
            return true; // Around the axis a bearing means nothing.
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

    fn may_stand_within(&self, zone: Zone, node: &Node) -> bool {
        if self.options.within == Within::ANYWHERE {
            return true;
        }
        let Within { x, z } = self.options.within;
        let (cos, sin) = (cosine_over(node.turn), cosine_over(node.turn.affine(1.0, -FRAC_PI_2)));
        let slack = BOX_SLACK * self.arm.l2;
        let half = least_half_extents(zone, node.turn);
        let may =
            |range: Range, c: Range, h: f64| range.min() - slack <= c.max() - h && c.min() + h <= range.max() + slack;
        let centre_x = product(node.u, cos).plus(product(node.v, sin).affine(-1.0, 0.0));
        let centre_z = product(node.u, sin).plus(product(node.v, cos));
        may(x, centre_x, half.x) && may(z, centre_z, half.y)
    }

    /// Walks downhill from a place along the axes and diagonals with ever shorter steps.
    fn polish(&self, zone: Zone, start: Found, node: Node) -> Found {
        let mut best = start;
        let mut step = node.u.width().max(node.v.width()) / 2.0;
        let turns = if node.turn.width() < PI { Range::point(node.turn.middle()) } else { node.turn };
        while self.options.gap * 1e-2 * self.arm.l2 < step {
            let before = best.compliance;
            for (du, dv) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let moved = best.centre + step * Vector2::new(f64::from(du), f64::from(dv));
                let moved = if node.v == Range::point(0.0) { Vector2::new(moved.x, 0.0) } else { moved };
                if let Some(found) = self.judge(zone, start.side, moved, turns)
                    && found.compliance < best.compliance
                {
                    best = found;
                }
            }
            if best.compliance == before {
                step /= 2.0;
            }
        }
        best
    }

    fn report(&self, zone: Zone, found: Found, lower: f64) -> Placement {
        let shape = zone.shape(found.centre);
        let (near, far) = (shape.nearest(), shape.farthest());
        let worst = if self.sigma.at(near.norm()) <= self.sigma.at(far.norm()) { far } else { near };
        let side = &self.sides[found.side];
        // A quarter turn leaves a trace of rounding in what is zero.
        let clean = |v: Vector2<f64>| v.map(|x| if x.abs() < 1e-12 { 0.0 } else { x });
        let worst = clean(turned(worst, found.turn));
        let (shoulder, elbow) = side.posture(worst).unwrap_or_else(|| side.posture_near(worst));
        let centre = clean(turned(found.centre, found.turn));
        let angle = match zone {
            Zone::Circle { .. } => 0.0,
            Zone::Rectangle { .. } => found.turn.rem_euclid(PI),
        };
        Placement {
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

/// The two halves of a box across its longest side; a turn counts as the way it moves a point 1 m out.
fn split(node: Node) -> [Node; 2] {
    let (u, v) = (node.u.width(), node.v.width());
    // A set of turns that is wider than half a turn is never searched: the limits choose from it.
    let turn = if node.turn.width() <= PI { node.turn.width() } else { 0.0 };
    let halves = |range: Range| {
        let middle = range.middle();
        [Range::spanning(range.min(), middle), Range::spanning(middle, range.max())]
    };
    if v <= u && turn <= u {
        halves(node.u).map(|u| Node { u, ..node })
    } else if turn <= v {
        halves(node.v).map(|v| Node { v, ..node })
    } else {
        halves(node.turn).map(|turn| Node { turn, ..node })
    }
}

/// The points of a box with the least and the greatest `|u|`, `|v|`.
fn corners(u: Range, v: Range) -> (Vector2<f64>, Vector2<f64>) {
    let least = |range: Range| range.clamp(0.0).abs();
    let most = |range: Range| range.min().abs().max(range.max().abs());
    (Vector2::new(least(u), least(v)), Vector2::new(most(u), most(v)))
}

/// What every zone with its centre in the box covers (`true`), or, where they share nothing, a figure that each touches.
fn core(zone: Zone, u: Range, v: Range) -> (Shape, bool) {
    let middle = Vector2::new(u.middle(), v.middle());
    match zone {
        Zone::Circle { diameter } => {
            let radius = diameter / 2.0 - u.width().hypot(v.width()) / 2.0;
            (Shape::Disc(middle, radius.abs()), 0.0 <= radius)
        }
        Zone::Rectangle { width, height } => {
            let half = Vector2::new(width - u.width(), height - v.width()) / 2.0;
            if 0.0 <= half.x && 0.0 <= half.y {
                (Shape::Rectangle(middle, half), true)
            } else {
                // Along an axis on which they share a stretch, its middle will do.
                (Shape::Rectangle(middle, half.map(|h| (-h).max(0.0))), false)
            }
        }
    }
}

/// Do two ranges of angles share one up to whole turns?
fn meets(allowed: Range, turn: Range) -> bool {
    if !allowed.is_bounded() {
        return true;
    }
    let period = 2.0 * PI;
    let first = ((allowed.min() - BOX_SLACK - turn.max()) / period).ceil() * period;
    turn.min() + first <= allowed.max() + BOX_SLACK
}

/// The turn in `allowed` (up to whole turns) that comes nearest to `wished`.
fn straight_ahead(allowed: Range, wished: f64) -> f64 {
    let away = |x: f64| ((x - wished + PI).rem_euclid(2.0 * PI) - PI).abs();
    allowed
        .turn_to(wished, 0.0)
        .unwrap_or_else(|| if away(allowed.min()) <= away(allowed.max()) { allowed.min() } else { allowed.max() })
}

/// The range of the cosine over a range of angles.
fn cosine_over(angles: Range) -> Range {
    if 2.0 * PI <= angles.width() {
        return Range::spanning(-1.0, 1.0);
    }
    let ends = Range::spanning(angles.min().cos(), angles.max().cos());
    let passes = |x: f64| angles.turn_to(x, 0.0).is_some();
    Range::spanning(if passes(PI) { -1.0 } else { ends.min() }, if passes(0.0) { 1.0 } else { ends.max() })
}

fn product(a: Range, b: Range) -> Range {
    let ends = [a.min() * b.min(), a.min() * b.max(), a.max() * b.min(), a.max() * b.max()];
    Range::spanning(ends.into_iter().fold(f64::INFINITY, f64::min), ends.into_iter().fold(f64::NEG_INFINITY, f64::max))
}

/// Half the width and height that the zone takes at least over a set of turns.
fn least_half_extents(zone: Zone, turn: Range) -> Vector2<f64> {
    if turn.width() == 0.0 {
        return zone.half_extents(turn.min());
    }
    let least = |range: Range| range.clamp(0.0).abs();
    let (cos, sin) = (least(cosine_over(turn)), least(cosine_over(turn.affine(1.0, -FRAC_PI_2))));
    match zone {
        Zone::Circle { diameter } => Vector2::repeat(diameter / 2.0),
        Zone::Rectangle { width, height } => Vector2::new(width * cos + height * sin, width * sin + height * cos) / 2.0,
    }
}
