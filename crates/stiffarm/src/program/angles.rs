//! A rotation in the numbers of a controller, and numbers as a controller reads them.

use nalgebra::UnitQuaternion;

pub(super) use crate::spatial::Zyx;

/// `[w, x, y, z]` with w of at least 0: of the two quaternions of a rotation the one that controllers show.
pub(super) fn quaternion(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = [rotation.w, rotation.i, rotation.j, rotation.k];
    let sign = if q[0] < 0.0 { -1.0 } else { 1.0 };
    q.map(|part| sign * part)
}

/// A number with so many decimals; what rounds to zero has no sign.
pub(super) fn fixed(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    if text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.')) { text.replace('-', "") } else { text }
}

/// Decimals of a length in mm: 0.1 um. Controllers hold numbers in single precision, which at 2 m tells 0.12 um.
pub(super) const OF_LENGTH: usize = 4;

/// Decimals of an orientation angle in deg: 1e-5 deg turns a tool by 0.2 urad.
pub(super) const OF_ANGLE: usize = 5;

/// Decimals of a joint angle in deg: six joints 3 m off add up, so one more.
pub(super) const OF_JOINT: usize = 6;

/// Decimals of the parts of a quaternion.
pub(super) const OF_QUATERNION: usize = 8;

/// A length in mm.
pub(super) fn mm(metres: f64) -> String {
    fixed(metres * 1e3, OF_LENGTH)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn a_quarter_turn_about_each_axis_is_as_by_hand() {
        for (about, expected) in [
            ([0.0, 0.0, FRAC_PI_2], [90.0, 0.0, 0.0]),
            ([0.0, 0.5, 0.0], [0.0, 0.5_f64.to_degrees(), 0.0]),
            ([PI - 1e-3, 0.0, 0.0], [0.0, 0.0, (PI - 1e-3).to_degrees()]),
        ] {
            let found = Zyx::of(&UnitQuaternion::from_scaled_axis(about.into()));
            assert!(!found.is_at_gimbal);
            for (a, b) in found.degrees().into_iter().zip(expected) {
                assert!((a - b).abs() < 1e-12, "{about:?}: {found:?}");
            }
        }
    }

    #[test]
    fn at_the_gimbal_the_last_angle_is_zero() {
        // Ry(90) Rx(30) turns as Rz(-30) Ry(90) does.
        let turned = UnitQuaternion::from_euler_angles(30_f64.to_radians(), FRAC_PI_2, 0.0);
        let found = Zyx::of(&turned);
        assert!(found.is_at_gimbal && found.x == 0.0);
        assert!((found.degrees()[0] + 30.0).abs() < 1e-7 && (found.degrees()[1] - 90.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn what_rounds_to_zero_has_no_sign() {
        assert_eq!([fixed(-1e-9, 4), fixed(-0.5, 2), fixed(-0.0, 0), fixed(1.0, 1)], ["0.0000", "-0.50", "0", "1.0"]);
        assert_eq!(quaternion(&UnitQuaternion::identity()), [1.0, 0.0, 0.0, 0.0]);
    }
}
