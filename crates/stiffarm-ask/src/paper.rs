//! Every table and figure of the paper under its number, each by the question that makes it alone.

use std::fmt::Write as _;
use std::path::Path;

use stiffarm::catalogue::paper_robots;
use stiffarm::ledger::Entry;

use crate::answer::{LedgerAnswer, Table, fixed};
use crate::request::{Pair, Refusal, Request, Setting, Spelling, Verb};

/// The arm of sections II and III: `l2 = 1 m`, `l3 = 0.8 m`, 1 urad/(N m) on both drives.
const ARMS: [(&str, &str); 2] = [("serial", "arm_serial.toml"), ("quasi-serial", "arm_quasi_serial.toml")];
/// One scale for the maps of that arm, mm, and one for those of the ten robots.
const SCALES: [&str; 2] = ["0..4", "0..8"];
/// What cannot be made, and why.
pub const NOT_MADE: [(&str, &str); 1] = [(
    "Figure 1",
    "drawings of two machines without any number; `stiffarm robots show NAME -o reach.svg` draws the links of any robot",
)];
/// What is not as it is printed.
const REMARKS: &str = "\
Figure 2: the paper does not say in which two directions its forces point; here straight ahead and straight up.\n\
Figures 4 to 9: the paper's two figures for one task stand beside each other in one.\n\
Figures 10 to 19: of the lengths and limits printed in data sheets, not those of the paper, which it does not print; five of the ten robots are \
estimated (`stiffarm robots show NAME` says what and why).\n\
Table III: none of its 60 numbers is reproduced by published lengths and limits; the table tells each beside the computed one, with the reason.\n";

/// A figure or a table that a command makes.
pub struct Item {
    number: String,
    /// Its name within the folder.
    pub file: String,
    what: String,
    verb: Verb,
    /// Options and their texts; the robot's under `robot`.
    options: Vec<(&'static str, String)>,
}

/// The robot file of an arm of the paper.
fn arm(architecture: &str) -> String {
    format!(
        "name = \"l2 1 m, l3 0.8 m, {architecture}\"\nvendor = \"the paper's arm:\"\narchitecture = \"{architecture}\"\nstatus = \"derived\"\n\n\
         [planar]\nl2_mm = 1000\nl3_mm = 800\nk2_urad_per_nm = 1\nk3_urad_per_nm = 1\n\n\
         [source]\ngeometry = \"[paper] section II.B\"\nlimits = \"none, as there\"\ncompliance = \"[paper] section II.B\"\n"
    )
}

/// All that a command makes.
pub fn items(ending: &str) -> Vec<Item> {
    let mut items = Vec::new();
    let mut add = |number: String, file: String, what: String, verb: Verb, options: Vec<(&'static str, String)>| {
        items.push(Item { number, file: format!("{file}.{ending}"), what, verb, options });
    };
    let letters = ['a', 'b', 'c', 'd'];
    for (way, (towards, degrees)) in [("straight ahead", "0"), ("straight up", "90")].into_iter().enumerate() {
        for (side, (architecture, arm)) in ARMS.into_iter().enumerate() {
            let letter = letters[2 * way + side];
            add(
                "Figure 2".into(),
                format!("figure_02{letter}"),
                format!("deflection of the {architecture} arm under 1 kN {towards}"),
                Verb::Map,
                vec![("robot", arm.into()), ("direction-deg", degrees.into()), ("scale", SCALES[0].into())],
            );
        }
    }
    for (side, (architecture, arm)) in ARMS.into_iter().enumerate() {
        add(
            "Figure 3".into(),
            format!("figure_03{}", letters[side]),
            format!("deflection of the {architecture} arm under 1 kN in the worst direction"),
            Verb::Map,
            vec![("robot", arm.into()), ("scale", SCALES[0].into())],
        );
    }
    for (task, [first, second]) in [("A", [4, 5]), ("B", [6, 7]), ("C", [8, 9])] {
        add(
            format!("Figures {first} and {second}"),
            format!("figure_{first:02}_{second:02}"),
            format!("accuracy over link ratio and size, task {task}"),
            Verb::Study,
            vec![("tasks", task.into())],
        );
    }
    for (n, robot) in paper_robots().iter().enumerate() {
        let number = 10 + n;
        add(
            format!("Figure {number}, left"),
            format!("figure_{number}_map"),
            format!("deflection of {} under 1 kN in the worst direction", robot.full_name()),
            Verb::Map,
            vec![("robot", robot.name.clone()), ("scale", SCALES[1].into())],
        );
        add(
            format!("Figure {number}, right"),
            format!("figure_{number}_tasks"),
            format!("deflection of {} at the best place over the size of each task", robot.full_name()),
            Verb::Rank,
            [("robots", robot.name.clone()), ("scale", SCALES[1].into())].into_iter().chain(conventions()).collect(),
        );
    }
    items
}

/// What makes a ranking that of the paper where robots are named: zones anywhere in the arm plane, joints up to their limits.
fn conventions() -> impl Iterator<Item = (&'static str, String)> {
    let given_up = [
        ("limit-margin-deg", "0"),
        ("singular-margin-deg", "0"),
        ("clear-of-base-m", "0"),
        ("floor", "none"),
        ("within", ".."),
    ];
    given_up.into_iter().map(|(name, text)| (name, text.to_owned()))
}

impl Item {
    /// What is asked for it, as typed, with its robot files in a folder.
    ///
    /// # Errors
    /// Where `further` makes no sense.
    pub fn asked(&self, folder: &Path, further: &[(&str, String)]) -> Result<Request, Refusal> {
        let own = self.options.iter().map(|(name, text)| pair(name, text, folder));
        let pairs: Vec<Pair> = own.chain(further.iter().map(|(name, text)| pair(name, text, folder))).collect();
        Request::read(self.verb, &pairs, Spelling::Typed)
    }

