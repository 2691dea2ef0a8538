//! Does every arm, zone and question get an answer that keeps its certificate, or an error, and never a panic?
#![no_main]

#[path = "../promises/place.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
