//! Under which of the forces that may act does the tool give way most, and how far?
//!
//! The unit forces `f` of a band make angles between two bounds with an axis `a`. What counts is `|C f|`, `f . C f` or `|n . C f|`.
//! The first two are roots of quadratic forms `f . M f` (`M = C^2`, `M = C`): these have no greatest value inside a band but at
//! their softest direction, so it is there or on one of the two rims. On the rim at the angle with cosine `h` and sine `s`,
//! `f = h a + s g` with a unit vector `g` across the axis, and
//!
//! ```text
//! f . M f = h^2 a . M a + max_g (g . Q g + 2 q . g),    Q = s^2 M,  q = h s M a   (both across the axis)
//!         = h^2 a . M a + min_d (m1 + d + q1^2 / d + q2^2 / (d + m1 - m2)),       0 < d,
//! ```
//!
//! with the eigenvalues `m1 >= m2` of `Q` and the parts `q1`, `q2` of `q` along their directions: a trust region of two dimensions, whose
//! `d` is the one root of `q1^2 / d^2 + q2^2 / (d + m1 - m2)^2 = 1`. The last form is linear in `f`: closed form.

use nalgebra::{Matrix3, SymmetricEigen, Vector2, Vector3};

use super::Component;

/// Newton steps of the root, at most; some six are usual.
const STEPS: usize = 100;

/// Unit forces that may act, and what part of the displacement counts; in the axes of the compliance they are asked with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Forces {
    axis: Vector3<f64>,
    /// Cosine and sine of the least and of the greatest angle off the axis.
    from: [f64; 2],
    to: [f64; 2],
    normal: Vector3<f64>,
    component: Component,
}

/// The force of some that does most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// What counts of the displacement, m/N.
    pub value: f64,
    /// The unit direction of the force.
    pub force: Vector3<f64>,
    /// The unit direction of which the displacement's part is the value.
    pub counted: Vector3<f64>,
}

impl Forces {
    /// At angles, rad, between `from` and `to` off a unit axis; the normal of the face has length one.
    pub(super) fn band(axis: Vector3<f64>, [from, to]: [f64; 2], normal: Vector3<f64>, component: Component) -> Self {
        let ends =
            [from, to].map(|angle: f64| [angle.cos(), if angle == std::f64::consts::PI { 0.0 } else { angle.sin() }]);
        Self { axis, from: ends[0], to: ends[1], normal, component }
    }

    /// The same, seen from axes against which they are turned.
    #[must_use]
    pub(crate) fn turned(&self, turn: &Matrix3<f64>) -> Self {
        Self { axis: turn * self.axis, normal: turn * self.normal, ..*self }
    }

    pub(crate) fn axis(&self) -> Vector3<f64> {
        self.axis
    }

    /// Two unit vectors across the axis.
    pub(crate) fn across(&self) -> [Vector3<f64>; 2] {
        across(&self.axis)
    }

    pub(crate) fn normal(&self) -> Vector3<f64> {
        self.normal
    }

    pub(crate) fn component(&self) -> Component {
        self.component
    }

    /// One force alone.
    pub(crate) fn is_one(&self) -> bool {
        self.to == [1.0, 0.0]
    }

    /// The rims that bound it, each by cosine and sine of its angle off the axis; a rim in a point is none unless it is alone.
    pub(crate) fn rims(&self) -> [[f64; 2]; 2] {
        [self.from, self.to]
    }

    /// The direction, or the opposite one, is that of a force that may act.
    fn holds(&self, direction: &Vector3<f64>) -> bool {
        let h = self.axis.dot(direction);
        [h, -h].into_iter().any(|h| self.to[0] <= h && h <= self.from[0])
    }

