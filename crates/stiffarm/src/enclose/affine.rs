//! Affine arithmetic: how does a number depend on a few variables, and how far can it be from that?

use std::ops::{Add, Mul, Neg, Sub};

use crate::interval::Interval;
use crate::real::Real;

/// A clipped number forgets how it depends on the variables where what is known of its range is narrower by this factor.
const FORGET: f64 = 0.6;

/// An affine form: a number that depends on `N` variables, each anywhere in `-1..1`, and differs from
/// `centre + deviations . variables` by at most `remainder`.
///
/// A formula that is evaluated with affine forms gives one that holds for all values of the variables at which the formula
/// itself holds. First-order dependence is carried along and cancels where it should; `remainder` is of second order.
/// Rounding is not counted. NaN means that nothing is known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Affine<const N: usize> {
    pub(crate) centre: f64,
    pub(crate) deviations: [f64; N],
    pub(crate) remainder: f64,
}

impl<const N: usize> Affine<N> {
    /// A known number.
    pub(crate) const fn point(x: f64) -> Self {
        Self { centre: x, deviations: [0.0; N], remainder: 0.0 }
    }

    /// How far from the middle it can be.
    #[inline]
    pub(crate) fn radius(&self) -> f64 {
        self.deviations.iter().fold(self.remainder, |sum, slope| sum + slope.abs())
    }

    /// The least it can be.
    #[inline]
    pub(crate) fn min(&self) -> f64 {
        self.centre - self.radius()
    }

    /// The most it can be.
    #[inline]
    pub(crate) fn max(&self) -> f64 {
        self.centre + self.radius()
    }

    /// Nothing is known of it.
    pub(crate) fn is_unknown(&self) -> bool {
        !(self.radius() < f64::INFINITY)
    }

    /// Its square, which is never negative.
    #[inline]
    pub(crate) fn square(self) -> Self {
        let radius = self.radius();
        // (m + d)^2 = m^2 + 2 m d + d^2 with d^2 in 0..radius^2.
        let half = radius * radius / 2.0;
        Self {
            centre: self.centre * self.centre + half,
            deviations: self.deviations.map(|slope| 2.0 * self.centre * slope),
            remainder: 2.0 * self.centre.abs() * self.remainder + half,
        }
    }

    /// The same number, where it lies in `known` whatever the variables are: forgets how it depends on them where that says less.
    #[inline]
    pub(crate) fn clipped(self, known: Interval) -> Self {
        let (least, most) = (self.min().max(known.min()), self.max().min(known.max()));
        let half = (most - least) / 2.0;
        if half < FORGET * self.radius() || self.is_unknown() {
            Self { remainder: half.max(0.0), ..Self::point(f64::midpoint(least, most)) }
        } else {
            self
        }
    }

    /// `f` of a number that lies in `known`, for a concave `f` that gives its value and its slope; `None` where the number
    /// cannot lie there.
    ///
    /// A concave function lies below its tangent in the middle, and farthest below it at an end.
    #[inline]
    pub(crate) fn concave(self, known: Interval, f: impl Fn(f64) -> (f64, f64)) -> Option<Self> {
        let (least, most) = (self.min().max(known.min()), self.max().min(known.max()));
        if most < least {
            return None;
        }
        let middle = f64::midpoint(least, most);
        let (top, slope) = f(middle);
        if least == most {
            return Some(Self::point(top));
        }
        let below = |x: f64| top + slope * (x - middle) - f(x).0;
        let remainder = below(least).max(below(most)).max(0.0) / 2.0;
        Some(Self {
            centre: top - remainder + slope * (self.centre - middle),
            deviations: self.deviations.map(|part| slope * part),
            remainder: slope.abs() * self.remainder + remainder,
        })
    }

    /// The root of what is not negative; `None` where it is negative for certain.
    #[inline]
    pub(crate) fn sqrt(self) -> Option<Self> {
        self.concave(Interval::POSITIVE, |x| (x.sqrt(), 0.5 / x.sqrt()))
    }

    /// `1/x` of what lies in `known`, a range of positive numbers.
    #[inline]
    pub(crate) fn inverse(self, known: Interval) -> Option<Self> {
        Some(-self.concave(known, |x| (-1.0 / x, 1.0 / (x * x)))?)
    }
}

/// Sine and cosine of the angles in a range, which variable `variable` runs through.
pub(crate) fn sin_cos<const N: usize>(angles: Interval, variable: usize) -> (Affine<N>, Affine<N>) {
    let ((s, c), half) = (angles.middle().sin_cos(), angles.width() / 2.0);
    if 1.2 < half {
        let anything = Affine { remainder: 1.0, ..Affine::point(0.0) };
        return (anything, anything);
    }
    // With d in -half..half: cos d in cos(half)..1, and sin d from (1 - half^2/8) d by at most half^3/24 + half^5/120.
    let lost = (1.0 - half.cos()) / 2.0;
    let bent = half.powi(3) / 24.0 + half.powi(5) / 120.0;
    let linear = half * (1.0 - half * half / 8.0);
    let turned = |of: f64, by: f64| {
        let mut deviations = [0.0; N];
        if 0.0 < half {
            deviations[variable] = by * linear;
        }
        Affine { centre: of * (1.0 - lost), deviations, remainder: of.abs() * lost + by.abs() * bent }
    };
    (turned(s, c), turned(c, -s))
}

