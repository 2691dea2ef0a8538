//! A path that is milled in a few sentences.

use super::super::verdict::{HOLDS, Verdict};
use super::super::words::fixed;
use super::super::{ByToolAnswer, MillAnswer};
use super::place::sentence;
use super::{Headline, Outcome, judged, means, mm, proviso, rests_on, scattered};
use stiffarm::mill::Followed;

impl MillAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let name = self.robot.full_name();
        let (outcome, sentences) = match self.followed() {
            None => {
                let reason = self.reason().unwrap_or_default();
                let outcome = if self.search.is_some() || self.placement.is_none() {
                    Outcome::NoPlace
                } else {
                    Outcome::NotFollowed
                };
                (outcome, vec![format!("{name} does not follow {}: {reason}.", self.along())])
            }
            Some(found) => {
                let (judged, sentences) = self.judgement(found);
                // What swings is told below.
                let loud = self.contact_sentence().or_else(|| self.overload_sentence());
                let outcome = self.barred().map_or(judged, Outcome::from);
                (outcome, loud.into_iter().chain(sentences).collect())
            }
        };
        let sentences: Vec<String> =
            sentences.into_iter().chain(self.chatter_verdict().map(|verdict| format!("Chatter: {verdict}."))).collect();
        let mut rests_on = means(self.tolerance_mm).into_iter().chain(rests_on(&self.robot)).collect::<Vec<_>>();
        rests_on.push(format!("Force on the tool: {}.", self.force));
        rests_on.extend(self.carried().sentences());
        rests_on.extend(self.notes().lines().filter(|line| *line != HOLDS).map(sentence));
        rests_on.extend(self.remarks.iter().map(|remark| sentence(remark)));
        Headline { outcome, sentences, rests_on }
    }

    fn judgement(&self, found: &Followed) -> (Outcome, Vec<String>) {
        let (name, path, value) = (self.robot.full_name(), self.along(), mm(found.worst.0));
        let Some((tolerance, verdict)) = self.tolerance_mm.zip(self.verdict()) else {
            let mut sentences = vec![format!("The tool of {name} is pushed off by {value} at worst along {path}.")];
            sentences.extend(self.left());
            return (Outcome::Computed, sentences);
        };
        let (word, margin, less) = if verdict.passes {
            ("holds", verdict.margin_mm, "less")
        } else {
            ("does not hold", -verdict.margin_mm, "more")
        };
        // What is milled decides, and leads.
        let milled = self.milled_verdict().unwrap_or(verdict);
        let mut sentences: Vec<String> = self.compensated_verdict().and_then(|_| self.left()).into_iter().collect();
        sentences.push(format!(
            "{name} {word} {tolerance} mm along {path}{}{}: the tool is pushed off by {value} at worst, {} mm {less} than is allowed.",
            if self.compensation.is_some() { " without compensation" } else { "" },
            proviso(verdict),
            fixed(margin, 4)
        ));
        if let (false, Some(bound)) = (verdict.passes, self.lower_bound()) {
            let (places, helps) = if self.search.is_some() {
                ("of all places and ", "Neither another place nor turning the tool helps")
            } else {
                ("", "Turning the tool does not help")
            };
            let proved = format!("proved lower bound {places}{} is {}", self.which_rolls(), mm(bound));
            sentences.push(if Verdict::of(bound, tolerance).passes {
                format!("Better ones are not ruled out: the {proved}.")
            } else if self.bounds_all_rolls() {
                format!("{helps}: the {proved}.")
            } else {
                format!("The {proved}; other rolls may hold it.")
            });
        }
        let scatter = scattered(verdict, self.spread(), &self.robot);
        let without = if self.compensation.is_some() { "Without compensation: " } else { "" };
        sentences.push(format!("{without}{scatter}"));
        if self.compensated_verdict().is_none() {
            sentences.extend(self.left());
        }
        let left = (tolerance - milled.margin_mm) / 1e3;
        let remaining = self.compensation.as_ref().and_then(|compensation| compensation.remaining.as_ref());
        let p95 = remaining.map(|(left, _)| left.p95).or_else(|| self.p95());
        let exceeded = self.geometry_exceeds(tolerance, (left, p95), self.compensation.is_some());
        sentences.extend(exceeded.map(|exceeded| exceeded.sentence).filter(|_| milled.passes));
        (judged(milled), sentences)
    }

    /// What compensation leaves, where it was asked for.
    fn left(&self) -> Option<String> {
        let compensation = self.compensation.as_ref()?;
        let by_model = mm(compensation.done.by_joints);
        let Some((remaining, what)) = &compensation.remaining else {
            return Some(format!(
                "Compensated, {by_model} is left by the model; the expected residual is not known: the drive stiffness has no stated uncertainty."
            ));
        };
        let verdict = self.tolerance_mm.zip(self.compensated_verdict());
        let verdict = verdict.map_or_else(String::new, |(tolerance, verdict)| {
            format!("; tolerance {tolerance} mm: {}", verdict.in_words())
        });
        Some(format!(
            "Compensated, {by_model} is left by the model; the expected residual ({what}) is {} in the median and {} with 95 %{verdict}.",
            mm(remaining.median),
            mm(remaining.p95)
        ))
    }
}

impl ByToolAnswer {
    /// The same of all tools together, and of each.
    pub fn headline(&self) -> Headline {
        let name = self.robot.full_name();
        let computed = self.barred().map_or(Outcome::Computed, Outcome::from);
        let (outcome, first) = match self.worst() {
            None => {
                let reason = self.reason().unwrap_or_default();
                (Outcome::NotFollowed, format!("{name} does not follow {}: {reason}.", self.path))
            }
            Some((section, error)) => {
                let (worst, tool) = (mm(error), section.tool);
                let text =
                    format!("The tools of {name} are pushed off by {worst} at worst along {}, T{tool}", self.path);
                let of_all = |tolerance: f64, verdict: Verdict| {
                    format!("tolerance {tolerance} mm, all tools: {}", verdict.in_words())
                };
                let judged_of = |verdict: Option<Verdict>| self.tolerance_mm.zip(verdict);
                match (judged_of(self.compensated_verdict()), judged_of(self.verdict())) {
                    (None, None) => (computed, format!("{text}.")),
                    (None, Some((tolerance, verdict))) => {
                        (judged(verdict), format!("{text}; {}.", of_all(tolerance, verdict)))
                    }
                    (Some((tolerance, left)), without) => {
                        let without = without
                            .map_or_else(String::new, |(_, verdict)| format!("; {}", of_all(tolerance, verdict)));
                        let compensated = of_all(tolerance, left);
                        (judged(left), format!("Compensated, {compensated}. Without compensation: {text}{without}."))
                    }
                }
            }
        };
        let mut sentences = vec![first];
        sentences.extend(self.of_each(|milled| milled.headline().sentences));
        let mut rests_on = self.of_each(|milled| milled.headline().rests_on);
        rests_on.extend(self.remarks.iter().map(|remark| sentence(remark)));
        Headline { outcome, sentences, rests_on }
    }
}
