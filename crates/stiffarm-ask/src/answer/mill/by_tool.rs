//! A path that is milled with several tools: each section between two changes with its own process and length, and one program of all.

use std::io::Write;

use serde_json::{Value, json};

use super::super::uncertainty::Known;
use super::super::verdict::{self, Barred, Verdict};
use super::super::{
    Cell, Column, ColumnKind, Datum, Lead, Record, Rows, Table, field, fixed, shape, stiffness, with_schema,
};
use super::asked::Tooled;
use super::programs::{program_of, rewritten_of};
use super::record::compensated;
use super::table::NOT_FOLLOWED;
use super::{Beside, Bodies, Compensation, MillAnswer, MillAnswerError};
use crate::request::{Request, opt, tool_name};
use stiffarm::catalogue::ProcessFile;
use stiffarm::mill::WorkFrame;
use stiffarm::program::Language;
use stiffarm::robot::Robot;
use stiffarm::toolpath::{Move, MoveKind, Original, Rewritten, Steps};
use stiffarm::uncertainty::Spread;
use stiffarm::watch::Watch;

/// The answer of `mill` of a path with several tools.
#[derive(Clone, Debug)]
pub struct ByToolAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The path as it was asked for.
    pub path: String,
    /// What each tool does, in the order of the path; a tool that is put in again comes again.
    pub sections: Vec<Section>,
    /// The largest error that passes, mm.
    pub tolerance_mm: Option<f64>,
    /// What is to be said of the path.
    pub remarks: Vec<String>,
}

/// What one tool does between two changes.
#[derive(Clone, Debug)]
pub struct Section {
    /// Its number.
    pub tool: u32,
    /// Along the part of the path that it mills.
    pub milled: MillAnswer,
}

impl ByToolAnswer {
    /// What a request asks of a robot, a path and its moves, of a process (with the name of its file) for each tool, and of the meshes of part and fixture.
    ///
    /// # Errors
    /// A tool without process or length, one that never feeds, and as [`MillAnswer::of`].
    pub fn of(
        asked: &Request,
        robot: &Robot,
        (path, moves): (&str, &[Move]),
        (processes, bodies): (&[(u32, String, ProcessFile)], &Bodies),
        watch: Watch,
    ) -> Result<Self, MillAnswerError> {
        let is_touched = asked.work_frame() == WorkFrame::Touched;
        if robot.calibration.is_some() && is_touched {
            let why = "touched finds the work with one tool; expected measured beside processes by tool of a calibrated robot";
            return Err(asked.refused(opt::WORK_FRAME, why.into()).into());
        }
        let sections = sections(moves);
        let mills = |tool: u32| sections.iter().any(|(of, _)| *of == Some(tool));
        if let Some((tool, ..)) = processes.iter().find(|(tool, ..)| !mills(*tool)) {
            return Err(asked.refused(opt::PROCESS, format!("names T{tool}, which never feeds along the path")).into());
        }
        let parts = watch.parts(Some(sections.len()));
        let mut found = Vec::with_capacity(sections.len());
        for (tool, moves) in sections {
            let process = processes.iter().find(|(of, ..)| Some(*of) == tool);
            let Some((number, name, process)) = process else {
                let line = moves.first().map_or(0, |first| first.line);
                let why = format!("has no file for {}, from line {line}; expected one of each tool", tool_name(tool));
                return Err(asked.refused(opt::PROCESS, why).into());
            };
            let process = Some((name.clone(), process.clone()));
            let beside = Beside { process, bodies: bodies.clone(), measured: None };
            let tooled = Tooled { tool, beside };
            let milled = MillAnswer::with(asked, robot, (path.to_owned(), moves.into()), tooled, watch.of_part())?;
            parts.one_more().map_err(|stopped| MillAnswerError::Mill {
                robot: robot.name.clone(),
                path: path.to_owned(),
                error: stopped.into(),
            })?;
            found.push(Section { tool: *number, milled });
        }
        let robot = found.first().map_or_else(|| robot.clone(), |first| first.milled.robot.clone());
        let (path, tolerance_mm) = (path.to_owned(), asked.tolerance_mm());
        Ok(Self { robot, path, sections: found, tolerance_mm, remarks: Vec::new() })
    }

