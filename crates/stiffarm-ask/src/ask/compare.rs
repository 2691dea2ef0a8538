//! `stiffarm compare`: two setups side by side.

use crate::answer::words::{acting, class, mapped, tool};
use crate::answer::{CompareAnswer, PlaceAnswer, Rows, Unit, stiffness};
use crate::request::{Request, opt};
use serde_json::Value;
use stiffarm::model::ModelKind;
use stiffarm::robot::Robot;

use super::context::Context;
use super::outputs::place::PlaceOutput;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::compare::CompareFigure;
use crate::forms::{Answer, Forms, Makes, Picture, Piece};

pub(crate) fn answer(asked: &Request, context: Context) -> Result<CompareOutput, AskError> {
    let [a, b] = asked.setups()?.map(|name| setup(&name, asked, context));
    let (sides, figure_size) = ([a?, b?], FigureSize::of(asked)?);
    let [a, b] = sides.map(|(asked, robot)| PlaceOutput::of(&asked, robot, context));
    let sides = [a?, b?];
    let answer = CompareAnswer { sides: sides.each_ref().map(|side| side.answer.clone()) };
    Ok(CompareOutput { answer, sides, figure_size })
}

/// What is asked of a setup, and its robot.
fn setup(name: &str, asked: &Request, context: Context) -> Result<(Request, Robot), AskError> {
    let request = context.sources.setup(name, asked)?;
    // What is missing is an option of `compare`.
    if !request.is_given(opt::TASK) {
        asked.task()?;
    }
    request.check_complete()?;
    let robot = super::selection::robot(&request.robot()?, context)?;
    Ok((request, robot))
}

pub(crate) struct CompareOutput {
    answer: CompareAnswer,
    sides: [PlaceOutput; 2],
    figure_size: FigureSize,
}

impl CompareOutput {
    fn figure(&self) -> Result<String, AskError> {
        let [a, b] = self.sides.each_ref().map(PlaceOutput::mapped);
        let maps = [a?, b?];
        let drawn = |k: usize| {
            let mut drawn = self.sides[k].placed(&maps[k])?;
            if let Some(mark) = &mut drawn.mark {
                mark.label = "the zone at its best place".into();
            }
            drawn.subtitle = words(&self.sides[k].answer);
            let mut panel = drawn.figure();
            panel.title = format!("{}: {}", ["A", "B"][k], panel.title);
            Ok::<_, AskError>(panel)
        };
        let [a, b] = &self.answer.sides;
        let same_load = a.options.load == b.options.load;
        let drawn = CompareFigure {
            title: if a.robot.full_name() == b.robot.full_name() {
                format!("{}, two setups", a.robot.full_name())
            } else {
                format!("{} and {}", a.robot.full_name(), b.robot.full_name())
            },
            subtitle: self.answer.sentences().join(" "),
            panels: [drawn(0)?, drawn(1)?],
            colour_label: if same_load {
                format!("{} [mm]", mapped(a.options.load))
            } else {
                "deflection under the force of each [mm]".into()
            },
            figure_size: self.figure_size,
        };
        Ok(drawn.svg()?)
    }
}

/// What a panel shows.
fn words(side: &PlaceAnswer) -> String {
    let PlaceAnswer { robot, model, task, options, .. } = side;
    let held = match model {
        ModelKind::Planar => "planar model".to_owned(),
        ModelKind::Spatial(flange_from_tool) => format!("tool: {}", tool(flange_from_tool)),
    };
    let found = match side.best() {
        None => format!("no place for {}", task.label),
        Some(best) => {
            let verdict = side.verdict().map_or_else(String::new, |verdict| format!("; {}", verdict.in_words()));
            format!("{}: {:.3} mm at worst{verdict}", task.label, Unit::Millimetre.of_si(best.deflection))
        }
    };
    format!("{found}; {}; {held}; {}; {}", acting(options.load), class(robot), stiffness(robot))
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "compare", makes: &[Makes::Picture(Picture::Figure)] };

impl Answer for CompareOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let mut pieces = vec![Piece::Table(self.answer.table()), Piece::Break];
        let notes = self.answer.notes();
        if !notes.is_empty() {
            pieces.extend([Piece::Lines(notes), Piece::Break]);
        }
        pieces.extend([Piece::Lines(self.answer.sentences().join("\n")), Piece::Break]);
        pieces
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(self.figure())
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
