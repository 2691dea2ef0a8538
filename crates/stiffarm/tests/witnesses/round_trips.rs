//! Does every posture of every robot lead to a pose, and the pose back to the posture?

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;
use stiffarm::catalogue::robots;
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::inverse::{Configuration, postures, reached};
use stiffarm::limits::Limits;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;

use crate::cases;

/// Of a pose that was computed there and back, m per metre of arm and rad. Some fifty products of numbers of the size of the
/// arm lose 1e-14; where equal links are folded the distance to the wrist centre is the root of a difference, and a
/// random arm folds to a thousandth of its length, no further: a thousandth of the digits more.
const POSE: f64 = 1e-11;
/// Of an angle where no posture is near a singular one; see [`condition`].
const ANGLE: f64 = 1e-12;
/// What the library lets a limit be overstepped by.
const SLACK: f64 = 1e-9;

/// A robot with six axes, and what its numbers mean.
struct Subject<'a> {
    robot: &'a Robot,
    geometry: &'a Geometry,
    limits: &'a Limits,
    /// The sum of its lengths, m.
    size: f64,
}

impl<'a> Subject<'a> {
    fn of(robot: &'a Robot) -> Option<Self> {
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return None };
        let Geometry { a1, a2, b, c1, c2, c3, c4, .. } = geometry;
        let size = [a1, a2, b, c1, c2, c3, c4].map(|length| length.abs()).iter().sum();
        Some(Self { robot, geometry, limits, size })
    }

    /// Joint angles as reported, each anywhere in its range: one full turn where it has no end.
    fn random_joints(&self, rng: &mut fastrand::Rng) -> [f64; 6] {
        loop {
            let q = self.limits.joints.map(|range| {
                let (low, width) = if range.is_bounded() { (range.min(), range.width()) } else { (-PI, TAU) };
                low + width * rng.f64()
            });
            if self.limits.elbow.contains(PI - self.theta(&q)[2], 0.0) {
                return q;
            }
        }
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        self.geometry.model_angles(q, self.limits.third_axis)
    }

    /// Every limit in the coordinate in which it is stated, overstepped by `slack` at most, after some whole turns of every
    /// joint; what joint 3 reports turns with those of both arms.
    fn allows(&self, theta: &[f64; 6], slack: f64) -> bool {
        let (joints, turns) = (self.limits.joints, (-2..=2).map(|turns| TAU * f64::from(turns)));
        let q = self.geometry.reported(theta, self.limits.third_axis);
        [0, 3, 4, 5].iter().all(|&i| fits(joints[i], q[i], slack))
            && turns.clone().flat_map(|second| turns.clone().map(move |third| (second, third))).any(
                |(second, third)| {
                    let mut wound = *theta;
                    wound[1] += second;
                    wound[2] += third;
                    let q = self.geometry.reported(&wound, self.limits.third_axis);
                    self.limits.elbow.contains(PI - wound[2], slack)
                        && joints[1].contains(q[1], slack)
                        && joints[2].contains(q[2], slack)
                },
            )
    }

    /// How much rounding grows on the way back: the reciprocals of what the inverse divides by. They are the distances, as
    /// parts of the arm, of the wrist centre from the plane through the joint-1 axis across the arm and from the joint-2
    /// axis, and the sines of elbow and joint 5, which vanish at a stretched arm and a straight wrist.
    fn condition(&self, theta: &[f64; 6], flange: &Pose) -> f64 {
        let Geometry { a1, a2, b, c1, c3, c4, .. } = *self.geometry;
        let wrist = flange * nalgebra::Point3::new(0.0, 0.0, -c4);
        let ahead = (wrist.x.powi(2) + wrist.y.powi(2) - b * b).max(0.0).sqrt();
        let from_joint_2 =
            [a1, -a1].map(|a1| (ahead - a1).hypot(wrist.z - c1)).into_iter().fold(f64::INFINITY, f64::min);
        let elbow = (theta[2] + a2.atan2(c3)).sin().abs();
        self.size.powi(2) / (ahead * from_joint_2 * elbow * theta[4].sin().abs())
    }

    /// There and back at random postures; the number of postures that were found, and of those that were looked for.
    fn go_there_and_back(&self, seed: u64, count: u64) -> (usize, usize) {
        let mut rng = fastrand::Rng::with_seed(seed);
        let (mut found, mut looked_for) = (0, 0);
        for _ in 0..count {
            let q = self.random_joints(&mut rng);
            let theta = self.theta(&q);
            let flange = self.geometry.forward(&theta);
            let back = postures(self.geometry, &flange);
            let case = || format!("{} at {q:?}", self.robot.full_name());
            for (class, angles) in &back.found {
                self.assert_there(&flange, angles, || format!("{}: {class}", case()));
            }
            let tolerance = ANGLE * self.condition(&theta, &flange);
            // Where a joint is free the postures are representatives, as they say.
            if !back.shoulder_is_free && !back.wrist_is_free && tolerance < SLACK {
                assert!(
                    back.found.iter().any(|(_, angles)| turned(angles, &theta) <= tolerance),
                    "{}: {back:?}",
                    case()
                );
                looked_for += 1;
            }
            let kept = reached(self.robot, &flange);
            self.assert_kept(&flange, &back.found, &kept, case);
            if tolerance < SLACK {
                // The forearm's absolute angle is the sum of two.
                assert!(kept.iter().any(|(_, angles)| turned(angles, &q) <= 2.0 * tolerance), "{}: {kept:?}", case());
            }
            found += back.found.len();
        }
        (found, looked_for)
    }

    #[track_caller]
    fn assert_there(&self, flange: &Pose, theta: &[f64; 6], case: impl Fn() -> String) {
        let there = self.geometry.forward(theta);
        let moved = (there.translation.vector - flange.translation.vector).norm();
        let rotated = there.rotation.angle_to(&flange.rotation);
        assert!(moved <= POSE * self.size && rotated <= POSE, "{}: off by {moved:.1e} m, {rotated:.1e} rad", case());
    }

    /// Those within the limits, and only those, in the coordinates of the limits.
    fn assert_kept(
        &self,
        flange: &Pose,
        found: &[(Configuration, [f64; 6])],
        kept: &[(Configuration, [f64; 6])],
        case: impl Fn() -> String,
    ) {
        for (class, theta) in found {
            let is_kept = kept.iter().any(|(kept, q)| kept == class && turned(&self.theta(q), theta) <= SLACK);
            assert!(is_kept || !self.allows(theta, 0.0), "{}: {class} keeps the limits and is left out", case());
            assert!(!is_kept || self.allows(theta, 2.0 * SLACK), "{}: {class} keeps no limit", case());
        }
        for (class, q) in kept {
            let fits_as_it_is = q
                .iter()
                .zip(self.limits.joints)
                .all(|(angle, range)| range.min() - 2.0 * SLACK <= *angle && *angle <= range.max() + 2.0 * SLACK);
            assert!(fits_as_it_is, "{}: {class} reports {q:?}", case());
            self.assert_there(flange, &self.theta(q), || format!("{}: {class}, as reported", case()));
        }
    }
}

