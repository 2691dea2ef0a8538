//! What was measured at a tip, and what is known beside it?

use stiffarm::chatter::{Chatter, HeldBy, Looked, MeasuredTip};

use super::words::fixed;

/// What was measured at a tip.
#[derive(Clone, Debug)]
pub struct TipFile {
    /// How it answers, and what held it.
    pub tip: MeasuredTip,
    /// The table as it was named.
    pub file: String,
    /// How it was understood, with its name.
    pub remarks: Vec<String>,
}

/// Whose modes a verdict is about.
pub(super) fn whose(measured: Option<&Looked>) -> &'static str {
    match measured.map(|measured| measured.held_by) {
        None => "robot modes",
        Some(HeldBy::Rigid) => "robot and measured modes",
        Some(HeldBy::Robot) => "measured modes",
    }
}

/// What a verdict is not about.
pub(super) fn besides(measured: Option<&Looked>) -> &'static str {
    if measured.is_none() { "spindle modes unknown" } else { "modes of the work unknown" }
}

/// What held it, as the option has it.
pub(super) const fn held_by(held_by: HeldBy) -> &'static str {
    match held_by {
        HeldBy::Rigid => "rigid",
        HeldBy::Robot => "robot",
    }
}

/// Hz, one after the other.
pub(super) fn frequencies(hertz: &[f64]) -> String {
    hertz.iter().map(|hertz| fixed(*hertz, 1)).collect::<Vec<_>>().join(", ")
}

/// What was measured, by its table, and how it was held.
pub(super) fn described(looked: &Looked, file: &str) -> String {
    let range = match looked.between {
        Some([from, to]) => format!("from {} to {} Hz", fixed(from, 1), fixed(to, 1)),
        None => format!("modes at {} Hz", frequencies(&looked.modes)),
    };
    let held = match looked.held_by {
        HeldBy::Rigid => "spindle, holder and cutter, held by something rigid",
        HeldBy::Robot => "the tip as the robot holds it",
    };
    format!("{held}: {range}; {file}")
}

/// Beyond which frequencies nothing is known, and why a table decides nothing.
pub(super) fn not_known(chatter: &Chatter) -> String {
    let robot = fixed(chatter.robot_modes.iter().copied().fold(0.0, f64::max), 0);
    let Some(measured) = &chatter.measured else {
        return format!("spindle, tool holder, cutter and work are rigid here: above {robot} Hz nothing is known");
    };
    let to = fixed(measured.highest(), 0);
    let vague = if measured.is_coarse {
        "; the frequencies of the table lie too far apart to decide by it"
    } else if chatter.ends_below_teeth() {
        "; a table that ends below the frequency at which teeth pass decides nothing"
    } else if chatter.may_mislead() {
        "; a table without modes decides nothing of teeth that cut for half of the time or less: a table of modes does"
    } else {
        ""
    };
    match (measured.held_by, measured.between) {
        (HeldBy::Rigid, between) => {
            let below = between.map_or_else(String::new, |[from, _]| {
                format!(", which is taken as a spring below {} Hz", fixed(from, 1))
            });
            format!(
                "the work is rigid here; nothing is known of the tip above {to} Hz{below}, and of the robot above {robot} Hz{vague}"
            )
        }
        (HeldBy::Robot, Some([from, _])) => {
            format!("the work is rigid here; nothing is known below {} and above {to} Hz{vague}", fixed(from, 1))
        }
        (HeldBy::Robot, None) => format!("the work is rigid here; nothing is known above {to} Hz"),
    }
}
