//! Which rows are wrong? A start by random subsets, weights of Student's t, and what is left beyond five robust sigma.

use nalgebra::Vector3;

use super::fit::{Given, Rows};
use crate::chain::Frames;
use crate::parallel;
use crate::registration::{Linear, Sight, State};

/// Degrees of freedom of Student's t.
const FREEDOM: f64 = 4.0;
/// A distance beyond so many robust standard deviations is wrong.
const WRONG: f64 = 5.0;
/// The median distance of three normal coordinates of deviation 1: the root of the median of chi squared with 3 degrees of freedom.
const MEDIAN: f64 = 1.538_172;
/// m: what is no more off is not wrong, however well all else fits.
const LEAST_WRONG: f64 = 20e-6;
/// Of the rows, at most so many are left out.
pub(super) const MOST_WRONG: f64 = 1.0 / 3.0;

/// A point of a row that is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongRow {
    /// Its line in the file.
    pub line: usize,
    /// Which point, from 1; 0 where all of the row is wrong.
    pub point: usize,
    /// How far it is off with what was found, m.
    pub distance: f64,
}

/// Subsets that are tried: with a third of rows wrong one of eight is right, so that none is with a chance of 3e-5.
pub(super) const SUBSETS: usize = 80;

/// Rows of which those that are wrong are left out.
pub(super) struct Sound {
    /// Of what is left every point counts alike: Student's weights would have the noise and all intervals too small by a sixth.
    pub(super) sights: Vec<Sight>,
    /// All rows with their weights, those that are wrong, too.
    pub(super) every: Vec<Sight>,
    pub(super) state: State,
    /// Standard deviation of a coordinate of a point, m.
    pub(super) noise: f64,
    pub(super) lever: f64,
    /// Which row of the table each of `sights` is; rows without a sound point are left out.
    pub(super) index: Vec<usize>,
    /// Row of the table and point of each that is left out.
    pub(super) wrong: Vec<(usize, usize)>,
}

