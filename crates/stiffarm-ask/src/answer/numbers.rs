//! Numbers as people read them.

/// Rounded for people; what rounds to zero has no sign.
pub fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| "0.".contains(c)) => rest.into(),
        _ => text,
    }
}

/// So many digits of a number.
pub(super) fn digits(x: f64, count: usize) -> f64 {
    format!("{x:.*e}", count - 1).parse().unwrap_or(x)
}

/// Turns a minute, of rad/s.
pub(super) fn rpm(spindle: f64) -> f64 {
    spindle * 60.0 / std::f64::consts::TAU
}
