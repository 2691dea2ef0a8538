//! The postures of a plan of measurements, a small picture each: to be carried to the machine.

use crate::answer::DrawnPosture;
use stiffarm::interval::Interval;
use stiffarm::palette::{ARM, BASE, FORCE, GREY, INK, PAPER, WORST_POINT};

use super::FigureSize;
use super::axes::{Axis, Frame, heading};
use super::canvas::{Canvas, Font, Px};
use super::hodograph::arrow;
use super::legend::{Entry, Legend};

/// Of a picture, px.
const ROOM: f64 = 232.0;
/// Lines of text over it, px.
const HEAD: f64 = 44.0;
/// Of a load, px.
const LOAD: f64 = 42.0;
/// About what is drawn, px: no load leaves a picture.
const BESIDE: f64 = LOAD + 6.0;
/// Of a load that is shorter, its length being 1, no direction is seen.
const ACROSS: f64 = 0.4;
/// Widths of upper arm, forearm and wrist, px.
const LINKS: [f64; 3] = [11.0, 8.0, 6.0];

/// The figure as SVG text: as many in a row as fit, all on one scale.
pub(crate) fn svg(title: &str, postures: &[DrawnPosture], figure_size: &FigureSize) -> String {
    let mut canvas = Canvas::of(figure_size);
    let subtitle = "each from the side of the arm, turned to the right; joint 1 as the robot reports it";
    let mut top = heading(&mut canvas, title, subtitle) + 12.0;
    let columns = ((canvas.width - 20.0) / (ROOM + 8.0)).floor().max(1.0) as usize;
    let shown = extents(postures);
    let height = ROOM * shown[1].width() / shown[0].width();
    for (i, row) in postures.chunks(columns).enumerate() {
        for (j, posture) in row.iter().enumerate() {
            let corner = [12.0 + (ROOM + 8.0) * j as f64, top];
            let frame = draw(&mut canvas, posture, corner, (shown, height));
            if (i, j) == (0, 0) {
                metre(&mut canvas, &frame);
            }
        }
        top += HEAD + height + 10.0;
    }
    let mut entries = Vec::new();
    if postures.iter().any(|posture| posture.load.is_some()) {
        entries.push(Entry::line("load", format!(r#"stroke="{FORCE}" stroke-width="2.6""#)));
        entries.push(Entry::new("load across the picture", across));
    }
    entries.push(Entry::new("marker", marker));
    let legend = Legend::new(entries, canvas.width - 60.0, 4);
    legend.draw(&mut canvas, [30.0, top]);
    canvas.height = top + legend.height() + 12.0;
    canvas.finish()
}

/// A load that is hardly seen from the side.
fn across(canvas: &mut Canvas, at: Px) {
    canvas.circle(at, 10.0, &format!(r#"fill="none" stroke="{FORCE}" stroke-width="2.6""#));
}

fn marker(canvas: &mut Canvas, at: Px) {
    canvas.circle(at, 4.0, &format!(r#"fill="{WORST_POINT}" stroke="{PAPER}" stroke-width="1.2""#));
}

/// From where to where all of them reach, m: ahead, and up, with room for loads.
fn extents(postures: &[DrawnPosture]) -> [Interval; 2] {
    let all = || postures.iter().flat_map(|one| one.points.iter().chain(&one.markers).chain(one.loaded()));
    let reached = [0, 1].map(|axis| {
        // The foot of the robot is seen, too.
        let ends = all().map(|point| point[axis]).fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        Interval::spanning(ends.0, ends.1)
    });
    let beside = reached[0].width() * BESIDE / (ROOM - 2.0 * BESIDE);
    reached.map(|range| Interval::spanning(range.min() - beside, range.max() + beside))
}

/// The length of 1 m, in the lower left corner.
fn metre(canvas: &mut Canvas, frame: &Frame) {
    let [[left, bottom], _] = frame.corners();
    let (from, y) = (left + 8.0, bottom - 9.0);
    let to = from + frame.x.at(1.0) - frame.x.at(0.0);
    canvas.line([from, y], [to, y], &format!(r#"stroke="{INK}" stroke-width="2""#));
    for x in [from, to] {
        canvas.line([x, y - 4.0], [x, y + 4.0], &format!(r#"stroke="{INK}" stroke-width="1.4""#));
    }
    canvas.text([to + 7.0, y], "1 m", Font::new(11.5));
}

/// From where it acts, px, and where it points.
fn draw_load(canvas: &mut Canvas, from: Px, along: [f64; 2]) {
    if along[0].hypot(along[1]) < ACROSS {
        across(canvas, from);
    } else {
        let look = format!(r#"stroke="{FORCE}" stroke-width="2.6""#);
        arrow(canvas, from, [from[0] + LOAD * along[0], from[1] - LOAD * along[1]], &look);
    }
}

/// One posture under its left upper corner, in a picture that shows so much, m, and is so high, px.
fn draw(
    canvas: &mut Canvas,
    posture: &DrawnPosture,
    [left, top]: Px,
    ([ahead, up], height): ([Interval; 2], f64),
) -> Frame {
    let DrawnPosture { runs: [first, last], joint_1, points, markers, load } = posture;
    let name = if first == last { format!("run {first}") } else { format!("runs {first} to {last}") };
    let bold = Font::new(13.0).bold();
    let (text, expected) = load.as_ref().map_or_else(Default::default, |load| {
        (format!(": {}", load.text), format!(", {:.2} mm expected", load.expected_mm))
    });
    canvas.text([left, top + 10.0], &bold.cut(&format!("{name}{text}"), ROOM), bold);
    let small = Font::new(11.5).colour(GREY);
    canvas.text([left, top + 27.0], &small.cut(&format!("joint 1 at {joint_1:.2}°{expected}"), ROOM), small);
    let top = top + HEAD;
    let frame = Frame {
        x: Axis::new(ahead.min(), ahead.max(), [left, left + ROOM]),
        y: Axis::new(up.min(), up.max(), [top + height, top]),
    };
    canvas.rect(
        [left, top],
        [left + ROOM, top + height],
        &format!(r#"fill="none" stroke="{GREY}" stroke-width="0.6""#),
    );
    let floor = frame.y.at(0.0);
    canvas.line([left, floor], [left + ROOM, floor], &format!(r#"stroke="{GREY}" stroke-width="1""#));
    let at = |[x, z]: [f64; 2]| frame.at(x, z);
    let shoulder = at(points[0]);
    let base = format!(r#"stroke="{BASE}" stroke-width="16" stroke-linecap="round""#);
    canvas.line(at([0.0, 0.0]), [frame.x.at(0.0), shoulder[1]], &base);
    canvas.line([frame.x.at(0.0), shoulder[1]], shoulder, &base);
    for (link, width) in points.windows(2).zip(LINKS).rev() {
        for (colour, width) in [(INK, width), (ARM, width - 3.0)] {
            let look = format!(r#"stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#);
            canvas.line(at(link[0]), at(link[1]), &look);
        }
    }
    // What carries load point and markers.
    for point in markers.iter().chain(posture.loaded()) {
        canvas.line(at(points[3]), at(*point), &format!(r#"stroke="{GREY}" stroke-width="2""#));
    }
    for joint in &points[..3] {
        canvas.circle(at(*joint), 3.4, &format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="1.6""#));
    }
    if let Some(load) = load {
        draw_load(canvas, at(load.arrow[0]), load.arrow[1]);
    }
    for point in markers {
        marker(canvas, at(*point));
    }
    frame
}
