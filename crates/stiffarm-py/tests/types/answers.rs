//! What comes out, as the type checker sees it: the keys of answers of every kind, and what stands under them.

use std::fmt::Write;

use serde_json::Value;
use stiffarm::answer::field::{self, Field, Kind};

/// What was seen under one key, in any answer.
#[derive(Default)]
pub(crate) struct Seen {
    is_null: bool,
    is_text: bool,
    is_truth: bool,
    is_count: bool,
    is_number: bool,
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
        match value {
            Value::Null => self.is_null = true,
            Value::Bool(_) => self.is_truth = true,
            Value::String(_) => self.is_text = true,
            Value::Number(number) if number.is_f64() => self.is_number = true,
            Value::Number(_) => self.is_count = true,
            Value::Array(items) => {
                let seen = self.items.get_or_insert_default();
                items.iter().for_each(|item| seen.see(item));
            }
            Value::Object(_) => self.fields.get_or_insert_default().see(value),
        }
    }

    /// As Python writes it; objects by the name that `named` gives them.
    fn python(&self, named: &str) -> String {
        let mut kinds: Vec<String> = Vec::new();
        let mut add = |is: bool, kind: &str| kinds.extend(is.then(|| kind.to_owned()));
        add(self.is_text, "str");
        add(self.is_truth, "bool");
        add(self.is_count && !self.is_number, "int");
        add(self.is_number, "float");
        add(self.fields.is_some(), named);
        if let Some(items) = &self.items {
            add(true, &format!("list[{}]", items.python(named)));
        }
        add(self.is_null, "None");
        kinds.join(" | ")
    }

    /// What the objects in it hold.
    fn objects(&self) -> Option<&Fields> {
        self.fields.as_ref().or_else(|| self.items.as_ref()?.objects())
    }

    /// Of the fields of one key the one that is of this kind.
    fn field(&self, key: &str) -> Option<&'static Field> {
        let fits = |field: &&&Field| match field.kind {
            Kind::Text => self.is_text,
            Kind::Truth => self.is_truth,
            Kind::Count => self.is_count,
            Kind::Number(_) => self.is_number || self.is_null && self.items.is_none(),
            Kind::Numbers { .. } => self.items.as_ref().is_some_and(|items| items.fields.is_none()),
            Kind::Nested => self.objects().is_some() || self.items.is_some(),
        };
        let candidates: Vec<&Field> = field::ALL.iter().filter(|field| field.key == key).collect();
        candidates.iter().find(fits).or(candidates.last()).copied()
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
