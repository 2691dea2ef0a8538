//! A path that is milled: the error along it, what every other roll would have done, and the path from above.

use crate::answer::{Compensation, MillAnswer, fixed};
use stiffarm::mill::{Followed, RollCell, RollMap, Station};
use stiffarm::palette::{AIR, ALARM, COMPENSATED, DEFLECTION, FAINT, GREY, INK, LIMIT, OTHERS, PAPER, TOLERANCE};

use super::FigureSize;
use super::axes::{Axis, Frame, heading};
use super::bands::{Bands, Colours};
use super::canvas::{Canvas, Px, path};
use super::legend::{Entry, Legend};

/// Heights of the diagrams over the way, px.
const ERROR: f64 = 210.0;
/// Places along the path of which a pointer tells the error.
const MOST_TOOLTIPS: usize = 240;
const ROLLS: f64 = 270.0;
/// Of the view from above at most, px.
const ABOVE: f64 = 420.0;
/// Between the left edge and the frames, and right of them where the colour bar stands, px.
const LEFT: f64 = 72.0;
const RIGHT: f64 = 130.0;
/// Half the width of a pin, px.
const PIN: f64 = 5.0;
/// Below a frame, px.
const BELOW: f64 = 84.0;

/// A wide band below the path where something is touched.
fn touching() -> String {
    format!(r#"stroke="{ALARM}" stroke-opacity="0.35" stroke-width="11" stroke-linejoin="round""#)
}

/// A path that is milled.
pub(crate) struct MilledFigure<'a> {
    pub answer: &'a MillAnswer,
    pub rolls: &'a RollMap,
    pub figure_size: FigureSize,
}

