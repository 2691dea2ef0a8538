//! The robot, the zone and the map in space: one HTML file that can be turned with the mouse and needs nothing else.
//!
//! The drawing is done in the browser by plotly.js, which lies inside the file; the page forbids itself to load anything.

mod arm;
mod solids;
mod traces;

use std::io::Read;

use flate2::read::GzDecoder;
use serde_json::Value;
use stiffarm::clearance::Mesh;
use stiffarm::map::Grid;
use stiffarm::palette::{INK, PAPER, PROSE};
use stiffarm::spatial::Pose;

pub use arm::ArmMark;

use super::bands::Colours;
use crate::answer::Unit;
use crate::markup::escaped;

/// No more points per side of a map are drawn: a browser turns some ten thousand smoothly.
const MOST_POINTS: usize = 240;

/// A point in space, m from the base: ahead, left, up.
pub type Point = [f64; 3];

/// What is shown. Every text may hold any character.
#[derive(Clone, Debug, Default)]
pub struct View {
    /// First line.
    pub title: String,
    /// Lines below it.
    pub notes: Vec<String>,
    /// The robot in one posture.
    pub arm: Option<ArmMark>,
    /// Where the work stands.
    pub zone: Option<Zone>,
    /// A map of the deflection, such as that of the arm plane.
    pub section: Option<Surface>,
    /// Where it touches something, or is nearer to it than was asked: what that is called, and the lines.
    pub touching: (String, Vec<Vec<Point>>),
    /// What pushes, and where to.
    pub arrows: Vec<Arrow>,
    /// What the colours mean, with the unit.
    pub colour_label: String,
    /// What they stand for.
    pub colours: Colours,
    /// From where to where they go, where that was asked for.
    pub scale: Option<[f64; 2]>,
    /// Whether it is known where the base stands: on the floor, at height zero, unless the cell says otherwise.
    pub floor: bool,
    /// The place where the robot works, where something is known of it: its floor, and what is kept free.
    pub cell: Option<stiffarm::cell::Cell>,
    /// The finished part, and where it stands.
    pub part: Option<(Mesh, Pose)>,
    /// What holds it, and where that stands.
    pub fixture: Option<(Mesh, Pose)>,
    /// The block from which it is cut, before anything is: corners, base axes.
    pub stock: Option<[Point; 8]>,
}

/// A point with its deflection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Where.
    pub at: Point,
    /// Deflection, mm, or a margin, deg; absent where the arm does not reach.
    pub mm: Option<f64>,
}

/// A coloured surface: rows of points, all of the same length, neighbours beside each other.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Row by row.
    pub rows: Vec<Vec<Cell>>,
}

/// A zone at its place.
#[derive(Clone, Debug, Default)]
pub struct Zone {
    /// Its entry in the legend.
    pub label: String,
    /// Its rim as a closed line.
    pub rim: Vec<Point>,
    /// The deflection inside, where it is not read off the section.
    pub surface: Option<Surface>,
    /// Where the deflection is largest.
    pub worst: Option<Cell>,
}

/// A direction at a point.
#[derive(Clone, Debug)]
pub struct Arrow {
    /// Its entry in the legend.
    pub label: String,
    /// Where it begins.
    pub at: Point,
    /// Where it points and how long it is drawn, m.
    pub along: Point,
    /// Of the palette.
    pub colour: &'static str,
}

impl Surface {
    /// A map over the plane of x and z at `y` m to the left, its values in a unit.
    pub fn of_map(map: &Grid, unit: Unit, y: f64) -> Self {
        let stride = map.x.count.max(map.z.count).div_ceil(MOST_POINTS).max(1);
        // The last point is always kept, so that the map does not shrink.
        let kept = |count: usize| (0..count).filter(move |i| i % stride == 0 || i + 1 == count);
        let cell = |i: usize, j: usize| Cell {
            at: [map.x.at(i), y, map.z.at(j)],
            mm: map.get(i, j).map(|value| unit.of_si(value)),
        };
        Self { rows: kept(map.z.count).map(|j| kept(map.x.count).map(|i| cell(i, j)).collect()).collect() }
    }

    fn cells(&self) -> impl Iterator<Item = &Cell> {
        self.rows.iter().flatten()
    }
}

