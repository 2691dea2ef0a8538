//! Where does a function change its sign, or have its least value?

/// A sign change of `f` between `low` (where `f < 0`) and `high` (where `f >= 0`), to a few units in the last place.
///
/// Regula falsi with the weights of Anderson and Bjoerck; every third step halves, so it always ends.
pub(crate) fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    for step in 1_u32.. {
        let middle = f64::midpoint(low, high);
        if high - low <= 4.0 * f64::EPSILON * low.abs().max(high.abs()) || middle <= low || high <= middle {
            return middle;
        }
        let secant = (low * at_high - high * at_low) / (at_high - at_low);
        let x = if step % 3 != 0 && low < secant && secant < high { secant } else { middle };
        let at = f(x);
        // The end that stays loses weight, so that the next secant reaches beyond the root.
        let weight = |replaced: f64| {
            if 0.0 < 1.0 - at / replaced { 1.0 - at / replaced } else { 0.5 }
        };
        if at < 0.0 {
            at_high *= weight(at_low);
            (low, at_low) = (x, at);
        } else {
            at_low *= weight(at_high);
            (high, at_high) = (x, at);
        }
    }
    unreachable!("halving ends")
}

/// The least value of a function with one valley between `low` and `high`, `(x, f(x))`, by golden sections.
pub(crate) fn minimum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let inner = |low: f64, high: f64| (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut left, mut right) = inner(low, high);
    let (mut at_left, mut at_right) = (f(left), f(right));
    while 1e-9 * (low.abs() + high.abs()) < high - low {
        if at_left <= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = inner(low, high).0;
            at_left = f(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = inner(low, high).1;
            at_right = f(right);
        }
    }
    if at_left <= at_right { (left, at_left) } else { (right, at_right) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_to_the_last_digits() {
        let close =
            |found: f64, exact: f64| assert!((found - exact).abs() <= 4.0 * f64::EPSILON * exact, "{found} {exact}");
        close(root(0.0, 2.0, |x| x * x - 2.0), 2_f64.sqrt());
        close(root(0.0, 10.0, |x| x.powi(9) - 1e-3), 1e-3_f64.powf(1.0 / 9.0));
        close(root(1.0, 4.0, |x| if x < 3.0 { -1e-9 } else { 1e9 }), 3.0);
    }

    #[test]
    fn the_lowest_point_of_a_valley_is_found() {
        let (x, least) = minimum(-1.0, 5.0, |x| (x - 2.0).powi(2) + 7.0);
        assert!((x - 2.0).abs() < 1e-7 && (least - 7.0).abs() < 1e-14, "{x} {least}");
    }
}
