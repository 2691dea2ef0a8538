//! Is what a person reads true: README and guide against the program, the tables and each other?

mod cut;
mod documents;
mod keys;
mod reference;
pub(crate) mod shown;

use std::fs;
use std::path::{Path, PathBuf};

pub(crate) const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// A Markdown file of the repository, by its path from the root.
pub(crate) struct Document {
    name: String,
    text: String,
}

fn document(name: &str) -> Document {
    let text = fs::read_to_string(Path::new(ROOT).join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    Document { name: name.into(), text }
}

/// README and every page of `docs`, in the order of their names.
fn documents() -> Vec<Document> {
    let mut names = vec!["README.md".to_owned()];
    names.extend(pages_in("docs"));
    names.iter().map(|name| document(name)).collect()
}

/// Every Markdown file below a folder.
fn pages_in(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(Path::new(ROOT).join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let mut names = Vec::new();
    for path in paths {
        let name = format!("{folder}/{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() {
            names.extend(pages_in(&name));
        } else if path.extension().is_some_and(|ending| ending == "md") {
            names.push(name);
        }
    }
    names
}
