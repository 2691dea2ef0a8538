//! The moves of a path in memory, as long as they are not cut into more samples than that memory has room for.

use super::moves::Move;
use super::samples::Steps;

/// Of one path at home: what a machine of some GB has room for.
pub const MOST_SAMPLES: usize = 10_000_000;

/// Takes moves, counts the samples they will be cut into before any is made, and keeps nothing of a path that has too many.
#[derive(Clone, Debug)]
pub struct Gathered {
    moves: Vec<Move>,
    samples: usize,
    steps: Steps,
    most: usize,
}

/// A path that is cut too finely.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "of {} mm, with chords within {} mm, cuts the path into more than {most} samples; expected longer steps, or a part of the path",
    steps.longest * 1e3, steps.chord * 1e3
)]
pub struct TooManySamples {
    /// How finely.
    pub steps: Steps,
    /// Samples at most.
    pub most: usize,
}

impl Gathered {
    /// Nothing yet; at most so many samples.
    pub const fn new(steps: Steps, most: usize) -> Self {
        Self { moves: Vec::new(), samples: 0, steps, most }
    }

    /// One more move.
    pub fn add(&mut self, one: &Move) {
        if self.is_over() {
            return;
        }
        // A sample at each end.
        self.samples = self.samples.saturating_add(self.steps.pieces(one).saturating_add(1));
        if self.is_over() { self.moves = Vec::new() } else { self.moves.push(*one) }
    }

    /// There are too many: nothing more needs to be read.
    pub const fn is_over(&self) -> bool {
        self.most < self.samples
    }

    /// All moves.
    ///
    /// # Errors
    /// Where they would be cut into too many samples.
    pub fn whole(self) -> Result<Vec<Move>, TooManySamples> {
        if self.is_over() { Err(TooManySamples { steps: self.steps, most: self.most }) } else { Ok(self.moves) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Builtin, samples};
    use super::*;

    #[test]
    fn samples_are_counted_as_they_are_cut_and_of_one_too_many_nothing_is_kept() {
        let moves = "raster:rect:0.4x0.2@0.02".parse::<Builtin>().unwrap().moves(None);
        let steps = Steps { longest: 3e-3, ..Steps::USUAL };
        let cut: usize = moves.iter().map(|one| samples(one, &steps, 0.0).count()).sum();
        let of = |most: usize| {
            let mut gathered = Gathered::new(steps, most);
            for one in &moves {
                gathered.add(one);
            }
            gathered
        };
        assert_eq!(of(cut).whole().unwrap(), moves);
        let over = of(cut - 1);
        assert!(over.is_over() && over.moves.capacity() == 0);
        let why = over.whole().unwrap_err().to_string();
        assert!(why.starts_with("of 3 mm, with chords within 0.01 mm, cuts the path into more than"), "{why}");
    }

    /// A tenth of a micrometre over the longest path there is: the count neither overflows nor takes the time of the samples.
    #[test]
    fn the_count_of_any_path_is_had_without_its_samples() {
        let moves = "raster:rect:50x50@0.0005".parse::<Builtin>().unwrap().moves(None);
        let mut gathered = Gathered::new(Steps { longest: 1e-7, ..Steps::USUAL }, usize::MAX - 1);
        for one in &moves {
            gathered.add(one);
        }
        assert!(!gathered.is_over() && 5_000_000_000_000 < gathered.samples, "{}", gathered.samples);
    }
}
