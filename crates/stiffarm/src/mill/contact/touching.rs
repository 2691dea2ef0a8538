//! What of a ladder touches something.

use std::collections::HashSet;

/// A rung, and a node of it by configuration and roll.
pub(in crate::mill) type OfRung = (usize, usize);
/// A rung, a node of the rung before, and one of its own.
pub(in crate::mill) type Edge = (usize, usize, usize);

/// Nodes and edges that touch, and all that were looked at.
#[derive(Clone, Debug, Default)]
pub(in crate::mill) struct Touching {
    /// With the errors that they had, m; theirs are infinite.
    pub(super) nodes: Vec<(OfRung, f32)>,
    pub(super) edges: HashSet<Edge>,
    /// What was looked at, touching or not.
    pub(super) known_nodes: HashSet<OfRung>,
    pub(super) known_edges: HashSet<Edge>,
}

/// How something is known to touch.
#[derive(Clone, Copy, Debug)]
pub(in crate::mill) struct Touch {
    pub(super) station: usize,
    /// A posture in which it does, by its model angles, rad.
    pub(super) theta: [f64; 6],
    /// Two bodies are no farther apart there, m; infinite where nothing follows from that for postures beside it.
    pub(super) distance: f64,
}

impl Touching {
    /// No path may take this edge.
    pub(in crate::mill) fn blocks(&self, edge: Edge) -> bool {
        !self.edges.is_empty() && self.edges.contains(&edge)
    }
}