impl<const N: usize> Real for Affine<N> {}

impl<const N: usize> Add for Affine<N> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let deviations = std::array::from_fn(|i| self.deviations[i] + other.deviations[i]);
        Self { centre: self.centre + other.centre, deviations, remainder: self.remainder + other.remainder }
    }
}

impl<const N: usize> Sub for Affine<N> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const N: usize> Neg for Affine<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { centre: -self.centre, deviations: self.deviations.map(|slope| -slope), remainder: self.remainder }
    }
}

impl<const N: usize> Add<f64> for Affine<N> {
    type Output = Self;
    #[inline]
    fn add(self, other: f64) -> Self {
        Self { centre: self.centre + other, ..self }
    }
}

impl<const N: usize> Mul<f64> for Affine<N> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        let deviations = self.deviations.map(|slope| slope * factor);
        Self { centre: self.centre * factor, deviations, remainder: self.remainder * factor.abs() }
    }
}

impl<const N: usize> Mul for Affine<N> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.centre, other.centre);
        let (mut squares, mut spread) = (0.0, 0.0);
        let deviations = std::array::from_fn(|i| {
            // The square of a variable lies in 0..1: half of it goes to the middle.
            let both = self.deviations[i] * other.deviations[i] / 2.0;
            squares += both;
            spread += both.abs();
            a * other.deviations[i] + b * self.deviations[i]
        });
        let remainder =
            a.abs() * other.remainder + b.abs() * self.remainder + (self.radius() * other.radius() - spread);
        Self { centre: a * b + squares, deviations, remainder }
    }
}

/// A vector in space.
pub(crate) type Vector<const N: usize> = [Affine<N>; 3];

/// `a + b`.
pub(crate) fn sum<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    std::array::from_fn(|i| a[i] + b[i])
}

/// `v` times a known factor.
pub(crate) fn scaled<const N: usize>(v: &Vector<N>, factor: f64) -> Vector<N> {
    v.map(|part| part * factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_computed_with_affine_numbers_holds_for_all_values_of_the_variables() {
        let mut rng = fastrand::Rng::with_seed(31);
        for _ in 0..3000 {
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let at: [f64; 3] = std::array::from_fn(|_| part(-1.0, 1.0));
            let mut number = || {
                let deviations: [f64; 3] = std::array::from_fn(|_| part(-0.5, 0.5));
                let remainder = part(0.0, 0.2);
                let x = Affine { centre: part(-2.0, 2.0), deviations, remainder };
                let value = x.centre + (0..3).map(|i| deviations[i] * at[i]).sum::<f64>() + remainder * part(-1.0, 1.0);
                (x, value)
            };
            let ((a, x), (b, y)) = (number(), number());
            let angles = Interval::spanning(y, y + part(0.0, 2.0));
            let angle = angles.middle() + at[1] * angles.width() / 2.0;
            let (sine, cosine) = sin_cos::<3>(angles, 1);
            let positive = Interval::spanning(1e-3, f64::INFINITY);
            let mut all = vec![
                (a + b, x + y),
                (a - b, x - y),
                (a * b, x * y),
                (a * -3.0, x * -3.0),
                (a.square(), x * x),
                (sine, angle.sin()),
                (cosine, angle.cos()),
            ];
            if 1e-3 < x {
                all.push((a.sqrt().unwrap(), x.sqrt()));
                all.push((a.inverse(positive).unwrap(), 1.0 / x));
            }
            for (found, value) in all {
                let linear = found.centre + (0..3).map(|i| found.deviations[i] * at[i]).sum::<f64>();
                assert!((value - linear).abs() <= found.remainder + 1e-9 * (1.0 + value.abs()), "{found:?} {value}");
                assert!(found.min() - 1e-9 <= value && value <= found.max() + 1e-9 * (1.0 + value.abs()));
            }
        }
    }

    #[test]
    fn halving_the_variables_quarters_what_is_left_over() {
        let remainder = |half: f64| {
            let (s, c) = sin_cos::<1>(Interval::spanning(0.5 - half, 0.5 + half), 0);
            let sum = (s * c + s.square() + 1.0).sqrt().unwrap();
            (sum.inverse(Interval::spanning(0.1, 9.0)).unwrap() * c).remainder
        };
        assert!(
            (3.5..4.5).contains(&(remainder(0.1) / remainder(0.05)))
                && (3.8..4.2).contains(&(remainder(0.01) / remainder(0.005)))
        );
    }
}
