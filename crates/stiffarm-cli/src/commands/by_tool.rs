//! A path that several tools mill, each with its own process, as text, table, JSON and one program.

use std::io::{self, Write};
use std::path::Path;

use stiffarm::catalogue::{ProcessFile, files};
use stiffarm::program::Language;
use stiffarm::toolpath::Understood;
use stiffarm::watch::Watch;
use stiffarm_ask::answer::{ByToolAnswer, Rows};
use stiffarm_ask::request::Request;

use super::mill::all_moves;
use super::{process_of, watched};
use crate::common::Common;
use crate::failure::Failure;
use crate::look::Look;
use crate::output::{Answer, pretty};
use crate::selection;
use crate::table::{prose, shown};

pub(crate) struct ByToolOutput {
    pub(super) answer: ByToolAnswer,
}

pub(super) fn answer(asked: &Request, common: &Common) -> Result<ByToolOutput, Failure> {
    let path = asked.path()?;
    let robot = selection::robot(&asked.robot()?, common)?;
    let processes = processes(asked, common)?;
    let (moves, understood) = all_moves(asked, &path, common, 1)?;
    let milled = |watch: Watch| ByToolAnswer::of(asked, &robot, (&path, &moves), &processes, watch);
    let mut answer = watched("milling with every tool", common, milled)?;
    answer.remarks.extend(understood.into_iter().flat_map(Understood::remarks));
    Ok(ByToolOutput { answer })
}

/// The process of each tool, with the name of its file.
fn processes(asked: &Request, common: &Common) -> Result<Vec<(u32, String, ProcessFile)>, Failure> {
    let of_tools = asked.processes().into_iter().filter_map(|(tool, file)| Some((tool?, file)));
    let read = |(tool, file): (u32, String)| {
        let named = files::shown(Path::new(&file));
        process_of(&file, &named, common).map(|read| (tool, named, read))
    };
    of_tools.map(read).collect()
}

impl Answer for ByToolOutput {
    const COMMAND: &'static str = "mill";
    const FURTHER: &'static [&'static str] = &["src", "mod", "ls"];

    fn program(&self, ending: &str) -> Option<Result<Vec<u8>, Failure>> {
        let language = Language::of_program(ending)?;
        Some(self.answer.program(language).map(String::into_bytes).map_err(Into::into))
    }

    fn text(&self, look: Look) -> String {
        let Self { answer } = self;
        let of_tool = |(tool, table)| format!("T{tool}\n{}\n", shown(&table, look));
        let sections = answer.sections.iter().map(|section| (section.tool, section.milled.table()));
        let told: String = sections.map(of_tool).collect();
        format!("{told}{}\n{}", shown(&answer.table(), look), prose(&answer.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }
}
