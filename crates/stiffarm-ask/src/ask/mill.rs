//! `stiffarm mill PATH`: the error along a toolpath; with `--dry` what is understood of it.

use crate::answer::mill::foreign;
use crate::answer::{Headline, MillAnswer, Rows};
use crate::request::Request;
use serde_json::Value;
use stiffarm::program::Language;
use stiffarm::toolpath::Understood;
use stiffarm::watch::Watch;

use super::context::Context;
use super::outputs::mill::{MillOutput, check_rewriting, rewritten, rolls};
use super::path::{all_moves, read_beside};
use super::reports;
use crate::error::AskError;
use crate::figures::milled::MilledFigure;
use crate::figures::shop::ShopFigure;
use crate::figures::view3d::View;
use crate::figures::{FigureSize, lobes};
use crate::forms::{Answer, Form, Forms, Makes, Picture, Piece};
use crate::report::Report;

pub(crate) fn answer<'a>(asked: &'a Request, context: Context<'a>) -> Result<MillOutput<'a>, AskError> {
    let path = asked.path()?;
    let robot = super::selection::robot(&asked.robot()?, context)?;
    let beside = read_beside(asked, context)?;
    let (moves, understood) = all_moves(asked, &path, context, 1)?;
    let milled = |watch: Watch| MillAnswer::of(asked, &robot, (path, moves), beside, watch);
    let mut answer = context.watched("milling", milled)?;
    answer.remarks.extend(understood.into_iter().flat_map(Understood::remarks));
    Ok(MillOutput { answer, asked, context, figure_size: FigureSize::of(asked)? })
}

/// That a form can be made of what is asked, as far as that is known before it is computed.
pub(crate) fn check_form(asked: &Request, form: Form) -> Result<(), AskError> {
    match form {
        Form::Svg(Picture::Lobes) | Form::Png(Picture::Lobes) | Form::Pdf(Picture::Lobes) if !asked.asks_chatter() => {
            Err(AskError::Figure("nothing to draw: lobes are computed with --chatter".into()))
        }
        Form::Program(ending) if Language::of_program(ending).is_none() => check_rewriting(asked, ending),
        _ => Ok(()),
    }
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms {
    command: "mill",
    makes: &[
        Makes::Picture(Picture::Figure),
        Makes::View,
        Makes::Programs(&["src", "mod", "ls", "py", "yaml", "nc", "gcode", "ngc", "tap", "apt", "cls"]),
        Makes::Report,
        Makes::Picture(Picture::Shop),
        Makes::Picture(Picture::Lobes),
    ],
};

impl Answer for MillOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn program(&self, ending: &str) -> Option<Result<Vec<u8>, AskError>> {
        let language = Language::of_program(ending);
        Some(match language {
            Some(language) => {
                if let Some(remark) = foreign(language, &self.answer.robot) {
                    self.context.listener.warn(&format!("warning: {remark}"));
                }
                self.answer.program(language).map(String::into_bytes).map_err(Into::into)
            }
            None => rewritten((self.asked, self.context), ending, |original, steps, output| {
                self.answer.rewritten(original, steps, output)
            }),
        })
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.answer.table()), Piece::Break, Piece::Lines(self.answer.notes())]
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
        let answer = &self.answer;
        Some(rolls(answer).map(|rolls| MilledFigure { answer, rolls: &rolls, figure_size: self.figure_size }.svg()))
    }

    fn view(&self) -> Option<Result<View, AskError>> {
        Some(self.in_space())
    }

    fn shop(&self) -> Option<Result<String, AskError>> {
        let nothing = || {
            AskError::Figure("nothing to draw: the path has no place, or nothing is known of the robot's base".into())
        };
        let drawn = |layout| ShopFigure { layout: &layout, figure_size: self.figure_size }.svg();
        Some(self.answer.layout().map(drawn).ok_or_else(nothing))
    }

    fn lobes(&self) -> Option<Result<String, AskError>> {
        let nothing = || {
            let why = match &self.answer.chatter {
                None => "nothing to draw: the path is not followed",
                Some(_) => "nothing to draw: no cut of the path is covered",
            };
            AskError::Figure(why.into())
        };
        let worst = self.answer.chatter.as_ref().and_then(|chatter| chatter.worst.as_ref());
        Some(worst.map(|(_, found)| lobes::svg(found, &self.figure_size)).ok_or_else(nothing))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::mill::of(self, self.asked))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
