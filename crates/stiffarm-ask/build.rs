//! Packs what is large and seldom read: the fonts.

use std::io::Write;
use std::path::PathBuf;
use std::{env, fs};

use flate2::Compression;
use flate2::write::GzEncoder;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo names a folder"));
    for (name, bytes) in [
        ("plain.ttf.gz", dejavu::sans::regular()),
        ("bold.ttf.gz", dejavu::sans::bold()),
        ("mono.ttf.gz", dejavu::sans_mono::regular()),
    ] {
        let mut packed = GzEncoder::new(Vec::new(), Compression::best());
        packed.write_all(bytes).expect("memory is written to");
        fs::write(folder.join(name), packed.finish().expect("it ends")).expect("the folder is there");
    }
}
