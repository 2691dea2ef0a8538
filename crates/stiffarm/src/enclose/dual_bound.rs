//! How small can the largest of several affine forms be, where others are not negative? A bound by weak duality.

use super::affine::Affine;
use crate::interval::Interval;

/// Rounds in which the weights are improved.
const ROUNDS: usize = 4;
/// Rounds in which the ranges of the variables are cut.
const CUTS: usize = 2;

/// A linear function `at + slope . variables` of variables that run from -1 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<const N: usize> {
    at: f64,
    slope: [f64; N],
}

impl<const N: usize> Line<N> {
    /// A lower bound on an affine form; `None` where nothing is known of it.
    pub(crate) fn below(x: &Affine<N>) -> Option<Self> {
        (!x.is_unknown()).then_some(Self { at: x.centre - x.remainder, slope: x.deviations })
    }

    /// A function that is not positive where the affine form can be not negative.
    pub(crate) fn allowing(x: &Affine<N>) -> Option<Self> {
        Self::below(&-*x)
    }

    /// The same with variables that run from -1 to 1 through parts of their ranges.
    pub(crate) fn within(&self, part: &[Interval; N]) -> Self {
        let at = (0..N).fold(self.at, |at, i| at + self.slope[i] * part[i].middle());
        Self { at, slope: std::array::from_fn(|i| self.slope[i] * part[i].width() / 2.0) }
    }

    /// Takes from the ranges of the variables what lets the line rise above `most`; `None` where nothing is left.
    fn keep_below(&self, most: f64, part: &mut [Interval; N]) -> Option<()> {
        let least = |i: usize, range: Interval| (self.slope[i] * range.min()).min(self.slope[i] * range.max());
        let sum = (0..N).fold(self.at, |sum, i| sum + least(i, part[i]));
        let slack = 1e-12 * (most.abs() + self.at.abs());
        if most + slack < sum {
            return None;
        }
        // What each variable may add to its own least.
        let room = most + slack - sum;
        for (range, slope) in part.iter_mut().zip(self.slope) {
            let reach = room / slope.abs();
            if reach < range.width() {
                *range = if 0.0 < slope {
                    Interval::spanning(range.min(), range.min() + reach)
                } else {
                    Interval::spanning(range.max() - reach, range.max())
                };
            }
        }
        Some(())
    }

    /// The least it can be, each variable anywhere in `-1..1`.
    fn least(&self) -> f64 {
        self.at - self.slope.iter().map(|slope| slope.abs()).sum::<f64>()
    }

    /// `self + part * towards`.
    fn moved(&self, towards: &Self, part: f64) -> Self {
        let slope = std::array::from_fn(|i| self.slope[i] + part * towards.slope[i]);
        Self { at: self.at + part * towards.at, slope }
    }

    /// The best of `self + part * towards`, `part` in `0..most`: where the least is concave in it, so at an end or where a
    /// slope vanishes.
    fn best_towards(&self, towards: &Self, most: f64) -> Self {
        let mut best = *self;
        let zeros = (0..N).map(|i| -self.slope[i] / towards.slope[i]).filter(|part| 0.0 < *part && *part < most);
        for part in zeros.chain((most < f64::INFINITY).then_some(most)) {
            let moved = self.moved(towards, part);
            if best.least() < moved.least() {
                best = moved;
            }
        }
        best
    }
}

/// The part of the variables' ranges, each from -1 to 1, outside which a value is larger than `most` or a limit positive;
/// `None` where that is so everywhere.
pub(crate) fn remaining<const N: usize>(values: &[Line<N>], limits: &[Line<N>], most: f64) -> Option<[Interval; N]> {
    let mut part = [Interval::spanning(-1.0, 1.0); N];
    for _ in 0..CUTS {
        for value in values.iter().filter(|_| most.is_finite()) {
            value.keep_below(most, &mut part)?;
        }
        for limit in limits {
            limit.keep_below(0.0, &mut part)?;
        }
    }
    Some(part)
}

