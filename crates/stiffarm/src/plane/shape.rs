//! A convex figure in the arm plane: how near, how far, and which points turn an arm most?

use nalgebra::Vector2;

use crate::interval::Interval;

/// A disc or an axis-parallel rectangle, m; either may have shrunk to a point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    /// Centre and radius.
    Disc(Vector2<f64>, f64),
    /// Centre and half sides.
    Rectangle(Vector2<f64>, Vector2<f64>),
}

impl Shape {
    pub(crate) fn centre(&self) -> Vector2<f64> {
        match *self {
            Self::Disc(centre, _) | Self::Rectangle(centre, _) => centre,
        }
    }

    /// The same figure with its boundary drawn in by `by`.
    pub(crate) fn shrunk(&self, by: f64) -> Self {
        match *self {
            Self::Disc(centre, radius) => Self::Disc(centre, (radius - by).max(0.0)),
            Self::Rectangle(centre, half) => Self::Rectangle(centre, half.map(|h| (h - by).max(0.0))),
        }
    }

    /// The point nearest to the origin: the origin itself where it lies inside.
    pub(crate) fn nearest(&self) -> Vector2<f64> {
        match *self {
            Self::Disc(centre, radius) => {
                let distance = centre.norm();
                if distance <= radius { Vector2::zeros() } else { centre * (1.0 - radius / distance) }
            }
            Self::Rectangle(centre, half) => {
                let clamp = |c: f64, h: f64| 0_f64.clamp(c - h, c + h);
                Vector2::new(clamp(centre.x, half.x), clamp(centre.y, half.y))
            }
        }
    }

    /// The point farthest from the origin.
    pub(crate) fn farthest(&self) -> Vector2<f64> {
        match *self {
            Self::Disc(centre, radius) => {
                let distance = centre.norm();
                if distance == 0.0 { Vector2::new(radius, 0.0) } else { centre * (1.0 + radius / distance) }
            }
            Self::Rectangle(centre, half) => {
                Vector2::new(centre.x + half.x.copysign(centre.x), centre.y + half.y.copysign(centre.y))
            }
        }
    }

    /// Of a rectangle.
    pub(crate) fn corners(&self) -> Option<[Vector2<f64>; 4]> {
        match *self {
            Self::Disc(..) => None,
            Self::Rectangle(centre, half) => Some(corners(centre, half)),
        }
    }

    /// The origin lies inside, deeper than `slack`.
    pub(crate) fn covers_origin(&self, slack: f64) -> bool {
        match *self {
            Self::Disc(centre, radius) => centre.norm() < radius - slack,
            Self::Rectangle(centre, half) => centre.x.abs() < half.x - slack && centre.y.abs() < half.y - slack,
        }
    }

    /// The range of bearings from the origin, which lies outside; continuous, about the bearing of the centre.
    pub(crate) fn bearings(&self) -> Interval {
        let centre = self.centre();
        let heading = centre.y.atan2(centre.x);
        match *self {
            Self::Disc(_, radius) => {
                let half = (radius / centre.norm()).min(1.0).asin();
                Interval::spanning(heading - half, heading + half)
            }
            Self::Rectangle(_, half) => corners(centre, half)
                .map(|p| heading + centre.perp(&p).atan2(centre.dot(&p)))
                .into_iter()
                .fold(Interval::point(heading), |range, bearing| {
                    Interval::spanning(range.min().min(bearing), range.max().max(bearing))
                }),
        }
    }

    /// Visits points of the figure among which the angle of the inner link takes its extremes.
    ///
    /// The angle is that of a link of length `inner` from the origin, with a link of length `outer` from its end to the
    /// point. It has no stationary point inside a figure, so its extremes are vertices or points where the boundary
    /// touches a circle of radius `outer` about an end of the inner link:
    /// for an edge `n.p = h` the end lies at `n.E = h -+ outer`, for a circle at `|E - centre| = |outer +- radius|`.
    pub(crate) fn visit_extremes(&self, inner: f64, outer: f64, mut visit: impl FnMut(Vector2<f64>)) {
        match *self {
            Self::Disc(centre, radius) => {
                visit(centre);
                let distance = centre.norm();
                if distance == 0.0 || radius == 0.0 {
                    return;
                }
                let (along, across) = (centre / distance, Vector2::new(-centre.y, centre.x) / distance);
                visit(centre + radius * across);
                visit(centre - radius * across);
                if (distance - radius).abs() <= super::SLACK * inner {
                    // The boundary runs through the origin: the bearings just beside it are a half turn apart.
                    const BESIDE: f64 = 1e-8;
                    for side in [BESIDE, -BESIDE] {
                        visit(centre + radius * (side.sin() * across - side.cos() * along));
                    }
                }
                for reach in [outer + radius, outer - radius] {
                    let a = (inner * inner + distance * distance - reach * reach) / (2.0 * distance);
                    let b = (inner * inner - a * a).max(0.0).sqrt();
                    for b in [b, -b] {
                        let end = a * along + b * across;
                        let out = end - centre;
                        let norm = out.norm();
                        if 0.0 < norm {
                            visit(centre + out * (radius / norm));
                            visit(centre - out * (radius / norm));
                        }
                    }
                }
            }
            Self::Rectangle(c, half) => {
                for (sx, sy) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                    visit(Vector2::new(c.x + sx * half.x, c.y + sy * half.y));
                }
                for sign in [1.0, -1.0] {
                    touching_heights(c.x + sign * half.x, c.y, half.y, inner, outer, |x, y| visit(Vector2::new(x, y)));
                    touching_heights(c.y + sign * half.y, c.x, half.x, inner, outer, |y, x| visit(Vector2::new(x, y)));
                }
            }
        }
    }
}

/// Of a rectangle, by its centre and half sides.
fn corners(centre: Vector2<f64>, half: Vector2<f64>) -> [Vector2<f64>; 4] {
    [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(sx, sy)| Vector2::new(centre.x + sx * half.x, centre.y + sy * half.y))
}

/// The places `y` on the edge `x = h`, `|y - middle| <= half`, where a circle of radius `outer` touches it whose centre
/// lies `inner` from the origin; and, where the edge runs through the origin, the places just beside the origin.
fn touching_heights(h: f64, middle: f64, half: f64, inner: f64, outer: f64, mut visit: impl FnMut(f64, f64)) {
    for x in [h - outer, h + outer] {
        let square = inner * inner - x * x;
        // At the rim of what the arm reaches, where both links line up, rounding may go below zero.
        if -super::SLACK * inner * inner <= square {
            let y = square.max(0.0).sqrt();
            for y in [y, -y] {
                if (y - middle).abs() <= half {
                    visit(h, y);
                }
            }
        }
    }
    if h.abs() <= super::SLACK * inner {
        let beside = 10.0 * super::SLACK * inner;
        for y in [beside, -beside] {
            if (y - middle).abs() <= half {
                visit(h, y);
            }
        }
    }
}
