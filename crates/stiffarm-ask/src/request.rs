//! What can be asked? Every option once, and a request: what is given under their names, checked.
//!
//! The command line, Python and job files are readers of [`SETTINGS`]: each hands over names and texts, and all refuse the
//! same in the same words, in their own spelling.

mod cell;
mod command;
mod forces;
mod identify;
pub mod job;
mod kind;
mod measure;
mod modes;
mod notation;
mod on_path;
pub(crate) mod opt;
mod options;
mod parsed;
mod path;
mod placing;
mod python;
mod reading;
mod refusal;
mod sent;
mod setting;
mod settings;
mod sides;
mod study;
mod value;
mod verb;
mod words;

pub use kind::{Count, Kind};
pub use notation::{
    Angle, Force, block, degrees, elevation, force, marker, mount, number, open_range, pin, point, roll, shape,
    spindle, tool, way, window, within, yaw,
};
pub use options::{PlaceRequest, ToolPose, Unsupported, distinct};
pub(crate) use path::tool_name;
pub use refusal::{Refusal, Spelling};
pub use sent::sent;
pub use setting::{Absent, Of, Setting};
pub use settings::SETTINGS;
pub use sides::SetupError;
pub use verb::{Help, Verb};
pub use words::Layer;

use opt::Opt;
use refusal::shown;
use stiffarm::chatter::HeldBy;
use value::{Typed, Value};

/// A name and a text, as a reader found them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The name of the option in the spelling of its reader, without dashes before it.
    pub name: String,
    /// Its value; of an option that takes several, some of them with commas between.
    pub text: String,
    /// How the reader spells, and where it found this.
    pub at: Spelling,
}

/// What is asked of a verb: every option known to it and its model, every value in its range.
#[derive(Clone, Debug)]
pub struct Request {
    /// What is asked.
    pub verb: Verb,
    /// How whoever asks spells what is missing.
    reader: Spelling,
    given: Vec<Given>,
    /// The force of the process that was given, once its file was read.
    process_force: Option<Force>,
}

/// An option with its values.
#[derive(Clone, Debug)]
struct Given {
    setting: &'static Setting,
    at: Spelling,
    texts: Vec<String>,
    values: Vec<Value>,
}

impl Request {
    /// Reads what was given, and checks it against [`SETTINGS`]. What is required is asked for by the functions that tell
    /// it, so that a face may bring it in another way.
    ///
    /// # Errors
    /// The first fault: names, then values, then what does not go together.
    pub fn read(verb: Verb, pairs: &[Pair], reader: Spelling) -> Result<Self, Refusal> {
        let mut given: Vec<Given> = Vec::new();
        for pair in pairs {
            let setting = setting_of(verb, pair)?;
            let (texts, values) = read_values(setting, pair)?;
            // What is switched off is as if it were not there.
            if values == [Value::Truth(false)] {
                continue;
            }
            match given.iter_mut().find(|known| known.setting.name == setting.name) {
                None => given.push(Given { setting, at: pair.at.clone(), texts, values }),
                Some(known) if setting.is_list() => {
                    known.texts.extend(texts);
                    known.values.extend(values);
                }
                Some(_) => return Err(Refusal::Twice { at: pair.at.clone(), name: pair.at.name(setting) }),
            }
        }
        let request = Self { verb, reader, given, process_force: None };
        if verb == Verb::Compare {
            // What goes together is a matter of each setup, whose job file may say more.
            request.given.iter().try_for_each(check_count)?;
            return Ok(request);
        }
        for given in &request.given {
            check_count(given)?;
            request.check_model(given)?;
            request.check_others(given)?;
        }
        request.check_long_side()?;
        request.check_has_sides()?;
        request.check_parts()?;
        request.check_force()?;
        request.check_markers()?;
        request.check_dry()?;
        request.check_silent()?;
        request.check_held()?;
        request.check_quantity()?;
        request.check_measured()?;
        request.check_regions()?;
        request.check_runs()?;
        request.check_filters()?;
        request.check_tools()?;
        request.check_at()?;
        request.check_mass_centre()?;
        Ok(request)
    }

    /// Checks that everything is given that must be.
    ///
    /// # Errors
    /// The first that is missing.
    pub fn check_complete(&self) -> Result<(), Refusal> {
        let missing = |setting: &&Setting| setting.absent == Absent::Required && !self.is_given(setting.name);
        self.verb.settings().find(missing).map_or(Ok(()), |setting| Err(self.missing(setting.name)))
    }

    /// Was it given, rather than left to its default?
    pub fn is_given(&self, name: impl AsRef<str>) -> bool {
        self.find(name).is_some()
    }

    /// What was given that changes figures alone.
    pub fn given_of_figures(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.given
            .iter()
            .map(|given| given.setting)
            .filter(|setting| setting.is_of_figures())
            .map(|setting| setting.name)
    }

