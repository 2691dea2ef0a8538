//! Is the reference what the tables say?
//!
//! `STIFFARM_WRITE=1 cargo test -p stiffarm-cli --test all readme::` writes it; without the variable what is stale fails.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

use assert_cmd::Command;
use stiffarm_ask::answer::field::{self, Field, Kind as Holds, Unit};
use stiffarm_ask::request::{Absent, Kind, Of, Setting, Verb};

use super::{ROOT, keys};
use crate::serve::served::Served;

pub(crate) const FOLDER: &str = "docs/guide/reference";
/// Behind the title of every page that is written here.
const WRITTEN: &str =
    "<!-- Written by `STIFFARM_WRITE=1 cargo test -p stiffarm-cli --test all readme::reference`, not by hand. -->";
/// First and last letters of the pages of keys.
const LETTERS: [[char; 2]; 4] = [['a', 'd'], ['e', 'l'], ['m', 'r'], ['s', 'z']];
/// Pages beside those that are written, by hand.
const BY_HAND: [&str; 2] = ["process_file.md", "scripts.md"];

/// A text as a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('<', "&lt;").replace('\n', " ")
}

pub(super) fn row(text: &mut String, cells: &[&str]) {
    let cells: Vec<String> = cells.iter().map(|text| cell(text)).collect();
    let _ = writeln!(text, "| {} |", cells.join(" | "));
}

pub(super) fn head(text: &mut String, cells: &[&str]) {
    row(text, cells);
    let _ = writeln!(text, "|{}", "---|".repeat(cells.len()));
}

fn page(title: &str, question: &str) -> String {
    format!("# {title}\n{WRITTEN}\n\n{question}\n")
}

/// The page of a verb, by its file.
pub(crate) fn page_of(verb: Verb) -> String {
    format!("{}.md", verb.name().replace(' ', "_"))
}

/// What `--help` of a command prints.
fn help(command: &str) -> String {
    let mut program = Command::cargo_bin("stiffarm").unwrap();
    let output = program.args(command.split_whitespace()).arg("--help").env("COLUMNS", "104").output().unwrap();
    let lines = String::from_utf8(output.stdout).unwrap();
    lines.lines().map(str::trim_end).collect::<Vec<_>>().join("\n")
}

/// The commands below a command, or below the program, that no table of options knows.
fn own(command: &str) -> Vec<String> {
    let help = help(command);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names = lines.filter(|line| !line.starts_with("   ")).filter_map(|line| line.split_whitespace().next());
    let full = names.filter(|name| *name != "help").map(|name| format!("{command} {name}").trim().to_owned());
    full.filter(|name| Verb::ALL.iter().all(|verb| verb.name() != *name)).collect()
}

