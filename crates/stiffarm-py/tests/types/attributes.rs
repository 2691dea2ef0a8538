//! The attributes of the answers in Python are the keys of their objects.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use stiffarm_ask::answer::shape::{self, Shape, Slot};

use super::{WRITE, held, is_written, write_field};

/// Between these lines of a class stand its keys.
const FIRST: &str = "    # Keys, written from the tables of the library.\n";
const LAST: &str = "    # End of the keys.\n";

#[test]
fn the_attributes_are_those_of_the_tables() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/stiffarm/_answers");
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "py"));
    files.sort();
    let mut classes = Vec::new();
    for file in files {
        let found = fs::read_to_string(&file).unwrap();
        let expected = with_attributes(&found, &mut classes);
        if is_written() {
            fs::write(&file, &expected).unwrap();
        }
        assert!(found == expected || is_written(), "the tables have changed: {WRITE}");
    }
    let unknown = super::answers().map(|shape| shape.name).filter(|name| !classes.contains(name));
    // Several tools have the class of one.
    assert_eq!(unknown.collect::<BTreeSet<_>>(), ["MilledByToolDict"].into(), "answers without a class in Python");
}

/// A module with the keys of each of its classes as the tables have them; `known` takes the names of their objects.
fn with_attributes(text: &str, known: &mut Vec<&'static str>) -> String {
    let mut pieces = text.split_inclusive(FIRST);
    let mut written = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (_, behind) = piece.split_once(LAST).expect("a line that ends the keys");
        // The class is the last one before its keys.
        let (_, class) = written.rsplit_once("\nclass ").expect("a class");
        let (_, of) = class.split_once("[types.").expect("a base with what its answer is as a dict");
        let (name, _) = of.split_once(']').expect("its end");
        let arrays = class.split_once("_arrays = (").and_then(|(_, names)| names.split_once(')'));
        let arrays: Vec<&str> = arrays.map_or("", |(names, _)| names).split('"').skip(1).step_by(2).collect();
        written.push_str(&attributes(name, &arrays, known));
        written.push_str(LAST);
        written.push_str(behind);
    }
    written
}

/// The keys of what an answer is as a dict, as attributes; `arrays` are those of numbers that `NumPy` takes.
fn attributes(name: &str, arrays: &[&str], known: &mut Vec<&'static str>) -> String {
    let (shape, at_times): (&Shape, Option<&Shape>) = match name {
        "PlacementDict" => (&shape::PLACEMENT, Some(&shape::PLACEMENT_IN_RANKING)),
        "MilledDict" => (&shape::MILLED, Some(&shape::MILLED_BY_TOOL)),
        name => (shape::all().into_iter().find(|shape| shape.name == name).expect("a shape of this name"), None),
    };
    known.push(shape.name);
    let is_own = |key: &str| shape.slots().any(|slot| slot.field.key == key);
    let mut text = "    schema: types.Schema\n".to_owned();
    let mut attribute = |slot: &Slot, may_be_none: bool| {
        // `pass` is a word of Python's own: `passes`.
        if slot.field.key == "pass" {
            return;
        }
        let is_array = arrays.contains(&slot.field.key);
        let kind = if is_array { "Array".into() } else { held(slot, "types.") };
        let none = if may_be_none && !kind.ends_with("| None") { " | None" } else { "" };
        write_field(&mut text, slot.field, &format!("{kind}{none}"));
    };
    for slot in shape.slots() {
        attribute(slot, slot.may_be_null);
    }
    for slot in at_times.into_iter().flat_map(Shape::slots).filter(|slot| !is_own(slot.field.key)) {
        attribute(slot, true);
    }
    let unknown: Vec<&&str> = arrays.iter().filter(|key| !is_own(key)).collect();
    assert!(unknown.is_empty(), "{name} has no key {unknown:?}");
    text
}
