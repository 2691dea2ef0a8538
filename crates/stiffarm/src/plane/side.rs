//! What does one elbow side reach within the limits?

use std::f64::consts::PI;

use nalgebra::Vector2;

use super::{PlanarArm, SLACK, Shape};
use crate::interval::Interval;

/// On which side of the line from shoulder to wrist centre the elbow lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Elbow {
    /// The forearm is turned clockwise from the upper arm: above, when the arm reaches forwards.
    Up,
    /// The forearm is turned counter-clockwise from the upper arm.
    Down,
}

impl Elbow {
    /// The name that reports use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
        }
    }

    /// The sign of the elbow angle.
    pub(crate) const fn sign(self) -> f64 {
        match self {
            Self::Up => -1.0,
            Self::Down => 1.0,
        }
    }
}

/// One elbow side with the limits that hold on it: the set of points it reaches without a change of posture.
///
/// In polar coordinates `p = r e(phi)` the posture of a side is closed form: with the triangle's angles `psi2(r)` at
/// the shoulder and `psi3(r)` at the wrist, both in `[0, pi]`, and `s` the sign of the elbow angle,
/// `shoulder = phi - s psi2(r)` and `forearm = phi + s psi3(r)`. The set is therefore a ring `r.min() <= r <= r.max()`
/// bounded further by arcs of constant shoulder angle (radius l3 about an elbow position) and of constant forearm
/// angle (radius l2 about `l3 e(forearm)`).
#[derive(Clone, Debug, PartialEq)]
pub struct ElbowSide {
    /// Which side.
    pub elbow: Elbow,
    /// Distances from the joint-2 axis that the elbow range allows, m.
    pub ring: Interval,
    /// Allowed shoulder angle, rad.
    pub shoulder: Interval,
    /// Allowed forearm angle, rad, up to `turn`.
    pub forearm: Interval,
    /// Whole turns (rad) by which the elbow angle differs from the one in `[-pi, pi]`.
    turn: f64,
    l2: f64,
    l3: f64,
}

/// How much room is left to each limit, rad; infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rooms {
    pub(crate) shoulder: f64,
    /// Of the angle between the links.
    pub(crate) elbow: f64,
    /// Of the forearm's angle in the plane.
    pub(crate) forearm: f64,
    /// From stretched and folded.
    pub(crate) straight: f64,
}

impl ElbowSide {
    /// All sides on which the limits leave an area, the elbow `clear`, rad, of stretched and folded. An elbow range beyond half a turn opens
    /// further ones.
    pub(super) fn of(arm: &PlanarArm, clear: f64) -> Vec<Self> {
        let implied = if arm.forearm.is_bounded() && arm.shoulder.is_bounded() {
            arm.forearm.plus(arm.shoulder.affine(-1.0, 0.0))
        } else if arm.elbow.is_bounded() {
            Interval::ALL
        } else {
            Interval::spanning(-PI, PI)
        };
        let Some(elbow) = arm.elbow.intersect(implied).filter(|range| range.is_bounded()) else {
            return Vec::new();
        };
        let first = (elbow.min() / PI).floor() as i64;
        let last = (elbow.max() / PI).ceil() as i64;
        let mut sides: Vec<Self> =
            (first..last).filter_map(|half_turn| Self::within(arm, elbow, half_turn, clear)).collect();
        // Usual postures first: they win where two sides are equally stiff.
        sides.sort_by_key(|side| (side.turn.abs() as i64, side.elbow == Elbow::Down));
        sides
    }

    /// The part of the elbow range between `half_turn` and `half_turn + 1` half turns.
    fn within(arm: &PlanarArm, elbow: Interval, half_turn: i64, clear: f64) -> Option<Self> {
        let start = half_turn as f64 * PI;
        let piece = elbow.intersect(Interval::new(start + clear, start + PI - clear)?)?;
        // A joint that cannot move leaves a line, which holds no zone.
        if [piece, arm.shoulder, arm.forearm].iter().any(|range| range.width() <= SLACK) {
            return None;
        }
        arm.shoulder.plus(piece).intersect(arm.forearm)?;
        let (side, turn) = if half_turn % 2 == 0 { (Elbow::Down, start) } else { (Elbow::Up, start + PI) };
        let folded_by = piece.affine(side.sign(), -side.sign() * turn); // |elbow|, 0 to pi
        let distance = |folded_by: f64| {
            let (s, c) = folded_by.sin_cos();
            (arm.l3 * s).hypot(arm.l2 + arm.l3 * c)
        };
        let ring = Interval::spanning(distance(folded_by.max()), distance(folded_by.min()));
        Some(Self {
            elbow: side,
            ring,
            shoulder: arm.shoulder,
            forearm: arm.forearm.affine(1.0, -turn),
            turn,
            l2: arm.l2,
            l3: arm.l3,
        })
    }

