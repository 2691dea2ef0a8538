//! The worst deflection inside a zone, and at all places of a box, under a force of which the direction is known.
//!
//! Then the compliance is no function of the distance from the joint-2 axis alone. With the wrist centre at `p` from that axis, the elbow at
//! `u = a p + b e x p` and the forearm `g = p - u`, drives move it along `e x p` (drive 2 of a serial arm), `e x u` (of a parallelogram) and
//! `e x g`; one formula serves numbers, and affine forms over a part of the zone or over a box of places.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2};

use super::boxes::{Node, Spot, Worst};
use super::turned;
use crate::drive::Architecture;
use crate::enclose::{Affine, Line, NodeBounds, add_squares, least_largest, sin_cos};
use crate::frontier::{self, Frontier};
use crate::interval::Interval;
use crate::load::Sector;
use crate::plane::{Elbow, PlanarArm};
use crate::real::Real;
use crate::task::Zone;

/// How well the worst point of a zone is found: relative distance of what is proved to what is found, and parts of the zone after which the search
/// for it ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    gap: f64,
    most_parts: usize,
    /// What is proved is reported, rather than what is found.
    is_proved: bool,
}

impl Effort {
    /// While places are compared. A place that seems a little better than it is makes no bound wrong: boxes are then given up for places that
    /// have to be better still.
    pub(super) const SEARCH: Self = Self { gap: 1e-5, most_parts: 100, is_proved: false };
    /// For the answer.
    pub(super) const ANSWER: Self = Self { gap: 1e-7, most_parts: 20_000, is_proved: true };
}

/// Points along each side of a zone, or over a quarter of a circle, at which places of a box are compared.
const ALONG: usize = 4;
/// How far beyond its reach a point may seem to lie where it is reached but for rounding and the slack of limits: part of a squared length.
const BEYOND: f64 = 1e-8;
/// Relative allowance for the rounding of a bound.
const ROUNDING: f64 = 1e-10;

/// The compliance under a sector of forces, m/N.
#[derive(Clone, Copy, Debug)]
pub(super) struct Directed {
    /// Squared length of the upper arm, m^2, and half of what that of the forearm lacks.
    upper_square: f64,
    kappa: f64,
    k2: f64,
    k3: f64,
    architecture: Architecture,
    sector: Sector,
}

impl Directed {
    pub(super) fn new(arm: &PlanarArm, sector: Sector) -> Self {
        Self {
            upper_square: arm.l2 * arm.l2,
            kappa: (arm.l2 * arm.l2 - arm.l3 * arm.l3) / 2.0,
            k2: arm.k2,
            k3: arm.k3,
            architecture: arm.architecture,
            sector,
        }
    }

    /// What counts with the wrist centre at a point from the joint-2 axis, m/N.
    pub(super) fn at(&self, elbow: Elbow, p: Vector2<f64>) -> f64 {
        self.sector.largest(&self.compliance(elbow, p)).value
    }

    fn compliance(&self, elbow: Elbow, p: Vector2<f64>) -> Matrix2<f64> {
        let inverse = 1.0 / p.norm_squared();
        let part = 0.5 + self.kappa * inverse;
        let height = (self.upper_square * inverse - part * part).max(0.0).sqrt();
        let [second, third] = self.columns(elbow, p.into(), part, height).map(Vector2::from);
        second * second.transpose() * self.k2 + third * third.transpose() * self.k3
    }

    /// What turning drive 2 and drive 3 by 1 rad moves the wrist centre by, m, with `a` and the amount of `b`.
    fn columns<T: Real>(&self, elbow: Elbow, [x, z]: [T; 2], part: T, height: T) -> [[T; 2]; 2] {
        let height = height * -elbow.sign();
        let upper = [part * x + -(height * z), part * z + height * x];
        let fore = [x + -upper[0], z + -upper[1]];
        let across = |[x, z]: [T; 2]| [-z, x];
        let second = match self.architecture {
            Architecture::Serial => [x, z],
            Architecture::QuasiSerial => upper,
        };
        [across(second), across(fore)]
    }

    /// The same over all values of the variables at which the point is reached, and a number that is not negative there; what lies beyond counts as
    /// the rim. `None` where nothing is known.
    fn enclosed<const N: usize>(&self, elbow: Elbow, p: [Affine<N>; 2]) -> Option<([[Affine<N>; 2]; 2], Affine<N>)> {
        let square = p[0].square() + p[1].square();
        if !(0.0 < square.min()) {
            return None;
        }
        let inverse = square.inverse(Interval::POSITIVE)?;
        let part = inverse * self.kappa + 0.5;
        let square = inverse * self.upper_square - part.square();
        let height = square.sqrt().unwrap_or(Affine::point(0.0));
        Some((self.columns(elbow, p, part, height), square))
    }

