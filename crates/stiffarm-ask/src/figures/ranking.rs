//! Robots compared: deflection against task size, one diagram per task shape.

use crate::answer::RobotStyle;
use stiffarm::palette::{ESTIMATED, GREY, INK, OTHERS, TOLERANCE};

use super::axes::{Axis, Frame, heading};
use super::bands::TOLERANCE_LINE;
use super::canvas::{Canvas, Font, Px, path, rect_path};
use super::labels::Occupied;
use super::legend::{Entry, Legend};
use super::{FigureError, FigureSize, marks};

/// More curves than this carry a letter each: nobody follows so many colours to a legend.
const MOST_WITHOUT_LETTERS: usize = 8;
/// Room for a panel with its titles, px.
const LEAST_PANEL: f64 = 300.0;
const DASH: &str = r#"stroke-dasharray="7 4""#;

/// How one robot does over the sizes of one task shape.
pub(crate) struct Curve {
    /// Its name.
    pub robot: String,
    /// Serial or quasi-serial.
    pub serial: bool,
    /// Its geometry or limits are assumed.
    pub estimated: bool,
    /// Its colour and mark in every figure; grey without one.
    pub robot_style: Option<RobotStyle>,
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

/// How the curves of a robot are drawn, the same in every panel.
struct CurveStyle<'a> {
    robot: &'a str,
    serial: bool,
    estimated: bool,
    robot_style: Option<RobotStyle>,
    /// Where there are many: on its curves and in the legend.
    letter: Option<char>,
}

impl CurveStyle<'_> {
    fn colour(&self) -> &'static str {
        self.robot_style.map_or(OTHERS, |robot_style| robot_style.colour)
    }

    fn line(&self) -> String {
        let (width, opacity) = match (self.robot_style, self.estimated) {
            (None, _) => (1.0, 0.9),
            (Some(_), true) => (1.3, 0.75),
            (Some(_), false) => (2.4, 1.0),
        };
        let dash = if self.serial { "" } else { DASH };
        let colour = self.colour();
        format!(
            r#"fill="none" stroke="{colour}" stroke-width="{width}" stroke-opacity="{opacity}" stroke-linejoin="round" {dash}"#
        )
    }

    fn mark(&self, canvas: &mut Canvas, at: Px) {
        let Some(robot_style) = self.robot_style else { return };
        let fill = if self.estimated { ESTIMATED } else { robot_style.colour };
        marks::mark(
            canvas,
            at,
            robot_style.mark,
            &format!(r#"fill="{fill}" stroke="{}" stroke-width="1.2""#, robot_style.colour),
        );
    }

    fn entry(&self) -> Entry {
        let mark = if self.estimated { " ~" } else { "" };
        let letter = self.letter.map_or_else(String::new, |letter| format!("{letter}  "));
        let own = CurveStyle { robot: "", ..*self };
        Entry::new(format!("{letter}{}{mark}", self.robot), move |canvas, [x, y]| {
            canvas.line([x - 18.0, y], [x + 18.0, y], &own.line());
            own.mark(canvas, [x, y]);
        })
    }
}

/// The figure as SVG text.
///
/// A cross ends a complete curve: beyond it the task does not fit.
#[expect(clippy::unnecessary_wraps, reason = "all figures are called alike")]
pub(crate) fn svg(title: &str, panels: &[Panel], figure_size: &FigureSize) -> Result<String, FigureError> {
    let styles = styles(panels);
    let mut canvas = Canvas::of(figure_size);
    let mut y = heading(&mut canvas, title, "") + 34.0;
    if panels.is_empty() {
        canvas.text([20.0, y], "nothing to show", Font::new(13.0));
        y += 20.0;
    }
    let across = panels.len().clamp(1, 3.min((canvas.width / LEAST_PANEL) as usize).max(1));
    let column = (canvas.width - 16.0) / across as f64;
    let height = if across == 3 { 330.0 } else { 380.0 };
    for row in panels.chunks(across) {
        for (i, panel) in row.iter().enumerate() {
            let left = column * i as f64 + 62.0;
            let frame = frame(panel, figure_size.ends(), [left, y + height], [left + column - 70.0, y]);
            draw_panel(&mut canvas, panel, &styles, &frame);
        }
        y += height + 74.0;
    }
    y = draw_legends(&mut canvas, panels, &styles, y - 22.0);
    canvas.height = y + 10.0;
    Ok(canvas.finish())
}

