//! At which link ratio is a zone held best, and what proves it?

use super::Contender;
use crate::interval::Interval;
use crate::place::best_near;
use crate::plane::{PlanarArm, RadialCompliance, support};
use crate::root::minimum;
use crate::task::Zone;

/// No ratio has less than the best that is found by more than this, relative.
const GAP: f64 = 1e-9;
/// Ratios that differ by less, as shares `l3/(l2 + l3)`, are one.
const SAME: f64 = 1e-13;
/// Shares within this of the best one found are looked at again.
const NEAR_BY: f64 = 1e-3;

/// A zone that stands symmetrically about a ray from the joint-2 axis, lengths over `l2 + l3`.
#[derive(Clone, Copy, Debug)]
pub(super) struct SymmetricPlace<'a> {
    contender: &'a Contender,
    depth: f64,
    half_width: f64,
    /// The nearest distance at which the far corners lie on the rim: nothing stands farther out.
    outermost: f64,
}

impl<'a> SymmetricPlace<'a> {
    /// The ways of standing that some link ratio allows.
    pub(super) fn all(contender: &'a Contender, zone: Zone) -> impl Iterator<Item = Self> {
        zone.symmetric_places().filter_map(move |(depth, half_width)| {
            let outermost = (1.0 - half_width * half_width).sqrt() - depth;
            (0.0 <= outermost).then_some(Self { contender, depth, half_width, outermost })
        })
    }

    /// The shares `x = l3/(l2 + l3)` of the forearm with which it fits: the arm folds to `|1 - 2x| <= outermost`.
    fn shares(&self) -> Interval {
        Interval::spanning((1.0 - self.outermost) / 2.0, f64::midpoint(1.0, self.outermost))
    }

    fn arm(&self, x: f64) -> PlanarArm {
        let Contender { architecture, k2, k3 } = *self.contender;
        PlanarArm::free(1.0 - x, x, k2, k3, architecture)
    }

    fn far(&self, near: f64) -> f64 {
        (near + self.depth).hypot(self.half_width)
    }

    /// The distance of the nearest point to which the arm can fold; at the last share that fits it is `outermost`.
    fn folded(&self, x: f64) -> f64 {
        (1.0 - 2.0 * x).abs().min(self.outermost)
    }

    fn near(&self, sigma: &RadialCompliance, x: f64) -> f64 {
        best_near(sigma, Interval::spanning(self.folded(x), self.outermost), |near| self.far(near))
    }

    /// The accuracy with a forearm of share `x`, where it fits.
    pub(super) fn accuracy(&self, x: f64) -> Option<f64> {
        self.shares().contains(x, SAME).then(|| self.judged(x).accuracy)
    }

    fn judged(&self, x: f64) -> Judged {
        let sigma = self.arm(x).radial();
        let near = self.near(&sigma, x);
        Judged { x, near, accuracy: sigma.at(near).max(sigma.at(self.far(near))) }
    }

    /// A value that no share between two judged ones, both up to 1/2 or both from it, falls below.
    ///
    /// Let `n(x)` be any line, here that of the best near ends. Every place with a share `x` in between either is nearer
    /// than `n(x)`, and then its near end is no stiffer than a plane under sigma that falls with the distance has it at
    /// `n(x)`; or it is farther, and then the same holds of its far end and a plane that rises. Planes are linear in the
    /// squares of distance and lengths, which are squares of lines in `x`: parabolas, whose least values are known.
    fn bound(&self, [a, b]: &[Judged; 2]) -> f64 {
        let arm_at = |s: f64| self.arm(a.x + (b.x - a.x) * s);
        let near_at = |s: f64| a.near + (b.near - a.near) * s;
        let middle = arm_at(0.5);
        let least = |end: &dyn Fn(f64) -> f64, by_distance: &dyn Fn(f64, f64) -> f64| {
            let g = support(&middle, end(0.5));
            let parabola = |s: f64| {
                let arm = arm_at(s);
                by_distance(g.x, end(s)) + g.y * arm.l2 * arm.l2 + g.z * arm.l3 * arm.l3
            };
            least_of_parabola([0.0, 0.5, 1.0].map(parabola))
        };
        let is_folded = [a, b].iter().all(|end| end.near == self.folded(end.x));
        let is_outermost = [a, b].iter().all(|end| end.near == self.outermost);
        let far_at = |s: f64| self.far(near_at(s));
        // A plane that slopes the other way is as low as at the axis, or as at the rim.
        let falling = |slope: f64, end: f64| slope.min(0.0) * end * end;
        let rising = |slope: f64, end: f64| slope.max(0.0) * end * end + slope.min(0.0);
        let nearer = if is_folded { f64::INFINITY } else { least(&near_at, &falling) };
        let farther = if is_outermost { f64::INFINITY } else { least(&far_at, &rising) };
        nearer.min(farther)
    }
}

