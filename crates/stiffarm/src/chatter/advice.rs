//! What else could be done about a cut that swings: another speed of the spindle, or the feed the other way.

use nalgebra::{Matrix3, Vector3};

use super::Chatter;
use super::curve::Edge;
use super::cut::Cut;
use super::teeth::Teeth;
use super::tip::Tip;
use crate::cutting::Milling;

/// Speeds that are looked at, as shares of the spindle's.
const NEARBY: [f64; 2] = [0.5, 1.5];
/// Speeds of a chart are shares of the spindle's but for rounding.
const ROUNDED: f64 = 1e-9;

impl Chatter {
    /// Speeds of the spindle at which the cut is calm ([`Verdict::Calm`](super::Verdict)), rad/s: from where to where, ascending, among the
    /// speeds of the chart within 0.5 to 1.5 of the spindle's. Empty where there are none.
    ///
    /// `None` where teeth are counted one by one, which has no interval at other speeds, of drives that are nobody's, and where a measured table
    /// decides nothing.
    pub fn calm_speeds(&self) -> Option<Vec<[f64; 2]>> {
        if self.drives_are_assumed || self.is_vague() {
            return None;
        }
        let nearby = NEARBY[0] - ROUNDED..=NEARBY[1] + ROUNDED;
        let (depth, mut found, mut goes_on) = (self.cut.milling.engagement.depth(), Vec::<[f64; 2]>::new(), false);
        for lobe in self.lobes.iter().filter(|lobe| nearby.contains(&(lobe.spindle / self.cut.spindle))) {
            let is_calm = lobe.spread?.allows(depth, lobe.edge);
            match found.last_mut().filter(|_| goes_on && is_calm) {
                Some(last) => last[1] = lobe.spindle,
                None => found.extend(is_calm.then_some([lobe.spindle; 2])),
            }
            goes_on = is_calm;
        }
        Some(found)
    }
}

impl Cut {
    /// The same material at the same place, and the feed turned round: up milling for down, down for up.
    #[must_use]
    pub fn other_way(&self) -> Self {
        Self { milling: Milling { engagement: self.milling.engagement.mirrored(), ..self.milling }, ..*self }
    }
}

/// From which depth the cut swings fed the other way; tooth by tooth where there are steps, sought from a depth, m.
pub(super) fn other_way(tip: &Tip, cut: &Cut, steps: Option<usize>, from: f64) -> Option<Edge> {
    let turned = Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0));
    let (tip, cut) = (tip.seen_along(&turned), cut.other_way());
    match steps {
        Some(steps) => Teeth::of(&tip.motion, &cut).edge_at(cut.spindle, steps, from),
        None => tip.curve(&tip.motion, &cut).edge_at(cut.period_at(cut.spindle)),
    }
}