    /// What was given, and how many values of it.
    pub fn counts(&self) -> impl Iterator<Item = (&'static str, usize)> + '_ {
        self.given.iter().map(|given| (given.setting.name, given.values.len()))
    }

    fn find(&self, name: impl AsRef<str>) -> Option<&Given> {
        self.given.iter().find(|given| given.setting.name == name.as_ref())
    }

    /// What was given, or the default; nothing where the verb has no such option.
    fn all<T: Typed>(&self, option: Opt<T>) -> Vec<T> {
        let Some(row) = self.verb.setting(option).filter(|row| Opt::<T>::has(row)) else { return Vec::new() };
        let values = self.find(option).map_or_else(|| default_of(row), |given| given.values.clone());
        values.into_iter().map(|value| T::of(value).expect("the row is of this type")).collect()
    }

    /// The same of an option that takes one value.
    fn get<T: Typed>(&self, option: Opt<T>) -> Option<T> {
        self.all(option).pop()
    }

    /// The same of one without which nothing can be answered.
    fn required<T: Typed>(&self, option: Opt<T>) -> Result<T, Refusal> {
        self.get(option).ok_or_else(|| self.missing(option))
    }

    /// The same of one that has a default.
    fn value<T: Typed>(&self, option: Opt<T>) -> T {
        self.get(option).expect("the row has a default")
    }

    /// What is asked for by saying so.
    fn is_set(&self, option: Opt<bool>) -> bool {
        self.get(option) == Some(true)
    }

    /// An option belongs to the models to which it, and what it needs, belong.
    fn check_model(&self, given: &Given) -> Result<(), Refusal> {
        let (at, name, model) = (given.at.clone(), given.at.name(given.setting), given.at.model("spatial"));
        let mut next = Some(given.setting);
        while let Some(setting) = next {
            match setting.of {
                Of::Spatial if !self.is_spatial() => return Err(Refusal::NeedsModel { at, name, model }),
                Of::Planar if self.is_spatial() => return Err(Refusal::NotInSpace { at, name, model }),
                _ => next = self.needed(setting),
            }
        }
        Ok(())
    }

    fn needed(&self, setting: &Setting) -> Option<&'static Setting> {
        self.verb.setting(setting.needed_by(self.verb).next()?)
    }

    fn check_others(&self, given: &Given) -> Result<(), Refusal> {
        let Given { setting, at, .. } = given;
        let (at, name) = (at.clone(), at.name(setting));
        // A process says what a force would.
        let is_said = |other: &str| self.is_given(other) || other == opt::FORCE_N.name && self.is_given(opt::PROCESS);
        let others: Vec<&Setting> = setting.needed_by(self.verb).filter_map(|other| self.verb.setting(other)).collect();
        if !others.is_empty() && !others.iter().any(|other| is_said(other.name)) {
            let other = others.into_iter().map(|other| at.name(other)).collect::<Vec<_>>().join(" or ");
            return Err(Refusal::Needs { at, name, other });
        }
        match setting.excludes.iter().find_map(|other| self.find(other)) {
            None => Ok(()),
            Some(other) => {
                let other = other.at.name(other.setting);
                Err(Refusal::Excludes { at, name, other })
            }
        }
    }

    /// A tip that was measured on the robot has everything in it.
    fn check_measured(&self) -> Result<(), Refusal> {
        const IN_IT: [&str; 7] = [
            "damping-ratio",
            "tool-mass-kg",
            "tool-com-mm",
            "tool-inertia-kg-m2",
            "stiffness",
            "drive-urad-per-nm",
            "stiffness-nm-per-rad",
        ];
        if self.get(opt::FRF_ON) != Some(HeldBy::Robot) {
            return Ok(());
        }
        IN_IT.into_iter().find(|name| self.is_given(name)).map_or(Ok(()), |name| {
            Err(self.refused(name, "has no meaning where the tip was measured on the robot: it is in the table".into()))
        })
    }

    /// What the tool weighs and how slow the arm swings are of one question.
    fn check_quantity(&self) -> Result<(), Refusal> {
        if self.verb != Verb::Map || self.maps_frequency() {
            return Ok(());
        }
        if self.is_given(opt::TOOL_COM_MM) {
            let why = "has no meaning where deflections alone are mapped; expected quantity first-frequency beside it";
            return Err(self.refused(opt::TOOL_COM_MM, why.into()));
        }
        if self.layer() == Layer::FirstFrequency {
            return Err(self.refused(opt::LAYER, "first-frequency; expected quantity first-frequency beside it".into()));
        }
        Ok(())
    }

