//! Any bytes, any options: the tokens concatenate to the file, items and records lie inside their block.
#![no_main]
#![allow(dead_code)]
use libfuzzer_sys::fuzz_target;

#[path = "../targets.rs"]
mod targets;

fuzz_target!(|data: &[u8]| targets::parse(data));
