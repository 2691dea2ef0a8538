//! What is counted of a compliance: its largest value in any direction, or what some forces do? In registers.
//!
//! The formulas for some forces are those of [`crate::load`], arranged without branches: every lane takes every way, and the one that
//! holds is chosen.

use nalgebra::Vector3;
use pulp::Simd;

use super::SpatialArm;
use super::lanes::{Lanes, Mask};
use super::posture::{DriveSum, PostureLanes};
use super::vectors::{Symmetric, Triple};
use crate::load::{Component, Forces, Push};

/// Newton steps of the root on a rim. They come from below, where what is computed is too large: after so many by less than 2e-8 of
/// the value where the root is nearly a triple one, and by rounding elsewhere.
const STEPS: usize = 9;
/// Below this part of its usual length a vector is rounding.
const ROUNDING: f64 = 1e-14;
/// Divides what is zero.
const TINY: f64 = 1e-150;

/// What counts of a compliance, m/N.
pub(super) trait Counted: Copy {
    /// What it knows of directions, in axes that turn with joint 1.
    type Seen<S: Simd>: Copy;

    /// Seen from the axes of the arm, which are turned about the vertical by the angle of sine `s` and cosine `c`.
    fn seen<S: Simd>(&self, s: Lanes<S>, c: Lanes<S>) -> Self::Seen<S>;

    /// Of an arm in a posture.
    fn of<S: Simd>(&self, seen: &Self::Seen<S>, arm: &SpatialArm, posture: &PostureLanes<S>) -> Lanes<S>;
}

/// The largest in any direction.
#[derive(Clone, Copy)]
pub(super) struct AnyDirection;

impl Counted for AnyDirection {
    type Seen<S: Simd> = ();

    #[inline(always)]
    fn seen<S: Simd>(&self, _: Lanes<S>, _: Lanes<S>) {}

    #[inline(always)]
    fn of<S: Simd>(&self, (): &(), arm: &SpatialArm, posture: &PostureLanes<S>) -> Lanes<S> {
        arm.translation(posture).largest()
    }
}

/// A known vector, seen from the axes of the arm.
#[inline(always)]
fn turned<S: Simd>(v: &Vector3<f64>, s: Lanes<S>, c: Lanes<S>) -> Triple<S> {
    Triple([s.all(v.x), s.all(v.y), s.all(v.z)]).seen_turned(s, c)
}

/// Vectors of some forces in the axes of the arm.
#[derive(Clone, Copy)]
pub(super) struct SeenForces<S: Simd> {
    /// The axis of their band, and two directions across it.
    axis: Triple<S>,
    across: [Triple<S>; 2],
    normal: Triple<S>,
}

impl Counted for Forces {
    type Seen<S: Simd> = SeenForces<S>;

    #[inline(always)]
    fn seen<S: Simd>(&self, s: Lanes<S>, c: Lanes<S>) -> SeenForces<S> {
        let [first, second] = self.across();
        SeenForces {
            axis: turned(&self.axis(), s, c),
            across: [turned(&first, s, c), turned(&second, s, c)],
            normal: turned(&self.normal(), s, c),
        }
    }

    #[inline(always)]
    fn of<S: Simd>(&self, seen: &SeenForces<S>, arm: &SpatialArm, posture: &PostureLanes<S>) -> Lanes<S> {
        self.of_compliance(seen, &arm.translation(posture))
    }
}

/// Vectors of a push in the axes of the arm.
#[derive(Clone, Copy)]
pub(super) struct SeenPush<S: Simd> {
    force: Triple<S>,
    moment: Triple<S>,
    counted: Triple<S>,
}

/// How far the drives move the tool point under a push.
struct Moved<'a, S: Simd> {
    push: &'a SeenPush<S>,
    sum: Triple<S>,
}

impl<S: Simd> DriveSum<S> for Moved<'_, S> {
    #[inline(always)]
    fn add(&mut self, k: Lanes<S>, column: Triple<S>, axis: Triple<S>) {
        let turn = k * (column.dot(self.push.force) + axis.dot(self.push.moment));
        self.sum = self.sum + column * turn;
    }
}

/// In m, not per N.
impl Counted for Push {
    type Seen<S: Simd> = SeenPush<S>;

    #[inline(always)]
    fn seen<S: Simd>(&self, s: Lanes<S>, c: Lanes<S>) -> SeenPush<S> {
        SeenPush {
            force: turned(&self.force, s, c),
            moment: turned(&self.moment, s, c),
            counted: turned(&self.counted.unwrap_or_else(Vector3::zeros), s, c),
        }
    }

