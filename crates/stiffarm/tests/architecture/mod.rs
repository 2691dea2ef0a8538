//! Is the house built as its map says: each module uses only those above it, no two files each other, one palette?

mod colours;
mod source;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use source::{Uses, tokens, uses};

/// Modules that use one further down all the same, and why. What is no longer so must go from here.
const BELOW: [(&str, &str, &str); 0] = [];

/// The library, and what is asked of it and answered: the second uses the first, so their modules have one order.
const CRATES: [&str; 2] =
    [concat!(env!("CARGO_MANIFEST_DIR"), "/../src"), concat!(env!("CARGO_MANIFEST_DIR"), "/../../stiffarm-ask/src")];

/// The faces: crates of their own.
const FACES: [&str; 2] = [
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../stiffarm-cli/src"),
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../stiffarm-py/src"),
];

/// All sources of some crates by their module's path, `""` for the roots.
struct Sources {
    uses: BTreeMap<String, Uses>,
    /// What their root is called in a path.
    roots: &'static [&'static str],
}

impl Sources {
    fn read() -> Self {
        Self::of(&CRATES, &["crate", "stiffarm"])
    }

    fn of(folders: &[&str], roots: &'static [&'static str]) -> Self {
        let mut uses = BTreeMap::new();
        for folder in folders {
            read_folder(Path::new(folder), "", &mut uses);
        }
        Self { uses, roots }
    }

    fn exists(&self, module: &str) -> bool {
        self.uses.contains_key(module)
    }

    /// The module in which an item stands that `module` names by a path, through every `use` on the way; none where it is
    /// not of this library.
    fn home(&self, module: &str, path: &[String], steps: usize) -> Option<String> {
        let (first, rest) = path.split_first()?;
        let mut at = match first.as_str() {
            root if self.roots.contains(&root) => "",
            "super" => parent(module),
            "self" => module,
            _ => return self.within(module, path, steps),
        };
        let mut rest = rest;
        while rest.first().is_some_and(|word| word == "super") {
            at = parent(at);
            rest = &rest[1..];
        }
        if rest.is_empty() { None } else { self.within(at, rest, steps) }.or_else(|| Some(at.to_owned()))
    }

    /// The same for a path whose first word stands in `module`: a child of it, or a name that it brings in.
    fn within(&self, module: &str, path: &[String], steps: usize) -> Option<String> {
        let (first, rest) = path.split_first()?;
        let child = join(module, first);
        if self.exists(&child) {
            return if rest.is_empty() { Some(child) } else { self.within(&child, rest, steps).or(Some(child)) };
        }
        let brought = self.uses[module].names.get(first).filter(|brought| 0 < steps && brought[..] != *path)?;
        let path: Vec<String> = brought.iter().chain(rest).cloned().collect();
        self.home(module, &path, steps - 1)
    }

    /// Which module uses which, each pair once.
    fn pairs(&self) -> BTreeSet<(String, String)> {
        let mut pairs = BTreeSet::new();
        for (module, uses) in self.uses.iter().filter(|(module, _)| !module.is_empty()) {
            let homes = uses.paths.iter().filter_map(|path| self.home(module, path, 8));
            pairs.extend(homes.filter(|home| home != module && !home.is_empty()).map(|home| (module.clone(), home)));
        }
        pairs
    }
}

fn read_folder(folder: &Path, module: &str, found: &mut BTreeMap<String, Uses>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        if path.is_dir() {
            read_folder(&path, &join(module, name), found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let own = if ["lib", "main", "mod"].contains(&name) { module.to_owned() } else { join(module, name) };
            found.insert(own, uses(&tokens(&fs::read_to_string(&path).unwrap())));
        }
    }
}

fn join(module: &str, name: &str) -> String {
    if module.is_empty() { name.to_owned() } else { format!("{module}::{name}") }
}

fn parent(module: &str) -> &str {
    module.rsplit_once("::").map_or("", |(parent, _)| parent)
}

fn top(module: &str) -> &str {
    module.split("::").next().unwrap_or_default()
}

/// The modules that a text names between backticks, in its order, each once.
fn named(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in text.split('`').skip(1).step_by(2) {
        if !found.iter().any(|other| other == top(name)) {
            found.push(top(name).to_owned());
        }
    }
    found
}

/// The modules in the reading order that the own docs of both crates tell.
fn reading_order() -> Vec<String> {
    let listed = |folder: &str| {
        let root = fs::read_to_string(format!("{folder}/lib.rs")).unwrap();
        let (_, list) = root.split_once("modules in reading order").expect("a list of modules in the docs of lib.rs");
        named(list.split("\n//!\n").next().unwrap_or_default())
    };
    CRATES.into_iter().flat_map(listed).collect()
}

