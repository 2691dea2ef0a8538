//! Do the cuts of a path swing?

use std::collections::BTreeSet;

use serde_json::json;
use stiffarm::catalogue::ProcessFile;
use stiffarm::chatter::{Chatter, Edge, LONGEST, Verdict};
use stiffarm::mill::{
    AllAlong, DeepestRoll, Judged, MillError, MillHeld, MillOptions, PathChatter, Pushed, Stand, Station, Uncovered,
    chatter_along, check_chatter,
};
use stiffarm::modes::HeldTool;
use stiffarm::robot::Robot;
use stiffarm::watch::Watch;

use super::super::chatter::ChatterAnswer;
use super::super::tip::{TipFile, besides};
use super::super::{Cell, Column, ColumnKind, Datum, Line, Record, Table, field, fixed, line, shape};
use super::{MillAnswer, MillAnswerError};
use crate::request::{Request, tool_name};

/// Lines of the file that are named in a table.
const MOST_LINES: usize = 8;

/// What is asked of the cuts of a path.
pub(super) struct AskedChatter {
    held: MillHeld,
    file: String,
    process: ProcessFile,
    measured: Option<TipFile>,
}

/// Whether the cuts of a path swing.
#[derive(Clone, Debug)]
pub struct PathChatterAnswer {
    /// At every station.
    pub samples: Vec<Judged>,
    /// Where the critical depth is least in proportion to that of the cut, with all that is known of it; `None` where no sample is covered.
    pub worst: Option<(usize, Box<ChatterAnswer>)>,
    /// The roll with which the cut of that sample would go deepest.
    pub deepest: Option<DeepestRoll>,
}

impl AskedChatter {
    /// Of a request, its robot, and the process of its tool with the name of its file; `None` where it is not asked.
    ///
    /// # Errors
    /// A robot or a process of which it cannot be computed.
    pub(super) fn of(
        asked: &Request,
        robot: &Robot,
        (tool, process): (Option<u32>, Option<&(String, ProcessFile)>),
        measured: Option<TipFile>,
    ) -> Result<Option<Self>, MillAnswerError> {
        let held = asked.path_chatter(measured.as_ref().map(|measured| &measured.tip))?;
        let Some((held, (file, process))) = held.zip(process.cloned()) else { return Ok(None) };
        check_chatter(robot, &process.process).map_err(|error| {
            let of_tool = if asked.mills_by_tool() { format!("{}, ", tool_name(tool)) } else { String::new() };
            MillAnswerError::Chatter { process: format!("{of_tool}{file}"), error }
        })?;
        Ok(Some(Self { held, file, process, measured }))
    }

    /// Along a path that is followed.
    pub(super) fn looked_at(
        self,
        robot: &Robot,
        stand: &Stand,
        path: (&[Station], &[Pushed]),
        options: &MillOptions,
        watch: Watch,
    ) -> Result<PathChatterAnswer, MillError> {
        let Self { held, file, process, measured } = self;
        let PathChatter { samples, worst, deepest } =
            chatter_along(robot, stand, path, (&process.process, &held, options), watch)?;
        let of_worst = |(i, chatter): (usize, Chatter)| {
            let joints_deg = path.1[i].joints.map(f64::to_degrees);
            let tool = HeldTool { flange_from_tool: stand.flange_from_tool, body: held.body };
            (i, Box::new(ChatterAnswer { robot: robot.clone(), joints_deg, tool, file, process, measured, chatter }))
        };
        Ok(PathChatterAnswer { samples, worst: worst.map(of_worst), deepest })
    }
}

impl PathChatterAnswer {
    /// What every sample has of it.
    pub(super) fn columns() -> [Column; 3] {
        let [depth, hertz] = [field::CRITICAL_DEPTH, field::CHATTER_FREQUENCY].map(|field| field.key);
        [
            Column::new(depth, ColumnKind::Number),
            Column::new(hertz, ColumnKind::Number),
            Column::new("chatter_covered", ColumnKind::Truth),
        ]
    }

    /// Of one sample: a depth is absent where it is beyond the longest edge, and where nothing is known; the last cell says which.
    pub(super) fn cells(&self, sample: usize) -> [Cell; 3] {
        match self.samples[sample] {
            Judged::Rapid => [Cell::Absent, Cell::Absent, Cell::Absent],
            Judged::Uncovered(_) => [Cell::Absent, Cell::Absent, Cell::Truth(false)],
            Judged::Cut { critical, .. } => {
                let number = |x: Option<f64>| x.map_or(Cell::Absent, Cell::Number);
                let depth = critical.edge.map(|edge| edge.depth * 1e3);
                [number(depth), number(critical.edge.map(|edge| edge.frequency)), Cell::Truth(true)]
            }
        }
    }

