//! Robots in order, and what draws them: curves over the size of a task, or bars.

use std::cell::OnceCell;

use stiffarm::drive::Architecture;
use stiffarm::model::ModelKind;
use stiffarm::place::PlaceOptions;
use stiffarm::rank::{Ranking, curves};
use stiffarm::robot::{Robot, Status};
use stiffarm::task::{Task, Zone};

use crate::answer::{self, RankAnswer, Unit, Verdict, stiffnesses, styles, words};
use crate::ask::context::Context;
use crate::ask::reports::Inputs;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::bars::{BarRow, BarsFigure};
use crate::figures::ranking::{self, Curve, Panel};
use crate::request::Request;

/// Sizes along each curve of the figure.
const CURVE_POINTS: usize = 40;
/// More curves than this cannot be distinguished.
const MOST_CURVES: usize = 24;
/// More bars are not distinguished on one page.
const MOST_BARS: usize = 60;

pub(crate) struct RankOutput<'a> {
    pub(crate) answer: RankAnswer,
    pub(crate) asked: &'a Request,
    pub(crate) context: Context<'a>,
    pub(crate) figure_size: FigureSize,
    pub(crate) svg: OnceCell<String>,
}

impl RankOutput<'_> {
    /// What it rests on that was read.
    pub(crate) fn inputs(&self) -> Inputs {
        Inputs::of(self.asked, self.context)
    }

    pub(crate) fn figure(&self, figure_size: FigureSize) -> Result<String, AskError> {
        match self.answer.ranking.model {
            ModelKind::Planar => self.curves(figure_size),
            ModelKind::Spatial(_) => Ok(self.bars(figure_size)),
        }
    }

    /// Deflection against task size, a curve per robot.
    fn curves(&self, figure_size: FigureSize) -> Result<String, AskError> {
        let RankAnswer { ranking: Ranking { tasks, rows, load, model, .. }, options, tolerance_mm, .. } = &self.answer;
        let robots: Vec<Robot> = rows.iter().take(MOST_CURVES).map(|row| row.robot.clone()).collect();
        let (shapes, styles) = (shapes(tasks), self.styles());
        let mut panels = Vec::new();
        for (shape, marks) in shapes {
            let largest = 1.01 * largest_scale(&robots, shape.work);
            let scales: Vec<f64> = (1..=CURVE_POINTS).map(|i| largest * i as f64 / CURVE_POINTS as f64).collect();
            let options = PlaceOptions { gap: Some(options.gap.unwrap_or(0.0).max(1e-3)), ..*options };
            let asked = (model, &options);
            let values =
                self.context.watched("drawing curves", |watch| curves(&robots, &shape, &scales, asked, watch))?;
            let curves = robots.iter().zip(&styles).zip(values).map(|((robot, style), curve)| Curve {
                robot: robot.name.clone(),
                serial: robot.architecture == Architecture::Serial,
                estimated: robot.status == Status::Estimated,
                robot_style: *style,
                points: curve
                    .points
                    .into_iter()
                    .map(|(scale, deflection)| (scale, Unit::Millimetre.of_si(deflection)))
                    .collect(),
                is_complete: curve.is_complete,
            });
            panels.push(Panel {
                title: shape.label.clone(),
                size_label: "d [m]".into(),
                curves: curves.collect(),
                marks,
                tolerance_mm: *tolerance_mm,
            });
        }
        let chosen = if rows.len() == robots.len() {
            String::new()
        } else {
            format!("; the first {MOST_CURVES} of {} robots", rows.len())
        };
        let newtons = words::loaded(*load);
        let springs = stiffnesses(rows.iter().map(|row| &row.robot));
        let title = format!("Worst deflection at the best place under {newtons}, planar model; {springs}{chosen}");
        Ok(ranking::svg(&title, &panels, &figure_size)?)
    }

    /// A bar per robot and task, with what is proved.
    fn bars(&self, figure_size: FigureSize) -> String {
        let RankAnswer { ranking: Ranking { tasks, rows, load, .. }, tolerance_mm, .. } = &self.answer;
        let left_out = rows.len().saturating_sub(MOST_BARS);
        let first = if left_out == 0 { String::new() } else { format!("; the first {MOST_BARS} of {}", rows.len()) };
        let mm = |metres: f64| Unit::Millimetre.of_si(metres);
        let drawn = rows.iter().zip(self.styles()).enumerate().take(MOST_BARS).map(|(at, (row, style))| BarRow {
            robot: words::marked(&row.robot),
            serial: row.robot.architecture == Architecture::Serial,
            estimated: row.robot.status == Status::Estimated,
            style,
            values: (0..tasks.len())
                .map(|task| row.placement(task).map(|best| [best.deflection, best.lower_bound].map(mm).into()))
                .collect(),
            intervals: (0..tasks.len())
                .map(|task| self.answer.spread(at, task).map(|spread| [spread.p05, spread.median, spread.p95].map(mm)))
                .collect(),
            verdicts: (0..tasks.len()).map(|task| self.answer.verdict(at, task).map(Verdict::in_words)).collect(),
            collides: (0..tasks.len()).map(|task| self.answer.collides(at, task)).collect(),
        });
        BarsFigure {
            title: format!("Worst deflection inside each flat zone at its best place, {}{first}", words::loaded(*load)),
            subtitle: format!(
                "{}; {}",
                stiffnesses(self.answer.ranking.rows.iter().map(|row| &row.robot)),
                self.answer.tool_orientation()
            ),
            tasks: tasks.iter().map(|task| task.label.clone()).collect(),
            rows: drawn.collect(),
            tolerance_mm: *tolerance_mm,
            figure_size,
        }
        .svg()
    }

    /// By row, the best first.
    fn styles(&self) -> Vec<Option<answer::RobotStyle>> {
        let robots = self.answer.ranking.rows.iter().map(|row| &row.robot);
        styles(&robots.map(|robot| (robot.name.as_str(), robot.architecture)).collect::<Vec<_>>())
    }
}

/// The distinct shapes among the tasks, at a first side of 1 m, with the first sides asked for.
pub(crate) fn shapes(tasks: &[Task]) -> Vec<(Task<Zone>, Vec<f64>)> {
    let mut shapes: Vec<(Task<Zone>, Vec<f64>)> = Vec::new();
    for zone in tasks.iter().filter_map(|task| task.work.zone()) {
        let [first, second] = zone.sides();
        let ratio = second / first;
        let (label, work) = match zone {
            Zone::Circle { .. } => ("Circle of diameter d".to_owned(), Zone::Circle { diameter: 1.0 }),
            Zone::Rectangle { .. } => {
                let times = format!("{ratio:.3}");
                let times = times.trim_end_matches('0').trim_end_matches('.');
                let long = if times == "1" { "d".to_owned() } else { format!("{times} d") };
                (format!("Rectangle of d x {long}"), Zone::Rectangle { width: 1.0, height: ratio })
            }
        };
        match shapes.iter_mut().find(|(shape, _)| shape.label == label) {
            Some((_, marks)) => marks.push(first),
            None => shapes.push((Task { label, work }, vec![first])),
        }
    }
    shapes
}

/// Beyond this scale no robot's links hold the zone.
fn largest_scale(robots: &[Robot], zone: Zone) -> f64 {
    robots
        .iter()
        .filter_map(|robot| robot.arm_plane().ok()) // others have no curve
        .map(|plane| stiffarm::place::largest_scale_without_limits(&plane.arm, zone))
        .fold(0.0, f64::max)
}
