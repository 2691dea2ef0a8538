//! What an identification explains: compliances with their intervals, what remains of every row, measured against fitted, correlations.

use crate::answer::{IdentifyAnswer, words};
use stiffarm::identify::{Estimate, Identification, Residual};
use stiffarm::palette::{DEFLECTION, FAINT, GREY, INK, OTHERS, PAPER, on_margin_scale};

use super::FigureSize;
use super::axes::{Axis, Frame, heading};
use super::canvas::{Canvas, Font};
use super::legend::{Entry, Legend};
use super::marks::left_out;

/// Height of a diagram, px.
const HEIGHT: f64 = 250.0;
/// Between its left edge and the frame, px.
const LEFT: f64 = 66.0;
/// Between two rows of diagrams, px.
const BELOW: f64 = 86.0;

/// The figure as SVG text.
pub(crate) fn svg(answer: &IdentifyAnswer, figure_size: &FigureSize) -> String {
    let found = &answer.found;
    let mut canvas = Canvas::of(figure_size);
    let title = format!("{}: what the measurements tell of its drives", answer.before.full_name());
    let percent = |share: f64| words::fixed(100.0 * share, 1);
    let left_out = found
        .explained_left_out()
        .map_or_else(String::new, |share| format!(", {} % of postures left out", percent(share)));
    let subtitle = format!(
        "{} rows in {} postures; the drives explain {} %{left_out}",
        found.residuals.len(),
        found.postures,
        percent(found.explained())
    );
    let top = heading(&mut canvas, &title, &subtitle) + 34.0;
    let half = canvas.width / 2.0;
    let frame = |column: f64, row: f64| {
        let (left, top) = (LEFT + column * half, top + row * (HEIGHT + BELOW));
        ([left, half * (column + 1.0) - 24.0], [top + HEIGHT, top])
    };
    compliances(&mut canvas, found, frame(0.0, 0.0));
    correlations(&mut canvas, found, frame(1.0, 0.0));
    remainders(&mut canvas, found, frame(0.0, 1.0));
    fit(&mut canvas, found, frame(1.0, 1.0));
    let bottom = top + 2.0 * HEIGHT + BELOW;
    let legend = Legend::new(entries(), canvas.width - 80.0, 4);
    legend.draw(&mut canvas, [40.0, bottom + 50.0]);
    canvas.height = bottom + 62.0 + legend.height();
    canvas.finish()
}

type Room = ([f64; 2], [f64; 2]);

