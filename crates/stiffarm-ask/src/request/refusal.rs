//! Why is a request refused, in the spelling of whoever asks?

use std::fmt;

use super::setting::Setting;
use super::verb::Verb;
use stiffarm::plain::on_one_line;

/// How a reader of [`SETTINGS`](super::SETTINGS) spells an option, and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Spelling {
    /// `--force-n` on a command line.
    Typed,
    /// `force_n` in Python.
    Keyword,
    /// `force-n` in a job file.
    Key {
        /// The file as the user named it.
        file: String,
        /// From 1; `None` for the file as a whole.
        line: Option<usize>,
    },
    /// The same in a request that was sent: its names are those of a job file, and mean no file of this machine.
    Sent,
}

impl Spelling {
    /// The name of an option.
    pub fn name(&self, setting: &Setting) -> String {
        match self {
            Self::Typed if setting.is_positional => format!("<{}>", setting.value),
            Self::Typed => format!("--{}", setting.name),
            Self::Keyword => setting.keyword(),
            Self::Key { .. } | Self::Sent => setting.name.into(),
        }
    }

    /// The option with what its value stands for, where that helps.
    pub(super) fn with_value(&self, setting: &Setting) -> String {
        match self {
            Self::Typed if !setting.is_positional => format!("--{} <{}>", setting.name, setting.value),
            _ => self.name(setting),
        }
    }

    /// The name of an option whose key an answer has, such as `payload_kg`.
    pub fn spelt(&self, key: &str) -> String {
        match self {
            Self::Keyword => key.into(),
            _ => self.bare(&key.replace('_', "-")),
        }
    }

    /// An option that is not in the table, or not in this verb.
    pub(super) fn bare(&self, name: &str) -> String {
        let name = shown(name);
        match self {
            Self::Typed => format!("--{name}"),
            Self::Keyword | Self::Key { .. } | Self::Sent => name,
        }
    }

    pub(super) fn model(&self, name: &str) -> String {
        match self {
            Self::Typed => format!("--model {name}"),
            Self::Keyword => format!("model=\"{name}\""),
            Self::Key { .. } | Self::Sent => format!("model = \"{name}\""),
        }
    }
}

/// The place before a message: `job.toml:3: `, or nothing.
impl fmt::Display for Spelling {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Key { file, line: Some(line) } => write!(f, "{file}:{line}: "),
            Self::Key { file, line: None } => write!(f, "{file}: "),
            Self::Typed | Self::Keyword | Self::Sent => Ok(()),
        }
    }
}

/// A request that makes no sense; names are spelled as the reader spells them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// No option of any verb.
    #[error("{at}{name} is no option of {}{}", verb.name(), near.map_or_else(String::new, |near| format!("; did you mean {near}?")))]
    Unknown {
        /// Where.
        at: Spelling,
        /// As it was given.
        name: String,
        /// What was asked.
        verb: Verb,
        /// An option of this name is like it.
        near: Option<&'static str>,
    },
    /// An option of other verbs.
    #[error("{at}{name} does not go with {}; it is an option of {}", verb.name(), listed(of))]
    Verb {
        /// Where.
        at: Spelling,
        /// As it was given.
        name: String,
        /// What was asked.
        verb: Verb,
        /// The verbs that know it.
        of: Vec<Verb>,
    },
    /// The planar model does not know it.
    #[error("{at}{name} needs {model}")]
    NeedsModel {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// The spatial model, as it is asked for.
        model: String,
    },
    /// The spatial model does not know it.
    #[error("{at}{name} is of the planar model; it does not go with {model}, in space")]
    NotInSpace {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// The spatial model, as it is asked for.
        model: String,
    },
    /// It says something of another option.
    #[error("{at}{name} needs {other}")]
    Needs {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// The one that is missing.
        other: String,
    },
    /// Two options that say the same in different ways.
    #[error("{at}{name} and {other} exclude each other; give one of them")]
    Excludes {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// The other one.
        other: String,
    },
    /// One value was expected.
    #[error("{at}{name} is given twice; expected one value")]
    Twice {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
    },
    /// Too many or too few.
    #[error("{at}{name} has {count} {what}; expected {expected}")]
    Count {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// How many.
        count: usize,
        /// Of what.
        what: &'static str,
        /// How many it takes.
        expected: &'static str,
    },
    /// A text that stands for no value.
    #[error("{at}invalid value '{text}' for '{name}': {expected}")]
    Value {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// As it was given.
        text: String,
        /// What was expected.
        expected: String,
    },
    /// It must be given.
    #[error("{at}{name} is missing; expected {expected}")]
    Missing {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// What it is.
        expected: String,
    },
    /// A long side of several zones.
    #[error("{at}{name} horizontal or vertical means the long side of one task; give one {task} with it")]
    LongSide {
        /// Where.
        at: Spelling,
        /// The angle.
        name: String,
        /// The option that gives tasks.
        task: String,
    },
    /// What the options together mean has no answer.
    #[error("{at}{name} {why}")]
    Unanswered {
        /// Where.
        at: Spelling,
        /// Which option.
        name: String,
        /// Why.
        why: String,
    },
    /// A job file that cannot be understood.
    #[error("{at}{why}")]
    Job {
        /// Where.
        at: Spelling,
        /// What is wrong and what was expected.
        why: String,
    },
}

/// `rank, place and map`.
fn listed(verbs: &[Verb]) -> String {
    let names: Vec<&str> = verbs.iter().map(|verb| verb.name()).collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        names => names.concat(),
    }
}

/// A text from outside as it may stand in a message: short and on one line.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 60;
    let short: String = text.chars().take(MOST).collect();
    let more = if text.chars().nth(MOST).is_some() { "..." } else { "" };
    format!("{}{more}", on_one_line(&short))
}
