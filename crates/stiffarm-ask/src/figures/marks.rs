//! Small marks on lines and points.

use std::fmt::Write;

use stiffarm::palette::ALARM;

use super::canvas::{Canvas, Px};

/// The cross at a row that is left out.
pub(crate) fn left_out(canvas: &mut Canvas, at: Px) {
    cross(canvas, at, 4.5, &format!(r#"fill="none" stroke="{ALARM}" stroke-width="2""#));
}

/// A diagonal cross.
pub(crate) fn cross(canvas: &mut Canvas, [x, y]: Px, half: f64, look: &str) {
    canvas.path(
        &format!(
            "M{:.2} {:.2}L{:.2} {:.2}M{:.2} {:.2}L{:.2} {:.2}",
            x - half,
            y - half,
            x + half,
            y + half,
            x - half,
            y + half,
            x + half,
            y - half
        ),
        look,
    );
}

/// One of six marks that stay apart in a print without colour.
pub(crate) fn mark(canvas: &mut Canvas, at: Px, kind: usize, look: &str) {
    // Corners and the direction of the first one, in degrees.
    let corners: &[f64] = match kind % 6 {
        0 => return canvas.circle(at, 3.6, look),
        1 => &[45.0, 135.0, 225.0, 315.0],
        2 => &[-90.0, 30.0, 150.0],
        3 => &[0.0, 90.0, 180.0, 270.0],
        4 => &[90.0, 210.0, 330.0],
        _ => &[-90.0, -18.0, 54.0, 126.0, 198.0],
    };
    let mut d = String::new();
    for (i, angle) in corners.iter().enumerate() {
        let (s, c) = angle.to_radians().sin_cos();
        let _ = write!(d, "{}{:.2} {:.2}", if i == 0 { "M" } else { "L" }, at[0] + 4.6 * c, at[1] + 4.6 * s);
    }
    canvas.path(&(d + "Z"), look);
}
