//! Is every file either a path of finite moves that hang together, or refused with a line of it and a reason?
#![no_main]

#[path = "../promises/toolpath.rs"]
mod promise;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| promise::holds(bytes));
