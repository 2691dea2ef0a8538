//! Is every text either a process with a finite force, or a list of faults with lines and reasons?
#![no_main]

#[path = "../promises/process_file.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
