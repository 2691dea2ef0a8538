//! The compliance map of an arm: bands of deflection, the arm, and where the work stands.

use crate::answer::Unit;
use stiffarm::map::Grid as Mapped;
use stiffarm::palette::TOLERANCE;
use stiffarm::plane::{ElbowSide, PlanarArm};

use super::axes::{Frame, heading};
use super::bands::{Bands, Colours, Field, TOLERANCE_LINE};
use super::canvas::{Canvas, Font, Px, rect_path};
use super::contour::Grid;
use super::face::FaceFigure;
use super::labels::Occupied;
use super::legend::{Entry, Legend};
use super::line::{Line, Node, area};
use super::scene::Scene;
use super::sheets::{Part, Ways, parts};
use super::{FigureError, FigureSize};

/// No more grid points per side are drawn: finer than the pixels of a large print.
const MOST_POINTS: usize = 800;

/// The edge of the mapped area is searched for on at least this many points per side.
const EDGE_POINTS: usize = 300;

/// A map with what it is needed for.
pub(crate) struct MapFigure<'a> {
    /// First line.
    pub title: String,
    /// Second line, in grey.
    pub subtitle: String,
    /// What is drawn, such as deflections, m.
    pub map: &'a Mapped,
    /// The unit in which its values are shown.
    pub unit: Unit,
    /// What its colours stand for.
    pub colours: Colours,
    /// What the work allows, in that unit: a line.
    pub tolerance: Option<f64>,
    /// What was asked of the figure.
    pub figure_size: FigureSize,
    /// The arm whose plane was mapped, with its joint-2 axis, where it says exactly where the mapped area ends.
    pub edge: Option<(&'a PlanarArm, [f64; 2])>,
    /// In space how every point is held.
    pub ways: Option<Ways<'a>>,
    /// Arm, base and zone in the axes of the map.
    pub scene: Scene,
    /// What the colours mean, with the unit.
    pub colour_label: String,
    /// What lengths are measured from.
    pub origin: &'static str,
    /// The zone seen along the tool axis, below the map.
    pub face: Option<FaceFigure>,
}

