//! What does a job file ask? A TOML file with a key `verb`, and every option by its name.
//!
//! ```toml
//! verb = "place"
//! robot = "robots/mine.toml"          # relative paths count from the folder of the job file
//! task = "rect:0.6x0.4"
//! model = "spatial"
//! within = ["1.0..", "0.5.."]
//! [tool]                              # a table puts its name before its keys: tool-mm, tool-direction
//! mm = [0, 0, 200]
//! direction = "down"
//! [cell]                              # but of this one: mount, within, keep-out, clearance-mm
//! mount = "pedestal:0.5"
//! keep-out = ["1.0..2.0,-3.0..-1.5,..1.2"]
//! ```

use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::{MAIN_SEPARATOR, Path, absolute};

use toml::de::{DeTable, DeValue};

use super::notation::of_tool;
use super::{Kind, Pair, Refusal, Request, Setting, Spelling, Verb, on_path};
use stiffarm::catalogue::{self, files, quoted};
use stiffarm::plain::on_one_line;
use stiffarm::toolpath::Builtin;

/// Keys that are a matter of the program which reads the file; their values are not checked here.
pub const PROGRAM: [&str; 5] = ["format", "output", "threads", "quiet", "check"];

/// What a job file asks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Job {
    /// Which verb.
    pub verb: Verb,
    /// The options in their order, unchecked: [`Request::read`] does that.
    pub pairs: Vec<Pair>,
    /// What stands under the keys of [`PROGRAM`].
    pub program: Vec<Pair>,
}

/// Is this the text of a job file? It has a key `verb` at its top, which no robot file has.
pub fn is_job(text: &str) -> bool {
    if let Ok(root) = DeTable::parse(text) {
        // What names a robot or a task, and has no name itself, is a job whose verb was forgotten.
        let has = |key: &str| root.get_ref().contains_key(key);
        return has("verb") || !has("name") && (has("robot") || has("robots") || has("task"));
    }
    // Of a text that is no TOML, so that what is wrong is said of a job.
    let top = text.lines().map(str::trim_start).take_while(|line| !line.starts_with('['));
    top.filter_map(|line| line.strip_prefix("verb")).any(|rest| rest.trim_start().starts_with('='))
}

/// Reads the text of a job file; paths in it that are relative come to count from its folder.
///
/// # Errors
/// The first fault, with its line: no TOML, no verb, a key twice, a value of another type than its option takes.
pub fn read(text: &str, file: &Path) -> Result<Job, Refusal> {
    Reader::of(text, files::shown(file), Some(file.parent().unwrap_or(Path::new("")))).job()
}

/// Reads the text of a job file that was sent under this name: names in it stay as they are, and are looked for on no disk.
///
/// # Errors
/// As [`read`].
pub fn read_sent(text: &str, name: &str) -> Result<Job, Refusal> {
    Reader::of(text, on_one_line(name).into_owned(), None).job()
}

struct Reader<'a> {
    text: &'a str,
    /// Where its lines begin.
    lines: Vec<usize>,
    file: String,
    /// From which relative paths count; `None` where there is no disk.
    folder: Option<&'a Path>,
}

/// A key with the tables before it, where it stands, and its value.
type Entry<'a, 'i> = (String, usize, &'a DeValue<'i>);

impl<'t> Reader<'t> {
    fn of(text: &'t str, file: String, folder: Option<&'t Path>) -> Self {
        let lines = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { text, lines, file, folder }
    }

    fn at(&self, place: usize) -> Spelling {
        let line = self.lines.partition_point(|start| *start <= place);
        Spelling::Key { file: self.file.clone(), line: Some(line) }
    }

    fn fault(&self, place: usize, why: impl Into<String>) -> Refusal {
        Refusal::Job { at: self.at(place), why: why.into() }
    }

    fn job(&self) -> Result<Job, Refusal> {
        let root = DeTable::parse(self.text).map_err(|error| {
            self.fault(error.span().map_or(0, |span| span.start), on_one_line(error.message()).into_owned())
        })?;
        let mut entries = Vec::new();
        Self::collect(root.get_ref(), "", &mut entries);
        entries.sort_by_key(|(_, place, _)| *place);
        let mut seen = HashSet::new();
        if let Some((name, place, _)) = entries.iter().find(|(name, ..)| !seen.insert(name.as_str())) {
            return Err(self.fault(*place, format!("{} is given twice; expected it once", on_one_line(name))));
        }
        let verb = self.verb(&entries)?;
        let mut job = Job { verb, pairs: Vec::new(), program: Vec::new() };
        for (name, place, value) in entries.iter().filter(|(name, ..)| name != "verb") {
            let of_program = PROGRAM.contains(&name.as_str());
            let setting = verb.setting(name);
            let texts = texts(setting, value).map_err(|expected| {
                self.fault(*place, format!("{} for '{}': {expected}", described(value), on_one_line(name)))
            })?;
            let is_path = name == "output" || setting.is_some_and(|setting| setting.kind == Kind::Robot);
            let is_of_file = |text: &String| {
                setting.is_some_and(|setting| {
                    matches!(setting.kind, Kind::File | Kind::FileOfTool)
                        || setting.kind == Kind::Task && on_path::is_path(text)
                })
            };
            let pairs = texts.into_iter().map(|text| {
                let text = match () {
                    () if is_of_file(&text) => match of_tool(&text) {
                        (Some(tool), file) if setting.is_some_and(|setting| setting.kind == Kind::FileOfTool) => {
                            format!("T{tool}={}", self.of_folder(file.into()))
                        }
                        _ => self.of_folder(text),
                    },
                    () if is_path => self.rebased(name == "output", text),
                    () => text,
                };
                Pair { name: name.clone(), text, at: self.at(*place) }
            });
            if of_program { job.program.extend(pairs) } else { job.pairs.extend(pairs) }
        }
        Ok(job)
    }

