//! How stiff is an industrial robot where it machines?
pub mod drive;
pub mod geometry;
pub mod limits;
pub mod place;
pub mod plane;
pub mod robot;
mod root;
pub mod task;