impl MilledFigure<'_> {
    /// The figure as SVG text.
    pub(crate) fn svg(&self) -> String {
        let mut canvas = Canvas::of(&self.figure_size);
        let Some(found) = self.answer.followed() else { return canvas.finish() };
        let worst = found.worst.0 * 1e3;
        let title = format!("{} along {}", self.answer.robot.full_name(), self.answer.along());
        let bound = self.answer.lower_bound().map_or(0.0, |bound| bound * 1e3);
        let proved = if 0.0 < bound {
            format!("proved no less than {} mm", fixed(bound, 3))
        } else {
            "no lower bound proved".into()
        };
        let subtitle = format!("largest error {} mm, {proved}; {}", fixed(worst, 3), self.answer.force);
        let top = heading(&mut canvas, &title, &subtitle) + 34.0;
        let room = [LEFT, canvas.width - RIGHT];
        let bands = self.bands(worst);
        let way = self.way(room);
        let lines = self.compared();
        let left = lines.iter().flat_map(|line| line.1).copied().fold(0.0, f64::max) * 1e3;
        let most = worst.max(left).max(self.answer.tolerance_mm.unwrap_or(0.0));
        let errors = Frame { x: way, y: Axis::new(0.0, 1.08 * most, [top + ERROR, top]) };
        self.errors(&mut canvas, found, errors, bound);
        let top = top + ERROR + BELOW;
        let rolls = Frame { x: way, y: Axis::new(0.0, 360.0, [top + ROLLS, top]) };
        let [[left, bottom], [right, top_of_rolls]] = rolls.corners();
        canvas.tell_box("rolls", [[left, top_of_rolls], [right, bottom]], [way.from, way.to]);
        self.map(&mut canvas, found, &rolls, &bands);
        let right = room[1];
        bands.bar(&mut canvas, [right + 26.0, top + ROLLS - 16.0], [right + 44.0, top + 16.0], "error [mm]");
        let top = top + ROLLS + BELOW;
        let bottom = self.above(&mut canvas, found, (room, top), &bands);
        let legend = Legend::new(self.entries(), canvas.width - 80.0, 4);
        legend.draw(&mut canvas, [40.0, bottom + 50.0]);
        canvas.height = bottom + 62.0 + legend.height();
        canvas.finish()
    }

    /// The colours, of errors from the smallest to the largest that any roll would have.
    fn bands(&self, worst: f64) -> Bands {
        let errors = self
            .rolls
            .cells
            .iter()
            .flatten()
            .filter_map(|cell| if let RollCell::Error(error) = cell { Some(error * 1e3) } else { None });
        let (low, high) = errors.fold((worst, worst), |(low, high), error| (low.min(error), high.max(error)));
        // Rolls that nobody would take must not press the others into one colour.
        Bands::within(self.figure_size.ends(), [low, high.min(3.0 * worst).max(low)], Colours::Deflections)
    }

    /// The way along the path, mm.
    fn way(&self, room: [f64; 2]) -> Axis {
        let way = |i: usize| self.answer.stations[i].sample.way * 1e3;
        Axis::new(way(0), way(self.answer.stations.len() - 1), room)
    }

    fn errors(&self, canvas: &mut Canvas, found: &Followed, frame: Frame, bound: f64) {
        frame.grid(canvas);
        let look = format!(r#"fill="none" stroke="{DEFLECTION}" stroke-width="1.6" stroke-linejoin="round""#);
        for points in self.cuts(found, |way, _, error| frame.at(way, error)) {
            canvas.polyline(&points, &look);
        }
        for (_, left, look) in self.compared() {
            for points in self.lines(|i, station| frame.at(station.sample.way * 1e3, left[i] * 1e3)) {
                canvas.polyline(&points, &format!(r#"fill="none" {look}"#));
            }
        }
        let [[left, _], [right, _]] = frame.corners();
        let across = |canvas: &mut Canvas, value: f64, look: &str| {
            canvas.line([left, frame.y.at(value)], [right, frame.y.at(value)], look);
        };
        across(canvas, bound, &format!(r#"stroke="{LIMIT}" stroke-width="1" stroke-dasharray="2 3""#));
        if let Some(tolerance) = self.answer.tolerance_mm {
            across(canvas, tolerance, &format!(r#"stroke="{TOLERANCE}" stroke-width="1.8" stroke-dasharray="9 4""#));
        }
        let station = &self.answer.stations[found.worst.1];
        canvas.circle(frame.at(station.sample.way * 1e3, found.worst.0 * 1e3), 4.0, &format!(r#"fill="{ALARM}""#));
        self.tell(canvas, found, &frame);
        frame.draw(canvas, "way along the path [mm]", "error [mm]");
        frame.headline(canvas, "error along the path");
    }

    /// What a pointer tells along the way; nothing is seen of it.
    fn tell(&self, canvas: &mut Canvas, found: &Followed, frame: &Frame) {
        let stride = found.samples.len().div_ceil(MOST_TOOLTIPS).max(1);
        for (station, pushed) in self.answer.stations.iter().zip(&found.samples).step_by(stride) {
            let (sample, error) = (&station.sample, pushed.error * 1e3);
            if sample.is_cutting {
                let line = if sample.line == 0 { String::new() } else { format!("line {}, ", sample.line) };
                let tooltip = format!("{line}{:.1} mm of the way: {error:.4} mm", sample.way * 1e3);
                let at = frame.at(sample.way * 1e3, error);
                canvas.with_tooltip(&tooltip, |canvas| canvas.circle(at, 5.0, r#"fill-opacity="0""#));
            }
        }
    }

    /// What compensation leaves at every station, m, beside what is there without it by the same account, each with its name and look;
    /// nothing where it was not asked for, or is not known all along.
    fn compared(&self) -> Vec<(&'static str, &[f64], String)> {
        let Some(Compensation { done, remaining }) = &self.answer.compensation else { return Vec::new() };
        let look = |colour: &str, dashes: &str| {
            format!(r#"stroke="{colour}" stroke-width="1.6" stroke-linejoin="round" stroke-dasharray="{dashes}""#)
        };
        let lines = match remaining {
            Some((remaining, _)) => vec![
                ("error, 95 % of draws", &remaining.without[..], look(DEFLECTION, "1 3")),
                ("compensated, 95 % of draws", &remaining.along[..], look(COMPENSATED, "1 3")),
                ("compensated, median of draws", &remaining.median_along[..], look(COMPENSATED, "6 2")),
            ],
            // Beside the error by the model.
            None => vec![("compensated tips, by the model", &done.left_by_tips[..], look(COMPENSATED, "6 2"))],
        };
        lines.into_iter().filter(|line| line.1.iter().all(|left| left.is_finite())).collect()
    }

    /// What lies between rapid ways, each as a line.
    fn cuts(&self, found: &Followed, at: impl Fn(f64, f64, f64) -> Px) -> Vec<Vec<Px>> {
        self.lines(|i, station| {
            let pushed = &found.samples[i];
            at(station.sample.way * 1e3, pushed.arrangement.roll.to_degrees(), pushed.error * 1e3)
        })
    }

    /// The same of anything that stations have.
    fn lines(&self, at: impl Fn(usize, &Station) -> Px) -> Vec<Vec<Px>> {
        let mut lines: Vec<Vec<Px>> = vec![Vec::new()];
        for (i, station) in self.answer.stations.iter().enumerate() {
            if !station.sample.is_cutting || station.is_fresh {
                lines.push(Vec::new());
            }
            if station.sample.is_cutting {
                lines.last_mut().expect("there is one").push(at(i, station));
            }
        }
        lines.retain(|line| !line.is_empty());
        lines
    }

    /// Every roll at every place: its error as a colour, or what forbids it as a shade of grey; and the rolls that were taken.
    fn map(&self, canvas: &mut Canvas, found: &Followed, frame: &Frame, bands: &Bands) {
        let count = self.rolls.stations.len() as f64;
        let step = 360.0 / self.rolls.rolls.len() as f64;
        let (from, width) = (frame.x.from, (frame.x.to - frame.x.from) / count);
        for (i, column) in self.rolls.cells.iter().enumerate() {
            let left = from + width * i as f64;
            let colours: Vec<String> = column.iter().map(|cell| colour(*cell, bands)).collect();
            let mut first = 0;
            for n in 1..=colours.len() {
                if n < colours.len() && colours[n] == colours[first] {
                    continue;
                }
                // A hair wider than the column, or seams would show.
                let ([x0, y0], [x1, y1]) =
                    (frame.at(left, step * first as f64), frame.at(left + width, step * n as f64));
                canvas.rect([x0, y0], [x1 + 0.4, y1 - 0.4], &format!(r#"fill="{}""#, colours[first]));
                first = n;
            }
        }
        let turn = |roll: f64| roll.rem_euclid(360.0);
        for rim in [(PAPER, 4.0), (INK, 1.8)] {
            let look = format!(r#"fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round""#, rim.0, rim.1);
            for points in self.cuts(found, |way, roll, _| [way, turn(roll)]) {
                // Cut where the roll goes on over a whole turn.
                for piece in points.chunk_by(|a, b| (a[1] - b[1]).abs() < 180.0) {
                    let piece: Vec<Px> = piece.iter().map(|[way, roll]| frame.at(*way, *roll)).collect();
                    canvas.polyline(&piece, &look);
                }
            }
        }
        for (_, station, roll) in self.answer.pins() {
            let (way, roll) = (station.sample.way * 1e3, turn(roll.to_degrees()));
            canvas.with_tooltip(&format!("pinned: {roll:.1} deg at {way:.1} mm"), |canvas| {
                canvas.circle(frame.at(way, roll), PIN, &format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="2""#));
            });
        }
        frame.draw(canvas, "way along the path [mm]", "roll [deg]");
        frame.headline(canvas, "every roll of the tool, and that which is taken");
    }

    /// The path from above, in the part's own axes; gives where it ends below.
    fn above(&self, canvas: &mut Canvas, found: &Followed, (room, top): ([f64; 2], f64), bands: &Bands) -> f64 {
        let tips: Vec<[f64; 2]> = self
            .answer
            .stations
            .iter()
            .map(|station| [station.sample.pose.tip.x * 1e3, station.sample.pose.tip.y * 1e3])
            .collect();
        let range = |axis: usize| {
            tips.iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], tip| [low.min(tip[axis]), high.max(tip[axis])])
        };
        let ([x0, x1], [y0, y1]) = (range(0), range(1));
        let pad = 0.05 * (x1 - x0).max(y1 - y0).max(1.0);
        let (wide, high) = (x1 - x0 + 2.0 * pad, y1 - y0 + 2.0 * pad);
        let scale = ((room[1] - room[0]) / wide).min(ABOVE / high);
        let middle = f64::midpoint(room[0], room[1]);
        let x = Axis::new(x0 - pad, x1 + pad, [middle - scale * wide / 2.0, middle + scale * wide / 2.0]);
        let y = Axis::new(y0 - pad, y1 + pad, [top + scale * high, top]);
        let frame = Frame { x, y };
        frame.grid(canvas);
        for run in self.answer.touching() {
            let points: Vec<Px> = run.map(|i| frame.at(tips[i][0], tips[i][1])).collect();
            canvas.polyline(&points, &format!(r#"fill="none" {}"#, touching()));
        }
        let mut line: (String, Vec<Px>) = (String::new(), Vec::new());
        let draw = |canvas: &mut Canvas, line: &(String, Vec<Px>), is_rapid: bool| {
            let look = if is_rapid {
                format!(r#"fill="none" stroke="{GREY}" stroke-width="0.8" stroke-dasharray="3 3""#)
            } else {
                format!(r#"fill="none" stroke="{}" stroke-width="3.2" stroke-linecap="round""#, line.0)
            };
            canvas.path(&path(&line.1, false), &look);
        };
        for i in 1..tips.len() {
            let [a, b] = [tips[i - 1], tips[i]].map(|[x, y]| frame.at(x, y));
            let error = found.samples[i - 1].error.max(found.samples[i].error) * 1e3;
            let is_rapid = !self.answer.stations[i].sample.is_cutting;
            let colour = if is_rapid { "rapid".to_owned() } else { bands.of_value(error) };
            if line.0 != colour {
                draw(canvas, &line, line.0 == "rapid");
                line = (colour, vec![a]);
            }
            line.1.push(b);
        }
        draw(canvas, &line, line.0 == "rapid");
        let [wx, wy] = tips[found.worst.1];
        canvas.circle(frame.at(wx, wy), 4.0, &format!(r#"fill="{ALARM}""#));
        frame.draw(canvas, "x of the part [mm]", "y of the part [mm]");
        frame.headline(canvas, "seen from above, by the error");
        top + scale * high
    }

    fn entries(&self) -> Vec<Entry> {
        let square = |colour: &'static str| {
            move |canvas: &mut Canvas, [x, y]: Px| {
                canvas.rect(
                    [x - 7.0, y - 7.0],
                    [x + 7.0, y + 7.0],
                    &format!(r#"fill="{colour}" stroke="{GREY}" stroke-width="0.6""#),
                );
            }
        };
        let has = |wanted: RollCell| self.rolls.cells.iter().flatten().any(|cell| *cell == wanted);
        let mut entries = vec![
            Entry::line("error, by the model", format!(r#"stroke="{DEFLECTION}" stroke-width="1.6""#)),
            Entry::line(
                if self.answer.search.is_some() {
                    "proved lower bound of all places".into()
                } else {
                    format!("lower bound {}", self.answer.which_rolls())
                },
                format!(r#"stroke="{LIMIT}" stroke-width="1" stroke-dasharray="2 3""#),
            ),
        ];
        if self.answer.tolerance_mm.is_some() {
            entries.push(Entry::line(
                "tolerance",
                format!(r#"stroke="{TOLERANCE}" stroke-width="1.8" stroke-dasharray="9 4""#),
            ));
        }
        entries.extend(self.compared().into_iter().map(|(words, _, look)| Entry::line(words, look)));
        entries.push(Entry::new("worst sample", |canvas, at| canvas.circle(at, 4.0, &format!(r#"fill="{ALARM}""#))));
        entries.push(Entry::line("roll that is taken", format!(r#"stroke="{INK}" stroke-width="1.8""#)));
        if self.answer.pins().next().is_some() {
            let look = format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="2""#);
            entries.push(Entry::new("roll pinned", move |canvas, at| canvas.circle(at, PIN, &look)));
        }
        if !self.answer.touching().is_empty() {
            entries.push(Entry::line(self.answer.touching_is_called(), touching()));
        }
        for (cell, words, colour) in [
            (RollCell::Air, "in air: nothing pushes", AIR),
            (RollCell::Limit, "beyond a joint limit with its margin", FAINT),
            (RollCell::Singular, "too near to a straight posture", OTHERS),
            (RollCell::Reach, "out of reach", PAPER),
        ] {
            if has(cell) {
                entries.push(Entry::new(words, square(colour)));
            }
        }
        entries
    }
}

fn colour(cell: RollCell, bands: &Bands) -> String {
    match cell {
        RollCell::Error(error) => bands.of_value(error * 1e3),
        RollCell::Air => AIR.into(),
        RollCell::Reach => PAPER.into(),
        RollCell::Limit => FAINT.into(),
        RollCell::Singular => OTHERS.into(),
    }
}