/// A state as drawn that most rows agree with: the best of random subsets by the median of distances.
pub(super) fn start(
    arm: &Frames,
    sights: &[Sight],
    (stands, points): (usize, usize),
    subsets: usize,
) -> Option<(State, f64)> {
    const OF: usize = 5;
    /// Rows by which subsets are judged.
    const JUDGES: usize = 200;
    let mut rng = fastrand::Rng::with_seed(38);
    let by_stand: Vec<Vec<usize>> =
        (0..stands).map(|stand| (0..sights.len()).filter(|&i| sights[i].stand == stand).collect()).collect();
    let step = sights.len().div_ceil(JUDGES);
    let judges: Vec<Sight> = sights.iter().step_by(step).cloned().collect();
    let rows = |sights: Vec<Sight>| Rows { arm, drives: None, sights, stands, points, lever: 0.3, together: false };
    let judging = rows(judges);
    let mut subset = || {
        let mut chosen = Vec::new();
        for stand in &by_stand {
            let mut some = stand.clone();
            rng.shuffle(&mut some);
            chosen.extend(some.into_iter().take(OF));
        }
        chosen.into_iter().map(|i| sights[i].clone()).collect()
    };
    let subsets: Vec<Vec<Sight>> = (0..subsets).map(|_| subset()).collect();
    let judged = parallel::each(&subsets, |subset| {
        if (0..points).any(|j| subset.iter().all(|sight| sight.points[j].is_none())) {
            return None;
        }
        let state = rows(subset.clone()).start();
        let off = median(distances(&judging.drawn(&state)).into_iter().map(|(_, _, off)| off).collect());
        off.is_finite().then_some((state, off))
    });
    // Of equals the first.
    judged.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The median distance of an arm that was fitted over the standard deviation of a coordinate is this.
pub(super) fn noise_of(off: f64) -> f64 {
    off / MEDIAN
}

/// Weights, noise and wrong rows of all rows under what is given, from a state and a noise near theirs.
///
/// Rows that are wrong take part with their small weights: none is judged by whether it was left out before.
///
/// Nothing where rows and prior leave a parameter open.
pub(super) fn sound(mut rows: Rows, given: Given, mut state: State) -> Option<Sound> {
    const ROUNDS: usize = 25;
    let all = rows.sights.clone();
    let mut noise = given.coordinate();
    let of_readings = |noise: f64| Given { noise: noise / (1.0 + given.common).sqrt(), ..given };
    for _ in 0..ROUNDS {
        let off = rows_distances(&rows, &state, &all);
        weigh(&mut rows.sights, &all, &off, noise);
        let (next, linear) = rows.solved(state, of_readings(noise));
        state = next;
        let middle = median(distances(&linear).into_iter().map(|(_, _, off)| off).collect());
        // What was fitted has taken its part of every distance.
        let left = rows.left(&linear, &state, of_readings(noise))?;
        let next_noise = (noise_of(middle) / left.sqrt()).max(1e-7);
        rows.lever = balanced(&linear, rows.lever, next_noise);
        let is_settled = (next_noise / noise - 1.0).abs() < 1e-3;
        noise = next_noise;
        if is_settled {
            break;
        }
    }
    let off = rows_distances(&rows, &state, &all);
    let limit = (WRONG * noise).max(LEAST_WRONG);
    let is_wrong = |(_, _, off): &&(usize, usize, f64)| !(*off <= limit);
    let wrong: Vec<(usize, usize)> = off.iter().filter(is_wrong).map(|(row, point, _)| (*row, *point)).collect();
    let (mut kept, mut every) = (all.clone(), all.clone());
    weigh(&mut every, &all, &off, noise);
    for (row, point) in &wrong {
        kept[*row].points[*point] = None;
    }
    let index: Vec<usize> = (0..kept.len()).filter(|&i| kept[i].points.iter().any(Option::is_some)).collect();
    let sights = index.iter().map(|&i| kept[i].clone()).collect();
    Some(Sound { sights, every, state, noise, lever: rows.lever, index, wrong })
}

/// Points of a row that all are wrong are reported as one.
pub(super) fn wrong_rows(wrong: &[(usize, usize, f64)], sights: &[Sight], lines: &[usize]) -> Vec<WrongRow> {
    let mut found: Vec<WrongRow> = Vec::new();
    for (row, point, distance) in wrong {
        let of_row = wrong.iter().filter(|(other, _, _)| other == row);
        let is_whole = of_row.count() == sights[*row].points.iter().flatten().count();
        let line = lines[*row];
        match found.last_mut().filter(|last| is_whole && last.line == line) {
            Some(last) => last.distance = last.distance.max(*distance),
            None => found.push(WrongRow { line, point: if is_whole { 0 } else { point + 1 }, distance: *distance }),
        }
    }
    found
}

/// Row, point and distance of every point of all rows.
pub(super) fn rows_distances(rows: &Rows, state: &State, all: &[Sight]) -> Vec<(usize, usize, f64)> {
    let of_all = Rows { sights: all.to_vec(), ..*rows };
    distances(&of_all.linear(state))
}

/// The same of rows as they stand about a state.
pub(super) fn distances(rows: &[Linear]) -> Vec<(usize, usize, f64)> {
    let mut found = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        found.extend(row.points().map(|(at, point)| (i, point, row.residual.rows(at, 3).norm())));
    }
    found
}

/// Student's weights: `(nu + 3) / (nu + |r|^2 / s^2)`.
fn weigh(sights: &mut [Sight], all: &[Sight], off: &[(usize, usize, f64)], noise: f64) {
    for (row, point, distance) in off {
        let weight = (FREEDOM + 3.0) / (FREEDOM + (distance / noise).powi(2));
        sights[*row].points[*point] = all[*row].points[*point].map(|(at, _)| (at, weight));
    }
}

/// The lever with which orientations are off by as much as points.
fn balanced(rows: &[Linear], lever: f64, noise: f64) -> f64 {
    /// m.
    const WITHIN: [f64; 2] = [0.02, 3.0];
    let turns = rows.iter().flat_map(|row| {
        row.of.iter().enumerate().filter(|(_, point)| point.is_none()).map(|(block, _)| {
            let off: Vector3<f64> = row.residual.fixed_rows::<3>(3 * block).into();
            off.norm()
        })
    });
    let turns: Vec<f64> = turns.collect();
    if turns.is_empty() {
        return lever;
    }
    let off = noise_of(median(turns)) / lever;
    (noise / off.max(1e-9)).clamp(WITHIN[0], WITHIN[1])
}

pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::INFINITY)
}