    /// The force that does most, and what it does.
    pub(crate) fn largest(&self, compliance: &Matrix3<f64>) -> Largest {
        match self.component {
            Component::Along => {
                let force = self.softest(compliance);
                Largest { value: force.dot(&(compliance * force)).max(0.0), force, counted: force }
            }
            Component::Total => {
                let force = self.softest(&(compliance * compliance));
                let moved = compliance * force;
                let value = moved.norm();
                Largest { value, force, counted: if 0.0 < value { moved / value } else { force } }
            }
            Component::Normal => {
                let force = self.farthest_along(&(compliance * self.normal));
                let moved = self.normal.dot(&(compliance * force));
                Largest { value: moved.abs(), force, counted: self.normal * if moved < 0.0 { -1.0 } else { 1.0 } }
            }
        }
    }

    /// The force with the greatest `f . M f`, up to its sign where both are allowed.
    fn softest(&self, m: &Matrix3<f64>) -> Vector3<f64> {
        if self.is_one() {
            return self.axis;
        }
        let eigen = SymmetricEigen::new(*m);
        let softest: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into();
        if self.holds(&softest) {
            let h = self.axis.dot(&softest);
            return if self.to[0] <= h && h <= self.from[0] { softest } else { -softest };
        }
        let form = |f: &Vector3<f64>| f.dot(&(m * f));
        let [first, last] = self.rims().map(|rim| on_rim(m, &self.axis, rim));
        if form(&last) < form(&first) { first } else { last }
    }

    /// The force with the greatest `|w . f|`.
    fn farthest_along(&self, w: &Vector3<f64>) -> Vector3<f64> {
        let length = w.norm();
        if self.is_one() || length == 0.0 {
            return self.axis * self.from[0] + across(&self.axis)[0] * self.from[1];
        }
        let unit = w / length;
        let ahead = unit.dot(&self.axis);
        for (h, sign) in [(ahead, 1.0), (-ahead, -1.0)] {
            if self.to[0] <= h && h <= self.from[0] {
                return unit * sign;
            }
        }
        // Of a vector along the axis what lies across it is rounding, and need not lie across it.
        let aside = self.axis.cross(&unit.cross(&self.axis)).try_normalize(1e-12).unwrap_or(across(&self.axis)[0]);
        // On a rim the best of both signs is that on which neither part takes away from the other.
        let sign = if ahead < 0.0 { -1.0 } else { 1.0 };
        let on = |[h, s]: [f64; 2]| self.axis * h + aside * (s * sign * if h < 0.0 { -1.0 } else { 1.0 });
        let [first, last] = self.rims().map(on);
        if unit.dot(&last).abs() < unit.dot(&first).abs() { first } else { last }
    }
}

/// Two unit vectors at right angles to a unit vector and to each other.
fn across(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let other = if axis.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
    let first = axis.cross(&other).normalize();
    [first, axis.cross(&first)]
}

/// The unit vector with the greatest `f . M f` at the angle with this cosine and sine off an axis.
fn on_rim(m: &Matrix3<f64>, axis: &Vector3<f64>, [h, s]: [f64; 2]) -> Vector3<f64> {
    let [e1, e2] = across(axis);
    let (a, b, o) = (e1.dot(&(m * e1)), e2.dot(&(m * e2)), e1.dot(&(m * e2)));
    let (half, angle) = ((a - b) / 2.0, o.atan2((a - b) / 2.0) / 2.0);
    let apart = 2.0 * s * s * half.hypot(o);
    let (sin, cos) = angle.sin_cos();
    let (soft, stiff) = (e1 * cos + e2 * sin, e2 * cos - e1 * sin);
    let moved = m * axis * (h * s);
    let g = trust_region(moved.dot(&soft), moved.dot(&stiff), apart);
    axis * h + (soft * g.x + stiff * g.y) * s
}

