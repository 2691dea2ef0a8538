//! Which postures put the flange at a pose? All of them, in closed form.

mod configuration;

use std::f64::consts::PI;

use nalgebra::{Matrix3, Rotation3, Vector3};

pub(crate) use configuration::{ArmBranch, ELBOWS};
pub use configuration::{Configuration, Shoulder, UnknownConfiguration, Wrist};

use crate::geometry::Geometry;
use crate::limits::{Limits, ThirdAxis};
use crate::plane::Elbow;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use crate::tolerances::{LIMIT, RIM, SINGULAR};

/// All postures of a pose, without regard to limits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Postures {
    /// Up to eight, each with its model angles, rad.
    pub found: Vec<(Configuration, [f64; 6])>,
    /// The wrist centre lies on the joint-1 axis: joint 1 is free, and facing straight ahead stands for all its values.
    pub shoulder_is_free: bool,
    /// Joints 4 and 6 turn about one line in some posture: only their sum (or difference) counts, and joint 4 at model
    /// zero stands for all.
    pub wrist_is_free: bool,
}

/// Closed-form inverse kinematics of an arm with spherical wrist (\[OPW\]): every posture whose flange stands at `flange`.
///
/// Empty where the pose is out of reach. A stretched or folded arm counts as reached within 1e-12 (relative) of the rim.
/// Singular poses give a finite set of representatives and say so; a finite pose never gives NaN.
pub fn postures(geometry: &Geometry, flange: &Pose) -> Postures {
    postures_where(geometry, flange, |_| true)
}

/// Those of some branches of the arm: with either wrist.
pub(crate) fn postures_where(geometry: &Geometry, flange: &Pose, is_wanted: impl Fn(ArmBranch) -> bool) -> Postures {
    let mut found = Postures::default();
    let rotation = flange.rotation.to_rotation_matrix();
    let wrist = flange.translation.vector - rotation * Vector3::z() * geometry.c4;
    let across = wrist.x * wrist.x + wrist.y * wrist.y - geometry.b * geometry.b;
    if !(-SINGULAR * geometry.c2 * geometry.c2 <= across) {
        return found; // nearer to the joint-1 axis than the sideways offset, or not a pose at all
    }
    let ahead = across.max(0.0).sqrt();
    found.shoulder_is_free = wrist.x.hypot(wrist.y) <= SINGULAR * geometry.c2;
    let heading = if found.shoulder_is_free { 0.0 } else { wrist.y.atan2(wrist.x) };
    let aside = geometry.b.atan2(ahead);
    let shoulders = [(Shoulder::Front, heading - aside, ahead), (Shoulder::Back, heading + aside - PI, -ahead)];
    for (shoulder, theta_1, forwards) in shoulders {
        if !ELBOWS.into_iter().any(|elbow| is_wanted(ArmBranch { shoulder, elbow })) {
            continue;
        }
        let (x, z) = (forwards - geometry.a1, wrist.z - geometry.c1);
        for (elbow, theta_2, theta_3) in two_links(geometry, x, z).into_iter().flatten() {
            if !is_wanted(ArmBranch { shoulder, elbow }) {
                continue;
            }
            let forearm = Rotation3::from_axis_angle(&Vector3::z_axis(), theta_1)
                * Rotation3::from_axis_angle(&Vector3::y_axis(), theta_2 + theta_3);
            let (wrists, free) = wrist_angles((forearm.inverse() * rotation).matrix());
            found.wrist_is_free |= free;
            for (wrist, [theta_4, theta_5, theta_6]) in wrists.into_iter().flatten() {
                let class = Configuration { shoulder, elbow, wrist };
                found.found.push((class, [theta_1, theta_2, theta_3, theta_4, theta_5, theta_6]));
            }
        }
    }
    found
}

/// The model angles of one configuration that puts the flange at a pose, rad; `None` where it does not reach.
pub(crate) fn posture_of(geometry: &Geometry, flange: &Pose, configuration: Configuration) -> Option<[f64; 6]> {
    let mut found = postures_where(geometry, flange, |arm| arm == configuration.arm()).found.into_iter();
    found.find(|(known, _)| *known == configuration).map(|(_, theta)| theta)
}

