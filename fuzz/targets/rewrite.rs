//! Does every path that is read, written back without correction, read back to itself?
#![no_main]

#[path = "../promises/rewrite.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
