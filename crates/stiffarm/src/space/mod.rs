//! A robot and its tool, made ready for many postures and poses at once.
//!
//! The formulas are those of [`crate::compliance`] and [`crate::inverse`], arranged for registers of several numbers
//! (`lanes`): sines and cosines are carried instead of angles, and limits are judged by a scalar product each.

#![allow(
    clippy::inline_always,
    clippy::needless_range_loop,
    reason = "what is not inlined, or hides in an iterator's closure, is compiled without the wide instructions"
)]

mod affine;
mod enclosure;
mod follow;
mod joints;
mod lanes;
mod patch;
mod poses;
mod sector;
mod stands;

use nalgebra::{Matrix6, Vector3};
use pulp::Simd;

use crate::compliance::{PostureError, check_tool};
use crate::drive::{Architecture, GravityCompensator, Transmission};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, ThirdAxis};
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use lanes::Lanes;
use sector::Sector;

pub(crate) use affine::Affine;
pub(crate) use enclosure::{Aim, Angles, Enclosing, Known, Spread, Way};
pub(crate) use follow::{Follower, TOLERANCE};
pub(crate) use patch::{Grid, Patch, Stand};
pub(crate) use poses::{AtRoll, Near, Turning};
pub use poses::{Best, CLASSES, class};
pub(crate) use stands::{StandBox, middle, variables};

/// A six-axis robot with a tool, ready to be evaluated in bulk.
#[derive(Clone, Debug)]
pub struct SpatialArm {
    pub(crate) geometry: Geometry,
    pub(crate) limits: Limits,
    pub(crate) flange_from_tool: Pose,
    coupling: Coupling,
    /// rad/(N m), without the compensator.
    k: [f64; 6],
    compensator: Option<GravityCompensator>,
    sectors: Sectors,
    /// By how much more than they must places keep from singular postures, rad.
    reserve: f64,
}

/// How the columns of the Jacobian combine into those of the drives.
#[derive(Clone, Debug, PartialEq)]
enum Coupling {
    Serial,
    QuasiSerial,
    Any(Box<Matrix6<f64>>),
}

/// The limits as sectors of model angles.
#[derive(Clone, Debug)]
struct Sectors {
    /// Of theta 1, 2, 4, 5, 6 at their places; place 2 holds what joint 3 reports.
    joints: [Sector; 6],
    /// Instead of place 2, where whole turns of the forearm's angle count.
    winding: Option<Winding>,
    /// Joint 3 reports `theta2 + theta3`.
    third_is_forearm: bool,
    /// Of theta 3, from the angle between the links.
    elbow: Sector,
    /// Where joints 4 and 6 turn about one line, some split of their sum is allowed.
    any_wrist_split: bool,
}

impl Sectors {
    fn new(geometry: &Geometry, limits: &Limits) -> Self {
        let joints = std::array::from_fn(|i| Sector::of(geometry.theta(i, limits.joints[i])));
        let elbow = Sector::of(limits.elbow.affine(-1.0, std::f64::consts::PI));
        let any_wrist_split = std::f64::consts::TAU <= limits.joints[3].width() + limits.joints[5].width();
        let third_is_forearm = limits.third_axis == ThirdAxis::Forearm;
        let winding = limits.third_is_wound().then(|| Winding::new(geometry, limits));
        Self { joints, winding, third_is_forearm, elbow, any_wrist_split }
    }
}

/// The limit of joint 3 with its whole turns: half the sum of two angles, each counted from the middle of its range, stays
/// within half a turn, so that a sector of it knows what a sector of the sum does not.
#[derive(Clone, Copy, Debug)]
struct Winding {
    /// Cosine and sine of the middle of theta 2; of no turn, where joint 3 reports the elbow.
    second: [f64; 2],
    /// And of theta 3.
    third: [f64; 2],
    half: Sector,
}

impl Winding {
    fn new(geometry: &Geometry, limits: &Limits) -> Self {
        let forearm = limits.third_axis == ThirdAxis::Forearm;
        let second = if forearm { geometry.theta(1, limits.joints[1]).middle() } else { 0.0 };
        let third = std::f64::consts::PI - limits.elbow.middle();
        let sum = geometry.theta(2, limits.joints[2]);
        Self {
            second: [second.cos(), second.sin()],
            third: [third.cos(), third.sin()],
            half: Sector::of(sum.affine(0.5, -0.5 * (second + third))),
        }
    }