    /// The section with the largest error, and that, m; `None` where some section is not followed.
    pub fn worst(&self) -> Option<(&Section, f64)> {
        let errors = self.sections.iter().map(|section| Some((section, section.milled.followed()?.worst.0)));
        let errors = errors.collect::<Option<Vec<_>>>()?;
        errors.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether the tolerance is kept by every tool; `None` where there is none, or the path is not followed.
    pub fn verdict(&self) -> Option<Verdict> {
        let (tolerance, (_, worst)) = self.tolerance_mm.zip(self.worst())?;
        let known = self.largest_drawn(|milled| milled.draws.as_ref()).map(|draws| Known::of(draws, Some(tolerance)));
        let verdict = Verdict::of(worst, tolerance).with(known.and_then(|known| known.holds));
        Some(self.as_of_each(verdict, MillAnswer::verdict))
    }

    /// The same of what compensation leaves, the median of the draws as the nominal value.
    pub(in crate::answer) fn compensated_verdict(&self) -> Option<Verdict> {
        let (tolerance, left) = self.tolerance_mm.zip(self.drawn_left())?;
        let known = Known::of(left, Some(tolerance));
        let verdict = Verdict::of(known.spread.median, tolerance).with(known.holds);
        Some(self.as_of_each(verdict, MillAnswer::compensated_verdict))
    }

    /// What limits the verdict on one tool limits that on all.
    fn as_of_each(&self, verdict: Verdict, of: fn(&MillAnswer) -> Option<Verdict>) -> Verdict {
        let each = || self.sections.iter().filter_map(|section| of(&section.milled));
        Verdict {
            is_of_drives_alone: each().any(|verdict| verdict.is_of_drives_alone),
            barred: self.barred(),
            ..verdict
        }
    }

    /// The largest of all tools in every draw: the drives of a draw are the same for all.
    fn largest_drawn(&self, of: impl Fn(&MillAnswer) -> Option<&Vec<f64>>) -> Option<Vec<f64>> {
        let all = self.sections.iter().map(|section| of(&section.milled).cloned());
        all.reduce(|all, one| Some(all?.into_iter().zip(one?).map(|(all, one)| all.max(one)).collect())).flatten()
    }

    /// What compensation leaves of the largest error of all tools, m, in every draw.
    fn drawn_left(&self) -> Option<Vec<f64>> {
        self.largest_drawn(|milled| Some(&milled.compensation.as_ref()?.remaining.as_ref()?.0.all))
    }

    /// What compensation makes of the path, where all of it is compensated.
    fn compensation(&self) -> Option<Record> {
        let all: Option<Vec<&Compensation>> =
            self.sections.iter().map(|section| section.milled.compensation.as_ref()).collect();
        let all = all.filter(|all| !all.is_empty())?;
        Some(compensated(all.into_iter(), self.drawn_left().map(Spread::of), self.compensated_verdict()))
    }

    /// Why there is no answer, where there is none: of the first tool that does not follow its part of the path.
    pub fn reason(&self) -> Option<String> {
        self.sections.iter().find_map(|section| Some(format!("T{}: {}", section.tool, section.milled.reason()?)))
    }

    /// Why the answer is no, where it is.
    pub fn shortfall(&self) -> Option<String> {
        let of = |section: &Section| Some(format!("T{}, {}", section.tool, section.milled.shortfall()?));
        let together = || {
            let (tolerance, verdict) = self.tolerance_mm.zip(self.compensated_verdict())?;
            let left = fixed(tolerance - verdict.margin_mm, 4);
            (!verdict.passes)
                .then(|| format!("{left} mm left after compensation, of all tools; tolerance {tolerance} mm"))
        };
        self.sections.iter().find_map(of).or_else(together)
    }

    /// Every field but those of single samples.
    pub fn record(&self) -> Record {
        let worst = self.worst();
        let line = worst.and_then(|(section, _)| {
            let milled = &section.milled;
            Some(milled.stations[milled.followed()?.worst.1].sample.line)
        });
        let mut record = Record::of(&shape::MILLED_BY_TOOL);
        record
            .put(field::ROBOT, &self.robot.name)
            .put(field::STIFFNESS_SOURCE, self.robot.stiffness_source().name())
            .put(field::PATH, &self.path)
            .put(field::FEASIBLE, worst.is_some())
            .put(field::REASON, self.reason())
            .put(field::PATH_WORST, worst.map(|(_, error)| error))
            .put(field::WORST_TOOL, worst.map(|(section, _)| section.tool as usize))
            .put(field::WORST_LINE, line);
        verdict::put(&mut record, self.tolerance_mm, self.verdict(), false);
        record
            .put(field::PATH_COMPENSATION, self.compensation())
            .put(field::BY_TOOL, self.sections.iter().map(Section::record).collect::<Datum>())
            .put(field::REMARKS, json!(self.remarks));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("mill", super::super::ORIGIN, &self.record())
    }

    /// One row per sample, with the number of its tool.
    pub fn rows(&self) -> Rows<'_> {
        let mut columns = vec![Column::new("tool_number", ColumnKind::Count)];
        // Those of compensation are there where it is.
        let of_section = self.sections.iter().map(|section| section.milled.rows().columns().to_vec());
        columns.extend(of_section.max_by_key(Vec::len).unwrap_or_default());
        let of_section = |Section { tool, milled }: &Section| {
            let number = [Cell::Count(i64::from(*tool))];
            milled.rows().iter().map(|row| [&number[..], &row].concat()).collect::<Vec<_>>()
        };
        Rows::new(columns, self.sections.iter().flat_map(of_section).collect())
    }

