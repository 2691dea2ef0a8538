//! Is every text either rows of finite numbers, of which an identification says what it can without a panic, or a list of faults with reasons?
#![no_main]

#[path = "../promises/measurements.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
