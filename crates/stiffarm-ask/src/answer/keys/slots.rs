//! What an object of an answer is: its fields, and which of them may be null.

use serde_json::{Map, Value};

use super::kinds::{Field, Kind};

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
    pub(super) groups: &'static [&'static [Slot]],
}

/// Fields of an object, each with `| null` where it may be null, and with `=> SHAPE` where an object or a list of them stands under it.
macro_rules! slots {
    ($($field:ident $(| $null:ident)? $(=> $of:path)?),* $(,)?) => {
        &[$($crate::answer::keys::slots::Slot {
            field: $crate::answer::field::$field,
            may_be_null: $crate::answer::keys::slots::slots!(@may $($null)?),
            of: $crate::answer::keys::slots::slots!(@of $($of)?),
        }),*]
    };
    (@may) => { false };
    (@may null) => { true };
    (@of) => { None };
    (@of $of:path) => { Some(&$of) };
}

/// The objects of a verb: a module `shape` with each by its name, what it is, and its fields group by group.
macro_rules! shapes {
    ($($shape:ident: $name:literal, $about:literal, $groups:expr;)*) => {
        /// Objects.
        pub(in crate::answer::keys) mod shape {
            use super::*;

            $(
                #[doc = $about]
                pub static $shape: $crate::answer::keys::slots::Shape =
                    $crate::answer::keys::slots::Shape { name: $name, about: $about, groups: $groups };
            )*
        }
    };
}
pub(super) use {shapes, slots};

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
    use super::super::shape::PATH_CONTACT;
    use super::*;

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
