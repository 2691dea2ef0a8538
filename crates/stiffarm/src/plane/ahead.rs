//! How far forwards does the arm come within its limits?

use super::{ElbowSide, InvalidArm, PlanarArm};
use crate::interval::Interval;

impl PlanarArm {
    /// The largest distance ahead of the joint-2 axis, m, at which the limits let the wrist centre stand.
    ///
    /// The reached set is bounded by arcs: of a fixed shoulder, forearm or elbow angle. The farthest point ahead lies where
    /// an arc is farthest ahead itself, with the link that moves along it level, or where two arcs meet.
    ///
    /// # Errors
    /// As [`Self::sides`].
    pub fn farthest_ahead(&self) -> Result<f64, InvalidArm> {
        let sides = self.sides()?;
        let ends = |limit: Interval| [limit.min(), limit.max()].into_iter().filter(|end| end.is_finite());
        let shoulders = || ends(self.shoulder).chain([0.0]);
        let forearms = || ends(self.forearm).chain([0.0]);
        let of_absolute =
            shoulders().flat_map(|shoulder| forearms().map(move |forearm| (shoulder, forearm - shoulder)));
        let of_elbow = ends(self.elbow).flat_map(|elbow| {
            let level = -(self.l3 * elbow.sin()).atan2(self.l2 + self.l3 * elbow.cos());
            let at_forearm = forearms().map(move |forearm| forearm - elbow);
            shoulders().chain(at_forearm).chain([level]).map(move |shoulder| (shoulder, elbow))
        });
        let points = of_absolute.chain(of_elbow).map(|(shoulder, elbow)| self.forward(shoulder, elbow));
        let reached = points.filter(|point| sides.iter().any(|side: &ElbowSide| side.reaches(*point)));
        reached.map(|point| point.x).reduce(f64::max).ok_or(InvalidArm::NothingReachable)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::drive::Architecture;

    #[test]
    fn no_posture_of_a_dense_scan_comes_farther_ahead_and_one_comes_nearly_as_far() {
        const STEPS: usize = 400;
        let mut rng = fastrand::Rng::with_seed(9);
        let mut limited = 0;
        for _ in 0..200 {
            let mut range = |width: f64| {
                let start = 3.0 * (rng.f64() - 0.6);
                Interval::spanning(start, start + width * rng.f64())
            };
            let (shoulder, elbow, forearm) = (range(3.0), range(3.0), range(4.0));
            let arm =
                PlanarArm { shoulder, elbow, forearm, ..PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, Architecture::Serial) };
            let step = |range: Interval, i: usize| range.min() + range.width() * i as f64 / STEPS as f64;
            let mut scan = f64::NEG_INFINITY;
            for i in 0..=STEPS {
                for j in 0..=STEPS {
                    let (s, e) = (step(shoulder, i), step(elbow, j));
                    if forearm.contains(s + e, 0.0) {
                        scan = scan.max(s.cos() + 0.8 * (s + e).cos());
                    }
                }
            }
            match arm.farthest_ahead() {
                Err(_) => assert_eq!(scan, f64::NEG_INFINITY, "{arm:?}"),
                // The scan steps by at most 3/400 rad in both angles, and misses thin sets.
                Ok(ahead) => {
                    assert!(scan <= ahead + 1e-9, "{arm:?}: {scan} beyond {ahead}");
                    limited += usize::from(ahead < 1.799 && scan.is_finite());
                    assert!(!scan.is_finite() || ahead <= scan + 0.03, "{arm:?}: {ahead} {scan}");
                }
            }
        }
        assert!(50 < limited, "{limited}");
    }

    #[test]
    fn an_upper_arm_that_stops_five_degrees_above_the_level_reaches_what_its_data_sheet_says() {
        let kuka = &paper_robots()[4];
        let by_hand = 0.35 + 1.15 * 5_f64.to_radians().cos() + 1.2_f64.hypot(0.041);
        let found = kuka.reach_ahead().unwrap();
        assert!((found - by_hand).abs() < 1e-12 && (found - kuka.reach.unwrap()).abs() < 5e-4, "{found} {by_hand}");
    }
}