fn styles(panels: &[Panel]) -> Vec<CurveStyle<'_>> {
    let mut styles: Vec<CurveStyle> = Vec::new();
    for curve in panels.iter().flat_map(|panel| &panel.curves) {
        if styles.iter().all(|style| style.robot != curve.robot) {
            let Curve { robot, serial, estimated, robot_style, .. } = curve;
            styles.push(CurveStyle {
                robot,
                serial: *serial,
                estimated: *estimated,
                robot_style: *robot_style,
                letter: None,
            });
        }
    }
    if MOST_WITHOUT_LETTERS < styles.len() {
        let styled = styles.iter_mut().filter(|style| style.robot_style.is_some());
        styled.zip('a'..='z').for_each(|(style, letter)| style.letter = Some(letter));
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

fn frame(panel: &Panel, scale: Option<[f64; 2]>, [left, bottom]: Px, [right, top]: Px) -> Frame {
    let points = || panel.curves.iter().flat_map(finite);
    let (x0, x1) = range(points().map(|(size, _)| size).chain(panel.marks.iter().copied())).unwrap_or((0.0, 1.0));
    let (_, mut most) = range(points().map(|(_, value)| value)).unwrap_or((0.0, 1.0));
    // A tolerance far above all curves would press them flat; it is then only named.
    most = most.max(panel.tolerance_mm.filter(|tolerance| *tolerance <= 2.0 * most).unwrap_or(most));
    let start = if x0 <= 0.3 * x1 { x0.min(0.0) } else { x0 - 0.05 * (x1 - x0) };
    Frame {
        x: Axis::new(start, x1 + 0.13 * (x1 - start), [left, right]),
        y: scale.map_or(Axis::new(0.0, 1.08 * most, [bottom, top]), |[from, to]| Axis::new(from, to, [bottom, top])),
    }
}

fn draw_panel(canvas: &mut Canvas, panel: &Panel, styles: &[CurveStyle], frame: &Frame) {
    let [[left, bottom], [right, top]] = frame.corners();
    frame.grid(canvas);
    for &mark in panel.marks.iter().filter(|mark| frame.x.contains(**mark)) {
        let x = frame.x.at(mark);
        canvas.line([x, bottom], [x, top], &format!(r#"stroke="{GREY}" stroke-width="1" {ASKED}"#));
    }
    draw_tolerance(canvas, panel, frame);
    let mut all: Vec<(&Curve, &CurveStyle, Vec<Px>)> = Vec::new();
    for curve in &panel.curves {
        let Some(style) = styles.iter().find(|style| style.robot == curve.robot) else { continue };
        let points = finite(curve).into_iter().map(|(size, value)| frame.at(size, value)).collect();
        all.push((curve, style, points));
    }
    // Those that are not distinguished lie below.
    all.sort_by_key(|(_, style, _)| style.robot_style.is_some());
    let mut occupied = Occupied::default();
    canvas.clipped(&rect_path([left, bottom + 1.0], [right, top]), |canvas| {
        for (curve, style, points) in &all {
            canvas.with_tooltip(style.robot, |canvas| canvas.path(&path(points, false), &style.line()));
            let values = finite(curve);
            let last = points.len().saturating_sub(1);
            for i in marked(points, style) {
                let (size, value) = values[i];
                canvas.with_tooltip(&format!("{}: {value:.3} mm at d {size:.3} m", style.robot), |canvas| {
                    style.mark(canvas, points[i]);
                });
                occupied.take(&[points[i]; 2], 5.0);
            }
            if curve.is_complete && !points.is_empty() {
                marks::cross(canvas, points[last], 4.5, &format!(r#"stroke="{}" stroke-width="2""#, style.colour()));
                occupied.take(&[points[last]; 2], 5.0);
            }
        }
    });
    let inside = [vec![[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]]];
    for (_, _, points) in &all {
        occupied.take(points, 2.0);
    }
    let shown = |at: &&Px| top <= at[1] && at[1] <= bottom;
    for (_, style, points) in &all {
        if let (Some(letter), Some(end)) = (style.letter, points.iter().rev().find(shown)) {
            occupied.beside(canvas, *end, &letter.to_string(), Font::new(12.0).bold(), &inside);
        }
    }
    if panel.curves.iter().all(|curve| finite(curve).is_empty()) {
        let middle = [f64::midpoint(left, right), f64::midpoint(bottom, top)];
        canvas.text(middle, "fits no robot", Font::new(13.0).middle());
    }
    frame.draw(canvas, &panel.size_label, "deflection [mm]");
    frame.headline(canvas, &panel.title);
}

/// Which points of a curve carry a mark: up to four, at other places than those of its neighbours.
fn marked(points: &[Px], style: &CurveStyle) -> Vec<usize> {
    let every = points.len().div_ceil(4).max(1);
    let last = points.len().saturating_sub(1);
    let own = style.robot_style.map_or(0, |robot_style| robot_style.mark) * every / 6;
    (0..points.len()).filter(|i| i % every == own && (*i < last || last == 0)).collect()
}

const ASKED: &str = r#"stroke-dasharray="2 3""#;

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
fn draw_legends(canvas: &mut Canvas, panels: &[Panel], styles: &[CurveStyle], mut y: f64) -> f64 {
    for (serial, name) in [(true, "serial"), (false, "quasi-serial")] {
        let styled = styles.iter().filter(|style| style.serial == serial && style.robot_style.is_some());
        let mut entries: Vec<Entry> = styled.map(CurveStyle::entry).collect();
        let others: Vec<&CurveStyle> =
            styles.iter().filter(|style| style.serial == serial && style.robot_style.is_none()).collect();
        if let Some(first) = others.first() {
            let names = if others.len() == 1 { first.robot.to_owned() } else { format!("{} others", others.len()) };
            entries.push(Entry::line(names, first.line()));
        }
        if entries.is_empty() {
            continue;
        }
        let legend = Legend::new(entries, canvas.width - 140.0, 3);
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
    let legend = Legend::new(signs, canvas.width - 140.0, 3);
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
    use super::super::is_svg;
    use super::*;

    fn curve(robot: &str, points: &[(f64, f64)]) -> Curve {
        Curve {
            robot: robot.into(),
            serial: robot.len().is_multiple_of(2),
            estimated: true,
            robot_style: robot
                .len()
                .checked_rem(3)
                .filter(|mark| *mark != 0)
                .map(|mark| RobotStyle { colour: stiffarm::palette::RATIOS[0], mark }),
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
            assert!(is_svg(&svg(&long, panels, &FigureSize::default()).unwrap()));
        }
    }

    #[test]
    fn a_cross_ends_only_a_complete_curve() {
        let short = curve("short", &[(0.1, 1.0), (0.2, 2.0)]);
        let long = || curve("long", &[(0.1, 1.0), (0.2, 2.0), (0.3, 2.5)]);
        let crosses = |curves| {
            svg("", &[panel(curves, None)], &FigureSize::default()).unwrap().matches(r#"stroke-width="2"/>"#).count()
        };
        // One more stands in the legend.
        assert_eq!(crosses(vec![short, long()]), 2);
        assert_eq!(crosses(vec![long()]), 1);
    }
}
