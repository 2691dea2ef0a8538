//! Rolls between the lines of the grid: smoother than a path of nodes, and never worse.

use super::climb::{Climb, Goal};
use super::contact::Guard;
use super::fault::MillError;
use super::follow::Arrangement;
use super::ladder::Ladder;
use crate::watch::Watch;

/// How often all rungs are looked at.
const ROUNDS: usize = 12;
/// Rungs whose error is this part of the largest are moved to less error, others to less motion.
const WORST: f64 = 0.995;

/// Moves the roll of every rung towards the middle of its neighbours, and where the error is largest to less error, as far as no error
/// passes `most`, m, the joints follow, and nothing is touched where that is asked.
pub(super) fn smoothed(
    ladder: &Ladder,
    mut rungs: Vec<Arrangement>,
    most: f64,
    guard: Option<&Guard>,
    watch: Watch,
) -> Result<Vec<Arrangement>, MillError> {
    let climb = Climb::new(ladder, Goal::LeastMotion, f32::MAX, false);
    let error_of = |k: usize, arrangement: Arrangement| Ok(ladder.errors_of(k, arrangement, &[arrangement.roll])?[0]);
    let is_clear = |k: usize, from: Arrangement, to: Arrangement| {
        guard.map_or(Ok(true), |guard| Ok::<_, MillError>(ladder.touch_from(guard, k, from, to)?.is_none()))
    };
    let mut errors =
        rungs.iter().enumerate().map(|(k, rung)| error_of(k, *rung)).collect::<Result<Vec<f64>, MillError>>()?;
    for round in 0..ROUNDS {
        watch.go_on()?;
        let largest = errors.iter().copied().fold(0.0, f64::max);
        let step = ladder.grid.step() * 0.5_f64.powi(round as i32 / 3);
        for k in (0..rungs.len()).filter(|k| ladder.rungs[*k].pinned.is_none()) {
            let before = k.checked_sub(1).filter(|_| !ladder.rungs[k].is_fresh);
            let after = Some(k + 1).filter(|next| ladder.rungs.get(*next).is_some_and(|next| !next.is_fresh));
            let beside: Vec<f64> = before.into_iter().chain(after).map(|other| rungs[other].roll).collect();
            let (now, is_worst) = (rungs[k].roll, largest * WORST <= errors[k]);
            let mut wanted = vec![now + step, now - step];
            if !beside.is_empty() {
                let middle = beside.iter().sum::<f64>() / beside.len() as f64;
                wanted.extend([middle, f64::midpoint(now, middle)]);
            }
            let bend = |roll: f64| beside.iter().map(|other| (roll - other).powi(2)).sum::<f64>();
            let found = ladder.errors_of(k, rungs[k], &wanted)?;
            let key = |(roll, error): (f64, f64)| if is_worst { error } else { bend(roll) };
            let better = wanted.into_iter().zip(found).filter(|(_, error)| *error <= most.max(errors[k]));
            let best = better.min_by(|a, b| key(*a).total_cmp(&key(*b)));
            let Some((roll, error)) = best.filter(|best| key(*best) < key((now, errors[k]))) else { continue };
            let moved = Arrangement { roll, ..rungs[k] };
            if before.is_none_or(|other| climb.joins((other, rungs[other]), (k, moved)))
                && after.is_none_or(|other| climb.joins((k, moved), (other, rungs[other])))
                && before.map_or(Ok(true), |other| is_clear(k, rungs[other], moved))?
                && after.map_or(Ok(true), |other| is_clear(other, moved, rungs[other]))?
                && guard.map_or(Ok(None), |guard| ladder.touch_within(guard, k, moved))?.is_none()
            {
                (rungs[k], errors[k]) = (moved, error);
            }
        }
    }
    Ok(rungs)
}