    #[inline(always)]
    fn of<S: Simd>(&self, seen: &SeenPush<S>, arm: &SpatialArm, posture: &PostureLanes<S>) -> Lanes<S> {
        let mut moved = Moved { push: seen, sum: Triple([posture.s2.all(0.0); 3]) };
        arm.add_drives(posture, &mut moved);
        if self.counted.is_some() { moved.sum.dot(seen.counted).abs() } else { moved.sum.length() }
    }
}

impl Forces {
    /// Of a compliance in the axes of the arm.
    #[inline(always)]
    fn of_compliance<S: Simd>(&self, seen: &SeenForces<S>, compliance: &Symmetric<S>) -> Lanes<S> {
        match (self.component(), self.is_one()) {
            (Component::Along, true) => compliance.times(seen.axis).dot(seen.axis),
            (Component::Total, true) => compliance.times(seen.axis).length(),
            (Component::Normal, true) => compliance.times(seen.normal).dot(seen.axis).abs(),
            (Component::Normal, false) => self.linear(seen, compliance.times(seen.normal)),
            (Component::Along, false) => self.quadratic(seen, compliance, compliance),
            (Component::Total, false) => self.quadratic(seen, compliance, &compliance.squared()).abs().sqrt(),
        }
    }

    /// A vector this far along the axis, or the opposite one, lies in the band; of a vector of that length.
    #[inline(always)]
    fn holds_along<S: Simd>(&self, along: Lanes<S>, length: Lanes<S>) -> Mask<S> {
        let [[from, _], [to, _]] = self.rims();
        let (least, most) = (length * to, length * from);
        let here = least.not_above(along) & along.not_above(most);
        here | (least.not_above(-along) & (-along).not_above(most))
    }

    /// The greatest `|w . f|`.
    #[inline(always)]
    fn linear<S: Simd>(&self, seen: &SeenForces<S>, w: Triple<S>) -> Lanes<S> {
        let (along, square) = (w.dot(seen.axis), w.dot(w));
        let (length, aside) = (square.sqrt(), (square - along * along).max(0.0).sqrt());
        let [from, to] = self.rims();
        let first = (along * from[0]).abs() + aside * from[1];
        let last = (along * to[0]).abs() + aside * to[1];
        self.holds_along(along, length).select(length, first.or_more(last))
    }

    /// The greatest `f . M f`, where `M` has the directions of the compliance; of `M` its square root is taken by the caller, where
    /// it is the square.
    #[inline(always)]
    fn quadratic<S: Simd>(&self, seen: &SeenForces<S>, compliance: &Symmetric<S>, m: &Symmetric<S>) -> Lanes<S> {
        let softest = compliance.largest();
        let (along, length) = compliance.along_softest(softest, seen.axis);
        let (w, [e1, e2]) = (m.times(seen.axis), seen.across);
        let (m1, m2) = (m.times(e1), m.times(e2));
        let form = RimForm {
            axis: w.dot(seen.axis),
            mixed: [w.dot(e1), w.dot(e2)],
            across: [m1.dot(e1), m2.dot(e2), m1.dot(e2)],
        };
        let [from, to] = self.rims();
        let rims = form.most(from).or_more(form.most(to));
        let greatest = if self.component() == Component::Total { softest * softest } else { softest };
        self.holds_along(along, length).select(greatest, rims)
    }
}

/// A quadratic form seen along the axis of a band, and in two directions across it.
#[derive(Clone, Copy)]
struct RimForm<S: Simd> {
    axis: Lanes<S>,
    mixed: [Lanes<S>; 2],
    across: [Lanes<S>; 3],
}

impl<S: Simd> RimForm<S> {
    /// Its greatest value at the angle of this cosine and sine off the axis.
    #[inline(always)]
    fn most(&self, [h, s]: [f64; 2]) -> Lanes<S> {
        if s == 0.0 {
            return self.axis;
        }
        let [a, b, o] = self.across;
        let zero = a.all(0.0);
        let (half, o) = ((a - b) * (0.5 * s * s), o * (s * s));
        let radius = (half * half + o * o).sqrt();
        // Cosine and sine of the angle to the softer direction, from those of twice the angle, without loss at either end.
        let safe = radius.max(TINY);
        let far = ((half.abs() / safe + 1.0) * 0.5).sqrt();
        let near = o.abs() / safe * 0.5 / far;
        let sign = o.at_least(0.0);
        let is_first = half.at_least(0.0);
        let (cos, sin) = (is_first.select(far, near), is_first.select(near, far));
        let sin = sign.select(sin, -sin);
        let [x, y] = [self.mixed[0] * (h * s), self.mixed[1] * (h * s)];
        let (q1, q2) = ((x * cos + y * sin).abs(), (y * cos - x * sin).abs());
        let apart = radius * 2.0;
        let mut d = q1.or_more(q2 - apart).max(TINY);
        let mut step = 0;
        while step < STEPS {
            let (p1, p2) = (q1 / d, q2 / (d + apart));
            let (a, b) = (p1 * p1, p2 * p2);
            let phi = a + b;
            let more = (phi * (phi.sqrt() - 1.0)).or_more(zero);
            d = d + more / (a / d + b / (d + apart)).max(TINY * TINY);
            step += 1;
        }
        self.axis * (h * h)
            + (self.across[0] + self.across[1]) * (0.5 * s * s)
            + radius
            + d
            + q1 * (q1 / d)
            + q2 * (q2 / (d + apart))
    }
}

