//! What a calibration changes: every row's error as drawn and calibrated.

use crate::answer::{CalibrateAnswer, words};
use stiffarm::calibrate::Off;
use stiffarm::palette::{DEFLECTION, FAINT};

use super::FigureSize;
use super::axes::{Axis, Frame, heading};
use super::canvas::Canvas;
use super::legend::{Entry, Legend};
use super::marks::left_out;

/// Height of the diagram, px.
const HEIGHT: f64 = 320.0;
/// Left of it, px.
const LEFT: f64 = 66.0;

/// The figure as SVG text.
pub fn svg(answer: &CalibrateAnswer, figure_size: &FigureSize) -> String {
    let found = &answer.found;
    let mut canvas = Canvas::of(figure_size);
    let title = format!("{}: errors as drawn and calibrated", answer.robot.full_name());
    let mm = |m: f64| words::fixed(m * 1e3, 3);
    let [drawn, taken] = [&found.levels[0], found.taken()];
    let subtitle = format!(
        "{} rows; {} mm rms as drawn, {} mm calibrated ({})",
        found.rows.len(),
        mm(drawn.rms),
        mm(taken.rms),
        found.level.name()
    );
    let top = heading(&mut canvas, &title, &subtitle) + 34.0;
    let right = canvas.width - 24.0;
    rows(&mut canvas, answer, ([LEFT, right], [top + HEIGHT, top]));
    let legend = Legend::new(entries(), canvas.width - 80.0, 4);
    legend.draw(&mut canvas, [40.0, top + HEIGHT + 50.0]);
    canvas.height = top + HEIGHT + 62.0 + legend.height();
    canvas.finish()
}

fn rows(canvas: &mut Canvas, answer: &CalibrateAnswer, (x, y): ([f64; 2], [f64; 2])) {
    let found = &answer.found;
    let lines = found.rows.iter().map(|row| row.line).chain(found.wrong_rows.iter().map(|row| row.line));
    let (first, last) = lines.fold((usize::MAX, 1), |(low, high), line| (low.min(line), high.max(line)));
    let most = found.rows.iter().map(|row| 1e3 * row.before.max(row.after)).fold(0.0, f64::max);
    let frame = Frame { x: Axis::new(first as f64 - 1.0, last as f64 + 1.0, x), y: Axis::new(0.0, 1.1 * most, y) };
    frame.grid(canvas);
    let wide = (0.7 * (x[1] - x[0]) / (last - first + 2) as f64).clamp(0.5, 6.0);
    for Off { line, before, after } in &found.rows {
        let (at, before, after) = (*line as f64, 1e3 * before, 1e3 * after);
        canvas.with_tooltip(&format!("line {line}: {before:.3} mm as drawn, {after:.3} mm calibrated"), |canvas| {
            let mut bar = |high: f64, colour: &str| {
                canvas.line(
                    frame.at(at, 0.0),
                    frame.at(at, high),
                    &format!(r#"stroke="{colour}" stroke-width="{wide:.2}""#),
                );
            };
            bar(before, FAINT);
            bar(after, DEFLECTION);
        });
    }
    for row in &found.wrong_rows {
        let [x, y] = frame.at(row.line as f64, 1.06 * most);
        left_out(canvas, [x, y]);
    }
    frame.draw(canvas, "line of the table", "error [mm]");
    frame.headline(canvas, "the largest error of every row");
}

fn entries() -> Vec<Entry> {
    vec![Entry::bar("as drawn", FAINT), Entry::bar("calibrated", DEFLECTION), Entry::crossed("left out: wrong")]
}
