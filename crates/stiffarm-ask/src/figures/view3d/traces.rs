//! What plotly.js is to draw, in its own words.

use nalgebra::{Point3, Vector3};
use serde_json::{Value, json};
use stiffarm::cell::Block;
use stiffarm::interval::Interval;
use stiffarm::palette::{
    ALARM, ARM_IN_SPACE, BASE, FAINT, FIXTURE, FLOOR, GREY, INK, JOINT_IN_SPACE, KEEP_OUT, PART, TOOL, ZONE,
};

use super::super::bands::Bands;
use super::solids::Solid;
use super::{Point, Surface, View, length};
use crate::markup::escaped;

/// Radii of base, upper arm, forearm, hand and tool at their beginning, over the length of a link; each tapers to the next.
const RADII: [f64; 6] = [0.17, 0.105, 0.085, 0.06, 0.04, 0.022];
/// Radius of the shaft of an arrow, m: it stands out on both faces of a section.
const SHAFT: f64 = 0.016;
/// Of a part with more triangles the box alone is drawn.
const MOST_TRIANGLES: usize = 50_000;
/// Ticks along the longest axis.
const MOST_TICKS: f64 = 6.0;
/// Squares of the floor, m.
const TILE: f64 = 0.5;
/// Beyond everything else what is kept free is shown so far, m.
const FAR: f64 = 2.0;
/// Half the width of a pedestal, m.
const PEDESTAL: f64 = 0.3;
/// How far links and rims, and above them marks, are drawn from a section they lie in, m.
const LINKS_APART: f64 = 0.012;
const MARK_APART: f64 = 0.03;

impl View {
    /// Data, layout and settings.
    pub(crate) fn figure(&self) -> Value {
        json!({ "data": self.traces(), "layout": self.layout(), "config": { "responsive": true, "displaylogo": false } })
    }

    fn traces(&self) -> Vec<Value> {
        let mut traces = Vec::new();
        let bands = self.bands();
        let zone_surface = self.zone.as_ref().and_then(|zone| zone.surface.as_ref());
        // What has no rim is a path: its ribbon is all that is seen of it.
        let inside = match &self.zone {
            Some(zone) if zone.rim.is_empty() => &*zone.label,
            _ => "inside the zone",
        };
        let surfaces = [("section", self.section.as_ref(), 0.75), (inside, zone_surface, 1.0)];
        for (name, surface, opacity) in surfaces {
            if let (Some(surface), Some(bands)) = (surface, bands) {
                let with_bar = traces.is_empty();
                traces.push(surface_trace(name, surface, opacity, bands, with_bar.then_some(&*self.colour_label)));
            }
        }
        traces.extend(self.floor_height().map(|height| self.floor(height)));
        self.draw_cell(&mut traces);
        self.draw_work(&mut traces);
        self.draw_arm(&mut traces);
        self.draw_zone(&mut traces);
        let (called, touching) = &self.touching;
        if !touching.is_empty() {
            traces.push(lines(called, touching, ALARM, 9.0));
        }
        self.draw_arrows(&mut traces);
        traces
    }

