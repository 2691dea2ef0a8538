//! A robot file that is dropped in must be compiled in: the compiler alone sees changed files, but no new ones.

fn main() {
    println!("cargo::rerun-if-changed=robots");
}
