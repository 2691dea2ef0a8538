//! Lines over a grid.

/// A point in units of the grid: column and row, with fractions.
pub(crate) type Node = [f64; 2];

/// Points in order, the area meant on their left; a closed line ends where it begins.
pub(crate) type Line = Vec<Node>;

/// The area within a closed line, negative where it lies on the right.
pub(crate) fn area(ring: &[Node]) -> f64 {
    ring.windows(2).map(|p| p[0][0] * p[1][1] - p[1][0] * p[0][1]).sum::<f64>() / 2.0
}
