//! Downhill by steps that are halved where none of them leads on.

use super::search::{FINE, Score};
use crate::watch::{Parts, Stopped};

/// The best of a candidate and of all that steps, m, and turns, rad, lead to from there, down to the finest step of an answer.
pub(super) fn descend<T>(
    (start, [mut step, mut turn], parts): (T, [f64; 2], &Parts),
    score: impl Fn(&T) -> Score,
    moved: impl Fn(&T, [f64; 2]) -> Vec<T>,
) -> Result<T, Stopped> {
    let mut best = start;
    while FINE.0 < step {
        parts.one_more()?;
        match moved(&best, [step, turn]).into_iter().min_by(|a, b| score(a).total_cmp(&score(b))) {
            Some(found) if score(&found).total_cmp(&score(&best)).is_lt() => best = found,
            _ => {
                step /= 2.0;
                turn /= 2.0;
            }
        }
    }
    Ok(best)
}