    /// A mass centre is of a mass, and what held a tip of its table; these need it by their rows.
    fn check_held(&self) -> Result<(), Refusal> {
        [(opt::TOOL_COM_MM.name, opt::TOOL_MASS_KG.name), (opt::FRF_ON.name, opt::FRF.name)].into_iter().try_for_each(
            |(name, other)| match (self.find(name), self.verb.setting(other)) {
                (Some(Given { setting, at, .. }), Some(needed)) if !self.is_given(other) => {
                    Err(Refusal::Needs { at: at.clone(), name: at.name(setting), other: at.name(needed) })
                }
                _ => Ok(()),
            },
        )
    }

    /// Of a path that is only read nothing is milled.
    fn check_dry(&self) -> Result<(), Refusal> {
        if self.verb != Verb::Mill || !self.is_dry() {
            return Ok(());
        }
        match self.given.iter().find(|given| !settings::milling::is_of_reading(given.setting)) {
            None => Ok(()),
            Some(Given { setting, at, .. }) => {
                let other = self.verb.setting(opt::DRY).map_or_else(String::new, |dry| at.name(dry));
                Err(Refusal::Excludes { at: at.clone(), name: at.name(setting), other })
            }
        }
    }

    fn missing(&self, name: impl AsRef<str>) -> Refusal {
        let name = name.as_ref();
        let setting = self.verb.setting(name);
        Refusal::Missing {
            at: self.reader.clone(),
            name: setting.map_or_else(|| self.reader.bare(name), |setting| self.reader.with_value(setting)),
            expected: setting.map_or_else(String::new, |setting| in_sentence(setting.help)),
        }
    }
}

/// A line of help as part of a sentence: "the robot", but "G-code".
fn in_sentence(help: &str) -> String {
    let is_word = |letter: char| letter.is_lowercase() || letter == ' ';
    match help.split_at_checked(1) {
        Some((first, rest)) if rest.starts_with(is_word) => first.to_lowercase() + rest,
        _ => help.to_owned(),
    }
}

/// What an option means where it is not given; nothing where no value says it.
fn default_of(setting: &Setting) -> Vec<Value> {
    match setting.absent {
        Absent::Default(text) => {
            parts(setting, text).map(|part| setting.kind.read(part).expect("a default is understood")).collect()
        }
        Absent::Means(_) | Absent::Optional | Absent::Required => Vec::new(),
    }
}

fn check_count(given: &Given) -> Result<(), Refusal> {
    let Given { setting, at, values, .. } = given;
    let Count { least, most, is_one_or_all, what, expected } = setting.count;
    let count = values.len();
    if (least..=most).contains(&count) && !(is_one_or_all && least < count && count < most) {
        return Ok(());
    }
    Err(Refusal::Count { at: at.clone(), name: at.name(setting), count, what, expected })
}

/// Checks that all of these are options of a verb, by their names alone: for a form that a person completes.
///
/// # Errors
/// At the first that is none.
pub fn check_names(verb: Verb, pairs: &[Pair]) -> Result<(), Refusal> {
    pairs.iter().try_for_each(|pair| setting_of(verb, pair).map(drop))
}

/// The row that a name means to its reader.
fn setting_of(verb: Verb, pair: &Pair) -> Result<&'static Setting, Refusal> {
    let Pair { name, at, .. } = pair;
    let is_meant = |setting: &&Setting| match at {
        Spelling::Keyword => setting.keyword() == *name,
        Spelling::Typed | Spelling::Key { .. } | Spelling::Sent => setting.name == name,
    };
    if let Some(setting) = verb.settings().find(is_meant) {
        return Ok(setting);
    }
    let of: Vec<Verb> = Verb::ALL.into_iter().filter(|verb| verb.settings().any(|row| is_meant(&row))).collect();
    let (at, name) = (at.clone(), at.bare(name));
    if !of.is_empty() {
        return Err(Refusal::Verb { at, name, verb, of });
    }
    let near = verb.settings().map(|setting| (stiffarm::plain::alike(setting.name, &pair.name), setting.name));
    let near = near.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(score, _)| 0.8 < *score);
    Err(Refusal::Unknown { at, name, verb, near: near.map(|(_, near)| near) })
}

/// The texts of one value each.
fn parts<'a>(setting: &Setting, text: &'a str) -> Box<dyn Iterator<Item = &'a str> + 'a> {
    let between = if matches!(setting.kind, Kind::Within | Kind::Block { .. } | Kind::Marker) { ';' } else { ',' };
    if setting.is_list() { Box::new(text.split(between)) } else { Box::new(std::iter::once(text)) }
}

fn read_values(setting: &Setting, pair: &Pair) -> Result<(Vec<String>, Vec<Value>), Refusal> {
    let mut found = (Vec::new(), Vec::new());
    for part in parts(setting, &pair.text) {
        let value = setting.kind.read(part).map_err(|expected| Refusal::Value {
            at: pair.at.clone(),
            name: pair.at.with_value(setting),
            text: shown(part),
            expected: stiffarm::plain::on_one_line(&expected).into_owned(),
        })?;
        found.0.push(part.to_owned());
        found.1.push(value);
    }
    Ok(found)
}
