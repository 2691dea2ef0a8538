//! Integrals over an interval, of several functions at once, to rounding where they are smooth.

/// Nodes and weights of Gauss and Legendre with eight points on `-1..1`, the positive half.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// The integral of `f` from `a` to `b`.
///
/// With `x = a + (b - a) u^3 (10 - 15 u + 6 u^2)` a power `x^p`, `0 < p < 1`, at either end becomes one that is smooth enough: thin chips
/// under Kienzle's law.
pub(super) fn integral<const N: usize>(f: impl Fn(f64) -> [f64; N], a: f64, b: f64, pieces: usize) -> [f64; N] {
    let mut sum = [0.0; N];
    let half = 0.5 / pieces as f64;
    for piece in 0..pieces {
        let middle = (2 * piece + 1) as f64 * half;
        for (node, weight) in GAUSS {
            for u in [middle - half * node, middle + half * node] {
                let x = a + (b - a) * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u);
                let slope = 30.0 * (b - a) * (u * (1.0 - u)).powi(2);
                for (part, value) in sum.iter_mut().zip(f(x)) {
                    *part += weight * half * slope * value;
                }
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_and_powers_are_integrated_to_rounding() {
        let [a, b] = integral(|x| [x * x, x.powf(0.75)], 0.0, 2.0, 32);
        assert!((a - 8.0 / 3.0).abs() < 1e-13, "{a}");
        assert!((b - 2.0_f64.powf(1.75) / 1.75).abs() < 1e-12, "{b}");
    }
}
