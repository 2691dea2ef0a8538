//! The best place of one zone in a few sentences.

use super::super::PlaceAnswer;
use super::super::verdict::{HOLDS, Verdict};
use super::super::words::{self, fixed};
use super::{Headline, Outcome, judged, means, mm, proviso, rests_on, scattered};
use stiffarm::place::{Placed, Placement};

impl PlaceAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let (outcome, sentences) = match &self.placed {
            Placed::Infeasible { reason, is_proved, largest_scale } => {
                let proof = words::proved_none(*is_proved, *largest_scale);
                let text = format!("{} has no place for {}: {reason}{proof}.", self.robot.full_name(), self.task.label);
                (Outcome::NoPlace, vec![text])
            }
            Placed::Feasible(best) => self.judged(best),
        };
        let mut rests_on = means(self.tolerance_mm).into_iter().chain(rests_on(&self.robot)).collect::<Vec<_>>();
        rests_on.push(format!("Force: {}.", words::load(self.options.load, &self.model)));
        rests_on.extend(self.carried().sentences());
        rests_on.extend(self.notes().lines().filter(|line| *line != HOLDS).map(sentence));
        Headline { outcome, sentences, rests_on }
    }

    fn judged(&self, best: &Placement) -> (Outcome, Vec<String>) {
        let (name, label, value) = (self.robot.full_name(), &self.task.label, mm(best.deflection));
        let stands = self.where_it_stands();
        let Some((tolerance, verdict)) = self.tolerance_mm.zip(self.verdict()) else {
            let text = format!("{name} gives way by {value} at worst on {label}, {stands}.");
            let proof = (!self.is_at_one_place()).then(|| proved(best));
            return self
                .colliding()
                .or_else(|| self.overloaded())
                .unwrap_or((Outcome::Computed, [Some(text), proof].into_iter().flatten().collect()));
        };
        let mut sentences = vec![if verdict.passes {
            format!(
                "{name} holds {tolerance} mm on {label}{}: {value} at worst {stands}, {} mm less than is allowed.",
                proviso(verdict),
                fixed(verdict.margin_mm, 4)
            )
        } else {
            format!(
                "{name} does not hold {tolerance} mm on {label}: {value} at worst {stands}, {} mm more than is allowed.",
                fixed(-verdict.margin_mm, 4)
            )
        }];
        if !verdict.passes && !self.is_at_one_place() {
            let bound = mm(best.lower_bound);
            sentences.push(if Verdict::of(best.lower_bound, tolerance).passes {
                format!("A place that holds it is not ruled out: the proved lower bound is {bound}.")
            } else {
                format!("No place that is allowed holds it: none has less than {bound}, which is proved.")
            });
        }
        sentences.push(scattered(verdict, self.known().map(|known| known.spread), &self.robot));
        match self.colliding().or_else(|| self.overloaded()) {
            Some((outcome, mut warnings)) => {
                warnings.extend(sentences);
                (outcome, warnings)
            }
            None => (judged(verdict), sentences),
        }
    }

    /// A place that must not be chosen.
    fn colliding(&self) -> Option<(Outcome, Vec<String>)> {
        let clearance = self.collision()?;
        let [name, says] = words::clearance(&clearance);
        Some((
            Outcome::Collides,
            vec![format!("{name} of {} {}: {says}.", self.robot.full_name(), self.where_it_stands())],
        ))
    }

    /// More than the robot may carry.
    fn overloaded(&self) -> Option<(Outcome, Vec<String>)> {
        Some((Outcome::Overloaded, vec![self.carried().forbidden(&self.robot)?]))
    }
}

/// How far the best place may be from the best there is.
fn proved(best: &Placement) -> String {
    format!("No place that is allowed has less than {}, which is proved.", mm(best.lower_bound))
}

/// A line of notes as a sentence.
pub(super) fn sentence(line: &str) -> String {
    let mut letters = line.trim().chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    let text = first + letters.as_str();
    if text.ends_with(['.', '?', '!']) { text } else { text + "." }
}
