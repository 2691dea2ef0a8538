//! Two architectures compared over link ratio and task size, as the paper's Fig. 4 to 9.

use stiffarm::palette::{BEST_RATIO, GREY, INK, PAPER, RATIOS};

use super::axes::{Axis, Frame, heading};
use super::bands::{Bands, Colours, Field};
use super::canvas::{Canvas, Font, Px, path, rect_path};
use super::contour::Grid;
use super::labels::Occupied;
use super::legend::{Entry, Legend};
use super::line::Node;
use super::{FigureError, FigureSize};

const DASH: &str = r#"stroke-dasharray="7 4""#;
const BOUNDARY: &str = r#"stroke-width="1.2" stroke-dasharray="2 3""#;
const SIZE: &str = "task size d/(l₂+l₃)";

/// One task shape.
pub(crate) struct StudyPanel {
    /// The shape.
    pub title: String,
    /// Names of the two that are compared.
    pub contenders: [String; 2],
    /// Link ratios `l3/l2`, rising.
    pub mus: Vec<f64>,
    /// Task sizes over `l2 + l3`, rising.
    pub sizes: Vec<f64>,
    /// Deflection over `k F (l2 + l3)^2` per contender, row by row: sizes x mus. Absent where the task does not fit.
    pub accuracy: [Vec<Option<f64>>; 2],
    /// Best ratio over size, as (size, ratio) by rising size.
    pub best: [Vec<(f64, f64)>; 2],
    /// Accuracy over size.
    pub curves: Vec<StudyCurve>,
    /// Sizes at which the better contender changes.
    pub boundaries: Vec<f64>,
    /// A robot with its work among all this.
    pub mark: Option<StudyMark>,
}

/// Where a robot with its work stands.
pub(crate) struct StudyMark {
    /// Its name.
    pub label: String,
    /// Its link ratio, and the size of its work.
    pub at: (f64, f64),
    /// What each contender would have there.
    pub accuracy: [Option<f64>; 2],
}

/// Accuracy over size.
pub(crate) struct StudyCurve {
    /// The ratio; the same label stands for the same colour.
    pub label: String,
    /// 0 or 1.
    pub contender: usize,
    /// Size and accuracy, by rising size.
    pub points: Vec<(f64, f64)>,
    /// Each size at its best ratio.
    pub is_best: bool,
}

/// Three diagrams in a row need so many px; on narrow paper they get smaller.
const WIDTH: f64 = 1000.0;
/// Where the three diagrams of a row stand, px.
const COLUMNS: [(f64, f64); 3] = [(66.0, 298.0), (368.0, 600.0), (742.0, 984.0)];
const HEIGHT: f64 = 250.0;

/// The figure as SVG text: a row per panel.
///
/// # Errors
/// Where a panel's accuracies do not fit its ratios and sizes.
pub(crate) fn svg(title: &str, panels: &[StudyPanel], figure_size: &FigureSize) -> Result<String, FigureError> {
    let mut canvas = Canvas::of(figure_size);
    canvas.width = WIDTH;
    let subtitle = "normalised accuracy ε/(kF), lengths over l₂+l₃: the worst deflection of the best-placed task, without joint limits";
    let mut y = heading(&mut canvas, title, subtitle) + 14.0;
    if panels.is_empty() {
        canvas.text([20.0, y], "nothing to show", Font::new(13.0));
        y += 20.0;
    }
    let labels = labels(panels);
    for panel in panels {
        let bold = Font::new(15.0).bold();
        canvas.text([20.0, y + 4.0], &bold.cut(&panel.title, WIDTH - 40.0), bold);
        y += 40.0;
        draw_row(&mut canvas, panel, &labels, y)?;
        y += HEIGHT + 62.0;
    }
    let legend = Legend::new(entries(panels, &labels), WIDTH - 60.0, 4);
    legend.draw(&mut canvas, [40.0, y - 8.0]);
    canvas.height = y + legend.height() + 6.0;
    Ok(canvas.finish())
}

