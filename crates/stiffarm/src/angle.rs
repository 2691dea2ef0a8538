//! Angles up to whole turns.

use std::f64::consts::PI;

/// The same angle, rad, in `-pi..pi`.
pub(crate) fn wrapped(angle: f64) -> f64 {
    angle - (angle / (2.0 * PI)).round() * 2.0 * PI
}