    /// One scale for all that is coloured, in the bands of the flat figures.
    fn bands(&self) -> Option<Bands> {
        let zone = self.zone.as_ref().and_then(|zone| zone.surface.as_ref());
        let known = self.section.iter().chain(zone).flat_map(Surface::cells).filter_map(|cell| cell.mm);
        let known = known.filter(|mm| mm.is_finite());
        let [low, high] = known.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], mm| [low.min(mm), high.max(mm)]);
        (low <= high).then(|| Bands::within(self.scale, [low, high], self.colours))
    }

    /// The block, and all triangles of part and fixture, or where there are very many the box about them.
    fn draw_work(&self, traces: &mut Vec<Value>) {
        if let Some(corners) = self.stock {
            let mut block = Solid::block(corners).trace("stock, before it is cut", PART);
            block["opacity"] = json!(0.35);
            block["flatshading"] = json!(true);
            block["showlegend"] = json!(true);
            traces.push(block);
        }
        for (name, colour, body) in [("part", PART, &self.part), ("fixture", FIXTURE, &self.fixture)] {
            let Some((mesh, pose)) = body else { continue };
            let (points, triangles) = mesh.placed(pose);
            let solid = if triangles.len() <= MOST_TRIANGLES {
                Solid::mesh(points, triangles)
            } else {
                let ends = mesh.extent();
                let corner = |k: usize| [0, 1, 2].map(|i| ends[k >> i & 1][i]).into();
                Solid::block(std::array::from_fn(|k| pose.transform_point(&corner(k)).into()))
            };
            let mut trace = solid.trace(name, colour);
            trace["showlegend"] = json!(true);
            traces.push(trace);
        }
    }

    fn draw_arm(&self, traces: &mut Vec<Value>) {
        let Some(arm) = &self.arm else { return };
        let points: Vec<Point> = arm.points.iter().map(|(at, _)| *at).collect();
        // The first point is the base where one is known: the joint-2 axis stands above the floor.
        let stands = self.floor && points.first().is_some_and(|at| at[2] == 0.0);
        let skipped = usize::from(!stands);
        let links = points.windows(2).map(|link| (Vector3::from(link[1]) - Vector3::from(link[0])).norm());
        let size = links.fold(0.1, f64::max).clamp(0.1, 1.2);
        let radius = |i: usize| size * RADII[(i + skipped).min(RADII.len() - 1)];
        let mut bodies: Vec<Solid> = Vec::new();
        for (i, link) in points.windows(2).enumerate() {
            if i == 0 && stands {
                // A column about the joint-1 axis, and from its head to the joint-2 axis.
                let head = [0.0, 0.0, 0.7 * link[1][2]];
                bodies.push(Solid::capsule([0.0; 3], head, [1.35 * radius(0), radius(0)]));
                bodies.push(Solid::capsule(head, link[1], [radius(0), 1.2 * radius(1)]));
            } else {
                bodies.push(Solid::capsule(link[0], link[1], [radius(i), radius(i + 1)]));
            }
        }
        for (i, body) in bodies.iter().enumerate() {
            let colour = if stands && i < 2 { BASE } else { ARM_IN_SPACE };
            let mut trace = body.trace("robot", colour);
            trace["legendgroup"] = json!("robot");
            trace["showlegend"] = json!(i + 1 == bodies.len());
            traces.push(trace);
        }
        for (i, (at, text)) in arm.points.iter().enumerate().skip(usize::from(stands)) {
            let text = escaped(&format!("{text}\n{}", place(at))).replace('\n', "<br>");
            let mut joint = Solid::capsule(*at, *at, [1.18 * radius(i); 2]).trace("joints", JOINT_IN_SPACE);
            joint["hoverinfo"] = json!("text");
            joint["hovertext"] = json!(text);
            joint["legendgroup"] = json!("robot");
            traces.push(joint);
        }
        if let Some(axis) = arm.tool {
            let mut line = lines("tool axis", &[axis.to_vec()], TOOL, 6.0);
            line["hoverinfo"] = json!("skip");
            traces.push(line);
        }
    }

    fn draw_zone(&self, traces: &mut Vec<Value>) {
        let Some(zone) = &self.zone else { return };
        if !zone.rim.is_empty() {
            let mut rim = lines(&zone.label, &self.on_both_faces(&zone.rim, LINKS_APART), ZONE, 7.0);
            rim["hoverinfo"] = json!("name");
            traces.push(rim);
        }
        if let Some(worst) = &zone.worst {
            let deflection = worst.mm.map_or_else(String::new, |mm| format!("<br>{mm:.4} mm"));
            let text = format!("worst point{deflection}<br>{}", place(&worst.at));
            let faces = self.on_both_faces(&[worst.at], MARK_APART);
            let mut mark = markers("worst point", &faces.concat(), &vec![text; faces.len()]);
            mark["marker"] = json!({ "symbol": "x", "size": 5, "color": INK });
            traces.push(mark);
        }
    }

    fn draw_arrows(&self, traces: &mut Vec<Value>) {
        for arrow in &self.arrows {
            let colour = arrow.colour;
            let tip: Point = std::array::from_fn(|k| arrow.at[k] + arrow.along[k]);
            let neck: Point = std::array::from_fn(|k| arrow.at[k] + 0.8 * arrow.along[k]);
            let mut shaft = Solid::capsule(arrow.at, neck, [SHAFT; 2]).trace(&escaped(&arrow.label), colour);
            shaft["hoverinfo"] = json!("name");
            shaft["legendgroup"] = json!(arrow.label);
            shaft["showlegend"] = json!(true);
            traces.push(shaft);
            let [[x], [y], [z]] = [0, 1, 2].map(|k| [length(tip[k])]);
            let [[u], [v], [w]] = [0, 1, 2].map(|k| [0.2 * arrow.along[k]]);
            traces.push(json!({
                "type": "cone", "x": [x], "y": [y], "z": [z], "u": [u], "v": [v], "w": [w],
                "anchor": "tip", "sizemode": "raw", "sizeref": 1, "showscale": false,
                "colorscale": [[0, colour], [1, colour]], "hoverinfo": "skip", "legendgroup": arrow.label,
            }));
        }
    }

    /// How high above the base the floor lies, m, where that is known and it lies level there.
    fn floor_height(&self) -> Option<f64> {
        match self.cell.map(|cell| cell.mount) {
            None => self.floor.then_some(0.0),
            Some(mount) => mount.is_vertical().then(|| mount.heights_from_base(Interval::point(0.0)).min()),
        }
    }

    /// Light lines under everything that is shown.
    fn floor(&self, height: f64) -> Value {
        let [x, y, _] = self.room().map(|range| range.map(|end| (end / TILE).round() as i64));
        let at = |i: i64, j: i64| [TILE * i as f64, TILE * j as f64, height];
        let along = (x[0]..=x[1]).map(|i| vec![at(i, y[0]), at(i, y[1])]);
        let across = (y[0]..=y[1]).map(|j| vec![at(x[0], j), at(x[1], j)]);
        let mut floor = lines("floor", &along.chain(across).collect::<Vec<_>>(), FLOOR, 2.0);
        floor["hoverinfo"] = json!("skip");
        floor
    }

    /// What the base stands on, and what is kept free.
    fn draw_cell(&self, traces: &mut Vec<Value>) {
        if let Some(raised) = self.cell.and_then(|cell| cell.mount.raised()).filter(|raised| 0.0 < *raised) {
            let ends = [[-PEDESTAL, PEDESTAL], [-PEDESTAL, PEDESTAL], [-raised, 0.0]];
            let at = |k: usize| [0, 1, 2].map(|i| ends[i][k >> i & 1]);
            traces.push(Solid::block(std::array::from_fn(at)).trace("pedestal", BASE));
        }
        for (i, corners) in self.keep_outs().into_iter().enumerate() {
            let mut body = Solid::block(corners).trace("kept free", KEEP_OUT);
            body["opacity"] = json!(0.3);
            body["flatshading"] = json!(true);
            body["legendgroup"] = json!("kept free");
            body["showlegend"] = json!(i == 0);
            traces.push(body);
        }
    }

    /// Corners of what is kept free, base axes; what is open, or goes on far away, is cut off beyond everything else that is shown.
    fn keep_outs(&self) -> Vec<[Point; 8]> {
        let Some(cell) = self.cell else { return Vec::new() };
        let pose = cell.mount.cell_from_base;
        let shown: Vec<Point3<f64>> = self.shown().chain([[0.0; 3]]).map(|at| pose * Point3::from(at)).collect();
        let ends = |block: &Block, i: usize| {
            let known = || shown.iter().map(|at| at[i]).filter(|x| x.is_finite());
            // Nothing is seen below the floor.
            let side = [block.x, block.y, block.z][i];
            let [low, high] = [known().fold(0.0, f64::min), known().fold(0.0, f64::max)];
            let beyond = |end: f64| if end.is_finite() { FAR } else { TILE };
            let least = if i == 2 { 0.0 } else { low - beyond(side.min()) };
            [side.min().max(least), side.max().min(high + beyond(side.max()))]
        };
        let corners = |block: Block| {
            let ends = [0, 1, 2].map(|i| ends(&block, i));
            let at = |k: usize| pose.inverse() * Point3::from([0, 1, 2].map(|i| ends[i][k >> i & 1]));
            ends.iter().all(|[from, to]| from < to).then(|| std::array::from_fn(|k| at(k).into()))
        };
        cell.keep_out().filter_map(corners).collect()
    }

    /// From where to where the axes go: whole tiles that hold everything that is shown, and the base.
    fn room(&self) -> [[f64; 2]; 3] {
        [0, 1, 2].map(|k| {
            let blocks = self.keep_outs().into_iter().flatten();
            let floor = self.floor_height().map(|height| [0.0, 0.0, height]);
            let shown = self.shown().chain(blocks).chain(floor).map(|at| at[k]).filter(|x| x.is_finite());
            let around = if k == 2 { 0.0 } else { TILE };
            let [low, high] = shown.fold([-around, TILE], |[low, high], x| [low.min(x), high.max(x)]);
            [(low / TILE + 1e-9).floor() * TILE, (high / TILE - 1e-9).ceil() * TILE]
        })
    }

    /// Every point of robot, work and map.
    fn shown(&self) -> impl Iterator<Item = Point> {
        let zone = self.zone.as_ref().and_then(|zone| zone.surface.as_ref());
        let rim = self.zone.iter().flat_map(|zone| zone.rim.iter().copied());
        let surfaces = self.section.iter().chain(zone).flat_map(Surface::cells).map(|cell| cell.at);
        let arm =
            self.arm.iter().flat_map(|arm| arm.points.iter().map(|(at, _)| *at).chain(arm.tool.into_iter().flatten()));
        let arrows = self.arrows.iter().map(|arrow| std::array::from_fn(|k| arrow.at[k] + arrow.along[k]));
        surfaces.chain(rim).chain(arm).chain(arrows)
    }

    fn layout(&self) -> Value {
        let room = self.room();
        let sides = room.map(|[from, to]| to - from);
        // A metre is as long on every axis, and the whole fits a window that is wider than high from every side.
        let scale = 1.95 / sides.iter().map(|side| side * side).sum::<f64>().sqrt();
        let [x, y, z] = sides.map(|side| side * scale);
        // The same step on every axis; none at the corners, where the labels of two axes meet.
        let longest = sides.into_iter().fold(TILE, f64::max);
        let step =
            [1.0, 2.0, 4.0, 10.0].map(|tiles| tiles * TILE).into_iter().find(|step| longest <= MOST_TICKS * step);
        let step = step.unwrap_or(longest);
        let axis = |title: &str, [from, to]: [f64; 2]| {
            let ticks = ((from / step).ceil() as i64..=(to / step).floor() as i64).map(|i| i as f64 * step);
            let ticks: Vec<f64> = ticks.filter(|at| from + 0.3 * step < *at && *at < to - 0.3 * step).collect();
            let texts: Vec<String> = ticks.iter().map(f64::to_string).collect();
            json!({
                "title": { "text": title, "font": { "size": 14 } }, "tickfont": { "size": 12 }, "tickvals": ticks, "ticktext": texts,
                "tickangle": 0, "gridcolor": FAINT, "zeroline": false, "showbackground": false, "color": INK, "showspikes": false,
                "hoverformat": ".3f", "range": [from, to],
            })
        };
        json!({
            "font": { "family": "DejaVu Sans, Verdana, sans-serif", "color": INK },
            "margin": { "l": 0, "r": 0, "t": 0, "b": 0 },
            "legend": {
                "orientation": "h", "x": 0.01, "y": 1, "yanchor": "top", "font": { "size": 13 }, "itemsizing": "constant",
            },
            "modebar": { "orientation": "v" },
            "hoverlabel": { "align": "left", "font": { "size": 13 } },
            "scene": {
                "domain": { "x": [0, 0.9], "y": [0, 0.94] },
                "aspectmode": "manual", "aspectratio": { "x": x, "y": y, "z": z },
                "xaxis": axis("x ahead [m]", room[0]), "yaxis": axis("y left [m]", room[1]),
                "zaxis": axis("z up [m]", room[2]),
                // From the right of the robot, a little above: ahead is to the right, as in the flat figures.
                "camera": { "eye": { "x": 0.55, "y": -1.75, "z": 0.6 }, "center": { "x": 0, "y": 0, "z": -0.08 } },
            },
        })
    }

    /// A line beside the section on both its faces, so that neither hides it; the line itself where it is not in its plane.
    fn on_both_faces(&self, line: &[Point], apart: f64) -> Vec<Vec<Point>> {
        let Some((origin, normal)) = self.section.as_ref().and_then(plane_of) else { return vec![line.to_vec()] };
        let off = |at: &Point| normal.dot(&(Vector3::from(*at) - origin)).abs();
        if !line.iter().all(|at| off(at) < apart) {
            return vec![line.to_vec()];
        }
        let moved = |side: f64| line.iter().map(|at| (Vector3::from(*at) + side * normal).into()).collect();
        vec![moved(apart), moved(-apart)]
    }
}

