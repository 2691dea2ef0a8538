//! The modes of an arm as equations of motion: what else pushes at the tip can be put beside them.

use nalgebra::{Complex, DMatrix, Matrix3, Matrix3xX};

/// `z'' + C z' + W^2 z = S^T f`, the tip moves by `S z`; `f` in N.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// `W`, rad/s; of an arm ascending.
    pub own: Vec<f64>,
    /// `C`, 1/s, symmetric; `2 zeta w` on its diagonal.
    pub friction: DMatrix<f64>,
    /// `S`: how the tip moves in each mode, m per root of kg m^2; whoever holds it knows the axes.
    pub tip: Matrix3xX<f64>,
}

impl Motion {
    /// Modes that damping does not couple: rad/s, share of critical damping, and how the tip moves where the modal mass is 1.
    pub fn uncoupled(modes: &[(f64, f64, [f64; 3])]) -> Self {
        let damped: Vec<f64> = modes.iter().map(|(own, ratio, _)| 2.0 * ratio * own).collect();
        Self {
            own: modes.iter().map(|mode| mode.0).collect(),
            friction: DMatrix::from_diagonal(&damped.into()),
            tip: Matrix3xX::from_columns(&modes.iter().map(|mode| mode.2.into()).collect::<Vec<_>>()),
        }
    }

    /// The same in the axes that are the columns of `axes`.
    #[must_use]
    pub fn seen_along(mut self, axes: &Matrix3<f64>) -> Self {
        self.tip = axes.transpose() * self.tip;
        self
    }

    /// Does the damping of one mode move another?
    pub fn is_coupled(&self) -> bool {
        let n = self.own.len();
        (0..n).any(|i| (0..n).any(|j| i != j && self.friction[(i, j)] != 0.0))
    }

    /// `(W^2 + i w C - w^2) ^-1`, s^2, at `w`, rad/s; `None` where nothing damps a mode at its own frequency.
    pub fn dynamic(&self, w: f64) -> Option<DMatrix<Complex<f64>>> {
        let n = self.own.len();
        let part = |i: usize, j: usize| {
            let held = if i == j { self.own[i] * self.own[i] - w * w } else { 0.0 };
            Complex::new(held, w * self.friction[(i, j)])
        };
        DMatrix::from_fn(n, n, part).try_inverse()
    }
}