    /// What each tool does, a row each.
    pub fn table(&self) -> Table {
        let mut headings = vec!["tool", "from line", "process", "tip in the flange [mm]", "largest error [mm]", "line"];
        headings.extend(self.tolerance_mm.map(|_| "verdict"));
        let with_compensation = self.tolerance_mm.filter(|_| self.drawn_left().is_some());
        headings.extend(with_compensation.map(|_| "verdict, compensated"));
        let mut table = Table::new(headings);
        let line = |milled: &MillAnswer, at: usize| milled.stations.get(at).map_or(0, |station| station.sample.line);
        for Section { tool, milled } in &self.sections {
            let tip = milled.flange_from_tool.translation.vector;
            let mut cells = vec![
                format!("T{tool}"),
                line(milled, 0).to_string(),
                milled.force.clone(),
                tip.iter().map(|part| fixed(part * 1e3, 1)).collect::<Vec<_>>().join(", "),
            ];
            cells.extend(milled.followed().map_or_else(
                || ["not followed".into(), "-".into()],
                |found| [fixed(found.worst.0 * 1e3, 4), line(milled, found.worst.1).to_string()],
            ));
            let in_words = |verdict: Option<Verdict>| verdict.map_or_else(|| "-".into(), Verdict::in_words);
            cells.extend(self.tolerance_mm.map(|_| in_words(milled.verdict())));
            cells.extend(with_compensation.map(|_| in_words(milled.compensated_verdict())));
            table.row(cells);
        }
        Table { lead: Some(self.lead()), ..table }
    }

    /// What decides of all tools together: no section does alone.
    fn lead(&self) -> Lead {
        let (value, means) = match self.worst() {
            Some((section, error)) => (
                format!("{} mm, by T{}", fixed(error * 1e3, 4), section.tool),
                "largest error of the tools along the path",
            ),
            None => (self.reason().unwrap_or_default(), NOT_FOLLOWED),
        };
        Lead { value, means: means.into(), rests_on: stiffness(&self.robot), rows: Vec::new() }
    }

