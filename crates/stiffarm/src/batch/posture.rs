//! How compliant is the tool point at postures of which sines and cosines are known?

use pulp::Simd;

use super::lanes::Lanes;
use super::vectors::{Symmetric, Triple};
use super::{Coupling, SpatialArm};
use crate::drive::GravityCompensator;
use crate::geometry::Geometry;
use crate::real::Real;

/// Postures, one a lane, in the axes of the arm: x forwards in the arm plane, y across, z up.
#[derive(Clone, Copy)]
pub(super) struct PostureLanes<S: Simd> {
    /// Sine and cosine of the upper arm's angle from upright, theta 2.
    pub(super) s2: Lanes<S>,
    pub(super) c2: Lanes<S>,
    /// Sine and cosine of the forearm's angle from upright, `theta2 + theta3`.
    pub(super) s23: Lanes<S>,
    pub(super) c23: Lanes<S>,
    /// Axis of joint 5.
    pub(super) axis_5: Triple<S>,
    /// Axis of joint 6.
    pub(super) axis_6: Triple<S>,
    /// From the wrist centre to the tool point, m.
    pub(super) wrist_to_tool: Triple<S>,
}

/// Columns of the Jacobian for joints 1, 2 and 3, in the axes of the arm: what turning each by 1 rad moves the tool point by, m/rad.
///
/// The tool point lies `aside` of the arm plane, and `[forwards, up]` from the joint-2 axis and from the elbow.
#[inline(always)]
pub(crate) fn arm_columns<T: Real>(
    geometry: &Geometry,
    zero: T,
    aside: T,
    [px, pz]: [T; 2],
    [fx, fz]: [T; 2],
) -> [[T; 3]; 3] {
    [[-(aside + geometry.b), px + geometry.a1, zero], [pz, zero, -px], [fz, zero, -fx]]
}

/// What the drives add up to.
pub(super) trait DriveSum<S: Simd> {
    /// Adds a drive of compliance `k`, rad/(N m): turned by 1 rad it moves the tool point by `column`, m, and turns the tool by `axis`;
    /// both in the axes of the arm.
    fn add(&mut self, k: Lanes<S>, column: Triple<S>, axis: Triple<S>);
}

impl<S: Simd> DriveSum<S> for Symmetric<S> {
    #[inline(always)]
    fn add(&mut self, k: Lanes<S>, column: Triple<S>, _: Triple<S>) {
        self.add_square(k, column);
    }
}

impl SpatialArm {
    /// Translations per force at the tool point, in the axes of the arm: x forwards in the arm plane, y across, z up.
    #[inline(always)]
    pub(super) fn translation<S: Simd>(&self, at: &PostureLanes<S>) -> Symmetric<S> {
        let mut sum = Symmetric::zero(at.s2.all(0.0));
        self.add_drives(at, &mut sum);
        sum
    }

    /// Adds every drive.
    #[inline(always)]
    pub(super) fn add_drives<S: Simd>(&self, at: &PostureLanes<S>, sum: &mut impl DriveSum<S>) {
        let PostureLanes { s2, c2, s23, c23, axis_5, axis_6, wrist_to_tool } = *at;
        let Geometry { a2, c2: upper, c3, .. } = self.geometry;
        let zero = s2.all(0.0);
        let (ex, ez) = (s2 * upper, c2 * upper);
        let (ux, uy, uz) = wrist_to_tool.parts();
        // From the joint-2 axis, and from the elbow.
        let (fx, fz) = (s23 * c3 + c23 * a2 + ux, c23 * c3 - s23 * a2 + uz);
        let (px, pz) = (ex + fx, ez + fz);
        let [column_1, column_2, column_3] = arm_columns(&self.geometry, zero, uy, [px, pz], [fx, fz]);
        let (column_1, column_2, column_3) = (Triple(column_1), Triple(column_2), Triple(column_3));
        let along = Triple([s23, zero, c23]);
        let k = self.k;
        let k2 = match &self.compensator {
            None => s2.all(k[1]),
            Some(compensator) => compensated(k[1], compensator, s2, c2),
        };
        let one = zero.all(1.0);
        let (up, left, none) = (Triple([zero, zero, one]), Triple([zero, one, zero]), Triple([zero; 3]));
        match &self.coupling {
            Coupling::Serial | Coupling::QuasiSerial => {
                sum.add(zero.all(k[0]), column_1, up);
                // Drive 2 of a parallelogram turns the upper arm and leaves the forearm's direction as it is.
                let quasi = self.coupling == Coupling::QuasiSerial;
                let (column_2, axis_2) = if quasi { (Triple([ez, zero, -ex]), none) } else { (column_2, left) };
                sum.add(k2, column_2, axis_2);
                sum.add(zero.all(k[2]), column_3, left);
                sum.add(zero.all(k[3]), along.cross(wrist_to_tool), along);
                sum.add(zero.all(k[4]), axis_5.cross(wrist_to_tool), axis_5);
                if !self.tool_is_on_axis_6() {
                    sum.add(zero.all(k[5]), axis_6.cross(wrist_to_tool), axis_6);
                }
            }
            Coupling::Any(a) => {
                let axes = [up, left, left, along, axis_5, axis_6];
                let joints = [
                    column_1,
                    column_2,
                    column_3,
                    along.cross(wrist_to_tool),
                    axis_5.cross(wrist_to_tool),
                    axis_6.cross(wrist_to_tool),
                ];
                for j in 0..6 {
                    let (mut column, mut axis) = (none, none);
                    for i in 0..6 {
                        column = column + joints[i] * a[(i, j)];
                        axis = axis + axes[i] * a[(i, j)];
                    }
                    sum.add(if j == 1 { k2 } else { zero.all(k[j]) }, column, axis);
                }
            }
        }
    }
}

/// `1 / (1/k2 + dK)`, see [`GravityCompensator::stiffness`]; NaN where the compensator pushes harder than drive 2 holds.
#[inline(always)]
fn compensated<S: Simd>(k2: f64, compensator: &GravityCompensator, s2: Lanes<S>, c2: Lanes<S>) -> Lanes<S> {
    let GravityCompensator { base: [bx, bz], arm: [ax, az], stiffness, free_length } = *compensator;
    let (u, v) = compensator.products(s2, c2);
    let length = (u * -2.0 + (bx * bx + bz * bz + ax * ax + az * az)).max(0.0).sqrt();
    let slack = length.all(1.0) - length.all(free_length) / length;
    let added = (slack * u + v * v * free_length / (length * length * length)) * stiffness;
    let held = added * k2 + 1.0;
    held.above(0.0).select(held.all(k2) / held, held.all(f64::NAN))
}