    fn collect<'a, 'i>(table: &'a DeTable<'i>, before: &str, entries: &mut Vec<Entry<'a, 'i>>) {
        for (key, value) in table {
            let place = key.span().start;
            let name = format!("{before}{}", key.get_ref().replace('_', "-"));
            match value.get_ref() {
                // What is known of the cell is called the same outside of its table.
                DeValue::Table(inner) if before.is_empty() && name == "cell" => Self::collect(inner, "", entries),
                DeValue::Table(inner) if before.is_empty() => Self::collect(inner, &format!("{name}-"), entries),
                value => entries.push((name, place, value)),
            }
        }
    }

    fn verb(&self, entries: &[Entry]) -> Result<Verb, Refusal> {
        let names: Vec<&str> = Verb::jobs().map(Verb::name).collect();
        let expected = format!("expected {}", names.join(", "));
        let Some((_, place, value)) = entries.iter().find(|(name, ..)| name == "verb") else {
            return Err(Refusal::Job {
                at: Spelling::Key { file: self.file.clone(), line: None },
                why: format!("verb is missing; {expected}"),
            });
        };
        let known = Verb::jobs().find(|verb| value.as_str() == Some(verb.name()));
        known.ok_or_else(|| self.fault(*place, format!("{} for 'verb': {expected}", described(value))))
    }

    /// A file counts from the folder of the job; a path built in is none.
    fn of_folder(&self, text: String) -> String {
        match self.folder {
            Some(folder) if !Builtin::is_meant(&text) => folder.join(text).to_string_lossy().into_owned(),
            _ => text,
        }
    }

    /// A path that is relative counts from the folder of the file.
    fn rebased(&self, is_file: bool, text: String) -> String {
        let Some(folder) = self.folder else { return text };
        let is_path = is_file || is_path(&text) || !is_name(&text) && folder.join(&text).is_dir();
        if is_path { folder.join(text).to_string_lossy().into_owned() } else { text }
    }
}

impl Job {
    /// The options with those that were typed beside the file in the place of its own, and of what they exclude.
    pub fn overruled_by(self, typed: Vec<Pair>) -> Vec<Pair> {
        let says = |typed: &Pair, name: &str| {
            typed.name == name || self.verb.setting(&typed.name).is_some_and(|setting| setting.excludes.contains(&name))
        };
        let mut pairs: Vec<Pair> =
            self.pairs.into_iter().filter(|pair| !typed.iter().any(|typed| says(typed, &pair.name))).collect();
        pairs.extend(typed);
        pairs
    }
}

/// A file or folder of robots rather than a name: no name of the catalogue, no pattern, no set; it has a separator in it, or the
/// ending of a robot file.
fn is_path(text: &str) -> bool {
    !is_name(text) && (text.contains(['/', MAIN_SEPARATOR]) || files::is_robot_file(Path::new(text)))
}

fn is_name(text: &str) -> bool {
    catalogue::find(text).is_some() || text.contains(['*', '?', '[']) || matches!(text, "paper" | "all")
}

/// The value of a key as it would be typed, once for each of several values.
pub(super) fn texts(setting: Option<&Setting>, value: &DeValue) -> Result<Vec<String>, String> {
    let kind = setting.map(|setting| setting.kind);
    let DeValue::Array(items) = value else { return Ok(vec![scalar(kind, value)?]) };
    let several = |kind| items.iter().map(|item| scalar(kind, item.get_ref())).collect::<Result<Vec<_>, _>>();
    match kind {
        Some(Kind::Tool | Kind::Point) => several(Some(Kind::Elevation)).map(|parts| vec![parts.join(",")]),
        Some(Kind::Force) => several(kind).map(|parts| vec![parts.join(",")]),
        // Ranges of one window, or whole windows.
        Some(Kind::Within) => several(Some(Kind::Text))
            .map(|parts| if parts.iter().any(|part| part.contains(',')) { parts } else { vec![parts.join(",")] }),
        Some(Kind::Range { .. }) => several(Some(Kind::Elevation)).map(|ends| vec![ends.join("..")]),
        // An option that has no row is refused by its name, whatever its value.
        None => Ok(items.iter().map(|item| scalar(None, item.get_ref()).unwrap_or_default()).collect()),
        _ if setting.is_some_and(Setting::is_list) && !items.is_empty() => several(kind),
        _ if items.is_empty() => Err("expected at least one value".into()),
        _ => Err("expected one value".into()),
    }
}

