//! Robots in order as bars, one column per task: the deflection found, what is proved, the tolerance.

use std::fmt::Write as _;

use crate::answer::RobotStyle;
use stiffarm::palette::{
    ESTIMATED, FAINT, GREY, INK, LIMIT, PAPER, QUASI_SERIAL, QUASI_SERIAL_CURVES, SERIAL, SERIAL_CURVES, TOLERANCE,
};

use super::axes::{Axis, heading, label};
use super::bands::TOLERANCE_LINE;
use super::canvas::{Canvas, Font};
use super::legend::{Entry, Legend};
use super::{FigureSize, marks};

/// Height of a row and of its bar, px.
const ROW: f64 = 24.0;
const BAR: f64 = 14.0;
/// Below this, numbers behind the bars leave no room for bars, px.
const LEAST_COLUMN: f64 = 130.0;

/// One robot.
pub(crate) struct BarRow {
    /// Its name.
    pub robot: String,
    /// Serial or quasi-serial.
    pub serial: bool,
    /// Its geometry or limits are assumed.
    pub estimated: bool,
    /// Its colour and mark in every figure, where it is distinguished.
    pub style: Option<RobotStyle>,
    /// By task: deflection and its proved lower bound, mm; absent where the task does not fit.
    pub values: Vec<Option<(f64, f64)>>,
    /// By task: where it lies with 90 %, the median between the ends, mm; absent where the drive stiffness has no stated uncertainty.
    pub intervals: Vec<Option<[f64; 3]>>,
    /// By task: verdict and probability, where there is a tolerance.
    pub verdicts: Vec<Option<String>>,
    /// By task: the arm overlaps with something there.
    pub collides: Vec<bool>,
}

/// A ranking as it was asked for.
pub(crate) struct BarsFigure {
    /// First line.
    pub title: String,
    /// Second line, in grey.
    pub subtitle: String,
    /// The tasks.
    pub tasks: Vec<String>,
    /// Best first.
    pub rows: Vec<BarRow>,
    /// What the work allows, mm.
    pub tolerance_mm: Option<f64>,
    /// What was asked of the figure.
    pub figure_size: FigureSize,
}

impl BarRow {
    fn colour(&self) -> &'static str {
        let usual = if self.serial { SERIAL } else { QUASI_SERIAL };
        self.style.map_or(usual, |style| style.colour)
    }
}

