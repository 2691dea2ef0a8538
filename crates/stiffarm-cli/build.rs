//! A page that is changed or added must be compiled in: the compiler alone sees no new files.

fn main() {
    println!("cargo::rerun-if-changed=page");
}
