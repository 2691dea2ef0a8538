//! Which lengths, zero offsets and signs have six joint axes?
//!
//! All of it is read off at joint zero: the axes are lines in space there, and the lengths are distances between them
//! (\[theory\], *Recovering an arm from its joint axes*).

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

use super::chain::Chain;
use super::flange::{Flange, flange};
use super::joint_axis::Axis;
use super::{MEETS_M, REPORTED_DEG, REPORTED_M, STRAIGHT_DEG};
use crate::catalogue::reader::Log;
use crate::geometry::Geometry;

/// A shoulder that stands nearer than this, m, stands above axis 1, and a measured arm may have it on either side.
const SHOULDER: f64 = 0.01;

/// What was recovered.
#[derive(Debug)]
pub(super) struct Recovered {
    pub(super) geometry: Geometry,
    /// The origin of the arm's base frame in the URDF's: the foot of axis 1, or zero where that is too near to be said.
    pub(super) moved: Vector3<f64>,
    pub(super) flange: Flange,
    pub(super) notes: Vec<String>,
    /// What the description has and a robot file has not.
    pub(super) left: Vec<String>,
}

/// rad: an upper arm that leans by less in the middle of its range turns as far to either side.
const UPRIGHT: f64 = 0.1;

/// The arm plane at joint zero: forwards, across (the positive bend), up.
struct Frame {
    x: Vector3<f64>,
    y: Vector3<f64>,
}

/// Recovers the arm of a chain; `None` where it is no arm of this class, with every reason in the log.
pub(super) fn recover(chain: &Chain, tip: Option<&str>, log: &Log) -> Option<Recovered> {
    let frames = chain.frames();
    let axes: [Axis; 6] = std::array::from_fn(|i| {
        let along = frames[i].rotation * chain.joints[i].axis.into_inner();
        Axis { through: frames[i].translation.vector.into(), along }
    });
    let refuse = |joint: usize, message: String| {
        log.add(chain.joints[joint].place, &chain.joints[joint].key(), message);
    };
    let mut faults = leaning(&axes);
    let wrist = meeting_point(&axes).unwrap_or(axes[4].through);
    // Axes that are parallel where they should cross say enough.
    if faults.iter().all(|&(joint, _)| joint < 4) {
        faults.extend(missing(&axes, &wrist));
    }
    if !faults.is_empty() {
        for (joint, message) in faults {
            refuse(joint, message);
        }
        return None;
    }
    let foot = -axes[0].aside(&Point3::origin());
    let foot = Vector3::new(foot.x, foot.y, 0.0);
    let frame = frame(&axes, &foot, chain.joints[1].limit.middle());
    let (mut geometry, theta) = arm(&axes, &frame, &foot, &wrist).or_else(|| {
        refuse(4, "the wrist centre lies beside the elbow; expected a forearm along axis 4".into());
        None
    })?;
    let forearm = axes[3].along * geometry.sign[3];
    let mut flange = flange(chain, tip, &axes[5], &wrist, &forearm, log)?;
    geometry.c4 = (flange.centre - wrist).dot(&flange.out);
    bend(&mut geometry, &axes, &frame, theta, &flange);
    let mut left = std::mem::take(&mut flange.left);
    left.extend(leans(&axes));
    let apart = axes[3..].iter().map(|axis| axis.aside(&wrist).norm()).fold(0.0, f64::max);
    if REPORTED_M < apart {
        left.push(format!("the axes 4, 5, 6 pass their common point by up to {:.3} mm", apart * 1e3));
    }
    let is_moved = MEETS_M < foot.norm();
    if !is_moved && REPORTED_M < foot.norm() {
        left.push(format!("axis 1 stands {:.3} mm beside the origin of link {}", foot.norm() * 1e3, chain.base));
    }
    let moved = if is_moved { foot } else { Vector3::zeros() };
    let mut notes = Vec::new();
    if is_moved {
        notes.push(format!(
            "axis 1 stands {:.1} mm, {:.1} mm from the origin of link {}: the base frame was moved onto it",
            foot.x * 1e3,
            foot.y * 1e3,
            chain.base
        ));
    }
    Some(Recovered { geometry, moved, flange, notes, left })
}

/// The angle between two lines, deg, 0 to 90.
fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs()).to_degrees()
}