impl BarsFigure {
    /// The figure as SVG text.
    pub(crate) fn svg(&self) -> String {
        let mut canvas = Canvas::of(&self.figure_size);
        let top = heading(&mut canvas, &self.title, &self.subtitle) + 24.0;
        let font = Font::new(12.5);
        let widest = self.rows.iter().map(|row| font.width(&row.robot)).fold(60.0, f64::max).min(0.28 * canvas.width);
        let first = 48.0 + widest;
        let room = canvas.width - 20.0 - first;
        // As many columns side by side as find room for their numbers; the others below.
        let across = ((room / LEAST_COLUMN) as usize).clamp(1, self.tasks.len().max(1));
        let column = room / across as f64;
        let mut bottom = top;
        for (tasks, start) in self.tasks.chunks(across).zip((0..).step_by(across)) {
            let top = bottom + if start == 0 { 16.0 } else { 62.0 };
            bottom = top + ROW * self.rows.len() as f64;
            for (row, y) in self.rows.iter().zip(lines(top)) {
                canvas.text([20.0 + widest, y], &font.cut(&row.robot, widest), font.end());
                if let Some(style) = row.style {
                    let fill = if row.estimated { ESTIMATED } else { style.colour };
                    let drawn = format!(r#"fill="{fill}" stroke="{}" stroke-width="1.2""#, style.colour);
                    marks::mark(&mut canvas, [33.0 + widest, y], style.mark, &drawn);
                }
            }
            for (i, name) in tasks.iter().enumerate() {
                let left = first + column * i as f64;
                self.draw_task(&mut canvas, start + i, name, [left, left + column - 16.0], [top, bottom]);
            }
        }
        let legend = Legend::new(self.entries(), canvas.width - 80.0, 4);
        legend.draw(&mut canvas, [40.0, bottom + 48.0]);
        canvas.height = bottom + 62.0 + legend.height();
        canvas.finish()
    }

    fn draw_task(
        &self,
        canvas: &mut Canvas,
        task: usize,
        name: &str,
        [left, right]: [f64; 2],
        [top, bottom]: [f64; 2],
    ) {
        let value = |row: &BarRow| row.values.get(task).copied().flatten();
        let interval = |row: &BarRow| row.intervals.get(task).copied().flatten();
        let values = self.rows.iter().filter_map(value).map(|(found, _)| found).filter(|mm| mm.is_finite());
        let largest = values.fold(0.0, f64::max);
        // Of intervals as much as leaves the bars half of the room.
        let ends = self.rows.iter().filter_map(interval).map(|[.., high]| high.min(2.0 * largest));
        let most = ends.filter(|mm| mm.is_finite()).fold(largest, f64::max);
        // A tolerance far above all bars would press them flat; it is then only named in the legend.
        let tolerance = self.tolerance_mm.filter(|tolerance| *tolerance <= 2.0 * most);
        // Numbers stand behind the bars.
        let room = Font::new(12.0).width("00.000") + 8.0;
        let end = (right - room).max(left + 20.0);
        let found = [0.0, most.max(tolerance.unwrap_or(most)).max(f64::MIN_POSITIVE)];
        let [from, to] = self.figure_size.ends().unwrap_or(found);
        let axis = Axis::new(from, to, [left, end]);
        let tolerance = tolerance.filter(|tolerance| axis.contains(*tolerance));
        let (ticks, step) = axis.ticks(48.0);
        for tick in ticks {
            let x = axis.at(tick);
            canvas.line([x, top], [x, bottom + 5.0], &format!(r#"stroke="{FAINT}" stroke-width="0.8""#));
            canvas.text([x, bottom + 13.0], &label(tick, step), Font::new(12.0).middle());
        }
        let mut numbers = Vec::new();
        for (row, y) in self.rows.iter().zip(lines(top)) {
            let Some((found, bound)) = value(row).filter(|(found, _)| found.is_finite()) else {
                canvas.text([left + 4.0, y], "does not fit", Font::new(12.0).colour(GREY));
                continue;
            };
            let x = axis.at(found).clamp(left, end);
            let mut tooltip = format!("{}, {name}: {found:.3} mm; proved lower bound {bound:.3} mm", row.robot);
            if let Some([low, median, high]) = interval(row) {
                let _ = write!(tooltip, "; 90 % interval {low:.3} .. {high:.3} mm, median {median:.3} mm");
            }
            if let Some(verdict) = row.verdicts.get(task).and_then(Option::as_ref) {
                let _ = write!(tooltip, "; {verdict}");
            }
            let collides = row.collides[task];
            if collides {
                tooltip += "; COLLISION";
            }
            canvas.with_tooltip(&tooltip, |canvas| {
                canvas.rect([left, y - BAR / 2.0], [x, y + BAR / 2.0], &style(row.colour(), row.estimated));
            });
            if collides {
                cross(canvas, [left + 10.0, y]);
            }
            let bound = bound.clamp(0.0, found);
            if axis.contains(bound) {
                let proved = axis.at(bound);
                canvas.line([proved, y - BAR / 2.0], [proved, y + BAR / 2.0], &bound_look());
            }
            if axis.to < found {
                canvas.goes_on([x - 1.0, y], [7.0, 0.0], BAR / 2.0, row.colour());
            }
            let mut x = if axis.to < found { x + 4.0 } else { x };
            if let Some(ends) = interval(row) {
                let [.., high] =
                    whisker(canvas, ends.map(|mm| axis.at(mm).clamp(left, end)), y, ends.map(|mm| axis.contains(mm)));
                x = x.max(high);
            }
            numbers.push(([x + 5.0, y], format!("{found:.3}")));
        }
        if let Some(tolerance) = tolerance {
            let x = axis.at(tolerance);
            canvas.line([x, top - 4.0], [x, bottom], &format!(r#"{TOLERANCE_LINE} stroke="{TOLERANCE}""#));
        }
        for (at, text) in numbers {
            canvas.text(at, &text, Font::new(12.0).halo());
        }
        canvas.line([left, top - 4.0], [left, bottom], &format!(r#"stroke="{INK}" stroke-width="1""#));
        let font = Font::new(13.0).bold();
        let unit = " [mm]";
        let name = font.cut(name, right - left - font.width(unit));
        canvas.text([left, top - 16.0], &format!("{name}{unit}"), font);
    }

    fn entries(&self) -> Vec<Entry> {
        let has_styles = self.rows.iter().any(|row| row.style.is_some());
        let bar = |text: &str, colours: Vec<&'static str>, estimated: bool| {
            Entry::new(text, move |canvas, [x, y]| {
                let width = 30.0 / colours.len() as f64;
                for (i, colour) in colours.iter().enumerate() {
                    let left = x - 15.0 + width * i as f64;
                    canvas.rect([left, y - 6.0], [left + width, y + 6.0], &style(colour, estimated));
                }
            })
        };
        let mut entries = Vec::new();
        for (serial, name, colour, curves) in
            [(true, "serial", SERIAL, SERIAL_CURVES), (false, "quasi-serial", QUASI_SERIAL, QUASI_SERIAL_CURVES)]
        {
            for (estimated, suffix) in [(false, ""), (true, ", estimated")] {
                if self.rows.iter().any(|row| row.serial == serial && row.estimated == estimated) {
                    let (warm, colours) = if has_styles {
                        (if serial { " (warm)" } else { " (cool)" }, curves[..3].to_vec())
                    } else {
                        ("", vec![colour])
                    };
                    entries.push(bar(&format!("{name}{warm}{suffix}"), colours, estimated));
                }
            }
        }
        entries.push(Entry::new("proved lower bound", |canvas, [x, y]| {
            canvas.line([x, y - 7.0], [x, y + 7.0], &bound_look());
        }));
        if self.rows.iter().any(|row| row.intervals.iter().any(Option::is_some)) {
            entries.push(Entry::new("90 % interval and median (drive stiffness)", |canvas, [x, y]| {
                whisker(canvas, [x - 15.0, x - 4.0, x + 15.0], y, [true; 3]);
            }));
        }
        if self.rows.iter().any(|row| row.collides.contains(&true)) {
            entries.push(Entry::new("COLLISION at that place", cross));
        }
        if let Some(tolerance) = self.tolerance_mm {
            entries.push(Entry::line(
                format!("tolerance {tolerance} mm"),
                format!(r#"{TOLERANCE_LINE} stroke="{TOLERANCE}""#),
            ));
        }
        entries
    }
}

/// The middle heights of the rows, px.
fn lines(top: f64) -> impl Iterator<Item = f64> {
    (0..).map(move |i| top + ROW * (f64::from(i) + 0.5))
}

fn style(colour: &str, estimated: bool) -> String {
    let opacity = if estimated { 0.25 } else { 1.0 };
    format!(r#"fill="{colour}" fill-opacity="{opacity}" stroke="{colour}" stroke-width="1""#)
}

/// From where to where with the median between them, px, and which of these are on the scale: it goes on as an arrow. Where it ends in the
/// figure.
fn whisker(canvas: &mut Canvas, [low, median, high]: [f64; 3], y: f64, are_shown: [bool; 3]) -> [f64; 2] {
    let style = format!(r#"stroke="{GREY}" stroke-width="1.4""#);
    canvas.line([low, y], [high, y], &style);
    for (x, is_shown, out) in [(low, are_shown[0], -1.0), (high, are_shown[2], 1.0)] {
        if is_shown {
            canvas.line([x, y - 3.5], [x, y + 3.5], &style);
        } else {
            canvas.goes_on([x, y], [7.0 * out, 0.0], 3.5, GREY);
        }
    }
    if are_shown[1] {
        canvas.circle([median, y], 2.8, &format!(r#"fill="{PAPER}" {style}"#));
    }
    [if are_shown[0] { low } else { low - 7.0 }, if are_shown[2] { high } else { high + 7.0 }]
}

/// What is not to be taken.
fn cross(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    for (colour, width) in [(PAPER, 5.0), (LIMIT, 2.4)] {
        let look = format!(r#"stroke="{colour}" stroke-width="{width}""#);
        canvas.line([x - 5.0, y - 5.0], [x + 5.0, y + 5.0], &look);
        canvas.line([x - 5.0, y + 5.0], [x + 5.0, y - 5.0], &look);
    }
}

fn bound_look() -> String {
    format!(r#"fill="none" stroke="{LIMIT}" stroke-width="2""#)
}

#[cfg(test)]
mod tests {
    use super::super::is_svg;
    use super::*;

    /// From where to where along x the paths of two points go that have this style.
    fn lines_at(svg: &str, style: &str) -> Vec<[f64; 2]> {
        let of_path = |path: &str| {
            let (drawn, rest) = path.split_once('"')?;
            let mut numbers =
                drawn.split(|c: char| !c.is_ascii_digit() && c != '.' && c != '-').flat_map(str::parse::<f64>);
            let [x0, _, x1, _] = std::array::from_fn(|_| numbers.next());
            rest.split('>').next()?.contains(style).then_some([x0?, x1?])
        };
        svg.split("<path d=\"").skip(1).filter_map(of_path).collect()
    }

    #[test]
    fn every_bar_is_as_long_as_its_value_and_odd_rankings_are_drawn() {
        let row = |robot: &str, values: Vec<Option<(f64, f64)>>| BarRow {
            robot: robot.into(),
            serial: robot.len().is_multiple_of(2),
            estimated: false,
            style: (robot == "one").then_some(RobotStyle { colour: stiffarm::palette::RATIOS[0], mark: 3 }),
            intervals: values
                .iter()
                .map(|value| value.map(|(found, _)| [0.5 * found, 1.1 * found, 1.5 * found]))
                .collect(),
            verdicts: vec![Some("pass (P = 97 %)".into()), None],
            collides: vec![robot == "four", false],
            values,
        };
        let figure = |rows: Vec<BarRow>, tolerance_mm| BarsFigure {
            title: "<&>".into(),
            subtitle: String::new(),
            tasks: vec!["A:0.5".into(), "B:0.5".into()],
            rows,
            tolerance_mm,
            figure_size: FigureSize::default(),
        };
        let rows = vec![
            row("one", vec![Some((1.0, 0.5)), None]),
            row("four", vec![Some((2.0, 2.0)), Some((f64::NAN, f64::NAN))]),
            row(&"long ".repeat(90), vec![Some((4.0, 0.0)), Some((1e9, 0.0))]),
        ];
        let svg = figure(rows, Some(3.0)).svg();
        let widths: Vec<f64> = svg
            .split("<rect")
            .filter(|part| part.contains(r#"height="14"#))
            .filter_map(|part| part.split(r#"width=""#).nth(1)?.split('"').next()?.parse().ok())
            .collect();
        assert_eq!(widths.len(), 4, "{svg}");
        assert!((widths[1] / widths[0] - 2.0).abs() < 1e-2 && (widths[2] / widths[0] - 4.0).abs() < 2e-2, "{widths:?}");
        assert_eq!(svg.matches("does not fit").count(), 2);
        assert!(svg.contains("tolerance 3 mm") && is_svg(&svg));
        // One bar and its entry of the legend, two lines each.
        assert_eq!((svg.matches("; COLLISION").count(), lines_at(&svg, r#"stroke-width="2.4""#).len()), (1, 4));
        assert!(svg.contains("90 % interval 0.500 .. 1.500 mm, median 1.100 mm; pass (P = 97 %)"), "{svg}");
        // An interval of three times the length of its bar, whose middle is where the bar ends; the axis begins at zero.
        let whiskers = lines_at(&svg, r#"stroke-width="1.4""#);
        let [low, high] = whiskers.iter().copied().find(|[low, high]| low < high).unwrap();
        assert!(((high - low) / widths[0] - 1.0).abs() < 1e-2, "{whiskers:?} {widths:?}");
        // The median of the first lies a tenth beyond the end of its bar.
        let left = low - 0.5 * (high - low);
        let median: f64 = svg.split("<circle cx=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        assert!(((median - left) / widths[0] - 1.1).abs() < 1e-2, "{median} {left} {widths:?}");
        assert!(is_svg(&figure(Vec::new(), None).svg()));
    }
}
