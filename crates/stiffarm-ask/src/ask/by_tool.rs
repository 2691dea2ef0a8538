//! A path that several tools mill, each with its own process, as text, table, JSON and one program.

use std::path::Path;

use crate::answer::{ByToolAnswer, Headline, Rows, Table};
use crate::request::Request;
use serde_json::Value;
use stiffarm::catalogue::{ProcessFile, files};
use stiffarm::program::Language;
use stiffarm::toolpath::Understood;
use stiffarm::watch::Watch;

use super::context::Context;
use super::context::process_of;
use super::outputs::mill::rewritten;
use super::path::{all_moves, read_bodies};
use crate::error::AskError;
use crate::forms::{Answer, Forms, Makes, Piece};

pub(crate) struct ByToolOutput<'a> {
    answer: ByToolAnswer,
    asked: &'a Request,
    context: Context<'a>,
}

pub(crate) fn answer<'a>(asked: &'a Request, context: Context<'a>) -> Result<ByToolOutput<'a>, AskError> {
    let path = asked.path()?;
    let robot = super::selection::robot(&asked.robot()?, context)?;
    let (processes, bodies) = (processes(asked, context)?, read_bodies(asked, context)?);
    let (moves, understood) = all_moves(asked, &path, context, 1)?;
    let milled = |watch: Watch| ByToolAnswer::of(asked, &robot, (&path, &moves), (&processes, &bodies), watch);
    let mut answer = context.watched("milling with every tool", milled)?;
    answer.remarks.extend(understood.into_iter().flat_map(Understood::remarks));
    Ok(ByToolOutput { answer, asked, context })
}

/// The process of each tool, with the name of its file.
fn processes(asked: &Request, context: Context) -> Result<Vec<(u32, String, ProcessFile)>, AskError> {
    let of_tools = asked.processes().into_iter().filter_map(|(tool, file)| Some((tool?, file)));
    let read = |(tool, file): (u32, String)| {
        let named = files::shown(Path::new(&file));
        process_of(&file, &named, context).map(|read| (tool, named, read))
    };
    of_tools.map(read).collect()
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms {
    command: "mill",
    makes: &[Makes::Programs(&["src", "mod", "ls", "py", "nc", "gcode", "ngc", "tap", "apt", "cls"])],
};

impl Answer for ByToolOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn program(&self, ending: &str) -> Option<Result<Vec<u8>, AskError>> {
        Some(match Language::of_program(ending) {
            Some(language) => self.answer.program(language).map(String::into_bytes).map_err(Into::into),
            None => rewritten((self.asked, self.context), ending, |original, steps, output| {
                self.answer.rewritten(original, steps, output)
            }),
        })
    }

    fn text(&self) -> Vec<Piece> {
        let Self { answer, .. } = self;
        let of_tools = answer.sections.iter().flat_map(|section| {
            let heading = Piece::Lines(format!("T{}\n", section.tool));
            let table = Table { lead: None, ..section.milled.table() };
            [heading, Piece::Table(table), Piece::Break]
        });
        let all = [Piece::Table(answer.table()), Piece::Break, Piece::Lines(answer.notes())];
        of_tools.chain(all).collect()
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn shortfall(&self) -> Option<String> {
        self.answer.shortfall()
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }
}
