//! How do makers write an orientation down? Their three angles or four numbers to a rotation.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The numbers in which a controller or a tracker shows an orientation, in deg but for quaternions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// `a_deg, b_deg, c_deg` (KUKA): `Rz(a) Ry(b) Rx(c)`.
    Abc,
    /// `w_deg, p_deg, r_deg` (Fanuc): `Rz(r) Ry(p) Rx(w)`.
    Wpr,
    /// `q1` .. `q4` (ABB), or `qw, qx, qy, qz`: a quaternion, its scalar part first.
    Quaternion,
    /// `rx_deg, ry_deg, rz_deg` about axes that turn along (Staubli): `Rx(rx) Ry(ry) Rz(rz)`.
    TurnedXyz,
    /// `rx_deg, ry_deg, rz_deg` about axes that stand (Yaskawa, Denso ..): `Rz(rz) Ry(ry) Rx(rx)`.
    FixedXyz,
    /// `o_deg, a_deg, t_deg` (Kawasaki): `Rz(o) Ry(a) Rz(t)`.
    Oat,
}

impl Notation {
    /// The headings of their columns, in the order of [`Self::rotation`]'s numbers.
    pub(super) const fn columns(self) -> &'static [&'static str] {
        match self {
            Self::Abc => &["a_deg", "b_deg", "c_deg"],
            Self::Wpr => &["w_deg", "p_deg", "r_deg"],
            Self::Quaternion => &["qw", "qx", "qy", "qz"],
            Self::TurnedXyz | Self::FixedXyz => &["rx_deg", "ry_deg", "rz_deg"],
            Self::Oat => &["o_deg", "a_deg", "t_deg"],
        }
    }

    /// What it is called where it is reported how a table was read.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Abc => "A, B, C about z, the turned y, the turned x (KUKA)",
            Self::Wpr => "W, P, R about the fixed x, y, z (Fanuc)",
            Self::Quaternion => "a quaternion, scalar first (ABB)",
            Self::TurnedXyz => "RX, RY, RZ about x, the turned y, the turned z (Staubli)",
            Self::FixedXyz => "RX, RY, RZ about the fixed x, y, z (Yaskawa, Denso)",
            Self::Oat => "O, A, T about z, the turned y, the turned z (Kawasaki)",
        }
    }

    /// The rotation of as many numbers as there are columns; `None` of a quaternion that is far from a unit one.
    pub(super) fn rotation(self, numbers: &[f64]) -> Option<UnitQuaternion<f64>> {
        /// A quaternion as printed is a unit one to its last digits.
        const OFF: f64 = 0.01;
        let about = |axis: Vector3<f64>, i: usize| UnitQuaternion::new(axis * numbers[i].to_radians());
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        Some(match self {
            Self::Abc => about(z, 0) * about(y, 1) * about(x, 2),
            Self::Wpr | Self::FixedXyz => about(z, 2) * about(y, 1) * about(x, 0),
            Self::TurnedXyz => about(x, 0) * about(y, 1) * about(z, 2),
            Self::Oat => about(z, 0) * about(y, 1) * about(z, 2),
            Self::Quaternion => {
                let raw = Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3]);
                return ((raw.norm() - 1.0).abs() <= OFF).then(|| UnitQuaternion::from_quaternion(raw));
            }
        })
    }
}
