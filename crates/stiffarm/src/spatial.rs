//! Six-vectors: translation first, then rotation. Said once, here.

use nalgebra::{Isometry3, Matrix3, Matrix6, SymmetricEigen, Vector3, Vector6};

/// Where a frame stands in another one.
pub type Pose = Isometry3<f64>;

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