    /// What is negative where the limit is passed. For theta 2, or zero where joint 3 reports the elbow, and theta 3, both in
    /// their ranges.
    #[inline(always)]
    fn slack<S: Simd>(&self, [s2, c2]: [Lanes<S>; 2], [s3, c3]: [Lanes<S>; 2]) -> Lanes<S> {
        // From the middle; a vector of one more than the cosine, and of the sine, points along half the angle.
        let halved = |s: Lanes<S>, c: Lanes<S>, [cos, sin]: [f64; 2]| [c * cos + s * sin + 1.0, s * cos - c * sin];
        let ([x2, y2], [x3, y3]) = (halved(s2, c2, self.second), halved(s3, c3, self.third));
        let (x, y) = (x2 * x3 - y2 * y3, x2 * y3 + y2 * x3);
        self.half.slack(x, y, (x * x + y * y).sqrt())
    }
}

impl SpatialArm {
    /// Makes a robot ready, with a tool frame given in the flange frame.
    ///
    /// # Errors
    /// Where the robot is planar, or the tool makes no sense.
    pub fn new(robot: &Robot, flange_from_tool: &Pose) -> Result<Self, PostureError> {
        let Arm::SixAxis { geometry, limits, drives } = &robot.arm else {
            return Err(PostureError::Planar(robot.name.clone()));
        };
        check_tool(flange_from_tool)?;
        let usual = |architecture| drives.transmission == Transmission::of(architecture);
        let coupling = if usual(Architecture::Serial) {
            Coupling::Serial
        } else if usual(Architecture::QuasiSerial) {
            Coupling::QuasiSerial
        } else {
            Coupling::Any(Box::new(drives.transmission.0))
        };
        Ok(Self {
            sectors: Sectors::new(geometry, limits),
            geometry: geometry.clone(),
            limits: limits.clone(),
            flange_from_tool: *flange_from_tool,
            coupling,
            k: drives.compliance.0,
            compensator: drives.compensator,
            reserve: 0.0,
        })
    }

    /// The tool point lies on the axis of joint 6: turning the tool about it moves nothing.
    pub fn tool_is_on_axis_6(&self) -> bool {
        let tool = self.flange_from_tool.translation.vector;
        tool.x == 0.0 && tool.y == 0.0
    }

    /// How far from the joint-1 axis and how high from the base the tool point can be by the lengths alone, m.
    pub(crate) fn reach(&self) -> [Interval; 2] {
        let tool = self.flange_from_tool.translation.vector;
        let beyond = (self.geometry.c4 + tool.z).hypot(tool.x.hypot(tool.y));
        let far = self.geometry.c2 + self.geometry.l3() + beyond;
        let ahead = self.geometry.a1.hypot(self.geometry.b) + far;
        [Interval::spanning(0.0, ahead), Interval::spanning(self.geometry.c1 - far, self.geometry.c1 + far)]
    }

    /// Turning the tool about its axis turns joint 6 and nothing else.
    pub fn tool_turns_about_axis_6(&self) -> bool {
        let z = self.flange_from_tool.rotation * Vector3::z();
        self.tool_is_on_axis_6() && z.xy().norm() < 1e-12 && 0.0 < z.z
    }

    /// The two wrists of a posture give way alike: every drive turns one of the joints 4 to 6 at most.
    pub(crate) fn wrists_are_alike(&self) -> bool {
        !matches!(self.coupling, Coupling::Any(_))
    }

    /// The same arm, of which joint `i` (from 0) may turn anywhere.
    pub(crate) fn without_limit_on(&self, i: usize, really: bool) -> Self {
        let mut arm = self.clone();
        if really {
            arm.limits.joints[i] = Interval::ALL;
            arm.sectors = Sectors::new(&arm.geometry, &arm.limits);
        }
        arm
    }

    /// The same arm with limits that leave so much less at either end, and keep so much farther from singular postures, rad; `None`
    /// where one would leave nothing.
    pub(crate) fn narrowed(&self, by: f64) -> Option<Self> {
        let mut arm = Self { reserve: by, ..self.clone() };
        for range in arm.limits.joints.iter_mut().chain([&mut arm.limits.elbow]) {
            *range = Interval::new(range.min() + by, range.max() - by)?;
        }
        arm.sectors = Sectors::new(&arm.geometry, &arm.limits);
        Some(arm)
    }