impl<S: Simd> Symmetric<S> {
    /// How far the softest direction, of the largest eigenvalue, reaches along an axis, and its length.
    ///
    /// A product of two rows of what the eigenvalue leaves of the matrix, the longest of three. Where two eigenvalues agree it is one
    /// across the axis: some softest direction is.
    #[inline(always)]
    fn along_softest(&self, largest: Lanes<S>, axis: Triple<S>) -> (Lanes<S>, Lanes<S>) {
        let [xx, yy, zz, xy, yz, xz] = self.0;
        let (x, y, z) =
            (Triple([xx - largest, xy, xz]), Triple([xy, yy - largest, yz]), Triple([xz, yz, zz - largest]));
        let products = [x.cross(y), y.cross(z), z.cross(x)];
        let (mut along, mut square) = (products[0].dot(axis), products[0].dot(products[0]));
        for i in 1..3 {
            let other = products[i].dot(products[i]);
            let is_longer = square.not_above(other);
            along = is_longer.select(products[i].dot(axis), along);
            square = is_longer.select(other, square);
        }
        let length = square.sqrt();
        let is_known = (largest * largest * ROUNDING).not_above(length);
        (is_known.select(along, length.all(0.0)), is_known.select(length, length.all(1.0)))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use pulp::WithSimd;

    use super::*;
    use crate::load::Load;

    /// One compliance under one load, in axes turned by an angle.
    struct Job<'a>(&'a Matrix3<f64>, &'a Forces, f64);

    impl WithSimd for Job<'_> {
        type Output = f64;
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> f64 {
            let Self(m, forces, angle) = self;
            let all = |x: f64| Lanes::splat(simd, x);
            let upright = Symmetric([
                all(m[(0, 0)]),
                all(m[(1, 1)]),
                all(m[(2, 2)]),
                all(m[(0, 1)]),
                all(m[(1, 2)]),
                all(m[(0, 2)]),
            ]);
            let (s, c) = all(angle).sin_cos();
            let mut found = [0.0; 8];
            // What is given in base axes is seen by the arm turned back.
            forces.of_compliance(&forces.seen(s, c), &upright.turned(-s, c)).store(&mut found[..S::F64_LANES]);
            found[0]
        }
    }

    #[test]
    fn registers_find_what_single_compliances_have() {
        let mut rng = fastrand::Rng::with_seed(71);
        for case in 0..6000 {
            let mut any = || 2.0 * rng.f64() - 1.0;
            let columns: [Vector3<f64>; 6] = std::array::from_fn(|_| Vector3::from_fn(|_, _| any()));
            let values: [f64; 3] = [any().abs(), any().abs(), any().abs()];
            let m: Matrix3<f64> = match case % 5 {
                0 => Matrix3::from_diagonal_element(values[0]),
                1 => Matrix3::from_diagonal(&Vector3::new(values[0], values[1], values[1])),
                2 => columns[0] * columns[0].transpose(),
                // Two softest directions that nearly agree.
                3 => Matrix3::from_diagonal(&Vector3::new(values[0], 1.0 + 1e-9 * values[1], 1.0)),
                _ => columns.iter().map(|v| v * v.transpose()).sum(),
            } * 1e-6;
            let force = [any(), any(), any()].map(|part| 300.0 * part);
            let feed = [None, Some(3.0 * any())][case % 2];
            let base = [Load::along_tool(force, feed), Load::along_base(force), Load::worst(1.0)];
            let cone = [0.0, any().abs(), 1.5 * any().abs()][case % 3];
            let component = [Component::Total, Component::Normal, Component::Along][case / 3 % 3];
            let load = base[case / 9 % 3].clone().unwrap().with_cone(cone).unwrap().counting(component);
            let x = columns[1].normalize();
            let y = x.cross(&columns[2]).normalize();
            let forces = load.forces(&Matrix3::from_columns(&[x, y, x.cross(&y)]));
            let found = pulp::Arch::new().dispatch(Job(&m, &forces, 3.0 * any()));
            let expected = forces.largest(&m).value;
            // Eigenvalues that nearly agree are known to 3e-8, and the root on a rim to 2e-8.
            assert!((found - expected).abs() <= 6e-8 * m.norm(), "case {case}, {load:?}: {found:e} {expected:e}");
        }
    }
}
