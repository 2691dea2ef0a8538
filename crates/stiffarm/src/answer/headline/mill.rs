//! A path that is milled in a few sentences.

use super::super::MillAnswer;
use super::super::place::Verdict;
use super::super::words::fixed;
use super::place::sentence;
use super::{Headline, Outcome, judged, mm, rests_on, scattered};
use crate::mill::Followed;

impl MillAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let name = self.robot.full_name();
        let (outcome, sentences) = match self.followed() {
            None => {
                let reason = self.reason().unwrap_or_default();
                let outcome = if self.sought.is_some() || self.placement.is_none() {
                    Outcome::NoPlace
                } else {
                    Outcome::NotFollowed
                };
                (outcome, vec![format!("{name} does not follow {}: {reason}.", self.path)])
            }
            Some(found) => self.judged(found),
        };
        let mut rests_on = rests_on(&self.robot);
        rests_on.push(format!("Force on the tool: {}.", self.force));
        rests_on.extend(self.notes().lines().map(sentence));
        rests_on.extend(self.remarks.iter().map(|remark| sentence(remark)));
        Headline { outcome, sentences, rests_on }
    }

    fn judged(&self, found: &Followed) -> (Outcome, Vec<String>) {
        let (name, path, value) = (self.robot.full_name(), &self.path, mm(found.worst.0));
        let Some(tolerance) = self.tolerance_mm else {
            let mut told = vec![format!("The tool of {name} is pushed off by {value} at worst along {path}.")];
            told.extend(self.left(None));
            return (Outcome::Told, told);
        };
        let verdict = Verdict::of(found.worst.0, tolerance);
        let (word, margin, less) = if verdict.passes {
            ("holds", verdict.margin_mm, "less")
        } else {
            ("does not hold", -verdict.margin_mm, "more")
        };
        let mut told = vec![format!(
            "{name} {word} {tolerance} mm along {path}: the tool is pushed off by {value} at worst, {} mm {less} than is allowed.",
            fixed(margin, 4)
        )];
        if let (false, Some(bound)) = (verdict.passes, self.lower_bound()) {
            let (nowhere, helps) = if self.sought.is_some() {
                ("no place and ", "Neither another place nor turning the tool helps")
            } else {
                ("", "Turning the tool does not help")
            };
            let proved = format!("{nowhere}{} less than {}", self.bounded(), mm(bound));
            told.push(if Verdict::of(bound, tolerance).passes {
                format!("Better ones are not ruled out: it is proved that {proved}.")
            } else if self.bounds_all_rolls() {
                format!("{helps}: {proved}, which is proved.")
            } else {
                format!("It is proved that {proved}; other rolls may.")
            });
        }
        told.extend(scattered(verdict.passes, self.spread(), tolerance));
        told.extend(self.left(Some(tolerance)));
        (judged(verdict.passes, self.spread(), tolerance), told)
    }

    /// What compensation leaves, where it was asked for.
    fn left(&self, tolerance: Option<f64>) -> Option<String> {
        let compensation = self.compensation.as_ref()?;
        let by_model = mm(compensation.done.by_joints);
        let Some((remaining, who)) = &compensation.remaining else {
            return Some(format!(
                "Compensated, {by_model} is left by the model; what is left in truth is not known, as nothing says how far the drives may be off."
            ));
        };
        let verdict = tolerance.map_or_else(String::new, |tolerance| {
            format!(", tolerance {tolerance} mm: {}", Verdict::of(remaining.p95, tolerance).word())
        });
        Some(format!(
            "Compensated, {by_model} is left by the model, and in 95 % of draws no more than {} ({who}){verdict}.",
            mm(remaining.p95)
        ))
    }
}
