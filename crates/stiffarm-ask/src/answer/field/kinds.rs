//! What a field is: a key, a unit, a kind.

use stiffarm::catalogue::microradians;

/// A unit as answers tell it; inside, everything is SI.
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
            | Self::Given(_) => si + 0.0,
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
    },
    /// What has fields of its own, or is a list; in no table.
    Nested,
}

/// One thing that can be told.
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
        match self.kind {
            Kind::Number(unit) | Kind::Numbers { unit, .. } => Some(unit),
            Kind::Text | Kind::Truth | Kind::Count | Kind::Nested => None,
        }
    }
}

pub(super) const fn numbers(unit: Unit, columns: &'static [&'static str]) -> Kind {
    Kind::Numbers { unit, columns, nested: 0 }
}

/// The fields of a verb as constants, and `FIELDS`, all of them in this order.
macro_rules! fields {
    ($($name:ident: $key:literal, $kind:expr, $about:literal;)*) => {
        $(
            #[doc = $about]
            pub const $name: super::kinds::Field = super::kinds::Field::new($key, $kind, $about);
        )*

        pub(super) const FIELDS: &[super::kinds::Field] = &[$($name),*];
    };
}
pub(super) use fields;
