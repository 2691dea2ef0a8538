//! A closed interval of real numbers, possibly unbounded.

use std::f64::consts::PI;

/// A closed range `min..=max`, in the unit of what it limits; possibly unbounded at either end, never empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    min: f64,
    max: f64,
}

impl Interval {
    /// No limit at all.
    pub const ALL: Self = Self { min: f64::NEG_INFINITY, max: f64::INFINITY };

    /// Zero and above.
    pub const POSITIVE: Self = Self { min: 0.0, max: f64::INFINITY };

    /// `None` where `min <= max` does not hold (NaN included), or both lie at the same infinity.
    pub fn new(min: f64, max: f64) -> Option<Self> {
        (min <= max && min < f64::INFINITY && f64::NEG_INFINITY < max).then_some(Self { min, max })
    }

    /// The range of the one value `x`.
    ///
    /// # Panics
    /// Where `x` is NaN.
    pub fn point(x: f64) -> Self {
        Self::new(x, x).expect("a number")
    }

    /// The smallest range that holds both values.
    ///
    /// # Panics
    /// Where both are NaN.
    pub fn spanning(a: f64, b: f64) -> Self {
        Self::new(a.min(b), a.max(b)).expect("numbers")
    }

    /// Lower end.
    pub const fn min(self) -> f64 {
        self.min
    }

    /// Upper end.
    pub const fn max(self) -> f64 {
        self.max
    }

    /// `max - min`.
    pub fn width(self) -> f64 {
        self.max - self.min
    }

    /// The middle; meaningful for a bounded range only.
    pub fn middle(self) -> f64 {
        f64::midpoint(self.min, self.max)
    }

    /// Both halves of a bounded range; the middle belongs to both.
    #[must_use]
    pub fn halves(self) -> [Self; 2] {
        [Self { max: self.middle(), ..self }, Self { min: self.middle(), ..self }]
    }

    /// Itself where both ends are finite, else one turn, -pi to pi: for angles.
    #[must_use]
    pub fn or_one_turn(self) -> Self {
        if self.is_bounded() { self } else { Self::spanning(-PI, PI) }
    }

    /// Both ends are finite.
    pub fn is_bounded(self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Neither end is finite.
    pub fn is_all(self) -> bool {
        self == Self::ALL
    }

    /// `x` lies in the range, or outside by no more than `slack`.
    pub fn contains(self, x: f64, slack: f64) -> bool {
        self.min - slack <= x && x <= self.max + slack
    }

    /// The value in the range that is nearest to `x`.
    pub fn clamp(self, x: f64) -> f64 {
        x.clamp(self.min, self.max)
    }

    /// Shorter by `by` at either end; `None` where nothing is left.
    pub(crate) fn narrowed(self, by: f64) -> Option<Self> {
        Self::new(self.min + by, self.max - by)
    }

    /// Where the middle of something may be of which so much lies on either side: the one place in a range that is as wide but for `slack`.
    pub(crate) fn room_for(self, half: f64, slack: f64) -> Option<Self> {
        let [low, high] = [self.min + half, self.max - half];
        if (high - low).abs() <= slack { Some(Self::point(f64::midpoint(low, high))) } else { Self::new(low, high) }
    }

    /// What both ranges share.
    pub fn intersect(self, other: Self) -> Option<Self> {
        Self::new(self.min.max(other.min), self.max.min(other.max))
    }

    /// `{ a x + b : x in self }`.
    ///
    /// # Panics
    /// Where `a` is zero and the range unbounded.
    #[must_use]
    pub fn affine(self, a: f64, b: f64) -> Self {
        Self::spanning(a * self.min + b, a * self.max + b)
    }

    /// The same angles, counted whole turns apart so that the middle lies as near as it can to that of `other`; what both
    /// share is then as wide as it can be. Itself where either is unbounded.
    pub(crate) fn turned_towards(self, other: Self) -> Self {
        if !(self.is_bounded() && other.is_bounded()) {
            return self;
        }
        let turns = ((other.middle() - self.middle()) / (2.0 * PI)).round_ties_even();
        self.affine(1.0, turns * 2.0 * PI)
    }

    /// The sum of two independent values.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { min: self.min + other.min, max: self.max + other.max }
    }

    /// The smallest whole `n` for which `x + n period` is not below the range.
    fn first_period(self, x: f64, period: f64) -> f64 {
        ((self.min - x) / period).ceil()
    }

    /// How far `x` is from the nearer end; negative outside.
    pub fn room(self, x: f64) -> f64 {
        (x - self.min).min(self.max - x)
    }

    /// An angle equal to `x` up to whole turns that lies in the range (within `slack`), if there is one.
    pub fn turn_to(self, x: f64, slack: f64) -> Option<f64> {
        if self.min == f64::NEG_INFINITY {
            return self
                .contains(x, slack)
                .then_some(x)
                .or_else(|| Some(x - ((x - self.max) / (2.0 * PI)).ceil() * 2.0 * PI));
        }
        let wide = Self { min: self.min - slack, max: self.max + slack };
        let turned = x + wide.first_period(x, 2.0 * PI) * 2.0 * PI;
        wide.contains(turned, 0.0).then_some(turned)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_is_found_in_a_range_whole_turns_away() {
        let range = Interval::new(3.0, 4.0).unwrap();
        assert_eq!(range.turn_to(3.5 - 4.0 * PI, 0.0).map(|x| (x * 1e9).round()), Some(3.5e9));
        assert_eq!(range.turn_to(5.0, 0.0), None);
        let below = Interval::new(f64::NEG_INFINITY, -10.0).unwrap();
        let found = below.turn_to(0.0, 0.0).unwrap();
        assert!(found <= -10.0 && (found / (2.0 * PI)).fract().abs() < 1e-12);
        assert_eq!(Interval::ALL.turn_to(7.0, 0.0), Some(7.0));
    }

    #[test]
    fn a_range_is_turned_to_where_it_shares_most_with_another() {
        let degrees = |min: f64, max: f64| Interval::spanning(min.to_radians(), max.to_radians());
        let close = |a: Interval, b: Interval| (a.min() - b.min()).abs() < 1e-12 && (a.max() - b.max()).abs() < 1e-12;
        assert!(close(degrees(-411.0, -41.0).turned_towards(degrees(50.0, 720.0)), degrees(309.0, 679.0)));
        assert!(close(degrees(1.0, 300.0).turned_towards(degrees(900.0, 1000.0)), degrees(721.0, 1020.0)));
        // Half a turn apart both ways are as good, and less than that is none.
        for stays in [degrees(-10.0, 10.0), degrees(-190.0, -150.0)] {
            assert_eq!(stays.turned_towards(degrees(-100.0, 100.0)), stays);
            assert_eq!(stays.turned_towards(Interval::POSITIVE), stays);
        }
        assert_eq!(Interval::ALL.turned_towards(degrees(0.0, 1.0)), Interval::ALL);
    }

    #[test]
    fn halves_are_the_whole() {
        let [first, second] = Interval::spanning(-1.0, 5.0).halves();
        assert_eq!([first.min(), first.max(), second.min(), second.max()], [-1.0, 2.0, 2.0, 5.0]);
    }

    #[test]
    fn nan_makes_no_range() {
        assert!(Interval::new(f64::NAN, 1.0).is_none());
        assert!(Interval::new(0.0, f64::NAN).is_none());
        assert!(Interval::new(2.0, 1.0).is_none());
    }
}