    /// An upper bound on what counts over all values of the variables, m/N, and at which ends of them it seems to be greatest.
    ///
    /// What counts, or its square, is a convex function of the entries of the form whose greatest value is searched for: of their linear parts it is
    /// greatest at a corner of the variables, and what is left over adds no more than its own greatest value.
    fn most(&self, elbow: Elbow, p: [Affine<2>; 2]) -> (f64, [f64; 2]) {
        let unknown = (f64::INFINITY, [0.0; 2]);
        let Some((columns, _)) = self.enclosed(elbow, p) else { return unknown };
        let (x, z) = (self.sector.middle.x, self.sector.middle.y);
        let entries = |k: f64, [cx, cz]: [Affine<2>; 2]| {
            let (along, across) = (cx * x + cz * z, cz * x + cx * -z);
            [along.square() * k, along * across * k, across.square() * k]
        };
        let [second, third] = [entries(self.k2, columns[0]), entries(self.k3, columns[1])];
        let [along, mixed, across] = [0, 1, 2].map(|i| second[i] + third[i]);
        let form = if self.sector.is_along {
            [along, mixed, across]
        } else {
            [along.square() + mixed.square(), mixed * (along + across), across.square() + mixed.square()]
        };
        if form.iter().any(Affine::is_unknown) {
            return unknown;
        }
        let at = |[a, b]: [f64; 2]| form.map(|x| x.centre + a * x.deviations[0] + b * x.deviations[1]);
        let corners =
            [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|end| (self.sector.most_of(at(end)), end));
        let (linear, end) = corners.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).expect("four corners");
        let [r_along, r_mixed, r_across] = form.map(|x| x.remainder);
        let left = ((r_along + r_across) + (r_along + r_across).hypot(2.0 * r_mixed)) / 2.0;
        let most = (linear + left) * (1.0 + ROUNDING);
        (if self.sector.is_along { most } else { most.max(0.0).sqrt() }, end)
    }

    /// The worst point inside a zone that is reached throughout, or a point that is as compliant as `enough` or more.
    ///
    /// Branch and bound over the zone.
    pub(super) fn worst(
        &self,
        elbow: Elbow,
        zone: Zone,
        spot: &Spot,
        enough: f64,
        effort: Effort,
    ) -> Result<Worst, Worst> {
        let mut best = Worst { compliance: f64::NEG_INFINITY, point: spot.centre };
        let look = |best: &mut Worst, point: Vector2<f64>| {
            let point = spot.centre + point;
            let compliance = self.at(elbow, turned(point, spot.turn));
            if best.compliance < compliance {
                *best = Worst { compliance, point };
            }
        };
        for point in points(zone) {
            look(&mut best, point);
        }
        let mut queue: Frontier<Part> =
            Part::all(zone).into_iter().map(|part| part.bounded(self, elbow, zone, spot)).collect();
        let mut parts = 0;
        while let Some(part) = queue.pop() {
            parts += 1;
            if enough <= best.compliance {
                return Err(best);
            }
            if part.most <= best.compliance * (1.0 + effort.gap) || effort.most_parts < parts {
                if effort.is_proved {
                    best.compliance = best.compliance.max(part.most);
                }
                break;
            }
            look(&mut best, part.point(zone));
            queue.extend(part.halves(zone).map(|half| {
                let half = half.bounded(self, elbow, zone, spot);
                Part { most: half.most.min(part.most), ..half }
            }));
        }
        if best.compliance < enough { Ok(best) } else { Err(best) }
    }

    /// A lower bound on the worst compliance of every place in a box, m/N: the largest at a few points of the zone, by weak duality.
    pub(super) fn least(&self, elbow: Elbow, node: &Node, samples: &[Vector2<f64>]) -> f64 {
        let (u, v) = (variable::<3>(node.u, 0), variable::<3>(node.v, 1));
        let (s, c): (Affine<3>, Affine<3>) = sin_cos(node.turn, 2);
        let middle = Vector2::new(node.u.middle(), node.v.middle());
        let mut bounds = NodeBounds::default();
        for sample in samples {
            let (u, v) = (u + sample.x, v + sample.y);
            let Some((columns, reached)) = self.enclosed(elbow, [c * u + -(s * v), s * u + c * v]) else { continue };
            let most = self.sector.largest(&self.compliance(elbow, turned(middle + sample, node.turn.middle())));
            let along = |by: Vector2<f64>| columns.map(|column| column[0] * by.x + column[1] * by.y);
            let (pushed, moved) = (along(most.force), along(most.counted));
            let compliances = [self.k2, self.k3].map(Affine::point);
            // What the force moves along itself is no more than all that it moves, and each drive's part of it is not negative.
            add_squares(&[(compliances[0], pushed[0]), (compliances[1], pushed[1])], &mut bounds);
            if !self.sector.is_along {
                bounds.values.push(pushed[0] * moved[0] * self.k2 + pushed[1] * moved[1] * self.k3);
            }
            if reached.min() < 0.0 {
                // Where the arm is all but straight, what lies beyond its reach would seem the best.
                bounds.limits.push(reached + BEYOND);
            }
        }
        let values: Vec<Line<3>> = bounds.values.iter().filter_map(Line::below).collect();
        let limits: Vec<Line<3>> = bounds.limits.iter().filter_map(Line::allowing).collect();
        least_largest(&values, &limits) * (1.0 - ROUNDING)
    }
}

