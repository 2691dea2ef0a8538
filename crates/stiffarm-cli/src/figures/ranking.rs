//! Robots compared: deflection against task size, one diagram per task shape.

use stiffarm::palette::{ESTIMATED, GREY, INK, QUASI_SERIAL_CURVES, SERIAL_CURVES, TOLERANCE};

use super::axes::{Axis, Frame, heading};
use super::canvas::{Canvas, Font, Px, path, rect_path};
use super::legend::{Entry, Legend};
use super::{FigureError, WIDTH, marks};

const DASH: &str = r#"stroke-dasharray="7 4""#;

/// How one robot does over the sizes of one task shape.
pub(crate) struct Curve {
    /// Its name.
    pub robot: String,
    /// Serial or quasi-serial.
    pub serial: bool,
    /// Its geometry or limits are assumed.
    pub estimated: bool,
    /// Size, m, and deflection, mm, by rising size; no point where the task does not fit.
    pub points: Vec<(f64, f64)>,
    /// Beyond the last point the task does not fit.
    pub is_complete: bool,
}

/// One task shape.
pub(crate) struct Panel {
    /// The shape.
    pub title: String,
    /// What the size is, with its unit.
    pub size_label: String,
    /// One per robot.
    pub curves: Vec<Curve>,
    /// Sizes that were asked for, m: thin upright lines.
    pub marks: Vec<f64>,
    /// What the work allows, mm: a level line.
    pub tolerance_mm: Option<f64>,
}

/// How the curves of a robot look, the same in every panel.
struct Style<'a> {
    robot: &'a str,
    serial: bool,
    estimated: bool,
    /// Its number among the robots of its architecture.
    number: usize,
}

impl Style<'_> {
    fn colour(&self) -> &'static str {
        let hues = if self.serial { SERIAL_CURVES } else { QUASI_SERIAL_CURVES };
        hues[self.number % hues.len()]
    }

    fn line(&self) -> String {
        let (width, opacity) = if self.estimated { (1.3, 0.75) } else { (2.4, 1.0) };
        let dash = if self.serial { "" } else { DASH };
        let colour = self.colour();
        format!(
            r#"fill="none" stroke="{colour}" stroke-width="{width}" stroke-opacity="{opacity}" stroke-linejoin="round" {dash}"#
        )
    }

    fn mark(&self, canvas: &mut Canvas, at: Px) {
        let fill = if self.estimated { ESTIMATED } else { self.colour() };
        let look = format!(r#"fill="{fill}" stroke="{}" stroke-width="1.2""#, self.colour());
        marks::mark(canvas, at, self.number, &look);
    }

    fn entry(&self) -> Entry {
        let mark = if self.estimated { " ~" } else { "" };
        let own = Style { robot: "", ..*self };
        Entry::new(format!("{}{mark}", self.robot), move |canvas, [x, y]| {
            canvas.line([x - 18.0, y], [x + 18.0, y], &own.line());
            own.mark(canvas, [x, y]);
        })
    }
}

/// The figure as SVG text.
///
/// A cross ends a complete curve: beyond it the task does not fit.
#[expect(clippy::unnecessary_wraps, reason = "all figures are called alike")]
pub(crate) fn svg(title: &str, panels: &[Panel]) -> Result<String, FigureError> {
    let styles = styles(panels);
    let mut canvas = Canvas::new(WIDTH, 0.0);
    let mut y = heading(&mut canvas, title, "") + 34.0;
    if panels.is_empty() {
        canvas.text([20.0, y], "nothing to show", Font::new(13.0));
        y += 20.0;
    }
    let across = panels.len().clamp(1, 3);
    let column = (WIDTH - 16.0) / across as f64;
    let height = if across == 3 { 330.0 } else { 380.0 };
    for row in panels.chunks(across) {
        for (i, panel) in row.iter().enumerate() {
            let left = column * i as f64 + 62.0;
            draw_panel(&mut canvas, panel, &styles, ([left, y + height], [left + column - 70.0, y]));
        }
        y += height + 74.0;
    }
    y = draw_legends(&mut canvas, panels, &styles, y - 22.0);
    canvas.height = y + 10.0;
    Ok(canvas.finish())
}

