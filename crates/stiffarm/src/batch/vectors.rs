//! Vectors and symmetric matrices of registers.

use nalgebra::Vector3;
use pulp::Simd;

use super::lanes::Lanes;
use crate::real::{cross, dot, seen_turned};

/// A vector in space.
#[derive(Clone, Copy)]
pub(super) struct Triple<S: Simd>(pub(super) [Lanes<S>; 3]);

impl<S: Simd> Triple<S> {
    /// A vector that is the same in every lane.
    #[inline(always)]
    pub(super) fn splat(simd: S, v: &Vector3<f64>) -> Self {
        Self([Lanes::splat(simd, v.x), Lanes::splat(simd, v.y), Lanes::splat(simd, v.z)])
    }

    /// One register from each of three slices.
    #[inline(always)]
    pub(super) fn load(simd: S, [x, y, z]: [&[f64]; 3]) -> Self {
        Self([Lanes::load(simd, x), Lanes::load(simd, y), Lanes::load(simd, z)])
    }

    /// Seen from axes that are turned by an angle, given by sine and cosine, about z.
    #[inline(always)]
    pub(super) fn seen_turned(self, s: Lanes<S>, c: Lanes<S>) -> Self {
        Self(seen_turned(self.0, s, c))
    }

    /// Given in axes that lean forwards by an angle (about y); seen from the upright ones.
    #[inline(always)]
    pub(super) fn uprighted(self, s: Lanes<S>, c: Lanes<S>) -> Self {
        let [x, y, z] = self.0;
        Self([c * x + s * z, y, c * z - s * x])
    }

    #[inline(always)]
    pub(super) fn parts(self) -> (Lanes<S>, Lanes<S>, Lanes<S>) {
        let [x, y, z] = self.0;
        (x, y, z)
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> Lanes<S> {
        dot(self.0, other.0)
    }

    #[inline(always)]
    pub(super) fn length(self) -> Lanes<S> {
        self.dot(self).sqrt()
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Self {
        Self(cross(self.0, other.0))
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
pub(super) struct Symmetric<S: Simd>(pub(super) [Lanes<S>; 6]);

impl<S: Simd> Symmetric<S> {
    #[inline(always)]
    pub(super) fn zero(zero: Lanes<S>) -> Self {
        Self([zero; 6])
    }

    /// Adds `k v v^T`.
    #[inline(always)]
    pub(super) fn add_square(&mut self, k: Lanes<S>, v: Triple<S>) {
        let [x, y, z] = v.0;
        let (kx, ky, kz) = (k * x, k * y, k * z);
        let added = [kx * x, ky * y, kz * z, kx * y, ky * z, kx * z];
        for i in 0..6 {
            self.0[i] = self.0[i] + added[i];
        }
    }

    /// Its product with a vector.
    #[inline(always)]
    pub(super) fn times(&self, v: Triple<S>) -> Triple<S> {
        let [xx, yy, zz, xy, yz, xz] = self.0;
        Triple([dot([xx, xy, xz], v.0), dot([xy, yy, yz], v.0), dot([xz, yz, zz], v.0)])
    }

    /// Its product with itself.
    #[inline(always)]
    pub(super) fn squared(&self) -> Self {
        let [xx, yy, zz, xy, yz, xz] = self.0;
        let (x, y, z) = ([xx, xy, xz], [xy, yy, yz], [xz, yz, zz]);
        Self([dot(x, x), dot(y, y), dot(z, z), dot(x, y), dot(y, z), dot(x, z)])
    }

    /// The same in axes of which x and y are turned back by an angle, given by sine and cosine, about z.
    #[inline(always)]
    pub(super) fn turned(self, s: Lanes<S>, c: Lanes<S>) -> Self {
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
    pub(super) fn largest(self) -> Lanes<S> {
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
