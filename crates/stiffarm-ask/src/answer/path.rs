//! What is reported of a toolpath before anything is milled: what was understood, assumed and ignored.

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::numbers::rpm;
use super::{Line, Record, Rows, Table, field, fixed, line, schema_of, shape, under};
use stiffarm::toolpath::{Survey, Understood};

/// The answer of `mill --dry`, with what was asked.
#[derive(Clone, Debug)]
pub struct PathAnswer {
    /// The path as it was asked for.
    pub path: String,
    /// What was read besides moves; `None` of a path built in.
    pub understood: Option<Understood>,
    /// What the path is.
    pub survey: Survey,
}

/// Two corners of a box as they are reported.
pub(super) fn corners([a, b]: [Vector3<f64>; 2]) -> [f64; 6] {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

/// A box as people read it, one axis after the other.
pub(super) fn within([low, high]: [Vector3<f64>; 2]) -> [String; 3] {
    let mm = |metres: f64| fixed(metres * 1e3, 3);
    std::array::from_fn(|axis| format!("{} to {} mm", mm(low[axis]), mm(high[axis])))
}

impl PathAnswer {
    /// Every field.
    pub fn record(&self) -> Record {
        let Self { path, understood, survey } = self;
        let understood = understood.as_ref();
        let mut record = Record::of(&shape::TOOLPATH);
        record
            .put(field::PATH, path)
            .put(field::PATH_FORMAT, understood.map_or("built-in", |read| read.format.name()))
            .put(field::LINES, understood.map(|read| read.lines))
            .put(field::FEED_LENGTH, survey.feed_length)
            .put(field::RAPID_LENGTH, survey.rapid_length)
            .put(field::FEED_MOVES, survey.feed_moves)
            .put(field::RAPID_MOVES, survey.rapid_moves)
            .put(field::TOOLS, survey.tools.iter().map(|(tool, _)| json!(tool)).collect::<Value>())
            .put(field::APART, understood.map_or(0, |read| read.apart))
            .put(field::ARCS, survey.arcs)
            .put(field::FULL_CIRCLES, survey.full_circles)
            .put(field::ARC_LENGTH, survey.arc_length)
            .put(field::BOX, survey.extent.map(corners))
            .put(field::RAPID_BOX, survey.rapid_extent.map(corners))
            .put(field::FEEDS, survey.feeds.map(|feeds| [feeds.min(), feeds.max()]))
            .put(field::FEED_TIME, survey.feed_time)
            .put(field::SPINDLE_SPEEDS, survey.spindles.map(|speeds| [speeds.min(), speeds.max()].map(rpm)))
            .put(field::TILT, survey.tilt)
            .put(field::AXIS_TURN, survey.turn)
            .put(field::SAMPLES_OF_PATH, survey.samples)
            .put(field::CHORD_ERROR, survey.chord_error)
            .put(field::ARC_MISS, understood.map_or(0.0, |read| read.arc_miss))
            .put(field::ASSUMED, understood.map_or_else(|| json!([]), |read| json!(read.assumed)))
            .put(field::IGNORED, understood.map_or_else(|| json!([]), |read| json!(read.ignored)));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        under(schema_of("mill", "the path's own origin", "those of the path"), &self.record())
    }

    /// For a spreadsheet: one row.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::TOOLPATH, [self.record()])
    }

    /// For people.
    pub fn table(&self) -> Table {
        let Self { path, understood, survey } = self;
        let mm = |metres: f64| fixed(metres * 1e3, 3);
        let how = understood
            .as_ref()
            .map_or("built in".into(), |read| format!("{}, {} lines", read.format.name(), read.lines));
        let mut lines: Vec<Line> = vec![
            line("path", path),
            line("read as", how),
            line("feed moves", format!("{}, {} mm", survey.feed_moves, mm(survey.feed_length))),
            line(
                "of these arcs",
                format!("{} ({} full circles), {} mm", survey.arcs, survey.full_circles, mm(survey.arc_length)),
            ),
            line("rapid moves", format!("{}, {} mm", survey.rapid_moves, mm(survey.rapid_length))),
        ];
        if let Some(read) = understood.as_ref().filter(|read| 0 < read.apart) {
            lines.push(line(
                "not of the path",
                format!(
                    "{} {} to or from where only the machine knows",
                    read.apart,
                    if read.apart == 1 { "move" } else { "moves" }
                ),
            ));
        }
        for (names, extent) in [
            (["extent of feed moves x", "y", "z"], survey.extent),
            (["rapid moves end at x", "y", "z"], survey.rapid_extent),
        ] {
            let sides = extent.map(within).into_iter().flatten();
            lines.extend(names.into_iter().zip(sides).map(|(name, side)| line(name, side)));
        }
        let per_minute = |feed: f64| fixed(feed * 60e3, 1);
        lines.push(match survey.feeds {
            Some(feeds) => {
                line("feed rates", format!("{} to {} mm/min", per_minute(feeds.min()), per_minute(feeds.max())))
            }
            None => line("feed rates", "not said"),
        });
        let time =
            survey.feed_time.map_or("not known: a feed rate is missing".into(), |time| format!("{} s", fixed(time, 1)));
        lines.push(line("time of feed moves", time));
        lines.extend(survey.spindles.map(|speeds| {
            let [slowest, fastest] = [speeds.min(), speeds.max()].map(|speed| fixed(rpm(speed), 0));
            line("spindle", format!("{slowest} to {fastest} rpm"))
        }));
        let (tilt, turn) = (fixed(survey.tilt.to_degrees(), 2), fixed(survey.turn.to_degrees(), 2));
        lines.push(line("tool axis", format!("at most {tilt} deg off z, {turn} deg off where it first feeds")));
        lines.push(line(
            "samples of feed moves",
            format!("{}, chords off arcs by {} mm at most", survey.samples, fixed(survey.chord_error * 1e3, 4)),
        ));
        if survey.tools.iter().any(|(tool, _)| tool.is_some()) {
            lines.push(line("tools", tools(&survey.tools)));
        }
        for (name, of) in [
            ("assumed", |read: &Understood| read.assumed.clone()),
            ("ignored", |read: &Understood| read.ignored.clone()),
        ] as [(&str, fn(&Understood) -> Vec<String>); 2]
        {
            let all = understood.as_ref().map(of).unwrap_or_default();
            if all.is_empty() {
                lines.push(line(name, "nothing"));
            }
            for (i, one) in all.into_iter().enumerate() {
                lines.push(line(if i == 0 { name } else { "" }, one));
            }
        }
        Table::of_lines(lines)
    }
}

/// Tools and where each first feeds.
pub(super) fn tools(found: &[(Option<u32>, usize)]) -> String {
    let named = |(tool, line): &(Option<u32>, usize)| match tool {
        Some(number) => format!("T{number} from line {line}"),
        None => format!("no tool named from line {line}"),
    };
    found.iter().map(named).collect::<Vec<_>>().join(", ")
}