fn styles(panels: &[Panel]) -> Vec<Style<'_>> {
    let mut styles: Vec<Style> = Vec::new();
    for curve in panels.iter().flat_map(|panel| &panel.curves) {
        if styles.iter().all(|style| style.robot != curve.robot) {
            let number = styles.iter().filter(|style| style.serial == curve.serial).count();
            styles.push(Style { robot: &curve.robot, serial: curve.serial, estimated: curve.estimated, number });
        }
    }
    styles.sort_by_key(|style| !style.serial);
    styles
}

fn finite(curve: &Curve) -> Vec<(f64, f64)> {
    curve.points.iter().copied().filter(|(size, value)| size.is_finite() && value.is_finite()).collect()
}

/// The range of some values; `None` where there is none.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let finite = values.filter(|value| value.is_finite());
    finite.fold(None, |range, x| Some(range.map_or((x, x), |(a, b): (f64, f64)| (a.min(x), b.max(x)))))
}

fn frame(panel: &Panel, [left, bottom]: Px, [right, top]: Px) -> Frame {
    let points = || panel.curves.iter().flat_map(finite);
    let (x0, x1) = range(points().map(|(size, _)| size).chain(panel.marks.iter().copied())).unwrap_or((0.0, 1.0));
    let (_, mut most) = range(points().map(|(_, value)| value)).unwrap_or((0.0, 1.0));
    // A tolerance far above all curves would press them flat; it is then only named.
    most = most.max(panel.tolerance_mm.filter(|tolerance| *tolerance <= 2.0 * most).unwrap_or(most));
    let start = if x0 <= 0.3 * x1 { x0.min(0.0) } else { x0 - 0.05 * (x1 - x0) };
    Frame {
        x: Axis::new(start, x1 + 0.04 * (x1 - start), [left, right]),
        y: Axis::new(0.0, 1.08 * most, [bottom, top]),
    }
}

