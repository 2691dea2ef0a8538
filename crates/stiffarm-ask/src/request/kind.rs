//! What does an option take, and which value does a text stand for?

use stiffarm::catalogue::is_date;

use super::notation::{
    block, direction, elevation, flat, force, heading, marker, mount, number, of_tool, open_range, pin, point, roll,
    shape, spindle, tool, tool_length, way, window, yaw,
};
use super::value::{Type, Value};

/// What an option takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Any text.
    Text,
    /// A robot's name, or a path.
    Robot,
    /// A file's name, or what stands for one.
    File,
    /// A file for all tools, or one for a tool of a path: `FILE`, `T1=FILE`.
    FileOfTool,
    /// How far a tool of a path stands out, mm: `T1=82.5`.
    LengthOfTool,
    /// Yes where it is given.
    Flag,
    /// One of some words, each with a line of help.
    Word(&'static [(&'static str, &'static str)]),
    /// A number.
    Number {
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
        /// The unit in the words of a refusal.
        of: &'static str,
        /// Zero is allowed, too.
        or_zero: bool,
    },
    /// A whole number.
    Whole {
        /// The smallest.
        min: usize,
        /// The largest.
        max: usize,
    },
    /// N: a size, or three numbers along axes.
    Force,
    /// `a..b`.
    Range {
        /// Neither end may be left open.
        is_bounded: bool,
    },
    /// `x0..x1,z0..z1` or `x0..x1,y0..y1,z0..z1` in m; several with `;` between.
    Within,
    /// `x0..x1,y0..y1,z0..z1`; several with `;` between.
    Block {
        /// The unit: m or mm.
        of: &'static str,
        /// No end of a range may be left open.
        is_bounded: bool,
    },
    /// How the base is mounted.
    Mount,
    /// Of a rectangle: a word, or degrees.
    Angle,
    /// Of the tool axis: a word, or degrees.
    Elevation,
    /// `any`, or degrees.
    Yaw,
    /// How the roll of a tool is chosen: a word, or degrees.
    Roll,
    /// A roll at a place of a path: `MM@DEG`.
    Pin,
    /// A height in m, or `none`.
    Floor,
    /// A tool frame in mm and degrees.
    Tool,
    /// A spindle by its length, mm, and its angle to the flange axis, deg.
    Spindle,
    /// A point of the flange frame, mm.
    Point,
    /// The same, with the name of a marker before it.
    Marker,
    /// In which direction something can be loaded.
    Way,
    /// A direction along flange axes.
    Direction,
    /// Year, month and day.
    Date,
    /// What a column is called in a table: `NAME=HEADING`.
    Heading,
    /// A zone or a part, with its size.
    Task,
    /// A flat zone with its size.
    Zone,
    /// A zone at size 1.
    Shape,
    /// An inverse-kinematics solution.
    Posture,
}

/// No bound on how many.
pub(super) const ANY: usize = usize::MAX;

/// How many values an option takes, separated by commas or given several times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// At least.
    pub least: usize,
    /// At most.
    pub most: usize,
    /// No number between the two: one for all, or one each.
    pub is_one_or_all: bool,
    /// What is counted, such as `angles`.
    pub what: &'static str,
    /// For the words of a refusal.
    pub expected: &'static str,
}

pub(super) const fn count_of(least: usize, most: usize, what: &'static str, expected: &'static str) -> Count {
    Count { least, most, is_one_or_all: false, what, expected }
}

/// One for all, or one each.
pub(super) const fn one_or(all: usize, what: &'static str, expected: &'static str) -> Count {
    Count { least: 1, most: all, is_one_or_all: true, what, expected }
}

pub(super) const fn count(exactly: usize, what: &'static str, expected: &'static str) -> Count {
    count_of(exactly, exactly, what, expected)
}

pub(super) const fn number_of(min: f64, max: f64, of: &'static str) -> Kind {
    Kind::Number { min, max, of, or_zero: false }
}

pub(super) const fn degrees_of(most: f64, of: &'static str) -> Kind {
    number_of(-most, most, of)
}

