//! Several numbers that go through one formula together.
//!
//! A formula is written once, with the operators of [`Lanes`], and runs on as many numbers at a time as the machine's
//! registers hold. Only operations that round alike everywhere are used (no fused multiply-add), so every machine gives
//! the same bits. In such formulas there are no closures and no iterators over lanes: the compiler puts those into
//! functions of their own, which lack the wide instructions and make the whole three times slower.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use pulp::Simd;

use crate::real::Real;

/// More numbers than any register holds.
pub(super) const WIDEST: usize = 8;

/// One register of numbers.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    value: S::f64s,
}

/// One truth value per number.
#[derive(Clone, Copy)]
pub(crate) struct Mask<S: Simd> {
    simd: S,
    value: S::m64s,
}

macro_rules! operator {
    ($trait:ident, $name:ident, $operation:ident) => {
        impl<S: Simd> $trait for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self { simd: self.simd, value: self.simd.$operation(self.value, other.value) }
            }
        }
        impl<S: Simd> $trait<f64> for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                $trait::$name(self, self.all(other))
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { simd: self.simd, value: self.simd.neg_f64s(self.value) }
    }
}

impl<S: Simd> Real for Lanes<S> {}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn splat(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }

    /// `value` in every lane.
    #[inline(always)]
    pub(crate) fn all(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// The first numbers of a slice; zero where it is too short.
    #[inline(always)]
    pub(crate) fn load(simd: S, from: &[f64]) -> Self {
        Self { simd, value: simd.partial_load_f64s(from) }
    }

    /// Into the first places of a slice.
    #[inline(always)]
    pub(crate) fn store(self, into: &mut [f64]) {
        self.simd.partial_store_f64s(into, self.value);
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        Self { simd: self.simd, value: self.simd.sqrt_f64s(self.value) }
    }

    #[inline(always)]
    pub(crate) fn max(self, other: f64) -> Self {
        Self { simd: self.simd, value: self.simd.max_f64s(self.value, self.simd.splat_f64s(other)) }
    }

    #[inline(always)]
    pub(crate) fn min(self, other: f64) -> Self {
        Self { simd: self.simd, value: self.simd.min_f64s(self.value, self.simd.splat_f64s(other)) }
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        Self { simd: self.simd, value: self.simd.abs_f64s(self.value) }
    }

    /// The larger one; `self` where either is NaN.
    #[inline(always)]
    pub(crate) fn or_more(self, other: Self) -> Self {
        self.not_above(other).select(other, self)
    }

    /// The smaller one; `other` where either is NaN.
    #[inline(always)]
    pub(crate) fn or_less(self, other: Self) -> Self {
        self.not_above(other).select(self, other)
    }

    /// False where either is NaN.
    #[inline(always)]
    pub(crate) fn at_most(self, other: f64) -> Mask<S> {
        self.not_above(self.all(other))
    }

    /// False where either is NaN.
    #[inline(always)]
    pub(crate) fn not_above(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_or_equal_f64s(self.value, other.value) }
    }

    /// False where it is NaN.
    #[inline(always)]
    pub(crate) fn at_least(self, other: f64) -> Mask<S> {
        self.all(other).not_above(self)
    }

    /// False where it is NaN.
    #[inline(always)]
    pub(crate) fn above(self, other: f64) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_f64s(self.simd.splat_f64s(other), self.value) }
    }

    /// Sine and cosine, to two units in the last place for angles up to 1e5 rad.
    ///
    /// Reduction to a quarter turn in three parts (Cody and Waite), kernels with the coefficients of fdlibm.
    #[inline(always)]
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        /// `1.5 * 2^52`: adding it leaves the nearest whole number in the last bits.
        const ROUNDER: f64 = 6_755_399_441_055_744.0;
        /// A quarter turn in three parts of 33 bits, so that products with quarter turns counted below 2^20 are exact.
        const QUARTER: [f64; 3] = [
            f64::from_bits(0x3FF9_21FB_5440_0000),
            f64::from_bits(0x3DD0_B461_1A60_0000),
            f64::from_bits(0x3BA3_198A_2E03_7073),
        ];
        let simd = self.simd;
        let rounded = self * std::f64::consts::FRAC_2_PI + ROUNDER;
        let turns = rounded - ROUNDER;
        let x = self - turns * QUARTER[0] - turns * QUARTER[1] - turns * QUARTER[2];
        let z = x * x;
        let sine = (z * 1.589_690_995_211_55e-10 - 2.505_076_025_340_686_3e-8) * z + 2.755_731_370_707_006_8e-6;
        let sine =
            ((sine * z - 1.984_126_982_985_795e-4) * z + 8.333_333_333_322_49e-3) * z - 1.666_666_666_666_663_2e-1;
        let sine = x + x * z * sine;
        let cosine = (z * -1.135_964_755_778_819_5e-11 + 2.087_572_321_298_175e-9) * z - 2.755_731_435_139_066_3e-7;
        let cosine =
            ((cosine * z + 2.480_158_728_947_673e-5) * z - 1.388_888_888_887_411e-3) * z + 4.166_666_666_666_66e-2;
        let cosine = self.all(1.0) - (z * 0.5 - z * z * cosine);
        let bits = simd.transmute_u64s_f64s(rounded.value);
        let next = simd.add_u64s(bits, simd.splat_u64s(1));
        let odd = Mask::of_bit(simd, bits, 1);
        let s = odd.select(cosine, sine);
        let c = odd.select(sine, cosine);
        (Mask::of_bit(simd, bits, 2).select(-s, s), Mask::of_bit(simd, next, 2).select(-c, c))
    }

    /// The angle of a vector from its parts across (`self`) and along (`x`), in `[-pi, pi]`, to 9e-16 rad; 0 of a vector of no length.
    ///
    /// Reduction to an eighth of a half turn and the rational function of the Cephes library.
    #[inline(always)]
    pub(crate) fn atan2(self, x: Self) -> Self {
        /// Tangent of an eighth of a half turn.
        const EIGHTH: f64 = std::f64::consts::SQRT_2 - 1.0;
        let (across, along) = (self.abs(), x.abs());
        let (small, large) = (across.or_less(along), across.or_more(along));
        let is_far = (large * EIGHTH).not_above(small);
        let t = is_far.select(small - large, small) / is_far.select(small + large, large).max(f64::MIN_POSITIVE);
        let z = t * t;
        let over = ((z * -8.750_608_600_031_904e-1 - 1.615_753_718_733_365_2e1) * z - 7.500_855_792_314_704e1) * z;
        let over = (over - 1.228_866_684_490_136_1e2) * z - 6.485_021_904_942_025e1;
        let under = ((z + 2.485_846_490_142_306_4e1) * z + 1.650_270_098_316_988_6e2) * z + 4.328_810_604_912_902_7e2;
        let under = (under * z + 4.853_903_996_359_137e2) * z + 1.945_506_571_482_614e2;
        let angle = t + t * (z * over / under);
        let angle = is_far.select(angle + std::f64::consts::FRAC_PI_4, angle);
        let angle = along.not_above(across).select(-angle + std::f64::consts::FRAC_PI_2, angle);
        let angle = x.at_least(0.0).select(angle, -angle + std::f64::consts::PI);
        self.at_least(0.0).select(angle, -angle)
    }

    /// `cos(acos(r) / 3)` for `-1 <= r <= 1`, to a few units in the last place.
    ///
    /// With `w = cos(acos(r) / 2) = sqrt((1 + r) / 2)` it is `cos(2 acos(w) / 3)`, analytic over `0 <= w <= 1`: the
    /// polynomial of degree 19 through its Chebyshev nodes, in powers of `2 w - 1`, errs by 4e-18.
    #[inline(always)]
    pub(crate) fn cos_of_third(self) -> Self {
        let t = ((self + 1.0) * 0.5).sqrt() * 2.0 - 1.0;
        let square = t * t;
        let (pairs, _) = COS_OF_THIRD.as_chunks::<2>();
        let mut sum = t.all(0.0);
        let mut pair = pairs.len();
        while 0 < pair {
            pair -= 1;
            let [low, high] = pairs[pair];
            sum = sum * square + (t * high + low);
        }
        sum
    }
}