fn draw_panel(canvas: &mut Canvas, panel: &Panel, styles: &[Style], (corner, opposite): (Px, Px)) {
    let frame = frame(panel, corner, opposite);
    let [[left, bottom], [right, top]] = frame.corners();
    frame.grid(canvas);
    for &mark in panel.marks.iter().filter(|mark| frame.x.contains(**mark)) {
        let x = frame.x.at(mark);
        canvas.line([x, bottom], [x, top], &format!(r#"stroke="{GREY}" stroke-width="1" {ASKED}"#));
    }
    draw_tolerance(canvas, panel, &frame);
    canvas.clipped(&rect_path([left, bottom + 1.0], [right, top]), |canvas| {
        for curve in &panel.curves {
            let Some(style) = styles.iter().find(|style| style.robot == curve.robot) else { continue };
            let points: Vec<Px> = finite(curve).into_iter().map(|(size, value)| frame.at(size, value)).collect();
            canvas.path(&path(&points, false), &style.line());
            draw_marks(canvas, style, &points);
            if let (Some(&end), true) = (points.last(), curve.is_complete) {
                marks::cross(canvas, end, 4.5, &format!(r#"stroke="{}" stroke-width="2""#, style.colour()));
            }
        }
    });
    if panel.curves.iter().all(|curve| finite(curve).is_empty()) {
        let middle = [f64::midpoint(left, right), f64::midpoint(bottom, top)];
        canvas.text(middle, "fits no robot", Font::new(13.0).middle());
    }
    frame.draw(canvas, &panel.size_label, "deflection [mm]");
    frame.headline(canvas, &panel.title);
}

/// Up to four marks on a curve, at other places than those of its neighbours.
fn draw_marks(canvas: &mut Canvas, style: &Style, points: &[Px]) {
    let every = points.len().div_ceil(4).max(1);
    let last = points.len().saturating_sub(1);
    for (i, &point) in points.iter().enumerate() {
        if i % every == style.number % every && (i < last || last == 0) {
            style.mark(canvas, point);
        }
    }
}

const ASKED: &str = r#"stroke-dasharray="2 3""#;
const TOLERANCE_LINE: &str = r#"fill="none" stroke-width="1.4" stroke-dasharray="10 3 2 3""#;

fn draw_tolerance(canvas: &mut Canvas, panel: &Panel, frame: &Frame) {
    let Some(tolerance) = panel.tolerance_mm.filter(|tolerance| tolerance.is_finite()) else { return };
    let [[left, _], [right, top]] = frame.corners();
    let font = Font::new(12.0).end().halo();
    if frame.y.contains(tolerance) {
        let y = frame.y.at(tolerance);
        canvas.line([left, y], [right, y], &format!(r#"{TOLERANCE_LINE} stroke="{TOLERANCE}""#));
    } else {
        canvas.text([right - 6.0, top + 11.0], &format!("tolerance {tolerance} mm: above"), font);
    }
}

/// The robots by architecture, then what the other signs mean; returns where it ends.
fn draw_legends(canvas: &mut Canvas, panels: &[Panel], styles: &[Style], mut y: f64) -> f64 {
    for (serial, name) in [(true, "serial"), (false, "quasi-serial")] {
        let entries: Vec<Entry> = styles.iter().filter(|style| style.serial == serial).map(Style::entry).collect();
        if entries.is_empty() {
            continue;
        }
        let legend = Legend::new(entries, WIDTH - 140.0, 3);
        canvas.text([20.0, y + 11.0], name, Font::new(12.5).bold());
        legend.draw(canvas, [125.0, y]);
        y += legend.height() + 6.0;
    }
    let mut signs = vec![Entry::new("larger tasks do not fit", |canvas, at| {
        marks::cross(canvas, at, 4.5, &format!(r#"stroke="{INK}" stroke-width="2""#));
    })];
    if panels.iter().any(|panel| !panel.marks.is_empty()) {
        signs.push(Entry::line("size asked for", format!(r#"stroke="{GREY}" stroke-width="1" {ASKED}"#)));
    }
    let tolerances: Vec<f64> = panels.iter().filter_map(|panel| panel.tolerance_mm).collect();
    if let Some((low, high)) = range(tolerances.into_iter()) {
        let text = if low == high { format!("tolerance {low} mm") } else { "tolerance".into() };
        signs.push(Entry::line(text, format!(r#"{TOLERANCE_LINE} stroke="{TOLERANCE}""#)));
    }
    let legend = Legend::new(signs, WIDTH - 140.0, 3);
    legend.draw(canvas, [125.0, y]);
    y += legend.height();
    if styles.iter().any(|style| style.estimated) {
        canvas.text([20.0, y + 16.0], "~ geometry or limits estimated", Font::new(12.0).colour(GREY));
        y += 28.0;
    }
    y
}

#[cfg(test)]
mod tests {
    use super::super::png;
    use super::*;

    fn curve(robot: &str, points: &[(f64, f64)]) -> Curve {
        Curve {
            robot: robot.into(),
            serial: robot.len().is_multiple_of(2),
            estimated: true,
            points: points.to_vec(),
            is_complete: robot == "short",
        }
    }

    fn panel(curves: Vec<Curve>, tolerance_mm: Option<f64>) -> Panel {
        Panel {
            title: "A & <B>".repeat(20),
            size_label: "d [m]".into(),
            curves,
            marks: vec![0.1, f64::NAN],
            tolerance_mm,
        }
    }

    #[test]
    fn odd_panels_make_figures() {
        let long = "a robot with a very long name ".repeat(9);
        let cases = [
            vec![],
            vec![panel(vec![], None)],
            vec![panel(vec![curve("a", &[])], Some(1.0))],
            vec![panel(vec![curve(&long, &[(0.1, 1.0)])], Some(1e9))],
            vec![panel(vec![curve("a", &[(0.1, 0.0), (f64::NAN, 1.0), (0.2, 0.0)])], Some(f64::NAN))],
            (0..7)
                .map(|_| panel((0..30).map(|i| curve(&format!("{i}"), &[(0.1, 1.0), (0.3, 2.0)])).collect(), Some(1.5)))
                .collect(),
        ];
        for panels in &cases {
            assert!(png(&svg(&long, panels).unwrap(), 0.5).is_ok());
        }
    }

    #[test]
    fn a_cross_ends_only_a_complete_curve() {
        let short = curve("short", &[(0.1, 1.0), (0.2, 2.0)]);
        let long = || curve("long", &[(0.1, 1.0), (0.2, 2.0), (0.3, 2.5)]);
        let crosses = |curves| svg("", &[panel(curves, None)]).unwrap().matches(r#"stroke-width="2"/>"#).count();
        // One more stands in the legend.
        assert_eq!(crosses(vec![short, long()]), 2);
        assert_eq!(crosses(vec![long()]), 1);
    }
}
