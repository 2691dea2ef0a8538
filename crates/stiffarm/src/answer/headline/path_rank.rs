//! Robots on a path in a few sentences.

use super::super::words;
use super::super::{MillAnswer, PathRankAnswer};
use super::place::sentence;
use super::{Headline, Outcome, drives_rest_on, judged, scattered};

impl PathRankAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let mut sentences = self.sentences();
        let best = self.best().and_then(|(best, _)| Some((best, best.milled.as_ref().ok()?)));
        let scatter = best.zip(self.tolerance_mm).and_then(|((best, milled), tolerance)| {
            Some((&best.robot.name, scattered(best.holds(tolerance), milled.spread(), tolerance)?))
        });
        sentences.extend(scatter.map(|(name, told)| format!("{name}: {told}")));
        let mut rests_on = drives_rest_on(self.rows.iter().map(|row| &row.robot));
        rests_on.push(format!("Force on the tool: {}.", self.force()));
        if let Some(first) = self.milled().next() {
            rests_on.push(format!("Tool: {}; keeps {}.", words::tool(&first.flange_from_tool), first.kept()));
            rests_on.extend(first.notes().lines().map(sentence));
        }
        rests_on.extend(self.remarks.iter().map(|remark| sentence(remark)));
        Headline { outcome: self.outcome(), sentences, rests_on }
    }

    fn outcome(&self) -> Outcome {
        let Some((best, rivals)) = self.best() else { return Outcome::NoPlace };
        if self.shortfall().is_some() {
            return Outcome::Fails;
        }
        if !rivals.is_empty() || 1 < self.rows.iter().filter(|row| row.chances.is_some_and(|one| one.ties)).count() {
            return Outcome::Tie;
        }
        let spread = best.milled.as_ref().ok().and_then(MillAnswer::spread);
        self.tolerance_mm.map_or(Outcome::Advised, |tolerance| judged(best.holds(tolerance), spread, tolerance))
    }
}