/// A lower bound on the largest of `values` wherever no limit is positive; zero where nothing better is known.
///
/// The largest is no less than any weighted mean, and what is not negative may be taken away any number of times: each such
/// sum is an affine number with a known least value. Which weights are tried decides how good the bound is, not whether
/// it holds.
pub(crate) fn least_largest<const N: usize>(values: &[Line<N>], limits: &[Line<N>]) -> f64 {
    let Some(mut best) = values.iter().copied().max_by(|a, b| a.least().total_cmp(&b.least())) else { return 0.0 };
    for _ in 0..ROUNDS {
        let before = best.least();
        for value in values {
            let towards = value.moved(&best, -1.0);
            best = best.best_towards(&towards, 1.0);
        }
        for limit in limits {
            best = best.best_towards(limit, f64::INFINITY);
        }
        if best.least() <= before * (1.0 + 1e-4) {
            break;
        }
    }
    best.least().max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(rng: &mut fastrand::Rng) -> Affine<3> {
        let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
        let deviations = std::array::from_fn(|_| part(-1.0, 1.0));
        Affine { centre: part(0.0, 3.0), deviations, remainder: part(0.0, 0.1) }
    }

    fn lines<const N: usize>(values: &[Affine<N>], limits: &[Affine<N>]) -> (Vec<Line<N>>, Vec<Line<N>>) {
        (values.iter().filter_map(Line::below).collect(), limits.iter().filter_map(Line::allowing).collect())
    }

    /// Nothing that a line forbids is kept, nothing that all allow is cut off, and most of what may be cut is.
    #[test]
    fn what_is_cut_off_is_forbidden() {
        let mut rng = fastrand::Rng::with_seed(35);
        let (mut kept, mut cut, mut gone) = (0, 0, 0);
        for _ in 0..2000 {
            let values: Vec<_> = (0..3).map(|_| random(&mut rng)).collect();
            let limits: Vec<_> =
                (0..2).map(|_| random(&mut rng)).map(|x| Affine { centre: x.centre - 1.0, ..x }).collect();
            let (values, limits) = lines(&values, &limits);
            let part = remaining(&values, &limits, 1.8);
            gone += usize::from(part.is_none());
            for _ in 0..50 {
                let at: [f64; 3] = std::array::from_fn(|_| 2.0 * rng.f64() - 1.0);
                let linear = |line: &Line<3>| line.at + (0..3).map(|i| line.slope[i] * at[i]).sum::<f64>();
                let allowed = values.iter().all(|x| linear(x) <= 1.8) && limits.iter().all(|x| linear(x) <= 0.0);
                let remains = part.is_some_and(|part| (0..3).all(|i| part[i].contains(at[i], 1e-9)));
                assert!(remains || !allowed, "{values:?} {limits:?} {at:?}");
                kept += usize::from(allowed);
                cut += usize::from(!remains && part.is_some());
            }
            // A line within the part says there what it says of the whole.
            if let Some(part) = part {
                let [first, ..] = &values[..] else { unreachable!("three") };
                let seen = first.within(&part);
                let corner = first.at + (0..3).map(|i| first.slope[i] * part[i].max()).sum::<f64>();
                assert!((seen.at + seen.slope.iter().sum::<f64>() - corner).abs() < 1e-12);
            }
        }
        assert!(5000 < kept && 5000 < cut && 100 < gone, "{kept} {cut} {gone}");
    }

    #[test]
    fn the_largest_is_nowhere_less_where_the_limits_allow() {
        let mut rng = fastrand::Rng::with_seed(34);
        let (mut allowed, mut better) = (0, 0);
        for _ in 0..2000 {
            let values: Vec<_> = (0..4).map(|_| random(&mut rng)).collect();
            let limits: Vec<_> =
                (0..2).map(|_| random(&mut rng)).map(|x| Affine { centre: x.centre - 1.0, ..x }).collect();
            let (lines, allowed_by) = lines(&values, &limits);
            let bound = least_largest(&lines, &allowed_by);
            better += usize::from(values.iter().map(Affine::min).fold(0.0, f64::max) < bound - 0.01);
            for _ in 0..50 {
                let at: [f64; 3] = std::array::from_fn(|_| 2.0 * rng.f64() - 1.0);
                let linear = |x: &Affine<3>| x.centre + (0..3).map(|i| x.deviations[i] * at[i]).sum::<f64>();
                if limits.iter().all(|x| 0.0 <= linear(x) + x.remainder) {
                    allowed += 1;
                    let largest = values.iter().map(|x| linear(x) - x.remainder).fold(0.0, f64::max);
                    assert!(bound <= largest + 1e-12, "{values:?} {limits:?}");
                }
            }
        }
        assert!(1000 < allowed && 1000 < better, "{allowed} {better}");
    }

    #[test]
    fn two_that_cross_are_no_less_than_where_they_do() {
        let line = |slope: f64| Affine { centre: 1.0, deviations: [slope], remainder: 0.0 };
        let least = |values: &[Affine<1>], limits: &[Affine<1>]| {
            let (values, limits) = lines(values, limits);
            least_largest(&values, &limits)
        };
        assert!((least(&[line(0.5), line(-0.3)], &[]) - 1.0).abs() < 1e-12);
        // And one that falls is no less than where the limit stops it.
        assert!(
            (least(&[line(0.5)], &[Affine { centre: 0.2, deviations: [1.0], remainder: 0.0 }]) - 0.9).abs() < 1e-12
        );
    }
}
