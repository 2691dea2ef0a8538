//! What a view in space shows as points, lines and faces (`.vtp`): the arm, the zone or the path, the section, arrows.

use super::{Numbers, array, file};
use crate::figures::bands::Colours;
use crate::figures::view3d::{Cell, Point, Surface, View};

/// What a line or face is of: the numbers of its array `part`.
#[derive(Clone, Copy)]
enum Part {
    Arm = 0,
    Tool = 1,
    Work = 2,
    Section = 3,
    Arrow = 4,
}

/// Points with their values, and lines and faces through them.
#[derive(Default)]
struct Shapes {
    points: Vec<f64>,
    values: Vec<f64>,
    lines: Strung,
    faces: Strung,
}

/// Cells as VTK has them: all their points one behind the other, where each ends, and what it is of.
#[derive(Default)]
struct Strung {
    points: Vec<i64>,
    ends: Vec<i64>,
    parts: Vec<i64>,
}

impl Strung {
    fn add(&mut self, points: impl IntoIterator<Item = i64>, part: Part) {
        self.points.extend(points);
        self.ends.push(self.points.len() as i64);
        self.parts.push(part as i64);
    }

    fn written(&self, name: &str) -> String {
        let (points, ends) = (Numbers::Int64(&self.points), Numbers::Int64(&self.ends));
        format!("<{name}>\n{}{}</{name}>\n", array("connectivity", 1, points), array("offsets", 1, ends))
    }
}

impl Shapes {
    /// A point, and its number.
    fn point(&mut self, at: Point, value: Option<f64>) -> i64 {
        self.points.extend(at);
        self.values.push(value.unwrap_or(f64::NAN));
        self.values.len() as i64 - 1
    }

    fn line(&mut self, points: &[Point], part: Part) {
        let numbers: Vec<i64> = points.iter().map(|at| self.point(*at, None)).collect();
        if 1 < numbers.len() {
            self.lines.add(numbers, part);
        }
    }

    /// Four neighbours are a face; a point that is not reached is in none.
    fn surface(&mut self, surface: &Surface, part: Part) {
        let mut before: Option<Vec<Option<i64>>> = None;
        for row in &surface.rows {
            let number = |shapes: &mut Self, cell: &Cell| {
                let is_known = cell.mm.is_some() || part as i64 == Part::Work as i64;
                is_known.then(|| shapes.point(cell.at, cell.mm))
            };
            let numbers: Vec<Option<i64>> = row.iter().map(|cell| number(self, cell)).collect();
            for (i, below) in before.iter().flat_map(|before| before.windows(2).enumerate()) {
                let [a, b] = below else { continue };
                let corners = [*a, *b, numbers.get(i + 1).copied().flatten(), numbers.get(i).copied().flatten()];
                if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                    self.faces.add([a, b, c, d], part);
                }
            }
            before = Some(numbers);
        }
    }
}

/// The file.
pub(crate) fn lines(view: &View) -> String {
    let mut shapes = Shapes::default();
    if let Some(arm) = &view.arm {
        shapes.line(&arm.points.iter().map(|(at, _)| *at).collect::<Vec<_>>(), Part::Arm);
        if let Some(tool) = arm.tool {
            shapes.line(&tool, Part::Tool);
        }
    }
    if let Some(zone) = &view.zone {
        shapes.line(&zone.rim, Part::Work);
        if let Some(surface) = &zone.surface {
            shapes.surface(surface, Part::Work);
        }
    }
    if let Some(section) = &view.section {
        shapes.surface(section, Part::Section);
    }
    for arrow in &view.arrows {
        let end = [0, 1, 2].map(|i| arrow.at[i] + arrow.along[i]);
        shapes.line(&[arrow.at, end], Part::Arrow);
    }
    let Shapes { points, values, lines, faces } = shapes;
    let name = match view.colours {
        Colours::Deflections => "deflection_mm",
        Colours::Margins => "margin_deg",
        Colours::Frequencies => "first_frequency_hz",
    };
    let parts: Vec<i64> = lines.parts.iter().chain(&faces.parts).copied().collect();
    let inside = format!(
        "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n\
         <PointData Scalars=\"{name}\">\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n{}{}</Piece>\n</PolyData>\n",
        values.len(),
        lines.ends.len(),
        faces.ends.len(),
        array(name, 1, Numbers::Float64(&values)),
        array("part", 1, Numbers::Int64(&parts)),
        array("Points", 3, Numbers::Float64(&points)),
        lines.written("Lines"),
        faces.written("Polys"),
    );
    file("PolyData", &inside)
}
