//! How an arm swings, in a few sentences.

use stiffarm::uncertainty::Spread;

use super::super::words::{self, fixed};
use super::super::{ModesAnswer, ModesOverAnswer};
use super::place::sentence;
use super::{Headline, Outcome};

/// What every frequency is for.
const MEANS: &str = "Teeth that pass at one of these frequencies, or at a half, a third, a quarter of it, excite the arm. `stiffarm chatter` computes from which depth a cut swings by itself.";
/// Where nothing is known of the drives.
const UNKNOWN: &str = "Its interval is not known: the drive stiffness has no stated uncertainty.";

fn interval(Spread { p05, p95, .. }: Spread) -> String {
    format!("the 90 % interval (drive stiffness) is {} to {} Hz.", fixed(p05, 1), fixed(p95, 1))
}

impl ModesAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let mut sentences = Vec::new();
        if let Some(first) = self.swing.modes.first() {
            let name = self.robot.full_name();
            sentences.push(format!("{name} swings first at {} Hz in this posture.", fixed(first.frequency, 2)));
            sentences.push(first.spread.map_or_else(|| UNKNOWN.into(), |spread| sentence(&interval(spread))));
        }
        sentences.push(MEANS.into());
        let rests_on = std::iter::once(format!("Robot: {}.", words::class(&self.robot)));
        let rests_on = rests_on.chain(self.notes().lines().skip(1).map(sentence)).collect();
        Headline { outcome: Outcome::Computed, sentences, rests_on }
    }
}

impl ModesOverAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let mut sentences = Vec::new();
        if let Some(first) = self.over.modes.first() {
            let [name, zone] = [self.robot.full_name(), self.task.work.describe()];
            let [least, largest] = [first.least, first.largest].map(|hertz| fixed(hertz, 2));
            sentences.push(format!(
                "{name} swings first at {least} to {largest} Hz at the points of {zone} that were looked at."
            ));
            let slowest = |spread| format!("At the slowest of these points {}", interval(spread));
            sentences.push(first.spread.map_or_else(|| UNKNOWN.into(), slowest));
            sentences.extend(self.notes().lines().next().map(sentence));
        }
        sentences.push(MEANS.into());
        let rests_on = std::iter::once(format!("Robot: {}.", words::class(&self.robot)));
        let rests_on = rests_on.chain(self.notes().lines().skip(1).map(sentence)).collect();
        Headline { outcome: Outcome::Computed, sentences, rests_on }
    }
}
