//! Keyword arguments as the command line spells them, read by the library.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use stiffarm::task::Task;
use stiffarm_ask::request::{Absent, Kind, Pair, Request, Spelling, Verb};

use crate::refused;

/// What was given, by its keyword.
#[derive(FromPyObject)]
#[pyo3(transparent)]
pub(crate) struct Asked(BTreeMap<String, String>);

impl Asked {
    /// What is asked of a verb.
    pub(crate) fn of(&self, verb: Verb) -> PyResult<Request> {
        self.with(verb, &[])
    }

    /// The same with what was given in another way: keyword and text.
    pub(crate) fn with(&self, verb: Verb, further: &[(&str, &str)]) -> PyResult<Request> {
        let given = self.0.iter().map(|(name, text)| (name.as_str(), text.as_str()));
        let pairs = further.iter().copied().chain(given);
        read(verb, pairs.map(|(name, text)| (name.to_owned(), text.to_owned())))
    }
}

/// What is asked of a verb, by keywords and texts.
pub(crate) fn read(verb: Verb, given: impl IntoIterator<Item = (String, String)>) -> PyResult<Request> {
    let pairs = given.into_iter().map(|(name, text)| Pair { name, text, at: Spelling::Keyword });
    Request::read(verb, &pairs.collect::<Vec<_>>(), Spelling::Keyword).map_err(refused)
}

/// The verb of this name.
pub(crate) fn verb(name: &str) -> PyResult<Verb> {
    let found = Verb::ALL.into_iter().find(|known| known.name() == name);
    found.ok_or_else(|| refused(format!("there is no verb '{name}'")))
}

/// An option as Python needs it: keyword, what it takes, the bounds of a whole number, whether it takes several, its default as it
/// is typed, whether it must be given, and a line of help.
type OptionRow = (String, String, Option<(usize, usize)>, bool, Option<&'static str>, bool, String);

/// The options of a verb, in the order of help, but for those of the program's figures.
#[pyfunction]
pub(crate) fn options(verb: &str) -> PyResult<Vec<OptionRow>> {
    let rows = self::verb(verb)?.settings().filter(|setting| !setting.is_of_figures()).map(|setting| {
        let bounds = if let Kind::Whole { min, max } = setting.kind { Some((min, max)) } else { None };
        let default = if let Absent::Default(text) = setting.absent { Some(text) } else { None };
        let is_required = setting.absent == Absent::Required;
        (setting.keyword(), kind(setting.kind), bounds, setting.is_list(), default, is_required, setting.described())
    });
    Ok(rows.collect())
}

/// The name of a kind: `number`, `word`, `within`.
fn kind(kind: Kind) -> String {
    let shown = format!("{kind:?}");
    shown.split(|letter: char| !letter.is_alphanumeric()).next().unwrap_or_default().to_lowercase()
}

/// A task by its notation.
pub(crate) fn task(text: &str) -> PyResult<Task> {
    text.parse().map_err(|error: stiffarm::task::TaskError| refused(error))
}