    /// The verb, and its options as Python names them.
    pub fn keywords(&self) -> (Verb, Vec<(String, String)>) {
        let keyword = |name: &str| self.verb.setting(name).map_or_else(|| name.to_owned(), Setting::keyword);
        (self.verb, self.options.iter().map(|(name, text)| (keyword(name), text.clone())).collect())
    }

    /// As it is typed within the folder.
    fn command(&self) -> String {
        let mut command = format!("stiffarm {}", self.verb.name());
        for (name, text) in &self.options {
            let quoted = if text.contains(' ') { format!("\"{text}\"") } else { text.clone() };
            let option = if *name == "robot" { String::new() } else { format!("--{name} ") };
            let _ = write!(command, " {option}{quoted}");
        }
        command + &format!(" -o {}", self.file)
    }
}

/// A file of the folder is named as it is seen from here.
fn pair(name: &str, text: &str, folder: &Path) -> Pair {
    let is_file = name == "robot" && ARMS.iter().any(|(_, file)| *file == text);
    let text = if is_file { folder.join(text).to_string_lossy().into_owned() } else { text.into() };
    Pair { name: name.into(), text, at: Spelling::Typed }
}

/// A text of the folder: its name, and what stands in it.
pub type Text = (String, String);

/// A table of the paper, printed beside computed.
#[derive(Clone, Debug)]
pub struct Printed {
    /// Its name in the paper.
    number: &'static str,
    /// As Markdown, and for spreadsheets.
    pub texts: [Text; 2],
    what: String,
}

/// The robot files of the paper's arms.
pub fn arms() -> [Text; 2] {
    ARMS.map(|(architecture, file)| (file.to_owned(), arm(architecture)))
}

/// The tables.
pub fn tables(entries: &[Entry]) -> Vec<Printed> {
    let printed = |(number, name): (u8, &'static str)| {
        let own: Vec<Entry> = entries.iter().filter(|entry| entry.source == name).cloned().collect();
        let agree = own.iter().filter(|entry| entry.agrees).count();
        let what = format!("printed beside computed: {agree} of {} agree within their printed digits", own.len());
        let csv = (format!("table_{number}.csv"), csv(&own));
        let answer = LedgerAnswer(own);
        let md = (format!("table_{number}.md"), format!("{}\n{}", markdown(&answer.table()), answer.notes()));
        Printed { number: name, texts: [md, csv], what }
    };
    [(1, "Table I"), (2, "Table II"), (3, "Table III")].map(printed).into()
}

fn csv(entries: &[Entry]) -> String {
    let mut csv = String::from("row,column,printed,computed,agrees,reason\n");
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    for entry in entries {
        let computed = entry.computed.map_or_else(String::new, |value| fixed(value, 4));
        let (row, column) = (quoted(&entry.item), quoted(&entry.cell));
        let note = quoted(entry.note.as_deref().unwrap_or_default());
        let _ = writeln!(csv, "{row},{column},{},{computed},{},{note}", entry.printed, entry.agrees);
    }
    csv
}

fn markdown(table: &Table) -> String {
    let line = |cells: &[String]| {
        format!("| {} |\n", cells.iter().map(|cell| cell.replace('|', "\\|")).collect::<Vec<_>>().join(" | "))
    };
    let between = format!("|{}\n", "---|".repeat(table.headings.len()));
    line(&table.headings) + &between + &table.rows.iter().map(|row| line(row)).collect::<String>()
}

/// Which file is which, and by which command.
pub fn index(tables: &[Printed], items: &[Item]) -> String {
    let mut text = String::from(
        "# The paper's tables and figures\n\n| of the paper | file | shows | command, in this folder |\n|---|---|---|---|\n",
    );
    for Printed { number, texts: [(md, _), (csv, _)], what } in tables {
        let _ = writeln!(text, "| {number} | [{md}]({md}), [csv]({csv}) | {what} | `stiffarm validate` |");
    }
    for item in items {
        let Item { number, file, what, .. } = item;
        let _ = writeln!(text, "| {number} | [{file}]({file}) | {what} | `{}` |", item.command());
    }
    for (number, why) in NOT_MADE {
        let _ = writeln!(text, "| {number} | not made | {why} | |");
    }
    text.push('\n');
    for line in REMARKS.lines() {
        let _ = writeln!(text, "- {line}");
    }
    text
}

#[cfg(test)]
mod tests {
    use stiffarm::model::ModelKind;
    use stiffarm::plane::PlanarArm;

