//! `stiffarm rank`: robots in order, for several tasks, against a tolerance.

use crate::answer::{Headline, RankAnswer, Rows};
use crate::request::{Request, distinct};
use serde_json::Value;
use std::cell::OnceCell;
use stiffarm::advice::advise_best;
use stiffarm::rank::rank;
use stiffarm::robot::Robot;

use super::context::{Context, under_process};
use super::outputs::rank::RankOutput;
use super::reports;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::forms::{Answer, Forms, Makes, Picture, Piece};
use crate::report::Report;

pub(crate) fn answer<'a>(asked: &'a Request, context: Context<'a>) -> Result<RankOutput<'a>, AskError> {
    let names = asked.robots();
    let robots = super::selection::robots(&names, context)?;
    let robots = super::selection::keep(robots, asked, &[]).map_err(|failure| widened(failure, &names))?;
    let robots = robots.into_iter().map(|robot| asked.equipped(robot)).collect::<Result<Vec<Robot>, _>>()?;
    let (kind, tasks) = (asked.model(), distinct(&asked.tasks()));
    if tasks.is_empty() {
        return Err(AskError::Usage("no task to rank for; give --task".into()));
    }
    let only = if let [task] = tasks.as_slice() { task.work.zone() } else { None };
    let (options, figure_size) = (under_process(asked, context)?.place_options(only)?, FigureSize::of(asked)?);
    let ranking = context.watched("placing zones", |watch| rank(&robots, &tasks, &kind, &options, watch))?;
    let tolerance_mm = asked.tolerance_mm();
    let advice = match tolerance_mm {
        None => Vec::new(),
        Some(mm) => {
            context.watched("placing smaller zones", |watch| advise_best(&ranking, &options, mm / 1e3, watch))?
        }
    };
    let answer = RankAnswer::of(ranking, options, tolerance_mm, advice);
    Ok(RankOutput { answer, asked, context, figure_size, svg: OnceCell::new() })
}

/// Where only the paper's robots were asked, there are more.
fn widened(failure: AskError, robots: &[String]) -> AskError {
    match failure {
        AskError::NothingLeft { asked, of, hint } if robots == ["paper"] => {
            let hint = format!("{hint}; these are the paper's ten, --robots all takes every robot");
            AskError::NothingLeft { asked, of, hint }
        }
        other => other,
    }
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "rank", makes: &[Makes::Picture(Picture::Figure), Makes::Report] };

impl Answer for RankOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let answer = &self.answer;
        vec![
            Piece::Lines(answer.heading()),
            Piece::Break,
            Piece::Table(answer.table()),
            Piece::Break,
            Piece::Lines(answer.notes()),
            Piece::Break,
            Piece::Lines(answer.sentences().join("\n")),
            Piece::Break,
        ]
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn shortfall(&self) -> Option<String> {
        self.answer.shortfall()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        if let Some(svg) = self.svg.get() {
            return Some(Ok(svg.clone()));
        }
        Some(self.figure(self.figure_size).map(|svg| self.svg.get_or_init(|| svg).clone()))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::rank::of(self, self.asked))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
