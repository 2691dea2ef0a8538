//! Where does a zone stand best on one elbow side when only the ring of distances limits it? In closed form but one root.

use crate::interval::Interval;
use crate::plane::RadialCompliance;
use crate::root::root;
use crate::task::Zone;

/// A zone standing symmetrically about a ray from the joint-2 axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct SymmetricPlace {
    /// `max(sigma(near), sigma(far))`, m/N.
    pub(super) compliance: f64,
    /// Distance from the axis to the centre, m.
    pub(super) distance: f64,
    /// The first side stands across the ray.
    pub(super) across: bool,
}

/// The two symmetrical ways of standing, the better first, each at its best distance; without those that do not fit.
///
/// For a given nearest distance `n` no way of standing has a nearer farthest point than a symmetrical one,
/// `far(n) = hypot(n + depth, half_width)`.
pub(super) fn symmetric_places(sigma: &RadialCompliance, ring: Interval, zone: Zone) -> Vec<SymmetricPlace> {
    let mut symmetric_places: Vec<SymmetricPlace> = zone
        .symmetric_places()
        .zip([false, true])
        .filter_map(|((depth, half_width), across)| {
            let far = |near: f64| (near + depth).hypot(half_width);
            let farthest_near = (ring.max().powi(2) - half_width.powi(2)).sqrt() - depth;
            let nears = Interval::new(ring.min(), farthest_near)?;
            let near = best_near(sigma, nears, far);
            let compliance = sigma.at(near).max(sigma.at(far(near)));
            Some(SymmetricPlace { compliance, distance: near + depth / 2.0, across })
        })
        .collect();
    symmetric_places.sort_by(|a, b| a.compliance.total_cmp(&b.compliance));
    symmetric_places
}

/// The best of the nearest distances `nears`, m, of a zone that reaches out to `far` of it.
///
/// `sigma(far(n)) - sigma(n)` changes sign once, from minus to plus: before, moving outwards helps, after, it hurts. So the
/// best `n` is that root, or the end of the range nearest to it.
pub(crate) fn best_near(sigma: &RadialCompliance, nears: Interval, far: impl Fn(f64) -> f64) -> f64 {
    let worse_outside = |near: f64| sigma.at(far(near)) - sigma.at(near);
    if 0.0 <= worse_outside(nears.min()) {
        nears.min()
    } else if worse_outside(nears.max()) <= 0.0 {
        nears.max()
    } else {
        root(nears.min(), nears.max(), worse_outside)
    }
}

/// The largest scale at which the zone fits the ring in some orientation.
///
/// It stands as near as it can: `hypot(n + s depth, s half_width) = far`, a quadratic in `s`.
pub(super) fn largest_scale(ring: Interval, zone: Zone) -> f64 {
    let (near, far) = (ring.min(), ring.max());
    zone.symmetric_places()
        .map(|(depth, half_width)| {
            let a = depth * depth + half_width * half_width;
            let b = near * depth;
            let c = far * far - near * near;
            c / (b + (b * b + a * c).sqrt())
        })
        .fold(0.0, f64::max)
}