    /// No limit on the absolute angles: what is reached is the whole ring.
    pub fn is_whole_ring(&self) -> bool {
        self.shoulder.is_all() && self.forearm.is_all()
    }

    /// `(psi2, psi3)` at distance `r`: the angles of the triangle at the shoulder and at the wrist.
    fn triangle(&self, r: f64) -> (f64, f64) {
        let Self { l2, l3, .. } = *self;
        let c = ((r * r - l2 * l2 - l3 * l3) / (2.0 * l2 * l3)).clamp(-1.0, 1.0);
        let s = (1.0 - c * c).sqrt();
        ((l3 * s).atan2(l2 + l3 * c), (l2 * s).atan2(l3 + l2 * c))
    }

    /// Shoulder and elbow angle that put the wrist centre at `p`, within the limits, or `None`.
    pub fn posture(&self, p: Vector2<f64>) -> Option<(f64, f64)> {
        let r = p.norm();
        if !self.ring.contains(r, SLACK * self.l2) {
            return None;
        }
        let (psi2, psi3) = self.triangle(r);
        let s = self.elbow.sign();
        let allowed = self.turns(Interval::point(-s * psi2), Interval::point(s * psi3), SLACK)?;
        let bearing = allowed.turn_to(p.y.atan2(p.x), SLACK)?;
        Some((bearing - s * psi2, s * (psi2 + psi3) + self.turn))
    }

    /// The wrist centre can be put at `p` within the limits.
    pub fn reaches(&self, p: Vector2<f64>) -> bool {
        self.posture(p).is_some()
    }

    /// The upper arm as a vector, m, when the wrist centre stands at `p`; `None` beyond the links, or at the axis.
    ///
    /// Without an angle: `E = a p + b e x p` with `a = (r^2 + l2^2 - l3^2)/(2 r^2)` and `|E| = l2`.
    pub(crate) fn upper_arm(&self, p: Vector2<f64>) -> Option<Vector2<f64>> {
        let Self { l2, l3, .. } = *self;
        let t = p.norm_squared();
        let a = (t + l2 * l2 - l3 * l3) / (2.0 * t);
        let b = (l2 * l2 / t - a * a).max(0.0).sqrt();
        (0.0 < t && a * a * t <= l2 * l2 * (1.0 + SLACK)).then(|| {
            let across = -self.elbow.sign() * b;
            Vector2::new(a * p.x - across * p.y, a * p.y + across * p.x)
        })
    }

    /// The posture at a point that is reached but for rounding, without a look at the limits.
    pub(crate) fn posture_near(&self, p: Vector2<f64>) -> (f64, f64) {
        let (psi2, psi3) = self.triangle(p.norm());
        let s = self.elbow.sign();
        (p.y.atan2(p.x) - s * psi2, s * (psi2 + psi3))
    }

    /// Every turn `x` for which `x + shoulder` and `x + forearm` stay within the limits throughout.
    pub(crate) fn turns(&self, shoulder: Interval, forearm: Interval, slack: f64) -> Option<Interval> {
        let room = |limit: Interval, taken: Interval| (limit.min() - taken.min(), limit.max() - taken.max());
        Self::shared(room(self.shoulder, shoulder), room(self.forearm, forearm), slack)
    }

    /// Every turn `x` for which some angle in `x + shoulder` and some in `x + forearm` keep the limits.
    pub(crate) fn turns_touching(&self, shoulder: Interval, forearm: Interval, slack: f64) -> Option<Interval> {
        let room = |limit: Interval, taken: Interval| (limit.min() - taken.max(), limit.max() - taken.min());
        Self::shared(room(self.shoulder, shoulder), room(self.forearm, forearm), slack)
    }

    fn shared((a0, a1): (f64, f64), (b0, b1): (f64, f64), slack: f64) -> Option<Interval> {
        let (min, max) = (a0.max(b0), a1.min(b1));
        // A range narrower than nothing by rounding is the one value in its middle.
        if max < min && min - max <= slack {
            Some(Interval::point(f64::midpoint(min, max)))
        } else {
            Interval::new(min, max)
        }
    }

