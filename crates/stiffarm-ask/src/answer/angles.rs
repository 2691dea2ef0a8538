//! An angle that was asked for, as answers give it.

/// Degrees as they were typed, of an angle that was asked, rad: not as they come out of radians.
pub(super) fn asked_degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e9).round() / 1e9 + 0.0
}

/// An angle that was asked for, rad, without digits that say nothing.
pub(super) fn degrees(angle: f64) -> String {
    format!("{} deg", asked_degrees(angle))
}
