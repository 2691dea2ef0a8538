//! Robots on a path in a few sentences.

use super::super::verdict::HOLDS;
use super::super::words;
use super::super::{MillAnswer, PathRankAnswer};
use super::place::sentence;
use super::{Headline, Outcome, drives_rest_on, judged, means, scattered};

impl PathRankAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let mut sentences = self.sentences();
        let best = self.best().and_then(|(best, _)| Some((best, best.milled.as_ref().ok()?)));
        let scatter = best.and_then(|(best, milled)| {
            Some(format!("{}: {}", best.robot.name, scattered(milled.verdict()?, milled.spread(), &best.robot)))
        });
        sentences.extend(scatter);
        let drives = drives_rest_on(self.rows.iter().map(|row| &row.robot));
        let mut rests_on: Vec<String> = means(self.tolerance_mm).into_iter().chain(drives).collect();
        rests_on.push(format!("Force on the tool: {}.", self.force()));
        if let Some(first) = self.milled().next() {
            rests_on.push(format!("Tool: {}; keeps {}.", words::tool(&first.flange_from_tool), first.kept()));
            rests_on.extend(first.notes().lines().filter(|line| *line != HOLDS).map(sentence));
        }
        rests_on.extend(self.remarks.iter().map(|remark| sentence(remark)));
        Headline { outcome: self.outcome(), sentences, rests_on }
    }

    fn outcome(&self) -> Outcome {
        let Some((best, rivals)) = self.best() else {
            return if self.overloads().next().is_some() { Outcome::Overloaded } else { Outcome::NoPlace };
        };
        if self.shortfall().is_some() {
            return Outcome::Fails;
        }
        if !rivals.is_empty() || 1 < self.rows.iter().filter(|row| row.chances.is_some_and(|one| one.ties)).count() {
            return Outcome::Tie;
        }
        best.milled.as_ref().ok().and_then(MillAnswer::verdict).map_or(Outcome::Advised, judged)
    }
}
