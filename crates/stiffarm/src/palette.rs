//! Which colour means what in every figure of the program, of its pages and of the Python package.

/// Declares each colour once: as a constant, and under its name in [`NAMED`].
macro_rules! colours {
    ($($(#[$doc:meta])+ $constant:ident, $name:literal = $colour:expr;)+) => {
        $($(#[$doc])+ pub const $constant: &str = $colour;)+

        /// Every single colour by its name: for faces that are not written in Rust.
        pub const NAMED: &[(&str, &str)] = &[$(($name, $constant)),+];
    };
}

colours! {
    /// What everything is drawn on; also the rim that keeps a line apart from what it crosses.
    PAPER, "paper" = "white";
    /// Texts, frames and outlines.
    INK, "ink" = "#1a1a1a";
    /// Paragraphs of a page.
    PROSE, "prose" = "#555555";
    /// Texts that may be passed over.
    GREY, "grey" = "#777777";
    /// Lines of a grid.
    FAINT, "faint" = "#dddddd";
    /// What must be found at once.
    ALARM, "alarm" = "#d6001c";

    /// A serial robot among bars: warm.
    SERIAL, "serial" = "#e8893a";
    /// A quasi-serial robot among bars: cool.
    QUASI_SERIAL, "quasi_serial" = "#2c6fbb";
    /// Robots that are not distinguished beside the best.
    OTHERS, "others" = "#bdbdbd";
    /// What fills the marks of a robot whose numbers are estimated.
    ESTIMATED, "estimated" = PAPER;
    /// The line of what the work allows.
    TOLERANCE, "tolerance" = INK;
    /// The line below which no place is: what is proved.
    LIMIT, "limit" = INK;

    /// What is left of an error where it was taken out.
    COMPENSATED, "compensated" = WINDOW;

    /// Below the range of the colours that was asked for.
    UNDER, "under" = "#fffbd5";
    /// Above it.
    OVER, "over" = "#33003d";
    /// Where the work may stand.
    WINDOW, "window" = "#0a7d3c";
    /// Where nothing may be.
    KEEP_OUT, "keep_out" = "#7a1010";
    /// The part, in space.
    PART, "part" = "#b9a878";
    /// What holds it.
    FIXTURE, "fixture" = "#6d7f95";
    /// Where the tool is held and nothing pushes.
    AIR, "air" = "#eaf1f5";
    /// The force on the tool.
    FORCE, "force" = "#a3148f";

    /// The rim of a zone.
    ZONE, "zone" = ALARM;
    /// The worst point of a zone.
    WORST_POINT, "worst_point" = INK;
    /// The best link ratio of a study.
    BEST_RATIO, "best_ratio" = ALARM;

    /// Links, within their outline.
    ARM, "arm" = "#ececec";
    /// The foot and the column that carry the joint-2 axis.
    BASE, "base" = "#b8b8b8";
    /// The hatching below the floor of a section.
    GROUND, "ground" = "#999999";
    /// The squares of the floor in space.
    FLOOR, "floor" = "#b5b5b5";
    /// Links in space, where no outline keeps them apart from the floor.
    ARM_IN_SPACE, "arm_in_space" = "#5f6b76";
    /// Joints in space.
    JOINT_IN_SPACE, "joint_in_space" = "#d7dade";
    /// The tool and its axis in space.
    TOOL, "tool" = "#d98200";
    /// The arrow of the worst direction.
    WORST_DIRECTION, "worst_direction" = ALARM;
    /// The arrow of a deflection.
    DEFLECTION, "deflection" = "#0057b8";

    /// What is reached with the elbow up.
    ELBOW_UP, "elbow_up" = "#6baed6";
    /// The edge of what is reached with the elbow up.
    ELBOW_UP_EDGE, "elbow_up_edge" = "#2171b5";
    /// What is reached with the elbow down.
    ELBOW_DOWN, "elbow_down" = "#fdae6b";
    /// The edge of what is reached with the elbow down.
    ELBOW_DOWN_EDGE, "elbow_down_edge" = "#d94801";
}

/// Serial robots as curves, one after the other: warm, neighbours apart in lightness.
pub const SERIAL_CURVES: [&str; 6] = ["#d62728", "#ff9f1c", "#8c2d04", "#e85d9c", "#c9a400", "#7f1d4f"];
/// Quasi-serial robots as curves, one after the other: cool, neighbours apart in lightness.
pub const QUASI_SERIAL_CURVES: [&str; 6] = ["#1f5fd0", "#17a398", "#3b1f8f", "#4cb5f5", "#2e7d32", "#8a7ff0"];
/// Fixed link ratios of a study.
pub const RATIOS: [&str; 6] = ["#1f5fd0", "#e08a00", "#2e7d32", "#7b3fb5", "#17a3b8", "#7a5230"];

/// Red, green and blue, 0 to 255, of the colour scale at equal steps from small to large values: viridis from its light
/// end. Every step is seen as equally large, and lightness alone carries it in a grey print. The darkest tenth of
/// viridis is left out, so that dark lines still show.
const SCALE: [[u8; 3]; 10] = [
    [253, 231, 37],
    [189, 223, 38],
    [122, 209, 81],
    [68, 191, 112],
    [34, 168, 132],
    [33, 145, 140],
    [42, 120, 142],
    [53, 95, 141],
    [65, 68, 135],
    [72, 36, 117],
];

/// The colour scale of margins, from near a limit to far from it: wine red to pale sand, nowhere a colour of the deflections. Dark is near,
/// and lightness alone carries it in a grey print.
const MARGINS: [[u8; 3]; 6] =
    [[122, 24, 52], [176, 62, 60], [214, 108, 74], [236, 157, 104], [246, 202, 152], [250, 238, 214]];

/// The colour of a margin that lies so far from the smallest to the largest, 0 to 1; beyond, that of the nearer end.
pub fn on_margin_scale(share: f64) -> String {
    mixed(&MARGINS, share)
}

/// The colours between which the scale of margins is drawn straight, at equal steps from near to far.
pub fn margin_scale() -> Vec<String> {
    MARGINS.into_iter().map(hex).collect()
}

/// The colour of a value that lies so far from the smallest to the largest, 0 to 1; beyond, that of the nearer end.
pub fn on_scale(share: f64) -> String {
    mixed(&SCALE, share)
}

fn mixed(scale: &[[u8; 3]], share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (scale.len() - 1) as f64;
    let below = (at as usize).min(scale.len() - 2);
    let part = |part: usize| {
        let [from, to] = [below, below + 1].map(|i| f64::from(scale[i][part]));
        (from + (at - below as f64) * (to - from)).round() as u8
    };
    hex([0, 1, 2].map(part))
}

/// The colours between which the scale is drawn straight, at equal steps from small to large values.
pub fn scale() -> Vec<String> {
    SCALE.into_iter().map(hex).collect()
}

fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How light a colour is in a grey print, 0 to 255.
    fn lightness(colour: &str) -> f64 {
        let part = |at: usize| f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap());
        0.3 * part(1) + 0.59 * part(3) + 0.11 * part(5)
    }

    #[test]
    fn lighter_is_smaller_throughout() {
        let greys: Vec<f64> = (0..=100).map(|i| lightness(&on_scale(f64::from(i) / 100.0))).collect();
        assert!(greys.windows(2).all(|pair| pair[1] < pair[0]), "{greys:?}");
    }

    #[test]
    fn margins_are_darker_the_nearer_and_share_no_colour_with_deflections() {
        let greys: Vec<f64> = (0..=100).map(|i| lightness(&on_margin_scale(f64::from(i) / 100.0))).collect();
        assert!(greys.windows(2).all(|pair| pair[0] < pair[1]), "{greys:?}");
        let parts = |colour: &str| [1, 3, 5].map(|at| i32::from_str_radix(&colour[at..at + 2], 16).unwrap());
        for margin in margin_scale() {
            for deflection in scale() {
                let apart: i32 = parts(&margin).iter().zip(parts(&deflection)).map(|(a, b)| (a - b).abs()).sum();
                assert!(60 < apart, "{margin} {deflection}");
            }
        }
    }

    #[test]
    fn the_scale_goes_through_its_colours_and_stops_at_its_ends() {
        for (i, colour) in scale().iter().enumerate() {
            assert_eq!(on_scale(i as f64 / 9.0), *colour);
        }
        assert_eq!([-1.0, 0.0, 1.0, 2.0].map(on_scale), ["#fde725", "#fde725", "#482475", "#482475"]);
        // Half-way between (253, 231, 37) and (189, 223, 38).
        assert_eq!(on_scale(0.5 / 9.0), "#dde326");
    }

    #[test]
    fn neighbouring_curves_are_apart_in_a_grey_print() {
        for curves in [SERIAL_CURVES, QUASI_SERIAL_CURVES] {
            for pair in curves.windows(2) {
                // A twentieth of the way from black to white.
                assert!(255.0 / 20.0 < (lightness(pair[0]) - lightness(pair[1])).abs(), "{pair:?}");
            }
        }
    }

    #[test]
    fn every_name_stands_for_one_colour() {
        for (i, (name, colour)) in NAMED.iter().enumerate() {
            assert!(NAMED[..i].iter().all(|(other, _)| other != name), "{name}");
            assert!(*colour == PAPER || colour.len() == 7 && lightness(colour).is_finite(), "{name}: {colour}");
        }
    }
}