/// The unit vector `g` with the greatest `-apart g2^2 + 2 (q1 g1 + q2 g2)`.
fn trust_region(q1: f64, q2: f64, apart: f64) -> Vector2<f64> {
    let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
    let phi_parts = |d: f64| ((q1 / d).powi(2), (q2 / (d + apart)).powi(2));
    // Left of the root, where the inverse root of the sum is concave: Newton steps come from the left and never pass it.
    let mut d = q1.abs().max(q2.abs() - apart);
    if d <= 0.0 {
        // Nothing along the softer direction, and little along the other: either sign of the first will do.
        let g2 = if 0.0 < apart { (q2 / apart).clamp(-1.0, 1.0) } else { 0.0 };
        return Vector2::new((1.0 - g2 * g2).sqrt(), g2);
    }
    for _ in 0..STEPS {
        let (a, b) = phi_parts(d);
        let phi = a + b;
        let step = phi * (phi.sqrt() - 1.0) / (a / d + b / (d + apart));
        if !(1e-16 * d < step) {
            break;
        }
        d += step;
    }
    // The part along the softer direction is what is left, where it is not known well from so small a root.
    let g2 = (q2 / (d + apart)).clamp(-1.0, 1.0);
    Vector2::new(sign(q1) * (1.0 - g2 * g2).sqrt(), g2)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    use super::*;

    const COMPONENTS: [Component; 3] = [Component::Total, Component::Normal, Component::Along];

    fn unit(rng: &mut fastrand::Rng) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
            if 0.1 < v.norm() && v.norm() < 1.0 {
                return v.normalize();
            }
        }
    }

    /// Compliances, m/N: of any shape, of a needle, with two directions alike, of a ball.
    fn compliance(rng: &mut fastrand::Rng, case: usize) -> Matrix3<f64> {
        let values = match case % 4 {
            0 => [rng.f64(), rng.f64(), rng.f64()],
            1 => [1.0, 0.0, 0.0],
            2 => [1.0, 1.0, rng.f64()],
            _ => [1.0; 3],
        };
        let axes = {
            let x = unit(rng);
            let [y, z] = across(&x);
            [x, y, z]
        };
        axes.iter().zip(values).map(|(axis, value)| axis * axis.transpose() * (value * 1e-6)).sum()
    }

    fn bands(rng: &mut fastrand::Rng, case: usize) -> [f64; 2] {
        let (a, b) = (PI * rng.f64(), PI * rng.f64());
        match case % 7 {
            0 => [0.0, 0.0],
            1 => [0.0, a / 2.0],
            2 => [a, a],
            3 => [0.0, PI],
            4 => [FRAC_PI_2, FRAC_PI_2],
            5 => [PI, PI],
            _ => [a.min(b), a.max(b)],
        }
    }

    fn counted(forces: &Forces, c: &Matrix3<f64>, f: &Vector3<f64>) -> f64 {
        match forces.component {
            Component::Total => (c * f).norm(),
            Component::Along => f.dot(&(c * f)),
            Component::Normal => forces.normal.dot(&(c * f)).abs(),
        }
    }

    /// Forces at even steps of both angles: never more, and hardly less where the steps are fine.
    #[test]
    fn no_force_of_the_band_does_more_and_the_one_that_is_reported_does_it() {
        let mut rng = fastrand::Rng::with_seed(61);
        for case in 0..840 {
            let (c, axis, other) = (compliance(&mut rng, case), unit(&mut rng), unit(&mut rng));
            let normal = if case % 3 == 0 { axis } else { other };
            let [from, to] = bands(&mut rng, case);
            for component in COMPONENTS {
                let forces = Forces::band(axis, [from, to], normal, component);
                let found = forces.largest(&c);
                let scale = c.norm();
                let name = || format!("case {case}, {component:?}, {from}..{to}: {found:?}");
                let off = found.force.dot(&axis).clamp(-1.0, 1.0).acos();
                assert!((found.force.norm() - 1.0).abs() < 1e-12, "{}", name());
                // An angle near zero or half a turn is known from its cosine to 1e-8 only.
                assert!(from - 1e-7 <= off && off <= to + 1e-7, "{off}: {}", name());
                assert!((counted(&forces, &c, &found.force) - found.value).abs() <= 1e-15 * scale, "{}", name());
                let bilinear = found.counted.dot(&(c * found.force));
                assert!((bilinear - found.value).abs() <= 1e-14 * scale, "{bilinear}: {}", name());
                let [e1, e2] = across(&axis);
                let (rows, turns) = (60, 120);
                let mut most = 0.0_f64;
                for i in 0..=rows {
                    let t = from + (to - from) * f64::from(i) / f64::from(rows);
                    for j in 0..turns {
                        let turn = TAU * f64::from(j) / f64::from(turns);
                        let f = axis * t.cos() + (e1 * turn.cos() + e2 * turn.sin()) * t.sin();
                        most = most.max(counted(&forces, &c, &f));
                    }
                }
                assert!(most <= found.value + 1e-14 * scale, "{most}: {}", name());
                // Half a step of both angles away: 1 - cos of 0.037 rad, for the size of a displacement.
                assert!(found.value <= most + 2e-3 * scale, "{most}: {}", name());
            }
        }
    }

    /// On a rim the gradient `2 M f` leans on `f` and the axis alone, and is no longer than a root of the band allows: with
    /// the multiplier of `f` above the softer eigenvalue across the axis no other force on the rim is better.
    #[test]
    fn on_a_rim_nothing_pulls_the_force_aside() {
        let mut rng = fastrand::Rng::with_seed(62);
        for case in 0..2000 {
            let (c, axis) = (compliance(&mut rng, case) * 1e6, unit(&mut rng));
            let t = 0.05 + 3.0 * rng.f64();
            let f = on_rim(&c, &axis, [t.cos(), t.sin()]);
            let aside = axis.cross(&f).normalize();
            assert!(aside.dot(&(c * f)).abs() <= 2e-8, "{case}: {}", aside.dot(&(c * f)));
            let g = (f - axis * t.cos()) / t.sin();
            let multiplier = g.dot(&(c * f)) / t.sin();
            let [e1, e2] = across(&axis);
            let (a, b, o) = (e1.dot(&(c * e1)), e2.dot(&(c * e2)), e1.dot(&(c * e2)));
            let softer = f64::midpoint(a, b) + ((a - b) / 2.0).hypot(o);
            assert!(softer <= multiplier + 1e-7, "{case}: {softer} {multiplier}");
        }
    }

    /// By hand: 3, 2 and 1 um/N along x, y, z.
    #[test]
    fn one_force_a_cone_and_a_feed_that_may_go_any_way_do_what_a_hand_calculation_says() {
        let c = Matrix3::from_diagonal(&Vector3::new(3.0, 2.0, 1.0));
        let value = |axis: Vector3<f64>, band: [f64; 2], component| {
            Forces::band(axis, band, Vector3::z(), component).largest(&c).value
        };
        let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        let diagonal = Vector3::new(1.0, 0.0, 1.0).normalize();
        close(value(diagonal, [0.0, 0.0], Component::Total), 5_f64.sqrt());
        close(value(diagonal, [0.0, 0.0], Component::Along), 2.0);
        close(value(diagonal, [0.0, 0.0], Component::Normal), 0.5_f64.sqrt());
        // Along z with 30 degrees of doubt: leant towards x.
        let lean = [0.0, 30_f64.to_radians()];
        close(value(Vector3::z(), lean, Component::Total), (9.0 * 0.25 + 0.75_f64).sqrt());
        close(value(Vector3::z(), lean, Component::Along), 3.0 * 0.25 + 0.75);
        close(value(Vector3::z(), lean, Component::Normal), 1.0);
        // A feed of 4 and an axial force of 3: the feed goes along x.
        let off = 4_f64.atan2(3.0);
        close(value(Vector3::z(), [off, off], Component::Total), (2.4_f64 * 2.4 + 0.6 * 0.6).sqrt());
        // The whole sphere is the worst direction.
        close(value(Vector3::y(), [0.0, PI], Component::Total), 3.0);
    }
}
