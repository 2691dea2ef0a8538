//! The keys of answers, each once for each of its meanings: its unit, and what it is; a file for what a verb answers.

mod calibrate;
mod cell;
mod chatter;
mod compliance;
mod force;
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
mod study;
mod verify;

pub use calibrate::*;
pub use cell::*;
pub use chatter::*;
pub use compliance::*;
pub use force::*;
pub use identify::*;
pub use kinds::{Field, Kind, Unit};
pub use load::*;
pub use map::*;
pub use measure::*;
pub use mill::*;
pub use modes::*;
pub use path::*;
pub use place::*;
pub use rank::*;
pub use robots::*;
pub use schema::*;
pub use study::*;
pub use verify::*;

/// All of them.
pub fn all() -> impl Iterator<Item = &'static Field> {
    let lists = [
        place::FIELDS,
        rank::FIELDS,
        compliance::FIELDS,
        study::FIELDS,
        map::FIELDS,
        load::FIELDS,
        modes::FIELDS,
        chatter::FIELDS,
        robots::FIELDS,
        identify::FIELDS,
        measure::FIELDS,
        path::FIELDS,
        force::FIELDS,
        mill::FIELDS,
        verify::FIELDS,
        calibrate::FIELDS,
        cell::FIELDS,
        schema::FIELDS,
    ];
    lists.into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_of_a_key_is_the_unit_of_its_numbers() {
        for field in all() {
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
}
