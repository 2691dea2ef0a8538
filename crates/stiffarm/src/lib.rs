//! How stiff is an industrial robot where it machines?
pub mod catalogue;
pub mod drive;
pub mod geometry;
pub mod ledger;
pub mod limits;
pub mod map;
pub mod place;
pub mod plane;
pub mod rank;
pub mod robot;
mod root;
pub mod study;
pub mod task;