impl MapFigure<'_> {
    /// The figure as SVG text.
    #[expect(clippy::unnecessary_wraps, reason = "all figures are called alike")]
    pub(crate) fn svg(&self) -> Result<String, FigureError> {
        let scene = &self.scene;
        let mut canvas = Canvas::of(&self.figure_size);
        let legend = Legend::new(self.entries(), canvas.width - 80.0, 4);
        let top = heading(&mut canvas, &self.title, &self.subtitle) + 26.0;
        let frame = scene.frame(self.reached().to_vec(), canvas.width, top);
        let [[_, bottom], [right, _]] = frame.corners();
        if let Some(bands) = self.draw_inside(&mut canvas, &frame, None) {
            let height = (bottom - top).min(520.0);
            let middle = f64::midpoint(bottom, top);
            let ends = [middle + height / 2.0, middle - height / 2.0];
            bands.bar(&mut canvas, [right + 28.0, ends[0]], [right + 50.0, ends[1]], &self.colour_label);
        }
        self.draw_frame(&mut canvas, &frame);
        let per_m = (frame.x.px[1] - frame.x.px[0]) / (frame.x.to - frame.x.from);
        canvas.tell_scale([frame.x.px[0], frame.y.px[0]], [frame.x.from, frame.y.from], per_m);
        canvas.tell_box("map", [[frame.x.px[0], top], [right, bottom]], [frame.x.from, frame.x.to]);
        legend.draw(&mut canvas, [40.0, bottom + 52.0]);
        canvas.height = bottom + 66.0 + legend.height();
        if let Some(face) = &self.face {
            let top = canvas.height + 10.0;
            canvas.height = face.draw(&mut canvas, top, self.figure_size.ends());
        }
        Ok(canvas.finish())
    }

    /// Map, arm and zone inside a frame, in these bands of colour or in those that the map asks for; which they are, where anything is
    /// reached.
    pub(crate) fn draw_inside(&self, canvas: &mut Canvas, frame: &Frame, bands: Option<Bands>) -> Option<Bands> {
        let scene = &self.scene;
        let [[left, bottom], [right, top]] = frame.corners();
        let inside = rect_path([left, bottom], [right, top]);
        canvas.clipped(&inside, |canvas| scene.floor(canvas, frame));
        let bands = self.draw_field(canvas, frame, bands);
        canvas.clipped(&inside, |canvas| {
            scene.draw_base(canvas, frame);
            scene.draw_cell(canvas, frame);
            scene.draw_zone(canvas, frame);
            scene.draw_arm(canvas, frame);
            scene.draw_worst_point(canvas, frame);
            scene.draw_force(canvas, frame);
        });
        bands
    }

    /// The frame, and what its axes are.
    pub(crate) fn draw_frame(&self, canvas: &mut Canvas, frame: &Frame) {
        frame.draw(canvas, &format!("x from {} [m]", self.origin), &format!("z from {} [m]", self.origin));
    }

    /// The least and the largest of what is drawn, in its unit; nothing where nothing is reached.
    pub(crate) fn extremes(&self) -> Option<[f64; 2]> {
        let [least, most] = self.map.extremes()?;
        Some([least, most].map(|(value, ..)| self.unit.of_si(value)))
    }

    pub(crate) fn entries(&self) -> Vec<Entry> {
        let mut entries = self.scene.entries();
        // Where all is stiffer, or all is softer, there is no line.
        let is_crossed =
            |tolerance: &f64| self.extremes().is_some_and(|[least, most]| (least..=most).contains(tolerance));
        if let Some(tolerance) = self.tolerance.filter(is_crossed) {
            let look = format!(r#"{TOLERANCE_LINE} stroke="{TOLERANCE}""#);
            entries.insert(0, Entry::line(format!("tolerance {tolerance} mm"), look));
        }
        entries
    }

    /// Left bottom and right top of what is mapped, with a margin, m; of the whole grid where nothing is reached.
    pub(crate) fn reached(&self) -> [[f64; 2]; 2] {
        let (x, z) = (self.map.x, self.map.z);
        let last = |axis: stiffarm::map::Axis| axis.at(axis.count.saturating_sub(1));
        let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for j in 0..z.count {
            let reached = |(i, cell): (usize, Option<f64>)| cell.map(|_| x.at(i));
            for x in self.map.row(j).enumerate().filter_map(reached) {
                ends = [[ends[0][0].min(x), ends[0][1].min(z.at(j))], [ends[1][0].max(x), ends[1][1].max(z.at(j))]];
            }
        }
        if !ends[0][0].is_finite() {
            return [[x.start, z.start], [last(x), last(z)]];
        }
        let margin = 0.04 * (ends[1][0] - ends[0][0]).max(ends[1][1] - ends[0][1]) + x.step.min(z.step);
        [ends[0].map(|end| end - margin), ends[1].map(|end| end + margin)]
    }

    fn draw_field(&self, canvas: &mut Canvas, frame: &Frame, bands: Option<Bands>) -> Option<Bands> {
        let (x, z) = (self.map.x, self.map.z);
        let stride = x.count.max(z.count).div_ceil(MOST_POINTS).max(1);
        let last = |count: usize| count.saturating_sub(1);
        // The last point is always kept, so that the map does not shrink.
        let index = |i: usize, count: usize| (i * stride).min(last(count));
        let count = |count: usize| last(count).div_ceil(stride) + 1;
        let grid = Grid::new(count(x.count), count(z.count), |i, j| {
            Some(self.unit.of_si(self.map.get(index(i, x.count), index(j, z.count))?))
        });
        let [[_, bottom], [right, top]] = frame.corners();
        let Some(extremes) = grid.extremes() else {
            let middle = [f64::midpoint(frame.x.px[0], right), f64::midpoint(bottom, top)];
            canvas.text(middle, "nothing on this grid is reached", Font::new(14.0).middle());
            return None;
        };
        let between = |at: f64, axis: stiffarm::map::Axis| {
            let (below, share) = (at.floor(), at.fract());
            let [a, b] = [0, 1].map(|k| axis.at(index(below as usize + k, axis.count)));
            a + share * (b - a)
        };
        let metres = |[i, j]: Node| [between(i, x), between(j, z)];
        let at = |node: Node| {
            let [x, z] = metres(node);
            frame.at(x, z)
        };
        let bands = bands.unwrap_or_else(|| Bands::within(self.figure_size.ends(), extremes, self.colours));
        let parts = match (&self.ways, self.edge) {
            (Some(ways), _) => {
                let held = |i, j| (ways.at)(index(i, x.count), index(j, z.count));
                parts(&grid, 0.5 * bands.step, &held, &|node| ways.between.held(metres(node)))
            }
            (None, Some(edge)) => vec![Part { region: region(&grid, edge, &metres), grid }],
            (None, None) => vec![Part { region: grid.smooth_outline(), grid }],
        };
        let mut occupied = Occupied::default();
        for line in self.scene.covered(frame) {
            occupied.take(&line, 9.0);
        }
        // All of the field lies below its parts, so that no gap shows between them.
        let mut lines = self.field(&parts[0], bands, &at).fill(canvas);
        if 1 < parts.len() {
            lines = parts[1..].iter().flat_map(|part| self.field(part, bands, &at).fill(canvas)).collect();
        }
        self.field(&parts[0], bands, &at).label(canvas, &lines, Font::new(12.0), &mut occupied);
        Some(bands)
    }
}