/// Points of a zone from its centre at which places are compared.
pub(super) fn points(zone: Zone) -> Vec<Vector2<f64>> {
    let around = match zone {
        Zone::Circle { diameter } => {
            let at = |i: usize| diameter / 2.0 * direction(TAU * i as f64 / (4 * ALONG) as f64);
            (0..4 * ALONG).map(at).collect::<Vec<_>>()
        }
        Zone::Rectangle { width, height } => {
            let half = Vector2::new(width, height) / 2.0;
            let steps = || (0..ALONG).map(|i| 2.0 * i as f64 / ALONG as f64 - 1.0);
            let sides = steps().flat_map(|t| [[t, -1.0], [1.0, t], [-t, 1.0], [-1.0, -t]]);
            sides.map(|[a, b]| half.component_mul(&Vector2::new(a, b))).collect()
        }
    };
    around.into_iter().chain([Vector2::zeros()]).collect()
}

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(angle.cos(), angle.sin())
}

/// A number that variable `variable` carries through an interval.
fn variable<const N: usize>(interval: Interval, variable: usize) -> Affine<N> {
    let mut deviations = [0.0; N];
    deviations[variable] = interval.width() / 2.0;
    Affine { centre: interval.middle(), deviations, remainder: 0.0 }
}

/// Part of a zone, in two coordinates: from the centre along both sides, or radius and bearing.
#[derive(Clone, Copy, Debug)]
struct Part {
    most: f64,
    /// Where in it the worst point is looked for: -1 to 1 along either range.
    end: [f64; 2],
    ranges: [Interval; 2],
}

impl frontier::Node for Part {
    /// The largest comes first.
    fn key(&self) -> [f64; 2] {
        [-self.most, 0.0]
    }
}

impl Part {
    /// The whole, cut so that bearings may be enclosed.
    fn all(zone: Zone) -> Vec<Self> {
        let part =
            |first: Interval, second: Interval| Self { most: f64::INFINITY, end: [0.0; 2], ranges: [first, second] };
        match zone {
            Zone::Circle { diameter } => {
                let radii = Interval::spanning(0.0, diameter / 2.0);
                let bearings = |i: u8| Interval::spanning(TAU * f64::from(i) / 8.0, TAU * f64::from(i + 1) / 8.0);
                (0..8).map(|i| part(radii, bearings(i))).collect()
            }
            Zone::Rectangle { width, height } => {
                let side = |length: f64| Interval::spanning(-length / 2.0, length / 2.0);
                vec![part(side(width), side(height))]
            }
        }
    }

    /// Its point that seems to be the worst, from the centre of the zone.
    fn point(&self, zone: Zone) -> Vector2<f64> {
        let [first, second] = [0, 1].map(|i| self.ranges[i].middle() + self.end[i] * self.ranges[i].width() / 2.0);
        match zone {
            Zone::Circle { .. } => first * direction(second),
            Zone::Rectangle { .. } => Vector2::new(first, second),
        }
    }

    /// The halves across the longer range; a bearing counts as the way it moves the rim of this part.
    fn halves(&self, zone: Zone) -> [Self; 2] {
        let [first, second] = self.ranges;
        let lever = if zone.is_round() { first.max() } else { 1.0 };
        let i = usize::from(first.width() < second.width() * lever);
        self.ranges[i].halves().map(|half| {
            let mut ranges = self.ranges;
            ranges[i] = half;
            Self { ranges, ..*self }
        })
    }

    /// The same with the most that counts anywhere in it, m/N.
    fn bounded(self, directed: &Directed, elbow: Elbow, zone: Zone, spot: &Spot) -> Self {
        let [first, second] = [0, 1].map(|i| variable::<2>(self.ranges[i], i));
        let [u, v] = match zone {
            Zone::Rectangle { .. } => [first, second],
            Zone::Circle { .. } => {
                let (s, c) = sin_cos(self.ranges[1], 1);
                [first * c, first * s]
            }
        };
        let (u, v) = (u + spot.centre.x, v + spot.centre.y);
        let (sin, cos) = spot.turn.sin_cos();
        let (most, end) = directed.most(elbow, [u * cos + v * -sin, u * sin + v * cos]);
        Self { most, end, ..self }
    }
}