/// Both elbow sides that put the wrist centre `x` forwards and `z` above the joint-2 axis, with `theta2`, `theta3`; one
/// where the arm is stretched or folded.
fn two_links(geometry: &Geometry, x: f64, z: f64) -> [Option<(Elbow, f64, f64)>; 2] {
    let (l2, l3) = (geometry.c2, geometry.l3());
    let c = (x * x + z * z - l2 * l2 - l3 * l3) / (2.0 * l2 * l3);
    if !(c.abs() <= 1.0 + RIM) {
        return [None, None];
    }
    let bend = c.clamp(-1.0, 1.0).acos();
    let side = |elbow, bend: f64| {
        // From upright, forwards positive: the wrist centre at `bearing`, the upper arm `lead` short of it.
        let (bearing, lead) = (x.atan2(z), (l3 * bend.sin()).atan2(l2 + l3 * bend.cos()));
        (elbow, bearing - lead, bend - geometry.lean())
    };
    let at_the_rim = bend == 0.0 || bend == PI;
    [Some(side(Elbow::Up, bend)), (!at_the_rim).then(|| side(Elbow::Down, -bend))]
}

/// `theta4` to `theta6` of either wrist.
type Wrists = [Option<(Wrist, [f64; 3])>; 2];

/// Both wrists for the orientation `r` of the flange seen from the forearm, `r = Rz(t4) Ry(t5) Rz(t6)`; one, and a word,
/// where joints 4 and 6 turn about one line.
fn wrist_angles(r: &Matrix3<f64>) -> (Wrists, bool) {
    let sine = r[(0, 2)].hypot(r[(1, 2)]);
    let theta_5 = sine.atan2(r[(2, 2)]);
    if sine <= SINGULAR {
        let forwards = if 0.0 < r[(2, 2)] { r[(0, 0)] } else { -r[(0, 0)] };
        return ([Some((Wrist::NoFlip, [0.0, theta_5, r[(1, 0)].atan2(forwards)])), None], true);
    }
    let theta_4 = r[(1, 2)].atan2(r[(0, 2)]);
    // What joint 4 leaves, not the small last row: near a straight wrist both angles are uncertain, and their sum must not be.
    let (s4, c4) = theta_4.sin_cos();
    let theta_6 = (c4 * r[(1, 0)] - s4 * r[(0, 0)]).atan2(c4 * r[(1, 1)] - s4 * r[(0, 1)]);
    let no_flip = (Wrist::NoFlip, [theta_4, theta_5, theta_6]);
    let flip = (Wrist::Flip, [theta_4 + PI, -theta_5, theta_6 + PI]);
    ([Some(no_flip), Some(flip)], false)
}

/// The joint angles a robot reports for model angles, each turned into its limits; `None` where a limit forbids it.
///
/// Every limit is judged in the coordinates in which it is stated: joints, the forearm's absolute angle, the angle
/// between the links.
pub fn within_limits(geometry: &Geometry, limits: &Limits, theta: &[f64; 6]) -> Option<[f64; 6]> {
    let third = third_within_limits(geometry, limits, theta)?;
    let mut q = geometry.reported(theta, limits.third_axis);
    for (joint, (q, range)) in q.iter_mut().zip(&limits.joints).enumerate() {
        // Of joint 3 a range of more than a turn has two angles, and the links may have one of them.
        *q = if joint == 2 { third } else { range.turn_to(*q, LIMIT)? };
    }
    Some(q)
}

/// What joint 3 reports, where its limit and that of the angle between the links allow it with one and the same number of
/// whole turns: the forearm's absolute angle is the sum of two angles, each with an end.
pub(crate) fn third_within_limits(geometry: &Geometry, limits: &Limits, theta: &[f64; 6]) -> Option<f64> {
    let mut wound = *theta;
    wound[2] = PI - limits.elbow.turn_to(PI - theta[2], LIMIT)?;
    if limits.third_axis == ThirdAxis::Forearm {
        wound[1] = geometry.theta(1, limits.joints[1]).turn_to(theta[1], LIMIT)?;
    }
    let third = geometry.reported(&wound, limits.third_axis)[2];
    if limits.third_is_wound() {
        limits.joints[2].contains(third, LIMIT).then_some(third)
    } else {
        limits.joints[2].turn_to(third, LIMIT)
    }
}