/// A point of a flat surface and its normal.
fn plane_of(surface: &Surface) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let (first, last) = (surface.rows.first()?, surface.rows.last()?);
    let [origin, across, along] = [first.first()?, first.last()?, last.first()?].map(|cell| Vector3::from(cell.at));
    let normal = (across - origin).cross(&(along - origin)).try_normalize(1e-12)?;
    Some((origin, normal))
}

/// A coloured surface whose colours are those of the scale, not of a lamp.
fn surface_trace(name: &str, surface: &Surface, opacity: f64, bands: Bands, bar: Option<&str>) -> Value {
    let grid = |pick: &dyn Fn(&super::Cell) -> Option<f64>| -> Value {
        surface.rows.iter().map(|row| row.iter().map(pick).collect::<Value>()).collect()
    };
    let part = |k: usize| grid(&move |cell| Some(length(cell.at[k])));
    let mut surface = json!({
        "type": "surface", "name": escaped(name), "opacity": opacity,
        "x": part(0), "y": part(1), "z": grid(&|cell| cell.mm.map(|_| length(cell.at[2]))),
        "surfacecolor": grid(&|cell| cell.mm.map(digits)),
        "cmin": digits(bands.limit(0)), "cmax": digits(bands.limit(bands.count)), "colorscale": bands.scale(),
        "lighting": { "ambient": 1, "diffuse": 0, "specular": 0, "fresnel": 0, "roughness": 1 },
    "hoverinfo": "x+y+z+text",
        "showlegend": true, "showscale": bar.is_some(), "contours": {
            "x": { "highlight": false }, "y": { "highlight": false }, "z": { "highlight": false },
        },
    });
    if let Some(title) = bar {
        let limits: Vec<f64> = (0..=bands.count).map(|i| digits(bands.limit(i))).collect();
        let texts: Vec<String> = (0..=bands.count).map(|i| bands.text(i)).collect();
        surface["colorbar"] = json!({
            "title": { "text": escaped(title), "side": "right", "font": { "size": 14 } }, "len": 0.8, "thickness": 22, "x": 0.89,
            "tickvals": limits, "ticktext": texts, "tickfont": { "size": 13 }, "outlinecolor": GREY,
        });
    }
    surface
}

/// Lines that are not joined with each other.
fn lines(name: &str, lines: &[Vec<Point>], colour: &str, width: f64) -> Value {
    let part = |k: usize| -> Value {
        let ends = |line: &Vec<Point>| line.iter().map(|at| Some(length(at[k]))).chain([None]).collect::<Vec<_>>();
        lines.iter().flat_map(ends).collect()
    };
    json!({
        "type": "scatter3d", "mode": "lines", "name": escaped(name), "x": part(0), "y": part(1), "z": part(2),
        "line": { "color": colour, "width": width },
    })
}

fn markers(name: &str, points: &[Point], texts: &[String]) -> Value {
    let part = |k: usize| points.iter().map(|at| length(at[k])).collect::<Value>();
    json!({
        "type": "scatter3d", "mode": "markers", "name": escaped(name), "x": part(0), "y": part(1), "z": part(2),
        "text": texts, "hoverinfo": "text",
    })
}

/// A place for people.
fn place([x, y, z]: &Point) -> String {
    format!("x {x:.3} m, y {y:.3} m, z {z:.3} m")
}

/// Six significant digits.
fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