    fn covered(&self) -> usize {
        self.samples.iter().filter(|judged| matches!(judged, Judged::Cut { .. })).count()
    }

    /// Samples at which the mean over a revolution misleads.
    fn misled(&self) -> usize {
        self.samples.iter().filter(|judged| matches!(judged, Judged::Cut { critical, .. } if critical.misleads)).count()
    }
}

impl MillAnswer {
    /// What is not covered: why, at how many samples, and on which lines.
    fn uncovered(&self) -> Vec<(Uncovered, usize, BTreeSet<usize>)> {
        let Some(chatter) = &self.chatter else { return Vec::new() };
        let of = |why: Uncovered| {
            let there = || {
                let samples = self.stations.iter().zip(&chatter.samples);
                samples.filter(move |(_, judged)| **judged == Judged::Uncovered(why)).map(|(station, _)| station)
            };
            (why, there().count(), there().map(|station| station.sample.line).filter(|line| 0 < *line).collect())
        };
        Uncovered::ALL.into_iter().map(of).filter(|(_, count, _)| 0 < *count).collect()
    }

    /// Where a sample is, in words.
    fn at_sample(&self, sample: usize) -> String {
        let at = &self.stations[sample].sample;
        if at.line == 0 { format!("{} mm of the way", fixed(at.way * 1e3, 1)) } else { format!("line {}", at.line) }
    }

    /// In words; never that a cut is stable.
    pub fn chatter_verdict(&self) -> Option<String> {
        let chatter = self.chatter.as_ref()?;
        let of_robot = match &chatter.worst {
            None => "not covered: no cut of which anything is known".to_owned(),
            Some((worst, found)) => format!("{} at the worst sample, {}", found.of_robot(), self.at_sample(*worst)),
        };
        let uncovered: usize = self.uncovered().iter().map(|(_, count, _)| count).sum();
        let uncovered = if 0 < uncovered { format!("; {uncovered} samples are not covered") } else { String::new() };
        let measured = chatter.worst.as_ref().and_then(|(_, found)| found.chatter.measured.as_ref());
        Some(format!("{of_robot}{uncovered}; {}", besides(measured)))
    }

    /// Whether the cuts swing was asked, and is not decided.
    pub(super) fn chatter_is_open(&self) -> bool {
        let worst = self.chatter.as_ref().and_then(|chatter| chatter.worst.as_ref());
        worst.is_some_and(|(_, found)| found.chatter.verdict() == Verdict::NotDecided)
    }

    /// Why the cuts are no answer, where they are asked and surely swing.
    pub(super) fn chatter_shortfall(&self) -> Option<String> {
        let (worst, found) = self.chatter.as_ref()?.worst.as_ref()?;
        let Verdict::Limits(depth) = found.chatter.verdict() else { return None };
        let [cut, depth] = [found.chatter.cut.milling.engagement.depth(), depth].map(|depth| fixed(depth * 1e3, 3));
        Some(format!("a cut of {cut} mm, {}, swings from {depth} mm", self.at_sample(*worst)))
    }

    /// As fields.
    pub(super) fn chatter_record(&self) -> Option<Record> {
        let chatter = self.chatter.as_ref()?;
        let uncovered = |(why, count, lines): (Uncovered, usize, BTreeSet<usize>)| {
            let mut record = Record::of(&shape::UNCOVERED_SAMPLES);
            record
                .put(field::UNCOVERED_WHY, why.name())
                .put(field::SAMPLES_OF_PATH, count)
                .put(field::UNCOVERED_LINES, json!(lines));
            record
        };
        let (worst, found) = chatter.worst.as_ref().map(|(worst, found)| (*worst, found.as_ref())).unzip();
        let mut record = Record::of(&shape::PATH_CHATTER);
        record
            .put(field::PATH_CHATTER_VERDICT, self.chatter_verdict())
            .put(field::COVERED, chatter.covered())
            .put(field::NOT_COVERED, self.uncovered().into_iter().map(uncovered).collect::<Datum>())
            .put(field::MEAN_MISLEADS, chatter.misled())
            .put(field::CHATTER_SAMPLE, worst)
            .put(field::CHATTER_LINE, worst.map(|worst| self.stations[worst].sample.line))
            .put(field::JOINTS, found.map(|found| found.joints_deg))
            .put(field::FEED_DIRECTION, found.map(ChatterAnswer::feed));
        ChatterAnswer::put_cut(found, &mut record);
        let deepest = chatter.deepest.as_ref();
        let all_along = deepest.and_then(|deepest| deepest.all_along);
        record
            .put(field::DEEPEST_ROLL, deepest.map(|deepest| deepest.roll))
            .put(field::DEEPEST_DEPTH, deepest.and_then(|deepest| deepest.edge).map(|edge| edge.depth))
            .put(field::DEEPEST_ERROR, deepest.map(|deepest| deepest.error))
            .put(field::ROLLED_RESERVE, all_along.map(|all| all.reserve).filter(|reserve| reserve.is_finite()))
            .put(field::ROLLED_LINE, all_along.map(|all| self.stations[all.sample].sample.line))
            .put(field::ROLLED_ERROR, all_along.map(|all| all.error));
        Some(record)
    }