/// Powers 0 to 19.
const COS_OF_THIRD: [f64; 20] = [
    0.766_044_443_118_978,
    0.247_409_066_322_853_06,
    -0.015_509_188_436_486_411,
    0.002_466_352_815_086_79,
    -0.000_504_124_691_125_376_7,
    0.000_116_425_452_944_448_14,
    -2.891_993_643_683_692e-05,
    7.541_078_562_973_618e-06,
    -2.035_868_987_785_237_4e-06,
    5.641_513_013_162_363e-07,
    -1.595_453_240_946_078_4e-07,
    4.585_956_696_860_073e-08,
    -1.334_528_077_449_987_6e-08,
    3.930_791_342_395_576e-09,
    -1.187_929_935_005_109_8e-09,
    3.562_932_068_912_361e-10,
    -9.132_784_713_576_347e-11,
    2.764_576_356_002_820_6e-11,
    -1.607_897_317_054_549_7e-11,
    4.954_138_756_490_871e-12,
];

impl<S: Simd> Mask<S> {
    /// True where the bits that are set in `which` are set.
    #[inline(always)]
    fn of_bit(simd: S, bits: S::u64s, which: u64) -> Self {
        let which = simd.splat_u64s(which);
        Self { simd, value: simd.equal_u64s(simd.and_u64s(bits, which), which) }
    }

