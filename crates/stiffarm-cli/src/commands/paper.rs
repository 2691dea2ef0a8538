//! `stiffarm paper`: every table and figure of the paper under its number, each by the command that makes it alone.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use stiffarm::catalogue::paper_robots;
use stiffarm::ledger::{Entry, Printed, validate};
use stiffarm_ask::answer::{LedgerAnswer, fixed};
use stiffarm_ask::request::{Pair, Request, Spelling, Verb};

use crate::args::PaperArgs;
use crate::common::Common;
use crate::failure::Failure;
use crate::look::Look;
use crate::output::{say, write_text};
use crate::progress::progress;

/// The arm of sections II and III: `l2 = 1 m`, `l3 = 0.8 m`, 1 urad/(N m) on both drives.
const ARMS: [(&str, &str); 2] = [("serial", "arm_serial.toml"), ("quasi-serial", "arm_quasi_serial.toml")];
/// One scale for the maps of that arm, mm, and one for those of the ten robots.
const SCALES: [&str; 2] = ["0..4", "0..8"];
/// What cannot be made, and why.
const NOT_MADE: [(&str, &str); 1] = [(
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
struct Item {
    number: String,
    file: String,
    what: String,
    verb: Verb,
    /// Options and their texts; the robot's under `robot`.
    options: Vec<(&'static str, String)>,
}

pub(crate) fn run(args: &PaperArgs, common: &Common) -> Result<(), Failure> {
    let [folder] = common.output.as_slice() else {
        return Err(Failure::usage("paper writes a folder: give one with -o DIR"));
    };
    let made = |error| Failure::Write { path: folder.clone(), error };
    fs::create_dir_all(folder).map_err(made)?;
    for (architecture, file) in ARMS {
        write_text(&folder.join(file), &arm(architecture))?;
    }
    let entries = validate(&Printed::PAPER)?;
    let tables: Vec<[String; 3]> = [("1", "Table I"), ("2", "Table II"), ("3", "Table III")]
        .into_iter()
        .map(|(number, source)| table(folder, number, source, &entries))
        .collect::<Result<_, _>>()?;
    let items = items(args.pictures.name());
    let bar = progress(items.len(), "drawing", common);
    for item in &items {
        item.make(folder, args, common)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    write_text(&folder.join("index.md"), &index(&tables, &items))?;
    if !common.quiet {
        let files = items.len() + 2 * tables.len() + ARMS.len() + 1;
        say(&format!("wrote {files} files; {} says which is which", folder.join("index.md").display()));
        for (number, why) in NOT_MADE {
            say(&format!("{number} is not made: {why}"));
        }
    }
    Ok(())
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
fn items(ending: &str) -> Vec<Item> {
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
    /// Runs its command.
    fn make(&self, folder: &Path, args: &PaperArgs, common: &Common) -> Result<(), Failure> {
        let mut pairs: Vec<Pair> = self.options.iter().map(|(name, text)| pair(name, text, folder)).collect();
        if let Some(width) = args.width_mm {
            pairs.push(pair("width-mm", &width.to_string(), folder));
        }
        let asked = Request::read(self.verb, &pairs, Spelling::Typed)?;
        let common = Common { output: vec![folder.join(&self.file)], quiet: true, ..common.bare() };
        super::asked(&asked, &common)
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

/// Writes a table of the paper, printed beside computed, as CSV and Markdown; returns its line of the index.
fn table(folder: &Path, number: &str, source: &str, entries: &[Entry]) -> Result<[String; 3], Failure> {
    let own: Vec<Entry> = entries.iter().filter(|entry| entry.source == source).cloned().collect();
    let agree = own.iter().filter(|entry| entry.agrees).count();
    let mut csv = String::from("row,column,printed,computed,agrees,reason\n");
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    for entry in &own {
        let computed = entry.computed.map_or_else(String::new, |value| fixed(value, 4));
        let (row, column) = (quoted(&entry.item), quoted(&entry.cell));
        let note = quoted(entry.note.as_deref().unwrap_or_default());
        let _ = writeln!(csv, "{row},{column},{},{computed},{},{note}", entry.printed, entry.agrees);
    }
    write_text(&folder.join(format!("table_{number}.csv")), &csv)?;
    let count = own.len();
    let answer = LedgerAnswer(own);
    let text = format!("{}\n{}", crate::table::shown(&answer.table(), Look::MARKDOWN), answer.notes());
    write_text(&folder.join(format!("table_{number}.md")), &text)?;
    let what = format!("printed beside computed: {agree} of {count} agree within their printed digits");
    Ok([source.into(), format!("table_{number}.md"), what])
}

/// Which file is which, and by which command.
fn index(tables: &[[String; 3]], items: &[Item]) -> String {
    let mut text = String::from(
        "# The paper's tables and figures\n\n| of the paper | file | shows | command, in this folder |\n|---|---|---|---|\n",
    );
    for [number, file, what] in tables {
        let csv = PathBuf::from(file).with_extension("csv");
        let _ =
            writeln!(text, "| {number} | [{file}]({file}), [csv]({}) | {what} | `stiffarm validate` |", csv.display());
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
        let told: String = items.iter().map(|item| item.number.clone() + "; ").collect::<String>() + NOT_MADE[0].0;
        for number in 1..=19 {
            let ends = [
                format!("Figure {number};"),
                format!("Figure {number},"),
                format!("and {number};"),
                format!("Figures {number} "),
            ];
            let is_told =
                ends.iter().any(|end| told.contains(end.as_str())) || told.ends_with(&format!("Figure {number}"));
            assert!(is_told, "{number}: {told}");
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
