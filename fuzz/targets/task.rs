//! Is every text either a zone of a size a robot can reach, which its own name gives back, or refused with that text?
#![no_main]

#[path = "../promises/task.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
