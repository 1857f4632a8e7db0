//! Any bytes as a LinuxCNC program: it ends within its bounds, every error lies inside the file, the listing can be written.
#![no_main]
#![allow(dead_code)]
use libfuzzer_sys::fuzz_target;

#[path = "../targets.rs"]
mod targets;

fuzz_target!(|data: &[u8]| targets::canon(data));
