//! The largest compliance as a function of the distance from the joint-2 axis: one valley, in closed form.

use super::PlanarArm;
use crate::drive::Architecture;

/// `sigma(r)`, m/N: the paper's eq. (1) at distance `r` from the joint-2 axis, for any `k2`, `k3`.
///
/// With `t = r^2`, `T` the trace and `D` the determinant of the planar compliance (\[theory\], section 2),
///
/// ```text
/// sigma = (T + sqrt(T^2 - 4 D)) / 2
///       = (T0 + T1 t)/2 + sqrt(a (t - t0)^2 + e)
///                 serial                          quasi-serial
///   T0, T1        k3 l3^2, k2                     k2 l2^2 + k3 l3^2, 0
///   4 a           k2 (k2 + k3)                    k2 k3
///   t0            k3 l2^2 / (k2 + k3)             l2^2 + l3^2
///   4 e           k3/(k2 + k3) ((k2+k3) l3^2 - k2 l2^2)^2     (k2 l2^2 - k3 l3^2)^2
/// ```
///
/// Both squares are complete, so nothing cancels, and `sigma` is convex in `t` (a line plus a hyperbola): one valley.
/// Its floor is, for a serial arm with `(k2 + k3) l3^2 >= k2 l2^2`, `k3 l3^2` at `t = l2^2 - l3^2`; with a shorter
/// forearm `k2 k3 l2^2/(k2 + k3)` at `t = l3^2 + l2^2 (k3 - k2)/(k2 + k3)`; for a quasi-serial arm
/// `max(k2 l2^2, k3 l3^2)` at `t = l2^2 + l3^2`; always as far as the arm folds and stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialCompliance {
    /// `T0/2`, m/N.
    pub half_trace_0: f64,
    /// `T1/2`, 1/(N m).
    pub half_trace_1: f64,
    /// `a`.
    pub a: f64,
    /// `t0`, m^2.
    pub t0: f64,
    /// `e`.
    pub e: f64,
    /// Where the valley lies, as a distance, m.
    valley: f64,
    /// The arm folded, m.
    pub folded: f64,
    /// The arm stretched, m.
    pub stretched: f64,
}

impl RadialCompliance {
    pub(super) fn of(arm: &PlanarArm) -> Self {
        let &PlanarArm { l2, l3, k2, k3, .. } = arm;
        let (folded, stretched) = ((l2 - l3).abs(), l2 + l3);
        let (a2, a3) = (l2 * l2, l3 * l3);
        let (half_trace_0, half_trace_1, a, t0, e, valley_t) = match arm.architecture {
            Architecture::Serial => {
                let k = k2 + k3;
                let root = k * a3 - k2 * a2;
                let t0 = k3 * a2 / k;
                (k3 * a3 / 2.0, k2 / 2.0, k2 * k / 4.0, t0, k3 / k * root * root / 4.0, t0 - root.abs() / k)
            }
            Architecture::QuasiSerial => {
                let root = k2 * a2 - k3 * a3;
                let t0 = a2 + a3;
                (f64::midpoint(k2 * a2, k3 * a3), 0.0, k2 * k3 / 4.0, t0, root * root / 4.0, t0)
            }
        };
        let valley = valley_t.max(0.0).sqrt().max(folded).min(stretched);
        Self { half_trace_0, half_trace_1, a, t0, e, valley, folded, stretched }
    }

    /// `sigma` at distance `r`, m.
    pub fn at(&self, r: f64) -> f64 {
        self.at_square(r * r)
    }

    /// `sigma` at `t = r^2`.
    #[inline]
    pub(crate) fn at_square(&self, t: f64) -> f64 {
        let u = t - self.t0;
        self.half_trace_0 + self.half_trace_1 * t + (self.a * u * u + self.e).sqrt()
    }

    /// The distance at which the arm is stiffest, m.
    pub fn valley(&self) -> f64 {
        self.valley
    }

    /// The least `sigma` at any posture: no placement of anything can beat it.
    pub fn floor(&self) -> f64 {
        self.at(self.valley)
    }

    /// The least `sigma` over the distances `near..=far`.
    pub(crate) fn least(&self, near: f64, far: f64) -> f64 {
        self.at(self.valley.max(near).min(far))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn arms() -> impl Iterator<Item = PlanarArm> {
        let lengths = [(1.0, 0.8), (1.0, 1.0), (0.8, 1.2), (1.0, 0.5), (1.5, 0.6), (1.0, 0.3)];
        let springs = [(1e-6, 1e-6), (0.3e-6, 2e-6), (2e-6, 0.3e-6)];
        lengths.into_iter().flat_map(move |(l2, l3)| {
            springs.into_iter().flat_map(move |(k2, k3)| {
                Architecture::ALL.map(|architecture| PlanarArm::free(l2, l3, k2, k3, architecture))
            })
        })
    }

    #[test]
    fn sigma_of_the_distance_is_the_largest_eigenvalue_of_the_compliance() {
        for arm in arms() {
            let sigma = arm.radial();
            for i in 0..=60 {
                let elbow = PI * f64::from(i) / 60.0;
                let (worst, _) = arm.worst_direction(0.7, elbow);
                let r = arm.forward(0.7, elbow).norm();
                assert!(
                    (sigma.at(r) - worst).abs() <= 1e-12 * worst,
                    "{arm:?} at elbow {elbow}: {} {worst}",
                    sigma.at(r)
                );
            }
        }
    }

    #[test]
    fn the_valley_is_the_lowest_point_of_a_dense_scan() {
        for arm in arms() {
            let sigma = arm.radial();
            let scan = (0..=20_000)
                .map(|i| sigma.at(sigma.folded + (sigma.stretched - sigma.folded) * f64::from(i) / 20_000.0))
                .fold(f64::INFINITY, f64::min);
            assert!(sigma.floor() <= scan * (1.0 + 1e-12), "{arm:?}");
            assert!(scan <= sigma.floor() * (1.0 + 1e-4), "{arm:?}: scan {scan} floor {}", sigma.floor());
        }
    }

    #[test]
    fn the_floor_has_the_closed_form_of_the_theory() {
        let floor = |l2, l3, architecture| PlanarArm::free(l2, l3, 1.0, 1.0, architecture).radial().floor();
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b, "{a} {b}");
        close(floor(1.0, 0.8, Architecture::Serial), 0.64); // k l3^2
        close(floor(0.8, 1.0, Architecture::Serial), 0.2 * 0.2 + 1.0); // folded: k ((l2 - l3)^2 + l3^2)
        close(floor(1.0, 0.6, Architecture::Serial), 0.5); // l3 < l2/sqrt 2: k l2^2/2, above k l3^2 = 0.36
        close(floor(1.0, 0.4, Architecture::Serial), 0.6 * 0.6 + 0.16); // l3 < l2/2: folded again
        close(floor(1.0, 0.8, Architecture::QuasiSerial), 1.0);
        close(floor(0.7, 0.9, Architecture::QuasiSerial), 0.81);
    }
}