    /// As people read it.
    pub(super) fn chatter_lines(&self) -> Vec<Line> {
        let (Some(chatter), Some(verdict)) = (&self.chatter, self.chatter_verdict()) else { return Vec::new() };
        let mut lines = vec![line("chatter", verdict)];
        lines.extend(chatter.worst.iter().flat_map(|(_, found)| found.lines()));
        lines.extend(self.deepest_line());
        lines.extend(self.uncovered().into_iter().map(|(why, count, at)| {
            let named: Vec<String> = at.iter().take(MOST_LINES).map(ToString::to_string).collect();
            let more =
                if MOST_LINES < at.len() { format!(" and {} more", at.len() - MOST_LINES) } else { String::new() };
            let on = if at.is_empty() { String::new() } else { format!(", line {}{more}", named.join(", ")) };
            line("chatter not covered", format!("{}: {count} samples{on}", why.name()))
        }));
        if 0 < chatter.misled() {
            let text = format!(
                "at {} samples, where teeth cut shortly and pass slowly; only the worst by the mean is counted tooth by tooth",
                chatter.misled()
            );
            lines.push(line("mean over a revolution misleads", text));
        }
        lines
    }

    /// What another roll would do at the worst sample, and all along.
    fn deepest_line(&self) -> Option<Line> {
        let chatter = self.chatter.as_ref()?;
        let (deepest, (worst, _)) = chatter.deepest.as_ref().zip(chatter.worst.as_ref())?;
        let (found, Judged::Cut { critical, .. }) = (self.followed()?, &chatter.samples[*worst]) else { return None };
        let depth = |edge: Option<Edge>| edge.map_or(f64::INFINITY, |edge| edge.depth);
        if depth(deepest.edge) <= depth(critical.edge) {
            return Some(line("rolled otherwise", "no other roll lets that cut go deeper"));
        }
        let mm = |edge: Option<Edge>| {
            edge.map_or_else(|| format!("more than {}", fixed(LONGEST * 1e3, 0)), |edge| fixed(edge.depth * 1e3, 4))
        };
        let roll = fixed(deepest.roll.to_degrees(), 0);
        let [error, before] = [deepest.error, found.samples[*worst].error].map(|error| fixed(error * 1e3, 4));
        let whole = match deepest.all_along {
            None if self.stations.iter().any(|station| station.pinned.is_some()) => {
                "pins hold the rolls of the path".into()
            }
            None => "the whole path is not followed so".to_owned(),
            Some(AllAlong { sample, reserve, error }) => format!(
                "the whole path so (--roll={roll}): reserve {} at {}, largest error {} mm instead of {}",
                if reserve.is_finite() { fixed(reserve, 3) } else { "without end".into() },
                self.at_sample(sample),
                fixed(error * 1e3, 4),
                fixed(found.worst.0 * 1e3, 4)
            ),
        };
        let says = format!(
            "by {roll} deg that cut swings from {} mm instead of {} (by the mean of the teeth), its error is {error} mm instead of {before}; {whole}",
            mm(deepest.edge),
            mm(critical.edge)
        );
        Some(line("rolled otherwise", says))
    }

    /// The same as a table.
    pub fn chatter_table(&self) -> Table {
        Table::of_lines(self.chatter_lines())
    }

    /// What it rests on, a line each.
    pub(super) fn chatter_basis(&self) -> String {
        let worst = self.chatter.as_ref().and_then(|chatter| chatter.worst.as_ref());
        worst.map_or_else(String::new, |(_, found)| {
            let lines = found.basis().into_iter().map(|sentence| format!("chatter: {sentence}\n"));
            lines.collect()
        })
    }
}