    /// The same arm without any limits.
    pub(crate) fn without_limits(&self) -> Self {
        let mut arm = self.clone();
        arm.limits.joints = [Interval::ALL; 6];
        arm.limits.elbow = Interval::ALL;
        arm.sectors = Sectors::new(&arm.geometry, &arm.limits);
        arm
    }

    /// Translations per force at the tool point, in the axes of the arm: x forwards in the arm plane, y across, z up.
    #[inline(always)]
    fn translation<S: Simd>(&self, at: &At<S>) -> Symmetric<S> {
        let At { s2, c2, s23, c23, bend, spin, beyond } = *at;
        let Geometry { a1, a2, b, c2: upper, c3, .. } = self.geometry;
        let zero = s2.all(0.0);
        let (ex, ez) = (s2 * upper, c2 * upper);
        let (ux, uy, uz) = beyond.parts();
        // From the joint-2 axis, and from the elbow.
        let (fx, fz) = (s23 * c3 + c23 * a2 + ux, c23 * c3 - s23 * a2 + uz);
        let (px, pz) = (ex + fx, ez + fz);
        let column_1 = Triple([-(uy + b), px + a1, zero]);
        let column_2 = Triple([pz, zero, -px]);
        let column_3 = Triple([fz, zero, -fx]);
        let along = Triple([s23, zero, c23]);
        let k = self.k;
        let k2 = match &self.compensator {
            None => s2.all(k[1]),
            Some(compensator) => held(k[1], compensator, s2, c2),
        };
        let mut sum = Symmetric::zero(zero);
        match &self.coupling {
            Coupling::Serial | Coupling::QuasiSerial => {
                sum.add(zero.all(k[0]), column_1);
                // Drive 2 of a parallelogram turns the upper arm and leaves the forearm's direction as it is.
                let quasi = self.coupling == Coupling::QuasiSerial;
                sum.add(k2, if quasi { Triple([ez, zero, -ex]) } else { column_2 });
                sum.add(zero.all(k[2]), column_3);
                sum.add(zero.all(k[3]), along.cross(beyond));
                sum.add(zero.all(k[4]), bend.cross(beyond));
                if !self.tool_is_on_axis_6() {
                    sum.add(zero.all(k[5]), spin.cross(beyond));
                }
            }
            Coupling::Any(a) => {
                let joints =
                    [column_1, column_2, column_3, along.cross(beyond), bend.cross(beyond), spin.cross(beyond)];
                for j in 0..6 {
                    let mut column = Triple([zero; 3]);
                    for i in 0..6 {
                        column = column + joints[i] * a[(i, j)];
                    }
                    sum.add(if j == 1 { k2 } else { zero.all(k[j]) }, column);
                }
            }
        }
        sum
    }
}

/// `1 / (1/k2 + dK)`, see [`GravityCompensator::stiffness`]; NaN where the compensator pushes harder than drive 2 holds.
#[inline(always)]
fn held<S: Simd>(k2: f64, compensator: &GravityCompensator, s2: Lanes<S>, c2: Lanes<S>) -> Lanes<S> {
    let GravityCompensator { base: [bx, bz], arm: [ax, az], stiffness, free_length } = *compensator;
    let (x, z) = (c2 * ax + s2 * az, c2 * az - s2 * ax);
    let (u, v) = (x * bx + z * bz, z * bx - x * bz);
    let length = (u * -2.0 + (bx * bx + bz * bz + ax * ax + az * az)).max(0.0).sqrt();
    let slack = length.all(1.0) - length.all(free_length) / length;
    let added = (slack * u + v * v * free_length / (length * length * length)) * stiffness;
    let held = added * k2 + 1.0;
    held.above(0.0).select(held.all(k2) / held, held.all(f64::NAN))
}

/// A posture in the axes of the arm.
#[derive(Clone, Copy)]
struct At<S: Simd> {
    /// Of the upper arm, from upright.
    s2: Lanes<S>,
    c2: Lanes<S>,
    /// Of the forearm, from upright.
    s23: Lanes<S>,
    c23: Lanes<S>,
    /// Axis of joint 5.
    bend: Triple<S>,
    /// Axis of joint 6.
    spin: Triple<S>,
    /// From the wrist centre to the tool point.
    beyond: Triple<S>,
}

/// A vector in space.
#[derive(Clone, Copy)]
struct Triple<S: Simd>([Lanes<S>; 3]);

