//! Any program in any dialect runs to its end within its bounds, without a panic, and every fact lies inside the file.
#![no_main]
#![allow(dead_code)]
use libfuzzer_sys::fuzz_target;

#[path = "../targets.rs"]
mod targets;

fuzz_target!(|data: &[u8]| targets::run(data));
