//! The keys of answers, each once for each of its meanings: a file for what a verb answers, with its fields and the objects in which they stand.

mod calibrate;
mod cell;
mod chatter;
mod compare;
mod compliance;
mod force;
mod groups;
mod identify;
mod kinds;
mod load;
mod map;
mod measure;
mod mill;
mod modes;
mod path;
mod place;
mod rank;
mod robots;
mod schema;
mod slots;
mod study;
mod verify;

/// The modules that have keys, and those that have objects, each in the order in which they are listed.
macro_rules! listed {
    (fields: $($field:ident)*; shapes: $($shape:ident)*) => {
        /// What a key means: its unit, and what it is.
        pub mod field {
            pub use crate::answer::keys::kinds::{Field, Kind, Unit};

            $(pub use crate::answer::keys::$field::field::*;)*

            /// All of them.
            pub fn all() -> impl Iterator<Item = &'static Field> {
                [$(crate::answer::keys::$field::field::FIELDS),*].into_iter().flatten()
            }
        }

        mod shapes {
            $(pub use crate::answer::keys::$shape::shape::*;)*
        }
    };
}

listed! {
    fields: place rank compliance study map load modes chatter robots identify measure path force mill verify calibrate cell schema;
    shapes: calibrate chatter compare compliance identify map measure mill modes path place rank robots schema study verify
}

/// Which fields an object of an answer holds, and in which order.
pub mod shape {
    use crate::request::Verb;

    pub use crate::answer::keys::shapes::*;
    pub use crate::answer::keys::slots::{Shape, Slot};

    /// What a verb answers, one of these, behind its schema: of a zone first, then of a path. The catalogue is a list of robots by the keys of
    /// their files.
    pub fn answers(verb: Verb) -> Vec<&'static Shape> {
        match verb {
            Verb::Rank => vec![&RANKING, &PATH_RANKING],
            Verb::Place => vec![&PLACEMENT, &MILLED, &MILLED_BY_TOOL],
            Verb::Map => vec![&MAP],
            Verb::Compare => vec![&COMPARISON],
            Verb::Compliance => vec![&COMPLIANCE],
            Verb::Modes => vec![&MODES, &MODES_OVER_ZONE],
            Verb::Chatter => vec![&CHATTER],
            Verb::Study => vec![&STUDY],
            Verb::Identify => vec![&IDENTIFICATION],
            Verb::Measure => vec![&MEASUREMENT_PLAN, &CALIBRATION_PLAN],
            Verb::Calibrate => vec![&CALIBRATION],
            Verb::Verify => vec![&VERIFICATION, &FITTING_ROBOTS],
            Verb::Mill => vec![&MILLED, &MILLED_BY_TOOL, &PATH_RANKING, &TOOLPATH],
            Verb::Force => vec![&FORCE],
            Verb::List => vec![],
        }
    }

    /// Every object that stands in answers, each once, behind those that stand in it.
    pub fn all() -> Vec<&'static Shape> {
        fn add(shape: &'static Shape, found: &mut Vec<&'static Shape>) {
            if found.iter().all(|known| known.name != shape.name) {
                for under in shape.slots().filter_map(|slot| slot.of) {
                    add(under, found);
                }
                found.push(shape);
            }
        }
        let mut found = vec![&SCHEMA];
        for shape in Verb::ALL.into_iter().flat_map(answers).chain([&LEDGER]) {
            add(shape, &mut found);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::field::{self, Kind, Unit};
    use super::shape::{self, Slot};

    #[test]
    fn the_ending_of_a_key_is_the_unit_of_its_numbers() {
        for field in field::all() {
            let ending = match field.unit() {
                Some(Unit::Metre) => "_m",
                Some(Unit::Millimetre) => "_mm",
                Some(Unit::Degree) => "_deg",
                Some(Unit::Milliradian) => "_mrad",
                Some(Unit::Newton) => "_n",
                Some(Unit::MicrometrePerNewton) => "_um_per_n",
                Some(Unit::MicroradianPerNewtonMetre) => "_urad_per_nm",
                Some(Unit::NewtonMetrePerRadian) => "_nm_per_rad",
                Some(Unit::Kilogram) => "_kg",
                Some(Unit::NewtonMetre) => "_nm",
                Some(Unit::Second) => "_s",
                Some(Unit::Watt) => "_w",
                Some(Unit::MillimetrePerMinute) => "_mm_per_min",
                Some(Unit::Given(unit)) => unit,
                Some(Unit::One | Unit::Described) | None => "",
            };
            let key =
                ["_p05", "_p50", "_p95"].iter().find_map(|share| field.key.strip_suffix(share)).unwrap_or(field.key);
            assert!(key.ends_with(ending), "{field:?}");
            let endings = ["_m", "_mm", "_deg", "_mrad", "_n", "_um_per_n", "_urad_per_nm", "_nm_per_rad", "_kg"];
            let has_unit = endings.iter().any(|ending| key.ends_with(ending));
            let has_none = matches!(field.unit(), None | Some(Unit::Described));
            assert!(!ending.is_empty() || !has_unit || has_none, "a number of no unit: {field:?}");
            assert!(field.about.ends_with('.') && field.about.is_ascii(), "{field:?}");
            if let Kind::Numbers { columns, .. } = field.kind {
                assert!(columns.is_empty() || 1 < columns.len(), "{field:?}");
            }
        }
    }

    #[test]
    fn numbers_are_given_in_their_unit() {
        for (unit, si, expected) in [
            (Unit::Millimetre, 0.0025, 2.5),
            (Unit::Degree, std::f64::consts::PI, 180.0),
            (Unit::MicrometrePerNewton, 3e-6, 3.0),
            (Unit::Milliradian, 0.5, 500.0),
            (Unit::MicroradianPerNewtonMetre, 0.7e-6, 0.7),
            (Unit::Metre, 1.5, 1.5),
            (Unit::MillimetrePerMinute, 0.01, 600.0),
        ] {
            assert!((unit.of_si(si) - expected).abs() < 1e-12, "{unit:?}");
        }
    }

    #[test]
    fn a_shape_names_each_key_once_and_what_stands_under_it() {
        let all = shape::all();
        assert!(40 < all.len());
        for shape in all {
            let mut keys: Vec<&str> = shape.slots().map(|slot| slot.field.key).collect();
            keys.sort_unstable();
            let count = keys.len();
            keys.dedup();
            assert_eq!(keys.len(), count, "{} has a key twice", shape.name);
            for Slot { field, of, .. } in shape.slots() {
                let is_known = of.is_none_or(|of| shape::all().iter().any(|known| std::ptr::eq(*known, of)));
                assert!(is_known, "two shapes are called {:?}", of.map(|of| of.name));
                assert_eq!(
                    matches!(field.kind, Kind::Object | Kind::Objects),
                    of.is_some(),
                    "{}.{}",
                    shape.name,
                    field.key
                );
            }
            assert!(shape.about.ends_with('.') && shape.about.is_ascii(), "{}", shape.name);
        }
    }
}
