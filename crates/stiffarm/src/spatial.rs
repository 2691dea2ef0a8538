//! Six-vectors: translation first, then rotation. Said once, here.

use std::f64::consts::TAU;

use nalgebra::{Isometry3, Matrix3, Matrix6, Rotation3, SymmetricEigen, UnitQuaternion, Vector3, Vector6};

/// Two eigenvalues nearly agree where they differ by a smaller part of themselves: no direction is given then.
const NEARLY_AGREE: f64 = 1e-4;

/// Where a frame stands in another one.
pub type Pose = Isometry3<f64>;

/// Where cos(B) is smaller the first and the last angle turn about one axis. Below it, leaving out the last turns the tool by less
/// than pi times this; above it, both are known to 1e-16 over this.
const GIMBAL: f64 = 1e-8;

/// Angles about z, then the turned y, then the twice turned x: `R = Rz(a) Ry(b) Rx(c)`, rad. About fixed axes the same, x first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zyx {
    /// About z.
    pub z: f64,
    /// About the turned y.
    pub y: f64,
    /// About the twice turned x.
    pub x: f64,
    /// Only the sum or the difference of `z` and `x` is known: `x` is set to 0.
    pub is_at_gimbal: bool,
}

impl Zyx {
    /// Of a rotation, whose third row is `(-sin y, cos y sin x, cos y cos x)` and first column `(cos y cos z, cos y sin z, -sin y)`.
    pub fn of(rotation: &UnitQuaternion<f64>) -> Self {
        let r: Rotation3<f64> = rotation.to_rotation_matrix();
        let cos_y = r[(2, 1)].hypot(r[(2, 2)]);
        let y = (-r[(2, 0)]).atan2(cos_y);
        if cos_y <= GIMBAL {
            // With x = 0 the second column is (-sin z, cos z, 0).
            return Self { z: (-r[(0, 1)]).atan2(r[(1, 1)]), y, x: 0.0, is_at_gimbal: true };
        }
        Self { z: r[(1, 0)].atan2(r[(0, 0)]), y, x: r[(2, 1)].atan2(r[(2, 2)]), is_at_gimbal: false }
    }

    /// In deg, the turn about z first.
    pub fn degrees(&self) -> [f64; 3] {
        [self.z, self.y, self.x].map(f64::to_degrees)
    }
}

/// Force, N, then torque, N m, at the tool point, base axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench(pub Vector6<f64>);

impl Wrench {
    /// A force without torque.
    pub fn force(force: Vector3<f64>) -> Self {
        Self(Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0))
    }
}

/// How the tool point moves under a wrench: m and rad for N and N m, base axes; symmetric, positive semidefinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance(pub Matrix6<f64>);

impl Compliance {
    /// The block from force to translation, m/N. Blocks of mixed units are never decomposed together.
    pub fn translation(&self) -> Matrix3<f64> {
        self.0.fixed_view::<3, 3>(0, 0).into()
    }

    /// Translation, m, and rotation, rad, under a wrench.
    pub fn deflection(&self, wrench: &Wrench) -> (Vector3<f64>, Vector3<f64>) {
        let moved = self.0 * wrench.0;
        (moved.fixed_rows::<3>(0).into(), moved.fixed_rows::<3>(3).into())
    }

    /// Principal translations per force, m/N, ascending, each with its unit direction.
    pub fn principal(&self) -> [(f64, Vector3<f64>); 3] {
        let eigen = SymmetricEigen::new(self.translation());
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        // A value that is zero but for rounding is zero: a compliance gives no energy away.
        order.map(|i| (eigen.eigenvalues[i].max(0.0), eigen.eigenvectors.column(i).into()))
    }

    /// The largest translation per force in any direction, m/N, and that direction.
    pub fn worst(&self) -> (f64, Vector3<f64>) {
        let [_, _, worst] = self.principal();
        worst
    }
}

/// Eigenvalues of a symmetric matrix in closed form, the largest first: some eight times as fast as by iteration. Where two of them differ by
/// a small part `g` of the largest, they are known to `1e-15 / g` of it, and to 3e-8 in any case.
pub(crate) fn eigenvalues(m: &Matrix3<f64>) -> [f64; 3] {
    let mean = m.trace() / 3.0;
    let rest = m - Matrix3::from_diagonal_element(mean);
    let size = (rest.norm_squared() / 6.0).sqrt();
    if size == 0.0 {
        return [mean; 3];
    }
    // The cosine of three times the angle at which three points, a third of a turn apart, lie above the eigenvalues of `rest`.
    let third = ((rest / size).determinant() / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
    let (first, last) = (mean + 2.0 * size * third.cos(), mean + 2.0 * size * (third + TAU / 3.0).cos());
    [first, 3.0 * mean - first - last, last]
}

/// The direction of one of its [`eigenvalues`] that is not zero, of length one; `None` where another one nearly agrees with it.
pub(crate) fn eigenvector(m: &Matrix3<f64>, value: f64) -> Option<Vector3<f64>> {
    // It is perpendicular to every column of `m - value`, and two of these span all of them.
    let [x, y, z] = [0, 1, 2].map(|i| (m - Matrix3::from_diagonal_element(value)).column(i).into_owned());
    let across = [x.cross(&y), y.cross(&z), z.cross(&x)];
    let longest =
        across.into_iter().fold(Vector3::zeros(), |a, b| if a.norm_squared() < b.norm_squared() { b } else { a });
    longest.try_normalize(NEARLY_AGREE * value * value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_and_their_directions_are_those_of_rotations() {
        let mut rng = fastrand::Rng::with_seed(7);
        let (mut given, mut silent) = (0, 0);
        for case in 0..4000 {
            let mut number = || 2.0 * rng.f64() - 1.0;
            let turn = nalgebra::Rotation3::from_euler_angles(3.0 * number(), 3.0 * number(), 3.0 * number());
            let apart = [1.0, 1e-2, 1e-5, 1e-9, 0.0][case % 5];
            let values = [3e-6, 3e-6 * (1.0 - apart * number().abs()), [1e-6 * number().abs(), 0.0][case % 2]];
            let values = if case % 3 == 0 { values.map(|value| 3e-6 - value) } else { values };
            let m = turn * Matrix3::from_diagonal(&Vector3::from(values)) * turn.inverse();
            let m = (m + m.transpose()) / 2.0;
            let mut expected = SymmetricEigen::new(m);
            expected.eigenvalues.as_mut_slice().sort_by(|x, y| y.total_cmp(x));
            for (i, (found, expected)) in eigenvalues(&m).into_iter().zip(&expected.eigenvalues).enumerate() {
                let slack = if apart == 1.0 { 1e-12 } else { 3e-8 };
                assert!((found - expected).abs() <= slack * 3e-6, "{case} {i}: {found} {expected}");
                if found < 1e-9 {
                    continue;
                }
                let Some(direction) = eigenvector(&m, found) else {
                    silent += 1;
                    continue;
                };
                given += 1;
                // As far off as the value, over how far it is from the others.
                assert!((m * direction - direction * found).norm() < 1e-6 * 3e-6, "{case} {i}");
                assert!((direction.norm() - 1.0).abs() < 1e-14);
            }
        }
        assert!(2000 < given && 1000 < silent, "{given} {silent}");
        assert_eq!(eigenvalues(&Matrix3::zeros()), [0.0; 3]);
        assert_eq!(eigenvalues(&Matrix3::identity()), [1.0; 3]);
    }
}
