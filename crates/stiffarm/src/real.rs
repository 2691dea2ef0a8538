//! Formulas without branches, written once for numbers, registers and affine forms.

#![allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]

use std::ops::{Add, Mul, Neg, Sub};

/// A number in such a formula: `f64`, a register of several ([`Lanes`](crate::batch)) or an affine form
/// ([`Affine`](crate::enclose::Affine)).
pub(crate) trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
}

impl Real for f64 {}

/// The scalar product.
#[inline(always)]
pub(crate) fn dot<T: Real>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> T {
    ax * bx + ay * by + az * bz
}

/// The vector product.
#[inline(always)]
pub(crate) fn cross<T: Real>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> [T; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// A vector seen from axes that are turned about z by the angle of sine `s` and cosine `c`.
#[inline(always)]
pub(crate) fn seen_turned<T: Real>([x, y, z]: [T; 3], s: T, c: T) -> [T; 3] {
    [c * x + s * y, c * y - s * x, z]
}
