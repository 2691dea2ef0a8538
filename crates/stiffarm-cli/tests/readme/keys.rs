//! Which keys does the answer of a verb have? Those of its recorded answers, each with its unit and what it is.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use serde_json::{Map, Value};
use stiffarm_ask::answer::field::{self, Field, Kind};
use stiffarm_ask::request::Verb;

use super::reference::{head, row, unit};
use crate::recorded::recorded_json;

/// What stood under one key, in any answer of a verb.
#[derive(Default)]
struct Seen {
    /// Which plain values, or lists of them.
    plain: BTreeSet<&'static str>,
    is_list: bool,
    /// What the objects under it hold, in the order of the first.
    keys: Keys,
}

type Keys = Vec<(String, Seen)>;

impl Seen {
    fn see(&mut self, value: &Value) {
        match value {
            Value::Null => {}
            Value::Bool(_) => drop(self.plain.insert("truth")),
            Value::String(_) => drop(self.plain.insert("text")),
            Value::Number(_) => drop(self.plain.insert("number")),
            Value::Array(items) => {
                self.is_list = true;
                for item in items {
                    self.see(item);
                }
            }
            Value::Object(object) => see(&mut self.keys, object),
        }
    }

    fn fits(&self, field: &Field) -> bool {
        match field.kind {
            Kind::Text => self.plain.contains("text") && !self.is_list,
            Kind::Truth => self.plain.contains("truth"),
            Kind::Count | Kind::Number(_) => self.plain.contains("number") && !self.is_list,
            Kind::Numbers { .. } => self.plain.contains("number") && self.is_list,
            Kind::Nested => self.is_list || !self.keys.is_empty(),
        }
    }

    /// What is meant by a key in the answer of a verb: of the fields of the verb one that is listed behind the object in which it stands,
    /// before the next object; else a field of the verb before those of others, one of the kind that was seen before the rest.
    fn field(&self, verb: Verb, object: &str, key: &str) -> Option<&'static Field> {
        let called = |field: &&Field| field.key == key;
        let own = || field::of(verb).filter(called);
        let fits = |field: &&Field| self.fits(field);
        let behind = field::of(verb).skip_while(|field| field.key != object).skip(1);
        let behind = behind.take_while(|field| field.kind != Kind::Nested).filter(called).find(fits);
        let of_kind = behind.or_else(|| own().find(fits)).or_else(|| field::all().filter(called).find(fits));
        of_kind.or_else(|| own().next()).or_else(|| field::all().find(called))
    }
}

fn see(keys: &mut Keys, object: &Map<String, Value>) {
    for (key, value) in object {
        let at = keys.iter().position(|(known, _)| known == key).unwrap_or_else(|| {
            keys.push((key.clone(), Seen::default()));
            keys.len() - 1
        });
        keys[at].1.see(value);
    }
}

/// A page as it is written, with objects that stand in several places once.
struct Page {
    verb: Verb,
    text: String,
    /// The keys of an object that was written, and where.
    written: Vec<(Vec<String>, String)>,
    /// Keys that have no field.
    further: Vec<String>,
}

impl Page {
    fn write(&mut self, above: &str, object: &str, keys: &Keys) {
        for (key, seen) in keys {
            let path = format!("{above}{key}{}", if seen.is_list && !seen.keys.is_empty() { "[]" } else { "" });
            let names: Vec<String> = seen.keys.iter().map(|(key, _)| key.clone()).collect();
            let known = self.written.iter().find(|(of, _)| !names.is_empty() && *of == names).map(|(_, at)| at.clone());
            let alike = match &known {
                Some(at) => format!(" Its keys are those of `{at}`."),
                None if self.verb == Verb::Mill && key == "chatter" => {
                    " Its other keys are those of [chatter](chatter.md).".into()
                }
                None => String::new(),
            };
            // A cell is as it was asked for.
            match seen.field(self.verb, object, key).filter(|_| above != "cell.") {
                Some(field) if above == "chatter." && field::of(Verb::Chatter).any(|own| own == field) => {}
                Some(field) => {
                    row(&mut self.text, &[&format!("`{path}`"), &unit(field), &format!("{}{alike}", field.about)]);
                }
                None => self.further.push(format!("`{path}`")),
            }
            // Below, a robot is as in its file.
            if known.is_none() && self.verb != Verb::List {
                self.written.push((names, path.clone()));
                self.write(&format!("{path}."), key, &seen.keys);
            }
        }
    }
}

/// The keys of the answers of a verb; nothing where none are recorded.
pub(super) fn of_verb(verb: Verb) -> String {
    // The catalogue is a list of robots.
    let mut seen = Seen::default();
    for answer in recorded_json(verb.name()) {
        seen.see(&answer);
    }
    let mut keys = seen.keys;
    keys.retain(|(key, _)| key != "schema");
    if keys.is_empty() {
        return String::new();
    }
    let mut page = Page { verb, text: String::new(), written: Vec::new(), further: Vec::new() };
    page.text.push_str(
        "\n## Keys of its answer\n\nAs `--format json`, HTTP and Python's `to_dict()` have them: `a.b` stands in the object `a`, `a[].b` in each \
         object of the list `a`. A key that does not apply is null. `schema` says the version of the keys and what positions count from. Objects \
         whose keys have no line here stand in few answers: see the pages of [keys](keys_a_to_d.md).\n\n",
    );
    head(&mut page.text, &["key", "unit", "meaning"]);
    page.write("", "", &keys);
    if !page.further.is_empty() {
        let _ = writeln!(page.text, "\nAs in the robot file or in what was asked: {}.", page.further.join(", "));
    }
    page.text
}

#[test]
fn a_key_of_several_meanings_has_that_of_its_place() {
    for (verb, line) in [
        (Verb::Mill, "| `search.samples` | count | Samples that stood for the path in the search. |"),
        (Verb::Mill, "| `part.samples` | count | Samples along the path. |"),
        (Verb::Mill, "| `worst_mm` | mm | The largest error along the path. |"),
        (Verb::Mill, "| `verdict` | text | pass where the tolerance is kept"),
        (Verb::Map, "| `zone.deflection_mm` | mm | The worst deflection in the zone at its best place. |"),
        (Verb::Calibrate, "| `at_work.postures` | count | Postures over which it is told. |"),
        (Verb::Rank, "| `winners[].best` | text | The best robot whose geometry and limits are published. |"),
        (Verb::Study, "| `rows[].best` | yes or no | The link ratio is the best. |"),
    ] {
        let text = of_verb(verb);
        assert!(text.contains(line), "{line}: {text}");
    }
}
