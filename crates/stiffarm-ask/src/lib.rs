//! What can be asked of [`stiffarm`], and what is answered: one place for the program, the server, the page and Python.
//!
//! The modules in reading order: [`date`], `markup`, [`request`], [`answer`], [`figures`], [`report`], [`error`], [`sources`], `exports`, [`forms`], [`ask`](mod@ask), [`paper`]. Each uses only those before it.
//!
//! Here, and where [`stiffarm`] reads or writes files, mm and degrees exist; the mathematics is in SI units.

pub mod answer;
pub mod ask;
pub mod date;
pub mod error;
mod exports;
pub mod figures;
pub mod forms;
mod markup;
pub mod paper;
pub mod report;
pub mod request;
pub mod sources;