/// Its words between two of its phrases, on one line.
fn between(help: &str, from: &str, to: &str) -> String {
    let rest = help.split_once(from).unwrap_or_else(|| panic!("no '{from}' in {help}")).1;
    rest.split(to).next().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What an option takes: words, a range with its unit, or a form of its own, of which the example says most.
fn takes(setting: &Setting) -> String {
    let range = match setting.kind {
        Kind::Flag => return "nothing".into(),
        Kind::Word(words) => words.iter().map(|(word, _)| format!("`{word}`")).collect::<Vec<_>>().join(", "),
        Kind::Number { min, max, or_zero, .. } => {
            let zero = if or_zero && 0.0 < min { "0, or " } else { "" };
            format!("{zero}{min} to {max}")
        }
        Kind::Whole { min, max: usize::MAX } => format!("whole, from {min}"),
        Kind::Whole { min, max } => format!("whole, {min} to {max}"),
        _ => setting.value.to_owned(),
    };
    let is_number = matches!(setting.kind, Kind::Number { .. } | Kind::Whole { .. });
    let unit = match setting.unit {
        "" => String::new(),
        unit if is_number => format!(" {unit}"),
        unit => format!(" [{unit}]"),
    };
    let is_shown = !matches!(setting.kind, Kind::Word(_)) && !setting.example.is_empty();
    let example = if is_shown { format!(", e.g. `{}`", setting.example) } else { String::new() };
    let several = if setting.is_list() { "; several" } else { "" };
    format!("{range}{unit}{example}{several}")
}

fn absent(setting: &Setting) -> String {
    match setting.absent {
        Absent::Default(text) => format!("`{text}`"),
        Absent::Means(words) => words.to_owned(),
        Absent::Optional => String::new(),
        Absent::Required => "required".into(),
    }
}

/// The help of an option, what it goes with and what not.
fn meaning(verb: Verb, setting: &Setting) -> String {
    let mut text = format!("{}.", setting.help);
    for (word, help) in setting.kind.words().iter().filter(|(_, help)| !help.is_empty()) {
        let _ = write!(text, " `{word}`: {}.", help.trim_end_matches('.'));
    }
    match setting.of {
        Of::Any => {}
        Of::Planar => text.push_str(" Planar model only."),
        Of::Spatial => text.push_str(" Spatial model only."),
    }
    let needed: Vec<String> = setting.needed_by(verb).map(|other| format!("`--{other}`")).collect();
    if !needed.is_empty() {
        let _ = write!(text, " Needs {}.", needed.join(" or "));
    }
    for other in setting.excludes.iter().filter(|other| verb.setting(other).is_some()) {
        let _ = write!(text, " Not with `--{other}`.");
    }
    text
}

fn of_verb(verb: Verb) -> String {
    let name = verb.name();
    let help = help(name);
    let about = help.lines().take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    let mut text = page(&format!("stiffarm {name}"), &format!("{about}."));
    let files = between(&help, "its ending chooses what: ", "-q, --quiet");
    let files = files.split(" --threads").next().unwrap_or_default();
    let _ = writeln!(text, "\n`-o` writes {files}. Options of every command: [commands](commands.md).\n");
    head(&mut text, &["option", "takes", "default", "meaning"]);
    let (named, bare): (Vec<&Setting>, _) = verb.settings().partition(|setting| !setting.is_positional);
    for setting in bare.into_iter().chain(named) {
        let option = if setting.is_positional { setting.value.to_owned() } else { format!("`--{}`", setting.name) };
        row(&mut text, &[&option, &takes(setting), &absent(setting), &meaning(verb, setting)]);
    }
    let examples = help.split_once("Examples:\n").map_or("", |(_, examples)| examples);
    let _ = writeln!(text, "\n## Examples\n\n```text\n{}\n```", examples.trim_end());
    text.push_str(&keys::of_verb(verb));
    text
}

/// A unit as its key ends, in words that people write.
pub(super) fn unit(field: &Field) -> String {
    of_kind(field.kind)
}

fn of_kind(kind: Holds) -> String {
    match kind {
        Holds::Text => "text".into(),
        Holds::Truth => "yes or no".into(),
        Holds::Count => "count".into(),
        Holds::Object | Holds::Objects => "fields of its own".into(),
        Holds::List(of) | Holds::Maybe(of) | Holds::ByName(of) => of_kind(*of),
        Holds::Number(unit) | Holds::Numbers { unit, .. } => match unit {
            Unit::One => "1",
            Unit::Described => "as said",
            Unit::Metre => "m",
            Unit::Millimetre => "mm",
            Unit::Degree => "deg",
            Unit::Milliradian => "mrad",
            Unit::Newton => "N",
            Unit::MicrometrePerNewton => "um/N",
            Unit::MicroradianPerNewtonMetre => "urad/(N m)",
            Unit::NewtonMetrePerRadian | Unit::Given("nm_per_rad") => "N m/rad",
            Unit::Kilogram => "kg",
            Unit::NewtonMetre | Unit::Given("nm") => "N m",
            Unit::Second => "s",
            Unit::Watt => "W",
            Unit::MillimetrePerMinute => "mm/min",
            Unit::Given("hz") => "Hz",
            Unit::Given(unit) => unit,
        }
        .into(),
    }
}

fn keys_file([from, to]: [char; 2]) -> String {
    format!("keys_{from}_to_{to}.md")
}

/// Keys of answers whose first letter is in a range; one key may stand in answers of several verbs with a meaning each.
fn of_keys(letters: [char; 2]) -> String {
    let [from, to] = letters;
    let mut fields: Vec<&Field> = field::all().filter(|field| (from..=to).contains(&first(field))).collect();
    fields.sort_by_key(|field| field.key);
    let question = "What stands under a key of JSON, CSV, Parquet, a data frame or a Python object? Null is written where a key does not \
                    apply. Every position counts from the robot's base: x forward, y left, z up.";
    let mut text = page(&format!("Keys of answers, {from} to {to}"), question);
    let others = LETTERS.into_iter().filter(|other| *other != letters);
    let links = others.map(|other| format!("[{} to {}]({})", other[0], other[1], keys_file(other)));
    let _ = writeln!(text, "Other keys: {}.\n", links.collect::<Vec<_>>().join(", "));
    head(&mut text, &["key", "unit", "columns in tables", "meaning"]);
    for field in fields {
        let columns = match field.kind {
            Holds::Numbers { columns, .. } => {
                columns.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" ")
            }
            _ => String::new(),
        };
        row(&mut text, &[&format!("`{}`", field.key), &unit(field), &columns, field.about]);
    }
    text
}

fn first(field: &Field) -> char {
    field.key.chars().next().unwrap_or_default()
}

