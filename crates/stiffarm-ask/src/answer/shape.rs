//! Which fields does an object of an answer hold, and in which order?

mod calibrate;
mod chatter;
mod compare;
mod compliance;
mod groups;
mod identify;
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

use serde_json::{Map, Value};

use super::field::{Field, Kind};
use crate::request::Verb;

pub use calibrate::*;
pub use chatter::*;
pub use compare::*;
pub use compliance::*;
pub use identify::*;
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

/// A field where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// Which.
    pub field: Field,
    /// Null stands here where it is not known or does not apply.
    pub may_be_null: bool,
    /// What the object under it holds, or each of the list.
    pub of: Option<&'static Shape>,
}

/// What an object holds: every key, in this order.
#[derive(Debug, PartialEq)]
pub struct Shape {
    /// As types are named, in Python and in the description of the server.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    groups: &'static [&'static [Slot]],
}

/// Fields of an object, each with `| null` where it may be null, and with `=> SHAPE` where an object or a list of them stands under it.
macro_rules! slots {
    ($($field:ident $(| $null:ident)? $(=> $of:ident)?),* $(,)?) => {
        &[$($crate::answer::shape::Slot {
            field: $crate::answer::field::$field,
            may_be_null: $crate::answer::shape::slots!(@may $($null)?),
            of: $crate::answer::shape::slots!(@of $($of)?),
        }),*]
    };
    (@may) => { false };
    (@may null) => { true };
    (@of) => { None };
    (@of $of:ident) => { Some(&$of) };
}

/// Shapes by their name, what they are, and their fields group by group.
macro_rules! shapes {
    ($($shape:ident: $name:literal, $about:literal, $groups:expr;)*) => {
        $(
            #[doc = $about]
            pub static $shape: $crate::answer::shape::Shape =
                $crate::answer::shape::Shape { name: $name, about: $about, groups: $groups };
        )*
    };
}
use {shapes, slots};

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

impl Shape {
    /// Its fields in their order.
    pub fn slots(&self) -> impl Iterator<Item = &'static Slot> + use<> {
        self.groups.iter().flat_map(|group| group.iter())
    }

    /// Checks that an object has these keys and no others, in this order, and under each what belongs there.
    ///
    /// # Errors
    /// What is wrong, with the keys that lead to it.
    pub fn check(&self, object: &Map<String, Value>) -> Result<(), String> {
        let keys: Vec<&str> = object.keys().map(String::as_str).collect();
        let expected: Vec<&str> = self.slots().map(|slot| slot.field.key).collect();
        if keys != expected {
            return Err(format!("{}: the keys are {keys:?}; expected {expected:?}", self.name));
        }
        self.slots().zip(object.values()).try_for_each(|(slot, value)| {
            slot.check(value).map_err(|why| format!("{}.{}: {why}", self.name, slot.field.key))
        })
    }
}

impl Slot {
    fn check(&self, value: &Value) -> Result<(), String> {
        let shape = || self.of.ok_or_else(|| "nothing says what stands under it".to_owned());
        let object = |value: &Value| shape()?.check(value.as_object().ok_or_else(|| format!("{value} is no object"))?);
        match (self.field.kind, value) {
            (_, Value::Null) if self.may_be_null => Ok(()),
            (Kind::Object, value) => object(value),
            (Kind::Objects, Value::Array(items)) => items.iter().try_for_each(object),
            (kind, value) if kind.accepts(value) => Ok(()),
            (kind, value) => Err(format!("{value} is not {kind:?}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shape_names_each_key_once_and_what_stands_under_it() {
        let all = all();
        assert!(40 < all.len());
        for shape in all {
            let mut keys: Vec<&str> = shape.slots().map(|slot| slot.field.key).collect();
            keys.sort_unstable();
            let count = keys.len();
            keys.dedup();
            assert_eq!(keys.len(), count, "{} has a key twice", shape.name);
            for Slot { field, of, .. } in shape.slots() {
                let is_known = of.is_none_or(|of| super::all().iter().any(|known| std::ptr::eq(*known, of)));
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

    #[test]
    fn an_object_is_checked_key_by_key() {
        let check = |value: Value| PATH_CONTACT.check(value.as_object().expect("an object"));
        let contact = serde_json::json!({ "line": 3, "s_m": 0.5, "bodies": "link 4 to the floor", "depth_mm": 2.0 });
        assert_eq!(check(contact.clone()), Ok(()));
        for (key, wrong) in
            [("line", Value::Null), ("line", 0.5.into()), ("bodies", 1.into()), ("depth_mm", "2".into())]
        {
            let mut contact = contact.clone();
            contact[key] = wrong;
            let why = check(contact).expect_err("it is wrong");
            assert!(why.starts_with(&format!("PathContact.{key}: ")), "{why}");
        }
        let mut more = contact;
        more["more"] = 1.into();
        assert!(check(more).expect_err("a key too many").contains("expected"), "one key more");
    }
}