/// Every posture of a pose that the limits of a robot allow: its configuration and the joint angles it reports, rad.
///
/// Where a free joint leaves a choice, representatives are tried at model zero and at the ends of the ranges. Empty for
/// a planar robot, which has no six joints.
pub fn reached(robot: &Robot, flange: &Pose) -> Vec<(Configuration, [f64; 6])> {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return Vec::new() };
    let postures = postures(geometry, flange);
    let allowed = |theta: &[f64; 6]| within_limits(geometry, limits, theta);
    let mut found = Vec::new();
    for (class, theta) in &postures.found {
        let free = postures.wrist_is_free && theta[4].sin().abs() <= 2.0 * SINGULAR;
        let other_splits = || {
            let sum = if theta[4].cos() < 0.0 { 1.0 } else { -1.0 };
            let ends = |i: usize| {
                let range = limits.joints[i].affine(geometry.sign[i], -geometry.offset[i]);
                [range.min(), range.max()].into_iter().filter(|end| end.is_finite())
            };
            let fourth = ends(3).chain(ends(5).map(|end| sum * (end - theta[5])));
            let splits: Vec<f64> = fourth.collect();
            splits
                .into_iter()
                .find_map(|t4| allowed(&[theta[0], theta[1], theta[2], t4, theta[4], theta[5] + sum * t4]))
        };
        let q = allowed(theta).or_else(|| if free { other_splits() } else { None });
        found.extend(q.map(|q| (*class, q)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(rng: &mut fastrand::Rng) -> Geometry {
        let mut between = |low: f64, high: f64| low + (high - low) * rng.f64();
        Geometry {
            a1: between(-0.2, 0.8),
            a2: between(-0.3, 0.3),
            b: between(-0.2, 0.2),
            c1: between(0.3, 1.0),
            c2: between(0.4, 1.5),
            c3: between(0.4, 1.8),
            c4: between(-0.1, 0.3),
            offset: [0.0; 6],
            sign: [1.0; 6],
        }
    }

    /// Metres and radians between two poses, added.
    fn apart(a: &Pose, b: &Pose) -> f64 {
        (a.translation.vector - b.translation.vector).norm() + a.rotation.angle_to(&b.rotation)
    }

    #[test]
    fn every_posture_reaches_the_pose_and_one_of_them_is_where_it_came_from() {
        let mut rng = fastrand::Rng::with_seed(8);
        for _ in 0..2000 {
            let geometry = random(&mut rng);
            let theta: [f64; 6] = std::array::from_fn(|_| 2.0 * PI * (rng.f64() - 0.5));
            let flange = geometry.forward(&theta);
            let Postures { found, shoulder_is_free, wrist_is_free } = postures(&geometry, &flange);
            assert!(!shoulder_is_free && !wrist_is_free);
            let classes: std::collections::BTreeSet<Configuration> = found.iter().map(|(class, _)| *class).collect();
            assert!(classes.len() == found.len() && found.len() % 2 == 0 && found.len() <= 8, "{found:?}");
            for (class, angles) in &found {
                // Near a stretched arm the angles are as ill conditioned as a square root; the pose is not.
                assert!(apart(&geometry.forward(angles), &flange) < 1e-7, "{class}: {angles:?}");
            }
            let back = found.iter().map(|(_, angles)| {
                (0..6)
                    .map(|i| (angles[i] - theta[i]).sin().abs().max((1.0 - (angles[i] - theta[i]).cos()).abs()))
                    .fold(0.0, f64::max)
            });
            assert!(back.fold(f64::INFINITY, f64::min) < 1e-6, "{theta:?} not among {found:?}");
        }
    }

    #[test]
    fn singular_poses_give_representatives_and_say_so() {
        let mut rng = fastrand::Rng::with_seed(9);
        for case in 0..500 {
            let mut geometry = random(&mut rng);
            let mut theta: [f64; 6] = std::array::from_fn(|_| 2.0 * PI * (rng.f64() - 0.5));
            let wrist = case % 2 == 0;
            if wrist {
                theta[4] = if case % 4 == 0 { 0.0 } else { PI };
            } else {
                // The wrist centre above the joint-1 axis: lean the upper arm until it is.
                geometry.b = 0.0;
                let reach = geometry.c2 * theta[1].sin() + geometry.a1;
                let l3 = geometry.l3();
                if reach.abs() > l3 {
                    continue;
                }
                theta[2] = (-reach / l3).asin() - geometry.lean() - theta[1];
            }
            let flange = geometry.forward(&theta);
            let Postures { found, shoulder_is_free, wrist_is_free } = postures(&geometry, &flange);
            assert_eq!((shoulder_is_free, wrist_is_free), (!wrist, wrist), "{geometry:?} {theta:?}");
            assert!(!found.is_empty());
            for (class, angles) in &found {
                assert!(angles.iter().all(|angle| angle.is_finite()));
                assert!(apart(&geometry.forward(angles), &flange) < 1e-7, "{class}: {angles:?}");
            }
        }
    }

    #[test]
    fn what_is_out_of_reach_or_no_pose_has_no_posture() {
        let geometry = random(&mut fastrand::Rng::with_seed(1));
        for far in [
            Pose::translation(9.0, 0.0, 1.0),
            Pose::translation(f64::NAN, 0.0, 0.0),
            Pose::translation(f64::INFINITY, 0.0, 0.0),
        ] {
            assert!(postures(&geometry, &far).found.is_empty());
        }
        let offset = Geometry { b: 0.5, c4: 0.0, ..geometry };
        assert!(postures(&offset, &Pose::translation(0.2, 0.2, 1.0)).found.is_empty(), "inside the sideways offset");
    }
}