/// Every axis from joint 0 with what it stands beside: `(joint, that, the angle, the angle expected)`, deg.
fn angles(axes: &[Axis; 6]) -> impl Iterator<Item = (usize, &'static str, f64, f64)> {
    let e = axes.map(|axis| axis.along);
    let others = ["the base's z axis", "axis 1", "axis 2", "axis 3", "axis 4", "axis 5"];
    let expected = [0.0, 90.0, 0.0, 90.0, 90.0, 90.0];
    (0..6).map(move |joint| {
        let beside = if joint == 0 { Vector3::z() } else { e[joint - 1] };
        (joint, others[joint], angle(&e[joint], &beside), expected[joint])
    })
}

/// The axes that do not stand as those of an arm with a spherical wrist do.
fn leaning(axes: &[Axis; 6]) -> Vec<(usize, String)> {
    let judged = angles(axes).filter(|(_, _, found, expected)| !((found - expected).abs() <= STRAIGHT_DEG));
    let sentences = judged.map(|(joint, other, found, expected)| {
        let wanted = if expected == 0.0 { "parallel" } else { "at right angles" };
        let name = joint + 1;
        (joint, format!("axis {name} stands at {found:.3} deg to {other}; expected {wanted} within {STRAIGHT_DEG} deg"))
    });
    sentences.collect()
}

/// The leans that are taken for none.
fn leans(axes: &[Axis; 6]) -> Vec<String> {
    let small = angles(axes).map(|(joint, other, found, expected)| (joint + 1, other, (found - expected).abs()));
    small
        .filter(|(_, _, lean)| REPORTED_DEG < *lean)
        .map(|(name, other, lean)| format!("axis {name} leans by {lean:.4} deg against {other}"))
        .collect()
}

/// The point with the least squared distance from the axes 4, 5 and 6.
fn meeting_point(axes: &[Axis; 6]) -> Option<Point3<f64>> {
    let across = |axis: &Axis| Matrix3::identity() - axis.along * axis.along.transpose();
    let wrist = &axes[3..];
    let sum: Matrix3<f64> = wrist.iter().map(across).sum();
    let weighted: Vector3<f64> = wrist.iter().map(|axis| across(axis) * axis.through.coords).sum();
    // Two axes at right angles are enough for a sum far from singular.
    sum.try_inverse().map(|inverse| Point3::from(inverse * weighted))
}

/// The wrist axes that do not pass through one point.
fn missing(axes: &[Axis; 6], wrist: &Point3<f64>) -> Option<(usize, String)> {
    let apart = axes[3..].iter().map(|axis| axis.aside(wrist).norm()).fold(0.0, f64::max);
    if apart <= MEETS_M {
        return None;
    }
    let [(first, at_4), (second, at_6)] = [3, 5].map(|i| passing(&axes[4], &axes[i]));
    let message = format!(
        "the axes 4, 5, 6 do not meet: axis 4 passes axis 5 at {:.3} mm and axis 6 passes it at {:.3} mm, {:.3} mm apart along \
         axis 5; expected a spherical wrist, all within {} mm of one point",
        first * 1e3,
        second * 1e3,
        (at_6 - at_4).abs() * 1e3,
        MEETS_M * 1e3
    );
    Some((4, message))
}

/// How far `other` passes `axis`, which it crosses at about a right angle, and where along `axis`.
fn passing(axis: &Axis, other: &Axis) -> (f64, f64) {
    let across = axis.along.cross(&other.along).normalize();
    let from = other.through - axis.through;
    // The component of `along` that is at right angles to the other axis leads to the nearest point.
    let ahead = axis.along - other.along * axis.along.dot(&other.along);
    (from.dot(&across).abs(), from.dot(&ahead) / ahead.norm_squared())
}

/// Forwards is where axis 2 stands before axis 1, as of every arm, however its base frame is turned; where it stands above it, where the upper
/// arm leans in the middle of its range; where that is upright, where the base's x axis points.
fn frame(axes: &[Axis; 6], foot: &Vector3<f64>, middle_2: f64) -> Frame {
    let across = axes[1].along;
    let forwards = across.cross(&Vector3::z()).normalize();
    let shoulder = (axes[1].through.coords - foot).dot(&forwards);
    let upper = axes[2].through - axes[1].through;
    let leaning = UnitQuaternion::from_scaled_axis(across * middle_2) * upper;
    let lean = leaning.dot(&forwards).atan2(leaning.z);
    let says = if SHOULDER < shoulder.abs() {
        shoulder
    } else if UPRIGHT < lean.abs() && lean.abs() < PI - UPRIGHT {
        lean
    } else if 0.1 < forwards.x.abs() {
        forwards.x
    } else {
        forwards.y
    };
    let x = forwards * 1_f64.copysign(says);
    Frame { x, y: Vector3::z().cross(&x) }
}

