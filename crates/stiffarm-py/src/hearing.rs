//! Python hears what is said beside an answer, as warnings, and why there is none, as an exception.

use std::ffi::CString;
use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use stiffarm::watch::{Stopped, Watch};
use stiffarm_ask::ask::{AskError, Listener};

/// Takes down what is said while a question is answered on other threads.
pub(crate) struct Heard<'a> {
    watch: Watch<'a>,
    remarks: Mutex<Vec<String>>,
}

impl<'a> Heard<'a> {
    /// For whoever watches.
    pub(crate) fn by(watch: Watch<'a>) -> Self {
        Self { watch, remarks: Mutex::default() }
    }

    /// All that was said.
    pub(crate) fn remarks(self) -> Vec<String> {
        self.remarks.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Listener for Heard<'_> {
    fn remark(&self, text: &str) {
        self.warn(text);
    }

    fn warn(&self, text: &str) {
        self.remarks.lock().unwrap_or_else(PoisonError::into_inner).push(text.into());
    }

    fn watch(&self, _doing: &'static str, work: &mut dyn FnMut(Watch)) {
        work(self.watch);
    }

    fn go_on(&self) -> Result<(), Stopped> {
        self.watch.go_on()
    }
}

/// Says each of some remarks as a `UserWarning`.
pub(crate) fn said(py: Python, remarks: &[String]) -> PyResult<()> {
    for remark in remarks {
        let text = ["warning: ", "note: "].iter().find_map(|before| remark.strip_prefix(before)).unwrap_or(remark);
        let text = CString::new(text.replace('\0', " ")).map_err(crate::refused)?;
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
    }
    Ok(())
}

/// Why there is no answer, with what helps in Python, too.
pub(crate) fn refused(error: AskError) -> PyErr {
    match &error {
        AskError::UnknownRobot { suggestions, .. } if suggestions.is_empty() => {
            crate::refused(format!("{error}; stiffarm.robots() lists the robots; a path to a robot file works too"))
        }
        AskError::UnknownRobot { .. } | AskError::NothingLeft { .. } | AskError::Unreadable(_) => {
            crate::refused(format!("{error}; {}", error.hint()))
        }
        _ => crate::refused(error),
    }
}
