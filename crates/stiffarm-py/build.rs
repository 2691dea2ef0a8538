//! Tells the linker that the interpreter brings what is missing, and the module from which Rust sources it is made.

use std::path::{Path, PathBuf};
use std::{fs, io};

use sha2::{Digest, Sha256};

/// What is compiled in: the library, what is asked of it, and this module, as they lie beside each other in the repository and in an sdist.
const CRATES: [&str; 3] = ["stiffarm", "stiffarm-ask", "stiffarm-py"];

fn main() -> io::Result<()> {
    pyo3_build_config::add_extension_module_link_args();
    println!("cargo::rustc-env=STIFFARM_SOURCES={}", digest()?);
    Ok(())
}

/// SHA-256 of what `sha256sum stiffarm/src/... stiffarm-ask/src/... stiffarm-py/src/...` prints, the files in the order of their names.
fn digest() -> io::Result<String> {
    let mut names = Vec::new();
    for name in CRATES {
        let sources = Path::new(name).join("src");
        println!("cargo::rerun-if-changed={}", Path::new("..").join(&sources).display());
        collect(&sources, &mut names)?;
    }
    let mut named: Vec<(String, PathBuf)> = Vec::new();
    for name in names {
        named.push((name.to_string_lossy().replace('\\', "/"), Path::new("..").join(name)));
    }
    named.sort();
    let mut listed = Sha256::new();
    for (name, path) in named {
        listed.update(format!("{}  {name}\n", hex(&Sha256::digest(fs::read(path)?))));
    }
    Ok(hex(&listed.finalize()))
}

/// Every file below a folder, by its name from the folder of the crates.
fn collect(folder: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(Path::new("..").join(folder))? {
        let entry = entry?;
        let name = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() { collect(&name, found)? } else { found.push(name) }
    }
    Ok(())
}

fn hex(digest: &[u8]) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