impl<S: Simd> Triple<S> {
    /// A vector that is the same in every lane.
    #[inline(always)]
    fn splat(simd: S, v: &Vector3<f64>) -> Self {
        Self([Lanes::splat(simd, v.x), Lanes::splat(simd, v.y), Lanes::splat(simd, v.z)])
    }

    /// Numbers from the same place of three slices.
    #[inline(always)]
    fn load(simd: S, [x, y, z]: [&[f64]; 3]) -> Self {
        Self([Lanes::load(simd, x), Lanes::load(simd, y), Lanes::load(simd, z)])
    }

    /// Seen from axes that are turned by an angle, given by sine and cosine, about z.
    #[inline(always)]
    fn seen_turned(self, s: Lanes<S>, c: Lanes<S>) -> Self {
        let [x, y, z] = self.0;
        Self([c * x + s * y, c * y - s * x, z])
    }

    /// From axes that lean forwards by an angle (about y) into the upright ones.
    #[inline(always)]
    fn uprighted(self, s: Lanes<S>, c: Lanes<S>) -> Self {
        let [x, y, z] = self.0;
        Self([c * x + s * z, y, c * z - s * x])
    }

    #[inline(always)]
    fn parts(self) -> (Lanes<S>, Lanes<S>, Lanes<S>) {
        let [x, y, z] = self.0;
        (x, y, z)
    }

    #[inline(always)]
    fn dot(self, other: Self) -> Lanes<S> {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, other.0);
        ax * bx + ay * by + az * bz
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, other.0);
        Self([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    }
}

impl<S: Simd> std::ops::Add for Triple<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, other.0);
        Self([ax + bx, ay + by, az + bz])
    }
}

impl<S: Simd> std::ops::Mul<f64> for Triple<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let [x, y, z] = self.0;
        Self([x * factor, y * factor, z * factor])
    }
}

impl<S: Simd> std::ops::Mul<Lanes<S>> for Triple<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Lanes<S>) -> Self {
        let [x, y, z] = self.0;
        Self([x * factor, y * factor, z * factor])
    }
}

/// A symmetric 3 x 3 matrix: xx, yy, zz, xy, yz, xz.
#[derive(Clone, Copy)]
struct Symmetric<S: Simd>([Lanes<S>; 6]);

impl<S: Simd> Symmetric<S> {
    #[inline(always)]
    fn zero(zero: Lanes<S>) -> Self {
        Self([zero; 6])
    }

    /// Adds `k v v^T`.
    #[inline(always)]
    fn add(&mut self, k: Lanes<S>, v: Triple<S>) {
        let [x, y, z] = v.0;
        let (kx, ky, kz) = (k * x, k * y, k * z);
        let added = [kx * x, ky * y, kz * z, kx * y, ky * z, kx * z];
        for i in 0..6 {
            self.0[i] = self.0[i] + added[i];
        }
    }

    /// The same in axes of which x and y are turned back by an angle, given by sine and cosine, about z.
    #[inline(always)]
    fn turned(self, s: Lanes<S>, c: Lanes<S>) -> Self {
        let [xx, yy, zz, xy, yz, xz] = self.0;
        let (cc, ss, sc) = (c * c, s * s, s * c);
        let twice = sc * xy * 2.0;
        Self([
            cc * xx + ss * yy - twice,
            ss * xx + cc * yy + twice,
            zz,
            sc * (xx - yy) + (cc - ss) * xy,
            s * xz + c * yz,
            c * xz - s * yz,
        ])
    }

    /// The largest eigenvalue, by the trigonometric solution of the characteristic cubic.
    ///
    /// Relative error below 1e-12, and below 3e-8 where the two largest eigenvalues nearly agree: the square root in the
    /// solution is as ill conditioned there as the direction itself.
    #[inline(always)]
    fn largest(self) -> Lanes<S> {
        let [xx, yy, zz, xy, yz, xz] = self.0;
        let mean = (xx + yy + zz) * (1.0 / 3.0);
        let (a, b, c) = (xx - mean, yy - mean, zz - mean);
        let off = xy * xy + yz * yz + xz * xz;
        let square = (a * a + b * b + c * c + off * 2.0) * (1.0 / 6.0);
        let p = square.sqrt();
        let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
        // Nothing is softer than 1e-60 m/N: a sphere divides zero by a little.
        let r = (determinant * 0.5) / (square * p).max(1e-180);
        mean + p * 2.0 * r.max(-1.0).min(1.0).cos_of_third()
    }
}