/// The best accuracy with a forearm of share `x`.
#[derive(Clone, Copy, Debug)]
struct Judged {
    x: f64,
    near: f64,
    accuracy: f64,
}

/// The share of the forearm, among `shares`, with the best accuracy, and that accuracy; `None` where the zone fits with none.
///
/// Branch and bound: intervals of shares are halved until no bound lies below the best found by more than [`GAP`].
pub(super) fn best<'a>(contender: &'a Contender, zone: Zone, shares: Interval) -> Option<(f64, f64)> {
    let mut best: Option<(SymmetricPlace<'a>, Judged)> = None;
    let mut better = |place: SymmetricPlace<'a>, judged: Judged| {
        if best.is_none_or(|(_, best)| judged.accuracy < best.accuracy) {
            best = Some((place, judged));
        }
        best.map_or(f64::INFINITY, |(_, best)| best.accuracy)
    };
    let mut open: Vec<(SymmetricPlace, [Judged; 2])> = Vec::new();
    for place in SymmetricPlace::all(contender, zone) {
        let Some(fitting) = place.shares().intersect(shares) else { continue };
        for half in [Interval::spanning(0.0, 0.5), Interval::spanning(0.5, 1.0)] {
            let Some(part) = fitting.intersect(half) else { continue };
            let ends = [part.min(), part.max()].map(|x| place.judged(x));
            for end in ends {
                better(place, end);
            }
            open.push((place, ends));
        }
    }
    while !open.is_empty() {
        let mut halves = Vec::new();
        for (place, [a, b]) in open {
            let middle = place.judged(f64::midpoint(a.x, b.x));
            let least = better(place, middle);
            let parts = [[a, middle], [middle, b]];
            let is_open = |part: &[Judged; 2]| SAME < part[1].x - part[0].x && place.bound(part) < least * (1.0 - GAP);
            halves.extend(parts.into_iter().filter(is_open).map(|part| (place, part)));
        }
        open = halves;
    }
    // The floor of a valley is flat: the value is known to more digits than the share at which it lies.
    let (place, found) = best?;
    let near_by = Interval::spanning(found.x - NEAR_BY, found.x + NEAR_BY);
    let near_by = place.shares().intersect(shares)?.intersect(near_by)?;
    let polished = minimum(near_by.min(), near_by.max(), |x| place.judged(x).accuracy);
    Some(if polished.1 < found.accuracy { polished } else { (found.x, found.accuracy) })
}

/// The least value between 0 and 1 of a parabola with these values at 0, 1/2 and 1.
fn least_of_parabola([start, middle, end]: [f64; 3]) -> f64 {
    let square = 2.0 * (start + end) - 4.0 * middle;
    let slope = end - start - square;
    let lowest = -slope / (2.0 * square);
    let ends = start.min(end);
    if 0.0 < square && 0.0 < lowest && lowest < 1.0 { ends.min(start + slope * lowest / 2.0) } else { ends }
}
