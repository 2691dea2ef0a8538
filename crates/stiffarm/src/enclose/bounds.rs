//! What does every placement of a node have in common?

use super::affine::Affine;
use crate::batch::AngularInterval;
use crate::tolerances;

/// Affine forms that hold at every placement of a node, of some poses of the zone held in one arm branch.
#[derive(Clone, Debug)]
pub(crate) struct NodeBounds<const N: usize> {
    /// Lower bounds on the largest translation per force, m/N, wherever the poses are held.
    pub(crate) values: Vec<Affine<N>>,
    /// Not negative wherever the poses are held.
    pub(crate) limits: Vec<Affine<N>>,
}

impl<const N: usize> Default for NodeBounds<N> {
    fn default() -> Self {
        Self { values: Vec::new(), limits: Vec::new() }
    }
}

impl<const N: usize> NodeBounds<N> {
    /// Adds that `x` is not negative; `None` where it is negative for certain.
    pub(crate) fn require(&mut self, x: Affine<N>) -> Option<()> {
        if x.max() < -tolerances::PROOF {
            return None;
        }
        if x.min() < 0.0 {
            self.limits.push(x + tolerances::PROOF);
        }
        Some(())
    }

    /// Adds that the angle of a vector of that length, with cosine and sine times the length, lies in the interval.
    pub(super) fn require_in(
        &mut self,
        interval: &AngularInterval,
        cos: Affine<N>,
        sin: Affine<N>,
        length: Affine<N>,
    ) -> Option<()> {
        interval.room(cos, sin, length).map_or(Some(()), |room| self.require(room))
    }
}