/// The modules in the order of the table in ARCHITECTURE.md: what stands in its first column.
fn mapped_order() -> Vec<String> {
    let map = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../ARCHITECTURE.md")).unwrap();
    let (_, table) = map.split_once("in reading order\n").expect("a table of modules in ARCHITECTURE.md");
    let rows = table.split("\n## ").next().unwrap_or_default().lines().filter(|line| line.starts_with("| `"));
    named(&rows.map(|row| row.split('|').nth(1).unwrap_or_default()).collect::<String>())
}

#[test]
fn both_lists_name_every_module_in_the_same_order() {
    let listed = reading_order();
    assert_eq!(listed, mapped_order(), "left: the lib.rs of both crates; right: ARCHITECTURE.md");
    let sources = Sources::read();
    let existing: BTreeSet<&str> =
        sources.uses.keys().map(|module| top(module)).filter(|top| !top.is_empty()).collect();
    assert_eq!(listed.iter().map(String::as_str).collect::<BTreeSet<_>>(), existing);
}

#[test]
fn each_module_uses_only_those_above_it() {
    let order = reading_order();
    let rank = |module: &str| order.iter().position(|name| name == top(module)).expect(module);
    let mut wrong: Vec<(String, String)> = Sources::read()
        .pairs()
        .into_iter()
        .filter(|(from, to)| rank(from) < rank(to))
        .map(|(from, to)| (from, top(&to).to_owned()))
        .collect();
    wrong.dedup();
    let excepted: Vec<(String, String)> = BELOW.map(|(from, to, _)| (from.to_owned(), to.to_owned())).into();
    let sorted = |mut pairs: Vec<(String, String)>| {
        pairs.sort();
        pairs
    };
    assert_eq!(sorted(wrong), sorted(excepted), "left: what uses a module below it; right: what is excepted");
}

/// A parent may hand out what its children hold, and they may use its types: they are one thing in several files. What a
/// child takes from its parent by name but a sibling holds counts as the sibling's.
#[test]
fn no_files_use_each_other() {
    let none: Vec<Vec<String>> = Vec::new();
    // Modules of these have an order, so that only files of one module can use each other.
    assert_eq!(circles(&Sources::read(), |from, to| top(from) == top(to)), none);
    for face in FACES {
        assert_eq!(circles(&Sources::of(&[face], &["crate"]), |_, _| true), none, "{face}");
    }
}

/// Files that use each other, of those pairs that count.
fn circles(sources: &Sources, counts: impl Fn(&str, &str) -> bool) -> Vec<Vec<String>> {
    let is_within = |inner: &str, outer: &str| inner.starts_with(&format!("{outer}::"));
    let mut reached: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (from, to) in sources.pairs() {
        if counts(&from, &to) && !is_within(&from, &to) && !is_within(&to, &from) {
            reached.entry(from).or_default().insert(to);
        }
    }
    for _ in 0..reached.len() {
        let before = reached.clone();
        for further in reached.values_mut() {
            let more: Vec<String> = further.iter().filter_map(|to| before.get(to)).flatten().cloned().collect();
            further.extend(more);
        }
    }
    let mutual = |a: &str, b: &str| reached.get(a).is_some_and(|further| further.contains(b));
    let circle = |file: &str| -> Vec<String> {
        reached.keys().filter(|other| mutual(file, other) && mutual(other, file)).cloned().collect()
    };
    let found: BTreeSet<Vec<String>> =
        reached.keys().filter(|file| mutual(file, file)).map(|file| circle(file)).collect();
    found.into_iter().collect()
}

#[test]
fn a_source_is_read_as_the_compiler_reads_it() {
    let text = r##"
        //! crate::comment::Item
        use std::fmt;
        use crate::{a::{self, B as C}, d::*};
        pub use super::e::f;
        fn g<'a>(x: &'a str) -> char { h::i::<u8>(); crate::j::K { l: "crate::m::N", n: '"' }; r#"crate::o::P"#; '\'' }
        #[cfg(test)]
        mod tests { use crate::q::R; }
        fn s() { super::t() }
        fn u<'a>(x: &'a [u8]) -> impl Iterator + use<'a> { v::w(x) }
    "##;
    let found = uses(&tokens(text));
    let paths: Vec<String> = found.paths.iter().map(|path| path.join("::")).collect();
    let expected =
        ["std::fmt", "crate::a", "crate::a::B", "crate::d", "super::e::f", "h::i", "crate::j::K", "super::t", "v::w"];
    assert_eq!(paths, expected);
    assert_eq!(found.names["C"], ["crate", "a", "B"]);
}