/// Lengths, the signs of the joints 1 to 4 and the model angles of the joints 1 to 3 at joint zero.
fn arm(axes: &[Axis; 6], frame: &Frame, foot: &Vector3<f64>, wrist: &Point3<f64>) -> Option<(Geometry, [f64; 6])> {
    let in_plane = |point: &Point3<f64>| {
        let from = point.coords - foot;
        (from.dot(&frame.x), from.z)
    };
    let (a1, c1) = in_plane(&axes[1].through);
    let elbow = in_plane(&axes[2].through);
    let upper = (elbow.0 - a1, elbow.1 - c1);
    let wrist_from_elbow = (in_plane(wrist).0 - elbow.0, in_plane(wrist).1 - elbow.1);
    let e4 = (axes[3].along.dot(&frame.x), axes[3].along.z);
    let along = wrist_from_elbow.0 * e4.0 + wrist_from_elbow.1 * e4.1;
    let sign_4 = 1_f64.copysign(along);
    let u = (sign_4 * e4.0, sign_4 * e4.1); // the forearm, elbow to wrist: (sin, cos) of theta2 + theta3
    let theta_23 = u.0.atan2(u.1);
    let theta_2 = upper.0.atan2(upper.1);
    let sign = |joint: usize, direction: &Vector3<f64>| 1_f64.copysign(axes[joint].along.dot(direction));
    let geometry = Geometry {
        a1,
        a2: wrist_from_elbow.0 * u.1 - wrist_from_elbow.1 * u.0,
        b: (wrist.coords - foot).dot(&frame.y),
        c1,
        c2: upper.0.hypot(upper.1),
        c3: along.abs(),
        c4: 0.0,
        offset: [0.0; 6],
        sign: [sign(0, &Vector3::z()), sign(1, &frame.y), sign(2, &frame.y), sign_4, 1.0, 1.0],
    };
    let theta_1 = frame.x.y.atan2(frame.x.x);
    let long_enough = MEETS_M < geometry.c2 && MEETS_M < geometry.c3;
    long_enough.then_some((geometry, [theta_1, theta_2, theta_23 - theta_2, 0.0, 0.0, 0.0]))
}

/// The wrist: signs of the joints 5 and 6, and from the model angles at joint zero all offsets.
fn bend(geometry: &mut Geometry, axes: &[Axis; 6], frame: &Frame, mut theta: [f64; 6], flange: &Flange) {
    let (s23, c23) = (theta[1] + theta[2]).sin_cos();
    let along = frame.x * s23 + Vector3::z() * c23;
    let forwards = frame.x * c23 - Vector3::z() * s23;
    // Of the two bends (one is the other with axis 4 turned half round) the one with axis 4 nearer to its zero.
    let e5 = axes[4].along;
    let cosine = e5.dot(&frame.y);
    let sign_5 = 1_f64.copysign(if cosine.abs() < 1e-6 { -e5.dot(&forwards) } else { cosine });
    let bend = e5 * sign_5;
    theta[3] = (-bend.dot(&forwards)).atan2(bend.dot(&frame.y));
    let (s4, c4) = theta[3].sin_cos();
    let swung = forwards * c4 + frame.y * s4;
    theta[4] = flange.out.dot(&swung).atan2(flange.out.dot(&along));
    geometry.sign[4] = sign_5;
    geometry.sign[5] = 1_f64.copysign(axes[5].along.dot(&flange.out));
    let unturned = geometry.forward(&theta).rotation;
    let turn: UnitQuaternion<f64> = unturned.inverse() * flange.turned;
    let x = turn * Vector3::x();
    theta[5] = x.y.atan2(x.x);
    geometry.offset = theta.map(|theta| principal(-theta));
}

/// The same angle in (-pi, pi]; what is within a hair of -pi is pi.
fn principal(angle: f64) -> f64 {
    let turned = angle - (angle / (2.0 * PI)).round() * 2.0 * PI;
    if turned <= -PI + 1e-9 { turned + 4.0 * FRAC_PI_2 } else { turned }
}
