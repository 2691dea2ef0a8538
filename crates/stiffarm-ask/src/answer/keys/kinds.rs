//! What a field is: a key, a unit, a kind.

use serde_json::Value;
use stiffarm::catalogue::microradians;

/// A unit of answers; inside, everything is SI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A number of its own.
    One,
    /// m.
    Metre,
    /// mm, from m.
    Millimetre,
    /// deg, from rad.
    Degree,
    /// mrad, from rad.
    Milliradian,
    /// N.
    Newton,
    /// um/N, from m/N.
    MicrometrePerNewton,
    /// urad/(N m), from rad/(N m).
    MicroradianPerNewtonMetre,
    /// N m/rad.
    NewtonMetrePerRadian,
    /// kg.
    Kilogram,
    /// N m.
    NewtonMetre,
    /// s.
    Second,
    /// W.
    Watt,
    /// mm/min, from m/s.
    MillimetrePerMinute,
    /// As it was given, in the unit named.
    Given(&'static str),
    /// Several together, as the field says.
    Described,
}

impl Unit {
    /// A number in SI in this unit; zero has no sign.
    pub fn of_si(self, si: f64) -> f64 {
        match self {
            Self::One
            | Self::Metre
            | Self::Newton
            | Self::NewtonMetrePerRadian
            | Self::Kilogram
            | Self::NewtonMetre
            | Self::Second
            | Self::Watt
            | Self::Given(_)
            | Self::Described => si + 0.0,
            Self::MillimetrePerMinute => si * 60e3 + 0.0,
            Self::Millimetre | Self::Milliradian => si * 1e3 + 0.0,
            Self::Degree => si.to_degrees() + 0.0,
            Self::MicrometrePerNewton => si * 1e6 + 0.0,
            Self::MicroradianPerNewtonMetre => microradians(si),
        }
    }
}

/// What a field holds, and under which headings its parts stand in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Words.
    Text,
    /// Yes or no.
    Truth,
    /// How many, or which one.
    Count,
    /// A number.
    Number(Unit),
    /// Several numbers in a fixed order.
    Numbers {
        /// Of each.
        unit: Unit,
        /// Heading of each in a table.
        columns: &'static [&'static str],
        /// So many stand together in a list of lists; 0 where there is one list.
        nested: usize,
        /// Single ones may be null.
        open: bool,
    },
    /// A list of any length, in the unit of its items; in no table.
    List(&'static Kind),
    /// An item of a list that may be null.
    Maybe(&'static Kind),
    /// Values under names that are not keys of ours; in no table.
    ByName(&'static Kind),
    /// What has fields of its own, by a [`Shape`](super::slots::Shape); in no table.
    Object,
    /// A list of these.
    Objects,
}

/// A key of answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// The key in JSON, and the heading of its column; its ending is its unit.
    pub key: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// What it is, in one line.
    pub about: &'static str,
}

impl Field {
    pub(super) const fn new(key: &'static str, kind: Kind, about: &'static str) -> Self {
        Self { key, kind, about }
    }

    /// Its unit, where it holds numbers.
    pub const fn unit(&self) -> Option<Unit> {
        self.kind.unit()
    }
}

impl Kind {
    /// Is it what stands in JSON for such a value? Objects are a matter of their shape.
    pub fn accepts(self, value: &Value) -> bool {
        match (self, value) {
            (Self::Text, Value::String(_))
            | (Self::Truth, Value::Bool(_))
            | (Self::Number(_), Value::Number(_))
            | (Self::Maybe(_), Value::Null) => true,
            (Self::Count, Value::Number(number)) => number.is_u64(),
            (Self::Maybe(of), value) => of.accepts(value),
            (Self::List(of), Value::Array(items)) => items.iter().all(|item| of.accepts(item)),
            (Self::ByName(of), Value::Object(values)) => values.values().all(|value| of.accepts(value)),
            (Self::Numbers { nested, open, .. }, Value::Array(items)) => items.iter().all(|item| match item {
                Value::Array(_) => {
                    0 < nested && Self::Numbers { unit: Unit::One, columns: &[], nested: 0, open }.accepts(item)
                }
                Value::Number(_) => nested == 0,
                item => nested == 0 && open && item.is_null(),
            }),
            _ => false,
        }
    }

    /// Its unit, where it holds numbers.
    pub const fn unit(self) -> Option<Unit> {
        match self {
            Self::Number(unit) | Self::Numbers { unit, .. } => Some(unit),
            Self::List(of) | Self::Maybe(of) | Self::ByName(of) => of.unit(),
            Self::Text | Self::Truth | Self::Count | Self::Object | Self::Objects => None,
        }
    }
}

pub(super) const fn numbers(unit: Unit, columns: &'static [&'static str]) -> Kind {
    Kind::Numbers { unit, columns, nested: 0, open: false }
}

/// The same where single ones may be null.
pub(super) const fn open_numbers(unit: Unit, columns: &'static [&'static str]) -> Kind {
    Kind::Numbers { unit, columns, nested: 0, open: true }
}

/// The fields of a verb: a module `field` with each as a constant, and `FIELDS`, all of them in this order.
macro_rules! fields {
    ($($name:ident: $key:literal, $kind:expr, $about:literal;)*) => {
        /// Keys.
        pub(in crate::answer::keys) mod field {
            use super::*;

            $(
                #[doc = $about]
                pub const $name: $crate::answer::keys::kinds::Field =
                    $crate::answer::keys::kinds::Field::new($key, $kind, $about);
            )*

            pub(in crate::answer::keys) const FIELDS: &[$crate::answer::keys::kinds::Field] = &[$($name),*];
        }
    };
}
pub(super) use fields;