impl View {
    /// The page as HTML text.
    pub fn html(&self) -> String {
        let title = escaped(&self.title);
        let notes: String = self.notes.iter().map(|note| format!("<p>{}</p>", escaped(note))).collect();
        let figure = in_script(&self.figure());
        let script = script();
        let unit = match self.colours {
            Colours::Deflections => "mm",
            Colours::Margins => "deg",
            Colours::Frequencies => "Hz",
        };
        format!(
            r#"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; img-src data: blob:">
<title>{title}</title>
<style>
html, body {{ height: 100%; margin: 0; }}
body {{ display: flex; flex-direction: column; font-family: "DejaVu Sans", Verdana, sans-serif; color: {INK}; background: {PAPER}; }}
header {{ padding: 14px 22px 0; }}
h1 {{ font-size: 20px; margin: 0 0 4px; }}
p {{ font-size: 14px; margin: 0 0 2px; color: {PROSE}; }}
#view {{ flex: 1; min-height: 420px; }}
</style>
</head>
<body>
<header><h1>{title}</h1>{notes}</header>
<div id="view"></div>
<script>{script}</script>
<script>
const figure = {figure};
for (const trace of figure.data.filter(trace => trace.type === "surface")) {{
  trace.text = trace.surfacecolor.map(row => row.map(value => value === null ? "" : value.toPrecision(5) + " {unit}"));
}}
Plotly.newPlot("view", figure.data, figure.layout, figure.config);
</script>
</body>
</html>
"#
        )
    }
}

/// plotly.js, the part that draws in space, as `scripts/plotly` packs it.
static PACKED: &[u8] = include_bytes!("../../../assets/plotly-gl3d.min.js.gz");

/// The source of plotly.js.
fn script() -> String {
    let mut script = String::new();
    GzDecoder::new(PACKED).read_to_string(&mut script).expect("it was packed whole");
    script
}

