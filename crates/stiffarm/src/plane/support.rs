//! Which planes bound sigma from below, whatever the distance and the lengths of the links?

use nalgebra::Vector3;

use super::PlanarArm;
use crate::drive::Architecture;

/// `g` with `sigma >= g . z` for every `z = (r^2, l2^2, l3^2)`, m^2, and the springs of this arm; equal at distance `r`, m.
///
/// `sigma = m . z + |(p . z, q . z)|` (\[theory\], section 2, with both squares complete) is convex and homogeneous in `z`,
/// so its gradient does it. Where the norm is zero, `m` alone does.
pub(crate) fn support(arm: &PlanarArm, r: f64) -> Vector3<f64> {
    let &PlanarArm { l2, l3, k2, k3, .. } = arm;
    let (m, p, q) = match arm.architecture {
        Architecture::Serial => {
            let k = k2 + k3;
            let m = Vector3::new(k2, 0.0, k3) / 2.0;
            let p = Vector3::new(k, -k3, 0.0) * (k2 / k).sqrt() / 2.0;
            (m, p, Vector3::new(0.0, -k2, k) * (k3 / k).sqrt() / 2.0)
        }
        Architecture::QuasiSerial => {
            let m = Vector3::new(0.0, k2, k3) / 2.0;
            let p = Vector3::new(1.0, -1.0, -1.0) * (k2 * k3).sqrt() / 2.0;
            (m, p, Vector3::new(0.0, k2, -k3) / 2.0)
        }
    };
    let z = Vector3::new(r * r, l2 * l2, l3 * l3);
    let (along_p, along_q) = (p.dot(&z), q.dot(&z));
    let norm = along_p.hypot(along_q);
    if 0.0 < norm { m + (p * along_p + q * along_q) / norm } else { m }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_support_touches_sigma_and_none_lies_above_it() {
        let mut rng = fastrand::Rng::with_seed(2);
        for _ in 0..300 {
            let springs = [(1.0, 1.0), (0.01, 3.0), (0.0, 1.0), (2.0, 0.0)][rng.usize(..4)];
            let arm = |rng: &mut fastrand::Rng, architecture| {
                let (l2, l3) = (0.1 + rng.f64(), 0.1 + rng.f64());
                PlanarArm::free(l2, l3, springs.0, springs.1, architecture)
            };
            for architecture in Architecture::ALL {
                let here = arm(&mut rng, architecture);
                // The worst direction of a posture is found by an eigenvalue, not by the formula of the distance.
                let (elbow, other_elbow) = (3.1 * rng.f64(), 3.1 * rng.f64());
                let r = here.forward(0.3, elbow).norm();
                let g = support(&here, r);
                let at = |arm: &PlanarArm, elbow: f64| {
                    let r = arm.forward(0.3, elbow).norm();
                    (g.dot(&Vector3::new(r * r, arm.l2 * arm.l2, arm.l3 * arm.l3)), arm.worst_direction(0.3, elbow).0)
                };
                let (plane, sigma) = at(&here, elbow);
                assert!((plane - sigma).abs() <= 1e-12 * sigma, "{here:?} {elbow}: {plane} {sigma}");
                let there = arm(&mut rng, architecture);
                let (plane, sigma) = at(&there, other_elbow);
                assert!(plane <= sigma * (1.0 + 1e-12), "{here:?} {there:?}: {plane} above {sigma}");
            }
        }
    }
}
