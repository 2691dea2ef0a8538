//! What an arm reaches in its plane, with either elbow, measured from the base.

use stiffarm::interval::Interval;
use stiffarm::map::reached_box;
use stiffarm::palette::{ELBOW_DOWN, ELBOW_DOWN_EDGE, ELBOW_UP, ELBOW_UP_EDGE};
use stiffarm::plane::{Elbow, ElbowSide, PlanarArm};

use super::axes::{Axis, Frame, heading};
use super::canvas::{Canvas, Px, path, rect_path};
use super::legend::{Entry, Legend};
use super::line::Node;
use super::map::edge;
use super::scene::{Scene, links};
use super::{FigureError, FigureSize};

/// The edge is searched for on so many points along the longer side.
const POINTS: usize = 240;

/// Look of an elbow side: its fill, and its edge, which stays apart in a print without colour.
fn look(elbow: Elbow) -> [String; 2] {
    let (fill, edge, dash) = match elbow {
        Elbow::Up => (ELBOW_UP, ELBOW_UP_EDGE, ""),
        Elbow::Down => (ELBOW_DOWN, ELBOW_DOWN_EDGE, r#" stroke-dasharray="7 4""#),
    };
    [
        format!(r#"fill="{fill}" fill-opacity="0.45""#),
        format!(r#"fill="none" stroke="{edge}" stroke-width="1.8"{dash} stroke-linejoin="round""#),
    ]
}

/// The reached section of an arm.
pub struct ReachFigure<'a> {
    /// First line.
    pub title: String,
    /// Second line, in grey.
    pub subtitle: String,
    /// The arm.
    pub arm: &'a PlanarArm,
    /// The joint-2 axis from the base, m; without it lengths count from that axis.
    pub base: Option<[f64; 2]>,
    /// What was asked of the figure.
    pub figure_size: FigureSize,
}

impl ReachFigure<'_> {
    /// The figure as SVG text.
    ///
    /// # Errors
    /// Where nothing of it can be drawn.
    pub fn svg(&self) -> Result<String, FigureError> {
        let nothing = |_| FigureError::Nothing("the arm reaches nothing");
        let [x, z] = reached_box(self.arm).map_err(nothing)?;
        let sides = self.arm.sides().map_err(|error| nothing(error.into()))?;
        let scene = Scene {
            axis: [0.0; 2],
            links: usual_posture(self.arm).map_or_else(Vec::new, |posture| links(self.arm, posture)),
            link: f64::midpoint(self.arm.l2, self.arm.l3),
            base: self.base.map(|axis| axis.map(|part| -part)),
            raised: 0.0,
            zone: None,
            windows: Vec::new(),
            keep_outs: Vec::new(),
            force: None,
        };
        let mut canvas = Canvas::of(&self.figure_size);
        let top = heading(&mut canvas, &self.title, &self.subtitle) + 16.0;
        let margin = 0.04 * x.width().max(z.width());
        let corners = vec![[x.min() - margin, z.min() - margin], [x.max() + margin, z.max() + margin]];
        let frame = scene.frame(corners, canvas.width, top);
        let [[left, bottom], [right, _]] = frame.corners();
        let own = self.counted_from_base(frame);
        own.grid(&mut canvas);
        let inside = rect_path([left, bottom], [right, top]);
        let mut entries = Vec::new();
        canvas.clipped(&inside, |canvas| {
            scene.floor(canvas, &frame);
            for elbow in [Elbow::Up, Elbow::Down] {
                let sides: Vec<&ElbowSide> = sides.iter().filter(|side| side.elbow == elbow).collect();
                if !sides.is_empty() {
                    let area = area(&sides, [x, z], &frame);
                    for look in look(elbow) {
                        canvas.path(&area, &look);
                    }
                    entries.push(entry(elbow));
                }
            }
            scene.draw_base(canvas, &frame);
            scene.draw_arm(canvas, &frame);
        });
        let from = if self.base.is_some() { "the base" } else { "the joint-2 axis" };
        own.draw(&mut canvas, &format!("x from {from} [m]"), &format!("z from {from} [m]"));
        entries.extend(scene.entries());
        let legend = Legend::new(entries, canvas.width - 80.0, 4);
        legend.draw(&mut canvas, [40.0, bottom + 52.0]);
        canvas.height = bottom + 66.0 + legend.height();
        Ok(canvas.finish())
    }

    /// The same frame with its scales counted from the base.
    fn counted_from_base(&self, frame: Frame) -> Frame {
        let [x, z] = self.base.unwrap_or_default();
        let moved = |axis: Axis, by: f64| Axis { from: axis.from + by, to: axis.to + by, px: axis.px };
        Frame { x: moved(frame.x, x), y: moved(frame.y, z) }
    }
}

fn entry(elbow: Elbow) -> Entry {
    Entry::new(format!("reached with the elbow {}", elbow.name()), move |canvas, [x, y]| {
        for look in look(elbow) {
            canvas.rect([x - 15.0, y - 7.0], [x + 15.0, y + 7.0], &look);
        }
    })
}

/// The path of what some of the sides reach.
fn area(sides: &[&ElbowSide], [x, z]: [Interval; 2], frame: &Frame) -> String {
    let step = x.width().max(z.width()) / POINTS as f64;
    // One cell around, so that the edge closes.
    let count = |range: Interval| (range.width() / step).ceil() as usize + 3;
    let metres = |[i, j]: Node| [x.min() + step * (i - 1.0), z.min() + step * (j - 1.0)];
    let reached = |node: Node| sides.iter().any(|side| side.reaches(metres(node).into()));
    let rings = edge(count(x), count(z), &reached);
    let placed =
        |ring: &Vec<Node>| -> Vec<Px> { ring.iter().map(|&node| metres(node)).map(|[x, z]| frame.at(x, z)).collect() };
    rings.iter().map(|ring| path(&placed(ring), true)).collect()
}

/// Of all postures within the limits the one nearest to that of a catalogue picture: upper arm upright and a little
/// forwards, forearm level. Looked at every 3 degrees.
fn usual_posture(arm: &PlanarArm) -> Option<(f64, f64)> {
    const WANTED: [f64; 2] = [80.0, -5.0];
    let turns = |angle: f64, wanted: f64| (angle - wanted + 180.0).rem_euclid(360.0) - 180.0;
    let allowed = |range: Interval, degrees: f64| range.turn_to(degrees.to_radians(), 0.0);
    let angles = || (-60..60).map(|i| f64::from(3 * i));
    let mut best: Option<(f64, (f64, f64))> = None;
    for upper in angles() {
        let Some(shoulder) = allowed(arm.shoulder, upper) else { continue };
        for forearm in angles() {
            let Some(elbow) = allowed(arm.elbow, forearm - upper) else { continue };
            if !arm.forearm.contains(shoulder + elbow, 0.0) {
                continue;
            }
            let off = turns(upper, WANTED[0]).abs() + turns(forearm, WANTED[1]).abs();
            if best.is_none_or(|(least, _)| off < least) {
                best = Some((off, (shoulder, elbow)));
            }
        }
    }
    best.map(|(_, posture)| posture)
}

#[cfg(test)]
mod tests {
    use stiffarm::catalogue::robots;
    use stiffarm::drive::Architecture;

    use super::super::is_svg;
    use super::*;

    #[test]
    fn every_robot_stands_in_a_posture_within_its_limits() {
        for robot in robots() {
            let arm = robot.arm_plane().unwrap().arm;
            let (shoulder, elbow) = usual_posture(&arm).unwrap_or_else(|| panic!("{}", robot.name));
            let within = arm.shoulder.contains(shoulder, 0.0)
                && arm.elbow.contains(elbow, 0.0)
                && arm.forearm.contains(shoulder + elbow, 0.0);
            assert!(within, "{}: {shoulder} {elbow}", robot.name);
            let p = arm.forward(shoulder, elbow);
            assert!(0.0 < p.x, "{} is drawn backwards: {p:?}", robot.name);
        }
    }

    #[test]
    fn the_drawn_edge_encloses_the_area_that_the_arm_reaches() {
        // An elbow from 0 to -90 deg and no other limit: the ring between hypot(l2, l3) and l2 + l3.
        let free = PlanarArm::free(1.0, 0.75, 1e-6, 1e-6, Architecture::Serial);
        let arm = PlanarArm { elbow: Interval::spanning(-std::f64::consts::FRAC_PI_2, 0.0), ..free };
        let (x, y) = (Axis::new(-2.0, 2.0, [0.0, 400.0]), Axis::new(-2.0, 2.0, [400.0, 0.0]));
        let sides = arm.sides().unwrap();
        let drawn = area(&sides.iter().collect::<Vec<_>>(), reached_box(&arm).unwrap(), &Frame { x, y });
        let far = |end: fn(f64, f64) -> f64, start: f64| {
            let numbers = drawn.split(['M', 'L', 'Z', ' ']).filter_map(|text| text.parse::<f64>().ok());
            let numbers: Vec<f64> = numbers.collect();
            let distances = numbers.chunks(2).map(|p| (p[0] - 200.0).hypot(p[1] - 200.0) / 100.0);
            distances.fold(start, end)
        };
        // To a tenth of the pixel (1 cm) in which the path is thinned out.
        assert!((far(f64::max, 0.0) - 1.75).abs() < 1e-3, "{}", far(f64::max, 0.0));
        assert!((far(f64::min, 9.0) - 1.25).abs() < 1e-3, "{}", far(f64::min, 9.0));
    }

    #[test]
    fn a_figure_says_what_it_shows_and_can_be_drawn() {
        let robot = &robots()[0];
        let plane = robot.arm_plane().unwrap();
        let figure = |base| ReachFigure {
            title: robot.full_name(),
            subtitle: String::new(),
            arm: &plane.arm,
            base,
            figure_size: FigureSize::default(),
        };
        let svg = figure(Some(plane.axis_from_base)).svg().unwrap();
        for text in ["reached with the elbow up", "x from the base [m]", &robot.name] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(is_svg(&svg) && svg.len() < 200_000);
        assert!(figure(None).svg().unwrap().contains("x from the joint-2 axis [m]"));
    }
}
