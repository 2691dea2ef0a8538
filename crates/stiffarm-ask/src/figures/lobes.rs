//! From which depth on a cut swings, over the speed of the spindle, with the interval and the cut itself.

use crate::answer::ChatterAnswer;
use stiffarm::chatter::{Edge, LONGEST};
use stiffarm::palette::{DEFLECTION, FORCE, INK};

use super::FigureSize;
use super::axes::{Axis, Frame, heading};
use super::canvas::{Canvas, path, rect_path};
use super::legend::{Entry, Legend};

/// Height of the diagram, px.
const HEIGHT: f64 = 380.0;

/// A speed, rpm, with depths in mm: the least, and where it lies with 90 %.
struct Point {
    rpm: f64,
    depth: f64,
    between: Option<[f64; 2]>,
}

/// The figure as SVG text.
pub(crate) fn svg(answer: &ChatterAnswer, figure_size: &FigureSize) -> String {
    let found = &answer.chatter;
    let mut canvas = Canvas::of(figure_size);
    let title = format!("{}: from which depth a cut swings with the arm", answer.robot.full_name());
    let top = heading(&mut canvas, &title, &answer.heading()) + 20.0;
    let points = points(answer);
    let own = [answer.rpm(), found.cut.milling.engagement.depth() * 1e3];
    let edge = found.at_speed.map(|edge: Edge| edge.depth * 1e3);
    // Draws that swing far above both the cut and its edge must not press them flat: the legend says that the band goes on.
    let most = edge.map_or(own[1], |edge| edge.max(own[1]));
    let last = points.last().map_or(own[0], |point| point.rpm);
    let frame = Frame {
        x: Axis::new(0.0, last, [78.0, canvas.width - 24.0]),
        y: Axis::new(0.0, 2.5 * most, [top + HEIGHT, top]),
    };
    let entries = draw(&mut canvas, &frame, &points, found.any_speed.map(|edge| edge.depth * 1e3), own);
    frame.draw(&mut canvas, "speed of the spindle [rpm]", "axial depth [mm]");
    let legend = Legend::new(entries, canvas.width - 80.0, 2);
    legend.draw(&mut canvas, [40.0, top + HEIGHT + 54.0]);
    canvas.height = top + HEIGHT + 68.0 + legend.height();
    canvas.finish()
}

/// Depths beyond the longest edge as that edge: they leave the frame.
fn points(answer: &ChatterAnswer) -> Vec<Point> {
    let mm = |depth: Option<f64>| depth.unwrap_or(LONGEST) * 1e3;
    let lobes = answer.chatter.lobes.iter();
    lobes
        .map(|lobe| Point {
            rpm: lobe.spindle * 60.0 / std::f64::consts::TAU,
            depth: mm(lobe.edge.map(|edge| edge.depth)),
            between: lobe.spread.map(|spread| [mm(spread.p05), mm(spread.p95)]),
        })
        .collect()
}

/// Band, curve, the depth of any speed and the cut; what the legend says of them.
fn draw(canvas: &mut Canvas, frame: &Frame, points: &[Point], any: Option<f64>, [rpm, depth]: [f64; 2]) -> Vec<Entry> {
    let curve = format!(r#"fill="none" stroke="{DEFLECTION}" stroke-width="2" stroke-linejoin="round""#);
    let dashed = format!(r#"fill="none" stroke="{INK}" stroke-width="1.2" stroke-dasharray="6 4""#);
    let within = format!(r#"fill="{DEFLECTION}" fill-opacity="0.18""#);
    let mut entries = vec![Entry::line("swings above", curve.clone())];
    let band: Vec<(f64, [f64; 2])> = points.iter().filter_map(|point| Some((point.rpm, point.between?))).collect();
    frame.grid(canvas);
    let [[left, bottom], [right, top]] = frame.corners();
    canvas.clipped(&rect_path([left, top], [right, bottom]), |canvas| {
        if !band.is_empty() {
            let low = band.iter().map(|(rpm, [low, _])| frame.at(*rpm, *low));
            let high = band.iter().rev().map(|(rpm, [_, high])| frame.at(*rpm, *high));
            let outline: Vec<_> = low.chain(high).collect();
            canvas.path(&path(&outline, true), &within);
        }
        let line: Vec<_> = points.iter().map(|point| frame.at(point.rpm, point.depth)).collect();
        canvas.polyline(&line, &curve);
        if let Some(any) = any {
            canvas.line(frame.at(frame.x.from, any), frame.at(frame.x.to, any), &dashed);
        }
    });
    let mark = format!(r#"fill="{FORCE}""#);
    canvas.circle(frame.at(rpm, depth), 5.0, &mark);
    if !band.is_empty() {
        let goes_on = band.iter().any(|(_, [_, high])| frame.y.to < *high);
        let what = if goes_on { "90 % of draws; the band goes on above" } else { "90 % of draws" };
        entries.push(Entry::new(what, move |canvas, [x, y]| {
            canvas.rect([x - 12.0, y - 6.0], [x + 12.0, y + 6.0], &within);
        }));
    }
    if any.is_some() {
        entries.push(Entry::line("no speed swings below", dashed));
    }
    entries.push(Entry::new("the cut", move |canvas, [x, y]| canvas.circle([x, y], 5.0, &mark)));
    entries
}