/// What each drive was found to have, with 95 % intervals.
fn compliances(canvas: &mut Canvas, found: &Identification, (x, y): Room) {
    let urad = |k: f64| k * 1e6;
    let ends = |one: &Estimate| one.interval.map_or(0.0, |[_, high]| urad(high)).max(one.compliance.map_or(0.0, urad));
    let known = found.estimates.iter().filter(|one| one.unknown.is_none()).map(ends).fold(0.0, f64::max);
    // An interval that says nothing must not press the others flat.
    let most =
        found.estimates.iter().map(ends).fold(0.0, f64::max).min(if 0.0 < known { 2.0 * known } else { f64::INFINITY });
    let count = found.estimates.len() as f64;
    let frame = Frame { x: Axis::new(0.5, count + 0.5, x), y: Axis::new(0.0, 1.05 * most, y) };
    frame.grid(canvas);
    for (i, one) in found.estimates.iter().enumerate() {
        let at = i as f64 + 1.0;
        let colour = if one.unknown.is_none() { DEFLECTION } else { OTHERS };
        let place = |value: f64| frame.at(at, value.min(frame.y.to));
        if let Some(k) = one.compliance {
            let ([left, base], [right, _]) = (frame.at(at - 0.28, 0.0), frame.at(at + 0.28, 0.0));
            canvas.rect([left, base], [right, place(urad(k))[1]], &format!(r#"fill="{colour}""#));
        }
        if let Some([low, high]) = one.interval {
            let ([x, from], [_, to]) = (place(urad(low)), place(urad(high)));
            let look = format!(r#"stroke="{INK}" stroke-width="1.4""#);
            canvas.line([x, from], [x, to], &look);
            canvas.line([x - 6.0, from], [x + 6.0, from], &look);
            if urad(high) <= frame.y.to {
                canvas.line([x - 6.0, to], [x + 6.0, to], &look);
            } else {
                canvas.goes_on([x, to], [0.0, -9.0], 5.0, INK);
            }
        } else {
            let [x, y] = frame.at(at, 0.0);
            canvas.text([x, y - 12.0], "not seen", Font::new(12.0).middle().colour(GREY));
        }
    }
    frame.draw(canvas, "drive", "compliance [urad/(N m)]");
    frame.headline(canvas, "compliance found, 95 % interval");
}

/// How the compliances found hang together.
fn correlations(canvas: &mut Canvas, found: &Identification, (x, y): Room) {
    let count = found.estimates.len();
    // Square cells.
    let side = (x[1] - x[0]).min(y[0] - y[1]);
    let middle = f64::midpoint(x[0], x[1]);
    let (left, top, cell) = (middle - side / 2.0, y[1], side / count as f64);
    for i in 0..count {
        for j in 0..count {
            let value = found.correlation[(i, j)];
            let (x, y) = (left + cell * j as f64, top + cell * i as f64);
            let look = format!(r#"fill="{}" stroke="{PAPER}" stroke-width="1""#, on_margin_scale(1.0 - value.abs()));
            canvas.rect([x, y], [x + cell, y + cell], &look);
            let text = words::fixed(value, 2);
            canvas.text([x + cell / 2.0, y + cell / 2.0], &text, Font::new(12.0).middle().halo());
        }
        let name = format!("{}", i + 1);
        canvas.text([left - 8.0, top + cell * (i as f64 + 0.5)], &name, Font::new(12.0).end());
        canvas.text([left + cell * (i as f64 + 0.5), top + side + 12.0], &name, Font::new(12.0).middle());
    }
    let bold = Font::new(13.0).bold().middle();
    canvas.text([middle, top - 12.0], "correlation of the drives' compliances", bold);
}

/// Every row: how far it moved, and what remains of that.
fn remainders(canvas: &mut Canvas, found: &Identification, (x, y): Room) {
    let rows = &found.residuals;
    let mm = |one: &Residual| 1e3 * one.moved.norm();
    let most = rows.iter().map(|one| mm(one).max(1e3 * one.after.norm())).fold(0.0, f64::max);
    let last = rows.iter().map(|one| one.row).max().unwrap_or(1) as f64;
    let frame = Frame { x: Axis::new(0.0, last + 1.0, x), y: Axis::new(0.0, 1.05 * most, y) };
    frame.grid(canvas);
    for one in rows {
        let at = one.row as f64;
        let after = 1e3 * one.after.norm();
        let tooltip = format!("row {}: moved {:.3} mm, {after:.3} mm not explained", one.row, mm(one));
        canvas.with_tooltip(&tooltip, |canvas| {
            canvas.line(frame.at(at, 0.0), frame.at(at, mm(one)), &format!(r#"stroke="{FAINT}" stroke-width="4""#));
            canvas.line(frame.at(at, 0.0), frame.at(at, after), &format!(r#"stroke="{DEFLECTION}" stroke-width="4""#));
        });
        if found.outliers.iter().any(|outlier| outlier.row == one.row) {
            let [x, y] = frame.at(at, after);
            left_out(canvas, [x, y - 9.0]);
        }
    }
    frame.draw(canvas, "row", "displacement [mm]");
    frame.headline(canvas, "what remains of every displacement");
}

/// Every coordinate: measured against fitted.
fn fit(canvas: &mut Canvas, found: &Identification, (x, y): Room) {
    let coordinates = || {
        found
            .residuals
            .iter()
            .flat_map(|one| (0..3).map(move |c| (one.row, 1e3 * (one.moved[c] - one.after[c]), 1e3 * one.moved[c])))
    };
    let ends =
        |values: &mut dyn Iterator<Item = f64>| values.fold([0.0_f64; 2], |[low, high], v| [low.min(v), high.max(v)]);
    let [low, high] = ends(&mut coordinates().flat_map(|(_, fitted, measured)| [fitted, measured]));
    let (low, high) = (1.05 * low, 1.05 * high);
    let frame = Frame { x: Axis::new(low, high, x), y: Axis::new(low, high, y) };
    frame.grid(canvas);
    canvas.line(
        frame.at(low, low),
        frame.at(high, high),
        &format!(r#"stroke="{INK}" stroke-width="1" stroke-dasharray="6 4""#),
    );
    for (row, fitted, measured) in coordinates() {
        if found.outliers.iter().any(|outlier| outlier.row == row) {
            left_out(canvas, frame.at(fitted, measured));
        } else {
            canvas.circle(frame.at(fitted, measured), 2.6, &format!(r#"fill="{DEFLECTION}" fill-opacity="0.6""#));
        }
    }
    frame.draw(canvas, "fitted [mm]", "measured [mm]");
    frame.headline(canvas, "x, y and z of every row");
}

fn entries() -> Vec<Entry> {
    vec![
        Entry::bar("identified, and what remains", DEFLECTION),
        Entry::bar("not identified", OTHERS),
        Entry::bar("as measured", FAINT),
        Entry::crossed("row that does not fit"),
    ]
}
