//! Keyword arguments as the command line spells them, read by the library.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use stiffarm::request::{Pair, Request, Spelling, Verb};
use stiffarm::task::Task;

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
        let pair = |name: &str, text: &str| Pair { name: name.into(), text: text.into(), at: Spelling::Keyword };
        let given = self.0.iter().map(|(name, text)| pair(name, text));
        let pairs: Vec<Pair> = further.iter().map(|(name, text)| pair(name, text)).chain(given).collect();
        Request::read(verb, &pairs, Spelling::Keyword).map_err(refused)
    }
}

/// A task by its notation.
pub(crate) fn task(text: &str) -> PyResult<Task> {
    text.parse().map_err(|error: stiffarm::task::TaskError| refused(error))
}