fn of_commands() -> String {
    let question = "What do the commands take that are about the program itself, and what does every command take?";
    let mut text = page("Commands of the program", question);
    let common = help("rank");
    let _ = writeln!(text, "\n## Options of every command that answers\n");
    head(&mut text, &["option", "meaning"]);
    for (option, from) in [
        ("--format FORMAT", "--format <FORMAT>"),
        ("-o, --output FILE", "-o, --output <FILE>"),
        ("--threads N", "--threads <N>"),
        ("-q, --quiet", "-q, --quiet"),
        ("--save-job JOB.toml (job verbs)", "--save-job <JOB.toml>"),
        ("--check (rank, place, mill)", "      --check\n"),
    ] {
        row(
            &mut text,
            &[
                option,
                &between(&common, from, "\n\n")
                    .replace("; its ending chooses what:", "; its ending chooses what, here:"),
            ],
        );
    }
    for command in own("").iter().filter(|command| *command != "robots") {
        let _ = writeln!(text, "\n## stiffarm {command}\n\n```text\n{}\n```", help(command).trim_end());
    }
    text
}

fn of_robots() -> String {
    let question = "What do the commands take that show, check and make robot files? The list of robots: [robots list](robots_list.md).";
    let mut text = page("Commands for robot files", question);
    for command in own("robots") {
        let _ = writeln!(text, "\n## stiffarm {command}\n\n```text\n{}\n```", help(&command).trim_end());
    }
    text
}

/// Addresses as the server's own description has them.
fn of_http() -> String {
    let question =
        "Which addresses does `stiffarm serve` answer? The same description for programs is `GET /openapi.json`.";
    let mut text = page("HTTP", question);
    let described = Served::start(&[]).get("/openapi.json").json();
    text.push('\n');
    head(&mut text, &["address", "answer"]);
    let paths = described["paths"].as_object().expect("paths");
    for (path, methods) in paths {
        for (method, about) in methods.as_object().expect("methods") {
            let summary = about["summary"].as_str().expect("a summary");
            row(&mut text, &[&format!("`{} {path}`", method.to_uppercase()), summary]);
        }
    }
    let post = &paths["/api/rank"]["post"];
    let form = post["parameters"][0]["description"].as_str().expect("a description");
    let _ = writeln!(text, "\n`?as=FORM`: {}.\n", form.trim_end_matches('.').replace("The form: ", ""));
    head(&mut text, &["status", "meaning"]);
    let statuses: BTreeMap<_, _> = post["responses"].as_object().expect("answers").iter().collect();
    for (status, about) in statuses {
        row(&mut text, &[status, about["description"].as_str().expect("a description")]);
    }
    text.push_str(HTTP);
    text
}

const HTTP: &str = r#"
The body of a question has the keys of a [job file](scripts.md#job-file) as JSON under `options`, and the texts of files that it names under `files`:

```sh
curl -s http://127.0.0.1:PORT/api/place -H 'Content-Type: application/json' \
  -d '{"options": {"robot": "KR 210 R2700 extra", "task": "rect:0.6x0.4", "tolerance-mm": 3}}'
```

With `Accept: application/x-ndjson` the answer comes line by line and tells its progress first; closing the connection stops the work.
`?as=json,tables,svg` asks for several texts of one answer, which is computed once and comes as an object with a key for each: `tables` is what people read,
as JSON. A file that takes longer than `--time-limit-s` is asked with `Prefer: wait=SECONDS`.
"#;

/// Every page that is written here, by its file.
fn pages() -> BTreeMap<String, String> {
    let mut pages: BTreeMap<String, String> =
        Verb::ALL.into_iter().map(|verb| (page_of(verb), of_verb(verb))).collect();
    pages.extend(LETTERS.map(|letters| (keys_file(letters), of_keys(letters))));
    pages.insert("commands.md".into(), of_commands());
    pages.insert("robots.md".into(), of_robots());
    pages.insert("http.md".into(), of_http());
    pages
}

#[test]
fn the_reference_is_what_the_tables_say() {
    let folder = format!("{ROOT}/{FOLDER}");
    let is_written = std::env::var_os("STIFFARM_WRITE").is_some();
    let pages = pages();
    for (name, text) in &pages {
        let path = format!("{folder}/{name}");
        if is_written {
            fs::create_dir_all(&folder).unwrap();
            fs::write(&path, text).unwrap();
        }
        let found = fs::read_to_string(&path).unwrap_or_default();
        assert!(found == *text, "{FOLDER}/{name} is stale: STIFFARM_WRITE=1 writes it anew");
    }
    let others: Vec<String> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .map(|name| name.into_string().unwrap())
        .collect();
    for name in others {
        assert!(pages.contains_key(&name) || BY_HAND.contains(&name.as_str()), "{FOLDER}/{name}: nobody writes it");
    }
    assert!(field::all().all(|field| first(field).is_ascii_lowercase()), "a key that no page has");
}
