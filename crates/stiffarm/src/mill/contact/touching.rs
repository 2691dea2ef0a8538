//! What of a ladder touches something.

use std::collections::{BTreeMap, HashSet};

use super::Contact;

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
    /// Rungs to which no edge leads, with what the tool touches on the way whatever the roll.
    pub(super) shut: BTreeMap<usize, Contact>,
    /// What was looked at, touching or not.
    pub(super) known_nodes: HashSet<OfRung>,
    pub(super) known_edges: HashSet<Edge>,
}

/// What was found of a node or an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::mill) enum Touched {
    Nothing,
    Something,
    /// The tool, which is round, touches what stands about the arm: so it does whatever the roll and the configuration.
    AtEveryRoll(Contact),
}

impl Touching {
    /// No path may take this edge.
    pub(in crate::mill) fn blocks(&self, edge: Edge) -> bool {
        (!self.edges.is_empty() && self.edges.contains(&edge))
            || (!self.shut.is_empty() && self.shut.contains_key(&edge.0))
    }
}