/// The labels of the curves for fixed ratios, in the order in which they come.
fn labels(panels: &[StudyPanel]) -> Vec<&str> {
    let mut labels: Vec<&str> = Vec::new();
    for curve in panels.iter().flat_map(|panel| &panel.curves).filter(|curve| !curve.is_best) {
        if !labels.contains(&curve.label.as_str()) {
            labels.push(&curve.label);
        }
    }
    labels
}

fn draw_row(canvas: &mut Canvas, panel: &StudyPanel, labels: &[&str], top: f64) -> Result<(), FigureError> {
    let cells = panel.mus.len() * panel.sizes.len();
    for accuracy in &panel.accuracy {
        if accuracy.len() != cells {
            return Err(FigureError::Shape { what: "sizes x ratios", found: accuracy.len(), expected: cells });
        }
    }
    let grids = [0, 1].map(|contender| {
        let columns = panel.mus.len();
        Grid::new(columns, panel.sizes.len(), |i, j| panel.accuracy[contender][j * columns + i])
    });
    // One scale for both, so that colours can be compared.
    let known = grids.iter().filter_map(Grid::extremes);
    let range = known.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let fits = |j: usize| grids.iter().any(|grid| (0..grid.columns).any(|i| grid.get(i as i64, j as i64).is_some()));
    let largest = (0..panel.sizes.len()).rev().find(|&j| fits(j)).unwrap_or(panel.sizes.len());
    // One size more than fits anywhere shows that the area ends there.
    let fitting = panel.sizes.iter().copied().take(largest + 2);
    let bottom = top + HEIGHT;
    for contender in [0, 1] {
        let (left, right) = COLUMNS[contender];
        let frame =
            Frame { x: scale(panel.mus.iter().copied(), [left, right]), y: scale(fitting.clone(), [bottom, top]) };
        draw_contours(canvas, panel, &panel.best[contender], &frame, (&grids[contender], range.map(bands)));
        draw_best(canvas, &frame, &panel.best[contender]);
        if let Some(mark) = &panel.mark {
            draw_mark(canvas, &frame, (mark, contender), mark.at);
        }
        frame.draw(canvas, "link ratio μ = l₃/l₂", SIZE);
        frame.headline(canvas, &panel.contenders[contender]);
    }
    if let Some(range) = range {
        let right = COLUMNS[1].1;
        bands(range).bar(canvas, [right + 14.0, bottom], [right + 30.0, top], "accuracy ε/(kF)");
    }
    draw_curves(canvas, panel, labels, top);
    Ok(())
}

fn bands(range: [f64; 2]) -> Bands {
    Bands::of(range, Colours::Deflections)
}

fn scale(values: impl Iterator<Item = f64>, px: [f64; 2]) -> Axis {
    let finite = values.filter(|value| value.is_finite());
    let (from, to) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    Axis::new(from, to, px)
}

fn draw_contours(
    canvas: &mut Canvas,
    panel: &StudyPanel,
    best: &[(f64, f64)],
    frame: &Frame,
    (grid, bands): (&Grid, Option<Bands>),
) {
    let [[left, bottom], [right, top]] = frame.corners();
    let Some(bands) = bands.filter(|_| grid.extremes().is_some()) else {
        let middle = [f64::midpoint(left, right), f64::midpoint(bottom, top)];
        canvas.text(middle, "the task never fits", Font::new(13.0).middle());
        return;
    };
    let value = |values: &[f64], at: f64| {
        let below = (at as usize).min(values.len() - 1);
        let above = (below + 1).min(values.len() - 1);
        values[below] + at.fract() * (values[above] - values[below])
    };
    let at = |[i, j]: Node| frame.at(value(&panel.mus, i), value(&panel.sizes, j));
    let region = grid.smooth_outline();
    let mut occupied = Occupied::default();
    occupied.take(&[[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]], 5.0);
    occupied.take(&placed(frame, best.iter().map(|&(size, mu)| (mu, size))), 5.0);
    Field { grid, region: &region, bands, tolerance: None, at: &at }.draw(canvas, Font::new(11.5), &mut occupied);
}