    /// Anywhere.
    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.simd.first_true_m64s(self.value) < S::F64_LANES
    }

    #[inline(always)]
    pub(crate) fn select(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        Lanes { simd: self.simd, value: self.simd.select_f64s(self.value, yes.value, no.value) }
    }
}

impl<S: Simd> BitAnd for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self { simd: self.simd, value: self.simd.and_m64s(self.value, other.value) }
    }
}

impl<S: Simd> BitOr for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self { simd: self.simd, value: self.simd.or_m64s(self.value, other.value) }
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self { simd: self.simd, value: self.simd.not_m64s(self.value) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Applies `f` lane by lane with what the machine has.
    fn each(xs: &[f64], f: impl Fn(f64, [f64; 4])) {
        struct Job<'a>(&'a [f64], Vec<[f64; 4]>);
        impl pulp::WithSimd for Job<'_> {
            type Output = Vec<[f64; 4]>;
            #[inline(always)]
            fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
                for chunk in self.0.chunks(S::F64_LANES) {
                    let x = Lanes::load(simd, chunk);
                    let (s, c) = x.sin_cos();
                    let third = x.cos_of_third();
                    let turn = s.atan2(c);
                    let mut all = [[0.0; 8]; 4];
                    for (row, value) in all.iter_mut().zip([s, c, third, turn]) {
                        value.store(&mut row[..chunk.len()]);
                    }
                    self.1.extend((0..chunk.len()).map(|i| all.map(|row| row[i])));
                }
                self.1
            }
        }
        for (x, found) in xs.iter().zip(pulp::Arch::new().dispatch(Job(xs, Vec::new()))) {
            f(*x, found);
        }
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_standard_library() {
        let mut rng = fastrand::Rng::with_seed(1);
        let quarter = std::f64::consts::FRAC_PI_2;
        let mut xs: Vec<f64> =
            (0..100_000).map(|i| if i % 2 == 0 { 8.0 } else { 1e5 } * (2.0 * rng.f64() - 1.0)).collect();
        xs.extend(
            (-40..=40)
                .flat_map(|i| [f64::from(i) * quarter, f64::from(i) * quarter + 1e-9, f64::from(i) * quarter / 2.0]),
        );
        each(&xs, |x, [s, c, _, turn]| {
            // Two units in the last place of a number near 1; near a zero the reduction keeps 1e-17 absolute.
            assert!((s - x.sin()).abs() <= 3e-16 && (c - x.cos()).abs() <= 3e-16, "{x}: {s} {c}");
            // A unit in the last place of the angle, and the same of the constants that are added.
            assert!((turn - s.atan2(c)).abs() <= 9e-16, "{x}: {turn} {}", s.atan2(c));
            let relative = 1e-13_f64; // at zeros up to 1e5 / quarter turns away, the third part leaves 1e-21
            assert!((s - x.sin()).abs() <= relative * x.sin().abs().max(1e-9), "{x}");
        });
    }

    #[test]
    fn a_third_of_the_angle_is_found_up_to_both_ends() {
        let mut rng = fastrand::Rng::with_seed(2);
        let mut xs: Vec<f64> = (0..20_000).map(|_| 2.0 * rng.f64() - 1.0).collect();
        xs.extend([-1.0, 1.0, 0.0, -1.0 + 1e-15, 1.0 - 1e-15]);
        each(&xs, |x, [_, _, third, _]| {
            // The standard acos is as ill conditioned at the ends as the square root: compare through the triple angle.
            assert!((4.0 * third.powi(3) - 3.0 * third - x).abs() <= 3e-15, "{x}: {third}");
            assert!((0.5 - 1e-15..=1.0 + 1e-15).contains(&third), "{x}: {third}");
            assert!((third - (x.acos() / 3.0).cos()).abs() <= 2e-15, "{x}: {third}");
        });
    }
}