/// Some whole turns put an angle into a range.
fn fits(range: Interval, angle: f64, slack: f64) -> bool {
    (-4..=4).map(|turns| angle + TAU * f64::from(turns)).any(|x| range.min() - slack <= x && x <= range.max() + slack)
}

/// The largest difference of two sets of angles, whole turns aside.
fn turned(one: &[f64; 6], other: &[f64; 6]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b - ((a - b) / TAU).round() * TAU).abs()).fold(0.0, f64::max)
}

#[test]
fn every_posture_of_every_robot_is_found_again_from_its_pose_and_every_posture_found_leads_there() {
    let robots = robots();
    let subjects: Vec<Subject> = robots.iter().filter_map(Subject::of).collect();
    assert!(300 <= subjects.len(), "{} robots with six axes", subjects.len());
    let count = cases(2_500);
    let counts = subjects.par_iter().enumerate().map(|(seed, subject)| subject.go_there_and_back(seed as u64, count));
    let (found, looked_for) = counts.reduce(|| (0, 0), |(a, b), (c, d)| (a + c, b + d));
    let drawn = subjects.len() * count as usize;
    println!("{} robots, {drawn} postures, {found} found for their poses, {looked_for} looked for", subjects.len());
    assert!(drawn * 9 / 10 <= looked_for, "{looked_for} of {drawn} postures are far from singular ones");
    assert!(3 * drawn <= found, "{found} postures found for {drawn} poses");
}
