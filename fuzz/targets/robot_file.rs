//! Is every text either a robot with a reachable arm, or a list of faults with lines and reasons?
#![no_main]

#[path = "../promises/robot_file.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
