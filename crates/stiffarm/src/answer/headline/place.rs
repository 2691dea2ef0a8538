//! The best place of one zone in a few sentences.

use super::super::PlaceAnswer;
use super::super::place::Verdict;
use super::super::uncertainty;
use super::super::words::{self, fixed};
use super::{Headline, Outcome, judged, mm, rests_on, scattered};
use crate::place::{Placed, Placement};

impl PlaceAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let (outcome, sentences) = match &self.placed {
            Placed::Infeasible { reason, is_proved, largest_scale } => {
                let proof =
                    if *is_proved && largest_scale.is_none() { "; it is proved that there is none" } else { "" };
                let told = format!("{} has no place for {}: {reason}{proof}.", self.robot.full_name(), self.task.label);
                (Outcome::NoPlace, vec![told])
            }
            Placed::Feasible(best) => self.judged(best),
        };
        let mut rests_on = rests_on(&self.robot);
        rests_on.push(format!("Force: {}.", words::load(self.options.load, &self.model)));
        rests_on.extend(self.notes().lines().map(sentence));
        Headline { outcome, sentences, rests_on }
    }

    fn judged(&self, best: &Placement) -> (Outcome, Vec<String>) {
        let (name, label, value) = (self.robot.full_name(), &self.task.label, mm(best.deflection));
        let stands = self.where_it_stands();
        let Some(tolerance) = self.tolerance_mm else {
            let told = format!("{name} gives way by {value} at worst on {label}, {stands}.");
            let proof = (!self.is_at_one_place()).then(|| proved(best));
            return self
                .colliding(best)
                .unwrap_or((Outcome::Told, [Some(told), proof].into_iter().flatten().collect()));
        };
        let verdict = Verdict::of(best.deflection, tolerance);
        let spread = uncertainty::of(&self.robot, self.options.load, Some(best));
        let mut sentences = vec![if verdict.passes {
            format!(
                "{name} holds {tolerance} mm on {label}: {value} at worst {stands}, {} mm less than is allowed.",
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
                format!(
                    "A place that holds it is not ruled out: what is proved is that no place has less than {bound}."
                )
            } else {
                format!("No place that is allowed holds it: none has less than {bound}, which is proved.")
            });
        }
        sentences.extend(scattered(verdict.passes, spread, tolerance));
        match self.colliding(best) {
            Some((outcome, mut told)) => {
                told.extend(sentences);
                (outcome, told)
            }
            None => (judged(verdict.passes, spread, tolerance), sentences),
        }
    }

    /// A place that must not be chosen.
    fn colliding(&self, best: &Placement) -> Option<(Outcome, Vec<String>)> {
        let clearance = best.clearance.filter(|_| best.space().is_some() && best.collides())?;
        let [name, says] = words::clearance(&clearance);
        Some((
            Outcome::Collides,
            vec![format!("{name} of {} {}: {says}.", self.robot.full_name(), self.where_it_stands())],
        ))
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
    let told = first + letters.as_str();
    if told.ends_with('.') { told } else { told + "." }
}
