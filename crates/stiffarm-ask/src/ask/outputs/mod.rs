//! What some verbs found, with what draws it: their answers show it in every form, and their reports are made of it.

pub(crate) mod mill;
pub(crate) mod path_ranking;
pub(crate) mod place;
pub(crate) mod rank;
