//! A ranking in a few sentences.

use super::super::words::{self, fixed};
use super::super::{RankAnswer, uncertainty};
use super::place::sentence;
use super::{Headline, Outcome, drives_rest_on, means, mm};
use stiffarm::model::ModelKind;
use stiffarm::rank::Row;

impl RankAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let ranking = &self.ranking;
        let mut sentences = self.sentences();
        let first = 1.min(sentences.len());
        sentences.splice(first..first, self.shortfall().map(|why| sentence(&why)).into_iter().chain(self.leads()));
        let drives = drives_rest_on(ranking.rows.iter().map(|row| &row.robot));
        let mut rests_on: Vec<String> = means(self.tolerance_mm).into_iter().chain(drives).collect();
        rests_on.push(match &ranking.model {
            ModelKind::Planar => "Model: the arm plane with the drives 2 and 3; wrist and tool are not in it.".into(),
            ModelKind::Spatial(_) => "Model: six axes with all drives; everything else is rigid.".into(),
        });
        rests_on.push(format!("Force: {}.", words::load(ranking.load, &ranking.model)));
        Headline { outcome: self.outcome(), sentences, rests_on }
    }

    fn outcome(&self) -> Outcome {
        let ranking = &self.ranking;
        let tasks = 0..ranking.tasks.len();
        let winners: Vec<(usize, &Row)> = tasks.filter_map(|task| Some((task, self.best_published(task)?))).collect();
        let any = |odd: &dyn Fn(usize, &Row) -> bool| winners.iter().any(|(task, row)| odd(*task, row));
        if winners.is_empty() {
            return Outcome::NoPlace;
        }
        if any(&|task, row| self.collides(self.at(row), task)) {
            return Outcome::Collides;
        }
        if self.tolerance_mm.is_some() && self.shortfall().is_some() {
            return Outcome::Fails;
        }
        if winners.len() < ranking.tasks.len() {
            return Outcome::NoPlace;
        }
        if any(&|_, row| self.carried(&row.robot).is_exceeded()) {
            return Outcome::Overloaded;
        }
        if any(&|task, _| !self.rivals(task).is_empty() || 1 < uncertainty::ties(&self.chances, task)) {
            return Outcome::Tie;
        }
        let is_open =
            |(task, row): &(usize, &Row)| self.verdict_of(row, *task).is_some_and(|verdict| !verdict.is_sure());
        match self.tolerance_mm {
            None => Outcome::Advised,
            Some(_) if winners.iter().any(is_open) => Outcome::PassesPerhaps,
            Some(_) => Outcome::Passes,
        }
    }

    /// By how much the best of a task is ahead of all others, where that is proved.
    fn leads(&self) -> Option<String> {
        let (ranking, tasks) = (&self.ranking, self.ranking.tasks.len());
        let leads: Vec<Lead> = (0..tasks).filter_map(|task| self.lead(task)).collect();
        let least = leads.iter().min_by(|a, b| a.ahead.total_cmp(&b.ahead))?;
        // Never more than it is.
        let digits: u8 = if least.ahead < 1e-3 { 3 } else { 1 };
        let unit = 10_f64.powi(digits.into());
        let percent = fixed((100.0 * unit * least.ahead).floor() / unit, digits.into());
        let label = |lead: &Lead| self.ranking.tasks[lead.task].label.as_str();
        let (next, bound) = (&least.next.robot.name, mm(least.bound));
        let on = match leads.len() {
            1 => label(least).to_owned(),
            all if all == tasks => "every task".into(),
            _ => leads.iter().map(label).collect::<Vec<_>>().join(", "),
        };
        let taken = if ranking.rows.iter().any(|row| self.is_barred(row)) { " that may be taken" } else { "" };
        let of = format!("on {on} every other robot{taken} gives way at least {percent} % more");
        Some(format!(
            "Proved at the nominal stiffness: {of} than the best (the nearest is {next} on {}, with no less than {bound}).",
            label(least)
        ))
    }

    fn lead(&self, task: usize) -> Option<Lead<'_>> {
        let best = self.best_published(task)?;
        let value = best.deflection(task)?;
        if !self.rivals(task).is_empty() || 1 < uncertainty::ties(&self.chances, task) {
            return None;
        }
        let others = self.ranking.rows.iter().filter(|row| row.rank.is_some() && row.robot != best.robot);
        let others = others.filter(|row| !self.is_barred(row));
        let bounds = others.filter_map(|row| Some((row.placement(task)?.lower_bound, row)));
        let (bound, next) = bounds.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Lead { task, ahead: bound / value - 1.0, next, bound })
    }
}

/// How far the best of a task is ahead of all others, which is proved.
struct Lead<'a> {
    task: usize,
    /// So much more, relative to its value, every other gives way at least.
    ahead: f64,
    /// Who comes nearest, and what it has at least, m.
    next: &'a Row,
    bound: f64,
}
