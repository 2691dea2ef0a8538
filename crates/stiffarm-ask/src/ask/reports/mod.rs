//! Answers as documents, a file a verb. Nothing is computed here: every sentence and every number is what `answer` says, every picture one of
//! `figures`.

pub(crate) mod calibrate;
pub(crate) mod identify;
mod inputs;
pub(crate) mod mill;
pub(crate) mod modes;
pub(crate) mod path_ranking;
pub(crate) mod place;
pub(crate) mod rank;
mod said;

pub(crate) use inputs::Inputs;
