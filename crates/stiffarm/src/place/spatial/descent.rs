//! Downhill by steps that are halved where none of them leads on.

use crate::watch::{Parts, Stopped};

/// The refinement ends at steps of this length, m, and this angle, rad.
pub(super) const FINE: (f64, f64) = (5e-5, 5e-5);

/// How good a place is: first how many poses no single posture reaches, then the largest compliance, m/N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Score {
    pub(super) unreached: usize,
    pub(super) worst: f64,
}

impl Score {
    pub(super) const NONE: Self = Self { unreached: usize::MAX, worst: f64::INFINITY };
    /// No place at which every pose is reached has as much.
    pub(super) const ONE_OUT_OF_REACH: Self = Self { unreached: 1, worst: 0.0 };
    /// Before any pose is looked at.
    pub(super) const LEAST: Self = Self { unreached: 0, worst: 0.0 };

    /// One more pose, of this compliance, infinite where it is not reached.
    pub(super) fn take(&mut self, compliance: f64) {
        if compliance.is_finite() {
            self.worst = self.worst.max(compliance);
        } else {
            self.unreached += 1;
        }
    }

    pub(super) fn is_feasible(&self) -> bool {
        self.unreached == 0
    }

    pub(super) fn total_cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.unreached.cmp(&other.unreached).then(self.worst.total_cmp(&other.worst))
    }
}

/// Those places that are neither this one nor one before them: what a limit holds back moves nowhere.
pub(super) fn others<P: PartialEq>(from: &P, moved: impl Iterator<Item = P>) -> Vec<P> {
    let mut others = Vec::new();
    for place in moved {
        if place != *from && !others.contains(&place) {
            others.push(place);
        }
    }
    others
}

/// The best of a candidate and of all that steps, m, and turns, rad, lead to from there, down to the finest step of an answer. Of what is `moved` and
/// is no better than what it was moved from no more counts than that.
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
