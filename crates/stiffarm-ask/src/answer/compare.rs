//! How are two setups reported side by side?

use std::cmp::Ordering;

use serde_json::{Value, json};

use super::uncertainty::share_of_draws;
use super::verdict::SURE;
use super::words::{self, degrees, fixed};
use super::{ORIGIN, PlaceAnswer, Record, Rows, Table, advice, field, margins, shape, stiffness, with_schema};
use stiffarm::load::Component;
use stiffarm::model::ModelKind;
use stiffarm::place::{PlaceOptions, Placed, Placement};
use stiffarm::rank::may_be_as_good;
use stiffarm::robot::Status;
use stiffarm::uncertainty::{DRAWS, drawn};

/// What the two are called, in JSON and where there is little room.
pub const NAMES: [&str; 2] = ["a", "b"];

/// With another force, or of another work, two answers are compared and not two robots.
const ASKED: [&str; 3] = ["force", "component", "task"];

/// The answer of `compare`: a placement of each of two setups.
#[derive(Clone, Debug)]
pub struct CompareAnswer {
    /// The first and the second.
    pub sides: [PlaceAnswer; 2],
}

/// A row of the table: what it says of a setup, where that has it.
type Says = fn(&PlaceAnswer) -> Option<String>;

const LINES: [(&str, Says); 23] = [
    ("robot", |side| Some(side.robot.full_name())),
    ("architecture", |side| Some(words::architecture(&side.robot))),
    ("status", |side| Some(words::status(&side.robot).into())),
    ("stiffness", |side| Some(stiffness(&side.robot))),
    ("model", |side| Some(side.model.name().into())),
    ("tool", |side| if let ModelKind::Spatial(tool) = &side.model { Some(words::tool(tool)) } else { None }),
    ("force", |side| Some(words::acting(side.options.load))),
    ("task", |side| Some(format!("{} ({})", side.task.label, side.task.work.describe()))),
    ("allowed place", |side| Some(side.allowed())),
    ("margins", |side| Some(margins::angles(&side.options.margins))),
    (
        "no place",
        |side| if let Placed::Infeasible { reason, .. } = &side.placed { Some(reason.to_string()) } else { None },
    ),
    ("worst deflection [mm]", |side| side.best().map(|best| fixed(best.deflection * 1e3, 4))),
    ("proved lower bound [mm]", |side| side.best().map(|best| fixed(best.lower_bound * 1e3, 4))),
    ("centre in the cell x, y, z [m]", |side| {
        let (best, cell) = side.best().zip(side.options.cell.as_ref())?;
        Some(best.in_cell(cell).map(|metres| fixed(metres, 4)).join(", "))
    }),
    ("centre from the base x, z [m]", |side| {
        side.best().map(|best| best.centre.map(|metres| fixed(metres, 4)).join(", "))
    }),
    ("angle of the first side", |side| side.best().map(|best| degrees(best.angle))),
    ("configuration", |side| {
        let best = side.best()?;
        Some(best.space().map_or_else(|| format!("elbow {}", best.elbow.name()), |hold| hold.configuration.to_string()))
    }),
    ("smallest margin", |side| {
        let (least, of) = side.best()?.smallest_margin()?;
        Some(format!("{} ({})", degrees(least), margins::of(of)))
    }),
    ("clearance", |side| {
        let clearance = side.clearance()?;
        let loud = words::collision(&clearance).map_or_else(String::new, |loud| format!("{loud}: "));
        Some(format!("{loud}{} mm, {}", fixed(clearance.distance * 1e3, 0), words::clearance_between(&clearance)))
    }),
    ("payload", |side| said_of_load(side, "payload")),
    ("wrist", |side| said_of_load(side, "wrist")),
    ("tolerance", |side| side.tolerance_mm.map(|tolerance| format!("{tolerance} mm"))),
    ("verdict", |side| {
        let verdict = side.verdict()?;
        Some(format!("{}, margin {} mm", verdict.in_words(), fixed(verdict.margin_mm, 4)))
    }),
];

/// What is told of the load under a name.
fn said_of_load(side: &PlaceAnswer, name: &str) -> Option<String> {
    side.carried().lines().find(|line| line[0] == name).map(|[_, says]| says)
}

impl CompareAnswer {
    fn best(&self) -> [Option<&Placement>; 2] {
        self.sides.each_ref().map(PlaceAnswer::best)
    }

    /// The deflection of the second over that of the first; `None` where one has no place, or the first does not give way.
    pub fn ratio(&self) -> Option<f64> {
        let [a, b] = self.best();
        let (a, b) = (a?.deflection, b?.deflection);
        (0.0 < a).then_some(b / a)
    }