    /// The ranges that shoulder and forearm angle take over a figure that lies in the ring and leaves the axis outside.
    ///
    /// Continuous over the figure: angles are not folded into one turn.
    pub(crate) fn angles_over(&self, shape: &Shape) -> (Interval, Interval) {
        let s = self.elbow.sign();
        let centre = shape.centre();
        let heading = centre.y.atan2(centre.x);
        let bearing = |p: Vector2<f64>| heading + centre.perp(&p).atan2(centre.dot(&p));
        let mut shoulder = (f64::INFINITY, f64::NEG_INFINITY);
        let mut forearm = shoulder;
        if !self.shoulder.is_all() {
            shape.visit_extremes(self.l2, self.l3, |p| {
                let angle = bearing(p) - s * self.triangle(p.norm()).0;
                shoulder = (shoulder.0.min(angle), shoulder.1.max(angle));
            });
        }
        if !self.forearm.is_all() {
            shape.visit_extremes(self.l3, self.l2, |p| {
                let angle = bearing(p) + s * self.triangle(p.norm()).1;
                forearm = (forearm.0.min(angle), forearm.1.max(angle));
            });
        }
        let range = |(min, max)| Interval::new(min, max).unwrap_or(Interval::point(0.0));
        (range(shoulder), range(forearm))
    }

    /// What a figure that lies in the ring keeps from the limits of `arm`, whose side this is, and from stretched and folded; its own axes are
    /// turned by `turned`, rad, from those of the plane. `None` where it is not held.
    pub(crate) fn rooms_over(&self, arm: &PlanarArm, shape: &Shape, turned: f64) -> Option<Rooms> {
        /// A figure is placed up to this, rad or m, of its limits.
        const PLACED: f64 = 1e-6;
        let bent = |p: Vector2<f64>| {
            let (psi2, psi3) = self.triangle(p.norm());
            psi2 + psi3
        };
        let (near, far) = (shape.nearest(), shape.farthest());
        if !(self.ring.contains(near.norm(), PLACED) && self.ring.contains(far.norm(), PLACED)) {
            return None;
        }
        let fold = Interval::spanning(bent(far), bent(near));
        let (shoulder, forearm) = self.angles_over(shape);
        let by = self.turns(shoulder, forearm, PLACED)?.turn_to(turned, PLACED)?;
        let room = |limit: Interval, taken: Interval| limit.room(taken.min()).min(limit.room(taken.max())).max(0.0);
        Some(Rooms {
            shoulder: room(self.shoulder, shoulder.affine(1.0, by)),
            elbow: room(arm.elbow, fold.affine(self.elbow.sign(), self.turn)),
            forearm: room(self.forearm, forearm.affine(1.0, by)),
            straight: fold.min().min(PI - fold.max()).max(0.0),
        })
    }

    /// Ranges that hold shoulder and forearm angle at every point of a figure that the ring reaches; the axis outside.
    pub(crate) fn angles_around(&self, shape: &Shape) -> (Interval, Interval) {
        let Self { l2, l3, ring, .. } = *self;
        let bearings = shape.bearings();
        let near = shape.nearest().norm().clamp(ring.min(), ring.max());
        let far = shape.farthest().norm().clamp(ring.min(), ring.max());
        let (first, last) = (self.triangle(near), self.triangle(far));
        // Each angle of the triangle is largest where the link it belongs to stands at a right angle to the other side.
        let top = |a: f64, b: f64, inner: f64, outer: f64| {
            let range = Interval::spanning(a, b);
            let summit = (inner * inner - outer * outer).max(0.0).sqrt();
            if outer < inner && near < summit && summit < far {
                Interval::spanning(range.min(), (outer / inner).asin())
            } else {
                range
            }
        };
        let s = self.elbow.sign();
        let (psi2, psi3) = (top(first.0, last.0, l2, l3), top(first.1, last.1, l3, l2));
        (bearings.plus(psi2.affine(-s, 0.0)), bearings.plus(psi3.affine(s, 0.0)))
    }

    /// The largest sine of the elbow angle at these distances.
    pub(crate) fn largest_sine(&self, distances: Interval) -> f64 {
        let bent = |r: f64| {
            let (psi2, psi3) = self.triangle(r);
            psi2 + psi3
        };
        Interval::spanning(bent(distances.max()), bent(distances.min())).clamp(PI / 2.0).sin()
    }

    /// Centres and radii of the circles on which the boundary of the reached set lies, m.
    pub(crate) fn boundary_circles(&self) -> Vec<(Vector2<f64>, f64)> {
        let at = |length: f64, angle: f64| length * Vector2::new(angle.cos(), angle.sin());
        let mut circles = vec![(Vector2::zeros(), self.ring.min()), (Vector2::zeros(), self.ring.max())];
        for (limit, inner, outer) in [(self.shoulder, self.l2, self.l3), (self.forearm, self.l3, self.l2)] {
            circles.extend(
                [limit.min(), limit.max()].into_iter().filter(|x| x.is_finite()).map(|x| (at(inner, x), outer)),
            );
        }
        circles
    }
}
