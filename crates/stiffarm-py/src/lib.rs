//! The extension module of the Python package `stiffarm`: takes arguments, calls the library, hands back its answers.
//!
//! Nothing is computed here. The Python side spells its arguments as the command line does (`within_m="0.5..,0.."`), so that
//! both faces share one notation and its words.

#![allow(clippy::needless_pass_by_value, reason = "arguments from Python arrive by value")]
#![allow(
    clippy::doc_markdown,
    rustdoc::broken_intra_doc_links,
    reason = "docstrings are for Python and put units in brackets"
)]

mod asked;
mod batch;
mod draws;
mod hearing;
mod json;
mod numbers;
mod palette;
mod pool;
mod robot;
mod verbs;
mod waiting;

use pyo3::prelude::*;

pyo3::create_exception!(
    stiffarm,
    StiffarmError,
    pyo3::exceptions::PyValueError,
    "What the library refuses, in its words."
);

/// An error in the library's words.
fn refused(error: impl ToString) -> PyErr {
    StiffarmError::new_err(error.to_string())
}

#[pymodule]
mod _stiffarm {
    #[pymodule_export]
    use super::StiffarmError;
    #[pymodule_export]
    use super::asked::options;
    #[pymodule_export]
    use super::batch::{matrices, worst};
    #[pymodule_export]
    use super::draws::draws;
    #[pymodule_export]
    use super::palette::{colours, looks};
    #[pymodule_export]
    use super::pool::set_threads;
    #[pymodule_export]
    use super::robot::{Robot, robots, select};
    #[pymodule_export]
    use super::verbs::{answered, distinct, order, paper, validate};

    use pyo3::prelude::*;

    #[pymodule_init]
    fn version(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // SHA-256 of the Rust sources: tells two builds of one version apart.
        module.add("__sources__", env!("STIFFARM_SOURCES"))?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