    /// What stands below the tables.
    pub fn notes(&self) -> String {
        let mut notes = self.reason().map_or_else(String::new, |reason| format!("not followed: {reason}\n"));
        for (verdict, what) in [(self.verdict(), ""), (self.compensated_verdict(), ", compensated")] {
            let judged = self.tolerance_mm.zip(verdict);
            notes.extend(judged.map(|(tolerance, verdict)| {
                format!("tolerance {tolerance} mm, all tools{what}: {}\n", verdict.in_words())
            }));
        }
        notes.extend(self.remarks.iter().map(|remark| format!("note: {remark}\n")));
        let of_each = self.of_each(|milled| milled.notes().lines().map(str::to_owned).collect());
        of_each.into_iter().fold(notes, |notes, line| notes + &line + "\n")
    }

    /// What is said of every tool, each once; what is not of all of them under the number of its tool.
    pub(in crate::answer) fn of_each(&self, says: impl Fn(&MillAnswer) -> Vec<String>) -> Vec<String> {
        let all: Vec<Vec<String>> = self.sections.iter().map(|section| says(&section.milled)).collect();
        let mut told: Vec<String> = Vec::new();
        for (section, own) in self.sections.iter().zip(&all) {
            for line in own {
                let is_of_all = all.iter().all(|others| others.contains(line));
                let line = if is_of_all { line.clone() } else { format!("T{}: {line}", section.tool) };
                if !told.contains(&line) {
                    told.push(line);
                }
            }
        }
        told
    }

    /// Why the answer is no, whatever the error, of the first tool of which it is.
    pub(in crate::answer) fn barred(&self) -> Option<Barred> {
        self.sections.iter().find_map(|section| section.milled.barred())
    }

    /// A controller's program of all tools, which stops where one is changed.
    ///
    /// # Errors
    /// As [`MillAnswer::program`].
    pub fn program(&self, language: Language) -> Result<String, MillAnswerError> {
        program_of(&self.numbered(), language)
    }

    /// Writes the path's own file with the tips of every tool led aside; what was not touched stays as it is.
    ///
    /// # Errors
    /// As [`MillAnswer::rewritten`].
    pub fn rewritten(
        &self,
        original: Original,
        steps: &Steps,
        output: &mut dyn Write,
    ) -> Result<Rewritten, MillAnswerError> {
        rewritten_of(&self.numbered(), original, steps, output)
    }

    /// What each tool mills, with its number.
    fn numbered(&self) -> Vec<(Option<u32>, &MillAnswer)> {
        self.sections.iter().map(|section| (Some(section.tool), &section.milled)).collect()
    }
}

impl Section {
    fn record(&self) -> Record {
        let mut record = Record::of(&shape::MILLED_WITH_TOOL);
        record
            .put(field::TOOL_NUMBER, self.tool as usize)
            .put(field::TOOL, super::super::words::tool_mm(&self.milled.flange_from_tool));
        record.extend(self.milled.record());
        record
    }
}

/// The moves between two changes of the tool, where it feeds, with the number of that.
fn sections(moves: &[Move]) -> Vec<(Option<u32>, Vec<Move>)> {
    let mut found: Vec<(Option<u32>, Vec<Move>)> = Vec::new();
    for one in moves {
        let tool = one.given.tool;
        match found.last_mut() {
            Some((before, section)) if *before == tool => section.push(*one),
            // From where a tool comes that was just put in is not in the file.
            Some(_) if one.kind == MoveKind::Rapid => found.push((tool, Vec::new())),
            _ => found.push((tool, vec![*one])),
        }
    }
    found.retain(|(_, section)| section.iter().any(|one| one.kind == MoveKind::Feed));
    found
}