    /// Which is better, at the nominal stiffness: its value lies below the other's proved bound, or it is proved that the other has no place.
    pub fn better(&self) -> Option<usize> {
        let is_worse = |worse: usize, better: usize| {
            let Some(found) = self.sides[better].best() else { return false };
            match &self.sides[worse].placed {
                Placed::Feasible(best) => {
                    let proved = |best: &Placement| [best.lower_bound, best.deflection];
                    !may_be_as_good(proved(best), proved(found))
                }
                Placed::Infeasible { is_proved, .. } => *is_proved,
            }
        };
        [(1, 0), (0, 1)].into_iter().find(|&(worse, better)| is_worse(worse, better)).map(|(_, better)| better)
    }

    /// In which share of the draws of their drives each gives way least, of draws in which both give way alike half of them; `None` where nothing
    /// says how far the drives of both may be off, one is estimated or not to be taken, or they are asked different things.
    pub fn chances(&self) -> Option<[f64; 2]> {
        let is_open = |side: &PlaceAnswer| side.robot.status == Status::Estimated || is_barred(side);
        if self.sides.iter().any(is_open) || self.differ_in().iter().any(|what| ASKED.contains(what)) {
            return None;
        }
        let draws = |side: &PlaceAnswer| drawn(&side.robot, side.options.load, side.best()?);
        let [a, b] = self.sides.each_ref().map(draws);
        let (a, b) = (a?, b?);
        let share = |one: &[f64], other: &[f64]| {
            let won = |(one, other): (&f64, &f64)| match one.total_cmp(other) {
                Ordering::Less => 1.0,
                Ordering::Equal => 0.5,
                Ordering::Greater => 0.0,
            };
            one.iter().zip(other).map(won).sum::<f64>() / one.len() as f64
        };
        Some([share(&a, &b), share(&b, &a)])
    }