    use super::*;

    #[test]
    fn every_figure_of_the_paper_is_made_once_or_named_with_a_reason() {
        let items = items("svg");
        let numbers: String = items.iter().map(|item| item.number.clone() + "; ").collect::<String>() + NOT_MADE[0].0;
        for number in 1..=19 {
            let ends = [
                format!("Figure {number};"),
                format!("Figure {number},"),
                format!("and {number};"),
                format!("Figures {number} "),
            ];
            let is_named =
                ends.iter().any(|end| numbers.contains(end.as_str())) || numbers.ends_with(&format!("Figure {number}"));
            assert!(is_named, "{number}: {numbers}");
        }
        for (i, item) in items.iter().enumerate() {
            assert!(items[..i].iter().all(|other| other.file != item.file), "{} twice", item.file);
            let pairs: Vec<Pair> = item.options.iter().map(|(name, text)| pair(name, text, Path::new(""))).collect();
            Request::read(item.verb, &pairs, Spelling::Typed).unwrap();
        }
    }

    /// Where nothing is said, a ranking is the paper's; where a robot is named, the figures ask for the same.
    #[test]
    fn figures_of_the_paper_keep_its_conventions() {
        let asked = |options: &[(&'static str, String)]| {
            let pairs: Vec<Pair> = options.iter().map(|(name, text)| pair(name, text, Path::new(""))).collect();
            Request::read(Verb::Rank, &pairs, Spelling::Typed).unwrap().place_options(None).unwrap()
        };
        let paper = asked(&[]);
        for item in items("svg").iter().filter(|item| item.verb == Verb::Rank) {
            let found = asked(&item.options);
            assert_eq!(found.margins, paper.margins, "{}", item.file);
            assert_eq!(found.within(&ModelKind::Planar), paper.within(&ModelKind::Planar), "{}", item.file);
        }
    }

    #[test]
    fn the_arms_of_the_paper_are_robot_files() {
        for (architecture, file) in ARMS {
            let robot = stiffarm::catalogue::read(&arm(architecture), file).unwrap();
            let found: PlanarArm = robot.arm_plane().unwrap().arm;
            assert!((found.l2, found.l3) == (1.0, 0.8) && robot.architecture.name() == architecture);
        }
    }
}