impl MapFigure<'_> {
    fn field<'p>(&self, part: &'p Part, bands: Bands, at: &'p dyn Fn(Node) -> Px) -> Field<'p> {
        Field { grid: &part.grid, region: &part.region, bands, tolerance: self.tolerance, at }
    }
}

/// The mapped area. Its edge between two grid points is asked of the arm, so it is as sharp as the arm's own limits.
///
/// A map does not say of which elbow side it is: it is taken to be of those sides that reach what it holds. Where no
/// choice agrees with the map, the edge is smoothed instead.
fn region(grid: &Grid, (arm, [ahead, up]): (&PlanarArm, [f64; 2]), metres: &dyn Fn(Node) -> [f64; 2]) -> Vec<Line> {
    let sides = arm.sides().unwrap_or_default();
    let mut choices = vec![sides.clone()];
    choices.extend([0, 1].map(|k| {
        let elbow = sides.first().map(|side| side.elbow);
        sides.iter().filter(|side| (Some(side.elbow) == elbow) == (k == 0)).cloned().collect()
    }));
    let reached = |sides: &[ElbowSide], node: Node| {
        let [x, z] = metres(node);
        sides.iter().any(|side| side.reaches([x - ahead, z - up].into()))
    };
    let sampled = (grid.rows.max(grid.columns) / 150).max(1);
    let agrees = |sides: &Vec<ElbowSide>| {
        (0..grid.rows).step_by(sampled).all(|j| {
            let agrees = |i| grid.get(i as i64, j as i64).is_some() == reached(sides, [i as f64, j as f64]);
            (0..grid.columns).step_by(sampled).all(agrees)
        })
    };
    let Some(sides) = choices.into_iter().find(agrees) else { return grid.smooth_outline() };
    edge(grid.columns, grid.rows, &|node| reached(&sides, node))
}

/// The edge of what is reached on a grid, as sharp as `reached` itself.
pub(crate) fn edge(columns: usize, rows: usize, reached: &dyn Fn(Node) -> bool) -> Vec<Line> {
    // A coarse grid would cut the corners of the area.
    let split = EDGE_POINTS.div_ceil(rows.max(columns)).max(1);
    let coarse = |node: Node| node.map(|i| i / split as f64);
    let fine = |count: usize| (count - 1) * split + 1;
    let inside = |i: usize, j: usize| reached(coarse([i as f64, j as f64])).then_some(1.0);
    let mut rings = Grid::new(fine(columns), fine(rows), inside).outline(|inside, outside| {
        let at = |share: f64| [0, 1].map(|k| inside[k] as f64 + share * (outside[k] - inside[k]) as f64);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..12 {
            let middle = f64::midpoint(low, high);
            if reached(coarse(at(middle))) { low = middle } else { high = middle }
        }
        low
    });
    rings.iter_mut().flatten().for_each(|node| *node = coarse(*node));
    // Where the area thins out to less than a cell, the grid leaves specks of it.
    let largest = rings.iter().map(|ring| area(ring).abs()).fold(0.0, f64::max);
    rings.retain(|ring| 1e-4 * largest <= area(ring).abs());
    rings
}

#[cfg(test)]
mod tests {
    use stiffarm::drive::Architecture;
    use stiffarm::interval::Interval;
    use stiffarm::load::{Component, Load};
    use stiffarm::map::{self, Extent, MapOptions};
    use stiffarm::model::Model;

    use stiffarm::task::Zone;

    use super::super::is_svg;
    use super::super::scene::{ZoneMark, links, rim};
    use super::*;