/// JSON that cannot end the script it stands in.
fn in_script(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

/// To a hundredth of a millimetre, m: nobody sees more, and the file stays small.
fn length(m: f64) -> f64 {
    (m * 1e5).round() / 1e5 + 0.0
}

#[cfg(test)]
mod tests {
    use stiffarm::drive::Architecture;
    use stiffarm::load::Load;
    use stiffarm::map::{Axis, Extent, MapOptions, map};
    use stiffarm::model::Model;
    use stiffarm::plane::PlanarArm;

    use super::*;

    fn view() -> View {
        let cell = |i: i32, j: i32| Cell {
            at: [1.0 + f64::from(i) / 8.0, 0.25, 0.5 + f64::from(j) / 8.0],
            mm: (i < 3).then_some(1.5 + f64::from(i + j) / 64.0),
        };
        let surface = Surface { rows: (0..3).map(|j| (0..4).map(|i| cell(i, j)).collect()).collect() };
        let zone = Zone {
            label: "</script><script>alert(1)</script>".into(),
            rim: vec![[1.0, 0.25, 0.5], [1.5, 0.25, 0.5], [1.0, 0.25, 0.5]],
            surface: Some(surface.clone()),
            worst: Some(cell(2, 2)),
        };
        let arrow = Arrow { label: "<b>worst</b>".into(), at: [1.0; 3], along: [0.0, 0.0, f64::NAN], colour: INK };
        View {
            title: "<script>alert(\"&\")</script>".into(),
            notes: vec!["1 < 2".into()],
            arm: Some(ArmMark { points: vec![([0.0; 3], "<script>".into()), ([1.0; 3], "tool".into())], tool: None }),
            zone: Some(zone),
            section: Some(surface),
            arrows: vec![arrow],
            colour_label: "worst deflection [mm]".into(),
            floor: true,
            ..View::default()
        }
    }

    /// The page without the source of plotly.js.
    fn own(page: &str) -> String {
        let script = script();
        assert!(1_000_000 < script.len() && page.contains(&script));
        page.replacen(&script, "", 1)
    }

    #[test]
    fn the_page_needs_nothing_else() {
        let page = own(&view().html());
        for foreign in ["http:", "https:", "src=", "href=", "@import", "url("] {
            assert!(!page.contains(foreign), "{foreign}");
        }
        assert!(page.contains("default-src 'none'"), "the browser loads nothing on its own account");
        // What would end the script early would spill its rest onto the page.
        assert!(!script().contains("</script"));
    }

    #[test]
    fn names_are_text_whatever_they_hold() {
        let page = own(&view().html());
        assert_eq!(page.matches("<script>").count(), 2, "{page}");
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(
            page.contains("<h1>&lt;script&gt;alert(&quot;&amp;&quot;)&lt;/script&gt;</h1>") && !page.contains("<b>")
        );
        let figure = view().figure();
        let names: Vec<&str> = figure["data"].as_array().unwrap().iter().filter_map(|t| t["name"].as_str()).collect();
        assert!(names.contains(&"&lt;b&gt;worst&lt;/b&gt;"), "{names:?}");
    }

    #[test]
    fn the_numbers_are_on_the_page() {
        let figure = view().figure();
        let data = figure["data"].as_array().unwrap();
        let surfaces: Vec<&Value> = data.iter().filter(|trace| trace["type"] == "surface").collect();
        assert_eq!(surfaces.len(), 2);
        for surface in surfaces {
            assert_eq!(surface["x"][1], serde_json::json!([1.0, 1.125, 1.25, 1.375]));
            assert_eq!(surface["z"][1], serde_json::json!([0.625, 0.625, 0.625, null]), "not reached: a hole");
            assert_eq!(surface["surfacecolor"][1], serde_json::json!([1.51562, 1.53125, 1.54688, null]));
            // Both surfaces are read off one scale, and one bar stands beside them.
            assert_eq!([&surface["cmin"], &surface["cmax"]], [&1.5, &1.565]);
        }
        assert_eq!(data.iter().filter(|trace| trace["showscale"] == true).count(), 1);
        let worst = data.iter().find(|trace| trace["name"] == "worst point").unwrap();
        let faces = [0, 1].map(|i| [&worst["x"][i], &worst["y"][i], &worst["z"][i]]);
        assert_eq!(faces, [[&1.25, &0.22, &0.75], [&1.25, &0.28, &0.75]], "on both faces of the section");
        assert!(worst["text"][0].as_str().unwrap().contains("1.5625 mm"));
    }

    #[test]
    fn a_metre_is_as_long_on_every_axis_and_all_is_inside() {
        let scene = &view().figure()["layout"]["scene"];
        let shown = [("x", [0.0, 1.375]), ("y", [0.0, 1.0]), ("z", [0.0, 1.0])];
        let per_metre = shown.map(|(name, [low, high])| {
            let range = [0, 1].map(|end| scene[format!("{name}axis")]["range"][end].as_f64().unwrap());
            assert!(range[0] <= low && high <= range[1], "{name}: {range:?}");
            scene["aspectratio"][name].as_f64().unwrap() / (range[1] - range[0])
        });
        assert!(per_metre.iter().all(|scale| (scale / per_metre[0] - 1.0).abs() < 1e-12), "{per_metre:?}");
        assert_eq!(scene["aspectmode"], "manual");
    }

    /// On a pedestal of half a metre, beside a box that goes on without end to the right: by hand.
    #[test]
    fn floor_pedestal_and_what_is_kept_free_stand_where_the_cell_has_them() {
        let mut cell = stiffarm::cell::Cell::of(stiffarm::cell::Mount::pedestal(0.5));
        let range = |from, to| stiffarm::interval::Interval::new(from, to).unwrap();
        let block = stiffarm::cell::Block {
            x: range(1.0, 2.0),
            y: range(f64::NEG_INFINITY, 0.0),
            z: range(f64::NEG_INFINITY, 0.8),
        };
        cell.keep_out[0] = Some(block);
        let figure = View { cell: Some(cell), ..view() }.figure();
        let data = figure["data"].as_array().unwrap();
        let ends = |name: &str, axis: &str| {
            let trace = data.iter().find(|trace| trace["name"] == name).unwrap_or_else(|| panic!("no {name}"));
            let known = || trace[axis].as_array().unwrap().iter().filter_map(Value::as_f64);
            [known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max)]
        };
        // Nothing else lies to the right of the base: half a metre beyond it the box is cut off, and at the floor.
        assert_eq!(["x", "y", "z"].map(|axis| ends("kept free", axis)), [[1.0, 2.0], [-0.5, 0.0], [-0.5, 0.3]]);
        assert_eq!([ends("pedestal", "z"), ends("floor", "z")], [[-0.5, 0.0], [-0.5, -0.5]]);
        assert!(figure["layout"]["scene"]["zaxis"]["range"][0].as_f64().unwrap() <= -0.5);
        let hanging =
            View { cell: Some(stiffarm::cell::Cell::of(stiffarm::cell::Mount::wall(2.0))), ..view() }.figure();
        assert!(hanging["data"].as_array().unwrap().iter().all(|trace| trace["name"] != "floor"), "not level there");
    }

    #[test]
    fn a_page_may_hold_nothing() {
        assert!(own(&View::default().html()).contains("const figure = {"));
    }

    #[test]
    fn a_large_map_is_thinned_out_but_keeps_its_size_and_its_place() {
        let arm = PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, Architecture::Serial);
        let axis = Axis::between(-2.0, 2.0, 1000);
        let extent = Extent::Grid { x: axis, z: axis };
        let options = MapOptions { extent, load: Load::PAPER, elbow: None, held: None };
        let found = map(&Model::of_links(&arm).unwrap(), &options).unwrap();
        let surface = Surface::of_map(&found.deflection, Unit::Millimetre, 0.1);
        assert!(
            surface.rows.len() <= MOST_POINTS + 1 && surface.rows.iter().all(|row| row.len() == surface.rows.len())
        );
        let (first, last) = (surface.rows[0][0].at, surface.rows.last().unwrap().last().unwrap().at);
        for (found, expected) in first.iter().chain(&last).zip([-2.0, 0.1, -2.0, 2.0, 0.1, 2.0]) {
            assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
        }
        assert!(surface.rows[0][0].mm.is_none(), "out of reach");
        let inside = surface.rows[surface.rows.len() / 2].iter().filter_map(|cell| cell.mm);
        // Between k l3^2 and k ((l2 + l3)^2 + l3^2), at 1 kN and 1 urad/(N m), mm.
        assert!(inside.clone().count() > 100 && inside.into_iter().all(|mm| (0.64 - 1e-9..=3.88 + 1e-9).contains(&mm)));
    }
}