impl Kind {
    /// The words there are, where there are only some.
    pub fn words(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Word(words) => words,
            _ => &[],
        }
    }

    /// Of which type its values are.
    pub(super) const fn type_of(self) -> Type {
        match self {
            Self::Text | Self::Robot | Self::File | Self::FileOfTool | Self::Date => Type::Text,
            Self::LengthOfTool => Type::OfTool,
            Self::Flag => Type::Truth,
            Self::Word(_) => Type::Word,
            Self::Number { .. } | Self::Elevation => Type::Number,
            Self::Whole { .. } => Type::Whole,
            Self::Force => Type::Force,
            Self::Range { .. } | Self::Yaw => Type::Interval,
            Self::Within => Type::Window,
            Self::Block { .. } => Type::Block,
            Self::Mount => Type::Mount,
            Self::Angle => Type::Angle,
            Self::Roll => Type::Roll,
            Self::Pin => Type::Pin,
            Self::Floor => Type::Floor,
            Self::Tool | Self::Spindle => Type::Tool,
            Self::Point | Self::Direction => Type::Point,
            Self::Marker => Type::Marker,
            Self::Way => Type::Way,
            Self::Heading => Type::Heading,
            Self::Task => Type::Task,
            Self::Zone | Self::Shape => Type::Zone,
            Self::Posture => Type::Posture,
        }
    }

    /// A value may begin with a minus.
    pub fn may_be_negative(self) -> bool {
        !matches!(
            self,
            Self::Text
                | Self::Robot
                | Self::File
                | Self::FileOfTool
                | Self::LengthOfTool
                | Self::Flag
                | Self::Word(_)
                | Self::Task
                | Self::Zone
                | Self::Shape
                | Self::Posture
                | Self::Spindle
                | Self::Mount
                | Self::Pin
                | Self::Date
                | Self::Heading
        )
    }

    /// A job file has it as a number (or as a list of some), never as a text.
    pub(super) fn is_number(self) -> bool {
        matches!(self, Self::Number { .. } | Self::Whole { .. } | Self::Force)
    }

    /// A job file may have it as a number.
    pub(super) fn may_be_number(self) -> bool {
        self.is_number() || matches!(self, Self::Angle | Self::Elevation | Self::Floor | Self::Yaw | Self::Roll)
    }

    /// What a text stands for, or what was expected.
    pub(super) fn read(self, text: &str) -> Result<Value, String> {
        match self {
            Self::File if text.trim().is_empty() => Err("expected a file's name".into()),
            Self::FileOfTool if of_tool(text).1.trim().is_empty() => Err("expected a file's name, or T1=FILE".into()),
            Self::LengthOfTool => tool_length(text).map(Value::OfTool),
            Self::Text | Self::Robot | Self::File | Self::FileOfTool => Ok(Value::Text(text.into())),
            Self::Date if is_date(text) => Ok(Value::Text(text.into())),
            Self::Date => Err("expected a day as year-month-day, such as 2026-05-31".into()),
            Self::Heading => heading(text).map(Value::Heading),
            Self::Flag => text.parse().map(Value::Truth).map_err(|_| "expected true or false".into()),
            Self::Word(words) => {
                let known = words.iter().find(|(word, _)| *word == text);
                known.map(|(word, _)| Value::Word(word)).ok_or_else(|| expected(words))
            }
            Self::Number { or_zero: true, .. } if number(text, 0.0, 0.0, "").is_ok() => Ok(Value::Number(0.0)),
            Self::Number { min, max, of, .. } => number(text, min, max, of).map(Value::Number),
            Self::Whole { min, max } => {
                let whole = text.trim().parse().ok().filter(|whole| (min..=max).contains(whole));
                whole.map(Value::Whole).ok_or_else(|| format!("expected a whole number from {min} to {max}"))
            }
            Self::Force => force(text).map(Value::Force),
            Self::Range { is_bounded } => match open_range(text)? {
                range if is_bounded && !range.is_bounded() => Err("it takes both ends, e.g. 0.5..1.5".into()),
                range => Ok(Value::Interval(range)),
            },
            Self::Within => window(text).map(Value::Window),
            Self::Block { of, is_bounded } => block(text, of, is_bounded).map(Value::Block),
            Self::Mount => mount(text).map(Value::Mount),
            Self::Angle => text.parse().map(Value::Angle),
            Self::Elevation => elevation(text).map(Value::Number),
            Self::Yaw => yaw(text).map(Value::Interval),
            Self::Roll => roll(text).map(Value::Roll),
            Self::Pin => pin(text).map(Value::Pin),
            Self::Floor if text.trim() == "none" => Ok(Value::Floor(None)),
            Self::Floor => match number(text, -100.0, 100.0, "m from the robot's base") {
                Ok(height) => Ok(Value::Floor(Some(height))),
                Err(expected) => Err(format!("{expected}, or none")),
            },
            Self::Tool => tool(text).map(Value::Tool),
            Self::Point => point(text).map(Value::Point),
            Self::Marker => marker(text).map(Value::Marker),
            Self::Way => way(text).map(Value::Way),
            Self::Direction => direction(text).map(|unit| Value::Point(unit.into())),
            Self::Spindle => spindle(text).map(Value::Tool),
            Self::Task => text.parse().map(Value::Task).map_err(|error: stiffarm::task::TaskError| error.to_string()),
            Self::Zone => flat(text).map(Value::Zone),
            Self::Shape => shape(text).map(Value::Zone),
            Self::Posture => text
                .parse()
                .map(Value::Posture)
                .map_err(|error: stiffarm::inverse::UnknownConfiguration| error.to_string()),
        }
    }
}

/// `expected up or down`.
fn expected(words: &[(&str, &str)]) -> String {
    let names: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("expected {} or {last}", first.join(", ")),
        names => format!("expected {}", names.concat()),
    }
}
