//! One file per verb: arguments to a call of the library, the answer to text, JSON, CSV and figure.

pub(crate) mod compliance;
pub(crate) mod import;
pub(crate) mod map;
pub(crate) mod place;
pub(crate) mod rank;
pub(crate) mod robots;
mod sheet;
pub(crate) mod spatial;
pub(crate) mod study;
pub(crate) mod validate;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::Common;

/// A progress bar on stderr: nothing where stderr is no terminal, or quiet is asked for.
pub(crate) fn progress(length: usize, doing: &'static str, common: &Common) -> ProgressBar {
    if common.quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr_with_hz(10));
    let style = ProgressStyle::with_template("{msg} {bar:32} {pos}/{len} {eta}").expect("a fixed template");
    bar.with_style(style).with_message(doing)
}
