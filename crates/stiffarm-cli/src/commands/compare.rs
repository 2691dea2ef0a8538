//! `stiffarm compare`: two setups side by side.

use std::io::{self, Write};

use stiffarm::model::ModelKind;
use stiffarm::robot::Robot;
use stiffarm_ask::answer::words::{acting, class, mapped, tool};
use stiffarm_ask::answer::{CompareAnswer, PlaceAnswer, Rows, Unit, stiffness};
use stiffarm_ask::request::Request;

use super::place::PlaceOutput;
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::Plate;
use crate::figures::compare::CompareFigure;
use crate::look::Look;
use crate::output::{Answer, Outputs, figure, pretty};
use crate::selection;
use crate::table::{prose, shown};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<CompareOutput>(common)?;
    outputs.deliver(&answer(asked, common)?)
}

pub(super) fn answer(asked: &Request, common: &Common) -> Result<CompareOutput, Failure> {
    let [a, b] = asked.setups()?.map(|name| setup(&name, asked, common));
    let (sides, plate) = ([a?, b?], Plate::of(asked)?);
    let [a, b] = sides.map(|(asked, robot)| PlaceOutput::of(&asked, robot, common));
    let sides = [a?, b?];
    let answer = CompareAnswer { sides: sides.each_ref().map(|side| side.answer.clone()) };
    Ok(CompareOutput { answer, sides, plate })
}

/// What is asked of a setup, and its robot.
fn setup(name: &str, asked: &Request, common: &Common) -> Result<(Request, Robot), Failure> {
    let request = common.shelf.setup(name, asked)?;
    request.check_complete()?;
    let robot = selection::robot(&request.robot()?, common)?;
    Ok((request, robot))
}

pub(super) struct CompareOutput {
    answer: CompareAnswer,
    sides: [PlaceOutput; 2],
    plate: Plate,
}

impl CompareOutput {
    fn figure(&self) -> Result<String, Failure> {
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
            Ok::<_, Failure>(panel)
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
            plate: self.plate,
        };
        drawn.svg().map_err(figure)
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
            let verdict = side.verdict().map_or_else(String::new, |verdict| format!("; {}", verdict.told()));
            format!("{}: {:.3} mm at worst{verdict}", task.label, Unit::Millimetre.told(best.deflection))
        }
    };
    format!("{found}; {}; {held}; {}; {}", acting(options.load), class(robot), stiffness(robot))
}

impl Answer for CompareOutput {
    const COMMAND: &'static str = "compare";
    const FURTHER: &'static [&'static str] = &["svg", "png", "pdf"];

    fn text(&self, look: Look) -> String {
        let notes = self.answer.notes();
        let apart = if notes.is_empty() { "" } else { "\n" };
        format!(
            "{}\n{}{apart}{}\n",
            shown(&self.answer.table(), look),
            prose(&notes, look),
            prose(&self.answer.sentences().join("\n"), look)
        )
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(self.figure())
    }

    fn plate(&self) -> Plate {
        self.plate
    }
}