    fn arm() -> PlanarArm {
        let limits = |a, b| Interval::spanning(a, b);
        let free = PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, Architecture::Serial);
        PlanarArm { shoulder: limits(0.2, 2.4), elbow: limits(-2.5, 1.0), ..free }
    }

    fn mapped(arm: &PlanarArm, ends: [f64; 2], count: usize, load: Load) -> Mapped {
        let axis = map::Axis::between(ends[0], ends[1], count);
        let options = MapOptions { extent: Extent::Grid { x: axis, z: axis }, load, elbow: None, held: None };
        map::map(&Model::of_links(arm).unwrap(), &options).unwrap().deflection
    }

    fn scene(arm: &PlanarArm) -> Scene {
        Scene {
            axis: [0.0; 2],
            links: Vec::new(),
            link: f64::midpoint(arm.l2, arm.l3),
            base: None,
            raised: 0.0,
            zone: None,
            windows: Vec::new(),
            keep_outs: Vec::new(),
            force: None,
        }
    }

    fn figure<'a>(map: &'a Mapped, arm: &'a PlanarArm) -> MapFigure<'a> {
        let (title, subtitle) = ("t <&\"> ".repeat(60), String::new());
        MapFigure {
            title,
            subtitle,
            map,
            unit: Unit::Millimetre,
            colours: Colours::Deflections,
            tolerance: Some(1.5),
            figure_size: FigureSize::default(),
            edge: Some((arm, [0.0; 2])),
            ways: None,
            scene: scene(arm),
            colour_label: "worst [mm]".into(),
            origin: "the joint-2 axis",
            face: None,
        }
    }

    #[test]
    fn the_edge_of_the_mapped_area_is_that_of_the_arm() {
        let arm = arm();
        // No grid line touches the edge without crossing it.
        let map = mapped(&arm, [-2.03, 2.03], 61, Load::PAPER);
        let grid = Grid::new(61, 61, |i, j| map.get(i, j));
        let metres = |[i, j]: Node| [i, j].map(|i| -2.03 + i * 4.06 / 60.0);
        let reached = |p: [f64; 2]| arm.sides().unwrap().iter().any(|side| side.reaches(p.into()));
        let rings = region(&grid, (&arm, [0.0; 2]), &metres);
        let crossings: Vec<&Node> = rings.iter().flatten().collect();
        assert!(100 < crossings.len());
        for &&[i, j] in &crossings {
            // Along the grid line on which it was found, the arm reaches one side of a crossing and not the other.
            let off = if (5.0 * i).fract() == 0.0 { [0.0, 0.002] } else { [0.002, 0.0] };
            let beside = [1.0, -1.0].map(|s| reached(metres([i + s * off[0], j + s * off[1]])));
            assert!(beside[0] != beside[1], "{i} {j}");
        }
    }

    #[test]
    fn odd_maps_make_figures() {
        let arm = arm();
        let sideways = Load::in_plane(1000.0, 0.3, Component::Along).unwrap();
        let maps = [
            mapped(&arm, [5.0, 6.0], 50, Load::PAPER),
            mapped(&arm, [0.9, 0.9 + 1e-9], 2, Load::PAPER),
            mapped(&arm, [-2.0, 2.0], 2, Load::PAPER),
            mapped(&arm, [-2.0, 2.0], 1001, sideways),
        ];
        for map in &maps {
            let zone = Zone::Rectangle { width: 0.2, height: 0.4 };
            let mark = |x: f64| ZoneMark {
                zone,
                rim: rim(zone, [x, 0.5], 0.3),
                worst_point: [x, 0.5],
                label: "<B>".repeat(90),
            };
            let plain = figure(map, &arm);
            let full = MapFigure {
                scene: Scene {
                    zone: Some(mark(1.0)),
                    links: links(&arm, (1.0, -1.0)),
                    base: Some([-0.3, -0.7]),
                    ..scene(&arm)
                },
                face: Some(FaceFigure {
                    zone,
                    cells: vec![Some(0.5); 9],
                    per_side: 3,
                    angle: 0.4,
                    up: "ahead",
                    colour_label: "worst [mm]".into(),
                }),
                ..figure(map, &arm)
            };
            let lost = MapFigure {
                scene: Scene {
                    zone: Some(mark(f64::NAN)),
                    links: links(&arm, (f64::NAN, 0.0)),
                    base: Some([f64::INFINITY; 2]),
                    ..scene(&arm)
                },
                ..figure(map, &arm)
            };
            for figure in [plain, full, lost] {
                let svg = figure.svg().unwrap();
                assert!(svg.len() < 1_500_000);
                assert!(is_svg(&svg));
                assert_eq!(svg, figure.svg().unwrap());
            }
        }
    }

    #[test]
    fn a_map_of_another_arm_is_drawn_with_a_smoothed_edge() {
        let arm = arm();
        let map = mapped(&PlanarArm { l3: 0.5, ..arm.clone() }, [-2.0, 2.0], 100, Load::PAPER);
        assert!(is_svg(&figure(&map, &arm).svg().unwrap()));
    }
}
