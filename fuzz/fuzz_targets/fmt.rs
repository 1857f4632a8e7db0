//! Any program in any dialect: a layout that is given out is proved, and laid out again it stays as it is.
#![no_main]
#![allow(dead_code)]
use libfuzzer_sys::fuzz_target;

#[path = "../targets.rs"]
mod targets;

fuzz_target!(|data: &[u8]| targets::fmt(data));
