//! Moves cut into samples, so fine that chords keep to arcs and nothing longer than a step is left out.

use nalgebra::Vector3;

use super::moves::{Move, MoveKind, ToolPose};

/// How finely moves are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// By how much the chord between two samples may be off the move, m.
    pub chord: f64,
    /// The longest way between two samples, m.
    pub longest: f64,
    /// The largest turn of the tool axis between two samples, rad.
    pub turn: f64,
}

impl Steps {
    /// 0.01 mm of chord, 10 mm of way, 2 deg of turn.
    pub const USUAL: Self = Self { chord: 1e-5, longest: 0.01, turn: 2.0 * std::f64::consts::PI / 180.0 };

    /// Into how many equal pieces a move is cut: the sagitta of a chord over the angle `phi` of an arc is `r (1 - cos(phi / 2))`.
    pub fn pieces(&self, one: &Move) -> usize {
        let by_length = one.length() / self.longest;
        let by_turn = one.turn_of_axis() / self.turn;
        let least = by_length.max(by_turn).ceil().max(1.0);
        if one.chord_error(1.0 / least) <= self.chord {
            return least as usize;
        }
        let (radius, angle) = one.radius_and_angle();
        let half = (1.0 - (self.chord / radius).min(1.0)).acos();
        (angle / (2.0 * half)).ceil().max(least) as usize
    }
}

/// The tool at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The line of the file that asks for it.
    pub line: usize,
    /// The way from the beginning of the path, rapid moves and all, m.
    pub way: f64,
    /// Tip and axis in the part frame.
    pub pose: ToolPose,
    /// Unit vector along the motion; `None` where only the axis turns.
    pub direction: Option<Vector3<f64>>,
    /// m/s, where it is said.
    pub feed: Option<f64>,
    /// It feeds, rather than moves through the air.
    pub is_cutting: bool,
    /// Outward normal of the surface, unit vector, where the file says it.
    pub normal: Option<Vector3<f64>>,
}

/// The samples of one move: its beginning, its end and what lies between; `way` is that of its beginning.
///
/// Each move has samples at both ends, so that at a corner both directions are given.
pub fn samples(one: &Move, steps: &Steps, way: f64) -> impl Iterator<Item = Sample> {
    let (pieces, length) = (steps.pieces(one), one.length());
    let one = *one;
    (0..=pieces).map(move |piece| {
        let t = piece as f64 / pieces as f64;
        Sample {
            line: one.line,
            way: way + length * t,
            pose: ToolPose { tip: one.tip(t), axis: one.axis(t) },
            direction: one.direction(t),
            feed: one.feed,
            is_cutting: one.kind == MoveKind::Feed,
            normal: one.normal(t),
        }
    })
}