    /// What is not the same of both besides the answer.
    pub fn differ_in(&self) -> Vec<&'static str> {
        let [a, b] = &self.sides;
        let tool = |side: &PlaceAnswer| if let ModelKind::Spatial(tool) = side.model { Some(tool) } else { None };
        let mount = |side: &PlaceAnswer| side.options.cell.map(|cell| cell.mount);
        let [here, there] = [&a.options, &b.options];
        let force = |options: &PlaceOptions| options.load.counting(Component::Total);
        let differences = [
            ("robot", a.robot.full_name() != b.robot.full_name()),
            ("stiffness", a.robot.drive_compliance() != b.robot.drive_compliance()),
            ("model", a.model.name() != b.model.name()),
            ("tool", tool(a) != tool(b)),
            ("tool mass", here.tool_weight != there.tool_weight),
            ("tool direction", here.tool_orientation != there.tool_orientation),
            ("force", force(here) != force(there)),
            ("component", here.load.component() != there.load.component()),
            ("task", !a.task.work.is_same(&b.task.work)),
            ("tolerance", a.tolerance_mm != b.tolerance_mm),
            ("margins", here.margins != there.margins),
            ("mount", mount(a) != mount(b)),
            ("allowed place", a.allowed() != b.allowed()),
            ("angle", here.orientation != there.orientation),
            ("gap", here.gap != there.gap),
        ];
        differences.into_iter().filter(|(_, differ)| *differ).map(|(name, _)| name).collect()
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let [a, b] = &self.sides;
        let better = self.better();
        let mut record = Record::of(&shape::COMPARISON);
        record
            .put(field::SETUP_A, a.record())
            .put(field::SETUP_B, b.record())
            .put(field::SETUP_RATIO, self.ratio())
            .put(field::DISTINGUISHED, better.is_some())
            .put(field::BETTER_SETUP, better.map(|side| NAMES[side]))
            .put(field::WIN_PROBABILITY, self.chances().map(|chances| json!(chances)))
            .put(field::DIFFERENT, json!(self.differ_in()))
            .put(field::SUMMARY, json!(self.sentences()));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        let origin = if self.sides.iter().all(|side| side.robot.knows_base()) { ORIGIN } else { "as each setup says" };
        with_schema("compare", origin, &self.record())
    }

    /// A row for each setup.
    pub fn rows(&self) -> Rows<'static> {
        let records = NAMES.iter().zip(&self.sides).map(|(name, side)| {
            let mut record = Record::of(&shape::SETUP);
            record.put(field::SETUP, *name).extend(side.record());
            record
        });
        Rows::of(&shape::SETUP, records)
    }

    /// For people: a column for each setup.
    pub fn table(&self) -> Table {
        let mut table = Table::new(["", "A", "B"]).with_broken_lines();
        let mut row = |name: &str, says: [Option<String>; 2]| {
            if says.iter().any(Option::is_some) {
                let [a, b] = says.map(|says| says.unwrap_or_else(|| "-".into()));
                table.row([name.to_owned(), a, b]);
            }
        };
        for (name, says) in LINES {
            row(name, self.sides.each_ref().map(says));
        }
        let advised = self.sides.each_ref().map(|side| {
            side.advice.as_ref().map_or_else(Vec::new, |found| advice::lines(found, (&side.task, side.options.load)))
        });
        let mut names: Vec<&String> = Vec::new();
        for [name, _] in advised.iter().flatten() {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        for name in names {
            let says =
                |lines: &Vec<[String; 2]>| lines.iter().find(|line| line[0] == *name).map(|line| line[1].clone());
            row(name, advised.each_ref().map(says));
        }
        row("deflection over that of A", [self.ratio().map(|_| "1".into()), self.ratio().map(|ratio| fixed(ratio, 3))]);
        let standing = |side: usize| match self.better() {
            None => Some("cannot be distinguished".to_owned()),
            Some(better) if better == side => Some("better".into()),
            Some(_) => Some("worse".into()),
        };
        if self.best().iter().any(Option::is_some) {
            row("proved (nominal stiffness)", [standing(0), standing(1)]);
        }
        let share = |side: usize| self.chances().map(|chances| format!("{} of {DRAWS}", share_of_draws(chances[side])));
        row("stiffer (drives drawn)", [share(0), share(1)]);
        table
    }

    /// What a manager would read.
    pub fn sentences(&self) -> Vec<String> {
        let names = self.sides.each_ref().map(|side| side.robot.full_name());
        let called = |side: usize| format!("{} ({})", NAMES[side].to_uppercase(), names[side]);
        let mut sentences = vec![match (self.better(), self.ratio()) {
            (Some(better), Some(ratio)) => {
                let times = if better == 0 { ratio } else { 1.0 / ratio };
                let clause = format!("{} gives way {} times as far", called(1 - better), fixed(times, 3));
                match self.chances() {
                    Some(share) if SURE <= share[better] => format!(
                        "{} is better, which is proved at the nominal stiffness: {clause}. By what is known of the drives {} is stiffer in {} of the draws.",
                        called(better),
                        NAMES[better].to_uppercase(),
                        share_of_draws(share[better])
                    ),
                    Some(share) => format!(
                        "At the nominal stiffness {} is better, which is proved: {clause}. By what is known of the drives {}: {} is stiffer in {} of the draws.",
                        called(better),
                        if SURE <= share[1 - better] { "it is not" } else { "they tie" },
                        NAMES[better].to_uppercase(),
                        share_of_draws(share[better])
                    ),
                    None => {
                        format!("At the nominal stiffness {} is better, which is proved: {clause}.", called(better))
                    }
                }
            }
            (Some(better), None) => {
                format!("{} is better: it is proved that {} has no place.", called(better), called(1 - better))
            }
            (None, Some(_)) => format!(
                "{} and {} cannot be distinguished: the proved interval of each ({}) reaches into that of the other.",
                called(0),
                called(1),
                self.best().map(|best| best.map_or_else(|| "-".into(), interval)).join(" and ")
            ),
            (None, None) if self.best().iter().any(Option::is_some) => {
                "Only one of them was found a place, and that the other has none is not proved.".into()
            }
            (None, None) => "Neither of them was found a place.".into(),
        }];
        for (at, side) in self.sides.iter().enumerate() {
            if side.robot.status == Status::Estimated {
                let name = called(at);
                sentences.push(format!("The numbers of {name} are estimated: find its data sheet before you decide."));
            }
            if side.collision().is_some() {
                sentences.push(format!("At the place of {} the arm collides: it is not to be chosen.", called(at)));
            }
            sentences.extend(
                side.carried()
                    .exceeded()
                    .map(|what| format!("{} may not carry this ({what}): it is not to be chosen.", called(at))),
            );
        }
        let differ = self.differ_in();
        if differ.iter().any(|what| ASKED.contains(what)) {
            let compares = match self.ratio() {
                Some(_) => ": the ratio compares these two answers, not the robots",
                None => "",
            };
            sentences.push(format!("They are asked different things ({}){compares}.", differ.join(", ")));
        } else if !differ.is_empty() {
            sentences.push(format!("They differ in {}.", differ.join(", ")));
        }
        sentences
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let mut notes = words::assumed_architecture(self.sides.iter().map(|side| &side.robot)).to_owned();
        notes += &words::statuses(self.sides.iter().map(|side| &side.robot));
        notes
    }
}

/// A setup is not to be taken, whatever its deflection: its arm collides, or it carries more than it may.
fn is_barred(side: &PlaceAnswer) -> bool {
    side.collision().is_some() || side.carried().is_exceeded()
}

/// `1.980 to 2.003 mm`.
fn interval(best: &Placement) -> String {
    format!("{} to {} mm", fixed(best.lower_bound * 1e3, 4), fixed(best.deflection * 1e3, 4))
}
