//! What does a text stand for, and which types can an option have?

use stiffarm::catalogue::measurements::Marker;
use stiffarm::cell::{Block, Mount, Window};
use stiffarm::interval::Interval;
use stiffarm::inverse::Configuration;
use stiffarm::measure::LoadWay;
use stiffarm::mill::RollMode;
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Zone};

use super::notation::{Angle, Force};

/// A type of Rust that an option can have.
pub(crate) trait Typed: Sized {
    /// Which values are of it.
    const TYPE: Type;
    /// The words there are, each with a line of help, where there are only some.
    const WORDS: &'static [(&'static str, &'static str)] = &[];

    /// The value as one of this type, where it is one.
    fn of(value: Value) -> Option<Self>;
}

/// A type of which every value has a word.
pub(crate) trait Words: Copy + 'static {
    /// The words, each with a line of help.
    const WORDS: &'static [(&'static str, &'static str)];
    /// What they mean, in the same order.
    const MEANINGS: &'static [Self];
}

impl<T: Words> Typed for T {
    const TYPE: Type = Type::Word;
    const WORDS: &'static [(&'static str, &'static str)] = <T as Words>::WORDS;

    fn of(value: Value) -> Option<Self> {
        let Value::Word(word) = value else { return None };
        let place = <T as Words>::WORDS.iter().position(|(known, _)| *known == word)?;
        T::MEANINGS.get(place).copied()
    }
}

/// Makes [`Value`], [`Type`], and the types that are no words.
macro_rules! values {
    ($($(#[$doc:meta])* $variant:ident($of:ty)),* $(,)?) => {
        /// What a text stands for: numbers in the unit of the option, all else in SI.
        #[derive(Clone, Debug, PartialEq)]
        pub(crate) enum Value {
            /// One of some words.
            Word(&'static str),
            $($(#[$doc])* $variant($of),)*
        }

        /// Of which type a value is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Type {
            /// One of some words.
            Word,
            $($(#[$doc])* $variant,)*
        }

        $(impl Typed for $of {
            const TYPE: Type = Type::$variant;

            fn of(value: Value) -> Option<Self> {
                if let Value::$variant(it) = value { Some(it) } else { None }
            }
        })*
    };
}

values! {
    /// As it was given.
    Text(String),
    /// Yes or no.
    Truth(bool),
    /// In the unit of its option.
    Number(f64),
    /// How many.
    Whole(usize),
    /// N.
    Force(Force),
    /// In the unit of its option.
    Interval(Interval),
    /// Where a zone may stand.
    Window(Window),
    /// In the unit of its option.
    Block(Block),
    /// How the base is mounted.
    Mount(Mount),
    /// Of a rectangle.
    Angle(Angle),
    /// Its height, m; or none.
    Floor(Option<f64>),
    /// A tool frame.
    Tool(Pose),
    /// m, or a unit vector.
    Point([f64; 3]),
    /// With its name.
    Marker(Marker),
    /// In which direction something can be loaded.
    Way(LoadWay),
    /// A zone or a part.
    Task(Task),
    /// A flat zone.
    Zone(Task<Zone>),
    /// A solution of the inverse kinematics.
    Posture(Configuration),
    /// How the roll is chosen.
    Roll(RollMode),
    /// m along a path, and rad.
    Pin([f64; 2]),
    /// The number of a tool, and m.
    OfTool((u32, f64)),
    /// What a column is called here, and in a table.
    Heading((String, String)),
}
