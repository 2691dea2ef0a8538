//! Which open node of a branch and bound comes next? The one whose key is least.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A part of what is searched, of which something is proved.
pub(crate) trait Node {
    /// What is least comes first; of equals that whose second key is least. Never NaN.
    fn key(&self) -> [f64; 2];
}

/// Open nodes; the one with the least key is taken first.
#[derive(Clone, Debug)]
pub(crate) struct Frontier<T>(BinaryHeap<Ordered<T>>);

#[derive(Clone, Debug)]
struct Ordered<T>(T);

impl<T: Node> Ord for Ordered<T> {
    /// A heap hands out the greatest first.
    fn cmp(&self, other: &Self) -> Ordering {
        let ([first, second], [other_first, other_second]) = (self.0.key(), other.0.key());
        other_first.total_cmp(&first).then(other_second.total_cmp(&second))
    }
}
impl<T: Node> PartialOrd for Ordered<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<T: Node> PartialEq for Ordered<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl<T: Node> Eq for Ordered<T> {}

impl<T: Node> Frontier<T> {
    /// Nothing is open.
    pub(crate) fn new() -> Self {
        Self(BinaryHeap::new())
    }

    /// Opens a node.
    pub(crate) fn push(&mut self, node: T) {
        self.0.push(Ordered(node));
    }

    /// The next node, which is open no more.
    pub(crate) fn pop(&mut self) -> Option<T> {
        self.0.pop().map(|Ordered(node)| node)
    }

    /// All that are open, in no order.
    pub(crate) fn into_nodes(self) -> impl Iterator<Item = T> {
        self.0.into_iter().map(|Ordered(node)| node)
    }
}

impl<T: Node> Extend<T> for Frontier<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, nodes: I) {
        self.0.extend(nodes.into_iter().map(Ordered));
    }
}

impl<T: Node> FromIterator<T> for Frontier<T> {
    fn from_iter<I: IntoIterator<Item = T>>(nodes: I) -> Self {
        Self(nodes.into_iter().map(Ordered).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Node for [f64; 2] {
        fn key(&self) -> [f64; 2] {
            *self
        }
    }

    #[test]
    fn nodes_are_taken_in_the_order_of_their_keys() {
        let mut open: Frontier<[f64; 2]> = [[2.0, 0.0], [-1.0, 3.0]].into_iter().collect();
        open.extend([[f64::NEG_INFINITY, 1.0], [-1.0, -3.0]]);
        open.push([0.5, 0.0]);
        let taken: Vec<[f64; 2]> = std::iter::from_fn(|| open.pop()).collect();
        assert_eq!(taken, [[f64::NEG_INFINITY, 1.0], [-1.0, -3.0], [-1.0, 3.0], [0.5, 0.0], [2.0, 0.0]]);
    }
}
