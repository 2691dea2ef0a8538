//! `stiffarm study`: architecture against link ratio and task size.

use crate::answer::{Rows, StudyAnswer};
use crate::request::{Request, opt};
use serde_json::Value;
use stiffarm::study::{StudyOptions, study, study_watched};

use super::context::Context;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::study::{self as figure_of, StudyCurve, StudyMark, StudyPanel};
use crate::forms::{Answer, Forms, Makes, Picture, Piece};

/// Ratios and sizes along the sides of a figure.
const FIGURE_RATIOS: usize = 61;
const FIGURE_SIZES: usize = 48;

pub(crate) fn answer(asked: &Request, context: Context) -> Result<StudyOutput, AskError> {
    let robot = asked.is_given(opt::ROBOT).then(|| super::selection::robot(&asked.robot()?, context)).transpose()?;
    let (options, figure_size) = (asked.study(robot.as_ref())?, FigureSize::of(asked)?);
    let found = context.watched("studying", |watch| study_watched(&options, watch))?;
    Ok(StudyOutput(StudyAnswer(found), figure_size))
}

pub(crate) struct StudyOutput(pub(crate) StudyAnswer, pub(crate) FigureSize);

impl StudyOutput {
    pub(crate) fn figure(&self) -> Result<String, AskError> {
        let options = &self.0.0.options;
        let panels: Result<Vec<StudyPanel>, AskError> = (0..options.tasks.len()).map(|task| self.panel(task)).collect();
        let title = "Link ratio and task size";
        Ok(figure_of::svg(title, &panels?, &self.1)?)
    }

    fn panel(&self, task: usize) -> Result<StudyPanel, AskError> {
        let options = &self.0.0.options;
        let shape = &options.tasks[task];
        let widest = shape.work.largest_size();
        let step = |i: usize, count: usize, low: f64, high: f64| low + (high - low) * i as f64 / (count - 1) as f64;
        let mus: Vec<f64> =
            (0..FIGURE_RATIOS).map(|i| step(i, FIGURE_RATIOS, options.range.min(), options.range.max())).collect();
        let sizes: Vec<f64> = (0..FIGURE_SIZES).map(|i| step(i, FIGURE_SIZES, 0.01, 1.0) * widest).collect();
        let fine = study(&StudyOptions {
            tasks: vec![shape.clone()],
            sizes: sizes.clone(),
            ratios: mus.clone(),
            mark: None,
            ..options.clone()
        })?;
        let coarse =
            study(&StudyOptions { tasks: vec![shape.clone()], sizes: sizes.clone(), mark: None, ..options.clone() })?;
        let rows = |contender: usize, best: bool| {
            fine.rows
                .iter()
                .filter(move |row| row.contender == contender && row.ratio.is_some_and(|r| r.is_best) == best)
        };
        let accuracy = [0, 1].map(|contender| {
            let mut cells = vec![None; mus.len() * sizes.len()];
            for row in rows(contender, false) {
                let column = row.ratio.and_then(|ratio| mus.iter().position(|&mu| mu == ratio.mu));
                let line = sizes.iter().position(|&size| size == row.size);
                if let (Some(i), Some(j)) = (column, line) {
                    cells[j * mus.len() + i] = row.accuracy;
                }
            }
            cells
        });
        let best =
            [0, 1].map(|contender| rows(contender, true).filter_map(|row| Some((row.size, row.ratio?.mu))).collect());
        let mut curves: Vec<StudyCurve> = Vec::new();
        for contender in [0, 1] {
            for mu in options.ratios.iter().copied().map(Some).chain([None]) {
                let points = coarse.rows.iter().filter(|row| {
                    let same = match mu {
                        Some(mu) => row.ratio.is_some_and(|ratio| !ratio.is_best && ratio.mu == mu),
                        None => row.ratio.is_some_and(|ratio| ratio.is_best),
                    };
                    row.contender == contender && same
                });
                let label = mu.map_or_else(|| "best ratio".into(), |mu| format!("μ = {mu}"));
                curves.push(StudyCurve {
                    label,
                    contender,
                    points: points.filter_map(|row| Some((row.size, row.accuracy?))).collect(),
                    is_best: mu.is_none(),
                });
            }
        }
        let boundaries =
            self.0.0.boundaries.iter().filter(|b| b.task == task && b.mu.is_none()).map(|b| b.size).collect();
        let mark = options.mark.as_ref().filter(|mark| mark.task == task).map(|mark| StudyMark {
            label: mark.robot.clone(),
            at: (mark.mu, mark.size),
            accuracy: self.0.0.marked,
        });
        let is_letter = !shape.label.contains(':');
        let shown = if is_letter { format!("({})", shape.work) } else { "(d: its first side, or its diameter)".into() };
        Ok(StudyPanel {
            mark,
            title: format!("Task {} {shown}", shape.label),
            contenders: [self.0.0.options.name(0), self.0.0.options.name(1)],
            mus,
            sizes,
            accuracy,
            best,
            curves,
            boundaries,
        })
    }
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "study", makes: &[Makes::Picture(Picture::Figure)] };

impl Answer for StudyOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![
            Piece::Lines(self.0.heading()),
            Piece::Break,
            Piece::Table(self.0.table()),
            Piece::Break,
            Piece::Lines(self.0.notes()),
        ]
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(self.figure())
    }

    fn figure_size(&self) -> FigureSize {
        self.1
    }
}
