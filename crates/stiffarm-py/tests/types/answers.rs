//! What comes out, as the type checker sees it: the keys of answers of every kind, and what stands under them.

use std::collections::BTreeSet;
use std::fmt::Write;

use serde_json::Value;
use stiffarm_ask::answer::field::{self, Field, Kind};

/// What was seen under one key, in any answer.
#[derive(Default)]
pub(crate) struct Seen {
    /// Plain values by their types in Python, but for float and int: a number is an int where no other was seen.
    plain: BTreeSet<&'static str>,
    items: Option<Box<Seen>>,
    fields: Option<Fields>,
}

/// What was seen in objects, by key, in the order of the first.
#[derive(Default)]
pub(crate) struct Fields {
    objects: usize,
    /// Key, what was seen, and in how many objects.
    keys: Vec<(String, Seen, usize)>,
}

impl Fields {
    /// Of objects that are answers of one kind.
    pub(crate) fn of<'a>(answers: impl IntoIterator<Item = &'a Value>) -> Self {
        let mut fields = Self::default();
        for answer in answers {
            fields.see(answer);
        }
        fields
    }

    fn see(&mut self, object: &Value) {
        self.objects += 1;
        for (key, value) in object.as_object().expect("an object") {
            let at = self.keys.iter().position(|(known, ..)| known == key).unwrap_or_else(|| {
                self.keys.push((key.clone(), Seen::default(), 0));
                self.keys.len() - 1
            });
            self.keys[at].1.see(value);
            self.keys[at].2 += 1;
        }
    }
}

impl Seen {
    fn see(&mut self, value: &Value) {
        let plain = match value {
            Value::Null => "None",
            Value::Bool(_) => "bool",
            Value::String(_) => "str",
            Value::Number(number) if number.is_f64() => "float",
            Value::Number(_) => "int",
            Value::Array(items) => {
                let seen = self.items.get_or_insert_default();
                for item in items {
                    seen.see(item);
                }
                return;
            }
            Value::Object(_) => return self.fields.get_or_insert_default().see(value),
        };
        self.plain.insert(plain);
    }

    /// As Python writes it; objects by the name that `named` gives them.
    fn python(&self, named: &str) -> String {
        let has = |kind: &&str| self.plain.contains(kind);
        let plain = ["str", "bool", "int", "float"].into_iter().filter(has);
        // What is 1 in one answer and 0.5 in another is a number.
        let plain = plain.filter(|kind| *kind != "int" || !has(&"float")).map(str::to_owned);
        let object = self.fields.as_ref().map(|_| named.to_owned());
        let list = self.items.as_ref().map(|items| format!("list[{}]", items.python(named)));
        let none = has(&"None").then(|| "None".to_owned());
        plain.chain(object).chain(list).chain(none).collect::<Vec<_>>().join(" | ")
    }

    /// What the objects in it hold.
    fn objects(&self) -> Option<&Fields> {
        self.fields.as_ref().or_else(|| self.items.as_ref()?.objects())
    }

    /// Of the fields of one key the one that is of this kind.
    fn field(&self, key: &str) -> Option<&'static Field> {
        let fits = |field: &&&Field| match field.kind {
            Kind::Text => self.plain.contains("str"),
            Kind::Truth => self.plain.contains("bool"),
            Kind::Count => self.plain.contains("int"),
            Kind::Number(_) => self.plain.contains("float") || self.plain.contains("None") && self.items.is_none(),
            Kind::Numbers { .. } => self.items.as_ref().is_some_and(|items| items.fields.is_none()),
            Kind::Nested => self.objects().is_some() || self.items.is_some(),
        };
        let candidates: Vec<&Field> = field::all().filter(|field| field.key == key).collect();
        candidates.iter().find(fits).or(candidates.first()).copied()
    }
}

/// A class for objects of one kind, after those for the objects in them; keys that not all of them have stand in a class of their own.
pub(crate) fn class(
    text: &mut String,
    (name, base): (&str, &str),
    about: &str,
    fields: &Fields,
    named: &[(&str, &str)],
) {
    let is_always = |(_, _, objects): &&(String, Seen, usize)| *objects == fields.objects;
    let (always, sometimes): (Vec<_>, Vec<_>) = fields.keys.iter().partition(is_always);
    let mut write = |head: &str, keys: Vec<&(String, Seen, usize)>| {
        writeln!(text, "\n\nclass {head}:\n    \"\"\"{about}\"\"\"").unwrap();
        // A word of Python's own has no place in a class.
        for (key, seen, _) in keys.into_iter().filter(|(key, ..)| key != "pass") {
            let object = named.iter().find(|(of, _)| of == key).map_or("dict[str, object]", |(_, object)| object);
            writeln!(text, "\n    {key}: {}", seen.python(object)).unwrap();
            if let Some(field) = seen.field(key) {
                writeln!(text, "    \"\"\"{}\"\"\"", super::wrapped(field.about)).unwrap();
            }
        }
    };
    if sometimes.is_empty() {
        write(&format!("{name}({base})"), always);
    } else {
        write(&format!("_{name}({base})"), always);
        write(&format!("{name}(_{name}, total=False)"), sometimes);
    }
}

impl Fields {
    /// What stands in the objects under a key.
    pub(crate) fn under(&self, key: &str) -> &Fields {
        let found = self.keys.iter().find(|(known, ..)| known == key).and_then(|(_, seen, _)| seen.objects());
        found.unwrap_or_else(|| panic!("no objects under {key}"))
    }
}
