//! Which rows are right, and which level has them? Each is judged by the other until both stay.

use super::fit::{Fitted, Given, Rows};
use super::level::Level;
use super::robust::{self, Sound};
use super::{CalibrateError, moved};
use crate::chain::Frames;
use crate::registration::{Sight, State};
use crate::watch::Watch;

/// So often at most rows are judged again; then they stand as they were judged last.
const ROUNDS: usize = 8;
/// m and rad: how far frames are off, for a first judgement.
const SCALE: f64 = 0.7e-3;
/// m: the lever of orientations, at first.
const LEVER: f64 = 0.3;

/// What is fitted to what.
pub(super) struct Question<'a> {
    pub(super) arm: &'a Frames,
    /// The arm with its masses, and how far the compliance of each drive may be off, where they are known.
    pub(super) weighed: Option<(&'a Frames, [f64; 6])>,
    /// All rows.
    pub(super) sights: &'a [Sight],
    /// How many stands and points.
    pub(super) shape: (usize, usize),
    pub(super) watch: Watch<'a>,
}

/// All levels, fitted to the rows that are right.
pub(super) struct Judged<'a> {
    pub(super) sound: Sound,
    by_terms: Rows<'a>,
    by_masses: Option<Rows<'a>>,
    /// As drawn, the levels with terms of weight, then those with masses.
    pub(super) fits: Vec<Fitted>,
}

impl<'a> Question<'a> {
    fn rows(&self, sights: &[Sight], lever: f64) -> Rows<'a> {
        let (stands, points) = self.shape;
        // Of single points nothing tells what they share from what each errs by.
        let together = sights.iter().any(|sight| 1 < sight.points.iter().flatten().count());
        Rows { arm: self.arm, drives: None, sights: sights.to_vec(), stands, points, lever, together }
    }

    fn rows_by_masses(&self, sights: &[Sight], lever: f64) -> Option<Rows<'a>> {
        self.weighed.map(|(arm, drives)| Rows { arm, drives: Some(drives), ..self.rows(sights, lever) })
    }

    /// A first judgement, by the level that has the arm's weight: from a state as drawn and the median distance there, m.
    pub(super) fn sound(&self, start: State, off: f64) -> Result<Sound, CalibrateError> {
        let noise = robust::noise_of(off).max(1e-6);
        let given = Given { prior: &Level::Weight.prior(SCALE, None), noise, common: 0.0 };
        let found = robust::sound(self.rows(self.sights, LEVER), given, start);
        found.ok_or(CalibrateError::Undetermined)
    }

    /// From which row on the instrument stands elsewhere, and how far, m. Of all rows: those before it or from it on may be too few
    /// to be right.
    pub(super) fn moved(&self, sound: &Sound) -> Result<Option<(usize, f64)>, CalibrateError> {
        // Where the instrument has moved, all points of a row are off together: that must not pass for the arm's own.
        let every = Rows { together: false, ..self.rows(&sound.every, sound.lever) };
        let fitted =
            every.fitted(Some(Level::Weight), &sound.state, sound.noise).ok_or(CalibrateError::Undetermined)?;
        Ok(moved::moved(&every, &fitted))
    }

    /// Fits all levels to rows that are right.
    fn fitted(&self, sound: Sound) -> Result<Judged<'a>, CalibrateError> {
        let by_terms = self.rows(&sound.sights, sound.lever);
        let by_masses = self.rows_by_masses(&sound.sights, sound.lever);
        let levels = std::iter::once(None).chain(Level::ALL.map(Some)).map(|level| (&by_terms, level));
        let of_masses =
            by_masses.iter().flat_map(|rows| [Level::Weight, Level::Gears].map(|level| (rows, Some(level))));
        let mut fits = Vec::new();
        for (rows, level) in levels.chain(of_masses) {
            self.watch.go_on()?;
            fits.push(rows.fitted(level, &sound.state, sound.noise).ok_or(CalibrateError::Undetermined)?);
        }
        Ok(Judged { sound, by_terms, by_masses, fits })
    }

    /// Judges all rows by the level with the largest evidence, those that were left out by a coarser one, too, and fits the levels again,
    /// until neither the rows nor the level change. `is_too_much` refuses a table with too many wrong rows.
    pub(super) fn judged(
        &self,
        sound: Sound,
        is_too_much: &dyn Fn(&Sound) -> Result<(), CalibrateError>,
    ) -> Result<Judged<'a>, CalibrateError> {
        is_too_much(&sound)?;
        let mut found = self.fitted(sound)?;
        let mut by = (Some(Level::Weight), false);
        for _ in 0..ROUNDS {
            let best = found.best(None).ok_or(CalibrateError::Undetermined)?;
            let (rows, fitted) = (found.rows(best), &found.fits[best]);
            let is_by_masses = rows.drives.is_some();
            let all = Rows { arm: rows.arm, drives: rows.drives, ..self.rows(self.sights, rows.lever) };
            let again = robust::sound(all, fitted.given(), fitted.state.clone()).ok_or(CalibrateError::Undetermined)?;
            if again.wrong == found.sound.wrong && by == (fitted.level, is_by_masses) {
                break;
            }
            is_too_much(&again)?;
            by = (fitted.level, is_by_masses);
            found = self.fitted(again)?;
        }
        Ok(found)
    }
}

impl<'a> Judged<'a> {
    /// The rows of a fit.
    pub(super) fn rows(&self, fit: usize) -> &Rows<'a> {
        let is_by_masses = Level::ALL.len() < fit;
        self.by_masses.as_ref().filter(|_| is_by_masses).unwrap_or(&self.by_terms)
    }

    /// The fit with the largest evidence, of a level where one is asked for; as drawn is none.
    pub(super) fn best(&self, level: Option<Level>) -> Option<usize> {
        let is_asked = |i: &usize| {
            let of = self.fits[*i].level;
            of.is_some() && level.is_none_or(|level| of == Some(level))
        };
        let asked = (0..self.fits.len()).filter(is_asked);
        asked.max_by(|&i, &j| self.fits[i].evidence.total_cmp(&self.fits[j].evidence))
    }

    /// What is left out: row, point and how far a fit has it off, m.
    pub(super) fn left_out(&self, fit: usize, all: &[Sight]) -> Vec<(usize, usize, f64)> {
        let off = robust::rows_distances(self.rows(fit), &self.fits[fit].state, all);
        off.into_iter().filter(|(row, point, _)| self.sound.wrong.contains(&(*row, *point))).collect()
    }
}
