//! A zone seen along the tool axis: how far the tool is pushed off at each of its points.

use stiffarm::task::Zone;

use super::axes::{Axis, Frame};
use super::bands::{Bands, Colours, Field};
use super::canvas::{Canvas, Font, Px};
use super::contour::Grid;
use super::labels::Occupied;
use super::line::Node;
use super::scene::{draw_rim, rim, worst_mark};

/// The longer side of the diagram, px.
const SIDE: f64 = 400.0;
/// Room around the zone as a share of it.
const ROOM: f64 = 0.12;

/// The deflection across a zone.
pub(crate) struct FaceFigure {
    /// What was sampled.
    pub zone: Zone,
    /// Angle of the first side from `up`, rad, to the left.
    pub angle: f64,
    /// Deflections, mm, row by row over the square of [`Zone::at`]: as many rows as columns.
    pub cells: Vec<Option<f64>>,
    /// Rows, and columns.
    pub per_side: usize,
    /// Where the upper end of the diagram is.
    pub up: &'static str,
    /// What the colours mean, with the unit mm.
    pub colour_label: String,
}

impl FaceFigure {
    /// Draws it below `top` in colours over the range that was asked for; returns where it ends.
    pub(crate) fn draw(&self, canvas: &mut Canvas, top: f64, scale: Option<[f64; 2]>) -> f64 {
        let top = top + 26.0;
        let frame = self.frame(canvas.width, top);
        let [[_, bottom], [right, _]] = frame.corners();
        let middle = canvas.width / 2.0;
        canvas.text([middle, top - 12.0], "inside the zone, seen along the tool axis", Font::new(13.0).bold().middle());
        let grid = Grid::new(self.per_side, self.per_side, |i, j| self.cells[j * self.per_side + i]);
        let node = |[i, j]: Node| [i, j].map(|k| 2.0 * k / (self.per_side - 1) as f64 - 1.0);
        let on_page = |point: [f64; 2]| {
            let [right, up] = self.on_page(point);
            frame.at(right, up)
        };
        let at = |at: Node| on_page(self.zone.at(node(at)));
        if let Some(extremes) = grid.extremes() {
            let bands = Bands::within(scale, extremes, Colours::Deflections);
            let region = [border(self.per_side)];
            let mut occupied = Occupied::default();
            let worst = at(self.worst());
            occupied.take(&[worst; 2], 12.0);
            Field { grid: &grid, region: &region, bands, tolerance: None, at: &at }.draw(
                canvas,
                Font::new(12.0),
                &mut occupied,
            );
            draw_rim(canvas, &rim(self.zone, [0.0; 2], 0.0).into_iter().map(on_page).collect::<Vec<Px>>());
            worst_mark(canvas, worst);
            bands.bar(canvas, [right + 28.0, bottom - 12.0], [right + 50.0, top + 12.0], &self.colour_label);
        }
        frame.draw(canvas, "to the right of its centre [m]", &format!("{} [m]", self.up));
        bottom + 56.0
    }

    /// Right and up on the page of a point given along the sides, m from the centre.
    fn on_page(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.angle.sin_cos();
        [-(u * s + v * c), u * c - v * s]
    }

    /// The node with the largest deflection.
    fn worst(&self) -> Node {
        let known = self.cells.iter().enumerate().filter_map(|(i, mm)| Some((i, (*mm)?)));
        let (at, _) = known.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        [(at % self.per_side) as f64, (at / self.per_side) as f64]
    }

    /// Equal scales on both axes, in the middle of the sheet.
    fn frame(&self, width: f64, top: f64) -> Frame {
        let points: Vec<[f64; 2]> =
            rim(self.zone, [0.0; 2], 0.0).into_iter().map(|point| self.on_page(point)).collect();
        let far = [0, 1].map(|k| points.iter().map(|point| point[k].abs()).fold(0.0, f64::max));
        let room = ROOM * far[0].max(far[1]);
        // A slender zone still gets a frame with room for titles.
        let half = far.map(|half| (half + room).max(0.5 * far[0].max(far[1])));
        let scale = SIDE.min(width - 300.0) / (2.0 * half[0].max(half[1]));
        let [wide, high] = half.map(|half| scale * 2.0 * half);
        let left = (width - wide) / 2.0;
        Frame {
            x: Axis::new(-half[0], half[0], [left, left + wide]),
            y: Axis::new(-half[1], half[1], [top + high, top]),
        }
    }
}

/// Around the whole grid, node by node.
fn border(per_side: usize) -> Vec<Node> {
    let last = (per_side - 1) as f64;
    let along = || (0..per_side - 1).map(|i| i as f64);
    let mut line: Vec<Node> = along().map(|i| [i, 0.0]).collect();
    line.extend(along().map(|i| [last, i]));
    line.extend(along().map(|i| [last - i, last]));
    line.extend(along().map(|i| [0.0, last - i]));
    line.push([0.0; 2]);
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(angle: f64) -> FaceFigure {
        let zone = Zone::Rectangle { width: 0.4, height: 0.2 };
        let cells = (0..25).map(|i| Some(f64::from(i % 5))).collect();
        FaceFigure { zone, angle, cells, per_side: 5, up: "ahead", colour_label: "worst [mm]".into() }
    }

    #[test]
    fn the_first_side_runs_up_the_page_and_turns_to_the_left() {
        assert_eq!(face(0.0).on_page([1.0, 0.0]), [-0.0, 1.0]);
        assert_eq!(face(0.0).on_page([0.0, 1.0]), [-1.0, 0.0], "the second side to the left");
        let [right, up] = face(std::f64::consts::FRAC_PI_2).on_page([1.0, 0.0]);
        assert!((right + 1.0).abs() < 1e-12 && up.abs() < 1e-12);
    }

    #[test]
    fn the_worst_node_is_where_the_largest_value_is() {
        let mut face = face(0.0);
        face.cells[13] = Some(9.0);
        face.cells[20] = None;
        assert_eq!(face.worst(), [3.0, 2.0]);
    }

    #[test]
    fn a_metre_is_as_long_on_both_axes() {
        let frame = face(0.3).frame(1000.0, 0.0);
        let per_metre = [frame.x, frame.y].map(|axis| ((axis.px[1] - axis.px[0]) / (axis.to - axis.from)).abs());
        assert!((per_metre[0] / per_metre[1] - 1.0).abs() < 1e-12);
    }
}
