//! Is every description of a robot either imported exactly, or refused with lines and reasons?
#![no_main]

#[path = "../promises/urdf.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