fn scalar(kind: Option<Kind>, value: &DeValue) -> Result<String, String> {
    let only_number = kind.is_some_and(Kind::is_number);
    let only_text = kind.is_some_and(|kind| !kind.may_be_number());
    match value {
        DeValue::String(_) if only_number => Err("expected a number, without quotes".into()),
        DeValue::Integer(_) | DeValue::Float(_) if only_text => Err("expected a text in quotes".into()),
        DeValue::String(text) => Ok(text.to_string()),
        DeValue::Integer(integer) if integer.radix() == 10 => Ok(integer.as_str().replace('_', "")),
        DeValue::Float(float) => Ok(float.as_str().replace('_', "")),
        DeValue::Boolean(flag) if matches!(kind, None | Some(Kind::Flag)) => Ok(flag.to_string()),
        _ if kind.is_none() => Ok(String::new()),
        _ if only_number => Err("expected a number".into()),
        _ => Err("expected a text in quotes".into()),
    }
}

/// A value as it may stand in a message.
pub(super) fn described(value: &DeValue) -> String {
    let text = match value {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(integer) => integer.as_str().into(),
        DeValue::Float(float) => float.as_str().into(),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date".into(),
        DeValue::Array(_) => "a list".into(),
        DeValue::Table(_) => "a table".into(),
    };
    format!("invalid value '{}'", super::shown(&text))
}

/// The job file that asks the same, as it stands at `file`; of what was sent names stay as they are. `program` are keys of [`PROGRAM`] with their values as TOML.
pub fn write(request: &Request, program: &[(&str, String)], file: &Path) -> String {
    let folder = (request.reader != Spelling::Sent).then(|| file.parent().unwrap_or(Path::new("")));
    let mut text = format!("verb = {}\n", quoted(request.verb.name()));
    let mut line = |key: &str, value: &str| writeln!(text, "{key} = {value}").expect("memory takes everything");
    for given in &request.given {
        let values: Vec<String> = given.texts.iter().map(|text| literal(given.setting.kind, text, folder)).collect();
        match values.as_slice() {
            [one] if !given.setting.is_list() => line(given.setting.name, one),
            several => line(given.setting.name, &format!("[{}]", several.join(", "))),
        }
    }
    for (key, value) in program {
        line(key, value);
    }
    text
}

/// A value as TOML.
fn literal(kind: Kind, text: &str, folder: Option<&Path>) -> String {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite()).map(|x| x.to_string());
    match kind {
        Kind::File if Builtin::is_meant(text) => quoted(text),
        Kind::Robot => quoted(&folder.map_or_else(|| text.trim().into(), |folder| seen_from(folder, text.trim()))),
        Kind::FileOfTool => {
            let (tool, file) = of_tool(text);
            let file = folder.map_or_else(|| file.trim().into(), |folder| file_from(folder, file.trim()));
            quoted(&tool.map_or_else(|| file.clone(), |tool| format!("T{tool}={file}")))
        }
        Kind::File => quoted(&folder.map_or_else(|| text.trim().into(), |folder| file_from(folder, text.trim()))),
        Kind::Flag => text.trim().into(),
        Kind::Tool | Kind::Point | Kind::Force if text.contains(',') => {
            let parts: Vec<String> = text.split(',').map(|part| number(part).expect("all are numbers")).collect();
            format!("[{}]", parts.join(", "))
        }
        kind if kind.may_be_number() => number(text).unwrap_or_else(|| quoted(text)),
        _ => quoted(text),
    }
}

/// A text as TOML.
pub fn text(text: &str) -> String {
    quoted(text)
}

/// A file as it is seen from the folder of a job file.
fn file_from(folder: &Path, text: &str) -> String {
    let (Ok(path), Ok(folder)) = (absolute(text), absolute(folder.join("."))) else { return text.into() };
    path.strip_prefix(&folder).map_or_else(|_| path.to_string_lossy(), Path::to_string_lossy).into_owned()
}

/// A path as it is seen from the folder of a job file; a name as it is.
pub fn seen_from(folder: &Path, text: &str) -> String {
    let is_name = catalogue::find(text).is_some() || matches!(text, "" | "paper" | "all");
    if is_name || !is_path(text) && !Path::new(text).exists() {
        return text.into();
    }
    let (Ok(path), Ok(folder)) = (absolute(text), absolute(folder.join("."))) else { return text.into() };
    match path.strip_prefix(&folder) {
        Ok(inside) if inside.as_os_str().is_empty() => "./".into(),
        Ok(inside) if is_path(&inside.to_string_lossy()) => inside.to_string_lossy().into_owned(),
        Ok(inside) => format!("./{}", inside.to_string_lossy()),
        Err(_) => path.to_string_lossy().into_owned(),
    }
}