/// The best ratio over size.
fn draw_best(canvas: &mut Canvas, frame: &Frame, best: &[(f64, f64)]) {
    let [corner, opposite] = frame.corners();
    let points: Vec<Px> = placed(frame, best.iter().map(|&(size, mu)| (mu, size)));
    canvas.clipped(&rect_path(corner, opposite), |canvas| {
        let d = path(&points, false);
        canvas.path(
            &d,
            &format!(r#"fill="none" stroke="{PAPER}" stroke-opacity="0.8" stroke-width="5" stroke-linejoin="round""#),
        );
        canvas.path(&d, &format!(r#"fill="none" stroke="{BEST_RATIO}" stroke-width="2.8" stroke-linejoin="round""#));
    });
}

/// A robot's place in a diagram, where it lies in it.
fn draw_mark(canvas: &mut Canvas, frame: &Frame, (mark, contender): (&StudyMark, usize), (x, y): (f64, f64)) {
    if !(frame.x.contains(x) && frame.y.contains(y)) {
        return;
    }
    let (mu, size) = mark.at;
    let accuracy = mark.accuracy[contender].map_or_else(|| "no place".into(), |value| format!("{value:.4}"));
    let tooltip = format!("{}: μ = {mu:.3}, d/(l₂+l₃) = {size:.3}, ε/(kF) = {accuracy}", mark.label);
    canvas.with_tooltip(&tooltip, |canvas| dot(canvas, frame.at(x, y), contender));
}

/// Full for the first contender, open for the second, as their lines are drawn through and dashed.
fn dot(canvas: &mut Canvas, at: Px, contender: usize) {
    let fill = if contender == 0 { INK } else { PAPER };
    canvas.circle(at, 7.0, &format!(r#"fill="{PAPER}""#));
    canvas.circle(at, 4.5, &format!(r#"fill="{fill}" stroke="{INK}" stroke-width="2""#));
}

fn placed(frame: &Frame, points: impl Iterator<Item = (f64, f64)>) -> Vec<Px> {
    points.filter(|(x, y)| x.is_finite() && y.is_finite()).map(|(x, y)| frame.at(x, y)).collect()
}

fn draw_curves(canvas: &mut Canvas, panel: &StudyPanel, labels: &[&str], top: f64) {
    let ((left, right), bottom) = (COLUMNS[2], top + HEIGHT);
    let points = || panel.curves.iter().flat_map(|curve| &curve.points);
    let marked =
        || panel.mark.iter().flat_map(|mark| mark.accuracy.into_iter().flatten().map(|value| (mark.at.1, value)));
    let sizes = points().map(|point| point.0).chain(panel.boundaries.iter().copied()).chain(marked().map(|at| at.0));
    let y = scale(points().map(|point| point.1).chain(marked().map(|at| at.1)), [bottom, top]);
    let y = Axis::new((y.from - 0.06 * (y.to - y.from)).max(0.0), y.to + 0.06 * (y.to - y.from), y.px);
    let frame = Frame { x: scale(sizes, [left, right]), y };
    frame.grid(canvas);
    for &size in panel.boundaries.iter().filter(|size| frame.x.contains(**size)) {
        let x = frame.x.at(size);
        canvas.line([x, bottom], [x, top], &format!(r#"stroke="{INK}" {BOUNDARY}"#));
    }
    canvas.clipped(&rect_path([left, bottom], [right, top]), |canvas| {
        // The best ones first and thick, so that a fixed ratio that is as good still shows.
        for best in [true, false] {
            for curve in panel.curves.iter().filter(|curve| curve.is_best == best) {
                let points = placed(&frame, curve.points.iter().copied());
                canvas.path(&path(&points, false), &line(curve.is_best, curve.contender, number(labels, &curve.label)));
            }
        }
    });
    for (contender, mark) in panel.mark.iter().flat_map(|mark| [(0, mark), (1, mark)]) {
        if let Some(accuracy) = mark.accuracy[contender] {
            draw_mark(canvas, &frame, (mark, contender), (mark.at.1, accuracy));
        }
    }
    if panel.curves.is_empty() {
        let middle = [f64::midpoint(left, right), f64::midpoint(bottom, top)];
        canvas.text(middle, "no curves", Font::new(13.0).middle().colour(GREY));
    }
    frame.draw(canvas, SIZE, "accuracy ε/(kF)");
    frame.headline(canvas, "accuracy against size");
}

fn number(labels: &[&str], label: &str) -> usize {
    labels.iter().position(|known| *known == label).unwrap_or_default()
}

fn line(is_best: bool, contender: usize, number: usize) -> String {
    let (colour, width) = if is_best { (BEST_RATIO, 3.4) } else { (RATIOS[number % RATIOS.len()], 1.4) };
    let dash = if contender == 0 { "" } else { DASH };
    format!(r#"fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round" {dash}"#)
}

fn entries(panels: &[StudyPanel], labels: &[&str]) -> Vec<Entry> {
    let mut entries = Vec::new();
    if let Some(panel) = panels.first() {
        for (contender, dash) in ["", DASH].into_iter().enumerate() {
            let look = format!(r#"stroke="{INK}" stroke-width="1.6" {dash}"#);
            entries.push(Entry::line(panel.contenders[contender].clone(), look));
        }
        entries.push(Entry::line("best link ratio", line(true, 0, 0)));
    }
    entries.extend(labels.iter().enumerate().map(|(i, label)| Entry::line(*label, line(false, 0, i))));
    for mark in panels.iter().filter_map(|panel| panel.mark.as_ref()) {
        for (contender, name) in
            panels[0].contenders.iter().enumerate().filter(|(contender, _)| mark.accuracy[*contender].is_some())
        {
            entries.push(Entry::new(format!("{}, were it {name}", mark.label), move |canvas, at| {
                dot(canvas, at, contender);
            }));
        }
    }
    if panels.iter().any(|panel| !panel.boundaries.is_empty()) {
        entries.push(Entry::line("the better one changes", format!(r#"stroke="{INK}" {BOUNDARY}"#)));
    }
    entries
}

#[cfg(test)]
mod tests {
    use super::super::is_svg;
    use super::*;

    fn panel(mus: usize, sizes: usize, accuracy: Option<f64>) -> StudyPanel {
        let points = |count: usize| (0..count).map(|i| 0.5 + i as f64).collect::<Vec<_>>();
        StudyPanel {
            title: "<A>".into(),
            contenders: ["serial & co".into(), "a very long name ".repeat(9)],
            mus: points(mus),
            sizes: points(sizes),
            accuracy: [vec![accuracy; mus * sizes], vec![None; mus * sizes]],
            best: [vec![(0.5, 1.0), (f64::NAN, 1.0)], vec![]],
            curves: vec![StudyCurve { label: "x".into(), contender: 7, points: vec![], is_best: false }],
            boundaries: vec![0.7, f64::NAN],
            mark: Some(StudyMark { label: "<R>".into(), at: (1.0, 0.7), accuracy: [Some(1.0), None] }),
        }
    }

    #[test]
    fn odd_panels_make_figures() {
        let panels = [
            (0, 0, None),
            (1, 1, Some(1.0)),
            (3, 4, Some(0.0)),
            (5, 5, None),
            (3, 3, Some(f64::NAN)),
            (2, 9, Some(2.0)),
        ];
        let panels = panels.map(|(mus, sizes, accuracy)| panel(mus, sizes, accuracy));
        assert!(is_svg(&svg("", &[], &FigureSize::default()).unwrap()));
        assert!(is_svg(&svg("all", &panels, &FigureSize::default()).unwrap()));
    }

    #[test]
    fn accuracies_that_do_not_fit_the_grid_are_refused() {
        let short = StudyPanel { mus: vec![1.0], ..panel(3, 3, None) };
        let message = svg("", &[short], &FigureSize::default()).unwrap_err().to_string();
        assert_eq!(message, "a figure of sizes x ratios: 9 values; expected 3");
    }
}
